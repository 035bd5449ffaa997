#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Forests of all kinds: rocks meet the expected number of stems, and each takes the expected energy."""
import math
import json
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import (FULL, INPUT, USAGE, Folder, Suite, belt, ceduo, expect, expect_equal, expect_in, expect_near, good, result, stand, list_tests,
                     wooded_scene)
from pages import WHOLE, expect_width
from runs import expect_run

# Too light to take energy, too tall to be flown over: the trajectory is that without forest.
GHOST = {"height_m": 60, "volume_m3": 1e-9}


def ghosts(stools=2000, spacing=0.25, shoots=5000, dbh=0.0625, trees=0, tree_dbh=0.25, **changes):
    """Return a stand of such stems."""
    made = {"stools": {"per_ha": stools, "spacing_m": spacing}, "shoots": [{**GHOST, "per_ha": shoots, "dbh_m": dbh}]}
    made = stand(**(made if stools else {"stools": None, "shoots": None}),
                 trees=[{**GHOST, "per_ha": trees, "dbh_m": tree_dbh}] if trees else [])
    made.update(changes)
    return made


def expect_contacts(found, length, rate, rocks, what, clumps=1.0):
    """Expect a mean number of hits over some metres; `clumps`: hits at a time, for the error of small numbers."""
    contacts = found["contacts"]
    wanted = length * rate
    error = max(contacts["se"], math.sqrt(wanted * clumps / rocks))
    expect_near(contacts["mean"], wanted, 4.5 * error + 1e-4 * wanted, what)


EXTREMES = [
    # (name, stand, rocks, shoots at a time)
    ("100000 shoots a hectare", ghosts(stools=20000, shoots=100000), 400, 5),
    ("0.1 trees a hectare", ghosts(stools=0, trees=0.1), 20000, 1),
    ("shoots 2 m farther apart than the rock is wide", ghosts(spacing=2.75), 2000, 3),
    ("200 shoots on each stool", ghosts(stools=50, shoots=10000, spacing=0.2), 2000, 60),
    ("a shoot on each stool", ghosts(stools=3000, shoots=3000, spacing=0.5), 2000, 1),
    ("one stool in 100 ha", ghosts(stools=0.01, shoots=0.05), 20000, 5),
    ("shoots of 2 mm", ghosts(dbh=0.002), 2000, 3),
    ("trees of 2 m", ghosts(stools=0, trees=200, tree_dbh=2), 2000, 1),
    ("shoots and trees", ghosts(trees=300), 2000, 3),
]


def extreme(_, wood, rocks, clumps):
    with Folder() as f:
        path = f.write("s.yaml", wooded_scene(forest=[{"from_m": 10, "to_m": 95, "stand": wood}], simulation={"rocks": rocks, "contact_dbh_m": 0}))
        run = result(path)
        expect_run(run)
        option = run["options"][0]
        control = option["controls"][1]
        adc = option["stands"][0]["adc"]
        rate = 1 / adc["gsteiger_stems_m"]
        expect_contacts(control["wooded"], 85, rate, rocks, "stems met", clumps)
        bare = control["bare"]
        for name in ("reach_probability", "exceed_probability"):
            expect_near(control["wooded"][name], bare[name], 0.003, name)
        expect_near(control["wooded"]["energy_kJ"]["mean"], bare["energy_kJ"]["mean"], 0.02 * bare["energy_kJ"]["mean"],
                    "such stems take nothing")
        text = good(*WHOLE, path, "-n", min(rocks, 500)).out
        expect("nan" not in text.lower() and "inf " not in text.lower(), text)
        expect_width(text)


def test_release_in_belt():
    """A release inside a belt meets the stems after it, for any belts above it"""
    with Folder() as f:
        wood = ghosts(trees=300)
        for forest in ([(10, 95)], [(10, 50), (50, 95)], [(0, 30), (40, 95)]):
            path = f.write("s.yaml", wooded_scene(forest=[{"from_m": a, "to_m": b, "stand": wood} for a, b in forest]))
            for release in ("50", "{mean: 50, spread: 9.5, kind: uniform}"):
                run = result(path, "-s", f"release.x_m={release}")
                expect_run(run)
                adc = run["options"][0]["stands"][0]["adc"]
                rate = 1 / adc["gsteiger_stems_m"]
                expect_contacts(run["options"][0]["controls"][1]["wooded"], 45, rate, 2000, f"{forest}, {release}", 3)


