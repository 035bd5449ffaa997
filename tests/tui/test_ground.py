#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Grounds, belts and the profile's points on the screen: a and y split, neighbours follow, without overlaps or gaps; and stools
that keep their shoots."""
import random
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import FAST, Place, check_good  # noqa: E402
from harness import expect, expect_equal, expect_in, expect_near, run_all  # noqa: E402
from test_editing import table  # noqa: E402

# adjacent belts, grounds of the library, one profile
LAND = """\
ceduo: scene/1
title: land
rock: {diameter_m: 0.8}
slope:
  vertices_m: [[0, 80], [60, 30], [100, 0]]
  materials: [{from_m: 0, to_m: 100, material: talus}]
controls: [{x_m: 90, accepted_kJ: 50}]
forest:
  - {from_m: 10, to_m: 45, stand: simple-coppice}
  - {from_m: 45, to_m: 80, stand: large-reserves}
simulation: {contact_model: index}
"""
ONE_GROUND = LAND.replace("  materials: [{from_m: 0, to_m: 100, material: talus}]\n", "  segments: [{rn: 0.3, rt: 0.8}]\n")
CSV = LAND.replace("  vertices_m: [[0, 80], [60, 30], [100, 0]]\n  materials: [{from_m: 0, to_m: 100, material: talus}]\n",
                   "  csv: line.csv\n")
BELTS, GROUNDS = "from, m to, m stand", "from, m to, m ground"


def land(script, text=LAND):
    with Place() as place:
        place.write("line.csv", "distance,elevation\n0,80\n60,30\n100,0\n")
        place.write("land.yaml", text)
        return place.play("resize 200 70\n" + script, "land.yaml")


def points(screen):
    return re.findall(r"(?:^| )\d +(\S+) (\S+)$", screen.body.split("Profile: points")[1], re.M)


def stretches(screen, head):
    plain = ([word.rstrip("*") for word in row] for row in table(screen, head))  # a star marks assumed values
    return [(float(r[1]), float(r[2]), " ".join(r[3:])) for r in plain]


def test_split_ground():
    """a and y split a ground; d gives its stretch to the neighbour; a face at the top takes few keys."""
    for key in "ay":
        split, first_gone, back, last_gone = land(f"find materials[0]\nkey {key}\ndump\nkey Up d\ndump\nkey u Down\ndump\nkey d\ndump")
        expect_equal(stretches(split, GROUNDS), [(0, 50, "talus"), (50, 100, "talus")], f"after {key}")
        expect_equal(stretches(first_gone, GROUNDS), [(0, 100, "talus")], "after d on the first")
        expect_equal(len(table(back, GROUNDS)), 2, "after u")
        expect_equal(stretches(last_gone, GROUNDS), [(0, 100, "talus")], "after d on the last")
    with Place() as place:
        place.write("land.yaml", LAND)
        face = place.play("resize 200 70\nfind materials[0]\nkey a Enter\ntype 15\nkey Enter Up Right Right Enter\ntype cl\n"
                          "dump\nkey Enter\nwait idle\ndump\nkey s", "land.yaml")
        expect(re.search(r"Rn 0\.35, Rt 0\.85.*Contact \w+", face[0].popup), "what the ground is and does", face[0])
        expect_equal(stretches(face[1], GROUNDS), [(0, 15, "cliff"), (15, 100, "talus")], "a face")
        check_good(place.path, "land.yaml")


def test_ground_of_csv():
    """If a file gives no ground, a names the assumed one, which can then be split."""
    none, named, split = land("find materials\nfind facets\nkey Down\ndump\nkey a\ndump\nkey a\ndump", CSV)
    none.has("talus is assumed everywhere", "none; a adds one")
    expect_equal(stretches(named, GROUNDS), [(0, 100, "talus")], "named")
    expect_equal(stretches(split, GROUNDS), [(0, 50, "talus"), (50, 100, "talus")], "split")


def test_one_ground_apart():
    """One ground for all segments becomes one per split segment; a point of the profile keeps it."""
    split, point = land("find segments[0]\nkey a\ndump\nkey u\nfind vertices_m[0]\nkey a\ndump", ONE_GROUND)
    expect_equal(len(points(split)), 4, "points after a on the ground")
    expect_equal([r[1].rstrip("*") for r in table(split, "bounce Rn slide Rt")], ["0.3"] * 3, "grounds")
    expect_equal(points(point), [("0", "80"), ("30", "55"), ("60", "30"), ("100", "0")], "a point in the middle")
    expect_equal(len(table(point, "bounce Rn slide Rt")), 1, "still one ground")


def test_points():
    """a and y insert a point between this one and the next, also before the last one; d deletes one, with its ground."""
    for key in "ay":
        first, last, gone = land(f"find vertices_m[0]\nkey {key}\ndump\nkey u\nfind vertices_m[2]\nkey {key}\ndump\nkey u\n"
                                 "find vertices_m[1]\nkey d\ndump")
        expect_equal(points(first), [("0", "80"), ("30", "55"), ("60", "30"), ("100", "0")], f"{key} on the first")
        expect_equal(points(last), [("0", "80"), ("60", "30"), ("80", "15"), ("100", "0")], f"{key} on the last")
        expect_equal(points(gone), [("0", "80"), ("100", "0")], "after d")
    with Place() as place:
        screens = place.play("resize 200 70\nfind vertices_m[1]\nkey a\ndump\nkey d\ndump", "fast.yaml")
    rn = [[r[1] for r in table(s, "bounce Rn slide Rt")] for s in screens]
    expect_equal(rn, [["0.3", "0.25", "0.25"], ["0.3", "0.25"]], "grounds of their segments")


def test_split_belt():
    """a and y on a belt split it; at its end a fills the stretch after it; without belts a plants the slope; at most to the
    next control."""
    for key in "ay":
        split = land(f"find forest[1]\nkey {key}\ndump")[0]
        expect_equal(stretches(split, BELTS)[1:], [(45, 62.5, "large reserves"), (62.5, 80, "large reserves")], key)
    behind, again = land("find forest[1]\nkey Right a\ndump\nkey a\ndump")
    expect_equal(stretches(behind, BELTS)[2], (80, 90, "large reserves"), "behind the last, to the control, as its neighbour")
    expect_in("c enters a sample plot", behind.note)
    expect_equal(len(table(again, BELTS)), 4, "no room behind: split")
    none, all_ = land("find forest\nkey d d\ndump\nkey a\ndump")
    none.has("none; a adds one")
    expect_equal(stretches(all_, BELTS)[0][:2], (0, 90), "from the release to the control")


def test_new_belt():
    """A new belt ends at the next control, at the next belt or at the end of the slope, and copies its neighbour's stand."""
    text = LAND.replace("controls: [{x_m: 90, accepted_kJ: 50}]", "controls: [{x_m: 55, name: path}, {x_m: 90, accepted_kJ: 50}]")
    gap = text.replace("{from_m: 45, to_m: 80", "{from_m: 50, to_m: 52")
    for scene, to in ((gap, 50), (gap.replace("  - {from_m: 50, to_m: 52, stand: large-reserves}\n", ""), 55)):
        belts = stretches(land("find forest[0]\nkey Right a\ndump", scene)[0], BELTS)
        expect_equal(belts[1], (45, to, "simple coppice, 25 years"), "behind the first belt")
    last = LAND.replace("from_m: 45, to_m: 80", "from_m: 45, to_m: 90")
    expect_equal(stretches(land("find forest[1]\nkey Right a\ndump", last)[0], BELTS)[2], (90, 100, "large reserves"), "the end")
    belts = stretches(land("find forest\nkey d d a\ndump", text)[0], BELTS)
    expect_equal(belts[0][:2], (0, 55), "without belts from the release to the first control")


