#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Small screens, from 60 to 79 columns and from 16 to 23 lines: cut text has a mark, and words stay separate."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import ROOT, Place  # noqa: E402
from harness import expect, run_all  # noqa: E402

SIZES = ([(width, 16 + (width - 60) % 8) for width in range(60, 80)] + [(60, height) for height in range(16, 24)] +
         [(79, height) for height in range(16, 24)])
WORD = re.compile(r"[^\W\d_²³]+")
SIGNS = "…~"


def find_words(sources):
    return {word.lower() for text in sources for word in WORD.findall(text)}


def vocabulary():
    """Return the words of the program's texts, of its files, and of their names."""
    strings = [re.sub(r"\\x[0-9a-f]{2}|\\n|%[-+.*0-9]*(?:ll|z)?[a-z]", " ", string) for path in ROOT.glob("src/**/*.[ch]")
               for string in re.findall(r'"((?:[^"\\]|\\.)*)"', path.read_text())]
    files = [f"{path.stem} {path.read_text()}" for path in ROOT.glob("profiles/**/*.yaml")]
    return find_words(strings + files)


def foreign(screen, known):
    """Return unknown words of a screen: cut without a mark, or joined to a neighbour."""
    return [(word.group(), line) for line in screen.whole().lines for word in WORD.finditer(line)
            if len(word.group()) > 1 and word.group().lower() not in known
            and line[word.end():word.end() + 1] not in tuple(SIGNS) and line[word.start() - 1:word.start()] not in tuple(SIGNS)]


def check(scene, keys):
    known = vocabulary()
    with Place() as place:
        known |= find_words([place.text(name) for name in ("cuts.yaml", "fast.yaml")] + ["cuts fast wood options play yaml txt"])
        script = "".join(f"{key}\n" + "".join(f"resize {width} {height}\nkey Ctrl-L\ndump\n" for width, height in SIZES) for key in keys)
        screens = place.play("wait idle\n" + script, scene)
    expect(len(screens) == len(keys) * len(SIZES), len(screens))
    for i, screen in enumerate(screens):
        found = foreign(screen, known)
        expect(not found, f"after {keys[i // len(SIZES)]!r}: {found}", screen)


def test_views():
    """Every view and each of its panes."""
    views = ["key 1", "key Tab", "key Tab", "key 2", "key 3", "key 4", "key 5\nwait idle", "key Tab", "key Tab", "key 6\nwait idle",
             "key Tab", "key 7\nwait idle", "key 8", "key Tab"]
    check("paper-site", views)
    check("cuts.yaml", views)


def test_typed():
    """An open field, and each popup: help, lists, and fields that do not all fit."""
    field = "key Esc Esc Esc Esc Esc Esc Esc Esc 2 /\nkey Ctrl-U\ntype stools.per_ha\nkey Enter\n"
    popups = ["?", "p", "n", "n Enter Enter Enter Enter Enter", "o", "w", "f", "c", "c Down Down Down Down Down Down Down", "/", "S",
              ":", "8 a 1", "Enter"]
    check("paper-site", [f"{field}key {keys}" for keys in popups])


if __name__ == "__main__":
    run_all(__name__)
