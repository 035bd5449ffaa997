#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How the screen uses its size: true scale, no half-empty panes, names that differ, curves of all options, and marks of what is
under the cursor."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import CUTS, FAST, Place, fast, play, run_script  # noqa: E402
from harness import DONE, Folder, expect, expect_equal, result, run_all  # noqa: E402

SIZES = ("80 24", "120 40", "200 50")


def play_views(scene, language="en", views="12345678"):
    """Return {(size, view): screen} after everything was computed."""
    script = "key 7\nwait idle\n" + "".join(f"resize {size}\n" + "".join(f"key {view}\nwait idle\nkey Ctrl-L\ndump\n" for view in views)
                                          for size in SIZES)
    with Folder() as folder:
        screens = play(folder.path, script, "--language", language, scene)
    return dict(zip([(size, view) for size in SIZES for view in views], screens))


def longest_gap(screen):
    """Return the largest number of blank lines one after another in the view's own part."""
    gaps = re.findall(r"(?:^\s*\n)+", screen.body + "\n", re.M)
    return max((gap.count("\n") for gap in gaps), default=0)


def test_full_panes():
    """On 120x40 and 200x50 no view of three scenes, one also in Italian, has a third of its lines blank."""
    for scene, language in (("paper-site", "en"), ("four-systems", "it"), ("four-systems", "en"), ("road-below", "en")):
        for (size, view), screen in play_views(scene, language).items():
            gap = longest_gap(screen)
            if size != "80 24":
                expect(gap < (screen.height - 5) / 3, f"{scene}, {language}, {size}, view {view}: {gap} blank lines in", screen)


# A slope of 45 degrees, 100 m high; stems at its top add a tenth to the height.
STEEP = FAST.replace("vertices_m: [[0, 80], [60, 30], [100, 0]]", "vertices_m: [[0, 100], [60, 40], [100, 0]]")


def test_true_scale():
    """On wide screens a slope of 45 degrees has two columns for each line, beside the form; it is larger than on 80x24."""
    with Place() as place:
        place.write("steep.yaml", STEEP)
        screens = place.play("".join(f"resize {size}\nkey 1\nwait idle\ndump\n" for size in SIZES), "steep.yaml")
    rows = []
    for screen in screens:
        lines = screen.body.split("\n")
        axis = next(i for i, line in enumerate(lines) if re.match(r" *└", line))
        columns = len(re.match(r" *└([┬─]+)", lines[axis]).group(1))
        rows.append(axis - 1)  # below a line of names
        if screen.width > 80:
            expect("heights drawn" not in screen.body and 0.8 <= columns / (2 * rows[-1]) <= 1.1, columns, rows, screen)
            expect(re.search(r" Belts of forest", lines[0]), "the form is not beside the slope", screen)
    expect(rows[0] < rows[1] < rows[2], "the slope is not larger on a larger screen", rows, screens[2])


def test_control_visible():
    """At 80x24 view 1 shows the control of the paper's site, with its whole name."""
    screen = fast("key 1\nwait idle\ndump", "paper-site")[0].whole()
    expect(re.search(r"^1 +135\* +end of the forest\* +50\* ", screen.body, re.M), "no control in the form of the", screen)


def option_rows(screen):
    """Return the names in the table of view 5."""
    rows = re.findall(r"^(\d+) (\S.*?) +\d+±\d+ ", screen.body, re.M)
    expect_equal([int(number) for number, _ in rows], list(range(1, len(rows) + 1)), "numbers of the options")
    return [name for _, name in rows]


def test_distinct_names():
    """On 80 columns the names of eight options that begin with equal words differ, and the worst year stays, in both languages."""
    for language, worst, count in (("en", "worst", 8), ("it", "pegg.", 8)):
        screen = play_views("four-systems", language, "5")["80 24", "5"].whole()
        names = option_rows(screen)
        expect_equal(len(names), count, screen)
        expect_equal(len(set(names)), count, f"different names in {names}")
        expect(re.search(rf"^ +\S+ .*\b{re.escape(worst)}", screen.body, re.M), worst, screen)
    with Place() as place:  # equal words before and after the difference
        text = CUTS.replace("name: thick", "name: coppice cut now and thinned, keeping 60 standards per hectare")
        text = text.replace("name: thin\n", "name: coppice cut now and thinned, keeping 120 standards per hectare\n")
        place.write("long.yaml", text)
        names = option_rows(place.play("key 5\nwait idle\ndump", "long.yaml")[0])
    expect(re.search(r"\b60", names[0]) and re.search(r"\b120", names[1]), "the numbers that differ are not in", names)


