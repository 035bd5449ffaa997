#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: slow
"""Special files: folders, devices, FIFOs, sockets, terminals; names with control characters."""
import os
import pty
import re
import resource
import socket
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import (CEDUO, DONE, INPUT, OUTPUT, PATIENCE, PROFILES, SANITIZED, USAGE, Folder, ceduo, environment, expect,
                     expect_equal, expect_in, good, run_all, scene, wooded_scene)
from inputs import check, flat_scene


def test_no_file():
    """Missing file, folder, loop of links, unreadable file: reported, with the system's reason"""
    with Folder() as f:
        (f.path / "folder").mkdir()
        (f.path / "folder.yaml").mkdir()
        (f.path / "a").symlink_to("b")
        (f.path / "b").symlink_to("a")
        for name, words in (("missing.yaml", "No such file"), ("folder", "directory"), ("folder.yaml", "directory"),
                            ("a", "symbolic links"), ("x" * 300, "too long"), ("missing/s.yaml", "No such file"),
                            (str(PROFILES / "scenes/paper-site.yaml") + "/x", "Not a directory")):
            done = check(f, name)
            expect(f"{name}: " in done.err and words in done.err, done)
        done = check(f, "")
        expect(done.err.strip() != "", done)


def test_no_file_below():
    """The same for references of a scene, at the reference or in the file's name"""
    with Folder() as f:
        (f.path / "folder.yaml").mkdir()
        (f.path / "loop.yaml").symlink_to("loop.yaml")
        (f.path / "loop.csv").symlink_to("loop.csv")
        (f.path / "folder.csv").mkdir()
        for target in ("missing.yaml", "folder.yaml", "loop.yaml", "folder.csv", "loop.csv", "", ".", "/", "x" * 5000):
            f.write("s.yaml", scene(slope=target))
            expect_in("slope", check(f, "s.yaml").err)
            f.write("s.yaml", scene(forest=[{"from_m": 10, "to_m": 20, "stand": target}]))
            expect_in("stand", check(f, "s.yaml").err)


def expect_refused(done, name, words):
    expect(done.status == INPUT and done.out == "" and f"{name}: cannot read it: {words}" in done.err, done)


def bounded():
    """Run with a memory limit: an endless input must not exhaust the machine."""
    if not SANITIZED:
        resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30))


DEVICE = "a device or a socket; name a file\n"


def test_no_files():
    """Every reader refuses sockets and devices; as standard input they are read up to the size limit"""
    with Folder() as f, socket.socket(socket.AF_UNIX) as there:
        there.bind(str(f.path / "socket.yaml"))
        f.write("s.yaml", flat_scene())
        blocks = [p for p in Path("/dev").iterdir() if p.is_block_device() and os.access(p, os.R_OK)][:1]
        for path in (f.path / "socket.yaml", Path("/dev/null"), Path("/dev/zero"), *blocks):
            for words in (("--check", path), ("--batch", path), ("--script", path, "s.yaml")):
                expect_refused(ceduo(*words, cwd=f.path, preexec_fn=bounded), path, DEVICE)
            for change in ({"slope": str(path)}, {"slope": {"csv": str(path)}},
                           {"forest": [{"from_m": 10, "to_m": 20, "stand": {"base": str(path)}}]}):
                expect_refused(ceduo("--check", f.write("refers.yaml", scene(**change)), preexec_fn=bounded), path, DEVICE)
        with open("/dev/zero", "rb") as stream:
            done = subprocess.run([CEDUO, "--check", "-"], stdin=stream, capture_output=True, text=True, env=environment(),
                                  preexec_fn=bounded, timeout=PATIENCE, check=False)
        expect_equal((done.returncode, done.stderr), (INPUT, "standard input: larger than 16 MiB\n"))


def test_no_size():
    """A system file with size 0 counts as empty: it may be endless"""
    with Folder() as f:
        expect_in("/proc/self/status: there is no value", check(f, "/proc/self/status").err)


