# SPDX-License-Identifier: GPL-3.0-or-later
"""Helpers to read a page of --batch: its tables, rows and cells, the text of one option."""
import functools
import math
import re
import unicodedata

from harness import expect, expect_equal, expect_in, expect_near


# The whole page without uncertainty, which takes a second: most tests read other figures.
WHOLE = ("--batch", "--details", "-s", "uncertainty=none")


def expect_order(text, *parts):
    """Expect the parts in this order. Runs of blanks count as one."""
    plain, at = re.sub(r"\s+", " ", text), 0
    for part in parts:
        found = re.search(part, plain[at:])
        expect(found, f"/{part}/ is missing, or stands too early, in:", text)
        at += found.end()


def expect_width(text):
    long = [line for line in text.splitlines() if len(line) > 80]
    expect(not long, "lines of more than 80 columns:", *[f"{len(line)}: {line}" for line in long])


def digits(value, n):
    """Return a number of the page: significant digits, or a dash for null."""
    if value is None:
        return "-"
    if value == 0:
        return "0"
    decimals = max(0, n - (math.floor(math.log10(abs(value))) + 1))
    return f"{value:.{decimals}f}"


def share_per_1000(lo_name, arrivals):
    """Return '991 (984–995)' as on the page."""
    share, lo, hi = (arrivals[f"{lo_name}_{k}"] for k in ("probability", "lo", "hi"))
    return "-" if share is None else f"{share * 1000:.0f} ({math.floor(lo * 1000)}–{math.ceil(hi * 1000)})"


def table_row(text, name):
    """Return the lines of a table that begin with a name."""
    return [line for line in text.splitlines() if line.strip().startswith(name)]


def expect_cells(line, *cells):
    """Expect a table line with these cells, separated by blanks."""
    wanted = r"\s+".join(re.escape(c).replace(r"\ ", " ") for c in cells)
    expect(re.search(rf"(^|\s){wanted}(\s|$)", line), f"'{'  '.join(cells)}' is missing in: {line!r}")


def section(text, name):
    """Return the page's section on one option."""
    lines = text.splitlines()
    first = next((i for i, line in enumerate(lines) if line == name), None)
    expect(first is not None, f"no option '{name}' in:", text)
    end = next((i for i in range(first + 1, len(lines)) if lines[i] and not lines[i].startswith(" ")), len(lines))
    return "\n".join(lines[first:end])


CELL = r"(-|none|[^ (]+(?: \([^()]+\))?)"
SIDES = {"with forest": "wooded", "without forest": "bare"}


def parse_arrivals(text):
    """Return the tables of arrivals, in order: [{"wooded" or "bare": {name of a row: cell}}]."""
    tables, sides = [], []
    for line in text.splitlines():
        head = re.match(r"^  of 1000 +((?:with|without) forest)(?: +(without forest))?$", line)
        row = sides and re.match(rf"^  (\S.*?) +{' +'.join([CELL] * len(sides))}$", line)
        if head:
            sides = [SIDES[side] for side in head.groups() if side]
            tables.append({side: {} for side in sides})
        elif row and not line.startswith("   "):
            for side, cell in zip(sides, row.groups()[1:]):
                tables[-1][side][row[1]] = cell
        else:
            sides = []
    return tables


@functools.cache
def student(freedom):
    """Return the 97.5 % quantile of Student's law: its density, integrated by Simpson's rule from 0, reaches 0.475 there."""
    scale = math.exp(math.lgamma((freedom + 1) / 2) - math.lgamma(freedom / 2)) / math.sqrt(freedom * math.pi)

    def density(t):
        return scale * (1 + t * t / freedom) ** (-(freedom + 1) / 2)

    step, t, total = 1e-3, 0.0, 0.0
    while total < 0.475:
        total += (density(t) + 4 * density(t + step / 2) + density(t + step)) * step / 6
        t += step
    return t - (total - 0.475) / density(t)


def half_of_mean(figure, count):
    """Return half the width of the 95 % interval of a mean."""
    return figure["se"] * student(count - 1)


def expect_mean(cell, figure, count, what):
    found = re.match(r"(-|[\d.e+-]+)(?: \(([\d.e+-]+)\u2013([\d.e+-]+)\)|\u00b1([\d.e+-]+))?$", cell)
    expect(found, "cells run into one another:", what, cell)
    expect_equal(found[1] == "-", figure["mean"] is None, what)
    if found[1] == "-":
        return
    expect_near(float(found[1]), figure["mean"], 0.006 * abs(figure["mean"]), what)
    if found[2] is not None:
        half = half_of_mean(figure, count)
        for shown, wanted in zip(found.groups()[1:3], (figure["mean"] - half, figure["mean"] + half)):
            expect_near(float(shown), wanted, 0.006 * abs(wanted) + 1e-9, what)
    elif found[4] is not None:
        expect_near(float(found[4]), half_of_mean(figure, count), 0.06 * float(found[4]), what)
    else:
        expect(count < 10 or not figure["se"] or len(cell) > 5, f"no error of {count} rocks: {what}", cell)


