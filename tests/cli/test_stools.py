#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Changing the stools: shoots given per stool, or per hectare. Warnings of unlikely stands."""
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tui"))
from harness import DONE, INPUT, Folder, ceduo, expect, expect_equal, expect_in, good, result, run_all, scene, stand, wooded_scene
from play import play

STOOLS = "forest[0].stand.stools.per_ha"
NUMBERS = (500, 2000, 8000)


def coppice(stools=2500, spacing=0.35, **shoots):
    """Return a stand with 3 shoots per stool, or 7500 per hectare."""
    shoots = shoots or {"per_stool": 3}
    return stand(stools={"per_ha": stools, "spacing_m": spacing}, trees=None, energy=None,
                 shoots=[{**shoots, "dbh_m": 0.07, "height_m": 8}])


def wood(of, **more):
    return wooded_scene(controls=[{"x_m": 105, "name": "road", "accepted_kJ": 60}], simulation={"rocks": 500},
                        forest=[{"from_m": 10, "to_m": 95, "stand": of}], **more)


def answer(*arguments):
    """Return stems and stools per hectare, and the share of 500 rocks that arrive with too much energy."""
    option = result(*arguments)["options"][0]
    return (option["stands"][0]["stems_per_ha"], option["stands"][0]["stools_per_ha"],
            option["controls"][-1]["wooded"]["exceed_probability"])


def four_ways(f, of, number):
    """Change by -s, base, the form and --find, which returns only the goal."""
    f.write("stand.yaml", {"ceduo": "stand/1", **of})
    f.write("scene.yaml", wood("stand.yaml"))
    f.write("based.yaml", wood({"base": "stand.yaml", "stools": {"per_ha": number}}))
    f.write("formed.yaml", wood("stand.yaml"))
    play(f.path, f"key 2\nfind stools.per_ha\nset {number}\nkey s Enter Enter", "formed.yaml")
    ways = [answer("-s", f"{STOOLS}={number}", f.path / "scene.yaml"), answer(f.path / "based.yaml"), answer(f.path / "formed.yaml")]
    found = good("--find", f"{STOOLS}={number}:{number}", "--goal", "exceed=1", "-f", "json", f.path / "scene.yaml").json()[0]
    return ways, found["goal_at_value"]


def check_ways(of, shoots_of):
    with Folder() as f:
        shares = set()
        for number in NUMBERS:
            ways, goal = four_ways(f, of, number)
            expect_equal(ways[0][:2], (shoots_of(number), number), "stems, stools")
            expect(ways[0] == ways[1] == ways[2] and goal == ways[0][2], number, ways, goal)
            shares.add(goal)
        return sorted(shares)


def test_four_ways():
    """-s, --find, base and the form agree: with three shoots per stool, stools bring their shoots"""
    shares = check_ways(coppice(), lambda number: 3 * number)
    expect(shares[-1] > 2 * shares[0], "sixteen times the stems stop hardly more:", shares)


def test_four_ways_per_ha():
    """Shoots given per hectare stay constant in all four ways"""
    check_ways(coppice(stools=500, per_ha=8000), lambda number: 8000)


def test_shipped():
    """The shipped stands give shoots per stool; the paper's plots keep the counted ones"""
    for name, shoots, trees in (("simple-coppice", 2.695 * 1000, 60), ("ads-1", 8326, 750)):
        made = wood({"base": name, "stools": {"per_ha": 1000}})
        with Folder() as f:
            expect_equal(answer(f.write("s.yaml", made))[0], shoots + trees, name)


def refused(f, of):
    r = ceduo("--check", f.write("s.yaml", wood(of)))
    expect_equal(r.status, INPUT, r)
    return r.err


def test_one_of_both():
    """Both keys, neither, missing stools, and less than one shoot per stool are refused"""
    with Folder() as f:
        expect_in("shoots[0].per_ha: per_stool already says this", refused(f, coppice(per_stool=3, per_ha=7500)))
        expect_in("'per_ha' or 'per_stool' is missing", refused(f, coppice(dbh_sd_m=0)))
        expect_in("is not above 0", refused(f, coppice(per_stool=0)))
        expect_in("each stool needs one", refused(f, coppice(per_stool=0.9)))
        bare = coppice()
        del bare["stools"]
        expect_in("shoots without stools", refused(f, bare))
        two = coppice(per_stool=0.4)
        two["shoots"] *= 2
        two["shoots"][1] = {**two["shoots"][1], "per_stool": 0.6}
        expect_equal(ceduo("--check", f.write("s.yaml", wood({**two, "stools": {"per_ha": 1337, "spacing_m": 0.4}}))).status, DONE)


def test_set_replaces():
    """--set of one key removes the other, and no stools have no shoots"""
    with Folder() as f:
        path = f.write("s.yaml", wood(coppice()))
        shoots = "forest[0].stand.shoots[0]."
        expect_equal(answer("-s", shoots + "per_ha=6000", path)[:2], (6000, 2500))
        expect_equal(answer("-s", shoots + "per_ha=6000", "-s", shoots + "per_stool=4", path)[:2], (10000, 2500))
        expect_equal(answer("-s", STOOLS + "=0", path)[:2], (0, 0))