def test_streams():
    """A terminal or a socket as standard input, and /dev/stdin, are read to the end"""
    text = flat_scene()
    master, slave = pty.openpty()
    with Folder() as f:
        os.write(master, text + b"\x04")  # the end-of-file key
        with open(os.ttyname(slave), "rb") as stream:
            done = subprocess.run([CEDUO, "--check", "-"], stdin=stream, capture_output=True, env=environment(),
                                  timeout=PATIENCE, check=False)
        expect(done.returncode == DONE and done.stderr == b"", done)
        ours, theirs = socket.socketpair()
        with ours, theirs:
            ours.sendall(text)
            ours.shutdown(socket.SHUT_WR)
            done = subprocess.run([CEDUO, "--check", "-"], stdin=theirs, capture_output=True, env=environment(), timeout=PATIENCE,
                                  check=False)
            expect(done.returncode == DONE and done.stderr == b"", done)
        done = subprocess.run(["sh", "-c", 'exec "$0" --check - <&-', CEDUO], capture_output=True, env=environment(), check=False)
        expect_equal((done.returncode, done.stderr), (INPUT, b"standard input: cannot read it: Bad file descriptor\n"), "closed")
        good("--check", "/dev/stdin", stdin=text)
        expect_in("standard input: there is no value", check(f, "-", stdin=b"").err)
        f.write("empty.yaml", b"")
        expect_in("empty.yaml: there is no value", check(f, "empty.yaml").err)
    os.close(master)
    os.close(slave)


def test_fifo():
    """A FIFO with a slow writer is read to its end"""
    with Folder() as f:
        fifo = f.path / "fifo.yaml"
        os.mkfifo(fifo)
        writer = subprocess.Popen(["sh", "-c", '(sleep 0.4; cat "$0") > "$1"', f.write("s.yaml", flat_scene()), fifo])
        try:
            time.sleep(0.1)
            done = subprocess.Popen([CEDUO, "--check", fifo], stderr=subprocess.PIPE, env=environment())
            err = done.communicate(timeout=PATIENCE)[1]
            expect_equal((done.returncode, err), (DONE, b""))
        finally:
            writer.kill()
            writer.wait()


def test_fifo_first():
    """A FIFO without a writer is awaited for a second"""
    with Folder() as f:
        fifo = f.path / "fifo.yaml"
        os.mkfifo(fifo)
        done = subprocess.Popen([CEDUO, "--check", fifo], stderr=subprocess.PIPE, env=environment())
        time.sleep(1)
        expect(done.poll() is None, "it did not wait")
        with open(fifo, "wb") as out:
            out.write(flat_scene())
        expect_equal((done.communicate(timeout=PATIENCE)[1], done.returncode), (b"", DONE))


def test_names_with_escapes():
    """Control characters in names and titles are escaped: table, CSV, JSON, messages, file names"""
    nasty = "\\e[31mred\\a\\u009b2J\\u202eevil\\n\\t\\r\\ufdd0\\ufffe\\U0001ffff"
    text = flat_scene().decode().replace("title: small", f'title: "{nasty}"').replace("name: road", f'name: "{nasty}"')
    text += (f'options:\n  - name: "{nasty}"\n    source: {{kind: assumed, text: "{nasty}"}}\n    forest:\n'
             f'      - {{from_m: 10, to_m: 20, stand: {{name: "{nasty}", species: fagus-sylvatica, '
             'trees: [{per_ha: 100, dbh_m: 0.3, height_m: 40}]}}\n')
    with Folder() as f:
        path = f.write("s.yaml", text)
        for form in ("table", "csv", "json"):
            done = good("--batch", "-f", form, path)  # checks both streams
            if form == "json":
                title = done.json()[0]["title"]
                expect_equal(title, "\x1b[31mred\a\x9b2J\u202eevil\n\t\r\ufdd0\ufffe\U0001ffff", ascii(title))
        for name in ("\x1b[31m.yaml", "new\nline.yaml", "\x9b.yaml", "ü.yaml"):
            done = check(f, name)
            expect(not re.search("[\x1b\x07\x9b]", done.err) and len(done.err.splitlines()) == 1, ascii(done.err))
            bad = f.write(name, "rock: [\x1b]")
            done = check(f, bad.name)
            expect(not re.search("[\x1b\x07\x9b]", done.err), ascii(done.err))
        done = check(f, os.fsdecode(b"\xff\xfe.yaml"))
        expect_in("\\xff\\xfe", done.err)
        done = ceduo("--batch", "--option", "\x1b[31m", path)
        expect(done.status == USAGE, done)


