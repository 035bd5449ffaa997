#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Yields of the options: volumes felled, standing and dead compared with sums by hand, for one preset of each system."""
import csv
import io
import json
import math
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import (USAGE, Folder, ceduo, expect, expect_equal, expect_in, expect_near, good, result,  # noqa: E402
                     run_all)
from pages import WHOLE
from test_years import belt, coppice, site  # noqa: E402

SHOOTS = (0.16, 0.022, 14, 0.035)  # D, k, H, m of the four presets; assumed in their files
TREES = (0.45, 0.014, 20, 0.03)
SDI_MOST, SDI_TREES = 1000, 350


# ---- a model by hand ----


def size(curve, age):
    d, k, h, m = curve
    return d * (1 - math.exp(-k * age)), h * (1 - math.exp(-m * age))


def volume(d, h):
    """Hop hornbeam, Tabacchi et al. 2011 inside 5 to 35 cm and 5 to 30 m; outside as d2 h from the nearest point."""
    cm = 100 * d
    near, high = min(max(cm, 5), 35), min(max(h, 5), 30)
    return (-1.4983 + 0.038828 * near**2 * high) / 1000 * cm**2 * h / (near**2 * high)


def density_index(stems):
    n = sum(n for n, _, _ in stems)
    return n * (100 * math.sqrt(sum(n * d**2 for n, d, _ in stems) / n) / 25.4)**1.605 if n > 0 else 0


class System:
    """Stools per hectare, years between cuts, cohorts of shoots, final shoots per stool, retained trees by age."""

    def __init__(self, stools, rotation, cohorts, old, stay):
        self.stools, self.rotation, self.cohorts, self.old, self.stay = stools, rotation, cohorts, old, stay

    def shoots_on_stool(self, age):
        return self.old + (16 - self.old) * math.exp(-age / 5)

    def stems(self, since):
        """Return shoots and trees n years after a cut: lists of (per hectare, dbh, height), oldest shoots first."""
        ages = [i * self.rotation + since for i in range(self.cohorts)][::-1]
        shoots = [(self.stools * self.shoots_on_stool(a) / self.cohorts, *size(SHOOTS, a)) for a in ages if a > 0]
        trees = [(n, *size(TREES, (j + 1) * self.rotation + since)) for j, n in enumerate(self.stay) if n > 0]
        most = SDI_MOST * max(0, 1 - density_index(trees) / SDI_TREES)
        if density_index(shoots) > most:  # the trees limit the shoots
            share = most / density_index(shoots)
            shoots = [(share * n, d, h) for n, d, h in shoots]
        return shoots, trees

    def standing(self, since):
        return sum(n * volume(d, h) for stems in self.stems(since) for n, d, h in stems)

    def felled(self):
        return self.standing(self.rotation) - self.standing(0)

    def grown_and_died(self):
        """Return the gain of surviving stems, and the volume of dying ones, year by year between two cuts."""
        grown = died = 0
        for t in range(self.rotation):
            (shoots, trees), (later, older) = self.stems(t), self.stems(t + 1)
            if len(later) > len(shoots):  # the youngest sprout
                n, d, h = later[-1]
                grown += n * volume(d, h)
            for (n, d, h), (m, e, g) in zip(shoots + trees, later[:len(shoots)] + older):
                grown += m * (volume(e, g) - volume(d, h))
                died += (n - m) * volume(d, h)
        return grown, died


# each with its total, m3 per hectare: just before a cut minus just after it
PRESETS = {
    "simple-coppice": (System(2500, 25, 1, 3, [30, 30]), 116.26 - 11.37),
    "coppice-with-standards": (System(1500, 25, 1, 3, [100, 50, 20, 10]), 135.05 - 42.82),
    "selection-coppice": (System(1200, 13, 3, 6, [0, 0, 0, 40]), 130.18 - 53.74),
    "large-reserves": (System(1057, 25, 1, 3, [125, 125]), 139.94 - 47.37),
}


