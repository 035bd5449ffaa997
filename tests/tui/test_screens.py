#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: threads
"""The screens of the terminal program, from scripts without a terminal: their content in every size, and details of scripts."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import play  # noqa: E402
from play import FAST, VIEWS, Place, fast, run_script  # noqa: E402
from harness import (DONE, INPUT, OUTPUT, PROFILES, USAGE, Folder, Suite, expect,  # noqa: E402
                     expect_equal, expect_in, expect_near, list_tests)

SIZES = [(80, 24), (120, 40), (200, 50)]
CHARSETS = ["braille", "block", "ascii"]
BY_INDEX = " by the index"
SCENES = ["paper-site", "four-systems", "paper-site" + BY_INDEX, "four-systems" + BY_INDEX]
EIGHT = ["simple coppice, 25 years", "simple coppice, just cut", "coppice with standards",
         "coppice with standards, just cut", "selection coppice", "selection coppice, just cut", "large reserves",
         "large reserves, just cut"]
SIGNS = {"passes": {"braille": "✔", "block": "✔", "ascii": "+"}, "FAILS": {"braille": "✘", "block": "✘", "ascii": "x"},
         "unknown": {"braille": "?", "block": "?", "ascii": "?"}}

# ---- every view in every size ----

_seen = {}


def scene_for(folder, scene):
    """Return the name of a copy of a shipped scene, perhaps computed by the index alone. Without uncertainty, which is slow,
    and which these views do not show; test_uncertainty.py does."""
    name = scene.removesuffix(BY_INDEX)
    text = (PROFILES / f"scenes/{name}.yaml").read_text()
    if name != scene:
        text, found = re.subn(r"^simulation:$", "simulation:\n  contact_model: index", text, flags=re.M)
        expect_equal(found, 1, name)
    text = re.sub(r"^uncertainty:\n(  - .*\n)*", "", text, flags=re.M) + "uncertainty: none\n"
    folder.write(f"{name}.yaml", text)
    return f"{name}.yaml"


def play_views(scene, charset):
    """Return the views in every size, played once for all charsets, except the slow one of the years."""
    if scene not in _seen:
        script = ["wait idle"]
        for _ in CHARSETS:
            for width, height in SIZES:
                script.append(f"resize {width} {height}")
                script += [line for v in range(5) for line in (f"key {v + 1}", *["wait idle"] * (v == 4), "clear", "dump")]
            script.append("key b")
        with Folder() as folder:
            screens = play.play(folder.path, "\n".join(script), scene_for(folder, scene))
        keys = [(c, size, view) for c in CHARSETS for size in SIZES for view in VIEWS[:5]]
        _seen[scene] = dict(zip(keys, screens, strict=True))
    return {key[1:]: screen for key, screen in _seen[scene].items() if key[0] == charset}


def lights(screen, charset):
    """Return the tests in the column, with the signs of the charset."""
    found = screen.lights()
    for name, word in found.items():
        expect(re.search(rf" {re.escape(SIGNS[word][charset])}[✔✘+x?]?$", screen.now, re.M), f"the sign of {name}: {word}", screen)
    return found


OWN_KEYS = {"slope": ("Enter edit", "a add", "Tab picture"), "stand": ("Enter edit", "p stands", "c sample plot"),
            "rock": ("Enter edit", "a blocks"), "results": ("Down scroll", "w export"),
            "compare": ("a add", "y copy", "Enter name"), "rotation": ("Enter edit", "Tab years")}


def check_frame(screen, view, scene, charset):
    screen.whole()
    for i, name in enumerate(VIEWS):
        expect(re.search(rf" {i + 1} (?:{name}|{name[:3]}\w*[…~])", " " + screen.title), "title", screen)
    title = "Test site of Ciabocco et al. 2009" if "paper-site" in scene else "Four systems, before and after the cut"
    shown = re.search(r"8 obs\w*[…~]? +(\S.*)$", screen.lines[0])  # cut if it does not fit
    expect(title in screen.title or (shown and len(shown.group(1)) >= 10 and title.startswith(shown.group(1)[:-1])), "title", screen)
    for part in ("? help", "q quit", "u undo", "s save", *OWN_KEYS[view]):
        expect_in(part, screen.bar, "the bar of keys")
    wall = "|" if charset == "ascii" else "│"
    at = screen.width - screen.side - 1
    for y in range(2, screen.height - 3):
        line = screen.lines[y].ljust(screen.width)
        expect(line[at] == wall and line[at - 1] == line[at + 1] == " ",
               f"line {y + 1}: something reaches over the wall between view and figures: {line!r}", screen)
    # The second line of the field's explanation is empty if one line is enough. The position of a text above may stand there.
    note = re.sub(r"^ *\d+/\d+ [▲▼^v]+$", "", screen.lines[screen.height - 3])
    expect(note == "" or len(note) + len(screen.lines[-2]) >= screen.width - 10, "a line of distance is not empty", screen)
    if charset == "ascii":
        expect(screen.text.isascii(), "not pure ASCII:", ascii(screen.text))


def check_now(screen, scene, charset):
    now, by_index = screen.now, scene.endswith(BY_INDEX)
    expect_in("Rock 0.68 m, 512.3 kg", now)
    expect_in("At 135 m, end of the forest", now)
    sign, to, least, most = ("\\+-", "-", ">=", "<=") if charset == "ascii" else ("±", "–", "≥", "≤")
    share = " +-" if by_index else rf" +\d+ \(\d+{to}\d+\)" if screen.width >= 120 else rf" +\d+{sign}\d+"
    figure = " +-" if by_index else r" +[\d.]+"
    energy = r"energy % +- +\?\?" if by_index else rf"energy % +[\d.]+ +{most} 5 \S\S"
    for pattern in (r"^of 1000 +(with )?forest +without$", rf"^arrive{share} +\d+$", rf"^above 50 kJ{share} +\d+$",
                    rf"^mean kJ{figure} +[\d.]+$", rf"^95 % below kJ{figure} +[\d.]+$",
                    *[rf"^95 % below m{figure} +[\d.]+$"] * (screen.height > 24),
                    r"^ADC m +[\d.]+ +< 30 \S\S$", rf"^free run % +[\d.]+ +{most} 10 \S\S$", rf"^{energy}$",
                    r"^taken kJ +[\d.]+$", r"^left kJ +[\d.]+$", r"^finished, \d+ rocks$"):
        expect(re.search(pattern, now, re.M), f"nothing like {pattern!r} in the column on the right:", now)
    found = lights(screen, charset)
    expect_equal(found, {"Contact": "passes", "Free run": "passes", "Energy": "unknown" if by_index else "FAILS"}, "lights")
    ahead = "passes" if "paper-site" in scene else "FAILS"  # never cut, and cut in the first year
    expect_equal({name: later for name, (_, later) in screen.lights_ahead().items()},
                 {"Contact": ahead, "Free run": ahead, "Energy": "unknown" if by_index else "FAILS"}, "in the worst year")
    for pattern in (r"^stems stop +\d+ +0$", r"^at rest +\d+ +\d+$"):
        expect(bool(re.search(pattern, now, re.M)) != by_index, f"{pattern!r} in the column on the right:", now)
    if not by_index:
        ends = [sum(pair) for pair in zip(*(screen.pair(name) for name in ("arrive", "stems stop", "at rest")))]
        expect(all(999 <= n <= 1001 for n in ends), "arrived, stopped and at rest are all released", now)
        check_pairs(screen)
    check_verdict(screen, by_index, charset)
    if "paper-site" in scene:
        expect_equal(bool(re.search(r"^measured kJ +62\.3$", now, re.M)), screen.height > 18, "the rock that was filmed")
        counted = screen.height == 24 and re.search(r"^! \d more remarks?: view 4$", now, re.M)
        expect(counted or "Eq. 6 gives" in now, "the warning about ADS 2", now)


def check_verdict(screen, by_index, charset):
    """Expect line 2 to have the answer of the shown option, with its sign, uncut."""
    line = screen.verdict.strip()
    if by_index:
        expect(re.search(r"by the index [\d.]+ of 113 kJ remain", line), line)
        return
    found = re.match(rf"{SIGNS['FAILS'][charset]} NO: in (\d+) of (\d+) years more than 50 of 1000 (?:rocks )?exceed 50 kJ.*; today (\d+)", line)
    expect(found, "an answer in", line)
    expect_equal(float(found.group(3)), screen.pair("above 50 kJ")[0], "the figure of the column")
    expect(not line.endswith(("…", "~")) and len(line) < screen.width, line)


def check_pairs(screen):
    """Expect at most the arrivals and the energy without forest; the energy light follows the share."""
    for name in ("arrive", "above 50 kJ", "mean kJ", "95 % below kJ", *["95 % below m"] * (screen.height > 24)):
        wood, bare = screen.pair(name)
        expect(wood < bare, f"{name}: {wood} through the wood, {bare} without", screen.now)
    share = float(re.search(r"^energy % +([\d.]+)", screen.now, re.M).group(1))
    expect_near(share * 10, screen.pair("above 50 kJ")[0], 0.51, "the share beside the light")


MUST = {
    "slope": ["Belts of forest", "stand", "energy, kJ", "0 m", "Controls"],
    "stand": ["from, m to, m stand", "Stand of belt 1:", "system", "species", "stools per ha", "spacing, m",
              "Shoots on the stools", "Single trees: standards, reserves",
              "stems/ha, basal area", "by interception", "kJ per 100 m"],
    "rock": ["shape cylinder", "diameter, m 0.56", "height, m 0.80", "density, kg/m", " 2600", "Release", "x, m 0",
             "spin, rad/s 0", "Simulation", "law of impact lumped", "512.3 kg", "mean diameter B 0.68 m"],
    "results": ["of 1000", "without", "p50", "p95"],
    "compare": ["135 m", "fail"]}
WIDE = {"slope": ["release", "end of the forest (135 m)", "Rn", "Rt", "friction", "name", "facets against"],
        "stand": ["Energy of a contact", " height", "energy law brauner", "fracture ratio"],
        "rock": ["form of the ADC auto", "threshold, m 30", "gravity, m/s2 9.81", "seed 1", "title"],
        "results": ["ADC m", "mean kJ", "m/s"],
        "compare": ["C F", "worst"]}
# With rocks in the wood, and by the index alone.
MUST_WOOD = {"slope": ["forest", "without"], "stand": [], "rock": ["rocks among stems stems"],
             "results": ["forest"], "compare": ["Of 1000 rocks: > 50 kJ at 135 m", "today mean", "fail", "worst"]}
WIDE_WOOD = {"slope": ["underside", "energy, kJ"], "stand": [],
             "rock": [], "results": [], "compare": []}
MUST_INDEX = {"slope": [], "stand": [], "rock": ["rocks among stems index"], "results": [],
              "compare": ["At 135 m", "ADC m", "kJ/100 m", "fail"]}
WIDE_INDEX = {"slope": ["underside above the ground, m", "without forest", "p95", "p50"], "stand": [], "rock": [],
              "results": [], "compare": []}
HEADS = ("today", "mean", "kJ/100 m", "range", "ADC m", "worst(?: ADC m)?", "fail C", "fail", "m³/y", "m3/y", "E C F", "C F")


def compared(screen):
    """Return the table of view 5: (name, {head: cell}); best: the word next to the mean."""
    beside = 84 if screen.width - screen.side - 2 >= 128 else None  # followed by the picture of the options
    lines = [line[:beside].rstrip() for line in screen.body.split("\n")]
    at = next(i for i, line in enumerate(lines) if re.search(r"(today|ADC m) .*(fail|worst|m[³3]/y|C F)", line))
    heads = [(m.group(0).replace("m3", "m³"), m.end()) for m in re.finditer("|".join(HEADS), lines[at])]
    rows = []
    for line in lines[at + 1:]:
        if not line.strip() or re.match(r"\d+[–-]\d+ of \d+ options", line):
            break
        name = re.match(r"(.*?) +\S+$", line[:heads[0][1]]).group(1).strip()
        if lines[at].startswith(" "):  # numbers, as of the curves
            name = re.sub(r"^\d+ ", "", name)
        cells, begin = {}, len(line[:heads[0][1]]) - len(line[:heads[0][1]].split(" ")[-1])
        for head, end in heads:
            cells[head] = line[begin:end].strip()
            begin = end
        cells["best"] = (re.search(r" (best|worst) ", line) or [""])[0].strip()
        for head, cell in cells.items():
            cells[head] = cell if head == "best" else cell.removeprefix("best").removeprefix("worst").strip()
        rows.append((name, cells))
    return rows


def compared_lights(screen):
    """Return the signs of each option's line: energy, contact, free run."""
    return [cells.get("E C F", cells.get("C F", "")).replace(" ", "") for _, cells in compared(screen)]


