#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the inputs that the tests of the programs need and that are not worth keeping.

Usage: make_cli_inputs.py BSPBUILD MESH FOLDER   (trees are made of MESH by the program BSPBUILD)
"""

import base64
import gzip
import io
import json
import math
import pathlib
import random
import struct
import subprocess
import sys
import zipfile
import zlib


TEXTURED_LIBRARY = b"newmtl wood\nKd 1 0.5 0\nmap_Kd grain.png\nnewmtl steel\nKd 0.5 0.5 0.5\n"
HALVES = (((-1.5, -1.5, 0), (1.5, 1.5, 3)), ((-2, -2, 1.5), (2, 2, 5.5)))  # boxes; half of the first is in the second
SINGLE_TRIANGLE = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


def binary_stl(triangles, promised):
    corners = [(0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, float(i)) for i in range(triangles)]
    facets = [struct.pack("<12fH", 0, 0, 0, *c, 0) for c in corners]
    return b"cut".ljust(80) + struct.pack("<I", promised) + b"".join(facets)


def terrain_stl():
    """128 triangles over hills from -0.1 to 0.1, 8 by 8 quads."""
    def place(i, j):
        return (float(i), float(j), 0.1 * math.sin(i) * math.cos(j))
    facets = []
    for i in range(8):
        for j in range(8):
            a, b, c, d = place(i, j), place(i + 1, j), place(i + 1, j + 1), place(i, j + 1)
            facets += [struct.pack("<12fH", 0, 0, 0, *a, *b, *c, 0), struct.pack("<12fH", 0, 0, 0, *a, *c, *d, 0)]
    return b"terrain".ljust(80) + struct.pack("<I", len(facets)) + b"".join(facets)


def named_stl():
    """Text: a box of 3 by 3 by 3 whose sides have names, without the middle of its lid."""
    def side(name, axis, at, skip=False):
        lines = [f"solid {name}"]
        for i, j in [(i, j) for i in range(3) for j in range(3) if not skip or (i, j) != (1, 1)]:
            corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]]
            places = [tuple(corner[:axis] + [at] + corner[axis:]) for corner in corners]
            if (at > 0) == (axis == 1):
                places.reverse()
            for face in (places[:3], [places[0]] + places[2:]):
                lines += ["facet normal 0 0 0", "outer loop"]
                lines += ["vertex %d %d %d" % place for place in face] + ["endloop", "endfacet"]
        return "\n".join(lines + [f"endsolid {name}", ""])
    walls = "".join(side("walls", axis, at) for axis in (0, 1) for at in (0, 3))
    return (side("floor", 2, 0) + walls + side("the lid", 2, 3, skip=True)).encode()


def coloured_stl():
    """Two triangles with an edge in common, of different colours."""
    places = ((0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0), (0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0))
    facets = [struct.pack("<12fH", 0, 0, 0, *p, 0x8000 | colour) for p, colour in zip(places, (31, 31 << 10))]
    return b"coloured".ljust(80) + struct.pack("<I", len(facets)) + b"".join(facets)


def tetrahedron(**replaced):
    """OBJ text; replaced: lines by their name."""
    lines = {"a": "v 0 0 0", "b": "v 1 0 0", "c": "v 0 1 0", "d": "v 0 0 1", "extra": "",
             "f1": "f 1 3 2", "f2": "f 1 2 4", "f3": "f 2 3 4", "f4": "f 1 4 3"}
    lines.update(replaced)
    return "\n".join(lines.values()).encode() + b"\n"


def two_tetrahedra(size):
    """OBJ text: one of size 1, one of this size."""
    faces = "f -4 -2 -3\nf -4 -3 -1\nf -3 -2 -1\nf -4 -1 -2\n"
    parts = (f"v 0 0 0\nv {s} 0 0\nv 0 {s} 0\nv 0 0 {s}\n{faces}" for s in (1, size))
    return "".join(parts).encode()


def touching_tetrahedra():
    """OBJ text: the second is the first turned half round an edge that they share."""
    faces = "f -4 -2 -3\nf -4 -3 -1\nf -3 -2 -1\nf -4 -1 -2\n"
    parts = (f"v 0 0 0\nv {s} 0 0\nv 0 {s} 0\nv 0 0 1\n{faces}" for s in (1, -1))
    return "".join(parts).encode()


def slipped_tetrahedra():
    """OBJ text: two that cross, the second 1e-7 aside and one quarter to the right."""
    faces = "f -4 -2 -3\nf -4 -3 -1\nf -3 -2 -1\nf -4 -1 -2\n"
    parts = (f"v {x} {y} {y}\nv {x + 1} {y} {y}\nv {x} {y + 1} {y}\nv {x} {y} {y + 1}\n{faces}"
             for x, y in ((0, 0), (0.25, 1e-7)))
    return "".join(parts).encode()


def boxes(*all_corners):
    """OBJ text: boxes between two corners; with x from right to left they are hollow."""
    lines = []
    for low, high in all_corners:
        lines += ["v %.9g %.9g %.9g" % tuple((low, high)[i >> k & 1][k] for k in range(3)) for i in range(8)]
        lines += ["f " + " ".join(str(i - 8) for i in face) for face in
                  ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))]
    return "\n".join(lines).encode() + b"\n"


def project(kind, *all_corners, open_at=None):
    """A 3MF project of PrusaSlicer: one mesh of two boxes, of which the second is of this kind."""
    lines = boxes(*all_corners).decode().splitlines()
    points = [line.split()[1:] for line in lines if line.startswith("v")]
    quads = [[int(corner) % 8 for corner in line.split()[1:]] for line in lines if line.startswith("f")]
    faces = [(quad[0] + 8 * (f // 6), quad[k] + 8 * (f // 6), quad[k + 1] + 8 * (f // 6))
             for f, quad in enumerate(quads) for k in (1, 2)]
    if open_at is not None:
        faces = faces[:open_at + 1]
    core = "http://schemas.microsoft.com/3dmanufacturing/"
    vertices = "".join('<vertex x="%s" y="%s" z="%s"/>' % tuple(point) for point in points)
    triangles = "".join('<triangle v1="%d" v2="%d" v3="%d"/>' % face for face in faces)
    parts = {
        "_rels/.rels": '<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships"><Relationship '
                       f'Target="/3D/3dmodel.model" Id="r" Type="{core}2013/01/3dmodel"/></Relationships>',
        "3D/3dmodel.model": f'<model unit="millimeter" xmlns="{core}core/2015/02"><resources><object id="4"><mesh><vertices>'
                            f"{vertices}</vertices><triangles>{triangles}</triangles></mesh></object></resources>"
                            '<build><item objectid="4"/></build></model>',
        "Metadata/Slic3r_PE_model.config":
            '<config><object id="4"><metadata type="object" key="name" value="part"/>' + "".join(
                f'<volume firstid="{first}" lastid="{last}"><metadata type="volume" key="name" value="{name}"/>'
                f'<metadata type="volume" key="volume_type" value="{its_kind}"/></volume>'
                for first, last, name, its_kind in ((0, 11, "first", "ModelPart"), (12, len(faces) - 1, "second", kind)))
            + "</object></config>",
    }
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in parts.items():
            archive.writestr(zipfile.ZipInfo(name), text)
    return data.getvalue()


def scene() -> bytes:
    """Two tetrahedra that overlap, the first without a face, and a sheet."""
    first = tetrahedron(f3="").decode()
    second = "v 0.1 0.1 0.1\nv 1.1 0.1 0.1\nv 0.1 1.1 0.1\nv 0.1 0.1 1.1\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 5 8 7\n"
    sheet = "v 0 0 9\nv 1 0 9\nv 0 1 9\nf 9 10 11\n"
    return f"o open\n{first}o whole\n{second}o sheet\n{sheet}".encode()


def torn() -> bytes:
    """A tetrahedron whose four triangles have corners of their own, one of them a thousandth aside."""
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    lines = []
    for number, triangle in enumerate(((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))):
        lines += ["v %r %r %r" % (corners[k][0] + (number == 0) * 0.001, *corners[k][1:]) for k in triangle]
    lines += [f"f {3 * i + 1} {3 * i + 2} {3 * i + 3}" for i in range(4)]
    return "\n".join(lines).encode()


def revolved(profile: list[tuple[float, float]]) -> bytes:
    """Quadrilaterals around the z axis, from radii and heights."""
    sides = 24
    angles = [2 * math.pi * i / sides for i in range(sides)]
    points = [(r * math.cos(a), r * math.sin(a), z) for r, z in profile for a in angles]
    lines = ["v %r %r %r" % point for point in points]
    for k in range(len(profile) - 1):
        for i in range(sides):
            a, b = k * sides + i + 1, k * sides + (i + 1) % sides + 1
            lines += [f"f {a} {a + sides} {b + sides} {b}"]
    return "\n".join(lines + [""]).encode()


def mug() -> bytes:
    """A solid with a wall of 0.1 around a hollow that is 1.8 wide and 1.9 deep."""
    return revolved([(0, 0), (1, 0), (1, 2), (0.9, 2), (0.9, 0.1), (0, 0.1)])


def pierced_can() -> bytes:
    """A can with a hole of 0.1 in its lid and another in its bottom. Points are there twice where it begins and ends."""
    return revolved([(0.05, 0), (0.05, 0.1), (0.9, 0.1), (0.9, 1.9), (0.05, 1.9), (0.05, 2), (1, 2), (1, 0), (0.05, 0)])


def painted_picture():
    """glTF text: a triangle with a colour and a picture in it that is mirrored beyond its edges."""
    data = struct.pack("<9f6f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 2)
    paint = {"baseColorFactor": [1, 0.5, 0, 1], "baseColorTexture": {"index": 0}}
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "material": 0}]}],
        "materials": [{"name": "paint", "pbrMetallicRoughness": paint}],
        "textures": [{"source": 0, "sampler": 0}], "samplers": [{"wrapS": 33648}],
        "images": [{"uri": "data:image/png;base64," + base64.b64encode(png()).decode()}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 24}],
        "buffers": [{"byteLength": len(data), "uri": "data:;base64," + base64.b64encode(data).decode()}],
    }).encode()


def dancer():
    """glTF text: a tetrahedron without a face, with a skin and a morph target, and a node that is hidden."""
    corners = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]
    data = struct.pack("<12f", *corners) + struct.pack("<16B", *[0, 1, 0, 0] * 4)
    data += struct.pack("<16f", *[0.25, 0.75, 0, 0] * 4) + struct.pack("<9H", 0, 2, 1, 0, 1, 3, 1, 2, 3)
    views, sizes = [], (48, 16, 64, 18)
    for size in sizes:
        views.append({"buffer": 0, "byteOffset": sum(v["byteLength"] for v in views), "byteLength": size})
    kinds = ((5126, 4, "VEC3"), (5121, 4, "VEC4"), (5126, 4, "VEC4"), (5123, 9, "SCALAR"))
    primitive = {"attributes": {"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}, "indices": 3, "targets": [{"POSITION": 0}]}
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
        "nodes": [{"name": "bone", "children": [3]}, {"name": "body", "mesh": 0, "skin": 0},
                  {"name": "stone", "mesh": 0, "extensions": {"KHR_node_visibility": {"visible": False}}}, {"name": "hand"}],
        "extensionsUsed": ["KHR_node_visibility"], "skins": [{"joints": [0, 3]}],
        "meshes": [{"primitives": [primitive], "weights": [0.5]}],
        "accessors": [{"bufferView": i, "componentType": kind, "count": count, "type": shape}
                      for i, (kind, count, shape) in enumerate(kinds)],
        "bufferViews": views,
        "buffers": [{"byteLength": len(data), "uri": "data:;base64," + base64.b64encode(data).decode()}],
    }).encode()


def textured_boxes():
    """OBJ text: two boxes that overlap, each with a picture on all sides and a material of its own."""
    text = b"mtllib textured.mtl\n"
    for name, low, high in (("wood", (0, 0, 0), (1, 1, 1)), ("steel", (0.5, 0.25, 0.25), (1.5, 0.75, 0.75))):
        corners = b"vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl %s\n" % name.encode()
        for line in boxes((low, high)).splitlines():
            if line.startswith(b"f"):
                line = b"f " + b" ".join(b"%s/%d" % (p, i - 4) for i, p in enumerate(line.split()[1:]))
                text += corners
                corners = b""
            text += line + b"\n"
    return text


def painted_tetrahedron(place, roughness):
    """glTF text: a material that only glTF can hold."""
    corners = [place, 0, 0, place + 1, 0, 0, place, 1, 0, place, 0, 1]
    indices = [0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2]
    data = struct.pack("<12f12H", *corners, *indices)
    return json.dumps({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"name": "paint", "pbrMetallicRoughness": {"roughnessFactor": roughness}}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
        "buffers": [{"byteLength": len(data),
                     "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
    }).encode()


def row_of_tetrahedra(count):
    """OBJ text of some 100 bytes for each."""
    faces = "f -4 -2 -3\nf -4 -3 -1\nf -3 -2 -1\nf -4 -1 -2\n"
    parts = (f"v {x} 0 0\nv {x + 1} 0 0\nv {x} 1 0\nv {x} 0 1\n{faces}" for x in range(0, 2 * count, 2))
    return "".join(parts).encode()


def random_triangles(count):
    """Large triangles that all cross each other: about a minute of work for 1000 of them."""
    chance = random.Random(1)
    lines = ["OFF", f"{3 * count} {count} 0"]
    for _ in range(3 * count):
        lines.append(" ".join(f"{chance.uniform(-1, 1):.6f}" for _ in range(3)))
    for i in range(0, 3 * count, 3):
        lines.append(f"3 {i} {i + 1} {i + 2}")
    return "\n".join(lines).encode() + b"\n"


def lines_of(points):
    return "".join("%.9g %.9g %.9g\n" % p for p in points).encode()


def sphere_points(count):
    """Along a spiral from pole to pole, evenly by area."""
    points = []
    for i in range(count):
        z = 1 - (2 * i + 1) / count
        angle = i * math.pi * (3 - math.sqrt(5))
        points.append((math.sqrt(1 - z * z) * math.cos(angle), math.sqrt(1 - z * z) * math.sin(angle), z))
    return points


def hill_points(count):
    chance = random.Random(1)
    places = [(chance.random(), chance.random()) for _ in range(count)]
    return [(x, y, 0.1 * math.sin(7 * x) * math.cos(5 * y)) for x, y in places]


def noise_points(count):
    """No surface at all."""
    chance = random.Random(1)
    return [(chance.random(), chance.random(), chance.random()) for _ in range(count)]


def noisy(points, deviation):
    chance = random.Random(1)
    return [tuple(x + chance.gauss(0, deviation) for x in p) for p in points]


def binary_pcd(points, promised):
    header = ("VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH %d\nHEIGHT 1\n"
              "POINTS %d\nDATA binary\n" % (promised, promised))
    return header.encode() + b"".join(struct.pack("<3f", *p) for p in points)


def png():
    """One pixel."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    return (b"\x89PNG\r\n\x1A\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(bytes([0, 200, 150, 100]))) + chunk(b"IEND", b""))


