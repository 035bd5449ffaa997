#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: threads
"""--sensitivity: uncertain inputs, their effect on the answer, and errors."""
import csv
import html
import io
import json
import math
import random
import re

from harness import DONE, FULL, INPUT, PROFILES, USAGE, Folder, ceduo, expect, good, expect_equal, expect_in, expect_near, run_all, scene, stand

LAW = {"path": "forest[*].stand.energy.model", "one_of": ["brauner", "dorren"]}
DENSITY = {"path": "rock.density_kg_m3", "lo": 2400, "hi": 2750}
POINTS = 32
ENERGY = {"model": "brauner", "u_J_m3": 102800, "offset": "whole"}
TREES = [{"per_ha": 500, "dbh_m": 0.12, "height_m": 9, "volume_m3": 0.05}]


def wood(**changes):
    return stand(**{"stools": None, "shoots": None, "trees": TREES, "energy": ENERGY, **changes})


def measured(**changes):
    """Return a scene with all values given and measured."""
    return scene(**{"rock": {"shape": "sphere", "diameter_m": 0.7, "density_kg_m3": 2600},
                    "controls": [{"x_m": 90, "accepted_kJ": 20}],
                    "forest": [{"from_m": 0, "to_m": 80, "stand": wood()}],
                    "release": {"vx_m_s": 5, "height_m": 1},
                    "slope": {"vertices_m": [[0, 70], [100, 0]],
                              "segments": [{"rn": 0.3, "rt": 0.9, "roughness_rad": 0.2, "friction": 0.5}]},
                    **changes})


def answer(what, *arguments, points=POINTS):
    with Folder() as f:
        path = f.write("s.yaml", what)
        r = ceduo(f"--sensitivity={points}", "-f", "json", "-n", 200, *arguments, path)
        expect_equal(r.status, DONE, r)
        return json.loads(r.out)


def run_scene(what, *arguments, rocks=100):
    with Folder() as f:
        return good("-f", "json", "-n", rocks, *arguments, f.write("s.yaml", what)).out


def paths(result):
    return sorted(i["path"] for i in result["figures"][0]["inputs"])


def figure(result, name, option=0):
    rows = [f for f in result["figures"] if f["figure"] == name and f["against"] is None]
    return rows[option]


def test_nothing():
    """If nothing is uncertain the page reports it, and nothing is computed"""
    for what in (measured(), measured(uncertainty="none"), measured(uncertainty=[])):
        result = answer(what)
        expect_equal((result["figures"], result["ranking"], result["evaluations"]), ([], [], 0))
    with Folder() as f:
        for uncertainty, told in ([], "Nothing in this scene is marked as assumed"), ("none", "Uncertainty was not computed: the scene has 'uncertainty: none'"):
            path = f.write("s.yaml", measured(uncertainty=uncertainty))
            report = f.path / "r.html"
            expect_in(told, " ".join(ceduo("--sensitivity", path).out.split()))
            expect_equal(ceduo("--report", report, "-n", 20, path).status, DONE)
            words = " ".join(html.unescape(re.sub("<[^>]*>", "", report.read_text(encoding="utf-8"))).split())
            expect_in(told, words)
            expect_equal("Nothing in this scene" in words, uncertainty == [], "the report")


def test_page_of_a_run():
    """A page has the sampling error, and the range of uncertain inputs or that there are none"""
    for what, says in ((measured(), False), (measured(uncertainty=[DENSITY]), True)):
        with Folder() as f:
            page = " ".join(good("--batch", "--details", "-n", 50, f.write("s.yaml", what)).out.split())
            expect(re.search(r"Sampling error \(50 rocks\): [\d-]+–[\d-]+\. Uncertain inputs: [\d-]+–[\d-]+" if says else
                             r"Sampling error \(50 rocks\): [\d-]+–[\d-]+\. Nothing in this scene is marked as assumed\.", page), page)


def test_lights():
    """A light that changes within the plausible cases names its decisive input; another does not"""
    speed = {"path": "release.vx_m_s", "lo": 1, "hi": 9}
    trees = {"path": "forest[0].stand.trees[0].per_ha"}
    for uncertainty, energy, contact, free_run in (([speed], True, False, False), ([trees | {"lo": 150, "hi": 600}], False, True, False),
                                             ([trees | {"lo": 500, "hi": 1500}], False, False, True)):
        accepted = 120 if energy else 1e6  # kJ: from 1 to 9 m/s at the release .01 to .15 of the rocks pass with more
        with Folder() as f:
            path = f.write("s.yaml", measured(uncertainty=uncertainty, controls=[{"x_m": 90, "accepted_kJ": accepted}]))
            result = answer(measured(uncertainty=uncertainty, controls=[{"x_m": 90, "accepted_kJ": accepted}]))
            exceed = figure(result, "exceed_probability")
            expect_equal(exceed["uncertainty"]["p5"] <= 0.05 < exceed["uncertainty"]["p95"], energy, exceed)
            page = " ".join(ceduo(f"--sensitivity={POINTS}", "-n", 200, path).out.split())
            expect_equal("The test of energy depends on " in page, energy, page)
            expect_equal("The test of contact depends on " in page, contact, page)
            expect_equal("The test of free run depends on " in page, free_run, page)


def test_lights_of_two_inputs():
    """Two equal kinds of trees with equal uncertainty are both named; if one is almost certain, only the other"""
    tree = {"per_ha": 200, "dbh_m": 0.3, "height_m": 18}
    for least, most, both in ((50, 350, True), (195, 205, False)):
        uncertainty = [{"path": "forest[0].stand.trees[0].per_ha", "lo": 50, "hi": 350},
                 {"path": "forest[0].stand.trees[1].per_ha", "lo": least, "hi": most}]
        forest = [{"from_m": 0, "to_m": 85, "stand": {"trees": [tree, tree], "species": "fagus-sylvatica"}}]
        what = measured(uncertainty=uncertainty, forest=forest, simulation={"threshold_m": 30})
        with Folder() as f:
            page = " ".join(good("--sensitivity=128", "-n", 20, f.write("s.yaml", what)).out.split())
            found = re.search(r"The test of contact depends on (.*?)\.", page)
            expect(found, page)
            expect_equal(" and " in found[1], both, found[1])


def test_lights_of_gaps():
    """A gap fails the test of contact for any stems around it: it depends on no input"""
    uncertainty = [{"path": "forest[0].stand.trees[0].per_ha", "lo": 150, "hi": 600}]
    for start, depends in ((0, True), (60, False)):
        what = measured(uncertainty=uncertainty, forest=[{"from_m": start, "to_m": 85, "stand": wood()}], simulation={"threshold_m": 30})
        with Folder() as f:
            page = " ".join(good(f"--sensitivity={POINTS}", "-n", 20, f.write("s.yaml", what)).out.split())
            expect_equal("The test of contact depends on " in page, depends, page)


def test_index():
    """The index simulates no rock among stems: its figures equal those without forest, and stems do not affect them"""
    uncertainty = [{"path": "forest[0].stand.trees[0].per_ha", "lo": 150, "hi": 600}]
    what = measured(uncertainty=uncertainty, simulation={"contact_model": "index"})
    result = answer(what)
    with Folder() as f:
        run = json.loads(good("-b", "-f", "json", "-n", 200, f.write("s.yaml", what)).out)
    bare = run["options"][0]["controls"][0]["bare"]
    for name in ("reach_probability", "exceed_probability"):
        found = figure(result, name)
        expect_equal([found["value"], *(found["uncertainty"][k] for k in ("p5", "p95"))], [bare[name]] * 3, name)


