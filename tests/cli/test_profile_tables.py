#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Profiles as offices, GIS and instruments write them: read correctly, or refused with a working remedy."""
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import DONE, INPUT, Folder, ceduo, expect, expect_equal, expect_in, result, run_all, scene

SHEETS = Path(__file__).resolve().parent / "cases/profiles"
POINTS = [[0, 412.5], [12.5, 398.2], [40, 371], [75.25, 345.9], [118, 330.1], [160, 326]]
HIGHER = [[x, z + 1000] for x, z in POINTS]
GROUND = {"segments": [{"rn": 0.3, "rt": 0.8}]}


def runs(f, slope):
    """Return the results on a slope: the figures of its control, and the stops of rocks"""
    return result("-n", 200, f.write("s.yaml", scene(slope={**slope, **GROUND}, controls=[{"x_m": 84}])))["options"][0]["controls"]


def expect_same(found, wanted, what):
    """Expect equal figures within the rounding of coordinates"""
    if isinstance(wanted, dict):
        expect_equal(sorted(found), sorted(wanted), what)
    if isinstance(wanted, (dict, list)):
        for key in wanted if isinstance(wanted, dict) else range(len(wanted)):
            expect_same(found[key], wanted[key], f"{what}.{key}")
    elif isinstance(wanted, float) and isinstance(found, float):
        expect(abs(found - wanted) <= 1e-6 * (1 + abs(wanted)), f"{what}: {found}, wanted {wanted}")
    else:
        expect_equal(found, wanted, what)


def check(f, slope):
    return ceduo("--check", f.write("s.yaml", scene(slope={**slope, **GROUND}, controls=[{"x_m": 84}])))


def expect_read(f, name, content, vertices, words=(), **slope):
    f.write(name, content)
    done = check(f, {"csv": name, **slope})
    expect_equal(done.status, DONE, f"{name}: {done.err}")
    for word in words:
        expect_in(word, done.out, name)
    upward = {"reversed": slope["reversed"]} if "reversed" in slope else {}
    expect_same(runs(f, {"csv": name, **slope}), runs(f, {"vertices_m": vertices, **upward}), name)


def expect_refused(f, name, content, words, **slope):
    f.write(name, content)
    done = check(f, {"csv": name, **slope})
    expect_equal((done.status, done.out), (INPUT, ""), f"{name}: {done.out}{done.err}")
    for word in words:
        expect_in(word, done.err, name)


READ = [  # (file, vertices, words of the understanding, keys of the slope)
    ("qgis-profile.csv", POINTS, ["6 points, 160 m long, falls 86.5 m; columns distance, elevation"], {}),
    ("qgis-two-layers.csv", POINTS, ["line 'dtm_1m' of 2"], {"layer": "dtm_1m"}),
    ("excel-italian.csv", POINTS, ["columns Distanza progressiva (m), Quota terreno (m s.l.m.); decimal commas; not used: Punto, Note"], {}),
    ("excel-german-thousands.csv", HIGHER, ["falls 86.5 m", "decimal commas"], {}),
    ("swiss.csv", HIGHER, ["falls 86.5 m"], {}),
    ("excel-unicode.txt", POINTS, ["columns Chainage (m), Altitude (m a.s.l.); decimal commas; not used: Remark"], {}),
    ("grass-r-profile.txt", POINTS, ["no head: taken as distance and elevation"], {}),
    ("grass-r-profile-g.txt", POINTS, ["6 points, 160 m long"], {}),
    ("gmt-two-lines.txt", POINTS, ["line 'right line' of 2"], {"layer": "right line"}),
    ("wkt.csv", POINTS, ["6 points, 160 m long, falls 86.5 m"], {}),
    ("gps-utm.csv", POINTS, ["columns Est (m), Nord (m), Quota (m); decimal commas; not used: Nome, Precisione"], {}),
    ("r-write-csv.csv", POINTS, ["6 points"], {}),
    ("old-form.csv", [[x, z - 500] for x, z in POINTS], ["6 points"], {}),
    ("word-table.txt", POINTS, ["not used: Ground"], {}),
    ("total-station.csv", [[0, 412.5], [12.5, 398.2], [12.51, 369.5], [13.5, 368.5], [40, 351], [160, 326]],
     ["1 repeated point dropped", "1 vertical step, at 12.5 m, made a wall", "1 overhang, at 12.5 m, replaced by its outer envelope"], {}),
    ("drawn-upward.csv", [[0, 326], [42, 330.1], [84.74, 345.9], [84.75, 371], [120, 398.2], [132.5, 412.5]],
     ["rises 86.5 m", "1 vertical step, at 84.75 m, made a wall"], {"reversed": True}),
]


