#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: slow threads
"""Live edits of fields and lists in the terminal program: effects on the scene, the figures and the file."""
import math
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import play  # noqa: E402
from play import WOOD, Place, check_good, fast  # noqa: E402
from harness import expect, expect_equal, expect_in, expect_near, run_all  # noqa: E402
from test_screens import lights  # noqa: E402

LUMPED = WOOD.replace("simulation: {", "simulation: {law: lumped, ")
FIGURE_NAMES = ("arrive", "above 250 kJ", "mean kJ", "95 % below kJ")


def read_index(screen):
    """Return the index's energy taken and left, from the column on the right."""
    found = re.search(r"^taken kJ +([\d.]+)\nleft kJ +([\d.]+)$", screen.now, re.M)
    expect(found, "no index in the column on the right:", screen.now)
    return float(found.group(1)), float(found.group(2))


def test_stand_edit():
    """A change of the stand changes ADC, lights, index and arrivals with forest at once, nothing without forest."""
    script = """key 2
        wait idle
        dump
        find stools.per_ha
        set 1000
        find shoots[0]
        set 3000
        clear
        dump
        wait idle
        dump
        find shoots
        key d d
        find trees
        key d d
        find forest[1]
        key d
        wait idle
        dump"""
    for text in (WOOD, play.in_the_index(WOOD)):
        by_index = "contact_model: index" in text
        with Place() as place:
            place.write("wood.yaml", text)
            before, at_once, after, cut = place.play(script, "wood.yaml")
        expect(at_once.now != before.now, "nothing has changed", at_once)
        for screen in (at_once, after, cut):
            for name in FIGURE_NAMES:
                expect_equal(screen.pair(name)[1], before.pair(name)[1], f"'{name}' without forest")
        for screen in (at_once, after):
            taken, left = read_index(screen)
            expect(taken < read_index(before)[0] - 1, "fewer stools, yet the index takes", screen.now)
            expect_near(left + taken, screen.pair("mean kJ")[1], 1, "Eq. 5")
            adc = [float(re.search(r"ADC ([\d.]+) m", s.body).group(1)) for s in (before, screen)]
            expect(adc[1] > adc[0] * 2, f"ADC {adc}")
        energy = "unknown" if by_index else "FAILS"
        expect_equal(lights(before, "braille"), {"Contact": "passes", "Free run": "passes", "Energy": energy}, "lights")
        expect_equal(lights(cut, "braille"), {"Contact": "FAILS", "Free run": "FAILS", "Energy": energy}, "lights")
        for name in FIGURE_NAMES:
            wood = [s.pair(name)[0] for s in (before, at_once, after, cut)]
            if by_index:
                expect_equal(wood, [None] * 4, f"'{name}' through the wood by the index")
                continue
            expect(wood[0] < wood[2] and wood[2] <= wood[3], f"'{name}' with fewer stems", wood)
            expect(wood[1] is None or wood[1] > wood[0] or at_once.now.split("\n= ")[0] == at_once.now,
                   f"'{name}' of the old wood under the new, and no mark that better ones come", wood)
            expect_equal(wood[3], cut.pair(name)[1], f"'{name}' where no stem is left")
        cut.whole()


def test_rock_edit():
    """A change of rock or ground changes arrivals and energy, with and without forest."""
    script = """key 3
        wait idle
        dump
        find rock.diameter_m
        set 1.25
        wait idle
        dump
        key 1
        find segments[0].
        key Right
        set 0.7
        wait idle
        dump"""
    for text in (WOOD, LUMPED, play.in_the_index(LUMPED)):
        with Place() as place:
            place.write("wood.yaml", text)
            before, mass, ground = place.play(script, "wood.yaml")
        expect(float(re.search(r"Rock +[\d.]+ m, +([\d.]+) kg", mass.now).group(1)) > 2600, mass.now)
        bare = {name: [s.pair(name)[1] for s in (before, mass, ground)] for name in FIGURE_NAMES}
        expect(bare["mean kJ"][1] > bare["mean kJ"][0] * 1.8 and bare["above 250 kJ"][1] > bare["above 250 kJ"][0], bare)
        if text != WOOD:
            expect_near(bare["arrive"][1], bare["arrive"][0], 3, "the lumped law knows no mass: arrive")
        expect(bare["mean kJ"][2] < bare["mean kJ"][1], bare)
        if "contact_model" in text:
            continue
        wood = {name: [s.pair(name)[0] for s in (before, mass, ground)] for name in FIGURE_NAMES}
        expect(wood["mean kJ"][1] > wood["mean kJ"][0] * 1.8 and wood["arrive"][1] > wood["arrive"][0],
               "a larger rock loses a smaller share to the stems", wood)
        expect(wood["mean kJ"][2] < wood["mean kJ"][1] and wood["arrive"][2] < wood["arrive"][1], "the softer ground", wood)


