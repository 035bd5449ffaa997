#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Surveys as offices write them: read correctly, with densities by hand, or refused with a working remedy."""
import math
import re
from pathlib import Path

from harness import DONE, INPUT, Folder, ceduo, expect, expect_equal, expect_in, expect_near, run_all

SHEETS = Path(__file__).resolve().parent / "cases/surveys"
KINDS = ("shoots", "standards", "trees")


def survey(f, content, *arguments, name="plots.csv"):
    (f.path / name).write_text(content, encoding="utf-8")
    return ceduo("--survey", name, *arguments, cwd=f.path)


def densities(text):
    """Return stems per hectare of each kind, and stools."""
    found = dict.fromkeys(KINDS, 0)
    for density, kind in re.findall(r"per_ha: ([0-9.e+]+),[^\n]*\n +source: \{kind: \w+, text: \"(\w+) of \d", text):
        found[kind] += float(density)
    stools = re.search(r"^stools: \{per_ha: ([0-9.e+]+)", text, re.M)
    return {kind: n for kind, n in found.items() if n} | ({"stools": float(stools[1])} if stools else {})


def expect_densities(text, wanted, what=""):
    found = densities(text)
    expect_equal(sorted(found), sorted(wanted), (what, text))
    for key, value in wanted.items():
        expect_near(found[key], value, 1e-4 * value, (what, key))


def understood(r):
    """Return the line on standard error, which is the first comment of the stand."""
    expect_equal(r.status, DONE, r)
    line = r.err.rstrip("\n")
    expect_equal(r.out.splitlines()[0], f"# {line}", r)
    return line


def refused(r, *words):
    expect_equal((r.status, r.out), (INPUT, ""), r)
    for word in words:
        expect_in(word, r.err, r)


def read(f, content, wanted, *words):
    """Expect densities, and words of the line."""
    r = survey(f, content)
    line = understood(r)
    expect_densities(r.out, wanted, content)
    for word in words:
        expect_in(word, line, content)


def cosine(percent):
    return 1 / math.hypot(1, percent / 100)


def per_ha(*plots):
    """Return the mean over plots of (number, m2 of the map)"""
    return sum(10000 * n / area for n, area in plots) / len(plots)


FLAT30 = 314 * math.cos(math.radians(30))
BREAST = math.pi * 64
# name: (densities by hand, words of the line)
READ = {
    "class-tally": ({"shoots": per_ha((60, 400), (55, 400)), "standards": per_ha((3, 400), (4, 400)),
                     "stools": per_ha((18, 400), (25, 400))},
                    "2 plots of 400 m2, 115 shoots on 43 stools, 7 standards; dbh 5 to 25 cm", "1 row of totals left out"),
    "stools": ({"shoots": per_ha((18, FLAT30), (11, 314)), "stools": per_ha((3, FLAT30), (2, 314))},
               "29 shoots on 5 stools", "decimal commas; not used: foto"),
    "notes-between": ({"shoots": per_ha((2, 200), (1, 200)), "stools": 50, "standards": per_ha((2, 200), (0, 200)), "trees": 25},
                      "3 shoots on 2 stools, 2 standards, 1 tree", "; not used: Note"),
    "girths": ({"shoots": per_ha((2, 300), (1, 300), (0, 300)), "stools": per_ha((1, 300), (1, 300), (0, 300)),
                "standards": 10000 / 300 / 3, "trees": 10000 / 300 / 3},
               "3 plots of 300 m2, distinguished by Stand", "dbh 7.99 to 30 cm, from circumferences"),
    "units-row": ({"trees": per_ha((2, 400 * cosine(60)), (1, 400))}, "given in mm", "given in percent", "1 dead and 1 cut left out"),
    "status-english": ({"trees": per_ha((7, 400), (2, 400))}, "9 trees", "4 dead left out"),
    "german": ({"shoots": per_ha((2, 250 * cosine(50)), (1, 250 * cosine(50))), "stools": 10000 / 250 / cosine(50),
                "standards": per_ha((1, 250 * cosine(50)), (0, 250))}, "given in mm", "1 dead left out", "not used: Bemerkung"),
    "german-girths": ({"trees": per_ha((4, BREAST), (2, BREAST), (3, BREAST))}, "3 plots of 201.1 m2, distinguished by Standort",
                      "dbh 20 to 30 cm, from circumferences"),
}


def convert(column, factor, comma=False):
    """Multiply the values of a column by a factor."""
    def changed(text):
        separator = ";" if ";" in text else ","
        rows = [row.split(separator) for row in text.splitlines()]
        for row in rows[1:]:
            row[column] = f"{float(row[column].replace(',', '.')) * factor:g}".replace(".", "," if comma else ".")
        return "\n".join(separator.join(row) for row in rows) + "\n"
    return changed


def instead(*pairs):
    def changed(text):
        for old, new in pairs:
            expect_in(old, text)
            text = text.replace(old, new)
        return text
    return changed


