#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Regional rules for a coppice: shipped regions, a user's file, and errors."""
import csv
import io
import re

from harness import DONE, INPUT, ROOT, Folder, ceduo, expect, expect_equal, expect_in, good, result, run_all, scene, stand
from pages import WHOLE

ROW = {"article": "art. 1, Act 2", "year": 1999}


CURVE = {"dbh_most_m": 0.4, "dbh_rate_1_y": 0.02, "height_most_m": 18, "height_rate_1_y": 0.04}


def coppice(species="ostrya-carpinifolia", standards=60, turn=25, **changes):
    cut = {"rotation_years": turn, "stay_per_ha": [standards - 20, 20]} if turn else None
    return stand(**{"species": species, "stools": {"per_ha": 2000, "spacing_m": 0.3},
                    "shoots": [{"per_ha": 5000, "dbh_m": 0.06, "height_m": 7}],
                    "trees": [{"per_ha": 75, "dbh_m": 0.2, "height_m": 12}], "cutting": cut,
                    "growth": {"shoots": CURVE, "trees": CURVE, "shoots_young": 10, "shoots_old": 3}, **changes})


def site(what, rules, **changes):
    return scene(**{"controls": [{"x_m": 90}], "slope": {"vertices_m": [[0, 70], [100, 0]], "segments": [{"rn": 0.3, "rt": 0.9}]},
                    "forest": [{"from_m": 0, "to_m": 60, "stand": what}], "rules": rules, **changes})


def check_rules(what, rules, *arguments):
    with Folder() as f:
        return result(f.write("s.yaml", site(what, rules)), "-n", 5, *arguments)["options"][0]["stands"][0].get("rules")


SHIPPED = [  # region, species, system, standards, turn: minimum, met, minimum turn, maximum turn, met; from the acts
    ("toscana", "ostrya-carpinifolia", "simple-coppice", 60, 25, (60, True, None, None, None)),
    ("toscana", "quercus-cerris", "simple-coppice", 59, 17, (60, False, 18, None, False)),
    ("toscana", "quercus-ilex", "simple-coppice", 60, 17, (60, True, 18, None, False)),
    ("toscana", "castanea-sativa", "simple-coppice", 30, 10, (30, True, 10, None, True)),
    ("toscana", "robinia-pseudoacacia", "simple-coppice", 20, 8, (0, True, 8, None, True)),
    ("toscana", "fagus-sylvatica", "coppice-with-standards", 60, 23, (60, True, 24, None, False)),
    ("umbria", "fagus-sylvatica", "simple-coppice", 119, 36, (120, False, 25, 35, False)),
    ("umbria", "quercus-ilex", "simple-coppice", 120, 40, (120, True, 25, 40, True)),
    ("umbria", "quercus-pubescens", "simple-coppice", 80, 18, (80, True, 18, 40, True)),
    ("umbria", "fraxinus-ornus", "simple-coppice", 79, 14, (80, False, 15, 40, False)),
    ("umbria", "castanea-sativa", "simple-coppice", 30, 15, (30, True, 15, None, True)),
    ("umbria", "acer", "simple-coppice", 80, 20, (80, True, None, None, None)),
    ("marche", "acer", "simple-coppice", 60, 20, (60, True, None, None, None)),
]


def test_shipped():
    """Toscana, Umbria, Marche: the minimum for the species, its turn, and compliance"""
    for region, species, system, standards, turn, wanted in SHIPPED:
        r = check_rules(coppice(species, standards, turn, system=system), region)
        expect_equal((r["standards_least"], r["standards_met"], r["turn_least"], r["turn_most"], r["turn_met"]), wanted,
                     (region, species))
        expect_equal((r["standards_per_ha"], r["turn_y"]), (standards, turn))


def test_shipped_say_where_from():
    """Each row of a shipped region has article and year, and the file is listed"""
    listed = good("--list-profiles").out
    for path in sorted((ROOT / "profiles/rules").glob("*.yaml")):
        text = path.read_text()
        rows = [row for row in text.splitlines() if row.startswith("  - {")]
        expect(rows and all("article:" in row and "year:" in row for row in rows), path)
        expect(re.search(rf"(?m)^{path.stem} +rules +.*profiles/rules/{path.name}$", listed), path.name, listed)
    expect(re.search(r"(?m)^\S+ +rules  Toscana ", listed), listed)


def test_what_counts():
    """Standards are the trees left by a cut; without cutting the existing trees count, and there is no turn"""
    kept = check_rules(coppice(), "umbria")
    expect_equal((kept["standards_per_ha"], kept["standards_met"]), (60, False))
    standing = check_rules(coppice(turn=None), "umbria")
    expect_equal((standing["standards_per_ha"], standing["standards_met"]), (75, False))
    expect_equal((standing["turn_y"], standing["turn_least"], standing["turn_met"]), (None, 15, None))