NASTY = "\x1b[31mred\a\x9b2J\u202eevil\nline\ufdd0\ufffe"


def test_names_in_every_mode():
    """Control characters in the names of files, options and arguments are escaped in every mode, on both streams"""
    mapping = wooded_scene(title=NASTY, simulation={"rocks": 20})
    mapping["options"] = [{"name": NASTY, "forest": mapping.pop("forest")}]
    path = f"options[{NASTY}].forest[0].stand.stools.per_ha"
    with Folder() as f:
        def run(*words, status):
            done = ceduo(*words, cwd=f.path, env={"XDG_DATA_HOME": str(f.path)})  # checks both streams
            expect_equal(done.status, status, ascii(words))
            return done

        name = f.write(f"{NASTY}.yaml", mapping).name
        f.write(f"ceduo/scenes/{name}", mapping)
        for form in ("table", "csv", "json"):
            run("--batch", "-f", form, name, status=DONE)
            run("--years", "0:2", "-f", form, name, status=DONE)
            run("--batch", "-f", form, "-o", f"{NASTY}/x", name, status=OUTPUT)
            for goal, scenes in (("adc=30", [name]), ("adc=30", [name, name]), ("adc=0.001", [name])):
                run("--find", f"{path}=500:5000", "--goal", goal, "-f", form, *scenes, status=DONE)
        for plot in ("profile", "energy", "height", "histogram", "rotation", "stand", "compare"):
            run("--plot", plot, name, status=DONE)
        for words in (("--check", f"{NASTY}0"), ("--script", f"{NASTY}0", name)):
            run(*words, status=INPUT)
        run("--list-profiles", status=DONE)
        head = f"plot,area_m2,kind,dbh_cm,height_m,{NASTY}".replace("\n", "")
        f.write(f"{NASTY}.csv", f"{head}\nA,200,tree,20,12,x\n")
        run("--survey", f"{NASTY}.csv", status=DONE)
        for text, status in ((f"{NASTY[:5]}\n", USAGE), (f"key {NASTY[:5]}\n", USAGE), (f"dump {NASTY[:5]}/x\n", OUTPUT),
                             ("key s\ndump -\nkey o\ntype red\nkey Enter\ndump -\nkey Esc w\ndump -\nkey Enter\ndump -\n", DONE)):
            f.write(NASTY, text)
            done = run("--script", NASTY, name, status=status)
            expect(status == DONE or len(done.err.splitlines()) == 1, ascii(done.err))
        for option in ("format", "rows", "plot", "charset", "rocks", "tolerance", "size", "find", "goal", "seed",
                       "threads", "option", "set", NASTY, f"check={NASTY}"):
            run("--batch", f"--{option}", f"{NASTY}?", name, status=USAGE)
        for word in (f"-{NASTY}", f"--{NASTY}", f"--batch={NASTY}", f"--years={NASTY}", f"--sensitivity={NASTY}"):
            run(word, name, status=USAGE)


def test_name_not_utf8():
    """A file name in invalid UTF-8 leaves JSON, CSV and table well-formed"""
    with Folder() as f:
        name = os.fsencode(f.path) + b"/\xff\xfe.yaml"
        with open(name, "wb") as file:
            file.write(flat_scene().replace(b"title: small\n", b""))
        for form in ("json", "csv", "table"):
            done = good("--batch", "-f", form, os.fsdecode(name))
            done.out_bytes.decode("utf-8")


if __name__ == "__main__":
    run_all(__name__)
