#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""--shard and --merge: joined parts are one run, byte for byte, on a machine that has none of the files; what is missing,
doubled, foreign or changed is named and nothing printed."""
import functools
import json
import random
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import (CEDUO, DONE, INPUT, OUTPUT, ROOT, USAGE, Failure, Folder, Suite, belt, ceduo, environment,  # noqa: E402
                     expect, expect_equal, expect_in, good, stand, tests_of, wooded_scene)

FORMATS = (("-f", "table"), ("-f", "csv"), ("-f", "json"), ("-f", "csv", "--rows", "stands"))
MASK = (1 << 64) - 1


def parts_of(folder, shards, *arguments, cwd=ROOT):
    """Paths of the parts, one file a shard; the threads differ."""
    paths = []
    for i in range(1, shards + 1):
        path = folder.path / f"part-{i}-{shards}.jsonl"
        good("--shard", f"{i}/{shards}", "-j", 1 + i % 3, "-o", path, *arguments, cwd=cwd)
        paths.append(path)
    return paths


def without_seconds(out):
    """JSON but for the one figure that is a sum of others."""
    return re.sub(r'"seconds": [0-9.e-]+', '"seconds": 0', out)


def expect_one_run(paths, wanted, *arguments, **options):
    """What --merge prints is what one run printed."""
    found = good("--merge", *arguments, *paths, **options).out
    expect(without_seconds(found) == without_seconds(wanted), f"{arguments}: found", found, "wanted", wanted)


def one_run(form, *arguments, **options):
    return good("--batch", *form, *arguments, **options).out


def expect_refused(result, *words):
    """Status 3, a place and a reason for each word, nothing printed."""
    expect_equal(result.status, INPUT, str(result))
    expect_equal(result.out, "", "stdout")
    for word in words:
        expect(re.search(word, result.err), f"no {word!r} in", result.err)


# ---- one run ----

def check_scene(shards, *arguments):
    with Folder() as f:
        wanted = {form: one_run(form, *arguments) for form in FORMATS}
        for n in shards:
            paths = parts_of(f, n, *arguments)
            random.Random(n).shuffle(paths)
            for form in FORMATS if n == shards[-1] else FORMATS[2:3]:  # the JSON has every figure; a page takes longer
                expect_one_run(paths, wanted[form], *form)


def test_paper_site():
    """The paper's site in 1, 2, 3, 7 and more parts than blocks is one run"""
    check_scene((1, 2, 3, 7, 9), "-n", 5500, "paper-site")


def test_four_systems():
    """Options side by side, their differences too"""
    check_scene((3,), "-n", 2100, "four-systems")


def test_options():
    """Two of the options, in their order"""
    check_scene((3,), "-n", 2100, "--option", "selection coppice", "--option", "large reserves", "four-systems")


def test_models():
    """The contact models index and poisson, the law crsp, another seed"""
    check_scene((2, 7), "-n", 5500, "-s", "simulation.contact_model=index", "paper-site")
    check_scene((3,), "-n", 3333, "-s", "simulation.contact_model=poisson", "paper-site")
    check_scene((3,), "-n", 3333, "-s", "simulation.law=crsp", "--seed", 7, "paper-site")


def test_small():
    """Fewer rocks than a block, just a block, and one more"""
    for rocks in (1, 10, 1024, 1025):
        check_scene((1, 3), "-n", rocks, "paper-site")


def test_several_scenes():
    """Several scenes come in the order in which they were given, whatever that of the parts"""
    with Folder() as f:
        scenes = ("-n", 2500, "terrace", "paper-site", "terrace", "road-below")
        paths = parts_of(f, 3, *scenes)
        for seed, form in enumerate(FORMATS):
            random.Random(seed).shuffle(paths)
            expect_one_run(paths, one_run(form, *scenes), *form)
        lines = "".join(p.read_text() for p in paths).splitlines(keepends=True)
        expect_equal(len(lines), 12, "lines")
        random.Random(5).shuffle(lines)
        all_in_one = f.write("all.jsonl", "".join(lines))
        wanted = one_run(("-f", "json"), *scenes)
        expect_one_run([all_in_one], wanted, "-f", "json")
        expect_one_run(["-"], wanted, "-f", "json", stdin=all_in_one.read_bytes())
        half = f.write("half.jsonl", "".join(lines[:6]))
        expect_one_run(["-", half], wanted, "-f", "json", stdin="".join(lines[6:]).encode())


