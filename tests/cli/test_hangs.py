#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: slow
"""No scene hangs or exhausts memory: valid scenes end, and a signal or a key ends the program at any time.

tests/bench/bench_reaction.py measures the delay; only a hang fails here."""
import os
import signal
import subprocess

from harness import (CEDUO, DONE, INPUT, RUN, SANITIZED, SLOWER, Folder, Skip, ceduo, environment, expect, expect_equal,
                     expect_in, run_all, scene, stand)
from long_scenes import LONG, Running, dense_trees, long_slope

LATE = 1 * SLOWER  # seconds of processor time: ten times the usual


def test_too_many_stems():
    """A rock that meets more than a million stems is unfinished, and the page reports it"""
    with Folder() as f:
        path = f.write("long.yaml", long_slope(1e5, 1e5 - 1, 1e6))
        r = ceduo("--batch", "-f", "json", "-n", 3, path)
        expect_equal(r.status, RUN, "status")
        found = r.json()[0]
        option = found["options"][0]
        expect_equal(option["ends"]["unfinished"], 3, "unfinished rocks")
        expect_equal(option["controls"][0]["wooded"]["rocks_reached"], 0, "that arrive")
        expect(option["controls"][0]["wooded"]["reach_hi"] == 1, "any of them may arrive", option["controls"][0])
        expect_equal(option["controls"][0]["bare"]["rocks_reached"], 3, "that arrive without stems")
        warnings = " ".join(found["warnings"])
        expect_in("3 rocks had more than 1000000 contacts or stems in the forest and count as unfinished", warnings)
        # a million stems drawn, and at most one pause's more, for each
        drawn = found["work"]["stems_drawn"] / 3  # under the other energy law they are stopped soon
        expect(1e6 <= drawn < 1.02e6, f"{drawn} stems for each rock")


def test_wood_that_ends_before():
    """A rock that meets slightly fewer stems continues to its end"""
    with Folder() as f:
        # 0.5 m of rock and 0.02 m of tree, 100 trees per square metre: 52 stems per metre, 936 000 in 18 km
        path = f.write("long.yaml", long_slope(1e5, 18000, 1e6))
        r = ceduo("--batch", "-f", "json", "-n", 2, path)
        expect_equal(r.status, DONE, r)
        wooded = r.json()[0]["options"][0]["controls"][0]["wooded"]
        expect_equal(wooded["rocks_reached"], 2, "rocks that arrive")
        expect(abs(wooded["contacts"]["mean"] / 936000 - 1) < 0.004, "four standard errors of a Poisson number", wooded)


def test_spread():
    """Diameters with a spread above their mean are refused, with the reason"""
    for stems, where in (({"trees": [{"per_ha": 10, "dbh_m": 1e-9, "height_m": 9, "dbh_sd_m": 0.01}]}, "trees[0]"),
                         ({"shoots": [{"per_ha": 5000, "dbh_m": 0.05, "height_m": 6},
                                      {"per_ha": 5000, "dbh_m": 0.05, "height_m": 6, "dbh_sd_m": 0.0500001}]}, "shoots[1]")):
        with Folder() as f:
            path = f.write("s.yaml", scene(forest=[{"from_m": 0, "to_m": 90, "stand": stand(**stems)}]))
            r = ceduo("--batch", path)
            expect_equal(r.status, INPUT, r)
            expect_in(f"{where}.dbh_sd_m: ", r.err)
            expect_in("exceeds the diameter", r.err)
    for least in (5e-324, 1e-200, 1e-12):  # as none at all: a gamma law of it is beyond what doubles hold
        with Folder() as f:
            trees = [{"per_ha": 800, "dbh_m": 0.2, "height_m": 9, "dbh_sd_m": least}]
            path = f.write("s.yaml", scene(forest=[{"from_m": 0, "to_m": 90, "stand": stand(stools=None, shoots=None, trees=trees)}]))
            expect_equal(ceduo("--batch", "-n", 20, path).status, DONE, f"{least}")
    with Folder() as f:
        equal = {"trees": [{"per_ha": 10, "dbh_m": 0.2, "height_m": 9, "dbh_sd_m": 0.2}]}
        path = f.write("s.yaml", scene(forest=[{"from_m": 0, "to_m": 90, "stand": stand(**equal)}]))
        expect_equal(ceduo("--batch", "-n", 20, path).status, DONE, "as large as itself")


