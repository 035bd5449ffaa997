#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: slow
"""Failures of the machine: no memory, a full disk, failing calls, sudden death, no threads, closed streams.

A library that is loaded before the C library (faults.c) makes one call after the other fail.
"""
import functools
import itertools
import os
import resource
import shlex
import shutil
import subprocess
import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parent), str(Path(__file__).resolve().parents[1] / "tui")]
from harness import (CEDUO, DONE, FULL, INPUT, OUTPUT, PATIENCE, RUN, SANITIZED, USAGE, Folder, Skip,  # noqa: E402
                     environment, expect, expect_equal, expect_in, good, only_text, run_all)
from play import FAST, Screen  # noqa: E402
from test_calibrate import quarry  # noqa: E402
from test_input import FILES  # noqa: E402

FEW = 1000  # allocations
VARIANT = Path(os.environ.get("BUILD", "build/release")).name


@functools.cache
def library():
    """Compile faults.c."""
    with Folder() as f:
        subprocess.run([*shlex.split(os.environ.get("CC") or "gcc"), "-D_GNU_SOURCE", "-shared", "-fPIC", "-O1", "-o", f.path / "faults.so",
                        Path(__file__).parent / "faults.c", "-ldl"], check=True)
        return (f.path / "faults.so").read_bytes()


