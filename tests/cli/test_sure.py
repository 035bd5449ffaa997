#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""--find --sure: the value that reaches a goal in a share of the plausible cases.

Trees of 0.2 m per hectare and a rock of 0.8 m: with n and m trees of two classes the ADC is 10000/(n + m) m. If m may be 1000
to 2000, it is below 4 m with probability s from n = 1500 - 1000(1 - s) on. The other cases are compared with random scenes."""
import json
import math
import random
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import DONE, FULL, USAGE, Folder, ceduo, expect, expect_equal, expect_in, expect_near, good, run_all, scene, stand  # noqa: E402

PER_HA = "forest[0].stand.trees[{}].per_ha"
STEPS = 1000 / 256  # between points


ENERGY = {"model": "brauner", "u_J_m3": 1e5, "offset": "whole"}
SLOPE = {"vertices_m": [[0, 70], [100, 0]], "segments": [{"rn": 0.3, "rt": 0.9, "roughness_rad": 0.2, "friction": 0.5}]}


def wood(uncertainty=({"path": PER_HA.format(1), "lo": 1000, "hi": 2000},), **changes):
    trees = [{"per_ha": 1000, "dbh_m": 0.2, "height_m": 12, "volume_m3": 0.2}] * 2
    return scene(rock={"shape": "sphere", "diameter_m": 0.8, "density_kg_m3": 2600}, controls=[{"x_m": 90, "accepted_kJ": 20}],
                 forest=[{"from_m": 0, "to_m": 100, "stand": stand(stools=None, shoots=None, trees=trees, energy=ENERGY)}],
                 release={"vx_m_s": 5, "height_m": 1}, slope=SLOPE,
                 uncertainty=list(uncertainty), simulation={"rocks": 300, "rule": "gsteiger-stems", **changes.pop("simulation", {})}, **changes)


def find(mapping, goal, sure, *others, path=PER_HA.format(0), lo=1, hi=5000, form="json"):
    with Folder() as f:
        done = good("--find", f"{path}={lo}:{hi}", "--goal", goal, "--sure", sure, "-f", form, *others, f.write("s.yaml", mapping))
        return done.json()[0] if form == "json" else " ".join(done.out.split())


def test_known_law():
    """The number of trees at this probability, in closed form; the minimum is the worst case's"""
    for sure in (0.05, 0.5, 0.9, 0.99):
        found = find(wood(), "adc=4", sure)
        answer = found["sure"]
        expect_near(answer["value"], 1500 - 1000 * (1 - sure), 3 * STEPS, sure)
        expect(sure <= answer["probability"] <= sure + 0.02, answer)
        expect_near(answer["probability"], sure, 3 * answer["probability_se"] + 0.01, sure)
        expect_equal((answer["wanted"], answer["found"], answer["side"], answer["nearest"]), (sure, True, "smallest", None), sure)
        expect_equal(found["value"], 1501, "the scene as it is has 1000 of the other class")
    worst = find(wood(), "adc=4", 1)["sure"]
    expect(1500 - 3 * STEPS <= worst["value"] <= 1500 and worst["probability"] == 1, worst)


def test_free_run():
    """The probability of a free run depends on n + m trees, too: fewer of one need more of the other"""
    for sure in (0.1, 0.9):
        found = find(wood(), "free-run=0.001", sure)
        expect_near(found["sure"]["value"], found["value"] - 1000 * (1 - sure), 3 * STEPS, sure)


def largest(*controls, contact_model="index", goal="energy=30", forest=()):
    """Find the diameter, with an uncertain density."""
    mapping = wood(uncertainty=[{"path": "rock.density_kg_m3", "lo": 2000, "hi": 3000}], simulation={"contact_model": contact_model})
    mapping |= {"forest": list(forest), "controls": [{"x_m": x, "accepted_kJ": 20} for x in controls]}
    return find(mapping, goal, 0.9, "-n", 200, path="rock.diameter_m", lo=0.1, hi=1)


def test_largest():
    """If smaller values are safer the result is the largest; out of range there is none, and the nearest is named"""
    for model in ("index", "stems"):
        found = largest(90, contact_model=model)
        expect_equal((found["sure"]["found"], found["sure"]["side"]), (True, "largest"), model)
        # energy is proportional to mass: with 2900 kg/m3 instead of 2600, nine in ten cases are below
        expect_near(found["sure"]["value"], found["value"] * (2600 / 2900) ** (1 / 3), 0.01 * found["value"], model)
    none = find(wood(), "adc=4", 0.9, hi=1000)["sure"]
    expect_equal((none["found"], none["value"], none["probability"], none["nearest"]), (False, None, None, 1000))
    expect_near(none["probability_at_nearest"], 0.5, 0.02)
    expect_in("no value holds in 90 % of plausible cases; nearest: 1000, in 50 %", find(wood(), "adc=4", 0.9, hi=1000, form="table"))
    expect_in("every value of the range holds in 90 % of plausible cases", find(wood(), "adc=4", 0.9, lo=2000, form="table"))


