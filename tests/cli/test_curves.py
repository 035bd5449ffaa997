#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Shipped stands lie on their own curves: a grown stand is a freshly cut stand some years later, in closed form and by the
program."""
import math
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import PROFILES, Folder, expect, expect_equal, expect_in, expect_near, good, result, run_all  # noqa: E402
from pages import WHOLE
from test_years import belt, coppice, site  # noqa: E402
from test_yield import density_index, size  # noqa: E402

STANDS = PROFILES / "stands"
SPECIES = ("beech", "chestnut", "manna-ash", "oak-downy", "oak-turkey")
# a grown stand, the freshly cut stand, and the years between them
PAIRS = {"simple-coppice": ("simple-coppice-cut", 25), "simple-coppice-5y": ("simple-coppice-cut", 5),
         "coppice-with-standards": ("coppice-with-standards-cut", 25),
         "coppice-with-standards-in-groups": ("coppice-with-standards-in-groups-cut", 25),
         "large-reserves": ("large-reserves-cut", 25), "selection-coppice": ("selection-coppice-cut", 13)}


# ---- reading ----


def read_sections(name):
    """Return the blocks of a stand's file, its base's first."""
    text = (STANDS / f"{name}.yaml").read_text(encoding="utf-8")
    base = re.search(r"^base: (\S+)\.yaml$", text, re.M)
    blocks = read_sections(base[1]) if base else {}
    for key, block in re.findall(r"^(\w+):\n((?:  .*\n)+)", text, re.M):
        blocks[key] = (blocks.get(key, "") if key in ("stools", "growth", "cutting") else "") + block
    return blocks


def number(block, key, default=None):
    """Return the last of a key's numbers, because a file overrides its base."""
    found = re.findall(rf"\b{key}: ([0-9.]+)", block)
    return float(found[-1]) if found else default


def parse_stems(blocks, key):
    """Return each kind of stems: number per stool or hectare, dbh, height, age."""
    items = re.split(r"(?m)^  - ", blocks.get(key, ""))[1:]
    return [[number(i, "per_stool" if key == "shoots" else "per_ha"), number(i, "dbh_m"), number(i, "height_m"), number(i, "age_y")]
            for i in items]


def parse_curve(blocks, kind):
    curve = re.findall(rf"{kind}: {{(.*?)}}", blocks["growth"])[-1]
    return [number(curve, key) for key in ("dbh_most_m", "dbh_rate_1_y", "height_most_m", "height_rate_1_y")]


# ---- closed forms ----


def grown(stem, curve, years, age=None):
    """Return dbh and height some years later, proportional to the curve, from the age of the dbh if none is given."""
    _, dbh, height, _ = stem
    age = age or -math.log(1 - dbh / curve[0]) / curve[1]
    (d0, h0), (d1, h1) = size(curve, age), size(curve, age + years)
    return dbh * d1 / d0, height * h1 / h0


def compute_year(blocks, years, trees):
    """Return stools, shoots per stool with dbh and height, and trees, n years after the cut that left these trees and cohorts."""
    growth, cohorts = blocks["growth"], int(number(blocks["cutting"], "cohorts", 1))
    young, old, curve = number(growth, "shoots_young"), number(growth, "shoots_old"), parse_curve(blocks, "shoots")

    def on_stool(age):
        return old + (young - old) * math.exp(-age / 5)

    trees = [(n, *grown((n, d, h, None), parse_curve(blocks, "trees"), years)) for n, d, h in trees]
    stools = number(blocks["stools"], "per_ha")
    shoots = [(stools * on_stool(years) / cohorts, *size(curve, years))]
    for stem in parse_stems(blocks, "shoots"):
        shoots.append((stools * stem[0] * on_stool(stem[3] + years) / on_stool(stem[3]), *grown(stem, curve, years, stem[3])))
    most = number(growth, "sdi_most") * (1 - density_index(trees) / number(growth, "trees_sdi_most"))
    share = min(1, most / density_index(shoots))
    left = share * sum(n for n, _, _ in shoots)
    stools = min(stools, left)
    return stools, [(share * n / stools, d, h) for n, d, h in shoots], trees


def expect_state(name, stools, shoots, trees):
    blocks = read_sections(name)
    expect_near(number(blocks["stools"], "per_ha"), stools, 0.5, f"{name}: stools")
    for what, stated, computed in (("shoots", parse_stems(blocks, "shoots"), shoots), ("trees", parse_stems(blocks, "trees"), trees)):
        expect_equal(len(stated), len(computed), f"{name}: kinds of {what}")
        for a, b in zip(stated, computed):
            for x, y, grain in zip(a, b, (0.001, 0.0001, 0.01)):
                expect_near(x, y, 0.51 * grain, f"{name}: {what} {a}, by the curves {b}")


def test_pairs():
    """A grown stand of hop hornbeam is the freshly cut one 25 (5, 13) years later, by the closed forms of growth"""
    for name, (cut, years) in PAIRS.items():
        blocks = read_sections(cut)
        expect_state(name, *compute_year(blocks, years, [t[:3] for t in parse_stems(blocks, "trees")]))
        for key in ("growth", "cutting"):
            expect_equal(read_sections(name)[key], blocks[key], f"{name} and {cut}: {key}")


