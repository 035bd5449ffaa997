#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What ceduo --batch prints and how it ends: table, CSV, JSON, options, files, streams, signals."""
import csv
import functools
import io
import math
import os
import pty
import re
import shutil
import signal
import subprocess
import sys
import time
import unicodedata
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import (CEDUO, DONE, INPUT, OUTPUT, PROFILES, RUN, SANITIZED, USAGE, Failure, Folder, Skip, Suite, belt, ceduo,
                     environment, expect, expect_equal, expect_in, expect_near, good, only_text, result, results,
                     scene, stand, tests_of, wooded_scene)

PAPER = PROFILES / "scenes" / "paper-site.yaml"
FOUR = PROFILES / "scenes" / "four-systems.yaml"

# ---- the JSON of a run ----

NUMBER, MAYBE, TEXT, TEXT_OR_NULL, FLAG, FLAG_OR_NULL, COUNT, NULL, LIGHT = (
    "number", "number or null", "text", "text or null", "flag", "flag or null", "count", "null", "light")
SPREAD = {k: MAYBE for k in ("mean", "se", "sd", "p50", "p95", "p95_lo", "p95_hi", "p99", "max")}
PAIR = {"mean": MAYBE, "se": MAYBE}
ARRIVALS = {"rocks_reached": COUNT, "reach_probability": NUMBER, "reach_lo": NUMBER, "reach_hi": NUMBER,
            "exceed_probability": MAYBE, "exceed_lo": MAYBE, "exceed_hi": MAYBE, "speed_m_s": SPREAD,
            "energy_kJ": SPREAD, "translation_kJ": SPREAD, "height_m": SPREAD, "energy_per_released_kJ": PAIR}
INDEX = {"dissipated_kJ": NUMBER, "residual_kJ": MAYBE, "exhausted": FLAG_OR_NULL}
WOODED = {**ARRIVALS, "contacts": PAIR}
CONTROL = {"x_m": NUMBER, "name": TEXT_OR_NULL, "accepted_kJ": MAYBE, "bare": ARRIVALS, "index": INDEX, "wooded": WOODED,
           "lights": {"contact": LIGHT, "free_run": LIGHT, "energy": LIGHT}}
STAND = {"name": TEXT, "from_m": NUMBER, "to_m": NUMBER, "length_m": NUMBER, "stems_per_ha": NUMBER,
         "stools_per_ha": NUMBER, "trees_per_ha": NUMBER, "basal_area_m2_ha": NUMBER,
         "adc": {"rule": TEXT_OR_NULL, "adc_m": MAYBE, "gsteiger_stools_m": MAYBE, "gsteiger_stems_m": MAYBE,
                 "interception_m": MAYBE, "crofton_m": MAYBE},
         "passes_threshold": FLAG, "free_run_probability": NUMBER, "contacts": NUMBER, "energy_per_contact_J": MAYBE,
         "dissipated_kJ": NUMBER, "dissipated_kJ_per_100m": NUMBER, "warnings": [TEXT]}
SUMMARY = {"length_m": NUMBER, "longest_gap_m": NUMBER, "adc_m": MAYBE, "contacts": NUMBER,
           "meet_nothing_probability": NUMBER, "dissipated_kJ": NUMBER, "dissipated_kJ_per_100m": MAYBE,
           "passes_threshold": FLAG}
STOPS = {"p50": NUMBER, "p95": NUMBER, "max": NUMBER}
DIFFERENCES = ("reach_probability", "exceed_probability", "energy_per_released_kJ")
DIFFERENCE = {"option": TEXT, "against": TEXT, "x_m": NUMBER, **{name: PAIR for name in DIFFERENCES}}
RESULT = {"format": TEXT, "version": TEXT, "scene": TEXT, "title": TEXT, "seed": COUNT, "rocks": COUNT, "law": TEXT,
          "rock": {"mass_kg": NUMBER, "mean_diameter_m": NUMBER, "moment_kg_m2": NUMBER}, "threshold_m": NUMBER,
          "warnings": [TEXT],
          "options": [{"name": TEXT, "stands": [STAND], "summary": SUMMARY, "controls": [CONTROL],
                       "ends": {"stopped_by_stems": NUMBER, "came_to_rest": NUMBER, "left_slope": NUMBER,
                                "unfinished": COUNT},
                       "stop_x_m": STOPS}],
          "differences": [DIFFERENCE],
          "work": {"rocks_flown": COUNT, "contacts": COUNT, "stems_drawn": COUNT, "runs": COUNT, "runs_reused": COUNT,
                   "seconds": NUMBER}}


def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


KINDS = {NUMBER: is_number, MAYBE: lambda v: v is None or is_number(v),
         TEXT: lambda v: isinstance(v, str), TEXT_OR_NULL: lambda v: v is None or isinstance(v, str),
         FLAG: lambda v: isinstance(v, bool), FLAG_OR_NULL: lambda v: v is None or isinstance(v, bool),
         COUNT: lambda v: isinstance(v, int) and not isinstance(v, bool) and v >= 0, NULL: lambda v: v is None,
         LIGHT: lambda v: v in ("pass", "fail", "unknown")}


def expect_shape(value, shape, path="$"):
    """Exactly the keys and types of a shape."""
    if isinstance(shape, str):
        expect(KINDS[shape](value), f"{path}: {value!r} is no {shape}")
    elif isinstance(shape, list):
        expect(isinstance(value, list), f"{path}: {value!r} is no list")
        expect(shape or not value, f"{path}: {value!r} is not empty")
        for i, item in enumerate(value):
            expect_shape(item, shape[0], f"{path}[{i}]")
    elif shape is STOPS and value is None:
        return
    else:
        expect(isinstance(value, dict), f"{path}: {value!r} is no object")
        allowed = set(shape) | ({"measured_kJ"} if shape is INDEX else set())
        expect(set(shape) <= set(value) <= allowed,
               f"{path}: missing {sorted(set(shape) - set(value))}, too many {sorted(set(value) - allowed)}")
        for key in shape:
            expect_shape(value[key], shape[key], f"{path}.{key}")


def by_index(shape):
    """The shape of a run with contact_model index: nothing is known of the wood."""
    if shape is WOODED:
        return NULL
    if isinstance(shape, list):
        return [by_index(item) for item in shape]
    special = shape in (INDEX, STOPS) if isinstance(shape, dict) else True
    return shape if special else {key: by_index(inner) for key, inner in shape.items()}


INDEX_RESULT = by_index(RESULT)
MODEL = "simulation.contact_model"
MODELS = ("index", "poisson", "stems")


def through(model):
    """Options of the command line for a contact model."""
    return ("-s", f"{MODEL}={model}")


def expect_run(run, model="stems"):
    """The shape of a run, and what goes with it whatever the scene."""
    expect_shape(run, INDEX_RESULT if model == "index" else RESULT)
    for option in run["options"]:
        ends = option["ends"]
        expect_near(ends["stopped_by_stems"] + ends["came_to_rest"] + ends["left_slope"] +
                    ends["unfinished"] / run["rocks"], 1, 1e-12, "ends")
        stops = ends["stopped_by_stems"] + ends["came_to_rest"] > 0
        expect_equal(option["stop_x_m"] is not None, stops, "stop_x_m where rocks stop")
        if model == "index":
            expect_equal(ends["stopped_by_stems"], 0, "stopped by stems without stems")
        for control in option["controls"]:
            expect_equal(control["lights"]["energy"], energy_light(control), "energy light")
    expect_differences(run)


def energy_light(control):
    wooded = control["wooded"]
    if wooded is None or control["accepted_kJ"] is None:
        return "unknown"
    return "pass" if wooded["exceed_probability"] <= 0.05 else "fail"


def flown(control):
    """What is compared: through the wood, or by the index without it."""
    return control["wooded"] or control["bare"]


def expect_differences(run):
    """Option less baseline, one for each other option and control, in order."""
    baseline = run["options"][0]
    wanted = [(option, control, first) for option in run["options"][1:]
              for control, first in zip(option["controls"], baseline["controls"])]
    expect_equal(len(run["differences"]), len(wanted), "differences")
    for found, (option, control, first) in zip(run["differences"], wanted):
        where = f"{option['name']} at {control['x_m']} m"
        expect_equal((found["option"], found["against"], found["x_m"]), (option["name"], baseline["name"], control["x_m"]))
        for name in DIFFERENCES:
            values = [flown(c)[name] for c in (control, first)]
            values = [v["mean"] if isinstance(v, dict) else v for v in values]
            if values[0] is None:
                expect_equal(found[name], {"mean": None, "se": None}, f"{where}: {name}")
                continue
            size = max(1, *map(abs, values))
            expect_near(found[name]["mean"], values[0] - values[1], 1e-12 * size, f"{where}: {name}")
            expect(run["rocks"] < 2 or found[name]["se"] >= 0, where, found)
            if control["wooded"] is None:
                expect_equal(found[name], {"mean": 0, "se": 0}, f"{where}: {name} by the index")


def wilson(k, n):
    z = 1.959963984540054
    middle, half = k / n + z * z / (2 * n), z * math.sqrt(k / n * (1 - k / n) / n + z * z / (4 * n * n))
    return (middle - half) / (1 + z * z / n), (middle + half) / (1 + z * z / n)


def without_seconds(text):
    return re.sub(r'"seconds": [^}]*', "", text)


def test_json_shape():
    """JSON of the paper's site has exactly the promised keys and types"""
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
    expect_equal(control["lights"], {"contact": "pass", "free_run": "pass", "energy": "fail"})
    expect("measured_kJ" in control["index"], control["index"])
    expect_equal([s["name"] for s in run["options"][0]["stands"]], ["ADS 1", "ADS 2"])
    bare = result(PAPER, *through("index"))
    expect_run(bare, "index")
    other = bare["options"][0]["controls"][0]
    expect_equal(other["lights"], {"contact": "pass", "free_run": "pass", "energy": "unknown"}, "lights by the index")
    for name in ("bare", "index"):
        expect_equal(other[name], control[name], f"{name} does not depend on the contact model")
    expect_equal(result(PAPER, *through("stems"))["options"], run["options"], "stems is the default")


def test_json_shape_everywhere():
    """JSON keeps its shape on every shipped scene, and without measured speed there is no measured_kJ"""
    for path in sorted((PROFILES / "scenes").glob("*.yaml")):
        for model in MODELS:
            run = result(path, "-n", 50, *through(model))
            expect_run(run, model)
    for model, runs in (("index", 1), ("stems", 9)):
        run = result(FOUR, "-n", 50, *through(model))
        expect_equal(len(run["options"]), 8)
        expect(all("measured_kJ" not in c["index"] for o in run["options"] for c in o["controls"]), "measured_kJ")
        expect_equal((run["work"]["runs"], run["work"]["rocks_flown"]), (runs, 50 * runs), model)


def test_json_numbers_shortest():
    """JSON numbers are the shortest that read back"""
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
    """Residual energy beside the measured 62.337 kJ (Ciabocco, Boccia and Ripa 2009, Eq. 5)"""
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
    """Mean speed without forest beside the paper's Table 5 (Ciabocco, Boccia and Ripa 2009), 10^5 rocks"""
    bare = result(PAPER, "-n", 100000, *through("index"))["options"][0]["controls"][0]["bare"]
    speed, energy = bare["speed_m_s"], bare["energy_kJ"]
    expect_near(speed["mean"], 20.612, 4 * math.hypot(speed["se"], 0.005), "mean speed")
    expect_near(speed["sd"], 4.78, 0.05, "sd")
    expect_near(energy["mean"], 114.69, 4 * math.hypot(energy["se"], 0.05), "mean energy")
    expect_near(bare["reach_probability"], 0.9913, 0.002, "reach")
    expect_equal(bare["energy_kJ"], bare["translation_kJ"], "the law lumped knows no spin")


WOODED_GOLD = {"poisson": (66.75, 15.29, 0.839, 0.152), "stems": (62.06, 14.67, 0.832, 0.154)}


def test_golden_wooded():
    """Energy, speed, share that passes and share stopped through the wood of the paper's site, by both contact models"""
    n = 20000
    for model, (energy, speed, reach, stopped) in WOODED_GOLD.items():
        option = result(PAPER, "-n", n, *through(model))["options"][0]
        wooded = option["controls"][0]["wooded"]
        expect_near(wooded["energy_kJ"]["mean"], energy, 4 * math.hypot(wooded["energy_kJ"]["se"], 0.1), f"{model}: energy")
        expect_near(wooded["speed_m_s"]["mean"], speed, 4 * math.hypot(wooded["speed_m_s"]["se"], 0.005), f"{model}: speed")
        for found, wanted, what in ((wooded["reach_probability"], reach, "reach"),
                                    (option["ends"]["stopped_by_stems"], stopped, "stopped by stems")):
            expect_near(found, wanted, 4 * math.sqrt(wanted * (1 - wanted) / n) + 0.0005, f"{model}: {what}")


def test_statistics():
    """Intervals are Wilson's, percentiles rise, means over the released and over those that reached agree"""
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


# ---- CSV ----

def flat(prefix, shape):
    """Names of the cells of an object."""
    names = []
    for key, inner in shape.items():
        names += flat(f"{prefix}{key}.", inner) if isinstance(inner, dict) else [prefix + key]
    return names


SCENE_CELLS = ["scene", "title", "seed", "rocks", "law", "rock.mass_kg", "rock.mean_diameter_m", "rock.moment_kg_m2",
               "threshold_m", "option"]
CONTROL_CELLS = (SCENE_CELLS + flat("summary.", SUMMARY) + ["x_m", "name", "accepted_kJ"] + flat("bare.", ARRIVALS) +
                 flat("index.", INDEX) + ["index.measured_kJ"] + flat("wooded.", WOODED) +
                 ["lights.contact", "lights.free_run", "lights.energy",
                  "ends.stopped_by_stems", "ends.came_to_rest", "ends.left_slope", "ends.unfinished"] +
                 flat("stop_x_m.", STOPS) + flat("difference.", {k: PAIR for k in DIFFERENCES}) + ["warnings"])
STAND_CELLS = SCENE_CELLS + [n for n in flat("", STAND) if n != "warnings"] + ["warnings"]


def read_csv(text):
    rows = list(csv.reader(io.StringIO(text), strict=True))
    expect(all(len(row) == len(rows[0]) for row in rows), "rows of different length", [len(r) for r in rows])
    return rows[0], [dict(zip(rows[0], row)) for row in rows[1:]]


def look_up(mapping, name):
    for key in name.split("."):
        if mapping is None:
            return None
        mapping = mapping.get(key)
    return mapping


def expect_cell(cell, value, name):
    if value is None:
        expect_equal(cell, "", name)
    elif isinstance(value, bool):
        expect_equal(cell, "true" if value else "false", name)
    elif isinstance(value, str):
        expect_equal(cell, value, name)
    else:
        expect(cell != "" and float(cell) == value, f"{name}: found {cell!r}, wanted {value!r}")


def expect_rows(rows, runs, inner):
    """CSV rows hold what the JSON of the same runs holds. inner: 'controls' or 'stands'."""
    wanted = [(run, option, item) for run in runs for option in run["options"] for item in option[inner]]
    expect_equal(len(rows), len(wanted), "rows")
    for row, (run, option, item) in zip(rows, wanted):
        for name, cell in row.items():
            if name == "option":
                value = option["name"]
            elif name == "warnings":
                stands = option["stands"] if inner == "controls" else [item]
                value = "; ".join((run["warnings"] if inner == "controls" else []) +
                                  [w for s in stands for w in s["warnings"]])
            elif name in SCENE_CELLS:
                value = look_up(run, name)
            elif name.startswith("difference."):
                found = [d for d in run["differences"] if (d["option"], d["x_m"]) == (option["name"], item["x_m"])]
                value = look_up(found[0], name.removeprefix("difference.")) if found else None
            elif name.split(".")[0] in ("summary", "ends", "stop_x_m"):
                value = look_up(option, name)
            else:
                value = look_up(item, name)
            expect_cell(cell, value, f"{option['name']} {name}")


def test_csv_controls():
    """CSV: one header, a row each scene, option and control, values equal to JSON's"""
    more = ["-s", "controls=[{x_m: 40, name: 'a \"b\", c'}, {x_m: 152, accepted_kJ: 50}]", "-n", "300"]
    for model in ("index", "stems"):
        header, rows = read_csv(good("--batch", "-f", "csv", PAPER, FOUR, *more, *through(model)).out)
        expect_equal(header, CONTROL_CELLS)
        expect_equal(len(rows), 2 + 8 * 2)
        expect_rows(rows, results(PAPER, FOUR, *more, *through(model)), "controls")
        header, rows = read_csv(good("--batch", "-f", "csv", PAPER, *through(model)).out)
        expect_rows(rows, results(PAPER, *through(model)), "controls")
        expect(float(rows[0]["index.measured_kJ"]) > 62.33, rows[0]["index.measured_kJ"])
        empty = ("difference.", "wooded.") if model == "index" else ("difference.",)
        for name, cell in rows[0].items():
            group = name.split(".")[0] + "."
            expect(group not in ("difference.", "wooded.") or (cell == "") == (group in empty), f"{model}: {name}: {cell!r}")
        expect_in("Eq. 6", rows[0]["warnings"], "warnings")


