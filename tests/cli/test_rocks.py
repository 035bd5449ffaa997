#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of rocks: -n, --seed, -j and -e."""
import math
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import USAGE, Folder, belt, ceduo, expect, expect_equal, expect_in, good, result, run_all, scene, wooded_scene
from pages import WHOLE
from runs import FOUR, MODELS, PAPER, THICK, THIN, expect_run, read_csv, through, treated, warned, without_seconds


def test_rocks_and_seed():
    """-n and --seed: reported; equal seeds give equal bytes, others differ; the first rocks stay the same"""
    runs = [without_seconds(good("--batch", "-f", "json", "-n", 500, "--seed", s, PAPER).out) for s in (1, 1, 2)]
    expect(runs[0] == runs[1] != runs[2], "seeds")
    for model, runs in (("index", 1), ("stems", 3)):
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
    """-j 1, 2, 16 and 1024 give equal bytes except work.seconds"""
    for extra in (through("index"), (), ("-s", "simulation.law=crsp", "-s", "rock.diameter_m.spread=0.05")):
        runs = {j: without_seconds(good("--batch", "-f", "json", "-n", 3000, "-j", j, *extra, PAPER).out)
                for j in (1, 2, 16, 1024)}
        expect(len(set(runs.values())) == 1, *[f"-j {j}: {hash(r)}" for j, r in runs.items()])
    for form in ("table", "csv"):
        expect_equal(*(good("--batch", "-s", "uncertainty=none", "-f", form, "-n", 3000, "-j", j, PAPER).out for j in (1, 16)), form)
    runs = {j: without_seconds(good("--batch", "-f", "json", "-n", 1100, "-j", j, FOUR).out) for j in (1, 5)}
    expect_equal(len(set(runs.values())), 1, "four systems by threads")


def half_width(bare):
    if bare["energy_kJ"]["se"] is None:
        return math.inf
    return 1.959963984540054 * bare["energy_kJ"]["se"] / bare["energy_kJ"]["mean"]


def test_tolerance_met():
    """-e continues until every mean energy has this precision, for any number of threads"""
    two = ["-s", "controls=[{x_m: 60}, {x_m: 135}]"]
    for model in MODELS:
        run = result("-e", 0.01, *two, *through(model), PAPER)
        expect_run(run, model)
        expect_tolerance(run, 0.01)
        expect_equal(warned(run), [])
        expect(1000 < run["rocks"] < 100000, run["rocks"])
        expect_equal(run["options"], result("-e", 0.01, "-n", 1000000, "-j", 16, *two, *through(model), PAPER)["options"])
        needed = max((half_width(a) / 0.01) ** 2 * run["rocks"] for c in run["options"][0]["controls"]
                     for a in (c["bare"], c["wooded"]) if a and a["rocks_reached"] >= 100)
        expect(needed <= run["rocks"] <= 1.2 * needed, f"{model}: {run['rocks']} rocks, the spread seen asks for {needed}")


