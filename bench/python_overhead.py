#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures what a call from Python costs beside the work itself, in time and in memory.

Usage: python_overhead.py PACKAGES [TRIANGLES...]

PACKAGES is the folder that holds the package meshrepair, as build/release/python. Prints a row for each number of triangles
(10, 1000, 100000 and 1000000 unless told): seconds of a call, the median of several; seconds of them that are not work,
which is what the report counts; what the process holds at most beyond what it held before; the size of the arrays, given
and returned; and the peak of the program on the same mesh.

Example: bench/python_overhead.py build/release/python 10 1000
"""

import os
import statistics
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True

import numpy as np


def bipyramids(triangles):
    """Solids of ten triangles, beside each other: valid as they are."""
    around = np.arange(5) * 2 * np.pi / 5
    corners = np.vstack([np.stack([np.cos(around), np.sin(around), 0 * around], axis=1), [(0, 0, 1), (0, 0, -1)]])
    sides = [t for k in range(5) for t in ((k, (k + 1) % 5, 5), ((k + 1) % 5, k, 6))]
    count = max(1, triangles // 10)
    wide = int(np.ceil(np.sqrt(count)))
    places = np.stack([3.0 * (np.arange(count) % wide), 3.0 * (np.arange(count) // wide), np.zeros(count)], axis=1)
    return (places[:, None] + corners).reshape(-1, 3), (7 * np.arange(count)[:, None, None] + np.array(sides)).reshape(-1, 3)


def status(name):
    with open("/proc/self/status", encoding="ascii") as file:
        return next(int(line.split()[1]) * 1024 for line in file if line.startswith(name))


def peak_of(call):
    """Bytes that the process holds at most while this runs, beyond what it held before."""
    before = status("VmRSS")
    with open("/proc/self/clear_refs", "w", encoding="ascii") as file:
        file.write("5")
    result = call()
    # The stages of a repair set the count back, and report it.
    peaks = [stage["peak_bytes"] for stage in result.report["stages"]]
    return max([status("VmHWM"), *peaks]) - before


def peak_of_program(program, path, folder):
    report = os.path.join(folder, "r.json")
    subprocess.run([program, "-q", path, os.path.join(folder, "out.ply"), "--report", report], check=True)
    with open(report, encoding="utf-8") as file:
        import json
        return json.load(file)["peak_memory_bytes"]


def main():
    sys.path.insert(0, os.path.abspath(sys.argv[1]))
    import meshrepair
    from meshrepair.program import program_path
    print(f"{'triangles':>9} {'seconds':>10} {'overhead s':>11} {'peak MB':>9} {'arrays MB':>10} {'program MB':>11}")
    for triangles in [int(word) for word in sys.argv[2:]] or [10, 1000, 100_000, 1_000_000]:
        vertices, faces = bipyramids(triangles)
        peak = peak_of(lambda: meshrepair.repair(vertices, faces))
        times, beside = [], []
        for _ in range(200 if triangles <= 1000 else 5):
            start = time.perf_counter()
            result = meshrepair.repair(vertices, faces)
            times.append(time.perf_counter() - start)
            beside.append(times[-1] - result.report["seconds"])
        arrays = sum(a.nbytes for a in (vertices, faces, result.vertices, result.faces, result.source))
        with tempfile.TemporaryDirectory(prefix="overhead_") as folder:
            path = os.path.join(folder, "in.ply")
            meshrepair.write(path, vertices, faces)
            program = peak_of_program(program_path(), path, folder)
        print(f"{len(faces):>9} {statistics.median(times):>10.6f} {statistics.median(beside):>11.6f} {peak / 1e6:>9.1f} "
              f"{arrays / 1e6:>10.1f} {program / 1e6:>11.1f}", flush=True)


if __name__ == "__main__":
    main()