def test_csv_null():
    """CSV: what does not exist is empty, as it is null in JSON: no accepted energy, nobody reaches, one rock"""
    with Folder() as f:
        path = f.write("s.yaml", wooded_scene(forest=None, options=[
            {"name": "thick", "forest": [belt(10, 95, shoots=[{"per_ha": 5000, "dbh_m": 0.3, "height_m": 20, "volume_m3": 9}])]},
            {"name": "none"}]))
        for rocks in (1, 300):
            run = result(path, "-n", rocks)
            expect_run(run)
            header, rows = read_csv(good("--batch", "-f", "csv", "-n", rocks, path).out)
            expect_equal(header, CONTROL_CELLS)
            expect_rows(rows, [run], "controls")
        expect_equal([rows[i]["wooded.exceed_probability"] == "" for i in range(4)], [True, False, True, False], "accepted_kJ")
        expect_equal([rows[i]["wooded.energy_kJ.mean"] == "" for i in range(4)], [True, True, False, False], "thick")
        expect_equal([rows[i]["stop_x_m.max"] == "" for i in range(4)], [False] * 4, "stop_x_m")
        expect_equal([rows[i]["difference.exceed_probability.mean"] == "" for i in range(4)], [True, True, True, False],
                     "difference")


def test_csv_stands():
    """CSV --rows stands: a row a stand, values equal to JSON's"""
    header, rows = read_csv(good("--batch", "-f", "csv", "--rows", "stands", PAPER, FOUR, "-n", "10").out)
    expect_equal(sorted(header), sorted(STAND_CELLS))
    expect_equal(len(rows), 2 + 8)
    expect_rows(rows, results(PAPER, FOUR, "-n", "10"), "stands")
    expect_equal(good("--batch", "-f", "csv", "--rows", "controls", PAPER).out,
                 good("--batch", "-f", "csv", PAPER).out, "--rows controls is the default")


# ---- the table ----

def expect_order(text, *parts):
    """The parts stand in the text in this order. Runs of blanks count as one."""
    plain, at = re.sub(r"\s+", " ", text), 0
    for part in parts:
        found = re.search(part, plain[at:])
        expect(found, f"/{part}/ is missing, or stands too early, in:", text)
        at += found.end()


def expect_width(text):
    long = [line for line in text.splitlines() if len(line) > 80]
    expect(not long, "lines of more than 80 columns:", *[f"{len(line)}: {line}" for line in long])


def digits(value, n):
    """A number of the page: so many significant digits, a dash where there is none."""
    if value is None:
        return "-"
    if value == 0:
        return "0"
    decimals = max(0, n - (math.floor(math.log10(abs(value))) + 1))
    return f"{value:.{decimals}f}"


def of_1000(lo_name, arrivals):
    """'991 (984–995)' of the page."""
    share, lo, hi = (arrivals[f"{lo_name}_{k}"] for k in ("probability", "lo", "hi"))
    return "-" if share is None else f"{share * 1000:.0f} ({math.floor(lo * 1000)}–{math.ceil(hi * 1000)})"


def table_row(text, name):
    """The lines of a table that begin with a name."""
    return [line for line in text.splitlines() if line.strip().startswith(name)]


def expect_cells(line, *cells):
    """A line of a table holds these cells, with a blank between any two."""
    wanted = r"\s+".join(re.escape(c).replace(r"\ ", " ") for c in cells)
    expect(re.search(rf"(^|\s){wanted}(\s|$)", line), f"'{'  '.join(cells)}' is missing in: {line!r}")


def section(text, name):
    """What the page says of one option."""
    lines = text.splitlines()
    first = next((i for i, line in enumerate(lines) if line == name), None)
    expect(first is not None, f"no option '{name}' in:", text)
    end = next((i for i in range(first + 1, len(lines)) if lines[i] and not lines[i].startswith(" ")), len(lines))
    return "\n".join(lines[first:end])


ARRIVALS_ROW = re.compile(r"^ {4}(?:through the wood|without forest) +(\d+ \(\d+–\d+\)) +(-|\d+ \(\d+–\d+\)) +"
                          r"(?:-|([\d.]+) ?±(-|[\d.]+)) +(-|[\d.e]+) +(-|[\d.e]+) +(-|[\d.e]+)$")


@functools.cache
def student(freedom):
    """The 97.5 % quantile of Student's law: its density, summed by Simpson's rule from 0 on, comes to 0.475 there."""
    scale = math.exp(math.lgamma((freedom + 1) / 2) - math.lgamma(freedom / 2)) / math.sqrt(freedom * math.pi)

    def density(t):
        return scale * (1 + t * t / freedom) ** (-(freedom + 1) / 2)

    step, t, total = 1e-3, 0.0, 0.0
    while total < 0.475:
        total += (density(t) + 4 * density(t + step / 2) + density(t + step)) * step / 6
        t += step
    return t - (total - 0.475) / density(t)


def half_of_mean(figure, count):
    """Half the width of the 95 % interval of a mean."""
    return figure["se"] * student(count - 1)


def expect_arrivals(line, arrivals):
    """A line of the table of arrivals has a blank between any two cells, and what it says of a mean and its error is true."""
    found = ARRIVALS_ROW.match(line)
    expect(found, "cells run into one another:", repr(line))
    reach, exceed, mean, half, p95, speed, height = found.groups()
    expect_equal((reach, exceed), (of_1000("reach", arrivals), of_1000("exceed", arrivals)), line)
    energy = arrivals["energy_kJ"]
    expect_equal(mean is None, energy["mean"] is None, line)
    if mean is not None and energy["se"] is not None:
        wanted = half_of_mean(energy, arrivals["rocks_reached"])
        expect(half != "-" and float(half) >= 0.94 * wanted, f"an error of {wanted} is said to be less:", line)
        expect(abs(float(mean) - energy["mean"]) <= float(half) + 1e-3 * energy["mean"],
               f"the mean of {energy['mean']} lies beyond its error:", line)
        unit = 10.0 ** -len(half.partition(".")[2])  # it is rounded up
        expect(float(half) <= max(1.1 * wanted, wanted + 1.001 * unit, 0.1 * energy["mean"]), f"an error of {wanted} is said to be far more:", line)
    for cell, value in ((p95, energy["p95"]), (speed, arrivals["speed_m_s"]["mean"]), (height, arrivals["height_m"]["p95"])):
        expect_equal(cell == "-", value is None, line)
        if value is not None:
            expect_near(float(cell), value, 0.051 * abs(value), line)


def expect_option(text, option):
    """The page of an option says what the JSON of the same run holds."""
    flat_text = re.sub(r"\s+", " ", text)
    bare = table_row(text, "without forest")
    wooded = table_row(text, "through the wood")
    expect_equal(len(bare), len(option["controls"]), "rows without forest")
    expect_equal(len(wooded), 0 if option["controls"][0]["wooded"] is None else len(option["controls"]), "rows through the wood")
    for i, control in enumerate(option["controls"]):
        expect_arrivals(bare[i], control["bare"])
        if not wooded:
            continue
        expect_arrivals(wooded[i], control["wooded"])
        shares = [f"{option['ends'][k] * 1000:.0f}" for k in ("stopped_by_stems", "came_to_rest", "left_slope")]
        expect_in("Of 1000, {} are stopped by stems, {} come to rest, {} leave the slope".format(*shares), flat_text, "ends")
        if control["wooded"]["rocks_reached"] > 0:
            hit = f"{control['wooded']['contacts']['mean']:.3g}"
            expect(re.search(rf"\b{re.escape(hit)} stems?\b", flat_text), f"'{hit} stems' is missing in:", text)
    words = {"pass": "passes", "fail": "FAILS", "unknown": "unknown"}
    for name, key in (("Contact", "contact"), ("Free run", "free_run"), ("Energy", "energy")):
        said = re.findall(rf"\b{name}: (\w+)\. (\S+)", flat_text)
        expect_equal([word for word, reason in said], [words[c["lights"][key]] for c in option["controls"]], name)
        expect(all(reason for _, reason in said), f"{name} without a reason", text)


def test_table_order():
    """Table of the paper's site: statements in their order, wooded first and bare below it, verdicts in words"""
    text, run = good("--batch", PAPER).out, result(PAPER)
    option = run["options"][0]
    control = option["controls"][0]
    expect_order(text, "Test site of Ciabocco et al. 2009", "Rock", "512.3 kg", "Slope", "current", "135 m", "through the wood",
                 "without forest 992", "896", "113.2", "Of 1000, ", "stopped by stems", "come to rest", "leave the slope", "stems",
                 "Contact: passes", "30 m", "Free run: passes", "Energy: FAILS", "of 1000 arrive with more than 50 kJ",
                 "50 are allowed", "ADS 1", "1.95 yes", "ADS 2", "2.61 yes", "interception", "gsteiger-stools 3.04 m",
                 "gsteiger-stems 1.49 m", "crofton 2.17 m", "(?i)by the index", "53.8 kJ",
                 "39.9 kJ per 100 m \\(interception\\)", "Eq. 5", "59.4 kJ", "62.3 kJ", "(?i)one rock", "Blocks of other sizes",
                 "Eq. 6 gives 2.61 m", "Assumed")
    expect_option(text, option)
    for line, arrivals in ((table_row(text, "through the wood")[0], control["wooded"]),
                           (table_row(text, "without forest")[0], control["bare"])):
        energy = arrivals["energy_kJ"]
        expect_cells(line, f"{digits(energy['mean'], 4)} ±{digits(half_of_mean(energy, arrivals['rocks_reached']), 2)}", digits(energy["p95"], 3),
                     digits(arrivals["speed_m_s"]["mean"], 3), digits(arrivals["height_m"]["p95"], 2))
    expect_in(f"Energy: FAILS. {of_1000('exceed', control['wooded'])} of 1000 arrive with more than 50 kJ",
              re.sub(r"\s+", " ", text), "the energy light's reason")
    expect_in("bears 50 kJ*", text, "mark of the assumed accepted energy")
    expect_width(text)


def test_table_order_index():
    """Table of the paper's site by the index: no figure through the wood, the index labelled, the energy light unknown"""
    text, run = good("--batch", *through("index"), PAPER).out, result(*through("index"), PAPER)
    expect_order(text, "Test site of Ciabocco et al. 2009", "Rock", "512.3 kg", "Slope", "current", "135 m", "without forest 992",
                 "896", "113.2", "Contact: passes", "Free run: passes", "Energy: unknown", "index", "ADS 1", "1.95 yes", "ADS 2",
                 "2.61 yes", "gsteiger-stools 3.04 m", "(?i)by the index \\(Eq. 4, interception\\) stems could take 53.8 kJ",
                 "39.9 kJ per 100 m", "left \\(Eq. 5\\): 113.2 − 53.8 = 59.4 kJ", "62.3 kJ", "(?i)one rock", "Eq. 6 gives 2.61 m")
    expect_option(text, run["options"][0])
    expect("through the wood" not in text and "stopped by stems" not in text, "what no rock flew through is told", text)
    expect_width(text)


def test_table_width():
    """Tables of all shipped scenes and of long names stay within 80 columns"""
    for path in sorted((PROFILES / "scenes").glob("*.yaml")):
        for law in ("lumped", "crsp"):
            expect_width(good("--batch", "-n", 200, "-s", f"simulation.law={law}", path).out)
    words = "a very long name that says all there is to say about it and then a little more, so that it must be cut "
    text = good("--batch", "-n", 50, FOUR, "-s", f"title={words * 2}", "-s", f"options[0].name={words * 2}", "-s",
                f"controls[0].name={words}", "-s", f"options[1].forest[0].stand.name={words}", "-s",
                "simulation.threshold_m=12.345").out
    expect_width(text)


def test_table_width_survey():
    """Table in survey coordinates stays within 80 columns"""
    far = scene(slope={"vertices_m": [[480000, 64], [480100, 0]], "segments": [{"rn": 0.3, "rt": 0.8}]},
                release={"vx_m_s": 1}, controls=[{"x_m": 480075.125, "accepted_kJ": 20, "name": "road"}],
                forest=[{"from_m": 480010.125, "to_m": 480070.375, "stand": stand(name="an old coppice of hornbeam")}])
    with Folder() as f:
        expect_width(good("--batch", f.write("far.yaml", far)).out)


def side_by_side(text, names):
    """The table of the options and the sentences below it: {name: its line}, all of them joined."""
    lines = text[text.lower().index("\nside by side"):].split("\n\n")[0].strip().splitlines()
    head = next(i for i, line in enumerate(lines) if line.strip().startswith("option"))
    rows = lines[head + 1:head + 1 + len(names)]
    for name, row in zip(names, rows):
        shown = re.split(r" {2,}|…", row.strip())[0].rstrip("…")
        expect(shown and name.startswith(shown), f"{name!r} is not the name of {row!r}")
    return lines[head], dict(zip(names, rows)), " ".join(" ".join(lines[head + 1 + len(names):]).split())


def test_table_options():
    """Table of the four systems: each option, then side by side with the differences, what does not separate them said"""
    text, run = good("--batch", "-n", 500, FOUR).out, result(FOUR, "-n", 500)
    names = [o["name"] for o in run["options"]]
    expect_order(text, *[re.escape(n) for n in names], "(?i)side by side")
    for option in run["options"]:
        expect_option(section(text, option["name"]), option)
    head, rows, words = side_by_side(text, names)
    expect_in("> 50 kJ", head, "head")
    for name, word in (("simple coppice, just cut", "FAIL"), ("simple coppice, 25 years", "pass"),
                       ("large reserves, just cut", "FAIL")):
        expect(re.search(rf"[\d.]+ {word}\b", rows[name]), f"no {word} of contact", rows[name])
    for option in run["options"]:
        wooded = option["controls"][0]["wooded"]
        share = wooded["exceed_probability"]
        half = math.ceil(1959.963984540054 * math.sqrt(share * (1 - share) / run["rocks"]))
        expect_cells(rows[option["name"]], f"{share * 1000:.0f} ±{half}")
        expect(rows[option["name"]].endswith({"pass": "pass", "fail": "FAIL"}[option["controls"][0]["lights"]["energy"]]),
               "the energy light is not the last", rows[option["name"]])
    for difference in run["differences"]:
        d = difference["exceed_probability"]
        expect_cells(rows[difference["option"]], f"{d['mean'] * 1000:+.0f} ±{math.ceil(d['se'] * 1959.963984540054)}")
    expect_in("No option passes the test of energy: it does not separate them", words, "what does not separate them")
    expect_in("By contact and by energy 'simple coppice, 25 years' is best", words, "the best by both")
    expect_width(text)
    same = good("--batch", "-n", 50, FOUR, "--option", "large reserves", "--option", "coppice with standards").out
    expect_order(same, "(?i)all options pass the test of contact: it does not separate")


def test_table_options_index():
    """Table of the four systems by the index: what does not separate them said, no winner named"""
    text = good("--batch", "-n", 500, *through("index"), FOUR).out
    names = [o["name"] for o in result(FOUR, "-n", 1)["options"]]
    expect_order(text, *[re.escape(n) for n in names], "(?i)side by side", "(?i)does not separate")
    head, rows, words = side_by_side(text, names)
    for name, word in (("simple coppice, just cut", "FAIL"), ("simple coppice, 25 years", "pass"),
                       ("large reserves, just cut", "FAIL")):
        expect(re.search(rf"[\d.]+ {word}\b", rows[name]), f"no {word} of contact", rows[name])
    expect_in("The index says what stems could take, not what a rock loses", words)
    expect(not re.search(r"(?i)\b(winner|best|recommended|worst option|rank)\b", text), "a winner is named:", text)
    expect(re.search(r"kJ/100 m +left kJ", head), "heads run into one another:", head)
    expect("±" not in "".join(rows.values()), "an error of what was not flown", rows)


THIN = {"name": "thin", "species": "ostrya-carpinifolia", "stools": {"per_ha": 2000, "spacing_m": 0.25},
        "shoots": [{"per_ha": 8000, "dbh_m": 0.02, "height_m": 6, "volume_m3": 0.0001}], "energy": {"u_J_m3": 100000}}
THICK = {"name": "thick", "species": "ostrya-carpinifolia",
         "trees": [{"per_ha": 300, "dbh_m": 0.4, "height_m": 18, "volume_m3": 1}], "energy": {"u_J_m3": 100000}}


def treated(**stands):
    """A scene with one option for each stand, of the same name; None is no forest."""
    return wooded_scene(forest=None, options=[
        {"name": name.replace("_", " "), "forest": [{"from_m": 0, "to_m": 105, "stand": st}] if st else []}
        for name, st in stands.items()])


def best_sentence(folder, scene_mapping, *arguments):
    path = folder.write("s.yaml", scene_mapping)
    names = [o["name"] for o in result(path, "-n", 2, *arguments)["options"]]
    return side_by_side(good("--batch", path, *arguments).out, names)[2]