def test_contact_model():
    """contact_model edited to index and back: the column, the lights, views 3 and 5 follow both times."""
    both = "clear\nresize 80 24\ndump\nresize 200 50\ndump\n"
    screens = fast(f"""key 3
        find simulation.contact_model
        wait idle
        {both}
        key Enter Home Enter
        wait idle
        {both}
        key 5
        {both}
        key 3
        key Enter End Enter
        wait idle
        {both}
        key 5
        {both}""", "cuts.yaml")
    for at in (0, 1):
        stems, index, compared_index, back, compared_back = screens[at::2]
        expect_equal([s.row("^rocks among stems")[3] for s in (stems, index, back)],
                     ["stems", "index", "stems"], "contact_model")
        expect_equal([lights(s, "braille")["Energy"] for s in (stems, index, back)], ["FAILS", "unknown", "FAILS"], "energy light")
        for name in FIGURE_NAMES:
            expect(None not in stems.pair(name), name, stems.now)
            expect_equal(index.pair(name)[0], None, f"'{name}' through the wood by the index")
            bare = [s.pair(name)[1] for s in (stems, index, back)]
            expect_equal(bare, bare[:1] * 3, f"'{name}' without forest")
        expect(not re.search(r"stems stop +\d+ |at rest +\d+ +\d", index.now), "ends through the wood by the index", index)
        expect_equal(read_index(index), read_index(stems), "the index")
        expect_in("kJ/100 m", compared_index.body)
        expect_in("mean", compared_back.body)
        without_star = [re.sub(" +wood *", " wood", s.text.replace("*", " ")) for s in (back, stems)]  # title
        expect_equal(*without_star, "after index and back")


def test_control_edit():
    """Moving a control: no figure of the old place appears under the new name, none is 'nan'."""
    script = """wait idle
        find controls[1]
        key d
        dump
        wait idle
        dump
        find controls[0].x_m
        key a
        dump
        wait idle
        dump
        find controls[0].x_m
        set 50
        dump
        wait idle
        dump"""
    for scene in ("fast.yaml", "wood.yaml"):
        screens = fast(script, scene)
        for screen in screens:
            expect(not re.search(r"above -?nan", screen.now), "the energy that nobody gave is compared with", screen)
        screens[1].has("At 60 m, track", "above 20 kJ")
        screens[3].has("At 80 m")
        expect("above" not in screens[3].now, "an accepted energy that was not given:", screens[3])
        expect_equal(lights(screens[3], "braille")["Energy"], "unknown", "without an accepted energy")
        screens[5].has("At 80 m")
        for at in (1, 3, 5):
            wanted = r"^finished, \d+ rocks"
            expect(re.search(wanted, screens[at].now, re.M), screens[at])


def test_undo():
    """Undo and redo restore identical screens."""
    for scene in ("fast.yaml", "wood.yaml"):
        undo_and_redo(scene)


def undo_and_redo(scene):
    screens = fast("""key 2
        wait idle
        find stools.per_ha
        clear
        dump
        set 2000
        clear
        wait idle
        dump
        key +
        key +
        clear
        wait idle
        dump
        key u
        key u
        dump
        clear
        wait idle
        dump
        key u
        clear
        wait idle
        dump
        key u
        dump
        key Ctrl-R
        clear
        wait idle
        dump
        key Ctrl-R Ctrl-R
        clear
        wait idle
        dump
        key Ctrl-R
        dump""", scene)
    start, edited, stepped, undone, twice, thrice, none, again, far, end = screens
    expect(start.text != edited.text != stepped.text, "the edits changed nothing")
    expect_in("undone: ", undone.note)
    expect_equal(twice.text, edited.text, "after two undos")
    expect_equal(thrice.text, start.text, "after three undos")
    expect_in("nothing to undo", none.note)
    expect_equal(again.text, edited.text, "after redo")
    expect_equal(far.text, stepped.text, "after all redos")
    expect_in("nothing to redo", end.note)
    name = scene.removesuffix(".yaml")
    expect(f"* {name}" in edited.title and f"* {name}" not in thrice.title, "the mark of unsaved work", edited.title)