def test_sheets():
    """Sheets of offices: QGIS, Excel in three countries, GRASS, GMT, R, a GPS, a total station, an old form"""
    with Folder() as f:
        for name, vertices, words, slope in READ:
            expect_read(f, name, (SHEETS / name).read_bytes(), vertices, words, **slope)


def expected_points(name, text):
    return {"excel-german-two-ways.csv": [[x, int(z)] for x, z in HIGHER]}.get(name, POINTS)


MENDED = [  # (file, words of the refusal, steps of the remedy, then vertices and keys of the slope)
    ("qgis-two-layers.csv", ["2 lines: dsm_1m, dtm_1m", "'layer: dsm_1m'"], lambda s: s, POINTS, {"layer": "dtm_1m"}),
    ("gmt-two-lines.txt", ["2 lines: left line, right line"], lambda s: s, POINTS, {"layer": "right line"}),
    ("excel-german-two-ways.csv", [":2:3: '1.412' can be read in two ways: write '1412' or '1,412'", "5 more"],
     lambda s: s.replace(";1.", ";1"), [[x, int(z)] for x, z in HIGHER], {}),
    ("wkt-flat.csv", ["has no heights", "Drape"], lambda s: re.sub(r"(\S+ \S+)(, |\))", "\\1 @\\2", s).replace("LINESTRING ", "LINESTRING Z "), POINTS, {}),
    ("gps-text-order.csv", [":5:1: the line turns back here; sort its points as numbers"],
     lambda s: "".join([s.splitlines(True)[0], *sorted(s.splitlines(True)[1:], key=lambda r: int(r.split(",")[0]))]),
     [[10 * k, 400 - 7 * k] for k in range(12)], {}),
    ("r-nodata.csv", [":5:7: 'NA' is not a height; remove the row"], lambda s: s.replace("75.25,NA\n", ""), [p for p in POINTS if p[0] != 75.25], {}),
]


def test_remedies():
    """A refusal has the line and the remedy, and the remedy works"""
    with Folder() as f:
        for name, words, mend, vertices, slope in MENDED:
            content = (SHEETS / name).read_bytes()
            expect_refused(f, name, content, words)
            text = content.decode("cp1252" if b"\xf6" in content else "utf-8")
            mended = mend(text)
            for _, z in POINTS if "@" in mended else ():
                mended = mended.replace("@", f"{z:g}", 1)
            expect_read(f, name, mended, vertices, **slope)


ROWS = "0{s}412{d}5\n12{d}5{s}398{d}2\n40{s}371\n75{d}25{s}345{d}9\n118{s}330{d}1\n160{s}326\n"


def rows(separator=",", decimal="."):
    return ROWS.format(s=separator, d=decimal)


