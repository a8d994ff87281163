# SPDX-License-Identifier: MIT
"""The programs that are compared, and how each is called."""

import os
import re

from .basics import USAGE, Stop

DOES_NOT_DO_THIS = 77  # exit code of a peer, for a kind of input that is not its business


def executable(path):
    return os.path.isfile(path) and os.access(path, os.X_OK)


def called(text, default):
    """Name and path of NAME=PATH, or of a PATH alone."""
    name, equals, path = text.partition("=")
    if not equals:
        name, path = default, text
    if not re.fullmatch(r"[\w.+ -]+", name) or not path:
        raise Stop(USAGE, f"{text} is not NAME=PATH")
    return name, os.path.abspath(path)


class Ours:
    """meshrepair, and bspbool for unions, in a folder. Exit code 1 has a result, which is not certified."""

    wrote = (0, 1)

    def __init__(self, name, folder, threads, several):
        self.plain_name, self.folder, self.threads = name, folder, threads
        self.name = f"{name}, {threads} thread{'s' if threads > 1 else ''}" if several else name

    def program(self, kind):
        return os.path.join(self.folder, "bspbool" if kind == "union" else "meshrepair")

    def does(self, _):
        return True

    def command(self, kind, files, out, report=None):
        output = ["--op", "union", "-o", out] if kind == "union" else [out]
        extra = ["--report", report] if report else []
        return [self.program(kind), *files, *output, "--threads", str(self.threads), "--quiet", *extra]


class Cgal:
    """CGAL's corefinement for unions, and its advancing front for clouds: the programs of bench/others."""

    wrote = (0,)
    name = "CGAL"
    programs = {"union": "cgal_booleans", "cloud": "cgal_points"}

    def __init__(self, folder):
        self.folder = folder

    def path(self, kind):
        return os.path.join(self.folder, self.programs[kind])

    def does(self, kind):
        return kind in self.programs and executable(self.path(kind))

    def command(self, kind, files, out):
        return [self.path(kind), *files, *(["union", out] if kind == "union" else [out, "front"])]


class Peer:
    """A wrapper script: SCRIPT IN OUT, or SCRIPT A B OUT for a union. It made OUT if it ends with 0."""

    wrote = (0,)

    def __init__(self, name, script):
        self.name, self.script = name, script
        if not executable(script):
            raise Stop(USAGE, f"{script}: is no program")

    def does(self, _):
        return True

    def command(self, _, files, out):
        return [self.script, *files, out]


def check_names(programs):
    names = [program.name for program in programs]
    for name in names:
        if names.count(name) > 1:
            raise Stop(USAGE, f"two programs are called {name}: give names, as --ours before=FOLDER")


def check_ours(ours, kinds):
    for program in ours:
        for kind in kinds:
            if not executable(program.program(kind)):
                raise Stop(USAGE, f"{program.program(kind)}: is no program; build it, or give another folder with --ours")
