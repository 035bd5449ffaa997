#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Text in the language of the locale or of --language; data the same in each."""
import shutil
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import CEDUO, USAGE, Folder, ceduo, environment, expect, expect_equal, expect_in, good, run_all, subprocess  # noqa: E402

ENGLISH, ITALIAN = "print this help", "stampa questo aiuto"


def test_environment():
    """LC_ALL, LC_MESSAGES, LANG and LANGUAGE choose as gettext does, though the locale is not installed"""
    none = {"LC_ALL": None}
    for env, wanted in (({"LC_ALL": "it_IT.UTF-8"}, ITALIAN), ({"LC_ALL": "it_IT"}, ITALIAN), ({"LC_ALL": "it"}, ITALIAN),
                        ({**none, "LANG": "it_CH.utf8"}, ITALIAN), ({**none, "LC_MESSAGES": "it_IT.UTF-8"}, ITALIAN),
                        ({"LC_ALL": "C.UTF-8"}, ENGLISH), ({"LC_ALL": "C", "LANGUAGE": "it"}, ENGLISH), (none, ENGLISH),
                        ({"LC_ALL": "it_IT.UTF-8", "LANGUAGE": "en"}, ENGLISH),
                        ({"LC_ALL": "it_IT.UTF-8", "LANGUAGE": "en_GB:it"}, ITALIAN),
                        ({**none, "LANG": "it_IT.UTF-8", "LC_MESSAGES": "C"}, ENGLISH),
                        ({"LC_ALL": "C", "LANG": "it_IT.UTF-8"}, ENGLISH), ({"LC_ALL": "italic.UTF-8"}, ENGLISH),
                        ({"LC_ALL": "xx_YY.UTF-8"}, ENGLISH)):
        expect_in(wanted, good("--help", env=env).out, env)


def test_option():
    """--language goes before the environment, and an error after it is in its language; another word is refused"""
    for env in ("C", "C.UTF-8", "it_IT.UTF-8", "xx_YY"):
        expect_in(ITALIAN, good("--language", "it", "--help", env={"LC_ALL": env}).out, env)
        expect_in(ENGLISH, good("--help", "--language=en", env={"LC_ALL": env}).out, env)
    expect_equal(ceduo("--language", "fr").status, USAGE)


def test_without_translation():
    """A program alone in a folder has no translation: its text is English"""
    with Folder() as f:
        program = shutil.copy2(CEDUO, f.path / "ceduo")
        env = environment(LC_ALL="it_IT.UTF-8")
        done = subprocess.run([program, "--language", "it", "--help"], env=env, capture_output=True, text=True, check=True)
        expect(ENGLISH in done.stdout or ITALIAN in done.stdout, done.stdout)  # Italian where it is installed
        expect_equal(done.stderr, "")


if __name__ == "__main__":
    run_all(__name__)
