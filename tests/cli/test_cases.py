#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes and what --check says of them: the cases are in cases/*.txt, whose head says how one is written."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import DONE, Folder, ceduo, expect, run_all  # noqa: E402

CASES = Path(__file__).resolve().parent / "cases"

# What a case does not say of a scene that is good.
PLAIN = ("ceduo: scene/1", "rock: {diameter_m: 0.5, density_kg_m3: 2600}",
         "slope: {vertices_m: [[0, 50], [40, 20], [100, 0]], segments: [{rn: 0.3, rt: 0.8}, {rn: 0.3, rt: 0.8}]}",
         "controls: [{x_m: 20}]", "simulation: {rocks: 10}")


def unescaped(line):
    """Characters that no text file should hold stand as \\r, \\u2028."""
    return re.sub(r"\\(r|u[0-9a-f]{4})", lambda m: "\r" if m[1] == "r" else chr(int(m[1][1:], 16)), line)


def check(folder, case):
    """Why a case does not hold; None: it does."""
    sets, said, lines = [], [], []
    for line in case:
        word, _, rest = line.partition(": ")
        {"set": sets, "says": said}.get(word, lines).append(rest if word in ("set", "says") else unescaped(line))
    text = [line for line in PLAIN if not any(own.startswith(line.partition(":")[0]) for own in lines)] + lines
    path = folder.write("scene.yaml", "\n".join(text) + "\n")
    done = ceduo("--check", path, *(word for s in sets for word in ("-s", s)))
    told = [line for line in done.err.splitlines() if not line.startswith("  ") and "is valid without this change" not in line]
    good = len(told) == len(said) and all(any(one in line for line in told) for one in said) and (done.status == DONE) != bool(said)
    return None if good else "\n".join([*case, "is told:", *told])


def groups():
    """(title, cases) of all files."""
    for path in sorted(CASES.glob("*.txt")):
        title, cases = "", []
        for line in path.read_text(encoding="utf-8").splitlines():
            if line.startswith("# "):
                continue
            if line.startswith("== "):
                if title:
                    yield title, cases
                title, cases = line[3:], [[]]
            elif line == "":
                cases.append([])
            elif cases:
                cases[-1].append(line)
        yield title, cases


def made(title, cases):
    def test():
        with Folder() as f:
            wrong = [why for case in cases if case for why in [check(f, case)] if why]
        expect(not wrong, "\n\n".join(wrong))
    test.__doc__ = title
    return test


for number, (heading, listed) in enumerate(groups()):
    globals()[f"test_{number}"] = made(heading, listed)

if __name__ == "__main__":
    run_all(__name__)
