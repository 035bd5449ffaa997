#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: slow
"""The mouse in tmux: a click does what the key of the clicked place does, the wheel scrolls what is under it."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import Place  # noqa: E402
from test_terminal import Tmux, until  # noqa: E402
from harness import expect, expect_equal, run_all  # noqa: E402

WHEEL_UP, WHEEL_DOWN = 64, 65


class Mouse(Tmux):
    """A terminal that reports the mouse by SGR sequences."""

    def __init__(self, place, width=80, height=24):
        super().__init__(place, width, height, TERM="xterm-256color")

    def find(self, text, row=None):
        """Wait for a text; return its first column and its row, from 1 on. `row` from 1 on: only there."""

        def cell():
            for y, line in enumerate(self.screen().split("\n"), 1):
                if text in line and row in (None, y):
                    return line.index(text) + 1, y
            return None

        return until(lambda: f"{text!r} in row {row} of\n{self.screen()}", cell)

    def click(self, text, row=None):
        self.press(*self.find(text, row))

    def press(self, x, y):
        self.text(f"\x1b[<0;{x};{y}M\x1b[<0;{x};{y}m")

    def wheel(self, text, button, times=1):
        x, y = self.find(text)
        self.text(f"\x1b[<{button};{x};{y}M" * times)


def test_titles_and_bar():
    """Titles of views and keys of the bar are buttons, also in a window of another size; a popup hides them"""
    with Place() as place, Mouse(place) as t:
        t.start("fast.yaml")
        for width, height in ((80, 24), (120, 40), (60, 16)):
            t.tmux("resize-window", "-x", str(width), "-y", str(height))
            t.find("? help", row=height)
            t.click("3 ro")
            t.sees("shape of the rock")
            t.click("2 st")
            t.sees("belt 1 of 2", "Stand of belt 1", lacks=("shape of the rock",))
            t.click("u undo")
            t.sees("nothing to undo")
            t.click("? help")
            t.sees("Keys", "from, m: where the belt", lacks=("? help",))
            t.press(2, 1)
            t.wheel("In this view", WHEEL_DOWN)
            t.sees("▲▼", lacks=("In this view",))
            t.click("any other key")
            t.sees("? help", "Stand of belt 1")
        t.click("q quit")
        t.sees("READY>")


def test_tour():
    """In the tour a click on its lines goes on, one on the named key presses it; other clicks, the wheel and a paste do nothing"""
    with Place() as place, Mouse(place) as t:
        t.start("--tour", sees=("Tour 1/10", "? help"))
        t.click("Tour 1/10")
        t.sees("Line 2 is the answer")
        t.click("Space goes on")
        t.sees("Tour 2/10", "Space presses 7")
        t.click("3 rock")
        t.click("u undo")
        t.click("67.5")
        t.wheel("Belts of forest", WHEEL_DOWN)
        t.text("\x1b[200~7\x1b[201~")
        t.sees("nothing pasted: the tour types for you", "Space presses 7", "belt 1 of 2 · 3/42")
        t.click("7 unce")
        t.sees("The bar is the range", "90 % range", lacks=("nothing pasted",))


def test_form():
    """A click selects a field, a second one edits it; the wheel moves the cursor, and the head follows"""
    with Place() as place, Mouse(place) as t:
        t.start("fast.yaml")
        t.keys("2")
        t.sees("belt 1 of 2 · 2/38 ▼")
        t.click("50      ")
        t.sees("belt 2 of 2 · 3/34 ▼", "Stand of belt 2: lower")
        t.click("stools per ha")  # the label is a part of the field
        t.sees("stools per horizontal hectare")
        t.click("            1000 ")  # the column may have this number, too
        t.sees("Esc cancel", "1000_")
        for place_of_click in ("1 slope", "spacing, m", "finished", "empty: default"):
            t.click(place_of_click)
        t.text("1500")
        t.sees("1500_", "Stand of belt 2: lower")
        t.click("Enter accept")
        t.sees("1500", "? help", lacks=("1500_",))
        t.wheel("stools per ha", WHEEL_DOWN, 10)
        t.sees("34/34 ▲", "name of the stand")
        t.click("hits below, m")
        t.sees("· 23/34 ▲")
        t.wheel("hits below, m", WHEEL_UP)
        t.sees("· 20/34 ▲")
        t.wheel("finished", WHEEL_UP)
        t.wheel("1 slope", WHEEL_UP)
        t.keys("Down")
        t.sees("· 21/34 ▲")


def test_at_once():
    """Clicks and keys that arrive together act one after the other, each on the screen after the one before; none comes later"""

    def clicks(*cells):
        return "".join(f"\x1b[<0;{x};{y}M\x1b[<0;{x};{y}m" for x, y in cells)

    with Place() as place, Mouse(place) as t:
        t.start("fast.yaml")
        t.keys("2")
        t.sees("Stand of belt 1")
        x, y = t.find("50      ")
        t.keys("1")
        t.sees("Controls", lacks=("Stand of belt 1",))
        t.text("2" + clicks((x, y)))
        t.sees("Stand of belt 2")
        t.keys("1")
        for _ in range(3):
            t.sees("Controls", "? help", lacks=("type to search",))
            for _ in range(3):  # the picture gets the cursor, grows, and lists what is there
                t.press(20, 5)
            t.sees("type to search", "new control here")
            t.click("Esc cancel")
            t.sees("? help", lacks=("type to search",))
            t.keys("1")


def test_lists():
    """A click selects an item, a second one chooses it; the wheel moves the cursor"""
    with Place() as place, Mouse(place, 80, 16) as t:
        t.start("fast.yaml")
        t.keys(":")
        t.sees("Commands", "1/5", "▼")
        t.wheel("Down ", WHEEL_DOWN, 3)
        t.sees("4/5")
        t.click("PgUp ")
        t.sees("7/5")
        t.wheel("PgUp ", WHEEL_DOWN, 13)
        t.sees("20/5", "▲▼")
        t.click("u          undo")
        t.sees("19/5")
        t.click("u          undo")
        t.sees("nothing to undo", lacks=("Commands",))
        t.keys(":")
        t.sees("Commands")
        t.text("stand")
        t.sees("stand_")
        t.click("│                                       ")  # below the items
        t.click("Esc cancel")
        t.sees("? help", lacks=("Commands",))


def test_fields():
    """A click goes to a field; on the way down the fields are checked as by Enter"""
    with Place() as place, Mouse(place, 100, 40) as t:
        t.start("fast.yaml")
        t.click("2 stand")
        t.click("c sample plot")
        t.sees("400_")
        t.keys("C-u")
        t.click("shoots counted")
        t.sees("required")
        t.text("300")
        t.click("shoots counted")
        t.sees("300 ", "_", lacks=("300_",))
        t.text("77")
        t.sees("77_")
        t.click("size of the plot")
        t.sees("300_", "77 ")
        t.click("Esc back")
        t.sees("? help", lacks=("300_",))


def test_slope():
    """A click on the picture puts the cursor there; on the cursor it lists what stands there"""
    with Place() as place, Mouse(place) as t:
        t.start("fast.yaml")
        t.sees("finished")
        x, y = t.find("upper", row=8)  # its name is in the middle of 5 to 45 m
        t.press(x + 2, y)
        shown = t.sees("° steep, upper")
        metres = float(re.search(r"^([\d.]+) m: ", shown, re.M)[1])
        expect(20 <= metres <= 30, metres)
        x, y = t.find("lower")
        t.press(x + 2, 10)
        shown = t.sees("° steep, lower")
        metres = float(re.search(r"^([\d.]+) m: ", shown, re.M)[1])
        expect(60 <= metres <= 70, metres)
        t.press(x + 2, 10)
        t.sees(f"At {metres:g} m", "edit the belt here: lower")
        t.click("split the belt here")
        t.click("split the belt here")
        t.sees("belt 2 of 3" if "belt 2 of 3" in t.screen() else "belt 3 of 3", f"{metres:g} ")


def test_options():
    """View 5: a click selects an option, a second one renames it"""
    with Place() as place, Mouse(place) as t:
        t.start("options.yaml")
        t.keys("5")
        t.sees("finished", "none left ")
        _, y = t.find("none left ")
        t.press(1, y)
        t.sees("free run %  100.0")
        t.press(1, y)
        t.sees("Name of this option", "none left_")
        t.click("Esc back")
        t.sees("? help", lacks=("Name of this option",))
        t.wheel("thick ", WHEEL_UP)
        t.sees("ADC m         143")
        t.keys("1")
        t.sees("option 2 of 3")


def test_text():
    """The wheel scrolls a text under it; the line below the text has its position"""
    with Place() as place, Mouse(place) as t:
        t.start("fast.yaml")
        t.keys("4")
        t.sees("finished", "19/6")
        t.wheel("At 60 m, track", WHEEL_DOWN)
        t.sees("22/6", "▲▼")
        t.wheel("finished", WHEEL_DOWN)
        t.wheel("At 60 m, track", WHEEL_UP)
        t.sees("19/6", "▼", lacks=("▲",))


def test_years():
    """View 6: a click selects the year"""
    with Place() as place, Mouse(place) as t:
        t.start("rotation")
        t.keys("6")
        t.sees("Year 1,", "└", "20")
        x, y = t.find("┬")
        t.find("10 years", row=y + 1)
        t.press(x, y - 1)
        t.sees("Year 10", "left, right: another year")


def test_suspend():
    """The shell has the mouse after Ctrl-Z, the program after fg"""
    with Place() as place, Mouse(place) as t:
        t.start("fast.yaml")

        def flag():
            return t.tmux("display-message", "-p", "#{mouse_any_flag}#{mouse_sgr_flag}").strip()

        expect_equal(flag(), "11", "in the program")
        t.keys("C-z")
        t.sees("READY>")
        expect_equal(flag(), "00", "after Ctrl-Z")
        t.text("fg")
        t.keys("Enter")
        t.sees("? help", "1 slope")
        until("the mouse", lambda: flag() == "11")
        t.click("2 stand")
        t.sees("Stand of belt 1")


if __name__ == "__main__":
    run_all(__name__)
