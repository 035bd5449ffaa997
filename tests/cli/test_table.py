#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: brief
"""The page of one option: its statements, tables, width, warnings and sources."""
import math
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import (FULL, PROFILES, Folder, belt, expect, expect_equal, expect_in, expect_near, good, result, run_all, scene, stand,
                     wooded_scene)
from pages import (WHOLE, parse_arrivals, parse_sizes, columns, digits, expect_cells, expect_option, expect_order, expect_width,
                   half_of_mean, share_per_1000, section, table_row)
from runs import FOUR, MODELS, PAPER, THICK, THIN, expect_run, read_csv, through, treated


def test_table_order():
    """Table of the paper's site: statements in order, wooded first and bare below it, verdicts in words"""
    text, run = good(*WHOLE, PAPER).out, result(PAPER)
    option = run["options"][0]
    control = option["controls"][0]
    expect_order(text, "Test site of Ciabocco et al. 2009", "Rock", "512.3 kg", "Slope", "current", "ADS 1", "1.95 ✔", "ADS 2", "2.61 ✔", "135 m", "with forest without forest",
                 "992", "896", "stopped by stems", "at rest", "113 ", "stems hit", "Contact: passes", "30 m", "Free run: passes", "Energy: FAILS", "of 1000 arrive with more than 50 kJ",
                 "50 are allowed", "interception", "gsteiger-stools 3.04 m",
                 "gsteiger-stems 1.49 m", "crofton 2.17 m", "(?i)by the index", "53.8 kJ",
                 "39.9 kJ per 100 m", "59.4 kJ are left \\(Eq. 5\\)", "62.3 kJ", "(?i)one rock", "Blocks of other sizes",
                 "Eq. 6 gives 2.61 m", "Assumed")
    expect_option(text, option)
    expect_in(f"Energy: FAILS. {share_per_1000('exceed', control['wooded'])} of 1000 arrive with more than 50 kJ",
              re.sub(r"\s+", " ", text), "the energy light's reason")
    expect_in("limit 50 kJ*", text, "mark of the assumed accepted energy")
    expect_width(text)


def test_table_order_index():
    """Table of the paper's site by the index: no figure with forest, the index labelled, the energy light unknown"""
    text, run = good(*WHOLE, *through("index"), PAPER).out, result(*through("index"), PAPER)
    expect_order(text, "Test site of Ciabocco et al. 2009", "Rock", "512.3 kg", "Slope", "current", "ADS 1", "1.95 ✔", "ADS 2", "2.61 ✔", "135 m", "without forest", "992",
                 "896", "113 ", "Contact: passes", "Free run: passes", "Energy: unknown", "index", "gsteiger-stools 3.04 m", "By the index stems could absorb 53.8 kJ \\(Eq. 4\\), 39.9 kJ per 100 m; of 113.2 kJ 59.4 kJ are left \\(Eq. 5\\)", "62.3 kJ", "(?i)one rock", "Eq. 6 gives 2.61 m")
    expect_option(text, run["options"][0])
    expect("with forest" not in text and "On the whole profile" not in text, "what no rock flew through is told", text)
    expect_width(text)


def test_table_width():
    """Tables of all shipped scenes and of long names are at most 80 columns wide"""
    for path in sorted((PROFILES / "scenes").glob("*.yaml")):
        for law in ("lumped", "crsp"):
            expect_width(good(*WHOLE, "-n", 200 if FULL else 50, "-s", f"simulation.law={law}", path).out)
    words = "a very long name that says all there is to say about it and then a little more, so that it must be cut "
    text = good(*WHOLE, "-n", 50, FOUR, "-s", f"title={words * 2}", "-s", f"options[0].name={words * 2}", "-s",
                f"controls[0].name={words}", "-s", f"options[1].forest[0].stand.name={words}", "-s",
                "simulation.threshold_m=12.345").out
    expect_width(text)


def test_table_width_survey():
    """Table in survey coordinates is at most 80 columns wide"""
    far = scene(slope={"vertices_m": [[480000, 64], [480100, 0]], "segments": [{"rn": 0.3, "rt": 0.8}]},
                release={"vx_m_s": 1}, controls=[{"x_m": 480075.125, "accepted_kJ": 20, "name": "road"}],
                forest=[{"from_m": 480010.125, "to_m": 480070.375, "stand": stand(name="an old coppice of hornbeam")}])
    with Folder() as f:
        expect_width(good(*WHOLE, f.write("far.yaml", far)).out)


