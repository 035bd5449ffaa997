#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""-s changes a value of a scene and is checked like its file."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import (DONE, INPUT, PROFILES, USAGE, Folder, Suite, ceduo, expect, expect_equal, expect_in, expect_near, good, result,
                     scene, stand, list_tests)
from pages import WHOLE
from runs import PAPER


def test_set_rock_and_order():
    """-s goes left to right and is checked like the file"""
    expect_near(result(PAPER, "-n", 1, "-s", "rock.diameter_m=1")["rock"]["mean_diameter_m"], 0.9, 1e-12, "B")
    run = result(PAPER, "-n", 1, "-s", "rock.diameter_m=1", "-s", "rock.diameter_m=0.56", "--seed", 7, "-s",
                 "simulation.seed=8")
    expect_equal((run["rock"]["mean_diameter_m"], run["seed"]), (0.68, 8))
    expect_equal(result(PAPER, "-n", 1, "-s", "simulation.seed=8", "--seed", 7)["seed"], 7)
    expect_equal(result(PAPER, "-s", "simulation.rocks=5")["rocks"], 5)
    expect_equal(result(PAPER, "-s", "title='x: y'", "-n", 1)["title"], "x: y")
    controls = result(PAPER, "-n", 1, "-s", "controls=[{x_m: 100}, {x_m: 20}]")["options"][0]["controls"]
    expect_equal([c["x_m"] for c in controls], [100, 20], "controls in the order given")


def test_set_blanks():
    """Blanks around the = are ignored; other blanks, and a path without a name, are errors"""
    plain = result(PAPER, "-n", 5, "-s", "rock.diameter_m=1", "-s", "title=a b")
    for sets in (["rock.diameter_m = 1", "title = a b"], ["rock.diameter_m =1", "title=  a b "], ["rock.diameter_m   =   1", "title ='a b'"]):
        expect_equal(differ(result(PAPER, "-n", 5, *[w for s in sets for w in ("-s", s)]), plain), [], sets)
    for value, words in ((" = 1", "expected PATH=VALUE"), ("rock. diameter_m = 1", "' diameter_m'"), ("rock.diameter_m = -1", "--set:1:19: "),
                         ("rock .diameter_m = 1", "'rock '"), ("rock.diametr_m = 1", "'diametr_m': unknown key")):
        done = ceduo("--check", "-s", value, PAPER)
        expect(done.status == USAGE and words in done.err, done)


def differ(a, b):
    return [key for key in a if key != "work" and a[key] != b[key]]


def test_set_through_files():
    """-s follows file references, [i] and [name], and changes only that place"""
    def stools(*arguments):
        return [[s["stools_per_ha"] for s in o["stands"]] for o in result(*arguments, "-n", 1)["options"]]
    before = {p: p.read_bytes() for p in PROFILES.rglob("*.yaml")}
    expect_equal(stools(PAPER, "-s", "forest[0].stand.stools.per_ha=2000"), [[2000, 2807]])
    expect_equal(stools(PAPER, "-s", "forest[ADS 2].stand.stools.per_ha=2000"), [[3688, 2000]])
    expect_equal(stools(PAPER, "-s", "forest[ADS 2].stand.stools.per_ha=2000", "-s",
                        "forest[ADS 1].stand.stools.per_ha=1000"), [[1000, 2000]])
    expect_equal(stools(PAPER, "-s", "forest[1].stand=../stands/ads-1.yaml"), [[3688, 3688]])
    stands = result(PAPER, "-n", 1, "-s", "forest[0].stand.trees[0].per_ha=120")["options"][0]["stands"]
    expect_equal([s["trees_per_ha"] for s in stands], [120, 542])
    run = result(PROFILES / "scenes/selection-or-standards.yaml", "-n", 1, "-s",
                 "options[standards, all just cut].forest[0].stand.trees[0].per_ha=333")
    found = [[s["trees_per_ha"] for s in o["stands"]] for o in run["options"]]
    expect(found[0][0] > 300 and found[1][0] < 300, "the second option starts from the same file", found)
    expect_equal(before, {p: p.read_bytes() for p in PROFILES.rglob("*.yaml")}, "files")
    speed = [result(PAPER, "-s", f"slope.segments[5].rn={rn}")["options"][0]["controls"][0]["bare"]["speed_m_s"]["mean"]
             for rn in (0.31, 0.9)]
    expect(speed[0] != speed[1] and speed[0] == result(PAPER)["options"][0]["controls"][0]["bare"]["speed_m_s"]["mean"],
           speed)


