#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: manual
"""--report: one well-formed HTML file without external resources, reproducible."""
import html
import json
import math
import os
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from html.parser import HTMLParser
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import (CEDUO, INPUT, OUTPUT, PROFILES, USAGE, Folder, belt, ceduo, expect, expect_equal, expect_in,  # noqa: E402
                     good, run_all, scene, wooded_scene)

FEW = ("-n", 60, "-s", "uncertainty=none", "-j", 2)
UNCERTAINTY = ("-n", 60, "-s", "uncertainty=[{path: rock.density_kg_m3, lo: 2400, hi: 2750}]", "--sensitivity=20", "-j", 2)
VOID = {"meta", "link", "img", "br", "hr", "input", "path", "rect"}
ODD = "Forst <b>&amp; \"Fels\" 'x' \u00e8 \u2264 </title><script>alert(1)</script>"


class Page(HTMLParser):
    """Elements and their nesting, their ids and attributes, the text of each kind."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.open, self.ids, self.names, self.attributes, self.text = [], [], [], [], {}
        self.feed(text)
        self.close()
        expect_equal(self.open, [], "elements never closed")

    def handle_starttag(self, tag, attrs):
        self.open.append(tag)
        self.note(tag, attrs)

    def handle_startendtag(self, tag, attrs):
        expect_in(tag, VOID, "closes itself")
        self.note(tag, attrs)

    def note(self, tag, attrs):
        names = [name for name, _ in attrs]
        expect_equal(len(names), len(set(names)), f"attributes of {tag}: {names}")
        self.names.append(tag)
        self.attributes += [(tag, name, value) for name, value in attrs]
        self.ids += [value for name, value in attrs if name == "id"]

    def handle_endtag(self, tag):
        expect(self.open and self.open[-1] == tag, f"</{tag}> in {self.open}")
        self.open.pop()

    def handle_data(self, data):
        for tag in set(self.open):
            self.text[tag] = self.text.get(tag, "") + data


def report(*arguments, few=FEW):
    out = good("--report", "-", *few, *arguments).out
    return out, Page(out)


def check_page(text, page):
    expect(text.startswith("<!DOCTYPE html>\n<html lang=\"en\">"), text[:80])
    expect(not {"script", "link", "img", "iframe", "object", "embed", "base", "form"} & set(page.names), set(page.names))
    for tag, name, value in page.attributes:
        expect(name not in ("src", "href", "style", "xmlns", "action") and not name.startswith("on"), tag, name, value)
    expect(not re.search(r"https?:|url\(|@import|@font-face", text), "something from elsewhere")
    expect_equal(len(page.ids), len(set(page.ids)), "ids")
    for tag, name, value in page.attributes:
        if name in ("aria-labelledby", "aria-describedby"):
            expect(all(part in page.ids for part in value.split()), tag, name, value)
    pictures = re.findall(r"<svg.*?</svg>", text, re.S)
    expect(pictures, "no picture")
    for picture in pictures:
        root = ElementTree.fromstring(picture)
        expect_equal([child.tag for child in root][:2], ["title", "desc"], "first in a picture")
        expect(all((root.find(tag).text or "").strip() for tag in ("title", "desc")), picture[:300])
    expect(len(text.encode()) <= 400_000, len(text))


def test_structure():
    """Each shipped scene gives well-formed HTML without script, link or font; pictures have a title and a description"""
    for scene in sorted((PROFILES / "scenes").glob("*.yaml")):
        text, page = report(scene)
        check_page(text, page)
        for heading in ("The slope and the rocks", "Limits of the model", "How to reproduce this page"):
            expect_in(heading, page.text["h2"], scene)
        expect_equal(page.names.count("h1"), 1, scene)


def test_same_bytes():
    """Equal input gives equal bytes, for any threads, locale and file name"""
    first, _ = report("paper-site")
    with Folder() as f:
        good("--report", f.path / "page.html", *FEW[:-2], "-j", 1, "paper-site", env={"LC_ALL": "C"})
        expect_equal((f.path / "page.html").read_text(encoding="utf-8"), first, "to a file")


def test_command():
    """The command on the page reproduces the page"""
    first, page = report("-s", "title=It's 'so' $HOME", "--option", "large reserves", "four-systems", few=UNCERTAINTY)
    command = page.text["pre"].split("ceduo: scene/1")[0]
    shell = command.replace("ceduo --report report.html", '"$CEDUO" --report -', 1)
    env = {**os.environ, "CEDUO": CEDUO, "LC_ALL": "C.UTF-8"}
    again = subprocess.run(["sh", "-c", shell], env=env, cwd=PROFILES.parent, capture_output=True, text=True, check=True).stdout
    expect_equal(again, first, command)
    expect_in("ceduo 0.", page.text["dd"])


def test_scene_text():
    """The page contains the scene as text that reads back as the same scene"""
    with Folder() as f:
        for name in ("scenes", "slopes", "stands"):
            shutil.copytree(PROFILES / name, f.path / name)
        _, page = report("-s", "rock.diameter_m=0.7", f.path / "scenes" / "paper-site.yaml")
        scene = f.path / "scenes" / "again.yaml"
        scene.write_text(page.text["pre"][page.text["pre"].index("ceduo: scene/1"):], encoding="utf-8")
        wanted = good("-b", "-f", "csv", *FEW, "-s", "rock.diameter_m=0.7", f.path / "scenes" / "paper-site.yaml").out
        found = good("-b", "-f", "csv", "-n", 60, scene).out
        expect_equal(found.replace("again", "paper-site"), wanted, "the same figures")


def test_answer():
    """The answer has the figures of the batch run, with sampling error and uncertainty"""
    run = good("-b", "-f", "json", *UNCERTAINTY[:4], "paper-site").json()[0]
    wooded = run["options"][0]["controls"][0]["wooded"]
    _, page = report("paper-site", few=UNCERTAINTY)
    window = run["options"][0]["window"]
    expect(re.match(rf"\s*✘ NO: in {window['failing_years']} of 20 years more than 50 of 1000 rocks exceed 50 kJ", page.text["div"]), page.text["div"])
    expect_in(f"; today {1000 * wooded['exceed_probability']:.0f} (NO)", page.text["div"])
    lo, hi = math.floor(1000 * wooded["exceed_lo"]), math.ceil(1000 * wooded["exceed_hi"])
    expect(re.search(rf"Sampling error \(\d+ rocks\): {lo}–{hi}\. Uncertain inputs: \d+–\d+\.", page.text["dl"]), page.text["dl"])
    expect_in("Uncertainty was not computed: the scene has 'uncertainty: none'.", report("-s", "uncertainty=none", "paper-site")[1].text["dl"])
    few = ("--years=1:2", "--option", "simple coppice", "--option", "selection coppice", "-n", 32)  # within the limit of a page
    sure = re.search(r"HOW SURE .*?(Over the years .*?) ASSUMED", " ".join(good("-b", *few, "rotation").out.split()))[1]
    expect_in(sure, " ".join(report("rotation", few=few)[1].text["dl"].split()), "the same as the page")
    expect_in("by the index ", report("-s", "simulation.contact_model=index", "paper-site")[1].text["div"])


GROWS = ("{name: grows, stools: {per_ha: 800, spacing_m: 0.3}, shoots: [{per_ha: 2000, dbh_m: 0.08, height_m: 8}],"
         " growth: {shoots: {dbh_most_m: 0.2, dbh_rate_1_y: 0.1, height_most_m: 14, height_rate_1_y: 0.1}, shoots_young: 2.5, shoots_old: 2.5},"
         " energy: {model: brauner, u_J_m3: 100000, offset: whole}}")
STAYS = "{name: stays, trees: [{per_ha: 300, dbh_m: 0.2, height_m: 12}], energy: {model: brauner, u_J_m3: 100000, offset: whole}}"


def uncertain(f, cut, kept):
    """Return two options of one forest on the paper's slope, with uncertain energy per stem."""
    stand = "  - {{name: {}, forest: [{{from_m: 10, to_m: 60, stand: {}}}]}}\n"
    return f.write("turn.yaml", "ceduo: scene/1\ntitle: A turn\nrock: {shape: sphere, diameter_m: 0.5, density_kg_m3: 2600}\n"
                   "release: {x_m: 1, vx_m_s: 3}\nslope: {vertices_m: [[0, 80], [100, 0]], segments: [{rn: 0.35, rt: 0.85}]}\n"
                   "controls: [{x_m: 80, accepted_kJ: 20}]\noptions:\n" + stand.format("cut", cut) + stand.format("kept", kept)
                   + "simulation: {rocks: 500}\n"
                   'uncertainty: [{path: "options[*].forest[0].stand.energy.u_J_m3", lo: 50000, hi: 200000}]\n')


