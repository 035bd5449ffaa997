#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""If too few rocks arrive even without forest every output reports that there is no answer; and profiles drawn upward."""
import copy
import json
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import INPUT, Folder, ceduo, expect, expect_equal, expect_in, good, result, run_all, scene, stand, wooded_scene
from pages import WHOLE
from runs import read_csv

# A line as drawn on a map: it begins 4 m above the edge of the cliff, on ground too flat for rocks.
LINE = [(0, 141.4), (4, 140), (14, 105), (40, 88), (100, 50), (160, 15)]
SAYS = "cannot be assessed"


def csv(points):
    return "distance,elevation\n" + "".join(f"{x:g},{z:g}\n" for x, z in points)


def upward(points):
    """The same line drawn from its other end."""
    return [(points[-1][0] + points[0][0] - x, z) for x, z in reversed(points)]


def behind_the_edge(folder, **changes):
    folder.write("line.csv", csv(LINE))
    made = scene(release=None, rock={"diameter_m": 0.68}, slope={"csv": "line.csv"},
                 controls=[{"x_m": 120, "name": "road", "accepted_kJ": 50}],
                 forest=[{"from_m": 20, "to_m": 110, "stand": "simple-coppice"}], simulation={"rocks": 1000})
    made.update(changes)
    return folder.write("s.yaml", {key: value for key, value in made.items() if value is not None})


def expect_said(text, *parts):
    text = " ".join(text.split())
    for part in (SAYS, "none of 1000 rocks arrives, even without forest", "falls by 19", "release.x_m is not given", "release.x_m: 4", *parts):
        expect_in(part, text)


def test_outputs():
    """A profile that begins on flat ground: page, JSON, CSV, years, report, check, find and sensitivity give no answer."""
    with Folder() as f:
        path = behind_the_edge(f)
        page = good(*WHOLE, path).out
        expect_said(page)
        for light in ("passes", "FAILS"):
            expect(light not in page, "a light", page)
        run = result(path)
        control = run["options"][0]["controls"][0]
        expect_equal(control["verdict"]["answer"], "nothing")
        expect_said(control["verdict"]["because"])
        expect_equal(set(control["lights"].values()), {"unknown"}, "lights")
        expect_equal(control["other_energy"]["verdict"], {"answer": "nothing"})
        expect_said(run["warnings"][0])
        row = read_csv(good("--batch", "-f", "csv", path).out)[1][0]
        expect_equal(row["verdict.answer"], "nothing")
        expect_equal(row["lights.energy"], "unknown")
        for arguments in (("--check",), ("--find", "forest[0].stand.stools.per_ha=500:4000", "--goal", "exceed=0.05"),
                          ("--sensitivity=4",), ("--plot", "compare")):
            done = ceduo(*arguments, path)
            expect_said(done.err)
            expect("NO" not in done.out.split() and "pass" not in done.out.split(), "a light", done)
        years = result("--years", path)["options"][0]
        for key in ("contact", "free_run", "contact_8cm", "free_run_8cm", "energy"):
            expect_equal(years["rotation"]["unprotected_" + key], None, key)
        expect_equal(years["years"][0]["controls"][0]["verdict"]["answer"], "nothing")
        expect_in(SAYS, good(*WHOLE, "--years", path).out)
        good("--report", f.path / "r.html", path)
        expect_said((f.path / "r.html").read_text())
        good("--language", "it", "--report", f.path / "r.html", path)
        report = (f.path / "r.html").read_text()
        expect_in("non si può valutare", report)
        expect("Sì:" not in report and "tra 0 e 0" not in report, "an answer in Italian")


def test_edge():
    """The same scene released at the edge of the cliff has an answer, and no such warning"""
    with Folder() as f:
        path = behind_the_edge(f, release={"x_m": 4})
        run = result(path)
        control = run["options"][0]["controls"][0]
        expect(control["bare"]["rocks_reached"] > 900, control["bare"]["rocks_reached"])
        expect(control["verdict"]["answer"] in ("yes", "no", "not-decided"), control["verdict"])
        expect(SAYS not in json.dumps(run["warnings"]), run["warnings"])
        checked = ceduo("--check", path)
        expect_equal(checked.err, "", "--check")