def test_table_best():
    """Table: which option is best by contact and by energy, both where they differ, neither where none is clearly better"""
    with Folder() as f:
        words = best_sentence(f, treated(many_thin=THIN, few_thick=THICK))
        expect_in("By contact 'many thin' is best, by energy 'few thick'; neither alone decides", words)
        words = best_sentence(f, treated(few_thick=THICK, many_thin=THIN))
        expect_in("By contact 'many thin' is best, by energy 'few thick'; neither alone decides", words, "in another order")
        words = best_sentence(f, treated(none=None, few_thick=THICK))
        expect_in("By contact and by energy 'few thick' is best", words)
        words = best_sentence(f, treated(none=None, many_thin=THIN))  # which hardly take anything
        expect_in("By contact 'many thin' is best, and none is clearly better by energy", words)
        words = best_sentence(f, treated(many_thin=THIN, few_thick=THICK), *through("index"))
        expect("best" not in words, words)
        hardly = {**THICK, "trees": [{"per_ha": 301, "dbh_m": 0.4, "height_m": 18, "volume_m3": 1}]}
        words = best_sentence(f, treated(few_thick=THICK, hardly_more=hardly), "-n", 300)
        expect_in("By contact 'hardly more' is best", words)
        expect(re.search("and by energy|none is clearly better by energy", words), "an energy that chance decided", words)
        words = best_sentence(f, treated(none=None, also_none=None))
        expect("best" not in words, "the best of two that have no forest", words)
        weak = {**THICK, "trees": [{**THICK["trees"][0], "volume_m3": 0.001}]}  # stems as thick: the same ADC
        for order in ({"weak": weak, "strong": THICK, "none": None}, {"strong": THICK, "none": None, "weak": weak}):
            words = best_sentence(f, treated(**order))
            expect_in("By contact and by energy 'strong' is best", words, "contact does not tell weak from strong")
        words = best_sentence(f, treated(weak=weak, strong=THICK))
        expect_in("By energy 'strong' is best; contact does not tell the options apart", words)
        words = best_sentence(f, treated(weak=weak, strong=THICK, as_strong=THICK))
        expect_in("By energy 'strong' is best, though not clearly before all others; contact does not tell", words)
        words = best_sentence(f, treated(many_thin=THIN, few_thick=THICK, as_thick=THICK))
        expect_in("By contact 'many thin' is best, by energy 'few thick', though not clearly before all others", words)
        words = best_sentence(f, {**treated(none=None, few_thick=THICK), "controls": [{"x_m": 110, "accepted_kJ": 1e6}]})
        expect_in("By contact 'few thick' is best, and none is clearly better by energy", words, "nothing comes with so much")


def columns(line):
    return sum(2 if unicodedata.east_asian_width(c) in "WF" else 1 for c in line)


def test_table_widest():
    """Table: words longer than a line, wide characters and huge numbers keep its columns, 80 of them"""
    wide, word = "一二三四五六七八九十" * 8, "x" * 300
    text = good("--batch", "-n", 50, "-s", f"title={word}", "-s", f"options[0].name={wide}", "-s", "controls[0].x_m=134.123456789",
                "-s", "controls[0].accepted_kJ=123456", "-s", "rock={diameter_m: 20}", FOUR).out
    expect(max(map(columns, text.splitlines())) <= 80, *(line for line in text.splitlines() if columns(line) > 80))
    flat = "".join(text.split())
    expect(word in flat and wide in flat, "cut short:", text)
    rows = re.findall(r"^    (?:through the wood|without forest) .*$", text, re.M)
    expect(all(re.search(r" \(\d\.\d±\d\.\d\)e6 +\de6 ", row) for row in rows), "mean energies", *rows)
    head, *table = text.split("Side by side")[1].splitlines()[2:]
    names = [name for name in (wide[:9], "large reserves") if not any(name in row for row in table)]
    expect(not names, "rows of", names, head, *table)
    expect(len({columns(row) for row in table if re.search(r"(pass|FAIL)$", row)}) == 1, "columns that do not align", *table)
    expect_in("> 123 MJ", head, "limit")


def cells_of_rows(text):
    """What stands in the rows of arrivals behind the shares: mean, 95 %, m/s, m up."""
    rows = re.findall(r"^    (?:through the wood|without forest) .*$", text, re.M)
    expect(rows, "no rows", text)
    return [row[52:].strip().rsplit(None, 3) for row in rows]


def test_table_small():
    """Table: small figures have a blank before them and are not cut"""
    slope = {"vertices_m": [[0, 0], [100, -60]], "segments": [{"rn": 0.05, "rt": 0.95, "roughness_rad": 0.1, "friction": 0.1}]}
    with Folder() as f:
        path = f.write("s.yaml", scene(slope=slope, release={"vx_m_s": 2}, controls=[{"x_m": x} for x in (2, 20, 90)]))
        for diameter in (1, 0.1, 0.03, 0.01, 0.003, 0.001, 1e-4):
            orders = ["-n", 60, "-s", f"rock.diameter_m={diameter}", path]
            controls = [a for c in result(*orders)["options"][0]["controls"] for a in (c["wooded"], c["bare"])]
            found = cells_of_rows(good("--batch", *orders).out)
            expect_equal(len(found), len(controls), "rows")
            for cells, a in zip(found, controls):
                expect(len(cells) == 4 and "…" not in "".join(cells), f"diameter {diameter}: {cells}")
                for cell, value in zip(cells[1:], (a["energy_kJ"]["p95"], a["speed_m_s"]["mean"], a["height_m"]["p95"])):
                    shown, _, power = cell.partition("e")
                    place = 10.0 ** (int(power or 0) - len(shown.partition(".")[2]))
                    expect_near(float(cell), value, 0.51 * place, f"diameter {diameter}: {cells}")


def test_table_one_rock():
    """Table: of one rock no error is known, whatever it weighs and however it is compared: a dash"""
    for rock in ("{diameter_m: 0.5}", "{diameter_m: 20}", "{diameter_m: 500}", "{diameter_m: 0.001}"):
        text = good("--batch", "-n", 1, "-s", f"rock={rock}", FOUR).out
        expect(not re.search(r"\bnan\b", text), re.findall(".*nan.*", text))
        expect(all("±-" in cells[0] for cells in cells_of_rows(text) if cells[0] != "-"), cells_of_rows(text))


def test_table_width_short():
    """Table of a slope of a millimetre stays within 80 columns"""
    with Folder() as f:
        path = f.write("short.yaml", scene(slope={"vertices_m": [[0, 0], [0.007693, -0.005387]],
                                                  "segments": [{"rn": 0.3, "rt": 0.8}]}, controls=[{"x_m": 0.001}]))
        expect_width(good("--batch", "-n", 5, path).out)


def test_accepted_as_given():
    """What a place bears comes back in JSON, CSV and on the page as its file says it"""
    given = [3.3, 2.3, 4.35, 0.007, 1.001, 8.2, 1e-3, 999.999, 123456.789]
    with Folder() as f:
        path = f.write("s.yaml", scene(controls=[{"x_m": 10 + i, "accepted_kJ": kJ} for i, kJ in enumerate(given)]))
        expect_equal([c["accepted_kJ"] for c in result("-n", 1, path)["options"][0]["controls"]], given, "JSON")
        rows = list(csv.DictReader(io.StringIO(good("--batch", "-f", "csv", "-n", 1, path).out)))
        expect_equal([row["accepted_kJ"] for row in rows], [f"{kJ:g}" if kJ < 1e3 else str(kJ) for kJ in given], "CSV")
        text = good("--batch", "-n", 1, path).out
        expect_equal([float(kJ) for kJ in re.findall("bears (.*) kJ", text)], given, "the page")
        expect_in(" > 3.3 kJ ", text, "head")


def test_table_splinter():
    """Table: a rock so thin that its volume is next to 0 has no other sizes, and all else of its page"""
    with Folder() as f:
        path = f.write("s.yaml", scene(rock={"shape": "ellipsoid", "axes_m": [1e-320, 1, 1], "mass_kg": 50}))
        text = good("--batch", "-n", 5, path).out
        expect_in("through the wood", text)
        expect("Blocks of other sizes" not in text, text)


def test_table_warnings_once():
    """Table: what belts of one stand have in common is warned of once an option"""
    text = good("--batch", "-n", 10, "staggered").out
    warnings = re.findall(r"^    ! .*(?:\n      .*)*", text, re.M)
    options = text.count("Contact: ")
    expect(0 < len(warnings) <= options, f"{len(warnings)} warnings of {options} options", *warnings)


def test_table_of_none():
    """Table: of no rock among n with too much energy, and of no difference between such, the error is that of Wilson, never 0"""
    with Folder() as f:
        path = f.write("s.yaml", {**treated(few_thick=THICK, none=None), "controls": [{"x_m": 110, "accepted_kJ": 1e6}]})
        rows = side_by_side(good("--batch", "-n", 200, path).out, ["few thick", "none"])[1]
        half = math.ceil(1000 * 1.959963984540054**2 / (200 + 1.959963984540054**2))
        expect_cells(rows["few thick"], f"0 ±{half}")
        expect_cells(rows["none"], f"0 ±{half}", f"+0 ±{half}")


def test_table_best_gap():
    """Table: an option with a gap beyond the threshold, which fails by contact, is not the best by contact"""
    with Folder() as f:
        path = f.write("gap.yaml", wooded_scene(forest=None, options=[
            {"name": "a strip", "forest": [{"from_m": 0, "to_m": 10, "stand": stand(stools={"per_ha": 4000, "spacing_m": 0.25})}]},
            {"name": "whole way", "forest": [belt(0, 105)]}]))
        lights = [o["controls"][1]["lights"]["contact"] for o in result(path)["options"]]
        expect_equal(lights, ["fail", "pass"], "contact")
        words = side_by_side(good("--batch", path).out, ["a strip", "whole way"])[2]
        expect("By contact 'a strip'" not in words and "By contact and by energy 'a strip'" not in words, words)


def test_table_best_same():
    """Table: of options that are the same none is called the best"""
    with Folder() as f:
        words = best_sentence(f, treated(one=THICK, other=THICK))
        expect("best" not in words, words)


def test_table_lights():
    """Table: every light with its reason: no forest, a gap, a thin belt, nothing said of what a place bears, the index"""
    def said(*arguments, scene_mapping=None, where=-1):
        with Folder() as f:
            text = good("--batch", f.write("s.yaml", scene_mapping or wooded_scene()), *arguments).out
            flat_text = re.sub(r"\s+", " ", text)
            return {name: re.findall(rf"\b{name}: (.*?\.) (?=Free run:|Energy:|At |m stand|By the index)", flat_text)[where]
                    for name in ("Contact", "Free run", "Energy")}
    lights = said()
    expect(re.fullmatch(r"passes\. Every belt has an ADC below 30 m \([\d.]+ m at most\) and no gap is longer\.",
                        lights["Contact"]), lights)
    expect(re.fullmatch(r"passes\. Chance of 30 m without a contact at worst [\d.]+ % \(10 % is allowed\)\.",
                        lights["Free run"]), lights)
    expect(re.fullmatch(r"FAILS\. \d+ \(\d+–\d+\) of 1000 arrive with more than 60 kJ \(50 are allowed\)\.",
                        lights["Energy"]), lights)
    lights = said("-s", "controls[1].accepted_kJ=1000")
    expect(re.fullmatch(r"passes\. 0 \(0–\d+\) of 1000 arrive with more than 1000 kJ \(50 are allowed\)\.", lights["Energy"]),
           lights)
    expect(re.match(r"unknown\. .*not said what the place bears \(accepted_kJ\)", said(where=0)["Energy"]), "no accepted_kJ")
    expect(re.match(r"unknown\. The index .*contact_model: index", said(*through("index"))["Energy"]), "index")
    lights = said("-s", "forest=[]")
    expect(re.match(r"FAILS\. There is no forest", lights["Contact"]) and re.match(r"FAILS\. No stem", lights["Free run"]), lights)
    expect(lights["Energy"].startswith("FAILS. "), "the energy light where no forest is", lights)
    lights = said("-s", "forest[0].from_m=50")
    expect(re.match(r"FAILS\. A gap of 50 m has no forest; .* 30 m", lights["Contact"]), lights)
    lights = said(scene_mapping=wooded_scene(forest=[{"from_m": 0, "to_m": 105, "stand": {**THICK, "trees": [
        {**THICK["trees"][0], "per_ha": 60}]}}]))
    expect(re.match(r"FAILS\. A belt has an ADC of 145 m; .* 30 m", lights["Contact"]), lights)
    expect(re.match(r"FAILS\. Chance of 30 m without a contact at worst 81\.3 % \(10 % is allowed\)", lights["Free run"]), lights)


def test_table_close_call():
    """The energy light is called close where its interval holds 50 of 1000, in the table, in JSON and in CSV; else not"""
    with Folder() as f:
        path = f.write("s.yaml", wooded_scene(controls=[{"x_m": 105, "accepted_kJ": 60}]))
        energies = result(path)["options"][0]["controls"][0]["wooded"]
        seen = set()
        for accepted in (10, energies["energy_kJ"]["p95"], 1.1 * energies["energy_kJ"]["max"]):
            change = ("-s", f"controls[0].accepted_kJ={accepted}")
            run = result(path, *change)
            wooded = run["options"][0]["controls"][0]["wooded"]
            close = wooded["exceed_lo"] <= 0.05 < wooded["exceed_hi"]
            seen.add(close)
            expect_run(run)
            expect_equal(sum("close to call" in w for w in run["warnings"]), close, run["warnings"])
            if close:
                warning = next(w for w in run["warnings"] if "close to call" in w)
                expect("105 m" in warning and "50 of 1000" in warning, "place and limit", warning)
            expect_equal("lose to call" in re.sub(r"\s+", " ", good("--batch", path, *change).out), close, "table")
            _, rows = read_csv(good("--batch", "-f", "csv", path, *change).out)
            expect_equal("close to call" in rows[0]["warnings"], close, "CSV")
            expect(not result(path, *change, *through("index"))["warnings"], "a close call by the index")
        expect_equal(seen, {True, False}, "close and clear calls")


BLOCK = re.compile(r"^ {2}([> ]) +([\d.]+) +([\d.]+) +([\d.]+) +([\d.]+|none) +([\d.]+) +(-|\d+ \(\d+–\d+\))$")


def blocks_of(text):
    """The table of blocks of other sizes: [(own, volume, mass, diameter, ADC, contacts, of 1000)]."""
    lines = text.splitlines()
    first = next(i for i, line in enumerate(lines) if "Blocks of other sizes" in line)
    first = next(i for i in range(first, len(lines)) if lines[i].split()[:2] == ["m3", "kg"]) + 1
    rows = []
    for line in lines[first:]:
        found = BLOCK.match(line)
        if not found:
            break
        own, *numbers, share = found.groups()
        rows.append((own == ">", *(math.inf if n == "none" else float(n) for n in numbers), share))
    return rows


def test_table_blocks():
    """Table of blocks of other sizes: five, rising, this scene's marked and like the run, larger ones meet and carry more"""
    for arguments, own in (((), 0.197), (("-s", "rock.diameter_m=0.2", "-s", "rock.height_m=0.2"), 0.00628),
                           (("-s", "rock.diameter_m=3", "-s", "rock.height_m=3"), 21.2)):
        text, run = good("--batch", PAPER, *arguments).out, result(PAPER, *arguments)
        rows = blocks_of(text)
        expect_equal(len(rows), 5, "rows\n" + text)
        expect_equal(sorted(r[1] for r in rows), [r[1] for r in rows], "volumes rise")
        expect_equal([r[1] for r in rows if not r[0]], [0.05, 0.2, 1, 5], "volumes")
        mine = next(r for r in rows if r[0])
        option, rock = run["options"][0], run["rock"]
        expect_equal(mine[1], own, "this scene's volume")
        expect_equal(mine[2:4], (float(digits(rock["mass_kg"], 3)), float(digits(rock["mean_diameter_m"], 3))), "mass, diameter")
        expect_equal(mine[4], float(digits(max(s["adc"]["adc_m"] for s in option["stands"]), 3)), "ADC")
        expect_equal(mine[5], float(digits(option["summary"]["contacts"], 3)), "contacts")
        expect_equal(mine[6], of_1000("exceed", option["controls"][0]["wooded"]), "share")
        for a, b in zip(rows, rows[1:]):
            expect(a[4] >= b[4] and a[5] <= b[5], "a larger block meets more", a, b)
        shares = [int(r[6].split()[0]) for r in rows]
        expect(shares == sorted(shares) and shares[-1] > shares[0], "a larger block carries more", shares)


def test_table_blocks_cases():
    """Table of blocks: of each option, without forest, without an accepted energy, by the index"""
    with Folder() as f:
        path = f.write("s.yaml", treated(thick=THICK, none=None))
        run, text = result(path), good("--batch", path).out
        for option in run["options"]:
            rows = blocks_of(section(text, option["name"]))
            expect_equal(len(rows), 5, option["name"])
            mine = next(r for r in rows if r[0])
            expect_equal(mine[6], of_1000("exceed", option["controls"][1]["wooded"]), option["name"])
        expect(all(r[4] == math.inf and r[5] == 0 for r in blocks_of(section(text, "none"))), text)
        text = good("--batch", path, *through("index")).out
        expect(all(r[6] == "-" for r in blocks_of(section(text, "thick"))), "a share by the index", text)
        path = f.write("s.yaml", wooded_scene(controls=[{"x_m": 105}]))
        text = good("--batch", path).out
        expect_in("arrive", text[text.index("Blocks of"):], "head")
        mine = next(r for r in blocks_of(text) if r[0])
        expect_equal(mine[6], of_1000("reach", result(path)["options"][0]["controls"][0]["wooded"]), "that arrive")


def test_table_arrivals():
    """Table of arrivals: whatever the figures, each cell whole and apart from the next; sign and size survive"""
    cases = [scene(forest=[{"from_m": 0, "to_m": 75, "stand": THIN}], controls=[{"x_m": 40}, {"x_m": 75, "accepted_kJ": 0.1}]),
             wooded_scene(rock={"diameter_m": 8}), wooded_scene(rock={"diameter_m": 0.05}),
             wooded_scene(controls=[{"x_m": 105, "accepted_kJ": 123456.789}]), wooded_scene(simulation={"rocks": 1}),
             wooded_scene(simulation={"rocks": 3}), wooded_scene(simulation={"law": "crsp"})]
    with Folder() as f:
        for mapping in cases:
            path = f.write("s.yaml", mapping)
            run, text = result(path), good("--batch", path).out
            expect_option(text, run["options"][0])
            expect_width(text)
            expect_equal(len(blocks_of(text)), 5, "blocks of other sizes")


