#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: slow
"""Popups of the terminal program: presets, new scenes, files to open, search, help, counts of a plot."""
import math
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import play  # noqa: E402
from play import FAST, Place, actions, check_good, fast  # noqa: E402
from harness import expect, expect_equal, expect_in, expect_near, run_all  # noqa: E402
from test_screens import lights  # noqa: E402


# ---- presets, new, open ----

STEMS = {"ads-1": 8326 + 750, "simple-coppice": round(2500 * 2.695 + 60)}  # per hectare, from the files


def test_presets():
    """Presets show their number of stems, and a preview before the choice."""
    for size in ("120 40", "80 24"):
        lines = [x for screen in fast(f"resize {size}\nkey 2\nkey p\ndump\n" + "key Down\ndump\n" * 45)
                 for x in screen.text.split("\n")]
        for name, stems in STEMS.items():
            expect(any(re.search(rf"[│|] {name} +{stems}/ha ", x) for x in lines), f"{name} at {size}", stems)
    first, second, chosen, undone = fast("""key 2
        wait idle
        key p Down Down
        dump
        key Down
        dump
        key End Up Up
        key Enter
        wait idle
        clear
        dump
        key u
        wait idle
        clear
        dump""")
    for screen in (first, second):
        screen.has("Stand of belt 1, now 'upper'")
        for part in ("stools,", "stems,", "trees per ha; basal area", "with this rock: ADC", "free run", "100 m"):
            expect_in(part, screen.popup, "preview")
    expect(first.popup.split("ads-1")[0] != second.popup.split("ads-1")[0], "the preview stays as it was")
    expect_equal(chosen.row("^system")[1:], ["simple", "coppice"], "system")
    chosen.has("simple coppice")
    undone.has("Stand of belt 1: upper")


def test_new_typed():
    """n: a new scene typed in one form, computed at once, saved at the given name, and valid."""
    with Place() as place:
        screens = place.play("""key n
            dump
            type Above the mill
            key Enter
            type 0 100, 40 60; 90 20, 120 18
            key Enter Enter Enter Enter
            type 0,9
            key Enter
            type 95
            key Enter
            type 30
            key Enter
            dump
            key Enter
            wait idle
            dump
            key s
            dump
            key Ctrl-U
            type mill.yaml
            key Enter
            dump""")
        screens[0].has("New scene", "profile (CSV file or points)", "rocks start at x", "face from the top", "ground",
                       "rock: diameter, m", "control at x, m", "limit, kJ", "stand", "Esc back")
        screens[1].has("Above the mill", "0 100, 40 60; 90 20, 120 18", "0,9", "95", "30", "simple-coppice")
        screens[2].has("* Above the mill", "At 95 m", "above 30 kJ")
        screens[3].has("Save as")
        screens[4].has("saved mill.yaml")
        check_good(place.path, "mill.yaml")
        text = place.text("mill.yaml")
        for part in ("Above the mill", "0.9", "95", "30"):
            expect_in(part, text)


def test_new_csv():
    """n: a new scene from a CSV profile as QGIS writes it."""
    with Place() as place:
        place.write("line.csv", "distance,elevation\n0,150\n30,120\n80,80\n140,60\n200,55\n")
        made, saved = place.play("""key n Enter
            type line.csv
            key Enter Enter Enter Enter Enter
            type 150
            key Enter Enter Enter
            wait idle
            dump
            key s Ctrl-U
            type from-csv.yaml
            key Enter
            dump""")
        made.has("* My slope", "At 150 m", "Rock 0.6 m")
        saved.has("saved from-csv.yaml")
        check_good(place.path, "from-csv.yaml")
        expect_in("line.csv", place.text("from-csv.yaml"))
        again = place.play("wait idle\ndump", "from-csv.yaml")[0]
        expect_equal(again.now, made.now, "figures of the saved scene")


