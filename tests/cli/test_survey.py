#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""--survey: from a CSV of sample plots to a stand for scenes, and errors."""
import json
import math
import re
import statistics
from pathlib import Path

from harness import DONE, INPUT, PROFILES, USAGE, Folder, ceduo, environment, expect, expect_equal, expect_in, expect_near, good, run_all, scene

HEAD = "plot,area_m2,slope_deg,species,kind,stool,dbh_cm,height_m,spacing_m"
STEMS = {  # plot: (area, slope, [(species, kind, stool, dbh, height, spacing)])
    "A": (200, 35, [("ostrya-carpinifolia", "shoot", 1, 6.2, 6.4, 0.3), ("ostrya-carpinifolia", "shoot", 1, 7.1, "", ""),
                    ("ostrya-carpinifolia", "shoot", 2, 5.5, 6.0, ""), ("quercus-cerris", "standard", "", 22.4, 12.5, "")]),
    "B": (150, 0, [("ostrya-carpinifolia", "shoot", 1, 8.8, 7.9, ""), ("ostrya-carpinifolia", "shoot", 1, 6.6, 6.7, 0.4),
                   ("ostrya-carpinifolia", "shoot", 3, 9.9, 8.3, ""), ("quercus-cerris", "standard", "", 24.1, 13.0, ""),
                   ("quercus-cerris", "tree", "", 12.0, 9.0, "")]),
    "C": (200, 30, []),
}


def table(stems=STEMS, separator=",", comma=False, head=HEAD):
    rows = [head.replace(",", separator)]
    for plot, (area, slope, list_of_stems) in stems.items():
        for i, stem in enumerate(list_of_stems or [("",) * 6]):
            cells = [plot, *((area, slope) if i == 0 else ("", "")), *stem]
            rows.append(separator.join(str(c).replace(".", ",") if comma else str(c) for c in cells))
    return "\n".join(rows) + "\n"


def survey(f, content, *arguments, **more):
    return ceduo("--survey", f.write("plots.csv", content), *arguments, **more)


def read(*arguments, **more):
    """Read a survey: its standard error is the line of understanding, which is the first comment."""
    r = ceduo("--survey", *arguments, **more)
    expect_equal(r.status, DONE, r)
    expect_equal(len(r.err.splitlines()), 1, r)
    if r.out:
        expect_equal(r.out.splitlines()[0], "# " + r.err.rstrip("\n"), r)
    return r


def read_stand(f, text):
    """Return the stand as the program reads it: --set accepts YAML, and JSON of the scene's stands has its figures."""
    f.write("stand.yaml", text)
    site = scene(slope={"vertices_m": [[0, 70], [100, 0]], "segments": [{"rn": 0.3, "rt": 0.9}]}, controls=[{"x_m": 90}],
                 forest=[{"from_m": 0, "to_m": 60, "stand": "stand.yaml"}])
    path = f.write("s.yaml", site)
    expect_equal(ceduo("--check", path).status, DONE, ceduo("--check", path).err)
    r = ceduo("--batch", "-n", 20, "-f", "json", path)
    return json.loads(r.out)["options"][0]["stands"][0], path


def without_comments(text):
    return [line for line in text.splitlines() if not line.startswith(("#", "name:"))]


def mean_and_error(pick):
    """Return mean and standard error over the plots, per hectare of the map"""
    each = [len(pick(stems)) / (area * math.cos(math.radians(slope))) * 10000 for area, slope, stems in STEMS.values()]
    return statistics.mean(each), statistics.stdev(each) / math.sqrt(len(each))


def select_kinds(*kinds):
    return lambda stems: [s for s in stems if s[1] in kinds]


def stools(stems):
    return {s[2] for s in stems if s[1] == "shoot"}


def gamma_share(x, mean, sd):
    """Return the gamma probability below x for this mean and deviation, by its series."""
    shape, scale = (mean / sd) ** 2, sd**2 / mean
    term = total = 1 / shape
    for n in range(1, 500):
        term *= x / scale / (shape + n)
        total += term
    return total * math.exp(shape * math.log(x / scale) - x / scale - math.lgamma(shape))


def test_densities():
    """Stools, shoots and trees per hectare of the map, with one empty plot; standard errors are the uncertainty"""
    with Folder() as f:
        text = survey(f, table()).out
        stand, path = read_stand(f, text)
        expect_near(stand["stools_per_ha"], mean_and_error(stools)[0], 1e-3)
        expect_near(stand["stems_per_ha"], mean_and_error(select_kinds("shoot", "standard", "tree"))[0], 1e-2)
        expect_near(stand["trees_per_ha"], mean_and_error(select_kinds("standard", "tree"))[0], 1e-2)
        r = ceduo("--sensitivity=2", "-n", 20, "-f", "json", path)
        inputs = {i["path"]: i for i in json.loads(r.out)["figures"][0]["inputs"]}
        mean, se = mean_and_error(stools)
        expect(se > mean / 3, "a gamma law where the error is above a third of the mean", mean, se)
        found, normal = inputs["forest[0].stand.stools.per_ha"], (1 + math.erf(-3 / math.sqrt(2))) / 2
        for end, share in (("lo", normal), ("hi", 1 - normal)):  # three standard deviations of a normal law
            expect_near(gamma_share(found[end], mean, se), share, 1e-5, end)
        expect_in("forest[0].stand.trees[1].per_ha", list(inputs))
        expect_in("stools.spacing_m, mean: 0.35, sd: 0.05", text)  # mean of 0.3 and 0.4
        expect_in("; spacing on 2 of them", text)


