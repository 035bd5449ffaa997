#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Do the tests notice when a line is wrong? tests/changes.py [WORD...] puts each change of changes.txt (those whose block holds a
word) into a copy of the tree, builds it and runs the tests named, until one fails. Fails where none does."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TAPS = "build/release/tests"


def make(tree, *goals):
    return subprocess.run(["make", "-j2", *goals], cwd=tree, check=False, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT)


def failing(tree, test):
    """The first test that fails in this file."""
    tap = tree / TAPS / f"{test}.tap"
    tap.unlink(missing_ok=True)
    done = make(tree, f"{TAPS}/{test}.tap")
    if not tap.exists():
        sys.exit(f"{test} does not run:\n{done.stdout}")
    found = re.search(r"^not ok.*?- (.*)", tap.read_text(encoding="utf-8", errors="replace"), re.M)
    return found and found[1]


def noticed(tree, block):
    """By which test, or why the change cannot be tried."""
    name, old, new, tests = (re.sub(r"^[-+] ", "", line) for line in block.splitlines())
    path = tree / name
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    if text.count(old) != 1:
        return False, f"'{old}' stands {text.count(old)} times there"
    path.write_text(text.replace(old, new), encoding="utf-8")
    try:
        built = make(tree)
        if built.returncode:
            return False, "it cannot be built:\n" + built.stdout[-2000:]
        for test in tests.split():
            if failed := failing(tree, test):
                return True, f"{test}: {failed}"
        return False, "NOT NOTICED"
    finally:
        path.write_text(text, encoding="utf-8")


def main():
    missed = 0
    blocks = [b for b in Path(__file__).with_suffix(".txt").read_text(encoding="utf-8").split("\n\n") if not b.startswith("#")]
    with tempfile.TemporaryDirectory(prefix="ceduo-changes-") as folder:
        tree = Path(folder) / "tree"
        shutil.copytree(ROOT, tree, symlinks=True, ignore=shutil.ignore_patterns(".git", "asan", "cov", "fuzz", "tsan"))
        make(tree)
        for block in blocks:
            if len(sys.argv) > 1 and not any(word in block for word in sys.argv[1:]):
                continue
            good, why = noticed(tree, block.strip())
            missed += not good
            print(f"{block.splitlines()[0]}: {block.splitlines()[2]}\n    {why}", flush=True)
    sys.exit(1 if missed else 0)


if __name__ == "__main__":
    main()
