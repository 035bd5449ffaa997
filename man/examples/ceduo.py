#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""ceduo from Python: read a scene, change it, simulate it, read its figures. Needs the library of ceduo and no compiler.

    import ceduo
    with ceduo.Scene("paper-site") as scene:
        scene.set("forest[0].stand.stools.per_ha", 800)
        scene.simulate(rocks=1000)
        share, low, high = scene.get("options[0].controls[0].wooded.reach_probability")

Paths to set are listed by `ceduo --list-parameters`. Paths to get are those of the JSON of `ceduo --batch --format json`, or
those to set. See ceduo(3). Run as a program, this file draws an example with Matplotlib.
"""
import array
import ctypes

try:
    import numpy
except ImportError:
    numpy = None

_lib = ctypes.CDLL("libceduo.so")
_handle, _text, _numbers = ctypes.c_uint64, ctypes.c_char_p, ctypes.POINTER(ctypes.c_double)
for _name, _result, *_arguments in [
        ("open", _handle, _text), ("close", ctypes.c_int, _handle), ("set", ctypes.c_int, _handle, _text, _text),
        ("simulate", ctypes.c_int, _handle, ctypes.c_uint64, ctypes.c_uint), ("get", ctypes.c_int, _handle, _text, _numbers),
        ("samples", ctypes.c_int64, _handle, ctypes.c_int, ctypes.c_size_t, _text, _numbers, ctypes.c_size_t),
        ("error", _text, _handle)]:
    _function = getattr(_lib, "ceduo_" + _name)
    _function.restype, _function.argtypes = _result, _arguments


class Error(Exception):
    """The description of a call that failed."""


class Scene:
    """A scene with its options. One thread at a time may use it; several scenes may be used at once."""

    def __init__(self, path):
        """Read a file, or a scene that comes with the program, by its name."""
        self._handle = _lib.ceduo_open(str(path).encode())
        if not self._handle:
            raise Error(_lib.ceduo_error(0).decode())

    def _check(self, failed):
        if failed:
            raise Error(_lib.ceduo_error(self._handle).decode())

    def set(self, path, value):
        """Set a number, or a text as it stands in a file."""
        self._check(_lib.ceduo_set(self._handle, path.encode(), str(value).encode()))

    def simulate(self, rocks=0, threads=1):
        """Simulate all options; rocks 0: the number in the scene."""
        self._check(_lib.ceduo_simulate(self._handle, rocks, threads))

    def get(self, path):
        """Return a number and the ends of its 95 % interval; nan: null, or no interval."""
        value = (ctypes.c_double * 3)()
        self._check(_lib.ceduo_get(self._handle, path.encode(), value))
        return tuple(value)

    def samples(self, quantity, option=-1, control=0):
        """Return the values of all rocks: energy_kJ, speed_m_s or height_m, nan for a rock that does not arrive; stop_x_m; weight.

        option -1: without forest. The result is an array of NumPy, if it is installed, otherwise one of the module array."""
        arguments = (self._handle, option, control, quantity.encode())
        count = _lib.ceduo_samples(*arguments, None, 0)
        self._check(count < 0)
        values = numpy.empty(count) if numpy else array.array("d", bytes(8 * count))
        place = values.ctypes.data if numpy else values.buffer_info()[0]
        self._check(_lib.ceduo_samples(*arguments, ctypes.cast(place, _numbers), count) < 0)
        return values

    def close(self):
        """Free the scene. A second call has no effect."""
        if self._handle:
            _lib.ceduo_close(self._handle)
        self._handle = 0

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def example(scene_path="four-systems", picture="standards.png"):
    """Draw the share of rocks that arrive, by the number of standards, and the energies of those that arrive."""
    from matplotlib import pyplot
    figure, (left, right) = pyplot.subplots(1, 2, figsize=(9, 4))
    option, standards, shares = "coppice with standards", range(0, 201, 20), []
    with Scene(scene_path) as scene:
        for n in standards:
            scene.set(f"options[{option}].forest[0].stand.trees[0].per_ha", n)
            scene.simulate()
            shares.append(scene.get(f"options[{option}].controls[0].wooded.reach_probability"))
        energies = scene.samples("energy_kJ", option=2)
    left.fill_between(standards, [low for _, low, _ in shares], [high for _, _, high in shares], alpha=.3)
    left.plot(standards, [share for share, _, _ in shares])
    left.set(xlabel="standards per ha", ylabel="share that arrives")
    right.hist([e for e in energies if e == e], bins=30)
    right.set(xlabel="energy, kJ", ylabel="rocks", title="200 standards per ha")
    figure.tight_layout()
    figure.savefig(picture)


if __name__ == "__main__":
    example()