def test_table_verdicts():
    """Table says failed tests and used up energy in words, never 0 kJ left"""
    text = good("--batch", PAPER, "-s", "forest[0].to_m=30", "-s", "forest[1].from_m=90").out
    expect_order(text, "Contact: FAILS", "(?i)gap", "60 m")
    for model in MODELS:
        text = good("--batch", PAPER, "-s", "forest[0].stand.shoots[0].volume_m3=1", *through(model)).out
        expect_order(text, "(?i)used up on average", "(?i)some rocks still pass")
        expect(not re.search(r"= 0(\.0*)? kJ", text), text)


def test_table_assumed():
    """Table marks what is assumed, and only that"""
    with Folder() as f:
        plain = scene(controls=[{"x_m": 75, "accepted_kJ": 50}], rock={"diameter_m": 0.5, "density_kg_m3": 2600})
        text = good("--batch", f.write("plain.yaml", plain)).out
        expect("*" not in text and "ssumed" not in text, text)
        note = {"kind": "assumed", "text": "guessed by eye"}
        marked = scene(rock={"diameter_m": 0.5, "source": note}, controls=[{"x_m": 75, "accepted_kJ": 50, "source": note}],
                       forest=[{"from_m": 10, "to_m": 60, "stand": stand(source=note)}])
        text = good("--batch", f.write("marked.yaml", marked)).out
        expect_order(text, r"Rock[^*]*m\*", r"50 kJ\*", r"coppice\*", r"\* Assumed", "guessed by eye")


def test_table_changed():
    """A value changed by -s no longer has the source around it, and what is listed says so; no figure changes by that"""
    note = {"kind": "assumed", "text": "all a guess"}
    with Folder() as f:
        path = f.write("s.yaml", scene(controls=[{"x_m": 75, "accepted_kJ": 50, "source": note}, {"x_m": 80, "source": note}]))
        for change, said in (("accepted_kJ=60", "; changed since: accepted_kJ"), ("accepted_kJ=50", ""), ("name=road", ""),
                             ("source={kind: assumed}", "")):
            text = " ".join(good("--batch", path, "-s", f"controls[0].{change}").out.split())
            expect_in(f"all a guess{said} (controls[", text, change)
        for change, star in (("x_m=70", "50 kJ*"), ("accepted_kJ=50", "50 kJ*"), ("accepted_kJ=60", "60 kJ\n")):
            expect_in(f"bears {star}", good("--batch", path, "-s", f"controls[0].{change}").out, "its star")
        twice = good("--batch", path, "-s", "controls[0].accepted_kJ=60", "-s", "controls[0].x_m=70", "-s", "controls[0].x_m=71")
        expect_in("all a guess; changed since: accepted_kJ, x_m (controls[0])", " ".join(twice.out.split()))
        whole = good("--batch", path, "-s", "controls=[{x_m: 75, accepted_kJ: 60}]").out
        expect("guess" not in whole, whole)
        plain = f.write("plain.yaml", scene(controls=[{"x_m": 75, "accepted_kJ": 60}, {"x_m": 80}]))
        expect_equal(result(path, "-s", "controls[0].accepted_kJ=60")["options"], result(plain)["options"], "figures")
        # the innermost source alone is told; in a list the whole of it; settings have no source
        path = f.write("s.yaml", scene(source={"kind": "assumed", "text": "outer"}, forest=[
            {"from_m": 10, "to_m": 60, "source": {"kind": "assumed", "text": "belt"}, "stand": stand(source=note)}]))
        text = " ".join(good("--batch", path, "-s", "forest[0].stand.stools.per_ha=1000", "-s",
                             "forest[0].stand.trees[0].per_ha=9", "--seed", 5, "-s", "controls[0].x_m=70").out.split())
        for words in ("outer; changed since: controls (the scene)", "belt (forest[0])",
                      "all a guess; changed since: stools.per_ha, trees (forest[0].stand)"):
            expect_in(words, text)


def test_table_talus():
    """A bare CSV slope takes talus and says that it is assumed"""
    with Folder() as f:
        f.write("line.csv", "distance,elevation\n0,64\n50,30\n100,0\n")
        path = f.write("csv.yaml", scene(slope="line.csv"))
        expect_in("talus is assumed", good("--batch", path).out.replace("\n", " "), "table")
        expect_in("talus", result(path)["warnings"][0], "JSON warnings")
        mapping = f.write("map.yaml", scene(slope={"csv": "line.csv", "materials": [
            {"from_m": 0, "to_m": 100, "material": "talus"}]}))
        run, other = result(path), result(mapping)
        expect_equal(other["warnings"], [])
        expect_equal(run["options"], other["options"], "talus")


# ---- overriding ----

def test_set_rock_and_order():
    """-s goes left to right and is checked like the file"""
    expect_near(result(PAPER, "-n", 1, "-s", "rock.diameter_m=1")["rock"]["mean_diameter_m"], 0.9, 1e-12, "B")
    run = result(PAPER, "-n", 1, "-s", "rock.diameter_m=1", "-s", "rock.diameter_m=0.56", "--seed", 7, "-s",
                 "simulation.seed=8")
    expect_equal((run["rock"]["mean_diameter_m"], run["seed"]), (0.68, 8))
    expect_equal(result(PAPER, "-n", 1, "-s", "simulation.seed=8", "--seed", 7)["seed"], 7)
    expect_equal(result(PAPER, "-s", "simulation.rocks=5")["rocks"], 5)
    expect_equal(result(PAPER, "-s", "title='x: y'", "-n", 1)["title"], "x: y")
    controls = result(PAPER, "-n", 1, "-s", "controls=[{x_m: 100}, {x_m: 20}]")["options"][0]["controls"]
    expect_equal([c["x_m"] for c in controls], [100, 20], "controls in the order given")


def test_set_through_files():
    """-s goes through file references, by [i] and by [name], and changes that place only"""
    def stools(*arguments):
        return [[s["stools_per_ha"] for s in o["stands"]] for o in result(*arguments, "-n", 1)["options"]]
    before = {p: p.read_bytes() for p in PROFILES.rglob("*.yaml")}
    expect_equal(stools(PAPER, "-s", "forest[0].stand.stools.per_ha=2000"), [[2000, 2807]])
    expect_equal(stools(PAPER, "-s", "forest[ADS 2].stand.stools.per_ha=2000"), [[3688, 2000]])
    expect_equal(stools(PAPER, "-s", "forest[ADS 2].stand.stools.per_ha=2000", "-s",
                        "forest[ADS 1].stand.stools.per_ha=1000"), [[1000, 2000]])
    expect_equal(stools(PAPER, "-s", "forest[1].stand=../stands/ads-1.yaml"), [[3688, 3688]])
    stands = result(PAPER, "-n", 1, "-s", "forest[0].stand.trees[0].per_ha=120")["options"][0]["stands"]
    expect_equal([s["trees_per_ha"] for s in stands], [120, 542])
    run = result(PROFILES / "scenes/selection-or-standards.yaml", "-n", 1, "-s",
                 "options[standards, all just cut].forest[0].stand.trees[0].per_ha=333")
    found = [[s["trees_per_ha"] for s in o["stands"]] for o in run["options"]]
    expect(found[0][0] > 300 and found[1][0] < 300, "the second option starts from the same file", found)
    expect_equal(before, {p: p.read_bytes() for p in PROFILES.rglob("*.yaml")}, "files")
    speed = [result(PAPER, "-s", f"slope.segments[5].rn={rn}")["options"][0]["controls"][0]["bare"]["speed_m_s"]["mean"]
             for rn in (0.31, 0.9)]
    expect(speed[0] != speed[1] and speed[0] == result(PAPER)["options"][0]["controls"][0]["bare"]["speed_m_s"]["mean"],
           speed)


def test_set_at_odds():
    """A change that does not fit the rest of a good scene is named, with status 2; a bad scene stays bad input"""
    for sets, column, words in ((["forest[0].to_m=100"], 16, "forest[1].from_m: 67.5 lies before the end"),
                                (["release.x_m=140"], 13, "controls[0].x_m: 135 does not lie beyond the release"),
                                (["slope.vertices_m=[[0,100],[50,0]]"], 18, "13 segments for 1 stretches"),
                                (["rock.shape=sphere", "rock.diameter_m=1"], 12, "does not belong to the shape 'sphere'"),
                                (["simulation.rocks=9", "forest[0].to_m=100", "rock.diameter_m=1"], 16, "lies before the end")):
        done = ceduo("--check", *(word for s in sets for word in ("-s", s)), PAPER)
        culprit = next(s for s in sets if "=9" not in s)
        expect(done.status == USAGE and done.out == "", done)
        expect(done.err.startswith(f"--set:1:{column}: the scene is good without this change, but not with it:\n  {culprit}\n" +
                                   " " * (column + 1) + "^\n"), done)
        expect_in(words, done.err)
        expect_equal(done.err.count("--set:"), 1, done.err)
    both = ["-s", "forest[0].to_m=100", "-s", "forest[1].from_m=100"]  # either of them alone would not fit
    good("--check", *both, PAPER)
    with Folder() as f:
        path = f.write("s.yaml", scene(controls=[{"x_m": 500}]))
        done = ceduo("--check", "-s", "rock.diameter_m=1", path)
        expect(done.status == INPUT and "--set" not in done.err, done)


def test_set_by_name_twice():
    """-s refuses a name that several belts have, and names their places; it takes one that is there once"""
    with Folder() as f:
        belts = [{"from_m": x, "to_m": x + 9, "stand": stand(name=n)} for x, n in ((10, "a"), (20, "b"), (30, "a"), (40, "a"))]
        path = f.write("s.yaml", scene(forest=belts))
        good("--check", "-s", "forest[b].stand.trees[0].per_ha=1", path)
        good("--check", "-s", "forest[0].stand.trees[0].per_ha=1", path)
        bad_set_on(path, "forest[a].stand.trees[0].per_ha=1", "'a': this name is given more than once; take a place: [0], [2], [3]")
        bad_set_on(path, "forest[a]={}", "take a place: [0], [2], [3]")
        bad_set_on(path, "forest[c].to_m=1", "'c': no such item")


def bad_set_on(path, change, words):
    done = ceduo("--check", "-s", change, path)
    expect(done.status == USAGE and words in done.err, done)


def test_set_spreads():
    """-s makes a number a spread, whole or by its parts"""
    whole = result(PAPER, "-s", "rock.diameter_m={mean: 0.56, spread: 0.1, kind: uniform}")
    parts = result(PAPER, "-s", "rock.diameter_m.spread=0.1", "-s", "rock.diameter_m.kind=uniform")
    expect_equal(whole["options"], parts["options"])
    expect(whole["options"] != result(PAPER)["options"], "the spread changes nothing")
    expect_near(whole["rock"]["mean_diameter_m"], 0.68, 1e-12, "rock holds the means")
    expect_equal(result(PAPER, "-s", "rock.diameter_m.spread=0")["options"], result(PAPER)["options"], "spread 0")
    for path in ("release.vx_m_s", "release.vz_m_s", "slope.segments[2].rn", "slope.segments[2].rt"):
        expect(result(PAPER, "-s", f"{path}.spread=0.1")["options"] != result(PAPER)["options"], path)
    expect_in("means", good("--batch", PAPER, "-s", "rock.diameter_m.spread=0.05").out, "table")


def test_set_base():
    """-s reaches into a stand that starts from another; mappings merge, lists are replaced"""
    with Folder() as f:
        f.write("base.yaml", stand(ceduo="stand/1", name="base"))
        built = {"base": "base.yaml", "stools": {"per_ha": 1500}}
        path = f.write("s.yaml", scene(forest=[{"from_m": 10, "to_m": 60, "stand": built}]))
        def one(*sets):
            return result(path, "-n", 1, *[a for s in sets for a in ("-s", s)])["options"][0]["stands"][0]
        expect_equal((one()["stools_per_ha"], one()["stems_per_ha"], one()["name"]), (1500, 5100, "base"))
        expect_equal(one("forest[0].stand.stools.per_ha=1800")["stools_per_ha"], 1800)
        expect_equal(one("forest[base].stand.shoots[0].per_ha=4000")["stems_per_ha"], 4100)
        expect_equal(one("forest[0].stand.trees=[]")["trees_per_ha"], 0)


BAD_SETS = [
    ("rock.diameter_m=-1", "-1 is below 0 m"), ("rock.diameter_m=0", "0 is not above 0 m"),
    ("rock.diametre_m=1", "unknown key"), ("nope=1", "unknown key"), ("rock.diameter_m", "PATH=VALUE"),
    ("=1", "PATH=VALUE"), ("", "PATH=VALUE"), ("forest[9].to_m=1", "no such item"), ("forest[ADS 3].to_m=1", "no such item"),
    ("forest[-1].to_m=1", "no such item"), ("forest[99999999999999999999].to_m=1", "no such item"),
    ("rock..x=1", "malformed path"), ("forest[0=1", "malformed path"), ("forest[].to_m=1", "malformed path"),
    (".rock=1", "malformed path"), ("rock[0]=1", "no list"), ("forest.to_m=1", "no mapping"),
    ("rock.diameter_m=", "no value"), ("rock.diameter_m=abc", "'abc' is no number"), ("rock.diameter_m='1'", "in quotes"),
    ("rock.diameter_m=1,5", "write a dot"), ("rock.diameter_m=nan", "'nan' is no number"),
    ("rock.diameter_m=1e999", "too large"), ("rock={", "malformed YAML"), ("rock.diameter_m=*x", "alias"),
    ("rock.diameter_m=&x 1", "anchor"), ("rock.diameter_m=!!int 1", "tag"), ("simulation.law=bounce", "unknown"),
    ("simulation.contact_model=pinball", "unknown"), ("simulation.rocks=1.5", "whole number"),
    ("controls[0].x_m=500", "beyond the slope"), ("release.x_m=-5", "beyond the slope"),
    ("simulation.scale_rn=yes", "true or false"), ("title=[1]", "a text is wanted"), ("rock.diameter_m=\x1b[31m", "control"),
    ("rock.\x1b[31m=1", "unknown key"),
]


def bad_set(value, words):
    for mode in ("--batch", "--check"):
        done = ceduo(mode, "-s", value, PAPER)
        expect_equal(done.status, USAGE, value)
        expect_equal(done.out, "")
        expect_in(words, done.err, value)
        expect_in("--set", done.err.splitlines()[0], value)
        expect("paper-site.yaml" not in done.err.splitlines()[0], "the fault is not the file's", done)


def test_set_place():
    """-s shows its own text with a caret under the fault"""
    done = ceduo("--batch", "-s", "rock.diameter_m=-1", PAPER)
    expect_equal(done.err, "--set:1:17: rock.diameter_m: -1 is below 0 m\n  rock.diameter_m=-1\n" + " " * 18 + "^\n")


# ---- rocks, seed, threads, tolerance, options ----

def test_rocks_and_seed():
    """-n and --seed: reported, the same seed gives the same bytes, another others; the first rocks stay the same"""
    runs = [without_seconds(good("--batch", "-f", "json", "-n", 500, "--seed", s, PAPER).out) for s in (1, 1, 2)]
    expect(runs[0] == runs[1] != runs[2], "seeds")
    for model, runs in (("index", 1), ("poisson", 2), ("stems", 2)):
        run = result("-n", 500, "--seed", 9007199254740992, *through(model), PAPER)
        expect_equal((run["rocks"], run["seed"], run["work"]["rocks_flown"]), (500, 9007199254740992, 500 * runs), model)
    expect_equal(result("-n", 1, "--seed", 0, PAPER)["seed"], 0)
    long, short = result(PAPER, "-n", 3000), result(PAPER, "-n", 1500)
    for which in ("bare", "wooded"):
        a, b = (r["options"][0]["controls"][0][which] for r in (long, short))
        expect(b["rocks_reached"] <= a["rocks_reached"] and b["energy_kJ"]["max"] <= a["energy_kJ"]["max"],
               f"{which}: the first rocks are others in a longer run")


def test_seed_beyond():
    """--seed and simulation.seed beyond 2^53 are refused, not rounded"""
    for arguments in (("--seed", "9007199254740993"), ("-s", "simulation.seed=9007199254740993")):
        expect_equal(ceduo("--batch", "-n", 1, *arguments, PAPER).status, USAGE, " ".join(arguments))


def test_threads():
    """-j 1, 2, 16 and 1024 give the same bytes but for work.seconds"""
    for extra in (through("index"), (), ("-s", "simulation.law=crsp", "-s", "rock.diameter_m.spread=0.05", *through("poisson"))):
        runs = {j: without_seconds(good("--batch", "-f", "json", "-n", 10000, "-j", j, *extra, PAPER).out)
                for j in (1, 2, 16, 1024)}
        expect(len(set(runs.values())) == 1, *[f"-j {j}: {hash(r)}" for j, r in runs.items()])
    for form in ("table", "csv"):
        expect_equal(good("--batch", "-f", form, "-n", 3000, "-j", 1, PAPER).out,
                     good("--batch", "-f", form, "-n", 3000, "-j", 16, PAPER).out, form)
    runs = {j: without_seconds(good("--batch", "-f", "json", "-n", 1500, "-j", j, FOUR).out) for j in (1, 2, 5)}
    expect_equal(len(set(runs.values())), 1, "four systems by threads")


