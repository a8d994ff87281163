# SPDX-License-Identifier: MIT
"""Turns any triangle mesh, or a point cloud, into the boundary of a solid.

>>> import meshrepair
>>> result = meshrepair.repair(vertices, faces)          # doctest: +SKIP
>>> result.vertices, result.faces, result.certified      # doctest: +SKIP

Options, results (to the byte) and reports are those of the programs; options have _ for -. The work runs without Python's
global lock, and Ctrl-C stops it.
"""

from ._core import version as __version__
from .attributes import Attributes
from .errors import (CancelledError, Error, InputError, InternalError, LimitError, NoSolidError, NotCertifiedError,
                     OutputError, UsageError)
from .files import read, write
from .folders import repair_folder
from .measuring import check, distance
from .repairing import bodies, boolean, repair, repair_file, repair_points
from .results import Bodies, Check, Distance, Mesh, Points, Result

__all__ = ["Attributes", "Bodies", "CancelledError", "Check", "Distance", "Error", "InputError", "InternalError", "LimitError",
           "Mesh", "NoSolidError", "NotCertifiedError", "OutputError", "Points", "Result", "UsageError", "__version__",
           "bodies", "boolean", "check", "distance", "read", "repair", "repair_file", "repair_folder", "repair_points", "write"]