def test_worst_control():
    """The worse of two places counts, in any order"""
    upper, lower = (largest(x)["sure"]["value"] for x in (30, 90))
    expect(abs(upper - lower) > 0.02, (upper, lower))
    for controls in ((30, 90), (90, 30)):
        expect_equal(largest(*controls)["sure"]["value"], min(upper, lower), controls)


def test_no_energy():
    """If no rock arrives, or the index leaves no energy, every value suffices"""
    thick = {"from_m": 0, "to_m": 90, "stand": stand(stools=None, shoots=None, trees=[{"per_ha": 3000, "dbh_m": 0.5, "height_m": 20}])}
    for model in ("index", "stems"):
        found = largest(90, contact_model=model, goal="energy=0.001", forest=[thick])["sure"]
        expect_equal((found["found"], found["value"], found["probability"]), (True, 0.1, 1), model)


def test_nothing_in_uncertainty():
    """Without uncertainty, or if only the value itself is uncertain, the plain answer holds, with a message"""
    for uncertainty in ((), ({"path": PER_HA.format(0), "lo": 500, "hi": 1500},)):
        expect_equal(find(wood(uncertainty), "adc=4", 0.9)["sure"], None, uncertainty)
        expect_in("no other input is uncertain", find(wood(uncertainty), "adc=4", 0.9, form="table"), uncertainty)
    none = wood()
    none["uncertainty"] = "none"
    expect_equal(find(none, "adc=4", 0.9)["sure"], None)
    with Folder() as f:
        path = f.write("s.yaml", wood())
        expect_equal(good("--find", f"{PER_HA.format(0)}=1:5000", "--goal", "adc=4", "-f", "json", path).json()[0]["sure"], None)


BOUNDS = {PER_HA.format(1): (50, 250), "rock.density_kg_m3": (2200, 2900), "forest[0].stand.energy.u_J_m3": (5e4, 1.5e5)}


def test_error_on_the_page():
    """The page prints half the 95 % interval of the share, 1.96 standard errors"""
    what = wood([{"path": p, "lo": lo, "hi": hi} for p, (lo, hi) in BOUNDS.items()])
    asked = (what, "exceed=0.2", 0.8, "-n", 50)
    answer, page = find(*asked)["sure"], find(*asked, form="table")
    expect(answer["probability_se"] > 0.02, "so few rocks leave an error", answer)
    expect_in(f"reaches the goal in {100 * answer['probability']:.0f} %, ±{196 * answer['probability_se']:.0f};", page)


def test_error_of_the_value():
    """The interval contains the closed form for 19 in 20 seeds, and without point error only the value"""
    sure, held = 0.8, 0
    for seed in range(1, 21):
        answer = find(wood(), "adc=4", sure, "--seed", seed)["sure"]
        expect(answer["value_lo"] <= answer["value"] <= answer["value_hi"], answer)
        expect(answer["value_hi"] - answer["value_lo"] < 40 * STEPS, "the error of 256 points", answer)
        held += answer["value_lo"] <= 1500 - 1000 * (1 - sure) <= answer["value_hi"]
    expect(held >= 18, held)
    none = find(wood([]), "adc=4", sure)
    expect_equal(none["sure"], None, none)


