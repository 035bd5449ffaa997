#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The JSON of a run: its shape, and golden figures of the paper in it."""
import math
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import PROFILES, Folder, expect, expect_equal, expect_near, good, result, run_all, scene
from runs import FOUR, MODELS, PAPER, expect_run, through, wilson

MASS = math.pi / 6 * 2600  # kg, of a sphere of 1 m


def test_json_shape():
    """JSON of the paper's site has exactly the documented keys and types"""
    done = good("--batch", "-f", "json", PAPER)
    expect(done.out.count("\n") == 1 and done.out.endswith("\n"), "one line a scene", done)
    run = done.json()[0]
    expect_run(run)
    expect_equal(run["format"], "ceduo-result-1")
    expect_equal(run["scene"], str(PAPER))
    expect_equal((run["title"], run["seed"], run["rocks"], run["law"], run["threshold_m"]),
                 ("Test site of Ciabocco et al. 2009", 1, 999, "lumped", 30))
    control = run["options"][0]["controls"][0]
    expect_equal((control["x_m"], control["name"], control["accepted_kJ"]), (135, "end of the forest", 50))
    expect_equal(control["lights"], {"contact": "pass", "free_run": "pass", "energy": "fail",
                                     "contact_8cm": "fail", "free_run_8cm": "fail"})
    expect(control["index"]["measured_kJ"] > 0, control["index"])
    expect_equal([s["name"] for s in run["options"][0]["stands"]], ["ADS 1", "ADS 2"])
    bare = result(PAPER, *through("index"))
    expect_run(bare, "index")
    other = bare["options"][0]["controls"][0]
    expect_equal(other["lights"], {"contact": "pass", "free_run": "pass", "energy": "unknown",
                                   "contact_8cm": "fail", "free_run_8cm": "fail"}, "lights by the index")
    for name in ("bare", "index"):
        expect_equal(other[name], control[name], f"{name} does not depend on the contact model")
    expect_equal(result(PAPER, *through("stems"))["options"], run["options"], "stems is the default")


def test_json_shape_everywhere():
    """JSON keeps its shape for every shipped scene, and without measured speed measured_kJ is null"""
    for path in sorted((PROFILES / "scenes").glob("*.yaml")):
        for model in MODELS:
            run = result(path, "-n", 50, *through(model))
            expect_run(run, model)
    for model, runs in (("index", 1), ("stems", 17)):
        run = result(FOUR, "-n", 50, *through(model))
        expect_equal(len(run["options"]), 8)
        expect(all(c["index"]["measured_kJ"] is None for o in run["options"] for c in o["controls"]), "measured_kJ")
        expect_equal((run["work"]["runs"], run["work"]["rocks_flown"]), (runs, 50 * runs), model)
    run = result("blocks-above-the-road", "-n", 50)  # four options, each under two laws; years are not counted with blocks
    expect_equal((run["work"]["runs"], run["work"]["rocks_flown"]), (9, 50 * 9), "blocks")


def test_json_numbers_shortest():
    """JSON numbers are the shortest that read back equal"""
    text = good("--batch", "-f", "json", PAPER).out
    for word in re.findall(r"[:\[] (-?[0-9][^,}\]]*)", text):
        digits = len(re.sub(r"e.*|[^0-9]", "", word).strip("0"))
        expect(digits <= len(re.sub(r"e.*|[^0-9]", "", repr(float(word))).strip("0")),
               f"{word} is longer than {float(word)!r}")


def test_golden_rock():
    """Rock of the paper's site: 512.3058 kg, 0.68 m, k = 1/2 (Ciabocco, Boccia and Ripa 2009, Table 2)"""
    rock = result(PAPER, "-n", 1)["rock"]
    expect_near(rock["mass_kg"], 512.3058, 5e-5, "mass_kg")
    expect_near(rock["mean_diameter_m"], 0.68, 1e-12, "mean_diameter_m")
    expect_near(rock["moment_kg_m2"], 0.5 * rock["mass_kg"] * 0.34 ** 2, 1e-9, "moment_kg_m2")


def test_golden_adc():
    """ADC of both plots by four forms (Ciabocco, Boccia and Ripa 2009, Eq. 1 and 6)"""
    first, second = result(PAPER, "-n", 1)["options"][0]["stands"]
    for found, wanted in ((first, (3.0408464743513717, 1.4869189789743706, 1.9483462242414016, 2.16747)),
                          (second, (4.1072434112628, 2.9638349890797495, 2.6053723298516003, 3.51373))):
        adc = found["adc"]
        expect_equal(adc["rule"], "interception")
        expect_equal(adc["adc_m"], adc["interception_m"])
        for key, value in zip(("gsteiger_stools_m", "gsteiger_stems_m", "interception_m"), wanted):
            expect_near(adc[key], value, 1e-12 * value, f"{found['name']} {key}")
        expect_near(adc["crofton_m"], wanted[3], 5e-6, f"{found['name']} crofton_m")
        expect(found["passes_threshold"] is True, found)
        expect_near(found["free_run_probability"], math.exp(-30 / adc["crofton_m"]), 1e-12, "free run")
        expect_near(found["contacts"], 67.5 / adc["adc_m"], 1e-9, "contacts (Eq. 2)")