def test_rotation():
    """A scene with a rotation reports the uncertainty of its mean, per option and of the difference, and orders as the short
    page"""
    with Folder() as f:
        scene = uncertain(f, GROWS, STAYS)
        words = " ".join(report(scene, few=("--sensitivity=256",))[1].text["body"].split())
        figures = good("--sensitivity=256", "--years", "-n", 400, "-f", "json", scene).json()[0]
        short = " ".join(good("-b", scene).out.split())
        still = " ".join(report(uncertain(f, STAYS, STAYS.replace("300", "200")), few=("--sensitivity=256",))[1].text["body"].split())
    rows = [row for row in figures["figures"] if row["figure"] == "rotation.exceed_probability"]
    first, second = sorted((row for row in rows if row["against"] is None), key=lambda row: row["value"])
    for row in (first, second):
        expect(re.search(rf"{row['option']} \d+ \d+–\d+ {1000 * row['uncertainty']['p5']:.0f}–{1000 * row['uncertainty']['p95']:.0f}", words), row, words)
    ends = next((row["uncertainty"]["p5"], row["uncertainty"]["p95"]) for row in rows if row["against"])
    ends = ends if first["option"] == "kept" else (-ends[1], -ends[0])  # better minus worse
    order = figures["ranking"][0]
    said = f"Over the years '{order['better']}' beats '{order['than']}' in {100 * order['probability']:.0f} % of plausible cases"
    expect_in(said, words)
    expect_in(f"Difference: {1000 * ends[0]:.0f} to {1000 * ends[1]:.0f} per 1000 (90 % range).", words)
    expect(re.search(r"HOW SURE [^.]*\. Over the years ", words), words)
    expect(re.search(r"HOW SURE [^.]*\. Over the years '(cut|kept)' beats ", short), short)
    expect(re.search(r"HOW SURE [^.]*\. Today 'cut' beats 'kept'", still) and "ver the rotation" not in still, still)


