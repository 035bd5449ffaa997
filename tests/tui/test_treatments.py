#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""View 5: a offers treatments of the existing stand; p and c keep growth and cutting of the replaced one, or say what they
drop."""
import sys
from pathlib import Path

import yaml

sys.path.insert(0, str(Path(__file__).resolve().parent))
import play  # noqa: E402
from play import check_good  # noqa: E402
from harness import PROFILES, Folder, expect, expect_equal, expect_in, result, run_all  # noqa: E402

HEAD = """\
ceduo: scene/1
title: mill
rock: {diameter_m: 0.7}
slope: {vertices_m: [[0, 180], [40, 120], [120, 40], [200, 0]], materials: [{from_m: 0, to_m: 200, material: talus}]}
controls: [{x_m: 130, name: road, accepted_kJ: 50}]
uncertainty: none
simulation: {contact_model: index}
"""
# a stand as a survey of version 0.4 writes it: without growth and cutting
PLOT = """\
ceduo: stand/1
name: plot
species: ostrya-carpinifolia
stools: {per_ha: 1500, spacing_m: 0.35}
shoots: [{per_ha: 4500, dbh_m: 0.06, height_m: 7, age_y: 24}]
trees: [{per_ha: 110, dbh_m: 0.2, height_m: 12}]
source: {kind: measured, text: six plots}
"""
PLAIN = HEAD + "forest: [{from_m: 20, to_m: 125, stand: plot.yaml}]   # kept\n"
OWN_SHOOTS = "{shoots: {dbh_most_m: 0.2, dbh_rate_1_y: 0.02, height_most_m: 15, height_rate_1_y: 0.03}, shoots_young: 12, shoots_old: 2}"
OWN_GROWTH = OWN_SHOOTS[:-1] + ", trees: {dbh_most_m: 0.5, dbh_rate_1_y: 0.015, height_most_m: 21, height_rate_1_y: 0.03}}"
OWN = HEAD + """\
forest:
  - {from_m: 20, to_m: 70, cut_year: 5, stand: {base: plot.yaml, name: own, growth: %s,
                                                cutting: {rotation_years: 20, stay_per_ha: [50, 30, 20]}}}
  - {from_m: 70, to_m: 125, cut_year: 7, stand: simple-coppice}
