# SPDX-License-Identifier: MIT
"""Meshes with textures as files, written without the programs that are to read them."""

import io
import json
import struct
import zipfile
from collections.abc import Iterable

from .shapes import Mesh, Vector

Files = dict[str, bytes]  # by name


def numbers(values: Vector) -> str:
    return " ".join(f"{value:.6g}" for value in values)


def obj(name: str, mesh: Mesh) -> Files:
    lines = [f"mtllib {name}.mtl"]
    lines += ["v " + numbers(point) for point in mesh.points]
    lines += ["vt " + numbers(place) for place in mesh.places]
    before = None
    for triangle, material in zip(mesh.triangles, mesh.material_of):
        if material != before:
            lines.append("usemtl " + mesh.materials[material].name)
            before = material
        lines.append("f " + " ".join(f"{p + 1}/{q + 1}" for p, q in triangle))
    library = "".join(f"newmtl {m.name}\nKd 1 1 1\nmap_Kd {m.name}.png\n" for m in mesh.materials)
    return {f"{name}.obj": ("\n".join(lines) + "\n").encode(), f"{name}.mtl": library.encode(), **pictures(mesh)}


def pictures(mesh: Mesh) -> Files:
    return {f"{material.name}.png": material.texture for material in mesh.materials}


def ply(name: str, mesh: Mesh) -> Files:
    """With one texture, whose places are lists of the faces."""
    (material,) = mesh.materials
    head = ["ply", "format ascii 1.0", f"comment TextureFile {material.name}.png", f"element vertex {len(mesh.points)}",
            "property double x", "property double y", "property double z", f"element face {len(mesh.triangles)}",
            "property list uchar int vertex_indices", "property list uchar float texcoord", "end_header"]
    lines = [numbers(point) for point in mesh.points]
    for triangle in mesh.triangles:
        points = " ".join(str(p) for p, _ in triangle)
        places = " ".join(numbers(mesh.places[q]) for _, q in triangle)
        lines.append(f"3 {points} 6 {places}")
    return {f"{name}.ply": ("\n".join(head + lines) + "\n").encode(), **pictures(mesh)}


def threemf(name: str, mesh: Mesh) -> Files:
    schema = "http://schemas.microsoft.com/3dmanufacturing/"
    resources = []
    for k, material in enumerate(mesh.materials):
        resources.append(f'<m:texture2d id="{2 * k + 1}" path="/3D/Textures/{material.name}.png" contenttype="image/png"/>'
                         f'<m:texture2dgroup id="{2 * k + 2}" texid="{2 * k + 1}">')
        resources += [f'<m:tex2coord u="{u:.6g}" v="{v:.6g}"/>' for u, v in mesh.places]
        resources.append("</m:texture2dgroup>")
    vertices = "".join(f'<vertex x="{x:.6g}" y="{y:.6g}" z="{z:.6g}"/>' for x, y, z in mesh.points)
    triangles = "".join(
        f'<triangle v1="{a}" v2="{b}" v3="{c}" pid="{2 * material + 2}" p1="{p}" p2="{q}" p3="{r}"/>'
        for ((a, p), (b, q), (c, r)), material in zip(mesh.triangles, mesh.material_of))
    model = (f'<model unit="millimeter" xmlns="{schema}core/2015/02" xmlns:m="{schema}material/2015/02"><resources>'
             f'{"".join(resources)}<object id="99"><mesh><vertices>{vertices}</vertices><triangles>{triangles}</triangles>'
             '</mesh></object></resources><build><item objectid="99"/></build></model>')
    types = ('<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types"><Default Extension="rels" '
             'ContentType="application/vnd.openxmlformats-package.relationships+xml"/><Default Extension="model" '
             'ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>'
             '<Default Extension="png" ContentType="image/png"/></Types>')
    parts = {"[Content_Types].xml": types, "_rels/.rels": relationships("/3D/3dmodel.model", schema + "2013/01/3dmodel"),
             "3D/3dmodel.model": model}
    for material in mesh.materials:
        parts[f"3D/Textures/{material.name}.png"] = material.texture
    parts["3D/_rels/3dmodel.model.rels"] = relationships(
        [f"/3D/Textures/{material.name}.png" for material in mesh.materials], schema + "2013/01/3dtexture")
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as archive:
        for part, content in parts.items():
            archive.writestr(zipfile.ZipInfo(part), content, zipfile.ZIP_DEFLATED)
    return {f"{name}.3mf": data.getvalue()}


