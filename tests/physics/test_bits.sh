#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The same bits with 1, 2 and 16 threads and at -O2, -O0 and -O3, with clang too where there is one.
cd "$(dirname "$0")/../.." || exit 1
dir=$(mktemp -d)
library=$(echo src/base/*.c src/scene/*.c src/core/*.c src/study/*.c)
trap 'rm -rf "$dir"' EXIT
n=0
compile() { # name compiler flags; what is made of the core: its sources, or the library that is built already
    name=$1 cc=$2 level=$3
    shift 3
    "$cc" -std=c17 -D_GNU_SOURCE -ffp-contract=off "$level" -pthread -Iinclude -Isrc -Itests -o "$dir/$name" \
        tests/physics/bits.c tests/physics/paper_site.c "$@" -lunistring -lgsl -lgslcblas -lm
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
case ${BUILD:-none} in
*release) usual=$BUILD/libceduo.a ;;
*) usual=$library ;;
esac
for level in O0 O3; do compile $level "${CC:-gcc}" -$level $library & done
if command -v clang >/dev/null; then compile clang clang -O2 $library 2>/dev/null & fi
compile O2 "${CC:-gcc}" -O2 $usual
wait
for level in O2 O0 O3; do [ -x "$dir/$level" ] || echo "not ok - cannot compile at -$level"; done
"$dir/O2" 1 >"$dir/first"
[ -s "$dir/first" ] || echo "not ok - nothing to compare"
for threads in 1 2 16; do
    for level in O2 O0 O3; do check $level $threads; done
done
if [ -x "$dir/clang" ]; then check clang 2; fi
echo "1..$n"
