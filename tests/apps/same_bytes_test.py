#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs the programs twice, in two ways that must give the same bytes.

Usage: same_bytes_test.py PROGRAMS WAY MESH [RULE [OPTION...]]

PROGRAMS is the folder of the programs. WAY: "chain" compares the three steps with the one program,
through files and through pipes; "threads" one thread with four; "runs" a run with the next one;
"locale" a German environment with the plain one; "relabel" a tree that was labelled by another rule
before with one that was not. The options are for all programs but bspbuild. Results need not be
certified.
"""

import os
import pathlib
import subprocess
import sys
import tempfile


class Programs:
    def __init__(self, folder, rule, options):
        self.folder = folder
        self.options = options
        self.rule = ["--inside", rule]

    def run(self, name, *arguments, data=None, environment=None):
        options = self.options if name != "bspbuild" else []
        command = [os.path.join(self.folder, name), "--quiet", *map(str, arguments), *options]
        result = subprocess.run(command, input=data, stdout=subprocess.PIPE,
                                env={**os.environ, **(environment or {})})
        if result.returncode not in (0, 1):
            sys.exit(f"{command}: exit code {result.returncode}")
        return result.stdout

    def repaired(self, mesh, *arguments, environment=None):
        return self.run("meshrepair", mesh, "-", "--format", "ply", "--sources", "--always", *self.rule,
                        *arguments, environment=environment)

    def by_files(self, mesh, before=None):
        """`before`: a rule by which the tree is labelled first."""
        with tempfile.TemporaryDirectory(prefix="same_bytes_") as name:
            folder = pathlib.Path(name)
            tree, solid, out = folder / "tree.bsp", folder / "solid.bsp", folder / "out.ply"
            self.run("bspbuild", mesh, "-o", tree)
            if before:
                self.run("bspsolid", tree, "-o", tree, "--inside", before)
            self.run("bspsolid", tree, "-o", solid, *self.rule)
            self.run("bspextract", solid, "-o", out, "--sources")
            return out.read_bytes()

    def by_pipes(self, mesh):
        data = self.run("bspbuild", "-", "-o", "-", data=pathlib.Path(mesh).read_bytes())
        data = self.run("bspsolid", "-", "-o", "-", *self.rule, data=data)
        return self.run("bspextract", "-", "-o", "-", "--format", "ply", "--sources", data=data)


def outputs(programs, way, mesh):
    yield programs.repaired(mesh)
    if way == "chain":
        yield programs.by_files(mesh)
        yield programs.by_pipes(mesh)
    elif way == "threads":
        yield programs.repaired(mesh, "--threads", 1)
        yield programs.repaired(mesh, "--threads", 4)
    elif way == "runs":
        yield programs.repaired(mesh)
    elif way == "locale":
        yield programs.repaired(mesh, environment={"LC_ALL": "de_DE.UTF-8"})
    elif way == "relabel":
        yield programs.by_files(mesh, before="parity")
    else:
        sys.exit(f"unknown way {way}")


def main():
    folder, way, mesh = sys.argv[1:4]
    programs = Programs(folder, sys.argv[4] if len(sys.argv) > 4 else "auto", sys.argv[5:])
    results = list(outputs(programs, way, mesh))
    if not results[0] or any(result != results[0] for result in results):
        sys.exit(f"{way}: the outputs have {[len(result) for result in results]} bytes and differ")


if __name__ == "__main__":
    main()
