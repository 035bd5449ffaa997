# SPDX-License-Identifier: GPL-3.0-or-later
"""Observations on the slope of a random scene: all kinds, also at the slope's ends, sometimes with an error. They have their
own random numbers, so that the scene does not depend on them."""
import math
import random

SHARE, WRONG = 0.25, 0.25  # share of scenes with observations; share of these with one error


class Seen:
    """Draws the rows of one scene."""

    def __init__(self, case):
        self.case, self.rng = case, random.Random(f"seen {case.index}")
        self.lo, self.hi = case.xs[0], case.xs[-1]

    def place(self, lo):
        """Draw a place on the slope from lo on, one in three at an end."""
        return self.rng.choice([lo, self.hi, *[min(max(self.rng.uniform(lo, self.hi), lo), self.hi) for _ in range(4)]])

    def beyond_release(self):
        return self.place(math.nextafter(self.case.last_start, math.inf))

    def stretch(self):
        """Return two ends, or None if the slope is too short."""
        a, b = sorted([self.place(self.lo), self.place(self.lo)])
        a, b = (a, b) if a < b else (self.lo, self.hi)
        return {"from_m": a, "to_m": b}

    def sample(self, most):
        """Return values, or their mean."""
        rng = self.rng
        if rng.random() < 0.4:
            return {"mean": rng.choice([0, rng.uniform(0, most)]), "sd": rng.choice([0, most, rng.random()]),
                    "n": rng.choice([1, 2, 30, 10**9])}
        same = rng.uniform(0, most)
        return {"values": [rng.choice([0, same, rng.uniform(0, most)]) for _ in range(rng.randint(1, 12))]}

    def stops(self):
        xs = [self.place(self.lo) for _ in range(self.rng.choice([1, 2, 5, 40]))]
        row = self.rng.choice([{}, {"of": len(xs)}, {"of": len(xs) + 7}, {"seen_from_m": min(xs)}])
        if self.rng.random() < 0.3:
            name = f"s{self.case.index}-seen.csv"
            self.case.files[name] = "\n".join(["id;x_m", *(f"{i};{x!r}" for i, x in enumerate(xs)), ""])
            return {"csv": name, **row}
        return {"x_m": xs, **row}

    def passed(self):
        of = self.rng.choice([1, 9, 10**9])
        return {"x_m": self.beyond_release(), "count": self.rng.choice([0, 1, of]), "of": of}

    def crossing(self):
        return {"x_m": self.beyond_release(), **self.sample(30)}

    def largest(self):
        return {key: self.sample(30) for key in self.rng.sample(["speed_m_s", "height_m"], self.rng.randint(1, 2))}

    def on_the_way(self):
        keys = self.rng.sample(["speed_m_s", "height_m", "energy_kJ"], self.rng.randint(1, 3))
        return {**self.stretch(), **{key: self.sample(30) for key in keys}}

    def scars(self):
        row = {**self.stretch(), "height_m": [self.rng.uniform(0, 3) for _ in range(self.rng.randint(1, 9))]}
        return {**row, **self.rng.choice([{}, {"of": 3}, {"of": 30, "share_seen": 1}, {"share_seen": 0.5}])}

    def row(self, i):
        kinds = {"stops": self.stops, "passed": self.passed, "speed": self.crossing, "height": self.crossing,
                 "energy": self.crossing, "largest": self.largest, "on_the_way": self.on_the_way, "scars": self.scars}
        row = {kind: kinds[kind]() for kind in self.rng.sample(sorted(kinds), self.rng.choice([1, 1, 2]))}
        options = [option["name"] for option in self.case.scene.get("options", [])]
        if options and self.rng.random() < 0.7:
            row["option"] = self.rng.choice(options)
        row["use"] = "fit" if i == 0 else self.rng.choice(["fit", "check"])
        if self.rng.random() < 0.3:
            row["name"] = self.rng.choice(["spring", "日本", "a; b", "x: y # z"]) + f" {i}"
        if self.rng.random() < 0.2:
            row["rock"] = {"shape": "block", "axes_m": [0.9, 0.7, 0.6]}
        return row

    def spoil(self, rows):
        """Return one invalid row, and the key that the message names."""
        at, off = self.rng.choice([0.5, 1e3]), self.rng.choice([self.lo - 1, self.hi + 1])
        end = math.nextafter(self.case.last_start, math.inf)
        wrong, key = self.rng.choice([
            ({"stops": {"x_m": [off]}}, "x_m"), ({"stops": {"x_m": [self.lo], "seen_from_m": off}}, "seen_from_m"),
            ({"stops": {"x_m": [self.hi] * 3, "of": 2}}, "of"), ({"stops": {"x_m": []}}, "x_m"),
            ({"stops": {"x_m": [self.lo], "seen_from_m": self.hi}}, "x_m"), ({"passed": {"x_m": end, "count": 3, "of": 2}}, "of"),
            ({"passed": {"x_m": end, "count": 0, "of": 0}}, "of"), ({"passed": {"x_m": self.case.last_start, "count": 0, "of": 1}}, "x_m"),
            ({"speed": {"x_m": end, "values": [1, -at]}}, "values"), ({"speed": {"x_m": end, "mean": -at, "sd": 1, "n": 2}}, "mean"),
            ({"height": {"x_m": end, "mean": at, "sd": 1}}, "height"), ({"energy": {"x_m": end}}, "energy"),
            ({"energy": {"x_m": end, "mean": at, "sd": -1, "n": 3}}, "sd"), ({"largest": {"height_m": {"values": [-at]}}}, "values"),
            ({"on_the_way": {"from_m": self.hi, "to_m": self.lo, "speed_m_s": {"values": [1]}}}, "to_m"),
            ({"on_the_way": {"from_m": self.lo, "to_m": off, "speed_m_s": {"values": [1]}}}, "to_m"),
            ({"scars": {"from_m": self.lo, "to_m": self.lo, "height_m": [1]}}, "to_m"),
            ({"scars": {"from_m": self.lo, "to_m": self.hi, "height_m": [1], "share_seen": 0}}, "share_seen"),
            ({"stops": {"x_m": [self.lo]}, "option": "no such option"}, "option"), ({"use": "fit"}, "observed"),
            ({"stops": {"csv": "no-such-table.csv"}}, "csv")])
        rows.insert(self.rng.randint(0, len(rows)), wrong)
        self.case.broken, self.case.key = f"observed: {wrong}", key


def draw(case):
    """Add `observed` to a valid scene."""
    seen = Seen(case)
    if case.broken or seen.rng.random() > SHARE or seen.hi - seen.lo < 1e-3 or seen.lo - 1 == seen.lo:
        return
    rows = [seen.row(i) for i in range(seen.rng.choice([1, 1, 2, 3]))]
    if seen.rng.random() < WRONG:
        seen.spoil(rows)
    case.scene["observed"] = rows
