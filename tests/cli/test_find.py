#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""--find with a goal that equals the target exactly, and with several controls.

The results are known: the ADC of N trees of 1/4 m per hectare and a rock of 3/4 m is 10000/N m. Rocks of 2 kg released at 3 m/s
with gravity 4 m/s2 have 13 J after 1/2 s and 25 J after 1 s.
"""
import math
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import Folder, ceduo, expect, expect_equal, expect_in, good, result, run_all, scene, wooded_scene  # noqa: E402

PER_HA = "forest[0].stand.trees[0].per_ha"


def below(value):
    return math.nextafter(value, -math.inf)


def above(value):
    return math.nextafter(value, math.inf)


def find(mapping, path, lo, hi, goal, target=None):
    goal = goal if target is None else f"{goal}={target!r}"
    with Folder() as f:
        return good("--find", f"{path}={lo}:{hi}", "--goal", goal, "-f", "json", f.write("s.yaml", mapping)).json()[0]


def is_found(mapping, goal, target=None):
    """True if 400 trees per hectare meet a goal; no other value is tried."""
    found = find(mapping, PER_HA, 400, 400, goal, target)
    expect_equal((found["value"], found["nearest"]), (400, None) if found["found"] else (None, 400), goal)
    return found["found"]


def trees(per_ha, **changes):
    return {"name": "trees", "trees": [{"per_ha": per_ha, "dbh_m": 0.25, "height_m": 12, "volume_m3": 1e-9, **changes}],
            "energy": {"u_J_m3": 100000}}


def wood(*belts, controls=(100,), **changes):
    """Return belts (from, to, trees per ha) with the threshold at 25 m."""
    return scene(rock={"shape": "sphere", "diameter_m": 0.75}, controls=[{"x_m": x} for x in controls],
                 forest=[{"from_m": a, "to_m": b, "stand": trees(n)} for a, b, n in belts],
                 simulation={"rocks": 1, "threshold_m": 25}, **changes)


def drop(accepted=None, controls=(4,)):
    """Equal rocks that fly over level ground, with a forest after the controls."""
    return scene(rock={"shape": "sphere", "mass_kg": 2}, release={"x_m": 1, "height_m": 50, "vx_m_s": 3},
                 slope={"vertices_m": [[0, 0], [100, 0]], "segments": [{"rn": 0.3, "rt": 0.8}]},
                 controls=[{"x_m": x} if accepted is None else {"x_m": x, "accepted_kJ": accepted} for x in controls],
                 forest=[{"from_m": 50, "to_m": 60, "stand": trees(400)}], simulation={"rocks": 20, "gravity_m_s2": 4})


def test_adc_equal():
    """Goal adc: an ADC equal to the target does not meet it, for the light's limit or another"""
    mapping = wood((0, 100, 400))  # 25 m
    for target in (None, 25, below(25)):
        expect(not is_found(mapping, "adc", target), "an ADC of 25 m is not below", target or "the threshold of 25 m")
    expect(is_found(mapping, "adc", above(25)), "an ADC of 25 m is below", above(25))
    for target in (None, 25):
        expect_equal(find(mapping, PER_HA, 1, 1000, "adc", target)["value"], 401, "the first below 25 m")


def test_free_run_equal():
    """Goal free-run: a probability equal to the target meets it"""
    mapping, chance = wood((0, 100, 400)), math.exp(-1)  # over 25 m with an ADC of 25 m
    expect(is_found(mapping, "free-run", chance), chance)
    expect(not is_found(mapping, "free-run", below(chance)), below(chance))
    expect_equal(find(mapping, PER_HA, 1, 1000, "free-run", chance)["value"], 400, "the first at most e^-1")


def test_energy_equal():
    """Goal energy: a mean equal to the target meets it"""
    expect(is_found(drop(), "energy", 0.025), "25 J")
    expect(not is_found(drop(), "energy", below(0.025)), "less than 25 J")


def test_exceed_equal():
    """Goal exceed: a share equal to the target meets it; rocks with exactly the accepted energy do not count"""
    expect(is_found(drop(accepted=0.025), "exceed", 0), "25 J are no more than 25 J")
    expect(is_found(drop(accepted=0.0249), "exceed", 1), "all")
    expect(not is_found(drop(accepted=0.0249), "exceed", below(1)), "less than all")


def test_arrive_equal():
    """Goal arrive: a share equal to the target meets it"""
    expect(is_found(drop(), "arrive", 1), "all")
    expect(not is_found(drop(), "arrive", below(1)), "less than all")


def test_digits():
    """The page prints a value with four digits, and it still meets the goal; JSON has all digits"""
    with Folder() as f:
        path, per_ha = f.write("s.yaml", wood((0, 100, 400))), "forest[0].stand.trees[0].dbh_m"
        orders = ("--find", f"{per_ha}=0.01:2", "--goal", "adc=17", "-n", 1, path)
        value = good("-f", "json", *orders).json()[0]["value"]
        shown = re.match(r"forest\[0\]\.stand\.trees\[0\]\.dbh_m = (\S+)\n", good(*orders).out).group(1)
        expect(len(repr(value).strip("0.")) > 8 and len(shown.strip("0.")) <= 4 + ("." in shown.strip("0.")), value, shown)
        expect(0 <= float(shown) - value < 1e-3 * value, "the smallest that reaches the goal", value, shown)


