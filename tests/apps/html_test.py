#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What programs write with --html: one page that needs nothing else, whatever is in names and meshes.

Usage: html_test.py PROGRAMS
"""

import base64
import gzip
import hashlib
import html.parser
import json
import os
import pathlib
import re
import struct
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
MESHES = ROOT / "samples/meshes"
VIEWER = ROOT / "web/viewer/dist/viewer.html"
PLACE = "@DATA@\n"
MOST = 2**18 - 1  # steps of the grid
HOSTILE = "<img src=x onerror=alert(1)>\u2028&<!--<script>'\"`${1}]]>\\.stl"


class Elements(html.parser.HTMLParser):
    """The elements of a page in their order, and what stands in each script and style."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.names: list[str] = []
        self.scripts: dict[str, str] = {}
        self.policy = ""
        self.inside = ""
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.names.append(tag)
        attributes = dict(attrs)
        if tag in ("script", "style"):
            self.inside = attributes.get("id", tag)
            self.scripts[self.inside] = ""
        if attributes.get("http-equiv") == "Content-Security-Policy":
            self.policy = attributes["content"]

    def handle_endtag(self, tag):
        self.inside = ""

    def handle_data(self, data):
        if self.inside:
            self.scripts[self.inside] += data


class Numbers:
    """The numbers of a packed mesh, as apps/page/pack_mesh.h says."""

    def __init__(self, text: str) -> None:
        self.bytes = gzip.decompress(base64.b64decode(text, validate=True))
        self.at = 0

    def next(self) -> int:
        value = shift = 0
        while True:
            byte = self.bytes[self.at]
            self.at += 1
            value |= (byte & 127) << shift
            shift += 7
            if byte < 128:
                return value

    def signed(self) -> int:
        value = self.next()
        return (value >> 1) ^ -(value & 1)


def unpack(text: str, triangles: int, has_values: bool = False) -> tuple[list[int], list[list[int]], list[int], list[int]]:
    """Corners, places, kinds and marks, or instead of marks the values of points."""
    numbers = Numbers(text)
    corners: list[int] = []
    points = 0
    for _ in range(3 * triangles):
        back = numbers.next()
        corners.append(points if back == 0 else points - back)
        points += back == 0
    axes = []
    for _ in range(3):
        value, axis = 0, []
        for _ in range(points):
            value += numbers.signed()
            axis.append(value)
        axes.append(axis)
    kinds = [numbers.next() for _ in range(triangles)]
    marks = [numbers.next() for _ in range(triangles)]
    values = [numbers.next() for _ in range(points)] if has_values else []
    assert numbers.at == len(numbers.bytes)
    return corners, [list(place) for place in zip(*axes)], kinds, values if has_values else marks