def test_rare():
    """A class with an error of its mean/2.5 has a gamma law, which stays above 0; an interval below 0 starts at 0"""
    with Folder() as f:
        for plots, with_one, below in ((9, 4, False), (5, 2, True)):  # k of n plots have one tree
            rows = [f"{i},100,0,,tree,,20,12," if i < with_one else f"{i},100,0,,,,,," for i in range(plots)]
            text = survey(f, "\n".join([HEAD, *rows]) + "\n").out
            each = [100] * with_one + [0] * (plots - with_one)
            mean, se = statistics.mean(each), statistics.stdev(each) / math.sqrt(plots)
            line = next(row for row in text.splitlines() if row.startswith("# tree"))
            half = {9: 2.306004, 5: 2.776445}[plots] * se  # Student, 8 and 4 degrees of freedom
            expect_equal(mean < half, below)
            expect_in(f" {max(0, mean - half):.0f} to {mean + half:.0f}", line)
            _, path = read_stand(f, text)
            if below:
                continue
            expect(2 * se < mean < 3 * se, mean, se)
            found = json.loads(ceduo("--sensitivity=2", "-n", 20, "-f", "json", path).out)["figures"][0]["inputs"]
            tree = next(i for i in found if i["path"] == "forest[0].stand.trees[0].per_ha")
            normal = (1 + math.erf(-3 / math.sqrt(2))) / 2
            expect_near(gamma_share(tree["lo"], mean, se), normal, 1e-5)
            expect_near(gamma_share(tree["hi"], mean, se), 1 - normal, 1e-5)


def test_same_bytes():
    """An Italian spreadsheet, other words, CRLF, a mark, tabs and another language give equal bytes, except comments and texts"""
    with Folder() as f:
        wanted = survey(f, table()).out
        italian = "saggio,superficie_m2,pendenza_gradi,specie,tipo,ceppaia,diametro_cm,altezza_m,distanza_m"
        german = "Probefl\u00e4che,Fl\u00e4che_m2,Neigung_Grad,Baumart,Typ,Stock,BHD_cm,H\u00f6he_m,Abstand_m"
        words = table(separator=";", comma=True, head=italian)
        for english, other in (("shoot", "pollone"), ("standard", "Matricina"), ("tree", "allievo")):
            words = words.replace(english, other)
        for content in (table(separator=";", comma=True, head=italian), words, table(separator=";", comma=True, head=german),
                        table().replace("\n", "\r\n"), "\ufeff" + table(), table(separator="\t"),
                        table().replace("ostrya-carpinifolia", "Ostrya carpinifolia").replace("quercus-cerris", "Turkey oak"),
                        table().replace("quercus-cerris", "quercus_cerris")):
            expect_equal(survey(f, content).out.replace("; decimal commas", ""), wanted, content)
        italian = survey(f, table(), "--language", "it").out
        expect_in("# ceppaie ", italian)
        expect_in("matricine da 20 a 25 cm, n = 2", italian)
        expect_equal(*(re.sub(r"text: .*", "", "\n".join(without_comments(text))) for text in (italian, wanted)))
        expect_equal(ceduo("--survey", "-", stdin=table().encode()).out, wanted.replace("plots.csv", "survey", 1)
                     .replace("name: plots", "name: survey"))


SHEETS = Path(__file__).resolve().parent / "cases/surveys"


def test_offices():
    """Sheets of offices: titles, totals, joined cells, empty lines, units, plurals, letters, percent, UTF-16, Windows-1252"""
    with Folder() as f:
        texts = {name: read(str(SHEETS / f"{name}.csv")).out for name in ("windows", "unicode", "english", "telephone", "codes")}
        plots = ((200 * math.cos(math.radians(45)), 3, 5, 1), (150, 2, 3, 2))  # m2 of the map, stools, shoots, standards
        stools, shoots, standards = (statistics.mean(p[k] / p[0] * 10000 for p in plots) for k in (1, 2, 3))
        for name, text in texts.items():
            stand, _ = read_stand(f, text)
            expect_near(stand["stools_per_ha"], stools, 1e-3, name)
            expect_near(stand["trees_per_ha"], standards, 1e-3, name)
            expect_near(stand["stems_per_ha"], shoots + standards, 1e-2, name)
        for name in ("unicode", "english", "codes"):
            expect_equal(without_comments(texts[name]), without_comments(texts["windows"]), name)
        expect_in("; 2 rows of totals left out; 9 rows without a plot belong to the plot above; decimal commas; not used: Note\n",
                  texts["windows"])
        expect_in("; not used: ora\n", texts["telephone"])