""" % OWN_GROWTH

CUT = "key a Enter Ctrl-U\ntype {}\nkey Enter\n"
SELECTION = "key a Down Enter\n"
UNCUT = "key a Down Down Enter\n"


class Place(Folder):
    """A folder with the scenes."""

    def __enter__(self):
        super().__enter__()
        self.write("plot.yaml", PLOT)
        self.write("plain.yaml", PLAIN)
        self.write("own.yaml", OWN)
        return self

    def play(self, script, scene):
        return play.play(self.path, script, scene)

    def saved(self, scene):
        check_good(self.path, scene)
        return yaml.safe_load((self.path / scene).read_text())


def shipped(name):
    return yaml.safe_load((PROFILES / "stands" / f"{name}.yaml").read_text())


def without_source(group):
    return {k: v for k, v in group.items() if k != "source"}


def test_treatments_of_a_survey():
    """A stand without growth: cut now with 60 and 120 standards, selection, not cut; growth and cuts come from the shipped
    stand of its species, marked assumed, and the years equal those of such a scene written by hand."""
    with Place() as place:
        script = "key 5\n" + CUT.format(60) + "dump\n" + CUT.format(120) + SELECTION + "dump\n" + UNCUT + "key Enter\ndump\n"
        first, third, last = place.play(script + "key s\nwait idle\ndump", "plain.yaml")[:3]
        expect_in("added 'cut now, keep 60'. Growth and cutting of 'plot' are those of 'simple coppice, 25 years' (assumed).",
                  first.note)
        expect_in("added 'selection coppice'. Growth and cutting of 'plot' are those of 'selection coppice' (assumed).", third.note)
        expect_in("added 'not cut'. The growth of 'plot' is that of 'simple coppice, 25 years' (assumed).", last.note)
        options = place.saved("plain.yaml")["options"]
        expect_equal([o["name"] for o in options],
                     ["current", "cut now, keep 60", "cut now, keep 120", "selection coppice", "not cut"], "names, in order")
        now, cut, more, selection, uncut = [o["forest"][0] for o in options]
        expect_equal(now, {"from_m": 20, "to_m": 125, "stand": "plot.yaml"}, "the option that was copied")
        simple, chosen = shipped("simple-coppice"), shipped("selection-coppice")
        for belt, growth, cutting in ((cut, simple, simple), (more, simple, simple), (selection, chosen, chosen)):
            expect_equal(belt["cut_year"], 1, "cut next year")
            expect_equal(without_source(belt["stand"]["growth"]), without_source(growth["growth"]), "growth")
            expect_equal(belt["stand"]["cutting"]["rotation_years"], cutting["cutting"]["rotation_years"], "rotation")
            expect_equal(belt["stand"]["growth"]["source"]["kind"], "assumed", "source of the growth")
            expect_equal(belt["stand"]["base"], "plot.yaml", "the stems are still those of the survey")
        expect_equal([cut["stand"]["cutting"]["stay_per_ha"], more["stand"]["cutting"]["stay_per_ha"]], [[30, 30], [60, 60]],
                     "standards, half of each age as in the shipped stand")
        expect_equal(more["stand"]["cutting"]["source"], {"kind": "assumed", "text": "as in the stand 'simple coppice, 25 years'",
                                                          "except": ["stay_per_ha"]}, "source of the cutting")
        expect_equal(selection["stand"]["cutting"]["cohorts"], 3, "ages on a stool")
        expect("cutting" not in uncut["stand"] and "cut_year" not in uncut and "growth" in uncut["stand"], uncut)
        hand = HEAD + "options:\n"
        for name, stay in (("a", [30, 30]), ("b", [60, 60])):
            hand += (f"  - name: {name}\n    forest: [{{from_m: 20, to_m: 125, cut_year: 1, stand: {{base: plot.yaml, growth: "
                     f"{without_source(simple['growth'])}, cutting: {{rotation_years: 25, stay_per_ha: {stay}}}}}}}]\n")
        place.write("hand.yaml", hand.replace("'", ""))

        def years(scene, names):
            """Return yield and stems of each year."""
            got = {o["name"]: o for o in result("--years", "0:30", place.path / scene)["options"]}
            return [(got[n]["yield"], [[s["stems_per_ha"] for s in y["stands"]] for y in got[n]["years"]]) for n in names]
        expect_equal(years("plain.yaml", ["cut now, keep 60", "cut now, keep 120"]), years("hand.yaml", ["a", "b"]),
                     "years of the treatments, and of the scene by hand")


def test_one_step_each():
    """Each treatment is one undo step, and the cursor stays on the copied option."""
    with Place() as place:
        two, one, none = place.play("resize 120 40\nkey 5\n" + CUT.format(60) + SELECTION + "wait idle\ndump\nkey u\nclear\nwait idle\ndump\n"
                                    "key u\nclear\nwait idle\ndump", "plain.yaml")
        two.has("cut now, keep 60", "selection coppice")
        expect_in("current", two.now, "the option shown")
        one.has("cut now, keep 60").lacks("selection coppice")
        none.has("Only one option.").lacks("cut now")


def test_own_growth_and_cutting():
    """A stand's own growth and rotation stay; standards keep the proportion of ages; also another belt's; years without a cut."""
    with Place() as place:
        script = "key 5\n" + CUT.format(33) + "dump\n" + UNCUT + "type 20\nkey Enter\ndump\n" + SELECTION + UNCUT + "key Enter\n"
        cut, wait = place.play(script + "key s\nwait idle\ndump", "own.yaml")[:2]
        expect_equal(cut.note, "added 'cut now, keep 33'.", "nothing is borrowed")
        expect_equal(wait.note, "added 'no cut for 20 years'.", "nor there")
        options = {o["name"]: o["forest"] for o in place.saved("own.yaml")["options"]}
        own, simple = options["cut now, keep 33"]
        expect_equal(without_source(own["stand"]["growth"]), yaml.safe_load(OWN_GROWTH), "its growth")
        expect_equal(own["stand"]["cutting"], {"rotation_years": 20, "stay_per_ha": [17, 10, 6]}, "50, 30, 20 % of 33, and 33 in all")
        expect_equal(simple["stand"], {"base": "simple-coppice", "cutting": dict(shipped("simple-coppice")["cutting"],
                     stay_per_ha=[17, 16], source=simple["stand"]["cutting"]["source"])}, "the shipped stand, but for its standards")
        expect_equal([b["cut_year"] for b in options["cut now, keep 33"]], [1, 1], "years of the cut")
        expect_equal([b["cut_year"] for b in options["no cut for 20 years"]], [21, 21], "the following year")
        expect_equal([b.get("cut_year") for b in options["current"]], [5, 7], "the option that was copied")
        for belt in options["not cut"]:
            expect("cut_year" not in belt and "cutting" not in belt["stand"], belt)
        own = options["selection coppice"][0]["stand"]
        expect_equal(own["cutting"]["rotation_years"], 13, "rotation of the shipped selection coppice")
        expect_equal([own["growth"]["shoots"], own["growth"]["shoots_young"]], [yaml.safe_load(OWN_GROWTH)["shoots"], 12], "its curve")
        expect_equal(own["growth"]["shoots_old"], shipped("selection-coppice")["growth"]["shoots_old"], "shoots on an old stool")


def test_names():
    """Treatments of another option have its name in theirs if a name would repeat."""
    with Place() as place:
        place.play("key 5\n" + CUT.format(60) + "key a\ntype large-reserves-cut\nkey Enter\n" + CUT.format(60) + "key s\nwait idle\ndump",
                   "plain.yaml")
        names = [o["name"] for o in place.saved("plain.yaml")["options"]]
        expect_equal(names, ["current", "cut now, keep 60", "large-reserves-cut", "cut now, keep 60 (large-reserves-cut)"], "names")


def test_what_cannot_be_treated():
    """Trees without stools are no coppice: such a belt stays unchanged and is reported; bare ground is skipped."""
    high = "{name: high, species: fagus-sylvatica, trees: [{per_ha: 300, dbh_m: 0.3, height_m: 20}]}"
    scenes = {"high.yaml": f"forest: [{{from_m: 20, to_m: 125, stand: {high}}}]\n",
              "both.yaml": f"forest: [{{from_m: 20, to_m: 60, stand: {high}}}, {{from_m: 60, to_m: 125, stand: plot.yaml}}]\n",
              "bare.yaml": "forest: [{from_m: 20, to_m: 125, stand: bare}]\n", "none.yaml": ""}
    with Place() as place:
        for name, forest in scenes.items():
            place.write(name, HEAD + forest)
        refused = place.play("key 5\n" + CUT.format(60) + "dump\nkey Esc\nwait idle\ndump", "high.yaml")
        expect_in("Belt 1 is unchanged: 'high' has no stools.", refused[0].popup)
        refused[1].has("Only one option.")
        both = place.play("key 5\n" + SELECTION + "dump", "both.yaml")[0]
        expect_in("Belt 1 is unchanged: 'high' has no stools.", both.note)
        expect_in("added 'selection coppice'", both.note)
        bare = place.play("key 5\n" + SELECTION + "dump", "bare.yaml")[0]
        expect_in("There is no forest here to treat.", bare.note)
        place.play("key 5\nkey a\ndump\nkey Esc", "none.yaml")[0].lacks("this stand")


def test_new_option_keeps_the_year():
    """A new option from a preset has the first option's cut year."""
    with Place() as place:
        place.play("key 5 a\ntype large-reserves-cut\nkey Enter s\nwait idle\ndump", "own.yaml")
        belts = place.saved("own.yaml")["options"][1]["forest"]
        expect_equal([(b["cut_year"], b["stand"]) for b in belts], [(5, "large-reserves-cut"), (7, "large-reserves-cut")], "belts")


