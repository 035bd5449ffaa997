#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""View 7: uncertainty of the answer and its causes; the uncertainty in the column on the right; ranges edited there."""
import html
import json
import math
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import CUTS, WOOD, Place, play  # noqa: E402
from harness import ceduo, expect, expect_equal, expect_in, run_all  # noqa: E402

UNCERTAINTY = """
uncertainty:
  - {path: "forest[0].stand.energy.u_J_m3", lo: 50000, hi: 200000}
  - {path: release.vx_m_s, lo: 2.9, hi: 3.1}
"""
NO_LAW = WOOD.replace("rock: {", "rock: {density_kg_m3: 2600, ", 1)


def test_nothing():
    """A scene without uncertainty, or with it disabled, reports this, computes nothing, and has none in the column"""
    told = {NO_LAW + "uncertainty: none\n": "Uncertainty was not computed: the scene has 'uncertainty: none'",
            NO_LAW + "uncertainty: []\n": "Nothing in this scene is marked as assumed"}
    with Place() as place:
        for scene, why in told.items():
            place.write("sure.yaml", scene)
            sure, = place.play("key 7\nwait idle\ndump", "sure.yaml")
            expect_in(why, " ".join(sure.body.split()))
            expect("; range" not in sure.now + sure.lines[1], sure)


def test_so_far():
    """While the uncertainty is computed every view's answer is preliminary, with its progress; not if it is disabled."""
    edited = "".join(f"key 1\nfind controls[0].name\nset {view}\nkey {view}\ndump\n" for view in range(1, 9))
    with Place() as place:
        place.write("unsure.yaml", NO_LAW + UNCERTAINTY)
        place.write("sure.yaml", NO_LAW + "uncertainty: none\n")
        place.write("options.yaml", CUTS.replace("rock: {", "rock: {density_kg_m3: 2600, ", 1)
                    + UNCERTAINTY.replace("forest[0]", "options[*].forest[0]"))
        for scene, keys, edits in (("unsure.yaml", edited, 8), ("options.yaml", "key 1\nfind controls[0].name\nset x\nkey ] 5\ndump\n", 1)):
            unasked, first, known, *open_, last = place.play(
                f"wait idle\ndump\nkey 7\ndump\nwait idle\ndump\n{keys}wait idle\ndump", scene)
            for screen in (unasked, known, last):
                expect("so far" not in screen.lines[1] and "uncertainty" not in screen.lines[1], "the answer", screen)
            expect_in("; range ", known.lines[1])
            expect_equal(len(open_), edits, "screens after an edit")
            for screen in (first, *open_):
                expect(re.search(r" [✔✘?] [A-Z ]+ so far: .* uncertainty \d+ %$", screen.lines[1]), "the answer", screen)
        for screen in place.play("key 7\ndump\nwait idle\ndump", "sure.yaml"):
            expect("so far" not in screen.lines[1], "nothing is computed", screen)


def test_outside():
    """A value edited to one outside its range has a warning in view 7, in the column, and in the comparison"""
    with Place() as place:
        place.write("unsure.yaml", NO_LAW + UNCERTAINTY)
        place.write("options.yaml", CUTS.replace("rock: {", "rock: {density_kg_m3: 2600, ", 1)
                    + UNCERTAINTY.replace("forest[0]", "options[*].forest[0]"))
        edit = "key 7\nwait idle\nkey {0}\ndump\nkey 3\nfind release.vx_m_s\nset 9\nkey 7\nwait idle\nkey {0}\ndump"
        for scene, view in (("unsure.yaml", 7), ("unsure.yaml", 1), ("options.yaml", 5)):
            before, after = place.play("resize 120 45\n" + edit.format(view), scene)
            expect("outside its range" not in before.body, before)
            lines = [line.replace("!", " ").split("│") for line in after.lines]
            said = " ".join(" ".join([line[0] for line in lines] + [line[-1] for line in lines]).split())
            expect(re.search(r"is 9, outside its range 2\.9.3\.1; the range is used", said), "the warning", said, after)


def test_narrow():
    """The column at 80 columns has whole ranges, and both signs of a test, in Italian too"""
    with Place() as place:
        lines = place.play("resize 80 24\nkey 7\nwait idle\nkey 1\ndump", "quarry")[0].lines
        expect(any(re.search(r"│ 90 % \d+–1000\s*$", line) for line in lines), *lines)
        lines = play(place.path, "resize 80 24\nwait idle\ndump", "--language", "it", "blocks-above-the-road")[0].lines
        expect(any(re.search(r"ADC m .*< 30 ✔✘", line) for line in lines), *lines)


