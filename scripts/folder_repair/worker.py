# SPDX-License-Identifier: MIT
"""One meshrepair process: how it is started, kept within its limits, and judged."""

import json
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
STDERR_BYTES = 1 << 16  # kept of what it says, the end of it
REPORT_BYTES = 1 << 26  # a longer report is none


class Worker:
    """It writes into a folder of its own. OSError if it cannot be started."""

    def __init__(self, job, command, folder, locks, has_page=False):
        self.job = job
        self.folder = folder
        self.pages = {b".html": folder + b".html", b".png": folder + b".png"} if has_page else {}  # of the gallery
        self.mesh = os.path.join(folder, os.path.basename(job.target))
        self.report_path = os.path.join(folder, b"report.json")
        self.started = time.monotonic()
        self.told_to_end = self.killed = None  # when
        self.reason = None  # why
        self.said = b""
        self.code = self.signal_number = self.peak_memory = None
        self.locks = locks
        self.looks = has_page  # if nothing becomes of the mesh
        self.is_looking = False
        shown = ["--html", self.pages[b".html"], "--picture", self.pages[b".png"]] if has_page else []
        self.program = command[0]
        self.process = started_process([*command, "--format", job.format, "--report", self.report_path, *shown, "--staging",
                                        folder, job.source, job.target], subprocess.PIPE, locks)
        self.pipe = self.process.stderr
        self.stderr = self.pipe.fileno()
        os.set_blocking(self.stderr, False)

    def listen(self):
        """Reads some of what it says. False at the end of it."""
        try:
            data = os.read(self.stderr, STDERR_BYTES)
        except BlockingIOError:
            return True
        self.said = (self.said + data)[-STDERR_BYTES:]
        return bool(data)

    def signal(self, number):
        """Also to what it has started itself."""
        try:
            os.killpg(self.process.pid, number)
        except ProcessLookupError:
            pass

    def has_ended(self):
        """Without waiting. The code is as in a shell: 128 and the signal."""
        pid = self.process.pid
        if os.waitid(os.P_PID, pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is None:
            return False
        self.signal(signal.SIGKILL)  # what it has started itself; its number is not free yet
        _, status, usage = os.wait4(pid, 0)
        code = os.waitstatus_to_exitcode(status)
        self.process.returncode = code
        if not self.is_looking:
            self.code = code if code >= 0 else 128 - code
            self.signal_number = -code if code < 0 else None
            self.peak_memory = usage.ru_maxrss * 1024
            self.listen()
            if self.code == NO_SOLID and not self.reason and self.looks and self.look():
                return False
        self.pipe.close()
        return True

    def look(self):
        """Has meshcheck draw the mesh, of which nothing has become. False if there is none."""
        meshcheck = os.path.join(os.path.dirname(os.fsencode(self.program)), b"meshcheck")
        try:
            self.process = started_process(
                [meshcheck, "--quiet", "--threads", "1", "--html", self.pages[b".html"], "--picture", self.pages[b".png"],
                 "--picture-size", f"{SIZE[0]}x{SIZE[1]}", "--", self.job.source], subprocess.DEVNULL, self.locks)
        except (OSError, subprocess.SubprocessError):
            return False
        self.is_looking = True
        return True

    def memory(self):
        """What it holds now, without what it shares with files; in bytes."""
        try:
            with open(f"/proc/{self.process.pid}/statm", encoding="ascii") as file:
                _, resident, shared = file.read().split()[:3]
        except OSError:
            return 0
        return (int(resident) - int(shared)) * os.sysconf("SC_PAGE_SIZE")

    def enforce(self, options, memory_allowed):
        """Ends what is over its limits. False if even SIGKILL is of no use."""
        now = time.monotonic()
        if self.killed:
            return now < self.killed + UNKILLABLE_SECONDS
        if memory_allowed and self.memory() > memory_allowed:
            self.reason = "takes more memory than it may: killed"
            self.kill()
        elif self.told_to_end:
            if now > self.told_to_end + options.grace:
                self.kill()
        elif options.timeout and now > self.started + options.timeout + options.grace:
            self.reason = f"does not end at the time limit of {options.timeout:g} s: killed"
            self.told_to_end = now
            self.signal(signal.SIGTERM)
        return True

    def kill(self):
        self.killed = time.monotonic()
        self.signal(signal.SIGKILL)

    def report(self):
        """None if there is none."""
        try:
            with open(self.report_path, "rb") as file:
                report = json.loads(file.read(REPORT_BYTES))
        except (OSError, ValueError, RecursionError):
            return None
        return report if isinstance(report, dict) else None

    def complaint(self, report):
        """Why it is not believed that a mesh is written, or None."""
        if value_of(report, "exit_code") != self.code:
            return f"ended with exit code {self.code}, but without a report that says so"
        if self.code == DONE:
            if not is_certified(report):
                return "ended with exit code 0, but without a certificate"
            if not os.path.isfile(self.mesh) or os.path.getsize(self.mesh) == 0:
                return "ended with exit code 0, but wrote no mesh"
        return None

    def files_beside(self):
        """What else was written, sorted: the library of an OBJ file, and pictures of an archive."""
        return sorted(path for path in (entry.path for entry in os.scandir(self.folder))
                      if path not in (self.mesh, self.report_path))

    def clear(self):
        """Nothing that it has made, and nobody has taken, stays."""
        shutil.rmtree(self.folder, ignore_errors=True)
        for path in self.pages.values():
            if os.path.lexists(path):
                os.unlink(path)

    def judge(self):
        """The exit code and the error line that count, and the report."""
        report = self.report()
        if self.code in WRITTEN:
            complaint = self.complaint(report)
            if complaint:
                return INTERNAL, complaint, None
            return self.code, None if self.code == DONE else self.error_line(report), report
        if self.reason and not self.is_looking:
            return LIMIT, self.reason, report
        if self.signal_number:
            return self.code, f"killed by signal {self.signal_number}", report
        return self.code, self.error_line(report), report

    def error_line(self, report):
        """Without the names of files, which stand beside it."""
        line = str(value_of(report, "error") or last_line(self.said)).removeprefix("error: ")
        for path in (self.job.source, self.mesh, self.job.target):
            line = line.removeprefix(path.decode("utf-8", "replace") + ": ")
        for path in (self.mesh, self.job.target):
            line = line.replace(path.decode("utf-8", "replace"), text(self.job.output))
        if self.job.root.startswith(self.folder):  # unpacked, to a place that is another in each run
            line = line.replace(os.path.join(self.job.root, b"").decode("utf-8", "replace"), "")
        return line or f"ended with exit code {self.code} and said nothing"
