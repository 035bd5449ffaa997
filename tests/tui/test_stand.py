#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""View 2: values of a stand that follow an edit, those that stay with a message, and unlikely stands."""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
from play import FAST, Place  # noqa: E402
from harness import expect, expect_equal, expect_in, expect_near, run_all  # noqa: E402

ASSUMED = "source: {kind: assumed, text: a guess}"
PER_STOOL = FAST.replace("{per_ha: 9000,", "{per_stool: 2.5,").replace("{per_ha: 500,", "{per_stool: 0.5,")
# The first class of trees is assumed, the second counted; shoots grow, trees do not.
GROWS = FAST.replace("{per_ha: 80, dbh_m: 0.2, height_m: 12, volume_m3: 0.2}", f"{{per_ha: 80, dbh_m: 0.2, height_m: 12, {ASSUMED}}}").replace(
    "{per_ha: 9000, dbh_m: 0.06, height_m: 7, volume_m3: 0.01}", f"{{per_ha: 9000, dbh_m: 0.06, height_m: 7, {ASSUMED}}}").replace(
    "      energy: {model: brauner, u_J_m3: 100000, offset: whole}\n", """\
      energy: {model: brauner, u_J_m3: 100000, offset: whole}
      growth: {shoots: {dbh_most_m: 0.2, dbh_rate_1_y: 0.02, height_most_m: 15, height_rate_1_y: 0.03}, shoots_young: 9, shoots_old: 3}
""", 1)
# Trees grow, too, and a cut retains 60 + 40.
CUT = GROWS.replace("shoots_old: 3}\n", """\
shoots_old: 3,
               trees: {dbh_most_m: 0.5, dbh_rate_1_y: 0.02, height_most_m: 20, height_rate_1_y: 0.03}}
      cutting: {rotation_years: 20, stay_per_ha: [60, 40]}
""")


def play(text, script):
    with Place() as place:
        place.write("s.yaml", text)
        return place.play(script, "s.yaml")


def test_round_trip():
    """Shoots per stool stay so in the file; typing the other key replaces it, and u undoes it"""
    with Place() as place:
        place.write("s.yaml", PER_STOOL)
        screens = place.play("key 2\ndump\nfind stools.per_ha\nset 1500\ndump\nkey s", "s.yaml")
        expect_in("a stool", screens[0].body)
        expect_equal(place.text("s.yaml"), PER_STOOL.replace("per_ha: 3000", "per_ha: 1500"), "the file")


def test_per_hectare():
    """Shoots given per hectare stay constant, and the form explains it"""
    start, fewer = play(FAST, "key 2\ndump\nfind stools.per_ha\nset 1500\ndump")
    for screen in (start, fewer):
        expect(any(line.split()[:2] == ["1", "9000"] for line in screen.body.split("\n")), screen)
    fewer.has("6.333 shoots per stool")
    exact, = play(FAST.replace("{per_ha: 9000,", "{per_ha: 12345.678,"), "key 2\ndump")
    expect(any(line.split()[:2] == ["1", "12346"] for line in exact.body.split("\n")), exact)


def test_diameter():
    """A starred height follows its diameter by the growth curve, and keeps its star; u undoes both"""
    curve = [15 * (1 - (1 - d / 0.2) ** (0.03 / 0.02)) for d in (0.06, 0.12)]
    start, thicker, back = play(GROWS, "resize 120 40\nkey 2\nfind shoots[0].dbh_m\ndump\nset 12\ndump\nkey u\ndump")
    row = thicker.row(r"^1 +9000")
    expect_equal((row[2], row[3][-1]), ("12", "*"), thicker)
    expect_near(float(row[3][:-1]), 7 * curve[1] / curve[0], 0.05, "as much higher as the curve")
    expect_in("adjusted by the growth curve", thicker.note)
    expect_equal(back.row(r"^1 +9000"), start.row(r"^1 +9000"), "after one u")


def test_diameter_alone():
    """A measured height stays; an assumed one without a curve stays, too, with a message"""
    counted, beyond, tree = play(GROWS, """resize 120 40
        key 2
        find shoots[1].dbh_m
        set 15
        dump
        find shoots[0].dbh_m
        set 25
        dump
        find trees[0].dbh_m
        set 25
        dump""")
    expect_equal(counted.row(r"^2 +500")[2:4], ["15", "10"], counted)
    expect("assumed height" not in counted.note, counted)
    for screen, height in ((beyond, "7"), (tree, "12")):
        expect_in(f"assumed height unchanged at {height} m", screen.note)


def test_standards():
    """Today's trees and those retained by a cut are shown together; if they differ the form reports it"""
    start, more, cut = play(CUT, """resize 120 40
        key 2
        dump
        find trees[0].per_ha
        set 120
        dump
        find stay_per_ha
        set 80 60
        dump""")
    expect_equal(start.row("^trees kept per ha")[4:6], ["60", "40"], start)
    start.lacks("after a cut")
    more.has("! today 140, after a cut 100")
    cut.lacks("after a cut")


def test_unlikely():
    """Warnings of an unlikely stand appear below the form at once"""
    start, dense = play(PER_STOOL, "resize 120 40\nkey 2\ndump\nfind shoots[0].per_stool\nset 15\ndump")
    start.lacks("shoots a stool are more than")
    dense.has("! upper: 15.5 shoots a stool are more than 15")
    area = math.pi / 4 * (45000 * 0.06 ** 2 + 1500 * 0.12 ** 2 + 80 * 0.2 ** 2 + 20 * 0.35 ** 2)
    dense.has(f"! upper: {area:.1f} m²/ha of basal area are more than 60")


if __name__ == "__main__":
    run_all(__name__)
