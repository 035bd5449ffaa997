#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs a command with a Slurm of one node, started for this command on loopback: tests/slurm.sh COMMAND...
# It has its own daemons, keys, ports and files, all removed at the end. Status 77 and the reason if Slurm cannot be started.
set -eu

cannot() {
    echo "no Slurm here: $1" >&2
    exit 77
}

[ "$(id -u)" = 0 ] || cannot 'only root can start one'
for name in munged slurmctld slurmd sbatch scontrol; do
    command -v "$name" >/dev/null || cannot "$name is not installed"
done

place=$(mktemp -d)
chmod 755 "$place" # munged's socket must be reachable
end() {
    for name in slurmd slurmctld munged; do
        [ ! -s "$place/$name.pid" ] || kill "$(cat "$place/$name.pid")" 2>/dev/null || :
    done
    sleep 1 # the daemons write their state
    rm -rf "$place"
}
trap end EXIT
trap 'exit 130' INT TERM HUP

ports=$(python3 -c 'import socket
held = [socket.create_server(("127.0.0.1", 0)) for _ in range(2)]
print(*(s.getsockname()[1] for s in held))')
mkdir -m 700 "$place/keys" "$place/state" "$place/spool"
head -c 128 /dev/urandom >"$place/keys/munge"
chmod 600 "$place/keys/munge"

# The node declares enough resources for a task, whatever this machine has.
cat >"$place/slurm.conf" <<CONF
ClusterName=one
SlurmctldHost=localhost(127.0.0.1)
SlurmUser=root
AuthType=auth/munge
AuthInfo=socket=$place/munged.socket
SlurmctldPort=${ports% *}
SlurmdPort=${ports#* }
StateSaveLocation=$place/state
SlurmdSpoolDir=$place/spool
SlurmctldPidFile=$place/slurmctld.pid
SlurmdPidFile=$place/slurmd.pid
SlurmctldLogFile=$place/slurmctld.log
SlurmdLogFile=$place/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdParameters=config_overrides
SchedulerParameters=sched_interval=1
NodeName=one NodeHostname=localhost NodeAddr=127.0.0.1 CPUs=8 RealMemory=8000 State=UNKNOWN
PartitionName=main Nodes=one Default=YES State=UP
CONF
export SLURM_CONF="$place/slurm.conf"

(cd "$place" && munged --force --key-file="$place/keys/munge" --socket="$place/munged.socket" \
    --pid-file="$place/munged.pid" --log-file="$place/munged.log" --seed-file="$place/keys/seed") 2>/dev/null ||
    cannot "munged: $(tail -n 1 "$place/munged.log" 2>/dev/null)"
slurmctld -c 2>/dev/null || cannot 'slurmctld does not start'
slurmd -N one -c 2>/dev/null || cannot 'slurmd does not start'
tries=0
until sinfo -h -o %t 2>/dev/null | grep -qx idle; do
    tries=$((tries + 1))
    [ $tries -lt 60 ] || cannot "the node is not idle: $(grep -h error "$place"/slurm*.log | tail -n 1)"
    sleep 0.5
done
"$@"
