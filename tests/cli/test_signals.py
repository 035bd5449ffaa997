#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Signals end the program without half results; progress goes only to a terminal."""
import os
import pty
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import (CEDUO, DONE, PATIENCE, SLOWER, Failure, Folder, children_seconds, environment, expect, expect_equal,
                     only_text, processor_seconds, run_all)
from runs import ENDLESS, FOUR, PAPER


def on_terminal(arguments, stop, which):
    """Return the program's output on a terminal as its stdout or stderr, until stop(text, seconds); and its status."""
    master, slave = pty.openpty()
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, which: slave}
    with subprocess.Popen([CEDUO, *map(str, arguments)], stdin=subprocess.DEVNULL, env=environment(), **streams) as p:
        os.close(slave)
        os.set_blocking(master, False)
        text, start, sent = b"", time.monotonic(), False
        while time.monotonic() - start < PATIENCE:
            try:
                text += os.read(master, 65536)
            except BlockingIOError:
                time.sleep(0.02)
            except OSError:
                break
            if not sent and stop(text, time.monotonic() - start):
                p.send_signal(signal.SIGINT)
                sent = True
        p.kill()
        p.communicate()
    os.close(master)
    return text, p.returncode


def test_terminal():
    """On a terminal: no escape bytes on standard output; progress on standard error after a second, none with -q"""
    text, status = on_terminal(["--batch", "-n", "50", FOUR], lambda *_: False, "stdout")
    expect_equal(status, DONE)
    only_text(text.replace(b"\r\n", b"\n"), "stdout")
    with Folder() as f:
        endless = f.write("endless.yaml", ENDLESS)
        run = ["--batch", "-n", "1000000", "-o", "/dev/null"]
        text, status = on_terminal([*run, endless], lambda t, s: s > 1.3, "stderr")
        expect_equal(status, -signal.SIGINT)
        expect(b"\x1b" not in text, text)
        text, status = on_terminal(["--batch", "-n", "1000000", "-j", "1", "-s", "simulation.law=crsp", "-o", "/dev/null",
                                    PAPER], lambda t, _: b"rocks" in t, "stderr")
        expect(b"rocks" in text and b"\x1b" not in text, text)
        expect_equal(status, -signal.SIGINT)
        rows = f.write("rows.csv", "id,rock.diameter_m\n" + "".join(f"r{i},{'x' if i == 3 else 0.6}\n" for i in range(999)))
        text, status = on_terminal(["--batch", "-f", "csv", "-n", str(200000 // SLOWER), "-j", "1", "-o", "/dev/null", "--each",
                                    str(rows), PAPER],
                                   lambda t, _: t.count(b" left") > 3 and b"rows.csv:5" in t, "stderr")
        shown = text.replace(b"\r\n", b"\n").decode()
        expect(re.search(r"\r\d+ of 999 scenes, \d+ (s|min) left *\r", shown), shown)
        expect(re.search(r"(^|[\r\n])[^\r\n]*rows.csv:5: .*'x' is not a number\n", shown) and "left" not in
               re.search(r"[^\r\n]*rows.csv:5: ", shown)[0], "nothing stands before a message", shown)
        text, status = on_terminal(["--batch", "-q", "-n", "1000000", "-j", "1", "-o", "/dev/null", PAPER],
                                   lambda t, s: t or s > 1.6, "stderr")
        expect_equal(text, b"", "-q")
        start = time.monotonic()
        text, status = on_terminal(["--batch", "-n", "10", "-o", "/dev/null", PAPER], lambda *_: False, "stderr")
        expect_equal(status, DONE)
        expect(not text or time.monotonic() - start >= 1, "short work", text)


def interrupted(number, path):
    with Folder() as f:
        old = f.write("old.txt", "old")
        for target in (None, f.path / "new.txt", old):
            where = ["-o", str(target)] if target else []
            with subprocess.Popen([CEDUO, "--batch", "-n", "1000000", *where, str(path)], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, env=environment()) as p:
                time.sleep(0.25)
                expect(p.poll() is None, "it ended before the signal", p.returncode)
                before = children_seconds() + processor_seconds(p.pid)
                p.send_signal(number)
                try:
                    out, err = p.communicate(timeout=PATIENCE)
                except subprocess.TimeoutExpired as late:
                    p.kill()
                    raise Failure("it goes on after the signal") from late
            expect_equal(p.returncode, -number, "status")
            expect_equal((out, err), (b"", b""))
            seconds = children_seconds() - before
            expect(seconds < 1, f"ended after {seconds:.2f} s of processor")
            expect_equal(f.names(), ["old.txt"])
            expect_equal(old.read_text(), "old")


def test_interrupt():
    """SIGINT in a long run ends by that signal, no file written"""
    interrupted(signal.SIGINT, PAPER)


def test_terminate():
    """SIGTERM in a long run ends by that signal, no file written"""
    interrupted(signal.SIGTERM, PAPER)


def test_hang_up():
    """SIGHUP in a long run ends by that signal, no file written"""
    interrupted(signal.SIGHUP, PAPER)


def test_interrupt_endless():
    """SIGINT ends the program quickly even if rocks never stop"""
    with Folder() as f:
        interrupted(signal.SIGINT, f.write("endless.yaml", ENDLESS))


def test_nohup():
    """A signal that the caller ignores stays ignored"""
    old = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with subprocess.Popen([CEDUO, "--batch", "-n", "100000", str(PAPER)], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, env=environment()) as p:
            time.sleep(0.1)
            p.send_signal(signal.SIGHUP)
            out, err = p.communicate(timeout=PATIENCE)
    finally:
        signal.signal(signal.SIGHUP, old)
    expect(p.returncode == DONE and b"100000" in out and err == b"", p.returncode, out, err)


def test_interrupt_between():
    """A signal during the second scene keeps the first one's result and prints no half result"""
    with subprocess.Popen([CEDUO, "--batch", "-f", "json", str(FOUR), "-", "-n", "1000000"], stdin=subprocess.PIPE,
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=environment()) as p:
        time.sleep(0.2)
        p.send_signal(signal.SIGINT)
        out, _ = p.communicate(timeout=PATIENCE)
    expect_equal((p.returncode, out), (-signal.SIGINT, b""))


if __name__ == "__main__":
    run_all(__name__)