def chose(script, scene="own.yaml"):
    """Return the message after the choice of a stand, and the saved belts."""
    with Place() as place:
        screen = place.play(script + "dump\nkey s\nwait idle\ndump", scene)[0]
        return screen.note, place.saved(scene)["forest"]


def test_what_a_preset_drops():
    """p in views 1, 2 and 5 reports lost growth and cutting, and that the cut year stays."""
    for view in ("key 1\nfind forest[0]\n", "key 2\n", "key 5\n"):
        note, belts = chose(view + "key p\ntype large-reserves-cut\nkey Enter\n")
        expect_equal(note, "growth and cutting of 'own' are now those of 'large reserves, just cut'; it is still cut in year 5", view)
        expect_equal((belts[0]["cut_year"], belts[0]["stand"]), (5, "large-reserves-cut"), view)
    note, _ = chose("key 2 p\ntype ads-1\nkey Enter\n")
    expect_equal(note, "the growth of 'own' is now that of 'ADS 1'; the cutting of 'own' is dropped: 'ADS 1' has none", "ADS 1")
    note, _ = chose("key 2 p\ntype plot\nkey Enter\n")
    expect_equal(note, "growth and cutting of 'own' are dropped: 'plot' has none", "a stand without")
    note, _ = chose("key 2 p\ntype large-reserves-cut\nkey Enter\n", "plain.yaml")
    expect("growth" not in note and "cut in" not in note, "nothing was there to lose", note)
    note, _ = chose("key 2\nfind forest[1]\nkey p\ntype large-reserves-cut\nkey Enter\n")
    expect_equal(note, "it is still cut in year 7", "the file of a shipped stand still has its growth")


