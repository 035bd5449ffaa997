#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The law arm in scenes: its assumptions, its uncertain inputs, and the shipped scene."""
import csv

from harness import DONE, ROOT, Folder, ceduo, expect, expect_equal, run_all, scene

GROUND = {"rn": 0.35, "rt": 0.88, "roughness_rad": 0.25, "friction": 0.5}
PROFILE = [[0, 60], [60, 8], [200, 0]]


def assumed(slope, law):
    """Return the assumptions about the slope in the result"""
    with Folder() as f:
        path = f.write("s.yaml", scene(slope={"vertices_m": PROFILE, **slope}, simulation={"law": law}))
        r = ceduo("-b", "--details", "-s", "uncertainty=none", "-n", 20, path)
        expect_equal(r.status, DONE, r)
        return r.out.count("friction mu 0.6 where a rock strikes")


def test_mu_is_said_to_be_assumed():
    """With arm mu is assumed unless given; the other laws do not use it"""
    materials = {"materials": [{"from_m": 0, "to_m": 200, "material": "talus"}]}
    for slope in ({"segments": [GROUND]}, materials):
        expect(assumed(slope, "arm") > 0, slope)
        expect_equal(assumed(slope, "lumped"), 0)
    expect_equal(assumed({"segments": [{**GROUND, "mu": 0.6}]}, "arm"), 0)
    with Folder() as f:  # a profile without a ground: talus
        f.write("p.csv", "distance,elevation\n0,60\n60,8\n200,0\n")
        path = f.write("s.yaml", scene(slope={"csv": "p.csv"}, simulation={"law": "arm"}))
        expect("friction mu 0.6 where a rock strikes" in ceduo("-b", "--details", "-s", "uncertainty=none", "-n", 20, path).out)


def inputs(law):
    slope = {"vertices_m": PROFILE, "materials": [{"from_m": 0, "to_m": 200, "material": "talus"}]}
    with Folder() as f:
        path = f.write("s.yaml", scene(slope=slope, rock={"diameter_m": 0.5}, simulation={"law": law}))
        r = ceduo("-f", "json", "-n", 20, "--sensitivity=2", path)
        expect_equal(r.status, DONE, r)
        return {i["path"] for i in find(r.json()[0], "inputs")}


def test_uncertainty_is_of_what_the_law_knows():
    """mu is uncertain with arm, Rt with the other laws"""
    mu, rt = "slope.materials[talus].mu", "slope.materials[talus].rt"
    expect(mu in inputs("arm") and rt not in inputs("arm"))
    expect(rt in inputs("lumped") and mu not in inputs("lumped"))


def test_shapes():
    """A plate goes less far than a rock of equal axes; under lumped both are equal"""
    def stops(law, axes):
        with Folder() as f:
            path = f.write("s.yaml", scene(rock={"shape": "ellipsoid", "axes_m": axes}, controls=[{"x_m": 60}], forest=None,
                                           slope={"vertices_m": PROFILE, "segments": [GROUND]}, simulation={"law": law}))
            return find(ceduo("-b", "-f", "json", "-n", 2000, path).json()[0], "stop_x_m")["p50"]
    expect_equal(stops("lumped", [0.5, 0.5, 0.5]), stops("lumped", [0.75, 0.5, 0.25]))  # the same mean to the last bit
    expect(stops("arm", [0.4, 0.4, 0.4]) > stops("arm", [0.6, 0.4, 0.2]) + 1)


def find(what, key):
    """Return the first value of a key, at any depth"""
    if isinstance(what, dict):
        if key in what:
            return what[key]
        what = list(what.values())
    for one in what if isinstance(what, list) else []:
        value = find(one, key)
        if value is not None:
            return value
    return None


def test_tschamut():
    """Eighty stops, with their source and licence"""
    beside = ROOT / "profiles" / "observed"
    with open(beside / "tschamut-2014.csv", encoding="utf-8") as f:
        rows = list(csv.DictReader(f))
    expect_equal([sum(r["block"] == b for r in rows) for b in "124"], [29, 25, 26])
    text = (beside / "tschamut-2014.txt").read_text(encoding="utf-8")
    for word in ("Volkwein", "doi:10.16904/envidat.34", "Open Database License", "Database Contents"):
        expect(word in text, word)
    r = ceduo("--check", "tschamut")
    expect_equal((r.status, r.err), (DONE, ""), r)


if __name__ == "__main__":
    run_all(__name__)
