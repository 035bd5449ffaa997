#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""blocks: frequency and energy. Closed forms of a free fall, weights and natural frequencies, classes, errors."""
import csv
import io
import json
import math
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import (DONE, FULL, INPUT, Folder, ceduo, expect, expect_equal, expect_in, expect_near, good,  # noqa: E402
                     run_all, scene, stand)
from pages import WHOLE, expect_width

DENSITY = 2600
CLIFF = {"vertices_m": [[0, 100], [1, 0], [60, 0]], "segments": [{"rn": 0, "rt": 0}]}
# released at 10 m/s, 2 s of free fall to x = 20: energy per kg
FALL = 9.81 * (9.81 * 2 ** 2 / 2) + 10 ** 2 / 2
WOOD = {"from_m": 0, "to_m": 140, "stand": stand()}
POWER = {"per_year": 4, "volume_m3": [0.01, 10], "exponent": 1.2}


def falls(blocks, **changes):
    """Every block passes the control in free flight, with FALL per kg."""
    return scene(**{"rock": {"diameter_m": 1, "density_kg_m3": DENSITY}, "blocks": blocks, "release": {"vx_m_s": 10},
                    "slope": CLIFF, "controls": [{"x_m": 20, "name": "road", "accepted_kJ": 500}], "forest": [],
                    "simulation": {"rocks": 65536}, **changes})


def slope_site(**changes):
    """Rocks jump and roll down 150 m through a coppice."""
    return scene(**{"rock": {"diameter_m": 1, "density_kg_m3": DENSITY}, "blocks": POWER,
                    "release": {"vx_m_s": 1, "height_m": 2},
                    "slope": {"vertices_m": [[0, 100], [150, 0], [200, 0]],
                              "segments": [{"rn": 0.35, "rt": 0.88, "roughness_rad": 0.25}]},
                    "controls": [{"x_m": 80, "accepted_kJ": 30}, {"x_m": 140, "name": "road", "accepted_kJ": 50}],
                    "forest": [WOOD], "simulation": {"rocks": 2000}, **changes})


def run(what, *arguments):
    with Folder() as f:
        return good("--batch", "-f", "json", "--details", *arguments, f.write("s.yaml", what)).json()[0]


def page(what):
    with Folder() as f:
        return good("--batch", "--details", "-n", 100, f.write("s.yaml", what)).out


def find_hazard(result, side="bare", control=-1, option=0):
    return result["options"][option]["controls"][control][side]["hazard"]


def number_above(blocks, volume):
    """Return the blocks per year above a size, by the power law of a class."""
    lo, hi = blocks["volume_m3"]
    b, v = blocks.get("exponent", 0), min(max(volume, lo), hi)
    if b == 0:
        return blocks["per_year"] * math.log(hi / v) / math.log(hi / lo)
    return blocks["per_year"] * (v ** -b - hi ** -b) / (lo ** -b - hi ** -b)


def rate_above(classes, energy_kJ):
    return sum(number_above(c, energy_kJ * 1000 / (DENSITY * FALL)) for c in classes)


def check_power_law(classes, hazard):
    total = sum(c["per_year"] for c in classes)
    expect_near(hazard["per_year"], total, 1e-12 * total)
    expect_near(hazard["reach_per_year"], total, 1e-9 * total, "all of them arrive")
    for point in hazard["exceed_rate"]:
        exact = rate_above(classes, point["energy_kJ"])
        expect(point["lo"] <= exact <= point["hi"], point, exact)
        expect_near(point["per_year"], exact, 0.004 * exact + 1e-4 * total, f"rate above {point['energy_kJ']} kJ")
    for back in hazard["return"]:
        if back["energy_kJ"] is not None:
            expect_near(rate_above(classes, back["energy_kJ"]), 1 / back["years"], 0.01 / back["years"], back)
            expect(rate_above(classes, back["lo"]) >= 1 / back["years"], back)
            expect(back["hi"] is None or rate_above(classes, back["hi"]) <= 1 / back["years"], back)


def test_curve_at_the_frame():
    """The curve leaves its picture at less than once in 1000 years, between two energies of the table"""
    with Folder() as f:
        path = f.write("s.yaml", falls(POWER))
        rows = find_hazard(good("--batch", "-f", "json", "--details", "-n", 2000, path).json()[0])["exceed_rate"]
        page = good("--report", "-", "-n", 2000, path).out
    (ax, ay), (bx, by) = next(((math.log10(a["energy_kJ"]), math.log10(a["per_year"])), (math.log10(b["energy_kJ"]), math.log10(b["per_year"])))
                              for a, b in zip(rows, rows[1:]) if a["per_year"] > 1e-3 >= b["per_year"] > 0)
    energy = ax + (bx - ax) * (ay + 3) / (ay - by)
    picture = re.search(r'<svg[^>]*aria-label="How often, and with how much.*?</svg>', page, re.S).group()
    rules = re.search(r' d="([^"]*)" stroke-dasharray', picture).group(1)
    x30, x300 = (float(x) for x in re.findall(r"M([\d.]+) [\d.]+L\1 ", rules))
    y30, y100, y300 = (float(y) for y in re.findall(r"M[\d.]+ ([\d.]+)L[\d.]+ \1(?![\d.])", rules))
    ends = [tuple(map(float, end)) for end in re.findall(r'd="M[^"]*L([\d.]+) ([\d.]+)"/>', picture)[:2]]
    expect(ax + 0.02 < energy < bx - 0.02 and y30 < y100 < y300, energy, ax, bx)
    for x, y in ends:  # equal with and without forest
        expect_near((x - x30) / (x300 - x30) + math.log10(30), energy, 0.005)
        expect_near(y, y100 + (y300 - y30), 0.5)  # from 100 to 1000 years as from 30 to 300


