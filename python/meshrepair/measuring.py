# SPDX-License-Identifier: MIT
"""What is wrong with a mesh, and how far two are apart."""

from __future__ import annotations

from typing import Any

from . import _core
from ._input import mesh_of
from ._options import keywords_of, raise_unless
from .errors import UsageError
from .progress import Progress, observer
from .results import Check, Distance


def check(mesh: Any, faces: Any = None, *, progress: Progress | bool | None = None, **options: Any) -> Check:
    """Lists the defects of a mesh. Vertices may be NaN or infinite.

    Args:
        mesh, faces, progress: as in :func:`repair`. Polygons are triangulated first, and the report is about triangles;
            a polygon has the marks of all its triangles.
        **options: of the program ``meshcheck``: ``weld=True``, ``places=20``, ``openings=True``, ``thickness=0.8``,
            and those of limits.

    Returns:
        A check, which is true if the mesh is the boundary of a solid.

    >>> import meshrepair
    >>> triangle = meshrepair.check([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)])
    >>> triangle
    <Check: no valid solid: open_edges 3>
    >>> bool(triangle), triangle.area, triangle.faces_with("open_edges")
    (False, 0.5, array([0]))
    """
    keywords = keywords_of(options)
    given = mesh_of(mesh, faces)
    with observer(progress) as told:
        outcome = _core.check(given.vertices, given.faces, keywords, told)
    raise_unless(outcome, 0, 1)
    return Check(outcome, given.face_of)


def distance(first: Any, second: Any, *, progress: Progress | bool | None = None, **options: Any) -> Distance:
    """Measures the distance between two meshes in both directions.

    Args:
        first, second: pairs (vertices, faces), or objects that :func:`repair` takes.
        progress: as in :func:`repair`.
        **options: of the program ``meshdist``: ``samples=200000``, ``seed=1``, ``bound=True``, ``bound_factor=1.1``.

    Returns:
        A distance: ``hausdorff`` in the unit of the meshes, and more.

    >>> import meshrepair
    >>> low = [(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)]
    >>> high = [(0, 0, 2), (1, 0, 2), (0, 1, 2)], [(0, 1, 2)]
    >>> round(meshrepair.distance(low, high).hausdorff, 12)
    2.0
    """
    keywords = keywords_of(options)
    given = []
    for name, mesh in (("first", first), ("second", second)):
        try:
            given.append(mesh_of(mesh))
        except UsageError as error:
            raise UsageError(f"{name}: {error}") from None
    with observer(progress) as told:
        outcome = _core.distance(given[0].vertices, given[0].faces, given[1].vertices, given[1].faces, keywords, told)
    raise_unless(outcome, 0)
    return Distance(outcome)
