#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Observations of real rocks: accepted forms, and errors."""
import json
import math

from harness import DONE, INPUT, Folder, ceduo, expect, expect_equal, expect_in, expect_near, run_all, scene

TABLE = "id,Distance,block\n1,41.5,a\n2,44,a\n3,52.25,b\n4,61,a\n"


def quarry(observed, **changes):
    return scene(**{"slope": {"vertices_m": [[0, 70], [100, 0]], "segments": [{"rn": 0.3, "rt": 0.9, "roughness_rad": 0.2}]},
                    "rock": {"diameter_m": 0.7}, "observed": observed, **changes})


def check(observed, *files, **changes):
    with Folder() as f:
        for name, text in files:
            f.write(name, text)
        return ceduo("--check", f.write("s.yaml", quarry(observed, **changes)))


def accepted(observed, *files, **changes):
    r = check(observed, *files, **changes)
    expect_equal((r.status, r.err), (DONE, ""), r)


def refused(what, observed, *files, **changes):
    r = check(observed, *files, **changes)
    expect_equal(r.status, INPUT, r)
    expect_in(what, r.err)


STOPS = {"stops": {"x_m": [40, 50, 60], "of": 5}}


def test_forms():
    """A list of rows and a mapping of kinds; keys for all rows of a kind may be inside it"""
    accepted([STOPS])
    accepted(STOPS)
    accepted([{"stops": {"x_m": [40, 50, 60]}, "use": "check", "name": "spring"}])
    accepted({"stops": {"x_m": [40, 50, 60], "use": "check", "name": "spring"}})
    accepted({"passed": [{"x_m": 50, "count": 3, "of": 5}, {"x_m": 60, "count": 0, "of": 5, "use": "check"}]})
    accepted([])


def test_too_many():
    """A thousand rows are read, and one more is refused with its number"""
    row = {"stops": {"x_m": [40], "of": 1}}
    accepted([{**row, "name": f"n{i}"} for i in range(1000)])
    refused("1001 items; at most 1000 can be computed", [{**row, "name": f"n{i}"} for i in range(1001)])


def test_kinds():
    """All kinds, as values or as their mean, sd and number"""
    mean = {"mean": 10, "sd": 2, "n": 5}
    for kind in ("speed", "height", "energy"):
        accepted([{kind: {"x_m": 50, "values": [3, 4, 5]}}])
        accepted([{kind: {"x_m": 50, **mean}}])
    for key in ("speed_m_s", "height_m"):
        accepted([{"largest": {key: mean}}])
        accepted([{"on_the_way": {"from_m": 20, "to_m": 40, key: {"values": [1, 2]}}}])
    accepted([{"on_the_way": {"from_m": 20, "to_m": 40, "energy_kJ": mean}}])
    accepted([{"scars": {"from_m": 20, "to_m": 40, "height_m": [0.5, 1.2], "share_seen": 0.7, "of": 10}}])
    refused("give values, or their mean, sd and n", [{"speed": {"x_m": 50}}])
    refused("give values, or their mean, sd and n", [{"speed": {"x_m": 50, "mean": 3}}])
    refused("give values, or their mean, sd and n", [{"speed": {"x_m": 50, "values": [3], **mean}}])
    refused("observed[0].speed.mean: -3 is below 0", [{"speed": {"x_m": 50, "mean": -3, "sd": 1, "n": 2}}])
    refused("observed[0].largest.height_m.mean: -1 is below 0", [{"largest": {"height_m": {"mean": -1, "sd": 1, "n": 2}}}])
    refused("observed[0].speed.n: 0 is below 1", [{"speed": {"x_m": 50, "mean": 3, "sd": 1, "n": 0}}])
    refused("observed[0].passed.of: 0 is below 1", [{"passed": {"x_m": 50, "count": 0, "of": 0}}])
    refused("observed[0].stops.x_m: the list is empty", [{"stops": {"x_m": []}}])
    refused("no observation; give one of", [{"use": "fit"}])
    refused("unknown key", [{"stop": {"x_m": [40]}}])
    refused("-1 is below 0", [{"height": {"x_m": 50, "values": [2, -1]}}])


