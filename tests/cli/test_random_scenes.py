#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: slow full
"""Random scenes from the table of parameters, also at its limits, through the whole program: page, CSV and JSON have equal and
consistent figures.

SCENES=10000 sets the number (default 250, with FULL 500), FIRST=500 the first one. SCENE=123 runs one scene and prints its
files; a failing scene is kept in the folder that the failure names.
"""
import csv
import functools
import io
import json
import math
import multiprocessing
import os
import re
import resource
import shutil
import sys
import tempfile
import traceback
import unicodedata
from collections import Counter
from fractions import Fraction
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import (CEDUO, DONE, INPUT, RUN, SANITIZED, SLOWER, Failure, Folder, Suite, ceduo, expect,  # noqa: E402
                     expect_equal, expect_schema, good, no_constant, without_unusual, option_today)
import random_scenes  # noqa: E402
from pages import parse_arrivals  # noqa: E402
from runs import is_formula  # noqa: E402

SCENES = int(os.environ.get("SCENES") or (500 if os.environ.get("FULL") else 250))
FIRST = int(os.environ.get("FIRST") or 0)
CHUNK = 25         # scenes per call of the program
SECONDS = 60       # processor seconds per call, which takes one to three; beyond this it hangs on any machine
MEMORY = 2 << 30   # bytes
WORK = 100_000     # approximate contacts and stems of all rocks of a scene; ten times more are too many
ACCEPTED = 0.6     # minimum share of valid scenes
PROCESSES = 2
KEPT = Path(os.environ.get("BUILD") or tempfile.gettempdir()).resolve() / "random-scenes"

EPSILON = 2.0 ** -52
STATISTICS = ["p50", "p95", "p99", "max"]
KINDS = ["speed_m_s", "energy_kJ", "translation_kJ", "height_m"]
LIGHTS = {"passes": "pass", "FAILS": "fail", "unknown": "unknown"}
NO_NUMBER = re.compile(r"(?<![\w])[-+]?(?:inf|nan|infinity)(?![\w])", re.IGNORECASE)


# ---- the program ----

def limits():
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS * SLOWER, SECONDS * SLOWER))
    if not SANITIZED:
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def run(folder, *arguments):
    return ceduo(*arguments, cwd=folder, preexec_fn=limits)


def table_of_parameters():
    return random_scenes.Table(good("--list-parameters").out)


def kinds_of_pictures():
    """Return the names from the program's message about an unknown picture, except those of uncertainty and of a rotation,
    which take up to thousands of runs."""
    said = ceduo("--plot", "-", "paper-site").err
    return [kind for kind in re.search(r"one of: (.*)", said)[1].split(", ") if kind not in ("uncertainty", "tradeoff", "years")]


# ---- numbers ----

def is_near(a, b, relative=1e-9, absolute=1e-290):
    return abs(a - b) <= relative * max(abs(a), abs(b)) + absolute


def expect_close(found, wanted, what, **tolerance):
    expect(found is not None and wanted is not None and is_near(found, wanted, **tolerance),
           f"{what}: found {found!r}, wanted {wanted!r}")


def expect_rising(values, what):
    known = [v for v in values if v is not None]
    expect(all(a <= b for a, b in zip(known, known[1:])), f"{what}: {values} do not rise")


def difference(found, wanted, path=""):
    """Return where two JSON values begin to differ; None: nowhere."""
    if isinstance(found, dict) and isinstance(wanted, dict) and found.keys() == wanted.keys():
        pairs = [(f"{path}.{key}", found[key], wanted[key]) for key in found]
    elif isinstance(found, list) and isinstance(wanted, list) and len(found) == len(wanted):
        pairs = [(f"{path}[{i}]", a, b) for i, (a, b) in enumerate(zip(found, wanted))]
    else:
        return None if found == wanted else f"{path}: {found!r} and not {wanted!r}"
    return next(filter(None, (difference(a, b, to) for to, a, b in pairs)), None)


def expect_same(found, wanted, what):
    differs = difference(found, wanted)
    expect(differs is None, f"{what}: {differs}")


def expect_no_words(text, what):
    """Expect no 'inf' and no 'nan' as a number; names of scenes contain neither."""
    found = NO_NUMBER.search(text)
    expect(not found, f"{what}: {found and text[max(0, found.start() - 60):found.end() + 40]!r}")


def strings(value):
    if isinstance(value, str):
        yield value
    elif isinstance(value, (dict, list)):
        for item in value.values() if isinstance(value, dict) else value:
            yield from strings(item)


# ---- properties of a scene, computed from its files ----

def mean_value(value):
    return value["mean"] if isinstance(value, dict) else value


def varies(value):
    if isinstance(value, dict):
        return value.get("spread", 0) > 0 or any(varies(v) for v in value.values())
    return isinstance(value, list) and any(varies(v) for v in value)


def mean_diameter(rock):
    shape = rock.get("shape", "sphere")
    sizes = {key: mean_value(rock[key]) for key in ("diameter_m", "height_m", "volume_m3", "mass_kg", "density_kg_m3") if key in rock}
    if shape == "cylinder":
        return (sizes["diameter_m"] + sizes["height_m"]) / 2
    if shape != "sphere":
        return sum(map(mean_value, rock["axes_m"])) / 3
    if "diameter_m" in sizes:
        return sizes["diameter_m"]
    volume = sizes["volume_m3"] if "volume_m3" in sizes else sizes["mass_kg"] / sizes.get("density_kg_m3", 2600)
    return (6 * volume / math.pi) ** (1 / 3)


def lowest_ground(case, x, within=0):
    """Return the lowest ground near x: the x of a control is exact only to its last bits."""
    xs, zs = case.xs, case.zs
    slack = 8 * EPSILON * max(abs(xs[0]), abs(xs[-1])) + within
    lowest = math.inf
    for i in range(len(xs) - 1):
        a, b = max(xs[i], x - slack), min(xs[i + 1], x + slack)
        if a <= b:
            share = (zs[i + 1] - zs[i]) / (xs[i + 1] - xs[i])
            lowest = min(lowest, zs[i] + share * (a - xs[i]), zs[i] + share * (b - xs[i]), *(
                zs[k] for k in (i, i + 1) if a <= xs[k] <= b))
    return lowest


def most_energy(case, result, x):
    """Return the maximum energy (J) of a rock at x: its release energy and its fall. NaN if rocks differ."""
    scene = case.scene
    release = scene.get("release", {})
    if isinstance(release, list):
        return math.nan
    turns = result["law"] == "arm" and mean_value(release.get("spin_rad_s", 0)) != 0  # each with the moment of its own section
    if varies(scene["rock"]) or varies(release) or turns or case.xs[-1] - case.xs[0] < 1e-290:  # few bits of an x remain
        return math.nan
    mean = {key: mean_value(value) for key, value in release.items() if key.endswith(("_m", "_s"))}
    speed2 = mean.get("vx_m_s", 0) ** 2 + mean.get("vz_m_s", 0) ** 2
    rock, gravity = result["rock"], scene["simulation"].get("gravity_m_s2", 9.81)
    spin = mean.get("spin_rad_s", 0) if result["law"] != "lumped" else 0
    start = max(lowest_ground(case, case.start), highest_ground(case, case.start)) + mean.get("height_m", 0)
    off = case.tolerance  # each point of the simplified profile lies near one of the profile; the release lies on both
    fall = start - lowest_ground(case, x, off) + off
    room = 1e-9 * (abs(start) + abs(fall)) * gravity
    return rock["mass_kg"] * (speed2 / 2 + gravity * fall + room) + rock["moment_kg_m2"] * spin ** 2 / 2