def energy(f, of):
    """Mean energy per released rock, with the rocks of --sensitivity."""
    run = result("-n", 400, f.write("run.yaml", wood(of)))
    return run["options"][0]["controls"][-1]["wooded"]["energy_per_released_kJ"]["mean"]


def test_uncertainty():
    """With uncertain stools, shoots per stool follow; per_ha and per_stool can be uncertain whichever is given"""
    def of(stools, **given):
        return {**coppice(stools, **given), "energy": {"model": "brauner", "u_J_m3": 100000}}
    shoots = "forest[0].stand.shoots[0]."
    cases = ((STOOLS, (1500, 2500), of(2000, per_stool=3), (of(1500, per_ha=4500), of(2500, per_ha=7500))),
             (STOOLS, (1500, 2500), of(2000, per_ha=6000), (of(1500, per_ha=6000), of(2500, per_ha=6000))),
             (shoots + "per_ha", (5000, 7000), of(2000, per_stool=3), (of(2000, per_ha=5000), of(2000, per_ha=7000))),
             (shoots + "per_ha", (1500, 7000), of(2000, per_ha=6000), (of(1500, per_ha=1500), of(2000, per_ha=7000))),
             (shoots + "per_stool", (2, 4), of(2000, per_stool=3), (of(2000, per_ha=4000), of(2000, per_ha=8000))),
             (shoots + "per_stool", (2, 4), of(2000, per_ha=6000), (of(2000, per_ha=4000), of(2000, per_ha=8000))))
    with Folder() as f:
        for path, (lo, hi), given, ends in cases:
            made = f.write("s.yaml", wood(given, uncertainty=[{"path": path, "lo": lo, "hi": hi}]))
            r = good("--sensitivity=8", "-f", "json", made).json()[0]
            found = [(i["at_lo"], i["at_hi"]) for x in r["figures"] if x["figure"] == "energy_per_released_kJ" and x["x_m"] == 105
                     for i in x["inputs"] if i["path"] == path]
            expect_equal(len(found), 1, f"{path}, {given['shoots']}")
            for at, end in zip(found[0], ends):  # summed in another order
                known = energy(f, end)
                expect(abs(at - known) < 1e-9 * known, f"{path}, {given['shoots']}: {at} instead of {known}")


def test_one_uncertainty():
    """A row about one of the two keys replaces the default range of the other"""
    of = coppice()
    of["shoots"][0]["source"] = {"kind": "assumed", "text": "a guess"}
    with Folder() as f:
        for more in ([], [{"path": "forest[0].stand.shoots[0].per_ha", "lo": 7000, "hi": 8000}]):
            r = good("--sensitivity=4", "-f", "json", "-n", 50, f.write("s.yaml", wood(of, uncertainty=more) if more else wood(of))).json()[0]
            paths = [i["path"] for i in r["figures"][0]["inputs"] if ".per_" in i["path"]]
            expect_equal(paths, [more[0]["path"] if more else "forest[0].stand.shoots[0].per_stool"], "of the shoots")


# ---- unlikely stands ----

def warnings_of(f, of):
    return result("-n", 10, f.write("s.yaml", wood(of)))["options"][0]["stands"][0]["warnings"]


def test_unlikely():
    """Basal area, shoots per stool, h/d and the largest dbh cause warnings just beyond their limits, not at them"""
    tree = {"per_ha": 100, "dbh_m": 0.2, "height_m": 12, "volume_m3": 0.2}
    area = 60 / (3.141592653589793 * 0.25 * 0.04)  # trees of 20 cm with 60 m2

    def trees(**changes):
        return stand(stools=None, shoots=None, trees=[{**tree, **changes}])
    cases = (("of basal area are more than 60", trees(per_ha=area), trees(per_ha=area + 1)),
             ("shoots a stool are more than 15", coppice(1000, per_stool=15), coppice(1000, per_stool=15.1)),
             ("shoots a stool are more than 15", coppice(1000, per_ha=15000), coppice(1000, per_ha=15100)),
             ("30.1 m tall: unusual height/diameter ratio (usual 25–150)", trees(height_m=30), trees(height_m=30.1)),
             ("4.9 m tall: unusual height/diameter ratio (usual 25–150)", trees(height_m=5), trees(height_m=4.9)),
             ("thicker than the volume tables", trees(dbh_m=0.35), trees(dbh_m=0.351)))
    with Folder() as f:
        for told, at, beyond in cases:
            expect(not any(told in w for w in warnings_of(f, at)), told, warnings_of(f, at))
            expect_equal(sum(told in w for w in warnings_of(f, beyond)), 1, told)
        expect_equal(warnings_of(f, trees(per_ha=0, height_m=40)), [], "of none nothing is unlikely")
        dense = warnings_of(f, coppice(4500, per_stool=4))
        expect_equal(sum("69.3 m2/ha" in w for w in dense), 1, dense)


if __name__ == "__main__":
    run_all(__name__)
