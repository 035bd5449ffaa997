#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The terminal program in Italian: at 80x24 it cuts only words that are cut in English, and columns keep their places."""
import functools
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import Place, expect, play  # noqa: E402
from harness import expect_equal, run_all  # noqa: E402

VIEWS = "\n".join(f"key {i}\nwait idle\ndump" for i in range(1, 9))
POPUPS = "\n".join(f"key {view}\nkey {key}\ndump\nkey Esc" for view, key in ((2, "?"), (2, "p"), (2, "c"), (4, "e"), (2, "n"), (1, "o")))
CUT = "\u2026"
SCENES = ("fast.yaml", "options.yaml", "cuts.yaml", "wood.yaml")


@functools.cache
def play_both(script, scene, charset="braille"):
    """Return the screens in both languages."""
    with Place() as place:
        return list(zip(*(play(place.path, script, scene, "--language", language, charset=charset) for language in ("en", "it"))))


TITLES = ("versante", "bosco", "blocco", "esiti", "opzioni", "turno", "incertezza", "osservati")


def words_cut(screen):
    """Return words cut by an ellipsis below the titles of views; it stands alone if figures or a path are missing."""
    return re.findall(r"\w+" + CUT, screen.text.partition("\n")[2])


def test_views():
    """No view cuts more words in Italian than in English, and none prints a translation file's header"""
    for scene in SCENES:
        for number, (english, italian) in enumerate(play_both(VIEWS, scene), 1):
            text = str(italian)
            expect(len(words_cut(italian)) <= len(words_cut(english)), f"{scene}, view {number}", words_cut(italian), text)
            expect("nplurals" not in text, text)
            top = " ".join(italian.text.split("\n")[0].split())
            titles = (rf"{n} (?:{name}|{name[:4]}\w*{CUT})" for n, name in enumerate(TITLES, 1))
            expect(re.match(" ".join(titles), top), text)


def test_numbers():
    """The figures are equal; Italian has a comma instead of a dot"""
    belts = "key 6\nwait idle\ndump\nkey 1 Right Enter Ctrl-U\ntype 50.5\nkey Enter\ndump"  # the message follows
    shape = "key 3 Enter Down Enter\ndump"
    for english, italian in play_both("key 1\nwait idle\ndump", "fast.yaml") + play_both(belts, "paper-site") + play_both(shape, "fast.yaml"):
        dots, commas = (re.findall(sign, str(screen)) for screen, sign in ((english, r"\d+\.\d+"), (italian, r"\d+,\d+")))
        expect(dots, english)
        expect_equal(sorted(figure.replace(",", ".") for figure in commas), sorted(dots), italian)


def test_texts_in_two_languages():
    """A text that is confirmed unchanged is no edit; a changed one sets the key of the language shown"""
    fields = (("key 3\nfind title", "first", "prima"), ("key 1\nfind {}", "road", "strada"), ("key 5 Down", "thin", "rado"))
    with Place() as place:
        scene = place.text("options.yaml").replace("title: fast", "title: first\ntitle_it: prima")
        scene = scene.replace("name: road", "name: road, name_it: strada").replace("- name: thin", "- name: thin\n    name_it: rado")
        place.write("both.yaml", scene)
        for goto, english, italian in fields:
            for language, shown in (("en", english), ("it", italian)):
                same, _ = play(place.path, f"wait idle\n{goto.format(shown)}\nkey Enter Enter\ndump\nset {shown}X\nkey S Ctrl-U\n"
                               "type new.yaml\nkey Enter\ndump", "both.yaml", "--language", language)
                expect("* " not in same.title, f"{language}, {shown}: an unchanged text is an edit", same)
                found = re.findall(rf"\b(?:title|name)(?:_it)?: ({english}X?|{italian}X?)\b", place.text("new.yaml"))
                expect_equal(found, [english, f"{italian}X"] if language == "it" else [f"{english}X"], f"{language}, {shown}")
                (place.path / "new.yaml").unlink()


