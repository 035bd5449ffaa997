# SPDX-License-Identifier: GPL-3.0-or-later
"""What the command-line tests share: running the program, scenes to run it on, TAP lines.

The program is the one that the environment's CEDUO names, or ./ceduo of this source tree.
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
    if signal.getsignal(number) == signal.SIG_IGN:  # in the background of a shell, under nohup; the program would ignore it, too
        signal.signal(number, usual)

ROOT = Path(__file__).resolve().parents[2]
PROFILES = ROOT / "profiles"
CEDUO = str(Path(os.environ.get("CEDUO") or ROOT / "ceduo").resolve())

PROGRAM = Path(CEDUO).read_bytes() if Path(CEDUO).exists() else b""
SANITIZED = b"__asan_init" in PROGRAM or b"__tsan_init" in PROGRAM  # they need memory of their own, and time
FULL = "FULL" in os.environ  # make check-all: what depends on the number of rocks has as many as it can use
SLOWER = 5 if b"__llvm_profile" in PROGRAM else 10 if SANITIZED else 1  # by so much what hangs is waited for
PATIENCE = 600 * SLOWER  # seconds until what has not come or ended counts as hanging: none is ever waited for in full

DONE, RUN, USAGE, INPUT, OUTPUT = range(5)  # exit statuses


class Failure(AssertionError):
    """An expectation that was not met; its text becomes the '# detail' lines."""


class Skip(Exception):
    """This machine lacks what the test needs."""


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
    """The class of the validators of JSON Schema; imported here because that takes longer than most tests."""
    try:
        import jsonschema
    except ImportError:  # another Python than the system's comes first
        sys.path.append("/usr/lib/python3/dist-packages")
        import jsonschema
    return jsonschema.Draft202012Validator


def parts_of(value, path=""):
    """Each place of an answer with its keys, its word, or the kind of its value."""
    if isinstance(value, dict):
        yield path, tuple(value)
        for key, inner in value.items():
            yield from parts_of(inner, f"{path}.{key}")
    elif isinstance(value, list):
        for inner in value:
            yield from parts_of(inner, path)
    else:
        yield path, value if isinstance(value, str) and value.isalpha() else float if type(value) is int else type(value)


def expect_schema(answer):
    """An answer in JSON is as --schema says of its format. To look takes long: in `make check` only if a part is unlike all before."""
    name, parts = answer["format"], {(answer["format"], *part) for part in parts_of(answer)}
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
    """That of the caller without what would change the output; None takes a variable out."""
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


# Control characters but line ends, what breaks lines or turns the order of text, and what Unicode keeps for no character.
NO_TEXT = re.compile("[\0-\x09\x0b-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069\ufdd0-\ufdef"
                     + "".join(chr(plane << 16 | 0xfffe) + chr(plane << 16 | 0xffff) for plane in range(17)) + "]")


def only_text(data, what):
    """No escape sequence can hide in it, and any page can hold it."""
    bad = sorted(set(NO_TEXT.findall(data.decode("utf-8", "replace"))))
    expect(not bad, f"{what} holds control characters {ascii(bad)}:", repr(data[:2000]))


def ceduo(*arguments, stdin=b"", env=None, cwd=ROOT, **options):
    """Runs the program to its end. A crash, a hang or a control character in its output is a failure everywhere."""
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
    """What a process that runs has taken of processors so far. On a machine with much to do this and the next tell better than a clock
    how soon a process ends."""
    times = Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    return (int(times[11]) + int(times[12])) / os.sysconf("SC_CLK_TCK")


def children_seconds():
    """What all processes that were waited for have taken of processors."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def without_unusual(err):
    """Standard error without warnings about unusual numbers, which many tests have on purpose; test_set.py has these warnings."""
    return re.sub(r"(?m)^.* is unusual \(usual: .*\n(?:  .*\n|\d+ more problems?\n)*", "", err)


def good(*arguments, **options):
    """Runs the program: status 0 and nothing on standard error, but what is unusual."""
    result = ceduo(*arguments, **options)
    expect(result.status == DONE and without_unusual(result.err) == "", result)
    return result


def results(*arguments, **options):
    """The JSON of a good batch run, one object a scene."""
    return good("--batch", "-f", "json", *arguments, **options).json()


def result(*arguments, **options):
    return results(*arguments, **options)[0]


def together(*calls):
    """Makes calls that wait, side by side; the first failure of them is raised."""
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
            content = json.dumps(content)  # flow YAML is a superset of it
        path.write_bytes(content.encode() if isinstance(content, str) else content)
        return path

    def profiles(self):
        """A copy of the shipped profiles, to be changed."""
        shutil.copytree(PROFILES, self.path / "profiles")
        return self.path / "profiles"

    def names(self):
        return sorted(p.name for p in self.path.iterdir())


def scene(**changes):
    """A small scene as a mapping: a straight slope of 100 m whose rocks all come down."""
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
    """A scene whose rocks fly: of those that the wood lets through some come to rest below it, and no two do the same."""
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
    """A belt of the small stand, changed."""
    return {"from_m": from_m, "to_m": to_m, "stand": stand(**changes)}


def of_today(option):
    """An option of JSON without what the years decide: them, their window and the answer over them."""
    controls = [{**c, "verdict": {"today": c["verdict"]["today"]}} for c in option["controls"]]
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
        except Exception:  # a broken test must not hide those after it
            word, details = "not ok", traceback.format_exc()
        self.failed += word != "ok"
        print(f"{word} {self.count} - {name.replace('#', '')}{note}", flush=True)
        if (seconds := time.process_time() + children_seconds() - start) >= 1:
            print(f"# {seconds:.1f} s of processor")
        for line in details.splitlines()[:60]:
            print("#", "".join(c if c.isprintable() else ascii(c)[1:-1] for c in line))
        if self.failed and os.environ.get("TEST_FIRST"):  # the first failure is enough
            self.end()

    def run(self, functions):
        """Each function is a test; its name is the first line of its docstring."""
        for function in functions:
            self.check(function.__doc__.strip().splitlines()[0].rstrip("."), function)

    def end(self):
        print(f"1..{self.count}")
        print(f"# {self.count - self.failed} of {self.count} passed in {time.monotonic() - self.start:.1f} s")
        sys.exit(1 if self.failed else 0)


def tests_of(module):
    """The functions test_… of a module in the order of their source."""
    found = [f for name, f in vars(module).items() if name.startswith("test_") and callable(f)]
    return sorted(found, key=lambda f: f.__code__.co_firstlineno)


def run_all(name):
    """Runs all tests of the module of that name, and ends the program."""
    suite = Suite()
    suite.run(tests_of(sys.modules[name]))
    suite.end()
