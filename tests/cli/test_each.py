#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""--each: one scene changed by each row of a table; --columns. test_resume.py tests --resume."""
import csv
import io
import json
import re
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import (CEDUO, DONE, FULL, INPUT, SANITIZED, USAGE, Folder, ceduo, environment, expect, expect_equal, expect_in, good,
                     run_all, scene, wooded_scene)

SCENE = wooded_scene(controls=[{"x_m": "end-60", "accepted_kJ": 20}])


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
    """Each row equals --set with its cells; other columns are copied, quoted if necessary; empty cells change nothing"""
    with Folder() as f:
        valley(f, 'name,slope,rock.density_kg_m3,title,note\n"a, b",100.csv,2400,it\'s,"say ""x"""\nc,120.csv,,"=1",\n')
        rows = table(good("-b", "-q", "-n", 60, "-f", "csv", "--each", "rows.csv", "s.yaml", cwd=f.path).out)
        expect_equal([(r["row.name"], r["note"], r["title"]) for r in rows], [("a, b", 'say "x"', "it's"), ("c", "", "'=1")])
        expect("slope" not in rows[0] and "rock.density_kg_m3" not in rows[0], rows[0])
        for row, sets in zip(rows, (["slope=100.csv", "rock.density_kg_m3=2400", "title=\"it's\""], ["slope=120.csv", "title='=1'"])):
            words = [w for s in sets for w in ("-s", s)]
            alone = table(good("-b", "-n", 60, "-f", "csv", *words, "s.yaml", cwd=f.path).out)[0]
            expect_equal({k: row[k] for k in alone}, alone)
        lines = good("-b", "-q", "-n", 60, "-f", "json", "--each", "rows.csv", "s.yaml", cwd=f.path).out.splitlines()
        expect_equal([json.loads(line)["row"] for line in lines], [{"name": "a, b", "note": 'say "x"'}, {"name": "c", "note": None}])
        expect_equal(json.loads(lines[0])["options"][0]["controls"][0]["x_m"], 40)


def test_foreign_tables():
    """Semicolons with decimal commas, a byte order mark, CRLF, standard input give the same rows"""
    with Folder() as f:
        valley(f, "name,slope,release.x_m\na,100.csv,1.5\nb,110.csv,2\n")
        wanted = run(f, "-f", "csv").out
        f.write("rows.csv", "\ufeffname;slope;release.x_m\r\na;100.csv;1,5\r\n\r\nb;110.csv;2\r\n")
        expect_equal(run(f, "-f", "csv").out, wanted)
        text = "name\tslope\trelease.x_m\na\t100.csv\t1.5\nb\t110.csv\t2\n"
        expect_equal(ceduo("-b", "-q", "-n", 60, "-f", "csv", "--each", "-", "s.yaml", cwd=f.path, stdin=text.encode()).out, wanted)


def test_bad_rows():
    """A bad row is reported with its line, the others are computed, and the end reports the number of failures"""
    with Folder() as f:
        valley(f, "name,slope,controls[0].accepted_kJ\na,100.csv,20\nb,none.csv,20\nc,110.csv,x\nd,110.csv,20,9\ne,120.csv\nf,120.csv,\n")
        r = run(f, "-f", "csv", "--columns", "row.name")
        expect_equal((r.status, r.out), (INPUT, "row.name\na\nb\nc\nd\ne\nf\n"), str(r))
        for words in ("rows.csv:3: ", "none.csv", "rows.csv:4: ", "'x' is not a number", "rows.csv:5:14: more columns",
                      "rows.csv:6:3: too few columns: 2, the head has 3", "4 of 6 failed: ",
                      "rows.csv:3 (b), rows.csv:4 (c), rows.csv:5 (d), rows.csv:6 (e)"):
            expect_in(words, r.err)
        expect("end" not in r.err and "--set" not in r.err, r.err)
        r = ceduo("--check", "--each", "rows.csv", "s.yaml", cwd=f.path)
        expect_equal((r.status, "4 of 6 failed" in r.err), (INPUT, True), str(r))
        for text, words in (("", "empty"), ("a,a,rock.diameter_m\n1,2,1\n", "'a' is given twice"), ("slope,slope\n,\n", "'slope' is given twice"),
                            ("id,rock.diameter_m\n", "the table has no row"), ("id,rock.diameter_m\n,\n\n", "the table has no row"),
                            ("id,wkt\n1,2\n", "no column changes the scene"), ("id;x;y\n1;2;3\n", "no column changes the scene"),
                            ("'=a,=a,rock.diameter_m\n1,2,1\n", "given twice")):
            f.write("rows.csv", text)
            r = run(f, "-f", "csv")
            expect_equal((r.status, r.out), (INPUT, ""), str(r))
            expect_in(words, r.err)
        expect_equal(ceduo("--check", "--each", "rows.csv", "-", cwd=f.path).status, USAGE)


