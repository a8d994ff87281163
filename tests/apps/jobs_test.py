#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""meshrepair --jobs-from: many jobs of one start, and what becomes of the others if one fails.

Usage: jobs_test.py MESHREPAIR [OPTIONS OF UNITTEST]
"""

import base64
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

MESHES = pathlib.Path(__file__).resolve().parents[2] / "samples/meshes"
SECONDS = 120
PLAIN = os.environ.get("MESHREPAIR_PLAIN_POSIX") == "1"
MEASURED = ("command", "stages", "seconds", "peak_memory_bytes")


def needs_list_of_processes():
    if not os.path.exists("/proc/self/stat"):
        raise unittest.SkipTest("the system does not list its processes in /proc")


def children_of(pid):
    """Processes, also those that have ended and that nobody has waited for."""
    needs_list_of_processes()
    found = []
    for entry in os.listdir("/proc"):
        try:
            with open(f"/proc/{entry}/stat", encoding="ascii", errors="replace") as file:
                if int(file.read().rsplit(")", 1)[1].split()[1]) == pid:
                    found.append(int(entry))
        except (OSError, ValueError, IndexError):
            pass
    return found


class Jobs(unittest.TestCase):
    meshrepair = ""

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="jobs_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        os.mkfifo(self.folder / "never.stl")  # a job that reads it waits

    def start(self, *options, file="-", **others):
        worker = subprocess.Popen([self.meshrepair, "--jobs-from", file, *options], cwd=self.folder, stdin=subprocess.PIPE,
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, **others)
        self.addCleanup(self.end, worker)
        return worker

    @staticmethod
    def end(worker):
        worker.kill()
        worker.wait()
        for stream in (worker.stdin, worker.stdout, worker.stderr):
            stream.close()

    @staticmethod
    def tell(worker, *lines):
        for line in lines:
            worker.stdin.write((line if isinstance(line, bytes) else json.dumps(line).encode()) + b"\n")
        worker.stdin.flush()

    def answers(self, *lines, options=(), code=0):
        """By id, once the input has ended."""
        worker = self.start(*options)
        data = b"\n".join(line if isinstance(line, bytes) else json.dumps(line).encode() for line in lines)
        said, errors = worker.communicate(data, timeout=SECONDS)
        self.assertEqual((worker.returncode, errors), (code, b""))
        return [json.loads(line) for line in said.splitlines()]

    def of(self, answers):
        self.assertEqual(len({json.dumps(answer["id"]) for answer in answers}), len(answers))
        return {json.dumps(answer["id"]): answer for answer in answers}

    def wait_for_children(self, worker, count):
        deadline = time.monotonic() + SECONDS
        while len(found := children_of(worker.pid)) != count:
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        return found

    def waiting(self, number, **others):
        return {"id": number, "in": "never.stl", "out": f"{number}.stl", **others}

    def good(self, number, **others):
        return {"id": number, "in": str(MESHES / "cube.stl"), "out": f"{number}.stl", **others}

    def test_is_the_same_as_a_program_of_its_own(self):
        (self.folder / "torn.stl").write_bytes((MESHES / "cube.stl").read_bytes()[:90])
        cases = [("broken_torus_box.stl", []), ("open_bowl.ply", ["--for", "print"]), ("broken_spheres.obj", ["--quiet"]),
                 ("open_bowl.ply", ["--holes", "leave"]), (self.folder / "torn.stl", []), ("none.stl", []), ("cube.stl", ["--bogus"])]
        jobs = [{"id": i, "in": str(MESHES / name), "out": f"{i}.ply", "options": options} for i, (name, options) in enumerate(cases)]
        answers = self.of(self.answers(*jobs, options=("--jobs", "3")))
        for i, (name, options) in enumerate(cases):
            alone = subprocess.run([self.meshrepair, *options, "--report", "r.json", "--threads", "1", MESHES / name, "alone.ply"],
                                   cwd=self.folder, capture_output=True, check=False)
            answer = answers[str(i)]
            self.assertEqual((answer["exit_code"], answer["signal"]), (alone.returncode, None), name)
            self.assertEqual(answer["stderr"].split(", in ")[0], alone.stderr.decode().replace("alone.ply", f"{i}.ply").split(", in ")[0])
            expected = json.loads((self.folder / "r.json").read_text().replace("alone.ply", f"{i}.ply"))
            self.assertEqual(answer["error"], expected["error"])
            for key in MEASURED:
                del expected[key], answer["report"][key]
            self.assertEqual(answer["report"], expected)
            if (self.folder / "alone.ply").exists():
                self.assertEqual((self.folder / f"{i}.ply").read_bytes(), (self.folder / "alone.ply").read_bytes())
                (self.folder / "alone.ply").unlink()

    def test_wrong_lines_get_an_answer_each(self):
        good = self.good(1)
        wrong = [b"nonsense", b"[]", b"7", b'{"id": 1', b"\xff", b"[" * 100000, b'{"id":' + b"[" * 2000 + b"]" * 2000 + b"}", b"x" * 3000000,
                 {"in": "a.stl", "out": "b.stl"}, {"id": 2, "out": "b.stl"}, {**good, "in": 7}, {**good, "in": None}, {**good, "in": "-"},
                 {**good, "out": "-"}, {**good, "in": "a\0b.stl"}, {**good, "options": "--for"}, {**good, "options": [1]},
                 {**good, "option": []}, {**good, "in": {"base64": "?"}}, {**good, "in": {"base64": "YQ==", "x": 1}}, {"cancel": 1, "id": 2},
                 {"cancel": 1, "grace": -1}, {"cancel": 1, "grace": "x"}]
        answers = self.answers(*wrong, b"", b"  ", {"cancel": "nobody"}, {**good, "id": "last"})
        self.assertEqual([answer["exit_code"] for answer in answers], [2] * len(wrong) + [0])
        for answer in answers[:-1]:
            self.assertTrue(answer["error"])
            self.assertEqual((answer["report"], answer["stderr"]), (None, ""))
        self.assertEqual(answers[-1]["id"], "last")
        self.assertEqual(sorted(os.listdir(self.folder)), ["1.stl", "never.stl"])

    def test_names_are_bytes(self):
        name = b"\xff\xfe -x.stl"
        (self.folder / os.fsdecode(name)).write_bytes((MESHES / "cube.stl").read_bytes())
        encoded = {"base64": base64.b64encode(name).decode()}
        answers = self.answers({"id": {"a": [1, "\u00fc"]}, "in": encoded, "out": "-out.stl"})
        self.assertEqual((answers[0]["id"], answers[0]["exit_code"]), ({"a": [1, "\u00fc"]}, 0))
        self.assertTrue((self.folder / "-out.stl").exists())

    def test_a_killed_job_costs_no_other(self):
        worker = self.start("--jobs", "2", "-q")
        for number in range(10):
            self.tell(worker, self.waiting(number), self.good(100 + number))
            self.assertEqual(json.loads(worker.stdout.readline())["id"], 100 + number)
            os.kill(self.wait_for_children(worker, 1)[0], signal.SIGKILL)
            answer = json.loads(worker.stdout.readline())
            self.assertEqual((answer["id"], answer["exit_code"], answer["signal"], answer["error"], answer["report"]),
                             (number, 137, 9, "killed by signal 9", None))
        worker.stdin.close()
        self.assertEqual(worker.wait(SECONDS), 0)

    def test_a_job_is_cancelled(self):
        worker = self.start("--jobs", "1")
        self.tell(worker, self.waiting(1), self.waiting(2), self.good(3), {"cancel": 2}, {"cancel": 1})
        answers = [json.loads(worker.stdout.readline()) for _ in range(3)]
        self.assertEqual([(answer["id"], answer["exit_code"]) for answer in answers], [(2, 143), (1, 143), (3, 0)])
        self.tell(worker, self.waiting(4))
        child = self.wait_for_children(worker, 1)[0]
        os.kill(child, signal.SIGSTOP)  # it does not end by itself
        self.tell(worker, {"cancel": 4, "grace": 0.05})
        self.assertEqual(json.loads(worker.stdout.readline())["signal"], 9)

    def test_limits_are_those_of_a_job(self):
        answers = self.of(self.answers(self.waiting(1, options=["--time-limit", "0.1"]), self.good(2, options=["--max-triangles", "3"]),
                                       self.good(3, options=["--max-memory", "1K"]), self.good(4), options=("--jobs", "1")))
        self.assertEqual([answers[i]["exit_code"] for i in "1234"], [4, 4, 2, 0])
        self.assertIn("time limit", answers["1"]["error"])

    def test_waits_for_whoever_reads(self):
        needs_list_of_processes()
        reader, writer = os.pipe()
        with open(self.folder / "jobs", "wb") as file:
            for number in range(3000):  # whose answers are more than it keeps
                file.write(json.dumps(self.good(number, options=["--for", "x" * 1000])).encode() + b"\n")
        worker = subprocess.Popen([self.meshrepair, "--jobs-from", "jobs"], cwd=self.folder, stdout=writer)
        os.close(writer)
        def seconds():
            with open(f"/proc/{worker.pid}/stat", encoding="ascii") as file:
                fields = file.read().rsplit(")", 1)[1].split()
            return sum(map(int, fields[11:15])), fields[0]
        deadline, last = time.monotonic() + SECONDS, None
        while not (last is not None and last == seconds() and last[1] == "S"):  # until it does nothing
            self.assertLess(time.monotonic(), deadline)
            last = seconds()
            time.sleep(0.3)
        self.assertEqual(children_of(worker.pid), [])
        with open(reader, "rb") as file:
            ids = sorted(json.loads(line)["id"] for line in file)
        self.assertEqual((worker.wait(SECONDS), ids), (0, list(range(3000))))

    def test_ends_when_nobody_reads(self):
        worker = self.start("--jobs", "2")
        self.tell(worker, self.waiting(1), self.good(2))
        worker.stdout.readline()
        children = self.wait_for_children(worker, 1)
        worker.stdout.close()
        self.assertEqual(worker.wait(SECONDS), 6)
        self.assertFalse(os.path.exists(f"/proc/{children[0]}"))

    def test_a_signal_ends_all_jobs(self):
        for number, code in ((signal.SIGTERM, 143), (signal.SIGINT, 130)):
            worker = self.start("--jobs", "1")
            self.tell(worker, self.waiting(1), self.waiting(2))
            self.wait_for_children(worker, 1)
            worker.send_signal(number)
            said, _ = worker.communicate(timeout=SECONDS)
            answers = self.of([json.loads(line) for line in said.splitlines()])
            self.assertEqual((worker.returncode, answers["1"]["exit_code"], answers["2"]["exit_code"]), (code, 143, code))

    @unittest.skipIf(PLAIN, "only Linux ends them")
    def test_jobs_die_with_the_worker(self):
        worker = self.start("--jobs", "2")
        self.tell(worker, self.waiting(1), self.waiting(2))
        children = self.wait_for_children(worker, 2)
        worker.kill()
        worker.wait()
        deadline = time.monotonic() + SECONDS
        while any(os.path.exists(f"/proc/{child}/exe") for child in children):
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.01)
        self.assertEqual(os.listdir(self.folder), ["never.stl"])

    def test_command_line(self):
        def run(*words):
            return subprocess.run([self.meshrepair, *words], capture_output=True, check=False, stdin=subprocess.DEVNULL)
        self.assertIn(b"cancel", run("--jobs-from", "--help").stdout)
        self.assertIn(b"cancel", run("--jobs-from", "-", "--help").stdout)
        for words, code, what in ((("--jobs-from",), 2, b"--jobs-from"), (("--jobs-from", "-", "--jobs", "x"), 2, b"--jobs"),
                                  (("--jobs-from", "/none/there"), 3, b"cannot be opened"), (("--jobs-from=-",), 0, b""),
                                  (("--jobs-from", "-"), 0, b""), (("a.stl", "b.stl", "--jobs-from", "-"), 2, b"must be the first argument")):
            result = run(*words)
            self.assertEqual((result.returncode, result.stdout), (code, b""), words)
            self.assertIn(what, result.stderr)


if __name__ == "__main__":
    Jobs.meshrepair = os.path.abspath(sys.argv[1])
    unittest.main(argv=[sys.argv[0], *sys.argv[2:]])