def test_table_widest():
    """Table: words longer than a line, wide characters and huge numbers keep its 80 columns"""
    wide, word = "一二三四五六七八九十" * 8, "x" * 300
    text = good(*WHOLE, "-n", 20, "-s", f"title={word}", "-s", f"options[0].name={wide}", "-s", "controls[0].x_m=134.123456789",
                "-s", "controls[0].accepted_kJ=123456", "-s", "rock={diameter_m: 20}", FOUR).out
    expect(max(map(columns, text.splitlines())) <= 80, *(line for line in text.splitlines() if columns(line) > 80))
    flat = "".join(text.split())
    expect(word in flat and wide in flat, "cut short:", text)
    for table in parse_arrivals(text):
        expect(all(re.match(r"\d{7}±\d+$", rows["mean energy of those that arrive, kJ"]) for rows in table.values()), "mean energies", table)
    head, *table = text.split("Side by side")[1].splitlines()[2:]
    names = [name for name in (wide[:9], "large reserves") if not any(name in row for row in table)]
    expect(not names, "rows of", names, head, *table)
    expect(len({columns(row) for row in table if re.search(r"% [✔✘]$", row)}) == 1, "columns that do not align", *table)
    expect_in("> 123456 kJ", head, "limit")


def test_table_small():
    """Table: small figures follow a blank and are not cut"""
    slope = {"vertices_m": [[0, 0], [100, -60]], "segments": [{"rn": 0.05, "rt": 0.95, "roughness_rad": 0.1, "friction": 0.1}]}
    with Folder() as f:
        path = f.write("s.yaml", scene(slope=slope, release={"vx_m_s": 2}, controls=[{"x_m": x} for x in (2, 20, 90)]))
        for diameter in (1, 0.1, 0.03, 0.01, 0.003, 0.001, 1e-4):
            orders = ["-n", 60, "-s", f"rock.diameter_m={diameter}", path]
            controls = [c["bare"] for c in result(*orders)["options"][0]["controls"]]
            found = [table["bare"] for table in parse_arrivals(good(*WHOLE, *orders).out)]
            expect_equal(len(found), len(controls), "tables")
            for rows, a in zip(found, controls):
                cells = [rows[name].split()[0] for name in ("95 % stay below, kJ", "mean speed of those that arrive, m/s")]
                expect("…" not in "".join(rows.values()), f"diameter {diameter}: {rows}")
                for cell, value in zip(cells, (a["energy_kJ"]["p95"], a["speed_m_s"]["mean"])):
                    shown, _, power = cell.partition("e")
                    place = 10.0 ** (int(power or 0) - len(shown.partition(".")[2]))
                    expect_near(float(cell), value, 0.51 * place, f"diameter {diameter}: {cells}")


def test_table_one_rock():
    """Table: one rock has no error, for any weight and comparison"""
    for rock in ("{diameter_m: 0.5}", "{diameter_m: 20}", "{diameter_m: 500}", "{diameter_m: 0.001}"):
        text = good(*WHOLE, "-n", 1, "-s", f"rock={rock}", FOUR).out
        expect(not re.search(r"\bnan\b", text), re.findall(".*nan.*", text))
        means = [rows.get("mean energy of those that arrive, kJ", "-") for table in parse_arrivals(text) for rows in table.values()]
        expect(means and not any("(" in cell for cell in means), means)


def test_table_width_short():
    """Table of a slope of a millimetre is at most 80 columns wide"""
    with Folder() as f:
        path = f.write("short.yaml", scene(slope={"vertices_m": [[0, 0], [0.007693, -0.005387]],
                                                  "segments": [{"rn": 0.3, "rt": 0.8}]}, controls=[{"x_m": 0.001}]))
        expect_width(good(*WHOLE, "-n", 5, path).out)


def test_table_splinter():
    """Table: a rock with almost no volume has no other sizes, but the rest of its page"""
    with Folder() as f:
        path = f.write("s.yaml", scene(rock={"shape": "ellipsoid", "axes_m": [1e-320, 1, 1], "mass_kg": 50}))
        text = good(*WHOLE, "-n", 5, path).out
        expect_in("without forest", text)
        expect("Blocks of other sizes" not in text, text)


