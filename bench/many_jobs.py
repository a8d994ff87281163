#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Measures meshrepair --jobs-from where very many small meshes are repaired, and some jobs are killed.

Usage: many_jobs.py MESHREPAIR MESH FOLDER [--files N] [--jobs N] [--kills N] [-- OPTIONS OF meshrepair]

Repairs MESH N times (100000 unless told) to FOLDER, to one of 1000 names, and kills jobs (100) at random moments by SIGKILL.
Prints files per second; processor time of all for each file; memory of the worker, resident and private, after the first 1000
jobs and at the end; how many jobs were killed, and how many answers say so. Exit code 1: a job got no answer, or others than
the killed ones failed.
"""

import argparse
import json
import os
import random
import resource
import signal
import subprocess
import sys
import threading
import time

NAMES = 1000
ABOUT_THE_START = 1000  # jobs


def memory_of(pid):
    """Resident and private, in MB."""
    with open(f"/proc/{pid}/status", encoding="ascii") as file:
        found = {line.split(":")[0]: int(line.split()[1]) / 1024 for line in file if line.startswith(("VmRSS", "RssAnon"))}
    return found and f"{found['VmRSS']:.1f} MB, {found['RssAnon']:.1f} MB private"


def kill_some(worker, count, seconds_between, codes):
    """Until so many answers say so: some have ended already, and are only not waited for yet."""
    while list(codes.values()).count(128 + signal.SIGKILL) < count and worker.poll() is None:
        time.sleep(random.uniform(0, 2 * seconds_between))
        try:
            with open(f"/proc/{worker.pid}/task/{worker.pid}/children", encoding="ascii") as file:
                os.kill(int(random.choice(file.read().split())), signal.SIGKILL)
        except (OSError, IndexError):
            pass


def feed(worker, options):
    mesh = os.path.abspath(options.mesh)
    with worker.stdin:
        for number in range(options.files):
            line = {"id": number, "in": mesh, "out": os.path.join(options.folder, f"{number % NAMES}.stl")}
            worker.stdin.write(json.dumps(line).encode() + b"\n")


def measure(worker, options):
    threading.Thread(target=feed, args=(worker, options)).start()
    codes, start, end, last = {}, "", "", 0.0
    between = options.files / 1000 / max(options.kills, 1) / 2
    killing = threading.Thread(target=kill_some, args=(worker, options.kills, between, codes))
    killing.start()
    for count, line in enumerate(worker.stdout, 1):
        answer = json.loads(line)
        codes[answer["id"]] = answer["exit_code"]
        if count == ABOUT_THE_START:
            start = memory_of(worker.pid)
        if count > ABOUT_THE_START and (count == options.files or time.monotonic() > last + 1):
            last = time.monotonic()
            end = memory_of(worker.pid) or end
    killing.join()
    return codes, start, end


def main():
    parser = argparse.ArgumentParser(usage=__doc__.split("Usage: ")[1].split("\n")[0], description=__doc__.split("\n", maxsplit=1)[0])
    for name in ("meshrepair", "mesh", "folder"):
        parser.add_argument(name)
    parser.add_argument("--files", type=int, default=100000)
    parser.add_argument("--jobs", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--kills", type=int, default=100)
    arguments = sys.argv[1:]
    end = arguments.index("--") if "--" in arguments else len(arguments)
    options = parser.parse_args(arguments[:end])
    os.makedirs(options.folder, exist_ok=True)
    print(f"{options.files:,} files, {options.jobs} at a time; load of the machine before: {os.getloadavg()[0]:.1f}", flush=True)
    started = time.monotonic()
    with subprocess.Popen([options.meshrepair, "--jobs-from", "-", "--jobs", str(options.jobs), "--quiet", *arguments[end + 1:]],
                          stdin=subprocess.PIPE, stdout=subprocess.PIPE) as worker:
        codes, before, after = measure(worker, options)
    seconds = time.monotonic() - started
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    failed = [code for code in codes.values() if code != 0]
    killed = failed.count(128 + signal.SIGKILL)
    print(f"{options.files / seconds:,.0f} files/s; {1e3 * (used.ru_utime + used.ru_stime) / options.files:.2f} ms of processor time a file")
    print(f"memory of the worker after {ABOUT_THE_START:,} jobs: {before}; at the end: {after}")
    print(f"{len(codes):,} answers: {len(failed)} failed, {killed} of them killed; exit code of the worker: {worker.returncode}")
    return 0 if len(codes) == options.files and len(failed) == killed >= options.kills and worker.returncode == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