def test_undo_rock():
    """Undo of a change of the rock restores the figures too, after a new simulation."""
    start, edited, back = fast("""key 3
        find rock.diameter_m
        wait idle
        clear
        dump
        set 1.1
        wait idle
        dump
        key u
        clear
        wait idle
        dump""", "wood.yaml")
    expect(start.now != edited.now, edited)
    expect_equal(back.text, start.text, "after undo")


def wrong(view, word, value, *parts):
    screens = fast(f"""key {view}
        wait idle
        find {word}
        clear
        dump
        set {value}
        dump
        key Esc
        clear
        dump""")
    before, refused, after = screens
    for part in parts:
        expect_in(part, refused.note, f"what is said to {value!r}")
    expect_in("Esc cancel", refused.bar, "still in the field")
    expect_in(value, refused.body, "what was typed is still there")
    expect_equal(refused.now, before.now, "the figures")
    expect_equal(after.text, before.text, "after Esc")


def test_wrong_values():
    """A wrong value is explained in place and refused."""
    wrong(2, "shoots[0].dbh_m", "-7", "diameter, cm: -7 is below 0 cm")
    wrong(2, "shoots[0].dbh_m", "1001", "1001 is above 1000 cm")
    wrong(2, "stools.per_ha", "3,000,5", "stools per ha: '3,000,5' is not a number")
    wrong(2, "stools.per_ha", "many", "'many' is not a number")
    wrong(2, "stools.per_ha", "nan", "not a number")
    wrong(2, "stools.per_ha", "1e400", "")
    wrong(2, "stools.per_ha", "0", "shoots without stools")
    wrong(3, "rock.diameter_m", "0", "")
    wrong(3, "rock.diameter_m", "0x10", "not a number")
    wrong(3, "release.x_m", "-7", "")
    wrong(1, "forest[1].from_m", "3", "")
    wrong(1, "forest[1].from_m", "1000", "")
    wrong(1, "controls[1].x_m", "60", "")
    wrong(1, "vertices_m[1]", "[0, 1]", "")
    wrong(1, "vertices_m[1]", "here", "")


def test_message_whole():
    """At 80 columns too a refusal is fully readable."""
    refused = fast("""find vertices_m[1]
        key Enter Ctrl-U
        type [0, 1]
        key Enter
        dump
        resize 200 50
        dump""")
    expect_equal(refused[0].note, refused[1].note, "at 80 columns, and at 200")


def test_escape():
    """Esc restores a field after any typing."""
    before, after = fast("""key 2
        wait idle
        find stools.per_ha
        dump
        key Enter
        type 17.5e3x
        key Left Backspace Home Del
        key Esc
        dump""")
    expect_equal(after.text, before.text, "after Esc")


def test_editing_line():
    """The line of a field: cursor, deleting, UTF-8, and the first letter that replaces all."""
    screens = fast("""key 3
        resize 100 24
        find title
        key Enter
        type Über dem Weg
        key Home Del
        type u
        key End Backspace
        dump
        key Enter
        dump
        key Enter Home
        type À
        key Right Right Backspace Enter
        dump
        key Enter Ctrl-U Enter
        dump""")
    expect_in("uber dem We_", screens[0].body)
    screens[1].has("* uber dem We")
    screens[2].has("* Àuer dem We")
    screens[3].whole()


def test_empty_value():
    """An emptied field gets its default."""
    before, after = fast("""key 3
        find simulation.threshold_m
        set 25
        dump
        key Enter Ctrl-U Enter
        dump""")
    expect_equal(before.row("^threshold")[-1], "25", "threshold")
    expect_equal(after.row("^threshold")[-1], "30", "threshold")


def test_steps():
    """+ and - step numbers, words and yes or no, and stop at the limit of the range."""
    screens = fast("""key 2
        find stools.per_ha
        dump
        key +
        dump
        key - - -
        dump
        find stools.spacing_m
        key -
        dump
        key 3
        find simulation.scale_rn
        key +
        dump
        key +
        dump
        find simulation.law
        key -
        dump
        key +
        dump
        key 1
        find segments[0]
        set 0.98
        key + + + + +
        dump""")
    stools = [float(s.row("^stools per ha")[-1]) for s in screens[:3]]
    expect_equal(stools, [3000, 3100, 2800], "stools at first, after +, after - - -")
    expect_equal(screens[3].row("^spacing")[-1], "0.39", "spacing after -")
    expect_equal([s.row("^Rn by speed")[-1] for s in screens[4:6]], ["true", "false"], "Rn by speed")
    expect_equal([s.row("^law of impact")[-1] for s in screens[6:8]], ["lumped", "crsp"], "law, after - and +")
    expect_in("limit of the range reached", screens[8].note)
    expect_equal(screens[8].row(r"^1 +1(\.0*)? +0.98")[0], "1", "rn at its limit")


