#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""ceduo(3): the example of the page is compiled and run with the library and the headers that were installed."""
import os
import re
import shlex
import shutil
import subprocess

from harness import ROOT, Folder, Skip, environment, expect, expect_equal, run_all
from test_install import VARIANT, make
from test_workflows import RUN, plain

PAGE = ROOT / "man/ceduo.3"
SOURCE, COMMANDS, OUTPUT = [plain(body) for _, body in RUN.findall(PAGE.read_text(encoding="utf-8"))]
CC = os.environ.get("CC", "cc")
STRICT = "-std=c17 -Wall -Wextra -Wpedantic -Wconversion -Werror"
# What a program needs beside ceduo.pc when the library is not the one that is released.
BUILT = {"asan": "-fsanitize=address,undefined", "tsan": "-fsanitize=thread", "cov": "--coverage"}.get(VARIANT, "")
# Blanks and signs of the shell, of make and of pkg-config, all of which a user may have in the name of a folder.
ODD = "it's a \"wood\" & 50% \\more; `x` $y #1"


class Library(Folder):
    """The library installed with a PREFIX: below DESTDIR, or, where its folder is named, in that itself."""

    def __init__(self, folder=None):
        self.folder = folder

    def __enter__(self):
        if not shutil.which("pkg-config"):
            raise Skip("no pkg-config here")
        super().__enter__()
        stage, prefix = ("", f"{self.path}/{self.folder}") if self.folder else (f"{self.path}/root", "/opt/forest")
        self.root = stage + prefix
        make("install", "HASH=#", f"DESTDIR={stage}", "PREFIX=" + prefix.replace("$", "$$").replace("#", "$(HASH)"))
        self.env = environment(PKG_CONFIG_PATH=f"{self.root}/lib/pkgconfig", PKG_CONFIG_SYSROOT_DIR=stage or None)
        return self

    def flags(self, *words):
        done = subprocess.run(["pkg-config", *words, "ceduo"], env=self.env, capture_output=True, text=True, check=False)
        expect_equal((done.returncode, done.stderr), (0, ""), f"pkg-config {words}")
        return shlex.split(done.stdout)

    def shell(self, text):
        done = subprocess.run(["sh", "-e"], input=text, env=self.env, cwd=self.path, capture_output=True, text=True, check=False)
        expect(done.returncode == 0 and done.stderr == "", text, f"status {done.returncode}", done.stdout, done.stderr)
        return done.stdout


def test_example():
    """The example compiles without a warning by the command of the page, runs, and prints what the page says"""
    with Library() as place:
        place.write("mill.c", SOURCE)
        expect(COMMANDS.startswith("cc "), COMMANDS)
        expect_equal(place.shell(f"cc() {{ command {CC} {STRICT} {BUILT} \"$@\"; }}\n{COMMANDS}"), OUTPUT, "output")


def test_cpp():
    """C++ asks as C does: one header, without a warning, and a flag that ends the call"""
    if not shutil.which("g++"):
        raise Skip("no C++ compiler here")
    with Library() as place:
        source = place.write("ask.cc", """#include <ceduo/ceduo.h>
#include <cstdio>
int main()
{
    ceduo_flag stop{true};
    double x[] = {0, 100}, z[] = {0, -60};
    ceduo_segment ground = ceduo_segment_default();
    ground.rn = ceduo_number(.3);
    ground.rt = ceduo_number(.8);
    ground.roughness_rad = .1;
    ceduo_option bare = {};
    ceduo_scene scene = ceduo_scene_default();
    scene.rock.diameter = ceduo_number(1);
    scene.slope.vertices = 2;
    scene.slope.x = x;
    scene.slope.z = z;
    scene.slope.segments = &ground;
    scene.options = &bare;
    scene.options_count = 1;
    ceduo_question question = ceduo_question_default(&scene);
    ceduo_answer answer;
    for (int i = 0; i < 2; i++) {
        std::printf("%d\\n", ceduo_ask(&question, nullptr, &answer));
        ceduo_answer_release(&answer);
        question.run.cancel = &stop;
    }
}
""")
        done = subprocess.run(["g++", "-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Werror", *BUILT.split(), "-o", place.path / "ask",
                               source, *place.flags("--cflags", "--libs")], capture_output=True, text=True, check=False)
        expect_equal((done.returncode, done.stderr), (0, ""), "compiler")
        expect_equal(place.shell("./ask"), "0\n2\n", "status: done, cancelled")


def test_version():
    """pkg-config knows the version of the library"""
    with Library() as place:
        wanted = re.search(r'CEDUO_VERSION "(.*)"', (ROOT / "include/ceduo/version.h").read_text())[1]
        expect_equal(place.flags("--modversion"), [wanted])


def test_odd_folder():
    """The library may be installed in a folder with blanks and signs: pkg-config names it, the example compiles"""
    with Library(ODD) as place:
        flags = place.flags("--cflags", "--libs")
        expect_equal(flags[:3], [f"-I{place.root}/include", f"-L{place.root}/lib", "-lceduo"])
        source = place.write("mill.c", SOURCE)
        done = subprocess.run([*CC.split(), *BUILT.split(), "-o", place.path / "mill", source, *flags], capture_output=True, text=True,
                              check=False)
        expect_equal((done.returncode, done.stderr), (0, ""), "compiler")
        expect_equal(place.shell("./mill"), OUTPUT, "output")


def test_headers():
    """Each installed header stands by itself"""
    with Library() as place:
        names = sorted(p.name for p in (ROOT / "include/ceduo").glob("*.h"))
        for name in names:
            place.write(f"{name}.c", f"#include <ceduo/{name}>\n#include <ceduo/{name}>\ntypedef int one;\n")
        place.shell(f"{CC} {STRICT} -fsyntax-only {shlex.join(place.flags('--cflags'))} {' '.join(f'{n}.c' for n in names)}")


if __name__ == "__main__":
    run_all(__name__)