def test_one_figure():
    """The table of uncertainty has the figures of the run, if that has more rocks, and names the number of rocks of its error"""
    run = ("-n", 1500, "-s", UNCERTAINTY[3], "four-systems")
    options = good("-b", "-f", "json", *run).json()[0]["options"]
    text, _ = report("--sensitivity=20", *run, few=())
    flat = re.sub(r"\s+", " ", html.unescape(re.sub(r"<[^>]*>", " ", text)))
    rows = flat[flat.index("sampling 90 % range"):flat.index("Inputs that decide '")]
    for option in options:
        share = option["controls"][0]["wooded"]
        ends = math.floor(1000 * share["exceed_lo"]), math.ceil(1000 * share["exceed_hi"])
        expect_in(f"{option['name']} {1000 * share['exceed_probability']:.0f} {ends[0]}–{ends[1]} ", rows)
    expect_in("Sampling error: 1500 rocks; ", flat)


def test_odd_titles():
    """Titles and names with HTML characters stay intact; control characters become visible"""
    _, page = report("-s", 'title="' + ODD.replace('"', '\\"') + '"', "paper-site")
    expect(page.text["title"].startswith(ODD), page.text["title"])
    expect_in(ODD, page.text["h1"])
    expect("script" not in page.names, "a script")
    text, page = report("-s", 'controls[0].name="]]> --> &lt; \\u0007\\ufdd0\\ufffe\\U0001ffff<svg onload=x>"', "paper-site")
    check_page(text, page)
    expect_in(html.escape("]]> --> &lt; \\x07\\xef\\xb7\\x90\\xef\\xbf\\xbe\\xf0\\x9f\\xbf\\xbf<svg onload=x>", quote=True), text)


HEAD = {"place": "Serra <b>", "owner": "Comune di 'Serra'", "parcel": "12 & 14/b", "author": "dott. for. A. Rossi",
        "date": "24/11/2026", "note": "prot. 1402"}


def test_head():
    """The head has the scene's entries, escaped, and always a line to sign; missing entries are omitted, except for the date"""
    lines = re.compile(r'<dl class="head">(.*?)</dl>', re.S)
    text, page = report("-s", "page=" + json.dumps(HEAD), "paper-site")
    check_page(text, page)
    expect_equal(lines.search(text)[1], "\n".join(f"<dt>{key.capitalize()}</dt>\n<dd>{html.escape(HEAD[key]).replace('&#x27;', '&#39;')}</dd>"
                                                  for key in ("place", "owner", "parcel", "author", "note", "date")) +
                 '\n<dt>Signature</dt>\n<dd class="line"></dd>\n')
    expect_equal(lines.search(report("-s", "page={date: ''}", "paper-site")[0])[1],
                 '<dt>Date</dt>\n<dd class="line"></dd>\n<dt>Signature</dt>\n<dd class="line"></dd>\n', "of a scene that says nothing")
    for key, value in HEAD.items():
        expect_in(f"<dd>{html.escape(value).replace('&#x27;', '&#39;')}</dd>", report("-s", f"page.{key}={json.dumps(value)}", "terrace")[0])
    plain, headed = (good("-b", "-f", "csv", *FEW, *more, "paper-site").out for more in ((), ("-s", "page=" + json.dumps(HEAD))))
    expect_equal(headed, plain, "no figure differs")
    listed = good("--list-parameters").out
    expect(all(re.search(rf"^page\.{key} +text ", listed, re.M) for key in HEAD), listed)


def contrast(colour, opacity=1.0):
    """Return the contrast of a colour on white paper by WCAG, printed in grey"""
    parts = [(opacity * int(colour[i:i + 2], 16) + (1 - opacity) * 255) / 255 for i in (1, 3, 5)]
    linear = [v / 12.92 if v <= .04045 else ((v + .055) / 1.055) ** 2.4 for v in parts]
    return 1.05 / (.2126 * linear[0] + .7152 * linear[1] + .0722 * linear[2] + .05)