def highest_ground(case, x):
    turned = random_scenes.Case(0)
    turned.xs, turned.zs = case.xs, [-z for z in case.zs]
    return -lowest_ground(turned, x)


def check_slope(case, slope):
    """Check the points dropped from the profile; between grounds and at the release more may remain."""
    expect_equal((slope["points"], slope["tolerance_m"]), (len(case.xs), case.tolerance), "points, tolerance_m")
    expect(slope["used"] >= (2 if case.tolerance > 0 else slope["points"]), slope)


# ---- JSON: arrivals ----

def check_distribution(d, reached, what):
    if reached == 0:
        expect(all(v is None for v in d.values()), f"{what} of no rock: {d}")
        return
    expect(all(d[key] is not None for key in ("mean", *STATISTICS)), f"{what}: {d}")
    expect_rising([0] + [d[key] for key in STATISTICS], what)
    expect_rising([d["p95_lo"], d["p95"], d["p95_hi"], d["max"]], f"{what}: interval of p95")
    expect(d["p95_lo"] is None or d["p95_lo"] >= d["p50"], f"{what}: {d}")
    expect(0 <= d["mean"] <= d["max"] * (1 + 1e-12), f"{what}: mean {d['mean']!r}, max {d['max']!r}")
    if reached < 2:
        expect(d["sd"] is None and d["se"] is None, f"{what} of one rock: {d}")
        return
    most = d["max"] / 2 * math.sqrt(reached / (reached - 1))  # half at 0, half at the maximum
    expect(0 <= d["sd"] <= most * (1 + 1e-9), f"{what}: sd {d['sd']!r}, max {d['max']!r}")
    expect_close(d["se"], d["sd"] / math.sqrt(reached), f"{what}: se")


def check_share(p, lo, hi, what):
    expect(p is not None and lo is not None and hi is not None and 0 <= lo <= p <= hi <= 1, f"{what}: {lo!r} {p!r} {hi!r}")


def check_energy(case, result, a, control, what):
    """Compare energies with speeds and with the fall."""
    energy, translation, speed = a["energy_kJ"], a["translation_kJ"], a["speed_m_s"]
    reached, mass = a["rocks_reached"], result["rock"]["mass_kg"]
    for key in ("mean", *STATISTICS):
        expect(translation[key] <= energy[key], f"{what}: {key} of translation beyond that of energy")
    if result["law"] == "lumped":
        expect_same(energy, translation, f"{what}: energy of rocks without spin")
    if not varies(case.scene["rock"]) and "blocks" not in case.scene and speed["mean"] > 1e-100:
        sd = speed["sd"] or 0
        mean = mass * (speed["mean"] ** 2 + sd ** 2 * (reached - 1) / reached) / 2
        expect_close(translation["mean"] * 1000, mean, f"{what}: mean energy of the speeds")
        expect_close(translation["max"] * 1000, mass * speed["max"] ** 2 / 2, f"{what}: energy of the fastest")
    most = most_energy(case, result, control["x_m"])
    expect(not energy["max"] * 1000 > most * (1 + 1e-9) + 1e-290, f"{what}: {energy['max']!r} kJ, at most {most / 1000!r} kJ were there")


def check_weighted(a, accepted, what):
    """Rocks of many sizes count by their weights: errors are checked with the weights."""
    check_share(a["reach_probability"], a["reach_lo"], a["reach_hi"], f"{what}: reach")
    if accepted is not None:
        check_share(a["exceed_probability"], a["exceed_lo"], a["exceed_hi"], f"{what}: exceed")
        expect(a["exceed_probability"] <= a["reach_probability"] + 1e-12, f"{what}: more exceed than reach")
    for rate in a["hazard"]["exceed_rate"]:
        expect(0 <= rate["lo"] <= rate["per_year"] <= rate["hi"] <= a["hazard"]["per_year"] * (1 + 1e-12), f"{what}: {rate}")
    for over, rate in zip(a["hazard"]["exceed_rate"], a["hazard"]["exceed_rate"][1:]):
        expect(rate["per_year"] <= over["per_year"], f"{what}: more rocks exceed more: {over} {rate}")


def check_arrivals(case, result, control, which, what):
    a, n, accepted = control[which], result["rocks"], control["accepted_kJ"]
    if "blocks" in case.scene:
        check_weighted(a, accepted, what)
        return
    reached = a["rocks_reached"]
    expect(isinstance(reached, int) and 0 <= reached <= n, f"{what}: {reached} of {n}")
    expect_close(a["reach_probability"], reached / n, f"{what}: reach_probability")
    check_share(a["reach_probability"], a["reach_lo"], a["reach_hi"], f"{what}: reach")
    exceed = [a["exceed_probability"], a["exceed_lo"], a["exceed_hi"]]
    if accepted is None:
        expect_equal(exceed, [None] * 3, f"{what}: exceed")
    else:
        check_share(*exceed, f"{what}: exceed")
        expect(exceed[0] <= a["reach_probability"] and exceed[1] <= a["reach_lo"] and exceed[2] <= a["reach_hi"],
               f"{what}: more exceed than reach: {exceed}")
    for kind in KINDS:
        check_distribution(a[kind], reached, f"{what} {kind}")
    released = a["energy_per_released_kJ"]["mean"]
    if reached == 0:
        expect_equal(released, 0, f"{what}: energy_per_released_kJ")
    else:
        expect_close(released, a["energy_kJ"]["mean"] * reached / n, f"{what}: energy_per_released_kJ")
        check_energy(case, result, a, control, what)
    if accepted is not None:
        most = a["energy_kJ"]["max"] or 0
        expect(exceed[0] > 0 if most > accepted * (1 + 1e-12) else exceed[0] == 0 or most > accepted * (1 - 1e-12),
               f"{what}: {exceed[0]!r} exceed, the largest of {most!r} kJ against {accepted!r}")


def check_index(result, control, what):
    index, mean = control["index"], control["bare"]["energy_kJ"]["mean"]
    if mean is None:
        expect(index["residual_kJ"] is None and index["exhausted"] is None, f"{what}: index {index}")
        return
    if max(mean, index["dissipated_kJ"]) > 0:  # in kJ the smallest energies round to 0
        expect_equal(index["exhausted"], mean < index["dissipated_kJ"], f"{what}: exhausted, {mean!r} {index}")
    left = max(0, mean - index["dissipated_kJ"])
    expect(is_near(index["residual_kJ"], left, absolute=1e-12 * mean + 1e-290), f"{what}: residual {index}, mean {mean!r}")


def is_judged(control):
    """Return False if too few rocks arrive without forest, or the ground contradicts the terrain."""
    return control["lights"]["contact"] != "unknown"


def check_judged(result, control, what):
    """Compare with the rocks that arrive without forest and with the angles. Unfinished rocks may arrive; a bench may hold rocks."""
    rocks, reached, angles = result["rocks"], control["bare"]["rocks_reached"], control["topography"]
    none = reached == 0 or (rocks >= 1000 and reached * 1000 < rocks)
    steep = angles["reach_angle_deg"] > 35 or (angles["shadow_angle_deg"] or 0) > 32
    good = not none or count_unfinished(result) > 0 if is_judged(control) else none or (steep and reached * 100 < rocks)
    expect(good, f"{what}: {reached} of {rocks} arrive, {angles}, {control['lights']}")
    verdict = control["verdict"]
    if control["wooded"] and control["accepted_kJ"] is not None:
        expect_equal(verdict["answer"] == "nothing" and verdict["why"] != "impossible-stand", not is_judged(control), f"{what}: {verdict}")


