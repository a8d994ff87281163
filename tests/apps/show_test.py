#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""--show: pictures in terminals that can draw them, which are asked, and a bar in others.

Usage: show_test.py PROGRAMS
"""

import fcntl
import os
import pathlib
import pty
import resource
import select
import signal
import subprocess
import sys
import tempfile
import termios
import time
import unittest

MESHES = pathlib.Path(__file__).resolve().parents[2] / "samples/meshes"
PROGRAMS = pathlib.Path()  # set by main()
QUESTION = b"\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\\x1b[c"
KITTY, SIXEL = b"\x1b_Ga=T,f=100", b"\x1bP0;1;0q"
SECONDS = 120


class Terminal:
    """Runs a program in a terminal that answers the question so; None: it says nothing. The program gets the signals
    when it has asked."""

    def __init__(self, answer, *command, after=0.0, signals=()):
        self.master, self.slave = pty.openpty()
        before = termios.tcgetattr(self.slave)
        process = subprocess.Popen(command, stdin=self.slave, stdout=self.slave, stderr=self.slave, close_fds=True,
                                   env={**os.environ, "TERM": "xterm-256color"}, start_new_session=True,
                                   preexec_fn=self.prepare)
        self.said, self.asked = b"", False
        deadline = time.monotonic() + SECONDS
        while process.poll() is None and time.monotonic() < deadline:
            self.listen(0.05)
            if QUESTION in self.said and not self.asked:
                self.asked = True
                time.sleep(after)
                if answer is not None:
                    os.write(self.master, answer)
                for number in signals:
                    process.send_signal(number)
        self.code = process.wait(SECONDS)
        while self.listen(0.05):
            pass
        self.is_as_before = termios.tcgetattr(self.slave) == before
        os.close(self.slave)
        os.close(self.master)

    @staticmethod
    def prepare():
        fcntl.ioctl(0, termios.TIOCSCTTY, 0)
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    def listen(self, seconds):
        if not select.select([self.master], [], [], seconds)[0]:
            return False
        some = os.read(self.master, 65536)
        self.said += some
        return bool(some)


class Show(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = pathlib.Path(folder.name) / "out.obj"

    def command(self, *options):
        return [PROGRAMS / "meshrepair", MESHES / "broken_torus_box.stl", self.out, *options]

    def shown(self, answer, *options, **others):
        terminal = Terminal(answer, *self.command(*options), **others)
        self.assertEqual(terminal.code, 0, terminal.said)
        self.assertTrue(terminal.is_as_before)
        return terminal

    def test_a_terminal_with_kittys_pictures(self):
        said = self.shown(b"\x1b_Gi=31;OK\x1b\\\x1b[?62;4c", "--show").said
        self.assertIn(KITTY, said)
        self.assertNotIn(SIXEL, said)
        self.assertNotIn(b"changed ", said)
        self.assertLess(said.index(b"checked "), said.index(KITTY))

    def test_a_terminal_with_sixels(self):
        for answer in (b"\x1b[?62;4c", b"\x1b[?4;6;22c", b"typed\x1b[?65;1;4c"):
            said = self.shown(answer, "--show").said
            self.assertIn(SIXEL, said)
            self.assertNotIn(KITTY, said)

    def test_a_terminal_without_pictures(self):
        for answer in (b"\x1b[?62;44;14c", b"\x1b[?1;2c", None):
            said = self.shown(answer, "--show").said
            self.assertNotIn(SIXEL, said)
            self.assertNotIn(KITTY, said)
            self.assertIn(b"changed   [====", said)

    def test_a_slow_terminal(self):
        self.assertIn(SIXEL, self.shown(b"\x1b[?62;4c", "--show", after=0.4).said)

    def test_what_ends_the_program_meanwhile_leaves_the_terminal_as_it_was(self):
        # Twice: the second signal ends a program at once. The keys are those of the terminal, for SIGINT and SIGQUIT.
        for signals in ([signal.SIGTERM], [signal.SIGHUP], 2 * [signal.SIGINT], 2 * [signal.SIGTERM], [signal.SIGQUIT]):
            for command in (self.command("--show"), [PROGRAMS / "meshcheck", MESHES / "cube.stl", "--show"]):
                terminal = Terminal(None, *command, signals=signals)
                self.assertTrue(terminal.is_as_before, (signals, command, terminal.said))
                self.assertIn(terminal.code, (128 + signals[0], -signals[0]), terminal.said)
        for key, code in ((b"\x03", 130), (b"\x1c", -signal.SIGQUIT)):
            terminal = Terminal(key, *self.command("--show"))
            self.assertTrue(terminal.is_as_before, key)
            self.assertEqual(terminal.code, code, terminal.said)

    def test_nobody_is_asked_unasked(self):
        self.assertFalse(self.shown(b"\x1b[?62;4c").asked)
        self.assertFalse(self.shown(b"\x1b[?62;4c", "--show", "-q").asked)
        terminal = self.shown(None, "--show-as", "sixel")
        self.assertFalse(terminal.asked)
        self.assertIn(SIXEL, terminal.said)
        self.assertIn(b"changed ", self.shown(b"\x1b[?62;4c", "--show", "--show-as", "none").said)

    def test_no_terminal(self):
        result = subprocess.run(self.command("--show"), capture_output=True, check=True)
        self.assertIn(b"\nchanged   [====", result.stderr)
        self.assertNotIn(b"\x1b", result.stderr)
        self.assertEqual(result.stdout, b"")
        result = subprocess.run(self.command("--show-as", "kitty"), capture_output=True, check=True)
        self.assertIn(KITTY, result.stderr)

    def test_the_mesh_is_the_same(self):
        subprocess.run(self.command("-q"), check=True)
        plain = self.out.read_bytes()
        subprocess.run(self.command("--show-as", "sixel", "--picture-colours", "fates"), check=True, capture_output=True)
        self.assertEqual(self.out.read_bytes(), plain)

    def test_other_programs(self):
        mesh = MESHES / "cube.stl"
        for command in (("meshcheck", mesh), ("meshconvert", mesh, self.out), ("bspbool", mesh, mesh, "--op", "union", "-o", self.out)):
            result = subprocess.run([PROGRAMS / command[0], *command[1:], "--show-as", "sixel"], capture_output=True, check=True)
            self.assertIn(SIXEL, result.stderr, command)


if __name__ == "__main__":
    PROGRAMS = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