def check_results(screen, by_index):
    """Expect without scrolling: the ADC of each belt with its check, and arrivals with and without forest."""
    belts = re.findall(r"(?:ADS \d|simple copp.*?) .*?([\d.]+) +[✔+]", screen.body)
    expect(belts and all(float(adc) < 30 for adc in belts), "the ADC of each belt", screen)
    wide = screen.width >= 110
    if screen.height > 24 or wide:
        expect(re.search(r"\bmean (kJ|energy)\b[^\n]*? 11[2345]\b", screen.body), "what arrives without forest", screen)


def check_view(screen, view, scene, charset):
    by_index = scene.endswith(BY_INDEX)
    screen.has(*MUST[view], *(MUST_INDEX if by_index else MUST_WOOD)[view])
    if screen.width >= 120:
        screen.has(*WIDE[view], *(WIDE_INDEX if by_index else WIDE_WOOD)[view])
    if view == "results":
        check_results(screen, by_index)
    if view == "stand" and screen.width >= 120:
        pattern = r"One pattern of many: \d+ met"
        expect(re.search(pattern + ("" if by_index else r"|The way of this rock: \d+ stems hit in 20 m"), screen.body), screen)
    if view == "slope":
        factor = re.search(r"heights drawn [\d.]+ times", screen.body)
        expect(bool(factor) == (screen.width == 80), "a factor of heights in words, or true scale on a wide screen", screen)
        expect(re.search(r"(?:^| )1 +135\* +end of th", screen.body, re.M), "the control is visible", screen)
        screen.has("ADS 1" if "paper-site" in scene else "simple coppice")
    if view == "compare" and not by_index:
        fails = "/".join(re.match(r".*? in (\d+) of (\d+) years", screen.verdict).groups())
        expect_equal(compared(screen)[0][1]["fail"], fails, "years that fail, in the table as in the answer")
    if view == "compare" and "four-systems" in scene:
        screen.has("/y")
        names = [name for name, _ in compared(screen)]
        expect_equal(len(set(names)), 8, f"names that can be told apart: {names}")
        if screen.width >= 120:
            energy = SIGNS["FAILS"][charset]
            expect_equal(names, EIGHT, "names of the options, whole")
            expect(all(by_index or signs[0] == energy for signs in compared_lights(screen)), "energy lights", compared_lights(screen))
    if view in ("slope", "stand", "rock"):
        where = {"slope": "from, m: where the belt begins", "stand": "from, m: where the belt begins",
                 "rock": "shape: shape of the rock"}[view]
        expect(screen.note.startswith(where), f"the line above the keys does not explain the field: {screen.note!r}")
    expect("nan" not in re.sub(r"\w*nan\w+|\w+nan\w*", "", screen.text.lower()), "a nan on the", screen)


