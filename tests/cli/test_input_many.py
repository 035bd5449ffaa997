#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Many problems in one file, each reported once, and files that refer to others: bases, options, materials."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import Folder, expect, expect_equal, expect_in, expect_near, good, result, run_all, scene, stand
from inputs import FILES, SLOPE, STAND, check, expect_places, flat_scene


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


def test_kinds():
    """Problems of one kind are reported once, with the number and lines of the others; other keys and words are other kinds"""
    rows = "".join(f"  - {{x_m: {x}, accepted_kJ: {a}}}\n" for x, a in
                   ((-1, 5), (-2, -5), (-3, -6), (-4, 7), (-5, "x"), (-6, 8), (-7, 9)))
    data = flat_scene().decode().replace("  - {x_m: 75, name: road, accepted_kJ: 50}\n  - {x_m: 90}\n", rows)
    expect_in(rows, data, "the scene")
    first = data[:data.index(rows)].count("\n") + 1
    with Folder() as f:
        f.write("s.yaml", data)
        told = [line for line in check(f, "s.yaml").err.splitlines() if line.startswith("s.yaml") or "of this kind" in line]
    more = ", ".join(str(first + i) for i in range(1, 6))
    expect_equal(told, [f"s.yaml:{first + 1}:28: controls[1].accepted_kJ: -5 is below 0 kJ", f"  and 1 more of this kind, on line {first + 2}",
                        f"s.yaml:{first + 4}:28: controls[4].accepted_kJ: 'x' is not a number",
                        f"s.yaml:{first}:11: controls[0].x_m: -1 lies outside the slope, which goes from 0 to 100 m",
                        f"  and 6 more of this kind, on line {more} …"])


def test_decimal_commas():
    """A decimal comma is reported, also if it splits a number into two list entries; other lists are not"""
    for text, words in (("rock: {diameter_m: 0,6, density_kg_m3: 2600}", "rock.diameter_m: decimal comma: write 0.6"),
                        ("rock: {density_kg_m3: 2600, diameter_m: 0,56}", "rock.diameter_m: decimal comma: write 0.56"),
                        ("rock: {diameter_m: 0,06}", "rock.diameter_m: decimal comma: write 0.06"),
                        ("rock: {diameter_m: 1}\nrelease: {vz_m_s: -0,3}", "release.vz_m_s: decimal comma: write -0.3"),
                        ("rock: {diameter_m: 1}\nrelease:\n  vz_m_s: -0,3", "release.vz_m_s: decimal comma: write -0.3"),
                        ("rock: {diameter_m: 0,350}", "rock.diameter_m: decimal comma: write 0.350"),
                        ("rock:\n  diameter_m: 0,350", "rock.diameter_m: decimal comma: write 0.350"),
                        ("rock:\n  diameter_m: 0,6x", "'0,6x' is not a number; write a dot for the decimals and"),
                        ("rock:\n  diameter_m: x%", "'x%' is not a number\n"),
                        ("rock: {diameter_m: 1, 6}", "rock.6: unknown key"),
                        (f"rock: {{diameter_m: 1,\n{21 * ' '}6}}", "rock.6: unknown key"),
                        ("rock: {diameter_m: 1, shape: sphere,6}", "rock.6: unknown key")):
        with Folder() as f:
            f.write("s.yaml", f"ceduo: scene/1\n{text}\n{GROUND}controls_m: [90]\n")
            lines = [line for line in check(f, "s.yaml").err.splitlines() if line.startswith("s.yaml")]
        expect(len(lines) == 1 and words in f"{lines[0]}\n", text, lines)
    expect_problems("ceduo: scene/1\nrock: {diameter_m: ,6}\ncontrols_m: [90]\n" + GROUND, "rock.diameter_m: '' is not a number", "rock.6: unknown key")
    expect_equal(good("--check", "-s", "title='0,5'", "-s", "title=0,5", "paper-site").err, "")


