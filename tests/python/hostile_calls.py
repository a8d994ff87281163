#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Calls the Python package with arguments that make no sense: each ends well, or with an exception of the package's own.

Usage: hostile_calls.py PACKAGES CALLS [SEED]

PACKAGES is the folder that holds the package meshrepair, as build/release/python. Prints how the calls ended; exit code 1
where one ended otherwise. A crash ends the script.

Example: tests/python/hostile_calls.py build/release/python 2000
"""

import collections
import os
import random
import sys
import tempfile

sys.dont_write_bytecode = True

import numpy as np

GOOD_VERTICES = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], dtype=float)
GOOD_FACES = np.array([(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)])


class Liar:
    """Says that it is an array, and is none."""

    def __array__(self, dtype=None):
        raise RuntimeError("no\narray")

    def __len__(self):
        return 3


class EndlessRows:
    def __len__(self):
        return 2

    def __getitem__(self, index):
        return self


def of_any_kind():
    """What is no mesh at all."""
    return [None, 0, -1, 1e308, float("nan"), "text", b"bytes", True, object(), {}, set(), [], (), [None], [[]], [[], [1]],
            [[1, 2, 3], [4, 5]], "abc" * 3, range(3), iter([1]), Liar(), lambda: 1, type, Ellipsis, NotImplemented,
            np.array(None), np.array([None] * 3), np.array("abc"), np.array([["a", "b", "c"]]), 10 ** 5000, [[10 ** 400] * 3],
            np.array([[1j, 2, 3]]), np.zeros(3), np.zeros((0, 3)), np.zeros((3, 0)), np.zeros((2, 3, 3)), np.zeros(()),
            np.zeros((2, 2)), np.zeros((1, 3), bool), np.zeros((1, 3), "M8[s]"), np.zeros((1, 3), "V16"),
            np.ma.masked_array(GOOD_VERTICES, GOOD_VERTICES > 0), np.rec.array([(1, 2.0)]), bytearray(24), memoryview(b"abc"),
            [GOOD_VERTICES], (GOOD_VERTICES, None), (None, GOOD_FACES), [[float("inf")] * 3], [["1", "2", "3"]],
            [GOOD_VERTICES, GOOD_FACES, 1], np.float64(3), np.zeros((3, 3)).T[::-1]]


def vertices(chance):
    change = chance.choice(("nan", "inf", "huge", "tiny", "dtype", "fortran", "strided", "reversed", "readonly", "wide", "swapped",
                            "unaligned", "broadcast", "list", "good"))
    array = GOOD_VERTICES.copy()
    if change in ("nan", "inf", "huge", "tiny"):
        value = {"nan": np.nan, "inf": -np.inf, "huge": 1.7e308, "tiny": 5e-324}[change]
        array[chance.randrange(4), chance.randrange(3)] = value
    elif change == "dtype":
        array = array.astype(chance.choice("efdgbBhHiIlLqQ?FDOSU"))
    elif change == "fortran":
        array = np.asfortranarray(array)
    elif change == "strided":
        array = np.repeat(np.repeat(array, 2, axis=0), 3, axis=1)[::2, ::3]
    elif change == "reversed":
        array = array[::-1]
    elif change == "readonly":
        array.setflags(write=False)
    elif change == "wide":
        array = np.zeros((chance.randrange(5), chance.randrange(6)))
    elif change == "swapped":
        array = array.astype(chance.choice((">f8", ">f4", ">i2")))
    elif change == "unaligned":
        array = np.frombuffer(b"x" + array.tobytes(), dtype=np.uint8)[1:].view(np.float64).reshape(4, 3)
    elif change == "broadcast":
        array = np.broadcast_to(array[0], (4, 3))
    elif change == "list":
        array = array.tolist()
    return array


def faces(chance):
    change = chance.choice(("negative", "large", "huge", "dtype", "float", "fortran", "strided", "polygons", "short", "ragged",
                            "words", "empty", "wide", "good", "swapped", "repeated"))
    array = GOOD_FACES.copy()
    row, column = chance.randrange(4), chance.randrange(3)
    if change in ("negative", "large", "huge"):
        array[row, column] = {"negative": -1, "large": 4, "huge": 2 ** 62}[change]
    elif change == "dtype":
        array = array.astype(chance.choice("bBhHiIlLqQfd?OSU"))
    elif change == "float":
        array = array + 0.5
    elif change == "fortran":
        array = np.asfortranarray(array)
    elif change == "strided":
        array = np.repeat(array, 5, axis=1)[:, ::5]
    elif change == "polygons":
        array = [[0, 1, 2, 3], [0, 1, chance.choice((2, 9, -1, 2.5, None, "a"))]]
    elif change == "short":
        array = [[0, 1], [0, 1, 2]]
    elif change == "ragged":
        array = [[0, 1, 2], chance.choice((None, 3, [], [[0]], [0, 1, 2, [3]], [2 ** 70] * 4, [-2 ** 63] * 4))]
    elif change == "words":
        array = [["a", "b", "c"]]
    elif change == "empty":
        array = chance.choice(([], np.zeros((0, 3), int), np.zeros((0, 4), int), np.zeros(0), np.zeros((5, 0), int)))
    elif change == "wide":
        array = np.zeros((chance.randrange(4), chance.randrange(6)), dtype=int)
    elif change == "swapped":
        array = array.astype(">u4")
    elif change == "repeated":
        array[row] = 0
    return array


OPTION_NAMES = ("inside", "sew", "seal", "holes", "max_hole", "thicken", "keep", "min_part", "cavities", "only", "touching", "simplify", "for_",
                "always", "format", "precision", "strict", "threads", "time_limit", "max_memory", "max_triangles", "nan",
                "attributes", "progress", "drop", "eps", "predicates", "bogus", "help", "report", "verbose", "points",
                "", "-", "a b", "ä", "inside\0", "distance", "no_such", "scene", "units", "require", "origin", "negative",
                "beam_sides", "triangles", "max_error", "hollow", "drain", "drain_at", "thickness", "offset")
OPTION_VALUES = (None, True, False, 0, -1, 1e300, float("nan"), float("inf"), "auto", "none", "", "-", "--help", "x" * 10000, b"\xff",
                 "\ud800", "a\0b", [], [1], ["normals"], {}, object(), np.float32(0.5), np.int8(3), np.array([1]), 10 ** 5000, 1j,
                 "solidity", "1%", "print", "parts=same", 3, {"colour": np.zeros((4, 3))}, {"colour": np.zeros(2)}, {"colour": "red"}, {1: 2},
                 {"material": [0, 1]}, {"material": [9] * 4, "material_names": ["a"]}, Liar())


def arguments(chance):
    if chance.random() < 0.3:
        return chance.choice(of_any_kind()), chance.choice(of_any_kind())
    return ((chance.choice(of_any_kind()) if chance.random() < 0.15 else vertices(chance)),
            (chance.choice(of_any_kind()) if chance.random() < 0.15 else faces(chance)))


def options(chance):
    # A call is to end soon, whatever its options.
    found = {"time_limit": 20}
    if chance.random() < 0.35:
        found[chance.choice(OPTION_NAMES)] = chance.choice(OPTION_VALUES)
    return found


def call(package, chance, folder):
    kind = chance.choice(("repair", "repair", "repair", "check", "distance", "boolean", "points", "write", "read", "file"))
    first, second = arguments(chance)
    if kind == "repair":
        package.repair(first, second, **options(chance))
    elif kind == "check":
        package.check(first, second, **options(chance))
    elif kind == "distance":
        package.distance((first, second), chance.choice(((GOOD_VERTICES, GOOD_FACES), first)), samples=10, **options(chance))
    elif kind == "boolean":
        meshes = chance.choice(([(first, second), (GOOD_VERTICES, GOOD_FACES)], first, [(first, second)]))
        package.boolean(meshes, chance.choice(("union", "difference", "bogus", None, 3)), **options(chance))
    elif kind == "points":
        package.repair_points(first, chance.choice((None, vertices(chance), second)), **options(chance))
    elif kind == "write":
        path = os.path.join(folder, chance.choice(("a.obj", "a.stl", "a.ply", "a.xyz", "", "no/such/a.obj", "a\0.obj", ".")))
        package.write(chance.choice((path, path, None, 3)), first, second, **options(chance))
    elif kind == "read":
        package.read(chance.choice((folder, "/no/such/file", "", None, 3, b"\xff", "a\0b", "-", first)), **options(chance))
    else:
        package.repair_file(chance.choice(("/no/such/file", "-", None, "")), os.path.join(folder, "b.obj"), **options(chance))


def main():
    sys.path.insert(0, os.path.abspath(sys.argv[1]))
    import meshrepair
    calls, seed = int(sys.argv[2]), int(sys.argv[3]) if len(sys.argv) > 3 else 1
    ends, faults = collections.Counter(), 0
    with tempfile.TemporaryDirectory(prefix="hostile_") as folder:
        for number in range(calls):
            try:
                call(meshrepair, random.Random(f"{seed} {number}"), folder)
                ends["no exception"] += 1
            except meshrepair.Error as error:
                ends[type(error).__name__] += 1
                if "\n" in str(error) or not str(error):
                    faults += 1
                    print(f"call {number}: the message has not one line: {str(error)!r}")
            except Exception as error:  # noqa: what this looks for
                faults += 1
                print(f"call {number}: {type(error).__name__}: {error}")
    print(f"{calls} calls: {', '.join(f'{name} {count}' for name, count in sorted(ends.items()))}; {faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
