#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The options side by side in the terminal program, and the column of figures in every view."""
import math
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import play  # noqa: E402
from play import CUTS, FAST, OPTIONS, Place, check_good, fast  # noqa: E402
from harness import FULL, expect, expect_equal, expect_in, results, run_all  # noqa: E402
from test_editing import FIGURE_NAMES  # noqa: E402
from test_screens import BY_INDEX, SIGNS, SIZES, compared, compared_lights, lights, scene_for  # noqa: E402


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
    expect_in("deleted: Più rado; u undoes", screens[5].note)
    expect_equal(names[6], names[4], "after u")
    expect_equal(len(names[7]), 1, "after many d")
    expect_in("the only option cannot be deleted", screens[7].note)


def test_names_of_copies():
    """y on a copy increases its number, for any other name."""
    found = option_names(fast("resize 120 40\nkey 5\nwait idle\n" + "key y\n" * 3 + "wait idle\ndump", "options.yaml")[0])
    expect_equal(found[:4], ["thick", "thick (2)", "thick (3)", "thick (4)"], "copies of copies")
    with Place() as place:
        place.write("named.yaml", OPTIONS.replace("name: thick", "name: cut (2031)").replace("name: none left", "name: a (x)"))
        found = option_names(place.play("resize 120 40\nkey 5\nwait idle\nkey y G y\nwait idle\ndump", "named.yaml")[0])
    expect_equal(found, ["cut (2031)", "cut (2031) (2)", "thin", "a (x)", "a (x) (2)"], "numbers that are none of copies")


ODD = "\"l'alto\", #1: [vecchio]"


def test_odd_names():
    """A stand whose file and name have quotes, commas and brackets becomes an option, is copied, renamed, saved and read again."""
    with Place() as place:
        place.write(f"{ODD}.yaml", f"ceduo: stand/1\nname: '{ODD.replace(chr(39), 2 * chr(39))}'\nspecies: ostrya-carpinifolia\n"
                                   "stools: {per_ha: 2000, spacing_m: 0.4}\nshoots: [{per_ha: 6000, dbh_m: 0.06, height_m: 6}]\n")
        made, saved = place.play("resize 140 40\nkey 5\nwait idle\nkey a\ntype alto\nkey Enter\nwait idle\ndump\nkey y Enter Ctrl-U\n"
                                 f"type {ODD} 2\nkey Enter s\ndump")
        made.has(f"added '{ODD}.yaml'; Enter renames it")
        expect(saved.note.startswith("saved fast.yaml"), saved)
        check_good(place.path, "fast.yaml")
        (read,) = place.play("resize 140 40\nkey 5 G 2\ndump")
        read.has(f"Stand of belt 1: {ODD}", f"{ODD} 2")
        (replaced,) = place.play("resize 140 40\nkey 2 p\ntype alto\nkey Enter\nwait idle\ndump")
        replaced.has(f"Stand of belt 1: {ODD}")


def test_contact_reason():
    """The light of contact names the failing test: a gap, or the ADC."""
    # Below the track the ground falls by 0.3 m per metre; rocks follow it with a friction of 0.2.
    text = FAST.replace("[[0, 80], [60, 30], [100, 0]]", "[[0, 80], [60, 30], [160, 0]]").replace("x_m: 80", "x_m: 150") \
        .replace("friction: 0.7", "friction: 0.2")
    with Place() as place:
        for to_m, from_m, width, words in ((45, 82.5, 80, r"gap m +37\.5 +< 30 ✘"), (45, 82.5, 120, r"gap m +37\.5 +< 30 ✘"),
                                           (82, 90, 80, r"gap m +32 +< 30 ✘")):
            end = 150 if from_m > 80.5 and to_m == 45 else 118
            place.write("gap.yaml", text.replace("to_m: 45", f"to_m: {to_m}").replace("from_m: 50", f"from_m: {from_m}")
                        .replace("to_m: 80", f"to_m: {end}").replace("{per_ha: 1000, spacing_m: 0.3}",
                                                                    "{per_ha: 3000, spacing_m: 0.3}")
                        .replace("per_ha: 2500, dbh_m: 0.05", "per_ha: 9000, dbh_m: 0.06"))
            screen = place.play(f"resize {width} 30\nwait idle\ndump", "gap.yaml")[0]
            expect(re.search(rf"^{words}$", screen.now, re.M), words, screen)
    screen = fast("key 5 Down\nwait idle\ndump", "options.yaml")[0]
    expect(re.search(r"^ADC m +143 +< 30 ✘$", screen.now, re.M), "the ADC", screen)
    screen = fast("key 5 Down Down\nwait idle\ndump", "options.yaml")[0]
    expect(re.search(r"^ADC m +none +< 30 ✘$", screen.now, re.M), screen)


def test_index_zero():
    """If stems take no energy the index prints 0, not -0."""
    screen = fast("key 5 Down Down\nwait idle\ndump", "options.yaml")[0]
    expect(re.search(r"^taken kJ +0$", screen.now, re.M), screen)


