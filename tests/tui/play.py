# SPDX-License-Identifier: GPL-3.0-or-later
"""Helpers of the tests of the terminal program: scripts without a terminal, and the screens that they dump."""
import os
import re
import subprocess
import sys
import time
import unicodedata
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
from harness import CEDUO, DONE, PATIENCE, ROOT, Failure, Folder, Result, environment, expect, only_text, without_unusual  # noqa: E402

VIEWS = ["slope", "stand", "rock", "results", "compare", "rotation"]

# All rocks move equally and meet no stem: the first figures are final. They roll: at 80 m they have
# m g (80 - 15 - 0.65 * 60 - 0.7 * 20 m) = 20 kJ of the accepted 50, at the track m g (80 - 30 - 0.65 * 60 m) = 18 kJ of 20.
FAST = """\
# kept: the first line
ceduo: scene/1
title: fast
rock: {shape: sphere, diameter_m: 0.5}   # kept: found on the road
release: {vx_m_s: 1}
slope:
  vertices_m: [[0, 80], [60, 30], [100, 0]]
  segments:
    - {rn: 0.3, rt: 0.98, roughness_rad: 0, friction: 0.65}
    # kept: below the path
    - {rn: 0.25, rt: 0.97, roughness_rad: 0, friction: 0.7}
controls:
  - {x_m: 60, name: track, accepted_kJ: 20}
  - {x_m: 80, name: road, accepted_kJ: 50}
forest:
  - from_m: 5
    to_m: 45
    stand:
      name: upper
      species: ostrya-carpinifolia
      stools: {per_ha: 3000, spacing_m: 0.4}   # kept: counted in May
      shoots:
        - {per_ha: 9000, dbh_m: 0.06, height_m: 7, volume_m3: 0.01}
        - {per_ha: 500, dbh_m: 0.12, height_m: 10, volume_m3: 0.05}
      trees:
        - {per_ha: 80, dbh_m: 0.2, height_m: 12, volume_m3: 0.2}
        - {per_ha: 20, dbh_m: 0.35, height_m: 16, volume_m3: 0.7}
      energy: {model: brauner, u_J_m3: 100000, offset: whole}
  - from_m: 50
    to_m: 80
    stand:
      name: lower
      species: ostrya-carpinifolia
      stools: {per_ha: 1000, spacing_m: 0.3}
      shoots: [{per_ha: 2500, dbh_m: 0.05, height_m: 5, volume_m3: 0.005}]
      trees: [{per_ha: 60, dbh_m: 0.2, height_m: 12, volume_m3: 0.2}]
      energy: {model: brauner, u_J_m3: 100000, offset: whole}
simulation: {rocks: 1000, contact_model: index}
"""
# the same with three treatments
OPTIONS = FAST[:FAST.index("forest:")] + """\
options:
  - name: thick
    forest:
      - from_m: 5
        to_m: 80
        stand: {name: many, species: ostrya-carpinifolia, stools: {per_ha: 3000, spacing_m: 0.4},
                shoots: [{per_ha: 9000, dbh_m: 0.06, height_m: 7, volume_m3: 0.01}],
                energy: {model: brauner, u_J_m3: 100000, offset: whole}}
  - name: thin
    forest:
      - from_m: 5
        to_m: 80
        stand: {name: few, species: ostrya-carpinifolia, trees: [{per_ha: 100, dbh_m: 0.2, height_m: 12, volume_m3: 0.2}],
                energy: {model: brauner, u_J_m3: 100000, offset: whole}}
  - name: none left
    forest: []
simulation: {rocks: 1000, contact_model: index}
"""


# With this friction about half of the rocks of 1 m exceed 250 kJ at 80 m, and about 130 in 1000 with forest.
ROUGH = "roughness_rad: 0.3, friction: 0.47"


def in_the_wood(text):
    """Return the scene with varying rocks that meet the stems of the forest; some stop."""
    for old, new in (("title: fast", "title: wood"), ("diameter_m: 0.5}", "diameter_m: 1}"), ("vx_m_s: 1", "vx_m_s: 3"),
                     ("rn: 0.3, rt: 0.98, roughness_rad: 0, friction: 0.65", f"rn: 0.35, rt: 0.8, {ROUGH}"),
                     ("rn: 0.25, rt: 0.97, roughness_rad: 0, friction: 0.7", f"rn: 0.35, rt: 0.8, {ROUGH}"),
                     ("accepted_kJ: 50", "accepted_kJ: 250"), (", contact_model: index", "")):
        if old not in text:
            raise ValueError(old)
        text = text.replace(old, new)
    return text


def in_the_index(text):
    """Return the scene by the index alone."""
    return text.replace("simulation: {", "simulation: {contact_model: index, ")


