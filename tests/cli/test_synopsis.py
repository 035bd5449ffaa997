#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: manual
"""The manual against the program: the forms of ceduo(1) have exactly the options that fit them."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import INPUT, ROOT, USAGE, Folder, ceduo, expect, expect_equal, run_all  # noqa: E402

# value of each option, then the options that it requires
VALUES = {"format": "csv", "output": "out.csv", "set": "rock.diameter_m=1", "rocks": "10", "tolerance": "0.1", "rows": "controls",
          "each": "none.csv", "columns": "scene", "seed": "1", "threads": "1", "option": "a", "charset": "ascii", "language": "en",
          "size": "80x24", "sure": "0.9", "script": "none.txt", "find": "rock.diameter_m=1:2", "goal": "adc", "report": "page.html", "key": "a", "chapters": "1",
          "calibrate": "rock.diameter_m=1:2", "plot": "rotation", "survey": "none.csv", "schema": "result"}
NEEDS = {"key": ["--each=none.csv"], "chapters": ["--each=none.csv"], "rows": ["--format=csv"], "columns": ["--format=csv"], "resume": ["--format=csv", "--each=none.csv", "--output=out.csv"]}
MODES = ("batch", "find", "goal", "calibrate", "sensitivity", "report", "plot", "check", "survey", "list-parameters",
         "list-profiles", "list-columns", "schema", "help", "version")


def options():
    """Return the options of --help: {'rows': '', 'seed': '', 'rocks': 'n', …}, and their letters."""
    found = re.findall(r"^  (?:-(.),|   ) --([a-z-]+)", ceduo("--help").out, re.M)
    expect(len(found) > 30, found)
    return {name: letter for letter, name in found}


def forms():
    """Return the forms of the SYNOPSIS: ([[modes], …], {options})."""
    letters = {letter: name for name, letter in options().items() if letter}
    page = (ROOT / "man/ceduo.1").read_text()
    text = page[page.index(".Sh SYNOPSIS"):page.index(".Sh DESCRIPTION")]
    for form in text.split("\n.Nm\n")[1:]:
        alternatives, others = [[]], set()
        for line in form.split("\n"):
            for part in re.split(r" (?=\| Fl)", line):
                for word in re.findall(r"\bFl (-?[\w-]+)", part)[:1]:
                    name = word[1:] if word.startswith("-") else letters[word]
                    if line.startswith(".Op"):
                        others.add(name)
                    elif part.startswith("|"):
                        alternatives.append([name])
                    else:
                        alternatives[0].append(name)
        yield alternatives, others


def write_option(name):
    return f"--{name}={VALUES[name]}" if name in VALUES else f"--{name}"


def is_accepted(modes, option):
    """True if the program accepts an option with a mode: it then misses the scene."""
    words = {f"--{m}" if m in ("batch", "check") else write_option(m) for m in modes} | {write_option(option), *NEEDS.get(option, [])}
    done = ceduo(*sorted(words), *([] if "survey" in modes else ["none.yaml"]))
    expect(done.status in (USAGE, INPUT), words, done)
    return done.status == INPUT


def test_words():
    """--help names each goal and each picture"""
    help_text = " ".join(re.split(r"\n\n", ceduo("--help").out)[3].split())
    for option in ("goal", "plot"):
        words = re.search(r"one of: (.*)", ceduo(f"--{option}=none", "--batch", "none.yaml").err)[1].split(", ")
        listed = re.search(rf"--{option} [A-Z]+\S* (.*?) --", help_text)[1]
        expect(len(words) > 5 and not [word for word in words if not re.search(rf"(?<![\w-]){word}(?![\w-])", listed)], words, listed)


def test_all_options():
    """The SYNOPSIS has exactly the options of --help"""
    named = {name for alternatives, others in forms() for name in {*others, *sum(alternatives, [])}}
    expect_equal(sorted(named - {"template"}), sorted(options()))


def test_forms():
    """Each form has exactly the options that the program accepts with it"""
    with Folder():
        seen = 0
        for alternatives, others in forms():
            modes = alternatives[0]
            if not modes or modes[0].startswith("list-") or modes[0] == "help":
                continue
            seen += 1
            wanted = {o for o in options() if o not in MODES and o != "script" and is_accepted(modes, o)}
            expect_equal(sorted(others - {"sensitivity"}), sorted(wanted), f"options of {modes}")
        expect_equal(seen, 8, "forms")


if __name__ == "__main__":
    run_all(__name__)
