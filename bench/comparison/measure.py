# SPDX-License-Identifier: MIT
"""Runs a program and measures it."""

import contextlib
import dataclasses
import os
import resource
import signal
import subprocess
import threading
import time

from .basics import USAGE, Held, Stop

HIDDEN = 1.05  # the peak of a process that does nothing is a little above that of the process that started it


@dataclasses.dataclass(frozen=True)
class Run:
    code: int | None  # negative: ended by that signal; None: out of time
    cpu: float  # seconds of all threads, and of processes that it waited for, in the program and in the system
    wall: float  # seconds
    peak: float  # MB
    peak_hidden: bool  # it is what this script had when it started the program, and the program may have had less
    error: str  # the last line on standard error


def peak_of(usage):
    return usage.ru_maxrss * 1024 / 1e6


def kill(group):
    with contextlib.suppress(ProcessLookupError):
        os.killpg(group, signal.SIGKILL)


def limit_of(memory):
    """Sets it for what a process becomes, and for each that it starts: so many bytes of data."""
    return (lambda: resource.setrlimit(resource.RLIMIT_DATA, (memory, memory))) if memory else None


def start(command, **more):
    """In a process group of its own, so that whatever a wrapper starts ends with it. Signals are held, until the caller releases them."""
    Held.is_on = True
    try:
        return subprocess.Popen(command, stdin=subprocess.DEVNULL, start_new_session=True, **more)
    except OSError as error:
        Held.release()
        raise Stop(USAGE, f"{command[0]}: cannot be started: {error.strerror}") from None


def wait(child, timeout):
    """Status and usage, and whether the time was over. Nothing of the group is left."""
    late = threading.Event()

    def end():
        late.set()
        kill(child.pid)
    timer = threading.Timer(timeout, end)
    timer.daemon = True
    try:
        Held.release()
        timer.start()
        _, status, usage = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    finally:
        timer.cancel()
        kill(child.pid)
        if child.returncode is None:
            child.wait()
    return usage, late.is_set()


def last_line(errors):
    errors.seek(0, os.SEEK_END)
    errors.seek(max(0, errors.tell() - 4096))
    lines = errors.read().decode("utf-8", "replace").strip().splitlines()
    return lines[-1].strip()[:200] if lines else ""


def run(command, work, timeout, kind="", memory=None):
    with open(os.path.join(work, "errors"), "wb+") as errors:
        own_peak = peak_of(resource.getrusage(resource.RUSAGE_SELF))  # a new process begins with it
        begin = time.monotonic()
        child = start(command, stdout=subprocess.DEVNULL, stderr=errors, env={**os.environ, "COMPARE_KIND": kind},
                      preexec_fn=limit_of(memory))
        usage, late = wait(child, timeout)
        wall = time.monotonic() - begin
        return Run(None if late else child.returncode, usage.ru_utime + usage.ru_stime, wall, peak_of(usage),
                   peak_of(usage) <= HIDDEN * own_peak, last_line(errors))


def captured(command, timeout):
    """The exit code and what it prints on standard output and standard error; None where time is over. Nothing of the group is
    left."""
    child = start(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    try:
        Held.release()
        out, errors = child.communicate(timeout=timeout)
    except subprocess.TimeoutExpired:
        return None
    finally:
        kill(child.pid)
        child.wait()
    return child.returncode, out.decode("utf-8", "replace"), errors.decode("utf-8", "replace")
