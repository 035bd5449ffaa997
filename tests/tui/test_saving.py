#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Saving and exporting in the terminal program: under another name, failures, and messages about comments and copies."""
import json
import os
import re
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import CUTS, FAST, Place, check_good, fast, run_script  # noqa: E402
from harness import PROFILES, Skip, expect, expect_equal, expect_in, expect_near, results, run_all  # noqa: E402
from test_editing import read_index  # noqa: E402

EDIT = "key 2\nkey /\nkey Ctrl-U\ntype stools.per_ha\nkey Enter Enter\ntype 1234\nkey Enter\n"
STUCK = "stuck.yaml"


def stools(per_ha):
    """Return the fast scene with n stools in its upper forest."""
    return FAST.replace("per_ha: 3000", f"per_ha: {per_ha}")


def test_save_as():
    """S saves under another name, which the scene keeps; the former file stays unchanged."""
    with Place() as place:
        asked, saved, again = place.play(EDIT + "key S\ndump\nkey Ctrl-U\ntype other.yaml\nkey Enter\ndump\n"
                                         "find stools.per_ha\nset 999\nkey s\ndump")
        asked.has("Save as", "fast.yaml")
        expect_equal(saved.note, "saved other.yaml")
        expect_equal(again.note, "saved other.yaml")
        expect("* fast" not in again.title, again.title)
        expect_equal(place.text("fast.yaml"), FAST, "the file of before")
        expect_equal(place.text("other.yaml"), stools(999), "the other file")


def test_ending():
    """A name without an ending gets .yaml; one with an ending, and an existing file's, stay as they are."""
    with Place() as place:
        for typed, name in (("bosco", "bosco.yaml"), ("b.2026/bosco", "b.2026/bosco.yaml"), (".bosco", ".bosco.yaml"),
                            ("bosco.yml", "bosco.yml"), ("bosco.txt", "bosco.txt")):
            (place.path / "b.2026").mkdir(exist_ok=True)
            saved, again = place.play(EDIT + f"key S Ctrl-U\ntype {typed}\nkey Enter\ndump\nkey S Ctrl-U\ntype {typed}\nkey Enter\ndump")
            expect_equal(saved.note, f"saved {name}")
            expect_equal(again.note, f"saved {name}")
            expect_equal(place.text(name), stools(1234), name)
        expect(not (place.path / "bosco").exists(), "a file without an ending was written")
        (asked,) = place.play("key S Ctrl-U\ntype bosco\nkey Enter\ndump")
        asked.has("bosco.yaml", "the file exists")
        place.write("taken", "")
        (asked,) = place.play("key S Ctrl-U\ntype taken\nkey Enter\ndump")
        asked.has("the file exists").lacks("taken.yaml")


def test_save_as_same():
    """S with the scene's own name saves like s, but does not overwrite a changed file."""
    with Place() as place:
        place.play(EDIT + "key S Enter")
        expect_equal(place.text("fast.yaml"), stools(1234), "the file")
        asked = place.play(EDIT + "dump fast.yaml\nkey S Enter\ndump")[0]
        asked.has("Enter again replaces it")
        expect(place.text("fast.yaml").startswith(" 1 slope"), "written over at once")


def test_inputs_kept():
    """Neither S nor w replaces a file that the scene is read from, or a folder; a report ends in .html."""
    profile = "distance,elevation\n0,80\n60,30\n100,0\n"
    scene = FAST[:FAST.index("slope:")] + "slope: p.csv\n" + FAST[FAST.index("controls:"):]
    with Place() as place:
        place.write("p.csv", profile)
        place.write("read.yaml", scene)
        (place.path / "sub.yaml").mkdir()
        screens = place.play("""\
            wait idle
            key S Ctrl-U
            type p.csv
            key Enter Enter
            dump
            key Ctrl-U
            type sub.yaml
            key Enter Enter
            dump
            key Esc w Down Down Down Enter Ctrl-U
            type read.yaml
            key Enter Enter
            dump
            key Esc w Down Down Down Down Down Enter Enter Enter Enter Enter Enter Enter
            dump
            key Ctrl-U
            type read.pdf
            key Enter Enter
            dump""", "read.yaml")
        for screen, text in zip(screens, ("the scene is read from this file", "Is a directory", "the scene is read from this file",
                                          "a report, as HTML", "'read.pdf' does not end in .html or .htm")):
            screen.has(text)
        expect_equal(place.text("p.csv"), profile)
        expect_equal(place.text("read.yaml"), scene)
        expect(not (place.path / "read.pdf").exists(), "a page that no browser opens")


