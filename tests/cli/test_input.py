#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input: every fault is named with file, line, column, path and mend, its line shown with a caret below it."""
import os
import pty
import random
import re
import resource
import socket
import subprocess
import sys
import time
from functools import partial
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import (CEDUO, DONE, INPUT, OUTPUT, PROFILES, SANITIZED, SLOWER, USAGE, Failure, Folder, Skip, Suite, ceduo,
                     environment, expect, expect_equal, expect_in, expect_near, good, result, scene, stand, tests_of, together,
                     wooded_scene)

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
FEW = re.compile(r"\d+ more problems?")


def safe(text):
    """A line as the program may show it: what is no printable character as \\xNN."""
    return "".join(c if c.isprintable() or c == "\ufeff" else "".join(f"\\x{b:02x}" for b in c.encode()) for c in
                   text.replace("\t", " "))


def expect_places(err, contents):
    """Every problem of a known file has its line and a caret below the right character. Returns the problems."""
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
        if (line, column) == (len(rows) + 1, 1):  # the end of the file; test_unclosed looks at it
            continue
        expect(1 <= line <= len(rows), f"line {line} of {len(rows)}:", err)
        mark = line == 1 and source.startswith("\ufeff")  # takes no column
        row = rows[line - 1][1:] if mark else rows[line - 1]
        expect(1 <= column <= len(row) + 1, f"column {column} of {len(row)}:", err)
        if row == "":  # nothing to show
            continue
        expect(i + 1 < len(lines) and lines[i].startswith("  ") and lines[i + 1].strip() == "^",
               "the line and a caret are missing:", err)
        shown, caret = lines[i].replace("\ufeff", "", 1) if mark else lines[i], lines[i + 1]
        if column <= 100:
            expect(shown.startswith("  " + safe(row)[:90]), "another line is shown:", repr(shown), repr(row), err)
            expect_equal(len(caret) - 1, 2 + len(safe(row[:column - 1])), "caret" + "\n" + err)
        else:  # a long line is shown in part: the right character stands above the caret
            expect(len(shown) <= 420, "too long a line is shown")
            here = safe(row[column - 1:column])
            expect(here == "" or shown[len(caret) - 1:].startswith(here), "caret", err)
        i += 2
    return found


MODES = ("--check", "--batch")


def check(folder, path, *arguments, modes=MODES, **options):
    """A bad scene: status 3, nothing on stdout, within 5 s, both to check and to run."""
    for mode in modes:
        done = ceduo(mode, *arguments, path, cwd=folder.path, timeout=60, **options)
        expect(done.status == INPUT and done.out == "" and done.err != "", done)
        expect(done.seconds < 20, f"{done.seconds:.1f} s", done)
    return done


def mutated(name, old, new):
    """The three files with a change in one; '@@' in the new text marks the place of the fault."""
    expect_equal(FILES[name].count(old), 1, f"{old!r} in {name}")
    text, place = FILES[name].replace(old, new), None
    if "@@" in text:
        before = text[:text.index("@@")]
        place = (before.count("\n") + 1, len(before) - before.rfind("\n"))
        text = text.replace("@@", "")
    return {**FILES, name: text}, place


def refused(name, old, new, *words):
    files, place = mutated(name, old, new)
    with Folder() as f:
        for file, text in files.items():
            f.write(file, text)
        done = check(f, "scene.yaml")
        problems = expect_places(done.err, files)
        mine = [p for p in problems if p[0] and Path(p[0]).name == name]
        expect(mine, f"no problem in {name}", done)
        if place:
            mine = [p for p in mine if p[1:3] == place]
            expect(mine, f"no problem at {name}:{place[0]}:{place[1]}", done)
        expect(any(all(w in p[3] for w in words) for p in mine), f"none says {words}", done)


