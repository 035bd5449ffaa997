#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random keys: no crash, no hang, no lost scene, nothing written outside the folder.

KEYS=100000 sets the number of keys (default 3000); SEED=7 sets the first seed. A failure prints the command to repeat it.
"""
import os
import random
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from play import FAST, Place, actions, home  # noqa: E402
from harness import CEDUO, PATIENCE, PROFILES, ROOT, Failure, Suite, expect  # noqa: E402

KEYS = int(os.environ.get("KEYS") or 3000)
SEED = int(os.environ.get("SEED") or 1)
RUN = 250  # keys per run of the program

# Files that a save may write. Not other.yaml, which a confirmed export may overwrite.
OWN = ("fast.yaml", "options.yaml", "wood.yaml", "cuts.yaml", "csv.yaml", "paper-site.yaml", "four-systems.yaml", "scene.yaml")
CSV = "distance,elevation\n0,100\n20,70\n50,50\n90,35\n130,30\n"
SCENES = ["fast.yaml", "options.yaml", "wood.yaml", "cuts.yaml", "paper-site", "four-systems", "csv.yaml"]
WORDS = ["0", "1", "-1", "0.5", "12.75", "3000", "1e9", "1e-9", "1e400", "nan", "inf", "0,5", "true", "sphere", "[1, 2]",
         "[60, 31]", "{}", "{mean: 0.5, spread: 0.1}", "{mean: 0.4, spread: 9, kind: uniform}", "abc", "a b  c", "'", '"', "#",
         ":", "- x", "&a *a", "!!x", "%", "\\", "Über", "日本語", "🪨", "e\u0301", "\u200b", "\u202e", "x" * 300, "~", "null",
         "simple-coppice", "bare", "stems", "index", "ads-1.yaml", "../stands/ads-2.yaml", "line.csv", "none.csv", "other.yaml",
         "out.txt", "0 60, 20 35, 60 20", "stools", "dbh", "slope", "horizontal", "40"]
MOVES = ["Up", "Down", "Left", "Right", "j", "k", "h", "l", "Home", "End", "g", "G", "PgUp", "PgDn", "Tab", "Shift-Tab"]


def words_of_keys():
    return sorted({w for _, word, word2, _, _ in actions() for w in (word, word2) if w}) + ["Esc", "Backspace", "Ctrl-U", "F8",
                                                                                             "F9", "Space"]


def random_script(rng, names, keys):
    """Return lines of a script with this many keys. Typed text counts a key per character."""
    lines, left = [], keys
    while left > 0:
        kind = rng.random()
        if kind < 0.42:
            some = [rng.choice(names) for _ in range(rng.randint(1, 6))]
        elif kind < 0.62:
            some = [rng.choice(MOVES) for _ in range(rng.randint(1, 10))]
        elif kind < 0.72:
            some = [rng.choice("aydpcwson5u+-<>=_")] + ["Enter"] * rng.randint(0, 3)
        elif kind < 0.77:
            some = [chr(rng.choice([rng.randint(33, 126), rng.randint(0xa1, 0x17f), rng.randint(0x3000, 0x30ff)]))
                    for _ in range(rng.randint(1, 8))]
        elif kind < 0.93:
            lines += ["key " + rng.choice(["Enter", "Enter Ctrl-U", "/", "Enter End", "Ctrl-U"]), "type " + rng.choice(WORDS),
                      "key " + rng.choice(["Enter", "Enter", "Enter", "Tab", "Esc", "Enter Enter"])]
            left -= 4
            continue
        else:
            lines.append(rng.choice(["resize 80 24", "resize 120 40", "resize 60 16", "resize 59 15", "resize 200 50",
                                     "resize 1 1", "resize 33 7", "dump screen.txt", "dump screen.txt", "dump screen.txt",
                                     "roles roles.txt"]))
            continue
        # q would end the run if nothing is unsaved: it comes last
        some = [k for k in some if k not in ("q", "F10") or rng.random() < 0.03]
        if some:
            lines.append("key " + " ".join(some))
        left -= len(some)
        if rng.random() < 0.3:
            lines.append("dump screen.txt")
    return "\n".join(lines + ["dump screen.txt", "key Esc Esc q"]) + "\n"


def stamp(folder):
    return {str(p.relative_to(folder)): (p.stat().st_mtime_ns, p.stat().st_size) for p in folder.rglob("*") if p.is_file()}


def yaml_files(folder):
    return sorted(p for p in folder.iterdir() if p.name in OWN)


def run_once(seed, names):
    rng = random.Random(seed)
    scene, charset = rng.choice(SCENES), rng.choice(["braille", "block", "ascii"])
    with Place() as place:
        place.write("line.csv", CSV)
        place.write("csv.yaml", FAST[:FAST.index("slope:")] + "slope: {csv: line.csv}\n" + FAST[FAST.index("controls:"):])
        work = place.path / "work"
        work.mkdir()
        for name in ("fast.yaml", "options.yaml", "wood.yaml", "cuts.yaml", "csv.yaml", "line.csv"):
            (place.path / name).rename(work / name)
        (work / "other.yaml").write_text(FAST)
        (work / "play.txt").write_text(random_script(rng, names, RUN))
        before = {p: p.read_text() for p in yaml_files(work)}
        command = [CEDUO, "--script", "play.txt", "--charset", charset, scene]
        again = f"SEED={seed} KEYS={RUN} CEDUO={CEDUO} {sys.argv[0]} plays this again; scene {scene}, {charset}"
        try:
            done = subprocess.run(command, cwd=work, env=home(place.path), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, timeout=PATIENCE, check=False, start_new_session=True)
        except subprocess.TimeoutExpired as late:
            raise Failure(again, "hangs") from late
        err = done.stderr.decode("utf-8", "replace")
        # a typed file name may be invalid: the screen reports it, and the script continues
        expect(done.returncode == 0 and err == "", again, f"status {done.returncode}", err[:6000])
        for path in yaml_files(work):
            if before.get(path) == path.read_text():
                continue
            check = subprocess.run([CEDUO, "--check", path.name], cwd=work, env=home(place.path), stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=PATIENCE, check=False)
            expect(check.returncode == 0, again, f"{path.name} on disk is no valid scene:", check.stdout.decode()[:2000],
                   path.read_text()[:2000])
        for path in before:
            expect(path.exists(), again, f"{path.name} is lost")
        strange = [p.name for p in place.path.iterdir() if p.name not in ("work", "state", "data", "config", "cache", ".local", "wood.yaml", "cuts.yaml")]
        expect(not strange, again, f"written beside the working folder: {strange}")


def play_seeds(names, first, count, start):
    for seed in range(first, first + count):
        run_once(seed, names)
        if (seed - first) % 40 == 39:
            print(f"# {seed - first + 1} runs in {time.monotonic() - start:.0f} s", flush=True)


def main():
    suite = Suite()
    names, start = words_of_keys(), time.monotonic()
    profiles, tree = stamp(PROFILES), sorted(p.name for p in ROOT.iterdir())
    runs = max(1, -(-KEYS // RUN))
    some = max(1, runs // 4)
    for first in range(SEED, SEED + runs, some):
        count = min(some, SEED + runs - first)
        suite.check(f"{count * RUN} random keys, seeds {first} to {first + count - 1}", play_seeds, names, first, count, start)
    suite.check("the program's own scenes are as they were", lambda: expect(stamp(PROFILES) == profiles, "changed"))
    suite.check("nothing new stands in the source tree",
                lambda: expect(not set(p.name for p in ROOT.iterdir()) - set(tree) - {"build", "ceduo"}, "something new"))
    suite.end()


if __name__ == "__main__":
    main()