def test_rename_refused():
    """Two options cannot have one name; the refusal keeps the question open."""
    screen = fast("key 5\nkey Enter Ctrl-U\ntype thin\nkey Enter\ndump", "options.yaml")[0]
    screen.has("Name of this option")
    expect(re.search("thin", screen.text) and "thick" in screen.text, screen)


def test_compare_marks():
    """The clearly best option over the years is named, and the worst: in words, only if it is clear."""
    screen = fast("resize 120 40\nkey 5\nwait idle\ndump", "cuts.yaml", charset="ascii")[0]
    rows = dict(compared(screen))
    expect_equal({name: cells["best"] for name, cells in rows.items()}, {"thick": "best", "thin": "", "none left": "worst"})
    script = "".join(f"resize {width} {height}\nkey 5\nwait idle\ndump\n" for width, height in SIZES[1:])
    with Place() as place:
        screens = place.play(script, scene_for(place, "four-systems"), charset="ascii", rocks=None) if FULL else ()  # takes long
    for screen in screens:  # over the same years a freshly cut one grows, a grown one is cut
        rows = dict(compared(screen))
        means = {name: tuple(map(float, cells["mean"].split("+-"))) for name, cells in rows.items()}
        best = min(means, key=means.get)
        expect(best == "large reserves, just cut" and all(sum(means[best]) < mean - error for name, (mean, error) in means.items() if name != best), means)
        expect_equal([name for name, cells in rows.items() if cells["best"]], [best], "of the two worst neither is clearly the worst")
    rows = compared(fast("resize 120 40\nkey 5\nwait idle\ndump", "options.yaml")[0])
    expect_equal([cells["best"] for _, cells in rows], [""] * 3, "by the index no option is best")


def test_worst_overlaps():
    """If the shares over the years of two options overlap, neither is called the worst."""
    hardly = """  - name: hardly any
    forest:
      - {from_m: 5, to_m: 80, stand: {name: one, species: ostrya-carpinifolia, energy: {model: brauner, u_J_m3: 100000},
         trees: [{per_ha: 2, dbh_m: 0.2, height_m: 12, volume_m3: 0.2}]}}
"""
    with Place() as place:
        place.write("cuts.yaml", CUTS.replace("  - name: none left", hardly + "  - name: none left"))
        screen = place.play("resize 120 40\nkey 5\nwait idle\ndump", "cuts.yaml", charset="ascii")[0]
    rows = dict(compared(screen))
    expect_equal({name: cells["best"] for name, cells in rows.items()},
                 {"thick": "best", "thin": "", "hardly any": "", "none left": ""})
    shares = [float(cells["mean"].split("+")[0].split("±")[0]) for name, cells in rows.items() if name in ("hardly any", "none left")]
    expect(shares[0] < shares[1], "they do not differ", shares)


def test_compare_wood():
    """View 5: shares with too much energy today and in each year, with their errors, as in the JSON"""
    script = "wait idle\nkey 5\nwait idle\n" + "".join(f"resize {w} {h}\ndump\n" for w, h in SIZES)
    with Place() as place:
        screens = place.play(script, "cuts.yaml")
        rocks = re.search(r"(\d+) rocks", screens[0].now, re.M).group(1)
        run = results("-n", rocks, place.path / "cuts.yaml")[0]
        years = results("--years", "-n", play.ROCKS, place.path / "cuts.yaml")[0]
    for screen in screens:
        rows = dict(compared(screen))
        expect_equal(list(rows), [o["name"] for o in run["options"]], "options")
        for option, year, cells in zip(run["options"], years["options"], rows.values(), strict=True):
            control, rotation = option["controls"][1]["wooded"], year["rotation"]
            p, n = control["exceed_probability"], int(rocks)
            half = math.ceil(1959.963984540054 * math.sqrt(p * (1 - p) / n)) or math.ceil(1000 * 3.8415 / (n + 3.8415))
            expect_equal(cells["today"], f"{p * 1000:.0f}±{half}", f"{option['name']}: today")
            mean = rotation["exceed_probability"]["mean"]
            expect(cells["mean"].startswith(f"{mean * 1000:.0f}±"), option["name"], cells, mean)
            expect_equal(cells["fail"], f"{rotation['unprotected_energy']}/{rotation['years']}", option["name"])
            if "worst" in cells:
                expect_equal(cells["worst"], f"{mean * 1000:.0f} ({rotation['worst_year']})", f"{option['name']}: of one year")
        said = " ".join(screen.body.split())
        expect_in("Today 'thick' lets the fewest dangerous rocks through", said)
        expect_in("'thick' does not change: stand 'many' has no growth and cutting data", said)


def test_reorder_at_once():
    """Options moved, copied, deleted: no figures appear under another name, known ones stay visible."""
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
    expect_equal([name for name, _ in compared(later)], ["thin", "thick", "none left"], "options")
    for name, cells in compared(moved):
        for head in ("today", "mean"):
            expect(cells[head] in (known[name][head], "…"), f"'{name}' has figures of another option", moved)
    for screen, what in ((moved, "moved"), (copied, "copied"), (gone, "deleted")):
        found = {name: cells["today"] for name, cells in compared(screen)}
        expect("thin" in found and "thick" in found, f"nothing is compared once one is {what}", screen)