def test_set_at_odds():
    """A change that does not fit the rest of a good scene is reported, with status 2; a bad scene remains bad input"""
    for sets, column, words in ((["forest[0].to_m=100"], 16, "forest[1].from_m: belts must not overlap"),
                                (["release.x_m=140"], 13, "controls[0].x_m: 135 must lie beyond the release"),
                                (["slope.vertices_m=[[0,100],[50,0]]"], 18, "13 segments for 1 stretches"),
                                (["rock.shape=sphere", "rock.diameter_m=1"], 12, "does not belong to the shape 'sphere'"),
                                (["simulation.rocks=9", "forest[0].to_m=100", "rock.diameter_m=1"], 16, "belts must not overlap")):
        done = ceduo("--check", *(word for s in sets for word in ("-s", s)), PAPER)
        culprit = next(s for s in sets if "=9" not in s)
        expect(done.status == USAGE and done.out == "", done)
        expect(done.err.startswith(f"--set:1:{column}: the scene is valid without this change, but not with it:\n  {culprit}\n" +
                                   " " * (column + 1) + "^\n"), done)
        expect_in(words, done.err)
        expect_equal(done.err.count("--set:"), 1, done.err)
    both = ["-s", "forest[0].to_m=100", "-s", "forest[1].from_m=100"]  # each alone would not fit
    good("--check", *both, PAPER)
    with Folder() as f:
        path = f.write("s.yaml", scene(controls=[{"x_m": 500}]))
        done = ceduo("--check", "-s", "rock.diameter_m=1", path)
        expect(done.status == INPUT and "--set" not in done.err, done)


def test_set_by_name_twice():
    """-s refuses a name of several belts, and lists their places; it accepts a unique one"""
    with Folder() as f:
        belts = [{"from_m": x, "to_m": x + 9, "stand": stand(name=n)} for x, n in ((10, "a"), (20, "b"), (30, "a"), (40, "a"))]
        path = f.write("s.yaml", scene(forest=belts))
        good("--check", "-s", "forest[b].stand.trees[0].per_ha=1", path)
        good("--check", "-s", "forest[0].stand.trees[0].per_ha=1", path)
        bad_set_on(path, "forest[a].stand.trees[0].per_ha=1", "'a': several items have this name; use one of: [0], [2], [3]")
        bad_set_on(path, "forest[a]={}", "use one of: [0], [2], [3]")
        bad_set_on(path, "forest[c].to_m=1", "'c': no such item")


def test_set_all():
    """-s with [*] sets a value of every item of a list, here or in files; an empty list is unchanged"""
    four, one = "four-systems", [f"options[{i}].forest[0].stand.stools.per_ha=700" for i in range(8)]
    together, apart = (result(four, "-n", 20, *[w for s in sets for w in ("-s", s)]) for sets in
                       (["options[*].forest[*].stand.stools.per_ha=700"], one))
    together["work"] = apart["work"] = None  # it takes that long
    expect_equal(together, apart)
    with Folder() as f:
        belts = [{"from_m": x, "to_m": x + 9, "stand": stand()} for x in (10, 20)]
        path = f.write("s.yaml", scene(forest=belts, uncertainty=[]))
        expect_in("'*': the list is empty", ceduo("--check", "-s", "uncertainty[*].lo=1", path).err)
        done = ceduo("--check", "-s", "forest[*].to_m=-1", path)
        expect_in("--set:1:16: forest[0].to_m", done.err)
        trees = stand(stools=None, shoots=None)
        two = f.write("two.yaml", scene(forest=[{"from_m": x, "to_m": x + 9, "stand": trees} for x in (10, 20)]))
        both, first = (good("-f", "json", "--find", f"forest[{n}].stand.trees[0].per_ha=50:5000", "--goal", "adc=9", where).json()[0]
                       for n, where in (("*", two), ("0", f.write("one.yaml", scene(forest=[{"from_m": 10, "to_m": 19, "stand": trees}])))))
        expect(both["found"] and both["value"] > 50, both)
        expect_equal(both["value"], first["value"], "two belts alike, and one of them")