# name: (words of the remedy, repairs with their densities by hand)
REFUSED = {
    "tally-no-stools": (["plots.csv:2:12", "the number of stools of the plot (column 'stools')"],
                        [(instead(("Matricine\n", "Matricine;N. ceppaie\n"), ("6;44;0", "6;44;0;20"), ("8;31;0", "8;31;0;"),
                                  ("22;0;3", "22;0;3;"), ("6;29;0", "6;29;0;14"), ("24;0;4", "24;0;4;")),
                          {"shoots": per_ha((75, 500), (29, 500)), "stools": per_ha((20, 500), (14, 500)), "standards": 70})]),
    "inches": (["this column must be in cm or mm; convert it and name it 'dbh_cm'"],
               [(lambda text: convert(4, 2.54)(text).replace("DBH (in)", "dbh_cm"), {"trees": 100})]),
    "percent-slopes": (["plots.csv:2:7", "name the column 'slope_deg' for degrees, 'slope (%)' for percent"],
                       [(instead(("Pendenza", "slope (%)")), {"trees": per_ha((9, 400 * cosine(75)), (7, 400 * cosine(60)))}),
                        (instead(("Pendenza", "Pendenza (%)")), {"trees": per_ha((9, 400 * cosine(75)), (7, 400 * cosine(60)))}),
                        (instead(("Pendenza", "slope_deg")), {"trees": per_ha((9, 400 * math.cos(math.radians(75))), (7, 200))}),
                        (instead((";75;", ";75 %;"), (";60;", ";60%;")),
                         {"trees": per_ha((9, 400 * cosine(75)), (7, 400 * cosine(60)))})]),
    "hectares": (["this column must be in m2; convert it and name it 'area_m2'"],
                 [(lambda text: convert(2, 10000)(text).replace("Superficie (ha)", "area_m2"), {"trees": per_ha((13, 400), (10, 500))})]),
    "millimetres": (["the mean diameter is 122 cm, the mean height 9.62 m; name the column 'dbh_mm'", "'dbh_cm'"],
                    [(instead(("Diametro", name)), {"shoots": per_ha((2, 400), (1, 400)), "stools": 25, "standards": 12.5})
                     for name in ("dbh_mm", "Diametro (mm)")]),
    "numbers": (["plots.csv:1:1: this column goes 1, 2, 3; name it 'id'", "'count'"],
                [(instead(("N.;", "id;")), {"trees": per_ha((3, 300), (1, 300))}),
                 (instead(("N.;", "count;")), {"trees": per_ha((6, 300), (4, 300))})]),
    "concentric": (["plots.csv:4:3: 'area_m2' is 50 in another row of this plot, here 400", "make a survey of each area"],
                   [(lambda text: "".join(row for row in text.splitlines(True) if "400" not in row), {"shoots": 300, "stools": 200}),
                    (lambda text: "".join(row for row in text.splitlines(True) if ",50," not in row), {"standards": per_ha((1, 400), (2, 400))})]),
    "stray-quote": (["plots.csv:3:28: a stray quote in this cell; remove it"],
                    [(instead(('"', "")), {"shoots": per_ha((3, 200), (1, 200)), "stools": per_ha((2, 200), (1, 200))})]),
}


def test_sheets():
    """Sixteen sheets in three languages: read with their densities, or refused with a remedy and read after it"""
    known = {"codes", "english", "telephone", "unicode", "windows"}  # test_survey.py has them
    expect_equal({p.stem for p in SHEETS.iterdir()} - known, set(READ) | set(REFUSED))
    with Folder() as f:
        for name, (wanted, *words) in READ.items():
            read(f, (SHEETS / f"{name}.csv").read_text(encoding="utf-8"), wanted, *words)
        for name, (words, mends) in REFUSED.items():
            text = (SHEETS / f"{name}.csv").read_text(encoding="utf-8")
            refused(survey(f, text), *words)
            for mend, wanted in mends:
                read(f, mend(text), wanted)


ONE = "plot,area_m2,kind,species,dbh_cm{}\n"


def test_heads():
    """Heads of the field's sheets, in any case, with and without units"""
    columns = {"Saggio": "1", "Area": "400", "Tipo": "albero", "Specie": "faggio", "Diametro": "20", "Altezza": "14"}
    heads = {
        "Diametro": ("DAP", "DBH", "Ø", "Ø (cm)", "Diam. a 1,30", "D_cm", "D medio", "Classe diam.", "diametro medio", "d 1.30", "BHD",
                     "Durchmesser", "Diameter class", "DAP cm"),
        "Altezza": ("Altezza totale", "Ht_m", "Ht", "H tot", "H (m)", "Höhe", "height", "H media (m)"),
        "Area": ("Area saggio", "Superficie saggio", "Superficie saggio (mq)", "Fläche m²", "Plot area"),
        "Saggio": ("N. area di saggio", "Area di saggio", "Plot", "ADS", "N. saggio", "Probefläche"),
        "Specie": ("Essenza", "Genere", "Species", "Baumart"),
    }
    with Folder() as f:
        for column, names in heads.items():
            for name in (*names, *(n.upper() for n in names)):
                head = ";".join(name if c == column else c for c in columns)
                r = survey(f, f"{head}\n{';'.join(columns.values())}\n2;400;;;;\n")
                expect("not used" not in understood(r), head, r)
                expect_densities(r.out, {"trees": 12.5}, head)
                expect_in("dbh_m: 0.2, height_m: 14,", r.out, head)
                expect_in("species: fagus-sylvatica", r.out, head)


