#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The cursor along the slope: movement, figures, edits at its place, zoom."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import play  # noqa: E402, F401 (finds the harness)
from harness import expect, expect_equal, expect_in, run_all  # noqa: E402
from test_editing import table  # noqa: E402
from test_ground import BELTS, GROUNDS, LAND, ONE_GROUND, land, points, stretches  # noqa: E402

AT = re.compile(r"^([\d.]+) m: (-?\d+)° steep, (.*?)(?:; underside p95 ([\d.]+) m, mean energy ([\d.]+) kJ)?$")


def place(screen):
    found = AT.match(screen.note)
    expect(found, screen.note)
    return float(found.group(1)), int(found.group(2)), found.group(3)


def test_goes_along():
    """Tab activates it, left and right move it to round metres, up and down to the next point, border or control."""
    keys = ("Tab", "Right", "Left", "Down", "Down", "Down", "Down", "Up", "Up", "Up", "Up", "Up", "Up", "Up")
    screens = land("wait idle\nkey Tab\n" + "".join(f"key {k}\ndump\n" for k in keys))
    # 50 m in 60 m: 39.8 degrees; 30 m in 40 m: 36.9 degrees
    expected = [(50, 40, "large-reserves"), (52, 40, "large-reserves"), (50, 40, "large-reserves"), (60, 37, "large-reserves"),
                (80, 37, "large-reserves"), (90, 37, "no forest"), (100, 37, "no forest"), (90, 37, "no forest"),
                (80, 37, "large-reserves"), (60, 37, "large-reserves"), (45, 40, "simple-coppice"), (10, 40, "simple-coppice"),
                (0, 40, "no forest"), (0, 40, "no forest")]
    named = {"large-reserves": "large reserves", "simple-coppice": "simple coppice", "no forest": "no forest"}
    for key, screen, (x, steep, forest) in zip(keys, screens, expected):
        found = place(screen)
        expect_equal(found[:2], (x, steep), f"after {key}")
        expect(found[2].startswith(named[forest]), f"after {key} at {x} m: {found[2]}")


def test_tells_what_passes():
    """It shows the strips' values there: height and energy of passing rocks; nothing above the release."""
    below, above = land("wait idle\nkey Tab Tab\ndump\nkey Up Up Up\ndump", LAND.replace("rock:", "release: {x_m: 30}\nrock:"))
    expect(AT.match(below.note).group(4), below.note)
    height, energy = float(AT.match(below.note).group(4)), float(AT.match(below.note).group(5))
    # 0.8 m at 2700 kg/m3 weigh 724 kg; in 20 m of 39.8 degrees a rock falls 16.7 m: at most 118 kJ
    expect(0 < energy < 118 and 0 <= height < 16.7, below.note)
    expect_equal(place(above)[0], 10, "above the release")
    expect(not AT.match(above.note).group(4), above.note)


def chosen(text, where, what):
    return land(f"wait idle\nkey Tab Tab\nkey {where}\nkey Enter\ndump\ntype {what}\nkey Enter\ndump", text)


def test_puts_things_there():
    """Enter lists what stands there and what can be put: a border of the ground or the forest, a point, a control."""
    listed, screen = chosen(LAND, "Down", "new ground")
    for line in ("edit the belt here: large reserves", "edit the ground here: number 1", "new point", "new control",
                 "edit the nearest point of the profile: number 2, at 60 m"):
        expect_in(line, listed.popup, "what is listed")
    expect_equal(stretches(screen, GROUNDS), [(0, 60, "talus"), (60, 100, "talus")], "another ground from 60 m on")
    _, screen = chosen(LAND, "Right", "split the belt")
    expect_equal([s[:2] for s in stretches(screen, BELTS)], [(10, 45), (45, 52), (52, 80)], "a belt from 52 m on")
    _, screen = chosen(LAND, "Left", "new point")  # at 48 m: 80 - 48 * 50 / 60 = 40
    expect_equal(points(screen), [("0", "80"), ("48", "40"), ("60", "30"), ("100", "0")], "a point at 48 m, on the line")
    _, screen = chosen(LAND, "Down", "new control")
    expect_equal(sorted(row[1] for row in table(screen, "counted at, m name limit, kJ speed filmed, m/s")), ["60", "90"],
                 "a control at 60 m")
    _, screen = chosen(LAND.replace("controls: [{x_m: 90, accepted_kJ: 50}]", "controls_m: [90]"), "Down", "new control")
    expect(re.search(r"90 60|60 90", screen.body), "a control at 60 m among controls_m", screen)
    _, screen = chosen(ONE_GROUND, "Right", "new ground")  # the profile gets a point there
    expect_in(("52", "36.66666667"), points(screen), "a point at 52 m")


def test_leads_to_the_field():
    """An object there is edited at its place in the form."""
    _, screen = chosen(LAND, "Down", "edit the ground")
    expect(screen.note.startswith("from, m:"), screen.note)
    _, screen = chosen(LAND, "Down Down Down", "edit the control")  # at 90 m
    expect(screen.note.startswith("counted at, m:"), screen.note)
    _, screen = chosen(LAND, "Up", "edit the belt")  # at 45 m the first of two
    expect(screen.note.startswith("from, m: where the belt begins"), screen.note)


def read_axis(screen):
    """Return the metres at the ends of the picture's axis."""
    line = next(line for line in reversed(screen.body.split("\n")) if re.fullmatch(r" *\d[\d m.]*", line) and " m" in line)
    numbers = [float(n) for n in re.findall(r"[\d.]+", line)]
    return numbers[0], numbers[-1]


def test_zoom():
    """z zooms in around the cursor by a factor 2, at true scale; Z shows the whole."""
    whole, *nearer, back, end = land("wait idle\nkey Tab Tab Down\ndump\n" + "key z\ndump\n" * 3 + "key Z Z Z\ndump\nkey Z\ndump")
    widths = []
    for screen, half in zip((whole, *nearer), (60, 25, 12.5, 6.25)):
        lo, hi = read_axis(screen)
        expect(60 - half <= lo <= 60 <= hi <= 60 + half or screen is whole, f"{lo} to {hi} m", screen)
        widths.append(hi - lo)
        expect("heights drawn" not in screen.body, "true to scale", screen)
    expect(all(b < 0.7 * a for a, b in zip(widths, widths[1:])), widths)
    expect_equal(read_axis(back), read_axis(whole), "after Z three times")
    expect_equal(end.note, "this is the whole slope", "once more")
    last = land("wait idle\n" + "key z\n" * 8 + "dump")[0]
    expect_equal(last.note, "maximum zoom", "z eight times")


if __name__ == "__main__":
    run_all(__name__)