CASES = [
    # (file, what is there, what stands there instead, words of the message); @@ is where the caret stands
    ("scene.yaml", "release: {x_m", "release:\n@@\tx_m: 5\nextra: {x_m", "tab"),
    ("scene.yaml", "title: small", "title: @@*small", "an alias"),
    ("scene.yaml", "title: small", "title: @@&t small", "an anchor"),
    ("scene.yaml", "title: small", "title: @@!!str small", "a tag"),
    ("scene.yaml", "rock: {shape", "rock: @@&rock {shape", "an anchor"),
    ("scene.yaml", "rock: {shape", "rock: @@!rock {shape", "a tag"),
    ("scene.yaml", "controls:\n", "controls: @@&c\n", "an anchor"),
    ("scene.yaml", "simulation: {", "@@title: again\nsimulation: {", "title", "given twice", "line 2"),
    ("scene.yaml", "diameter_m: 0.5}", "diameter_m: 0.5, @@diameter_m: 0.6}", "diameter_m", "given twice"),
    ("scene.yaml", "title: small", "@@titel: small", "titel: unknown key", "'title'"),
    ("scene.yaml", "height_m: 0, vx", "@@heigth_m: 0, vx", "release.heigth_m: unknown key", "'height_m'"),
    ("stand.yaml", "dbh_m: 0.07", "@@dbh: 0.07", "shoots[0].dbh: unknown key", "'dbh_m'"),
    ("stand.yaml", "stools: {per_ha", "stools: {@@perha", "stools.perha: unknown key", "'per_ha'"),
    ("slope.yaml", "facets: against", "@@facet: against", "facet: unknown key", "'facets'"),
    ("scene.yaml", "{x_m: 90}", "{x_m: 90, @@qqqqqqqqqqqqqqqqq: 1}", "controls[1].qqqqqqqqqqqqqqqqq: unknown key", "known here: x_m"),
    ("stand.yaml", "text: by hand", "@@texts: by hand", "source.texts: unknown key"),
    ("stand.yaml", "kind: measured", "kind: @@guessed", "source.kind: 'guessed' is unknown"),
    ("stand.yaml", "text: by hand", "except: @@stools", "source.except: a list of keys is wanted"),
    ("stand.yaml", "text: by hand", "except: [@@[stools]]", "source.except: a key is wanted here, not a list"),
    ("scene.yaml", "ceduo: scene/1\n", "", "'ceduo' is missing"),
    ("scene.yaml", "ceduo: scene/1", "ceduo: @@scene/2", "'scene/1' is wanted"),
    ("scene.yaml", "ceduo: scene/1", "ceduo: @@stand/1", "'scene/1' is wanted"),
    ("slope.yaml", "ceduo: slope/1", "ceduo: @@stand/1", "'slope/1' is wanted"),
    ("stand.yaml", "ceduo: stand/1", "ceduo: @@slope/1", "'stand/1' is wanted"),
    ("scene.yaml", "rock: {shape: sphere, diameter_m: 0.5}\n", "", "'rock' is missing"),
    ("scene.yaml", "slope: slope.yaml\n", "", "'slope' is missing"),
    ("scene.yaml", "controls:\n  - {x_m: 75, name: road, accepted_kJ: 50}\n  - {x_m: 90}\n", "", "'controls' is missing"),
    ("scene.yaml", "controls:\n  - {x_m: 75, name: road, accepted_kJ: 50}\n  - {x_m: 90}\n", "controls: []\n", "'controls' is missing"),
    ("scene.yaml", "  - {x_m: 90}", "  - @@{name: x}", "controls[1]: 'x_m' is missing"),
    ("scene.yaml", "  - {x_m: 90}", "  - @@{}", "controls[1]: 'x_m' is missing"),
    ("scene.yaml", "    to_m: 40\n", "", "'to_m' is missing"),
    ("scene.yaml", "{from_m: 40, to_m: 70, stand: {base: stand.yaml, name: second}}", "@@{from_m: 40, to_m: 70}", "forest[1]: 'stand' is missing"),
    ("stand.yaml", "    height_m: 6\n", "", "shoots[0]: 'height_m' is missing"),
    ("stand.yaml", ", spacing_m: 0.25", "", "stools: 'spacing_m' is missing"),
    ("slope.yaml", "{rn: 0.35, ", "{", "segments[0]: 'rn' is missing"),
    ("slope.yaml", "vertices_m: [[0, 64], [50, 30], [100, 0]]\n", "", "'vertices_m' is missing"),
    ("scene.yaml", "simulation: {", "@@---\nsimulation: {", "second document"),
    ("stand.yaml", "energy: {", "@@---\nenergy: {", "second document"),
    # numbers
    ("scene.yaml", "diameter_m: 0.5", "diameter_m: @@'0.5'", "rock.diameter_m: '0.5' is in quotes"),
    ("scene.yaml", "diameter_m: 0.5", 'diameter_m: @@"0.5"', "rock.diameter_m: '0.5' is in quotes"),
    ("stand.yaml", "dbh_m: 0.07", "dbh_m: @@0,07", "'0,07' is no number", "dot"),
    ("stand.yaml", "dbh_m: 0.07", "dbh_m: @@-0.07", "shoots[0].dbh_m: -0.07 is below 0 m"),
    ("stand.yaml", "dbh_m: 0.07", "dbh_m: @@0", "shoots[0].dbh_m: 0 is not above 0 m"),
    ("stand.yaml", "dbh_m: 0.07", "dbh_m: @@7000", "shoots[0].dbh_m: 7000 is above"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@5_000", "'5_000' is no number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@0x10", "'0x10' is no number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@010", "'010' is no number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@0o10", "'0o10' is no number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@1:30", "'1:30' is no number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@inf", "'inf' is no number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@.inf", "'.inf' is no number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@-.inf", "'-.inf' is no number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@nan", "'nan' is no number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@.nan", "'.nan' is no number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@1e999", "too large"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@-1e999", "too large"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@" + "9" * 400, "too large"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@5000 m", "'5000 m' is no number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@1e", "'1e' is no number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@.", "'.' is no number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@+-5", "'+-5' is no number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@５０００", "is no number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@true", "'true' is no number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@~", "'~' is no number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@null", "'null' is no number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@[5000]", "a number is wanted here, not a list"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@{mean: 5000}", "a number is wanted here, not a mapping"),
    ("stand.yaml", "per_ha: 5000\n", "per_ha:\n", "shoots[0].per_ha", "is no number"),
    ("scene.yaml", "rocks: 20", "rocks: @@1.5", "simulation.rocks: '1.5' is no whole number"),
    ("scene.yaml", "rocks: 20", "rocks: @@0", "simulation.rocks: 0 is below 1"),
    ("scene.yaml", "rocks: 20", "rocks: @@1e8", "simulation.rocks", "is above 10000000"),
    ("scene.yaml", "seed: 1", "seed: @@-1", "simulation.seed: -1 is below 0"),
    ("scene.yaml", "seed: 1", "seed: @@1e16", "simulation.seed", "is above"),
    ("slope.yaml", "rn: 0.35", "rn: @@1.5", "segments[0].rn: 1.5 is above 1"),
    ("slope.yaml", "friction: 0.5", "friction: @@-0.5", "segments[0].friction: -0.5 is below 0"),
    ("slope.yaml", "roughness_rad: 0.1", "roughness_rad: @@1.6", "segments[0].roughness_rad: 1.6 is above"),
    ("scene.yaml", "height_m: 0, vx", "height_m: @@-1, vx", "release.height_m: -1 is below 0 m"),
    ("scene.yaml", "law: lumped", "law: lumped, threshold_m: @@0", "simulation.threshold_m: 0 is not above 0 m"),
    ("scene.yaml", "law: lumped", "law: lumped, gravity_m_s2: @@-9.81", "simulation.gravity_m_s2: -9.81 is below 0"),
    ("stand.yaml", "u_J_m3: 102800", "u_J_m3: @@0", "energy.u_J_m3: 0 is not above 0"),
    # kinds and words
    ("scene.yaml", "rock: {shape: sphere, diameter_m: 0.5}", "rock: @@0.5", "rock: a mapping is wanted here, not a single value"),
    ("scene.yaml", "rock: {shape: sphere, diameter_m: 0.5}", "rock: @@[0.5]", "rock: a mapping is wanted here, not a list"),
    ("scene.yaml", "title: small", "title: @@{a: 1}", "title: a text is wanted here, not a mapping"),
    ("scene.yaml", "  - {x_m: 90}", "  - @@90", "controls[1]: a mapping is wanted"),
    ("slope.yaml", "vertices_m: [[0, 64], [50, 30], [100, 0]]", "vertices_m: @@0", "vertices_m: a list is wanted"),
    ("slope.yaml", "[50, 30]", "@@[50]", "vertices_m[1]: a pair [x, z] is wanted"),
    ("slope.yaml", "[50, 30]", "@@[50, 30, 2]", "vertices_m[1]: a pair [x, z] is wanted"),
    ("slope.yaml", "[50, 30]", "[50, @@x]", "vertices_m[1]: 'x' is no number"),
    ("stand.yaml", "trees:\n", "trees: @@{}\nextra:\n", "trees: a list is wanted here, not a mapping"),
    ("scene.yaml", "slope: slope.yaml", "slope: @@[slope.yaml]", "slope: a mapping is wanted here, not a list"),
    ("scene.yaml", "stand: stand.yaml\n", "stand: @@[stand.yaml]\n", "a mapping is wanted here, not a list"),
    ("scene.yaml", "scale_rn: false", "scale_rn: @@no", "simulation.scale_rn: 'no': true or false is wanted"),
    ("scene.yaml", "scale_rn: false", "scale_rn: @@'true'", "true or false is wanted"),
    ("scene.yaml", "law: lumped", "law: @@lumpd", "'lumpd' is unknown", "did you mean 'lumped'", "crsp"),
    ("scene.yaml", "law: lumped", "law: lumped, rule: @@eq6", "'eq6' is unknown", "interception"),
    ("scene.yaml", "law: lumped", "law: lumped, contact_model: @@pinball", "'pinball' is unknown"),
    ("scene.yaml", "shape: sphere", "shape: @@cube", "rock.shape: 'cube' is unknown", "cylinder"),
    ("stand.yaml", "system: simple-coppice", "system: @@coppice", "'coppice' is unknown"),
    ("stand.yaml", "species: ostrya-carpinifolia", "species: @@ostrya", "'ostrya' is unknown", "ostrya-carpinifolia"),
    ("stand.yaml", "model: brauner", "model: @@browner", "'browner' is unknown", "brauner"),
    ("slope.yaml", "facets: against", "facets: @@with", "'with' is unknown", "both"),
    ("stand.yaml", "source: {kind: measured, text: by hand}", "source: @@by hand", "source", "a mapping"),
    ("stand.yaml", "source: {kind: measured, text: by hand}", "source: @@{text: by hand}", "'kind' is missing"),
    # rock
    ("scene.yaml", "diameter_m: 0.5}", "diameter_m: 0.5, volume_m3: 1}", "rock", "one of diameter_m, volume_m3 and mass_kg"),
    ("scene.yaml", "shape: sphere, diameter_m: 0.5}", "shape: sphere}", "rock", "one of diameter_m, volume_m3 and mass_kg"),
    ("scene.yaml", "diameter_m: 0.5}", "diameter_m: 0.5, height_m: @@1}", "rock.height_m", "does not belong"),
    ("scene.yaml", "shape: sphere", "shape: cylinder", "'height_m' is missing"),
    ("scene.yaml", "{shape: sphere, diameter_m: 0.5}", "{shape: block, axes_m: @@[1, 2]}", "three numbers"),
    ("scene.yaml", "{shape: sphere, diameter_m: 0.5}", "{shape: block, axes_m: [1, @@-2, 3]}", "rock.axes_m[1]: -2 is below 0 m"),
    ("scene.yaml", "{shape: sphere, diameter_m: 0.5}", "{shape: block, axes_m: [1, 2, 3], mass_kg: 5, density_kg_m3: @@2600}", "keep one"),
    # spreads
    ("scene.yaml", "diameter_m: 0.5}", "diameter_m: @@{spread: 0.1}}", "rock.diameter_m: 'mean' is missing"),
    ("scene.yaml", "diameter_m: 0.5}", "diameter_m: {mean: 0.5, spread: @@-0.1}}", "rock.diameter_m.spread: -0.1 is below 0"),
    ("scene.yaml", "diameter_m: 0.5}", "diameter_m: @@{mean: 0.5, spread: 0.2}}", "rock.diameter_m: the spread reaches from", "make it smaller"),
    ("scene.yaml", "diameter_m: 0.5}", "diameter_m: @@{mean: 0.5, spread: 0.5, kind: uniform}}", "the spread reaches from 0 to 1"),
    ("scene.yaml", "diameter_m: 0.5}", "diameter_m: {mean: 0.5, spread: 0.1, kind: @@gamma}}", "'gamma' is unknown", "normal"),
    ("scene.yaml", "diameter_m: 0.5}", "diameter_m: {mean: 0.5, @@sd: 0.1}}", "rock.diameter_m.sd: unknown key"),
    ("scene.yaml", "height_m: 0, vx", "height_m: @@{mean: 1, spread: 2, kind: uniform}, vx", "release.height_m: the spread reaches from -1"),
    ("scene.yaml", "vx_m_s: 1}", "vx_m_s: @@{mean: 1, spread: 1e6}}", "release.vx_m_s: the spread reaches"),
    ("scene.yaml", "{x_m: 5, h", "{x_m: @@{mean: 5, spread: 6, kind: uniform}, h", "release.x_m", "beyond the slope"),
    ("scene.yaml", "x_m: 75, name", "x_m: @@{mean: 75, spread: 1}, name", "a number is wanted here, not a mapping"),
    # slope
    ("slope.yaml", "[50, 30]", "@@[0, 30]", "vertices_m[1]: x 0 does not lie beyond 0", "x must rise"),
    ("slope.yaml", "[50, 30]", "@@[-50, 30]", "vertices_m[1]: x -50 does not lie beyond 0", "small run"),
    ("slope.yaml", "[[0, 64], [50, 30], [100, 0]]", "@@[[0, 64]]", "two vertices"),
    ("slope.yaml", "[[0, 64], [50, 30], [100, 0]]", "@@[]", "two vertices"),
    ("slope.yaml", "[50, 30], ", "[50, 30], [60, 20], ", "segments", "2 segments for 3 stretches", "one for all"),
    ("slope.yaml", "[50, 30], ", "[50, @@1e10], ", "vertices_m[1]: 10000000000 is above"),
    ("slope.yaml", "roughness_m: 0.1", "roughness_m: @@0.1, roughness_rad: 0.1", "segments[1].roughness_m", "keep one"),
    ("slope.yaml", "segments:\n", "materials: @@[{from_m: 0, to_m: 100, material: talus}]\nsegments:\n", "materials", "keep one"),
    # release, controls
    ("scene.yaml", "{x_m: 5, h", "{x_m: @@-1, h", "release.x_m: -1 lies beyond the slope"),
    ("scene.yaml", "{x_m: 5, h", "{x_m: @@100, h", "release.x_m: 100 lies beyond the slope"),
    ("scene.yaml", "{x_m: 90}", "{x_m: @@100.5}", "controls[1].x_m: 100.5 lies beyond the slope", "100 m"),
    ("scene.yaml", "{x_m: 90}", "{x_m: @@5}", "controls[1].x_m: 5 does not lie beyond the release"),
    ("scene.yaml", "{x_m: 90}", "{x_m: @@75}", "controls[1].x_m: 75 is given twice"),
    ("scene.yaml", "forest:\n", "controls_m: @@[80]\nforest:\n", "controls_m", "keep one"),
    # belts and stands
    ("scene.yaml", "{from_m: 40, to_m: 70", "{from_m: @@39, to_m: 70", "forest[1].from_m: 39 lies before the end", "overlap"),
    ("scene.yaml", "{from_m: 40, to_m: 70", "{from_m: 40, to_m: @@40", "forest[1].to_m: 40 does not lie beyond from_m"),
    ("scene.yaml", "{from_m: 40, to_m: 70", "{from_m: 40, to_m: @@101", "forest[1].to_m: 101 lies beyond the slope"),
    ("scene.yaml", "  - from_m: 10\n", "  - from_m: @@-1\n", "forest[0].from_m: -1 lies before the slope"),
    ("scene.yaml", "simulation: {", "options: [{name: a}]\nsimulation: {", "forest", "keep one"),
    ("stand.yaml", "per_ha: 5000", "per_ha: 1999", "stools.per_ha", "1999 shoots on 2000 stools"),
    ("stand.yaml", "stools: {per_ha: 2000, spacing_m: 0.25}\n", "", "shoots without stools"),
    ("stand.yaml", "shoots:\n  - per_ha: 5000\n    dbh_m: 0.07\n    height_m: 6\n", "", "stools without shoots"),
    ("stand.yaml", "system: simple-coppice", "system: @@bare", "system: 'bare', but there are stems"),
    ("stand.yaml", "ceduo: stand/1\n", "ceduo: stand/1\nbase: @@nothing.yaml\n", "cannot find 'nothing.yaml'"),
    ("stand.yaml", "ceduo: stand/1\n", "ceduo: stand/1\nbase: @@[a]\n", "base: a path to a file is wanted"),
    ("scene.yaml", "slope: slope.yaml", "slope: @@nothing.yaml", "slope: cannot find 'nothing.yaml'"),
    ("scene.yaml", "stand: stand.yaml\n", "stand: @@nothing.yaml\n", "stand: cannot find 'nothing.yaml'"),
    ("scene.yaml", "slope: slope.yaml", "slope: @@nothing.csv", "cannot find 'nothing.csv'"),
    # YAML itself
    ("scene.yaml", "title: small", "title: a@@: b", "malformed YAML"),
    ("scene.yaml", "title: small", "title: @@@small", "quotes"),
    ("scene.yaml", "title: small", "title: @@`small", "quotes"),
    ("scene.yaml", "title: small", "title: 'small", "malformed YAML"),
    ("scene.yaml", "scale_rn: false}", "scale_rn: false", "malformed YAML"),
    ("scene.yaml", "title: small", "? @@[a]\n: small", "plain word"),
    ("scene.yaml", "title: small", "title: small\n<<: {a: 1}", "unknown key"),
    ("scene.yaml", "title: small", "title: üüü\n@@tïtel: 1", "unknown key"),
    ("scene.yaml", "title: small", 'title: "\\e[31m"\n@@"\\e[2J": 1', "\\x1b[2J: unknown key"),
    ("scene.yaml", "name: road, ", 'name: "\\e[31mroad", @@what: 1, ', "unknown key"),
    ("scene.yaml", "law: lumped", 'law: @@"\\e[31m"', "'\\x1b[31m' is unknown"),
    ("scene.yaml", "name: second", 'name: "\\u202egnp.exe", @@b: 1', "unknown key"),
    ("scene.yaml", "name: road, ", "name: " + "road " * 40 + ", @@what: 1, ", "unknown key"),
    ("scene.yaml", "title: small", "title: " + "[" * 15 + "@@[" + "]" * 16, "levels deep"),
]


def test_good():
    """The scene that the cases change is good itself"""
    with Folder() as f:
        for name, text in FILES.items():
            f.write(name, text)
        good("--check", "scene.yaml", cwd=f.path)
        run = result("scene.yaml", cwd=f.path)
        expect_equal([s["name"] for s in run["options"][0]["stands"]], ["first", "second"])


def test_message_whole():
    """A message is file:line:col, path, mend, the source line, a caret"""
    files, _ = mutated("stand.yaml", "dbh_m: 0.07", "dbh_m: -0.07")
    with Folder() as f:
        for name, text in files.items():
            f.write(name, text)
        done = ceduo("--check", "scene.yaml", cwd=f.path)
        wanted = "stand.yaml:8:12: shoots[0].dbh_m: -0.07 is below 0 m\n      dbh_m: -0.07\n             ^\n"
        expect(done.err.startswith(wanted), done)
        f.write("stand.yaml", STAND)
        f.write("scene.yaml", SCENE.replace("  - {x_m: 90}", "  - {x_m: 90} # Überlauf → hier").replace(
            "accepted_kJ: 50", "accepted_kJ: -50"))
        done = ceduo("--check", f.path / "scene.yaml", cwd="/")
        expect_equal(done.err, f"{f.path}/scene.yaml:7:40: controls[0].accepted_kJ: -50 is below 0 kJ\n"
                     "    - {x_m: 75, name: road, accepted_kJ: -50}\n" + " " * 41 + "^\n")


def test_same_fault_once():
    """A fault in a file that two belts share is reported once"""
    files, _ = mutated("stand.yaml", "dbh_m: 0.07", "dbh_m: -0.07")
    with Folder() as f:
        for name, text in files.items():
            f.write(name, text)
        f.write("scene.yaml", SCENE.replace("{base: stand.yaml, name: second}", "stand.yaml"))
        lines = [line for line in ceduo("--check", "scene.yaml", cwd=f.path).err.splitlines() if "is below" in line]
        expect_equal(lines, ["stand.yaml:8:12: shoots[0].dbh_m: -0.07 is below 0 m"])


# ---- bytes ----

def bytes_refused(data, *words, place=None):
    with Folder() as f:
        f.write("s.yaml", data)
        done = check(f, "s.yaml")
        expect(all(w in done.err for w in words), f"none says {words}", done)
        if place:
            expect(done.err.startswith(f"s.yaml:{place[0]}:{place[1]}: "), f"not at {place}", done)
    return done


def flat_scene():
    """The scene in one file."""
    return SCENE.replace("slope: slope.yaml", "slope: {vertices_m: [[0, 64], [100, 0]], segments: [{rn: 0.3, rt: 0.8}]}"
                         ).split("forest:")[0].encode()


def test_line_ends():
    """CRLF, a byte order mark, no last line end: good; a fault behind them stands at the right place"""
    text = flat_scene()
    with Folder() as f:
        for data in (text, text.replace(b"\n", b"\r\n"), b"\xef\xbb\xbf" + text, text.rstrip(b"\n"),
                     b"\xef\xbb\xbf" + text.replace(b"\n", b"\r\n"), b"%YAML 1.1\n---\n" + text, text + b"...\n",
                     b"# \xc3\xbc comment\n" + text):
            good("--check", f.write("s.yaml", data))
    bad = text.replace(b"diameter_m: 0.5", b"diameter_m: x")
    for data in (bad, bad.replace(b"\n", b"\r\n"), b"\xef\xbb\xbf" + bad):
        done = bytes_refused(data, "'x' is no number", place=(3, 35))
        expect_places(done.err, {"s.yaml": data.decode()})
    data = b"\xef\xbb\xbfrock: 5\n"
    expect_places(bytes_refused(data, "a mapping is wanted", place=(1, 7)).err, {"s.yaml": data.decode()})


def test_unclosed():
    """A bracket or quote that is never closed is shown with a line of the file and a caret"""
    for data in (b"rock: [", b"rock: {a: 1\n", b"title: 'small\n", b'title: "small', flat_scene() + b"more: {a: 1,\n\n"):
        done = bytes_refused(data)
        place = PLACE.match(done.err)
        expect(place and int(place[2]) <= len(data.splitlines()), "a line beyond the end of the file", done)
        expect(len(done.err.splitlines()) == 3 and done.err.splitlines()[2].strip() == "^", "no line and caret", done)


def test_nul():
    """NUL and other control characters are refused where they stand"""
    for byte in (b"\0", b"\x01", b"\x1b", b"\x7f"):
        done = bytes_refused(flat_scene().replace(b"small", b"sm" + byte + b"all"), place=(2, 10))
        expect("control" in done.err or "NUL" in done.err, done)
    bytes_refused(flat_scene().replace(b"small", b'"sm\\0all"'), "NUL", place=(2, 8))
    bytes_refused(b"\0" * 4096, place=(1, 1))


def test_not_utf8():
    """What is no UTF-8 is refused where it stands, also UTF-16 and Latin-1"""
    for bad in (b"\xff", b"\xc3", b"\xed\xa0\x80", b"\xf5\x80\x80\x80", b"\xc0\xaf", b"\xe4"):
        bytes_refused(flat_scene().replace(b"small", b"sm" + bad + b"all"), "UTF-8", place=(2, 10))
    bytes_refused(flat_scene().decode().encode("utf-16"), "UTF-8")
    bytes_refused(flat_scene().replace(b"small", "Hänge".encode("latin-1")), "UTF-8", place=(2, 9))
    bytes_refused(flat_scene() + b"# end \xff", "UTF-8")


def test_alias_bomb():
    """A bomb of aliases is refused at once"""
    bomb = b"a: &a [x, x, x, x, x, x, x, x, x]\n"
    for before, name in zip("abcdefgh", "bcdefghi"):
        bomb += f"{name}: &{name} [{', '.join(['*' + before] * 9)}]\n".encode()
    done = bytes_refused(bomb, "anchor", place=(1, 4))
    expect(done.seconds < 20, done)


def test_nesting():
    """100000 nested brackets, braces or dashes are refused at once, without a crash"""
    for data in (b"[" * 100000, b"title: " + b"[" * 100000 + b"]" * 100000, b"{a: " * 100000, b"- " * 100000, b"? " * 100000,
                 b"title: " + b"{" * 100000, b"\n".join(b" " * i + b"a:" for i in range(2000))):
        done = bytes_refused(data)
        expect("deep" in done.err or "malformed" in done.err or "plain word" in done.err, done)
        expect(len(done.err) < 2000, f"{len(done.err)} characters of message")


def test_large():
    """YAML over 16 MiB and CSV over 64 MiB are refused; just below they are read"""
    with Folder() as f:
        base = flat_scene()
        f.write("large.yaml", base + b"#" * ((16 << 20) + 1 - len(base)))
        done = check(f, "large.yaml")
        expect("larger than 16 MiB" in done.err and "large.yaml: " in done.err, done)
        good("--check", f.write("fits.yaml", base + b"#" * ((16 << 20) - len(base))))
        f.write("s.yaml", scene(slope="large.csv"))
        row = b"0,64\n100,0\n"
        head = b"distance,elevation\n"
        f.write("large.csv", head + row + b"\n" * ((64 << 20) + 1 - len(head + row)))
        done = check(f, "s.yaml")
        expect("larger than 64 MiB" in done.err and "large.csv: " in done.err, done)
        f.write("large.csv", head + row + b"\n" * ((64 << 20) - len(head + row)))
        good("--check", "s.yaml", cwd=f.path)


def test_many_values():
    """A list of 10^6 values and 10^5 keys are refused at once"""
    with Folder() as f:
        f.write("list.yaml", b"title: [" + b"1, " * 1000000 + b"1]\n")
        expect_in("more than 250000 values", check(f, "list.yaml").err)
        f.write("keys.yaml", b"".join(b"k%d: 1\n" % i for i in range(100000)))
        done = check(f, "keys.yaml")
        expect(len(done.err) < 20000, f"{len(done.err)} characters of message")
        f.write("long.yaml", b"title: small\n" + b"k" * 1000000 + b": 1\n")
        done = check(f, "long.yaml")
        f.write("number.yaml", flat_scene().replace(b"diameter_m: 0.5", b"diameter_m: 0." + b"5" * 1000000 + b"x"))
        check(f, "number.yaml")


def test_many_digits():
    """A number of 400 digits that fits is read as it is"""
    with Folder() as f:
        for word in ("0." + "5" * 400, "0.5" + "0" * 400, "5e-1", "+0.5", ".5", "0.5e0", "5" + "0" * 399 + "e-400"):
            path = f.write("s.yaml", flat_scene().decode().replace("diameter_m: 0.5", f"diameter_m: {word}"))
            expect_near(result(path)["rock"]["mean_diameter_m"], float(word), 1e-15, word[:40])


def test_empty():
    """An empty file, blanks, a comment: said to hold nothing"""
    for data in (b"", b"\n\n", b"# nothing\n", b"---\n...\n", b"\xef\xbb\xbf"):
        done = bytes_refused(data)
        expect("s.yaml" in done.err and len(done.err.splitlines()) <= 3, done)
    for data in (b"- 1\n", b"word\n", b"'quoted'\n", b"12\n"):
        bytes_refused(data, "ceduo: scene/1", place=(1, 1))


# ---- what is no ordinary file ----

def test_no_file():
    """Missing file, folder, loop of links, forbidden file: named, with the system's reason"""
    with Folder() as f:
        (f.path / "folder").mkdir()
        (f.path / "folder.yaml").mkdir()
        (f.path / "a").symlink_to("b")
        (f.path / "b").symlink_to("a")
        for name, words in (("missing.yaml", "No such file"), ("folder", "directory"), ("folder.yaml", "directory"),
                            ("a", "symbolic links"), ("x" * 300, "too long"), ("missing/s.yaml", "No such file"),
                            (str(PROFILES / "scenes/paper-site.yaml") + "/x", "Not a directory")):
            done = check(f, name)
            expect(f"{name}: " in done.err and words in done.err, done)
        done = check(f, "")
        expect(done.err.strip() != "", done)


def test_no_file_below():
    """The same for what a scene refers to, at the reference or in the file's name"""
    with Folder() as f:
        (f.path / "folder.yaml").mkdir()
        (f.path / "loop.yaml").symlink_to("loop.yaml")
        (f.path / "loop.csv").symlink_to("loop.csv")
        (f.path / "folder.csv").mkdir()
        for target in ("missing.yaml", "folder.yaml", "loop.yaml", "folder.csv", "loop.csv", "", ".", "/", "x" * 5000):
            f.write("s.yaml", scene(slope=target))
            expect_in("slope", check(f, "s.yaml").err)
            f.write("s.yaml", scene(forest=[{"from_m": 10, "to_m": 20, "stand": target}]))
            expect_in("stand", check(f, "s.yaml").err)


def test_devices():
    """/dev/zero, /dev/null, a FIFO without writer: refused within 5 s"""
    with Folder() as f:
        os.mkfifo(f.path / "fifo")
        os.mkfifo(f.path / "fifo.yaml")
        names = ["/dev/zero", "/dev/null", "fifo"]
        for target in ("fifo.yaml", "/dev/zero", "/dev/null"):
            for change in ({"slope": target}, {"slope": {"csv": target}},
                           {"forest": [{"from_m": 10, "to_m": 20, "stand": {"base": target}}]}):
                names.append(f.write(f"s{len(names)}.yaml", scene(**change)).name)
        together(*[(partial(check, f, name, modes=[mode]),) for name in names for mode in MODES])


def expect_refused(done, name, words):
    expect(done.status == INPUT and done.out == "" and f"{name}: cannot read it: {words}" in done.err, done)


def bounded():
    """What reads without an end comes to the end of its memory, not of the machine's."""
    if not SANITIZED:
        resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))


