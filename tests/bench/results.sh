#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs benches and stores their tables in tests/bench/results. made.csv there records date, commit and machine of each.
#
#   results.sh BENCH...         each prints CSV; exit 1 if one fails: its table is printed and not stored
#
# ONLY in the environment: names of benches, with or without bench_; errors: benches with tables that do not depend on the load of
# the machine; times: the others, for an idle machine. CC names the compiler.
errors=" bench_calibration bench_coverage bench_uncertainty_error bench_ground bench_rounding bench_tschamut bench_verdict "

is_wanted() { # name
    [ -n "$ONLY" ] || return 0
    for only in $ONLY; do
        case $only/$errors in
        "$1"/* | "${1#bench_}"/* | errors/*" $1 "*) return 0 ;;
        times/*" $1 "*) ;;
        times/*) return 0 ;;
        esac
    done
    return 1
}

for bench; do # paths are relative to the first folder
    case $bench in
    /*) ;;
    *) bench=$PWD/$bench ;;
    esac
    set -- "$@" "$bench"
    shift
done
cd "$(dirname "$0")" || exit 1
mkdir -p results || exit 1

# Describes the machine, but not its owner.
commit=$(git rev-parse --short=12 HEAD 2>/dev/null)
[ -z "$(git status --porcelain -uno -- . ':!results' ../../src ../../include ../../Makefile 2>/dev/null)" ] ||
    commit="$commit changed"
machine=$(printf '%s,' "$(sed -n 's/^model name[[:space:]]*: //p' /proc/cpuinfo | head -n 1 | tr -d ',')" "$(nproc)" \
    "$(${CC:-gcc} --version | head -n 1 | tr -d ',')" "$(uname -s) $(uname -r | sed 's/-.*//') $(uname -m)")

note() { # name: record it as made now
    {
        echo "bench,date,commit,processor,cores,compiler,kernel"
        { [ ! -f results/made.csv ] || sed 1d results/made.csv | grep -v "^$1,"
          echo "$1,$(date -u +%Y-%m-%d),${commit:-unknown},${machine%,}"; } | LC_ALL=C sort
    } >results/made.new
    mv results/made.new results/made.csv
}

failed=
for bench; do
    name=$(basename "$bench")
    name=${name%.*}
    is_wanted "$name" || continue
    echo "== $name"
    (cd ../.. && "$bench") >"results/$name.new" # paths of scenes are relative to it
    status=$?
    cat "results/$name.new"
    if [ $status = 0 ]; then
        mv "results/$name.new" "results/$name.csv"
        note "$name"
    else
        rm "results/$name.new"
        failed="$failed $name (exit $status)"
    fi
done

[ -z "$failed" ] && exit 0
echo "failed:$failed" >&2
exit 1