def test_new_refused():
    """n: invalid input is explained at its own question, and nothing is lost."""
    for fields, part in ((("x", "0 10"), "points x z"), (("x", "ten by ten"), "points x z"), (("x", "none.csv"), "none.csv"),
                         (("x", "0 60, 100 12", "100"), "rocks start at x, m: 100 itself is outside the range"),
                         (("x", "0 60, 100 12", "x"), "'x' is not a number"),
                         (("x", "0 60, 100 12", "", "100"), "face from the top to x, m: 100 itself is outside"), (("x", "0 60, 100 12", "", "x"), "'x' is not a number"),
                         (("x", "0 60, 100 12", "", "", "moon"), "no ground 'moon'"),
                         (("x", "0 60, 100 12", "", "", "talus", "-1"), "-1 is below 0 m"),
                         (("x", "0 60, 100 12", "", "", "talus", "wide"), "'wide' is not a number"),
                         (("x", "0 60, 100 12", "", "10", "talus", "0.6", "500"), "control at x, m: 500 is above 100 m"),
                         (("x", "0 60, 100 12", "", "10", "talus", "0.6", "5"), "control at x, m: 5 is below 10 m"),
                         (("x", "0 60, 100 12", "20", "10", "talus", "0.6", "15"), "control at x, m: 15 is below 20 m"),
                         (("x", "0 60, 100 12", "", "", "talus", "0.6", "90", "much"), "'much' is not a number")):
        script = "wait idle\nkey n\n"
        for field in fields:
            script += f"key Ctrl-U\ntype {field}\nkey Enter\n"
        refused, after = fast(script + "dump\n" + "key Esc\n" * len(fields) + "clear\ndump")
        refused.has("New scene", fields[-1])
        expect(part in refused.popup.split("stand ")[1], f"{fields} is not refused with a reason:", refused)
        after.has("1 5 45 upper")
        expect_in("fast", after.title)
    refused = fast("key n Enter Ctrl-U\ntype 0 1, 0 2, 0 3\n" + "key Enter\n" * 8 + "dump")[0]
    expect_in("New scene", refused.text, "x does not rise")


def test_new_bad_stand():
    """n: a missing stand is reported, not dropped silently."""
    screen = fast("key n Enter Enter Enter Enter Enter Enter Enter Enter Ctrl-U\ntype no-such-stand.yaml\nkey Enter\ndump")[0]
    expect_in("no stand 'no-such-stand.yaml'", screen.popup)


def test_missing_file():
    """A missing file is reported while typing; Tab completes a path."""
    with Place() as place:
        place.write("survey/profile-north.csv", "distance,elevation\n0,150\n200,55\n")
        place.write("survey/profile-south.csv", "distance,elevation\n0,150\n200,55\n")
        typed, half, whole = place.play("""key n Enter Ctrl-U
            type none.csv
            dump
            key Ctrl-U
            type sur
            key Tab
            type p
            key Tab
            dump
            type n
            key Tab
            dump""")
        typed.has("there is no file 'none.csv'")
        half.has("survey/profile-_", "survey/profile-north.csv", "survey/profile-south.csv")
        whole.has("survey/profile-north.csv_").lacks("there is no file")
        opened = place.play("key o\ntype nothing/here.yaml\ndump\nkey Enter\ndump")
        opened[0].has("there is no file 'nothing/here.yaml'")
        opened[1].has("No such file")


def test_open():
    """o: a shipped scene from the list, a file by its name, a missing one."""
    screens = fast("""wait idle
        key o
        dump
        type four
        key Enter
        dump
        key o
        type options.yaml
        key Enter
        dump
        key o
        type missing.yaml
        dump
        key Enter
        dump""")
    screens[0].has("fast.yaml", "yours", "(now)", "four-systems", "paper-site")
    own, shipped = (screens[0].popup.find(name) for name in ("options.yaml", "four-systems"))
    expect(0 <= own < shipped, "the user's own come first", screens[0])
    screens[1].has("Four systems", "Rock 0.68 m, 512.3 kg")
    screens[2].has("thick")
    screens[3].has("there is no file 'missing.yaml'")
    screens[4].has("thick")
    expect_in("No such file", screens[4].note)


def test_open_broken():
    """A scene whose stand is wrong is not opened: the message names file, line and column; scene and cursor stay"""
    stand = "ceduo: stand/1\nname: upper\nshoots:\n  - {per_ha: 9000, dbh_m: zero, height_m: 7}\n"
    with Place() as place:
        scene = place.text("fast.yaml")
        place.write("wrong.yaml", stand)
        place.write("broken.yaml", scene[:scene.index("forest:")] + "forest: [{from_m: 5, to_m: 45, stand: wrong.yaml}]\n")
        for view in (1, 3):
            before, after = place.play(f"key {view} Down Down\nwait idle\ndump\nkey o\ntype broken.yaml\nkey Enter\ndump")
            expect_equal(after.note, "nothing was opened: wrong.yaml:4:27: diameter, cm: 'zero' is not a number")
            expect_equal((after.title, after.body), (before.title, before.body), "the old scene")