def test_what_is_not_given():
    """A value missing in the scene is set while it varies, and missing again afterwards"""
    accepted = {"path": "controls[0].accepted_kJ", "lo": 20, "hi": 100}
    result = answer(measured(controls=[{"x_m": 90}], uncertainty=[accepted, DENSITY]))
    exceed = figure(result, "exceed_probability")
    ends = {i["path"]: [i["at_lo"], i["at_hi"]] for i in exceed["inputs"]}
    expect_equal((exceed["value"], ends[DENSITY["path"]]), (None, [None, None]), "without an accepted energy")
    expect(ends[accepted["path"]][0] > ends[accepted["path"]][1] >= 0, ends)


def test_ends_of_counts_and_ranges():
    """A count varies in whole numbers; a factor is clamped to the range"""
    assumed = {"kind": "assumed", "text": "a guess"}
    slope = {"vertices_m": [[0, 70], [100, 0]],
             "segments": [{"rn": 0.3, "rt": 0.98, "roughness_rad": 0.2, "friction": 0.5, "source": assumed}]}
    group = {"path": "forest[0].stand.trees[0].groups.stems", "lo": 1.2, "hi": 4.6}
    trees = [{**TREES[0], "groups": {"stems": 2, "radius_m": 2}}]
    what = measured(slope=slope, forest=[{"from_m": 0, "to_m": 80, "stand": wood(trees=trees)}], uncertainty=[group])
    ends = {i["path"]: i for i in figure(answer(what), "energy_per_released_kJ")["inputs"]}
    with Folder() as f:
        path = f.write("s.yaml", what)
        for key, end, value in ((group["path"], "at_lo", 1), (group["path"], "at_hi", 5),
                                ("slope.segments[0].rt", "at_hi", 0.9999999999999999)):
            run = json.loads(good("--batch", "-f", "json", "-n", 200, "-s", f"{key}={value}", path).out)
            known = run["options"][0]["controls"][0]["wooded"]["energy_per_released_kJ"]["mean"]
            expect(abs(ends[key][end] - known) <= 1e-9 * known, f"{key}={value}: {ends[key][end]} instead of {known}")


def test_named():
    """Named inputs vary within their ranges, and nothing else does"""
    result = answer(measured(uncertainty=[LAW, DENSITY]))
    expect_equal(result["format"], "ceduo-sensitivity-1")
    expect_equal(paths(result), ["forest[*].stand.energy.model", "rock.density_kg_m3"])
    expect_equal(result["evaluations"], result["points"] + 2 * 2)
    by_path = {i["path"]: i for i in figure(result, "exceed_probability")["inputs"]}
    law, density = by_path["forest[*].stand.energy.model"], by_path["rock.density_kg_m3"]
    expect_equal((law["lo"], law["hi"]), ("brauner", "dorren"))
    expect_equal((density["lo"], density["hi"]), (2400, 2750))


def test_ends_are_runs():
    """A figure with one input at either end equals that of the scene with this value"""
    what = measured(uncertainty=[LAW, DENSITY])
    result = answer(what)
    with Folder() as f:
        path = f.write("s.yaml", what)
        for key, values in (("forest[*].stand.energy.model", ("brauner", "dorren")), ("rock.density_kg_m3", (2400, 2750))):
            for end, value in zip(("at_lo", "at_hi"), values):
                run = json.loads(ceduo("--batch", "-f", "json", "-n", 200, "-s", f"{key.replace('*', '0')}={value}", path).out)
                wooded = run["options"][0]["controls"][0]["wooded"]
                for name, known in (("reach_probability", wooded["reach_probability"]),
                                    ("exceed_probability", wooded["exceed_probability"]),
                                    ("energy_per_released_kJ", wooded["energy_per_released_kJ"]["mean"])):
                    found = [i for i in figure(result, name)["inputs"] if i["path"] == key][0][end]
                    expect(abs(found - known) <= 1e-9 * abs(known), f"{key}={value}, {name}: {found} instead of {known}")


def test_value_is_the_run():
    """The figures of the unchanged scene equal those of a run, with its intervals"""
    what = measured(uncertainty=[LAW])
    result = answer(what)
    with Folder() as f:
        run = json.loads(ceduo("--batch", "-f", "json", "-n", 200, f.write("s.yaml", what)).out)
    wooded, found = run["options"][0]["controls"][0]["wooded"], figure(result, "exceed_probability")
    expect_equal((found["value"], found["sampling_lo"], found["sampling_hi"]),
                 tuple(wooded[f"exceed_{k}"] for k in ("probability", "lo", "hi")))
    expect(found["uncertainty"]["p5"] <= found["uncertainty"]["p50"] <= found["uncertainty"]["p95"], found)


def test_assumed():
    """Assumed values have default ranges; a range of the scene overrides them"""
    assumed = {"kind": "assumed", "text": "a guess"}
    trees = [{"per_ha": 400, "dbh_m": 0.2, "height_m": 12, "volume_m3": 0.2, "source": assumed}]
    forest = [{"from_m": 0, "to_m": 80, "stand": wood(trees=trees)}]
    result = answer(measured(forest=forest))
    place = "forest[0].stand.trees[0]."
    expect_equal(paths(result), [place + key for key in ("dbh_m", "per_ha", "volume_m3")])
    dbh = [i for i in result["figures"][0]["inputs"] if i["path"] == place + "dbh_m"][0]
    expect(abs(dbh["lo"] - 0.18) < 1e-12 and abs(dbh["hi"] - 0.22) < 1e-12, dbh)
    named = {"path": place + "dbh_m", "lo": 0.19, "hi": 0.25}
    dbh = [i for i in answer(measured(forest=forest, uncertainty=[named]))["figures"][0]["inputs"] if i["path"] == named["path"]][0]
    expect_equal((dbh["lo"], dbh["hi"]), (0.19, 0.25))


def words_in_uncertainty(result):
    """Return the number of places and both words of the energy law and of the offset, if uncertain."""
    return {i["path"].rpartition(".")[2]: (i["places"], i["lo"], i["hi"]) for i in (result["figures"] or [{"inputs": []}])[0]["inputs"]
            if ".energy." in i["path"] and isinstance(i["lo"], str)}


def test_words_of_nobody():
    """A default energy law is uncertain, once for all stands; so is the energy of an off-centre hit, if the law may be brauner"""
    law, offset = {"model": (2, "brauner", "dorren")}, {"offset": (2, "whole", "dorren")}
    for energy, wanted in ((None, {**law, **offset}), ({"model": "brauner"}, offset), ({"model": "dorren"}, {}),
                           ({"offset": "whole"}, law), (ENERGY, {})):
        belts = [{"from_m": a, "to_m": a + 40, "stand": wood(energy=energy)} for a in (0, 40)]
        expect_equal(words_in_uncertainty(answer(measured(forest=belts))), wanted, energy)
    belts = [{"from_m": 0, "to_m": 80, "stand": wood(energy={"model": "dorren"})}]
    expect_equal(words_in_uncertainty(answer(measured(forest=belts, uncertainty=[LAW]))),
                 {"model": (1, "brauner", "dorren"), "offset": (1, "whole", "dorren")}, "dorren, or brauner")
    four = {key: (8, *words) for key, (_, *words) in (law | offset).items()}
    expect_equal(words_in_uncertainty(json.loads(good("--sensitivity=16", "-f", "json", "-n", 50, "four-systems").out)), four, "shipped stands")


