#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Check that the tests notice a wrong line. tests/changes.py [WORD...] applies each change of changes.txt (of blocks that
contain a word) to a copy of the tree, builds it and runs the named tests until one fails. Fails if none does. The tests must
pass before: a test that already fails would notice everything. Each core has a copy. Changes of one file run in the same copy,
so that a build serves several."""
import itertools
import os
import queue
import re
import shutil
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TAPS = "build/release/tests"


def failing(tree, test):
    """Return the first test that fails in this file; make builds what it needs."""
    tap = tree / TAPS / f"{test}.tap"
    tap.unlink(missing_ok=True)
    done = subprocess.run(["make", f"{TAPS}/{test}.tap"], cwd=tree, check=False, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, env=os.environ | {"TEST_FIRST": "1"})
    if not tap.exists():
        return "it cannot be built:\n" + done.stdout[-2000:]
    found = re.search(r"^not ok.*?- (.*)", tap.read_text(encoding="utf-8", errors="replace"), re.M)
    return found and f"{test}: {found[1]}"


def noticed(tree, name, old, new, tests):
    """Return the test that noticed the change, or why the change cannot be tried."""
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
    """Yield file, line, replacement and tests of each change."""
    for block in Path(__file__).with_suffix(".txt").read_text(encoding="utf-8").strip().split("\n\n"):
        if not block.startswith("#"):
            yield [re.sub(r"^[-+] ", "", line) for line in block.splitlines()]


def try_file(trees, changes_of_file):
    """Try the changes of one file in a free tree; return how many no test noticed."""
    tree, missed = trees.get(), 0
    try:
        for name, old, new, tests in changes_of_file:
            start = time.monotonic()
            good, why = noticed(tree, name, old, new, tests)
            missed += not good
            print(f"{name}: + {new}\n    {why} ({time.monotonic() - start:.0f} s)", flush=True)
    finally:
        trees.put(tree)
    return missed


def main():
    wanted = sorted(change for change in changes() if any(word in " ".join(change) for word in sys.argv[1:] or [""]))
    files = [list(found) for _, found in itertools.groupby(wanted, key=lambda change: change[0])]
    cores, trees, start = os.cpu_count() or 1, queue.Queue(), time.monotonic()
    with tempfile.TemporaryDirectory(prefix="ceduo-changes-") as folder, ThreadPoolExecutor(cores) as pool:
        for core in range(min(cores, len(files))):
            tree = Path(folder) / f"tree-{core}"
            shutil.copytree(ROOT, tree, symlinks=True, ignore=shutil.ignore_patterns(".git", "asan", "cov", "fuzz", "tsan"))
            trees.put(tree)
        missed = sum(pool.map(try_file, itertools.repeat(trees), files))
    print(f"{len(wanted)} changes, {missed} not noticed, {time.monotonic() - start:.0f} s")
    sys.exit(1 if missed else 0)


if __name__ == "__main__":
    main()
