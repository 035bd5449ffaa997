#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: quick uncounted unsanitized
"""The rooms of the source: allowed dependencies, outside functions of the library, and its exports."""
import os
import re
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = ROOT / os.environ.get("BUILD", "build/release")

# Each room depends on itself and those named; base on nothing.
KNOWS = {"base": "", "scene": "base", "core": "base scene", "study": "base scene core", "io": "base scene core study",
         "view": "base scene core study io", "api": "base scene core study io view", "model": "base scene core study io",
         "tui": "base scene core study io view model", "cli": "base scene core study io view model tui"}
# The folders of core likewise.
CORE = {"stand": "", "forest": "stand", "walk": "stand forest", "runs": "stand forest walk"}
# Room of each public header; a header can include whatever its room can.
HEADERS = {"scene": "scene", "core": "simulate years", "study": "uncertainty calibrate survey", "api": "ceduo handle"}
SCIENCE = ("scene", "core")  # uses nothing outside
OUTSIDE = re.compile(r"(.*printf|f?open|getenv|setlocale|yaml_.*|initscr|newterm|stdout|stderr|puts|exit|abort|d?c?n?gettext)$")
# A rock is the same on every machine: code that decides its trajectory, or a year's stand, uses only functions
# that round equally everywhere. A file is named by its room, in any of its folders; each energy law is one of them.
TRAJECTORY = ("base/elementary", "scene/rock", "scene/slope", "scene/stand", "core/adc", "core/energy",
              "core/ground", "core/prepared", "core/rotation", "core/run_simulate", "core/stems", "core/trajectory",
              "core/walk", "core/lanes", "core/kernel", "core/kernel_avx2", "core/kernel_avx512", "core/forest")
DIFFERS = re.compile(r"(a?(sin|cos|tan)h?|atan2|sincos|exp(2|10|m1)?|log(2|10|1p)?|pow|[lt]?gamma|cbrt|hypot|erfc?|"
                     r"gsl_(cdf|ran|sf)_.*)[fl]?$")
CC = os.environ.get("CC", "cc")
SANITIZERS = re.compile(r"__(asan|odr|tsan|ubsan)")


def find_room(path):
    if path.parts[0] == "src":
        return path.parts[1]
    return next((room for room, headers in HEADERS.items() if path.stem in headers.split()), "none")


def includes(path):
    """Return the files of the project that `path` includes, relative to ROOT."""
    for name in re.findall(r'^#include "([^"]+)"', (ROOT / path).read_text(), re.M):
        beside, found = path.parent / name, None
        for candidate in (beside, Path("src") / name, Path("include") / name):
            if (ROOT / candidate).is_file():
                found = candidate
                break
        yield found or Path("src") / name


def sources():
    return sorted(p.relative_to(ROOT) for folder in ("src", "include") for p in (ROOT / folder).rglob("*.[ch]"))


def forbidden_includes():
    bad = [f"{path} has no room in HEADERS" for path in sources() if find_room(path) == "none"]
    for path in sources():
        allowed = {find_room(path), *KNOWS.get(find_room(path), "").split()}
        bad += [f"{path} includes {other}" for other in includes(path) if find_room(other) not in allowed]
        if path.parts[:2] == ("src", "core"):
            known = {path.parts[2], *CORE[path.parts[2]].split()}
            bad += [f"{path} includes {other}" for other in includes(path)
                    if other.parts[:2] == ("src", "core") and other.parts[2] not in known]
    return bad


def circles():
    """A .c file and its header are one node; includes form no cycle."""
    knows = defaultdict(set)
    for path in sources():
        knows[path.with_suffix("")] |= {other.with_suffix("") for other in includes(path)} - {path.with_suffix("")}
    bad, done = [], set()

    def visit(node, way):
        if node in way:
            circle = way[way.index(node):]
            first = circle.index(min(circle))
            text = " - ".join(p.name for p in circle[first:] + circle[:first])
            bad.append(f"{circle[0].parent}: {text}")
        elif node not in done:
            for other in sorted(knows[node]):
                visit(other, way + [node])
            done.add(node)

    for node in sorted(knows):
        visit(node, [])
    return sorted(set(bad))