CURVE = {"dbh_most_m": (0.16, 0.15), "dbh_rate_1_y": (0.022, 0.2), "height_most_m": (14, 0.15), "height_rate_1_y": (0.035, 0.2)}
CROWD = {"shoots_young": (16, 0.25), "shoots_old": (3, 0.25), "sdi_most": (1000, 0.2)}


def grown(kind="assumed", **changes):
    """Return a coppice that grows and is cut; only its growth is not measured."""
    curve = {key: value for key, (value, _) in CURVE.items()}
    growth = {"shoots": curve, "trees": {**curve, "dbh_most_m": 0.45}, **{key: value for key, (value, _) in CROWD.items()},
              "trees_sdi_most": 350, "source": {"kind": kind, "text": "right in size"}}
    return {"species": "ostrya-carpinifolia", "stools": {"per_ha": 800, "spacing_m": 0.3}, "energy": ENERGY,
            "shoots": [{"per_ha": 2400, "dbh_m": 0.06, "height_m": 7, "volume_m3": 0.01}],
            "trees": [{"per_ha": 60, "dbh_m": 0.2, "height_m": 12, "volume_m3": 0.2}], "growth": growth,
            "cutting": {"rotation_years": 12, "stay_per_ha": [30, 30]}, **changes}


def two_options(**changes):
    options = [{"name": name, "forest": [{"from_m": 0, "to_m": 80, "cut_year": year, "stand": grown(**changes)}]}
               for name, year in (("cut", 1), ("later", 7))]
    return measured(forest=None, options=options)


def test_growth():
    """Over the years assumed growth constants have ranges, once per species; today's figures have none"""
    result = answer(two_options(), "--years")
    mean = figure(result, "rotation.exceed_probability")
    inputs = {i["path"].split(".growth.")[1]: i for i in mean["inputs"]}
    wanted = {f"{kind}.{key}": pair for kind in ("shoots", "trees") for key, pair in CURVE.items()} | CROWD
    wanted["trees.dbh_most_m"] = (0.45, 0.15)
    for key, (value, half) in wanted.items():
        found = inputs.pop(key)
        expect_near(found["lo"], value * (1 - half), 1e-12, key)
        expect_near(found["hi"], value * (1 + half), 1e-12, key)
        expect_equal(found["places"], 2, f"{key}: both options")
        expect(found["measured_by"], found)
    space = inputs.pop("trees_sdi_most")
    expect_equal((space["lo"], space["hi"], inputs), (175, 700, {}))
    expect(mean["uncertainty"]["p95"] - mean["uncertainty"]["p5"] > 0.01, mean)
    for name in ("exceed_probability", "reach_probability"):
        expect_equal(figure(result, name)["inputs"], [], f"{name}: today")
        expect_near(figure(result, name)["uncertainty"]["p5"], figure(result, name)["uncertainty"]["p95"], 0.005, f"{name}: today")  # its own points, with more rocks
    expect_equal(answer(two_options())["figures"], [], "without --years nothing is in doubt")
    expect_equal(answer(two_options(kind="measured"), "--years")["figures"], [], "measured growth")
    two = two_options()
    two["options"][1]["forest"][0]["stand"]["species"] = "fagus-sylvatica"
    expect_equal({i["places"] for i in figure(answer(two, "--years"), "rotation.exceed_probability")["inputs"]}, {1}, "two species")


def test_growth_leaves_today_alone():
    """Today's figures are equal to the bit for assumed and measured growth"""
    named = {"uncertainty": [DENSITY, LAW]}
    found = [answer({**two_options(kind=kind), **named}, "--years=7:8", points=64) for kind in ("assumed", "measured")]
    for name in ("exceed_probability", "reach_probability", "energy_per_released_kJ"):
        ranges = [[(f["uncertainty"]["p5"], f["uncertainty"]["p95"], f["q2"], f["inputs"]) for f in result["figures"] if f["figure"] == name] for result in found]
        expect_equal(len(ranges[0]), 3, name)
        expect_equal(ranges[0], ranges[1], name)
    means = [figure(result, "rotation.exceed_probability") for result in found]
    wide, narrow = (m["uncertainty"]["p95"] - m["uncertainty"]["p5"] for m in means)
    expect(wide > 1.2 * narrow, means)


def test_many_places():
    """Pairs of up to 30 places along the slope are checked"""
    with Folder() as f:
        for n, status in ((30, INPUT), (31, DONE)):
            controls = [{"x_m": 60 + i / 2} for i in range(n - 1)]
            rows = [{"path": "release.x_m", "lo": 0, "hi": 59.5}] + [
                {"path": f"controls[{i}].x_m", "lo": x["x_m"] - 0.6, "hi": x["x_m"] + 0.1} for i, x in enumerate(controls)]
            done = ceduo("--check", f.write("s.yaml", scene(controls=controls, uncertainty=rows)))
            expect_equal((done.status, "cannot be computed together" in done.err), (status, status == INPUT), done)


def test_ground_of_the_library():
    """A ground of the library has its published range at every place"""
    slope = {"vertices_m": [[0, 60], [50, 25], [100, 0]], "materials": [{"from_m": 0, "to_m": 100, "material": "talus"}]}
    result = answer(measured(slope=slope))
    inputs = {i["path"]: i for i in result["figures"][0]["inputs"]}
    # the point at 50 m stays with any tolerance from .25 to 1 m: the tolerance has no effect
    expect_equal(sorted(inputs), [f"slope.materials[talus].{k}" for k in ("friction", "rn", "roughness_m", "rt")])
    rn = inputs["slope.materials[talus].rn"]
    expect_equal((rn["lo"], rn["hi"], rn["places"]), (0.30, 0.33, 2))  # Pfeiffer et al. 1993
    named = {"path": "slope.materials[talus].rn", "lo": 0.2, "hi": 0.5}
    rn = {i["path"]: i for i in answer(measured(slope=slope, uncertainty=[named]))["figures"][0]["inputs"]}["slope.materials[talus].rn"]
    expect_equal((rn["lo"], rn["hi"]), (0.2, 0.5))
    slope["materials"][0]["rn"] = 0.31  # a value of the user has no published range
    given = [i["path"] for i in answer(measured(slope=slope))["figures"][0]["inputs"]]
    expect_equal(sorted(given), [f"slope.materials[talus].{k}" for k in ("friction", "roughness_m", "rt")])


def test_threads():
    """The answer does not depend on the number of threads"""
    with Folder() as f:
        path = f.write("s.yaml", measured(uncertainty=[LAW, DENSITY]))
        one, two, three = (ceduo("--sensitivity=8", "-f", "csv", "-n", 100, "-j", j, path).out for j in (1, 2, 3))
    expect(one == two == three, "other bits")
    rows = list(csv.DictReader(io.StringIO(one)))
    expect_equal(len(rows), 3 * 2, "figures x inputs")
    expect_equal({r["path"] for r in rows}, {LAW["path"], DENSITY["path"]})


