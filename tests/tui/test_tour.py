#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The tour: the first questions of a user, the keys that answer them, and the place of each answer."""
import re
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import ROOT, Place, Screen, play  # noqa: E402
from harness import USAGE, Folder, ceduo, children_seconds, expect, expect_equal, expect_in, run_all  # noqa: E402

LINES = 3  # of the tour, below the program


def questions():
    """Return the steps of each question of the tour: [[(sentence, [key, …]), …], …]."""
    source = (ROOT / "src/tui/tour.c").read_text(encoding="utf-8")
    table = source[source.index("steps[] = {"):source.index("#define STEPS")]
    rows = re.findall(r'\{(PAPER|FOUR|NULL),\s*(?:NULL|N_\("(.*?)"\)),\s*N_\(((?:\s*".*?")+)\),\s*"(.*?)"\}', table)
    expect_equal(len(rows), table.count("\n    {"), "steps read")
    found = []
    for scene, _, sentence, keys in rows:
        found += [[]] if scene != "NULL" else []
        found[-1].append(("".join(re.findall(r'"(.*?)"', sentence)), keys.split()))
    return found


# Where the answer to each question stands, with its words in English and in Italian. A cylinder of 0.8 m and 0.8 m has 0.402 m3,
# which are 1046 kg of 2600 kg/m3. A plot of 400 m2 under 49 degrees has 262.4 m2, so that a stem on it is 38.11 per ha. The
# proposed profile falls from 90 to 65 m over the face of its first 10 m, and is 120 m long.
ANSWERS = (
    ("verdict", r"NO: in 1[89] of 20 years more than 50 of 1000 exceed 50 kJ; today 4[4-9]\d",
     r"NO: in 1[89] anni su 20 più di 50 su 1000 superano 50 kJ; oggi 4[4-9]\d"),
    ("body", r"current \S+ \d+ \d+–\d+ [^$]*Measure first: shoots: diameter",
     r"com'è ora \S+ \d+ \d+–\d+ [^$]*Il dato che più riduce l'incertezza: polloni: diametro"),
    ("body", r"In years 1 to 25 'selection-coppice-cut' lets the fewest dangerous rocks through, as it does today",
     r"Negli anni da 1 a 25 'ceduo a sterzo, tagliato' è l'opzione che lascia passare meno blocchi pericolosi, come già oggi"),
    ("body", r"m³/y\b[^$]*7 larg\S+ \S+ .* 3\.7", r"m³/a\b[^$]*7 \S+ \S* ?.* 3,7"),
    ("note", r"no value from 75 to 7500 reaches the goal; nearest: 7500", r"nessun valore da 75 a 7500 raggiunge l'obiettivo; il più vicino: 7500"),
    ("now", r"Year 1, just cut .*above 50 kJ +8\d\d", r"Anno 1, appena tagliato .*oltre 50 kJ +8\d\d"),
    ("body", r"1 +10 +120 simple", r"1 +10 +120 ceduo"),
    ("note", r"plot of 262\.4 m² \(horizontal\): each counted stem is 38\.11", r"262,4 m² \(in orizzontale\): ogni fusto contato vale 38,11"),
    ("body", r"1046 kg, 0\.402 m³", r"1046 kg; 0,402 m³"),
    ("popup", r"file +ceduo\.html", r"file +ceduo\.html"),
)


def split_screen(screen):
    """Return the program's screen, and the lines of the tour."""
    height = screen.height - LINES
    return Screen("\n".join(screen.whole().lines[:height]) + "\n", screen.width, height), screen.lines[height:]


def spaces(steps):
    """Return how often Space is pressed for steps: once for each key, or to go on."""
    return sum(len(keys) or 1 for _, keys in steps)


def press(steps):
    """Return the command that presses the keys of the steps, and Space to go on."""
    return "key " + " ".join(key for _, keys in steps for key in keys or ["Space"])


def test_ten_questions():
    """Space plays ten questions of at most 25 keys; each answer is on a screen of 80 x 24, in both languages; nothing is saved"""
    for language in ("en", "it"):
        script, tour = "", questions()
        expect_equal(len(tour), 10, "questions")
        for steps in tour:
            expect(spaces(steps) <= 25, f"{spaces(steps)} keys", steps)
            expect_equal(steps[-1][1], [], "the last step only reads")
            script += f"key{' Space' * spaces(steps[:-1])}\nwait idle\ndump\nkey Space\n" if steps[:-1] else "wait idle\ndump\nkey Space\n"
        with Folder() as f:
            screens = play(f.path, script + "dump", "--tour", "--language", language)
            expect_equal([p.name for p in f.path.rglob("*") if p.is_file() and p.name != "play.txt"], [], "files")
        for i, (where, *answers) in enumerate(ANSWERS):
            program, lines = split_screen(screens[i])
            expect_in(f" {i + 1}/10  ", lines[0])
            expect(re.search(answers[language == "it"], " ".join(getattr(program, where).split())), f"question {i + 1}, {language}:", screens[i])
        screens[10].whole().lacks("/10 ", "* Test site", "* Sito").has("Test site" if language == "en" else "Sito", "? help" if language == "en" else "? aiuto")


