#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: slow threads
"""Options year by year (--years), and the value of a parameter that meets a goal (--find)."""
import copy
import csv
import io
import json
import math
import random
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import (CEDUO, DONE, FULL, INPUT, PATIENCE, PROFILES, USAGE, Failure, Folder, ceduo, environment, expect, expect_equal,
                     expect_in, expect_near, good, option_today, result, results, run_all)
from pages import WHOLE, digits

STANDS = PROFILES / "stands"
SYSTEMS = [("simple", "simple-coppice.yaml"), ("standards", "coppice-with-standards.yaml"),
           ("selection", "selection-coppice.yaml"), ("reserves", "large-reserves.yaml")]
SHOOTS = {"dbh_most_m": 0.16, "dbh_rate_1_y": 0.022, "height_most_m": 14, "height_rate_1_y": 0.035}
TREES = {"dbh_most_m": 0.45, "dbh_rate_1_y": 0.014, "height_most_m": 20, "height_rate_1_y": 0.03}
WIDTH = 80  # columns of the page


def coppice(rotation=25, stay=(30, 30), **changes):
    """A growing simple coppice."""
    stand = {"name": "coppice", "species": "ostrya-carpinifolia", "stools": {"per_ha": 2500, "spacing_m": 0.35},
             "shoots": [{"per_ha": 7500, "dbh_m": 0.05, "height_m": 6}],
             "trees": [{"per_ha": 60, "dbh_m": 0.2, "height_m": 12}],
             "growth": {"shoots": SHOOTS, "trees": TREES, "shoots_young": 16, "shoots_old": 3, "sdi_most": 1000},
             "cutting": {"rotation_years": rotation, "stay_per_ha": list(stay)}}
    stand.update(changes)
    return {key: value for key, value in stand.items() if value is not None}


def belt(begin, end, stand, **changes):
    return {"from_m": begin, "to_m": end, "stand": stand, **changes}


def site(*belts, rocks=200, options=None, controls=None, **changes):
    """Return the paper's slope and rock with other forests."""
    mapping = {"ceduo": "scene/1", "title": "years",
               "rock": {"shape": "cylinder", "diameter_m": 0.56, "height_m": 0.80, "density_kg_m3": 2600},
               "release": {"vx_m_s": 0.3, "vz_m_s": -0.3}, "slope": str(PROFILES / "slopes" / "paper.yaml"),
               "controls": controls or [{"x_m": 135, "name": "road", "accepted_kJ": 50}],
               "simulation": {"rocks": rocks}}
    mapping.update({"options": [{"name": n, "forest": f} for n, f in options]} if options else {"forest": list(belts)})
    for key, value in changes.items():
        mapping[key] = {**mapping["simulation"], **value} if key == "simulation" else value
    return mapping


def four_systems(**changes):
    options = [(name, [belt(0, 135, str(STANDS / file))]) for name, file in SYSTEMS]
    return site(options=options, **changes)


def run(mapping, years, *arguments, **options):
    with Folder() as f:
        return result("--years", years, *arguments, f.write("s.yaml", mapping), **options)


def run_years(mapping, years, *arguments, **options):
    """Return the years of a scene's first option."""
    return run(mapping, years, *arguments, **options)["options"][0]["years"]


def json_shape(value):
    """Return the shape of JSON: its keys, at any depth, the first item of each list."""
    if isinstance(value, dict):
        return {key: json_shape(item) for key, item in value.items()}
    if isinstance(value, list):
        return [json_shape(item) for item in value[:1] if isinstance(item, dict)]
    return None


def without_year(year):
    return {key: value for key, value in year.items() if key != "year"}


def drop_alternatives(value):
    """Return it without the figures of the other energy law, which years lack, and without the answer, which is over the years."""
    if isinstance(value, list):
        return [drop_alternatives(v) for v in value]
    return {k: v for k, v in value.items() if k not in ("other_energy", "verdict")}


# ---- JSON of the years ----


def test_shape():
    """--years: each option lists its years, each with stands, summary and controls as in the run, and their totals"""
    found = run(four_systems(), "0:10:5")
    expect_equal([o["name"] for o in found["options"]], [name for name, _ in SYSTEMS])
    for option in found["options"]:
        expect_equal([y["year"] for y in option["years"]], [0, 5, 10], "years")
        for year in option["years"]:
            expect_equal(list(year), ["year", "cut", "stands", "summary", "controls"], "keys of a year")
            for key in ("stands", "summary", "controls"):
                expect_equal(json_shape(drop_alternatives(year[key])), json_shape(drop_alternatives(option[key])), f"keys of {key}")
            expect(isinstance(year["cut"], bool), year["cut"])
            expect_equal(year["controls"][0]["bare"], option["controls"][0]["bare"], "bare")
        expect(set(option["rotation"]) >= {"years", "felled_m", "unprotected_contact", "unprotected_free_run",
                                           "unprotected_energy", "reach_probability", "exceed_probability",
                                           "worst_year", "reach_per_year"}, option["rotation"])


def test_stretches():
    """--years: A:B and A:B:STEP, the last year only if a step meets it, and a single year"""
    for given, wanted in (("3:6", [3, 4, 5, 6]), ("0:7:3", [0, 3, 6]), ("4:4", [4]), ("4:4:9", [4]), ("0:1e1:5", [0, 5, 10])):
        expect_equal([y["year"] for y in run_years(site(belt(0, 135, coppice()), rocks=1), given)], wanted, given)


def test_year_0():
    """Year 0 equals the plain run to the last digit unless it has a cut, and does not change the run"""
    mapping = four_systems(rocks=500)
    mapping["options"][3]["forest"][0]["cut_year"] = -25  # its rotation has a cut in year 0
    mapping["options"].append({"name": "bare", "forest": []})
    with Folder() as f:
        path = f.write("s.yaml", mapping)
        plain, found = result(path), result("--years", "0:1", path)
    for before, after in zip(plain["options"], found["options"]):
        expect_equal(option_today(after), option_today(before), "the run beside the years")
        year, same = after["years"][0], before["name"] != "reserves"
        expect_equal(year["cut"], not same, f"{before['name']}: cut in year 0")
        for key in ("stands", "summary", "controls"):
            expect((drop_alternatives(year[key]) == drop_alternatives(before[key])) == same, f"{before['name']}: {key} of year 0 and of the run",
                   year[key], before[key])
    expect_equal(found["differences"], plain["differences"], "differences")


def test_grows():
    """Before the cut shoots and trees grow along their curves, and the ADC and the energies follow"""
    years = run_years(site(belt(0, 135, coppice(growth={**coppice()["growth"], "sdi_most": 0}), cut_year=40)), "0:10:5")
    for year in years[1:]:
        age, old = year["year"] - math.log(1 - 5 / 16) / 0.022, year["year"] - math.log(1 - 20 / 45) / 0.014
        d, tree = 0.16 * (1 - math.exp(-0.022 * age)), 0.45 * (1 - math.exp(-0.014 * old))
        shoots = 7500 * (3 + 13 * math.exp(-age / 5)) / (3 + 13 * math.exp(-(age - year["year"]) / 5))
        stand = year["stands"][0]
        expect_near(stand["stems_per_ha"], shoots + 60, 1e-9 * shoots, "stems")
        expect_near(stand["basal_area_m2_ha"], math.pi / 4 * (shoots * d * d + 60 * tree * tree), 1e-9, "basal area")


def test_threads():
    """--years: equal bytes for one thread and two, in every format"""
    with Folder() as f:
        path = f.write("s.yaml", four_systems(rocks=1100))
        for form in ("json", "csv", "table"):
            one, two = (re.sub(r'"seconds": [^}]*', "", good("--batch", "-s", "uncertainty=none", "-f", form, "--years", "0:2", "-j", j, path).out)
                        for j in (1, 2))
            expect(one == two, f"{form}: -j 1 and -j 2 differ")


def test_implied():
    """--years alone prints a page: --batch is implied"""
    with Folder() as f:
        path = f.write("s.yaml", site(belt(0, 135, coppice()), rocks=50))
        expect_equal(*(good(*words, "-s", "uncertainty=none", "--years", "0:2", path).out for words in ((), ("--batch",))))


# ---- work ----


def expect_work(found, runs):
    """Expect this number of runs, including the bare one; others are reused. The forest of the file runs under the other energy
    law as well."""
    other = runs > 1
    work, options = found["work"], found["options"]
    asked = sum(2 + len(o["years"]) for o in options)
    expect_equal((work["runs"], work["runs_reused"], work["rocks_flown"]), (runs + other, asked - runs, (runs + other) * found["rocks"]),
                 "runs, reused and rocks flown")