def test_table_warnings_once():
    """Table: warnings common to the belts of one stand appear once per option"""
    text = good(*WHOLE, "-n", 10, "staggered").out
    warnings = re.findall(r"^    ! .*(?:\n      .*)*", text, re.M)
    options = text.count("Contact: ")
    expect(0 < len(warnings) <= options, f"{len(warnings)} warnings of {options} options", *warnings)


def test_table_lights():
    """Table: every light with its reason: no forest, a gap, a thin belt, no accepted energy, the index"""
    def said(*arguments, scene_mapping=None, where=-1):
        with Folder() as f:
            text = good(*WHOLE, f.write("s.yaml", scene_mapping or wooded_scene()), *arguments).out
            flat_text = re.sub(r"\s+", " ", text)
            return {name: re.findall(rf"\b{name}: (.*?\.) (?=Free run:|Energy:|With the energy law|Percentiles of |At |By the index|\w+ by \w+; other forms)", flat_text)[where]
                    for name in ("Contact", "Free run", "Energy")}
    lights = said()
    expect(re.fullmatch(r"passes\. Every belt has an ADC below 30 m \([\d.]+ m at most\) and no gap is longer\."
                        r" Stems below 3 cm do not count\. It fails if only stems from 8 cm on count: 100 m\.",
                        lights["Contact"]), lights)
    expect(re.fullmatch(r"passes\. Chance of 30 m without a contact at worst [\d.]+ % \(10 % is allowed\)\."
                        r" It fails if only stems from 8 cm on count: 74\.1 %\.",
                        lights["Free run"]), lights)
    expect(re.fullmatch(r"FAILS\. \d+ \(\d+–\d+\) of 1000 arrive with more than 60 kJ \(50 are allowed\)\.",
                        lights["Energy"]), lights)
    lights = said("-s", "controls[1].accepted_kJ=1000")
    expect(re.fullmatch(r"passes\. 0 \(0–\d+\) of 1000 arrive with more than 1000 kJ \(50 are allowed\)\."
                        r" The slope meets the limit even without forest\.", lights["Energy"]),
           lights)
    expect(re.match(r"unknown\. No accepted energy is set \(accepted_kJ\)", said(where=0)["Energy"]), "no accepted_kJ")
    expect(re.match(r"unknown\. With contact_model: index no rocks are simulated through the forest", said(*through("index"))["Energy"]), "index")
    lights = said("-s", "forest=[]")
    expect(re.match(r"FAILS\. No stem stands", lights["Contact"]) and re.match(r"FAILS\. No stem", lights["Free run"]), lights)
    expect(lights["Energy"].startswith("FAILS. "), "the energy light where no forest is", lights)
    lights = said("-s", "forest[0].from_m=50")
    for light in ("Contact", "Free run"):
        expect(re.match(r"FAILS\. A gap of 50 m has no forest; .* 30 m", lights[light]), lights)
    lights = said(scene_mapping=wooded_scene(forest=[{"from_m": 0, "to_m": 105, "stand": {**THICK, "trees": [
        {**THICK["trees"][0], "per_ha": 60}]}}]))
    expect(re.match(r"FAILS\. A belt has an ADC of 145 m; .* 30 m", lights["Contact"]), lights)
    expect(re.match(r"FAILS\. Chance of 30 m without a contact at worst 81\.3 % \(10 % is allowed\)", lights["Free run"]), lights)


def test_table_close_call():
    """The energy light is called close if its interval contains 50 in 1000, in the table, in JSON and in CSV; otherwise not"""
    with Folder() as f:
        path = f.write("s.yaml", wooded_scene(controls=[{"x_m": 105, "accepted_kJ": 60}]))
        energies = result(path)["options"][0]["controls"][0]["wooded"]
        seen = set()
        for accepted in (10, energies["energy_kJ"]["p95"], 1.1 * energies["energy_kJ"]["max"]):
            change = ("-s", f"controls[0].accepted_kJ={accepted}")
            run = result(path, *change)
            wooded = run["options"][0]["controls"][0]["wooded"]
            close = wooded["exceed_lo"] <= 0.05 < wooded["exceed_hi"]
            seen.add(close)
            expect_run(run)
            expect_equal(sum("too close to the limit" in w for w in run["warnings"]), close, run["warnings"])
            if close:
                warning = next(w for w in run["warnings"] if "too close to the limit" in w)
                expect("105 m" in warning and "50 of 1000" in warning, "place and limit", warning)
            expect_equal("too close to the limit" in re.sub(r"\s+", " ", good(*WHOLE, path, *change).out), close, "table")
            _, rows = read_csv(good("--batch", "-f", "csv", path, *change).out)
            expect_equal("too close to the limit" in rows[0]["warnings"], close, "CSV")
            expect(not result(path, *change, *through("index"))["warnings"], "a close call by the index")
        expect_equal(seen, {True, False}, "close and clear calls")


