# SPDX-License-Identifier: MIT
"""What a mesh of Blender carries beside its shape: taken from it, brought onto other triangles, and put back."""

import numpy as np
from mathutils import Vector
from mathutils.bvhtree import BVHTree


class Triangles:
    """The triangles of an object's mesh, and what they carry.

    vertices: (n, 3) float64, where the matrix puts them.
    triangles: (m, 3) rows of vertices. polygon: of each triangle the polygon that it is of.
    material, smooth: of each triangle.
    corners: (m, 3, k) of each UV map and colour attribute, by (kind, name).
    groups: (n,) weights, by the name of the vertex group.
    """

    def __init__(self, item, matrix):
        mesh = item.data
        mesh.calc_loop_triangles()
        self.vertices = _transformed(_array(mesh.vertices, "co", 3), matrix)
        self.triangles = _array(mesh.loop_triangles, "vertices", 3, np.int32)
        self.polygon = _array(mesh.loop_triangles, "polygon_index", 1, np.int32).ravel()
        loops = _array(mesh.loop_triangles, "loops", 3, np.int32)
        if matrix.determinant() < 0:  # what was outside stays so
            self.triangles, loops = self.triangles[:, ::-1], loops[:, ::-1]
        self.material = _array(mesh.polygons, "material_index", 1, np.int32).ravel()[self.polygon]
        self.smooth = _array(mesh.polygons, "use_smooth", 1, bool).ravel()[self.polygon]
        self.materials = [slot.material for slot in item.material_slots]
        self.corners = {}
        for layer in mesh.uv_layers:
            self.corners["uv", layer.name] = _array(layer.data, "uv", 2)[loops]
        for layer in mesh.color_attributes:
            values = _array(layer.data, "color", 4)
            self.corners["colour", layer.name] = values[loops if layer.domain == "CORNER" else self.triangles]
        self.groups = _weights_of(item)

    def join(self, other):
        """Puts another one behind it. Materials are those of both, each once."""
        numbers = []
        if not self.materials:
            self.materials.append(None)  # an empty slot, lest its faces get the first of the others
        for material in other.materials or [None]:
            if material not in self.materials:
                self.materials.append(material)
            numbers.append(self.materials.index(material))
        self.corners = _joined(self.corners, other.corners, len(self.triangles), len(other.triangles))
        self.groups = _joined(self.groups, other.groups, len(self.vertices), len(other.vertices))
        self.material = np.concatenate([self.material, np.array(numbers)[np.minimum(other.material, len(numbers) - 1)]])
        self.smooth = np.concatenate([self.smooth, other.smooth])
        self.triangles = np.concatenate([self.triangles, other.triangles + len(self.vertices)])
        self.vertices = np.concatenate([self.vertices, other.vertices])

    def sources_of(self, vertices, triangles):
        """Of each of these triangles, which all lie in ours or close gaps, the nearest of ours."""
        tree = BVHTree.FromPolygons(self.vertices.tolist(), self.triangles.tolist())
        centres = vertices[triangles].mean(axis=1)
        return np.array([tree.find_nearest(Vector(centre))[2] for centre in centres], np.int64)


def put(item, given, answer, alone=False):
    """Makes the mesh of the object the answer's, carrying what was given.

    With `alone`, other objects that have the same mesh keep it as it is."""
    if alone and item.data.users > 1:
        item.data = item.data.copy()
    mesh = item.data
    source = answer.source if answer.source is not None else given.sources_of(answer.vertices, answer.triangles)
    source = _without_gaps(np.asarray(source, np.int64), answer.triangles)
    weights = _places_in(given, answer, source)
    item.shape_key_clear()
    mesh.clear_geometry()
    mesh.from_pydata(answer.vertices.tolist(), [], answer.triangles.tolist())
    mesh.polygons.foreach_set("material_index", np.ascontiguousarray(given.material[source], np.int32))
    mesh.polygons.foreach_set("use_smooth", given.smooth[source])
    while len(item.material_slots) < len(given.materials):
        mesh.materials.append(given.materials[len(item.material_slots)])
    for (kind, name), values in given.corners.items():
        made = np.einsum("tcs,tsk->tck", weights, values[source])
        _put_corners(mesh, kind, name, made.reshape(-1, values.shape[2]))
    for name, values in given.groups.items():
        made = np.zeros(len(answer.vertices))
        made[answer.triangles] = np.einsum("tcs,ts->tc", weights, values[given.triangles[source]])
        _put_weights(item, name, made)
    mesh.update()
    mesh.validate()