def test_unsaved():
    """o, n and q ask equally about unsaved work: stay, save and continue, discard and continue."""
    edit = "key 3\nfind title\nset other\n"
    for key, then in (("o", "Open a scene"), ("n", "New scene"), ("q", None)):
        with Place() as place:
            asked, stayed = place.play(f"{edit}key {key}\ndump\nkey Enter\ndump")
            asked.has("There are unsaved changes", "n no: stay here", "s save them", "d discard them").lacks("search:")
            stayed.has("* other").lacks("There are unsaved changes")
            expect_in("title: fast", place.text("fast.yaml"))
            script = f"{edit}key {key}\nkey d\n"
            if then:
                place.play(script + "dump")[0].has(then)
            else:
                place.play(script)
            expect_in("title: fast", place.text("fast.yaml"), "discarded")
            script = f"{edit}key {key}\nkey x s\n"
            if then:
                place.play(script + "dump")[0].has(then)
            else:
                place.play(script)
            expect_in("title: other", place.text("fast.yaml"), f"saved before {key}")


def test_stands():
    """p in view 2 lists the user's stands first, each with stems, diameter of the mean basal area, age and basal area"""
    with Place() as place:
        place.write("mine.yaml", "ceduo: stand/1\nname: mine\nspecies: quercus-cerris\nstools: {per_ha: 1000, spacing_m: 0.4}\n"
                    "shoots: [{per_ha: 3000, dbh_m: 0.1, height_m: 9, age_y: 18}, {per_ha: 200, dbh_m: 0.05, height_m: 5, age_y: 6}]\n"
                    "trees: [{per_ha: 100, dbh_m: 0.3, height_m: 15}]\n")
        listed, wide = place.play("key 2\nkey p\ndump\nresize 200 50\ndump")
    area = math.pi / 4 * (3000 * 0.1 ** 2 + 200 * 0.05 ** 2 + 100 * 0.3 ** 2)
    dbh = 100 * math.sqrt(4 * area / math.pi / 3300)
    row = re.search(r"mine\.yaml +3300/ha +([\d.]+) cm +18 y +([\d.]+) m²/ha +yours", listed.popup)
    expect(row, listed)
    expect_equal(row.groups(), (f"{dbh:.1f}", f"{area:.1f}"))
    expect(listed.popup.index("mine.yaml") < listed.popup.index("from a sample plot") < listed.popup.index("ads-1"), listed)
    wide.whole().lacks("Marche")


def test_new_is_drawn():
    """n draws the typed profile, reversed if it rises, its steepest stretch marked, then release and face; grounds have
    explanations next to their names"""
    degrees = round(math.degrees(math.atan(35 / 10)))
    with Place() as place:
        typed, known, ground, counted, taken = place.play("""key n
            key Enter Ctrl-U
            type 0 0, 50 30, 60 65, 70 90
            dump
            key Enter
            dump
            key Enter Enter
            dump
            type talus
            key Enter Enter
            type 40
            dump
            key Enter Enter Enter
            dump""")
    for screen in (typed, known):
        screen.whole().has(f"┤ steepest, {degrees}°")
    typed.lacks("▼ release")
    known.has("70 m long and falls by 90 m", f"Steepest at 10 m, {degrees}°", "Reversed", "Rocks start at 0 m, on 68°", "▼ release")
    line = next(line for line in known.lines if "steepest," in line and "├" in line)
    axis = next(line for line in known.lines if re.search(r"0 m +10 +20 +30", line))
    for sign, number in (("├", "10"), ("┤", "20")):
        expect(abs(line.index(sign) - axis.index(f" {number} ") - 1) <= 1, f"the stretch from 10 to 20 m begins and ends at the axis' marks", known)
    line = next(line for line in counted.whole().lines if "▼ 40 m" in line)
    axis = next(line for line in counted.lines if re.search(r"0 m +10 +20 +30", line))
    expect(abs(line.index("▼ 40 m") - axis.index(" 40 ") - 1) <= 1, "the control is drawn where it is:", counted)
    ground.has("talus: loose blocks", "colluvium: a deep cover of soil and stones")
    taken.lacks("New scene").has("My slope")


def test_lines_of_a_profile():
    """n names the lines of a file with several, and accepts FILE.csv#LINE"""
    with Place() as place:
        place.write("two.csv", "layer,distance,elevation\ncrown,0,108\ncrown,60,38\nground,0,90\nground,40,40\nground,60,20\n")
        asked, known, saved = place.play("""key n
            key Enter Ctrl-U
            type two.csv
            key Enter
            dump
            type #ground
            key Enter
            dump
            key Enter Enter Enter Enter Enter Enter Enter
            key s Ctrl-U
            type new.yaml
            key Enter
            dump""")
        asked.whole().has("several lines: crown, ground; add one to the name: two.csv#crown")
        known.whole().has("two.csv: 3 points, 60 m long, falls 70 m; line 'ground' of 2")
        expect_in("layer: ground", (place.path / "new.yaml").read_text())


