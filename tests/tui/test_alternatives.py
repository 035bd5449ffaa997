#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: slow
"""Forms of the terminal program with exclusive values: the rock's shape and sizes, mass or density, roughness."""
import re
import sys
from math import pi
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import FAST, Place, check_good  # noqa: E402
from harness import ceduo, expect, expect_equal, expect_in, expect_near, run_all  # noqa: E402

SHAPES = ["sphere", "cylinder", "ellipsoid", "block"]


def scene_with(rock):
    return FAST.replace("{shape: sphere, diameter_m: 0.5}", rock)


def edited(rock, keys):
    """Return the screens before, after and after undo, the message, and the rock's line of the saved scene."""
    with Place() as place:
        place.write("rock.yaml", scene_with(rock))
        before, said, after, undone = place.play(f"key 3\nwait idle\ndump\n{keys}\ndump\nwait idle\nkey s\ndump\n"
                                                 "key g u\nclear\nwait idle\ndump", "rock.yaml")
        check_good(place.path, "rock.yaml")
        return before, after, undone, said.note, re.search(r"^rock: (.*)$", place.text("rock.yaml"), re.M).group(1)


def said_by(rock, keys):
    """Return the message after the keys."""
    with Place() as place:
        place.write("rock.yaml", scene_with(rock))
        return place.play(f"key 3\nwait idle\n{keys}\ndump", "rock.yaml")[0]


def choose(shape):
    return "find rock.shape\nkey Enter Home " + " ".join(["Down"] * SHAPES.index(shape)) + " Enter"


def read_mass(screen):
    return float(re.search(r"Rock +\S+ m, +(\S+) kg", screen.now).group(1))


def test_every_shape():
    """From each shape to each other: its sizes are filled in with equal volume and mass, with a message, in one undo step."""
    rocks = {"sphere": "{shape: sphere, diameter_m: 0.8}", "cylinder": "{shape: cylinder, diameter_m: 0.56, height_m: 0.8}",
             "ellipsoid": "{shape: ellipsoid, axes_m: [0.5, 0.7, 0.9]}", "block": "{shape: block, axes_m: [0.5, 0.7, 0.9]}"}
    wanted = {"sphere": {"diameter_m"}, "cylinder": {"diameter_m", "height_m"}, "ellipsoid": {"axes_m"}, "block": {"axes_m"}}
    for old, rock in rocks.items():
        for new in SHAPES:
            if new == old:
                continue
            before, after, undone, said, line = edited(rock, choose(new))
            expect_equal(after.row("^shape")[-1], new, f"from {old}")
            expect_equal(set(re.findall(r"(\w+_\w+):", line)), wanted[new], f"{old} to {new}: sizes in {line}")
            expect_equal(undone.row("^shape")[-1], old, "after u")
            expect_equal(undone.now, before.now, f"figures after u, from {new} back to {old}")
            if {old, new} == {"ellipsoid", "block"}:
                continue  # equal sizes fit both
            expect_near(read_mass(after), read_mass(before), 0.02 * read_mass(before), f"{old} to {new}: mass")
            expect_in("set for the same volume: ", said, f"{old} to {new}")
            for name in wanted[new]:
                expect_in(name.split("_")[0], said, f"{old} to {new}")


def test_shape_figures():
    """The sphere of a cylinder's volume to three digits; from a sphere a cylinder as wide as high."""
    screen = said_by("{shape: cylinder, diameter_m: 0.56, height_m: 0.80}", choose("sphere"))
    diameter = (6 / pi * pi / 4 * 0.56**2 * 0.8) ** (1 / 3)
    expect_equal(screen.note, f"set for the same volume: diameter {diameter:.3g} m; removed: height")
    screen = said_by("{diameter_m: 0.8}", choose("cylinder"))
    side = (4 / pi * pi / 6 * 0.8**3) ** (1 / 3)
    expect_equal(screen.note, f"set for the same volume: diameter {side:.3g} m, height {side:.3g} m")


def test_shape_steps():
    """+ on the shape does the same."""
    with Place() as place:
        screens = place.play("key 3\nfind rock.shape\n" + "key +\ndump\n" * 4)
    expect_equal([s.row("^shape")[-1] for s in screens], ["cylinder", "ellipsoid", "block", "sphere"], "shapes")
    expect_near(float(screens[3].row("^diameter")[-1]), 0.5 * (6 / pi) ** (1 / 3), 0.005,
                "the ellipsoid's axes served the block: the sphere has the block's volume")


