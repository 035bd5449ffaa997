#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The years by which options are judged: one window for all, a due cut, and the first line."""
import math
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import Folder, expect, expect_equal, expect_in, expect_near, good, run_all, scene, stand  # noqa: E402

def run_json(*arguments, **options):
    return good("--batch", "-f", "json", *arguments, **options).json()[0]


def run_text(*arguments, **options):
    return " ".join(good("--batch", *arguments, **options).out.split())


def mean_over(years):
    """Share that exceeds, its plain mean over listed years, and the error of the mean: independent or equal rocks per year."""
    shares = [y["controls"][-1]["wooded"]["exceed_probability"] for y in years]
    return sum(shares) / len(shares), shares


def test_one_window():
    """All options have the years 1 to 25 of the longest rotation, and each figure equals --years=1:25"""
    answer = run_json("-n", 1000, "rotation")
    by_year = run_json("-n", 1000, "--years=1:25", "rotation")
    for option, same in zip(answer["options"], by_year["options"]):
        window = option["window"]
        expect_equal([window["from"], window["to"]], [1, 25], option["name"])
        mean, shares = mean_over(same["years"])
        error = math.sqrt(mean * (1 - mean) / 1000)  # equal rocks in all years; independent years have 25 times the number
        expect_near(window["mean"], mean, 4 * error, option["name"])
        expect_near(window["worst"], max(shares), 4 * math.sqrt(2 * 0.25 / 1000), option["name"])
        expect_near(window["failing_years"], sum(s > 0.05 for s in shares), 3, option["name"])
        expect(window["mean_lo"] < window["mean"] < window["mean_hi"], window)


def test_waiting_is_not_cutting():
    """In 0.4 a cut now and none for 20 years were equal; over the same years waiting differs"""
    wait = ["-s", "options[1]={name: wait, forest: [{from_m: 0, to_m: 135, cut_year: 20, stand: simple-coppice}]}"]
    now = ["-s", "options[0]={name: now, forest: [{from_m: 0, to_m: 135, cut_year: 1, stand: simple-coppice}]}"]
    answer = run_json("-n", 1000, *now, *wait, "--option", "now", "--option", "wait", "rotation")
    by_year = run_json("-n", 1000, "--years=1:25", *now, *wait, "--option", "now", "--option", "wait", "rotation")
    windows = [o["window"] for o in answer["options"]]
    expect_equal([w["to"] for w in windows], [25, 25])
    means = [mean_over(o["years"])[0] for o in by_year["options"]]
    expect(means[0] > means[1] + 0.05, means)
    expect_near(windows[0]["mean"] - windows[1]["mean"], means[0] - means[1], 0.03)


def test_given_years():
    """--years A:B gives the window, and the page ends with all options in one table"""
    out = good("--batch", "-n", 300, "--years=2:5", "rotation").out
    answer = run_json("-n", 300, "--years=2:5", "rotation")
    for option in answer["options"]:
        expect_equal([option["window"]["from"], option["window"]["to"]], [2, 5])
    table = out[out.index("All options year by year"):].splitlines()
    rows = [line.split() for line in table if re.match(r"\s+[2-5] ", line)]
    expect_equal([row[0] for row in rows], ["2", "3", "4", "5"])
    for k, row in enumerate(rows):
        shares = [o["years"][k]["controls"][-1]["wooded"]["exceed_probability"] for o in answer["options"]]
        expect_equal(row[1:], [f"{1000 * s:.0f}" for s in shares])
    expect_in("1 simple coppice, 2 coppice with standards, 3 selection coppice, 4 large reserves.", " ".join(out.split()))


def test_verdict_of_the_window():
    """The answer is the years', with today's stands next to it, and the first line names a due cut"""
    arguments = ["-n", 4000, "-s", "controls[0].accepted_kJ=150", "-s", "uncertainty=none", "--option", "simple coppice", "rotation"]
    control = run_json(*arguments)["options"][0]["controls"][0]
    expect_equal([control["verdict"]["answer"], control["verdict"]["today"]], ["no", "yes"])
    page = run_text(*arguments)
    expect(re.search(r"✔ YES today; ✘ NO after the cut: \d+ of 1000 in year \d+", page), page)
    expect(re.search(r"mean \d+ ±\d+ of 1000, worst \d+ in year \d+; today \d+ \(YES\)", page), page)
    expect_in("over the next 25 years?", page)
    cut = [*arguments[:-3], "-s", "options[0].forest[0].cut_year=9", *arguments[-3:]]
    expect(re.search(r" ✘ NO: in \d+ of 25 years more than 50 of 1000 rocks exceed 150 kJ", run_text(*cut)), run_text(*cut))


def test_question_names_the_years():
    """The question is about the years that are judged: typed ones, those of the scene, or the years ahead"""
    arguments = ["-n", 100, "-s", "uncertainty=none", "--option", "simple coppice", "rotation"]
    for more, words in (([], "over the next 25 years?"), (["--years=1:7"], "over the next 7 years?"),
                        (["--years=23:24"], "in the years 23 to 24?"), (["--years=0:20:5"], "in the years 0 to 20?"),
                        (["--years=9:9"], "in year 9?"), (["-s", "years={first: 23, last: 24}"], "in the years 23 to 24?")):
        for details in ([], ["--details"]):
            expect_in(words, " ".join(run_text(*more, *details, *arguments).split()), more)