def check_lights(result, control, what):
    lights, wooded = control["lights"], control["wooded"]
    check_judged(result, control, what)
    if not is_judged(control):
        expect_equal(set(lights.values()), {"unknown"}, what)
        return
    expect(set(lights.values()) <= set(LIGHTS.values()), f"{what}: {lights}")
    share = wooded and wooded["exceed_probability"]
    wanted = ["unknown"] if share is None else ["fail"] if share > 0.05 else ["pass", "unknown"]
    expect(lights["energy"] in wanted, f"{what}: energy {lights['energy']}, {share!r} exceed")


def check_controls(case, result, controls, stems, what):
    """`stems`: True if any stand before the control."""
    given = case.scene.get("controls") or [{"x_m": x} for x in case.scene["controls_m"]]
    expect_equal([c["x_m"] for c in controls], [g["x_m"] for g in given], f"{what}: places")
    for g, c in zip(given, controls):
        here = f"{what}, at {c['x_m']!r} m"
        expect_equal(c["name"], g.get("name"), here)
        if "accepted_kJ" in g:  # in J between, which may lose its last bit
            expect_close(c["accepted_kJ"], g["accepted_kJ"], f"{here}: accepted_kJ", relative=EPSILON)
        else:
            expect_equal(c["accepted_kJ"], None, f"{here}: accepted_kJ")
        check_arrivals(case, result, c, "bare", f"{here}, bare")
        expect_equal(c["wooded"] is None, case.scene["simulation"].get("contact_model") == "index", f"{here}: wooded null")
        if c["wooded"]:
            check_arrivals(case, result, c, "wooded", f"{here}, wooded")
            contacts = c["wooded"]["contacts"]
            expect_equal(contacts["mean"] is None, c["wooded"]["rocks_reached"] == 0, f"{here}: {contacts}")
            expect(all(v is None or v >= 0 for v in contacts.values()), f"{here}: {contacts}")
            if not stems:
                expect_same({k: v for k, v in c["wooded"].items() if k != "contacts"}, c["bare"], f"{here}: without stems")
        check_index(result, c, here)
        if "measured_speed_m_s" in g:
            expect_close(c["index"]["measured_kJ"], result["rock"]["mass_kg"] * g["measured_speed_m_s"] ** 2 / 2000,
                         f"{here}: measured_kJ")
        check_lights(result, c, here)
    for which in ("bare", "wooded"):
        reached = [c[which]["rocks_reached"] for c in sorted(controls, key=lambda c: -c["x_m"]) if c[which]]
        expect_rising(reached, f"{what}: {which} rocks, from the last control back")


# ---- JSON: stands ----

def with_per_ha(stand):
    """Return a stand with shoots per hectare instead of per stool, and diameters in m."""
    return {**stand, **{key: [{"per_ha": s.get("per_stool", 0) * stand.get("stools", {}).get("per_ha", 0),
                               "dbh_m": s.get("dbh_cm", 0) / 100, "dbh_sd_m": s.get("dbh_sd_cm", 0) / 100, **s} for s in stand[key]]
                         for key in ("shoots", "trees") if key in stand}}


def existing_stems(stand):
    return [s for s in stand.get("shoots", []) + stand.get("trees", []) if s["per_ha"] > 0]


def has_obstacles(stand):
    return bool(existing_stems(stand)) or any(stand.get(low, {}).get("per_ha", 0) > 0 for low in ("stumps", "logs"))


def has_low(s):
    return s["stumps_per_ha"] + s["logs_per_ha"] > 0


def is_met(s):
    return s["stems_per_ha"] > 0 or has_low(s)


def expect_width(found, sum_of_widths, what):
    """Expect an ADC, m, to follow from the sum of widths per hectare."""
    adc = 1e4 / sum_of_widths if sum_of_widths > 0 else math.inf
    expect(found is None if math.isinf(adc) else is_near(found, adc), f"{what}: found {found!r}, wanted {adc!r}")


def low_width(stand, b):
    """Return the width of stumps and logs, m per hectare, and their energy, kJ m per hectare."""
    stumps, logs = stand.get("stumps", {"per_ha": 0}), stand.get("logs", {"per_ha": 0})
    widths = [(stumps["per_ha"] * (b + stumps.get("diameter_m", 0)), stumps.get("energy_kJ", 0)),
              (logs["per_ha"] * (b + 2 * logs.get("length_m", 0) / math.pi), logs.get("energy_kJ", 0))]
    return sum(w for w, _ in widths), sum(w * e for w, e in widths)


def counted(stems, least):
    return [t for t in stems if t["dbh_m"] >= least]


def check_adc(stand, s, b, least, what):
    adc, shoots, trees = s["adc"], counted(stand.get("shoots", []), least), counted(stand.get("trees", []), least)
    low = low_width(stand, b)[0]
    stools = min(stand["stools"]["per_ha"], sum(t["per_ha"] for t in shoots)) if shoots else 0
    all_stems, n_shoots, n_trees = shoots + trees, sum(t["per_ha"] for t in shoots), sum(t["per_ha"] for t in trees)
    mean = sum(t["per_ha"] * t["dbh_m"] for t in all_stems) / (n_shoots + n_trees) if n_shoots + n_trees > 0 else 0
    width_of_trees = sum(t["per_ha"] * (b + t["dbh_m"]) for t in trees) + low
    expect_width(adc["gsteiger_stools_m"], (stools + n_trees) * (b + mean) + low, f"{what}: gsteiger-stools")
    expect_width(adc["gsteiger_stems_m"], low + sum(t["per_ha"] * (b + t["dbh_m"]) for t in all_stems),
                 f"{what}: gsteiger-stems")
    thick = sum(t["per_ha"] * t["dbh_m"] for t in shoots) / n_shoots if n_shoots > 0 else 0
    spacing = stand["stools"]["spacing_m"] if shoots else 0
    expect_width(adc["interception_m"], width_of_trees + stools * (b + thick + spacing), f"{what}: interception")
    each, hull = (n_shoots / stools, 0) if shoots else (0, 0)
    for n, share in ((math.floor(each), 1 - each % 1), (math.floor(each) + 1, each % 1)):
        hull += share * (n * spacing if n > 1 else 0)
    expect_width(adc["crofton_m"], width_of_trees + stools * (b + thick + hull / math.pi), f"{what}: crofton")


def check_own_stand(stand, s, b, least, what):
    """Check the figures of a stand as in its file."""
    stems = existing_stems(stand)
    expect_close(s["stems_per_ha"], sum(t["per_ha"] for t in stems), f"{what}: stems_per_ha")
    expect_close(s["trees_per_ha"], sum(t["per_ha"] for t in stand.get("trees", [])), f"{what}: trees_per_ha")
    expect_close(s["stools_per_ha"], stand.get("stools", {}).get("per_ha", 0), f"{what}: stools_per_ha")
    area = sum(t["per_ha"] * math.pi / 4 * (t["dbh_m"] ** 2 + t.get("dbh_sd_m", 0) ** 2) for t in stems)
    expect_close(s["basal_area_m2_ha"], area, f"{what}: basal_area_m2_ha")
    for low in ("stumps", "logs"):
        expect_close(s[f"{low}_per_ha"], stand.get(low, {}).get("per_ha", 0), f"{what}: {low}_per_ha")
    if stems or low_width(stand, b)[0] > 0:
        check_adc(stand, s, b, least, what)


