#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Tests of what the programs print for packages: manual pages, completions of three shells, and facts of the build.

Usage: descriptions_test.py FOLDER_OF_PROGRAMS FOLDER_OF_DESCRIPTIONS [OPTIONS OF UNITTEST]

A tool that is not installed skips its tests.
"""

import json
import os
import pathlib
import pty
import re
import select
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAMS = ("meshrepair", "meshconvert", "pointmesh", "bspbuild", "bspsolid", "bspextract", "bspbool", "meshbodies", "meshcheck", "meshdist",
            "meshrepair-blocks")
BASH_COMPLETION = pathlib.Path("/usr/share/bash-completion/bash_completion")
SECONDS = 60  # for what takes one on an idle machine
BIN = SHARE = pathlib.Path()  # set by main


def output_of(*command, **others):
    return subprocess.run(command, check=True, capture_output=True, text=True, timeout=SECONDS, **others).stdout


def options_of(program):
    return sorted(set(re.findall(r"(?:^  |,)(--?[a-z-]+)", output_of(BIN / program, "--help-all"), re.MULTILINE)))


class Folder(unittest.TestCase):
    """Has a folder with a mesh, a tree and a text."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="descriptions_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        for name in ("part.stl", "tree.bsp", "words.doc"):
            (self.folder / name).touch()
        self.environment = {**os.environ, "PATH": f"{BIN}:{os.environ['PATH']}", "HOME": str(self.folder), "TERM": "dumb",
                            "XDG_CONFIG_HOME": str(self.folder / ".config"), "XDG_DATA_HOME": str(self.folder / ".data")}