def test_no_heights():
    """Standards without heights use the shoots' curve, others the default one; assumed, with uncertain volume"""
    with Folder() as f:
        text = read(str(SHEETS / "telephone.csv")).out
        a, b = (float(x) for x in re.search(r"d2/\(([0-9.]+) \+ ([0-9.]+) d\)2", text).groups())
        row = next(line for line in text.splitlines() if "dbh_m: 0.275" in line)
        expect_near(float(re.search(r"height_m: ([0-9.]+)", row)[1]), 1.3 + (27.5 / (a + b * 27.5)) ** 2, 5e-3)
        volume = float(re.search(r"volume_m3: ([0-9.]+)", row)[1])
        rows = "".join(f"{p},200,0,quercus-cerris,{kind},{d},,\n" for p in "AB" for kind, d in (("shoot,1", 6), ("tree,", 21)))
        usual = survey(f, HEAD + "\n" + rows).out
        for kind, height in (("shoots", 1.3 + (6 / (1.2 + 0.22 * 6)) ** 2), ("trees", 1.3 + (21 / (2.4 + 0.186 * 21)) ** 2)):
            line = next(x for x in usual.split(f"{kind}:\n")[1].splitlines())
            expect_near(float(re.search(r"height_m: ([0-9.]+)", line)[1]), height, 1e-4)
        expect_equal(usual.count("heights measured: 0 of "), 2)
        read_stand(f, usual)
        _, path = read_stand(f, text)
        found = {i["path"]: i for i in json.loads(good("--sensitivity=2", "-n", 20, "-f", "json", path).out)["figures"][0]["inputs"]}
        volumes = found["forest[0].stand.trees[1].volume_m3"]
        expect_near(volumes["lo"], 0.7 * volume, 1e-5)
        expect_near(volumes["hi"], 1.3 * volume, 1e-5)


def test_words():
    """Other species become none, a dash is empty, and common names may be in any case"""
    with Folder() as f:
        wanted = survey(f, HEAD + "\n" + ROW.replace("35,,", "35,,") + ROW.replace("35,,tree", "35,quercus-pubescens,tree")).out
        expect_equal(survey(f, HEAD + "\n" + ROW.replace("35,,", "35,Altre latifoglie,") +
                            ROW.replace("35,,tree", "35,ROVERELLA,Alberi").replace(",12,", ",12,-")).out, wanted)


def test_template():
    """The empty sheet is a survey in either language, with equal examples"""
    with Folder() as f:
        english, italian = good("--survey", "--template").out, good("--survey", "--template", "--language", "it").out
        expect_in("saggio;area_m2;", italian)
        expect_in(";6,5;7,2;", italian)
        read_stand(f, survey(f, english).out)
        expect_equal(survey(f, italian).out.replace("; decimal commas", ""), survey(f, english).out)
        good("--survey", "--template", "-o", str(f.path / "sheet.csv"))
        expect_equal((f.path / "sheet.csv").read_text(), english)


def test_told_once():
    """An error repeated in many rows is reported once, with the number of rows"""
    with Folder() as f:
        r = survey(f, HEAD + "\n" + ROW.replace("tree", "bush") * 40)
        expect_equal(r.err.count("is not a kind of stem"), 1, r.err)
        expect_in("39", r.err)


def test_areas():
    """A radius equals an area; 400 m2 along 40 degrees are 306.418 m2 on the map"""
    with Folder() as f:
        one = "1,{},40,,tree,,20,12\n2,{},40,,tree,,20,12\n2,,,,tree,,21,12\n"
        head = "plot,{},slope_deg,species,kind,stool,dbh_cm,height_m\n"
        by_area = survey(f, head.format("area_m2") + one.format(400, 400)).out
        radius = math.sqrt(400 / math.pi)
        expect_equal(survey(f, head.format("radius_m") + one.format(radius, radius)).out, by_area)
        stand, _ = read_stand(f, by_area)
        expect_near(stand["trees_per_ha"], 1.5 * 10000 / 306.4178, 1e-3)


def test_heights():
    """With five heights missing ones lie on Naslund's curve; with fewer they are the mean, and marked"""
    with Folder() as f:
        def naslund(d):
            return 1.3 + (d / (1.2 + 0.25 * d)) ** 2
        rows = [f"1,500,,,tree,,{d},{naslund(d)}" for d in (11, 16, 22, 27, 33)] + ["1,,,,tree,,41,", "2,500,,,tree,,41,"]
        head = "plot,area_m2,slope_deg,species,kind,stool,dbh_cm,height_m"
        text = survey(f, "\n".join([head, *rows])).out
        expect_in("5 measured; 2 by", text)
        expect_in(f"dbh_m: 0.41, height_m: {naslund(41):.6g},", text)
        text = survey(f, "\n".join([head, *rows[:3], *rows[5:]])).out
        expect_in(f"height_m: {statistics.mean(naslund(d) for d in (11, 16, 22)):.6g}", text)
        expect_in("heights measured: 3 of 5", text)
        expect_equal(text.count("kind: assumed"), 4, text)  # each class of trees