def test_species():
    """Species with authors, with an abbreviated genus, in two columns, and by common names in three languages"""
    names = {"fagus-sylvatica": ("Fagus sylvatica L.", "F. sylvatica", "F.sylvatica", "F. sylvatica L.", "FAGGIO", "Buche", "beech",
                                 "Faggio (Fagus sylvatica)"),
             "ostrya-carpinifolia": ("Ostrya carpinifolia Scop.", "O. carpinifolia", "Ostr. carpinifolia", "Hopfenbuche"),
             "quercus-cerris": ("Q. cerris", "Quercus cerris L.", "Turkey oak", "Zerreiche"),
             "quercus-pubescens": ("Quercus pubescens Willd.", "Q.pubescens", "Roverella"),
             "acer": ("Acer campestre", "Acer opalus Mill.", "Acer sp.", "acero montano")}
    with Folder() as f:
        for species, words in names.items():
            for word in words:
                r = survey(f, ONE.format("") + f"1,400,tree,{word},20\n")
                expect_in(f"species: {species}\n", r.out, (word, r))
        for word in ("Fagus", "Quercus sp.", "Q. sylvatica", "Fagus sylvatica pendula", "P. abies nana", "oak"):
            refused(survey(f, ONE.format("") + f"1,400,tree,{word},20\n"), f"'{word}' is an unknown species")
        refused(survey(f, f"plot,area_m2,kind,Genere,Specie,dbh_cm\n1,400,tree,{'F' * 128},sylvatica,20\n"), "'sylvatica' is an unknown species")
        read(f, "plot,area_m2,kind,Genere,Specie,dbh_cm\n1,400,tree,Fagus,sylvatica,20\n", {"trees": 25})


def test_kinds():
    """Kinds of stems by the words of the field"""
    kinds = {"shoots": ("poll.", "Pollone", "P", "Stockausschlag"), "standards": ("matr.", "matr. 1T", "matr. 2T", "M", "Überhälter"),
             "trees": ("fustaia", "albero", "allievi", "Baum")}
    with Folder() as f:
        for kind, words in kinds.items():
            for word in words:
                more = {"stools": 25} if kind == "shoots" else {}
                read(f, f"plot,area_m2,kind,stool,dbh_cm\n1,400,{word},1,12\n", {kind: 25} | more)


def test_counts():
    """A number of stems multiplies the row; it must be whole, and not a running number"""
    tally = ("saggio,area_m2,tipo,specie,diametro_cm,{}\n1,400,albero,faggio,15,7\n1,,albero,faggio,20,12\n1,,albero,faggio,25,4\n"
             "2,400,albero,faggio,15,5\n2,,albero,faggio,20,9\n2,,albero,faggio,25,0\n")
    with Folder() as f:
        for head in ("n", "numero", "num", "n. fusti", "freq", "frequenza", "conteggio", "count", "TREE_COUNT", "stems", "Anzahl"):
            read(f, tally.format(head), {"trees": per_ha((23, 400), (14, 400))}, "2 plots of 400 m2, 37 trees")
        expect_in("; read as: numero = count", survey(f, tally.format("numero")).err)
        expect("read as" not in survey(f, tally.format("n. fusti")).err)
        for value, words in (("2.5", "'count' must be a whole number"), ("-1", "-1 is outside the range 0 to 200000 stems"), ("", "'count' is missing"),
                             ("two", "'two' is not a number")):
            refused(survey(f, tally.format("count").replace(",25,4", f",25,{value}")), "plots.csv:4:21", words)
        for row in (",,,,,Total\n", "1,,albero,Total,60,23\n"):
            read(f, tally.format("count") + row, {"trees": per_ha((23, 400), (14, 400))}, "1 row of totals left out")
        refused(survey(f, tally.format("count").replace("\n1,400", "\n,400")), "plots.csv:2:1", "'plot' is missing")
        refused(survey(f, tally.format("count") + ",400,,,,\n"), "plots.csv:8:1", "'plot' is missing")
        expect_in("; read as: d = dbh_cm, h = height_m", understood(survey(f, "plot,area_m2,kind,d,h\n1,400,tree,20,14\n")))
        read(f, tally.format("count").replace("2,400,albero,faggio,15,5\n", "2,400,,,,\n"), {"trees": per_ha((23, 400), (9, 400))})
        read(f, "plot,area_m2,kind,stool,dbh_cm,count\n1,200,shoot,3,6,4\n1,,shoot,3,8,2\n1,,shoot,4,7,0\n",
             {"shoots": 300, "stools": 50})
        refused(survey(f, "plot,area_m2,kind,dbh_cm,count\n1,200,tree,6,150000\n1,,tree,8,100000\n"), "more than 200000 stems")


def test_numbering():
    """A running column 'n' is asked about, over all rows or per plot; both remedies work"""
    with Folder() as f:
        for numbers, count in (((1, 2, 3, 4), 5), ((1, 2, 1, 2), 3), ((7, 8, 9, 10), 17)):
            rows = "".join(f"{n},{p},300,tree,20\n" for n, p in zip(numbers, (1, 1, 2, 2)))
            for head in ("n", "Nr.", "numero"):
                refused(survey(f, f"{head},plot,area_m2,kind,dbh_cm\n{rows}"), "name it 'id' if it numbers the stems, 'count' if")
            read(f, f"id,plot,area_m2,kind,dbh_cm\n{rows}", {"trees": per_ha((2, 300), (2, 300))})
            read(f, f"count,plot,area_m2,kind,dbh_cm\n{rows}", {"trees": per_ha((sum(numbers), 600))})
            del count


