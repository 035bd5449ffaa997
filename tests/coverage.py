#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines and branches of the rooms of PARTS that the tests have gone through: tests/coverage.py BUILD

BUILD is the folder of a build with gcc's --coverage whose tests were run. A branch that none of them took has to be
explained by a comment on its line or the one before, /* untaken: TAG */, or /* untaken 3: TAG */ of three; one that is not is
named and the status is 1. What is explained and taken all the same is named, too.
"""
import json
import os
import re
import subprocess
import sys
import tempfile
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PARTS = ("src/base/", "src/scene/", "src/core/", "src/study/", "src/io/")


class Line:
    def __init__(self):
        self.count = 0
        self.function = ""
        self.branches = []  # how often each was taken

    def add(self, found):
        """What one object says of it: headers are part of several, and a macro may make several functions of a line."""
        self.count += found["count"]
        self.function = found.get("function_name", self.function)
        counts = [b["count"] for b in found["branches"]]
        self.branches += [0] * (len(counts) - len(self.branches))
        for i, count in enumerate(counts):
            self.branches[i] += count

    def missed(self):
        return sum(count == 0 for count in self.branches)


def read(build):
    """Path and number of each line that is code -> Line."""
    notes = sorted(p.resolve() for part in PARTS for p in (build / part).rglob("*.gcno"))
    if not notes:
        sys.exit(f"{build}: no build with --coverage")
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([os.environ.get("GCOV") or "gcov", "--json-format", "--stdout", "--branch-probabilities", *notes],
                              cwd=folder, stdout=subprocess.PIPE, check=True)
    files = defaultdict(lambda: defaultdict(Line))
    for text in done.stdout.splitlines():
        for found in json.loads(text)["files"]:
            if found["file"].startswith(PARTS):
                for line in found["lines"]:
                    files[found["file"]][line["line_number"]].add(line)
    return files


# ---- what is explained ----

TAGS = {
    "memory": "an allocation fails just here; the tests of faults make each fail, in a build that does not count",
    "table": "a value that is none of its table's, which readers and checks do not let through",
    "machine": "another processor than the one that the tests run on, or a place where the program's own path is not known",
    "race": "another program comes between two calls of the system, or who ends a work between two looks at whether it is ended",
    "system": "a call of the system that is interrupted or fails late, which the tests of faults do, in a build that does not count",
    "rounding": "a guard against the last bit of a sum, or against an underflow, that no test has met",
    "large": "more rocks, vertices or memory than the tests spend",
    "gsl": "the GNU Scientific Library has no memory or does not end, which tests that make allocations fail do not reach",
    "bound": "keeps within an array whose length follows from what was computed before; without it a change there would read beyond",
}
MARK = re.compile(r"/\* untaken(?: (\d+))?: (\w+) \*/")


def marks(path):
    """Number of a line -> (branches, tag) of the mark on it, or alone on the line before it."""
    found = {}
    for number, text in enumerate((ROOT / path).read_text().splitlines(), 1):
        mark = MARK.search(text)
        if mark:
            found[number + (text.strip() == mark.group())] = int(mark[1] or 1), mark[2]
    return found


# ---- the report ----

def share(part, whole):
    return f"{part:6} of {whole:5} {100 * part / whole:6.2f} %" if whole else " " * 25


def report(files):
    print(f"{'':28} {'lines':>22} {'branches':>25}")
    sums = defaultdict(lambda: [0] * 4)
    for path in sorted(files):
        lines = files[path].values()
        counts = (sum(x.count > 0 for x in lines), len(lines), sum(len(x.branches) - x.missed() for x in lines),
                  sum(len(x.branches) for x in lines))
        for name in (str(Path(path).parent), "both"):
            sums[name] = [a + b for a, b in zip(sums[name], counts)]
        print(f"{path:28}", share(*counts[:2]), share(*counts[2:]))
    for name, counts in sorted(sums.items(), key=lambda x: x[0] == "both"):
        print(f"{name:28}", share(*counts[:2]), share(*counts[2:]))


def judge(files):
    """Prints lines with branches that nobody took and nothing explains, and marks that are not needed; true if all is explained."""
    good, explained = True, defaultdict(int)
    for path in sorted(files):
        reasons = marks(path)
        for number, line in sorted(files[path].items()):
            missed, (most, tag) = line.missed(), reasons.get(number, (0, None))
            explained[tag] += min(missed, most)
            if missed > most or tag and tag not in TAGS:
                good = False
                print(f"{path}:{number}: {missed} not taken, {most} explained: {line.function}")
            elif missed < most:
                print(f"{path}:{number}: stale, {missed} of {most} not taken: {line.function}")
    print(f"not taken and explained: {sum(explained.values())}", ", ".join(f"{tag} {explained[tag]}" for tag in TAGS))
    return good


def main():
    files = read(Path(sys.argv[1]))
    report(files)
    sys.exit(0 if judge(files) else 1)


if __name__ == "__main__":
    main()