def find_pictures(text):
    """Return the pictures by title."""
    return dict(zip(re.findall(r"<figcaption>(.*?)</figcaption>", text), re.findall(r"<svg.*?</svg>", text, re.S), strict=True))


def find_tables(text):
    """Return each table as caption, heads and rows of cells; a row has its class first."""
    found = []
    for table in re.findall(r"<table>(.*?)</table>", text, re.S):
        caption = re.search(r"<caption>(.*?)</caption>", table)
        rows = [[kind or ""] + re.findall(r"<t[hd][^>]*>([^<]*)</t", row)
                for kind, row in re.findall(r'<tr(?: class="(\w+)")?>(.*?)</tr>', table, re.S)]
        found.append((html.unescape(caption[1]) if caption else "", rows[0][1:], [[html.unescape(c) for c in row] for row in rows[1:]]))
    return found


def test_trajectories():
    """Trajectories are drawn on the slope and as heights above ground; every line prints well in black and white"""
    text, page = report("paper-site", few=("-n", 200, "-s", "uncertainty=none"))
    title = next(t for t in find_pictures(text) if "slope, forest, and trajectories" in t)
    ways = re.search(r'<path[^>]* d="([^"]*)" stroke-opacity=', find_pictures(text)[title])
    expect(ways and ways[1].count("M") >= 140, "80 trajectories twice", title, ways and ways[1].count("M"))
    for line in re.findall(r"<path[^>]*>", text):
        colour, width = re.search(r'stroke="(#\w+)"', line), re.search(r'stroke-width="([\d.]+)"', line)
        opacity = re.search(r'stroke-opacity="([\d.]+)"', line)
        if colour:
            expect(contrast(colour[1], float(opacity[1]) if opacity else 1.0) >= 3, "too pale", line[:120])
            expect(float(width[1]) >= 0.8, "too thin", line[:120])


def read_axes(picture):
    """Return the left axes as x, top and bottom, the bottom axes as x0, x1, and the labels at the left by y."""
    path = next(p for p in re.findall(r' d="([^"]*)"/>', picture) if re.match(r"M[\d.]+ [\d.]+[VH]", p))
    left = [tuple(map(float, m)) for m in re.findall(r"M([\d.]+) ([\d.]+)V([\d.]+)", path)]
    bottom = [tuple(map(float, m)) for m in re.findall(r"M([\d.]+) [\d.]+H([\d.]+)", path)]
    labels = re.findall(r'<text x="([\d.]+)" y="([\d.]+)"[^>]*text-anchor="end">([^<]*)</text>', picture)
    return left, bottom, [(float(y), label) for _, y, label in labels]


def check_pair(scene):
    """The best option and the present one, which is the first, stand beside each other with equal axes and scales"""
    options = good("-b", "-f", "json", *FEW, scene).json()[0]["options"]
    shares = {o["name"]: (o["window"] or {"mean": o["controls"][-1]["wooded"]["exceed_probability"]})["mean"] for o in options}
    best, present = min(shares, key=shares.get), options[0]["name"]
    expect(best != present, shares)
    pair = find_pictures(report(scene)[0])
    axes = [read_axes(pair[title]) for title in (f"Recommended: {best}", f"Present: {present}")]
    expect_equal(axes[0], axes[1], "axes and scales of the two pictures")
    expect_equal((len(axes[0][0]), len({x for x, *_ in axes[0][0]}), len(axes[0][1])), (3, 1, 1), "axes")
    expect(axes[0][1][0][1] >= 45 * 8, "as wide as the picture of 46 cells", axes)


def test_one_axis():
    """Slope, heights and energies have one x axis and one width; the best option stands beside the present one on one scale"""
    text, _ = report("paper-site")
    left, bottom, _ = read_axes(find_pictures(text)["current: slope, forest, and trajectories"])
    expect_equal((len(left), len({x for x, *_ in left}), len(bottom)), (3, 1, 1), "axes")
    expect(bottom[0][1] >= 91 * 8, "as wide as the picture of 92 cells", bottom)
    tall = [{"per_ha": 900, "dbh_m": 0.4, "height_m": 40, "volume_m3": 2}]
    with Folder() as f:
        check_pair(f.write("tall.yaml", wooded_scene(forest=None, options=[{"name": "low", "forest": [belt(10, 95)]},
                                                                           {"name": "tall", "forest": [belt(10, 95, trees=tall)]}])))
    check_pair("four-systems")
    alone = report("--option", "coppice with standards", "--option", "coppice with standards, just cut", "four-systems")[0]
    expect_in("Recommended, and present: coppice with standards", list(find_pictures(alone)), "no second picture")


