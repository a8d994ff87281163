#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of scripts/cluster: one mesh repaired in blocks by Slurm and by Snakemake, as this machine does it alone.

Usage: cluster_blocks_test.py MESHREPAIR_BLOCKS [OPTIONS OF UNITTEST]

A class is skipped, with exit code 77, where its programs are not installed (scripts/setup.sh cluster), or this is not root.
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "apps"))

from blocks_test import RINGS, write_rings
from small_cluster import CLUSTER, SECONDS, SmallCluster, need, run_tests

PROGRAM = ""  # set at the end


class OneMesh(unittest.TestCase):
    """A mesh in blocks, and what one undisturbed run of each makes of it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="cluster_blocks_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.mesh, self.blocks, self.out = self.folder / "rings.stl", self.folder / "blocks", self.folder / "out.ply"
        write_rings(self.mesh)
        self.repair_alone(self.folder / "alone", self.folder / "alone.ply")

    def verb(self, *arguments):
        subprocess.run([PROGRAM, arguments[0], "-q", *arguments[1:]], check=True, timeout=SECONDS)

    def plan(self, blocks):
        self.verb("plan", self.mesh, blocks, "--triangles", "1000")

    def repair_alone(self, blocks, out):
        self.plan(blocks)
        for block in range(1, RINGS + 1):
            self.verb("run", blocks, "--block", str(block))
        self.verb("join", blocks, out)

    def assert_same_bytes(self):
        self.assertEqual(self.out.read_bytes(), (self.folder / "alone.ply").read_bytes())


class Slurm(OneMesh):
    def setUp(self):
        super().setUp()
        self.blocks, self.out = self.folder / "our blöcke", self.folder / "das 'große.ply"
        self.plan(self.blocks)
        self.cluster = SmallCluster(self, self.folder / "slurm")

    def submit(self):
        said = self.cluster.run(CLUSTER / "slurm_blocks.sh", "--program", PROGRAM, "--sbatch", "--mem-per-cpu=500M", "--join", "--mem=500M",
                                str(self.blocks), str(self.out))
        self.assertRegex(said, r"^array \d+, join \d+;")

    def test_an_array(self):
        self.submit()
        self.cluster.wait_for_all()
        self.assert_same_bytes()

    def test_a_node_goes_and_a_task_is_killed(self):
        self.submit()
        self.cluster.lose_a_node_and_a_task()
        self.cluster.wait_for_all()
        self.submit()  # what the killed task has left
        self.cluster.wait_for_all()
        self.assert_same_bytes()


class Snakemake(OneMesh):
    def setUp(self):
        need("snakemake")
        super().setUp()

    def snakemake(self, profile, *options):
        return ["snakemake", "--quiet", "all", "--snakefile", CLUSTER / "Snakefile.blocks", "--profile", CLUSTER / "profiles" / profile,
                "--directory", self.folder, *options, "--config", f"mesh={self.mesh}", f"blocks={self.blocks}", f"out={self.out}",
                f"program={PROGRAM}", "plan=--triangles 1000"]

    def test_on_this_machine(self):
        done = subprocess.run(self.snakemake("local"), check=False, capture_output=True, text=True, timeout=SECONDS)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assert_same_bytes()

    def test_as_jobs(self):
        cluster = SmallCluster(self, self.folder / "slurm")
        cluster.run(*self.snakemake("slurm", "--default-resources", "mem_mb=500", "runtime=10", "--set-resources", "plan:mem_mb=500",
                                    "block:mem_mb=500"))
        self.assert_same_bytes()


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    PROGRAM = os.path.abspath(sys.argv.pop(1))
    run_tests()