def zip_of(parts):
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in parts.items():
            archive.writestr(name, content)
    return data.getvalue()


def zstd_of(data):
    """A frame of one block that is stored as it is."""
    return b"\x28\xB5\x2F\xFD\0\x50" + struct.pack("<I", len(data) << 3 | 1)[:3] + data


def packed_files():
    tetrahedron_gz = gzip.compress(tetrahedron())
    return {
        "packed.obj.gz": tetrahedron_gz,
        "packed.obj.zst": zstd_of(tetrahedron()),
        "packed.xyz.gz": gzip.compress(lines_of(sphere_points(1500))),
        "packed.zip": zip_of({"read.me": b"", "part/a.obj": tetrahedron()}),
        "packed_textured.obj.gz": gzip.compress(textured_boxes()),
        "packed_textured.zip": zip_of({"a/part.obj": textured_boxes(), "a/textured.mtl": TEXTURED_LIBRARY,
                                       "a/grain.png": png()}),
        "packed_several.zip": zip_of({"a.obj": tetrahedron(), "b.stl": tetrahedron(), "c.txt": b""}),
        "packed_none.zip": zip_of({"read.me": b"1 mesh"}),
        "packed_cut.obj.gz": tetrahedron_gz[:-9],
        "packed_damaged.obj.gz": tetrahedron_gz[:-8] + b"abcd" + tetrahedron_gz[-4:],
        "packed_twice.obj.gz": gzip.compress(tetrahedron_gz),
        "packed_bomb.obj.gz": gzip.compress(bytes(1 << 26)),
        "packed_many.xyz.gz": gzip.compress(lines_of(hill_points(300000)), 1),
    }


