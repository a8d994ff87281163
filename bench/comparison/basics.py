# SPDX-License-Identifier: MIT
"""What compare.py, repair_table.py and their parts share: exit codes, how they speak, and files that are there whole or not at all."""

import argparse
import errno
import os
import signal
import subprocess
import sys
import tempfile

NAME = os.path.basename(sys.argv[0])  # of the script that runs
ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
DONE, FAILED, USAGE, OUTPUT = 0, 1, 2, 6


class Stop(Exception):
    """Ends the script with an exit code and one line."""

    def __init__(self, code, message):
        super().__init__(message)
        self.code = code


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise Stop(USAGE, f"{message} (try '{NAME} --help')")


class Interrupted(BaseException):
    """By Ctrl-C, SIGTERM or SIGHUP. No Exception, so that nobody takes it for a failure of his own."""

    def __init__(self, number):
        super().__init__()
        self.code = 128 + number


SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class Held:
    """While a process is being started: what ended the script then would leave it running."""

    is_on = False
    number = None  # of the signal that came meanwhile

    @classmethod
    def release(cls):
        """Called where the process is ended with the script."""
        cls.is_on = False
        if cls.number is not None:
            raise Interrupted(cls.number)


def stop_on_signals():
    """The first signal ends the script by way of all `with` and `finally`; later ones do not keep these from cleaning up."""
    def stop(number, _):
        for each in SIGNALS:
            signal.signal(each, signal.SIG_IGN)
        if Held.is_on:
            Held.number = number
        else:
            raise Interrupted(number)
    for each in SIGNALS:
        signal.signal(each, stop)


def say(line):
    print(f"{NAME}: {line}", file=sys.stderr, flush=True)


def exit_code_of(work, when_interrupted):
    """Of what main() does; what stops it is said in one line."""
    stop_on_signals()
    try:
        return work()
    except Stop as stop:
        say(str(stop))
        return stop.code
    except Interrupted as interrupted:
        say(f"interrupted; {when_interrupted}")
        return interrupted.code


def seconds(number):
    return f"{number:.3f}" if number < 1 else f"{number:.2f}"


def check_writable(path):
    """Before hours of measuring, not after them."""
    try:
        if os.path.isdir(path):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        with tempfile.TemporaryFile(dir=os.path.dirname(os.path.abspath(path))):
            pass
    except OSError as error:
        raise Stop(OUTPUT, f"{path}: cannot be written: {error.strerror}") from None


def write_whole(path, text):
    """The file is the old one or the new one at each moment."""
    folder = os.path.dirname(os.path.abspath(path))
    mode = os.stat(path).st_mode & 0o777 if os.path.exists(path) else 0o644
    temporary = None
    try:
        with tempfile.NamedTemporaryFile("w", dir=folder, prefix=".compare_", delete=False, encoding="utf-8", newline="") as file:
            temporary = file.name
            file.write(text)
        os.chmod(temporary, mode)
        os.replace(temporary, path)
        temporary = None
    except OSError as error:
        raise Stop(OUTPUT, f"{path}: cannot be written: {error.strerror}") from None
    finally:
        if temporary:
            os.unlink(temporary)


def machine():
    """The kind of processor and their number. No name: machines of the same kind are as good."""
    name = os.uname().machine
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        for line in file:
            if line.startswith("model name"):
                name = line.split(":", 1)[1].strip()
                break
    return f"{name} x {os.cpu_count()}"


def commit():
    """That of the sources beside this script; with a + where files were changed since."""
    def git(*words):
        return subprocess.run(["git", "-C", ROOT, *words], capture_output=True, text=True, check=False).stdout.strip()
    name = git("rev-parse", "--short=7", "HEAD") or "unknown"
    return name + ("+" if git("status", "--porcelain", "--untracked-files=no", "--", ".", ":!bench/history.csv") else "")
