# SPDX-License-Identifier: GPL-3.0-or-later
"""A scene of three files that the tests of bad input change, and the expected parts of a message: place, line, caret."""
import re
from pathlib import Path

from harness import INPUT, ceduo, children_seconds, expect, expect_equal

SCENE = """\
ceduo: scene/1
title: small
rock: {shape: sphere, diameter_m: 0.5}
release: {x_m: 5, height_m: 0, vx_m_s: 1}
slope: slope.yaml
controls:
  - {x_m: 75, name: road, accepted_kJ: 50}
  - {x_m: 90}
forest:
  - from_m: 10
    to_m: 40
    stand: stand.yaml
  - {from_m: 40, to_m: 70, stand: {base: stand.yaml, name: second}}
simulation: {law: lumped, rocks: 20, seed: 1, scale_rn: false}
"""
SLOPE = """\
ceduo: slope/1
name: line
facets: against
vertices_m: [[0, 64], [50, 30], [100, 0]]
segments:
  - {rn: 0.35, rt: 0.87, roughness_rad: 0.1, friction: 0.5}
  - {rn: 0.31, rt: 0.83, roughness_m: 0.1}
"""
STAND = """\
ceduo: stand/1
name: first
system: simple-coppice
species: ostrya-carpinifolia
stools: {per_ha: 2000, spacing_m: 0.25}
shoots:
  - per_ha: 5000
    dbh_m: 0.07
    height_m: 6
trees:
  - {per_ha: 100, dbh_m: 0.2, height_m: 12, volume_m3: 0.2}
energy: {model: brauner, u_J_m3: 102800}
source: {kind: measured, text: by hand}
"""
FILES = {"scene.yaml": SCENE, "slope.yaml": SLOPE, "stand.yaml": STAND}

PLACE = re.compile(r"(.+?):(\d+):(\d+): (.*)")


def safe(text):
    """A line as the program may show it: what is no printable character as \\xNN."""
    return "".join(c if c.isprintable() or c == "\ufeff" else "".join(f"\\x{b:02x}" for b in c.encode()) for c in
                   text.replace("\t", " "))


def expect_places(err, contents):
    """Expect a line and a caret below the right character for each problem in a known file. Returns the problems."""
    lines, i, found = err.splitlines(), 0, []
    while i < len(lines):
        place = PLACE.fullmatch(lines[i])
        i += 1
        if not place:
            found.append((None, 0, 0, lines[i - 1]))
            continue
        name, line, column = place[1], int(place[2]), int(place[3])
        found.append((name, line, column, place[4]))
        source = contents.get(Path(name).name)
        if source is None:
            continue
        rows = source.replace("\r\n", "\n").split("\n")
        if (line, column) == (len(rows) + 1, 1):  # end of the file; tested by test_unclosed
            continue
        expect(1 <= line <= len(rows), f"line {line} of {len(rows)}:", err)
        mark = line == 1 and source.startswith("\ufeff")  # takes no column
        row = rows[line - 1][1:] if mark else rows[line - 1]
        expect(1 <= column <= len(row) + 1, f"column {column} of {len(row)}:", err)
        if row == "":  # nothing to show
            continue
        shown = safe(row)[:20] if line == 1 else ""
        known = name.endswith(".csv") or re.search("ceduo[\"' :]*[a-z]+/[0-9]", source[:4096])
        if not known and shown != safe(row):  # an unrecognized file is shown no further
            expect(lines[i].startswith(f"  {shown}… (nothing says"), "the beginning is missing:", err)
            i += 1 + (lines[i + 1:i + 2] != [] and lines[i + 1].strip() == "^")
            continue
        expect(i + 1 < len(lines) and lines[i].startswith("  ") and lines[i + 1].strip() == "^",
               "the line and a caret are missing:", err)
        shown, caret = lines[i].replace("\ufeff", "", 1) if mark else lines[i], lines[i + 1]
        if column <= 100:
            expect(shown.startswith("  " + safe(row)[:90]), "another line is shown:", repr(shown), repr(row), err)
            expect_equal(len(caret) - 1, 2 + len(safe(row[:column - 1]).replace("\ufeff", "")), "caret" + "\n" + err)
        else:  # a long line is shown partly: the right character is above the caret
            expect(len(shown) <= 420, "too long a line is shown")
            here = safe(row[column - 1:column])
            expect(here == "" or shown[len(caret) - 1:].startswith(here), "caret", err)
        i += 2
    return found


MODES = ("--check", "--batch")


def check(folder, path, *arguments, modes=MODES, **options):
    """Expect status 3, nothing on stdout, within 20 s of processor time, for --check and for a run."""
    for mode in modes:
        before = children_seconds()
        done = ceduo(mode, *arguments, path, cwd=folder.path, **options)
        expect(done.status == INPUT and done.out == "" and done.err != "", done)
        expect(children_seconds() - before < 20, f"{children_seconds() - before:.1f} s of processor", done)
    return done


def mutated(name, old, new):
    """Return the three files with a change in one; '@@' in the new text marks the place of the error."""
    expect_equal(FILES[name].count(old), 1, f"{old!r} in {name}")
    text, place = FILES[name].replace(old, new), None
    if "@@" in text:
        before = text[:text.index("@@")]
        place = (before.count("\n") + 1, len(before) - before.rfind("\n"))
        text = text.replace("@@", "")
    return {**FILES, name: text}, place


def flat_scene():
    """Return the scene in one file."""
    return SCENE.replace("slope: slope.yaml", "slope: {vertices_m: [[0, 64], [100, 0]], segments: [{rn: 0.3, rt: 0.8}]}"
                         ).split("forest:")[0].encode()