def test_belt_under_the_cursor():
    """p and c in view 1 affect the belt under the cursor, in the form or along the slope, whatever view 2 showed last."""
    listed = land("key 2\nfind forest[1]\nkey 1\nfind forest[0]\nkey p\ndump")[0]
    expect_in("Stand of belt 1, now 'simple coppice, 25 years'", listed.text)
    for keys, belt in (("find forest[0]\nkey p", 0), ("find forest[1]\nkey p", 1), ("find forest[0]\nkey a p", 1),
                       ("find forest[1]\nkey Right a p", 2), ("key Tab Tab Left p", 1),
                       ("key Tab Tab Up Left p", 0)):
        after = land(f"key 1\n{keys}\ntype bare\nkey Enter\ndump\nkey Tab Tab\nfind forest[0]\ndump")[-1]
        stands = [s[2] for s in stretches(after, BELTS)]
        expect_equal([i for i, name in enumerate(stands) if name == "bare"], [belt], f"{keys}: the bare belt among {stands}")
    counted = land("key 2\nfind forest[1]\nkey 1\nfind forest[0]\nkey c\ndump")[0]
    expect_in("Species, growth and cutting of simple coppice, 25 years are kept", counted.popup)


def test_neighbours_follow():
    """Moving a border moves the neighbour's, with a message; u undoes both."""
    moved, over, back = land("find forest[0].to_m\nset 50\ndump\nkey Down Left\nset 30\ndump\nkey u u\ndump")
    expect_equal([s[:2] for s in stretches(moved, BELTS)], [(10, 50), (50, 80)], "to_m")
    expect_in("the next item now begins at 50 m", moved.note)
    expect_equal([s[:2] for s in stretches(over, BELTS)], [(10, 30), (30, 80)], "from_m")
    expect_equal([s[:2] for s in stretches(back, BELTS)], [(10, 45), (45, 80)], "after u u")
    gap, into = land("find forest[1]\nset 60\ndump\nkey u\nfind forest[0]\nkey Right\nset 40\ndump",
                     LAND.replace("from_m: 45, to_m: 80", "from_m: 55, to_m: 80"))
    expect_equal([s[:2] for s in stretches(gap, BELTS)], [(10, 45), (60, 80)], "over a gap nothing follows")
    expect_equal([s[:2] for s in stretches(into, BELTS)], [(10, 40), (55, 80)], "over a gap nothing follows")
    into = land("find forest[0]\nkey Right\nset 60\ndump", LAND.replace("from_m: 45, to_m: 80", "from_m: 55, to_m: 80"))[0]
    expect_equal([s[:2] for s in stretches(into, BELTS)], [(10, 60), (60, 80)], "over the gap and into the next: it gives way")
    refused = land("wait idle\nfind forest[0]\nkey Right\nset 85\ndump")[0]
    expect_in("Esc cancel", refused.bar, "a belt is not swallowed")
    expect_in("the next item ends at 80 m; delete it first", refused.note)
    longer = land("find vertices_m[2]\nset 120 0\ndump\nset 110,5 -5\ndump")
    expect_equal(stretches(longer[0], GROUNDS), [(0, 120, "talus")], "the ground goes with the profile")
    expect_equal(stretches(longer[1], GROUNDS), [(0, 110.5, "talus")], "and back")


