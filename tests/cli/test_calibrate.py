#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""--calibrate: fitted values, sentences about the fit, and errors. Stops come from ceduo itself at known values."""
import json
import os
import re
import signal
import subprocess
from pathlib import Path

from harness import (CEDUO, DONE, INPUT, OUTPUT, ROOT, SLOWER, USAGE, Folder, ceduo, children_seconds, environment, expect, expect_equal, expect_in,
                     expect_near, good, processor_seconds, run_all, scene, stand)

GROUND = {"rn": 0.35, "rt": 0.88, "roughness_rad": 0.25, "friction": 0.5}
# stops of 30 rocks on that ground, seed 777, under the published law lumped: the fit uses the same law and can reproduce them
STOPS = [113.5, 114.6, 115.0, 116.7, 116.7, 118.0, 118.3, 119.3, 119.8, 120.3, 120.4, 120.5, 121.9, 122.8,
         124.0, 124.8, 125.0, 125.4, 125.6, 125.9, 126.5, 126.9, 127.8, 127.9, 128.2, 129.1, 129.5, 130.8, 131.0,
         132.6]
# 50 stops in another quarry, under the same law: Rn .36, Rt .87, roughness .24 rad, friction .55
FIFTY = [120.3, 120.1, 125.1, 120.2, 125.0, 127.0, 125.2, 116.0, 123.2, 127.5, 110.4, 124.0, 122.3, 121.8, 128.0, 128.1, 113.6,
         124.3, 125.5, 129.9, 123.4, 129.6, 123.9, 130.1, 118.7, 126.2, 124.2, 119.8, 124.1, 118.8, 123.7, 117.2, 105.1, 122.5,
         112.0, 113.3, 108.8, 123.0, 127.7, 127.0, 123.8, 124.3, 128.1, 124.8, 119.3, 113.1, 116.2, 120.5, 113.4, 112.2]
PUBLISHED = {"rocks": 200, "law": "lumped", "friction_bound": False}
RN, RT, MU = "slope.segments[*].rn", "slope.segments[*].rt", "slope.segments[*].mu"


def quarry(observed=None, **changes):
    return scene(**{"title": "A quarry", "rock": {"diameter_m": 0.8}, "release": {"height_m": 2, "vx_m_s": 0.5},
                    "slope": {"vertices_m": [[0, 60], [15, 42], [40, 20], [60, 8], [90, 2], [200, 0]], "segments": [GROUND]},
                    "controls": [{"x_m": 60}], "forest": None, "simulation": PUBLISHED,
                    "observed": {"stops": {"x_m": STOPS, "of": 30}} if observed is None else observed, **changes})


def fit(what, *arguments, rocks=300):
    with Folder() as f:
        path = f.write("s.yaml", what)
        r = ceduo("-f", "json", "-n", rocks, "-j", 2, "--calibrate", f"{RT}=0.7:0.98", *arguments, path)
        expect_equal(r.status, DONE, r)
        return r.json()[0]


def test_json():
    """JSON has the values, the ranges, and the comparison of the fit with all observations"""
    result = fit(quarry({"stops": {"x_m": STOPS, "of": 30}, "passed": {"x_m": 60, "count": 30, "of": 30, "use": "check"}}))
    expect_equal(result["format"], "ceduo-calibration-1")
    value = result["parameters"][0]
    expect_equal((value["path"], value["lo"], value["hi"], value["determined"], value["at_bound"]), (RT, 0.7, 0.98, True, False))
    expect(value["p2_5"] < value["p50"] < value["p97_5"])
    expect(value["p2_5"] < GROUND["rt"] < value["p97_5"], "the range holds what the stops were made with")
    expect_equal(result["correlation"], [[1]])
    stops, passed = result["observations"]
    expect_equal((stops["what"], stops["use"], stops["n"]), ("stops", "fit", 30))
    expect_near(stops["seen"], sum(STOPS) / 30, 1e-9)
    expect(stops["predicted_lo"] < stops["seen"] < stops["predicted_hi"] and stops["inside"])
    expect_equal((passed["what"], passed["use"], passed["n"], passed["seen"], passed["inside"]), ("passed at 60 m", "check", 30, 30, True))
    held = sum(stops["single_lo"] <= x <= stops["single_hi"] for x in STOPS)
    expect_equal(stops["single_inside"], held)
    expect(held >= 24, "of 30 values with a chance of 95 % fewer are so in one of 1700 cases")  # binomial law
    expect(stops["single_hi"] - stops["single_lo"] > 2 * (stops["predicted_hi"] - stops["predicted_lo"]), "rocks differ more than means")
    expect(passed["single_inside"] is None and passed["single_lo"] is None)
    expect_equal((result["misfit"], result["refuted"], result["settled"]), (False, False, True))
    expect(result["rhat"] < 1.05 and result["effective_size"] >= 200 and result["evaluations"] > 500)


def test_threads():
    """The same bits for any number of threads"""
    with Folder() as f:
        path = f.write("s.yaml", quarry())
        one, four = (ceduo("-f", "json", "-n", 100, "-j", j, "--calibrate", f"{RT}=0.7:0.98", "--calibrate", f"{RN}=0.2:0.6", path).out
                     for j in (1, 4))
        expect_equal(one, four)