def test_release_uphill():
    """Rocks thrown uphill meet the stems there once, not again on their way down, and then those below the release"""
    with Folder() as f:
        wood = ghosts(stools=0, trees=2000)
        uphill = {"x_m": 50, "height_m": 1, "vx_m_s": -9, "vz_m_s": 8}
        options = [{"name": name, "forest": [{"from_m": a, "to_m": b, "stand": wood}]}
                   for name, a, b in (("all", 0, 105), ("above", 0, 50), ("below", 50, 105), ("top", 0, 25))]
        path = f.write("s.yaml", wooded_scene(forest=None, release=uphill, options=options, controls=[{"x_m": 105}]))
        run = result(path)
        expect_run(run)
        met = {o["name"]: o["controls"][0]["wooded"]["contacts"] for o in run["options"]}
        adc = run["options"][0]["stands"][0]["adc"]["adc_m"]
        error = 4.5 * math.hypot(met["all"]["se"], met["above"]["se"], met["below"]["se"])
        expect_near(met["below"]["mean"] * adc, 55, 4.5 * met["below"]["se"] * adc, "metres below the release")
        expect(2 < met["above"]["mean"] * adc < 25, "metres above the release", met)
        expect_near(met["all"]["mean"], met["above"]["mean"] + met["below"]["mean"], error, "all")
        expect_equal(met["top"], {"mean": 0, "se": 0}, "where no rock comes")
        stopping = {**wood, "trees": [{"per_ha": 4000, "dbh_m": 0.4, "height_m": 60, "volume_m3": 5}]}
        path = f.write("s.yaml", wooded_scene(release=uphill, forest=[{"from_m": 0, "to_m": 50, "stand": stopping}]))
        option = result(path)["options"][0]
        expect(option["ends"]["stopped_by_stems"] > 0.9 and option["stop_x_m"]["max"] < 160, option["ends"])
        expect(option["stop_x_m"]["p50"] < 50, "stopped above their release", option["stop_x_m"])


def test_dbh_spread():
    """dbh_sd_m: the number of met stems is that of their mean diameter"""
    with Folder() as f:
        shoots = [{**GHOST, "per_ha": 5000, "dbh_m": 0.0625, "dbh_sd_m": 0.03}]
        trees = [{**GHOST, "per_ha": 300, "dbh_m": 0.25, "dbh_sd_m": 0.15}]
        for name, wood in (("shoots", stand(shoots=shoots, trees=[])), ("trees", stand(stools=None, shoots=None, trees=trees))):
            path = f.write("s.yaml", wooded_scene(forest=[{"from_m": 10, "to_m": 95, "stand": wood}]))
            run = result(path)
            expect_run(run)
            adc = run["options"][0]["stands"][0]["adc"]
            rate = 1 / adc["gsteiger_stems_m"]
            expect_contacts(run["options"][0]["controls"][1]["wooded"], 85, rate, 2000, name, 3)


def loss_per_contact(folder, wood):
    """Return kJ that a very heavy rock loses per stem, just after a short belt; its error; and W of Eq. 3."""
    path = folder.write("s.yaml", wooded_scene(
        forest=None, options=[{"name": "none"}, {"name": "wood", "forest": [{"from_m": 55, "to_m": 59, "stand": wood}]}],
        rock={"shape": "sphere", "diameter_m": 3}, controls=[{"x_m": 61}], simulation={"rocks": 4000}))
    run = result(path)
    option, difference = run["options"][1], run["differences"][0]["energy_per_released_kJ"]
    contacts = option["controls"][0]["wooded"]["contacts"]["mean"]
    return -difference["mean"] / contacts, difference["se"] / contacts, option["stands"][0]["energy_per_contact_J"] / 1000