def duplicate_names():
    """Within a room a file name is unique, whatever its folder."""
    found = defaultdict(list)
    for path in sources():
        found[find_room(path), path.name].append(str(path))
    return [" and ".join(paths) for paths in found.values() if len(paths) > 1]


def symbols(what, *files):
    done = subprocess.run(["nm", *what, *map(str, files)], stdout=subprocess.PIPE, check=True, text=True)
    return [line.split() for line in done.stdout.splitlines() if line.split() and not line.endswith(":")]


def forbidden_functions():
    bad = []
    for room in SCIENCE:
        for source in (path for path in sources() if find_room(path) == room and path.suffix == ".c"):
            found = {words[-1] for words in symbols(["-u"], BUILD / source.with_suffix(".o"))}
            bad += [f"{source}: {name}" for name in sorted(found) if OUTSIDE.match(name)]
    return bad


def machine_dependent_symbols():
    named = {f"{find_room(path)}/{path.stem}": path for path in sources() if path.suffix == ".c"}
    laws = [name for name in named if name.startswith("core/energy_")]
    return [f"{named[name]}: {words[-1]}" for name in (*TRAJECTORY, *laws)
            for words in symbols(["-u"], BUILD / named[name].with_suffix(".o")) if DIFFERS.match(words[-1])]


def wrong_exports():
    names = {words[2] for words in symbols(["-g", "--defined-only"], BUILD / "libceduo.a") if len(words) == 3}
    return sorted(name for name in names if not name.startswith("ceduo_") and not SANITIZERS.match(name))


def forbidden_curses():
    return [str(path) for path in sources() if path.stem != "terminal" and
            re.search(r"#include <(ncurses|curses)", (ROOT / path).read_text())]