def test_options():
    """No option is best without an answer, today or over the years"""
    with Folder() as f:
        path = behind_the_edge(f, forest=None, options=[
            {"name": name, "forest": [{"from_m": 20, "to_m": 110, "stand": name}]} for name in ("simple-coppice", "large-reserves")])
        page = good(*WHOLE, "--years", path).out
        expect_in("The forest above road (120 m) cannot be assessed", page)
        for word in ("lets the fewest", "clearly better", "0/25", "All options pass"):
            expect(word not in page, word, page)


def test_few():
    """Fewer than 1 in 1000 arriving rocks give no answer; another control with arrivals has its answer"""
    with Folder() as f:
        path = behind_the_edge(f, release={"x_m": 4}, controls=[{"x_m": 60, "accepted_kJ": 50}, {"x_m": 160, "accepted_kJ": 50}],
                               slope={"vertices_m": [*LINE[:4], [60, 75], [160, 75]], "segments": [{"rn": 0.3, "rt": 0.8}]})
        first, last = result(path)["options"][0]["controls"]
        expect(first["bare"]["rocks_reached"] > 900, first["bare"])
        expect(first["verdict"]["answer"] != "nothing", first["verdict"])
        expect_equal((last["bare"]["rocks_reached"], last["verdict"]["answer"]), (0, "nothing"))
        expect_in("rocks do not reach this place", last["verdict"]["because"])
        expect_in("They come to rest within", last["verdict"]["because"])


def test_answers():
    """verdict.answer follows the interval of the share and the limit of 5 in 100, and reports if the other law agrees"""
    with Folder() as f:
        seen = set()
        for accepted in range(10, 200, 10):
            path = f.write("s.yaml", wooded_scene(controls=[{"x_m": 105, "accepted_kJ": accepted}]))
            control = result(path, "-n", 500)["options"][0]["controls"][0]
            wooded, other = control["wooded"], control["other_energy"]
            found = []
            for of in (wooded, other):
                lo, hi = of["exceed_lo"], of["exceed_hi"]
                found.append("not-decided" if lo <= 0.05 < hi else "yes" if of["exceed_probability"] <= 0.05 else "no")
            expect_equal(control["verdict"]["answer"], found[0], accepted)
            differ = set(found) == {"yes", "no"}
            expect_equal(other["verdict"]["answer"], "depends" if differ else found[1], accepted)
            seen |= {found[0], other["verdict"]["answer"]}
        expect_equal(seen >= {"yes", "no", "not-decided"}, True, seen)
        path = f.write("s.yaml", wooded_scene(controls=[{"x_m": 105}]))
        expect_equal(result(path)["options"][0]["controls"][0]["verdict"]["answer"], None, "without accepted_kJ")
        path = f.write("s.yaml", wooded_scene(simulation={"rocks": 500, "contact_model": "index"}))
        expect_equal(result(path)["options"][0]["controls"][1]["verdict"]["answer"], None, "by the index")


# ---- profiles drawn upward ----

# Stretches of different lengths, each with its ground.
GROUND = [{"rn": 0.32 + i / 100, "rt": 0.8 + i / 100, "roughness_rad": 0.1, "friction": 0.4 + i / 100} for i in range(5)]
BANDS = [(0, 14, "cliff"), (14, 60, "talus"), (60, 160, "soft-soil-v4")]


def figures(path, *arguments):
    run = result(path, *arguments)
    run.pop("work")
    return {key: value for key, value in run.items() if key not in ("scene", "title")}


def band(a, b, material):
    return {"from_m": a, "to_m": b, "material": material}


def test_upward_refused():
    """A profile whose last vertex is higher than its first is refused with its remedy; a falling one is not reversed"""
    with Folder() as f:
        f.write("up.csv", csv(upward(LINE)))
        for slope in ({"csv": "up.csv"}, {"vertices_m": upward(LINE), "segments": GROUND[:1]}):
            path = behind_the_edge(f, slope=slope)
            refused = ceduo("--check", path)
            expect_equal(refused.status, INPUT, refused.err)
            expect_in("the profile rises from 15 to 141.4 m", refused.err)
            expect_in("reversed: true", refused.err)
            good("--check", behind_the_edge(f, release={"x_m": 4}, slope={**slope, "reversed": True}))
        refused = ceduo("--check", behind_the_edge(f, slope={"csv": "line.csv", "reversed": True}))
        expect_equal(refused.status, INPUT, refused.err)
        expect_in("the profile already falls from 141.4 to 15 m", refused.err)


