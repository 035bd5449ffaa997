#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: slow threads
"""The years between two cuts in the terminal program (view 6) and as a picture, and the search key."""
import re
import sys
import unicodedata
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import play  # noqa: E402
from play import check_good  # noqa: E402
from pages import digits  # noqa: E402
from harness import (PROFILES, USAGE, Folder, ceduo, expect, expect_equal, expect_in, good, result,  # noqa: E402
                     run_all)

MARKS = {"✔": "pass", "✘": "fail", "?": "unknown"}
WOOD = """\
ceduo: scene/1
title: years
rock: {shape: sphere, diameter_m: 0.68}
release: {vx_m_s: 1}
slope:
  vertices_m: [[0, 40], [20, 20], [45, 0]]
  segments: [{rn: 0.3, rt: 0.85, roughness_rad: 0.15, friction: 0.5}]
controls:
  - {x_m: 40, name: road, accepted_kJ: 5}
forest:
  - from_m: 2
    to_m: 38
    cut_year: 3   # kept
    stand:
      name: wood
      species: ostrya-carpinifolia
      stools: {per_ha: 300, spacing_m: 0.4}
      shoots: [{per_ha: 900, dbh_m: 0.06, height_m: 7}]
      trees: [{per_ha: 60, dbh_m: 0.2, height_m: 12}]
      energy: {model: brauner, u_J_m3: 100000, offset: whole}
      growth:
        shoots: {dbh_most_m: 0.16, dbh_rate_1_y: 0.022, height_most_m: 14, height_rate_1_y: 0.035}
        trees: {dbh_most_m: 0.45, dbh_rate_1_y: 0.014, height_most_m: 20, height_rate_1_y: 0.03}
        shoots_young: 16
        shoots_old: 3
      cutting: {rotation_years: 8, stay_per_ha: [30, 30]}
rocks_per_year: 2
years: {first: 0, last: 12}
simulation: {rocks: 1000, contact_model: stems}
"""
ROTATION = WOOD.replace("years: {first: 0, last: 12}\n", "")  # the default years
INDEX = WOOD.replace("contact_model: stems", "contact_model: index")
# 60 reserves of 20 cm only, and another treatment
RESERVES = WOOD[:WOOD.index("forest:")] + """\
options:
  - name: reserves
    forest:
      - from_m: 2
        to_m: 38
        stand: {name: few, species: ostrya-carpinifolia, trees: [{per_ha: 60, dbh_m: 0.2, height_m: 12}]}
  - name: more
    forest:
      - from_m: 2
        to_m: 38
        cut_year: 5
        stand:
          name: many
          species: ostrya-carpinifolia
          trees: [{per_ha: 500, dbh_m: 0.2, height_m: 12, age_y: 40}]
          growth: {trees: {dbh_most_m: 0.45, dbh_rate_1_y: 0.014, height_most_m: 20, height_rate_1_y: 0.03},
                   shoots_young: 16, shoots_old: 3}
          cutting: {rotation_years: 20, stay_per_ha: [100]}
years: {first: 0, last: 26}
simulation: {rocks: 1000, contact_model: index}
"""


class Place(Folder):
    """A folder with the scenes."""

    def __enter__(self):
        super().__enter__()
        for name, text in (("wood", WOOD), ("index", INDEX), ("reserves", RESERVES), ("rotation", ROTATION)):
            self.write(f"{name}.yaml", text)
        return self

    def play(self, script, scene="index.yaml", **options):
        return play.play(self.path, script, scene, **options)

    def years(self, scene, last):
        """Return the first option's years from the batch."""
        return result("--years", f"0:{last}", "-n", play.ROCKS, self.path / scene)["options"][0]


def shown(script, scene="index.yaml", **options):
    with Place() as place:
        return place.play(script, scene, **options)


def marks(screen, light, signs="✔✘?"):
    """Return columns and signs of a row of lights."""
    for line in screen.body.split("\n"):
        if re.match(f"{light} ", line):
            return [(i, c) for i, c in enumerate(line) if i > 0 and c in signs]
    expect(False, f"no row '{light}' in the", screen)


def columns_of_cuts(screen, sign="▼"):
    return [i for i, c in enumerate(screen.body.split("\n")[0]) if c == sign]


def flat(screen):
    return re.sub(r"\s+", " ", screen.body)


def year_said(screen):
    """Return (year, cut, ADC) of the year under the cursor, in the column on the right."""
    found = re.search(r"^Year (\d+)(, just cut)?$.*?^ADC m +([\d.]+)", screen.now, re.M | re.S)
    expect(found, "no year in the column of the", screen)
    return int(found.group(1)), bool(found.group(2)), found.group(3)


