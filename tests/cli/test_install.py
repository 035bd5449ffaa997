#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: slow manual
"""Installing to a folder, using the installed program, uninstalling; completion in the shell."""
import os
import pty
import re
import select
import shutil
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import PATIENCE, ROOT, Folder, Skip, ceduo, environment, expect, expect_equal, expect_in, good, run_all  # noqa: E402

SONAME = re.search(r"^SONAME := (\S+)", (ROOT / "Makefile").read_text(encoding="utf-8"), re.M)[1]
VARIANT = Path(os.environ.get("BUILD", "build/release")).name


def make(*words, folder=ROOT):
    env = {k: v for k, v in environment().items() if k not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL")}
    done = subprocess.run(["make", "-s", "-C", str(folder), f"VARIANT={VARIANT}", *words], env=env, capture_output=True, text=True,
                          check=False, timeout=PATIENCE)
    expect(done.returncode == 0, "make", words, done.stdout, done.stderr)


class Installed(Folder):
    """The program installed below a folder."""

    def __init__(self, root="root", prefix="/opt/forest"):
        self.root, self.below = root, prefix

    def __enter__(self):
        super().__enter__()
        self.into = [f"DESTDIR={self.path / self.root}", f"PREFIX={self.below}"]
        make("install", *self.into)
        self.prefix = self.path / (self.root + self.below)
        return self

    def files(self):
        return sorted(str(p.relative_to(self.path)) for p in (self.path / self.root).rglob("*") if not p.is_dir())


def test_install():
    """make install: program, library, profiles, pages and completions, below DESTDIR and PREFIX; uninstall removes all"""
    with Installed() as place:
        files = place.files()
        expect(all(f.startswith("root/opt/forest/") for f in files), files)
        names = {f.removeprefix("root/opt/forest/") for f in files}
        expect({"bin/ceduo", "share/man/man1/ceduo.1", "share/man/man7/ceduo-model.7", "share/ceduo/scenes/paper-site.yaml",
                "share/bash-completion/completions/ceduo", "share/zsh/site-functions/_ceduo", "share/man/man3/ceduo.3",
                "share/locale/it/LC_MESSAGES/ceduo.mo",
                "share/man/it/man1/ceduo.1", "share/man/it/man7/ceduo-workflows.7", "lib/libceduo.a", "lib/libceduo.so", f"lib/{SONAME}", "lib/pkgconfig/ceduo.pc", "include/ceduo/ceduo.h"} <= names, names)
        shipped = [p for p in (ROOT / "profiles").rglob("*.yaml")] + [p for p in (ROOT / "man").rglob("*.[1357]")]
        shipped += [*(ROOT / "profiles/jobs").iterdir(), *(ROOT / "profiles/surveys").iterdir(), *(ROOT / "profiles/observed").iterdir(),
                    *(p for p in (ROOT / "profiles/region").iterdir() if p.is_file() and p.suffix != ".yaml"),
                    *(ROOT / "include/ceduo").glob("*.h"), *(ROOT / "src/po").glob("*.po"), *(ROOT / "man/examples").iterdir()]
        expect_equal(len(names), len(shipped) + 12, "files installed")  # with libraries, Italian pages and completions
        for name in names:
            expect_equal(oct((place.prefix / name).stat().st_mode & 0o777), "0o755" if name == "bin/ceduo" else "0o644", name)
        (place.prefix / "share/man/man1/other.1").write_text("not ours")
        make("uninstall", *place.into)
        expect_equal(place.files(), ["root/opt/forest/share/man/man1/other.1"], "left behind")


# Unquoted, a shell splits these paths, and make expands the per cent.
ODD = (("root of it", "/opt/a forest"), ("it's", "/opt/oaks, 50% o'\"them\" & more; $(HASH)(*)"))


def test_install_odd_names():
    """make install and uninstall with blanks, quotes and other characters in PREFIX and DESTDIR: exactly these folders"""
    with Installed() as plain:
        wanted = [f.removeprefix("root/opt/forest/") for f in plain.files()]
    for root, prefix in ODD:
        with Folder() as outside:
            make("install", f"DESTDIR={outside.path / root}", f"PREFIX={prefix}", "HASH=#")
            below = outside.path / (root + prefix.replace("$(HASH)", "#"))
            expect_equal(outside.names(), [root], "folders made")
            expect_equal(sorted(str(p.relative_to(below)) for p in below.rglob("*") if not p.is_dir()), wanted, root)
            foreign = [outside.path / root.split(" ")[0], outside.path / (root + prefix.split(" ")[0])]
            foreign = [outside.write(p, "theirs") for p in foreign if not p.exists()]
            make("uninstall", f"DESTDIR={outside.path / root}", f"PREFIX={prefix}", "HASH=#")
            expect_equal(sorted(p for p in outside.path.rglob("*") if not p.is_dir()), sorted(foreign), "left behind")
            expect_equal([p for p in outside.path.rglob("ceduo")], [], "folders left behind")


def test_uninstall_foreign():
    """make uninstall keeps foreign files, also among its profiles, and can run twice"""
    with Installed() as place:
        shared = place.prefix / "share/ceduo"
        mine = [place.write(shared / name, "mine") for name in ("notes.txt", "stands/mine.yaml", "jobs/old/a.sbatch")]
        make("uninstall", *place.into)
        expect_equal(sorted(p for p in shared.rglob("*") if not p.is_dir()), sorted(mine), "left behind")
        expect_equal(sorted(p.name for p in shared.iterdir()), ["jobs", "notes.txt", "stands"], "folders left behind")
        for path in mine:
            path.unlink()
        (shared / "jobs/old").rmdir()
        make("uninstall", *place.into)
        expect(not shared.exists(), "an empty folder of its own is left", shared)


def copy_of_sources(to, *left_out):
    """Copy the sources with their objects, so that make compiles only omitted files."""
    for name in ("Makefile", "include", "src", "man", "profiles", "tests"):
        subprocess.run(["cp", "-a", ROOT / name, to / name], check=True)
    (to / f"build/{VARIANT}").mkdir(parents=True)
    for name in ("src", "libceduo.a", "libparts.a", "ceduo"):
        subprocess.run(["cp", "-a", ROOT / f"build/{VARIANT}/{name}", to / f"build/{VARIANT}/{name}"], check=True)
    for name in left_out:
        (to / f"build/{VARIANT}/{name}").unlink()


def test_odd_data_folder():
    """DATADIR may contain special characters of C strings or shells: profiles are found there"""
    with Folder() as place:
        copy_of_sources(place.path, "src/io/file.o", "libceduo.a", "ceduo")
        data = place.path / "it's \"so\" a\\n % ??/ folder"
        place.write(data / "scenes/there.yaml", "title: found\n")
        make("all", f"DATADIR={data}", folder=place.path)
        (place.path / "alone").mkdir()
        program = shutil.copy2(place.path / f"build/{VARIANT}/ceduo", place.path / "alone/ceduo")
        listed = subprocess.run([program, "--list-profiles"], env=environment(), capture_output=True, text=True, check=True).stdout
        expect_in(f"{data}/scenes/there.yaml", listed)


def test_odd_source_folder():
    """The sources may lie in a folder with a blank and an apostrophe"""
    with Folder() as place:
        here = place.path / "it's a wood"
        here.mkdir()
        copy_of_sources(here)
        make("install", f"DESTDIR={place.path / 'root'}", "PREFIX=/usr", folder=here)
        expect((place.path / "root/usr/share/ceduo/scenes/paper-site.yaml").exists(), "nothing is installed")
        make(f"build/{VARIANT}/tests/fuzz/replay_csv.tap", "CHANGES_csv=20", folder=here)
        tap = (here / f"build/{VARIANT}/tests/fuzz/replay_csv.tap").read_text()
        expect("not ok" not in tap and "\nok " in f"\n{tap}", tap)


def test_installed_runs():
    """The installed program finds its profiles by name from any folder"""
    with Installed() as place:
        program = place.prefix / "bin/ceduo"
        # DATADIR at build time is not below DESTDIR: a staged program searches next to itself
        done = subprocess.run([program, "--batch", "-n", "10", "-f", "csv", "paper-site"], cwd=place.path, env=environment(),
                              capture_output=True, text=True, check=False)
        expect(done.returncode == 0 and done.stdout.count("\n") == 2, "status and output", done)
        listed = subprocess.run([program, "--list-profiles"], cwd=place.path, env=environment(), capture_output=True, text=True,
                                check=True).stdout
        expect_in("/opt/forest/bin/../share/ceduo/scenes/paper-site.yaml", listed)


def completed(place, *words, **changes):
    """Return bash's completions of the last word."""
    script = (place.prefix / "share/bash-completion/completions/ceduo").read_text()
    line = " ".join(f"'{w}'" for w in words)
    run = f"{script}\nCOMP_WORDS=({line}); COMP_CWORD={len(words) - 1}; _ceduo; printf '%s\\n' \"${{COMPREPLY[@]}}\""
    done = subprocess.run(["bash", "--norc", "-c", run], cwd=place.path, env=environment(**changes), capture_output=True, text=True,
                          check=False)
    expect(done.stderr == "", done.stderr)
    return done.stdout.splitlines()


# Text before the Tab, and the last word that the program then receives.
COMPLETIONS = (
    ("my", "my wood.yaml"), ("my\\ w", "my wood.yaml"), ('"my w', "my wood.yaml"), ("'my w", "my wood.yaml"),
    ("it\\'", "it's a wood.yaml"), ('"it\'s', "it's a wood.yaml"), ("quo", 'quo"ted".yaml'), ("back", "back\\slash.yaml"),
    ("back\\\\s", "back\\slash.yaml"), ("dollar", "dollar$HOME`x`.yaml"), ("star", "star* [a]?.yaml"),
    ("star\\*", "star* [a]?.yaml"), ("\u00fc", "\u00fcber & <weg>;.yaml"), ("old\\ woods/d", "old woods/deep one.yaml"),
    ('"old woods/d', "old woods/deep one.yaml"), ("ol", "old woods/"), ("~/at", "home/at home.yaml"), ("forest", "forest of oaks"),
    ("forest\\ o", "forest of oaks"), ('"forest of', "forest of oaks"), ("ash", "ash's own"),
    ("--script pl", "play list.txt"), ("-o 'pl", "play list.txt"), ("--output=pl", "--output=play list.txt"), ("-f js", "json"),
    ("--find rocks_per", "rocks_per_year="))


class Shells(Installed):
    """The program installed, and a folder of files with odd names, for completion in an interactive shell."""

    def __enter__(self):
        super().__enter__()
        for name in ("my wood.yaml", "my wood.txt", "it's a wood.yaml", 'quo"ted".yaml', "back\\slash.yaml", "dollar$HOME`x`.yaml",
                     "star* [a]?.yaml", "starling.txt", "\u00fcber & <weg>;.yaml", "old woods/deep one.yaml", "play list.txt",
                     "home/at home.yaml"):
            self.write(f"here/{name}", "")
        for name in ("forest of oaks", "ash's own", "evil$(touch pwned)"):
            self.write(f"data/ceduo/scenes/{name}.yaml", "title: /scenes/see b.yaml  scene by scene\n")
        self.write("a path/ceduo", f"#!/bin/sh\ncase $1 in --list-*) exec '{self.prefix}/bin/ceduo' \"$@\";; esac\n"
                   "for w; do :; done; printf '%s\\n' \"$w\" >>\"$CALLS\"\n").chmod(0o755)
        return self

    def given(self, shell, start, typed):
        """Return the last word that the program receives after typing this, Tab and Enter."""
        calls, here = self.path / "calls", self.path / "here"
        env = environment(HOME=str(here / "home"), XDG_DATA_HOME=str(self.path / "data"), TERM="dumb", CALLS=str(calls),
                          PATH=f"{self.path / 'a path'}:{os.environ['PATH']}", PS1="> ", ZDOTDIR=str(self.path))
        calls.unlink(missing_ok=True)
        master, slave = pty.openpty()
        with subprocess.Popen(shell, stdin=slave, stdout=slave, stderr=slave, cwd=here, env=env, start_new_session=True) as process:
            os.close(slave)
            seen, end, asked = b"", time.monotonic() + PATIENCE, False
            os.write(master, start.encode() + b"; echo READY$((1 + 1))\n")
            while time.monotonic() < end and not (calls.exists() and calls.read_bytes().endswith(b"\n")):
                if select.select([master], [], [], 0.02)[0]:
                    seen += os.read(master, 65536)
                if not asked and b"READY2" in seen:
                    os.write(master, typed.encode() + b"\t\n")
                    asked = True
            process.kill()
        os.close(master)
        expect(calls.exists(), f"{typed!r} comes to nothing", seen.decode("utf-8", "replace"))
        return calls.read_text().rstrip("\n")

    def check(self, shell, start, folder):
        for typed, wanted in COMPLETIONS:
            found = self.given(shell, start, f"ceduo {typed}").removeprefix(f"{self.path}/here/")
            expect_equal(found, folder if wanted == "old woods/" else wanted, typed)
        for typed, wanted in (("forest", "forest of oaks"), ("--find rocks_per", "rocks_per_year="),
                              ("--find options[tall].forest[2].stand.stools.s", "options[tall].forest[2].stand.stools.spacing_m="),
                              ("-s controls[1].accepted_k", "controls[1].accepted_kJ=")):
            expect_equal(self.given(shell, start, f"{self.path}/a\\ path/ceduo {typed}"), wanted, f"in a folder with a blank: {typed}")


def test_bash_odd_names():
    """bash completes names with blanks, quotes and other characters as one word, in any quoting, and executes none"""
    if not shutil.which("bash"):
        raise Skip("no bash here")
    with Shells() as place:
        expect_equal(completed(place, str(place.prefix / "bin/ceduo"), "ev", XDG_DATA_HOME=str(place.path / "data")), ["evil$(touch pwned)"])
        place.check(["bash", "--norc", "--noprofile", "-i"], f". '{place.prefix}/share/bash-completion/completions/ceduo'", "old woods/")
        expect(not list(place.path.rglob("pwned")), "the name of a profile was carried out")


def test_zsh_odd_names():
    """zsh does the same"""
    if not shutil.which("zsh"):
        raise Skip("no zsh here")
    with Shells() as place:
        place.check(["zsh", "-f", "-i"], f"fpath=('{place.prefix}/share/zsh/site-functions' $fpath); autoload -Uz compinit; compinit -u -D",
                    "old woods")  # zsh removes the slash at Enter


def test_bash():
    """bash completes options, their words, parameters, profiles and files"""
    if not shutil.which("bash"):
        raise Skip("no bash here")
    with Installed() as place:
        program = str(place.prefix / "bin/ceduo")
        (place.path / "mine.yaml").write_text("")
        (place.path / "mine.txt").write_text("")
        options = set(re.findall(r"--([\w-]+)", good("--help").out.split("\n\n")[0] + good("--help").out))
        offered = {w.removeprefix("--") for w in completed(place, program, "--")}
        expect(offered >= {"batch", "years", "find", "plot", "version"} and offered <= options, offered ^ options)
        expect_equal(completed(place, program, "--to"), ["--tolerance", "--tour"])
        expect_equal(completed(place, program, "-f", ""), ["table", "csv", "json", "geojson"])
        expect_equal(completed(place, program, "--format", "=", "j"), ["json"])
        expect_equal(completed(place, program, "--format", "="), ["table", "csv", "json", "geojson"])
        expect_equal(completed(place, program, "--plot", "h"), ["height", "histogram", "hazard"])
        expect_equal(completed(place, program, "--goal", "e"), ["energy", "exceed"])
        expect_equal(completed(place, program, "-s", "simulation.scale"), ["simulation.scale_rn="])
        expect_equal(completed(place, program, "--find", "rocks_per"), ["rocks_per_year="])
        expect_equal(completed(place, program, "-s", "forest[2].stand.stools.s"), ["forest[2].stand.stools.spacing_m="])
        expect_equal(completed(place, program, "-s", "options[selection coppice].forest[0].stand.tre")[0],
                     "options[selection coppice].forest[0].stand.trees[0].per_ha=")
        expect_equal(completed(place, program, "-s", "controls[0].accepted"), ["controls[0].accepted_kJ=", "controls[0].accepted_return_y="])
        expect_equal(completed(place, program, "four-systems", "--option", "sel"), ["selection coppice", "selection coppice, just cut"])
        (place.path / "plots.csv").write_text("")
        for option in ("--survey", "--each"):
            expect_equal(completed(place, program, option, "p"), ["plots.csv"], option)
        expect_equal(completed(place, program, "paper"), ["paper-site"])
        expect_equal(completed(place, program, "mi"), ["mine.yaml"])
        for plot in completed(place, program, "--plot", ""):
            expect_equal(ceduo("--plot", plot, "--size", "60x20", "-n", 1, "paper-site").status, 0, plot)


def test_zsh():
    """zsh loads its completion without an error, with every option"""
    if not shutil.which("zsh"):
        raise Skip("no zsh here")
    with Installed() as place:
        path = place.prefix / "share/zsh/site-functions/_ceduo"
        done = subprocess.run(["zsh", "-f", "-c", f"autoload -Uz compinit; fpath=({path.parent} $fpath); compinit -u -D; "
                               "print -r -- $_comps[ceduo]; _arguments() {{ print -rl -- \"$@\" }}; autoload +X _ceduo; _ceduo"
                               .replace("{{", "{").replace("}}", "}")],
                              env=environment(), capture_output=True, text=True, check=False)
        expect(done.returncode == 0 and done.stderr == "", "zsh", done.stdout, done.stderr)
        lines = done.stdout.split("\n")
        expect_equal(lines[0], "_ceduo", "what completes ceduo")
        for option in re.findall(r"^  (?:-\w,|   ) --([\w-]+)", good("--help").out, re.M):
            expect(any(f"--{option}" in line for line in lines), f"--{option} is missing", done.stdout)


if __name__ == "__main__":
    run_all(__name__)
