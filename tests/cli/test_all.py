#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: uncounted unsanitized
"""tests/all: a part of `make check-all` counts until a file that it reads changes. The parts of these trees only write."""
import os
import shutil
import signal
import subprocess
import time

from harness import PATIENCE, ROOT, Folder, environment, expect, expect_equal, expect_in, run_all

PARTS = "check", "sanitizers", "scenes", "memory"  # read every file; scripts and translations; scripts; the program
MAKEFILE = """all-check all-sanitizers all-scenes all-memory all-fuzz:
	@echo $(@:all-%=%) >>build/ran
	@if [ -e build/fail ]; then exit 1; fi
	@if [ -e build/edit ]; then mv build/edit src/base/edited.c; fi
	@if [ -e build/wait ]; then mkfifo build/never; read word <build/never; fi
"""
FILES = ("README.md", "man/ceduo.1", "src/po/man/it.po", "src/po/it.po", "src/base/a.c", "tests/cli/test_a.py", "tests/run")


class Tree(Folder):
    """A tree with tests/all, under version control if `git`."""

    def __init__(self, git):
        self.git = git

    def __enter__(self):
        super().__enter__()
        self.write("Makefile", MAKEFILE)
        self.write(".gitignore", "/build/\n")
        for name in FILES:
            self.write(name, name)
        shutil.copy(ROOT / "tests/all", self.path / "tests/all")
        self.write("build/ran", "")
        if self.git:
            for words in (["init", "-q"], ["add", "-A"], ["-c", "user.name=a", "-c", "user.email=a@b", "commit", "-qm", "a"]):
                subprocess.run(["git", *words], cwd=self.path, check=True)
        return self

    def start(self, *named):
        env = environment(MAKE="make -s", MAKEFLAGS=None, PARTS=" ".join(PARTS), MORE="fuzz")
        return subprocess.Popen(["tests/all", *named], cwd=self.path, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                text=True, start_new_session=True, env=env)

    def run(self, *named):
        """Return exit status, the parts that ran, and the state of each part."""
        self.write("build/ran", "")
        process = self.start(*named)
        out, _ = process.communicate(timeout=PATIENCE)
        return process.returncode, self.ran(), dict(line.split(": ", 1) for line in out.splitlines()[-1 - len(PARTS):])

    def ran(self):
        return tuple((self.path / "build/ran").read_text().split())

    def expect_run(self, parts, why):
        status, ran, state = self.run()
        expect_equal((status, ran), (0, parts), why)
        expect(all(state[part].startswith("passed, ") for part in PARTS), why, state)


def in_trees(test):
    def run():
        for git in (True, False):
            with Tree(git) as tree:
                test(tree)
    run.__name__, run.__doc__ = test.__name__, test.__doc__
    return run


@in_trees
def test_changed_files(tree):
    """A change of a file that a part reads, committed or not, makes the part run again; other changes do not"""
    tree.expect_run(PARTS, "first")
    tree.expect_run((), "unchanged")
    for name, parts in (("man/ceduo.1", PARTS[:1]), ("src/po/man/it.po", PARTS[:1]), ("src/po/it.po", PARTS[:2]),
                        ("man/examples/a.py", PARTS[:2]), ("tests/fuzz/found/a/b", PARTS[:2]), ("tests/cli/test_a.py", PARTS[:3]),
                        ("tests/run", PARTS), ("src/base/a.c", PARTS), ("src/base/new.c", PARTS), ("new.md", PARTS[:1])):
        tree.write(name, "changed")
        tree.expect_run(parts, name)
    if tree.git:
        subprocess.run(["git", "add", "-A"], cwd=tree.path, check=True)
        tree.expect_run((), "committed")
    (tree.path / "src/base/a.c").unlink()
    tree.expect_run(PARTS, "removed")
    tree.write("src/base/a.c", "changed")
    tree.expect_run((), "as it was")


@in_trees
def test_failed_part(tree):
    """A part that fails does not count; its log is printed"""
    tree.write("build/fail", "")
    status, ran, state = tree.run("memory")
    expect_equal((status, ran), (1, ("memory",)))
    expect_in("MISSING", state["memory"])
    (tree.path / "build/fail").unlink()
    tree.expect_run(PARTS, "no failure")


@in_trees
def test_interrupted_part(tree):
    """A part that is interrupted does not count, nor does one whose files change meanwhile"""
    tree.write("build/wait", "")
    process = tree.start("memory")
    while not (tree.path / "build/never").exists():
        time.sleep(0.01)
    os.killpg(process.pid, signal.SIGINT)
    process.communicate(timeout=PATIENCE)
    (tree.path / "build/wait").unlink()
    tree.write("build/edit", "changed")
    status, ran, state = tree.run("memory")
    expect_equal((status, ran), (1, ("memory",)), state)
    (tree.path / "src/base/edited.c").unlink()
    tree.expect_run(PARTS, "as it was")


@in_trees
def test_states(tree):
    """The state of a part has commit, hash, date and seconds; an additional part runs only if it is named"""
    expect_equal(tree.run("memory")[0], 1, "the others are missing")
    for named, more in ((), "MISSING, "), (("fuzz",), "passed, "):
        status, _, state = tree.run(*named)
        expect_equal(status, 0, state)
        expect(state["fuzz"].startswith(more), state)
    commit = subprocess.run(["git", "describe", "--always", "--abbrev=12"], cwd=tree.path, capture_output=True, text=True,
                            check=False).stdout.strip() if tree.git else "none"
    for text in state.values():
        words = text.split(", ")
        expect_equal(words[:2], ["passed", f"commit {commit}"])
        expect(words[2].startswith("files ") and len(words[2]) == 18 and words[4].endswith(" s"), text)
        time.strptime(words[3], "%Y-%m-%d")
    expect_equal(tree.run("none")[0], 1, "no such part")


if __name__ == "__main__":
    run_all(__name__)
