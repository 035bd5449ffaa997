#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The screens of the terminal program, from scripts and without any terminal: what stands on them, and what each key
does to the scene, to the figures and to the files."""
import json
import math
import os
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import play  # noqa: E402
from play import FAST, OPTIONS, VIEWS, WOOD, Place, actions, check_good, fast, run_script  # noqa: E402
from harness import (DONE, INPUT, OUTPUT, PROFILES, USAGE, Folder, Skip, Suite, expect, expect_equal,  # noqa: E402
                     expect_in, expect_near, results, tests_of)

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
    """The name of a shipped scene, or of a copy of it that is computed by the index alone."""
    name = scene.removesuffix(BY_INDEX)
    if name == scene:
        return name
    text = (PROFILES / f"scenes/{name}.yaml").read_text()
    expect_equal(text.count("simulation: {"), 1, name)
    folder.write(f"{name}.yaml", text.replace("simulation: {", "simulation: {contact_model: index, "))
    return f"{name}.yaml"


def views_of(scene, charset):
    """The views in every size, played once for all charsets; but the one of the years, which takes long."""
    if scene not in _seen:
        script = ["wait idle"]
        for _ in CHARSETS:
            for width, height in SIZES:
                script.append(f"resize {width} {height}")
                script += [line for v in range(5) for line in (f"key {v + 1}", "clear", "dump")]
            script.append("key b")
        with Folder() as folder:
            screens = play.play(folder.path, "\n".join(script), scene_for(folder, scene))
        keys = [(c, size, view) for c in CHARSETS for size in SIZES for view in VIEWS[:5]]
        _seen[scene] = dict(zip(keys, screens, strict=True))
    return {key[1:]: screen for key, screen in _seen[scene].items() if key[0] == charset}


def lights(screen, charset):
    """{'Contact': 'passes', …}: the sign and the word must agree."""
    found = {}
    for name in ("Contact", "Free run", "Energy"):
        match = re.search(rf"^(\S) {name} +(\w+)", screen.now, re.M)
        expect(match, f"no light '{name}' in the", screen)
        sign, word = match.groups()
        expect(word in SIGNS and SIGNS[word][charset] == sign, f"the sign {sign!r} does not go with {name} {word}", screen)
        found[name] = word
    return found


def check_frame(screen, scene, charset):
    screen.whole()
    for i, view in enumerate(VIEWS):
        expect_in(f"{i + 1} {view}", screen.title, "title")
    title = "Test site of Ciabocco et al. 2009" if "paper-site" in scene else "Four systems, before and after the cut"
    expect_in(title if screen.width >= 120 else title[:18], screen.title, "title")
    for part in ("? help", "q quit", "Enter edit", "u undo", "s save", "p presets"):
        expect_in(part, screen.bar, "the bar of keys")
    wall = "|" if charset == "ascii" else "│"
    at = screen.width - screen.side - 1
    for y in range(2, screen.height - 3):
        line = screen.lines[y].ljust(screen.width)
        expect(line[at] == wall and line[at - 1] == line[at + 1] == " ",
               f"line {y + 1}: something reaches over the wall between view and figures: {line!r}", screen)
    expect(screen.lines[1] == "" and screen.lines[screen.height - 3] == "", "a line of distance is not empty", screen)
    if charset == "ascii":
        expect(screen.text.isascii(), "not pure ASCII:", ascii(screen.text))


def check_now(screen, scene, charset):
    now, by_index = screen.now, scene.endswith(BY_INDEX)
    expect_in("Rock  0.68 m  512.3 kg", now)
    expect_in("At 135 m, end of the forest", now)
    sign = r"\+-" if charset == "ascii" else "±"
    share = "-" if by_index else r"\d+ \(\d+-\d+\)" if screen.width >= 120 else rf"\d+{sign}\d+"
    figure = "-" if by_index else r"[\d.]+"
    for pattern in (r"^of 1000 +wood +bare$", rf"^ arrive +{share} +\d+$", rf"^ >50 kJ +{share} +\d+$",
                    rf"^ kJ mean +{figure} +[\d.]+$", rf"^ kJ 95 % +{figure} +[\d.]+$", rf"^ m  95 % +{figure} +[\d.]+$",
                    r"^index: -[\d.]+, left [\d.]+ kJ$", rf"^= {sign}[\d.]+ % \d+ rocks$"):
        expect(re.search(pattern, now, re.M), f"nothing like {pattern!r} in the column on the right:", now)
    found = lights(screen, charset)
    expect_equal(found, {"Contact": "passes", "Free run": "passes", "Energy": "unknown" if by_index else "FAILS"}, "lights")
    for pattern in (r"^stopped by stems +\d+$", r"^at rest +\d+$"):
        expect(bool(re.search(pattern, now, re.M)) != by_index, f"{pattern!r} in the column on the right:", now)
    if not by_index:
        check_pairs(screen)
    if "paper-site" in scene:
        expect_in("seen: 62.3 kJ (one rock)", now)
        expect_in("Eq. 6 gives", now, "the warning about ADS 2")


def check_pairs(screen):
    """Through the wood no more arrive, and with no more energy, than without it; the energy light goes by the share."""
    for name in ("arrive", ">50 kJ", "kJ mean", "kJ 95 %", "m  95 %"):
        wood, bare = screen.pair(name)
        expect(wood < bare, f"{name}: {wood} through the wood, {bare} without", screen.now)
    share = float(re.search(r"Energy +\w+ ([\d.]+) %", screen.now).group(1))
    expect_near(share * 10, screen.pair(">50 kJ")[0], 0.51, "the share beside the light")


MUST = {
    "slope": ["Belts of forest", "from_m to_m stand", "energy, kJ", "0 m", "Controls"],
    "stand": ["from_m to_m stand", "Stand of belt 1:", "system", "species", "stools per ha", "spacing, m",
              "Shoots on the stools", "Single trees: standards, reserves", "per_ha dbh_m height_m",
              "stems/ha, basal area", "by interception", "kJ per 100 m"],
    "rock": ["shape cylinder", "diameter, m 0.56", "height, m 0.80", "density, kg/m3 2600", "Release", "x, m 0",
             "spin, rad/s 0", "Simulation", "law of impact lumped", "512.3 kg", "mean diameter B 0.68 m"],
    "results": ["kJ", "50 kJ", "p50", "p95", "bears 50", "of 1000"],
    "compare": ["ADC m free run"]}
WIDE = {"slope": ["release", "end of the forest (135 m)", "rn rt roughness_rad friction",
                  "x_m name accepted_kJ measured_speed_m_s", "facets against"],
        "stand": ["Energy of a contact", "model brauner", "fracture ratio"],
        "rock": ["form of the ADC auto", "threshold, m 30", "gravity, m/s2 9.81", "seed 1", "title"],
        "results": ["30 m: in this distance without a contact a rock reaches its full speed",
                    "Contact: passes.", "Free run: passes."],
        "compare": ["option ADC m free run"]}
# With rocks in the wood, and by the index alone.
MUST_WOOD = {"slope": ["wood", "bare"], "stand": [], "rock": ["rocks among stems stems"],
             "results": ["bare 991"], "compare": ["free run too much to first CFE"]}
WIDE_WOOD = {"slope": ["p95 of the height, m", "mean energy, kJ", "ways of 102400 through"], "stand": [],
             "rock": [], "results": ["Of 1000,", "are stopped by stems", "Energy: FAILS.", "of 1000 released"], "compare": []}
MUST_INDEX = {"slope": [], "stand": [], "rock": ["rocks among stems index"], "results": ["n = 101519 of 102400"],
              "compare": ["free run kJ/100m left kJ CFE"]}
WIDE_INDEX = {"slope": ["height above the ground, m", "without forest", "p95", "p50"], "stand": [], "rock": [],
              "results": ["Energy: unknown. The index alone"], "compare": []}


FIGURES = re.compile(r"(.*?) +([\d.]+|none|-)([*! ]) +([\d.]+ %)([*! ]) +(?:([\d.]+|-)([*! ]) +([\d.]+|-|used up)([*! ])"
                     r"|(\d+|…|\.\.\.)([*! ]) +(first|…|\.\.\.|[-+]\d+(?:±|\+-)\d+)([*! ])) +([✔✘?+x]{3})$")


def compared(screen):
    """The table of the compare view: (name, [(figure, mark) of each column]); figures may stand below the name."""
    rows, name = [], ""
    for line in screen.body.split("\n")[1:]:
        found = FIGURES.match(line)
        if found:
            parts = [p for p in found.groups() if p is not None]
            rows.append((parts[0].strip() or name, list(zip(parts[1:9:2], parts[2:9:2]))))
        name = line.strip()
    return rows


def compared_lights(screen):
    """The three signs at the end of each option's line."""
    return [found.group(found.lastindex) for found in map(FIGURES.match, screen.body.split("\n")[1:]) if found]