def test_all_at_once():
    """Several kinds of problem in one file are all reported together"""
    with Folder() as f:
        data = flat_scene().decode().replace("diameter_m: 0.5", "diameter_m: -0.5").replace("x_m: 90", "x: 90").replace(
            "vx_m_s: 1", "vx_m_s: fast")
        f.write("s.yaml", data)
        problems = expect_places(check(f, "s.yaml").err, {"s.yaml": data})
        expect_equal([p[1] for p in problems], [3, 4, 8], str(problems))  # the missing x_m follows from 'x'


def expect_problems(text, *wanted, more=None):
    """Expect one problem for each of `wanted`, which it contains, and no others."""
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
    """A missing reference is one problem; all other parts are still checked"""
    expect_problems("ceduo: scene/1\nrock: {diameter_m: -1}\n" + GROUND + "controls: [{x_m: 900}, {x_m: a}]\nforest:\n"
                    "  - {from_m: 10, to_m: 40, stand: nowhere}\n  - {from_m: 30, to_m: 70, stand: {base: nothing, shoots: [{per_ha: -7}]}}\n",
                    "cannot find 'nowhere'", "cannot find 'nothing'",
                    "rock.diameter_m: -1", "controls[0].x_m: 900 lies outside", "controls[1].x_m: 'a'",
                    "forest[1].from_m: belts must not overlap", "shoots[0].per_ha: -7")
    expect_problems("ceduo: scene/1\nrock: {diameter_m: 0.5}\nslope: nowhere\ncontrols: [{x_m: 5}, {x_m: 5}]\n"
                    "forest: [{from_m: 40, to_m: 10, stand: stand.yaml}]\n",
                    "cannot find 'nowhere'", "controls[1].x_m: '5' is given twice", "forest[0].to_m: the end (10) must lie beyond the start")
    expect_problems(HEAD + "controls_m: [75]\nforest: [{from_m: 10, to_m: 40, stand: bad.yaml}, {from_m: 40, to_m: 30, stand: bad.yaml}]\n",
                    "malformed YAML", "forest[1].to_m: the end (30) must lie beyond", more={"bad.yaml": "name: [\n"})


def test_all_with_values():
    """Inconsistent values are reported with wrong and missing values, if they are valid themselves"""
    expect_problems("ceduo: scene/1\n", "'rock' is missing", "'slope' is missing", "'controls' is missing")
    expect_problems("ceduo: scene/1\nrock: {shape: cube, height_m: 1}\nrelease: {x_m: b, height_m: -1}\n"
                    "slope: {vertices_m: [[0, 64], [50], [40, 20], [30, 0]], segments: [{rn: 2, rt: 0.8}, {rn: 0.3}], "
                    "materials: [{from_m: 0, to_m: 0, material: cliff}]}\n"
                    "controls: [{x_m: 9}, {x_m: 9, accepted_kJ: -1}]\n"
                    "forest: [{from_m: 10, to_m: x, stand: {stools: {per_ha: 9}, shoots: [{per_ha: 5, dbh_m: 1, height_m: 1}]}}, "
                    "{from_m: 9, to_m: 8, stand: {shoots: [{per_ha: 5, dbh_m: 0, height_m: 1}]}}]\n",
                    "rock.shape: 'cube'", "release.x_m: 'b'", "release.height_m: -1", "slope.vertices_m[1]: expected [x, z]",
                    "slope.vertices_m[3]: x must rise, but 30 follows 40", "2 segments for 3 stretches", "segments[0].rn: 2", "'rt' is missing",
                    "slope.materials: segments already says this", "controls[1].x_m: '9' is given twice", "controls[1].accepted_kJ: -1", "to_m: 'x'",
                    "'spacing_m' is missing", "5 shoots are too few for 9 stools", "forest[1].to_m: the end (8) must lie", "shoots without stools",
                    "dbh_m: 0 is not above")
    expect_problems(HEAD + "release: {x_m: 99, vx_m_s: y}\ncontrols_m: [z, 75, 200, 75]\n"
                    "forest: [{from_m: -5, to_m: 200, stand: stand.yaml}]\n",
                    "release.vx_m_s: 'y'", "controls_m[0]: 'z'", "controls_m[1]: 75 must lie beyond the release",
                    "and 1 more of this kind, on line 5", "controls_m[2]: 200 lies outside", "forest[0].from_m: -5 lies outside",
                    "forest[0].to_m: 200 lies outside the slope")
    expect_problems("ceduo: scene/1\nrock: {}\nslope: {vertices_m: [[0, 9], [9, 0]], materials: [{from_m: 0, to_m: 4, material: sand}, "
                    "{from_m: 5, to_m: 8, material: talus}]}\noptions: [{name: a}, {forest: b}, {name: a}]\n",
                    "one of diameter_m, volume_m3 and mass_kg", "'sand' is unknown", "materials[1].from_m: 5 leaves a gap",
                    "options[1]: 'name' is missing", "options[1].forest: expected a list", "options[2].name: 'a' is given twice",
                    "'controls' is missing")