def test_flown_once():
    """Years with equal forests are simulated once: 2 runs without growth, at most 26 forests in 52 years of rotation 25"""
    still = coppice(growth=None, cutting=None)
    expect_work(run(site(belt(0, 135, still)), "0:10"), 2)
    expect_work(run(site(belt(0, 135, coppice(), cut_year=1), rocks=50), "0:51"), 1 + 26)
    expect_work(run(site(belt(0, 135, coppice(), cut_year=0), rocks=50), "0:51"), 1 + 1 + 25)  # the file's, and 25
    expect_work(run(site(belt(0, 135, coppice(stay=[]), cut_year=1), rocks=50), "0:51"), 26)  # bare just after the cut
    twins = [(name, [belt(0, 135, coppice(), cut_year=1)]) for name in ("one", "another")]
    expect_work(run(site(options=twins, rocks=50), "0:30"), 1 + 26)


def test_no_forest():
    """Without forest all years equal the bare run, and nothing is felled"""
    found = run(site(), "0:5")
    expect_work(found, 1)
    for year in found["options"][0]["years"]:
        expect_equal((year["cut"], year["stands"]), (False, []))
        wooded = {k: v for k, v in year["controls"][0]["wooded"].items() if k != "contacts"}
        expect_equal(wooded, year["controls"][0]["bare"], "wooded")
    expect_equal((found["options"][0]["rotation"]["felled_m"], found["options"][0]["rotation"]["unprotected_contact"]), (0, 6))


# ---- cuts ----


def cut_years(years):
    return [y["year"] for y in years if y["cut"]]


def test_cuts():
    """Cuts fall in cut_year and each rotation after it, by default when the shoots reach rotation age"""
    for given, wanted in ((7, [7, 17, 27]), (-5, [5, 15, 25]), (6.2, [7, 17, 27]), (0, [0, 10, 20, 30]), (40, [])):
        found = run_years(site(belt(0, 135, coppice(10), cut_year=given), rocks=1), "0:30")
        expect_equal(cut_years(found), wanted, f"cut_year {given}")
    age = -math.log(1 - 5 / 16) / 0.022  # for shoots of 5 cm
    expect_equal(cut_years(run_years(site(belt(0, 135, coppice()), rocks=1), "0:60")), [8 + 25 * i for i in range(3)],
                 f"{25 - age:.1f} years before they are 25")
    young = coppice(shoots=[{"per_ha": 7500, "dbh_m": 0.05, "height_m": 6, "age_y": 22}])
    expect_equal(cut_years(run_years(site(belt(0, 135, young), rocks=1), "0:30")), [3, 28], "22 years old")
    expect_equal(cut_years(run_years(site(belt(0, 135, coppice(cutting=None)), rocks=1), "0:30")), [], "no rotation")
    felled = {"name": "felled", "trees": [{"per_ha": 300, "dbh_m": 0.3, "height_m": 20, "age_y": 80}],
              "cutting": {"rotation_years": 90}}  # nothing grows, but the age is known
    expect_equal(cut_years(run_years(site(belt(0, 135, felled), rocks=1), "0:30")), [10], "trees without growth")
    del felled["trees"][0]["age_y"]
    expect_equal(cut_years(run_years(site(belt(0, 135, felled, cut_year=4), rocks=1), "0:30")), [4], "their cut year")
    gap = {"name": "gap", "stools": {"per_ha": 0, "spacing_m": 0.3}}
    expect_equal(cut_years(run_years(site(belt(0, 135, gap, cut_year=4), rocks=1), "0:30")), [], "nothing to cut")


CUT_NEEDS = "the cut needs '{}' of the stand; add it, or remove '{}'"


def check(stand, **changes):
    """Return status and messages of --check of a scene with one belt, in one line."""
    with Folder() as f:
        r = ceduo("--check", f.write("s.yaml", site(belt(25, 120, stand, **changes))))
    return r.status, " ".join(r.err.split())


def expect_refused(stand, *messages, **changes):
    status, err = check(stand, **changes)
    expect_equal((status, err.count("s.yaml:")), (INPUT, len(messages)), err)
    for message in messages:
        expect_in(message, err)


def test_cuts_that_lack_data():
    """A cut that cannot be computed is refused: without cutting, growth of shoots or trees, numbers of shoots or an age"""
    whole = coppice()["growth"]

    def grown(*without, **changes):
        return coppice(growth={k: v for k, v in whole.items() if k not in without}, **changes)
    expect_equal(check(coppice(), cut_year=2), (DONE, ""), "complete")
    expect_refused(coppice(cutting=None), "forest[0].cut_year: " + CUT_NEEDS.format("cutting", "cut_year"), cut_year=2)
    expect_refused(coppice(growth=None), "forest[0].cut_year: " + CUT_NEEDS.format("growth", "cut_year"), cut_year=2)
    for year in ({}, {"cut_year": 2}):
        expect_refused(grown("trees"), "stand.cutting: " + CUT_NEEDS.format("growth.trees", "cutting"), **year)
        expect_refused(grown("shoots"), "stand.cutting: " + CUT_NEEDS.format("growth.shoots", "cutting"), **year)
        expect_refused(grown("shoots_old"), "stand.growth: 'shoots_old' is missing; it has no default", **year)
        expect_refused(grown("shoots_young"), "stand.growth: 'shoots_young' is missing; it has no default", **year)
        expect_refused(grown("shoots_young", "shoots_old"), "'shoots_young' is missing", "'shoots_old' is missing", **year)
        expect_equal(check(grown("trees", stay=[0]), **year), (DONE, ""), "no trees stay")
        expect_equal(check(grown("trees", stay=[]), **year), (DONE, ""), "no list of trees")
        expect_equal(check(grown("trees", cutting=None)), (DONE, ""), "never cut")
    high = {"trees": [{"per_ha": 300, "dbh_m": 0.3, "height_m": 20}], "cutting": {"rotation_years": 90}, "growth": {"shoots": SHOOTS}}
    expect_refused(high, "the year of the first cut is unknown; give 'cut_year', 'age_y' of the trees, or 'growth.trees'")
    expect_equal(check(high, cut_year=2), (DONE, ""), "a known year; shoots without stools need no numbers")
    expect_equal(check({**high, "growth": {"trees": TREES}}), (DONE, ""), "a known age")
    expect_refused({**high, "growth": {"shoots_old": 3}}, "'shoots_young' is missing", cut_year=2)


def test_errors_of_cuts_once():
    """An error of growth, cutting, stems or cut year is reported alone, not what follows from it"""
    whole = coppice()
    bad = {**SHOOTS, "dbh_most_m": "x"}
    expect_refused(coppice(growth={**whole["growth"], "shoots": bad}), "growth.shoots.dbh_most_m: 'x' is in quotes", cut_year=2)
    expect_refused(coppice(growth={**whole["growth"], "shoots_old": "x"}), "growth.shoots_old: 'x' is in quotes", cut_year=2)
    expect_refused(coppice(growth={**whole["growth"], "shoots_young": "x"}), "growth.shoots_young: 'x' is in quotes", cut_year=2)
    expect_refused(coppice(cutting={"rotation_years": "x"}), "cutting.rotation_years: 'x' is in quotes", cut_year=2)
    expect_refused(coppice(cutting=None), "cut_year: 'x' is in quotes", cut_year="x")
    expect_refused("nowhere", "cannot find 'nowhere'", cut_year=2)


def test_cutting_without_growth():
    """A stand with cutting and no growth at all is computed for today with a warning: its rules and trees count"""
    still = coppice(growth=None)
    status, err = check(still)
    expect_equal((status, err.count("s.yaml:")), (DONE, 1), err)
    expect_in("forest[0].stand.cutting: the stand is never cut, because it has no 'growth'; add it for future years", err)
    with Folder() as f:
        page = ceduo(*WHOLE, "-n", 20, f.write("s.yaml", site(belt(0, 135, still))))
    expect_in("'current' does not change: stand 'coppice' has no growth data for its stems.", re.sub(r"\s+", " ", page.out))
    expect_in("the stand is never cut", page.err)


def test_a_rotation_later():
    """From the first cut on everything repeats after a rotation, to the last digit"""
    found = run(four_systems(rocks=100), "0:41")
    for option in found["options"]:
        rotation = 13 if option["name"] == "selection" else 25
        first = cut_years(option["years"])[0]
        for year in option["years"][first:-rotation]:
            later = option["years"][year["year"] + rotation]
            expect(without_year(year) == without_year(later),
                   f"{option['name']}: year {year['year']} and year {later['year']} differ")
        expect(without_year(option["years"][0]) != without_year(option["years"][rotation]), "as filed and on the curves")