def check_view(screen, view, scene, charset):
    by_index = scene.endswith(BY_INDEX)
    screen.has(*MUST[view], *(MUST_INDEX if by_index else MUST_WOOD)[view])
    if screen.width >= 120:
        screen.has(*WIDE[view], *(WIDE_INDEX if by_index else WIDE_WOOD)[view])
    if view == "results" and "four-systems" in scene and screen.width >= 120:
        screen.has("applied: passes", "gsteiger-stools", "gsteiger-stems", "interception", "crofton")
    if view == "results":
        rows = re.findall(r"(through the wood|without forest):? (\d+) \(", re.sub(r"\s+", " ", screen.body), re.I)
        bare = ("without forest", "991")
        expect(bare in [(name.lower(), n) for name, n in rows], "what arrives without forest", screen)
        expect_equal("through the wood" in [name.lower() for name, _ in rows], not by_index, f"what arrives\n{screen}")
    if view == "stand" and screen.width >= 120:
        pattern = r"One pattern of many(\. The rock \(0\.68 m wide\) meets \d+ stools or trees in 20 m|: \d+ stools or trees are met)"
        expect(re.search(pattern + ("" if by_index else r"|The way of this rock: \d+ stems hit in 20 m"), screen.body), screen)
    if view == "slope":
        screen.has("heights x" if charset == "ascii" else "heights ×")
        screen.has("ADS 1" if "paper-site" in scene else "simple coppice")
    if view == "compare" and "four-systems" in scene:
        screen.has("* best, ! worst")
        expect_equal([name for name, _ in compared(screen)], EIGHT, "names of the options, whole")
        energy = SIGNS["unknown" if by_index else "FAILS"][charset]
        expect(all(signs[2] == energy for signs in compared_lights(screen)), "energy lights", compared_lights(screen))
    if view in ("slope", "stand", "rock"):
        where = {"slope": "from_m  where the belt begins", "stand": "from_m  where the belt begins",
                 "rock": "shape  shape of the rock"}[view]
        expect(screen.note.startswith(where), f"the line above the keys does not explain the field: {screen.note!r}")
    expect("nan" not in re.sub(r"\w*nan\w+|\w+nan\w*", "", screen.text.lower()), "a nan on the", screen)


def check_screen(size, view, scene, charset):
    screens = views_of(scene, charset)
    screen = screens[size, view]
    check_frame(screen, scene, charset)
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
    from_m         to_m           stand
1   0              67.5           ADS 1
2   67.5           135            ADS 2
Stand of belt 1: ADS 1
system            simple-coppice
species           ostrya-carpinifolia
stools per ha     3688
spacing, m        0.5
Shoots on the stools
1   8326     0.061    6        0.0107   0
Single trees: standards, reserves
1   750      0.061    6        0.0107   0"""
GOLDEN_ROCK = """\
Rock
shape             cylinder
diameter, m       0.56
height, m         0.80
mass, kg          -
density, kg/m3    2600
Release
x, m              0
height, m         0"""


def test_golden():
    """The forms of stand and rock at 80x24 stand as they always stood."""
    screens = views_of("paper-site", "braille")
    body = "\n".join(x for x in screens[(80, 24), "stand"].body.split("\n") if "per_ha   dbh_m" not in x)
    expect(body.startswith(GOLDEN_STAND), "wanted", GOLDEN_STAND, "found", body)
    expect(screens[(80, 24), "rock"].body.startswith(GOLDEN_ROCK), "wanted", GOLDEN_ROCK, screens[(80, 24), "rock"])


def test_more_mark():
    """The mark of more text below does not stand on a letter of the results."""
    for scene in SCENES:
        for size in SIZES:
            body = views_of(scene, "ascii")[size, "results"].body
            found = re.findall(r"\b\w*[a-uw-z]v[^\Waeiouy]\w*", body)
            expect(not found, f"{size}: in the middle of a word: {found}", body)


def test_years_view():
    """View 6 in every size and in each charset: a whole screen, the column on the right is that of the other views."""
    for charset in CHARSETS:
        script = ["wait idle", "key 6", "wait idle"]
        for width, height in SIZES + [(60, 20)]:
            script += [f"resize {width} {height}", "key 1", "dump", "key 6", "dump"]
        screens = fast("\n".join(script), "wood.yaml", charset=charset)
        for slope, years in zip(screens[::2], screens[1::2]):
            years.whole()
            expect_equal(years.now, slope.now, "the column on the right, as in the first view")
            expect("nan" not in years.text.lower(), years)


def test_explanation():
    """The line above the keys tells unit, range, default and source of the field."""
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
    for part in ("density_kg_m3", "kg/m3", "(default 2600)", "[measured: Ciabocco"):
        expect_in(part, screens[1].note, "density")
    for part in ("threshold_m", "; m", "(default 30)"):
        expect_in(part, screens[2].note, "threshold")
    expect_in("(default lumped)", screens[3].note)


def test_assumed():
    """What is assumed carries a star, what is measured none."""
    screen = fast("""resize 120 40
        key 2
        dump""", "four-systems")[0]
    expect_equal(screen.row("^stools per ha")[-1], "2500*", "stools")
    screen = fast("key 2\ndump", "paper-site")[0]
    expect_equal(screen.row("^stools per ha")[-1], "3688", "stools")


def test_too_small():
    """Below 60 x 20 a message says what is needed; at 60 x 20 the views are there, whole and in their place."""
    screens = fast("""wait idle
        resize 59 19
        dump
        resize 60 19
        dump
        resize 59 20
        dump
        resize 20 4
        dump
        resize 1 1
        dump
        resize 80 24
        dump""")
    for screen in screens[:3]:
        screen.whole().has(f"ceduo needs a window of 60 x 20; this one is {screen.width} x {screen.height}.", "q quits")
    screens[3].whole().has("ceduo needs a")
    screens[4].whole()
    screens[5].whole().has("Belts of forest")


def check_smallest(view):
    if "smallest" not in _seen:
        script = "wait idle\nresize 60 20\n" + "".join(f"key {v + 1}\ndump\n" for v in range(len(VIEWS)))
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
    """Every view and help in sizes from 60 x 20 to 300 x 100 fills the screen exactly."""
    script = ["wait idle"]
    for width, height in ((60, 20), (61, 21), (79, 25), (99, 20), (100, 30), (139, 21), (140, 60), (300, 20), (60, 100),
                          (300, 100)):
        script.append(f"resize {width} {height}")
        script += [line for v in "123456" for line in (f"key {v}", "dump")] + ["key ?", "dump", "key Esc"]
    for scene in ("options.yaml", "cuts.yaml"):
        for screen in fast("\n".join(script), scene):
            screen.whole()


# ---- the small things of a script ----

def test_script_words():
    """An unknown command, key or size ends with status 2 and its line, a dump that cannot be written with 4."""
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
    """A script may end at any point, in CRLF, without a last line end, and after quitting nothing more is done."""
    with Place() as place:
        done = run_script(place.path, "key 2\r\nkey q\r\ndump late.txt\r\n", "fast.yaml")
        expect(done.status == DONE and not (place.path / "late.txt").exists(), done)
        for script in ("", "key ?", "key Enter", "type x", "key n", "# only a comment"):
            expect_equal(run_script(place.path, script, "fast.yaml").status, DONE, script)
        expect_equal(place.text("fast.yaml"), FAST, "the scene")


def test_script_stdout():
    """'dump -' writes the screen to standard output, and nothing else is there."""
    with Place() as place:
        done = run_script(place.path, "key 3\ndump -\n", "fast.yaml", "--charset", "ascii")
        expect_equal(done.out.count("\n"), 24, "lines")
        expect(done.out.startswith(" 1 slope  2 stand") and done.err == "", done)


def test_without_scene():
    """Without a scene the paper's site is opened."""
    with Folder() as folder:
        screen = play.play(folder.path, "key 3\ndump")[0]
    screen.has("Test site of Ciabo", "diameter, m 0.56")


def test_charset_of_locale():
    """The locale chooses the picture's dots, --charset and the key b others."""
    with Place() as place:
        run_script(place.path, "wait idle\ndump a.txt\nkey b\ndump b.txt\nkey b\ndump c.txt\n", "fast.yaml")
        expect(re.search("[\u2801-\u28ff]", place.text("a.txt")), place.text("a.txt"))
        expect(re.search("[▀▄█]", place.text("b.txt")) and not re.search("[\u2801-\u28ff]", place.text("b.txt")),
               place.text("b.txt"))
        expect(place.text("c.txt").isascii(), place.text("c.txt"))
        before = play.home
        try:
            play.home = lambda folder: {**before(folder), "LC_ALL": "C"}
            run_script(place.path, "wait idle\ndump d.txt\nkey ?\ndump e.txt\n", "fast.yaml")
        finally:
            play.home = before
        expect_equal(place.text("d.txt"), place.text("c.txt"), "the screen under LC_ALL=C")
        expect(place.text("e.txt").isascii(), place.text("e.txt"))