def strips(screen):
    """Return the visible ones of the two strips, by their captions."""
    lines = screen.body.split("\n")
    return [any(part in line for line in lines) for part in ("ADC of the worst belt, m", "of 1000 released with")]


# ---- the view ----


def test_strips():
    """View 6: both strips if they fit, otherwise one; cuts, lights, words and form in their places"""
    script = ["wait idle", "key 6", "wait idle"]
    sizes = [(80, 24), (200, 50), (60, 20), (120, 40)]
    for width, height in sizes:
        script += [f"resize {width} {height}", "dump", "key Tab", "dump", "key Tab"]
    with Place() as place:
        screens = place.play("\n".join(script), "wood.yaml")
        option = place.years("wood.yaml", 12)
    fails = {k: sum(y["controls"][0]["lights"][n] == "fail" for y in option["years"])
             for k, n in zip("CFE", ("contact", "free_run", "energy"))}
    expect(0 < fails["C"] < 13 and fails["F"] > 0, "the scene tells nothing", fails)
    for i, (width, height) in enumerate(sizes):
        form, alone = screens[2 * i:2 * i + 2]
        for screen in (form, alone):
            screen.whole()
            expect_in("6 rotation", screen.title, "title")
        expect_equal(strips(alone)[0], height > 24, f"{width}x{height}: the strip of the ADC in the picture alone")
        expect("of 1000 released with" in alone.body, f"{width}x{height}: the strip of the rocks", alone)
        expect(re.search(r"^ +fro", form.body, re.M), f"{width}x{height}: form", form)
        expect(not re.search(r"^ +fro", alone.body, re.M), "the form beside the picture alone", alone)
        for screen in [alone] + [form] * (height > 20):
            expect_in("years", screen.body, "axis")
            expect(len(columns_of_cuts(screen)) == 2 and "▼cut" in screen.body, "two cuts", screen)
        for screen in [alone] + [form] * (height > 24):
            for light in "CFE":
                expect_equal(sum(c == "✘" for _, c in marks(screen, light)), fails[light], f"{width}x{height} {light}")
        expect_in(f"Years that fail: energy {fails['E']}, contact {fails['C']}, free run {fails['F']} of 13.", flat(alone))
    expect_equal(strips(screens[0]), [False, True], "80x24 with the form: one strip")
    expect_equal(strips(screens[2]), [True, True], "200x50 with the form: both")
    expect_in(" …", flat(screens[0]), "80x24: a sign of more in the place of what is said of the year")
    lines = [line.strip() for line in screens[0].body.split("\n") if line.strip()]
    fields = lines[next(i for i, line in enumerate(lines) if line.startswith("from, m")):]
    expect(len(fields) >= 8 and any(line.startswith("trees kept") for line in fields[:5]),
           "80x24: eight lines of the form, what stays after a cut among the first", screens[0])
    expect("…" not in flat(screens[3]) and "2–38 m: " in flat(screens[1]), "words without room", screens[1], screens[3])


def test_window():
    """View 6 shows at least 20 coming years, from the next one on; they are fields, and the column follows the year"""
    screens = shown("""wait idle
        resize 200 50
        key 6
        wait idle
        dump
        key Tab l l
        dump
        key Tab
        find last year shown
        set 4
        find first year shown
        set 2
        wait idle
        dump
        key u u
        wait idle
        dump""", "rotation.yaml")
    with Place() as place:
        option = result("--years", "-n", play.ROCKS, place.path / "rotation.yaml")["options"][0]
    expect_equal([y["year"] for y in option["years"]], list(range(1, 21)), "the years of --years: the rotation has 8")
    for screen, count in zip(screens, (20, 20, 3, 20)):
        expect_equal(len(marks(screen, "C")), count, "years")
    expect_in("Years 1 to 20: mean", flat(screens[0]))
    expect_in("Years 2 to 4: mean", flat(screens[2]))
    expect_equal(len(columns_of_cuts(screens[0])), 3, "cuts in years 3, 11 and 19")
    for screen, year in ((screens[0], option["years"][0]), (screens[1], option["years"][2])):
        wooded = year["controls"][0]["wooded"]
        expect(re.search(rf"^Year {year['year']}(, just cut)?$", screen.now, re.M), f"the year in the column {year['year']}", screen)
        expect_equal(screen.pair("arrive")[0], round(1000 * wooded["reach_probability"]), "what arrives in that year")
        expect_equal(screen.pair("stems stop")[0], round(1000 * wooded["missed"]["stopped_by_stems"]), "what stems stop in it")
    felled = option["yield"]["cuts"][0]
    expect_equal(felled["year"], 3, "the first cut")
    expect_in(f"Felled: {felled['volume_m3_ha']:.0f} m³ per ha, {felled['stems_per_ha']:.0f} stems.", flat(screens[1]))