def table(screen, head):
    """Return the rows of the table below these words, in a form below or beside a picture: lists of words."""
    pattern = re.compile(r" {4}" + " +".join(map(re.escape, head.split())) + r"(?: |$)")
    lines = screen.body.split("\n")
    at, found = next(((i, m) for i, m in enumerate(map(pattern.search, lines)) if m), (None, None))
    expect(found, f"no table {head} in the", screen)
    rows = []
    for line in (line[found.start():] for line in lines[at + 1:]):
        if not re.match(r"\d+ ", line):
            break
        rows.append(line.split())
    return rows


def lists(view, word, keys, head, size="120 60"):
    """Return the tables after each of some keys, with the cursor on a word."""
    script = f"resize {size}\nkey {view}\nwait idle\nfind {word}\ndump\n"
    script += "\n".join(f"key {key}\ndump" for key in keys)
    return [table(s, head) for s in fast(script)]


def test_belts():
    """Belts: y splits one in two, d deletes, a fills the next free stretch, u undoes."""
    head = "from, m to, m stand"
    start, split, gone, back, first = lists(1, "forest[0]", ["y", "d", "u", "u"], head, "200 70")
    expect_equal(start, [["1", "5", "45", "upper"], ["2", "50", "80", "lower"]], "belts")
    expect_equal(split, [["1", "5", "25", "upper"], ["2", "25", "45", "upper"], ["3", "50", "80", "lower"]], "split")
    expect_equal(gone, [["1", "5", "25", "upper"], ["2", "50", "80", "lower"]], "after d")
    expect_equal(back, split, "after u")
    expect_equal(first, start, "after u u")
    start, more, most = lists(1, "forest[0]", ["a", "a"], head, "200 70")
    expect_equal(len(more), 3, f"belts after a: {more}")
    expect_equal(len(most), 4, f"belts after a a: {most}")
    places = [(float(r[1]), float(r[2])) for r in most]
    expect(places == sorted(places) and all(a[1] <= b[0] for a, b in zip(places, places[1:])), places)


def test_cohorts():
    """Cohorts of shoots and classes of trees: y and a, d, < and >."""
    head = "per hectare diameter, cm"
    start, copy, moved, fewer, one, none = lists(2, "shoots[0]", ["y", ">", "d", "d", "d"], head, "200 70")
    expect_equal([r[1] for r in start], ["9000", "500"], "shoots")
    expect_equal([r[1] for r in copy], ["9000", "9000", "500"], "after y")
    expect_equal([r[1] for r in moved], ["9000", "500", "9000"], "after >")
    expect_equal([r[1] for r in fewer], ["9000", "500"], "after d")
    expect_equal(len(one), 1, "after d d")
    expect_equal(none, [], "after d d d")
    start, later, earlier = lists(2, "shoots[1]", ["<", ">"], head, "200 70")
    expect_equal([r[1] for r in later], ["500", "9000"], "after <")
    expect_equal(earlier, start, "after < >")
    screens = fast("""resize 100 60
        key 2
        find trees[0]
        key y
        dump
        key a
        dump
        key d d d d
        dump
        key a
        dump
        find shoots[1]
        key d d
        dump
        key a
        dump""")
    trees = [re.findall(r"^\d +([\d.]+) +[\d.]+ +[\d.]+ +[-\d.]+ ", s.body.split("Single trees")[1], re.M) for s in screens]
    expect_equal(trees[0], ["80", "80", "20"], "trees after y")
    expect_equal(len(trees[1]), 4, "trees after a")
    expect_equal(trees[2], [], "trees after d d d d")
    expect_equal(len(trees[3]), 1, "trees after a on the empty list")
    expect_equal(screens[4].row("^stools per ha")[-1], "-", "stools go with their last shoots")
    expect(float(screens[5].row("^stools per ha")[-1]) > 0, "stools come with the first shoots")