def test_heads():
    """Names of columns in four languages, with units in brackets, after the name and in a separate row"""
    with Folder() as f:
        for head in ("distance,elevation", "distanza,quota", "dist,altitude", "chainage,altitudine", "x,alt", "distance,height", "x,z",
                     "distance,value", "Distance (m),Elevation [m]", "distanza_m,quota_m_slm", "Dist. m,Quota m s.l.m.", "Entfernung,H\u00f6he m \u00fc. M.",
                     "chainage m,height m a.s.l.", "distance,elevation\n[m],[m]", "distanza,quota\nm,m s.l.m.", '"distance","elevation"',
                     '"Distanza\nprogressiva","Quota\n(m)"', "Progressiva,Elevazione\n\n"):
            expect_read(f, "p.csv", f"{head}\n{rows()}", POINTS)
        for head, words in (("distance (ft),elevation (ft)", "must be in m"), ("distance,elevation\n(km),(m)", "must be in m"),
                            ("length,depth", "'distance' and 'elevation'"), ("distance,elevation,distance", "occurs twice"),
                            ("distance", "'distance' and 'elevation'")):
            expect_refused(f, "p.csv", f"{head}\n{rows()}", [words])


def test_numbers():
    """One number convention per file; ambiguous numbers are asked about, by line"""
    with Folder() as f:
        for text in (rows(";", ","), rows("\t", ","), rows("\t"), rows("|"), rows(" "), rows(" ", ","), rows(";", ",").replace("412,5", "+412,50"),
                     rows().replace("412.5", '"412,5"').replace("398.2", '"398,2"').replace("345.9", '"345,9"').replace("330.1", '"330,1"')
                     .replace("12.5,", '"12,5",').replace("75.25,", '"75,25",'), rows().replace("412.5", "4.125e2"), rows(";").replace("412.5", "412.5 m"),
                     rows(";", ",").replace("412,5", "\u00a0412,5\u202f")):
            head = "distance elevation" if " " in text.split("\n")[2] else "distance{0}elevation".format(text[1])
            expect_read(f, "p.csv", f"{head}\n{text}", POINTS)
        for text in (rows(";", ",").replace("412,5", "1.412,5").replace(";398,2", ";1.398,2").replace(";371", ";1.371").replace(";345", ";1.345")
                     .replace(";330", ";1.330").replace(";326", ";1.326"),
                     rows().replace("412.5", "1 412.5").replace(",398", ",1 398").replace(",371", ",1 371").replace(",345", ",1 345")
                     .replace(",330", ",1 330").replace(",326", ",1 326"),
                     rows(";").replace("412.5", "1\u2019412.5").replace(";398", ";1\u2019398").replace(";371", ";1\u2019371").replace(";345", ";1\u2019345")
                     .replace(";330", ";1'330").replace(";326", ";1'326")):
            expect_read(f, "p.csv", "distance{0}elevation\n{1}".format(";" if ";" in text else ",", text), HIGHER)
        expect_refused(f, "p.csv", "distance elevation\n" + rows(" ").replace(" 371", ' 371 ""'), [":4:8: more columns than the first line has: 3 instead of 2"])
        for text, words in ((rows(";", ",").replace("398,2", "398.2"), ":3:6: the decimal sign of '398.2' is not the comma of line 2"),
                            (rows(";").replace("398.2", "398,2"), ":3:6: the decimal sign of '398,2' is not the dot of line 2"),
                            (rows(",", ","), ":2:7: more columns than the first line has: 3 instead of 2; if commas stand for decimals, separate"),
                            (rows(";", ",").replace(";371", ";1.371"), ":4:4: '1.371' can be read in two ways: write '1371' or '1,371'"),
                            (rows().replace(",371", ',"1,371"'), ":4:4: '1,371' can be read in two ways: write '1371' or '1.371'"),
                            (rows().replace(",371", ",37 1"), "'37 1': two numbers in one cell"),
                            (rows().replace(",371", ",37\u200b1"), "the number contains the invisible character U+200B"),
                            (rows().replace(",371", ",1.371.2"), "'1.371.2' is not a number"), (rows().replace(",371", ",3,71"), "more columns"),
                            (rows().replace("40,", "40;"), "too few columns: 1, the head has 2"), (rows().replace(",371", ",l371"), "'l371' is not a number"),
                            (rows(";", ",").replace(";371", ";1.371 m"), ":4:4: '1.371' can be read in two ways: write '1371' or '1,371'"),
                            (rows(";").replace("398.2", "1\u202f398,2"), "the decimal sign of '1\u202f398,2' is not the dot of line 2"),
                            (rows(";").replace("398.2", "1,234,567,890"), ":3:6: 1234567890 is outside the range"),
                            (rows().replace("160,", "1e999,"), ":7:1: 1e999 is outside the range")):
            expect_refused(f, "p.csv", "distance{0}elevation\n{1}".format(";" if ";" in text.split("\n")[0] else ",", text), [words])