def test_output_file():
    """-o takes the page of --merge, and the part of --shard; a full disk is told"""
    with Folder() as f:
        paths = parts_of(f, 2, "-n", 2000, "paper-site")
        good("--merge", "-o", f.path / "page.txt", *paths)
        expect_equal((f.path / "page.txt").read_text(), one_run((), "-n", 2000, "paper-site"), "page")
        to_stdout = good("--shard", "2/2", "-n", 2000, "paper-site").out
        expect(to_stdout[:40] == '{"format": "ceduo-part-1", "version": "0', to_stdout[:80])
        expect_equal([line["shard"] for line in map(json.loads, to_stdout.splitlines())], [2], "shard")
        for arguments in (("--shard", "1/2", "-n", 2000, "paper-site"), ("--merge", *paths)):
            result = ceduo(*arguments, "-o", "/dev/full")
            expect_equal(result.status, OUTPUT, str(result))
            expect_in("/dev/full", result.err)


def test_elsewhere():
    """Parts are joined where neither the scene nor the files are that it refers to"""
    with Folder() as f, Folder() as g:
        own = stand(name="own", source={"kind": "assumed", "text": "by eye"})
        g.write("in/stands/own.yaml", {"ceduo": "stand/1", **own})
        g.write("in/stands/changed.yaml", {"ceduo": "stand/1", "base": "own.yaml", "name": "changed"})
        # a CSV may be of any encoding
        g.write("in/profile.csv", "distance,elevation,caf\xe9\n0,90\n100,10\n160,0\n".encode("latin-1"))
        scene = wooded_scene(title=None, slope={"csv": "profile.csv"}, forest=[
            {"from_m": 10, "to_m": 50, "stand": "stands/changed.yaml"}, belt(50, 95, name='quoted "\u00e9"')])
        g.write("in/scene one.yaml", scene)
        arguments = ("-n", 2500, "-s", "forest[1].stand=simple-coppice", "-s", "simulation.seed=5", "scene one.yaml")
        paths = parts_of(f, 3, *arguments, cwd=g.path / "in")
        wanted = {form: one_run(form, *arguments, cwd=g.path / "in") for form in FORMATS}
        expect_in("*", wanted[FORMATS[0]], "assumptions")
        shutil.rmtree(g.path / "in")
        for form in FORMATS:
            expect_one_run(paths, wanted[form], *form, cwd="/")


def test_standard_input():
    """A scene from standard input, in parts"""
    with Folder() as f:
        text = json.dumps(wooded_scene()).encode()
        paths = []
        for i in (1, 2):
            paths.append(f.write(f"{i}.jsonl", good("--shard", f"{i}/2", "-", stdin=text).out_bytes))
        expect_one_run(paths, one_run(("-f", "json"), "-", stdin=text), "-f", "json")


def test_other_folders():
    """The same scene in other folders, as on other machines: one run, by the first part's path"""
    with Folder() as f:
        paths = []
        for i, folder in enumerate(("x", "y", "z"), 1):
            path = f.write(f"{folder}/site.yaml", wooded_scene())
            paths.append(f.write(f"{i}.jsonl", good("--shard", f"{i}/3", path).out_bytes))
        expect_one_run(paths[::-1], one_run(("-f", "json"), f.path / "x/site.yaml"), "-f", "json")


def test_it_can_tell():
    """Another seed, a rock more or another order of sums would be seen"""
    with Folder() as f:
        paths = parts_of(f, 2, "-n", 2000, "paper-site")
        for other in (("-n", 2000, "--seed", 2), ("-n", 2001)):
            try:
                expect_one_run(paths, one_run(("-f", "json"), *other, "paper-site"), "-f", "json")
            except Failure:
                continue
            raise Failure(f"{other} makes no difference")


# ---- what is refused ----

@functools.cache
def lines_of(shards, *arguments):
    """The lines of the parts of a scene."""
    with Folder() as f:
        return tuple(p.read_bytes() for p in parts_of(f, shards, *arguments))


def merge_of(folder, *contents):
    """--merge of files 1, 2, … with these contents."""
    paths = [folder.write(f"{i}.jsonl", content) for i, content in enumerate(contents, 1)]
    return ceduo("--merge", "-f", "csv", *paths)


def parts():
    return lines_of(4, "-n", "4500", "paper-site")


def test_missing():
    """Missing parts are named"""
    with Folder() as f:
        a, b, c, d = parts()
        expect_refused(merge_of(f, a, b, d), r"1\.jsonl:1: 'paper-site' has 4 shards; these are missing: 3\n")
        expect_refused(merge_of(f, d), r"missing: 1-3\n")
        expect_refused(merge_of(f, b + d), r"missing: 1, 3\n")
        expect_refused(merge_of(f, a, b, c), r"missing: 4\n")


def test_doubled():
    """Doubled parts are named, with both places"""
    with Folder() as f:
        a, b, c, d = parts()
        expect_refused(merge_of(f, a, b + c, d + c), r"[23]\.jsonl:2: shard 3 of 4 of 'paper-site' is given twice; it is also in .*/[23]\.jsonl:2")


