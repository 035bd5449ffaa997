#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Slopes in CSV: equal forms, and the places of errors."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import Folder, Suite, expect, expect_equal, expect_in, good, result, scene, list_tests
from inputs import check, expect_places


def slope_numbers(folder, content):
    folder.write("line.csv", content)
    run = result(folder.write("s.yaml", scene(slope={"csv": "line.csv", "segments": [{"rn": 0.3, "rt": 0.8}]})))
    return run["options"][0]["controls"]


def test_csv_good():
    """QGIS' header, semicolons, tabs, quotes, extra columns, CRLF, BOM, blank lines give one slope"""
    with Folder() as f:
        plain = "distance,elevation\n0,64\n50,30\n100,0\n"
        wanted = slope_numbers(f, plain)
        for text in (plain.replace(",", ";"), plain.replace(",", "\t"), plain.replace("\n", "\r\n"), "\ufeff" + plain,
                     plain.rstrip("\n"), plain + "\n\n", plain + ",\n", plain.upper(), "x,z\n0,64\n50,30\n100,0\n",
                     "fid,elevation,note,distance\n1,64,a,0\n2,30,\"b\",50\n3,0,c,100\n",
                     '"distance","elevation"\n"0","64"\n"50","30"\n"100","0"\n', plain.replace("50,", " 50 , "),
                     "distance,elevation\n0,6.4e1\n5e1,30.0\n+100,0\n", "distance,elevation,\n0,64,\n50,30,\n100,0,\n"):
            expect_equal(slope_numbers(f, text), wanted, repr(text))
        many = "distance,elevation\n" + "".join(f"{x / 1024},{64 - x / 1600}\n" for x in range(0, 102401))
        slope_numbers(f, many)


def test_csv_of_spreadsheets():
    """CSV of an Italian or German spreadsheet: semicolons, decimal commas, words of the language; the page reports it"""
    with Folder() as f:
        wanted = slope_numbers(f, "distance,elevation\n0,64.5\n50.25,30\n100,0.75\n")
        rows = "0;64,5\n50,25;30\n100;0,75\n"
        for head, body in (("distance;elevation", rows), ("Distanza;Quota", rows), ("Entfernung;H\u00f6he", rows),
                           ("distance;elevation", rows.replace("\n", "\r\n")), ("distance\televation", rows.replace(";", "\t")),
                           ("distance;elevation", '"0";"64,5"\n"50,25";"30"\n"100";"0,75"\n')):
            expect_equal(slope_numbers(f, f"{head}\n{body}"), wanted, head)
        page = good("-b", "--details", "-n", 1, "s.yaml", cwd=f.path).out
        expect_in("line.csv: 3 points, 100 m long, falls 63.75 m; columns distance, elevation; decimal commas", " ".join(page.split()))
        slope_numbers(f, "distance;elevation\n0;64.5\n50.25;30\n100;0.75\n")
        expect("decimal commas" not in good("-b", "--details", "-n", 1, "s.yaml", cwd=f.path).out, "dots are usual")


def test_csv_of_offices():
    """Heads with units, a title above them, UTF-16 and Windows-1252, and a line on the map give the same slope"""
    with Folder() as f:
        plain = "distance,elevation\n0,64.5\n50,30\n100,0.75\n"
        wanted = slope_numbers(f, plain)
        italian = "Progressiva (m);Quota (m s.l.m.)\r\n0;64,5\r\n50;30\r\n100;0,75\r\n"
        for text in (plain.replace("distance,elevation", "Distance (m),Elevation (m)"), italian,
                     "Profilo A della parete;\n;\n" + italian, italian.encode("utf-16"), italian.encode("utf-16-be"),
                     ("\ufeff" + italian).encode("utf-16-be"), ("\u00fever\n" + italian).encode("cp1252"),
                     ("Profilo d\u2019asse \u2013 et\u00e0 1950;\n" + italian).encode("cp1252"),
                     "Entfernung [m];H\u00d6HE (m)\n0;64,5\n50;30\n100;0,75\n".encode("cp1252"),
                     "X,Y,Z\n0,0,64.5\n30,40,30\n60,80,0.75\n", "id,Est (m),Nord (m),Quota (m)\na,700000,4800000,64.5\n"
                     "b,699970,4799960,30\nc,699940,4799920,0.75\n"):
            expect_equal(slope_numbers(f, text), wanted, repr(text))


OTHER = [  # files and column names of a GPS or a drawing program
    ('<?xml version="1.0"?>\n<gpx version="1.1"><trk><trkseg><trkpt lat="43" lon="12"/></trkseg></trk></gpx>\n', "GPX is not a profile"),
    ('<?xml version="1.0"?>\n<LandXML version="1.2"/>\n', "LandXML is not a profile"), ("<a/>\n", "XML is not a profile"),
    ("x,y,z\n12.1,43.1,300\n12.1001,43.1,200\n", "x and y must be in metres, not in degrees"),
    ("x,y,z\n1,1,300\n1,1,200\n", "all points lie at the same distance"),
    ("\ufeffdistance;elevation\n\udc00;1\n".encode("utf-16-le", "surrogatepass"), "broken UTF-16"),
    ("x,y,z\n12.1,43.1,300\n12.1001,-,250\n12.1002,43.1,200\n", "'-' is not a number"),
    ("N\0te\ndistance,elevation\n0,9\n50,1\n", "NUL byte"),
    ("N\u00f6te, t\u00eete\n".encode() + b"distance,elevation\n0,9\n50,1\n\xff\n", "broken UTF-8"),
    (b"N\x81te\ndistance,elevation\n0,9\n50,1\n", "neither UTF-8 nor Windows-1252"),
    ("SQLite format 3\0", "GeoPackage"),
]


