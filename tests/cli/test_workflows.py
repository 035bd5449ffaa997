#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: slow uncounted manual
"""ceduo-workflows(7): each way runs in an empty folder and has the results that the page states.

With --readme: updates the page and the screens in README.md.
"""
import csv
import functools
import io
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import harness
from harness import CEDUO, FULL, PATIENCE, ROOT, Folder, expect, expect_equal, expect_in, expect_near

PAGE = ROOT / "man" / "ceduo-workflows.7"
PAGINA = ROOT / os.environ.get("BUILD", "build/release") / "man/it/ceduo-workflows.7"
README = ROOT / "README.md"
# po4a puts a comment before its paragraph
RUN = re.compile(r'^\.\\" run (\S+)\n(?:(?!\.Bd|\.\\")[^\n]*\n)*\.Bd -literal[^\n]*\n(.*?)^\.Ed$', re.M | re.S)
KEYS_MOST = 25


def render_literal(text):
    """Return a literal display as its reader sees it."""
    for escape, sign in ((r"\(aq", "'"), (r"\-", "-"), (r"\&", ""), (r"\(ha", "^"), (r"\(ti", "~"), (r"\e", "\\")):
        text = text.replace(escape, sign)
    requests = [line for line in text.splitlines() if line.startswith(".")]
    expect(not requests, "requests in a literal display:", *requests)
    return text


def blocks(way, page=PAGE):
    return [render_literal(body) for name, body in RUN.findall(page.read_text(encoding="utf-8")) if name == way]


# A replacement for Slurm: runs the tasks of an array in sequence. In tests/slurm.sh Slurm is real.
SLURM = "SLURM_CONF" in os.environ
# Options of GNU parallel. Without a number of jobs it asks lscpu for the processors, which fails without /sys.
PARALLEL = "-j 2"
SBATCH = """#!/bin/sh
tasks=${1#--array=}
shift
failed=0
for range in $(echo "$tasks" | tr , ' '); do
    for i in $(seq "${range%-*}" "${range#*-}"); do
        SLURM_ARRAY_TASK_ID=$i SLURM_CPUS_PER_TASK=1 sh "$@" || failed=1
    done
done
exit $failed
"""


class Machine(Folder):
    """A home with the program, its profiles and Slurm on the path."""

    def __enter__(self):
        super().__enter__()
        (self.path / "bin").mkdir()
        (self.path / "bin/ceduo").symlink_to(CEDUO)
        (self.path / "share").mkdir()
        (self.path / "share/ceduo").symlink_to(ROOT / "profiles")
        if not SLURM:
            self.write("bin/sbatch", SBATCH).chmod(0o755)
        return self

    def run(self, text, cwd, **more):
        env = harness.environment(PATH=f"{self.path / 'bin'}{os.pathsep}{os.environ['PATH']}", HOME=str(self.path),
                                  XDG_STATE_HOME=str(self.path), SBATCH_WAIT="1", PARALLEL=PARALLEL, **more)
        return subprocess.run(["sh", "-e"], input=text, text=True, encoding="utf-8", capture_output=True, cwd=cwd, env=env,
                              timeout=PATIENCE, check=False)


class Walk:
    """Run the blocks of one way in sequence; their output, and the files they leave."""

    def __init__(self, way, may_say=lambda err: False, page=PAGE, **more):
        self.outputs, self.files = [], {}
        with Folder() as work, Machine() as machine:
            for number, block in enumerate(blocks(way, page), 1):
                done = machine.run(block, work.path, **more)
                expect(done.returncode == 0 and (done.stderr == "" or may_say(done.stderr)), f"block {number} of {way}:", block,
                       f"status {done.returncode}", done.stderr, done.stdout)
                self.outputs.append(done.stdout)
            for path in work.path.iterdir():
                if path.is_file():
                    self.files[path.name] = path.read_text(encoding="utf-8")

    def read(self, name):
        expect_in(name, self.files, "files left")
        return self.files[name]


@functools.cache
def walked(way):
    few = {"CEDUO_ROCKS": "1024"} if way == "four-systems" and not FULL else {}  # on its slow screens
    return Walk(way, understood if way == "survey" else names_columns, **few)


def understood(err):
    """Expect only the line of understanding on standard error."""
    return bool(re.fullmatch(r"six-plots.csv: 6 .*\n", err))


def names_columns(err):
    """Expect --each to report which columns it sets."""
    return all(re.match(r"[\w ./]+: columns that are set: (slope; copied: wkt, id|release; copied: id)$", line) for line in err.splitlines())


def option_shown(start, screen):
    """Return view 5's text for an option: in its own line, or in the next if its name fills that."""
    lines = [line.split("│")[0].rstrip() for line in screen.splitlines()]
    at = [i for i, line in enumerate(lines) if line.startswith(start) or re.match(r"\d+ " + re.escape(start), line)]
    expect(at, f"no line begins with {start!r} in:", screen)
    row = lines[at[0]]
    return row if re.search(r"\d/\d", row) else row + " " + lines[at[0] + 1].strip()


ROW = re.compile(r"\s(?P<share>\d+)±(?P<error>\d+) (?P<energy>[✔✘?]) +(?P<difference>-|[-+]\d+±\d+) +"
                 r"(?P<adc>[\d.]+|none) (?P<contact>[✔✘]) +(?P<run>[\d.]+) % (?P<free_run>[✔✘])$")
