#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: manual
"""make net: it reports exactly the cases in which two programs differ."""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import CEDUO, PATIENCE, PROFILES, ROOT, Folder, Skip, expect, expect_equal, expect_in, run_all  # noqa: E402

# A program that answers quickly. It writes the dumps of a script.
FAKE = """\
#!/bin/sh
case "$*" in
*--version*) echo "fake 1" ;;
*--script*) for file in $(sed -n 's/^dump //p' play.txt); do echo "a screen" >"$file"; done ;;
*--list-profiles*) echo "no such list" >&2; exit 3 ;;
*) echo '{"version": "1", "energy_kJ": 2.5, "work": {"runs": 3, "seconds": 0.125}}' ;;
esac
"""


def net(*words, tree=ROOT, **env):
    """Return the status and the output of both streams in sequence."""
    done = subprocess.run([sys.executable, tree / "tests/net.py", *map(str, words)], stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, env={**os.environ, **env}, timeout=PATIENCE, check=False)
    return done.returncode, (done.stdout + done.stderr).decode()


def differing(out):
    return re.findall(r"^differs: (.*)$", out, re.M)


def program(folder, name, text):
    path = folder.write(name, text)
    path.chmod(0o755)
    return path


def changed(only, *changes):
    """Compare the fake program with one that has other words."""
    text = FAKE
    for old, new in changes:
        expect_equal(text.count(old), 1, old)
        text = text.replace(old, new)
    with Folder() as f:
        return net("--against", program(f, "old", FAKE), "--program", program(f, "new", text), "--only", only)


def test_same():
    """A program equals itself: no case differs, status 0"""
    with Folder() as f:
        fake = program(f, "fake", FAKE)
        status, out = net("--against", fake, "--program", fake, "--only", "^list/|^screen/form/stand$")
    expect_equal((status, differing(out)), (0, []), out)
    expect(re.search(r"^\d+ cases, 0 differ; ", out, re.M), out)


def test_one_case():
    """Output of a case on a stream or in a file, or its status: each differing case is reported with its lines, status 1"""
    status, out = changed("^list/--(version|list-profiles)$|^screen/form/(line|stand)$|^page/seed$",
                          ("fake 1", "fake 2"), ("such list", "such file"), ("exit 3", "exit 2"), ("2.5", "2.4"),
                          ("play.txt)", "play.txt | sed s/002/0x2/)"))
    wanted = {
        "screen/form/line": ["002-80x24.txt: only before", "0x2-80x24.txt: only now"],
        "screen/form/stand": ["002-80x24.txt: only before", "0x2-80x24.txt: only now"],
        "page/seed": ["--- command 1, standard output before", '-"energy_kJ": 2.5,', '+"energy_kJ": 2.4,'],
        "list/--list-profiles": ["--- exit status before", "+++ exit status now", "-3", "+2", "--- standard error before",
                                 "-no such list", "+no such file"],
        "list/--version": ["--- standard output before", "+++ standard output now", "-fake 1", "+fake 2"]}
    expect_equal((status, sorted(differing(out))), (1, sorted(wanted)), out)
    for name, lines in wanted.items():
        shown = re.search(rf"^differs: {re.escape(name)}\n((?:  .*\n)*)", out, re.M).group(1)
        for line in lines:
            expect_in(f"  {line}\n", shown, name)
    expect(re.search(r"^\d+ cases, 5 differ; ", out, re.M), out)


def test_long():
    """A long difference shows its first 20 lines, and the names of other differing streams and files"""
    status, out = changed("^screen/form/line$", ("echo \"a screen\"", "seq 30"))
    expect_equal((status, differing(out)), (1, ["screen/form/line"]), out)
    shown = out.splitlines()[1:-1]
    expect_equal((len(shown), shown[:2], shown[20]), (22, ["  --- 000-80x24.txt before", "  +++ 000-80x24.txt now"], "  …"), out)
    expect_equal(shown[21], "  and 001-80x24.txt, 002-80x24.txt", out)


def test_blanked():
    """Seconds and the version in JSON are ignored, another figure is not"""
    not_seen = ("0.125", "17"), ('"version": "1"', '"version": "1.2.3"')
    for wanted, changes in ((0, not_seen), (1, (*not_seen, ('"runs": 3', '"runs": 4')))):
        status, out = changed("^page/seed$", *changes)
        expect_equal((status, len(differing(out))), (wanted, wanted), out)