DEVICE = "a device or a socket; name a file\n"


def test_no_files():
    """Sockets, block devices and other devices but terminals are refused by every reader, as a path and as standard input"""
    with Folder() as f, socket.socket(socket.AF_UNIX) as there:
        there.bind(str(f.path / "socket.yaml"))
        f.write("s.yaml", flat_scene())
        blocks = [p for p in Path("/dev").iterdir() if p.is_block_device() and os.access(p, os.R_OK)][:1]
        for path in (f.path / "socket.yaml", Path("/dev/zero"), *blocks):
            for words in (("--check", path), ("--batch", path), ("--merge", path), ("--script", path, "s.yaml")):
                expect_refused(ceduo(*words, cwd=f.path, timeout=20, preexec_fn=bounded), path, DEVICE)
            for slope in (str(path), {"csv": str(path)}):
                expect_refused(ceduo("--check", f.write("refers.yaml", scene(slope=slope)), timeout=20, preexec_fn=bounded), path, DEVICE)
            if path.is_socket():
                continue
            for mode in ("--check", "--merge"):
                with open(path, "rb") as stream:
                    done = subprocess.run([CEDUO, mode, "-"], stdin=stream, capture_output=True, text=True, env=environment(),
                                          preexec_fn=bounded, timeout=20 * SLOWER, check=False)
                expect((done.returncode, done.stderr) == (INPUT, f"standard input: cannot read it: {DEVICE}"), mode, path, done)