def test_status():
    """Dead and cut stems are dropped and counted, in several vocabularies; stumps and stems without a status stay"""
    words = (("status", "live", "dead", "cut"), ("stato", "vivo", "morto", "tagliato"), ("Vitalità", "v", "m", "t"),
             ("vitalita", "Viva", "Morta", "Tagliata"), ("condizione", "vivi", "secco", "abbattuto"), ("health", "alive", "dead", "felled"),
             ("STATUS", "LI", "DS", "cut"), ("Zustand", "lebend", "tot", "entnommen"))
    with Folder() as f:
        for head, live, dead, cut in words:
            read(f, ONE.format(f",{head}") + f"1,400,tree,beech,20,{live}\n1,,tree,beech,15,{dead}\n1,,tree,beech,,{cut}\n2,400,tree,beech,25,{live}\n"
                 f"2,,tree,beech,25,{cut}\n", {"trees": 25}, "2 trees", "1 dead and 2 cut left out")
        read(f, ONE.format(",status,count") + "1,400,tree,beech,15,dead,3\n1,,tree,beech,20,live,2\n2,400,tree,beech,15,live,1\n",
             {"trees": per_ha((2, 400), (1, 400))}, "3 dead left out")
        read(f, ONE.format(",status") + "1,400,tree,,15,\n1,,tree,,15,dead\n", {"trees": 25}, "; 1 dead left out; 1 without a status counts as live")
        read(f, ONE.format(",status") + "1,400,tree,,15,live\n1,,tree,,15,cut\n", {"trees": 25}, "; 1 cut left out")
        read(f, "Zustand,plot,area_m2,kind,dbh_cm\ntot,1,400,tree,15\nlebend,1,400,tree,20\n", {"trees": 25}, "; 1 dead left out")
        r = survey(f, ONE.format(",status") + "1,400,stump,,30,cut\n1,,tree,,20,live\n")
        expect_in("1 tree, 1 stump; dbh 20 cm", understood(r))
        text = ONE.format(",stato") + "1,400,tree,,20,Italia\n"
        refused(survey(f, text), "plots.csv:2:16: 'Italia' is not a status; write live, dead or cut, or rename the column")
        read(f, text.replace("stato", "paese"), {"trees": 25}, "not used: paese")


CHESTNUT = [(d, "v") for d in (160, 59, 66, 56, 54, 52, 47, 44, 29, 30, 33, 45, 8)] + [(d, "m") for d in (5, 4, 15, 9)] + [(20, "t"), (11, "t")]


def test_units():
    """Millimetres in the head, in a row of units or in the cell; other units are refused"""
    with Folder() as f:
        rows = "1,400,tree,beech,{}\n2,400,tree,beech,{}\n"
        for head, units, cells in (("dbh_mm", "", ("200", "300")), ("DAP (mm)", "", ("200", "300")), ("D", ",m2,,,mm\n", ("200", "300")),
                                   ("D", "", ("200 mm", "300mm")), ("dbh (cm)", "", ("20", "30 cm")), ("D", "", ("20cm", "30"))):
            r = survey(f, ONE.format("").replace("dbh_cm", head) + units + rows.format(*cells))
            expect_densities(r.out, {"trees": 25}, head)
            expect_in("dbh 20 to 30 cm", understood(r), head)
        for head, cells in (("circ_mm", ("628.3", "942.5")), ("Circonferenza", ("62.83", "94.25")), ("C130 (cm)", ("62.83", "94.25")),
                            ("Umfang", ("62.83", "94.25")), ("girth", ("62.83", "94.25"))):
            r = survey(f, ONE.format("").replace("dbh_cm", head) + rows.format(*cells))
            expect_in("from circumferences", understood(r), head)
            expect_in("dbh_m: 0.199994,", r.out, head)  # 62.83 / pi
        for head, unit in (("DBH (in)", "cm or mm"), ("dbh_in", "cm or mm"), ("Circonferenza (m)", "cm or mm"), ("diametro [dm]", "cm or mm")):
            refused(survey(f, ONE.format("").replace("dbh_cm", head) + rows.format(8, 12)), f"this column must be in {unit}; convert")
        for head, unit in (("Altezza (dm)", "m"), ("height_ft", "m"), ("slope (gon)", "degrees or %")):
            refused(survey(f, ONE.format(f",{head}") + rows.format("20,14", "30,16")), f"this column must be in {unit}; convert")
        refused(survey(f, "plot,sup. (are),kind,dbh\n1,4,tree,20\n"), "this column must be in m2; convert")
        refused(survey(f, ONE.format("").replace("dbh_cm", "dbh_mm") + rows.format("20 cm", "30")), "the head of this column gives another unit")
        read(f, ONE.format(",d (m)") + rows.format("20,5", "30,6"), {"trees": 25}, "not used: d (m)")
        both = ONE.format(",circ_cm") + "1,400,tree,,20,{}\n1,,tree,,,94.25\n"
        read(f, both.format("62.8"), {"trees": 50}, "dbh 20 to 30 cm")
        refused(survey(f, both.format("82")), "a circumference of 82 cm is a diameter of 26.1 cm, not 20; leave one empty")
        refused(survey(f, both.format("50")), "a circumference of 50 cm is a diameter of 15.9 cm, not 20; leave one empty")
        refused(survey(f, both.format("wide")), "'wide' is not a number")
        read(f, both.format(""), {"trees": 50})
        refused(survey(f, both.format("62.8").replace(",94.25", ",")), "'dbh_cm' is missing")
        refused(survey(f, "plot,area_m2,kind\n1,400,tree\n"), "must name the column 'dbh_cm' or 'circumference_cm'; it has: plot, area_m2, kind")
        thick = "plot,area_m2,kind,{}\n1,4000,tree,{}\n"
        for head, value, mended in (("dbh", 320, "dbh_mm"), ("girth", 990, "circumference_mm")):
            refused(survey(f, thick.format(head, value)), f"name the column '{mended}'")
            read(f, thick.format(mended, value), {"trees": 2.5}, "given in mm")
        refused(survey(f, thick.format("dbh_mm", 3200)), "more than 300 cm; correct it")
        refused(survey(f, ONE.format("") + "1,400,tree,,10-15\n"), "'10-15' is a class; write its middle, 12.5")
        for value in ("10-15x", "-5-10"):
            refused(survey(f, ONE.format("") + f"1,400,tree,,{value}\n"), f"'{value}' is not a number")
        read(f, ONE.format("") + "1,400,tree,,12.5\n", {"trees": 25})


