# SPDX-License-Identifier: MIT
"""The meshrepair to use, and whether it takes the options."""

import hashlib
import os
import re
import shutil
import subprocess

from .basics import USAGE, Stop

BUILT = os.path.join(os.path.dirname(os.path.realpath(__file__)), "../../build/release/bin/meshrepair")
PROBE_SECONDS = 60  # for --version
NO_MESH = "/nonexistent/mesh.ply"


def last_line(said):
    """What meshrepair says of a failure, without its name."""
    lines = [line for line in said.splitlines() if line.strip()]
    return re.sub(r"^meshrepair: (error: )?", "", lines[-1].strip()[:2000]) if lines else ""


class Program:
    """Stop if it is not there, is none, or refuses the options that are passed on."""

    def __init__(self, given, passed):
        self.path = self.locate(given)
        self.version = self.ask("--version").strip()
        if not re.fullmatch(r"meshrepair \S+", self.version):
            raise Stop(USAGE, f"{self.path} is not meshrepair")
        with open(self.path, "rb") as file:
            self.digest = hashlib.file_digest(file, "sha256").hexdigest()[:16]
        self.check(passed)

    @staticmethod
    def locate(given):
        for path in (given,) if given else (BUILT, shutil.which("meshrepair")):
            if path and os.path.isfile(path) and os.access(path, os.X_OK):
                return os.path.abspath(path)
        raise Stop(USAGE, f"{given} is no program" if given else
                   "no meshrepair, neither in build/release/bin nor in PATH: use --meshrepair")

    def run(self, *arguments):
        try:
            return subprocess.run([self.path, *arguments], stdin=subprocess.DEVNULL, check=False,
                                  capture_output=True, timeout=PROBE_SECONDS)
        except (OSError, subprocess.TimeoutExpired) as error:
            raise Stop(USAGE, f"{self.path} cannot be run: {error}") from None

    def ask(self, option):
        result = self.run(option)
        if result.returncode != 0:  # killed, perhaps: what it can do is not known
            raise Stop(USAGE, f"{self.path} cannot be asked for {option}: exit code {result.returncode}")
        return result.stdout.decode("utf-8", "replace")

    def check(self, passed):
        """Wrong options are told once, not for each file."""
        result = self.run("--quiet", *passed, NO_MESH, NO_MESH)
        if result.returncode == USAGE:
            raise Stop(USAGE, "meshrepair refuses the options: " + last_line(result.stderr.decode("utf-8", "replace")))