def test_nobody_arrives():
    """Goal energy: met if no rock arrives"""
    stopped = drop(controls=(99,))
    stopped["slope"]["segments"] = [{"rn": 0, "rt": 0.1, "friction": 1}]
    with Folder() as f:
        done = ceduo("--find", f"{PER_HA}=400:400", "--goal", "energy=0", "-f", "json", f.write("s.yaml", stopped))
    expect(done.status == 0 and done.json()[0]["found"], "nobody", done)
    expect_in("cannot be assessed", done.err)


def test_energy_by_index():
    """Goal energy by the index: the residual mean; without stems before the control it is the whole mean"""
    mapping = drop()
    mapping["simulation"]["contact_model"] = "index"
    expect(is_found(mapping, "energy", 0.025), "25 J")
    expect(not is_found(mapping, "energy", below(0.025)), "less than 25 J")


def test_exceed_one_in_twenty():
    """Goal exceed without a value: 1 rock in 20 may exceed, 2 are too many"""
    mapping = wooded_scene(forest=[{"from_m": 10, "to_m": 95, "stand": trees(400)}], simulation={"rocks": 20})
    with Folder() as f:
        wooded = result(f.write("s.yaml", mapping))["options"][0]["controls"][0]["wooded"]
    expect_equal(wooded["rocks_reached"], 20, "rocks at the control")
    second, first = wooded["energy_kJ"]["p95"], wooded["energy_kJ"]["max"]  # the 19th and the 20th of 20
    for accepted, reached in (((first + second) / 2, True), (second * (1 - 1e-9), False)):
        mapping["controls"] = [{"x_m": 60, "accepted_kJ": accepted}]
        expect_equal(is_found(mapping, "exceed"), reached, f"{accepted} kJ")


def test_worst_control():
    """The goal counts at the worst control, in any order"""
    belts = (0, 60, 400), (60, 100, 1000)  # ADC 25 and 10 m
    for controls in ((60, 100), (100, 60)):
        mapping = wood(*belts, controls=controls)
        path = "forest[1].stand.trees[0].per_ha"  # only the control at 100 m lies after it
        found = find(mapping, path, 200, 1000, "adc", 30)
        expect_equal((found["value"], found["side"]), (334, "smallest"), f"adc, {controls}")  # 10^4/30 = 333.3
        chance = math.exp(-1)
        expect_equal(find(mapping, path, 200, 1000, "free-run", chance)["value"], 400, f"free-run, {controls}")
        lower = find(mapping, path, 200, 1000, "free-run", below(chance))
        expect(not lower["found"], "the first belt has e^-1", controls)
        expect(not find(mapping, path, 200, 1000, "adc", 25)["found"], "the first belt has 25 m", controls)
    for controls in ((2.5, 4), (4, 2.5)):  # 13 and 25 J
        for target, reached in ((0.026, True), (0.025, True), (0.014, False), (0.012, False)):
            expect_equal(is_found(drop(controls=controls), "energy", target), reached, f"{target} kJ, {controls}")
        for accepted, reached in ((0.026, True), (0.02, False), (0.01, False)):
            expect_equal(is_found(drop(accepted, controls), "exceed", 0.5), reached, f"withstands {accepted} kJ, {controls}")


def test_from_none():
    """A range may begin at no stems of a kind: 10^4/(n b) is below 25 m from 401 on with b + d = 1 m, and at 0 there is no ADC"""
    mapping = wood((0, 100, 400))
    expect_equal(find(mapping, PER_HA, 0, 1000, "adc")["value"], 401, "the first below 25 m")
    expect(not find(mapping, PER_HA, 0, 0, "adc")["found"], "without stems there is nothing to meet")
    expect(find(mapping, PER_HA, 0, 0, "energy", 1e6)["found"], "any energy is below 1e6 kJ")


def test_none_of_a_kind():
    """No stems of a kind equals an omitted kind; no stems at all equals no forest, rock for rock"""
    shoots = {"stools": {"per_ha": 2000, "spacing_m": 0.4}, "shoots": [{"per_ha": 6000, "dbh_m": 0.06, "height_m": 7}]}
    no_shoots = {"stools": {"per_ha": 0, "spacing_m": 0.4}, "shoots": [{"per_ha": 0, "dbh_m": 0.06, "height_m": 7}]}

    def run(stand):
        mapping = wood((0, 100, 400))
        mapping["simulation"]["rocks"] = 300
        mapping["forest"] = [] if stand is None else [{"from_m": 0, "to_m": 100, "stand": stand}]
        with Folder() as f:
            return good("-b", "-f", "json", f.write("s.yaml", mapping)).json()[0]["options"][0]

    for with_none, without in (({**shoots, **trees(0)}, shoots), ({**no_shoots, **trees(400)}, trees(400))):
        a, b = (run({**s, "name": "x", "species": "fagus-sylvatica", "energy": {"u_J_m3": 100000}})["stands"][0]
                for s in (with_none, without))
        expect_equal(a, b, "the stand")
    none, bare = run({**no_shoots, **trees(0), "name": "x"}), run(None)
    expect_equal(none["controls"][0]["wooded"], bare["controls"][0]["wooded"], "what arrives")
    expect_equal([none["stands"][0][k] for k in ("stems_per_ha", "stools_per_ha", "passes_threshold")], [0, 0, False], "the stand")


if __name__ == "__main__":
    run_all(__name__)