class Place(Folder):
    """A folder with the three files, and the library."""

    def __enter__(self):
        super().__enter__()
        for name, text in FILES.items():
            self.write(f"work/{name}", text)
        self.work = self.path / "work"
        self.preload = self.path / "faults.so"
        self.preload.write_bytes(library())
        return self

    def with_fault(self, fault, at=0, on=False, after=None):
        """Return the environment of a program with the fault. `after`: only after this file was written."""
        if SANITIZED:
            raise Skip("the sanitizers have their own malloc")
        mark = self.path / "mark"
        mark.unlink(missing_ok=True)
        return environment(LD_PRELOAD=str(self.preload), FAULT=fault, FAULT_AT=str(at), FAULT_MARK=str(mark),
                           FAULT_ON="1" if on else None, FAULT_FROM=after)

    def run(self, *words, **fault):
        """Run the program with the fault. Returns whether the fault occurred."""
        mark = self.path / "mark"
        done = subprocess.run([CEDUO, *map(str, words)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                              env=self.with_fault(**fault), cwd=self.work, timeout=PATIENCE, check=False)
        only_text(done.stdout, "stdout")
        only_text(done.stderr, "stderr")
        return done, mark.exists()

    def allocations(self, *words, after=None):
        """Return indices of allocations to fail: the first of each call path, and one after all. With FULL all, unless there
        are many: a page makes tens of thousands, mostly for uncertainty."""
        ways = self.path / "ways"
        env = self.with_fault("ways", after=after) | {"FAULT_WAYS": str(ways)}
        subprocess.run([CEDUO, *map(str, words)], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, env=env, cwd=self.work, check=True)
        found = ways.read_text().split()
        if FULL and len(found) < FEW:
            return itertools.count(1)
        first = {way: len(found) - n for n, way in enumerate(reversed(found))}
        print(f"# {len(found)} allocations, {len(first)} ways")
        return [*sorted(first.values()), 10 * len(found)]


def describe_end(done, at):
    return f"at {at}: status {done.returncode}\n{done.stdout[:500]!r}\n{done.stderr[:800]!r}"


# ---- memory ----

def no_memory(words, on):
    """Allocations fail in turn: status 1 or 3 and 'out of memory', or the usual result."""
    with Place() as place:
        wanted, _ = place.run(*words, fault="none")
        expect_equal(wanted.returncode, DONE, wanted.stderr)
        plain = subprocess.run([CEDUO, *map(str, words)], stdout=subprocess.PIPE, env=environment(LC_ALL="C"), cwd=place.work,
                               check=False).stdout  # a locale needs memory, too
        failed = 0
        for at in place.allocations(*words):
            done, reached = place.run(*words, fault="memory", at=at, on=on)
            if not reached:
                break
            if done.returncode == DONE:
                expect(done.stdout in (wanted.stdout, plain) and done.stderr == b"", describe_end(done, at))
                continue
            failed += 1
            expect(done.returncode in (RUN, INPUT, USAGE) and b"out of memory" in done.stderr, describe_end(done, at))
            expect(done.returncode != USAGE or b"try 'ceduo --help'" in done.stderr, describe_end(done, at))
            expect_equal(done.stdout, b"", describe_end(done, at))
            expect_equal(sorted(p.name for p in place.work.iterdir()), sorted(FILES), describe_end(done, at))
        expect(not reached, at)
        print(f"# {failed} end the program")
        expect(failed > 20, f"{failed} failures: is the library loaded?")


CERTAIN = () if FULL else ("-s", "uncertainty=none")  # uncertainty takes most of a page's time
BATCH = ("--batch", "-f", "csv", "-n", 20, "-j", 1, "scene.yaml")


def test_memory_check():
    """Allocations of --check fail once: status 1 or 3 with 'out of memory', or success"""
    no_memory(("--check", "scene.yaml"), False)


def test_memory_check_on():
    """All allocations of --check fail from one on: status 1 or 3, 'out of memory'"""
    no_memory(("--check", "scene.yaml"), True)


def test_memory_batch():
    """Allocations of a run with CSV fail once"""
    no_memory(BATCH, False)


def test_memory_batch_on():
    """All allocations of a run fail from one on"""
    no_memory(BATCH, True)


def test_memory_page():
    """Allocations of a run with its page, and of one with a change and years, fail once"""
    no_memory(("--batch", "-n", 20, "-j", 1, *CERTAIN, "scene.yaml"), False)
    no_memory(("--years", "0:3", "-f", "json", "-n", 2, "-j", 1, "-s", "forest[0].stand.stools.spacing_m=0.5", "scene.yaml"), True)


def test_memory_plot():
    """All allocations of a picture fail from one on"""
    no_memory(("--plot", "profile", "-n", 20, "-j", 1, "scene.yaml"), True)


def test_memory_survey():
    """Allocations of a survey fail once, and in check-all from one on"""
    for on in (False, True) if FULL else (False,):
        no_memory(("--survey", "six-plots.csv", "-q"), on)


def test_memory_output():
    """Allocations of a run that writes a file fail once: the old file is complete, or the new one"""
    with Place() as place:
        out = place.work / "out.csv"
        place.run(*BATCH, "-o", "out.csv", fault="none")
        new = out.read_bytes()
        for at in place.allocations(*BATCH, "-o", "out.csv"):
            out.write_text("old")
            done, reached = place.run(*BATCH, "-o", "out.csv", fault="memory", at=at)
            expect(done.returncode in (DONE, RUN, USAGE, INPUT, OUTPUT), describe_end(done, at))
            expect_equal(out.read_bytes(), new if done.returncode == DONE else b"old", describe_end(done, at))
            expect_equal(sorted(p.name for p in place.work.iterdir()), sorted([*FILES, "out.csv"]), describe_end(done, at))
            if not reached:
                break


def save_without_memory(on):
    """A change and a save: done and reported, or the program ends; the file is the old one or the new one."""
    with Place() as place:
        place.write("play.txt", "key 3 Down\nkey Enter Ctrl-U\ntype 0.75\nkey Enter\ndump before.txt\nkey s\ndump after.txt\n")
        scene, command = place.work / "scene.yaml", ("--script", "../play.txt", "scene.yaml")
        dumps = [place.work / "before.txt", place.work / "after.txt"]
        scene.write_text(FAST)
        done, _ = place.run(*command, fault="none")
        new, seen = scene.read_text(), {}
        expect_equal(done.returncode, DONE, describe_end(done, 0))
        expect_equal(new, FAST.replace("diameter_m: 0.5}   # kept", "diameter_m: 0.75}   # kept"), "the new file")
        scene.write_text(FAST)
        for at in place.allocations(*command, after="before.txt"):
            scene.write_text(FAST)
            for dump in dumps:
                dump.unlink(missing_ok=True)
            done, reached = place.run(*command, fault="memory", at=at, on=on, after="before.txt")
            if not reached:
                break
            found = scene.read_text()
            seen[(found == new, done.returncode)] = seen.get((found == new, done.returncode), 0) + 1
            expect(found in (FAST, new), f"at {at}: neither the old file nor the new one", found)
            expect_equal({p.name for p in place.work.iterdir()} - set(FILES), {p.name for p in dumps if p.exists()}, describe_end(done, at))
            if done.returncode == DONE:  # a failed call of the C library is an error of the save
                screen = Screen(dumps[1].read_text(), 80, 24)
                if found == new:
                    expect_equal(screen.note, "saved scene.yaml", describe_end(done, at))
                else:
                    screen.has("scene.yaml: Cannot allocate memory")
                expect_equal("* fast" in screen.title, found != new, describe_end(done, at))
            elif done.returncode == OUTPUT:
                expect(b"Cannot allocate memory" in done.stderr, describe_end(done, at))
            else:
                expect_equal((done.returncode, done.stderr), (RUN, b"ceduo: out of memory\n"), describe_end(done, at))
        print(f"# {seen}")
        expect(min(seen.get((False, RUN), 0), seen.get((True, RUN), 0)) > 2, f"{seen}: is the library loaded?")


def test_memory_save():
    """Allocations of a save of the terminal program fail once: a complete file; the screen or status shows which one"""
    save_without_memory(False)


def test_memory_save_on():
    """All allocations of a save fail from one on: the old file or the new one is complete, with the right status"""
    save_without_memory(True)


# ---- failing calls, and sudden death ----

# A change, saved as scene.yaml again: the terminal program must not lose this file.
SAVE = "key 3 Down\nkey Enter Ctrl-U\ntype 0.75\nkey Enter\nkey s\nkey Enter Enter\n"


def saves(place):
    """Return (name, command, file) of the commands that write a file."""
    place.write("play.txt", SAVE)
    return (("-o", (*BATCH, "-o", "out.csv"), place.work / "out.csv"),
            ("a save of the terminal program", ("--script", "../play.txt", "scene.yaml"), place.work / "scene.yaml"))


def one_call(fault):
    with Place() as place:
        for what, command, file in saves(place):
            left_behind = 0
            old = file.read_bytes() if file.exists() else b"old"
            file.write_bytes(old)
            done, _ = place.run(*command, fault="none")
            expect_equal(done.returncode, DONE, what)
            new, at, seen = file.read_bytes(), 0, set()
            expect(new != old, what, "writes nothing")
            while True:
                at += 1
                for p in place.work.iterdir():
                    if p.name not in FILES:
                        p.unlink()
                file.write_bytes(old)
                done, reached = place.run(*command, fault=fault, at=at)
                if not reached:
                    break
                found = file.read_bytes()
                seen.add(found)
                expect(found in (old, new), what, "half a file", describe_end(done, at), repr(found[:200]))
                left = [p for p in place.work.iterdir() if p.name not in FILES and p != file]
                left_behind += len(left)
                if fault == "kill":
                    expect_equal(done.returncode, -9, describe_end(done, at))
                    expect(all(not p.name.endswith(".yaml") for p in left), f"{left} would be taken for scenes")
                else:
                    expect(0 <= done.returncode <= 4, what, describe_end(done, at))
                    expect(not left, what, f"left behind: {left}", describe_end(done, at))
                    expect(what != "-o" or (done.returncode == DONE) == (found == new), what, describe_end(done, at))
            print(f"# {what}: {at - 1} calls, {left_behind} times a file was left behind")
            expect(fault != "kill" or left_behind >= 4, what, "no file is ever left behind: is the library loaded?")
            expect_equal(seen, {old, new}, what)


def test_calls():
    """Each call that opens, writes, syncs, closes, renames or removes fails once: status, a complete file, no leftovers"""
    one_call("call")


def test_kill():
    """SIGKILL before each call of a save: the old file or the new one is complete, leftovers are no scenes"""
    one_call("kill")


def pair_with(fault):
    """A fit that replaces the scene and the draws of an earlier one, with a fault at each call: returns how often they do not
    match, and the statuses."""
    mixed, statuses, seen, at = 0, set(), set(), 0
    with Place() as place:
        place.write("work/quarry.yaml", quarry())
        files = [place.work / name for name in ("fitted.yaml", "fitted.draws.csv")]
        words = ("-n", 2, "-j", 1, "--calibrate", "slope.segments[*].rt=0.7:0.98", "-o", "fitted.yaml")
        pairs = []
        for seed in (2, 1):
            done, _ = place.run(*words, "-s", f"simulation.seed={seed}", "quarry.yaml", fault="none")
            expect_equal((done.returncode, done.stderr), (DONE, b""))
            pairs.append([p.read_bytes() for p in files])
        expect(all(a != b for a, b in zip(*pairs)), "two fits are the same")
        while True:
            at += 1
            for path, old in zip(files, pairs[0]):
                path.write_bytes(old)
            done, reached = place.run(*words, "-s", "simulation.seed=1", "quarry.yaml", fault=fault, at=at)
            if not reached:
                break
            found = [p.read_bytes() for p in files]
            expect(all(f in both for f, both in zip(found, zip(*pairs))), "half a file", describe_end(done, at))
            mixed += found not in pairs
            statuses.add(done.returncode)
            seen.add(pairs.index(found) if found in pairs else 2)
            left = [p for p in place.work.iterdir() if p.name not in FILES and p.name != "quarry.yaml" and p not in files]
            expect(fault == "kill" or not left, f"left behind: {left}", describe_end(done, at))
            expect(fault == "kill" or (done.returncode == DONE) <= (found == pairs[1]), describe_end(done, at))
            for p in left:
                p.unlink()
    print(f"# {at - 1} calls, {mixed} times the two do not belong together")
    expect({0, 1} <= seen, "is the library loaded?", seen)
    return mixed, statuses


def test_calls_pair():
    """--calibrate -o: scene and draws mismatch only if the second of two renames fails, and the status reports it"""
    mixed, statuses = pair_with("call")
    expect(mixed <= 1 and OUTPUT in statuses, mixed, statuses)


def test_kill_pair():
    """--calibrate -o: SIGKILL before each call leaves new draws and the old scene only between the two renames"""
    mixed, statuses = pair_with("kill")
    expect(mixed <= 1, mixed)
    expect_equal(statuses, {-9})


def test_calls_on():
    """All calls fail from one on: right status, a complete file; a file that could not be removed is no scene"""
    with Place() as place:
        for what, command, file in saves(place):
            old = file.read_bytes() if file.exists() else b"old"
            place.run(*command, fault="none")
            new, at, reached = file.read_bytes(), 0, True
            while reached:
                at += 1
                for p in place.work.iterdir():
                    if p.name not in FILES:
                        p.unlink()
                file.write_bytes(old)
                done, reached = place.run(*command, fault="call", at=at, on=True)
                found = file.read_bytes()
                expect(0 <= done.returncode <= 4 and found in (old, new), what, describe_end(done, at), repr(found[:200]))
                expect(what != "-o" or (done.returncode == DONE) == (found == new), what, describe_end(done, at))
                left = {p.name for p in place.work.iterdir()} - set(FILES) - {file.name}
                expect(not any(name.endswith(".yaml") for name in left), f"{left} would be taken for scenes")


def test_calls_straight():
    """A device is written directly: if it cannot be opened, written or closed, the status is 4"""
    with Place() as place:
        for on in (False, True):
            at, reached, failed = 0, True, 0
            while reached:
                at += 1
                done, reached = place.run(*BATCH, "-o", "/dev/null", fault="call", at=at, on=on)
                expect(done.returncode == OUTPUT and b"/dev/null: Input/output error" in done.stderr or
                       done.returncode == INPUT and b"cannot read it: Input/output error" in done.stderr or
                       done.returncode == DONE and done.stderr == b"", describe_end(done, at))
                failed += done.returncode == OUTPUT
            expect(failed >= 3, f"{failed} of {at - 1} calls fail the output: to open, to write and to close it")


def test_short_writes():
    """Writes of one byte at a time, or interrupted ones, give the same bytes"""
    with Place() as place:
        wanted, _ = place.run(*BATCH, fault="none")
        for more in ((), ("-o", "out.csv")):
            done, reached = place.run(*BATCH, *more, fault="short")
            found = (place.work / "out.csv").read_bytes() if more else done.stdout
            expect(reached and done.returncode == DONE and found == wanted.stdout, describe_end(done, 0))


def test_no_threads():
    """If no thread can be started the result is the same to the last byte; the terminal program reports it"""
    with Place() as place:
        wanted, _ = place.run(*BATCH[:-1], "-j", 4, "-n", 5000, "scene.yaml", fault="none")
        done, reached = place.run(*BATCH[:-1], "-j", 4, "-n", 5000, "scene.yaml", fault="threads")
        expect(reached and done.returncode == DONE and done.stdout == wanted.stdout, describe_end(done, 0))
        place.write("seen.yaml", FAST + "observed: {passed: {x_m: 60, count: 3, of: 5}}\n")
        for what in (("--sensitivity=2", "scene.yaml"), ("--calibrate", "release.vx_m_s=1:9", "../seen.yaml")):
            wanted, _ = place.run("-f", "json", "-j", 2, "-n", 2, *what, fault="none")
            done, reached = place.run("-f", "json", "-j", 2, "-n", 2, *what, fault="threads")
            expect(reached and done.returncode == DONE and done.stdout == wanted.stdout, describe_end(done, 0))
        place.write("play.txt", "key q\n")
        done, reached = place.run("--script", "../play.txt", "scene.yaml", fault="threads")
        expect(reached and done.returncode in (RUN, INPUT) and done.stderr != b"", describe_end(done, 0))


# ---- folders of other users ----

def test_read_only_folder():
    """A save, and -o, into a read-only folder: reported, the old file complete, no leftovers"""
    with Folder() as f:
        f.path.chmod(0o755)
        shutil.copy(CEDUO, f.path / "ceduo")  # the tests' folder may be inaccessible to others
        f.write("theirs/scene.yaml", FAST)
        f.write("play.txt", "key 3 Down\nkey Enter Ctrl-U\ntype 0.75\nkey Enter\nkey s\ndump -\nkey Esc q\ndump -\n")
        os.chmod(f.path / "theirs", 0o555)
        counts = f.path / "counts"  # a coverage build: the other user cannot write its counts
        counts.mkdir()
        counts.chmod(0o777)
        other = {"user": 65534, "group": 65534, "extra_groups": []} if os.geteuid() == 0 else {}

        def run(*words):
            try:
                return subprocess.run([f.path / "ceduo", *map(str, words)], cwd=f.path / "theirs", check=False,
                                      env=environment(LLVM_PROFILE_FILE=f"{counts}/%m.profraw"),
                                      stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=PATIENCE, **other)
            except PermissionError as why:
                raise Skip(f"another user cannot be taken on: {why}") from why

        for mode in (0o444, 0o666):  # a writable file is also replaced by a new one
            os.chmod(f.path / "theirs/scene.yaml", mode)
            done = run("--script", "../play.txt", "scene.yaml")
            expect(done.returncode == DONE and done.stderr == b"", describe_end(done, 0))
            lines = done.stdout.decode().split("\n")
            saved, quit_asks = (Screen("\n".join(lines[i:i + 24]) + "\n", 80, 24) for i in (0, 24))
            saved.has("Save as", "scene.yaml: Permission denied", "Permission denied. Choose another name")
            expect("* fast" in saved.title, saved)
            quit_asks.has("There are unsaved changes")
            expect_equal((f.path / "theirs/scene.yaml").read_text(), FAST)
        done = run(*BATCH[:-1], "-o", "out.csv", "scene.yaml")
        expect(done.returncode == OUTPUT and b"out.csv: Permission denied" in done.stderr, describe_end(done, 0))
        expect_equal(sorted(p.name for p in (f.path / "theirs").iterdir()), ["scene.yaml"])
        os.chmod(f.path / "theirs", 0o755)


# ---- a small stack ----

def test_small_stack():
    """With a stack of 64 KiB every mode works, and writes its file"""
    if SANITIZED or VARIANT != "release":
        raise Skip("a build that is not optimised needs more")

    def limit():
        resource.setrlimit(resource.RLIMIT_STACK, (65536, 65536))

    few, find = ("-n", 2000, "-j", 2, *CERTAIN, "paper-site"), ("--find", "forest[0].stand.stools.per_ha=500:5000", "--goal", "adc=30")
    with Folder() as f:
        f.write("play.txt", "key 1 2 3 4 5 6\nkey Enter Esc ? Esc w Enter Esc\nkey S Ctrl-U\ntype new.yaml\nkey Enter\n")
        for words in (*(("--batch", "-f", form, *few) for form in ("table", "csv", "json")),
                      ("--batch", "-s", "simulation.law=crsp", *few),
                      *(("--plot", plot, *few) for plot in ("profile", "histogram", "rotation", "stand", "compare")),
                      ("--years", "0:3", "-n", 200, "rotation"), (*find, "paper-site"), ("--check", "paper-site"),
                      ("--list-parameters",), ("--list-profiles",), ("--script", "play.txt", "paper-site")):
            out = "new.yaml" if words[0] == "--script" else "out"
            into = () if words[0] in ("--check", "--script") else ("-o", out)
            done = subprocess.run([CEDUO, *map(str, (*words, *into))], cwd=f.path, env=environment(), preexec_fn=limit,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False, timeout=PATIENCE)
            expect(done.returncode == DONE and done.stderr == b"", words, describe_end(done, 0))
            expect_equal(f.names(), sorted({"play.txt"} if words[0] == "--check" else {"play.txt", out}), words)
            expect(words[0] == "--check" or (f.path / out).stat().st_size > 0, words, "an empty file")
            (f.path / out).unlink(missing_ok=True)


# ---- disks ----

def test_file_size_limit():
    """A file beyond the process limit: status 4, the old file complete, no leftovers"""
    def limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (100, 100))

    with Folder() as f:
        for name, text in FILES.items():
            f.write(name, text)
        f.write("out.csv", "old")
        done = subprocess.run([CEDUO, *map(str, BATCH), "-o", "out.csv"], cwd=f.path, env=environment(), preexec_fn=limit,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
        expect(done.returncode == OUTPUT and b"out.csv: File too large" in done.stderr, describe_end(done, 0))
        expect_equal((f.path / "out.csv").read_text(), "old")
        expect_equal(f.names(), sorted([*FILES, "out.csv"]))


def test_full_disk():
    """A full disk: status 4, the old file complete, no leftovers"""
    if not shutil.which("unshare") or os.geteuid() != 0:
        raise Skip("needs a file system of its own")
    with Folder() as f:
        for name, text in FILES.items():
            f.write(name, text)
        os.mkdir(f.path / "disk")
        words = " ".join(shlex.quote(str(w)) for w in (CEDUO, *BATCH, "-o", "disk/out.csv"))
        script = ("mount -t tmpfs -o size=8k none disk || exit 77; echo old >disk/out.csv; cat /dev/zero >disk/ballast 2>/dev/null; "
                  f"{words}; status=$?; cat disk/out.csv; ls disk; exit $status")
        done = subprocess.run(["unshare", "-m", "sh", "-c", script], cwd=f.path, env=environment(), stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, check=False)
        if done.returncode == 77 or b"unshare" in done.stderr:
            raise Skip("a file system cannot be mounted here")
        expect(done.returncode == OUTPUT and b"No space left" in done.stderr, describe_end(done, 0))
        expect_equal(done.stdout, b"old\nballast\nout.csv\n")


def test_replaced_while_read():
    """A scene that is replaced repeatedly is read in its old or new form, never half"""
    with Folder() as f:
        for name, text in FILES.items():
            f.write(name, text)
        f.write("long.yaml", FILES["scene.yaml"] + "# " + "x" * 3000000 + "\n")
        f.write("short.yaml", FILES["scene.yaml"])
        script = "exec 2>/dev/null; while :; do cp long.yaml t; mv t scene.yaml; cp short.yaml t; mv t scene.yaml; done"
        with subprocess.Popen(["sh", "-c", script], cwd=f.path) as other:
            try:
                for _ in range(40):
                    good("--check", "scene.yaml", cwd=f.path)
            finally:
                other.kill()
                other.wait()


# ---- streams ----

def test_streams_closed():
    """All three standard streams closed: a file is still written completely; without a file status 4; a bad scene status 3"""
    with Folder() as f:
        for name, text in FILES.items():
            f.write(name, text)
        f.write("bad.yaml", "x: [\n")
        words = " ".join(map(shlex.quote, map(str, (CEDUO, *BATCH))))
        for more, status in (("-o out.csv", DONE), ("", OUTPUT), ("bad.yaml -o both.csv", INPUT)):
            done = subprocess.run(["sh", "-c", f"exec {words} {more} <&- >&- 2>&-"], cwd=f.path, env=environment(), check=False)
            expect_equal(done.returncode, status, more)
        wanted = good(*BATCH, cwd=f.path).out
        expect_equal((f.path / "out.csv").read_text(), wanted)
        expect_equal((f.path / "both.csv").read_text(), wanted)


def test_reader_leaves():
    """A reader that takes one byte ends the program by SIGPIPE, without a message"""
    done = subprocess.run(["bash", "-c", f"{shlex.quote(CEDUO)} --list-parameters | head -c 1; echo \" ${{PIPESTATUS[0]}}\""],
                          env=environment(), stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    expect(done.stdout in (b"p 0\n", b"p 141\n", b"p 4\n") and done.stderr == b"", describe_end(done, 0))
    expect_in(b"p ", done.stdout)


if __name__ == "__main__":
    run_all(__name__)