def test_open_numbers_without_a_head():
    """A table without a head and with ambiguous numbers is accepted, and the numbers are asked about"""
    with Folder() as f:
        expect_refused(f, "p.csv", "0;1.412\n40;1.371\n90;1.326\n", [":1:3: '1.412' can be read in two ways", "2 more"])
        expect_refused(f, "p.csv", "0\t1,412\n40\t1,371\n", [":1:3: '1,412' can be read in two ways: write '1412' or '1.412'"])
        expect_read(f, "p.csv", "0;1412\n40;1.371,5\n90;1.326\n", [[0, 1412], [40, 1371.5], [90, 1326]], ["no head"])


def test_no_data():
    """Heights that mean no data, or result from an error of the terrain model, are refused by line"""
    with Folder() as f:
        for value in ("-9999", "-32768", "-99999", "-10000", "3.4e38", "-3.40282346638529e+38", "-9999.0", "\u22129999"):
            expect_refused(f, "p.csv", "distance,elevation\n" + rows().replace("371", value), [":4:4: ", "marks missing data"])
            expect_refused(f, "p.csv", "distance,elevation\n" + rows().replace("326", value), [":7:5: ", "marks missing data"])
        for value in ("0", "9999"):
            for place, line in (("412.5", 2), ("371", 4), ("326", 7)):
                expect_refused(f, "p.csv", "distance,elevation\n" + rows().replace(place, value), [f":{line}:", "a single height of 0 or 9999"])
        expect_refused(f, "p.csv", "distance,elevation\n" + rows().replace("371", "671"), [":4:1: ", "more than 200 m from both neighbours"])
        expect_refused(f, "p.csv", "distance,elevation\n0,900\n20,880\n21,620\n22,870\n90,800\n", [":4:1: ", "more than 200 m"])
        expect_read(f, "p.csv", "distance,elevation\n0,300\n10,280\n12,40\n60,20\n90,0\n", [[0, 300], [10, 280], [12, 40], [60, 20], [90, 0]])  # a face, and the sea
        for points in ([[0, 64], [50, 30], [90, 0]], [[0, 90], [40, 50], [60, 50], [90, 10]], [[0, 900], [10, 600], [20, 300], [90, 290]]):
            expect_read(f, "p.csv", "distance,elevation\n" + "".join(f"{x},{z}\n" for x, z in points), points)
        expect_read(f, "p.csv", "x,z\n0,120\n50,100\n50,0\n90,-5\n", [[0, 120], [50, 100], [50.01, 0], [90, -5]], ["1 vertical step"])  # a cliff at the sea


def line(to_east, to_north, points=POINTS):
    return "x,y,z\n" + "".join(f"{to_east(x)},{to_north(x)},{z}\n" for x, z in points)