def test_no_effect():
    """An input without effect has no share: under the law lumped mass changes no trajectory"""
    slope = {"vertices_m": [[0, 50], [60, 8], [160, 0]],
             "segments": [{"rn": 0.3, "rt": 0.9, "roughness_rad": 0.2, "friction": 0.5}]}
    result = answer(measured(forest=[], slope=slope, controls=[{"x_m": 100}], simulation={"rocks": 200, "law": "lumped"},
                             uncertainty=[{"path": "release.height_m", "lo": 0, "hi": 6},
                                    {"path": "rock.density_kg_m3", "lo": 2400, "hi": 2700}]), points=64)
    density = [i for i in figure(result, "reach_probability")["inputs"] if i["path"] == "rock.density_kg_m3"][0]
    expect(abs(density["total"]) <= 3 * density["total_se"] < 0.1, "of the share that arrives", density)
    energy = [i for i in figure(result, "energy_per_released_kJ")["inputs"] if i["path"] == "rock.density_kg_m3"][0]
    expect(energy["total"] > 0, "of the energy")


CLOSED = [{"path": "rock.density_kg_m3", "lo": 2385, "hi": 2915}, {"path": "simulation.gravity_m_s2", "lo": 9.3195, "hi": 10.3005}]
IDLE = {"path": "forest[0].stand.trees[0].per_ha", "lo": 400, "hi": 600}  # inputs of a belt after the last control


def energies_in_uncertainty(points, seeds, idle):
    """Return the energy per rock started at rest: proportional to density times gravity under lumped, which has no speed scale."""
    what = measured(forest=[{"from_m": 92, "to_m": 99, "stand": wood()}] if idle else [], release={"x_m": 5}, simulation={"rocks": 200, "law": "lumped"},
                    rock={"shape": "sphere", "diameter_m": 0.7, "density_kg_m3": 2650}, uncertainty=CLOSED + [IDLE] * idle)
    with Folder() as f:
        path = f.write("s.yaml", what)
        for seed in range(1, seeds + 1):
            result = good(f"--sensitivity={points}", "-f", "json", "-n", 200, "--seed", seed, path).json()[0]
            found = figure(result, "energy_per_released_kJ")
            yield seed, found["uncertainty"]["p95"] - found["uncertainty"]["p5"], {i["path"]: i for i in found["inputs"]}


def test_shares_in_closed_form():
    """Energy is proportional to density times gravity for rocks started at rest: shares of .8 and .2 and the rest, for any seed"""
    one, other = 0.1 ** 2 / 3, 0.05 ** 2 / 3  # uniform within 10 and 5 %; a product varies by both, and by their product
    both = one * other / (one + other + one * other)
    alone = 1 - both
    left = {row["path"]: 0 for row in CLOSED}
    for seed, width, found in energies_in_uncertainty(256, 20, False):
        for row, share in zip(CLOSED, (0.8, 0.2)):
            expect_near(found[row["path"]]["first"], share * alone, 1e-6, f"seed {seed}: {row['path']}")
            expect_near(found[row["path"]]["total"], share * alone + both, 1e-6, f"seed {seed}: {row['path']}")
            left[row["path"]] += found[row["path"]]["width_if_known"] / width / 20
    whole = 3 - 2 * math.sqrt(0.2)  # p95 - p5 of the sum of two uniform variables, the first twice as wide
    expect_near(left[CLOSED[0]["path"]], 0.9 / whole, 0.04, "density known")
    expect_near(left[CLOSED[1]["path"]], 1.8 / whole, 0.04, "gravity known")


def test_left_without_effect():
    """For an input without effect the full range remains, on average over ten seeds, with any number of points"""
    for points in (20, 64):
        shares = [found[IDLE["path"]]["width_if_known"] / width for _, width, found in energies_in_uncertainty(points, 10, True)]
        expect_near(sum(shares) / 10, 1, 0.1, f"{points} points: {shares}")


def test_page_of_shares():
    """The page names inputs with shares above two errors and 1 %, at most 100 %, counts the others, and advises measuring three"""
    what = measured(uncertainty=[DENSITY, {"path": "release.vx_m_s", "lo": 4, "hi": 6}, {**IDLE, "lo": 150},
                           {"path": "slope.segments[0].friction", "lo": 0.45, "hi": 0.55}])
    between = named = 0
    with Folder() as f:
        path = f.write("s.yaml", what)
        for seed in range(1, 9):
            arguments = ["--sensitivity=64", "-n", 64, "--seed", seed, path]
            found = figure(good("-f", "json", *arguments).json()[0], "exceed_probability")
            page = good(*arguments).out
            told = [i for i in found["inputs"] if i["total"] > 2 * i["total_se"] and i["total"] >= 0.01]
            shares = [f"{min(100, 100 * i['total']):.0f}" for i in told]
            table = page[page.index("it depends on"):].split("\n\n")[0]
            expect_equal(re.findall(r" (\d+) %", table), shares, f"seed {seed}: {page}")
            expect_equal(re.findall(r"(Measure first|Then): ", page), ["Measure first", "Then", "Then"][:len(told)], page)
            expect_in(f"{4 - len(told)} other input" if told else "No input is dominant", " ".join(page.split()))
            between += any(i["total_se"] < i["total"] < 2 * i["total_se"] and i["total"] > 0.01 for i in found["inputs"])
            named += len(told) > 0
    expect(between > 0 and named > 0, "the seeds hold both cases", between, named)


def test_many():
    """Sixty inputs: each has shares with enough points; with few there is neither a band nor advice"""
    belts = [{"from_m": 4 * i, "to_m": 4 * i + 4, "stand": wood()} for i in range(20)]
    speed = {"path": "release.vx_m_s", "lo": 1, "hi": 9}
    uncertainty = [{"path": f"forest[{i}].stand.{key}", "lo": lo, "hi": hi} for i in range(20)
             for key, lo, hi in (("trees[0].dbh_m", 0.119, 0.121), ("trees[0].height_m", 7, 10), ("energy.u_J_m3", 99e3, 101e3))]
    with Folder() as f:
        path = f.write("s.yaml", measured(forest=belts, uncertainty=[*uncertainty[1:], speed]))
        inputs = figure(ceduo("--sensitivity=512", "-f", "json", "-n", 64, path).json()[0], "energy_per_released_kJ")["inputs"]
        expect_equal({i["path"] for i in inputs}, {row["path"] for row in [*uncertainty[1:], speed]})
        expect_equal(max(inputs, key=lambda i: i["total"])["path"], speed["path"], "the heaviest, wherever it stands")
        expect(inputs[0]["path"] == speed["path"] and inputs[0]["total"] > 0.8, inputs[0])
        few = ceduo("--sensitivity=4", "-f", "json", "-n", 20, path).json()[0]["figures"][0]
        expect_equal({i["total"] for i in few["inputs"]} | {few["q2"], few["unexplained"]}, {None}, "too few points")
        expect_equal([*few["uncertainty"].values()], [None] * 5, few)
        page = " ".join(ceduo("--sensitivity=4", "-n", 20, path).out.split())
        expect_in("Too few points to rank the inputs", page)
        expect("Measure first" not in page, page)


def test_constant():
    """If plausible cases have the same result, no input decides, and more points would not help"""
    page = good("--sensitivity=64", "-n", 20, "-s", "controls[0].accepted_kJ=10000", "paper-site").out
    expect_in("have the same result. No input decides.", page)
    expect("more points" not in page and "use more" not in page, page)


