#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""--resume: a table of --each is stopped and continued. The result equals one run without --resume."""
import fcntl
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import (CEDUO, DONE, FULL, INPUT, OUTPUT, USAGE, Folder, ceduo, environment, expect, expect_equal, expect_in, run_all,
                     wooded_scene)

SCENE = wooded_scene(controls=[{"x_m": "end-60", "accepted_kJ": 20}, {"x_m": "end-50"}])
COLUMNS = "id,option,x_m,wooded.reach_probability"
WORDS = ["-f", "csv", "--columns", COLUMNS, "--each", "rows.csv"]


def profile(length):
    return f"distance,elevation\n0,{0.8 * length}\n{length},0\n"


def make_rows(numbers):
    return "id,slope,rock.diameter_m\n" + "".join(f"r{i},{100 + i % 3 * 10}.csv,{0.5 + i % 7 / 10:g}\n" for i in numbers)


def valley(f, rows):
    f.write("s.yaml", SCENE)
    for length in (100, 110, 120):
        f.write(f"{length}.csv", profile(length))
    f.write("rows.csv", rows)


def command(*words, rocks=60):
    return ["-b", "-q", "-n", str(rocks), *words, "s.yaml"]


def run(f, *words, rocks=60):
    return ceduo(*command(*words, rocks=rocks), cwd=f.path)


def in_one_go(f, *words, rocks=60):
    """Return the table of one run without --resume."""
    (f.path / "whole.csv").unlink(missing_ok=True)
    r = run(f, *(words or WORDS), "-o", "whole.csv", rocks=rocks)
    expect(r.status in (DONE, INPUT), str(r))
    return (f.path / "whole.csv").read_bytes()


def resume(f, *words, rocks=60):
    return run(f, *(words or WORDS), "-o", "part.csv", "--resume", rocks=rocks)


def expect_resumed(f, whole, status=DONE):
    r = resume(f)
    expect_equal((r.status, (f.path / "part.csv").read_bytes()), (status, whole), str(r))
    expect_equal([n for n in f.names() if "tmp" in n], [])
    return r


def read_parts(f):
    """Return the lines of the side file, one per finished row."""
    return (f.path / "part.csv.resume").read_text().splitlines()[7:]


def test_kills():
    """Killed at any moment, it continues; the table equals that of one run to the byte, and no finished row is repeated"""
    with Folder() as f:
        valley(f, make_rows(range(60)))
        whole = in_one_go(f)
        chance = random.Random(1)
        for _ in range(60 if FULL else 12):
            (f.path / "part.csv").unlink(missing_ok=True)
            for _ in range(5):
                with subprocess.Popen([CEDUO, *command(*WORDS, "-o", "part.csv", "--resume")], cwd=f.path, env=environment()) as p:
                    time.sleep(chance.random() * 0.03)
                    p.kill()
                done = len(read_parts(f)) if (f.path / "part.csv.resume").exists() else 0
                expect(p.returncode in (0, -signal.SIGKILL), p.returncode)
            cut = chance.choice((0, 0, 1, 5, 60, 300))  # bytes that never reached the disk
            for name in ("part.csv", "part.csv.resume"):
                if cut and (f.path / name).exists() and chance.random() < 0.5:
                    size = (f.path / name).stat().st_size
                    os.truncate(f.path / name, min(size, max(size - cut, 0 if name == "part.csv" else 117)))
            expect_resumed(f, whole)
            expect(len(read_parts(f)) == 60 >= done, "each row is known once", read_parts(f))
        r = expect_resumed(f, whole)
        expect_equal(r.err, "")


def test_nothing_twice():
    """Finished rows are not repeated: a second run of a slow table takes no time"""
    for rows in (make_rows(range(3)), "id,rock.diameter_m\na,0.5\nb,0.6\nc,0.7\n"):
        with Folder() as f:
            valley(f, rows)
            start = time.monotonic()
            expect_equal(resume(f, rocks=60000).status, DONE)
            long = time.monotonic() - start
            before = (f.path / "part.csv").read_bytes()
            start = time.monotonic()
            expect_equal(resume(f, rocks=60000).status, DONE)
            expect(time.monotonic() - start < long / 2, "it is computed again")
            expect_equal((f.path / "part.csv").read_bytes(), before)