def test_failed_rows():
    """A failed row has a line, too: status, reason in English, class 5; in JSON an object of its own format"""
    reasons = {"a": "", "b": "csv: cannot find 'none.csv' next to this file or among the profiles (ceduo --list-profiles)",
               "c": "controls[0].accepted_kJ: 'x' is not a number", "d": "more columns than the first line has: 4 instead of 3; if commas "
               "stand for decimals, separate the columns by semicolons", "e": "too few columns: 2, the head has 3"}
    columns = ["name", "status", "reason", "verdict.class", "verdict.why", "version", "option", "x_m"]
    with Folder() as f:
        valley(f, "name,slope,controls[0].accepted_kJ\na,100.csv,20\nb,none.csv,20\nc,110.csv,x\nd,110.csv,20,9\ne,120.csv\n")
        for words in ([], ["--language", "it"]):
            r = run(f, "-f", "csv", "--columns", ",".join(columns).replace("name", "row.name"), *words)
            rows = table(r.out)
            expect_equal({row["row.name"]: row["reason"] for row in rows}, reasons)
        expect_equal([row["status"] for row in rows], ["ok"] + 4 * ["failed"])
        for row in rows[1:]:
            expect_equal((row["verdict.class"], row["verdict.why"], row["version"], row["option"]), ("5", "failed", rows[0]["version"], ""))
        expect_equal([row["status"] for row in table(run(f, "-f", "csv").out)], [row["status"] for row in rows], "without --columns")
        answers = run(f, "-f", "json").json()
        expect_equal([a["format"] for a in answers], ["ceduo-result-1"] + 4 * ["ceduo-failed-1"])
        expect_equal({a["row"]["name"]: a["reason"] for a in answers[1:]}, {k: v for k, v in reasons.items() if v})
        f.write("rows.csv", "name,rock.diameter_m\na,x\n")
        r = run(f, "-f", "csv", "-o", "new.csv", "--columns", "row.name,status")
        expect_equal((r.status, (f.path / "new.csv").read_text()), (INPUT, "row.name,status\na,failed\n"), "all failed")


def test_key():
    """--key names a row in messages; only this copied column is printed; an empty or repeated key fails the row"""
    with Folder() as f:
        valley(f, "wkt,id,slope,note\nPOINT(0 0),12e3,100.csv,x\nPOINT(0 1),7,none.csv,y\nPOINT(0 2),,110.csv,z\nPOINT(0 3),12e3,110.csv,z\n")
        r = run(f, "-f", "csv", "--key", "id")
        rows = table(r.out)
        expect_equal([row["id"] for row in rows], ["12e3", "7", "", "12e3"])
        expect_equal([row["status"] for row in rows], ["ok", "failed", "failed", "failed"])
        expect("wkt" not in rows[0] and "note" not in rows[0], list(rows[0]))
        for words in ("rows.csv:3 (7): ", "rows.csv:4:12: the key 'id' is empty", "rows.csv:5:1: the key '12e3' is also that of line 2",
                      "3 of 4 failed: rows.csv:3 (7), rows.csv:4, rows.csv:5 (12e3)"):
            expect_in(words, r.err)
        expect_equal(run(f, "-f", "csv", "--key", "id", "--columns", "note,id").out.splitlines()[:2], ["note,id", "x,12e3"])
        expect_equal([a["row"] for a in run(f, "-f", "json", "--key", "id").json()], [{"id": "12e3"}, {"id": 7}, {"id": None}, {"id": "12e3"}])
        expect_equal(table(run(f, "-f", "csv", "--key", "slope", "--columns", "slope,status").out)[0], {"slope": "100.csv", "status": "ok"})
        r = run(f, "-f", "csv", "--key", "ident")
        expect_equal((r.status, r.out), (INPUT, ""), str(r))
        expect_in("no column 'ident' for --key; the columns are: wkt, id, slope, note", r.err)
        expect_in("--key requires --each", ceduo("-b", "--key", "id", "s.yaml", cwd=f.path).err)