def test_threshold_along_the_ground():
    """The threshold is in metres of the map: a belt at 45 degrees converts it to its ground, also partly or on level ground"""
    with Folder() as f:
        path = f.write("s.yaml", scene(slope={"vertices_m": [[0, 60], [50, 10], [100, 10]], "segments": [{"rn": 0.35, "rt": 0.85}]},
                                       forest=[belt(0, 40), belt(45, 55), belt(60, 70)], controls=[{"x_m": 80}]))
        for threshold in (30, 20):
            text = re.sub(r"\s+", " ", good(*WHOLE, "-s", f"simulation.threshold_m={threshold}", path).out)
            found = re.findall(r"; (\d+) m on the map are (\d+) m along the ground", text)
            wanted = [round(threshold * x) for x in (math.sqrt(2), (1 + math.sqrt(2)) / 2, 1)]
            expect_equal(found, [(str(threshold), str(x)) for x in wanted], text)
    expect_equal(round(30 * math.sqrt(2)), 42)


def test_table_blocks():
    """Table of other block sizes: ascending by octaves, the scene's own marked and equal to the run; larger ones meet more"""
    for arguments, own in (((), 0.197), ((("-s", "rock.diameter_m=1.2", "-s", "rock.height_m=0.6")), 0.679), (("-s", "rock.diameter_m=0.2", "-s", "rock.height_m=0.2"), 0.00628),
                           (("-s", "rock.diameter_m=3", "-s", "rock.height_m=3"), 21.2)):
        text, run = good(*WHOLE, PAPER, *arguments).out, result(PAPER, *arguments)
        rows = parse_sizes(text)
        expect_equal(sorted(r[1] for r in rows), [r[1] for r in rows], "volumes rise")
        expect_equal([r[1] for r in rows if not r[0]], [v for v in (0.05, 0.2, 1, 5) if not own / 2 < v < own * 2], "volumes")
        mine = next(r for r in rows if r[0])
        option, rock = run["options"][0], run["rock"]
        expect_equal(mine[1], own, "this scene's volume")
        expect_equal(mine[2:4], (float(digits(rock["mass_kg"], 3)), float(digits(rock["mean_diameter_m"], 3))), "mass, diameter")
        expect_equal(mine[4], float(digits(max(s["adc"]["adc_m"] for s in option["stands"]), 3)), "ADC")
        expect_equal(mine[5], float(digits(option["summary"]["contacts"], 3)), "contacts")
        expect_equal(mine[6], share_per_1000("exceed", option["controls"][0]["wooded"]), "share")
        for a, b in zip(rows, rows[1:]):
            expect(a[4] >= b[4] and a[5] <= b[5], "a larger block meets more", a, b)
        shares = [[int(n) for n in re.findall(r"\d+", r[6])] for r in rows]  # each with its interval: their numbers differ
        expect(all(a[1] <= b[2] for a, b in zip(shares, shares[1:])) and shares[-1][1] > shares[0][2],
               "a larger block carries more", shares)


def test_table_bounded():
    """A page's additions are limited: years with at most a run's rocks, no sizes that meet all stems"""
    slope = {"vertices_m": [[0, 2100], [3000, 0]], "segments": [{"rn": 0.35, "rt": 0.875, "roughness_rad": 0.25, "friction": 0.5}]}
    with Folder() as f:
        for dbh, thick, rocks in ((0.02, 1e-4, 50), (0.02, 1e-4, 500), (0.035, 1e-6, 500)):
            shrubs = belt(10, 2600, shoots=[{"per_ha": 100000, "dbh_m": dbh, "height_m": 4, "volume_m3": 0.001}], trees=[],
                          stools={"per_ha": 20000, "spacing_m": 0.1})
            path = f.write("s.yaml", scene(rock={"shape": "cylinder", "diameter_m": 1, "height_m": thick}, forest=[shrubs],
                                           controls=[{"x_m": 2700}], slope=slope))
            text = good(*WHOLE, "-n", rocks, path).out
            own = result(path, "-n", rocks)["options"][0]["summary"]["contacts"]
            largest = re.search(r"\n +5\.00 +13000 .* (\d+) +(\S+)\n", text)
            expect_equal(largest and largest[2], "-", text)
            expect(thick > 1e-6 or float(largest[1]) > 100 * own > 0, "hundreds of times the stems", text)
            expect_in("A size with a dash was skipped: its rocks meet too many stems", " ".join(text.split()))
        page = " ".join(good(*WHOLE, "-n", 50, "rotation").out.split())
        expect_in("over years (50 each)", page)  # as many as in a run, at most 1000
        page = " ".join(good(*WHOLE, "-n", 5, "rotation").out.split())
        expect_in("over years (5 each)", page)


