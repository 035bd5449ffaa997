#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A net fence at a control: its keys, shares, the fence that is enough, its years, and how pages and tables show them."""
import csv
import io
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import INPUT, Folder, ceduo, expect, expect_equal, expect_in, expect_near, good, run_all, scene  # noqa: E402

SCENE = "fence-below"
CLASSES = [100, 250, 500, 1000, 1500, 2000, 3000, 4500]
FEW = ("-n", 1000, "-s", "uncertainty=none")
EDGE = {"vertices_m": [[0, 8], [0.01, 0], [30, 0]], "segments": [{"rn": 0.3, "rt": 0.8}]}  # the fall of test_fence.c


def fall(fence, **more):
    return scene(rock={"mass_kg": 1000, "density_kg_m3": 2600}, release={"vx_m_s": {"mean": 10, "spread": 2, "kind": "uniform"}},
                 slope=EDGE, controls=[{"x_m": 10, **({"fence": fence} if fence else {})}], simulation={"law": "lumped", "rocks": 20000},
                 **more)


def json_of(*arguments):
    return good("--batch", "-f", "json", *arguments).json()[0]


def control_of(*arguments, option=0):
    return json_of(*arguments)["options"][option]["controls"][0]


def test_shares():
    """A rock defeats the fence above or through it; worn ones are held with more than a third of its energy"""
    with Folder() as f:
        control = control_of(f.write("s.yaml", fall({"energy_kJ": 100, "height_m": 3})))
    expect_equal(control["fence"], {"energy_kJ": 100, "height_m": 3, "life_y": 50, "window": None})
    for key, wanted in (("over", 0.720973), ("through", 0.512660), ("both", 0.268233), ("defeated", 0.9654), ("worn", 0.0346)):
        found = control["bare"]["fence"]
        expect_near(found[key], wanted, 4 * (wanted * (1 - wanted) / 20000) ** 0.5, key)
        expect(found[f"{key}_lo"] < wanted < found[f"{key}_hi"] or key == "both", key, found)
    expect_near(found["over"] + found["through"] - found["both"], found["defeated"], 1e-12)
    expect_equal([e["class"] for e in found["enough"]], [None] * 4 + [1] * 3)
    expect_equal(found["smallest"], {"height_m": 6, "class": 1, "energy_kJ": 250, "defeated": 0, "decided": True})


def test_enough():
    """The class of each height is enough as a fence of its own, and the next smaller one is not; with blocks, too"""
    base = control_of(*FEW, "--option", "coppice with standards", SCENE)
    limit = 0.05  # one rock in 100 years of one in 5 years
    for side in ("bare", "wooded"):
        for e in base[side]["fence"]["enough"][:3]:
            for smaller in range(2):
                index = len(CLASSES) - 1 if e["class"] is None else e["class"] - smaller
                if index < 0 or (e["class"] is None and smaller):
                    continue
                fence = control_of(*FEW, "--option", "coppice with standards", "-s",
                                   f"controls[0].fence={{energy_kJ: {CLASSES[index]}, height_m: {e['height_m']}}}", SCENE)[side]["fence"]
                enough = e["class"] is not None and not smaller
                expect_equal(fence["defeated"] <= limit, enough, f"{side} {e} class {index}: {fence['defeated']}")
                if enough:
                    expect_near(fence["defeated"], e["defeated"], 1e-12, e)
        rate = base[side]["fence"]["per_year"]
        expect_near(rate, 0.2 * base[side]["fence"]["defeated"], 1e-15, side)


