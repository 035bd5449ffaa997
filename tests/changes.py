#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Do the tests notice when a line is wrong? tests/changes.py [WORD...] puts each change of changes.txt (those whose block holds a
word) into a copy of the tree, builds it and runs the tests named, until one fails. Fails where none does. The tests must pass
before: one that fails already seems to notice everything."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TAPS = "build/release/tests"


def failing(tree, test):
    """The first test that fails in this file; make builds what it needs."""
    tap = tree / TAPS / f"{test}.tap"
    tap.unlink(missing_ok=True)
    done = subprocess.run(["make", "-j2", f"{TAPS}/{test}.tap"], cwd=tree, check=False, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, env=os.environ | {"TEST_FIRST": "1"})
    if not tap.exists():
        return "it cannot be built:\n" + done.stdout[-2000:]
    found = re.search(r"^not ok.*?- (.*)", tap.read_text(encoding="utf-8", errors="replace"), re.M)
    return found and f"{test}: {found[1]}"


def noticed(tree, name, old, new, tests):
    """By which test, or why the change cannot be tried."""
    path = tree / name
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    if text.count(old) != 1:
        return False, f"'{old}' stands {text.count(old)} times there"
    path.write_text(text.replace(old, new), encoding="utf-8")
    try:
        for test in tests.split():
            if failed := failing(tree, test):
                return not failed.startswith("it cannot"), failed
        return False, "NOT NOTICED"
    finally:
        path.write_text(text, encoding="utf-8")


def changes():
    """File, line, what is put in its place and tests of each."""
    for block in Path(__file__).with_suffix(".txt").read_text(encoding="utf-8").strip().split("\n\n"):
        if not block.startswith("#"):
            yield [re.sub(r"^[-+] ", "", line) for line in block.splitlines()]


def main():
    missed = 0
    with tempfile.TemporaryDirectory(prefix="ceduo-changes-") as folder:
        tree = Path(folder) / "tree"
        shutil.copytree(ROOT, tree, symlinks=True, ignore=shutil.ignore_patterns(".git", "asan", "cov", "fuzz", "tsan"))
        for name, old, new, tests in changes():
            if not any(word in " ".join((name, old, new, tests)) for word in sys.argv[1:] or [""]):
                continue
            good, why = noticed(tree, name, old, new, tests)
            missed += not good
            print(f"{name}: + {new}\n    {why}", flush=True)
    sys.exit(1 if missed else 0)


if __name__ == "__main__":
    main()
