#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Saving in the terminal program: under another name, where it fails, and what is said of comments and copies."""
import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import FAST, Place, check_good, run_script  # noqa: E402
from harness import expect, expect_equal, expect_in, run_all  # noqa: E402

EDIT = "key 2\nkey /\nkey Ctrl-U\ntype stools.per_ha\nkey Enter Enter\ntype 1234\nkey Enter\n"
STUCK = "stuck.yaml"


def test_save_as():
    """S saves under another name, which the scene has from then on; the file of before stays as it was."""
    with Place() as place:
        asked, saved, again = place.play(EDIT + "key S\ndump\nkey Ctrl-U\ntype other.yaml\nkey Enter\ndump\n"
                                         "find stools.per_ha\nset 999\nkey s\ndump")
        asked.has("Save as", "fast.yaml")
        expect_equal(saved.note, "saved other.yaml")
        expect_equal(again.note, "saved other.yaml")
        expect("* fast" not in again.title, again.title)
        expect_equal(place.text("fast.yaml"), FAST, "the file of before")
        expect_equal(place.text("other.yaml"), FAST.replace("per_ha: 3000", "per_ha: 999"), "the other file")


def test_save_as_same():
    """S with the scene's own name saves as s does, but not over a file that has changed since."""
    with Place() as place:
        place.play(EDIT + "key S Enter")
        expect_equal(place.text("fast.yaml"), FAST.replace("per_ha: 3000", "per_ha: 1234"), "the file")
        asked = place.play(EDIT + "dump fast.yaml\nkey S Enter\ndump")[0]
        asked.has("Enter once more replaces it")
        expect(place.text("fast.yaml").startswith(" 1 slope"), "written over at once")


def test_folder_kept():
    """S offers the file with its folder: a name changed at its end stays beside it."""
    with Place() as place:
        (place.path / "sub").mkdir()
        place.write("sub/fast.yaml", FAST)
        asked = place.play("key S\ndump\nkey End Backspace Backspace Backspace Backspace Backspace\ntype r.yaml\nkey Enter",
                           "sub/fast.yaml")[0]
        asked.has("sub/fast.yaml")
        expect_equal(place.text("sub/fastr.yaml"), FAST, "beside it")


def test_references():
    """S into another folder keeps every file that the scene refers to, and so does each s after it."""
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
    """STUCK can be read, but the file that would take the place of what it leads to has too long a path, for root too."""
    deep = place.path.resolve()
    while (rest := 4090 - len("/fast.yaml") - len(str(deep))) > 0:
        deep = deep / ("n" * (100 if rest > 202 else rest - 1))
    (place.path / STUCK).symlink_to(place.write(deep / "fast.yaml", FAST).relative_to(place.path.resolve()))


def test_failed():
    """Where a file cannot be written the reason is said and another name asked for; with that one all is well."""
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
    """A FIFO under the name given is asked about like any file, and not waited for."""
    with Place() as place:
        os.mkfifo(place.path / "fifo")
        asked = place.play(EDIT + "key S Ctrl-U\ntype fifo\nkey Enter\ndump\nkey Esc w Enter Ctrl-U\ntype fifo\nkey Enter\ndump")
        for screen in asked:
            screen.has("there is such a file already")


def test_failed_quit():
    """'save and quit' where the file cannot be written quits once it is saved under another name, and not before."""
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
    """Only where an old file lies beside the new one is it named; of a scene that was copied it says what is missing."""
    with Place() as place:
        saved = place.play("key 1\nfind stand\nkey a\nkey s Ctrl-U\ntype my.yaml\nkey Enter\ndump", "paper-site")[0]
        expect("# Test site" not in place.text("my.yaml"), "this test's own scene keeps its comments")
        expect("my.yaml.bak" not in place.names() and ".bak" not in saved.note, saved.note)
        expect_equal(saved.note, "saved my.yaml; laid out anew, without the comments of paper-site.yaml")
        check_good(place.path, "my.yaml")
        saved = place.play("key 1\nfind stand\nkey d\nkey s\ndump\nclear\nkey u s\ndump", "fast.yaml")
        expect_equal(saved[0].note, "saved fast.yaml; laid out anew, the old file is fast.yaml.bak")
        expect_equal(saved[1].note, "saved fast.yaml", "what the program laid out itself is no loss")
        expect_equal(place.text("fast.yaml.bak"), FAST, "the old file, with its comments, still")


if __name__ == "__main__":
    run_all(__name__)
