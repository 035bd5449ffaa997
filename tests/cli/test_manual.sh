#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# The manual is well-formed, its tables are those of the program, and it has every option.
cd "$(dirname "$0")/../.." || exit 1
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
n=0
say() { # status name
    n=$((n + 1))
    if [ "$1" = 0 ]; then echo "ok $n - $2"; else echo "not ok $n - $2"; fi
}
for page in ceduo.1 ceduo.3 ceduo-scene.5 ceduo-slope.5 ceduo-stand.5 ceduo-accuracy.7 ceduo-model.7 ceduo-workflows.7; do
    mandoc -Tlint -W warning "man/$page" >"$dir/lint" 2>&1
    say $? "$page has no warning"
    sed 's/^/# /' "$dir/lint"
done
make --no-print-directory -s "${BUILD:-build/release}/tests/tables" VARIANT="$(basename "${BUILD:-build/release}")" >/dev/null
for kind in scene slope stand; do
    cp "man/ceduo-$kind.5" "$dir/page"
    "${BUILD:-build/release}/tests/tables" $kind "$dir/page" && cmp -s "man/ceduo-$kind.5" "$dir/page"
    say $? "the parameters of ceduo-$kind.5 are those of the program (make man)"
done
for table in keys goals search figures; do
    cp man/ceduo.1 "$dir/page"
    "${BUILD:-build/release}/tests/tables" $table "$dir/page" && cmp -s man/ceduo.1 "$dir/page"
    say $? "the $table of ceduo.1 are those of the program (make man)"
done
for option in $("${CEDUO:-./ceduo}" --help | sed -nE 's/^  (-(.),|   ) --([a-z-]+).*/\2:\3/p'); do
    letter=${option%%:*}
    grep -qE -- "It Fl ${letter:+$letter , }-${option#*:}( |$)" man/ceduo.1
    say $? "--${option#*:} stands in ceduo.1${letter:+ with -$letter}"
done
echo "1..$n"