def bad_set_on(path, change, words):
    done = ceduo("--check", "-s", change, path)
    expect(done.status == USAGE and words in done.err, done)


def test_set_spreads():
    """-s makes a number a distribution, whole or by its parts"""
    whole = result(PAPER, "-s", "rock.diameter_m={mean: 0.56, spread: 0.1, kind: uniform}")
    parts = result(PAPER, "-s", "rock.diameter_m.spread=0.1", "-s", "rock.diameter_m.kind=uniform")
    expect_equal(whole["options"], parts["options"])
    expect(whole["options"] != result(PAPER)["options"], "the spread changes nothing")
    expect_near(whole["rock"]["mean_diameter_m"], 0.68, 1e-12, "rock holds the means")
    expect_equal(result(PAPER, "-s", "rock.diameter_m.spread=0")["options"], result(PAPER)["options"], "spread 0")
    for path in ("release.vx_m_s", "release.vz_m_s", "slope.segments[2].rn", "slope.segments[2].rt"):
        expect(result(PAPER, "-s", f"{path}.spread=0.1")["options"] != result(PAPER)["options"], path)
    expect_in("means", good(*WHOLE, PAPER, "-s", "rock.diameter_m.spread=0.05").out, "table")


def test_set_base():
    """-s reaches into a stand with a base; mappings merge, lists are replaced"""
    with Folder() as f:
        f.write("base.yaml", stand(ceduo="stand/1", name="base"))
        built = {"base": "base.yaml", "stools": {"per_ha": 1500}}
        path = f.write("s.yaml", scene(forest=[{"from_m": 10, "to_m": 60, "stand": built}]))
        def one(*sets):
            return result(path, "-n", 1, *[a for s in sets for a in ("-s", s)])["options"][0]["stands"][0]
        expect_equal((one()["stools_per_ha"], one()["stems_per_ha"], one()["name"]), (1500, 5100, "base (changed)"))
        expect_equal(one("forest[0].stand.stools.per_ha=1800")["stools_per_ha"], 1800)
        expect_equal(one("forest[base].stand.shoots[0].per_ha=4000")["stems_per_ha"], 4100)
        expect_equal(one("forest[0].stand.trees=[]")["trees_per_ha"], 0)
        alike = {"base": "base.yaml", "source": {"kind": "assumed"}}
        path = f.write("s.yaml", scene(forest=[{"from_m": 10, "to_m": 60, "stand": alike}]))
        expect_equal(one()["name"], "base", "nothing is changed but where it comes from")


BAD_SETS = [
    ("rock.diameter_m=-1", "-1 is below 0 m"), ("rock.diameter_m=0", "0 is not above 0 m"),
    ("rock.diametre_m=1", "unknown key"), ("nope=1", "unknown key"), ("rock.diameter_m", "PATH=VALUE"),
    ("=1", "PATH=VALUE"), ("", "PATH=VALUE"), ("forest[9].to_m=1", "no such item"), ("forest[ADS 3].to_m=1", "no such item"),
    ("forest[-1].to_m=1", "no such item"), ("forest[99999999999999999999].to_m=1", "no such item"),
    ("rock..x=1", "malformed path"), ("forest[0=1", "malformed path"), ("forest[].to_m=1", "malformed path"),
    (".rock=1", "malformed path"), ("rock[0]=1", "no list"), ("forest.to_m=1", "no mapping"),
    ("rock.diameter_m=", "no value"), ("rock.diameter_m=abc", "'abc' is not a number"), ("rock.diameter_m='1'", "in quotes"),
    ("rock.diameter_m=1,5", "decimal comma: write 1.5"), ("rock.mass_kg=1,500", "write a dot"), ("rock.diameter_m=nan", "'nan' is not a number"),
    ("rock.diameter_m=1e999", "too large"), ("rock={", "malformed YAML"), ("rock.diameter_m=*x", "alias"),
    ("rock.diameter_m=&x 1", "anchor"), ("rock.diameter_m=!!int 1", "tag"), ("simulation.law=bounce", "unknown"),
    ("simulation.contact_model=pinball", "unknown"), ("simulation.rocks=1.5", "whole number"),
    ("controls[0].x_m=500", "outside the slope"), ("release.x_m=-5", "outside the slope"),
    ("simulation.scale_rn=yes", "true or false"), ("title=[1]", "expected a text"), ("rock.diameter_m=\x1b[31m", "control"),
    ("rock.\x1b[31m=1", "unknown key"),
]