LIGHTS = {"✔": "pass", "✘": "FAIL"}


def side_by_side(page):
    """Return for each option its figures in the last table and the energy that stems could absorb, from its part of the page."""
    names = [name for name in re.findall(r"\n\n(\S.*)\n  stand ", page)]
    found = [m for m in map(ROW.search, page[page.index("Side by side"):].splitlines()) if m]
    taken = [float(kJ) for kJ in re.findall(r"stems\s+could\s+absorb ([\d.]+)\s+kJ", page)]
    rows = zip(names, found, taken, strict=True)
    return {name: {**{key: LIGHTS.get(value, value) for key, value in m.groupdict().items()}, "taken": kJ, "share": int(m["share"])} for name, m, kJ in rows}


def numbers_in_page(pattern):
    """Return the numbers of ceduo-workflows(7) in a sentence."""
    found = re.search(pattern, " ".join(PAGE.read_text(encoding="utf-8").split()))
    expect(found, "ceduo-workflows(7) does not say", pattern)
    return tuple(map(float, found.groups()))


def over_years(page):
    """Rows of the table of the years ahead at the end of a page: mean, worst year and years that fail, in the order of the options."""
    row = r"^  \S.*? +(\d+)±\d+ +(?:\d+±\d+ +)?\d+ \((\d+)\) +(\d+)/(\d+) "
    return [tuple(map(int, m.groups())) for m in re.finditer(row, page[page.index("    Over years"):], re.M)]


def keys_pressed(script):
    """Return the keys of a script; a typed character is one."""
    count = 0
    for line in script.splitlines():
        word, _, rest = line.strip().partition(" ")
        count += len(rest.split()) if word == "key" else len(rest) if word == "type" else 0
    return count


# ---- contents of README.md ----

def literals(text):
    """Yield each display's text, and its lines."""
    found, lines, first = [], text.splitlines() + ["end"], None
    for i, line in enumerate(lines):
        if line.startswith("    ") and first is None:
            first = i
        elif first is not None and line and not line.startswith("    "):
            last = max(k for k in range(first, i) if lines[k]) + 1
            found.append(("\n".join(x[4:] for x in lines[first:last]), (first, last)))
            first = None
    return found


def shown(text):
    """Return a display as the program prints it: a page."""
    return [(body, span) for body, span in literals(text) if body.startswith("$ ./ceduo --batch")]


def readme_script(text):
    return next(body for body, _ in literals(text) if "dump last.txt" in body) + "\n"


def printed():
    return ["$ ./ceduo --batch paper-site\n\n" + harness.good("--batch", "paper-site").out.rstrip("\n")]


def drawn():
    """Return the pages and screens written by the keys of man/pictures, in the language of their folder: path and content."""
    with Folder() as f:
        shutil.copytree(ROOT / "man" / "pictures", f.path / "pictures", ignore=lambda folder, names: {n for n in names if n.endswith("svg")})
        for keys in sorted(f.path.glob("pictures/**/*.keys")):
            language = "it" if keys.parent.name == "it" else "en"
            harness.good("--script", keys, "--language", language, "--charset", "braille", cwd=keys.parent,
                         env={"HOME": str(f.path), "XDG_STATE_HOME": str(f.path)})
        return [(ROOT / "man" / path.relative_to(f.path), path.read_text(encoding="utf-8"))
                for path in sorted([*f.path.glob("pictures/**/*.svg"), *f.path.glob("pictures/**/*.html")])]


def write_readme():
    text = README.read_text(encoding="utf-8")
    lines = text.splitlines()
    for (_, (first, last)), body in reversed(list(zip(shown(text), printed(), strict=True))):
        lines[first:last] = [("    " + line).rstrip() for line in body.splitlines()]
    README.write_text("\n".join(lines) + "\n", encoding="utf-8")
    for path, picture in drawn():
        if path.suffix == ".svg":
            path.write_text(picture, encoding="utf-8")


# ---- the page itself ----

def test_marks():
    """The page has marked blocks"""
    for way, least in (("four-systems", 4), ("survey", 6), ("two-cuts", 7), ("reserves", 3), ("groups", 2), ("uncertainty", 2), ("hazard", 2), ("fence", 2), ("fit", 2),
                       ("page", 3), ("sections", 2), ("scenes", 7), ("valley", 6)):
        expect(len(blocks(way)) >= least, f"{way}: {len(blocks(way))} blocks")
    marks = re.findall(r'^\.\\" run ', PAGE.read_text(), re.M)
    ways = ("four-systems", "survey", "two-cuts", "reserves", "groups", "uncertainty", "hazard", "fence", "fit", "page", "sections", "scenes", "valley")
    expect_equal(len(marks), sum(len(blocks(way)) for way in ways), "marks with a block")


def test_keys():
    """From the start to two cuts in at most 25 keys"""
    scripts = [b for b in blocks("two-cuts") if "--script" in b]
    expect(scripts, "no script")
    for block in scripts:
        script = block[block.index("KEYS'\n"):block.rindex("KEYS")]
        expect(keys_pressed(script) <= KEYS_MOST, f"{keys_pressed(script)} keys:", script)