def test_renamed_columns():
    """--columns NAME=PATH renames a column; two columns of one name, and an empty name, are refused"""
    with Folder() as f:
        valley(f, "name,slope\na,100.csv\n")
        expect_equal(run(f, "-f", "csv", "--columns", "place=x_m,x_m,id=row.name").out, "place,x_m,id\n40,40,a\n")
        for columns, words in (("x_m,x_m", "two columns are called 'x_m'"), ("a=x_m,a=option", "two columns are called 'a'"),
                               ("=x_m", "'=x_m' has no name"), ("a=x", "no column 'x'"), ("", "no column ''")):
            r = run(f, "-f", "csv", "--columns", columns)
            expect_equal((r.status, r.out), (USAGE, ""), str(r))
            expect_in(words, r.err)


CLASSES = """what,controls[0].accepted_kJ,controls[0].x_m,release,forest[0].stand.stools.per_ha,forest[0].stand.shoots[0].per_ha,slope
exceeds,,,,,,
without-forest,9000,,,,,
forest,180,,,,,
impossible-stand,,,,,40000,
no-rock-moves,,,"{x_m: 0, vx_m_s: 0, vz_m_s: 0}",,,"{vertices_m: [[0, 50], [20, 51], [100, 0]], segments: SEGMENTS}"
not-reached,,190,,,,"{vertices_m: [[0, 50], [20, 40], [200, 40]], segments: SEGMENTS}"
contradicts-terrain,,70,,,,"{vertices_m: [[0, 90], [70, 30], [120, 0]], segments: [{rn: .05, rt: .05, friction: 1, roughness_rad: .2}]}"
failed,,,,9000,,
"""


def test_classes():
    """verdict.class is a number and verdict.why a word: where the ground holds the rocks is not where none moves"""
    wanted = {"exceeds": ("no", "4"), "without-forest": ("yes", "1"), "forest": ("yes", "2"), "impossible-stand": ("nothing", "3"), "no-rock-moves": ("nothing", "5"),
              "not-reached": ("nothing", "0"), "contradicts-terrain": ("nothing", "3"), "failed": ("", "5")}
    with Folder() as f:
        valley(f, CLASSES.replace("SEGMENTS", "[{rn: .3, rt: .8, roughness_rad: .1, friction: .5}]"))
        words = ["-b", "-q", "-n", 1000, "-f", "csv", "--each", "rows.csv"]
        names = "what,verdict.answer,verdict.class,verdict.why,bare.exceed_probability,wooded.exceed_probability"
        r = ceduo(*words, "--columns", names, "s.yaml", cwd=f.path)
        rows = {row["what"]: row for row in table(r.out)}
        expect_equal({what: (row["verdict.answer"], row["verdict.class"]) for what, row in rows.items()}, wanted, str(r))
        expect_equal([row["verdict.why"] for row in rows.values()], list(wanted))
        for row in ("no-rock-moves", "not-reached"):
            expect(re.search(rf"^rows.csv:\d+ \({row}\): .*cannot be assessed", ceduo(
                "--check", "-q", "--each", "rows.csv", "--key", "what", "s.yaml", cwd=f.path).err, re.M), row)
        expect(float(rows["forest"]["bare.exceed_probability"]) > 0.05 > float(rows["forest"]["wooded.exceed_probability"]), rows["forest"])
        f.write("rows.csv", "id,controls[0].accepted_kJ,simulation.contact_model\nno limit,.,\nindex,20,index\n")
        f.write("s.yaml", wooded_scene(controls=[{"x_m": 60}]))
        rows = table(run(f, "-f", "csv", "--columns", "id,verdict.class,verdict.why").out)
        expect_equal([tuple(row.values()) for row in rows], [("no limit", "", ""), ("index", "", "")])