def check_stand(result, s, what):
    """Check that the figures of a stand are consistent."""
    adc, threshold = s["adc"], result["threshold_m"]
    expect(s["length_m"] > 0, f"{what}: length {s['length_m']!r}")
    for key in ("stems_per_ha", "stools_per_ha", "trees_per_ha", "basal_area_m2_ha", "contacts", "dissipated_kJ"):
        expect(s[key] is not None and s[key] >= 0, f"{what}: {key} {s[key]!r}")
    expect(all(v is None or isinstance(v, str) or v > 0 for v in adc.values()), f"{what}: {adc}")
    if not is_met(s):
        expect(all(v is None for v in adc.values()) and s["energy_per_contact_J"] is None and not s["passes_threshold"],
               f"{what}: bare: {s}")
        expect_equal((s["contacts"], s["dissipated_kJ"], s["free_run_probability"]), (0, 0, 1), f"{what}: bare")
        return
    if adc["rule"] is None:  # no stem counts
        expect(all(v is None for v in adc.values()), f"{what}: {adc}")
    else:
        expect_equal(adc["adc_m"], adc[adc["rule"].replace("-", "_") + "_m"], f"{what}: the rule's ADC")
    passes = (math.inf if adc["adc_m"] is None else adc["adc_m"]) < threshold
    free = math.exp(-threshold / adc["crofton_m"]) if adc["crofton_m"] is not None else 1
    if has_low(s) or s["grouped_per_ha"] > 0:  # fewer count than in the ADC, or more together
        expect(passes or not s["passes_threshold"], f"{what}: passes with fewer stems")
        expect(s["free_run_probability"] >= free * (1 - 1e-7), f"{what}: free_run_probability of fewer stems")
    else:
        expect_equal(s["passes_threshold"], passes, f"{what}: passes")
        expect_close(s["free_run_probability"], free, f"{what}: free_run_probability", relative=1e-7)
    if adc["adc_m"] is None:
        return
    expect_close(s["contacts"], s["length_m"] / adc["adc_m"], f"{what}: contacts")
    expect_close(s["dissipated_kJ"], s["contacts"] * s["energy_per_contact_J"] / 1000, f"{what}: dissipated_kJ")
    expect_close(s["dissipated_kJ_per_100m"] * s["length_m"], s["dissipated_kJ"] * 100, f"{what}: dissipated_kJ_per_100m")


def check_stands(case, result, stands, wholes, what):
    scale = max(abs(case.xs[0]), abs(case.xs[-1]))
    expect_equal(len(stands), len(wholes), f"{what}: stands")
    for i, (s, (a, b, _)) in enumerate(zip(stands, wholes)):
        expect_equal((s["from_m"], s["to_m"]), (a, b), f"{what}, stand {i}")
        expect_close(s["length_m"], b - a, f"{what}, stand {i}: length", absolute=4 * EPSILON * scale)
        check_stand(result, s, f"{what}, stand {i}")


def check_summary(case, result, stands, summary, what):
    """Check sums over the belts between release and last control."""
    last = max(c["x_m"] for c in result["options"][0]["controls"])
    slack = 16 * EPSILON * max(abs(case.xs[0]), abs(case.xs[-1]))
    length = contacts = dissipated = 0
    nothing, clear, more = 0, True, False
    for s in stands:
        a, b = max(s["from_m"], case.start), min(s["to_m"], last)
        if b <= a + slack or not is_met(s):
            clear &= not b > a - slack or not is_met(s)
            continue
        more |= has_low(s) or s["grouped_per_ha"] > 0
        clear &= (b - a) * 1e-7 > slack
        share = (b - a) / s["length_m"]
        length += b - a
        contacts += s["contacts"] * share
        dissipated = None if None in (dissipated, s["dissipated_kJ"]) else dissipated + s["dissipated_kJ"] * share
        nothing += (b - a) / s["adc"]["crofton_m"] if s["adc"]["crofton_m"] is not None else 0
    if clear:  # not sensitive to the last bits of survey coordinates
        for key, wanted in (("length_m", length), ("contacts", contacts), ("dissipated_kJ", dissipated)):
            if wanted is None:
                expect_equal(summary[key], None, f"{what}: {key} of the summary")
            else:
                expect_close(summary[key], wanted, f"{what}: {key} of the summary", relative=1e-6)
        if more:
            expect(summary["meet_nothing_probability"] >= math.exp(-nothing) - 1e-6, f"{what}: meet_nothing")
        else:
            expect_close(summary["meet_nothing_probability"], math.exp(-nothing), f"{what}: meet_nothing", absolute=1e-6)
    expect(0 <= summary["meet_nothing_probability"] <= 1, f"{what}: {summary}")
    expect(-slack <= summary["longest_gap_m"] <= last - case.start + slack + case.moved, f"{what}: longest gap {summary}")
    if summary["contacts"] > 0:
        expect_close(summary["adc_m"], summary["length_m"] / summary["contacts"], f"{what}: adc_m of the summary")
        if summary["dissipated_kJ"] is not None:
            expect_close(summary["dissipated_kJ_per_100m"] * summary["length_m"], summary["dissipated_kJ"] * 100, f"{what}: per 100 m")
    else:
        expect_equal(summary["adc_m"], None, f"{what}: adc_m of the summary")


# ---- JSON: options ----

def last_control(controls):
    return max(controls, key=lambda c: c["x_m"])


def check_ends(case, result, option, what):
    ends, stop, n = option["ends"], option["stop_x_m"], result["rocks"]
    shares = [ends[key] for key in ("stopped_by_stems", "came_to_rest", "left_slope")]
    expect(all(0 <= s <= 1 for s in shares) and 0 <= ends["unfinished"] <= n, f"{what}: {ends}")
    if "blocks" not in case.scene or ends["unfinished"] == 0:  # here a rock counts by its weight
        expect_close(sum(shares) + ends["unfinished"] / n, 1, f"{what}: ends {ends}", relative=1e-12)
    expect_equal(stop is None, shares[0] + shares[1] == 0, f"{what}: stop_x_m {stop}, ends {ends}")
    if ends["unfinished"] == n:
        arrive = [(c["wooded"] or c["bare"])["reach_hi"] for c in option["controls"]]
        expect(set(arrive) == {1}, f"{what}: all are unfinished, and may arrive: {arrive}")
    if stop:
        slack = 4 * EPSILON * max(abs(case.xs[0]), abs(case.xs[-1])) + case.moved
        expect_rising([case.xs[0] - slack, stop["p50"], stop["p95"], stop["max"], case.xs[-1] + slack], f"{what}: stop_x_m")


def check_option(case, result, option, i):
    what = f"option {i}"
    wholes = [(a, b, with_per_ha(stand)) for a, b, stand in case.belts[i]]
    stems = any(has_obstacles(stand) for _, _, stand in wholes)
    check_stands(case, result, option["stands"], wholes, what)
    for k, (s, (_, _, stand)) in enumerate(zip(option["stands"], wholes)):
        least = case.scene.get("simulation", {}).get("contact_dbh_m", 0.03)
        check_own_stand(stand, s, result["rock"]["mean_diameter_m"], least, f"{what}, stand {k}")
    check_summary(case, result, option["stands"], option["summary"], what)
    check_controls(case, result, option["controls"], stems, what)
    last = last_control(option["controls"])
    expect_equal(last["lights"]["contact"] == "pass", option["summary"]["passes_threshold"], f"{what}: contact")
    expect_equal(last["index"]["dissipated_kJ"], option["summary"]["dissipated_kJ"], f"{what}: dissipated")
    check_ends(case, result, option, what)
    if not stems or not option["controls"][0]["wooded"]:
        expect_equal(option["ends"]["stopped_by_stems"], 0, f"{what}: stopped by stems that are not there")
    for c, first in zip(option["controls"], result["options"][0]["controls"]):
        expect_same(c["bare"], first["bare"], f"{what}: bare is not that of the first option")


