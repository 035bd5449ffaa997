#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""ceduo-workflows(7): each way as it stands in the page runs in an empty folder and says what the page says it does."""
import os
import re
import subprocess
import sys

import harness
from harness import CEDUO, ROOT, Folder, expect, expect_equal, expect_in

PAGE = ROOT / "man" / "ceduo-workflows.7"
RUN = re.compile(r'^\.\\" run (\S+)\n\.Bd -literal[^\n]*\n(.*?)^\.Ed$', re.M | re.S)
KEYS_MOST = 25


def plain(text):
    """What the reader sees of a literal display."""
    for escape, sign in ((r"\(aq", "'"), (r"\-", "-"), (r"\&", ""), (r"\(ha", "^"), (r"\(ti", "~"), (r"\e", "\\")):
        text = text.replace(escape, sign)
    requests = [line for line in text.splitlines() if line.startswith(".")]
    expect(not requests, "requests in a literal display:", *requests)
    return text


def blocks(way):
    return [plain(body) for name, body in RUN.findall(PAGE.read_text()) if name == way]


class Walk:
    """The blocks of one way, run one after the other."""

    def __init__(self, way):
        self.way, self.blocks, self.outputs = way, blocks(way), []

    def __enter__(self):
        self.folder = Folder().__enter__()
        links = self.folder.path / ".bin"
        links.mkdir()
        (links / "ceduo").symlink_to(CEDUO)
        env = harness.environment(PATH=f"{links}{os.pathsep}{os.environ['PATH']}", HOME=str(self.folder.path),
                                  XDG_STATE_HOME=str(self.folder.path / ".state"))
        for number, block in enumerate(self.blocks, 1):
            done = subprocess.run(["sh", "-e"], input=block, text=True, encoding="utf-8", capture_output=True,
                                  cwd=self.folder.path, env=env, timeout=60, check=False)
            expect(done.returncode == 0 and done.stderr == "", f"block {number} of {self.way}:", block,
                   f"status {done.returncode}", done.stderr, done.stdout)
            self.outputs.append(done.stdout)
        return self

    def __exit__(self, *args):
        self.folder.__exit__(*args)

    def read(self, name):
        return (self.folder.path / name).read_text(encoding="utf-8")


def line_with(start, text):
    found = [line.strip() for line in text.splitlines() if line.strip().startswith(start)]
    expect(found, f"no line begins with {start!r} in:", text)
    return found[-1]


def side_by_side(page):
    """Name of an option: its line in the last table."""
    table = page[page.index("Side by side"):].splitlines()[2:]
    rows = [re.match(r" {2}(\S.*?) {2,}(.*)$", line) for line in table]
    return {row[1]: row[2] for row in rows if row and re.search(r"passes|FAILS", row[2])}


def keys_pressed(script):
    """Keys of a script; a typed character is one."""
    count = 0
    for line in script.splitlines():
        word, _, rest = line.strip().partition(" ")
        count += len(rest.split()) if word == "key" else len(rest) if word == "type" else 0
    return count


# ---- the page itself ----

def test_marks():
    """The marked blocks of the page are found"""
    for way, least in (("four-systems", 4), ("two-cuts", 7)):
        expect(len(blocks(way)) >= least, f"{way}: {len(blocks(way))} blocks")
    marks = re.findall(r'^\.\\" run ', PAGE.read_text(), re.M)
    expect_equal(len(marks), len(blocks("four-systems")) + len(blocks("two-cuts")), "marks with a block")


def test_keys():
    """From the start to two cuts in at most 25 keys"""
    scripts = [b for b in blocks("two-cuts") if "--script" in b]
    expect(scripts, "no script")
    for block in scripts:
        script = block[block.index("KEYS'\n"):block.rindex("KEYS")]
        expect(keys_pressed(script) <= KEYS_MOST, f"{keys_pressed(script)} keys:", script)


def test_readme():
    """The script and both screens of README.md are those of the program"""
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    literal = ["\n".join(line[4:] for line in part.splitlines())
               for part in re.findall(r"(?:^(?: {4}.*)?\n)+", readme, re.M)]
    script = next(part for part in literal if "dump last.txt" in part).strip() + "\n"
    expect(keys_pressed(script) <= KEYS_MOST, f"{keys_pressed(script)} keys:", script)
    with Folder() as f:
        f.write("last.keys", script)
        f.write("first.keys", "key Tab\nwait idle\ndump first.txt\n")
        for name in ("first", "last"):
            harness.good("--script", f"{name}.keys", cwd=f.path,
                         env={"HOME": str(f.path), "XDG_STATE_HOME": str(f.path)})
            screen = [line.rstrip() for line in (f.path / f"{name}.txt").read_text(encoding="utf-8").splitlines()]
            screen = "\n".join(screen).strip("\n")
            expect(any(screen in part for part in literal), f"{name}.txt is not in README.md:", screen)
    page = harness.good("--batch", "paper-site").out
    expect(any(page.strip("\n") in part for part in literal), "the page is not in README.md:", page)


