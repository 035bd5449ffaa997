#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Many small scenes in one call: a valley of profiles that share one slope, by the index, 100 rocks each, one of them invalid.

bench_valley.py [PROGRAM [SCENES [REPEATS]]]        default ceduo of the build, 10000, 3

CSV on stdout: medians. Peak memory shows whether it grows with the scenes."""
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SCENE = """\
ceduo: scene/1
title: profile {i}
rock: {{shape: sphere, diameter_m: {diameter}}}
release: {{vx_m_s: 0.5}}
slope: paper.yaml
controls: [{{x_m: 135, name: road, accepted_kJ: 50}}]
forest: [{{from_m: 10, to_m: 130, stand: wood.yaml}}]
simulation: {{rocks: 100, contact_model: index}}
"""


def high_water(pid):
    """Return the peak memory of a process in MiB; 0 if it has ended."""
    try:
        status = Path(f"/proc/{pid}/status").read_text()
    except OSError:
        return 0
    found = re.search(r"VmHWM:\s+(\d+)", status)
    return int(found[1]) / 1024 if found else 0


def run(program, folder, files):
    """Return seconds and peak memory."""
    start = time.monotonic()
    p = subprocess.Popen([program, "--batch", "-f", "csv", "-o", "out.csv", *files], cwd=folder, stderr=subprocess.DEVNULL)
    peak = 0
    while p.poll() is None:
        peak = max(peak, high_water(p.pid))
        time.sleep(0.005)
    seconds = time.monotonic() - start
    rows = (folder / "out.csv").read_text().count("\n") - 1
    if p.returncode != 3 or rows != len(files) - 1:
        sys.exit(f"bench_valley: status {p.returncode}, {rows} rows of {len(files)} scenes")
    return seconds, peak


def main():
    program = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[2] / "build/release/ceduo")
    most = int(sys.argv[2]) if len(sys.argv) > 2 else 10000
    repeats = int(sys.argv[3]) if len(sys.argv) > 3 else 3
    profiles = Path(__file__).resolve().parents[2] / "profiles"
    print("scenes,seconds_median,scenes_per_s,peak_MiB")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "paper.yaml").write_text((profiles / "slopes/paper.yaml").read_text())
        (folder / "wood.yaml").write_text((profiles / "stands/simple-coppice.yaml").read_text())
        for i in range(most):
            text = SCENE.format(i=i, diameter=0.3 + 0.5 * i / most)
            (folder / f"{i:05}.yaml").write_text(text if i != most // 2 else text.replace("scene/1", "scene/9"))
        for scenes in (most // 10, most):
            first = most // 2 - scenes // 2
            files = [f"{i:05}.yaml" for i in range(first, first + scenes)]
            found = [run(program, folder, files) for _ in range(repeats)]
            seconds = statistics.median(f[0] for f in found)
            print(f"{scenes},{seconds:.3f},{scenes / seconds:.0f},{max(f[1] for f in found):.1f}", flush=True)


if __name__ == "__main__":
    main()