def test_not_determined():
    """Values that the stops do not determine are reported"""
    result = fit(quarry({"passed": {"x_m": 60, "count": 4, "of": 4}}), rocks=100)
    expect_equal(result["parameters"][0]["determined"], False)
    with Folder() as f:
        page = ceduo("-n", 100, "--calibrate", f"{RT}=0.7:0.98", f.write("s.yaml", quarry({"passed": {"x_m": 60, "count": 4, "of": 4}}))).out
        expect_in("is not identifiable: almost any value within the bounds fits", page)


def test_not_told_apart():
    """Chains without enough draws at their end stop early; correlated values are named, and which to fix. 50 stops fit four"""
    values = (f"{RN}=0.2:0.6", "slope.segments[*].roughness_rad=0.05:0.6", "slope.segments[*].friction=0.3:0.9")
    four = [word for value in (f"{RT}=0.7:0.98", *values) for word in ("--calibrate", value)]
    few = ("-n", 20, "-j", 2, "-s", "simulation.seed=2")
    with Folder() as f:
        path = f.write("s.yaml", quarry())
        result = ceduo("-f", "json", *few, *four, path).json()[0]
        page = " ".join(ceduo(*few, *four, path).out.split())
    expect(not result["settled"] and result["effective_size"] < 100, result)
    expect(result["evaluations"] < 4 * 8000 / 2, "before half of the steps of four chains", result["evaluations"])
    told = re.search(r"The observations do not determine (.*?); the ranges are rough\. Fix (.*?), or observe more\.", page)
    names = ["slide Rt", "bounce Rn", "roughness, rad", "friction"]
    expect(told and told[1] == ", ".join(names) and set(told[2].split(", ")) < set(names) | {"rad"}, page)
    with Folder() as f:
        more = quarry({"stops": {"x_m": FIFTY, "of": 50}}, rock={"shape": "block", "axes_m": [0.9, 0.7, 0.6], "density_kg_m3": 2600},
                      slope={"vertices_m": [[0, 62], [12, 44], [25, 33], [40, 22], [60, 9], [85, 3], [200, 1]],
                             "segments": [{"rn": 0.35, "rt": 0.85, "roughness_rad": 0.25, "friction": 0.5}]})
        stops = ceduo("-f", "json", *few, "-n", 1000, *four, f.write("m.yaml", more)).json()[0]
    expect(stops["settled"] and stops["effective_size"] >= 200, stops["effective_size"])


def test_at_bound():
    """A best value at the end of its range is reported"""
    with Folder() as f:
        path = f.write("s.yaml", quarry())
        page = ceduo("-n", 300, "--calibrate", f"{RT}=0.9:0.98", path).out
        expect_in("is at a bound: the best value may lie beyond it", " ".join(page.split()))


def test_misfit():
    """Observations that the model cannot reproduce are reported, fitted or held back"""
    far = {"stops": {"x_m": [5 * x for x in range(1, 31)], "of": 30}}
    result = fit(quarry(far))
    expect_equal(result["misfit"], True)
    expect(result["observations"][0]["p_value"] < 0.05)
    result = fit(quarry({"stops": [{"x_m": STOPS, "of": 30}, {"x_m": [5, 10, 20, 30, 40, 50], "of": 6, "use": "check", "name": "odd"}]}))
    expect_equal((result["misfit"], result["refuted"]), (False, True))
    with Folder() as f:
        path = f.write("s.yaml", quarry(far))
        expect_in("The model cannot reproduce stops.", ceduo("-n", 300, "--calibrate", f"{RT}=0.7:0.98", path).out)
        middle = sum(STOPS) / 30
        path = f.write("s.yaml", quarry({"stops": {"x_m": [middle + (7 if i % 2 else -7) + 0.01 * i for i in range(30)], "of": 30}}))
        expect_in("The model reproduces the observed mean, but not the spread of the values: stops.",
                  " ".join(ceduo("-n", 300, "--calibrate", f"{RT}=0.7:0.98", path).out.split()), "a mean that fits, in two heaps")


def test_names():
    """Observations of two scenes with one name are distinguished"""
    with Folder() as f:
        paths = [f.write(name, quarry()) for name in ("s.yaml", "t.yaml")]
        page = ceduo("-n", 100, "--calibrate", f"{RT}=0.7:0.98", *paths).out
    expect(re.search(r"^ *1 A quarry\n+ *2 A quarry$", page, re.M), page)
    expect(re.search(r"stops, scene 1 .*\n.*stops, scene 2 ", page), page)


def test_held_back():
    """For observations held back the page reports how many values lie in the range of single rocks"""
    both = {"stops": [{"x_m": STOPS[::2], "of": 15}, {"x_m": STOPS[1::2], "of": 15, "use": "check", "name": "other half"}],
            "speed": {"x_m": 199, "values": [5, 6, 7], "use": "check"}}
    with Folder() as f:
        page = ceduo("-n", 300, "--calibrate", f"{RT}=0.7:0.98", f.write("s.yaml", quarry(both))).out
        found = re.search(r"other half: (\d+) of 15 values lie within the 95 % range predicted for single rocks, ([\d.]+)\S([\d.]+)\.", " ".join(page.split()))
        expect(found and 11 <= int(found[1]) <= 15 and float(found[2]) < 115 and float(found[3]) > 130, page)
        expect("stops: of" not in page, "of what was fitted it says nothing of the kind")
        expect("199 m: of" not in page, "no rock gets there")


