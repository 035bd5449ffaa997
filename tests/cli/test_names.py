#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Ambiguous names: refused, or resolved by a fixed order."""
import json
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import (INPUT, USAGE, Folder, belt, ceduo, expect, expect_equal, expect_in, good, result, run_all,  # noqa: E402
                     scene, stand)

TWICE = "several items have this name; use one of: "


def refused(path, change, *words):
    done = ceduo("--check", "-s", change, path)
    expect(done.status == USAGE and done.out == "" and all(w in done.err for w in words), change, done)
    return done


def test_two_of_a_name():
    """-s refuses a name of exactly two items, anywhere, with its place in the typed text"""
    with Folder() as f:
        belts = [belt(x, x + 9, name=n) for x, n in ((10, "a"), (20, "b"), (30, "b"), (40, "c"), (50, "a"))]
        path = f.write("s.yaml", scene(forest=belts, controls=[{"x_m": 70, "name": "road"}, {"x_m": 80, "name": "road"},
                                                               {"x_m": 75, "name": "track"}, {"x_m": 90}]))
        done = refused(path, "forest[a].to_m=18", f"'a': {TWICE}[0], [4]\n")
        expect(done.err.startswith("--set:1:8: 'a'") and done.err.endswith(f"\n  forest[a].to_m=18\n{' ' * 9}^\n"), done)
        refused(path, "forest[b].stand.trees[0].per_ha=18", f"'b': {TWICE}[1], [2]\n")
        refused(path, "controls[road].x_m=65", f"'road': {TWICE}[0], [1]\n")
        for change in ("forest[c].to_m=48", "forest[0].to_m=18", "controls[track].x_m=76", "controls[1].x_m=81"):
            good("--check", "-s", change, path)
        # two made by an earlier change, or one again
        done = ceduo("--check", "-s", "forest[3].stand.name=d", "-s", "forest[1].stand.name=d", "-s", "forest[d].to_m=1", path)
        expect(done.status == USAGE and f"'d': {TWICE}[1], [3]\n" in done.err, done)
        good("--check", "-s", "forest[4].stand.name=d", "-s", "forest[a].to_m=18", path)


def test_names_of_files():
    """A belt has the name of its stand's file, or the scene's name for it: two equal ones are refused too"""
    with Folder() as f:
        f.write("stand.yaml", stand(ceduo="stand/1", name="wood"))
        belts = [{"from_m": x, "to_m": x + 9, "stand": s} for x, s in (
            (10, "stand.yaml"), (20, {"base": "stand.yaml"}), (30, {"base": "stand.yaml", "name": "own"}))]
        path = f.write("s.yaml", scene(forest=belts))
        refused(path, "forest[wood].to_m=18", f"'wood': {TWICE}[0], [1]\n")
        run = result(path, "-n", 1, "-s", "forest[own].stand.stools.per_ha=1000")
        expect_equal([s["stools_per_ha"] for s in run["options"][0]["stands"]], [2000, 2000, 1000])


def test_items_without_names():
    """Stems, segments and vertices have no names, only indices"""
    with Folder() as f:
        path = f.write("s.yaml", scene(forest=[belt(10, 60, name="a")]))
        for change in ("forest[a].stand.trees[a].per_ha=5", "forest[0].stand.shoots[coppice].per_ha=5000",
                       "slope.segments[against].rn=0.3", "slope.vertices_m[x]=[0, 64]", "forest[a].stand.trees[1].per_ha=5"):
            refused(path, change, ": no such item")
        good("--check", "-s", "forest[a].stand.trees[0].per_ha=5", path)


def test_options_of_a_name():
    """Options with equal names are bad input; a change may repair them by index, but not by that name"""
    with Folder() as f:
        path = f.write("s.yaml", scene(options=[{"name": n, "forest": []} for n in ("a", "b", "a")]))
        done = ceduo("--check", path)
        expect(done.status == INPUT and "options[2].name: 'a' is given twice" in done.err, done)
        refused(path, "options[a].name=c", f"'a': {TWICE}[0], [2]\n")
        good("--check", "-s", "options[2].name=c", path)
        good("--check", "-s", "options[2].name=c", "-s", "options[a].name=d", path)
        done = ceduo("--check", "-s", "options[b].name=a", "-s", "options[2].name=c", path)
        expect(done.status == USAGE and "options[1].name: 'a' is given twice" in done.err, done)