STILL = coppice(growth=None, cutting=None)


def run_yield(mapping, *arguments):
    with Folder() as f:
        return result("--years", "-n", 2, *arguments, f.write("s.yaml", mapping))["options"]


def test_presets_by_hand():
    """One preset of each system: felled, standing and dead volume of a rotation equal the sum by hand"""
    options = run_yield(site(options=[(name, [belt(0, 135, name, cut_year=1)]) for name in PRESETS]))
    for option in options:
        system, felled = PRESETS[option["name"]]
        found, years = option["yield"], system.rotation
        expect_near(system.felled(), felled, 0.011, f"{option['name']}: the sum that stands in this file")
        expect_near(found["cut_m3_ha_per_year"], system.felled() / years, 1e-9, option["name"])
        expect_near(found["standing_m3_ha_mean"], sum(map(system.standing, range(years))) / years, 1e-9, option["name"])
        expect_near(found["died_m3_ha_per_year"], system.grown_and_died()[1] / years, 1e-9, option["name"])
        last = found["cuts"][-1]
        expect_equal((last["year"], last["from_m"], last["to_m"]), (1 + years, 0, 135), "the cut at the end of the rotation")
        expect_near(last["volume_m3_ha"], system.felled(), 1e-7, option["name"])


def test_standards_are_no_gift():
    """The yield has a maximum over the number of standards: they take growing space, and stools die in their shade. Too many
    have no yield, and the page reports it"""
    numbers = range(0, 336, 15)
    found = [o["yield"]["cut_m3_ha_per_year"] for o in run_yield(site(options=[
        (f"{n} standards", [belt(0, 135, {"base": "simple-coppice", "cutting": {"stay_per_ha": [n / 2, n / 2]}}, cut_year=1)])
        for n in numbers]), "--rocks", 1)]
    best = found.index(max(found))
    expect(0 < best < len(found) - 8, f"the best of {found} is neither none nor nearly all")
    expect(all(a < b for a, b in zip(found[:best], found[1:])), f"up to {best}: {found}")
    expect(all(a > b for a, b in zip(found[best:], found[best + 1:])), f"from {best} on: {found}")
    for n, value in zip(numbers, found):
        expect_near(value, System(2500, 25, 1, 3, [n / 2, n / 2]).felled() / 25, 1e-9, f"{n} standards")
    what = site(options=[(f"{n} standards", [belt(0, 135, {"base": "simple-coppice", "cutting": {"stay_per_ha": [n]}}, cut_year=1)])
                         for n in (60, 600)])
    expect_equal(run_yield(what)[1]["yield"], None, "600 standards")
    with Folder() as f:
        page = " ".join(good(*WHOLE, "--years", "-n", 2, f.write("s.yaml", what)).out.split())
    expect_in("'600 standards': the standards would take 1", page)
    expect_in("Side light, roots and the quality of the wood are not modelled.", page)


def test_balance():
    """Over a repeating rotation felled volume is growth minus deaths, within rounding"""
    options = run_yield(site(options=[(name, [belt(0, 135, name)]) for name in PRESETS]))
    for option in options:
        system, _ = PRESETS[option["name"]]
        grown, died = system.grown_and_died()
        found = option["yield"]
        expect(died > 0, f"{option['name']}: nothing dies")
        expect_near(found["cut_m3_ha_per_year"] + found["died_m3_ha_per_year"], grown / system.rotation, 1e-9, option["name"])


def test_first_cut():
    """The first cut fells the existing stand, later ones a whole rotation's growth"""
    found = run_yield(site(belt(0, 135, coppice(growth={**coppice()["growth"], "sdi_most": 0}), cut_year=0)))[0]["yield"]["cuts"]
    before = 7500 * volume(0.05, 6) + 60 * volume(0.2, 12)
    after = sum(30 * volume(*size(TREES, age)) for age in (25, 50))
    expect_equal([cut["year"] for cut in found], [0, 25])
    expect_near(found[0]["volume_m3_ha"], before - after, 1e-9, "the inventory less what stays")
    expect_near(found[0]["stems_per_ha"], 7500, 1e-9, "60 trees stand before and after")


