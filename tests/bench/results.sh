#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs benches and keeps what they find, with the machine that they ran on, in tests/bench/results.
#
#   results.sh BENCH...         each prints CSV; exit 1 where one of them failed: its table is shown and not kept
#
# A plot of the error against run time follows where bench_error has been run. CC names the compiler.
for bench; do # paths are from where it was started
    case $bench in
    /*) ;;
    *) bench=$PWD/$bench ;;
    esac
    set -- "$@" "$bench"
    shift
done
cd "$(dirname "$0")" || exit 1
mkdir -p results || exit 1

# What tells one machine's figures from another's, and nothing of whose machine it is.
commit=$(git rev-parse HEAD 2>/dev/null)
[ -z "$(git status --porcelain -uno -- . ':!results' ../../src ../../include ../../Makefile 2>/dev/null)" ] ||
    commit="$commit, changed"
{
    echo "processor: $(sed -n 's/^model name[[:space:]]*: //p' /proc/cpuinfo | head -n 1)"
    echo "cores: $(nproc)"
    echo "compiler: $(${CC:-gcc} --version | head -n 1)"
    echo "kernel: $(uname -s) $(uname -r | sed 's/-.*//') $(uname -m)"
    echo "date: $(date -u +%Y-%m-%d)"
    echo "commit: ${commit:-unknown}"
} >results/machine.txt

failed=
for bench; do
    name=$(basename "$bench")
    name=${name%.*}
    echo "== $name"
    (cd ../.. && "$bench") >"results/$name.new" # scenes are named from there
    status=$?
    cat "results/$name.new"
    if [ $status = 0 ]; then
        mv "results/$name.new" "results/$name.csv"
    else
        rm "results/$name.new"
        failed="$failed $name (exit $status)"
    fi
done

[ -z "$failed" ] && exit 0
echo "failed:$failed" >&2
exit 1