def test_folder_kept():
    """S proposes the file with its folder: a name changed at its end stays in it."""
    with Place() as place:
        (place.path / "sub").mkdir()
        place.write("sub/fast.yaml", FAST)
        asked = place.play("key S\ndump\nkey End Backspace Backspace Backspace Backspace Backspace\ntype r.yaml\nkey Enter",
                           "sub/fast.yaml")[0]
        asked.has("sub/fast.yaml")
        expect_equal(place.text("sub/fastr.yaml"), FAST, "beside it")


def test_references():
    """S into another folder keeps every reference of the scene, and so does each later s."""
    with Place() as place:
        start = FAST.index("    stand:\n      name: upper")
        wood = FAST[start:FAST.index("  - from_m: 50")]
        place.write("a/stands/wood.yaml", "ceduo: stand/1\n" + "".join(f"{line[6:]}\n" for line in wood.splitlines()[1:]))
        place.write("a/scenes/s.yaml", FAST.replace(wood, "    stand: ../stands/wood.yaml   # kept: of May\n"))
        (place.path / "b").mkdir()
        whole = FAST.replace(wood, f"    stand: {place.path.resolve()}/a/stands/wood.yaml   # kept: of May\n")
        before, after = place.play("key 2\nwait idle\ndump\nkey S Ctrl-U\ntype b/t.yaml\nkey Enter\nkey 3\nfind rock.diameter_m\n"
                                   "set 0.75\nkey s u s\nkey 2\nclear\nwait idle\ndump", "a/scenes/s.yaml")
        expect_equal(place.text("b/t.yaml"), whole, "saved three times")
        expect_equal(after.now, before.now, "its figures")
        expect_equal(place.play("key 2\nwait idle\ndump", "b/t.yaml")[0].now, before.now, "the saved scene's figures")


def stuck(place):
    """STUCK is readable, but the path of its replacement is too long, for root too."""
    deep = place.path.resolve()
    while (rest := 4090 - len("/fast.yaml") - len(str(deep))) > 0:
        deep = deep / ("n" * (100 if rest > 202 else rest - 1))
    (place.path / STUCK).symlink_to(place.write(deep / "fast.yaml", FAST).relative_to(place.path.resolve()))


def test_failed():
    """If a file cannot be written the reason is reported and another name requested; with that one it works."""
    with Place() as place:
        stuck(place)
        failed, stayed, saved = place.play(EDIT + "key s\ndump\nkey Esc\ndump\nkey s Ctrl-U\ntype mine.yaml\nkey Enter\ndump",
                                           STUCK)
        failed.has("Save as", "File name too long", "another name")
        expect("* fast" in stayed.title, stayed.title)
        expect_equal(saved.note, "saved mine.yaml")
        expect("* fast" not in saved.title, saved.title)
        expect_equal(place.text(STUCK), FAST, "the file that could not be written")
        expect_in("per_ha: 1234", place.text("mine.yaml"))


def test_fifo_name():
    """An existing FIFO needs a confirmation like any file, and is not awaited."""
    with Place() as place:
        os.mkfifo(place.path / "fifo")
        asked = place.play(EDIT + "key S Ctrl-U\ntype fifo\nkey Enter\ndump\nkey Esc w Enter Ctrl-U\ntype fifo\nkey Enter\ndump")
        for screen in asked:
            screen.has("the file exists")


def test_failed_quit():
    """'save and quit' with an unwritable file quits only after saving under another name."""
    with Place() as place:
        stuck(place)
        failed = place.play(EDIT + "key q Down Enter\ndump\nkey Esc\ndump\nkey S Ctrl-U\ntype a.yaml\nkey Enter\ndump", STUCK)
        failed[0].has("Save as", "File name too long")
        expect("* fast" in failed[1].title, failed[1].title)
        expect_equal(failed[2].note, "saved a.yaml", "Esc took the quitting back")
        run_script(place.path, EDIT + "key q Down Enter Ctrl-U\ntype b.yaml\nkey Enter\ndump late.txt\n", STUCK)
        expect_in("per_ha: 1234", place.text("b.yaml"))
        expect("late.txt" not in place.names(), "still there after it was saved")


