#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""meshrepair --serve: what it answers, and to whom. Requests as other pages and broken programs send them.

Usage: serve_test.py PROGRAMS [OPTIONS OF UNITTEST]
"""

import concurrent.futures
import json
import os
import pathlib
import shutil
import signal
import socket
import stat
import subprocess
import sys
import time
import unittest

from serving import BROKEN, CUBE, LIMIT, SECONDS, Serving, balls, ring

GLTF = {"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}]}


class Work(Serving):
    def test_a_mesh_is_checked_and_repaired(self):
        job = self.hand_in()
        state = self.finished(job)
        self.assertEqual((state["task"], state["exit_code"], state["has_page"], state["has_result"]), ("check", 1, True, False))
        self.assertEqual(state["report"]["check"]["defects"]["open_edges"]["count"], 23)
        state = self.repaired(job, format="obj")
        self.assertEqual((state["task"], state["exit_code"], state["has_page"], state["has_result"]), ("repair", 0, True, True))
        _, headers, body = self.ask("GET", f"/jobs/{job}/result", token=False)
        self.assertEqual(headers["Content-Disposition"], "attachment; filename*=UTF-8''mesh_repaired.obj")
        alone = self.folder / "alone.obj"
        (self.folder / "mesh.stl").write_bytes(BROKEN)
        subprocess.run([self.programs / "meshrepair", "-q", self.folder / "mesh.stl", alone], check=True)
        self.assertEqual(body, alone.read_bytes())
        for page in ("check", "repair"):
            self.assertIn(b'id="facts"', self.ask("GET", f"/jobs/{job}/{page}.html", token=False)[2])

    def test_options(self):
        job = self.hand_in()
        self.finished(job)
        self.assertEqual(self.repaired(job, format="ply", **{"for": "print", "always": True})["report"]["purpose"]["name"], "print")
        self.assertEqual(self.repaired(job, format="ply", seal="nonsense")["exit_code"], 2)
        for wrong in ({}, {"format": "txt"}, {"format": "../stl"}, {"format": "stl", "report": "x.json"}, {"format": "stl", "html": "x"},
                      {"format": "stl", "root": "/"}, {"format": "stl", "for": ["print"]}, {"format": "stl", "for": "a\nb"},
                      {"format": "stl", "seal": "1" * 101}, {"format": "stl", "staging": "/tmp"}, {"format": "stl", "for": True}, {"format": "stl", "for": False},
                      {"format": "stl", "always": "yes"}, {"format": "stl", "seal": ""}, []):
            status, _, _ = self.ask("POST", f"/jobs/{job}/repair", headers={"X-Meshrepair-Options": json.dumps(wrong)})
            self.assertEqual(status, 400, wrong)
        for text in ("", "{", '{"format":"stl"}}', "\u00ff"):
            status, _, _ = self.ask("POST", f"/jobs/{job}/repair", headers={"X-Meshrepair-Options": text.encode("latin-1").decode("latin-1")})
            self.assertEqual(status, 400, text)

    def test_a_mesh_without_a_byte(self):
        """It is answered at once, however it is sent."""
        for headers in ("Content-Length: 0\r\n", "Transfer-Encoding: chunked\r\n"):
            body = b"0\r\n\r\n" if "chunked" in headers else b""
            start = time.monotonic()
            answer = self.raw(self.upload_head(headers + "Connection: close\r\n") + body)
            self.assertLess(time.monotonic() - start, 5)
            self.assertRegex(answer, rb"^HTTP/1.1 201 ", headers)
            state = self.finished(json.loads(answer.split(b"\r\n\r\n")[1])["job"])
            self.assertIn("empty", state["report"]["error"])

    def test_cancel_and_remove(self):
        job = self.hand_in("balls.obj", balls())
        self.assertEqual(self.ask("POST", f"/jobs/{job}/cancel")[0], 200)
        self.assertIn(self.finished(job)["exit_code"], (1, 143))
        self.assertEqual(self.repaired(job, format="stl")["exit_code"], 0)
        self.assertEqual(self.ask("DELETE", f"/jobs/{job}")[0], 200)
        self.assertEqual(self.ask("GET", f"/jobs/{job}")[0], 404)
        self.assertEqual(self.jobs(), 0)

    def test_a_mesh_that_is_removed_at_work(self):
        """It is gone at once, however often it is asked for."""
        job = self.hand_in("balls.obj", balls())
        self.finished(job)
        self.ask("POST", f"/jobs/{job}/repair", headers={"X-Meshrepair-Options": '{"format": "stl"}'})
        while json.loads(self.ask("GET", f"/jobs/{job}")[2])["stage"] == "":
            time.sleep(0.01)
        self.assertEqual(self.ask("DELETE", f"/jobs/{job}")[0], 200)
        for target in ("", "/check.html", "/result"):
            self.assertEqual(self.ask("GET", f"/jobs/{job}{target}")[0], 404, target)
        deadline = time.monotonic() + 10
        while self.jobs() > 0 and time.monotonic() < deadline:
            time.sleep(0.02)
        self.assertEqual(self.jobs(), 0)

    def test_removed_at_any_time(self):
        for i in range(40):
            job = self.hand_in("a.stl", CUBE)
            time.sleep(0.002 * i)
            self.ask("DELETE", f"/jobs/{job}")
            self.ask("DELETE", f"/jobs/{job}")
            self.assertEqual(self.ask("GET", f"/jobs/{job}")[0], 404)
        self.finished(self.hand_in("a.stl", CUBE))
        self.assertEqual(self.jobs(), 1)

    def test_no_path_of_the_machine_is_told(self):
        self.no_path_is_told(self.folder)

    def test_no_path_of_a_machine_with_odd_names_is_told(self):
        for name in ('q"x', "b\\y", "\u00e9"):
            self.end()
            (self.folder / name).mkdir()
            self.start(self.folder / name)
            self.no_path_is_told("meshrepair-serve-")

    def no_path_is_told(self, folder):
        for name, data in (("empty.stl", b"solid x\n"), ("cut.ply", b"ply\nformat ascii 1.0\n"), ("mesh.stl", BROKEN)):
            job = self.hand_in(name, data)
            texts = [json.dumps(self.finished(job)), json.dumps(self.repaired(job, format="obj"))]
            texts += [self.ask("GET", f"/jobs/{job}/{page}.html")[2].decode() for page in ("check", "repair")]
            for text in texts:
                self.assertNotIn(str(folder), text)
                self.assertNotIn(job, text)

    def test_the_end(self):
        for number in (signal.SIGINT, signal.SIGQUIT, signal.SIGHUP):
            folder = next(self.folder.glob("meshrepair-serve-*"))
            self.assertEqual(stat.S_IMODE(folder.stat().st_mode), 0o700)
            self.hand_in()
            self.server.send_signal(number)
            self.assertEqual(self.server.wait(SECONDS), 0)
            self.assertFalse(folder.exists())
            self.end()
            self.start(self.folder)

    def test_a_port_that_is_taken(self):
        result = subprocess.run([self.programs / "meshrepair", "--serve", "--port", str(self.port)], capture_output=True, check=False)
        self.assertEqual(result.returncode, 2)
        self.assertIn(b"meshrepair: --port: ", result.stderr)

    def test_the_command_line(self):
        for words, what in ((["--serve", "--help"], b"--max-upload"), (["--serve", "--port", "x"], b"--port"),
                            (["--serve", "a.stl"], b"not expected"), (["a.stl", "b.stl", "--serve"], b"must be the first argument")):
            result = subprocess.run([self.programs / "meshrepair", *words], capture_output=True, check=False)
            self.assertEqual(result.returncode, 0 if "--help" in words else 2)
            self.assertIn(what, result.stdout if "--help" in words else result.stderr)

    def test_wrong_limits(self):
        for option, value in (("--max-memory", "foo"), ("--max-memory", "500%"), ("--max-memory", "0%"), ("--max-upload", "-1"),
                              ("--max-upload", "50%"), ("--max-upload", "0"), ("--max-upload", "1X"), ("--threads", "-1")):
            result = subprocess.run([self.programs / "meshrepair", "--serve", "--no-browser", f"{option}={value}"], capture_output=True,
                                    check=False, timeout=SECONDS)
            self.assertEqual(result.returncode, 2, value)
            self.assertTrue(result.stderr.startswith(f"meshrepair: {option}: ".encode()), result.stderr)
            self.assertEqual(result.stderr.count(b"(try "), 1, result.stderr)
            self.assertIn(b"(try 'meshrepair --serve --help')", result.stderr)


class Attacks(Serving):
    def test_other_origins_and_hosts(self):
        job = self.hand_in()
        self.finished(job)
        secret = (("POST", "/jobs?name=a.stl"), ("GET", f"/jobs/{job}"), ("POST", f"/jobs/{job}/repair"), ("DELETE", f"/jobs/{job}"))
        for method, target in (*secret, ("GET", "/"), ("GET", f"/jobs/{job}/check.html"), ("GET", f"/jobs/{job}/result")):
            for headers in ({"Origin": "https://evil.example"}, {"Origin": "null"}, {"Origin": f"https://{self.host}"},
                            {"Origin": f"http://127.0.0.1:{self.port + 1}"}, {"Origin": f"http://{self.host}.evil.example"},
                            {"Host": f"evil.example:{self.port}"}, {"Host": "127.0.0.1"}, {"Host": f"127.0.0.1:{self.port + 1}"},
                            {"Host": f"[::1]:{self.port}"}, {"Host": f"{self.host}.evil.example"}, {"Sec-Fetch-Site": "cross-site"},
                            {"Sec-Fetch-Site": "same-site"}):
                status, answered, body = self.ask(method, target, headers=headers)
                is_link = target == "/" and "Sec-Fetch-Site" in headers  # it holds no secret
                self.assertEqual(status, 200 if is_link else 403, (method, target, headers, body))
                self.assertNotIn("Access-Control-Allow-Origin", answered)
        for method, target in secret:
            for token in ({}, {"X-Meshrepair-Token": ""}, {"X-Meshrepair-Token": self.token[:-1]}, {"X-Meshrepair-Token": "0" * 32}):
                self.assertEqual(self.ask(method, target, headers=token, token=False)[0], 403, (method, target, token))
        self.assertEqual(self.ask("OPTIONS", "/jobs", headers={"Origin": "https://evil.example"}, token=False)[0], 403)
        self.assertEqual(self.jobs(), 1)
        self.assertEqual(self.ask("GET", "/", headers={"Host": f"localhost:{self.port}", "Origin": f"http://localhost:{self.port}"})[0], 200)

    def test_names(self):
        for name in ("", "..", "../a.stl", "..%2fa.stl", "..%2f..%2f..%2fetc%2fpasswd", "%2fetc%2fpasswd.stl", "a%2fb.stl", "a%5cb.stl",
                     "a%00.stl", "a%0a.stl", "%2e%2e%2fa.stl", ".stl", "-a.stl", "a", "a.txt", "a.stl%", "a.stl%4", "a.stl%zz", "a.gz",
                     "a" * 250 + ".stl"):
            status, _, body = self.ask("POST", f"/jobs?name={name}", CUBE)
            self.assertEqual(status, 400, (name, body))
        self.assertEqual(self.jobs(), 0)
        for name in ("a%20b%23c.stl", "%C3%A4.STL", "a..stl", "%ff.stl", "$(reboot).stl", "%3Cimg%20src=x%3E.stl", "a.stl'--report=x.stl"):
            self.assertEqual(self.finished(self.hand_in(name, CUBE))["exit_code"], 0, name)

    def test_paths(self):
        job = self.hand_in()
        self.finished(job)
        for target in ("/../../../../etc/passwd", "//etc/passwd", "/etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/serve.js/../../etc/passwd",
                       "/jobs/../../etc/passwd", f"/jobs/{job}/../../../etc/passwd", f"/jobs/{job}/in/mesh.stl", f"/jobs/{job}/report.json",
                       f"/jobs/{job}/check.html/../report.json", f"/jobs/{job}%2f..", "/jobs/" + "0" * 32, "/jobs/" + "../" * 11 + "a", "*",
                       "http://evil.example/", "/jobs/", f"/jobs/{job}x"):
            answer = self.raw(f"GET {target} HTTP/1.1\r\nHost: {self.host}\r\nX-Meshrepair-Token: {self.token}\r\nConnection: close\r\n\r\n"
                              .encode())
            self.assertRegex(answer, rb"^HTTP/1.1 404 ", target)
            self.assertNotIn(b"root:", answer)

    def test_meshes_that_name_other_files(self):
        (self.folder / "secret.mtl").write_text("newmtl SECRET\nKd 1 0 0\nmap_Kd SECRET.png\n")
        (self.folder / "SECRET.png").write_bytes((pathlib.Path(__file__).resolve().parents[2] / "docs/pictures/bracket.png").read_bytes())
        (self.folder / "secret.bin").write_bytes(bytes(36))
        obj = "mtllib {0}\nusemtl SECRET\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nf 1/1 3/1 2/1\nf 1/1 2/1 4/1\nf 2/1 3/1 4/1\nf 1/1 4/1 3/1\n"
        ways = [str(self.folder / "secret"), "../../../secret", "file://" + str(self.folder / "secret"), "..\\..\\..\\secret"]
        for way in ways:
            gltf = json.dumps({**GLTF, "buffers": [{"uri": way + ".bin", "byteLength": 36}]})
            job = self.hand_in("a.gltf", gltf.encode())
            self.assertEqual(self.finished(job)["exit_code"], 3, way)
            job = self.hand_in("a.obj", obj.format(way + ".mtl").encode())
            self.finished(job)
            for form in ("obj", "3mf", "glb"):
                self.assertEqual(self.repaired(job, format=form)["exit_code"], 0)
                self.assertNotIn(b"SECRET.png", self.ask("GET", f"/jobs/{job}/result")[2])
            self.assertNotIn(b"map_Kd", self.ask("GET", f"/jobs/{job}/repair.html")[2])

    def test_uploads_that_are_too_large(self):
        head = f"POST /jobs?name=a.stl HTTP/1.1\r\nHost: {self.host}\r\nX-Meshrepair-Token: {self.token}\r\n"
        for length in (LIMIT + 1, 1 << 32, (1 << 64) - 1):
            self.assertRegex(self.raw(f"{head}Content-Length: {length}\r\n\r\n".encode() + bytes(1000)), rb"^HTTP/1.1 413 ", length)
        chunk = b"10000\r\n" + bytes(1 << 16) + b"\r\n"
        with socket.create_connection(("127.0.0.1", self.port), timeout=SECONDS) as line:
            line.sendall(head.encode() + b"Transfer-Encoding: chunked\r\n\r\n")
            try:
                for _ in range(1000):
                    line.sendall(chunk)
            except OSError:
                pass  # it has closed
        self.assertRegex(self.raw(f"{head}Content-Length: 1{'0' * 30}\r\n\r\n".encode()), rb"^(HTTP/1.1 4|$)")
        self.is_alive()
        self.assertEqual(self.jobs(), 0)
        self.assertIn(self.finished(self.hand_in("a.stl", bytes(LIMIT)))["exit_code"], (1, 3))

    def test_uploads_without_an_end(self):
        """What cannot be told from the next request is refused, and nothing after it is a request."""
        after = f"GET /favicon.ico HTTP/1.1\r\nHost: {self.host}\r\n\r\n".encode()
        for headers, version, code in (("", "1.0", 411), ("", "1.1", 411), ("Transfer-Encoding: xchunked\r\n", "1.1", 501),
                                       ("Transfer-Encoding: gzip\r\n", "1.1", 501), ("Transfer-Encoding: gzip, chunked\r\n", "1.1", 501)):
            answer = self.raw(self.upload_head(headers, version) + after)
            self.assertRegex(answer, rb"^HTTP/1.1 %d " % code, headers)
            self.assertEqual(answer.count(b"HTTP/1.1 "), 1, headers)
        answer = self.raw(f"GET / HTTP/1.1\r\nHost: {self.host}\r\nTransfer-Encoding: gzip\r\n\r\n".encode() + after)
        self.assertRegex(answer, rb"^HTTP/1.1 501 ")
        self.assertEqual(answer.count(b"HTTP/1.1 "), 1)
        self.assertEqual(self.jobs(), 0)

    def test_headers_that_stand_twice(self):
        for first, second in ((f"Host: {self.host}", "Host: evil.example"), (f"Host: {self.host}", f"host: {self.host}"),
                              (f"Host: {self.host}\r\nOrigin: http://{self.host}", "Origin: https://evil.example"),
                              (f"Host: {self.host}\r\nOrigin: ", "Origin: https://evil.example")):
            answer = self.raw(f"GET / HTTP/1.1\r\n{first}\r\n{second}\r\nConnection: close\r\n\r\n".encode())
            self.assertRegex(answer, rb"^HTTP/1.1 400 ", (first, second))

    def test_uploads_that_end_early(self):
        head = f"POST /jobs?name=a.stl HTTP/1.1\r\nHost: {self.host}\r\nX-Meshrepair-Token: {self.token}\r\nContent-Length: 1000\r\n\r\n"
        for _ in range(20):
            self.raw(head.encode() + bytes(500), wait=False)
        deadline = time.monotonic() + SECONDS
        times = 0  # in a row, as some may begin when others are gone
        while times < 20 and time.monotonic() < deadline:
            times = times + 1 if self.jobs() == 0 else 0
            time.sleep(0.05)
        self.assertEqual(times, 20)
        self.is_alive()

    def test_requests_that_hang(self):
        """They are closed, and hold up nobody."""
        lines = []
        for part in (b"", b"GET / HT", b"GET / HTTP/1.1\r\nHost: x\r\n"):
            line = socket.create_connection(("127.0.0.1", self.port), timeout=SECONDS)
            line.sendall(part)
            lines.append(line)
        start = time.monotonic()
        self.is_alive()
        self.assertLess(time.monotonic() - start, 5)
        for line in lines:
            self.assertEqual(line.recv(100), b"")
            line.close()

    def test_broken_requests(self):
        for data in (b"\r\n\r\n", b"\0" * 100, b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"GET / HTTP/1.1\r\nHost\r\n\r\n",
                     b"GET / HTTP/1.1\r\n" + b"A: b\r\n" * 5000 + b"\r\n", b"GET /" + b"a" * 100000 + b" HTTP/1.1\r\n\r\n",
                     b"POST /jobs?name=a.stl HTTP/1.1\r\nHost: x\r\nContent-Length: 5\r\nTransfer-Encoding: chunked\r\n\r\n",
                     b"GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n", b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03"):
            self.assertNotRegex(self.raw(data), rb"^HTTP/1.. 2")
        self.is_alive()

    def test_200_at_a_time(self):
        job = self.hand_in()
        self.finished(job)

        def one(i):
            try:
                return self.ask("POST", "/jobs?name=a.stl", CUBE)[0] if i % 4 == 0 else self.ask("GET", f"/jobs/{job}")[0]
            except OSError:
                return 0

        with concurrent.futures.ThreadPoolExecutor(200) as pool:
            codes = list(pool.map(one, range(200)))
        self.assertLessEqual(set(codes), {200, 201, 503})
        self.assertGreater(codes.count(200), 50)
        self.is_alive()

    def test_a_page_in_another_sites_frame(self):
        job = self.hand_in()
        self.finished(job)
        self.assertIn("frame-ancestors 'none'", self.ask("GET", "/")[1]["Content-Security-Policy"])
        headers = self.ask("GET", f"/jobs/{job}/check.html")[1]
        self.assertEqual(headers["Content-Security-Policy"], "sandbox allow-scripts; frame-ancestors 'self'")
        self.assertEqual(headers["X-Content-Type-Options"], "nosniff")
        self.assertEqual(headers["Cross-Origin-Resource-Policy"], "same-origin")


    def test_others_cannot_read_meshes(self):
        job = self.hand_in()
        self.assertTrue(self.repaired_at_last(job, format="obj")["has_result"])
        paths = list(self.folder.glob("meshrepair-serve-*/**/*"))
        self.assertGreater(len(paths), 5)
        for path in paths:
            self.assertEqual(stat.S_IMODE(path.stat().st_mode), 0o700 if path.is_dir() else 0o600, path)

    @unittest.skipIf(os.environ.get("MESHREPAIR_PLAIN_POSIX") == "1", "only Linux knows an open folder from another of its name")
    def test_a_folder_that_is_gone(self):
        """Another one in its place is not used, and none is made."""
        job = self.hand_in()
        self.finished(job)
        folder = next(self.folder.glob("meshrepair-serve-*"))
        shutil.rmtree(folder)
        for makes_another in (False, True):
            if makes_another:
                folder.mkdir()
                (folder / job).mkdir()
                (folder / job / "check.html").write_text("a page of others")
            status, _, body = self.ask("POST", "/jobs?name=a.stl", CUBE)
            self.assertEqual((status, b"is gone" in body), (507, True), body)
            options = {"X-Meshrepair-Options": '{"format": "stl"}'}
            self.assertEqual(self.ask("POST", f"/jobs/{job}/repair", headers=options)[0], 507)
            self.assertEqual(self.ask("GET", f"/jobs/{job}/check.html")[0], 404)
            self.assertEqual(self.jobs(), 0)
        self.end()
        self.assertEqual([path.name for path in folder.glob("*/*")], ["check.html"])

    def test_a_folder_that_leads_nowhere(self):
        with socket.create_connection(("127.0.0.1", self.port), timeout=SECONDS) as line:
            line.sendall(self.upload_head(f"Content-Length: {len(CUBE)}\r\n") + CUBE[:100])
            while not (files := list(self.folder.glob("meshrepair-serve-*/*/in/*"))):
                time.sleep(0.01)
            inside = files[0].parents[1]
            inside.rename(self.folder / "elsewhere")
            inside.symlink_to(inside)
            line.sendall(CUBE[100:])
            self.assertIn(b" 201 ", line.recv(65536))
        state = self.finished(inside.name)
        self.assertEqual((state["exit_code"], state["has_page"]), (6, False))
        self.is_alive()
        self.assertEqual(self.finished(self.hand_in("cube.stl", CUBE))["exit_code"], 0)

    def test_links_are_not_followed(self):
        job = self.hand_in()
        self.assertTrue(self.repaired_at_last(job, format="obj")["has_result"])
        inside = next(self.folder.glob("meshrepair-serve-*")) / job
        for path, target in ((inside / "check.html", "check.html"), (inside / "out" / "mesh.obj", "result")):
            path.unlink()
            path.symlink_to("/etc/passwd")
            self.assertEqual(self.ask("GET", f"/jobs/{job}/{target}")[0], 404)
            path.unlink()
            os.mkfifo(path)
            self.assertEqual(self.ask("GET", f"/jobs/{job}/{target}")[0], 404)


class MoreThanItHolds(Serving):
    options = ("--max-upload", "20M")

    def test_a_slow_download(self):
        """It may take longer than the time that is allowed without a byte."""
        job = self.hand_in("ring.stl", ring(300, 200))
        self.assertTrue(self.repaired_at_last(job, format="stl")["has_result"])
        with socket.socket() as line:
            line.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 65536)
            line.settimeout(SECONDS)
            line.connect(("127.0.0.1", self.port))
            line.sendall(f"GET /jobs/{job}/result HTTP/1.1\r\nHost: {self.host}\r\nConnection: close\r\n\r\n".encode())
            start = time.monotonic()
            said = b""
            while some := line.recv(16384):
                said += some
                if time.monotonic() - start < 36:
                    time.sleep(0.25)
        head, _, body = said.partition(b"\r\n\r\n")
        self.assertIn(b"Content-Length: %d\r\n" % len(body), head + b"\r\n")

    def test_the_oldest_go(self):
        first = self.hand_in("a.stl", CUBE)
        self.finished(first)
        for _ in range(50):
            last = self.hand_in("a.stl", CUBE)
            self.finished(last)
        self.assertEqual(self.ask("GET", f"/jobs/{first}")[0], 404)
        self.assertEqual(self.finished(last)["exit_code"], 0)
        self.assertLessEqual(self.jobs(), 50)


    def test_a_disk_that_is_full(self):
        """Meshes that nobody works on make room, the oldest first."""
        mounted = ("unshare", "--user", "--map-root-user", "--mount", "sh", "-c", 'mount -t tmpfs -o size=8m tmpfs "$TMPDIR" && exec "$0" "$@"')
        if subprocess.run([*mounted, "true"], env={**os.environ, "TMPDIR": str(self.folder)}, capture_output=True, check=False).returncode != 0:
            self.skipTest("no small disk can be made")
        self.end()
        self.start(self.folder, *mounted)
        data = CUBE + bytes(2 << 20)
        jobs = []
        for _ in range(6):
            jobs.append(self.hand_in("a.stl", data))
            self.finished(jobs[-1])
        codes = [self.ask("GET", f"/jobs/{job}")[0] for job in jobs]
        self.assertEqual(codes, sorted(codes, reverse=True))
        self.assertEqual(set(codes), {404, 200})
        self.assertEqual(self.ask("POST", "/jobs?name=a.stl", bytes(9 << 20))[0], 507)
        self.is_alive()


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    Serving.programs = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
