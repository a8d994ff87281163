# SPDX-License-Identifier: MIT
"""What callers give as a mesh, made arrays: pairs, and objects of other packages, known by what they have."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _core
from .errors import Error, LimitError, UsageError


class GivenMesh(NamedTuple):
    """Of each face in ``faces``, ``face_of`` has the row of the polygon that it is a piece of; None: its own."""

    vertices: npt.NDArray[Any]
    faces: npt.NDArray[Any]
    face_of: npt.NDArray[Any] | None
    attributes: Any
    unit: str | None


@contextmanager
def only_our_exceptions(name: str) -> Iterator[None]:
    """What the caller's objects raise while they are looked at."""
    try:
        yield
    except Error:
        raise
    except MemoryError:
        raise LimitError(f"{name}: out of memory") from None
    except Exception as error:
        raise UsageError(f"{name}: cannot be read: {_first_line(error)}") from error


def as_array(value: Any, name: str) -> npt.NDArray[Any]:
    """An array of numbers that the extension takes, without a copy where it is one."""
    if value is None:
        raise UsageError(f"{name}: is None")
    if isinstance(value, np.ma.MaskedArray) and np.any(value.mask):
        raise UsageError(f"{name}: has masked elements")
    try:
        array = np.asarray(value)
    except Exception as error:  # whatever the object's own code raises
        raise UsageError(f"{name}: is no array: {_first_line(error)}") from error
    kind = array.dtype.kind
    if array.size == 0 and array.ndim == 1 and kind == "f":  # an empty list
        array = array.reshape(0, 3)
    if kind == "f" and array.dtype.itemsize not in (4, 8):
        with np.errstate(over="ignore"):
            return array.astype(np.float64)
    if kind in "fiu" and not array.dtype.isnative:
        return array.astype(array.dtype.newbyteorder("="))
    return array


def _first_line(error: Exception) -> str:
    return (str(error) or type(error).__name__).strip().splitlines()[0]


def rows_of(value: Any, name: str) -> npt.NDArray[Any]:
    """For lists of lists: names the row that is not like the others."""
    if isinstance(value, (list, tuple)):
        for number, row in enumerate(value):
            if not hasattr(row, "__len__") or len(row) != 3:
                raise UsageError(f"{name}: row {number} has not 3 numbers: {_shown(row)}")
    return as_array(value, name)


def _shown(value: Any) -> str:
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else text[:57] + "..."


def _polygons(vertices: npt.NDArray[Any], corners: Any, sizes: Any) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
    given, corners = corners, np.asarray(corners)
    if corners.dtype.kind == "f" and isinstance(given, list) and all(isinstance(corner, (int, np.integer)) for corner in given):
        corners = np.array([int(corner) for corner in given])  # numpy makes floats of integers of several types
    if corners.size == 0:
        corners = corners.astype(np.int64)
    if corners.dtype.kind not in "iu":
        raise UsageError(f"faces: has elements of type {corners.dtype}, not integers")
    if corners.dtype.kind == "u":  # what is too large for int64 is no vertex, either
        corners = np.minimum(corners, np.iinfo(np.int64).max).astype(np.int64)
    return _core.triangulated(vertices, np.ravel(corners), np.asarray(sizes, dtype=np.int64))


def _faces_of(vertices: npt.NDArray[Any], faces: Any) -> tuple[npt.NDArray[Any], npt.NDArray[Any] | None]:
    """Triangles; polygons are triangulated as the readers of files do."""
    if isinstance(faces, (list, tuple)):
        sizes = []
        for number, row in enumerate(faces):
            if not hasattr(row, "__len__"):
                raise UsageError(f"faces: row {number} is no list of indices: {_shown(row)}")
            sizes.append(len(row))
        if not faces:
            return np.zeros((0, 3), np.int32), None
        if any(size != 3 for size in sizes):
            with only_our_exceptions("faces"):
                return _polygons(vertices, list(itertools.chain.from_iterable(faces)), sizes)
    array = as_array(faces, "faces")
    if array.size == 0 and array.ndim == 2 and array.shape[1] == 3 and array.dtype.kind == "f":
        return array.astype(np.int32), None
    if array.ndim == 2 and array.shape[1] > 3:
        return _polygons(vertices, array, np.full(len(array), array.shape[1]))
    return array, None