def test_power_law():
    """In a free fall the curve is the power law of the sizes, for any exponent and number of classes"""
    for classes in ([POWER], [{**POWER, "exponent": 0}], [{**POWER, "exponent": 0.5}, {"per_year": 0.02, "volume_m3": [20, 30]}],
                    [{"per_year": 0.2, "volume_m3": [1, 3]}, {"per_year": 7, "volume_m3": [0.02, 0.5], "exponent": 2}]):
        result = run(falls(classes[0] if len(classes) == 1 else classes))
        check_power_law(classes, find_hazard(result))
        check_power_law(classes, find_hazard(result, "wooded"))


def test_effective_rocks():
    """The effective number of log-uniform volumes with weights v^-b is (mean of weights)² / mean of squares, with any forest"""
    (lo, hi), b = POWER["volume_m3"], POWER["exponent"]
    length = math.log(hi / lo)
    mean, square = ((lo ** -k - hi ** -k) / (k * length) for k in (b, 2 * b))
    result = run(falls(POWER), "-n", 20000)
    for side in ("bare", "wooded"):
        expect_near(find_hazard(result, side)["effective_rocks"] / 20000, mean * mean / square, 1e-3 * mean * mean / square, side)


def test_accepted_return():
    """The default return period is 100 years, if an energy is accepted and blocks fall"""
    assumed = "a rock above the accepted energy may come once in 100 years"
    place = {"x_m": 20, "accepted_kJ": 500}
    said = [assumed in " ".join(page(falls(POWER, controls=controls)).split())
            for controls in ([place], [{**place, "accepted_return_y": 30}], [{"x_m": 20}])]
    expect_equal(said, [True, False, False])
    rocks = falls(POWER, controls=[place])
    del rocks["blocks"]
    expect(assumed not in " ".join(page(rocks).split()))


def mean_volume(classes):
    """Volume above which a share u of the blocks of all classes lies, at the centres of many equal shares"""
    shares = [(k + 0.5) / 200000 for k in range(200000)]

    def above(c, u):
        lo, hi = c["volume_m3"]
        b = c.get("exponent", 0)
        return lo * (hi / lo) ** (1 - u) if b == 0 else (hi ** -b + u * (lo ** -b - hi ** -b)) ** (-1 / b)
    return sum(c["per_year"] * math.fsum(above(c, u) for u in shares) / len(shares) for c in classes) / sum(c["per_year"] for c in classes)


def test_no_size():
    """With blocks the rock needs no size: rates and energies do not depend on it, and single-rock figures use the mean block"""
    for classes in ([POWER], [{**POWER, "exponent": 0}, {"per_year": 0.02, "volume_m3": [20, 30], "exponent": 1}]):
        result = run(falls(classes, rock={"density_kg_m3": DENSITY}))
        check_power_law(classes, find_hazard(result))
        expect_near(result["rock"]["mass_kg"] / DENSITY / mean_volume(classes), 1, 1e-4)
    sizes = "", ", diameter_m: 0.3, height_m: 0.3", ", diameter_m: 2, height_m: 2"
    found = [good("--batch", "-f", "json", "-n", 500, "-s", f"rock={{shape: cylinder, density_kg_m3: 2600{size}}}",
                  "blocks-above-the-road").json()[0] for size in sizes]
    for other in found[1:]:
        for a, b in zip(found[0]["options"], other["options"]):
            for side in ("bare", "wooded"):
                p, q = a["controls"][0][side], b["controls"][0][side]
                expect_equal(p["reach_probability"], q["reach_probability"])
                expect_near(p["energy_kJ"]["mean"], q["energy_kJ"]["mean"], 1e-9 * q["energy_kJ"]["mean"])
                expect_near(p["hazard"]["exceed_per_year"], q["hazard"]["exceed_per_year"], 1e-9)
    one = run(falls([POWER], rock={"density_kg_m3": DENSITY}, forest=[WOOD | {"to_m": 19}]))
    same = run(falls([POWER], rock={"density_kg_m3": DENSITY, "mass_kg": one["rock"]["mass_kg"]}, forest=[WOOD | {"to_m": 19}]))
    for a, b in ((one, same),):
        expect_near(a["options"][0]["summary"]["adc_m"], b["options"][0]["summary"]["adc_m"], 1e-9)


