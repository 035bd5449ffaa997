#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: manual
"""The manual ceduo-terminal(7) and the screen: the smallest window, the heads of columns, the keys."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import actions, fast  # noqa: E402
from harness import ROOT, expect, expect_equal, expect_in, run_all  # noqa: E402

PAGE = (ROOT / "man/ceduo-terminal.7").read_text()

# names of keys not in the table: they end a field or a list, or are signals of the terminal
OTHER_KEYS = {"Space", "Backspace", "Ctrl-U", "Ctrl-C", "Ctrl-Z"}


def render_word(text):
    """Return a word of mdoc as its reader sees it."""
    return text.replace("\\(S3", "³").replace("\\&", "").replace("\\-", "-").replace("\\~", " ")


def quoted(part):
    return [render_word(word) for word in re.findall(r"^\.Ql (.*?)(?: [.,;:])?$", part, re.M)]


def page_part(first, last):
    begin = PAGE.index(first)
    return PAGE[begin:PAGE.index(last, begin)]


def test_smallest_window():
    """The smallest window of the manual is the program's, and has the whole screen"""
    columns, lines = map(int, re.search(r"Below (\d+) columns or (\d+) lines", PAGE).groups())
    for width, height in ((columns - 1, lines), (columns, lines - 1)):
        (small,) = fast(f"resize {width} {height}\ndump")
        small.has(f"The window ({width} x {height}) is too small: at least {columns} x {lines} is needed")
    (whole,) = fast(f"resize {columns} {lines}\ndump")
    whole.lacks("is too small").has("1 slope", "q quit")


def test_heads():
    """Quoted texts of the manual are on the screen: heads of view 5, of the column on the right, its last line"""
    small, large, begun = fast("resize 80 24\nkey 5\nwait idle\ndump\nresize 160 50\ndump\nkey 3 +\ndump", "rotation")
    table = quoted(page_part(".It 5 compare", ".It 6 rotation"))
    expect_equal(table[:5], ["today", "mean", "worst", "fail", "m³/y"])
    head = next(line for line in small.body.split("\n") if "today" in line)
    for word in table[:4]:
        expect_in(word, head, "the head of the table in 80 columns")
    head = next(line for line in large.body.split("\n") if "today" in line)
    for word in set(table) - {"best"}:  # which no option is
        expect_in(word, head, "the head of the table in 160 columns")
    expect(re.search(r"\d worst ", large.body), large)
    column = quoted(page_part("The column on the right is the same in every view", "Ss Editing"))
    expect_equal(column, ["computing", "refining", "finished"])
    for screen in (small, large):
        expect_in("finished", screen.now, "the column on the right")
        expect(re.search(r"^of 1000 +(with )?forest +without$", screen.now, re.M), screen)
    expect_in("computing", begun.text, "after an edit")
    large.has("reach 42°, shadow 33°")


def test_index_dashes():
    """By the index the column of arrivals with forest has dashes"""
    (screen,) = fast("wait idle\ndump")
    expect_equal(screen.pair("arrive")[0], None, screen)


def test_keys():
    """The manual has exactly the keys of the program's table"""
    table = {word for _, first, second, _, _ in actions() for word in (first, second) if word}
    named = set()
    for line in re.findall(r"^(?:\.It )?\.?Ic (.*)$", PAGE, re.M):
        line = re.sub(r" [.,;:]$", "", line)
        named |= {render_word(word.removeprefix("Ic ")) for word in re.split(r" , ", line)}
    expect_equal(sorted(named - table - OTHER_KEYS), [], "keys of the manual that the program has not")
    expect_equal(sorted(table - named), [], "keys of the program that the manual has not")


if __name__ == "__main__":
    run_all(__name__)