def test_readme():
    """The script, the page and the pictures of README.md are the program's (test_workflows.py --readme)"""
    text = README.read_text(encoding="utf-8")
    script = readme_script(text)
    expect(keys_pressed(script) <= KEYS_MOST, f"{keys_pressed(script)} keys:", script)
    for (found, _), wanted in zip(shown(text), printed(), strict=True):
        expect(found == wanted, "README.md has", found, "the program has", wanted)
    keys = (ROOT / "man" / "pictures" / "cuts.keys").read_text()
    expect([x for x in keys.splitlines() if x.startswith("key")] == [x for x in script.splitlines() if x.startswith("key")], keys)
    found = drawn() if FULL else []  # screens with the default number of rocks
    page = next((page for path, page in found if path.suffix == ".html"), None)
    for words in () if page is None else ("Serra Sant&#39;Abbondio", "foglio 12, particella 34", "24/11/2026", "strada comunale", "Firma"):
        expect_in(words, page, "the report that the Italian keys write")
    for path, wanted in found:
        expect(path.suffix == ".html" or path.read_text(encoding="utf-8") == wanted, f"{path.name} is not what the program draws: make pictures")
    for name in re.findall(r"\]\(([^)]+\.svg)\)", text):
        picture = (ROOT / name).read_text(encoding="utf-8")
        expect(len(picture.encode()) < 100_000, f"{name}: {len(picture)} bytes")
        expect_equal(ElementTree.fromstring(picture)[0].tag, "{http://www.w3.org/2000/svg}title", name)


# ---- four systems ----

def test_four_systems():
    """Four systems: grown all pass by contact, just cut only the selection coppice does; arrivals separate them"""
    walk = walked("four-systems")
    page = walk.outputs[0]
    rows = side_by_side(page)
    expect_equal(len(rows), 8, "options side by side")
    for name, row in rows.items():
        wanted = "pass" if "cut" not in name or "selection" in name else "FAIL"
        expect_equal((row["contact"], row["free_run"]), (wanted, wanted), f"{name}: contact, free run")
        expect_equal(row["energy"], "FAIL" if row["share"] > 50 else "pass", f"{name}: energy")
    expect_in("limit 50 kJ*", page)
    cut = {name: row for name, row in rows.items() if "cut" in name}
    expect_equal(max(rows, key=lambda n: rows[n]["taken"]), "large reserves", "by the index most is taken by")
    expect_equal(max(cut, key=lambda n: cut[n]["taken"]), "large reserves, just cut", "just cut, most is taken by")
    grown = {name: row for name, row in rows.items() if name not in cut}
    expect_equal(min(rows, key=lambda n: rows[n]["share"]), "large reserves", "least comes through")
    expect_equal(max(grown, key=lambda n: grown[n]["share"]), "simple coppice, 25 years", "grown, most comes through")
    expect_equal(min(cut, key=lambda n: cut[n]["share"]), "large reserves, just cut", "just cut, least comes through")
    share = {name: row["share"] for name, row in rows.items()}
    bare, = re.findall(r"\n\nwithout forest\n.*?arrive with more than 50 kJ +(\d+) \(", page, re.S)
    expect_equal(numbers_in_page(r"large reserves let the fewest rocks through: (\d+), against (\d+) without forest\."), (share["large reserves"], int(bare)), "grown")
    expect_equal(numbers_in_page(r"The simple coppice lets the most through: (\d+) grown and (\d+) just cut\."),
                 (share["simple coppice, 25 years"], share["simple coppice, just cut"]), "simple coppice")
    expect_equal(numbers_in_page(r"Of the four systems just cut, large reserves are best, with (\d+)\."), (share["large reserves, just cut"],), "just cut")
    expect_equal(numbers_in_page(r"large reserves could absorb most: ([\d.]+) kJ per 100 m, and ([\d.]+) just cut") +
                 numbers_in_page(r"selection coppice could absorb ([\d.]+), less than the simple coppice with ([\d.]+)\."),
                 tuple(float(re.search(r"\(Eq. 4\), ([\d.]+)\s+kJ\s+per\s+100\s+m", page[page.index(f"\n\n{name}\n"):])[1])
                       for name in ("large reserves", "large reserves, just cut", "selection coppice", "simple coppice, 25 years")), "index")
    expect(share["selection coppice"] < share["simple coppice, 25 years"], "yet fewer rocks", share)
    means = [mean for mean, *_ in over_years(page)]
    expect_equal(numbers_in_page(r"large reserves, just cut, let the fewest rocks through: (\d+) in the mean"), (means[list(rows).index("large reserves, just cut")],))
    expect_equal(min(means), means[list(rows).index("large reserves, just cut")], "over the years the least")
    for name in rows:
        if name in cut:
            older = next(n for n in grown if name.startswith(n.split(",")[0]))
            expect(rows[older]["share"] < rows[name]["share"], f"{name}: a cut lets less through than the grown wood", rows)


def test_four_systems_picture():
    """Four systems: the picture has 24 lines and every option"""
    walk = walked("four-systems")
    picture = walk.outputs[1]
    expect(len(picture.splitlines()) <= 25, picture)
    for name in ("simple coppice", "coppice with standards", "selection coppice", "large reserves"):
        expect_in(name, picture)
        expect_in(name + ", just cut", picture)