def test_tallies():
    """A row per class with numbers of shoots, standards and trees; a row per stool"""
    head = "plot,area_m2,dbh_cm,polloni,matricine,alberi{}\n"
    with Folder() as f:
        read(f, head.format(",ceppaie") + "1,400,5,30,,,12\n1,,10,11,2,1,\n1,,20,,3,,\n2,400,5,8,,,8\n",
             {"shoots": per_ha((41, 400), (8, 400)), "stools": per_ha((12, 400), (8, 400)), "standards": 62.5, "trees": 12.5},
             "49 shoots on 20 stools, 5 standards, 1 tree")
        read(f, head.format(",stool") + "1,400,5,3,0,0,1\n1,,7,4,1,,2\n2,400,6,2,,,1\n",
             {"shoots": per_ha((7, 400), (2, 400)), "stools": per_ha((2, 400), (1, 400)), "standards": 12.5})
        read(f, "plot,area_m2,kind,dbh_cm,stool,shoots\n1,400,shoot,6,1,5\n1,,standard,25,,\n", {"shoots": 125, "stools": 25, "standards": 25})
        read(f, head.format(",n. fusti") + "1,400,15,,2,1,3\n1,,20,,1,,1\n", {"standards": 75, "trees": 25})
        refused(survey(f, head.format(",n. fusti") + "1,400,15,,2,1,4\n"), "'count' is 4, but 'shoots', 'standards' and 'trees' add up to 3")
        own = "plot,area_m2,kind,dbh_cm,trees,count\n1,400,tree,20,3,{}\n"
        read(f, own.format(3), {"trees": 75})
        refused(survey(f, own.format(4)), "'count' is 4, but 'shoots', 'standards' and 'trees' add up to 3")
        read(f, head.format("") + "1,400,20,,2,\n2,400,,0,0,0\n", {"standards": per_ha((2, 400), (0, 400))}, "2 plots of 400 m2")
        refused(survey(f, head.format("") + "1,400,20,,2,\n2,400,,,5,\n"), "plots.csv:3:7", "'dbh_cm' is missing")
        refused(survey(f, "plot,area_m2,kind,dbh_cm,shoots\n1,400,tree,16,5\n"), "this row has another kind of stem; leave 'shoots' empty here")
        refused(survey(f, head.format("") + "1,400,5,30,,\n"), "plots.csv:2:13", "(column 'stools')")
        classes = "plot,area_m2,dbh_cm,shoots,stools\n1,400,5,30,{}\n1,,10,11,{}\n"
        for first, second, words in ((50, "", "50 stools do not match 41 live shoots"), (0, "", "0 stools do not match 41 live shoots"),
                                     (2.5, "", "'stools' must be a whole number"),
                                     (1, 2, "'stools' is 1 in another row of this plot, here 2; if it numbers the stools")):
            refused(survey(f, classes.format(first, second)), words)
        read(f, classes.format(1, 2).replace("stools", "stool"), {"shoots": 41 * 25, "stools": 50})
        read(f, classes.format(41, 41), {"shoots": 41 * 25, "stools": 41 * 25})
        some = "plot,area_m2,kind,dbh_cm,stool,stools\n1,400,shoot,5,a,{}\n1,,shoot,6,b,\n1,,shoot,6,{},\n"
        refused(survey(f, some.format(2, "")), "plots.csv:4", "other shoots of the plot have one")
        refused(survey(f, some.format(5, "b")), "5 stools do not match 3 live shoots")
        refused(survey(f, some.format(3, "b")), "'stools' is 3, but the shoots of this plot have 2 stools; correct it, or remove")
        read(f, some.format(2, "b"), {"shoots": 75, "stools": 50})
        refused(survey(f, "plot,area_m2,dbh_cm,shoots,stools,spacing_m\n1,400,5,30,9,0.4\n"), "a shoot without a stool has no 'spacing_m'")


