#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: brief
"""--help, the lists, --check, and wrong usage."""
import copy
import json
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import (INPUT, PROFILES, USAGE, Folder, Suite, ceduo, expect, expect_equal, expect_in, expect_near, good, result, validator,
                     scene, stand, list_tests)
from runs import PAPER


def test_help():
    """--help names every option within 80 columns; --version is one line"""
    text = good("--help").out
    for word in ("-b, --batch", "-f, --format", "-o, --output", "-s, --set", "-n, --rocks", "-e, --tolerance", "--rows",
                 "--seed", "-j, --threads", "--option", "--check", "--list-parameters", "--list-profiles", "-q, --quiet",
                 "--help", "--version"):
        expect_in(word, text, "help")
    expect(all(len(line) <= 100 for line in text.splitlines()), text)
    version = good("--version").out
    expect(re.fullmatch(r"ceduo \d+\.\d+\.\d+\n", version), version)
    expect_equal(result(PAPER, "-n", 1)["version"], version.split()[1])
    expect_equal(good("--batch", "--help", "nothing.yaml").out, text, "--help wins")


def test_list_parameters():
    """--list-parameters has path, type, unit, range, default and meaning of every key of the shipped scenes"""
    lines = good("--list-parameters").out.splitlines()
    expect_equal(lines[0].split(), ["path", "type", "unit", "range", "default", "meaning"])
    table = {line.split()[0]: line for line in lines[1:] if line}
    for path, words in (("rock.diameter_m", "m"), ("release.vx_m_s", "m/s 0"), ("slope.segments[].friction", "0.5"),
                        ("slope.vertices_m", "m"), ("controls[].accepted_kJ", "kJ"), ("forest[].stand.stools.per_ha", "1/ha"),
                        ("forest[].stand.trees[].dbh_m", "m"), ("forest[].stand.energy.u_J_m3", "J/m3"),
                        ("options[].name", "text"), ("simulation.threshold_m", "m 30"), ("simulation.rocks", "count"),
                        ("simulation.contact_model", "index|stems stems"), ("simulation.scale_rn", "false"),
                        ("simulation.law", "lumped|crsp|arm"), ("simulation.gravity_m_s2", "9.81")):
        expect(path in table, f"{path} is missing")
        for word in words.split():
            expect_in(word, table[path].split(), path)


def test_list_columns():
    """--list-columns has the columns of CSV, in order, each with type and meaning"""
    for words in ((), ("--rows", "stands"), ("--years", "0:1")):
        head = good("-b", "-f", "csv", "-n", 1, *words, PAPER).out.split("\n")[0].split(",")
        rows = [re.split("  +", line) for line in good("--list-columns", *(words[:1] if "--years" in words else words)).out.splitlines()]
        expect_equal(rows[0], ["column", "type", "unit", "empty if", "meaning"])
        expect_equal([row[0] for row in rows[1:]], ["status", "reason", "run", *head], "the first three are of --each")
        for row in rows[1:]:
            expect(row[1] in ("number", "integer", "boolean", "string") and row[-1], row)


def test_schema():
    """--schema: a JSON Schema of each output, which accepts answers and refuses a wrong one; --each extends it"""
    for name in ("result", "find", "sensitivity", "calibration", "failed"):
        schema = json.loads(good("--schema", name).out)
        validator().check_schema(schema)
        expect_equal((schema["$schema"], schema["$id"]), ("https://json-schema.org/draft/2020-12/schema", f"urn:ceduo-{name}-1"))
    answer, checked = result(PAPER, "-n", 5), validator()(json.loads(good("--schema", "result").out))
    expect(checked.is_valid(answer), list(checked.iter_errors(answer)))
    for path, value in ((("title",), 5), (("rocks",), 5.5), (("options", 0, "controls", 0, "x_m"), None),
                        (("options", 0, "controls", 0, "bare", "energy_kJ", "mean"), "much"), (("warnings",), "none"),
                        (("options", 0, "controls", 0, "lights"), None), (("rock", "mass_kg"), ...)):
        wrong = copy.deepcopy(answer)
        at = wrong
        for step in path[:-1]:
            at = at[step]
        if value is ...:
            del at[path[-1]]
        else:
            at[path[-1]] = value
        expect(not checked.is_valid(wrong), f"{path}: {value} is taken")
    expect_equal(ceduo("--schema", "results").status, USAGE)


