#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input: every error has file, line, column, path and remedy, and its line is shown with a caret."""
import random
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import DONE, INPUT, PROFILES, Failure, Folder, Suite, ceduo, expect, expect_equal, good, result, scene, list_tests
from inputs import FILES, SCENE, STAND, check, expect_places, mutated


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
    # (file, original text, replacement, words of the message); @@ marks the caret
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
    ("stand.yaml", "text: by hand", "except: @@stools", "source.except: expected a list, not"),
    ("stand.yaml", "text: by hand", "except: [@@[stools]]", "source.except[0]: expected a text, not a list"),
    ("scene.yaml", "ceduo: scene/1\n", "", "'ceduo' is missing"),
    ("scene.yaml", "ceduo: scene/1", "ceduo: @@scene/2", "expected scene/1"),
    ("scene.yaml", "ceduo: scene/1", "ceduo: @@stand/1", "expected scene/1"),
    ("slope.yaml", "ceduo: slope/1", "ceduo: @@stand/1", "expected slope/1"),
    ("stand.yaml", "ceduo: stand/1", "ceduo: @@slope/1", "expected stand/1"),
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
    ("stand.yaml", "dbh_m: 0.07", "dbh_m: @@0,07", "shoots[0].dbh_m: decimal comma: write 0.07"),
    ("stand.yaml", "dbh_m: 0.07", "dbh_m: @@-0.07", "shoots[0].dbh_m: -0.07 is below 0 m"),
    ("stand.yaml", "dbh_m: 0.07", "dbh_m: @@0", "shoots[0].dbh_m: 0 is not above 0 m"),
    ("stand.yaml", "dbh_m: 0.07", "dbh_m: @@7000", "shoots[0].dbh_m: 7000 is above"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@5_000", "'5_000' is not a number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@0x10", "'0x10' is not a number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@010", "'010' is not a number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@0o10", "'0o10' is not a number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@1:30", "'1:30' is not a number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@inf", "'inf' is not a number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@.inf", "'.inf' is not a number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@-.inf", "'-.inf' is not a number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@nan", "'nan' is not a number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@.nan", "'.nan' is not a number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@1e999", "too large"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@-1e999", "too large"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@" + "9" * 400, "too large"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@5000 m", "'5000 m' is not a number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@1e", "'1e' is not a number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@.", "'.' is not a number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@+-5", "'+-5' is not a number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@５０００", "is not a number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@true", "'true' is not a number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@~", "'~' is not a number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@null", "'null' is not a number"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@[5000]", "expected a number, not a list"),
    ("stand.yaml", "per_ha: 5000", "per_ha: @@{mean: 5000}", "expected a number, not a mapping"),
    ("stand.yaml", "per_ha: 5000\n", "per_ha:\n", "shoots[0].per_ha", "is not a number"),
    ("scene.yaml", "rocks: 20", "rocks: @@1.5", "simulation.rocks: '1.5' is not a whole number"),
    ("scene.yaml", "rocks: 20", "rocks: @@0", "simulation.rocks: 0 is below 1"),
    ("scene.yaml", "rocks: 20", "rocks: @@1e8", "simulation.rocks", "is above 1048576"),
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
    ("scene.yaml", "rock: {shape: sphere, diameter_m: 0.5}", "rock: @@0.5", "rock: expected a mapping, not a single value"),
    ("scene.yaml", "rock: {shape: sphere, diameter_m: 0.5}", "rock: @@[0.5]", "rock: expected a mapping, not a list"),
    ("scene.yaml", "title: small", "title: @@{a: 1}", "title: expected a text, not a mapping"),
    ("scene.yaml", "  - {x_m: 90}", "  - @@90", "controls[1]: expected a mapping"),
    ("slope.yaml", "vertices_m: [[0, 64], [50, 30], [100, 0]]", "vertices_m: @@0", "vertices_m: expected a list"),
    ("slope.yaml", "[50, 30]", "@@[50]", "vertices_m[1]: expected [x, z]"),
    ("slope.yaml", "[50, 30]", "@@[50, 30, 2]", "vertices_m[1]: expected [x, z]"),
    ("slope.yaml", "[50, 30]", "[50, @@x]", "vertices_m[1]: 'x' is not a number"),
    ("stand.yaml", "trees:\n", "trees: @@{}\nextra:\n", "trees: expected a list, not a mapping"),
    ("scene.yaml", "slope: slope.yaml", "slope: @@[slope.yaml]", "slope: expected a mapping, not a list"),
    ("scene.yaml", "stand: stand.yaml\n", "stand: @@[stand.yaml]\n", "expected a mapping, not a list"),
    ("scene.yaml", "scale_rn: false", "scale_rn: @@no", "simulation.scale_rn: 'no': expected true or false"),
    ("scene.yaml", "scale_rn: false", "scale_rn: @@'true'", "expected true or false"),
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
    ("scene.yaml", "{shape: sphere, diameter_m: 0.5}", "{shape: block, axes_m: @@[1, 2]}", "expected [a, b, c]"),
    ("scene.yaml", "{shape: sphere, diameter_m: 0.5}", "{shape: block, axes_m: [1, @@-2, 3]}", "rock.axes_m[1]: -2 is below 0 m"),
    ("scene.yaml", "{shape: sphere, diameter_m: 0.5}", "{shape: block, axes_m: [1, 2, 3], mass_kg: 5, density_kg_m3: @@2600}", "keep one"),
    # spreads
    ("scene.yaml", "diameter_m: 0.5}", "diameter_m: @@{spread: 0.1}}", "rock.diameter_m: 'mean' is missing"),
    ("scene.yaml", "diameter_m: 0.5}", "diameter_m: {mean: 0.5, spread: @@-0.1}}", "rock.diameter_m.spread: -0.1 is below 0"),
    ("scene.yaml", "diameter_m: 0.5}", "diameter_m: @@{mean: 0.5, spread: 0.2}}", "rock.diameter_m: with this spread the values reach from", "reduce it"),
    ("scene.yaml", "diameter_m: 0.5}", "diameter_m: @@{mean: 0.5, spread: 0.5, kind: uniform}}", "with this spread the values reach from 0 to 1"),
    ("scene.yaml", "diameter_m: 0.5}", "diameter_m: {mean: 0.5, spread: 0.1, kind: @@gamma}}", "'gamma' is unknown", "normal"),
    ("scene.yaml", "diameter_m: 0.5}", "diameter_m: {mean: 0.5, @@sd: 0.1}}", "rock.diameter_m.sd: unknown key"),
    ("scene.yaml", "height_m: 0, vx", "height_m: @@{mean: 1, spread: 2, kind: uniform}, vx", "release.height_m: with this spread the values reach from -1"),
    ("scene.yaml", "vx_m_s: 1}", "vx_m_s: @@{mean: 1, spread: 1e6}}", "release.vx_m_s: with this spread the values reach"),
    ("scene.yaml", "{x_m: 5, h", "{x_m: @@{mean: 5, spread: 6, kind: uniform}, h", "release.x_m", "outside the slope"),
    ("scene.yaml", "x_m: 75, name", "x_m: @@{mean: 75, spread: 1}, name", "expected a number, not a mapping"),
    # slope
    ("slope.yaml", "[50, 30]", "@@[0, 30]", "vertices_m[1]: x must rise, but 0 follows 0"),
    ("slope.yaml", "[50, 30]", "@@[-50, 30]", "vertices_m[1]: x must rise, but -50 follows 0", "small run"),
    ("slope.yaml", "[[0, 64], [50, 30], [100, 0]]", "@@[[0, 64]]", "two points"),
    ("slope.yaml", "[[0, 64], [50, 30], [100, 0]]", "@@[]", "two points"),
    ("slope.yaml", "[50, 30], ", "[50, 30], [60, 20], ", "segments", "2 segments for 3 stretches", "one for all"),
    ("slope.yaml", "[50, 30], ", "[50, @@1e10], ", "vertices_m[1]: 10000000000 is above"),
    ("slope.yaml", "roughness_m: 0.1", "roughness_m: @@0.1, roughness_rad: 0.1", "segments[1].roughness_m", "keep one"),
    ("slope.yaml", "segments:\n", "materials: @@[{from_m: 0, to_m: 100, material: talus}]\nsegments:\n", "materials", "keep one"),
    # release, controls
    ("scene.yaml", "{x_m: 5, h", "{x_m: @@-1, h", "release.x_m: -1 lies outside the slope"),
    ("scene.yaml", "{x_m: 5, h", "{x_m: @@100, h", "release.x_m: 100 lies outside the slope"),
    ("scene.yaml", "{x_m: 90}", "{x_m: @@100.5}", "controls[1].x_m: 100.5 lies outside the slope", "100 m"),
    ("scene.yaml", "{x_m: 90}", "{x_m: @@5}", "controls[1].x_m: 5 must lie beyond the release"),
    ("scene.yaml", "{x_m: 90}", "{x_m: @@75}", "controls[1].x_m: '75' is given twice"),
    ("scene.yaml", "forest:\n", "controls_m: @@[80]\nforest:\n", "controls_m", "keep one"),
    # belts and stands
    ("scene.yaml", "{from_m: 40, to_m: 70", "{from_m: @@39, to_m: 70", "forest[1].from_m: belts must not overlap", "ends at 40"),
    ("scene.yaml", "{from_m: 40, to_m: 70", "{from_m: 40, to_m: @@40", "forest[1].to_m: the end (40) must lie beyond the start"),
    ("scene.yaml", "{from_m: 40, to_m: 70", "{from_m: 40, to_m: @@101", "forest[1].to_m: 101 lies outside the slope"),
    ("scene.yaml", "  - from_m: 10\n", "  - from_m: @@-1\n", "forest[0].from_m: -1 lies outside the slope"),
    ("scene.yaml", "simulation: {", "options: [{name: a}]\nsimulation: {", "forest", "keep one"),
    ("stand.yaml", "per_ha: 5000", "per_ha: 1999", "stools.per_ha", "1999 shoots are too few for 2000 stools"),
    ("stand.yaml", "stools: {per_ha: 2000, spacing_m: 0.25}\n", "", "shoots without stools"),
    ("stand.yaml", "shoots:\n  - per_ha: 5000\n    dbh_m: 0.07\n    height_m: 6\n", "", "stools without shoots"),
    ("stand.yaml", "system: simple-coppice", "system: @@bare", "system: 'bare' has no stems"),
    ("stand.yaml", "ceduo: stand/1\n", "ceduo: stand/1\nbase: @@nothing.yaml\n", "cannot find 'nothing.yaml'"),
    ("stand.yaml", "ceduo: stand/1\n", "ceduo: stand/1\nbase: @@[a]\n", "base: expected a path to a file"),
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
    """The scene that the cases change is valid"""
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
    """An error in a file that two belts share is reported once"""
    files, _ = mutated("stand.yaml", "dbh_m: 0.07", "dbh_m: -0.07")
    with Folder() as f:
        for name, text in files.items():
            f.write(name, text)
        f.write("scene.yaml", SCENE.replace("{base: stand.yaml, name: second}", "stand.yaml"))
        lines = [line for line in ceduo("--check", "scene.yaml", cwd=f.path).err.splitlines() if "is below" in line]
        expect_equal(lines, ["stand.yaml:8:12: shoots[0].dbh_m: -0.07 is below 0 m"])


def mutations(seed, count):
    """Return shipped files with a few bytes changed, inserted, removed, doubled or swapped."""
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
    """500 random changes of the shipped files: status 0 or 3, no crash, no hang, all places right"""
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
                done = ceduo("--check", scene_path, cwd=f.path)
                expect(done.status in (DONE, INPUT) and (done.status == DONE or done.out == ""), done)
                unlikely = r"(?m)^.*(m2/ha of basal area|shoots a stool are more than|unusual height/diameter ratio).*\n"
                expect((done.status == INPUT) == bool(re.sub(unlikely, "", done.err)), done)
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
    suite.run(list_tests(sys.modules[__name__]))
    for name, old, new, *words in CASES:
        shown = ascii(new.replace("@@", ""))[1:-1]
        suite.check(f"{name}: {shown[:60]}{'...' if len(shown) > 60 else ''}: {', '.join(words)}", refused, name, old, new,
                    *words)
    suite.end()


if __name__ == "__main__":
    main()