def test_table_blocks_cases():
    """Table of blocks: for each option, without forest, without an accepted energy, by the index"""
    with Folder() as f:
        path = f.write("s.yaml", treated(thick=THICK, none=None))
        run, text = result(path), good(*WHOLE, path).out
        for option in run["options"]:
            rows = parse_sizes(section(text, option["name"]))
            expect_equal(sum(r[0] for r in rows), 1, option["name"])
            mine = next(r for r in rows if r[0])
            expect_equal(mine[6], share_per_1000("exceed", option["controls"][1]["wooded"]), option["name"])
        expect(all(r[4] == math.inf and r[5] == 0 for r in parse_sizes(section(text, "none"))), text)
        text = good(*WHOLE, path, *through("index")).out
        expect(all(r[6] == "-" for r in parse_sizes(section(text, "thick"))), "a share by the index", text)
        path = f.write("s.yaml", wooded_scene(controls=[{"x_m": 105}]))
        text = good(*WHOLE, path).out
        expect_in("arrive", text[text.index("Blocks of"):], "head")
        mine = next(r for r in parse_sizes(text) if r[0])
        expect_equal(mine[6], share_per_1000("reach", result(path)["options"][0]["controls"][0]["wooded"]), "that arrive")


def test_table_arrivals():
    """Table of arrivals: for any figures each cell is complete and separate; sign and size survive"""
    cases = [scene(forest=[{"from_m": 0, "to_m": 75, "stand": THIN}], controls=[{"x_m": 40}, {"x_m": 75, "accepted_kJ": 0.1}]),
             wooded_scene(rock={"diameter_m": 8}), wooded_scene(rock={"diameter_m": 0.05}),
             wooded_scene(controls=[{"x_m": 105, "accepted_kJ": 123456.789}]), wooded_scene(simulation={"rocks": 1}),
             wooded_scene(simulation={"rocks": 3}), wooded_scene(simulation={"law": "crsp"})]
    with Folder() as f:
        for mapping in cases:
            path = f.write("s.yaml", mapping)
            run, text = result(path), good(*WHOLE, path).out
            expect_option(text, run["options"][0])
            expect_width(text)
            expect(len(parse_sizes(text)) in (4, 5), "blocks of other sizes", text)


def test_table_left():
    """The printed Eq. 5 is exact: equal decimals, zero minus nothing"""
    for arguments in ((PAPER,), ("-s", "forest[0].stand.shoots=[]", PAPER), ("tschamut",), ("vaujany",)):
        text = " ".join(good(*WHOLE, "-n", 200, *arguments).out.split())
        found = re.findall(r"stems could absorb (\S+) kJ \(Eq\. 4\), \S+ kJ per 100 m; of (\S+) kJ "
                           r"(?:(\S+) kJ are left|nothing is left on average, some rocks still pass) \(Eq\. 5\)\.", text)
        expect(found or "stems could absorb" not in text, text)
        expect(arguments != (PAPER,) or all(words[2] for words in found), "something is left on the paper's site", text)
        for words in found:
            taken, mean = map(float, words[:2])
            left = float(words[2] or 0)
            unit = 10.0 ** -len(words[1].partition(".")[2])
            expect(taken > 0 and len({len(w.partition(".")[2]) for w in words if w}) == 1, words)
            expect_near(max(0, mean - taken), left, 1.01 * unit, words)


def test_table_verdicts():
    """Table gives failed tests and exhausted energy in words, never 0 kJ left"""
    text = good(*WHOLE, PAPER, "-s", "forest[0].to_m=30", "-s", "forest[1].from_m=90").out
    expect_order(text, "Contact: FAILS", "(?i)gap", "60 m")
    for model in MODELS:
        text = good(*WHOLE, PAPER, "-s", "forest[0].stand.shoots[0].volume_m3=1", *through(model)).out
        text = " ".join(text.split())
        expect_in("nothing is left on average, some rocks still pass (Eq. 5)", text)
        expect(not re.search(r" 0(\.0*)? kJ are left", text), text)