def check_screen(size, view, scene, charset):
    screens = play_views(scene, charset)
    screen = screens[size, view]
    check_frame(screen, view, scene, charset)
    check_now(screen, scene, charset)
    expect_equal(screen.now, screens[size, "slope"].now, "the column on the right, as in the first view")
    check_view(screen, view, scene, charset)
    marks = {"braille": (0x2800, 0x28ff), "block": (0x2580, 0x259f)}.get(charset)
    if view == "slope" and marks:
        expect(sum(marks[0] < ord(c) <= marks[1] for c in screen.body) > 20, f"hardly any {charset} in the", screen)
    other = {"braille": "▀▄█", "block": "⠁⠂⠄⡀⣀⠉"}.get(charset)
    if view == "slope" and other:
        expect(not set(other) & set(screen.body), f"dots of another kind than {charset} in the", screen)

GOLDEN_STAND = """\
belt 1 of 2 · 2/34 ▼
    from, m        to, m          stand
1   0              67.5           ADS 1
2   67.5           135            ADS 2
Stand of belt 1: ADS 1
system                   simple coppice
species                  hop hornbeam
stools per ha            3688
2.258 shoots per stool
spacing, m               0.5
Shoots on the stools
1   8326     6.1      6        0.0107   0
Single trees: standards, reserves
1   750      6.1      6        0.0107   0"""
GOLDEN_ROCK = """\
Rock 2/37 ▼
shape                cylinder
diameter, m          0.56
height, m            0.80
mass, kg             -
density, kg/m³       2600
Release
x, m                 0
height, m            0"""