def bad_set(value, words):
    for mode in ("--batch", "--check"):
        done = ceduo(mode, "-s", value, PAPER)
        expect_equal(done.status, USAGE, value)
        expect_equal(done.out, "")
        expect_in(words, done.err, value)
        expect_in("--set", done.err.splitlines()[0], value)
        expect("paper-site.yaml" not in done.err.splitlines()[0], "the fault is not the file's", done)


def test_set_missing_ground():
    """On a slope without ground, the path of the assumed ground sets it; other grounds and forms of the path are refused"""
    with Folder() as f:
        path = f.write("s.yaml", scene(slope={"vertices_m": [[0, 64], [100, 0]]}))
        good("--check", "-s", "slope.materials[talus].rn=0.32", path)
        for step in ("[cliff]", "[0]", "[nope]", "", ".", "["):
            done = ceduo("--check", "-s", f"slope.materials{step}.rn=0.32", path)
            expect_equal((done.status, done.out), (USAGE, ""), done)
            expect_in("--set:1:7: there is no 'materials' here", done.err, step)


def test_set_many_items():
    """A name that no item has: the first twelve are listed"""
    with Folder() as f:
        path = f.write("s.yaml", scene(controls=[{"x_m": 60 + i} for i in range(13)]))
        listed = ", ".join(f"[{i}]" for i in range(12))
        expect_in(f"no such item; there are: {listed}, \u2026\n", ceduo("--check", "-s", "controls[road].x_m=70", path).err)


def test_set_names_the_change():
    """A change that makes many values invalid is named before the first of them"""
    with Folder() as f:
        path = f.write("s.yaml", scene(controls=[{"x_m": 60 + i} for i in range(25)]))
        done = ceduo("--check", "-s", "slope.vertices_m=[[0, 64], [50, 30]]", path)
        expect_equal(done.status, USAGE, done)
        expect(done.err.startswith("--set:1:18: the scene is valid without this change, but not with it:\n"), done)
        expect_in("controls[0].x_m: 60 lies outside the slope, which goes from 0 to 50 m", done.err)
        names = [2 * chr(ord("a") + i) for i in range(23)]  # more kinds of problems than the list has lines
        rows = [{"path": f"controls[{n}].x_m", "lo": 30, "hi": 60} for n in names]
        path = f.write("s.yaml", scene(controls=[{"x_m": 50}], uncertainty=[*rows, {"path": "release.x_m", "lo": 1, "hi": 40}]))
        expect_equal(ceduo("--check", path).status, DONE)
        done = ceduo("--check", "-s", f"controls=[{', '.join(f'{{x_m: {50 + i}, name: {n}}}' for i, n in enumerate(names))}]", path)
        expect(done.err.startswith("--set:1:10: the scene is valid without this change, but not with it:\n"), done)
        expect_in("40 m and 30 m of controls[aa].x_m cannot be computed together", done.err)
        expect_in("\n3 more problems\n", done.err)


def test_set_place():
    """-s shows its own text with a caret under the error"""
    done = ceduo("--batch", "-s", "rock.diameter_m=-1", PAPER)
    expect_equal(done.err, "--set:1:17: rock.diameter_m: -1 is below 0 m\n  rock.diameter_m=-1\n" + " " * 18 + "^\n")


LARGE = "rock.diameter_m: 80 m is unusual (usual: 0.05 to 15 m); check the number and its unit"


