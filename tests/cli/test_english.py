#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
# tags: quick unsanitized
"""Plain English in comments, names and messages: tests/language.txt lists the counted patterns.

With --show WORD: prints each match of the patterns that contain the word.
"""
import re
import sys

import harness
from harness import ROOT, expect

PATTERNS = ROOT / "tests" / "language.txt"
COMMENT = re.compile(r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])+\'|/\*(.*?)\*/|//([^\n]*)', re.S)
MESSAGE = re.compile(r'\b(?:N?P?_|ngettext)\(\s*((?:"(?:\\.|[^"\\])*"\s*(?:PRI\w+\s*)?,?\s*)+)')


def files(*folders):
    return [path for folder in folders for path in sorted((ROOT / folder).rglob("*.[ch]"))]


def comments(text):
    """Yield position and text of each comment, in one line."""
    for found in COMMENT.finditer(text):
        body = found[1] or found[2]
        if body and "untaken:" not in body and "SPDX" not in body:
            yield found.start(), " ".join(re.sub(r"^\s*\*", "", line).strip() for line in body.splitlines()).strip()


def names(text):
    """Yield position and text of each identifier outside comments and strings."""
    bare = COMMENT.sub(lambda found: " " * len(found[0]), text)
    for found in re.finditer(r"[A-Za-z_]\w*", bare):
        yield found.start(), found[0]


def messages(text):
    """Yield position and English text of each translated message."""
    for found in MESSAGE.finditer(COMMENT.sub(lambda f: f[0] if f[0][0] in "\"'" else " " * len(f[0]), text)):
        strings = re.findall(r'"((?:\\.|[^"\\])*)"', found[1])
        yield found.start(), "".join(strings[found[0].startswith(("P_", "NP_")):])


READERS = {"comment": (comments, ("src", "include", "tests", "man")), "name": (names, ("src", "include")),
           "message": (messages, ("src",))}


def patterns():
    for number, line in enumerate(PATTERNS.read_text(encoding="utf-8").splitlines(), 1):
        if line.strip() and not line.startswith("#"):
            kind, allowed, pattern = line.split(" ", 2)
            yield number, kind, int(allowed), re.compile(pattern, re.I)


def found():
    """Yield each pattern with its line, its allowed count and its matches."""
    texts = {path: path.read_text(encoding="utf-8") for path in files("src", "include", "tests", "man")}
    read = {}
    for kind, (reader, folders) in READERS.items():
        read[kind] = [(path, text, list(reader(text))) for path, text in texts.items()
                      if str(path.relative_to(ROOT)).startswith(folders)]
    for number, kind, allowed, pattern in patterns():
        places = [f"{path.relative_to(ROOT)}:{text.count(chr(10), 0, at) + 1}: {words}"
                  for path, text, items in read[kind] for at, words in items if pattern.search(words)]
        yield number, kind, allowed, pattern.pattern, places


def test_patterns():
    """Each pattern of language.txt has exactly its allowed count"""
    wrong = [f"language.txt:{number}: {kind} {pattern!r}: {len(places)}, allowed {allowed}" + "".join(f"\n#   {p}" for p in places[:8])
             for number, kind, allowed, pattern, places in found() if len(places) != allowed]
    expect(not wrong, *wrong)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--show"]:
        for number, kind, allowed, pattern, places in found():
            if all(word in pattern for word in sys.argv[2:]):
                print(f"{kind} {len(places)} (allowed {allowed}) {pattern}", *places, sep="\n    ")
        sys.exit()
    if sys.argv[1:] == ["--count"]:
        for number, kind, allowed, pattern, places in found():
            print(f"{len(places):6} {kind} {pattern}")
        sys.exit()
    if sys.argv[1:] == ["--lower"]:
        lines = PATTERNS.read_text(encoding="utf-8").splitlines()
        for number, kind, allowed, pattern, places in found():
            lines[number - 1] = f"{kind} {min(allowed, len(places))} {pattern}"
        PATTERNS.write_text("\n".join(lines) + "\n", encoding="utf-8")
        sys.exit()
    suite = harness.Suite()
    suite.run(harness.list_tests(sys.modules[__name__]))
    suite.end()
