#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""View 8: observations and simulations; c fits values, Enter applies them as one edit, Esc keeps nothing."""
import math
import re
import statistics
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import Place, check_good  # noqa: E402
from test_terminal import Tmux  # noqa: E402
from harness import PROFILES, expect, expect_equal, expect_in, good, run_all  # noqa: E402

# Rocks leave a cliff and fly; all are equal. At x = 20 they have flown 20 / v seconds.
FLIGHT = """\
ceduo: scene/1
title: flight
rock: {shape: sphere, diameter_m: 0.5}
release: {height_m: 1, vx_m_s: 10}
slope:
  vertices_m: [[0, 100], [1, 0], [60, 0]]
  segments: [{rn: 0.3, rt: 0.9, roughness_rad: 0, friction: 0.5}]
controls: [{x_m: 20, name: gate}]
forest: []
"""
SEEN = """\
observed:
  - {name: gate speed, speed: {x_m: 20, n: 5, mean: 22.0, sd: 0.5}}
  - {name: too slow, speed: {x_m: 20, n: 5, mean: 20, sd: 0.5}, use: check}
  - {name: all pass, passed: {x_m: 20, count: 10, of: 10}}
  - {name: few pass and nobody knows why, passed: {x_m: 20, count: 6, of: 10}, use: check}
uncertainty: [{path: release.vx_m_s, lo: 5, hi: 15}]
simulation: {rocks: 100}
"""
# a slope on which rocks stop; two grounds of the library
GROUNDS = """\
ceduo: scene/1
title: grounds
rock: {shape: block, axes_m: [0.9, 0.7, 0.6], density_kg_m3: 2600}
release: {height_m: 2, vx_m_s: 0.5}
slope:
  vertices_m: [[0, 62], [25, 33], [60, 9], [85, 3], [200, 1]]
  materials:
    - {from_m: 0, to_m: 60, material: cliff}
    - {from_m: 60, to_m: 200, material: %s}
controls: [{x_m: 85, name: meadow}]
forest: []
observed:
  - stops: {x_m: [80, 95, 100, 104, 110, 118], of: 6}
simulation: {rocks: 60}
"""
G = 9.81


def test_nothing_seen():
    """A scene without observations explains how to add them, computes nothing, and c fits nothing"""
    with Place() as place:
        for size in ("80 24", "200 50"):
            view, key = place.play(f"resize {size}\nwait idle\nkey 8\ndump\nkey c\ndump")
            expect_in_view(view, "This scene has no observations.", "a adds observations", "c fits the ground to them.")
            view.lacks("not computed yet", "fallin")
            key.whole().has("a adds one").lacks("Values to fit")


def test_typed():
    """Observations are typed field by field: stops, a count, heights, scars; edited, deleted, undone, and saved"""
    with Place() as place:
        place.write("flight.yaml", FLIGHT.replace("[60, 0]", "[100, 0]"))
        kinds, stops, refused, wrong, all_, edited, gone, back, saved = place.play("""resize 120 50
            key 8
            wait idle
            key a
            dump
            key 1
            type 41 44,5 52 61
            key Enter
            type 6
            key Enter Enter
            dump
            key a 2
            type sixty
            key Enter
            dump
            key Ctrl-U
            type 60
            key Enter
            type 9
            key Enter
            type 6
            key Enter
            dump
            key Esc Ctrl-U
            type 2
            key Enter Enter
            key a 4
            type 20
            key Enter
            type 1.5, 2, 2.5
            key Enter Enter Enter Enter
            key a 6
            type 10
            key Enter
            type 30
            key Enter
            type 0,8 1,1
            key Enter Enter Enter
            dump
            find observed[1].passed.count
            set 3
            dump
            key d
            dump
            key u
            dump
            wait idle
            key s
            dump""", "flight.yaml")
        text = place.text("flight.yaml")
        check_good(place.path, "flight.yaml")
    kinds.has("New observation", "1 where rocks stopped", "2 how many passed", "4 height of their", "6 scars on stems").lacks("search:")
    stops.has("added; u undoes")
    expect(re.search(r"^1 +41 44\.5 52 61 +6 +-$", stops.body, re.M), stops)
    refused.has("'sixty' is not a number")
    wrong.has("how many passed a place")
    expect_in(" 9 observed, but only 6 released; correct one", wrong.popup, "nine of six")
    for row in (r"2 +60 +2 +6", r"3 +20 +1\.5 2 2\.5 +- +- +-", r"4 +10 +30 +0\.8 1\.1 +- +-"):
        expect(re.search(rf"^{row}$", all_.body, re.M), row, all_)
    expect(re.search(r"^2 +60 +3 +6$", edited.body, re.M), edited)
    gone.lacks("how many passed a place").has("deleted: ")
    expect(re.search(r"^2 +60 +3 +6$", back.body, re.M), back)
    saved.has("saved flight.yaml")
    for words in ("stops: {x_m: [41, 44.5, 52, 61], of: 6}", "passed: {x_m: 60, count: 3, of: 6}", "height: {x_m: 20, values: [1.5, 2, 2.5]}",
                  "scars: {from_m: 10, to_m: 30, height_m: [0.8, 1.1]}"):
        expect_in(words, text, "the file")