def expect_silent(*arguments, **options):
    done = ceduo("--check", *arguments, **options)
    expect_equal((done.status, done.err), (0, ""), done)


def test_unusual():
    """A number beyond the usual range is computed, with a warning on standard error: from a file, -s, a row of --each"""
    tall = {"from_m": 10, "to_m": 70, "stand": "tall.yaml"}
    with Folder() as f:
        f.write("plain.yaml", scene())
        f.write("large.yaml", "ceduo: scene/1\nrock:\n  diameter_m: 80\n" +
                "slope: {vertices_m: [[0, 64], [100, 0]], segments: [{rn: 0.35, rt: 0.8}]}\ncontrols_m: [75]\n")
        f.write("tall.yaml", "ceduo: stand/1\nname: tall\ntrees:\n  - {per_ha: 100, dbh_m: 0.3, height_m: 120, volume_m3: 2}\n")
        f.write("wood.yaml", scene(forest=[tall]))
        f.write("rows.csv", "id,rock.diameter_m\na,80\nb,0.5\nc,0\nd,15\n")
        f.write("plain.csv", "id,release.vx_m_s\na,1\nb,2\n")
        for words, said in ((("large.yaml",), f"large.yaml:3:15: {LARGE}\n    diameter_m: 80\n                ^\n"),
                            (("plain.yaml", "-s", "rock.diameter_m=80"),
                             f"--set:1:17: {LARGE}\n  rock.diameter_m=80\n" + " " * 18 + "^\n"),
                            (("plain.yaml", "-s", "rock.diameter_m={mean: 80, spread: 20}"), "rock.diameter_m.mean: 80 m is unusual"),
                            (("plain.yaml", "-s", "rock={shape: block, axes_m: [1, 1, 16]}"), "rock.axes_m[2]: 16 m is unusual"),
                            (("plain.yaml", "-s", "rock={volume_m3: 3000}"), "rock.volume_m3: 3000 m3 is unusual"),
                            (("plain.yaml", "-s", "controls[0].accepted_kJ=50000"),
                             "controls[0].accepted_kJ: 50000 kJ is unusual (usual: 0 to 20000 kJ)"),
                            (("wood.yaml",), "tall.yaml:4:41: trees[0].height_m: 120 m is unusual (usual: 0.5 to 50 m)")):
            for mode in (("--check",), ("--batch", "-f", "json", "-n", 10)):
                done = ceduo(*mode, *words, cwd=f.path)
                expect_equal((done.status, done.err.count("is unusual")), (0, 1), done)
                expect(done.err.startswith(said) or (said in done.err and not said.endswith("\n")), done)
            expect_equal(len(done.json()), 1)
        for table, name, warned in (("rows.csv", "plain.yaml", f"rows.csv:2: {LARGE}"), ("plain.csv", "large.yaml", LARGE)):
            done = ceduo("--check", "--each", table, name, cwd=f.path)
            expect_in(warned, done.err)
            expect_equal(done.err.count("is unusual"), 1, done)
        expect_silent("-s", "rock.diameter_m=15", "-s", "release.height_m=0", "-s", "controls[0].accepted_kJ=0", "plain.yaml",
                      cwd=f.path)
        bad = ceduo("--check", "-s", "rock.diameter_m=80", "-s", "controls[0].x_m=-1", "plain.yaml", cwd=f.path)
        expect(bad.status == USAGE and "unusual" not in bad.err, "what is wrong comes first", bad)


def test_shipped_are_usual():
    """No shipped scene or stand has an unusual value"""
    with Folder() as f:
        expect_silent(*(PROFILES / "scenes").glob("*.yaml"))
        for path in (PROFILES / "stands").glob("*.yaml"):
            expect_silent(f.write("s.yaml", scene(forest=[{"from_m": 10, "to_m": 70, "stand": str(path)}])))


def main():
    suite = Suite()
    suite.run(list_tests(sys.modules[__name__]))
    for value, words in BAD_SETS:
        suite.check(f"-s {ascii(value)}: status 2, {words}", bad_set, value, words)
    suite.end()


if __name__ == "__main__":
    main()