def test_anew():
    """An old file is named only if it is next to the new one; for a copied scene the missing part is reported."""
    with Place() as place:
        saved = place.play("key 1\nfind stand\nkey a\nkey s Ctrl-U\ntype my.yaml\nkey Enter\ndump", "paper-site")[0]
        expect("# Test site" not in place.text("my.yaml"), "this test's own scene keeps its comments")
        expect("my.yaml.bak" not in place.names() and ".bak" not in saved.note, saved.note)
        expect_equal(saved.note, "saved my.yaml; reformatted, without the comments of paper-site.yaml")
        check_good(place.path, "my.yaml")
        saved = place.play("key 1\nfind stand\nkey d\nkey s\ndump\nclear\nkey u s\ndump", "fast.yaml")
        expect_equal(saved[0].note, "saved fast.yaml; reformatted, the old file is fast.yaml.bak")
        expect_equal(saved[1].note, "saved fast.yaml", "what the program laid out itself is no loss")
        expect_equal(place.text("fast.yaml.bak"), FAST, "the old file, with its comments, still")


def test_save():
    """s writes the changed values and keeps every comment and every other line."""
    with Place() as place:
        saved, again = place.play("""key 2
            find stools.per_ha
            set 2222
            key s
            dump
            key 3
            find rock.diameter_m
            set 0.75
            key s
            dump""")
        expect_in("saved fast.yaml", saved.note)
        expect_in("saved fast.yaml", again.note)
        expect("* fast" not in again.title, again.title)
        wanted = stools(2222).replace("diameter_m: 0.5", "diameter_m: 0.75")
        expect_equal(place.text("fast.yaml"), wanted, "the file")
        expect_equal(sorted(n for n in place.names() if n.startswith("fast")), ["fast.yaml"], "files")


def test_save_list():
    """s after adding or deleting an item: valid, comments kept if possible, otherwise in a .bak."""
    for keys in ("find trees[0]\nkey y", "find trees[0]\nkey d", "find forest[0]\nkey d", "find shoots[1]\nkey d d"):
        with Place() as place:
            saved = place.play(f"key 2\n{keys}\nclear\nwait idle\nkey s\ndump\nclear\ndump")
            expect_in("saved fast.yaml", saved[0].note)
            check_good(place.path, "fast.yaml")
            text = place.text("fast.yaml")
            if "kept: the first line" not in text or "kept: found on the road" not in text:
                expect_equal(place.text("fast.yaml.bak"), FAST, "the old file beside it")
                expect_in("fast.yaml.bak", saved[0].note)
            after = place.play("key 2\nwait idle\ndump")[0]
            expect_equal(after.now, saved[1].now, "figures of the saved scene")


def test_save_nothing():
    """s without a change writes the same file; undone edits are no change."""
    with Place() as place:
        place.play("key s")
        expect_equal(place.text("fast.yaml"), FAST, "the file")
        screen = place.play("key 2\nfind stools.per_ha\nkey + + - u u u\nkey s\ndump")[0]
        expect("* fast" not in screen.title, screen.title)
        expect_equal(place.text("fast.yaml"), FAST, "the file")


def test_save_shipped():
    """A shipped scene is never overwritten: s asks for a name."""
    shipped = PROFILES / "scenes/paper-site.yaml"
    before, stamp = shipped.read_bytes(), shipped.stat().st_mtime_ns
    with Place() as place:
        named, asked, saved, later = place.play("""key 2
            find stools.per_ha
            set 2000
            key s
            dump
            key Ctrl-U
            type thinned
            key Enter
            dump
            key Enter
            dump
            find stools.per_ha
            set 1500
            key s
            dump""", "paper-site")
        named.has("Name of the changed stand", "ADS 1 (changed)", "from 0 to 67.5 m in 'current'")
        asked.has("Save as", "cannot be changed", "paper-site.yaml")
        expect_in("saved paper-site.yaml", saved.note)
        expect_in("saved paper-site.yaml", later.note)
        check_good(place.path, "paper-site.yaml")
        expect_in("# Test site in central Italy", place.text("paper-site.yaml"), "its comments")
        again = place.play("key 2\ndump", "paper-site.yaml")[0]
        expect_equal(again.row("^stools per ha")[-1], "1500", "stools")
        expect_in("Stand of belt 1: thinned", again.text, "its own name; it is not asked for again")
        # straight onto the shipped file by its path
        asked = place.play(f"key 2\nfind stools.per_ha\nset 9\nkey s Enter\nkey Ctrl-U\ntype {shipped}\nkey Enter\ndump\n"
                           "key Enter\ndump", "paper-site")
        expect(shipped.read_bytes() == before and shipped.stat().st_mtime_ns == stamp, "the shipped file was written!")
    expect(shipped.read_bytes() == before and shipped.stat().st_mtime_ns == stamp, "the shipped file was written!")