# ---- live ----

FIGURE_NAMES = ("arrive", ">250 kJ", "kJ mean", "kJ 95 %", "m  95 %")


def index_of(screen):
    """What the index takes and leaves, of the column on the right."""
    found = re.search(r"^index: -([\d.]+), left ([\d.]+) kJ$", screen.now, re.M)
    expect(found, "no index in the column on the right:", screen.now)
    return float(found.group(1)), float(found.group(2))


def test_stand_edit():
    """A change of the stand changes ADC, lights, index and what comes through the wood at once, nothing without forest."""
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
            taken, left = index_of(screen)
            expect(taken < index_of(before)[0] - 1, "fewer stools, yet the index takes", screen.now)
            expect_near(left + taken, screen.pair("kJ mean")[1], 1, "Eq. 5")
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
    """A change of rock or ground changes what passes and its energy, with and without forest."""
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
    for text in (WOOD, play.in_the_index(WOOD)):
        with Place() as place:
            place.write("wood.yaml", text)
            before, mass, ground = place.play(script, "wood.yaml")
        expect(float(re.search(r"Rock +[\d.]+ m +([\d.]+) kg", mass.now).group(1)) > 2600, mass.now)
        bare = {name: [s.pair(name)[1] for s in (before, mass, ground)] for name in FIGURE_NAMES}
        expect(bare["kJ mean"][1] > bare["kJ mean"][0] * 1.8 and bare[">250 kJ"][1] > bare[">250 kJ"][0], bare)
        expect_near(bare["arrive"][1], bare["arrive"][0], 3, "the lumped law knows no mass: arrive")
        expect(bare["kJ mean"][2] < bare["kJ mean"][1], bare)
        if text != WOOD:
            continue
        wood = {name: [s.pair(name)[0] for s in (before, mass, ground)] for name in FIGURE_NAMES}
        expect(wood["kJ mean"][1] > wood["kJ mean"][0] * 1.8 and wood["arrive"][1] > wood["arrive"][0],
               "a larger rock loses a smaller share to the stems", wood)
        expect(wood["kJ mean"][2] < wood["kJ mean"][1] and wood["arrive"][2] < wood["arrive"][1], "the softer ground", wood)


def test_contact_model():
    """contact_model edited to index and back: the column on the right, the lights, views 3 and 5 follow, and come back."""
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
        key +
        wait idle
        {both}
        key Enter End Enter
        wait idle
        {both}
        key 5
        {both}""", "cuts.yaml")
    for at in (0, 1):
        stems, index, compared_index, poisson, back, compared_back = screens[at::2]
        expect_equal([s.row("^rocks among stems")[-1] for s in (stems, index, poisson, back)],
                     ["stems", "index", "poisson", "stems"], "contact_model")
        expect_equal([lights(s, "braille")["Energy"] for s in (stems, index, back)], ["FAILS", "unknown", "FAILS"], "energy light")
        for name in FIGURE_NAMES:
            expect(None not in stems.pair(name) + poisson.pair(name), name, stems.now)
            expect_equal(index.pair(name)[0], None, f"'{name}' through the wood by the index")
            bare = [s.pair(name)[1] for s in (stems, index, poisson, back)]
            expect_equal(bare, bare[:1] * 4, f"'{name}' without forest")
        expect(poisson.pair("kJ mean") != stems.pair("kJ mean"), "poisson is as stems", poisson)
        expect(not re.search("stopped by stems|at rest", index.now), "ends through the wood by the index", index)
        expect_equal([index_of(s) for s in (index, poisson)], [index_of(stems)] * 2, "the index")
        expect_in("left kJ", compared_index.body)
        expect_in("too much", compared_back.body)
        expect_equal(back.text.replace("*", " "), stems.text.replace("*", " "), "after index and back")


def test_control_edit():
    """Another place to count at: no figure of the old place stands under the new name, none is 'nan'."""
    script = """wait idle
        find controls[1]
        key d
        dump
        wait idle
        dump
        find controls[0]
        key a
        dump
        wait idle
        dump
        find controls[0]
        set 50
        dump
        wait idle
        dump"""
    for scene in ("fast.yaml", "wood.yaml"):
        screens = fast(script, scene)
        for screen in screens:
            expect(not re.search(r">-?nan", screen.now), "the energy that nobody gave is compared with", screen)
        screens[1].has("At 60 m, track", ">20 kJ")
        screens[3].has("At 80 m")
        expect(">" not in screens[3].now.split("passes")[0], "an accepted energy that was not given:", screens[3])
        expect_equal(lights(screens[3], "braille")["Energy"], "unknown", "without an accepted energy")
        screens[5].has("At 80 m")
        for at in (1, 3, 5):
            wanted = r"^= ±0 % \d+ rocks" if scene == "fast.yaml" else r"^= ±0\.\d+ % \d+ rocks"
            expect(re.search(wanted, screens[at].now, re.M), screens[at])


def test_undo():
    """Undo and redo bring back the very same screens."""
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
    """Undo of a change of the rock brings back the figures too, which are flown anew."""
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
    expect_in("Esc leaves it as it was", refused.bar, "still in the field")
    expect_in(value, refused.body, "what was typed is still there")
    expect_equal(refused.now, before.now, "the figures")
    expect_equal(after.text, before.text, "after Esc")


def test_wrong_values():
    """A wrong value is explained in place and never accepted."""
    wrong(2, "shoots[0].dbh_m", "-0.07", "dbh_m", "-0.07 is below 0 m")
    wrong(2, "stools.per_ha", "3000,5", "'3000,5' is no number", "dot")
    wrong(2, "stools.per_ha", "many", "'many' is no number")
    wrong(2, "stools.per_ha", "nan", "no number")
    wrong(2, "stools.per_ha", "1e400", "")
    wrong(2, "stools.per_ha", "0", "")
    wrong(3, "rock.diameter_m", "0", "")
    wrong(3, "rock.diameter_m", "0x10", "no number")
    wrong(3, "release.x_m", "-7", "")
    wrong(1, "forest[1].from_m", "20", "")
    wrong(1, "forest[1].from_m", "1000", "")
    wrong(1, "controls[1].x_m", "60", "")
    wrong(1, "vertices_m[1]", "[0, 1]", "")
    wrong(1, "vertices_m[1]", "here", "")


def test_message_whole():
    """At 80 columns too a refusal can be read to its end."""
    refused = fast("""find vertices_m[1]
        key Enter Ctrl-U
        type [0, 1]
        key Enter
        dump
        resize 200 50
        dump""")
    expect_equal(refused[0].note, refused[1].note, "at 80 columns, and at 200")


def test_escape():
    """Esc leaves a field as it was, whatever was typed."""
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
    expect(screens[1].title.endswith("* uber dem We"), screens[1])
    expect(screens[2].title.endswith("* Àuer dem We"), screens[2])
    screens[3].whole()


def test_empty_value():
    """A field that is emptied takes its default."""
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
        key +
        dump
        key -
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
    expect_equal([s.row("^law of impact")[-1] for s in screens[6:8]], ["crsp", "lumped"], "law")
    expect_in("the limit of its range", screens[8].note)
    expect_equal(screens[8].row(r"^1 +1(\.0*)? +0.98")[0], "1", "rn at its limit")


def table(screen, head):
    """The rows of the table below the line that starts with these words: lists of words."""
    lines = screen.body.split("\n")
    at = next((i for i, line in enumerate(lines) if line.split()[:len(head)] == head), None)
    expect(at is not None, f"no table {head} in the", screen)
    rows = []
    for line in lines[at + 1:]:
        if not re.match(r"\d+ ", line):
            break
        rows.append(line.split())
    return rows


def lists(view, word, keys, head, size="120 60"):
    """The tables after each of some keys, with the cursor on a word."""
    script = f"resize {size}\nkey {view}\nwait idle\nfind {word}\ndump\n"
    script += "\n".join(f"key {key}\ndump" for key in keys)
    return [table(s, head) for s in fast(script)]


def test_belts():
    """Belts: y splits one in two, d deletes, a fills the next free stretch, u brings back."""
    head = ["from_m", "to_m", "stand"]
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
    head = ["per_ha", "dbh_m", "height_m"]
    start, copy, moved, fewer, one, none = lists(2, "shoots[0]", ["y", ">", "d", "d", "d"], head)
    expect_equal([r[1] for r in start], ["9000", "500"], "shoots")
    expect_equal([r[1] for r in copy], ["9000", "9000", "500"], "after y")
    expect_equal([r[1] for r in moved], ["9000", "500", "9000"], "after >")
    expect_equal([r[1] for r in fewer], ["9000", "500"], "after d")
    expect_equal(len(one), 1, "after d d")
    expect_equal(none, [], "after d d d")
    start, later, earlier = lists(2, "shoots[1]", ["<", ">"], head)
    expect_equal([r[1] for r in later], ["500", "9000"], "after <")
    expect_equal(earlier, start, "after < >")
    screens = fast("""resize 120 60
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