def test_angles():
    """The picture of the slope shows reach and shadow angle of the control, each as a line that ends there"""
    for scene in ("paper-site", "road-below"):
        angles = good("-b", "-f", "json", *FEW, scene).json()[0]["options"][0]["controls"][0]["topography"]
        picture = next(iter(find_pictures(report(scene)[0]).values()))
        words = html.unescape(" ".join(re.findall(r"<text[^>]*>([^<]*)</text>", picture)))
        for name in ("reach", "shadow"):
            expect_in(f"{name} angle {angles[f'{name}_angle_deg']:.0f}°", words)
        ends = []
        for dashes in ("12 12", "4 4"):  # the lines in black
            path = re.search(rf'stroke="#1c1c1c"[^>]* d="M[\d.]+ [\d.]+L([\d.]+) ([\d.]+)" stroke-dasharray="{dashes}"', picture)
            expect(path, dashes, scene)
            ends.append(path.groups())
        expect_equal(ends[0], ends[1], "both end at the control")
    flat = report("-s", "slope={vertices_m: [[0, 90], [152, 0]], segments: [{rn: 0.35, rt: 0.85}]}", "-s", "release.x_m=0", "paper-site")
    expect("shadow angle" not in flat[1].text["svg"] and "reach angle" in flat[1].text["svg"], "no face")


def test_box():
    """The box of the answer has a colour, a border, a sign and a word for each answer, and text of enough contrast"""
    wide = ("-n", 200, "-s", "uncertainty=[{path: rock.density_kg_m3, lo: 500, hi: 5000}]", "--sensitivity=20")
    borders = set()
    for kind, sign, few, arguments in (("no", "✘ NO", FEW, ("paper-site",)), ("no", "✘ NO", FEW, ("four-systems",)),
                                       ("yes", "✔ YES", ("-n", 300, *FEW[2:]), ("-s", "controls[0].accepted_kJ=2000", "paper-site")),
                                       ("depends", "? IT DEPENDS", wide, ("-s", "controls[0].accepted_kJ=120", "paper-site"))):
        text, _ = report(*arguments, few=few)
        box = re.search(r'<div class="answer (\w+)">\s*<p>([^<]*)', text)
        expect(box and box[1] == kind and html.unescape(box[2]).startswith(sign), kind, box and box.groups())
        rule = re.search(rf"\.answer\.{kind}{{([^}}]*)}}", text)[1]
        borders.add((kind, re.search(r"border-style:(\w+)", rule)[1] if "border-style" in rule else "solid"))
        paper = re.search(r"background:(#\w+)", rule) or re.search(r"\.answer{[^}]*background:(#\w+)", text)
        colour = "".join(2 * c for c in paper[1][1:]) if len(paper[1]) == 4 else paper[1][1:]
        expect(contrast("#1c1c1c") / contrast("#" + colour) >= 4.5, kind, paper[1])
    expect_equal(len({style for _, style in borders}), 3, borders)


def test_years_of_options():
    """All options over the years on one scale, each with its cuts, the best one marked; also as --plot years"""
    run = good("-b", "-f", "json", *FEW, "--years=1:25", "four-systems").json()[0]["options"]
    picture = find_pictures(report("--years=1:25", "four-systems")[0])["Over the years, up to end of the forest (135 m)"]
    words = [html.unescape(w) for w in re.findall(r"<text[^>]*>([^<]*)</text>", picture)]
    best = min(run, key=lambda o: o["window"]["mean"])["name"]
    for number, option in enumerate(run, 1):
        expect_in(f"{'▸' if option['name'] == best else ''}{number} {option['name']}", words)
    left, bottom, labels = read_axes(picture)
    expect_equal((len(left), len(bottom)), (len(run), len(run)))
    scales = {frozenset((y - top, label) for y, label in labels if top <= y <= end + 8) for _, top, end in left}
    expect(len(scales) == 1 and len(next(iter(scales))) >= 2, scales)
    expect_equal("".join(words).count("▼"), sum(y["cut"] for o in run for y in o["years"]), "cuts")
    plot = good("--plot", "years", "-n", 60, "--size", "110x30", "four-systems").out
    expect(all(option["name"] in plot for option in run) and "(limit 50)" in plot, plot)