def test_values():
    """Each kind, as values and as their mean: compared in the file's unit and coordinates"""
    ground = {"vertices_m": [[1000, 70], [1100, 0]], "segments": [{"rn": 0.3, "rt": 0.9, "roughness_rad": 0.2}]}
    stretch = {"from_m": 1020, "to_m": 1060}
    seen = {"stops": {"x_m": [1040, 1052]}, "passed at 1050 m": 3, "scars": {**stretch, "height_m": [0.5, 1.2]}}
    wanted = {"stops": 1046, "passed at 1050 m": 3, "scars": 0.85}
    rows = [{"stops": seen["stops"]}, {"passed": {"x_m": 1050, "count": 3, "of": 4}}, {"scars": seen["scars"]}]
    for i, values in enumerate(({"values": [3, 4, 8]}, {"mean": 5, "sd": 2, "n": 5})):
        x = 1050 + i
        places = {"from_m": 1020, "to_m": 1060 + i}
        for kind in ("speed", "height", "energy"):
            rows.append({kind: {"x_m": x, **values}})
            wanted[f"{kind} at {x} m"] = 5
        for key in ("speed_m_s", "height_m", "energy_kJ"):
            rows.append({"on_the_way": {**places, key: values}})
            wanted[f"on_the_way.{key} {places['from_m']}-{places['to_m']} m"] = 5
        for key in ("speed_m_s", "height_m"):
            rows.append({"largest": {key: values}, "name": f"{key} {i}"})
            wanted[f"{key} {i}"] = 5
    with Folder() as f:
        path = f.write("s.yaml", quarry(rows, slope=ground, release={"x_m": 1000}, controls=[{"x_m": 1090}]))
        r = ceduo("--calibrate", "slope.segments[0].rt=0.85:0.95", "-n", 10, "-f", "json", path)
        expect_equal(r.status, DONE, r)
        found = {o["what"]: o for o in r.json()[0]["observations"]}
        expect_equal(sorted(found), sorted(wanted))
        for what, value in wanted.items():
            expect_near(found[what]["seen"], value, 1e-9, what)
        fall = math.pi / 6 * 0.7 ** 3 * 2600 * 9.81 * 0.7 / 1000  # kJ for each metre along x
        for what, x in (("energy at 1050 m", 50), ("on_the_way.energy_kJ 1020-1060 m", 60)):
            expect(0.02 * fall * x < found[what]["single_hi"] <= fall * x, "no rock has more than it fell", what, found[what])


def test_places():
    """Places off the profile, above the release or outside the observed area"""
    refused("s.yaml:", [{"stops": {"x_m": [40, 120]}}])
    refused("120 lies outside the slope, which goes from 0 to 100 m", [{"stops": {"x_m": [40, 120]}}])
    refused("-3 lies outside the slope", {"stops": {"x_m": [-3, 40]}})
    refused("40 lies before the begin of the searched area (45)", {"stops": {"x_m": [40], "seen_from_m": 45}})
    refused("300 lies outside the slope", {"stops": {"x_m": [40], "seen_from_m": 300}})
    refused("must lie beyond the release (0 m", {"passed": {"x_m": 0, "count": 1, "of": 2}})
    refused("must lie beyond the release (60 m", {"passed": {"x_m": 50, "count": 1, "of": 2, "release": {"x_m": 60}}})
    refused("the end (20) must lie beyond the start (40)", {"scars": {"from_m": 40, "to_m": 20, "height_m": [1]}})
    refused("the end (20) must lie beyond the start (40)", {"on_the_way": {"from_m": 40, "to_m": 20, "speed_m_s": {"values": [1]}}})
    accepted({"stops": {"x_m": [0, 100], "seen_from_m": 0}})  # both ends are the slope's
    accepted({"passed": {"x_m": 100, "count": 1, "of": 2}})
    accepted({"on_the_way": {"from_m": 0, "to_m": 100, "speed_m_s": {"values": [1]}}})
    refused("100.00001 lies outside the slope", {"passed": {"x_m": 100.00001, "count": 1, "of": 2}})
    refused("outside the slope", {"on_the_way": {"from_m": 40, "to_m": 200, "speed_m_s": {"values": [1]}}})


