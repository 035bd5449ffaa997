#!/bin/sh
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks the packages of `make deb`: lintian reports nothing; they are installed, used and purged, and leave nothing. Status 77:
# not possible here; prints the reason.
set -eu

skip() {
    echo "skipped: $1"
    exit 77
}

fail() {
    echo "FAILED: $1" >&2
    exit 1
}

[ "$(id -u)" = 0 ] || skip "packages are installed by root"
command -v lintian >/dev/null || skip "lintian is not installed"
! dpkg-query -W -f '${Status}' ceduo 2>/dev/null | grep -q installed || skip "a package ceduo is installed here"

set -- build/deb/ceduo_*.deb build/deb/libceduo1_*.deb build/deb/libceduo-dev_*.deb
[ -f "$3" ] || fail "no packages in build/deb; run make deb"
lintian --allow-root --fail-on error,warning build/deb/*.changes "$@"

work=$(mktemp -d)
trap 'dpkg --purge ceduo libceduo-dev libceduo1 >/dev/null 2>&1 || :; rm -rf "$work"' EXIT
DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "./$1" "./$2" "./$3" >"$work/apt.log" 2>&1 ||
    { cat "$work/apt.log"; fail "apt-get install"; }
dpkg -L ceduo libceduo-dev libceduo1 | while read -r path; do [ -d "$path" ] || echo "$path"; done >"$work/files"

# used without the sources
cd "$work"
export HOME="$work" XDG_DATA_HOME="$work/share" LC_ALL=C.UTF-8
program=/usr/bin/ceduo
$program --batch -n 100 paper-site | grep -q 'HOW SURE' || fail "the page of the paper's site"
$program --list-profiles | grep -q '/usr/share/ceduo/rules/toscana.yaml$' || fail "profiles"
cp /usr/share/ceduo/surveys/six-plots.csv .
$program --survey six-plots.csv -o stand.yaml
grep -q '^  - {path: stools.per_ha' stand.yaml || fail "the stand of a survey"
$program --language it --help >it; $program --help >en
! cmp -s it en || fail "translations"
[ -x /usr/share/ceduo/jobs/ceduo-array.sbatch ] || fail "the job for Slurm"
for page in ceduo.1 ceduo-output.5 ceduo-scene.5 ceduo-terminal.7 ceduo-workflows.7 ceduo.3; do
    [ -f "/usr/share/man/man${page##*.}/$page.gz" ] || fail "$page"
done
bash -c '. /usr/share/bash-completion/completions/ceduo && complete -p ceduo' >/dev/null || fail "completion"
[ -f /usr/share/zsh/vendor-completions/_ceduo ] || fail "completion of zsh"
printf '#include <ceduo/ceduo.h>\nint main(void) { struct ceduo_scene_file r; return ceduo_scene_read("paper-site", NULL, &r); }\n' >use.c
${CC:-gcc} -std=c17 use.c $(pkg-config --cflags --libs ceduo) -o use && ./use || fail "the shared library"
readelf -d use | grep -q 'NEEDED.*\[libceduo.so.1\]' || fail "the name of the shared library"
${CC:-gcc} -std=c17 -static use.c $(pkg-config --static --cflags --libs ceduo) -o use && ./use || fail "the static library"

if command -v g++ >/dev/null; then
    g++ -std=c++17 -x c++ use.c $(pkg-config --cflags --libs ceduo) -o use && ./use || fail "a program in C++"
fi
export PYTHONPATH=/usr/share/ceduo/examples PYTHONDONTWRITEBYTECODE=1
/usr/bin/python3 -c 'import ceduo
with ceduo.Scene("paper-site") as scene:
    scene.simulate(100)
    assert len(scene.samples("energy_kJ")) == 100' || fail "the module for Python"
if command -v R >/dev/null; then
    cp /usr/share/ceduo/examples/ceduo.R /usr/share/ceduo/examples/ceduo_r.c .
    PKG_CPPFLAGS=$(pkg-config --cflags ceduo) PKG_LIBS=$(pkg-config --libs ceduo) R CMD SHLIB ceduo_r.c >R.log 2>&1 || fail "$(cat R.log)"
    Rscript -e 'source("ceduo.R"); s <- ceduo_open("paper-site"); ceduo_simulate(s, 100)
        stopifnot(length(ceduo_samples(s, "energy_kJ")) == 100)' || fail "R"
fi

dpkg --purge ceduo libceduo-dev libceduo1 >/dev/null
while read -r path; do [ ! -e "$path" ] || fail "left behind: $path"; done <files
[ ! -e /usr/share/ceduo ] || fail "left behind: /usr/share/ceduo"
echo "installed, used and purged: $(wc -l <files) files"
