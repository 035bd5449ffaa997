#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: brief
"""Contact models and options: common and different results."""
import csv
import io
import math
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import USAGE, Folder, belt, ceduo, expect, expect_equal, expect_near, good, result, run_all, wooded_scene
from pages import WHOLE
from runs import DIFFERENCES, FOUR, MODELS, PAPER, THICK, THIN, expect_run, no_difference, through, treated


def same_run(a, b):
    """Expect two options to have equal results, except for the name."""
    return {k: v for k, v in a.items() if k != "name"} == {k: v for k, v in b.items() if k != "name"}


def test_contact_models():
    """index and stems: the bare slope and the index agree, only stems simulate rocks in the forest"""
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
        expect_equal(result(path, "--seed", 1)["options"], runs["stems"]["options"], "again")
        expect(result(path, "--seed", 2)["options"] != runs["stems"]["options"], "another seed")
        for c in controls["stems"]:
            expect(c["wooded"]["energy_kJ"]["mean"] < c["bare"]["energy_kJ"]["mean"] - 5, "stems take nothing")
            expect(c["wooded"]["rocks_reached"] < c["bare"]["rocks_reached"], "stems stop none")
        expect(runs["stems"]["options"][0]["ends"]["stopped_by_stems"] > 0.01, "stopped by stems")
        expect(runs["stems"]["work"]["stems_drawn"] > 0, "stems drawn")
        expect_equal(runs["index"]["work"]["stems_drawn"], 0, "stems drawn by the index")


def test_no_stems_on_the_way():
    """No stem before a control: wooded equals bare in every figure, without contacts"""
    def expect_bare(control, where):
        wooded = dict(control["wooded"])
        expect_equal(wooded.pop("contacts"), {"mean": 0, "se": 0}, f"{where}: contacts")
        expect_equal(wooded, control["bare"], where)

    with Folder() as f:
        forests = {"none": [], "bare": [{"from_m": 10, "to_m": 95, "stand": {"name": "clearing"}}], "behind": [belt(70, 95)],
                   "above": [belt(0, 15)], "beyond": [belt(110, 150)]}
        path = f.write("s.yaml", wooded_scene(forest=None, release={"x_m": 16, "vx_m_s": 2}, options=[
            {"name": name, "forest": forest} for name, forest in forests.items()]))
        run = result(path)
        expect_run(run)
        found = {o["name"]: o for o in run["options"]}
        for name in ("none", "bare", "above", "beyond"):
            for control in found[name]["controls"]:
                expect_bare(control, f"{name} at {control['x_m']} m")
        expect_bare(found["behind"]["controls"][0], "a belt behind the control")
        behind = found["behind"]["controls"][1]["wooded"]
        expect(behind["contacts"]["mean"] > 1, "the belt behind the first control is met before the second", behind)
        apart = [d for d in run["differences"] if d["option"] == "behind" and d["x_m"] == found["behind"]["controls"][0]["x_m"]]
        expect_equal([d["reach_probability"] for d in apart], [no_difference("reach_probability")], "the same flights")
        for name in ("bare", "above"):
            expect(same_run({**found[name], "stands": [], "summary": 0, "controls": 0},
                            {**found["none"], "stands": [], "summary": 0, "controls": 0}), f"{name}: ends")
        # none and bare are the run without forest; the others run under each energy law
        expect_equal((run["work"]["runs"], run["work"]["rocks_flown"]), (7, 14000), "runs")


def test_duplicate_option():
    """An option under another name shares its run: no additional rocks, equal figures, a difference of exactly 0"""
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
            runs = 1 if model == "index" else 5
            expect_equal((run["work"]["runs"], run["work"]["rocks_flown"]), (runs, 1000 * runs), f"{model}: work")
            expect(run["work"]["runs_reused"] >= 2, f"{model}: runs reused", run["work"])
            fewer = result(path, "-n", 1000, *through(model), "--option", "first", "--option", "other")
            expect_equal(fewer["work"]["rocks_flown"], 1000 * runs, f"{model}: rocks without the copies")
            for difference in run["differences"]:
                if difference["option"] != "other":
                    for name in DIFFERENCES[::2] if difference["x_m"] == 60 else DIFFERENCES:
                        expect_equal(difference[name], no_difference(name), f"{model}: {difference['option']} {name}")
                elif model != "index":
                    expect(difference["energy_per_released_kJ"]["mean"] > 0 and difference["reach_probability"]["se"] > 0,
                           "fewer trees", difference)