def expect_in_view(screen, *parts):
    """Expect each part in the view's own text, in any wrapping."""
    flat = " ".join(screen.whole().body.split())
    for part in parts:
        expect(part in flat, f"{part!r} is missing in the", screen)


def speed_at_gate(v):
    return math.hypot(v, G * 20 / v)


def test_rows():
    """Means and counts equal the closed form: 95 % of the observation error around the flight's speed, all pass"""
    with Place() as place:
        place.write("flight.yaml", FLIGHT + SEEN)
        screens = place.play("key 8 Tab\nwait idle\ndump\nresize 200 50\ndump", "flight.yaml")
    half = 1.96 * 0.5 / math.sqrt(5)
    lo, hi = (speed_at_gate(10) + side * half for side in (-1, 1))
    for screen in screens:
        screen.whole()
        for name, seen, word in (("gate speed", "22.0", "inside"), ("too slow", "20.0", "OUTSIDE")):
            row = re.search(rf"^{name}.* {seen} m/s +([\d.]+)–([\d.]+) {word}$", screen.body, re.M)
            expect(row, f"the row {name} with {word} in", screen)
            for found, wanted in zip(row.groups(), (lo, hi)):
                expect(abs(float(found) - wanted) < 0.09, f"{found}, {wanted:.2f} wanted", screen)
        expect(re.search(r"^all pass +10 +10–10 inside$", screen.body, re.M), screen)
        expect(re.search(r"^(few pass and nobody knows why \(check\))?\s+6 +10–10 OUTSIDE$", screen.body, re.M), screen)
        expect_in_view(screen, "few pass and nobody knows why (check)", "does not reproduce: too slow (p <.001); few pass and nobody",
                   "Only a fit shows which values they determine.", "Simulated: 2000 rocks.")


def test_unknown():
    """An observation that no simulated rock reproduces has no probability and no range, and is reported"""
    with Place() as place:
        place.write("flight.yaml", FLIGHT.replace("height_m: 1, ", "").replace("rt: 0.9", "rt: 0") + "observed:\n"
                    "  - {name: at the end, speed: {x_m: 59, n: 5, mean: 3, sd: 1}}\n"
                    "  - {name: at the gate, speed: {x_m: 20, n: 5, mean: 22, sd: 1}}\nsimulation: {rocks: 100}\n")
        screen = place.play("resize 120 40\nkey 8\nwait idle\ndump", "flight.yaml")[0]
    expect_in_view(screen, "does not reproduce: at the end (no simulated rock does this).")
    expect(re.search(r"^at the end +3.00 m/s +- OUTSIDE$", screen.body, re.M), screen)


def test_spread():
    """An observation named after 'does not reproduce' is not called inside in the row above; only the mean of block 1 fits"""
    with Place() as place:
        screen = place.play("resize 150 40\nkey 8\nwait idle\ndump", "tschamut-arm")[0].whole()
    words = " ".join(screen.body.split())
    expect_in("does not reproduce: block 1 (mean fits, distribution does not: p", words)
    rows = dict(re.findall(r"^(block \d).* m +\S+–\S+ (inside|OUTSIDE|mean only)$", screen.body, re.M))
    expect_equal(rows["block 1"], "mean only", screen)