def test_map():
    """A line on the map: metres are accepted, Web Mercator, degrees, turns and loops reported; Gauss-Boaga is not Mercator"""
    with Folder() as f:
        for east, north in ((600000, 4870000), (1680000, 4850000), (2350000, 4700000), (2600000, 1200000), (950000, 6500000), (950000, 6200000),
                            (1000000, 3000000), (0, 0)):
            expect_read(f, "p.csv", line(lambda x: east + 0.6 * x, lambda x: north - 0.8 * x), POINTS, ["columns x, y, z"])
        expect_in("not as EPSG:3857", check_text(f, line(lambda x: 1400000 + 0.6 * x, lambda x: 5150000 - 0.8 * x)))
        for east, north in ((1402000, 5390000), (1252344, 5465442), (1450000, 5300000)):  # 43.5, 44 and 43 degrees north
            expect_refused(f, "p.csv", line(lambda x: east + 0.6 * x, lambda x: north - 0.8 * x), ["EPSG:3857", "set the project to UTM"])
        expect_refused(f, "p.csv", line(lambda x: 11.25 + 7e-6 * x, lambda x: 43.5 - 7e-6 * x), ["not in degrees", "such as UTM"])
        expect_refused(f, "p.csv", "x,y,z\n0,0,90\n40,0,70\n10,1,60\n80,0,40\n", [":3:1: ", "turns back here"])
        expect_refused(f, "p.csv", "x,y,z\n0,0,90\n60,0,70\n60,40,60\n30,40,55\n30,-40,50\n90,-60,40\n", ["crosses itself"])
        expect_read(f, "p.csv", "x,y,z\n0,0,90\n40,0,70\n39.95,0,69\n90,0,40\n", [[0, 90], [40, 70], [40.05, 69], [90.1, 40]])
        expect_read(f, "p.csv", "x,y,z\n0,0,90\n40,0,70\n70,40,50\n115,-20,10\n", [[0, 90], [40, 70], [90, 50], [165, 10]])
        expect_read(f, "p.csv", "distance (ft),x,y,z\n0,0,0,90\n164,30,40,60\n328,60,80,0\n", [[0, 90], [50, 60], [100, 0]], ["columns x, y, z"])
        expect_refused(f, "p.csv", "wkt\n\"POINT (1 2 3)\"\n", ["this is not WKT"])
        expect_refused(f, "p.csv", "wkt\n\"LINESTRING M (0 0 3, 0 90 4)\"\n", ["has no heights"])
        for wkt, words in (("LINESTRING Z (0 0 9 1 2, 9 0 5 1 2)", "this is not WKT"), ("LINESTRING Z (0 0 9, 9 0 5", "this is not WKT"),
                           ("LINESTRING Z (0 0 9, 9 0 -9999)", "a height of the line marks missing data")):
            expect_refused(f, "p.csv", f'wkt\n"{wkt}"\n', [f":2:1: {words}"])
        expect_read(f, "p.csv", 'layer;geom\nb;LINESTRING Z (0 0 1, 9 0 0)\na;"LINESTRING ZM (0 0 90 7, 30 40 60 8, 60 80 0 9)"\n',
                    [[0, 90], [50, 60], [100, 0]], layer="a")
        expect_read(f, "p.csv", 'wkt\n"SRID=32632; (0 0 412.5,12.5 0 398.2,40 0 371,75.25 0 345.9,118 0 330.1,160 0 326)"\n', POINTS)
        expect_read(f, "p.csv", "SRID=32632;LINESTRINGZ(0 0 412.5,12.5 0 398.2,40 0 371,75.25 0 345.9,118 0 330.1,160 0 326)\n", POINTS)
        expect_read(f, "p.csv", 'name;geom\nb;MULTILINESTRING Z ((0 0 1, 9 0 0))\na;"MULTILINESTRING Z ((0 0 412.5,12.5 0 398.2,40 0 371,75.25 0 345.9,'
                    '118 0 330.1,160 0 326))"\n', POINTS, layer="a")


def check_text(f, text):
    f.write("p.csv", text)
    return check(f, {"csv": "p.csv"}).out