def test_energy_taken():
    """A hit takes W of Eq. 3 (brauner, whole), or by offset a share of W or of Dorren's energy, 0.558 on average"""
    with Folder() as f:
        tree = {"per_ha": 500, "dbh_m": 0.3, "height_m": 30, "volume_m3": 0.4}
        shoot = {"per_ha": 4000, "dbh_m": 0.12, "height_m": 30, "volume_m3": 0.1}
        for energy, per_tree, per_shoot in (({"u_J_m3": 100000, "offset": "whole"}, 40, 10), ({"u_J_m3": 100000}, 0.558 * 40, 0.558 * 10),
                                            ({"model": "dorren", "fracture_ratio": 1.5}, 0.558 * 1.5 * 0.0387 * 30 ** 2.31,
                                             0.558 * 1.5 * 0.0387 * 12 ** 2.31)):
            trees = stand(stools=None, shoots=None, trees=[tree], energy=energy)
            shoots = stand(stools={"per_ha": 1500, "spacing_m": 0.4}, shoots=[shoot], trees=[], energy=energy)
            for wood, wanted in ((trees, per_tree), (shoots, per_shoot)):
                found, error, said = loss_per_contact(f, wood)
                expect_near(said, wanted, 0.002 * wanted, f"{energy}: energy_per_contact_J")
                # ground contacts between take their share of the remaining energy
                expect_near(found, wanted, 4.5 * error + 0.06 * wanted, f"{energy}: taken by a hit")


def test_energy_spread():
    """dbh_sd_m: thicker stems, which are met more often, take more"""
    with Folder() as f:
        mean, sd, rock = 0.3, 0.12, 3
        shape, scale = (mean / sd) ** 2, sd * sd / mean
        cube = shape * (shape + 1) * (shape + 2) * scale ** 3
        # W is proportional to the squared diameter, the encounters to the rock's width plus the diameter
        wanted = 40 * (rock + cube / (mean ** 2 + sd ** 2)) / (rock + mean)
        tree = {"per_ha": 500, "dbh_m": mean, "dbh_sd_m": sd, "height_m": 30, "volume_m3": 0.4}
        trees = stand(stools=None, shoots=None, trees=[tree])
        shoots = stand(stools={"per_ha": 500, "spacing_m": 0.4}, shoots=[tree], trees=[])
        for name, wood in (("trees", trees), ("shoots", shoots)):
            found, error, _ = loss_per_contact(f, wood)
            expect_near(found, wanted, 4.5 * error + 0.06 * wanted, name)
        spread = [loss_per_contact(f, {**trees, "trees": [{**tree, "dbh_sd_m": s}]})[0] for s in (0, sd)]
        expect(spread[0] != spread[1], "a spread of diameters changes nothing")


def exceed(path, energy, *more):
    """Return the share of rocks, in percent, that exceed the last control's accepted energy."""
    changes = [w for k in ("forest[0]", "forest[1]") for w in ("-s", f"{k}.stand.energy={json.dumps(energy)}")] if energy else []
    run = result(path, *changes, *more, "-n", 100000)
    return [100 * o["controls"][-1]["wooded"]["exceed_probability"] for o in run["options"]]


BRAUNER = {"model": "brauner", "u_J_m3": 102800, "offset": "whole"}  # beech, Table 4 of Ciabocco et al. 2009


def dorren(ratio):
    return {"model": "dorren", "fracture_ratio": ratio}


def test_laws_on_the_paper_site():
    """The paper's site under other published laws: share above 50 kJ within half a percent point of other programs"""
    for energy, wanted in ((None, 47.9), ({**BRAUNER, "offset": "dorren"}, 69.6),
                           (dorren(1), 32.7), (dorren(1.5), 9.2), (dorren(1.7), 4.9)):
        expect_near(exceed("paper-site", energy)[0], wanted, 0.5, energy)
    half = [w for k in ("forest[0]", "forest[1]") for c in ("shoots", "trees")
            for w in ("-s", f"{k}.stand.{c}[0].volume_m3={0.0107 / 2 if k == 'forest[0]' else 0.0059 / 2}")]
    expect_near(exceed("paper-site", None, *half)[0], 72.6, 0.5, "half the volume")


