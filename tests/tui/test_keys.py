#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Terminal input that is no key: unknown sequences, and pastes."""
import base64
import fcntl
import os
import pty
import re
import signal
import struct
import sys
import termios
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import FAST, Place, home  # noqa: E402
from test_terminal import ASAN, Tmux, until  # noqa: E402
from harness import CEDUO, Suite, expect, expect_equal, expect_in, list_tests  # noqa: E402

ON, OFF = b"\x1b[?2004h", b"\x1b[?2004l"

# their letters are keys: 's' saves, 'n' and 'o' ask for another scene, 'q' quits
UNKNOWN = {"CSI": "\x1b[99;99s", "CSI with a private mark": "\x1b[?1;2c", "CSI with an intermediate": "\x1b[1;2 q",
           "CSI of one letter": "\x1b[s", "a function key of Linux": "\x1b[[s", "SS3": "\x1bOs",
           "OSC to BEL": "\x1b]11;rgb:qsno\a", "OSC to ST": "\x1b]52;c;qsno\x1b\\", "DCS": "\x1bP1+qsno=qs\x1b\\",
           "Alt with s": "\x1bs", "Alt with q": "\x1bq", "Alt with a letter of another alphabet": "\x1b\u0436",
           "C1 CSI": "\x9b99;99s", "C1 CSI of one letter": "\x9bs", "C1 SS3": "\x8fs", "C1 OSC to ST": "\x9d52;c;qsno\x9c",
           "C1 DCS": "\x90qsno\x1b\\", "C1 that begins nothing": "\x85",
           "APC": "\x1b_qsno\x1b\\", "PM": "\x1b^qsno\x1b\\", "SOS": "\x1bXqsno\x1b\\",
           "one after the other": "\x1b[9s\x1b[9s\x1bOs\x1b]s\x1b[9s"}
PAUSE = 0.1  # longer than Esc waits, shorter than the limit that makes a key of an incomplete sequence


def changed(t, scene="fast.yaml"):
    """Return a scene with an unsaved edit, at the diameter of the rock."""
    t.start(scene)
    t.keys("3")
    t.sees("diameter")
    t.keys("+")
    t.sees("* fast")


def unharmed(t, place, what):
    """Expect no change since the edit: a last key shows that all earlier input was read."""
    t.keys("2")
    t.sees("stools per ha", "* fast", lacks=("saved ",))
    expect_equal(place.text("fast.yaml"), FAST, f"the file after {what}")
    t.keys("3")
    t.sees("diameter", "* fast")


# ---- sequences ----

def test_unknown():
    """Unknown sequences are swallowed whole."""
    with Place() as place, Tmux(place) as t:
        changed(t)
        for what, sequence in UNKNOWN.items():
            t.text(sequence)
            unharmed(t, place, what)


def test_in_pieces():
    """The same in two reads, cut anywhere after their second byte."""
    with Place() as place, Tmux(place) as t:
        changed(t)
        for what, sequence in UNKNOWN.items():
            if len(sequence) < 3 - (sequence[0] > "\x80"):
                continue  # Esc alone is a key
            for cut in (2 - (sequence[0] > "\x80"), len(sequence) - 1):
                t.text(sequence[:cut])
                time.sleep(PAUSE)
                t.text(sequence[cut:])
                unharmed(t, place, f"{what}, cut at {cut}")


def test_string_in_the_help():
    """A string whose end arrives in two pieces is no Esc: an open list stays open."""
    with Place() as place, Tmux(place) as t:
        t.start("fast.yaml")
        t.keys("w")
        t.sees("Export", "search:")
        t.text("\x1b]11;rgb:0\x1b")
        time.sleep(PAUSE)
        t.text("\\")
        t.text("json")
        t.sees("Export", "search: json")


