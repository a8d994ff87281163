# SPDX-License-Identifier: MIT
"""What the tests of scripts/repair_folder.py share: folders, meshes, and a false meshrepair that fails in all manners."""

import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

import kill_folder

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = ROOT / "scripts" / "repair_folder.py"
SAMPLES = ROOT / "samples" / "meshes"
SECONDS = 300  # for what takes one on an idle machine; what hangs, hangs for longer

CUBE = (SAMPLES / "cube.stl").read_bytes()
TETRAHEDRON = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
FLAT = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"

# Does what the first letters of its input's name say; tells FAKE_LOG how it was called.
FALSE_MESHREPAIR = """#!{python} -SE
import json, os, signal, sys, time
arguments = sys.argv[1:]

def run_jobs(of_all):
    # As meshrepair --jobs-from does.
    import ctypes, subprocess, tempfile, threading
    running, lock = {{}}, threading.Lock()

    def work(job):
        with tempfile.TemporaryDirectory() as folder, open(os.path.join(folder, "said"), "w+b") as said:
            report = os.path.join(folder, "report")
            try:
                process = subprocess.Popen([sys.argv[0], *of_all, *job["options"], "--report", report, "--", job["in"], job["out"]], stdout=said,
                                           stderr=said, stdin=subprocess.DEVNULL, preexec_fn=lambda: ctypes.CDLL(None).prctl(1, signal.SIGKILL))
                running[job["id"]] = process
                code = process.wait()
            except OSError:
                code = 70
            answer = {{"id": job["id"], "exit_code": code if code >= 0 else 128 - code, "signal": -code if code < 0 else None, "error": None,
                       "peak_memory_bytes": 1 << 20, "report": None}}
            said.seek(0)
            answer["stderr"] = said.read()[-65536:].decode()
            try:
                with open(report) as file:
                    answer["report"] = json.load(file)
            except (OSError, ValueError):
                pass
        with lock:
            os.write(1, json.dumps(answer).encode() + b"\\n")

    def cancel(process, grace):
        process.terminate()
        time.sleep(grace)
        process.kill()

    threads = []
    for line in sys.stdin:
        line = json.loads(line)
        if "cancel" in line:
            threading.Thread(target=cancel, args=(running[line["cancel"]], line["grace"]), daemon=True).start()
        else:
            threads.append(threading.Thread(target=work, args=(line,)))
            threads[-1].start()
    for thread in threads:
        thread.join()
    sys.exit(0)

if arguments[0] == "--jobs-from":
    run_jobs(arguments[4:])
if arguments == ["--version"] and "KILLED" in os.environ:
    os.kill(os.getpid(), signal.SIGKILL)
if arguments == ["--version"]:
    sys.exit(print("meshrepair 9.9.9"))
if "--bogus" in arguments:
    print("meshrepair: --bogus is unknown", file=sys.stderr)
    sys.exit(2)
source, target = arguments[-2:]
if "--staging" not in arguments:
    sys.exit(3)
target = os.path.join(arguments[arguments.index("--staging") + 1], os.path.basename(target))
with open(os.environ["FAKE_LOG"], "a") as log:
    log.write(json.dumps(arguments) + "\\n")

def write(path, data):
    with open(path, "w") as file:
        file.write(data)

def end(code, error=None, verdict="PASS", mesh="whole mesh"):
    names = ("closed", "manifold", "oriented", "no_self_intersections", "no_degenerate_triangles")
    report = {{"exit_code": code, "error": error, "certificate": dict.fromkeys(names, verdict)}}
    write(arguments[arguments.index("--report") + 1], json.dumps(report))
    if mesh:
        write(target, mesh)
    sys.exit(code)

def hang():
    time.sleep(3600)

action = os.path.basename(source).partition(".")[0].rstrip("0123456789")
if action == "good":
    end(0)
elif action == "slow":
    while not os.path.exists(os.environ["FAKE_LOG"] + ".go"):
        time.sleep(0.01)
    end(0)
elif action == "code":
    code = int(open(source).read())
    end(code, source + ": so it is", "FAIL", "doubtful mesh" if code == 1 else "")
elif action == "hang":
    hang()
elif action == "deaf":
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    hang()
elif action == "half":
    write(target, "half a me")
    os.kill(os.getpid(), signal.SIGKILL)
elif action == "once":
    if not os.path.exists(source + ".tried"):
        write(source + ".tried", "")
        os.kill(os.getpid(), signal.SIGKILL)
    end(0)
elif action == "crash":
    os.kill(os.getpid(), signal.SIGSEGV)
elif action == "garbage":
    write(arguments[arguments.index("--report") + 1], "{{no json")
    write(target, "garbage")
elif action == "unproven":
    end(0, None, "FAIL")
elif action == "noisy":
    for i in range(300):
        os.write(2, b"x" * 65536)
    os.write(2, b"\\nmeshrepair: enough\\n")
    sys.exit(70)
elif action == "orphan" and os.fork() == 0:
    hang()  # and holds the pipe
elif action == "orphan":
    end(0)
"""