def test_golden():
    """The forms of stand and rock at 80x24, apart from blanks, have these lines."""
    screens = play_views("paper-site", "braille")
    for view, wanted in (("stand", GOLDEN_STAND), ("rock", GOLDEN_ROCK)):
        body = "\n".join(" ".join(x.split()) for x in screens[(80, 24), view].body.split("\n") if "diam. cm" not in x)
        expect(body.startswith(re.sub(" {2,}", " ", wanted.replace("\n    ", "\n"))), "wanted", wanted, "found", body)


def test_more_mark():
    """The mark of more text below does not cover a letter of the results."""
    for scene in SCENES:
        for size in SIZES:
            body = play_views(scene, "ascii")[size, "results"].body
            found = re.findall(r"\b\w*[a-uw-z]v[^\Waeiouy]\w*", body)
            expect(not found, f"{size}: in the middle of a word: {found}", body)


def test_years_view():
    """View 6 in every size and in each charset: a whole screen, and the column of its year."""
    for charset in CHARSETS:
        script = ["wait idle", "key 6", "wait idle"]
        for width, height in SIZES + [(60, 20)]:
            script += [f"resize {width} {height}", "key 1", "dump", "key 6", "dump"]
        screens = fast("\n".join(script), "wood.yaml", charset=charset)
        for slope, years in zip(screens[::2], screens[1::2]):
            years.whole()
            expect(re.search(r"^Year \d+", years.now, re.M) and "Year" not in slope.now, "the column follows the year", years)
            expect("nan" not in years.text.lower(), years)