def test_selection():
    """In a selection coppice the oldest shoots are cut after all cohorts, and Toscana requires 40 standards"""
    sel = coppice("fagus-sylvatica", 40, system="selection-coppice", cutting={"rotation_years": 8, "cohorts": 3, "stay_per_ha": [40]})
    r = check_rules(sel, "toscana")
    expect_equal((r["standards_least"], r["standards_met"], r["turn_y"], r["turn_least"], r["turn_met"]), (40, True, 24, 24, True))


def test_own_region():
    """A region is one file: the first matching row counts; without a species compliance is unknown"""
    own = {"ceduo": "rules/1", "name": "Nowhere", "note": "made up",
           "standards": [{"species": ["acer"], "system": "large-reserves", "per_ha": 5, "most_per_ha": 7, **ROW},
                         {"species": ["acer"], "per_ha": 10, **ROW}, {"per_ha": 70, **ROW}]}
    with Folder() as f:
        f.write("nowhere.yaml", own)
        for what, least in ((coppice("acer"), 10), (coppice("acer", system="large-reserves"), 5), (coppice(), 70),
                            (coppice(None), None)):
            path = f.write("s.yaml", site(what, "nowhere.yaml"))
            r = result(path, "-n", 5)["options"][0]["stands"][0]["rules"]
            expect_equal((r["region"], r["standards_least"]), ("Nowhere", least), what)
        page = " ".join(good(*WHOLE, "-n", 5, path).out.split())
        expect_in("coppice: the stand has no species, so the rules of Nowhere are not checked.", page)
        page = " ".join(good(*WHOLE, "-n", 5, f.write("s.yaml", site(coppice("acer"), "nowhere.yaml"))).out.split())
        expect_in("Nowhere asks for ≥ 10 standards a hectare (art. 1, Act 2, 1999); 60 are kept: met.", page)
        expect_in("Nowhere: check the text in force; made up.", page)
        page = " ".join(good(*WHOLE, "-n", 5, f.write("s.yaml", site(coppice("acer", system="large-reserves"), own))).out.split())
        expect_in("! coppice: Nowhere asks for 5–7 standards a hectare (art. 1, Act 2, 1999); 60 are kept: NOT met.", page)


def test_page():
    """The page prints compliance and warns of violations, once per stand"""
    with Folder() as f:
        path = f.write("s.yaml", site(coppice(), "umbria"))
        page = " ".join(good(*WHOLE, "-n", 5, path).out.split())
        expect_in("Umbria asks for ≥ 80 standards a hectare (art. 33, R.R. 7, 2002); 60 are kept: NOT met.", page)
        expect_in("Umbria asks for a rotation of 15–40 years (art. 26, R.R. 7, 2002); shoots are cut at 25: met.", page)
        expect_equal(page.count("check the text in force"), 1, page)


NO_TURN = "the rules of {} give no rotation for this species ({}). The rotation is not checked."


def test_not_named():
    """A species missing in a region is reported on the page, in the report and on the screen, also without cutting; JSON and
    CSV have null. Holm oak is an oak of Toscana's 'specie quercine'."""
    with Folder() as f:
        for region, species, common, named in (("toscana", "ostrya-carpinifolia", "hop hornbeam", False), ("toscana", "acer", "maple", False),
                                               ("toscana", "quercus-ilex", "holm oak", True), ("toscana", "carpinus-betulus", "hornbeam", True),
                                               ("umbria", "ostrya-carpinifolia", "hop hornbeam", True), ("marche", "fagus-sylvatica", "beech", False)):
            for turn in (25, None):
                path = f.write("s.yaml", site(coppice(species, turn=turn), region))
                page = " ".join(good(*WHOLE, "-n", 5, path).out.split())
                expect_equal((NO_TURN.format(region.title(), common) in page, "give no" in page), (not named, not named), f"{region} {species}: {page[:900]}")
                expect_equal(check_rules(coppice(species, turn=turn), region)["turn_least"] is None, not named)
                two = site(coppice(species, turn=turn), region)
                two["options"] = [{"name": name, "forest": two["forest"]} for name in "ab"]
                two.pop("forest")
                good("--report", f.path / "p.html", "--sensitivity=2", "-n", 20, f.write("two.yaml", two))
                expect_equal(">not named<" in (f.path / "p.html").read_text(), not named, f"{region} {species}")
        own = {"name": "Nowhere", "standards": [{"species": ["acer"], "per_ha": 10, **ROW}]}
        page = " ".join(good(*WHOLE, "-n", 5, f.write("s.yaml", site(coppice(), own))).out.split())
        expect_in("the rules of Nowhere give no number of standards for this species (hop hornbeam). The number is not checked.", page)
        f.write("keys", f"resize 120 60\nwait idle\nkey 4\ndump {f.path}/screen.txt\n")
        good("--script", f.path / "keys", f.write("s.yaml", site(coppice(), "toscana")))
        column = [line.rpartition("\u2502")[2] for line in (f.path / "screen.txt").read_text().splitlines()]
        expect_in(NO_TURN.format("Toscana", "hop hornbeam"), " ".join(" ".join(column).split()))


