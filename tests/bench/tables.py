#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes what the benches found into the tables of a manual page, between its marks .\\" begin NAME and .\\" end NAME.

    tables.py PAGE [RESULTS]        default tests/bench/results"""
import csv
import math
import re
import sys
from pathlib import Path


def digits(value, n=3):
    """A number with n significant digits and no exponent, as far as it is of a size to be read."""
    x = float(value)
    if x == 0 or not math.isfinite(x):
        return "0" if x == 0 else "-"
    if not 1e-4 <= abs(x) < 1e7:
        mantissa, exponent = f"{x:.{n - 1}e}".split("e")
        return f"{mantissa}e{int(exponent)}"
    return f"{x:.{max(0, n - 1 - math.floor(math.log10(abs(x))))}f}"


def table(head, rows):
    """An mdoc table; every column as wide as its widest cell."""
    rows = [[str(c) for c in row] for row in rows]
    widths = [max(len(c) for c in column) for column in zip(head, *rows)]
    out = [".Bl -column " + " ".join('"' + "m" * w + '"' for w in widths)]
    out.append(".It " + " Ta ".join(f'Em "{c}"' if " " in c else f"Em {c}" if c else "" for c in head))
    out += [".It " + " Ta ".join(c.replace("-", "\\-") if re.fullmatch(r"-?[\d.e-]+", c) else c for c in row) for row in rows]
    return "\n".join([*out, ".El"])


class Results:
    def __init__(self, folder):
        self.folder = Path(folder)

    def rows(self, name, **only):
        with open(self.folder / f"{name}.csv", encoding="utf-8") as f:
            return [r for r in csv.DictReader(f) if all(r[k] == v for k, v in only.items())]

    # ---- one function a table ----

    def machine(self):
        lines = (self.folder / "machine.txt").read_text(encoding="utf-8").splitlines()
        return "\n".join([".Bl -item -compact", *[f".It\n{line}" for line in lines], ".El"])

    def walk(self):
        out = []
        for law in ("lumped", "crsp"):
            rows = self.rows("bench_walk", law=law)
            plain = next(float(r["contacts_per_s"]) for r in rows if r["what"] == "plain-loop")
            for r in [*self.rows("numpy_loop", law=law), *rows]:
                out.append([law, r["what"].replace("ceduo-", ""), r["rocks"], digits(float(r["contacts_per_s"]) / 1e6),
                            digits(float(r["contacts_per_s"]) / plain, 2)])
        return table(["law", "program", "rocks", "million contacts/s", "plain loop = 1"], out)

    def profiles(self):
        return table(["profile", "law", "vertices", "ns/contact", "13 segments = 1"],
                     [[r["profile"], r["law"], r["vertices"], digits(r["ns_per_contact"]), digits(r["ratio_to_13_segments"], 2)]
                      for r in self.rows("bench_profiles")])

    def error(self):
        names = ("mean_energy_kJ", "p95_energy_kJ", "reach", "exceed")
        out = []
        for what in ("paper-bare", "paper-stems"):
            rows = self.rows("bench_error", what=what)
            for rocks in dict.fromkeys(r["rocks"] for r in rows):
                here = {r["quantity"]: r for r in rows if r["rocks"] == rocks}
                first = next(iter(here.values()))
                out.append([what.removeprefix("paper-"), rocks, digits(float(first["seconds"]) * 1e3),
                            *[digits(here[n]["rms_error"]) if n in here else "-" for n in names]])
        return table(["run", "rocks", "ms", "mean, kJ", "95 %, kJ", "reach", "exceed"], out)

    def gain(self):
        rows = self.rows("bench_error")
        out = []
        for what in ("one-start", "spread-starts"):
            for numbers in ("antithetic-starts", "antithetic", "sobol"):
                line = [what, numbers]
                for name in ("mean_energy_kJ", "p95_energy_kJ", "reach", "exceed"):
                    gains = sorted(float(r["gain"]) for r in rows if (r["what"], r["numbers"], r["quantity"]) ==
                                   (what, numbers, name))
                    line.append(digits(gains[len(gains) // 2], 2) if gains else "-")
                out.append(line)
        return table(["starts", "numbers", "mean", "95 %", "reach", "exceed"], out)

    def coverage(self):
        return table(["figure", "true value", "half width", "held, %"],
                     [[r["figure"], digits(r["true_value"], 4), digits(r["mean_half_width"], 2), r["held_percent"]]
                      for r in self.rows("bench_coverage")])

    def stepping(self):
        return table(["way", "step", "ns/flight", "error, m", "largest, m", "beyond 1 m"],
                     [[r["what"], "-" if r["what"] == "exact" else digits(r["step_s_or_tolerance"], 1), digits(r["ns_per_flight"]),
                       digits(r["rms_error_m"], 2), digits(r["largest_error_m"], 2), r["beyond_1_m"]]
                      for r in self.rows("bench_stepping")])

    def rounding(self):
        return table(["model", "rounding", "contact 1", "5", "10", "20", "40", "speed off, s.e."],
                     [[r["law"], r["mode"], *[digits(r[f"apart_at_{n}"], 2) for n in (1, 5, 10, 20, 40)],
                       digits(r["speed_off_in_se"], 1)] for r in self.rows("bench_rounding") if r["mode"] == "upward"])

    def stems(self):
        rows = self.rows("bench_stems")
        return table(list(rows[0]), [list(r.values()) for r in rows])

    def rotation(self):
        return table(["scene", "options", "years", "rocks", "runs", "seconds", "processor s"],
                     [[Path(r["scene"]).stem, r["options"], r["years"], r["rocks"], r["runs"], digits(r["seconds_median"]),
                       digits(r["cpu_seconds_median"])] for r in self.rows("bench_rotation")])

    def live(self):
        rows = self.rows("bench_live")
        return table(list(rows[0]), [list(r.values()) for r in rows])

    def valley(self):
        rows = self.rows("bench_valley")
        return table(["scenes", "seconds", "scenes/s", "peak MiB"], [list(r.values()) for r in rows])

    def fits(self, what):
        return self.rows("bench_tschamut", what=what)

    def tschamut(self):
        blocks = ("block1", "block2", "plate")
        words = {"block1": "block 1", "all": "all three"}
        band = self.fits("band")[0]
        rows = [["95 % point", "", *(digits(band[f"ks_{b}"]) for b in blocks), "", "", ""]]
        for what, said in words.items():
            rows += [[r["law"], said, *(digits(r[f"ks_{b}"]) for b in blocks), *(r[f"mean_{b}_m"] for b in blocks)]
                     for r in self.fits(what)]
        return table(["law", "fitted to", "block 1", "block 2", "plate", "block 1, m", "block 2, m", "plate, m"], rows)

    def grounds(self):
        return table(["law", "fitted to", "Rn", "roughness, rad", "friction", "Rt or mu"],
                     [[r["law"], said, *(digits(r[k], 2) for k in ("rn", "roughness_rad", "friction", "rt_or_mu"))]
                      for what, said in (("block1", "block 1"), ("all", "all three")) for r in self.fits(what)])

    def shares(self):
        return table(["law", "not refuted", "block 2", "plate", "both"],
                     [[r["law"], *(r[k] for k in ("not_refuted", "predict_block2", "predict_plate", "predict_both"))]
                      for r in self.fits("share")])


def main():
    page = Path(sys.argv[1])
    results = Results(sys.argv[2] if len(sys.argv) > 2 else Path(__file__).parent / "results")
    text = page.read_text(encoding="utf-8")

    def fill(found):
        return f'.\\" begin {found[1]}\n{getattr(results, found[1])()}\n.\\" end {found[1]}\n'

    page.write_text(re.sub(r'\.\\" begin (\w+)\n.*?\.\\" end \1\n', fill, text, flags=re.S), encoding="utf-8")


if __name__ == "__main__":
    main()