def test_a_survey_that_asks():
    """A survey whose slopes have no unit opens a form; the answer gives the stand of a head with that unit"""
    rows = "1;400;70;albero;20\n2;400;70;albero;22\n"
    with Place() as place:
        place.write("bare.csv", "saggio;superficie;pendenza;tipo;diametro\n" + rows)
        for answer, per_ha in (("degrees", 10000 / 400 / math.cos(math.radians(70))), ("percent", 10000 / 400 / math.cos(math.atan(0.7)))):
            asked, unanswered, understood, given = place.play(f"""key 2
                key p
                type from a survey
                key Enter
                key Ctrl-U
                type bare.csv
                key Enter
                dump
                key Enter
                dump
                type {answer}
                key Enter
                dump
                key Enter
                dump""")
            asked.whole().has("How to read the survey", "slopes are in", "degrees", "percent")
            unanswered.whole().has("How to read the survey")
            understood.whole().has("bare.csv: 2 plots of 400 m², 2 trees", "Enter again takes this stand")
            given.lacks("How to read the survey").has(f"{per_ha:.4g}")


def test_a_survey_understood():
    """The files of a survey are listed with .csv first; the note is how the marked table is understood, or why it is refused"""
    with Place() as place:
        place.write("a-notes.txt", "plot;area_m2;slope_deg;kind;dbh_cm\n1;400;0;tree;20\n")
        place.write("m-plots.csv", "plot;area_m2;slope_deg;kind;dbh_cm;note\n1;400;0;tree;20;x\n2;400;0;tree;22;y\n")
        place.write("z-bad.CSV", "plot;area_m2;slope_deg;kind;dbh_cm\n1;400;0;tree\n")
        (place.path / "folder").mkdir()
        first, bad, text, folder, taken = place.play("key 2 p\ntype from a survey\nkey Enter\ndump\nkey Down\ndump\nkey Down\ndump\n"
                                                     "key Down Down\ndump\nkey Home Enter\ndump")
    names = re.findall(r"(m-plots\.csv|z-bad\.CSV|a-notes\.txt|folder/) ", re.sub(r".*search: _", "", first.popup))
    expect_equal(names, ["m-plots.csv", "z-bad.CSV", "a-notes.txt", "folder/"], "files")
    expect(re.match(r"m-plots\.csv: 2 plots of 400 m², 2 trees.*; not used: note", first.popup), first)
    expect_in("z-bad.CSV:2", bad.popup)
    expect(text.popup.startswith("a-notes.txt: 1 plot of 400 m²"), text)
    expect(folder.popup.startswith("Columns: plot, area_m2"), folder)
    taken.lacks("search:").has("stand set from the survey")


def test_presets_in_view_3():
    """p in view 3 lists stands, as in the other views, and no rock of another scene"""
    list_, = fast("resize 120 50\nkey 3\nkey p\ndump")
    list_.has("Stand of belt 1, now 'upper'").lacks("rock: ", "start: ")


def test_picker():
    """Typing filters, best match first, marks the current value, and previews the lights of a choice."""
    all_, some, none, took = fast("""key 2
        wait idle
        key p
        dump
        type lresc
        dump
        type zzz
        dump
        key Backspace Backspace Backspace Enter
        wait idle
        dump""", "wood.yaml")
    all_.has("from a sample plot", "simple-coppice")
    expect(re.search(r"search: lresc_ large-reserves-cut", some.popup), "the best match first", some)
    expect(re.search(r"Contact (passes|FAILS).*free run .*energy .*about \d+ per 1000 above the limit", some.popup), some)
    none.has("nothing matches")
    expect_equal(took.row("^system")[1:], ["large", "reserves"], "the one that was under the cursor")
    now = fast("key 2\nkey p\ndump", "paper-site")[0]
    expect(re.search(r"ads-1 +9076.*\(now\)", now.text), "what is there now is marked", now)
    species = fast("key 2\nwait idle\nfind species\nkey Enter\ntype beech\ndump\nkey Enter\ndump", "wood.yaml")
    species[0].has("search: beech_", "beech (Fagus sylvatica)", "about")
    expect_equal(species[1].row("^species")[1:], ["beech", "(Fagus", "sylvatica)"])


def test_preview_is_what_comes():
    """The previewed lights of a choice equal those after it."""
    for name in ("bare", "simple-coppice", "large-reserves-cut"):
        ahead, after = fast(f"key 2\nwait idle\nkey p\ntype {name}\ndump\nkey Enter\nwait idle\ndump", "wood.yaml")
        found = re.search(r"Contact (\w+).*?free run (\w+).*?energy (\w+).*?about (\d+) per 1000", ahead.popup)
        expect(found, "no lights in", ahead.popup)
        expect_equal(list(found.groups()[:3]), [lights(after, "braille")[k] for k in ("Contact", "Free run", "Energy")], name)
        expect_near(float(found.group(4)), after.pair("above 250 kJ")[0], 60, f"{name}: of 1000")  # 4 standard errors of 1024 rocks
    keys = "key 5 a\ntype bare\nkey Enter 1 d 5 a\ntype simple-coppice\nwait idle\ndump\nkey Enter\nwait idle\ndump"
    ahead, after = fast(keys, "wood.yaml")  # next to an option without belts: the new one copies the first one's
    found = re.search(r"Contact (\w+).*?free run (\w+).*?energy (\w+)", ahead.popup)
    expect_equal(list(found.groups()), [lights(after, "braille")[k] for k in ("Contact", "Free run", "Energy")], ahead.popup)