def write_files(folder, files):
    for name, data in files.items():
        path = os.path.join(os.fsencode(folder), os.fsencode(name))
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "wb") as file:
            file.write(data)


def names_in(folder):
    return {os.fsdecode(name) for name in kill_folder.outputs_in(folder)}


class FolderTest(unittest.TestCase):
    """Has an input folder, an output folder and a false meshrepair."""

    meshrepair = ""  # the true one; set by main()

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="repair_folder_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.source, self.out = self.folder / "in", self.folder / "out"
        self.source.mkdir()
        self.log = self.folder / "log"
        self.false = self.folder / "false_meshrepair"
        self.false.write_text(FALSE_MESHREPAIR.format(python=sys.executable))
        self.false.chmod(0o755)
        self.environment = {**os.environ, "FAKE_LOG": str(self.log)}

    def command(self, *options, program=None, source=None, out=None):
        end = options.index("--") if "--" in options else len(options)
        return [sys.executable, SCRIPT, "--meshrepair", program or self.false, *options[:end],
                source or self.source, out or self.out, *options[end:]]

    def start(self, *options, **others):
        return subprocess.Popen(self.command(*options, **others), env=self.environment, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def run_script(self, *options, code=0, before=None, **others):
        result = subprocess.run(self.command(*options, **others), env=self.environment, text=True,
                                check=False, capture_output=True, timeout=SECONDS, preexec_fn=before)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertNotIn("Traceback", result.stderr)
        return result

    def wait_for_calls(self, number, process):
        """Until the false program was called so often."""
        while not self.log.exists() or len(self.log.read_text().splitlines()) < number:
            self.assertIsNone(process.poll(), "the script has ended")
            time.sleep(0.01)

    def let_slow_ones_end(self):
        pathlib.Path(f"{self.log}.go").touch()

    def rows(self):
        with open(self.out / "summary.csv", encoding="utf-8", newline="") as file:
            return {row["path"]: row for row in csv.DictReader(file)}

    def codes(self):
        return {path: int(row["exit_code"]) for path, row in self.rows().items()}

    def calls(self):
        """Names of the inputs that the false program got since the last call of this."""
        if not self.log.exists():
            return []
        lines = self.log.read_text().splitlines()
        self.log.unlink()
        return sorted(os.path.basename(json.loads(line)[-2]) for line in lines)


def main(usage):
    """Of a script whose first argument is the program meshrepair; the others are those of unittest."""
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        print(usage.strip(), file=sys.stdout if sys.argv[1:] == ["--help"] else sys.stderr)
        sys.exit(0 if sys.argv[1:] == ["--help"] else 2)
    FolderTest.meshrepair = os.path.abspath(sys.argv.pop(1))
    unittest.main()