GROWTH = {"shoots": {"dbh_most_m": 0.16, "dbh_rate_1_y": 0.03, "height_most_m": 14, "height_rate_1_y": 0.04},
          "trees": {"dbh_most_m": 0.45, "dbh_rate_1_y": 0.02, "height_most_m": 20, "height_rate_1_y": 0.03},
          "shoots_young": 10, "shoots_old": 3}


def coppice(shoots, stay):
    """Return a coppice cut every eight years, fully measured; its shoots have that age, or none"""
    return stand(stools={"per_ha": 2500, "spacing_m": 0.35}, trees=[{"per_ha": stay, "dbh_m": 0.2, "height_m": 12, "volume_m3": 0.2}],
                 shoots=[{"per_ha": 7500, "dbh_m": 0.04, "height_m": 5, "volume_m3": 0.004, "age_y": 8}] if shoots else None,
                 energy=ENERGY, growth=GROWTH, cutting={"rotation_years": 8, "stay_per_ha": [stay]})


def rotating(uncertainty=None, **changes):
    """Return two forests with cuts and uncertain inputs of both; random densities and stem strengths unless overridden"""
    options = [{"name": n, "forest": [{"from_m": 0, "to_m": 80, "stand": coppice(True, stay)}]} for n, stay in (("few", 50), ("many", 200))]
    what = measured(options=options, controls=[{"x_m": 90, "accepted_kJ": 120}],
                    uncertainty=uncertainty or [{"path": p, "lo": lo, "hi": hi} for p, (lo, hi) in ROTATING.items()], **changes)
    del what["forest"]
    return what


HEAVY = {"path": "rock.density_kg_m3", "lo": 2450, "hi": 2750}  # few points explain it
ROTATING = {"rock.density_kg_m3": (2000, 3000), "options[*].forest[0].stand.energy.u_J_m3": (5e4, 2e5)}


def test_over_a_rotation_as_scenes_at_random():
    """--years: the mean over a rotation, of options and their difference, agrees with 40 random scenes within three errors"""
    years = "--years" if FULL else "--years=1:3"
    result = answer(rotating(), years, "-n", 100)
    figures = {(f["option"], f["against"]): f for f in result["figures"] if f["figure"] == "rotation.exceed_probability"}
    expect_equal(len(figures), 3)
    names, draw, seen = ("few", "many"), random.Random(3), {k: [] for k in figures}
    with Folder() as f:
        path = f.write("s.yaml", rotating())
        for _ in range(40):
            u = {p: draw.uniform(lo, hi) for p, (lo, hi) in ROTATING.items()}
            sets = [x for p, v in u.items() for k in ((0, 1) if "*" in p else (0,)) for x in ("-s", f"{p.replace('*', str(k))}={v!r}")]
            run = good("-b", years, "-f", "json", "-n", 150, *sets, path).json()[0]
            means = [o["rotation"]["exceed_probability"]["mean"] for o in run["options"]]
            errors = [o["rotation"]["exceed_probability"]["se"] for o in run["options"]]
            for (option, against), all_seen in seen.items():
                i = names.index(option)
                all_seen.append(means[i] - means[0] if against else means[i])
    for key, figure in figures.items():
        for share, name in ((0.05, "p5"), (0.5, "p50"), (0.95, "p95")):
            off = 3 * math.hypot(max(figure["uncertainty"]["p5_se"], figure["uncertainty"]["p95_se"]), max(errors))
            chance = 3 * math.sqrt(share * (1 - share) / 40)
            below = [sum(x <= figure["uncertainty"][name] + side for x in seen[key]) / 40 for side in (-off, off)]
            expect(below[0] <= share + chance and below[1] >= share - chance, key, name, figure["uncertainty"][name], off, below)
    spread = max(seen[names[0], None]) - min(seen[names[0], None])
    expect(0.4 * spread < figures[names[0], None]["uncertainty"]["p95"] - figures[names[0], None]["uncertainty"]["p5"] < 1.2 * spread, spread, figures)


def test_over_a_rotation():
    """--years: two more figures, their order, and given years; without an accepted energy arrivals, by the index none"""
    result = answer(rotating([HEAVY]), "--years", "-n", 32)
    expect_equal(sorted({f["figure"] for f in result["figures"]})[-2:], ["rotation.exceed_probability", "rotation.unprotected_energy"])
    expect_equal(len(result["figures"]), 3 * 5)
    (rank,) = result["ranking"]
    expect_equal((rank["over"], round(rank["probability"] + rank["equal"] + rank["worse"], 9)), ("rotation", 1))
    expect_equal(answer(rotating([HEAVY]), "-n", 32)["ranking"][0]["over"], "today")
    cut = figure(answer(rotating([HEAVY]), "--years=1:2", "-n", 32), "rotation.exceed_probability")
    full = figure(result, "rotation.exceed_probability")
    expect(cut["value"] > full["value"] and cut["uncertainty"]["p50"] > full["uncertainty"]["p50"], "two years just after the cut", cut, full)
    years = figure(answer(rotating([HEAVY]), "--years=1:2", "-n", 32), "rotation.unprotected_energy")
    expect_equal((years["value"], years["uncertainty"]["p95"]), (2, 2))
    expect_equal({i["at_lo"] for i in full["inputs"]}, {None})
    what = rotating([HEAVY])
    del what["controls"][0]["accepted_kJ"]
    arrives = answer(what, "--years=1:2", "-n", 32)
    expect_equal([f["figure"] for f in arrives["figures"] if "rotation" in f["figure"]], ["rotation.reach_probability"] * 3)
    expect_equal({f["within"] for f in arrives["figures"]}, {None})
    what["simulation"] = {**what.get("simulation", {}), "contact_model": "index"}
    none = answer(what, "--years", "-n", 32)
    expect(not any("rotation" in f["figure"] for f in none["figures"]) and none["ranking"][0]["over"] == "today", none["ranking"])


def test_failing_years_outwards():
    """The page rounds the range of failing years outwards: 7.9 to 19.1 years are 7 to 20"""
    what = rotating([HEAVY])
    result, seen = answer(what, "--years", "-n", 32), 0
    with Folder() as f:
        page = good(f"--sensitivity={POINTS}", "--years", "-n", 32, f.write("s.yaml", what)).out
    for i, name in enumerate(("few", "many")):
        years = figure(result, "rotation.unprotected_energy", i)
        lo, hi = years["uncertainty"]["p5"], years["uncertainty"]["p95"]
        seen += math.floor(lo) != round(lo) or math.ceil(hi) != round(hi)
        expect(re.search(rf"^  {name} .* {years['value']:.0f}, {math.floor(lo)}–{math.ceil(hi)}$", page, re.M), name, lo, hi, page)
    expect(seen > 0, "ends that would be rounded inwards", result)


def test_a_year_as_today():
    """A forest that neither grows nor is cut has one year, equal to today"""
    result = answer(measured(uncertainty=[DENSITY]), "--years", "-n", 400)
    today, mean = figure(result, "exceed_probability"), figure(result, "rotation.exceed_probability")
    expect_equal([today["uncertainty"][k] for k in ("p5", "p50", "p95")], [mean["uncertainty"][k] for k in ("p5", "p50", "p95")])


