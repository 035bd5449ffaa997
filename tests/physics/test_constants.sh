#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# No result depends on a numerical constant: with half and with twice of all, no statistic moves by more than its error.
#
#   test_constants.sh [each]        each: one constant after the other, a minute
cd "$(dirname "$0")/../.." || exit 1
dir=$(mktemp -d)
library=$(echo src/base/*.c src/scene/*.c src/core/*.c src/study/*.c)
trap 'rm -rf "$dir"' EXIT
flags="-std=c17 -D_GNU_SOURCE -Werror -O1 -ffp-contract=off -pthread -Iinclude -Isrc -Itests"
n=0
compile() { # flags, sources: objects in $dir/now
    extra=$1
    shift
    for c in "$@"; do ${CC:-gcc} $flags $extra -c -o "$dir/now/$(basename "$c" .c).o" "$c" || return 1; done
}
run() { # statistics into a file
    ${CC:-gcc} -pthread -o "$dir/constants" "$dir"/now/*.o -lunistring -lgsl -lgslcblas -lm && "$dir/constants" >"$1"
}
mkdir "$dir/now" "$dir/usual"
compile "" $library tests/physics/constants.c tests/physics/line_scene.c tests/physics/paper_site.c && run "$dir/first"
cp "$dir"/now/*.o "$dir/usual"
[ -s "$dir/first" ] || echo "not ok - nothing to compare"
check() { # what, defines, sources that have them
    n=$((n + 1))
    what=$1 define=$2
    shift 2
    cp "$dir"/usual/*.o "$dir/now"
    rm -f "$dir/second"
    if compile "$define" "$@" && run "$dir/second" && moved=$(paste -d ' ' "$dir/first" "$dir/second" | awk '
        function size(v) { return v < 0 ? -v : v }
        NF != 6 || $1 != $4 || !(size($2 - $5) <= $3) { print "# " $1 ": " $2 " becomes " $5 ", error " $3 }') &&
        [ -z "$moved" ]; then
        echo "ok $n - $what moves no statistic by more than its error"
    else
        echo "not ok $n - $what"
        echo "$moved" | head -5
    fi
}
half="MARGIN=.5e-10 ON_LINE=(2*DBL_EPSILON) NO_BREAK=.5e-7 GROUND_BITS=2 ROUNDING=.5e-9 STOP_ROUNDING=(2*DBL_EPSILON)
    PAUSE=2000 CHUNK_BLOCKS=128 WOOD_DIRECTIONS=256"
twice="MARGIN=2e-10 ON_LINE=(8*DBL_EPSILON) NO_BREAK=2e-7 GROUND_BITS=4 ROUNDING=2e-9 STOP_ROUNDING=(8*DBL_EPSILON)
    PAUSE=8000 CHUNK_BLOCKS=512 WOOD_DIRECTIONS=1024"
sources="src/core/ground.c $(grep -lE '"(wood|stems|walk|prepared|run_state).h"' src/core/*.c)"
defines() {
    for d in "$@"; do printf -- '-D%s ' "$d"; done
}
if [ "$1" = each ]; then
    for d in $half $twice; do check "$d" "-D$d" $sources; done
else
    check "half of all constants" "$(defines $half)" $sources
    check "twice of all constants" "$(defines $twice)" $sources
fi
echo "1..$n"
