# SPDX-License-Identifier: MIT
"""Runs meshrepair on cases, and compares what it gives with what was meant."""

import json
import subprocess
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np

from .meshes import read_off, write_off


class Outcome:
    """What one run gave. `mesh` is nothing where none was written."""

    def __init__(self, code, report, mesh, data, seconds, said=""):
        self.code = code
        self.report = report
        self.mesh = mesh
        self.data = data  # the bytes of the file
        self.seconds = seconds
        self.said = said  # on standard error

    def certified(self):
        return self.code == 0

    def volume(self):
        return self.report.get("result", {}).get("volume") if self.mesh is not None else None

    def off_by(self, meant):
        """The volume beside what was meant, as a share of that."""
        volume = self.volume()
        return None if volume is None or not meant else (volume - meant) / meant

    def error(self):
        return self.report.get("error") or ""

    def seal(self):
        return self.report.get("seal", {})


class Runner:
    def __init__(self, programs, timeout=120, jobs=2):
        self.program = Path(programs) / "meshrepair"
        self.timeout = timeout
        self.jobs = jobs

    def repair(self, broken, options=(), threads=1):
        """Of a mesh; written as OFF, which keeps all numbers."""
        with tempfile.TemporaryDirectory(prefix="meant-") as name:
            folder = Path(name)
            write_off(broken, folder / "in.off")
            return self.run(folder / "in.off", folder, options, threads)

    def run(self, path, folder, options, threads):
        out, report = folder / "out.off", folder / "report.json"
        command = [self.program, path, out, "--report", report, "--threads", str(threads), "--time-limit",
                   str(self.timeout), "-q", *options]
        start = time.monotonic()
        done = subprocess.run([str(word) for word in command], capture_output=True, check=False)
        seconds = time.monotonic() - start
        found = json.loads(report.read_text()) if report.exists() else {"error": done.stderr.decode()}
        if not out.exists():
            return Outcome(done.returncode, found, None, b"", seconds)
        return Outcome(done.returncode, found, read_off(out), out.read_bytes(), seconds)

    def told(self, words, inputs):
        """What a command line says, of a program and its arguments: IN, A and B are inputs, OUT.format is the output."""
        with tempfile.TemporaryDirectory(prefix="meant-") as name:
            places = dict(zip(("IN",) if len(inputs) == 1 else ("A", "B"), inputs))
            line = [self.program.with_name(words[0]), "--report", Path(name) / "report.json"]
            line += [Path(name) / word if word.startswith("OUT.") else places.get(word, word) for word in words[1:]]
            done = subprocess.run([str(word) for word in line], capture_output=True, check=False, text=True)
            report = Path(name) / "report.json"
            found = json.loads(report.read_text()) if report.exists() else {}
            outs = [Path(name) / word for word in words if word.startswith("OUT.")]
            data = outs[0].read_bytes() if outs and outs[0].exists() else b""
            return Outcome(done.returncode, found, None, data, 0, done.stderr)

    def beside(self, case, tool):
        """What a tool makes of a case: whether it is valid, how far it is off, triangles, seconds. Nothing if it is not built."""
        _, method, share = tool
        others = self.program.with_name("wrap_others")
        if method and not others.exists():
            return None
        with tempfile.TemporaryDirectory(prefix="meant-") as name:
            folder = Path(name)
            write_off(case.broken, folder / "in.off")
            write_off(case.solid, folder / "true.off")
            if method:
                done = subprocess.run([others, method, folder / "in.off", folder / "out.off", repr(share)], capture_output=True,
                                      check=False, text=True)
                seconds = float(done.stdout) if done.returncode == 0 else None
            else:
                outcome = self.run(folder / "in.off", folder, case.truth["options"], 1)
                seconds = outcome.seconds
            if not (folder / "out.off").exists():
                return ["no result", "-", "-", "-", "-"]
            check = self.report_of("meshcheck", folder / "out.off")["check"]
            distance = self.report_of("meshdist", folder / "true.off", folder / "out.off")["distance"]
            far = max(distance[way]["relative"]["hausdorff"] for way in ("a_to_b", "b_to_a"))
            off = None if check["volume"] is None else check["volume"] / case.truth["volume"] - 1
            return ["yes" if check["valid_solid"] else "NO", percent(off), percent(far), check["triangles"], f"{seconds:.2f}"]

    def report_of(self, program, *files):
        done = subprocess.run([self.program.with_name(program), *files, "--json"], capture_output=True, check=False)
        return json.loads(done.stdout)

    def map(self, function, items):
        """In the order of the items, so many at a time."""
        with ThreadPoolExecutor(self.jobs) as pool:
            return list(pool.map(function, items))


def missing_triangles(mesh, wanted):
    """How many of these triangles are not in the mesh with the same coordinates, bit for bit."""
    def keys(corners):
        rows = [min(tuple(map(tuple, np.roll(t, k, axis=0).tolist())) for k in range(3)) for t in corners]
        return set(rows)
    return len(keys(wanted.corners()) - keys(mesh.corners()))


def print_table(head, rows):
    print("| " + " | ".join(head) + " |")
    print("|" + "|".join("---" for _ in head) + "|")
    for row in rows:
        print("| " + " | ".join(str(cell) for cell in row) + " |")
    print(flush=True)


def percent(share):
    return "-" if share is None else f"{100 * share:.2f} %"


def keep(case, folder, name):
    """A case that failed, for whoever looks at it."""
    if folder is None:
        return
    folder.mkdir(parents=True, exist_ok=True)
    case.write(folder, name)
