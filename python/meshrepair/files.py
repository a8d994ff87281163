# SPDX-License-Identifier: MIT
"""Files of meshes and points, as they are: nothing is repaired."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._input import mesh_of
from ._options import keywords_of, path_of, raise_unless
from .attributes import for_core
from .errors import UsageError
from .progress import Progress, observer
from .results import Mesh, Points


def read(path: Any, *, attributes: bool = True, progress: Progress | bool | None = None, **options: Any) -> Mesh | Points:
    """Reads a file of a mesh (STL, OBJ, OFF, PLY, glTF, 3MF) or of points (XYZ, PTS, PWN, PCD, ...), optionally compressed.

    Args:
        path: str, bytes or path.
        attributes: False: do not read attributes.
        progress: as in :func:`repair`.
        **options: ``max_triangles``, ``time_limit``, ``max_memory``, ``threads``.

    Returns:
        A mesh, or points if the file has no faces and declares none.

    ``attributes`` of a mesh is a dict of arrays:

    - "texture" (coordinates, k = 2 or 3), "normal" (k = 3), "tangent" (k = 4), "colour" (k = 3 or 4, from 0 to 1, or uint8
      from 0 to 255), "skin_weights" (k = 8: the numbers of four joints, then their weights; or several times 8). The
      second of a kind is "texture_1", and so on. Others go by their names. Shape (n, k), a row for each vertex, (m, k),
      for each face, or (m, 3, k), for each corner of each face. NaN is none.
    - "material", "group", "object", "smoothing": (m,) int32, -1 for none, into the lists "material_names" and so on.
    """
    keywords = keywords_of(options)
    name = path_of(path, "path")
    with observer(progress) as told:
        outcome = _core.read(name, bool(attributes), keywords, told)
    raise_unless(outcome, 0)
    return Points(outcome) if "points" in outcome else Mesh(outcome, outcome["unit"])


def write(path: Any, mesh: Any, faces: Any = None, *, attributes: Any = None, unit: str | None = None,
          sources: bool | npt.NDArray[Any] = False, progress: Progress | bool | None = None, **options: Any) -> list[str]:
    """Writes a mesh to a file, completely or not at all.

    Args:
        path: its extension is the format, unless ``format`` is given: "stl", "stl-ascii", "obj", "off", "ply",
            "ply-ascii", "glb", "gltf", "3mf". One that ends in .gz or .zst is packed.
        mesh, faces: as in :func:`repair`.
        attributes: dict of arrays, as :func:`read` gives it; what the format cannot hold is left out. That of the mesh
            unless given.
        unit: "micron", "millimeter", "centimeter", "inch", "foot" or "meter", for formats that say it. That of the mesh
            unless given.
        sources: PLY only: (m,) integers, -1 for none, written as the property source_triangle; True: those of the result.
        progress: as in :func:`repair`.
        **options: ``format``, ``time_limit``, ``max_memory``.

    Returns:
        Warnings, a list of lines.

    Raises:
        OutputError: the file cannot be written; it is as it was before.
    """
    keywords = keywords_of(options)
    name = path_of(path, "path")
    source = _sources_of(sources, mesh)
    given = mesh_of(mesh, faces, attributes)
    kept, known = for_core(given.attributes)
    if unit is not None and not isinstance(unit, str):
        raise UsageError(f"unit: {type(unit).__name__} is no name")
    with observer(progress) as told:
        outcome = _core.write(name, given.vertices, given.faces, kept, known, unit or given.unit, source, keywords, told)
    raise_unless(outcome, 0)
    warnings: list[str] = outcome["warnings"]
    return warnings


def _sources_of(sources: Any, mesh: Any) -> npt.NDArray[Any] | None:
    """All ones for -1, as the extension has it."""
    if sources is False or sources is None:
        return None
    if sources is True:
        if not hasattr(mesh, "source"):
            raise UsageError("sources: the mesh has none; True is for results")
        sources = mesh.source
    try:
        rows = np.asarray(sources)
        if rows.dtype.kind == "u":  # what is too large for int64 is so for a file, too
            rows = np.minimum(rows, np.iinfo(np.int64).max)
        rows = rows.astype(np.int64, casting="same_kind")
    except (TypeError, ValueError, OverflowError) as error:
        raise UsageError(f"sources: {error}") from None
    if rows.ndim != 1:
        raise UsageError(f"sources: has shape {rows.shape}, not (faces,)")
    wrong = np.flatnonzero((rows < -1) | (rows > np.iinfo(np.int32).max))
    if len(wrong):
        raise UsageError(f"sources: row {wrong[0]} is {rows[wrong[0]]}, which is neither -1 nor a row of faces")
    return rows.astype(np.uint32)