def test_four_systems_csv():
    """Four systems: the spreadsheets have a row per option and the named columns"""
    walk = walked("four-systems")
    for name, columns in (("systems.csv", ("option", "index.residual_kJ", "wooded.exceed_probability", "lights.contact", "lights.energy")),
                          ("stands.csv", ("option", "stems_per_ha"))):
        lines = walk.read(name).splitlines()
        expect_equal(len(lines), 9, f"lines of {name}")
        for column in columns:
            expect_in(column, lines[0].split(","), name)


def test_four_systems_keys():
    """Four systems: 380 reserves change the contact light"""
    walk = walked("four-systems")
    before, after = walk.read("before.txt"), walk.read("after.txt")
    expect_in("44.4", before)
    expect(re.search(r"ADC m +44\.4 +< 30 ✘", before), before)
    expect(re.search(r"ADC m +29\.2 +< 30 ✔", after), after)
    expect(re.search(r"free run % +[\d.]+ +≤ 10 ✘", after), after)
    expect_in("380", after)
    if FULL:
        found = tuple(int(re.search(r"above 50 kJ +(\d+)±", screen)[1]) for screen in (after, before))
        expect_equal(numbers_in_page(r"(\d+) of 1000 rocks arrive with too much energy instead of (\d+)\."), found, "of 1000")


def test_four_systems_in_italian():
    """Four systems: the same keys on the Italian screens, with the figures of the Italian page"""
    if not FULL:
        raise harness.Skip("in check-all; test_survey_in_italian() walks an Italian way, too")
    page = " ".join(PAGINA.read_text(encoding="utf-8").split())
    with Folder() as work, Machine() as machine:
        done = machine.run(blocks("four-systems", PAGINA)[-1], work.path, LANGUAGE="it", CEDUO_ROCKS="1024")
        expect(done.returncode == 0 and done.stderr == "", done.stdout, done.stderr)
        for name, figure, light in (("before.txt", "44,4", "\u2718"), ("after.txt", "29,2", "\u2714")):
            screen = (work.path / name).read_text(encoding="utf-8")
            expect_in(f"{figure} m", page)
            expect(re.search(rf"ADC m +{figure} +< 30 {light}", screen), screen)
        expect_in("380 fusti/ha", screen)


# ---- two cuts ----

def test_two_cuts():
    """Two cuts: the page names the one that passes"""
    walk = walked("two-cuts")
    expect_equal(walk.outputs[2], "profile.csv: 9 points, 110 m long, falls 98 m; columns distance, elevation\n", "--check")
    page = walk.outputs[3]
    rows = side_by_side(page)
    expect_equal(sorted(rows), ["selection", "simple"])
    for light in ("contact", "free_run"):
        expect_equal((rows["simple"][light], rows["selection"][light]), ("FAIL", "pass"), light)
    expect(rows["selection"]["share"] < rows["simple"]["share"], "too much energy", rows)
    expect(1.6 < rows["selection"]["taken"] / rows["simple"]["taken"] < 2, rows)
    expect_equal(rows["simple"]["adc"], "219", "60 reserves of 20 cm, a block of 56 cm: 10^4/(60 (.2 + .56))")
    bare = re.findall(r"\n\nwithout forest\n.*?arrive with more than 50 kJ +(\d+) \(", page, re.S)
    expect_equal(len(bare), 1, "the slope without forest, which the options share")
    expect(200 < int(bare[0]) < 300, page)
    few, many = (rows[name]["share"] for name in ("selection", "simple"))
    expect_equal(numbers_in_page(r"and (\d+) of 1000 rocks still arrive") + numbers_in_page(r"Through the selection coppice (\d+) arrive with too much"), (many, few))
    expect_equal(numbers_in_page(r"The difference of (\d+) is four times its error"), (many - few,))
    difference, error = map(int, re.match(r"-(\d+)±(\d+)", rows["selection"]["difference"]).groups())
    expect(3.5 < difference / error < 4.5, "four times", rows)
    expect(few > 1.5 * 50, "not good enough", rows)
    (many, _, many_fail, years), (few, _, few_fail, _) = over_years(page)
    expect_equal(numbers_in_page(r"In the mean of (\d+) years (\d+) of 1000 arrive .*?, and more than 50 in (\d+) of these years\. "
                                 r"Through the simple coppice (\d+) arrive, and more than 50 in (\d+) years\."),
                 (years, few, few_fail, many, many_fail), "over the years")
    expect(re.search(r"For 'simple', 'selection' it depends on uncertain inputs\.", " ".join(page.split())), page)
    expect(re.search(r"'selection' beats 'simple' in \d+ % of plausible cases.*?: clear\. Measure first: roughness", " ".join(page.split())), page)
    assumed = page[page.index("Assumed, not measured"):]
    expect_in("density", assumed)
    expect_in("library's grounds", assumed)


def test_two_cuts_pictures():
    """Two cuts: both pictures are written"""
    walk = walked("two-cuts")
    pictures = walk.outputs[4]
    for words in ("side by side", "simple", "selection", "release", "mill"):
        expect_in(words, pictures)