def test_laws_turn_the_order():
    """Just after the cut, large reserves are better than selection coppice by one law and worse by the other"""
    names = ("large reserves, just cut", "selection coppice, just cut")
    only = [w for name in names for w in ("--option", name)]
    thin = f"options[{names[1]}].forest[0].stand.shoots[0].volume_m3={0.5 * math.pi / 4 * 0.04**2 * 5}"  # form factor 0.5
    for energy, wanted in ((BRAUNER, {names[0]: 39.8, names[1]: 55.6}),
                           (dorren(1.5), {names[0]: 28.6, names[1]: 20.0}),
                           ({**BRAUNER, "offset": "dorren"}, {names[0]: 62.1, names[1]: 72.8})):
        changes = [w for n in names for w in ("-s", f"options[{n}].forest[0].stand.energy={json.dumps(energy)}")]
        run = result("four-systems", *only, *changes, "-s", thin, "-n", 300000 if FULL else 100000)
        for option in run["options"]:
            found = 100 * option["controls"][-1]["wooded"]["exceed_probability"]
            expect_near(found, wanted[option["name"]], 0.5, f"{option['name']}, {energy}")


def test_grazed_stems():
    """No law lets nearly all rocks pass Vaujany's forest, where 34 in 100 did; the default lets most pass, whole fewest"""
    passed = []
    for energy in ({"offset": "whole"}, {"model": "dorren"}, {}):
        run = result("vaujany", "-s", f"options[1].forest[0].stand.energy={json.dumps(energy)}", "-n", 5000)
        passed.append(run["options"][1]["controls"][-1]["wooded"]["reach_probability"])
    expect(passed == sorted(passed) and passed[-1] < 0.6, passed)


def test_glancing_is_gone():
    """energy.glancing is refused with its remedy, in any file and by -s"""
    with Folder() as f:
        path = f.write("s.yaml", wooded_scene(forest=[belt(20, 80, energy={"glancing": True})]))
        f.write("own.yaml", "energy: {glancing: true}\n")
        foreign = f.write("t.yaml", wooded_scene(forest=[{"from_m": 20, "to_m": 80, "stand": "own.yaml"}]))
        for done in (ceduo("--batch", path), ceduo("--batch", "paper-site", "-s", "forest[0].stand.energy.glancing=true"),
                     ceduo("--batch", foreign)):
            expect_in("this key is gone: a hit takes what its law says, however slightly it touches; leave it out", done.err)
            expect(done.status in (USAGE, INPUT), done.status)


GONE = {"simulation.contact_model=poisson": "poisson is gone; leave contact_model out: every stem is hit by itself",
        "forest[0].stand.energy.model=inertia":
            "inertia is gone: the experiment at Vaujany refutes it; write brauner or dorren, or leave it out",
        "forest[0].stand.energy.green_density_kg_m3=1000":
            "this key is gone with the energy law inertia that it belonged to; leave it out"}


def test_laws_that_are_gone():
    """contact_model: poisson, energy.model: inertia and its density: refused with remedy and place, anywhere"""
    for change, said in GONE.items():
        done = ceduo("--batch", "-s", change, "paper-site")
        expect_equal((done.status, done.err.splitlines()[0].startswith(f"--set:1:{change.index('=') + 2 if 'density' not in change else 24}:")),
                     (USAGE, True), done.err)
        expect_in(said, done.err)
    said = list(GONE.values())
    with Folder() as f:
        path = f.write("s.yaml", """ceduo: scene/1
rock: {diameter_m: 0.5}
slope: {vertices_m: [[0, 80], [100, 0]], materials: [{from_m: 0, to_m: 100, material: talus}]}
forest:
  - from_m: 10
    to_m: 90
    stand:
      trees: [{per_ha: 400, dbh_m: 0.2, height_m: 15}]
      energy: {model: inertia, green_density_kg_m3: 900}
simulation: {contact_model: poisson}
uncertainty:
  - {path: "forest[0].stand.energy.model", one_of: [brauner, inertia]}
  - {path: "forest[0].stand.energy.green_density_kg_m3", lo: 800, hi: 1000}
controls: [{x_m: 95}]
""")
        done = ceduo("--check", path)
        expect_equal(done.status, INPUT, done)
        for place, words in (("9:23", said[1]), ("9:32", said[2]), ("10:29", said[0]), ("12:62", said[1]), ("13:12", said[2])):
            expect(any(f"s.yaml:{place}: " in line and words in line for line in done.err.splitlines()), f"{place}: {done.err}")
    density = "forest[0].stand.energy.green_density_kg_m3=800:1000"
    for words in (("--find", density, "--goal", "exceed=0.1", "paper-site"), ("--calibrate", density, "paper-site")):
        expect_in(said[2], ceduo(*words).err)


