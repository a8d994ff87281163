#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs a program in a folder of its own and compares what it did with what was expected.

Called by the CMake function cli_test (cmake/CliTest.cmake), which says what the options mean. Each report that
the program writes is held against docs/report.schema.json.
"""

import argparse
import json
import os
import pty
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

import report_schema

TIMEOUT_SECONDS = 540  # less than that of CTest; only what hangs takes so long
MOST_CPU_SECONDS = 2  # of a program that is waited for to fall asleep
SKIPPED = 77  # told to CTest by cli_test


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--exit", type=int, default=0)
    parser.add_argument("--stdin", default="")
    parser.add_argument("--stdin-file")
    parser.add_argument("--signal-after")
    parser.add_argument("--file-size-limit", type=int)
    parser.add_argument("--signal")
    for repeated in ("--copy", "--stdout", "--stderr", "--exists", "--missing", "--unchanged",
                     "--json"):
        parser.add_argument(repeated, action="append", default=[])
    parser.add_argument("--run-in-terminal", action="store_true")
    parser.add_argument("--closed-stdout", action="store_true")
    parser.add_argument("--unread-stdout", action="store_true")
    parser.add_argument("command", nargs="+")
    return parser.parse_args()


def read_all(descriptor, chunks):
    while True:
        try:
            chunk = os.read(descriptor, 65536)
        except OSError:  # a terminal says so when its other end is closed
            chunk = b""
        if not chunk:
            return
        chunks.append(chunk)


def wait_until_asleep(process):
    """Until the program waits for something (input, a timer), has ended, or works without a pause."""
    while True:
        try:
            with open(f"/proc/{process.pid}/stat", encoding="utf-8") as file:
                fields = file.read().rsplit(")", 1)[1].split()
        except OSError:
            return
        worked = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
        if fields[0] in "SZ" or worked > MOST_CPU_SECONDS:
            return
        time.sleep(0.01)


def wait_until_printed(chunks, pattern):
    deadline = time.monotonic() + TIMEOUT_SECONDS / 2
    while time.monotonic() < deadline:
        if re.search(pattern, b"".join(chunks).decode("utf-8", "replace")):
            return
        time.sleep(0.005)


def limit_file_size(size):
    """What the program does before it becomes itself; None: nothing."""
    if size is None:
        return None
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


def run(options, folder):
    """Exit code, stdout and stderr (bytes) of the program."""
    stdin = options.stdin.encode()
    if options.stdin_file:
        with open(options.stdin_file, "rb") as file:
            stdin = file.read()

    err_read, err_write = pty.openpty() if options.run_in_terminal else os.pipe()
    out_read, out_write = os.pipe()
    if options.closed_stdout:
        os.close(out_read)
    process = subprocess.Popen(options.command, cwd=folder, stdin=subprocess.PIPE,
                               stdout=out_write, stderr=err_write,
                               preexec_fn=limit_file_size(options.file_size_limit))
    os.close(out_write)
    os.close(err_write)

    out, err = [], []
    readers = [threading.Thread(target=read_all, args=(err_read, err))]
    if not options.closed_stdout and not options.unread_stdout:
        if options.signal and not options.signal_after:
            out.append(os.read(out_read, 65536))
        readers.append(threading.Thread(target=read_all, args=(out_read, out)))
    for reader in readers:
        reader.start()
    if options.signal_after:
        wait_until_printed(err, options.signal_after)
    if options.signal:
        wait_until_asleep(process)
        process.send_signal(signal.Signals["SIG" + options.signal])
    try:
        if options.signal:  # stdin stays open: its end would wake the program up, too
            process.wait(TIMEOUT_SECONDS)
        process.communicate(stdin, timeout=TIMEOUT_SECONDS)
    except BrokenPipeError:
        process.wait(TIMEOUT_SECONDS)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
    for reader in readers:
        reader.join()
    if options.unread_stdout:
        os.close(out_read)
    return process.returncode, b"".join(out), b"".join(err)


def copies(options):
    """Name in the folder and source of each file that is there from the start."""
    for copy in options.copy:
        yield copy.split("=", 1)


def same_bytes(a, b):
    with open(a, "rb") as first, open(b, "rb") as second:
        return first.read() == second.read()


def json_value(text, keys):
    value = json.loads(text)
    for key in keys.split("."):
        value = value[int(key)] if isinstance(value, list) else value[key]
    return value


def check_json(check, folder, stdout):
    name, rest = check.split(":", 1)
    keys, expected = rest.split("=", 1)
    if name == "-":
        text = stdout
    else:
        with open(os.path.join(folder, name), "rb") as file:
            text = file.read()
    value = json_value(text, keys)
    if value != json.loads(expected):
        return f"{name}: {keys} is {value!r}, not {expected}"
    return None


def report_files(command):
    """What the command line names as files for reports; "-" is stdout."""
    for word, following in zip(command, command[1:] + [""]):
        if word == "--json":
            yield "-"
        elif word == "--report":
            yield following
        elif word.startswith("--report="):
            yield word.removeprefix("--report=")


def report_complaints(options, folder, stdout):
    """What is wrong with the reports that were written."""
    given = {os.path.join(folder, name) for name, _ in copies(options)}
    for name in report_files(options.command):
        path = os.path.normpath(os.path.join(folder, name))
        if name == "-" and stdout.startswith(b"{"):
            text = stdout
        elif os.path.isfile(path) and path not in given:
            with open(path, "rb") as file:
                text = file.read()
        else:
            continue
        for complaint in report_schema.complaints(text):
            yield f"report {name}: {complaint}"


def complaints(options, folder, code, stdout, stderr):
    if code != options.exit:
        yield f"exit code {code}, not {options.exit}"
    for stream, text, patterns in (("stdout", stdout, options.stdout),
                                   ("stderr", stderr, options.stderr)):
        for pattern in patterns:
            if not re.search(pattern, text.decode("utf-8", "replace")):
                yield f"{stream} does not match {pattern!r}"
    for name in options.exists:
        if not os.path.exists(os.path.join(folder, name)):
            yield f"{name} was not written"
    for name in options.missing:
        if os.path.exists(os.path.join(folder, name)):
            yield f"{name} was written"
    for name in os.listdir(folder):
        if name.endswith(".tmp"):
            yield f"{name} was left behind"
    for name, source in copies(options):
        if name in options.unchanged and not same_bytes(os.path.join(folder, name), source):
            yield f"{name} was changed"
    for check in options.json:
        try:
            complaint = check_json(check, folder, stdout)
        except (OSError, ValueError, KeyError, IndexError) as error:
            complaint = f"{check}: {error!r}"
        if complaint:
            yield complaint
    yield from report_complaints(options, folder, stdout)


def main():
    options = parse_arguments()
    with tempfile.TemporaryDirectory(prefix="cli_test_") as folder:
        for name, source in copies(options):
            shutil.copyfile(source, os.path.join(folder, name))
        try:
            code, stdout, stderr = run(options, folder)
        except OSError as error:
            if options.run_in_terminal and "pty" in str(error):
                print("skipped: no terminals here:", error)
                return SKIPPED
            raise
        found = list(complaints(options, folder, code, stdout, stderr))
        if not found:
            return 0
        for complaint in found:
            print(complaint)
        print("files:", *sorted(os.listdir(folder)))
        print(f"--- stdout\n{stdout.decode('utf-8', 'replace')}")
        print(f"--- stderr\n{stderr.decode('utf-8', 'replace')}")
        return 1


if __name__ == "__main__":
    sys.exit(main())