def same_run(a, b):
    """Of two options: all that a run finds, without the name."""
    return {k: v for k, v in a.items() if k != "name"} == {k: v for k, v in b.items() if k != "name"}


def test_contact_models():
    """index, poisson and stems: bare and index are the same in all, what goes through the wood differs"""
    with Folder() as f:
        path = f.write("s.yaml", wooded_scene())
        runs = {model: result(path, *through(model)) for model in MODELS}
        controls = {model: run["options"][0]["controls"] for model, run in runs.items()}
        for model, run in runs.items():
            expect_run(run, model)
            for a, b in zip(controls[model], controls["index"]):
                expect_equal((a["bare"], a["index"]), (b["bare"], b["index"]), f"{model}: without forest")
                light = ("contact", "free_run")
                expect_equal([a["lights"][k] for k in light], [b["lights"][k] for k in light], model)
        for c in controls["index"]:
            expect_equal(c["wooded"], None, "wooded by the index")
        expect(controls["poisson"][0]["wooded"] != controls["stems"][0]["wooded"], "poisson and stems are the same")
        for model in ("poisson", "stems"):
            expect_equal(result(path, *through(model), "--seed", 1)["options"], runs[model]["options"], f"{model} again")
            expect(result(path, *through(model), "--seed", 2)["options"] != runs[model]["options"], f"{model}: another seed")
            for c in controls[model]:
                expect(c["wooded"]["energy_kJ"]["mean"] < c["bare"]["energy_kJ"]["mean"] - 5, f"{model}: stems take nothing")
                expect(c["wooded"]["rocks_reached"] < c["bare"]["rocks_reached"], f"{model}: stems stop none")
            expect(runs[model]["options"][0]["ends"]["stopped_by_stems"] > 0.01, model)
            expect(runs[model]["work"]["stems_drawn"] > 0, model)
        expect_equal(runs["index"]["work"]["stems_drawn"], 0, "stems drawn by the index")


def test_no_stems_on_the_way():
    """No stem on the way to a control: wooded is bare there in every figure, with no contact"""
    def expect_bare(control, where):
        wooded = dict(control["wooded"])
        expect_equal(wooded.pop("contacts"), {"mean": 0, "se": 0}, f"{where}: contacts")
        expect_equal(wooded, control["bare"], where)

    with Folder() as f:
        forests = {"none": [], "bare": [{"from_m": 10, "to_m": 95, "stand": {"name": "clearing"}}], "behind": [belt(70, 95)],
                   "above": [belt(0, 15)], "beyond": [belt(110, 150)]}
        path = f.write("s.yaml", wooded_scene(forest=None, release={"x_m": 16, "vx_m_s": 2}, options=[
            {"name": name, "forest": forest} for name, forest in forests.items()]))
        for model in ("poisson", "stems"):
            run = result(path, *through(model))
            expect_run(run, model)
            found = {o["name"]: o for o in run["options"]}
            for name in ("none", "bare", "above", "beyond"):
                for control in found[name]["controls"]:
                    expect_bare(control, f"{model}, {name} at {control['x_m']} m")
            expect_bare(found["behind"]["controls"][0], f"{model}, a belt behind the control")
            behind = found["behind"]["controls"][1]["wooded"]
            expect(behind["contacts"]["mean"] > 1, "the belt behind the first control is met before the second", behind)
            for name in ("bare", "above"):
                expect(same_run({**found[name], "stands": [], "summary": 0, "controls": 0},
                                {**found["none"], "stands": [], "summary": 0, "controls": 0}), f"{model}, {name}: ends")
            # none and bare are the run without forest
            expect_equal((run["work"]["runs"], run["work"]["rocks_flown"]), (4, 8000), f"{model}: runs")


def test_duplicate_option():
    """An option under another name shares its run: no more rocks, the same figures, a difference of exactly 0"""
    with Folder() as f:
        options = [{"name": n, "forest": [belt(10, 95, **({} if n != "other" else {"trees": []}))]}
                   for n in ("first", "other", "again", "renamed stand")]
        options[3]["forest"][0]["stand"]["name"] = "another name"
        path = f.write("s.yaml", wooded_scene(forest=None, options=options))
        for model in MODELS:
            run = result(path, "-n", 1000, *through(model))
            expect_run(run, model)
            first, other, again, renamed = run["options"]
            expect(same_run(first, again), f"{model}: the same option has other figures")
            expect_equal(renamed["controls"], first["controls"], f"{model}: the name of a stand")
            if model != "index":
                expect(other["controls"][1]["wooded"] != first["controls"][1]["wooded"], "the other option is the same")
            runs = 1 if model == "index" else 3
            expect_equal((run["work"]["runs"], run["work"]["rocks_flown"]), (runs, 1000 * runs), f"{model}: work")
            expect(run["work"]["runs_reused"] >= 2, f"{model}: runs reused", run["work"])
            fewer = result(path, "-n", 1000, *through(model), "--option", "first", "--option", "other")
            expect_equal(fewer["work"]["rocks_flown"], 1000 * runs, f"{model}: rocks without the copies")
            for difference in run["differences"]:
                if difference["option"] != "other":
                    for name in DIFFERENCES[::2] if difference["x_m"] == 60 else DIFFERENCES:
                        expect_equal(difference[name], {"mean": 0, "se": 0}, f"{model}: {difference['option']} {name}")
                elif model != "index":
                    expect(difference["energy_per_released_kJ"]["mean"] > 0 and difference["reach_probability"]["se"] > 0,
                           "fewer trees", difference)


def test_option_subset():
    """--option: the figures of an option do not depend on which others run with it; differences are to the first that is left"""
    with Folder() as f:
        path = f.write("s.yaml", treated(none=None, many_thin=THIN, few_thick=THICK))
        for model in ("poisson", "stems"):
            whole = {o["name"]: o for o in result(path, *through(model))["options"]}
            for names in (["many thin"], ["few thick", "many thin"], ["none", "few thick"]):
                run = result(path, *through(model), *[a for n in names for a in ("--option", n)])
                expect_run(run, model)
                expect_equal(run["options"], [o for n, o in whole.items() if n in names], f"{model}, {names}")
                expect_equal({d["against"] for d in run["differences"]}, {run["options"][0]["name"]} if len(names) > 1 else set())


def test_difference_errors():
    """Differences of options are between the same rocks: their error is that of pairs, smaller than of two runs apart"""
    with Folder() as f:
        path = f.write("s.yaml", treated(thick=THICK, one_more={**THICK, "trees": [{**THICK["trees"][0], "per_ha": 303}]}, thin=THIN))
        run = result(path, "-n", 4000)
        first, near, far = (o["controls"][1]["wooded"] for o in run["options"])
        differences = {d["option"]: d for d in run["differences"] if d["x_m"] == 105}
        apart = math.hypot(first["energy_per_released_kJ"]["se"], near["energy_per_released_kJ"]["se"])
        expect(0 < differences["one more"]["energy_per_released_kJ"]["se"] < 0.5 * apart, apart, differences["one more"])
        # a difference that is there is found at many times its error
        d = differences["thin"]["energy_per_released_kJ"]
        expect(d["mean"] > 10 * d["se"] > 0, d)
        bare = [o["controls"][1]["bare"] for o in run["options"]]
        expect(bare[0] == bare[1] == bare[2], "the options fly other rocks")


def half_width(bare):
    if bare["energy_kJ"]["se"] is None:
        return math.inf
    return 1.959963984540054 * bare["energy_kJ"]["se"] / bare["energy_kJ"]["mean"]


def test_tolerance_met():
    """-e goes on until every mean energy is known so well, the same with any number of threads"""
    two = ["-s", "controls=[{x_m: 60}, {x_m: 135}]"]
    for model in MODELS:
        run = result("-e", 0.01, *two, *through(model), PAPER)
        expect_run(run, model)
        expect_tolerance(run, 0.01)
        expect_equal(run["warnings"], [])
        expect(1000 < run["rocks"] < 100000, run["rocks"])
        expect_equal(run["options"], result("-e", 0.01, "-n", 1000000, "-j", 16, *two, *through(model), PAPER)["options"])
        needed = max((half_width(a) / 0.01) ** 2 * run["rocks"] for c in run["options"][0]["controls"]
                     for a in (c["bare"], c["wooded"]) if a and a["rocks_reached"] >= 100)
        expect(needed <= run["rocks"] <= 1.2 * needed, f"{model}: {run['rocks']} rocks, the spread seen asks for {needed}")


def expect_tolerance(run, tolerance):
    """Every mean energy printed is known so well, but where a warning names the control as left out, or all as not met."""
    if any("not met" in w for w in run["warnings"]):
        return
    for option in run["options"]:
        for control in option["controls"]:
            for arrivals in (control["bare"], control["wooded"]):
                if arrivals is None or arrivals["rocks_reached"] == 0:
                    continue
                named = any(f"{control['x_m']:g} m" in w and "left out" in w for w in run["warnings"])
                expect(arrivals["rocks_reached"] < 100 and named or half_width(arrivals) <= tolerance,
                       f"{option['name']} at {control['x_m']} m: half width {half_width(arrivals)}", arrivals["rocks_reached"],
                       run["warnings"])


