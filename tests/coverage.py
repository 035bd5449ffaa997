#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Line and branch coverage of the rooms in PARTS: tests/coverage.py BUILD

BUILD is the folder of a build with clang's counters, after its tests. A branch is one outcome of a condition in the source, or
a case of a switch; a macro is counted at its definition. An untaken branch needs a comment on its line or the one before, /*
untaken: TAG */, or /* untaken 3: TAG */ for three. Unexplained ones are reported, with status 1; so are needless comments.
"""
import json
import re
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
PARTS = ("src/base/", "src/scene/", "src/core/", "src/study/", "src/io/")


class File:
    def __init__(self):
        self.ways = defaultdict(lambda: [0, 0])  # line and column of each condition -> number of true and false outcomes
        self.lines = 0, 0  # reached, and all

    def add(self, branch):
        """Add counts: an inline function or a macro is in several objects and places."""
        counts = self.ways[branch[0], branch[1]]
        counts[0] += branch[4]
        counts[1] += branch[5]

    def missed(self):
        """Return line number -> untaken outcomes of its conditions, in words."""
        found = defaultdict(list)
        for (line, column), counts in sorted(self.ways.items()):
            found[line] += [f"{column} {way}" for way, count in zip(("true", "false"), counts) if count == 0]
        return found


def read(build):
    """Return path of each file -> File."""
    counts = build / "all.profdata"
    subprocess.run(["llvm-profdata", "merge", "-sparse", "-o", counts, *(build / "counts").glob("*.profraw")], check=True)
    done = subprocess.run(["llvm-cov", "export", "-instr-profile", counts, build / "libceduo.so"], stdout=subprocess.PIPE,
                          check=True)
    files = defaultdict(File)
    for found in json.loads(done.stdout)["data"][0]["files"]:
        path = str(Path(found["filename"]).relative_to(ROOT))
        files[path].lines = found["summary"]["lines"]["covered"], found["summary"]["lines"]["count"]
        for branch in found["branches"]:
            files[path].add(branch)
        for expansion in found["expansions"]:
            for branch in expansion["branches"]:
                files[str(Path(expansion["filenames"][branch[6]]).relative_to(ROOT))].add(branch)
    return {path: file for path, file in files.items() if path.startswith(PARTS)}


# ---- explanations ----

TAGS = {
    "memory": "an allocation fails just here; the tests of faults make each fail, in a build that does not count",
    "table": "a value that is none of its table's, which readers and checks do not let through",
    "complaint": "a call that reports a problem, and is false always, ends a chain",
    "machine": "another processor than the one that the tests run on, or a place where the program's own path is not known",
    "constant": "known when the program is compiled: no condition is left",
    "end": "the program ends there, and what it counted is lost; the tests of faults and of GSL's errors do it",
    "twice": "setjmp returns twice and is counted once",
    "race": "another program comes between two calls of the system, or who ends a work between two looks at whether it is ended",
    "system": "a call of the system that is interrupted or fails late, which the tests of faults do, in a build that does not count",
    "rounding": "a guard against the last bit of a sum, or against an underflow, that no test has met",
    "large": "more rocks, vertices or memory than the tests spend",
    "gsl": "the GNU Scientific Library has no memory or does not end, which tests that make allocations fail do not reach",
    "bound": "keeps within an array whose length follows from what was computed before; without it a change there would read beyond",
}
MARK = re.compile(r"/\* untaken(?: (\d+))?: (\w+) \*/")


def marks(path):
    """Return line number -> (branches, tag) of the mark on it, or alone on the line before it."""
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
    for path, file in sorted(files.items()):
        counts = *file.lines, sum(bool(n) for pair in file.ways.values() for n in pair), 2 * len(file.ways)
        for name in (str(Path(path).parent), "both"):
            sums[name] = [a + b for a, b in zip(sums[name], counts)]
        print(f"{path:28}", share(*counts[:2]), share(*counts[2:]))
    for name, counts in sorted(sums.items(), key=lambda x: x[0] == "both"):
        print(f"{name:28}", share(*counts[:2]), share(*counts[2:]))


def judge(files):
    """Print lines with unexplained untaken branches, and needless marks; true if there are none."""
    good, explained = True, defaultdict(int)
    for path, file in sorted(files.items()):
        reasons, missed = marks(path), file.missed()
        for number in sorted(reasons.keys() | missed.keys()):
            ways, (most, tag) = missed[number], reasons.get(number, (0, None))
            explained[tag] += min(len(ways), most)
            if len(ways) > most or tag and tag not in TAGS:
                good = False
                print(f"{path}:{number}: {len(ways)} not taken, {most} explained: column {', '.join(ways)}")
            elif len(ways) < most and tag != "machine":
                print(f"{path}:{number}: stale, {len(ways)} of {most} not taken")
    print(f"not taken and explained: {sum(explained.values())}", ", ".join(f"{tag} {explained[tag]}" for tag in TAGS))
    return good


def main():
    files = read(Path(sys.argv[1]))
    report(files)
    sys.exit(0 if judge(files) else 1)


if __name__ == "__main__":
    main()