def test_beyond_the_heights():
    """Stems thicker than any measured one are counted; a curve with impossible heights is refused, not written"""
    with Folder() as f:
        def steep(d):
            return 1.3 + (d / (2.9 + 0.01 * d)) ** 2
        rows = [f"1,500,,,tree,,{d},{steep(d)}" for d in (5, 6, 7, 8, 9)]
        head = "plot,area_m2,slope_deg,species,kind,stool,dbh_cm,height_m"
        text = survey(f, "\n".join([head, *rows, "1,,,,tree,,9,", "1,,,,tree,,31,", "1,,,,tree,,35,"])).out
        expect_in("thicker than any of the measured: 2\n", text)
        expect_in(f"dbh_m: 0.31, height_m: {steep(31):.6g},", text)
        read_stand(f, text)
        r = survey(f, "\n".join([head, *rows, "1,,,,tree,,9,", "1,,,,tree,,41,"]))
        expect_equal((r.status, r.out), (INPUT, ""), r.err)
        expect_in(f"a stem of 41 cm is {steep(41):.0f} m tall, more than 150 m; measure heights of thick stems, too", r.err)


def test_what_is_assumed():
    """An unmeasured spacing, volumes outside an equation, a single plot: each is reported and marked"""
    with Folder() as f:
        text = survey(f, table().replace(",0.3\n", ",\n").replace(",0.4\n", ",\n")).out
        expect_in("spacing_m: 0.35", text)
        expect_in("kind: assumed, text: \"n = 4; the spacing of the shoots was not measured", text)
        thin = table().replace(",6.2,6.4,", ",3.2,4,").replace("plot", "plot", 1)
        text = survey(f, thin).out
        expect_in("1 of 1 shoots of 0 to 5 cm lie outside the equation of their species", text)
        line = next(row for row in text.splitlines() if "dbh_m: 0.032" in row)
        expect("volume_m3" not in line, line)  # the program uses the form factor, and reports it
        one = {"A": STEMS["A"]}
        text = survey(f, table(one)).out
        expect_in("One plot has no standard error", text)
        expect("uncertainty:" not in text, text)
        expect_in("one plot, no standard error", text)
        read_stand(f, text)
        two = {"A": (200, 0, [("ostrya-carpinifolia", "shoot", n, 6.2, 6.4, 0.3 + n / 10) for n in (1, 2)])}
        paths = re.findall(r"path: ([^,}]*)", survey(f, table(two)).out.split("uncertainty:")[1])
        expect_equal(paths, ["stools.spacing_m"], "of two stools of one plot the spacing alone has an error")


def test_any_order():
    """Rows may come in any order, with any stool names and file name"""
    with Folder() as f:
        rows = [f"{plot},100,0,,shoot,{stool},{5 + stool / 10},6,\n" for stool in range(1, 13) for plot in "BA"]
        text = survey(f, HEAD + "\n" + "".join(rows)).out
        stand, _ = read_stand(f, text)
        expect_near(stand["stools_per_ha"], 1200, 1e-9)
        for name in ("plots.txt", "p"):
            other = ceduo("--survey", f.write(name, HEAD + "\n" + "".join(sorted(rows)))).out
            # the mean is summed in another order
            expect_equal(other.splitlines()[1:6], text.splitlines()[1:6], name)
            expect_in(f"name: {name}\n", other)


def test_other_species():
    """A class with stems of another species outside its equation gets a volume, and is marked"""
    with Folder() as f:
        main = "A,200,0,quercus-cerris,tree,,30,15,\nB,200,0,quercus-cerris,tree,,31,15,\n"
        for rows, wanted in (("A,,,quercus-ilex,tree,,5.5,6.5,\n", "n = 1; volume of 1"),
                             ("A,,,quercus-ilex,tree,,5.5,6.5,\nA,,,quercus-cerris,tree,,6,7,\n", "n = 2; volume of 1")):
            line = next(row for row in survey(f, HEAD + "\n" + main + rows).out.split("  - ") if wanted in row)
            expect_in("volume_m3: ", line)
            expect_in("kind: assumed", line)
        text = survey(f, HEAD + "\n" + main + "A,,,quercus-ilex,tree,,3.5,4,\n").out  # the form factor is the program's own
        line = next(row for row in text.split("  - ") if "n = 1; volume of 1" in row)
        expect("volume_m3" not in line and "kind: measured" in line, line)