def test_sites():
    """The same plot number at two sites means two plots; alternating rows are asked about; a repeated stem is noted"""
    with Folder() as f:
        for head in ("site", "stand", "compresa", "Particella", "Strato", "Località", "Bestand"):
            read(f, f"{head},plot,area_m2,kind,dbh_cm\nA,1,400,tree,20\nA,1,400,tree,22\nB,1,200,tree,20\nB,2,200,tree,20\n",
                 {"trees": per_ha((2, 400), (1, 200), (1, 200))}, f"3 plots of 200 to 400 m2, distinguished by {head}, 4 trees")
        read(f, "comune,particella,plot,area_m2,kind,dbh_cm\nx,14,1,400,tree,20\nx,,1,,tree,22\nx,15,1,400,tree,22\n",
             {"trees": per_ha((2, 400), (1, 400))}, "2 plots of 400 m2, distinguished by particella", "not used: comune")
        layers = "strato,plot,area_m2,kind,dbh_cm\nalto,1,400,tree,30\nbasso,1,400,tree,10\nalto,1,400,tree,28\n"
        refused(survey(f, layers), "plots.csv:4:1: the rows of plot '1' alternate between values of 'strato'", "otherwise rename it")
        refused(survey(f, layers.replace(",1,", f",{'p' * 101},")), f"the rows of plot '{'p' * 100}' alternate")
        read(f, layers.replace("strato", "piano"), {"trees": 75}, "not used: piano")
        read(f, "".join([layers.splitlines(True)[i] for i in (0, 1, 3, 2)]), {"trees": per_ha((2, 400), (1, 400))}, "distinguished by strato")
        refused(survey(f, "site,plot,area_m2,kind,dbh_cm\nA,1,400,tree,20\nB,,,tree,20\n"), "plots.csv:3", "'plot' is missing")
        cases = "site,plot,area_m2,kind,dbh_cm\nA,p1,400,tree,20\n{},{},400,tree,22\n"
        for site, plot in (("A", "P1"), ("a", "p1"), ("a", "P1")):
            refused(survey(f, cases.format(site, plot)), "plots.csv:3:1: the names of this plot and of the plot on line 2 differ only in case")
        read(f, cases.format("A", "p1"), {"trees": 50})
        read(f, cases.format("A", "p2"), {"trees": 25})
        read(f, cases.format("A", "p10"), {"trees": 25})
        r = survey(f, cases.format("A", "p2") + "A,P1,400,tree,22\nA,P2,400,tree,22\n")
        refused(r, "plots.csv:4:1: the names of this plot and of the plot on line 2 differ only in case")
        expect_equal(r.err.count("differ only in case"), 1, r)  # stops at the first
        numbers = "plot,area_m2,kind,dbh_cm\n{},400,tree,20\n{},400,tree,22\n"
        for first, second in ((1, "01"), (1, "1.0"), ("1.0", "01"), ("007", "7.0")):
            refused(survey(f, numbers.format(first, second)), "plots.csv:3:1: the names of this plot and of the plot on line 2 are one number; make")
        for first, second in ((1, 10), (1, 1.1), ("1.1", "1.10"), ("1a", "01a"), ("0a", "00a"), (0, "0-1"), (0, "1"), ("0", "0a"), ("p1", "p01")):
            read(f, numbers.format(first, second), {"trees": 25})
        refused(survey(f, cases.format("a", "01").replace("A,p1", "A,1")), "plots.csv:3:1: the names of this plot and of the plot on line 2 are one")
        read(f, cases.format("B", "01").replace("A,p1", "A,1"), {"trees": 25})
        years = "year,plot,area_m2,kind,dbh_cm\n2015,1,400,tree,20\n{},1,,tree,22\n2020,2,400,tree,22\n"
        for head in ("year", "Anno", "INVYR"):
            refused(survey(f, years.format(2020).replace("year", head)), "plots.csv:3:1: this plot was surveyed in the years 2015 and 2020; keep")
        refused(survey(f, years.format("1" * 21).replace("2015", "2" * 21)), f"in the years {'2' * 20} and {'1' * 20}; keep")
        read(f, years.format(2015), {"trees": per_ha((2, 400), (1, 400))})
        read(f, years.format("").replace("2020,1,,tree,22\n", ""), {"trees": per_ha((2, 400), (1, 400))})
        read(f, years.format(2020).replace("year", "planted"), {"trees": per_ha((2, 400), (1, 400))}, "not used: planted")
        read(f, "Superficie (m2),Superficie saggio (m2),plot,kind,dbh_cm\n25000,400,1,tree,20\n", {"trees": 25}, "not used: Superficie (m2)")
        twice = "plot,area_m2,kind,{},dbh_cm\n1,400,tree,5,20\n1,,tree,6,20\n2,400,tree,5,21\n1,,tree,5,20\n1,,standard,6,20\n"
        for head in ("id", "n. pianta", "TREE", "id fusto"):
            read(f, twice.format(head), {"trees": 50, "standards": 12.5}, "; 1 stem occurs twice (line 5)")
        for ids in ((5, 6, 5, 6), (5, 6, 6, 5)):
            several = "plot,area_m2,kind,id,dbh_cm\n" + "".join(f"1,400,tree,{i},20\n" for i in ids)
            read(f, several, {"trees": 100}, "; 2 stems occur twice (the first on line 4)")
        expect("twice" not in survey(f, twice.format("id").replace("1,,tree,5", "1,,tree,7")).err)