def test_today_alone():
    """Without growth or cuts the window is only today, and the page reports it"""
    answer = run_json("-n", 300, "vaujany")
    expect_equal([o["window"] for o in answer["options"]], [None, None])
    expect_in("'forest' does not change: stand 'Mixed high forest' has no growth and cutting data", run_text("-n", 300, "vaujany"))


def test_rotation_in_details():
    """Each option's mean over a whole rotation stays in the details"""
    page = run_text("--details", "-n", 300, "road-below")
    answer = run_json("-n", 300, "--years=1:25", "road-below")
    table = page[page.index("option mean rotation "):]
    means = {name: re.search(name + r" (\d+)±\d+ (\d+)±\d+ ", table).groups() for name in ("simple coppice", "selection coppice")}
    expect(means["selection coppice"][0] != means["selection coppice"][1], "of its 13 years", page)
    found = float(means["simple coppice"][1])  # 25 years
    expect_near(found / 1000, mean_over(answer["options"][0]["years"])[0], 0.08)


SITE = dict(rock={"diameter_m": 0.6, "density_kg_m3": 2600}, release={"vx_m_s": 1, "height_m": 1},
            slope={"vertices_m": [[0, 100], [150, 0], [200, 0]], "segments": [{"rn": 0.35, "rt": 0.88, "roughness_rad": 0.25}]},
            simulation={"rocks": 1000}, uncertainty="none")


def site(**changes):
    return scene(**{**SITE, "controls": [{"x_m": 140, "name": "road", "accepted_kJ": 50}],
                    "forest": [{"from_m": 0, "to_m": 140, "stand": stand()}], **changes})


def run_page(what, *arguments):
    with Folder() as f:
        return run_text(*arguments, f.write("s.yaml", what))


def test_a_gap_is_named():
    """If a gap without forest is the reason, the page names it, and does not call the ADC failed"""
    page = run_page(site(forest=[{"from_m": 0, "to_m": 80, "stand": stand()}]))
    expect_in("gap without forest, m 60 < 30 ✘", page)
    expect("(ADC)" not in page, page)


def test_the_slope_alone():
    """If the slope meets the limit without forest, the page reports it next to the YES"""
    page = run_page(site(controls=[{"x_m": 140, "name": "road", "accepted_kJ": 15000}]))
    expect_in("✔ YES, also without forest: 0 of 1000 > 15000 kJ", page)


def test_impossible_stand():
    """An impossible stand supports no yes, in page and JSON; a no stands"""
    dense = stand(trees=[{"per_ha": 20000, "dbh_m": 0.3, "height_m": 18}])
    page = run_page(site(forest=[{"from_m": 0, "to_m": 140, "stand": dense}], controls=[{"x_m": 140, "accepted_kJ": 200}]))
    expect("YES" not in page.split("HOW SURE")[0], page)
    expect_in("more stems than a forest can hold: check the stand", page)
    with Folder() as f:
        path = f.write("s.yaml", site(forest=[{"from_m": 0, "to_m": 140, "stand": dense}], controls=[{"x_m": 140, "accepted_kJ": 200}]))
        expect_equal(run_json(path)["options"][0]["controls"][0]["verdict"]["answer"], "nothing")


def test_two_controls():
    """With two controls each line of the answer has its own name"""
    page = run_page(site(controls=[{"x_m": 100, "name": "track", "accepted_kJ": 20}, {"x_m": 140, "name": "road", "accepted_kJ": 50}]))
    expect(re.search(r"track \(100 m\): \S+ \w+.*road \(140 m\): \S+ \w+", page), page)


def test_smallest_block():
    """With one hazard the answer and the return period do not depend on the smallest counted block"""
    rows = []
    for smallest in (0.01, 0.03, 0.1, 0.3):
        lo, hi, b = 0.01, 10, 1.1
        per_year = 3 * (smallest ** -b - hi ** -b) / (lo ** -b - hi ** -b)
        what = site(blocks={"per_year": per_year, "volume_m3": [smallest, hi], "exponent": b}, simulation={"rocks": 8000},
                    controls=[{"x_m": 140, "accepted_kJ": 400, "accepted_return_y": 60}])
        with Folder() as f:
            control = run_json(f.write("s.yaml", what))["options"][0]["controls"][0]
        hazard = control["wooded"]["hazard"]
        rows.append((hazard["accepted_years_lo"], hazard["accepted_years"], hazard["accepted_years_hi"], control["verdict"]["answer"]))
        expect_equal(hazard["accepted_return_y"], 60)
    expect_equal(len({row[3] for row in rows}), 1, rows)
    expect(max(row[0] for row in rows) < min(row[2] for row in rows), rows)
    for limit, answer in ((rows[0][0] / 2, "yes"), (rows[0][2] * 2, "no")):
        what = site(blocks={"per_year": 3, "volume_m3": [0.01, 10], "exponent": 1.1}, simulation={"rocks": 8000},
                    controls=[{"x_m": 140, "accepted_kJ": 400, "accepted_return_y": limit}])
        with Folder() as f:
            expect_equal(run_json(f.write("s.yaml", what))["options"][0]["controls"][0]["verdict"]["answer"], answer, limit)


if __name__ == "__main__":
    run_all(__name__)