def test_two_programs():
    """With two programs on one file the second is refused while the first writes; one table results"""
    with Folder() as f:
        valley(f, make_rows(range(40)))
        whole = in_one_go(f)
        for _ in range(5):
            (f.path / "part.csv").unlink(missing_ok=True)
            words = [CEDUO, *command(*WORDS, "-o", "part.csv", "--resume")]
            both = [subprocess.Popen(words, cwd=f.path, env=environment(), stderr=subprocess.PIPE, text=True) for _ in range(3)]
            ends = [(p.communicate()[1], p.returncode) for p in both]
            expect(any(status == DONE for _, status in ends), ends)
            for err, status in ends:
                expect(status == DONE or (status == OUTPUT and "another ceduo is writing to it" in err), ends)
            expect_equal((f.path / "part.csv").read_bytes(), whole)
            expect_equal(len(read_parts(f)), 40)
        with open(f.path / "part.csv", "rb") as held:
            fcntl.flock(held, fcntl.LOCK_EX)
            r = resume(f)
            expect_equal((r.status, (f.path / "part.csv").read_bytes()), (OUTPUT, whole), str(r))
            expect_in("part.csv: another ceduo is writing to it", r.err)


def test_changed_rows():
    """Rows with changed cells or files, new rows, and rows with broken lines are computed again, in the table's order"""
    with Folder() as f:
        valley(f, make_rows(range(8)))
        expect_equal(resume(f).status, DONE)
        first = in_one_go(f)
        for rows in (make_rows([0, 1, 2, 13, 4, 5, 6, 7]), make_rows([7, 6, 5, 4, 3, 2, 1, 0]), make_rows([9, 0, 1]), make_rows([3, 3, 3, 4]),
                     make_rows([]) + "r0,none.csv,1\nr1,110.csv,0.6\n", make_rows(range(8)).replace(".csv,0.5", ".csv,0.75")):
            f.write("rows.csv", rows)
            whole = in_one_go(f)
            expect_resumed(f, whole, INPUT if "none" in rows else DONE)
            expect_equal(len(read_parts(f)), rows.count("\n") - 1)
        f.write("rows.csv", make_rows(range(8)))
        expect_resumed(f, first)
        text = first.decode()
        lines = text.splitlines(keepends=True)
        for broken in (text.replace(lines[3], lines[3][:9] + "\n"), text.replace(lines[3], lines[3].replace(",", ",,", 1)),
                       text.replace(lines[3], ""), text.replace(lines[5], lines[5] * 2), text[:-1], text[:200], lines[0], lines[0][:9], "",
                       text.replace(lines[4], lines[4].replace("current", "cut")), text + "r99,current,1,1\n", text + "r99"):
            expect(broken != text, "nothing is broken")
            f.write("part.csv", broken)
            expect_resumed(f, first)
        f.write("110.csv", profile(115))
        changed = in_one_go(f)
        expect(changed != first, "the profile changes the table")
        expect_resumed(f, changed)
        side = (f.path / "part.csv.resume").read_text()
        for broken in (side[:-1], side[:-30], side[:200], side[:-59] + side[-59:].replace(" 0", " x", 1), side + "0", side + side[-59:]):
            f.write("part.csv.resume", broken)
            expect_resumed(f, changed)
            expect_equal({len(line) for line in read_parts(f)}, {58})
            side = (f.path / "part.csv.resume").read_text()
            expect_resumed(f, changed)
            expect_equal((f.path / "part.csv.resume").read_text(), side, "all is known")


