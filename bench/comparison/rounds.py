# SPDX-License-Identifier: MIT
"""Runs all programs on an input, in rounds, so that what disturbs one disturbs the others as much."""

import json
import os
import shutil

from .basics import USAGE, Stop, say
from .inputs import count_faces, digest_of
from .judge import NO, NO_RESULT, UNJUDGED, YES
from .measure import run
from .programs import DOES_NOT_DO_THIS

WORST_FIRST = (NO_RESULT, NO, UNJUDGED, YES)


class Measured:
    """What a program did on an input, in all rounds."""

    def __init__(self, program, item):
        self.program, self.item = program, item
        self.runs, self.verdicts = [], {}  # verdicts by digest of the result
        self.triangles = None  # of the last result

    def add(self, done, verdict, digest, triangles):
        self.runs.append(done)
        self.verdicts[digest] = verdict
        self.triangles = triangles

    def least(self, what):
        return min(getattr(each, what) for each in self.runs)

    def peak_hidden(self):
        return any(each.peak_hidden for each in self.runs)

    def differ(self):
        """By how much the CPU time of the slowest round is above that of the fastest."""
        least = self.least("cpu")
        return max(each.cpu for each in self.runs) / least - 1 if least > 0 else 0.0

    def verdict(self):
        return min(self.verdicts.values(), key=WORST_FIRST.index)

    def failed(self):
        return self.verdict() == NO_RESULT

    def skipped(self):
        return self.runs[0].code == DOES_NOT_DO_THIS

    def code(self):
        """The first that is not 0. None: out of time."""
        return next((each.code for each in self.runs if each.code != 0), 0)


class Rounds:
    def __init__(self, programs, judge, work, options):
        self.programs, self.judge, self.work, self.options = programs, judge, work, options
        self.out = os.path.join(work, "out.off")

    def remove_out(self):
        if os.path.isdir(self.out) and not os.path.islink(self.out):
            shutil.rmtree(self.out)
        elif os.path.lexists(self.out):
            os.unlink(self.out)

    def run_once(self, measured):
        program, item = measured.program, measured.item
        self.remove_out()
        done = run(program.command(item.kind, item.files, self.out), self.work, self.options.timeout, item.kind)
        if done.code not in program.wrote or not os.path.isfile(self.out):
            measured.add(done, NO_RESULT, "", None)
            if done.code != DOES_NOT_DO_THIS:
                reason = "out of time" if done.code is None else f"exit code {done.code}"
                say(f"{item.name()}: {program.name}: no result, {reason}" + (f": {done.error}" if done.error else ""))
            return
        digest = digest_of([self.out])
        verdict = measured.verdicts.get(digest) or self.judge.verdict(item, self.out)
        measured.add(done, verdict, digest, count_faces(self.out))

    def run_calibration(self, program):
        done = run([program], self.work, self.options.timeout)
        if done.code != 0:
            raise Stop(USAGE, f"{program}: exit code {done.code}")
        return done.cpu

    def measure(self, item, calibration=None):
        """A Measured for each program that does this kind; and the least CPU time of the calibration, if one is given.
        What failed once is not tried again."""
        all_measured = [Measured(program, item) for program in self.programs if program.does(item.kind)]
        fixed = []
        for number in range(self.options.rounds):
            if not self.options.quiet:
                say(f"{item.name()}: round {number + 1} of {self.options.rounds}")
            if calibration:
                fixed.append(self.run_calibration(calibration))
            for measured in all_measured if number % 2 == 0 else reversed(all_measured):
                if not measured.runs or not measured.failed():
                    self.run_once(measured)
        self.remove_out()
        return [each for each in all_measured if not each.skipped()], min(fixed, default=None)

    def stages(self, program, item):
        """CPU seconds by stage, the least of as many runs more, which write reports."""
        least = {}
        for _ in range(self.options.rounds):
            for name, spent in self.stages_once(program, item).items():
                least[name] = min(spent, least.get(name, spent))
        return least

    def stages_once(self, program, item):
        """Without what is measured for the report alone; nothing where there is no report."""
        report = os.path.join(self.work, "report.json")
        run(program.command(item.kind, item.files, self.out, report), self.work, self.options.timeout, item.kind)
        self.remove_out()
        try:
            with open(report, encoding="utf-8") as file:
                stages = json.load(file)["stages"]
            os.unlink(report)
        except (OSError, ValueError, KeyError):
            return {}
        found = {}
        for stage in stages:
            if stage["name"] != "distance":
                found[stage["name"]] = found.get(stage["name"], 0.0) + stage.get("cpu_seconds", 0.0)
        return found