def test_view():
    """View 7 at 80x24 and 200x50: the answer with both errors as in the batch, the inputs in order, the column"""
    with Place() as place:
        place.write("unsure.yaml", NO_LAW + UNCERTAINTY)
        small, large, slope = place.play("key 7\nwait idle\ndump\nresize 200 50\ndump\nkey 1\ndump", "unsure.yaml")
        run = json.loads(ceduo("--sensitivity=256", "-n", 400, "-f", "json", place.path / "unsure.yaml").out)
        rocks = re.search(r"(\d+) rocks", small.now).group(1)
        finer = json.loads(ceduo("--batch", "-n", rocks, "-f", "json", place.path / "unsure.yaml").out)
    figure, = (f for f in run["figures"] if f["figure"] == "exceed_probability" and f["against"] is None)
    band = [round(figure["uncertainty"][k] * 1000) for k in ("p5", "p95")]
    wooded = finer["options"][0]["controls"][-1]["wooded"]
    found = wooded["exceed_probability"] * 1000  # equal in all views, not from the few rocks of each scene
    ends = math.floor(wooded["exceed_lo"] * 1000), math.ceil(wooded["exceed_hi"] * 1000)
    for screen in (small, large):
        screen.whole().has("Measure first: stem strength U, J/m³, upper")
        expect(re.search(r"^stem stren.* \d+ % +\d+ if known", screen.body, re.M), "the input with its share in", screen)
        expect(re.search(rf"^current .* {found:.0f} +(?:{ends[0]}–{ends[1]} +)?{band[0]}–{band[1]}$", screen.body, re.M), "the option's line in", screen)
        expect("forest[" not in screen.body, "a path of the file in", screen)
        expect_in("Enter edit", screen.bar)
    for screen in (small, large, slope):
        expect(re.search(rf"^  90 % range +{band[0]}–{band[1]}$", screen.now, re.M), "the uncertainty in the column:", screen.now)
        expect(re.search(rf"^ .*{found:.0f} of 1000 .*; range {band[0]}–{band[1]}$", screen.lines[1]), "the verdict:", screen.lines[1])
    expect(re.search("^energy depends on stem stren", large.now, re.M), "what turns the test:", large.now)


def test_scripts_look_first():
    """A script computes no uncertainty before its first view; then every edit computes it again"""
    with Place() as place:
        place.write("unsure.yaml", NO_LAW + UNCERTAINTY)
        before, first, edited, undone = place.play(
            "wait idle\ndump\nkey 7\nwait idle\ndump\nkey 3\nfind rock.density_kg_m3\nset 4000\nwait idle\ndump\nkey u\nwait idle\ndump",
            "unsure.yaml")
    uncertainty = [re.findall(r"90 % range +(\S+)$", s.now, re.M) for s in (before, first, edited, undone)]
    expect_equal([len(d) for d in uncertainty], [0, 1, 1, 1])
    expect(uncertainty[2] != uncertainty[1], "a heavier rock has another uncertainty", uncertainty)


def test_ranges():
    """A range of the scene is edited in view 7, and undone; a names another input with its range"""
    with Place() as place:
        place.write("unsure.yaml", NO_LAW + UNCERTAINTY)
        start, wider, back = place.play(
            "key 7\nwait idle\ndump\nfind uncertainty[0].hi\nset 150000\nwait idle\ndump\nkey u\nwait idle\ndump", "unsure.yaml")
        expect_in("200000", start.body)
        expect("200000" not in wider.body, wider)
        expect_in("200000", back.body)
        assumed = WOOD.replace("{per_ha: 60, dbh_m: 0.2", "{source: {kind: assumed, text: a guess}, per_ha: 60, dbh_m: 0.2")
        place.write("assumed.yaml", assumed)
        none, named = place.play("key 7\nwait idle\ndump\nkey a\nwait idle\ndump\nkey s", "assumed.yaml")
        expect_in("a adds a range to the scene", none.body)
        expect(re.search(r"^1 +\S+", named.body, re.M), "a row in", named)
        expect(re.search(r"uncertainty:", place.text("assumed.yaml")), place.text("assumed.yaml"))


def test_options():
    """Options: whether they are separated, for the shown one"""
    with Place() as place:
        place.write("cuts.yaml", CUTS + UNCERTAINTY.replace("forest[0]", "options[*].forest[0]"))
        thick, thin, further, compared = place.play(
            "key 7\nwait idle\ndump\nkey ]\nwait idle\ndump\nkey PgDn\ndump\nkey 5\nwait idle\ndump", "cuts.yaml")
    thick.has("'thick' beats 'thin' in", "clear.", "depends on")
    thin.has("'thick' beats 'thin' in", "depends on") # the worse of a pair, too
    for name in ("thick", "thin"):  # beside today's figure, of which it is
        band = re.search(rf"^{name} .* (\d+–\d+)$", thin.body, re.M).group(1)
        expect(re.search(rf"^\d {name} +\d+±\d+ +{band} +\d+±\d+ ", compared.body, re.M), compared)
    expect(re.search("^  option +today +range +mean ", compared.body, re.M), compared)
    further.has("'thin' beats 'none left' in")


