# SPDX-License-Identifier: GPL-3.0-or-later
"""Helpers of the command-line tests: running the program, scenes, TAP lines.

The program is $CEDUO, or ./ceduo of this source tree.
"""
import difflib
import json
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import traceback
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.dont_write_bytecode = True
for number, usual in ((signal.SIGINT, signal.default_int_handler), (signal.SIGHUP, signal.SIG_DFL)):
    if signal.getsignal(number) == signal.SIG_IGN:  # in a background shell, under nohup; the program would ignore it, too
        signal.signal(number, usual)

ROOT = Path(__file__).resolve().parents[2]
PROFILES = ROOT / "profiles"
CEDUO = str(Path(os.environ.get("CEDUO") or ROOT / "ceduo").resolve())

PROGRAM = Path(CEDUO).read_bytes() if Path(CEDUO).exists() else b""
SANITIZED = b"__asan_init" in PROGRAM or b"__tsan_init" in PROGRAM  # they need more memory and time
FULL = "FULL" in os.environ  # make check-all: tests that depend on the number of rocks use more rocks
SLOWER = 5 if b"__llvm_profile" in PROGRAM else 10 if SANITIZED else 1  # factor for the time limit of a hang
PATIENCE = 600 * SLOWER  # seconds after which a process counts as hanging; a passing test never waits this long

DONE, RUN, USAGE, INPUT, OUTPUT = range(5)  # exit statuses


class Failure(AssertionError):
    """An expectation failed; its text becomes the '# detail' lines."""


class Skip(Exception):
    """This machine lacks a requirement of the test."""


def expect(condition, *details):
    if not condition:
        raise Failure("\n".join(str(d) for d in details))


def expect_equal(found, wanted, what=""):
    if found != wanted and all(isinstance(text, str) and text.count("\n") > 1 for text in (found, wanted)):
        raise Failure("\n".join([f"{what}:", *difflib.unified_diff(wanted.splitlines(), found.splitlines(), "wanted", "found", "", "", 2, "")]))
    expect(found == wanted, f"{what}: found {found!r}, wanted {wanted!r}")


def expect_near(found, wanted, tolerance, what=""):
    expect(found is not None and abs(found - wanted) <= tolerance,
           f"{what}: found {found!r}, wanted {wanted!r} within {tolerance!r}")


def expect_in(part, whole, what=""):
    expect(part in whole, f"{what}: {part!r} is missing in:", whole)


# ---- running the program ----

class Result:
    def __init__(self, arguments, status, out, err, seconds):
        self.arguments, self.status, self.seconds = arguments, status, seconds
        self.out_bytes, self.err_bytes = out, err
        self.out = out.decode("utf-8", "replace")
        self.err = err.decode("utf-8", "replace")

    def __str__(self):
        return (f"ceduo {' '.join(map(str, self.arguments))}\nstatus {self.status} after {self.seconds:.2f} s\n"
                f"stdout: {self.out[:2000]}\nstderr: {self.err[:2000]}")

    def json(self):
        found = [json.loads(line, parse_constant=no_constant) for line in self.out.splitlines()]
        for answer in found:
            expect_schema(answer)
        return found


SCHEMAS, VALID = {}, set()


def validator():
    """Return the class of JSON Schema validators; imported here because the import takes longer than most tests."""
    try:
        import jsonschema
    except ImportError:  # another Python precedes the system's
        sys.path.append("/usr/lib/python3/dist-packages")
        import jsonschema
    return jsonschema.Draft202012Validator


def describe_parts(value, path=""):
    """Return each place of an answer with its keys, its word, or the kind of its value."""
    if isinstance(value, dict):
        yield path, tuple(value)
        for key, inner in value.items():
            yield from describe_parts(inner, f"{path}.{key}")
    elif isinstance(value, list):
        for inner in value:
            yield from describe_parts(inner, path)
    else:
        yield path, value if isinstance(value, str) and value.isalpha() else float if type(value) is int else type(value)


def expect_schema(answer):
    """Expect JSON to match --schema. Validation is slow: `make check` validates only answers with a new part."""
    name, parts = answer["format"], {(answer["format"], *part) for part in describe_parts(answer)}
    if VALID >= parts and not FULL:
        return
    VALID.update(parts)
    if name not in SCHEMAS:
        schema = subprocess.run([CEDUO, "--schema", name.split("-")[1]], capture_output=True, check=True).stdout
        SCHEMAS[name] = validator()(json.loads(schema))
    expect(SCHEMAS[name].schema["$id"].endswith(name), name)
    for wrong in SCHEMAS[name].iter_errors(answer):
        raise Failure(f"{'.'.join(map(str, wrong.absolute_path))}: {wrong.message}"[:500])