def test_tolerance_options():
    """-e goes on until every option's mean energy through its wood is known so well"""
    with Folder() as f:
        path = f.write("s.yaml", treated(thin=THIN, thick=THICK, none=None))
        run = result(path, "-e", 0.02)
        expect_run(run)
        expect_tolerance(run, 0.02)
        expect_equal(run["warnings"], [])
        widths = [half_width(c[which]) for o in run["options"] for c in o["controls"] for which in ("bare", "wooded")]
        bare = result(path, "-e", 0.02, *through("index"))
        expect(bare["rocks"] < run["rocks"], "what is least known decides", bare["rocks"], run["rocks"], widths)
        half = result(path, "-n", run["rocks"] // 2)
        expect(any(half_width(c["wooded"]) > 0.02 for o in half["options"] for c in o["controls"]), "it went on too long")


def test_tolerance_few_wooded():
    """-e leaves out a control that under 100 rocks reach through the wood, and names it; where none reach it, too"""
    with Folder() as f:
        dense = {**THICK, "trees": [{**THICK["trees"][0], "per_ha": 1500, "volume_m3": 5}]}
        path = f.write("s.yaml", wooded_scene(forest=[{"from_m": 62, "to_m": 100, "stand": dense}],
                                              controls=[{"x_m": 60}, {"x_m": 104, "accepted_kJ": 10}]))
        run = result(path, "-e", 0.02)
        near, far = run["options"][0]["controls"]
        expect(far["wooded"]["rocks_reached"] < 100, far["wooded"]["rocks_reached"])
        expect_tolerance(run, 0.02)
        expect(half_width(near["wooded"]) <= 0.02 and half_width(far["bare"]) <= 0.02, "those that many reach")
        expect(any("104 m" in w and "left out" in w for w in run["warnings"]), run["warnings"])
        expect(not any("not met" in w or "60 m" in w for w in run["warnings"]), run["warnings"])
        expect_in("left out", re.sub(r"\s+", " ", good("--batch", "-e", 0.02, path).out), "table")


def test_tolerance_not_met():
    """-e with -n too small: a warning that names the tolerance, status 0"""
    run = result("-e", 0.001, "-n", 2000, PAPER)
    expect_equal(run["rocks"], 2000)
    expect(len(run["warnings"]) == 1 and "0.001" in run["warnings"][0] and "not met" in run["warnings"][0], run["warnings"])
    expect_in("not met", good("--batch", "-e", 0.001, "-n", 2000, PAPER).out, "table")
    _, rows = read_csv(good("--batch", "-f", "csv", "-e", 0.001, "-n", 2000, PAPER).out)
    expect_in("not met", rows[0]["warnings"], "CSV")


def test_tolerance_few():
    """-e leaves out a control that under 100 rocks reach, and names it"""
    with Folder() as f:
        # rocks that come to rest: few reach the end
        few = scene(slope={"vertices_m": [[0, 20], [30, 0], [200, 0]],
                           "segments": [{"rn": 0.3, "rt": 0.8, "roughness_rad": 0.3, "friction": 0.5}]},
                    controls=[{"x_m": 25}, {"x_m": 199}])
        run = result("-e", 0.05, "-n", 20000, f.write("few.yaml", few))
        near, far = run["options"][0]["controls"]
        expect(far["bare"]["rocks_reached"] < 100, far["bare"])
        expect(half_width(near["bare"]) < 0.05, near["bare"])
        expect(any("199 m" in w for w in run["warnings"]), run["warnings"])
        expect(not any("not met" in w or "25 m" in w for w in run["warnings"]), run["warnings"])


def test_option():
    """--option keeps those asked for, in the scene's order; an unknown name is status 2"""
    names = ["large reserves", "simple coppice, 25 years"]
    run = result(FOUR, "-n", 20, "--option", names[0], "--option", names[1])
    expect_equal([o["name"] for o in run["options"]], names[::-1])
    whole = result(FOUR, "-n", 20)
    expect_equal(run["options"], [o for o in whole["options"] if o["name"] in names])
    expect_equal(result(PAPER, "-n", 1, "--option", "current")["options"][0]["name"], "current")
    done = ceduo("--batch", FOUR, "--option", "nope")
    expect(done.status == USAGE and done.out == "" and "'nope'" in done.err, done)
    done = ceduo("--check", FOUR, "--option", "nope")
    expect(done.status == USAGE, done)


# ---- several scenes, streams, files ----

def test_several_scenes():
    """Several scenes: a bad one is reported, the good ones printed, status 3"""
    with Folder() as f:
        bad = f.write("bad.yaml", "ceduo: scene/1\nrock: {diameter_m: -1}\n")
        done = ceduo("--batch", "-f", "json", "-n", 10, PAPER, bad, FOUR, f.path / "missing.yaml")
        expect_equal(done.status, INPUT)
        expect_equal([r["scene"] for r in done.json()], [str(PAPER), str(FOUR)])
        expect(f"{bad}:2:20: " in done.err and "missing.yaml" in done.err, done)
        done = ceduo("--batch", "-n", 10, bad, PAPER)
        expect_equal(done.status, INPUT)
        expect(done.out == good("--batch", "-n", 10, PAPER).out, "a bad scene before it changes the table:", repr(done.out[:80]))
        done = ceduo("--batch", "-f", "csv", "-n", 10, PAPER, bad)
        expect_equal((done.status, done.out), (INPUT, good("--batch", "-f", "csv", "-n", 10, PAPER).out), "CSV")
        target = f.path / "out.csv"
        done = ceduo("--batch", "-f", "csv", "-n", 10, "-o", target, bad, PAPER)
        expect_equal((done.status, len(target.read_text().splitlines())), (INPUT, 2), "-o")
        done = ceduo("--batch", "-f", "csv", bad)
        expect_equal((done.status, done.out), (INPUT, ""), "nothing good: not even a header")
        done = ceduo("--check", PAPER, bad, FOUR)
        expect(done.status == INPUT and done.out == "", done)


def test_highest_status():
    """Several scenes: the highest status counts"""
    with Folder() as f:
        endless = f.write("endless.yaml", ENDLESS)
        bad = f.write("bad.yaml", "x")
        expect_equal(ceduo("--batch", "-n", 1, endless, PAPER).status, RUN)
        expect_equal(ceduo("--batch", "-n", 1, endless, bad, PAPER).status, INPUT)
        expect_equal(ceduo("--batch", "-n", 1, bad, PAPER, "--option", "nope").status, INPUT)
        expect_equal(ceduo("--batch", "-n", 1, bad, PAPER, "-o", "/dev/full").status, OUTPUT)


def test_stdin():
    """'-' reads a scene from standard input, with profiles by their relative paths; only once"""
    text = PAPER.read_bytes()
    run = result("-", stdin=text, cwd="/")
    wanted = result(PAPER)
    expect_equal({k: v for k, v in run.items() if k not in ("scene", "work")},
                 {k: v for k, v in wanted.items() if k not in ("scene", "work")})
    expect_equal(ceduo("--batch", "-", "-").status, USAGE)
    done = ceduo("--batch", "-", stdin=b"rock: 5\n")
    expect(done.status == INPUT and re.match(r"(-|standard input|<stdin>):1:\d+: ", done.err), done)
    done = ceduo("--batch", "-", stdin=b"")
    expect(done.status == INPUT and done.out == "" and done.err, done)
    expect_equal(ceduo("--check", "-", stdin=text).status, DONE)


def test_stdin_closed():
    """A closed standard input: no matter for files, an error for '-'"""
    shell = ["sh", "-c", '"$0" "$@" <&-', CEDUO, "--batch", "-n", "10"]
    done = subprocess.run([*shell, str(PAPER)], env=environment(), capture_output=True, timeout=20, check=False)
    expect(done.returncode == DONE and done.stdout and not done.stderr, done)
    done = subprocess.run([*shell, "-"], env=environment(), capture_output=True, timeout=20, check=False)
    expect(done.returncode == INPUT and not done.stdout and done.stderr, done)


def test_output_file():
    """-o writes the file whole, as standard output would have it, and leaves nothing beside it"""
    with Folder() as f:
        for form in ("table", "csv"):
            target = f.path / f"out.{form}"
            done = good("--batch", "-f", form, "-o", target, PAPER, FOUR, "-n", 50)
            expect_equal(done.out, "")
            expect_equal(target.read_text(), good("--batch", "-f", form, PAPER, FOUR, "-n", 50).out, form)
            expect_equal(target.stat().st_mode & 0o777, 0o666 & ~umask(), "mode")
        expect_equal(f.names(), ["out.csv", "out.table"])
        good("--batch", "-o", "relative.txt", PAPER, "-n", 5, cwd=f.path)
        expect_in("relative.txt", f.names(), "relative path")
        for mode in ("--help", "--version", "--list-parameters", "--list-profiles"):
            done = good(mode, "-o", f.path / "list")
            expect(done.out == "" and (f.path / "list").read_text() == good(mode).out, mode)


def umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask


def test_output_existing():
    """-o keeps an existing file's mode, a link stays a link, a failed run leaves the old file"""
    with Folder() as f:
        target = f.write("out.txt", "old")
        target.chmod(0o640)
        link = f.path / "link.txt"
        link.symlink_to("out.txt")
        wanted = good("--batch", "-n", 5, PAPER).out
        good("--batch", "-n", 5, "-o", target, PAPER)
        expect_equal((target.read_text() == wanted, target.stat().st_mode & 0o7777), (True, 0o640), "mode")
        target.write_text("old")
        good("--batch", "-n", 5, "-o", link, PAPER)
        expect(link.is_symlink() and target.read_text() == wanted, "the link was replaced")
        expect_equal(target.stat().st_mode & 0o7777, 0o640, "mode through a link")
        target.write_text("old")
        bad = f.write("bad.yaml", "x")
        expect_equal(ceduo("--batch", "-o", target, bad).status, INPUT)
        expect_equal(target.read_text(), "old", "a bad scene")
        expect_equal(ceduo("--batch", "-o", f.path / "new.txt", bad).status, INPUT)
        expect_equal(f.names(), ["bad.yaml", "link.txt", "out.txt"])


def test_output_dangling():
    """-o through a link that points to nothing writes there; the link stays"""
    with Folder() as f:
        link = f.path / "link.txt"
        link.symlink_to("target.txt")
        done = ceduo("--batch", "-n", 5, "-o", link, PAPER)
        expect(link.is_symlink(), "the link was replaced", done)
        expect(done.status == OUTPUT or (f.path / "target.txt").exists(), done)


def test_output_devices():
    """-o to a device goes straight: /dev/null is good, /dev/full is status 4, a FIFO's reader gets it"""
    expect_equal(good("--batch", "-n", 5, "-o", "/dev/null", PAPER).out, "")
    expect(not Path("/dev/null").is_file(), "/dev/null was replaced")
    done = ceduo("--batch", "-n", 5, "-o", "/dev/full", PAPER)
    expect(done.status == OUTPUT and "/dev/full: " in done.err and done.out == "", done)
    with Folder() as f:
        fifo = f.path / "fifo"
        os.mkfifo(fifo)
        with subprocess.Popen(["cat", str(fifo)], stdout=subprocess.PIPE) as cat:
            try:
                good("--batch", "-n", 5, "-o", fifo, PAPER)
                expect_equal(cat.communicate(timeout=10)[0].decode(), good("--batch", "-n", 5, PAPER).out, "FIFO")
            finally:
                cat.kill()


def test_output_impossible():
    """-o to a folder, into a missing folder, or to nothing: status 4, named, nothing left behind"""
    with Folder() as f:
        for target in (f.path, f.path / "no" / "out.txt", "", PAPER / "out.txt", f.path / ("x" * 300)):
            done = ceduo("--batch", "-n", 5, "-o", target, PAPER, cwd=f.path)
            expect(done.status == OUTPUT and done.err and done.out == "", done)
        expect_equal(f.names(), [])


def test_output_told_first():
    """That -o cannot be written is told before anything is read or computed"""
    with Folder() as f:
        for target in (f.path, f.path / "no" / "out.txt", "", f.path / ("x" * 300)):
            for words in (["--batch"], ["--merge"], ["--find", "rock.diameter_m=0.2:1", "--goal", "adc=30"]):
                done = ceduo(*words, "-o", target, f.path / "no-scene.yaml", cwd=f.path)
                expect_equal(done.status, OUTPUT, done)
                expect(done.out == "" and "no-scene" not in done.err, done)


def test_output_large():
    """-o of many scenes: what stdout gets, and memory does not grow with them"""
    wanted = good("--batch", "-f", "csv", "-n", 10, *[PAPER] * 1000).out
    expect(len(wanted) > 2_000_000, "bytes of output", len(wanted))
    peaks = []
    with Folder() as f:
        good("--batch", "-f", "csv", "-n", 10, "-o", f.path / "out.csv", *[PAPER] * 1000)
        expect_equal((f.path / "out.csv").read_text(), wanted, "rows")
        os.mkfifo(f.path / "fifo")
        for many in (100, 1000):
            child = subprocess.Popen([CEDUO, "--batch", "-f", "csv", "-n", "10", "-o", f.path / "fifo", *[PAPER] * many],
                                     env=environment())
            with open(f.path / "fifo", "rb") as fifo:
                start = fifo.read(1)  # all is computed, and the rest waits for us
                peaks.append(int(re.search(r"VmHWM:\s+(\d+)", Path(f"/proc/{child.pid}/status").read_text())[1]))
                rows = start + fifo.read()
            expect_equal((child.wait(), len(rows.splitlines())), (0, many + 1))
    expect(SANITIZED or peaks[1] < peaks[0] + 1000, "KiB of memory", peaks)


def test_output_forbidden():
    """-o into a read-only folder or over a read-only file: status 4, the old file stays"""
    with Folder() as f:
        who = {}
        if os.geteuid() == 0:
            who = {"user": 65534, "group": 65534, "extra_groups": []}
            f.path.chmod(0o755)
            try:
                subprocess.run([CEDUO, "--version"], check=True, capture_output=True, **who)
            except (OSError, subprocess.SubprocessError) as why:
                raise Skip("root may write anywhere, and another user cannot run the program") from why
        folder = f.path / "locked"
        folder.mkdir()
        target = f.write("locked/out.txt", "old")
        target.chmod(0o666)
        folder.chmod(0o555)
        done = ceduo("--batch", "-n", 5, "-o", folder / "new.txt", "-", stdin=INLINE, cwd="/", **who)
        expect(done.status == OUTPUT and "new.txt: " in done.err, done)
        folder.chmod(0o777)
        target.chmod(0o444)
        done = ceduo("--batch", "-n", 5, "-o", target, "-", stdin=INLINE, cwd="/", **who)
        expect(done.status == OUTPUT and target.read_text() == "old", done)
        expect_equal([p.name for p in folder.iterdir()], ["out.txt"])


INLINE = b"""ceduo: scene/1
rock: {diameter_m: 0.5}
slope: {vertices_m: [[0, 64], [100, 0]], segments: [{rn: 0.35, rt: 0.875}]}
controls_m: [75]
"""

MODES = (("--batch", "-n", "5", str(PAPER)), ("--batch", "-f", "csv", "-n", "5", str(PAPER)), ("--help",), ("--version",),
         ("--list-parameters",), ("--list-profiles",))


def test_stdout_closed():
    """A closed standard output is status 4 in every mode that prints"""
    for mode in MODES:
        done = subprocess.run(["sh", "-c", '"$0" "$@" >&-', CEDUO, *mode], env=environment(), capture_output=True,
                              timeout=20, check=False)
        expect(done.returncode == OUTPUT and done.stderr, mode, done)
    with Folder() as f:  # what is opened later must not become standard output or error
        done = subprocess.run(["sh", "-c", '"$0" "$@" >&- 2>&-', CEDUO, "--batch", "-n", "5", "-o",
                               str(f.path / "out.txt"), str(PAPER)], env=environment(), timeout=20, check=False)
        expect_equal(done.returncode, DONE, "only the file is written")
        expect_equal((f.path / "out.txt").read_text(), good("--batch", "-n", 5, PAPER).out)


def test_stdout_full():
    """A full disk behind standard output is status 4 in every mode that prints"""
    for mode in MODES:
        with open("/dev/full", "wb") as full:
            done = subprocess.run([CEDUO, *mode], stdout=full, stderr=subprocess.PIPE, env=environment(), timeout=20,
                                  check=False)
        expect(done.returncode == OUTPUT and done.stderr, mode, done)


def test_closed_pipe():
    """A reader that goes away ends the program without noise"""
    for mode in MODES:
        read, write = os.pipe()
        os.close(read)
        with subprocess.Popen([CEDUO, *mode], stdout=write, stderr=subprocess.PIPE, env=environment()) as p:
            os.close(write)
            noise = p.communicate(timeout=20)[1]
        expect(p.returncode in (-signal.SIGPIPE, DONE) and noise == b"", mode, p.returncode, noise)


# ---- locales, terminals ----

def test_plain_ascii():
    """LC_ALL=C: all output and every message is pure ASCII, with the same numbers"""
    def ascii_only(done):
        for data in (done.out_bytes, done.err_bytes):
            bad = [line for line in data.splitlines() if any(b >= 0x80 for b in line)]
            expect(not bad, "not ASCII:", *bad[:5])
        return done
    plain = {"LC_ALL": "C"}
    for path in sorted((PROFILES / "scenes").glob("*.yaml")):
        text = ascii_only(good("--batch", "-n", 100, path, env=plain)).out
        wide = good("--batch", "-n", 100, path).out
        expect_equal(re.findall(r"\d+\.\d+", text), re.findall(r"\d+\.\d+", wide), "numbers")
        expect_width(text)
    ascii_only(good("--batch", "-n", 5, PAPER, "-s", "title=Überraschung — 𝄞", env=plain))


def test_plain_ascii_lists():
    """LC_ALL=C: lists and messages on standard error are pure ASCII"""
    plain = {"LC_ALL": "C"}
    cases = [good(mode, env=plain) for mode in ("--help", "--version", "--list-parameters", "--list-profiles")]
    cases += [ceduo("--batch", PAPER, "-s", value, env=plain)
              for value in ("forest[0].stand={shoots: [{per_ha: 1, dbh_m: 1, height_m: 1}]}", "title=[ü]", "rock.ü=1")]
    bad = [line for done in cases for line in (done.out_bytes + done.err_bytes).splitlines()
           if any(b >= 0x80 for b in line)]
    expect(not bad, "not ASCII:", *bad[:6])


def comma_locale(folder):
    """Environment of a locale that writes a comma, made where the machine has none."""
    installed = subprocess.run(["locale", "-a"], capture_output=True, text=True, check=False).stdout.split()
    for name in installed:
        if re.match(r"(de|it|fr|es)_.*utf-?8$", name, re.I):
            return {"LC_ALL": name}
    if not shutil.which("localedef") or not Path("/usr/share/i18n/locales/de_DE").exists():
        raise Skip("no locale with a comma, nor localedef to make one")
    subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", str(folder / "de_DE.UTF-8")], capture_output=True,
                   check=False)
    return {"LC_ALL": "de_DE.UTF-8", "LOCPATH": str(folder)}


def test_comma_locale():
    """A locale with a decimal comma: numbers are read and written with a dot"""
    with Folder() as f:
        env = comma_locale(f.path)
        probe = subprocess.run(["sh", "-c", "printf '%.1f' 0,5"], env={**os.environ, **env}, capture_output=True,
                               check=False)
        if shutil.which("locale"):
            point = subprocess.run(["locale", "decimal_point"], env={**os.environ, **env}, capture_output=True, text=True,
                                   check=False).stdout.strip()
            expect_equal(point, ",", f"the locale {env} ({probe.stdout})")
        for form in ("table", "csv", "json"):
            found, wanted = [without_seconds(good("--batch", "-f", form, PAPER, "-s", "rock.diameter_m=0.75", env=e).out)
                             for e in (env, {})]
            expect_equal(found, wanted, form)
        expect_equal(good("--list-parameters", env=env).out, good("--list-parameters").out)


def test_plain_environment():
    """NO_COLOR, TERM=dumb, no TERM, no HOME, unknown locales change nothing"""
    wanted = good("--batch", "-n", 50, FOUR).out
    for env in ({"NO_COLOR": "1"}, {"TERM": "dumb"}, {"TERM": None}, {"HOME": None}, {"HOME": ""}, {"XDG_DATA_HOME": ""},
                {"XDG_DATA_HOME": "relative"}):
        expect_equal(good("--batch", "-n", 50, FOUR, env=env).out, wanted, str(env))
    good("--batch", "-n", 50, FOUR, env={"LC_ALL": "xx_YY.UTF-8"})


def on_terminal(arguments, stop, which):
    """What the program writes to a terminal that is its stdout or stderr, until stop(text, seconds); and its status."""
    master, slave = pty.openpty()
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, which: slave}
    with subprocess.Popen([CEDUO, *map(str, arguments)], stdin=subprocess.DEVNULL, env=environment(), **streams) as p:
        os.close(slave)
        os.set_blocking(master, False)
        text, start, sent = b"", time.monotonic(), False
        while time.monotonic() - start < 30:
            try:
                text += os.read(master, 65536)
            except BlockingIOError:
                time.sleep(0.02)
            except OSError:
                break
            if not sent and stop(text, time.monotonic() - start):
                p.send_signal(signal.SIGINT)
                sent = True
        p.kill()
        p.communicate()
    os.close(master)
    return text, p.returncode


def test_terminal():
    """On a terminal: no escape bytes on standard output; progress on standard error after a second, none with -q"""
    text, status = on_terminal(["--batch", "-n", "50", FOUR], lambda *_: False, "stdout")
    expect_equal(status, DONE)
    only_text(text.replace(b"\r\n", b"\n"), "stdout")
    with Folder() as f:
        endless = f.write("endless.yaml", ENDLESS)
        run = ["--batch", "-n", "1000000", "-o", "/dev/null"]
        text, status = on_terminal([*run, endless], lambda t, s: s > 1.3, "stderr")
        expect_equal(status, -signal.SIGINT)
        expect(b"\x1b" not in text, text)
        text, status = on_terminal(["--batch", "-n", "10000000", "-j", "1", "-s", "simulation.law=crsp", "-o", "/dev/null",
                                    PAPER], lambda t, s: b"rocks" in t or s > 90, "stderr")
        expect(b"rocks" in text and b"\x1b" not in text, text)
        expect_equal(status, -signal.SIGINT)
        text, status = on_terminal(["--batch", "-q", "-n", "10000000", "-j", "1", "-o", "/dev/null", PAPER],
                                   lambda t, s: t or s > 1.6, "stderr")
        expect_equal(text, b"", "-q")
        text, status = on_terminal(["--batch", "-n", "10", "-o", "/dev/null", PAPER], lambda *_: False, "stderr")
        expect_equal((text, status), (b"", DONE), "short work")


# ---- help and lists ----

def test_help():
    """--help names every option within 80 columns; --version is one line"""
    text = good("--help").out
    for word in ("-b, --batch", "-f, --format", "-o, --output", "-s, --set", "-n, --rocks", "-e, --tolerance", "--rows",
                 "--seed", "-j, --threads", "--option", "--check", "--list-parameters", "--list-profiles", "-q, --quiet",
                 "--help", "--version"):
        expect_in(word, text, "help")
    expect(all(len(line) <= 100 for line in text.splitlines()), text)
    version = good("--version").out
    expect(re.fullmatch(r"ceduo \d+\.\d+\.\d+\n", version), version)
    expect_equal(result(PAPER, "-n", 1)["version"], version.split()[1])
    expect_equal(good("--batch", "--help", "nothing.yaml").out, text, "--help wins")


def test_list_parameters():
    """--list-parameters has path, type, unit, range, default and meaning of every key of the shipped scenes"""
    lines = good("--list-parameters").out.splitlines()
    expect_equal(lines[0].split(), ["path", "type", "unit", "range", "default", "meaning"])
    table = {line.split()[0]: line for line in lines[1:] if line}
    for path, words in (("rock.diameter_m", "m"), ("release.vx_m_s", "m/s 0"), ("slope.segments[].friction", "0.5"),
                        ("slope.vertices_m", "m"), ("controls[].accepted_kJ", "kJ"), ("forest[].stand.stools.per_ha", "1/ha"),
                        ("forest[].stand.trees[].dbh_m", "m"), ("forest[].stand.energy.u_J_m3", "J/m3"),
                        ("options[].name", "text"), ("simulation.threshold_m", "m 30"), ("simulation.rocks", "count"),
                        ("simulation.contact_model", "index|poisson|stems stems"), ("simulation.scale_rn", "false"),
                        ("simulation.law", "lumped|crsp"), ("simulation.gravity_m_s2", "9.81")):
        expect(path in table, f"{path} is missing")
        for word in words.split():
            expect_in(word, table[path].split(), path)


GROWTH = {which: {"dbh_most_m": 0.5, "dbh_rate_1_y": 0.05, "height_most_m": 20, "height_rate_1_y": 0.05}
          for which in ("shoots", "trees")}


