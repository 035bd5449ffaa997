#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""--each: one scene changed by each row of a table; --columns; --resume."""
import csv
import io
import json
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import CEDUO, DONE, INPUT, OUTPUT, USAGE, Folder, ceduo, expect, expect_equal, expect_in, good, run_all, wooded_scene

SCENE = wooded_scene(controls=[{"x_m": "end-60", "accepted_kJ": 20}])
COLUMNS = "id,option,x_m,wooded.reach_probability"


def profile(length):
    return f"distance,elevation\n0,{0.8 * length}\n{length},0\n"


def valley(f, rows):
    f.write("s.yaml", SCENE)
    for length in (100, 110, 120):
        f.write(f"{length}.csv", profile(length))
    return f.write("rows.csv", rows)


def run(f, *words, **more):
    return ceduo("-b", "-q", "-n", 60, "--each", "rows.csv", *words, "s.yaml", cwd=f.path, **more)


def table(text):
    return list(csv.DictReader(io.StringIO(text)))


def test_rows():
    """Each row gives what --set with its cells gives; other columns are copied, quoted where they must be; empty cells change nothing"""
    with Folder() as f:
        valley(f, 'name,slope,rock.density_kg_m3,title,note\n"a, b",100.csv,2400,it\'s,"say ""x"""\nc,120.csv,,"=1",\n')
        rows = table(good("-b", "-n", 60, "-f", "csv", "--each", "rows.csv", "s.yaml", cwd=f.path).out)
        expect_equal([(r["row.name"], r["note"], r["title"]) for r in rows], [("a, b", 'say "x"', "it's"), ("c", "", "'=1")])
        expect("slope" not in rows[0] and "rock.density_kg_m3" not in rows[0], rows[0])
        for row, sets in zip(rows, (["slope=100.csv", "rock.density_kg_m3=2400", "title=\"it's\""], ["slope=120.csv", "title='=1'"])):
            words = [w for s in sets for w in ("-s", s)]
            alone = table(good("-b", "-n", 60, "-f", "csv", *words, "s.yaml", cwd=f.path).out)[0]
            expect_equal({k: row[k] for k in alone}, alone)
        lines = good("-b", "-n", 60, "-f", "json", "--each", "rows.csv", "s.yaml", cwd=f.path).out.splitlines()
        expect_equal([json.loads(line)["row"] for line in lines], [{"name": "a, b", "note": 'say "x"'}, {"name": "c", "note": None}])
        expect_equal(json.loads(lines[0])["options"][0]["controls"][0]["x_m"], 40)


def test_foreign_tables():
    """Semicolons with decimal commas, a byte order mark, CRLF, standard input: the same rows"""
    with Folder() as f:
        valley(f, "name,slope,release.x_m\na,100.csv,1.5\nb,110.csv,2\n")
        wanted = run(f, "-f", "csv").out
        f.write("rows.csv", "\ufeffname;slope;release.x_m\r\na;100.csv;1,5\r\n\r\nb;110.csv;2\r\n")
        expect_equal(run(f, "-f", "csv").out, wanted)
        note = "l\u2019et\u00e0 \u2013 5 \u20ac \u201csicuri\u201d"  # of Windows-1252 alone: Latin-1 has none of these but the letter
        f.write("rows.csv", f"name;slope;note\r\na;100.csv;{note}\r\n".encode("cp1252"))
        expect_equal(run(f, "-f", "json").json()[0]["row"], {"name": "a", "note": note})
        text = "name\tslope\trelease.x_m\na\t100.csv\t1.5\nb\t110.csv\t2\n"
        expect_equal(ceduo("-b", "-q", "-n", 60, "-f", "csv", "--each", "-", "s.yaml", cwd=f.path, stdin=text.encode()).out, wanted)


def test_bad_rows():
    """A bad row is named with its line, the others are computed, and at the end it is said how many failed"""
    with Folder() as f:
        valley(f, "name,slope,controls[0].accepted_kJ\na,100.csv,20\nb,none.csv,20\nc,110.csv,x\nd,110.csv,20,9\ne,120.csv\n")
        r = run(f, "-f", "csv", "--columns", "row.name")
        expect_equal((r.status, r.out), (INPUT, "row.name\na\ne\n"), str(r))
        for words in ("rows.csv:3: ", "none.csv", "rows.csv:4: ", "'x' is not a number", "rows.csv:5:", "3 of 5 failed: ",
                      "rows.csv:3 (b), rows.csv:4 (c), rows.csv:5"):
            expect_in(words, r.err)
        expect("end" not in r.err and "--set" not in r.err, r.err)
        r = ceduo("--check", "--each", "rows.csv", "s.yaml", cwd=f.path)
        expect_equal((r.status, "3 of 5 failed" in r.err), (INPUT, True), str(r))
        for text, words in (("", "empty"), ("a,a\n1,2\n", "'a' is given twice")):
            f.write("rows.csv", text)
            r = run(f, "-f", "csv")
            expect_equal((r.status, r.out), (INPUT, ""), str(r))
            expect_in(words, r.err)