def test_felled():
    """Staggered or at once, whole rotations fell equal metres"""
    thirds = [belt(45 * i, 45 * i + 45, coppice(12), cut_year=4 * i) for i in range(3)]
    late = [belt(45 * i, 45 * i + 45, coppice(12), cut_year=11 - 5 * i) for i in range(3)]
    options = [("at once", [belt(0, 135, coppice(12), cut_year=5)]), ("staggered", thirds), ("other years", late),
               ("rhythm", [belt(0, 135, coppice(12), cut_year=-30)]), ("never", [belt(0, 135, coppice(cutting=None))])]
    for years, rotations in (("0:11", 1), ("0:35", 3)):
        found = run(site(options=options, rocks=1), years)["options"]
        expect_equal([o["rotation"]["felled_m"] for o in found], [135 * rotations] * 4 + [0], years)
        for option in found:
            by_hand = sum(b["to_m"] - b["from_m"] for y in option["years"] for b in y["stands"]
                          if b["stools_per_ha"] == 0)  # no stools just after the cut
            expect_equal(option["rotation"]["felled_m"], by_hand, f"{option['name']}: belts without stools")
    expect_equal(cut_years(found[1]["years"]), list(range(0, 36, 4)), "staggered")


def test_selection():
    """A selection coppice of three cohorts always has stems, and its cuts keep the stools"""
    selection = coppice(13, [0, 0, 0, 40], cutting={"rotation_years": 13, "cohorts": 3, "stay_per_ha": [0, 0, 0, 40]},
                        stools={"per_ha": 1200, "spacing_m": 0.3})
    for mapping in (site(belt(0, 135, str(STANDS / "selection-coppice.yaml")), rocks=20),
                    site(belt(0, 135, selection, cut_year=0), rocks=20)):
        found = run(mapping, "0:60")["options"][0]
        expect(len(cut_years(found["years"])) >= 4, "hardly any cut", cut_years(found["years"]))
        for year in found["years"]:
            stand = year["stands"][0]
            expect(stand["stools_per_ha"] == 1200 and stand["stems_per_ha"] - stand["trees_per_ha"] >= 1200,
                   f"year {year['year']}", stand)
            expect_equal((stand["trees_per_ha"], year["controls"][0]["lights"]["contact"]), (40, "pass"))
        expect_equal(found["rotation"]["unprotected_contact"], 0)


# ---- all years together ----


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def expect_sum(option, at, rate=None):
    """Expect `rotation` to follow from the years, at one control."""
    rotation, years = option["rotation"], option["years"]
    arrivals = [y["controls"][at]["wooded"] for y in years]
    n = option["released"]
    expect_equal(rotation["years"], len(years))
    for light in ("contact", "free_run", "energy"):
        fails = sum(y["controls"][at]["lights"][light] == "fail" for y in years)
        unknown = light == "energy" and arrivals[0]["exceed_probability"] is None
        expect_equal(rotation[f"unprotected_{light}"], None if unknown else fails, light)
    compared = "reach_probability" if arrivals[0]["exceed_probability"] is None else "exceed_probability"
    for key in ("reach_probability", "exceed_probability"):
        shares = [a[key] for a in arrivals]
        if None in shares:
            expect_equal(rotation[key], {"mean": None, "se": None}, key)
            continue
        expect_near(rotation[key]["mean"], mean(shares), 1e-14, key)
        bound = mean(math.sqrt(p * (1 - p) / n) for p in shares)  # as if all years were one
        if key == compared:  # from each rock's own mean over the years
            single = mean(p * (1 - p) / n for p in shares) / len(shares)  # as if each year had independent rocks
            expect(0.9 * math.sqrt(single) < rotation[key]["se"] <= bound * (1 + 1 / n), key, rotation[key], single, bound)
        else:
            expect_near(rotation[key]["se"], bound, 1e-14, f"{key}: se")
    energies = [a["energy_per_released_kJ"] for a in arrivals]
    for key in ("mean", "se"):
        expect_near(rotation["energy_per_released_kJ"][key], mean(e[key] for e in energies), 1e-12, f"energy: {key}")
    key = "reach_probability" if arrivals[0]["exceed_probability"] is None else "exceed_probability"
    worst = max(range(len(years)), key=lambda i: arrivals[i][key])  # the first one
    expect_equal(rotation["worst_year"], years[worst]["year"], "worst year")
    for name, key in (("reach_per_year", "reach_probability"), ("exceed_per_year", "exceed_probability")):
        share = rotation[key]["mean"]
        if rate is None or share is None:
            expect_equal(rotation[name], None, name)
        else:
            expect_near(rotation[name], share * rate, 1e-12 * rate, name)


def test_sum():
    """The mean, the worst year and the unprotected years follow from the years, at the farthest control"""
    controls = [{"x_m": 60, "accepted_kJ": 5}, {"x_m": 135, "accepted_kJ": 50}, {"x_m": 90}]
    for last in (1, 2):
        controls[2]["x_m"] = 90 if last == 1 else 140
        found = run(four_systems(controls=controls, rocks=300), "0:27:3")
        for option in found["options"]:
            option["released"] = 300
            expect_sum(option, last)


def test_thick_stems():
    """Failing years by stems from 8 cm on equal those of a scene whose contact stems begin at 8 cm"""
    with Folder() as f:
        many = [{"per_ha": 500, "dbh_m": 0.2, "height_m": 12}]  # 20 m apart along the slope: contact passes, free run does not
        path = f.write("s.yaml", site(belt(0, 135, coppice(30, stay=[500], trees=many), cut_year=2), rocks=50))
        every, thick = (result("--years", "0:29", "-s", f"simulation.contact_dbh_m={dbh}", path)["options"][0]["rotation"] for dbh in (0, 0.08))
    keys = ("unprotected_contact", "unprotected_free_run")
    expect_equal([every[f"{k}_8cm"] for k in keys], [thick[k] for k in keys])
    expect(every["unprotected_free_run_8cm"] != every["unprotected_contact_8cm"], "years that fail by one of the two alone", every)


def test_rocks_per_year():
    """rocks_per_year: expected passes per year are the mean arriving share times the rocks"""
    for rate in (0, 0.25, 3, 1000):
        found = run(site(belt(0, 135, coppice(8)), rocks_per_year=rate, rocks=100), "0:9")["options"][0]
        found["released"] = 100
        expect_sum(found, 0, rate)
    for bad in (-1, "x", 1e7):
        with Folder() as f:
            done = ceduo("--batch", f.write("s.yaml", site(belt(0, 135, coppice()), rocks_per_year=bad)))
            expect(done.status == 3 and "rocks_per_year" in done.err and done.out == "", done)


def test_index():
    """With the contact model index no rock meets a stem: the years have only the index"""
    mapping = four_systems(rocks_per_year=2, simulation={"contact_model": "index"})
    found = run(mapping, "0:26")
    expect_equal((found["work"]["runs"], found["work"]["rocks_flown"]), (1, 200))
    for option in found["options"]:
        worst = max(option["years"], key=lambda y: max(s["adc"]["adc_m"] or math.inf for s in y["stands"]))
        expect_equal(option["rotation"]["worst_year"], worst["year"], f"{option['name']}: largest ADC")
        for key in ("reach_probability", "exceed_probability", "energy_per_released_kJ"):
            expect_equal(option["rotation"][key], {"mean": None, "se": None}, key)
        expect_equal((option["rotation"]["reach_per_year"], option["rotation"]["unprotected_energy"]), (None, None))
        for year in option["years"]:
            control = year["controls"][0]
            expect_equal((control["wooded"], control["lights"]["energy"]), (None, "unknown"))
            expect_near(control["index"]["dissipated_kJ"], sum(s["dissipated_kJ"] for s in year["stands"]), 1e-9, "Eq. 4")
    stems = run(four_systems(), "0:26")
    for a, b in zip(found["options"], stems["options"]):
        expect_equal([(y["stands"], y["summary"], y["controls"][0]["index"]) for y in a["years"]],
                     [(y["stands"], y["summary"], y["controls"][0]["index"]) for y in b["years"]], "index figures")
    with Folder() as f:
        text = good(*WHOLE, "--years", "0:26", f.write("s.yaml", mapping)).out
    expect_in("the ADC is largest in year 1", " ".join(text.split()))


# ---- CSV ----


def format_cell(value):
    return "" if value is None else str(value).lower() if isinstance(value, bool) else str(value)


def same_cell(cell, value):
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        return cell != "" and float(cell) == value
    return cell == format_cell(value)