def check_differences(result):
    options = result["options"]
    expect_equal(len(result["differences"]), (len(options) - 1) * len(options[0]["controls"]), "differences")
    rows = iter(result["differences"])
    for option in options[1:]:
        for c, base in zip(option["controls"], options[0]["controls"]):
            d = next(rows)
            expect_equal((d["option"], d["against"], d["x_m"]), (option["name"], options[0]["name"], c["x_m"]), "difference")
            for key in ("reach_probability", "exceed_probability", "energy_per_released_kJ"):
                a, b = ((x["wooded"] or x["bare"])[key] for x in (c, base))
                a, b = (x["mean"] if isinstance(x, dict) else x for x in (a, b))
                if c["wooded"] is None:
                    a = b
                if a is None:
                    expect_equal((d[key]["mean"], d[key]["se"]), (None, None), f"difference of {key}")
                else:
                    expect_close(d[key]["mean"], a - b, f"difference of {key}", absolute=1e-12 * max(abs(a), abs(b)) + 1e-290)
                    expect(d[key]["se"] is None or d[key]["se"] >= 0, d)


def count_unfinished(result):
    """Return the number as in the warning."""
    said = [re.match(r"(\d+) rocks? .* counts? as unfinished", w) for w in result["warnings"]]
    return sum(int(m[1]) for m in said if m)


def check_result(case, result, rocks):
    """Check all rules for the JSON of a scene."""
    for text in strings(result):
        expect_no_words(text, "a string in JSON")
    scene = case.scene
    expect_equal(result["scene"], case.name, "scene")
    expect_equal(result["title"], scene["title"], "title")
    expect_equal(result["rocks"], rocks, "rocks")
    expect_equal(result["seed"], scene["simulation"].get("seed", 1), "seed")
    expect_close(result["rock"]["mean_diameter_m"], mean_diameter(scene["rock"]), "mean_diameter_m")
    check_slope(case, result["slope"])
    names = [o["name"] for o in scene["options"]] if "options" in scene else ["current"]
    expect_equal([o["name"] for o in result["options"]], names, "options")
    for i, option in enumerate(result["options"]):
        check_option(case, result, option, i)
    check_differences(result)
    worst = max(o["ends"]["unfinished"] for o in result["options"])
    expect(worst <= count_unfinished(result), f"{worst} rocks unfinished, warnings {result['warnings']}")
    work = result["work"]
    expect(all(isinstance(work[k], int) and work[k] >= 0 for k in work if k != "seconds") and work["seconds"] >= 0, work)


# ---- JSON: years ----

def check_rotation(case, result, option, what):
    sums, years = option["rotation"], option["years"]
    lasts = [last_control(y["controls"]) for y in years]
    expect_equal(sums["years"], len(years), f"{what}: years of the rotation")
    for light in ("contact", "free_run", "energy"):
        failed = sum(c["lights"][light] == "fail" for c in lasts)
        unknown = not is_judged(lasts[0]) or (light == "energy" and sums["exceed_probability"]["mean"] is None)
        expect_equal(sums[f"unprotected_{light}"], None if unknown else failed, f"{what}: unprotected_{light}")
    expect(sums["worst_year"] in [y["year"] for y in years], f"{what}: worst year {sums['worst_year']}")
    for key in ("reach_probability", "exceed_probability", "energy_per_released_kJ"):
        values = [c["wooded"] and c["wooded"][key] for c in lasts]
        values = [v["mean"] if isinstance(v, dict) else v for v in values]
        if None in values:
            expect_equal(sums[key]["mean"], None, f"{what}: {key} of all years")
        else:
            expect_close(sums[key]["mean"], sum(values) / len(values), f"{what}: {key} of all years")
    per_year, reach = case.scene.get("rocks_per_year"), sums["reach_probability"]["mean"]
    if "blocks" in case.scene:
        expect((sums["reach_per_year"] or 0) >= 0, f"{what}: reach_per_year")
    elif per_year is None or reach is None:
        expect_equal(sums["reach_per_year"], None, f"{what}: reach_per_year")
    else:
        expect_close(sums["reach_per_year"], per_year * reach, f"{what}: reach_per_year")


def check_years(case, result, plain):
    first, last, step = ([int(n) for n in case.years.split(":")] + [1])[:3]
    expect_same({k: v for k, v in result.items() if k not in ("work", "options")},
                {k: v for k, v in plain.items() if k not in ("work", "options")}, "the run beside the years")
    for i, (option, before) in enumerate(zip(result["options"], plain["options"])):
        what = f"option {i}"
        expect_same(option_today(option), option_today(before), f"{what}: the run beside the years")
        expect_equal([y["year"] for y in option["years"]], list(range(first, last + 1, step)), f"{what}: years")
        for y in option["years"]:
            here = f"{what}, year {y['year']}"
            check_stands(case, result, y["stands"], case.belts[i], here)
            check_summary(case, result, y["stands"], y["summary"], here)
            check_controls(case, result, y["controls"], any(is_met(s) for s in y["stands"]), here)
            expect_same([c["bare"] for c in y["controls"]], [c["bare"] for c in option["controls"]], f"{here}: bare")
        check_rotation(case, result, option, what)


# ---- CSV ----

def read_rows(text, what):
    """Return rows with one header and the same number of cells each."""
    rows = list(csv.reader(io.StringIO(text, newline=""), strict=True))
    expect(rows, f"{what}: no header")
    header, *others = rows
    expect_equal(len(set(header)), len(header), f"{what}: columns of the same name")
    for row in others:
        expect_equal(len(row), len(header), f"{what}: cells of {row}")
        expect(row != header, f"{what}: a second header")
    return [dict(zip(header, row)) for row in others]


@functools.cache
def split_path(path):
    return tuple(re.findall(r"[^.\[\]]+", path))


def find_value(value, path):
    """Return the value at a path of JSON; None if part of it is null or missing."""
    for key in split_path(path):
        if isinstance(value, list):
            value = value[int(key)]
        else:
            value = value.get(key) if isinstance(value, dict) else None
    return value


def expect_cell(cell, value, what):
    if value is None:
        expect_equal(cell, "", what)
    elif isinstance(value, bool):
        expect_equal(cell, "true" if value else "false", what)
    elif isinstance(value, int):
        expect_equal(cell, str(value), what)
    elif isinstance(value, float):
        expect(cell != "" and float(cell) == value, f"{what}: {cell!r} in CSV, {value!r} in JSON")
    elif not any(unicodedata.category(c) == "Cc" for c in value):
        expect_equal(cell, "'" + value if is_formula(value) else value, what)


def compare_row(row, parts, skip, what):
    """Compare a CSV row with the JSON objects of its columns; the first object with the column counts."""
    for name, cell in row.items():
        group = split_path(name)[0]
        if group in skip:
            continue
        holder = next((p for p in parts if group in p), None)
        expect(holder or cell == "", f"{what}: nothing in JSON for {name} = {cell!r}")
        expect_cell(cell, find_value(holder, name), f"{what}: {name}")