def test_messages():
    """What is wrong with a cell is said of its line, once: what follows from a broken profile is not said"""
    with Folder() as f:
        valley(f, "the line as WKT,id,slope,rock.density_kg_m3\nLINESTRING (0 0; 0 90),a,none.csv,\n,b,one.csv,\n,c,bad.csv,\n,d,100.csv,heavy\n")
        f.write("one.csv", "distance,elevation\n0,50\n")
        f.write("bad.csv", "distance,elevation\n0,50\n9,x\n")
        r = run(f, "-f", "csv")
        lines = [line for line in r.err.splitlines() if not line.startswith(" ")]
        expect_equal([line.split(": ")[0] for line in lines],
                     ["rows.csv:2", "rows.csv:3", "rows.csv:4", "bad.csv:3:3", "rows.csv:5", "ceduo"], r.err)
        for line, words in zip(lines, ("'none.csv'", "two points", "not with it", "'x' is not", "rock.density_kg_m3: 'heavy' is not",
                                       "4 of 4 failed: rows.csv:2 (a), rows.csv:3 (b), rows.csv:4 (c), rows.csv:5 (d)")):
            expect_in(words, line)
        expect_equal(r.status, INPUT)


def test_columns():
    """--columns prints these, in their order, of any CSV; one that there is not is told with the nearest"""
    with Folder() as f:
        valley(f, "name,slope\na,100.csv\n")
        expect_equal(run(f, "-f", "csv", "--columns", "x_m,row.name,option").out, "x_m,row.name,option\n40,a,current\n")
        expect_equal(good("-b", "-n", 60, "-f", "csv", "--rows", "stands", "--columns", "from_m,name", "s.yaml", cwd=f.path).out.split("\n")[0],
                     "from_m,name")
        r = run(f, "-f", "csv", "--columns", "wooded.reach_probabilty")
        expect_equal(r.status, USAGE)
        expect_in("did you mean 'wooded.reach_probability'", r.err)
        for words in (["--columns", "name"], ["-f", "json", "--columns", "name"]):
            expect_equal(run(f, *words).status, USAGE, words)


def test_resume():
    """After a kill --resume computes what is missing, and the file is as that of one run, to the byte"""
    with Folder() as f:
        rows = "".join(f"r{i},{100 + i % 3 * 10}.csv\n" for i in range(40))
        valley(f, "id,slope\n" + rows)
        words = ["-f", "csv", "--columns", COLUMNS, "-o"]
        expect_equal(run(f, *words, "whole.csv").status, DONE)
        whole = (f.path / "whole.csv").read_bytes()
        program = subprocess.Popen([CEDUO, "-b", "-q", "-n", "60", "--each", "rows.csv", *words, "part.csv", "--resume", "s.yaml"],
                                   cwd=f.path)
        while program.poll() is None and (not (f.path / "part.csv").exists() or (f.path / "part.csv").stat().st_size < 200):
            time.sleep(0.001)
        program.send_signal(signal.SIGKILL)
        program.wait()
        for cut in (0, 5, 60):  # bytes that never came to the disk
            part = (f.path / "part.csv").read_bytes()
            (f.path / "part.csv").write_bytes(part[:len(part) - cut])
            r = run(f, *words, "part.csv", "--resume")
            expect_equal((r.status, (f.path / "part.csv").read_bytes()), (DONE, whole), str(r))
        f.write("rows.csv", "id,slope\na,100.csv\nb,110.csv\nc,120.csv\n")
        words = ["-f", "csv", "--columns", "option,x_m,id", "-o"]  # what says which row a line is of stands last
        expect_equal(run(f, *words, "last.csv").status, DONE)
        head, first, *others = (f.path / "last.csv").read_text().splitlines(keepends=True)
        kept = first.replace(",40,", ",999,")  # it shows that the row is not computed again
        (f.path / "last.csv").write_text(head + kept + "current,50,b\n")
        r = run(f, *words, "last.csv", "--resume")
        expect_equal((r.status, (f.path / "last.csv").read_text()), (DONE, head + kept + "".join(others)), str(r))
        for rows, output, more, status, words_of in (
                ("name,slope\na,100.csv\na,110.csv\n", "new.csv", [], INPUT, "cannot tell them apart"),
                ("slope\n100.csv\n", "new.csv", [], USAGE, "which row"),
                ("name,slope\na,100.csv\n", "s.yaml", [], OUTPUT, "read in this run"),
                ("name,slope\na,100.csv\n", "other.csv", [], OUTPUT, "other columns")):
            f.write("rows.csv", rows)
            f.write("other.csv", "name,option\na,b\n")
            r = run(f, "-f", "csv", "-o", output, "--resume", *more)
            expect_equal(r.status, status, str(r))
            expect_in(words_of, r.err)
        expect_equal((f.path / "other.csv").read_text(), "name,option\na,b\n")
        expect_equal(run(f, "--resume", "-f", "csv").status, USAGE)


def test_other_answers():
    """--find, --sensitivity and pages, too, are of each row"""
    with Folder() as f:
        valley(f, "name,slope\na,100.csv\nb,110.csv\n")
        words = ["--find", "forest[0].stand.stools.per_ha=500:3000", "--goal", "adc=9", "-f", "csv"]
        r = ceduo("-q", *words, "--each", "rows.csv", "--columns", "name,goal", "s.yaml", cwd=f.path)
        expect_equal(r.out, "name,goal\na,adc\nb,adc\n", str(r))
        page = run(f).out
        expect_equal({line for line in page.splitlines() if line.startswith("rows.csv:")}, {"rows.csv:2 \u00b7 a", "rows.csv:3 \u00b7 b"})
        expect_equal({line.split()[0] for line in page.split("\n\n")[0].splitlines()[2:]}, {"a", "b"}, "the table calls each as its row")


if __name__ == "__main__":
    run_all(__name__)