def test_error_by_the_rocks():
    """With few rocks the interval contains the common value of all seeds, and is about as wide as their spread"""
    mapping = wood([{"path": p, "lo": lo, "hi": hi} for p, (lo, hi) in BOUNDS.items()])
    mapping["forest"][0]["stand"]["trees"] = [{"per_ha": 150, "dbh_m": 0.2, "height_m": 12}] * 2
    answers = [find(mapping, "exceed=0.2", 0.8, "-n", 50, "--seed", seed, lo=100, hi=3000)["sure"] for seed in range(1, 13)]
    values = sorted(a["value"] for a in answers)
    middle, mean = values[len(values) // 2], sum(values) / len(values)
    held = sum(a["value_lo"] <= middle <= a["value_hi"] for a in answers)
    expect(held >= 10, held, answers)
    spread = math.sqrt(sum((v - mean) ** 2 for v in values) / (len(values) - 1))
    half = sum(a["value_hi"] - a["value_lo"] for a in answers) / len(answers) / 2
    expect(0.5 < half / (1.96 * spread) < 2, half, spread)


def test_as_scenes_at_random():
    """At this value the required number of 80 random scenes meet the goal, within three errors; at the plain one fewer"""
    mapping = wood([{"path": p, "lo": lo, "hi": hi} for p, (lo, hi) in BOUNDS.items()])
    mapping["forest"][0]["stand"]["trees"] = [{"per_ha": 150, "dbh_m": 0.2, "height_m": 12}] * 2
    found = find(mapping, "exceed=0.2", 0.8, "-n", 400, hi=3000)
    expect(found["found"] and found["sure"]["found"] and found["sure"]["value"] > found["value"], found)
    draw, reached = random.Random(1), {}
    with Folder() as f:
        path = f.write("s.yaml", mapping)
        draws = [{p: draw.uniform(lo, hi) for p, (lo, hi) in BOUNDS.items()} for _ in range(80)]
        for value in (found["value"], found["sure"]["value"]):
            shares = []
            for one in draws:
                sets = [x for p, v in {**one, PER_HA.format(0): value}.items() for x in ("-s", f"{p}={v!r}")]
                wooded = good("-b", "-f", "json", "-n", 400, *sets, path).json()[0]["options"][0]["controls"][0]["wooded"]
                shares.append(wooded["exceed_probability"])
            reached[value] = sum(s <= 0.2 for s in shares) / len(shares)
    error = math.hypot(math.sqrt(0.8 * 0.2 / 80), found["sure"]["probability_se"])
    expect_near(reached[found["sure"]["value"]], 0.8, 3 * error, reached)
    expect(reached[found["value"]] < 0.8 - error, reached)


def test_what_is_too_much():
    """With an unlimited accepted energy no rock exceeds it in any case; with none all arrivals do"""
    strong, weak = (wood() | {"controls": [{"x_m": 90, "accepted_kJ": kj}]} for kj in (1e6, 1e-6))
    answer = find(strong, "exceed=0.2", 0.9, "-n", 50)["sure"]
    expect_equal((answer["value"], answer["probability"]), (1, 1))
    expect_equal(find(weak, "exceed=0.2", 0.9, "-n", 50)["sure"], find(weak, "arrive=0.2", 0.9, "-n", 50)["sure"])


def test_over_a_rotation():
    """Over a rotation: the mean over its years; refused for the mean energy"""
    with Folder() as f:
        path = f.write("s.yaml", wood())
        r = ceduo("--find", f"{PER_HA.format(0)}=1:100", "--goal", "energy=5", "--years", "--sure", "0.9", path)
        expect_equal((r.status, r.out), (USAGE, ""), r)
        expect_in("over a rotation the mean energy has no uncertainty", r.err)
    mapping = wood(uncertainty=[{"path": "rock.density_kg_m3", "lo": 2000, "hi": 3000}])
    mapping["forest"] = [{"from_m": 0, "to_m": 90, "stand": "coppice-with-standards"}]
    found = find(mapping, "exceed=0.5", 0.9, "--years", "-n", 100, path="forest[0].stand.cutting.stay_per_ha[0]", lo=100, hi=103)
    expect_equal(found["over"], "rotation")
    expect(found["sure"]["points"] == 256 and 0 <= (found["sure"]["probability"] or found["sure"]["probability_at_nearest"]) <= 1, found)


def test_worst_year():
    """A goal of the index is the worst year's: if uncertain inputs do not affect it, as without them"""
    mapping = wood(uncertainty=[{"path": "rock.density_kg_m3", "lo": 2000, "hi": 3000}])
    measured = {"source": {"kind": "measured", "text": "on this slope"}}
    wooded = {"from_m": 0, "to_m": 90, "stand": {"base": "coppice-with-standards", "growth": measured}}
    both = [{**wooded, "to_m": 45, "cut_year": 0}, {**wooded, "from_m": 45, "cut_year": 10}]  # years are shown from 10 on
    for forest in ([wooded], both):
        mapping["forest"] = forest
        found = find(mapping, "adc=100", 0.9, "--years", path="forest[0].stand.cutting.stay_per_ha[0]", lo=10, hi=300)
        expect(found["found"] and found["value"] > 10, found)
        expect_equal((found["over"], found["sure"]["value"], found["sure"]["probability"]), ("rotation", found["value"], 1), forest)
    mapping["forest"] = [{**wooded, "stand": "coppice-with-standards"}]
    found = find(mapping, "adc=100", 0.9, "--years", path="forest[0].stand.cutting.stay_per_ha[0]", lo=10, hi=300)
    expect(found["sure"]["value"] > found["value"] and 0.9 <= found["sure"]["probability"] < 1, "growth that is assumed", found)


def test_share_in_the_worst_year():
    """Shares of the rocks in the worst year: with the found value in the scene the worst year just meets the goal"""
    mapping = wood([]) | {"controls": [{"x_m": 90, "accepted_kJ": 120}]}
    mapping["forest"] = [{"from_m": 0, "to_m": 90, "stand": {"base": "coppice-with-standards", "energy": {"offset": "whole"}}}]
    path, rocks = "forest[0].stand.cutting.stay_per_ha[0]", 400
    with Folder() as f:
        scene_file = f.write("s.yaml", mapping)

        def run_years(value):
            return good("-b", "--years", "-f", "json", "-n", rocks, "-s", f"{path}={value}", scene_file).json()[0]["options"][0]

        few, many = (max(y["controls"][0]["wooded"]["exceed_probability"] for y in run_years(v)["years"]) for v in (10, 600))
        goal = (few + many) / 2
        found = good("--find", f"{path}=10:600", "--goal", f"worst-exceed={goal}", "-n", rocks, "-f", "json", scene_file).json()[0]
        mean = good("--find", f"{path}=10:600", "--goal", f"exceed={goal}", "--years", "-n", rocks, "-f", "json", scene_file).json()[0]
        page = good("--find", f"{path}=10:600", "--goal", f"worst-exceed={goal}", "-n", rocks, scene_file).out
        at = run_years(found["value"])
    expect_equal((found["found"], found["over"], found["goal"]), (True, "rotation", "worst-exceed"), found)
    worst = max(y["controls"][0]["wooded"]["exceed_probability"] for y in at["years"])
    expect_near(worst, found["goal_at_value"], 1e-12, "as --years says")
    expect(worst <= goal and goal - worst < 3 * math.sqrt(goal * (1 - goal) / rocks), worst, goal)
    expect(not mean["found"] or mean["value"] < found["value"], "the mean keeps to it earlier", mean)
    expect_in("in the worst of the years ahead", page)
    if not FULL:  # ten times earlier ones; test_worst_year() has a certain index
        return
    mapping["uncertainty"] = [{"path": "controls[0].accepted_kJ", "lo": 100, "hi": 140}]
    # The maximum of 20 years of 32 rocks is biased upward, by the same rocks at all points: many seeds find none.
    sure = find(mapping, f"worst-exceed={goal}", 0.5, "-n", 100, "--seed", 6, path=path, lo=10, hi=600)["sure"]
    expect(sure["found"] and sure["value_lo"] and sure["value_lo"] <= found["value"] <= sure["value_hi"], "half of what may be accepted is above the scene's", sure, found)


def test_threads():
    """Equal results on one, two and three threads"""
    mapping = wood([{"path": p, "lo": lo, "hi": hi} for p, (lo, hi) in BOUNDS.items()])
    one, *others = (find(mapping, "exceed=0.2", 0.8, "-n", 50, "-j", j, hi=300) for j in (1, 2, 3))
    for other in others:
        expect_equal(other["sure"], one["sure"])


def test_refused():
    """Invalid shares, and requests without a search"""
    for sure, told in (("0", "0 is not a share"), ("90", "90 is not a share"), ("-1", "-1 is not a share"), ("x", "'x' is not a number"),
                       ("nan", "not a number")):
        r = ceduo("--find", f"{PER_HA.format(0)}=1:9", "--goal", "adc", f"--sure={sure}", "paper-site")
        expect_equal((r.status, r.out), (USAGE, ""), sure)
        expect_in(told, r.err, sure)
    r = ceduo("-b", "--sure", "0.9", "paper-site")
    expect_equal(r.status, USAGE, r)
    expect_in("--sure requires --find", r.err)


def test_page():
    """The page prints both values; the second with its share"""
    page = find(wood(), "adc=4", 0.9, form="table")
    expect(re.search(r"per_ha = 1501 .* in 90 % of plausible cases: (139\d|140\d|141\d) \(reaches the goal in 9[01] %, ±\d; with this error the value is 1[34]\d\d to 14\d\d\)", page), page)


if __name__ == "__main__":
    run_all(__name__)