def test_offset_by_default():
    """The default offset is dorren; only the paper's own stands have whole"""
    def figures(*arguments):
        return [{k: v for k, v in o.items() if k != "stands"} for o in result(*arguments, "-n", 2000)["options"]]

    with Folder() as f:
        plain = f.write("s.yaml", wooded_scene(forest=[belt(10, 95, energy=None)]))
        shipped = f.write("t.yaml", wooded_scene(forest=[{"from_m": 10, "to_m": 95, "stand": "beech-simple-coppice"}]))
        for path in (plain, shipped):
            given = {w: figures("-s", f"forest[0].stand.energy.offset={w}", path) for w in ("whole", "dorren")}
            expect_equal(figures(path), given["dorren"], "the default")
            expect(given["whole"] != given["dorren"], "offset makes no difference")
    for i in (0, 1):
        expect_equal(figures("paper-site"), figures("-s", f"forest[{i}].stand.energy.offset=whole", "paper-site"), "the paper's stands")


def test_hit_below():
    """A hit with the rock's centre above hit_below_m takes nothing: a tall stem equals one that ends a radius lower"""
    with Folder() as f:
        trees = [{"per_ha": 900, "dbh_m": 0.2, "height_m": 30, "volume_m3": 0.05}]
        mapping = wooded_scene(controls=[{"x_m": 100}])

        def wooded(energy, height):
            wood = stand(stools=None, shoots=None, trees=[{**trees[0], "height_m": height}], energy=energy)
            path = f.write("s.yaml", {**mapping, "forest": [{"from_m": 10, "to_m": 95, "stand": wood}]})
            return result(path)["options"][0]["controls"][0]["wooded"]

        low, radius = {**BRAUNER, "hit_below_m": 0.775}, 0.375
        expect_equal(wooded(low, 30), wooded(BRAUNER, 0.4))
        expect_equal(wooded({**BRAUNER, "hit_below_m": radius}, 30)["contacts"]["mean"], 0, "no rock's centre is lower than its radius")
        expect_equal(wooded({**BRAUNER, "hit_below_m": 40}, 30), wooded(BRAUNER, 30))
        expect(wooded(low, 30) != wooded(BRAUNER, 30), "hits above it are many")


def test_ratio_of_species():
    """dorren: the fracture ratio is the species', or 1 with a warning"""
    with Folder() as f:
        for species, ratio in (("fagus-sylvatica", 1.5), ("quercus-cerris", 2.2), ("robinia-pseudoacacia", 2.7),
                               ("picea-abies", 0.9), ("acer", 1.1), ("castanea-sativa", None)):
            def run(**more):
                wood = stand(species=species, energy={"model": "dorren", **more})
                path = f.write("s.yaml", wooded_scene(forest=[{"from_m": 10, "to_m": 95, "stand": wood}]))
                return result(path, "-n", 5)["options"][0]["stands"][0]
            found, given = run(), run(fracture_ratio=ratio or 1)
            expect_equal(found["energy_per_contact_J"], given["energy_per_contact_J"], species)
            warned = any("fracture ratio" in w for w in found["warnings"])
            expect_equal(warned, ratio is None, f"{species}: {found['warnings']}")