def test_save_as_exists():
    """Save as over another file needs a confirmation; an empty name and a missing folder are refused."""
    with Place() as place:
        place.write("there.yaml", "mine\n")
        screens = place.play("""key 2
            find stools.per_ha
            set 2000
            key s Enter Ctrl-U Enter
            dump
            type no/such/folder.yaml
            key Enter
            dump
            key Ctrl-U
            type there.yaml
            key Enter
            dump
            key Esc
            clear
            dump""", "paper-site")
        screens[0].has("a name is needed")
        screens[1].has("No such file or directory")
        screens[2].has("Enter again replaces it")
        expect("* Test site of" in screens[3].title, screens[3].title)
        expect_equal(place.text("there.yaml"), "mine\n", "the other file")
        place.play("key 2\nfind stools.per_ha\nset 2000\nkey s Enter Ctrl-U\ntype there.yaml\nkey Enter Enter", "paper-site")
        check_good(place.path, "there.yaml")


def test_changed_on_disk():
    """s on a file changed on disk asks: cancel, another name, or overwrite."""
    for keys, mine in (("key Enter", False), ("key Esc", False), ("key End Enter", True),
                       ("key Down Enter Ctrl-U\ntype mine.yaml\nkey Enter", False)):
        with Place() as place:
            # The script itself writes other bytes into the open file.
            asked = place.play(f"key 2\nfind stools.per_ha\nset 1234\ndump fast.yaml\nkey s\ndump\n{keys}")[0]
            asked.has("The file has changed on disk since it was read")
            now = place.text("fast.yaml")
            if mine:
                expect_in("per_ha: 1234", now, keys)
                check_good(place.path, "fast.yaml")
            else:
                expect(now.startswith(" 1 slope"), f"{keys}: the file was written over:", now[:400])
            if "mine.yaml" in keys:
                expect_in("per_ha: 1234", place.text("mine.yaml"))


def test_read_only():
    """An unwritable file: the reason is reported, the work stays unsaved, the file unchanged."""
    if os.geteuid() == 0:
        raise Skip("root may write everywhere")
    with Place() as place:
        os.chmod(place.path, 0o500)
        try:
            screen = place.play("key 2\nfind stools.per_ha\nset 2000\nkey s\ndump")[0]
        finally:
            os.chmod(place.path, 0o700)
        expect_in("Permission denied", screen.note)
        expect("* fast" in screen.title, screen.title)


def test_quit():
    """q ends at once if nothing is unsaved, otherwise it asks: stay, save, discard."""
    with Place() as place:
        run_script(place.path, "key q\ndump late.txt\n", "fast.yaml")
        expect("late.txt" not in place.names(), "still there after q")
        edit = "key 2\nkey /\ntype stools.per_ha\nkey Enter Enter\ntype 1234\nkey Enter\n"
        asked = place.play(edit + "key q\ndump\nkey Enter\ndump\nkey q Esc\ndump\nkey F10\ndump")
        asked[0].has("There are unsaved changes", "stay here", "save them", "discard them")
        asked[1].has("* fast").lacks("There are unsaved changes")
        asked[2].has("* fast").lacks("There are unsaved changes")
        asked[3].has("There are unsaved changes")
        expect_equal(place.text("fast.yaml"), FAST, "the file after staying")
        run_script(place.path, edit + "key q End Enter\ndump late.txt\n", "fast.yaml")
        expect("late.txt" not in place.names(), "still there after 'quit and lose it'")
        expect_equal(place.text("fast.yaml"), FAST, "the file after losing")
        run_script(place.path, edit + "key q Down Enter\ndump late.txt\n", "fast.yaml")
        expect("late.txt" not in place.names(), "still there after 'save and quit'")
        expect_in("per_ha: 1234", place.text("fast.yaml"), "the file after saving")
        named, shipped = place.play(edit + "key q Down Enter\ndump\nkey Enter\ndump", "paper-site")
        named.has("Name of the changed stand")
        shipped.has("Save as")


