#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages of several options: the comparison, and the best option."""
import math
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import Folder, belt, expect, expect_equal, expect_in, good, result, run_all, stand, wooded_scene
from pages import WHOLE, parse_arrivals, expect_arrivals, expect_cells, expect_option, expect_order, expect_width, section, side_by_side
from runs import FOUR, THICK, THIN, through, treated


def leader(shares, to_first):
    """Return the option with the smallest share, if each other one is worse by three errors; the errors of differences to the
    first are known."""
    zero = {"mean": 0, "se": 0}
    best = min(shares, key=shares.get)
    mean, se = (to_first.get(best, zero)[key] for key in ("mean", "se"))
    for name in shares:
        d = to_first.get(name, zero)
        expect(name == best or d["mean"] - mean > 3 * math.hypot(d["se"], se), f"{best} is not clearly better than {name}", d)
    return best


def test_table_options():
    """The table of the four systems: each option, then the comparison with differences, and options that are not separated"""
    text, run = good(*WHOLE, "-n", 500, FOUR).out, result(FOUR, "-n", 500)
    names = [o["name"] for o in run["options"]]
    expect_order(text, *[re.escape(n) for n in names], "(?i)side by side")
    for option in run["options"]:
        expect_option(section(text, option["name"]), option, alone=False)
    expect_arrivals(parse_arrivals(section(text, "without forest"))[0]["bare"], run["options"][0]["controls"][0]["bare"])
    head, rows, words = side_by_side(text, names)
    expect_in("> 50 kJ", head, "head")
    for name, word in (("simple coppice, just cut", "✘"), ("simple coppice, 25 years", "✔"), ("large reserves, just cut", "✘")):
        expect(re.search(rf" [\d.]+ {word} ", rows[name]), f"no {word} of contact", rows[name])
    for option in run["options"]:
        wooded = option["controls"][0]["wooded"]
        share = wooded["exceed_probability"]
        half = math.ceil(1959.963984540054 * math.sqrt(share * (1 - share) / run["rocks"]))
        expect_cells(rows[option["name"]], f"{share * 1000:.0f}±{half}")
        light = {"pass": "✔", "fail": "✘"}[option["controls"][0]["lights"]["energy"]]
        expect(re.search(rf" {share * 1000:.0f}±{half} {light} +(-|\S+±\d+) +[\d.]+ [✔✘] ", rows[option["name"]]),
               "the share and its light are not the first", rows[option["name"]])
    for difference in run["differences"]:
        d = difference["exceed_probability"]
        expect_cells(rows[difference["option"]], f"{d['mean'] * 1000:+.0f}±{math.ceil(d['se'] * 1959.963984540054)}")
    expect_in("Today no option passes the test of energy: it does not distinguish them", words, "what does not distinguish them")
    shares = {o["name"]: o["controls"][0]["wooded"]["exceed_probability"] for o in run["options"]}
    best = leader(shares, {d["option"]: d["exceed_probability"] for d in run["differences"]})
    expect_in(f"Today '{best}' lets the fewest dangerous rocks through: {1000 * shares[best]:.0f} of 1000.", words, "the best today")
    windows = {o["name"]: o["window"] for o in run["options"]}
    best = min(windows, key=lambda name: windows[name]["mean"])
    expect(all(w["mean_lo"] > windows[best]["mean_hi"] for name, w in windows.items() if name != best), "none is best by far", windows)
    expect_in(f"In years 1 to 25 '{best}' lets the fewest dangerous rocks through: {1000 * windows[best]['mean']:.0f} of 1000.", words,
              "the best over the years")
    expect_in("Over years 1 to 25, counted from today: ", words)
    lines = text[text.index("Over years 1 to 25, counted"):].splitlines()
    first = next(i for i, line in enumerate(lines) if line.strip().startswith("option")) + 1
    for w, row in zip(windows.values(), lines[first:first + len(names)]):
        half = math.ceil(1000 * (w["mean_hi"] - w["mean"]))
        expect(re.search(rf" {1000 * w['mean']:.0f}±{half} +(?:\S+ +)?{1000 * w['worst']:.0f} \({w['worst_year']}\) +{w['failing_years']}/25 ", row), row, w)
    expect("By contact" not in words, words)
    expect_width(text)
    same = good(*WHOLE, "-n", 50, FOUR, "--option", "large reserves", "--option", "coppice with standards").out
    expect_order(same, r"(?i)today all options pass the tests of contact and free run:\s+they do not distinguish")


def test_table_options_index():
    """The table of the four systems by the index: options that are not separated, no winner"""
    text = good(*WHOLE, "-n", 500, *through("index"), FOUR).out
    names = [o["name"] for o in result(FOUR, "-n", 1)["options"]]
    expect_order(text, *[re.escape(n) for n in names], "(?i)side by side")
    head, rows, words = side_by_side(text, names)
    expect_in("arrivals do not separate the options", words)
    for name, word in (("simple coppice, just cut", "✘"), ("simple coppice, 25 years", "✔"), ("large reserves, just cut", "✘")):
        expect(re.search(rf"[\d.]+ {word} ", rows[name]), f"no {word} of contact", rows[name])
    expect_in("The index is the energy that stems could absorb, not the loss of a rock", words)
    answer = words.replace("treatments best protects", "")  # which is the question
    expect(not re.search(r"(?i)\b(winner|best|recommended|worst option|rank)\b", answer), "a winner is named:", text)
    expect(re.search(r"kJ/100 m +left kJ", head), "heads run into one another:", head)
    expect("±" not in "".join(rows.values()), "an error of what was not flown", rows)


