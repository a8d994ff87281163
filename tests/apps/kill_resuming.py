#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Kills meshrepair --resume at random moments, again and again, until it ends by itself.

Usage: kill_resuming.py MESHREPAIR MESH LIMIT [KILLS [SEED]]   (default: 200 kills, seed 1)

MESH takes more memory than LIMIT, such as 64M. Complains, and ends with exit code 1, if the output is ever there in
part, or is another one than that of an undisturbed run, or anything is left at the end. Prints how often runs went on
from what.
"""

import collections
import json
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time


class Trial:
    def __init__(self, program, mesh, limit, folder):
        self.out, self.report = folder / "out.ply", folder / "report.json"
        self.temp, self.states = folder / "temp", folder / "states"
        self.temp.mkdir()
        self.command = [program, "-q", mesh, self.out, "--max-memory", limit, "--temp", self.temp,
                        "--resume", self.states, "--report", self.report]
        self.kills, self.ends, self.went_on_from = 0, 0, collections.Counter()
        subprocess.run([program, "-q", mesh, folder / "whole.ply", "--max-memory", "0"], check=True)
        self.whole = (folder / "whole.ply").read_bytes()
        start = time.monotonic()
        subprocess.run(self.command, check=True)
        self.seconds = time.monotonic() - start
        self.look_at_end()

    def look_at_end(self):
        """All is there, and nothing else."""
        if self.out.read_bytes() != self.whole:
            sys.exit(f"after {self.kills} kills the output is another one")
        if self.states.exists() or list(self.temp.iterdir()):
            sys.exit(f"after {self.kills} kills something is left")
        resumed = json.loads(self.report.read_text()).get("resumed", {"from": []})
        self.went_on_from.update(name.partition("-")[0] for name in resumed["from"])
        self.ends += 1
        self.out.unlink()
        self.report.unlink()

    def run_once(self, rng):
        """One run, killed at a random moment if it lives that long."""
        run = subprocess.Popen(self.command, stderr=subprocess.PIPE, text=True)
        try:
            said = run.communicate(timeout=rng.uniform(0, self.seconds))[1]
        except subprocess.TimeoutExpired:
            run.send_signal(signal.SIGKILL)
            said = run.communicate()[1]
        if run.returncode == 0:
            return self.look_at_end()
        if run.returncode != -signal.SIGKILL:
            sys.exit(f"exit code {run.returncode}: {said}")
        self.kills += 1
        if self.out.exists() and self.out.read_bytes() != self.whole:
            sys.exit(f"kill {self.kills}: the output is there in part")
        self.out.unlink(missing_ok=True)


def main():
    program, mesh, limit = sys.argv[1:4]
    kills, seed = (int(text) for text in sys.argv[4:6] + ["200", "1"][len(sys.argv[4:6]):])
    rng = random.Random(seed)
    with tempfile.TemporaryDirectory(prefix="kill_resuming_", dir="/var/tmp") as name:
        trial = Trial(pathlib.Path(program).resolve(), pathlib.Path(mesh).resolve(), limit, pathlib.Path(name))
        while trial.kills < kills:
            trial.run_once(rng)
    print(f"{trial.kills} kills, {trial.ends} whole ends, gone on from {dict(trial.went_on_from)}")


if __name__ == "__main__":
    main()
