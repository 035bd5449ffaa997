#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""--format geojson: a feature for each row, option and control, with the geometry of the row."""
import json
import shutil
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import DONE, INPUT, USAGE, Folder, Skip, ceduo, expect, expect_equal, expect_in, run_all, wooded_scene

# WKT and its geometry by RFC 7946, written by hand; None: refused
GEOMETRIES = {
    "POINT (1 2)": ("Point", [1, 2]), "point(1 2)": ("Point", [1, 2]), "POINT Z (1 2 3.50)": ("Point", [1, 2, 3.5]),
    "POINTZ(-1 +2 3e2)": ("Point", [-1, 2, 300]), "POINT (007 -00.5)": ("Point", [7, -0.5]), "Point M (1 2 9)": ("Point", [1, 2]), "POINT ZM (1 2 3 9)": ("Point", [1, 2, 3]),
    "LINESTRING (0 0, 3 4)": ("LineString", [[0, 0], [3, 4]]), "LineString(0 0,3 4 , 5 6)": ("LineString", [[0, 0], [3, 4], [5, 6]]),
    "LINESTRING Z (0 0 1, 3 4 2)": ("LineString", [[0, 0, 1], [3, 4, 2]]),
    "MULTILINESTRING ((0 0, 3 4), (5 6, 7 8))": ("MultiLineString", [[[0, 0], [3, 4]], [[5, 6], [7, 8]]]),
    "SRID=32632;POINT (651234.5 5101234.25)": ("Point", [651234.5, 5101234.25]),
    "": None, "POINT": None, "POINT (1)": None, "POINT (1 2": None, "POINT (1 2) x": None, "POINT (1 x)": None, "POINT (nan 2)": None,
    "LINESTRING (0 0)": None, "LINESTRING (0 0, 1)": None, "LINESTRING 0 0, 1 1": None, "POLYGON ((0 0, 1 1, 1 0, 0 0))": None,
    "POINT EMPTY": None, "MULTILINESTRING (0 0, 1 1)": None, "POINT (1 2 3 4 5)": None, "(1 2)": None, "POINTS (1 2)": None}


def features(result):
    found = json.loads(result.out)
    expect_equal((found["type"], list(found)), ("FeatureCollection", ["type", "features"]))
    for feature in found["features"]:
        expect_equal((feature["type"], list(feature)), ("Feature", ["type", "geometry", "properties"]))
    return found["features"]


def run(f, rows, *words):
    f.write("rows.csv", rows)
    f.write("s.yaml", wooded_scene(controls=[{"x_m": 60, "accepted_kJ": 20}, {"x_m": 105}]))
    return ceduo("-b", "-q", "-n", 60, "-f", "geojson", "--each", "rows.csv", *words, "s.yaml", cwd=f.path)


def test_geometries():
    """WKT of points and lines, with or without blanks and Z; a row with another geometry fails and stays as a feature"""
    with Folder() as f:
        rows = "id,wkt,rock.diameter_m\n" + "".join(f'{i},"{wkt}",0.9\n' for i, wkt in enumerate(GEOMETRIES))
        r = run(f, rows, "--columns", "id,status,x_m")
        expect_equal(r.status, INPUT)
        found = {}
        for feature in features(r):
            found.setdefault(feature["properties"]["id"], []).append(feature)
        for i, (wkt, geometry) in enumerate(GEOMETRIES.items()):
            wanted = geometry and {"type": geometry[0], "coordinates": geometry[1]}
            expect_equal([feature["geometry"] for feature in found[i]], [wanted] * (2 if wanted else 1), wkt)
            expect_equal([feature["properties"]["status"] for feature in found[i]], ["ok", "ok"] if wanted else ["failed"], wkt)
        expect_in("rows.csv:14:4: no geometry: write POINT (x y) or LINESTRING (x y, x y)", r.err)


def test_coordinates():
    """Columns x and y give points, also with decimal commas; a table without geometry is refused"""
    with Folder() as f:
        r = run(f, "id;X;Y;rock.diameter_m\na;1,5;-2,25;0,9\nb;1;;0,9\n", "--columns", "id,status")
        expect_equal([feature["geometry"] for feature in features(r)],
                     [{"type": "Point", "coordinates": [1.5, -2.25]}] * 2 + [None])
        expect_in("no geometry: x and y need a number each", r.err)
        r = run(f, "id,x,rock.diameter_m\na,1,0.9\n")
        expect_equal((r.status, r.out), (INPUT, ""), str(r))
        expect_in("needs a geometry: a column 'wkt', or 'x' and 'y'", r.err)


def test_properties():
    """Properties are the cells of CSV: numbers, words, flags and null; ids stay text unless they print back"""
    with Folder() as f:
        rows = 'id,wkt,note,rock.diameter_m,title\n12e3,POINT (1 2),"say ""x"", y",0.9,"a, ""b"""\n7,POINT (3 4),,x,\n'
        names = "id,note,title,status,reason,x_m,class=verdict.class,accepted_kJ,summary.passes_threshold,option"
        first, second, failed = (feature["properties"] for feature in features(run(f, rows, "--columns", names)))
        expect_equal((first["id"], first["note"], first["title"], first["status"], first["reason"]), ("12e3", 'say "x", y', 'a, "b"', "ok", None))
        expect_equal((first["x_m"], first["accepted_kJ"], second["x_m"], second["accepted_kJ"]), (60, 20, 105, None))
        expect(type(first["summary.passes_threshold"]) is bool and type(first["class"]) is int, first)
        expect_equal((failed["id"], failed["class"], failed["reason"], failed["x_m"]), (7, 5, "rock.diameter_m: 'x' is not a number", None))
        usual = features(run(f, rows, "--key", "id"))[0]["properties"]
        expect("wkt" not in usual and "note" not in usual and usual["id"] == "12e3" and "wooded.energy_kJ.mean" in usual, list(usual))
        expect("wkt" not in features(run(f, rows))[0]["properties"], "the geometry is no property")


def test_requirements():
    """It needs --each; --resume needs CSV; -o writes the same bytes"""
    with Folder() as f:
        rows = "id,wkt,rock.diameter_m\na,POINT (1 2),0.9\nb,POINT (1 2),0.8\n"
        out = run(f, rows).out
        expect_equal(run(f, rows, "-o", "map.geojson").status, DONE)
        expect_equal((f.path / "map.geojson").read_text(), out)
        expect_in("--resume requires --each --output --format csv", run(f, rows, "-o", "new.geojson", "--resume").err)
        r = ceduo("-b", "-f", "geojson", "s.yaml", cwd=f.path)
        expect_equal(r.status, USAGE)
        expect_in("--format geojson requires --each", r.err)


def test_ogr():
    """GDAL reads it as points or lines with all fields"""
    if not shutil.which("ogrinfo"):
        raise Skip("no ogrinfo")
    with Folder() as f:
        run(f, 'id,wkt,rock.diameter_m\na,"LINESTRING (1 2, 3 4)",0.9\nb,"LINESTRING (1 2, 3 4)",x\n', "-o", "map.geojson", "--columns", "id,status,x_m")
        done = subprocess.run(["ogrinfo", "-al", "-so", f.path / "map.geojson"], capture_output=True, text=True, check=True)
        for words in ("Geometry: Line String", "Feature Count: 3", "id: String", "status: String", "x_m: Integer"):
            expect_in(words, done.stdout)


if __name__ == "__main__":
    run_all(__name__)