def test_no_size_in_all_modes():
    """Page, report, uncertainty and search accept a scene without a rock size; equal dimensions are an assumption"""
    with Folder() as f:
        f.write("s.yaml", slope_site(rock={"shape": "block"}, simulation={"rocks": 100}))
        for words in (("--check",), ("--batch",), ("--report", "page.html"), ("--sensitivity=64", "-f", "json"),
                      ("--find", "forest[0].stand.stools.per_ha=100:5000", "--goal", "arrive=0.5")):
            done = good(*words, "s.yaml", cwd=f.path)
            expect("nan" not in done.out.lower(), done)
        expect("NaN" not in (f.path / "page.html").read_text())
        page = " ".join(good(*WHOLE, "s.yaml", cwd=f.path).out.split())
        expect_in("all dimensions of a block are equal", page)
        for shape in ("ellipsoid", "cylinder"):
            expect_in("all dimensions of a block are equal", " ".join(good(*WHOLE, "-s", f"rock.shape={shape}", "s.yaml", cwd=f.path).out.split()))
        expect_in("100 rocks of many sizes", " ".join(good("--batch", "s.yaml", cwd=f.path).out.split()))


def test_figures_agree():
    """Matrix, accepted energy and shares agree with the curve"""
    result = run(falls(POWER))
    hazard, bare = find_hazard(result), result["options"][0]["controls"][0]["bare"]
    exact = rate_above([POWER], 500)
    expect_near(hazard["exceed_per_year"], exact, 0.004 * exact)
    expect_near(hazard["accepted_years"], 1 / hazard["exceed_per_year"], 1e-9)
    expect(hazard["accepted_years_lo"] < hazard["accepted_years"] < hazard["accepted_years_hi"], hazard)
    expect_near(bare["exceed_probability"] * POWER["per_year"], hazard["exceed_per_year"], 1e-9)
    limits = [0, 30, 300, math.inf]
    for i, row in enumerate(hazard["matrix"]):
        within = rate_above([POWER], limits[i]) - (rate_above([POWER], limits[i + 1]) if i < 2 else 0)
        expect_near(row["per_year"], within, 0.01 * within, row)
        expect_equal((row["from_kJ"], row["to_kJ"], row["rate_left"]), (limits[i], limits[i + 1] if i < 2 else None, 1))
        for back in hazard["return"][1:]:
            expect_equal(row[f"to_{back['years']}_years"], limits[i] <= back["energy_kJ"] < limits[i + 1], row)
    mean = sum(0.5 * (a + b) * (number_above(POWER, a) - number_above(POWER, b)) for a, b in
               ((0.01 * 1000 ** (k / 9000), 0.01 * 1000 ** ((k + 1) / 9000)) for k in range(9000))) / POWER["per_year"]
    expect_near(bare["energy_kJ"]["mean"], mean * DENSITY * FALL / 1000, 0.01 * mean * DENSITY * FALL / 1000)
    median = next(v for v in (0.01 * 1000 ** (k / 9000) for k in range(9000)) if number_above(POWER, v) <= 2)
    expect_near(bare["energy_kJ"]["p50"], median * DENSITY * FALL / 1000, 0.01 * median * DENSITY * FALL / 1000)
    expect(bare["energy_kJ"]["p50_lo"] <= bare["energy_kJ"]["p50"] <= bare["energy_kJ"]["p50_hi"], bare)
    expect_near(bare["speed_m_s"]["p99"], math.sqrt(2 * FALL), 1e-9)
    expect_equal(bare["reach_probability"], 1)


def test_split():
    """Two classes equal one class that is split, each with its share of the blocks"""
    above = number_above(POWER, 0.5)
    two = [{**POWER, "volume_m3": [0.01, 0.5], "per_year": POWER["per_year"] - above},
           {**POWER, "volume_m3": [0.5, 10], "per_year": above}]
    a, b = (find_hazard(run(slope_site(blocks=what)), "wooded") for what in (POWER, two))
    for p, q in zip(a["exceed_rate"], b["exceed_rate"]):
        for key in ("per_year", "lo", "hi"):
            expect_near(p[key], q[key], 1e-9 * p["hi"], f"{key} of {p['energy_kJ']}")


def test_brute_force():
    """Weights give the rates of naturally frequent blocks, with 20 times fewer rocks at 300 years"""
    site = slope_site(simulation={"rocks": 4000 if FULL else 1000, "seed": 5})
    weighted = find_hazard(run(site), "wooded")
    # natural frequencies: classes so thin that sizes within one are equally likely, each with its own run and number of rocks
    counts = {k["energy_kJ"]: 0 for k in weighted["exceed_rate"]}
    rocks, cells = (400000 if FULL else 40000), 24
    edges = [0.01 * 1000 ** (k / cells) for k in range(cells + 1)]
    total = 0
    for lo, hi in zip(edges, edges[1:]):
        share = (number_above(POWER, lo) - number_above(POWER, hi)) / POWER["per_year"]
        n = max(1, round(share * rocks))
        thin = {"per_year": POWER["per_year"] * share, "volume_m3": [lo, hi], "exponent": POWER["exponent"]}
        found = find_hazard(run(slope_site(blocks=thin, simulation={"rocks": n, "seed": 6})), "wooded")
        total += n
        for point in found["exceed_rate"]:
            counts[point["energy_kJ"]] = counts.get(point["energy_kJ"], 0) + point["per_year"] / thin["per_year"] * n
    for point in weighted["exceed_rate"]:
        hits = counts[point["energy_kJ"]]
        rate = hits / total * POWER["per_year"]
        se = math.hypot(math.sqrt(max(hits, 1)) / total * POWER["per_year"], (point["hi"] - point["lo"]) / 3.92)
        expect(abs(rate - point["per_year"]) <= 4 * se, point, rate, se)
    back = weighted["return"][3]
    exceed = [p for p in weighted["exceed_rate"] if p["energy_kJ"] <= back["energy_kJ"]][-1]
    relative = (exceed["hi"] - exceed["lo"]) / 3.92 / exceed["per_year"]
    rocks_as_they_come = POWER["per_year"] / exceed["per_year"] / relative ** 2  # binomial, for a rare event
    expect(rocks_as_they_come > 20 * site["simulation"]["rocks"], "rocks for the same error", rocks_as_they_come)


