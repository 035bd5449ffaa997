#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Several scenes, standard streams and -o: destinations of output, and exit statuses."""
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import (CEDUO, DONE, INPUT, OUTPUT, PATIENCE, RUN, USAGE, Folder, Skip, ceduo, environment, expect, expect_equal,
                     expect_in, good, result, run_all, scene, stand)
from pages import WHOLE
from runs import ENDLESS, FOUR, PAPER

PAGE = ("--batch", "-s", "uncertainty=none")  # uncertainty takes most of a page's time


def test_energies_of_the_paper():
    """The page has the paper's energies: 67.5 m of each plot at its ADC and contact energy, and the residual of Eq. 5"""
    page = good(*WHOLE, "-n", 50, PAPER).out
    for plot, adc, joule in ((1, 1.9483, 1099.96), (2, 2.6054, 606.52)):
        row = re.search(rf"ADS {plot} .* (\S+) +(\S+)\n", page)
        for found, wanted in zip(row.groups(), (67.5 / adc * joule / 1e3, 100 / adc * joule / 1e3)):
            expect_equal(found, f"{wanted:.1f}", row[0])
    left = re.search(r"could absorb 53\.8 kJ \(Eq\. 4\).* of\s+(\d+\.\d)\s+kJ\s+(\d+\.\d)\s+kJ\s+are\s+left", page, re.DOTALL)
    expect(left and abs(float(left[1]) - 53.8 - float(left[2])) < 1e-9, page)


def test_several_scenes():
    """Several scenes: a bad one is reported, the good ones printed, status 3"""
    with Folder() as f:
        bad = f.write("bad.yaml", "ceduo: scene/1\nrock: {diameter_m: -1}\n")
        done = ceduo("--batch", "-f", "json", "-n", 10, PAPER, bad, FOUR, f.path / "missing.yaml")
        expect_equal(done.status, INPUT)
        expect_equal([r["scene"] for r in done.json()], [str(PAPER), str(FOUR)])
        expect(f"{bad}:2:20: " in done.err and "missing.yaml" in done.err, done)
        done = ceduo(*PAGE, "-n", 10, bad, PAPER)
        expect_equal(done.status, INPUT)
        expect(done.out == good(*PAGE, "-n", 10, PAPER).out, "a bad scene before it changes the table:", repr(done.out[:80]))
        done = ceduo("--batch", "-f", "csv", "-n", 10, PAPER, bad)
        expect_equal((done.status, done.out), (INPUT, good("--batch", "-f", "csv", "-n", 10, PAPER).out), "CSV")
        target = f.path / "out.csv"
        done = ceduo("--batch", "-f", "csv", "-n", 10, "-o", target, bad, PAPER)
        expect_equal((done.status, len(target.read_text().splitlines())), (INPUT, 2), "-o")
        done = ceduo("--batch", "-f", "csv", bad)
        expect_equal((done.status, done.out), (INPUT, ""), "nothing good: not even a header")
        done = ceduo("--check", PAPER, bad, FOUR)
        expect(done.status == INPUT and done.out == "", done)


def test_highest_status():
    """Several scenes: the highest status counts"""
    with Folder() as f:
        endless = f.write("endless.yaml", ENDLESS)
        bad = f.write("bad.yaml", "x")
        expect_equal(ceduo(*PAGE, "-n", 1, endless, PAPER).status, RUN)
        expect_equal(ceduo(*PAGE, "-n", 1, endless, bad, PAPER).status, INPUT)
        expect_equal(ceduo(*PAGE, "-n", 1, bad, PAPER, "--option", "nope").status, INPUT)
        expect_equal(ceduo(*PAGE, "-n", 1, bad, PAPER, "-o", "/dev/full").status, OUTPUT)