def tree_of(bspbuild, mesh):
    return subprocess.run([bspbuild, "--quiet", "-", "-o", "-"], input=mesh, check=True,
                          stdout=subprocess.PIPE).stdout


def altered(tree):
    middle = len(tree) // 2
    return tree[:middle] + bytes([tree[middle] ^ 0xFF]) + tree[middle + 1:]


def main():
    bspbuild, mesh, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
    folder.mkdir(parents=True, exist_ok=True)
    tree = tree_of(bspbuild, pathlib.Path(mesh).read_bytes())
    files = {
        "empty.stl": b"",
        "nothing.off": b"OFF\n0 0 0\n",
        "nothing.obj": b"# nothing is solid\n",
        "nothing.stl": bytes(84),
        "points_only.off": b"OFF\n1 0 0\n0 0 0\n",
        "cut.stl": binary_stl(triangles=7, promised=100),
        "cut_to_nothing.stl": binary_stl(triangles=0, promised=100),
        "text.ply": b"This is no mesh.\n",
        "binary.obj": bytes(range(256)) * 4,
        "unknown.xyz": b"Some words, and no mesh.\n",
        "index_out_of_range.obj": tetrahedron(extra="f 1 2 9"),
        "nan.obj": tetrahedron(extra="v nan nan nan", f1="f 1 3 2\nf 1 2 5"),
        "not_finite.obj": tetrahedron(a="v nan 0 0", b="v inf 0 0", c="v 0 nan 0"),
        "single_triangle.obj": SINGLE_TRIANGLE,
        "far_left.obj": b"v -1.5e308 0 0\nv -1.5e308 1e308 0\nv -1.5e308 0 1e308\nf 1 2 3\n",
        "far_right.obj": b"v 1.5e308 0 0\nv 1.5e308 1e308 0\nv 1.5e308 0 1e308\nf 1 2 3\n",
        "tiny.obj": b"v 0 0 0\nv 1e-170 0 0\nv 0 1e-170 0\nf 1 2 3\n",
        "tiny_aside.obj": b"v 0 0 1e-170\nv 1e-170 0 1e-170\nv 0 1e-170 1e-170\nf 1 2 3\n",
        "painted.gltf": painted_tetrahedron(0, 0.25),
        "painted_pictures.gltf": painted_picture(),
        "dancer.gltf": dancer(),
        "painted_too.gltf": painted_tetrahedron(0.25, 0.5),
        "textured.obj": textured_boxes(),
        "scene.obj": scene(),
        "negative.3mf": project("NegativeVolume", *HALVES),
        "modifier.3mf": project("ParameterModifier", *HALVES),
        "open_negative.3mf": project("NegativeVolume", *HALVES, open_at=13),
        "all_negative.3mf": project("NegativeVolume", HALVES[0], ((-9, -9, -9), (9, 9, 9))),
        "torn.obj": torn(),
        "near_boxes.obj": boxes(((0, 0, 0), (3, 3, 1)), ((1, 1, 1.00001), (2, 2, 2))),
        "plate.obj": boxes(((0, 0, 0), (3, 3, 1))),
        "short_drill.obj": boxes(((1, 1, -1), (2, 2, 0.99999))),
        "mug.obj": mug(),
        "pierced_can.obj": pierced_can(),
        "undefined.obj": b"mtllib textured.mtl\nusemtl tin\n" + tetrahedron(f1="f 1 3 2\nusemtl wood"),
        "coloured_sides.stl": coloured_stl(),
        "named_sides.stl": named_stl(),
        "terrain.stl": terrain_stl(),
        "textured.mtl": TEXTURED_LIBRARY,
        "grain.png": png(),
        "huge.obj": tetrahedron(b="v 1e12 0 0", c="v 0 1e12 0", d="v 0 0 1e12"),
        "inside_out.obj": tetrahedron(f1="f 1 2 3", f2="f 1 4 2", f3="f 2 4 3", f4="f 1 3 4"),
        "one_flipped.obj": tetrahedron(f1="f 1 2 3"),
        "open.obj": tetrahedron(f3=""),
        "touching.obj": touching_tetrahedra(),
        # A slit and a fin of 1e-7, and a post through each of them.
        "slit.obj": boxes(((0, 0, 0), (1, 1, 1)), ((0.8, 0.2, 0.5), (0.2, 0.8, 0.5 + 1e-7)),
                          ((0.7, 0.7, 0.2), (0.9, 0.9, 1.8))),
        "poking_cavity.obj": boxes(((0, 0, 0), (1, 1, 1)), ((0.8, 0.2, 0.2), (0.2, 0.8, 1.01))),
        "half_way_out.obj": boxes(((0, 0, 0), (1, 1, 1)), ((0.7, 0.3, 0.4), (0.3, 0.7, 1.35))),
        "nested_boxes.obj": boxes(((0, 0, 0), (8, 8, 8)), ((6, 2, 2), (2, 6, 6)), ((3, 3, 3), (5, 5, 5)),
                                  ((20, 0, 0), (23, 3, 3)), ((0, 20, 0), (1, 21, 1))),
        "fin.obj": boxes(((0, 0, 0), (1, 1, 1)), ((-0.5, -0.5, 0.5), (1.5, 1.5, 0.5 + 1e-7))),
        "slipped.obj": slipped_tetrahedra(),
        "far_point.obj": two_tetrahedra(size=10 ** 9),
        "larger_than_a_pipe.obj": row_of_tetrahedra(4000),
        "much_work.off": random_triangles(1000),
        "sphere.xyz": lines_of(sphere_points(1500)),
        "sphere.obj": b"".join(b"v " + line for line in lines_of(sphere_points(1500)).splitlines(True)),
        "odd_sphere.xyz": lines_of(sphere_points(1500)) + b"9 9 9\nnan 0 0\n0 0 0 what\nwhat\n"
                          + lines_of(sphere_points(1500)[:3]),
        "cut_sphere.pcd": binary_pcd(sphere_points(1500), promised=10 ** 15),
        "hills.xyz": lines_of(hill_points(2000)),
        "cap.xyz": lines_of(p for p in sphere_points(4000) if p[2] > 0.4),
        "noisy_sphere.xyz": lines_of(noisy(sphere_points(5000), 0.07)),
        "noise.xyz": lines_of(noise_points(2000)),
        "line.xyz": lines_of([(i, 2 * i, 3 * i) for i in range(100)]),
        "plane.xyz": lines_of([(i % 20, i // 20, 0) for i in range(400)]),
        "many.xyz": lines_of(hill_points(300000)),
        "words.pcd": b"VERSION 0.7\nSome words.\n",
        "unlabelled.bsp": tree,
        "flat.bsp": tree_of(bspbuild, SINGLE_TRIANGLE),
        "cut.bsp": tree[:len(tree) // 2],
        "altered.bsp": altered(tree),
        "newer.bsp": tree[:8] + struct.pack("<I", 2) + tree[12:],
        "packed.bsp.gz": gzip.compress(tree),
        **packed_files(),
    }
    for name, data in files.items():
        (folder / name).write_bytes(data)


if __name__ == "__main__":
    main()