def test_stand_without_cutting():
    """p and a: a stand without cutting takes the place of one with a cut year, which goes with the cutting; the lights of the
    choice are previewed, and u undoes both"""
    with Place() as place:
        script = "key 2 p\ntype ads-1\nwait idle\ndump\nkey Enter\nkey 5 a\ntype ads-1\nwait idle\ndump\nkey Enter\nkey s\nwait idle\ndump\n"
        ahead, every = place.play(script, "own.yaml")[:2]
        for screen in (ahead, every):
            expect_in("Contact passes", screen.popup)
        current, added = [o["forest"] for o in place.saved("own.yaml")["options"]]
        expect_equal([b.get("cut_year") for b in current], [None, 7], "the belt that was replaced, and the other one")
        expect_equal([(b.get("cut_year"), b["stand"]) for b in added], [(None, "ads-1")] * 2, "the new option")
    with Place() as place:
        place.play("key 2 p\ntype ads-1\nkey Enter\nkey u\nkey p\ntype large-reserves-cut\nkey Enter s\nwait idle\ndump", "own.yaml")
        expect_equal([b["cut_year"] for b in place.saved("own.yaml")["forest"]], [5, 7], "undone, and a stand with cutting")
        place.write("bad.yaml", "ceduo: stand/1\ntrees: 3\n")
        screen = place.play("key 2 p\ntype bad\nkey Enter\ndump", "own.yaml")[0]
        expect_in("trees: expected a list", screen.note + " " + screen.popup)


def borrow(treatment, growth):
    """Return the message and the first belt of the last option after a treatment of a stand with such growth and no cutting."""
    with Place() as place:
        place.write("s.yaml", HEAD + "forest: [{from_m: 20, to_m: 125, stand: {base: plot.yaml, name: own, growth: %s}}]\n" % growth)
        screen = place.play("resize 200 50\nkey 5\n" + treatment + "dump\nkey s\nwait idle\ndump", "s.yaml")[0]
        return screen.note, place.saved("s.yaml")["options"][-1]["forest"][0]


def test_incomplete_growth():
    """Growth that a cut lacks is borrowed: that of the trees alone, or all if that of the shoots is missing"""
    simple, chosen = shipped("simple-coppice")["growth"], shipped("selection-coppice")["growth"]
    own = yaml.safe_load(OWN_SHOOTS)
    for treatment, lender in ((CUT.format(33), simple), (SELECTION, chosen)):
        note, belt = borrow(treatment, OWN_SHOOTS)
        expect_in("The growth of trees of 'own' is that of", note)
        expect_equal(without_source(belt["stand"]["growth"]["trees"]), lender["trees"], "trees")
        expect_equal(belt["stand"]["growth"]["trees"]["source"]["kind"], "assumed")
        expect_equal(belt["stand"]["growth"]["shoots"], own["shoots"], "its own curve")
    for treatment, borrows in ((CUT.format(33), True), (UNCUT + "key Enter\n", False)):
        note, belt = borrow(treatment, "{trees: {dbh_most_m: 0.5, dbh_rate_1_y: 0.015, height_most_m: 21, height_rate_1_y: 0.03}}")
        expect_equal("rowth and cutting of 'own' are those of" in note, borrows, note)
        expect_equal("shoots" in belt["stand"]["growth"], borrows, "growth")


def test_refused_in_view_6():
    """View 6 refuses a cut year without cutting or growth and a missing number of shoots, with the reader's message"""
    change = "find forest[0].{}\nkey Enter Ctrl-U\ntype {}\nkey Enter\n"
    with Place() as place:
        script = ("resize 200 50\nkey 6\n" + change.format("cut_year", 3) + "dump\nkey Esc\n" + change.format("stand.cutting.rotation_years", 20) +
                  "wait idle\ndump\n" + change.format("cut_year", 3) + "dump\nkey Esc\nkey s\nwait idle\ndump")
        year, rotation, growth = place.play(script, "plain.yaml")[:3]
        expect_in("the cut needs 'cutting' of the stand; add it, or remove 'cut_year'", year.note + year.popup)
        rotation.has("stand 'plot' has no growth data for its stems.")
        expect_in("the cut needs 'growth' of the stand; add it, or remove 'cut_year'", growth.note + growth.popup)
        belt = place.saved("plain.yaml")["forest"][0]
        expect_equal((belt.get("cut_year"), belt["stand"]["cutting"]), (None, {"rotation_years": 20}), belt)
        old = place.play("resize 200 50\nkey 6\nfind forest[0].stand.growth.shoots_old\nkey Enter Ctrl-U Enter\ndump\n", "own.yaml")[0]
        expect_in("'shoots when old' is missing; it has no default", old.note + old.popup)


def test_counts_keep():
    """c keeps growth, cutting and cut year of the stand whose stems it replaces."""
    note, belts = chose("key 2 c Enter Enter\ntype 60\nkey Enter\ntype 180\nkey Enter Enter Enter Enter Enter Enter\n")
    expect_in("each counted stem is", note)
    expect_equal(belts[0]["cut_year"], 5, "year")
    expect_equal(belts[0]["stand"]["cutting"], {"rotation_years": 20, "stay_per_ha": [50, 30, 20]}, "cutting")
    expect_equal(belts[0]["stand"]["growth"], yaml.safe_load(OWN_GROWTH), "growth")


if __name__ == "__main__":
    run_all(__name__)