def test_stdin():
    """'-' reads a scene from standard input, with profiles by relative paths; only once"""
    text = PAPER.read_bytes()
    run = result("-", stdin=text, cwd="/")
    wanted = result(PAPER)
    expect_equal({k: v for k, v in run.items() if k not in ("scene", "work")},
                 {k: v for k, v in wanted.items() if k not in ("scene", "work")})
    expect_equal(ceduo("--batch", "-", "-").status, USAGE)
    done = ceduo("--batch", "-", stdin=b"rock: 5\n")
    expect(done.status == INPUT and re.match(r"(-|standard input|<stdin>):1:\d+: ", done.err), done)
    done = ceduo("--batch", "-", stdin=b"")
    expect(done.status == INPUT and done.out == "" and done.err, done)
    expect_equal(ceduo("--check", "-", stdin=text).status, DONE)


def test_stdin_closed():
    """A closed standard input: irrelevant for files, an error for '-'"""
    shell = ["sh", "-c", '"$0" "$@" <&-', CEDUO, *PAGE, "-n", "10"]
    done = subprocess.run([*shell, str(PAPER)], env=environment(), capture_output=True, timeout=PATIENCE, check=False)
    expect(done.returncode == DONE and done.stdout and not done.stderr, done)
    done = subprocess.run([*shell, "-"], env=environment(), capture_output=True, timeout=PATIENCE, check=False)
    expect(done.returncode == INPUT and not done.stdout and done.stderr, done)


def test_output_file():
    """-o writes the complete file, equal to standard output, without leftovers"""
    with Folder() as f:
        for form in ("table", "csv"):
            target = f.path / f"out.{form}"
            done = good(*PAGE, "-f", form, "-o", target, PAPER, FOUR, "-n", 50)
            expect_equal(done.out, "")
            expect_equal(target.read_text(), good(*PAGE, "-f", form, PAPER, FOUR, "-n", 50).out, form)
            expect_equal(target.stat().st_mode & 0o777, 0o666 & ~umask(), "mode")
        expect_equal(f.names(), ["out.csv", "out.table"])
        good("--batch", "-o", "relative.txt", PAPER, "-n", 5, cwd=f.path)
        expect_in("relative.txt", f.names(), "relative path")
        for mode in ("--help", "--version", "--list-parameters", "--list-profiles"):
            done = good(mode, "-o", f.path / "list")
            expect(done.out == "" and (f.path / "list").read_text() == good(mode).out, mode)


def test_output_dash():
    """-o - is standard output in every mode, and no file is created"""
    talus = {"vertices_m": [[0, 64], [100, 0]], "segments": [{"rn": 0.35, "rt": 0.875, "roughness_rad": 0.125}]}
    with Folder() as f:
        f.write("small.yaml", scene(forest=[{"from_m": 10, "to_m": 70, "stand": stand()}]))
        f.write("seen.yaml", scene(slope=talus, observed=[{"passed": {"x_m": 60, "count": 4, "of": 4}}]))
        f.write("rows.csv", "id,rock.diameter_m\na,1\n")
        names = f.names()
        for words in ([*PAGE, "-n", 50, PAPER], ["-b", "-f", "csv", "-n", 50, PAPER, FOUR], ["-b", "-f", "csv", "-n", 50, "-q", "--each", "rows.csv", PAPER],
                      ["--plot", "energy", "-n", 50, PAPER], ["--find", "forest[0].stand.stools.per_ha=500:3000", "--goal", "adc=9", "small.yaml"],
                      ["--sensitivity=2", "-f", "csv", "-n", 20, "small.yaml"],
                      ["-n", 60, "-f", "csv", "--calibrate", "slope.segments[0].rt=0.7:0.98", "seen.yaml"], ["--survey", "six-plots"],
                      ["--survey", "--template"], ["--list-parameters"], ["--list-profiles"], ["--list-columns"], ["--schema", "result"],
                      ["--help"], ["--version"]):
            plain, dash = ceduo(*words, cwd=f.path), ceduo("-o", "-", *words, cwd=f.path)
            expect_equal((dash.status, dash.out, dash.err), (plain.status, plain.out, plain.err), words)
            expect(plain.status == DONE and plain.out, plain)
            expect_equal(f.names(), names, words)
        good(*PAGE, "-n", 5, "-o", "-", "-o", "last.txt", PAPER, cwd=f.path)
        good(*PAGE, "-n", 5, "-o", "./-", PAPER, cwd=f.path)
        expect_equal(sorted({*f.names()} - {*names}), ["-", "last.txt"])
        expect_equal(ceduo("--report", "x.html", "-o", "-", PAPER, cwd=f.path).status, USAGE)
        expect("<html" in good("--report", "-", "-s", "uncertainty=none", "-n", 50, PAPER, cwd=f.path).out, "a report")
        expect_equal(ceduo("-b", "-f", "csv", "--each", "rows.csv", "--resume", "-o", "-", PAPER, cwd=f.path).status, USAGE)


