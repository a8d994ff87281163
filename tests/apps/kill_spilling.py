#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Kills meshrepair at random moments while its arrays lie in a file, and fills the disk under it.

Usage: kill_spilling.py MESHREPAIR MESH LIMIT [KILLS [FULL_DISKS [SEED]]]   (default: 200 kills, 50 full disks, seed 1)

MESH takes more memory than LIMIT, such as 64M. For full disks a small tmpfs is mounted again and again, so that
needs root: either the file of arrays does not fit there, or the output. Complains, and ends with exit code 1, if

- the output is ever there in part, or is another one than with all memory,
- anything is left in the folder of the file, or
- a full disk ends in anything but the whole output, or one line and an exit code that says so (4 or 6).
"""

import collections
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

DONE, LIMIT_REACHED, NOT_WRITTEN = 0, 4, 6
ARRAYS_FOR_OUTPUT = 30  # bytes of arrays for each byte of the output
MOST_SHARE = 1.1  # of the undisturbed time: when the latest kill comes


class Trial:
    def __init__(self, program, mesh, limit, folder):
        self.program, self.mesh, self.limit, self.folder = program, mesh, limit, folder
        self.out, self.temp = folder / "out.ply", folder / "temp"
        self.temp.mkdir()
        subprocess.run([program, "-q", mesh, folder / "whole.ply", "--max-memory", "0"], check=True)
        self.whole = (folder / "whole.ply").read_bytes()
        start = time.monotonic()
        self.end(self.start(), "the first run")
        self.seconds = time.monotonic() - start

    def start(self, temp=None, out=None):
        command = [self.program, "-q", self.mesh, out or self.out, "--max-memory", self.limit, "--temp", temp or self.temp]
        return subprocess.Popen(command, stderr=subprocess.PIPE, text=True)

    def end(self, run, what, out=None, temp=None, codes=(DONE,)):
        """What the run has left is all right; returns its exit code."""
        out, temp = out or self.out, temp or self.temp
        said = run.communicate()[1]
        left = [path.name for path in temp.iterdir() if path != out]
        if run.returncode not in codes:
            sys.exit(f"{what}: exit code {run.returncode}: {said}")
        if left:
            sys.exit(f"{what}: {left} is left")
        if out.exists() != (run.returncode == DONE) and run.returncode != -signal.SIGKILL:
            sys.exit(f"{what}: exit code {run.returncode}, output there: {out.exists()}")
        if out.exists() and out.read_bytes() != self.whole:
            sys.exit(f"{what}: another output")
        if run.returncode in (LIMIT_REACHED, NOT_WRITTEN) and said.count("\n") != 1:
            sys.exit(f"{what}: not one line: {said}")
        out.unlink(missing_ok=True)
        return run.returncode

    def kill(self, seconds):
        run = self.start()
        time.sleep(seconds)
        run.kill()
        return self.end(run, f"killed after {seconds:.3f} s", codes=(DONE, -signal.SIGKILL))

    def fill(self, megabytes, is_for_output):
        """Both on the small disk, or the file of arrays alone."""
        disk = self.folder / "disk"
        disk.mkdir(exist_ok=True)
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={megabytes}M", "tmpfs", disk], check=True)
        try:
            out = disk / "out.ply" if is_for_output else self.out
            temp = self.temp if is_for_output else disk
            run = self.start(temp, out)
            return self.end(run, f"a disk of {megabytes} MB", out, disk, codes=(DONE, LIMIT_REACHED, NOT_WRITTEN))
        finally:
            subprocess.run(["umount", disk], check=True)


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    program, mesh = (pathlib.Path(name).resolve() for name in sys.argv[1:3])
    kills, full_disks, seed = (int(sys.argv[i]) if i < len(sys.argv) else default
                               for i, default in ((4, 200), (5, 50), (6, 1)))
    chance = random.Random(seed)
    with tempfile.TemporaryDirectory(prefix="kill_spilling_", dir="/var/tmp") as name:
        trial = Trial(program, mesh, sys.argv[3], pathlib.Path(name))
        codes = collections.Counter(trial.kill(chance.uniform(0, MOST_SHARE * trial.seconds)) for _ in range(kills))
        trial.end(trial.start(), "the run after all kills")
        print(f"{kills} kills in runs of {trial.seconds:.1f} s: {dict(codes)}; nothing half written, nothing left", flush=True)
        size = len(trial.whole) >> 20
        codes = collections.Counter()
        for _ in range(full_disks):
            is_for_output = chance.random() < 0.3
            most = 2 * size if is_for_output else ARRAYS_FOR_OUTPUT * size  # from too little to enough
            codes[trial.fill(chance.randint(1, most), is_for_output)] += 1
        print(f"{full_disks} small disks: {dict(codes)}; nothing half written, nothing left")


if __name__ == "__main__":
    main()
