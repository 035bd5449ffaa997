#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""f on every kind of number proposes a range whose ends are valid."""
import re
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import FAST, Place, home  # noqa: E402
from harness import CEDUO, DONE, PATIENCE, expect, expect_equal, run_all  # noqa: E402

# view, path, unit of the file in a displayed unit
FIELDS = [(1, "forest[0].from_m", 1), (1, "forest[0].to_m", 1), (1, "forest[1].from_m", 1), (1, "forest[1].to_m", 1),
          (1, "controls[0].x_m", 1), (1, "controls[1].x_m", 1), (1, "controls[1].accepted_kJ", 1),
          (1, "slope.segments[0].rn", 1), (1, "slope.segments[1].rt", 1), (1, "slope.segments[1].friction", 1),
          (2, "forest[0].stand.stools.per_ha", 1), (2, "forest[0].stand.stools.spacing_m", 1),
          (2, "forest[0].stand.shoots[0].per_ha", 1), (2, "forest[0].stand.shoots[0].dbh_m", 0.01),
          (2, "forest[0].stand.shoots[1].per_ha", 1), (2, "forest[0].stand.trees[0].per_ha", 1),
          (2, "forest[0].stand.trees[1].height_m", 1), (2, "forest[0].stand.energy.u_J_m3", 1),
          (3, "rock.diameter_m", 1), (3, "rock.density_kg_m3", 1), (3, "release.height_m", 1), (3, "release.vx_m_s", 1),
          (3, "simulation.threshold_m", 1), (3, "simulation.rocks", 1), (3, "simulation.gravity_m_s2", 1)]


def accepts(place, scene, path, value):
    done = subprocess.run([CEDUO, "--check", "-s", f"{path}={value:.12g}", scene], cwd=place.path, env=home(place.path),
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=PATIENCE, check=False)
    return done.returncode == DONE


def test_ranges():
    """Both ends of the proposed range of f are valid values, and contain the current one."""
    with Place() as place:
        script = "".join(f"key {view}\nfind {path}\nkey f\ndump\nkey Esc\n" for view, path, _ in FIELDS)
        screens = place.play(script, "fast.yaml")
        for (_, path, per), screen in zip(FIELDS, screens, strict=True):
            found = re.search(r"values from +(\S+) to +(\S+)", screen.popup)
            expect(found, f"{path}: no range in", screen)
            lo, hi = (float(x) * per for x in found.groups())
            expect(lo <= hi, path, lo, hi)
            expect(accepts(place, "fast.yaml", path, lo), f"{path}: the scene refuses {lo}, the lower end")
            expect(accepts(place, "fast.yaml", path, hi), f"{path}: the scene refuses {hi}, the upper end")
        words = re.search(r"values from +(\S+) to +(\S+)", screens[10].popup).groups()
        expect_equal(words, ("300", "9500"), "stools per ha: each stool needs one, 9500 shoots stand there")


def test_ranges_of_places():
    """If the profile begins at 100 m the range of a place ends at the profile's end, at 200 m."""
    moved = FAST
    for old, new in (("[[0, 80], [60, 30], [100, 0]]", "[[100, 80], [160, 30], [200, 0]]"), ("x_m: 60", "x_m: 160"), ("x_m: 80", "x_m: 180"),
                     ("from_m: 5\n", "from_m: 105\n"), ("to_m: 45\n", "to_m: 145\n"), ("from_m: 50\n", "from_m: 150\n"), ("to_m: 80\n", "to_m: 180\n")):
        expect(old in moved, old)
        moved = moved.replace(old, new)
    with Place() as place:
        place.write("moved.yaml", moved)
        for path, now in (("controls[1].x_m", 180), ("forest[1].to_m", 180)):
            screen = place.play(f"key 1\nfind {path}\nkey f\ndump", "moved.yaml")[0]
            lo, hi = (float(x) for x in re.search(r"values from +(\S+) to +(\S+)", screen.popup).groups())
            expect(100 <= lo < now and hi == 200, path, lo, hi)


if __name__ == "__main__":
    run_all(__name__)