def test_large_output():
    """Output over a megabyte is written completely or not at all: a signal leaves no part of it"""
    with Folder() as f:
        rows = f.write("rows.csv", "id,rock.diameter_m\n" + "".join(f"r{i},{0.5 + i / 10000}\n" for i in range(2000)))
        words = ["--batch", "-q", "-f", "csv", "-n", "1", "-j", "1", "--each", str(rows), f.write("s.yaml", scene())]
        for old in (None, "old"):
            if old:
                f.write("out.csv", old)
            with subprocess.Popen([CEDUO, *map(str, words), "-o", "out.csv"], cwd=f.path, env=environment()) as p:
                while p.poll() is None and not any("tmp" in n for n in f.names()):
                    time.sleep(0.001)
                p.send_signal(signal.SIGTERM)
            expect_equal(p.returncode, -signal.SIGTERM)
            expect_equal(f.names(), (["out.csv"] if old else []) + ["rows.csv", "s.yaml"])
            expect(not old or (f.path / "out.csv").read_text() == old, "the old file")
        wanted = good(*words).out
        expect(len(wanted) > 2000000, len(wanted))
        good(*words, "-o", f.path / "out.csv")
        expect_equal((f.path / "out.csv").read_text(), wanted)
        expect_equal(f.names(), ["out.csv", "rows.csv", "s.yaml"])
        expect_equal(ceduo(*words, "-o", "/dev/full").status, OUTPUT)
        os.mkfifo(f.path / "fifo")
        with open(f.path / "read", "wb") as read, subprocess.Popen(["cat", str(f.path / "fifo")], stdout=read) as cat:
            try:
                good(*words, "-o", f.path / "fifo")
                cat.wait(timeout=PATIENCE)
            finally:
                cat.kill()
        expect_equal((f.path / "read").read_text(), wanted, "FIFO")


def umask():
    mask = os.umask(0)
    os.umask(mask)
    return mask


def test_output_existing():
    """-o keeps an existing file's mode, a link stays a link, a failed run keeps the old file"""
    with Folder() as f:
        target = f.write("out.txt", "old")
        target.chmod(0o640)
        link = f.path / "link.txt"
        link.symlink_to("out.txt")
        wanted = good(*PAGE, "-n", 5, PAPER).out
        good(*PAGE, "-n", 5, "-o", target, PAPER)
        expect_equal((target.read_text() == wanted, target.stat().st_mode & 0o7777), (True, 0o640), "mode")
        target.write_text("old")
        good(*PAGE, "-n", 5, "-o", link, PAPER)
        expect(link.is_symlink() and target.read_text() == wanted, "the link was replaced")
        expect_equal(target.stat().st_mode & 0o7777, 0o640, "mode through a link")
        target.write_text("old")
        bad = f.write("bad.yaml", "x")
        expect_equal(ceduo("--batch", "-o", target, bad).status, INPUT)
        expect_equal(target.read_text(), "old", "a bad scene")
        expect_equal(ceduo("--batch", "-o", f.path / "new.txt", bad).status, INPUT)
        expect_equal(f.names(), ["bad.yaml", "link.txt", "out.txt"])


def test_output_dangling():
    """-o through a dangling link creates its target; the link stays"""
    with Folder() as f:
        link = f.path / "link.txt"
        link.symlink_to("target.txt")
        done = ceduo(*PAGE, "-n", 5, "-o", link, PAPER)
        expect(link.is_symlink(), "the link was replaced", done)
        expect_equal((done.status, done.err), (DONE, ""), done)
        expect_equal((f.path / "target.txt").read_text(), good(*PAGE, "-n", 5, PAPER).out)