FLIGHT = {"title": "flight", "rock": {"shape": "sphere", "diameter_m": 0.5}, "release": {"height_m": 1, "vx_m_s": 10, "vz_m_s": 0},
          "slope": {"vertices_m": [[0, 100], [1, 0], [60, 0]], "segments": [GROUND]}, "controls": [{"x_m": 20}],
          "forest": [{"from_m": 30, "to_m": 50, "stand": stand(stools=None, shoots=None, trees=[
              {"per_ha": 100, "dbh_m": 0.2, "height_m": 12, "volume_m3": 0.2}])}]}


def test_page_of_a_flight():
    """Horizontal and upward speed change the observed speed equally; diameters are in cm; a p of some per cent has three digits"""
    seen = [{"name": "first day", "speed": {"x_m": 20, "n": 5, "mean": 22, "sd": 0.5}},
            {"name": "other day", "speed": {"x_m": 20, "n": 5, "mean": 21.3, "sd": 0.5}, "use": "check"}]
    fits = [f"--calibrate={row}" for row in ("release.vx_m_s=8:12", "release.vz_m_s=-2:2", "forest[0].stand.trees[0].dbh_m=0.1:0.3")]
    with Folder() as f:
        path = f.write("s.yaml", scene(**FLIGHT, observed=seen))
        page, found = good("-n", 100, *fits, path).out, good("-f", "json", "-n", 100, *fits, path).json()[0]
    together = found["correlation"][0][1]
    expect(together < -0.9, "hypot(v, vz - 20 g / v) falls with either of them", found)
    expect_in(f"speed along, m/s and speed upward, m/s are correlated ({together:.2f}): the observations do not tell them apart", " ".join(page.split()))
    rows = dict(re.findall(r"^ +(speed along|diameter).*? {2,}(\S+ +\S+ +\S+)$", page, re.M))
    for name, per, value in (("speed along", 1, found["parameters"][0]), ("diameter", 100, found["parameters"][2])):
        shown = [float(number) for number in re.findall(r"[\d.]+", rows[name])]
        for number, key in zip(shown, ("lo", "hi", "best", "p2_5", "p97_5")):
            expect_near(number, per * value[key], 0.006 * per * value[key], f"{name}, {key}")
        expect_equal(len(shown), 5, rows)
    p = [row["p_value"] for row in found["observations"]]
    expect(p[0] > 0.1 and 0.01 < p[1] < 0.1, "two errors apart", p)
    expect(re.search(rf"first day .* {p[0]:.2f}$", page, re.M) and re.search(rf"other day .* {p[1]:.3f}$", page, re.M), page)


def test_several():
    """Scenes share a ground by its name; each has its own observations"""
    slope = {"vertices_m": [[0, 60], [40, 20], [60, 8], [200, 0]], "materials": [{"from_m": 0, "to_m": 200, "material": "talus"}]}
    with Folder() as f:
        paths = [f.write(f"{n}.yaml", quarry({"stops": {"x_m": [80 + n, 90, 95, 100, 110]}}, slope=slope)) for n in (1, 2)]
        r = ceduo("-f", "json", "-n", 100, "--calibrate", "slope.materials[talus].rt=0.7:0.95", *paths)
        expect_equal(r.status, DONE, r)
        result = r.json()[0]
        expect_equal([o["scene"] for o in result["observations"]], [str(p) for p in paths])
        expect_equal(len(result["parameters"]), 1)


def test_csv():
    """CSV has a row per value"""
    with Folder() as f:
        out = ceduo("-f", "csv", "-n", 100, "--calibrate", f"{RT}=0.7:0.98", f.write("s.yaml", quarry())).out.splitlines()
        expect_equal(out[0].split(",")[1:4], ["path", "lo", "hi"])
        expect_equal(out[1].split(",")[1:4], [RT, "0.7", "0.98"])
        expect_equal(len(out), 2)


def test_scars():
    """A fit to the number of scars reports if the observed share is unknown"""
    stems = {"name": "w", "trees": [{"per_ha": 600, "dbh_m": 0.2, "height_m": 14, "volume_m3": 0.2}]}
    what = quarry({"scars": {"from_m": 60, "to_m": 90, "height_m": [0.4, 0.5, 0.9], "of": 5}},
                  forest=[{"from_m": 60, "to_m": 90, "stand": stems}])
    with Folder() as f:
        page = ceduo("-n", 50, "--calibrate", f"{RT}=0.7:0.98", f.write("s.yaml", what)).out
        expect_in("A survey misses some scars", page)


