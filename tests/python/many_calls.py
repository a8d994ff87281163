#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Calls repair() many times from four threads: results are the same each time, and memory does not grow.

Usage: many_calls.py PACKAGES CALLS

PACKAGES is the folder that holds the package meshrepair, as build/release/python. Exit code 1 where a result differs, or
where memory has grown by more than 8 MB from the first quarter of the calls to the last.

Example: tests/python/many_calls.py build/release/python 10000
"""

import gc
import os
import sys
import threading
import time

sys.dont_write_bytecode = True

import numpy as np

THREADS = 4
MOST_GROWTH = 8e6  # bytes; allocators keep some for threads
CUBE = np.array([(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
QUADS = np.array([(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])


def meshes():
    """Broken in several ways: an open one, one that crosses itself, one that is turned, one with attributes."""
    two = np.vstack([CUBE, CUBE + 0.4]), np.vstack([QUADS, QUADS + 8])
    turned = QUADS.copy()
    turned[2] = turned[2][::-1]
    return [(CUBE, QUADS[1:], None), (*two, None), (CUBE, turned, None), (CUBE.astype(np.float32), QUADS, {"colour": CUBE})]


def resident():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def main():
    sys.path.insert(0, os.path.abspath(sys.argv[1]))
    calls = int(sys.argv[2])
    import meshrepair

    def repaired(mesh):
        result = meshrepair.repair(mesh[0], mesh[1], attributes=mesh[2])
        return result.vertices.tobytes(), result.faces.tobytes(), result.source.tobytes(), result.certified

    cases = meshes()
    expected = [repaired(mesh) for mesh in cases]
    differ, memory = [], []

    def work(thread):
        for number in range(thread, calls, THREADS):
            case = number % len(cases) if thread % 2 else (number // THREADS) % len(cases)
            if repaired(cases[case]) != expected[case]:
                differ.append(number)
            if number % (calls // 20 or 1) < THREADS and thread == 0:
                memory.append(resident())
    start = time.monotonic()
    threads = [threading.Thread(target=work, args=(thread,)) for thread in range(THREADS)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    seconds = time.monotonic() - start
    gc.collect()
    early, late = memory[len(memory) // 4], max(memory[-3:])
    print(f"{calls} calls from {THREADS} threads in {seconds:.1f} s: {len(differ)} differ; resident "
          f"{early / 1e6:.1f} MB after a quarter, {late / 1e6:.1f} MB at the end")
    return 1 if differ or late > early + MOST_GROWTH else 0


if __name__ == "__main__":
    sys.exit(main())