def test_list():
    """--list names every case once, including those of all scenes; if --only matches none nothing is compared"""
    status, out = net("--list")
    names = out.splitlines()
    expect_equal((status, len(set(names))), (0, len(names)), "status, names")
    for scene in (p.stem for p in (PROFILES / "scenes").glob("*.yaml")):
        for name in (f"page/{scene}/json", f"years/{scene}/table", f"plot/{scene}/stand", f"input/check {scene}"):
            expect(name in names, f"no case '{name}'")
    status, out = net("--only", "^nothing$")
    expect_equal((status, out), (2, "net: no case has '^nothing$' in its name\n"))


def test_program():
    """The program against itself: pages, pictures and screens repeat exactly"""
    status, out = net("--against", CEDUO, "--program", CEDUO, "--only", "^list/|^page/paper-site/(table|csv|json)|"
                      "^plot/road-below/stand|^screen/form/steps$|^screen/random/3$")
    expect_equal((status, differing(out)), (0, []), out)
    expect(int(re.search(r"(\d+) with 0", out).group(1)) > 20, "most should end well", out)


# ---- an earlier commit ----

MAKEFILE = """\
build/release/ceduo: fake
\t@mkdir -p build/release
\t@echo built >>"$(LOG)"
\t@grep -q sh fake
\t@cp fake $@
"""


class Tree(Folder):
    """A repository with the fake program."""

    def __enter__(self):
        if not shutil.which("git"):
            raise Skip("no git")
        super().__enter__()
        self.tree, self.log = self.path / "tree", self.path / "log"
        for part in ("tests", "profiles", "man", "src"):
            shutil.copytree(ROOT / part, self.tree / part, ignore=shutil.ignore_patterns("__pycache__", "*.c"))
        self.write("tree/Makefile", MAKEFILE)
        self.write("tree/.gitignore", "/build/\n")
        self.git("init", "-q")
        return self

    def git(self, *words):
        env = {**os.environ, "GIT_CONFIG_GLOBAL": "/dev/null", "GIT_CONFIG_SYSTEM": "/dev/null"}
        return subprocess.run(["git", "-c", "user.name=A", "-c", "user.email=a@b.c", *words], cwd=self.tree, env=env,
                              check=True, stdout=subprocess.PIPE).stdout.decode().strip()

    def commit(self, version):
        program(self, "tree/fake", FAKE.replace("fake 1", version))
        self.git("add", "-A")
        self.git("commit", "-q", "-m", version)
        return self.git("rev-parse", "HEAD")

    def net(self, *words):
        return net("--program", self.tree / "fake", "--only", "^list/--version$", *words, tree=self.tree, LOG=str(self.log))

    def expect_found(self, old, *words):
        """Expect the difference of a version to that of the tree; None: equal."""
        status, out = self.net(*words)
        expect_equal(re.findall(r"^  -(one|two|three|four)$", out, re.M), [old] if old else [], out)
        expect_equal(status, 1 if old else 0, out)
        return out

    def builds(self):
        return self.log.read_text().count("built") if self.log.exists() else 0


def test_commits():
    """Compare with the commit before, with HEAD if something changed, or with a named one; each is built once"""
    with Tree() as t:
        one, two, three = t.commit("one"), t.commit("two"), t.commit("three")
        expect_in("before: HEAD~1, ", t.expect_found("two"))
        t.expect_found(None, "--before", "HEAD")
        expect_equal(t.builds(), 2, "builds")
        program(t, "tree/fake", FAKE.replace("fake 1", "four"))
        expect_in("before: HEAD, ", t.expect_found("three"))
        expect_equal(t.builds(), 2, "builds")
        t.expect_found("one", "--before", one)
        expect_equal(sorted(p.name for p in (t.tree / "build/before").iterdir()), sorted([one, two, three]), "kept")


def test_commits_wrong():
    """An unknown commit, or one that does not build: reported, status 2, no half build is kept"""
    with Tree() as t:
        t.commit("one")
        t.write("tree/fake", "nothing to run\n")
        t.git("commit", "-q", "-a", "-m", "broken")
        t.commit("three")
        status, out = t.net("--before", "no-such-commit")
        expect(status == 2 and "net: git rev-parse" in out and "no-such-commit" in out, status, out)
        status, out = t.net()
        expect(status == 2 and "net: make -C " in out and "Error" in out, status, out)
        expect_equal(list((t.tree / "build/before").iterdir()), [], "kept")


if __name__ == "__main__":
    run_all(__name__)
