# SPDX-License-Identifier: GPL-3.0-or-later
"""Valid scenes with expensive rocks, and the time that the program needs to notice its end."""
import os
import pty
import signal
import subprocess
import time

from harness import CEDUO, PATIENCE, children_seconds, environment, expect, processor_seconds, scene, stand


def dense_trees(per_ha, **changes):
    """Return a forest of trees that take hardly any energy."""
    return stand(stools=None, shoots=None, trees=[{"per_ha": per_ha, "dbh_m": 0.02, "height_m": 10, "volume_m3": 1e-9}],
                 **changes)


def long_slope(metres, belts_to, per_ha, **changes):
    """Return a straight slope on which rocks never stop, with trees that do not stop them."""
    slope = {"vertices_m": [[0, metres / 2], [metres, 0]], "segments": [{"rn": 0.3, "rt": 0.99, "friction": 0.1}]}
    return scene(slope=slope, controls=[{"x_m": metres - 1}], release={"vx_m_s": 20},
                 forest=[{"from_m": 0, "to_m": belts_to, "stand": dense_trees(per_ha)}], **changes)


def rough_slope(vertices):
    """Return the maximum number of vertices of a file, over which a large rock rolls for ever."""
    points = [[i * 0.01, (vertices - i) * 0.005 + (i % 2) * 1e-4] for i in range(vertices)]
    return scene(rock={"diameter_m": 100}, slope={"vertices_m": points, "segments": [{"rn": 0, "rt": 1, "friction": 0}]},
                 release={"x_m": 1, "vx_m_s": 0.01}, controls=[{"x_m": (vertices - 2) * 0.01, "accepted_kJ": 1}])


LONG = {
    "a block of 15 x 0.51 x 1000 m": scene(rock={"shape": "block", "axes_m": [15, 0.51, 1000]},
                                           forest=[{"from_m": 0, "to_m": 90, "stand": stand()}]),
    "a forest of a million km": long_slope(1e9, 1e9 - 1, 1000),
    "a million trees per hectare": long_slope(1e5, 1e5 - 1, 1e6),
    "a slope of 80 000 vertices": rough_slope(80000),
}


class Running:
    """The running program; `with Running(…) as r:`."""

    def __init__(self, *arguments, terminal=False):
        command = [CEDUO, *map(str, arguments)]
        if terminal:
            pid, self.fd = pty.fork()
            if pid == 0:
                os.environ.clear()
                os.environ.update(environment(TERM="xterm", LINES="24", COLUMNS="80"))
                os.execv(CEDUO, command)
            self.pid, self.process = pid, None
        else:
            self.fd = None
            self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                            stderr=subprocess.DEVNULL, env=environment())
            self.pid = self.process.pid

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.pid:
            os.kill(self.pid, signal.SIGKILL)
            os.waitpid(self.pid, 0)
        if self.process:
            self.process.returncode = 0
        if self.fd is not None:
            os.close(self.fd)

    def read(self, seconds, until=None):
        """Discard the terminal program's output, so that it never blocks."""
        os.set_blocking(self.fd, False)
        end, seen = time.monotonic() + seconds, b""
        while time.monotonic() < end and not (until and until in seen):
            try:
                seen += os.read(self.fd, 65536)
            except (BlockingIOError, OSError):
                time.sleep(0.001)

    def work(self, seconds):
        """Let it work for some time, a terminal program from its first screen on; it must not finish."""
        if self.fd is not None:
            self.read(PATIENCE, b"quit")
            self.read(seconds)
        else:
            time.sleep(seconds)
        expect(os.waitpid(self.pid, os.WNOHANG)[0] == 0, "it ended before it was told to")

    def end(self, tell):
        """Ask it to end and wait; return how it ended, and the seconds of clock and processor it needed."""
        before, begin = children_seconds() + processor_seconds(self.pid), time.monotonic()
        tell()
        while time.monotonic() < begin + PATIENCE:
            if self.fd is not None:
                self.read(0.0005)
            pid, status = os.waitpid(self.pid, os.WNOHANG)
            if pid:
                self.pid = 0
                return status, (time.monotonic() - begin, children_seconds() - before)
            time.sleep(0.0005)
        expect(False, f"still running {PATIENCE} s later")

    def end_by_signal(self, number):
        status, seconds = self.end(lambda: os.kill(self.pid, number))
        expect(os.WIFSIGNALED(status) and os.WTERMSIG(status) == number, f"ended by {number} as {status}")
        return seconds

    def end_by_key(self, key):
        status, seconds = self.end(lambda: os.write(self.fd, key.encode()))
        expect(os.WIFEXITED(status) and os.WEXITSTATUS(status) == 0, f"ended by {key!r} as {status}")
        return seconds