def test_table_assumed():
    """Table marks exactly the assumed values"""
    with Folder() as f:
        plain = scene(controls=[{"x_m": 75, "accepted_kJ": 50}], rock={"diameter_m": 0.5, "density_kg_m3": 2600})
        text = good(*WHOLE, f.write("plain.yaml", plain)).out
        expect("*" not in text and "ssumed" not in text, text)
        note = {"kind": "assumed", "text": "guessed by eye"}
        marked = scene(rock={"diameter_m": 0.5, "source": note}, controls=[{"x_m": 75, "accepted_kJ": 50, "source": note}],
                       forest=[{"from_m": 10, "to_m": 60, "stand": stand(source=note)}])
        text = good(*WHOLE, f.write("marked.yaml", marked)).out
        expect_order(text, r"Rock[^*]*m\*", r"coppice\*", r"50 kJ\*", r"\* Assumed", "guessed by eye")


def test_table_changed():
    """A value changed by -s loses its outer source in the list; this changes no figure"""
    note = {"kind": "assumed", "text": "all a guess"}
    with Folder() as f:
        path = f.write("s.yaml", scene(controls=[{"x_m": 75, "accepted_kJ": 50, "source": note}, {"x_m": 80, "source": note}]))
        for change, said in (("accepted_kJ=60", "; changed since: accepted_kJ"), ("accepted_kJ=50", ""), ("name=road", ""),
                             ("source={kind: assumed}", "")):
            text = " ".join(good("--batch", "--details", path, "-s", f"controls[0].{change}").out.split())
            expect(any(f"all a guess{said} (control {n}{end}" in text for n in (1, 2) for end in (")", " and ")), change, text)
        for change, star in (("x_m=70", "50 kJ*"), ("accepted_kJ=50", "50 kJ*"), ("accepted_kJ=60", "60 kJ,")):
            expect_in(f"limit {star}", good("--batch", "--details", path, "-s", f"controls[0].{change}").out, "its star")
        twice = good("--batch", "--details", path, "-s", "controls[0].accepted_kJ=60", "-s", "controls[0].x_m=70", "-s", "controls[0].x_m=71")
        expect_in("all a guess; changed since: accepted_kJ, x_m (control 1)", " ".join(twice.out.split()))
        whole = good("--batch", "--details", path, "-s", "controls=[{x_m: 75, accepted_kJ: 60}]").out
        expect("guess" not in whole, whole)
        plain = f.write("plain.yaml", scene(controls=[{"x_m": 75, "accepted_kJ": 60}, {"x_m": 80}]))
        expect_equal(result(path, "-s", "controls[0].accepted_kJ=60")["options"], result(plain)["options"], "figures")
        # only the innermost source is reported; in a list the whole one; settings have no source
        path = f.write("s.yaml", scene(source={"kind": "assumed", "text": "outer"}, forest=[
            {"from_m": 10, "to_m": 60, "source": {"kind": "assumed", "text": "belt"}, "stand": stand(source=note)}]))
        text = " ".join(good("--batch", "--details", path, "-s", "forest[0].stand.stools.per_ha=1000", "-s",
                             "forest[0].stand.trees[0].per_ha=9", "--seed", 5, "-s", "controls[0].x_m=70").out.split())
        for words in ("outer; changed since: controls (the scene)", "belt (belt 1)",
                      "all a guess; changed since: stools.per_ha, trees (stand, belt 1)"):
            expect_in(words, text)


def test_table_talus():
    """A bare CSV slope uses talus and reports the assumption"""
    with Folder() as f:
        f.write("line.csv", "distance,elevation\n0,64\n50,30\n100,0\n")
        path = f.write("csv.yaml", scene(slope="line.csv"))
        expect_in("talus is assumed", good(*WHOLE, path).out.replace("\n", " "), "table")
        expect_in("talus", result(path)["warnings"][0], "JSON warnings")
        mapping = f.write("map.yaml", scene(slope={"csv": "line.csv", "materials": [
            {"from_m": 0, "to_m": 100, "material": "talus"}]}))
        run, other = result(path), result(mapping)
        expect_equal(other["warnings"], [])
        expect_equal(run["options"], other["options"], "talus")


if __name__ == "__main__":
    run_all(__name__)