def test_added_columns():
    """worst.* are those of the window, uncertainty.* are computed only if --columns names them"""
    names = "option,worst.year,worst.exceed,uncertainty.p5,uncertainty.p95,version,wooded.exceed_probability,verdict.answer,verdict.class"
    words = ["-b", "-n", 100, "--option", "selection coppice", "--option", "simple coppice, just cut"]
    rows = table(good(*words, "-f", "csv", "--columns", names, "four-systems").out)
    answer = good(*words, "-f", "json", "four-systems").json()[0]
    for row, option in zip(rows, answer["options"]):
        expect_equal((row["option"], int(row["worst.year"]), float(row["worst.exceed"]), row["version"]),
                     (option["name"], option["window"]["worst_year"], option["window"]["worst"], answer["version"]))
        lo, hi, share = (float(row[k]) for k in ("uncertainty.p5", "uncertainty.p95", "wooded.exceed_probability"))
        expect(0 <= lo <= share <= hi <= 1, row)
    plain = table(good(*words, "-f", "csv", "four-systems").out)
    expect_equal({row["uncertainty.p5"] for row in plain}, {""})


def test_run():
    """The column run changes with all that changes figures, and with nothing else"""
    with Folder() as f:
        valley(f, "id,slope,rock.diameter_m\na,100.csv,1\nb,100.csv,1\nc,110.csv,1\nd,100.csv,1.1\ne,none.csv,1\n")

        def runs(*words, rocks=60):
            r = ceduo("-b", "-q", "-n", rocks, "-f", "csv", "--each", "rows.csv", "--columns", "run", *words, "s.yaml", cwd=f.path)
            return r.out.splitlines()[1:]
        first = runs()
        expect_equal((len(first), len(set(first)), first[0]), (5, 4, first[1]))
        expect_equal({len(run) for run in first}, {16})
        for words in (["-j", "1"], ["--language", "it"]):
            expect_equal(runs(*words), first)
        for words in (["--seed", "7"], ["-s", "release.vx_m_s=1"], ["--option", "current"], ["--years"]):
            expect(not set(runs(*words)) & set(first), words)
        expect(not set(runs(rocks=61)) & set(first), "rocks")
        f.write("100.csv", profile(101))
        expect_equal([a == b for a, b in zip(runs(), first)], [False, False, True, False, True])
        f.write("s.yaml", (f.path / "s.yaml").read_text() + "\n")
        expect(not set(runs()) & set(first), "the scene")


def test_messages():
    """An error in a cell is reported once, with its line; consequences of a broken profile are not reported"""
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
    """--columns prints these columns, in order, for any CSV; an unknown one is reported with the nearest"""
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


def run_alone(f, *sets):
    """Return the CSV row of a scene changed by -s."""
    return table(good("-b", "-n", 60, "-f", "csv", *[w for s in sets for w in ("-s", s)], "s.yaml", cwd=f.path).out)[0]


def expect_rows(f, text, wanted):
    """Expect a table to give rows of (copied cells, changes): each equals -s."""
    f.write("rows.csv", text)
    r = run(f, "-f", "csv")
    expect_equal(r.status, DONE, str(r))
    rows = table(r.out)
    expect_equal(len(rows), len(wanted), str(r))
    for row, (cells, sets) in zip(rows, wanted):
        expect_equal({k: row[k] for k in cells}, cells, text)
        single = run_alone(f, *sets)
        expect_equal({k: row[k] for k in single}, single, text)


def test_quotes():
    """Quotes follow RFC 4180: line breaks, doubled quotes; a quote inside a cell is a character; line numbers are right"""
    with Folder() as f:
        valley(f, "")
        two, one = ["rock.diameter_m=2"], ["rock.diameter_m=1.2"]
        for text, notes in (('id,note,rock.diameter_m\na,"one\ntwo",2\nb,x,1.2\n', ["one\\x0atwo", "x"]),
                            ('id,note,rock.diameter_m\na,6" step,2\nb,x,1.2\n', ['6" step', "x"]),
                            ('id,note,rock.diameter_m\na,"6"" step",2\nb,"",1.2\n', ['6" step', ""]),
                            ('id,note,rock.diameter_m\r\n"a","x, y; z",2\r\nb,"""",1.2\r\n', ["x, y; z", '"']),
                            ('id,"note","rock.diameter_m"\na,"\n\n",2\nb,a"b"c,"1.2"', ["\\x0a\\x0a", 'a"b"c']),
                            ('note,id,rock.diameter_m\n"1\n2\n3",a,2\n"",b,1.2\n', ["1\\x0a2\\x0a3", ""])):
            expect_rows(f, text, [({"id": "a", "note": notes[0]}, two), ({"id": "b", "note": notes[1]}, one)])
        f.write("rows.csv", 'id,note,rock.diameter_m\na,"one\ntwo",2\nb,"\n\n",x\nc,,\nd,"x"y,1\ne,"open,1\n')
        r = run(f, "-f", "csv", "--columns", "id")
        expect_equal((r.status, r.out), (INPUT, "id\na\nb\nc\nd\ne\n"), str(r))
        for words in ("rows.csv:4: rock.diameter_m: 'x' is not", "rows.csv:8:6: text after a closing quote", "rows.csv:9:3: this quote is not closed",
                      "3 of 5 failed"):
            expect_in(words, r.err)