def test_all_but_what_follows():
    """Consequences of another problem are not reported"""
    expect_problems("ceduo: scene/1\nrock: {diametre_m: 0.5}\nslope: {vertices_m: 5, materials: 6}\ncontrol: [{x_m: 900}]\n"
                    "forest: [{from_m: 10, to_m: 400, stand: {stools: 7, shoots: [{per_ha: 9, dbh_m: 1, height_m: 1}]}}]\n",
                    "rock.diametre_m: unknown key", "slope.vertices_m: expected a list", "slope.materials: expected a list", "control: unknown key",
                    "stools: expected a mapping")
    expect_problems(HEAD + "controls: 75\noptions: {}\n", "controls: expected a list", "options: expected a list")
    expect_problems(HEAD.replace("segments: [{rn: 0.3, rt: 0.8}]", "csv: [x]") + "controls_m: [50]\n", "slope.csv: vertices_m already says this")
    expect_problems(HEAD.replace("diameter_m: 0.5", "shape: 5, height_m: 9") + "release: 7\ncontrols_m: [50]\nforest: [9, {from_m: 8}]\n",
                    "rock.shape: '5'", "release: expected a mapping", "forest[0]: expected a mapping", "'to_m' is missing", "'stand' is missing")


def stand_fault(body, *words, place=None, more=None):
    with Folder() as f:
        for name, text in {**FILES, "stand.yaml": body, **(more or {})}.items():
            f.write(name, text)
        done = check(f, "scene.yaml")
        expect(all(w in done.err for w in words), f"none says {words}", done)
        if place:
            expect_in(place, done.err)


def test_base_loop():
    """Stands that are each other's base are refused"""
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
    """An error in a base is shown in the base's file, an error in an overriding value in its own file"""
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
    """Options: a repeated name, no name, an empty list, an error deep inside, each at its place"""
    head = flat_scene().decode()
    belt = "{from_m: 10, to_m: 20, stand: {trees: [{per_ha: 10, dbh_m: @, height_m: 9}]}}".replace("@", "0.2")
    for tail, line, words in (
            ("options:\n  - {name: a}\n  - {name: a}\n", 11, "options[1].name: 'a' is given twice"),
            ("options:\n  - {name: a}\n  - {forest: []}\n", 11, "options[1]: 'name' is missing"),
            ("options: []\n", 9, "options: the list is empty"),
            ("options: {name: a}\n", 9, "expected a list"),
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
    for rows, words in (([row(0, 40), row(50, 100)], "materials[1].from_m: 50 leaves a gap or an overlap; begin at 40"),
                        ([row(0, 40), row(30, 100)], "materials[1].from_m: 30 leaves a gap or an overlap"),
                        ([row(10, 100)], "materials[0].from_m: 10 leaves a gap"),
                        ([row(0, 90)], "materials[0].to_m: 90 is before the end of the profile, 100"),
                        ([row(40, 40)], "materials[0].to_m: the end (40) must lie beyond the start"),
                        ([row(0, 100, "lava")], "'lava' is unknown"), ([], "the list is empty")):
        materials_refused(rows, words)
    with Folder() as f:
        split = scene(slope={"vertices_m": [[0, 64], [100, 0]], "materials": [row(-5, 30), row(30, 200, "colluvium")]})
        good("--batch", f.write("s.yaml", split))


if __name__ == "__main__":
    run_all(__name__)