def test_curves():
    """Curves only fall, lie within their intervals, and the forest's curve exceeds the bare slope's at most by errors"""
    result = run(slope_site())
    for control in range(2):
        bare, wooded = (find_hazard(result, side, control)["exceed_rate"] for side in ("bare", "wooded"))
        for curve in (bare, wooded):
            for p, q in zip(curve, curve[1:]):
                expect(p["per_year"] >= q["per_year"] and p["energy_kJ"] < q["energy_kJ"], p, q)
            expect(all(p["lo"] <= p["per_year"] <= p["hi"] for p in curve), curve)
            expect(curve[-1]["per_year"] == 0 and curve[-2]["per_year"] > 0, curve[-2:])
        for p, q in zip(bare, wooded):
            expect(q["lo"] <= p["hi"], p, q)
        left = find_hazard(result, "wooded", control)["rate_left"]
        rates = [find_hazard(result, side, control)["exceed_per_year"] for side in ("wooded", "bare")]
        expect_near(left, rates[0] / rates[1], 1e-12)


def test_none():
    """Without blocks there is no hazard; with the index none with forest; without arrivals the rates are 0"""
    result = run(slope_site(blocks=None))
    expect_equal((find_hazard(result), find_hazard(result, "wooded")), (None, None))
    result = run(slope_site(simulation={"rocks": 50, "contact_model": "index"}))
    expect(find_hazard(result)["per_year"] == 4 and result["options"][0]["controls"][1]["wooded"] is None, result)
    stuck = run(falls(POWER, controls=[{"x_m": 55}], simulation={"rocks": 500}))
    hazard = find_hazard(stuck)
    expect_equal((hazard["reach_per_year"], hazard["reach_years"], hazard["accepted_years"], hazard["rate_left"]),
                 (0, None, None, None))
    expect_equal(hazard["exceed_rate"][0]["per_year"], 0)
    expect(0 < hazard["exceed_rate"][0]["hi"] < 4, hazard)
    expect(all(back[key] is None for back in hazard["return"] for key in ("energy_kJ", "lo", "hi")), hazard)


def test_same_bits():
    """Threads, kernels and steps do not change a bit"""
    with Folder() as f:
        path = f.write("s.yaml", slope_site(simulation={"rocks": 5000}, options=[
            {"name": "a", "forest": []}, {"name": "b", "forest": [WOOD]}], forest=None))
        one = good("--batch", "-f", "json", "-j", 1, path).json()[0]
        two = good("--batch", "-f", "json", "-j", 3, path).json()[0]
        for r in (one, two):
            r.pop("work")
        expect_equal(json.dumps(two), json.dumps(one))


def test_error_bars():
    """The 95 % intervals contain the result of very many rocks for at least 90 % of 60 seeds"""
    site = slope_site(simulation={"rocks": 200})
    best = find_hazard(run(slope_site(), "-n", 60000), "wooded")
    held = {"accepted": 0, "return": 0}
    for seed in range(60):
        h = find_hazard(run(site, "--seed", 100 + seed), "wooded")
        low, high = h["accepted_years_lo"], h["accepted_years_hi"]
        held["accepted"] += low <= best["accepted_years"] and (high is None or best["accepted_years"] <= high)
        low, high = h["return"][2]["lo"], h["return"][2]["hi"]
        held["return"] += (low or 0) <= best["return"][2]["energy_kJ"] <= (high or math.inf)
    expect(min(held.values()) >= 54, held)


def test_csv():
    """CSV has all figures except curves, in separate columns"""
    with Folder() as f:
        path = f.write("s.yaml", slope_site())
        row = list(csv.DictReader(io.StringIO(good("--batch", "-f", "csv", path).out)))[1]
        hazard = find_hazard(good("--batch", "-f", "json", path).json()[0], "wooded")
        for key, value in {"accepted_years": hazard["accepted_years"], "return[3].energy_kJ": hazard["return"][3]["energy_kJ"],
                           "matrix[2].per_year": hazard["matrix"][2]["per_year"], "rate_left": hazard["rate_left"]}.items():
            expect_equal(float(row[f"wooded.hazard.{key}"]), value, key)
        expect(not any("exceed_rate" in key for key in row), list(row))
        without = next(csv.DictReader(io.StringIO(good("--batch", "-f", "csv", f.write("t.yaml", slope_site(blocks=None))).out)))
        expect_equal({v for k, v in without.items() if ".hazard." in k}, {""})