def test_blocks():
    """Blocks: a asks for a class, field by field, and proposes one ten times as large and as rare; d deletes them"""
    with Place() as place:
        none, refused, one, asked, two, gone, saved = place.play("""resize 120 60
            key 3
            dump
            find design.survey
            key Up a
            type viel
            key Enter
            dump
            key Ctrl-U
            type 1
            key Enter
            type 0,05 1
            key Enter
            type 1
            key Enter
            dump
            key a
            dump
            key Enter Enter Enter
            dump
            key d d
            dump
            key u u
            find design.survey
            key Enter
            type good
            key Enter
            key s
            dump""", "fast.yaml")
        expect_in("none; a adds one", none.body, "no blocks")
        refused.has("blocks per year: 'viel' is not a number")
        expect(re.search(r"blocks per year +0\.1_? +volumes, m³ +1 10\b", asked.popup), "what is offered", asked)
        found = [re.findall(r"^\d +(\S+) +(\S+ \S+) +(\S+)(?: |$)", s.body.split("Falling blocks")[1], re.M) for s in (one, two)]
        expect_equal(found, [[("1", "0.05 1", "1")], [("1", "0.05 1", "1"), ("0.1", "1 10", "-")]], "blocks")
        expect_in("none; a adds one", gone.body, "after d d")
        check_good(place.path, "fast.yaml")
        for words in ("volume_m3: [0.05, 1]", "volume_m3: [1, 10]", "survey: good"):
            expect_in(words, place.text("fast.yaml"), saved.note)


def test_blocks_without_size():
    """With blocks a rock's size may be empty; without them it is required. One of two dimensions sets the other"""
    with Place() as place:
        place.write("sizes.yaml", play.FAST + "blocks: [{per_year: 1, volume_m3: [0.1, 1], exponent: 1}]\n")
        sized, none, block, refused, typed = place.play("""resize 120 60
            key 3
            dump
            find rock.diameter_m
            key Enter Ctrl-U Enter
            dump
            find rock.shape
            key +
            dump
            find blocks
            key d
            dump
            key s
            find rock.height_m
            set 0.7
            find rock.diameter_m
            set 0.6
            dump""", "sizes.yaml")
        mean = 0.1 * math.log(10) / (1 - 0.1)  # v^-1 from 0.1 to 1
        expect_in("ADC and index use one rock: 170.2 kg, mean diameter B 0.5 m", " ".join(sized.body.split()))
        expect_in(f"ADC and index use one rock: {mean * 2600:.1f} kg", " ".join(none.body.split()))
        expect_in("'diameter, m' is missing; the shape 'cylinder' needs it", refused.note)
        expect("set for the same volume" not in block.note, block)
        check_good(place.path, "sizes.yaml")
        expect_in("rock: {shape: cylinder}", place.text("sizes.yaml"))
        wide, high = 0.6, 0.7
        expect_in(f"use one rock: {2600 * math.pi / 4 * wide ** 2 * high:.1f} kg, mean diameter B 0.65 m", " ".join(typed.body.split()))


def test_blocks_from_anywhere():
    """a in view 3 asks for a class of blocks anywhere; a power law becomes the first class; their frequency replaces
    rocks_per_year; d on the power law deletes all; the rock needs no size, which its form reports."""
    law = "blocks: {per_year: 2, volume_m3: [0.02, 5], exponent: 1.2}   # kept: a power law\n"
    with Place() as place:
        place.write("law.yaml", place.text("fast.yaml") + law)
        place.write("counted.yaml", place.text("fast.yaml") + "rocks_per_year: 3\n")
        asked, two, gone = place.play("resize 120 60\nkey 3 a\ndump\nkey Enter Enter Enter\ndump\nkey s u\nfind blocks.exponent\nkey d\ndump", "law.yaml")
        expect(re.search(r"blocks per year +0\.2_? +volumes, m³ +5 50\b", asked.popup), "what is offered", asked)
        expect_in("New class of blocks", asked.text)
        two.has("Rock; sizes come from the blocks")
        check_good(place.path, "law.yaml")
        for words in ("{per_year: 2, volume_m3: [0.02, 5], exponent: 1.2}", "{per_year: 0.2, volume_m3: [5, 50]}"):
            expect_in(words, place.text("law.yaml"))
        expect_in("blocks deleted", gone.note)
        gone.has("none; a adds one").lacks("sizes come from the blocks")
        said, = place.play("key 3 a\ntype 0.5\nkey Enter\ntype 0,02 5\nkey Enter Enter\ndump\nkey s", "counted.yaml")
        expect_in("rocks_per_year, which is removed", said.note)
        check_good(place.path, "counted.yaml")
        expect("rocks_per_year" not in place.text("counted.yaml"), place.text("counted.yaml"))