def test_csv():
    """CSV: a row per option, year and control, year and cut after option, all values as in JSON"""
    controls = [{"x_m": 135, "name": "road, new", "accepted_kJ": 50}, {"x_m": 60}]
    for simulation in ({}, {"contact_model": "index"}):
        with Folder() as f:
            path = f.write("s.yaml", four_systems(controls=controls, simulation=simulation, rocks=100))
            plain = next(csv.reader(io.StringIO(good("--batch", "-f", "csv", path).out)))
            text = good("--batch", "-f", "csv", "--years", "0:2", path).out
            found = result("--years", "0:2", path)
        rows = list(csv.DictReader(io.StringIO(text)))
        at = plain.index("option") + 1
        expect_equal(text.splitlines()[0].split(","), plain[:at] + ["year", "cut"] + plain[at:], "columns")
        wanted = [(o, y, c) for o in found["options"] for y in o["years"] for c in y["controls"]]
        expect_equal(len(rows), len(wanted), "rows")
        for row, (option, year, control) in zip(rows, wanted):
            expect_equal((row["option"], row["year"], row["cut"]),
                         (option["name"], str(year["year"]), format_cell(year["cut"])))
            compared = 0
            for name, cell in row.items():
                root, *rest = name.split(".")
                value = {**control, "summary": year["summary"]}.get(root)
                if root not in ("x_m", "name", "accepted_kJ", "bare", "index", "wooded", "lights", "summary"):
                    continue
                for key in rest:
                    value = value.get(key) if value is not None else None
                compared += 1
                expect(same_cell(cell, value), f"{option['name']}, year {year['year']}, {name}: {cell!r}, JSON {value!r}")
            expect(compared > 80, f"only {compared} cells compared")
            if not year["cut"] and year["year"] == 0:
                ends = {f"ends.{k}": v for k, v in option["ends"].items()}
                ends.update({f"stop_x_m.{k}": v for k, v in (option["stop_x_m"] or {}).items()})
                expect(all(same_cell(row[k], v) for k, v in ends.items()), "ends in year 0", row, ends)


def test_csv_warnings():
    """CSV: a row has the warnings of its own year"""
    mapping = site(belt(0, 135, coppice(8, [10]), cut_year=2), minimum={"reserves_per_ha": 40}, rocks=50)
    with Folder() as f:
        path = f.write("s.yaml", mapping)
        rows = csv.DictReader(io.StringIO(good("--batch", "-f", "csv", "--years", "0:4", path).out))
        years = result("--years", "0:4", path)["options"][0]["years"]
    for row, year in zip(rows, years):
        for sentence in year["stands"][0]["warnings"]:
            expect_in(sentence, row["warnings"], f"year {year['year']}")
        expect_equal("must stay" in row["warnings"], year["year"] >= 2, f"year {year['year']}: {row['warnings']}")


# ---- the page ----


def year_lines(text):
    return re.findall(r"^ +(\d+) (cut|   ) .*[✔✘?+x] .*%.*$", text, re.M)


def test_page():
    """The page: a line per year, at most 80 columns wide, in UTF-8 and in ASCII"""
    scenes = [four_systems(rocks=100, rocks_per_year=0.5), four_systems(rocks=100, controls=[{"x_m": 135}]),
              four_systems(rocks=100, simulation={"contact_model": "index"})]
    for mapping in scenes:
        with Folder() as f:
            path = f.write("s.yaml", mapping)
            for locale in ("C.UTF-8", "C"):
                for years in ("0:27", "99990:99999:3"):
                    text = good(*WHOLE, "--years", years, path, env={"LC_ALL": locale}).out
                    wide = [line for line in text.splitlines() if len(line) > WIDTH]
                    expect(not wide, f"{locale}: wider than {WIDTH} columns", *wide)
                    first, last, *step = map(int, years.split(":"))
                    wanted = [str(y) for y in range(first, last + 1, *step)]
                    expect_equal([y for y, _ in year_lines(text)], wanted * 4, f"{locale}: lines of years")
                    expect(locale != "C" or text.isascii(), "not ASCII")


def test_page_figures():
    """The page's years equal JSON: cut, ADC, lights, per 1000"""
    with Folder() as f:
        path = f.write("s.yaml", site(belt(0, 135, coppice(12), cut_year=3), rocks=1000))
        text = good(*WHOLE, "--years", "0:16", path).out
        option = result("--years", "0:16", path)["options"][0]
    for line, year in zip([x for x in text.splitlines() if re.match(r" +\d+ (cut|   ) ", x)], option["years"]):
        control = year["controls"][0]
        words = {"pass": "✔", "fail": "✘", "unknown": "?"}
        expect_equal("cut" in line, year["cut"], line)
        figures = line.replace("cut", "").split()
        expect_equal((figures[0], figures[2], figures[5], figures[8]),
                     (str(year["year"]), *(words[control["lights"][k]] for k in ("energy", "contact", "free_run"))), line)
        expect_equal(figures[3], digits(control["wooded"]["energy_kJ"]["mean"], 3), f"mean of those that arrive: {line}")
        adc = max(s["adc"]["adc_m"] for s in year["stands"])
        expect(abs(float(figures[4]) - adc) <= 0.006 * adc, f"ADC {adc}", line)
        expect_in(f" {1000 * control['wooded']['exceed_probability']:.0f}±", line, "of 1000")
    flat = " ".join(text.split())
    rotation = option["rotation"]
    expect_in(f"Years that fail: energy {rotation['unprotected_energy']}, contact {rotation['unprotected_contact']}, "
              f"free run {rotation['unprotected_free_run']} of 17.", flat)
    share = rotation["exceed_probability"]  # with half its 95 % interval
    expect_in(f"Years 0 to 16: mean {1000 * share['mean']:.0f} ±{math.ceil(1959.963984540054 * share['se'])} of 1000, worst ", flat)
    expect_in(f"(year {rotation['worst_year']}).", flat)
    expect_in(f"Felled: {rotation['felled_m']:g} m", flat)


def test_page_of_none():
    """Without exceeding rocks the mean has the error of 0: Wilson's interval of 0 in 1000, up to 3.8"""
    with Folder() as f:
        path = f.write("s.yaml", site(belt(0, 135, coppice(12)), rocks=1000, controls=[{"x_m": 135, "accepted_kJ": 1e6}]))
        flat = " ".join(good(*WHOLE, "--years", "0:2", path).out.split())
    z = 1.959963984540054
    expect_in(f"Years 0 to 2: mean 0 ±{math.ceil(1000 * z * z / (1000 + z * z))} of 1000, worst 0 ", flat)


def test_page_gaps():
    """The page's columns stay separate if all rocks arrive"""
    with Folder() as f:
        path = f.write("s.yaml", site(belt(0, 135, coppice(6, []), cut_year=0), controls=[{"x_m": 30}], rocks=1000))
        text = good(*WHOLE, "--years", "0:8", path).out
    lines = [x for x in text.splitlines() if re.match(r" +\d+ (cut|   ) ", x)]
    expect_equal(len(lines), 9, "lines of years")
    for line in lines:
        expect(re.search(r" \d+±\d+ +[\d.]+ +(none|[\d.]+) [✔✘] +[\d.]+ % [✔✘] +[\d.]+$", line), f"figures run together: {line!r}")


def rotations(text, names):
    """Return the rows of the table over the years by option, and the words below it."""
    table = text.split("\n    Over ")[1].split("\n\n")[0]
    rows = {name: next(line for line in table.splitlines() if line.startswith(f"  {name} ")) for name in names}
    return rows, " ".join(text.split())


NAMES = ["simple coppice", "coppice with standards", "selection coppice", "large reserves"]


def test_page_rotations():
    """The page: the options over the years, equal to JSON, and a sentence each for the years and today"""
    text = good(*WHOLE, "--years", "0:26", "-n", 1000, "rotation").out
    rows, words = rotations(text, NAMES)
    options = {o["name"]: o for o in result("--years", "0:26", "-n", 1000, "rotation")["options"]}
    for name, option in options.items():
        r = option["rotation"]
        half = math.ceil(r["exceed_probability"]["se"] * 1959.963984540054)
        worst = max(y["controls"][0]["wooded"]["exceed_probability"] for y in option["years"])
        expect_equal(rows[name].split()[len(name.split()):],
                     [f"{r['exceed_probability']['mean'] * 1000:.0f}±{half}", f"{worst * 1000:.0f}", f"({r['worst_year']})",
                      f"{r['unprotected_energy']}/27", f"{r['unprotected_contact']}/27", f"{r['unprotected_free_run']}/27",
                      f"{option['yield']['cut_m3_ha_per_year']:.1f}", f"{option['yield']['standing_m3_ha_mean']:.1f}"], name)
    expect_in("Over years 0 to 26, counted from today:", re.sub(r"\s+", " ", text))
    share = round(1000 * options["large reserves"]["rotation"]["exceed_probability"]["mean"])
    today = round(1000 * options["large reserves"]["controls"][0]["wooded"]["exceed_probability"])
    expect(re.search(rf"In years 0 to 26 .*'large reserves' lets? the fewest dangerous rocks through.* {share} of 1000\. Today 'large reserves' lets the "
                     rf"fewest dangerous rocks through: {today} of 1000\.", words), words)
    expect("By contact" not in text, "a verdict on one year in a page of years")
    _, words = rotations(good(*WHOLE, "--years", "18:42", "-n", 3000, "staggered").out,
                         ["all in year 1", "in three, top first", "in three, bottom first"])
    expect_in("In years 18 to 42 'in three, top first' and 'in three, bottom first' let the fewest dangerous rocks through and "
              "cannot be told apart", words)
    rows, words = rotations(good(*WHOLE, "--years", "0:26", "-s", "simulation.contact_model=index", "rotation").out, NAMES)
    expect(re.search(r" 194 \(1\) +11/27 +11/27 ", rows["simple coppice"]), rows)
    expect("the fewest" not in words, words)