def test_no_end():
    """A file of the system that never ends, as /proc/kmsg, is refused, as a path and as standard input"""
    endless = Path("/proc/kmsg")
    try:
        os.close(os.open(endless, os.O_RDONLY | os.O_NONBLOCK))
    except OSError as why:
        raise Skip(f"{endless} cannot be read here: {why}") from why
    with Folder() as f:
        f.write("s.yaml", flat_scene())
        for words in (("--check", endless), ("--merge", endless), ("--script", endless, "s.yaml")):
            expect_refused(ceduo(*words, cwd=f.path, timeout=20), endless, "it does not end; name a file that does\n")
        for mode in ("--check", "--merge"):
            with open(endless, "rb", buffering=0) as stream:
                done = subprocess.run([CEDUO, mode, "-"], stdin=stream, capture_output=True, text=True, env=environment(),
                                      timeout=20 * SLOWER, check=False)
            expect("standard input: cannot read it: it does not end" in done.stderr and done.returncode == INPUT, mode, done)


def test_streams():
    """A terminal, a socket as standard input, /dev/stdin and /dev/null are read to their end"""
    text = flat_scene()
    master, slave = pty.openpty()
    with Folder() as f:
        os.write(master, text + b"\x04")  # the key that ends it
        for name in (os.ttyname(slave), "-"):
            with open(os.ttyname(slave), "rb") as stream:
                done = subprocess.run([CEDUO, "--check", name], stdin=stream, capture_output=True, env=environment(),
                                      timeout=20 * SLOWER, check=False)
            expect(done.returncode == DONE and done.stderr == b"", name, done)
            os.write(master, text + b"\x04")
        ours, theirs = socket.socketpair()
        with ours, theirs:
            ours.sendall(text)
            ours.shutdown(socket.SHUT_WR)
            done = subprocess.run([CEDUO, "--check", "-"], stdin=theirs, capture_output=True, env=environment(), timeout=20 * SLOWER,
                                  check=False)
            expect(done.returncode == DONE and done.stderr == b"", done)
        done = subprocess.run(["sh", "-c", 'exec "$0" --check - <&-', CEDUO], capture_output=True, env=environment(), check=False)
        expect_equal((done.returncode, done.stderr), (INPUT, b"standard input: cannot read it: Bad file descriptor\n"), "closed")
        good("--check", "/dev/stdin", stdin=text)
        f.write("s.yaml", text)
        good("--script", "/dev/null", "s.yaml", cwd=f.path)
        expect_in("/dev/null: holds no value", check(f, "/dev/null").err)
        expect_in("standard input: holds no value", check(f, "-", stdin=b"").err)
        expect_in("/dev/null: holds no part", ceduo("--merge", "/dev/null").err)
        f.write("empty.yaml", b"")  # as large as those of the system, but it ends
        expect_in("empty.yaml: holds no value", check(f, "empty.yaml").err)
    os.close(master)
    os.close(slave)


