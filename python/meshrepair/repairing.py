# SPDX-License-Identifier: MIT
"""Repairs of meshes, points and files."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._input import mesh_of, points_of
from ._options import is_true, keywords_of, path_of, raise_unless
from .attributes import for_core
from .errors import UsageError, error_of
from .progress import Progress, observer
from .results import Bodies, Result


def may_be_not_finite(nan: str) -> bool:
    if not isinstance(nan, str) or nan not in ("raise", "drop"):
        given = repr(nan) if isinstance(nan, str) else type(nan).__name__
        raise UsageError(f"nan: is {given}, neither 'raise' nor 'drop'")
    return nan == "drop"


def _certified_or_raise(outcome: dict[str, Any], options: dict[str, Any]) -> None:
    raise_unless(outcome, 0, 1)
    if outcome["code"] == 1 and is_true(options, "strict"):
        report = json.loads(outcome["report"])
        raise error_of(1, report["error"], report)


def repair(mesh: Any, faces: Any = None, *, attributes: Any = None, progress: Progress | bool | None = None,
           distance: bool = False, nan: str = "raise", **options: Any) -> Result:
    """Turns any triangle mesh into the boundary of a solid.

    Args:
        mesh: (n, 3) array of vertices, in any unit; float32, float64 or integers. Or one object with
            vertices and faces: a result of this package, a pair (vertices, faces), a mesh of trimesh, open3d, pyvista or
            meshio.
        faces: (m, 3) array of integers of any type, row indices of vertices, from 0; or (m, k), or lists of length 3 or
            more: polygons.
        attributes: dict of attribute arrays; see :func:`read`.
        progress: ``progress(stage, share)``, called a few times a second with a str and a float from 0 to 1; True draws a
            bar.
        distance: also measure the distance of the result from the mesh, for the report.
        nan: "raise", or "drop": drop faces at vertices with NaN or infinity, as the program does.
        **options: those of the program ``meshrepair``, with _ for -, and ``for_`` for "for": ``inside="solidity"``,
            ``sew="none"``, ``seal="1%"``, ``max_hole=0.5``, ``strict=True``, ``threads=1``, ``time_limit=10``, ... With
            ``format="stl"`` and others, the result is certified for a file of this format. ``precision`` defaults to that
            of the vertices: float32 gives float32. ``max_memory`` limits the memory of the whole process.

    Returns:
        A result with ``vertices``, ``faces``, ``source``, ``attributes``, ``report``, ``certified``.

    Input vertices and faces are copied once, whatever their layout. Those of the result are not copied, except float32
    vertices.

    Raises:
        UsageError: also a ValueError; an argument is invalid. The message names the row.
        NoSolidError: the mesh encloses nothing.
        NotCertifiedError: with ``strict=True``, if a guarantee does not hold.
        LimitError: a limit was reached, or memory ran out.
        KeyboardInterrupt: Ctrl-C.

    A cube without one triangle:

    >>> import meshrepair
    >>> vertices = [(x, y, z) for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)]
    >>> quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4)]
    >>> result = meshrepair.repair(vertices, quads + [(1, 5, 7)])
    >>> result
    <Result: 8 vertices, 12 faces, certified>
    >>> result.report["result"]["volume"]
    1.0
    >>> sorted(set(result.source.tolist()))
    [-1, 0, 1, 2, 3, 4, 5]
    >>> meshrepair.repair(vertices, [(0, 1, 8)])
    Traceback (most recent call last):
    meshrepair.errors.UsageError: faces: row 0 has the index 8, but there are 8 vertices
    """
    drop = may_be_not_finite(nan)
    keywords = keywords_of(options)
    given = mesh_of(mesh, faces, attributes)
    kept, known = for_core(given.attributes)
    with observer(progress) as told:
        outcome = _core.repair(given.vertices, given.faces, kept, known, drop, keywords, told, bool(distance))
    _certified_or_raise(outcome, options)
    return Result(outcome, given.unit, given.face_of)


def repair_points(points: Any, /, normals: Any = None, *, progress: Progress | bool | None = None, distance: bool = False,
                  nan: str = "raise", **options: Any) -> Result:
    """Makes the boundary of a solid from a point cloud.

    Args:
        points: (n, 3) array in any unit; float32, float64 or integers. Or one object with ``points`` and optional
            ``normals``.
        normals: (n, 3) array of normals of any length, or None. Normals of length 0, NaN or infinity are ignored.
        progress, distance, nan: as in :func:`repair`.
        **options: those of the program ``meshrepair``, with _ for -: ``base=True``, ``up="y"``, ``project=3``, ...

    Returns:
        A result like that of :func:`repair`; ``source`` refers to triangles between the points.

    >>> import math, meshrepair
    >>> turns = [(math.acos(1 - (2 * i + 1) / 800), math.pi * (1 + math.sqrt(5)) * i) for i in range(800)]
    >>> ball = [(math.cos(a) * math.sin(t), math.sin(a) * math.sin(t), math.cos(t)) for t, a in turns]
    >>> result = meshrepair.repair_points(ball)
    >>> result.certified, round(result.report["result"]["volume"], 1)
    (True, 4.2)
    """
    drop = may_be_not_finite(nan)
    keywords = keywords_of(options)
    cloud, directions = points_of(points, normals)
    with observer(progress) as told:
        outcome = _core.repair_points(cloud, directions, drop, keywords, told, bool(distance))
    _certified_or_raise(outcome, options)
    return Result(outcome)


def repair_file(source: Any, target: Any, *, progress: Progress | bool | None = None, distance: bool = False,
                **options: Any) -> dict[str, Any]:
    """Repairs a file and writes the result, with the same bytes as the program ``meshrepair``.

    Args:
        source: path of a mesh or of points: STL, OBJ, OFF, PLY, glTF, 3MF, XYZ, PTS, PWN, PCD; optionally compressed.
        target: path of the mesh to write; its extension sets the format, unless ``format`` is given.
        progress, distance: as in :func:`repair`.
        **options: all those of the program, with _ for -.

    Returns:
        The report as a dict. ``exit_code`` is 0 if every guarantee holds, else 1, and ``error`` names the missing one.
        ``warnings`` are those of the report: ``code``, ``text``, ``numbers``, ...

    Raises:
        The exceptions of :func:`repair`, InputError, and OutputError.
    """
    keywords = keywords_of(options)
    names = path_of(source, "source"), path_of(target, "target")
    with observer(progress) as told:
        outcome = _core.repair_file(*names, keywords, told, bool(distance))
    _certified_or_raise(outcome, options)
    report: dict[str, Any] = json.loads(outcome["report"])
    return report


def boolean(meshes: Any, op: str, *, progress: Progress | bool | None = None, nan: str = "raise",
            **options: Any) -> Result:
    """Unites, intersects or subtracts solids; invalid ones are repaired first.

    Args:
        meshes: two or more pairs (vertices, faces), or objects that :func:`repair` takes.
        op: "union", "intersection", "difference" (the first minus all others) or "xor".
        progress, nan: as in :func:`repair`.
        **options: those of the program ``bspbool``, with _ for -.

    Returns:
        A result like that of :func:`repair`, possibly without faces. ``source`` counts the faces of all meshes
        consecutively.

    >>> import meshrepair
    >>> def box(low, high):
    ...     corners = [(x, y, z) for x in (low, high) for y in (low, high) for z in (low, high)]
    ...     return corners, [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    >>> both = meshrepair.boolean([box(0, 2), box(1, 3)], "union")
    >>> both.certified, both.report["result"]["volume"]
    (True, 15.0)
    """
    drop = may_be_not_finite(nan)
    keywords = keywords_of({"op": op, **options})
    given, face_of = _several(meshes)
    if len(given) < 2:
        raise UsageError("meshes: at least two solids are needed")
    with observer(progress) as told:
        outcome = _core.boolean([(one.vertices, one.faces, *for_core(one.attributes)) for one in given], drop, keywords, told)
    _certified_or_raise(outcome, options)
    return Result(outcome, face_of=face_of)


def bodies(meshes: Any, *, progress: Progress | bool | None = None, nan: str = "raise", **options: Any) -> Bodies:
    """Divides bodies that touch or overlap into regions with common faces; invalid ones are repaired first.

    Args:
        meshes: pairs (vertices, faces), or objects that :func:`repair` takes, a body each.
        progress, nan: as in :func:`repair`.
        **options: those of the program ``meshbodies``, with _ for -: ``overlap="own"``, ``join_gaps=0.01``, ...

    Returns:
        Each face once, with the regions on both sides. Region 0 is the outside, region k is what is left of the k-th
        mesh; those after are overlaps. ``report["bodies"]`` has the volume and the neighbours of each.

    >>> import meshrepair
    >>> def box(low, high):
    ...     corners = [(x, y, z) for x in (low, high) for y in (0, 1) for z in (0, 1)]
    ...     return corners, [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    >>> both = meshrepair.bodies([box(0, 1), box(1, 3)])
    >>> both
    <Bodies: 2 regions, 12 vertices, 22 faces, certified>
    >>> sorted(set(map(tuple, both.regions.tolist())))
    [(0, 1), (0, 2), (1, 2)]
    >>> vertices, faces = both.boundary(2)
    >>> len(vertices), len(faces)
    (8, 12)
    """
    drop = may_be_not_finite(nan)
    keywords = keywords_of(options)
    given, face_of = _several(meshes)
    if not given:
        raise UsageError("meshes: is empty")
    with observer(progress) as told:
        outcome = _core.bodies([(one.vertices, one.faces) for one in given], drop, keywords, told)
    _certified_or_raise(outcome, options)
    return Bodies(outcome, face_of)


def _several(meshes: Any) -> tuple[list[Any], npt.NDArray[Any]]:
    """The meshes, and of each of their triangles its face, counted through all of them."""
    try:
        all_meshes = list(meshes)
    except TypeError:
        raise UsageError(f"meshes: {type(meshes).__name__} is no list of meshes") from None
    given, faces_of, faces = [], [np.zeros(0, np.int32)], 0
    for number, mesh in enumerate(all_meshes):
        try:
            one = mesh_of(mesh)
        except UsageError as error:
            raise UsageError(f"operand {number}: {error}") from None
        given.append(one)
        rows = one.faces.shape[0] if one.faces.ndim > 0 else 0  # other shapes are refused later
        face_of = np.arange(rows) if one.face_of is None else one.face_of
        faces_of.append((face_of + faces).astype(np.int32))
        faces += int(face_of.max(initial=-1)) + 1
    return given, np.concatenate(faces_of)
