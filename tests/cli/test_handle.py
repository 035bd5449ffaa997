#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The handle of the library, through man/examples/ceduo.py: the figures of the program, changes, samples, wrong use."""
import ctypes
import math
import os
import random
import subprocess
import sys
import threading

from harness import FULL, PROFILES, ROOT, SANITIZED, Skip, ceduo, expect, expect_equal, expect_in, expect_near, run_all

LIBRARY = ROOT / os.environ.get("BUILD", "build/release") / "libceduo.so"
SHARE = "options[0].controls[0].wooded.reach_probability"


def restart():
    """Let the loader find the library by its name. A sanitized library needs its runtime before all others."""
    os.environ["LD_LIBRARY_PATH"] = str(LIBRARY.parent)
    if SANITIZED:
        name = "libasan.so" if b"__asan_init" in LIBRARY.read_bytes() else "libtsan.so"
        runtime = subprocess.run([os.environ.get("CC", "cc"), f"-print-file-name={name}"], capture_output=True, text=True, check=True)
        os.environ.update(LD_PRELOAD=runtime.stdout.strip(), ASAN_OPTIONS="detect_leaks=0", TSAN_OPTIONS="report_bugs=1")
    os.execv(sys.executable, [sys.executable, *sys.argv])


if os.environ.get("LD_LIBRARY_PATH") != str(LIBRARY.parent):
    restart()
sys.path.insert(0, str(ROOT / "man/examples"))
import ceduo as door  # noqa: E402  pylint: disable=wrong-import-position

C = door._lib  # pylint: disable=protected-access


def scene(name):
    return door.Scene(PROFILES / f"scenes/{name}.yaml")