def test_names_with_signs():
    """A name in brackets may contain dots, an equals sign and an opening bracket; digits are an index"""
    with Folder() as f:
        names = ["a=b", "1.5 m", "x[y", "7", "0"]
        path = f.write("s.yaml", scene(options=[{"name": n, "forest": [belt(10, 60)]} for n in names]))
        for i, name in enumerate(names[:3]):
            run = result(path, "-n", 1, "-s", f"options[{name}].forest[0].stand.trees[0].per_ha={i + 1}", "--option", name)
            expect_equal(run["options"][0]["stands"][0]["trees_per_ha"], i + 1, name)
        refused(path, "options[7].forest=[]", "'7': no such item")
        run = result(path, "-n", 1, "-s", "options[0].name=first")
        expect_equal([o["name"] for o in run["options"]], ["first", *names[1:]], "0 is the place")


def test_name_with_a_number_sign():
    """A '#' in a name begins no comment: in a path of -s, of --find, of a row of a table and of uncertainty"""
    name = "road #2"
    with Folder() as f:
        place = f"controls[{name}].accepted_kJ"
        uncertainty = [{"path": place, "lo": 40, "hi": 60}, {"path": "rock.density_kg_m3", "lo": 2500, "hi": 2700}]
        path = f.write("s.yaml", scene(controls=[{"x_m": 70, "name": name, "accepted_kJ": 50}], uncertainty=uncertainty))
        for change, wanted in ((f"{place}=70", (name, 70)), (f'controls[{name}].name="way #3"', ("way #3", 50))):
            control = result("-n", 5, "-s", change, path)["options"][0]["controls"][0]
            expect_equal((control["name"], control["accepted_kJ"]), wanted, change)
        figures = good("--sensitivity=16", "-n", 20, "-f", "json", path).json()[0]["figures"]
        expect(any(i["path"] == place for f in figures for i in f["inputs"]), figures)
        found = good("--find", f"{place}=1:1e5", "--goal", "exceed=0.5", "-n", 20, "-f", "json", path).json()[0]
        expect_equal(found["path"], place)
        table = f.write("t.csv", f"{place}\n60\n80\n")
        rows = good("-b", "-q", "--each", table, "-n", 5, "-f", "json", path).json()
        expect_equal([r["options"][0]["controls"][0]["accepted_kJ"] for r in rows], [60, 80])


def test_file_that_is_no_utf8():
    """JSON is UTF-8 for any file name: invalid bytes become U+FFFD"""
    with Folder() as f:
        plain = f.write("s.yaml", scene(uncertainty=[{"path": "rock.density_kg_m3", "lo": 2500, "hi": 2700}]))
        odd = os.fsencode(f.path) + b"/x\xff\xed\xa0\xbd.yaml"
        Path(os.fsdecode(odd)).write_bytes(Path(plain).read_bytes())
        for words in (("-b",), ("--sensitivity=16",), ("--find", "controls[0].x_m=61:79", "--goal", "arrive=0.5")):
            done = good(*words, "-n", 20, "-f", "json", os.fsdecode(odd))
            names = [r["scene"] for r in (json.loads(line) for line in done.out_bytes.decode("utf-8").splitlines())]
            expect(len(names) == 1 and names[0].endswith("/x\ufffd\ufffd\ufffd\ufffd.yaml"), words, names)


def test_find_by_name():
    """--find accepts an item by its name, and refuses a name of two"""
    with Folder() as f:
        path = f.write("s.yaml", scene(forest=[belt(10, 20, name="a"), belt(20, 30, name="b"), belt(30, 40, name="a")]))
        goal = ("--goal", "adc=30", "-n", 1)
        good("--find", "forest[b].stand.stools.per_ha=500:2000", *goal, path)
        done = ceduo("--find", "forest[a].stand.stools.per_ha=500:2000", *goal, path)
        expect(done.status == USAGE and done.out == "" and f"'a': {TWICE}[0], [2]\n" in done.err, done)


def test_option_doubled():
    """--option twice with one name counts once; an unknown name is refused with any others"""
    with Folder() as f:
        path = f.write("s.yaml", scene(options=[{"name": n, "forest": [belt(10, 60)]} for n in ("a", "b", "c")]))
        def names(*wanted):
            return [o["name"] for o in result(path, "-n", 20, *(w for n in wanted for w in ("--option", n)))["options"]]
        expect_equal(names("b", "b"), ["b"])
        expect_equal(names("c", "a", "c"), ["a", "c"])
        for wanted in (("a", "nope"), ("nope", "a"), ("a", "a", "")):
            done = ceduo("--batch", path, *(w for n in wanted for w in ("--option", n)))
            expect(done.status == USAGE and done.out == "" and "it has: 'a', 'b', 'c'\n" in done.err, done)
        find = ("--find", "options[a].forest[0].stand.stools.per_ha=500:2000", "--goal", "adc=30", "-n", 1, path)
        expect_equal(good(*find, "--option", "a", "--option", "a").out, good(*find, "--option", "a").out, "--find")
        for wanted in ((), ("--option", "a", "--option", "b")):
            done = ceduo(*find, *wanted)
            expect(done.status == USAGE and "name one with --option" in done.err, done)
        done = ceduo(*find, "--option", "a", "--option", "nope")
        expect(done.status == USAGE and done.out == "" and "no option 'nope'" in done.err, done)