def test_thin_shoots():
    """Young shoots affect no light; later thin ones pass contact alone: from 8 cm on it fails, and both are reported"""
    screens = shown("wait idle\nresize 120 40\nkey 6\nwait idle\nkey Tab l l l l l l l l l l l\ndump\nresize 80 24\ndump", "rotation")
    option = result("--years", "-n", 100, "rotation")["options"][0]
    year, just_cut = option["years"][11], option["years"][1]
    expect_equal([just_cut["controls"][0]["lights"][k] for k in ("contact", "free_run")], ["fail", "fail"], "shoots of a year")
    expect_equal((option["rotation"]["unprotected_contact"], option["rotation"]["unprotected_contact_8cm"]), (10, 25))
    expect_in("If only stems from 8 cm on count: contact 25, free run 25.", flat(screens[0]))
    expect_equal([year["controls"][0]["lights"][k] for k in ("contact", "contact_8cm")], ["pass", "fail"], "the scene tells nothing")
    expect_equal(screens[0].lights()["Contact"], "passes")
    counted = result("-s", "simulation.contact_dbh_m=0.08", "--years", "-n", 100, "rotation")["options"][0]["years"][2]
    lights = counted["controls"][0]["lights"]
    expect_equal((lights["contact"], lights["free_run"]), ("fail", "fail"), "only stems from contact_dbh_m on count")
    paper = [result("-s", f"simulation.contact_dbh_m={d}", "-n", 10, "paper-site")["options"][0]["stands"][0] for d in (0, 0.03, 0.08)]
    expect_equal([(p["adc"]["adc_m"] and round(p["adc"]["adc_m"], 3), p["passes_threshold"]) for p in paper],
                 [(1.948, True), (1.948, True), (None, False)], "the paper's figure stays where its stems of 6 cm count")


def test_small_window():
    """View 6 at 60 x 20 shows its picture next to the form, not only alone"""
    screen = shown("wait idle\nkey 6\nwait idle\nresize 60 20\ndump")[0]
    expect("too narrow" not in screen.body, "no picture in the", screen)


def test_no_stems():
    """Without stems view 6 reports it instead of a distance between hits, as view 4 does for a belt; 100 % has no decimals"""
    with Place() as place:
        place.write("bare.yaml", INDEX[:INDEX.index("forest:")] + "forest: [{from_m: 2, to_m: 38, stand: {system: bare}}]\n")
        years, belts = place.play("wait idle\nkey 6\nwait idle\nresize 80 24\nkey Tab\ndump\nkey Tab 4\ndump",
                                  "bare.yaml")
    expect_in("m: no stems.", flat(years))
    expect(re.search(r"bare +2–38 +none", belts.body), belts)
    expect(re.search(r"^free run % +100\.0 +≤ 10 ✘$", years.now, re.M), years)


def test_figures():
    """View 6 equals --years: lights year by year, cuts below their mark, the years together"""
    with Place() as place:
        screens = place.play("wait idle\nkey 6\nwait idle\nresize 200 50\nkey Tab\ndump\nkey l l l\ndump", "wood.yaml")
        option = place.years("wood.yaml", 12)
    years, rotation = option["years"], option["rotation"]
    for light, name in zip("CFE", ("contact", "free_run", "energy")):
        found = [MARKS[c] for _, c in marks(screens[0], light)]
        expect_equal(found, [y["controls"][0]["lights"][name] for y in years], name)
    at = [column for column, _ in marks(screens[0], "C")]
    expect_equal([at.index(c) for c in columns_of_cuts(screens[0])], [y["year"] for y in years if y["cut"]], "cuts")
    text = flat(screens[0])
    expect_in(f"worst {1000 * max(y['controls'][0]['wooded']['exceed_probability'] for y in years):.0f} "
              f"(year {rotation['worst_year']}).", text)
    expect_in(f"Yield {option['yield']['cut_m3_ha_per_year']:.2g} m³ per ha and year.", text)
    expect_in(f"mean {1000 * rotation['exceed_probability']['mean']:.0f} ±", text)
    expect_in(f"Expected per year: {digits(rotation['reach_per_year'], 2)} rocks pass, {digits(rotation['exceed_per_year'], 2)} with too much",
              text)
    for screen, year in ((screens[0], years[0]), (screens[1], years[3])):
        number, cut, adc = year_said(screen)
        stand, wooded = year["stands"][0], year["controls"][0]["wooded"]
        expect_equal((number, cut), (year["year"], year["cut"]))
        expect_equal(adc, f"{stand['adc']['adc_m']:.3g}", "ADC")
        expect_equal(screen.pair("above 5 kJ")[0], round(1000 * wooded["exceed_probability"]), "of 1000 with too much")
        expect_in("2–38 m: " + (f"{stand['stools_per_ha']:.0f} stools" if stand["stools_per_ha"] else "30 trees of"),
                  flat(screen), "the stems")