def test_no_table():
    """A file that is not a table is refused with the clicks that make one; degrees are reported"""
    with Folder() as f:
        for content, words in OTHER:
            for name in ("line.csv", "line.gpx", "line.XML"):
                f.write(name, content)
                f.write("s.yaml", f"ceduo: scene/1\nrock: {{diameter_m: 0.5}}\nslope: {name}\ncontrols_m: [75]\n")
                done = check(f, "s.yaml")
                expect_in(words, done.err, content)
                expect_equal("degrees" in done.err, "degrees" in words, done.err)
                expect_equal(done.status, 3)
                expect("is not a profile" not in words or "Elevation Profile" in done.err, done.err)


CSV_CASES = [
    # (content, place, words)
    ("", None, "is empty"), ("distance,depth\n0,1\n", (1, None), "'distance' and 'elevation'"),
    ("a,64\n100,0\n", (1, None), "'distance' and 'elevation'"), ("sep=", (1, None), "'distance' and 'elevation'"), ("\n\n", (1, None), "'distance' and 'elevation'"),
    ("distance,elevation\n", None, "two points"), ("distance,elevation\n0,64\n", None, "two points"),
    ("distance,elevation\n0,64\n50,\n100,0\n", (3, 4), "missing"), ("distance,elevation\n0,64\n,30\n100,0\n", (3, 1), "missing"),
    ("distance,elevation\n0,64\n50\n100,0\n", (3, None), "too few"), ("elevation,distance\n64,0\n30\n0,100\n", (3, None), "too few"),
    ("x,z,y\n0,64,0\n30,30\n60,0,80\n", (3, None), "too few"), ("x,y,z\n0,0,64\n30,b,30\n60,80,0\n", (3, 4), "'b' is not a number"),
    ("distance;elevation\n0;64.5\n50;1.030,5\n100;0\n", (3, 4), "is not the dot of line 2"),
    ("distance;elevation\n0;64,5\n50.5;30\n100;0\n", (3, 1), "is not the comma of line 2"),
    ("distance;elevation\n0;64.5\n50,5;30\n100;0\n", (3, 1), "is not the dot of line 2"),
    ("distance,elevation\n0,64\n50,30\n40,0\n", (4, 1), "40 follows 50"),
    ("distance,elevation\n0,64\n50,30\n50,64\n45,20\n", (5, 1), "must rise"),
    ("distance,elevation\n0,64\n50,abc\n100,0\n", (3, 4), "'abc' is not a number"),
    ("distance,elevation\n0,64\n50,nan\n100,0\n", (3, 4), "'nan' is not a height"),
    ("distance,elevation\n0,64\n50,NULL\n100,0\n", (3, 4), "'NULL' is not a height"),
    ("distance,elevation\n0,64\n50,-\n100,0\n", (3, 4), "'-' is not a height"),
    ("distance,elevation\n0,64\n50,1e999\n100,0\n", (3, 4), "marks missing data"),
    ("distance,elevation\n0,64\n50,1e10\n100,0\n", (3, 4), "is outside the range"),
    ("distance,elevation\n0,64\n50,-9999999999\n100,0\n", (3, 4), "is outside the range"),
    ("distance,elevation\n0,64\n50,0x10\n100,0\n", (3, 4), "'0x10' is not a number"),
    ("distance,elevation\n0,64\n50,\x1b[31m\n100,0\n", (3, 4), "the number contains the invisible character U+001B"),
    ("distance,elevation\n0,64\n50,\x00\n100,0\n", None, "NUL byte (U+0000) on line 3"),
    ("distance,elevation\n0,64\n50," + "9" * 1000 + "\n100,0\n", (3, 4), ""),
    ("distance,elevation,distance\n0,64,1\n50,30,2\n100,0,3\n", (1, None), "distance"),
]


def csv_refused(content, place, words):
    with Folder() as f:
        f.write("line.csv", content)
        f.write("s.yaml", "ceduo: scene/1\nrock: {diameter_m: 0.5}\nslope: line.csv\ncontrols_m: [75]\n")
        done = check(f, "s.yaml")
        problems = expect_places(done.err, {"line.csv": content})
        expect_in(words, done.err)
        if place:
            mine = [p for p in problems if p[0] and p[0].endswith("line.csv") and p[1] == place[0] and
                    place[1] in (None, p[2])]
            expect(mine, f"no problem at line.csv:{place[0]}:{place[1]}", done)
        expect("line.csv" in done.err, "the file is not named", done)


def test_csv_and_vertices():
    """csv and vertices_m together are refused"""
    with Folder() as f:
        f.write("line.csv", "distance,elevation\n0,64\n100,0\n")
        f.write("s.yaml", scene(slope={"csv": "line.csv", "vertices_m": [[0, 64], [100, 0]], "segments": [{"rn": 0.3, "rt": 0.8}]}))
        expect_in("keep one", check(f, "s.yaml").err)


def main():
    suite = Suite()
    suite.run(list_tests(sys.modules[__name__]))
    for content, place, words in CSV_CASES:
        suite.check(f"CSV {ascii(content[-40:])}: {words or 'refused'}", csv_refused, content, place, words)
    suite.end()


if __name__ == "__main__":
    main()