def test_stools_that_were_just_cut():
    """Stools of a stand without shoots survive in uncertain cases: the following rotation is that of the grown stand"""
    for shoots in (True, False):
        what = measured(forest=[{"from_m": 0, "to_m": 80, "cut_year": 1, "stand": coppice(shoots, 50)}], controls=[{"x_m": 90, "accepted_kJ": 120}],
                        uncertainty=[{"path": "rock.density_kg_m3", "lo": 2599, "hi": 2601}])
        mean = figure(answer(what, "--years", "-n", 32), "rotation.exceed_probability")
        expect_near(mean["uncertainty"]["p50"], mean["value"], 3 * math.hypot(mean["uncertainty"]["p5_se"], (mean["sampling_hi"] - mean["value"]) / 2), shoots)
        grown = mean if shoots else grown
        expect_near(mean["uncertainty"]["p50"], grown["uncertainty"]["p50"], 1e-9, "the same rotation")


def test_ranking():
    """Options: each pair of neighbours in rank has shares of better, equal and worse cases; two equal ones are equal"""
    belts = [{"from_m": 0, "to_m": 80, "stand": wood()}]
    options = [{"name": "a", "forest": belts}, {"name": "b", "forest": belts}, {"name": "none", "forest": []}]
    what = measured(options=options, uncertainty=[DENSITY])
    del what["forest"]
    result = answer(what)
    expect_equal(len(result["figures"]), 3 * 3 + 2 * 3)
    pairs = {(r["better"], r["than"]): (r["probability"], r["equal"], r["worse"]) for r in result["ranking"]}
    expect_equal(len(pairs), 2)
    expect_equal(pairs.get(("a", "b"), pairs.get(("b", "a"))), (0, 1, 0), "the same forest twice")
    expect(any(than == "none" and p == (1, 0, 0) for (_, than), p in pairs.items()), pairs)
    difference = [f for f in result["figures"] if f["against"] == "a" and f["option"] == "b"]
    expect_equal([(f["value"], f["uncertainty"]["p5"], f["uncertainty"]["p95"]) for f in difference], [(0, 0, 0)] * 3)


def test_equal_whatever_the_rocks():
    """Options are equal within 5 in 1000 for any number of rocks: shares of better, equal and worse, and their word, stay"""
    for trees in (560, 600, 650):
        options = [{"name": str(n), "forest": [{"from_m": 0, "to_m": 80, "stand": wood(trees=[{**TREES[0], "per_ha": n}])}]}
                   for n in (500, trees)]
        what = measured(options=options, uncertainty=[DENSITY, {"path": "release.vx_m_s", "lo": 4, "hi": 6}], controls=[{"x_m": 90, "accepted_kJ": 80}])
        del what["forest"]
        with Folder() as f:
            path = f.write("s.yaml", what)
            few, many = (good("--sensitivity=64", "-f", "json", "-n", rocks, path).json()[0]["ranking"][0] for rocks in (400, 1600))
            words = [re.search(r"of plausible cases.*?: ([a-z ]+)\.", " ".join(good("--sensitivity=64", "-n", rocks, path).out.split()))[1]
                     for rocks in (400, 1600)]
        for key in ("probability", "equal", "worse"):
            expect_near(few[key], many[key], 0.1, f"{trees}: {key}")
        expect(trees == 560 or words[0] == words[1], trees, words)  # at 560 the word changes


def test_what_would_settle_it():
    """Each input has its remedy, words too; measurable ones come first, each once, equal everywhere"""
    belts = [{"from_m": a, "to_m": a + 40, "stand": {k: v for k, v in wood().items() if k != "energy"}} for a in (0, 40)]
    what = measured(forest=belts, uncertainty=[DENSITY, {"path": "forest[*].stand.trees[0].per_ha", "lo": 300, "hi": 700}])
    result = answer(what, points=256)
    inputs = {i["path"]: i["measured_by"] for i in figure(result, "exceed_probability")["inputs"]}
    law = "forest[*].stand.energy.model"
    expect_equal(inputs[law], "full-scale tests on such stems")
    expect_equal(inputs["rock.density_kg_m3"], "a piece of the rock, weighed")
    expect_equal(inputs["forest[*].stand.trees[0].per_ha"], "more sample plots")
    rows = list(csv.DictReader(io.StringIO(run_scene(what, "--sensitivity=256", "-f", "csv"))))
    expect_equal({r["path"]: r["measured_by"] for r in rows}, inputs)
    first = result["measure_first"]
    expect(first and law not in [i["path"] for i in first], first)
    expect_equal(len({i["path"] for i in first}), len(first))
    order = [i["path"] for i in figure(result, "exceed_probability")["inputs"]]
    expect_equal([i["path"] for i in first], [p for p in order if p in {i["path"] for i in first}])
    with Folder() as f:
        path, report = f.write("s.yaml", what), f.path / "r.html"
        good("--report", report, "-n", 200, path)
        pages = [good(*words, "-n", 200, path).out for words in (("-b",), ("--sensitivity",))]
        for page in [*pages, html.unescape(re.sub("<[^>]*>", " ", report.read_text(encoding="utf-8")))]:
            told = re.findall(r"Measure first: [^()]* \(([^)]*)\)\.", " ".join(page.split()))
            expect_equal(set(told), {first[0]["measured_by"]}, page)
            expect("full-scale" not in page, page)


def test_bound_of_a_page():
    """If a page would cost too much its uncertainty uses fewer points, or is omitted, and the page reports it"""
    def of(per_ha, rock):
        trees = [{"per_ha": per_ha, "dbh_m": 0.03, "height_m": 12, "volume_m3": 1e-6}]
        return measured(forest=[{"from_m": 0, "to_m": 85, "stand": wood(trees=trees)}], uncertainty=[DENSITY],
                        rock={"shape": "sphere", "diameter_m": rock, "density_kg_m3": 2600})
    with Folder() as f:
        for what, rocks, says in ((of(500, 0.7), 20, ""), (of(60000, 4), 400, r"Uncertainty from \d+ points\."),
                                  (of(100000, 60), 100, "Uncertainty was not computed, because it takes long; --sensitivity computes it")):
            path, report = f.write("s.yaml", what), f.path / "r.html"
            good("--report", report, "-n", rocks, path)
            words = html.unescape(re.sub("<[^>]*>", " ", report.read_text(encoding="utf-8")))
            one, two = (good("-b", "-n", rocks, "-j", j, path).out for j in (1, 2))
            expect_equal(one, two, "the same bytes with any number of threads")
            for page in (one, words):
                page = " ".join(page.split())
                expect(re.search(says, page), says, page)
                expect_equal("Uncertainty from" in page or "takes long" in page, says != "", page)


def test_too_few_points_for_a_range():
    """A 90 % range of fewer than 20 points is null in JSON, and the page prints the number of points"""
    with Folder() as f:
        path = f.write("s.yaml", measured(forest=[], release={"x_m": 5}, simulation={"rocks": 200, "law": "lumped"},
                                          controls=[{"x_m": 90}], uncertainty=CLOSED))  # the surface needs only these
        for points in (19, 20):
            found = figure(good(f"--sensitivity={points}", "-f", "json", "-n", 60, path).json()[0], "energy_per_released_kJ")
            ends = [found["uncertainty"][k] for k in ("p5", "p50", "p95", "p5_se", "p95_se")]
            expect_equal([e is None for e in ends], [points < 20] * 5, found)
            expect_equal([i["width_if_known"] is None for i in found["inputs"]], [points < 20] * 2, found)
            report = f.path / "r.html"
            good("--report", report, f"--sensitivity={points}", "-n", 60, path)
            words = html.unescape(re.sub("<[^>]*>", " ", report.read_text(encoding="utf-8")))
            for page in (good(f"--sensitivity={points}", "-n", 60, path).out, words):
                page = " ".join(page.split())
                expect_equal("19 points are too few for a range." in page, points < 20, page)
                expect_equal("Uncertainty from 20 points." in page, points == 20, page)
                expect("nan" not in page, page)