def check_worst(row, option, c, year, what):
    """Compare the worst year, of which only that of the last control is in JSON."""
    window = option["window"]
    if year or not window or not is_judged(c):
        expect_equal((row["worst.year"], row["worst.exceed"]), ("", ""), f"{what}: worst")
        return
    exceed = c["accepted_kJ"] is not None
    expect_equal(row["worst.exceed"] != "", exceed, f"{what}: worst.exceed")
    if c is last_control(option["controls"]):
        expect_cell(row["worst.year"], window["worst_year"], f"{what}: worst.year")
        expect_cell(row["worst.exceed"], window["worst"] if exceed else None, f"{what}: worst.exceed")
    else:
        expect(window["from"] <= int(row["worst.year"]) <= window["to"], f"{what}: worst.year {row['worst.year']}, window {window}")
        expect(not exceed or 0 <= float(row["worst.exceed"]) <= 1, f"{what}: worst.exceed {row['worst.exceed']}")


def join_warnings(result, stands):
    return "; ".join(result["warnings"] + [w for s in stands for w in s["warnings"]])


def compare_controls(case, result, rows, years):
    """Rows of controls, in order: option, year, control."""
    rows, top = iter(rows), {k: v for k, v in result.items() if k not in ("options", "warnings")}
    controls = len(result["options"][0]["controls"])
    for i, option in enumerate(result["options"]):
        for year in option["years"] if years else [None]:
            at = year or option
            for k, c in enumerate(at["controls"]):
                row = next(rows, None)
                what = f"CSV of option {i}, control {k}" + (f", year {year['year']}" if year else "")
                expect(row is not None, f"{what}: no row")
                own = {"option": option["name"], "summary": at["summary"], "warnings": join_warnings(result, at["stands"])}
                if year:
                    own.update({"year": year["year"], "cut": year["cut"]})
                elif i > 0:
                    own["difference"] = result["differences"][(i - 1) * controls + k]
                compare_row(row, [own, c, {k: option[k] for k in ("ends", "stop_x_m", "yield")}, top],
                            ("worst", "ends", "stop_x_m") if year else ("worst",), what)
                check_worst(row, option, c, year, what)
    expect(next(rows, None) is None, f"CSV of {case.name}: rows too many")


def compare_stands(case, result, rows):
    rows, top = iter(rows), {k: v for k, v in result.items() if k not in ("options", "warnings")}
    for i, option in enumerate(result["options"]):
        for k, s in enumerate(option["stands"]):
            row = next(rows, None)
            expect(row is not None, f"CSV of stands: none for stand {k} of option {i}")
            own = {**s, "option": option["name"], "warnings": "; ".join(s["warnings"])}
            compare_row(row, [own, top], (), f"CSV of option {i}, stand {k}")
    expect(next(rows, None) is None, f"CSV of the stands of {case.name}: rows too many")


# ---- the page ----

VERDICT = re.compile(r"    (Contact|Free run|Energy): (passes|FAILS|unknown)\.")


def columns(line):
    if line.isascii():
        return len(line)
    return sum(0 if unicodedata.combining(c) else 2 if unicodedata.east_asian_width(c) in "WF" else 1 for c in line)


def format_per_1000(a, key):
    p, lo, hi = a[f"{key}_probability"], a[f"{key}_lo"], a[f"{key}_hi"]
    return "-" if p is None else f"{p * 1000:.0f} ({math.floor(lo * 1000)}–{math.ceil(hi * 1000)})"


def expect_shown(cell, value, what):
    """Expect a figure on the page to be the value rounded to its decimals."""
    if value is None:
        expect_equal(cell, "-", what)
        return
    try:
        shown = Fraction(cell)
    except ValueError:
        raise Failure(f"{what}: {cell!r} is not a number, {value!r} was to be shown") from None
    digits, _, power = cell.partition("e")
    unit = Fraction(10) ** (int(power or 0) - len(digits.partition(".")[2]))
    expect(abs(shown - Fraction(value)) <= unit * Fraction(51, 100), f"{what}: {cell!r} on the page, {value!r} in JSON")


def check_rows(rows, a, what):
    """Check the figures of one side of a table of arrivals."""
    named = {re.sub(r"^(arrive with more than|above) .* kJ$", "exceed", name): cell for name, cell in rows.items()}
    expect("…" not in "".join(rows.values()), f"{what}: a figure is cut: {rows!r}")
    expect_equal((named.get("exceed", "-"), named["arrive"]), (format_per_1000(a, "exceed"), format_per_1000(a, "reach")), what)
    for name, value in (("mean energy of those that arrive, kJ", a["energy_kJ"]["mean"]), ("95 % stay below, kJ", a["energy_kJ"]["p95"]),
                        ("mean speed of those that arrive, m/s", a["speed_m_s"]["mean"])):
        expect_shown(re.split("[ ±]", named.get(name, "-"))[0], value, f"{what}: {name}")


def check_lines(lines, width, what):
    long = [line for line in lines if columns(line) > width]
    expect(not long, f"{what}: lines beyond {width} columns:", *long[:3])
    expect_no_words("\n".join(lines), what)


def check_page(case, lines, result):
    check_lines(lines, 80, "the page")
    head = f"Rocks    {result['rocks']}, seed {result['seed']}"
    expect(head in lines, f"the page: {head!r} is missing")
    often = next((i for i, line in enumerate(lines) if line.startswith("How often, ")), len(lines))
    tables = iter(parse_arrivals("\n".join(lines[:often])))
    verdicts = iter([m for m in map(VERDICT.match, lines) if m])
    several = len(result["options"]) > 1  # arrivals without forest come once, before them
    bare = [{"name": "", "controls": result["options"][0]["controls"]}] if several else []
    for i, option in enumerate(bare + result["options"]):
        for c in option["controls"]:
            what = f"the page, option {i}, at {c['x_m']!r} m"
            alone = several and i == 0
            table = next(tables, None) if alone or not several or c["wooded"] else {}
            expect(table is not None, f"{what}: no table of what arrives")
            for side, rows in table.items():
                expect(c[side] and (not several or alone == (side == "bare")), f"{what}: figures of {side}")
                check_rows(rows, c[side], f"{what}, {side}")
            for light, key in () if alone else (("Contact", "contact"), ("Free run", "free_run"), ("Energy", "energy")):
                if not is_judged(c):  # once, at the head of the page
                    continue
                verdict = next(verdicts, None)
                expect(verdict and (verdict[1], LIGHTS[verdict[2]]) == (light, c["lights"][key]), f"{what}: {light}: {verdict}")
    expect(next(tables, None) is None and next(verdicts, None) is None, "the page: rows too many")


def pages(text):
    """Return the lines of each scene's page, by number."""
    found, number = {}, None
    for line in text.splitlines():
        match = re.match(r"random scene (\d+)( |$)", line)
        number = int(match[1]) if match else number
        found.setdefault(number, []).append(line)
    return found


# ---- refused scenes ----

PROBLEM = re.compile(r"(?:\S*/)?s(\d+)[-\w]*\.(?:yaml|csv):(\d+):(\d+): (.+)")


def refusals(err):
    """Return the messages of each scene, by number; every line is a message, a source line, or the end of a list."""
    found, lines = {}, iter(err.splitlines())
    for line in lines:
        match = PROBLEM.match(line)
        if match:
            found.setdefault(int(match[1]), []).append(match[4])
        else:
            expect(line.startswith("  ") or re.match(r"s\d+[-\w]*\.\w+: \d+ more", line), f"no proper message: {line!r}", err[:2000])
    return found


def check_refusal(case, said):
    if not case.broken:
        expect(said is None or not NO_NUMBER.search(" ".join(said)), "a message", said)
        return
    expect(said is not None, f"not refused, though it is wrong: {case.broken}")
    expect(any(case.key in line for line in said), f"{case.broken}, but no message names {case.key}:", *said)


