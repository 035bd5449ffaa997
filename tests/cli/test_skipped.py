#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Unneeded work is skipped: by the counters of `work`, or else by a million rocks that do not fit the allowed processor time."""
import resource
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import PROFILES, SANITIZED, SLOWER, Skip, expect, expect_equal, good, result, run_all  # noqa: E402

MANY = 1_000_000
SECONDS = 5 * SLOWER  # processor seconds: a million rocks take more, these requests none
RESERVES = "forest[0].stand.trees[0].per_ha"


def bounded(*arguments, **options):
    """Run the program on one thread, ended after SECONDS."""
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))

    return good(*arguments, preexec_fn=limit, **options)


def test_no_rocks():
    """Requests without rocks simulate none: the index from stands, pictures of stands, a search for the ADC"""
    for question in (["--batch", "-f", "csv", "--rows", "stands"], ["--plot", "stand"], ["--check"],
                     ["--find", f"{RESERVES}=1:5000", "--goal", "adc"], ["--find", f"{RESERVES}=1:5000", "--goal", "free-run"]):
        bounded(*question, *([] if "--check" in question else ["-n", MANY]), "-j", 1, "paper-site")


def test_index_shares_one_run():
    """With the contact model index eight options share one run, and stems are never drawn"""
    work = result("-n", 500, "-s", "simulation.contact_model=index", "four-systems")["work"]
    expect_equal((work["runs"], work["runs_reused"], work["rocks_flown"], work["stems_drawn"]), (1, 7, 500, 0))


def test_options_not_asked():
    """Unselected options are not simulated: each has a run, and one with the other energy law, plus the bare slope's"""
    one = result("-n", 500, "--option", "large reserves", "four-systems")["work"]
    all_ = result("-n", 500, "four-systems")["work"]
    expect_equal((one["runs"], one["rocks_flown"], all_["runs"], all_["rocks_flown"]), (3, 1500, 17, 8500))


def test_same_forest():
    """Options with the same forest, and one without any, share runs"""
    forest = "[{from_m: 0, to_m: 60, stand: ads-1}]"
    work = result("-n", 200, "-s", f"options=[{{name: a, forest: {forest}}}, {{name: b, forest: {forest}}}, {{name: c, forest: []}}]",
                  four())["work"]
    expect_equal((work["runs"], work["runs_reused"]), (3, 4))  # bare slope, forest, forest with the other energy law


def four():
    return PROFILES / "scenes" / "four-systems.yaml"


def test_years_unchanged():
    """Years with an unchanged stand are not simulated again: 27 years and 4 systems, at most 4 x 26 forests and the bare slope"""
    work = result("--years", "0:26", "-n", 50, "rotation")["work"]
    expect(work["runs"] <= 1 + 4 * 27 and work["runs_reused"] > 0, work)
    still = result("--years", "0:50", "-n", 50, "paper-site")["work"]
    expect(still["runs"] <= 2 + 51, still)
    none = result("--years", "0:50", "-n", 50, "-s", "forest=[]", "paper-site")["work"]
    expect_equal((none["runs"], none["rocks_flown"]), (1, 50), "without forest")


def test_stems_off_the_way():
    """Stems are drawn lazily: hardly more than a rock hits"""
    found = result("-n", 1000, "paper-site")
    contacts = found["options"][0]["controls"][0]["wooded"]["contacts"]["mean"]
    drawn = found["work"]["stems_drawn"] / 2000  # again with the other energy law
    expect(contacts <= drawn <= 3 * contacts, f"{drawn} drawn, {contacts} hit on the way to the control")


def test_nothing_to_draw():
    """A spread of 0 is no spread, lumped ignores spin, a diameter spread of 0 needs no draw: equal bytes"""
    def out(*sets):
        words = [w for s in sets for w in ("-s", s)]
        text = result("-n", 300, *words, "paper-site")
        text["work"].pop("seconds")
        for stand in text["options"][0]["stands"]:
            stand["name"] = stand["name"].removesuffix(" (changed)")
        return text
    plain = out()
    expect_equal(out("rock.density_kg_m3={mean: 2600, spread: 0}"), plain, "density")
    expect_equal(out("release.vx_m_s={mean: 0.3, spread: 0, kind: uniform}"), plain, "speed")
    expect_equal(out("release.spin_rad_s=40"), plain, "spin")
    expect_equal(out("forest[0].stand.shoots[0].dbh_sd_m=0"), plain, "diameters")


def test_tolerance_stops():
    """A tolerance limits the simulation"""
    found = result("-e", 0.05, "-n", MANY, "paper-site")
    expect(found["rocks"] < 5000, found["rocks"])


def test_memory_is_kept():
    """Two threads with 1400 runs of few rocks use the same memory again: ten times fewer page faults than when each gets new
    memory"""
    if SANITIZED:
        raise Skip("the sanitizers have their own malloc")
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_minflt
    good("--batch", "-n", 500, "-j", 2, "paper-site")
    faults = resource.getrusage(resource.RUSAGE_CHILDREN).ru_minflt - before
    expect(faults < 4000, f"{faults} page faults")


if __name__ == "__main__":
    run_all(__name__)