class Facts(unittest.TestCase):
    def test_files_are_what_the_programs_print(self):
        for program in PROGRAMS:
            for kind, path in (("man", f"man/man1/{program}.1"), ("bash", f"bash-completion/completions/{program}"),
                               ("zsh", f"zsh/site-functions/_{program}"), ("fish", f"fish/vendor_completions.d/{program}.fish")):
                with self.subTest(program=program, kind=kind):
                    self.assertEqual((SHARE / path).read_text(), output_of(BIN / program, "--describe", kind))

    def test_version_as_json(self):
        schema = json.loads((pathlib.Path(__file__).resolve().parents[2] / "docs/report.schema.json").read_text())
        for program in PROGRAMS:
            with self.subTest(program=program):
                for words in (("--version", "--json"), ("--json", "--version")):
                    facts = json.loads(output_of(BIN / program, *words))
                self.assertEqual(f"{program} {facts['version']}\n", output_of(BIN / program, "--version"))
                self.assertEqual(facts["program"], program)
                self.assertEqual(facts["report_version"], schema["properties"]["report_version"]["const"])
                self.assertIn(".stl", facts["formats"]["meshes"])
                self.assertIn(".xyz", facts["formats"]["points"])
                self.assertEqual(facts["formats"]["packed"], [".gz", ".zst", ".zip"])
                self.assertEqual(facts["limits"]["triangles"], (2**32 - 1) // 3)
                for name, version in facts["libraries"].items():
                    self.assertRegex(version, r"^\d+(\.\d+)*", name)

    def test_json_alone_is_told_what_it_is_for(self):
        result = subprocess.run([BIN / "meshrepair", "in.stl", "out.stl", "--json"], capture_output=True, text=True, check=False)
        self.assertEqual((result.returncode, result.stdout), (2, ""))
        self.assertIn("--json requires --version", result.stderr)


@unittest.skipUnless(shutil.which("man"), "man is not installed")
class ManPages(unittest.TestCase):
    def test_pages_render_without_a_warning_and_have_every_option(self):
        environment = {**os.environ, "MANWIDTH": "200", "LC_ALL": "C.UTF-8", "MAN_KEEP_FORMATTING": ""}
        for program in PROGRAMS:
            with self.subTest(program=program):
                page = SHARE / f"man/man1/{program}.1"
                result = subprocess.run(["man", "--warnings", "--local-file", page], capture_output=True, text=True, check=True,
                                        timeout=SECONDS, env=environment)
                self.assertEqual(result.stderr, "")
                text = re.sub(".\b", "", result.stdout)
                for option in options_of(program):
                    self.assertRegex(text, rf"(?m)^\s+(.*, )?{re.escape(option)}(,| |$)")
                for code in (0, 1, 2, 3, 4, 5, 6, 70, 143):
                    self.assertRegex(text, rf"(?m)^\s+{code} ")


@unittest.skipUnless(BASH_COMPLETION.exists(), "bash-completion is not installed")
class Bash(Folder):
    def completed(self, *words):
        """What is offered for the last word."""
        line = " ".join(words).replace(" = ", "=")
        script = f"source {BASH_COMPLETION}; source {SHARE}/bash-completion/completions/{words[0]}; COMP_LINE=$1; shift; " \
                 f"COMP_WORDS=(\"$@\"); COMP_POINT=${{#COMP_LINE}}; COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); " \
                 f"_{words[0]}; printf '%s\\n' \"${{COMPREPLY[@]}}\""
        return output_of("bash", "--norc", "--noprofile", "-c", script, "bash", line, *words, cwd=self.folder,
                         env=self.environment).split()

    def test_every_option_is_offered(self):
        for program in PROGRAMS:
            with self.subTest(program=program):
                self.assertEqual(sorted(self.completed(program, "-")), options_of(program))

    def test_choices_are_offered(self):
        self.assertEqual(self.completed("meshrepair", "--inside", "so"), ["solidity"])
        self.assertEqual(self.completed("meshrepair", "--inside", "=", "so"), ["solidity"])
        self.assertEqual(self.completed("meshrepair", "--sew", ""), ["auto", "none"])
        self.assertEqual(self.completed("meshrepair", "--keep", ""), ["all", "outer", "largest"])
        self.assertEqual(self.completed("meshrepair", "--for", "p"), ["print"])
        self.assertEqual(self.completed("bspbool", "--op", "u"), ["union"])
        self.assertEqual(self.completed("meshrepair", "--drop", "groups,nor"), ["groups,normals"])
        self.assertEqual(self.completed("meshrepair", "--threads", ""), [])

    def test_files_are_offered_by_their_kind(self):
        self.assertEqual(self.completed("meshrepair", ""), ["part.stl"])
        self.assertEqual(self.completed("bspsolid", ""), ["tree.bsp"])
        self.assertEqual(sorted(self.completed("bspbool", "")), ["part.stl", "tree.bsp"])
        self.assertEqual(self.completed("meshrepair", "--report", ""), [])


@unittest.skipUnless(shutil.which("fish"), "fish is not installed")
class Fish(Folder):
    def completed(self, line):
        text = output_of("fish", "--no-config", "-c", f"source {SHARE}/fish/vendor_completions.d/{line.split()[0]}.fish; "
                         "complete -C $argv[1]", line, cwd=self.folder, env=self.environment)
        return [entry.split("\t")[0] for entry in text.splitlines()]

    def test_every_option_is_offered(self):
        for program in PROGRAMS:
            with self.subTest(program=program):
                long_ones = {option for option in options_of(program) if option.startswith("--")}
                self.assertLessEqual(long_ones, set(self.completed(f"{program} --")))

    def test_choices_are_offered(self):
        self.assertEqual(self.completed("meshrepair --inside so"), ["solidity"])
        self.assertEqual(self.completed("meshrepair --inside=so"), ["--inside=solidity"])
        self.assertEqual(sorted(self.completed("meshrepair --keep ")), ["all", "largest", "outer"])
        self.assertIn("groups,normals", self.completed("meshrepair --drop groups,nor"))

    def test_files_are_offered_by_their_kind(self):
        self.assertEqual(self.completed("meshrepair "), ["part.stl"])
        self.assertEqual(self.completed("bspsolid "), ["tree.bsp"])
        self.assertEqual(self.completed("meshrepair --report "), [])


@unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
class Zsh(Folder):
    """Completions act in a terminal alone."""

    def setUp(self):
        super().setUp()
        process, self.terminal = pty.fork()
        if process == 0:
            os.chdir(self.folder)
            os.execvpe("zsh", ["zsh", "-f", "-i"], self.environment)
        self.addCleanup(os.waitpid, process, 0)
        self.addCleanup(os.close, self.terminal)  # hangs up, and comes first
        self.shown = ""
        self.say(f"fpath=({SHARE}/zsh/site-functions $fpath); unsetopt zle_bracketed_paste beep; PS1=; "
                 "autoload -Uz compinit; compinit -u -D; print rea''dy\n", "ready")

    def say(self, text, until):
        """Types it, and waits for what is shown then."""
        self.shown = ""
        os.write(self.terminal, text.encode())
        end = time.monotonic() + SECONDS
        while until not in self.shown:
            if not select.select([self.terminal], [], [], max(0, end - time.monotonic()))[0]:
                self.fail(f"{until!r} is not in {self.shown!r}")
            self.shown += os.read(self.terminal, 4096).decode(errors="replace")

    def completed(self, line, until):
        try:
            self.say(line + "\t", until)
        finally:
            self.say("\x15print do''ne\n", "done")  # forgets the line

    def test_options_choices_and_files_are_completed(self):
        for line, until in (("meshrepair --insi", "--inside="), ("meshrepair --inside so", "solidity"),
                            ("meshrepair --keep la", "largest"), ("meshrepair --inside=wi", "winding"),
                            ("bspbool --op un", "union"), ("meshrepair p", "part.stl"), ("bspsolid t", "tree.bsp"),
                            ("meshrepair --drop groups,nor", "normals"), ("meshrepair --qui", "--quiet")):
            with self.subTest(line=line):
                self.completed(line, until)

    def test_every_function_loads(self):
        for program in PROGRAMS:
            with self.subTest(program=program):
                self.completed(f"{program} --thr", "--threads=")


def main():
    global BIN, SHARE
    if len(sys.argv) < 3 or sys.argv[1].startswith("-"):
        print(__doc__.strip(), file=sys.stdout if sys.argv[1:] == ["--help"] else sys.stderr)
        sys.exit(0 if sys.argv[1:] == ["--help"] else 2)
    BIN, SHARE = (pathlib.Path(os.path.abspath(sys.argv.pop(1))) for _ in range(2))
    unittest.main()


if __name__ == "__main__":
    main()