def test_foreign():
    """Parts of another scene of that name, or of another number of parts, are named"""
    with Folder() as f:
        a, b, c, d = parts()
        other = lines_of(4, "-n", "4500", "-s", "rock.diameter_m=1", "paper-site")[2]
        expect_refused(merge_of(f, a, b, other, d), r"3\.jsonl:1: shard 3 of 4 of another 'paper-site' than", r"missing: 3")
        more = lines_of(4, "-n", "4501", "paper-site")[2]
        expect_refused(merge_of(f, a, b, c, d, more), r"5\.jsonl:1: shard 3 of 4 of another")
        thirds = lines_of(3, "-n", "4500", "paper-site")[1]
        expect_refused(merge_of(f, a, b, thirds, c, d), r"3\.jsonl:1: shard 2 of 3 of 'paper-site', of which .*1\.jsonl:1 is one of 4")
        seconds = lines_of(4, "-n", "4500", "--seed", "3", "paper-site")
        expect_refused(merge_of(f, a, b, c, d, *seconds), r"shard 1 of 4 of another 'paper-site'")


def test_no_parts():
    """What is not a part is named: a scene, a result, an empty line, nothing at all, no file"""
    with Folder() as f:
        a, b, c, d = parts()
        page = good("--batch", "-f", "json", "-n", 10, "paper-site").out_bytes
        for wrong in (page, b"ceduo: scene/1\n", b"\n", b"\xff\x00\x01\n" * 100, b"{}\n", b"[" * 100000):
            expect_refused(merge_of(f, a + wrong, b, c, d), r"1\.jsonl:2: not a part written by --shard\n")
        expect_refused(merge_of(f, a, b, c, d, b""), r"5\.jsonl: contains no part\n")
        expect_refused(ceduo("--merge", f.path / "none"), r"none: cannot read it: No such file")
        expect_refused(ceduo("--merge", f.path), r"cannot read it: Is a directory")
        expect_refused(merge_of(f, a.replace(b"ceduo-part-1", b"ceduo-part-2"), b, c, d), r"1\.jsonl:1: the part has a format")