WOOD = in_the_wood(FAST)
CUTS = in_the_wood(OPTIONS)


class Screen:
    def __init__(self, text, width, height):
        self.text, self.width, self.height = text, width, height
        self.lines = text.split("\n")[:-1] if text.endswith("\n") else text.split("\n")
        self.side = 44 if width >= 140 else 36 if width >= 100 else 28

    def __str__(self):
        return f"screen of {self.width} x {self.height}:\n{self.text}"

    @property
    def title(self):
        """Return the names of the views, and the scene's title next to them or above the figures."""
        beside = re.search(r" 8 \S+ +\S", self.lines[0])
        return self.lines[0] if beside else f"{self.lines[0]}\n{self.cut(self.width - self.side + 1, self.width)[0]}"

    @property
    def verdict(self):
        return self.lines[1]

    @property
    def note(self):
        """Return the explanation of the field, or the answer to the last key."""
        return " ".join(f"{self.lines[-3]} {self.lines[-2]}".split(" ")).strip()

    @property
    def popup(self):
        """Return the text of the popup, its lines joined."""
        inside = [m.group(1).strip() for m in (re.search(r"[│|] (.*) [│|]", line) for line in self.lines[1:-1]) if m]
        return re.sub(r" +", " ", " ".join(inside))

    @property
    def bar(self):
        return self.lines[-1]

    def cut(self, left, right):
        return [line[left:right].rstrip() for line in self.lines[2:self.height - 3]]

    @property
    def body(self):
        """Return the view's own part."""
        return "\n".join(self.cut(0, self.width - self.side - 2))

    @property
    def now(self):
        """Return the column on the right, without the mark of unsaved work before the title."""
        return "\n".join(self.cut(self.width - self.side + 1, self.width)).removeprefix("* ")

    def figure(self, pattern):
        """Return the next number in the column on the right."""
        found = re.search(pattern + r"\s*([-\d.]+)", self.now)
        expect(found, f"no '{pattern}' with a number in the column on the right:", self.now)
        return float(found.group(1).rstrip("."))

    def pair(self, name):
        """Return the column's numbers with and without forest, None for a dash."""
        found = re.search(rf"^ *{re.escape(name)} +(\S+|\d+ \(\d+[–-]\d+\)) +(\S+)$", self.now, re.M)
        expect(found, f"no '{name}' with two figures in the column on the right:", self.now)
        numbers = [re.match(r"[\d.]+", word) for word in found.groups()]
        return tuple(float(n.group()) if n else None for n in numbers)

    def lights(self):
        """Return the tests in the column on the right, {'Contact': 'passes', …}; sign and comparison must agree."""
        return {name: today for name, (today, _) in self.lights_ahead().items()}

    def lights_ahead(self):
        """Return the same with the second sign, of the worst coming year; None if missing."""
        found, words_of = {}, {"✔": "passes", "+": "passes", "✘": "FAILS", "x": "FAILS", "?": "unknown", "": None}
        for name, pattern in (("Contact", r"^(?:ADC|gap) m"), ("Free run", r"^free run %"), ("Energy", r"^energy %")):
            match = re.search(pattern + r" +(\S+) +(?:(<|≤|<=) ([\d.]+) )?([✔✘+x?])([✔✘+x?]?)$", self.now, re.M)
            expect(match, f"no test '{name}' in the column on the right:", self)
            value, below, limit, sign, ahead = match.groups()
            if sign != "?":
                value, limit = float("inf" if value == "none" else value), float(limit)
                kept = value < limit if below == "<" else value <= limit
                expect(kept == (sign in "✔+"), f"the sign {sign!r} does not go with {name} {value} {limit}", self)
            found[name] = (words_of[sign], words_of[ahead])
        return found

    def has(self, *parts):
        """Expect each part, in any layout: runs of blanks count as one."""
        flat = re.sub(r"[ \n]+", " ", self.text)
        for part in parts:
            expect(part in flat or part in self.text, f"{part!r} is missing in the", self)
        return self

    def lacks(self, *parts):
        for part in parts:
            expect(part not in self.text, f"{part!r} should not be in the", self)
        return self

    def row(self, pattern):
        """Return the body's first matching line, as words."""
        for line in self.body.split("\n"):
            if re.search(pattern, line):
                return line.split()
        raise Failure(f"no line like {pattern!r} in the", self)

    def whole(self):
        """Expect the screen's number of lines, none too wide."""
        expect(len(self.lines) == self.height and self.text.endswith("\n"),
               f"{len(self.lines)} lines, {self.height} wanted", self)
        for line in self.lines:
            wide = sum(2 if unicodedata.east_asian_width(c) in "WF" else not unicodedata.combining(c) for c in line)
            expect(wide <= self.width, f"{wide} columns, {self.width} wanted: {line}")
        return self


