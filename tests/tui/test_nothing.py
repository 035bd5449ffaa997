#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A new scene from a profile drawn upward, starting above the edge, or with a face; and a scene without an answer."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import Folder, check_good, expect, play
from harness import expect_equal, expect_in, result, run_all

# it begins 4 m above the edge of a cliff
LINE = [(0, 141.4), (4, 140), (14, 105), (40, 88), (100, 50), (160, 15)]
# like a terrain model: points each 5 m, the edge between two of them
FINE = [(x, 200 - 0.2 * x if x <= 30 else 194 - 2 * (x - 30) if x <= 45 else 164 - 0.55 * (x - 45)) for x in range(0, 301, 5)]


def csv(points):
    return "distance,elevation\n" + "".join(f"{x:g},{z:g}\n" for x, z in points)


def upward(points):
    return [(points[-1][0] - x, z) for x, z in reversed(points)]


NEW = """key n Enter Ctrl-U
    type line.csv
    key Enter
    dump
    key Enter Enter Enter Enter Enter Enter Enter
    wait idle
    dump
    key s Ctrl-U
    type mine.yaml
    key Enter
    dump"""


def new_scene(folder, points, size="80 24"):
    folder.write("line.csv", csv(points))
    asked, made, saved = play(folder.path, f"resize {size}\n" + NEW)
    saved.has("saved mine.yaml")
    check_good(folder.path, "mine.yaml")
    return asked, made, result(folder.path / "mine.yaml")


def test_new_from_profiles():
    """n guesses the edge, marks the face, reverses an upward profile and previews it; the verdict has moving rocks"""
    figures = []
    for points, release, face, words in (
            (LINE, "4", "14", "line.csv: 6 points, 160 m long, falls 126.4 m; columns distance, elevation. Steepest at 4 m, 74"),
            (upward(LINE), "4", "14", "Reversed. Rocks start at 4 m, on 74"),
            (FINE, "30", "45", "Steepest at 30 m, 63"),
            (LINE[3:], "40", "", "Rocks start at 40 m, on 32")):
        for size in ("80 24", "200 50"):
            with Folder() as f:
                asked, made, run = new_scene(f, points, size)
                asked.has(f"rocks start at x, m {release}_")
                shown = asked.popup.split("face from the top to x, m")[1].split("\n")[0].split()
                expect(shown[:1] == [face] if face else not shown[:1] or not shown[0][0].isdigit(), "the face", asked)
                if size == "80 24": # on a wider screen the view continues next to the popup
                    expect_in(words, " ".join(asked.popup.split()))
                asked.has("release")
                expect(any(0x2800 < ord(c) < 0x2900 for c in asked.text.split("│ stand ")[1]), "no picture", asked)
                control = run["options"][0]["controls"][0]
                expect(control["bare"]["rocks_reached"] > 500, control["bare"]["rocks_reached"])
                expect(control["verdict"]["answer"] in ("yes", "no", "not-decided"), control["verdict"])
                made.lacks("CANNOT BE ASSESSED")
                figures.append(control)
    expect_equal(figures[2], figures[0], "drawn upward and downward")


def test_guess_stays():
    """A typed release stays when the same profile is read again, and is guessed again for another profile"""
    with Folder() as f:
        f.write("line.csv", csv(LINE))
        stayed, anew = play(f.path, """key n Enter Ctrl-U
            type line.csv
            key Enter Ctrl-U
            type 30
            key Enter Esc Esc Enter
            dump
            key Esc Ctrl-U
            type 0 90, 40 80, 50 30, 120 0
            key Enter
            dump""")
        stayed.has("rocks start at x, m 30_")
        anew.has("rocks start at x, m 40_", "face from the top to x, m 50")


def test_nothing():
    """If no rock arrives without forest no light is on and no option is best, in each view; moving the release helps"""
    with Folder() as f:
        f.write("line.csv", csv(LINE))
        f.write("s.yaml", """ceduo: scene/1
rock: {diameter_m: 0.68}
slope: {csv: line.csv}
controls: [{x_m: 120, name: road, accepted_kJ: 50}]
options:
  - {name: one, forest: [{from_m: 20, to_m: 110, stand: simple-coppice}]}
  - {name: two, forest: [{from_m: 20, to_m: 110, stand: large-reserves}]}
""")
        slope, compare, years, mended = play(f.path, """resize 120 40
            wait idle
            dump
            key 5
            dump
            key 6
            wait idle
            dump
            key 3
            find release.x_m
            set 4
            wait idle
            key 1
            dump""", f.path / "s.yaml")
        slope.has("CANNOT BE ASSESSED")
        expect_in("release.x_m: 4", " ".join(slope.now.split()))
        for screen in (slope, compare, years):
            for mark in ("\u2714", "\u2718"):
                expect(mark not in screen.text, mark, screen)
        expect_in("The forest cannot be assessed: no rock arrives", " ".join(compare.body.split()))
        expect_in("The forest cannot be assessed: no rock arrives", " ".join(years.body.split()))
        expect("best" not in compare.body, "an option is best", compare)
        mended.lacks("CANNOT BE ASSESSED")
        expect("\u2718" in mended.now or "\u2714" in mended.now, mended.now)


def test_cursor_on_a_reversed_profile():
    """The cursor of view 1 edits the ground and point below it, also in a reversed file"""
    with Folder() as f:
        f.write("s.yaml", """ceduo: scene/1
rock: {diameter_m: 0.68}
slope:
  reversed: true
  vertices_m: [[0, 15], [60, 50], [120, 88], [146, 105], [156, 140], [160, 141.4]]
  materials:
    - {from_m: 0, to_m: 100, material: talus}
    - {from_m: 100, to_m: 160, material: cliff}
release: {x_m: 4}
controls: [{x_m: 120}]
""")
        here, split = play(f.path, """resize 120 40
            wait idle
            key Tab Tab Down Enter
            dump
            key Esc Right Enter
            type new point
            key Enter
            wait idle
            key s
            dump""", f.path / "s.yaml")
        # From the middle, 80 m, down to the next point of the slope: 100 m; in the file it is at 60 m, the second.
        here.has("number 2, at 100 m", "edit the ground here: number 1")
        text = (f.path / "s.yaml").read_text()
        split.has("saved")
        points = [tuple(float(v) for v in pair) for pair in re.findall(r"\[([\d.]+), ([\d.]+)\]", text)]
        expect_equal(len(points), 7, text)
        x, z = points[1] # a little below 100 m of the slope is a little below 60 m of the file
        expect(50 < x < 60 and abs(z - (15 + x * 35 / 60)) < 1e-6, points)


if __name__ == "__main__":
    run_all(__name__)
