#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Messages about an unrecognized file show only its first 20 characters, for every way to name it."""
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import DONE, Folder, ceduo, expect, expect_equal, expect_in, run_all, scene, stand  # noqa: E402

# Every word from the 21st character on is foreign to ceduo's messages.
PRIVATE = {
    "passwd": "qroot:x:0:0:wurzel:/zroot:/zbin/zbash\nqdaemon:x:1:1:qdemon:/zusr/zsbin:/zusr/znologin\nceduo:x:2:2:qced:/zhome/ceduo:/zsh\n",
    "keys.yaml": "db_user: qadmin\ndb_passphrase: qhunter2qhunter2\nqlist: [qalpha, 4711.0815]\nname: qname\ntrees: qtrees\n",
    "keys.json": json.dumps({"type": "service", "private_key_id": "qdeadbeefqdeadbeef", "client": {"mail": "qmail@qhost"}}),
    "one.env": "AWS_ZUGANG=" + "qk".join("0123456789") + "\nB=qsecond\n",
    "list.yaml": "- qfirstqfirstqfirstqfirst\n- qsecondqsecond\n",
    "private.pem": "-----BEGIN QKEY-----\nMIIEqAIBAAKCAQEAqqq\nqwertyuiopasdfgh==\n-----END QKEY-----\n",
    "people.csv": "user;zugang;qhost\nqroot;qs3cr3tqs3cr3t;qh1\nqjack;47110815;qh2\n",
    "numbers.csv": "quser,znumber\n4711.0815,zx12345\nqtwo,3.14159265\n",
    "tabs.conf": "qhosts:\n\tqalpha: qbeta\n\tqgamma: qdelta\n",
    "long": "q" + "xyz" * 1000 + "\nqsecondqsecond " * 3,
    "blank": "# only a comment\n\nqthirdqthird: qthirdvalue\n",
    "flow.yaml": "{qalpha: [qbeta, {qgamma: qdelta}], qeps: 'qzeta",
    "ends with a word": "qalpha: qbetaqbetaqbeta\nqgamma: [qdelta, ceduo:",
    "ends with a kind": "qalpha: qbetaqbetaqbeta\nqgamma: [qdelta, ceduo: scene",
    "ends with a slash": "qalpha: qbetaqbetaqbeta\nqgamma: [qdelta, ceduo: scene/",
    "no number": "qalpha: qbetaqbetaqbeta\nqgamma: [qdelta, ceduo: scene/-, ceduo: scene/x",
    "docker.yaml": "ceduo:\n  qimage: qregistry\n  qenv: {QPASS: qhunter2}\n",
}
GROUND = [{"rn": 0.35, "rt": 0.875, "roughness_rad": 0.125, "friction": 0.5}]
WHY = "(nothing says that this file is one of ceduo's: no more of it is shown)"
FIRST = PRIVATE["passwd"].split("\n", 1)[0]


def scenes_naming(path):
    """Return scenes that name a file in every possible place."""
    flat = {"vertices_m": [[0, 64], [100, 0]], "segments": GROUND}
    column = FIRST if path.name == "passwd" else "zugang" if path.name == "people.csv" else "znumber"
    table = {"csv": str(path)}
    yield scene(slope=str(path))
    yield scene(slope={**table, "materials": [{"from_m": 0, "to_m": 100, "material": "talus"}]})
    for what in (str(path), {"base": str(path)}, {"base": str(path), "name": "wood"}):
        yield scene(forest=[{"from_m": 10, "to_m": 90, "stand": what}])
    yield scene(slope=flat, uncertainty={"draws": str(path)})
    for more in ({}, {"column": column}, {"column": column, "only": "user=qroot"}, {"only": f"{column}=qroot"}):
        for kind in ("stops", "speed"):
            at = {} if kind == "stops" else {"x_m": 60}
            yield scene(slope=flat, observed={kind: {**table, **more, **at}})


def secret_words(text):
    """Return the secret words of a file: all beyond the first 20 characters of its first line."""
    first = text.split("\n", 1)[0][:20]
    words = "".join(c if c.isalnum() or c == "." else " " for c in text[len(first):]).split()
    return {word for word in words if len(word) > 3 and any(c in "qzQ47" for c in word) and word not in first}


def check_silent(name, done, own=""):
    """`own`: the scene's own words."""
    said, text = done.out + done.err, PRIVATE[name]
    expect(done.status != DONE, name, done)
    told = [word for word in secret_words(text) if word in said and word not in own]
    for line in text.splitlines():
        told += [run for run in (line[i:i + 21] for i in range(len(line) - 20)) if run in said and run not in own]
    expect(not told, f"{name}: told {told[:5]}", done)


def test_private_files():
    """As a scene, or referenced as slope, stand, base, draws or table of observations"""
    with Folder() as f:
        for name, text in PRIVATE.items():
            path = f.write(name, text)
            for mode in ("--check", "--batch"):
                check_silent(name, ceduo(mode, path))
            check_silent(name, ceduo("--check", "-", stdin=text.encode()))
            for what in scenes_naming(path):
                check_silent(name, ceduo("--check", f.write("s.yaml", what)), json.dumps(what))
            check_silent(name, ceduo("--check", "-s", f"slope={path}", f.write("s.yaml", scene())))