def test_explanation():
    """The line above the keys has unit, range, default and source of the field."""
    screens = fast("""resize 200 50
        key 2
        find stools.per_ha
        dump
        key 1
        find roughness_rad
        key 3
        find rock.density_kg_m3
        dump
        find simulation.threshold_m
        dump
        find simulation.law
        dump""", "paper-site")
    expect_in("stools per horizontal hectare; 1/ha", screens[0].note)
    expect_in("[measured: Ciabocco, Boccia and Ripa 2009, Table 1", screens[0].note, "source")
    for part in ("density, kg/m³: ", "kg/m³", "(default 2600)", "[measured: Ciabocco"):
        expect_in(part, screens[1].note, "density")
    for part in ("threshold, m: ", "; m", "(default 30)"):
        expect_in(part, screens[2].note, "threshold")
    expect_in("(default crsp)", screens[3].note)


def test_assumed():
    """Assumed values have a star, measured ones none."""
    screen = fast("""resize 120 40
        key 2
        dump""", "four-systems")[0]
    expect_equal(screen.row("^stools per ha")[3], "2500*", "stools")
    screen = fast("key 2\ndump", "paper-site")[0]
    expect_equal(screen.row("^stools per ha")[3], "3688", "stools")


def test_too_small():
    """Below 60 x 16 a message gives the minimum; at 60 x 16 the views are complete."""
    screens = fast("""wait idle
        resize 59 15
        dump
        resize 60 15
        dump
        resize 59 16
        dump
        resize 20 4
        dump
        resize 1 1
        dump
        resize 80 24
        dump""")
    for screen in screens[:3]:
        screen.whole().has(f"The window ({screen.width} x {screen.height}) is too small: at least 60 x 16 is needed.", "q quits")
    screens[3].whole().has("The window")
    screens[4].whole()
    screens[5].whole().has("Belts of forest")