def test_bounds_are_listed():
    """What is beyond the bounds that --list-parameters shows is refused with these bounds, and no other bound is met"""
    mapping = scene(forest=[{"from_m": 10, "to_m": 20, "stand": stand(
        growth={**GROWTH, "shoots_young": 3, "shoots_old": 2}, cutting={"rotation_years": 20})}], minimum={"reserves_per_ha": 1})
    lines = [re.split("  +", line) for line in good("--list-parameters").out.split("\n\n")[0].splitlines()[1:]]
    forms = {"number": "{}", "number~": "{}", "count": "{:.0f}", "numbers": "[{}]", "points": "[[{0}, 0], [1, {0}]]",
             "3 numbers~": "[{0}, {0}, {0}]"}
    seen = 0
    with Folder() as f:
        path = f.write("s.yaml", mapping)
        materials = f.write("m.yaml", scene(slope={"vertices_m": [[0, 64], [100, 0]],
                                                   "materials": [{"from_m": 0, "to_m": 100, "material": "talus"}]}))
        for name, kind, unit, text, *_ in lines:
            if kind not in forms:
                continue
            seen += 1
            shown = re.fullmatch(r"(>?)(\S*)\u2026(<?)(\S*)", text) or re.fullmatch(r"(>=?) (\S+)", text)
            lo = float(shown[2]) if shown and shown[2] else None
            hi = float(shown[4]) if shown and len(shown.groups()) == 4 else None
            for bound, sign, words in ((lo, -1, "is below|is not above"), (hi, 1, "is above|is not below")):
                for value in (sign * 1e17,) if bound is None else (bound + sign * max(abs(bound) * 1e-3, 1), sign * 1e17):
                    change = name.replace("[]", "[0]") + "=" + forms[kind].format(value)
                    done = ceduo("--check", "-s", change, materials if "materials" in name else path)
                    found = re.search(rf"({words}) ([-+.0-9e]+)(?: (\S+))?$", done.err, re.M)
                    expect(bool(found) == (bound is not None), f"{change}; shown: {text}", done)
                    if found:
                        expect_near(float(found[2]), bound, abs(bound) * 1e-4, change)  # 1.5708 for half of pi
                        expect_equal((found[3] or "-", done.status), (unit, USAGE), change)
    expect(seen > 50, f"{seen} parameters that are numbers")


def test_list_profiles():
    """--list-profiles shows file, kind and title; one's own come from the XDG data folder and run by name"""
    text = good("--list-profiles").out
    expect_equal(text.split("\n")[0].split(), ["file", "kind", "title"])
    for name, kind, title in (("paper-site", "scene", "Test site of Ciabocco et al. 2009"), ("ads-1", "stand", "ADS 1"),
                              ("paper", "slope", "Slope of Ciabocco et al. 2009"), ("four-systems", "scene", "Four systems"),
                              ("ads-2", "stand", "ADS 2"), ("bare", "stand", "bare")):
        expect(re.search(rf"/{name}\.yaml +{kind} +{title}", text), f"{name} is missing", text)
    expect_equal(len(text.splitlines()) - 1, len(list(PROFILES.rglob("*.yaml"))), "rows")
    with Folder() as f:
        f.write("ceduo/scenes/mine.yaml", scene(title="my \x07 own"))
        f.write("ceduo/scenes/broken.yaml", "{")
        f.write("ceduo/stands/ads-1.yaml", stand(ceduo="stand/1", name="other"))
        env = {"XDG_DATA_HOME": str(f.path)}
        expect_in("mine.yaml", good("--list-profiles", env=env).out, "own profile")
        expect_equal(result("mine", "-n", 1, env=env, cwd="/")["title"], "my \x07 own")
        done = ceduo("--batch", "mien", env=env, cwd="/")
        expect(done.status == INPUT and re.search(
            rf"did you mean 'mine'\? \(looked for here and in {f.path}/ceduo/scenes, .*{PROFILES.name}/scenes", done.err), done)
    expect_equal(result("paper-site", cwd="/")["title"], "Test site of Ciabocco et al. 2009")
    expect_equal(result("paper-site.yaml", cwd="/")["title"], "Test site of Ciabocco et al. 2009")


def test_output_is_input():
    """-o leaves every file alone that is read in the same run: scenes, what they refer to, parts, by any name"""
    with Folder() as f:
        f.write("line.csv", "distance,elevation\n0,64\n100,0\n")
        f.write("stand.yaml", stand(ceduo="stand/1"))
        f.write("s.yaml", scene(slope="line.csv", forest=[{"from_m": 10, "to_m": 60, "stand": "stand.yaml"}]))
        f.write("bad.yaml", scene(rock=None, slope="line.csv"))
        f.write("plain.yaml", scene())
        os.link(f.path / "s.yaml", f.path / "hard.yaml")
        (f.path / "soft.yaml").symlink_to("s.yaml")
        (f.path / "part").write_bytes(good("--shard", "1/1", "s.yaml", cwd=f.path).out_bytes)
        before = {n: (f.path / n).read_bytes() for n in f.names()}
        with open(f.path / "s.yaml", "rb") as stdin:
            runs = [("-b", "-o", n, "plain.yaml", "s.yaml") for n in
                    ("s.yaml", "./s.yaml", "hard.yaml", "soft.yaml", "stand.yaml", "line.csv", "plain.yaml")]
            runs += [("-b", "-o", "line.csv", "plain.yaml", "bad.yaml"), ("--merge", "-o", "part", "part"),
                     ("--find", "rock.diameter_m=0.4:0.5", "--goal", "adc", "-o", "stand.yaml", "s.yaml"),
                     ("--shard", "1/2", "-o", "line.csv", "s.yaml")]
            for arguments in runs:
                done = ceduo(*arguments, cwd=f.path)
                expect(done.status == OUTPUT and done.out == "" and "is read in this run" in done.err, done)
            done = subprocess.run([CEDUO, "-b", "-o", "s.yaml", "-"], stdin=stdin, stderr=subprocess.PIPE, cwd=f.path,
                                  env=environment(), check=False)
            expect(done.returncode == OUTPUT and b"is read in this run" in done.stderr, done)
        expect_equal({n: (f.path / n).read_bytes() for n in f.names()}, before, "files")
        good("-b", "-o", "s.yaml", "plain.yaml", cwd=f.path)


def test_check_good():
    """--check of the shipped scenes prints nothing, status 0"""
    for path in sorted((PROFILES / "scenes").glob("*.yaml")):
        expect_equal(good("--check", path).out, "")


BAD_USAGE = [
    (), ("--batch",), ("--check",), ("--nope",), ("--batch", "--nope", PAPER), ("-z", PAPER), ("--batch", "-n"),
    ("--batch", "-n", "0", PAPER), ("--batch", "-n", "-5", PAPER), ("--batch", "-n", "1.5", PAPER),
    ("--batch", "-n", "10000001", PAPER), ("--batch", "-n", "x", PAPER), ("--batch", "-n", "", PAPER),
    ("--batch", "-n", "5 ", PAPER), ("--batch", "-n", "0x10", PAPER), ("--batch", "-n", "1e999", PAPER),
    ("--batch", "-f", "xml", PAPER), ("--batch", "-f", "", PAPER), ("--batch", "--rows", "trees", PAPER),
    ("--batch", "--seed", "-1", PAPER), ("--batch", "--seed", "1.5", PAPER), ("--batch", "--seed", "9007199254740994", PAPER),
    ("--batch", "--seed", "nan", PAPER), ("--batch", "-j", "0", PAPER), ("--batch", "-j", "99999", PAPER),
    ("--batch", "-j", "two", PAPER), ("--batch", "-e", "0", PAPER), ("--batch", "-e", "-0.1", PAPER),
    ("--batch", "-e", "1", PAPER), ("--batch", "-e", "x", PAPER), ("--batch", "-e", "nan", PAPER),
    ("--batch", "-e", "0,1", PAPER), ("--batch", "-", "-"), ("--list-profiles", PAPER), ("--list-parameters", "x"),
    ("--batch=yes", PAPER), ("--format",), ("--batch", "--\x1b[31m", PAPER), ("--batch", "-n", "\x1b[31m", PAPER),
]


def bad_usage(*arguments):
    done = ceduo(*arguments)
    expect(done.status == USAGE and done.out == "", done)
    lines = done.err.splitlines()
    expect(1 <= len(lines) <= 2 and "try 'ceduo --help'" in lines[-1] and lines[0].startswith("ceduo: "), done)


def test_no_terminal():
    """Without --batch and without a terminal: status 2 and --batch named"""
    for arguments in ((), (PAPER,)):
        done = ceduo(*arguments)
        expect(done.status == USAGE and "--batch" in done.err, done)


# ---- signals ----

# Nothing takes energy from these rocks: each makes as many contacts as are allowed.
ENDLESS = scene(title="endless", release={"x_m": 5, "height_m": 3},
                slope={"vertices_m": [[0, 0], [100, 0]], "segments": [{"rn": 1, "rt": 1, "roughness_rad": 0, "friction": 0}]},
                controls=[{"x_m": 30, "accepted_kJ": 1}])


def interrupted(number, path, most):
    with Folder() as f:
        old = f.write("old.txt", "old")
        for target in (None, f.path / "new.txt", old):
            where = ["-o", str(target)] if target else []
            with subprocess.Popen([CEDUO, "--batch", "-n", "10000000", *where, str(path)], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, env=environment()) as p:
                time.sleep(0.25)
                expect(p.poll() is None, "it ended before the signal", p.returncode)
                p.send_signal(number)
                start = time.monotonic()
                try:
                    out, err = p.communicate(timeout=120)
                except subprocess.TimeoutExpired as late:
                    p.kill()
                    raise Failure("it goes on after the signal") from late
            expect_equal(p.returncode, -number, "status")
            expect_equal((out, err), (b"", b""))
            expect(time.monotonic() - start < most, f"ended {time.monotonic() - start:.1f} s after the signal")
            expect_equal(f.names(), ["old.txt"])
            expect_equal(old.read_text(), "old")


def test_interrupt():
    """SIGINT in a long run ends by that signal, no file written"""
    interrupted(signal.SIGINT, PAPER, 2)


def test_terminate():
    """SIGTERM in a long run ends by that signal, no file written"""
    interrupted(signal.SIGTERM, PAPER, 2)


def test_hang_up():
    """SIGHUP in a long run ends by that signal, no file written"""
    interrupted(signal.SIGHUP, PAPER, 2)


def test_interrupt_endless():
    """SIGINT where rocks never come to rest ends the program within a second"""
    with Folder() as f:
        interrupted(signal.SIGINT, f.write("endless.yaml", ENDLESS), 1)


def test_nohup():
    """A signal that the caller switched off stays off"""
    old = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with subprocess.Popen([CEDUO, "--batch", "-n", "300000", str(PAPER)], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, env=environment()) as p:
            time.sleep(0.1)
            p.send_signal(signal.SIGHUP)
            out, err = p.communicate(timeout=120)
    finally:
        signal.signal(signal.SIGHUP, old)
    expect(p.returncode == DONE and b"300000" in out and err == b"", p.returncode, out, err)


def test_interrupt_between():
    """A signal during the second scene leaves the first one's result and prints nothing half"""
    with subprocess.Popen([CEDUO, "--batch", "-f", "json", str(FOUR), "-", "-n", "10000000"], stdin=subprocess.PIPE,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment()) as p:
        time.sleep(0.2)
        p.send_signal(signal.SIGINT)
        out, _ = p.communicate(timeout=120)
    expect_equal((p.returncode, out), (-signal.SIGINT, b""))


# ---- edges of the model ----

def test_unfinished():
    """Rocks from which nothing takes energy are counted as unfinished, warned of, status 1"""
    with Folder() as f:
        path = f.write("endless.yaml", ENDLESS)
        done = ceduo("--batch", "-f", "json", "-n", 3, path)
        expect(done.status == RUN and done.err == "", done)
        run = done.json()[0]
        expect_shape(run, RESULT)
        option = run["options"][0]
        expect_equal(option["ends"], {"stopped_by_stems": 0, "came_to_rest": 0, "left_slope": 0, "unfinished": 3})
        expect_equal(option["stop_x_m"], None)
        bare = option["controls"][0]["bare"]
        expect_equal((bare["rocks_reached"], bare["reach_probability"]), (0, 0))
        expect_near(bare["reach_hi"], wilson(3, 3)[1], 1e-12, "in reach_hi as reached")
        expect(any("unfinished" in w for w in run["warnings"]), run["warnings"])
        expect_equal(option["controls"][0]["lights"]["energy"], "unknown", "rocks that may still arrive")
        done = ceduo("--batch", "-n", 3, path)
        expect(done.status == RUN and "unfinished" in done.out, done)
        words = " ".join(done.out.split())
        expect_in("3 of 3 never come to an end", words)
        expect_in("Energy: unknown.", words)
        expect_in("3 rocks never came to an end, and may arrive", words)
        expect("no rock arrives (" not in words and "fly more" not in words and "few rocks" not in words, words)


def expect_unreached(control):
    bare = control["bare"]
    expect_equal((bare["rocks_reached"], bare["reach_probability"], bare["reach_lo"]), (0, 0, 0))
    for name in ("speed_m_s", "energy_kJ", "translation_kJ", "height_m"):
        expect(all(v is None for v in bare[name].values()), name, bare[name])
    expect_equal(bare["energy_per_released_kJ"]["mean"], 0)
    expect_equal((control["index"]["residual_kJ"], control["index"]["exhausted"]), (None, None))


def test_nobody_reaches():
    """A control nobody reaches: nulls in JSON, empty in CSV, 'below' with its bound in the table"""
    with Folder() as f:
        path = f.write("pit.yaml", scene(slope={"vertices_m": [[0, 10], [10, 0], [20, 10], [40, 10]],
                                                "segments": [{"rn": 0.3, "rt": 0.8}]},
                                         controls=[{"x_m": 8}, {"x_m": 39, "accepted_kJ": 5, "measured_speed_m_s": 4}],
                                         simulation={"rocks": 999}))
        run = result(path)
        expect_shape(run, RESULT)
        near, far = run["options"][0]["controls"]
        expect(near["bare"]["rocks_reached"] > 0, near)
        expect_unreached(far)
        expect_near(far["bare"]["reach_hi"], 0.0038306, 1e-6, "Wilson's bound of 0 of 999")
        text = good("--batch", path).out
        expect_order(text, "39 m", "0 \\(0", "(?i)below 3\\.8|below 0\\.4 %")
        expect("nan" not in text.lower() and "null" not in text, text)
        _, rows = read_csv(good("--batch", "-f", "csv", path).out)
        expect_rows(rows, [run], "controls")


def test_at_rest():
    """A rock released at rest: lies still on the flat, goes where it is steep"""
    with Folder() as f:
        flat = scene(release={"x_m": 5}, slope={"vertices_m": [[0, 0], [100, 0]], "segments": [{"rn": 0.3, "rt": 0.8}]})
        run = result(f.write("flat.yaml", flat))
        expect_unreached(run["options"][0]["controls"][0])
        expect_equal(run["options"][0]["ends"]["came_to_rest"], 1)
        expect_equal(run["options"][0]["stop_x_m"], {"p50": 5, "p95": 5, "max": 5})
        steep = result(f.write("steep.yaml", scene(release={"x_m": 5})))
        expect_equal(steep["options"][0]["controls"][0]["bare"]["reach_probability"], 1)
        none = result(f.write("none.yaml", scene(release=None)))
        expect_equal(none["options"][0]["controls"][0]["bare"]["reach_probability"], 1, "no release given")


def test_no_forest():
    """No forest: one option 'current', no stands, nulls where nothing is, the contact test fails"""
    with Folder() as f:
        for name, change in (("omitted", {}), ("empty", {"forest": []})):
            path = f.write(f"{name}.yaml", scene(**change))
            run = result(path)
            expect_shape(run, RESULT)
            option = run["options"][0]
            expect_equal((option["name"], option["stands"], len(run["options"])), ("current", [], 1))
            expect_equal(option["summary"], {"length_m": 0, "longest_gap_m": 75, "adc_m": None, "contacts": 0,
                                             "meet_nothing_probability": 1, "dissipated_kJ": 0,
                                             "dissipated_kJ_per_100m": None, "passes_threshold": False})
            control = option["controls"][0]
            expect_near(control["index"]["residual_kJ"], control["bare"]["energy_kJ"]["mean"], 1e-12, "residual")
            expect_equal((control["lights"]["contact"], control["lights"]["energy"]), ("fail", "unknown"))
            expect_order(good("--batch", path).out, "FAILS", "(?i)no forest")


def test_no_stands_csv():
    """No forest: --rows stands is a header without rows, on standard output and in a file"""
    with Folder() as f:
        path, target = f.write("s.yaml", scene()), f.path / "out.csv"
        text = good("--batch", "-f", "csv", "--rows", "stands", path).out
        expect(text, "nothing is printed, not even the header")
        header, rows = read_csv(text)
        expect_equal((len(header), rows), (len(STAND_CELLS), []))
        good("--batch", "-f", "csv", "--rows", "stands", "-o", target, path)
        expect_equal(target.read_text(), text)


def test_no_stems():
    """A stand without stems: null ADC and rule, no contacts, free run certain"""
    with Folder() as f:
        shipped = scene(forest=[{"from_m": 10, "to_m": 70, "stand": "../stands/bare.yaml"}])
        for name, path in (("empty", f.write("a.yaml", scene(forest=[{"from_m": 10, "to_m": 70, "stand": {"name": "e"}}]))),
                           ("bare", f.write("b.yaml", shipped))):
            run = result(path)
            expect_shape(run, RESULT)
            found = run["options"][0]["stands"][0]
            expect(all(v is None for v in found["adc"].values()), name, found["adc"])
            expect_equal((found["contacts"], found["energy_per_contact_J"], found["passes_threshold"],
                          found["free_run_probability"], found["dissipated_kJ"], found["basal_area_m2_ha"]),
                         (0, None, False, 1, 0, 0), name)
            expect_equal(run["options"][0]["controls"][0]["lights"]["contact"], "fail", name)
            text = good("--batch", path).out
            expect("nan" not in text.lower() and " inf" not in text.lower(), text)