def test_two_cuts_keys():
    """Two cuts: the terminal program agrees with the page"""
    walk = walked("two-cuts")
    rows = side_by_side(walk.outputs[3])
    slope, compare = walk.read("slope.txt"), walk.read("compare.txt")
    expect_in("release", slope)
    for name, figures in rows.items():
        row = option_shown(name, compare)
        found = [float(x) for x in re.findall(r"\d+\.\d+|\d+", row)]
        error = 2 * int(figures["error"]) + 1
        expect(any(abs(x - figures["share"]) <= error for x in found), f"{figures['share']} of 1000:", row)
    expect(re.search(r"ADC m +[\d.]+ +< 30 ✔", compare) and re.search(r"free run % +[\d.]+ +≤ 10 ✔", compare), compare)


def test_two_cuts_new():
    """Two cuts: from the profile alone, in 25 keys"""
    walk = walked("two-cuts")
    screen = walk.read("new.txt")
    expect_in("Rock 0.6 m", screen)
    option_shown("simple-c", screen)
    option_shown("selectio", screen)
    expect(re.search(r"│ ADC m +[\d.]+ +< 30 ✘✘\n.*│ free run % +[\d.]+ +≤ 10 ✘✘\n", screen), "the tests of the simple coppice, today and just after a cut", screen)
    expect(not re.search(r"^current", screen, re.M), screen)


def test_survey():
    """From a survey to a page: the stand, the comparison, the uncertainty, and the page in two languages"""
    walk = walked("survey")
    head = walk.read("stand.yaml")
    stools, shoots, standards = (float(re.search(rf"^# {name} +(\d+)", head, re.M)[1]) for name in ("stools", "shoots", "standards"))
    expect(590 < stools < 610 and 1430 < shoots < 1445 and 105 < standards < 115, head)
    expect(re.search(r"^# standards .* 63 to 159$", head, re.M), head)
    expect_in("36 measured; 106 by N\u00e4slund", head)
    rows = side_by_side(walk.outputs[3])
    now, alone, selection = (rows[name]["share"] for name in ("as it is", "standards alone", "selection"))
    expect(abs(selection / now - 0.9) < 0.05 and abs(alone / now - 1.2) < 0.05, rows)
    expect_equal([rows["standards alone"][light] for light in ("contact", "free_run", "energy")], ["FAIL"] * 3)
    page = " ".join(walk.outputs[3].split())
    expect(re.search(r"standards: Toscana asks for ≥ 60 standards a hectare \(art. 22, D.P.G.R. 48/R, 2003\); 11\d[.\d]* are kept: met",
                     page), page)
    expect(re.search(r" beats .*: (clear|likely|hardly ever worse|undecided)\.", " ".join(walk.outputs[4].split())), walk.outputs[4])
    expect(re.search(r"'as it is'.*: The test of energy depends on .*roughness", " ".join(walk.outputs[4].split())),
           walk.outputs[4])
    for name, language in (("page.html", "en"), ("pagina.html", "it")):
        html = walk.read(name)
        expect_in(f'lang="{language}"', html[:200])
        expect_in("Coppice above the road", html)
        expect_in("six-plots", html)


def test_survey_in_italian():
    """The whole way in Italian, from two CSV files to the page: no English sentence remains, and the figures are equal"""
    walk = Walk("survey", understood, page=PAGINA, LANGUAGE="it")
    english = walked("survey")
    expect_equal(len(walk.outputs), len(english.outputs), "steps")
    stands = [re.sub(r'(?m)text: "[^"]*"|^#.*$', "text", text[text.index("ceduo: stand/1"):])
              for text in (walk.read("popolamento.yaml"), english.read("stand.yaml"))]
    expect_equal(stands[0].split(), stands[1].split())
    told = re.sub(r"plausibili\s+su\s+100", "", walk.outputs[3])  # the Italian of %
    numbers = [re.findall(r"\d+(?:[.,]\d+)?", text) for text in (told, english.outputs[3])]
    expect_equal([number.replace(",", ".") for number in numbers[0]], numbers[1])
    page = " ".join(walk.outputs[3].split())
    for words in ("A confronto, fino a 120 m", "con bosco", "Toscana chiede ≥ 60 matricine per ettaro", "rispettato"):
        expect_in(words, page)
    expect(re.search(r"com'\u00e8 ora'.*: La verifica di \W?energia\W? dipende da .*rugosit\u00e0", " ".join(walk.outputs[4].split())),
           walk.outputs[4])
    html = walk.read("pagina.html")
    expect_in('lang="it"', html[:200])
    for english_word in (" the ", " of ", "without", "rocks", "forest "):
        expect(english_word not in re.sub(r"<style>.*?</style>|<pre.*?</pre>", "", html.split("Ipotizzato, non misurato")[0], flags=re.S),
               english_word)


KEYS = """resize 110 60
key 2
key p
type da un rilievo
key Enter
type six-plots.csv
key Enter
wait idle
dump -
key s
wait idle
"""