def test_fit_taken():
    """c fits the values of 'uncertainty'; the speed that gives 22 m/s at the gate; Enter applies it as one edit, u undoes it"""
    with Place() as place:
        place.write("flight.yaml", FLIGHT + SEEN)
        popup, fitted, large, taken, saved, undone = place.play(
            "key 8\nwait idle\nkey c\ndump\nkey Enter\nwait idle\ndump\nresize 200 50\ndump\nkey Enter\nwait idle\ndump\n"
            "key s\nwait idle\ndump\nkey u\nwait idle\ndump", "flight.yaml")
        text = place.text("flight.yaml")
        command = re.search(r"ceduo (--calibrate '(.*?)' -n 100 -o FITTED.yaml) SCENE.yaml", " ".join(large.body.split()))
        expect(command, "the command that writes the draws", large)
        expect_equal(command[2], "release.vx_m_s=5:15")
        good(*command[1].replace("'", "").split(), "flight.yaml", cwd=place.path)
        expect(len(place.text("FITTED.draws.csv").splitlines()) > 100, "draws")
    expect_in("speed along, m/s", popup.popup)
    expect_in("5:15", popup.popup)
    slope = 1.96 * 0.5 / math.sqrt(5) / 1.30  # derivative of the speed at the gate at v = 10 m/s: (v - (20 g)² / v³) / 22
    for screen in (fitted, large):
        best, lo, hi = map(float, re.search(r"speed along, m/s ([\d.]+) \(([\d.]+)–([\d.]+)\)", screen.body).groups())
        expect(abs(speed_at_gate(best) - 22) < 0.15 and abs(lo - 10.02 + slope) < 0.1 and abs(hi - 10.02 - slope) < 0.1, screen)
        expect_in_view(screen, "Fitted. Enter applies these values", "The fit does not reproduce the observations held back to check it: too slow.")
    expect_in_view(large, "The model reproduces all fitted observations.", "A neighbouring profile may need another ground.")
    expect_in_view(large, "It does not write the draws, all plausible values.", "-n 100 -o FITTED.yaml SCENE.yaml")
    expect_in("values and ranges written to the scene, without the draws; u undoes", taken.note)
    expect("*" in taken.title and "*" not in saved.title, "a star while it is unsaved", taken, saved)
    value = re.search(r"vx_m_s: *([\d.]+)", text)
    expect(value and abs(speed_at_gate(float(value.group(1))) - 22) < 0.05, "the value in the file", text)
    expect_in("kind: calibrated", text)
    expect_in("undone: fitted values", undone.note)
    expect("Fitted." not in undone.body, undone)


def read_picture(screen):
    """Return the lines of the picture of stops, down to its axis."""
    lines = screen.body.split("\n")
    return lines[:next(i for i, line in enumerate(lines) if "└" in line) + 2]


def test_fit_of_a_library_ground():
    """Enter writes a fitted ground of the library into its row, and the other grounds and the points of the profile stay"""
    with Place() as place:
        place.write("s.yaml", (GROUNDS % "talus").replace(
            "slope:", "uncertainty: [{path: 'slope.materials[talus].friction', lo: 0.2, hi: 0.6}]\nslope:"))
        place.play("key 8\nwait idle\nkey c\nkey Enter\nwait idle\nkey Enter\nwait idle\nkey s\nwait idle", "s.yaml")
        text = place.text("s.yaml")
    expect_in("{from_m: 0, to_m: 60, material: cliff}", text)
    expect(re.search(r"from_m: 60,? *\n? *to_m: 200,? *\n? *material: talus,? *\n? *friction: 0\.\d+,? *\n? *source: *\n? *\{?kind: calibrated", text), text)
    expect("segments" not in text and "[200, 1]" in text and "'slope.materials[talus].friction'" in text.replace('"', "'"), text)


def test_stops_of_each_option():
    """For stops below two forests the picture is the shown option's"""
    head = GROUNDS[:GROUNDS.index("forest:")].replace("  materials:", "  segments: [{rn: 0.3, rt: 0.8}]\n  # ").replace(
        "    - {from_m", "  # - {from_m")
    head += "options: [{name: one, forest: []}, {name: two, forest: []}]\nobserved:\n"
    rows = ["  - {stops: {x_m: [80, 95, 104, 118], of: 4}, option: one}\n", "  - {stops: {x_m: [30, 35, 40], of: 3}, option: two}\n"]
    play_both = "resize 120 40\nkey 8\nwait idle\ndump\nkey ]\nwait idle\ndump"
    with Place() as place:
        found = []
        for names in (("one", "two"), ("two", "one")):
            seen = "".join(row[:row.index("option:")] + f"option: {name}}}\n" for row, name in zip(rows, names))
            place.write("s.yaml", head + seen + "simulation: {rocks: 60}\n")
            found.append([read_picture(screen) for screen in place.play(play_both, "s.yaml")])
    expect_equal(found[1], found[0][::-1], "the other way round")
    expect(found[0][0] != found[0][1], "one picture for both", found[0][0])