def test_commands():
    """: lists every command by its action; typing filters, Enter runs it."""
    listed, ran = fast("key :\ndump\ntype rotation\nkey Enter\ndump")
    listed.has("Commands", "search: _")
    expect_in("6 rotation", ran.title)
    expect(ran.body != listed.body, ran)
    undone = fast("key 2\nfind stools.per_ha\nset 9\nkey :\ntype undo\nkey Enter\ndump")[0]
    expect_in("undone", undone.note)


# ---- search, help, counts ----

def test_search():
    """/ jumps to a field by label, value or path, N to the next, and reports a failed search."""
    screens = fast("""key 3
        key /
        dump
        type density
        key Enter
        dump
        key /
        key Ctrl-U
        type speed
        key Enter
        dump
        key N
        dump
        key N
        dump
        find zzz
        dump
        key /
        key Esc
        clear
        dump""")
    screens[0].has("Search in this view")
    expect(screens[1].note.startswith("density, kg/m³: "), screens[1].note)
    notes = [s.note.split(":")[0] for s in screens[2:5]]
    expect(notes[0] != notes[1] and {"speed along, m/s", "speed upward, m/s"} <= set(notes), notes)
    expect_in("'zzz' not found in this view", screens[5].note)
    expect_equal(screens[6].note.split(":")[0], notes[2], "the field after Esc")


def test_search_shown_words():
    """/ finds the head of a column, long or short, in the language shown, and words on the screen before paths"""
    for language, view, word, wanted in (("en", 2, "diam", "diameter, cm"), ("en", 1, "limit", "limit, kJ"), ("it", 1, "limite", "limite, kJ"),
                                         ("en", 2, "volume", "volume, m³"), ("it", 2, "scarto", "scarto diam., cm"), ("it", 2, "diam", "diametro, cm"),
                                         ("en", 1, "name", "name"), ("en", 1, "accepted_kJ", "limit, kJ")):
        with Place() as place:
            found, again = play.play(place.path, f"key {view}\nwait idle\nfind {word}\ndump\nkey N\ndump", "fast.yaml", "--language", language)
        expect(found.note.startswith(f"{wanted}: "), f"{language}, {word}: {found.note!r}")
        expect(again.note.startswith(f"{wanted}: "), f"{language}, {word} again: {again.note!r}")
    (label,) = fast("key 3\nfind rock\ndump")
    expect("rock" in label.note.split(":")[0], f"a path is found before a label: {label.note!r}")


def test_help():
    """? has every key of the program with its action, F1 too; the bar has the main ones."""
    rows = actions()
    for key in ("?", "F1"):
        tall, closed = fast(f"resize 120 100\nwait idle\nkey {key}\ndump\nkey Esc\ndump")
        for name, word, word2, bar, text in rows:
            pattern = re.escape(word) + (r" +" + re.escape(word2) if word2 else "") + r" +" + re.escape(text)
            expect(re.search(r"[│|] +" + pattern, tall.text), f"{name}: {word} {word2} {text} is missing in the", tall)
        closed.lacks("Figures and pictures follow every edit at once")
    for heading in ("Moving", "Changing", "Views", "Exploring", "Files", "Screen", "Words"):
        expect(re.search(rf"[│|] {heading} +[│|]", tall.text), f"the heading {heading}", tall)
    expect_in("mean distance between stem hits", tall.text, "the glossary")
    for view in "123456":
        bar = fast(f"key {view}\ndump")[0].bar
        for name, word, word2, shown, text in rows:
            if shown == 2:
                expect_in(f"{word} {text}", bar, f"{name} in the bar of view {view} at 80 columns")