def test_survey_on_the_italian_screen():
    """The end of the page: 2, p and 'da un rilievo' use the survey for the shown belt"""
    texts = blocks("survey", PAGINA)[:3]
    with Folder() as work, Machine() as machine:
        work.write("keys", KEYS)
        edit = "sed -i '/^options:/,/^rules:/d' strada.yaml\necho 'forest: [{from_m: 15, to_m: 115, stand: simple-coppice}]' >> strada.yaml"
        done = machine.run("\n".join([*texts, edit, "ceduo --script keys strada.yaml", "ceduo --batch --details -n 100 strada.yaml"]),
                           work.path, LANGUAGE="it", CEDUO_ROCKS="1024")
        expect(done.returncode == 0 and understood(done.stderr), done.stderr, done.returncode)
        expect_in("popolamento preso dal rilievo", done.stdout)
        expect(re.search(r"ceppaie per ha +597", done.stdout), done.stdout)
        expect(re.search(r"six-plots\S* +15\u2013115 +13,9 +\u2714", done.stdout), "saved", done.stdout)


def test_reserves():
    """Reserves needed: 379 for 30 m, no diameter does, and a quarter of the rocks needs more"""
    walk = walked("reserves")
    expect_equal(len(walk.outputs), 4, "blocks")
    expect_in("per_ha = 379", walk.outputs[0])
    expect_in("forest[0].stand.trees[0].dbh_m: no value from 0.1 to 1 reaches the goal", walk.outputs[1])
    expect_in("nearest: 1, ADC 99.2", walk.outputs[1])
    many = int(re.search(r"per_ha = (\d+)", walk.outputs[2])[1])
    expect_in(f"The answer is {many}.", PAGE.read_text(encoding="utf-8"))
    told = int(re.search(r"Hardly more: some (\d+)", PAGE.read_text(encoding="utf-8"))[1])
    sure = int(re.search(r"plausible cases: (\d+)", walk.outputs[3])[1])
    expect(abs(sure - told) <= 60 and many < sure < 1.1 * many, walk.outputs[3])


def test_groups():
    """Standards in groups: equal density, more free runs, more rocks with too much energy; the figures of the page"""
    walk = walked("groups")
    runs, stands = ({row["option"]: row for row in csv.DictReader(walk.read(name).splitlines())} for name in ("groups.csv", "stands.csv"))
    rows = {name: (float(stands[name]["free_run_probability"]),
                   *(float(run[f"wooded.exceed_{key}"]) for key in ("probability", "lo", "hi"))) for name, run in runs.items()}
    shown = {m[1]: tuple(map(float, m.groups()[1:])) for m in
             re.finditer(r"^\.It (s\S+ .*) Ta ([\d.]+) Ta (\d+) \((\d+) to (\d+)\)$", PAGE.read_text(), re.M)}
    expect_equal(sorted(shown), sorted(rows), "options")
    for name, (free, *share) in rows.items():
        expect_near(100 * free, shown[name][0], 0.05001, f"{name}: free run")
        for found, wanted in zip(share, shown[name][1:], strict=True):
            expect_near(1000 * found, wanted, 0.50001, f"{name}: of 1000")
    for name, nothing in (("standards in groups, just cut", 24), ("single standards, just cut", 13)):
        expect_near(100 * float(runs[name]["summary.meet_nothing_probability"]), nothing, 0.5, f"{name}: nothing met")
    mean, se = (float(runs["standards in groups, just cut"][f"difference.exceed_probability.{key}"]) for key in ("mean", "se"))
    more = re.search(r"Just cut, groups let (\d+) rocks of 1000 more through", PAGE.read_text(encoding="utf-8"))
    expect_near(1000 * mean, float(more[1]), 0.50001, "more of 1000")
    expect_near(1000 * se, 1.5, 0.05, "standard error")
    expect(mean > 3 * se, "clearly more", mean, se)
    expect_in("standards in groups", walk.outputs[1])


def test_uncertainty():
    """Uncertainty: many times the sampling error, mainly from the energy law"""
    walk = walked("uncertainty")
    now, lo, hi, low, high = map(int, re.search(r"current +(\d+) +(\d+)–(\d+) +(\d+)–(\d+)", walk.outputs[0]).groups())
    expect(450 < now < 510 and 440 < lo < hi < 520, "480, 30 more or less", now, lo, hi)
    ends = numbers_in_page(r"90\\ % range by uncertain inputs is (\d+) to (\d+)\.")
    expect(abs(low - ends[0]) <= 15 and abs(high - ends[1]) <= 15, ends, low, high)
    expect(high - low > 6 * (hi - lo), "the uncertainty is mostly far more")
    shares = [(m[1].strip(), int(m[2])) for m in re.finditer(r"^  (\S.{33}).* (\d+) % +\d+$", walk.outputs[0], re.M)]
    expect_equal([name for name, _ in shares[:2]], ["energy law", "hit off centre"])
    expect(shares[0][1] > 50, shares)
    expect(sum(share for _, share in shares) > 105, "more than 100 %", shares)  # 113 % of these two alone, from four runs
    expect_in("Scenes computed: 280.", walk.outputs[0])
    order = re.search(r"'large reserves, just cut' beats .* in (\d+) % .*, worse in (\d+) %: likely\.", re.sub(r"\s+", " ", walk.outputs[1]))
    better, worse = numbers_in_page(r"in some (\d+)\\ % of the plausible cases, and more in (\d+)\\ %\. The page calls that likely")
    expect(order and abs(int(order[1]) - better) <= 5 and abs(int(order[2]) - worse) <= 5, better, worse, walk.outputs[1])