def no_constant(word):
    raise Failure(f"{word} in JSON")


def environment(**changes):
    """Return the caller's environment without variables that change the output; None removes a variable."""
    env = dict(os.environ)
    for name in list(env):
        if name.startswith("LC_") or name in ("LANG", "LANGUAGE", "NO_COLOR", "XDG_DATA_HOME", "XDG_DATA_DIRS"):
            del env[name]
    env.update({"LC_ALL": "C.UTF-8", "TERM": "xterm-256color", "HOME": "/nonexistent", "XDG_STATE_HOME": "/dev/null/none"})
    for name, value in changes.items():
        if value is None:
            env.pop(name, None)
        else:
            env[name] = value
    return env


# Control characters except line ends, line separators, bidirectional controls, and noncharacters of Unicode.
NO_TEXT = re.compile("[\0-\x09\x0b-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069\ufdd0-\ufdef"
                     + "".join(chr(plane << 16 | 0xfffe) + chr(plane << 16 | 0xffff) for plane in range(17)) + "]")


def only_text(data, what):
    """Expect no hidden escape sequence, so that any page can contain the text."""
    bad = sorted(set(NO_TEXT.findall(data.decode("utf-8", "replace"))))
    expect(not bad, f"{what} holds control characters {ascii(bad)}:", repr(data[:2000]))


def ceduo(*arguments, stdin=b"", env=None, cwd=ROOT, **options):
    """Run the program to its end. A crash, a hang or a control character in its output fails the test."""
    command = [CEDUO, *map(str, arguments)]
    start = time.monotonic()
    try:
        done = subprocess.run(command, input=stdin, stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=cwd,
                              env=environment(**(env or {})), timeout=PATIENCE, check=False, **options)
    except subprocess.TimeoutExpired as late:
        raise Failure(f"ceduo {' '.join(map(str, arguments))}", f"not ended after {PATIENCE} s") from late
    result = Result(arguments, done.returncode, done.stdout, done.stderr, time.monotonic() - start)
    expect(0 <= result.status <= 4, result)
    only_text(result.out_bytes, "stdout")
    only_text(result.err_bytes, "stderr")
    return result


def processor_seconds(pid):
    """Return the processor time of a running process so far. On a busy machine this and the next function are more reliable
    than the clock."""
    times = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(times[11]) + int(times[12])) / os.sysconf("SC_CLK_TCK")


