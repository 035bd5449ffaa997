# SPDX-License-Identifier: GPL-3.0-or-later
"""Random scenes from the program's own table of parameters.

The table has each parameter's type and range. This file adds the rest: how a profile, a rock, belts and stools fit together,
and usual values of some parameters. A new parameter is drawn from its row without a change here.
"""
import json
import math
import random
import re

import random_observed

# ---- the table ----

ROW = re.compile(r"(\S+)\s+((?:\d+ )?\S+)\s+(\S+)\s+((?:>=? )?\S+)\s+(\S+)\s+(.*)")
HEAD = ["path", "type", "unit", "range", "default", "meaning"]
TYPES = {"text", "word", "words", "flag", "number", "number~", "numbers", "3 numbers~", "count", "points", "file"}
MOST = 1e9         # for a number without a range
COUNT_MOST = 2**53  # for a count


class Parameter:
    """A row of the table."""

    def __init__(self, path, kind, unit, limits, default):
        self.path, self.kind, self.unit, self.default = path, kind, unit, default
        self.key = path.split(".")[-1]
        self.words = limits.split("|") if kind == "word" else []
        self.lo = self.hi = None
        self.above = self.under = False  # an excluded end of the range
        self.rounded = 0.0               # the shown end may exceed the true one by this factor
        if kind != "word" and limits != "-":
            self.read_limits(limits)

    def read_limits(self, text):
        if "…" in text:
            lo, hi = text.split("…")
        else:
            lo, hi = text.lstrip(">= "), ""
        self.above = text.startswith(">") and not text.startswith(">=")
        self.under = hi.startswith("<")
        lo, hi = lo.lstrip(">"), hi.lstrip("<")
        self.lo = float(lo) if lo else None
        self.hi = float(hi) if hi else None
        digits = re.sub(r"e.*|[.]", "", hi).lstrip("0")
        if "." in hi and len(digits) >= 5:
            self.rounded = 10.0 ** -len(hi.split(".")[1])


class Table:
    def __init__(self, text):
        lines = text.splitlines()
        if lines[0].split() != HEAD:
            raise ValueError(f"the table begins with {lines[0]!r}")
        self.rows = {}
        for line in lines[1:]:
            if not line.strip():
                break
            match = ROW.fullmatch(line)
            if not match or match[2] not in TYPES:
                raise ValueError(f"no row of a table of parameters: {line!r}")
            self.rows[match[1]] = Parameter(match[1], match[2], match[3], match[4], match[5])
        self.tree = {}
        for path, parameter in self.rows.items():
            node = self.tree
            *groups, key = path.split(".")
            for group in groups:
                node = node.setdefault(group, {})
            node[key] = parameter


# ---- usual values: most in tame scenes, many in wild ones ----

USUAL = {
    "rock.diameter_m": (0.1, 3), "rock.height_m": (0.1, 3), "rock.axes_m": (0.1, 3), "rock.volume_m3": (1e-3, 30),
    "rock.mass_kg": (5, 5e4), "rock.density_kg_m3": (1500, 3200),
    "release.height_m": (0, 20), "release.vx_m_s": (-1, 10), "release.vz_m_s": (-5, 5), "release.spin_rad_s": (-20, 20),
    "slope.segments[].rn": (0.2, 0.6), "slope.segments[].rt": (0.6, 0.95), "slope.segments[].roughness_rad": (0, 0.4),
    "slope.segments[].roughness_m": (0, 0.5), "slope.segments[].friction": (0.2, 0.9),
    "slope.tolerance_m": (0.05, 3),
    "controls[].accepted_kJ": (1, 1000), "controls[].measured_speed_m_s": (1, 40),
    "forest[].cut_year": (-20, 60),
    "forest[].stand.stools.per_ha": (200, 5000), "forest[].stand.stools.spacing_m": (0.1, 1),
    "forest[].stand.shoots[].dbh_m": (0.02, 0.2), "forest[].stand.shoots[].height_m": (2, 15),
    "forest[].stand.shoots[].volume_m3": (1e-3, 0.3), "forest[].stand.shoots[].age_y": (1, 60),
    "forest[].stand.trees[].per_ha": (10, 1500), "forest[].stand.trees[].dbh_m": (0.05, 0.6),
    "forest[].stand.trees[].height_m": (4, 25), "forest[].stand.trees[].volume_m3": (1e-2, 3),
    "forest[].stand.trees[].age_y": (1, 150),
    "forest[].stand.energy.u_J_m3": (3e4, 2e5), "forest[].stand.energy.fracture_ratio": (0.5, 3),
    "forest[].stand.energy.hit_below_m": (0.5, 5),
    "forest[].stand.trees[].groups.stems": (2, 12), "forest[].stand.trees[].groups.radius_m": (0.5, 10),
    "forest[].stand.stumps.per_ha": (50, 4000), "forest[].stand.stumps.diameter_m": (0.05, 0.5),
    "forest[].stand.stumps.height_m": (0.05, 0.6), "forest[].stand.stumps.energy_kJ": (0.1, 20),
    "forest[].stand.logs.per_ha": (5, 200), "forest[].stand.logs.length_m": (1, 12),
    "forest[].stand.logs.diameter_m": (0.1, 0.6), "forest[].stand.logs.energy_kJ": (0.1, 50),
    "forest[].stand.growth.shoots.dbh_most_m": (0.1, 0.3), "forest[].stand.growth.shoots.dbh_rate_1_y": (0.01, 0.05),
    "forest[].stand.growth.shoots.height_most_m": (8, 20), "forest[].stand.growth.shoots.height_rate_1_y": (0.02, 0.06),
    "forest[].stand.growth.trees.dbh_most_m": (0.3, 0.8), "forest[].stand.growth.trees.dbh_rate_1_y": (0.01, 0.03),
    "forest[].stand.growth.trees.height_most_m": (15, 30), "forest[].stand.growth.trees.height_rate_1_y": (0.02, 0.05),
    "forest[].stand.growth.shoots_young": (5, 30), "forest[].stand.growth.shoots_old": (1, 5),
    "forest[].stand.growth.sdi_most": (300, 2000),
    "forest[].stand.cutting.rotation_years": (3, 40), "forest[].stand.cutting.cohorts": (1, 4),
    "forest[].stand.cutting.stay_per_ha": (0, 100),
    "simulation.threshold_m": (5, 60), "simulation.gravity_m_s2": (9.78, 9.83),
    "rocks_per_year": (0.1, 100), "minimum.reserves_per_ha": (0, 100),
}