def test_fields():
    """Fields and popups propose and accept decimal commas, the file has a dot; units have their powers"""
    with Place() as place:
        opened, after, new = play(place.path, "key 3\nfind rock.diameter_m\nkey Enter\ndump\nkey Esc\nset 0,75\ndump\n"
                                  "key s\nkey n\ndump", "fast.yaml", "--language", "it")
        expect("0,5_" in str(opened) and "kg/m\u00b3" in str(opened), opened)
        expect("0,75" in str(after), after)
        expect("0,6" in str(new), new)
        expect("diameter_m: 0.75" in place.text("fast.yaml"), place.text("fast.yaml"))
    with Place() as place:
        (ascii_screen,) = play(place.path, "key 3\ndump", "fast.yaml", "--language", "it", charset="ascii")
        expect("kg/m3" in str(ascii_screen), ascii_screen)


def test_words():
    """Words of a file are displayed and typed in Italian; files keep their own words, also new ones"""
    with Place() as place:
        place.write("l.csv", "Distanza;Quota\n0;60\n40;30\n99;0\n")
        for name in ("rilievo.txt", "RILIEVO.CSV", "note.doc"):
            place.write(name, "")
        form, after, grounds, stands, surveys = play(
            place.path, "resize 110 36\nkey 1\nfind slope.facets\ndump\nkey 3\nfind scale_rn\nset s\u00ec\ndump\nkey s\nkey n Enter\ntype l.csv\n"
            "key Enter Enter Enter\ntype sottile\nkey Enter Enter Enter Enter\ndump\nkey Ctrl-U\ntype simple-coppice\ndump\n"
            "key Ctrl-U\ntype rilievo\nkey Enter\ndump\nkey Esc s Ctrl-U\ntype new.yaml\nkey Enter", "fast.yaml", "--language", "it")
        expect(re.search(r"asperit\u00e0 +contro il moto", str(form)), form)
        expect(re.search(r"Rn .* s\u00ec ", str(after)) and "usuale no" in str(after), after)
        expect("terreno sotto la parete         colluvio sottile" in str(grounds), grounds)
        expect("ceduo semplice, 25 anni" in stands.popup, stands)
        expect("rilievo.txt" in surveys.popup and "RILIEVO.CSV" in surveys.popup, surveys)
        expect("note.doc" not in str(surveys), surveys)
        expect("material: thin-colluvium" in place.text("new.yaml"), place.text("new.yaml"))
        expect("scale_rn: true" in place.text("fast.yaml"), place.text("fast.yaml"))


def test_names():
    """A new name in Italian replaces the Italian one; an option of a shipped stand has its Italian name"""
    with Place() as place:
        renamed, added = play(place.path, "key 5 Enter Ctrl-U\ntype diradato\nkey Enter\ndump\nkey a\ntype sterzo, tagl\nkey Enter G\ndump\n"
                              "key s Ctrl-U\ntype new.yaml\nkey Enter", "four-systems", "--language", "it")
        expect("diradato" in renamed.now, renamed)
        expect("ceduo a sterzo, tagliato (2)" in added.now.replace("\n", " "), added)
        text = place.text("new.yaml")
        expect_equal(re.findall(r"name(?:_it)?: .*", text[text.index("options:"):])[:2], ['name: "simple coppice, 25 years"', "name_it: diradato"])


def test_sizes():
    """The message about another shape's sizes has decimal commas and no list commas"""
    with Place() as place:
        (said,) = play(place.path, "key 3\nwait idle\nfind rock.shape\nkey Enter End Enter\ndump", "fast.yaml", "--language", "it")
        expect(re.search(r"volume: assi 0,403 0,403 0,403 m;", said.note), said)


def test_columns():
    """The rule at the figures is in one column, as in English"""
    for english, italian in play_both(VIEWS, "options.yaml"):
        for screen in (english, italian):
            lines = [line for line in str(screen).split("\n") if "\u2502 su 1000" in line or "\u2502 of 1000" in line]
            expect_equal({line.index("\u2502 ", 40) for line in lines}, {51}, str(screen))


def test_popups():
    """Popups are in Italian and cut at most the number of words cut in English"""
    for english, italian in play_both(POPUPS, "fast.yaml"):
        expect(len(words_cut(italian)) <= len(words_cut(english)), words_cut(italian), italian)
        expect(str(english) != str(italian), italian)


def test_ascii():
    """Without UTF-8 Italian has no accents and no question marks in their place"""
    for _, italian in play_both(VIEWS, "fast.yaml", charset="ascii"):
        expect(str(italian).isascii(), italian)


if __name__ == "__main__":
    run_all(__name__)