def test_written():
    """-o writes the scene with the best value, and the draws next to it; uncertainty reads them"""
    materials = {"vertices_m": [[0, 60], [40, 20], [60, 8], [200, 0]],
                 "materials": [{"from_m": 0, "to_m": 50, "material": "talus"}, {"from_m": 50, "to_m": 200, "material": "colluvium"}]}
    with Folder() as f:
        for path, what in ((RT, quarry()), ("slope.materials[talus].rt", quarry(slope=materials))):
            for output in ("fitted.yaml", "elsewhere/fitted.yaml"):
                out = f.path / output
                out.parent.mkdir(exist_ok=True)
                r = ceduo("-f", "json", "-n", 50, "--calibrate", f"{path}=0.7:0.9", "-o", out, f.write("s.yaml", what))
                expect_equal((r.status, r.err), (DONE, ""), r)
                best = r.json()[0]["parameters"][0]["best"]
                text = out.read_text()
                expect_in(f"rt: {best}", text)
                expect_in("kind: calibrated", text)
                expect_in("uncertainty: {draws: fitted.draws.csv}", text)
                draws = (out.parent / "fitted.draws.csv").read_text().splitlines()
                expect_equal(draws[0], "slope.segments[0].rt" if path == RT else path)
                expect(len(draws) > 200)
                r = ceduo("--sensitivity=4", "-f", "json", "-n", 20, out)
                expect_equal((r.status, r.err), (DONE, ""), r)
                expect_in("draws", [i["path"] for i in r.json()[0]["figures"][0]["inputs"]])


def test_written_where_it_lies():
    """A profile that begins at 100 m is written in its coordinates, and its controls keep their places"""
    points = [[100, 60], [140, 20], [160, 8], [300, 0]]
    slope = {"vertices_m": points, "materials": [{"from_m": 100, "to_m": 150, "material": "talus"},
                                                 {"from_m": 150, "to_m": 300, "material": "colluvium"}]}
    what = quarry({"passed": {"x_m": 160, "count": 30, "of": 40}}, slope=slope, release={"x_m": 100, "height_m": 2, "vx_m_s": 0.5},
                  controls=[{"x_m": 160}])
    with Folder() as f:
        out = f.path / "fitted.yaml"
        r = ceduo("-n", 50, "--calibrate", "slope.materials[talus].rt=0.7:0.98", "-o", out, f.write("s.yaml", what))
        expect_equal(r.status, DONE, r)
        written = re.search(r"vertices_m: *(\[\[.*\]\])", out.read_text())
        expect(written, out.read_text())
        x = [float(n) for n, _ in re.findall(r"\[([\d.]+), ([\d.]+)\]", written[1])]
        expect_equal([n for n in x if n in (100, 140, 160, 300)], [100, 140, 160, 300], written[1])
        expect_equal((x[0], x[-1]), (100, 300))
        expect_equal(good("-b", "-n", 20, "-f", "json", out).json()[0]["options"][0]["controls"][0]["x_m"], 160)


def test_written_as_yml():
    """A scene may end in .yml as well"""
    with Folder() as f:
        r = ceduo("-n", 20, "--calibrate", f"{RT}=0.7:0.98", "-o", f.path / "fitted.yml", f.write("s.yaml", quarry()))
        expect_equal(r.status, DONE, r)
        expect_in("uncertainty: {draws: fitted.draws.csv}", (f.path / "fitted.yml").read_text())


def test_not_written():
    """If the draws cannot be written next to the scene, neither is: their name is a device, or too long"""
    with Folder() as f:
        path = f.write("s.yaml", quarry())
        (f.path / "fitted.draws.csv").symlink_to("/dev/null")
        for name, why in (("fitted", "Invalid argument"), (240 * "n", "File name too long")):
            r = ceduo("-n", 20, "--calibrate", f"{RT}=0.7:0.98", "-o", f.path / f"{name}.yaml", path)
            expect_equal(r.status, OUTPUT, r)
            expect_in(f"{name}.draws.csv: {why}", r.err)
            expect(not (f.path / f"{name}.yaml").exists() and f.names() == ["fitted.draws.csv", "s.yaml"], f.names())


def test_draws_checked_before_the_fit():
    """Draws that the run reads, by any name, are not overwritten; nor does a fit begin whose draws cannot be written"""
    with Folder() as f:
        table = f.write("fit.draws.csv", f"{RN.replace('*', '0')}\n0.3\n0.4\n")
        (f.path / "link.draws.csv").symlink_to("fit.draws.csv")
        path = f.write("s.yaml", quarry(uncertainty={"draws": "fit.draws.csv"}))
        fine = f.write("t.yaml", quarry())
        for name, scenes in (("fit", [path]), ("link", [path]), ("fit", [fine, path])):
            r = ceduo("-n", 20, "--calibrate", f"{RT}=0.7:0.98", "-o", f.path / f"{name}.yaml", *scenes)
            expect_equal((r.status, r.out), (OUTPUT, ""), r)
            expect_in(f"{name}.draws.csv: this file is an input of the run; write elsewhere", r.err)
            expect_equal(table.read_text(), f"{RN.replace('*', '0')}\n0.3\n0.4\n")
        (f.path / "null.draws.csv").symlink_to("/dev/null")
        r = ceduo("-n", 20, "--calibrate", f"{RT}=0.7:0.98", "-o", f.path / "null.yaml", fine)
        expect_equal((r.status, r.out), (OUTPUT, ""), r)
        expect_equal(f.names(), ["fit.draws.csv", "link.draws.csv", "null.draws.csv", "s.yaml", "t.yaml"])