def test_marche():
    """For Marche only the paper's 60 standards are checked, and every page reports it"""
    with Folder() as f:
        path = f.write("s.yaml", site(coppice(), "marche"))
        page = " ".join(good(*WHOLE, "-n", 5, path).out.split())
        expect_in("only the 60 standards that Ciabocco, Boccia and Ripa 2009 cite are checked", page)
        good("--report", f.path / "p.html", "--sensitivity=2", "-n", 20, path)
        expect_in("only the 60 standards that Ciabocco, Boccia and Ripa 2009 cite are checked", (f.path / "p.html").read_text())


def test_notes_in_italian():
    """A note of a shipped region is Italian on an Italian page; a user's note stays as written"""
    with Folder() as f:
        for region in sorted((ROOT / "profiles/rules").glob("*.yaml")):
            note = next(line for line in region.read_text().splitlines() if line.startswith("note: ")).split('"')[1]
            pages = [" ".join(good(*WHOLE, "-n", 5, "--language", language, f.write("s.yaml", site(coppice(), region.stem))).out.split())
                     for language in ("en", "it")]
            expect_equal([note in page for page in pages], [True, False], region.stem)
            expect_in("controllare il testo in vigore; ", pages[1])


def test_csv():
    """CSV has the same values in a row per stand, empty without a rule, in any language"""
    with Folder() as f:
        for rules, wanted in (("umbria", {"region": "Umbria", "standards_per_ha": "60", "standards_least": "80", "standards_most": "",
                                          "standards_met": "false", "standards_article": "art. 33, R.R. 7", "standards_year": "2002",
                                          "turn_y": "25", "turn_least": "15", "turn_most": "40", "turn_met": "true",
                                          "turn_article": "art. 26, R.R. 7", "turn_year": "2002"}), (None, None)):
            path = f.write("s.yaml", site(coppice(), rules))
            out = good("--batch", "-n", 5, "-f", "csv", "--rows", "stands", path).out
            row = next(csv.DictReader(io.StringIO(out)))
            found = {k.split(".", 1)[1]: v for k, v in row.items() if k.startswith("rules.")}
            expect_equal(found, wanted or dict.fromkeys(found, ""))
            expect_equal(len(found), 13)
            expect_equal(good("--batch", "-n", 5, "-f", "csv", "--rows", "stands", "--language", "it", path).out, out)


def test_no_coppice():
    """Rules do not apply to a high forest, a gap or a scene without rules; no figure of a run changes"""
    high = coppice(stools=None, shoots=None)
    bare = stand(stools=None, shoots=None, trees=None, system="bare")
    for what, rules in ((high, "umbria"), (bare, "umbria"), (coppice(), None)):
        expect_equal(check_rules(what, rules), None)
    with Folder() as f:
        runs = [result(f.write("s.yaml", site(coppice(), rules)), "-n", 50)["options"] for rules in (None, "umbria")]
        for run in runs:
            run[0]["stands"][0].pop("rules", None)
        expect_equal(runs[0], runs[1])


BAD = [({"standards": []}, "'name' is missing"), ("lazio", "cannot find 'lazio'"), ("simple-coppice", "cannot find"),
       ({"name": "X", "standards": [{"per_ha": 3, "year": 2000}]}, "'article' is missing"),
       ({"name": "X", "standards": [{"per_ha": -3, **ROW}]}, "rules.standards[0].per_ha: -3 is below 0"),
       ({"name": "X", "turns": [{"least_y": 20, "most_y": 10, **ROW}]}, "rules.turns[0]: the maximum is below the minimum"),
       ({"name": "X", "turns": [{"species": ["oak"], "least_y": 20, **ROW}]}, "rules.turns[0].species[0]: 'oak' is unknown"),
       ({"name": "X", "turns": [{"least_y": 20, **ROW, "year": 20}]}, "rules.turns[0].year"),
       ({"ceduo": "stand/1", "name": "X"}, "rules/1")]


def test_bad():
    """An unknown region, species or key is reported with its place"""
    with Folder() as f:
        for rules, words in BAD:
            r = ceduo("--check", f.write("s.yaml", site(coppice(), rules)))
            expect_equal(r.status, INPUT, (rules, r))
            expect_in(words, r.err, rules)


if __name__ == "__main__":
    run_all(__name__)
