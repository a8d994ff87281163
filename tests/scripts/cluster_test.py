#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of scripts/cluster: a folder repaired by Slurm and by Snakemake, as one run does it.

Usage: cluster_test.py MESHREPAIR [OPTIONS OF UNITTEST]

A class is skipped, with exit code 77, where its programs are not installed (scripts/setup.sh cluster), or this is not root.
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True

import kill_folder
from small_cluster import CLUSTER, SCRIPTS, SECONDS, SmallCluster, need, run_tests

SAMPLES = SCRIPTS.parent / "samples/meshes"
COPIES = 10
MESHREPAIR = ""  # set at the end


class Folders(unittest.TestCase):
    """A folder of meshes, and what one undisturbed run makes of it."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="cluster_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.source, self.out = self.folder / "in", self.folder / "out"
        for i in range(COPIES):
            (self.source / str(i)).mkdir(parents=True)
            for mesh in SAMPLES.iterdir():
                shutil.copy(mesh, self.source / str(i) / mesh.name)
            (self.source / str(i) / "empty.stl").write_bytes(b"solid nothing\n")
        alone = self.folder / "alone"
        subprocess.run([SCRIPTS / "repair_folder.py", "-q", "--meshrepair", MESHREPAIR, self.source, alone], check=False,
                       capture_output=True)
        self.summary, self.files = kill_folder.comparable_summary(alone), kill_folder.outputs_in(alone)

    def assert_all_done(self):
        self.assertEqual(kill_folder.comparable_summary(self.out), self.summary)
        self.assertEqual(kill_folder.outputs_in(self.out), self.files)


class Slurm(Folders):
    def setUp(self):
        super().setUp()
        self.cluster = SmallCluster(self, self.folder / "slurm")

    def submit(self, shards):
        said = self.cluster.run(CLUSTER / "slurm_submit.sh", "--shards", str(shards), "--sbatch", "--mem=500M", "--folder",
                                f"--meshrepair {MESHREPAIR}", str(self.source), str(self.out))
        self.assertRegex(said, r"^array \d+, merge \d+;")

    def test_an_array(self):
        self.submit(6)
        self.cluster.wait_for_all()
        self.assert_all_done()

    def test_a_node_goes_and_a_task_is_killed(self):
        self.submit(12)
        self.cluster.lose_a_node_and_a_task()
        self.cluster.wait_for_all()
        self.submit(12)  # what the killed task has left
        self.cluster.wait_for_all()
        self.assert_all_done()


class Snakemake(Folders):
    def setUp(self):
        need("snakemake")
        super().setUp()

    def snakemake(self, *options):
        command = ["snakemake", "--quiet", "all", "--snakefile", CLUSTER / "Snakefile", "--profile", CLUSTER / "profiles/local", *options,
                   "--config", f"in_dir={self.source}", f"out_dir={self.out}", "shards=4", f"folder=--meshrepair {MESHREPAIR}"]
        result = subprocess.run(command, cwd=self.folder, check=False, capture_output=True, text=True, timeout=SECONDS)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_on_this_machine(self):
        self.snakemake()
        self.assert_all_done()
        (self.source / "0" / "new.stl").write_bytes((SAMPLES / "cube.stl").read_bytes())
        self.snakemake("--forceall")
        self.assertIn(b"0/new.stl", kill_folder.outputs_in(self.out))


class SnakemakeAndSlurm(Slurm):
    test_an_array = test_a_node_goes_and_a_task_is_killed = None

    def test_as_jobs(self):
        need("snakemake")
        self.cluster.run("snakemake", "--quiet", "all", "--snakefile", CLUSTER / "Snakefile", "--profile", CLUSTER / "profiles/slurm",
                       "--directory", self.folder, "--default-resources", "mem_mb=500", "runtime=10", "--set-resources", "share:mem_mb=500",
                       "--config", f"in_dir={self.source}", f"out_dir={self.out}", "shards=4", f"folder=--meshrepair {MESHREPAIR}")
        self.assert_all_done()


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    MESHREPAIR = os.path.abspath(sys.argv.pop(1))
    run_tests()