def test_cursor():
    """After Tab, left and right change the year, Home and End go to the first and the last"""
    keys = ["", "l", "Right", "Right", "h", "End", "l", "Left", "Home", "Left", "G", "g"]
    years = [0, 1, 2, 3, 2, 12, 12, 11, 0, 0, 12, 0]
    script = ["wait idle", "key 6", "wait idle", "resize 120 40", "key Tab"]
    for key in keys:
        script += [f"key {key}"] * bool(key) + ["dump"]
    script += ["key l l", "key Tab", "dump", "key l l", "dump", "key Tab", "dump"]
    screens = shown("\n".join(script))
    for key, year, screen in zip(keys, years, screens):
        expect_equal(year_said(screen)[:2], (year, year in (3, 11)), f"after {key or 'Tab'}")
    said = [year_said(s)[0] for s in screens[len(keys):]]
    expect_equal(said, [2, 2, 2], "in the form left and right are the form's")
    expect_in("left, right: another year", screens[0].note)
    lines = [len({y for y, line in enumerate(s.body.split("\n")) if "⠅" in line or "⠨" in line}) for s in screens[:4]]
    expect(all(n > 3 for n in lines), "no line at the year in the picture", lines, screens[0])


def test_edits():
    """cut_year and rotation_years move the cuts and the picture at once; u undoes it, s saves it with its comments"""
    with Place() as place:
        screens = place.play("""wait idle
            resize 200 50
            key 6
            wait idle
            dump
            find from_m
            key l l
            set 5
            wait idle
            dump
            find rotation_years
            set 3
            wait idle
            dump
            key u
            wait idle
            dump
            key u
            wait idle
            dump
            key Ctrl-R Ctrl-R
            wait idle
            key s
            dump""")
        text = (place.path / "index.yaml").read_text()
        check_good(place.path, "index.yaml")
    cuts, years = [], []
    for screen in screens[:5]:
        at = [column for column, _ in marks(screen, "C")]
        cuts.append([at.index(c) for c in columns_of_cuts(screen)])
        years.append(len(at))
    expect_equal(cuts, [[3, 11], [5], [5, 8, 11], [5], [3, 11]], "cuts")
    expect_equal(years, [13] * 5, "years")
    expect_equal(screens[0].body.split("\n")[:20], screens[4].body.split("\n")[:20], "the picture after two undos")
    expect("cut_year: 5   # kept\n" in text and "rotation_years: 3" in text, text)


def test_edit_stay():
    """Trees retained after a cut are a list of numbers in the form; more trees make the year of the cut better"""
    screens = shown("""wait idle
        resize 200 50
        key 6
        wait idle
        key Tab
        key l l l
        dump
        key Tab
        find stay_per_ha
        set [300, 200]
        wait idle
        dump""")
    expect_equal((year_said(screens[0]), marks(screens[0], "C")[3][1]), ((3, True, "223"), "✘"))
    number, cut, adc = year_said(screens[1])
    expect(number == 3 and cut and float(adc) < 30 and marks(screens[1], "C")[3][1] == "✔", screens[1])
    expect_in("300 trees of 5 cm", flat(screens[1]))


def test_live_rate():
    """rocks_per_year is live: the expected number per year follows the edit"""
    screens = shown("""wait idle
        resize 200 50
        key 6
        wait idle
        dump
        find rocks_per_year
        set 200
        wait idle
        dump""", "wood.yaml")
    passes = [float(re.search(r"Expected per year: (\S+) rocks pass", flat(s)).group(1)) for s in screens]
    expect(abs(passes[1] - 100 * passes[0]) <= 0.06 * passes[1], f"{passes}: 100 times the rocks")