def test_source_of_a_count():
    """The source of a fit has both numbers of a count"""
    with Folder() as f:
        seen = {"passed": {"x_m": 60, "count": 5, "of": 6}}
        r = ceduo("-n", 20, "--calibrate", f"{RT}=0.7:0.98", "-o", f.path / "fitted.yaml", f.write("s.yaml", quarry(seen)))
        expect_equal(r.status, DONE, r)
        expect_in('text: "5 of 6 passed at 60 m; rt 95 %', (f.path / "fitted.yaml").read_text())


def test_uncertainty_written():
    """-o replaces uncertainty rows of fitted values and keeps the others, also with draws of an earlier fit"""
    density = {"path": "rock.density_kg_m3", "lo": 2400, "hi": 2700}
    uncertainty = [{"path": "slope.segments[0].rt", "lo": 0.6, "hi": 0.99}, density]
    with Folder() as f:
        path = f.write("s.yaml", quarry(uncertainty=uncertainty))
        for scene_path, out in ((path, f.path / "fitted.yaml"), (f.path / "fitted.yaml", f.path / "again.yaml")):
            r = ceduo("-n", 50, "--calibrate", f"{RT}=0.7:0.98", "-o", out, scene_path)
            expect_equal((r.status, r.err), (DONE, ""), r)
            expect_in(f"{{draws: {out.stem}.draws.csv, rows: [{{path: rock.density_kg_m3, lo: 2400, hi: 2700}}]}}", out.read_text())
            r = ceduo("--sensitivity=4", "-f", "json", "-n", 20, out)
            expect_equal({i["path"] for i in r.json()[0]["figures"][0]["inputs"]}, {"draws", "rock.density_kg_m3"}, r)


TWO_GROUNDS = {"vertices_m": [[0, 150], [20, 110], [120, 20], [160, 5]],
               "materials": [{"from_m": 0, "to_m": 20, "material": "cliff"}, {"from_m": 20, "to_m": 160, "material": "talus"}]}
DENSITY = {"path": "rock.density_kg_m3", "lo": 2450, "hi": 2700}


def above_the_road(**changes):
    """A scene whose fit takes no time."""
    return scene(**{"title": "A road", "rock": {"diameter_m": 0.8, "density_kg_m3": 2600}, "release": {"height_m": 2, "vx_m_s": 0.5},
                    "slope": TWO_GROUNDS, "controls": [{"x_m": 60}], "forest": None, "simulation": {"rocks": 20},
                    "observed": [{"passed": {"x_m": 60, "count": 5, "of": 6}}], **changes})


def ranges(path):
    """Return the uncertain inputs of a scene: path and range."""
    inputs = good("--sensitivity=4", "-f", "json", "-n", 20, path).json()[0]["figures"][0]["inputs"]
    return {i["path"]: tuple(round(end, 9) if isinstance(end, float) else end for end in (i["lo"], i["hi"])) for i in inputs}


def fit_and_compare(f, what, *values):
    """Fit values of a scene that is written to s.yaml. Return the text of the new scene, and the ranges of both."""
    path, out = f.write("s.yaml", what), f.path / "fitted.yaml"
    r = ceduo("-n", 20, *[word for value in values for word in ("--calibrate", value)], "-o", out, path)
    expect_equal((r.status, r.err), (DONE, ""), r)
    return out.read_text(), ranges(path), ranges(out)


def without(named, *paths):
    return {path: ends for path, ends in named.items() if path not in paths}


def test_ranges_of_a_library_ground():
    """A fitted ground of the library stays in its row: the ranges of the user, of the other grounds and of the other values stay"""
    roughness = {"path": "slope.materials[talus].roughness_m", "lo": 0.05, "hi": 0.6}
    with Folder() as f:
        friction = "slope.materials[talus].friction"
        text, before, after = fit_and_compare(f, above_the_road(uncertainty=[DENSITY, roughness]), f"{friction}=0.1:0.8")
        expect_equal(len(before), 9, "two grounds of four values, and the density")
        expect_equal(without(after, "draws"), without(before, friction))
        expect_equal(after[roughness["path"]], (0.05, 0.6))
        expect(re.search(r'"material": "cliff"\}, \{from_m: 20, to_m: 160, material: talus, friction: [\d.]+, source: ', text), text)
        expect("segments" not in text and text.count("calibrated") == 1 and "except" not in text, text)
        text, before, after = fit_and_compare(f, above_the_road(uncertainty=[DENSITY, roughness]), f"{RN}=0.2:0.5")
        expect_equal(without(after, "draws"), without(before, *(f"slope.materials[{ground}].rn" for ground in ("cliff", "talus"))))
        expect_equal((text.count("calibrated"), (f.path / "fitted.draws.csv").read_text().split("\n")[0]), (2, RN))
        own = {**TWO_GROUNDS, "materials": [{"from_m": 0, "to_m": 160, "material": "talus", "rn": 0.3}]}
        text, before, after = fit_and_compare(f, above_the_road(slope=own), f"{friction}=0.1:0.8")
        expect_equal(without(after, "draws"), without(before, friction))
        expect_in("except: [rn]}", text)