def find_ends(screen, options):
    """Return {option: (column, line)} of the numbers on the right of the curves."""
    top = next(i for i, line in enumerate(screen.lines) if re.match(r"of 1000 released", line))
    ends = {}
    for y in range(top + 1, screen.height - 4):
        line = screen.lines[y][:screen.width - screen.side - 2]
        numbers = re.search(r" ((?:\d+ )*\d+) *$", line)
        if numbers and not re.match(r"(today)", line):
            for number in map(int, numbers.group(1).split()):
                ends.setdefault(number, (line.rindex(str(number)), y))
    return {k: v for k, v in ends.items() if k <= options}


def test_curves_ahead():
    """View 5 has a curve of each option: at its end its number, the higher the more rocks pass in the last year, as in the JSON."""
    years = result("--years", "-n", 1024, "four-systems")
    last = [option["years"][-1]["controls"][-1]["wooded"]["exceed_probability"] for option in years["options"]]
    for size in ("120 40", "200 50"):
        with Folder() as folder:
            screen = play(folder.path, f"resize {size}\nkey 5\nwait idle\ndump", "four-systems")[0].whole()
        ends = find_ends(screen, len(last))
        expect_equal(sorted(ends), list(range(1, len(last) + 1)), screen)
        for a in range(len(last)):
            for b in range(len(last)):
                if last[a] > last[b] + 0.1:
                    expect(ends[a + 1][1] < ends[b + 1][1], f"{a + 1} ({last[a]}) is not above {b + 1} ({last[b]})", screen)
        expect(re.search(r"limit", screen.body) and re.search(r"^ *today ", screen.body, re.M), "today and the limit", screen)


def read_roles(scene, script, *arguments):
    """Return (screen, roles) after a script, as lists of lines."""
    with Folder() as folder:
        done = run_script(folder.path, f"{script}\ndump screen.txt\nroles roles.txt\n", "--charset", "braille", *arguments, scene)
        expect_equal(done.status, DONE, done)
        return [(folder.path / name).read_text().split("\n") for name in ("screen.txt", "roles.txt")]


def marked(screen, roles, pattern):
    """Return the texts that match a pattern and are wholly under the cursor."""
    found = []
    for line, signs in zip(screen, roles):
        for match in re.finditer(pattern, line):
            if set(signs.ljust(len(line))[match.start():match.end()]) == {"x"}:
                found.append(match.group())
    return found


def test_marks():
    """The option under the cursor is marked in each picture of view 5, and the year in that of view 6."""
    for tabs, pattern in ((0, r"\b3\b"), (1, r"\b3\b"), (1, "3 coppice with standards$"), (2, "coppice with standards  "), (3, r"\(?3\)?"),
                          (3, r"\(?3\)? coppice with standards$")):
        screen, roles = read_roles("four-systems", "resize 120 40\nkey 5\nwait idle\nkey Down Down" + " Tab" * tabs)
        body = [line[:120 - 38].rstrip() for line in screen[2:]]
        expect(marked(body, roles[2:], pattern.replace("  ", "")), f"after {tabs} Tab nothing like {pattern!r} is marked", *screen, *roles)
    for steps in (0, 7):
        screen, roles = read_roles("four-systems", "resize 120 40\nkey 6\nwait idle\nkey Tab" + " Right" * steps)
        columns = [line.index("▲") for line in screen if "▲" in line]
        expect(columns and marked(screen, roles, "▲"), "no mark on the axis of the years", *screen)
        axis = next(line for line in screen if "┬" in line and "▲" in line)
        if steps == 0:
            first = columns[0]
    expect_equal((columns[0] - first) % 7, 0, axis)
    expect(columns[0] > first, "the mark does not follow the year", axis)


def test_title():
    """The first line has the title of the scene, at 80 columns cut, never the name of its file."""
    with Place() as place:
        place.write("other-name.yaml", FAST.replace("title: fast", "title: Rocks above the mill of Ussita"))
        for size in SIZES:
            screen = place.play(f"resize {size}\nwait idle\ndump", "other-name.yaml")[0]
            expect("other" not in screen.lines[0] and re.search(r"8 obs\w*…? +Rocks above", screen.lines[0]), "no title in", screen.lines[0])
            expect(size == "80 24" or screen.lines[0].endswith("Rocks above the mill of Ussita"), "the title is cut:", screen.lines[0])


def test_form_widths():
    """Columns of a form have the width of what they show: names are whole while numbers have few columns."""
    with Place() as place:
        place.write("named.yaml", FAST.replace("name: upper", "name: coppice above the old path"))
        screen = place.play("key 1\nwait idle\ndump", "named.yaml")[0]
    expect(re.search(r"^1 +5 +45 +coppice above the old path$", screen.body, re.M), "the name of the stand is cut in", screen)


if __name__ == "__main__":
    run_all(__name__)
