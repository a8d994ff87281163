# SPDX-License-Identifier: MIT
"""How a worker is started, so that it dies with this script, and before it when memory runs out.

What a process is to get from its parent's death it can only ask for itself. The way by setpriv and sh takes half a
millisecond of this script. The other way, a copy of this script that asks and becomes the worker, takes 4, and with
100,000 files, whose names it holds, 15; it is for systems without such a setpriv.
"""

import ctypes
import errno
import functools
import os
import shutil
import signal
import subprocess

from .basics import INTERNAL

LIBC = ctypes.CDLL(None)
PR_SET_PDEATHSIG = 1
SHELL = "/bin/sh"
# It has asked already; if the parent was dead by then it is that of another.
BECOME = 'test "$PPID" = "$0" || exit 70; echo 1000 2>/dev/null >/proc/self/oom_score_adj; exec "$@"'


@functools.cache
def way_by_setpriv():
    """The beginning of a command, or None if this system has none."""
    setpriv = shutil.which("setpriv")
    if not setpriv or not os.access(SHELL, os.X_OK):
        return None
    way = [setpriv, "--pdeathsig", "KILL", "--", SHELL, "-c", BECOME]
    try:
        tried = subprocess.run([*way, str(os.getpid()), "true"], stdin=subprocess.DEVNULL, capture_output=True, check=False)
    except OSError:
        return None
    return way if tried.returncode == 0 else None


def bind_to_parent(parent):
    """Called in the copy, before it becomes the worker."""
    if hasattr(LIBC, "prctl"):
        LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)
    if os.getppid() != parent:
        os._exit(INTERNAL)
    try:
        with open("/proc/self/oom_score_adj", "w", encoding="ascii") as file:
            file.write("1000")
    except OSError:
        pass


def started_process(command, locks, **streams):
    """OSError or SubprocessError if it cannot be."""
    program, parent, way = command[0], os.getpid(), way_by_setpriv()
    others = {}
    if way:
        if not os.access(program, os.X_OK):
            raise OSError(errno.ENOENT, os.strerror(errno.ENOENT), program)
        command = [*way, str(parent), *command]
    else:
        others["preexec_fn"] = lambda: bind_to_parent(parent)
    return subprocess.Popen(command, start_new_session=True, pass_fds=locks, **streams, **others)