GROWTH = {which: {"dbh_most_m": 0.5, "dbh_rate_1_y": 0.05, "height_most_m": 20, "height_rate_1_y": 0.05}
          for which in ("shoots", "trees")}


ACT = {"article": "a", "year": 2000}


def test_bounds_are_listed():
    """Values beyond the bounds of --list-parameters are refused with these bounds, and there are no other bounds"""
    mapping = scene(forest=[{"from_m": 10, "to_m": 20, "stand": stand(
        growth={**GROWTH, "shoots_young": 3, "shoots_old": 2}, cutting={"rotation_years": 20})}], minimum={"reserves_per_ha": 1},
        rules={"name": "r", "standards": [{"per_ha": 1, "most_per_ha": 9, **ACT}], "turns": [{"least_y": 1, "most_y": 9, **ACT}]})
    lines = [re.split("  +", line) for line in good("--list-parameters").out.split("\n\n")[0].splitlines()[1:]]
    forms = {"number": "{}", "number~": "{}", "count": "{:.0f}", "numbers": "[{}]", "points": "[[{0}, 0], [1, {0}]]",
             "3 numbers~": "[{0}, {0}, {0}]"}
    seen = 0
    with Folder() as f:
        path = f.write("s.yaml", mapping)
        materials = f.write("m.yaml", scene(slope={"vertices_m": [[0, 64], [100, 0]],
                                                   "materials": [{"from_m": 0, "to_m": 100, "material": "talus"}]}))
        sized = f.write("b.yaml", scene(blocks=[{"per_year": 1, "volume_m3": [0.1, 1]}]))
        releases = f.write("r.yaml", scene(release=[{"share": 1}]))
        places = f.write("p.yaml", {key: value for key, value in mapping.items() if key != "controls"} | {"controls_m": [50]})
        for name, kind, unit, text, *_ in lines:
            # bounds of a range equal those of its value; test_observed.py tests observations
            if kind not in forms or "uncertainty[]" in name or name.startswith("observed[]"):
                continue
            seen += 1
            shown = re.fullmatch(r"(>?)(\S*)\u2026(<?)(\S*)", text) or re.fullmatch(r"(>=?) (\S+)", text)
            lo = float(shown[2]) if shown and shown[2] else None
            hi = float(shown[4]) if shown and len(shown.groups()) == 4 else None
            for bound, sign, words in ((lo, -1, "is below|is not above"), (hi, 1, "is above|is not below")):
                for value in (sign * 1e17,) if bound is None else (bound + sign * max(abs(bound) * 1e-3, 1), sign * 1e17):
                    change = name.replace("[]", "[0]") + "=" + forms[kind].format(value)
                    done = ceduo("--check", "-s", change, materials if "materials" in name else sized if "blocks" in name else
                                 releases if name.startswith("release[]") else places if name.startswith("controls_m") else path)
                    found = re.search(rf"({words}) ([-+.0-9e]+)(?: (\S+))?$", done.err, re.M)
                    expect(bool(found) == (bound is not None), f"{change}; shown: {text}", done)
                    if found:
                        expect_near(float(found[2]), bound, abs(bound) * 1e-4, change)  # 1.5708 for half of pi
                        expect_equal((found[3] or "-", done.status), (unit, USAGE), change)
    expect(seen > 50, f"{seen} parameters that are numbers")