def test_save_as_then_quit():
    """'save and quit' on a shipped scene quits after the name is given."""
    with Place() as place:
        edit = "key 2\nkey /\ntype stools.per_ha\nkey Enter Enter\ntype 1234\nkey Enter\n"
        run_script(place.path, edit + "key q Down Enter Enter Enter\ndump late.txt\n", "paper-site")
        check_good(place.path, "paper-site.yaml")
        expect("late.txt" not in place.names(), "still there after it was saved")


# ---- export ----

def test_export():
    """w: the page, the whole page, screen, CSV and JSON in files; an existing one needs a confirmation."""
    with Place() as place:
        screens = place.play("""wait idle
            dump
            key w
            wait idle
            dump
            key Enter
            dump
            key Enter
            dump
            key w Down Enter Enter
            key w Down Down Enter Enter
            key w Down Down Down Enter Ctrl-U
            type table.csv
            key Enter
            key w Down Down Down Down Enter Enter
            key w Down Down Down Down Down Enter Enter Enter Enter Enter Enter Enter Enter
            clear
            key w Enter Enter
            dump
            key Esc
            key w Enter Ctrl-U
            type no/such/file.txt
            key Enter
            dump""", "options.yaml")
        screens[1].has("the page, as text", "the whole page", "this screen, with its picture", "CSV", "JSON", "the batch command")
        screens[2].has("the page, as text", "ceduo.txt")
        expect_in("written: ceduo.txt", screens[3].note)
        screens[4].has("Enter again replaces it")
        screens[5].has("No such file or directory")
        page, whole = place.text("ceduo.txt"), place.text("ceduo-details.txt")
        for part in ("thick", "thin", "none left"):
            expect_in(part, page, "the page")
        for part in ("fast", "thick", "thin", "none left", "At 80 m"):
            expect_in(part, whole, "the whole page")
        expect(page.count("\n") < whole.count("\n"), "the page is the short one", page, whole)
        written = re.sub(r"(\d+ rocks) so far", r"finished, \1", place.text("ceduo-screen.txt"))  # w also computes the page's figures
        old, new = screens[0].text.split("\n"), written.split("\n")
        expect(re.match(r" road \(80 m\): ✔ YES so far, also without forest: 0 of 1000 +uncertainty \d+ %$", new[1]), "the answer until that is computed", new[1])
        expect_equal(new[:1] + new[2:], old[:1] + old[2:], "the rest of the screen as a file")
        rows = place.text("table.csv").splitlines()
        expect(rows[0].startswith("scene,title,") and len(rows) == 1 + 3 * 2, rows)
        report = place.text("ceduo.html")
        for part in ("<h1>", "thick", "none left", "ceduo --report report.html -n ", "was not computed"):
            expect_in(part, report, "the report")
        line = json.loads(place.text("ceduo.json"))
        expect_equal([o["name"] for o in line["options"]], ["thick", "thin", "none left"], "options in JSON")
        expect_equal(line["format"], "ceduo-result-1", "format")


def test_report_head():
    """A report asks once for its head: lines may be empty, and the entries are kept in the scene and printed."""
    days = [time.strftime("%Y-%m-%d")]  # two where midnight passes
    with Place() as place:
        screens = place.play("""
            wait idle
            key w Down Down Down Down Down Enter
            dump
            type Serra 'de\u2019 Conti': <b>
            key Enter Enter Enter Enter Ctrl-U
            type 2026-11-24
            key Enter Enter
            dump
            key Enter
            wait idle
            key w Down Down Down Down Down Enter
            dump
            key Esc
            type u
            key w Down Down Down Down Down Enter
            dump
            key Esc
            key Ctrl-R
            type s
            dump""", "options.yaml")
        screens[0].has("Head of the report", "place", "owner", "parcel", "author", "date", "note", "All lines are optional")
        days.append(time.strftime("%Y-%m-%d"))
        expect(any(re.search(f"date +{day}", screens[0].text) for day in days), "the date is today's:", screens[0])
        screens[1].has("a report, as HTML", "ceduo.html")
        screens[2].has("a report, as HTML", "ceduo.html")
        screens[3].has("Head of the report")
        report, kept = place.text("ceduo.html"), place.text("options.yaml")
        expect_in("<dt>Place</dt>\n<dd>Serra &#39;de\u2019 Conti&#39;: &lt;b&gt;</dd>\n<dt>Date</dt>\n<dd>2026-11-24</dd>", report, "the head")
        expect("<dt>Owner</dt>" not in report, "an empty line is left out")
        for line in ("place: \"Serra 'de\u2019 Conti': <b>\"", 'date: "2026-11-24"'):
            expect_in(line, kept, "stored in the scene")


