#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Write the results of the benches into pages, between their marks .\\" begin NAME and .\\" end NAME, in README as comments.

    tables.py [--check] PAGE...         reads tests/bench/results; --check writes nothing, and fails if a page is stale"""
import csv
import errno
import math
import re
import sys
from pathlib import Path


def digits(value, n=3):
    """Format a number with n significant digits, without exponent within the readable range."""
    x = float(value)
    if x == 0 or not math.isfinite(x):
        return "0" if x == 0 else "-"
    if not 1e-4 <= abs(x) < 1e7:
        mantissa, exponent = f"{x:.{n - 1}e}".split("e")
        return f"{mantissa}e{int(exponent)}"
    return f"{x:.{max(0, n - 1 - math.floor(math.log10(abs(x))))}f}"


def table(head, rows):
    """Return an mdoc table; each column is as wide as its widest cell."""
    rows = [[str(c) for c in row] for row in rows]
    widths = [max(len(c) for c in column) for column in zip(head, *rows)]
    out = [".Bl -column " + " ".join('"' + "m" * w + '"' for w in widths)]
    out.append(".It " + " Ta ".join(f'Em "{c}"' if " " in c else f"Em {c}" if c else "" for c in head))
    out += [".It " + " Ta ".join(c.replace("-", "\\-") if re.fullmatch(r"-?[\d.e-]+", c) else c for c in row) for row in rows]
    return "\n".join([*out, ".El"])


class Results:
    def __init__(self, folder):
        self.folder = Path(folder)
        self.made = self.rows("made")

    def machine_of(self, bench):
        made = next(r for r in self.made if r["bench"] == bench)
        return made["processor"], made["cores"], made["compiler"], made["kernel"]

    def rows(self, name, **only):
        with open(self.folder / f"{name}.csv", encoding="utf-8") as f:
            found = [r for r in csv.DictReader(f) if all((r.get(k) or "") == v for k, v in only.items())]
        if not found:  # the bench has these rows since a later version
            raise FileNotFoundError(errno.ENOENT, "no such rows", f.name)
        return found

    # ---- one function per table ----

    def machine(self):
        machines = dict.fromkeys(self.machine_of(r["bench"]) for r in self.made)
        number = {m: str(i + 1) for i, m in enumerate(machines)}
        said = ["; ".join(cell for cell in (m[0], f"{m[1]} cores" if m[1] else "", *m[2:]) if cell) for m in machines]
        return "\n".join([".Bl -enum -compact", *[f".It\n{line}" for line in said], ".El",
                          table(["bench", "machine", "date", "commit"],
                                [[r["bench"], number[self.machine_of(r["bench"])], r["date"], r["commit"]] for r in self.made])])

    def walk(self):
        out = []
        for law in ("lumped", "crsp"):
            rows = self.rows("bench_walk", law=law, forest="")
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
                     [[r["figure"], digits(r["true_value"], 4), digits(r["mean_half_width"], 2), r["held_percent"]] for r in self.rows("bench_coverage")])

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
        return table(["program", "rocks", "ns/rock", "ns/contact", "ns/hit", "plain loop = 1"],
                     [[r["what"].replace("ceduo-", ""), r["rocks"], digits(float(r["seconds_median"]) / float(r["rocks"]) * 1e9),
                       digits(r["ns_per_contact"]), digits(r["ns_per_hit"]), digits(r["ratio_to_plain"], 2)]
                      for r in self.rows("bench_walk", forest="stems")])

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

    def laws(self):
        return table(["place", "kernel", "law", "contacts a rock", "ns a contact", "a rock, lumped = 1", "a contact"],
                     [[r["place"], r["kernel"], r["law"], r["contacts_a_rock"], digits(r["ns_a_contact"]), r["rock_to_lumped"],
                       r["contact_to_lumped"]] for r in self.rows("bench_laws")])

    def kernels(self):
        rows = self.rows("bench_kernels")
        kernels = list(dict.fromkeys(r["kernel"] for r in rows))
        return table(["place", *kernels],
                     [[place, *[next((r["ratio_to_plain"] for r in rows if (r["scene"], r["kernel"]) == (place, k)), "-") for k in kernels]]
                      for place in dict.fromkeys(r["scene"] for r in rows)])

    def uncertainty(self):
        return table(["scene", "years", "inputs", "points", "rocks", "evaluations", "processor s"],
                     [[Path(r["scene"]).stem, r["years"], r["inputs"], r["points"], r["rocks"], r["evaluations"],
                       digits(r["cpu_seconds_median"])] for r in self.rows("bench_uncertainty")])

    def uncertainty_error(self):
        return table(["design", "points", "rocks", "scenes", "cpu s", "band", "held, %", "shares, %", "held, %"],
                     [[r["design"], r["points"], r["rocks"], r["scenes"], digits(r["cpu_seconds"]), digits(r["band_of_1000"], 2),
                       r["band_held_percent"] or "\\-", digits(r["shares_percent"], 2), r["shares_held_percent"] or "\\-"]
                      for r in self.rows("bench_uncertainty_error")])

    def keys(self):
        return table(["scene", "keys in", "keys", "median, ms", "p99, ms", "most, ms"],
                     [[Path(r["scene"]).stem, r["what"], r["keys"], r["median_ms"], r["p99_ms"], r["most_ms"]]
                      for r in self.rows("bench_keys")])

    def verdict(self):
        return table(["scene", "when", "seeds", "clear at 1024", "at 10240", "no longer", "reversed"],
                     [list(r.values()) for r in self.rows("bench_verdict")])

    # ---- ground: before and after version 0.5 ----

    def ground(self, table, place=None, **only):
        return [r for r in self.rows("bench_ground", table=table, **only) if place is None or r["place_m"] == place]

    def roughness(self):
        """Draw bars of rocks that reach the road, and of their speed above it."""
        def bars(rows, share_rows):
            speed, share = float(rows["speed_m_s"]), float(share_rows["arrive"])
            return f"{share:4.0f} {'#' * round(share / 100):10}", f"{speed:4.1f} {'#' * round(speed / 4):8}"

        lines = ["roughness   of 1000 at the road               mean speed at 190 m, m/s",
                 "        m   0.4.0            0.5              0.4.0          0.5"]
        for roughness in dict.fromkeys(r["roughness_m"] for r in self.ground("roughness")):
            at = [bars(*(self.ground("roughness", place, way=way, roughness_m=roughness)[0] for place in ("190", "215")))
                  for way in ("lumped-0.4", "crsp-0.5")]
            lines.append(f"{float(roughness):9.2f}   {at[0][0]}  {at[1][0]}  {at[0][1]}  {at[1][1]}".rstrip())
        return "\n".join([".Bd -literal", *lines, ".Ed"])

    def noise(self, column, head):
        ways, places, out = ("lumped-0.4", "crsp-0.5"), ("110", "190", "215", "240"), []
        for way in ways:
            for case in dict.fromkeys(r["case"] for r in self.ground("noise")):
                at = [self.ground("noise", place, way=way, case=case)[0] for place in places]
                row = ["-" if r[column] == "nan" else r[column] for r in at]
                if column == "arrive":
                    row.insert(3, f"{at[2]['arrive_min']}\\(en{at[2]['arrive_max']}")
                out.append([way.split("-")[1], case.replace(" + ", ", "), *row])
        return table(["version", "points", head, "190 m", "215 m", *(["range"] if column == "arrive" else []), "240 m"], out)

    def noise_shares(self):
        return self.noise("arrive", "of 1000 at 110 m")

    def noise_speeds(self):
        return self.noise("speed_m_s", "m/s at 110 m")

    def blocks(self):
        out = []
        for case in dict.fromkeys(r["case"] for r in self.ground("blocks")):
            degrees, _, diameter, _ = case.split()
            for way in ("lumped-0.4", "crsp-0.5"):
                out.append([f"{degrees}\\(de", diameter, way.split("-")[1],
                            *(r["speed_m_s"] for r in self.ground("blocks", case=case, way=way))])
        heights = list(dict.fromkeys(r["roughness_m"] for r in self.ground("blocks")))
        return table(["slope", "block, m", "version", f"m/s, S {heights[0]} m", *(f"S {s}" for s in heights[1:])], out)

    def lengths(self):
        rows = self.ground("length")
        places = list(dict.fromkeys(r["place_m"] for r in rows))
        runs = dict.fromkeys((r["way"], r["case"]) for r in rows)
        out = [[*way.split("-"), case.split()[2], *(r["speed_m_s"] for r in rows if (r["way"], r["case"]) == (way, case))]
               for way, case in runs]
        return table(["law", "friction", "block, m", f"m/s after {places[0]} m", *(f"{p} m" for p in places[1:])],
                     [[law, {"bound": "bound", "published": "as published"}[bound], *rest] for law, bound, *rest in out])

    # ---- ceduo-validation(7) ----

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

    # ---- calibration ----

    def fits_of(self, law):
        return self.rows("bench_calibration", made_by=law)

    def calibration(self):
        """Return the shares of the sites with their 95 % intervals, and the distance of p from the uniform law."""
        own, other = self.fits_of("lumped"), self.fits_of("crsp")
        names = ("rn", "rt", "roughness_rad")
        held = {n: [float(r[f"{n}_lo"]) <= float(r[n]) <= float(r[f"{n}_hi"]) for r in own] for n in names}
        rows = [[f"95 % range of {n} holds the truth", len(own), share(held[n])] for n in names]
        rows.append(["95 % ranges hold the truth", len(own), share([h for n in names for h in held[n]])])
        for word in ("stops", "speeds", "heights"):
            p = sorted(float(r[f"p_{word}"]) for r in own)
            rows.append([f"p of {word}: distance to the uniform law, and p of that", len(p), uniform(p)])
        rows.append(["called a misfit", len(own), share([r["misfit"] == "1" for r in own])])
        rows.append(["called a misfit where crsp made what 200 rocks did", len(other), share([r["misfit"] == "1" for r in other])])
        rows.append(["range over 80 % of the bounds", len(own), share([r[f"{n}_determined"] == "0" for n in names for r in own])])
        rows.append(["chains settled", len(own), share([r["settled"] == "1" for r in own])])
        return table(["what", "sites", "share"], rows)

    def fit(self):
        return table(["site", "runs", "independent draws", "processor s", "s, two threads"],
                     [[r["site"], r["evaluations"], r["effective_size"], r["processor_s"], r["seconds"]] for r in self.rows("bench_fit")])


def share(held):
    """Return a share in percent and its 95 % interval (Wilson 1927)."""
    n, p, z = len(held), sum(held) / len(held), 1.96
    middle, half = (p + z * z / (2 * n)) / (1 + z * z / n), z * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n)) / (1 + z * z / n)
    return f"{100 * p:.1f} % ({100 * max(0, middle - half):.1f}\\(en{100 * min(1, middle + half):.1f})"


def uniform(p):
    """Return the Kolmogorov-Smirnov distance and its probability for uniform numbers (Stephens 1970)."""
    n = len(p)
    most = max(max(x - i / n, (i + 1) / n - x) for i, x in enumerate(p))
    scaled = most * (math.sqrt(n) + 0.12 + 0.11 / math.sqrt(n))
    chance = 2 * sum((-1) ** (k - 1) * math.exp(-2 * k * k * scaled * scaled) for k in range(1, 100))
    return f"{most:.2f} ({min(1, max(0, chance)):.2f})"


# marks of a table's begin and end
MARKS = (r'\.\\" begin (\w+)\n.*?\.\\" end \1\n', '.\\" begin {0}\n{1}\n.\\" end {0}\n'), \
    (r"<!-- begin (\w+) -->\n.*?<!-- end \1 -->\n", "<!-- begin {0} -->\n{1}\n<!-- end {0} -->\n")


def main():
    pages = [Path(p) for p in sys.argv[1:] if p != "--check"]
    results = Results(Path(__file__).parent / "results")
    stale = False

    def fill(name):
        try:
            return getattr(results, name)()
        except FileNotFoundError as e:
            return f"(not measured yet: make bench ONLY={Path(e.filename).stem})"

    for page in pages:
        text = filled = page.read_text(encoding="utf-8")
        for pattern, form in MARKS:
            filled = re.sub(pattern, lambda found: form.format(found[1], fill(found[1])), filled, flags=re.S)
        if filled != text and "--check" in sys.argv:
            stale = True
            print(f"{page} is not what tests/bench/results has: make tables")
        elif filled != text:
            page.write_text(filled, encoding="utf-8")
    sys.exit(stale)


if __name__ == "__main__":
    main()