def test_years_ahead():
    """--years without a range: the coming years, equal for all options, as on the plain page; the scene may set others"""
    run_of = result("--years", "-n", 200, "rotation")
    years = {o["name"]: [y["year"] for y in o["years"]] for o in run_of["options"]}
    expect_equal(years, {name: list(range(1, 26)) for name in NAMES})
    expect_equal(sum(y["cut"] for o in run_of["options"] for y in o["years"]), 5, "one cut of each, and two of the selection coppice")
    text = good(*WHOLE, "-n", 1667, "rotation").out
    expect_in("Over years 1 to 25, counted from today:", re.sub(r"\s+", " ", text))
    rows, words = rotations(text, NAMES)
    for option in run_of["options"]:
        same = option["rotation"]["exceed_probability"]  # equal rocks in all years; on the page each year has its own
        mean, half = re.search(r" (\d+)±(\d+) ", rows[option["name"]]).groups()
        expect_near(int(mean), 1000 * same["mean"], int(half) + 1960 * same["se"], option["name"])
        share = int(mean) / 1000
        expect(int(half) <= 1 + 1.25 * 1960 * math.sqrt(share * (1 - share) / 25000), "1000 rocks in each of 25 years tell the mean", rows[option["name"]])
    expect(re.search("In years 1 to 25 .*'large reserves' lets? the fewest dangerous rocks through", words), words)
    with Folder() as f:
        path = f.write("s.yaml", site(belt(0, 60, coppice(), cut_year=3), belt(70, 130, coppice(10, [5]), cut_year=8), rocks=1))
        found = [y["year"] for y in result("--years", path)["options"][0]["years"]]
        expect_equal(found, list(range(1, 26)), "belts of 25 and 10 years: the longer rotation")
        for given, wanted in (("{first: 2}", range(2, 27)), ("{last: 4}", range(1, 5)), ("{last: 0}", [0]), ("{first: 9, last: 9}", [9]), ("{first: 3, last: 5}", range(3, 6))):
            found = [y["year"] for y in result("--years", "-s", f"years={given}", path)["options"][0]["years"]]
            expect_equal(found, list(wanted), given)
        expect_equal([y["year"] for y in result("--years", "4:6:2", "-s", "years={first: 1}", path)["options"][0]["years"]], [4, 6])


def test_alike_years():
    """A stand without growth: its answer is today's, and the page gives the reason; its years count with the others'"""
    still = coppice(growth=None, cutting=None)
    with Folder() as f:
        path = f.write("s.yaml", site(options=[("grows", [belt(0, 135, coppice())]), ("still", [belt(0, 135, still)]), ("none", [])]))
        text = re.sub(r"\s+", " ", good(*WHOLE, "-n", 200, path).out)
        counts = [len(o["years"]) for o in result("--years", "-n", 1, path)["options"]]
    expect_in("'still' does not change: stand 'coppice' has no growth and cutting data.", text)
    expect_in("'none' does not change: it has no stems.", text)
    expect("'grows' does not change" not in text, text)
    expect_equal(counts, [25, 25, 25], "years")


def test_just_cut():
    """Freshly cut presets grow again: shoots sprout after a year, and their rotation is that of the grown ones"""
    systems = ("simple-coppice", "coppice-with-standards", "large-reserves", "selection-coppice")
    options = [(name + cut, [belt(0, 135, name + cut)]) for name in systems for cut in ("", "-cut")]
    found = {o["name"]: o for o in run(site(options=options), "0:30", "-n", 1)["options"]}
    for name in systems:
        grown, cut = found[name], found[name + "-cut"]
        stands = [y["stands"][0] for y in cut["years"]]
        shoots = [s["stems_per_ha"] - s["trees_per_ha"] for s in stands]
        expect(shoots[1] > shoots[0] and shoots[1] > 10 * grown["stands"][0]["stools_per_ha"] / 3, f"{name}: no shoots after a year", shoots)
        first = next(y["year"] for y in cut["years"] if y["cut"])
        expect_equal(first, 13 if name.startswith("selection") else 25, f"{name}: the next cut")
        after = next(y["stands"][0] for y in grown["years"] if y["cut"])
        expect_equal(stands[first]["stems_per_ha"], after["stems_per_ha"], f"{name}: after the next cut")
        expect_near(cut["yield"]["cut_m3_ha_per_year"], grown["yield"]["cut_m3_ha_per_year"], 1e-9, name)


# ---- usage ----

BAD_YEARS = ["5", "5:1", "a:b", "0:5:0", "0:1000", "0:5000:5", "-1:5", "0.5:3", "0:5.5", "0:5:1.5", "0:5:-1", "0:5:",
             ":5", "5:", ":", "", " 0:5", "0:5 ", "0:5:1:1", "nan:5", "0:inf", "0:100001", "0x1:5", "0-5"]


def test_years_usage():
    """--years that is not a range of years, goes backwards or is too long: status 2 with a message"""
    for years in BAD_YEARS:
        done = ceduo("--batch", "--years", years, "paper-site")
        expect(done.status == USAGE and done.out == "" and done.err.startswith("ceduo: --years: "), f"'{years}'", done)
        expect_equal(done.err.count("\n"), 2, f"'{years}': lines on standard error")
    good("--batch", "--years", "0:999", "-n", 1, "paper-site")


# ---- the paper, and other studies ----


def test_right_after_the_cut():
    """Right after the cut only the selection coppice stays below 30 m (Ciabocco, Boccia and Ripa 2009)"""
    found = result("--years", "0:26", "-n", 1000, PROFILES / "scenes" / "rotation.yaml")
    expect_equal([o["rotation"]["unprotected_contact"] == 0 for o in found["options"]],
                 ["selection" in o["name"] for o in found["options"]], "never without contact")
    share = {}
    for option in found["options"]:
        for year in option["years"]:
            if not year["cut"]:
                continue
            adc = max(s["adc"]["adc_m"] for s in year["stands"])
            expect_equal(adc < 30, "selection" in option["name"], f"{option['name']}, year {year['year']}: ADC {adc}")
            expect_equal(year["controls"][0]["lights"]["contact"], "pass" if adc < 30 else "fail")
            wooded = year["controls"][0]["wooded"]
            share[option["name"]] = (adc, wooded["exceed_probability"], wooded["exceed_lo"], wooded["exceed_hi"])
        expect(option["name"] in share, f"{option['name']} is never cut")
        for year in option["years"]:  # shoots count from 3 cm on: d(10) = 16 (1 - exp(-.22)) = 3.16 cm
            young = "selection" not in option["name"] and 1 <= year["year"] < 11
            expect_equal(year["controls"][0]["lights"]["contact"] == "fail", young or year["cut"] and "selection" not in option["name"],
                         f"{option['name']}, year {year['year']}")
    bare = found["options"][0]["controls"][0]["bare"]["exceed_probability"]
    print(f"# right after the cut, of 1000 with more than 50 kJ at 135 m (bare {1000 * bare:.0f}):")
    for name, (adc, p, lo, hi) in share.items():
        print(f"#   {name:22} ADC {adc:6.1f} m  {1000 * p:4.0f} ({1000 * lo:.0f}-{1000 * hi:.0f})")