def test_energies():
    """A table compares the limit with a car, half its mass times the square of its speed, and the classes of net fences"""
    caption, _, rows = next(t for t in find_tables(report("paper-site")[0]) if t[0].startswith("Energies"))
    by_name = {row[1].removeprefix("▸ "): float(row[2]) for row in rows}
    expect_equal(by_name["car of 1500 kg at 50 km/h"], round(1500 / 2 * (50 / 3.6) ** 2 / 1000))
    manual = (PROFILES.parent / "man" / "ceduo-model.7").read_text(encoding="utf-8")
    classes = re.findall(r"^\.It (\d) Ta (\d+) Ta", manual, re.M)
    shown = [(number, energy) for number, energy in classes if f"net fence of class {number}" in by_name]
    expect(len(shown) >= 3 and all(by_name[f"net fence of class {number}"] == float(energy) for number, energy in shown), by_name, classes)
    expect_equal(list(by_name.values()), sorted(by_name.values()), "order")
    expect_equal([row[1] for row in rows if row[0] == "best"], ["▸ limit at end of the forest (135 m)"])
    run = good("-b", "-f", "json", *FEW, "paper-site").json()[0]["options"][0]["controls"][0]
    wooded, bare = run["wooded"]["energy_kJ"], run["bare"]["energy_kJ"]
    for name, value in (("with forest, mean", wooded["mean"]), ("with forest, 95 % are below", wooded["p95"]),
                        ("without forest, 95 % are below", bare["p95"])):
        expect(abs(by_name[f"rocks that arrive {name}"] / value - 1) < 0.005, name, value, by_name)
    large = {row[1]: row[2] for t in find_tables(report("-s", "rock.diameter_m=2", "paper-site")[0]) if t[0].startswith("Energies") for row in t[2]}
    most = max(float(v) for name, v in large.items() if name.startswith("rocks that arrive"))
    expect(max(float(v) for name, v in large.items() if name.startswith("net fence")) >= min(most, 4500), large)


def test_best_row():
    """Each table of the options marks the row of the best one, and only that"""
    windows = {o["name"]: o["window"]["mean"] for o in good("-b", "-f", "json", *FEW, "four-systems").json()[0]["options"]}
    best = min(windows, key=windows.get)
    tables = [rows for _, heads, rows in find_tables(report("four-systems")[0]) if heads and heads[0] == "option"]
    expect(len(tables) >= 3, tables)
    for rows in tables:
        expect_equal([row[1] for row in rows if row[0] == "best"], [f"▸ {best}"])
        expect_equal(sum("▸" in row[1] for row in rows), 1, rows)
    expect(not any(row[0] for _, heads, rows in find_tables(report("paper-site")[0]) if heads and heads[0] == "option" for row in rows))


def test_captions():
    """A caption is in the element of its table or picture, so that no page break comes between them"""
    points = (*UNCERTAINTY[:4], "--sensitivity=256", "-j", 2)
    for scene, few in (("paper-site", points), ("road-below", points), ("four-systems", FEW)):
        text, _ = report(scene, few=few)
        expect("Inputs that decide" in text or scene != "road-below", "a table of inputs")
        expect(not re.search(r":</p>\s*<(table|div class=.pair.|figure)", text), scene)
        expect_equal(text.count("<figure"), text.count("<figcaption>"), scene)
        expect(re.search(r"figure\{[^}]*break-inside:avoid", text) and re.search(r"\btable\{[^}]*break-inside:avoid", text), scene)


def test_like_sentences():
    """No two sentences of a page differ only in names and numbers"""
    seen = {}
    for sentence in re.findall(r"<(?:p|li)[^>]*>([^<]{40,})</", report("four-systems", few=UNCERTAINTY)[0]):
        shape = re.sub(r"'[^']*'|\([^()]*\)|^[^:]*: | Likewise: .*|[\d.]+", "", html.unescape(sentence).strip())
        expect(shape not in seen, sentence, seen.get(shape))
        seen[shape] = sentence


def test_one_rock():
    """One rock is singular in the error, the title and the years"""
    for arguments in (("-b",), ("-b", "--details"), ("--report", "-")):
        for scene in ("paper-site", "four-systems"):
            out = good(*arguments, "-n", 1, "-s", "uncertainty=none", scene).out
            expect(not re.search(r"\b1 rocks\b", out), arguments, re.findall(r".*\b1 rocks\b.*", out))


def test_other_sizes():
    """Blocks of other sizes are shown for a scene with one option; with several it would be the first one's table"""
    expect_in("Blocks of other sizes", report("paper-site")[0])
    expect("Blocks of other sizes" not in report("four-systems")[0], "sizes of one option among four")


def test_whole_tables():
    """Tables with and without forest stay on one sheet; longer tables repeat their heads"""
    text, _ = report("paper-site")
    pair = re.search(r'<div class="pair">(.*?)</div>', text, re.S)[1]
    expect(pair.count("<table>") >= 2 and "forest, " in pair and "without, " in pair, pair)
    style = text[:text.index("</style>")]
    for rule in (r"\btable\{[^}]*break-inside:avoid", r"\.pair\b[^{]*\{break-inside:avoid", r"thead\{display:table-header-group",
                 r"\btr\b[^{]*\{break-inside:avoid"):
        expect(re.search(rule, style), rule)