def test_live_threshold():
    """Undoing a threshold changes the lights of the years at once"""
    screens = shown("""wait idle
        resize 200 50
        key 3
        find threshold_m
        set 300
        key 6
        wait idle
        dump
        key u
        wait idle
        dump""")
    found = [[c for _, c in marks(s, "C")] for s in screens]
    expect_equal([f.count("✘") for f in found], [0, 10], "years without contact at 300 m, at 30 m")


def test_more_controls():
    """Controls added in another view: view 6 has no figures of places that its years lack"""
    with Place() as place:
        screens = place.play("""wait idle
            key 6
            wait idle
            key 1
            find controls
            key a a a a a a a a
            key 6
            dump
            wait idle
            resize 200 50
            dump""")
    shown_at_once = screens[0].whole()
    rows = [line for line in shown_at_once.body.split("\n") if re.match("[CFE] ", line)]
    expect(not rows or any("✔" in r or "✘" in r for r in rows), "rows of nothing in the", shown_at_once)
    expect_equal(len(marks(screens[1], "C")), 13, "years")


def test_even_marks():
    """The lights of the years are evenly spaced at 80x24 (the picture alone), 120x40 and 200x50"""
    for screen in shown("wait idle\nkey 6\nwait idle\nkey Tab\ndump\nkey Tab\nresize 120 40\ndump\nresize 200 50\ndump", "reserves.yaml"):
        for light in "CFE":
            at = [column for column, _ in marks(screen, light)]
            expect(len(at) > 10 and len({b - a for a, b in zip(at, at[1:])}) == 1, f"columns of {light}: {at}", screen)


def test_search_column():
    """/ with the name of a column puts the cursor on that column's field"""
    screen = shown("key 6\nfind cut_year\ndump")[0]
    expect(screen.note.startswith("cut in year: "), f"the line above the keys: {screen.note!r}")


def test_options():
    """Each option has its years; ] shows the next one's"""
    screens = shown("""wait idle
        resize 200 50
        key 6
        wait idle
        dump
        key ]
        wait idle
        dump
        key [
        wait idle
        dump""", "reserves.yaml")
    expect_equal([len(columns_of_cuts(s)) for s in screens], [0, 2, 0], "cuts")
    expect_equal(screens[0].body, screens[2].body, "back again")
    expect_in("500 trees of 20 cm", flat(screens[1]))
    expect_equal([c for _, c in marks(screens[0], "C")], ["✘"] * 27, "60 reserves in all years")
    screens[1].has("Stand of belt 1: many")


def test_no_forest():
    """Without forest view 6 still works, and its form asks for a belt"""
    with Place() as place:
        place.write("none.yaml", INDEX[:INDEX.index("forest:")] + "forest: []\nsimulation: {rocks: 1000}\n")
        screens = place.play("wait idle\nkey 6\nwait idle\ndump\nkey Tab\nkey l l\ndump\nresize 200 50\ndump", "none.yaml")
    for screen in screens:
        screen.whole()
    expect_equal([c for _, c in marks(screens[2], "C")], ["✘"], "contact")
    expect_in("'current' does not change: it has no stems.", flat(screens[2]))


def test_index_view():
    """With the contact model index the lower strip shows the possible energy of stems, and the energy is unknown"""
    screen = shown("wait idle\nresize 200 50\nkey 6\nwait idle\ndump")[0]
    screen.has("stems could take, kJ per 100 m (Eq. 4)")
    expect_equal({c for _, c in marks(screen, "E")}, {"?"}, "energy")
    screen.lacks("of 1000 released")


def test_charsets():
    """View 6 in blocks and in ASCII"""
    for charset, signs in (("block", "✔✘"), ("ascii", "+x")):
        screen = shown("wait idle\nresize 120 40\nkey 6\nwait idle\nkey Tab\ndump", charset=charset)[0].whole()
        expect(charset != "ascii" or screen.text.isascii(), "not ASCII", screen)
        expect_equal(len(marks(screen, "C", signs)), 13, f"{charset}: lights")
        expect_equal(len(columns_of_cuts(screen, "v" if charset == "ascii" else "▼")), 2, f"{charset}: cuts")


# ---- the search key ----

FIND = """key 2
    find trees[0].per_ha
    key f
    """