def test_old_and_young():
    """From year to year a coppice has fewer shoots, and fewer rocks pass: old ones protect better"""
    stand, rocks = coppice(45, [], trees=None), 20000 if FULL else 5000
    years = run_years(site(belt(0, 135, stand, cut_year=1), rocks=rocks), "2:45")
    rows = []
    for year in years:
        s, a = year["stands"][0], year["controls"][0]["wooded"]
        share, reach = a["exceed_probability"], a["reach_probability"]
        rows.append((year["year"] - 1, s["stems_per_ha"], reach, share, math.sqrt(share * (1 - share) / rocks)))
    print("# age, shoots/ha, of 1000: arrive, with more than 50 kJ, its standard error (Radtke et al. 2014: years over 30)")
    for row in rows[::4] + rows[-1:]:
        print("#  {:3d} {:7.0f} {:6.1f} {:6.1f} {:5.2f}".format(*row[:2], *(1000 * x for x in row[2:])))
    for before, after in zip(rows, rows[1:]):
        expect(after[1] < before[1], "more shoots than a year before", before, after)
    young, old = ([r for r in rows if (r[0] > 30) == x] for x in (False, True))
    sums = [(mean(r[1] for r in g), mean(r[2] for r in g), mean(r[3] for r in g), mean(r[4] for r in g)) for g in (young, old)]
    for name, g in zip(("up to 30", "over 30"), sums):
        print(f"#  {name:8}: {g[0]:6.0f} shoots/ha, of 1000 {1000 * g[1]:.1f} arrive, {1000 * g[2]:.1f} +-{1000 * g[3]:.1f} "
              "(at most, standard error) with more than 50 kJ")
    expect(sums[1][0] < sums[0][0], "shoots", sums)
    for share in (1, 2):
        expect(sums[1][share] + 4 * (sums[0][3] + sums[1][3]) < sums[0][share], "share that comes through", sums)
    expect(rows[-1][3] < 0.1 * rows[0][3], "from the first to the last year", rows[0], rows[-1])


# ---- required minimum of a forest ----


def warned(stands):
    return [any("must stay" in w for w in s["warnings"]) for s in stands]


def test_minimum():
    """minimum.reserves_per_ha: noted if a forest has fewer single trees, not if it has enough"""
    two = [belt(0, 60, coppice(trees=[{"per_ha": 50, "dbh_m": 0.2, "height_m": 12}, {"per_ha": 30, "dbh_m": 0.3, "height_m": 14}])),
           belt(60, 135, coppice(name="few"))]
    for least, wanted in ((0, [False, False]), (60, [False, False]), (61, [False, True]), (80, [False, True]), (81, [True, True])):
        with Folder() as f:
            path = f.write("s.yaml", site(*two, minimum={"reserves_per_ha": least}, rocks=20))
            found = result(path)["options"][0]["stands"]
            expect_equal(warned(found), wanted, f"at least {least}")
            text = " ".join(good(*WHOLE, path).out.split())
            expect_equal("must stay" in text, True in wanted, f"page, at least {least}")
            if wanted[1]:
                expect_in(f"few: 60 single trees a hectare are fewer than the {least} that must stay.", text)
    expect_equal(warned(run_result(site(*two))), [False, False], "not said")


def run_result(mapping):
    with Folder() as f:
        return result(f.write("s.yaml", mapping))["options"][0]["stands"]


def test_minimum_in_years():
    """minimum.reserves_per_ha: in the years too, from the first cut that leaves too few"""
    for stay, kept in (([40, 20], True), ([40, 19], False)):
        years = run_years(site(belt(0, 135, coppice(8, stay), cut_year=3), minimum={"reserves_per_ha": 60}, rocks=20), "0:12")
        expect_equal([warned(y["stands"]) for y in years], [[not kept and y["year"] >= 3] for y in years], f"stay {stay}")


def test_minimum_of_nothing():
    """minimum.reserves_per_ha: a cut that leaves no stem is noted in its own year"""
    years = run_years(site(belt(0, 135, coppice(8, []), cut_year=3), minimum={"reserves_per_ha": 60}, rocks=20), "0:5")
    expect_equal([warned(y["stands"])[0] for y in years], [False] * 3 + [True] * 3, "noted")


# ---- --find ----

RESERVES = "forest[0].stand.trees[0].per_ha"
FOUND = {"format", "version", "scene", "path", "option", "goal", "target", "lo", "hi", "found", "value", "side",
         "goal_at_value", "nearest", "monotone", "evaluations"}


def reserves(per_ha=60, rocks=1000, **changes):
    """Single trees of 20 cm only."""
    stand = {"name": "reserves", "species": "ostrya-carpinifolia",
             "trees": [{"per_ha": per_ha, "dbh_m": 0.2, "height_m": 12}]}
    return site(belt(0, 135, stand), rocks=rocks, **changes)


def find(mapping, path, lo, hi, goal, *arguments):
    with Folder() as f:
        return good("--find", f"{path}={lo}:{hi}", "--goal", goal, "-f", "json", *arguments,
                    f.write("s.yaml", mapping)).json()[0]


def set_value(mapping, path, value):
    """Return a copy with the number at a path like 'a[0].b.c' set."""
    changed = copy.deepcopy(mapping)
    place, keys = changed, re.findall(r"[\w]+|(?<=\[)\d+", path)
    for key in keys[:-1]:
        place = place[int(key)] if isinstance(place, list) else place.setdefault(key, {})
    place[int(keys[-1]) if isinstance(place, list) else keys[-1]] = value
    return changed


def compute_goal(run_found, goal):
    """Return --find's goal, from a plain run: the worst belt, the worst control."""
    option = run_found["options"][0]
    if goal == "adc":
        return max(math.inf if s["adc"]["adc_m"] is None else s["adc"]["adc_m"] for s in option["stands"])
    if goal == "free-run":
        return max(s["free_run_probability"] for s in option["stands"])
    if goal == "exceed":
        return max(c["wooded"]["exceed_probability"] for c in option["controls"])
    return max((c["wooded"]["energy_kJ"]["mean"] if c["wooded"] else c["index"]["residual_kJ"]) or 0
               for c in option["controls"])


def passes(goal, value, target):
    return value < target if goal == "adc" else value <= target


def test_find_reserves():
    """60 reserves of 20 cm miss 30 m; --find: 379 per hectare meet it, 378 do not"""
    mapping = reserves()
    adc = compute_goal(run(mapping, "0:0"), "adc")
    expect(189 < adc < 190, f"60 a hectare: ADC {adc} (the paper: some 190 m)")
    found = find(mapping, RESERVES, 1, 5000, "adc")
    expect(set(found) >= FOUND, "missing", FOUND - set(found))
    wanted = {"format": "ceduo-find-1", "path": RESERVES, "option": "current", "goal": "adc", "target": 30, "lo": 1,
              "hi": 5000, "found": True, "value": 379, "side": "smallest", "monotone": True}
    expect_equal({key: found[key] for key in wanted}, wanted)
    expect(found["goal_at_value"] < 30 and found["evaluations"] < 20, found)
    for per_ha, light in ((378, "fail"), (379, "pass")):
        option = run(set_value(mapping, RESERVES, per_ha), "0:0")["options"][0]
        expect_equal(option["controls"][0]["lights"]["contact"], light, f"{per_ha} a hectare")
    expect_equal(option["stands"][0]["adc"]["adc_m"], found["goal_at_value"], "ADC with 379")


def test_find_over_years():
    """--find over a rotation: shares by the mean over its years, all else by the worst year; by the index shares without forest"""
    for model, goals in (("stems", ("arrive=1", "adc=1e6", "free-run=1", "energy=1e6", "exceed=1")), ("index", ("arrive=1", "adc=1e6"))):
        mapping = site(belt(0, 135, coppice(rotation=5, stay=[30])), rocks=40, simulation={"contact_model": model})
        rows = run(mapping, "1:5")["options"][0]["years"]
        controls = [row["controls"][0] for row in rows]
        arrivals = [c["wooded"] or c["bare"] for c in controls]
        expect(model == "index" or len({a["energy_kJ"]["mean"] for a in arrivals}) == 5, "years are alike")
        for goal in goals:
            name = goal.split("=")[0]
            share = {"arrive": "reach_probability", "exceed": "exceed_probability"}.get(name)
            wanted = sum(a[share] for a in arrivals) / 5 if share else max(compute_goal({"options": [row]}, name) for row in rows)
            found = find(mapping, RESERVES, 60, 60, goal, "--years")
            expect_near(found["goal_at_value"], wanted, 1e-9 * wanted, name)


KINDS = [  # path, whole, lo, hi, further settings
    (RESERVES, True, 1, 5000, {}),
    ("forest[0].stand.shoots[0].per_ha", True, 2500, 60000, {"rule": "gsteiger-stems"}),
    ("forest[0].stand.shoots[0].per_ha", True, 2500, 60000, {"rule": "crofton"}),
    ("forest[0].stand.stools.per_ha", True, 1, 7500, {"rule": "gsteiger-stools"}),
    ("forest[0].stand.stools.per_ha", True, 1, 7500, {"rule": "interception"}),
    ("forest[0].stand.trees[0].dbh_m", False, 0.01, 2, {"rule": "crofton"}),
    ("rock.diameter_m", False, 0.05, 5, {"rule": "crofton"}),
]
GOALS = 200


