#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Measure how soon a signal, or q in the terminal program, ends it during expensive rocks, in ms."""
import signal
import statistics
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
from harness import Folder  # noqa: E402
from long_scenes import LONG, Running  # noqa: E402

TIMES = 5
WAYS = {"SIGTERM, JSON": (("--batch", "-f", "json", "-n", 1e7), lambda r: r.end_by_signal(signal.SIGTERM)),
        "SIGINT, page": (("--batch", "-n", 1e7), lambda r: r.end_by_signal(signal.SIGINT)),
        "SIGINT, picture": (("--plot", "profile", "-n", 1e7), lambda r: r.end_by_signal(signal.SIGINT)),
        "SIGTERM, terminal": ((), lambda r: r.end_by_signal(signal.SIGTERM)),
        "q, terminal": ((), lambda r: r.end_by_key("q"))}


def main():
    print("scene,ended_by,median_ms,most_ms")
    for name, what in LONG.items():
        with Folder() as f:
            path = f.write("long.yaml", what)
            for way, (arguments, end) in WAYS.items():
                seconds = []
                for i in range(TIMES):
                    with Running(*arguments, path, terminal=not arguments) as r:
                        r.work(0.6 + 0.07 * i)
                        seconds.append(end(r)[0] * 1000)
                print(f"{name},\"{way}\",{statistics.median(seconds):.1f},{max(seconds):.1f}", flush=True)


main()
