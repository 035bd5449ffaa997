#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: brief
"""A forester's typing: centimetres, decimal commas, and unusual values that need a confirmation."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import FAST, Place, fast  # noqa: E402
from harness import expect, expect_equal, expect_in, run_all  # noqa: E402


def test_centimetres():
    """A diameter is typed in cm, with a comma or a dot; the file keeps metres and the dot."""
    for typed, shown, written in (("9", "9", "0.09"), ("7,5", "7.5", "0.075"), ("7.5", "7.5", "0.075"), ("10,25", "10.25", "0.1025")):
        with Place() as place:
            screen = place.play(f"key 2\nfind shoots[0].dbh_m\nset {typed}\ndump\nkey s")[0]
            expect_equal(screen.row("^1 +9000")[2], shown, f"{typed!r} in the field")
            expect_equal(place.text("fast.yaml"), FAST.replace("dbh_m: 0.06,", f"dbh_m: {written},"), f"{typed!r} in the file")
    screen = fast("key 2\nfind trees[1].dbh_m\ndump")[0]
    expect_equal(screen.row("^2 +20")[2], "35", "0.35 m")
    expect_in("; cm, >0…1000", screen.note)


def test_commas_elsewhere():
    """A decimal comma is accepted in every number, in a point of the profile, and in a value with its spread."""
    screens = fast("""key 3
        find rock.diameter_m
        set 0,75
        dump
        set 0,75 ± 0,05
        dump
        key 1
        find vertices_m[1]
        set 60,5 30,25
        resize 80 60
        dump""")
    expect_equal(screens[0].row("^diameter")[-1], "0.75")
    expect_equal(screens[1].row("^diameter")[-3:], ["0.75", "±", "0.05"])
    expect_in("60.5 30.25", screens[2].body)


def test_asks_back():
    """A stem of 9 m needs a confirmation; repeated it is accepted, another value is a new one, Esc restores."""
    start = "key 2\nwait idle\nfind shoots[0].dbh_m\nclear\n"
    before, asked, taken = fast(start + "dump\nset 900\ndump\nkey Enter\ndump")
    expect_in("diameter, cm: 900 cm? Usual is 1 to 200", asked.note)
    expect_in("Esc cancel", asked.bar, "still in the field")
    expect_equal(asked.now, before.now, "nothing has changed")
    expect_equal(taken.row("^1 +9000")[2], "900", "once more")
    other, left = fast(start + "set 900\nkey Backspace Backspace Backspace\ntype 0,09\nkey Enter\ndump\nkey Esc\nclear\ndump")
    expect_in("0.09 cm?", other.note)
    expect_equal(left.text, before.text, "after Esc")


def test_ranges_in_centimetres():
    """An impossible diameter is reported in cm."""
    for typed, words in (("-7", "-7 is below 0 cm"), ("1001", "1001 is above 1000 cm")):
        screen = fast(f"key 2\nfind shoots[0].dbh_m\nset {typed}\ndump")[0]
        expect_in(words, screen.note)
        expect("dbh_m" not in screen.text, "the key of the file is no label", screen)


if __name__ == "__main__":
    run_all(__name__)
