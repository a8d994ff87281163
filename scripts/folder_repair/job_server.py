# SPDX-License-Identifier: MIT
"""meshrepair --jobs-from: one process that repairs file after file, several at a time, each in a copy of itself."""

import base64
import json
import os
import signal
import subprocess

from .basics import INTERNAL
from .starter import started_process

READ_BYTES = 1 << 20


def as_json(word):
    """Of bytes or a string. JSON has no bytes."""
    try:
        return os.fsencode(word).decode("utf-8")
    except UnicodeDecodeError:
        return {"base64": base64.b64encode(os.fsencode(word)).decode("ascii")}


class JobServer:
    """OSError or SubprocessError if it cannot be started."""

    def __init__(self, program, options, jobs, locks):
        self.process = started_process([program, "--jobs-from", "-", "--jobs", str(jobs), *options], locks, stdin=subprocess.PIPE,
                                       stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        self.unread = []  # of a line that is not whole
        self.answers = self.process.stdout.fileno()

    def begin(self, number, source, target, options):
        """What becomes of it is in the answer with this number; if the server dies there is none."""
        self.tell({"id": number, "in": as_json(source), "out": as_json(target), "options": [*map(as_json, options)]})

    def cancel(self, number, grace):
        """It has so many seconds to end by itself."""
        self.tell({"cancel": number, "grace": grace})

    def tell(self, line):
        try:
            self.process.stdin.write(json.dumps(line).encode() + b"\n")
            self.process.stdin.flush()
        except OSError:  # it has died, and listen() says so
            pass

    def listen(self):
        """The answers that are there; None at the end of them, when it has died."""
        data = os.read(self.answers, READ_BYTES)
        if not data:
            return None
        *lines, rest = data.split(b"\n")
        if lines:
            lines[0] = b"".join([*self.unread, lines[0]])
            self.unread.clear()
        self.unread.append(rest)
        return [json.loads(line) for line in lines]

    def last_answer(self):
        """To all that has none, once it has died."""
        self.end()
        code = self.process.returncode
        killed_by = -code if code < 0 else None
        return {"exit_code": 128 - code if killed_by else INTERNAL, "signal": killed_by, "peak_memory_bytes": None,
                "stderr": "", "error": f"meshrepair --jobs-from ended with exit code {code}", "report": None}

    def signal(self, number):
        """Also to its jobs, and what they have started."""
        try:
            os.killpg(self.process.pid, number)
        except ProcessLookupError:
            pass

    def wait(self, seconds):
        """Whether it has ended by then."""
        try:
            self.process.wait(seconds)
            return True
        except subprocess.TimeoutExpired:
            return False

    def end(self):
        """At once. What it has started must not outlive it; its number is not free until it is waited for."""
        self.signal(signal.SIGKILL)
        self.process.wait()
        for stream in (self.process.stdin, self.process.stdout):
            try:
                stream.close()
            except OSError:  # what nobody has read goes
                pass