# ---- four systems ----

def test_four_systems():
    """Four systems: grown all pass, just cut only the selection coppice does"""
    with Walk("four-systems") as walk:
        page = walk.outputs[0]
        rows = side_by_side(page)
        expect_equal(len(rows), 8, "options side by side")
        for name, figures in rows.items():
            passes = "FAILS" not in figures
            expect_equal(passes, "cut" not in name or "selection" in name, f"{name}: passes")
        expect_in("bears 50 kJ*", page)
        taken = {name: float(figures.split()[5]) for name, figures in rows.items()}
        cut = {name: kJ for name, kJ in taken.items() if "cut" in name}
        expect_equal(max(taken, key=taken.get), "large reserves", "most is taken by")
        expect_equal(max(cut, key=cut.get), "large reserves, just cut", "just cut, most is taken by")


def test_four_systems_picture():
    """Four systems: the picture has 24 lines and every option"""
    with Walk("four-systems") as walk:
        picture = walk.outputs[1]
        expect(len(picture.splitlines()) <= 25, picture)
        for name in ("simple coppice", "coppice with standards", "selection coppice", "large reserves"):
            expect_in(name, picture)
            expect_in(name + ", just cut", picture)


def test_four_systems_csv():
    """Four systems: the spreadsheets have a row an option and the columns named"""
    with Walk("four-systems") as walk:
        for name, columns in (("systems.csv", ("option", "index.residual_kJ", "lights.contact")),
                              ("stands.csv", ("option", "stems_per_ha"))):
            lines = walk.read(name).splitlines()
            expect_equal(len(lines), 9, f"lines of {name}")
            for column in columns:
                expect_in(column, lines[0].split(","), name)


def test_four_systems_keys():
    """Four systems: 380 reserves turn the contact light"""
    with Walk("four-systems") as walk:
        before, after = walk.read("before.txt"), walk.read("after.txt")
        expect_in("44.4", before)
        expect_in("Contact  FAILS", before)
        expect_in("Contact  passes 29.2 m", after)
        expect_in("Free run FAILS", after)
        expect_in("380", after)


# ---- two cuts ----

def test_two_cuts():
    """Two cuts: the page says which one passes"""
    with Walk("two-cuts") as walk:
        expect_equal(walk.outputs[2], "", "--check")
        page = walk.outputs[3]
        rows = side_by_side(page)
        expect_equal(sorted(rows), ["selection", "simple"])
        expect_equal(rows["simple"].count("FAILS"), 2, "simple fails")
        expect_equal(rows["selection"].count("passes"), 2, "selection passes")
        taken = {name: float(figures.split()[5]) for name, figures in rows.items()}
        expect(1.6 < taken["selection"] / taken["simple"] < 2, taken)
        expect(160 < float(rows["simple"].split()[0]) < 180, rows)
        reach = re.search(r"of 1000 rocks released: 1000 \(.*?\) reach it, (\d+)\s", page)
        expect(reach and 200 < int(reach[1]) < 300, page)
        assumed = page[page.index("Assumed, not measured"):]
        expect_in("density", assumed)
        expect_in("slope.materials", assumed)


def test_two_cuts_pictures():
    """Two cuts: both pictures come"""
    with Walk("two-cuts") as walk:
        pictures = walk.outputs[4]
        for words in ("side by side", "simple", "selection", "release", "mill"):
            expect_in(words, pictures)


def test_two_cuts_keys():
    """Two cuts: the terminal program says what the page says"""
    with Walk("two-cuts") as walk:
        rows = side_by_side(walk.outputs[3])
        slope, compare = walk.read("slope.txt"), walk.read("compare.txt")
        expect_in("release", slope)
        for name, figures in rows.items():
            adc, _, _, _, _, kJ, left = figures.replace(" %", "%").replace("%", " %").split()
            shown = line_with(name, compare)
            for figure in (adc, kJ):
                expect_in(figure, shown, name)
            found = [float(x) for x in re.findall(r"\d+\.\d+|\d+", shown.split("│")[0])]
            expect(any(abs(x - float(left)) < 2 for x in found), f"{left} kJ left:", shown)
        expect_in("Contact  passes", compare)
        expect_in("Free run passes", compare)


def test_two_cuts_new():
    """Two cuts: from the profile alone, by 25 keys"""
    with Walk("two-cuts") as walk:
        screen = walk.read("new.txt")
        expect_in("Rock  0.6 m", screen)
        options = [line.split("│")[0] for line in screen.splitlines() if re.match(r"(simple|selection)-", line)]
        expect_equal(len(options), 2, screen)
        expect(options[0].startswith("simple-c") and "✘✘" in options[0], screen)
        expect(options[1].startswith("selection-c") and "✔✔" in options[1], screen)
        expect("current" not in "".join(options), screen)


if __name__ == "__main__":
    suite = harness.Suite()
    suite.run(harness.tests_of(sys.modules[__name__]))
    suite.end()