def test_identifiers():
    """In JSON a copied cell is a number only if it prints as the same text; the answer matches --schema"""
    numbers = {"1": 1, "0": 0, "-3": -3, "0.5": 0.5, "1.25": 1.25, "100": 100, "9007199254740992": 2**53, "1e-09": 1e-9, "-0.1": -0.1}
    texts = ["007", "1.10", "12345678901234567890", "0123", "1e5", "9007199254740993", "+5", "2E3", "0.1000000000000000055", "1e400", ".5",
             "1_000", "0x10", "NaN", "Infinity", "true", "null", "false", "1.0", "1.", "-0.50", "1,5", "1e-9", "--1", "1 000", "\u0661"]
    with Folder() as f:
        valley(f, "")
        cells = [*numbers, *texts, ""]
        f.write("rows.csv", "code;rock.diameter_m\n" + "".join(f"{c};0.9\n" for c in cells))
        rows = run(f, "-f", "json").json()
        expect_equal([(r["row"]["code"], type(r["row"]["code"])) for r in rows],
                     [(w, type(w)) for w in [*numbers.values(), *texts, None]])
        f.write("rows.csv", 'code,rock.diameter_m\n"say ""x"" \t",0.9\n')
        for words in (["--find", "forest[0].stand.stools.per_ha=500:3000", "--goal", "adc=9"], ["--sensitivity=2"], []):
            row = ceduo("-b", "-q", "-n", 60, *words, "-f", "json", "--each", "rows.csv", "s.yaml", cwd=f.path).json()[0]["row"]
            expect_equal(row, {"code": 'say "x"'})
    for name, has in (("result", True), ("find", True), ("sensitivity", True), ("calibration", False)):
        properties = json.loads(good("--schema", name).out)["properties"]
        expect_equal("row" in properties, has, name)
        expect(not has or properties["row"]["additionalProperties"]["type"] == ["number", "string", "null"], properties.get("row"))


def test_heads():
    """A head with a mistyped path is refused with the nearest path; other names are copied; both are announced"""
    with Folder() as f:
        valley(f, "")
        for head, meant in (("rock.diametr_m", "rock.diameter_m"), ("diameter_m", "rock.diameter_m"), ("Diameter_M", "rock.diameter_m"),
                            ("rock_diameter_m", "rock.diameter_m"), ("slop", "slope"), ("Slope", "slope"), ("titel", "title"),
                            ("per_ha", "forest[0].stand.stools.per_ha"), ("density_kg_m3", "rock.density_kg_m3"), ("rn", "slope.segments[0].rn"),
                            ("forest[A].stand.trees[oak].dbm_m", "forest[A].stand.trees[oak].dbh_m"), ("rocks", "simulation.rocks"),
                            ("controls[0].acepted_kJ", "controls[0].accepted_kJ"), ("controls[0]accepted_kJ", "controls[0].accepted_kJ"),
                            ("stand", "forest[0].stand"), ("slope.segmnts[2].rt", "slope.segments[2].rt"), ("controls_n", "controls_m")):
            f.write("rows.csv", f"id,{head},rock.mass_kg\n1,2,3\n")
            for words in (["-f", "csv"], ["-f", "json"], ["--plot", "energy"]):
                r = run(f, *words)
                expect_equal((r.status, r.out), (INPUT, ""), str(r))
                expect(r.err.startswith(f"rows.csv:1:4: '{head}' is not a path of --set; write '{meant}' to set it"), r.err)
        for head in ("len [m]", "Nr.", "row.scene", "rock.diameter_m.sd", "rock.axes_m[x]", "rock[0].diameter_m", "controls.x_m", "a.b", "rock.", ".rock",
                     "rock[0"):
            f.write("rows.csv", f"id,{head},rock.mass_kg\n1,2,3\n")
            r = run(f, "-f", "csv")
            expect_equal((r.status, r.out), (INPUT, ""), str(r))
            expect_in(f"rows.csv:1:4: '{head}' is not a path of --set", r.err)
        copied = ["id", "name", "note", "wkt", "x", "y", "year", "date", "option", "count", "n", "mean", "age", "plot", "dbh", "layer", "base", "scene"]
        f.write("rows.csv", ",".join(copied) + ",rock.density_kg_m3,slope,forest[0].stand.trees[0].per_ha,rock.diameter_m.mean,slope.vertices_m[0][1]\n"
                + "1," * len(copied) + "2500,,,,\n")
        r = ceduo("-b", "-n", 60, "-f", "csv", "--each", "rows.csv", "s.yaml", cwd=f.path)
        expect_equal((r.status, r.err), (DONE, "rows.csv: columns that are set: rock.density_kg_m3, slope, forest[0].stand.trees[0].per_ha, "
                                         "rock.diameter_m.mean, slope.vertices_m[0][1]; copied: " + ", ".join(copied[:10]) + " and 8 more\n"))
        head = r.out.split("\n")[0].split(",")
        expect_equal(len(head), len(set(head)), "names of columns")
        expect_equal((head.count("scene"), head.count("row.scene")), (1, 1))
        expect_equal(run(f, "-f", "csv").err, "", "-q")
        f.write("rows.csv", "rock.density_kg_m3\n2500\n")
        r = ceduo("--check", "--each", "-", "s.yaml", cwd=f.path, stdin=(f.path / "rows.csv").read_bytes())
        expect_equal((r.status, r.err), (DONE, "standard input: columns that are set: rock.density_kg_m3; copied: none\n"))