def test_mirrored():
    """reversed mirrors the profile with its segments or materials: all figures equal those of the profile drawn downward"""
    with Folder() as f:
        f.write("up.csv", csv([(x + 500, z) for x, z in upward(LINE)]))
        moved = [(x + 500, z) for x, z in LINE]
        shift = {"release": {"x_m": 504}, "controls": [{"x_m": 620, "accepted_kJ": 50}],
                 "forest": [{"from_m": 520, "to_m": 610, "stand": "simple-coppice"}]}
        mirrored = [band(1160 - b - 500, 1160 - a - 500, m) for a, b, m in reversed(BANDS)]
        straight = [band(a + 500, b + 500, m) for a, b, m in BANDS]
        for down, up in (({"segments": GROUND}, {"segments": GROUND[::-1]}), ({"segments": GROUND[:1]}, {"segments": GROUND[:1]}),
                         ({"materials": straight}, {"materials": mirrored})):
            wanted = figures(behind_the_edge(f, **shift, slope={"vertices_m": moved, **down}))
            for profile in ({"vertices_m": upward(moved)}, {"csv": "up.csv"}):
                path = behind_the_edge(f, **shift, slope={**profile, **up, "reversed": True})
                expect_equal(figures(path), wanted, str(up)[:40])
        expect(wanted["options"][0]["controls"][0]["bare"]["rocks_reached"] > 0, "nothing arrives")


def test_mirrored_paths():
    """A path into such a slope means the item of its file, for --set and for uncertainty; so does a ground of the library"""
    with Folder() as f:
        def file(up, uncertainty):
            profile = {"vertices_m": upward(LINE) if up else LINE, "segments": copy.deepcopy(GROUND[::-1] if up else GROUND)}
            return behind_the_edge(f, release={"x_m": 4}, slope={**profile, **({"reversed": True} if up else {})},
                                   uncertainty=[{"path": f"slope.segments[{uncertainty}].rn", "lo": 0.1, "hi": 0.6}])
        wanted = figures(file(False, 3), "-s", "slope.segments[3].rn=0.5")
        expect_equal(figures(file(True, 1), "-s", "slope.segments[1].rn=0.5"), wanted, "--set")
        one, two = (good("--sensitivity=20", "-n", 200, "-f", "json", file(*how)).json()[0] for how in ((False, 3), (True, 1)))
        expect_equal([figure["uncertainty"]["p95"] for figure in two["figures"]], [figure["uncertainty"]["p95"] for figure in one["figures"]], "uncertainty")
        expect(one["figures"][0]["uncertainty"]["p5"] < one["figures"][0]["uncertainty"]["p95"], "nothing is in doubt")

        def library(up):
            bands = [band(160 - b, 160 - a, m) for a, b, m in reversed(BANDS)] if up else [band(*b) for b in BANDS]
            return behind_the_edge(f, release={"x_m": 4}, slope={"vertices_m": upward(LINE) if up else LINE, "materials": bands,
                                                                 **({"reversed": True} if up else {})},
                                   uncertainty=[{"path": "slope.materials[talus].rn", "lo": 0.1, "hi": 0.6}])
        one, two = (good("--sensitivity=20", "-n", 200, "-f", "json", library(up)).json()[0] for up in (False, True))
        expect_equal([figure["uncertainty"]["p95"] for figure in two["figures"]], [figure["uncertainty"]["p95"] for figure in one["figures"]], "a ground")


NO_NUMBER = re.compile(r"(?<![\w])[-+\u00b1]?(?:inf|nan|infinity)(?![\w])", re.IGNORECASE)
OUTPUTS = ("", "--details --years", "--sensitivity=4", "--report -", "-f csv --years", "-f csv --rows stands", "-f csv --sensitivity=4",
           "-f json --years", "-f json --sensitivity=4", *(f"--plot {kind}" for kind in ("tradeoff", "hazard", "energy", "uncertainty")))


def test_no_number():
    """One rock has no spread, and no arrivals no mean: no page, cell, object or picture prints nan or inf"""
    for name in ("paper-site", "rotation", "blocks-above-the-road", "vaujany"):
        for words in OUTPUTS:
            out = ceduo("--batch", "-n", 1, *words.split(), name).out
            expect(out and not NO_NUMBER.search(out), name, words, NO_NUMBER.findall(out), out)


if __name__ == "__main__":
    run_all(__name__)