def test_page():
    """The page gives the frequency in words, with the figures of JSON, and places each option in the matrix"""
    def shown(value):
        return f"{value:.{max(0, 1 - math.floor(math.log10(value)))}f}"

    options = [{"name": "none", "forest": []}, {"name": "coppice", "forest": [WOOD]}]
    with Folder() as f:
        path = f.write("s.yaml", slope_site(forest=None, options=options))
        page = " ".join(good(*WHOLE, path).out.split())
        result = good("--batch", "-f", "json", path).json()[0]
        bare, wooded = find_hazard(result), find_hazard(result, "wooded", -1, 1)
        years = [f"{shown(h['accepted_years'])} ({shown(h['accepted_years_lo'])}–{shown(h['accepted_years_hi'])})"
                 for h in (bare, wooded)]
        expect(re.search(rf"return period of such a rock, years {re.escape(years[0])} ", page), years, page)
        expect(re.search(rf"return period of such a rock, years {re.escape(years[1])} ", page), years, page)
        expect_in("Rock sphere; sizes as in Blocks; index for a rock of ", page)
        left = " ".join(shown(100 * m["rate_left"]) for m in wooded["matrix"])
        expect_in(f"coppice {years[1]} {left} without forest {years[0]} 100 100 100 Energy reached or exceeded", page)
        square = page.split("Intensity by return period")[2]
        marks = {word: [[] for _ in range(3)] for word in ("none", "weak", "medium", "strong")}
        for number, h in enumerate((bare, find_hazard(result, "wooded", -1, 0), wooded)):
            for column, back in enumerate(h["return"][1:]):
                classes = [m["intensity"] for m in h["matrix"] if m[f"to_{back['years']}_years"]]
                expect_equal(len(classes), int(back["energy_kJ"] is not None), back)
                marks[classes[0] if classes else "none"][column].append(str(number))
        for word, head in (("strong", "strong, above 300 kJ"), ("medium", "medium, 30 to 300 kJ"),
                           ("weak", "weak, below 30 kJ"), ("none", "none arrives")):
            cells = " ".join(" ".join(cell) or "·" for cell in marks[word])
            expect_in(f"{head} {cells} ", square)
        expect_in("0 without forest, 1 none, 2 coppice.", square)
        bare = result["options"][0]["controls"][1]["bare"]
        expect_in(f"without, {bare['rocks_reached']} of 2000 50 % 95 % 99 % speed, m/s {bare['speed_m_s']['p50']:.1f} "
                  f"({bare['speed_m_s']['p50_lo']:.1f}–{bare['speed_m_s']['p50_hi']:.1f})", page)
        alone = " ".join(good(*WHOLE, f.write("t.yaml", slope_site(controls=[{"x_m": 140}]))).out.split())
        expect_in("return period of such a rock, years", alone)
        stuck = " ".join(good(*WHOLE, f.write("u.yaml", falls(POWER, controls=[{"x_m": 55}]))).out.split())
        expect_in("return period of such a rock, years > ", stuck)
        few = " ".join(good(*WHOLE, f.write("w.yaml", slope_site(blocks={"per_year": 4, "volume_m3": [0.001, 0.002], "exponent": 1},
                                                                      controls=[{"x_m": 140, "accepted_kJ": 1}]))).out.split())
        expect(re.search(r"current > \d+ 0(\.\d)? none none ", few), "intensities that do not arrive", few)
        expect(" - %" not in few and "- %" not in stuck, "a share of none", few, stuck)
        index = " ".join(good(*WHOLE, "-s", "simulation.contact_model=index", path).out.split())
        expect_in(f"return period of such a rock, years {years[0]} ", index)
        without = good(*WHOLE, f.write("v.yaml", slope_site(blocks=None))).out
        expect("How often" not in without and "Blocks   " not in without, without)


def test_wide_figures():
    """Figures of eight digits and their intervals are separated by a blank, in 80 columns"""
    options = [{"name": name, "forest": [{**WOOD, "to_m": to}]} for name, to in (("half", 70), ("whole", 140), ("third", 50))]
    blocks = [{"per_year": 1, "volume_m3": [400, 80000], "exponent": 1}]
    rare = [{"per_year": 1e-7, "volume_m3": [0.5, 1], "exponent": 1}]
    with Folder() as f:
        text = good(*WHOLE, f.write("s.yaml", slope_site(blocks=blocks))).out
        result = good("--batch", "-f", "json", f.path / "s.yaml").json()[0]
        row = re.findall(r"\n  without forest  .*", text)[-1]
        expect(len(row) <= 81 and "\u2026" not in row, row)
        found = re.findall(r"(\d\.\d) \(([\d.]+)\u2013([\d.]+)\)e(\d)", row)
        expect_equal(len(found), 3, row)
        for (value, lo, hi, power), back in zip(found, find_hazard(result)["return"][1:]):
            for shown, key in ((value, "energy_kJ"), (lo, "lo"), (hi, "hi")):
                wanted = back[key] / 10 ** int(power)
                expect_near(float(shown), wanted, 0.05 * (1 + 1e-9) if wanted < 10 else 0.5, key)
        text = good(*WHOLE, f.write("t.yaml", slope_site(forest=None, options=options, blocks=rare, controls=[{"x_m": 140}]))).out
        rows = re.findall(r"\n  (?:without forest|half|whole|third) +\d{8} \(\d{8}\u2013\d{8}\) +none +\d+ +\d+(?=\n)", text)
        expect_equal(len(rows), 4, text)
        expect_width(text)