def test_stumps():
    """Stumps are counted, and their energy is required"""
    with Folder() as f:
        text = survey(f, table() + "A,,,,stump,,30,0.2,\nB,,,,ceppo,,20,,\n").out
        expect_in("# stumps: {per_ha: ", text)
        expect_in("diameter_m: 0.25, height_m: 0.2, energy_kJ: ?}", text)
        read_stand(f, text)
        rows = "A,,,,stump,,30,0.2,,2\nB,,,,ceppo,,20,,,\nC,,,,stump,,20,0.4,,4\n"
        text = survey(f, table().replace("\n", ",\n").replace(f"{HEAD},", f"{HEAD},energy_kJ") + rows).out
        each = [10000 / (area * math.cos(math.radians(slope))) for area, slope, _ in STEMS.values()]
        expect_in(f"stumps: {{per_ha: {statistics.mean(each):.6g}, diameter_m: 0.233333, height_m: 0.3, energy_kJ: 3,", text)
        expect_in("kind: assumed, text: \"counted; the energy that one absorbs", text)
        expect_in(f"path: stumps.per_ha, mean: {statistics.mean(each):.6g}, sd: {statistics.stdev(each) / math.sqrt(3):.6g}", text)
        _, path = read_stand(f, text)
        r = ceduo("--sensitivity=2", "-n", 20, "-f", "json", path)
        expect_in("forest[0].stand.stumps.per_ha", [i["path"] for i in json.loads(r.out)["figures"][0]["inputs"]])
        expect_in("height_m: ?, energy_kJ: ?}", survey(f, table() + "A,,,,stump,,30,,\n").out)
        alone = survey(f, HEAD + ",energy_kJ\nA,200,,,stump,,30,0.2,,2\nB,200,,,,,,,,\n").out
        expect("system: bare" not in alone, alone)
        read_stand(f, alone)
        rows = "A,200,,ostrya-carpinifolia,tree,,20,12,\nA,,,quercus-cerris,tree,,10,9,\nA,,,quercus-cerris,stump,,40,0.2,\n"
        expect_in("# basal area: hop hornbeam 80 %, Turkey oak 20 %\n", survey(f, f"{HEAD}\n{rows}").out, "of stems that stand: 400 to 100 cm2")


def test_bare():
    """Plots without a stem are a stand without stems"""
    with Folder() as f:
        text = survey(f, HEAD + "\nA,200,,,,,,,\nB,200,,,,,,,\n").out
        expect_in("system: bare", text)
        read_stand(f, text)


def test_columns():
    """Unknown columns are reported, with likely names; they are no error"""
    with Folder() as f:
        def more(head):
            return survey(f, "".join(f"{row},{head if i == 0 else 'x'}\n" for i, row in enumerate(table().splitlines()))).out
        for head in ("weather", "weather" * 20):
            expect_in(f"; not used: {head}\n", more(head))
        r = survey(f, table().replace("slope_deg", "slope_degr"))
        expect_equal(r.status, DONE, r)
        expect_in("; not used: slope_degr\n", r.out)


def test_by_name():
    """A shipped survey is found by its name, with and without .csv, like a scene"""
    with Folder() as f:
        wanted = read("six-plots.csv", cwd=f.path).out
        expect_equal(read("six-plots", cwd=f.path).out, wanted)
        r = ceduo("--survey", "five-plots", cwd=f.path)
        expect_equal(r.status, INPUT, r)


def test_output():
    """-o writes the stand; the survey itself is not overwritten"""
    with Folder() as f:
        wanted = survey(f, table()).out
        expect_equal(survey(f, table(), "-o", "out.yaml", cwd=f.path).out, "")
        expect_equal((f.path / "out.yaml").read_text(), wanted)
        r = ceduo("--survey", "plots.csv", "-o", "./plots.csv", cwd=f.path)
        expect_equal(r.status, 4, r)
        expect_equal((f.path / "plots.csv").read_text(), table())