def test_fifo():
    """A FIFO with a slow writer is read to its end"""
    with Folder() as f:
        fifo = f.path / "fifo.yaml"
        os.mkfifo(fifo)
        writer = subprocess.Popen(["sh", "-c", '(sleep 0.4; cat "$0") > "$1"', f.write("s.yaml", flat_scene()), fifo])
        try:
            time.sleep(0.1)
            done = subprocess.Popen([CEDUO, "--check", fifo], stderr=subprocess.PIPE, env=environment())
            err = done.communicate(timeout=10)[1]
            expect_equal((done.returncode, err), (DONE, b""))
        finally:
            writer.kill()
            writer.wait()


def waits_for_its_writer(fifo):
    os.mkfifo(fifo)
    done = subprocess.Popen([CEDUO, "--check", fifo], stderr=subprocess.PIPE, env=environment())
    time.sleep(1)
    expect(done.poll() is None, "it did not wait")
    with open(fifo, "wb") as out:
        out.write(flat_scene())
    expect_equal((done.communicate(timeout=10 * SLOWER)[1], done.returncode), (b"", DONE))


def tells_of_no_writer(mode, fifo):
    os.mkfifo(fifo)
    done = ceduo(mode, fifo)
    expect_equal((done.status, done.err), (INPUT, f"{fifo}: cannot read it: nobody writes to this FIFO\n"))
    expect(2 < done.seconds < 10 * SLOWER, done)


def test_fifo_first():
    """A FIFO is waited for whose writer comes a second later; one that nobody writes to is told of, not taken for empty"""
    with Folder() as f:
        together((waits_for_its_writer, f.path / "fifo.yaml"),
                 *[(tells_of_no_writer, mode, f.path / f"fifo{mode}") for mode in MODES])


def test_names_with_escapes():
    """Control characters in names and titles never come out raw: table, CSV, JSON, messages, file names"""
    nasty = "\\e[31mred\\a\\u009b2J\\u202eevil\\n\\t\\r"
    text = flat_scene().decode().replace("title: small", f'title: "{nasty}"').replace("name: road", f'name: "{nasty}"')
    text += (f'options:\n  - name: "{nasty}"\n    source: {{kind: assumed, text: "{nasty}"}}\n    forest:\n'
             f'      - {{from_m: 10, to_m: 20, stand: {{name: "{nasty}", species: fagus-sylvatica, '
             'trees: [{per_ha: 100, dbh_m: 0.3, height_m: 40}]}}\n')
    with Folder() as f:
        path = f.write("s.yaml", text)
        for form in ("table", "csv", "json"):
            done = good("--batch", "-f", form, path)
            raw = [c for c in done.out if c in "\x1b\x07\x9b\t\r" or (c == "\u202e" and form == "table")]
            expect(not raw, form, [hex(ord(c)) for c in raw], done.out)
        for name in ("\x1b[31m.yaml", "new\nline.yaml", "\x9b.yaml", "ü.yaml"):
            done = check(f, name)
            expect(not re.search("[\x1b\x07\x9b]", done.err) and len(done.err.splitlines()) == 1, ascii(done.err))
            bad = f.write(name, "rock: [\x1b]")
            done = check(f, bad.name)
            expect(not re.search("[\x1b\x07\x9b]", done.err), ascii(done.err))
        done = check(f, os.fsdecode(b"\xff\xfe.yaml"))
        expect_in("\\xff\\xfe", done.err)
        done = ceduo("--batch", "--option", "\x1b[31m", path)
        expect(done.status == USAGE, done)


NASTY = "\x1b[31mred\a\x9b2J\u202eevil\nline"


