#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""--report with --each: one page for all lines of a region."""
import csv
import io
import re
import subprocess
import sys
from collections import Counter
from html import unescape
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import CEDUO, DONE, INPUT, USAGE, Folder, ceduo, environment, expect, expect_equal, expect_in, expect_near, run_all, wooded_scene
from test_report import Page, check_page

CLASSES = ["not reached", "yes, also without forest", "yes", "open", "no", "not judged"]
RATES = [0.02, 0.05, 0.01, 0.04]


def region(f, rows=None, **changes):
    """Write a scene whose rocks all reach the control without forest, and a table of lines with a rate each."""
    scene = wooded_scene(title="Valley <1>", controls=[{"x_m": 60, "name": "road", "accepted_kJ": 20}], **changes)
    if "options" in scene:
        del scene["forest"]
    f.write("s.yaml", scene)
    lines = rows or [f'L{i},{800 + 400 * i},"[{{per_year: {rate}, volume_m3: [0.2, 0.4]}}]"' for i, rate in enumerate(RATES)]
    f.write("rows.csv", "\n".join(["id,rock.density_kg_m3,blocks", *lines]) + "\n")


def run(f, *words):
    return ceduo("--report", "-", "-q", "-n", 200, "--each", "rows.csv", "--key", "id", *words, "s.yaml", cwd=f.path)


def tables(text):
    """Return the tables of a page: lists of rows of texts."""
    return [[[unescape(re.sub("<[^>]*>", "", cell)) for cell in re.findall(r"<t[hd][^>]*>(.*?)</t[hd]>", row, re.S)]
             for row in re.findall(r"<tr>(.*?)</tr>", table, re.S)] for table in re.findall(r"<table>(.*?)</table>", text, re.S)]


def test_page():
    """The page is one section of valid HTML: answer, classes, rates, worst lines, origin; chapters only if asked for"""
    with Folder() as f:
        region(f)
        r = run(f)
        expect_equal(r.status, DONE, str(r))
        page = Page(r.out)
        check_page(r.out, page)
        expect_equal((page.names.count("section"), page.names.count("h1"), page.text["title"][:10]), (1, 1, "Valley <1>"))
        expect_equal(page.text["h1"], "Valley <1>: 4 lines")
        for heading in ("Lines by answer", "Rocks per year, all lines together", "The 4 worst lines", "How to reproduce this page"):
            expect_in(heading, page.text["h2"])
        expect("not judged" not in page.text["h2"], page.text["h2"])
        for n in (1, 3, 9):
            text = run(f, "--chapters", n).out
            page = Page(text)
            expect_equal(page.names.count("section"), 1 + min(n, 4))
            expect_equal(len(page.ids), len(set(page.ids)), "ids")
            expect_in("1. Valley <1>: L3", page.text["h1"], "the worst line")
            expect(len(text) > len(r.out), n)


def test_figures():
    """Classes are counted as in CSV, rates are sums over the lines, the worst line comes first"""
    options = [{"name": "now", "forest": [wooded_scene()["forest"][0]]}, {"name": "none", "forest": []}]
    with Folder() as f:
        region(f, options=options)
        found = tables(run(f).out)
        r = ceduo("-b", "-q", "-n", 200, "-f", "csv", "--each", "rows.csv", "--key", "id", "s.yaml", cwd=f.path)
        rows = list(csv.DictReader(io.StringIO(r.out)))
        expect_equal(found[0][0][1:], CLASSES)
        for line in found[0][1:]:
            counts = Counter(int(row["verdict.class"]) for row in rows if row["option"] == line[0])
            expect_equal([int(n) for n in line[1:]], [counts[i] for i in range(6)], line)
        expect_equal([line[0] for line in found[1][1:]], ["without forest", "now", "none"])
        expect_near(float(found[1][1][1]), sum(RATES), 1e-9, "all rocks arrive without forest")
        expect_near(float(found[1][3][1]), sum(RATES), 1e-9, "an option without forest")
        sums = {k: sum(float(row[f"wooded.hazard.{k}_per_year"]) for row in rows if row["option"] == "now") for k in ("reach", "exceed")}
        expect_near(float(found[1][2][1]), sums["reach"], 0.005 * sums["reach"])
        expect_near(float(found[1][2][2]), sums["exceed"], 0.005 * sums["exceed"])
        order = [line[0] for line in found[2][1:] if line[0]]
        now = [row for row in rows if row["option"] == "now"]
        rank = {"4": 0, "3": 1, "2": 2}
        now.sort(key=lambda row: (rank.get(row["verdict.class"], 3), -float(row["wooded.hazard.exceed_per_year"])))
        expect_equal(order, [row["id"] for row in now])


def test_failed_lines():
    """A failed line and a line on which no rock moves are listed with their reason; the status is 3"""
    with Folder() as f:
        region(f, ["a,2600,", "b,x,", "c,2600,", "c,2600,"])
        r = run(f)
        expect_equal(r.status, INPUT, str(r))
        last = tables(r.out)[-1]
        expect_equal(last[0], ["line", "reason"])
        expect_equal({row[0]: row[1] for row in last[1:]}, {"b": "rock.density_kg_m3: 'x' is not a number",
                                                            "c": "the key 'c' is also that of line 4; give each row its own"})
        expect_in("not judged 2", re.search(r"<desc.*?</desc>", r.out, re.S).group())
        region(f, ["b,x,", "c,y,"])
        r = run(f)
        expect_equal((r.status, len(tables(r.out))), (INPUT, 1), "nothing was computed")
        Page(r.out)


def test_origin():
    """The printed command gives the same bytes; another input gives another hash"""
    with Folder() as f:
        region(f)
        first = run(f, "--chapters", "1").out
        command = unescape(re.findall(r"<pre[^>]*>(ceduo .*?)</pre>", first)[0])
        shell = command.replace("ceduo --report report.html", '"$CEDUO" -q --report -', 1)
        done = subprocess.run(["sh", "-c", shell], cwd=f.path, env=environment(CEDUO=CEDUO), capture_output=True, text=True, check=True)
        expect_equal(done.stdout, first, command)
        expect_equal(ceduo("--report", "page.html", "-q", "-j", 1, "-n", 200, "--each", "rows.csv", "--key", "id", "--chapters", 1, "s.yaml",
                           cwd=f.path).status, DONE)
        expect_equal((f.path / "page.html").read_text(), first, "-o, threads")
        hashes = re.findall(r"<dd>(?:rows.csv, )?([0-9a-f]{16})", first)[:2]
        f.write("s.yaml", (f.path / "s.yaml").read_text() + "\n")
        changed = re.findall(r"<dd>(?:rows.csv, )?([0-9a-f]{16})", run(f).out)
        expect_equal([a == b for a, b in zip(hashes, changed)], [True, False])


def test_options():
    """--chapters needs --report and --each"""
    with Folder() as f:
        region(f)
        for words in (["-b", "--each", "rows.csv", "--chapters", "1"], ["--report", "-", "--chapters", "1"],
                      ["--report", "-", "--each", "rows.csv", "--chapters", "x"]):
            expect_equal(ceduo(*words, "s.yaml", cwd=f.path).status, USAGE, words)


if __name__ == "__main__":
    run_all(__name__)
