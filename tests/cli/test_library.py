#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: uncounted manual
"""ceduo(3): the example of the page compiles and runs with the installed library and headers."""
import json
import os
import re
import shlex
import shutil
import subprocess

from harness import FULL, ROOT, Folder, Skip, ceduo, environment, expect, expect_equal, expect_near, run_all
from test_install import SONAME, VARIANT, make
from test_workflows import RUN, render_literal

PAGE = ROOT / "man/ceduo.3"
SOURCE, COMMANDS, OUTPUT, STATIC = [render_literal(body) for _, body in RUN.findall(PAGE.read_text(encoding="utf-8"))]
CC = os.environ.get("CC", "cc")
STRICT = "-std=c17 -Wall -Wextra -Wpedantic -Wconversion -Werror"
# Further needs of a program, besides ceduo.pc, with a special build of the library.
BUILT = {"asan": "-fsanitize=address,undefined", "tsan": "-fsanitize=thread"}.get(VARIANT, "")
# Blanks and special characters of the shell, make and pkg-config, all possible in a folder's name.
ODD = "it's a \"wood\" & 50% \\more; `x` $y #1"


class Library(Folder):
    """The library installed with a PREFIX: below DESTDIR, or in a named folder itself."""

    def __init__(self, folder=None):
        self.folder = folder

    def __enter__(self):
        if not shutil.which("pkg-config"):
            raise Skip("no pkg-config here")
        super().__enter__()
        stage, prefix = ("", f"{self.path}/{self.folder}") if self.folder else (f"{self.path}/root", "/opt/forest")
        self.root = stage + prefix
        make("install", "HASH=#", f"DESTDIR={stage}", "PREFIX=" + prefix.replace("$", "$$").replace("#", "$(HASH)"))
        self.env = environment(PKG_CONFIG_PATH=f"{self.root}/lib/pkgconfig", PKG_CONFIG_SYSROOT_DIR=stage or None,
                               LD_LIBRARY_PATH=f"{self.root}/lib", XDG_DATA_HOME=f"{self.root}/share")
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
    """The example compiles without a warning by the commands of the page, shared and static, and prints the page's output"""
    with Library() as place:
        place.write("stools.c", SOURCE)
        expect(COMMANDS.startswith("cc ") and STATIC.startswith("cc -static "), COMMANDS, STATIC)
        compiler = f"cc() {{ command {CC} {STRICT} {BUILT} \"$@\"; }}\n"
        expect_equal(place.shell(compiler + COMMANDS), OUTPUT, "output")
        needed = place.shell("readelf -d stools")
        expect(f"[{SONAME}]" in needed and "libgsl" not in needed, needed)
        if not BUILT:  # sanitizers are shared
            expect_equal(place.shell(f"{compiler}{STATIC}\nunset LD_LIBRARY_PATH\n./stools"), OUTPUT, "output")