# ---- a fit to observations ----

FIT = ("simulation.gravity_m_s2", 9, 10.5)  # a value of every scene
FIT_ROCKS, FIT_WORK = 20, 30                # a scene is simulated thousands of times: only with cheap rocks


def check_fit(case, fit):
    (p,) = fit["parameters"]
    expect(FIT[1] <= p["best"] <= FIT[2], f"best: {p}")
    expect_rising([FIT[1], p["p2_5"], p["p50"], p["p97_5"], FIT[2]], f"what is not refuted: {p}")
    expect(len(fit["observations"]) >= len(case.scene["observed"]), f"{len(fit['observations'])} observations")
    for o in fit["observations"]:
        expect(o["p_value"] is None or 0 <= o["p_value"] <= 1, f"p: {o}")
        expect(o["deviance"] is None or o["deviance"] >= -1e-9, f"deviance: {o}")
        expect_rising([o["predicted_lo"], o["predicted_hi"]], f"predicted: {o}")
        expect_rising([o["single_lo"], o["single_hi"]], f"single rocks: {o}")
        expect(o["use"] in ("fit", "check") and o["n"] >= 0, o)


# ---- a chunk of scenes ----

SHORT_PAGES = 3  # per chunk: with uncertainty they are hundreds of scenes


def without_sum(err):
    """Return the messages of the scenes, without scene names and the count of failures."""
    return re.sub(r"^ceduo: \d+ of \d+ failed: .*\n|^.*: this scene cannot be computed:\n", "", without_unusual(err), flags=re.M)


class Chunk:
    """Scenes that run together. A failure is located by running each alone."""

    def __init__(self, table, kinds, indices):
        self.table, self.kinds = table, kinds
        self.cases = {i: random_scenes.make(table, i) for i in indices}
        self.failures = {}  # scene: reason
        self.count = Counter()
        self.used, self.words, self.ends = set(), set(), set()

    def fail(self, i, why):
        self.failures[i] = str(why)
        self.cases.pop(i, None)

    def check(self, i, function, *arguments):
        try:
            function(*arguments)
        except Failure as failure:
            self.fail(i, failure)
        except Exception:  # figures that a check cannot use
            self.fail(i, "the check breaks off:\n" + traceback.format_exc())

    def write(self):
        for case in self.cases.values():
            self.folder.write(case.name, case.text())
            for name, text in case.files.items():
                self.folder.write(name, text)

    def call(self, *arguments, of=None):
        """Call the program for all scenes, or for some: [(result, its scenes)]. After a failure split in halves, down to the
        scene that causes it."""
        return self.halves(arguments, [i for i in self.cases if of is None or i in of])

    def halves(self, arguments, indices):
        if not indices:
            return []
        try:
            return [(run(self.folder.path, "-j", 1, *arguments, *(self.cases[i].name for i in indices)), indices)]
        except Failure as failure:
            if len(indices) == 1:
                self.fail(indices[0], failure)
                return []
            half = len(indices) // 2
            return self.halves(arguments, indices[:half]) + self.halves(arguments, indices[half:])

    def results(self, *arguments, of=None):
        """Return the calls, and the JSON of each scene."""
        calls, found = self.call("--batch", "-f", "json", "--details", *arguments, of=of), {}
        for done, _ in calls:
            for line in done.out.splitlines():
                result = json.loads(line, parse_constant=no_constant)
                expect_schema(result)
                found[int(result["scene"][1:-5])] = result
        return calls, found

    def expect_status(self, calls, results, refused):
        for done, indices in calls:
            bad = any(count_unfinished(results[i]) * 1000 > results[i]["rocks"] for i in indices if i in results)
            expect_equal(done.status, INPUT if any(i in refused for i in indices) else RUN if bad else DONE, f"status of {done}")

    # ---- one by one ----

    def first_rocks(self):
        """Simulate one rock per scene: return refused scenes, and the work per rock."""
        calls, results = self.results("-n", 1)
        err = without_sum("".join(done.err for done, _ in calls))
        said = refusals(err)
        self.expect_status(calls, results, said)
        for i, case in list(self.cases.items()):
            self.count["refused"] += i in said
            expect((i in said) != (i in results), f"scene {i} is neither refused nor computed, or both", err)
            self.check(i, check_refusal, case, said.get(i))
            if i in results and i in self.cases:
                self.check(i, check_result, case, results[i], 1)
        check = without_sum("".join(done.out + done.err for done, _ in self.call("--check", of=said)))
        if not self.failures:
            expect_equal(check, err, "what --check says")
        for i in said:
            self.cases.pop(i, None)
        for case in self.cases.values():
            case.wanted = case.rocks
        self.choose_rocks(results, WORK)

    def choose_rocks(self, results, most):
        """Reduce the rocks of scenes above the work limit; return the changed scenes."""
        changed = []
        for i, case in self.cases.items():
            work, rocks = results[i]["work"], results[i]["rocks"]
            whole = work["contacts"] + work["stems_drawn"] + 1
            if whole * case.rocks > most * rocks:
                case.rocks = max(1, min(case.rocks, int(WORK * rocks / whole)))
                case.scene["simulation"]["rocks"] = case.rocks
                self.folder.write(case.name, case.text())
                changed.append(i)
        return changed

    def all_rocks(self):
        """Return JSON for all rocks, repeated with fewer if the first rock was the cheapest."""
        results, of = {}, None
        while of is None or of:
            calls, some = self.results(of=of)
            expect_equal(without_unusual("".join(done.err for done, _ in calls)), "", "standard error")
            self.expect_status(calls, some, {})
            results.update(some)
            for i, case in list(self.cases.items()):
                expect(i in results, f"scene {i} is not in the output")
                if of is None or i in of:
                    self.check(i, check_result, case, results[i], case.rocks)
            of = [i for i in self.choose_rocks(results, 10 * WORK) if results[i]["rocks"] > self.cases[i].rocks]
        self.count["fewer rocks"] += sum(case.rocks < case.wanted for case in self.cases.values())
        self.count["unfinished"] += sum(count_unfinished(r) > 0 for r in results.values())
        return results

    def in_csv(self, results, *arguments, years=False, stands=False, of=None):
        calls = self.call("--batch", "-f", "csv", *arguments, *(["--rows", "stands"] if stands else []), of=of)
        rows = [row for done, _ in calls for row in read_rows(done.out, "CSV")]
        for i, case in list(self.cases.items()):
            if of is None or i in of:
                own = [row for row in rows if row["scene"] == case.name]
                if stands:
                    self.check(i, compare_stands, case, results[i], own)
                else:
                    self.check(i, compare_controls, case, results[i], own, years)

    def on_pages(self, results):
        for done, indices in self.call("--batch", "--details", "-s", "uncertainty=none"):
            found = pages(done.out)
            for i in indices:
                self.check(i, check_page, self.cases[i], found.get(i, []), results[i])
        for i in list(self.cases)[:SHORT_PAGES]:
            for done, _ in self.call("--batch", "-n", min(self.cases[i].rocks, 5), of={i}):
                self.check(i, check_lines, done.out.splitlines(), 80, "the short page")

    def in_pictures(self, i):
        case = self.cases[i]
        kind = self.kinds[int(case.plot * len(self.kinds))]
        size = ["--size", case.size] if case.size else []
        charset = ["--charset", case.charset] if case.charset else []
        for done, _ in self.call("--plot", kind, *size, *charset, of={i}):
            width = int((case.size or "80x24").split("x")[0])
            self.check(i, check_lines, done.out.splitlines(), width, f"--plot {kind} {' '.join(size + charset)}")
            self.count["pictures"] += 1

    def fitted(self, i, result):
        """Fit to observations: its JSON and its page are consistent."""
        case = self.cases[i]
        _, tried = self.results("-s", f"{FIT[0]}={sum(FIT[1:]) / 2}", "-n", FIT_ROCKS, of={i})
        if any(r["work"]["contacts"] + r["work"]["stems_drawn"] > FIT_WORK * r["rocks"] for r in (result, tried[i])):
            return
        order = ["--calibrate", f"{FIT[0]}={FIT[1]}:{FIT[2]}", "-n", FIT_ROCKS]
        for done, _ in self.call(*order, "-f", "json", of={i}):
            expect_equal(done.status, DONE, f"scene {i}: {done}")
            self.check(i, check_fit, case, json.loads(done.out, parse_constant=no_constant))
        for done, _ in self.call(*order, of={i}):
            self.check(i, check_lines, done.out.splitlines(), 80, "the page of the fit")
            self.check(i, expect_no_words, done.out, "the page of the fit")
        self.count["fits"] += 1

    def in_years(self, i, plain):
        case = self.cases[i]
        orders = ["--years", case.years, "-n", min(case.rocks, 5)]
        plain = plain if case.rocks <= 5 else self.results("-n", 5, of={i})[1].get(i)
        found = self.results(*orders, of={i})[1].get(i)
        if not plain or not found:
            return
        self.check(i, check_years, case, found, plain)
        if i in self.cases:
            self.in_csv({i: found}, *orders, years=True, of={i})
        dense = found["work"]["stems_drawn"] > 1000 * found["rocks"]  # hundreds of scenes with such rocks would take minutes
        for done, _ in self.call("--batch", *orders, *(["-s", "uncertainty=none"] if dense else []), of={i}):
            self.check(i, check_lines, done.out.splitlines(), 80, "the page of the years")
        self.count["years"] += 1

    def every_way(self):
        self.first_rocks()
        results = self.all_rocks()
        for case in self.cases.values():
            self.used |= case.used
            self.words |= case.words
            self.ends |= case.ends
        self.in_csv(results)
        self.in_csv(results, stands=True)
        self.on_pages(results)
        for i in list(self.cases):
            if i in self.cases and self.cases[i].plot is not None:
                self.in_pictures(i)
            if i in self.cases and self.cases[i].years:
                self.in_years(i, results[i])
            if i in self.cases and "observed" in self.cases[i].scene:
                self.fitted(i, results[i])

    def work(self):
        """Raise a failure that belongs to no single scene."""
        indices = list(self.cases)
        self.count["scenes"] += len(indices)
        with Folder() as self.folder:
            self.write()
            try:
                self.every_way()
            except Exception:
                if len(indices) > 1:
                    raise
                self.fail(indices[0], traceback.format_exc())
            self.keep()

    def keep(self):
        """Keep the files of failed scenes."""
        for i, why in self.failures.items():
            to = KEPT / f"scene-{i}"
            shutil.rmtree(to, ignore_errors=True)
            to.mkdir(parents=True)
            for path in self.folder.path.glob(f"s{i}[.-]*"):
                shutil.copy(path, to)
            (to / "why.txt").write_text(why, encoding="utf-8")


