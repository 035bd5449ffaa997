#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: slow
"""The program in a real terminal, tmux: keys, sizes, signals, and the restored terminal."""
import fcntl
import os
import pty
import re
import shlex
import shutil
import signal
import struct
import subprocess
import sys
import termios
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import FAST, WOOD, Place, check_good, home  # noqa: E402
from harness import (CEDUO, PATIENCE, SANITIZED, USAGE, Failure, Skip, Suite, expect, expect_equal, expect_in,  # noqa: E402
                     processor_seconds, result, list_tests)

ASAN = b"__asan_init" in Path(CEDUO).read_bytes()


def until(what, found):
    """Poll until found() is true, and return its value."""
    end = time.monotonic() + PATIENCE
    while True:
        value = found()
        if value:
            return value
        if time.monotonic() > end:
            raise Failure(f"waited {PATIENCE} s in vain: {what() if callable(what) else what}")
        time.sleep(0.01)


class Tmux:
    """A separate tmux server with one shell; `with Tmux(place) as t:`. Further variables are set for the shell."""

    def __init__(self, place, width=80, height=24, **changes):
        self.place, self.width, self.height = place, width, height
        kept = ("PATH", "HOME", "LC_ALL", "ASAN_OPTIONS", "UBSAN_OPTIONS", "TSAN_OPTIONS")
        self.env = {k: v for k, v in home(place.path).items() if k in kept or k.startswith("XDG_")}
        self.env.update(TERM="tmux-256color", PS1="READY> ")
        self.env.update(changes)
        self.socket = str(place.path / "tmux.socket")
        self.marks = 0

    def tmux(self, *words, check=True):
        done = subprocess.run(["tmux", "-S", self.socket, "-f", "/dev/null", *words], env=self.env, cwd=self.place.path,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=PATIENCE, check=False)
        expect(not check or done.returncode == 0, "tmux", words, done.stderr.decode())
        return done.stdout.decode("utf-8", "replace")

    def __enter__(self):
        if not shutil.which("tmux"):
            raise Skip("no tmux here")
        # the shell gets exactly this environment, without tmux's additions
        inner = [f"{k}={v}" for k, v in self.env.items()]
        self.tmux("-u", "new-session", "-d", "-s", "first", "-x", str(self.width), "-y", str(self.height),
                  "env", "-i", *inner, "sh", "-i")
        self.tmux("set-option", "-g", "escape-time", "0")
        self.sees("READY>")
        return self

    def __exit__(self, *_):
        self.tmux("kill-server", check=False)

    def screen(self, *options):
        return self.tmux("capture-pane", "-p", *options)

    def sees(self, *parts, lacks=()):
        """Wait until all parts are on the screen; return it."""
        last = [""]

        def find_screen():
            last[0] = self.screen()
            return all(p in last[0] for p in parts) and not any(p in last[0] for p in lacks)

        until(lambda: f"{parts} without {lacks} on the screen, which is:\n{last[0]}", find_screen)
        return last[0]

    def keys(self, *keys):
        self.tmux("send-keys", *keys)

    def text(self, text):
        self.tmux("send-keys", "-l", text)

    def shell(self, line):
        """Run a shell command; return the screen after it."""
        self.marks += 1
        self.text(f"clear; {line}; echo DONE-$((1000+{self.marks}))")
        self.keys("Enter")
        return self.sees(f"DONE-{1000 + self.marks}\n")

    def start(self, scene, sees=("? help", "q quit", "1 slope")):
        """Start the program; return its process."""
        self.text(f"clear; '{CEDUO}' {scene}")
        self.keys("Enter")
        self.sees(*sees)
        return self.process()

    def process(self):
        shell = int(self.tmux("display-message", "-p", "#{pane_pid}"))

        def child():
            found = Path(f"/proc/{shell}/task/{shell}/children").read_text().split()
            return found and int(found[0])

        return until("the program runs", child)

    def alternate(self):
        return self.tmux("display-message", "-p", "#{alternate_on}").strip() == "1"

    def edit(self, stools="1234"):
        """Change the stools of the first belt."""
        self.keys("2")
        self.sees("stools per ha")
        self.keys("/")
        self.sees("Search in this view")
        self.keys("C-u")
        self.text("stools.per_ha")
        self.keys("Enter")
        self.sees("stools per horizontal hectare")
        self.keys("Enter")
        self.sees("Esc cancel")
        self.keys("C-u")
        self.text(stools)
        self.keys("Enter")
        self.sees(stools, "* ", lacks=("Esc cancel",))


def has_ended(pid):
    """True if a process has ended."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] in "ZX"
    except (FileNotFoundError, ProcessLookupError):
        return True


def mode(t):
    """Return stty's output for the terminal, between marks."""
    text = t.shell("stty -a")
    found = text.split("\n")
    return "\n".join(line for line in found if "=" in line or "icanon" in line or "echo" in line or "speed" in line)