def test_years():
    """The figures of the window equal those of each year on its own, and those of --years"""
    window = control_of(*FEW, "--years=1:6", SCENE)["fence"]["window"]
    each = [control_of(*FEW, "-s", f"years.first={y}", "-s", f"years.last={y}", SCENE)["fence"]["window"] for y in range(1, 7)]
    listed = json_of(*FEW, "--years=1:6", SCENE)["options"][0]["years"]
    means = [e["mean"] for e in each]
    expect_near(window["mean"], sum(means) / 6, 1e-12)
    expect_near(window["worst"], max(means), 1e-15)
    expect_equal(window["worst_year"], 1 + means.index(max(means)))
    expect_equal(means, [y["controls"][0]["wooded"]["fence"]["defeated"] for y in listed])
    expect_near(window["per_year"], sum(e["per_year"] for e in each) / 6, 1e-12)
    expect_equal(window["failing_years"], sum(m > 0.05 for m in means))
    today = control_of(*FEW, SCENE)["wooded"]["fence"]
    of_years = [y["controls"][0]["wooded"]["fence"] for y in listed]
    for i in range(7):  # today counts, too
        classes = [9 if f["enough"][i]["class"] is None else f["enough"][i]["class"] for f in [today, *of_years, window]]
        expect_equal(classes[-1], max(classes[:-1]), f"height {i + 2}: {classes}")
        if classes[-1] < 9:
            defeated = [f["enough"][i]["defeated"] for f, c in zip([today, *of_years], classes) if c == classes[-1]]
            expect(max(defeated) <= window["enough"][i]["defeated"] <= 0.05, f"height {i + 2}: {defeated}")
    expect_equal([y["controls"][0]["fence"]["window"] for y in listed], [None] * 6)


def test_design():
    """Design values of the rocks that arrive and of the system; class and factor; the bare slope has one kind"""
    control = control_of(*FEW, "-s", "design.gamma_e=1.2", SCENE)
    design = control["design"]
    expect_equal(design["factors"], {"survey": 1.02, "model": 1.1, "blocks": 1.1, "gamma_e": 1.2})
    expect_near(design["arrivals"]["energy_kJ"], control["wooded"]["translation_kJ"]["p95"] * (1.02 * 1.1) ** 2 * 1.1, 1e-9)
    expect(design["system"]["energy_kJ"] < design["arrivals"]["energy_kJ"], design)
    for values in (design["bare"], design["arrivals"], design["system"], design["worst"]["arrivals"], design["worst"]["system"]):
        expect_equal(values["class"], next(i for i, c in enumerate(CLASSES) if c >= values["energy_kJ"]))
        expect_equal(values["class_gamma_e"], next(i for i, c in enumerate(CLASSES) if c >= 1.2 * values["energy_kJ"]))
    for kind in ("arrivals", "system"):
        expect(design["worst"][kind]["energy_kJ"] >= 0.9 * design[kind]["energy_kJ"], kind, design)
    page = good("--batch", "--details", *FEW, "-s", "design.gamma_e=3.255829774916818", SCENE).out
    expect_in("class at factor 3.256\n", page)
    with Folder() as f:
        bare = control_of(f.write("s.yaml", fall({"energy_kJ": 1, "height_m": 1}, design={"survey": "good", "blocks": "good"})))
    expect_equal([bare["design"]["bare"], bare["design"]["system"]], [bare["design"]["arrivals"]] * 2, "no stems")


def test_none():
    """Without a fence its figures are null, and no page or picture has one"""
    with Folder() as f:
        path = f.write("s.yaml", fall(None))
        control = control_of(path)
        expect_equal([control["fence"], control["design"], control["bare"]["fence"]], [None] * 3)
        for arguments in ((), ("--details",)):
            expect("fence" not in good("--batch", *arguments, path).out.lower(), arguments)
        expect_in("the control has no 'fence'", good("--plot=fence", path).out)
        expect("fence" not in good("--report=-", "-n", 50, path).out.lower(), "report")


def test_no_energy_of_rotation():
    """Kits are classed by translation: with spin the share above the same accepted energy is larger"""
    spun = control_of("-n", 1000, "-s", "controls[0].accepted_kJ=62", "-s", "controls[0].fence={energy_kJ: 62, height_m: 90}",
                      "-s", "simulation.law=crsp", "-s", "simulation.friction_bound=true", "-s", "slope=short-steep",
                      "-s", "controls[0].x_m=38", "-s", "forest=[]", "-s", "uncertainty=none", "paper-site")
    expect(spun["bare"]["fence"]["through"] < spun["bare"]["exceed_probability"] - 0.02, spun["bare"])