def test_output_devices():
    """-o to a device writes directly: /dev/null works, /dev/full is status 4, a FIFO's reader receives it"""
    expect_equal(good(*PAGE, "-n", 5, "-o", "/dev/null", PAPER).out, "")
    expect(not Path("/dev/null").is_file(), "/dev/null was replaced")
    done = ceduo(*PAGE, "-n", 5, "-o", "/dev/full", PAPER)
    expect(done.status == OUTPUT and "/dev/full: " in done.err and done.out == "", done)
    with Folder() as f:
        fifo = f.path / "fifo"
        os.mkfifo(fifo)
        with subprocess.Popen(["cat", str(fifo)], stdout=subprocess.PIPE) as cat:
            try:
                good(*PAGE, "-n", 5, "-o", fifo, PAPER)
                expect_equal(cat.communicate(timeout=PATIENCE)[0].decode(), good(*PAGE, "-n", 5, PAPER).out, "FIFO")
            finally:
                cat.kill()


def test_output_impossible():
    """-o to a folder, into a missing folder, or to nothing: status 4, reported, no leftovers"""
    with Folder() as f:
        for target in (f.path, f.path / "no" / "out.txt", "", PAPER / "out.txt", f.path / ("x" * 300)):
            done = ceduo(*PAGE, "-n", 5, "-o", target, PAPER, cwd=f.path)
            expect(done.status == OUTPUT and done.err and done.out == "", done)
        expect_equal(f.names(), [])


def test_output_told_first():
    """An unwritable -o is reported before anything is read or computed"""
    with Folder() as f:
        for target in (f.path, f.path / "no" / "out.txt", "", f.path / ("x" * 300)):
            for words in (["--batch"], ["--find", "rock.diameter_m=0.2:1", "--goal", "adc=30"]):
                done = ceduo(*words, "-o", target, f.path / "no-scene.yaml", cwd=f.path)
                expect_equal(done.status, OUTPUT, done)
                expect(done.out == "" and "no-scene" not in done.err, done)


def test_output_large():
    """-o of many scenes equals stdout"""
    wanted = good("--batch", "-f", "csv", "-n", 1, *[PAPER] * 1000).out
    expect(len(wanted) > 2_000_000, "bytes of output", len(wanted))
    with Folder() as f:
        good("--batch", "-f", "csv", "-n", 1, "-o", f.path / "out.csv", *[PAPER] * 1000)
        expect_equal((f.path / "out.csv").read_text(), wanted, "rows")


def test_output_forbidden():
    """-o into a read-only folder or over a read-only file: status 4, the old file stays"""
    with Folder() as f:
        who = {}
        if os.geteuid() == 0:
            who = {"user": 65534, "group": 65534, "extra_groups": []}
            f.path.chmod(0o755)
            try:
                subprocess.run([CEDUO, "--version"], check=True, capture_output=True, **who)
            except (OSError, subprocess.SubprocessError) as why:
                raise Skip("root may write anywhere, and another user cannot run the program") from why
        folder = f.path / "locked"
        folder.mkdir()
        target = f.write("locked/out.txt", "old")
        target.chmod(0o666)
        folder.chmod(0o555)
        done = ceduo(*PAGE, "-n", 5, "-o", folder / "new.txt", "-", stdin=INLINE, cwd="/", **who)
        expect(done.status == OUTPUT and "new.txt: " in done.err, done)
        folder.chmod(0o777)
        target.chmod(0o444)
        done = ceduo(*PAGE, "-n", 5, "-o", target, "-", stdin=INLINE, cwd="/", **who)
        expect(done.status == OUTPUT and target.read_text() == "old", done)
        expect_equal([p.name for p in folder.iterdir()], ["out.txt"])


INLINE = b"""ceduo: scene/1
rock: {diameter_m: 0.5}
slope: {vertices_m: [[0, 64], [100, 0]], segments: [{rn: 0.35, rt: 0.875}]}
controls_m: [75]
"""