CPP = """#include <ceduo/ceduo.h>
#include <cstdio>
#include <cstring>
int main()
{
    ceduo_flag stop{true};
    ceduo_scene_file file;
    const char *sets[] = {"simulation.rocks=50", nullptr};
    if (std::strcmp(ceduo_version(), CEDUO_VERSION) != 0 || ceduo_scene_read("paper-site", sets, &file) != CEDUO_OK)
        return 1;
    ceduo_request question = ceduo_request_default(&file.scene);
    ceduo_results answer;
    for (int i = 0; i < 2; i++) {
        std::puts(ceduo_status_text(ceduo_simulate_request(&question, nullptr, &answer)));
        ceduo_results_release(&answer);
        question.run.cancel = &stop;
    }
    ceduo_uncertainty_def uncertainty = ceduo_uncertainty_def_default(&file.scene);
    uncertainty.inputs_count = file.inputs_count;
    uncertainty.inputs = file.inputs;
    uncertainty.points = 20;
    uncertainty.rocks = uncertainty.own_rocks = 20;
    uncertainty.threads = 1;
    ceduo_uncertainty_result range;
    uncertainty.size--; // another version of the structure
    if (ceduo_uncertainty_compute(&uncertainty, &range) != CEDUO_BAD_ARGUMENT)
        return 4;
    uncertainty.size++;
    if (ceduo_uncertainty_compute(&uncertainty, &range) != CEDUO_OK)
        return 2;
    for (size_t i = 0; i < file.inputs_count; i++)
        std::puts(file.inputs[i].path);
    std::printf("%.17g %.17g\\n", range.figures[0].fit.p5, range.figures[0].fit.p95);
    ceduo_uncertainty_release(&range);
    ceduo_scene_file_release(&file);
    if (ceduo_scene_read("vaujany", nullptr, &file) != CEDUO_OK)
        return 3;
    for (size_t i = 0; i < file.observations_count; i++)
        std::puts(file.observations[i].name);
    ceduo_scene_file_release(&file);
    sets[0] = "rock.diameter_m=-1";
    if (ceduo_scene_read("paper-site", sets, &file) == CEDUO_BAD_FILE)
        std::fputs(file.messages, stdout);
    ceduo_scene_file_release(&file);
}
"""


def test_cpp():
    """A C++ program, shared and static: one header, no warning, a cancelling flag, the program's messages, and --sensitivity"""
    if not shutil.which("g++"):
        raise Skip("no C++ compiler here")
    with Library() as place:
        place.write("ask.cc", CPP)
        wanted = ceduo("--check", "-s", "rock.diameter_m=-1", "paper-site")
        expect_equal(wanted.status, 2)
        figure = json.loads(ceduo("--sensitivity=20", "-n", 20, "-f", "json", "paper-site").out)["figures"][0]
        years = json.loads(ceduo("--sensitivity=20", "--years", "-n", 20, "-f", "json", "paper-site").out)["figures"]
        inputs = next(f["inputs"] for f in years if f["figure"].startswith("rotation."))  # those of growth, too
        seen = re.findall(r"^  - name: (.*)\n(?:    .*\n)*?    option:", (ROOT / "profiles/scenes/vaujany.yaml").read_text(), re.M)
        known = "".join(f"{line}\n" for line in [*(i["path"] for i in inputs),
                                                f"{figure['uncertainty']['p5']:.17g} {figure['uncertainty']['p95']:.17g}", *seen])
        for how in [""] if BUILT else ["", "--static"]:
            place.shell(f"g++ -std=c++17 -Wall -Wextra -Wpedantic -Werror {how.replace('--', '-')} {BUILT} -o ask ask.cc "
                        f"$(pkg-config {how} --cflags --libs ceduo)")
            expect_equal(place.shell("./ask"), "done\ncancelled\n" + known + wanted.err, "statuses, what is not known, messages")


PYTHON = """
import ceduo
with ceduo.Scene("paper-site") as scene:
    scene.simulate(200)
    print(*scene.get("options[0].controls[0].wooded.reach_probability"), len(scene.samples("energy_kJ")))
"""
R = """source("ceduo.R")
scene <- ceduo_open("paper-site")
ceduo_simulate(scene, 200)
cat(format(ceduo_get(scene, "options[0].controls[0].wooded.reach_probability"), digits = 15), length(ceduo_samples(scene, "energy_kJ")))
ceduo_close(scene)
failed <- try(ceduo_get(scene, "rock.diameter_m"), silent = TRUE)
cat("", inherits(failed, "try-error"), "\\n")
ceduo_example()
"""


def test_python():
    """The module for Python reads a scene with the installed library"""
    if BUILT:
        raise Skip("the runtime of the sanitizers would have to come first")
    with Library() as place:
        share = ceduo("--batch", "-f", "json", "-n", 200, "paper-site").json()[0]["options"][0]["controls"][0]["wooded"]
        place.write("ask.py", PYTHON)
        words = place.shell(f"PYTHONPATH={shlex.quote(place.root)}/share/ceduo/examples python3 ask.py").split()
        expect_equal([float(w) for w in words], [*(share[k] for k in ("reach_probability", "reach_lo", "reach_hi")), 200.0])