def test_pages():
    """The short page has one point, the full page classes and design values, the report the picture; also in Italian"""
    short = " ".join(good("--batch", *FEW, SCENE).out.split())
    expect_in("FENCE Enough without forest: ", short)
    expect_in("; with 'coppice with standards': today ", short)
    expect_in(" defeat the fence of 4 m and 500 kJ", short)
    expect("in 50 years" not in short, short)
    full = good("--batch", "--details", *FEW, SCENE).out
    for text in ("in 50 years it happens", "pass above the fence", "held, with over a third of its energy", "Smallest class of a fence", "worst year: one system",
                 "Not judged: "):
        expect_in(text, " ".join(full.split()))
    page = good("--report=-", *FEW, SCENE).out
    expect_in("Which class of fence is enough at fence above the road (96 m)", page)
    italian = good("--batch", "--language=it", *FEW, SCENE).out
    expect_in("RETE", italian)
    expect("FENCE" not in italian and "Enough" not in italian, italian)


def test_picture():
    """A line per option and without forest, over the classes"""
    out = good("--plot=fence", *FEW, SCENE).out
    for text in ("of 1000 that defeat a fence of 4 m, by its class", "0 without forest", "1 coppice with standards", "2 selection coppice"):
        expect_in(text, out)


def test_tables():
    """CSV has the columns, and --each sets the fence of a row"""
    names = good("--list-columns").out
    for name in ("fence.energy_kJ", "fence.window.worst", "bare.fence.defeated", "wooded.fence.smallest.class", "design.system.class",
                 "wooded.fence.enough[6].height_m"):
        expect_in(f"\n{name} ", names)
    with Folder() as f:
        path = f.write("s.yaml", fall({"energy_kJ": 100, "height_m": 3}))
        rows = f.write("rows.csv", "controls[0].fence.energy_kJ,controls[0].fence.height_m\n100,3\n250,6\n104,10\n")
        done = ceduo("--batch", "-f", "csv", "--columns=bare.fence.defeated,bare.fence.through", f"--each={rows}", path)
        expect_equal(done.status, 0, done)
    found = [[float(r["bare.fence.defeated"]), float(r["bare.fence.through"])] for r in csv.DictReader(io.StringIO(done.out))]
    expect_near(found[0][0], 0.9654, 0.01)
    expect_equal(found[1], [0, 0])
    expect_equal(found[2][0], found[2][1])


def test_sensitivity():
    """The defeated share has a plausible range and its inputs; the page names them if the range holds the limit"""
    with Folder() as f:
        path = f.write("s.yaml", fall({"energy_kJ": 104, "height_m": 10}, uncertainty=[{"path": "simulation.gravity_m_s2", "lo": 9.3, "hi": 10.3},
                                                                                     {"path": "slope.segments[*].rn", "lo": 0.29, "hi": 0.31}]))
        answer = good("--sensitivity=64", "-f", "json", "-n", 400, path).json()[0]
        figure = [g for g in answer["figures"] if g["figure"] == "fence.defeated"][0]
        expect(figure["uncertainty"]["p5"] < 0.05 < figure["uncertainty"]["p95"], figure)
        expect(figure["inputs"][0]["path"] == "simulation.gravity_m_s2" and figure["inputs"][0]["total"] > 0.9, figure["inputs"])
        expect_in("It depends on", " ".join(good("--batch", "-n", 400, path).out.split()))


def test_mistakes():
    """A fence needs an energy and a height, both in range"""
    cases = (({"energy_kJ": 100}, "'height_m' is missing"), ({"height_m": 3}, "'energy_kJ' is missing"),
             ({"energy_kJ": -1, "height_m": 3}, "is below 0 kJ"), ({"energy_kJ": 100, "height_m": 0}, "height_m: 0 is not above 0 m"),
             ({"energy_kJ": 100, "height_m": 3, "life_y": 0}, "life_y: 0 is not above 0"), ({"energy_kJ": 100, "height_m": 3, "class": 2}, "class"))
    with Folder() as f:
        for fence, message in cases:
            r = ceduo("--check", f.write("s.yaml", fall(fence)))
            expect_equal(r.status, INPUT, f"{fence}: {r}")
            expect_in(message, r.err)
        r = ceduo("--check", f.write("t.yaml", fall(None, design={"survey": "good", "blocks": "good", "gamma_e": 0.5})))
        expect_equal(r.status, INPUT, r)


if __name__ == "__main__":
    run_all(__name__)