def test_fit_keeps_a_spread():
    """A fitted value that is the mean of a distribution replaces only the mean"""
    with Place() as place:
        place.write("flight.yaml", (FLIGHT + SEEN).replace("vx_m_s: 10}", "vx_m_s: {mean: 10, spread: 0.02}}"))
        place.play("key 8\nwait idle\nkey c\nkey Enter\nwait idle\nkey Enter\nwait idle\nkey s\nwait idle\ndump", "flight.yaml")
        text = place.text("flight.yaml")
    value = re.search(r"vx_m_s: *{mean: *([\d.]+), *spread: *([\d.]+)", text)
    expect(value and float(value[2]) == 0.02 and value[1] != "10" and abs(speed_at_gate(float(value[1])) - 22) < 0.2, text)


def test_fit_left():
    """Esc during a fit, Esc after it, and an edit meanwhile keep nothing of it"""
    with Place() as place:
        place.write("flight.yaml", FLIGHT + SEEN)
        stopped, done, left, edited = place.play(
            "key 8 Tab\nwait idle\nkey c Enter Esc\nwait idle\ndump\nkey c Enter\nwait idle\ndump\nkey Esc\nwait idle\ndump\n"
            "key c Enter\nkey 3\nfind rock.diameter_m\nset 0.6\nkey 8 Tab\nwait idle\ndump", "flight.yaml")
        expect_equal(place.text("flight.yaml"), FLIGHT + SEEN)
    done.has("Fitted.", "Enter apply", "Esc discard")
    for screen in (stopped, left, edited):
        screen.has("c fit").lacks("Enter apply", "Esc discard")
    for screen in (stopped, left):
        expect("*" not in screen.title and "Fitted." not in screen.body, screen)
    expect_in("fit discarded; the scene is unchanged", left.note)
    edited.lacks("Fitted.", "Fitting.").has("Simulated: 2000 rocks.")


def test_bounds():
    """Invalid, reversed or out-of-range bounds are reported, and nothing is fitted; all empty likewise"""
    with Place() as place:
        place.write("flight.yaml", FLIGHT + SEEN)
        for typed, said in (("ten", "'ten' is not a number"), ("5", "the smaller first"), ("9:5", "the smaller first"),
                            ("5:5000", "5000"), ("", "no value to fit")):
            wrong, = place.play(f"key 8\nwait idle\nkey c Ctrl-U\n{'type ' + typed if typed else ''}\nkey Enter\nwait idle\ndump",
                                "flight.yaml")
            expect_in(said, wrong.popup)
        comma, = place.play("key 8\nwait idle\nkey c Ctrl-U\ntype 9,5:10,5\nkey Enter\nwait idle\ndump", "flight.yaml")
        comma.has("Fitted.")


