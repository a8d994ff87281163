#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Kills repair_folder.py and its workers at random moments, and shows that nothing is lost or half done.

Usage: kill_folder.py MESHREPAIR IN_DIR [KILLS [SEED]]   (default: 200 kills, seed 1)

First IN_DIR is repaired undisturbed. Then it is repaired again under SIGKILL: of the script alone, of
its whole process group, or of one worker. A killed run is resumed; a finished one is compared and begun
anew in another folder, until there were enough kills. Complains, and ends with exit code 1, if

- at any moment an output is there that is not byte for byte that of the undisturbed run,
- a worker outlives the script, or
- a run that was resumed to its end has another summary, but for times and memory, or other files.
"""

import collections
import csv
import json
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "repair_folder.py"
MEASURED = ("seconds", "peak_memory_bytes")
STATE = ".repair_folder"
MARK = "REPAIR_FOLDER_UNDER_TEST"  # in the environment of all that is started here
CPU_SECONDS_TO_DIE = 0.3  # what is killed works no more; when it is gone is up to how busy the machine is
SECONDS_TO_FINISH = 600
MOST_SHARE = 0.7  # of the undisturbed time: when the latest kill comes


def outputs_in(folder):
    """Name -> bytes of every mesh in OUT_DIR."""
    found = {}
    for current, folders, names in os.walk(os.fsencode(folder)):
        folders[:] = [name for name in folders if name != os.fsencode(STATE)]
        for name in set(names) - {b"summary.csv", b"summary.json"}:
            path = os.path.join(current, name)
            with open(path, "rb") as file:
                found[os.path.relpath(path, os.fsencode(folder))] = file.read()
    return found


def comparable_summary(folder):
    """Both summaries without what was measured."""
    with open(folder / "summary.csv", encoding="utf-8", newline="") as file:
        rows = [{key: value for key, value in row.items() if key not in MEASURED}
                for row in csv.DictReader(file)]
    summary = json.loads((folder / "summary.json").read_bytes())
    for part in (summary, *summary["files"]):
        del part["measured"]
    return rows, summary


def marked_processes(mark):
    """Those that live; a zombie holds nothing any more."""
    found = []
    for entry in pathlib.Path("/proc").iterdir():
        try:
            if entry.name.isdigit() and mark in (entry / "environ").read_bytes():
                found.append(int(entry.name))
        except OSError:
            pass
    return found


def cpu_seconds(pid):
    """What a process has worked so far; 0 if it is gone."""
    try:
        stat = pathlib.Path(f"/proc/{pid}/stat").read_text(encoding="ascii", errors="replace")
    except OSError:
        return 0
    return int(stat.rsplit(")", 1)[1].split()[11]) / os.sysconf("SC_CLK_TCK")


class Killer:
    """Runs of the script over one folder, and what was found wrong with them."""

    def __init__(self, meshrepair, in_dir, work, seed):
        self.command = [sys.executable, SCRIPT, "--quiet", "--meshrepair", meshrepair, in_dir]
        self.work = pathlib.Path(work)
        self.chance = random.Random(seed)
        self.mark = f"{MARK}={os.getpid()}-{seed}"
        self.environment = {**os.environ, MARK: self.mark.partition("=")[2]}
        self.counts = collections.Counter()
        self.complaints = []
        started = time.monotonic()
        self.finish(self.work / "undisturbed")
        self.duration = time.monotonic() - started
        self.outputs = outputs_in(self.work / "undisturbed")
        self.summary = comparable_summary(self.work / "undisturbed")

    def start(self, out):
        return subprocess.Popen([*self.command, out], env=self.environment, start_new_session=True,
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def finish(self, out):
        code = self.start(out).wait(SECONDS_TO_FINISH)
        if code not in (0, 1):
            self.complaints.append(f"a run ended with exit code {code}")

    def check_outputs(self, out):
        self.counts["looks at the folder"] += 1
        for name, data in outputs_in(out).items():
            self.counts["outputs compared"] += 1
            if data != self.outputs.get(name):
                self.complaints.append(f"{name}: {len(data)} bytes, not those of the undisturbed run")

    def kill_once(self, out):
        """One run with a kill in it. True if it was resumed to its end."""
        way = self.chance.choice(("script", "group", "worker"))
        process = self.start(out)
        moment = time.monotonic() + self.chance.uniform(0, MOST_SHARE * self.duration)
        while time.monotonic() < moment and process.poll() is None:
            self.check_outputs(out)
            time.sleep(0.01)
        if process.poll() is not None:
            return True
        if way == "worker":
            self.kill_worker(process)
            process.wait(SECONDS_TO_FINISH)
            return True
        (os.kill if way == "script" else os.killpg)(process.pid, signal.SIGKILL)
        process.wait()
        self.counts[f"kills of the {way}"] += 1
        self.wait_for_workers()
        self.check_outputs(out)
        return False

    def kill_worker(self, process):
        """One of them, if there is one at this moment or soon."""
        for _ in range(100):
            workers = [pid for pid in marked_processes(self.mark.encode()) if pid != process.pid]
            if workers and process.poll() is None:
                try:
                    os.kill(self.chance.choice(workers), signal.SIGKILL)
                except ProcessLookupError:
                    continue
                self.counts["kills of the worker"] += 1
                return

    def wait_for_workers(self):
        deadline = time.monotonic() + SECONDS_TO_FINISH
        at_first = {}
        while alive := marked_processes(self.mark.encode()):
            for pid in alive:
                worked = cpu_seconds(pid)
                if worked > at_first.setdefault(pid, worked) + CPU_SECONDS_TO_DIE or time.monotonic() > deadline:
                    self.complaints.append("workers outlive the script")
                    return
            time.sleep(0.01)

    def kills(self):
        return sum(count for name, count in self.counts.items() if name.startswith("kills"))

    def run(self, kills):
        """Until there were so many; at the end of each folder it is compared with the undisturbed one."""
        while self.kills() < kills and not self.complaints:
            out = self.work / f"killed{self.counts['folders']}"
            self.counts["folders"] += 1
            while self.kills() < kills and not self.kill_once(out):
                pass
            self.finish(out)
            self.compare(out)

    def compare(self, out):
        if comparable_summary(out) != self.summary:
            self.complaints.append(f"the summary in {out.name} is not that of the undisturbed run")
        if outputs_in(out) != self.outputs:
            self.complaints.append(f"the outputs in {out.name} are not those of the undisturbed run")
        left = list((out / STATE / "work").iterdir())
        if left:
            self.complaints.append(f"left behind: {left}")


def main():
    if not 3 <= len(sys.argv) <= 5:
        print(__doc__.strip(), file=sys.stdout if sys.argv[1:] == ["--help"] else sys.stderr)
        return 0 if sys.argv[1:] == ["--help"] else 2
    kills, seed = (int(argument) for argument in (sys.argv[3:] + ["200", "1"][len(sys.argv) - 3:]))
    with tempfile.TemporaryDirectory(prefix="kill_folder_") as work:
        killer = Killer(sys.argv[1], sys.argv[2], work, seed)
        killer.run(kills)
        for name, count in sorted(killer.counts.items()):
            print(f"{count:>9,}  {name}")
        print(f"{len(killer.outputs):>9,}  outputs of an undisturbed run, in {killer.duration:.1f} s")
        for complaint in killer.complaints:
            print(f"complaint: {complaint}")
        print("nothing lost, nothing half done" if not killer.complaints else "FAILED")
    return 1 if killer.complaints else 0


if __name__ == "__main__":
    sys.exit(main())