def test_ranges_of_an_assumed_ground():
    """A profile without ground gets a row of talus; the other values of talus stay uncertain, and its file is still named"""
    with Folder() as f:
        f.write("profile.csv", "x,z\n0,150\n20,110\n120,20\n160,5\n")
        for path in ("slope.materials[talus].friction", "slope.segments[*].friction"):
            text, before, after = fit_and_compare(f, above_the_road(slope={"csv": "profile.csv"}), f"{path}=0.1:0.8")
            expect_equal(without(after, "draws"), without(before, "slope.materials[talus].friction", "slope.tolerance_m"),
                         "no tolerance of its range leaves out a point")
            expect_equal(len(after), 4, after)
            expect_in("profile.csv", text)


def test_ranges_of_assumed_values():
    """Assumed values beside a fitted one are not called calibrated, and keep their ranges; so do those of other mappings"""
    guess = {"kind": "assumed", "text": "a guess"}
    ground = {"rn": 0.3, "rt": 0.98, "roughness_m": 0.2, "friction": 0.5}
    slope = {"vertices_m": TWO_GROUNDS["vertices_m"], "segments": [ground, {**ground, "rn": 0.4}, {**ground, "source": guess}], "source": guess}
    forest = [{"from_m": 30, "to_m": 50, "stand": stand(stools=None, shoots=None, energy={"model": "brauner", "u_J_m3": 30000, "source": guess}, trees=[
        {"per_ha": 100, "dbh_m": 0.2, "height_m": 12, "volume_m3": 0.2, "source": guess}])}]
    fitted = {"slope.segments[1].friction": "0.1:0.8", "forest[0].stand.trees[0].dbh_m": "0.1:0.3", "forest[0].stand.energy.u_J_m3": "2e4:4e4"}
    with Folder() as f:
        what = above_the_road(slope=slope, forest=forest)
        text, before, after = fit_and_compare(f, what, *(f"{path}={ends}" for path, ends in fitted.items()))
        expect_equal(before["slope.segments[1].rt"], (0.931, 1.029))
        expect_equal(without(after, "draws"), {**without(before, *fitted), "slope.segments[1].rt": (0.931, 1)})
        expect("forest[0].stand.energy.model" in after and len(after) == len(before) - 2, "three values are now draws", after)
        for names in ("rn, rt, roughness_m", "per_ha, height_m, volume_m3", "model"):
            expect_in(f"except: [{names}]", text)
        expect_equal((text.count("calibrated"), text.count("a guess")), (3, 2), "the other segments keep their source")
        read = good("--check", f.path / "fitted.yaml")
        expect_equal(read.err, "")


def test_nothing_dropped():
    """A fit that would drop a range or draws of another value is refused before it begins, with a remedy"""
    with Folder() as f:
        first, second = f.path / "first.yaml", f.path / "second.yaml"
        path = f.write("s.yaml", above_the_road())
        friction, roughness = (f"slope.materials[talus].{key}" for key in ("friction", "roughness_m"))
        good("-n", 20, "--calibrate", f"{friction}=0.1:0.8", "-o", first, path)
        wide = f.write("wide.yaml", above_the_road(uncertainty=[{"path": "slope.segments[*].friction", "lo": 0.2, "hi": 0.7}]))
        for values, scene_path, why in (
                ([roughness], first, "'first.draws.csv' has draws of other values, which the new scene would lose; fit all of them together"),
                ([friction], wide, "the row 'slope.segments[*].friction' of uncertainty also names values that are not fitted"),
                (["slope.segments[0].friction"], path, "'slope.segments[0].friction' cannot be written into 'materials'; fit slope.materials[NAME].KEY"),
                (["slope.materials[talus].roughness_rad"], path, "'slope.materials[talus].roughness_rad' cannot be written into 'materials'")):
            fits = [f"--calibrate={value}=0.1:0.6" for value in values]
            r = ceduo("-n", 20, *fits, "-o", second, scene_path)
            expect_equal((r.status, r.out), (USAGE, ""), r)
            expect_in(why, r.err)
            expect(not second.exists())
            expect_equal(ceduo("-n", 20, *fits, scene_path).status, DONE, "a fit that writes no scene")
        good("-n", 20, "--calibrate", f"{friction}=0.1:0.8", "--calibrate", f"{roughness}=0.1:0.6", "-o", second, first)
        expect_equal((f.path / "second.draws.csv").read_text().split("\n")[0], f"{friction},{roughness}")


def test_written_without_a_value():
    """A value that only another scene has is not written into the first"""
    one = {**TWO_GROUNDS, "materials": [{"from_m": 0, "to_m": 160, "material": "cliff"}]}
    with Folder() as f:
        out = f.path / "fitted.yaml"
        good("-n", 20, *[f"--calibrate=slope.materials[{ground}].friction=0.1:0.8" for ground in ("talus", "cliff")], "-o", out,
             f.write("s.yaml", above_the_road(slope=one)), f.write("t.yaml", above_the_road()))
        expect_in("draws", ranges(out))
        expect_equal({len(line.split(",")) for line in (f.path / "fitted.draws.csv").read_text().splitlines()}, {1})


