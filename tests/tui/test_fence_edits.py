#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A fence in the terminal program: its form, and figures that follow each edit without a new simulation."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import Place, check_good  # noqa: E402
from harness import expect, expect_equal, expect_in, run_all  # noqa: E402


# The fall over an edge of tests/physics/test_fence.c, through single trees.
FALL = """\
ceduo: scene/1
title: fall
rock: {mass_kg: 1000, density_kg_m3: 2600}
release: {vx_m_s: {mean: 10, spread: 2, kind: uniform}}
slope: {vertices_m: [[0, 8], [0.01, 0], [30, 0]], segments: [{rn: 0.3, rt: 0.8}]}
controls: [{x_m: 10, name: road}]
options:
  - {name: few, forest: [{from_m: 1, to_m: 9, stand: {trees: [{per_ha: 100, dbh_m: 0.2, height_m: 12}]}}]}
  - {name: more, forest: [{from_m: 1, to_m: 9, stand: {trees: [{per_ha: 300, dbh_m: 0.2, height_m: 12}]}}]}
simulation: {law: lumped}
"""


def test_return_period():
    """An edit of the accepted return period changes the judgement of today at once, as the page has it"""
    with Place() as place:
        rare, often = place.play("resize 110 40\nwait idle\nfind controls[0].accepted_return_y\nset 5000\nwait idle\ndump\nset 1\n"
                                 "wait idle\ndump", "blocks-above-the-road")
    expect(rare.lines[1].startswith(" ✘ NO: more than 50 kJ every"), rare.lines[1])
    expect(often.lines[1].startswith(" ✔ YES, also without forest"), often.lines[1])


def beaten(screen):
    """Return the rocks of 1000 that defeat the fence, with forest and without; None without a fence."""
    row = re.search(r"fence beaten +(\d+)\S*(?: \([^)]*\))? +(\d+)", screen.text)
    return row and (int(row[1]), int(row[2]))


def test_edits():
    """The first value of a fence assumes the other one; the figures follow energy and height, also those of the years"""
    with Place() as place:
        place.write("fall.yaml", FALL)
        none, one, strong, low, back, options = place.play("""resize 120 50
            key 1
            wait idle
            dump
            find controls[0].fence.energy_kJ
            set 40
            wait idle
            dump
            set 1000
            wait idle
            dump
            find controls[0].fence.height_m
            set 1
            wait idle
            dump
            key u
            wait idle
            dump
            key s
            key 5
            wait idle
            dump""", "fall.yaml")
        expect_equal(beaten(none), None, none)
        expect_in("assumed height of the fence: 4 m", one.text)
        expect(beaten(one)[1] > beaten(strong)[1], beaten(one), beaten(strong))
        expect(beaten(low)[1] > beaten(strong)[1], beaten(low), beaten(strong))
        expect_equal(beaten(back), beaten(strong), "after u")
        expect(re.search(r" fence ", options.text), "no column", options)
        expect_in("energy_kJ: 1000", place.text("fall.yaml"))
        check_good(place.path, "fall.yaml")


if __name__ == "__main__":
    run_all(__name__)