def random_case(rng):
    """Return a scene, a parameter with its range, and a value in or near the range whose goal is the target."""
    path, whole, most_lo, most_hi, settings = rng.choice(KINDS)
    stand = coppice(shoots=[{"per_ha": 7500, "dbh_m": 0.06, "height_m": 6}])
    if "trees[0]" in path:
        stand = {"name": "trees", "trees": [{"per_ha": rng.randint(10, 2000), "dbh_m": rng.uniform(0.1, 0.5), "height_m": 12}]}
    mapping = site(belt(0, 135, stand), rocks=1, simulation=settings,
                   rock={"shape": "sphere", "diameter_m": rng.uniform(0.2, 1.5)})
    lo = rng.uniform(most_lo, most_lo + (most_hi - most_lo) / 3)
    hi = rng.uniform(lo, most_hi)
    inside = min(max(most_lo, rng.uniform(lo - 0.1 * (hi - lo), hi + 0.1 * (hi - lo))), most_hi)
    return mapping, path, whole, lo, hi, rng.choice(("adc", "free-run")), inside


def forward(folder, name, scenes):
    """Return the goals of plain runs of many scenes, one by one."""
    paths = [folder.write(f"{name}-{i}.yaml", mapping) for i, mapping in enumerate(scenes)]
    return [found for k in range(0, len(paths), 100) for found in results("-n", 1, *paths[k:k + 100])]


def test_find_and_forward():
    """200 random goals: the result of --find passes in a run, and its neighbour on the other side does not"""
    rng = random.Random(2009)
    cases = [random_case(rng) for _ in range(GOALS)]
    checks = []  # (result, goal, target, ends, values to try)
    with Folder() as f:
        aims = forward(f, "aim", [set_value(mapping, path, inside) for mapping, path, *_, inside in cases])
        for i, ((mapping, path, whole, lo, hi, goal, _), aim) in enumerate(zip(cases, aims)):
            target = compute_goal(aim, goal) * rng.choice((1, 1 + 1e-3, 1 - 1e-3))
            found = good("--find", f"{path}={lo!r}:{hi!r}", "--goal", f"{goal}={target!r}", "-f", "json",
                         f.write(f"find-{i}.yaml", mapping)).json()[0]
            expect_equal((found["lo"], found["hi"], found["target"]), (lo, hi, target), "what was asked")
            ends = (math.ceil(lo), math.floor(hi)) if whole else (lo, hi)
            if ends[0] > ends[1]:
                expect_equal((found["found"], found["evaluations"], found["nearest"]), (False, 0, None), "no whole number")
                continue
            values = list(ends)
            if found["found"]:
                step = 1 if whole else 1e-4 * (hi - lo) * (1 + 1e-9)
                expect(ends[0] <= found["value"] <= ends[1] and (not whole or found["value"] == int(found["value"])), found)
                values += [found["value"], found["value"] + (step if found["side"] == "largest" else -step)]
            checks.append((found, goal, target, ends, [(mapping, path, v) for v in values]))
        seen = iter(forward(f, "check", [set_value(*one) for *_, ones in checks for one in ones if one[2] > 0]))
        goals = [[compute_goal(next(seen), goal) if one[2] > 0 else None for one in ones] for _, goal, _, _, ones in checks]
    crossings = sum(one_goal(found, goal, target, ends, g) for (found, goal, target, ends, _), g in zip(checks, goals))
    print(f"# {len(checks)} goals: {crossings} crossings, {sum(not c[0]['found'] for c in checks)} not found")
    expect(crossings > GOALS / 2, f"only {crossings} crossings")


def one_goal(found, goal, target, ends, seen):
    """`seen`: the goals at both ends, at the result, and at its neighbour that should fail."""
    ok = [g is not None and passes(goal, g, target) for g in seen]
    expect_equal(found["found"], ok[0] or ok[1], f"found: {found}")
    if not found["found"]:
        expect_equal((found["value"], found["side"], found["goal_at_value"]), (None, None, None))
        expect_equal(found["goal_at_nearest"], min(seen), f"nearest: {found}")
        return False
    expect_equal((found["nearest"], found["goal_at_nearest"]), (None, None), "nearest, though one is found")
    expect_equal(found["goal_at_value"], seen[2], f"goal at the value: {found}")
    expect(ok[2], "the value does not pass", found, seen)
    if ok[0] and ok[1]:
        expect_equal((found["value"], found["side"]), (ends[0], "smallest"), "the whole range passes")
        return False
    expect_equal(found["side"], "smallest" if ok[1] else "largest", "side")
    expect(seen[3] is not None and not ok[3], "the next value passes too", found, seen)
    return True


def test_find_rocks():
    """Goals exceed and energy: equal rocks in a plain run give the same figure; the next whole number fails"""
    mapping = reserves(controls=[{"x_m": 135, "accepted_kJ": 50}, {"x_m": 60, "accepted_kJ": 60}])
    for goal, target in (("exceed", 0.05), ("exceed=0.3", 0.3), ("energy=60", 60), ("energy=38.5", 38.5)):
        found = find(mapping, RESERVES, 1, 3000, goal)
        name, value = goal.partition("=")[0], found["value"]
        expect_equal((found["found"], found["side"], found["target"], found["rocks"]), (True, "smallest", target, 1000), goal)
        here, below = (compute_goal(run(set_value(mapping, RESERVES, v), "0:0"), name) for v in (value, value - 1))
        expect_equal(here, found["goal_at_value"], f"{goal}: forward at {value}")
        expect(here <= target < below, f"{goal}: {here} at {value}, {below} at {value - 1}", found)
    more = find(mapping, RESERVES, 1, 3000, "exceed=0.3", "-n", 3000)
    expect_equal(more["rocks"], 3000, "-n")
    bigger = find(reserves(300), "rock.height_m", 0.2, 3, "energy=40")
    expect_equal(bigger["side"], "largest", "a heavier rock brings more energy")


def test_find_index():
    """With the contact model index the goal energy is the residual energy; exceed is refused"""
    mapping = reserves(simulation={"contact_model": "index"})
    found = find(mapping, RESERVES, 1, 3000, "energy=40")
    here, below = (compute_goal(run(set_value(mapping, RESERVES, v), "0:0"), "energy") for v in (found["value"], found["value"] - 1))
    expect_equal(here, found["goal_at_value"], "residual_kJ")
    expect(here <= 40 < below, here, below)
    refused(mapping, [f"{RESERVES}=1:3000", "--goal", "exceed"], "index")


def test_find_whole():
    """Densities and years are whole numbers on the passing side, other values are not"""
    mapping = reserves()
    expect_equal(find(mapping, RESERVES, 0.5, 5000.5, "adc")["value"], 379)
    expect_equal(find(mapping, RESERVES, 378.2, 379.9, "adc")["value"], 379, "one whole number")
    none = find(mapping, RESERVES, 378.2, 378.9, "adc")
    expect_equal((none["found"], none["value"], none["nearest"], none["evaluations"]), (False, None, None, 0))
    grown = site(belt(0, 135, coppice(), cut_year=3))
    for path in ("forest[0].stand.cutting.rotation_years", "forest[0].cut_year", "forest[0].stand.shoots[0].per_ha",
                 "forest[0].stand.stools.per_ha", "simulation.seed"):
        goal = "exceed=1" if "rotation" in path or "cut_year" in path else "adc"  # adc: not just after the cut
        found = find(grown, path, 2600.5 if "per_ha" in path else 1.5, 2700.5 if "per_ha" in path else 40.5, goal, "-n", 2)
        expect_equal(found["value"], 2601 if "per_ha" in path else 2, path)
    options = site(options=[("a", [belt(0, 135, coppice())]), ("b", reserves()["forest"])])
    for path in ("options[1].forest[0].stand.trees[0].per_ha", "options[b].forest[0].stand.trees[0].per_ha"):
        expect_equal(find(options, path, 0.5, 5000.5, "adc", "--option", "b")["value"], 379, path)
    found = find(mapping, "forest[0].stand.trees[0].dbh_m", 0.1, 5, "adc")
    expect_near(found["value"], 1e4 / (30 * 60) - 0.68, 1e-4 * 4.9, "dbh")


