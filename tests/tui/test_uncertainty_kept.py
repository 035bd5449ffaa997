#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Uncertainty rows follow their values through edits, and never refuse one."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import FAST, WOOD, Place, check_good  # noqa: E402
from harness import expect_equal, expect_in, run_all  # noqa: E402

UNCERTAIN = FAST + """\
uncertainty:
  - {path: "forest[*].stand.energy.u_J_m3", lo: 80000, hi: 120000}
  - {path: "forest[0].stand.stools.per_ha", lo: 2700, hi: 3300}
  - {path: "forest[0].stand.trees[1].dbh_m", lo: 0.3, hi: 0.4}
  - {path: "forest[1].stand.stools.per_ha", lo: 900, hi: 1100}
  - {path: "rock.density_kg_m3", lo: 2500, hi: 2700}
"""


def paths_after(keys):
    with Place() as place:
        place.write("uncertain.yaml", UNCERTAIN)
        place.play(f"{keys}\nkey s\ndump", "uncertain.yaml")
        check_good(place.path, "uncertain.yaml")
        saved = place.text("uncertain.yaml")
        return re.findall(r'path: "?([^",\n]+)"?', saved.split("uncertainty:")[1]) if "uncertainty:" in saved else []


ALL, STOOLS, TREE, LOWER, ROCK = re.findall(r'path: "([^"]+)"', UNCERTAIN)


def test_items_that_go():
    """Deleting a belt or a class of trees deletes its rows; later items keep theirs, at their new places."""
    expect_equal(paths_after(""), [ALL, STOOLS, TREE, LOWER, ROCK], "nothing done")
    expect_equal(paths_after("find forest[1]\nkey d"), [ALL, STOOLS, TREE, ROCK], "the lower belt deleted")
    expect_equal(paths_after("find forest[0]\nkey d"), [ALL, LOWER.replace("[1]", "[0]"), ROCK], "the upper belt deleted")
    expect_equal(paths_after("key 2\nfind trees[0]\nkey d"), [ALL, STOOLS, TREE.replace("trees[1]", "trees[0]"), LOWER, ROCK],
                 "the first class of trees deleted")
    expect_equal(paths_after("key 2\nfind trees[0]\nkey d d"), [ALL, STOOLS, LOWER, ROCK], "all trees deleted")


def both(path):
    return f"{path} {path.replace('forest[0]', 'forest[1]')}"


def test_items_that_come():
    """Splitting a belt: its rows count for both parts, as one input; rows of later belts follow."""
    expect_equal(paths_after("find forest[0]\nkey y"),
                 [ALL, both(STOOLS), both(TREE), LOWER.replace("forest[1]", "forest[2]"), ROCK], "the upper belt split")
    expect_equal(paths_after("find forest[1]\nkey y"),
                 [ALL, STOOLS, TREE, f"{LOWER} {LOWER.replace('forest[1]', 'forest[2]')}", ROCK], "the lower belt split")
    expect_equal(paths_after("find forest[0]\nkey y\nfind forest[1]\nkey d"), [ALL, STOOLS, TREE, LOWER, ROCK], "and deleted again")
    expect_equal(paths_after("find forest[0]\nkey y u"), [ALL, STOOLS, TREE, LOWER, ROCK], "and undone")


def test_items_that_move():
    """< and > on a class of trees move its rows."""
    moved = [ALL, STOOLS, TREE.replace("trees[1]", "trees[0]"), LOWER, ROCK]
    expect_equal(paths_after("key 2\nfind trees[0]\nkey >"), moved, "the first class moved behind the second")
    expect_equal(paths_after("key 2\nfind trees[1]\nkey <"), moved, "the second class moved before the first")
    expect_equal(paths_after("key 2\nfind trees[1]\nkey < >"), [ALL, STOOLS, TREE, LOWER, ROCK], "and back")


OWN = """\
ceduo: stand/1
stools: {per_ha: 3000, spacing_m: 0.4}
shoots: [{per_ha: 7000, dbh_m: 0.06, height_m: 6}]
trees: [{per_ha: 60, dbh_m: 0.2, height_m: 12}, {per_ha: 30, dbh_m: 0.3, height_m: 15}]
uncertainty:
  - {path: stools.per_ha, lo: 2700, hi: 3300}
  - {path: "trees[1].dbh_m", lo: 0.25, hi: 0.35}
"""


def own_after(keys):
    """Return the rows of a stand in its own file, as saved in the scene; None: still the file's."""
    with Place() as place:
        place.write("own.yaml", OWN)
        place.write("scene.yaml", re.sub(r"(?s)forest:.*?(?=\n\w|\Z)", "forest: [{from_m: 10, to_m: 80, stand: own.yaml}]", FAST))
        place.play(f"{keys}\nkey s\ndump", "scene.yaml")
        check_good(place.path, "scene.yaml")
        saved = place.text("scene.yaml")
        return re.findall(r'path: "?([^",]+)"?,', saved.split("uncertainty:")[1]) if "uncertainty:" in saved else None