def test_find():
    """f on a number finds the value for a goal and sets it: 379 reserves; u undoes it"""
    with Place() as place:
        screens = place.play("wait idle\n" + FIND + """dump
            key Enter Enter Enter Enter Enter
            wait idle
            dump
            key u
            wait idle
            dump
            key Ctrl-R
            key s
            dump""", "reserves.yaml")
        text = (place.path / "reserves.yaml").read_text()
        check_good(place.path, "reserves.yaml")
    popup, found, undone, _ = screens
    for part in ("per hectare, trees 1, belt 1", "mean distance between hits below … m (ADC)", "probability of a free run at most … %",
                 "at most … per 1000 exceed the limit", "at most … per 1000 arrive", "mean energy of arrivals", "u undoes"):
        expect_in(part, popup.popup, "the question")
    expect_equal(re.findall(r"(?:from|to) +(\d+)", popup.popup), ["6", "600"], "the range that is offered")
    expect_equal(found.row(r"^1 +379")[:2], ["1", "379"])
    for part in ("= 379", "smallest value that reaches the goal", "ADC 29.98 m", "below 30 m"):
        expect_in(part, re.sub(r"\s+", " ", found.note), "the answer")
    expect_equal(found.lights()["Contact"], "passes")
    expect_equal(undone.row(r"^1 +60")[:2], ["1", "60"])
    expect_in("undone", undone.note)
    expect_equal(undone.lights()["Contact"], "FAILS")
    expect("per_ha: 379" in text and "per_ha: 500" in text, text)


def test_find_other_goals():
    """f with other goals and ranges, in another option, and with rocks: equal to the command line"""
    with Place() as place:
        for scene, option, goal, lo, hi in (("reserves", "more", "adc=20", 100, 1000), ("reserves", "reserves", "free-run", 1, 3000),
                                            ("wood", None, "exceed=0.4", 10, 5000), ("wood", None, "energy=8", 10, 5000)):
            path = f"options[{option}].forest[0].stand.trees[0].per_ha" if option else "forest[0].stand.trees[0].per_ha"
            wanted = good("--find", f"{path}={lo}:{hi}", "--goal", goal, "-n", 2000, "-f", "json",
                          *(["--option", option] if option else []), place.path / f"{scene}.yaml").json()[0]
            steps = "".join(f"key Ctrl-U\ntype {x}\nkey Enter\n" for x in (goal, "", "", lo, hi))
            screen = place.play("key 2\n" + ("key ]\n" if option == "more" else "") + "find trees[0].per_ha\nkey f\n" + steps + "dump",
                                f"{scene}.yaml")[0]
            expect(wanted["found"], scene, goal, wanted)
            expect_equal(int(screen.row(rf"^1 +{wanted['value']} ")[1]), wanted["value"], f"{scene} {goal}")
            expect_in(f"= {wanted['value']}", screen.note)


def test_find_in_list():
    """f on retained trees: of several numbers it asks for one, by its digit; it finds the command line's value, and shows the
    legal minimum and the scene's; with one number it does not ask"""
    with Place() as place:
        place.write("ruled.yaml", WOOD.replace("rocks_per_year", "rules: marche\nminimum: {reserves_per_ha: 70}\nrocks_per_year"))
        for scene, keys, path, which in (("ruled", "key 2\n", "forest[0].stand.cutting.stay_per_ha[1]", True),
                                         ("reserves", "", "options[more].forest[0].stand.cutting.stay_per_ha[0]", False)):
            goal, lo, hi = ("exceed=0.95", 3, 3000) if which else ("adc=50", 10, 1000)
            wanted = good("--find", f"{path}={lo}:{hi}", "--goal", goal, "-n", 2000, "-f", "json",
                          *([] if which else ["--option", "more"]), place.path / f"{scene}.yaml").json()[0]
            steps = "".join(f"key Ctrl-U\ntype {x}\nkey Enter\n" for x in (goal, "", "", lo, hi))
            asked, popup, screen = place.play("key 6\n" + ("" if which else "key ]\n") + "find stay_per_ha\nkey f\ndump\n" + keys + "dump\n" +
                                              steps + "wait idle\ndump", f"{scene}.yaml")
            asked.has(*(("Which number of the list", "1 30", "2 30") if which else ("Which value reaches a goal?",)))
            if which:
                for words in ("rules of Marche require at least 60 standards per ha (Ministry Decree", "60 are left.", "requires at least 70 per ha"):
                    expect_in(words, popup.popup, "the law")
            expect(wanted["found"] and wanted["over"] == "rotation", scene, wanted)
            values = screen.row("^trees kept")[-2 if which else -1:]
            expect_equal(values, ["30", str(wanted["value"])] if which else [str(wanted["value"])], "the field")
            expect_in(f"= {wanted['value']}", screen.note)