def test_staggered_is_single():
    """Felled at once or in sections years apart, a forest has the same yield"""
    once, staggered = run_yield(site(options=[
        ("once", [belt(0, 120, coppice(), cut_year=5)]),
        ("staggered", [belt(0, 40, coppice(), cut_year=5), belt(40, 80, coppice(), cut_year=13), belt(80, 120, coppice(), cut_year=21)])]))
    for key in ("cut_m3_ha_per_year", "standing_m3_ha_mean", "died_m3_ha_per_year"):
        expect_near(staggered["yield"][key], once["yield"][key], 1e-12, key)
    expect_equal([c["year"] for c in staggered["yield"]["cuts"]], [5, 13, 21, 30, 38, 46], "cuts up to the end of the first whole rotation")


def test_length_weights():
    """Belts are weighted by length; gaps and belts without stems do not count"""
    poor = coppice(stools={"per_ha": 1000, "spacing_m": 0.35}, shoots=[{"per_ha": 3000, "dbh_m": 0.05, "height_m": 6}])
    rich, mixed, other = run_yield(site(options=[
        ("rich", [belt(0, 135, coppice())]), ("mixed", [belt(0, 30, coppice()), belt(40, 130, poor), belt(130, 135, "bare")]),
        ("poor", [belt(0, 135, poor)])]))
    for key in ("cut_m3_ha_per_year", "standing_m3_ha_mean"):
        expect_near(mixed["yield"][key], rich["yield"][key] / 4 + other["yield"][key] * 3 / 4, 1e-9, key)


def test_unknown():
    """Without growth or cutting, or without a forest, the yield is null, never 0"""
    options = run_yield(site(options=[
        ("neither", [belt(0, 135, STILL)]), ("no cut", [belt(0, 135, coppice(cutting=None))]),
        ("nothing", []), ("one of two", [belt(0, 50, coppice()), belt(50, 135, STILL)])]))
    expect_equal([o["yield"] for o in options], [None] * 4)
    with Folder() as f:
        r = ceduo("--batch", "-f", "json", "-n", 2, f.write("s.yaml", site(belt(0, 135, coppice(growth=None)))))
    expect_equal(json.loads(r.out)["options"][0]["yield"], None, "no growth")
    expect_in("the stand is never cut, because it has no 'growth'", r.err)


def test_csv():
    """CSV: each row has the yield, empty if unknown"""
    with Folder() as f:
        path = f.write("s.yaml", site(options=[("coppice", [belt(0, 135, coppice())]), ("still", [belt(0, 135, STILL)])]))
        rows = list(csv.DictReader(io.StringIO(good("--batch", "-n", 2, "-f", "csv", path).out)))
        found = result("-n", 2, path)["options"][0]["yield"]
    for key in ("cut_m3_ha_per_year", "standing_m3_ha_mean", "died_m3_ha_per_year"):
        expect_equal(float(rows[0][f"yield.{key}"]), found[key], key)
        expect_equal(rows[1][f"yield.{key}"], "", key)


def test_page():
    """Page: each option has its yield per year and its standing volume, '-' if unknown"""
    with Folder() as f:
        path = f.write("s.yaml", site(options=[("coppice", [belt(0, 135, coppice())]), ("still", [belt(0, 135, STILL)])]))
        text = good(*WHOLE, "-n", 100, path).out
        found = result("-n", 2, path)["options"][0]["yield"]
    side = text[text.index("Side by side"):]
    expect(re.search(r"fail F m³/y m³/ha$", side, re.M), "units of the yield", side)
    row = re.search(r"^  coppice .*\d/\d.*$", side, re.M).group(0).split()
    expect_equal(row[-2:], [f"{found['cut_m3_ha_per_year']:.1f}", f"{found['standing_m3_ha_mean']:.1f}"], side)
    expect(re.search(r"^  still .*\d/25 +- +-$", side, re.M), side)