def test_golden_plots():
    """Stems and basal areas of both plots (Ciabocco, Boccia and Ripa 2009, Table 1: 26.52 and 8.05 m2/ha)"""
    first, second = result(PAPER, "-n", 1)["options"][0]["stands"]
    expect_equal([(s["stems_per_ha"], s["stools_per_ha"], s["trees_per_ha"], s["length_m"]) for s in (first, second)],
                 [(9076, 3688, 750, 67.5), (4641, 2807, 542, 67.5)])
    expect_near(first["basal_area_m2_ha"], 9076 * math.pi * 0.061 ** 2 / 4, 1e-9, "ADS 1")
    expect_near(second["basal_area_m2_ha"], 4641 * math.pi * 0.047 ** 2 / 4, 1e-9, "ADS 2")
    expect_near(first["basal_area_m2_ha"], 26.52, 0.005, "ADS 1")
    expect_near(second["basal_area_m2_ha"], 8.05, 0.005, "ADS 2")
    expect_equal(first["warnings"], [])
    expect(len(second["warnings"]) == 1 and "Eq. 6" in second["warnings"][0], second["warnings"])


def test_golden_energy():
    """Energy taken: 34.3844, 53.8216, 63.7469 kJ, 39.87 kJ per 100 m (Ciabocco, Boccia and Ripa 2009, Eq. 3 and 4)"""
    for rule, wanted in (("auto", 53.8216), ("interception", 53.8216), ("gsteiger-stools", 34.3844),
                         ("gsteiger-stems", 63.7469)):
        option = result(PAPER, "-n", 1, "-s", f"simulation.rule={rule}")["options"][0]
        expect_near(option["summary"]["dissipated_kJ"], wanted, 5e-5, rule)
        expect_near(sum(s["dissipated_kJ"] for s in option["stands"]), wanted, 5e-5, rule)
        expect_equal(option["controls"][0]["index"]["dissipated_kJ"], option["summary"]["dissipated_kJ"], rule)
    option = result(PAPER, "-n", 1)["options"][0]
    expect_near(option["summary"]["dissipated_kJ_per_100m"], 39.87, 0.005, "per 100 m")
    expect_near(option["stands"][0]["energy_per_contact_J"], 0.0107 * 102800, 1e-9, "V U")
    expect_near(option["stands"][1]["energy_per_contact_J"], 0.0059 * 102800, 1e-9, "V U")
    expect_equal((option["summary"]["length_m"], option["summary"]["longest_gap_m"]), (135, 0))
    expect_near(option["summary"]["adc_m"], 135 / option["summary"]["contacts"], 1e-12, "adc_m")


def test_golden_residual():
    """Residual energy, and the measured 62.337 kJ (Ciabocco, Boccia and Ripa 2009, Eq. 5)"""
    control = result(PAPER)["options"][0]["controls"][0]
    index, bare = control["index"], control["bare"]
    expect_near(index["measured_kJ"], 62.337, 5e-4, "measured_kJ")
    expect_near(index["residual_kJ"], bare["energy_kJ"]["mean"] - index["dissipated_kJ"], 1e-9, "residual_kJ")
    expect(index["exhausted"] is False, index)
    control = result(PAPER, "-s", "controls[0].x_m=14")["options"][0]["controls"][0]
    more = result(PAPER, "-s", "controls[0].x_m=14", "-s", "forest[0].stand.shoots[0].volume_m3=1")
    index = more["options"][0]["controls"][0]["index"]
    expect_equal((index["residual_kJ"], index["exhausted"]), (0, True), "used up")


def test_golden_reserves():
    """60 reserves stand 189.39 m apart, 379 pass 30 m and 378 fail (Ciabocco, Boccia and Ripa 2009, section 4.2)"""
    for per_ha, light in ((60, "fail"), (378, "fail"), (379, "pass")):
        run = result(FOUR, "-n", 1, "--option", "simple coppice, just cut", "-s",
                     f"options[simple coppice, just cut].forest[0].stand.trees[0].per_ha={per_ha}")
        option = run["options"][0]
        expect_equal(option["controls"][0]["lights"]["contact"], light, f"{per_ha} a hectare")
        expect_equal(option["stands"][0]["passes_threshold"], light == "pass", f"{per_ha} a hectare")
        if per_ha == 60:
            expect_near(option["stands"][0]["adc"]["adc_m"], 189.394, 5e-4, "ADC")
            expect_equal(option["stands"][0]["adc"]["rule"], "gsteiger-stems")


