#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A face above talus and a road: realistic arrivals for any sampling of the profile; otherwise no answer."""
import json
import math
import random
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import Folder, ceduo, expect, expect_equal, expect_in, expect_near, good, result, run_all, scene
from pages import WHOLE
from runs import read_csv

# A face of 56 degrees, 85 m of talus of 40 degrees, gentler ground, a bench with a road at 215 m.
POINTS = [(0, 1012), (8, 1001), (25, 975), (60, 945), (110, 905), (160, 872), (190, 855), (205, 849), (212, 848.2), (218, 848),
          (224, 845), (250, 838), (270, 833)]
MATERIALS = [{"from_m": 0, "to_m": 25, "material": "cliff"}, {"from_m": 25, "to_m": 270, "material": "talus"}]
CONTROLS = [{"x_m": x} for x in (110, 190, 215, 240)]


def height(x):
    for (x0, z0), (x1, z1) in zip(POINTS, POINTS[1:]):
        if x <= x1:
            return z0 + (x - x0) / (x1 - x0) * (z1 - z0)


def sampled(step, noise, seed):
    """Return a point every `step` m, inner ones with normal noise, like a terrain model under trees."""
    draw, last = random.Random(seed), round(270 / step)
    return [(i * step, height(i * step) + (draw.gauss(0, noise) if 0 < i < last else 0)) for i in range(last + 1)]


def slope(points, **more):
    return {"vertices_m": [[x, round(z, 6)] for x, z in points], "materials": MATERIALS, **more}


def site(points=POINTS, ground=None, **changes):
    made = scene(rock={"diameter_m": 0.8, "density_kg_m3": 2650}, release={"x_m": 0, "vx_m_s": 0.5},
                 slope=ground or slope(points), controls=CONTROLS, options=[{"name": "bare"}],
                 simulation={"rocks": 1000, "seed": 1}, forest=None)
    made.update(changes)
    return {key: value for key, value in made.items() if value is not None}


def shares(run):
    return [c["bare"]["reach_probability"] for c in run["options"][0]["controls"]]


def speeds(run):
    return [c["bare"]["speed_m_s"]["mean"] for c in run["options"][0]["controls"]]


def run_scene(folder, made, *arguments):
    return result(folder.write("s.yaml", made), *arguments)


def test_rocks_move_as_rocks_do():
    """On talus of 40 degrees rocks move at 10 to 25 m/s and reach a road under a reach angle of 37 degrees."""
    with Folder() as f:
        run = run_scene(f, site())
        expect(all(10 < v < 25 for v in speeds(run)[:2]), "speeds on the talus", speeds(run))
        expect(shares(run)[2] > 0.8, "share at the road", shares(run))


def test_sampling():
    """A point every 2.5, 1 or .5 m with noise changes no share by more than .10. Noise of 15 cm every .5 m has relief beyond
    the tolerance of .5 m (3.3 standard deviations among 540 points): its share lies within the uncertainty."""
    with Folder() as f:
        given = shares(run_scene(f, site()))
        for step in (2.5, 1, 0.5):
            for noise in (0.05, 0.1, 0.15):
                found = [shares(run_scene(f, site(sampled(step, noise, seed)))) for seed in range(10)]
                mean = [sum(column) / 10 for column in zip(*found)]
                if (step, noise) == (0.5, 0.15):
                    continue
                for k in range(4):
                    expect_near(mean[k], given[k], 0.1, f"every {step} m, {noise} m of noise, at {CONTROLS[k]['x_m']} m")
        rough = site(sampled(0.5, 0.15, 0), controls=[{"x_m": 215}])
        answer = json.loads(good("--sensitivity", "-f", "json", f.write("s.yaml", rough)).out)
        band = next(x for x in answer["figures"] if x["figure"] == "reach_probability")
        expect(band["uncertainty"]["p5"] <= given[2] <= band["uncertainty"]["p95"], "within what is uncertain", band)
        # the same relief used unsimplified stops rocks
        whole = shares(run_scene(f, site(ground=slope(sampled(1, 0.1, 0), tolerance_m=0))))
        expect(whole[2] < given[2] - 0.2, "without simplifying", whole)