def after_ending(t, before, what):
    """Expect the terminal of a shell again."""
    t.sees("READY>")
    until(f"the alternate screen is left after {what}", lambda: not t.alternate())
    expect_equal(mode(t), before, f"stty -a after {what}")
    flags = t.tmux("display-message", "-p", "#{mouse_any_flag} #{cursor_flag} #{keypad_cursor_flag}").strip()
    expect_equal(flags, "0 1 0", f"mouse, cursor, keypad after {what}")


# ---- working ----

def test_work():
    """Start, edit, undo, redo, save, quit; every key acts at once."""
    with Place() as place, Tmux(place) as t:
        before = mode(t)
        t.start("fast.yaml")
        t.sees("Rock 0.5 m", " rocks", "Belts of forest")
        expect(t.alternate(), "not on the alternate screen")
        old = t.screen()
        t.edit()
        expect(t.screen() != old, "nothing has changed")
        t.keys("u")
        t.sees("undone: ", "3000")
        t.keys("C-r")
        t.sees("redone: ", "1234")
        t.keys("s")
        t.sees("saved ", lacks=("* fast",))
        expect_equal(place.text("fast.yaml"), FAST.replace("per_ha: 3000", "per_ha: 1234"), "the file")
        t.keys("F10")
        after_ending(t, before, "quitting")
        expect("1 slope" not in t.screen(), "the program's screen is still there")


def test_function_keys():
    """Function keys, arrows, Shift-Tab, Del, PgDn arrive in the terminal's sequences; Esc without delay."""
    with Place() as place, Tmux(place) as t:
        t.start("fast.yaml")
        t.keys("F1")
        t.sees("Figures and pictures follow every edit at once")
        t.keys("NPage")
        t.sees("redo", lacks=("Figures and pictures follow every edit at once",))
        t.keys("Escape")
        t.sees("Belts of forest", lacks=("redo",))
        took = []
        for _ in range(5):
            t.keys("F1", "End")
            t.sees("select text in")
            start = time.monotonic()
            t.keys("Escape")
            t.sees("Belts of forest", lacks=("select text in",))
            took.append(time.monotonic() - start)
        expect(min(took) < 0.5, f"Esc took {min(took):.2f} s at least")  # curses waits for a second by default
        t.keys("Down", "Right")
        t.sees("to, m: where the belt ends")
        t.keys("DC")
        t.sees("deleted: belt 2")
        t.keys("BTab")
        for key in ("F4", "F7"):
            t.keys(key)
            t.sees("There are unsaved changes")
            t.keys("Escape")
            t.sees("1 slope", lacks=("There are unsaved changes",))
        t.keys("F3")
        t.sees("Search in this view")
        t.keys("Escape")
        t.keys("F5")
        t.sees("Stand of belt 1")
        t.keys("Escape")
        t.keys("F6")
        t.sees("the batch command")
        t.keys("Escape")
        t.keys("F2")
        t.sees("saved ")
        check_good(place.path, "fast.yaml")


def test_utf8():
    """Typed UTF-8 arrives whole."""
    with Place() as place, Tmux(place) as t:
        t.start("fast.yaml")
        t.keys("3")
        t.keys("/")
        t.text("title")
        t.keys("Enter")
        t.sees("title  ")
        t.keys("Enter")
        t.text("Über ‘è’")
        t.keys("Enter")
        t.sees("* Über ‘è’")
        t.keys("s")
        t.sees("saved ")
        expect_in("Über ‘è’", place.text("fast.yaml"))