def test_asked():
    """Values that may be in another unit are refused; each remedy works"""
    with Folder() as f:
        small = "plot,{},kind,dbh\n1,{},tree,4\n"
        for head, value, mended, area in (("area", 5, "area_m2", 5), ("sup.", 9.9, "area (m2)", 9.9), ("raggio", 1.5, "radius_m", math.pi * 2.25)):
            refused(survey(f, small.format(head, value)), "plots.csv:2:3: a plot of", "is very small; if it is right, name the column '")
            read(f, small.format(mended, value), {"trees": 10000 / area})
        read(f, small.format("area", 10), {"trees": 1000})
        slopes = "saggio;superficie;{};tipo;diametro\n1;400;{};albero;20\n2;400;{};albero;22\n"
        steep = 400 * math.cos(math.radians(50))
        for first, second, line in ((40, "", 3), ("", 40, 2), ("", 0, 2), (0, "n.d.", 3)):
            r = survey(f, slopes.format("slope_deg", first, second))
            refused(r, f"plots.csv:{line}:1: this plot has no slope, others have one; write it, 0 if the area is that of the map")
            expect_equal(r.err.count("no slope"), 1, r)
        read(f, slopes.format("slope_deg", 60, "0"), {"trees": per_ha((1, 200), (1, 400))}, "slopes 0 to 60 degrees")
        read(f, slopes.format("slope_deg", "", ""), {"trees": 25})
        read(f, slopes.format("slope_deg", 60, 60) + "1;;;albero;24\n", {"trees": per_ha((2, 200), (1, 200))}, "slope 60 degrees")
        for head in ("pendenza", "Slope", "Neigung"):
            refused(survey(f, slopes.format(head, 50, 30)), "plots.csv:2:7: a slope of 50 has no unit", "'slope_deg'", "'slope (%)'")
            for unit in ("_deg", " (gradi)", "_gradi", " (°)"):
                read(f, slopes.format(head + unit, 50, 0), {"trees": per_ha((1, steep), (1, 400))}, "slopes 0 to 50 degrees")
            for unit in (" (%)", " %", " perc."):
                read(f, slopes.format(head + unit, 50, 0), {"trees": per_ha((1, 400 * cosine(50)), (1, 400))}, "given in percent")
            read(f, slopes.format(head, "50°", "0"), {"trees": per_ha((1, steep), (1, 400))})
            read(f, slopes.format(head, "80%", "35°"), {"trees": per_ha((1, 400 * cosine(80)), (1, 400 * math.cos(math.radians(35))))})
            read(f, slopes.format(head, "45", "0"), {"trees": per_ha((1, 400 / math.sqrt(2)), (1, 400))})
            refused(survey(f, slopes.format(head, "80%", "35")), "plots.csv:3:7: some slopes have a unit and others have none")
            refused(survey(f, slopes.format(head + "_deg", "80%", "35")), "plots.csv:2:7: the head of this column gives another unit")
        sizes = "plot,area_m2,kind,{},{}\n1,4000,tree,{},{}\n1,,tree,{},{}\n"
        for head, mended in (("diametro", "diametro_mm"), ("DBH", "dbh_mm"), ("DAP", "DAP (mm)"), ("girth", "circumference_mm")):
            refused(survey(f, sizes.format(head, "height", 160, 12, 180, 13)), "the mean diameter is", "_mm' for millimetres", "_cm' for")
            read(f, sizes.format(mended, "height", 160, 12, 180, 13), {"trees": 5}, "given in mm")
        read(f, sizes.format("dbh_cm", "height", 160, 12, 180, 13), {"trees": 5}, "dbh 160 to 180 cm")
        read(f, sizes.format("dbh", "height", 60, 22, 70, 24), {"trees": 5})
        basal = "plot,{},kind,{}\n" + "1,50,tree,60\n" * 2  # 113 m2 per ha
        refused(survey(f, basal.format("area", "dbh")), "plots.csv:1:16: the basal area is very high, 113 m2/ha; name the columns 'area_m2' and 'dbh_cm'")
        refused(survey(f, basal.format("area", "dbh_cm")), "plots.csv:1:6: the basal area is very high, 113 m2/ha")
        refused(survey(f, basal.format("area_m2", "dbh")), "'dbh_mm' if the diameters are in millimetres")
        read(f, basal.format("area_m2", "dbh_cm"), {"trees": 400}, "basal area 113 m2/ha")
        read(f, basal.format("area_m2", "dbh_mm"), {"trees": 400}, "basal area 1.13 m2/ha")
        refused(survey(f, basal.format("raggio", "girth").replace("50", "4").replace("60", "190")), "'radius_m' and 'circumference_cm'")
        refused(survey(f, basal.format("area_m2", "dbh_cm").replace("50", "15")), "377 m2/ha, more than any forest has")
        high = "plot,area_m2,kind,dbh,{}\n1,400,tree,20,120\n"
        for head in ("alt", "alt. (m)", "H"):
            refused(survey(f, high.format(head)), "the mean height is 120 m; name the column 'height_m'", "'altitude'")
            read(f, high.format("altitude"), {"trees": 25}, "not used: altitude")
        read(f, high.format("height_m"), {"trees": 25})
        low = "plot,area_m2,kind,dbh,height\n1,400,tree,20,{}\n"
        refused(survey(f, low.format(1.2)), "1.2 m is outside the range of heights here", "leave the cell empty if it was not measured")
        refused(survey(f, low.format(0)), "0 m is outside the range of heights here")
        read(f, low.format(""), {"trees": 25})


