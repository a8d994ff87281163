# SPDX-License-Identifier: MIT
"""Triangles to binary PLY, and back: all that goes between Blender and the programs."""

import numpy as np

TYPES = {"char": "i1", "uchar": "u1", "short": "<i2", "ushort": "<u2", "int": "<i4", "uint": "<u4", "float": "<f4", "double": "<f8",
         "int8": "i1", "uint8": "u1", "int16": "<i2", "uint16": "<u2", "int32": "<i4", "uint32": "<u4", "float32": "<f4",
         "float64": "<f8"}
CORNERS = np.dtype([("count", "u1"), ("corners", "<i4", 3)])


def write(path, vertices, triangles):
    """(n, 3) float64 and (m, 3) integers."""
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\n"
            "property double x\nproperty double y\nproperty double z\n"
            f"element face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n")
    faces = np.empty(len(triangles), CORNERS)
    faces["count"] = 3
    faces["corners"] = triangles
    with open(path, "wb") as file:
        file.write(head.encode())
        file.write(np.ascontiguousarray(vertices, "<f8").tobytes())
        file.write(faces.tobytes())


def read(path):
    """Vertices, triangles, and what else the faces have: a dict of arrays. Of a file that one of our programs wrote."""
    with open(path, "rb") as file:
        data = file.read()
    head, mark, body = data.partition(b"end_header\n")
    elements = _elements_of(head.decode().splitlines())
    if not mark or list(elements) != ["vertex", "face"]:
        raise ValueError(f"{path}: is no PLY of triangles")
    vertex_type, face_type = (np.dtype(properties) for _, properties in elements.values())
    vertices = np.frombuffer(body, vertex_type, elements["vertex"][0])
    faces = np.frombuffer(body, face_type, elements["face"][0], vertices.nbytes)
    points = np.stack([vertices[axis].astype(float) for axis in "xyz"], axis=1)
    others = {name: faces[name] for name in faces.dtype.names if name not in ("count", "corners")}
    return points, faces["corners"], others


def _elements_of(lines):
    """Of each element, how many there are, and its properties as numpy has them. Lists are of three."""
    elements = {}
    for words in map(str.split, lines):
        if words[:1] == ["element"]:
            properties = []
            elements[words[1]] = (int(words[2]), properties)
        elif words[:2] == ["property", "list"]:
            properties += [("count", TYPES[words[2]]), ("corners", TYPES[words[3]], 3)]
        elif words[:1] == ["property"]:
            properties.append((words[2], TYPES[words[1]]))
    return elements