# short heads of narrow columns, by language; titles above columns in the first table with them
BRIEF = {"en": {"to first", "m3/y", "m3/ha", "left kJ", "wide m", "mean kJ", "ADC m", "worst", "fail C", "fail F", "rotation"},
         "it": {"vs prima", "m3/a", "m3/ha", "resta kJ", "largo m", "kJ medi", "ADC m", "pegg.", "neg. C", "neg. L", "turno", "libera"}}


def test_heads():
    """Heads of tables are full words, in both languages, one above each column"""
    for language, brief in BRIEF.items():
        for arguments in (("four-systems",), ("paper-site",), ("-s", "simulation.contact_model=index", "four-systems")):
            text, _ = report("--language", language, *arguments)
            for table in re.findall(r"<table>(.*?)</table>", text, re.S):
                head, *rows = re.findall(r"<tr>(.*?)</tr>", table, re.S)
                heads = [html.unescape(h) for h in re.findall(r"<t[hd][^>]*>([^<]*)</t", head)]
                expect(not brief & set(heads), language, arguments, heads)
                expect("colspan" not in table, heads)
                for row in rows:
                    expect_equal(len(re.findall(r"<t[hd][ >]", row)), len(heads), f"{heads}: {row}")
    text, _ = report("four-systems")
    heads = [re.findall(r'<th[^>]*>([^<]*)</th>', h) for h in re.findall(r"<thead>(.*?)</thead>", text, re.S)]
    expect_in(["option", "test of energy", "difference to the first option", "test of contact", "chance of a free run",
               "test of free runs", "years in which contact fails", "years in which free runs fail", "standing, m³ per ha"], heads)


def test_powers():
    """Pages print m³ and m², in ASCII and in the scene's text m3; keys keep their names"""
    blocks = ("-s", "blocks={per_year: 0.5, volume_m3: [0.01, 2], exponent: 1.1}", "four-systems")
    for language, felled in (("en", "felled, m\u00b3 per ha and year"), ("it", "tagliati, m\u00b3 per ha e anno")):
        text, page = report("--language", language, *blocks)
        expect_in(felled, page.text["thead"])
        expect(not re.search(r"(?<![\w.])m[23]\b", page.text["dd"] + page.text["table"] + page.text["p"]), language)
        expect_in("volume_m3: [0.01, 2]", page.text["pre"])
    expect_in("to 2 m\u00b3, exponent", good("-b", "--details", *FEW, *blocks).out)
    expect_in("to 2 m3, exponent", good("-b", "--details", *FEW, *blocks, env={"LC_ALL": "C"}).out)


def test_unknown():
    """Uncertain inputs are a sentence of the answer: the range, and whether the answer depends on them"""
    def report_text(*arguments, few=UNCERTAINTY):
        return " ".join(report(*arguments, few=few)[1].text["div"].split())
    between = (r"In nine of ten plausible cases, (\d+) to (\d+) of 1000 rocks arrive with more than (\d+) kJ today\. "
               r"The limit is exceeded in (\d+) to (\d+) of the next 20 years\. ")
    for limit in (50, 2000):
        found = re.search(between + r"The answer is the same in all of these cases\.", report_text("-s", f"controls[0].accepted_kJ={limit}", "paper-site", few=("-n", 300, *UNCERTAINTY[2:])))
        expect(found and int(found[3]) == limit and (int(found[4]) >= 1 if limit == 50 else int(found[5]) == 0), report_text("paper-site"))
    wide = ("-n", 200, "-s", "uncertainty=[{path: rock.density_kg_m3, lo: 500, hi: 5000}]", "--sensitivity=20")
    found = re.search(between + "Some of these cases keep within the limit and some do not: the answer depends on", report_text(
        "-s", "controls[0].accepted_kJ=120", "paper-site", few=wide))
    expect(found and int(found[4]) == 0 < int(found[5]), report_text("-s", "controls[0].accepted_kJ=120", "paper-site", few=wide))
    expect_in("With '", report_text("--option", "selection coppice", "--option", "large reserves", "four-systems"))
    expect_in("Uncertainty was not computed. The answer assumes that the scene is exact.", report_text("paper-site", few=FEW))


EVERYTHING = ("-s", "blocks={per_year: 0.5, volume_m3: [0.01, 2], exponent: 1.1}", "-s", "rules=toscana", "-s",
              "design={survey: good, blocks: poor}", "-s",
              "controls=[{x_m: 100, name: path, accepted_kJ: 30}, {x_m: 135, name: road, accepted_kJ: 50}]")