def test_private_elsewhere():
    """As a survey or a script"""
    with Folder() as f:
        for name, text in PRIVATE.items():
            path = f.write(name, text)
            script = f.write("script", text.lstrip("# only a comment\n"))  # this shows the beginning of its first command
            for words in (("--survey", path), ("--script", script, "paper-site")):
                check_silent(name, ceduo(*words), text.lstrip("# only a comment\n")[:20])


def test_first_characters():
    """Printed: the beginning of the first line, the reason for the rest missing, the place and the error"""
    with Folder() as f:
        path = f.write("passwd", PRIVATE["passwd"])
        done = ceduo("--check", f.write("s.yaml", scene(slope={"csv": str(path)})))
        told, line, caret = done.err.splitlines()
        expect_equal(told, f"{path}:1:1: the line of heads must name the columns 'distance' and 'elevation'")
        expect_equal((line, caret), (f"  {FIRST[:20]}… {WHY}", "  ^"))
        done = ceduo("--check", f.write("s.yaml", scene(uncertainty={"draws": str(path)})))
        expect_in(f"the column '{FIRST[:20]}' is not a value", done.err)
        path = f.write("long.yaml", "alpha: 1\nbeta: {gamma: 1, delta: 2, rest: 3}\nrock: 5\n")
        lines = ceduo("--check", path).err.splitlines()
        expect_equal(lines[:3], [f"{path}:1:1: unknown key", "  alpha: 1", "  ^"])
        expect_equal(lines[3:5], ["  and 1 more of this kind, on line 2", f"{path}:3:7: rock: expected a mapping, not a single value"])
        path = f.write("far.yaml", "name: [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, *a]\n")
        expect_equal(ceduo("--check", path).err, f"{path}:1:43: an alias, an anchor or a tag; write the value out without it\n  name: [1, 2, 3, 4, 5… {WHY}\n")
        path = f.path / "passwd"
        done = ceduo("--check", f.write("s.yaml", scene(observed={"stops": {"csv": str(path), "column": FIRST}})))
        expect_equal(done.err.splitlines()[0], f"{path}:2:1: '…' is not a number")
        for column in ("'plot'", "'kind', or columns 'shoots', 'standards', 'trees' with numbers of stems", "'dbh_cm' or 'circumference_cm'"):
            expect_in(f"{path}:1:1: the line of heads must name the column {column}\n", ceduo("--survey", path).err)
        expect_in(": 'ceduo' is missing: scene/1", ceduo("--check", f.write("keys.yaml", PRIVATE["keys.yaml"])).err)


def test_own_files_whole():
    """A file with a ceduo header is quoted fully, and so is a table with a known column"""
    wrong = " # " + "note " * 12
    with Folder() as f:
        for head in ("ceduo: stand/1", '"ceduo": "stand/1"', "# a wood\n\n'ceduo' :   stand/1", "ceduo: stand/2"):
            f.write("w.yaml", f"{head}\nname: wood\nspecies: oak{wrong}\ntrees: []\n")
            err = ceduo("--check", f.write("s.yaml", scene(forest=[{"from_m": 10, "to_m": 90, "stand": "w.yaml"}]))).err
            expect_in(f"  species: oak{wrong}".rstrip() + "\n", err.replace(" \n", "\n"))
            expect_in("^", err)
        f.write("p.csv", "distance,elevation,what\n0,64,top\n50,middle of the slope,here it is\n100,0,end\n")
        err = ceduo("--check", f.write("s.yaml", scene(slope="p.csv"))).err
        expect_in("p.csv:3:4: 'middle of the slope' is not a number\n  50,middle of the slope,here it is\n     ^", err)
        f.write("o.csv", "number,x_m,by whom and when\n1,somewhere below,me\n")
        for more in ({}, {"column": "by whom and when"}):
            err = ceduo("--check", f.write("s.yaml", scene(observed={"stops": {"csv": "o.csv", **more}}))).err
            expect_in("\n  1,somewhere below,me\n", err)
        f.write("d.csv", "slope.segments[0].rt,slope.segments[0].rn\n0.8,nothing that is a number\n")
        err = ceduo("--check", f.write("s.yaml", scene(uncertainty={"draws": "d.csv"}))).err
        expect_in("\n  0.8,nothing that is a number\n", err)


def test_without_a_word_still_good():
    """A slope or stand without a header, and a user's table, are read as before"""
    with Folder() as f:
        f.write("line.yaml", {"vertices_m": [[0, 64], [100, 0]], "segments": GROUND})
        f.write("wood.yaml", stand())
        f.write("mine.csv", "where it lies\n41\n52\n61\n")
        path = f.write("s.yaml", scene(slope="line.yaml", forest=[{"from_m": 10, "to_m": 90, "stand": "wood.yaml"}],
                                       observed={"stops": {"csv": "mine.csv", "of": 6}}))
        expect_equal(ceduo("--check", path).err, "")
        gap = [{"from_m": 0, "to_m": 40, "material": "talus"}, {"from_m": 50, "to_m": 100, "material": "cliff"}]
        f.write("line.yaml", {"vertices_m": [[0, 64], [100, 0]], "materials": gap})
        expect_in(": materials[1].from_m: … leaves a gap or an overlap; begin at …\n", ceduo("--check", path).err)
        f.write("line.yaml", {"vertices_m": [[0, 64], [100, 0]], "segments": 5})
        expect_in(": segments: expected a list, not a single value\n", ceduo("--check", path).err)


if __name__ == "__main__":
    run_all(__name__)
