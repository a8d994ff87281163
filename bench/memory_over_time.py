#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Repairs a mesh with several limits of memory, and draws how much memory was used, and when.

    bench/memory_over_time.py build/release/bin/meshrepair city.ply memory.svg 500M 1G 2G

The outputs have to be the same; they and the file of large arrays lie in --temp, and are removed. Prints for each limit
the wall time, the most memory, and the size of the file."""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

INTERVAL = 0.01  # seconds between looks
WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 760, 320, 60, 20, 20, 45
COLORS = ["#4477aa", "#ee6677", "#228833", "#ccbb44", "#aa3377"]
UNITS = {"K": 1 << 10, "M": 1 << 20, "G": 1 << 30}


def bytes_of(limit):
    return int(float(limit[:-1]) * UNITS[limit[-1]])


def sampled(command):
    """Its exit code, wall time, and (seconds, bytes) of each look."""
    start, page, looks = time.monotonic(), os.sysconf("SC_PAGESIZE"), []
    process = subprocess.Popen(command)
    while process.poll() is None:
        try:
            resident = int(pathlib.Path(f"/proc/{process.pid}/statm").read_text().split()[1]) * page
            looks.append((time.monotonic() - start, resident))
        except (FileNotFoundError, ProcessLookupError, IndexError):
            pass
        time.sleep(INTERVAL)
    return process.returncode, time.monotonic() - start, looks


def highest_of_each(looks, seconds, columns):
    """The most of the looks in each of as many columns as the picture has, so that no peak is lost."""
    most = {}
    for at, resident in looks:
        column = min(columns - 1, int(at / seconds * columns))
        most[column] = max(most.get(column, 0), resident)
    return sorted(most.items())


def drawn(runs):
    seconds = max(run["seconds"] for run in runs)
    top = 1.1 * max(max(run["limit"], max(bytes for _, bytes in run["looks"])) for run in runs)
    columns = WIDTH - LEFT - RIGHT

    def x(at):
        return LEFT + columns * at / seconds

    def y(size):
        return HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * size / top

    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="12">',
        f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
        f'<path d="M{LEFT} {TOP} V{HEIGHT - BOTTOM} H{WIDTH - RIGHT}" fill="none" stroke="#444"/>',
        f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 8}" text-anchor="middle">seconds</text>',
        f'<text x="{WIDTH - RIGHT}" y="{HEIGHT - 25}" text-anchor="end">{seconds:.0f}</text>',
        f'<text x="{LEFT}" y="{HEIGHT - 25}" text-anchor="middle">0</text>'
    ]
    for run, color in zip(runs, COLORS):
        limit = y(run["limit"])
        lines.append(f'<path d="M{LEFT} {limit:.1f} H{WIDTH - RIGHT}" stroke="{color}" stroke-dasharray="4 4"/>')
        lines.append(f'<text x="{LEFT - 6}" y="{limit + 4:.1f}" text-anchor="end" fill="{color}">{run["name"]}</text>')
        points = " ".join(f"{x(column / columns * seconds):.0f},{y(size):.1f}"
                          for column, size in highest_of_each(run["looks"], seconds, columns))
        lines.append(f'<polyline points="{points}" fill="none" stroke="{color}" stroke-width="1.5"/>')
    return "\n".join([*lines, "</svg>", ""])


def run_with(program, mesh, name, folder):
    out, report = folder / f"{name}.ply", folder / f"{name}.json"
    code, seconds, looks = sampled(
        [program, "-q", "--max-memory", name, "--temp", folder, mesh, out, "--report", report])
    if code != 0:
        sys.exit(f"exit code {code} with {name}")
    told = json.loads(report.read_text())
    file = told.get("temp_file", {}).get("bytes", 0)
    print(f"{name}: {seconds:.1f} s, most {told['peak_memory_bytes'] / 2**20:.0f} MB, file {file / 2**20:.0f} MB", flush=True)
    return {"name": name, "limit": bytes_of(name), "seconds": seconds, "looks": looks, "out": out}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("mesh", type=pathlib.Path)
    parser.add_argument("picture", type=pathlib.Path, metavar="OUT.svg")
    parser.add_argument("limits", nargs="+", metavar="LIMIT", help="such as 500M or 2G")
    parser.add_argument("--temp", type=pathlib.Path, default="/var/tmp", help="a folder on a disk")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(dir=arguments.temp) as folder:
        runs = [run_with(arguments.program.resolve(), arguments.mesh, name, pathlib.Path(folder)) for name in arguments.limits]
        for run in runs[1:]:
            if subprocess.run(["cmp", runs[0]["out"], run["out"]]).returncode != 0:
                sys.exit("the outputs differ")
    arguments.picture.write_text(drawn(runs))


if __name__ == "__main__":
    main()
