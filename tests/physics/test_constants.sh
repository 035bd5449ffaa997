#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: slow full unsanitized
# No result depends on a numerical constant: with half and with twice the value of all of them, each statistic stays within its
# error. Objects that use a constant are compiled with the other value and linked before the built library.
#
#   test_constants.sh [each]        each: one constant after the other, a minute
cd "$(dirname "$0")/../.." || exit 1
dir=$(mktemp -d)
BUILD=${BUILD:-build/release}
trap 'rm -rf "$dir"' EXIT
# always_inline: runs are short here, and without it the lanes are compiled in less than half of the time
flags="-std=c17 -D_GNU_SOURCE -Werror -O1 -Dalways_inline=unused -ffp-contract=off -pthread -Iinclude -Isrc -Itests"
n=0
compile() { # folder, flags, sources: objects
    to=$1 extra=$2
    shift 2
    mkdir -p "$to"
    for c in "$@"; do ${CC:-gcc} $flags $extra -c -o "$to/$(basename "$c" .c).o" "$c" || return 1; done
}
run() { # file for the statistics, objects linked before the library
    to=$1
    shift
    ${CC:-gcc} -pthread -o "$dir/constants" "$dir"/own/*.o "$@" "$library" -lunistring -lgsl -lgslcblas -lm && "$dir/constants" >"$to"
}
check() { # name, defines
    n=$((n + 1))
    rm -rf "$dir/now" "$dir/second"
    if compile "$dir/now" "$2" $sources && run "$dir/second" "$dir"/now/*.o && moved=$(paste -d ' ' "$dir/first" "$dir/second" | awk '
        function size(v) { return v < 0 ? -v : v }
        NF != 6 || $1 != $4 || !(size($2 - $5) <= $3) { print "# " $1 ": " $2 " becomes " $5 ", error " $3 }') &&
        [ -z "$moved" ]; then
        echo "ok $n - $1 moves no statistic by more than its error"
    else
        echo "not ok $n - $1"
        echo "$moved" | head -5
    fi
}
half="MARGIN=.5e-10 ON_LINE=(2*DBL_EPSILON) NO_BREAK=.5e-7 GROUND_BITS=2
    WAITING_MAX=(LANES/8) PAUSE=2000 CHUNK_BATCHES=128"
twice="MARGIN=2e-10 ON_LINE=(8*DBL_EPSILON) NO_BREAK=2e-7 GROUND_BITS=4
    WAITING_MAX=(LANES/2) PAUSE=8000 CHUNK_BATCHES=512"
defines() {
    for d in "$@"; do printf -- '-D%s ' "$d"; done
}
# The files with the constants, and the sources that include any of them according to the compiler.
homes=
for d in $half; do
    home=$(grep -lx "#ifndef ${d%%=*}" $(find src/core -name '*.[ch]')) || echo "not ok - nothing reads ${d%%=*}"
    homes="$homes -e $home"
done
sources=$(grep -lF $homes $(find "$BUILD/src/core" -name '*.d') | sed "s|^$BUILD/||; s|d$|c|" | xargs ls 2>/dev/null) # without deleted sources
[ -n "$sources" ] || echo "not ok - no source reads a constant"
library=$BUILD/libceduo.a
case $BUILD in
*release) ;;
*) # linked with more libraries than listed here
    compile "$dir/usual" "" $(find src/base src/scene src/core src/study -name '*.c')
    library=$dir/usual.a
    ar rcs "$library" "$dir"/usual/*.o
    ;;
esac
compile "$dir/own" "" tests/physics/constants.c tests/physics/line_scene.c tests/physics/paper_site.c && run "$dir/first"
[ -s "$dir/first" ] || echo "not ok - nothing to compare"
if [ "$1" = each ]; then
    for d in $half $twice; do check "$d" "-D$d"; done
else
    check "half of all constants" "$(defines $half)"
    check "twice of all constants" "$(defines $twice)"
fi
echo "1..$n"
