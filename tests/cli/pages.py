# SPDX-License-Identifier: GPL-3.0-or-later
"""How the tests of --batch read a page: its tables, their rows and cells, the text of one option."""
import functools
import math
import re
import unicodedata

from harness import expect, expect_equal, expect_in, expect_near


# The whole page; what is not known is left out, as most tests look at other figures and it takes a second.
WHOLE = ("--batch", "--details", "-s", "uncertainty=none")


def expect_order(text, *parts):
    """The parts stand in the text in this order. Runs of blanks count as one."""
    plain, at = re.sub(r"\s+", " ", text), 0
    for part in parts:
        found = re.search(part, plain[at:])
        expect(found, f"/{part}/ is missing, or stands too early, in:", text)
        at += found.end()


def expect_width(text):
    long = [line for line in text.splitlines() if len(line) > 80]
    expect(not long, "lines of more than 80 columns:", *[f"{len(line)}: {line}" for line in long])


def digits(value, n):
    """A number of the page: so many significant digits, a dash where there is none."""
    if value is None:
        return "-"
    if value == 0:
        return "0"
    decimals = max(0, n - (math.floor(math.log10(abs(value))) + 1))
    return f"{value:.{decimals}f}"


def of_1000(lo_name, arrivals):
    """'991 (984–995)' of the page."""
    share, lo, hi = (arrivals[f"{lo_name}_{k}"] for k in ("probability", "lo", "hi"))
    return "-" if share is None else f"{share * 1000:.0f} ({math.floor(lo * 1000)}–{math.ceil(hi * 1000)})"


def table_row(text, name):
    """The lines of a table that begin with a name."""
    return [line for line in text.splitlines() if line.strip().startswith(name)]


def expect_cells(line, *cells):
    """A line of a table holds these cells, with a blank between any two."""
    wanted = r"\s+".join(re.escape(c).replace(r"\ ", " ") for c in cells)
    expect(re.search(rf"(^|\s){wanted}(\s|$)", line), f"'{'  '.join(cells)}' is missing in: {line!r}")


def section(text, name):
    """What the page says of one option."""
    lines = text.splitlines()
    first = next((i for i, line in enumerate(lines) if line == name), None)
    expect(first is not None, f"no option '{name}' in:", text)
    end = next((i for i in range(first + 1, len(lines)) if lines[i] and not lines[i].startswith(" ")), len(lines))
    return "\n".join(lines[first:end])


ARRIVALS_ROW = re.compile(r"^ {4}(?:through the wood|without forest) +(?:(\d+ \(\d+–\d+\)) +)?(\d+ \(\d+–\d+\)) +"
                          r"(?:-|([\d.]+) ?±(-|[\d.]+)) +(-|[\d.e]+) +(-|[\d.e]+)$")


@functools.cache
def student(freedom):
    """The 97.5 % quantile of Student's law: its density, summed by Simpson's rule from 0 on, comes to 0.475 there."""
    scale = math.exp(math.lgamma((freedom + 1) / 2) - math.lgamma(freedom / 2)) / math.sqrt(freedom * math.pi)

    def density(t):
        return scale * (1 + t * t / freedom) ** (-(freedom + 1) / 2)

    step, t, total = 1e-3, 0.0, 0.0
    while total < 0.475:
        total += (density(t) + 4 * density(t + step / 2) + density(t + step)) * step / 6
        t += step
    return t - (total - 0.475) / density(t)


def half_of_mean(figure, count):
    """Half the width of the 95 % interval of a mean."""
    return figure["se"] * student(count - 1)


def expect_arrivals(line, arrivals):
    """A line of the table of arrivals has a blank between any two cells, and what it says of a mean and its error is true."""
    found = ARRIVALS_ROW.match(line)
    expect(found, "cells run into one another:", repr(line))
    exceed, reach, mean, half, p95, speed = found.groups()
    expect_equal((exceed or "-", reach), (of_1000("exceed", arrivals), of_1000("reach", arrivals)), line)
    energy = arrivals["energy_kJ"]
    expect_equal(mean is None, energy["mean"] is None, line)
    if mean is not None and arrivals["rocks_reached"] < 10:
        expect_equal(half, "-", f"an error of so few rocks: {line}")
    elif mean is not None:
        wanted = half_of_mean(energy, arrivals["rocks_reached"])
        expect(half != "-" and float(half) >= 0.94 * wanted, f"an error of {wanted} is said to be less:", line)
        expect(abs(float(mean) - energy["mean"]) <= float(half) + 1e-3 * energy["mean"],
               f"the mean of {energy['mean']} lies beyond its error:", line)
        unit = 10.0 ** -len(half.partition(".")[2])  # it is rounded up
        expect(float(half) <= max(1.1 * wanted, wanted + 1.001 * unit, 0.1 * energy["mean"]), f"an error of {wanted} is said to be far more:", line)
    for cell, value in ((p95, energy["p95"]), (speed, arrivals["speed_m_s"]["mean"])):
        expect_equal(cell == "-", value is None, line)
        if value is not None:
            expect_near(float(cell), value, 0.051 * abs(value), line)


