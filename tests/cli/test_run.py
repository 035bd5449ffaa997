#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: unsanitized
"""Tests run in a defined environment on any machine; CI ends with a summary line."""
import os
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import ROOT, Folder, expect, expect_equal, run_all  # noqa: E402

THEIRS = {"LANG": "it_IT.UTF-8", "LC_ALL": "it_IT.UTF-8", "LC_NUMERIC": "de_DE.UTF-8", "LC_MESSAGES": "it_IT", "LANGUAGE": "it:de",
          "TZ": "Asia/Kolkata", "TERM": "dumb", "COLUMNS": "40", "LINES": "9", "NO_COLOR": "1", "POSIXLY_CORRECT": "1",
          "XDG_DATA_HOME": "/their/data", "XDG_STATE_HOME": "/their/state", "XDG_CONFIG_HOME": "/their/config", "BASH_ENV": "/their/rc",
          "TMUX": "/their/tmux"}


def test_environment():
    """A test has one locale, time zone and terminal, and an empty temporary home; its failures are printed"""
    with Folder() as f:
        test = f.write("test", "#!/bin/sh\nenv | sed 's/^/# /'\nls -A \"$HOME\" | sed 's/^/not ok - home has /'\ntouch \"$HOME/left\"\n"
                               "echo ok 1 - one\n")
        test.chmod(0o755)
        done = subprocess.run([ROOT / "tests/run", f.path / "out/test.tap", test], env={**os.environ, **THEIRS}, capture_output=True,
                              text=True, check=True)
        expect(done.stdout.startswith(f"pass {test} (1, "), done.stdout, done.stderr)
        lines = (f.path / "out/test.tap").read_text().splitlines()
        found = dict(line[2:].split("=", 1) for line in lines if line.startswith("# ") and "=" in line)
        expect_equal({k: found.get(k) for k in THEIRS if k != "XDG_DATA_HOME"},
                     {**dict.fromkeys(k for k in THEIRS if k != "XDG_DATA_HOME"), "LC_ALL": "C.UTF-8", "TZ": "UTC",
                      "TERM": "xterm-256color"})
        expect(not any(k.startswith("XDG_") for k in found), found)
        expect(not Path(found["HOME"]).exists() and found["HOME"] != os.environ.get("HOME"), found["HOME"])
        test.write_text("#!/bin/sh\nexit 3\n")
        done = subprocess.run([ROOT / "tests/run", f.path / "out/test.tap", test], capture_output=True, text=True, check=True)
        expect_equal(done.stdout, f"FAIL {test}\nnot ok - {test} ended with status 3\n")


def ci(folder, *sums):
    """Run .ci/run with a make that prints and then does each of these; return its lines and status."""
    bin_ = folder.path / "bin"
    bin_.mkdir(exist_ok=True)
    (folder.path / "n").write_text("0")
    script = ["#!/bin/sh", f'n=$(cat "{folder.path}/n")', f'echo $((n + 1)) >"{folder.path}/n"', 'echo "$@" in $LC_ALL', "echo said >&2",
              "case $n in", *(f"{i}) {what} ;;" for i, what in enumerate(sums)), "esac"]
    for name, lines in (("make", script), ("localedef", ["#!/bin/sh"])):
        (bin_ / name).write_text("\n".join(lines) + "\n")
        (bin_ / name).chmod(0o755)
    shutil.copytree(ROOT / ".ci", folder.path / ".ci", dirs_exist_ok=True)
    env = {**os.environ, "PATH": f"{bin_}:{os.environ['PATH']}", "LC_ALL": "C"}
    done = subprocess.run([folder.path / ".ci/run"], cwd=folder.path, env=env, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, check=False)
    return done.stdout.splitlines(), done.returncode


def test_ci():
    """CI runs all tests, then some in Italian and in German; only its last line is a summary, and it fails with any part"""
    def print_counts(passed, failed):
        return f'echo "{passed} passed, {failed} failed"; exit {int(failed > 0)}'

    with Folder() as f:
        lines, status = ci(f, print_counts(20, 0), print_counts(3, 0), print_counts(4, 0))
        expect_equal((lines[-1], status), ("27 passed, 0 failed", 0), lines)
        expect_equal([line for line in lines if " in " in line], ["deps check in C", "check-brief in it_IT.UTF-8",
                                                                  "check-brief in de_DE.UTF-8"])
        expect_equal(sum(" passed, " in line for line in lines), 1, lines)
        for sums, wanted in (((print_counts(20, 1), print_counts(3, 0), print_counts(4, 0)), "27 passed, 1 failed"),
                             ((print_counts(20, 0), print_counts(3, 2), print_counts(4, 0)), "27 passed, 2 failed"),
                             ((print_counts(20, 0), print_counts(3, 0), "exit 2"), "23 passed, 1 failed"),
                             ((print_counts(20, 0), print_counts(0, 0), print_counts(4, 0)), "24 passed, 1 failed"),
                             (("exit 1", "exit 1", "exit 1"), "0 passed, 3 failed")):
            lines, status = ci(f, *sums)
            expect_equal((lines[-1], status), (wanted, 1), lines)


if __name__ == "__main__":
    run_all(__name__)