def test_counts():
    """More observed than released; names and options"""
    refused("observed[0].stops.of: 3 observed, but only 2 released; correct one", [{"stops": {"x_m": [40, 50, 60], "of": 2}}])
    refused("9 observed, but only 8 released; correct one", {"passed": {"x_m": 50, "count": 9, "of": 8}})
    refused("'a' is given twice", [{**STOPS, "name": "a"}, {**STOPS, "name": "a"}])
    refused("the scene has no option 'cut'; it has: current", [{**STOPS, "option": "cut"}])
    refused("'fitted' is unknown; did you mean 'fit'?", [{**STOPS, "use": "fitted"}])


def test_rocks():
    """A separate rock and release; missing keys of the release are the scene's"""
    accepted([{**STOPS, "rock": {"shape": "block", "axes_m": [0.4, 0.3, 0.2], "mass_kg": 60}}])
    refused("a sphere needs one of", [{**STOPS, "rock": {"density_kg_m3": 2500}}])
    refused("does not belong to the shape 'sphere'", [{**STOPS, "rock": {"diameter_m": 1, "height_m": 2}}])
    refused("release: 500 lies outside the slope".replace("release: ", "release.x_m: "), [{**STOPS, "release": {"x_m": 500}}])
    accepted([{"passed": {"x_m": 40, "count": 1, "of": 2}, "release": {"vx_m_s": 3}}], release={"x_m": 30, "height_m": 1})
    refused("must lie beyond the release (30 m", [{"passed": {"x_m": 20, "count": 1, "of": 2}, "release": {"vx_m_s": 3}}],
            release={"x_m": 30, "height_m": 1})


def test_tables():
    """Lists from a table, its column by name; only some of its rows"""
    table = ("stops.csv", TABLE)
    accepted({"stops": {"csv": "stops.csv"}}, table)
    accepted({"stops": {"x_m": "stops.csv", "column": "distance"}}, table)
    accepted({"stops": {"csv": "stops.csv", "only": "block=b", "of": 1}}, table)
    accepted({"stops": {"csv": "stops.csv", "of": 2}}, ("stops.csv", "where\n40\n41,5\n".replace(",", ".")))
    accepted({"stops": {"csv": "stops.csv", "column": "x"}}, ("stops.csv", "id;x\n1;40,5\n2;41,5\n"))
    accepted({"stops": {"csv": "stops.csv", "of": 2}}, ("stops.csv", "id;x\n1;40\n;\n \t,\n2;50\n"))
    refused("3 observed, but only 2 released; correct one", {"stops": {"csv": "stops.csv", "only": "block=a", "of": 2}}, table)
    refused("the table has no column 'length'; it has: id, Distance, block", {"stops": {"csv": "stops.csv", "column": "length"}}, table)
    refused("name the column with the values in 'column'; the table has: a, b", {"stops": {"csv": "t.csv"}}, ("t.csv", "a,b\n1,2\n"))
    refused("the table has no column '+'; it has: ?, x", {"stops": {"csv": "t.csv", "column": "+"}}, ("t.csv", "?;x\n1;40\n"))
    refused("t.csv:1:1: the column 'a' occurs twice", {"stops": {"csv": "t.csv", "column": "a"}}, ("t.csv", "a,a\n1,2\n"))
    refused("no row of the table matches", {"stops": {"csv": "stops.csv", "only": "block=z"}}, table)
    refused("is not COLUMN=WORD", {"stops": {"csv": "stops.csv", "only": "block"}}, table)
    refused("the table has no column 'rock'", {"stops": {"csv": "stops.csv", "only": "rock=1"}}, table)
    refused("stops.csv:3:3: 'far' is not a number", {"stops": {"csv": "stops.csv"}}, ("stops.csv", "id,x\n1,40\n2,far\n"))
    refused("stops.csv:3:1: too few columns", {"stops": {"csv": "stops.csv"}}, ("stops.csv", "id,x\n1,40\n2\n"))
    refused("cannot find 'none.csv' next to this file", {"stops": {"csv": "none.csv"}})
    refused("the file is empty", {"stops": {"csv": "stops.csv"}}, ("stops.csv", ""))
    refused("x_m already says this; keep one of the two", {"stops": {"csv": "stops.csv", "x_m": [40]}}, table)
    refused("this needs a table", {"stops": {"x_m": [40], "column": "a"}})
    refused("120 lies outside the slope", {"stops": {"csv": "stops.csv"}}, ("stops.csv", "x\n120\n"))
    refused("-2 is below 0", {"speed": {"x_m": 50, "csv": "v.csv"}}, ("v.csv", "speed\n4\n-2\n"))
    accepted({"speed": {"x_m": 50, "values": "v.csv", "column": "v"}}, ("v.csv", "t,v\n1,4\n2,5\n"))