def test_find_sure():
    """f with a number of 100 cases gives the sure value next to the plain one, which the field gets, like --sure: with stems of
    15 to 25 cm those of 16 cm, 10000 / 30 m / (0.68 + 0.16) m; 0, 101 and words are refused, empty asks nothing"""
    uncertainty = "uncertainty:\n  - {path: 'options[0].forest[0].stand.trees[0].dbh_m', lo: 0.15, hi: 0.25}\n"
    for sure, words in (("90", "in 90 % of plausible cases: 397"), ("0", "0 itself is outside"), ("101", "101 is above 100"),
                        ("most", "'most' is not a number"), ("", "")):
        steps = "".join(f"key Ctrl-U\ntype {x}\nkey Enter\n" for x in ("adc", "", sure, 6, 600)[:5 if sure in ("90", "") else 3])
        with Place() as place:
            place.write("unsure.yaml", RESERVES + uncertainty)
            screen, = place.play(FIND + steps + "dump", "unsure.yaml")
        said = re.sub(r"\s+", " ", screen.popup + " " + screen.note)
        expect_in(words, said, f"{sure} of 100")
        expect(("= 379: the smallest value" in said) == (sure in ("90", "")), said)
        expect(("in 90 % of plausible cases: " in said) == (sure == "90"), said)
        expect_equal(screen.row(r"^1 +(60|379)")[1] if "= 379" in said else "379", "379", "the field")


def test_find_nothing():
    """f without a passing value: a message with the nearest, and the field stays"""
    screen = shown(FIND + "key Enter Enter Enter Enter\nkey Ctrl-U\ntype 300\nkey Enter\ndump", "reserves.yaml")[0]
    note = re.sub(r"\s+", " ", screen.note)
    expect("no value from 6 to 300" in note and "nearest: 300" in note, note)
    expect_equal(screen.row(r"^1 +60")[:2], ["1", "60"])


def test_find_all():
    """f with only passing values: a message, and the field stays"""
    for word, value in (("forest[1]", "0.5"), ("forest[0]", "0.5")):
        screen, undone = shown(f"key 2\nfind {word}\nfind spacing_m\nkey f Enter Enter Enter Enter Enter\ndump\nkey u\ndump", "paper-site")
        note = re.sub(r"\s+", " ", screen.note)
        expect_in("every value of the range reaches the goal", note)
        expect_equal(screen.row("^spacing, m")[-1], value, "the field")
        expect("* Test" not in screen.title and "nothing to undo" in undone.note, "something was changed", screen, undone)


def test_find_refused():
    """f: wrong goals and ranges are refused in words, the question stays open, and nothing changes"""
    for goal, lo, hi, words in (("quick", 6, 600, "adc, free-run, energy=KJ, exceed"), ("energy", 6, 600, "how many kJ"),
                                ("adc=x", 6, 600, "adc, free-run, energy=KJ, exceed"), ("adc=-3", 6, 600, "the goal is"),
                                ("adc", "x", 600, "'x' is not a number"), ("adc", 600, 6, "the smaller first"),
                                ("adc", 6, "", "to: required"), ("exceed", 6, 600, "index"), ("exceed=5", 6, 600, "0.05 for 5 %"),
                                ("free-run=2", 6, 600, "0.05 for 5 %")):
        steps = "".join(f"key Ctrl-U\ntype {x}\nkey Enter\n" for x in (goal, "", "", lo, hi)[:4 if lo == "x" else 5])
        with Place() as place:
            open_, closed = place.play(FIND + steps + "dump\nkey Esc Esc Esc Esc Esc\ndump", "reserves.yaml")
            expect_equal((place.path / "reserves.yaml").read_text(), RESERVES, "the file")
        expect_in("Which value reaches a goal?", open_.text, f"{goal} {lo} {hi}: the question is gone")
        expect_in(words, re.sub(r"\s+", " ", open_.popup + " " + open_.note), f"{goal} {lo} {hi}")
        expect_equal(closed.row(r"^1 +60")[:2], ["1", "60"], "the field")
        expect("*" not in closed.title, "something was changed", closed)


def test_find_where():
    """f needs a number under the cursor: on words a message, on a rotation or a length the question"""
    screens = shown("key 2\nfind species\nkey f\ndump\nclear\nkey 6\nfind rotation_years\nkey f\ndump\nkey Esc\n"
                    "find from_m\nkey l l\nkey f\ndump\nkey Esc\nkey 3\nfind diameter_m\nkey f\ndump\nkey Esc\nkey 4\nkey f\ndump")
    expect_in("put the cursor on a number first", screens[0].note)
    for screen, path in zip(screens[1:4], ("rotation, years", "cut in year", "diameter, m")):
        expect_in(path, screen.popup, "the question")
    expect_in("put the cursor on a number first", screens[4].note)


