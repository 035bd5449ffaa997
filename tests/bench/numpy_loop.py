#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The model of tests/physics/slow_walk.c with all rocks of a batch as numpy arrays, on the site of bench_walk.c.

numpy_loop.py [--check BENCH_WALK] [REPEATS [ROCKS]]        default 3, 20000

CSV in the columns of bench_walk on stdout, figures at the control on stderr. With --check the built bench_walk and its table
come first; exit 1 if the figures of its plain loop differ. The number of contacts has no limit: all rocks end.
"""
import re
import subprocess
import sys
import time

import numpy as np

GRAVITY, FRICTION, CONTROL = 9.81, 0.5, 135.0
RADIUS, MASS, K = (0.56 + 0.80) / 4, np.pi / 4 * 0.56**2 * 0.80 * 2600, 0.5  # a cylinder; k = I/(MR2)
START = 0.0, 126.0, 0.3, -0.3  # x, z, vx, vz: on the ground, leaving it: a flight comes first
FRICTION_SPEED, NORMAL_SPEED, SCALING_SPEED = 6.096, 9.144, 76.2  # Pfeiffer & Higgins 1990: 20, 30 and 250 ft/s
SOON = 1e-9  # s: an earlier root is the contact that the rock leaves
BATCH = 4000  # rocks: more exceed the cache, fewer leave most of the time to the interpreter
AGREE = 4.0  # combined standard errors
# Table 3 of Ciabocco et al. 2009: the vertices, and restitutions and roughness of wall, ledge and talus.
VERTEX_X = np.array([0, 10, 13, 26.95, 42.8, 48.11, 56.36, 70.69, 84.66, 97.43, 115.42, 134.59, 144.33, 152.68])
VERTEX_Z = np.array([126, 106, 86, 76, 66, 61, 56, 46, 36, 26, 16, 6, 2, 0])
RN, RT, ROUGHNESS = np.array([(0.31, 0.87, 0.25), (0.40, 0.90, 0.001)] + 11 * [(0.31, 0.83, 0.15)]).T

X0, X1 = VERTEX_X[:-1], VERTEX_X[1:]
SLOPE = np.diff(VERTEX_Z) / np.diff(VERTEX_X)
INTERCEPT = VERTEX_Z[:-1] - SLOPE * X0
ANGLE = np.arctan(SLOPE)
COSINE, SINE = np.cos(ANGLE), np.sin(ANGLE)
LENGTHS = np.concatenate(([0], np.cumsum(np.diff(VERTEX_X) / COSINE)))  # along the ground, up to each vertex
RESTS = np.abs(SLOPE) <= FRICTION
COLUMN = (slice(None), np.newaxis)  # one row per segment, to try all of them on all rocks


class Rocks:
    """Rocks under way, each quantity an array."""

    def __init__(self, n):
        self.x, self.z, self.vx, self.vz = (np.full(n, value) for value in START)
        self.spin = np.zeros(n)
        self.segment, self.contacts = np.zeros(n, np.intp), np.zeros(n, np.intp)
        self.passed, self.ended = np.zeros(n, bool), np.zeros(n, bool)

    def keep(self, which):
        vars(self).update({name: values[which] for name, values in vars(self).items()})

    def append(self, other):
        vars(self).update({name: np.append(values, getattr(other, name)) for name, values in vars(self).items()})


class Run:
    """One law, and the results of its rocks: lists of arrays."""

    def __init__(self, law, roughness):
        self.crsp, self.inertia = law == "crsp", K if law == "crsp" else 0
        self.facet = np.arctan(ROUGHNESS / RADIUS) if roughness == "height" else ROUGHNESS  # largest angle
        self.contacts, self.speed, self.energy = [], [], []
        self.work = np.empty((5, len(X0) * BATCH))  # a new array each time costs more than filling it

    def next_hit(self, r, i):
        """Return time and segment of the next hit of rocks i, all on the ground; infinite time: no hit."""
        x, vx, own, rock = r.x[i], r.vx[i], r.segment[i], np.arange(len(r.x[i]))
        b, c, earlier, later, end = self.work[:, :len(X0) * len(own)].reshape(5, len(X0), len(own))
        np.multiply(SLOPE[COLUMN], -vx / GRAVITY, out=b)  # t = b -+ root(b2 + c), per segment and rock
        b += r.vz[i] / GRAVITY
        np.multiply(SLOPE[COLUMN], -2 / GRAVITY * x, out=c)
        c += 2 / GRAVITY * r.z[i]
        c -= 2 / GRAVITY * INTERCEPT[COLUMN]
        c[own, rock] = 0
        stays = 2 * b[own, rock] <= SOON  # it never leaves the ground
        c += np.multiply(b, b, out=end)
        np.sqrt(c, out=c)  # NaN without a root: every comparison is false
        for t in (np.subtract(b, c, out=earlier), np.add(b, c, out=later)):
            np.multiply(vx, t, out=end)
            end += x
            hits = (t > SOON) & (end >= X0[COLUMN]) & (end <= X1[COLUMN])
            np.copyto(t, np.inf, where=~hits)
        first = np.minimum(earlier, later, out=earlier).min(axis=0)
        segment = np.searchsorted(X1[:-1], x + vx * first)
        return np.where(stays, 0, first), np.where(stays, own, segment)

    def note(self, r, i, speed, spin):
        r.passed[i] = True
        self.speed.append(speed)
        self.energy.append(0.5 * MASS * speed**2 + 0.5 * K * MASS * RADIUS**2 * spin**2)

    def fly(self, r, i, t, segment):
        """Move rocks i to their hits; a rock without a hit leaves the slope."""
        x, vx, vz = r.x[i], r.vx[i], r.vz[i]
        end = x + vx * t
        by = ~r.passed[i] & (x < CONTROL) & (end >= CONTROL)
        if by.any():
            fall = GRAVITY * (CONTROL - x[by]) / vx[by]
            self.note(r, i[by], np.hypot(vx[by], vz[by] - fall), r.spin[i[by]])
        r.x[i], r.z[i] = end, INTERCEPT[segment] + SLOPE[segment] * end
        r.vz[i], r.segment[i], r.ended[i] = vz - GRAVITY * t, segment, np.isinf(t)

    def strike(self, r, random):
        """Apply the law to all rocks on turned facets, or on their segments if they would be leaving the facet."""
        own, cosine, sine = r.segment, COSINE[r.segment], SINE[r.segment]
        angle = ANGLE[own] + np.copysign(self.facet[own] * random.random(len(own)), r.vx * cosine + r.vz * sine)
        c, s = np.cos(angle), np.sin(angle)
        leaves = r.vz * c > r.vx * s
        c, s = np.where(leaves, cosine, c), np.where(leaves, sine, s)
        vt, vn = r.vx * c + r.vz * s, np.maximum(0, r.vx * s - r.vz * c)
        rn, rt = RN[own], RT[own]
        if self.crsp:
            rim = r.spin * RADIUS
            friction = rt + (1 - rt) / (((vt - rim) / FRICTION_SPEED) ** 2 + 1.2)
            scaling = rt / ((vn / (SCALING_SPEED * rn)) ** 2 + 1)
            out = np.sqrt((K * rim**2 + vt**2) * friction * scaling / (1 + K))
            vt = np.copysign(out, np.where(vt != 0, vt, r.spin))
            vn *= rn / (1 + (vn / NORMAL_SPEED) ** 2)
            r.spin = vt / RADIUS
        else:
            vn, vt = rn * vn, rt * vt
        vx, vz = vt * c - vn * s, vt * s + vn * c
        into = np.minimum(0, vz * cosine - vx * sine)
        r.vx, r.vz = vx + into * sine, vz - into * cosine
        r.contacts += 1

    def is_roll(self, r, i, t, segment):
        """True if the flight to the hit stays within a radius in length and height."""
        x, own, end = r.x[i], r.segment[i], r.x[i] + r.vx[i] * t
        vn = r.vz[i] * COSINE[own] - r.vx[i] * SINE[own]
        ground = LENGTHS[segment] - LENGTHS[own] + (end - X0[segment]) / COSINE[segment] - (x - X0[own]) / COSINE[own]
        near = (np.abs(end - x) < RADIUS) & (np.abs(ground) < RADIUS)  # both false without a hit
        return near & (vn**2 < 2 * GRAVITY * RADIUS * COSINE[own])

    def set_rolling(self, r, i, u):
        r.vx[i], r.vz[i] = u * COSINE[r.segment[i]], u * SINE[r.segment[i]]
        r.spin[i] = u / RADIUS if self.crsp else 0

    def pass_vertex(self, r, i, way, u2):
        """Pass the ends of the segments: return the u2 with which rocks i roll on, below 0 for those that fly or left."""
        self.set_rolling(r, i, way * np.sqrt(u2))
        before, after = r.segment[i], r.segment[i] + way
        off = (after < 0) | (after == len(X0))
        after[off] = before[off]
        r.segment[i], r.ended[i] = after, off
        turn = way * (ANGLE[after] - ANGLE[before])
        u2 = np.where(turn > 0, u2 * np.maximum(0, np.cos(turn)) ** 2, u2)
        t, segment = self.next_hit(r, i)
        flies = (turn < 0) & ~self.is_roll(r, i, t, segment)
        self.fly(r, i[flies], t[flies], segment[flies])
        u2[off | flies] = -1
        return u2

    def roll(self, r, i):
        """Rocks i roll a radius along the ground, downhill from rest."""
        own = r.segment[i]
        u = (r.vx[i] * COSINE[own] + r.vz[i] * SINE[own] + self.inertia * r.spin[i] * RADIUS) / (1 + self.inertia)
        u2, left, way = u * u, np.full(len(i), RADIUS), np.sign(u).astype(np.intp)
        while len(i) > 0:
            own = r.segment[i]
            way = np.where(way == 0, np.where(SLOPE[own] > 0, -1, 1), way)
            x, cosine, vertex = r.x[i], COSINE[own], np.where(way > 0, X1[own], X0[own])
            to_vertex = np.abs(vertex - x) / cosine
            ds = np.minimum(left, to_vertex)
            rate = 2 * GRAVITY * (-way * SINE[own] - FRICTION * cosine) / (1 + self.inertia)
            u2_end = u2 + rate * ds
            stands = (ds > 0) & (rate <= 0) & (u2_end <= 0)
            ds = np.where(stands, np.where(rate < 0, np.minimum(ds, -u2 / rate), 0), ds)
            u2_end[stands] = 0
            end = np.where(stands | (ds < to_vertex), x + way * ds * cosine, vertex)
            by = ~r.passed[i] & (x < CONTROL) & (end >= CONTROL)
            if by.any():
                u = np.sqrt(u2[by] + (u2_end - u2)[by] * (CONTROL - x[by]) / (end - x)[by])
                self.note(r, i[by], u, u / RADIUS * self.crsp)
            r.x[i], r.z[i] = end, INTERCEPT[own] + SLOPE[own] * end
            u2, left = u2_end, left - ds
            r.ended[i] = stands & RESTS[own]
            r.contacts[i] += stands & ~RESTS[own]  # these restart downhill
            left[stands], way[stands] = RADIUS, 0
            done = ~stands & (left <= 0)
            self.set_rolling(r, i[done], (way * np.sqrt(u2))[done])
            over = ~stands & ~done
            if over.any():
                u2[over] = self.pass_vertex(r, i[over], way[over], u2[over])
            on = ~done & ~r.ended[i] & (u2 >= 0)
            i, u2, left, way = i[on], u2[on], left[on], way[on]

    def fly_rocks(self, rocks, seed):
        """Step all rocks under way from contact to contact; new ones fill the batch after a quarter has ended."""
        random, r = np.random.default_rng(seed), Rocks(0)
        while rocks > 0 or len(r.x) > 0:
            if rocks > 0 and len(r.x) <= BATCH * 3 // 4:
                new = Rocks(min(rocks, BATCH - len(r.x)))
                i = np.arange(len(new.x))
                self.fly(new, i, *self.next_hit(new, i))
                r.append(new)
                rocks -= len(i)
            self.strike(r, random)
            t, segment = self.next_hit(r, slice(None))
            rolls = self.is_roll(r, slice(None), t, segment)
            flying = np.flatnonzero(~rolls)
            self.fly(r, flying, t[flying], segment[flying])
            self.roll(r, np.flatnonzero(rolls))
            if r.ended.any():
                self.contacts.append(r.contacts[r.ended])
                r.keep(~r.ended)


def measure(law, roughness, repeats, rocks, plain):
    """Print a row of the table and the figures; true if they equal the plain loop's, if there are any."""
    run, seconds, good = Run(law, roughness), [], True
    for seed in range(1, repeats + 1):
        start = time.perf_counter()
        run.fly_rocks(rocks, seed)
        seconds.append(time.perf_counter() - start)
    contacts, speed, energy = (np.concatenate(a) for a in (run.contacts, run.speed, run.energy))
    median, mean = np.median(seconds), contacts.sum() / repeats
    print(f"numpy,{law},against,{roughness},{rocks},{median:.4f},{mean / median:.0f},", flush=True)
    figures = {"contacts per rock": contacts, "share that passes": np.arange(len(contacts)) < len(speed),
               "speed, m/s": speed, "energy, kJ": energy / 1e3}
    for name, values in figures.items():
        mean, error = values.mean(), values.std() / (len(values) - 1) ** 0.5
        text = f"{law} {roughness} {name:17} numpy {mean:10.4f} +- {error:.4f}"
        if plain is not None:  # with the same number of rocks, to four places
            value = plain.get((law, roughness, name), np.nan)
            same = abs(value - mean) <= AGREE * 2**0.5 * error + 0.00005
            text, good = text + f"  plain {value:10.4f}{'' if same else ': DISAGREE'}", good and same
        print(text, file=sys.stderr)
    return good


def main(arguments):
    binary = arguments[1] if arguments[:1] == ["--check"] and len(arguments) > 1 else None
    numbers = arguments[2:] if binary else arguments
    if len(numbers) > 2 or not all(n.isdecimal() and int(n) > 0 for n in numbers):
        sys.exit("usage: numpy_loop.py [--check BENCH_WALK] [REPEATS [ROCKS]]")
    repeats, rocks = [int(n) for n in numbers] + [3, 20000][len(numbers):]
    table, plain = "what,law,facets,roughness,rocks,seconds_median,contacts_per_s,ratio_to_plain", None
    if binary:
        done = subprocess.run([binary, str(repeats), str(rocks)], capture_output=True, text=True)
        lines = re.findall(r"(\w+) (\w+) (.+?) +plain +([-\d.]+) ", done.stderr)
        table, plain = done.stdout.rstrip(), {tuple(names): float(value) for *names, value in lines}
    print(table, flush=True)
    good = [measure(*case, repeats, rocks, plain) for case in (("lumped", "angle"), ("crsp", "height"))]
    return 0 if all(good) else 1


if __name__ == "__main__":
    np.seterr(all="ignore")  # NaN is intended: no root, no hit
    sys.exit(main(sys.argv[1:]))
