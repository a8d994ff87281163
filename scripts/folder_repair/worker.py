# SPDX-License-Identifier: MIT
"""One file at work: how it is begun, kept within its limit of time, and judged."""

import os
import shutil
import signal
import subprocess
import time

from .basics import DONE, INTERNAL, LIMIT, NO_SOLID, WRITTEN, is_certified, text, value_of
from .gallery import SIZE
from .program import last_line
from .starter import started_process

UNKILLABLE_SECONDS = 10  # from SIGKILL until a worker that a dead disk holds is given up


class Worker:
    """A job of the server, which writes into a folder of its own."""

    def __init__(self, job, server, number, folder, has_page=False):
        self.job = job
        self.server = server
        self.number = number
        self.folder = folder
        self.pages = {b".html": folder + b".html", b".png": folder + b".png"} if has_page else {}  # of the gallery
        self.mesh = os.path.join(folder, os.path.basename(job.target))
        self.started = time.monotonic()
        self.told_to_end = None  # when
        self.reason = None  # why
        self.answer = None
        self.code = self.signal_number = self.peak_memory = self.report = None
        self.looker = None  # has a look if nothing becomes of the mesh
        shown = ["--html", self.pages[b".html"], "--picture", self.pages[b".png"]] if has_page else []
        server.begin(number, job.source, job.target,
                     ["--root", job.root, "--format", job.format, *shown, "--staging", folder])

    def take(self, answer):
        """The code is as in a shell: 128 and the signal."""
        self.answer = answer
        self.code, self.signal_number = answer["exit_code"], answer["signal"]
        self.peak_memory = answer["peak_memory_bytes"]
        self.report = answer["report"] if isinstance(answer["report"], dict) else None

    def has_ended(self, program, locks):
        """Without waiting."""
        if self.looker:
            return self.looker.poll() is not None
        if self.answer is None:
            return False
        return not (self.code == NO_SOLID and not self.reason and self.pages and self.look(program, locks))

    def look(self, program, locks):
        """Has meshcheck draw the mesh, of which nothing has become. False if there is none."""
        meshcheck = os.path.join(os.path.dirname(os.fsencode(program)), b"meshcheck")
        nothing = subprocess.DEVNULL
        try:
            self.looker = started_process(
                [meshcheck, "--quiet", "--threads", "1", "--html", self.pages[b".html"], "--picture", self.pages[b".png"],
                 "--picture-size", f"{SIZE[0]}x{SIZE[1]}", "--", self.job.source], locks, stdin=nothing, stdout=nothing, stderr=nothing)
        except (OSError, subprocess.SubprocessError):
            return False
        return True

    def enforce(self, options):
        """Ends what is over its limit. False if even SIGKILL is of no use."""
        now = time.monotonic()
        if self.told_to_end:
            return now < self.told_to_end + options.grace + UNKILLABLE_SECONDS
        if options.timeout and now > self.started + options.timeout + options.grace:
            self.reason = f"does not end at the time limit of {options.timeout:g} s: killed"
            self.told_to_end = now
            self.cancel(options.grace)
        return True

    def cancel(self, grace):
        if self.looker:
            self.looker.kill()
        else:
            self.server.cancel(self.number, grace)

    def complaint(self):
        """Why it is not believed that a mesh is written, or None."""
        if value_of(self.report, "exit_code") != self.code:
            return f"ended with exit code {self.code}, but without a report that says so"
        if self.code == DONE:
            if not is_certified(self.report):
                return "ended with exit code 0, but without a certificate"
            if not os.path.isfile(self.mesh) or os.path.getsize(self.mesh) == 0:
                return "ended with exit code 0, but wrote no mesh"
        return None

    def files_beside(self):
        """What else was written, sorted: the library of an OBJ file, and pictures of an archive."""
        return sorted(entry.path for entry in os.scandir(self.folder) if entry.path != self.mesh)

    def clear(self):
        """Nothing that it has made, and nobody has taken, stays."""
        shutil.rmtree(self.folder, ignore_errors=True)
        for path in self.pages.values():
            if os.path.lexists(path):
                os.unlink(path)

    def judge(self):
        """The exit code and the error line that count, and the report."""
        report = self.report
        if self.code in WRITTEN:
            complaint = self.complaint()
            if complaint:
                return INTERNAL, complaint, None
            return self.code, None if self.code == DONE else self.error_line(report), report
        if self.reason and not self.looker:
            return LIMIT, self.reason, report
        if self.signal_number:
            return self.code, f"killed by signal {self.signal_number}", report
        return self.code, self.error_line(report), report

    def error_line(self, report):
        """Without the names of files, which stand beside it."""
        line = str(value_of(report, "error") or last_line(self.answer["stderr"]) or self.answer["error"] or "").removeprefix("error: ")
        for path in (self.job.source, self.mesh, self.job.target):
            line = line.removeprefix(path.decode("utf-8", "replace") + ": ")
        for path in (self.mesh, self.job.target):
            line = line.replace(path.decode("utf-8", "replace"), text(self.job.output))
        if self.job.root.startswith(self.folder):  # unpacked, to a place that is another in each run
            line = line.replace(os.path.join(self.job.root, b"").decode("utf-8", "replace"), "")
        return line or f"ended with exit code {self.code} and said nothing"
