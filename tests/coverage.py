#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines and branches of the rooms of PARTS that the tests have gone through: tests/coverage.py BUILD

BUILD is the folder of a build with gcc's --coverage whose tests were run. A branch that none of them took has to be
explained in tests/coverage.txt; one that is not is named and the status is 1. What is explained and taken all the same is
named, too.
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
REASONS = ROOT / "tests" / "coverage.txt"


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

class Reason:
    def __init__(self, place, text, tag, most, where):
        self.place, self.text, self.tag, self.most, self.where = place, text, tag, most, where
        self.used = 0


def read_reasons():
    """TAG: why, and then PATH:FUNCTION: TEXT OF THE LINE | TAG [branches]. Says what is wrong with them, too."""
    tags, reasons, wrong = {}, {}, []
    for number, line in enumerate(REASONS.read_text().splitlines(), 1):
        where = f"{REASONS.relative_to(ROOT)}:{number}"
        tag = re.fullmatch(r"(\w+): +(\S.*)", line)
        entry = re.fullmatch(r"(src/\S+:\w+): +(\S.*) \| (\w+)(?: (\d+))?", line)
        if not line or line[0] in "# ":
            continue
        if entry and entry[3] in tags:
            key = entry[1], entry[2]
            if key in reasons:
                wrong.append(f"{where}: given twice")
            reasons[key] = Reason(entry[1], entry[2], entry[3], int(entry[4] or 1), where)
        elif tag and not entry:
            tags[tag[1]] = tag[2]
        else:
            wrong.append(f"{where}: no entry with a known tag: {line}")
    return tags, reasons, wrong


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


def judge(files, reasons):
    """Lines with branches that nobody took and nothing explains; marks the reasons that are used."""
    bad = []
    for path in sorted(files):
        texts = (ROOT / path).read_text().splitlines()
        alike = defaultdict(int)  # the same text may stand in a function more than once
        lines = {}
        for number, line in sorted(files[path].items()):
            key = f"{path}:{line.function}", texts[number - 1].strip()
            alike[key] += line.missed()
            lines.setdefault(key, number)
        for key, missed in alike.items():
            reason = reasons.get(key)
            if reason:
                reason.used = missed
            if missed > (reason.most if reason else 0):
                bad.append(f"{path}:{lines[key]}: {missed} not taken: {key[0]}: {key[1]}")
    return bad


def main():
    files = read(Path(sys.argv[1]))
    report(files)
    tags, reasons, wrong = read_reasons()
    bad = judge(files, reasons)
    explained = defaultdict(int)
    for reason in reasons.values():
        explained[reason.tag] += min(reason.used, reason.most)
        if reason.used < reason.most:
            print(f"{reason.where}: stale, {reason.used} of {reason.most} not taken: {reason.place}: {reason.text}")
    print(f"not taken and explained: {sum(explained.values())}", ", ".join(f"{tag} {explained[tag]}" for tag in tags))
    for line in wrong + bad:
        print(line)
    sys.exit(1 if wrong or bad else 0)


if __name__ == "__main__":
    main()
