#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A loop over scenes in Python, through the handle of the library, against the same scenes as rows of one --each.

bench_handle.py [PROGRAM [SCENES [REPEATS]]]        default ceduo of the build, 1000, 5

100 rocks of each scene, one thread. CSV on stdout: medians; the runs alternate. The loop reads the same three figures."""
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
COLUMNS = "wooded.reach_probability,wooded.energy_kJ.mean,bare.reach_probability"
LOOP = """
import sys
import ceduo
with ceduo.Scene(sys.argv[1]) as scene:
    for line in open(sys.argv[2]).readlines()[1:]:
        scene.set("rock.diameter_m", line.strip())
        scene.simulate(100)
        share = scene.get("options[0].controls[0].wooded.reach_probability")
        energy = scene.get("options[0].controls[0].wooded.energy_kJ.mean")
        bare = scene.get("options[0].controls[0].bare.reach_probability")
"""


def measure(command, env):
    start = time.monotonic()
    subprocess.run(command, env=env, stdout=subprocess.DEVNULL, check=True)
    return time.monotonic() - start


def main():
    program = Path(os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else ROOT / "build/release/ceduo"))
    scenes = int(sys.argv[2]) if len(sys.argv) > 2 else 1000
    repeats = int(sys.argv[3]) if len(sys.argv) > 3 else 5
    env = {**os.environ, "LD_LIBRARY_PATH": str(program.parent), "PYTHONPATH": str(ROOT / "man/examples"), "PYTHONDONTWRITEBYTECODE": "1"}
    with tempfile.TemporaryDirectory() as name:
        table = Path(name) / "table.csv"
        table.write_text("rock.diameter_m\n" + "".join(f"{0.3 + 0.5 * i / scenes}\n" for i in range(scenes)))
        scene = ROOT / "profiles/scenes/paper-site.yaml"
        each = [program, "--batch", "--each", table, "-n", "100", "-j", "1", "-f", "csv", "-q", "--columns", COLUMNS, scene]
        loop = [sys.executable, "-c", LOOP, scene, table]
        rounds = [(measure(each, env), measure(loop, env)) for _ in range(repeats)]
    print("scenes,each_s,python_s,python_over_each")
    print(f"{scenes},{statistics.median(r[0] for r in rounds):.3f},{statistics.median(r[1] for r in rounds):.3f},"
          f"{statistics.median(r[1] / r[0] for r in rounds):.3f}")


if __name__ == "__main__":
    main()