def expect_arrivals(rows, arrivals):
    """Compare one side of a table with the JSON of the same run."""
    named = {re.sub(r"^(arrive with more than|above) .* kJ$", "exceed", name): cell for name, cell in rows.items()}
    expect_equal((named.get("exceed", "-"), named["arrive"]), (share_per_1000("exceed", arrivals), share_per_1000("reach", arrivals)), rows)
    expect_mean(named.get("mean energy of those that arrive, kJ", "-"), arrivals["energy_kJ"], arrivals["rocks_reached"], rows)
    expect_mean(named.get("mean speed of those that arrive, m/s", "-"), arrivals["speed_m_s"], arrivals["rocks_reached"], rows)
    p95 = arrivals["energy_kJ"]["p95"]
    expect_equal(named.get("95 % stay below, kJ", "-"), digits(p95, 3) if p95 is None or p95 < 1e9 else named["95 % stay below, kJ"], rows)
    expect(re.split("[ \u00b1]", named["energy per released rock, kJ"])[0] == digits(arrivals["energy_per_released_kJ"]["mean"], 3), "kJ a rock", rows)
    ways = (("stopped by stems before it", "stopped_by_stems"), ("at rest before it", "came_to_rest"), ("left the slope before it", "left_slope"))
    for name, key in ways:
        expect_equal(named.get(name, "0"), f"{arrivals['missed'][key] * 1000:.0f}", rows)


def expect_option(text, option, alone=True):
    """Expect the page of an option to equal the JSON of the same run; with several options the bare slope has its own section."""
    flat_text = re.sub(r"\s+", " ", text)
    tables = parse_arrivals(text)
    flown = option["controls"][0]["wooded"] is not None
    expect_equal(len(tables), len(option["controls"]) if alone or flown else 0, "tables of what arrives")
    for table, control in zip(tables, option["controls"]):
        expect_equal("bare" in table, alone, "what arrives without forest")
        if alone:
            expect_arrivals(table["bare"], control["bare"])
        expect(flown or "wooded" not in table, "figures of rocks that do not fly", table)
        if "wooded" not in table:
            continue
        expect_arrivals(table["wooded"], control["wooded"])
        ways = ("stopped_by_stems", "came_to_rest", "left_slope")
        expect_near(control["wooded"]["reach_probability"] + sum(control["wooded"]["missed"].values()), 1, 1e-12, "all released end somewhere")
        shares = [f"{option['ends'][k] * 1000:.0f}" for k in ways]
        expect_in("On the whole profile: of 1000, {} are stopped by stems, {} come to rest, {} leave it".format(*shares),
                  flat_text, "ends")
        if control["wooded"]["rocks_reached"] > 0:
            expect_equal(table["wooded"].get("stems hit per arriving rock", "0"), digits(control["wooded"]["contacts"]["mean"], 3), "stems hit")
    words = {"pass": "passes", "fail": "FAILS", "unknown": "unknown"}
    told = [c for c in option["controls"] if c["verdict"]["answer"] != "nothing"]
    nothing = len(re.findall("Contact, free run and energy cannot be assessed", flat_text))
    expect_equal(nothing, len(option["controls"]) - len(told), "cannot be assessed")
    for name, key in (("Contact", "contact"), ("Free run", "free_run"), ("Energy", "energy")):
        said = re.findall(rf"\b{name}: (\w+)\. (\S+)", flat_text)
        expect_equal([word for word, reason in said], [words[c["lights"][key]] for c in told], name)
        expect(all(reason for _, reason in said), f"{name} without a reason", text)


def side_by_side(text, names):
    """Return the table of options and the page: head, {name: its line}, the page in one line."""
    lines = text[text.lower().index("\nside by side"):].split("\n\n")[0].strip().splitlines()
    head = next(i for i, line in enumerate(lines) if line.strip().startswith("option"))
    rows = lines[head + 1:head + 1 + len(names)]
    for name, row in zip(names, rows):
        shown = re.split(r" {2,}|…", row.strip())[0].rstrip("…")
        expect(shown and name.startswith(shown), f"{name!r} is not the name of {row!r}")
    return lines[head], dict(zip(names, rows)), " ".join(text.split())


def columns(line):
    return sum(2 if unicodedata.east_asian_width(c) in "WF" else 1 for c in line)


BLOCK = re.compile(r"^ {2}([> ]) +([\d.]+) +([\d.]+) +([\d.]+) +([\d.]+|none) +([\d.]+) +(-|\d+ \(\d+–\d+\))$")


def parse_sizes(text):
    """Return the table of other block sizes: [(own, volume, mass, diameter, ADC, contacts, per 1000)]."""
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