def test_cut():
    """A part that is cut short anywhere is named"""
    with Folder() as f:
        a, b, c, d = parts()
        for n in [1, 10, 25, 26, 40, len(c) // 2, len(c) - 30, len(c) - 3, len(c) - 2]:
            expect_refused(merge_of(f, a, b, c[:n], d), r"3\.jsonl:1: the part (is incomplete|was changed)")
        expect_equal(merge_of(f, a, b, c[:-1], d).status, DONE, "without the end of its line")


def test_edited():
    """A part of which one character was changed is named"""
    with Folder() as f:
        a, b, c, d = parts()
        rng = random.Random(1)
        for at in [45, 60, 90, 150] + [rng.randrange(200, len(b) - 3) for _ in range(30)]:
            changed = b[:at] + (b"A" if b[at:at + 1] != b"A" else b"B") + b[at + 1:]
            expect_refused(merge_of(f, a, changed, c, d), r"2\.jsonl:1: the part (was changed|is incomplete|is from version)")
        expect_refused(merge_of(f, a, json.dumps(json.loads(b)).encode()[:-1] + b" }\n", c, d), r"2\.jsonl:1")


def sum_of(data):
    total = 14695981039346656037 ^ len(data)
    for i in range(0, len(data), 8):
        total = ((total ^ int.from_bytes(data[i:i + 8], "little")) * 0x9e3779b97f4a7c15) & MASK
        total ^= total >> 32
    return total


def forged(line, **changes):
    """A part with other values and the sum that belongs to them."""
    values = {**json.loads(line), **changes}
    del values["sum"]
    head = json.dumps(values, ensure_ascii=False).encode()[:-1]
    return head + b', "sum": "%016x"}\n' % sum_of(head)


def test_forged():
    """A part whose sum is right and whose content is not does no harm"""
    with Folder() as f:
        a, b, c, d = parts()
        expect_equal(forged(b), b, "a part written anew")
        values = json.loads(b)
        runs = values["runs"]
        for changes in ({"shard": 3}, {"runs": ""}, {"runs": runs[:400]}, {"runs": runs[:-8]}, {"runs": runs + "AAAA"},
                        {"runs": "=" + runs[1:]}, {"runs": "////" * 100}, {"runs": json.loads(c)["runs"]}, {"shards": 0},
                        {"rocks": 10**9}, {"hash": "0" * 16}, {"place": 10**12}, {"seconds": -1}, {"seconds": "1e999"}):
            expect_refused(merge_of(f, a, forged(b, **changes), c, d), r"[1-4]\.jsonl:1")
        inputs = json.loads(a)["inputs"]
        for changes in ({"inputs": ""}, {"inputs": inputs[:40]}, {"inputs": "A" * 400}, {"inputs": "/" * 400},
                        {"inputs": inputs[:-400] + "A" * 400}, {"runs": runs}):
            expect_refused(merge_of(f, forged(a, **changes), b, c, d), "")
        rng = random.Random(2)
        for _ in range(60):
            field = rng.choice(("runs", "inputs"))
            text = list(json.loads(a)[field])
            for _ in range(rng.randrange(1, 4)):
                text[rng.randrange(min(len(text), rng.choice((200, 2000, 10**9))))] = rng.choice("A/+0z")
            result = merge_of(f, forged(a, **{field: "".join(text)}), b, c, d)
            expect(result.status in (DONE, INPUT), result)
            expect(result.status == DONE or result.out == "", result)


def test_version():
    """Parts of another version are named"""
    with Folder() as f:
        a, b, c, d = parts()
        expect_refused(merge_of(f, a, forged(b, version="9.9.9"), c, d), r"2\.jsonl:1: the part is from version 9\.9\.9, but this is \d")


def test_nothing_half_printed():
    """Where the second scene lacks a part, the first is not printed either, and no file is made"""
    with Folder() as f:
        paths = parts_of(f, 2, "-n", 1500, "paper-site", "terrace")
        lines = paths[1].read_bytes().splitlines(keepends=True)
        paths[1].write_bytes(lines[0])
        result = ceduo("--merge", "-o", f.path / "out.csv", "-f", "csv", *paths)
        expect_refused(result, r"'terrace' has 2 shards; these are missing: 2")
        expect(not (f.path / "out.csv").exists(), f.names())


def test_interrupted():
    """Interrupted, --shard writes nothing and ends by the signal"""
    with Folder() as f:
        path = f.path / "part.jsonl"
        process = subprocess.Popen([CEDUO, "--shard", "1/2", "-n", "1e7", "-o", str(path), "four-systems"], cwd=ROOT,
                                   env=environment(), stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        out, err = process.communicate(timeout=20)
        expect_equal((process.returncode, out, err), (-signal.SIGINT, b"", b""), "ended")
        expect_equal(f.names(), [], "files left")


# ---- the command line ----

def test_usage():
    """Options that do not go together are refused with a sentence"""
    for wrong in ("0/3", "4/3", "1", "1/", "/2", "a/b", "1/2/3", "-1/2", "1/0", "1/100001", "1.5/2"):
        result = ceduo("--shard", wrong, "paper-site")
        expect(result.status == USAGE and f"'{wrong}' is not a part" in result.err, result)
    for others in (("-f", "json"), ("--format", "table"), ("-e", "0.1"), ("--years", "0:3"), ("--rows", "controls"),
                   ("--plot", "energy"), ("--check",), ("--script", "x"), ("--find", "a=1:2", "--goal", "adc"), ("--merge",)):
        for arguments in ((*others, "--shard", "1/2"), ("--shard", "1/2", *others)):
            result = ceduo(*arguments, "paper-site")
            expect(result.status == USAGE and "cannot be used with" in result.err and result.out == "", result)
    for others in (("-n", 5), ("--seed", 5), ("-s", "rock.diameter_m=1"), ("--option", "x"), ("-e", "0.1"), ("--years", "0:3"),
                   ("--plot", "energy"), ("--check",), ("--script", "x"), ("--find", "a=1:2", "--goal", "adc")):
        for arguments in ((*others, "--merge"), ("--merge", *others)):
            result = ceduo(*arguments, "part.jsonl")
            expect(result.status == USAGE and "cannot be used with" in result.err and result.out == "", result)
    result = ceduo("--merge")
    expect(result.status == USAGE and "--merge needs files" in result.err, result)
    result = ceduo("--shard", "1/2")
    expect(result.status == USAGE and "no scene" in result.err, result)
    result = ceduo("--merge", "-", "-")
    expect(result.status == USAGE, result)


def test_bad_scene():
    """Of several scenes a bad one is reported and the others written; joined they keep their order"""
    with Folder() as f:
        bad = f.write("bad.yaml", "ceduo: scene/1\n")
        paths = []
        for i in (1, 2):
            result = ceduo("--shard", f"{i}/2", "-n", 1500, "paper-site", bad, "terrace")
            expect_equal(result.status, INPUT, str(result))
            expect_in("bad.yaml", result.err)
            paths.append(f.write(f"{i}.jsonl", result.out_bytes))
        expect_one_run(paths, one_run(("-f", "json"), "-n", 1500, "paper-site", "terrace"), "-f", "json")


if __name__ == "__main__":
    suite = Suite()
    suite.run(tests_of(sys.modules[__name__]))
    suite.end()