def test_unknown_lower_end():
    """An energy exactly as rare as its return period has lower end 0 on the page, null in JSON"""
    seen = 0
    with Folder() as f:
        for per_year in (0.0035, 0.004, 0.005, 0.006, 0.007, 0.008):  # about half arrives with forest
            path = f.write("s.yaml", slope_site(blocks={"per_year": per_year, "volume_m3": [0.1, 0.2], "exponent": 1}, controls=[{"x_m": 140}]))
            rows = re.findall(r"\n  (?:without forest|current)  .*", good(*WHOLE, "-n", 300, path).out)
            result = good("--batch", "-f", "json", "-n", 300, path).json()[0]
            backs = [find_hazard(result, side)["return"][3] for side in ("bare", "wooded")]
            for row, back in zip(reversed(rows[-2:]), backs):
                if back["energy_kJ"] is not None and back["lo"] is None and back["hi"] is not None:
                    expect(re.search(r" [\d.]+ \(0\u2013[\d.]+\)$", row), row, back)
                    seen += 1
    expect(seen > 0, "no lower end is unknown")


def test_many():
    """More than two options become a table with the figures of JSON, which names the most protective one"""
    def shown(value):
        return f"{value:.{max(0, 1 - math.floor(math.log10(value)))}f}"

    options = [{"name": name, "forest": [{**WOOD, "to_m": to}]} for name, to in (("half", 70), ("whole", 140), ("third", 50))]
    with Folder() as f:
        path = f.write("s.yaml", slope_site(forest=None, options=options, controls=[{"x_m": 140, "accepted_kJ": 50}]))
        page = " ".join(good(*WHOLE, path).out.split())
        result = good("--batch", "-f", "json", path).json()[0]
        found = [find_hazard(result, "wooded", 0, i) for i in range(3)]
        best = min(range(3), key=lambda i: -found[i]["accepted_years"])
        expect_equal(best, 1)
        expect_in("'whole' lets the fewest dangerous rocks through", page)
        for option, h in zip(options, found):
            row = re.search(rf"strong .*?{option['name']} ([0-9.]+) \(([0-9.]+)–([0-9.]+)\) ([0-9.]+) ([0-9.]+) ([0-9.]+) ", page)
            expect(row, option, page)
            wanted = [h["accepted_years"], h["accepted_years_lo"], h["accepted_years_hi"]]
            wanted += [100 * m["rate_left"] for m in h["matrix"]]
            expect_equal(list(row.groups()), [shown(v) for v in wanted])
        expect_in("and rocks that arrive by intensity, in % of those without forest:", page)


def test_means():
    """The page explains a mean energy that is higher with forest, and only then"""
    said = "The mean energy is higher with forest because stems stop the slower and smaller rocks first."
    with Folder() as f:
        for what in (slope_site(), slope_site(blocks=None)):
            path = f.write("s.yaml", what)
            control = good("--batch", "-f", "json", path).json()[0]["options"][0]["controls"][1]
            page = " ".join(good(*WHOLE, path).out.split("At 140 m")[1].split("At 140 m")[0].split())
            wooded, bare = (control[side]["energy_kJ"] for side in ("wooded", "bare"))
            clear = wooded["mean"] - bare["mean"] > 1.96 * math.hypot(wooded["se"], bare["se"])
            expect_equal(said in page, clear, f"{wooded} {bare}")


def test_design():
    """Design values are 95th percentiles times named factors; the model's is 1.02 only for a fitted ground; heights are those of a
    fence"""
    slope = {"vertices_m": [[0, 100], [150, 0], [200, 0]], "segments": [{"rn": 0.35, "rt": 0.88, "roughness_rad": 0.25}]}
    fitted = {**slope, "segments": [{**slope["segments"][0], "source": {"kind": "calibrated", "text": "20 stops"}}]}
    with Folder() as f:
        for ground, survey, blocks in ((slope, "good", "poor"), (slope, "poor", "good"), (fitted, "good", "good")):
            what = slope_site(slope=ground, design={"survey": survey, "blocks": blocks})
            path = f.write("s.yaml", {k: v for k, v in what.items() if k != "blocks"})
            page = " ".join(good(*WHOLE, path).out.split())
            run_of = good("--batch", "-f", "json", path).json()[0]
            control, size = run_of["options"][0]["controls"][1], run_of["rock"]["mean_diameter_m"]
            design, steep = control["design"], 150 / math.hypot(150, 100) if control["x_m"] <= 150 else 1
            factor = {"good": 1.02, "poor": 1.10}
            model = 1.02 if ground is fitted else 1.10
            way = factor[survey] * model
            expect_equal(design["factors"], {"survey": factor[survey], "model": model, "blocks": factor[blocks], "gamma_e": None})
            for side, values in (("bare", design["bare"]), ("wooded", design["arrivals"])):
                expect_near(values["speed_m_s"], control[side]["speed_m_s"]["p95"] * way, 1e-9, side)
                expect_near(values["energy_kJ"], control[side]["translation_kJ"]["p95"] * way ** 2 * factor[blocks], 1e-9, side)
                clear = control[side]["height_m"]["p95"] * steep + size / 2
                expect_near(values["height_m"], max(clear + 0.5, clear + size / 2), 1e-9, side)
                expect_in(f"{values['speed_m_s']:.3g} {values['energy_kJ']:.3g} ", page)
            expect_in(f"Speed: times {factor[survey]:.2f} for the survey of the ground and {model:.2f} for the model, "
                      f"{'fitted to observations' if ground is fitted else 'not fitted here'}. Energy, of translation: times the "
                      f"square of both and {factor[blocks]:.2f} for the survey of the blocks.", page)
        expect("UNI 11211" not in good(*WHOLE, f.write("t.yaml", slope_site())).out, "design values unasked")
        r = ceduo("--check", f.write("u.yaml", slope_site(design={"survey": "good"})))
        expect_equal(r.status, INPUT, r)
        expect_in("'blocks' is missing", r.err)