def test_end():
    """End goes to the last line of texts, forms and lists, and to the end of typed text; the next key moves from there, also
    without drawing in between."""
    with Place() as place:
        place.write("many.yaml", FAST + "observed:\n" + "".join(
            f"  - {{name: nr {i}, passed: {{x_m: 60, count: {i}, of: 100}}}}\n" for i in range(1, 90)))
        for keys, scene in (("?", "fast.yaml"), ("4", "wood.yaml"), ("8 Tab", "many.yaml"), (":", "fast.yaml"), ("3", "fast.yaml")):
            start = f"wait idle\nkey {keys}\nwait idle\n"
            last, before, after = (place.play(f"{start}key {more}\ndump", scene)[0].text for more in ("End", "End Up", "End Up Down"))
            read = place.play(start + "key PgDn\n" * 40 + "dump", scene)[0].text
            expect_equal(last, read, f"End after {keys}, and PgDn to the end")
            expect_equal(after, last, f"End, Up and Down after {keys}")
            expect(before != last, f"Up after End in {keys} does nothing:", before)
        (line,) = place.play("key / Ctrl-U\ntype rock\nkey Home End\ntype s\ndump")
        line.has("word rocks_")


def test_notes_after_the_last_field():
    """At the end of a form the notes after its last field are visible."""
    many = ", ".join(f"[{x / 10}, {100 - x / 20}]" for x in range(1500))
    with Place() as place:
        place.write("long.yaml", re.sub(r"vertices_m:.*?(?=controls:)", f"vertices_m: [{many}]\n  segments: [{{rn: 0.3, rt: 0.9}}]\n",
                                        FAST, flags=re.S))
        (screen,) = place.play("key 1 End\ndump", "long.yaml")
        screen.has("too many vertices to list")


def test_help_field():
    """? begins with the keys of the view and the full explanation of the field under the cursor."""
    line, helped = fast("key 2\nfind stools.per_ha\ndump\nkey ?\ndump", "paper-site")
    expect(line.note.endswith("…"), line.note)
    wide = fast("resize 300 24\nkey 2\nfind stools.per_ha\ndump", "paper-site")[0]
    expect_in("Table 1", wide.note, "the source")
    keys = "In this view, 2 stand Enter edit p F5 stands c sample plot a add d Del delete "
    expect(helped.popup.startswith(keys + re.sub(" +", " ", wide.note) + " Figures and pictures follow every edit at once"), wide.note, helped)
    expect(re.match("In this view, 4 results Down j scroll w F6 export . next option Figures", fast("key 4\nkey ?\ndump")[0].popup), "no field")


def test_help_scrolls():
    """The help scrolls to its end at 80x24."""
    pages = fast("wait idle\nkey ?\ndump\n" + "key PgDn\ndump\n" * 9 + "key g\ndump\nkey q\ndump")
    text = "\n".join(p.text for p in pages[:10])
    for name, word, word2, bar, what in actions():
        expect_in(what, text, name)
    expect_in("select text in the terminal", re.sub(r"\s+[│|]\n.?[│|]\s+", " ", text))
    expect_equal(pages[10].text, pages[0].text, "after g")
    pages[11].lacks("─Keys")


def test_help_pages():
    """In ? Space goes on by a page and keeps one line; / marks the next line with a word, N the one after it, from the end again."""
    script = "key ?\ndump\nkey Space\ndump\nkey /\ntype trajectory\ndump\nkey Enter\ndump\nroles 0.txt\nkey N\ndump\nroles 1.txt\n" \
             "key N\ndump\nroles 2.txt\nkey / Ctrl-U\ntype zzz\nkey Enter\ndump\nkey / Esc x\ndump"
    with Place() as place:
        first, second, typing, *found, missing, closed = place.play(script)
        roles = [place.text(f"{i}.txt").split("\n") for i in range(3)]
    lines = [[line[line.index("│") + 2:].rstrip("│ ") for line in s.lines[2:22]] for s in (first, second)]
    expect_equal(lines[1][0], lines[0][-1], "the last line of a page is the first of the next")
    typing.has("search: trajectory_", "Enter search  Esc cancel")
    marked = [[screen.lines[i][2:] for i, line in enumerate(letters) if "xxx" in line[3:] and 1 < i < 22] for screen, letters in zip(found, roles)]
    expect_equal([" ".join(lines).replace("│", "").split() for lines in marked],
                 [[".", "next", "trajectory"], [",", "previous", "trajectory"], [".", "next", "trajectory"]], "the marked lines")
    missing.has("'zzz' not found")
    closed.lacks("─Keys")


def test_contract_keys():
    """Every documented key is in the table."""
    words = {w for _, word, word2, _, _ in actions() for w in (word, word2)}
    for key in ["Up", "Down", "Left", "Right", *"hjkl", "Tab", "Shift-Tab", *"123456", "Enter", "+", "-", *"adyu", "Ctrl-R",
                *"nospw", "/", "?", "F1", "q", "F10"]:
        expect(key in words, f"{key} is no key of the program")


