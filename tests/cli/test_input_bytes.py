#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input at byte level: line ends, invalid UTF-8, deep nesting, large or empty files."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from harness import Folder, expect, expect_in, expect_near, good, result, run_all, scene
from inputs import PLACE, check, expect_places, flat_scene


def bytes_refused(data, *words, place=None):
    with Folder() as f:
        f.write("s.yaml", data)
        done = check(f, "s.yaml")
        expect(all(w in done.err for w in words), f"none says {words}", done)
        if place:
            expect(done.err.startswith(f"s.yaml:{place[0]}:{place[1]}: "), f"not at {place}", done)
    return done


def test_line_ends():
    """CRLF, a byte order mark, a missing last line end are valid; an error after them has the right place"""
    text = flat_scene()
    with Folder() as f:
        for data in (text, text.replace(b"\n", b"\r\n"), b"\xef\xbb\xbf" + text, text.rstrip(b"\n"),
                     b"\xef\xbb\xbf" + text.replace(b"\n", b"\r\n"), b"%YAML 1.1\n---\n" + text, text + b"...\n",
                     b"# \xc3\xbc comment\n" + text):
            good("--check", f.write("s.yaml", data))
    bad = text.replace(b"diameter_m: 0.5", b"diameter_m: x")
    for data in (bad, bad.replace(b"\n", b"\r\n"), b"\xef\xbb\xbf" + bad):
        done = bytes_refused(data, "'x' is not a number", place=(3, 35))
        expect_places(done.err, {"s.yaml": data.decode()})
    data = b"\xef\xbb\xbfrock: 5\n"
    expect_places(bytes_refused(data, "expected a mapping", place=(1, 7)).err, {"s.yaml": data.decode()})


def test_unclosed():
    """An unclosed bracket or quote is shown with a line of the file and a caret"""
    for data in (b"rock: [", b"rock: {a: 1\n", b"title: 'small\n", b'title: "small', flat_scene() + b"more: {a: 1,\n\n"):
        done = bytes_refused(data)
        place = PLACE.match(done.err)
        expect(place and int(place[2]) <= len(data.splitlines()), "a line beyond the end of the file", done)
        expect(len(done.err.splitlines()) == 3 and done.err.splitlines()[2].strip() == "^", "no line and caret", done)


def test_nul():
    """NUL and other control characters are refused at their place"""
    for byte in (b"\0", b"\x01", b"\x1b", b"\x7f"):
        done = bytes_refused(flat_scene().replace(b"small", b"sm" + byte + b"all"), place=(2, 10))
        expect("control" in done.err or "NUL" in done.err, done)
    bytes_refused(flat_scene().replace(b"small", b'"sm\\0all"'), r"(\x00)", place=(2, 8))
    bytes_refused(b"\0" * 4096, place=(1, 1))


def test_not_utf8():
    """Invalid UTF-8 is refused at its place, also UTF-16 and Latin-1"""
    for bad in (b"\xff", b"\xc3", b"\xed\xa0\x80", b"\xf5\x80\x80\x80", b"\xc0\xaf", b"\xe4"):
        bytes_refused(flat_scene().replace(b"small", b"sm" + bad + b"all"), "UTF-8", place=(2, 10))
    bytes_refused(flat_scene().decode().encode("utf-16"), "UTF-8")
    bytes_refused(flat_scene().replace(b"small", "Hänge".encode("latin-1")), "UTF-8", place=(2, 9))
    bytes_refused(flat_scene() + b"# end \xff", "UTF-8")


def test_alias_bomb():
    """A bomb of aliases is refused quickly"""
    bomb = b"a: &a [x, x, x, x, x, x, x, x, x]\n"
    for before, name in zip("abcdefgh", "bcdefghi"):
        bomb += f"{name}: &{name} [{', '.join(['*' + before] * 9)}]\n".encode()
    bytes_refused(bomb, "anchor", place=(1, 4))


def test_nesting():
    """100000 nested brackets, braces or dashes are refused quickly, without a crash"""
    for data in (b"[" * 100000, b"title: " + b"[" * 100000 + b"]" * 100000, b"{a: " * 100000, b"- " * 100000, b"? " * 100000,
                 b"title: " + b"{" * 100000, b"\n".join(b" " * i + b"a:" for i in range(2000))):
        done = bytes_refused(data)
        expect("deep" in done.err or "malformed" in done.err or "plain word" in done.err, done)
        expect(len(done.err) < 2000, f"{len(done.err)} characters of message")


def test_large():
    """YAML over 16 MiB and CSV over 64 MiB are refused; slightly smaller files are read"""
    with Folder() as f:
        base = flat_scene()
        f.write("large.yaml", base + b"#" * ((16 << 20) + 1 - len(base)))
        done = check(f, "large.yaml")
        expect("larger than 16 MiB" in done.err and "large.yaml: " in done.err, done)
        good("--check", f.write("fits.yaml", base + b"#" * ((16 << 20) - len(base))))
        f.write("s.yaml", scene(slope="large.csv"))
        row = b"0,64\n100,0\n"
        head = b"distance,elevation\n"
        f.write("large.csv", head + row + b"\n" * ((64 << 20) + 1 - len(head + row)))
        done = check(f, "s.yaml")
        expect("larger than 64 MiB" in done.err and "large.csv: " in done.err, done)
        f.write("large.csv", head + row + b"\n" * ((64 << 20) - len(head + row)))
        good("--check", "s.yaml", cwd=f.path)


def test_many_values():
    """A list of 10^6 values and 10^5 keys are refused quickly"""
    with Folder() as f:
        f.write("list.yaml", b"title: [" + b"1, " * 1000000 + b"1]\n")
        expect_in("more than 250000 values", check(f, "list.yaml").err)
        f.write("keys.yaml", b"".join(b"k%d: 1\n" % i for i in range(100000)))
        done = check(f, "keys.yaml")
        expect(len(done.err) < 20000, f"{len(done.err)} characters of message")
        f.write("long.yaml", b"title: small\n" + b"k" * 1000000 + b": 1\n")
        done = check(f, "long.yaml")
        f.write("number.yaml", flat_scene().replace(b"diameter_m: 0.5", b"diameter_m: 0." + b"5" * 1000000 + b"x"))
        check(f, "number.yaml")


def test_many_digits():
    """A number of 400 digits in range is read exactly"""
    with Folder() as f:
        for word in ("0." + "5" * 400, "0.5" + "0" * 400, "5e-1", "+0.5", ".5", "0.5e0", "5" + "0" * 399 + "e-400"):
            path = f.write("s.yaml", flat_scene().decode().replace("diameter_m: 0.5", f"diameter_m: {word}"))
            expect_near(result(path)["rock"]["mean_diameter_m"], float(word), 1e-15, word[:40])


def test_empty():
    """An empty file, blanks, a comment: reported as empty"""
    for data in (b"", b"\n\n", b"# nothing\n", b"---\n...\n", b"\xef\xbb\xbf"):
        done = bytes_refused(data)
        expect("s.yaml" in done.err and len(done.err.splitlines()) <= 3, done)
    for data in (b"- 1\n", b"word\n", b"'quoted'\n", b"12\n"):
        bytes_refused(data, "ceduo: scene/1", place=(1, 1))


if __name__ == "__main__":
    run_all(__name__)
