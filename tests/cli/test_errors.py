#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The error table of the manual, row by row: each row is caused, and its message, place, status and cost are checked.

Cost: 10 s of processor time, and 64 MiB beyond the largest file. Nothing on standard output.
"""
import os
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import threading
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import (CEDUO, FULL, INPUT, OUTPUT, PATIENCE, PROFILES, ROOT, RUN, SANITIZED, SLOWER, USAGE, Folder, Skip,  # noqa: E402
                     Suite, environment, expect, expect_equal, expect_in, only_text, scene)
from test_input import FILES, SCENE, mutated  # noqa: E402

SECONDS = 10 * SLOWER
MEBIBYTE = 1 << 20
BEYOND = 64 * MEBIBYTE


class Ended:
    def __init__(self, arguments, status, out, err, memory):
        self.arguments, self.status, self.out, self.err, self.memory = arguments, status, out, err, memory

    def __str__(self):
        return (f"ceduo {' '.join(map(str, self.arguments))[:500]}\nstatus {self.status}, {self.memory >> 20} MiB\n"
                f"stdout: {self.out[:1000]}\nstderr: {self.err[:2000]}")


def limited(*arguments, program=CEDUO, stdin=subprocess.DEVNULL, stdout=None, env=None, **options):
    """Run the program within the processor time; a hang, a crash or a control character fails the test."""
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))

    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        p = subprocess.Popen([program, *map(str, arguments)], stdin=stdin, stdout=stdout or out, stderr=err, preexec_fn=limit,
                             env=environment(**(env or {})), **options)
        watch = threading.Timer(PATIENCE, p.kill)
        watch.start()
        _, status, usage = os.wait4(p.pid, 0)
        watch.cancel()
        p.returncode = os.waitstatus_to_exitcode(status)  # already reaped: Popen must not wait again
        out.seek(0)
        err.seek(0)
        bytes_out, bytes_err = out.read(), err.read()
    only_text(bytes_out, "stdout")
    only_text(bytes_err, "stderr")
    done = Ended(arguments, p.returncode, bytes_out.decode("utf-8", "replace"), bytes_err.decode("utf-8", "replace"),
                 usage.ru_maxrss * 1024)
    expect(0 <= done.status <= 4, "killed by a signal, or out of processor time", done)
    return done


def expect_small(done, size):
    expect(SANITIZED or done.memory <= size + BEYOND, f"{done.memory >> 20} MiB of memory", done)


# ---- the table ----

def as_pattern(row):
    """'...' matches any words; final brackets are a remark."""
    text = re.sub(r" \((status [^)]*|in the result)\)$", "", row)
    return ".*".join(re.escape(part.strip()) for part in text.split("..."))


def expect_message(row, done, place, status):
    """Expect the row's message in one line, after its place."""
    expect_equal(done.status, status, f"status; {done}")
    expect_equal(done.out, "", f"standard output; {done}")
    lines = [line for line in done.err.splitlines() if re.search(as_pattern(row), line)]
    expect(lines, f"no line says {row!r}", done)
    if place:
        expect(any(line.startswith(place) for line in lines), f"not at {place!r}:", done)


# ---- errors in the three files ----

class File:
    """A change in one of the three files of test_input; @@ marks the caret."""

    def __init__(self, name, old, new, at=True):
        self.name, self.old, self.new, self.at = name, old, new, at

    def __call__(self, row):
        files, place = mutated(self.name, self.old, self.new)
        expect(place or not self.at, f"no @@ in {self.new!r}")
        with Folder() as f:
            for name, text in files.items():
                f.write(name, text)
            for mode in ("--check", "--batch"):
                done = limited(mode, "scene.yaml", cwd=f.path)
                expect_message(row, done, f"{self.name}:{place[0]}:{place[1]}: " if place else None, INPUT)
                expect_small(done, 4096)
            expect(not place or any(line.strip() == "^" for line in done.err.splitlines()), "no caret", done)


def sc(old, new, at=True):
    return File("scene.yaml", old, new, at)


def sl(old, new, at=True):
    return File("slope.yaml", old, new, at)


def st(old, new, at=True):
    return File("stand.yaml", old, new, at)


ROCK = "rock: {shape: sphere, diameter_m: 0.5}"
VERTICES = "[[0, 64], [50, 30], [100, 0]]"
MATERIALS = "segments:\n  - {rn: 0.35, rt: 0.87, roughness_rad: 0.1, friction: 0.5}\n  - {rn: 0.31, rt: 0.83, roughness_m: 0.1}\n"
SMALL = {"ceduo": "scene/1", "rock": {"diameter_m": 0.5}, "slope": "line.csv", "controls_m": [75]}


class Text:
    """A separate scene: the whole text with @@ at the place."""

    def __init__(self, text, more=None, place=None):
        self.text, self.more, self.place = text, more or {}, place

    def __call__(self, row):
        text, place = self.text, self.place
        if isinstance(text, str) and "@@" in text:
            before = text[:text.index("@@")]
            place = f"s.yaml:{before.count(chr(10)) + 1}:{len(before) - before.rfind(chr(10))}: "
            text = text.replace("@@", "")
        with Folder() as f:
            f.write("s.yaml", text)
            for name, content in self.more.items():
                f.write(name, content)
            for mode in ("--check", "--batch"):
                done = limited(mode, "s.yaml", cwd=f.path)
                expect_message(row, done, place, INPUT)
                expect_small(done, len(text))


