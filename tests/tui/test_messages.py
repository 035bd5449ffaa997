#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Each figure has one number and one name on every screen, and no sentence is cut."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import CUTS, FAST, WOOD, Place, run_script  # noqa: E402
from harness import PROFILES, expect, expect_equal, expect_in, run_all  # noqa: E402

PAPER = PROFILES / "scenes" / "paper-site.yaml"
LONG = "A title that says what the scene is about, for whom, and in which year"


def test_title():
    """The scene's title is in the first line, cut if it does not fit; a mark shows unsaved work"""
    with Place() as place:
        place.write("long.yaml", WOOD.replace("title: wood", f"title: {LONG}"))
        small, edited, wide = place.play("dump\nkey 3\nfind rock.diameter_m\nset 0.9\ndump\nresize 200 50\ndump", "long.yaml")
    for screen, mark in ((small, ""), (edited, "* ")):
        shown = re.search(r"8 \w+[^\w*]+(\S.*)…$", screen.lines[0])
        expect(shown and len(shown.group(1)) > 8 and f"{mark}{LONG}".startswith(shown.group(1)), screen.lines[0])
    expect_in(f"* {LONG}", wide.lines[0])
    expect(LONG[:5] not in wide.now, wide.now)


def test_explanation():
    """A field's explanation longer than two lines ends in a mark, never in the middle of a word"""
    source = "{kind: literature, text: " + "a remark of many words " * 12 + "}"
    with Place() as place:
        place.write("noted.yaml", WOOD.replace("upper\n", f"upper\n      source: {source}\n"))
        screen, = place.play("key 2\nfind forest[0].stand.stools.per_ha\ndump", "noted.yaml")
    expect(re.search(r"(a|remark|of|many|words) …$", screen.note), screen.note)
    expect(screen.lines[-3].strip(), "two lines:", screen.note)


def test_remarks():
    """A warning that does not fit the column is counted there, and is whole in view 4"""
    with Place() as place:
        found, page = place.play("wait idle\ndump\nkey 4\nresize 200 50\nkey End\ndump", PAPER)
    left = re.search(r"^! (\d+) more remarks?: view 4$", found.now, re.M)
    expect(left, "a number of remarks in", found.now)
    one_line = re.sub(r"\s+", " ", page.body)
    whole = re.sub(r"\s+", " ", page.now).split("! ")[1:]
    expect(len(whole) >= int(left.group(1)), whole, "where there is room; counted:", left.group(0))
    for sentence in whole:
        expect_in(sentence[:60].strip(), one_line)


def test_unusual():
    """A file with an unusual number opens, and the number is reported until a key; a start also reports it on standard error"""
    said = "80 m is unusual (usual: 0.05 to 15 m)"
    with Place() as place:
        place.write("large.yaml", FAST.replace("diameter_m: 0.5", "diameter_m: 80"))
        opened, later = place.play("key o\ntype large.yaml\nkey Enter\ndump\nkey 3\ndump")
        started = run_script(place.path, "dump start.txt\n", "large.yaml")
        start = place.text("start.txt")
    expect_in(f"diameter, m: {said}", opened.note)
    expect("unusual" not in later.note, later)
    expect_in(said, " ".join(start.split()))
    expect_in(f"large.yaml:4:35: rock.diameter_m: {said}", started.err)


def test_one_error():
    """An option's share has one error in view 5 and in the column"""
    with Place() as place:
        place.write("cuts.yaml", CUTS)
        screen, = place.play("key 5\nwait idle\ndump", "cuts.yaml")
    share = r"(\d+±\d+)"
    here, there = re.search(rf"^1 thick.*?\n? +{share}", screen.body, re.M), re.search(rf"above 250 kJ +{share}", screen.now)
    expect(here and there, screen)
    expect_equal(here.group(1), there.group(1))


def test_growth_in_centimetres():
    """View 6 names the displayed unit of a diameter"""
    growth = ("growth: {shoots: {dbh_most_m: 0.25, dbh_rate_1_y: 0.03, height_most_m: 18, height_rate_1_y: 0.05}, "
              "trees: {dbh_most_m: 0.6, dbh_rate_1_y: 0.02, height_most_m: 25, height_rate_1_y: 0.04}, shoots_young: 9, shoots_old: 3}")
    with Place() as place:
        place.write("grows.yaml", WOOD.replace("name: upper\n", f"name: upper\n      {growth}\n"))
        shoots, trees = place.play("key 6\nfind forest[0].stand.growth.shoots.dbh_most_m\ndump\n"
                                   "find forest[0].stand.growth.trees.dbh_most_m\ndump", "grows.yaml")
    expect(re.search(r"^largest diam., cm +25\b", shoots.body, re.M), shoots)
    expect(re.search(r"^largest diam., cm +60\b", trees.body, re.M), trees)


def test_no_forest():
    """Without forest view 4 has each figure once"""
    with Place() as place:
        place.write("open.yaml", WOOD[:WOOD.index("forest:")] + "simulation: {rocks: 1000}\n")
        screen, = place.play("key 4\nwait idle\nresize 80 40\ndump", "open.yaml")
    expect(re.search(r"^mean kJ +- +[\d.]+$", screen.body, re.M), screen)
    expect("hrough the wood" not in screen.body and "simulated" not in screen.body, screen)


def test_sentences_apart():
    """View 6 begins each sentence after a blank"""
    with Place() as place:
        screen, = place.play("key 6\nwait idle\nresize 120 40\ndump", PAPER)
    expect(not re.search(r"[a-z]\.[A-Z]", screen.body), screen)


if __name__ == "__main__":
    run_all(__name__)