def grids(folder, script, scene):
    """Return a script's standard output: screens and their roles, each of 24 lines."""
    lines = play.run_script(folder, script, scene, "--charset", "braille").out.split("\n")
    return [lines[i:i + 24] for i in range(0, len(lines) - 1, 24)]


def test_figures_of_before():
    """After an edit the former answer, column and pictures stay, dimmed, until new ones arrive; also for a new control, and for
    a changed copy of an option with an unknown forest."""
    edits = (("fast.yaml", "key /\nkey Ctrl-U\ntype forest[0]\nkey Enter a\n"),
             ("fast.yaml", "key /\nkey Ctrl-U\ntype controls[0]\nkey Enter a\n"),
             ("cuts.yaml", "key 5 y 1\nwait idle\ndump -\nkey /\nkey Ctrl-U\ntype forest[0]\nkey Enter Enter Ctrl-U\ntype 7\nkey Enter\n"))
    with Place() as place:
        place.write("fast.yaml", WOOD)
        for scene, edit in edits:
            for _ in range(20):  # the first rocks may be simulated before the edit is drawn, or between text and roles
                script = f"wait idle\ndump -\n{edit}dump -\nroles -\ndump -\nwait idle\ndump -\nroles -\n"
                old, now, roles, still, after, last = grids(place.path, script, scene)[-6:]
                if now[1].endswith("computing …") and still[1].endswith("computing …"):
                    break
            else:
                raise play.Failure("the first rocks always were faster", scene, edit)
            expect_equal(now[1][:40], old[1][:40], f"{scene}: the answer of before")
            expect(set(roles[1][:66].replace(" ", "")) == {"d"}, "the answer is not dimmed", roles[1])
            expect("computing" not in after[1] and "d" not in last[1], "the new answer", after[1], last[1])
            column = "\n".join(line[53:] for line in now[2:-3])
            for name in ("arrive", "above 250 kJ", "stems stop"):
                figures = re.search(rf"^{name} .*$", "\n".join(line[53:] for line in old[2:-3]), re.M)[0]
                expect_in(figures, column, f"{scene}: column")
            expect({role for line in roles[2:-3] for role in line[53:]} <= {"d", " "}, "the column is not dimmed", roles)
            expect("…" not in column.split("of 1000")[1].split("ADC")[0], "figures are missing", column)
            picture = [line[:50] for line in roles[2:8]]
            expect({role for line in picture for role in line} <= {"d", " "}, "the picture is not dimmed", picture)
            expect(any(line.strip() for line in picture), "there is no picture", now)


def test_segments():
    """Segments: y splits one in two, d joins them."""
    head = "bounce Rn slide Rt"
    start, split, joined = lists(1, "segments[0]", ["y", "d"], head, "200 70")
    expect_equal([r[1] for r in start], ["0.3", "0.25"], "rn")
    expect_equal([r[1] for r in split], ["0.3", "0.3", "0.25"], "rn after y")
    expect_equal(len(joined), 2, "segments after d")


def test_vertices():
    """Vertices: a pair is typed; keys that cannot add or delete one explain why."""
    screens = fast("""resize 200 70
        find vertices_m[1]
        set [60, 35]
        dump
        key y
        dump
        key d
        dump""")
    counts = [len(re.findall(r"(?:^| )\d +\S+ \S+$", s.body.split("Profile: points")[1], re.M)) for s in screens]
    expect_in("60 35", screens[0].body)
    expect_equal(counts[0], 3, "vertices")
    for i in (1, 2):
        expect(counts[i] != counts[i - 1] or not screens[i].note.startswith("vertices_m"),
               "nothing is done and nothing is said", screens[i])


def test_controls():
    """Controls: a and y add one, d deletes, < and > reorder, the last one stays."""
    head = "counted at, m name"
    start, more, back, fewer, one, same = lists(1, "controls[1]", ["a", "<", "d", "d", "d"], head, "200 70")
    expect_equal([r[1] for r in start], ["60", "80"], "controls")
    expect(len(more) == 3 and 80 < float(more[2][1]) <= 100, more)
    expect_equal([r[1] for r in back], ["60", more[2][1], "80"], "after <")
    expect_equal([r[1] for r in fewer], ["60", "80"], "after d")
    expect_equal(len(one), 1, "after d d")
    expect_equal(same, one, "after d d d")


if __name__ == "__main__":
    run_all(__name__)