def test_grounds():
    """Without a named range the grounds are proposed, each with its name; the picture of stops; nothing is cut"""
    with Place() as place:
        place.write("two.yaml", GROUNDS % "talus")
        for name, roughness in (("length", "roughness_m: 0.4"), ("angle", "roughness_rad: 0.1")):
            place.write(f"{name}.yaml", re.sub(r"  materials:\n.*\n.*\n",
                                               f"  segments: [{{rn: 0.35, rt: 0.85, {roughness}}}]\n", GROUNDS))
        place.write("arm.yaml", GROUNDS.replace("rocks: 60", "rocks: 60, law: arm") % "talus")
        place.write("ground.csv", "x,z\n0,62\n25,33\n60,9\n85,3\n200,1\n")
        place.write("unsaid.yaml", re.sub(r"slope:\n.*\n  materials:\n.*\n.*\n", "slope: {csv: ground.csv}\n", GROUNDS))
        place.write("check.yaml", (GROUNDS % "talus").replace("of: 6}", "of: 6}\n    use: check"))
        look, smallest, wide, popup = place.play(
            "key 8 Tab\nwait idle\ndump\nresize 60 20\ndump\nresize 200 50\ndump\nkey c\ndump", "two.yaml")
        smallest.whole().has("mean or count")
        length, angle = [place.play("key 8\nresize 200 50\nkey c\ndump", f"{name}.yaml")[0] for name in ("length", "angle")]
        place.write("mu.yaml", (GROUNDS % "talus").replace("slope:", "uncertainty: [{path: 'slope.materials[talus].mu', lo: 0.4, hi: 0.9}]\nslope:")
                    .replace("rocks: 60", "rocks: 60, law: arm"))
        mu, = place.play("key 8\nresize 200 50\nkey c\ndump", "mu.yaml")
        expect("friction, talus" in mu.popup and "0.4:0.9" not in mu.popup, "one shape does not tell mu; the grounds are offered:", mu)
        arm, = place.play("key 8\nresize 200 50\nkey c\ndump", "arm.yaml")
        unsaid, = place.play("key 8\nresize 200 50\nkey c\ndump", "unsaid.yaml")
        check, = place.play("key 8\nkey c\ndump", "check.yaml")
    for screen in (look, wide):
        screen.whole().has("farther:", "1.0┤", "0.0┤")
        expect(re.search(r"^stops +101 m .*(inside|OUTSIDE)$", screen.body, re.M), screen)
    popup.has("bounce Rn, cliff", "Usual bounds of other values: bounce Rn, talus")
    # A half to one and a half times the scene's own; a length also all that the library has, from 0 m of pavement on.
    expect(re.search(r"roughness, m +0:0\.6 ", length.popup), length)
    expect(re.search(r"roughness, rad +0\.05:0\.15 ", angle.popup), angle)
    expect("slide Rt" not in arm.popup and "friction, cliff" in arm.popup, "arm knows no rt:", arm)
    usual = dict(re.findall(r"(bounce Rn|slide Rt), talus ([\d.:]+)", popup.popup))
    for name in ("bounce Rn", "slide Rt"):
        expect(re.search(rf"{name} +{usual[name]}", unsaid.popup), f"{name} of talus, {usual[name]}, where nothing is said", unsaid)
    check.has("all observations are for checking").lacks("Values to fit")


def test_too_many_values():
    """Four values of the ground and 50 stops: the fit reports which to fix, as Rn and Rt are correlated; c asks
    again without it"""
    with Place() as place, Tmux(place) as t:
        t.start("quarry")
        t.keys("8", "c")
        t.sees("Values to fit")
        t.keys("Enter", "Enter", "Enter", "Enter")
        told = " ".join(line[:50].strip() for line in t.sees("not determine all 4").split("\n"))
        named = re.search(r"do not determine all 4 values, so the ranges are rough: fix (.*?), or observe more\. c fits without it", told)
        expect(named and re.search("bounce Rn|slide Rt", named.group(1)), told)
        t.keys("c")
        asked = t.sees("Values to fit")
        for name in ("bounce Rn", "slide Rt", "roughness, m", "friction"):
            empty = not re.search(rf"{name} +[\d.]+:[\d.]+", asked)
            expect_equal(empty, name in named.group(1), f"{name}, where {named.group(1)} is to be fixed:\n{asked}")
        t.keys("Escape", "Escape")
        t.sees("fit discarded; the scene is unchanged")


def test_quarry():
    """The quarry: its first roughness and friction do not give the 50 stops; a fit of both does, and is applied"""
    mean = statistics.mean(float(x) for x in (PROFILES / "observed/quarry-stops.csv").read_text().split()[1:])
    with Place() as place:
        small, large, fitted, taken = place.play(
            "key 8 Tab\nwait idle\ndump\nresize 200 50\ndump\nkey c Ctrl-U Backspace Enter Ctrl-U Backspace Enter Enter Enter\n"
            "wait idle\ndump\nkey Enter\nwait idle\ndump", "quarry")
    for screen in (small, large):
        expect_in_view(screen, "farther:", "does not reproduce: stops")
        expect(re.search(rf"^stops +{mean:.0f} m .* OUTSIDE$", screen.body, re.M), screen)
    expect_in_view(fitted, "roughness, m", "friction", "The model reproduces all fitted observations.")
    expect_in_view(taken, "The scene reproduces all observations.")
    expect(re.search(rf"^stops +{mean:.0f} m .* inside$", taken.body, re.M), taken)


if __name__ == "__main__":
    run_all(__name__)
