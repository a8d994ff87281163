#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Forces even small arrays into the file, and lets no page of it stay in memory: the results are the same bytes.

Usage: small_blocks_test.py PROGRAMS WRITE_SOUPS [SOUPS [FOLDER]]

PROGRAMS is the folder of the programs. Repairs and checks SOUPS random soups (default: 1000), and all meshes below
FOLDER.
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile

LEAST_BLOCK = 2400  # bytes: the corners of 200 triangles
MOST_SECONDS = 600


class Runs:
    def __init__(self, programs, folder):
        self.programs, self.folder = programs, folder
        self.temp = folder / "temp"
        self.temp.mkdir()

    def results(self, mesh, forced):
        """Exit code, messages and bytes of a repair, exit code and findings of a check of the mesh."""
        environment = dict(os.environ)
        if forced:
            environment["MESHREPAIR_SPILL_FROM"] = str(LEAST_BLOCK)
        out = self.folder / "out.ply"
        out.unlink(missing_ok=True)
        temp = self.temp if forced else "none"

        def run(name, *arguments):
            command = [self.programs / name, *arguments, "-q", "--temp", temp, "--max-memory", "4G"]
            return subprocess.run(command, env=environment, capture_output=True, timeout=MOST_SECONDS)

        repair = run("meshrepair", mesh, out, "--always")
        check = run("meshcheck", mesh, "--json")
        report = json.loads(check.stdout)
        if forced != ("temp_file" in report):
            sys.exit(f"{mesh}: the file was not used as it should be")
        if list(self.temp.iterdir()):
            sys.exit(f"{mesh}: something is left of the file")
        data = out.read_bytes() if out.exists() else None
        return repair.returncode, repair.stderr, data, check.returncode, check.stderr, report.get("check")

    def compare(self, mesh):
        """Nothing if both ways give the same, or what differs."""
        if self.results(mesh, False) != self.results(mesh, True):
            return f"{mesh}: differs"
        return None


def main():
    programs, write_soups = map(pathlib.Path, sys.argv[1:3])
    count = sys.argv[3] if len(sys.argv) > 3 else "1000"
    with tempfile.TemporaryDirectory(prefix="small_blocks_", dir="/var/tmp") as name:
        folder = pathlib.Path(name)
        soups = folder / "soups"
        soups.mkdir()
        subprocess.run([write_soups, count, soups], check=True)
        meshes = sorted(soups.iterdir())
        if len(sys.argv) > 4:
            meshes += sorted(path for path in pathlib.Path(sys.argv[4]).rglob("*") if path.is_file())
        runs = Runs(programs, folder)
        different = [said for mesh in meshes if (said := runs.compare(mesh))]
    print("\n".join(different) or f"{len(meshes)} meshes give the same bytes")
    return 1 if different or not meshes else 0


if __name__ == "__main__":
    sys.exit(main())