def test_find_invalid():
    """f over invalid values: the reason is reported, the scene stays unchanged"""
    screens = shown(FIND + "key Enter Enter Enter\nkey Ctrl-U\ntype -5\nkey Enter Enter\ndump\nkey Esc Esc Esc Esc Esc\nwait idle\ndump", "reserves.yaml")
    expect_in("values from: -5 is below 0", re.sub(r"\s+", " ", screens[0].popup + " " + screens[0].note))
    expect_equal(screens[1].row(r"^1 +60")[:2], ["1", "60"])
    expect(re.search(r"^ADC m +189 +< 30 ✘", screens[1].now, re.M), screens[1])


# ---- the picture alone ----


def wide(line):
    return sum(2 if unicodedata.east_asian_width(c) in "WF" else not unicodedata.combining(c) for c in line)


def picture(place, scene, *arguments):
    return good("--plot", "rotation", "-n", 1000, *arguments, place.path / scene).out


def test_plot():
    """--plot rotation: any size and charset, the requested lines, none wider; with given years"""
    with Place() as place:
        for size in ("80x24", "200x50", "60x20", "24x9", "20x6", "300x100"):
            for charset in ("braille", "block", "ascii"):
                for scene in ("wood.yaml", "index.yaml"):
                    text = picture(place, scene, "--size", size, "--charset", charset)
                    width, height = map(int, size.split("x"))
                    lines = text.split("\n")[:-1]
                    expect_equal(len(lines), height, f"{size} {charset}: lines")
                    expect(all(wide(line) <= width for line in lines), f"{size} {charset}: wider", text)
                    expect(charset != "ascii" or text.isascii(), "not ASCII", text)
                    if width < 60:
                        continue
                    expect(lines[0].startswith("current: year by year"), "title", text)
                    pattern = (r"^C[ +x]*x[ +x]*$", r"^ +v") if charset == "ascii" else (r"^C[ ✔✘]*✘[ ✔✘]*$", r"^ +▼")
                    for p in pattern:
                        expect(re.search(p, text, re.M), f"{size} {charset}: {p}", text)
                    expect(("stems could take" in text) == (scene == "index.yaml"), "the lower strip", text)
        text = picture(place, "wood.yaml", "--years", "20:40:4")
        expect_equal(len(re.findall("[✔✘]", re.search(r"^C.*", text, re.M).group())), 6, "years of one's own")
        expect(re.search(r"^ +20 +", text, re.M), "the axis begins at 20", text)


def test_plot_options():
    """--plot rotation: a picture per option, or for the selected ones"""
    with Place() as place:
        text = picture(place, "reserves.yaml")
        expect_equal(re.findall(r"^(.*): year by year", text, re.M), ["reserves", "more"])
        text = picture(place, "reserves.yaml", "--option", "more")
        expect_equal(re.findall(r"^(.*): year by year", text, re.M), ["more"])
        done = ceduo("--plot", "rotation", "-f", "json", place.path / "wood.yaml")
        expect(done.status == USAGE and done.out == "", done)
    for path in sorted((PROFILES / "scenes").glob("*.yaml")):
        good("--plot", "rotation", "-n", 50, path)


def test_plot_figures():
    """--plot rotation: a light per year as in --years, and cuts above their years"""
    with Place() as place:
        lines = picture(place, "wood.yaml", "--size", "160x40").split("\n")
        years = result("--years", "0:12", "-n", 1000, place.path / "wood.yaml")["options"][0]["years"]
    row = {line[0]: line for line in lines if re.match("[CFE] ", line)}
    for light, name in zip("CFE", ("contact", "free_run", "energy")):
        expect_equal([MARKS[c] for c in row[light][1:] if c in MARKS], [y["controls"][0]["lights"][name] for y in years], name)
    at = [i for i, c in enumerate(row["C"]) if i > 0 and c in MARKS]
    expect_equal([at.index(i) for i, c in enumerate(lines[1]) if c == "▼"], [y["year"] for y in years if y["cut"]], "cuts")


def test_plot_cuts():
    """--plot rotation: frequent cuts do not break words with their marks"""
    with Place() as place:
        for rotation in (1, 2, 3, 5):
            text = picture(place, "index.yaml", "-s", f"forest[0].stand.cutting.rotation_years={rotation}", "--years", "0:20")
            line = text.split("\n")[1]
            expect(not re.search(r"▼(c|cu|t|ut)(?=[▼ …]|$)", line), f"rotation {rotation}: {line!r}")


if __name__ == "__main__":
    run_all(__name__)