def expect_tolerance(run, tolerance):
    """Expect every printed mean energy to have this precision, unless a warning names the control, or that it was not met."""
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
    """-e continues until every option's mean energy with forest has this precision"""
    with Folder() as f:
        path = f.write("s.yaml", treated(thin=THIN, thick=THICK, none=None))
        run = result(path, "-e", 0.02)
        expect_run(run)
        expect_tolerance(run, 0.02)
        expect_equal(warned(run), [])
        widths = [half_width(c[which]) for o in run["options"] for c in o["controls"] for which in ("bare", "wooded")]
        bare = result(path, "-e", 0.02, *through("index"))
        expect(bare["rocks"] < run["rocks"], "what is least known decides", bare["rocks"], run["rocks"], widths)
        half = result(path, "-n", run["rocks"] // 2)
        expect(any(half_width(c["wooded"]) > 0.02 for o in half["options"] for c in o["controls"]), "it went on too long")


def test_tolerance_few_wooded():
    """-e skips a control that under 100 rocks reach with forest, and names it; also without arrivals"""
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
        expect_in("left out", re.sub(r"\s+", " ", good(*WHOLE, "-e", 0.02, path).out), "table")


def test_tolerance_not_met():
    """-e with -n too small: a warning that names the tolerance, status 0"""
    run = result("-e", 0.001, "-n", 2000, PAPER)
    expect_equal(run["rocks"], 2000)
    expect(len(warned(run)) == 1 and "0.001" in warned(run)[0] and "not met" in warned(run)[0], run["warnings"])
    expect_in("not met", good(*WHOLE, "-e", 0.001, "-n", 2000, PAPER).out, "table")
    _, rows = read_csv(good("--batch", "-f", "csv", "-e", 0.001, "-n", 2000, PAPER).out)
    expect_in("not met", rows[0]["warnings"], "CSV")


def test_tolerance_few():
    """-e skips a control that under 100 rocks reach, and names it"""
    with Folder() as f:
        # these rocks stop: few reach the end
        few = scene(slope={"vertices_m": [[0, 20], [30, 0], [200, 0]],
                           "segments": [{"rn": 0.3, "rt": 0.8, "roughness_rad": 0.3, "friction": 0.5}]},
                    controls=[{"x_m": 25}, {"x_m": 199}])
        run = result("-e", 0.05, "-n", 20000, f.write("few.yaml", few))
        near, far = run["options"][0]["controls"]
        expect(far["bare"]["rocks_reached"] < 100, far["bare"])
        expect(half_width(near["bare"]) < 0.05, near["bare"])
        expect(any("199 m" in w for w in run["warnings"]), run["warnings"])
        expect(not any("not met" in w or "25 m" in w for w in run["warnings"]), run["warnings"])


def find_warnings(run, what):
    return [w for w in run["warnings"] if what in w]


def test_stopped_at_the_release():
    """Rocks that stems stop within 10 m of the release are reported with their share: all stopped ones, or none in a later
    forest"""
    with Folder() as f:
        near = f.write("near.yaml", wooded_scene(release={"x_m": 20}, forest=[belt(10, 30)]))
        far = f.write("far.yaml", wooded_scene(release={"x_m": 20}, forest=[belt(31, 95)]))
        run = result(near)
        stopped = run["options"][0]["ends"]["stopped_by_stems"]
        expect(stopped > 0.01, run["options"][0]["ends"])
        sentence = find_warnings(run, "within 10 m of the release")
        expect_equal(sentence, [f"current: stems stop {1000 * stopped:.0f} of 1000 rocks within 10 m of the release, where they are slow."], "all that are stopped")
        away = result(far)
        expect(away["options"][0]["ends"]["stopped_by_stems"] > 0, away["options"][0]["ends"])
        expect_equal(find_warnings(away, "within 10 m of the release"), [], "the forest begins 11 m below")


def test_uphill():
    """Rocks that leave a profile at its upper end are counted and reported; with more profile uphill there are none"""
    thrown = {"x_m": 0, "height_m": 2, "vx_m_s": {"mean": 0, "spread": 1, "kind": "uniform"}}
    with Folder() as f:
        # A wall at the foot: a rock can leave only uphill.
        short = f.write("short.yaml", scene(release=thrown, slope={"vertices_m": [[0, 40], [90, 0], [92, 40]], "segments": [
            {"rn": 0.35, "rt": 0.875, "friction": 0.5}]}))
        long_ = f.write("long.yaml", scene(release=thrown, slope={"vertices_m": [[-50, 62], [0, 40], [90, 0], [92, 40]],
                                                                  "segments": [{"rn": 0.35, "rt": 0.875, "friction": 0.5}]}))
        run = result(short)
        left = round(200 * run["options"][0]["ends"]["left_slope"])
        expect(60 < left < 140, f"{left} of 200 leave")  # rocks thrown uphill
        expect(find_warnings(run, f"Of 200 rocks {left} bounce over the upper end of the profile"), run["warnings"])
        expect_equal(find_warnings(result(long_), "upper end"), [], "a profile that begins farther up")


if __name__ == "__main__":
    run_all(__name__)