def best_sentence(folder, scene_mapping, *arguments):
    path = folder.write("s.yaml", scene_mapping)
    names = [o["name"] for o in result(path, "-n", 2, *arguments)["options"]]
    return side_by_side(good(*WHOLE, path, *arguments).out, names)[2]


def test_table_best():
    """The table names the option with fewest arrivals only if it is clear; without an accepted energy there is no danger"""
    with Folder() as f:
        for order in ({"many_thin": THIN, "few_thick": THICK}, {"few_thick": THICK, "many_thin": THIN}):
            words = best_sentence(f, treated(**order))
            expect_in("Today 'few thick' lets the fewest dangerous rocks through: ", words)
            expect("rotation" not in words and "Over " not in words, "a rotation of stands that do not grow", words)
            expect_in("'few thick' does not change: stand 'thick' has no growth and cutting data", words)
        options = [{"name": name, "forest": [{"from_m": 10, "to_m": 95, "stand": st}]} for name, st in (("cut", "simple-coppice"), ("grows", "ads-1"))]
        words = best_sentence(f, wooded_scene(forest=None, options=options), "-n", 50)
        expect(re.search(r"option mean rotation worst .* cut \d+±\d+ \d+±\d+ ", words), words)
        words = best_sentence(f, treated(none=None, many_thin=THIN))  # these take hardly any energy
        expect_in("Today no option is clearly better than the others.", words)
        expect_in("'none' does not change: it has no stems.", words)
        words = best_sentence(f, treated(many_thin=THIN, few_thick=THICK), *through("index"))
        expect("the fewest" not in words and "best" not in words.replace("treatments best protects", ""), words)
        hardly = {**THICK, "trees": [{"per_ha": 301, "dbh_m": 0.4, "height_m": 18, "volume_m3": 1}]}
        words = best_sentence(f, treated(few_thick=THICK, hardly_more=hardly), "-n", 300)
        expect_in("Today no option is clearly better than the others.", words)
        weak = {**THICK, "trees": [{**THICK["trees"][0], "volume_m3": 0.001}]}
        words = best_sentence(f, treated(weak=weak, strong=THICK, as_strong=THICK))
        expect(re.search(r"Today 'strong' and 'as strong' are equal and let the fewest dangerous rocks through: \d+ of 1000\.", words), words)
        hardly = {f"hardly_{n}": {**THICK, "trees": [{**THICK["trees"][0], "per_ha": 300 + n}]} for n in range(1, 4)}
        words = best_sentence(f, treated(weak=weak, strong=THICK, **hardly), "-n", 300)
        expect(re.search(r"Today 'strong', 'hardly 1', 'hardly 2' and 'hardly 3' let the fewest dangerous rocks through and cannot be "
                         r"told apart: \d+, \d+, \d+ and \d+ of 1000\.", words), words)
        mapping = {**treated(none=None, few_thick=THICK), "controls": [{"x_m": 110, "accepted_kJ": 1e6}]}
        expect_in("Today no option is clearly better than the others.", best_sentence(f, mapping), "nothing comes with so much")
        mapping["controls"] = [{"x_m": 110}]
        words = best_sentence(f, mapping)
        expect_in("Today 'few thick' lets the fewest rocks through: ", words)
        expect_in("No accepted energy is set (accepted_kJ): energy is not judged.", words)
        expect("dangerous" not in words and "by energy" not in words.lower(), words)


def test_table_of_none():
    """With no rock among n above the energy, or no difference, Wilson's interval gives the bound: never 0"""
    with Folder() as f:
        path = f.write("s.yaml", {**treated(few_thick=THICK, none=None), "controls": [{"x_m": 110, "accepted_kJ": 1e6}]})
        rows = side_by_side(good(*WHOLE, "-n", 200, path).out, ["few thick", "none"])[1]
        half = math.ceil(1000 * 1.959963984540054**2 / (200 + 1.959963984540054**2))
        expect_cells(rows["few thick"], f"0±{half}")
        expect(re.search(rf" 0±{half} [✔✘] +< {half} ", rows["none"]), rows)


def test_table_best_same():
    """Among equal options none is the best"""
    with Folder() as f:
        words = best_sentence(f, treated(one=THICK, other=THICK))
        expect(re.search(r"Today all options are equal: \d+ of 1000\.", words), words)


def test_table_four_best():
    """Four equal options that are better than a fifth are all named, with commas and one 'and'"""
    with Folder() as f:
        path = f.write("s.yaml", wooded_scene(forest=None, options=[{"name": "none"}, *({"name": n, "forest": [belt(10, 95)]} for n in "abcd")]))
        words = " ".join(good(*WHOLE, path).out.split())
        share = result(path)["options"][1]["controls"][1]["wooded"]["exceed_probability"]
        expect_in(f"'a', 'b', 'c' and 'd' are equal and let the fewest dangerous rocks through: {share * 1000:.0f} of 1000.", words)


if __name__ == "__main__":
    run_all(__name__)