def csv(content, place, **slope):
    """A scene with an invalid CSV profile."""
    import json
    mapping = {**SMALL, "slope": {"csv": "line.csv", **slope}} if slope else SMALL
    return Text(json.dumps(mapping), {"line.csv": content}, place)


class Sparse:
    """A file of a gigabyte that uses no disk space."""

    def __init__(self, name, most):
        self.name, self.most = name, most

    def __call__(self, row):
        with Folder() as f:
            path = f.write("line.csv" if self.name == "line.csv" else "s.yaml", b"")
            os.truncate(path, 1 << 30)
            if self.name == "line.csv":
                f.write("s.yaml", scene(slope="line.csv"))
            for mode in ("--check", "--batch"):
                done = limited(mode, "s.yaml", cwd=f.path)
                expect_message(row, done, f"{self.name}: ", INPUT)
                expect_small(done, 0)  # detected by its size
            with open(path, "rb") as bytes_in:  # the size of standard input is unknown
                if self.name != "line.csv":
                    with subprocess.Popen(["cat"], stdin=bytes_in, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as cat:
                        done = limited("--check", "-", stdin=cat.stdout)
                        cat.stdout.close()
                    expect_message(row, done, "standard input: ", INPUT)
                    expect_small(done, self.most)


# ---- the command line ----

class Words:
    """Words of the command line, on a good scene unless they name one; '@' is that scene."""

    def __init__(self, *words, status=USAGE, start="ceduo: ", stdout=None):
        self.words, self.status, self.start, self.stdout = words, status, start, stdout

    def __call__(self, row):
        with Folder() as f:
            for name, text in FILES.items():
                f.write(name, text)
            words = ["scene.yaml" if w == "@" else w for w in self.words]
            done = limited(*words, cwd=f.path)
            expect_message(row, done, self.start, self.status)
            expect_small(done, 0)


class Set:
    """Changes by --set; @@ is the place in the last one."""

    def __init__(self, *changes):
        self.changes = changes

    def __call__(self, row):
        words = [word for change in self.changes for word in ("-s", change.replace("@@", ""))]
        Words("--batch", *words, "@", start=f"--set:1:{self.changes[-1].index('@@') + 1}: ")(row)


def as_nobody(row, *words, forbidden, status, start):
    """Run as an unprivileged user, with a copy of the program in an accessible folder."""
    if os.geteuid() != 0:
        program, rights = CEDUO, {}
    else:
        rights = {"user": 65534, "group": 65534, "extra_groups": []}
    with Folder() as f:
        os.chmod(f.path, 0o755)
        program = shutil.copy(CEDUO, f.path / "ceduo")
        os.chmod(program, 0o755)
        for name, text in FILES.items():
            f.write(name, text)
        f.write("out.csv", "old")
        os.chmod(f.path / forbidden, 0o000 if forbidden == "scene.yaml" else 0o444)
        try:
            done = limited(*words, cwd=f.path, program=program, **rights)
        except PermissionError as error:
            raise Skip("the folder for temporary files is closed to others") from error
        expect_message(row, done, start, status)
        os.chmod(f.path / forbidden, 0o644)
        expect_equal((f.path / "out.csv").read_text(), "old")
        expect_equal(f.names(), sorted([*FILES, "ceduo", "out.csv"]), "left behind")


class Script:
    def __init__(self, text, line=1, status=USAGE):
        self.text, self.line, self.status = text, line, status

    def __call__(self, row):
        with Folder() as f:
            for name, text in FILES.items():
                f.write(name, text)
            f.write("play.txt", self.text)
            expect_message(row, limited("--script", "play.txt", "scene.yaml", cwd=f.path), f"play.txt:{self.line}: ", self.status)


def full(row):
    with open("/dev/full", "wb") as out:
        done = limited("--batch", "-n", 10, PROFILES / "scenes/paper-site.yaml", stdout=out)
    expect_message(row, done, "standard output: ", OUTPUT)


def moving(row):
    ground = {"vertices_m": [[0, 0], [100, 0]], "segments": [{"rn": 1, "rt": 1, "roughness_rad": 0, "friction": 0}]}
    with Folder() as f:
        path = f.write("s.yaml", scene(release={"x_m": 5, "height_m": 3}, slope=ground, controls=[{"x_m": 30}],
                                       simulation={"rocks": 4, "law": "lumped"}))  # under crsp Rn falls with the speed
        done = limited("--batch", "-s", "uncertainty=none", path)
    expect_equal((done.status, done.err), (RUN, ""), str(done))
    expect(re.search(as_pattern(row), " ".join(done.out.split())), done)


class Elsewhere:
    """Tested by another test."""

    def __init__(self, path, name):
        self.path, self.name = path, name

    def __call__(self, row):
        expect_in(self.name, (ROOT / self.path).read_text(), f"the test of {row!r}")


def on_terminal(row, name, **instead):
    """The terminal program with this TERM."""
    master, slave = os.openpty()
    try:
        streams = {"stdin": slave, "stdout": slave, **instead}
        expect_message(row, limited("paper-site", **streams, env={"TERM": name}), "ceduo: ", USAGE)
    finally:
        os.close(master)
        os.close(slave)


def impossible(_):
    raise Skip("nothing is known that leads here: what comes before it looks at the same")


LINE = "distance,elevation\n0,64\n100,0\n"
CASES = {
    # Reading a file
    "cannot read it: No such file or directory": Words("--batch", "none.yaml", status=INPUT, start="none.yaml: "),
    "cannot read it: No such file or directory; did you mean 'paper-site'? ...": lambda row: [
        Words("--batch", name, status=INPUT, start=f"{name}: ")(row) for name in ("paper-sit", "papersite.yaml")],
    "cannot read it: Is a directory": Words("--batch", ".", status=INPUT, start=".: "),
    "cannot read it: Permission denied": lambda row: as_nobody(row, "--check", "scene.yaml", forbidden="scene.yaml",
                                                               status=INPUT, start="scene.yaml: "),
    "cannot read it: a device or a socket; name a file": Words("--batch", "/dev/zero", status=INPUT, start="/dev/zero: "),
    "larger than 16 MiB": Sparse("s.yaml", 16 * MEBIBYTE),
    "larger than 64 MiB": Sparse("line.csv", 64 * MEBIBYTE),
    "cannot find 'x.yaml' next to this file or among the profiles": sc("slope: slope.yaml", "slope: @@x.yaml"),
    "cannot find 'p.csv' next to this file or among the profiles": sl("vertices_m: " + VERTICES, "csv: @@p.csv"),
    "more than 8 files in a chain of 'base'; do they form a loop?": st("ceduo: stand/1\n", "ceduo: stand/1\nbase: @@stand.yaml\n"),
    "more than 1000 files in one scene": Text(
        "ceduo: scene/1\noptions:\n  - forest:\n" + "".join(f"    - {{stand: {i}.yaml}}\n" for i in range(1000)) +
        "  - forest:\n    - {stand: @@1000.yaml}\n", {f"{i}.yaml": "{}" for i in range(1001)}),
    # YAML
    "malformed YAML: did not find expected ',' or ']' while parsing ...": sc("title: small", "title: [a\ntitle@@: small"),
    "malformed YAML: no key can stand here; put a text with ': ' in quotes, or indent the line equally": sc("title: small", "title: a@@: b"),
    "malformed YAML: no value can start with this character": sc("title: small", "title: @@`small"),
    "a tab; indent with spaces": sc("release: {x_m", "release:\n@@\tx_m: 5\nextra: {x_m"),
    "an alias, an anchor or a tag; write the value out without it": lambda row: [
        sc("title: small", f"title: @@{value}")(row) for value in ("*small", "&t small", "!!str small")],
    "title: given twice, first on line 2; keep one": sc("simulation: {", "@@title: again\nsimulation: {"),
    "a key must be a plain word": sc("title: small", "? @@[a]\n: small"),
    "more than 64 keys in one mapping": Text("".join(f"k{i}: 1\n" for i in range(64)) + "@@k64: 1\n"),
    "more than 16 levels deep": sc("title: small", "title: " + "[" * 15 + "@@[" + "]" * 16),
    "a value of more than 65536 bytes; look for a missing quote": sc("title: small", "title: @@" + "x" * 65537),
    "more than 250000 values in one file; write a long profile as CSV": Text("title:\n" + "- 1\n" * 249998 + "- @@1\n" * 1),
    "a second document; a file must have only one": sc("simulation: {", "@@---\nsimulation: {"),
    "not UTF-8; save the file as UTF-8": Text(b"title: \xfc\n", place="s.yaml:1:8: "),
    "a control character (\\x01); remove it": sc("title: small", "title: sm@@\x01all"),
    "a control character (\\x00); remove it": sc("title: small", 'title: @@"sm\\0all"'),
    "there is no value": Text("# nothing\n", place="s.yaml: "),
    "a scene is a mapping that begins with 'ceduo: scene/1'": Text("@@- 1\n"),
    # Keys and values
    "'scene/2': expected scene/1": sc("ceduo: scene/1", "ceduo: @@scene/2"),
    "unknown key; did you mean 'diameter_m'?": sc("diameter_m: 0.5", "@@diametre_m: 0.5"),
    "unknown key; known here: ...": sc("{x_m: 90}", "{x_m: 90, @@qqqqqqqqqqqqqqq: 1}"),
    "'rn' is missing: normal restitution Rn": sl("  - {rn: 0.35, ", "  - @@{"),
    "'0.8 m' is not a number; write it without its unit, in the unit of the key": sl("rt: 0.87", "rt: @@0.8 m"),
    "'s.csv' is a table; convert a survey to a stand with ceduo --survey s.csv -o FILE.yaml":
        sc("to_m: 40\n    stand: stand.yaml", "to_m: 40\n    stand: @@s.csv"),
    "'0.8' is in quotes; write the number without them": sl("rt: 0.87", "rt: @@'0.8'"),
    "'0.8 m' is not a number": sc("diameter_m: 0.5", "diameter_m: @@0.8 m"),
    "decimal comma: write 0.8": st("dbh_m: 0.07", "dbh_m: @@0,8"),
    "'1,250' is not a number; write a dot for the decimals ...": st("dbh_m: 0.07", "dbh_m: @@1,250"),
    "the number is too large": st("per_ha: 5000", "per_ha: @@" + "9" * 400),
    "'10.5' is not a whole number": sc("rocks: 20", "rocks: @@10.5"),
    "-0.07 is below 0 m": st("dbh_m: 0.07", "dbh_m: @@-0.07"),
    "0 is not above 0 m": sc("diameter_m: 0.5", "diameter_m: @@0"),
    "1.83 is above 1": sl("rn: 0.35", "rn: @@1.83"),
    "1.5707963267948966 is not below 1.5707963267948966 rad": sl("roughness_rad: 0.1", "roughness_rad: @@1.5707963267948966"),
    "'lumpd' is unknown; did you mean 'lumped'? (lumped, crsp, arm)": sc("law: lumped", "law: @@lumpd"),
    "'sand' is unknown; one of: ...": sl(MATERIALS, "materials: [{from_m: 0, to_m: 100, material: @@sand}]\n"),
    "'yes': expected true or false": sc("scale_rn: false", "scale_rn: @@yes"),
    "expected a number, not a list": st("per_ha: 5000", "per_ha: @@[5000]"),
    "expected a mapping, not a single value": sc(ROCK, "rock: @@0.5"),
    "expected a list, not a mapping": st("trees:\n", "trees: @@{}\nextra:\n"),
    "expected [x, z]": sl("[50, 30]", "@@[50]"),
    "expected [a, b, c]": sc(ROCK, "rock: {shape: block, axes_m: @@[1, 2]}"),
    "'kind' is missing: measured, literature, assumed or calibrated": st("source: {kind: measured, text: by hand}", "source: @@{text: by hand}"),
    "'mean' is missing: diameter of a sphere or cylinder": sc("diameter_m: 0.5}", "diameter_m: @@{spread: 0.1}}"),
    "with this spread the values reach from -0.4 to 2 m; reduce it to stay within the range": sc(
        "diameter_m: 0.5}", "diameter_m: @@{mean: 0.8, spread: 1.2, kind: uniform}}"),
    # Rock
    "does not belong to the shape 'block'; give the whole rock: -s ...":
        Words("--batch", "-s", "rock.shape=block", "@", start="scene.yaml:"),
    "does not belong to the shape 'sphere'; remove it": sc("diameter_m: 0.5}", "diameter_m: 0.5, height_m: @@1}"),
    "'height_m' is missing; the shape 'cylinder' needs it": sc("rock: {shape: sphere", "rock: @@{shape: cylinder"),
    "a sphere needs one of diameter_m, volume_m3 and mass_kg ...": sc(ROCK, "rock: @@{shape: sphere}"),
    "mass_kg already says this; keep one of the two": sc(
        ROCK, "rock: {shape: block, axes_m: [1, 2, 3], mass_kg: 5, density_kg_m3: @@2600}"),
    "the rock is too small or too large to compute": sc(ROCK, "rock: @@{shape: block, axes_m: [1e-150, 1e-150, 1e-150]}"),
    # Blocks
    "expected [lo, hi]": sc(
        ROCK, ROCK + "\nblocks: {per_year: 1, exponent: 1, volume_m3: @@[1]}"),
    "2 m3 is not below 1 m3; write the smaller volume first": sc(
        ROCK, ROCK + "\nblocks: {per_year: 1, exponent: 1, volume_m3: @@[2, 1]}"),
    "this class overlaps an earlier one, from 1 to 3 m3; ...": sc(
        ROCK, ROCK + "\nblocks: [{per_year: 1, volume_m3: [1, 3]}, {per_year: 1, volume_m3: @@[2, 5]}]"),
    "the list is empty": sc(ROCK, ROCK + "\nblocks: @@[]"),
    "'exponent' is missing; the number of blocks above a volume v ...": sc(
        ROCK, ROCK + "\nblocks: @@{per_year: 1, volume_m3: [1, 2]}"),
    "blocks already says this; keep one of the two": sc(
        ROCK, ROCK + "\nblocks: [{per_year: 1, volume_m3: [1, 2]}]\nrocks_per_year: @@2"),
    "'blocks' gives the sizes of rocks; remove the size here, or its spread": sc(
        ROCK, "rock: @@{diameter_m: {mean: 1, spread: 0.1}}\nblocks: [{per_year: 1, volume_m3: [1, 2]}]"),
    # Slope
    "x must rise, but 10 follows 10; ...": sl(VERTICES, "[[0, 64], [10, 30], @@[10, 0]]"),
    "the profile rises from 15 to 141.4 m, but rocks move along x; ...": sl(VERTICES, "@@[[0, 15], [100, 141.4]]"),
    "the profile already falls from 64 to 0 m; remove 'reversed'": sl("facets: against", "facets: against\nreversed: @@true"),
    "a profile needs two points or more": sl(VERTICES, "@@[[0, 64]]"),
    "two vertices are too close together for their distance from the first; remove one": sl(
        f"ceduo: slope/1\nname: line\nfacets: against\nvertices_m: {VERTICES}",
        "ceduo: slope/1\nname: line\nfacets: against\nvertices_m: [[-900000000, 64], [100, 30], [100.00000000000001, 0]]", at=False),
    "'vertices_m' is missing; give the profile, or a table in 'csv'": sl(f"vertices_m: {VERTICES}\n", "", at=False),
    "vertices_m already says this; keep one of the two": sl("facets: against", "csv: @@line.csv"),
    "'segments' or 'materials' is missing; give the ground": sl(MATERIALS, "", at=False),
    "segments already says this; keep one of the two": sl(
        "segments:\n", "materials: @@[{from_m: 0, to_m: 100, material: talus}]\nsegments:\n"),
    "3 segments for 2 stretches between vertices; ...": sl("  - {rn: 0.31", "  - {rn: 0.31, rt: 0.8}\n  - {rn: 0.31", at=False),
    "roughness_rad already says this; keep one of the two": sl("roughness_m: 0.1", "roughness_rad: 0.1, roughness_m: @@0.1"),
    "50 leaves a gap or an overlap; begin at 40": sl(
        MATERIALS, "materials: [{from_m: 0, to_m: 40, material: talus}, {from_m: @@50, to_m: 100, material: talus}]\n"),
    "40 is before the end of the profile, 100; extend the last row": sl(MATERIALS, "materials: [{from_m: 0, to_m: @@40, material: talus}]\n"),
    "the end (-1) must lie beyond the start (0)": sl(MATERIALS, "materials: [{from_m: 0, to_m: @@-1, material: talus}]\n"),
    "the line of heads must name the columns 'distance' and 'elevation'": csv("a,64\n100,0\n", "line.csv:1:1: "),
    "too few columns": csv("distance,elevation\n0,64\n50\n100,0\n", "line.csv:3:1: "),
    "a value is missing; remove the line": csv("distance,elevation\n0,64\n50,\n100,0\n", "line.csv:3:4: "),
    "the decimal sign of '1.000,5' is not the dot of line 2; use one sign in the whole table": csv("distance;elevation\n0;6.4\n1.000,5;0\n", "line.csv:3:1: "),
    "distances must rise, but 5 follows 10; sort the rows by distance": csv("distance,elevation\n0,64\n10,30\n5,40\n20,10\n", "line.csv:4:1: "),
    "-1e10 is outside the range -1e+09 to 1e+09 m": csv("distance,elevation\n0,64\n100,-1e10\n", "line.csv:3:5: "),
    "the file is empty": csv("", "line.csv: "),
    # Release, controls, forest
    "100 lies outside the slope; a release must be at least ...": sc("{x_m: 5, h", "{x_m: @@100, h"),
    "900 lies outside the slope, which goes from 0 to 100 m": sc("{x_m: 90}", "{x_m: @@900}"),
    "-10 lies outside the slope, which goes from 0 to 100 m": sc("  - from_m: 10\n", "  - from_m: @@-10\n"),
    "0 must lie beyond the release (0 m)": sc("x_m: 5, height_m: 0, vx_m_s: 1}\nslope: slope.yaml\ncontrols:\n  - {x_m: 75",
                                                 "x_m: 0}\nslope: slope.yaml\ncontrols:\n  - {x_m: @@0"),
    "'90' is given twice": sc("{x_m: 75, name", "{x_m: 90, name", at=False),
    "controls already says this; keep one of the two": sc("forest:\n", "controls_m: @@[80]\nforest:\n"),
    "forest already says this; keep one of the two": sc("simulation: {", "options: @@[{name: a}]\nsimulation: {"),
    "'controls' is missing; give at least one place ...": sc(
        "controls:\n  - {x_m: 75, name: road, accepted_kJ: 50}\n  - {x_m: 90}\n", "", at=False),
    "the list is empty": sl(MATERIALS, "materials: @@[]\n"),
    "1001 items; at most 1000 can be computed": sc(
        "controls:\n  - {x_m: 75, name: road, accepted_kJ: 50}\n  - {x_m: 90}\n",
        "controls_m: @@[" + ", ".join(str(10 + i / 20) for i in range(1001)) + "]\n"),
    "'a' is given twice": Text(
        SCENE.split("forest:")[0].replace("slope.yaml", "{vertices_m: [[0, 64], [100, 0]], segments: [{rn: 0.3, rt: 0.8}]}") +
        "options: [{name: a}, {name: @@a}]\n"),
    "belts must not overlap, but this one begins at 10 and the previous one ends at 20": sc(
        "to_m: 40\n    stand: stand.yaml\n  - {from_m: 40", "to_m: 20\n    stand: stand.yaml\n  - {from_m: @@10"),
    "the end (8) must lie beyond the start (10)": sc("    to_m: 40\n", "    to_m: @@8\n"),
    "shoots without stools; ...": st("stools: {per_ha: 2000, spacing_m: 0.25}\n", "", at=False),
    "stools without shoots; ...": st("shoots:\n  - per_ha: 5000\n    dbh_m: 0.07\n    height_m: 6\n", "", at=False),
    "6000 shoots are too few for 7000 stools; each stool needs one": st(
        "stools: {per_ha: 2000, spacing_m: 0.25}\nshoots:\n  - per_ha: 5000",
        "stools: {per_ha: @@7000, spacing_m: 0.25}\nshoots:\n  - per_ha: 6000"),
    "'bare' has no stems; name the system, or remove the stems": st("system: simple-coppice", "system: @@bare"),
    "'energy_kJ' is missing; it has no default": Set(
        "forest[0].stand.stumps=@@{per_ha: 300, diameter_m: 0.3, height_m: 0.2}"),
    "'length_m' is missing; it has no default": Set(
        "forest[0].stand.logs=@@{per_ha: 30, diameter_m: 0.1, energy_kJ: 2}"),
    "'radius_m' is missing; it has no default": Set(
        "forest[0].stand.trees=[{per_ha: 50, dbh_m: 0.2, height_m: 12, groups: @@{stems: 5}}]"),
    # Changes by --set
    "--set:1:18: there is no value": Set("release.height_m=@@"),
    "rocks_per_year: '5%' is not a number; write 0.05": Set("rocks_per_year=@@5%"),
    "'#' is special in YAML; write the text in quotes: title=\"#1\"": Set("title=@@#1"),
    "expected PATH=VALUE": Set("@@rock.diameter_m"),
    "malformed path; keys are joined by '.', items are [0] or [name]": Set("rock@@..diameter_m=1"),
    "'diameter': unknown key; did you mean 'diameter_m'?": Set("rock.@@diameter=1"),
    "'3': no such item; there are: [0] road, [1]": Set("controls[@@3].x_m=50"),
    "'road': several items have this name; use one of: [0], [1]": Set(
        "controls[1].name=road", "controls[@@road].accepted_kJ=1"),
    "'0': there is no list here": Set("rock[@@0]=1"),
    "'from_m': there is no mapping here": Set("forest.@@from_m=1"),
    "there is no 'trees' here": Set("forest[1].stand=bare", "forest[1].stand.@@trees[0].per_ha=1"),
    "'#' is special in YAML; write the text in quotes: title=\"x #1\"": Set("title=@@x #1"),
    "': ' is special in YAML; write the text in quotes: title=\"a: b\"": Set("title=@@a: b"),
    "there is no 'blocks' here": Set("@@blocks.per_year=3"),
    "this scene has options; write options[0].forest[0].to_m, ...": Words(
        "--batch", "-s", "forest[0].to_m=50", "four-systems", start="--set:1:1: "),
    "the scene is valid without this change, but not with it:": Set("forest[0].to_m=@@50"),
    # Usage
    "standard input and output are not a terminal; use 'ceduo --batch SCENE.yaml', ...": Words("@"),
    "standard input is not a terminal; ...": lambda row: on_terminal(row, "xterm", stdin=subprocess.DEVNULL),
    "standard output is not a terminal; ...": lambda row: on_terminal(row, "xterm", stdout=subprocess.DEVNULL),
    "unknown terminal in TERM; try 'TERM=xterm-256color ceduo'; ...": lambda row: on_terminal(row, "no-such-terminal"),
    "this terminal cannot place the cursor; ...": lambda row: on_terminal(row, "dumb"),
    "this terminal cannot be used; ...": impossible,
    "no scene given; name a file, ...": Words("--batch"),
    "--rocks requires --batch": Words("-n", "5", "@"),
    "the terminal program opens one scene; --batch takes several": Words("@", "@"),
    "--list-profiles takes no scene: 'mine.yaml'": Words("--list-profiles", "mine.yaml"),
    "standard input can be read only once; name a file for the scene": Words("--batch", "-", "-"),
    "unknown or ambiguous option '--xyz'": Words("--xyz"),
    "'--plain' is gone: shares and means are always as counted; leave it out": Words("--plain", "x.yaml"),
    "'--shard' is gone: a scene is computed at once; ...": lambda row: [
        Words(*words, "x.yaml")(row.replace("--shard", words[0])) for words in (("--shard", "1/2"), ("--shard=1/2",))],
    "'--merge' is gone: results of several scenes are printed together; ...": Words("--merge", "x.jsonl"),
    "'-f' needs a value": Words("--batch", "@", "-f"),
    "--format: 'xml' is unknown; one of: table, csv, json": Words("--batch", "-f", "xml", "@"),
    "--rows: 'x' is unknown; one of: controls, stands": Words("--batch", "--rows", "x", "@"),
    "--plot: 'x' is unknown; one of: profile, energy, ...": Words("--plot", "x", "@"),
    "--plot: 'adc' is gone: the page of --details has the ADC of each belt": Words("--plot", "adc", "@"),
    "--charset: 'x' is unknown; one of: braille, block, ascii": Words("--charset", "x", "@"),
    "--rocks: '1.5' is not a whole number": Words("--batch", "-n", "1.5", "@"),
    "--rocks: 1048577 is outside 1 to 1048576": Words("--batch", "-n", "1048577", "@"),
    "--tolerance: 1 is not a share; write a number between 0 and 1, such as 0.05 for 5 %": lambda row: (
        Words("--batch", "-e", "1", "@")(row), Words("--batch", "-e", "0", "@")(row.replace("1 is", "0 is"))),
    "--size: '80' is not COLUMNSxLINES, such as '80x24'": Words("--plot", "stand", "--size", "80", "@"),
    "--size: 10x5 is outside 20x6 to 1000x500": Words("--plot", "stand", "--size", "10x5", "@"),
    "--years: '5' is not A:B[:STEP], such as '0:25'": Words("--years", "5", "@"),
    "--years: 0:5000: give at most 1000 years between 0 (the stand in the file) and 100000": lambda row: [
        Words(f"--years={words}", "@")(row.replace("0:5000", words)) for words in ("0:5000", "-5:-1", "5:100001")],
    "--years: 9:1: the last year is before the first; write 1:9": Words("--years=9:1", "@"),
    "--find: 'x' is not PATH=LO:HI, such as ...": Words("--find", "x", "--goal", "adc", "@"),
    "--find: the range 9:1 is empty; HI must be above LO": Words("--find", "a=9:1", "--goal", "adc", "@"),
    "--find requires --goal": Words("--find", "a=1:9", "@"),
    "--goal: 'x' is unknown; one of: adc, free-run, energy, exceed": Words("--find", "a=1:9", "--goal", "x", "@"),
    "--goal: 'energy' needs a value, such as energy=50": Words("--find", "a=1:9", "--goal", "energy", "@"),
    "--goal: 5 is not a share; write a number between 0 and 1, such as 0.05 for 5 %": lambda row: (
        Words("--find", "a=1:9", "--goal", "exceed=5", "@")(row),
        Words("--find", "a=1:9", "--goal", "free-run=2", "@")(row.replace("5 is", "2 is"))),
    "--goal requires --find": Words("--batch", "--goal", "adc", "@"),
    "--sure requires --find": Words("--batch", "--sure", 0.9, "@"),
    "--sure: 90 is not a share; write a number between 0 and 1, such as 0.05 for 5 %": Words("--find", "a=1:9", "--goal", "adc", "--sure", 90, "@"),
    "--sure: over a rotation the mean energy has no uncertainty; ...": Words(
        "--find", "options[0].forest[0].stand.cutting.rotation_years=10:30", "--goal", "energy=10", "--years", "--sure", 0.9, "--option",
        "coppice with standards", "four-systems", start="--sure: "),
    "--find: the scene has several options; name one with --option": Words("--find", "rock.diameter_m=1:2", "--goal", "adc", "four-systems"),
    "--find cannot be used with --years A:B": Words("--find", "a=1:9", "--goal", "adc", "--years", "0:5", "@"),
    "--report: 'other.yaml' does not end in .html or .htm; name the page, or - for standard output, then the scenes: ...":
        Words("--report", "other.yaml", "@"),
    "--size requires --plot": Words("--batch", "--size", "80x24", "@"),
    "--plot cannot be used with --format csv": Words("--plot", "stand", "-f", "csv", "@"),
    "--option: no option 'x' in mine.yaml; it has: 'current'": lambda row: [
        Words(*words, "--option", "x", "@")(row.replace("mine", "scene")) for words in (
            ("--batch",), ("--check",), ("--find", "rock.diameter_m=1:2", "--goal", "adc"))],
    # Surveys
    "750 cm is more than 300 cm; ...": Elsewhere("tests/cli/test_survey.py", "def test_thick"),
    # Scripts
    "key, type, resize, wait idle, dump, roles or draw expected: x": Script("# first\nx\n", 2),
    "no such key: x": Script("key Enter\nkey j x!\n".replace("x!", "xx"), 2),
    "width and height expected: 80": Script("resize 80\n"),
    "No such file or directory: out/x.txt (status 4)": Script("dump out/x.txt\n", status=OUTPUT),
    # Running and writing
    "out of memory (status 1, in a file 3)": Elsewhere("tests/cli/test_faults.py", "out of memory"),
    "cannot be computed (status 1)": impossible,
    "4 rocks were still moving after 1000000 contacts ... (in the result)": moving,
    "x, 90 m: whether 50 of 1000 rocks at most arrive with too much energy is too close to call; ... (in the result)":
        Elsewhere("tests/cli/test_table.py", "def test_table_close_call"),
    "--output: name a file (status 4)": Words("--batch", "-o", "", "@", status=OUTPUT, start="--output: "),
    "scene.yaml: this file is an input of the run; write elsewhere (status 4)": Words(
        "--batch", "-o", "scene.yaml", "@", status=OUTPUT, start="scene.yaml: "),
    "standard output: No space left on device (status 4)": full,
    "out.csv: Permission denied (status 4)": lambda row: as_nobody(row, "--batch", "-f", "csv", "-o", "out.csv", "scene.yaml",
                                                                  forbidden="out.csv", status=OUTPUT, start="out.csv: "),
    "--check cannot be used with --format": lambda row: [
        Words(*mode, *words, "@")(row.replace("--check", mode[0]).replace("--format", f"--{name}")) for mode, name, words in (
            (("--find", "a=1:9", "--goal", "adc"), "plot", ("--plot", "stand")), (("--find", "a=1:9", "--goal", "adc"), "tolerance", ("-e", 0.1)),
            (("--report", "x.html"), "format", ("-f", "json")), (("--report", "x.html"), "plot", ("--plot", "stand")),
            (("--sensitivity",), "tolerance", ("-e", 0.1)), (("--calibrate", "a=1:2"), "option", ("--option", "x")))] + [
        Words("--check", *words, "@")(row.replace("--format", f"--{name}")) for name, words in (
            ("format", ("-f", "json")), ("rocks", ("-n", 5)), ("output", ("-o", "x")), ("plot", ("--plot", "stand")),
            ("find", ("--find", "a=1:2", "--goal", "adc")), ("tolerance", ("-e", 0.1)), ("years", ("--years", "0:2")),
            ("script", ("--script", "x")), ("charset", ("--charset", "ascii")), ("rows", ("--rows", "stands")))],
    "--rows requires --format csv": lambda row: [
        Words("--batch", "--rows", "stands", *words, "@")(row) for words in ((), ("-f", "json"))],
    "--charset requires --plot": Words("--batch", "--charset", "ascii", "@"),
    "--batch cannot be used with --script": Words("--batch", "--script", "x", "@"),
    "--years requires --plot rotation|years|ahead|tradeoff": Words("--years", "0:5", "--plot", "profile", "@"),
}


# ---- floods: a large file of one error ----

HEAD = "ceduo: scene/1\nrock: {diameter_m: 0.5}\n"
LINEAR = HEAD + "slope: {vertices_m: [[0, 64], [100, 0]], segments: [{rn: 0.3, rt: 0.8}]}\n"
BELT = "stand: {trees: [{per_ha: 1, dbh_m: 0.2, height_m: 9}]}"
MANY = "at most 1000 can be computed"
NAMED = HEAD + "slope: line.csv\ncontrols_m: [75]\n"
LARGE = 60 if FULL else 12
FLOODS = [
    # (name, functions for the scene and its CSV, words); made late, because memory of the test counts as the program's
    ("a million CSV rows that are no numbers", lambda: NAMED, lambda: "distance,elevation\n" + "x,1\n" * 1000000,
     "999 more of this kind, on line 3, 4, 5, 6, 7 …\n999000 more problems"),
    (f"{LARGE} MiB of blank CSV lines", lambda: NAMED.replace("75", "175"), lambda: LINE + "\n" * (LARGE << 20), "outside the slope"),
    (f"a CSV field of {LARGE} MiB", lambda: NAMED, lambda: LINE + "5" * (LARGE << 20) + ",1", "line.csv:4:1: '…' is not a number"),
    ("a CSV header of 300000 columns", lambda: NAMED, lambda: "distance" + ",c" * 300000 + ",elevation\n0,64\n100,0\n",
     "too few columns"),
    ("200000 vertices that are no pairs, each on its line", lambda: HEAD + "slope: {segments: [{rn: 0.3, rt: 0.8}], vertices_m: [\n" +
     "1,\n" * 200000 + "1]}\ncontrols_m: [75]\n", None, "more problems"),
    ("8 million values", lambda: "title: [" + "1," * 8000000 + "1]\n", None, "more than 250000 values"),
    ("200000 controls", lambda: LINEAR + "controls_m: [" + ",".join(str(1 + i * 1e-4) for i in range(200000)) + "]\n", None, MANY),
    ("200000 times the same control", lambda: LINEAR + "controls_m: [" + "75," * 200000 + "75]\n", None, MANY),
    ("50000 options", lambda: LINEAR + "controls_m: [75]\noptions: [" + ",".join(f"{{name: a{i}}}" for i in range(50000)) + "]\n",
     None, MANY),
    ("20000 belts", lambda: LINEAR + "controls_m: [75]\nforest: [" +
     ",".join(f"{{from_m: {i / 1000}, to_m: {i / 1000}1, {BELT}}}" for i in range(20000)) + "]\n", None, MANY),
    ("60000 belts of one shipped stand", lambda: LINEAR + "controls_m: [75]\nforest: [" +
     ",".join(f"{{from_m: {i}, to_m: {i}.5, stand: ads-1}}" for i in range(60000)) + "]\n", None, MANY),
    ("a number of 15 million digits", lambda: LINEAR + "controls_m: [" + "5" * 15000000 + "x]\n", None, "more than 65536 bytes"),
    ("a number of 65536 digits", lambda: LINEAR + "controls_m: [" + "5" * 65535 + "x]\n", None, "is not a number"),
    ("5 million dashes", lambda: "- " * 5000000, None, "levels deep"),
    ("16 million brackets", lambda: "[" * 16000000, None, "levels deep"),
    ("3 million anchors", lambda: "title: [" + "&a , " * 3000000, None, "an anchor"),
]


def flood(text, csv_text, words):
    with Folder() as f:
        size = f.write("s.yaml", text()).stat().st_size
        if csv_text:
            size = f.write("line.csv", csv_text()).stat().st_size
        for mode in ("--check", "--batch"):
            done = limited(mode, "s.yaml", cwd=f.path)
            expect_equal((done.status, done.out), (INPUT, ""), str(done))
            expect_in(words, done.err)
            expect(len(done.err) < 65536, f"{len(done.err)} characters of messages")
            expect_small(done, size)


def test_shared_fault():
    """An invalid YAML file that two belts use is reported once, and nothing else"""
    with Folder() as f:
        f.write("s.yaml", LINEAR + "controls_m: [75]\nforest:\n" +
                "".join(f"  - {{from_m: {i}, to_m: {i + 1}, stand: stand.yaml}}\n" for i in range(2)))
        f.write("stand.yaml", "name: [\n")
        done = limited("--check", "s.yaml", cwd=f.path)
        expect_equal((done.status, len(done.err.splitlines())), (INPUT, 3), str(done))


def test_names_on_the_screen():
    """Control characters in names and titles do not reach the terminal program's screen"""
    nasty = '"\\e[31mred\\a\\u009b2J\\u202eevil\\n\\t\\r\\ufdd0\\ufffe\\U0001ffff"'
    with Folder() as f:
        f.write("s.yaml", f"title: {nasty}\n" + LINEAR + f"controls: [{{x_m: 75, name: {nasty}}}]\noptions:\n  - name: {nasty}\n"
                f"    forest: [{{from_m: 10, to_m: 20, stand: {{name: {nasty}, trees: [{{per_ha: 9, dbh_m: 0.3, height_m: 20}}]}}}}]\n"
                "simulation: {rocks: 20}\n")
        f.write("play.txt", "wait idle\n" + "".join(f"key {view}\ndump -\nkey Down Enter\ndump -\nkey Esc\n" for view in range(1, 7)))
        done = limited("--script", "play.txt", "s.yaml", cwd=f.path)  # raw ones are searched there
        expect_equal((done.status, done.err), (0, ""), str(done))
        expect_in("evil", done.out)


def main():
    suite = Suite()
    suite.run([test_shared_fault, test_names_on_the_screen])
    for what, text, csv_text, words in FLOODS:
        suite.check(f"{what}: {words}", flood, text, csv_text, words)
    for row, case in CASES.items():
        suite.check(row, case, row)
    suite.end()


if __name__ == "__main__":
    main()