def test_a_range_holds_its_value():
    """A range contains its value; the remaining range with a known input is never wider"""
    for path in ("four-systems", "rotation", "paper-site"):
        for f in good("--sensitivity=32", "-f", "json", "-n", 200, "--years", path).json()[0]["figures"]:
            where = f"{path}: {f['option']}, {f['figure']}, against {f['against']}"
            if f["value"] is not None:
                expect(f["uncertainty"]["p5"] <= f["value"] <= f["uncertainty"]["p95"], where, f["uncertainty"]["p5"], f["value"], f["uncertainty"]["p95"])
            for i in f["inputs"]:
                if i["width_if_known"] is not None:
                    expect(i["width_if_known"] <= (f["uncertainty"]["p95"] - f["uncertainty"]["p5"]) * (1 + 1e-12), where, i)


def test_paths_can_be_set():
    """The paths of an input, set to either end of its range with the same --option, give the figures at that end"""
    talus = {"vertices_m": [[0, 70], [50, 30], [100, 0]], "materials": [{"from_m": 0, "to_m": 30, "material": "talus"},
             {"from_m": 30, "to_m": 60, "material": "cliff"}, {"from_m": 60, "to_m": 100, "material": "detrito"}]}
    with Folder() as f:
        f.write("p.csv", "distance,elevation\n100,70\n130,45\n200,0\n")
        scenes = [("four-systems", ["--option", "selection coppice, just cut"]), ("four-systems", ["--option", "large reserves"] +
                                                                                  ["--option", "selection coppice"]),
                  ("terrace", []), (f.write("t.yaml", measured(slope=talus)), []),
                  (f.write("c.yaml", measured(slope="p.csv", controls=[{"x_m": 190, "accepted_kJ": 20}],
                                              forest=[{"from_m": 100, "to_m": 180, "stand": wood()}])), [])]
        for path, option in scenes:
            found = {}
            for figures in good("--sensitivity=2", "-n", 60, "-f", "json", *option, path).json()[0]["figures"]:
                for i in figures["inputs"] if not figures["against"] else []:
                    for end in ("lo", "hi"):
                        found.setdefault((tuple(i["paths"]), i[end]), {})[figures["option"], figures["figure"]] = i[f"at_{end}"]
            expect(len(found) >= 10, found)
            for (paths_of_input, value), wanted in list(found.items())[::1 if FULL else 3]:  # each end of some
                sets = [word for one in paths_of_input for word in ("-s", f"{one}={value}")]
                run = good("-b", "-n", 60, "-f", "json", *sets, *option, path).json()[0]
                for o in run["options"]:
                    w = o["controls"][-1]["wooded"]
                    shown = {"reach_probability": w["reach_probability"], "exceed_probability": w["exceed_probability"],
                             "energy_per_released_kJ": w["energy_per_released_kJ"]["mean"]}
                    for name, known in shown.items() if (o["name"], "reach_probability") in wanted else []:
                        expect_near(wanted[o["name"], name], known, 1e-9 * max(1e-9, known), f"{path} {option}: {sets}, {name}")


def test_as_scenes_at_random():
    """The band of two options and of their difference agrees with random scenes set by the paths, within three errors"""
    names, count, rocks = ("selection coppice", "large reserves"), 80 if FULL else 40, 600
    option = [word for name in names for word in ("--option", name)]
    figures = [f for f in good("--sensitivity", "-f", "json", *option, "rotation").json()[0]["figures"] if f["figure"] == "exceed_probability"]
    inputs, draw, drawn = {i["path"]: i for f in figures for i in f["inputs"]}, random.Random(1), []
    for _ in range(count):
        values = {p: draw.choice([i["lo"], i["hi"]]) if isinstance(i["lo"], str) else draw.uniform(i["lo"], i["hi"])
                  for p, i in sorted(inputs.items())}
        sets = [word for p, i in sorted(inputs.items()) for one in i["paths"] for word in ("-s", f"{one}={values[p]}")]
        run = good("-b", "-f", "json", "-n", rocks, *sets, *option, "rotation").json()[0]
        drawn.append([o["controls"][-1]["wooded"]["exceed_probability"] for o in run["options"]])
    for f in figures:
        column = sorted(d[1] - d[0] if f["against"] else d[names.index(f["option"])] for d in drawn)
        for key, share in (("p5", 0.05), ("p95", 0.95)):
            found = column[round(share * (count - 1))]
            apart = math.sqrt(count * share * (1 - share))  # ranks that other draws may shift
            near = [column[min(count - 1, max(0, round(share * (count - 1) + k * apart)))] for k in (-1, 1)]
            error = math.hypot((near[1] - near[0]) / 2, f["uncertainty"][key + "_se"], math.sqrt(0.25 / rocks))
            expect_near(found, f["uncertainty"][key], 3 * error, f"{f['option']} against {f['against']}: {key}")


def test_options_by_number():
    """An uncertain input of the file that names an option by its number keeps its option under --option"""
    belts = [[{"from_m": 0, "to_m": 80, "stand": wood(trees=[{**TREES[0], "per_ha": n}])}] for n in (300, 500)]
    what = measured(options=[{"name": n, "forest": b} for n, b in zip("ab", belts)],
                    uncertainty=[{"path": "options[1].forest[0].stand.trees[0].per_ha", "lo": 400, "hi": 600}])
    del what["forest"]
    expect_equal(paths(answer(what, "--option", "b")), ["options[1].forest[0].stand.trees[0].per_ha"])
    expect_equal(answer(what, "--option", "a")["figures"], [], "nothing of the other option is in doubt")


def test_what_is_not_there():
    """Missing items of a scene are skipped, so that a stand can be exchanged; also single missing items"""
    gone = [{"path": p, "lo": 0.1, "hi": 0.2} for p in ("forest[7].stand.trees[0].dbh_m", "forest[0].stand.shoots[0].dbh_m",
                                                        "options[other].forest[0].stand.trees[0].dbh_m",
                                                        "slope.materials[talus].rn")]
    expect_equal(paths(answer(measured(uncertainty=[*gone, DENSITY]))), ["rock.density_kg_m3"])
    some = {"path": "forest[*].stand.trees[0].dbh_m", "lo": 0.1, "hi": 0.2}
    belts = [{"from_m": 0, "to_m": 30, "stand": wood()}, {"from_m": 30, "to_m": 40, "stand": {"system": "bare"}}]
    inputs = answer(measured(forest=belts, uncertainty=[some]))["figures"][0]["inputs"]
    expect_equal([(i["path"], i["places"]) for i in inputs], [(some["path"], 1)])
    expect_equal(ceduo("--check", "-s", "forest=[]", "paper-site").err, "", "an exchange is no mistake")