# Optional keys without a default in the table. Others are rarely omitted.
OPTIONAL = {"name", "accepted_kJ", "measured_speed_m_s", "cut_year", "system", "species", "volume_m3", "age_y", "u_J_m3", "fracture_ratio", "hit_below_m",
            "sdi_most", "stay_per_ha", "shoots_young", "shoots_old", "rocks_per_year"}
GROUPS = {"shoots": 0.85, "trees": 0.85, "energy": 0.4, "growth": 0.4, "cutting": 0.4}  # shares of scenes that have them

# Sizes that belong to a shape, one of these lists; a new shape has axes.
SIZES = {"sphere": [["diameter_m"], ["volume_m3"], ["mass_kg"]], "cylinder": [["diameter_m", "height_m"]]}
DIAMETERS = ("dbh_sd_m", "dbh_cm", "dbh_sd_cm")
ALL_SIZES = {"diameter_m", "height_m", "axes_m", "volume_m3", "mass_kg", "density_kg_m3"}

TOLERANCE = 0.5  # m: for profiles with ground from the library

NAMES = ["road", "Straße 7", "house, \"old\"", "l'orto", "a; b", "x: y # z", "% \\ {1}", "日本の道", "naïve", "é", "- 1", "~",
         "wall\tand fence", "one\ntwo", "bell\u0007", "a name that is rather longer than the column in which it is to stand",
         "word" * 30, " ", "null", "1e3", "[0]", "=SUM(A1)"]
SOURCES = ["measured", "literature", "assumed", "calibrated"]

# Parts that change no figure of a run: drawn separately (random_observed.py), or by their own tests.
BESIDE_KEYS = ("observed", "rules")
BESIDE = ("observed[]", "rules.", "forest[].stand.uncertainty[]")


def clamp(value, lo, hi):
    return min(max(value, lo), hi)


def three_digits(value):
    return float(f"{value:.3g}")


class Case:
    """A scene: its files, its parts, and how to run it."""

    def __init__(self, index):
        self.index = index
        self.name = f"s{index}.yaml"
        self.files = {}     # more than the scene's own
        self.scene = None
        self.broken = None  # reason for a refusal
        self.key = None     # named by the refusal
        self.drawn = []     # (mapping, key, parameter) of single values
        self.used = set()   # paths of parameters
        self.words = set()  # (path, word)
        self.ends = set()   # (path, end) of values at an end
        self.tolerance = 0  # m: of the profile
        self.moved = 0      # m: by which points of a table may be moved, because they are less than 1 mm apart
        self.belts = []     # per option: [(from, to, whole stand)]

    def text(self):
        return yaml(self.scene)