def test_keys_themselves():
    """The keys that the tour names give the same screens as Space; other keys change nothing"""
    tour = questions()[2]
    before = " ".join(["Space"] * sum(spaces(steps) for steps in questions()[:2]))
    by_space = f"key {before}\nwait idle\ndump\n" + f"key{' Space' * (spaces(tour) - 1)}\nwait idle\ndump"
    by_keys = f"key {before} x u Down F2\nwait idle\ndump\n{press(tour[:-1])}\nkey s 5\nwait idle\ndump"
    with Folder() as f:
        first, second = (play(f.path, script, "--tour") for script in (by_space, by_keys))
    expect_equal([str(s) for s in second], [str(s) for s in first])


def test_sentences():
    """Each sentence and question is shown whole in its lines, with the key that comes next, in both languages"""
    steps = [step for question in questions() for step in question]
    script = "dump\n" + "".join(f"key{' Space' * spaces([step])}\ndump\n" for step in steps[:-1])
    for language in ("en", "it"):
        with Folder() as f:
            screens = play(f.path, script, "--tour", "--language", language)
        for screen, (sentence, keys) in zip(screens, steps, strict=True):
            lines = split_screen(screen)[1]
            expect("…" not in "".join(lines), screen)
            expect(re.search(rf"  .* {re.escape(keys[0])}  Esc" if keys else r"  (Space goes on|Spazio va avanti)  Esc", lines[0]), screen)
            expect(language == "it" or sentence.replace("m3", "m³") == " ".join(lines[1:]).strip(), sentence, screen)


def test_ends():
    """Esc and q end the tour in any place, and open the scene of the command line, or the paper's site"""
    for keys in ("Esc", "q", "Space Space F10", "Space " * 6 + "Esc"):
        with Place() as place:
            own, = play(place.path, f"key {keys}\ndump", "--tour", "fast.yaml")
            own.whole().has("fast", "The tour has ended").lacks("/10 ", "* fast", "search:")
            after, = play(place.path, f"key {keys}\nkey 3\nwait idle\ndump", "--tour")
            after.whole().has("Test site of", "512.3 kg").lacks("/10 ", "* Test site")


def test_first_key():
    """t as the first key after a start without a scene plays the tour; otherwise it changes the colours"""
    with Place() as place:
        hint, tour, later, scene = (play(place.path, script, *arguments)[0] for script, arguments in (
            ("dump", ()), ("key t\ndump", ()), ("key 2 t\ndump", ()), ("key t\ndump", ("fast.yaml",))))
    hint.has("t shows the program in ten questions")
    tour.has("Tour 1/10").lacks("t shows the program")
    later.lacks("Tour", "t shows the program")
    scene.lacks("Tour")


def test_small_and_ascii():
    """The tour fits into 60 x 19 in ASCII; below that the program reports the size that it needs"""
    with Folder() as f:
        screens = play(f.path, "resize 60 19\ndump\nkey Space Space Space\ndump\nresize 60 18\ndump\nresize 9 2\ndump\nresize 60 18\n"
                               "key Esc\ndump", "--tour", charset="ascii")
    for screen in screens[:2]:
        screen.whole().has("/10 ")
        expect(str(screen).isascii(), screen)
    screens[2].has("60 x 18", "60 x 19 is needed").lacks("/10 ")
    expect_in("The", str(screens[3].whole()))
    screens[4].whole().lacks("too small", "/10 ")


def test_no_terminal():
    """Without a terminal, and with --batch, the tour ends with status 2 and a message"""
    done = ceduo("--tour")
    expect_equal(done.status, USAGE, done)
    expect_in("not a terminal", done.err)
    done = ceduo("--tour", "--batch", "paper-site")
    expect_equal(done.status, USAGE, done)
    expect_in("--tour", done.err)


def measure():
    """Print the keys of each question, and the seconds until its answer is final, of the clock and of the processor."""
    print("question,keys,seconds,processor")
    tour = questions()
    for i, steps in enumerate(tour):
        before = "".join(f"key{' Space' * spaces(s)}\n" for s in tour[:i])
        used = []
        with Folder() as f:
            for script in (before, before + "".join(f"key{' Space' * spaces([s])}\n" for s in steps[:-1]) + "wait idle\n"):
                start = time.monotonic(), children_seconds()
                play(f.path, script + "dump", "--tour", rocks=None)
                used.append((time.monotonic() - start[0], children_seconds() - start[1]))
        print(f"{i + 1},{spaces(steps)},{used[1][0] - used[0][0]:.1f},{used[1][1] - used[0][1]:.1f}", flush=True)


if __name__ == "__main__":
    if sys.argv[1:] == ["--measure"]:
        measure()
    else:
        run_all(__name__)
