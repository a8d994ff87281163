# SPDX-License-Identifier: MIT
"""For tests: what they need or are skipped without, and a cluster of Slurm on this machine."""

import os
import pathlib
import shutil
import subprocess
import sys
import time
import unittest

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
CLUSTER = SCRIPTS / "cluster"
SECONDS = 300
SKIPPED = 77  # what CTest is told


def need(*programs):
    missing = [program for program in programs if shutil.which(program) is None]
    if missing or os.geteuid() != 0:
        raise unittest.SkipTest(f"{', '.join(missing) or 'root'} is missing")


def run_tests():
    """Runs the tests of the main module, and ends the process."""
    result = unittest.main(module="__main__", exit=False).result
    for _, reason in result.skipped:
        print(f"skipped: {reason}")
    sys.exit(1 if not result.wasSuccessful() else SKIPPED if result.skipped else 0)


class SmallCluster:
    """Two nodes, until the test ends."""

    def __init__(self, test, folder):
        need("slurmctld", "slurmd", "munged", "sbatch")
        self.test = test
        subprocess.run([SCRIPTS / "start_slurm.sh", "start", folder], check=True, capture_output=True, timeout=SECONDS)
        test.addCleanup(lambda: subprocess.run([SCRIPTS / "start_slurm.sh", "stop", folder], check=True, timeout=SECONDS))
        self.environment = {**os.environ, "SLURM_CONF": str(folder / "slurm.conf")}

    def run(self, *command):
        return subprocess.run(command, env=self.environment, check=True, capture_output=True, text=True, timeout=SECONDS).stdout

    def wait_for_all(self):
        deadline = time.monotonic() + SECONDS
        while self.run("squeue", "--noheader"):
            self.test.assertLess(time.monotonic(), deadline, self.run("squeue"))
            time.sleep(0.2)

    def wait_for_running(self):
        deadline = time.monotonic() + SECONDS
        while not self.run("squeue", "--noheader", "--states=running"):
            self.test.assertLess(time.monotonic(), deadline)
            time.sleep(0.05)

    def lose_a_node_and_a_task(self):
        """While tasks run: a node is drained, a task requeued, another one killed."""
        self.wait_for_running()
        running = self.run("squeue", "--noheader", "--array", "--states=running", "--format=%i %N").split("\n")[0].split()
        self.run("scontrol", "update", "nodename=node2", "state=drain", "reason=test")
        self.run("scontrol", "requeue", running[0])
        self.wait_for_running()
        running = self.run("squeue", "--noheader", "--array", "--states=running", "--format=%i").split()
        if running:
            subprocess.run(["scancel", "--signal=KILL", "--full", running[0]], env=self.environment, check=False)
        self.run("scontrol", "update", "nodename=node2", "state=resume")
