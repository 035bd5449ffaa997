#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compare the whole output of the program with that of an earlier commit, for changes without effect.

tests/net.py [--before COMMIT] [--program FILE] [--against FILE] [--only PATTERN] [--list]

Both programs run the same cases in the same folder on the scenes of this tree. Standard output, standard error, exit status and
all files are compared byte for byte; each differing case is shown with the first lines of its difference. The status is 1 if
any differs, 2 if they cannot be compared. The earlier program is built once per commit and kept in build/before. The default of
--before is HEAD, or the commit before it if nothing has changed since HEAD.
"""
import argparse
import difflib
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.dont_write_bytecode = True  # keeps a clean tree clean
ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "tests/cli"), str(ROOT / "tests/tui")]
import play  # noqa: E402
import test_errors  # noqa: E402
import test_input  # noqa: E402
import test_random_keys  # noqa: E402
import test_rotation  # noqa: E402
import test_screens  # noqa: E402
from harness import PATIENCE, PROFILES  # noqa: E402

# Not compared: values that vary between runs; and the version except in --version, because a new one
# would change every JSON.
BLANKED = [(re.compile(pattern), blank) for pattern, blank in (
    (rb'"seconds": [-+.0-9e]+', b'"seconds": -'),
    (rb'"version": "[^"]*"', b'"version": "-"'))]

SHOWN = 20  # lines of a difference
LOOKED = 400  # lines compared from the first difference on: more would take long to align
WIDE = 160  # longer lines are split

# the programs, as `make` places them
TOOLS = {"ceduo": "ceduo", "@tables": "tests/tables", "@completion": "man/completion"}


class Case:
    """Commands that run in sequence in a folder with some files. A command is ceduo's words, or begins with the name of another
    tool."""

    def __init__(self, name, *commands, files=None, stdin=b"", **env):
        self.name, self.commands, self.files, self.stdin, self.env = name, commands, files or {}, stdin, env


# ---- scenes ----

SCENES = sorted(path.stem for path in (PROFILES / "scenes").glob("*.yaml"))
SEEDS = ROOT / "tests/fuzz/seeds"
FEW = ["-j", 1, "-n", 200]
FORMATS = {"table": ["-f", "table"], "csv": ["-f", "csv"], "stands": ["-f", "csv", "--rows", "stands"], "json": ["-f", "json"]}
PLOTS = re.findall(r'^ +X\([A-Z]+, (\w+), ', (ROOT / "src/view/plot.h").read_text(), re.M)
SMALL = (SEEDS / "scene/small.yaml").read_text()
CSV_SLOPE = SMALL[:SMALL.index("slope:")] + "slope: {csv: line.csv}\n" + SMALL[SMALL.index("controls:"):]


def easy(text):
    """Return the scene with rocks that touch the ground at most a few times: fast, so that every key can be awaited."""
    for old, new in (("vx_m_s: 1", "vx_m_s: 12"), ("[[0, 80], [60, 30], [100, 0]]", "[[0, 120], [60, 40], [100, 0]]")):
        if old not in text:
            raise ValueError(old)
        text = text.replace(old, new)
    return text


EASY = {"easy.yaml": easy(play.FAST), "easy-options.yaml": easy(play.OPTIONS), "other.yaml": easy(play.FAST),
        "line.csv": test_random_keys.CSV}


def by_index(name):
    """Return a shipped scene computed by the index alone."""
    return play.in_the_index((PROFILES / f"scenes/{name}.yaml").read_text())


# ---- screens ----

SIZES = [f"{width} {height}" for width, height in test_screens.SIZES]


def script(text):
    """Return a script that waits after each key. 'dump' saves the screen and its roles; 'find WORD' searches, 'set VALUE' types
    into the field, 'clear' dismisses the message. ' | ' ends a line, too."""
    lines, size, taken = ["wait idle"], "80x24", 0
    for line in text.strip().replace(" | ", "\n").split("\n"):
        word, _, rest = line.strip().partition(" ")
        if word in ("dump", "roles"):
            lines += [f"dump {taken:03}-{size}.txt", f"roles roles-{taken:03}-{size}.txt"]
            taken += 1
            continue
        if word == "resize":
            size = "x".join(rest.split())
        keys = {"key": [f"key {key}" for key in rest.split()], "clear": ["key Ctrl-L"],
                "find": ["key /", "key Ctrl-U", f"type {rest}", "key Enter"],
                "set": ["key Enter", "key Ctrl-U", f"type {rest}", "key Enter"]}.get(word, [line.strip()])
        lines += [x for key in keys for x in (key, "wait idle")]
    return "\n".join(lines) + "\n"


def screen(name, text, scene, files=None, **env):
    files = {**(files or {}), "play.txt": script(text)}
    return Case(f"screen/{name}", ["-j", 1, "--script", "play.txt", scene], files=files, **env)


def every_view(sizes=SIZES, charsets=1, views="123456"):
    lines = []
    for view in views:
        lines.append(f"key {view}")
        for _ in range(charsets):
            lines += [line for size in sizes for line in (f"resize {size}", "clear", "dump")]
            lines += ["key b"] * (charsets > 1)
    return "\n".join(lines)


def every_key(view):
    """Return each key of the program once, closing any popup after it."""
    keys = [word for _, word, word2, _, _ in play.actions() for word in (word, word2) if word and word not in ("q", "F10")]
    return "\n".join(f"key {view}\nkey {key}\ndump\nkey Esc Esc" for key in keys + ["q"])


FORMS = {  # input in fields, and its results
    "stand": "key 2 | find stools.per_ha | set 1000 | dump | find shoots[0] | set 3000 | dump | key u u Ctrl-R | dump"
             " | key Enter | dump | key Tab | dump",
    "rock": "key 3 | find rock.shape | key Enter Down | dump | key Enter | dump | key u | find rock.diameter_m"
            " | set {mean: 0.5, spread: 0.1} | dump",
    "range": "key 3 | find rock.diameter_m | set 0 | dump | key Esc | find release.x_m | set -7 | dump | key Esc"
             " | find threshold_m | set 5 | dump | set | dump",
    "slope": "key 1 | resize 200 70 | find vertices_m[1] | set [60, 45] | dump | set here | dump | key Esc | key y | dump"
             " | find controls[0] | key a | dump | key d d d | dump",
    "belts": "key 1 | resize 200 70 | find forest[0] | key y | dump | key > | dump | key d | dump | find forest[1].from_m"
             " | set 20 | dump",
    "steps": "key 2 | find stools.per_ha | key + - - | dump | key 3 | find simulation.law | key + | dump | find scale_rn"
             " | key + | dump | find contact_model | key Enter | dump",
    "line": "key 3 | find title | key Enter | type Über dem Weg | key Home Del | type u | key End Backspace | dump"
            " | key Enter | dump | find zzz | dump",
    "cohorts": "key 2 | resize 120 60 | find shoots[0] | key y | dump | key > d d d | dump | find trees[0] | key y a | dump"
               " | key d d d d d | dump",
    "rotation": "key 6 | find cut_year | set 3 | dump | key Tab Right Right | dump | find rotation_years | set 9 | dump",
    "save": "key 2 | find stools.per_ha | set 2222 | key s | dump | find trees[0] | key y s | dump | key S Ctrl-U"
            " | type mine.yaml | key Enter | dump",
}
POPUPS = {
    "help": "key ? | dump | key PgDn | dump | key PgDn | dump | key Esc | key 4 ? | dump",
    "presets": "key 2 p | dump | " + "key Down | dump | " * 40 + "key Enter | dump",
    "new": "key n | dump | type Above the mill | key Enter | type 0 120, 40 60; 90 0 | key Enter Enter | type 0.9 | key Enter"
           " | type 80 | key Enter | type 30 | key Enter | dump | key Enter | dump | key s | dump | key Ctrl-U | type mill.yaml"
           " | key Enter | dump",
    "new-wrong": "key n Enter | type 0 10 | key Enter Enter Enter Enter Enter Enter | dump | key Up Up Up Up | type x"
                 " | key Enter Enter Enter Enter | dump",
    "new-csv": "key n Enter | type line.csv | key Enter Enter Enter | type 60 | key Enter Enter Enter | dump",
    "open": "key o | dump | key End | dump | key Home Enter | type missing.yaml | key Enter | dump | key Esc | key o Enter"
            " | type other.yaml | key Enter | dump",
    "export": "key w | dump | key Enter | dump | key Enter | dump | key w Down Enter Enter | key w Down Down Enter Enter"
              " | key w Down Down Down Enter Enter | dump | key w End Enter | dump | key Esc | key w Enter Enter | dump",
    "counts": "key 2 | find forest[1] | key c | dump | type 300 | key Tab Tab Tab | type 90 | key Tab | type 200 | key Tab"
              " | dump | key Enter | dump | type 12 | key Enter | dump",
    "find": "key 2 | find trees[0].per_ha | key f | dump | key Enter Enter Enter | dump | key u f Ctrl-U | type energy"
            " | key Enter Enter Enter | dump | key Up Up Ctrl-U | type energy=120 | key Enter Enter Enter | dump",
    "search": "key 3 / | dump | type density | key Enter | dump | key N | dump | find zzz | dump",
    "quit": "find stools | key 2 + | key q | dump | key Down | dump | key Enter | dump",
    "choices": "key 3 | find simulation.rule | key Enter | dump | key Esc | key 1 | find stand | key Enter | dump"
               " | key End Enter | dump",
    "ways": "key . | dump | key . , Tab Right | dump | key Down Down Down | dump | key 2 | dump",
    "options": "key 5 | dump | key y | dump | key > < | dump | key Enter | type mine | key Enter | dump | key a | dump"
               " | key G Enter | dump | key d | dump | key ] 2 | dump",
}


def screens():
    wood = {"wood.yaml": play.WOOD, "years.yaml": test_rotation.WOOD, "cuts.yaml": play.CUTS}
    yield screen("views/paper-site", every_view(), "paper-site")
    yield screen("views/cuts", every_view(views="15"), "cuts.yaml", wood)
    yield screen("views/wood", every_view(), "wood.yaml", wood, LC_ALL="C")
    yield screen("views/years", every_view([*SIZES, "60 20", "59 19"], charsets=3), "years.yaml", wood)
    for name in SCENES:
        yield screen(f"views/{name} by index", every_view(), f"{name}.yaml", {f"{name}.yaml": by_index(name)})
    for name, env in {"UTF-8": {}, "C": {"LC_ALL": "C"}, "NO_COLOR": {"NO_COLOR": "1"}}.items():
        for scene in ("easy.yaml", "easy-options.yaml"):
            yield screen(f"views/{scene} {name}", every_view(charsets=3), scene, EASY, **env)
        yield screen(f"help/{name}", POPUPS["help"], "easy.yaml", EASY, **env)
    for view in range(1, 7):
        yield screen(f"keys/view {view}", every_key(view), "easy-options.yaml", EASY)
    for chapter, texts in {"form": FORMS, "popup": POPUPS}.items():
        for name, text in texts.items():
            scene = "easy-options.yaml" if name == "options" else "easy.yaml"
            yield screen(f"{chapter}/{name}", text, scene, EASY)
            yield screen(f"{chapter}/{name} 120x40", "resize 120 40\n" + text, scene, EASY, LC_ALL="C")
    for path in sorted((SEEDS / "keys").iterdir()):
        yield screen(f"seed/{path.name}", path.read_text(), "easy.yaml", EASY)
    for seed in range(12):
        text = test_random_keys.random_script(random.Random(seed), test_random_keys.words_of_keys(), 40)
        yield screen(f"random/{seed}", text, ("easy.yaml", "easy-options.yaml")[seed % 2], EASY)
    yield Case("screen/stdout", ["-j", 1, "--script", "-", "easy.yaml"], files=EASY,
               stdin=b"wait idle\nkey 3\ndump -\nkey ?\ndump -\n")


# ---- pages, pictures, years ----

SETS = {
    "rock": ["rock.diameter_m=1", "rock.height_m={mean: 1, spread: 0.1}"],
    "sphere": ["rock={shape: sphere, mass_kg: 500}"],
    "block": ["rock={shape: block, axes_m: [0.5, 0.6, {mean: 0.8, spread: 0.05, kind: uniform}]}"],
    "release": ["release.vx_m_s={mean: 2, spread: 0.5}", "release.height_m=3", "release.spin_rad_s=5"],
    "vertex": ["slope.vertices_m[3]=[26.95, 77]"],
    "ground": ["slope.segments[1].rn={mean: 0.35, spread: 0.03}", "slope.segments[2].roughness_rad=0.4"],
    "facets": ["slope.facets=both"],
    "stools": ["forest[0].stand.stools.per_ha=2000", "forest[ADS 2].stand.trees[0].per_ha=120"],
    "base": ["forest[0].stand={base: simple-coppice, stools: {per_ha: 1000}}"],
    "exchange": ["forest[0].stand=large-reserves", "forest[1].stand=bare"],
    "gap": ["forest[0].to_m=30"],
    "no forest": ["forest=[]"],
    "species": ["forest[0].stand.species=quercus-cerris", "forest[0].stand.energy={model: dorren, fracture_ratio: 1.5}"],
    "spread of stems": ["forest[0].stand.shoots[0].dbh_sd_m=0.02"],
    "controls": ["controls=[{x_m: 40, name: upper}, {x_m: 135, name: road, accepted_kJ: 100}]"],
    "no accepted": ["controls=[{x_m: 135}, {x_m: 60}]"],
    "rule": ["simulation.rule=crofton", "simulation.threshold_m=2"],
    "gsteiger": ["simulation.rule=gsteiger-stools", "simulation.gravity_m_s2=3.7", "simulation.scale_rn=true"],
    "bare": ["forest=[{from_m: 0, to_m: 60, stand: bare}]"],
    "title": ['title="Ünder \\e[31m the mill"', "simulation.seed=7"],
}
MODELS = [(law, model) for law in ("lumped", "crsp") for model in ("stems", "index")]


def pages():
    for name in SCENES:
        for form, words in FORMATS.items():
            yield Case(f"page/{name}/{form}", ["-b", *FEW, *words, name])
        yield Case(f"page/{name}/table in C", ["-b", *FEW, name], LC_ALL="C")
        for law, model in MODELS[1:]:
            words = ["-b", *FEW, "-s", f"simulation.law={law}", "-s", f"simulation.contact_model={model}", name]
            yield Case(f"page/{name}/{law} {model}", words, [*words, "-f", "json"])
    for form, words in FORMATS.items():
        yield Case(f"page/several/{form}", ["-b", *FEW, *words, "paper-site", "road-below", "terrace"])
        yield Case(f"page/several, one bad/{form}", ["-b", *FEW, *words, "paper-site", "none.yaml", "road-below"])
        options = ["--option", "large reserves", "--option", "selection coppice"]
        yield Case(f"page/options/{form}", *(["-b", *FEW, *words, *some, "four-systems"] for some in (options, options[:2])))
        yield Case(f"page/tolerance/{form}", ["-b", "-j", 1, "-e", 0.04, *words, "road-below"],
                   ["-b", "-j", 1, "-e", 0.001, "-n", 2000, *words, "terrace"])
        yield Case(f"page/path/{form}", ["-b", *FEW, *words, "../../profiles/scenes/paper-site.yaml"])
    for name, sets in SETS.items():
        words = ["-b", *FEW, *(w for s in sets for w in ("-s", s)), "paper-site"]
        yield Case(f"page/set/{name}", words, [*words, "-f", "json"])
    for path in sorted((SEEDS / "set").iterdir()):
        words = [w for line in path.read_text().splitlines() for w in ("-s", line)]
        yield Case(f"page/set/seed {path.name}", ["-b", *FEW, *words, "paper-site"], ["-b", *words, "s.yaml"],
                   ["-b", *FEW, *words, "four-systems"], files={"s.yaml": SMALL})
    json = ["-b", "-f", "json", "paper-site"]
    yield Case("page/rocks", [*json, "-n", 1], [*json, "-n", 3], [*json, "-n", 1025, "-j", 3], [*json, "-n", "2e3"], json)
    yield Case("page/seed", [*json, "--seed", 0], [*json, "--seed", 9007199254740992])
    yield Case("page/output", [*json, "-n", 9, "-o", "out.json"], ["-b", "-n", 9, "-o", "old.txt", "paper-site"],
               [*json, "-n", 9, "-o", "no/such/folder"], files={"old.txt": "old"})
    yield Case("page/files beside the scene", ["-b", "scene.yaml"], ["-b", "-f", "json", "scene.yaml"], files=test_input.FILES)


def pictures():
    for name in SCENES:
        for kind in PLOTS:
            years = ["--years", "0:3"] if kind == "rotation" else []
            words = ["--plot", kind, "-j", 1, "-n", 100, *years]
            yield Case(f"plot/{name}/{kind}", *([*words, "--charset", charset, "--size", size, name]
                                               for charset in test_screens.CHARSETS for size in ("80x24", "130x44")))
    for kind in PLOTS:
        index = ["--plot", kind, "-j", 1, "-n", 100, "-s", "simulation.contact_model=index", "paper-site"]
        yield Case(f"plot/by index/{kind}", index)
        yield Case(f"plot/in C/{kind}", ["--plot", kind, "-j", 1, "-n", 100, "road-below"], LC_ALL="C")
        yield Case(f"plot/small/{kind}", ["--plot", kind, "-j", 1, "-n", 100, "--size", "20x6", "terrace"])
    yield Case("plot/whole rotation", ["--plot", "rotation", "-j", 1, "-n", 20, "rotation"])


def years():
    for name in SCENES:
        for form in ("table", "csv", "json"):
            yield Case(f"years/{name}/{form}", ["--years", "0:3", "-j", 1, "-n", 60, *FORMATS[form], name])
    for form in FORMATS:
        yield Case(f"years/steps/{form}", ["--years", "0:26:13", "-j", 1, "-n", 60, *FORMATS[form], "staggered"])
    yield Case("years/index", ["--years", "0:26", "-s", "simulation.contact_model=index", *FEW, "rotation"])


# ---- searches, lists ----

def goals():
    stools = "forest[0].stand.stools.per_ha=100:5000"
    for form in ("table", "csv", "json"):
        for goal in ("adc", "adc=2", "free-run", "energy=75", "exceed=0.55"):
            yield Case(f"find/{goal}/{form}", ["--find", stools, "--goal", goal, *FEW, *FORMATS[form], "paper-site"])
    for name, path, goal in (("none", "forest[0].to_m=10:67", "energy=1"), ("largest", "rock.diameter_m=0.2:2", "energy=40"),
                             ("all", "rock.height_m=0.1:0.2", "exceed=1"), ("no such", "rock.x=1:2", "adc")):
        yield Case(f"find/{name}", ["--find", path, "--goal", goal, *FEW, "paper-site"],
                   ["--find", path, "--goal", goal, *FEW, "-f", "json", "-s", "simulation.contact_model=index", "paper-site"])
    yield Case("find/option", ["--find", "options[2].forest[0].stand.trees[0].per_ha=10:500", "--goal", "adc=25", "--option",
                               "coppice with standards", *FEW, "four-systems"])


def lists():
    for words in (["--list-parameters"], ["--list-profiles"], ["--help"], ["--version"], []):
        name = " ".join(words) or "no words"
        yield Case(f"list/{name}", words)
        yield Case(f"list/{name} in C", words, LC_ALL="C")
    yield Case("list/to a file", ["--list-parameters", "-o", "list.txt"])
    for shell in ("bash", "zsh"):
        yield Case(f"list/completion of {shell}", ["@completion", shell])
    for kind, page in (("ranges", "ceduo-scene.5"), ("figures", "ceduo-output.5"), ("keys", "ceduo-terminal.7")):
        yield Case(f"list/manual of {kind}", ["@tables", kind, page], files={page: (ROOT / "man" / page).read_text()})


# ---- input, valid and invalid ----

def check_and_run(name, scene, files, **more):
    return Case(name, ["--check", scene], ["-b", *FEW, scene], files=files, **more)


def standard_input():
    yield Case("input/table", ["-b", *FEW, "-"], stdin=SMALL.encode())
    yield Case("input/json", ["-b", *FEW, "-f", "json", "-"], stdin=SMALL.encode())
    yield Case("input/picture", ["--plot", "profile", *FEW, "-"], stdin=SMALL.encode())
    yield Case("input/twice", ["-b", "-", "-"], stdin=SMALL.encode())
    for name, text in (("nothing", b""), ("bytes", bytes(range(256))), ("cut", SMALL[:300].encode()),
                       ("CRLF", SMALL.replace("\n", "\r\n").encode())):
        yield check_and_run(f"input/{name}", "-", {}, stdin=text)
    for name in SCENES:
        yield Case(f"input/check {name}", ["--check", name])
    yield Case("input/check all", ["--check", *SCENES, "none", "faults.yaml", "paper-sit"],
               files={"faults.yaml": (SEEDS / "scene/faults.yaml").read_text()})
    for path in sorted((SEEDS / "scene").iterdir()):
        yield check_and_run(f"input/seed {path.name}", "s.yaml", {"s.yaml": path.read_text()})
    for path in sorted((SEEDS / "csv").iterdir()):
        yield check_and_run(f"input/seed {path.name}", "s.yaml", {"s.yaml": CSV_SLOPE, "line.csv": path.read_bytes()})


def faults():
    """Return the bad input of the tests."""
    for i, (file, old, new, *words) in enumerate(test_input.CASES):
        yield check_and_run(f"fault/{i} {words[0]}", "scene.yaml", test_input.mutated(file, old, new)[0])
    for row, case in test_errors.CASES.items():
        name = f"error/{row}"
        if isinstance(case, test_errors.File):
            yield check_and_run(name, "scene.yaml", test_input.mutated(case.name, case.old, case.new)[0])
        elif isinstance(case, test_errors.Text):
            text = case.text.replace("@@", "") if isinstance(case.text, str) else case.text
            yield check_and_run(name, "s.yaml", {"s.yaml": text, **case.more})
        elif isinstance(case, test_errors.Words):
            yield Case(name, ["scene.yaml" if w == "@" else w for w in case.words], files=test_input.FILES)
        elif isinstance(case, test_errors.Set):
            words = [w for s in case.changes for w in ("-s", s.replace("@@", ""))]
            yield Case(name, ["-b", *words, "scene.yaml"], files=test_input.FILES)
        elif isinstance(case, test_errors.Script):
            yield Case(name, ["--script", "play.txt", "scene.yaml"], files={**test_input.FILES, "play.txt": case.text})


def all_cases():
    """Return all cases, slowest first, so that the cores end together."""
    chapters = (screens, pictures, pages, years, goals, standard_input, faults, lists)
    return [case for chapter in chapters for case in chapter()]


# ---- running ----

class Program:
    """A program with its tools, renamed in the folder of both runs."""

    def __init__(self, path, bed, name):
        self.paths = {}
        for tool, place in TOOLS.items():
            found = path if tool == "ceduo" else path.parent / place
            if found.exists():
                self.paths[tool] = shutil.copy(found, bed / f"build/release/{name}{tool}")

    def run(self, case, folder):
        """Return the result of a case: the name of each stream or file, and its bytes."""
        folder.mkdir()
        for name, content in case.files.items():
            (folder / name).write_bytes(content.encode() if isinstance(content, str) else content)
        outcome = {}
        for i, words in enumerate(case.commands, 1):
            tool, words = (words[0], words[1:]) if words and words[0] in TOOLS else ("ceduo", words)
            before = f"command {i}, " if len(case.commands) > 1 else ""
            status, out, err = self.call(tool, words, case, folder)
            outcome[before + "exit status"] = f"{status}\n".encode()
            outcome[before + "standard output"], outcome[before + "standard error"] = out, err
        for path in sorted(p for p in folder.rglob("*") if p.is_file()):
            outcome[str(path.relative_to(folder))] = path.read_bytes()
        shutil.rmtree(folder)
        return {name: blanked(data) for name, data in outcome.items()}

    def call(self, tool, words, case, folder):
        if tool not in self.paths:
            return "not built", b"", b""
        try:
            done = subprocess.run([tool, *map(str, words)], executable=self.paths[tool], input=case.stdin,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=folder,
                                  env={**play.home(folder / "home", rocks=None), **case.env}, timeout=PATIENCE, check=False)
        except subprocess.TimeoutExpired:
            return "hangs", b"", b""
        return done.returncode, done.stdout, done.stderr


def blanked(data):
    for pattern, blank in BLANKED:
        data = pattern.sub(blank, data)
    return data


# ---- showing ----

def printable_lines(data):
    """Return text in printable lines: JSON and other long lines are split."""
    for line in data.decode("utf-8", "backslashreplace").removesuffix("\n").split("\n"):
        for part in re.sub(r",\s*", ",\n", line).split("\n") if line.startswith('{"') or len(line) > WIDE else [line]:
            yield "".join(c if c.isprintable() else ascii(c)[1:-1] for c in part)


def difference(name, before, now):
    """Return lines that show the difference of two streams or files; None is a missing one."""
    if before is None or now is None:
        return [f"{name}: only {'now' if before is None else 'before'}"]
    both = [list(printable_lines(data)) for data in (before, now)]
    same = next((i for i, (a, b) in enumerate(zip(*both)) if a != b), min(map(len, both)))
    both = [lines[:same + LOOKED] for lines in both]
    found = list(difflib.unified_diff(*both, f"{name} before", f"{name} now", lineterm=""))
    return found or [f"{name}: {len(before)} bytes before, {len(now)} now, that look the same"]


def show(case, before, now, names):
    print(f"differs: {case.name}")
    lines = []
    while names and len(lines) < SHOWN:
        name = names.pop(0)
        lines += difference(name, before.get(name), now.get(name))
    for line in lines[:SHOWN] + ["…"] * (len(lines) > SHOWN) + [f"and {', '.join(names)}"] * bool(names):
        print(f"  {line[:WIDE]}")
    sys.stdout.flush()


def compare(cases, old, new):
    """Return the number of differences."""
    start, differ, ends = time.monotonic(), 0, Counter()
    with tempfile.TemporaryDirectory(prefix="ceduo-net-") as folder:
        bed = Path(folder)
        (bed / "build/release").mkdir(parents=True)
        (bed / "cases").mkdir()
        shutil.copytree(PROFILES, bed / "profiles")
        programs = [Program(old, bed, "old"), Program(new, bed, "new")]

        def outcomes(i):
            return [program.run(cases[i], bed / f"cases/{i:04}") for program in programs]

        with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
            for case, (before, now) in zip(cases, pool.map(outcomes, range(len(cases)))):
                ends.update(data.decode().strip() for name, data in now.items() if name.endswith("exit status"))
                names = [name for name in {**before, **now} if before.get(name) != now.get(name)]
                if names:
                    differ += 1
                    show(case, before, now, names)
    words = ", ".join(f"{n} with {status}" for status, n in sorted(ends.items()))
    print(f"{len(cases)} cases, {differ} differ; of the commands now {words} ended; {time.monotonic() - start:.0f} s")
    return differ


# ---- the earlier program ----

# from a calling make; not for the build of the earlier program
ABOVE = ("MAKEFLAGS", "MFLAGS", "MAKEOVERRIDES", "MAKELEVEL", "BUILD", "CFLAGS")


class Unable(Exception):
    """The programs cannot be compared."""


def output_of(*command, **options):
    try:
        return subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=True, **options).stdout
    except (OSError, subprocess.CalledProcessError) as error:
        why = getattr(error, "stderr", b"") or b""
        raise Unable(f"{' '.join(map(str, command))}: {why.decode(errors='replace').strip()[-3000:] or error}") from error


def commit_before(wanted):
    if not wanted:
        wanted = "HEAD" if output_of("git", "status", "--porcelain").strip() else "HEAD~1"
    found = output_of("git", "rev-parse", "--verify", f"{wanted}^{{commit}}").decode().strip()
    title = output_of("git", "log", "-1", "--format=%h %s", found).decode().strip()
    print(f"before: {wanted}, {title}", flush=True)
    return found


def built(commit):
    """Return the program of a commit, built if necessary."""
    place = ROOT / "build/before" / commit
    if not (place / "build/release/ceduo").exists():
        half = place.with_name(f"{commit}.{os.getpid()}")
        half.mkdir(parents=True)
        try:
            output_of("tar", "-x", "-C", half, input=output_of("git", "archive", commit))
            env = {k: v for k, v in os.environ.items() if k not in ABOVE}
            make = ["make", "-C", half, f"-j{os.cpu_count() or 1}", f"CC={os.environ.get('CC') or 'gcc'}", "VARIANT=release"]
            for tool in TOOLS.values():
                try:
                    output_of(*make, f"build/release/{tool}", env=env)
                except Unable:
                    if tool == TOOLS["ceduo"]:
                        raise
            shutil.rmtree(place, ignore_errors=True)
            half.rename(place)
        finally:
            shutil.rmtree(half, ignore_errors=True)
    return place / "build/release/ceduo"


def main():
    words = argparse.ArgumentParser(description=__doc__.split("\n")[0], allow_abbrev=False)
    words.add_argument("--before", metavar="COMMIT", help="compare with the program of this commit")
    words.add_argument("--program", metavar="FILE", type=Path, default=ROOT / "build/release/ceduo", help="the program of now")
    words.add_argument("--against", metavar="FILE", type=Path, help="the program of before, instead of a commit's")
    words.add_argument("--only", metavar="PATTERN", default="", help="cases in whose names this regular expression is found")
    words.add_argument("--list", action="store_true", help="print the names of the cases")
    given = words.parse_args()
    cases = [case for case in all_cases() if re.search(given.only, case.name)]
    if given.list:
        print("\n".join(case.name for case in cases))
        return 0
    try:
        if not cases:
            raise Unable(f"no case has '{given.only}' in its name")
        old = given.against or built(commit_before(given.before))
        for path in (old, given.program):
            if not path.exists():
                raise Unable(f"there is no {path}")
        return 1 if compare(cases, old, given.program) else 0
    except Unable as why:
        print(f"net: {why}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