def test_hazard():
    """Frequency: years without and with the old coppice, just cut, the energy of 300 years, the picture"""
    walk = walked("hazard")
    page = " ".join(walk.outputs[0].split())
    expect_in("Within the limit over these years: none.", page)
    for row in ("without forest 22 (21–24) ", "simple coppice 55 (51–60) ", "simple coppice, just cut 25 (23–27) "):
        expect_in(row, page)
    bare, coppice = (re.search(rf"{name} .*?(\d+) \(\d+–\d+\)$", walk.outputs[0], re.M)[1]
                     for name in ("  without forest", "  simple coppice"))
    expect(385 < int(bare) < 400 and 290 < int(coppice) < 300, "390 to some 300 kJ", bare, coppice)
    expect_in("How often, at 135 m, road", walk.outputs[0])
    expect_in('"rate_left"', walk.read("hazard.json"))


def test_fence():
    """Fence: the smallest fences without forest, today and over the years, the design values of both kinds, the chance"""
    walk = walked("fence")
    page = " ".join(walk.outputs[0].split())
    for text in ("Enough without forest: 3 m of class 2 (500 kJ); with 'coppice with standards': today 3 m of class 1 (250 kJ); over the "
                 "years 4 m of class 1 (250 kJ), because of years 1–5.", "in 50 years it happens with a chance of 4.1 %"):
        expect_in(text, page)
    for row in ("without forest 23.5 388 ", "with forest: arrivals 22.2 421 ", "with forest: one system 21.4 311 "):
        expect_in(row, page)
    expect(re.search(r"stopped by stems[^0-9]* 425 ", page), page)
    selection = page[page.index("selection coppice of beech*"):]
    expect(re.search(r" 2 m none 1\? \(250 kJ\) 47 2 \(500 kJ\) 30 ", selection), "2 m of class 2 in all years", selection)
    expect_in("2 selection coppice", walk.outputs[0])
    rows = list(csv.DictReader(io.StringIO(walk.read("fence.csv"))))
    expect_equal([(r["bare.fence.smallest.class"], r["fence.window.smallest.class"]) for r in rows], [("2", "1"), ("2", "2")])


def test_fit():
    """Fit: the ranges contain the values that made the stops, and the written scene has them"""
    walk = walked("fit")
    for name, truth in (("roughness, m", 0.12), ("friction", 0.35)):
        low, high = map(float, re.search("^  " + name + r" .* (0\.\d+)–(0\.\d+)$", walk.outputs[0], re.M).groups())
        expect(low < truth < high, name, low, high)
    expect_in("the observations do not tell them apart", " ".join(walk.outputs[0].split()))
    expect_in("The model reproduces all fitted observations", walk.outputs[0])
    expect_in("kind: calibrated", walk.read("fitted.yaml"))
    expect_in("How sure is it?", walk.outputs[1])


def test_page():
    """A page to hand in: question and answer with both kinds of error, chapters, the user's names"""
    walk = walked("page")
    pages = {name: walk.read(f"{name}.html") for name in ("page", "draft", "mill")}
    answer = re.search(r'<div class="answer no">(.*?)</div>', pages["page"], re.S).group(1)
    years = r"✘ NO: in (\d+) of (\d+) years more than 50 of 1000 rocks exceed 50 kJ.*mean \d+ .*, worst \d+ in year \d+; today \d+ \(NO\)"
    expect(re.search(years, answer, re.S), answer)
    for words in ("In nine of ten plausible cases", "Sampling error (", "Uncertain inputs: "):
        expect_in(words, pages["page"])
    expect_equal([page.count("<h1>") for page in pages.values()], [1, 3, 1], "chapters, and before those of several the table of their verdicts")
    expect_in("<h1>Coppice above the mill, parcel 14</h1>", pages["mill"])
    expect_in("road to the mill (135 m)", pages["mill"])
    expect_in("ceduo --report report.html paper-site", pages["page"])


def test_sections():
    """A felling plan: equal metres felled, a better worst year, the same mean, more years without contact"""
    walk = walked("sections")
    page = " ".join(walk.outputs[0].split())
    ends = re.findall(r"mean (\d+) ±(\d+) of 1000, worst (\d+).*?contact (\d+), free run \d+ of 25\..*?Felled: (\d+) m", page)
    expect_equal(len(ends), 3, "options")
    once, top, bottom = ([int(x) for x in end] for end in ends)
    expect_equal([once[4], top[4], bottom[4]], [135] * 3, "metres felled")
    expect_equal([once[3], top[3], bottom[3]], [10, 25, 25], "years without contact: ten after each cut")
    for plan in (top, bottom):
        expect(plan[2] < once[2] - 40, "the worst year", ends)
        expect(abs(plan[0] - once[0]) < 27, "the mean, within its error", ends)
    expect_in("cut", walk.outputs[1])
    expect_in("of 1000 released with > 50 kJ", walk.outputs[1])


# ---- many machines ----

def needs_parallel():
    if not shutil.which("parallel"):
        raise harness.Skip("no GNU parallel here")


def test_scenes():
    """Many scenes: a pipe, files and a job array give the rows of one call; failed ones are repeated alone"""
    needs_parallel()
    walk = walked("scenes")
    wanted = walk.read("one-call.csv")
    expect_equal(len(wanted.splitlines()), 13, "rows")
    for name in ("piped.csv", "files.csv", "slurm.csv"):
        expect_equal(walk.read(name), wanted, name)
    expect_equal(walk.read("missing.txt"), "scenes/s03.yaml\nscenes/s07.yaml\n", "missing")


