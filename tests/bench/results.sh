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

# rows WHAT NUMBERS: seconds and error of the mean energy
rows() {
    echo "\"<awk -F, '\$1 == \\\"$1\\\" && \$2 == \\\"$2\\\" && \$6 == \\\"mean_energy_kJ\\\" {print \$5, \$7}' results/bench_error.csv\""
}
if [ -f results/bench_error.csv ]; then
    gnuplot >results/error.txt <<END || failed="$failed plot"
set terminal dumb 100 30
set logscale xy
set format "10^{%L}"
set title "error of the mean energy, kJ, against run time, s"
set key bottom left
plot $(rows paper-bare core) with points title "bare, core", \\
     $(rows paper-stems core) with points title "stems, core", \\
     $(rows spread-starts plain) with points title "spread starts, plain", \\
     $(rows spread-starts antithetic) with points title "antithetic", \\
     $(rows spread-starts sobol) with points title "sobol"
END
    cat results/error.txt
fi
[ -z "$failed" ] && exit 0
echo "failed:$failed" >&2
exit 1