def test_points_are_counted():
    """JSON, CSV, the whole page and the report print the number of points and of used points; segments keep all."""
    with Folder() as f:
        points = sampled(1, 0.1, 1)
        path = f.write("s.yaml", site(points))
        run = result(path)["slope"]
        expect_equal((run["points"], run["tolerance_m"]), (271, 0.5))
        expect(5 < run["used"] < 40, "points used", run)
        row = read_csv(good("--batch", "-f", "csv", path).out)[1][0]
        expect_equal((row["slope.points"], row["slope.used"], row["slope.tolerance_m"]), ("271", str(run["used"]), "0.5"))
        words = f"271 points, {run['used']} after simplifying to 0.5 m"
        expect_in(words, good(*WHOLE, path).out)
        expect_in("Profile: " + words + ".", " ".join(good("--batch", path).out.split()))
        good("--report", f.path / "r.html", path)
        expect_in(words, (f.path / "r.html").read_text())
        expect_in("271 punti", good(*WHOLE, "--language", "it", path).out)
        fixed = slope(points, tolerance_m=0)
        run = run_scene(f, site(ground=fixed))["slope"]
        expect_equal((run["points"], run["tolerance_m"]), (271, 0))
        expect(run["used"] >= 271, "all points", run)
        segments = {"vertices_m": slope(points)["vertices_m"], "segments": [{"rn": 0.31, "rt": 0.83, "roughness_m": 0.2}]}
        expect_equal(run_scene(f, site(ground=segments))["slope"], {"points": 271, "used": 271, "tolerance_m": 0})
        run = run_scene(f, site(ground=segments), "-s", "slope.tolerance_m=0.5")["slope"]
        expect(run["used"] < 40, "one ground for all may be simplified", run)
        each = {**segments, "segments": [{"rn": 0.31, "rt": 0.83, "roughness_m": 0.1 + i / 10000} for i in range(270)],
                "tolerance_m": 0.5}
        done = ceduo("--check", f.write("s.yaml", site(ground=each)))
        expect_equal(done.status, 3)
        expect_in("slope.tolerance_m: a profile with a ground for each segment is not simplified", done.err)
        expect_in("remove 'tolerance_m'", done.err)
        del each["tolerance_m"]
        done = ceduo("--check", f.write("s.yaml", site(ground=each, uncertainty=[{"path": "slope.tolerance_m", "lo": 0.2, "hi": 1}])))
        expect_equal(done.status, 3)
        expect_in("'slope.tolerance_m' affects no result", done.err)


def test_tolerance_is_uncertain():
    """The tolerance of ground from the library is an uncertain input from .25 to 1 m; a file's is not."""
    with Folder() as f:
        path = f.write("s.yaml", site(sampled(2, 0.15, 1)))
        inputs = json.loads(good("--sensitivity=16", "-f", "json", path).out)["figures"][0]["inputs"]
        row = next(x for x in inputs if x["path"] == "slope.tolerance_m")
        expect_equal((row["lo"], row["hi"]), (0.25, 1))
        inputs = json.loads(good("--sensitivity=16", "-f", "json", "-s", "slope.tolerance_m=0.5", path).out)["figures"][0]["inputs"]
        expect("slope.tolerance_m" not in [x["path"] for x in inputs], "given by the user", inputs)


def test_angles():
    """Reach and shadow angle, by hand, in JSON, CSV and the whole page."""
    with Folder() as f:
        path = f.write("s.yaml", site(ground=slope(POINTS, tolerance_m=0)))
        control = result(path)["options"][0]["controls"][2]
        z = 848.2 - 0.2 * 3 / 6  # the road
        reach, shadow = (math.degrees(math.atan(t)) for t in ((1012 - z) / 215, (975 - z) / 190))
        expect_near(control["topography"]["reach_angle_deg"], reach, 1e-9, "reach angle")
        expect_near(control["topography"]["shadow_angle_deg"], shadow, 1e-9, "shadow angle")
        row = read_csv(good("--batch", "-f", "csv", path).out)[1][2]
        expect_near(float(row["topography.reach_angle_deg"]), reach, 1e-9, "in a table")
        expect_in("At 215 m, reach angle 37°, shadow angle 34°", good(*WHOLE, path).out)
        flat = site(ground={"vertices_m": [[0, 100], [100, 40], [270, 0]], "materials": [{**MATERIALS[1], "from_m": 0}]})
        expect_equal(run_scene(f, flat)["options"][0]["controls"][0]["topography"]["shadow_angle_deg"], None)


SMOOTH = [{"rn": 0.315, "rt": 0.835, "roughness_rad": 0.02, "friction": 1.2}]  # friction far above the slope


