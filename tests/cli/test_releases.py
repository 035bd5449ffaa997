#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Several releases on one profile, each with a share of the rocks."""
import json
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import DONE, INPUT, USAGE, Folder, ceduo, expect, expect_equal, expect_in, expect_near, good, run_all, wooded_scene

# Rocks that start at x = 5 m stay in a hollow; rocks that start at x = 65 m reach x = 110 m.
HOLLOW = {"vertices_m": [[0, 50], [20, 20], [40, 20], [60, 40], [61, 40], [120, 0]],
          "segments": [{"rn": 0.3, "rt": 0.8, "roughness_rad": 0.1, "friction": 0.5}]}
ABOVE, BELOW = {"x_m": 5, "vx_m_s": 1}, {"x_m": 65, "vx_m_s": 1}


def hollow(*shares, **more):
    releases = [{**r, "share": s} for r, s in zip((ABOVE, BELOW), shares)]
    return wooded_scene(slope=HOLLOW, controls=[{"x_m": 110, "accepted_kJ": 20}], forest=[], release=releases, **more)


def run(f, text, *words, rocks=4000):
    f.write("s.yaml", text)
    answer = good("-b", "-n", rocks, "-f", "json", *words, "s.yaml", cwd=f.path).json()[0]
    answer["work"]["seconds"] = None
    return answer


def bare(answer):
    return answer["options"][0]["controls"][0]["bare"]


def test_one():
    """A list of one release gives the bits of the mapping"""
    with Folder() as f:
        for release in ({"vx_m_s": 2}, {"x_m": {"mean": 3, "spread": 2, "kind": "uniform"}, "height_m": 1, "vx_m_s": {"mean": 2, "spread": 0.5}}):
            single = run(f, wooded_scene(release=release), rocks=500)
            expect_equal(run(f, wooded_scene(release=[{**release, "share": 1}]), rocks=500), single)


def test_shares():
    """The share of the rocks that arrive is the share of the release below the hollow, whatever threads and seed"""
    rocks = 20000
    with Folder() as f:
        for share in (0.3, 0.75):
            reach = bare(run(f, hollow(1 - share, share), rocks=rocks))["reach_probability"]
            expect_near(reach, share, 4 * (share * (1 - share) / rocks) ** 0.5)
            expect_equal(bare(run(f, hollow(1 - share, share), "-j", "1", rocks=rocks))["reach_probability"], reach)
        alone = [bare(run(f, wooded_scene(slope=HOLLOW, controls=[{"x_m": 110}], forest=[], release=r)))["reach_probability"]
                 for r in (ABOVE, BELOW)]
        expect_equal(alone, [0, 1])
        energies = [bare(run(f, text, rocks=rocks))["energy_kJ"] for text in
                    (hollow(0.5, 0.5), wooded_scene(slope=HOLLOW, controls=[{"x_m": 110}], forest=[], release=BELOW))]
        expect_near(energies[0]["mean"], energies[1]["mean"], 4 * (energies[0]["se"] ** 2 + energies[1]["se"] ** 2) ** 0.5)


def test_forest():
    """With stems, a mixture of two releases arrives as the mean of both; results do not depend on threads"""
    releases = [{"x_m": 0, "vx_m_s": 2}, {"x_m": 40, "vx_m_s": 2}]
    with Folder() as f:
        def wooded(release, *words):
            text = wooded_scene(release=release, controls=[{"x_m": 105, "accepted_kJ": 60}])
            return run(f, text, *words)["options"][0]["controls"][0]["wooded"]
        alone = [wooded(r)["reach_probability"] for r in releases]
        both = [{**r, "share": s} for r, s in zip(releases, (0.25, 0.75))]
        mixed = wooded(both)
        expect(abs(alone[0] - alone[1]) > 0.1, alone)
        expect_near(mixed["reach_probability"], 0.25 * alone[0] + 0.75 * alone[1], 4 * (3 * 0.25 / 4000) ** 0.5)
        expect_equal(wooded(both, "-j", "1"), mixed)


def test_rounding():
    """Shares that differ from 1 by rounding are used in proportion"""
    with Folder() as f:
        three = [{**ABOVE, "share": 0.333}, {**ABOVE, "share": 0.333}, {**BELOW, "share": 0.333}]
        reach = bare(run(f, wooded_scene(slope=HOLLOW, controls=[{"x_m": 110}], forest=[], release=three), rocks=20000))["reach_probability"]
        expect_near(reach, 1 / 3, 4 * (2 / 9 / 20000) ** 0.5)