def numbers(value, path=""):
    """Return path and value of all numbers, flags and nulls of an answer."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from numbers(inner, f"{path}.{key}" if path else key)
    elif isinstance(value, list):
        for i, inner in enumerate(value):
            yield from numbers(inner, f"{path}[{i}]")
    elif not isinstance(value, str):
        yield path, value


def expect_error(words, call, *arguments):
    try:
        call(*arguments)
    except door.Error as error:
        expect_in(words, str(error), f"{call.__name__} {arguments}")
    else:
        expect(False, f"{call.__name__} {arguments} did not fail; wanted: {words}")


def test_figures():
    """Every number and flag of the JSON is what the handle gives"""
    for name in ("four-systems", "road-below"):
        path = PROFILES / f"scenes/{name}.yaml"
        answer = ceduo("--batch", path, "-f", "json", "-n", 300, "-j", 1).json()[0]
        with scene(name) as s:
            s.simulate(300)
            found = list(numbers(answer))
            expect(len(found) > 300, len(found))
            for where, wanted in found:
                if wanted is not None and not where.startswith("work."):
                    got = s.get(where)[0]
                    expect(got == float(wanted), f"{name} {where}: {got} instead of {wanted}")


def test_intervals():
    """The ends of an interval are those of the JSON; those of a mean lie 1.96 standard errors from it"""
    answer = ceduo("--batch", "paper-site", "-f", "json", "-n", 500).json()[0]["options"][0]["controls"][0]["wooded"]
    with scene("paper-site") as s:
        s.simulate(500)
        expect_equal(s.get(SHARE), tuple(answer[k] for k in ("reach_probability", "reach_lo", "reach_hi")), "share")
        energy = answer["energy_kJ"]
        path = SHARE.replace("reach_probability", "energy_kJ.")
        expect_equal(s.get(path + "p95"), tuple(energy[k] for k in ("p95", "p95_lo", "p95_hi")), "95th percentile")
        value, low, high = s.get(path + "mean")
        expect_equal(value, energy["mean"])
        expect_near(low, value - 1.96 * energy["se"], 1e-4 * value, "low")
        expect_near(high, value + 1.96 * energy["se"], 1e-4 * value, "high")
        value, low, high = s.get(path + "max")
        expect(value == energy["max"] and math.isnan(low) and math.isnan(high), value, low, high)


def test_names():
    """An option has its index or its name in brackets; a value of the scene is one of its file, with defaults"""
    with scene("four-systems") as s:
        s.simulate(100)
        expect_equal(s.get("options[large reserves].controls[0].bare.reach_probability"),
                     s.get("options[6].controls[0].bare.reach_probability"))
        expect_equal(s.get("rock.density_kg_m3")[0], 2600.0)
        expect_equal(s.get("simulation.threshold_m")[0], 30.0)


def test_changes():
    """A change gives what --set gives; the last for a path counts; several can change together"""
    def share(*sets):
        words = [word for one in sets for word in ("-s", one)]
        return ceduo("--batch", "paper-site", "-f", "json", "-n", 300, *words).json()[0]["options"][0]["controls"][0]["wooded"]
    stools = "forest[0].stand.stools.per_ha"
    with scene("paper-site") as s:
        for n in (300, 900, 700):
            s.set(stools, n)
        s.simulate(300)
        expect_equal(s.get(SHARE)[0], share(f"{stools}=700")["reach_probability"], "700 stools")
        expect_equal(s.get(stools)[0], 700.0)
        s.set("controls[0].x_m", 120)
        expect_error("not simulated as it is now", s.get, SHARE)
        s.simulate(300)
        expect_equal(s.get(SHARE)[0], share(f"{stools}=700", "controls[0].x_m=120")["reach_probability"], "two changes")
        s.set("forest[0].to_m", 90)  # overlaps the second belt, until that changes, too
        s.set("forest[1].from_m", 90)
        s.simulate(100)
        expect_equal(s.get("options[0].stands[1].from_m")[0], 90.0)


def test_wrong_change():
    """A change that cannot be is refused at once, one that makes the scene invalid by the next call; then it can be mended"""
    with scene("paper-site") as s:
        expect_error("forest[0].stand.stool", s.set, "forest[0].stand.stool.per_ha", 1)
        expect_error("control", s.set, "controls[5].x_m", 1)
        s.simulate(50)
        before, diameter = s.get(SHARE), s.get("rock.diameter_m")[0]
        s.set("rock.diameter_m", -1)
        expect_error("ceduo_set()", s.simulate, 50)
        expect_error("ceduo_set()", s.get, SHARE)
        s.set("rock.diameter_m", diameter)
        s.simulate(50)
        expect_equal(s.get(SHARE), before)


def test_samples():
    """Samples are those of the figures: number, share, mean and largest value; stops lie on the slope"""
    with scene("paper-site") as s:
        s.simulate(400)
        for option, kind in ((0, "wooded"), (-1, "bare")):
            energies = list(s.samples("energy_kJ", option))
            arrived = [e for e in energies if not math.isnan(e)]
            path = f"options[0].controls[0].{kind}."
            expect_equal(len(energies), 400)
            expect_equal(len(arrived) / 400, s.get(path + "reach_probability")[0], kind)
            expect_near(sum(arrived) / len(arrived), s.get(path + "energy_kJ.mean")[0], 1e-9, kind)
            expect_equal(max(arrived), s.get(path + "energy_kJ.max")[0], kind)
            expect_equal(max(h for h in s.samples("height_m", option) if not math.isnan(h)), s.get(path + "height_m.max")[0])
            expect_equal(max(v for v in s.samples("speed_m_s", option) if not math.isnan(v)), s.get(path + "speed_m_s.max")[0])
        stops = [x for x in s.samples("stop_x_m", 0) if not math.isnan(x)]
        expect_equal(max(stops), s.get("options[0].stop_x_m.max")[0])
        part = (ctypes.c_double * 3)(7, 7, 7)
        count = C.ceduo_samples(s._handle, 0, 0, b"energy_kJ", part, 2)  # pylint: disable=protected-access
        expect(count == 400 and part[2] == 7, "only two are written", count, list(part))


def test_errors():
    """Wrong use is an error with a description: files, paths, indices, quantities, NULL, closed handles"""
    expect_error("cannot read it", door.Scene, "no-such-scene")
    s = scene("paper-site")
    expect_error("not simulated", s.get, SHARE)
    expect_error("not simulated", s.samples, "energy_kJ")
    s.simulate(20)
    for path in ("nothing", "options[0", "options[0].", "", "options[0][0].name", "controls[0]", SHARE + ".mean", "rock.",
                 "options.controls[0]"):
        expect_error("neither a figure", s.get, path)
    for path in ("options", "options[0]", "options[0].controls", "options[0].name", "options[0].controls[0].wooded.energy_kJ"):
        expect_error("is not a number", s.get, path)
    expect_error("no such item", s.get, "options[7].controls[0].bare.reach_probability")
    expect_error("no such item", s.get, "options[oak].controls[0].bare.reach_probability")
    expect_error("no quantity 'mass'", s.samples, "mass")
    expect_error("no option 3; the scene has 1", s.samples, "energy_kJ", 3)
    expect_error("no option -2", s.samples, "energy_kJ", -2)
    expect_error("no control 9; the scene has 1", s.samples, "energy_kJ", 0, 9)
    expect_error("no blocks", s.samples, "weight")
    expect_error("outside its range", s.simulate, 1 << 40)
    h, value = s._handle, (ctypes.c_double * 3)()  # pylint: disable=protected-access
    for status in (C.ceduo_get(h, None, value), C.ceduo_get(h, b"rock", None), C.ceduo_set(h, None, b"1"), C.ceduo_set(h, b"a", None),
                   C.ceduo_samples(h, 0, 0, None, None, 0), C.ceduo_samples(h, 0, 0, b"energy_kJ", None, 5)):
        expect(status != 0, "NULL is an error")
        expect_in("missing", C.ceduo_error(h).decode())
    expect_equal((C.ceduo_open(None), C.ceduo_error(0)), (0, b"the path is missing"))
    s.close()
    s.close()
    for status in (C.ceduo_get(h, b"rock.diameter_m", value), C.ceduo_set(h, b"a", b"1"), C.ceduo_simulate(h, 1, 1), C.ceduo_close(h)):
        expect_equal((status != 0, C.ceduo_error(h).decode()), (True, f"handle {h} is not open"))
    expect_equal(C.ceduo_error(h + 1), b"", "an error belongs to its handle")


def test_threads():
    """A second call for a handle in use is an error; two handles work at once, and give the same figures"""
    with scene("paper-site") as s, scene("paper-site") as other:
        def simulate():  # until the other thread does not hold the handle
            while error_of(s.simulate, 200000):
                pass

        long, refused = threading.Thread(target=simulate), 0
        long.start()
        while long.is_alive():
            refused += "another thread" in error_of(s.get, SHARE)
        long.join()
        expect(refused > 0, "no call was refused")
        threads = [threading.Thread(target=one.simulate, args=(2000,)) for one in (s, other)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        expect_equal(s.get(SHARE), other.get(SHARE))


def error_of(call, *arguments):
    try:
        call(*arguments)
    except door.Error as error:
        return str(error)
    return ""


def test_random_calls():
    """Random calls, with open, closed and invented handles, end with a status"""
    draw = random.Random(int(os.environ.get("SEED", "1")))
    handles, value, many = [0, 12345], (ctypes.c_double * 3)(), (ctypes.c_double * 50)()
    paths = [SHARE, "rock.diameter_m", "forest[0].stand.stools.per_ha", "options[0].window.mean", "options[1].name", "simulation.law",
             "options[0].controls[0].verdict.answer", "slope.segments[0].Rn", "controls[0].accepted_kJ", "options[0].yield.cuts[0].year",
             "release", "[0]", "options[*].controls[0]", "forest[0].stand", "x" * 300, "\xff", "", None]
    texts = ["1", "0", "-1", "1e9", "crsp", "nan", "{mean: 1, spread: .1}", "[", "{", "a: b", "'", "#", "../stands/large-reserves.yaml", None]
    scenes = [str(PROFILES / f"scenes/{name}.yaml") for name in ("paper-site", "road-below")] + ["/", "", "nothing", None]
    encode = lambda text: None if text is None else text.encode("latin-1")
    outcomes = set()
    for _ in range(100000 if FULL and SANITIZED else 3000):
        h, kind = draw.choice(handles), draw.randrange(20)
        if kind == 0:
            opened = C.ceduo_open(encode(draw.choice(scenes)))
            handles = (handles + [opened])[-6:]
            outcome = opened > 0
        elif kind == 1:
            outcome = C.ceduo_close(h) == 0
        elif kind < 5:
            outcome = C.ceduo_simulate(h, draw.choice([1, 3, 1 << 63]), draw.choice([0, 1, 2])) == 0
        elif kind < 9:
            outcome = C.ceduo_set(h, encode(draw.choice(paths)), encode(draw.choice(texts))) == 0
        elif kind < 12:
            outcome = C.ceduo_samples(h, draw.randrange(-3, 4), draw.choice([0, 1, 1 << 62]),
                                      encode(draw.choice(["energy_kJ", "stop_x_m", "weight", "", None])), many, draw.randrange(50)) >= 0
        else:
            outcome = C.ceduo_get(h, encode(draw.choice(paths)), value) == 0
        outcomes.add((min(kind, 12), outcome))
    expect(len(outcomes) >= 12, "each kind of call fails and succeeds", outcomes)
    for h in handles:
        C.ceduo_close(h)


if __name__ == "__main__":
    run_all(__name__)
