#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: manual
# The manual is well-formed, its tables are those of the program, and it has every option.
cd "$(dirname "$0")/../.." || exit 1
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
n=0
say() { # status name
    n=$((n + 1))
    if [ "$1" = 0 ]; then echo "ok $n - $2"; else echo "not ok $n - $2"; fi
}
for page in $(cd man && ls *.[1357]); do
    mandoc -Tlint -W warning "man/$page" >"$dir/lint" 2>&1
    say $? "$page has no warning"
    sed 's/^/# /' "$dir/lint"
done
italian=${BUILD:-build/release}/man/it
pages="ceduo.1 ceduo-output.5 ceduo-terminal.7 ceduo-workflows.7"
for page in $pages; do
    mandoc -Tlint -W warning "$italian/$page" 2>&1 | grep -v 'new sentence, new line' >"$dir/lint" # po4a breaks lines itself
    [ ! -s "$dir/lint" ]
    say $? "the Italian $page has no warning"
    sed 's/^/# /' "$dir/lint"
done
# Untranslated text is in English in the Italian page.
po4a -v -f --no-update --variable build="$dir" src/po/man/po4a.cfg >"$dir/po4a" 2>&1
grep -q 'ceduo-workflows.7 is 100% translated' "$dir/po4a"
say $? "all of ceduo-workflows.7 is translated"
sed -n 's/.*\(ceduo[-a-z]*\.[157] is [0-9.]*% translated.*\)/# \1/p' "$dir/po4a"
make --no-print-directory -s "${BUILD:-build/release}/tests/tables" VARIANT="$(basename "${BUILD:-build/release}")" >/dev/null
for table in goals:ceduo.1 ranges:ceduo-scene.5 search:ceduo-output.5 figures:ceduo-output.5 keys:ceduo-terminal.7; do
    page=${table#*:}
    cp "man/$page" "$dir/page"
    "${BUILD:-build/release}/tests/tables" "${table%:*}" "$dir/page" && cmp -s "man/$page" "$dir/page"
    say $? "the ${table%:*} of $page are those of the program (make man)"
done
cp "$italian/ceduo-terminal.7" "$dir/page"
LC_ALL=C.UTF-8 "${BUILD:-build/release}/tests/tables" keys "$dir/page" it
mandoc -Tutf8 "$italian/ceduo-terminal.7" >"$dir/made" && mandoc -Tutf8 "$dir/page" | cmp -s - "$dir/made"
say $? "the keys of the Italian ceduo-terminal.7 are those of the program (make man, make po, src/po/man/it.po)"
tests/bench/tables.py --check man/ceduo-accuracy.7 man/ceduo-validation.7 README.md >"$dir/stale"
say $? "what the benches found stands in the pages (make tables)"
sed 's/^/# /' "$dir/stale"
# Commands are the same in every language, except in the survey, which test_workflows.py runs in both. Samples of ceduo-output(5)
# are compared with the program by test_pages.py, in both.
for page in $pages; do
    python3 - "$italian/$page" "man/$page" <<'PYTHON'
import re, sys
played = r'^\.\\" (?:run survey|shows output)\n(?:(?!\.Bd|\.\\")[^\n]*\n)*\.Bd -literal.*?^\.Ed$'
pages = [re.sub(played, "", open(p).read(), flags=re.M | re.S) for p in sys.argv[1:]]
blocks = [re.findall(r"^\.Bd -literal.*?^\.Ed$", page, re.M | re.S) for page in pages]
odd = [b for b in blocks[0] if b not in blocks[1] and "\u00e8 sotto" not in b]
if "workflows" in sys.argv[1]:
    odd += [b for b in blocks[1] if b not in blocks[0]]
print(*odd, sep="\n", file=sys.stderr)
sys.exit(odd != [])
PYTHON
    say $? "the commands of it/$page are those of $page"
done
for option in $("${CEDUO:-./ceduo}" --help | sed -nE 's/^  (-(.),|   ) --([a-z-]+).*/\2:\3/p'); do
    letter=${option%%:*}
    grep -qE -- "It Fl ${letter:+$letter , }-${option#*:}( |$)" man/ceduo.1
    say $? "--${option#*:} stands in ceduo.1${letter:+ with -$letter}"
done
[ "$(MANWIDTH=80 mandoc -Tutf8 -O width=80 man/ceduo.1 | wc -l)" -le 600 ]
say $? "ceduo.1 has at most 600 lines"
echo "1..$n"
