# SPDX-License-Identifier: MIT
"""Objects of other packages from arrays. None of them is imported: an object of its type shows how."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
import numpy.typing as npt

from .errors import UsageError


def mesh_like(other: Any, vertices: npt.NDArray[Any], faces: npt.NDArray[Any]) -> Any:
    """A mesh of the type of ``other``, an object of trimesh, open3d, pyvista or meshio."""
    kind = type(other)
    if hasattr(other, "_is_of_meshrepair"):
        raise UsageError("mesh: is one of meshrepair already")
    if hasattr(other, "points") and hasattr(other, "cells") and not hasattr(other, "faces"):  # meshio
        return kind(vertices, [("triangle", faces)])
    if hasattr(other, "points") and hasattr(other, "faces"):  # pyvista
        return kind(vertices, np.column_stack([np.full(len(faces), 3), faces]).ravel())
    if hasattr(other, "vertices") and hasattr(other, "triangles"):  # open3d
        utility = sys.modules[kind.__module__.split(".")[0]].utility
        return kind(utility.Vector3dVector(vertices.astype(np.float64)), utility.Vector3iVector(faces))
    if hasattr(other, "vertices") and hasattr(other, "faces"):  # trimesh
        return kind(vertices=vertices, faces=faces, process=False)
    raise UsageError(f"mesh: {kind.__name__} is no mesh of trimesh, open3d, pyvista or meshio")