def test_shape_mass():
    """A mass stays the rock's mass in another shape."""
    before, after, _, _, line = edited("{shape: cylinder, diameter_m: 0.5, height_m: 0.5, mass_kg: 300}", choose("sphere"))
    expect("mass_kg" not in line and "density_kg_m3: 3056" in line, line)
    expect_near(read_mass(after), read_mass(before), 3, "mass")
    before, after, _, _, line = edited("{mass_kg: 300, density_kg_m3: 2500}", choose("block"))
    expect("mass_kg: 300" in line and "density" not in line and "axes_m: [0.493, 0.493, 0.493]" in line, line)
    screen = said_by("{diameter_m: {mean: 0.8, spread: 0.1}}", choose("cylinder"))
    expect_in("without spread", screen.note)


def test_sphere_sizes():
    """A sphere's diameter, volume or mass: the typed one replaces the others, with a message, in one step."""
    for rock, name, value in (("{shape: sphere, diameter_m: 0.8}", "volume_m3", "0.5"),
                              ("{shape: sphere, diameter_m: 0.8}", "mass_kg", "300"),
                              ("{volume_m3: 0.5}", "diameter_m", "0.7"), ("{mass_kg: 300}", "volume_m3", "0.2")):
        old = re.search(r"(\w+_\w+):", rock).group(1)
        keys = f"find rock.{name}\nset {value}"
        before, after, undone, said, line = edited(rock, keys)
        expect_equal(said, "removed: " + old.split("_")[0], "what is said")
        expect(f"{name}: {value}" in line and old not in line, line)
        expect(after.now != before.now, "the figures are still those of before", after)
        expect_equal(undone.now, before.now, "figures after u")


def test_sphere_refused():
    """A refused size keeps the other one."""
    with Place() as place:
        refused, after = place.play("key 3\nfind rock.volume_m3\nset -1\ndump\nkey Esc\nclear\ndump")
    expect_in("-1 is below 0 m³", refused.note)
    expect_equal(after.row("^diameter")[-1], "0.5", "diameter")
    expect("* fast" not in after.title, after.title)


def test_mass_or_density():
    """For other shapes the mass replaces the density, and the density the mass."""
    rock = "{shape: cylinder, diameter_m: 0.5, height_m: 0.5, density_kg_m3: 2600}"
    keys = "find rock.mass_kg\nset 300"
    _, after, undone, said, line = edited(rock, keys)
    expect_equal(said, "removed: density", "what is said")
    expect("mass_kg: 300" in line and "density" not in line, line)
    expect_equal(read_mass(after), 300, "kg")
    expect_equal(undone.row("^density")[-1], "2600", "after u")
    _, _, _, _, line = edited(rock.replace("density_kg_m3: 2600", "mass_kg: 300"), "find rock.density_kg_m3\nset 2700")
    expect("density_kg_m3: 2700" in line and "mass" not in line, line)


def test_roughness():
    """A roughness in m replaces one in rad if the slope has both kinds."""
    with Place() as place:
        text = FAST.replace("rt: 0.98, roughness_rad: 0,", "rt: 0.98, roughness_m: 0,")
        place.write("mixed.yaml", text)
        screen = place.play("find segments[1].roughness_m\nset 0.1\ndump\nkey s", "mixed.yaml")[0]
        expect_equal(screen.note, "removed: roughness", "what is said")
        check_good(place.path, "mixed.yaml")
        expect("roughness_m: 0.1" in place.text("mixed.yaml") and "roughness_rad" not in place.text("mixed.yaml"),
               place.text("mixed.yaml"))


def test_command_line():
    """-s of a shape that does not fit the rock's sizes names a working remedy."""
    done = ceduo("--check", "-s", "rock.shape=sphere", "-s", "rock.diameter_m=1", "paper-site")
    found = re.search(r"-s '(rock=\{shape: sphere, .*?\})'", done.err)
    expect(done.status != 0 and found, done)
    expect_equal(ceduo("--check", "-s", found.group(1), "paper-site").status, 0, "status")
    with Place() as place:
        place.write("bad.yaml", scene_with("{shape: sphere, diameter_m: 1, height_m: 2}"))
        done = ceduo("--check", str(place.path / "bad.yaml"))
        expect("remove it" in done.err and "-s '" not in done.err, done)


if __name__ == "__main__":
    run_all(__name__)
