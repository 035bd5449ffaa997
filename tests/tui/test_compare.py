#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""View 5: an option is called the best only if the difference is more than chance."""
import math
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import play  # noqa: E402
from play import CUTS, Place  # noqa: E402
from harness import ceduo, expect, expect_equal, results, run_all  # noqa: E402

HEAD, TAIL = CUTS[:CUTS.index("options:")], CUTS[CUTS.index("simulation:"):]
OPTION = """\
  - name: {name}
    forest:
      - {{from_m: 5, to_m: 80, stand: {{name: {name}, species: ostrya-carpinifolia,
         trees: [{{per_ha: {per_ha}, dbh_m: 0.2, height_m: 12, volume_m3: 0.2}}], energy: {{u_J_m3: 100000}}}}}}
"""


def verdict(per_ha):
    """Two forests of 100 and n trees per hectare: today's sentence, the difference of their shares, and its error."""
    options = OPTION.format(name="one", per_ha=100) + OPTION.format(name="other", per_ha=per_ha)
    with Place() as place:
        place.write("two.yaml", HEAD + "options:\n" + options + TAIL)
        screen = place.play("resize 120 40\nkey 5\nwait idle\ndump", "two.yaml", charset="ascii", rocks=None)[0]
        rocks = re.search(r"(\d+) rocks", screen.now, re.M).group(1)
        difference = results("-n", rocks, place.path / "two.yaml")[0]["differences"][1]["exceed_probability"]
    said = re.search(r"Today (no option|'one'|'other') ", " ".join(screen.body.split()))
    expect(said, "nothing is said of today", screen)
    return said.group(1), difference["mean"], difference["se"]


def test_clear_differences():
    """An option is called the best only if it leads by more than three standard errors"""
    seen = set()
    for per_ha in (100.05, 100.1, 100.2, 130, 60):
        found, mean, se = verdict(per_ha)
        wanted = "no option" if abs(mean) <= 3 * se else "'one'" if mean > 0 else "'other'"
        expect_equal(found, wanted, f"{per_ha} trees: {mean} with error {se}")
        if mean != 0:
            seen.add(wanted)
    expect(seen == {"no option", "'one'", "'other'"}, "apart either way, and not apart though not the same", seen)


def expect_same_error(narrow, wide, arrivals):
    """A column too narrow for the interval shows half of it, with the weights of the blocks."""
    for row, key in (("arrive", "reach"), ("above 50 kJ", "exceed")):
        value, lo, hi = (1000 * arrivals[f"{key}_{k}"] for k in ("probability", "lo", "hi"))
        expect(re.search(rf"^ *{row} +{value:.0f}±{math.ceil((hi - lo) / 2)} ", narrow.now, re.M), row, lo, hi, narrow)
        expect(re.search(rf"^ *{row} +{value:.0f} \({math.floor(lo)}–{math.ceil(hi)}\) ", wide.now, re.M), row, lo, hi, wide)


def test_blocks():
    """With blocks of all sizes column and view 5 print the frequency of dangerous ones, and no mean of survivors"""
    with Place() as place:
        screen, wide, narrow, over = place.play(
            "resize 130 40\nkey 5\nwait idle\ndump\nresize 200 50\ndump\nresize 80 24\ndump\nresize 200 50\nkey 6\ndump", "blocks-above-the-road")
        rocks = re.search(r"(\d+) rocks", screen.now, re.M).group(1)
        options = results("-n", rocks, "blocks-above-the-road")[0]["options"]
        ahead = results("--years", "-n", play.ROCKS, "blocks-above-the-road")[0]["options"]
        page = " ".join(ceduo("--batch", "--details", "-n", 2000, "-s", "controls[0].accepted_return_y=55", "blocks-above-the-road").out.split())
    expect("simple coppice, 135 m: too close to the limit of one rock in 55 years today" in page, page)
    years = [o["controls"][0]["wooded"]["hazard"]["accepted_years"] for o in options]
    bare = options[0]["controls"][0]["bare"]["hazard"]["accepted_years"]
    expect_equal(screen.pair("years apart"), (round(years[0]), round(bare)))
    expect("Rock" not in screen.now and "mean kJ" not in screen.now, "one rock, or the mean of the few large ones", screen.now)
    expect(re.search(r"^Blocks 0.01–2 m³, 0.5/year$", screen.now, re.M), screen.now)
    expect(re.search(r"^Years between two rocks > 50 kJ at 135 m \(accepted: 100\); years 1 to 25$", screen.body, re.M), screen)
    found = re.findall(r"^\w.* (\d+) +(\d+) \(\d+–\d+\) +(\d+) \((\d+)\) +✘ NO +[\d.]+ ", screen.body, re.M)
    expect_equal(found, [(f"{y:.0f}", *(f"{1 / (0.5 * w[k]):.0f}" for k in ("mean", "worst")), f"{w['worst_year']}")
                         for y, w in zip(years, (o["window"] for o in ahead), strict=True)], "half a block a year")
    expect("of 1000 released with > 50 kJ (limit 20)" in over.body, over)  # 1000 / (100 years of half a block)
    expect(re.search(r"│ 20 +> 50 kJ E +│ 50 +mean kJ", wide.body), wide)
    expect_same_error(narrow, wide, options[0]["controls"][0]["wooded"])
    words = " ".join(screen.body.split())
    expect(re.search(r"Years are counted from today, with \d+ rocks in each; the worst is that of these years\.", words), words)


def test_wood_felled():
    """On 80 columns the worst year and the felled volume stay next to the mean over the years and its range"""
    with Place() as place:
        screen = place.play("key 7\nwait idle\nkey 5\nwait idle\ndump", "road-below")[0].whole()
    expect(re.search(r"^  option +today +mean +range +worst +fail m³/y$", screen.body, re.M), screen)
    expect_equal(len(re.findall(r"^\d \w.* \d+±\d+ +\d+±\d+ +\d+–\d+ +\d+ \(\d+\) +\d+/\d+ +[\d.-]+$", screen.body, re.M)), 3, screen)


def test_copies():
    """Among copies none is the best, and they are called equal; options with different numbers of rocks have no best"""
    with Place() as place:
        place.write("two.yaml", HEAD + "options:\n" + OPTION.format(name="one", per_ha=100) + TAIL)
        before, after = place.play("resize 120 40\nkey 5\nwait idle\nkey y\ndump\nwait idle\ndump", "two.yaml", charset="ascii")
    expect(not re.search(r" best |fewest", before.body), before)
    expect(re.search(r"Today all options are equal: \d+ of 1000\.", " ".join(after.body.split())), after)


if __name__ == "__main__":
    run_all(__name__)