def test_escape_goes_on():
    """Esc works at once and before a separate key; followed directly by a character it is Alt, which does nothing; Alt with a
    bracket delays keys by at most a second."""
    with Place() as place, Tmux(place) as t:
        t.start("fast.yaml")
        for after in ("", "\x1b", "\x1b[B", "\x1b[M ,!"):
            t.keys("1", "w")
            t.sees("Export", "search:")
            t.text("\x1b" + after)
            t.sees("stools per ha" if after == "\x1b[M ,!" else "Belts of forest", lacks=("search:",))
        t.keys("1", "w")
        t.sees("Export", "search:")
        t.text("\x1b2j")
        t.sees("Export", "search: j")
        t.keys("Escape")
        t.sees("Belts of forest", lacks=("search:",))
        for held in ("\x1b[", "\x1bO", "\x1b]"):
            t.keys("1")
            t.sees("Belts of forest")
            t.text(held)
            time.sleep(3)  # a second, plus the delay of a busy machine
            t.keys("2")
            t.sees("stools per ha")


def test_known():
    """Arrows, Home, End, PgUp, PgDn, Del, Shift-Tab and function keys of three terminals, with and without colour."""
    for changes in ({"TERM": "tmux-256color"}, {"TERM": "xterm"}, {"TERM": "linux", "NO_COLOR": "1"}):
        linux = changes["TERM"] == "linux"
        with Place() as place, Tmux(place, **changes) as t:
            t.start("fast.yaml")
            t.text("\x1b[[A" if linux else "\x1bOP")
            t.sees("Figures and pictures follow every edit at once")
            t.text("\x1b[6~")
            t.sees("redo", lacks=("Figures and pictures follow every edit at once",))
            t.text("\x1b[5~")
            t.sees("Figures and pictures follow every edit at once")
            t.keys("Escape")
            t.sees("Belts of forest", lacks=("Figures and pictures follow every edit at once",))
            arrow = "\x1b[" if linux else "\x1bO"
            t.text(f"{arrow}B{arrow}C")
            t.sees("to, m: where the belt ends")
            t.text(f"{arrow}D")
            t.sees("from, m: where the belt begins")
            t.text("\x1b[3~")
            t.sees("deleted: belt 2")
            t.keys("3")
            t.sees("shape: shape of the rock")
            ends = [arrow, "\x1b[", "\x1bO"]
            for end, home in [(f"{a}F", f"{a}H") for a in ends] + [("\x1b[4~", "\x1b[1~"), ("\x1b[8~", "\x1b[7~")]:
                t.text(end)
                t.sees("note: anything else")
                t.text(home)
                t.sees("shape: shape of the rock")


# ---- pastes ----

def paste(t, text):
    """Paste like tmux: between the two sequences if the program asked for them, otherwise as keys."""
    t.tmux("set-buffer", "--", text)
    t.tmux("paste-buffer", "-p", "-r")


def test_paste_nowhere():
    """Outside input fields a paste does nothing, with a message."""
    with Place() as place, Tmux(place) as t:
        changed(t)
        for text in ("s", "\x1b[<0;12;1M\x1b[M ,!", "qsno\nwdd\r\n", "\x1b[99s", "2\x1bOs", "s" * 5000):
            paste(t, text)
            t.sees("nothing pasted: no field is open")
            unharmed(t, place, repr(text[:20]))


def test_paste_field():
    """A paste goes into the open field: line ends become one blank, no key is executed."""
    with Place() as place, Tmux(place) as t:
        t.start("fast.yaml")
        t.keys("3", "/")
        t.text("title")
        t.keys("Enter")
        t.sees("title  ")
        t.keys("Enter")
        t.sees("Esc cancel")
        paste(t, "\n  Über\tdem\r\n\x15 Weg\x01!\n")
        t.sees("Esc cancel", "Über dem  Weg!")
        t.keys("BSpace")
        paste(t, " x" * 600)
        t.sees("too long for this line", "Esc cancel")
        t.keys("Enter")
        t.sees("*   Über dem", "Über dem  Weg", lacks=("Esc cancel",))