def test_rows_of_a_stand():
    """The rows of a stand follow its classes too, overriding those of its base file."""
    expect_equal(own_after(""), None, "nothing done")
    expect_equal(own_after("key 2\nfind trees[0]\nkey d"), ["stools.per_ha", "trees[0].dbh_m"], "the first class deleted")
    expect_equal(own_after("key 2\nfind trees[1]\nkey d"), ["stools.per_ha"], "the second class deleted")
    expect_equal(own_after("key 2\nfind trees[0]\nkey y"), ["stools.per_ha", "trees[2].dbh_m"], "the first class doubled")
    expect_equal(own_after("key 2\nfind trees[0]\nkey >"), ["stools.per_ha", "trees[0].dbh_m"], "the first class moved behind the second")


def test_options():
    """Rows about the forest refer to the option 'current' once there are options, in any order."""
    current = [p.replace("forest", "options[current].forest", 1) for p in (STOOLS, TREE, LOWER)]
    everywhere = ALL.replace("forest", "options[*].forest", 1)
    expect_equal(paths_after("key 5 a\ntype large-reserves\nkey Enter"), [everywhere, *current, ROCK], "an option added")
    expect_equal(paths_after("key 5 a\ntype large-reserves\nkey Enter\nkey g d"), [everywhere, *current, ROCK],
                 "the first one deleted: its rows name it, and no other")


def test_options_copied():
    """A copied or treated option has the rows of its original, as one input, which follow its moves, name and edits."""
    named = [p.replace("forest", "options[current].forest", 1) for p in (STOOLS, TREE, LOWER)]
    everywhere = ALL.replace("forest", "options[*].forest", 1)

    def rows(*options):
        return [everywhere, *(" ".join(path.replace("[current]", f"[{o}]", 1) for o in options) for path in named), ROCK]
    expect_equal(paths_after("key 5 y"), rows("current", 1), "copied")
    expect_equal(paths_after("key 5 a Enter Enter"), rows("current", 1), "treated")
    expect_equal(paths_after("key 5 y y"), rows("current", 1, 2), "copied twice")
    expect_equal(paths_after("key 5 y <"), rows("current", 0), "the copy moved up")
    expect_equal(paths_after("key 5 y d"), rows("current"), "the copy deleted")
    expect_equal(paths_after("key 5 y g d"), rows(0), "the original deleted")
    expect_equal(paths_after("key 5 y g Enter Ctrl-U\ntype now\nkey Enter"), rows(0, 1), "the original renamed")
    expect_equal(paths_after("key 5 y u"), [ALL, STOOLS, TREE, LOWER, ROCK], "undone")
    split = rows("current", 1)
    split[1:3] = [f"{path} {path.split()[1].replace('forest[0]', 'forest[1]')}" for path in split[1:3]]
    split[3] = LOWER.replace("forest", "options[current].forest") + " options[1]." + LOWER.replace("[1]", "[2]")
    expect_equal(paths_after("key 5 y 1\nfind forest[0]\nkey y"), split, "a belt of the copy split")
    changed = rows("current", 1)
    changed[1] = named[0]
    expect_equal(paths_after("key 5 y 2\nfind stools.per_ha\nset 2000"), changed, "another value in the copy")


def test_equal_options():
    """Copied options are equal in all plausible cases, in the saved file, too; a split belt has the same range."""
    with Place() as place:
        place.write("uncertain.yaml", WOOD + """uncertainty:
  - {path: "forest[0].stand.energy.u_J_m3", lo: 50000, hi: 200000}
  - {path: "forest[0].stand.stools.per_ha", lo: 1500, hi: 3000}
""")
        (plain,) = place.play("resize 120 40\nkey 7\nwait idle\ndump", "uncertain.yaml")
        (split,) = place.play("resize 120 40\nkey 1\nfind forest[0]\nkey y 7\nwait idle\ndump", "uncertain.yaml")
        copied, _ = place.play("resize 120 40\nkey 5 y 7\nwait idle\ndump\nkey s\ndump", "uncertain.yaml")
        (again,) = place.play("resize 120 40\nkey 7\nwait idle\ndump", "uncertain.yaml")
    band = re.compile(r"^current.* (\d+\u2013\d+)$", re.M)
    (only,), (parts,) = band.findall(plain.body), band.findall(split.body)
    expect_equal(parts, only, "the belt split")
    for screen in (copied, again):
        expect_equal(band.findall(screen.body), [only, only], "the options")
        expect_in("equal in 100 %", " ".join(screen.body.split()))


def test_stand_replaced():
    """Another stand is accepted for any rows of the old one; these stay for the next one."""
    expect_equal(paths_after("key 2\nkey p\ntype bare\nkey Enter"), [ALL, STOOLS, TREE, LOWER, ROCK], "a bare stand")


if __name__ == "__main__":
    run_all(__name__)