ROW = "A,200,35,,tree,,20,12,\n"
BAD = [  # (content, place, words)
    ("", "", "the file is empty"), ("x\n1\n", ":1:1", "must name the column 'plot'"),
    ("plot,kind\nA,tree\n", ":1:1", "'dbh_cm'"), ("plot,kind,dbh_cm\nA,tree,3\n", ":1:1", "'area_m2' or 'radius_m'"),
    ("plot,plot,area_m2,kind,dbh_cm\n", ":1:1", "'plot' occurs twice"), (HEAD + "\n", "", "the table has no row"),
    (HEAD + "\n" + ROW.replace("A", "", 1), ":2:1", "'plot' is missing"),
    (HEAD + "\n" + ROW.replace("200", ""), ":2:1", "no area_m2 and no radius_m"),
    (HEAD + "\n" + ROW.replace("200", "0"), ":2:3", "0 is outside the range 1 to 1e+06 m2"),
    (HEAD + "\n" + ROW.replace("200", "-5"), ":2:3", "-5 is outside the range 1 to 1e+06 m2"),
    (HEAD + "\n" + ROW.replace("200", "1e9"), ":2:3", "outside the range 1 to 1e+06 m2"),
    (HEAD + "\n" + ROW.replace("200", "much"), ":2:3", "'much' is not a number"),
    (HEAD + "\n" + ROW.replace("35", "95"), ":2:7", "95 is outside the range 0 to 76 degrees"),
    (HEAD + "\n" + ROW + ROW.replace("200", "300"), ":3:3", "'area_m2' is 200 in another row of this plot, here 300"),
    (HEAD + "\n" + ROW + ROW.replace("35", "36"), ":3:7", "'slope_deg' is 35 in another row of this plot, here 36"),
    (HEAD.replace("slope_deg", "radius_m") + "\n" + ROW, ":2:7", "area_m2 already says this"),
    (HEAD + "\n" + ROW.replace("tree", "bush"), ":2:11", "'bush' is not a kind of stem; write shoot, standard, tree or stump"),
    (HEAD + "\n" + ROW.replace("tree", ""), ":2:11", "'' is not a kind of stem"),
    (HEAD + "\n" + ROW.replace(",,tree", ",oak,tree"), ":2:10", "'oak' is an unknown species; leave it empty, or one of: hop hornbeam"),
    (HEAD + "\n" + ROW.replace(",20,", ",,"), ":2:17", "'dbh_cm' is missing"),
    (HEAD + "\n" + ROW.replace(",20,", ",0,"), ":2:17", "0 is outside the range 0.1 to"),
    (HEAD + "\n" + ROW.replace(",20,", ",750,"), ":2:17", "750 cm is more than 300 cm; name the column"),
    (HEAD + "\n" + ROW.replace(",20,", ",300.5,"), ":2:17", "300.5 cm is more than 300 cm; name the column"),
    (HEAD + "\n" + ROW.replace("tree,,20,12", "stump,,301,1"), ":2:18", "301 cm is more than 300 cm; name the column"),
    (HEAD + "\n" + ROW.replace(",20,", ",2e6,"), ":2:17", "2e6 is outside the range 0.1 to 3000 cm"),
    (HEAD + "\n" + ROW.replace(",20,", ",nan,"), ":2:17", "'dbh_cm' is missing"),
    (HEAD + "\n" + ROW.replace(",12,", ",1.2,"), ":2:20", "1.2 m is outside the range of heights here (above 1.3, at most 150 m)"),
    (HEAD + "\n" + ROW.replace(",12,", ",1.3,"), ":2:20", "1.3 m is outside the range of heights here"),
    (HEAD + "\n" + ROW.replace(",12,", ",-1,"), ":2:20", "-1 is outside the range 0 to"),
    (HEAD.replace("dbh_cm", "Diametro (in)") + "\n" + ROW, ":1:43", "this column must be in cm or mm; convert"),
    (HEAD.replace("slope_deg", "Pendenza (%)") + "\n" + ROW.replace("35", "1200"), ":2:7", "1200 is outside the range 0 to 401.078 %"),
    ("Plots;\n" + HEAD.replace(",", ";").replace("kind;", "") + "\n", ":2:1", "must name the column 'kind'"),
    (HEAD + "\n" + ROW.replace("tree", "shoot"), ":2:17", "the stool of this shoot is missing"),
    (HEAD + "\n" + ROW.replace(",12,", ",12,0.3"), ":2:23", "a stem of this kind has no 'spacing_m'"),
    (HEAD + "\n" + ROW.replace("tree,,20,12,", "shoot,1,6,5,0"), ":2:23", "0 is outside the range 0.01 to"),
    (HEAD + "\n" + ROW.replace("tree,,20,12", "stump,,20,0"), ":2:21", "0 m is outside the range of heights here (above 0, at most 20 m)"),
    (HEAD.replace(",", ";") + "\n" + ROW.replace(",", ";").replace("20;12", "20,5;1.2e1"), ":2:22", "use one sign in the whole table"),
    (HEAD + "\nA,1,,,tree,,20,12,\n" + "A,,,,tree,,20,12,\n" * 101, ":1:6", "check that areas are in m2 and diameters in cm"),
    (HEAD + ",energy_kJ\n" + ROW.replace("\n", ",3\n"), ":2:24", "a stem of this kind has no 'energy_kJ'"),
    (HEAD + ",energy_kJ\n" + ROW.replace("tree", "stump").replace("\n", ",x\n"), ":2:25", "'x' is not a number"),
    (HEAD.replace("area_m2", "radius_m") + "\n" + ROW.replace("200", "-1"), ":2:3", "-1 is outside the range 0.5 to 500 m"),
    (HEAD + "\n" + ROW.replace("tree", "b" * 120), ":2:11", "b' is not a kind of stem"),
    (HEAD + "\n" + ROW.replace(",,tree", "," + "o" * 120 + ",tree"), ":2:10", "o' is an unknown species"),
    (HEAD + "\n" + ROW.replace("tree,,20,12", "stump,,20,21"), ":2:21", "at most 20 m"),
    (HEAD + ",count\n" + ROW.replace("200,35", "1,0").replace("20,12,", "0.1,,,200"), "",
     "2000000 stems per hectare of one class exceed the limit of 1000000; check that the areas are in m2"),
    (HEAD + "\n" + ROW + "A,,,,,,,,\n" * 200000, ":200002:1", "more than 200000 rows"),
    ("\n".join([HEAD] + [f"P{i},200,,,,,,," for i in range(1001)]), ":1002:1", "more than 1000 plots"),
]