def test_names_in_every_mode():
    """Control characters in the names of files, options and arguments come out raw in no mode, on neither stream"""
    mapping = wooded_scene(title=NASTY, simulation={"rocks": 20})
    mapping["options"] = [{"name": NASTY, "forest": mapping.pop("forest")}]
    path = f"options[{NASTY}].forest[0].stand.stools.per_ha"
    with Folder() as f:
        def run(*words, status):
            done = ceduo(*words, cwd=f.path, env={"XDG_DATA_HOME": str(f.path)})  # looks for them in both streams
            expect_equal(done.status, status, ascii(words))
            expect("\x9b" not in done.err and "\u202e" not in done.err, ascii(done.err))
            if words[0] != "--shard" and "json" not in words:
                expect("\x9b" not in done.out and "\u202e" not in done.out, ascii(done.out))
            return done

        name = f.write(f"{NASTY}.yaml", mapping).name
        f.write(f"ceduo/scenes/{name}", mapping)
        for form in ("table", "csv", "json"):
            run("--batch", "-f", form, name, status=DONE)
            run("--years", "0:2", "-f", form, name, status=DONE)
            run("--batch", "-f", form, "-o", f"{NASTY}/x", name, status=OUTPUT)
            for goal, scenes in (("adc=30", [name]), ("adc=30", [name, name]), ("adc=0.001", [name])):
                run("--find", f"{path}=500:5000", "--goal", goal, "-f", form, *scenes, status=DONE)
        for plot in ("profile", "energy", "height", "histogram", "adc", "rotation", "stand", "compare"):
            run("--plot", plot, name, status=DONE)
        for i in (1, 2):
            run("--shard", f"{i}/2", "-o", f"{NASTY}{i}", name, status=DONE)
        run("--merge", f"{NASTY}1", f"{NASTY}2", status=DONE)
        expect_in("once more", run("--merge", f"{NASTY}1", f"{NASTY}1", f"{NASTY}2", status=INPUT).err)
        expect_in("missing: 2", run("--merge", f"{NASTY}1", status=INPUT).err)
        for words in (("--merge", f"{NASTY}0"), ("--merge", name), ("--check", f"{NASTY}0"), ("--script", f"{NASTY}0", name)):
            run(*words, status=INPUT)
        run("--list-profiles", status=DONE)
        for text, status in ((f"{NASTY[:5]}\n", USAGE), (f"key {NASTY[:5]}\n", USAGE), (f"dump {NASTY[:5]}/x\n", OUTPUT),
                             ("key s\ndump -\nkey o\ntype red\nkey Enter\ndump -\nkey Esc w\ndump -\nkey Enter\ndump -\n", DONE)):
            f.write(NASTY, text)
            done = run("--script", NASTY, name, status=status)
            expect(status == DONE or len(done.err.splitlines()) == 1, ascii(done.err))
        for option in ("format", "rows", "plot", "charset", "rocks", "tolerance", "years", "size", "find", "goal", "shard", "seed",
                       "threads", "option", "set", NASTY, f"check={NASTY}"):
            run("--batch", f"--{option}", f"{NASTY}?", name, status=USAGE)
        for word in (f"-{NASTY}", f"--{NASTY}", f"--batch={NASTY}"):
            run(word, name, status=USAGE)


def test_name_not_utf8():
    """A file name that is no UTF-8 leaves JSON, CSV and table well-formed"""
    with Folder() as f:
        name = os.fsencode(f.path) + b"/\xff\xfe.yaml"
        with open(name, "wb") as file:
            file.write(flat_scene().replace(b"title: small\n", b""))
        for form in ("json", "csv", "table"):
            done = good("--batch", "-f", form, os.fsdecode(name))
            done.out_bytes.decode("utf-8")


# ---- many problems ----

def test_twenty():
    """25 problems in one file: the first 20 and the number of the rest"""
    with Folder() as f:
        data = flat_scene().decode() + "".join(f"unknown{i}: 1\n" for i in range(25))
        f.write("s.yaml", data)
        done = check(f, "s.yaml")
        problems = expect_places(done.err, {"s.yaml": data})
        expect_equal(len(problems), 21)
        expect(all(f"unknown{i}: " in problems[i][3] for i in range(20)), done)
        expect_equal(problems[20][3], "5 more problems")
        data = flat_scene().decode() + "".join(f"unknown{i}: 1\n" for i in range(21))
        f.write("s.yaml", data)
        expect_equal(check(f, "s.yaml").err.splitlines()[-1], "1 more problem")
        data = flat_scene().decode() + "".join(f"unknown{i}: 1\n" for i in range(20))
        f.write("s.yaml", data)
        expect("more" not in check(f, "s.yaml").err.splitlines()[-1], "exactly twenty")


def test_all_at_once():
    """Several kinds of problem in one file are all reported in one go"""
    with Folder() as f:
        data = flat_scene().decode().replace("diameter_m: 0.5", "diameter_m: -0.5").replace("x_m: 90", "x: 90").replace(
            "vx_m_s: 1", "vx_m_s: fast")
        f.write("s.yaml", data)
        problems = expect_places(check(f, "s.yaml").err, {"s.yaml": data})
        expect_equal([p[1] for p in problems], [3, 4, 8], str(problems))  # that x_m is missing follows from 'x'


def told(text, *wanted, more=None):
    """The problems of a scene: one for each of `wanted`, which stands in it, and none besides."""
    with Folder() as f:
        for name, content in {"s.yaml": text, "slope.yaml": SLOPE, "stand.yaml": STAND, **(more or {})}.items():
            f.write(name, content)
        done = check(f, "s.yaml")
        problems = [p[3] for p in expect_places(done.err, {"s.yaml": text, "slope.yaml": SLOPE, "stand.yaml": STAND, **(more or {})})]
        for words in wanted:
            expect_equal(sum(words in p for p in problems), 1, f"{words!r} in {problems}")
        expect_equal(len(problems), len(wanted), str(problems))


GROUND = "slope: {vertices_m: [[0, 64], [50, 30], [100, 0]], segments: [{rn: 0.3, rt: 0.8}]}\n"
HEAD = "ceduo: scene/1\nrock: {diameter_m: 0.5}\n" + GROUND


def test_all_without_reference():
    """A reference that leads nowhere is one problem; all the rest is still looked at"""
    told("ceduo: scene/1\nrock: {diameter_m: -1}\n" + GROUND + "controls: [{x_m: 900}, {x_m: a}]\nforest:\n"
         "  - {from_m: 10, to_m: 40, stand: nowhere}\n  - {from_m: 30, to_m: 70, stand: {base: nothing, shoots: [{per_ha: -7}]}}\n",
         "cannot find 'nowhere'", "cannot find 'nothing'",
         "rock.diameter_m: -1", "controls[0].x_m: 900 lies beyond", "controls[1].x_m: 'a'",
         "forest[1].from_m: 30 lies before the end", "shoots[0].per_ha: -7")
    told("ceduo: scene/1\nrock: {diameter_m: 0.5}\nslope: nowhere\ncontrols: [{x_m: 5}, {x_m: 5}]\n"
         "forest: [{from_m: 40, to_m: 10, stand: stand.yaml}]\n",
         "cannot find 'nowhere'", "controls[1].x_m: 5 is given twice", "forest[0].to_m: 10 does not lie beyond from_m")
    told(HEAD + "controls_m: [75]\nforest: [{from_m: 10, to_m: 40, stand: bad.yaml}, {from_m: 40, to_m: 30, stand: bad.yaml}]\n",
         "malformed YAML", "forest[1].to_m: 30 does not lie beyond", more={"bad.yaml": "name: [\n"})


def test_all_with_values():
    """What does not fit together is told along with wrong and missing values, as far as its own values are good"""
    told("ceduo: scene/1\n", "'rock' is missing", "'slope' is missing", "'controls' is missing")
    told("ceduo: scene/1\nrock: {shape: cube, height_m: 1}\nrelease: {x_m: b, height_m: -1}\n"
         "slope: {vertices_m: [[0, 64], [50], [40, 20], [30, 0]], segments: [{rn: 2, rt: 0.8}, {rn: 0.3}], "
         "materials: [{from_m: 0, to_m: 0, material: cliff}]}\n"
         "controls: [{x_m: 9}, {x_m: 9, accepted_kJ: -1}]\n"
         "forest: [{from_m: 10, to_m: x, stand: {stools: {per_ha: 9}, shoots: [{per_ha: 5, dbh_m: 1, height_m: 1}]}}, "
         "{from_m: 9, to_m: 8, stand: {shoots: [{per_ha: 5, dbh_m: 0, height_m: 1}]}}]\n",
         "rock.shape: 'cube'", "release.x_m: 'b'", "release.height_m: -1", "slope.vertices_m[1]: a pair",
         "slope.vertices_m[3]: x 30 does not lie beyond 40", "2 segments for 3 stretches", "segments[0].rn: 2", "'rt' is missing",
         "segments say the ground already", "controls[1].x_m: 9 is given twice", "controls[1].accepted_kJ: -1", "to_m: 'x'",
         "'spacing_m' is missing", "5 shoots on 9 stools", "forest[1].to_m: 8 does not lie", "shoots without stools",
         "dbh_m: 0 is not above")
    told(HEAD + "release: {x_m: 99, vx_m_s: y}\ncontrols_m: [z, 75, 200, 75]\n"
         "forest: [{from_m: -5, to_m: 200, stand: stand.yaml}]\n",
         "release.vx_m_s: 'y'", "controls_m[0]: 'z'", "controls_m[1]: 75 does not lie beyond the release",
         "controls_m[2]: 200 lies beyond", "controls_m[3]: 75 does not lie beyond the release", "forest[0].from_m: -5 lies before",
         "forest[0].to_m: 200 lies beyond the slope")
    told("ceduo: scene/1\nrock: {}\nslope: {vertices_m: [[0, 9], [9, 0]], materials: [{from_m: 0, to_m: 4, material: sand}, "
         "{from_m: 5, to_m: 8, material: talus}]}\noptions: [{name: a}, {forest: b}, {name: a}]\n",
         "one of diameter_m, volume_m3 and mass_kg", "'sand' is unknown", "materials[1].from_m: 5 leaves a gap",
         "options[1]: 'name' is missing", "options[1].forest: a list is wanted", "options[2].name: 'a' is given twice",
         "'controls' is missing")


