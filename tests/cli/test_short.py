#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The short page of --batch: the pages of all shipped scenes are in pages/*.txt; line widths; and its figures equal those of
JSON and --sensitivity. `test_short.py --write` rewrites pages/*.txt: read them aloud afterwards."""
import functools
import math
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import PROFILES, Folder, expect, expect_equal, expect_in, good, result, run_all, wooded_scene
from pages import WHOLE, parse_arrivals, expect_width, share_per_1000
from runs import FOUR, PAPER, through

PAGES = Path(__file__).resolve().parent / "pages"
SCENES = sorted((PROFILES / "scenes").glob("*.yaml"))
ROCKS = 200
LAWS = re.compile(r"(?i)\b(brauner|dorren|lumped|crsp|arm|gsteiger|crofton|interception|eq\.)\b")


def run_page(scene, *arguments):
    return good("--batch", "-n", ROCKS, *arguments, scene).out


shipped = functools.cache(run_page)  # cached text of a file that never changes


def above(page):
    """Return the lines above the assumptions."""
    return re.split(r"(?m)^(?:ASSUMED|IPOTESI|NOTE|NOTA|MORE|ALTRO) ", page)[0]


def test_golden():
    """The pages of the shipped scenes, one file each"""
    for scene in SCENES:
        wanted = (PAGES / f"{scene.stem}.txt").read_text(encoding="utf-8")
        expect_equal(shipped(scene), wanted, scene.name)


def test_lines():
    """One screen for one option, 14 lines and 2 per option (2 more with blocks, 4 with a fence), at most 80 wide, in both languages and in ASCII"""
    signs = set()  # pages in ASCII: a slow page with uncertainty only for characters that no earlier page had
    for scene in SCENES:
        text = scene.read_text(encoding="utf-8")
        options, shared = len(result(scene, "-n", 2)["options"]), 14 + 2 * ("\nblocks:" in text) + 4 * (" fence: {" in text)
        whole, few = shipped(scene), ("-n", 20, "-s", "uncertainty=none")
        ascii_of = few if signs >= {c for c in whole if not c.isascii()} else ("-n", ROCKS)
        signs |= set(whole)
        same = run_page(scene, *few) if ascii_of == few else whole
        in_ascii = good("--batch", *ascii_of, scene, env={"LC_ALL": "C"}).out
        expect_equal(in_ascii.count("?"), same.count("?"), "question marks in the place of what ASCII lacks")
        for page in (whole, run_page(scene, "--language", "it"), in_ascii):
            lines = page.splitlines()
            expect(page == in_ascii or len(lines) <= (24 if options == 1 else shared + 2 * options), f"{len(lines)} lines", page)
            expect_width(page)
            expect(not LAWS.search(above(page)), "a law or an equation is named", page)
            expect(not re.search(r"(?m)^(ASSUMED \*|IPOTESI \*|NOTE|NOTA) +\(", page), "a heading says how many more, and nothing else", page)


def test_figures():
    """The page equals JSON: per 1000 with both errors, energies, ADC, stopped rocks"""
    run, page = result("-n", ROCKS, PAPER), shipped(PAPER)
    control = run["options"][0]["controls"][0]
    wood, bare, index = (control[k] for k in ("wooded", "bare", "index"))
    rows = parse_arrivals(page)[0]
    for side, arrivals in (("wooded", wood), ("bare", bare)):
        expect_equal((rows[side]["arrive"], rows[side]["arrive with more than 50 kJ"]),
                     (share_per_1000("reach", arrivals), share_per_1000("exceed", arrivals)), side)
        expect_equal(rows[side]["95 % stay below, kJ"], f"{arrivals['energy_kJ']['p95']:.3g}", side)
        expect(rows[side]["mean energy of those that arrive, kJ"].startswith(f"{arrivals['energy_kJ']['mean']:.3g} ("), side, page)
    expect(re.search(rf"taken by stems \(index\), kJ +{index['dissipated_kJ']:.3g}$", page, re.M), page)
    expect(re.search(rf"left \(index\), kJ +{index['residual_kJ']:.3g}$", page, re.M), page)
    expect(re.search(r"\(ADC\), m +2\.61 +< 30 ✔$", page, re.M), page)
    lo, hi = int(wood["exceed_lo"] * 1000), -int(-wood["exceed_hi"] * 1000 // 1)
    expect_in(f"HOW SURE  Sampling error ({ROCKS} rocks): {lo}–{hi}. ", page)
    window = run["options"][0]["window"]
    expect_in(f"; today {1000 * wood['exceed_probability']:.0f} (NO)\n", page, "today beside the years")
    expect(re.search(rf"in {window['failing_years']} of 20 years more than 50 of 1000 rocks exceed 50 kJ$", page, re.M), page)
    expect(re.search(rf"^  mean {1000 * window['mean']:.0f} ±\d+ \(range \d+–\d+\) of 1000, worst {1000 * window['worst']:.0f} in year "
                     rf"{window['worst_year']}; ", page, re.M), page)
    few = ("-n", 32, "-s", "years.first=1", "-s", "years.last=2", PAPER)  # all points fit the limit of a page
    uncertainty = next(f for f in good("--sensitivity", "-f", "json", *few).json()[0]["figures"] if f["figure"] == "exceed_probability")
    band = f"{1000 * uncertainty['uncertainty']['p5']:.0f}–{1000 * uncertainty['uncertainty']['p95']:.0f}"
    expect_in(f" Uncertain inputs: {band}.", " ".join(good("--batch", *few).out.split()), "how sure")


def test_over_the_years():
    """The range of the mean over the years is next to that mean: it has its own band with both errors, not today's"""
    few = ("-n", 32, "-s", "years.first=1", "-s", "years.last=2", "--option", "simple coppice", "--option", "selection coppice",
           "rotation")  # all points fit the limit of a page
    figures = good("--sensitivity", "--years", "-f", "json", *few).json()[0]["figures"]
    page = good("--batch", "--years", *few).out
    for option in result("--years", *few)["options"]:
        name, rocks = option["name"], option["rotation"]["exceed_probability"]
        uncertainty = next(f for f in figures if f["figure"] == "rotation.exceed_probability" and f["option"] == name and not f["against"])
        mean, *band = map(int, re.search(rf"^  {name} +\S+ +(\d+)±\d+ +(\d+)–(\d+) ", page, re.M).groups())
        lo, hi = (round(1000 * uncertainty["uncertainty"][end]) for end in ("p5", "p95"))
        half = 1.959964 * rocks["se"]
        expect_equal(mean, round(1000 * rocks["mean"]), name)
        expect_equal(band, [min(math.floor(1000 * (rocks["mean"] - half)), lo), max(math.ceil(1000 * (rocks["mean"] + half)), hi)], name)


def test_beside_the_threshold():
    """An ADC has enough digits to show its side of the threshold, as on the whole page"""
    adc = result("-n", 2, "rotation")["options"][0]["stands"][0]["adc"]["adc_m"]
    for threshold in (adc * 0.9999, adc * 1.0001):
        page = good("--batch", "-n", 2, "-s", f"simulation.threshold_m={threshold}", "rotation").out
        shown = float(re.search(r"(?m)^  simple coppice .*?(\d\.\d+) +[\d.-]+$", page).group(1))
        expect((shown < threshold) == (adc < threshold) and abs(shown / adc - 1) < 0.005, f"{shown}, {threshold}", page)


def test_answers():
    """Yes, no, it depends, no answer, no limit: each has its words, and reports if uncertainty was not computed"""
    with Folder() as f:
        def first(**changes):
            return next(line for line in run_page(f.write("s.yaml", {**wooded_scene(), **changes})).splitlines() if line.startswith("  "))
        road = {"x_m": 110, "name": "road"}
        expect(re.match(r"  ✔ YES, also without forest: 0 of 1000 > 1000 kJ", first(controls=[{**road, "accepted_kJ": 1e3}])), "yes")
        expect(re.match(r"  ✘ NO: \d+ of 1000 arrive with more than 0.01 kJ", first(controls=[{**road, "accepted_kJ": 0.01}])), "no")
        expect(re.match(r"  \d+ of 1000 arrive \(\d+ without forest\)", first(controls=[road])), "no limit")
        expect_in("by the index ", first(simulation={"contact_model": "index", "rocks": 200}, controls=[{"x_m": 110}]))
    expect_in("Uncertainty was not computed: the scene has 'uncertainty: none'.", " ".join(run_page(PAPER, "-s", "uncertainty=none").split()))
    expect(re.search(r"\? IT DEPENDS: in 0–\d+ of 20 years more than 50 of 1000 rocks exceed 140 kJ", run_page(PAPER, "-s", "controls[0].accepted_kJ=140")), "depends")
    page = " ".join(run_page(FOUR, *through("index")).split())
    expect("of plausible cases" not in page and "so arrivals do not separate the options." in page, page)


def test_several_scenes():
    """Several scenes: a table of their verdicts, then each page as alone; for one remaining scene no table"""
    pages = [shipped(scene) for scene in (PAPER, PROFILES / "scenes/road-below.yaml")]
    both = good("--batch", "-n", ROCKS, PAPER, "road-below").out
    expect(both.endswith("\n\n" + "\n".join(pages)), both)
    table = both[:-len("\n".join(pages))]
    expect_equal([re.search(r"[✘?].*?(?=:|$)", line).group() for line in table.splitlines() if re.search("[✘?]  ?[A-Z]", line)],
                 ["✘ NO", "? IT DEPENDS", "? IT DEPENDS", "? IT DEPENDS"])
    expect_width(table)


def test_profiles_of_one_place():
    """Scenes above one road: its verdict first, the worst profile's, then the profiles, worst first; in the report, too"""
    road = {"x_m": 90, "name": "road", "accepted_kJ": 60}
    sites = {"calm": wooded_scene(title="calm", controls=[road], release={"x_m": 85, "vx_m_s": 2}),  # a fall of 4 m: 24 kJ at most
             "bare": wooded_scene(title="bare", controls=[road], forest=None),
             "wood": wooded_scene(title="wood", controls=[road])}
    with Folder() as f:
        files = [f.write(f"{name}.yaml", site) for name, site in sites.items()]
        shares = {}
        for name, path in zip(sites, files):
            control = result(path, "-n", 300)["options"][0]["controls"][0]
            shares[name] = control["wooded"]["exceed_probability"]
        expect(shares["bare"] > shares["wood"] > 0.1 and shares["calm"] == 0, shares)
        text = good("--batch", "-n", 300, *files).out
        expect_equal(re.findall(r"^(\w+) \u2013 300 rocks", text, re.M), ["bare", "wood", "calm"], "the pages, as the table")
        table = text.split("\n\n")[0].splitlines()
        expect_equal([line.split()[0] for line in table], ["scene", "road", "bare", "wood", "calm"], "order")
        expect(re.match(r"road as a whole +✘ NO: on 2 of 3 profiles$", table[1]), table[1])
        page = good("--report", "-", "-n", 50, *files).out
        expect_equal(re.findall(r"<h1[^>]*>([^<]*)", page), ["3 scenes, the worst first", "bare", "wood", "calm"])
        expect_in("road as a whole", page)
        other = f.write("o.yaml", wooded_scene(title="house", controls=[{**road, "name": "house"}]))
        expect("as a whole" not in good("--batch", "-n", 50, files[1], other).out, "two places are not one")


def test_bounded():
    """-n limits all simulations of the page, and the page prints the number of rocks, and what is assumed without the texts of its sources"""
    page = good("--batch", "-n", 7, FOUR).out
    expect_in("today (7 rocks)", page)
    expect_in("(7 each)", " ".join(page.split()))
    long = "a very long remark that goes on and on, " * 9
    page = run_page(PAPER, "-s", f"controls[0].source.text={long}", "-s", "controls[0].source.kind=assumed")
    expect(len(page.splitlines()) <= 24 and re.search(r"ASSUMED \* limit of control 1; stems count from$", page, re.M) and "remark" not in page, page)


def test_details():
    """--details includes the answer, and repeats nothing: the bare slope appears once"""
    text = good(*WHOLE, "-n", 50, FOUR).out
    sentences = re.findall(r"[A-Z][^.:]{30,}[.:]", " ".join(text.split()))
    expect_equal(len(re.findall(r"(?m)^  of 1000 .*without forest$", text)), 1, "tables without forest")
    expect_equal(len(re.findall(r"(?m)^    without, ", text)), 1, "percentiles without forest")
    twice = {s for s in sentences if sentences.count(s) > 1 and "lets the fewest" in s}
    expect(not twice, twice)


if __name__ == "__main__":
    if "--write" in sys.argv:
        for each in SCENES:
            (PAGES / f"{each.stem}.txt").write_text(run_page(each), encoding="utf-8")
    else:
        run_all(__name__)