def test_tradeoff():
    """--plot tradeoff: a point per option, brackets around those that another beats in both"""
    text = good("--plot", "tradeoff", "-n", 1000, "--size", "100x24", "rotation").out
    for name in ("(1) simple coppice", "(2) coppice with standards", "3 selection coppice", "4 large reserves"):
        expect_in(name, text)
    expect_in("another is better in both", text)
    rows = [row[6:66] for row in text.split("\n")[2:-4]]  # without the axes and the names
    place = {sign: next(((row.index(sign), y) for y, row in enumerate(rows) if sign in row), None) for sign in ("(1)", "(2)", "3", "4")}
    expect(None not in place.values(), place, text)
    expect(place["(1)"][1] < place["4"][1] and place["4"][0] < place["3"][0], "higher: more rocks; to the right: more wood", place, text)
    expect_equal(ceduo("--plot", "tradeoff", "--years", "0:5", "rotation").status, 0)
    expect_equal(ceduo("--plot", "profile", "--years", "rotation").status, USAGE)
    still = good("--plot", "tradeoff", "-n", 50, "-s", "options[0].forest=[]", "--option", "simple coppice", "rotation").out
    expect_in("no option has growth and cutting data", still)


def find(path, goal, value, *arguments):
    return result("--find", f"{path}={value}", "--goal", goal, "-n", 400, "--option", "simple coppice", *arguments, "rotation")


def test_find_rotation():
    """--find: the rotation and the retained standards are searched over the coming years, with their yield"""
    base = "options[0].forest[0].stand.cutting"
    found = find(f"{base}.rotation_years", "exceed=0.7", "10:40")
    expect_equal((found["found"], found["over"], found["side"]), (True, "rotation", "smallest"))
    for years, passes in ((found["value"], True), (found["value"] - 1, False)):
        option = result("--years", "-n", 400, "-s", f"{base}.rotation_years={years}", "--option", "simple coppice", "rotation")["options"][0]
        expect_equal(len(option["years"]), years, "years of the rotation")
        expect_equal(option["rotation"]["exceed_probability"]["mean"] <= 0.7, passes, f"{years} years")
        if passes:
            expect_near(option["rotation"]["exceed_probability"]["mean"], found["goal_at_value"], 1e-12)
            for key in ("cut_m3_ha_per_year", "standing_m3_ha_mean", "died_m3_ha_per_year"):
                expect_near(found["yield"][key], option["yield"][key], 1e-12, key)
    stay = find(f"{base}.stay_per_ha[0]", "exceed=0.6", "0:400")
    expect_equal((stay["over"], stay["value"] == int(stay["value"])), ("rotation", True), stay)
    option = result("--years", "-n", 400, "-s", f"{base}.stay_per_ha[0]={stay['value']}", "--option", "simple coppice", "rotation")["options"][0]
    expect_near(option["rotation"]["exceed_probability"]["mean"], stay["goal_at_value"], 1e-12)
    expect_near(stay["yield"]["cut_m3_ha_per_year"], option["yield"]["cut_m3_ha_per_year"], 1e-12)
    text = good("--find", f"{base}.rotation_years=10:40", "--goal", "exceed=0.7", "-n", 400, "--option", "simple coppice", "rotation").out
    expect_in("in the mean of the years ahead", text)
    expect_in(f"yield: {found['yield']['cut_m3_ha_per_year']:.3g} m", text)


def test_find_today():
    """--find: other parameters are searched today, with --years over the coming years"""
    stools = "options[0].forest[0].stand.stools.per_ha"
    today, years = (find(stools, "exceed=0.3", "1000:5000", *more) for more in ((), ("--years",)))
    expect_equal((today["over"], years["over"]), ("today", "rotation"))
    expect(today["goal_at_value"] != years["goal_at_nearest" if not years["found"] else "goal_at_value"], today, years)


if __name__ == "__main__":
    run_all(__name__)
