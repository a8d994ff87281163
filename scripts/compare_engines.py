#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Compares meshrepair's two engines, exact predicates and floating ones, over a folder of meshes.

Prints a Markdown table, a row for each mesh, and totals. The exit code is 1 if a run crashed: ended by a signal or by
an internal error.
"""

import argparse
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

MESHES = {".stl", ".obj", ".off", ".ply"}
FALLBACKS = ["several_groups", "region_floods", "several_regions", "forced_cuts"]
LARGEST_ERROR = 1e-6  # of the volume, relative
INTERNAL_ERROR = 70
TIMED_OUT = "timeout"


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("program", type=Path, help="meshrepair")
    parser.add_argument("folder", type=Path, help="with STL, OBJ, OFF and PLY files")
    parser.add_argument("--eps", help="of the floating predicates (default: the program's own)")
    parser.add_argument("--timeout", type=float, default=120, help="seconds for a run (default: %(default)s)")
    parser.add_argument("--totals", action="store_true", help="print the totals alone")
    return parser.parse_args()


def run(program, mesh, options, timeout):
    """Exit code, and report, empty if there is none."""
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder, "report.json")
        command = [program, mesh, Path(folder, "out.obj"), "--quiet", "--report", report, *options]
        try:
            code = subprocess.run(command, timeout=timeout, stdin=subprocess.DEVNULL, capture_output=True).returncode
        except subprocess.TimeoutExpired:
            code = TIMED_OUT
        return code, json.loads(report.read_text()) if report.exists() else {}


def seconds_of(report, stage):
    return sum(s["cpu_seconds"] for s in report.get("stages", []) if s["name"] == stage)


def volume_of(report):
    volume = report.get("result", {}).get("volume")
    return volume if isinstance(volume, (int, float)) else math.nan


def error_of(exact, floating):
    """Relative difference of the volumes; NaN where one engine has none."""
    a, b = volume_of(exact), volume_of(floating)
    return abs(a - b) / abs(a) if a else math.nan


class Row:
    def __init__(self, args, mesh):
        floating = ["--always", "--predicates", "float"] + (["--eps", args.eps] if args.eps else [])
        self.name = mesh.name
        self.exact_code, self.exact = run(args.program, mesh, ["--always"], args.timeout)
        self.code, self.report = run(args.program, mesh, floating, args.timeout)
        self.error = error_of(self.exact, self.report)

    def cells(self):
        return self.report.get("cells", {})

    def fallbacks(self):
        return [self.cells().get("fallbacks", {}).get(kind, 0) for kind in FALLBACKS]

    def apart(self):
        return self.report.get("extract", {}).get("polygons_apart", 0)

    def crashed(self):
        return any(c == INTERNAL_ERROR or (isinstance(c, int) and c < 0) for c in (self.exact_code, self.code))

    def line(self):
        numbers = [self.cells().get("clips", 0), *self.fallbacks(), self.cells().get("guessed_facets", 0), self.apart()]
        error = "" if math.isnan(self.error) else f"{self.error:.1e}"
        times = [f"{seconds_of(r, 'cells'):.2f}" for r in (self.exact, self.report)]
        return "| " + " | ".join(map(str, [self.name, self.exact_code, self.code, *numbers, error, *times])) + " |"


def count_by(values):
    counts = {}
    for value in values:
        counts[value] = counts.get(value, 0) + 1
    return ", ".join(f"{key}: {counts[key]}" for key in sorted(counts, key=str))


def print_totals(rows):
    both = [row for row in rows if not math.isnan(row.error)]
    off = [row for row in both if row.error > LARGEST_ERROR]
    print(f"- meshes: {len(rows)}, crashes: {sum(row.crashed() for row in rows)}")
    print(f"- exit codes, exact: {count_by(row.exact_code for row in rows)}")
    print(f"- exit codes, float: {count_by(row.code for row in rows)}")
    print(f"- cuts: {sum(row.cells().get('clips', 0) for row in rows)}")
    for i, kind in enumerate(FALLBACKS):
        total = sum(row.fallbacks()[i] for row in rows)
        print(f"- {kind}: {total}, in {sum(row.fallbacks()[i] > 0 for row in rows)} meshes")
    print(f"- facets whose cover was guessed: {sum(row.cells().get('guessed_facets', 0) for row in rows)}")
    print(f"- facets that could not be merged: {sum(row.apart() for row in rows)}")
    print(f"- volume off by more than {LARGEST_ERROR:g}: {len(off)} of {len(both)} meshes that both engines made")
    exact, floating = (sum(seconds_of(getattr(row, name), "cells") for row in both) for name in ("exact", "report"))
    print(f"- CPU seconds of the cells of these: exact {exact:.2f}, float {floating:.2f}")


def main():
    args = arguments()
    meshes = sorted(p for p in args.folder.iterdir() if p.suffix.lower() in MESHES)
    if not meshes:
        sys.exit(f"{args.folder}: no meshes")
    rows = []
    if not args.totals:
        header = ["mesh", "exact", "float", "cuts", *FALLBACKS, "guessed", "apart", "volume error", "exact s", "float s"]
        print("| " + " | ".join(header) + " |\n|" + "---|" * len(header))
    for mesh in meshes:
        rows.append(Row(args, mesh))
        if not args.totals:
            print(rows[-1].line(), flush=True)
    print()
    print_totals(rows)
    return 1 if any(row.crashed() for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
