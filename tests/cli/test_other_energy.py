#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The same rocks under the other energy law: in JSON, on the page, and for options whose order changes."""
import json
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import Folder, belt, expect, expect_equal, expect_in, good, result, run_all, stand, wooded_scene
from pages import WHOLE, digits, share_per_1000
from runs import FOUR, PAPER, through

TWO_CUTS = ("--option", "selection coppice, just cut", "--option", "large reserves, just cut")


def law(name, belts=2):
    return [word for i in range(belts) for word in ("-s", f"forest[{i}].stand.energy.model={name}")]


def expect_other(run, turned, model):
    """Expect the figures of the other law to equal a run under that law."""
    for option, under in zip(run["options"], turned["options"]):
        for control, at in zip(option["controls"], under["controls"]):
            wooded = at["wooded"]
            shares = {f"{what}_{end}": wooded[f"{what}_{end}"] for what in ("reach", "exceed") for end in ("probability", "lo", "hi")}
            both = {c["verdict"]["answer"] for c in (control, at)}
            answer = "depends" if both == {"yes", "no"} else at["verdict"]["answer"]
            expect_equal(control["other_energy"], {"verdict": {"answer": answer}, "model": model, "rocks": turned["rocks"], **shares,
                                                   "energy_kJ": {k: wooded["energy_kJ"][k] for k in ("mean", "se")}})


def test_both_ways():
    """JSON: the other law's figures equal a run of the same rocks under that law to the last bit, both ways"""
    brauner, dorren = (result(PAPER, "-n", 3000, *law(name)) for name in ("brauner", "dorren"))
    expect_other(brauner, dorren, "dorren")
    expect_other(dorren, brauner, "brauner")
    mixed = result(PAPER, "-n", 3000, "-s", "forest[0].stand.energy.model=dorren")
    expect_other(mixed, dorren, "dorren")


def test_few_are_enough():
    """Beyond 10240 rocks the first ones represent the other law, with their own interval"""
    most, more = 10240, ("-n", 25000)
    run, turned = result(PAPER, *more), result(PAPER, "-n", most, *law("dorren"))
    for part in (run, result(PAPER, *more, "-j", 2)):
        expect_equal(part["rocks"], 25000)
        turned["rocks"] = most
        expect_other({"options": part["options"]}, turned, "dorren")
    page = " ".join(good(*WHOLE, *more, PAPER).out.split())
    expect_in("Under this law the first 10240 rocks alone were simulated.", page)
    expect("rocks alone were simulated" not in good(*WHOLE, "-n", most, PAPER).out, "all of them")

def test_none():
    """JSON: null by the index, without stems and in years; without an accepted energy there is no exceeding share"""
    expect_equal(result(PAPER, *through("index"))["options"][0]["controls"][0]["other_energy"], None)
    with Folder() as f:
        path = f.write("s.yaml", wooded_scene(forest=None, options=[
            {"name": "thick", "forest": [belt(10, 95, shoots=[{"per_ha": 5000, "dbh_m": 0.3, "height_m": 20, "volume_m3": 9}])]},
            {"name": "none"}]))
        run = result(path, "-n", 200)
        thick, none = (o["controls"][0]["other_energy"] for o in run["options"])
        expect_equal(none, None)
        expect_equal((thick["model"], thick["exceed_probability"]), ("dorren", None))
        page = good(*WHOLE, "-n", 200, path).out
        expect_in("With the energy law dorren", page)
        expect_equal(page.count("With the energy law"), 2, "an option without stems has no other law")
        gap = {"from_m": 5, "to_m": 10, "stand": stand(stools=None, shoots=None, trees=None, system="bare")}
        path = f.write("g.yaml", wooded_scene(forest=[gap, belt(10, 95, energy={"model": "dorren"})]))
        other = result(path, "-n", 20)["options"][0]["controls"][0]["other_energy"]
        expect_equal(other["model"], "brauner", "a gap has no law")
    years = result(FOUR, "-n", 50, "--years", "0:1", "--option", "large reserves")["options"][0]
    expect(years["controls"][0]["other_energy"] is not None, "of today")
    expect_equal([y["controls"][0]["other_energy"] for y in years["years"]], [None, None])


def test_page():
    """Page: a sentence with the shares and the mean under the other law, at each control"""
    for more, words in (((), r"With the energy law dorren: {reach} of 1000 arrive, {exceed} with more than the accepted energy; "
                              r"their mean is {mean} ±{half} kJ\."),
                        (("-s", "controls=[{x_m: 135}]"),
                         r"With the energy law dorren: {reach} of 1000 arrive; their mean is {mean} ±{half} kJ\.")):
        other = result(PAPER, "-n", 800, *more)["options"][0]["controls"][0]["other_energy"]
        page = " ".join(good(*WHOLE, "-n", 800, PAPER, *more).out.split())
        exceed = re.escape(share_per_1000("exceed", other)) if other["exceed_probability"] is not None else ""
        wanted = words.format(reach=re.escape(share_per_1000("reach", other)), exceed=exceed, mean=f"{other['energy_kJ']['mean']:.1f}",
                              half=digits(1.963 * other["energy_kJ"]["se"], 2))  # 1.963: Student's t of some 690 rocks
        expect(re.search(wanted, page), wanted, page)
    none = good(*WHOLE, "-n", 5, PAPER, "-s", "forest[0].stand.trees[0].dbh_m=2", "-s", "forest[0].stand.trees[0].volume_m3=9").out
    expect_in("With the energy law dorren no rock arrives.", " ".join(none.split()))


def test_order():
    """The page names two options if the two laws rank them in opposite order, and only then"""
    run = result(FOUR, "-n", 10000, *TWO_CUTS)
    shares = [[round(1000 * c[k]["exceed_probability"]) for k in ("wooded", "other_energy")]
              for c in (o["controls"][0] for o in run["options"])]
    selection, reserves = shares
    expect(selection[0] > reserves[0] and selection[1] < reserves[1], "the order turns round", shares)
    page = " ".join(good(*WHOLE, "-n", 10000, FOUR, *TWO_CUTS).out.split())
    expect_in("The order of 2 options depends on the energy law. Of 1000 by the law of the scene, and by dorren: "
              f"'selection coppice, just cut' {selection[0]} and {selection[1]}; 'large reserves, just cut' {reserves[0]} and {reserves[1]}.", page)
    alike = good(*WHOLE, "-n", 2000, FOUR, "--option", "simple coppice, 25 years", "--option", "simple coppice, just cut").out
    expect("depends on the energy law" not in " ".join(alike.split()), alike)


def test_tolerance():
    """-e refines only the printed means of the scene's own law"""
    with Folder() as f:
        rare = stand(stools=None, shoots=None, trees=[{"per_ha": 400, "dbh_m": 0.12, "height_m": 9, "volume_m3": 0.0001}],
                     species="quercus-cerris")
        path = f.write("s.yaml", wooded_scene(forest=[{"from_m": 10, "to_m": 95, "stand": rare}]))
        run = result(path, "-e", 0.05, "-n", 100000)
        wooded = run["options"][0]["controls"][0]["wooded"]["energy_kJ"]
        expect(1.96 * wooded["se"] <= 0.05 * wooded["mean"] and run["rocks"] < 10000, run["rocks"])


run_all(__name__)