def test_report_after_head():
    """The head of a report changes no figure: the first report has the uncertain inputs that the screen has."""
    uncertain = 'uncertainty:\n  - {path: "options[*].forest[*].stand.energy.u_J_m3", lo: 20000, hi: 120000}\n'
    with Place() as place:
        place.write("cuts.yaml", CUTS + uncertain)
        ranges, written, undone = place.play("""
            resize 120 40
            key 7
            wait idle
            dump
            key w Down Down Down Down Down Enter
            key Enter Enter Enter Enter Enter Enter Enter
            dump
            key u
            dump""", "cuts.yaml")
        report = place.text("ceduo.html")
    expect(ranges.body.count("\u2013"), "no range", ranges)
    expect_equal(written.note.strip(), "written: ceduo.html")
    expect_in("How sure is it?", report)
    expect("was not computed" not in report, "the uncertain inputs of the screen")
    expect_equal(undone.body, ranges.body, "the head undone")


NOTHING = """\
ceduo: scene/1
rock: {diameter_m: 0.5}
release: {x_m: 2}
slope: {vertices_m: [[0, 10], [15, 0], [300, 0]], materials: [{from_m: 0, to_m: 300, material: talus}]}
controls: [{x_m: 290, accepted_kJ: 20}]
forest: [{from_m: 10, to_m: 200, stand: simple-coppice}]
"""


def test_export_nothing():
    """w: a report of a scene without arrivals prints no uncertainty, although it is known"""
    with Place() as place:
        place.write("far.yaml", NOTHING)
        place.play("wait idle\nkey w Down Down Down Down Down Enter Enter Enter Enter Enter Enter Enter\nwait idle\nkey Enter",
                   "far.yaml")
        report = place.text("ceduo.html")
        expect_in("cannot be assessed", report)
        expect("How sure is it?" not in report, "how sure it is")


def test_export_command():
    """w: the shown batch command gives equal figures."""
    with Place() as place:
        screen, command = place.play("wait idle\ndump\nkey w End Enter\ndump", "paper-site")
        found = re.search(r"ceduo --batch -n (\d+) ", command.popup)
        expect(found, "no command in the", command)
        batch = results("-n", found.group(1), "paper-site")[0]
        control = batch["options"][0]["controls"][0]
        arrivals = control["wooded"], control["bare"]
        expect_equal(screen.pair("arrive"), tuple(round(a["reach_probability"] * 1000) for a in arrivals), "arrive")
        expect_equal(screen.pair("mean kJ"), tuple(float(f"{a['energy_kJ']['mean']:.3g}") for a in arrivals), "energy")
        expect_near(control["index"]["residual_kJ"], read_index(screen)[1], 0.06, "left")


def test_export_rocks():
    """w: the command follows the figures on the screen: first none, then their number of rocks."""
    none, last, screen = fast("key w End Enter\ndump\nwait idle\ndump\nkey Esc\ndump", "wood.yaml")
    none.has("ceduo --batch -n 1000 ", "no figures yet", "number of rocks in the scene")
    rocks = int(screen.figure("finished,"))
    last.has(f"ceduo --batch -n {rocks} ", f"The figures on the screen are from {rocks} rocks").lacks("no figures yet")


def test_export_unsaved():
    """w: with unsaved work the command asks to save first."""
    screen = fast("key 2\nfind stools.per_ha\nset 9\nwait idle\nkey w End Enter\ndump")[0]
    screen.has("ceduo --batch", "unsaved changes")


if __name__ == "__main__":
    run_all(__name__)