def test_find_nothing():
    """If nothing passes: found false, no value, the nearest one, status 0; and the page reports it"""
    found = find(reserves(), RESERVES, 10, 300, "adc")
    expect_equal({k: found[k] for k in ("found", "value", "side", "goal_at_value", "nearest")},
                 {"found": False, "value": None, "side": None, "goal_at_value": None, "nearest": 300})
    expect_near(found["goal_at_nearest"], 1e4 / (300 * 0.88), 1e-9, "goal at the nearest")
    with Folder() as f:
        text = good("--find", f"{RESERVES}=10:300", "--goal", "adc", f.write("s.yaml", reserves())).out
    expect(text.startswith(f"{RESERVES}: no value from 10 to 300 reaches the goal") and "nearest: 300" in text, text)


def test_find_everything():
    """If the whole range passes: the value is its lower end, the side smallest"""
    for lo, hi, goal in ((400, 900, "adc"), (400, 400, "adc"), (1, 5, "adc=1e6"), (900, 1000, "free-run"), (1, 900, "exceed=1")):
        found = find(reserves(), RESERVES, lo, hi, goal)
        expect_equal((found["found"], found["value"], found["side"], found["monotone"]), (True, lo, "smallest", True), goal)
    with Folder() as f:
        text = good("--find", f"{RESERVES}=400:900", "--goal", "adc", f.write("s.yaml", reserves())).out
    expect(f"{RESERVES} = 400\n" in text and "every value" in text, text)


def test_find_largest():
    """If only low values pass: the largest of them"""
    mapping = reserves(900, rocks=500)
    found = find(mapping, "forest[0].from_m", 0, 120, "exceed=0.3")
    expect_equal((found["found"], found["side"]), (True, "largest"))
    here = compute_goal(run(set_value(mapping, "forest[0].from_m", found["value"]), "0:0"), "exceed")
    expect(here == found["goal_at_value"] <= 0.3, found, here)


def test_find_formats():
    """--find has equal results as a page, as CSV and as JSON; several scenes in sequence; to a file; -j"""
    with Folder() as f:
        a, b = f.write("a.yaml", reserves()), f.write("b.yaml", reserves(rock={"shape": "sphere", "diameter_m": 0.8}))
        arguments = ["--find", f"{RESERVES}=1:5000", "--goal", "adc", a, b]
        found = good(*arguments, "-f", "json").json()
        expect_equal([(r["scene"], r["value"]) for r in found], [(str(a), 379), (str(b), 334)])
        rows = list(csv.DictReader(io.StringIO(good(*arguments, "-f", "csv").out)))
        for row, one in zip(rows, found):
            expect_equal((one["yield"], one["sure"]), (None, None), "a stand without growth, and nobody asks how sure")
            expect(all(same_cell(row[k], None if k.startswith(("yield.", "sure.")) else one[k]) for k in row), row, one)
        expect_equal([(r["scene"], r["rocks"]) for r in rows], [(str(a), "1000"), (str(b), "1000")])
        comma = f.write('c,"d.yaml', reserves())
        row = list(csv.DictReader(io.StringIO(good(*arguments[:4], comma, "-f", "csv").out)))[0]
        expect_equal((row["scene"], row["path"]), (str(comma), RESERVES), "quotes")
        text = good(*arguments).out
        expect_equal(re.findall(r"^(\S+):$", text, re.M), [str(a), str(b)], "scenes named")
        expect(str(a) not in good(*arguments[:-1]).out, "one scene needs no name")
        expect_equal(re.findall(r"^forest\S+ = (\d+)$", text, re.M), ["379", "334"])
        expect("ADC 29.98 m (goal: below 30 m)" in text, text)
        good(*arguments, "-f", "json", "-o", f.path / "out.json")
        expect_equal([json.loads(x) for x in (f.path / "out.json").read_text().splitlines()], found)
        one, two = (good("--find", f"{RESERVES}=1:3000", "--goal", "exceed", "-j", j, a).out for j in (1, 2))
        expect_equal(one, two, "-j 1 and -j 2")
        good("--batch", "--find", f"{RESERVES}=1:5000", "--goal", "adc", a)


def refused(mapping, arguments, *words):
    """Expect status 2, nothing on standard output, and this message."""
    with Folder() as f:
        done = ceduo("--find", *arguments, f.write("s.yaml", mapping))
    expect(done.status == USAGE and done.out == "" and done.err.count("\n") in (1, 2, 3, 4), arguments, done)
    for word in words:
        expect_in(word, done.err, str(arguments))
    return done


def test_find_options():
    """--find on several options without --option, with two, or with an unknown one: status 2"""
    mapping = site(options=[("a", reserves()["forest"]), ("b", reserves(100)["forest"])])
    path = "options[b].forest[0].stand.trees[0].per_ha"
    refused(mapping, [f"{path}=1:5000", "--goal", "adc"], "several options", "--option")
    refused(mapping, [f"{path}=1:5000", "--goal", "adc", "--option", "a", "--option", "b"], "--option")
    refused(mapping, [f"{path}=1:5000", "--goal", "adc", "--option", "c"], "no option 'c'")
    expect_equal(find(mapping, path, 1, 5000, "adc", "--option", "b")["value"], 379)


def test_find_refused():
    """--find with a wrong path, range or goal: status 2 and a clear message"""
    mapping = reserves()
    refused(mapping, ["nope=0:5", "--goal", "adc"], "'nope'", "unknown key")
    refused(mapping, ["forest[7].stand.trees[0].per_ha=1:5", "--goal", "adc"], "'7'", "no such item")
    refused(mapping, ["rock=1:5", "--goal", "adc"], "rock")
    refused(mapping, ["simulation.rule=1:5", "--goal", "adc"], "simulation.rule")
    for value in (f"{RESERVES}=5:1", f"{RESERVES}=5", f"{RESERVES}=:5", f"{RESERVES}=1:", f"{RESERVES}=a:b", RESERVES,
                  f"{RESERVES}=nan:5", f"{RESERVES}=1:inf", f"{RESERVES}=1:2:3", "=1:5", "", f"{RESERVES}=1-5"):
        refused(mapping, [value, "--goal", "adc"], "--find: ", "try 'ceduo --help'")
    refused(mapping, [f"{RESERVES}=-5:100", "--goal", "adc"], "per_ha", "-5", "100, is possible")
    refused(mapping, [f"{RESERVES}=1:5000"], "--goal")
    for goal, word in (("fun", "'fun'"), ("", "''"), ("energy", "energy=50"), ("energy=", "''"), ("energy=x", "'x'"),
                       ("adc=-1", "below 0"), ("adc=nan", "nan"), ("exceed=1e999", "1e999"), ("ADC", "'ADC'")):
        refused(mapping, [f"{RESERVES}=1:5000", "--goal", goal], "--goal", word)
    refused(reserves(controls=[{"x_m": 135}]), [f"{RESERVES}=1:5000", "--goal", "exceed"], "accepted_kJ")
    for more in (["--years", "0:5"], ["--plot", "stand"], ["-e", "0.1"]):
        refused(mapping, [f"{RESERVES}=1:5000", "--goal", "adc", *more], "--find")
    done = ceduo("--batch", "--goal", "adc", "paper-site")
    expect(done.status == USAGE and "--find" in done.err, done)
    expect_equal(ceduo("--find", "a=1:2", "--goal", "adc").status, USAGE, "no scene")


def test_find_text():
    """--find of a parameter that is not a number is refused"""
    for path in ("title", "forest[0].stand.name"):
        refused(reserves(), [f"{path}=1:5", "--goal", "adc"], path)


def test_find_says_find():
    """An error in the values of --find has --find as its place, not --set"""
    done = refused(reserves(), ["nope=0:5", "--goal", "adc"])
    expect(not done.err.startswith("--set"), done.err)


def test_find_example():
    """The example range of --find is valid"""
    example = re.search(r"as '([^']+)'", ceduo("--find", "x", "--goal", "adc", "paper-site").err).group(1)
    good("--find", example, "--goal", "adc", "paper-site")


# ---- signals ----


def test_interrupt():
    """SIGINT during years or a search: ends by that signal, nothing printed"""
    with Folder() as f:
        path = f.write("s.yaml", site(belt(0, 135, coppice()), rocks=1000000))
        for arguments in (["--years", "0:20"], ["--plot", "rotation"], ["--find", f"{RESERVES}=1:5000", "--goal", "exceed"]):
            with subprocess.Popen([CEDUO, *arguments, str(path)], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                  env=environment()) as p:
                time.sleep(0.5)
                expect(p.poll() is None, "it ended before the signal", p.returncode)
                p.send_signal(signal.SIGINT)
                try:
                    out, err = p.communicate(timeout=PATIENCE)
                except subprocess.TimeoutExpired as late:
                    p.kill()
                    raise Failure("it goes on after the signal") from late
            expect_equal((p.returncode, out, err), (-signal.SIGINT, b"", b""), arguments[0])


if __name__ == "__main__":
    run_all(__name__)