def test_resizes():
    """200 resizes, and the screen has its size; too small gives a message and recovers."""
    with Place() as place, Tmux(place) as t:
        pid = t.start("fast.yaml")
        sizes = [(80, 24), (20, 5), (200, 50), (60, 20), (59, 15), (121, 33), (1, 1), (100, 30), (300, 90), (79, 24)]
        for i in range(200):
            width, height = sizes[i % 10][0] + i % 7, sizes[i % 10][1] + i % 3
            t.tmux("resize-window", "-x", str(width), "-y", str(height))
            if i % 20 == 3:
                t.keys(str(1 + i // 20 % 5))
        expect(not has_ended(pid), "the program ended on a resize")
        t.tmux("resize-window", "-x", "59", "-y", "15")
        t.sees("The window (59 x 15) is too small: at least 60 x 16 is")
        t.keys("d1")  # nothing acts unseen
        t.tmux("resize-window", "-x", "120", "-y", "40")
        t.sees("option")
        t.keys("1")
        screen = t.sees("Belts of forest", "underside above the ground", "w export")
        lines = screen.split("\n")
        expect_equal(len(lines), 41, "lines")
        expect_in("? help", lines[39], "last line")
        expect(all(line[83] == "│" for line in lines[2:37]), screen)
        t.keys("q")
        t.sees("READY>")


def test_stop():
    """Ctrl-Z restores the terminal, fg continues."""
    with Place() as place, Tmux(place) as t:
        before = mode(t)
        t.start("fast.yaml")
        t.edit("1111")
        t.keys("C-z")
        t.sees("READY>", lacks=("1 slope",))
        expect_equal(mode(t), before, "stty -a while stopped")
        expect(not t.alternate(), "the alternate screen while stopped")
        t.text("fg")
        t.keys("Enter")
        t.sees("stools per ha            1111", "? help")
        t.keys("u")
        t.sees("undone: ")
        t.keys("q")
        after_ending(t, before, "Ctrl-Z, fg and quitting")


def test_stopped_unasked():
    """Stopped by a signal that cannot be caught, fg redraws the screen, and keys work."""
    with Place() as place, Tmux(place) as t:
        before = mode(t)
        pid = t.start("fast.yaml")
        os.kill(pid, signal.SIGSTOP)
        until("it stands still", lambda: Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()[0] == "T")
        t.text("stty sane; fg")
        t.keys("C-j")
        t.sees("1 slope", "? help", lacks=("READY>", "stty"))
        t.keys("2")
        t.sees("stools per ha")
        t.keys("q")
        after_ending(t, before, "SIGSTOP, fg and quitting")


def test_interrupt():
    """Ctrl-C asks like q: ends at once if nothing is unsaved, otherwise asks."""
    with Place() as place, Tmux(place) as t:
        before = mode(t)
        t.start("fast.yaml")
        t.edit("1111")
        t.keys("C-c")
        t.sees("There are unsaved changes", "discard them")
        t.keys("Enter")
        t.sees("* fast", lacks=("There are unsaved changes",))
        t.keys("u")
        t.sees("undone: ")
        t.keys("C-c")
        after_ending(t, before, "Ctrl-C")
        expect_equal(place.text("fast.yaml"), FAST, "the scene")


def left_behind(place):
    folder = place.path / "state/ceduo"
    return sorted(p.name for p in folder.iterdir()) if folder.exists() else []


def sane(t):
    """Restore a terminal left by a killed program for the shell."""
    t.tmux("send-keys", "-R")
    t.marks += 1
    t.keys("C-j")
    t.text(f"stty sane; clear; echo SANE-$((1000+{t.marks}))")
    t.keys("C-j")
    t.sees(f"SANE-{1000 + t.marks}\n", "READY>")


def end_by(number, name, restores):
    """End the program with unsaved work by a signal; the next start offers that work."""
    with Place() as place, Tmux(place) as t:
        t.shell("ulimit -c 0")
        before = mode(t)
        pid = t.start("fast.yaml")
        t.edit("1234")
        until("a copy of the unsaved work", lambda: left_behind(place))
        os.kill(pid, number)
        until(f"ended by {name}", lambda: has_ended(pid))
        if restores:
            after_ending(t, before, name)
            expect("1 slope" not in t.screen(), f"the program's screen is still there after {name}")
        else:
            sane(t)
        expect_equal(place.text("fast.yaml"), FAST, "the scene on disk")
        t.start("fast.yaml", sees=("Unsaved changes were found", "0 min ago: fast.yaml, fast", "not now", "delete some"))
        t.keys("Enter")
        t.sees("changes recovered")
        t.keys("2")
        t.sees("stools per ha            1234", "* fast")
        t.keys("s")
        t.sees("saved ")
        expect_equal(place.text("fast.yaml"), FAST.replace("per_ha: 3000", "per_ha: 1234"), "the recovered scene")
        t.keys("q")
        t.sees("READY>")
        until("no copy is kept of what is saved", lambda: not left_behind(place))
        t.start("fast.yaml")
        expect("Unsaved changes were found" not in t.screen(), "offered again")
        t.keys("q")
        t.sees("READY>")


def test_kill():
    """kill -9: the next start offers the work, recovers it, saves it."""
    end_by(signal.SIGKILL, "SIGKILL", False)


def test_term():
    """SIGTERM restores the terminal, and the work can be recovered."""
    end_by(signal.SIGTERM, "SIGTERM", True)


def test_hup():
    """SIGHUP restores the terminal, and the work can be recovered."""
    end_by(signal.SIGHUP, "SIGHUP", True)


def test_crash():
    """A crash (SIGSEGV) restores the terminal, and the work can be recovered."""
    if ASAN:
        raise Skip("the sanitizer would report the signal")
    end_by(signal.SIGSEGV, "SIGSEGV", True)


def test_abort():
    """An abort restores the terminal too."""
    with Place() as place, Tmux(place) as t:
        t.shell("ulimit -c 0")
        before = mode(t)
        pid = t.start("fast.yaml")
        os.kill(pid, signal.SIGABRT)
        until("ended by SIGABRT", lambda: has_ended(pid))
        after_ending(t, before, "SIGABRT")


def test_signal_status():
    """A signal ends the program by that signal: the shell gets 128 + its number."""
    for number in (signal.SIGTERM, signal.SIGHUP):
        with Place() as place, Tmux(place) as t:
            t.text(f"clear; '{CEDUO}' fast.yaml; echo STATUS-$?-")
            t.keys("Enter")
            t.sees("? help", "1 slope")
            os.kill(t.process(), number)
            t.sees(f"STATUS-{128 + number}-")


def test_no_memory():
    """Without memory the program prints one sentence, restores the terminal, and the edits can be recovered."""
    if SANITIZED:
        raise Skip("the sanitizers have their own malloc")
    kept = 0
    for at in (3000, 6000, 9000, 12000, 15000):
        with Place() as place, Tmux(place) as t:
            faults = Path(__file__).resolve().parents[1] / "cli/faults.c"
            subprocess.run([*shlex.split(os.environ.get("CC") or "gcc"), "-D_GNU_SOURCE", "-shared", "-fPIC", "-O1", "-o",
                            place.path / "faults.so", faults, "-ldl"], check=True)
            before = mode(t)
            place.write("start", f"LD_PRELOAD=./faults.so FAULT=memory FAULT_ON=1 FAULT_AT={at} '{CEDUO}' fast.yaml\necho STATUS-$?-\n")
            t.text("clear; sh start")
            t.keys("Enter")
            for _ in range(100):
                if "STATUS-" in t.screen():
                    break
                t.keys("2", "+")
            screen = t.sees("STATUS-1-", "READY>")
            t.keys("C-u", "Enter")  # keys pressed too late
            after_ending(t, before, "running out of memory")
            said = "ceduo: out of memory; unsaved work was kept and is offered at the next start"
            expect_in(said.replace(" ", ""), re.sub(r"\s", "", screen), "however the line is broken")
            expect_equal(place.text("fast.yaml"), FAST, "the scene on disk")
            copies = left_behind(place)
            kept += len(copies)
            if copies:
                expect(re.search(r"- from_m: (5\.[1-9]|[6-9])", place.text(f"state/ceduo/{copies[0]}")), place.text(f"state/ceduo/{copies[0]}"))
                t.start("fast.yaml", sees=("Unsaved changes were found",))
                t.keys("Enter")
                t.sees("changes recovered", "* fast")
    expect(kept > 0, "no edit was kept")


def test_delete():
    """Recoverable work can be deleted, and is not offered again."""
    with Place() as place, Tmux(place) as t:
        pid = t.start("fast.yaml")
        t.edit("1234")
        until("a copy of the unsaved work", lambda: left_behind(place))
        os.kill(pid, signal.SIGTERM)
        t.sees("READY>", lacks=("1 slope",))
        t.start("fast.yaml", sees=("Unsaved changes were found", "delete some"))
        t.keys("d")
        t.sees("Delete which unsaved changes?", "0 min ago: fast.yaml, fast", "none", "all of them")
        t.keys("n")
        t.sees("Unsaved changes were found")
        expect_equal(len(left_behind(place)), 1, "copies after 'none'")
        t.keys("d", "1")
        t.sees("Belts of forest", lacks=("Unsaved changes were found", "Delete which"))
        expect("* fast" not in t.screen(), "the deleted work is there")
        t.keys("q")
        t.sees("READY>", lacks=("1 slope",))
        expect_equal(left_behind(place), [], "copies")


def leave_work(t, place):
    """Return unsaved work of a killed program."""
    pid = t.start("fast.yaml")
    t.edit("1234")
    until("a copy of the unsaved work", lambda: left_behind(place))
    kill(t, pid)


def kill(t, pid):
    os.kill(pid, signal.SIGKILL)
    until("killed", lambda: has_ended(pid))
    sane(t)


def test_recover_twice():
    """Killed again before a choice: the work is still offered at the next start."""
    with Place() as place, Tmux(place) as t:
        leave_work(t, place)
        kill(t, t.start("fast.yaml", sees=("Unsaved changes were found", "delete some")))
        kill(t, t.start("fast.yaml", sees=("Unsaved changes were found", "delete some")))


def test_recover_list():
    """Recoverable work on several scenes is one list with date and title; each is recovered in its own scene."""
    with Place() as place, Tmux(place) as t:
        place.write("other.yaml", FAST.replace("title: fast", "title: the mill"))
        leave_work(t, place)
        pid = t.start("other.yaml", sees=("1 slope", "the mill"))
        t.edit("1234")
        until("a copy of the other work", lambda: len(left_behind(place)) == 2)
        kill(t, pid)
        today = time.strftime("%Y-%m-%d")
        screen = t.start("fast.yaml", sees=("Unsaved changes were found", "delete some")) and t.screen()
        rows = re.findall(rf"{today} \d\d:\d\d, 0 min ago: ([^│]+?) *│", screen)
        expect_equal(rows, ["fast.yaml, fast", "other.yaml, the mill"], "this scene's first")
        t.keys("2")
        t.sees("changes recovered", "* the mill")
        t.keys("2")
        t.sees("stools per ha            1234")
        expect_equal(len(left_behind(place)), 2, "the other copy, and that of the work that was taken up")


def test_recover_escape():
    """Esc at the offer of left work does not destroy it: only 'delete some' does."""
    with Place() as place, Tmux(place) as t:
        leave_work(t, place)
        t.start("fast.yaml", sees=("Unsaved changes were found", "delete some"))
        t.keys("Escape")
        t.sees("Belts of forest", lacks=("Unsaved changes were found",))
        t.keys("q")
        t.sees("READY>", lacks=("1 slope",))
        t.start("fast.yaml", sees=("Unsaved changes were found", "delete some"))


def write_copies(place, n):
    """Write copies of n scenes that were never saved, the newest first: 'slope 1' of an hour ago, 'slope 2' of two hours ago …"""
    folder = place.path / "state/ceduo"
    folder.mkdir(parents=True, exist_ok=True)
    for i in range(1, n + 1):
        path = folder / f"{i:016x}-{i:016x}.yaml"
        path.write_text("# unsaved work on \"a new scene\"\n" + FAST.replace("title: fast", f"title: slope {i}"))
        os.utime(path, (time.time() - 3600 * i - 60,) * 2)


def test_recover_all():
    """A start without a scene offers every copy, also of other scenes and beyond the nine digits; a start with a scene does not"""
    with Place() as place, Tmux(place) as t:
        leave_work(t, place)
        pid = t.start("", sees=("Unsaved changes were found", "0 min ago: fast.yaml, fast"))
        kill(t, pid)
        pid = t.start("options.yaml")
        expect("Unsaved changes were found" not in t.screen(), "work on another scene")
        t.keys("q")
        t.sees("READY>", lacks=("1 slope",))
        write_copies(place, 11)
        screen = t.start("", sees=("Unsaved changes were found", "delete some")) and t.screen()
        rows = re.findall(r"│ (.) +20[-\d]+ [\d:]+, (\d+ \S+ ago): ([^│]+?) *│", screen)
        expect_equal([(key, name) for key, _, name in rows],
                     [("1", "fast.yaml, fast")] + [("23456789   "[i], f"never saved, slope {i + 1}") for i in range(11)], "copies, the newest first")
        expect_equal([age for _, age, _ in rows[1:]], [f"{i + 1} h ago" for i in range(11)], "ages")
        t.keys("d", "3")
        t.sees("Unsaved changes were found", "saved, slope 3 ", lacks=("saved, slope 2 ", "Delete which"))
        t.keys("d", "End", "Up", "Up", "Enter")  # past 'all' and 'none'
        t.sees("Unsaved changes were found", "saved, slope 10 ", lacks=("saved, slope 11 ", "Delete which"))
        t.keys(*["Down"] * 9, "Enter")
        t.sees("changes recovered", "* slope 10")
        expect_equal(len(left_behind(place)), 10, "9 copies of 12, and that of the work that was taken up")


def test_tour_and_left_work():
    """The tour keeps no copy of its edits, and offers left work after its end"""
    with Place() as place, Tmux(place) as t:
        write_copies(place, 1)
        t.start("--tour", sees=("Tour 1/10", "1 slope"))
        t.keys(*["Space"] * 10)  # a stand is added as an option
        t.sees("Tour 3/10", "simple-c", "* Test")
        t.text("zzz")
        t.tmux("resize-window", "-x", "100", "-y", "30")
        t.sees("Tour 3/10")
        expect_equal(len(left_behind(place)), 1, "copies during the tour")
        t.keys("Escape")
        t.sees("Unsaved changes were found", "never saved, slope 1", lacks=("Tour 3/10",))
        t.keys("n")
        t.sees("1 slope", "? help", lacks=("* Test", "Unsaved changes"))
        t.keys("q")
        t.sees("READY>", lacks=("1 slope",))
        expect_equal(len(left_behind(place)), 1, "copies after the tour")
        expect_in("cannot place the cursor", t.shell(f"TERM=dumb '{CEDUO}' --tour").replace("\n", ""))


def test_two_at_once():
    """A second program on the same scene is not offered the unsaved work of the running first one."""
    with Place() as place, Tmux(place) as t:
        t.start("fast.yaml")
        t.edit("1234")
        until("a copy of the unsaved work", lambda: left_behind(place))
        t.tmux("new-session", "-d", "-s", "second", "-x", "80", "-y", "24", "env", "-i",
               *[f"{k}={v}" for k, v in t.env.items()], CEDUO, "fast.yaml")
        screen = until("the second program's screen", lambda: (lambda s: "Belts of forest" in s and s)(
            t.screen("-t", "second:")))
        expect("Unsaved changes were found" not in screen and "* fast" not in screen, screen)


def test_closed_window():
    """Closing a window ends the program, and the work can be recovered."""
    with Place() as place, Tmux(place) as t:
        pid = t.start("fast.yaml")
        t.edit("1234")
        until("a copy of the unsaved work", lambda: left_behind(place))
        t.tmux("new-session", "-d", "-s", "other", "sh")  # keeps the server
        t.tmux("kill-session", "-t", "first")
        until("ended with its window", lambda: has_ended(pid))
        expect(left_behind(place), "the work is lost")


# ---- stopping during drawing ----

def run_job(arguments, env):
    """Act like a shell: start the program as a job, and continue it whenever it stops."""
    signal.signal(signal.SIGTTOU, signal.SIG_IGN)
    job = os.fork()
    if job == 0:
        os.setpgid(0, 0)
        os.tcsetpgrp(0, os.getpid())
        signal.signal(signal.SIGTTOU, signal.SIG_DFL)
        os.execve(CEDUO, [CEDUO, *arguments], env)
    while True:
        _, status = os.waitpid(job, os.WUNTRACED)
        if not os.WIFSTOPPED(status):
            os._exit(os.waitstatus_to_exitcode(status))
        os.killpg(job, signal.SIGCONT)


def stop_again_and_again(fd):
    """On the terminal of a continued job: a key, Ctrl-Z a moment later, and the expected screen."""
    fcntl.ioctl(fd, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
    os.set_blocking(fd, False)
    written = [b""]

    def writes(part):
        try:
            written[0] += os.read(fd, 65536)
        except BlockingIOError:
            pass
        return part in written[0]

    until("the first screen", lambda: writes(b"1 slope"))
    for i in range(400):
        os.write(fd, b"24"[i % 2:i % 2 + 1])
        time.sleep(i % 50 * 4e-5)
        written[0] = b""
        os.write(fd, b"\x1a")
        until(f"the terminal is given back at the Ctrl-Z of round {i}", lambda: writes(b"\x1b[?1049l"))
        written[0] = written[0].split(b"\x1b[?1049l", 1)[1]
        until(f"the screen comes back in round {i}", lambda: writes(b"1 slope"))
    os.write(fd, b"q")


def test_stop_while_drawing():
    """Ctrl-Z is never lost: 400 times, each at another moment of drawing a screen."""
    with Place() as place:
        pid, fd = pty.fork()
        if pid == 0:
            try:
                os.chdir(place.path)
                run_job(("fast.yaml",), {**home(place.path), "TERM": "xterm"})
            finally:
                os._exit(127)
        try:
            stop_again_and_again(fd)
            _, status = os.waitpid(pid, 0)
            expect_equal(os.waitstatus_to_exitcode(status), 0, "the status in the end")
        finally:
            os.close(fd)


# ---- unsuitable terminals ----

def in_pty(*arguments, env, cwd):
    """Run the program on a bare pseudo-terminal of 80x24; return its status and output."""
    pid, fd = pty.fork()
    if pid == 0:
        try:
            os.chdir(cwd)
            os.execve(CEDUO, [CEDUO, *arguments], env)
        finally:
            os._exit(127)
    fcntl.ioctl(fd, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
    out, end = b"", time.monotonic() + PATIENCE
    os.set_blocking(fd, False)
    while time.monotonic() < end:
        try:
            part = os.read(fd, 65536)
        except BlockingIOError:
            part = None
            time.sleep(0.01)
        except OSError:
            break
        if part == b"":
            break
        out += part or b""
    ended, status = os.waitpid(pid, os.WNOHANG)
    while not ended and time.monotonic() < end:
        time.sleep(0.01)
        ended, status = os.waitpid(pid, os.WNOHANG)
    if not ended:
        os.kill(pid, signal.SIGKILL)
        os.waitpid(pid, 0)
        raise Failure(f"not ended after {PATIENCE} s; it wrote {out[-2000:]!r}")
    os.close(fd)
    return os.waitstatus_to_exitcode(status), out


def test_no_terminal():
    """Without a terminal: status 2 and a hint to --batch, nothing on standard output."""
    with Place() as place:
        for stdin in (subprocess.DEVNULL, subprocess.PIPE):
            done = subprocess.run([CEDUO, "fast.yaml"], stdin=stdin, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                  env={**home(place.path), "TERM": "xterm"}, cwd=place.path, timeout=PATIENCE, check=False,
                                  start_new_session=True)
            expect(done.returncode == USAGE and done.stdout == b"" and b"--batch" in done.stderr, done)
            expect_equal(done.stderr.count(b"\n"), 1, "lines of the hint")


def test_dumb():
    """TERM=dumb, unknown or unset: the same hint, and no escape sequence."""
    with Place() as place:
        for term in ("dumb", "no-such-terminal", "", None):
            env = home(place.path)
            if term is not None:
                env["TERM"] = term
            status, out = in_pty("fast.yaml", env=env, cwd=place.path)
            expect(status == USAGE and b"--batch" in out, f"TERM={term}: status {status}, {out!r}")
            expect(b"\x1b" not in out and out.count(b"\n") == 1, f"TERM={term}: {out!r}")


def test_bad_scene():
    """A scene that cannot be read is reported on the plain screen, status 3."""
    with Place() as place:
        place.write("bad.yaml", "ceduo: scene/1\nrock: {diameter_m: -1}\n")
        status, out = in_pty("bad.yaml", env={**home(place.path), "TERM": "xterm"}, cwd=place.path)
        expect(status == 3 and b"bad.yaml:2:" in out and b"\x1b" not in out, status, out)


# ---- colours and letters ----

def test_ascii_locale():
    """LC_ALL=C: a screen in pure ASCII."""
    with Place() as place, Tmux(place, LC_ALL="C") as t:
        t.start("fast.yaml")
        for view in "12345?":
            t.keys(view)
            screen = t.sees("? help" if view != "?" else "Figures and pictures follow every edit at once")
            expect(screen.isascii(), screen)
        t.keys("Escape")


def read_colours(screen):
    """Return the colour codes of the sequences m; 39 and 49 are the terminal's own colours."""
    codes = [c for seq in re.findall(r"\x1b\[([\d;:]*)m", screen) for c in re.split("[;:]", seq)]
    return {c for c in codes if re.fullmatch(r"3[0-8]|4[0-8]|9\d|10\d", c)}


def test_no_color():
    """NO_COLOR: no colour sequences; the signs remain. Without it there are some."""
    for setting, wanted in (({}, True), ({"NO_COLOR": "1"}, False)):
        with Place() as place, Tmux(place, **setting) as t:
            t.start("fast.yaml")
            t.sees("road (80 m): ✔ YES, also without forest: ", "finished, ")
            for view in "12345":
                t.keys(view)
                t.sees("? help")
            t.keys("1")
            t.sees("Belts of forest")
            found = read_colours(t.screen("-e"))
            expect(bool(found) == wanted, f"{setting}: colours {found}")


def test_themes():
    """t cycles through dark, light and none; the third has no colours."""
    with Place() as place, Tmux(place) as t:
        t.start("fast.yaml")
        t.sees("finished, ")
        first = t.screen("-e")
        t.keys("t")
        second = until("another screen", lambda: (lambda s: s != first and s)(t.screen("-e")))
        t.keys("t")
        until("a screen without colours", lambda: not read_colours(t.screen("-e")))
        t.keys("t")
        until("the first again", lambda: t.screen("-e") == first)
        expect(read_colours(first) and second, first)


def test_sixteen_colours():
    """Colours are among the terminal's 16; a terminal of eight shows bright ones as bold."""
    for name, bright in (("tmux-256color", True), ("screen", False)):
        with Place() as place, Tmux(place, TERM=name) as t:
            t.start("wood.yaml")
            t.sees("finished, ")
            found = read_colours(t.screen("-e"))
            expect(found and not found & {"38", "48"}, f"{name}: colours {found}")
            expect_equal(any(len(code) > 1 and code[0] in "91" for code in found), bright, f"{name}: bright among {found}")


def press_mouse(t, button, x, y):
    """Press a button at a cell, counted from 1, and release it; 64 and 65 are the wheel, up and down."""
    if t.tmux("display-message", "-p", "#{mouse_sgr_flag}").strip() == "1":
        t.text(f"\x1b[<{button};{x};{y}M" + (f"\x1b[<{button};{x};{y}m" if button < 3 else ""))
    else:
        for code in (button, 3) if button < 3 else (button,):
            t.text("\x1b[M" + "".join(chr(32 + n) for n in (code, x, y)))


def test_mouse_like_keys():
    """A click and the wheel dismiss the message, and parts that follow the cursor follow them: view 2 has the form of the belt
    under the cursor."""
    with Place() as place, Tmux(place) as t:
        t.start("fast.yaml")
        t.keys("2")
        upper, lower = ("Stand of belt 1: upper", "stools per ha            3000"), ("Stand of belt 2: lower", "stools per ha            1000")
        t.sees(*upper)
        press_mouse(t, 0, 8, 6)
        t.sees(*lower)
        press_mouse(t, 64, 10, 10)
        t.sees(*upper)
        for button, y in ((0, 6), (64, 10), (0, 20), (0, 1)):
            t.keys("u")
            t.sees("nothing to undo")
            press_mouse(t, button, 8, y)
            t.sees("1 slope", lacks=("nothing to undo",))


def test_mouse():
    """A click on a view's name opens it, the wheel scrolls."""
    with Place() as place, Tmux(place) as t:
        t.start("fast.yaml")
        flags = t.tmux("display-message", "-p", "#{mouse_any_flag} #{mouse_sgr_flag}").split()
        expect("1" in flags, f"the program does not ask for the mouse: {flags}")

        def press(button, x, y):
            press_mouse(t, button, x, y)

        press(0, 12, 1)
        t.sees("stools per ha")
        press(0, 30, 10)
        t.sees("stools per horizontal hectare")
        press(0, 30, 10)
        t.sees("Esc cancel")
        t.keys("Escape")
        press(0, 4, 1)
        t.sees("Belts of forest")
        t.sees("from, m: where the belt begins")
        press(65, 10, 18)
        t.sees("counted at, m: where passing rocks are counted")
        press(64, 10, 18)
        t.sees("from, m: where the belt begins")


def test_click_and_wait():
    """After a click and its release the figures continue: the program does not wait for a key."""
    with Place() as place, Tmux(place) as t:
        t.start("paper-site") # its figures are not precise after 10240 rocks
        sgr = t.tmux("display-message", "-p", "#{mouse_sgr_flag}").strip() == "1"
        t.text("\x1b[<0;12;1M" if sgr else "\x1b[M ,!")
        t.sees("stools per ha")
        t.text("\x1b[<0;12;1m" if sgr else "\x1b[M#,!")
        time.sleep(0.1)
        t.sees("stools per ha", " 102400 rocks")


# ---- at rest ----

def test_idle():
    """An idle program uses no processor and writes nothing."""
    for scene, mark in (("fast.yaml", "finished, "), ("wood.yaml", "finished, ")):
        play_at_rest(scene, mark)


def play_at_rest(scene, mark):
    with Place() as place, Tmux(place) as t:
        pid = t.start(scene)
        t.sees(mark, " rocks")
        t.edit("1234")
        t.sees(mark, " rocks")

        def used():
            io = dict(line.split(": ") for line in Path(f"/proc/{pid}/io").read_text().splitlines())
            switches = re.findall(r"ctxt_switches:\s+(\d+)", Path(f"/proc/{pid}/status").read_text())
            return {"seconds": processor_seconds(pid), "written": int(io["wchar"]), "read": int(io["rchar"]),
                    "switches": [int(s) for s in switches]}

        # quiet first: the last picture is drawn, the last copy written
        last = [None]

        def quiet():
            now, before = used(), last[0]
            last[0] = now
            time.sleep(0.2)
            return now == before

        until("the program comes to rest", quiet)
        before = used()
        time.sleep(2)
        expect_equal(used(), before, "processor, bytes and switches after two seconds at rest")


def test_refining_ends():
    """On the paper's site the figures are refined until the mark shows the last level."""
    with Place() as place, Tmux(place) as t:
        t.start("paper-site")
        screen = until("figures that are refined no more", lambda: (lambda s: "finished, " in s and s)(t.screen()))
        expect(re.search(r"finished, \d{5,} rocks", screen), screen)
        expect(re.search(r"arrive +\d+±\d+ +\d+", screen) and re.search(r"energy % +[\d.]+ +≤ 5 ✘", screen), screen)


def test_live_wood():
    """A stand edited key by key: each time the figures with forest are new, the last ones belong to its final state."""
    with Place() as place, Tmux(place) as t:
        t.start("wood.yaml")
        t.edit("1234")
        for _ in range(20):
            t.keys("+")
        t.sees("stools per ha            3200")
        screen = until("figures that are refined no more", lambda: (lambda s: "finished, " in s and s)(t.screen()))
        found = re.search(r"arrive +(\d+)±\d+ +(\d+)", screen)
        rocks = re.search(r"finished, (\d+) rocks", screen).group(1)
        place.write("end.yaml", WOOD.replace("stools: {per_ha: 3000", "stools: {per_ha: 3200"))
        run = result("-n", rocks, place.path / "end.yaml")["options"][0]["controls"][-1]
        expect_equal([int(n) for n in found.groups()], [round(run[k]["reach_probability"] * 1000) for k in ("wooded", "bare")])
        t.keys("3")
        t.keys("/")
        t.sees("Search in this view")
        t.keys("C-u")
        t.text("contact_model")
        t.keys("Enter", "Enter")
        t.sees("not at all", "index")
        t.keys("Home", "Enter")
        t.sees("rocks among stems    index", "energy %        -        ?")
        t.keys("u")
        t.sees("rocks among stems    stems", "undone: ", lacks=("energy %        -        ?",))
        t.keys("s", "q")


def test_uncertainty_of_the_shown_option_first():
    """View 7 has the shown option first; its text stays when the others arrive"""
    with Place() as place, Tmux(place, 120, 40) as t:
        t.start("four-systems")
        t.keys("7")
        shown = r"^simple coppice, 25.* (\d+–\d+) +│"
        first = re.search(shown, t.sees("90 % range", "├"), re.M)
        all_of_them = until("the uncertainty of all options",
                            lambda: (lambda s: len(re.findall(r"^[a-z].*├.* \d+–\d+ +│", s, re.M)) >= 8 and s)(t.screen()))
        expect(first and first[1] == re.search(shown, all_of_them, re.M)[1], first, all_of_them)
        expect(re.search(r"│   90 % range +\d+–\d+$", all_of_them, re.M), all_of_them)
        t.keys("q")


def main():
    os.environ.pop("TMUX", None)
    if not shutil.which("tmux"):
        print("# no tmux here: most of these tests are skipped")
    suite = Suite()
    suite.run(list_tests(sys.modules[__name__]))
    suite.end()


if __name__ == "__main__":
    main()
