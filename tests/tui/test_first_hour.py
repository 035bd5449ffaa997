#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Number of keys from nothing to a verdict: each typed letter is one."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import check_good, play  # noqa: E402
from harness import Folder, expect, expect_equal, expect_in, run_all  # noqa: E402
from test_editing import table  # noqa: E402
from test_screens import lights  # noqa: E402


def keys_in(script):
    """Return the keys pressed by hand: named ones, and each typed letter."""
    n = 0
    for line in script.strip().split("\n"):
        word, _, rest = line.strip().partition(" ")
        n += len(rest.split()) if word == "key" else len(rest) if word == "type" else 0
    return n


def verdict(screen):
    found = lights(screen, "braille")
    expect_equal(set(found), {"Contact", "Free run", "Energy"}, "lights")
    expect(all(word in ("passes", "FAILS") for word in found.values()), "a verdict", screen)


def test_two_minutes():
    """With the defaults, a user's scene and its verdict take at most 12 keys."""
    script = "key n " + "Enter " * 9
    expect(keys_in(script) <= 12, keys_in(script))
    with Folder() as f:
        screen = play(f.path, script + "\nwait idle\ndump")[0]
    expect_in("* My slope", screen.title)
    verdict(screen)


# A face, the user's profile, a stand from a sample plot, a verdict over the rotation.
PLOT = """key Enter Enter
    type 12
    key Enter
    type 40
    key Enter
    type 7,5
    key Enter
    type 8
    key Enter
    type 2
    key Enter Enter Enter
    key 6"""
BY_POINTS = """key n Enter
    type 0 60;40 30;99 0
    key Enter Enter
    type 15
    key Enter Enter
    type ,8
    key Enter Enter Enter
    type sam
    key Enter
    """ + PLOT
BY_FILE = BY_POINTS.replace("type 0 60;40 30;99 0", "type line")


def test_sixty_keys():
    """A face, a profile, a stand from a sample plot and a verdict over the rotation take under 60 keys."""
    for script in (BY_POINTS, BY_FILE):
        expect(keys_in(script) < 60, f"{keys_in(script)} keys")
        with Folder() as f:
            f.write("line.csv", "Distanz;Quota\n0;60,0\n40;30,0\n99;0,0\n")
            years, slope, stand = play(f.path, script + """
                wait idle
                dump
                key 1
                resize 200 70
                dump
                key 2
                dump
                key s Ctrl-U
                type mine.yaml
                key Enter""")
            check_good(f.path, "mine.yaml")
        verdict(years)
        expect(re.search(r"\bcut\b", years.body) and "years" in years.body, "the rotation", years)
        grounds = [[word.rstrip("*") for word in row[1:4]] for row in table(slope, "from, m to, m ground")]
        expect_equal(grounds, [["0", "15", "cliff"], ["15", "99", "talus"]], "grounds")
        expect_equal(table(slope, "from, m to, m stand")[0][1:3], ["15", "99"], "the belt, below the face")
        expect(re.search(r"Rock 0\.8 m", slope.now), slope.now)
        stools = float(stand.row("^stools per ha")[3])
        # The slope falls 18.75 m over the 25 m below the face down to 40 m, and 30 m over 59 m: 48.75 m over 84 m, 30 degrees.
        expect(abs(stools - 12 * 10000 / (400 * 0.8660254)) < 0.01, stools)
        stand.has("3.333 shoots per stool")  # 40 shoots on 12 stools


# Answers of the tour (test_tour.py) that need or write a file, which the tour does not.
FILES = (
    ("my own slope", "key n Enter\ntype line\nkey " + "Enter " * 8, "body", r"1 +15 +99 "),
    ("a report, as HTML", "wait idle\nkey w\ntype report\nkey " + "Enter " * 8, "note", r"written: ceduo\.html"),
)


def test_files():
    """A slope from a CSV file, and a report, take at most 25 keys"""
    for asked, script, where, answer in FILES:
        expect(keys_in(script) <= 25, f"{asked}: {keys_in(script)} keys")
        with Folder() as f:
            f.write("line.csv", "distance,elevation\n0,60\n15,30\n99,0\n")
            screen = play(f.path, f"{script}\nwait idle\ndump")[0].whole()
            expect(re.search(answer, " ".join(getattr(screen, where).split())), f"{asked}:", screen)
            expect(asked != "a report, as HTML" or "</html>" in (f.path / "ceduo.html").read_text(encoding="utf-8"), "the page")


if __name__ == "__main__":
    run_all(__name__)
