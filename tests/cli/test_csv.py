#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: brief
"""CSV equals the JSON of the same runs."""
import csv
import io
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import Folder, belt, expect, expect_equal, expect_in, good, result, results, run_all, scene, wooded_scene
from pages import WHOLE
from runs import CONTROL_CELLS, FOUR, PAPER, STAND_CELLS, expect_rows, expect_run, read_csv, through


def test_csv_controls():
    """CSV has one header, a row per scene, option and control, and the values of JSON"""
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
            expect(group not in ("difference.", "wooded.") or ".hazard." in name or ".fence." in name or (cell == "") == (group in empty), f"{model}: {name}: {cell!r}")
        expect_in("Eq. 6", rows[0]["warnings"], "warnings")


def test_csv_null():
    """CSV is empty where JSON has null: no accepted energy, no arrival, one rock"""
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


def test_csv_formulas():
    """CSV puts an apostrophe before names that a spreadsheet would evaluate; other names and all numbers stay"""
    names = {"=1+1": "'=1+1", "+1": "'+1", "@sum": "'@sum", "-1+cmd": "'-1+cmd", "-\u00e8": "'-\u00e8", "=a,\"b\"": "'=a,\"b\"",
             "a=b": "a=b", "'=c": "'=c", "-": "-", "-5": "-5", "1": "1"}
    with Folder() as f:
        path = f.write("s.yaml", wooded_scene(title="=title", forest=None, controls=[{"x_m": 105, "name": "@road"}],
                                              options=[{"name": n, "forest": [belt(10, 50 + 4 * i, name=n)]} for i, n in enumerate(names)]))
        for rows, more in (("controls", ()), ("stands", ("--rows", "stands"))):
            cells = read_csv(good("--batch", "-f", "csv", "-n", 20, *more, path).out)[1]
            expect_equal([row["option"] for row in cells], list(names.values()), rows)
            expect_equal({row["title"] for row in cells}, {"'=title"}, rows)
        expect_equal([row["name"] for row in cells], list(names.values()), "stands")
        below = [row for row in read_csv(good("--batch", "-f", "csv", "-n", 200, path).out)[1]
                 if row["difference.energy_per_released_kJ.mean"].startswith("-")]
        expect(len(below) > 0 and below[0]["name"] == "'@road", "a difference below 0 is a number", below)


def test_csv_stands():
    """CSV --rows stands has a row per stand, and the values of JSON"""
    header, rows = read_csv(good("--batch", "-f", "csv", "--rows", "stands", PAPER, FOUR, "-n", "10").out)
    expect_equal(sorted(header), sorted(STAND_CELLS))
    expect_equal(len(rows), 2 + 8)
    expect_rows(rows, results(PAPER, FOUR, "-n", "10"), "stands")
    expect_equal(good("--batch", "-f", "csv", "--rows", "controls", PAPER).out,
                 good("--batch", "-f", "csv", PAPER).out, "--rows controls is the default")


def test_accepted_as_given():
    """The accepted energy appears in JSON, CSV and on the page as in the file"""
    given = [3.3, 2.3, 4.35, 0.007, 1.001, 8.2, 1e-3, 999.999, 123456.789]
    with Folder() as f:
        path = f.write("s.yaml", scene(controls=[{"x_m": 10 + i, "accepted_kJ": kJ} for i, kJ in enumerate(given)]))
        expect_equal([c["accepted_kJ"] for c in result("-n", 1, path)["options"][0]["controls"]], given, "JSON")
        rows = list(csv.DictReader(io.StringIO(good("--batch", "-f", "csv", "-n", 1, path).out)))
        expect_equal([row["accepted_kJ"] for row in rows], [f"{kJ:g}" if kJ < 1e3 else str(kJ) for kJ in given], "CSV")
        text = good(*WHOLE, "-n", 1, path).out
        expect_equal([float(kJ) for kJ in re.findall(r"(?m)^  At .*, limit (.*) kJ", text)], given, "the page")
        expect_in("\n  arrive with more than 3.3 kJ ", text, "row")


def test_no_stands_csv():
    """Without forest --rows stands is a header without rows, on standard output and in a file"""
    with Folder() as f:
        path, target = f.write("s.yaml", scene()), f.path / "out.csv"
        text = good("--batch", "-f", "csv", "--rows", "stands", path).out
        expect(text, "nothing is printed, not even the header")
        header, rows = read_csv(text)
        expect_equal((len(header), rows), (len(STAND_CELLS), []))
        good("--batch", "-f", "csv", "--rows", "stands", "-o", target, path)
        expect_equal(target.read_text(), text)


if __name__ == "__main__":
    run_all(__name__)