def test_table_from_elsewhere():
    """Tables of observations are found from a scene written in another folder, for all forms of their name"""
    for seen in ({"x_m": "stops.csv", "of": 30}, {"csv": "stops.csv", "of": 30}):
        with Folder() as f:
            f.write("stops.csv", "x_m\n" + "\n".join(str(x) for x in STOPS) + "\n")
            path = f.write("s.yaml", quarry({"stops": seen, "passed": {"x_m": 60, "count": 30, "of": 30}}))
            out = f.path / "other" / "fitted.yaml"
            out.parent.mkdir()
            r = ceduo("-n", 50, "--calibrate", f"{RT}=0.8:0.9", "-o", out, path)
            expect_equal(r.status, DONE, r)
            expect_equal(ceduo("--batch", "-n", 10, out).status, DONE, out.read_text())


def test_draws():
    """A table of draws that does not fit"""
    with Folder() as f:
        f.write("good.csv", "slope.segments[0].rt\n0.8\n0.9\n")
        f.write("other.csv", "slope.colour\n0.8\n")
        f.write("short.csv", "slope.segments[0].rt,slope.segments[0].rn\n0.8\n")
        f.write("empty.csv", "slope.segments[0].rt\n")
        good = f.write("s.yaml", quarry(uncertainty={"draws": "good.csv", "rows": [{"path": "rock.density_kg_m3", "lo": 2400, "hi": 2700}]}))
        expect_equal(ceduo("--check", good).err, "")
        for uncertainty, what in (({"draws": "none.csv"}, "cannot find 'none.csv' next to this file"),
                            ({"draws": "other.csv"}, "column 'slope.colour' is not a value of this scene"),
                            ({"draws": "short.csv"}, "too few columns"), ({"draws": "empty.csv"}, "the table has no row"),
                            ({"draws": ["good.csv"]}, "expected a path to a file"),
                            ({"draws": "good.csv", "row": []}, "unknown key; known here: draws, rows")):
            r = ceduo("--check", f.write("s.yaml", quarry(uncertainty=uncertainty)))
            expect_equal(r.status, INPUT, r)
            expect_in(what, r.err)


def test_draws_that_fit_nothing():
    """Draws out of range, fields without a head and values set twice are refused with their line"""
    rt, rn, friction = (f"slope.segments[0].{key}" for key in ("rt", "rn", "friction"))
    row = {"path": rt, "lo": 0.7, "hi": 0.9}
    tables = (
        (f"{rt}\n0\n1\n", [], None), (f"{rt} {friction},{rn}\r\n0.8,0\r\n\r\n0.9,1\r\n", [], None),
        (f"{rt}\n0.8\n1.25\n", [], "t.csv:3:1: 1.25 is outside the range of rt: 0…1"),
        (f"{rt};{rn}\n0,8;0,5\n0,9;-0,5\n", [], "t.csv:3:5: -0.5 is outside the range of rn: 0…1"),
        (f"{rt} {friction},{rn}\n2,0.5\n", [], "t.csv:2:1: 2 is outside the range of rt: 0…1"),
        (f"{friction} {rt}\n0.5\n\n2\n", [], "t.csv:4:1: 2 is outside the range of rt: 0…1"),
        (f"{rt}\n0.8,0.9\n0.8\n", [], "t.csv:2:5: more columns than the first line has"),
        (f"{rt}\n0.8\n0.8,\n", [], "t.csv:3:5: more columns than the first line has"),
        (f"{rt},{rn},{rt}\n0.8,0.5,0.8\n", [], f"t.csv:1:1: '{rt}' is given twice"),
        (f"{rt} {rt}\n0.8\n", [], f"t.csv:1:1: '{rt}' is given twice"),
        (f"{rn},slope.segments[*].rn\n0.5,0.5\n", [], f"t.csv:1:1: '{rn}' is given twice"),
        (f"{rn}\n0.5\n", [row], None),
        (f"{rn},{rt}\n0.5,0.8\n", [row], f"uncertainty[0].path: '{rt}' is given twice"),
        (f"{rt}\n0.8\n", [{**row, "path": "slope.segments[*].rt"}], "uncertainty[0].path: 'slope.segments[*].rt' is given twice"),
    )
    with Folder() as f:
        for table, rows, told in tables:
            f.write("t.csv", table)
            r = ceduo("--check", f.write("s.yaml", quarry(uncertainty={"draws": "t.csv", "rows": rows})))
            expect_equal(r.status, DONE if told is None else INPUT, (table, r))
            expect_in(told or "", r.err)
        wood = {"name": "wood", "trees": [{"per_ha": 600, "dbh_m": 0.2, "height_m": 14, "volume_m3": 0.2}]}
        for first, status in (("0", INPUT), ("wood", INPUT), ("*", DONE)):
            uncertainty = [{"path": f"forest[{i}].stand.trees[0].dbh_m", "lo": 0.1, "hi": 0.3} for i in (first, "wood")]
            r = ceduo("--check", f.write("s.yaml", quarry(forest=[{"from_m": 60, "to_m": 90, "stand": wood}], uncertainty=uncertainty)))
            expect_equal(r.status, status, r)
            expect_in("uncertainty[1].path: 'forest[wood].stand.trees[0].dbh_m' is given twice" if status else "", r.err)


def test_draws_of_many_places():
    """A head with tens of thousands of values is fast"""
    n = 20000
    slope = {"vertices_m": [[i, n - i] for i in range(n + 1)], "segments": [GROUND] * n}
    head = " ".join(f"slope.segments[{i}].rt" for i in range(n))
    with Folder() as f:
        f.write("t.csv", f"{head}\n0.8\n0.9\n")
        uncertainty = {"draws": "t.csv", "rows": [{"path": "slope.segments[*].rn", "lo": 0.2, "hi": 0.5}]}
        expect_equal(ceduo("--check", f.write("s.yaml", quarry(slope=slope, uncertainty=uncertainty))).err, "")