def test_segments():
    """Segments: y splits one in two, d joins them again."""
    head = ["rn", "rt", "roughness_rad"]
    start, split, joined = lists(1, "segments[0]", ["y", "d"], head, "200 70")
    expect_equal([r[1] for r in start], ["0.3", "0.25"], "rn")
    expect_equal([r[1] for r in split], ["0.3", "0.3", "0.25"], "rn after y")
    expect_equal(len(joined), 2, "segments after d")


def test_vertices():
    """Vertices: a pair is typed; keys that cannot add or delete one say why."""
    screens = fast("""resize 200 70
        find vertices_m[1]
        set [60, 35]
        dump
        key y
        dump
        key d
        dump""")
    counts = [len(re.findall(r"^\d +\S+ \S+$", s.body.split("Vertices")[1], re.M)) for s in screens]
    expect_in("60 35", screens[0].body)
    expect_equal(counts[0], 3, "vertices")
    for i in (1, 2):
        expect(counts[i] != counts[i - 1] or not screens[i].note.startswith("vertices_m"),
               "nothing is done and nothing is said", screens[i])


def test_controls():
    """Controls: a and y add one, d deletes, < and > reorder, the last one stays."""
    head = ["x_m", "name", "accepted_kJ"]
    start, more, back, fewer, one, same = lists(1, "controls[1]", ["a", "<", "d", "d", "d"], head, "200 70")
    expect_equal([r[1] for r in start], ["60", "80"], "controls")
    expect(len(more) == 3 and 80 < float(more[2][1]) <= 100, more)
    expect_equal([r[1] for r in back], ["60", more[2][1], "80"], "after <")
    expect_equal([r[1] for r in fewer], ["60", "80"], "after d")
    expect_equal(len(one), 1, "after d d")
    expect_equal(same, one, "after d d d")


def option_names(screen):
    return [name for name, _ in compared(screen)]


def test_options():
    """Options: y copies, d deletes, < > reorder, Enter renames, the only one stays."""
    screens = fast("""resize 120 40
        key 5
        wait idle
        dump
        key y
        dump
        key > >
        dump
        key <
        dump
        key Enter
        type Più rado
        key Enter
        dump
        key d
        dump
        key u
        dump
        key g d d d d d
        dump""", "options.yaml")
    names = [option_names(s) for s in screens]
    expect_equal(names[0], ["thick", "thin", "none left"], "options")
    expect_equal(names[1], ["thick", "thick (2)", "thin", "none left"], "after y")
    expect_equal(names[2], ["thick", "thin", "none left", "thick (2)"], "after > >")
    expect_equal(names[3], ["thick", "thin", "thick (2)", "none left"], "after <")
    expect_equal(names[4], ["thick", "thin", "Più rado", "none left"], "after renaming")
    expect_equal(names[5], ["thick", "thin", "none left"], "after d")
    expect_in("deleted 'Più rado'; u brings it back", screens[5].note)
    expect_equal(names[6], names[4], "after u")
    expect_equal(len(names[7]), 1, "after many d")
    expect_in("the only option stays", screens[7].note)


def test_names_of_copies():
    """y on a copy counts its number up, whatever else stands in the name."""
    found = option_names(fast("resize 120 40\nkey 5\nwait idle\n" + "key y\n" * 3 + "wait idle\ndump", "options.yaml")[0])
    expect_equal(found[:4], ["thick", "thick (2)", "thick (3)", "thick (4)"], "copies of copies")
    with Place() as place:
        place.write("named.yaml", OPTIONS.replace("name: thick", "name: cut (2031)").replace("name: none left", "name: a (x)"))
        found = option_names(place.play("resize 120 40\nkey 5\nwait idle\nkey y G y\nwait idle\ndump", "named.yaml")[0])
    expect_equal(found, ["cut (2031)", "cut (2031) (2)", "thin", "a (x)", "a (x) (2)"], "numbers that are none of copies")


def test_contact_reason():
    """The light of contact tells what fails: a gap where that is it, otherwise the ADC."""
    text = FAST.replace("[[0, 80], [60, 30], [100, 0]]", "[[0, 80], [60, 30], [160, 0]]").replace("x_m: 80", "x_m: 150")
    with Place() as place:
        for to_m, from_m, width, words in ((45, 82.5, 80, "FAILS gap 37.5 m"), (45, 82.5, 120, "FAILS gap 37.5 m (>30)"),
                                           (82, 90, 80, "FAILS gap 32 m")):
            end = 150 if from_m > 80.5 and to_m == 45 else 118
            place.write("gap.yaml", text.replace("to_m: 45", f"to_m: {to_m}").replace("from_m: 50", f"from_m: {from_m}")
                        .replace("to_m: 80", f"to_m: {end}").replace("{per_ha: 1000, spacing_m: 0.3}",
                                                                    "{per_ha: 3000, spacing_m: 0.3}")
                        .replace("per_ha: 2500, dbh_m: 0.05", "per_ha: 9000, dbh_m: 0.06"))
            screen = place.play(f"resize {width} 30\nwait idle\ndump", "gap.yaml")[0]
            expect(re.search(rf"✘ Contact +{re.escape(words)}$", screen.now, re.M), words, screen)
    screen = fast("key 5 Down\nwait idle\ndump", "options.yaml")[0]
    expect(re.search(r"✘ Contact +FAILS 143 m$", screen.now, re.M), "the ADC", screen)
    screen = fast("key 5 Down Down\nwait idle\ndump", "options.yaml")[0]
    expect(re.search(r"✘ Contact +FAILS no forest$", screen.now, re.M), screen)


def test_index_zero():
    """Where no stems take anything the index takes 0, not -0."""
    screen = fast("key 5 Down Down\nwait idle\ndump", "options.yaml")[0]
    expect(re.search(r"index: 0, left [\d.]+ kJ", screen.now), screen)


def test_rename_refused():
    """Two options cannot have one name; the refusal says so and keeps the question."""
    screen = fast("key 5\nkey Enter Ctrl-U\ntype thin\nkey Enter\ndump", "options.yaml")[0]
    screen.has("Name of this option")
    expect(re.search("thin", screen.text) and "thick" in screen.text, screen)


def test_compare_marks():
    """Best and worst of each column are marked, with signs; figures are those of each option."""
    screen = fast("resize 120 40\nkey 5\nwait idle\ndump", "options.yaml", charset="ascii")[0]
    rows = dict(compared(screen))
    expect_equal(list(rows), ["thick", "thin", "none left"], "options")
    for c, best, worst in ((0, "thick", "none left"), (1, "thick", "none left"), (2, "thick", "none left")):
        expect(rows[best][c][1] == "*", f"column {c}: '{best}' is best", rows)
        expect(rows[worst][c][1] == "!", f"column {c}: '{worst}' is worst", rows)
    by_index, in_wood = [(0, 1), (0, 1), (6, 1), (6, 1)], [(0, 1), (0, 1), (0, 1), (None, None)]
    for scene, marked in (("four-systems" + BY_INDEX, by_index), ("four-systems", in_wood)):
        for size in SIZES:
            screen = views_of(scene, "ascii")[size, "compare"]
            for c, (best, worst) in enumerate(marked):
                marks = "".join(figures[c][1] for _, figures in compared(screen))
                wanted = "".join("*" if i == best else "!" if i == worst else " " for i in range(8))
                expect_equal(marks, wanted, f"{scene}: marks of column {c} at {size[0]} columns")


def test_compare_wood():
    """View 5 through the wood: shares with too much energy, differences to the first with their error, as in the JSON."""
    script = "wait idle\nkey 5\n" + "".join(f"resize {w} {h}\ndump\n" for w, h in SIZES)
    with Place() as place:
        screens = place.play(script, "cuts.yaml")
        rocks = re.search(r"(\d+) rocks$", screens[0].now, re.M).group(1)
        run = results("-n", rocks, place.path / "cuts.yaml")[0]
    differences = {d["option"]: d["exceed_probability"] for d in run["differences"] if d["x_m"] == 80}
    for screen in screens:
        rows = dict(compared(screen))
        expect_equal(list(rows), [o["name"] for o in run["options"]], "options")
        for option, signs in zip(run["options"], compared_lights(screen), strict=True):
            name, control = option["name"], option["controls"][1]
            share, difference = rows[name][2][0], rows[name][3][0]
            expect_equal(share, f"{control['wooded']['exceed_probability'] * 1000:.0f}", f"{name}: too much")
            d = differences.get(name)
            wanted = "first" if d is None else f"{d['mean'] * 1000:+.0f}±{math.ceil(d['se'] * 1959.963984540054)}"
            expect_equal(difference, wanted, f"{name}: to first")
            wanted = "".join(SIGNS[{"pass": "passes", "fail": "FAILS"}[control["lights"][k]]]["braille"]
                             for k in ("contact", "free_run", "energy"))
            expect_equal(signs, wanted, f"{name}: lights")
        expect_equal([figures[2][1] for figures in rows.values()], ["*", " ", "!"], "marks of too much")
        expect(all(figures[3][1] == " " for figures in rows.values()), "marks of differences", rows)
        expect_in("By contact and by energy 'thick' is best", " ".join(screen.body.split()), screen)