def counts_script(*fields):
    """Fill the form of the counts for the second belt, and return four screens: before, filled, done, left by Esc."""
    script = "key 2\nwait idle\nfind forest[1]\ndump\nkey c\n"
    for field in fields:
        script += f"key Ctrl-U\ntype {field}\nkey Tab\n"
    return script + "dump\nkey Enter\ndump\n" + "key Esc\n" * (len(fields) + 1) + "clear\ndump"


COUNTED = ["400", "40", "100", "250", "7,5", "8", "20", "18", "13"]


def test_counts():
    """c: counts of a plot to hectares: 400 m2 along a slope of 40 degrees are 306.4 m2; sizes of stems count too."""
    area = 400 * math.cos(math.radians(40))
    for how, per in (("40", 10000 / area), ("0", 25)):
        with Place() as place:
            before, form, screen, _ = place.play(counts_script(COUNTED[0], how, *COUNTED[2:]) + "\nkey s", "fast.yaml")
            lower = place.text("fast.yaml").split("to_m: 80")[1]
        form.has("Stand from a sample plot", "size of the plot, m²", "angle", "their mean diameter, cm")
        rows = [re.findall(r"^\d +(\S+) +(\S+) +(\S+)", part, re.M) for part in re.split(r"\n    per h(?:a|ectare)\b", screen.body)[1:]]
        found = [float(screen.row("^stools per ha")[-1]), float(rows[0][0][0]), float(rows[1][0][0])]
        for value, count in zip(found, (100, 250, 20)):
            expect_equal(f"{value:.4g}", f"{count * per:.4g}", f"{how}: {count} in the plot, per ha, to the digits of a form")
        for value, count in zip(re.findall(r"per_ha: ([\d.]+)", lower), (100, 250, 20)):
            expect_near(float(value), count * per, count * per * 1e-5, f"{how}: {count} in the plot, per ha of the file")
        expect_equal(rows[0][0][1:] + rows[1][0][1:], ("7.5", "8", "18", "13"), "diameters and heights")
        expect_equal([len(r) for r in rows], [1, 1], "one class of each")
        expect_in("306.4 m²" if how == "40" else "400 m²", screen.note)
        expect_in("32.64" if how == "40" else "25", screen.note)
        expect(screen.now != before.now, "the figures stay as they were")
    expect_near(10000 / area, 10000 / 306.4, 0.005, "this test's own arithmetic")


def test_counts_of_nothing():
    """c: uncounted stems are missing: a plot without stools, one without trees, an empty one."""
    no_stools = fast(counts_script(*COUNTED[:2], "", "", "", "", "20", "22", "13"))[2]
    expect_equal(no_stools.row("^stools per ha")[-1], "-", "stools")
    expect_in("Shoots on the stools none; a adds one", re.sub(r"\s+", " ", re.sub(r"\n +per h[^\n]*", "", no_stools.body)))
    no_trees = fast(counts_script(*COUNTED[:6], "0", "", ""))[2]
    expect_in("reserves none; a adds one", re.sub(r"\s+", " ", re.sub(r"\n +per h[^\n]*", "", no_trees.body)))
    empty = fast(counts_script(*COUNTED[:2], "", "", "", "", "", "", ""))[2]
    expect_in("FAILS", empty.lights().values())


def test_counts_refused():
    """c: impossible counts are refused with a reason, nothing changes; unusual ones need one confirmation."""
    for at, value, part in ((0, "0", "0 itself is outside"), (0, "-4", "-4"), (1, "90", "90 itself is outside"),
                            (1, "x", "'x' is not a number"), (2, "3,5,5", "'3,5,5' is not a number"), (3, "50", "at least one shoot"),
                            (2, "", "belong together"), (3, "nan", "'nan' is not a number"), (4, "0", "0 itself is outside"),
                            (4, "900", "900 cm? Usual is"), (8, "1000", "above 150 m"), (0, "1e-320", ""), (2, "1e300", "")):
        later = COUNTED[at + 1:] if (at, value) in ((2, ""), (3, "50"), (0, "1e-320"), (2, "1e300")) else []
        before, filled, refused, after = fast(counts_script(*COUNTED[:at], value, *later))
        (refused if later or at == 8 else filled).has("Stand from a sample plot", part)
        expect_equal(after.text, before.text, f"after {value!r} and Esc")
    taken = fast(counts_script(*COUNTED[:4], "900", *COUNTED[5:]).replace("type 900\nkey Tab", "type 900\nkey Tab Tab"))[2]
    taken.lacks("Stand from a sample plot")