class Maker:
    """Draws one scene."""

    def __init__(self, table, index):
        self.table, self.index = table, index
        self.rng = random.Random(f"scene {index}")
        self.case = Case(index)
        tame = self.chance(0.5)
        self.usual = 0.97 if tame else 0.5  # share of usual values
        self.endless = self.chance(0.005)  # ground that takes no energy
        self.edges = 0.01 if tame else 0.1  # share of values at a limit

    def chance(self, share):
        return self.rng.random() < share

    def between(self, lo, hi):
        """Draw log-uniform if both are above 0."""
        if lo > 0:
            return clamp(math.exp(self.rng.uniform(math.log(lo), math.log(hi))), lo, hi)
        return self.rng.uniform(lo, hi)

    # ---- single values ----

    def bounds(self, p):
        """Return the smallest and the largest allowed value."""
        lo = -MOST if p.lo is None else p.lo
        hi = (COUNT_MOST if p.kind == "count" else MOST) if p.hi is None else p.hi
        if p.kind == "count":
            return math.ceil(lo) + (p.above and lo == math.ceil(lo)), math.floor(hi) - (p.under and hi == math.floor(hi))
        if p.above:
            lo = math.nextafter(lo, math.inf)
        if p.under or p.rounded:
            hi = math.nextafter(hi - p.rounded, -math.inf)
        return lo, hi

    def at_edge(self, p):
        lo, hi = self.bounds(p)
        step = 1 if p.kind == "count" else 0
        which = self.rng.choice(["lo", "lo", "hi", "hi", "beside lo", "beside hi", "tiny", "huge"])
        if p.above and lo < 1e-300 and "lo" in which and self.chance(0.8):
            which = "tiny"  # the smallest number above 0 is rarely useful
        if which in ("lo", "hi"):
            if (p.lo if which == "lo" else p.hi) is not None:
                self.case.ends.add((p.path, which))
            return lo if which == "lo" else hi
        if which == "beside lo":
            return lo + step if step else math.nextafter(lo, math.inf)
        if which == "beside hi":
            return hi - step if step else math.nextafter(hi, -math.inf)
        if which == "huge":
            return clamp(hi * self.rng.uniform(0.5, 1), lo, hi)
        size = 10.0 ** self.rng.uniform(-300 if self.chance(0.2) else -15, -7)
        return clamp(size if lo >= 0 or self.chance(0.5) else -size, lo, hi)

    def inside(self, p):
        """Draw log-uniform over six decades below the ends."""
        lo, hi = self.bounds(p)
        if p.lo is not None and lo > 0 and p.lo > 0:
            return self.between(lo, hi)
        size = 10.0 ** self.rng.uniform(-6, 0)
        if lo < 0 and self.chance(0.5):
            return clamp(lo * size, lo, hi)
        return clamp(hi * size, lo, hi)

    def number(self, p):
        """Draw a value in the range of a parameter."""
        lo, hi = self.bounds(p)
        if self.chance(self.edges):
            value = self.at_edge(p)
            return int(value) if p.kind == "count" else value
        usual = USUAL.get(p.path)
        value = self.between(*usual) if usual and self.chance(self.usual) else self.inside(p)
        if p.kind == "count":
            return int(clamp(round(value), lo, hi))
        return clamp(three_digits(value), lo, hi) if self.chance(0.7) else clamp(value, lo, hi)

    def spread(self, p):
        """Draw a number, or sometimes a distribution over rocks."""
        mean = self.number(p)
        if not self.chance(0.08):
            return mean
        lo, hi = self.bounds(p)
        mapping = {"mean": mean}
        kind = self.rng.choice(["normal", "uniform", None])
        room = min(mean - lo, hi - mean) / (1 if kind == "uniform" else 3)
        share = self.rng.choice([0, self.rng.random(), 10.0 ** self.rng.uniform(-12, 0), 0.999, 0.999])
        if p.lo == 0 and p.hi == 1:  # truncated there by drawing again
            room = self.rng.choice([room, 1, 1e6])
        if not self.chance(0.1):
            mapping["spread"] = room * share
        if kind:
            mapping["kind"] = kind
        return mapping

    def string(self):
        return self.rng.choice(NAMES)

    def value(self, p, to):
        """Draw a value of a parameter and store it in a mapping."""
        self.case.used.add(p.path)
        if p.kind in ("number", "count"):
            to[p.key] = self.number(p)
        elif p.kind == "number~":
            to[p.key] = self.spread(p)
        elif p.kind == "3 numbers~":
            to[p.key] = [self.spread(p) for _ in range(3)]
        elif p.kind == "numbers":
            to[p.key] = [self.number(p) for _ in range(self.rng.randint(0, 4))]
        elif p.kind == "word":
            to[p.key] = self.rng.choice(p.words)
            self.case.words.add((p.path, to[p.key]))
        elif p.kind == "flag":
            to[p.key] = self.chance(0.5)
        elif p.kind == "text":
            to[p.key] = self.string()
        else:
            raise ValueError(f"{p.path}: nothing is known of how to draw {p.kind}")
        if not isinstance(to[p.key], (dict, list)):
            self.case.drawn.append((to, p.key, p))

    def forget(self, mapping):
        """Drop a mapping that was copied into a file: an error here would have no effect."""
        self.case.drawn = [d for d in self.case.drawn if d[0] is not mapping]

    # ---- groups ----

    def wants(self, key, node):
        if isinstance(node, Parameter):
            if node.kind in ("file", "points"):
                return False
            return self.chance(0.4 if node.default != "-" or key in OPTIONAL else 0.998)
        return self.chance(GROUPS.get(key, 0.15))

    def fill(self, node, to, leave=()):
        """Draw all parameters of a mapping except some keys."""
        for key, child in node.items():
            plain = key.removesuffix("[]")
            if plain in leave or plain in to or not self.wants(plain, child):
                continue
            if isinstance(child, Parameter):
                self.value(child, to)
            elif key.endswith("[]"):
                to[plain] = [self.fill(child, {}) for _ in range(self.rng.randint(1, 3))]
            else:
                to[plain] = self.fill(child, {})
        if self.chance(0.02):
            to["source"] = {"kind": self.rng.choice(SOURCES), "text": self.string()}
        return to

    def rock(self):
        node = self.table.tree["rock"]
        rock = {}
        self.value(node["shape"], rock)
        if rock["shape"] == "sphere" and self.chance(0.2):
            del rock["shape"]
        sizes = self.rng.choice(SIZES.get(rock.get("shape", "sphere"), [["axes_m"]]))
        for key in sizes:
            self.value(node[key], rock)
        if "mass_kg" not in rock and self.chance(0.7):
            heavy = "shape" in rock and rock["shape"] != "sphere" and self.chance(0.4)
            self.value(node["mass_kg" if heavy else "density_kg_m3"], rock)
        return self.fill(node, rock, ALL_SIZES | {"shape"})

    # ---- the slope ----

    def begin(self):
        """Draw x of the first vertex: usually 0, or survey coordinates, or anything."""
        if self.chance(0.75):
            return 0.0
        return self.rng.choice([480000.0, 512345.67, -1234.5, 1e-9, self.rng.uniform(-1e8, 1e8), -1e9])

    def xs(self):
        usual = self.chance(self.usual)
        length = self.between(30, 500) if usual else self.between(1e-3, 1e5)
        if self.chance(self.edges / 10):
            length = self.rng.choice([1e-300, 1e-9, 1e7, 1e9])
        n = self.rng.choice([1, 1, 2, 3, 4, 6, 9]) if self.chance(0.97) else self.rng.randint(10, 300)
        cuts = sorted(self.rng.random() for _ in range(n - 1))
        x = self.begin()
        xs = [x] + [x + length * c for c in cuts] + [x + length]
        for i in range(1, len(xs)):
            if self.chance(0.05):  # a wall
                xs[i] = xs[i - 1] + self.rng.choice([0.01, 1e-6, 0])
            xs[i] = three_digits(xs[i] - x) + x if self.chance(0.3) else xs[i]
            xs[i] = max(xs[i], math.nextafter(xs[i - 1], math.inf))
        if xs[-1] > 1e9:
            xs = [v - (xs[-1] - 1e9) for v in xs]
        return xs

    def zs(self, xs):
        z = 0.0 if self.chance(0.8) else self.rng.choice([1234.5, -300.0, 1e8, -1e9 + 1])
        zs = [z]
        for a, b in zip(xs, xs[1:]):
            if self.chance(self.usual):
                drop = (b - a) * math.tan(math.radians(self.rng.choice([0, 5, 20, 30, 35, 40, 45, 60, self.rng.uniform(-20, 75)])))
            else:
                drop = self.rng.choice([-1, 1, 1]) * self.between(1e-6, 1e3)
            zs.append(clamp(zs[-1] - drop, -1e9, 1e9))
        return zs

    def segment(self):
        node = self.table.tree["slope"]["segments[]"]
        leave = self.rng.choice([("roughness_m",), ("roughness_m",), ("roughness_rad",)])
        if self.endless:
            return {"rn": 1, "rt": 1, "friction": 0}
        return self.fill(node, {}, leave)

    def materials(self, xs):
        """Draw grounds from the first vertex to the last."""
        node = self.table.tree["slope"]["materials[]"]
        inner = [x for x in xs[1:-1] if self.chance(0.4)]
        inner += [self.rng.uniform(xs[0], xs[-1]) for _ in range(self.rng.choice([0, 0, 1, 3]))]
        cuts = sorted({x for x in inner if xs[0] < x < xs[-1]})
        rows = []
        for a, b in zip([xs[0], *cuts], [*cuts, xs[-1]]):
            row = {"from_m": a, "to_m": b}
            self.value(node["material"], row)
            if self.chance(0.2):  # values of its own
                for key in self.rng.sample(["rn", "rt", "roughness_m", "friction", "mu"], 2):
                    self.value(node[key], row)
            rows.append(row)
        self.case.used |= {"slope.materials[].from_m", "slope.materials[].to_m"}
        return rows

    def csv(self, xs, zs, layers):
        """Return a table of the profile; with layers, after another line."""
        sign = self.rng.choice([",", ";", "\t"])
        head = self.rng.choice(["distance{}elevation", "Distance{}Elevation", "x{}z"]).format(sign)
        end = self.rng.choice(["\n", "\r\n"])
        name = f"s{self.index}.csv"
        self.case.moved = 1e-3 * len(xs)
        rows = [f"{x!r}{sign}{z!r}" for x, z in zip(xs, zs)]
        if layers:
            others = [f"{x!r}{sign}{z + 1!r}" for x, z in zip(xs, zs)]
            head, rows = f"layer{sign}{head}", [f"{layer}{sign}{row}" for layer, line in zip(layers, (others, rows)) for row in line]
        self.case.files[name] = end.join([head, *rows, ""])
        return name

    def slope(self):
        xs = self.xs()
        zs = self.zs(xs)
        self.case.xs, self.case.zs = xs, zs
        slope = {}
        if zs[-1] > zs[0]: # drawn upward: the scene's places refer to the mirrored profile
            slope["reversed"] = True
            self.case.used.add("slope.reversed")
            self.case.xs, self.case.zs = [xs[0] + xs[-1] - x for x in reversed(xs)], zs[::-1]
        if self.chance(0.15) and xs[-1] - xs[0] > 0.11:  # a table needs a length
            layers = ("crown", "ground") if self.chance(0.3) else ()
            slope["csv"] = self.csv(xs, zs, layers)
            self.case.used.add("slope.csv")
            if layers:
                slope["layer"] = layers[1]
                self.case.used.add("slope.layer")
            if len(slope) == 1 and self.chance(0.3):
                self.case.tolerance = TOLERANCE
                return slope["csv"]  # on talus
        else:
            slope["vertices_m"] = [[x, z] for x, z in zip(xs, zs)]
            self.case.used.add("slope.vertices_m")
        if self.chance(0.25):
            slope["materials"] = self.materials(xs)
        else:
            slope["segments"] = [self.segment() for _ in range(1 if self.chance(0.4) else len(xs) - 1)]
        each = len(slope.get("segments", [])) > 1  # has its own ground: all its points are kept
        self.fill(self.table.tree["slope"], slope, ("segments", "materials", "reversed", "layer", *["tolerance_m"] * each))
        self.case.tolerance = slope.get("tolerance_m", 0 if "segments" in slope else TOLERANCE)
        if self.chance(0.1):
            name = f"s{self.index}-slope.yaml"
            self.forget(slope)
            self.case.files[name] = {"ceduo": "slope/1", **slope}
            return name
        return slope

    # ---- release and controls ----

    def releases(self):
        """Draw several releases; keeps their mean and their maximum place."""
        xs, case = self.case.xs, self.case
        shares = self.rng.choice([[1], [0.25, 0.75], [0.5, 0.5], [0.2, 0.3, 0.5]])
        places = [clamp(xs[0] + (xs[-1] - xs[0]) * self.rng.random() * 0.3, xs[0], math.nextafter(xs[-1], -math.inf)) for _ in shares]
        case.start, case.last_start = sum(map(math.prod, zip(shares, places))), max(places)
        case.used |= {"release[].x_m", "release[].share"}
        node = self.table.tree["release[]"]
        return [self.fill(node, {"x_m": x, "share": share}) for x, share in zip(places, shares)]

    def release(self):
        """Draw the release; keeps its maximum place."""
        if self.chance(0.08):
            return self.releases()
        release = self.fill(self.table.tree["release"], {}, ("x_m",))
        xs, case = self.case.xs, self.case
        case.start = case.last_start = xs[0]
        if self.chance(0.6):
            return release
        x = xs[0] + (xs[-1] - xs[0]) * self.rng.choice([0, 0.01, 0.1, self.rng.random(), self.rng.random() ** 3])
        if self.chance(self.edges):
            x = self.rng.choice([math.nextafter(xs[0], math.inf), math.nextafter(xs[-1], -math.inf), xs[len(xs) // 2]])
        x = clamp(x, xs[0], math.nextafter(xs[-1], -math.inf))
        release["x_m"] = x
        case.start = case.last_start = x
        case.used.add("release.x_m")
        if self.chance(0.3):
            reach = min(x - xs[0], xs[-1] - x) * self.rng.random() * 0.99
            release["x_m"] = {"mean": x, "spread": reach / 3 if self.chance(0.5) else reach / 9}
            case.last_start = x + 3 * release["x_m"]["spread"]
        return release

    def places(self):
        """Draw x of controls after the release, in any order."""
        lo, hi = math.nextafter(self.case.last_start, math.inf), self.case.xs[-1]
        count = self.rng.choice([1, 1, 1, 2, 3, 5]) if self.chance(0.98) else 40
        found = []
        for _ in range(count):
            x = lo + (hi - lo) * self.rng.random()
            if self.chance(0.3):
                x = hi
            elif self.chance(self.edges):
                x = self.rng.choice([lo, math.nextafter(hi, -math.inf), *self.case.xs])
            x = clamp(x, lo, hi)
            if x not in found:
                found.append(x)
        return found

    def controls(self, scene):
        if self.chance(0.2):
            scene["controls_m"] = self.places()
            self.case.used.add("controls_m")
            return
        node = self.table.tree["controls[]"]
        scene["controls"] = [self.fill(node, {"x_m": x}, ("accepted_return_y",)) for x in self.places()]
        self.case.used.add("controls[].x_m")

    # ---- the forest ----

    def stools(self, stand):
        """Draw stools and their shoots: at least one each, at most ten thousand."""
        node = self.table.tree["forest[]"]["stand"]
        stools = stand["stools"] = self.fill(node["stools"], {})
        p = node["stools"]["per_ha"]
        if "per_ha" not in stools:
            self.value(p, stools)
        each = self.between(1, 30) if self.chance(self.usual) else self.rng.choice([1, 1, 2, 3, self.between(1, 1e4), 1e4])
        cohorts = self.rng.choice([1, 1, 2, 3])
        most = self.bounds(node["shoots[]"]["per_ha"])[1]
        all_shoots = clamp(stools["per_ha"] * each, stools["per_ha"], most * cohorts)
        stand["shoots"] = []
        for _ in range(cohorts):
            shoots = self.fill(node["shoots[]"], {"per_ha": clamp(all_shoots / cohorts, 5e-324, most)}, (*DIAMETERS, "per_stool"))
            stand["shoots"].append(shoots)
            self.diameters(node["shoots[]"], shoots)
        while sum(s["per_ha"] for s in stand["shoots"]) < stools["per_ha"]:  # by rounding
            stand["shoots"][0]["per_ha"] = math.nextafter(stand["shoots"][0]["per_ha"], math.inf)
        self.case.used.add("forest[].stand.shoots[].per_ha")
        for shoots in stand["shoots"]:
            each = shoots["per_ha"] / stools["per_ha"] if stools["per_ha"] > 1e-200 else 0
            if 1e-100 < each <= 1e4 and self.chance(0.4):
                del shoots["per_ha"]
                shoots["per_stool"] = each
                self.case.used.add("forest[].stand.shoots[].per_stool")

    def diameters(self, node, stems):
        """Sometimes draw a spread of diameters, rarely larger than they are; sometimes in cm."""
        if "dbh_sd_m" in node and "dbh_m" in stems and self.chance(0.3):
            self.value(node["dbh_sd_m"], stems)
            if self.chance(0.93):
                stems["dbh_sd_m"] = min(stems["dbh_sd_m"], stems["dbh_m"] * self.rng.choice([0.01, 0.2, 0.5, 1]))
        for key in ("dbh_m", "dbh_sd_m"):
            if key in stems and stems[key] * 100 / 100 == stems[key] and self.chance(0.2):
                cm = key.replace("_m", "_cm")
                stems[cm] = stems.pop(key) * 100
                self.case.used.add(node[cm].path)

    def trees(self, stand):
        node = self.table.tree["forest[]"]["stand"]["trees[]"]
        stand["trees"] = []
        for _ in range(self.rng.choice([1, 1, 2, 4])):
            stems = self.fill(node, {}, DIAMETERS)
            self.diameters(node, stems)
            stand["trees"].append(stems)

    def stand(self):
        """Draw a whole stand."""
        node = self.table.tree["forest[]"]["stand"]
        stand = {}
        kind = self.rng.choice(["coppice", "coppice", "both", "both", "trees", "bare"])
        if kind in ("coppice", "both"):
            self.stools(stand)
        if kind in ("trees", "both"):
            self.trees(stand)
        self.fill(node, stand, ("base", "stools", "shoots", "trees", "uncertainty"))
        for low in ("stumps", "logs"):  # all, or nothing
            for key in node[low]:
                if low in stand and key not in stand[low]:
                    self.value(node[low][key], stand[low])
        for trees in stand.get("trees", []):
            if trees.get("groups", {}).get("stems", 1) > 1 and "radius_m" not in trees["groups"]:
                self.value(node["trees[]"]["groups"]["radius_m"], trees["groups"])
        if kind != "bare" and stand.get("system") == "bare":
            del stand["system"]
        growth = stand.get("growth", {})
        if "growth" not in stand:
            stand.pop("cutting", None)  # otherwise a warning
        elif self.chance(0.95):  # otherwise refused if a cut lacks data
            self.complete_growth(node, stand)
        young, old = growth.get("shoots_young"), growth.get("shoots_old")
        if young is None and old is not None and self.chance(0.9):
            del growth["shoots_old"]
            old = None
        if young is not None and old is not None and young < old:
            growth["shoots_young"], growth["shoots_old"] = old, young
        return stand

    def complete_growth(self, node, stand):
        """Add what growth and cuts need."""
        growth, stools = stand["growth"], stand.get("stools", {}).get("per_ha", 0) > 0
        for key in ("shoots", "trees"):
            if "cutting" in stand and not growth.get(key) and (stools or key == "trees"):
                growth[key] = self.fill(node["growth"][key], {})
        for key in ("shoots_young", "shoots_old"):
            if stools and "shoots" in growth and key not in growth:
                self.value(node["growth"][key], growth)

    def filed(self, stand):
        """Write the stand into the scene: itself, a file's name, or a file and its changes."""
        if not self.chance(0.2):
            return stand
        name = f"s{self.index}-stand{len(self.case.files)}.yaml"
        self.forget(stand)
        mine = {key: stand[key] for key in stand if self.chance(0.4)}
        if not mine or self.chance(0.4):
            self.case.files[name] = {"ceduo": "stand/1", **stand}
            return name
        file = {key: value for key, value in stand.items() if key not in mine}
        if isinstance(stand.get("stools"), dict) and "stools" in mine:  # mappings are merged, lists replaced
            file["stools"] = {key: value for key, value in {"per_ha": 17, "spacing_m": 3}.items() if key in stand["stools"]}
        self.case.files[name] = {"ceduo": "stand/1", **file}
        self.case.used.add("forest[].stand.base")
        return {"base": name, **mine}

    def forest(self):
        """Draw belts in order, without overlap."""
        xs, rng = self.case.xs, self.rng
        count = rng.choice([1, 1, 1, 2, 3])
        inner = [xs[0] + (xs[-1] - xs[0]) * rng.random() for _ in range(2 * count)]
        cuts = sorted(inner)
        if self.chance(0.6):
            cuts[0], cuts[-1] = xs[0], xs[-1]
        belts, whole = [], []
        for a, b in zip(cuts[::2], cuts[1::2]):
            if belts and self.chance(0.4):
                a = belts[-1]["to_m"]
            if not b > a:
                continue
            stand = self.stand()
            belts.append(self.fill(self.table.tree["forest[]"], {"from_m": a, "to_m": b}, ("stand",)))
            if "cutting" not in stand and self.chance(0.95):  # otherwise refused
                belts[-1].pop("cut_year", None)
            belts[-1]["stand"] = self.filed(stand)
            whole.append((a, b, stand))
        self.case.used |= {"forest[].from_m", "forest[].to_m"}
        self.case.belts.append(whole)
        return belts

    def options(self, scene):
        if self.chance(0.1):
            self.case.belts.append([])
        elif self.chance(0.7):
            scene["forest"] = self.forest()
        else:
            names = self.rng.sample(NAMES, self.rng.randint(1, 4))
            scene["options"] = []
            for name in names:
                option = self.fill(self.table.tree["options[]"], {"name": name})
                if self.chance(0.9):
                    option["forest"] = self.forest()
                else:
                    self.case.belts.append([])
                scene["options"].append(option)
            self.case.used.add("options[].name")

    def uncertainty(self):
        """Draw uncertain inputs; they change no figure of a run."""
        rows = {"lo": {"path": "simulation.gravity_m_s2", "lo": 9.7, "hi": self.rng.uniform(9.8, 10)},
                "mean": {"path": "release.height_m", "mean": 10, "sd": self.rng.uniform(0.1, 3)},
                "one_of": {"path": "simulation.law", "one_of": ["lumped", "crsp"]}}
        if isinstance(self.case.scene.get("release"), list):
            del rows["mean"]
        if self.chance(0.2):
            return "none"
        keys = self.rng.sample(list(rows), self.rng.randint(1, len(rows)))
        self.case.used |= {f"uncertainty[].{key}" for one in keys for key in rows[one]}
        return [rows[key] for key in keys]

    def blocks(self):
        """Draw block frequencies: by a power law, or in classes that do not overlap."""
        lo = self.rng.uniform(0.01, 0.5)
        hi = lo * self.rng.uniform(1.5, 20)
        self.case.used |= {f"blocks[].{key}" for key in ("per_year", "volume_m3", "exponent")}
        if self.chance(0.5):
            return {"per_year": self.rng.uniform(0.01, 5), "volume_m3": [lo, hi], "exponent": self.rng.uniform(0.3, 2)}
        return [{"per_year": self.rng.uniform(0.01, 5), "volume_m3": [lo, hi]},
                {"per_year": self.rng.uniform(0.01, 5), "volume_m3": [hi, 2 * hi]}]

    # ---- all together ----

    def make(self):
        case, tree = self.case, self.table.tree
        scene = case.scene = {"ceduo": "scene/1", "title": f"random scene {self.index} " + self.rng.choice(["", "of many", "é 日本"])}
        case.used.add("title")
        scene["rock"] = self.rock()
        scene["slope"] = self.slope()
        release = self.release()
        if release:
            scene["release"] = release
        self.controls(scene)
        self.options(scene)
        scene["simulation"] = self.fill(tree["simulation"], {}, ("rocks",))
        scene["simulation"]["rocks"] = case.rocks = self.rng.choice([1, 2, 3, 10, 20, 50])
        case.used.add("simulation.rocks")
        self.fill(tree, scene, ("controls", "controls_m", "forest", "options", "simulation", "release", "uncertainty", "blocks", *BESIDE_KEYS))
        years = scene.get("years", {})
        if years.get("last", math.inf) < years.get("first", 0) and self.chance(0.95):  # otherwise refused
            years["first"], years["last"] = years["last"], years["first"]
        if self.chance(0.2):
            scene["uncertainty"] = self.uncertainty()
        if self.chance(0.1):
            scene["blocks"] = self.blocks()
            for control in scene.get("controls", []):  # invalid without blocks
                if self.chance(0.5):
                    self.value(tree["controls[]"]["accepted_return_y"], control)
        if self.chance(0.1):
            scene["rules"] = self.rng.choice(["toscana", "umbria", "marche"])
        if self.chance(0.08):
            self.spoil()
        self.orders()
        random_observed.draw(case)
        for file in case.files:
            if isinstance(case.files[file], dict):
                case.files[file] = yaml(case.files[file])
        return case

    def orders(self):
        """Draw additional ways to run the scene."""
        case, rng = self.case, self.rng
        case.plot = rng.random() if self.chance(0.3) else None  # as a share of the existing kinds
        case.size = rng.choice([None, None, "40x12", "120x40", "20x6", "200x60"])
        case.charset = rng.choice([None, "braille", "block", "ascii"])
        case.years = rng.choice(["0:3", "0:30:10", "5:5", "0:500:250", "100:102", "7:8"]) if self.chance(0.25) else None

    # ---- invalid scenes ----

    def spoil(self):
        """Make one thing invalid."""
        ways = [*[self.spoil_range] * 6, self.spoil_word, self.spoil_key, self.spoil_group,
                self.spoil_control, self.spoil_belts, self.spoil_stools, self.spoil_vertices, self.spoil_type]
        self.rng.shuffle(ways)
        for way in ways:
            if way():
                return

    def spoiled(self, why, key):
        self.case.broken, self.case.key = why, key
        return True

    def some(self, good):
        found = [d for d in self.case.drawn if good(d[2]) and d[1] in d[0]]
        return self.rng.choice(found) if found else None

    def spoil_range(self):
        found = self.some(lambda p: p.kind in ("number", "number~", "count") and (p.lo is not None or p.hi is not None))
        if not found:
            return False
        mapping, key, p = found
        count = p.kind == "count"
        ends = []
        if p.lo is not None:
            ends.append(p.lo if p.above else int(p.lo) - 1 if count else math.nextafter(p.lo, -math.inf))
        if p.hi is not None:
            ends.append(p.hi + p.rounded if p.rounded else p.hi if p.under else
                        int(p.hi) + 1 if count else math.nextafter(p.hi, math.inf))
        mapping[key] = self.rng.choice(ends)
        return self.spoiled(f"{p.path} one step beyond its range", key)

    def spoil_word(self):
        found = self.some(lambda p: p.kind == "word")
        if found:
            found[0][found[1]] += self.rng.choice(["x", "q", "1"])
        return bool(found) and self.spoiled(f"{found[2].path} is no word of it", found[1])

    def spoil_key(self):
        found = self.some(lambda p: True)
        if found:
            found[0]["colour"] = self.rng.choice([1, "red", [1], {"a": 1}])
        return bool(found) and self.spoiled("an unknown key", "colour")

    def spoil_group(self):
        key = self.rng.choice(["rock", "slope"])
        del self.case.scene[key]
        return self.spoiled(f"{key} is missing", key)

    def spoil_control(self):
        controls = self.case.scene.get("controls")
        if controls:
            controls[0]["x_m"] = self.rng.choice([self.case.start, self.case.xs[0] - 1, math.nextafter(self.case.xs[-1], math.inf)])
        return bool(controls) and self.spoiled("a control off the slope or not beyond the release", "x_m")

    def spoil_belts(self):
        belts = self.case.scene.get("forest")
        if belts:
            belts[-1]["to_m"] = belts[-1]["from_m"]
        return bool(belts) and self.spoiled("a belt without length", "to_m")

    def spoil_stools(self):
        for belt in self.case.scene.get("forest", []):
            stand = belt["stand"]
            if not isinstance(stand, dict) or "base" in stand or "stools" not in stand or any("per_stool" in s for s in stand["shoots"]):
                continue
            shoots = sum(s["per_ha"] for s in stand["shoots"])
            if shoots * 1.01 <= 1e6 and math.isfinite(shoots) and shoots > 1e-300:
                stand["stools"]["per_ha"] = shoots * 1.01
                return self.spoiled("fewer shoots than stools", "per_ha")
        return False

    def spoil_vertices(self):
        slope = self.case.scene["slope"]
        if not isinstance(slope, dict) or "vertices_m" not in slope:
            return False
        slope["vertices_m"][1][0] = slope["vertices_m"][0][0]
        return self.spoiled("x does not rise", "vertices_m")

    def spoil_type(self):
        found = self.some(lambda p: p.kind in ("number", "count"))
        if found:
            found[0][found[1]] = self.rng.choice(["1,5", [], {}, [1, 2], "one", True, None])
        return bool(found) and self.spoiled("no number", found[1])


def make(table, index):
    return Maker(table, index).make()


# ---- YAML ----

def scalar(value):
    if isinstance(value, (str, bool)) or value is None:
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\x7f")
    return repr(value)


def flow(value):
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key}: {flow(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(flow(item) for item in value) + "]"
    return scalar(value)


def block_lines(value, indent):
    """Write a mapping in block style; small values in flow style."""
    for key, item in value.items():
        if isinstance(item, dict) and len(flow(item)) > 90:
            yield f"{indent}{key}:"
            yield from block_lines(item, indent + "  ")
        elif isinstance(item, list) and item and all(isinstance(entry, dict) for entry in item):
            yield f"{indent}{key}:"
            for entry in item:
                first, *others = block_lines(entry, indent + "    ") if entry else [indent + "    {}"]
                yield f"{indent}  - {first.lstrip(' ')}"
                yield from others
        else:
            yield f"{indent}{key}: {flow(item)}"


def yaml(mapping):
    return "\n".join(block_lines(mapping, "")) + "\n"