def test_contradicted():
    """If few rocks arrive at a steep place there is no answer, but the angle, the usual range and checks."""
    with Folder() as f:
        points = [(0, 200), (20, 165), (150, 60)]
        road = [{"x_m": 140, "name": "road", "accepted_kJ": 50}]
        made = site(ground={"vertices_m": points, "segments": SMOOTH}, controls=road)
        run = run_scene(f, made)
        control = run["options"][0]["controls"][0]
        expect(control["bare"]["reach_probability"] < 0.01, "what arrives", control["bare"])
        expect_equal(control["verdict"]["answer"], "nothing")
        for part in ("under a shadow angle of 38.9°", "under more than 32°", "Check roughness and friction of the ground"):
            expect_in(part, control["verdict"]["because"])
        expect_equal(set(control["lights"].values()), {"unknown"}, "lights")
        page = good("--batch", f.path / "s.yaml").out
        expect_in("cannot be assessed", page)
        expect("YES" not in page, "an answer", page)
        # a bench of 35 m may hold them: an answer, and a warning
        bench = {"vertices_m": [(0, 200), (20, 165), (100, 100), (135, 99), (185, 56)],
                 "segments": [{"rn": 0.3, "rt": 0.83, "roughness_m": 0.2, "friction": 0.45}]}
        run = run_scene(f, site(ground=bench, controls=road))
        control = run["options"][0]["controls"][0]
        expect(0 < control["bare"]["reach_probability"] < 0.01, "few arrive", control)
        expect_equal(control["verdict"]["answer"], "yes")
        expect_in("under a reach angle of 37°. A bench of 35 m may hold them", " ".join(run["warnings"]))
        # a bench that holds all of them is named, too
        run = run_scene(f, site(ground=bench, controls=road), "-s", "slope.segments[0].friction=0.6")
        expect_equal(run["options"][0]["controls"][0]["bare"]["rocks_reached"], 0)
        expect_in("A bench of 35 m may hold them", " ".join(run["warnings"]))


def test_far():
    """More than 100 in 1000 beyond a shadow angle of 24 degrees: a warning."""
    with Folder() as f:
        points = [(0, 200), (20, 150), (60, 120), (260, 90)]
        made = site(ground={"vertices_m": points, "segments": [{"rn": 0.3, "rt": 0.8, "roughness_m": 0.01, "friction": 0.1}]},
                    controls=[{"x_m": 200, "name": "house"}])
        run = run_scene(f, made)
        expect(run["options"][0]["controls"][0]["topography"]["shadow_angle_deg"] < 24, "angle", run)
        expect_in("house (200 m): 1000 of 1000 rocks arrive without forest, though it lies under a shadow angle of only",
                  " ".join(run["warnings"]))


def test_speeds_that_do_not_exist():
    """lumped has unlimited speed on long slopes: a warning names the law with a limit; heights likewise."""
    with Folder() as f:
        long = {"vertices_m": [[0, 2344], [3000, 0]], "segments": [{"rn": 0.315, "rt": 0.835, "roughness_rad": 0.15, "friction": 0.5}]}
        made = site(ground=long, controls=[{"x_m": 2900, "name": "house"}])
        run = run_scene(f, made, "-n", 200, "-s", "simulation.law=lumped")
        words = " ".join(run["warnings"])
        expect(speeds(run)[0] > 35, "speed", speeds(run))
        expect_in("The law lumped has no limit of speed on long slopes: use crsp", words)
        expect_in("1 rock in 20 passes more than", words)
        crsp = run_scene(f, made, "-n", 200)
        expect("no limit of speed" not in " ".join(crsp["warnings"]), "crsp", crsp["warnings"])


def test_defaults():
    """A scene defaults to crsp and the friction bound; --list-parameters lists it, and false gives the published laws."""
    with Folder() as f:
        path = f.write("s.yaml", site())
        run, published = result(path), result(path, "-s", "simulation.friction_bound=false")
        expect_equal(run["law"], "crsp")
        expect(shares(published)[3] < shares(run)[3] - 0.1, "by the published laws fewer come far", shares(published))
        expect_in("published law, without the friction bound", good(*WHOLE, "-s", "simulation.friction_bound=false", path).out)
        table = good("--list-parameters").out
        expect(re.search(r"simulation\.law .* crsp ", table), "default law", table)
        expect(re.search(r"simulation\.friction_bound .* true ", table), "default bound", table)


if __name__ == "__main__":
    run_all(__name__)