def expect_option(text, option, alone=True):
    """The page of an option says what the JSON of the same run holds; of one of several the slope without forest stands elsewhere."""
    flat_text = re.sub(r"\s+", " ", text)
    bare = table_row(text, "without forest")
    wooded = table_row(text, "through the wood")
    expect_equal(len(bare), len(option["controls"]) if alone else 0, "rows without forest")
    expect_equal(len(wooded), 0 if option["controls"][0]["wooded"] is None else len(option["controls"]), "rows through the wood")
    for i, control in enumerate(option["controls"]):
        if alone:
            expect_arrivals(bare[i], control["bare"])
        if not wooded:
            continue
        expect_arrivals(wooded[i], control["wooded"])
        ways = ("stopped_by_stems", "came_to_rest", "left_slope")
        missed, reach = control["wooded"]["missed"], control["wooded"]["reach_probability"]
        expect_near(reach + sum(missed.values()), 1, 1e-12, "all released end somewhere")
        shares = [f"{share * 1000:.0f}" for share in (reach, *(missed[k] for k in ways))]
        expect_in("Of 1000, {} arrive; before that {} are stopped by stems, {} come to rest, {} leave the slope".format(*shares),
                  flat_text, "ends before the control")
        shares = [f"{option['ends'][k] * 1000:.0f}" for k in ways]
        expect_in("On the whole profile: of 1000, {} are stopped by stems, {} come to rest, {} leave it".format(*shares),
                  flat_text, "ends")
        energies = [digits(control[k]["energy_per_released_kJ"]["mean"], 3) for k in ("wooded", "bare")]
        place = flat_text[[m.end() for m in re.finditer(r" At [\d.]+ m", flat_text)][i]:]
        expect(place.index(" of 1000 ") < place.index("Energy per released rock"), "a mean over all stands above the shares", text)
        said = r"Energy per released rock: {} ±\S+ kJ through the wood, {} ±\S+ without it\." if alone else r"Energy per released rock: {} ±\S+ kJ\."
        expect(re.search(said.format(*map(re.escape, energies)), flat_text), energies, text)
        if control["wooded"]["rocks_reached"] > 0:
            hit = f"{control['wooded']['contacts']['mean']:.3g}"
            expect(re.search(rf"\b{re.escape(hit)} stems?\b", flat_text), f"'{hit} stems' is missing in:", text)
    words = {"pass": "passes", "fail": "FAILS", "unknown": "unknown"}
    told = [c for c in option["controls"] if c["verdict"]["answer"] != "nothing"]
    nothing = len(re.findall("Contact, free run and energy: nothing can be said", flat_text))
    expect_equal(nothing, len(option["controls"]) - len(told), "nothing can be said")
    for name, key in (("Contact", "contact"), ("Free run", "free_run"), ("Energy", "energy")):
        said = re.findall(rf"\b{name}: (\w+)\. (\S+)", flat_text)
        expect_equal([word for word, reason in said], [words[c["lights"][key]] for c in told], name)
        expect(all(reason for _, reason in said), f"{name} without a reason", text)


def side_by_side(text, names):
    """The table of the options and all that the page says: its head, {name: its line}, the page in one line."""
    lines = text[text.lower().index("\nside by side"):].split("\n\n")[0].strip().splitlines()
    head = next(i for i, line in enumerate(lines) if line.strip().startswith("option"))
    rows = lines[head + 1:head + 1 + len(names)]
    for name, row in zip(names, rows):
        shown = re.split(r" {2,}|…", row.strip())[0].rstrip("…")
        expect(shown and name.startswith(shown), f"{name!r} is not the name of {row!r}")
    return lines[head], dict(zip(names, rows)), " ".join(text.split())


def columns(line):
    return sum(2 if unicodedata.east_asian_width(c) in "WF" else 1 for c in line)


def cells_of_rows(text):
    """What stands in the rows of arrivals behind the shares: mean, 95 %, m/s."""
    rows = re.findall(r"^    (?:through the wood|without forest) .*$", text, re.M)
    expect(rows, "no rows", text)
    return [re.sub(r"^ *(?:through the wood|without forest)|\d+ \(\d+–\d+\)", "", row).strip().rsplit(None, 2) for row in rows]


BLOCK = re.compile(r"^ {2}([> ]) +([\d.]+) +([\d.]+) +([\d.]+) +([\d.]+|none) +([\d.]+) +(-|\d+ \(\d+–\d+\))$")


def blocks_of(text):
    """The table of blocks of other sizes: [(own, volume, mass, diameter, ADC, contacts, of 1000)]."""
    lines = text.splitlines()
    first = next(i for i, line in enumerate(lines) if "Blocks of other sizes" in line)
    first = next(i for i in range(first, len(lines)) if lines[i].split()[:2] == ["m\u00b3", "kg"]) + 1
    rows = []
    for line in lines[first:]:
        found = BLOCK.match(line)
        if not found:
            break
        own, *numbers, share = found.groups()
        rows.append((own == ">", *(math.inf if n == "none" else float(n) for n in numbers), share))
    return rows