def test_all_but_what_follows():
    """What only follows from another problem is not told"""
    told("ceduo: scene/1\nrock: {diametre_m: 0.5}\nslope: {vertices_m: 5, materials: 6}\ncontrol: [{x_m: 900}]\n"
         "forest: [{from_m: 10, to_m: 400, stand: {stools: 7, shoots: [{per_ha: 9, dbh_m: 1, height_m: 1}]}}]\n",
         "rock.diametre_m: unknown key", "slope.vertices_m: a list", "slope.materials: a list", "control: unknown key",
         "stools: a mapping is wanted")
    told(HEAD + "controls: 75\noptions: {}\n", "controls: a list", "options: a list")
    told(HEAD.replace("segments: [{rn: 0.3, rt: 0.8}]", "csv: [x]") + "controls_m: [50]\n", "slope.csv: a text",
         "vertices_m and csv together")
    told(HEAD.replace("diameter_m: 0.5", "shape: 5, height_m: 9") + "release: 7\ncontrols_m: [50]\nforest: [9, {from_m: 8}]\n",
         "rock.shape: '5'", "release: a mapping", "forest[0]: a mapping", "'to_m' is missing", "'stand' is missing")


# ---- files together ----

def stand_fault(body, *words, place=None, more=None):
    with Folder() as f:
        for name, text in {**FILES, "stand.yaml": body, **(more or {})}.items():
            f.write(name, text)
        done = check(f, "scene.yaml")
        expect(all(w in done.err for w in words), f"none says {words}", done)
        if place:
            expect_in(place, done.err)


def test_base_loop():
    """Stands that start from one another in a loop are refused"""
    stand_fault("ceduo: stand/1\nbase: stand.yaml\n", "loop", place="stand.yaml:2:7: ")
    stand_fault("ceduo: stand/1\nbase: other.yaml\n", "loop", more={"other.yaml": "ceduo: stand/1\nbase: stand.yaml\n"})


def test_base_merge():
    """A stand's own mappings are merged into its base, its lists replace the base's"""
    base = stand(ceduo="stand/1", name="base", trees=[{"per_ha": 100, "dbh_m": 0.25, "height_m": 12},
                                                      {"per_ha": 50, "dbh_m": 0.5, "height_m": 20}])
    with Folder() as f:
        f.write("stands/base.yaml", base)
        f.write("stands/middle.yaml", "ceduo: stand/1\nbase: base.yaml\nname: middle\nstools: {spacing_m: 0.75}\n")
        def found(own):
            path = f.write("s.yaml", scene(forest=[{"from_m": 10, "to_m": 60, "stand": own}]))
            return result(path)["options"][0]["stands"][0]
        one = found({"base": "stands/base.yaml"})
        expect_equal((one["name"], one["stools_per_ha"], one["trees_per_ha"]), ("base", 2000, 150))
        one = found({"base": "stands/base.yaml", "stools": {"per_ha": 1000}})
        expect_equal((one["stools_per_ha"], one["stems_per_ha"]), (1000, 5150))
        wide = found({"base": "stands/base.yaml", "stools": {"per_ha": 1000, "spacing_m": 0.5}})
        expect(wide["adc"]["interception_m"] != one["adc"]["interception_m"], "spacing is merged")
        one = found({"base": "stands/base.yaml", "trees": [{"per_ha": 30, "dbh_m": 0.25, "height_m": 12}]})
        expect_equal((one["trees_per_ha"], one["stools_per_ha"]), (30, 2000))
        one = found({"base": "stands/base.yaml", "trees": []})
        expect_equal(one["trees_per_ha"], 0)
        one = found({"base": "stands/base.yaml", "energy": {"u_J_m3": 50000}, "shoots": [
            {"per_ha": 4000, "dbh_m": 0.0625, "height_m": 6, "volume_m3": 0.01}], "trees": []})
        expect_near(one["energy_per_contact_J"], 500, 1e-9, "energy is merged")
        one = found("stands/middle.yaml")
        expect_equal((one["name"], one["stools_per_ha"], one["trees_per_ha"]), ("middle", 2000, 150))
        same = found({"base": "stands/middle.yaml", "stools": {"spacing_m": 0.25}, "name": "base"})
        expect_equal(same, found({"base": "stands/base.yaml"}), "two steps")


def test_base_place():
    """A fault in a base is shown in the base's file, one in what is put over it in that file"""
    bad = STAND.replace("dbh_m: 0.07", "dbh_m: 0,07")
    with Folder() as f:
        for name, text in {**FILES, "stand.yaml": "ceduo: stand/1\nbase: old.yaml\n", "old.yaml": bad}.items():
            f.write(name, text)
        done = check(f, "scene.yaml")
        expect_in("old.yaml:8:12: shoots[0].dbh_m", done.err)
        f.write("old.yaml", STAND)
        f.write("stand.yaml", "ceduo: stand/1\nbase: old.yaml\nstools: {per_ha: -5}\n")
        expect_in("stand.yaml:3:18: stools.per_ha: -5", check(f, "scene.yaml").err)


def test_options_bad():
    """Options: names twice, no name, an empty list, a fault deep inside, each at its place"""
    head = flat_scene().decode()
    belt = "{from_m: 10, to_m: 20, stand: {trees: [{per_ha: 10, dbh_m: @, height_m: 9}]}}".replace("@", "0.2")
    for tail, line, words in (
            ("options:\n  - {name: a}\n  - {name: a}\n", 11, "options[1].name: 'a' is given twice"),
            ("options:\n  - {name: a}\n  - {forest: []}\n", 11, "options[1]: 'name' is missing"),
            ("options: []\n", 9, "options: the list is empty"),
            ("options: {name: a}\n", 9, "a list is wanted"),
            (f"options:\n  - {{name: a}}\n  - {{name: b, forest: [{belt.replace('0.2', '-1')}]}}\n", 11,
             "options[1].forest[0].stand.trees[0].dbh_m: -1 is below 0 m"),
            (f"options:\n  - {{name: a}}\n  - {{name: b, forest: [{belt}, {belt}]}}\n", 11, "options[1].forest[1].from_m")):
        with Folder() as f:
            data = head + tail
            f.write("s.yaml", data)
            problems = expect_places(check(f, "s.yaml").err, {"s.yaml": data})
            expect(any(p[1] == line and words in p[3] for p in problems), f"none says {words} on line {line}", problems)


def materials_refused(rows, words):
    with Folder() as f:
        f.write("s.yaml", scene(slope={"vertices_m": [[0, 64], [100, 0]], "materials": rows}))
        expect_in(words, check(f, "s.yaml").err)


def test_materials():
    """Materials must cover the slope without gap or overlap, from the library"""
    def row(a, b, name="talus"):
        return {"from_m": a, "to_m": b, "material": name}
    for rows, words in (([row(0, 40), row(50, 100)], "materials[1].from_m: 50 leaves a gap or overlaps; it must begin at 40"),
                        ([row(0, 40), row(30, 100)], "materials[1].from_m: 30 leaves a gap or overlaps"),
                        ([row(10, 100)], "materials[0].from_m: 10 leaves a gap"),
                        ([row(0, 90)], "materials[0].to_m: 90 ends before the profile, at 100"),
                        ([row(40, 40)], "materials[0].to_m: 40 does not lie beyond from_m"),
                        ([row(0, 100, "lava")], "'lava' is unknown"), ([], "the list is empty")):
        materials_refused(rows, words)
    with Folder() as f:
        split = scene(slope={"vertices_m": [[0, 64], [100, 0]], "materials": [row(-5, 30), row(30, 200, "colluvium")]})
        good("--batch", f.write("s.yaml", split))


