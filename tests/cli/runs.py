# SPDX-License-Identifier: GPL-3.0-or-later
"""Helpers for runs of --batch: the shape of JSON, the cells of CSV, scenes."""
import csv
import io
import math
import re

from harness import PROFILES, expect, expect_equal, expect_near, scene, wooded_scene

PAPER = PROFILES / "scenes" / "paper-site.yaml"
FOUR = PROFILES / "scenes" / "four-systems.yaml"

NUMBER, MAYBE, TEXT, TEXT_OR_NULL, FLAG, FLAG_OR_NULL, COUNT, NULL, LIGHT = (
    "number", "number or null", "text", "text or null", "flag", "flag or null", "count", "null", "light")
SPREAD = {k: MAYBE for k in ("mean", "se", "sd", "p50", "p50_lo", "p50_hi", "p95", "p95_lo", "p95_hi", "p99", "p99_lo",
                              "p99_hi", "max")}
PAIR = {"mean": MAYBE, "se": MAYBE}
SHARES = {**PAIR, "below": MAYBE}  # a difference of shares
SHAPE_OF_DIFFERENCE = {"reach_probability": SHARES, "exceed_probability": SHARES, "energy_per_released_kJ": PAIR}
MISSED = {k: NUMBER for k in ("stopped_by_stems", "came_to_rest", "left_slope", "unfinished")}
HAZARD = {"per_year": NUMBER, "effective_rocks": NUMBER, "reach_per_year": NUMBER, "reach_years": MAYBE, "accepted_return_y": MAYBE,
          "exceed_rate": NULL,  # with --details a list
          "return": [{"years": NUMBER, **{k: MAYBE for k in ("energy_kJ", "lo", "hi")}}],
          **{k: MAYBE for k in ("exceed_per_year", "accepted_years", "accepted_years_lo", "accepted_years_hi", "rate_left")},
          "matrix": [{"intensity": TEXT, "from_kJ": NUMBER, "to_kJ": MAYBE, "per_year": NUMBER, "lo": NUMBER, "hi": NUMBER,
                      "rate_left": MAYBE, **{k: FLAG for k in ("to_30_years", "to_100_years", "to_300_years")}}]}
CHOICE = {"height_m": COUNT, "class": MAYBE, "energy_kJ": MAYBE, "defeated": NUMBER, "decided": FLAG}  # null: no class is enough
ENOUGH = {"enough": [CHOICE], "smallest": CHOICE}
FENCED = {**{f"{k}{end}": NUMBER for k in ("over", "through", "both", "defeated", "worn") for end in ("", "_lo", "_hi")},
          "per_year": MAYBE, "in_life": MAYBE, **ENOUGH}  # null without a fence
FENCE_WINDOW = {**{k: NUMBER for k in ("mean", "mean_lo", "mean_hi", "worst", "worst_lo", "worst_hi")}, "worst_year": COUNT,
                "failing_years": COUNT, "per_year": MAYBE, "in_life": MAYBE, **ENOUGH}  # null if all years are equal
FENCE = {"energy_kJ": NUMBER, "height_m": NUMBER, "life_y": NUMBER, "window": FENCE_WINDOW}
DESIGN_VALUES = {k: MAYBE for k in ("speed_m_s", "energy_kJ", "height_m", "class", "class_gamma_e")}
DESIGN = {"factors": {"survey": NUMBER, "model": NUMBER, "blocks": NUMBER, "gamma_e": MAYBE}, "bare": DESIGN_VALUES,
          "arrivals": DESIGN_VALUES, "system": DESIGN_VALUES, "worst": {"arrivals": DESIGN_VALUES, "system": DESIGN_VALUES}}