def test_office():
    """With several options the page has percentiles and design values of the drawn one, rules with sources, and hazard curves"""
    _, page = report("--option", "selection coppice", "--option", "large reserves", *EVERYTHING, "four-systems",
                     few=("-n", 200, "-s", "uncertainty=none"))
    for place in ("path (100 m)", "road (135 m)"):
        expect(re.search(f"At {re.escape(place)}, with '(selection coppice|large reserves)'", page.text["h3"]), page.text["h3"])
    expect_equal(page.text["caption"].count("Design values of a fence by UNI 11211-4"), 2, page.text["caption"])
    expect_in("Rules of Toscana", page.text["h2"])
    expect_in("check the text in force", page.text["p"])
    expect_in("art. 22, D.P.G.R. 48/R (2003)", page.text["p"])
    expect_in("How often, and with how much, at road (135 m)", page.text["figcaption"])


def test_few_rocks():
    """With fewer rocks than the default the uncertainty also uses fewer"""
    _, page = report("four-systems", few=("-n", 50, *UNCERTAINTY[2:]))
    expect_in("Sampling error: 50 rocks; ", page.text["p"])


def test_left_out():
    """A page of many options with blocks omits results of other commands, and reports it"""
    _, page = report(*EVERYTHING, "four-systems", few=("-n", 200, "--sensitivity=20"))
    expect_in("Left out of this long page: ", page.text["p"])
    expect("Options side by side" not in page.text["figcaption"], page.text["figcaption"])
    expect("path (100 m)" not in page.text["h3"], page.text["h3"])
    expect_in("At road (135 m), with ", page.text["h3"])


def test_chapters():
    """Several scenes give chapters in order; a bad one is reported and omitted"""
    text, page = report("paper-site", "terrace", "staggered")
    check_page(text, page)
    expect_equal(page.names.count("h1"), 4, "what is said of all, and chapters")
    expect_equal(page.names.count("section"), 4, "sections")
    with Folder() as f:
        bad = f.path / "bad.yaml"
        bad.write_text("ceduo: scene/1\n")
        done = ceduo("--report", f.path / "page.html", *FEW, bad, "paper-site")
        expect_equal(done.status, INPUT, done)
        expect_equal(Page((f.path / "page.html").read_text(encoding="utf-8")).names.count("h1"), 1, "chapters")
        done = ceduo("--report", f.path / "none.html", *FEW, bad)
        expect(done.status == INPUT and not (f.path / "none.html").exists(), done)


def test_refused():
    """Unsupported requests of the report are refused before any computation"""
    for arguments in (("-o", "x.html"), ("--plot", "profile"), ("-f", "json"), ("--rows", "stands", "-f", "csv"),
                      ("--find", "rock.diameter_m=1:2", "--goal", "adc"), ("--calibrate", "rock.diameter_m=1:2")):
        done = ceduo("--report", "-", *arguments, "paper-site")
        expect(done.status == USAGE and done.out == "", done)
    with Folder() as f:
        full = f.path / "full.html"
        full.symlink_to("/dev/full")
        expect_equal(ceduo("--report", full, *FEW, "paper-site").status, OUTPUT)
    expect_equal(ceduo("--report", "/dev/null/page.html", "paper-site").status, OUTPUT)
    expect_equal(ceduo("--report", "-").status, USAGE)


def test_file_forgotten():
    """A scene in place of the page is not overwritten; a page ends in .html or .htm"""
    with Folder() as f:
        path, other = f.write("scene.yaml", scene()), f.write("other.yaml", scene(title="another"))
        before = other.read_bytes()
        for name in (other, path, "", "x", ".yaml", "page.html.yaml", "pagehtml", "page.htmlx", "/dev/stdout"):
            done = ceduo("--report", name, path, cwd=f.path)
            expect_equal((done.status, done.out), (USAGE, ""), done)
            expect(done.err.startswith(f"ceduo: --report: '{name}' does not end in .html or .htm; "), done)
            expect("--report page.html " in done.err, done)
        expect_equal((f.names(), other.read_bytes()), (["other.yaml", "scene.yaml"], before))
        for name in ("a.html", "b.htm", "c.HTML", "d.Htm"):
            good("--report", f.path / name, *FEW, path)
            expect((f.path / name).read_bytes().startswith(b"<!DOCTYPE html>"), name)


def test_odd_scenes():
    """Without forest, without accepted energy, or with one rock the page is still printed"""
    for changes in (("-s", "forest=[]"), ("-s", "controls=[{x_m: 100}]"), ("-n", "1"),
                    ("-s", "simulation.contact_model=index"), ("--years", "0:3"), ("-s", "release.vx_m_s=0.1", "--seed", "7")):
        check_page(*report(*changes, "paper-site"))


def test_tidy():
    """tidy reports nothing, if it is installed"""
    if not shutil.which("tidy"):
        return
    for scene, few in (("paper-site", UNCERTAINTY), ("rotation", FEW)):
        text, _ = report(scene, few=few)
        done = subprocess.run(["tidy", "-q", "-e", "-utf8"], input=text, capture_output=True, text=True, check=False)
        expect_equal((done.returncode, done.stderr), (0, ""), scene)


if __name__ == "__main__":
    run_all(__name__)