def test_low_wood():
    """Stumps and logs: no assumptions; errors are reported once; 0 means none"""
    whole = {"stumps": {"per_ha": 300, "diameter_m": 0.2, "height_m": 0.3, "energy_kJ": 2},
             "logs": {"per_ha": 30, "length_m": 5, "diameter_m": 0.3, "energy_kJ": 9}}
    trees = [{"per_ha": 100, "dbh_m": 0.2, "height_m": 12, "groups": {"stems": 4, "radius_m": 2}}]
    with Folder() as f:
        def refused(**more):
            path = f.write("s.yaml", wooded_scene(forest=[belt(10, 95, **more)]))
            return ceduo("--check", path)

        found = result(f.write("s.yaml", wooded_scene(forest=[belt(10, 95, trees=trees, **whole)])), "-n", "50")
        s = found["options"][0]["stands"][0]
        expect_equal((s["stumps_per_ha"], s["logs_per_ha"], s["grouped_per_ha"]), (300, 30, 100))
        expect(any("stumps and logs" in w for w in s["warnings"]), s["warnings"])
        for low, values in whole.items():
            for key in values:
                if key == "per_ha":
                    continue
                less = {k: v for k, v in values.items() if k != key}
                expect_in(f"{low}: '{key}' is missing; it has no default", refused(**{low: less}).err)
                expect_equal(refused(**{low: {**less, "per_ha": 0}}).status, 0, f"no {low} lack nothing")
                wrong = refused(**{low: {**values, key: "x"}}).err
                expect_in("'x' is in quotes", wrong)
                expect("missing" not in wrong, wrong)
        for groups, said in (({"stems": 4}, "'radius_m' is missing; it has no default"), ({"stems": 4, "radius_m": "x"}, "'x' is in quotes"),
                             ({"stems": 201, "radius_m": 2}, "201"), ({"stems": 0, "radius_m": 2}, "0"),
                             ({"stems": 4, "radius_m": -1}, "-1")):
            expect_in(said, refused(trees=[{**trees[0], "groups": groups}]).err)
        expect_equal(refused(trees=[{**trees[0], "groups": {"stems": 1}}]).status, 0, "single trees")


def test_dorren_thin():
    """dorren below 10 cm: a warning with the stand's name, in JSON, on the page and in CSV"""
    with Folder() as f:
        path = f.write("s.yaml", wooded_scene(forest=[belt(10, 95, energy={"model": "dorren", "fracture_ratio": 1.5})]))
        run = result(path)
        expect_run(run)
        expect(any("dorren" in w and "10 cm" in w and "coppice" in w for w in run["options"][0]["stands"][0]["warnings"]),
               run["options"][0]["stands"][0]["warnings"])
        expect_in("below 10 cm", re.sub(r"\s+", " ", good(*WHOLE, path).out), "page")
        expect_in("below 10 cm", good("--batch", "-f", "csv", path).out, "CSV")


def test_height_of_stems():
    """A stem is hit only by a rock below its top"""
    with Folder() as f:
        # the first flight goes some 18 m far and 14 m high over a belt of low stems
        mapping = wooded_scene(release={"height_m": 20, "vx_m_s": 8},
                               slope={"vertices_m": [[0, 60], [100, 50], [160, 45]], "segments": [{"rn": 0.3, "rt": 0.5}]},
                               controls=[{"x_m": 12}])
        for height, hits in ((0.5, False), (3, False), (40, True)):
            low = stand(stools=None, shoots=None, trees=[{"per_ha": 3000, "dbh_m": 0.2, "height_m": height, "volume_m3": 1e-9}])
            path = f.write("s.yaml", {**mapping, "forest": [{"from_m": 2, "to_m": 11, "stand": low}]})
            stems = result(path)["options"][0]["controls"][0]
            expect_equal(stems["bare"]["reach_probability"], 1)
            expect((stems["wooded"]["contacts"]["mean"] > 1) == hits, f"stems of {height} m", stems["wooded"]["contacts"])
            expect(hits or stems["wooded"]["contacts"]["mean"] == 0, f"stems of {height} m", stems["wooded"]["contacts"])


def main():
    suite = Suite()
    suite.run(list_tests(sys.modules[__name__]))
    for case in EXTREMES:
        suite.check(f"a wood of {case[0]}: as many stems are met as stand in the way", extreme, *case)
    suite.end()


if __name__ == "__main__":
    main()
