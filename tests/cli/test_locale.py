#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: brief
"""No locale and no terminal setting changes a number."""
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import FULL, PROFILES, Folder, Skip, ceduo, expect, expect_equal, good, run_all
from pages import WHOLE, expect_width
from runs import FOUR, PAPER, without_seconds


PAGE = ("--batch", "-s", "uncertainty=none")  # uncertainty takes most of a page's time; test_short.py has it in ASCII
MEAN = re.compile(r"(\S*[\d-]) ?(?:\+-|\u00b1) ?(\S+)")


def expect_same_means(*pages):
    """A mean has the digits that fit its column, and "+-" is a column wider than its character: number pairs of both pages
    agree except for the last digit. A line may end between a mean and its error."""
    pairs = [[number for pair in MEAN.findall(" ".join(page.split())) for number in pair] for page in pages]
    expect_equal(*(len(p) for p in pairs), "numbers beside an error")
    for one, other in zip(*pairs):
        if one == other == "-":  # too few rocks for an error
            continue
        numbers = [re.fullmatch(r"[(>]?([+-]?\d+(?:\.(\d+))?)[,.;:)]*", n) for n in (one, other)]
        expect(all(numbers), "no number with a dot:", one, other)
        unit = sum(0.5 * 10 ** -len(n.group(2) or "") for n in numbers)
        expect(abs(float(numbers[0].group(1)) - float(numbers[1].group(1))) <= unit * 1.0001, one, other)


def test_plain_ascii():
    """LC_ALL=C: all output and messages are pure ASCII, with the same numbers"""
    def ascii_only(done):
        for data in (done.out_bytes, done.err_bytes):
            bad = [line for line in data.splitlines() if any(b >= 0x80 for b in line)]
            expect(not bad, "not ASCII:", *bad[:5])
        return done
    plain = {"LC_ALL": "C"}
    for path in sorted((PROFILES / "scenes").glob("*.yaml")):
        text, wide = (good(*PAGE, "-n", 20, path, env=env) for env in (plain, {}))
        text, wide = ascii_only(text).out, wide.out
        expect_same_means(*(good(*WHOLE, "-n", 50, path, env=env).out for env in (plain, {})))
        texts = [MEAN.sub("", page) for page in (text, wide)]
        expect_equal(*(re.findall(r"\d+\.\d+", page) for page in texts), "numbers")
        expect_width(text)
    ascii_only(good(*PAGE, "-n", 5, PAPER, "-s", "title=Überraschung — 𝄞", env=plain))


def test_plain_ascii_lists():
    """LC_ALL=C: lists and messages on standard error are pure ASCII"""
    plain = {"LC_ALL": "C"}
    cases = [good(mode, env=plain) for mode in ("--help", "--version", "--list-parameters", "--list-profiles")]
    cases += [ceduo("--batch", PAPER, "-s", value, env=plain)
              for value in ("forest[0].stand={shoots: [{per_ha: 1, dbh_m: 1, height_m: 1}]}", "title=[ü]", "rock.ü=1")]
    bad = [line for done in cases for line in (done.out_bytes + done.err_bytes).splitlines()
           if any(b >= 0x80 for b in line)]
    expect(not bad, "not ASCII:", *bad[:6])


def comma_locale(folder, name):
    """Return the environment of a locale with a decimal comma; made here, so that it is equal on all machines."""
    if not shutil.which("localedef") or not Path("/usr/share/i18n/locales", name).exists():
        raise Skip("no localedef to make a locale with a comma")
    subprocess.run(["localedef", "-i", name, "-f", "UTF-8", str(folder / f"{name}.UTF-8")], capture_output=True, check=False)
    env = {"LC_ALL": f"{name}.UTF-8", "LOCPATH": str(folder)}
    point = subprocess.run(["locale", "decimal_point"], env={**os.environ, **env}, capture_output=True, text=True, check=True)
    expect_equal(point.stdout.strip(), ",", f"the locale {env}")
    return env


def test_comma_locale():
    """A locale with a decimal comma, in any language: numbers are read and written with a dot"""
    with Folder() as f:
        for name in ("de_DE", "it_IT") if FULL else ("it_IT",):  # compiling one takes most of the time
            env = comma_locale(f.path, name)
            for words in (*((*PAGE, "-f", form, PAPER, "-s", "rock.diameter_m=0.75") for form in ("table", "csv", "json")),
                          ("--list-parameters",)):
                found, wanted = [without_seconds(good("--language", "en", *words, env=e).out) for e in (env, {})]
                expect_equal(found, wanted, (name, *words))


def test_plain_environment():
    """NO_COLOR, TERM=dumb, no TERM, no HOME, unknown locales change nothing"""
    short = (*PAGE, "-n", 50, FOUR)
    wanted = good(*short).out
    for env in ({"NO_COLOR": "1"}, {"TERM": "dumb"}, {"TERM": None}, {"HOME": None}, {"HOME": ""}, {"XDG_DATA_HOME": ""},
                {"XDG_DATA_HOME": "relative"}):
        expect_equal(good(*short, env=env).out, wanted, str(env))
    good(*short, env={"LC_ALL": "xx_YY.UTF-8"})


if __name__ == "__main__":
    run_all(__name__)