def test_reorder_at_once():
    """Options moved, copied, deleted: no option's figures stand under another's name, what is known stays in sight."""
    before, moved, later, copied, gone = fast("""resize 120 40
        key 5
        wait idle
        dump
        key >
        dump
        wait idle
        dump
        key y
        dump
        wait idle
        key d
        dump""", "cuts.yaml")
    known = dict(compared(before))
    after = dict(compared(later))
    expect_equal(list(after), ["thin", "thick", "none left"], "options")
    for name, figures in compared(moved):
        for c in (0, 1, 2):
            expect(figures[c][0] in (known[name][c][0], "…"), f"'{name}' has figures of another option", moved)
        expect(figures[3][0] in (after[name][3][0], "…"), f"'{name}' has a difference of another option", moved)
    for screen, what in ((moved, "moved"), (copied, "copied"), (gone, "deleted")):
        found = {name: figures[2][0] for name, figures in compared(screen)}
        expect("thin" in found and "thick" in found, f"nothing is compared once one is {what}", screen)


def test_compare_arrive():
    """View 5 where it is not said what the place bears: those that arrive are compared, the energy lights are unknown"""
    with Place() as place:
        place.write("cuts.yaml", play.CUTS.replace(", accepted_kJ: 250", ""))
        screen = place.play("resize 120 40\nkey 5\nwait idle\ndump", "cuts.yaml")[0]
        rocks = re.search(r"(\d+) rocks$", screen.now, re.M).group(1)
        run = results("-n", rocks, place.path / "cuts.yaml")[0]
    expect(re.search("free run +arrive +to first", screen.body), screen)
    for (name, figures), option in zip(compared(screen), run["options"], strict=True):
        expect_equal(figures[2][0], f"{option['controls'][1]['wooded']['reach_probability'] * 1000:.0f}", f"{name}: arrive")
    expect(all(signs[2] == "?" for signs in compared_lights(screen)), screen)