def test_design_of_sizes():
    """Rolling blocks are as high as their size: uniform diameters of .3 to .7 m, and power-law volumes, each in closed form"""
    low, high, b = 0.02, 2, 1.1
    volume = (0.05 * (low**-b - high**-b) + high**-b) ** (-1 / b)  # 5 in 100 are larger
    ways = (({"rock": {"diameter_m": {"mean": 0.5, "spread": 0.2, "kind": "uniform"}}}, 0.3 + 0.95 * 0.4),
            ({"rock": {"diameter_m": 0.5}, "blocks": {"per_year": 1, "volume_m3": [low, high], "exponent": b}}, (6 * volume / math.pi) ** (1 / 3)))
    for what, size in ways:
        with Folder() as f:
            run_of = good("--batch", "-f", "json", f.write("s.yaml", scene(
                **what, release={"vx_m_s": 3}, slope={"vertices_m": [[0, 10], [100, 0]], "segments": [{"rn": 0, "rt": 1, "friction": 0}]},
                controls=[{"x_m": 50}], design={"survey": "good", "blocks": "good"}, simulation={"rocks": 20000}))).json()[0]
        expect_near(run_of["options"][0]["controls"][0]["design"]["bare"]["height_m"], max(size, size / 2 + 0.5), 0.01, what)


def test_years():
    """Over a rotation rates are means of the years' rates, and the error of the mean share covers other seeds"""
    curve = {"dbh_most_m": 0.3, "dbh_rate_1_y": 0.03, "height_most_m": 20, "height_rate_1_y": 0.05}
    grown = stand(growth={"shoots": curve, "trees": curve, "shoots_young": 9, "shoots_old": 2}, cutting={"rotation_years": 12, "stay_per_ha": [100]})
    classes = [{"per_year": 0.4, "volume_m3": [0.05, 0.5], "exponent": 1}, {"per_year": 0.1, "volume_m3": [0.5, 2], "exponent": 1}]
    site = slope_site(forest=[{"from_m": 0, "to_m": 140, "stand": grown}], simulation={"rocks": 300}, blocks=classes)
    means, errors = [], []
    for seed in range(12):
        option = run(site, "--years", "0:11", "--seed", seed + 1)["options"][0]
        rates = [y["controls"][1]["wooded"]["hazard"]["exceed_per_year"] for y in option["years"]]
        expect_near(option["rotation"]["exceed_per_year"], sum(rates) / 12, 1e-9, "rate over the rotation")
        worst = max(option["years"], key=lambda y: y["controls"][1]["wooded"]["hazard"]["exceed_per_year"])
        expect_equal(option["rotation"]["worst_year"], worst["year"])
        means.append(option["rotation"]["exceed_probability"]["mean"])
        errors.append(option["rotation"]["exceed_probability"]["se"])
    middle = sum(means) / 12
    spread = math.sqrt(sum((m - middle) ** 2 for m in means) / 11)
    expect(0.4 * spread < sum(errors) / 12 < 3 * spread, "the error, beside the spread of seeds", errors, spread)


def test_histogram():
    """The histogram of energies has natural frequencies, not those of the drawn rocks"""
    with Folder() as f:
        path = f.write("s.yaml", falls(POWER, simulation={"rocks": 20000, "contact_model": "index"}))
        picture = good("--plot", "histogram", "--size", "100x30", "--charset", "ascii", path).out
    first = re.search(r"0-20 kJ #+ +(\d+)", picture)
    below = 1 - rate_above([POWER], 20) / POWER["per_year"]
    expect_near(int(first[1]), 1000 * below, 3, picture)


def test_plot():
    """--plot hazard draws each option by its number; without blocks it gives the reason"""
    with Folder() as f:
        path = f.write("s.yaml", slope_site(forest=None, options=[{"name": "none", "forest": []},
                                                                  {"name": "coppice", "forest": [WOOD]}]))
        for size in ("100x30", "50x20"):
            picture = good("--plot", "hazard", "--size", size, "--charset", "ascii", path).out
            for text in ("How often, and with how much, at", "0 without forest", "1 none", "2 coppice", "10 y", "30 y", "1 kJ", "300"):
                expect_in(text, picture)
        expect_in("too narrow", good("--plot", "hazard", "--size", "20x12", path).out)
        expect_in("the scene has no 'blocks'",
                  good("--plot", "hazard", f.write("t.yaml", slope_site(blocks=None))).out)
        rare = f.write("u.yaml", falls({**POWER, "per_year": 0.0002}))
        expect_in("less than once in a thousand years", good("--plot", "hazard", rare).out)
        alone = good("--plot", "hazard", "-s", "simulation.contact_model=index", path).out
        expect("2 coppice" not in alone and "0 without forest" in alone, alone)