def test_several_paths():
    """Several paths are one value, which both places get"""
    paths = "slope.segments[0].rt slope.segments[1].rt"
    slope = {"vertices_m": [[0, 60], [15, 42], [40, 20], [200, 0]], "segments": [GROUND, GROUND, GROUND]}
    with Folder() as f:
        path = f.write("s.yaml", quarry(slope=slope))
        r = ceduo("-f", "json", "-n", 50, "--calibrate", f"{paths}=0.7:0.98", path)
        expect_equal(r.status, DONE, r)
        parameters = json.loads(r.out)["parameters"]
        expect_equal([p["path"] for p in parameters], [paths])
        page = good("-n", 50, "--calibrate", f"{paths}=0.7:0.98", "-o", f.path / "fitted.yaml", path).out
        expect(re.search(r"Rt .* 0\.700.0\.980", page), page)
        expect_equal((f.path / "fitted.draws.csv").read_text().splitlines()[0], paths)


def test_refused():
    """Values that cannot be fitted"""
    with Folder() as f:
        path = f.write("s.yaml", quarry())
        nothing = f.write("n.yaml", quarry([]))
        round_rock = f.write("r.yaml", quarry(simulation={"law": "arm"}))
        checks = f.write("c.yaml", quarry({"stops": {"x_m": STOPS, "use": "check"}}))
        for what, arguments in (("is not PATH=LO:HI", [f"{RT}", path]), ("the range 0.9:0.7 is empty", [f"{RT}=0.9:0.7", path]),
                                ("'slope.colour' is not a number of these scenes", ["slope.colour=0:1", path]),
                                ("' ' is not a number of these scenes", [" =0:1", path]),
                                ("'simulation.law' is not a number of these scenes", ["simulation.law=0:1", path]),
                                ("'simulation.seed' is not a number of these scenes", ["simulation.seed=1:9", path]),
                                ("'observed[*].n' is not a number of these scenes", ["observed[*].n=1:9", path]),
                                ("1.5 is outside the range of", [f"{RT}=0.5:1.5", path]),
                                ("'slope.materials[talus].rn' is not a number of these scenes", ["slope.materials[talus].rn=0.2:0.5", path]),
                                ("are the same value", [f"{RT}=0.7:0.9", "--calibrate", "slope.segments[0].rt=0.7:0.9", path]),
                                ("no scene has observations to fit", [f"{RT}=0.7:0.9", nothing]),
                                ("no scene has observations to fit", [f"{RT}=0.7:0.9", checks]),
                                ("has no effect in this law; only arm uses it", [f"{MU}=0.2:1", path]),
                                ("cannot be identified from rocks of one shape", [f"{MU}=0.2:1", round_rock]),
                                ("--check cannot be used with --calibrate", [f"{RT}=0.7:0.9", "--check", path]),
                                ("--calibrate cannot be used with --years", [f"{RT}=0.7:0.9", "--years", path])):
            r = ceduo("--calibrate", *arguments)
            expect_equal((r.status, r.out), (USAGE, ""), r)
            expect_in(what, r.err)


def interrupted(word, *arguments):
    """Interrupt a calibration after a word; return its output, its status, and the processor seconds it needed."""
    reads, writes = os.openpty()  # a terminal shows progress
    child = subprocess.Popen([CEDUO, "-j", "1", "-f", "json", *map(str, arguments)], stdout=subprocess.PIPE, stderr=writes,
                             env=environment(), cwd=ROOT)
    os.close(writes)
    shown = b""
    while not re.search(word, shown):
        shown += os.read(reads, 1000)
    before = children_seconds() + processor_seconds(child.pid)
    child.send_signal(signal.SIGINT)
    out, _ = child.communicate()
    os.close(reads)
    return out, child.returncode, children_seconds() - before


def test_interrupted():
    """Ctrl-C ends a calibration by its signal: nothing is printed, and an earlier fit and its draws stay"""
    with Folder() as f:
        path = f.write("s.yaml", quarry())
        out, draws = f.path / "fitted.yaml", f.path / "fitted.draws.csv"
        good = ceduo("-n", 50, "--calibrate", f"{RT}=0.7:0.98", "-o", out, path)
        expect_equal(good.status, DONE, good)
        before = [p.read_bytes() for p in (out, draws)]
        for word in (rb"log-likelihood -?\d", rb"R-hat \d"):  # during the search, and with draws
            printed, status, seconds = interrupted(word, "-n", 5000, "--calibrate", f"{RT}=0.7:0.98", "-o", out, path)
            expect_equal((printed, status), (b"", -signal.SIGINT), str(word))
            expect_equal([p.read_bytes() for p in (out, draws)], before, str(word))
            expect(seconds < 0.1 * SLOWER, f"{word}: ended after {seconds:.2f} s of processor")
        expect_equal(f.names(), ["fitted.draws.csv", "fitted.yaml", "s.yaml"])


if __name__ == "__main__":
    run_all(__name__)