ROCKS = 1024  # per forest and year, ten times fewer than the program's minimum: most tests read no figure


def home(folder, rocks=ROCKS):
    """Return an environment that keeps the program's files in a folder; without a terminal's name. rocks=None: the default
    number."""
    at = str(folder)
    return environment(CEDUO_ROCKS=rocks and str(rocks), HOME=at,
                       XDG_STATE_HOME=at + "/state", XDG_DATA_HOME=at + "/data", XDG_CONFIG_HOME=at + "/config",
                       XDG_CACHE_HOME=at + "/cache", TERM=None, COLUMNS=None, LINES=None)


def run_script(folder, script, *arguments, name="play.txt", rocks=ROCKS):
    """Play a script without a terminal; the program ends, with any status."""
    (folder / name).write_text(script)
    command = [CEDUO, "--script", name, *map(str, arguments)]
    start = time.monotonic()
    try:
        done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              cwd=folder, env=home(folder, rocks), timeout=PATIENCE, check=False, start_new_session=True)
    except subprocess.TimeoutExpired as late:
        raise Failure(f"not ended after {PATIENCE} s", script) from late
    result = Result(command[1:], done.returncode, done.stdout, done.stderr, time.monotonic() - start)
    expect(0 <= result.status <= 4, "the program crashed on", script, result)
    only_text(result.out_bytes, "stdout")
    only_text(result.err_bytes, "stderr")
    return result


def play(folder, script, *arguments, charset="braille", rocks=ROCKS):
    """Return the screens that a script dumps: a line 'dump' saves one. Also: 'find WORD' searches, 'set VALUE' types into the
    field, 'clear' dismisses the message."""
    width, height, sizes, lines = 80, 24, [], []
    for line in script.strip().split("\n"):
        line = line.strip()
        word, _, rest = line.partition(" ")
        if line == "dump":
            lines.append(f"dump screen-{len(sizes)}.txt")
            sizes.append((width, height))
        elif word == "find":
            lines += ["key /", "key Ctrl-U", f"type {rest}", "key Enter"]
        elif word == "set":
            lines += ["key Enter", "key Ctrl-U", f"type {rest}", "key Enter"]
        elif line == "clear":
            lines.append("key Ctrl-L")
        else:
            if word == "resize":
                width, height = map(int, rest.split())
            lines.append(line)
    done = run_script(folder, "\n".join(lines) + "\n", "--charset", charset, *arguments, rocks=rocks)
    expect(done.status == DONE and without_unusual(done.err) == "", done, "the script", "\n".join(lines))
    screens = []
    for i, (width, height) in enumerate(sizes):
        path = folder / f"screen-{i}.txt"
        expect(path.exists(), f"dump {i} was not written: the program ended before", "\n".join(lines))
        screens.append(Screen(path.read_text(), width, height))
        path.unlink()
    return screens


class Place(Folder):
    """A folder with the fast scene."""

    def __enter__(self):
        super().__enter__()
        self.write("fast.yaml", FAST)
        self.write("options.yaml", OPTIONS)
        self.write("wood.yaml", WOOD)
        self.write("cuts.yaml", CUTS)
        return self

    def play(self, script, scene="fast.yaml", **options):
        return play(self.path, script, scene, **options)

    def text(self, name):
        return (self.path / name).read_text()


def fast(script, scene="fast.yaml", **options):
    """Return the screens of a script on the fast scene in a separate folder."""
    with Place() as place:
        return place.play(script, scene, **options)


def actions():
    """Return the program's table of keys: (name, first word, second word, 0…2 in the bar, action)."""
    source = (ROOT / "src/tui/keys.h").read_text()
    source = re.sub(r'^ *V\((\w+), \w+, ([^,]+), (".*?"), NP_\("view", (".*?")\)\)', r'    X(VIEW_\1, \2, \3, K_NONE, "", 0, N_(\4), VIEW)', source, flags=re.M)
    rows = re.findall(r'X\((\w+), (?:\',\'|[^,]+), "(.*?)", [^,]+, "(.*?)", (\d), N_\("(.*?)"\), ', source)
    expect(len(rows) > 30 and len(rows) == len(re.findall(r"^ *X\([A-Z]", source, re.M)), rows)
    return [(name, word, word2, int(bar), text) for name, word, word2, bar, text in rows]


def check_good(folder, name):
    """Expect the program to find a scene valid."""
    done = subprocess.run([CEDUO, "--check", name], cwd=folder, env=home(folder), stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=PATIENCE, check=False)
    expect(done.returncode == DONE, f"{name}: ceduo --check says", done.stdout.decode(), "of",
           (Path(folder) / name).read_text()[:3000])