def test_bad():
    """Errors are reported with file, row and column; nothing is written"""
    with Folder() as f:
        for content, place, words in BAD:
            r = survey(f, content, "-o", str(f.path / "none.yaml"))
            expect_equal(r.status, INPUT, (content, r))
            expect_in(words, r.err, content)
            expect_in((f"plots.csv{place}: " if place else "plots"), r.err, content)
            expect_equal(r.out, "")
            expect(not (f.path / "none.yaml").exists(), content)
        r = ceduo("--survey", "not-there.csv")
        expect_equal(r.status, INPUT, r)


def test_bad_in_italian():
    """Errors use the words of an Italian sheet and commas in numbers; a workbook is recognized"""
    english = re.compile(r"area_m2|radius_m|slope_deg|dbh_cm|spacing_m|energy_kJ|\bshoot|\bstandard\b|stump|degrees|ostrya|\d\.\d")
    with Folder() as f:
        for content, _, words in BAD:
            told = survey(f, content, "--language", "it").err.splitlines()[0].split("; ci sono: ")[0]
            expect(not english.search(told.split(":", 1)[1].replace("'1.2e1'", "")), words, told)
        for begin in (b"PK\3\4\x14\0\6\0", b"\xd0\xcf\x11\xe0\xa1\xb1"):
            (f.path / "plots.xlsx").write_bytes(begin + bytes(99))
            expect_in("salvare il foglio come CSV", ceduo("--survey", f.path / "plots.xlsx", "--language", "it").err)


def test_thick():
    """A stem of 300 cm is accepted; for a thicker one the unit is asked, in Italian, too"""
    with Folder() as f:
        expect_in("dbh_m: 3,", survey(f, HEAD + "\n" + ROW.replace("200", "2000").replace(",20,", ",300,")).out)
        r = survey(f, HEAD + "\n" + ROW.replace(",20,", ",750,"), "--language", "it")
        expect_equal(r.status, INPUT, r)
        expect_in("plots.csv:2:17: 750 cm sono pi\u00f9 di 300 cm; chiamare la colonna", r.err)


def test_thin():
    """Two stems that differ by more than their mean get it as their spread, which a stand accepts"""
    with Folder() as f:
        text = survey(f, HEAD + "\nA,200,0,,tree,,0.2,1.5,\nA,,,,tree,,4.9,5,\n").out
        expect(statistics.stdev((0.2, 4.9)) > 2.55)
        expect_in("dbh_m: 0.0255, dbh_sd_m: 0.0255,", text)
        read_stand(f, text)


def test_many_wrong():
    """All errors are reported together"""
    with Folder() as f:
        r = survey(f, HEAD + "\n" + ROW.replace("tree", "bush") + ROW.replace(",20,", ",x,") + ROW.replace(",12,", ",1,"))
        for place in (":2:11:", ":3:17:", ":4:20:"):
            expect_in(place, r.err)


SCRIPT = """resize 110 60
key p
type from a survey
key Enter
type {}
key Enter
wait idle
dump -
key s
wait idle
"""


def test_terminal():
    """p presets, from a survey: the belt's stand equals that of --survey; errors are reported, and nothing changes"""
    with Folder() as f:
        wanted = survey(f, table()).out
        f.write("bad.csv", table().replace("6.2", "x"))
        f.write("stand.yaml", wanted)
        site = scene(slope={"vertices_m": [[0, 70], [100, 0]], "segments": [{"rn": 0.3, "rt": 0.9}]}, controls=[{"x_m": 90}],
                     forest=[{"from_m": 0, "to_m": 60, "stand": {"trees": [{"per_ha": 9, "dbh_m": 0.2, "height_m": 9}]}}])
        for name in ("plots.csv", "bad.csv"):
            f.write("s.yaml", site)
            before = (f.path / "s.yaml").read_text()
            f.write("keys", SCRIPT.format(name))
            r = ceduo("--script", "keys", "s.yaml", cwd=f.path)
            expect_equal(r.status, DONE, r)
            if name == "bad.csv":
                expect_in("'x' is not a number", r.out)
                expect_equal((f.path / "s.yaml").read_text(), before)
                continue
            expect_in("growth and cutting are assumed: check them", r.out)
            stands = [json.loads(ceduo("--batch", "-n", 20, "-f", "json", *sets, "s.yaml", cwd=f.path).out)["options"][0]["stands"]
                      for sets in ([], ["-s", "forest[0].stand=stand.yaml"])]
            expect_equal(stands[0], stands[1])
            expect_in("stools.per_ha", (f.path / "s.yaml").read_text())


def print_future(stems, *arguments):
    """Return the part between the stems and the source of the stand."""
    with Folder() as f:
        out = read(f.write("plots.csv", table({"A": (100, 0, stems), "B": (100, 0, stems)})), *arguments).out
    return re.search(r"(?ms)^ +source: [^\n]*\n(# Growth.*?|# ceduo has.*?|)^source:", out)[1]