def test_golden_speed():
    """Mean speed without forest agrees with the paper's Table 5 (Ciabocco, Boccia and Ripa 2009), 10^5 rocks"""
    bare = result(PAPER, "-n", 100000, *through("index"))["options"][0]["controls"][0]["bare"]
    speed, energy = bare["speed_m_s"], bare["energy_kJ"]
    expect_near(speed["mean"], 20.612, 4 * math.hypot(speed["se"], 0.005), "mean speed")
    expect_near(speed["sd"], 4.78, 0.05, "sd")
    expect_near(energy["mean"], 114.69, 4 * math.hypot(energy["se"], 0.05), "mean energy")
    expect_near(bare["reach_probability"], 0.9913, 0.002, "reach")
    expect_equal(bare["energy_kJ"], bare["translation_kJ"], "the law lumped knows no spin")


def test_golden_wooded():
    """Energy, speed, shares of passing and of stopped rocks in the forest of the paper's site"""
    n = 20000
    option = result(PAPER, "-n", n)["options"][0]
    wooded = option["controls"][0]["wooded"]
    expect_near(wooded["energy_kJ"]["mean"], 62.06, 4 * math.hypot(wooded["energy_kJ"]["se"], 0.1), "energy")
    expect_near(wooded["speed_m_s"]["mean"], 14.67, 4 * math.hypot(wooded["speed_m_s"]["se"], 0.005), "speed")
    for found, wanted, what in ((wooded["reach_probability"], 0.832, "reach"),
                                (option["ends"]["stopped_by_stems"], 0.154, "stopped by stems")):
        expect_near(found, wanted, 4 * math.sqrt(wanted * (1 - wanted) / n) + 0.0005, what)


def test_percentiles_in_closed_form():
    """Rocks leave a cliff at 8 to 12 m/s, uniform: the bounds of each percentile are at the ranks of the binomial distribution"""
    n = 20000
    site = scene(rock={"diameter_m": 1}, release={"vx_m_s": {"mean": 10, "spread": 2, "kind": "uniform"}}, controls=[{"x_m": 20}], forest=[],
                 slope={"vertices_m": [[0, 100], [1, 0], [60, 0]], "segments": [{"rn": 0, "rt": 0}]})
    with Folder() as f:
        bare = result(f.write("s.yaml", site), "-n", n)["options"][0]["controls"][0]["bare"]
    speed = bare["speed_m_s"]

    def below(v):
        """Return the share of rocks that pass with less: a slower release falls longer."""
        lo, hi = 8.0, 12.0
        for _ in range(60):
            middle = (lo + hi) / 2
            lo, hi = (middle, hi) if math.hypot(middle, 9.81 * 20 / middle) > v else (lo, middle)
        return (12 - lo) / 4

    for q in (0.5, 0.95, 0.99):
        at = below(speed[f"p{100 * q:.0f}"])
        ranks = 1.96 * math.sqrt(n * q * (1 - q))
        expect_near(at, q, 4 * math.sqrt(q * (1 - q) / n), q)
        for side, key in ((-1, "lo"), (1, "hi")):  # the ranks between two values differ by their root
            found = n * (below(speed[f"p{100 * q:.0f}_{key}"]) - at)
            expect_near(side * found, ranks, 4 * math.sqrt(ranks), f"p{100 * q:.0f}_{key}: ranks from the percentile")
            expect_near(bare["energy_kJ"][f"p{100 * q:.0f}_{key}"], MASS * speed[f"p{100 * q:.0f}_{key}"] ** 2 / 2000, 1e-9)


def test_statistics():
    """Intervals are Wilson's, percentiles ascend, means per released and per arriving rock agree"""
    for law in ("lumped", "crsp"):
        run = result(PAPER, "-s", f"simulation.law={law}", "-s", "controls[0].x_m=60")
        expect_run(run)
        statistics(run, law, "bare")
        statistics(run, law, "wooded")


def statistics(run, law, which):
    bare, n = run["options"][0]["controls"][0][which], run["rocks"]
    expect_equal(bare["reach_probability"], bare["rocks_reached"] / n, "reach_probability")
    for key, value in zip(("reach_lo", "reach_hi"), wilson(bare["rocks_reached"], n)):
        expect_near(bare[key], value, 1e-12, key)
    exceeded = round(bare["exceed_probability"] * n)
    for key, value in zip(("exceed_lo", "exceed_hi"), wilson(exceeded, n)):
        expect_near(bare[key], value, 1e-12, key)
    for name in ("speed_m_s", "energy_kJ", "translation_kJ", "height_m"):
        d = bare[name]
        expect(d["p50"] <= d["p95_lo"] <= d["p95"] <= d["p95_hi"] <= d["max"] and d["p95"] <= d["p99"] <= d["max"],
               name, d)
        expect_near(d["se"], d["sd"] / math.sqrt(bare["rocks_reached"]), 1e-12 + 1e-9 * d["sd"], f"{name}.se")
    expect_near(bare["energy_per_released_kJ"]["mean"], bare["energy_kJ"]["mean"] * bare["reach_probability"], 1e-9,
                "energy_per_released_kJ")
    expect((law == "lumped") == (bare["energy_kJ"] == bare["translation_kJ"]), "rotation", bare)


if __name__ == "__main__":
    run_all(__name__)