def test_text_of_files():
    """sep=, CR, tabs, UTF-16 and Windows-1252 are read; NUL, broken UTF-8 and UTF-16 are refused, and nothing is computed"""
    with Folder() as f:
        valley(f, "")
        wanted = [({"id": "a", "note": "Höhe"}, ["rock.diameter_m=1.5"]), ({"id": "b", "note": "–"}, ["rock.diameter_m=2"])]
        plain = "id;note;rock.diameter_m\na;Höhe;1,5\nb;–;2\n"
        for text in (plain.encode(), ("sep=;\n" + plain).encode(), plain.replace("\n", "\r").encode(), plain.replace(";", "\t").encode(),
                     plain.replace("\n", "\r\n").encode("utf-16"), plain.encode("utf-16-le"), plain.encode("cp1252"),
                     b"\xef\xbb\xbfsep=\t\r\n" + plain.replace(";", "\t").replace("\n", "\r\n").encode()):
            expect_rows(f, text, wanted)
        for text, words in ((plain.encode().replace(b"a;", b"a\0;"), "rows.csv: a NUL byte (U+0000) on line 2"), (plain.encode() + b"\xc3;;1\n", "broken UTF-8"),
                            (plain.encode("utf-16")[:-1], "broken UTF-16"), (plain.encode("utf-16") + b"\x00\xd8;\0", "broken UTF-16")):
            f.write("rows.csv", text)
            r = run(f, "-f", "csv")
            expect_equal((r.status, r.out), (INPUT, ""), str(r))
            expect_in(words, r.err)


