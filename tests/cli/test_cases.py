#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes and commands with their messages: the cases are in cases/*.txt, and their heads explain the format."""
import re
import shlex
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import DONE, INPUT, USAGE, Folder, ceduo, expect, run_all  # noqa: E402

CASES = Path(__file__).resolve().parent / "cases"

# Completes a case to a valid scene.
PLAIN = ("ceduo: scene/1", "rock: {diameter_m: 0.5, density_kg_m3: 2600}",
         "slope: {vertices_m: [[0, 50], [40, 20], [100, 0]], segments: [{rn: 0.3, rt: 0.8}, {rn: 0.3, rt: 0.8}]}",
         "controls: [{x_m: 20}]", "simulation: {rocks: 10}")


def unescaped(line):
    """Characters that no text file should hold stand as \\r, \\u2028."""
    return re.sub(r"\\(r|u[0-9a-f]{4})", lambda m: "\r" if m[1] == "r" else chr(int(m[1][1:], 16)), line)


def check(folder, case):
    """Return why a case fails; None: it passes."""
    sets, said, shown, lines, files, command, status = [], [], [], [], {}, "--check @", None
    for line in case:
        word, _, rest = line.partition(": ")
        if word.startswith("file "):
            files[word[5:]] = files.get(word[5:], "") + rest + "\n"
            continue
        if word in ("run", "exit"):
            command, status = (rest, status) if word == "run" else (command, int(rest))
            continue
        kinds = {"set": sets, "says": said, "shows": shown}
        kinds.get(word, lines).append(rest if word in kinds else unescaped(line))
    text = [line for line in PLAIN if not any(own.startswith(line.partition(":")[0]) for own in lines)] + lines
    path = folder.write("scene.yaml", "\n".join(text) + "\n")
    for name, content in files.items():
        folder.write(name, content)
    done = ceduo(*(path if word == "@" else word for word in shlex.split(command)), *(word for s in sets for word in ("-s", s)))
    told = [line for line in done.err.splitlines() if not line.startswith(("  ", "try 'ceduo"))
            and "is valid without this change" not in line]
    changed = bool(told) and all(line.startswith("--set:") for line in told)
    wanted = status if status is not None else DONE if not said else USAGE if changed else INPUT
    good = len(told) == len(said) and all(any(one in line for line in told) for one in said) and done.status == wanted
    good = good and all(one in done.out for one in shown)
    return None if good else "\n".join([*case, f"ends with {done.status} and is told:", *told, *(done.out.splitlines() if shown else ())])


def groups():
    """Return (title, cases) of all files."""
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
