#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: slow manual
"""The manual except ceduo-workflows(7) and ceduo(3): every command of a page runs, in order, and prints the shown text; every
shown file is read. `test_pages.py --write` updates the pages.

A comment precedes each display: "run WAY" for commands, "shows WAY" for the output of earlier commands, "file NAME" for a file,
"keys" for keys that replace those in the first file of the page."""
import os
import re
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import FULL, ROOT, Folder, expect, expect_equal, good, run_all  # noqa: E402
from test_workflows import Machine, render_literal  # noqa: E402

PAGES = sorted(p for p in (ROOT / "man").glob("*.[157]") if p.name != "ceduo-workflows.7")
SLOW = () if FULL else ("ceduo-model.7", "ceduo-validation.7")  # a million rocks; a fit of some minutes
MARKED = re.compile(r'^\.\\" (run|shows|file|keys)( \S+)?\n((?:(?!\.Bd|\.\\")[^\n]*\n)*\.Bd -literal[^\n]*\n)(.*?)^\.Ed$', re.M | re.S)
CEDUO = re.compile(r"^(?!ceduo$|ceduo four\\-systems$).*\bceduo (\\?-|\S+\.yaml)", re.M)


def troff(text):
    """Return text as in the source of a page."""
    text = re.sub(r"[^\x00-\x7f]", lambda m: f"\\[u{ord(m[0]):04X}]", text.replace("\\", "\\e").replace("-", "\\-"))
    return re.sub(r"^(?=[.'])", lambda m: "\\&", text, flags=re.M)


def render(text):
    """Return text as its reader sees it."""
    return render_literal(re.sub(r"\\\[u([0-9A-F]{4})\]", lambda m: chr(int(m[1], 16)), text))


UNDERSTOOD = r"[\w.-]+: (columns that are set: |colonne impostate: |\d+ plots |\d+ saggi )"  # on standard error


def played(page, **more):
    """Yield mark, name and text of each display of a page, and its commands' output."""
    with Folder() as work, Machine() as machine:
        printed = ""
        for m in MARKED.finditer(page.read_text(encoding="utf-8")):
            what, name, body = m[1], (m[2] or "").strip(), render(m[4])
            if what == "run":
                done = machine.run(body, work.path, **more)
                others = [line for line in done.stderr.splitlines() if not re.match(UNDERSTOOD, line)]
                expect(done.returncode == 0 and not others, f"{page.name}:", body, f"status {done.returncode}", done.stderr)
                printed = done.stdout
            elif what == "file":
                work.write(name, body)
            yield m, what, name, body, printed


def test_commands():
    """Every command of the pages runs, and prints the shown text"""
    for page in PAGES:
        for _, what, _, body, printed in () if page.name in SLOW else played(page):
            if what == "shows":
                expect_equal(printed, body, page.name)


def test_italian_samples():
    """The Italian ceduo-output(5) shows the Italian output of its commands"""
    page = ROOT / os.environ.get("BUILD", "build/release") / "man/it/ceduo-output.5"
    shows = [(printed, body) for _, what, _, body, printed in played(page, LANGUAGE="it") if what == "shows"]
    expect(len(shows) > 5, f"{len(shows)} displays")
    for printed, body in shows:
        expect_equal(printed, body, page.name)


def test_all_are_marked():
    """Every display with a command has a mark"""
    for page in PAGES:
        text = page.read_text(encoding="utf-8")
        rest = "\n".join(re.findall(r"^\.Bd -literal[^\n]*\n(.*?)^\.Ed$", MARKED.sub("", text), re.M | re.S))
        expect(not CEDUO.search(rest), f"{page.name}:", rest)


def split_by_key(text):
    """Return the lines of each key of a file."""
    return dict(re.findall(r"^(\w+)(:.*?\n)(?=\w|\Z)", re.sub(r"^#.*\n", "", text, flags=re.M), re.M | re.S))


def test_files():
    """Every file that a page shows is valid, also with each further key that it shows"""
    count = 0
    for page in PAGES:
        displays = [(m[1], (m[2] or "").strip(), render(m[4])) for m in MARKED.finditer(page.read_text(encoding="utf-8"))]
        with Folder() as f:
            files = [(name, body) for what, name, body in displays if what == "file" and name.endswith(".yaml")]
            for name, body in files:
                f.write(name, body)
            for what, _, body in displays:
                if what == "keys":
                    keys = {**split_by_key(files[0][1]), **split_by_key(body)}
                    if "options" in keys:
                        keys.pop("forest")
                    files.append((f.write(f"with-{count}.yaml", "".join(map("".join, keys.items()))).name, ""))
                    count += 1
            for name, body in files:
                kind = re.search(r"^ceduo: (\w+)/1$", body, re.M)
                given = {"slope": ["-s", f"slope={name}", "paper-site"], "stand": ["-s", f"forest[0].stand={name}", "paper-site"]}
                words = given.get(kind[1] if kind else "scene", [name])
                if kind and kind[1] == "slope":
                    words = ["-s", "forest=[]", *words]
                done = good("--check", *words, cwd=f.path)
                expect_equal(done.out + done.err, "", f"{page.name}: {name}")
    expect(count >= 4, count)


def write():
    for page in (p for p in PAGES if p.name not in SLOW):
        text, at, parts = page.read_text(encoding="utf-8"), 0, []
        for m, what, _, _, printed in played(page):
            parts += [text[at:m.start(4)], troff(printed) if what == "shows" else m[4]]
            at = m.end(4)
        page.write_text("".join(parts) + text[at:], encoding="utf-8")


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        write()
    else:
        run_all(__name__)