def test_future():
    """Growth and cutting are those of the shipped stand of the main species by basal area and standards; marked, with a comment"""
    def stems(species, standards, dbh=20):
        return [(species, "shoot", 1, 6.2, 6.4, 0.3)] * 3 + [(species, "standard", "", dbh, 12, "")] * standards

    prefixes = {"ostrya-carpinifolia": "", "fagus-sylvatica": "beech-", "castanea-sativa": "chestnut-", "fraxinus-ornus": "manna-ash-",
                "quercus-pubescens": "oak-downy-", "quercus-cerris": "oak-turkey-"}
    cases = [(species, 0, 20, f"{prefix}simple-coppice") for species, prefix in prefixes.items()]
    cases += [("ostrya-carpinifolia", 1, 20, "coppice-with-standards"),  # 100 a hectare, 3.1 m2
              ("fagus-sylvatica", 3, 19.8, "beech-coppice-with-standards"), ("fagus-sylvatica", 3, 19.9, "beech-large-reserves")]
    for species, standards, dbh, name in cases:
        text = print_future(stems(species, standards, dbh))
        expect_in(f"as in the shipped stand '{name}'", text)
        expect_equal(text.count("kind: assumed"), 2, text)
        shipped = {}
        for key in ("growth", "cutting"):  # a file overrides its base
            for file in ([] if name == name.removeprefix(prefixes[species]) else [name.removeprefix(prefixes[species])]) + [name]:
                block = re.search(rf"(?m)^{key}:\n((?:  .*\n)+)", (PROFILES / "stands" / f"{file}.yaml").read_text())
                shipped |= dict(re.findall(r"(?m)^  (\w+): (.*)$", block[1] if block else ""))
        shipped.pop("source")
        found = dict(re.findall(r"(?m)^  (\w+): (.*)$", text))
        found.pop("source")
        stay, kept = (json.loads(x.pop("stay_per_ha")) for x in (shipped, found))
        expect_equal(found, shipped, name)
        expect_equal(kept, [round(n * 100 * standards / sum(stay)) for n in stay] if standards else stay, f"{name}: as many as counted")
    with Folder() as f:  # nine in ten plots are empty: fewer than 90 per hectare
        one = {f"P{i}": (100, 0, stems("ostrya-carpinifolia", 8) if i == 0 else []) for i in range(10)}
        expect_in("'simple-coppice'", survey(f, table(one)).out)
    expect_in("# ceduo has no stand of this species", print_future(stems("robinia-pseudoacacia", 1)))
    expect_in("# ceduo has no stand of this species", print_future(stems("", 1)))
    expect_equal(print_future([("fagus-sylvatica", "tree", "", 30, 20, "")]), "", "no shoots")


def test_years_of_a_survey():
    """A scene with the stand of six-plots.csv has years: cut now with some retained, as a selection coppice, not cut"""
    with Folder() as f:
        f.write("stand.yaml", read("six-plots").out)
        site = f.write("s.yaml", scene(
            slope={"vertices_m": [[0, 70], [100, 0]], "segments": [{"rn": 0.3, "rt": 0.9}]}, controls=[{"x_m": 90, "accepted_kJ": 50}],
            forest=[{"from_m": 0, "to_m": 60, "stand": "stand.yaml"}]))

        def years(*sets):
            r = good("--batch", "-n", 20, "-f", "json", "--years", "0:26", *(x for s in sets for x in ("-s", f"forest[0].{s}")), site)
            return json.loads(r.out)["options"][0]["years"]

        cut = years("cut_year=0", "stand.cutting.stay_per_ha=[30, 30]")
        expect_equal([y["year"] for y in cut if y["cut"]], [0, 25], "cut now, and again")
        expect_equal({(round(y["stands"][0]["trees_per_ha"]), round(y["stands"][0]["stools_per_ha"])) for y in cut if not y["cut"]},
                     {(60, 597)}, "60 stay, and all stools sprout")
        selection = years("cut_year=0", "stand.cutting={rotation_years: 13, cohorts: 3, stay_per_ha: [0, 0, 0, 40]}",
                          "stand.growth.shoots_old=6")
        expect_equal([y["year"] for y in selection if y["cut"]], [0, 13, 26], "selection")
        expect(all(y["stands"][0]["stools_per_ha"] > 590 for y in selection), "shoots stay on each stool")
        waiting = years("cut_year=1000")
        expect_equal([y for y in waiting if y["cut"]], [], "not cut")
        areas = [y["stands"][0]["basal_area_m2_ha"] for y in waiting]
        expect(all(a < b for a, b in zip(areas, areas[1:])), f"it grows: {areas}")
        page = " ".join(good("--batch", "--details", "--years", "-s", "uncertainty=none", "-n", 20, site).out.split())
        expect_in("not from this survey (growth", page)


def test_usage():
    """Options incompatible with --survey are named"""
    with Folder() as f:
        for arguments, words in ((["-n", 3], "--survey cannot be used with --rocks"), (["-f", "json"], "--format"),
                                 (["s.yaml"], "no scene: 's.yaml'"), (["--batch"], "--batch"), (["--check"], "--check")):
            r = survey(f, table(), *arguments)
            expect_equal(r.status, USAGE, r)
            expect_in(words, r.err)
        expect_equal(ceduo("--survey").status, USAGE)


if __name__ == "__main__":
    run_all(__name__)