ARRIVALS = {"rocks_reached": COUNT, "reach_probability": NUMBER, "reach_lo": NUMBER, "reach_hi": NUMBER,
            "exceed_probability": MAYBE, "exceed_lo": MAYBE, "exceed_hi": MAYBE, "speed_m_s": SPREAD,
            "energy_kJ": SPREAD, "translation_kJ": SPREAD, "height_m": SPREAD, "energy_per_released_kJ": PAIR, "fence": FENCED,
            "missed": MISSED, "hazard": HAZARD}  # null without blocks
INDEX = {"dissipated_kJ": MAYBE, "residual_kJ": MAYBE, "exhausted": FLAG_OR_NULL, "measured_kJ": MAYBE}
WOODED = {**ARRIVALS, "contacts": PAIR}
OTHER = {"model": TEXT, "rocks": COUNT, "reach_probability": NUMBER, "reach_lo": NUMBER, "reach_hi": NUMBER, "exceed_probability": MAYBE,
         "exceed_lo": MAYBE, "exceed_hi": MAYBE, "energy_kJ": PAIR,
         "verdict": {"answer": TEXT_OR_NULL}}  # null without stems
TOPOGRAPHY = {"reach_angle_deg": NUMBER, "shadow_angle_deg": MAYBE}
CONTROL = {"x_m": NUMBER, "name": TEXT_OR_NULL, "accepted_kJ": MAYBE, "fence": FENCE, "topography": TOPOGRAPHY,
           "bare": ARRIVALS, "index": INDEX, "wooded": WOODED, "other_energy": OTHER, "design": DESIGN,
           "lights": {"contact": LIGHT, "free_run": LIGHT, "energy": LIGHT, "contact_8cm": LIGHT, "free_run_8cm": LIGHT},
           "verdict": {"answer": TEXT_OR_NULL, "today": TEXT_OR_NULL, "class": MAYBE, "why": TEXT_OR_NULL, "because": TEXT}}
RULES = ("region", "standards_per_ha", "standards_least", "standards_most", "standards_met", "standards_article", "standards_year",
         "turn_y", "turn_least", "turn_most", "turn_met", "turn_article", "turn_year")
RULED = {k: TEXT_OR_NULL if k == "region" or k.endswith("article") else FLAG_OR_NULL if k.endswith("met") else MAYBE
         for k in RULES}  # null without rules
STAND = {"name": TEXT, "from_m": NUMBER, "to_m": NUMBER, "length_m": NUMBER, "stems_per_ha": NUMBER,
         "stools_per_ha": NUMBER, "trees_per_ha": NUMBER, "basal_area_m2_ha": NUMBER,
         "adc": {"rule": TEXT_OR_NULL, "adc_m": MAYBE, "gsteiger_stools_m": MAYBE, "gsteiger_stems_m": MAYBE,
                 "interception_m": MAYBE, "crofton_m": MAYBE},
         "passes_threshold": FLAG, "free_run_probability": NUMBER, "contacts": NUMBER, "energy_per_contact_J": MAYBE,
         "dissipated_kJ": MAYBE, "dissipated_kJ_per_100m": MAYBE, "grouped_per_ha": NUMBER, "stumps_per_ha": NUMBER,
         "logs_per_ha": NUMBER, "warnings": [TEXT], "rules": RULED}
SUMMARY = {"length_m": NUMBER, "longest_gap_m": NUMBER, "adc_m": MAYBE, "contacts": NUMBER,
           "meet_nothing_probability": NUMBER, "dissipated_kJ": MAYBE, "dissipated_kJ_per_100m": MAYBE,
           "passes_threshold": FLAG}
YIELD = {**{k: NUMBER for k in ("cut_m3_ha_per_year", "standing_m3_ha_mean", "died_m3_ha_per_year")},
         "cuts": [{k: NUMBER for k in ("year", "from_m", "to_m", "stems_per_ha", "volume_m3_ha")}]}  # null without growth
# The share by which options are judged; null if all years are equal, or by the index.
WINDOW = {"from": COUNT, "to": COUNT, "mean": NUMBER, "mean_lo": NUMBER, "mean_hi": NUMBER, "worst": NUMBER, "worst_year": COUNT,
          "failing_years": MAYBE}