def test_compare_arrive():
    """View 5 without an accepted energy: arrivals are compared, the energy lights are unknown"""
    with Place() as place:
        place.write("cuts.yaml", play.CUTS.replace(", accepted_kJ: 250", ""))
        screen = place.play("resize 120 40\nkey 5\nwait idle\ndump", "cuts.yaml")[0]
        rocks = re.search(r"(\d+) rocks", screen.now, re.M).group(1)
        run = results("-n", rocks, place.path / "cuts.yaml")[0]
    screen.has("Of 1000 rocks: arrive at", "energy is not judged").lacks("dangerous")
    for (name, cells), option in zip(compared(screen), run["options"], strict=True):
        share = f"{option['controls'][1]['wooded']['reach_probability'] * 1000:.0f}"
        expect(re.match(share + "(±|$)", cells["today"]), f"{name}: arrive {share}", cells)
        expect("fail" not in cells, "years in which a test fails that is not known")
    expect(all(len(signs) == 2 for signs in compared_lights(screen)), "a light of energy that is not judged", screen)


def test_now_wood():
    """The column on the right has the figures of JSON with equal rocks, for each option, at 80x24 and 200x50."""
    script = "wait idle\nkey 1\n" + "clear\nresize 80 24\ndump\nresize 200 50\ndump\nkey ]\n" * 3
    with Place() as place:
        screens = place.play(script, "cuts.yaml")
        rocks = re.search(r"(\d+) rocks", screens[0].now, re.M).group(1)
        run = results("-n", rocks, place.path / "cuts.yaml")[0]
    for i, screen in enumerate(screens):
        option = run["options"][i // 2]
        control = option["controls"][1]
        bare, wooded = control["bare"], control["wooded"]
        expect_equal(screen.now.split("\n")["wood" not in screen.lines[0]], option["name"])
        for name, key in (("arrive", "reach"), ("above 250 kJ", "exceed")):
            expect_equal(screen.pair(name), tuple(round(a[f"{key}_probability"] * 1000) for a in (wooded, bare)), name)
        lo, hi = (wooded[f"exceed_{k}"] * 1000 for k in ("lo", "hi"))
        if screen.width == 200:
            expect_in(f"({math.floor(lo)}–{math.ceil(hi)})", screen.now, "the interval")
        for name, values in (("mean kJ", [a["energy_kJ"]["mean"] for a in (wooded, bare)]),
                             ("95 % below kJ", [a["energy_kJ"]["p95"] for a in (wooded, bare)]),
                             *[("95 % below m", [a["height_m"]["p95"] for a in (wooded, bare)])] * (screen.width == 200)):
            expect_equal(screen.pair(name), tuple(float(f"{v:.3g}") for v in values), name)
        for name, key in (("stems stop", "stopped_by_stems"), ("at rest", "came_to_rest")):
            expect_equal(screen.pair(name), tuple(round(a["missed"][key] * 1000) for a in (wooded, bare)), name)
        words = {"pass": "passes", "fail": "FAILS"}
        expect_equal(lights(screen, "braille"), {name: words[control["lights"][key]] for name, key in (
            ("Contact", "contact"), ("Free run", "free_run"), ("Energy", "energy"))}, "lights")
        expect(re.search(rf"^energy % +{wooded['exceed_probability'] * 100:.1f} ", screen.now, re.M), "share beside the energy light")
        expect_in(f"finished, {rocks} rocks", screen.now, "the mark")


def test_compare_one():
    """With one option none is best; a adds one from a preset and compares both."""
    one, two = fast("""key 5
        wait idle
        dump
        key a
        type bare
        key Enter
        wait idle
        clear
        dump""")
    expect_equal([cells["best"] for _, cells in compared(one)], [""], "one alone")
    expect_in("Only one option.", " ".join(one.body.split()))
    expect_equal(len(compared(two)), 2, "options")
    expect_in("no rocks are simulated through the forest, so arrivals do not separate the options", " ".join(two.body.split()))


def test_next_option():
    """] and [ change the option in every view, with its figures."""
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
    expect_in("thick\n", screens[0].now)
    expect_in("thin\n", screens[1].now)
    screens[1].has("option 2 of 3: thin")
    expect_in("none left\n", screens[2].now)
    expect_equal(screens[3].text, screens[0].text, "around")
    screens[4].has("option 3 of 3")
    thick, thin, none = fast("wait idle\n" + "clear\ndump\nkey ]\n" * 3, "cuts.yaml")
    for name in FIGURE_NAMES[1:]:
        wood = [s.pair(name)[0] for s in (thick, thin, none)]
        expect(wood[0] < wood[1] < wood[2] == none.pair(name)[1], f"'{name}' of the options", wood)


if __name__ == "__main__":
    run_all(__name__)