def test_unusual_ranges():
    """Ends of a range and a mean outside the usual range, such as density in t/m3, have a warning, whatever is computed"""
    rows = [{"path": "rock.density_kg_m3", "lo": 2.4, "hi": 2700}, {"path": "release.height_m", "mean": 3, "sd": 1}]
    with Folder() as f:
        path = f.write("s.yaml", scene(uncertainty=rows))
        unusual = "uncertainty[0].lo: 2.4 kg/m3 is unusual (usual: 1000 to 5000 kg/m3); check the number and its unit"
        for arguments in (["--check"], ["-b", "-n", "10"], ["--sensitivity=20", "-n", "10", "-f", "json"]):
            done = ceduo(*arguments, path)
            expect_equal((done.status, done.err.count("is unusual")), (DONE, 1), done)
            expect_in(unusual, done.err)
        rows[1]["mean"] = 3000
        expect_in("uncertainty[1].mean: 3000 m is unusual", ceduo("--check", f.write("s.yaml", scene(uncertainty=rows))).err)


def test_misspelt():
    """A range that names nothing in the file has a warning; not after a change that may have exchanged the item"""
    with Folder() as f:
        rows = [{"path": "controls[raod].x_m", "lo": 79, "hi": 81}, {"path": "forest[1].to_m", "lo": 39, "hi": 41}, DENSITY]
        path = f.write("s.yaml", scene(controls=[{"x_m": 80, "name": "road"}], uncertainty=rows))
        for arguments in (["--check"], ["--batch", "-n", "10"]):
            done = ceduo(*arguments, path)
            expect_equal(done.status, DONE, done)
            expect_in("s.yaml:", done.err)
            expect_in("uncertainty[0].path: 'controls[raod].x_m' names nothing in this scene, so its range is not used", done.err)
            expect_in("uncertainty[1].path: 'forest[1].to_m' names nothing in this scene", done.err)
            expect("uncertainty[2]" not in done.err, done)
        for arguments in (["-s", "title=changed"], ["--seed", "7"], ["--each", f.write("rows.csv", "rock.density_kg_m3\n2500\n2600\n")]):
            expect_equal(ceduo("--check", *arguments, path).err.count("names nothing"), 2, arguments)
        for change, n in (("controls[0].x_m=70", 1), ("forest=[]", 1), ("options=[{name: a}]", 1), ("slope.name=a", 2)):
            expect_equal(ceduo("--check", "-s", change, path).err.count("names nothing"), n, change)
        trees = f.write("stand.yaml", {"ceduo": "stand/1", **wood(), "uncertainty": [{"path": "trees[7].per_ha", "lo": 1, "hi": 2}]})
        done = ceduo("--check", f.write("t.yaml", scene(forest=[{"from_m": 10, "to_m": 30, "stand": str(trees)}])))
        expect_in("stand.yaml:", done.err)
        expect_in("uncertainty[0].path: 'trees[7].per_ha' names nothing in this scene", done.err)


REFUSED = {
    "uncertainty[0].path: 'rock.colour' affects no result": {"path": "rock.colour", "lo": 1, "hi": 2},
    "uncertainty[0].path: 'title' affects no result": {"path": "title", "lo": 1, "hi": 2},
    "uncertainty[0].path: 'slope.materials[gold].rn' affects no result": {"path": "slope.materials[gold].rn", "lo": 0.1, "hi": 0.2},
    "uncertainty[0].path: 'simulation.rocks' affects no result": {"path": "simulation.rocks", "lo": 100, "hi": 200},
    "uncertainty[0].path: 'uncertainty[*].lo' affects no result": {"path": "uncertainty[*].lo", "lo": 100, "hi": 200},
    "uncertainty[0].path: 'years.first' affects no result": {"path": "years.first", "lo": 1, "hi": 2},
    "uncertainty[0].hi: the range is empty": {"path": "rock.density_kg_m3", "lo": 2500, "hi": 2500},
    "uncertainty[0].sd: the range is empty": {"path": "rock.density_kg_m3", "mean": 2500, "sd": 0},
    "uncertainty[0].hi: 1.5 is outside the range of rn: 0…1": {"path": "slope.segments[0].rn", "lo": 0.5, "hi": 1.5},
    "uncertainty[0].sd: 1.5 is outside the range of rn: 0…1": {"path": "slope.segments[0].rn", "mean": 0.75, "sd": 0.25},
    "uncertainty[0].sd: sd is more than 2 times the mean; give lo and hi": {"path": "slope.segments[0].rn", "mean": 0.1, "sd": 0.25},
    "uncertainty[0].one_of[1]: 'dorian' is unknown; one of: brauner, dorren": {**LAW, "one_of": ["brauner", "dorian"]},
    "uncertainty[0].one_of: name at least two words": {**LAW, "one_of": ["brauner"]},
    "uncertainty[0].one_of[1]: 'brauner' is given twice": {**LAW, "one_of": ["brauner", "brauner"]},
    "uncertainty[0]: 'density_kg_m3' is a number; give lo and hi, or mean": {"path": "rock.density_kg_m3", "lo": 2500},
    "uncertainty[0]: 'density_kg_m3' is a number; give lo and hi": {"path": "rock.density_kg_m3", "one_of": ["a", "b"]},
    "uncertainty[0]: 'model' is a word; give one_of": {"path": LAW["path"], "lo": 0, "hi": 1},
    "uncertainty[0]: 'path' is missing": {"lo": 0, "hi": 1},
}


def test_outside():
    """A value outside its range is reported wherever its uncertainty is; no shipped scene has one"""
    def run_words(*args):
        return " ".join(ceduo("-n", "20", *args).out.split())

    changes = ("--set", "forest[0].stand.shoots[0].per_ha=20000")
    for args in (("-b",), ("-b", "--details"), ("--sensitivity=16",)):
        page = run_words(*args, *changes, "paper-site")
        if args != ("-b",):  # the short page may lack space
            expect_in("is 20000, outside its range", page, args)
        expect("outside its range" not in run_words(*args, "--set", "forest[0].stand.shoots[0].per_ha=9575", "paper-site"), args)
    expect(re.search(r"per hectare, [^.]* is 20000, outside its range 7077.9575; the range is used\.", page), page)
    page = run_words("-b", "--set", "simulation.law=arm", "--set", "uncertainty=[{path: simulation.law, one_of: [lumped, crsp]}]", "paper-site")
    expect(re.search(r"law of impact is arm, outside its range lumped.crsp;", page), page)
    for scene in (PROFILES / "scenes").glob("*.yaml"):
        expect("outside its range" not in run_words("--sensitivity=4", scene), scene)


def test_refused():
    """An empty or impossible range, an unknown path or word: reported, with line and column"""
    for told, row in REFUSED.items():
        with Folder() as f:
            r = ceduo("--sensitivity", f.write("s.yaml", measured(uncertainty=[row])))
            expect_equal((r.status, r.out), (INPUT, ""), told)
            expect_in(told, r.err, row)
    with Folder() as f:
        r = ceduo("--check", f.write("s.yaml", measured(uncertainty=[DENSITY, DENSITY])))
        expect_in("uncertainty[1].path: 'rock.density_kg_m3' is given twice", r.err)
    for n in ("0", "1", "x", "1e9"):
        expect_equal(ceduo(f"--sensitivity={n}", "paper-site").status, USAGE, n)
    for others in (("--plot", "energy"), ("-e", "0.1"), ("--rows", "stands")):
        expect_equal(ceduo("--sensitivity=4", *others, "paper-site").status, USAGE, others)


if __name__ == "__main__":
    run_all(__name__)