def test_errors():
    """An error names the file, the line and the remedy"""
    with Folder() as f:
        many = f.write("s.yaml", {**hollow(0.5, 0.5), "release": [{"x_m": 5, "share": 1 / 1001}] * 1001})
        expect_in("release: 1001 items; at most 1000 can be computed", ceduo("--check", many).err)
        for change, words in (({"share": 0.6}, "s.yaml:{release}: release: the shares add up to 1.1, not to 1; correct them"),
                              ({"share": 0}, "release[1].share: 0 is not above 0"), ({"share": 1.5}, "release[1].share: 1.5 is above 1"),
                              ({"share": None}, "release[1]: 'share' is missing"), ({"x_m": 500}, "release[1].x_m: 500 lies outside the slope"),
                              ({"x_m": 115}, "110 must lie beyond the release (115 m)"), ({"y_m": 1}, "release[1].y_m: unknown key"),
                              ({"height_m": -1}, "release[1].height_m: -1 is below 0 m")):
            item = {k: v for k, v in {**BELOW, "share": 0.5, **change}.items() if v is not None}
            text = "\n".join(["ceduo: scene/1", "rock: {shape: sphere, diameter_m: 0.75}", "release:", "  - {x_m: 5, share: 0.5}",
                              f"  - {json.dumps(item)}", f"slope: {json.dumps(HOLLOW)}", "controls: [{x_m: 110}]", "forest: []", ""])
            f.write("s.yaml", text)
            r = ceduo("--check", "s.yaml", cwd=f.path)
            expect_equal(r.status, INPUT, str(r))
            expect_in(words.replace("{release}", "4:3"), r.err)
            expect("release[1]" not in words or "s.yaml:5:" in r.err, r.err)
        f.write("e.yaml", wooded_scene(release=[]))
        expect_in("release: the list is empty", ceduo("--check", "e.yaml", cwd=f.path).err)
        f.write("m.yaml", wooded_scene(release={"share": 1}))
        expect_in("release.share: unknown key", ceduo("--check", "m.yaml", cwd=f.path).err)


def test_paths():
    """--set, --each, --find, uncertain inputs and --list-parameters know the paths of a list"""
    with Folder() as f:
        moved = hollow(0.5, 0.5)
        moved["release"][1]["x_m"] = 70
        moved = run(f, moved, rocks=200)
        f.write("s.yaml", hollow(0.5, 0.5))
        answer = good("-b", "-n", 200, "-f", "json", "-s", "release[1].x_m=70", "s.yaml", cwd=f.path).json()[0]
        expect_equal(answer["options"], moved["options"])
        for path in ("release.x_m", "release[2].x_m", "release[0].y_m"):
            expect_equal(ceduo("-b", "-s", f"{path}=1", "s.yaml", cwd=f.path).status, USAGE, path)
        f.write("rows.csv", 'id,release\na,"[{x_m: 5, share: 0.5}, {x_m: 70, share: 0.5}]"\nb,"{x_m: 70}"\nc,"[{x_m: 70, share: 0.9}]"\n')
        r = ceduo("-b", "-q", "-n", 200, "-f", "csv", "--each", "rows.csv", "--columns", "id,status,reason", "s.yaml", cwd=f.path)
        expect_equal(r.out.splitlines()[1:], ["a,ok,", "b,ok,", 'c,failed,"release: the shares add up to 0.9, not to 1; correct them"'])
        found = good("--find", "release[1].height_m=0:10", "--goal", "energy=1e4", "-n", 100, "-f", "json", "s.yaml", cwd=f.path).json()[0]
        expect_equal(found["path"], "release[1].height_m")
        f.write("s.yaml", hollow(0.5, 0.5, uncertainty=[{"path": "release[1].vx_m_s", "lo": 0.5, "hi": 3}]))
        figures = good("--sensitivity=32", "-n", 200, "-f", "json", "s.yaml", cwd=f.path).json()[0]["figures"]
        expect({i["path"] for i in figures[0]["inputs"]} >= {"release[1].vx_m_s"}, figures[0])
        listed = good("--list-parameters").out
        for path in ("release.x_m ", "release[].x_m ", "release[].share "):
            expect_in("\n" + path, listed)


def test_answers():
    """Index, pictures, report and observations work with several releases"""
    with Folder() as f:
        f.write("s.yaml", wooded_scene(release=[{"x_m": 0, "share": 0.5}, {"x_m": 40, "share": 0.5}]))
        mean = run(f, wooded_scene(release={"x_m": 20}), rocks=200)
        f.write("s.yaml", wooded_scene(release=[{"x_m": 0, "share": 0.5}, {"x_m": 40, "share": 0.5}]))
        answer = good("-b", "-n", 200, "-f", "json", "s.yaml", cwd=f.path).json()[0]
        expect_equal(answer["options"][0]["summary"]["length_m"], mean["options"][0]["summary"]["length_m"], "the index uses the mean release")
        for words in (["-b", "-n", 100, "--plot", "profile"], ["-n", 100, "--plot", "energy"], ["-n", 100, "--report", "-"], ["--check"],
                      ["-b", "-n", 100]):
            expect_equal(ceduo(*words, "s.yaml", cwd=f.path).status, DONE, words)
        observed = {"stops": [{"x_m": [70, 80, 95], "of": 20}, {"x_m": [75, 85], "of": 5, "release": {"x_m": 10}}]}
        f.write("o.yaml", wooded_scene(release=[{"x_m": 0, "share": 0.5}, {"x_m": 40, "share": 0.5}], observed=observed))
        r = ceduo("--calibrate", "slope.segments[0].rt=0.7:0.95", "-n", 100, "o.yaml", cwd=f.path)
        expect_equal(r.status, DONE, str(r))


if __name__ == "__main__":
    run_all(__name__)
