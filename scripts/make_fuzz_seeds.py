#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the files in tests/fuzz/seeds: small inputs that the fuzz targets start from, a folder for each
target. Between them they show every dialect of a format and every command of a decoder once.

The same files come out on every machine. Files that this script does not make, such as findings that
were mended, are left alone.

Usage: make_fuzz_seeds.py [--check]   (--check: compare with what is there, write nothing)
"""

import base64
import io
import itertools
import json
import math
import pathlib
import random
import struct
import sys
import zipfile
import zlib

FOLDER = pathlib.Path(__file__).resolve().parent.parent / "tests" / "fuzz" / "seeds"

TETRAHEDRON = ([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
               [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)])


# ---- meshes

def ascii_stl(name, triangles):
    lines = [f"solid {name}"]
    for corners in triangles:
        lines += ["facet normal 0 0 0", " outer loop"]
        lines += ["  vertex " + " ".join(map(str, corner)) for corner in corners]
        lines += [" endloop", "endfacet"]
    return ("\n".join(lines + [f"endsolid {name}"]) + "\n").encode()


def binary_stl(triangles, header=b"seed", count=None, tail=b"", words=None):
    data = header.ljust(80) + struct.pack("<I", len(triangles) if count is None else count)
    for corners, word in zip(triangles, words or [0] * len(triangles)):
        data += struct.pack("<3f", 0, 0, 1) + struct.pack("<9fH", *itertools.chain(*corners), word)
    return data + tail


def stl_seeds():
    points, faces = TETRAHEDRON
    triangles = [[points[i] for i in face] for face in faces]
    two = ascii_stl("solid of facets", triangles[:1]) + ascii_stl("", triangles[1:2])
    return {
        "ascii": ascii_stl("a", triangles),
        "ascii_two_solids": two,
        "ascii_windows": two.replace(b"\n", b"\r\n").upper(),
        "ascii_numbers": ascii_stl("n", [[("nan", "-inf", "1e999"), ("+1.", ".5", "-0"),
                                          ("1e-320", "0x1", "1,5")]] + triangles[:1]),
        "ascii_cut": ascii_stl("a", triangles)[:-70],
        "ascii_polygon": ascii_stl("q", [[(0, 0, 0), (2, 0, 0), (2, 2, 0), (1, 1, 0), (0, 2, 0)]]),
        "ascii_named": ascii_stl("inlet", triangles[:1]) + ascii_stl("out let", triangles[1:3])
                       + ascii_stl("", triangles[3:]).replace(b"endsolid ", b"endsolid late"),
        "binary": binary_stl(triangles),
        "binary_regions": binary_stl(triangles, words=(1, 2, 2, 0)),
        "binary_solid": binary_stl(triangles, b"solid or not"),
        "binary_wrong_count": binary_stl(triangles, count=2 ** 32 - 1, tail=b"tail"),
        "binary_no_numbers": binary_stl([[(math.nan, math.inf, -0.0), (1, 2, 3), (1e38, 0, 0)]]),
    }


def obj_seeds():
    points = "".join(f"v {x} {y} {z}\n" for x, y, z in TETRAHEDRON[0])
    texts = {
        "plain": points + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n",
        "relative": points + "f -4 -2 -3\nf 1 -1 2\n",
        "references": points + "vt 0 0\nvn 0 0 1\nf 1/1/1 2//1 3/1\nf 1/ 2/ 4/\n",
        "polygon": "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 1 0\nv 0 2 0\nf 1 2 3 4 5\nfo 1 2 3\n",
        "continued": "v 0 0 \\\n 0\nv 1 0 0\nv 0 1 0\nf 1 \\\r\n 2 3\n",
        "colours": "# c\nmtllib a b.mtl\no one\ng two\ns off\nusemtl m\nv 0 0 0 1 .5 0\nv 1 0 0 2\n"
                   "v 0 1 0\nl 1 2\np 1\nf 1 2 3\n",
        "numbers": "v nan inf -1.#IND\nv 1e999 -0 1e-400\nv 1,5 x 3\nv 1\nf 1 2 3\nf 1 2 3 4\n",
        "bad_faces": points + "f 1 2 9\nf 0 1 2\nf 1 2\nf a b c\nf 1 2 3 99999999999999999999\nf 1 2 3\n",
    }
    return {name: text.encode() for name, text in texts.items()}


def threemf_seeds():
    """Models, which the target puts into packages, and packages."""
    core = "http://schemas.microsoft.com/3dmanufacturing/"
    points, faces = TETRAHEDRON
    vertices = "".join(f'<vertex x="{x}" y="{y}" z="{z}"/>' for x, y, z in points)

    def mesh(number, triangle="", attributes=""):
        triangles = "".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"{triangle}/>' for a, b, c in faces)
        return (f'<object id="{number}"{attributes}><mesh><vertices>{vertices}</vertices>'
                f"<triangles>{triangles}</triangles></mesh></object>")

    def model(resources, items='<item objectid="1"/>', head=""):
        return (f'<model unit="millimeter" xmlns="{core}core/2015/02" xmlns:m="{core}material/2015/02" '
                f'xmlns:p="{core}production/2015/06">{head}<resources>{resources}</resources>'
                f"<build>{items}</build></model>").encode()

    def package(parts):
        data = io.BytesIO()
        with zipfile.ZipFile(data, "w", zipfile.ZIP_STORED) as archive:
            for name, content in parts.items():
                archive.writestr(zipfile.ZipInfo(name), content)
        return data.getvalue()

    def relationships(target):
        return (f'<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">'
                f'<Relationship Target="{target}" Id="r" Type="{core}2013/01/3dmodel"/></Relationships>')

    turn = 'transform="0 -1 0 1 0 0 0 0 -1 5 6 7.5"'
    base = '<basematerials id="5"><base name="a" displaycolor="#FF0000"/></basematerials>'
    colours = '<m:colorgroup id="6"><m:color color="#000000"/><m:color color="#0000FF80"/></m:colorgroup>'
    texture = ('<m:texture2d id="7" path="/3D/a.png" contenttype="image/png"/><m:texture2dgroup id="8" texid="7">'
               '<m:tex2coord u="0.5" v="1e-3"/></m:texture2dgroup>')
    layers = '<m:multiproperties id="9" pids="5 8 6"><m:multi pindices="0 0 1"/></m:multiproperties>'
    sets = (f'<t:trianglesets xmlns:t="{core}trianglesets/2021/07"><t:triangleset name="s" identifier="i"><t:ref index="0"/>'
            '<t:refrange startindex="2" endindex="3"/></t:triangleset></t:trianglesets>')
    beams = f"{core}beamlattice/2017/02"
    lattice = (f'<b:beamlattice xmlns:b="{beams}" radius="0.1" minlength="0.01" ballmode="mixed" ballradius="0.2" cap="butt"><b:beams>'
               '<b:beam v1="0" v2="1"/><b:beam v1="1" v2="2" r1="0.1" r2="0.2" cap1="hemisphere" cap2="sphere"/></b:beams>'
               '<b:balls><b:ball vindex="3" r="0.3"/></b:balls></b:beamlattice>')
    plain = model(mesh(1))
    ranges = (b'<config><object id="1" instances_count="1"><metadata type="object" key="name" value="a"/>'
              b'<volume firstid="0" lastid="1"><metadata type="volume" key="volume_type" value="ModelPart"/></volume>'
              b'<volume firstid="2" lastid="3"><metadata type="volume" key="modifier" value="1"/></volume></object></config>')
    parts = (b'<config><object id="2"><part id="1" subtype="normal_part"><mesh_stat face_count="4"/></part>'
             b'<part id="1" subtype="negative_part"/></object><plate><metadata key="gcode_file" value="a.gcode"/>'
             b'<model_instance><metadata key="object_id" value="2"/></model_instance></plate>'
             b'<assemble><assemble_item object_id="2"/></assemble></config>')
    halves = model(mesh(1, ' paint_color="8483" paint_seam="0C"') + '<object id="2"><components>'
                   f'<component objectid="1"/><component objectid="1" {turn}/></components></object>',
                   '<item objectid="2"/><item objectid="1" printable="0" transform="-1 0 0 0 1 0 0 0 1 9 0 0"/>')
    cura = ('<metadatagroup><metadata name="c:infill_mesh">True</metadata></metadatagroup>')
    return {
        "plain": plain,
        "ranges": plain + b"\x01" + ranges,
        "parts": halves + b"\x01" + parts,
        "cura": model(mesh(1) + mesh(2).replace("<mesh>", cura + "<mesh>"), '<item objectid="1"/><item objectid="2"/>')
                .replace(b"<model ", b'<model xmlns:c="http://software.ultimaker.com/xml/cura/3mf/2015/10" '),
        "components": model(mesh(1) + f'<object id="2"><components><component objectid="1" {turn}/>'
                            '<component objectid="1"/></components></object>', f'<item objectid="2" {turn}/>'),
        "materials": model(base + mesh(1, ' pid="5" p1="0"', ' name="n" pid="5" pindex="0"')),
        "colours": model(colours + mesh(1, ' pid="6" p1="0" p2="1" p3="1"')),
        "layers": model(base + colours + texture + layers + mesh(1, ' pid="9" p1="0"')),
        "lattice": model(mesh(1).replace("</mesh>", lattice + "</mesh>")),
        "sets": model(mesh(1).replace("</mesh>", sets + "</mesh>")),
        "metadata": model(mesh(1), head='<metadata name="Title" preserve="1">a &amp; b</metadata>'),
        "numbers": model(mesh(1).replace('"1"', '"nan"', 3).replace('"0"', '"1,5"', 2)),
        "package": package({"[Content_Types].xml": "<Types/>", "_rels/.rels": relationships("/3D/a.model"),
                            "3D/a.model": plain, "Metadata/thumbnail.png": "x"}),
        "package_of_parts": package({"_rels/.rels": relationships("a.model"), "b.model": plain,
                                     "a.model": model("", '<item objectid="1" p:path="/b.model"/>')}),
        "package_texture": package({"a.model": model(texture + mesh(1, ' pid="8" p1="0"')), "3D/a.png": "\x89PNG"}),
    }


def off_seeds():
    body = "4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"
    rows = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]

    def with_extra(keyword, extra, face="3 0 1 2"):
        lines = [keyword, "3 1 0"] + [f"{x} {y} {z} {extra}".strip() for x, y, z in rows] + [face]
        return ("\n".join(lines) + "\n").encode()

    def binary(keyword, counts, extra=b""):
        data = keyword.encode() + b" BINARY\n" + struct.pack(">%di" % len(counts), *counts)
        for row in rows:
            data += struct.pack(">3f", *row) + extra
        return data + struct.pack(">5i", 3, 0, 1, 2, 0) + struct.pack(">5i", 3, 2, 1, 0, 1) + \
            struct.pack(">f", 0.5)

    return {
        "plain": ("OFF\n" + body).encode(),
        "one_line": ("OFF " + body.replace("\n", " ")).encode(),
        "no_keyword": body.encode(),
        "no_edges": with_extra("OFF", "").replace(b"3 1 0\n", b"3 1\n"),
        "comments": ("OFF # off\n# points\n\n" + body).encode(),
        "colours": with_extra("COFF", "255 0 0 255", "3 0 1 2 0.5 0.5 0.5"),
        "normals_texture": with_extra("STNOFF", "0 0 1 .5 .5"),
        "homogeneous": with_extra("4OFF", "2"),
        "dimension": with_extra("nOFF\n3", ""),
        "polygon": b"OFF\n5 2 0\n0 0 0\n2 0 0\n2 2 0\n1 1 0\n0 2 0\n5 0 1 2 3 4\n4 0 1 2 3 1 2 3\n",
        "lies": b"OFF\n3 99999999 0\n0 0 0\nnan x 0\n0 1 inf\n3 0 1 2\n3 0 1 7\n2 0 1\n-1 0\n",
        "binary": binary("OFF", (3, 2, 0)),
        "binary_extra": binary("CnOFF", (3, 3, 2, 0), struct.pack(">4f", 0, 0, 1, 1)),
    }


def glb(root, binary):
    text = json.dumps(root, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    binary += bytes(-len(binary) % 4)
    data = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(binary), b"BIN\0") + binary
    return struct.pack("<4sII", b"glTF", 2, 12 + len(data)) + data


def gltf_seeds():
    points, faces = TETRAHEDRON
    positions = b"".join(struct.pack("<3f", *point) for point in points)
    indices = b"".join(struct.pack("<3H", *face) for face in faces)
    texture = struct.pack("<8B", 0, 0, 255, 0, 0, 255, 255, 255)
    buffer = positions + indices + texture

    def root(**changes):
        views = [(0, len(positions)), (len(positions), len(indices)), (len(positions) + len(indices), len(texture))]
        made = {
            "asset": {"version": "2.0"},
            "buffers": [{"byteLength": len(buffer)}],
            "bufferViews": [{"buffer": 0, "byteOffset": a, "byteLength": b} for a, b in views],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                          {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"},
                          {"bufferView": 2, "componentType": 5121, "count": 4, "type": "VEC2", "normalized": True}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "TEXCOORD_0": 2}, "indices": 1,
                                        "material": 0}]}],
            "materials": [{"name": "m", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}],
            "nodes": [{"mesh": 0, "name": "n"}], "scenes": [{"nodes": [0]}], "scene": 0,
        }
        made.update(changes)
        return made

    uri = "data:;base64," + base64.b64encode(buffer).decode()
    sparse = root()
    sparse["accessors"][0]["sparse"] = {"count": 1, "indices": {"bufferView": 2, "componentType": 5121},
                                        "values": {"bufferView": 0}}
    moving = root(nodes=[{"mesh": 0, "skin": 0, "children": [1]},
                         {"mesh": 0, "extensions": {"KHR_node_visibility": {"visible": False}}}],
                  skins=[{"joints": [1], "inverseBindMatrices": 9}],
                  animations=[{"channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}],
                               "samplers": [{"input": 2, "output": 2}]}])
    moving["accessors"] += [{"bufferView": 0, "componentType": 5121, "count": 4, "type": "VEC4"},
                            {"bufferView": 0, "componentType": 5121, "count": 4, "type": "VEC4", "normalized": True}]
    moving["meshes"][0]["weights"] = [1]
    moving["meshes"][0]["primitives"][0]["targets"] = [{"POSITION": 0, "NORMAL": 0}]
    moving["meshes"][0]["primitives"][0]["attributes"].update({"JOINTS_0": 3, "WEIGHTS_0": 4})
    strip = root()
    strip["meshes"][0]["primitives"][0]["mode"] = 5
    return {
        "plain": glb(root(), buffer),
        "text": json.dumps(root(buffers=[{"byteLength": len(buffer), "uri": uri}])).encode(),
        "sparse": glb(sparse, buffer),
        "strip": glb(strip, buffer),
        "moving": glb(moving, buffer),
        "nodes": glb(root(nodes=[{"scale": [-1, 2, 3], "children": [1]}, {"mesh": 0, "rotation": [0, 0, 1, 0]}]), buffer),
        "instances": glb(root(nodes=[{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {
            "attributes": {"TRANSLATION": 0}}}}]), buffer),
        "lies": glb(root(bufferViews=[{"buffer": 0, "byteLength": 2 ** 32}]), buffer),
        "circle": glb(root(nodes=[{"children": [0]}]), buffer),
        "cut": glb(root(), buffer)[:-40],
    }


def ply_header(kind, *lines):
    return "\n".join(["ply", f"format {kind} 1.0", *lines, "end_header", ""]).encode()


def ply_seeds():
    axes = ["property float x", "property float y", "property float z"]
    vertex, face = ["element vertex 3"] + axes, ["element face 2", "property list uchar int vertex_indices"]
    points = b"0 0 0\n1 0 0\n0 1 0\n"

    def binary(kind, order):
        data = ply_header(kind, *vertex, *face)
        for row in [(0, 0, 0), (1, 0, 0), (0, 1, 0)]:
            data += struct.pack(order + "3f", *row)
        return data + struct.pack(order + "B3i", 3, 0, 1, 2) + struct.pack(order + "B4i", 4, 0, 1, 2, 0)

    odd = ply_header("binary_big_endian", "comment c", "obj_info o", "element vertex 3",
                     "property list uchar short tags", "property char x", "property double y",
                     "property int64 z", "element tristrips 1", "property list int int vertex_indices",
                     "element other 1", "property ushort a", "element face 1",
                     "property list ushort uchar vertex_index", "property double area")
    for x, y, z in [(0, 0, 0), (1, 0, 0), (0, 1, 0)]:
        odd += struct.pack(">Bhbdq", 1, 7, x, y, z)
    odd += struct.pack(">i5i", 5, 0, 1, 2, -1, 0) + struct.pack(">H", 9)
    odd += struct.pack(">H3Bd", 3, 0, 1, 2, 0.5)
    return {
        "ascii": ply_header("ascii", *vertex, *face) + points + b"3 0 1 2\n3 2 1 0\n",
        "ascii_windows": (ply_header("ascii", *vertex, *face) + points +
                          b"3 0 1 2\n4 2 1 0 1\n").replace(b"\n", b"\r\n"),
        "ascii_faces_first": ply_header("ascii", *face, *vertex) + b"3 0 1 2\n3 2 1 0\n" + points,
        "ascii_strips": ply_header("ascii", *vertex, "element tristrips 1",
                                   "property list int int vertex_indices") + points + b"6 0 1 2 -1 2 1\n",
        "ascii_numbers": ply_header("ascii", *vertex, *face) + b"0 x 0\n1 0\nnan inf 0\n3 0 1 2\n3000 0 1\n",
        "ascii_lies": ply_header("ascii", "element vertex 4000000000", *axes, *face) + points,
        "binary": binary("binary_little_endian", "<"),
        "binary_big": binary("binary_big_endian", ">"),
        "binary_cut": binary("binary_little_endian", "<")[:-3],
        "binary_odd": odd,
    }


# ---- OpenMesh's own format, see libmesh/src/formats/om/om_io.cpp

def om_chunk(entity, kind, is_float, dimension, size, data, name=b""):
    bits = (2 if name else 0) | entity << 2 | kind << 5 | 1 << 9 | is_float << 10
    bits |= (dimension - 1) << 11 | size << 14
    return struct.pack("<H", bits) + (bytes([len(name)]) + name if name else b"") + data


def om_file(kind, version, counts, *chunks):
    head = b"OM" + kind + bytes([version << 5]) + struct.pack("<3I", *counts)
    return head + b"".join(chunks) + om_chunk(7, 0, 0, 1, 0, b"")


def om_halfedges(faces):
    """Next, vertex and face of each halfedge, two for an edge; and one halfedge of each face."""
    number, edges = {}, 0
    for face in faces:
        for a, b in zip(face, face[1:] + face[:1]):
            if (b, a) in number:
                number[a, b] = number[b, a] + 1
            else:
                number[a, b] = 2 * edges
                edges += 1
    halfedges = [(-1, -1, -1)] * (2 * edges)
    for index, face in enumerate(faces):
        loop = [number[a, b] for a, b in zip(face, face[1:] + face[:1])]
        for place, halfedge in enumerate(loop):
            halfedges[halfedge] = (loop[(place + 1) % len(loop)], face[(place + 1) % len(face)], index)
    return halfedges, [number[face[0], face[1]] for face in faces]


def om_seeds():
    points, faces = TETRAHEDRON
    floats = om_chunk(0, 0, 1, 3, 0, b"".join(struct.pack("<3f", *p) for p in points))
    doubles = om_chunk(0, 0, 1, 3, 1, b"".join(struct.pack("<3d", *p) for p in points))
    corners = b"".join(struct.pack("<3i", *face) for face in faces)
    halfedges, first = om_halfedges(faces)
    ring = b"".join(struct.pack("<3i", *h) for h in halfedges)
    bytes_ring = b"".join(struct.pack("<3b", *h) for h in halfedges)
    normals = om_chunk(0, 1, 1, 3, 0, bytes(48))
    custom = om_chunk(0, 6, 0, 1, 0, struct.pack("<I", 3) + b"abc", b"v:own")
    return {
        "triangles": om_file(b"T", 1, (4, 4, 6), floats, om_chunk(2, 7, 0, 1, 2, corners)),
        "doubles": om_file(b"T", 1, (4, 4, 6), custom, doubles, normals,
                           om_chunk(2, 7, 0, 1, 2, corners), custom),
        "polygons": om_file(b"P", 1, (4, 2, 5), floats, om_chunk(2, 7, 0, 1, 0, struct.pack(
            "<H4bH3b", 4, 0, 1, 2, 3, 3, 0, 2, 1))),
        "quads": om_file(b"Q", 1, (4, 1, 4), floats, om_chunk(2, 7, 0, 1, 1, struct.pack("<4h", 0, 1, 2, 3))),
        "halfedges": om_file(b"T", 2, (4, 4, 6), floats, om_chunk(6, 7, 0, 1, 2, ring),
                             om_chunk(2, 7, 0, 1, 2, struct.pack("<4i", *first))),
        "halfedges_bytes": om_file(b"P", 2, (4, 4, 6), doubles, om_chunk(6, 7, 0, 1, 0, bytes_ring),
                                   om_chunk(2, 7, 0, 1, 0, struct.pack("<4b", *first))),
    }


# ---- trees, see libbsp/include/bsp/tree_io.h

def packed_seeds():
    points, faces = TETRAHEDRON
    obj = "".join("v %d %d %d\n" % p for p in points) + "".join("f %d %d %d\n" % tuple(i + 1 for i in f) for f in faces)
    text = obj.encode()

    def member(data, flags=0, fields=b""):
        """Stored as it is, which is the same with each version of zlib."""
        header = b"\x1F\x8B\x08" + bytes([flags]) + b"\0\0\0\0\0\x03" + fields
        block = b"\x01" + struct.pack("<HH", len(data), len(data) ^ 0xFFFF) + data
        return header + block + struct.pack("<II", zlib.crc32(data), len(data))

    def block(kind, size, data, last=True):
        return struct.pack("<I", size << 3 | kind << 1 | last)[:3] + data

    def frame(*blocks, descriptor=b"\0\x50"):
        return b"\x28\xB5\x2F\xFD" + descriptor + b"".join(blocks)

    def skippable(data):
        return b"\x51\x2A\x4D\x18" + struct.pack("<I", len(data)) + data

    def archive(parts):
        data = io.BytesIO()
        with zipfile.ZipFile(data, "w", zipfile.ZIP_STORED) as file:
            for name, content in parts.items():
                file.writestr(zipfile.ZipInfo(name), content)
        return data.getvalue()

    raw = frame(block(0, len(text), text))
    textured = "mtllib part.mtl\nusemtl a\n" + obj
    return {
        "gzip": member(text),
        "gzip_members": member(text[:20]) + member(b"") + member(text[20:]) + bytes(16),
        "gzip_fields": member(text, 4 | 8 | 16, b"\2\0ab" + b"part.obj\0" + b"comment\0"),
        "gzip_more_behind": member(text) + b"hello",
        "gzip_cut": member(text)[:-6],
        "gzip_twice": member(member(text)),
        "zstd_raw": raw,
        "zstd_frames": skippable(b"index") + frame(block(0, 20, text[:20])) + skippable(b"")
                       + frame(block(0, len(text) - 20, text[20:])),
        "zstd_run": frame(block(1, 1000, b"\n", False), block(0, len(text), text)),
        "zstd_size": frame(block(0, len(text), text), descriptor=b"\x20" + bytes([len(text)])),
        "zstd_bomb": frame(*[block(1, 1 << 17, b"v", False)] * 300, block(1, 1, b"v")),
        "zstd_dictionary": frame(block(0, len(text), text), descriptor=b"\x01\x50\x07"),
        "zip": archive({"part.obj": text, "readme.txt": "1 2 3"}),
        "zip_textured": archive({"a/part.obj": textured, "a/part.mtl": "newmtl a\nmap_Kd ../b.png\n", "b.png": "PNG"}),
        "zip_by_content": archive({"part": text, "__MACOSX/._part.obj": "x"}),
        "zip_of_gzip": archive({"part.obj.gz": member(text)}),
        "zip_of_points": archive({"part.xyz": "0 0 0\n1 0 0\n"}),
        "zip_several": archive({"a.obj": text, "b.obj": text}),
    }


def point_seeds():
    """The first byte chooses the name of the file."""
    cube = [(x, y, z) for x in range(3) for y in range(3) for z in range(3) if (x, y, z) != (1, 1, 1)]
    text = "".join("%d %d %d\n" % p for p in cube).encode()
    with_normals = "".join("%d %d %d 0 0 1 9 8 7\n" % p for p in cube).encode()

    def pcd(data, body, fields="x y z"):
        count = fields.count(" ") + 1
        header = (f"# .PCD v0.7\nVERSION 0.7\nFIELDS {fields}\nSIZE {'4 ' * count}\nTYPE {'F ' * count}\n"
                  f"COUNT {'1 ' * count}\nWIDTH {len(cube)}\nHEIGHT 1\nPOINTS {len(cube)}\nDATA {data}\n")
        return b"\x02" + header.encode() + body

    columns = b"".join(struct.pack(f"<{len(cube)}f", *(p[axis] for p in cube)) for axis in range(3))
    pieces = [columns[at:at + 32] for at in range(0, len(columns), 32)]
    packed = b"".join(bytes([len(piece) - 1]) + piece for piece in pieces)
    repeated = b"\x03\0\0\0\0" + b"\xE0\xFF\x03" + b"\xE0" + bytes([len(columns) - 4 - 264 - 9]) + b"\x03"
    sizes = struct.pack("<II", len(packed), len(columns))
    return {
        "xyz": b"\0" + text,
        "xyz_normals": b"\0" + with_normals,
        "xyz_commas": b"\0x,y,z\n" + text.replace(b" ", b","),
        "xyz_odd": b"\0# comment\n1 2 3\nnan inf 1e999\nwords\n// more\n1 2\n" + text,
        "pts": b"\x01%d\n" % len(cube) + text,
        "pwn": b"\x01%d\n" % len(cube) + text + b"0 0 1\n" * len(cube),
        "pcd_ascii": pcd("ascii", text),
        "pcd_binary": pcd("binary", b"".join(struct.pack("<3f", *p) for p in cube)),
        "pcd_compressed": pcd("binary_compressed", sizes + packed),
        "pcd_repeated": pcd("binary_compressed", struct.pack("<II", len(repeated), len(columns)) + repeated),
        "pcd_colours": pcd("ascii", text.replace(b"\n", b" 4.2e-39\n"), "x y z rgb"),
        "ply": b"\x03ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\n"
               b"property float z\nend_header\n" % len(cube) + text,
        "obj": b"\x04" + b"".join(b"v " + line for line in text.splitlines(True)) + b"vn 0 0 1\n" * len(cube),
        "nameless": b"\x05" + text,
    }


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def canonical_plane(normal, offset):
    """The plane, and whether it was turned."""
    divisor = math.gcd(*normal, offset)
    turned = next(n for n in normal if n != 0) < 0
    sign = -divisor if turned else divisor
    return tuple(n // sign for n in normal) + (offset // sign,), turned


class Tree:
    """A convex shape whose triangles face outward, a plane of it at each node; inside it, axis-parallel
    cuts down to a depth, all leaves there labelled by chance."""

    def __init__(self, points, triangles, cuts=(), seed=1):
        self.points, self.planes, self.triangles = points, [], []
        self.nodes, self.leaves, self.node_triangles = [], [], []
        self.random = random.Random(seed)
        for triangle in triangles:
            a, b, c = (points[i] for i in triangle)
            normal = cross(minus(b, a), minus(c, a))
            plane, turned = canonical_plane(normal, -sum(n * x for n, x in zip(normal, a)))
            if plane not in self.planes:
                self.planes.append(plane)
            self.triangles.append((*triangle, self.planes.index(plane), -1 if turned else 1,
                                   len(self.triangles)))
        self.add_sides(len(self.planes), cuts)

    def add_leaf(self, label):
        self.leaves.append((label, 0.5))
        return len(self.leaves) - 1 | 1 << 31

    def add_sides(self, count, cuts):
        for plane in range(count):
            mine = [i for i, t in enumerate(self.triangles) if t[3] == plane]
            outside = 0 if self.triangles[mine[0]][4] > 0 else 1
            children = [len(self.nodes) + 1] * 2
            children[outside] = self.add_leaf(1)
            self.nodes.append([plane, children, len(self.node_triangles), len(mine)])
            self.node_triangles += mine
        inner = self.add_cuts(list(cuts))
        last = self.nodes[count - 1]
        last[1] = [inner if child == count else child for child in last[1]]

    def add_cuts(self, cuts):
        if not cuts:
            return self.add_leaf(self.random.choice((1, 2)))
        plane, _ = canonical_plane(*cuts[0])
        if plane not in self.planes:
            self.planes.append(plane)
        index = len(self.nodes)
        self.nodes.append([self.planes.index(plane), None, 0, 0])
        self.nodes[index][1] = [self.add_cuts(cuts[1:]), self.add_cuts(cuts[1:])]
        return index

    def to_bytes(self):
        sections = [
            (b"GRID", 32, [struct.pack("<4d", 0, 0, 0, 1)]),
            (b"PNTS", 36, [struct.pack("<3d3i", *p, *p) for p in self.points]),
            (b"TRIS", 24, [struct.pack("<4IiI", *t) for t in self.triangles]),
            (b"PLNS", 40, [struct.pack("<3qQq", *p[:3], p[3] % 2 ** 64, p[3] >> 64) for p in self.planes]),
            (b"NODE", 20, [struct.pack("<5I", p, *children, first, count)
                           for p, children, first, count in self.nodes]),
            (b"NTRI", 4, [struct.pack("<I", t) for t in self.node_triangles]),
            (b"LEAF", 8, [struct.pack("<If", *leaf) for leaf in self.leaves]),
        ]
        data = b"BSP\r\n\x1a\n\0" + struct.pack("<2I", 1, len(sections))
        for name, size, items in sections:
            payload = b"".join(items)
            data += name + struct.pack("<IQQ", size, len(items), checksum(payload)) + payload
        return data


def checksum(data):
    value = 0xCBF29CE484222325
    for at in range(0, len(data), 8):
        word = int.from_bytes(data[at:at + 8], "little")
        value = (value ^ word) * 0x100000001B3 % 2 ** 64
        value ^= value >> 32
    return value


def box(low, high):
    points = [tuple((low, high)[corner >> axis & 1] for axis in range(3)) for corner in range(8)]
    sides = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return points, [t for a, b, c, d in sides for t in ((a, b, c), (a, c, d))]


def tree_seeds():
    axes = [((1, 0, 0), 0), ((0, 1, 0), 0), ((0, 0, 1), 0)]
    oblique = [((1, 1, 1), 0), ((1, -1, 0), 0), ((2, 3, -5), 0)]
    tetrahedron = ([(0, 0, 0), (9, 0, 0), (0, 9, 0), (0, 0, 9)], TETRAHEDRON[1])
    small = ([(5 * x - 2, 5 * y - 2, 5 * z - 2) for x, y, z in TETRAHEDRON[0]], TETRAHEDRON[1])
    seeds = {"tetrahedron": Tree(*tetrahedron), "cube": Tree(*box(-4, 4), seed=2),
             "cube_cut": Tree(*box(-4, 4), cuts=axes[:1]), "tetrahedron_cut": Tree(*small, cuts=oblique[:1])}
    for seed in range(3):
        seeds[f"voxels_{seed}"] = Tree(*box(-4, 4), cuts=axes, seed=seed)
        seeds[f"oblique_{seed}"] = Tree(*box(-33, 33), cuts=oblique, seed=seed)
    return {name: tree.to_bytes() for name, tree in seeds.items()}


# ---- cuts, see tests/fuzz/fuzz_clip.cpp

def coarse(x, y, z):
    return bytes([2, x + 16, y + 16, z + 16])


def clip_seeds():
    def cut(cell, *points):
        return bytes([cell, 2]) + b"".join(points)

    cube = bytes([7] * 6)
    halves = cut(0, coarse(0, 0, 0), coarse(0, 1, 0), coarse(0, 0, 1))
    quarters = cut(0, coarse(0, 0, 0), coarse(1, 0, 0), coarse(0, 0, 1))
    oblique = cut(1, coarse(8, 0, 0), coarse(0, 8, 0), coarse(0, 0, 8))
    corner = cut(0, coarse(8, 8, 0), coarse(8, 0, 8), coarse(0, 8, 8))
    along_axis = bytes([2, 1]) + coarse(1, 2, 3) + coarse(-3, 2, 1) + bytes([1])
    again = bytes([1, 0, 0])
    beside = bytes([0, 2, 1, 0, 2, 1, 1, 1, 1, 1, 0, 2, 1, 2, 1, 2, 0])
    fine = bytes([0, 2]) + b"".join(bytes([0]) + struct.pack("<3I", *p) for p in (
        (1, 2, 3), (2 ** 26 - 1, 7, 2 ** 25), (2 ** 25, 2 ** 26 - 3, 11)))
    cuts = [halves, quarters, oblique, corner, along_axis, again, beside, fine]
    seeds = {}
    for answers, name in enumerate(("exact", "any_plane", "lies", "float")):
        tolerance = bytes([29] * (answers == 3))  # 2^-5 grid steps
        seeds[f"{name}_cube"] = bytes([answers]) + cube + tolerance + b"".join(cuts)
        chance = random.Random(answers)
        mixed = b"".join(chance.choice(cuts) + bytes([chance.randrange(256)] * (4 * (answers == 2)))
                         for _ in range(12))
        seeds[f"{name}_mixed"] = bytes([answers]) + bytes(range(3, 9)) + tolerance + mixed
        seeds[f"{name}_chance"] = bytes([answers]) + chance.randbytes(200)
    return seeds


# ---- soups, see tests/fuzz/fuzz_soup.h and fuzz_repair.cpp

RAW, BESIDE, BETWEEN, BOX, TETRA, COPY, TURN, HERE, SMALL, TRIANGLE = range(10)


def request(rule=0, holes=0, flags=0, change=0, chosen=0xA5A5, wishes=b""):
    """`wishes`: what follows where the first byte says that there are more options, see tests/fuzz/repair_request.h."""
    return bytes([rule | (4 if wishes else 0), holes, flags, change]) + struct.pack("<H", chosen) + wishes


SEW, SEAL, THICKEN, KEEP, SIMPLIFY, OPACITY = (1 << bit for bit in range(6))


def wishes(which, unless_told=0, sew_mode=2, seal=2, thicken=4, side=0, kept=4):
    """Lengths are given as exponents: n is a share of 2^-(1 + n)."""
    return bytes([which, sew_mode, 4, seal, thicken, side, kept, 3, 10, 3, unless_told])


def points_at(*points):
    return b"".join(bytes([SMALL, *p]) for p in points)


def triangles_of(*triangles):
    return b"".join(bytes([TRIANGLE, *t]) for t in triangles)


def repair_seeds():
    def cuboid(low, high):
        return bytes([BOX, *low, *high])

    corners = points_at((0, 0, 0), (6, 0, 0), (0, 6, 0), (0, 0, 6))
    tetrahedron = corners + bytes([TETRA, 0, 1, 2, 3])
    pyramid = points_at((0, 0, 0), (6, 0, 0), (6, 6, 0), (0, 6, 0), (3, 3, 5))
    open_pyramid = pyramid + triangles_of((0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4))
    tilted = corners + bytes([BESIDE, 3, 9, 1, 3, 4, BETWEEN, 1, 2, 9, RAW]) + \
        struct.pack("<3d", 0.1, 1 / 3, math.pi)
    soups = {
        "tetrahedron": tetrahedron,
        "cube": cuboid((1, 1, 1), (4, 4, 4)),
        "boxes_crossing": cuboid((0, 0, 0), (4, 4, 4)) + cuboid((2, 2, 2), (6, 6, 6)),
        "boxes_sharing_a_face": cuboid((0, 0, 0), (3, 3, 3)) + cuboid((3, 1, 1), (6, 2, 5)),
        "boxes_sharing_an_edge": cuboid((0, 0, 0), (3, 3, 3)) + cuboid((3, 3, 0), (6, 6, 3)),
        "boxes_sharing_a_corner": cuboid((0, 0, 0), (3, 3, 3)) + cuboid((3, 3, 3), (6, 6, 6)),
        "boxes_nested": cuboid((0, 0, 0), (7, 7, 7)) + cuboid((2, 2, 2), (5, 5, 5)),
        "boxes_flat": cuboid((0, 0, 0), (4, 4, 0)) + cuboid((1, 1, 0), (3, 3, 3)),
        "box_turned": cuboid((0, 0, 0), (4, 4, 4)) + bytes([TURN, 3, TURN, 7, COPY, 2, 1, TURN, 12]),
        "pyramid_open": open_pyramid,
        "pyramid_turned": open_pyramid + bytes([TURN, 1, COPY, 0, 2]) + triangles_of((0, 2, 1), (0, 3, 2)),
        "tilted": tilted + bytes([TETRA, 0, 1, 2, 3, TETRA, 4, 5, 6, 0]) + triangles_of((4, 5, 6), (1, 2, 4)),
        "triangles": b"".join(bytes([HERE, *(i * i * 5 % 7 + k for k in range(9))]) for i in range(8)),
        "far_point": tetrahedron + bytes([RAW]) + struct.pack("<3d", 1e30, -1e-30, 5e-324) +
            triangles_of((0, 1, 4), (1, 2, 4), (2, 0, 4)),
        "no_number": tetrahedron + bytes([RAW]) + struct.pack("<3d", math.nan, math.inf, 0) +
            triangles_of((0, 1, 4)),
    }
    seeds = {}
    for index, (name, soup) in enumerate(soups.items()):
        seeds[name] = request() + soup
        seeds[name + "_float"] = request(flags=128, change=index % 4, chosen=index) + soup
        seeds[name + "_changed"] = request(rule=1 + index % 3, holes=index % 3, flags=index * 7 % 32,
                                           change=1 + index % 3) + soup
        more = wishes((SEW, SEAL, THICKEN, KEEP, SIMPLIFY, OPACITY, SEW | THICKEN | SIMPLIFY, SEAL | KEEP)[index % 8],
                      unless_told=49 if name == "cube" else index % 8, side=index % 3, kept=1 + index % 31)
        seeds[name + "_more"] = request(rule=index % 4, holes=index % 4, flags=index * 5 % 16, wishes=more) + soup
    return seeds


SEEDS = {"stl": stl_seeds, "obj": obj_seeds, "off": off_seeds, "ply": ply_seeds, "gltf": gltf_seeds, "om": om_seeds,
         "threemf": threemf_seeds, "packed": packed_seeds, "points": point_seeds, "tree": tree_seeds, "clip": clip_seeds,
         "repair": repair_seeds}


def main():
    if sys.argv[1:] not in ([], ["--check"]):
        print(__doc__.strip(), file=sys.stdout if sys.argv[1:] == ["--help"] else sys.stderr)
        return 0 if sys.argv[1:] == ["--help"] else 2
    different = 0
    for target, make in SEEDS.items():
        folder = FOLDER / target
        folder.mkdir(parents=True, exist_ok=True)
        for name, data in make().items():
            path = folder / name
            if not sys.argv[1:]:
                path.write_bytes(data)
            elif not path.exists() or path.read_bytes() != data:
                print(f"{path} is not what this script makes")
                different += 1
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main())