def _padded(faces: npt.NDArray[Any]) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
    """Of VTK's list, in which the number of corners stands before each face: all corners, and the numbers."""
    if len(faces) % 4 == 0 and (faces[::4] == 3).all():
        return faces.reshape(-1, 4)[:, 1:], np.full(len(faces) // 4, 3)
    is_corner = np.ones(len(faces), dtype=bool)
    sizes: list[int] = []
    at = 0
    while at < len(faces):
        size = int(faces[at])
        if size < 0 or at + size >= len(faces):
            raise UsageError(f"faces: the list ends within face {len(sizes)}")
        sizes.append(size)
        is_corner[at] = False
        at += size + 1
    return faces[is_corner], np.asarray(sizes, dtype=np.int64)


def _of_cells(vertices: npt.NDArray[Any], cells: Any) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
    """Of meshio's blocks those that are faces."""
    corners, sizes = [], []
    for block in cells:
        kind, data = (block.type, block.data) if hasattr(block, "type") else tuple(block)
        if kind in ("triangle", "quad", "polygon"):
            rows = np.asarray(data)
            corners.append(rows.ravel())
            sizes.append(np.full(len(rows), rows.shape[1]))
        elif kind.startswith(("triangle", "quad")):  # of higher order: a mesh without them has holes
            raise UsageError(f"mesh: has cells of type {kind}, which are not flat")
    if not sizes:
        raise UsageError("mesh: has no cells that are triangles, quads or polygons")
    return _polygons(vertices, np.concatenate(corners), np.concatenate(sizes))


def _in_numpy(value: Any) -> Any:
    """A tensor of open3d or torch, say."""
    return value.numpy() if hasattr(value, "numpy") and not isinstance(value, np.ndarray) else value


def _parts_of(mesh: Any) -> tuple[Any, Any]:
    """Vertices and faces, as the object has them."""
    if isinstance(mesh, (tuple, list)) and len(mesh) == 2:
        return mesh[0], mesh[1]
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):  # trimesh, and our own
        return mesh.vertices, mesh.faces
    if hasattr(mesh, "vertices") and hasattr(mesh, "triangles"):  # open3d
        return np.asarray(mesh.vertices), np.asarray(mesh.triangles)
    if hasattr(mesh, "vertex") and hasattr(mesh, "triangle"):  # open3d.t
        return _in_numpy(mesh.vertex.positions), _in_numpy(mesh.triangle.indices)
    if hasattr(mesh, "points"):
        raise UsageError(f"mesh: {type(mesh).__name__} has points, but no faces; repair_points() makes a solid of points")
    raise UsageError(f"mesh: {type(mesh).__name__} has no vertices and faces that are known here")


def mesh_of(mesh: Any, faces: Any = None, attributes: Any = None) -> GivenMesh:
    """From vertices and faces, or from one object, or a pair, that has both."""
    with only_our_exceptions("mesh"):
        return _mesh_of(mesh, faces, attributes)


def _mesh_of(mesh: Any, faces: Any, attributes: Any) -> GivenMesh:
    unit = None
    face_of: npt.NDArray[Any] | None
    if faces is None and hasattr(mesh, "points") and (hasattr(mesh, "faces") or hasattr(mesh, "cells")):
        vertices = as_array(mesh.points, "vertices")
        if hasattr(mesh, "faces"):  # pyvista
            triangles, face_of = _polygons(vertices, *_padded(np.asarray(mesh.faces)))
        else:  # meshio
            triangles, face_of = _of_cells(vertices, mesh.cells)
    else:
        if faces is None:
            if attributes is None and hasattr(mesh, "_is_of_meshrepair"):
                attributes, unit = mesh.attributes, mesh.unit
            mesh, faces = _parts_of(mesh)
        vertices = rows_of(mesh, "vertices")
        triangles, face_of = _faces_of(vertices, faces)
    if face_of is not None and attributes:
        attributes = _for_pieces(attributes, face_of, len(vertices))
    return GivenMesh(vertices, triangles, face_of, attributes, unit)


def _for_pieces(attributes: Any, face_of: npt.NDArray[Any], vertices: int) -> dict[str, Any]:
    """What polygons have, their triangles have, too."""
    polygons = int(face_of.max()) + 1 if len(face_of) else 0
    found = {}
    for key, value in dict(attributes).items():
        array = np.asarray(value)
        is_of_faces = array.ndim in (1, 2) and len(array) == polygons != vertices and not key.endswith("_names")
        found[key] = array[face_of] if is_of_faces else value
    return found


def points_of(points: Any, normals: Any) -> tuple[npt.NDArray[Any], npt.NDArray[Any] | None]:
    """From arrays, or from one object that has points, and maybe normals."""
    with only_our_exceptions("points"):
        return _points_of(points, normals)


def _points_of(points: Any, normals: Any) -> tuple[npt.NDArray[Any], npt.NDArray[Any] | None]:
    if not isinstance(points, (np.ndarray, list, tuple)):
        for name in ("points", "vertices"):
            if hasattr(points, name):
                if normals is None:
                    normals = getattr(points, "normals", None)
                    normals = None if normals is None or len(normals) == 0 else normals
                points = getattr(points, name)
                break
    array = rows_of(np.asarray(points) if hasattr(points, "__array__") else points, "points")
    return array, None if normals is None else rows_of(normals, "normals")