def test_other_runs():
    """Another version, scene, seed, number of rocks, option or column is refused by name, and the file stays"""
    with Folder() as f:
        valley(f, make_rows(range(4)))
        whole = in_one_go(f)
        expect_resumed(f, whole)
        other = ["-f", "csv", "--columns", "x_m,id,option,wooded.reach_probability", "--each", "rows.csv"]
        for words, rocks, what in ((WORDS, 61, "rocks"), (other, 60, "columns"), ([*WORDS, "--seed", "7"], 60, "seed"),
                                   ([*WORDS, "-s", "release.vx_m_s=1"], 60, "scene"), (["-f", "csv", "--each", "rows.csv"], 60, "columns"),
                                   ([*WORDS, "--rows", "stands"], 60, None), ([*WORDS, "--option", "current"], 60, "options"),
                                   ([*WORDS, "-e", "0.5"], 61, "options, rocks"), ([*WORDS, "--years"], 60, None)):
            r = resume(f, *words, rocks=rocks)
            expect(r.status == OUTPUT if what else r.status in (OUTPUT, USAGE), r)
            expect_in(f"part.csv: it belongs to another run (different: {what}); " if what else "", r.err)
            expect_equal((f.path / "part.csv").read_bytes(), whole, words)
        side = (f.path / "part.csv.resume").read_text()
        for name, text, what in (("s.yaml", (f.path / "s.yaml").read_text() + "\n", "scene"),
                                 ("rows.csv", make_rows(range(4)).replace("id,", "name,"), None),
                                 ("rows.csv", make_rows(range(4)).replace("rock.diameter_m", "release.vx_m_s"), "columns"),
                                 ("part.csv.resume", side.replace("version ", "version 9"), "version"),
                                 ("part.csv", whole.decode().replace("x_m", "y_m"), "columns")):
            kept = (f.path / name).read_bytes()
            f.write(name, text)
            before = (f.path / "part.csv").read_bytes()
            r = resume(f)
            expect(r.status == OUTPUT if what else r.status in (OUTPUT, USAGE), r)
            expect_in(f"part.csv: it belongs to another run (different: {what}); " if what else "", r.err)
            expect_equal((f.path / "part.csv").read_bytes(), before, name)
            f.write(name, kept)
        for words in (["-j", "1"], ["--language", "it"]):  # these change no figure
            expect_equal(resume(f, *WORDS, *words).status, DONE)
        (f.path / "part.csv").unlink()  # after deleting the table a new run starts
        r = resume(f, rocks=61)
        expect_equal((r.status, (f.path / "part.csv").read_bytes()), (DONE, in_one_go(f, rocks=61)), str(r))


def test_other_files():
    """A foreign table, a device, a pipe, an input file, an unwritable file and -o - are refused"""
    with Folder() as f:
        valley(f, make_rows(range(2)))
        f.write("other.csv", "name,option\na,b\n")
        f.write("side.csv.resume", "mine\n")
        os.mkfifo(f.path / "pipe")
        os.symlink(f.path / "pipe", f.path / "link")
        f.write("odd.csv", "")
        os.mkfifo(f.path / "odd.csv.resume")
        (f.path / "folder").mkdir()
        for name, words in (("other.csv", "its side file other.csv.resume is missing"), ("side.csv", "side.csv.resume: this is not a file of --resume"),
                            ("pipe", "not a device or a pipe"), ("link", "not a device or a pipe"), ("/dev/null", "not a device or a pipe"),
                            ("odd.csv", "odd.csv.resume: --resume needs a regular file"), ("s.yaml", "an input of the run"), ("folder", "directory"),
                            ("100.csv", "100.csv.resume"), ("none/x.csv", "No such file")):
            before = (f.path / name).read_bytes() if (f.path / name).is_file() else None
            r = run(f, *WORDS, "-o", name, "--resume")
            expect_equal((r.status, r.out), (OUTPUT, ""), str(r))
            expect_in(words, r.err)
            expect(before is None or (f.path / name).read_bytes() == before, name)
        expect_equal((f.path / "side.csv.resume").read_text(), "mine\n")
        for words in (["-o", "-"], [], ["-o", "x.json", "-f", "json"], ["-o", "x.csv", "--plot", "energy"]):
            expect_equal(run(f, *WORDS, *words, "--resume").status, USAGE, words)
        expect_equal(ceduo("-b", "-f", "csv", "-o", "x.csv", "--resume", "s.yaml", cwd=f.path).status, USAGE)
        os.symlink("far.csv", f.path / "part.csv")
        expect_resumed(f, in_one_go(f))
        expect((f.path / "part.csv").is_symlink() and (f.path / "far.csv").is_file(), "a link stays a link")


def test_several_scenes():
    """Rows of two scenes each, rows with equal cells, and a row that first fails"""
    with Folder() as f:
        valley(f, make_rows([0, 0, 1]) + "r5,late.csv,1\n" + make_rows([2])[len(make_rows([])):])
        f.write("t.yaml", wooded_scene(title="other", controls=[{"x_m": "end-50"}]))
        words = ["-f", "csv", "--each", "rows.csv", "t.yaml"]
        expect_equal(resume(f, *words).status, INPUT)
        expect_equal((f.path / "part.csv").read_bytes(), in_one_go(f, *words))
        f.write("late.csv", profile(130))
        files = set()
        for _ in range(3):
            expect_equal(resume(f, *words).status, DONE)
            expect_equal((f.path / "part.csv").read_bytes(), in_one_go(f, *words))
            files.add((f.path / "part.csv").stat().st_ino)
        expect_equal(len(files), 1, "what is in order is not written again")


if __name__ == "__main__":
    run_all(__name__)