def test_two_hundred_scenes():
    """For 200 scenes a pipe through GNU parallel, and a job array, give the bytes of one call"""
    needs_parallel()
    with Folder() as work, Machine() as machine:
        names = [work.write(f"s{i:03}.yaml", harness.scene(simulation={"rocks": 200, "seed": i})).name for i in range(200)]
        work.write("list.txt", "".join(f"{name}\n" for name in names))
        one = harness.good("--batch", "-f", "csv", "-n", 30, *names, cwd=work.path).out
        expect_equal(len(one.splitlines()), 201, "rows")
        many = machine.run("parallel -k -j 3 -a list.txt ceduo --batch -j 1 -f csv -n 30 | "
                           "awk 'NR == 1 { head = $0; print } $0 != head'", work.path)
        expect_equal((many.returncode, many.stderr), (0, ""), "parallel")
        expect_equal(many.stdout, one, "by a pipe")
        done = machine.run(f"sbatch --array=1-200 {ROOT}/profiles/jobs/ceduo-array.sbatch scene list.txt rows -n 30", work.path)
        expect_equal(done.returncode, 0, done)
        rows = [(work.path / "rows" / f"{name[:-5]}.csv").read_text().splitlines(keepends=True) for name in names]
        expect_equal("".join([rows[0][0], *(row for _, row in rows)]), one, "by Slurm")


def test_valley():
    """A valley: a row per profile, worse if it is higher, equal by all ways"""
    needs_parallel()
    walk = walked("valley")
    rows = list(csv.DictReader(io.StringIO(walk.read("map.csv"))))
    expect_equal([(row["id"], row["wkt"]) for row in rows], [(f"p{i:02}", f"LINESTRING ({i:02} 0, {i:02} 90)") for i in range(1, 21)],
                 "profiles")
    shares = [float(row["wooded.exceed_probability"]) for row in rows]
    expect(shares[-1] > shares[0] + 0.05, "share of the highest and the lowest", shares)
    for name in ("long.csv", "piped.csv", "slurm.csv"):
        expect_equal(walk.read(name), walk.read("map.csv"), name)


def test_job_array():
    """The job array is valid for sh, and reports errors"""
    script = ROOT / "profiles/jobs/ceduo-array.sbatch"
    done = subprocess.run(["sh", "-n", script], capture_output=True, text=True, check=False)
    expect_equal((done.returncode, done.stderr), (0, ""), "sh -n")
    expect(script.read_text().count("#SBATCH") >= 4, "directives")
    with Folder() as f:
        profiles = f.write("list.txt", "a.csv\n")
        for words, task, say in ((("scene", "list"), "1", "usage"), (("what", profiles, "out", "x"), "1", "usage"),
                                 (("rows", profiles, "out", "x"), "2", "has no line 2"),
                                 (("scene", profiles, "out"), None, "SLURM_ARRAY_TASK_ID")):
            done = subprocess.run(["sh", script, *map(str, words)], capture_output=True, text=True, check=False, cwd=f.path,
                                  env=harness.environment(SLURM_ARRAY_TASK_ID=task))
            expect(done.returncode != 0 and say in done.stderr, words, done)


def test_job_array_again():
    """Some tasks of a job array die: no half file remains, and only they are repeated"""
    with Folder() as work, Machine() as machine:
        machine.write("share/array", (ROOT / "profiles/jobs/ceduo-array.sbatch").read_text())
        (machine.path / "bin/ceduo").unlink()
        machine.write("bin/ceduo", f"""#!/bin/sh
case $*:$(cat {work.path}/well) in
*s2.yaml: | *s4.yaml:)
    {CEDUO} "$@" -n 100000000 & # hours
    sleep 0.5
    kill -9 $!
    wait $!
    ;;
*) exec {CEDUO} "$@" ;;
esac
""").chmod(0o755)
        work.write("well", "")
        names = [work.write(f"s{i}.yaml", harness.scene(simulation={"rocks": 200, "seed": i})).name for i in range(1, 6)]
        work.write("list.txt", "".join(f"{name}\n" for name in names))
        script = f"{machine.path}/share/array scene list.txt rows -n 5000"
        done = machine.run(f"sbatch --array=1-5 {script} || echo some failed", work.path)
        expect_in("some failed", done.stdout, done)
        expect_equal(sorted(os.listdir(work.path / "rows")), ["s1.csv", "s3.csv", "s5.csv"], "files")
        work.write("well", "yes")
        done = machine.run(f"sbatch --array=2,4 {script}\nawk 'NR == 1 || FNR > 1' rows/*.csv >all.csv", work.path)
        expect_equal(done.returncode, 0, done)
        expect_equal((work.path / "all.csv").read_text(), harness.good("--batch", "-f", "csv", "-n", 5000, *names, cwd=work.path).out, "rows")


if __name__ == "__main__":
    if sys.argv[1:] == ["--readme"]:
        write_readme()
        sys.exit()
    suite = harness.Suite()
    suite.run(harness.list_tests(sys.modules[__name__]))
    suite.end()
