#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure speed and arrivals over roughness, noise of the profile, size and length, before and after version 0.5.

bench_ground.py [PROGRAM [ROCKS]]        default ceduo of the build, 1000

"Before" is the same program with the published laws (friction_bound: false) and the grounds of version 0.4. CSV on stdout, one
row per place. `table`: roughness, noise, blocks or length. `way`: see WAYS. `roughness_m`: of the talus; NaN: the library's.
`arrive`: per 1000 rocks, mean, minimum and maximum over the seeds. Speeds in m/s."""
import json
import math
import os
import random
import subprocess
import sys
from pathlib import Path

FACE = ((0, 1012), (8, 1001), (25, 975), (60, 945), (110, 905), (160, 872), (190, 855), (205, 849), (212, 848.2), (218, 848),
        (224, 845), (250, 838), (270, 833))  # cliff to 25 m, talus below, a road at 215 m
PLACES = (110, 190, 215, 240)
ROUGHNESS = (0.02, 0.04, 0.06, 0.08, 0.10, 0.15, 0.20, 0.30, 0.40, 0.50)
SEEDS = 10

# Law, friction bound, and the roughness and friction of cliff and talus
OLD, NEW = (("roughness_rad: 0.05", 0.5), ("roughness_rad: 0.15", 0.5)), (("roughness_m: 0.1", 0.45), ("roughness_m: 0.2", 0.45))
WAYS = {"lumped-0.4": ("lumped", False, OLD), "crsp-0.4": ("crsp", False, OLD), "crsp-0.5": ("crsp", True, NEW)}

SCENE = """\
ceduo: scene/1
title: ground
rock: {{diameter_m: {diameter}, density_kg_m3: 2650}}
release: {{x_m: 0, vx_m_s: 0.5}}
slope:
  vertices_m: [{points}]
  {ground}
controls_m: [{places}]
simulation: {{law: {law}, friction_bound: {bound}, rocks: {rocks}, seed: 1}}
"""


class Bench:
    def __init__(self, program, rocks):
        self.program, self.rocks = program, rocks

    def run(self, points, ground, law, bound, places, diameter):
        """Return the rocks per 1000 that arrive at each place, and their mean speed (NaN: none arrives)."""
        scene = SCENE.format(points=", ".join(f"[{x:.6g}, {z:.8g}]" for x, z in points), ground=ground, law=law,
                             bound=str(bound).lower(), places=", ".join(f"{x:.6g}" for x in places), rocks=self.rocks,
                             diameter=diameter)
        p = subprocess.run([self.program, "--batch", "-f", "json", "-"], input=scene, capture_output=True, text=True, check=False)
        if p.returncode != 0:
            sys.exit(f"bench_ground: {p.stderr}\n{scene}")
        found = [c["bare"] for c in json.loads(p.stdout)["options"][0]["controls"]]
        return [(1000 * a["rocks_reached"] / self.rocks, a["speed_m_s"]["mean"] if a["rocks_reached"] else math.nan)
                for a in found]

    def face(self, points, way, roughness=None):
        law, bound, grounds = WAYS[way]
        if way.endswith("0.5") and roughness is None:
            ground = "materials: [{from_m: 0, to_m: 25, material: cliff}, {from_m: 25, to_m: 270, material: talus}]"
        else:
            cliff, talus = (f"{{rn: {rn}, rt: {rt}, {rough}, friction: {friction}}}" for (rn, rt), (rough, friction) in zip(
                ((0.35, 0.85), (0.315, 0.835)),
                (grounds[0], grounds[1] if roughness is None else (f"roughness_m: {roughness}", grounds[1][1]))))
            ground = f"segments: [{', '.join(cliff if x < 25 else talus for x, _ in points[:-1])}]"
        return self.run(points, ground, law, bound, PLACES, 0.8)

    def plane(self, degrees, metres, way, roughness, diameter):
        """Make a straight slope with a control after each length, along the slope."""
        law, bound, friction = way
        slope, longest = math.radians(degrees), metres[-1] + 10
        points = ((0, longest * math.sin(slope)), (longest * math.cos(slope), 0))
        ground = f"segments: [{{rn: 0.315, rt: 0.835, {roughness}, friction: {friction}}}]"
        return self.run(points, ground, law, bound, [m * math.cos(slope) for m in metres], diameter)


def profile(step, noise, seed):
    """Make the face with a point every `step` metres; every other inner point is moved up or down at random."""
    draw, points = random.Random(seed), []
    for i in range(round(270 / step) + 1):
        x = i * step
        (a, b), (c, d) = next(pair for pair in zip(FACE, FACE[1:]) if x <= pair[1][0])
        points.append((x, b + (d - b) * (x - a) / (c - a) + (draw.gauss(0, noise) if 0 < x < 270 else 0)))
    return points


def write(table, case, way, roughness, place, results):
    arrive, speeds = [r[0] for r in results], [r[1] for r in results if not math.isnan(r[1])]
    mean = sum(speeds) / len(speeds) if speeds else math.nan
    print(f"{table},{case},{way},{roughness},{place},{sum(arrive) / len(arrive):.0f},{min(arrive):.0f},{max(arrive):.0f},"
          f"{mean:.1f}", flush=True)


def main():
    program = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[2] / "build/release/ceduo")
    bench = Bench(program, int(sys.argv[2]) if len(sys.argv) > 2 else 1000)
    print("table,case,way,roughness_m,place_m,arrive,arrive_min,arrive_max,speed_m_s")
    for way in WAYS:
        for roughness in ROUGHNESS:
            for place, found in zip(PLACES, bench.face(FACE, way, roughness)):
                write("roughness", "0.8 m", way, roughness, place, [found])
    for step, noise in (None, 0), *((s, n) for s in (2.5, 1, 0.5) for n in (0.05, 0.1, 0.15)):
        points = [profile(step, noise, seed) for seed in range(SEEDS)] if step else [FACE]
        case = f"{step} m + {100 * noise:.0f} cm" if step else "13 points"
        for way in ("lumped-0.4", "crsp-0.5"):
            for place, results in zip(PLACES, zip(*(bench.face(p, way) for p in points))):
                write("noise", case, way, "NaN", place, results)
    for degrees in (30, 35, 40):
        for diameter in (0.2, 0.5, 1, 2, 4):
            for way, settings in (("lumped-0.4", ("lumped", False, 0.5)), ("crsp-0.4", ("crsp", False, 0.5)),
                                  ("crsp-0.5", ("crsp", True, 0.45))):
                for roughness in (0.02, 0.05, 0.1, 0.2, 0.35, 0.5):
                    found = bench.plane(degrees, (200,), settings, f"roughness_m: {roughness}", diameter)
                    write("blocks", f"{degrees} deg {diameter} m", way, roughness, 200, found)
    laws = [(law, bound, 0.8) for law in ("lumped", "crsp", "arm") for bound in (False, True)]
    for law, bound, diameter in laws + [("crsp", True, 0.5), ("crsp", True, 1), ("crsp", True, 2), ("crsp", True, 4)]:
        lengths = (150, 300, 1000, 3000)
        for place, found in zip(lengths, bench.plane(38, lengths, (law, bound, 0.45), "roughness_m: 0.2", diameter)):
            write("length", f"38 deg {diameter} m", f"{law}-{'bound' if bound else 'published'}", 0.2, place, [found])


if __name__ == "__main__":
    main()