def test_over_the_rotation():
    """Tab in view 7, and view 5: mean over the years with its uncertainty, and the order of options, as in --sensitivity
    --years"""
    option = "  - name: {}\n    forest: [{{from_m: 10, to_m: 60, stand: {}}}]\n"
    stands = ("{name: grows, stools: {per_ha: 800, spacing_m: 0.3}, shoots: [{per_ha: 2000, dbh_m: 0.08, height_m: 8}],"
              " growth: {shoots: {dbh_most_m: 0.2, dbh_rate_1_y: 0.1, height_most_m: 14, height_rate_1_y: 0.1}, shoots_young: 2.5, shoots_old: 2.5},"
              " energy: {model: brauner, u_J_m3: 100000}}",
              "{name: stays, trees: [{per_ha: 300, dbh_m: 0.2, height_m: 12}], energy: {model: brauner, u_J_m3: 100000}}")
    scene = CUTS[:CUTS.index("options:")] + "options:\n" + "".join(map(option.format, ("cut", "kept"), stands)) \
        + CUTS[CUTS.index("simulation:"):] + UNCERTAINTY.replace("forest[0]", "options[*].forest[0]")
    with Place() as place:
        place.write("turn.yaml", scene)
        today, over, other, back, compared, small = place.play(
            "resize 120 40\nkey 7\nwait idle\ndump\nkey Tab\ndump\nkey ]\nwait idle\ndump\nkey Tab\ndump\n"
            "key 5\nwait idle\ndump\nresize 80 24\ndump\nkey 1 w\nwait idle\nkey Down Down Down Down Down" + 7 * " Enter" + "\nwait idle\nkey Enter", "turn.yaml")
        written = " ".join(html.unescape(re.sub("<[^>]*>", " ", place.text("ceduo.html"))).split())
        run = json.loads(ceduo("--sensitivity=256", "--years", "-f", "json", place.path / "turn.yaml").out)
    bands = {f["option"]: "–".join(f"{end * 1000:.0f}" for end in (f["uncertainty"]["p5"], f["uncertainty"]["p95"]))
             for f in run["figures"] if f["figure"] == "rotation.exceed_probability" and f["against"] is None}
    rank, = run["ranking"]
    order = rf"Over the years '{rank['better']}' beats '{rank['than']}' in {rank['probability'] * 100:.0f} % of plausible cases"
    expect_equal(sorted(bands), ["cut", "kept"])
    for name, band in bands.items():
        expect(re.search(rf"^{name} .* {band}( |$)", over.body, re.M), name, band, over)
        expect(re.search(rf"^\d {name} .* \d+±\d+ +\d+±\d+ +{band} ", compared.body, re.M), name, band, compared)
        expect(re.search(rf"^\d {name} .* {band} ", small.body, re.M), name, band, small)
        expect(re.search(rf"{name} \d+ \d+–\d+ {band} ", written), name, band, written)
    expect(re.search(order, written), order, written)
    for screen in (over, other, compared, small):
        expect(re.search(order, " ".join(screen.body.split())), order, screen)
    expect(re.search("^  option +today +mean +range ", compared.body, re.M), compared)
    for screen in (today, back):
        expect(re.search("[0-9] +today +", screen.body), screen)


def test_units():
    """The ends of a diameter's range are in cm under their head, and typed in cm; those of a density in its own unit"""
    rows = "uncertainty:\n  - {path: 'forest[0].stand.trees[0].dbh_m', lo: 0.15, hi: 0.25}\n  - {path: rock.density_kg_m3, lo: 2400, hi: 2700}\n"
    with Place() as place:
        place.write("wide.yaml", NO_LAW + rows)
        shown, = place.play("resize 120 40\nkey 7\nfind uncertainty[0].hi\nset 24\nwait idle\ndump\nkey s", "wide.yaml")
        expect(re.search(r"^1 +diameter, c.*? 15 +24\b", shown.body, re.M), shown)
        expect(re.search(r"^2 +density.*? 2400 +2700\b", shown.body, re.M), shown)
        expect_in("hi: 0.24", place.text("wide.yaml"))


def test_many_options():
    """At 80x24 eight options: those that do not fit are counted, the text continues, with a mark; four fit"""
    names = ["one", "two", "three", "four", "five", "six", "seven", "eight"]
    head, (thick, *_), tail = CUTS.split("options:")[0], CUTS.split("  - name: ")[1:], CUTS[CUTS.index("simulation:"):]
    with Place() as place:
        for n in (4, 8):
            options = "".join(f"  - name: {thick.replace('thick', name, 1)}" for name in names[:n])
            place.write(f"{n}.yaml", head + "options:\n" + options + tail + UNCERTAINTY.replace("forest[0]", "options[*].forest[0]"))
        four, = place.play("key 7\nwait idle\ndump", "4.yaml")
        eight, last = place.play("key 7\nwait idle\ndump\nkey [\nwait idle\ndump", "8.yaml")
    for screen, shown, more in ((four, names[:4], 0), (eight, names[:4], 4), (last, names[4:], 4)):
        expect_equal(re.findall(r"^(\w+) .* \d+–\d+$", screen.body, re.M), shown, screen)
        expect_equal(re.findall(r"^(\d+) more options: ] goes on", screen.body, re.M), [str(more)] if more else [], screen)
        expect(re.search(r"depends on +width .*\n.* if known", screen.body), "an input in", screen)
        expect(re.search(r" \d+/\d+ ▼$", screen.body, re.M), "the words go on", screen)


if __name__ == "__main__":
    run_all(__name__)
