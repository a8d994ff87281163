#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures what repair_folder.py costs beside the repairs, where a folder holds very many small meshes.

Usage: many_files.py MESHREPAIR FOLDER [--files N] [--jobs N] [--script PATH] [--archive NAME] [-- OPTIONS OF repair_folder.py]

Makes N meshes (100000 unless told) in FOLDER/in: cubes of binary STL, of different sizes; every hundredth is broken, by a hole,
and every thousandth is cut, and fails. Those that are there stay. Repairs them to FOLDER/out, which is removed first, in three runs:

- one that is interrupted when half of the files are done,
- one that does the other half, and
- one that finds nothing to do.

Prints of each: wall time; the time of the workers, as the summary has it, from the start of each to its end; overhead, which is
the wall time of all workers' places less the time of the workers; processor time of the script alone; its peak memory; the
most files that it had open. Then what a process costs that is started by nothing but a loop, and the files in OUT_DIR.
--archive scans.zip packs the folder first, and repairs the archive: .zip, .tar or .tar.gz.
"""

import argparse
import csv
import json
import os
import shutil
import signal
import struct
import subprocess
import sys
import threading
import time

sys.dont_write_bytecode = True

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../scripts/repair_folder.py")
HOLE_EACH, CUT_EACH = 100, 1000
LOOK_SECONDS = 0.1
BARE_RUNS = 500
QUADS = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))


def cube(number):
    """Bytes of a binary STL."""
    sides = [1.0 + number % 7, 1.0 + number % 11, 1.0 + number % 13]
    points = [[float(i >> axis & 1) * sides[axis] for axis in range(3)] for i in range(8)]
    triangles = [[points[i] for i in corners] for a, b, c, d in QUADS for corners in ((a, b, c), (a, c, d))]
    if number % HOLE_EACH == 1:
        triangles.pop()
    data = b"".join(struct.pack("<12fH", 0, 0, 0, *sum(triangle, []), 0) for triangle in triangles)
    whole = bytes(80) + struct.pack("<I", len(triangles)) + data
    return whole[:60] if number % CUT_EACH == 2 else whole


def make_meshes(folder, count):
    os.makedirs(folder, exist_ok=True)
    there = set(os.listdir(folder))
    for number in range(count):
        name = f"mesh{number:06}.stl"
        if name not in there:
            with open(os.path.join(folder, name), "wb") as file:
                file.write(cube(number))


def pack(folder, archive):
    """With programs, as users do; those that are there stay."""
    if not os.path.exists(archive):
        command = ["zip", "-qr", archive, "."] if archive.endswith(".zip") else ["tar", "-caf", archive, "."]
        subprocess.run(command, cwd=folder, check=True)


class Look:
    """What /proc has of a process, looked at now and then until it ends."""

    def __init__(self, process):
        self.process = process
        self.peak = self.open_files = self.staged = 0
        self.own_seconds = 0.0
        self.thread = threading.Thread(target=self.look_on)
        self.thread.start()

    def look_on(self):
        while self.process.returncode is None:
            try:
                self.look(f"/proc/{self.process.pid}")
            except (OSError, StopIteration, IndexError):  # it is ending
                pass
            time.sleep(LOOK_SECONDS)

    def look(self, place):
        with open(f"{place}/status", encoding="ascii", errors="replace") as file:
            self.peak = max(self.peak, next(int(line.split()[1]) << 10 for line in file if line.startswith("VmHWM")))
        with open(f"{place}/stat", encoding="ascii", errors="replace") as file:
            fields = file.read().rsplit(")", 1)[1].split()
        self.own_seconds = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
        self.open_files = max(self.open_files, len(os.listdir(f"{place}/fd")))


class Runs:
    def __init__(self, options):
        self.options = options
        self.source = os.path.join(options.folder, "in")
        self.out = os.path.join(options.folder, "out")
        self.journal = os.path.join(self.out, ".repair_folder/journal.jsonl")

    def lines_in_journal(self):
        try:
            with open(self.journal, "rb") as file:
                return sum(chunk.count(b"\n") for chunk in iter(lambda: file.read(1 << 20), b""))
        except FileNotFoundError:
            return 0

    def run(self, name, interrupt_at=None):
        options = self.options
        command = [sys.executable, options.script, "--quiet", "--jobs", str(options.jobs), "--meshrepair", options.meshrepair,
                   *options.passed, self.source, self.out]
        before = self.lines_in_journal()
        started = time.monotonic()
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            look = Look(process)
            while interrupt_at and process.poll() is None and self.lines_in_journal() < interrupt_at:
                time.sleep(1)
            if interrupt_at:
                process.send_signal(signal.SIGINT)
            code = process.wait()
        wall = time.monotonic() - started
        look.thread.join()
        self.tell(name, code, wall, look, before)

    def tell(self, name, code, wall, look, before):
        done = self.lines_in_journal() - before
        workers = self.worker_seconds(done)
        row = {"run": name, "exit code": code, "files done": f"{done:,}", "wall s": f"{wall:.1f}", "workers s": f"{workers:.1f}",
               "overhead ms a file": f"{1e3 * (wall * self.options.jobs - workers) / done:.2f}" if done else "-",
               "own CPU s": f"{look.own_seconds:.1f}",
               "own CPU ms a file": f"{1e3 * look.own_seconds / done:.2f}" if done else "-",
               "peak MB": f"{look.peak / 1e6:.0f}", "open files": look.open_files}
        print("; ".join(f"{key}: {value}" for key, value in row.items()), flush=True)

    def worker_seconds(self, done):
        """Of the last lines of the journal."""
        if not done:
            return 0.0
        with open(self.journal, "rb") as file:
            return sum(json.loads(line)["row"]["seconds"] or 0 for line in file.readlines()[-done:])

    def tell_sizes(self):
        files = sum(len(names) + len(folders) for _, folders, names in os.walk(self.out))
        state = sum(len(names) + len(folders) for _, folders, names in os.walk(os.path.dirname(self.journal)))
        size = os.path.getsize(self.journal)
        with open(os.path.join(self.out, "summary.csv"), encoding="utf-8", newline="") as file:
            codes = [row["exit_code"] for row in csv.DictReader(file)]
        counts = ", ".join(f"{codes.count(code):,} with exit code {code}" for code in sorted(set(codes)))
        print(f"{files:,} files and folders in OUT_DIR, {state} of them of the state; journal {size / 1e6:.0f} MB; {counts}")


def tell_bare_loop(options, source):
    """One process after the other, with the arguments of a worker."""
    name = os.path.join(source, "mesh000003.stl")
    work = os.path.join(options.folder, "bare")
    os.makedirs(work, exist_ok=True)
    command = [options.meshrepair, "--quiet", "--threads", "1", "--format", "stl", "--report", work + "/report.json", "--staging", work,
               name, os.path.join(work, "out.stl")]
    started = time.monotonic()
    for _ in range(BARE_RUNS):
        pid = os.posix_spawn(options.meshrepair, command, os.environ)
        os.waitpid(pid, 0)
    print(f"a bare loop, one process at a time: {1e3 * (time.monotonic() - started) / BARE_RUNS:.2f} ms a file")
    shutil.rmtree(work)


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("Usage: ")[1].split("\n")[0], description=__doc__.split("\n", maxsplit=1)[0])
    add = parser.add_argument
    add("meshrepair")
    add("folder")
    add("--files", type=int, default=100000)
    add("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    add("--script", default=SCRIPT)
    add("--archive")
    arguments = sys.argv[1:]
    end = arguments.index("--") if "--" in arguments else len(arguments)
    options = parser.parse_args(arguments[:end])
    options.passed = arguments[end + 1:]
    options.meshrepair = os.path.abspath(options.meshrepair)
    runs = Runs(options)
    make_meshes(runs.source, options.files)
    meshes = runs.source
    if options.archive:
        runs.source = os.path.abspath(os.path.join(options.folder, options.archive))
        pack(meshes, runs.source)
    shutil.rmtree(runs.out, ignore_errors=True)
    print(f"{options.files:,} files, {options.jobs} at a time; load of the machine before: {os.getloadavg()[0]:.1f}")
    tell_bare_loop(options, meshes)
    runs.run("interrupted", options.files // 2)
    runs.run("resumed")
    runs.run("nothing to do")
    runs.tell_sizes()


if __name__ == "__main__":
    main()
