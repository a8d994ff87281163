# SPDX-License-Identifier: MIT
"""Folders of meshes."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from typing import Any

from ._options import keywords_of, path_of
from .errors import LimitError, UsageError, error_of
from .program import program_path

_SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "scripts", "repair_folder.py")


def _words(options: dict[str, Any]) -> list[str | bytes]:
    words: list[str | bytes] = []
    for name, value in keywords_of(options):
        word = "--" + name.replace("_", "-")
        if value is True:
            words.append(word)
        elif value is not False:
            words.append(f"{word}=".encode() + value)
    return words


def _summary_of(target: bytes, shard: str | None) -> bytes:
    if shard is None:
        return os.path.join(target, b"summary.json")
    name = "-of-".join(str(int(number)) for number in shard.split("/"))
    return os.path.join(target, b".repair_folder", b"shards", name.encode(), b"summary.json")


def repair_folder(source: Any, target: Any, *, format: str | None = None, jobs: int | None = None, timeout: float = 600,
                  grace: float = 5, max_memory: str | int | None = None, restart: bool = False,
                  html: bool = False, shard: str | None = None, merge: bool = False, quiet: bool = True, **options: Any) -> dict[str, Any]:
    """Repairs all meshes in a folder and its subfolders, several at a time, each in a separate process.

    Args:
        source: the folder to read.
        target: the folder to write to, which is created. Repeat the call to continue an interrupted one.
        format: format of all outputs; by default that of the input.
        jobs: number of processes; by default the number of cores.
        timeout: seconds for a file; 0: no limit.
        grace: seconds to end after the timeout before a kill.
        max_memory: memory for a file, such as "2G".
        restart: repair all files again.
        shard: "3/8" is the third of eight shares of the files; calls with different shards may be at work on one target at
            the same time.
        merge: repair nothing; write the summary of such calls.
        html: also write ``index.html`` into the target, a gallery for browsers.
        quiet: print only errors.
        **options: of the program ``meshrepair``, with _ for -, for each file.

    Returns:
        The summary of the run, ``summary.json``: a dict; see docs/folders.md.
    """
    own = {"format": format, "jobs": jobs, "timeout": timeout, "grace": grace, "max_memory": max_memory,
           "restart": restart, "html": html, "shard": shard, "merge": merge, "quiet": quiet, "meshrepair": program_path()}
    folders = [path_of(source, "source"), path_of(target, "target")]
    command = [sys.executable, "-s", _SCRIPT, *_words(own), *folders,
               "--", *_words(options)]
    process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stderr=subprocess.PIPE)
    try:
        _, said = process.communicate()
    except BaseException:  # Ctrl-C: what is finished stays, and the workers end with their parent
        process.send_signal(signal.SIGINT)
        process.wait()
        raise
    lines = said.decode("utf-8", "replace").splitlines()
    if process.returncode not in (0, 1):
        message = lines[-1].removeprefix("repair_folder.py: ") if lines else f"ended with {process.returncode}"
        if process.returncode < 0:
            raise LimitError(f"repair_folder.py was killed by signal {-process.returncode}")
        raise error_of(process.returncode, message)
    try:
        with open(_summary_of(folders[1], shard), encoding="utf-8") as file:
            summary: dict[str, Any] = json.load(file)
    except OSError as error:
        raise UsageError(f"target: {error}") from None
    return summary