def test_wall():
    """A slope that ends in a wall stops the rocks there, and nothing is unfinished"""
    with Folder() as f:
        walled = scene(slope={"vertices_m": [[0, 64], [100, 0], [100.01, 200]],
                              "segments": [{"rn": 0.35, "rt": 0.875, "roughness_rad": 0.125}]},
                       controls=[{"x_m": 99}, {"x_m": 100.005}])
        run = result(f.write("wall.yaml", walled))
        expect_shape(run, RESULT)
        ends = run["options"][0]["ends"]
        expect_equal((ends["came_to_rest"], ends["unfinished"]), (1, 0))
        expect(run["options"][0]["stop_x_m"]["max"] <= 100.01, run["options"][0]["stop_x_m"])
        expect(run["options"][0]["controls"][0]["bare"]["rocks_reached"] > 0, "the wall stands behind the control")


# ---- extremes of a wood ----

# So light that a hit takes nothing to speak of, so tall that no rock flies over it: the way is that without forest.
GHOST = {"height_m": 60, "volume_m3": 1e-9}


def ghosts(stools=2000, spacing=0.25, shoots=5000, dbh=0.0625, trees=0, tree_dbh=0.25, **changes):
    """A stand of such stems."""
    made = {"stools": {"per_ha": stools, "spacing_m": spacing}, "shoots": [{**GHOST, "per_ha": shoots, "dbh_m": dbh}]}
    made = stand(**(made if stools else {"stools": None, "shoots": None}),
                 trees=[{**GHOST, "per_ha": trees, "dbh_m": tree_dbh}] if trees else [])
    made.update(changes)
    return made


def expect_contacts(found, length, rate, rocks, what, clumps=1.0):
    """A mean number of hits over so many metres; `clumps`: how many come at once, for the error where few were seen."""
    contacts = found["contacts"]
    wanted = length * rate
    error = max(contacts["se"], math.sqrt(wanted * clumps / rocks))
    expect_near(contacts["mean"], wanted, 4.5 * error + 1e-4 * wanted, what)


EXTREMES = [
    # (what, stand, rocks, shoots that come at once)
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
        path = f.write("s.yaml", wooded_scene(forest=[{"from_m": 10, "to_m": 95, "stand": wood}], simulation={"rocks": rocks}))
        for model in ("poisson", "stems"):
            run = result(path, *through(model))
            expect_run(run, model)
            option = run["options"][0]
            control = option["controls"][1]
            adc = option["stands"][0]["adc"]
            rate = 1 / adc["gsteiger_stems_m" if model == "stems" else "adc_m"]
            expect_contacts(control["wooded"], 85, rate, rocks, f"{model}: stems met", clumps if model == "stems" else 1)
            bare = control["bare"]
            for name in ("reach_probability", "exceed_probability"):
                expect_near(control["wooded"][name], bare[name], 0.003, f"{model}: {name}")
            expect_near(control["wooded"]["energy_kJ"]["mean"], bare["energy_kJ"]["mean"], 0.02 * bare["energy_kJ"]["mean"],
                        f"{model}: such stems take nothing")
            text = good("--batch", path, "-n", min(rocks, 500), *through(model)).out
            expect("nan" not in text.lower() and "inf " not in text.lower(), text)
            expect_width(text)


def test_release_in_belt():
    """A release inside a belt meets what stands from there on, whichever belts stand behind it"""
    with Folder() as f:
        wood = ghosts(trees=300)
        for forest in ([(10, 95)], [(10, 50), (50, 95)], [(0, 30), (40, 95)]):
            path = f.write("s.yaml", wooded_scene(forest=[{"from_m": a, "to_m": b, "stand": wood} for a, b in forest]))
            for model in ("poisson", "stems"):
                for release in ("50", "{mean: 50, spread: 9.5, kind: uniform}"):
                    run = result(path, *through(model), "-s", f"release.x_m={release}")
                    expect_run(run, model)
                    adc = run["options"][0]["stands"][0]["adc"]
                    rate = 1 / adc["gsteiger_stems_m" if model == "stems" else "adc_m"]
                    expect_contacts(run["options"][0]["controls"][1]["wooded"], 45, rate, 2000, f"{model}, {forest}, {release}", 3)


def test_release_uphill():
    """Rocks thrown uphill meet the stems there once, not again on their way down, and those below the release"""
    with Folder() as f:
        wood = ghosts(stools=0, trees=2000)
        uphill = {"x_m": 50, "height_m": 1, "vx_m_s": -9, "vz_m_s": 8}
        options = [{"name": name, "forest": [{"from_m": a, "to_m": b, "stand": wood}]}
                   for name, a, b in (("all", 0, 105), ("above", 0, 50), ("below", 50, 105), ("top", 0, 25))]
        path = f.write("s.yaml", wooded_scene(forest=None, release=uphill, options=options, controls=[{"x_m": 105}]))
        for model in ("poisson", "stems"):
            run = result(path, *through(model))
            expect_run(run, model)
            met = {o["name"]: o["controls"][0]["wooded"]["contacts"] for o in run["options"]}
            adc = run["options"][0]["stands"][0]["adc"]["adc_m"]
            error = 4.5 * math.hypot(met["all"]["se"], met["above"]["se"], met["below"]["se"])
            expect_near(met["below"]["mean"] * adc, 55, 4.5 * met["below"]["se"] * adc, f"{model}: metres below the release")
            expect(2 < met["above"]["mean"] * adc < 25, f"{model}: metres above the release", met)
            expect_near(met["all"]["mean"], met["above"]["mean"] + met["below"]["mean"], error, f"{model}: all")
            expect_equal(met["top"], {"mean": 0, "se": 0}, f"{model}: where no rock comes")
        stopping = {**wood, "trees": [{"per_ha": 4000, "dbh_m": 0.4, "height_m": 60, "volume_m3": 5}]}
        path = f.write("s.yaml", wooded_scene(release=uphill, forest=[{"from_m": 0, "to_m": 50, "stand": stopping}]))
        option = result(path)["options"][0]
        expect(option["ends"]["stopped_by_stems"] > 0.9 and option["stop_x_m"]["max"] < 160, option["ends"])
        expect(option["stop_x_m"]["p50"] < 50, "stopped above their release", option["stop_x_m"])


def test_dbh_spread():
    """dbh_sd_m: as many stems are met as with their mean diameter"""
    with Folder() as f:
        shoots = [{**GHOST, "per_ha": 5000, "dbh_m": 0.0625, "dbh_sd_m": 0.03}]
        trees = [{**GHOST, "per_ha": 300, "dbh_m": 0.25, "dbh_sd_m": 0.15}]
        for name, wood in (("shoots", stand(shoots=shoots, trees=[])), ("trees", stand(stools=None, shoots=None, trees=trees))):
            path = f.write("s.yaml", wooded_scene(forest=[{"from_m": 10, "to_m": 95, "stand": wood}]))
            for model in ("poisson", "stems"):
                run = result(path, *through(model))
                expect_run(run, model)
                adc = run["options"][0]["stands"][0]["adc"]
                rate = 1 / adc["gsteiger_stems_m" if model == "stems" else "adc_m"]
                expect_contacts(run["options"][0]["controls"][1]["wooded"], 85, rate, 2000, f"{model}, {name}", 3)


def taken_per_contact(folder, wood, model):
    """kJ that a rock too heavy to be turned by them loses to a stem, just behind a short belt; its error; and W of Eq. 3."""
    path = folder.write("s.yaml", wooded_scene(
        forest=None, options=[{"name": "none"}, {"name": "wood", "forest": [{"from_m": 55, "to_m": 59, "stand": wood}]}],
        rock={"shape": "sphere", "diameter_m": 3}, controls=[{"x_m": 61}], simulation={"rocks": 4000}))
    run = result(path, *through(model))
    option, difference = run["options"][1], run["differences"][0]["energy_per_released_kJ"]
    contacts = option["controls"][0]["wooded"]["contacts"]["mean"]
    return -difference["mean"] / contacts, difference["se"] / contacts, option["stands"][0]["energy_per_contact_J"] / 1000


def test_energy_taken():
    """A hit takes W of Eq. 3 (brauner), or the share of Dorren's energy that goes with its offset, 0.558 on the mean"""
    with Folder() as f:
        tree = {"per_ha": 500, "dbh_m": 0.3, "height_m": 30, "volume_m3": 0.4}
        shoot = {"per_ha": 4000, "dbh_m": 0.12, "height_m": 30, "volume_m3": 0.1}
        for energy, per_tree, per_shoot in (({"model": "brauner", "u_J_m3": 100000}, 40, 10),
                                            ({"model": "dorren", "fracture_ratio": 1.5}, 0.558 * 1.5 * 0.0387 * 30 ** 2.31,
                                             0.558 * 1.5 * 0.0387 * 12 ** 2.31)):
            trees = stand(stools=None, shoots=None, trees=[tree], energy=energy)
            shoots = stand(stools={"per_ha": 1500, "spacing_m": 0.4}, shoots=[shoot], trees=[], energy=energy)
            for wood, wanted in ((trees, per_tree), (shoots, per_shoot)):
                for model in ("poisson", "stems"):
                    found, error, said = taken_per_contact(f, wood, model)
                    expect_near(said, wanted, 0.002 * wanted, f"{energy['model']}: energy_per_contact_J")
                    # the ground that is hit between takes its share of what a stem left
                    expect_near(found, wanted, 4.5 * error + 0.06 * wanted, f"{energy['model']}, {model}: taken by a hit")


def test_energy_spread():
    """dbh_sd_m: the thicker stems, which are met more often than the thin ones, take more"""
    with Folder() as f:
        mean, sd, rock = 0.3, 0.12, 3
        shape, scale = (mean / sd) ** 2, sd * sd / mean
        cube = shape * (shape + 1) * (shape + 2) * scale ** 3
        # W goes with the square of the diameter, the chance to be met with the rock's width and the diameter
        wanted = 40 * (rock + cube / (mean ** 2 + sd ** 2)) / (rock + mean)
        tree = {"per_ha": 500, "dbh_m": mean, "dbh_sd_m": sd, "height_m": 30, "volume_m3": 0.4}
        trees = stand(stools=None, shoots=None, trees=[tree])
        shoots = stand(stools={"per_ha": 500, "spacing_m": 0.4}, shoots=[tree], trees=[])
        for name, wood in (("trees", trees), ("shoots", shoots)):
            found, error, _ = taken_per_contact(f, wood, "stems")
            expect_near(found, wanted, 4.5 * error + 0.06 * wanted, name)
        spread = [taken_per_contact(f, {**trees, "trees": [{**tree, "dbh_sd_m": s}]}, "stems")[0] for s in (0, sd)]
        expect(spread[0] != spread[1], "a spread of diameters changes nothing")


def test_dorren_thin():
    """dorren below 10 cm: a warning with the stand's name, in JSON, on the page and in CSV"""
    with Folder() as f:
        path = f.write("s.yaml", wooded_scene(forest=[belt(10, 95, energy={"model": "dorren", "fracture_ratio": 1.5})]))
        run = result(path)
        expect_run(run)
        expect(any("dorren" in w and "10 cm" in w and "coppice" in w for w in run["options"][0]["stands"][0]["warnings"]),
               run["options"][0]["stands"][0]["warnings"])
        expect_in("below 10 cm", re.sub(r"\s+", " ", good("--batch", path).out), "page")
        expect_in("below 10 cm", good("--batch", "-f", "csv", path).out, "CSV")


def test_height_of_stems():
    """A stem is hit only by a rock below its top; poisson asks for no height"""
    with Folder() as f:
        # the first flight goes some 18 m out and 14 m high over a belt of low stems
        mapping = wooded_scene(release={"height_m": 20, "vx_m_s": 8},
                               slope={"vertices_m": [[0, 60], [100, 50], [160, 45]], "segments": [{"rn": 0.3, "rt": 0.5}]},
                               controls=[{"x_m": 12}])
        for height, hits in ((0.5, False), (3, False), (40, True)):
            low = stand(stools=None, shoots=None, trees=[{"per_ha": 3000, "dbh_m": 0.2, "height_m": height, "volume_m3": 1e-9}])
            path = f.write("s.yaml", {**mapping, "forest": [{"from_m": 2, "to_m": 11, "stand": low}]})
            stems, poisson = (result(path, *through(m))["options"][0]["controls"][0] for m in ("stems", "poisson"))
            expect_equal(stems["bare"]["reach_probability"], 1)
            expect((stems["wooded"]["contacts"]["mean"] > 1) == hits, f"stems of {height} m", stems["wooded"]["contacts"])
            expect(hits or stems["wooded"]["contacts"]["mean"] == 0, f"stems of {height} m", stems["wooded"]["contacts"])
            expect_near(poisson["wooded"]["contacts"]["mean"], 9 / (1e4 / (3000 * 0.95)), 0.15, f"poisson, stems of {height} m")


def test_belt_beyond():
    """A belt beyond the slope is refused with its place, in the file and from the command line"""
    with Folder() as f:
        for change, path, words in (({"to_m": 200}, "forest[0].to_m", "beyond the slope"),
                                    ({"from_m": 170, "to_m": 200}, "forest[0]", "beyond the slope")):
            mapping = wooded_scene(forest=[{**belt(10, 95), **change}])
            done = ceduo("--batch", f.write("s.yaml", mapping))
            expect(done.status == INPUT and done.out == "", done)
            expect(re.search(rf"s\.yaml:\d+:\d+: {re.escape(path)}", done.err) and words in done.err and "^" in done.err, done)
        done = ceduo("--batch", "-s", "forest[0].to_m=200", f.write("s.yaml", wooded_scene()))
        expect(done.status == USAGE and "forest[0].to_m" in done.err and "beyond the slope" in done.err, done)


def test_fewer_shoots():
    """Fewer shoots than stools, stools without shoots, no spacing: refused with their place"""
    with Folder() as f:
        path = f.write("s.yaml", wooded_scene())
        for change, words in (("forest[0].stand.shoots[0].per_ha=1000", "shoots"), ("forest[0].stand.shoots=[]", "shoots"),
                              ("forest[0].stand.stools.spacing_m=-1", "spacing_m"), ("forest[0].stand.trees[0].dbh_sd_m=-0.1", "dbh_sd_m"),
                              ("forest[0].stand.shoots[0].height_m=0", "height_m")):
            done = ceduo("--batch", "-s", change, path)
            expect(done.status in (USAGE, INPUT) and done.out == "" and words in done.err and "^" in done.err, done)


def shifted(by, up):
    """The same scene at another place; every coordinate is a multiple of 2^-6, so that no bit is lost."""
    points = [[0, 64], [10.5, 50.25], [30.125, 40], [52.75, 22.5], [80, 8.125], [110.25, 0], [300, 0]]
    belts = [{"from_m": 0, "to_m": 40.25, "stand": stand()}, {"from_m": 45.5, "to_m": 90, "stand": stand(name="second")}]
    return scene(release={"x_m": 2.5 + by, "vx_m_s": {"mean": 2, "spread": 0.5}},
                 slope={"vertices_m": [[x + by, z + up] for x, z in points],
                        "segments": [{"rn": 0.35, "rt": 0.875, "roughness_rad": 0.25, "friction": 0.5}]},
                 controls=[{"x_m": 60.5 + by, "accepted_kJ": 20, "measured_speed_m_s": 9}, {"x_m": 100 + by}],
                 forest=[{**b, "from_m": b["from_m"] + by, "to_m": b["to_m"] + by} for b in belts])


def test_survey_coordinates():
    """Survey coordinates give the same numbers, bit by bit, and are printed as given"""
    with Folder() as f:
        near, far = (f.write("s.yaml", shifted(by, up)) and result(f.path / "s.yaml", "-n", 3000)
                     for by, up in ((0, 0), (480000, 4096)))
        for a, b in zip(near["options"], far["options"]):
            expect_equal(a["summary"], b["summary"], "summary")
            expect_equal(a["ends"], b["ends"], "ends")
            for c, d in zip(a["controls"], b["controls"]):
                expect_equal(c["x_m"] + 480000, d["x_m"], "x_m")
                expect_equal({k: v for k, v in c.items() if k != "x_m"}, {k: v for k, v in d.items() if k != "x_m"})
            for c, d in zip(a["stands"], b["stands"]):
                expect_equal((c["from_m"] + 480000, c["to_m"] + 480000), (d["from_m"], d["to_m"]), "belt")
                expect_equal(c["adc"], d["adc"])
            expect(a["stop_x_m"] is not None, "no rock stops: this compares nothing")
            for key in ("p50", "p95", "max"):
                expect_near(b["stop_x_m"][key], a["stop_x_m"][key] + 480000, 1e-9, f"stop_x_m.{key}")


def test_spread_uses_nothing_else():
    """All options of a scene fly the same rocks, and adding an option changes no number of another"""
    run = result(FOUR, "-n", 300)
    expect(all(o["controls"][0]["bare"] == run["options"][0]["controls"][0]["bare"] for o in run["options"]), "bare")
    one = result(FOUR, "-n", 300, "--option", "large reserves")["options"][0]
    expect_equal([o for o in run["options"] if o["name"] == "large reserves"], [one])


def main():
    suite = Suite()
    suite.run(tests_of(sys.modules[__name__]))
    for value, words in BAD_SETS:
        suite.check(f"-s {ascii(value)}: status 2, {words}", bad_set, value, words)
    for case in EXTREMES:
        suite.check(f"a wood of {case[0]}: as many stems are met as stand in the way", extreme, *case)
    for arguments in BAD_USAGE:
        shown = " ".join(ascii(str(a))[1:-1] if a != PAPER else a.name for a in arguments)
        suite.check(f"ceduo {shown}: status 2, one line and where the help is", bad_usage, *arguments)
    suite.end()


if __name__ == "__main__":
    main()