def test_paste_in_pieces():
    """A slow paste in pieces is one, also if its end is cut."""
    with Place() as place, Tmux(place) as t:
        changed(t)
        for piece in ("\x1b[20", "0~sq", "s\x1b", "[20", "1~"):
            t.text(piece)
            time.sleep(PAUSE)
        t.sees("nothing pasted")
        unharmed(t, place, "a paste in pieces")


def test_paste_list():
    """In a list and in fields a paste is typed text; in a read-only text it does nothing."""
    with Place() as place, Tmux(place) as t:
        t.start("fast.yaml")
        t.keys("w")
        t.sees("Export", "search:")
        paste(t, "json\n")
        t.sees("search: json", "JSON", lacks=("CSV",))
        t.keys("Escape")
        t.sees("Belts of forest", lacks=("search:",))
        t.keys("/")
        t.sees("Search in this view")
        paste(t, "accepted_kJ\n")
        t.sees("Search in this view", "accepted_kJ")
        paste(t, "x" * 1100)
        t.sees("too long for this line")
        t.keys("Escape")
        t.sees("Belts of forest", lacks=("Search in this view",))
        t.keys("?")
        t.sees("Figures and pictures follow every edit at once")
        paste(t, "q")
        t.sees("Figures and pictures follow every edit at once", "nothing pasted")
        t.keys("Escape")
        t.sees("Belts of forest", lacks=("Figures and pictures", "nothing pasted"))


def test_paste_without_end():
    """Ctrl-C ends a paste whose end is lost."""
    with Place() as place, Tmux(place) as t:
        t.start("fast.yaml")
        t.text("\x1b[200~qq")
        time.sleep(1.5)
        t.keys("2")
        time.sleep(1.5)
        t.sees("Belts of forest")
        t.keys("C-c")
        time.sleep(PAUSE)
        t.keys("2")
        t.sees("stools per ha")


# ---- terminal modes ----