def test_keys_in_a_small_window():
    """Below 60 x 16 no key acts unseen; q ends the program, but not with unsaved changes"""
    unseen = "resize 40 10\nkey 1 2 d a y u p + - Enter Tab n o s S w : / Esc\ntype dn\n"
    with Place() as place:
        for opened, words in (("", "q quits."), ("key Enter\n", "q quits."), ("key ?\n", "q quits."), ("key o\n", "q quits."),
                              ("key +\n", "Unsaved changes: enlarge the window to quit."),
                              ("key + q\n", "Unsaved changes: enlarge the window to quit.")):
            script = f"key 2 /\ntype stools.per_ha\nkey Enter\nwait idle\n{opened}wait idle\n"
            if "Unsaved" in words:
                unseen += "key q F10\n"
            before, small, after = place.play(f"{script}dump\n{unseen}dump\nresize 80 24\ndump")
            small.has("The window (40 x 10) is too small", words)
            expect_equal(str(after), str(before), f"after {opened!r} and keys in a small window")
            ended = run_script(place.path, f"{script}resize 40 10\nkey q\ndump after.txt\n", "fast.yaml")
            expect_equal(ended.status, DONE)
            expect_equal((place.path / "after.txt").exists(), "Unsaved" in words, f"not ended by q after {opened!r}")
        expect_equal(place.text("fast.yaml"), FAST, "the file")


def check_smallest(view):
    if "smallest" not in _seen:
        script = "wait idle\nresize 60 16\n" + "".join(f"key {v + 1}\ndump\n" for v in range(len(VIEWS)))
        _seen["smallest"] = fast(script, "cuts.yaml", charset="ascii")
    screen = _seen["smallest"][VIEWS.index(view)].whole()
    at = screen.width - screen.side - 1
    for line in screen.lines[2:screen.height - 3]:
        line = line.ljust(60)
        expect(line[at] == "|" and line[at - 1] == line[at + 1] == " ", "view and figures run into each other", screen)
    expect_equal(lights(screen, "ascii")["Contact"], "passes", "light")
    for part in ("? help", "q quit"):
        expect_in(part, screen.bar, "bar")


def test_any_size():
    """Every view and help in sizes from 60 x 16 to 300 x 100 fill the screen exactly."""
    script = ["wait idle"]
    for width, height in ((60, 16), (61, 17), (79, 25), (99, 20), (100, 30), (139, 21), (140, 60), (300, 20), (60, 100),
                          (300, 100)):
        script.append(f"resize {width} {height}")
        script += [line for v in "123456" for line in (f"key {v}", "dump")] + ["key ?", "dump", "key Esc"]
    for scene in ("options.yaml", "cuts.yaml"):
        for screen in fast("\n".join(script), scene):
            screen.whole()


# ---- details of scripts ----