def test_profiles_in_several_places():
    """The first profile of a name is used: next to the scene, the user's own, the program's"""
    with Folder() as f:
        f.write("scenes/s.yaml", scene(forest=[{"from_m": 10, "to_m": 20, "stand": "ads-1.yaml"},
                                               {"from_m": 30, "to_m": 40, "stand": "ads-1"},
                                               {"from_m": 50, "to_m": 60, "stand": "../stands/ads-1.yaml"}]))
        def used_names(**options):
            return [s["name"] for s in result("scenes/s.yaml", "-n", 1, cwd=f.path, env={"XDG_DATA_HOME": str(f.path / "data")},
                                              **options)["options"][0]["stands"]]
        def write_stand(name, title):
            f.write(name, stand(ceduo="stand/1", name=title))
        expect_equal(used_names(), ["ADS 1"] * 3, "the program's")
        write_stand("ads-1.yaml", "in the current folder")  # not of a scene
        write_stand("data/stands/ads-1.yaml", "in the folder above the own profiles")
        expect_equal(used_names(), ["ADS 1"] * 3, "not profiles")
        write_stand("data/ceduo/stands/ads-1.yaml", "own")
        expect_equal(used_names(), ["own"] * 3)
        write_stand("data/ceduo/ads-1.yaml", "own, of no kind")  # the exact path precedes the folder of its kind
        expect_equal(used_names(), ["own, of no kind", "own", "own"])
        write_stand("data/ceduo/stands/ads-1", "own, without .yaml")
        expect_equal(used_names(), ["own, of no kind", "own, without .yaml", "own"])
        write_stand("scenes/ads-1.yaml", "beside")
        expect_equal(used_names(), ["beside", "own, without .yaml", "own"])
        write_stand("scenes/ads-1", "beside, without .yaml")
        expect_equal(used_names(), ["beside", "beside, without .yaml", "own"])
        write_stand("stands/ads-1.yaml", "where it says")
        expect_equal(used_names(), ["beside", "beside, without .yaml", "where it says"])


def test_scenes_in_several_places():
    """A scene on the command line is the file of the current folder, the user's own, or the program's"""
    with Folder() as f:
        def title():
            return result("paper-site", "-n", 1, cwd=f.path, env={"XDG_DATA_HOME": str(f.path / "data")})["title"]
        expect_equal(title(), "Test site of Ciabocco et al. 2009")
        f.write("data/ceduo/scenes/paper-site.yaml", scene(title="own"))
        expect_equal(title(), "own")
        f.write("paper-site.yaml", scene(title="another name"))
        expect_equal(title(), "own")
        f.write("paper-site", scene(title="here"))
        expect_equal(title(), "here")


def test_files_of_changes():
    """A file that -s names is searched from the scene, then from the current folder: stands, slopes, profiles"""
    with Folder() as f:
        path = f.write("scenes/s.yaml", scene(forest=[belt(10, 60)]))
        here = f.path / "here"
        for folder, name, bottom in (("scenes", "beside", 10), ("here", "current", 20)):
            f.write(f"{folder}/x.yaml", stand(ceduo="stand/1", name=name))
            f.write(f"{folder}/x.csv", f"distance,elevation\n0,64\n100,{bottom}\n")
            f.write(f"{folder}/{name}.yaml", stand(ceduo="stand/1", name=name))
            f.write(f"{folder}/{name}.csv", f"distance,elevation\n0,64\n100,{bottom}\n")
        ground = "segments: [{rn: 0.35, rt: 0.875}]"
        def speed(bottom):
            whole = f.write("whole.yaml", scene(slope={"vertices_m": [[0, 64], [100, bottom]], "segments": [
                {"rn": 0.35, "rt": 0.875}]}, forest=[belt(10, 60)]))
            return result(whole)["options"][0]["controls"][0]["bare"]
        for name, wanted, bottom in (("x", "beside", 10), ("beside", "beside", 10), ("current", "current", 20)):
            for value in (f"{name}.yaml", f"{{base: {name}.yaml}}"):
                run = result(path, "-n", 1, "-s", f"forest[0].stand={value}", cwd=here)
                expect_equal(run["options"][0]["stands"][0]["name"], wanted, value)
            run = result(path, "-s", f"slope={{csv: {name}.csv, {ground}}}", cwd=here)
            expect_equal(run["options"][0]["controls"][0]["bare"], speed(bottom), name)
        done = ceduo("--check", "-s", "slope=nowhere.csv", path, cwd=here)
        expect(done.status == USAGE, done)
        expect_in("cannot find 'nowhere.csv'", done.err)


if __name__ == "__main__":
    run_all(__name__)
