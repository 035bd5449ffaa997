#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: slow full unsanitized
# The same bits with 1, 2 and 16 threads, at -O2 as in the library, at -O3, and with clang if installed. Compiles without forced
# inlining, in a quarter of the time; with FULL in the environment, with forced inlining, and at -O0 as well.
cd "$(dirname "$0")/../.." || exit 1
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
n=0
inlining=-Dalways_inline=unused
[ -z "$FULL" ] || inlining=
# The built library; objects compiled here are linked before it.
core="$(find src/scene src/core -name '*.c')"
library=${BUILD:-none}/libceduo.a
case ${BUILD:-none} in
*release) ;;
*) library="$(find src/base src/scene src/core src/study -name '*.c')" core= ;;
esac
compile() { # name compiler level sources
    name=$1 cc=$2 level=$3
    shift 3
    "$cc" -std=c17 -D_GNU_SOURCE -ffp-contract=off "$level" $inlining -pthread -Iinclude -Isrc -Itests -o "$dir/$name" \
        tests/physics/bits.c tests/physics/paper_site.c "$@" $library -lunistring -lgsl -lgslcblas -lm
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
levels="O2 O3${FULL:+ O0}"
for level in O3 ${FULL:+O0}; do compile $level "${CC:-gcc}" -$level $core & done
if command -v clang >/dev/null; then compile clang clang -O2 $core 2>/dev/null & fi
compile O2 "${CC:-gcc}" -O2
wait
for level in $levels; do [ -x "$dir/$level" ] || echo "not ok - cannot compile at -$level"; done
"$dir/O2" 1 >"$dir/first"
[ -s "$dir/first" ] || echo "not ok - nothing to compare"
for threads in 1 2 16; do
    for level in $levels; do check $level $threads; done
done
if [ -x "$dir/clang" ]; then check clang 2; fi
echo "1..$n"