def observed_stops(observed, *files):
    """Number and mean of the observed stops, as a calibration prints them"""
    with Folder() as f:
        for name, text in files:
            f.write(name, text)
        r = ceduo("--calibrate", "slope.segments[0].rn=0.29:0.31", "-n", 10, "-f", "json", f.write("s.yaml", quarry([{"stops": observed}])))
        expect_equal(r.status in (DONE, 1), True, r)
        row = json.loads(r.out)["observations"][0]
        return row["n"], row["seen"]


def test_tables_of_offices():
    """Stops as a GIS, a spreadsheet and a field book write them; map coordinates are no distance; `only` may be a number"""
    listed = [40.5, 51.25, 47, 66]
    rows = "".join(f"{i};{x};{1 + i % 2}\n" for i, x in enumerate(listed))
    wanted = observed_stops({"x_m": listed})
    expect_equal(wanted[0], 4)
    for head in ("id;x_m;block", "n;Distanza (m);blocco", "id;progressiva;b", "id;chainage;b", "Rilievo di maggio;;\nid;dist m;b",
                 "id;Entfernung [m];b", "id;distance;b\n;(m);", "sep=;\nid;x;b"):
        for text in (rows, rows.replace(".", ",")):
            expect_equal(observed_stops({"csv": "t.csv"}, ("t.csv", head + "\n" + text)), wanted, head)
    for text in ("40.5\n51.25\n47\n66\n", "40,5\n51,25\n47\n66\n".replace(",", "."), "where\n40.5\n51.25\n47\n66\n", '"40,5"\n"51,25"\n47\n66\n'):
        expect_equal(observed_stops({"csv": "t.csv"}, ("t.csv", text)), wanted, text)
    two = observed_stops({"x_m": [51.25, 66]})
    for only in ("b=2", "b = 2", "b=2.0", "B = 2.00"):
        expect_equal(observed_stops({"csv": "t.csv", "only": only}, ("t.csv", "id;x;b\n" + rows)), two, only)
    expect_equal(observed_stops({"csv": "t.csv", "only": "b=2"}, ("t.csv", "id;x;b\n" + rows.replace(";2\n", ";2.0\n"))), two)
    expect_equal(observed_stops({"csv": "t.csv", "only": "b=2"}, ("t.csv", "id;x;b\n" + rows.replace(";2\n", ';"2"\n'))), two)
    expect_equal(observed_stops({"csv": "t.csv"}, ("t.csv", "id,distance,y_m\n" + rows.replace(";", ","))), wanted)  # y_m is not used
    plan = "id,x_m,y_m,runout_m\n1,700040,4800000,40.5\n2,700051,4800003,51.25\n3,700047,4800001,47\n4,700066,4800009,66\n"
    for head in ("id,x_m,y_m,runout_m", "id,x,y,runout_m", "id,x,northing,runout_m", "id,X (m),Y (m),runout_m"):
        text = plan.replace("id,x_m,y_m,runout_m", head)
        refused("x and y are coordinates on a map; name the column with the distance", {"stops": {"csv": "t.csv"}}, ("t.csv", text))
        expect_equal(observed_stops({"csv": "t.csv", "column": "runout_m"}, ("t.csv", text)), wanted, head)
    for text, words in (("id;x\n1;40.5\n2;51,25\n", "t.csv:3:3: the decimal sign of '51,25' is not the dot of line 2"), ("id;x\n1;1.040\n2;1.051\n", "two ways"),
                        ("id,x\n1,40,5\n2,51,2\n", "more columns"), ('id;x;b\n1;40;a"\n2;50;a\n', "a stray quote in this cell"), ("id;x\n1;NA\n2;9\n", "'NA' is not a number"),
                        ('id;x\n1;"40\n2;50\n', "this quote is not closed"), ('id;x\n1;"40"5\n', "text after a closing quote")):
        refused(words, {"stops": {"csv": "t.csv", **({"only": "b=a"} if ";b" in text else {})}}, ("t.csv", text))
    done = check({"stops": {"csv": "t.csv", "only": "b=2"}}, ("t.csv", "id;Distanza;b;nota\n" + rows.replace(".", ",").replace("\n", ";\n")))
    expect_equal(done.out, "t.csv: 2 values in the column Distanza; rows with b = 2; decimal commas; not used: id, nota\n")