def test_option_subset():
    """--option: an option's figures do not depend on other options; differences are to the first remaining one"""
    with Folder() as f:
        path = f.write("s.yaml", treated(none=None, many_thin=THIN, few_thick=THICK))
        whole = {o["name"]: o for o in result(path)["options"]}
        for names in (["many thin"], ["few thick", "many thin"], ["none", "few thick"]):
            run = result(path, *[a for n in names for a in ("--option", n)])
            expect_run(run)
            expect_equal(run["options"], [o for n, o in whole.items() if n in names], str(names))
            expect_equal({d["against"] for d in run["differences"]}, {run["options"][0]["name"]} if len(names) > 1 else set())


def test_no_pair_differs():
    """If no rock differs between two forests, the difference has a bound and no error: in JSON, in CSV and on the page"""
    with Folder() as f:
        more = {**THICK, "trees": [{**THICK["trees"][0], "per_ha": THICK["trees"][0]["per_ha"] + 1e-9}]}
        path = f.write("s.yaml", treated(thick=THICK, as_thick=more))
        n, z2 = 500, 1.959963984540054 ** 2
        for difference in result(path, "-n", n)["differences"]:
            found = difference["exceed_probability"] if difference["x_m"] == 105 else difference["reach_probability"]
            expect_equal((found["mean"], found["se"]), (0, None), "0 without an error")
            expect_near(found["below"], z2 / (n + z2), 1e-12, "Wilson's upper end of 0 of n")
        page = good(*WHOLE, "-n", n, path).out
        expect(re.search(r"(?m)^  as thick +\d+±\d+ ✘ +< 8 +[\d.]+ ✔ ", page), "no bound on the page", page)
        expect("+0 ±0" not in page, page)
        row = next(csv.DictReader(io.StringIO(good("--batch", "-f", "csv", "-n", n, "--option", "as thick", "--option", "thick", path).out)))
        expect(set(row) >= {f"difference.reach_probability.{k}" for k in ("mean", "se", "below")}, "columns", row)


def test_difference_errors():
    """Differences of options use the same rocks: their error is that of pairs, smaller than for separate runs"""
    with Folder() as f:
        path = f.write("s.yaml", treated(thick=THICK, one_more={**THICK, "trees": [{**THICK["trees"][0], "per_ha": 303}]}, thin=THIN))
        run = result(path, "-n", 4000)
        first, near, far = (o["controls"][1]["wooded"] for o in run["options"])
        differences = {d["option"]: d for d in run["differences"] if d["x_m"] == 105}
        apart = math.hypot(first["energy_per_released_kJ"]["se"], near["energy_per_released_kJ"]["se"])
        expect(0 < differences["one more"]["energy_per_released_kJ"]["se"] < 0.5 * apart, apart, differences["one more"])
        # a real difference is found at many times its error
        d = differences["thin"]["energy_per_released_kJ"]
        expect(d["mean"] > 10 * d["se"] > 0, d)
        bare = [o["controls"][1]["bare"] for o in run["options"]]
        expect(bare[0] == bare[1] == bare[2], "the options fly other rocks")


def test_option():
    """--option keeps the named options, in the scene's order; an unknown name is status 2"""
    names = ["large reserves", "simple coppice, 25 years"]
    run = result(FOUR, "-n", 20, "--option", names[0], "--option", names[1])
    expect_equal([o["name"] for o in run["options"]], names[::-1])
    whole = result(FOUR, "-n", 20)
    expect_equal(run["options"], [o for o in whole["options"] if o["name"] in names])
    expect_equal(result(PAPER, "-n", 1, "--option", "current")["options"][0]["name"], "current")
    done = ceduo("--batch", FOUR, "--option", "nope")
    expect(done.status == USAGE and done.out == "" and "'nope'" in done.err, done)
    for name in ("in three, top first", "in tre, dall'alto"):  # its name in the language of the reader
        left = result("staggered", "-n", 20, "--language", "it", "--option", name)["options"]
        expect_equal([o["name"] for o in left], ["in three, top first"])
    done = ceduo("--check", FOUR, "--option", "nope")
    expect(done.status == USAGE, done)


def test_spread_uses_nothing_else():
    """All options of a scene use the same rocks, and adding an option changes no number of another"""
    run = result(FOUR, "-n", 300)
    expect(all(o["controls"][0]["bare"] == run["options"][0]["controls"][0]["bare"] for o in run["options"]), "bare")
    one = result(FOUR, "-n", 300, "--option", "large reserves")["options"][0]
    expect_equal([o for o in run["options"] if o["name"] == "large reserves"], [one])


if __name__ == "__main__":
    run_all(__name__)