def test_several_lines():
    """Several lines in one file, by a column, by restarting distances, by WKT: named, and chosen by slope.layer"""
    other = "0,90\n60,30\n100,0\n"
    with Folder() as f:
        twice = "distance,elevation\n" + rows() + other
        expect_refused(f, "p.csv", twice, ["2 lines: 1, 2"])
        expect_read(f, "p.csv", twice, POINTS, ["line '1' of 2"], layer="1")
        expect_read(f, "p.csv", twice, [[0, 90], [60, 30], [100, 0]], layer="2")
        expect_refused(f, "p.csv", twice, ["no line '3'; the file has: 1, 2"], layer="3")
        expect_refused(f, "p.csv", "x,z\n0,50\n0,40\n20,30\n0,10\n", ["0 follows 20"])  # the first point occurs twice: one line
        many = ["line,x,z\n" + "".join(f"k{i},0,{i + 9}\nk{i},100,5\n" for i in range(n)) for n in (11, 1001)]
        expect_refused(f, "p.csv", many[0], ["the file has 11 lines: k0, k1, k2, k3, k4, k5, k6, k7, k8, k9, \u2026; name one in the slope"])
        expect_read(f, "p.csv", many[1], [[0, 1008], [100, 5]], ["2 points, 100 m long, falls 1003 m; line 'k999'"], layer="k999")
        four = "".join(f"{600000 + x} 4870000 {x} {{}}\n" for x in (0, 20, 60, 90))
        both = "> one\n" + four.format(90, 70, 30, 0) + "> two\n" + "700000 4870000 0 80\n700000 4869950 50 40\n700000 4869900 100 10\n"
        expect_read(f, "p.csv", both, [[0, 90], [20, 70], [60, 30], [90, 0]], layer="one")
        expect_read(f, "p.csv", both, [[0, 80], [50, 40], [100, 10]], ["line 'two' of 2"], layer="two")
        mixed = "linea;distanza;quota\n" + "".join(f"{'ab'[i % 2]};{x};{z}\n" for i, (x, z) in enumerate(p for pair in zip(POINTS, HIGHER) for p in pair))
        expect_refused(f, "p.csv", mixed, ["2 lines: a, b"])
        expect_read(f, "p.csv", mixed, POINTS, layer="a")


def test_walls():
    """Repeated points are dropped, vertical steps become walls of 0.01 m, overhangs their envelope; backward lines are refused"""
    with Folder() as f:
        expect_read(f, "p.csv", "x,z\n0,50\n0,50\n20,40\n20,30\n60,10\n60,8\n90,0\n",
                    [[0, 50], [20, 40], [20.01, 30], [60, 10], [60.01, 8], [90, 0]], ["1 repeated point", "2 vertical steps, the first at 20 m"])
        expect_read(f, "p.csv", "x,z\n0,50\n20,40\n18,30\n24,24\n90,0\n", [[0, 50], [20, 40], [20.01, 28], [24, 24], [90, 0]],
                    ["1 overhang, at 20 m, replaced by its outer envelope"])
        expect_read(f, "p.csv", "x,z\n0,0\n66,24\n72,30\n70,40\n90,50\n", [[0, 0], [66, 24], [69.99, 28], [70, 40], [90, 50]], ["1 overhang"], reversed=True)
        expect_read(f, "p.csv", "x,z\n0,50\n20,40\n19,38\n18,30\n20,29\n30,24\n90,0\n", [[0, 50], [20, 40], [20.01, 29], [30, 24], [90, 0]])
        expect_read(f, "p.csv", "x,z\n0,80\n20,60\n18,50\n24,44\n50,30\n48,20\n56,16\n90,0\n", [[0, 80], [20, 60], [20.01, 48], [24, 44], [50, 30],
                    [50.01, 19], [56, 16], [90, 0]], ["2 overhangs, the first at 20 m, replaced by their outer envelope"])
        for text, words in (("x,z\n0,50\n20,40\n5,30\n10,0\n", "5 follows 20"), ("x,z\n0,50\n20,40\n18,45\n90,0\n", "18 follows 20"),
                            ("x,z\n0,0\n20,10\n5,20\n10,50\n", "5 follows 20"),
                            ("x,z\n90,0\n20,40\n0,50\n", "sort the rows by distance"), ("x,z\n0,50\n10,48\n100,0\n20,45\n", "as numbers"),
                            ("x,z\n0,50\n20,40\n18,30\n", "distances must rise"), ("x,z\n5,50\n5,40\n", "all points lie at the same distance")):
            expect_refused(f, "p.csv", text, [words])


if __name__ == "__main__":
    run_all(__name__)