STOPS = {"p50": NUMBER, "p95": NUMBER, "max": NUMBER}
DIFFERENCES = tuple(SHAPE_OF_DIFFERENCE)
DIFFERENCE = {"option": TEXT, "against": TEXT, "x_m": NUMBER, **SHAPE_OF_DIFFERENCE}
RESULT = {"format": TEXT, "version": TEXT, "scene": TEXT, "title": TEXT, "seed": COUNT, "rocks": COUNT, "law": TEXT,
          "rock": {"mass_kg": NUMBER, "mean_diameter_m": NUMBER, "moment_kg_m2": NUMBER},
          "slope": {"points": COUNT, "used": COUNT, "tolerance_m": NUMBER}, "threshold_m": NUMBER,
          "warnings": [TEXT],
          "options": [{"name": TEXT, "stands": [STAND], "summary": SUMMARY, "controls": [CONTROL],
                       "ends": {"stopped_by_stems": NUMBER, "came_to_rest": NUMBER, "left_slope": NUMBER,
                                "unfinished": COUNT},
                       "stop_x_m": STOPS, "window": WINDOW, "years": NULL, "rotation": NULL, "yield": YIELD}],
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
    """Expect exactly the keys and types of a shape."""
    if isinstance(shape, str):
        expect(KINDS[shape](value), f"{path}: {value!r} is no {shape}")
    elif isinstance(shape, list):
        expect(isinstance(value, list), f"{path}: {value!r} is no list")
        expect(shape or not value, f"{path}: {value!r} is not empty")
        for i, item in enumerate(value):
            expect_shape(item, shape[0], f"{path}[{i}]")
    elif shape in (STOPS, YIELD, OTHER, HAZARD, RULED, WINDOW, CHOICE, FENCED, FENCE, FENCE_WINDOW, DESIGN) and value is None:
        return
    else:
        expect(isinstance(value, dict), f"{path}: {value!r} is no object")
        expect(set(shape) == set(value),
               f"{path}: missing {sorted(set(shape) - set(value))}, too many {sorted(set(value) - set(shape))}")
        for key in shape:
            expect_shape(value[key], shape[key], f"{path}.{key}")


def index_shape(shape):
    """Return the shape of a run with contact_model index: nothing is known with forest."""
    if shape is WOODED or shape is OTHER or shape is WINDOW:
        return NULL
    if isinstance(shape, list):
        return [index_shape(item) for item in shape]
    special = shape in (INDEX, STOPS, HAZARD, RULED, CHOICE, FENCED, FENCE, DESIGN) if isinstance(shape, dict) else True
    return shape if special else {key: index_shape(inner) for key, inner in shape.items()}


INDEX_RESULT = index_shape(RESULT)
MODEL = "simulation.contact_model"
MODELS = ("index", "stems")


def through(model):
    """Return command-line options for a contact model."""
    return ("-s", f"{MODEL}={model}")


def warned(run):
    """Return the warnings of a run, except about rocks that stems stop just below the release."""
    return [w for w in run["warnings"] if "of the release, where they are slow" not in w]


def expect_run(run, model="stems"):
    """Expect the shape of a run, and rules that hold for any scene."""
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
        expect_window(option)
    expect_differences(run)


def expect_window(option):
    """Expect the years by which an option is judged; without them today's answer holds."""
    window = option["window"]
    if window is None:
        for verdict in (c["verdict"] for c in option["controls"]):
            expect_equal(verdict["answer"], verdict["today"], "the answer without years")
        return
    expect(1 <= window["from"] <= window["worst_year"] <= window["to"] <= 60 and window["to"] >= 20, "years", window)
    expect(0 <= window["mean_lo"] <= window["mean"] <= min(window["mean_hi"], window["worst"] + 1e-12), "shares", window)
    expect((window["failing_years"] or 0) <= window["to"] - window["from"] + 1, "years that fail", window)


def energy_light(control):
    wooded = control["wooded"]
    if wooded is None or control["accepted_kJ"] is None:
        return "unknown"
    hazard = wooded["hazard"]  # with blocks the limit is a number of years between two such rocks
    limit = 1 / hazard["accepted_return_y"] / hazard["per_year"] if hazard else 0.05
    return "pass" if wooded["exceed_probability"] <= limit else "fail"


def flown(control):
    """Return the compared run: with forest, or without it by the index."""
    return control["wooded"] or control["bare"]


def no_difference(name, mean=0):
    """Between equal runs the difference is exactly 0; None: unknown."""
    return {"mean": mean, "se": mean, **({"below": None} if "below" in SHAPE_OF_DIFFERENCE[name] else {})}


def expect_differences(run):
    """Expect option minus baseline, for each other option and control, in order."""
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
                expect_equal(found[name], no_difference(name, None), f"{where}: {name}")
                continue
            size = max(1, *map(abs, values))
            expect_near(found[name]["mean"], values[0] - values[1], 1e-12 * size, f"{where}: {name}")
            none_differs = found[name]["mean"] == 0 and found[name]["se"] is None
            expect(run["rocks"] < 2 or none_differs or found[name]["se"] >= 0, where, found)
            expect("below" not in found[name] or none_differs == (found[name]["below"] is not None), where, found)
            if control["wooded"] is None:
                expect_equal(found[name], no_difference(name), f"{where}: {name} by the index")


def wilson(k, n):
    z = 1.959963984540054
    middle, half = k / n + z * z / (2 * n), z * math.sqrt(k / n * (1 - k / n) / n + z * z / (4 * n * n))
    return (middle - half) / (1 + z * z / n), (middle + half) / (1 + z * z / n)


def without_seconds(text):
    return re.sub(r'"seconds": [^}]*', "", text)


HAZARD_CELLS = (["per_year", "effective_rocks"] +
                [f"return[{t}].{k}" for t in range(4) for k in ("years", "energy_kJ", "lo", "hi")] +
                ["reach_per_year", "reach_years", "exceed_per_year", "accepted_years", "accepted_years_lo",
                 "accepted_years_hi", "accepted_return_y"] +
                [f"matrix[{i}].{k}" for i in range(3)
                 for k in ("intensity", "from_kJ", "to_kJ", "per_year", "lo", "hi", "rate_left", "to_30_years", "to_100_years",
                           "to_300_years")] + ["rate_left"])


def flat(prefix, shape):
    """Return the names of the cells of an object."""
    names = []
    for key, inner in shape.items():
        if key == "hazard":
            names += [f"{prefix}hazard.{cell}" for cell in HAZARD_CELLS]
            continue
        if key == "enough":
            names += [f"{prefix}enough[{i}].{cell}" for i in range(7) for cell in CHOICE]
            continue
        names += flat(f"{prefix}{key}.", inner) if isinstance(inner, dict) else [prefix + key]
    return names


SCENE_CELLS = ["scene", "title", "seed", "rocks", "law", "rock.mass_kg", "rock.mean_diameter_m", "rock.moment_kg_m2",
               "slope.points", "slope.used", "slope.tolerance_m", "threshold_m", "option"]
CONTROL_CELLS = (SCENE_CELLS + flat("summary.", SUMMARY) + ["x_m", "name", "accepted_kJ"] + flat("fence.", FENCE) + flat("topography.", TOPOGRAPHY) +
                 flat("bare.", ARRIVALS) + flat("index.", INDEX) + flat("wooded.", WOODED) + flat("other_energy.", OTHER) +
                 flat("design.", DESIGN) + ["lights.contact", "lights.free_run", "lights.energy", "lights.contact_8cm", "lights.free_run_8cm",
                  "verdict.answer", "verdict.today", "verdict.class", "verdict.why", "verdict.because", "ends.stopped_by_stems", "ends.came_to_rest", "ends.left_slope", "ends.unfinished"] +
                 flat("stop_x_m.", STOPS) + flat("difference.", SHAPE_OF_DIFFERENCE) +
                 [f"yield.{k}" for k in YIELD if k != "cuts"] + ["warnings", "worst.year", "worst.exceed", "uncertainty.p5", "uncertainty.p95", "version"])
STAND_CELLS = (SCENE_CELLS + [n for n in flat("", STAND) if n != "warnings"] + ["warnings"])


def read_csv(text):
    rows = list(csv.reader(io.StringIO(text), strict=True))
    expect(all(len(row) == len(rows[0]) for row in rows), "rows of different length", [len(r) for r in rows])
    return rows[0], [dict(zip(rows[0], row)) for row in rows[1:]]


def find_value(mapping, name):
    for key in re.findall(r"[^.\[\]]+", name):
        if mapping is None:
            return None
        mapping = mapping[int(key)] if isinstance(mapping, list) else mapping.get(key)
    return mapping


def is_formula(text):
    """True if a spreadsheet would evaluate it."""
    try:
        float(text)
        return text.startswith("+")
    except ValueError:
        return text[:1] in ("=", "+", "@", "\t") or (text[:1] == "-" and len(text) > 1)


def expect_cell(cell, value, name):
    if value is None:
        expect_equal(cell, "", name)
    elif isinstance(value, bool):
        expect_equal(cell, "true" if value else "false", name)
    elif isinstance(value, str):
        expect_equal(cell, "'" + value if is_formula(value) else value, name)
    else:
        expect(cell != "" and float(cell) == value, f"{name}: found {cell!r}, wanted {value!r}")


def expect_rows(rows, runs, inner):
    """Expect CSV rows to equal the JSON of the same runs. inner: 'controls' or 'stands'."""
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
                value = find_value(run, name)
            elif name.startswith("difference."):
                found = [d for d in run["differences"] if (d["option"], d["x_m"]) == (option["name"], item["x_m"])]
                value = find_value(found[0], name.removeprefix("difference.")) if found else None
            elif name.split(".")[0] in ("summary", "ends", "stop_x_m", "yield"):
                value = find_value(option, name)
            elif name == "version":
                value = run["version"]
            elif name.startswith("worst."):  # the window of JSON is that of the last control
                if item["x_m"] < max(c["x_m"] for c in option["controls"]):
                    continue
                value = find_value(option, {"worst.year": "window.worst_year", "worst.exceed": "window.worst"}[name])
            else:
                value = find_value(item, name)
            expect_cell(cell, value, f"{option['name']} {name}")


THIN = {"name": "thin", "species": "ostrya-carpinifolia", "stools": {"per_ha": 2000, "spacing_m": 0.25},
        "shoots": [{"per_ha": 8000, "dbh_m": 0.02, "height_m": 6, "volume_m3": 0.0001}], "energy": {"u_J_m3": 100000}}
THICK = {"name": "thick", "species": "ostrya-carpinifolia",
         "trees": [{"per_ha": 300, "dbh_m": 0.4, "height_m": 18, "volume_m3": 1}], "energy": {"u_J_m3": 100000}}


def treated(**stands):
    """Return a scene with one option per stand, with its name; None is no forest."""
    return wooded_scene(forest=None, options=[
        {"name": name.replace("_", " "), "forest": [{"from_m": 0, "to_m": 105, "stand": st}] if st else []}
        for name, st in stands.items()])


# These rocks lose no energy and make the maximum number of contacts. Under crsp Rn falls with the speed: they stop.
ENDLESS = scene(title="endless", release={"x_m": 5, "height_m": 3},
                slope={"vertices_m": [[0, 0], [100, 0]], "segments": [{"rn": 1, "rt": 1, "roughness_rad": 0, "friction": 0}]},
                controls=[{"x_m": 30, "accepted_kJ": 1}], simulation={"rocks": 200, "law": "lumped"})
