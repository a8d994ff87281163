# SPDX-License-Identifier: MIT
"""What the tests of meshrepair --serve have in common: a server, requests to it, and meshes."""

import http.client
import json
import math
import os
import pathlib
import socket
import struct
import subprocess
import tempfile
import time
import unittest

MESHES = pathlib.Path(__file__).resolve().parents[2] / "samples/meshes"
CUBE = (MESHES / "cube.stl").read_bytes()
BROKEN = (MESHES / "broken_torus_box.stl").read_bytes()
SECONDS = 120
LIMIT = 1 << 20  # bytes of an upload


def ring(around, across):
    """A torus of 2 around across triangles, as STL."""
    def point(i, j):
        a, b = 2 * math.pi * (i % around) / around, 2 * math.pi * (j % across) / across
        return (3 + math.cos(b)) * math.cos(a), (3 + math.cos(b)) * math.sin(a), math.sin(b)

    corners = [(point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)) for i in range(around) for j in range(across)]
    faces = [face for a, b, c, d in corners for face in ((a, b, c), (a, c, d))]
    return bytes(80) + struct.pack("<I", len(faces)) + b"".join(struct.pack("<12fH", 0, 0, 0, *a, *b, *c, 0) for a, b, c in faces)


def balls():
    """Many balls that overlap, as OBJ: there is much to cut."""
    ball = (MESHES / "broken_spheres.obj").read_text().splitlines()
    points = [tuple(map(float, line.split()[1:4])) for line in ball if line.startswith("v ")]
    faces = [[int(word.split("/")[0]) for word in line.split()[1:4]] for line in ball if line.startswith("f ")]
    lines = [f"v {x + 0.37 * i} {y + 0.11 * i} {z}" for i in range(12) for x, y, z in points]
    lines += [f"f {a + i * len(points)} {b + i * len(points)} {c + i * len(points)}" for i in range(12) for a, b, c in faces]
    return "\n".join(lines).encode()


class Serving(unittest.TestCase):
    programs = pathlib.Path()  # the folder of them
    options = ("--max-upload", str(LIMIT))

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="serve_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.start(self.folder)
        self.addCleanup(self.end)

    def start(self, folder, *before):
        """Another server than the one before."""
        self.server = subprocess.Popen([*before, self.programs / "meshrepair", "--serve", "--no-browser", *self.options], stdout=subprocess.PIPE,
                                       stderr=subprocess.DEVNULL, env={**os.environ, "TMPDIR": str(folder)})
        address = self.server.stdout.readline().decode().strip()
        self.base, self.token = address.split("/#")
        self.host = self.base.removeprefix("http://")
        self.port = int(self.host.split(":")[1])

    def end(self):
        if self.server.poll() is None:
            self.server.terminate()
            self.assertEqual(self.server.wait(SECONDS), 0)
        self.server.stdout.close()

    def ask(self, method, target, body=None, headers=None, token=True):
        """Status, headers and body."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=SECONDS)
        sent = {"X-Meshrepair-Token": self.token} if token else {}
        try:
            connection.request(method, target, body, {**sent, **(headers or {})})
            answer = connection.getresponse()
            return answer.status, answer.headers, answer.read()
        finally:
            connection.close()

    def raw(self, data, wait=True):
        """What comes back for these bytes."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=SECONDS) as line:
            line.sendall(data)
            if not wait:
                return b""
            said = b""
            while some := line.recv(65536):
                said += some
            return said

    def upload_head(self, headers="", version="1.1", name="a.stl"):
        head = f"POST /jobs?name={name} HTTP/{version}\r\nHost: {self.host}\r\nX-Meshrepair-Token: {self.token}\r\n{headers}\r\n"
        return head.encode()

    def hand_in(self, name="mesh.stl", data=BROKEN):
        status, _, body = self.ask("POST", f"/jobs?name={name}", data)
        self.assertEqual(status, 201, body)
        return json.loads(body)["job"]

    def finished(self, job):
        deadline = time.monotonic() + SECONDS
        while time.monotonic() < deadline:
            status, _, body = self.ask("GET", f"/jobs/{job}")
            self.assertEqual(status, 200, body)
            state = json.loads(body)
            if state["phase"] == "ended":
                return state
            time.sleep(0.02)
        self.fail("it does not end")

    def repaired_at_last(self, job, **options):
        self.finished(job)
        return self.repaired(job, **options)

    def repaired(self, job, **options):
        status, _, body = self.ask("POST", f"/jobs/{job}/repair", headers={"X-Meshrepair-Options": json.dumps(options)})
        self.assertEqual(status, 202, body)
        return self.finished(job)

    def is_alive(self):
        self.assertEqual(self.ask("GET", "/")[0], 200)

    def jobs(self):
        return sum(1 for _ in self.folder.glob("meshrepair-serve-*/*/in"))