# ---- CSV ----

PROFILE = [(0, 64), (50, 30), (100, 0)]


def slope_numbers(folder, content):
    folder.write("line.csv", content)
    run = result(folder.write("s.yaml", scene(slope={"csv": "line.csv", "segments": [{"rn": 0.3, "rt": 0.8}]})))
    return run["options"][0]["controls"]


def test_csv_good():
    """CSV slopes: QGIS' header, semicolons, tabs, quotes, more columns, CRLF, BOM, blank lines give one slope"""
    with Folder() as f:
        plain = "distance,elevation\n0,64\n50,30\n100,0\n"
        wanted = slope_numbers(f, plain)
        for text in (plain.replace(",", ";"), plain.replace(",", "\t"), plain.replace("\n", "\r\n"), "\ufeff" + plain,
                     plain.rstrip("\n"), plain + "\n\n", plain + ",\n", plain.upper(), "x,z\n0,64\n50,30\n100,0\n",
                     "fid,elevation,note,distance\n1,64,a,0\n2,30,\"b\",50\n3,0,c,100\n",
                     '"distance","elevation"\n"0","64"\n"50","30"\n"100","0"\n', plain.replace("50,", " 50 , "),
                     "distance,elevation\n0,6.4e1\n5e1,30.0\n+100,0\n", "distance,elevation,\n0,64,\n50,30,\n100,0,\n"):
            expect_equal(slope_numbers(f, text), wanted, repr(text))
        many = "distance,elevation\n" + "".join(f"{x / 1024},{64 - x / 1600}\n" for x in range(0, 102401))
        slope_numbers(f, many)


CSV_CASES = [
    # (content, place, words)
    ("", None, "nothing"), ("distance,height\n0,1\n", (1, None), "'distance' and 'elevation'"),
    ("0,64\n100,0\n", (1, None), "'distance' and 'elevation'"), ("\n\n", (1, None), "'distance' and 'elevation'"),
    ("distance,elevation\n", None, "two vertices"), ("distance,elevation\n0,64\n", None, "two vertices"),
    ("distance,elevation\n0,64\n50,\n100,0\n", (3, 4), "missing"), ("distance,elevation\n0,64\n,30\n100,0\n", (3, 1), "missing"),
    ("distance,elevation\n0,64\n50\n100,0\n", (3, None), "too few"),
    ("distance;elevation\n0;64\n50;30,5\n100;0\n", (3, 4), "'30,5' is no number"),
    ("distance;elevation\n0;64\n50;30,5\n100;0\n", (3, 4), "dot"),
    ("distance,elevation\n0,64\n50,30\n40,0\n", (4, 1), "distance 40 does not lie beyond 50"),
    ("distance,elevation\n0,64\n50,30\n50,0\n", (4, 1), "must rise"),
    ("distance,elevation\n0,64\n50,abc\n100,0\n", (3, 4), "'abc' is no number"),
    ("distance,elevation\n0,64\n50,nan\n100,0\n", (3, 4), "'nan' is no number"),
    ("distance,elevation\n0,64\n50,NULL\n100,0\n", (3, 4), "'NULL' is no number"),
    ("distance,elevation\n0,64\n50,-\n100,0\n", (3, 4), "'-' is no number"),
    ("distance,elevation\n0,64\n50,1e999\n100,0\n", (3, 4), "beyond"),
    ("distance,elevation\n0,64\n50,1e10\n100,0\n", (3, 4), "beyond"),
    ("distance,elevation\n0,64\n50,-9999999999\n100,0\n", (3, 4), "beyond"),
    ("distance,elevation\n0,64\n50,0x10\n100,0\n", (3, 4), "'0x10' is no number"),
    ("distance,elevation\n0,64\n50,\x1b[31m\n100,0\n", (3, 4), "is no number"),
    ("distance,elevation\n0,64\n50,\x00\n100,0\n", (3, 4), "is no number"),
    ("distance,elevation\n0,64\n50," + "9" * 1000 + "\n100,0\n", (3, 4), ""),
    ("distance,elevation,distance\n0,64,1\n50,30,2\n100,0,3\n", (1, None), "distance"),
]


def csv_refused(content, place, words):
    with Folder() as f:
        f.write("line.csv", content)
        f.write("s.yaml", "ceduo: scene/1\nrock: {diameter_m: 0.5}\nslope: line.csv\ncontrols_m: [75]\n")
        done = check(f, "s.yaml")
        problems = expect_places(done.err, {"line.csv": content})
        expect_in(words, done.err)
        if place:
            mine = [p for p in problems if p[0] and p[0].endswith("line.csv") and p[1] == place[0] and
                    place[1] in (None, p[2])]
            expect(mine, f"no problem at line.csv:{place[0]}:{place[1]}", done)
        expect("line.csv" in done.err, "the file is not named", done)


def test_csv_and_vertices():
    """csv and vertices_m together are refused"""
    with Folder() as f:
        f.write("line.csv", "distance,elevation\n0,64\n100,0\n")
        f.write("s.yaml", scene(slope={"csv": "line.csv", "vertices_m": [[0, 64], [100, 0]], "segments": [{"rn": 0.3, "rt": 0.8}]}))
        expect_in("keep one", check(f, "s.yaml").err)


# ---- random changes ----

def mutations(seed, count):
    """Shipped files with a few bytes changed, put in, taken out, doubled or swapped."""
    draw = random.Random(seed)
    files = sorted(PROFILES.rglob("*.yaml"))
    special = [b"\n", b" ", b":", b"-", b"[", b"]", b"{", b"}", b",", b"#", b"&a", b"*a", b"!", b"|", b">", b"'", b'"', b"%",
               b"\t", b"\0", b"\xff", b"\xc3", b"\xef\xbb\xbf", b"\xe2\x80\xa8", b"1e999", b"-", b"0", b".nan", b"---\n", b"? "]
    for i in range(count):
        path = draw.choice(files)
        data = bytearray(path.read_bytes())
        for _ in range(draw.randint(1, 4)):
            at = draw.randrange(len(data) + 1)
            kind = draw.randrange(5)
            if kind == 0:
                data[at:at + 1] = bytes([draw.randrange(256)])
            elif kind == 1:
                data[at:at] = draw.choice(special)
            elif kind == 2:
                del data[at:at + draw.choice((1, 1, 5, 50, 500))]
            elif kind == 3:
                data[at:at] = data[at:at + draw.randrange(200)]
            else:
                end = data.find(b"\n", at)
                data[at:end if end > 0 else at] = draw.choice(special)
        yield i, path, bytes(data)


def test_random():
    """500 random changes of the shipped files: status 0 or 3, no crash, no hang, every place right"""
    with Folder() as f:
        profiles = f.profiles()
        refused_count = 0
        for i, path, data in mutations(20090614, 500):
            changed = profiles / path.relative_to(PROFILES)
            changed.write_bytes(data)
            if changed.parent.name == "scenes":
                scene_path = changed
            else:
                where = "slope" if changed.parent.name == "slopes" else "forest"
                reference = f"../{changed.parent.name}/{changed.name}"
                other = {"slope": reference} if where == "slope" else {
                    "forest": [{"from_m": 10, "to_m": 60, "stand": reference}]}
                scene_path = f.write("profiles/scenes/changed.yaml", scene(**other))
            try:
                done = ceduo("--check", scene_path, cwd=f.path, timeout=60)
                expect(done.status in (DONE, INPUT) and done.out == "", done)
                expect((done.status == INPUT) == bool(done.err), done)
                refused_count += done.status == INPUT
                try:
                    text = data.decode()
                except UnicodeDecodeError:
                    text = None
                if text is not None and not re.search("[\r\x85\u2028\u2029\x00-\x08\x0b-\x1f]", text):
                    expect_places(done.err, {changed.name: text})
            except Failure as failure:
                raise Failure(f"change {i} of {path.name}", failure, "the file:", repr(data[:3000])) from failure
            changed.write_bytes(path.read_bytes())
        expect(100 < refused_count < 490, f"{refused_count} of 500 refused: the changes are too mild or too hard")


def main():
    suite = Suite()
    suite.run(tests_of(sys.modules[__name__]))
    for name, old, new, *words in CASES:
        shown = ascii(new.replace("@@", ""))[1:-1]
        suite.check(f"{name}: {shown[:60]}{'...' if len(shown) > 60 else ''}: {', '.join(words)}", refused, name, old, new,
                    *words)
    for content, place, words in CSV_CASES:
        suite.check(f"CSV {ascii(content[-40:])}: {words or 'refused'}", csv_refused, content, place, words)
    suite.end()


if __name__ == "__main__":
    main()