def test_keys_at_once():
    """Keys that arrive together act as one by one with a screen between."""
    slow = fast("".join(f"key {k}\ndump\n" for k in ("2", "Down", "p", "End", "Enter")) + "wait idle\nclear\ndump")[-1]
    quick = fast("key 2 Down p End Enter\nwait idle\nclear\ndump")[0]
    expect_equal(quick.text, slow.text, "view 2, the second belt's stand from a preset")
    keys = ["5", "Down", "y", ">", "2", "Down", "Down", "Down", "+", "1", "G", "4", "j", "5", "Up", "d"]
    for scene in ("options.yaml", "cuts.yaml"):
        slow = fast("wait idle\n" + "".join(f"key {k}\ndump\n" for k in keys) + "wait idle\nclear\ndump", scene)[-1]
        quick = fast(f"wait idle\nkey {' '.join(keys)}\nwait idle\nclear\ndump", scene)[0]
        expect_equal(quick.text, slow.text, "options and fields")


def test_drawn_or_not():
    """Drawing a view has no effect on later screens."""
    drawn = fast("resize 100 40\nwait idle\nkey 1\ndump\nkey 2\ndump", "wood.yaml")[-1]
    never = fast("resize 100 40\nwait idle\nkey 1\nkey 2\ndump", "wood.yaml")[-1]
    expect_equal(never.text, drawn.text, "view 2 where view 1 was not drawn before")


def test_new_is_data():
    """n: text typed into a field is that field's value, never more of the file."""
    for field, text in ((3, "0.5, density_kg_m3: 7000"), (3, "0.5}\\nx: {"), (4, "90, accepted_kJ: 1"), (5, "50}, {x_m: 95"),
                        (2, "talus}, {from_m: 0"), (6, "bare}, {from_m: 91, to_m: 95, stand: bare")):
        script = "wait idle\nkey n\n" + "key Enter\n" * field + f"key Ctrl-U\ntype {text}\n" + "key Enter\n" * (7 - field)
        refused = fast(script + "dump")[0]
        expect("New scene" in refused.text or refused.title.endswith(" fast"), f"{text!r} was taken as YAML:", refused)


def test_popup_bar():
    """The bar has the keys of an open popup, and the view's after it."""
    for keys, words in (("p", ("type to search", "Enter choose", "Esc cancel")), ("q", ("a letter", "Enter", "Esc cancel")),
                        ("?", ("Up Down", "any other key closes")), ("n", ("Enter next", "Esc back")),
                        ("w End Enter", ("any other key closes",))):
        for width in (60, 80, 200):
            edit = "find stools.per_ha\nkey +\n" if keys == "q" else ""
            over, closed = fast(f"resize {width} 24\nkey 2\n{edit}key {keys}\ndump\nkey Esc\ndump")
            for word in words:
                expect_in(word, over.bar, f"{keys} at {width} columns")
            expect("edit" not in over.bar and "undo" not in over.bar, over.bar)
            expect_in("Enter edit", closed.bar, "closed")


def test_bar_without_form():
    """The bar of a view without a form does not list keys that act on its lines"""
    for view in "48":
        for width in (60, 80, 200):
            screen = fast(f"resize {width} 24\nkey {view}\nwait idle\ndump")[0]
            for word in ("Enter ", "f find", *["a add"] * (view == "4")):
                expect(word not in screen.bar, f"{word!r} in the bar of view {view} at {width} columns: {screen.bar}")
            expect_in("q quit", screen.bar, "the bar")


def test_more_in_popups():
    """Help and lists longer than their window show their position and mark more text below and above."""
    for keys in ("?", "p"):
        first, middle, last = fast(f"key 2\nkey {keys}\ndump\nkey PgDn PgDn\ndump\nkey End\ndump")
        first.has(" ▼ ─┘").lacks("▲")
        middle.has(" ▲▼ ─┘")
        last.has(" ▲ ─┘").lacks("▼")
        fast(f"resize 120 100\nkey 2\nkey {keys}\ndump")[0].lacks("▼ ─┘", "▲ ─┘")
    fast("find stand\nkey 3\nfind shape\nkey Enter\ndump")[0].has("sphere").lacks("▼ ─┘", "▲ ─┘")


def test_share_above_one():
    """f: a share above 100 % or 1000 of 1000 is refused with its number, one of 100 % is looked for."""
    for down, typed, said in (("Down", "120", "120 % is impossible"), ("Down Down", "1001", "1001 per 1000 is impossible"),
                              ("Down", "100", "every value of the range reaches the goal")):
        fast(f"key 2 f {down} Enter\ntype {typed}\nkey Enter Enter Enter Enter\nwait idle\ndump")[0].has(said)


def test_popups_small():
    """Popups over the smallest screen stay within it."""
    for keys in ("?", "p", "n", "o", "w", "c", "/", "s"):
        fast(f"key 2\nresize 60 16\nkey {keys}\ndump", "paper-site")[0].whole()


if __name__ == "__main__":
    run_all(__name__)