MODES = ((*PAGE, "-n", "5", str(PAPER)), ("--batch", "-f", "csv", "-n", "5", str(PAPER)), ("--help",), ("--version",),
         ("--list-parameters",), ("--list-profiles",))


def test_stdout_closed():
    """A closed standard output is status 4 in every mode that prints"""
    for mode in MODES:
        done = subprocess.run(["sh", "-c", '"$0" "$@" >&-', CEDUO, *mode], env=environment(), capture_output=True,
                              timeout=PATIENCE, check=False)
        expect(done.returncode == OUTPUT and done.stderr, mode, done)
    with Folder() as f:  # files opened later must not become standard output or error
        done = subprocess.run(["sh", "-c", '"$0" "$@" >&- 2>&-', CEDUO, *PAGE, "-n", "5", "-o",
                               str(f.path / "out.txt"), str(PAPER)], env=environment(), timeout=PATIENCE, check=False)
        expect_equal(done.returncode, DONE, "only the file is written")
        expect_equal((f.path / "out.txt").read_text(), good(*PAGE, "-n", 5, PAPER).out)


def test_stdout_full():
    """A full disk for standard output is status 4 in every mode that prints"""
    for mode in MODES:
        with open("/dev/full", "wb") as full:
            done = subprocess.run([CEDUO, *mode], stdout=full, stderr=subprocess.PIPE, env=environment(), timeout=PATIENCE,
                                  check=False)
        expect(done.returncode == OUTPUT and done.stderr, mode, done)


def test_closed_pipe():
    """A reader that leaves ends the program silently"""
    for mode in MODES:
        read, write = os.pipe()
        os.close(read)
        with subprocess.Popen([CEDUO, *mode], stdout=write, stderr=subprocess.PIPE, env=environment()) as p:
            os.close(write)
            noise = p.communicate(timeout=PATIENCE)[1]
        expect(p.returncode in (-signal.SIGPIPE, DONE) and noise == b"", mode, p.returncode, noise)


def test_output_is_input():
    """-o overwrites no input file of the same run: scenes and their references, by any name"""
    with Folder() as f:
        f.write("line.csv", "distance,elevation\n0,64\n100,0\n")
        f.write("stand.yaml", stand(ceduo="stand/1"))
        f.write("s.yaml", scene(slope="line.csv", forest=[{"from_m": 10, "to_m": 60, "stand": "stand.yaml"}]))
        f.write("bad.yaml", scene(rock=None, slope="line.csv"))
        f.write("plain.yaml", scene())
        os.link(f.path / "s.yaml", f.path / "hard.yaml")
        (f.path / "soft.yaml").symlink_to("s.yaml")
        before = {n: (f.path / n).read_bytes() for n in f.names()}
        with open(f.path / "s.yaml", "rb") as stdin:
            runs = [("-b", "-o", n, "plain.yaml", "s.yaml") for n in
                    ("s.yaml", "./s.yaml", "hard.yaml", "soft.yaml", "stand.yaml", "line.csv", "plain.yaml")]
            runs += [("-b", "-o", "line.csv", "plain.yaml", "bad.yaml"),
                     ("--find", "rock.diameter_m=0.4:0.5", "--goal", "adc", "-o", "stand.yaml", "s.yaml")]
            for arguments in runs:
                done = ceduo(*arguments, cwd=f.path)
                expect(done.status == OUTPUT and done.out == "" and "is an input of the run" in done.err, done)
            done = subprocess.run([CEDUO, "-b", "-o", "s.yaml", "-"], stdin=stdin, stderr=subprocess.PIPE, cwd=f.path,
                                  env=environment(), check=False)
            expect(done.returncode == OUTPUT and b"is an input of the run" in done.stderr, done)
        expect_equal({n: (f.path / n).read_bytes() for n in f.names()}, before, "files")
        good("-b", "-o", "s.yaml", "plain.yaml", cwd=f.path)


if __name__ == "__main__":
    run_all(__name__)
