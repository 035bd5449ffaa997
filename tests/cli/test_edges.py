#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Edge cases of the model: rocks without end, no arrivals, no forest, walls, far coordinates."""
import math
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import (DONE, INPUT, RUN, USAGE, Folder, belt, ceduo, expect, expect_equal, expect_in, expect_near, good, result,
                     run_all, scene, stand, wooded_scene)
from pages import WHOLE, expect_order
from runs import ENDLESS, RESULT, expect_rows, expect_shape, read_csv, wilson


def test_unfinished():
    """Rocks that never lose energy count as unfinished, with a warning and status 1"""
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
        expect_in("Uncertainty was not computed", " ".join(done.out.split()), "what would take minutes")
        done = ceduo(*WHOLE, "-n", 3, path)
        words = " ".join(done.out.split())
        expect(re.search(r" still moving at the end +1000 ", words), words)
        expect_in("Energy: unknown.", words)
        expect_in("3 rocks were still moving when the simulation stopped; they may arrive", words)
        expect("no rock arrives (" not in words and "fly more" not in words and "few rocks" not in words, words)


def expect_unreached(control):
    bare = control["bare"]
    expect_equal((bare["rocks_reached"], bare["reach_probability"], bare["reach_lo"]), (0, 0, 0))
    for name in ("speed_m_s", "energy_kJ", "translation_kJ", "height_m"):
        expect(all(v is None for v in bare[name].values()), name, bare[name])
    expect_equal(bare["energy_per_released_kJ"]["mean"], 0)
    expect_equal((control["index"]["residual_kJ"], control["index"]["exhausted"]), (None, None))


def test_nobody_reaches():
    """A control without arrivals: nulls in JSON, empty in CSV, 'below' with its bound in the table"""
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
        text = good(*WHOLE, path).out
        expect_order(text, "The forest above 39 m cannot be assessed: none of 999 rocks arrives", "39 m", "0 \\(0", "cannot be assessed")
        expect("nan" not in text.lower() and "null" not in text, text)
        _, rows = read_csv(good("--batch", "-f", "csv", path).out)
        expect_rows(rows, [run], "controls")


def test_at_rest():
    """A rock released at rest stays on level ground and starts on a steep slope"""
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
    """No forest: one option 'current', no stands, null values, the contact test fails"""
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
            expect_order(good(*WHOLE, path).out, "FAILS", "No stem stands on the path")


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
            text = good(*WHOLE, path).out
            expect("nan" not in text.lower() and " inf" not in text.lower(), text)


def test_wall():
    """A slope that ends in a wall stops the rocks there; none is unfinished"""
    with Folder() as f:
        walled = scene(slope={"vertices_m": [[0, 64], [100, 0], [100.01, 63]],
                              "segments": [{"rn": 0.35, "rt": 0.875, "roughness_rad": 0.125}]},
                       controls=[{"x_m": 99}, {"x_m": 100.005}])
        run = result(f.write("wall.yaml", walled))
        expect_shape(run, RESULT)
        ends = run["options"][0]["ends"]
        expect_equal((ends["came_to_rest"], ends["unfinished"]), (1, 0))
        expect(run["options"][0]["stop_x_m"]["max"] <= 100.01, run["options"][0]["stop_x_m"])
        expect(run["options"][0]["controls"][0]["bare"]["rocks_reached"] > 0, "the wall stands behind the control")


def test_belt_beyond():
    """A belt beyond the slope is refused with its place, from the file and from the command line"""
    with Folder() as f:
        for change, path, words in (({"to_m": 200}, "forest[0].to_m", "outside the slope"),
                                    ({"from_m": 170, "to_m": 200}, "forest[0]", "outside the slope")):
            mapping = wooded_scene(forest=[{**belt(10, 95), **change}])
            done = ceduo("--batch", f.write("s.yaml", mapping))
            expect(done.status == INPUT and done.out == "", done)
            expect(re.search(rf"s\.yaml:\d+:\d+: {re.escape(path)}", done.err) and words in done.err and "^" in done.err, done)
        done = ceduo("--batch", "-s", "forest[0].to_m=200", f.write("s.yaml", wooded_scene()))
        expect(done.status == USAGE and "forest[0].to_m" in done.err and "outside the slope" in done.err, done)


def test_fewer_shoots():
    """Fewer shoots than stools, stools without shoots, no spacing: refused with their place"""
    with Folder() as f:
        path = f.write("s.yaml", wooded_scene())
        for change, words in (("forest[0].stand.shoots[0].per_ha=1000", "shoots"), ("forest[0].stand.shoots=[]", "shoots"),
                              ("forest[0].stand.stools.spacing_m=-1", "spacing_m"), ("forest[0].stand.trees[0].dbh_sd_m=-0.1", "dbh_sd_m"),
                              ("forest[0].stand.shoots[0].height_m=0", "height_m")):
            done = ceduo("--batch", "-s", change, path)
            expect(done.status in (USAGE, INPUT) and done.out == "" and words in done.err and "^" in done.err, done)


def test_right_angle():
    """A vertical facet is refused, a slightly lower one is not"""
    with Folder() as f:
        path = f.write("s.yaml", scene(release=None))
        key = "slope.segments[0].roughness_rad"
        for angle, status in ((math.pi / 2, USAGE), (math.nextafter(math.pi / 2, 0), DONE)):
            done = ceduo("--check", "-s", f"{key}={angle!r}", path)
            expect_equal(done.status, status, done)
            expect(status == DONE or f"{key}: {angle!r} is not below 1.57" in done.err, done)


def shifted(by, up):
    """Return the scene at another origin; all coordinates are multiples of 2^-6, so that no bit is lost."""
    points = [[0, 64], [10.5, 50.25], [30.125, 40], [52.75, 22.5], [80, 8.125], [110.25, 0], [300, 0]]
    belts = [{"from_m": 0, "to_m": 40.25, "stand": stand()}, {"from_m": 45.5, "to_m": 90, "stand": stand(name="second")}]
    return scene(release={"x_m": 2.5 + by, "vx_m_s": {"mean": 2, "spread": 0.5}},
                 slope={"vertices_m": [[x + by, z + up] for x, z in points],
                        "segments": [{"rn": 0.35, "rt": 0.875, "roughness_rad": 0.25, "friction": 0.5}]},
                 controls=[{"x_m": 60.5 + by, "accepted_kJ": 20, "measured_speed_m_s": 9}, {"x_m": 100 + by}],
                 forest=[{**b, "from_m": b["from_m"] + by, "to_m": b["to_m"] + by} for b in belts])


def test_survey_coordinates():
    """Survey coordinates give the same numbers to the bit, and are printed as given"""
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


if __name__ == "__main__":
    run_all(__name__)
