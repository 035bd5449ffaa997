#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: unsanitized
"""Popups: a table with too many fields or answers fails at build time."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
from harness import ROOT, Skip, expect, run_all  # noqa: E402

# file, the array to overflow, and the words of the assertion
TOO_MANY = [
    ("src/scene/fields_observed.c", ("src/scene/schema.h", r"(ASKED_FIELDS_MAX +)\d+", r"\g<1>5"), "crossing_fields: more than a popup"),
    ("src/scene/fields.c", ("src/scene/schema.h", r"(ASKED_FIELDS_MAX +)\d+", r"\g<1>5"), "page_fields: more than a popup"),
    ("src/scene/fields_observed.c", ("src/scene/schema.h", r"(ASKED_KINDS_MAX +)\d+", r"\g<1>5"), "more kinds than there are digits"),
    ("src/tui/edit.c", ("src/scene/schema.h", r"(ASKED_FIELDS_MAX +)\d+", r"\g<1>17"), "all fields of a mapping"),
    ("src/tui/view_observed.c", ("src/scene/schema.h", r"(ASKED_KINDS_MAX +)\d+", r"\g<1>10"), "a digit chooses a kind"),
    ("src/tui/view_observed.c", ("include/ceduo/calibrate.h", r"(CALIBRATION_MAX +)\d+", r"\g<1>17"), "all values that can be fitted"),
    ("src/tui/popup_measured.c", ("src/tui/popup_measured.c", r", COUNTS }", ", MORE, COUNTS = MORE + 8 }"), "all counts"),
]


def compiles(root, name):
    compiler = os.environ.get("CC", "cc").split()
    return subprocess.run([*compiler, "-std=c17", "-D_GNU_SOURCE", "-Iinclude", "-Isrc", "-fsyntax-only", name], cwd=root,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)


def test_limits():
    """One field or answer too many does not compile, the unchanged table does"""
    if not shutil.which(os.environ.get("CC", "cc").split()[0]):
        raise Skip("no compiler here")
    with tempfile.TemporaryDirectory() as folder:
        for part in ("src", "include"):
            shutil.copytree(ROOT / part, Path(folder) / part, ignore=lambda d, names: [n for n in names if n.endswith(".po")])
        for name, (changed, pattern, instead), words in TOO_MANY:
            path = Path(folder) / changed
            text = path.read_text()
            done = compiles(folder, name)
            expect(done.returncode == 0, f"{name} as it is:", done.stdout)
            path.write_text(re.sub(pattern, instead, text, count=1))
            done = compiles(folder, name)
            expect(done.returncode != 0 and words in done.stdout, f"{name} with another {changed}:", done.stdout or "compiles")
            path.write_text(text)


if __name__ == "__main__":
    run_all(__name__)