def test_other_sizes():
    """The page of a tiny splinter takes at most a few seconds more than its JSON"""
    for rock in ({"shape": "cylinder", "diameter_m": 1e-6, "height_m": 0.75}, {"shape": "block", "axes_m": [1e-6, 0.75, 0.75]}):
        with Folder() as f:
            path = f.write("s.yaml", scene(rock=rock, forest=[{"from_m": 0, "to_m": 90, "stand": stand()}]))
            r = ceduo("--batch", "--details", "-n", 2000, path)
            expect(r.status in (DONE, RUN), r)
            expect_in("Blocks of other sizes", r.out)


def test_all_end():
    """Each of the long scenes ends, with few rocks"""
    for name, what in LONG.items():
        with Folder() as f:
            path = f.write("long.yaml", what)
            for form, rocks in (("json", 3), ("table", 1)):
                r = ceduo("--batch", "-f", form, "-n", rocks, path)
                expect(r.status in (DONE, RUN), name, r)


def end_all(begin, end):
    latest = 0
    for name, what in LONG.items():
        with Folder() as f:
            path = f.write("long.yaml", what)
            with Running(*begin, path, terminal=begin == ()) as r:
                r.work(0.2)
                _, seconds = end(r)
                expect(seconds < LATE, f"{name}: ended after {seconds:.2f} s of processor")
                latest = max(latest, seconds)
    print(f"# at the latest after {latest * 1000:.0f} ms of processor")


def test_signal_json():
    """SIGTERM ends a run of each long scene quickly"""
    end_all(("--batch", "-f", "json", "-n", 10**6), lambda r: r.end_by_signal(signal.SIGTERM))


def test_signal_picture():
    """SIGINT ends a picture of each long scene quickly"""
    end_all(("--plot", "profile", "-n", 10**6), lambda r: r.end_by_signal(signal.SIGINT))


def test_signal_terminal():
    """SIGTERM ends the terminal program quickly, with each long scene"""
    end_all((), lambda r: r.end_by_signal(signal.SIGTERM))


def test_key_terminal():
    """q ends the terminal program quickly, with each long scene"""
    end_all((), lambda r: r.end_by_key("q"))


def peak_memory(*arguments):
    """Return the program's peak memory in MB."""
    process = subprocess.Popen([CEDUO, *map(str, arguments)], stdout=subprocess.DEVNULL, env=environment())
    _, status, used = os.wait4(process.pid, 0)
    process.returncode = status
    expect_equal(status, 0, "status")
    return used.ru_maxrss / 1024


def test_memory():
    """Stored results use at most 50 bytes per rock"""
    if SANITIZED:
        raise Skip("a sanitizer has memory of its own")
    # speed, height and energy at the control and the stops, 8 bytes each; reading adds 16 bytes for sorting
    most = 60
    short = {"vertices_m": [[0, 4], [4, 0]], "segments": [{"rn": 0.3, "rt": 0.9}]}
    with Folder() as f:
        path = f.write("many.yaml", scene(slope=short, controls=[{"x_m": 3}], simulation={"contact_model": "index", "law": "lumped"}))
        used = peak_memory("--batch", "-q", "-f", "json", "-n", 10**6, path)
        expect(used < most, f"{used:.0f} MB")


def test_stepping():
    """A trajectory too long to draw is drawn partly"""
    with Folder() as f:
        path = f.write("long.yaml", long_slope(1e5, 1e5 - 1, 1e6))
        script = f.write("keys", "resize 100 30\nkey 1 Tab Right Right\ndump -\n")
        r = ceduo("--script", script, path)
        expect_equal(r.status, DONE, r)
        expect_in("is not shown further", r.out)


if __name__ == "__main__":
    run_all(__name__)