def test_any_border():
    """After moving any border grounds have no gap and nothing overlaps."""
    draw = random.Random(5)
    script = "find materials[0]\nkey a a a\n"
    for _ in range(40):
        if draw.random() < 0.5:
            script += f"find materials[{draw.randrange(4)}]\n" + "key Right\n" * draw.randrange(2)
        else:
            script += f"find forest[{draw.randrange(2)}].from_m\n" + "key Right\n" * draw.randrange(2)
        script += f"set {draw.randrange(0, 1001) / 10}\nkey Esc\ndump\n"
    for screen in land(script):
        grounds, belts = stretches(screen, GROUNDS), stretches(screen, BELTS)
        for rows, touch in ((grounds, True), (belts, False)):
            for a, b in zip(rows, rows[1:]):
                expect(a[0] < a[1] <= b[0] < b[1] and (not touch or a[1] == b[0]), "a gap or an overlap:", rows)
        expect_equal((grounds[0][0], grounds[-1][1]), (0, 100), "the ground is that of the whole profile")


def test_from_the_end():
    """A place typed from the end of the profile, as in files: borders follow, steps and halves count from there, other words
    are refused, and the file keeps it as typed"""
    with Place() as place:
        place.write("land.yaml", LAND.replace("controls: [{x_m: 90, accepted_kJ: 50}]", "controls_m: [85, 90]"))
        typed, stepped, split, ground, refused, controls, rock = place.play("""resize 200 70
            find forest[0].to_m
            set End - 50,5
            dump
            key +
            dump
            key a
            dump
            find materials[0].to_m
            set end
            key y
            dump
            find forest[1]
            set end+5
            dump
            key Esc
            find controls_m
            set 85 end-8,5
            dump
            key 3
            find release.x_m
            set end-98
            dump
            key s""", "land.yaml")
        text = place.text("land.yaml")
        check_good(place.path, "land.yaml")
    expect_equal([r[1:3] for r in table(typed, BELTS)], [["10", "end-50.5"], ["end-50.5", "80"]], "typed")
    expect_equal([r[1:3] for r in table(stepped, BELTS)], [["10", "end-49.5"], ["end-49.5", "80"]], "a metre nearer the end")
    # from 10 to 50.5 m
    expect_equal([r[1:3] for r in table(split, BELTS)], [["10", "30.25"], ["30.25", "end-49.5"], ["end-49.5", "80"]], "halves")
    expect_equal([[x.rstrip("*") for x in r[1:3]] for r in table(ground, GROUNDS)], [["0", "50"], ["50", "end"]], "the ground's halves")
    expect_in("write end, or end-10 for 10 m before the end", refused.note, "refused")
    controls.has("85 end-8.5")
    expect_equal(rock.row("^x, m")[2], "end-98", "the release")
    for line in ("to_m: end-49.5", "controls_m: [85, end-8.5]", "x_m: end-98"):
        expect_in(line, text, "the file")


if __name__ == "__main__":
    run_all(__name__)