class Pages(unittest.TestCase):
    programs: pathlib.Path

    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="html_")
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_program(self, program: str, *arguments: str | pathlib.Path) -> int:
        return subprocess.run([self.programs / program, "-q", *arguments], cwd=self.folder, check=False, timeout=300,
                              stdout=subprocess.DEVNULL).returncode

    def page(self, name: str = "p.html") -> str:
        return (self.folder / name).read_bytes().decode()

    def facts(self, name: str = "p.html") -> dict:
        return json.loads(Elements(self.page(name)).scripts["facts"])

    def repaired(self, mesh: str | pathlib.Path, *more: str) -> dict:
        code = self.run_program("meshrepair", mesh, "out.obj", "--html", "p.html", "--report", "r.json", *more)
        self.assertEqual(code, 0)
        return json.loads((self.folder / "r.json").read_text(encoding="utf-8"))

    def test_the_page_is_the_viewer_around_data(self):
        self.repaired(MESHES / "broken_torus_box.stl")
        head, tail = VIEWER.read_text(encoding="utf-8").split(PLACE)
        page = self.page()
        self.assertTrue(page.startswith(head) and page.endswith(tail))
        data = page[len(head):-len(tail)]
        self.assertRegex(data, r'\A<script type="application/json" id="facts">[ -;=?-~]*</script>\n'
                               r'(<script type="text/plain" id="mesh-\d">[A-Za-z0-9+/]*=*</script>\n){2}\Z')

    def test_nothing_is_loaded_and_nothing_else_runs(self):
        self.repaired(MESHES / "cube.stl")
        elements = Elements(self.page())
        for name in ("script", "style"):
            digest = base64.b64encode(hashlib.sha256(elements.scripts[name].encode()).digest()).decode()
            self.assertIn(f"{name}-src 'sha256-{digest}';", elements.policy)
        self.assertTrue(elements.policy.startswith("default-src 'none';"))
        self.assertNotRegex(elements.policy, r"unsafe|https?:|\*|connect-src|img-src")
        self.assertNotRegex(self.page(), r"<[^>]*\s(src|href)=[\"']?\w")

    def test_the_same_bytes_on_any_number_of_threads(self):
        pages = []
        for threads in ("1", "4", "4"):
            self.repaired(MESHES / "broken_spheres.obj", "--threads", threads)
            pages.append(self.page())
        self.assertEqual(pages[0], pages[1])
        self.assertEqual(pages[1], pages[2])

    def test_names_are_no_markup(self):
        names = [HOSTILE.encode(), b"\xff\xfe<b>.stl", b"a-->.stl", b"<script>.stl"]
        self.repaired(MESHES / "cube.stl")
        expected = Elements(self.page()).names
        for name in names:
            path = os.fsdecode(name)
            (self.folder / path).write_bytes((MESHES / "cube.stl").read_bytes())
            self.repaired(path)
            self.assertEqual(Elements(self.page()).names, expected, name)
            self.assertEqual(self.facts()["meshes"][0]["name"], name.decode(errors="replace"))

    def test_triangles_are_where_they_were(self):
        self.assertEqual(self.run_program("meshcheck", MESHES / "cube.stl", "--html", "p.html"), 0)
        facts = self.facts()
        grid, mesh = facts["grid"], facts["meshes"][0]
        given = re.findall(r"vertex (\S+) (\S+) (\S+)", (MESHES / "cube.stl").read_text(encoding="ascii"))
        self.assertEqual(3 * mesh["shown"], len(given))
        corners, places, _, marks = unpack(Elements(self.page()).scripts["mesh-0"], mesh["shown"])
        self.assertEqual(set(marks), {0})
        for i, corner in enumerate(corners):
            own = [grid["low"][k] + places[corner][k] / MOST * 2 * grid["half"] for k in range(3)]
            for a, b in zip(own, given[i]):
                self.assertAlmostEqual(a, float(b), delta=2 * grid["half"] / MOST)

    def test_counts_are_those_of_the_report(self):
        report = self.repaired(MESHES / "broken_torus_box.stl", "--explain", "e.glb")
        self.assertEqual(self.run_program("meshcheck", MESHES / "broken_torus_box.stl", "--report", "c.json"), 1)
        check = json.loads((self.folder / "c.json").read_text(encoding="utf-8"))["check"]
        self.assertEqual(report["html"]["input"]["check"], check)
        meshes = self.facts()["meshes"]
        for m, mesh in enumerate(meshes):
            self.assertEqual(report["html"][mesh["role"]], {"triangles_shown": mesh["shown"], "check": mesh["check"]})
            self.assertEqual({kind["key"]: kind["count"] for kind in mesh["kinds"]}, report["explain"][mesh["role"]])
            _, _, kinds, marks = unpack(Elements(self.page()).scripts[f"mesh-{m}"], mesh["shown"])
            for k, kind in enumerate(mesh["kinds"]):
                self.assertEqual(kinds.count(k), kind["count"])
            self.assertEqual(any(marks), not mesh["check"]["valid_solid"])
        places = meshes[0]["places"]["open_edges"]
        self.assertEqual((len(places["at"]), len(places["ends"])), (3 * 23, 6 * 23))

    def test_meshcheck_lists_no_more_places_than_it_did(self):
        mesh = MESHES / "broken_torus_box.stl"
        self.assertEqual(self.run_program("meshcheck", mesh, "--places", "2", "--report", "a.json"), 1)
        self.assertEqual(self.run_program("meshcheck", mesh, "--places", "2", "--report", "b.json", "--html", "p.html"), 1)
        plain, paged = (json.loads((self.folder / name).read_text(encoding="utf-8")) for name in ("a.json", "b.json"))
        self.assertEqual(plain["check"], paged["check"])
        self.assertEqual(paged["html"]["input"]["check"], plain["check"])

    def test_a_limit_keeps_what_is_at_fault(self):
        self.repaired(MESHES / "broken_torus_box.stl")
        mesh = self.facts()["meshes"][0]
        *_, marks = unpack(Elements(self.page()).scripts["mesh-0"], mesh["shown"])
        faults = sum(mark > 0 for mark in marks)
        for limit in (faults + 100, faults - 100):
            report = self.repaired(MESHES / "broken_torus_box.stl", "--html-triangles", str(limit))
            shown = report["html"]["input"]["triangles_shown"]
            self.assertLessEqual(shown, limit)
            self.assertTrue(self.facts()["meshes"][0]["simplified"])
            *_, marks = unpack(Elements(self.page()).scripts["mesh-0"], shown)
            self.assertEqual(sum(mark > 0 for mark in marks), min(limit, faults))

    def combined(self, *command: str | pathlib.Path) -> dict:
        self.assertEqual(self.run_program("bspbool", *command, "-o", "out.obj", "--html", "p.html", "--report", "r.json"), 0)
        return json.loads((self.folder / "r.json").read_text(encoding="utf-8"))

    def test_operands_are_checked_alone_and_told_apart(self):
        # They cross each other; neither crosses itself.
        report = self.combined(MESHES / "hollow_sphere.obj", MESHES / "cube.stl", "--op", "union")
        self.assertTrue(report["html"]["input"]["check"]["valid_solid"])
        self.assertEqual(report["html"]["input"]["check"]["parts"], 3)
        facts = self.facts()
        self.assertEqual([operand["name"] for operand in facts["operands"]], ["hollow_sphere.obj", "cube.stl"])
        given, made = facts["meshes"]
        self.assertEqual([kind["count"] for kind in given["kinds"]], [1116, 12, 0])
        self.assertEqual(sum(kind["count"] for kind in made["kinds"]), made["triangles"])
        *_, kinds, _ = unpack(Elements(self.page()).scripts["mesh-0"], given["shown"])
        self.assertEqual(kinds, [0] * 1116 + [1] * 12)

    def test_faults_of_operands_are_where_they_are(self):
        self.combined(MESHES / "cube.stl", MESHES / "broken_torus_box.stl", "--op", "union")
        both = self.facts()
        self.assertEqual(self.run_program("meshcheck", MESHES / "broken_torus_box.stl", "--html", "p.html", "--report", "c.json"), 1)
        alone = json.loads((self.folder / "c.json").read_text(encoding="utf-8"))["check"]
        for key, defect in both["meshes"][0]["check"]["defects"].items():
            self.assertEqual(defect["count"], alone["defects"][key]["count"], key)
            for one, other in zip(defect["first"], alone["defects"][key]["first"]):
                shift = 8 if "points" in one else 12
                ids = "points" if "points" in one else "triangles"
                self.assertEqual([number - shift for number in one[ids]], other[ids], key)
                self.assertEqual(one["at"], other["at"])

    def test_distances_beyond_doubles_are_not_known(self):
        self.write_obj(["1.5e308 1.5e308 1.5e308", "-1.5e308 0 0", "0 1e308 1"], ["1 2 3"])
        self.assertEqual(self.run_program("meshdist", "in.obj", MESHES / "cube.stl", "--html", "p.html"), 0)
        facts = self.facts()
        self.assertIsNone(facts["scale"]["most"])
        *_, values = unpack(Elements(self.page()).scripts["mesh-0"], facts["meshes"][0]["shown"], True)
        self.assertEqual(set(values), {0})

    def test_distances_of_any_size(self):
        for unit in (1e-170, 1e100, 1e300):
            self.write_obj([f"0 0 {unit}", f"{unit} 0 {unit}", f"0 {unit} {unit}"], ["1 2 3"])
            (self.folder / "in.obj").rename(self.folder / "other.obj")
            self.write_obj(["0 0 0", f"{unit} 0 0", f"0 {unit} 0"], ["1 2 3"])
            self.assertEqual(self.run_program("meshdist", "in.obj", "other.obj", "--html", "p.html"), 0)
            facts = self.facts()
            self.assertAlmostEqual(facts["scale"]["most"] / unit, 1)
            *_, values = unpack(Elements(self.page()).scripts["mesh-0"], facts["meshes"][0]["shown"], True)
            self.assertEqual(set(values), {facts["scale"]["steps"]})

    def test_each_place_has_its_distance(self):
        report = self.folder / "r.json"
        self.assertEqual(self.run_program("meshdist", MESHES / "cube.stl", MESHES / "hollow_sphere.obj", "--html", "p.html", "--report",
                                          report), 0)
        distance = json.loads(report.read_text(encoding="utf-8"))["distance"]
        facts = self.facts()
        for way, key in zip(facts["ways"], ("a_to_b", "b_to_a")):
            self.assertEqual((way["mean"], way["rms"], way["largest"]), tuple(distance[key][name] for name in ("mean", "rms", "hausdorff")))
        self.assertEqual(facts["scale"]["most"], distance["hausdorff"])
        cube = facts["meshes"][0]
        self.assertGreater(cube["shown"], cube["triangles"])
        _, places, _, values = unpack(Elements(self.page()).scripts["mesh-0"], cube["shown"], True)
        self.assertEqual(len(values), len(places))
        by_place = {tuple(place): value / facts["scale"]["steps"] * facts["scale"]["most"] for place, value in zip(places, values)}
        grid = facts["grid"]
        for place, value in by_place.items():
            own = [grid["low"][k] + place[k] / MOST * 2 * grid["half"] for k in range(3)]
            radius = sum(x * x for x in own) ** 0.5
            # The sphere has a radius of 1, its cavity of 0.6; both are many flat triangles.
            self.assertAlmostEqual(value, min(abs(1 - radius), abs(0.6 - radius)), delta=0.05)

    def test_several_meshes_are_compared_with_the_first(self):
        report = self.folder / "r.json"
        names = [MESHES / "cube.stl", MESHES / "hollow_sphere.obj", MESHES / "cube.stl"]
        self.assertEqual(self.run_program("meshdist", *names, "--html", "p.html", "--report", report), 0)
        made = json.loads(report.read_text(encoding="utf-8"))
        self.assertNotIn("distance", made)
        self.assertEqual(made["input"]["b"], [str(name) for name in names[1:]])
        self.assertEqual([one["b"] for one in made["comparisons"]], made["input"]["b"])
        facts = self.facts()
        self.assertEqual([mesh["role"] for mesh in facts["meshes"]], ["a", "b"] * 2)
        largest = [one["distance"]["hausdorff"] for one in made["comparisons"]]
        self.assertEqual([max(pair["largest"] for pair in facts["ways"][i:i + 2]) for i in (0, 2)], largest)
        self.assertEqual((facts["scale"]["most"], largest[1]), (largest[0], 0))
        self.assertEqual(self.run_program("meshdist", *names[:2], "--report", report), 0)
        self.assertEqual(json.loads(report.read_text(encoding="utf-8"))["distance"], made["comparisons"][0]["distance"])
        self.assertEqual(self.run_program("meshdist", "-", names[0], "-"), 2)

    def test_pages_of_all_programs_have_the_same_bytes_on_any_number_of_threads(self):
        names = (MESHES / "hollow_sphere.obj", MESHES / "broken_torus_box.stl")
        for program, *more in (("bspbool", "--op", "union", "-o", "out.obj"), ("meshdist", "--samples", "5000")):
            pages = set()
            for threads in ("1", "4"):
                self.assertEqual(self.run_program(program, *names, *more, "--html", "p.html", "--threads", threads), 0)
                pages.add(self.page())
            self.assertEqual(len(pages), 1, program)

    def test_names_of_all_programs_are_no_markup(self):
        (self.folder / HOSTILE).write_bytes((MESHES / "cube.stl").read_bytes())
        for program, *more in (("bspbool", "--op", "union", "-o", "out.obj"), ("meshdist",)):
            self.assertEqual(self.run_program(program, MESHES / "cube.stl", MESHES / "cube.stl", *more, "--html", "p.html"), 0)
            expected = Elements(self.page()).names
            self.assertEqual(self.run_program(program, HOSTILE, MESHES / "cube.stl", *more, "--html", "p.html"), 0)
            self.assertEqual(Elements(self.page()).names, expected)
            facts = self.facts()
            self.assertIn(HOSTILE, [named["name"] for named in facts["meshes"] + facts.get("operands", [])])

    def write_pictured(self, picture: bytes, name: str = "wood.png", mesh: str = "in.obj") -> None:
        """A tetrahedron with a picture on one side and a colour on another, and the picture if it has bytes."""
        if picture:
            (self.folder / name).write_bytes(picture)
        (self.folder / "in.mtl").write_text(f"newmtl wood\nKd 1 1 1\nmap_Kd {name}\nnewmtl red\nKd 1 0 0\n")
        (self.folder / mesh).write_text("mtllib in.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 2.5\n"
                                        "usemtl wood\nf 1/1 3/3 2/2\nusemtl red\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")

    def looks(self, number: int = 0) -> tuple[dict, Numbers]:
        facts = self.facts()
        return facts["meshes"][number]["looks"], Numbers(Elements(self.page()).scripts[f"looks-{number}"])

    def test_colours_and_pictures_are_embedded_as_they_are(self):
        picture = (ROOT / "docs/pictures/pawn.png").read_bytes()
        self.write_pictured(picture)
        self.repaired("in.obj")
        scripts = Elements(self.page()).scripts
        self.assertEqual(base64.b64decode(scripts["picture-0"], validate=True), picture)
        self.assertNotIn("picture-1", scripts, "the result has the same one")
        for number in (0, 1):
            looks, numbers = self.looks(number)
            self.assertEqual(sorted(material["colour"] for material in looks["materials"]), [[255, 0, 0], [255, 255, 255]])
            self.assertEqual(sum(numbers.next() & 1 for _ in range(4)), 1)
        looks, numbers = self.looks()
        self.assertEqual([numbers.next() for _ in range(4)], [3, 4, 4, 4])
        self.assertEqual([numbers.next() for _ in range(3)], [0, 0, 0])
        places = [numbers.signed() for _ in range(6)]
        self.assertEqual(places, [0, 0, 8192, 0, 20480, -20480])
        self.assertEqual(numbers.at, len(numbers.bytes))

    def test_pictures_that_cannot_be_shown_are_named(self):
        (self.folder / "deeper").mkdir()
        many = b"\x89PNG\r\n\x1a\n" + bytes(8 << 20)
        for picture, name, why in ((b"", "none.png", "is not there"), (b"<svg onload='alert(1)'/>", "a.png", "is neither PNG nor JPEG"),
                                   (many, "big.png", "would make the page too large"), (b"GIF89a", "../out.gif", "is not there")):
            self.write_pictured(picture, name, "deeper/in.obj" if ".." in name else "in.obj")
            mesh = "in.obj"
            if ".." in name:
                (self.folder / "in.mtl").rename(self.folder / "deeper/in.mtl")
                mesh = "deeper/in.obj"
            self.repaired(mesh)
            self.assertNotIn("picture-0", Elements(self.page()).scripts)
            (line,) = self.facts()["left_out"]
            self.assertIn(why, line)

    def test_pictures_that_are_no_files_are_named(self):
        (self.folder / "secret.png").write_bytes((ROOT / "docs/pictures/pawn.png").read_bytes())
        mesh = self.folder / "mesh"
        mesh.mkdir()
        (mesh / "link.png").symlink_to("../secret.png")
        (mesh / "folder.png").mkdir()
        os.mkfifo(mesh / "fifo.png")
        (mesh / "device.png").symlink_to("/dev/zero")
        for name in ("link.png", "folder.png", "fifo.png", "device.png"):
            self.write_pictured(b"", name, "mesh/in.obj")
            (self.folder / "in.mtl").rename(mesh / "in.mtl")
            result = subprocess.run([self.programs / "meshcheck", "mesh/in.obj", "--picture", "p.png", "--html", "p.html"], cwd=self.folder,
                                    check=False, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True, timeout=60)
            self.assertIn(f"warning: mesh/in.obj: the picture '{name}' is not there, or not in the mesh's folder", result.stderr)
            (line,) = self.facts()["left_out"]
            self.assertIn(f"'{name}' is not there", line)

    def test_colours_of_corners(self):
        points = ["0 0 0 1 0 0", "1 0 0 0 1 0", "0 1 0 0 0 1", "0 0 1 1 1 1"]
        self.write_obj(points, ["1 3 2", "1 2 4", "1 4 3", "2 3 4"])
        self.repaired("in.obj")
        looks, numbers = self.looks()
        self.assertEqual((looks["has_places"], looks["has_colours"]), (False, True))
        self.assertEqual([numbers.next() for _ in range(4)], [0] * 4)
        self.assertEqual([numbers.next() for _ in range(12)], [1, 1, 1, 4, 2, 1, 5, 2, 4, 3, 4, 2])
        self.assertEqual([numbers.next() for _ in range(12)], [255, 0, 0, 255, 0, 0, 255, 255, 0, 255, 0, 255])

    def write_scene(self) -> None:
        """A tetrahedron in two places, one of them twice as large, and farther along x."""
        points = struct.pack("<12f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1)
        corners = struct.pack("<12H", 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2)
        data = base64.b64encode(points + corners).decode()
        scene = {"asset": {"version": "2.0"}, "buffers": [{"byteLength": 72, "uri": "data:application/octet-stream;base64," + data}],
                 "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
                 "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 1]},
                               {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
                 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
                 "nodes": [{"name": HOSTILE, "mesh": 0}, {"name": "large", "mesh": 0, "translation": [0.25, 0, 0], "scale": [2, 2, 2]}],
                 "scenes": [{"nodes": [0, 1]}]}
        (self.folder / "scene.gltf").write_text(json.dumps(scene), encoding="utf-8")

    def test_objects_of_a_scene_stand_in_their_places_and_are_checked_alone(self):
        self.write_scene()
        self.assertEqual(self.run_program("meshcheck", "scene.gltf", "--html", "p.html"), 1, "as one mesh they cross each other")
        markup = Elements(self.page()).names
        report = self.repaired("scene.gltf", "--scene", "each", "--format", "gltf")
        self.assertEqual([name for name in Elements(self.page()).names if name != "script"], [name for name in markup if name != "script"])
        for mesh in self.facts()["meshes"]:
            self.assertTrue(mesh["check"]["valid_solid"])
            self.assertEqual([(one["name"], one["triangles"], one["valid_solid"], one["until"]) for one in mesh["objects"]],
                             [(HOSTILE, 4, True, 4), ("large", 4, True, 8)])
            volumes = [part["volume"] for part in mesh["check"]["first_parts"]]
            self.assertAlmostEqual(volumes[0], 1 / 6)
            self.assertAlmostEqual(volumes[1], 8 / 6)
            self.assertEqual([steps / MOST * 2 * self.facts()["grid"]["half"] for steps in mesh["size"]], [2.25, 2, 2])
        self.assertEqual(report["html"]["input"]["check"]["triangles"], 8)
        self.assertEqual(self.run_program("meshcheck", "scene.gltf", "--scene", "each", "--html", "p.html"), 0)
        self.assertEqual(len(self.facts()["meshes"][0]["objects"]), 2)

    def test_meshes_without_colours_have_no_looks(self):
        self.repaired(MESHES / "cube.stl")
        self.assertEqual([mesh["looks"] for mesh in self.facts()["meshes"]], [None, None])

    def write_obj(self, points: list[str], faces: list[str]) -> None:
        text = "".join(f"v {p}\n" for p in points) + "".join(f"f {f}\n" for f in faces)
        (self.folder / "in.obj").write_text(text)

    def test_coordinates_of_any_size(self):
        for points in (["1e308 0 0", "-1e308 0 0", "0 1e308 1"], ["5e-324 0 0", "0 0 0", "0 5e-324 0"], ["1 1 1", "1 1 1", "1 1 1"],
                       ["nan 0 0", "0 1 0", "0 0 1"], ["inf 0 0", "0 -inf 0", "0 0 1"]):
            self.write_obj(points, ["1 2 3"])
            self.assertEqual(self.run_program("meshcheck", "in.obj", "--html", "p.html", "--report", "r.json"), 1)
            mesh = self.facts()["meshes"][0]
            finite = not re.search("nan|inf", " ".join(points))
            self.assertEqual((mesh["shown"], mesh["not_finite"]), (1, 0) if finite else (0, 1))
            _, places, _, _ = unpack(Elements(self.page()).scripts["mesh-0"], mesh["shown"])
            self.assertTrue(all(0 <= step <= MOST for place in places for step in place))
            self.assertFalse((self.folder / "p.html.tmp").exists())


if __name__ == "__main__":
    Pages.programs = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main()