def test_r():
    """The shim for R builds without a warning; R reads the same figures, sees an error, and draws the example"""
    if BUILT or not FULL or not shutil.which("R"):
        raise Skip("in make check-all, and with R")
    with Library() as place:
        share = ceduo("--batch", "-f", "json", "-n", 200, "paper-site").json()[0]["options"][0]["controls"][0]["wooded"]
        place.write("ask.R", R.replace("\\\\n", "\\n"))
        place.shell(f"cp {shlex.quote(place.root)}/share/ceduo/examples/* .\n"
                    "export PKG_CPPFLAGS=\"$(pkg-config --cflags ceduo)\" PKG_LIBS=\"$(pkg-config --libs ceduo)\"\n"
                    "R CMD SHLIB ceduo_r.c")
        words = place.shell("Rscript ask.R").split()
        for word, key in zip(words, ("reach_probability", "reach_lo", "reach_hi")):
            expect_near(float(word), share[key], 1e-14, key)
        expect_equal(words[3:], ["200", "TRUE"], "samples, an error")
        expect((place.path / "standards.pdf").stat().st_size > 2000, "the example's picture")


def test_exports():
    """The shared library has its name, and exports exactly the declarations of the headers"""
    with Library() as place:
        lines = place.shell(f"nm -D --defined-only {shlex.quote(place.root)}/lib/libceduo.so").splitlines()
        names = {line.split()[-1] for line in lines}
        text = "".join(p.read_text() for p in (ROOT / "include/ceduo").glob("*.h"))
        text = re.sub(r"/\*.*?\*/|^#.*?$|^typedef[^;]*;", "", text, flags=re.S | re.M)
        declared = set(re.findall(r"\b(ceduo_\w+)\([^;{}]*\);", text)) | set(re.findall(r"^extern .*?(ceduo_\w+)\[", text, re.M))
        expect(len(declared) == 67, len(declared))
        expect_equal(sorted(names ^ declared), [], "names")
        expect(f"[{SONAME}]" in place.shell(f"readelf -d {shlex.quote(place.root)}/lib/libceduo.so"), "soname")


def test_version():
    """pkg-config reports the version of the library"""
    with Library() as place:
        wanted = re.search(r'CEDUO_VERSION "(.*)"', (ROOT / "include/ceduo/scene.h").read_text())[1]
        expect_equal(place.flags("--modversion"), [wanted])


def test_odd_folder():
    """The library may be installed in a folder with special characters: pkg-config names it, the example compiles"""
    with Library(ODD) as place:
        flags = place.flags("--cflags", "--libs")
        expect_equal(flags[:3], [f"-I{place.root}/include", f"-L{place.root}/lib", "-lceduo"])
        source = place.write("stools.c", SOURCE)
        done = subprocess.run([*CC.split(), *BUILT.split(), "-o", place.path / "stools", source, *flags], capture_output=True, text=True,
                              check=False)
        expect_equal((done.returncode, done.stderr), (0, ""), "compiler")
        # the loader splits folders at a semicolon
        expect_equal(place.shell(f"cp {shlex.quote(place.root)}/lib/{SONAME} .\nLD_LIBRARY_PATH=$PWD ./stools"), OUTPUT, "output")


def test_headers():
    """Each installed header compiles alone"""
    with Library() as place:
        names = sorted(p.name for p in (ROOT / "include/ceduo").glob("*.h"))
        for name in names:
            place.write(f"{name}.c", f"#include <ceduo/{name}>\n#include <ceduo/{name}>\ntypedef int one;\n")
        place.shell(f"{CC} {STRICT} -fsyntax-only {shlex.join(place.flags('--cflags'))} {' '.join(f'{n}.c' for n in names)}")


if __name__ == "__main__":
    run_all(__name__)