def test_few_arrive():
    """With no arrival or one there is no mean or no error; -e continues until all rocks are simulated"""
    far = slope_site(controls=[{"x_m": 199.5, "accepted_kJ": 1}], simulation={"rocks": 40},
                     slope={"vertices_m": [[0, 100], [150, 0], [200, 30]],
                            "segments": [{"rn": 0.1, "rt": 0.3, "roughness_rad": 0.25, "friction": 1}]})
    for more in ((), ("-e", "0.05")):
        for side in ("bare", "wooded"):
            a = run(far, *more)["options"][0]["controls"][0][side]
            expect_equal((a["reach_probability"], a["energy_kJ"]["mean"], a["energy_kJ"]["se"]), (0, None, None))
            expect(a["hazard"]["accepted_years_lo"] > 0 and a["hazard"]["exceed_per_year"] == 0, a["hazard"])
    one = run(falls(POWER), "-n", 1)["options"][0]["controls"][0]["bare"]
    expect_equal((one["reach_probability"], one["energy_kJ"]["se"]), (1, None))


def test_tolerance_and_uncertainty():
    """-e works with weights; uncertain sizes move the answer"""
    result = run(slope_site(), "-e", "0.05")
    for side in ("bare", "wooded"):
        energy = result["options"][0]["controls"][1][side]["energy_kJ"]
        expect(1.96 * energy["se"] <= 0.05 * energy["mean"], energy)
    with Folder() as f:
        for blocks, place in ((POWER, "blocks.exponent"), ([POWER], "blocks[0].exponent")):
            uncertainty = [{"path": place, "lo": 0.6, "hi": 2}]
            r = ceduo("--sensitivity=20", "-f", "json", "-n", 100, f.write("s.yaml", slope_site(blocks=blocks, uncertainty=uncertainty)))
            expect_equal(r.status, DONE, r)
            figures = r.json()[0]["figures"]
            reach = next(x for x in figures if x["figure"] == "reach_probability")
            expect(place in [i["path"] for i in reach["inputs"]], reach)
            expect(reach["uncertainty"]["p5"] < reach["uncertainty"]["p95"], reach)


def test_refused():
    """An invalid list of sizes is refused, with its place"""
    cases = [({**POWER, "exponent": -1}, "blocks.exponent: -1 is below 0"),
             ({k: v for k, v in POWER.items() if k != "exponent"}, "blocks: 'exponent' is missing"),
             ({**POWER, "volume_m3": [2, 2]}, "blocks.volume_m3: 2 m3 is not below 2 m3; write the smaller volume first"),
             ({**POWER, "volume_m3": [2]}, "blocks.volume_m3: expected [lo, hi]"),
             ({**POWER, "volume_m3": [0, 2]}, "blocks.volume_m3[0]: 0 is not above 0 m3"),
             ({**POWER, "per_year": 0}, "blocks.per_year: 0 is not above 0 1/y"),
             ([], "blocks: the list is empty"),
             ([POWER, {**POWER, "volume_m3": [5, 20]}],
              "blocks[1].volume_m3: this class overlaps an earlier one, from 0.01 to 10 m3; classes may only touch"),
             ([{**POWER, "volume_m3": [3, 1]}], "blocks[0].volume_m3: 3 m3 is not below 1 m3"),
             ([{"per_year": 1}], "'volume_m3' is missing"),
             ([POWER] * 1001, "items; at most 1000 can be computed"),
             (["many", 5], "blocks[0]: expected a mapping"),
             ({**POWER, "volume_m3": ["small", 2]}, "blocks.volume_m3[0]"),
             ({**POWER, "exponent": "steep"}, "blocks.exponent"),
             ("many", "blocks: expected a list, not a single value")]
    with Folder() as f:
        for blocks, wanted in cases:
            r = ceduo("--check", f.write("s.yaml", falls(blocks)))
            expect_equal(r.status, INPUT, r)
            expect_in(wanted, r.err)
        expect_in("blocks: the list is empty", ceduo("--check", f.write("s.yaml", falls([], rock={"shape": "block"}))).err)
        for changes, wanted in (({"rocks_per_year": 3}, "rocks_per_year: blocks already says this; keep one of the two"),
                                ({"rock": {"diameter_m": {"mean": 1, "spread": 0.1}}},
                                 "rock: 'blocks' gives the sizes of rocks; remove the size here, or its spread"),
                                ({"rock": {"volume_m3": {"mean": 1, "spread": 0.1}}}, "rock: 'blocks' gives the sizes"),
                                ({"rock": {"mass_kg": {"mean": 900, "spread": 10}}}, "rock: 'blocks' gives the sizes"),
                                ({"rock": {"diameter_m": {"mean": 1, "spread": 0.1}, "height_m": 2}}, "does not belong to the shape"),
                                ({"simulation": {"rocks": "all"}}, "simulation.rocks")):
            r = ceduo("--check", f.write("s.yaml", falls(POWER, **changes)))
            expect_equal(r.status, INPUT, r)
            expect_in(wanted, r.err)
        path = f.write("s.yaml", falls(POWER, simulation={"rocks": 64}))
        expect_equal(good("--batch", "-f", "json", "-s", "blocks.per_year=8", path).json()[0]["options"][0]["controls"][0]
                     ["bare"]["hazard"]["per_year"], 8)


if __name__ == "__main__":
    run_all(__name__)
