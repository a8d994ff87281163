#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Random projects of slicers through the programs: ids, settings and paint stay.

Usage: slicer_projects_test.py PROGRAMS [COUNT]   (the folder of the programs; MESHREPAIR_TEST_SHARE of 200)
"""

import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ET
import zipfile

PROGRAMS = pathlib.Path(sys.argv[1])
COUNT = int(sys.argv[2]) if len(sys.argv) > 2 else max(10, int(200 * float(os.environ.get("MESHREPAIR_TEST_SHARE", "1"))))
CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
PRUSA = "http://schemas.slic3r.org/3mf/2017/06"
PRUSA_TYPES = ("ModelPart", "NegativeVolume", "ParameterModifier", "SupportBlocker", "SupportEnforcer")
ORCA_TYPES = ("normal_part", "negative_part", "modifier_part", "support_blocker", "support_enforcer")
PRUSA_PAINT = ("slic3rpe:mmu_segmentation", "slic3rpe:custom_supports", "slic3rpe:custom_seam")
ORCA_PAINT = ("paint_color", "paint_supports", "paint_seam", "paint_fuzzy_skin")


def paint_code(chance, depth):
    """Digits in the order in which they are read; divided up to `depth` times."""
    sides = chance.randrange(4) if depth > 0 else 0
    if sides:
        first = 0 if sides == 3 else chance.randrange(3)
        return [sides | first << 2] + [digit for _ in range(sides + 1) for digit in paint_code(chance, depth - 1)]
    state = chance.randrange(1, 20)
    if state < 3:
        return [state << 2]
    return [12] + [15] * ((state - 3) // 15) + [(state - 3) % 15]


def code_text(chance):
    return "".join("%X" % digit for digit in reversed(paint_code(chance, 4)))


def box(chance):
    """Points and triangles; some have a hole, or a triangle that faces inward."""
    low = [chance.randrange(-50, 50) for _ in range(3)]
    size = [chance.randrange(1, 30) for _ in range(3)]
    points = [tuple(low[k] + (i >> k & 1) * size[k] for k in range(3)) for i in range(8)]
    triangles = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4),
                 (2, 6, 7), (2, 7, 3), (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5)]
    kind = chance.randrange(3)
    if kind == 1:
        del triangles[chance.randrange(12)]
    if kind == 2:
        t = chance.randrange(12)
        triangles[t] = (triangles[t][0], triangles[t][2], triangles[t][1])
    return points, triangles


def painted(chance, triangles, names):
    return [{name: code_text(chance) for name in names if chance.random() < 0.4} for _ in triangles]


def mesh_xml(points, triangles, paint):
    vertices = "".join('<vertex x="%d" y="%d" z="%d"/>' % point for point in points)
    faces = "".join('<triangle v1="%d" v2="%d" v3="%d"' % corners
                    + "".join(f' {name}="{code}"' for name, code in codes.items()) + "/>"
                    for corners, codes in zip(triangles, paint))
    return f"<mesh><vertices>{vertices}</vertices><triangles>{faces}</triangles></mesh>"


def prusa_project(chance):
    """The model and the settings; each object is one mesh, and its volumes ranges of triangles."""
    objects, settings, items = "", "", ""
    for number in chance.sample(range(1, 50), chance.randrange(1, 4)):
        points, triangles, paint, volumes = [], [], [], ""
        for v in range(chance.randrange(1, 4)):
            its_points, its_triangles = box(chance)
            volumes += (f'<volume firstid="{len(triangles)}" lastid="{len(triangles) + len(its_triangles) - 1}">'
                        f'<metadata type="volume" key="name" value="v{v}"/><metadata type="volume" key="volume_type" '
                        f'value="{chance.choice(PRUSA_TYPES)}"/><metadata type="volume" key="fill_density" '
                        f'value="{chance.randrange(100)}%"/></volume>\n')
            triangles += [tuple(corner + len(points) for corner in t) for t in its_triangles]
            points += its_points
            paint += painted(chance, its_triangles, PRUSA_PAINT)
        objects += f'<object id="{number}" type="model">{mesh_xml(points, triangles, paint)}</object>'
        settings += f'<object id="{number}" instances_count="1"><metadata type="object" key="name" value="o{number}"/>{volumes}</object>\n'
        items += f'<item objectid="{number}" printable="{chance.randrange(2)}"/>' * chance.randrange(1, 3)
    return model(objects, items), ("Metadata/Slic3r_PE_model.config", f"<config>\n{settings}</config>\n"), {}


def orca_project(chance):
    """The same with components, which are in another part or not."""
    objects, parts, settings, items, plates = "", "", "", "", ""
    path = chance.choice(("", ' p:path="/3D/Objects/object_1.model"'))
    ids = iter(chance.sample(range(1, 50), 12))
    for _ in range(chance.randrange(1, 4)):
        components, volumes, number = "", "", next(ids)
        for _ in range(chance.randrange(1, 4)):
            mesh = next(ids, None)
            if mesh is None:
                break
            points, triangles = box(chance)
            parts += f'<object id="{mesh}" type="model">{mesh_xml(points, triangles, painted(chance, triangles, ORCA_PAINT))}</object>'
            components += f'<component objectid="{mesh}"{path}/>'
            volumes += (f'<part id="{mesh}" subtype="{chance.choice(ORCA_TYPES)}"><metadata key="name" value="m{mesh}"/>'
                        f'<metadata key="extruder" value="{chance.randrange(1, 5)}"/></part>\n')
        if not components:
            break
        objects += f'<object id="{number}" type="model"><components>{components}</components></object>'
        settings += f'<object id="{number}"><metadata key="name" value="o{number}"/>{volumes}</object>\n'
        items += f'<item objectid="{number}"/>'
        plates += f'<model_instance><metadata key="object_id" value="{number}"/></model_instance>'
    others = {"3D/Objects/object_1.model": model(parts, "")} if path else {}
    settings = f"<config>\n{settings}<plate>{plates}</plate></config>\n"
    return model(objects if path else parts + objects, items), ("Metadata/model_settings.config", settings), others


def model(resources, items):
    return (f'<?xml version="1.0" encoding="UTF-8"?>\n<model unit="millimeter" xmlns="{CORE}" xmlns:slic3rpe="{PRUSA}" '
            'xmlns:p="http://schemas.microsoft.com/3dmanufacturing/production/2015/06">'
            f"<resources>{resources}</resources><build>{items}</build></model>")


def write(path, project):
    text, config, others = project
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("_rels/.rels", '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
                         '<Relationship Target="/3D/3dmodel.model" Id="rel0" '
                         'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>')
        archive.writestr("3D/3dmodel.model", text)
        archive.writestr(*config)
        archive.writestr("Metadata/project_settings.config", '{"filament_colour": ["#FF0000"]}')
        for name, bytes_of in others.items():
            archive.writestr(name, bytes_of)


def rotated(corners):
    """The same corners, the least first."""
    least = corners.index(min(corners))
    return corners[least:] + corners[:least]


def turned(corners):
    return (corners[0], corners[2], corners[1])


def meshes_of(texts):
    """Of each id the triangles, as corners in the order of the file and their paint."""
    meshes = {}
    for text in texts:
        for thing in ET.fromstring(text).iter(f"{{{CORE}}}object"):
            points = [tuple(float(v.get(k)) for k in "xyz") for v in thing.iter(f"{{{CORE}}}vertex")]
            meshes[int(thing.get("id"))] = [
                (tuple(points[int(t.get(k))] for k in ("v1", "v2", "v3")),
                 {name.replace(f"{{{PRUSA}}}", "slic3rpe:"): code for name, code in t.attrib.items() if len(name) > 3})
                for t in thing.iter(f"{{{CORE}}}triangle")]
    return meshes


def graph_of(text):
    """Components by the ids of their objects, and items."""
    root = ET.fromstring(text)
    components = {int(one.get("id")): [c.get("objectid") for c in one.iter(f"{{{CORE}}}component")]
                  for one in root.iter(f"{{{CORE}}}object")}
    return components, [(i.get("objectid"), i.get("printable")) for i in root.iter(f"{{{CORE}}}item")]


class Projects(unittest.TestCase):
    def convert(self, program, folder, options=()):
        result = subprocess.run([PROGRAMS / program, "-q", folder / "in.3mf", folder / "out.3mf", *options],
                                capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)
        with zipfile.ZipFile(folder / "out.3mf") as archive:
            return {name: archive.read(name).decode() for name in archive.namelist()}

    def check_paint(self, before, after):
        """Each triangle that is still there, in its place or turned over, has its code."""
        self.assertEqual(set(before), set(after))
        for number, triangles in before.items():
            now = {}
            for corners, paint in after[number]:
                now.setdefault(rotated(corners), []).append((corners, paint))
            for corners, paint in triangles:
                same = now.get(rotated(corners), [])
                flipped = now.get(rotated(turned(corners)), [])
                if same and any(c == corners for c, _ in same):
                    self.assertIn((corners, paint), same)
                else:
                    self.assertTrue(same or flipped, f"a triangle of {number} is gone")
                    self.assertIn(set(paint), [set(p) for _, p in same + flipped])

    def check_ranges(self, project, text, triangles_of):
        """Ranges follow each other and cover their mesh."""
        for thing in ET.fromstring(text).iter("object"):
            ranges = [(int(v.get("firstid")), int(v.get("lastid"))) for v in thing.iter("volume")]
            ends = [-1] + [last for _, last in ranges]
            self.assertEqual([first for first, _ in ranges], [end + 1 for end in ends[:-1]], project)
            self.assertEqual(ends[-1] + 1, triangles_of[int(thing.get("id"))])

    def one(self, seed, folder):
        chance = random.Random(seed)
        is_prusa = seed % 2 == 0
        project = (prusa_project if is_prusa else orca_project)(chance)
        write(folder / "in.3mf", project)
        before = meshes_of([project[0], *project[2].values()])
        for program, options in (("meshrepair", ("--scene", "each")), ("meshconvert", ())):
            parts = self.convert(program, folder, options)
            after = meshes_of([parts["3D/3dmodel.model"]])
            own = {number: mesh for number, mesh in before.items() if mesh}
            self.check_paint(own, {number: mesh for number, mesh in after.items() if mesh})
            config = parts[project[1][0]]
            if is_prusa:
                self.check_ranges(project[1][1], config, {number: len(mesh) for number, mesh in after.items()})
                same = re.compile(r'(firstid|lastid)="\d+"')
                self.assertEqual(same.sub("", config), same.sub("", project[1][1]))
            else:
                self.assertEqual(config, project[1][1])
            components, items = graph_of(parts["3D/3dmodel.model"])
            given, given_items = graph_of(project[0])
            self.assertEqual({n: c for n, c in components.items() if c}, {n: c for n, c in given.items() if c})
            self.assertEqual(items, given_items)
            self.assertIn("Metadata/project_settings.config", parts)
            if program == "meshconvert":
                self.assertEqual(after | {n: [] for n, m in before.items() if not m},
                                 before | {n: [] for n, m in after.items() if not m})

    def test_random_projects(self):
        with tempfile.TemporaryDirectory() as folder:
            for seed in range(COUNT):
                with self.subTest(seed=seed):
                    self.one(seed, pathlib.Path(folder))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
