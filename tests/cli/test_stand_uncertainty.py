#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A stand has its own uncertain inputs."""
import json

from harness import DONE, INPUT, Folder, ceduo, expect, expect_equal, expect_in, run_all, scene, stand

STOOLS = {"path": "stools.per_ha", "mean": 1800, "sd": 100}
TREES = {"path": "trees[0].per_ha", "lo": 40, "hi": 120}


def coppice(*rows):
    return stand(stools={"per_ha": 1800, "spacing_m": 0.3},
                 shoots=[{"per_ha": 4000, "dbh_m": 0.06, "height_m": 7, "volume_m3": 0.01}],
                 trees=[{"per_ha": 80, "dbh_m": 0.18, "height_m": 11, "volume_m3": 0.2}],
                 energy={"model": "brauner", "u_J_m3": 102800, "offset": "whole"}, uncertainty=list(rows))


def site(*belts, **more):
    return scene(rock={"diameter_m": 0.7, "density_kg_m3": 2600}, controls=[{"x_m": 90}],
                 slope={"vertices_m": [[0, 70], [100, 0]],
                        "segments": [{"rn": 0.3, "rt": 0.9, "roughness_rad": 0.2, "friction": 0.5}]},
                 options=[{"name": f"o{i}", "forest": forest} for i, forest in enumerate(belts)], **more)


def inputs(f, what):
    r = ceduo("--sensitivity=4", "-f", "json", "-n", 50, f.write("s.yaml", what))
    expect_equal(r.status, DONE, r)
    figures = json.loads(r.out)["figures"]
    return {i["path"]: (i["lo"], i["hi"]) for figure in figures for i in figure["inputs"]}


def belt(stand, at=0):
    return {"from_m": at, "to_m": at + 30, "stand": stand}


def test_one_input_for_all_belts():
    """The rows of a stand apply wherever it is used, together: one input each"""
    with Folder() as f:
        f.write("c.yaml", coppice(STOOLS, TREES))
        what = site([belt("c.yaml")], [belt("c.yaml"), belt({"base": "c.yaml", "name": "again"}, 40)])
        expect_equal(inputs(f, what), {"options[0].forest[0].stand.stools.per_ha": (1500, 2100),
                                       "options[0].forest[0].stand.trees[0].per_ha": (40, 120)})


def test_two_stands():
    """Rows of two stands are two inputs"""
    with Folder() as f:
        f.write("c.yaml", coppice(STOOLS))
        f.write("d.yaml", coppice({**STOOLS, "sd": 200}))
        expect_equal(inputs(f, site([belt("c.yaml")], [belt("d.yaml")])),
                     {"options[0].forest[0].stand.stools.per_ha": (1500, 2100),
                      "options[1].forest[0].stand.stools.per_ha": (1200, 2400)})


def test_the_scene_goes_before():
    """The scene's range overrides the stand's; uncertainty: none of the scene disables it"""
    with Folder() as f:
        f.write("c.yaml", coppice(TREES))
        own = {"path": "options[*].forest[0].stand.trees[0].per_ha", "lo": 70, "hi": 90}
        expect_equal(inputs(f, site([belt("c.yaml")], uncertainty=[own])), {own["path"]: (70, 90)})
        one = {**own, "path": "options[o1].forest[0].stand.trees[0].per_ha"}
        expect_equal(inputs(f, site([belt("c.yaml")], [belt("c.yaml")], uncertainty=[one])),
                     {one["path"]: (70, 90), "options[0].forest[0].stand.trees[0].per_ha": (40, 120)})
        expect_equal(inputs(f, site([belt("c.yaml")], uncertainty="none")), {})


def test_none_instead_of_the_base():
    """uncertainty: none over a base removes its rows; a star means all items of a list"""
    with Folder() as f:
        f.write("c.yaml", coppice(TREES))
        expect_equal(inputs(f, site([belt({"base": "c.yaml", "uncertainty": "none"})])), {})
        f.write("d.yaml", coppice({"path": "trees[*].per_ha", "lo": 40, "hi": 120},
                                  {"path": "energy.model", "one_of": ["brauner", "dorren"]}))
        found = inputs(f, site([belt("d.yaml")]))
        expect_equal(sorted(found), ["options[0].forest[0].stand.energy.model",
                                     "options[0].forest[0].stand.trees[0].per_ha"])


def test_what_is_not_there():
    """A row about a missing class is skipped"""
    with Folder() as f:
        f.write("c.yaml", coppice({**TREES, "path": "trees[3].per_ha"}))
        expect_equal(inputs(f, site([belt("c.yaml")])), {})


def test_no_change_of_a_run():
    """Rows affect only --sensitivity"""
    with Folder() as f:
        outs = []
        for rows in ([], [STOOLS]):
            f.write("c.yaml", coppice(*rows))
            r = ceduo("--batch", "-n", 50, "-f", "csv", f.write("s.yaml", site([belt("c.yaml")])))
            expect_equal(r.status, DONE, r)
            outs.append(r.out)
        expect_equal(outs[0], outs[1])


def test_refused():
    """Errors are reported once, in the stand's file"""
    wrong = [({**TREES, "path": "rock.mass_kg"}, "c.yaml", "uncertainty[0].path: 'rock.mass_kg' affects no result"),
             ({**TREES, "path": "uncertainty[0].lo"}, "c.yaml", "uncertainty[0].path: 'uncertainty[0].lo' affects no result"),
             ({**TREES, "lo": 130}, "c.yaml", "uncertainty[0].hi: the range is empty"),
             ({**TREES, "lo": -1}, "c.yaml", "uncertainty[0].lo: -1 is outside the range of per_ha"),
             ({"path": "trees[0].per_ha"}, "c.yaml", "uncertainty[0]: 'per_ha' is a number; give lo and hi, or mean and sd"),
             ({**TREES, "low": 3}, "c.yaml", "uncertainty[0].low: unknown key; did you mean 'lo'?"),
             ({"lo": 1, "hi": 2}, "c.yaml", "'path' is missing")]
    with Folder() as f:
        for row, name, words in wrong:
            f.write("c.yaml", {"ceduo": "stand/1", **coppice(row)})
            r = ceduo("--check", f.write("s.yaml", site([belt("c.yaml")], [belt("c.yaml")])))
            expect_equal(r.status, INPUT, r)
            expect_in(name, r.err)
            expect_in(words, r.err)
            expect_equal(r.err.count(words), 1, r.err)
        f.write("c.yaml", {"ceduo": "stand/1", **coppice(TREES, TREES)})
        r = ceduo("--check", f.write("s.yaml", site([belt("c.yaml")])))
        expect_in("'trees[0].per_ha' is given twice", r.err)
        f.write("c.yaml", coppice())
        r = ceduo("--check", "-s", "options[0].forest[0].stand.uncertainty=5", f.write("s.yaml", site([belt("c.yaml")])))
        expect(r.status != DONE, r)


if __name__ == "__main__":
    run_all(__name__)