def _array(items, name, width, dtype=float):
    values = np.empty(len(items) * width, {float: np.float32, bool: bool}.get(dtype, dtype))
    items.foreach_get(name, values)
    return values.reshape(-1, width)


def _transformed(points, matrix):
    matrix = np.array(matrix, float)
    if (matrix == np.eye(4)).all():
        return points.astype(float)
    # To single precision, in which Blender has coordinates.
    return (points.astype(float) @ matrix[:3, :3].T + matrix[:3, 3]).astype(np.float32).astype(float)


def _weights_of(item):
    groups = {group.index: np.zeros(len(item.data.vertices)) for group in item.vertex_groups}
    for vertex in item.data.vertices:
        for entry in vertex.groups:
            groups[entry.group][vertex.index] = entry.weight
    return {item.vertex_groups[index].name: values for index, values in groups.items()}


def _joined(first, second, first_count, second_count):
    """What one of the two lacks is 0 there."""
    joined = {}
    for name in [*first, *(name for name in second if name not in first)]:
        shape = (first if name in first else second)[name].shape[1:]
        joined[name] = np.concatenate([first.get(name, np.zeros((first_count, *shape))), second.get(name, np.zeros((second_count, *shape)))])
    return joined


def _without_gaps(source, triangles):
    """What closes a gap carries what is beside it."""
    source = source.copy()
    while (source < 0).any():
        of_vertex = np.full(triangles.max() + 1, -1)
        known = source >= 0
        of_vertex[triangles[known]] = source[known, None]
        beside = of_vertex[triangles[~known]].max(axis=1)
        if (beside < 0).all():
            source[~known] = 0  # a part that only closes gaps
            break
        source[~known] = beside
    return source


def _places_in(given, answer, source):
    """(m, 3, 3): each corner as a mean of the corners of the source. Beyond it, of the nearest place in it."""
    a, b, c = (given.vertices[given.triangles[source][:, k]][:, None] for k in range(3))
    to = answer.vertices[answer.triangles] - a
    u, v = b - a, c - a
    uu, uv, vv = ((x * y).sum(axis=-1) for x, y in ((u, u), (u, v), (v, v)))
    tu, tv = (to * u).sum(axis=-1), (to * v).sum(axis=-1)
    area = uu * vv - uv * uv
    safe = np.where(area > 0, area, 1)
    of_b = np.where(area > 0, (vv * tu - uv * tv) / safe, 0)
    of_c = np.where(area > 0, (uu * tv - uv * tu) / safe, 0)
    weights = np.clip(np.stack([1 - of_b - of_c, of_b, of_c], axis=-1), 0, 1)
    return weights / weights.sum(axis=-1, keepdims=True)


def _put_corners(mesh, kind, name, values):
    if kind == "uv":
        layer = mesh.uv_layers.new(name=name, do_init=False)
        layer.data.foreach_set("uv", np.ascontiguousarray(values, np.float32).ravel())
    else:
        layer = mesh.color_attributes.new(name, "FLOAT_COLOR", "CORNER")
        layer.data.foreach_set("color", np.ascontiguousarray(values, np.float32).ravel())


def _put_weights(item, name, values):
    group = item.vertex_groups.get(name) or item.vertex_groups.new(name=name)
    for index in np.flatnonzero(values).tolist():
        group.add([index], float(values[index]), "REPLACE")