def unformatted_files():
    """Return the files that clang-format 14 changes, or None with another version: each formats macros differently."""
    version = subprocess.run(["clang-format", "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout
    if " version 14." not in version:
        return None
    files = sorted(str(p) for folder in ("src", "include", "tests", "man") for p in (ROOT / folder).rglob("*.[ch]"))
    done = subprocess.run(["clang-format", "--dry-run", *files], stderr=subprocess.PIPE, text=True, cwd=ROOT)
    return sorted({line.split(":")[0] for line in done.stderr.splitlines() if "warning:" in line} | ({str(done.returncode)} - {"0"}))


def stale_changes():
    """Return the lines of tests/changes.txt that are not unique in their file: their change is no longer tried."""
    sys.path.insert(0, str(ROOT / "tests"))
    from changes import changes
    return [f"{name}: {old}" for name, old, _, _ in changes() if (ROOT / name).read_text(encoding="utf-8").count(old) != 1]


# Lines of a function that hash or list something, and whether they may compile. The key of a run must not hash an address.
COMPILES = """hash_count(&h, n);
hash_count(&h, p);
hash_count(&h, (void *)0);
hash_double(&h, 2.5);
hash_double(&h, p);
hash_doubles(&h, p, n);
hash_doubles(&h, (const double *)p, n);
hash_doubles(&h, &s, n);
hash_doubles(&h, (void *)p, n);
hash_doubles(&h, &p, n);
hash_array(&h, s.row);
hash_array(&h, s.pointer);
hash_array(&h, s.pointers);
hash_each(&h, s.row[0], 1, 2);
hash_each(&h, s.row[0], s.pointer);
h = hash_bytes("abc", 3);
h = hash_bytes(&s, sizeof s);
h = hash_bytes(&p, sizeof p);
static const struct field f[] = {TEXT("title", NAMED(N_("title")), MEMBER(scene_draft, scene.title), NO_RUN, "")};
static const struct field f[] = {TEXT("title", NAMED(N_("title")), MEMBER(scene_draft, scene.title), REQUIRED, "")};
static const struct field f[] = {WORD_LIST("one_of", NAMED(""), LIST(uncertainty_row, one_of, one_of_count), 0, "")};
static const struct field f[] = {FLAG("x", .shown = NAMED(""), MEMBER(ceduo_belt, felled))};
"""
GOOD = (0, 3, 5, 6, 10, 13, 15, 18, 21)


def wrong_compilations():
    bad = []
    for number, line in enumerate(COMPILES.splitlines()):
        unit = ('#include "base/hash.h"\n#include "scene/fields.h"\n'
                "struct some { double row[3], *pointer, *pointers[2]; };\n"
                f"void f(void); void f(void) {{ uint64_t h = HASH_START; size_t n = 3; struct some s = {{0}}; double *p = s.row;\n{line}\n"
                "(void)h, (void)n, (void)s, (void)p; }\n")
        done = subprocess.run([*CC.split(), "-std=c17", "-D_GNU_SOURCE", "-fsyntax-only", "-Wno-unused-variable", "-Iinclude",
                               "-Isrc", "-xc", "-"], input=unit, capture_output=True, text=True, cwd=ROOT, check=False)
        if (done.returncode == 0) != (number in GOOD):
            bad.append(f"{line} {'compiles' if done.returncode == 0 else done.stderr.splitlines()[0]}")
    return bad


def structs_without_default():
    """Return structs of the headers that a caller fills, without a function that returns a default."""
    text = "".join(p.read_text(encoding="utf-8") for p in sorted((ROOT / "include/ceduo").glob("*.h")))
    structs = re.findall(r"^struct (ceduo_(?:\w+_def|request|input|observation)) {", text, re.M)
    defaults = [name for name in structs if re.search(rf"^struct {name} {name}_default\(", text, re.M)]
    members = "".join(re.search(rf"^struct {name} {{.*?^}};", text, re.M | re.S)[0] for name in defaults)
    return [name for name in structs if name not in defaults and f"    struct {name} " not in members]


READS = re.compile(r"(->|\.)((released|reached|exceeded|unfinished|missed|translation|energy_per_released|fence->(above|enough|defeated)|topography|hazard)\b|"
                   r"(energy|speed)\.(mean|se|p\d+)|(reach|exceed)\.(lo|hi))")


def forbidden_readers_of_arrivals():
    """Above the science rooms only two files read struct ceduo_arrivals: the others use a measure."""
    bad = []
    for path in sources():
        if find_room(path) in ("view", "tui", "cli") and path.name not in ("measure.c", "figures_result.c"):
            bad += [f"{path}: {line.strip()}" for line in (ROOT / path).read_text().splitlines() if READS.search(line)]
    return bad


def main():
    tests = [("no hash of a pointer or struct compiles", wrong_compilations),
             ("each struct that a caller fills has a default", structs_without_default),
             ("each room includes only rooms below it", forbidden_includes), ("includes form no cycle", circles),
             ("file names are unique within a room", duplicate_names), ("scene and core call no function outside the library", forbidden_functions),
             ("a rock's trajectory calls no function that differs between machines", machine_dependent_symbols),
             ("every exported symbol begins with ceduo_", wrong_exports), ("only one file includes curses", forbidden_curses),
             ("clang-format 14 changes no file", unformatted_files), ("each line of changes.txt is unique in its file", stale_changes),
             ("only two files of the upper rooms read arrivals", forbidden_readers_of_arrivals)]
    failed = 0
    for number, (name, test) in enumerate(tests, 1):
        bad = test()
        failed += bool(bad)
        print(f"{'not ok' if bad else 'ok'} {number} - {name}" + (" # SKIP another version is installed" if bad is None else ""))
        for line in bad or ():
            print(f"# {line}")
    print(f"1..{len(tests)}")
    sys.exit(failed > 0)


if __name__ == "__main__":
    main()