def test_now_wood():
    """The column on the right has the figures of the JSON of as many rocks, for each option, at 80x24 and 200x50."""
    script = "wait idle\nkey 1\n" + "clear\nresize 80 24\ndump\nresize 200 50\ndump\nkey ]\n" * 3
    with Place() as place:
        screens = place.play(script, "cuts.yaml")
        rocks = re.search(r"(\d+) rocks$", screens[0].now, re.M).group(1)
        run = results("-n", rocks, place.path / "cuts.yaml")[0]
    for i, screen in enumerate(screens):
        option = run["options"][i // 2]
        control, ends = option["controls"][1], option["ends"]
        bare, wooded = control["bare"], control["wooded"]
        expect_in(f"Wood  {option['name']}", screen.now)
        for name, key in (("arrive", "reach"), (">250 kJ", "exceed")):
            expect_equal(screen.pair(name), tuple(round(a[f"{key}_probability"] * 1000) for a in (wooded, bare)), name)
        lo, hi = (wooded[f"exceed_{k}"] * 1000 for k in ("lo", "hi"))
        if screen.width == 200:
            expect_in(f"({math.floor(lo)}-{math.ceil(hi)})", screen.now, "the interval")
        for name, values in (("kJ mean", [a["energy_kJ"]["mean"] for a in (wooded, bare)]),
                             ("kJ 95 %", [a["energy_kJ"]["p95"] for a in (wooded, bare)]),
                             ("m  95 %", [a["height_m"]["p95"] for a in (wooded, bare)])):
            expect_equal(screen.pair(name), tuple(float(f"{v:.3g}") for v in values), name)
        for name, key in (("stopped by stems", "stopped_by_stems"), ("at rest", "came_to_rest")):
            expect_equal(screen.figure(f"\n{name}"), round(ends[key] * 1000), name)
        words = {"pass": "passes", "fail": "FAILS"}
        expect_equal(lights(screen, "braille"), {name: words[control["lights"][key]] for name, key in (
            ("Contact", "contact"), ("Free run", "free_run"), ("Energy", "energy"))}, "lights")
        expect_in(f"{wooded['exceed_probability'] * 100:.1f} %", screen.now, "share beside the energy light")
        half = 195.9963984540054 * wooded["energy_kJ"]["se"] / wooded["energy_kJ"]["mean"]
        expect_in(f"= ±{half:.2g} % {rocks} rocks", screen.now, "the mark")


def test_compare_one():
    """With one option no mark is set; a adds one from a preset and both are compared."""
    one, two = fast("""key 5
        wait idle
        dump
        key a
        key G
        key Enter
        wait idle
        clear
        dump""")
    expect(not re.search(r"\d[*!]", one.body), one)
    one.has("One way to treat this wood so far")
    expect_equal(len(compared(two)), 2, "options")
    expect(re.search(r"\d\*", two.body) and re.search(r"\d!", two.body), two)


def test_next_option():
    """] and [ go from option to option in every view, and the figures with them."""
    screens = fast("""key 2
        wait idle
        dump
        key ]
        dump
        clear
        key ]
        dump
        key ]
        clear
        dump
        key [
        dump""", "options.yaml")
    screens[0].has("Wood thick")
    screens[1].has("Wood thin", "option 2 of 3: thin")
    screens[2].has("Wood none left")
    expect_equal(screens[3].text, screens[0].text, "around")
    screens[4].has("option 3 of 3")
    thick, thin, none = fast("wait idle\n" + "clear\ndump\nkey ]\n" * 3, "cuts.yaml")
    for name in FIGURE_NAMES[1:]:
        wood = [s.pair(name)[0] for s in (thick, thin, none)]
        expect(wood[0] < wood[1] < wood[2] == none.pair(name)[1], f"'{name}' of the options", wood)


def test_rocks_step():
    """. and , step through the rocks' ways, in the picture the arrows too."""
    for scene in ("fast.yaml", "wood.yaml"):
        screens = fast("""wait idle
            key .
            dump
            key .
            dump
            key ,
            dump
            key Tab
            key Right
            dump
            key Left
            dump""", scene)
        for screen, rock in zip(screens, (1, 2, 1, 2, 1)):
            expect(re.match(rf"rock {rock}: .* [\d.]+ m after \d+ contacts", screen.note), screen.note)
            found = re.search(r", (\d+) stems hit$", screen.note)
            expect(bool(found) == (scene == "wood.yaml") and (not found or int(found.group(1)) > 10), screen.note)
        expect_equal(screens[2].note, screens[0].note, "rock 1 again")


def stepped(text, steps, size="100 40", before="key ."):
    """View 1 with the picture in front, one rock's way piece by piece; then view 2."""
    with Place() as place:
        place.write("wood.yaml", text)
        script = f"resize {size}\nwait idle\nkey 1\n{before}\ndump\nkey Tab\n" + "key Down\ndump\n" * steps
        return place.play(script, "wood.yaml")


HIT = re.compile(r"; hits a (shoot|tree) of ([\d.]+) cm: ([\d.]+) of ([\d.]+) kJ")


def test_step_stems():
    """A rock stepped along its way tells each stem it hits, what that takes of what it has, and where it is stopped."""
    whole, *pieces = stepped(WOOD, 60)
    total = int(re.search(r"(\d+) stems hit", whole.note).group(1))
    count = int(re.match(r"rock 1, piece 1 of (\d+):", pieces[0].note).group(1))
    hits, at = [], None
    for i, screen in enumerate(pieces, 1):
        found = re.match(rf"rock 1, piece {i} of {count}: (flies|rolls) from ([\d.]+) to ([\d.]+) m, ", screen.note)
        expect(found, f"piece {i}:", screen.note)
        expect(at is None or float(found.group(2)) == at, f"piece {i} does not begin where the one before ended", screen.note)
        at = float(found.group(3))
        hit = HIT.search(screen.note)
        if hit:
            hits.append((hit.group(1), float(hit.group(2)), float(hit.group(3)), float(hit.group(4)), at))
    expect(5 < len(hits) <= total, f"{len(hits)} of {total} stems in {len(pieces)} of {count} pieces")
    taken = {("shoot", 6): 1, ("shoot", 12): 5, ("tree", 20): 20, ("tree", 35): 70, ("shoot", 5): 0.5}
    for kind, dbh, takes, has, x in hits:
        expect((kind, dbh) in taken, f"a {kind} of {dbh} cm stands in no belt", hits)
        expect_near(takes, taken[kind, dbh], 0.051 * taken[kind, dbh], f"kJ taken by a {kind} of {dbh} cm")
        expect(has >= takes and 4 <= x <= 81, f"a {kind} of {dbh} cm", hits)
    thick = WOOD.replace("volume_m3: 0.01}", "volume_m3: 9}")
    whole, *pieces = stepped(thick, 40)
    expect(re.match(r"rock 1: is stopped by stems at [\d.]+ m after \d+ contacts, 1 stems? hit", whole.note), whole.note)
    last = [p.note for p in pieces if HIT.search(p.note)]
    expect(last, "the stem that stops the rock", [p.note for p in pieces])
    _, _, takes, has = HIT.search(last[0]).groups()
    expect_equal(takes.rstrip("0").rstrip("."), f"{float(has):.2g}", "it takes all that the rock has")


def test_step_poisson():
    """By a Poisson process a contact has no stem: it tells what it takes; by the index no stem is told."""
    for model, stems in (("poisson", True), ("index", False)):
        whole, *pieces = stepped(WOOD.replace("simulation: {", f"simulation: {{contact_model: {model}, "), 40)
        told = [p.note for p in pieces if re.search(r"; a contact takes [\d.]+ of [\d.]+ kJ", p.note)]
        expect_equal(bool(told), stems, model)
        expect_equal("stems hit" in whole.note, stems, whole.note)
        expect(not any(HIT.search(p.note) for p in pieces), f"a stem of {model}")


def test_step_plan():
    """View 2 shows the stems of the rock's way, up to where it has been stepped; without them a pattern of many."""
    for size in ("100 40", "200 50", "80 50"):
        screens = fast(f"""resize {size}
            wait idle
            key 2
            dump
            key .
            dump
            key 1 Tab
            key Down Down Down
            key 2
            dump
            key 1 Tab
            key {"Down " * 20}
            key 2
            dump
            find forest[1]
            clear
            dump
            key .
            dump""", "wood.yaml")
        _, way, start, more, ahead, lower = screens
        counts = []
        for screen in (way, more, lower):
            found = re.search(r"The way of this rock: (\d+) stems? hit in ([\d.]+) m", screen.body)
            expect(found and "One pattern" not in screen.body, "the rock's way is missing in the", screen)
            counts.append((int(found.group(1)), float(found.group(2))))
        for screen, what in ((start, "before the first stem"), (ahead, "a belt it has not come to")):
            expect("One pattern of many" in screen.body and "The way of" not in screen.body, what, screen)
        expect(counts[0][0] > counts[1][0] > 0 and counts[2][0] > 0, f"stems hit in m: {counts}")
        expect(counts[0][1] == counts[2][1] == 20, f"stems hit in m: {counts}")
        for screen in screens:
            screen.whole()
    expect_in("One pattern of many", fast("resize 100 40\nwait idle\nkey .\nkey 2\ndump", "fast.yaml")[0].body, "by the index")


def test_plan_live():
    """View 2: the plan follows a change of the stand and of the option; no stem of the wood before it is shown."""
    with Place() as place:
        edits = "find trees[0]\nset 700\nfind trees[1]\nset 1\nfind shoots[0].per_ha\nset 4000\nwait idle\nclear\ndump"
        before, after = place.play(f"resize 100 40\nwait idle\nkey 1\ndump\nkey 2\nclear\ndump\n{edits}", "wood.yaml")[1:]
        text = (place.path / "wood.yaml").read_text()
        edited = text.replace("per_ha: 80,", "per_ha: 700,").replace("per_ha: 20,", "per_ha: 1,").replace("9000,", "4000,")
        (place.path / "edited.yaml").write_text(edited)
        fresh = place.play("resize 100 40\nwait idle\nkey 1\nkey 2\nclear\ndump", "edited.yaml")[0]
        plans = [re.search(r"\n\n(?=[⠀-⣿]).*The way of this rock[^\n]*", screen.body, re.S) for screen in (before, after, fresh)]
        expect(all(plans), "the rock's way is missing in", before, after, fresh)
        expect_equal(plans[1].group(0), plans[2].group(0), "the plan after an edit, and of a scene that was so from the start")
        expect(plans[0].group(0) != plans[1].group(0), "the plan is not changed by the edit")
    thick, thin = fast("resize 100 40\nwait idle\nkey 1\ndump\nkey 2\nclear\ndump\nkey ]\nclear\ndump", "cuts.yaml")[1:]
    expect_in("The way of this rock", thick.body)
    words = re.search("The way of this rock.*", thick.body).group(0)
    expect(words not in thin.body, "the stems of another option:", thin)


# ---- presets, new, open ----

MARCHE = {"simple-coppice": "87 050 ha, 43.4 %", "coppice-with-standards": "13 250 ha, 6.6 %",
          "selection-coppice": "350 ha, 0.2 %", "large-reserves": "30 275 ha, 15.1 %", "high-forest-small-rocks": "28 550 ha, 14.2 %"}


def test_presets():
    """Presets show how common each is in Marche, and before it is chosen what it would give."""
    for size in ("120 40", "80 24"):
        lines = [x for screen in fast(f"resize {size}\nkey 2\nkey p\ndump\n" + "key Down\ndump\n" * 45)
                 for x in screen.text.split("\n")]
        for name, share in MARCHE.items():
            expect(any(re.search(rf"[│|] {name} .*{re.escape(share)}", x) for x in lines), f"{name} at {size}", share)
    first, second, chosen, undone = fast("""key 2
        wait idle
        key p
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
        screen.has("Stand of this belt")
        for part in ("stools,", "stems,", "trees per ha; basal area", "with this rock: ADC", "free run", "100 m"):
            expect_in(part, screen.popup, "preview")
    expect(first.popup.split("ads-1")[0] != second.popup.split("ads-1")[0], "the preview stays as it was")
    expect_equal(chosen.row("^system")[-1], "simple-coppice", "system")
    chosen.has("simple coppice")
    undone.has("Stand of belt 1: upper")


def test_new_typed():
    """n: a new scene typed in one form, computed at once, saved where one says, and it is valid."""
    with Place() as place:
        screens = place.play("""key n
            dump
            type Above the mill
            key Enter
            type 0 100, 40 60; 90 20, 120 18
            key Enter Enter
            type 0.9
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
        screens[0].has("New scene", "profile (CSV file or points)", "ground", "rock: diameter, m",
                       "counted at x, m", "that bears, kJ", "stand on the whole way", "Esc never mind")
        screens[1].has("Above the mill", "0 100, 40 60; 90 20, 120 18", "0.9", "95", "30", "simple-coppice")
        screens[2].has("* Above the mill", "At 95 m", ">30 kJ", "Wood simple coppice")
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
            key Enter Enter Enter
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
    """n: what cannot be a scene is explained in the form, and nothing is lost."""
    for fields, part in ((("x", "0 10"), "points x z"), (("x", "ten by ten"), "points x z"), (("x", "0 1, 0 2, 0 3"), ""),
                         (("x", "none.csv"), "none.csv"), (("x", "0 60, 100 12", "moon"), "moon"),
                         (("x", "0 60, 100 12", "talus", "-1"), "-1"), (("x", "0 60, 100 12", "talus", "0,6"), "0,6"),
                         (("x", "0 60, 100 12", "talus", "0.6", "500"), "500"),
                         (("x", "0 60, 100 12", "talus", "0.6", "90", "much"), "much")):
        script = "wait idle\nkey n\n"
        for field in fields:
            script += f"key Ctrl-U\ntype {field}\nkey Enter\n"
        script += "key Enter\n" * (7 - len(fields)) + "dump\nkey Esc\nclear\ndump"
        refused, after = fast(script)
        refused.has("New scene", fields[-1])
        message = refused.text.split("stand on the whole way")[1]
        expect("Enter: next" not in message and part in message, f"{fields} is not refused with a reason:", refused)
        after.has("1 5 45 upper")
        expect(after.title.endswith(" fast"), after.title)


def test_new_bad_stand():
    """n: a stand that there is not is told, not left out in silence."""
    screen = fast("key n Enter Enter Enter Enter Enter Enter Ctrl-U\ntype no-such-stand\nkey Enter\ndump")[0]
    expect_in("no-such-stand", screen.text)


def test_open():
    """o: a shipped scene from the list, a file by its name, one that there is not."""
    screens = fast("""wait idle
        key o
        dump
        key Down Enter
        dump
        key o Enter
        type options.yaml
        key Enter
        dump
        key o Enter
        type missing.yaml
        key Enter
        dump
        key Esc
        dump""")
    screens[0].has("a file …", "four-systems", "paper-site")
    screens[1].has("Four systems, befo", "Rock 0.68 m 512.3 kg")
    screens[2].has("Wood thick")
    screens[3].has("No such file", "missing.yaml")
    screens[4].has("Wood thick")


def test_open_unsaved():
    """o and n say first that there is unsaved work, and open nothing."""
    screens = fast("""key 3
        find title
        set other
        key o
        dump
        key n
        dump""")
    for screen in screens:
        expect_in("unsaved work", screen.note)
        screen.has("* other")


# ---- saving ----

def test_save():
    """s writes the values that changed and leaves every comment and every other line."""
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
        wanted = FAST.replace("per_ha: 3000", "per_ha: 2222").replace("diameter_m: 0.5", "diameter_m: 0.75")
        expect_equal(place.text("fast.yaml"), wanted, "the file")
        expect_equal(sorted(n for n in place.names() if n.startswith("fast")), ["fast.yaml"], "files")


def test_save_list():
    """s after an item came or went: valid, the comments kept where they can be, otherwise in a .bak."""
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
    """A scene of the program is never written over: s asks for a name."""
    shipped = PROFILES / "scenes/paper-site.yaml"
    before, stamp = shipped.read_bytes(), shipped.stat().st_mtime_ns
    with Place() as place:
        asked, saved, later = place.play("""key 2
            find stools.per_ha
            set 2000
            key s
            dump
            key Enter
            dump
            find stools.per_ha
            set 1500
            key s
            dump""", "paper-site")
        asked.has("Save as", "never written over", "paper-site.yaml")
        expect_in("saved paper-site.yaml", saved.note)
        expect_in("saved paper-site.yaml", later.note)
        check_good(place.path, "paper-site.yaml")
        expect_in("# Test site in central Italy", place.text("paper-site.yaml"), "its comments")
        again = place.play("key 2\ndump", "paper-site.yaml")[0]
        expect_equal(again.row("^stools per ha")[-1], "1500", "stools")
        # straight onto the shipped file by its path
        asked = place.play(f"key 2\nfind stools.per_ha\nset 9\nkey s\nkey Ctrl-U\ntype {shipped}\nkey Enter\ndump\n"
                           "key Enter\ndump", "paper-site")
        expect(shipped.read_bytes() == before and shipped.stat().st_mtime_ns == stamp, "the shipped file was written!")
    expect(shipped.read_bytes() == before and shipped.stat().st_mtime_ns == stamp, "the shipped file was written!")


def test_save_as_exists():
    """Save as over another file asks once more; an empty name and a folder that is not there are refused."""
    with Place() as place:
        place.write("there.yaml", "mine\n")
        screens = place.play("""key 2
            find stools.per_ha
            set 2000
            key s Ctrl-U Enter
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
        screens[2].has("Enter once more replaces it")
        expect("* Test site" in screens[3].title, screens[3].title)
        expect_equal(place.text("there.yaml"), "mine\n", "the other file")
        place.play("key 2\nfind stools.per_ha\nset 2000\nkey s Ctrl-U\ntype there.yaml\nkey Enter Enter", "paper-site")
        check_good(place.path, "there.yaml")


def test_changed_on_disk():
    """s on a file that has changed on disk asks: never mind, another name, or over it."""
    for keys, mine in (("key Enter", False), ("key Esc", False), ("key End Enter", True),
                       ("key Down Enter Ctrl-U\ntype mine.yaml\nkey Enter", False)):
        with Place() as place:
            # The script itself writes other bytes into the file that is open.
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
    """A file that cannot be written: the reason is said, the work stays unsaved, the file as it was."""
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
    """q ends at once where nothing is unsaved, otherwise it asks: stay, save, lose."""
    with Place() as place:
        run_script(place.path, "key q\ndump late.txt\n", "fast.yaml")
        expect("late.txt" not in place.names(), "still there after q")
        edit = "key 2\nkey /\ntype stools.per_ha\nkey Enter Enter\ntype 1234\nkey Enter\n"
        asked = place.play(edit + "key q\ndump\nkey Enter\ndump\nkey q Esc\ndump\nkey F10\ndump")
        asked[0].has("There is unsaved work", "stay", "save and quit", "quit and lose it")
        asked[1].has("* fast").lacks("There is unsaved work")
        asked[2].has("* fast").lacks("There is unsaved work")
        asked[3].has("There is unsaved work")
        expect_equal(place.text("fast.yaml"), FAST, "the file after staying")
        run_script(place.path, edit + "key q End Enter\ndump late.txt\n", "fast.yaml")
        expect("late.txt" not in place.names(), "still there after 'quit and lose it'")
        expect_equal(place.text("fast.yaml"), FAST, "the file after losing")
        run_script(place.path, edit + "key q Down Enter\ndump late.txt\n", "fast.yaml")
        expect("late.txt" not in place.names(), "still there after 'save and quit'")
        expect_in("per_ha: 1234", place.text("fast.yaml"), "the file after saving")
        shipped = place.play(edit + "key q Down Enter\ndump", "paper-site")[0]
        shipped.has("Save as")


def test_save_as_then_quit():
    """'save and quit' on a shipped scene quits once the name is given."""
    with Place() as place:
        edit = "key 2\nkey /\ntype stools.per_ha\nkey Enter Enter\ntype 1234\nkey Enter\n"
        run_script(place.path, edit + "key q Down Enter Enter\ndump late.txt\n", "paper-site")
        check_good(place.path, "paper-site.yaml")
        expect("late.txt" not in place.names(), "still there after it was saved")


# ---- export ----

def test_export():
    """w: page, screen, CSV and JSON in files; over an existing one it asks."""
    with Place() as place:
        screens = place.play("""wait idle
            dump
            key w
            dump
            key Enter
            dump
            key Enter
            dump
            key w Down Enter Enter
            key w Down Down Enter Ctrl-U
            type table.csv
            key Enter
            key w Down Down Down Enter Enter
            clear
            key w Enter Enter
            dump
            key Esc
            key w Enter Ctrl-U
            type no/such/file.txt
            key Enter
            dump""", "options.yaml")
        screens[1].has("the page, as text", "this screen, with its picture", "CSV", "JSON", "the batch command")
        screens[2].has("Export to a file", "ceduo.txt")
        expect_in("written: ceduo.txt", screens[3].note)
        screens[4].has("Enter once more replaces it")
        screens[5].has("No such file or directory")
        page = place.text("ceduo.txt")
        for part in ("fast", "thick", "thin", "none left", "At 80 m"):
            expect_in(part, page, "the page")
        expect_equal(place.text("ceduo-screen.txt"), screens[0].text, "the screen as a file")
        rows = place.text("table.csv").splitlines()
        expect(rows[0].startswith("scene,title,") and len(rows) == 1 + 3 * 2, rows)
        line = json.loads(place.text("ceduo.json"))
        expect_equal([o["name"] for o in line["options"]], ["thick", "thin", "none left"], "options in JSON")
        expect_equal(line["format"], "ceduo-result-1", "format")


def test_export_command():
    """w: the batch command that is shown gives the same figures."""
    with Place() as place:
        screen, command = place.play("wait idle\ndump\nkey w End Enter\ndump", "paper-site")
        found = re.search(r"ceduo --batch -n (\d+) ", command.popup)
        expect(found, "no command in the", command)
        batch = results("-n", found.group(1), "paper-site")[0]
        control = batch["options"][0]["controls"][0]
        arrivals = control["wooded"], control["bare"]
        expect_equal(screen.pair("arrive"), tuple(round(a["reach_probability"] * 1000) for a in arrivals), "arrive")
        expect_equal(screen.pair("kJ mean"), tuple(float(f"{a['energy_kJ']['mean']:.3g}") for a in arrivals), "energy")
        expect_near(control["index"]["residual_kJ"], index_of(screen)[1], 0.06, "left")


def test_export_rocks():
    """w: the command follows the figures on the screen: none yet, then as many rocks as they have."""
    none, last, screen = fast("key w End Enter\ndump\nwait idle\ndump\nkey Esc\ndump", "wood.yaml")
    none.has("ceduo --batch -n 1000 ", "no figures yet", "what the scene says")
    rocks = int(screen.figure("= .* %"))
    last.has(f"ceduo --batch -n {rocks} ", f"The figures on the screen are of {rocks} rocks").lacks("no figures yet")


def test_export_unsaved():
    """w: with unsaved work the command says that the file must be saved first."""
    screen = fast("key 2\nfind stools.per_ha\nset 9\nwait idle\nkey w End Enter\ndump")[0]
    screen.has("ceduo --batch", "unsaved work")


# ---- search, help, counts ----

def test_search():
    """/ goes to a field by label, value or path, N to the next, and says where nothing is found."""
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
    expect(screens[1].note.startswith("density_kg_m3 "), screens[1].note)
    notes = [s.note.split()[0] for s in screens[2:5]]
    expect(notes[0] != notes[1] and {"vx_m_s", "vz_m_s"} <= set(notes), notes)
    expect_in("'zzz' is not found in this view", screens[5].note)
    expect_equal(screens[6].note.split()[0], notes[2], "the field after Esc")


def test_help():
    """? has every key of the program with what it does, F1 too; the bar has those for always."""
    rows = actions()
    for key in ("?", "F1"):
        tall, closed = fast(f"resize 120 80\nwait idle\nkey {key}\ndump\nkey Esc\ndump")
        for name, word, word2, bar, text in rows:
            pattern = re.escape(word) + (r" +" + re.escape(word2) if word2 else "") + r" +" + re.escape(text)
            expect(re.search(r"[│|] " + pattern, tall.text), f"{name}: {word} {word2} {text} is missing in the", tall)
        closed.lacks("Every edit is live")
    wide = fast("resize 200 50\ndump")[0]
    for name, word, word2, bar, text in rows:
        if bar:
            expect_in(f"{word} {text}", wide.bar, f"{name} in the bar at 200 columns")
    for view in "123456":
        bar = fast(f"key {view}\ndump")[0].bar
        for name, word, word2, shown, text in rows:
            if shown == 2:
                expect_in(f"{word} {text}", bar, f"{name} in the bar of view {view} at 80 columns")


def test_help_field():
    """? begins with all that is known of the field under the cursor, where the line above the keys has no room for it."""
    line, helped = fast("key 2\nfind stools.per_ha\ndump\nkey ?\ndump", "paper-site")
    expect(line.note.endswith("…"), line.note)
    wide = fast("resize 300 24\nkey 2\nfind stools.per_ha\ndump", "paper-site")[0]
    expect_in("Table 1", wide.note, "the source")
    expect(helped.popup.startswith(re.sub(" +", " ", wide.note) + " Every edit is live"), wide.note, helped)
    expect(fast("key 4\nkey ?\ndump")[0].popup.startswith("Every edit is live"), "without a field")


def test_help_scrolls():
    """The help can be read to its end at 80x24."""
    pages = fast("key ?\ndump\n" + "key PgDn\ndump\n" * 5 + "key g\ndump\nkey q\ndump")
    text = "\n".join(p.text for p in pages[:6])
    for name, word, word2, bar, what in actions():
        expect_in(what, text, name)
    expect_in("terminal itself selects text", re.sub(r"\s+[│|]\n.?[│|]\s+", " ", text))
    expect_equal(pages[6].text, pages[0].text, "after g")
    pages[7].lacks("─Keys")


def test_contract_keys():
    """Every key that was promised is in the table."""
    words = {w for _, word, word2, _, _ in actions() for w in (word, word2)}
    for key in ["Up", "Down", "Left", "Right", *"hjkl", "Tab", "Shift-Tab", *"123456", "Enter", "+", "-", *"adyu", "Ctrl-R",
                *"nospw", "/", "?", "F1", "q", "F10"]:
        expect(key in words, f"{key} is no key of the program")


def counts_script(*fields):
    """Fills the form of the counts for the second belt, and takes three screens: filled, done, left by Esc."""
    script = "key 2\nwait idle\nfind forest[1]\ndump\nkey c\n"
    for field in fields:
        script += f"key Ctrl-U\ntype {field}\nkey Tab\n"
    return script + "dump\nkey Enter\ndump\nkey Esc\nclear\ndump"


def test_counts():
    """c: counts of a plot to hectares: 400 m2 along a slope of 40 degrees are 306.4 m2."""
    area = 400 * math.cos(math.radians(40))
    for how, per in (("slope", 10000 / area), ("horizontal", 25)):
        before, form, screen, _ = fast(counts_script("400", how, "40", "100", "250", "20"))
        form.has("Stand from the counts of a sample plot", "size of the plot, m2", "slope or horizontal", "angle")
        rows = [re.findall(r"^\d +(\S+)", part, re.M) for part in screen.body.split("\n    per_ha")[1:]]
        found = [float(screen.row("^stools per ha")[-1]), float(rows[0][0]), float(rows[1][0])]
        for value, count in zip(found, (100, 250, 20)):
            expect_near(value, count * per, count * per * 1e-5, f"{how}: {count} in the plot, per ha")
        expect_in("306.4 m2" if how == "slope" else "400 m2", screen.note)
        expect_in("32.64" if how == "slope" else "25", screen.note)
        expect(screen.now != before.now, "the figures stay as they were")
    expect_near(10000 / area, 10000 / 306.4, 0.005, "this test's own arithmetic")


def test_counts_refused():
    """c: what cannot be is refused with a reason, nothing changes."""
    good = ["400", "slope", "40", "7", "7", "7"]
    for at, value, part in ((0, "0", "above 0"), (0, "-4", "-4"), (1, "steep", "slope or horizontal"),
                            (2, "90", "below 90"), (2, "x", "'x' is no number"), (3, "3,5", "'3,5' is no number"),
                            (4, "nan", "'nan' is no number"), (0, "1e-320", ""), (3, "1e300", "")):
        before, _, refused, after = fast(counts_script(*good[:at], value, *good[at + 1:]))
        refused.has("Stand from the counts", part)
        expect_equal(after.text, before.text, f"after {value!r} and Esc")


def test_keys_at_once():
    """Keys that come all at once do the same as one by one with the screen drawn in between."""
    slow = fast("".join(f"key {k}\ndump\n" for k in ("2", "Down", "p", "End", "Enter")) + "wait idle\nclear\ndump")[-1]
    quick = fast("key 2 Down p End Enter\nwait idle\nclear\ndump")[0]
    expect_equal(quick.text, slow.text, "view 2, the second belt's stand from a preset")
    keys = ["5", "Down", "y", ">", "2", "Down", "Down", "Down", "+", "1", "G", "4", "j", "5", "Up", "d"]
    for scene in ("options.yaml", "cuts.yaml"):
        slow = fast("wait idle\n" + "".join(f"key {k}\ndump\n" for k in keys) + "wait idle\nclear\ndump", scene)[-1]
        quick = fast(f"wait idle\nkey {' '.join(keys)}\nwait idle\nclear\ndump", scene)[0]
        expect_equal(quick.text, slow.text, "options and fields")


def test_drawn_or_not():
    """Whether a view has been drawn before changes nothing on the screens after it."""
    drawn = fast("resize 100 40\nwait idle\nkey 1\ndump\nkey 2\ndump", "wood.yaml")[-1]
    never = fast("resize 100 40\nwait idle\nkey 1\nkey 2\ndump", "wood.yaml")[-1]
    expect_equal(never.text, drawn.text, "view 2 where view 1 was not drawn before")


def test_new_is_data():
    """n: what is typed into a field is that field's value, never more of the file."""
    for field, text in ((3, "0.5, density_kg_m3: 7000"), (3, "0.5}\\nx: {"), (4, "90, accepted_kJ: 1"), (5, "50}, {x_m: 95"),
                        (2, "talus}, {from_m: 0"), (6, "bare}, {from_m: 91, to_m: 95, stand: bare")):
        script = "wait idle\nkey n\n" + "key Enter\n" * field + f"key Ctrl-U\ntype {text}\n" + "key Enter\n" * (7 - field)
        refused = fast(script + "dump")[0]
        expect("New scene" in refused.text or refused.title.endswith(" fast"), f"{text!r} was taken as YAML:", refused)


def test_popup_bar():
    """The bar has the keys of what lies over the view, and those of the view again once it is closed."""
    for keys, words in (("p", ("Up Down move", "Enter choose", "Esc never mind")), ("q", ("Enter choose", "Esc never mind")),
                        ("?", ("Up Down", "any other key closes")), ("n", ("Enter next", "Esc never mind")),
                        ("w End Enter", ("any other key closes",))):
        for width in (60, 80, 200):
            edit = "find stools.per_ha\nkey +\n" if keys == "q" else ""
            over, closed = fast(f"resize {width} 24\nkey 2\n{edit}key {keys}\ndump\nkey Esc\ndump")
            for word in words:
                expect_in(word, over.bar, f"{keys} at {width} columns")
            expect("edit" not in over.bar and "undo" not in over.bar, over.bar)
            expect_in("Enter edit", closed.bar, "closed")


def test_more_in_popups():
    """Help and lists that are longer than their window say on its edge that there is more, below and above."""
    for keys in ("?", "p"):
        first, middle, last = fast(f"key 2\nkey {keys}\ndump\nkey PgDn PgDn\ndump\nkey End\ndump")
        first.has("more below").lacks("more above")
        middle.has("more below", "more above")
        last.has("more above").lacks("more below")
        fast(f"resize 120 100\nkey 2\nkey {keys}\ndump")[0].lacks("more below", "more above")
    fast("find stand\nkey 3\nfind shape\nkey Enter\ndump")[0].has("sphere").lacks("more below", "more above")


def test_popups_small():
    """Popups over the smallest screen stay within it."""
    for keys in ("?", "p", "n", "o", "w", "c", "/", "s"):
        fast(f"key 2\nresize 60 20\nkey {keys}\ndump", "paper-site")[0].whole()


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
    suite.run(tests_of(sys.modules[__name__]))
    suite.end()


if __name__ == "__main__":
    main()