def children_seconds():
    """Return the processor time of all finished child processes."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def without_unusual(err):
    """Return standard error without warnings of unusual numbers, which many tests use on purpose; test_set.py tests the
    warnings."""
    return re.sub(r"(?m)^.* is unusual \(usual: .*\n(?:  .*\n|\d+ more problems?\n)*", "", err)


def good(*arguments, **options):
    """Run the program: status 0, and nothing on standard error except warnings of unusual numbers."""
    result = ceduo(*arguments, **options)
    expect(result.status == DONE and without_unusual(result.err) == "", result)
    return result


def results(*arguments, **options):
    """Return the JSON of a good batch run, one object per scene."""
    return good("--batch", "-f", "json", *arguments, **options).json()


def result(*arguments, **options):
    return results(*arguments, **options)[0]


def together(*calls):
    """Run blocking calls in parallel; raise the first failure."""
    with ThreadPoolExecutor(len(calls)) as pool:
        for made in [pool.submit(*call) for call in calls]:
            made.result()


# ---- files ----

class Folder:
    """A temporary folder; `with Folder() as f:`."""

    def __enter__(self):
        self.path = Path(tempfile.mkdtemp(prefix="ceduo-test-"))
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.path, ignore_errors=True)

    def write(self, name, content):
        path = self.path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if isinstance(content, dict):
            content = json.dumps(content)  # flow YAML includes JSON
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    def profiles(self):
        """Copy the shipped profiles, to change them."""
        shutil.copytree(PROFILES, self.path / "profiles")
        return self.path / "profiles"

    def names(self):
        return sorted(p.name for p in self.path.iterdir())


def scene(**changes):
    """Return a small scene as a mapping: a straight slope of 100 m; all rocks reach its end."""
    mapping = {
        "ceduo": "scene/1",
        "title": "small",
        "rock": {"shape": "sphere", "diameter_m": 0.5},
        "release": {"vx_m_s": 1},
        "slope": {"vertices_m": [[0, 64], [100, 0]],
                  "segments": [{"rn": 0.35, "rt": 0.875, "roughness_rad": 0.125, "friction": 0.5}]},
        "controls": [{"x_m": 75}],
        "simulation": {"rocks": 200},
    }
    mapping.update(changes)
    return {key: value for key, value in mapping.items() if value is not None}


def stand(**changes):
    mapping = {"name": "coppice", "species": "ostrya-carpinifolia",
               "stools": {"per_ha": 2000, "spacing_m": 0.25},
               "shoots": [{"per_ha": 5000, "dbh_m": 0.0625, "height_m": 6, "volume_m3": 0.01}],
               "trees": [{"per_ha": 100, "dbh_m": 0.25, "height_m": 12, "volume_m3": 0.3}],
               "energy": {"model": "brauner", "u_J_m3": 100000, "offset": "whole"}}
    mapping.update(changes)
    return {key: value for key, value in mapping.items() if value is not None}


def wooded_scene(**changes):
    """Return a scene with flying rocks: some that pass the forest stop below it, and no two are equal."""
    mapping = {"title": "a wood below a cliff",
               "rock": {"shape": "sphere", "diameter_m": 0.75, "density_kg_m3": 2600},
               "release": {"vx_m_s": 2},
               "slope": {"vertices_m": [[0, 90], [100, 10], [160, 0]],
                         "segments": [{"rn": 0.35, "rt": 0.875, "roughness_rad": 0.25, "friction": 0.5},
                                      {"rn": 0.3, "rt": 0.8, "roughness_rad": 0.125, "friction": 0.6}]},
               "controls": [{"x_m": 60}, {"x_m": 105, "name": "road", "accepted_kJ": 60}],
               "forest": [{"from_m": 10, "to_m": 95, "stand": stand()}],
               "simulation": {"rocks": 2000}}
    mapping.update(changes)
    return scene(**mapping)


def belt(from_m, to_m, **changes):
    """Return a belt of the small stand, changed."""
    return {"from_m": from_m, "to_m": to_m, "stand": stand(**changes)}


def option_today(option):
    """Return an option of JSON without its years, their window and all that depends on it: answers, fences, the worst year."""
    controls = [{**c, "verdict": {"today": c["verdict"]["today"]}, "fence": c["fence"] and {**c["fence"], "window": None},
                 "design": c["design"] and {**c["design"], "worst": None}} for c in option["controls"]]
    return {**option, "controls": controls, "years": None, "rotation": None, "window": None}


# ---- TAP ----

class Suite:
    def __init__(self):
        self.count = self.failed = 0
        self.start = time.monotonic()

    def check(self, name, function, *arguments):
        self.count += 1
        details, word, note, start = "", "ok", "", time.process_time() + children_seconds()
        try:
            function(*arguments)
        except Skip as skip:
            note = f" # SKIP {skip}"
        except Failure as failure:
            word, details = "not ok", str(failure)
        except Exception:  # a broken test must not hide later ones
            word, details = "not ok", traceback.format_exc()
        self.failed += word != "ok"
        print(f"{word} {self.count} - {name.replace('#', '')}{note}", flush=True)
        if (seconds := time.process_time() + children_seconds() - start) >= 1:
            print(f"# {seconds:.1f} s of processor")
        for line in details.splitlines()[:60]:
            print("#", "".join(c if c.isprintable() else ascii(c)[1:-1] for c in line))
        if self.failed and os.environ.get("TEST_FIRST"):  # stop after the first failure
            self.end()

    def run(self, functions):
        """Run each function as a test; its name is the first line of its docstring."""
        for function in functions:
            self.check(function.__doc__.strip().splitlines()[0].rstrip("."), function)

    def end(self):
        print(f"1..{self.count}")
        print(f"# {self.count - self.failed} of {self.count} passed in {time.monotonic() - self.start:.1f} s")
        sys.exit(1 if self.failed else 0)


def list_tests(module):
    """Return the functions test_… of a module in source order."""
    found = [f for name, f in vars(module).items() if name.startswith("test_") and callable(f)]
    return sorted(found, key=lambda f: f.__code__.co_firstlineno)


def run_all(name):
    """Run all tests of the module of that name, and end the program."""
    suite = Suite()
    suite.run(list_tests(sys.modules[name]))
    suite.end()