def test_chestnut():
    """A sheet without units with shoots up to 160 is asked about, and both remedies read the same live shoots"""
    with Folder() as f:
        rows = "".join(f"1;500;pollone;castagno;{i // 4};{i};{d};{status};\n" for i, (d, status) in enumerate(CHESTNUT))
        text = "Saggio;Superficie;Tipo;Specie;Ceppaia;ID pollone;{};Vitalità;\n" + rows
        live = sum(status == "v" for _, status in CHESTNUT)
        refused(survey(f, text.format("Diametro")), "the basal area is very high", "name the columns 'area_m2' and 'dbh_cm' if it is right, 'dbh_mm' if")
        stools = len({i // 4 for i, (_, status) in enumerate(CHESTNUT) if status == "v"})
        for head, area in (("dbh_mm", "Superficie"), ("Diametro (mm)", "Superficie"), ("dbh_cm", "area_m2")):
            read(f, text.format(head).replace("Superficie", area), {"shoots": live * 20, "stools": stools * 20}, "4 dead and 2 cut left out")


def test_names():
    """A quote or line break within a name is refused at its cell; surrounding quotes are accepted"""
    head = "plot,area_m2,kind,species,stool,dbh_cm\n"
    good = '"1",200,shoot,"beech",3,6\n1,,"shoot",beech,"3",7\n'
    with Folder() as f:
        read(f, head + good, {"shoots": 100, "stools": 50}, "2 shoots on 1 stool")
        for row, place in (('1",200,shoot,beech,3,6\n', ":2:1"), ('1,200,shoot,beech,3",6\n', ":2:19"), ('1,200,sho"ot,beech,3,6\n', ":2:7"),
                           ('1,200,shoot,bee"ch,3,6\n', ":2:13"), ('1,200,shoot,beech,"3""",6\n', ":2:19")):
            refused(survey(f, head + row + "1,,shoot,beech,3,7\n"), f"plots.csv{place}: a stray quote in this cell; remove it")
        refused(survey(f, head + '1,200,shoot,beech,"3\n4",6\n'), "plots.csv:2:19: a line break in a name")
        read(f, head.replace("\n", ",note\n") + '1,200,shoot,beech,3,6,6" thick\n', {"shoots": 50, "stools": 50}, "not used: note")


def test_line():
    """The line of understanding: on standard error and first in the file, not with -q; equal in the terminal program"""
    text = ("plot,area_m2,kind,stool,dbh,status,note,foto\n1,400,shoot,1,6,live,,\n1,,shoot,1,8,dead,x,\n1,,standard,,20,live,,\n"
            "2,400,shoot,1,7,cut,,\nTotal,,,,,,,\n")
    with Folder() as f:
        wanted = ("plots.csv: 2 plots of 400 m2, 1 shoot on 1 stool, 1 standard; dbh 6 to 20 cm; basal area 0.428 m2/ha; "
                  "1 dead and 1 cut left out; 1 row of totals left out; not used: note, foto")
        r = survey(f, text)
        expect_equal(understood(r), wanted)
        quiet = survey(f, text, "-q")
        expect_equal((quiet.err, quiet.out), ("", r.out))
        into = survey(f, text, "-o", "stand.yaml")
        expect_equal((into.err, into.out, (f.path / "stand.yaml").read_text(encoding="utf-8")), (r.err, "", r.out))
        r = ceduo("--survey", "-", stdin=text.encode())
        expect_equal(r.err.split(":")[0], "survey")
        f.write("s.yaml", "ceduo: scene/1\ntitle: t\nrock: {diameter_m: 0.8}\nrelease: {vx_m_s: 1}\nslope: {vertices_m: [[0, 70], [100, 0]], "
                "segments: [{rn: 0.3, rt: 0.9}]}\ncontrols: [{x_m: 90}]\nforest: [{from_m: 0, to_m: 60, stand: {trees: [{per_ha: 9, dbh_m: 0.2, "
                "height_m: 9}]}}]\n")
        f.write("keys", "resize 180 60\nkey p\ntype from a survey\nkey Enter\ntype plots.csv\nkey Enter\nwait idle\ndump -\n")
        shown = ceduo("--script", "keys", "s.yaml", cwd=f.path)
        expect_in("plots.csv: 2 plots of 400 m\u00b2, 1 shoot on 1 stool", shown.out, shown)
        expect_in("1 dead and 1 cut left out", " ".join(shown.out.split()), shown)


if __name__ == "__main__":
    run_all(__name__)