def test_script_words():
    """An unknown command, key or size ends with status 2 and its line, an unwritable dump with 4."""
    with Place() as place:
        for line, what in (("frobnicate", "frobnicate"), ("key Nokey", "Nokey"), ("resize 80", "80"), ("resize 0 5", ""),
                           ("resize 100000 5", ""), ("resize a b", ""), ("wait", ""), ("wait long", ""),
                           ("dump no/such/folder/file.txt", "no/such/folder/file.txt"), ("Dump x", "Dump")):
            done = run_script(place.path, f"# a comment\n\nkey 2\n{line}\nkey q\n", "fast.yaml")
            wanted = OUTPUT if line.startswith("dump") else USAGE
            expect(done.status == wanted, f"'{line}': status {done.status}, {wanted} wanted", done)
            expect(done.err.startswith("play.txt:4: ") and what in done.err, f"'{line}'", done)
            expect_equal(done.err.count("\n"), 1, "lines on standard error")
        done = run_script(place.path, "key 2\n", "fast.yaml", "--script", "none.txt")
        expect(done.status != DONE and "none.txt" in done.err, done)
        done = run_script(place.path, "key 2\n", "none.yaml")
        expect(done.status == INPUT and "none.yaml" in done.err, done)


def test_script_end():
    """A script may end at any point, in CRLF, without a last line end, and nothing runs after quitting."""
    with Place() as place:
        done = run_script(place.path, "key 2\r\nkey q\r\ndump late.txt\r\n", "fast.yaml")
        expect(done.status == DONE and not (place.path / "late.txt").exists(), done)
        for script in ("", "key ?", "key Enter", "type x", "key n", "# only a comment"):
            expect_equal(run_script(place.path, script, "fast.yaml").status, DONE, script)
        expect_equal(place.text("fast.yaml"), FAST, "the scene")


def test_script_stdout():
    """'dump -' writes only the screen to standard output."""
    with Place() as place:
        done = run_script(place.path, "key 3\ndump -\n", "fast.yaml", "--charset", "ascii")
        expect_equal(done.out.count("\n"), 24, "lines")
        expect(done.out.startswith(" 1 slope 2 stand") and done.err == "", done)


def test_without_scene():
    """Without a scene the paper's site opens."""
    with Folder() as folder:
        screen = play.play(folder.path, "key 3\ndump")[0]
    screen.has("Test site of", "diameter, m 0.56")


def test_charset_of_locale():
    """The locale chooses the picture's dots; --charset and the key b override it."""
    with Place() as place:
        run_script(place.path, "wait idle\ndump a.txt\nkey b\ndump b.txt\nkey b\ndump c.txt\n", "fast.yaml")
        expect(re.search("[\u2801-\u28ff]", place.text("a.txt")), place.text("a.txt"))
        expect(re.search("[▀▄█]", place.text("b.txt")) and not re.search("[\u2801-\u28ff]", place.text("b.txt")),
               place.text("b.txt"))
        expect(place.text("c.txt").isascii(), place.text("c.txt"))
        before = play.home
        try:
            play.home = lambda *words: {**before(*words), "LC_ALL": "C"}
            run_script(place.path, "wait idle\ndump d.txt\nkey ?\ndump e.txt\n", "fast.yaml")
        finally:
            play.home = before
        expect_equal(place.text("d.txt"), place.text("c.txt"), "the screen under LC_ALL=C")
        expect(place.text("e.txt").isascii(), place.text("e.txt"))


def main():
    suite = Suite()
    for scene in SCENES:
        for charset in CHARSETS:
            for width, height in SIZES:
                for view in VIEWS[:5]:
                    suite.check(f"screen: {scene}, {charset}, {width}x{height}: {view}", check_screen, (width, height),
                                view, scene, charset)
    for view in VIEWS:
        suite.check(f"screen: 60x20: {view}", check_smallest, view)
    suite.run(list_tests(sys.modules[__name__]))
    suite.end()


if __name__ == "__main__":
    main()