def test_units_of_tables():
    """A column in another unit is refused, whether it is the only one, named, or has a row of units; the right unit may be written in many ways"""
    kinds = {"stops": ({"stops": {"csv": "t.csv"}}, "45", "m", "x_m"), "speed": ({"speed": {"x_m": 60, "csv": "t.csv"}}, "9", "m/s", "speed_m_s"),
             "height": ({"height": {"x_m": 60, "csv": "t.csv"}}, "2", "m", "height_m"), "energy": ({"energy": {"x_m": 60, "csv": "t.csv"}}, "20", "kJ", "energy_kJ")}
    wrong = {"stops": ("x (km)", "stops_km", "distance [ft]", "km", "x_cm", "x (m/s)", "x (km"), "height": ("altezza (cm)", "H cm", "height_mm", "h (m s-1)"),
             "speed": ("speed (km/h)", "speed_km_h", "velocita km h-1", "Speed [KM/H] GPS", "km/h", "v_kmh", "V, mph", "x (m)", "speed (kJ)"),
             "energy": ("energy (J)", "Energia [MJ]", "E_J", "energy in kNm", "mass (kg)")}
    right = {"stops": ("x (m)", "x_m", "stops m", "x (metri)", "x", "m", "stopped (tape)", "arrestomm"), "height": ("altezza (m)", "H_m", "h", "height [m] of the middle"),
             "speed": ("speed (m/s)", "speed m s-1", "v_ms-1", "v_m_s", "speed (m\u00b7s\u207b\u00b9)", "v at 60 m", "film"), "energy": ("energy (kJ)", "E_KJ", "Ekin", "energy at 60 m")}
    for kind, (observed, value, unit, name) in kinds.items():
        words = f"t.csv:1:1: this column must be in {unit}; convert it and name it '{name}'"
        for head in wrong[kind]:
            refused(words, observed, ("t.csv", f"{head}\n{value}\n".replace("V, mph", '"V, mph"')))
            refused(words.replace(":1:1", ":1:4"), {kind: {**observed[kind], "column": head}}, ("t.csv", f"id;{head}\na;{value}\n"))
        for head in right[kind]:
            accepted(observed, ("t.csv", f"{head}\n{value}\n"))
            accepted({kind: {**observed[kind], "column": head}}, ("t.csv", f"id;{head}\na;{value}\n"))
        accepted(observed, ("t.csv", f"id;{right[kind][0]}\na;{value}\n"))
    refused("t.csv:1:1: this column must be in m;", kinds["stops"][0], ("t.csv", "x\n(km)\n0.045\n"))
    refused("t.csv:1:4: this column must be in m;", {"height": {"x_m": 60, "csv": "t.csv", "column": "altezza (cm)"}}, ("t.csv", "id;altezza\n;cm\na;45\n"))
    accepted(kinds["stops"][0], ("t.csv", "id;x\n;m\na;45\n"))
    accepted(kinds["speed"][0], ("t.csv", "id;speed (m s-1)\na;9\n"))
    for unit, kind in (("m/s", "speed"), ("m s-1", "speed"), ("kJ", "energy")):
        accepted(kinds[kind][0], ("t.csv", f"id;{kind}\n;{unit}\na;9\n"))
    for unit, kind in (("km/h", "speed"), ("(km/h)", "speed"), ("J", "energy")):
        refused(f"t.csv:1:1: this column must be in {kinds[kind][2]};", kinds[kind][0], ("t.csv", f"{kind}\n{unit}\n9\n"))