def test_list_profiles():
    """--list-profiles has name, kind, title and file; a user's own come from the XDG data folder and run by name"""
    text = good("--list-profiles").out
    expect_equal(text.split("\n")[0].split(), ["name", "kind", "title", "file"])
    for name, kind, title in (("paper-site", "scene", "Test site of Ciabocco et al. 2009"), ("ads-1", "stand", "ADS 1"),
                              ("paper", "slope", "Slope of Ciabocco et al. 2009"), ("four-systems", "scene", "Four systems"),
                              ("ads-2", "stand", "ADS 2"), ("bare", "stand", "bare")):
        expect(re.search(rf"(?m)^{name} +{kind} +{title}.* /\S*/{name}\.yaml$", text), f"{name} is missing", text)
    expect_equal(len(text.splitlines()) - 1, len([p for p in PROFILES.rglob("*.yaml") if p.parent.name not in ("region", "slurm")]), "rows")
    with Folder() as f:
        f.write("ceduo/scenes/mine.yaml", scene(title="my \x07 own"))
        f.write("ceduo/scenes/broken.yaml", "{")
        f.write("ceduo/stands/ads-1.yaml", stand(ceduo="stand/1", name="other"))
        env = {"XDG_DATA_HOME": str(f.path)}
        expect_in("mine.yaml", good("--list-profiles", env=env).out, "own profile")
        expect_equal(result("mine", "-n", 1, env=env, cwd="/")["title"], "my \x07 own")
        done = ceduo("--batch", "mien", env=env, cwd="/")
        expect(done.status == INPUT and re.search(
            rf"did you mean 'mine'\? \(searched here and in {f.path}/ceduo/scenes, .*{PROFILES.name}/scenes", done.err), done)
    expect_equal(result("paper-site", cwd="/")["title"], "Test site of Ciabocco et al. 2009")
    expect_equal(result("paper-site.yaml", cwd="/")["title"], "Test site of Ciabocco et al. 2009")


def test_check_good():
    """--check of the shipped scenes prints only one line per table, status 0"""
    for path in sorted((PROFILES / "scenes").glob("*.yaml")):
        lines = good("--check", path).out.splitlines()
        expect_equal([line for line in lines if not re.match(r"(quarry-stops|tschamut-2014|tschamut-2014-profile)\.csv: [0-9]+ (values|points)", line)], [])
        expect_equal(len(lines), {"quarry": 1, "tschamut": 4, "tschamut-arm": 4}.get(path.stem, 0), path.stem)
        expect_equal(good("--check", "-q", path).out, "")


BAD_USAGE = [
    (), ("--batch",), ("--check",), ("--nope",), ("--batch", "--nope", PAPER), ("-z", PAPER), ("--batch", "-n"),
    ("--batch", "-n", "0", PAPER), ("--batch", "-n", "-5", PAPER), ("--batch", "-n", "1.5", PAPER),
    ("--batch", "-n", "10000001", PAPER), ("--batch", "-n", "x", PAPER), ("--batch", "-n", "", PAPER),
    ("--batch", "-n", "5 ", PAPER), ("--batch", "-n", "0x10", PAPER), ("--batch", "-n", "1e999", PAPER),
    ("--batch", "-f", "xml", PAPER), ("--batch", "-f", "", PAPER), ("--batch", "--rows", "trees", PAPER),
    ("--batch", "--seed", "-1", PAPER), ("--batch", "--seed", "1.5", PAPER), ("--batch", "--seed", "9007199254740994", PAPER),
    ("--batch", "--seed", "nan", PAPER), ("--batch", "-j", "0", PAPER), ("--batch", "-j", "99999", PAPER),
    ("--batch", "-j", "two", PAPER), ("--batch", "-e", "0", PAPER), ("--batch", "-e", "-0.1", PAPER),
    ("--batch", "-e", "1.5", PAPER), ("--batch", "-e", "x", PAPER), ("--batch", "-e", "nan", PAPER),
    ("--batch", "-e", "0,1", PAPER), ("--batch", "-", "-"), ("--list-profiles", PAPER), ("--list-parameters", "x"),
    ("--batch=yes", PAPER), ("--format",), ("--batch", "--\x1b[31m", PAPER), ("--batch", "-n", "\x1b[31m", PAPER),
]


def bad_usage(*arguments):
    done = ceduo(*arguments)
    expect(done.status == USAGE and done.out == "", done)
    lines = done.err.splitlines()
    expect(1 <= len(lines) <= 2 and "try 'ceduo --help'" in lines[-1] and lines[0].startswith("ceduo: "), done)


def test_no_terminal():
    """Without --batch and without a terminal: status 2 and --batch named"""
    for arguments in ((), (PAPER,)):
        done = ceduo(*arguments)
        expect(done.status == USAGE and "--batch" in done.err, done)


def main():
    suite = Suite()
    suite.run(list_tests(sys.modules[__name__]))
    for arguments in BAD_USAGE:
        shown = " ".join(ascii(str(a))[1:-1] if a != PAPER else a.name for a in arguments)
        suite.check(f"ceduo {shown}: status 2, one line and where the help is", bad_usage, *arguments)
    suite.end()


if __name__ == "__main__":
    main()
