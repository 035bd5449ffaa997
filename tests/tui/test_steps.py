#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""+ and - in the terminal program: a step is one unit of the second digit, also from a power of ten down, so that + undoes -."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import play  # noqa: E402
from play import Place, fast  # noqa: E402
from harness import expect, expect_equal, expect_in, run_all  # noqa: E402

THRESHOLD = 3, "simulation.threshold_m", "^threshold"
ROCKS = 3, "simulation.rocks", r"^rocks \(batch\)"
STOOLS = 2, "stools.per_ha", "^stools per ha"


def stepped(field, start, keys):
    """Return the values of a field from a start on, one after each key."""
    view, name, row = field
    script = f"key {view}\nfind {name}\nset {start}\n" + "".join(f"key {key}\ndump\n" for key in keys)
    return [float(screen.row(row)[-1]) for screen in fast(script)]


def test_down_from_a_power_of_ten():
    """Down from 1 the step is that below: 0.99; and + returns to 1"""
    for field, start, lower in ((THRESHOLD, 0.1, 0.099), (THRESHOLD, 1, 0.99), (THRESHOLD, 10, 9.9),
                                (THRESHOLD, 100, 99), (THRESHOLD, 10000, 9900), (STOOLS, 1000, 990),
                                (ROCKS, 1000, 990), (ROCKS, 100, 99)):
        expect_equal(stepped(field, start, "-+"), [lower, start], f"{field[1]} from {start}: after -, then +")


def test_through_a_power_of_ten():
    """From 1.2 down to 0.97 and up again: tenths above 1, hundredths below"""
    down = [1.1, 1, 0.99, 0.98, 0.97]
    expect_equal(stepped(THRESHOLD, 1.2, "-" * 5 + "+" * 5), down + [0.98, 0.99, 1, 1.1, 1.2], "threshold")


def test_counts_stay_whole():
    """A small count has steps of 1: from 10 down to 9"""
    expect_equal(stepped(ROCKS, 11, "---++"), [10, 9, 8, 9, 10], "rocks")


def test_centimetres():
    """A diameter steps in the displayed centimetres: from 30 to 31, and the file has metres"""
    for start, keys, metres in ((30, "+", "0.31"), (30, "-", "0.29"), (10, "-", "0.099"), (9.9, "+", "0.1"), (100, "+", "1.1")):
        with Place() as place:
            place.play(f"key 2\nfind trees[0].dbh_m\nset {start}\nkey {keys}\nkey s\nwait idle\ndump")
            expect_in(f"per_ha: 80, dbh_m: {metres},", place.text("fast.yaml"))


def test_picture():
    """A picture hides the field under the cursor: no key changes or opens it there"""
    for view, field in ((1, "controls[1].accepted_kJ"), (6, "minimum.reserves_per_ha")):
        with Place() as place:
            screens = place.play(f"key {view}\nwait idle\nfind {field}\nkey Tab\n" + "".join(f"key {key}\ndump\n" for key in "+-=_") + "key Enter\ndump\nkey s\ndump")
            for screen in screens[:-1]:
                expect_equal(screen.note, "put the cursor on an item of a list first", f"view {view}")
                expect("Esc cancel" not in screen.bar and "* fast" not in screen.title, "a hidden field was opened", screen)
            expect_equal(place.text("fast.yaml"), play.FAST, f"the file, edited in the picture of view {view}")


if __name__ == "__main__":
    run_all(__name__)
