#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""View 5: the best and the worst of what rocks say are marked only where more than chance tells them apart."""
import math
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import CUTS, Place  # noqa: E402
from test_screens import compared  # noqa: E402
from harness import expect, expect_equal, results, run_all  # noqa: E402

HEAD, TAIL = CUTS[:CUTS.index("options:")], CUTS[CUTS.index("simulation:"):]
OPTION = """\
  - name: {name}
    forest:
      - {{from_m: 5, to_m: 80, stand: {{name: {name}, species: ostrya-carpinifolia,
         trees: [{{per_ha: {per_ha}, dbh_m: 0.2, height_m: 12, volume_m3: 0.2}}], energy: {{u_J_m3: 100000}}}}}}
"""


def marks(per_ha):
    """Two woods of 100 and of so many trees a hectare: the marks of their shares, how far those are apart, and with what
    error."""
    options = OPTION.format(name="one", per_ha=100) + OPTION.format(name="other", per_ha=per_ha)
    with Place() as place:
        place.write("two.yaml", HEAD + "options:\n" + options + TAIL)
        screen = place.play("resize 120 40\nkey 5\nwait idle\ndump", "two.yaml", charset="ascii")[0]
        rocks = re.search(r"(\d+) rocks$", screen.now, re.M).group(1)
        difference = results("-n", rocks, place.path / "two.yaml")[0]["differences"][1]["exceed_probability"]
    return "".join(figures[2][1] for _, figures in compared(screen)), difference["mean"], difference["se"]


def test_marks_of_shares():
    """Shares with too much energy are marked where they are more than two standard errors apart, and only there"""
    seen = set()
    for per_ha in (100.05, 100.1, 100.2, 130, 60):
        found, mean, se = marks(per_ha)
        apart = abs(mean) > 2 * se
        wanted = "  " if not apart else "*!" if mean > 0 else "!*"
        expect_equal(found, wanted, f"{per_ha} trees: {mean} with error {se}")
        if mean != 0:
            seen.add(math.copysign(apart, mean))
    expect(seen == {0, 1, -1}, "apart either way, and not apart though not the same", seen)


if __name__ == "__main__":
    run_all(__name__)
