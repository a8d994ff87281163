# SPDX-License-Identifier: MIT
"""Runs tools on a model, and measures what they write: one row for each tool."""

import json
import os
import re
import shlex
import shutil
import signal

from .basics import USAGE, Stop
from .judge import UNJUDGED, Judge
from .measure import captured, run

COLUMNS = ("model", "tool", "status", "exit_code", "closed", "nonmanifold_edges", "seconds", "memory_mb", "triangle_ratio", "hausdorff",
           "solid", "open_edges", "self_intersections", "degenerate_triangles", "parts", "triangles_in", "triangles_out", "cpu_seconds",
           "judge", "error")
TEXTS = ("model", "tool", "status", "closed", "solid", "judge", "error")  # the other columns have numbers
INPUT = "input"  # the tool that does nothing
RESULT, LATE, FULL, CRASHED, NOTHING = "result", "out of time", "out of memory", "crashed", "no result"
PLACE = re.compile(r"\{(in|out)(\.\w+)?\}")
WANT_OF_MEMORY = re.compile(r"bad_alloc|MemoryError|(out of|allocate) memory", re.IGNORECASE)
LEAST_SECONDS = 300  # for a measurement, which does not count


class Tool:
    """NAME=COMMAND, with {in} and {out}; {in.stl} and {out.stl} are of this format. {out} is OFF."""

    def __init__(self, text):
        self.name, _, line = text.partition("=")
        try:
            self.words = shlex.split(line)
        except ValueError as error:
            raise Stop(USAGE, f"--tool {text}: {error}") from None
        endings = {ending or ".off" for side, ending in PLACE.findall(line) if side == "out"}
        if not re.fullmatch(r"[\w.+ -]+", self.name) or len(endings) != 1 or not self.input_endings():
            raise Stop(USAGE, f"--tool {text}: is not NAME=COMMAND with {{in}} and {{out}}")
        if not shutil.which(self.words[0]):
            raise Stop(USAGE, f"--tool {text}: {self.words[0]} is no program")
        self.ending = endings.pop()

    def input_endings(self):
        return {ending for word in self.words for side, ending in PLACE.findall(word) if side == "in"}

    def command(self, inputs, out):
        """`inputs`: files by ending."""
        return [PLACE.sub(lambda place: out if place[1] == "out" else inputs[place[2] or ""], word) for word in self.words]


def status_of(done, out):
    if done.code is None:
        return LATE
    is_crash = done.code < 0 or done.code > 128  # the latter is what a shell says of another program
    if not is_crash and os.path.isfile(out) and os.path.getsize(out):
        return RESULT
    if WANT_OF_MEMORY.search(done.error):
        return FULL
    if not is_crash:
        return NOTHING
    number = -done.code if done.code < 0 else done.code - 128
    return f"{CRASHED}: {signal.Signals(number).name}" if number in set(signal.Signals) else CRASHED


class Measurer:
    """Rows of models. `programs`: the folder of meshcheck, meshconvert and meshdist."""

    def __init__(self, programs, judge, timeout, memory):
        def program(name):
            return os.path.join(programs, name)
        self.meshconvert, self.meshdist = program("meshconvert"), program("meshdist")
        self.timeout, self.memory, self.patience = timeout, memory, max(timeout, LEAST_SECONDS)
        self.input_judge = Judge(None, program("meshcheck"), self.patience)
        self.judge = Judge(judge, program("meshcheck"), self.patience)

    def judged(self, judge, path, row):
        said = judge.said(path)
        if said is None:  # it has crashed, or has not come to an end
            row["judge"] = UNJUDGED
            return
        found = judge.counts(said)
        row.update(found, judge=os.path.basename(judge.name()))
        if found["triangles_out"] is None:
            row["status"] = f"{NOTHING}: unreadable"
        else:
            row.update(closed="yes" if found["open_edges"] == 0 else "no", solid="yes" if judge.accepted(said) else "no")

    def input_row(self, source):
        """By meshcheck, which reads all that meshrepair does."""
        row = {"tool": INPUT, "status": RESULT}
        self.judged(self.input_judge, source, row)
        row["triangles_in"] = row.get("triangles_out")
        return row

    def tool_row(self, tool, source, triangles_in, work):
        row = {"tool": tool.name, "triangles_in": triangles_in}
        out = os.path.join(work, "out" + tool.ending)
        inputs = {ending: self.converted(source, ending, work) for ending in tool.input_endings()}
        if None in inputs.values():
            return {**row, "status": NOTHING, "error": "the input cannot be converted for it"}
        done = run(tool.command(inputs, out), work, self.timeout, memory=self.memory)
        row.update(status=status_of(done, out), exit_code=done.code, seconds=round(done.wall, 3), cpu_seconds=round(done.cpu, 3),
                   memory_mb=round(done.peak, 1), error="" if done.code == 0 else done.error)
        if row["status"] == RESULT:
            self.judged(self.judge, out, row)
            row["hausdorff"] = self.distance(source, out)
            if triangles_in and row.get("triangles_out") is not None:
                row["triangle_ratio"] = round(row["triangles_out"] / triangles_in, 4)
        return row

    def converted(self, source, ending, work):
        """The file itself if it has this ending; None if it cannot be converted. Once for all tools."""
        if not ending or source.lower().endswith(ending):
            return source
        path = os.path.join(work, "in" + ending)
        if not os.path.isfile(path):
            captured([self.meshconvert, "--quiet", source, path], self.patience)
        return path if os.path.isfile(path) else None

    def distance(self, source, out):
        """The larger way, as a share of the input's diagonal."""
        done = captured([self.meshdist, "--json", source, out], self.patience)
        try:
            found = json.loads(done[1] if done else "")["distance"]
            return float(f"{found['hausdorff'] / found['diagonal']:.4g}")
        except (ValueError, KeyError, TypeError, ZeroDivisionError):
            return None