def test_numbers():
    """Numbers follow the table's one convention: ambiguous ones are refused by line; empty words set nothing; YAML stays"""
    with Folder() as f:
        valley(f, "")
        for text, wanted in (("id;rock.density_kg_m3;controls[0].accepted_kJ\na;2.600;12,5\nb;1.800,5;NA\nc;-;n.d.\n",
                              [["rock.density_kg_m3=2600", "controls[0].accepted_kJ=12.5"], ["rock.density_kg_m3=1800.5"], []]),
                             ("id,rock.density_kg_m3,controls[0].x_m\na,2.600e3,end-60\nb,NULL,40.5\n",
                              [["rock.density_kg_m3=2600", "controls[0].x_m=end-60"], ["controls[0].x_m=40.5"]]),
                             ('id,rock.diameter_m,simulation.rocks\na,"{mean: 1, spread: .2}",77\nb,.75,\n',
                              [["rock.diameter_m={mean: 1, spread: .2}", "simulation.rocks=77"], ["rock.diameter_m=.75"]]),
                             ('id;rock;controls\na;{shape: sphere, diameter_m: 1.5};[{x_m: 30}]\n',
                              [["rock={shape: sphere, diameter_m: 1.5}", "controls=[{x_m: 30}]"]]),
                             ('id|slope|title\na|{csv: 110.csv}|{x}\nb|120.csv|it\'s: #1\n',
                              [["slope={csv: 110.csv}", "title='{x}'"], ["slope=120.csv", "title='it''s: #1'"]])):
            expect_rows(f, text, [({"id": "abc"[i]}, sets) for i, sets in enumerate(wanted)])
        for text, words, good_row in (("id;rock.density_kg_m3\na;2.600\nb;2600\n", "rows.csv:2:3: '2.600' can be read in two ways", "b"),
                                      ("id;rock.density_kg_m3\na;2600,5\nb;1800.5\n", "rows.csv:3:3: the decimal sign of '1800.5'", "a"),
                                      ("id,rock.density_kg_m3\na,2600\nb,26 00\n", "rows.csv:3:3: '26 00': two numbers", "a")):
            f.write("rows.csv", text)
            r = run(f, "-f", "csv", "--columns", "id,status")
            states = "".join(f"{row},{'ok' if row == good_row else 'failed'}\n" for row in "ab")
            expect_equal((r.status, r.out), (INPUT, "id,status\n" + states), str(r))
            expect_in(words, r.err)


def limited(f, kilobytes, *words):
    """Run with a memory limit: return status, output, standard error."""
    limit = "" if SANITIZED else f"ulimit -v {kilobytes}; "
    done = subprocess.run(["sh", "-c", limit + 'exec "$0" "$@"', CEDUO, "-b", "-q", "-j", "1", "-n", "1", *words, "s.yaml"], cwd=f.path,
                          env=environment(), capture_output=True, text=True, check=False)
    return done.returncode, done.stdout, done.stderr


def test_large_tables():
    """30 000 heads and 100 000 rows are read in constant memory, also to a file"""
    rows, good_rows = 100000, 100000 if FULL else 4000
    with Folder() as f:
        f.write("s.yaml", scene())
        f.write("few.csv", "id,rock.diameter_m\n" + "r,1\n" * 10)
        most = next(m for m in range(16000, 512000, 4000) if limited(f, m, "-f", "csv", "--each", "few.csv")[0] == DONE) + 24000
        heads = [f"c{i}" for i in range(30000)]
        f.write("wide.csv", ",".join([*heads, "rock.diameter_m"]) + "\n" + ",".join([*heads, "1"]) + "\n")
        for words in (["-f", "csv"], ["-f", "json"], ["-f", "csv", "-o", "new.csv"]):
            status, out, err = limited(f, most, *words, "--each", "wide.csv")
            expect_equal((status, err), (DONE, ""))
            out = out or (f.path / "new.csv").read_text()
            found = json.loads(out)["row"] if "json" in words else table(out)[0]
            expect_equal([found[h] for h in heads], heads)
        r = ceduo("-b", "-q", "-n", 1, "-f", "csv", "--columns", "c29999,x_m,c0", "--each", "wide.csv", "s.yaml", cwd=f.path)
        expect_equal(r.out, "c29999,x_m,c0\nc29999,75,c0\n")
        (f.path / "new.csv").unlink()
        f.write("rows.csv", "id,note,rock.diameter_m\n" + "".join(
            f'r{i},"a ""{i}"" b{200 * "."}",{0.5 + i % 100 / 100}\n' if i * good_rows // rows != (i - 1) * good_rows // rows
            else f"r{i},{200 * '.'}\n" for i in range(rows)))
        most += (f.path / "rows.csv").stat().st_size // 1024 - 12000
        for words in (["-f", "csv"], ["-f", "json", "-o", "new.json"], ["-f", "csv", "--columns", "id", "-o", "new.csv", "--resume"]):
            status, out, err = limited(f, most, *words, "--each", "rows.csv")
            expect_equal(status, DONE if FULL else INPUT, err)
            out = out or (f.path / words[words.index("-o") + 1]).read_text()
            expect_equal(len(out.splitlines()), rows + ("csv" in words))
            expect(FULL or f"{rows - good_rows} of {rows} failed: " in err, err)


def test_other_answers():
    """--find, --sensitivity and pages work for each row, too"""
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