def test_species():
    """Stands of other species are a rotation after a cut that left hop hornbeam's diameters (chestnut has its own)"""
    for species in SPECIES:
        for system in ("simple-coppice", "coppice-with-standards", "large-reserves", "selection-coppice"):
            name = f"{species}-{system}"
            blocks, ages = read_sections(name), [s[3] for s in parse_stems(read_sections(name), "shoots")]
            rotation = number(blocks["cutting"], "rotation_years")
            expect_equal(ages, [rotation * (i + 1) for i in range(len(ages))], f"{name}: ages of the shoots")
            left = [t[:3] for t in parse_stems(read_sections(f"{system}-cut"), "trees")]
            if name == "chestnut-coppice-with-standards":
                left = [[47, 0.15, 12], [23, 0.25, 15]]
            elif system == "simple-coppice":
                left[0][0] = parse_stems(blocks, "trees")[0][0]
            curve, old, young = (parse_curve(blocks, "shoots"), number(blocks["growth"], "shoots_old"),
                                 number(blocks["growth"], "shoots_young"))
            there = []  # the older cohorts just after that cut
            for i in range(1, len(ages)):
                share = (old + (young - old) * math.exp(-rotation * i / 5)) / len(ages)
                there.append("  - per_stool: {}\n    dbh_m: {}\n    height_m: {}\n    age_y: {}\n".format(
                    share, *size(curve, rotation * i), rotation * i))
            at_cut = re.findall(r"; (\d+) at the cut", blocks["stools"].split("per_ha:")[-1])
            stools = at_cut[-1] if at_cut else number(blocks["stools"], "per_ha")
            expect_state(name, *compute_year({**blocks, "shoots": "".join(there), "stools": f"per_ha: {stools}"}, rotation, left))


def test_program():
    """--years: a freshly cut stand without cuts becomes the shipped grown stand in that year"""
    for name, (cut, years) in PAIRS.items():
        with Folder() as f:
            scene = f.write("s.yaml", site(options=[("cut", [belt(0, 135, cut, cut_year=1000)]), ("grown", [belt(0, 135, name)])]))
            options = result("--years", f"{years}:{years}", "-n", 2, scene)["options"]
        later, now = options[0]["years"][0]["stands"][0], options[1]["stands"][0]
        for key, grain in (("stools_per_ha", 5e-4), ("stems_per_ha", 1e-3), ("trees_per_ha", 0), ("basal_area_m2_ha", 4e-3)):
            expect_near(later[key], now[key], grain * now[key] + 1e-9, f"{name}: {key}")


def test_warning():
    """Stems more than a fifth of their basal area off their own curve get a sentence, on the page and in JSON"""
    def warnings(cut_year=None, **stand):
        with Folder() as f:
            place = belt(0, 135, coppice(**stand), **({} if cut_year is None else {"cut_year": cut_year}))
            scene = f.write("s.yaml", site(place))
            found = [w for w in result("-n", 2, scene)["options"][0]["stands"][0]["warnings"] if "own growth" in w]
            page = " ".join(good(*WHOLE, "-n", 2, scene).out.split())
            for sentence in found:
                expect_in(sentence.split(": ", 1)[1].replace("m2", "m²"), page)
            expect_equal("own growth" in page, bool(found), "page and JSON")
        return found

    def shoots(dbh, age=None):
        return [{"per_ha": 7500, "dbh_m": dbh, "height_m": 6, **({} if age is None else {"age_y": age})}]

    curve = 0.16 * (1 - math.exp(-0.022 * 25))
    for factor, warned in ((0.8, True), (0.89, True), (0.9, False), (1, False), (1.095, False), (1.1, True)):
        found = warnings(shoots=shoots(factor * curve, 25))
        expect_equal(len(found), warned, f"{factor} times the diameter of the curve")
        if warned:
            area = 7500 * math.pi / 4 * curve**2
            expect_in(f": the shoots of 25 years have {factor**2 * area:.1f} m2/ha of basal area. "
                      f"The stand's own growth gives {area:.1f} at that age", found[0])
    thick = shoots(2 * curve)
    expect_equal(warnings(shoots=thick), [], "no age is known")
    expect_equal(warnings(shoots=shoots(2 * curve, 25), growth=None, cutting=None), [], "no curve is known")
    expect_in("the shoots of 5 years have", warnings(-5, shoots=thick)[0])
    expect_equal(warnings(5, shoots=thick), [], "a cut to come says nothing of the age")
    trees = [{"per_ha": 60, "dbh_m": 0.2, "height_m": 12, "age_y": 25}]
    expect_in("the trees of 25 years have 1.9 m2/ha of basal area. The stand's own growth gives "
              f"{60 * math.pi / 4 * (0.45 * (1 - math.exp(-0.35)))**2:.1f} at that age", warnings(trees=trees)[0])
    for path in sorted(STANDS.glob("*.yaml")):
        with Folder() as f:
            found = result("-n", 2, f.write("s.yaml", site(belt(0, 135, path.stem))))["options"][0]["stands"][0]["warnings"]
        expect(not any("own growth" in w for w in found), f"{path.stem}: {found}")


if __name__ == "__main__":
    run_all(__name__)