TABLE = KINDS_OF_PICTURES = None  # per process


def begin(table, kinds):
    global TABLE, KINDS_OF_PICTURES
    TABLE, KINDS_OF_PICTURES = table, kinds


def work_on(indices):
    """Return the results of a chunk as plain values."""
    chunk = Chunk(TABLE, KINDS_OF_PICTURES, indices)
    try:
        chunk.work()
    except Exception:  # each alone
        together = traceback.format_exc()
        chunk = Chunk(TABLE, KINDS_OF_PICTURES, indices)
        for i in indices:
            alone = Chunk(TABLE, KINDS_OF_PICTURES, [i])
            alone.work()
            for name in ("failures", "count", "used", "words", "ends"):
                getattr(chunk, name).update(getattr(alone, name))
        if not chunk.failures:
            chunk.failures[indices[0]] = f"scenes {indices[0]} to {indices[-1]}, though none alone:\n{together}"
    return indices, chunk.failures, chunk.count, chunk.used, chunk.words, chunk.ends


# ---- all scenes ----

def report(failures, indices):
    bad = [i for i in indices if i in failures]
    lines = []
    for i in bad[:5]:
        why = failures[i].splitlines()
        lines += [f"scene {i}: {why[0][:300]}", *(f"    {line[:300]}" for line in why[1:8]),
                  f"    SCENE={i} {sys.argv[0]} runs it again; {KEPT / f'scene-{i}'} holds its files"]
    expect(not bad, *lines, f"{len(bad)} scenes fail: {' '.join(map(str, bad[:200]))}")


def expect_covered(table, used, words):
    """Expect every parameter of the table in some computed scene, except those that affect no figure of a run."""
    rows = {path: p for path, p in table.rows.items() if not path.startswith(random_scenes.BESIDE)}
    missing = sorted(path for path, p in rows.items() if path not in used and p.kind not in ("file", "points"))
    expect(not missing, "in no scene:", *missing)
    said = {(path, word) for path, p in rows.items() for word in p.words}
    expect(words >= said, "in no scene:", *(f"{path}: {word}" for path, word in sorted(said - words)))


def expect_accepted(count):
    share = 1 - count["refused"] / count["scenes"]
    expect(share >= ACCEPTED, f"only {share:.0%} of {count['scenes']} scenes are good")


def one_scene(number, table, kinds):
    case = random_scenes.make(table, number)
    for name, text in [(case.name, case.text()), *case.files.items()]:
        print(f"# ---- {name}", *text.splitlines(), sep="\n# ")
    begin(table, kinds)
    suite = Suite()
    _, failures, count, *_ = work_on([number])
    print(f"# {dict(count)}")
    suite.check(f"random scene {number}", report, failures, [number])
    suite.end()


def main():
    table, kinds = table_of_parameters(), kinds_of_pictures()
    if os.environ.get("SCENE"):
        one_scene(int(os.environ["SCENE"]), table, kinds)
    suite = Suite()
    end = FIRST + SCENES
    chunks = [list(range(i, min(i + CHUNK, end))) for i in range(FIRST, end, CHUNK)]
    failures, count, used, words, ends, waiting = {}, Counter(), set(), set(), set(), []
    with multiprocessing.Pool(PROCESSES, begin, (table, kinds)) as pool:
        for indices, *found in pool.imap(work_on, chunks):
            for whole, part in zip((failures, count, used, words, ends), found):
                whole.update(part)
            waiting += indices
            if len(waiting) >= SCENES / 10 or indices is chunks[-1]:
                suite.check(f"random scenes {waiting[0]} to {waiting[-1]}", report, failures, waiting)
                waiting = []
    suite.check(f"at least {ACCEPTED:.0%} of the scenes are good", expect_accepted, count)
    if SCENES >= 500:
        suite.check("every parameter and every word of the table stands in some scene", expect_covered, table, used, words)
    print(f"# of {count['scenes']} scenes {count['refused']} refused ({count['refused'] / count['scenes']:.0%}), "
          f"{count['fewer rocks']} with fewer rocks, {count['unfinished']} with unfinished rocks; {count['pictures']} pictures, {count['years']} over years, {count['fits']} fits; "
          f"{len(ends)} ends of ranges; {CEDUO}")
    suite.end()


if __name__ == "__main__":
    main()
