#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The same bits with 1, 2 and 16 threads and at -O0, -O1, -O2 and -O3, with clang too where there is one.
cd "$(dirname "$0")/../.." || exit 1
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
n=0
compile() { # compiler flags name
    "$1" -std=c17 -D_GNU_SOURCE -ffp-contract=off $2 -pthread -Iinclude -Isrc -Itests -o "$dir/$3" tests/physics/bits.c \
        tests/physics/paper_site.c src/core/*.c -lgsl -lgslcblas -lm
}
check() { # name threads
    n=$((n + 1))
    if "$dir/$1" "$2" >"$dir/now" && cmp -s "$dir/now" "$dir/first"; then
        echo "ok $n - $1 with $2 threads gives the same bits"
    else
        echo "not ok $n - $1 with $2 threads gives other bits"
        diff "$dir/first" "$dir/now" | head -4 | sed 's/^/# /'
    fi
}
for level in O2 O0 O1 O3; do
    compile "${CC:-gcc}" -$level $level || echo "not ok - cannot compile at -$level"
done
"$dir/O2" 1 >"$dir/first"
[ -s "$dir/first" ] || echo "not ok - nothing to compare"
for threads in 1 2 16; do
    for level in O2 O0 O1 O3; do check $level $threads; done
done
if command -v clang >/dev/null && compile clang -O2 clang 2>/dev/null; then check clang 2; fi
echo "1..$n"