def relationships(targets: str | Iterable[str], kind: str) -> str:
    targets = [targets] if isinstance(targets, str) else targets
    entries = "".join(f'<Relationship Target="{target}" Id="r{k}" Type="{kind}"/>' for k, target in enumerate(targets))
    return f'<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">{entries}</Relationships>'


class GlbBuffer:
    """What accessors and pictures are in."""

    def __init__(self) -> None:
        self.bytes = b""
        self.views: list[dict] = []
        self.accessors: list[dict] = []

    def add(self, data: bytes) -> int:
        self.views.append({"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.bytes += data + bytes(-len(data) % 4)
        return len(self.views) - 1

    def add_accessor(self, code: str, component: int, kind: str, rows: list[tuple]) -> int:
        view = self.add(b"".join(struct.pack("<" + code, *row) for row in rows))
        accessor = {"bufferView": view, "componentType": component, "count": len(rows), "type": kind}
        if kind == "VEC3":
            accessor["min"] = [min(column) for column in zip(*rows)]
            accessor["max"] = [max(column) for column in zip(*rows)]
        self.accessors.append(accessor)
        return len(self.accessors) - 1


def glb(name: str, mesh: Mesh) -> Files:
    """A vertex for each pair of a point and a place, a primitive for each material."""
    buffer = GlbBuffer()
    primitives = []
    for number in range(len(mesh.materials)):
        vertex_of: dict[tuple[int, int], int] = {}
        indices = [(vertex_of.setdefault(corner, len(vertex_of)),) for triangle, material in
                   zip(mesh.triangles, mesh.material_of) if material == number for corner in triangle]
        single = [struct.unpack("<3f", struct.pack("<3f", *mesh.points[p])) for p, _ in vertex_of]
        places = [(mesh.places[q][0], 1 - mesh.places[q][1]) for _, q in vertex_of]
        primitives.append({"attributes": {"POSITION": buffer.add_accessor("3f", 5126, "VEC3", single),
                                          "TEXCOORD_0": buffer.add_accessor("2f", 5126, "VEC2", places)},
                           "indices": buffer.add_accessor("I", 5125, "SCALAR", indices), "material": number})
    images = [{"bufferView": buffer.add(material.texture), "mimeType": "image/png"} for material in mesh.materials]
    root = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": primitives}], "accessors": buffer.accessors, "bufferViews": buffer.views,
            "buffers": [{"byteLength": len(buffer.bytes)}], "images": images,
            "textures": [{"source": k} for k in range(len(images))],
            "materials": [{"name": material.name, "pbrMetallicRoughness": {"baseColorTexture": {"index": k}}}
                          for k, material in enumerate(mesh.materials)]}
    text = json.dumps(root, separators=(",", ":")).encode()
    text += b" " * (-len(text) % 4)
    data = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(buffer.bytes), b"BIN\0") + buffer.bytes
    return {f"{name}.glb": struct.pack("<4sII", b"glTF", 2, 12 + len(data)) + data}


def stl(name: str, mesh: Mesh) -> Files:
    """Binary, without textures and normals."""
    rows = b"".join(struct.pack("<12fH", 0, 0, 0, *(number for p, _ in triangle for number in mesh.points[p]), 0)
                    for triangle in mesh.triangles)
    return {f"{name}.stl": bytes(80) + struct.pack("<I", len(mesh.triangles)) + rows}