def test_counts_of_rocks():
    """A column that counts the rocks of a row is refused; one that numbers the rows, or counts one rock in each, is not"""
    stops = {"stops": {"csv": "t.csv", "of": 20}}
    words = "this column counts rocks; write one row for each rock, or name it 'id' if it numbers them"
    table = "distance,{}\n45,{}\n60,{}\n61,{}\n"
    for head in ("N.", "numero", "number", "Nr", "conteggio", "Numero massi"):
        refused(f"t.csv:1:10: {words}", stops, ("t.csv", table.format(head, 10, 8, 1)))
    for head in ("n", "count"):
        for numbers in ((10, 8, 1), (1, 2, 4), (1, 2, ""), (1, 1, 2), (2, 3, ""), ("1.0", "-", "3")):
            refused(f"t.csv:1:10: {words}", stops, ("t.csv", table.format(head, *numbers)))
        for numbers in ((1, 1, 1), ("", "", 1), (1.5, 2, 4), (-1, 3, 4), ("a", 2, 3), (2, "b", 3)):
            accepted(stops, ("t.csv", table.format(head, *numbers)))
    for numbers in ((1, 2, 3), (0, 1, 2), (17, 18, 19)):
        accepted(stops, ("t.csv", table.format("n", *numbers)))
        refused(words, stops, ("t.csv", table.format("count", *numbers)))
    accepted(stops, ("t.csv", table.format("id", 10, 8, 1)))
    accepted({"stops": {"csv": "t.csv", "only": "n=8"}}, ("t.csv", table.format("n", 10, 8, 1)))
    accepted({"stops": {"csv": "t.csv", "column": "n"}}, ("t.csv", table.format("n", 50, 48, 41)))
    refused("t.csv:3:1: too few columns", stops, ("t.csv", "distance,n\n45,1\n60\n"))
    refused(words, {"scars": {"from_m": 20, "to_m": 40, "csv": "t.csv"}}, ("t.csv", "h,n\n1,10\n2,8\n"))


