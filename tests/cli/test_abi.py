#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: quick uncounted unsanitized
"""What C programs rely on: names, functions and sizes of the public headers.

After a struct has changed: raise SONAME in the Makefile, then write tests/abi.txt with --write."""
import os
import re
import subprocess
import sys

from harness import ROOT, Folder, Skip, expect, expect_equal, run_all
from test_install import SONAME

CC = os.environ.get("CC", "cc").split()
HEADERS = ("scene", "simulate", "years", "uncertainty", "calibrate", "survey")
LIST = ROOT / "tests/abi.txt"
FUNCTIONS_MAX = 60


def read_header(name):
    text = (ROOT / f"include/ceduo/{name}.h").read_text(encoding="utf-8")
    return re.sub(r"/\*.*?\*/", "", text, flags=re.S)


def find_functions(*names):
    text = "".join(read_header(name) for name in names)
    return re.findall(r"^(?!typedef|#)[a-z].*?\b(ceduo_\w+)\([^;{}]*\);", text, re.M)


def measure_structs():
    """Return a line for each public struct: its name and size."""
    names = [n for header in HEADERS for n in re.findall(r"^struct (\w+) \{", read_header(header), re.M)]
    lines = "".join(f'printf("{n} %zu\\n", sizeof(struct {n}));\n' for n in names)
    with Folder() as place:
        source = place.write("sizes.c", f"#include <ceduo/ceduo.h>\n#include <stdio.h>\nint main(void)\n{{\n{lines}}}\n")
        subprocess.run([*CC, "-std=c17", f"-I{ROOT}/include", "-o", place.path / "sizes", source], check=True)
        return subprocess.run([place.path / "sizes"], stdout=subprocess.PIPE, text=True, check=True).stdout


def test_struct_sizes():
    """No struct has another size than in the list of this soname"""
    if sys.maxsize < 2**32:
        raise Skip("the list is for pointers of 64 bits")
    soname, sizes = LIST.read_text().split("\n", 1)
    expect_equal(soname, SONAME, "the soname; after a change of it: --write")
    expect_equal(measure_structs(), sizes, "sizes; raise SONAME, then --write")


def test_functions():
    """Six headers declare at most sixty functions, and ceduo(3) lists each of them and of the handle"""
    functions = find_functions(*HEADERS)
    expect(40 < len(functions) <= FUNCTIONS_MAX, len(functions))
    page = (ROOT / "man/ceduo.3").read_text(encoding="utf-8")
    section = page[page.index(".Ss Functions"):page.index(".Ss Threads")]
    listed = re.findall(r"^\.It Fn (ceduo_\w+)", section, re.M)
    expect_equal(sorted(listed), sorted(functions), "list of ceduo(3)")
    handle = set(find_functions("handle"))
    expect_equal(handle - set(re.findall(r"^\.F[no] (ceduo_\w+)", page, re.M)), set(), "handle")


def test_enum_constants():
    """Each constant of an enum begins with the name of its type; ceduo_status is CEDUO_ alone"""
    wrong, found = [], 0
    for header in HEADERS:
        text = read_header(header)
        lists = dict(re.findall(r"^#define (CEDUO_\w+)\(X\)(.*?)\n\n", text.replace("\\\n", " "), re.M | re.S))
        for name, body in re.findall(r"^enum (\w+) \{(.*?)\}", text, re.M | re.S):
            prefix = "CEDUO_" if name == "ceduo_status" else re.sub(r"_(kind|from)$", "", name).upper()
            pasted = re.search(r"#define X\([^)]*\) (\w*)##NAME", body)
            made = [pasted[1]] if pasted else []
            body = re.sub(r"^\s*#.*$|\w+\(X\)", "", body, flags=re.M)
            constants = made + re.findall(r"\b(CEDUO_\w+)(?=\s*(?:=|,|$))", body)
            found += len(constants)
            wrong += [f"{name}: {constant}" for constant in constants if not constant.startswith(prefix)]
            expect(not pasted or lists, name)
    expect(found > 60, found)
    expect_equal(wrong, [], "constants")


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        if LIST.exists() and LIST.read_text().split("\n", 1)[0] == SONAME and LIST.read_text().split("\n", 1)[1] != measure_structs():
            sys.exit(f"a struct changed: raise {SONAME} in the Makefile first")
        LIST.write_text(f"{SONAME}\n{measure_structs()}")
    else:
        run_all(__name__)
