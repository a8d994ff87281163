#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""How long a huge mesh takes in blocks on many machines, from what blocks of a smaller one took.

    bench/simulate_blocks.py REPORTS --triangles 1000000000 --nodes 1 10 100 1000

REPORTS is a folder with reports of meshrepair-blocks: plan.json, join.json, and 1.json, 2.json ... of its blocks, each run
with one thread. Reading, grouping and writing of plan and join go on as they were measured, for each triangle, one after the
other. Blocks are drawn from those that were measured; each takes one core, the next that is free. All nodes share one disk: no
phase is faster than it gives and takes the bytes. Prints a table, and as JSON with --json."""

import argparse
import heapq
import json
import pathlib
import random


class Measured:
    """Seconds and bytes for each triangle, and seconds of blocks."""

    def __init__(self, folder):
        reports = {path.stem: json.loads(path.read_text()) for path in folder.glob("*.json")}
        plan, join = reports.pop("plan"), reports.pop("join")
        self.blocks = [(report["read"]["declared_triangles"], report["seconds"]) for report in reports.values()]
        triangles = sum(count for count, _ in self.blocks)
        self.plan = plan["seconds"] / triangles
        self.join = join["seconds"] / triangles
        self.repair = sum(seconds for _, seconds in self.blocks) / triangles
        self.input_bytes = plan["read"]["bytes"] / triangles
        self.block_bytes = sum(report["read"]["bytes"] for report in reports.values()) / triangles


def run_blocks(seconds, slots, start):
    """When the last of the blocks ends, each taking the slot that is free first."""
    free = [0.0] * min(slots, len(seconds))
    heapq.heapify(free)
    for one in sorted(seconds, reverse=True):
        heapq.heapreplace(free, free[0] + start + one)
    return max(free)


def simulate(measured, options, nodes):
    """Seconds of each phase. Results take as many bytes as the blocks that they are made of."""
    rng = random.Random(1)
    blocks = []
    left = options.triangles
    while left > 0:
        size = min(left, options.block)
        triangles, seconds = rng.choice(measured.blocks)
        blocks.append(seconds / triangles * size)
        left -= size
    cores = {
        "plan": measured.plan * options.triangles,
        "blocks": run_blocks(blocks, nodes * options.cores, options.start),
        "join": measured.join * options.triangles,
    }
    block_bytes = measured.block_bytes
    disk = {"plan": measured.input_bytes + block_bytes, "blocks": 2 * block_bytes, "join": 2 * block_bytes}
    return {phase: max(cores[phase], options.triangles * disk[phase] / (1e6 * options.disk)) for phase in cores}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("reports", type=pathlib.Path)
    parser.add_argument("--triangles", type=int, default=10**9)
    parser.add_argument("--block", type=int, default=10**6, help="triangles of a block (default: %(default)s)")
    parser.add_argument("--cores", type=int, default=16, help="of a node (default: %(default)s)")
    parser.add_argument("--start", type=float, default=1.0, help="seconds until a task starts (default: %(default)s)")
    parser.add_argument("--disk", type=float, default=1000, help="MB/s that the shared disk gives or takes (default: %(default)s)")
    parser.add_argument("--nodes", type=int, nargs="+", default=[1, 10, 100, 1000])
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    measured = Measured(options.reports)
    rows = [{"nodes": nodes, **simulate(measured, options, nodes)} for nodes in options.nodes]
    first = sum(rows[0][phase] for phase in ("plan", "blocks", "join"))
    for row in rows:
        row["seconds"] = row["plan"] + row["blocks"] + row["join"]
        row["efficiency"] = first * rows[0]["nodes"] / (row["seconds"] * row["nodes"])
    if options.json:
        print(json.dumps(rows, indent=2))
        return
    print(f"a million triangles: plan {1e6 * measured.plan:.3f} s, repair {1e6 * measured.repair:.2f} s, join {1e6 * measured.join:.3f} s")
    print("nodes  seconds  efficiency   plan  blocks   join")
    for row in rows:
        shares = [100 * row[phase] / row["seconds"] for phase in ("plan", "blocks", "join")]
        print(f"{row['nodes']:5d} {row['seconds']:8.0f} {100 * row['efficiency']:9.1f} % " + " ".join(f"{share:5.1f} %" for share in shares))


if __name__ == "__main__":
    main()