def test_misplaced():
    """Kinds, rows and tables of an impossible form"""
    table = ("stops.csv", TABLE)
    mean = {"mean": 10, "sd": 2, "n": 5}
    refused("observed", [5])
    refused("observed", 5)
    refused("observed[0].stops", [{"stops": 5}])
    refused("observed[0].stops", {"stops": [5]})
    refused("observed[0].stops.x_m", [{"stops": {"x_m": 5}}])
    refused("cannot find '5' next to this file", [{"stops": {"x_m": "5"}}])
    refused("observed[0].speed.values", [{"speed": {"x_m": 50, "values": {"a": 1}}}])
    refused("observed[0].stops.csv", [{"stops": {"csv": ["stops.csv"]}}], table)
    refused("observed[0].stops.x_m: expected a list", [{"stops": {"csv": "stops.csv", "x_m": "stops.csv"}}], table)
    refused("observed[0].use", [{"stops": {"x_m": [40], "use": "check"}, "use": "fitted"}])
    refused("observed[0].stops.use: unknown key", [{"stops": {"x_m": [40], "use": "check"}, "use": "fit"}])
    refused("observed[0].release", [{**STOPS, "release": 5}])
    refused("release: expected", [STOPS, {**STOPS, "release": {"vx_m_s": 3}}], release=5)
    accepted([{**STOPS, "release": {"vx_m_s": 3}}])
    refused("observed[0].stops.x_m[1]", [{"stops": {"x_m": [40, "far"]}}])
    refused("observed[0].stops.of", [{"stops": {"x_m": [40], "of": "many"}}])
    refused("'=a' is not COLUMN=WORD", {"stops": {"csv": "stops.csv", "only": "=a"}}, table)
    refused("this needs a table", {"stops": {"x_m": [40], "only": "block=1"}})
    refused("observed[0].stops.onli: unknown key", [{"stops": {"column": "a", "onli": "b"}}])
    accepted({"stops": {"csv": "t.csv", "only": "block=b"}}, ("t.csv", "x,block\n40,a\n50,\n60,b\n"))
    refused("t.csv:3:1: too few columns", {"stops": {"csv": "t.csv", "only": "block=b"}}, ("t.csv", "x,block\n40,a\n50\n60,b\n"))
    refused("observed[0].speed.x_m: 150 lies outside the slope", [{"speed": {"x_m": 150, **mean}}])
    refused("observed[0].scars.from_m: -5 lies outside the slope", {"scars": {"from_m": -5, "to_m": 20, "height_m": [1]}})
    refused("-1 is below 0", {"scars": {"from_m": 5, "to_m": 20, "height_m": [-1]}})
    refused("-1 is below 0", {"largest": {"speed_m_s": {"values": [-1]}}})
    refused("give values, or their mean, sd and n", {"largest": {"speed_m_s": {"mean": 3}}})
    refused("observed[0].speed.mean", [{"speed": {"x_m": 50, "mean": "fast", "sd": 1, "n": 3}}])
    refused("observed[0].scars", [{"scars": {"from_m": 5, "height_m": [1]}}])
    accepted([{"scars": {"from_m": 5, "to_m": 20, "height_m": [1, 1, 1], "of": 2}}])
    unnamed = [{"forest": []}, {"name": "cut", "forest": []}]
    refused("options[0]: 'name' is missing", [{**STOPS, "option": "cut"}, STOPS], options=unnamed, forest=None)
    refused("the scene has no option 'bare'", [{**STOPS, "option": "bare"}], options=unnamed, forest=None)
    refused("items; at most", [STOPS] * 1001)


def test_draws_have_names():
    """A column of draws without a name, or with an unknown one"""
    draws = {"uncertainty": {"draws": "d.csv"}}
    accepted([], ("d.csv", "rock.density_kg_m3\n2600\n"), **draws)
    refused("the column '' is not a value of this scene; rename it", [], ("d.csv", "rock.density_kg_m3,\n2600,1\n"), **draws)
    refused("the column '2600' is not a value of this scene; rename it", [], ("d.csv", "\n2600\n"), **draws)
    refused("the column 'rock.size' is not", [], ("d.csv", "rock.density_kg_m3 rock.size\n2600\n"), **draws)


def test_others_do_not_mind():
    """Observations do not change a run; --option may drop their option"""
    with Folder() as f:
        forest = [{"name": n, "forest": []} for n in ("a", "b")]
        both = f.write("s.yaml", quarry([{**STOPS, "option": "b"}], options=forest, forest=None))
        plain = f.write("t.yaml", quarry([], options=forest, forest=None))
        for arguments in ((), ("--option", "a")):
            seen, without = (ceduo("-b", "-f", "csv", "-n", 200, *arguments, path) for path in (both, plain))
            expect_equal(seen.status, DONE, seen)
            expect_equal(seen.out.replace("s.yaml", "t.yaml"), without.out)


if __name__ == "__main__":
    run_all(__name__)