class Pty:
    """The program on a bare pseudo-terminal, and all its output."""

    def __init__(self, place, term, **changes):
        self.out = b""
        self.pid, self.fd = pty.fork()
        if self.pid == 0:
            try:
                os.chdir(place.path)
                os.execve(CEDUO, [CEDUO, "fast.yaml"], {**home(place.path), "TERM": term, **changes})
            finally:
                os._exit(127)
        fcntl.ioctl(self.fd, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
        os.set_blocking(self.fd, False)
        self.writes(b"1 slope")

    def read(self):
        try:
            self.out += os.read(self.fd, 65536)
        except (BlockingIOError, OSError):
            pass
        return self.out

    def writes(self, part):
        until(lambda: f"{part} in {self.out[-2000:]!r}", lambda: part in self.read())

    def end(self, by):
        """End it by a key or a signal; return all its output."""
        if isinstance(by, bytes):
            os.write(self.fd, by)
        else:
            os.kill(self.pid, by)
        until("the program ends", lambda: self.read() and os.waitpid(self.pid, os.WNOHANG)[0] == self.pid)
        for _ in range(10):
            self.read()
        os.close(self.fd)
        return self.out


def test_copy():
    """Y copies the view's text to the terminal's clipboard, its form fully and without its picture; through tmux too; the Linux
    console cannot, with a message"""
    with Place() as place:
        for changes in ({}, {"TMUX": "/tmp/tmux-1000/default,1,0"}):
            program = Pty(place, "xterm", **changes)
            program.writes(b"finished")
            os.write(program.fd, b"Y")
            program.writes(b"copied: ")
            out = program.end(b"q")
            plain = re.findall(rb"(?<!\x1b)\x1b\]52;c;([A-Za-z0-9+/]+=*)\a", out)
            passed = re.findall(rb"\x1bPtmux;\x1b\x1b\]52;c;([A-Za-z0-9+/]+=*)\a\x1b\\", out)
            expect_equal((len(plain), passed), (1, plain if changes else []), "what is written for the terminal and for tmux")
            text = base64.b64decode(plain[0], validate=True).decode()
            expect_equal(text.split("\n")[0], "fast: current")
            said = int(re.search(rb"copied: +(\d+)", re.sub(rb"\x1b\[[\d;]*[A-Za-z]", b" ", out)).group(1))
            head = text.split("\n\n")[0].split("\n")
            expect(len(head) == 2 and "kJ" in head[1], "scene and option, and the answer:", text)
            expect_equal(said, len([line for line in text.split("\n")[2:] if line]), "lines, but for these")
            for part in ("track", "road", "\n1   5 ", "0.98", "\n2   60 30\n", "\n3   100 0\n"):
                expect_in(part, text, "what was copied")
            expect(not re.search("[\u2800-\u28ff│\x1b]", text), "a picture, or the column beside the view, in", text)
        program = Pty(place, "linux")
        os.write(program.fd, b"Y")
        program.writes(b"no clipboard")
        expect(b"]52;" not in program.end(b"q"), "written to the console")


def test_paste_of_signals():
    """Ctrl-C, Ctrl-Z and Ctrl-\\ in a paste are its text; the key that comes after it is a key"""
    with Place() as place:
        program = Pty(place, "xterm")
        os.write(program.fd, b"\x1b[200~a\x03q\x1a\x1cq\x1b[201~")
        program.writes(b"nothing pasted")
        os.write(program.fd, b"3G\r\x15\x1b[200~a\x03b\x1ac\x1b[201~")
        program.writes(b"abc")
        os.write(program.fd, b"\x03")  # leaves the field
        os.write(program.fd, b"\x03")
        until("the program ends", lambda: program.read() and os.waitpid(program.pid, os.WNOHANG)[0] == program.pid)
        expect_equal(place.text("fast.yaml"), FAST)


def test_quit():
    """Ctrl-\\ ends the program by its signal, with the terminal restored"""
    with Place() as place:
        program = Pty(place, "xterm")
        os.write(program.fd, b"\x1c")
        ended = until("the program ends", lambda: (lambda pid, status: pid and [status])(*os.waitpid(program.pid, os.WNOHANG)))
        expect(os.WIFSIGNALED(ended[0]) and os.WTERMSIG(ended[0]) == signal.SIGQUIT, ended)
        expect(OFF in program.read(), program.out[-300:])


def test_asked():
    """The terminal is asked to mark pastes, until any end of the program."""
    ends = [b"q", signal.SIGTERM, signal.SIGHUP] + ([] if ASAN else [signal.SIGSEGV, signal.SIGABRT])
    for by in ends:
        with Place() as place:
            program = Pty(place, "xterm")
            program.writes(ON)
            out = program.end(by)
            expect(OFF in out.rsplit(ON, 1)[1], f"ended by {by}: {out[-300:]!r}")


def test_not_asked():
    """The Linux console does not mark pastes and is not asked."""
    with Place() as place:
        expect(b"?2004" not in Pty(place, "linux").end(b"q"), "asked")


def test_asked_again():
    """Suspended, the terminal marks no pastes for the shell; it does again when the program continues."""
    with Place() as place, Tmux(place) as t:
        place.write("shell.sh", "stty -icanon min 1 -echo; printf 'READ>'; dd bs=1 count=4 2>&- | od -An -c; stty sane\n")
        changed(t)
        t.keys("C-z")
        t.sees("READY>", lacks=("1 slope",))
        t.text("clear; sh shell.sh")
        t.keys("Enter")
        t.sees("READ>")
        paste(t, "abcd")
        t.sees("a   b   c   d")
        t.text("fg")
        t.keys("Enter")
        t.sees("1 slope", "* fast")
        paste(t, "s")
        t.sees("nothing pasted")
        unharmed(t, place, "Ctrl-Z and fg")


def main():
    os.environ.pop("TMUX", None)
    suite = Suite()
    suite.run(list_tests(sys.modules[__name__]))
    suite.end()


if __name__ == "__main__":
    main()
