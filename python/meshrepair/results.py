# SPDX-License-Identifier: MIT
"""What the functions return."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import numpy.typing as npt

from . import notebook
from .attributes import Attributes
from .errors import UsageError


class _WithReport:
    """Has the outcome of a call. The report is parsed when it is first looked at."""

    def __init__(self, outcome: dict[str, Any]) -> None:
        self._report: str | dict[str, Any] = outcome["report"]
        self.warnings: list[str] = outcome["warnings"]

    @property
    def report(self) -> dict[str, Any]:
        """The JSON report that the program would write: see docs/report.md."""
        if isinstance(self._report, str):
            found: dict[str, Any] = json.loads(self._report)
            self._report = found
        return self._report


class Mesh(_WithReport):
    """A triangle mesh.

    Attributes:
        vertices: (n, 3) float64, or float32 where that was asked for; in the unit of the input.
        faces: (m, 3) int32, rows of ``vertices``.
        attributes: dict of arrays; see :func:`meshrepair.read`.
        unit: "millimeter" and the like, or None where it is not known.
        report: dict; the report of the program.
        warnings: list of lines.
    """

    _is_of_meshrepair = True

    def __init__(self, outcome: dict[str, Any], unit: str | None = None) -> None:
        super().__init__(outcome)
        self.vertices: npt.NDArray[Any] = outcome["vertices"]
        self.faces: npt.NDArray[Any] = outcome["faces"]
        self.attributes = Attributes(outcome["attributes"], outcome["kept"])
        self.unit = unit

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {len(self.vertices)} vertices, {len(self.faces)} faces>"

    def _repr_html_(self) -> str:
        return notebook.html_of(self)

    def like(self, other: Any) -> Any:
        """This mesh as an object of the type of ``other``: one of trimesh, open3d, pyvista or meshio."""
        from .foreign import mesh_like
        return mesh_like(other, self.vertices, self.faces)


class Result(Mesh):
    """The result of a repair or a Boolean operation.

    Attributes, in addition to those of a mesh:
        source: (m,) int32, of each face the row of the input's faces that it lies in; -1 where a gap was closed. Of a
            Boolean operation, rows count through all operands.
        certified: whether every guarantee was shown, by an exact test of these vertices and faces.
    """

    def __init__(self, outcome: dict[str, Any], unit: str | None = None, face_of: npt.NDArray[Any] | None = None) -> None:
        super().__init__(outcome, unit)
        self.certified: bool = outcome["code"] == 0
        source = outcome["source"]
        self.source: npt.NDArray[Any] = source if face_of is None else np.where(source < 0, -1, face_of[source])

    def __repr__(self) -> str:
        seal = "certified" if self.certified else "not certified"
        return f"<Result: {len(self.vertices)} vertices, {len(self.faces)} faces, {seal}>"


class Bodies(Mesh):
    """Bodies with common faces, each face once.

    Attributes, in addition to those of a mesh:
        regions: (m, 2) int32, of each face the region in front, from where it is counter-clockwise, and the one behind; 0
            is outside, and always in front.
        source: (m,) int32, of each face the row of the input's faces that it lies in, counted through all meshes.
        certified: whether no two faces intersect and each region is closed, by an exact test of these vertices and faces.
    """

    def __init__(self, outcome: dict[str, Any], face_of: npt.NDArray[Any]) -> None:
        super().__init__(outcome)
        self.certified: bool = outcome["code"] == 0
        self.regions: npt.NDArray[Any] = outcome["regions"]
        source = outcome["source"]
        self.source: npt.NDArray[Any] = np.where(source < 0, -1, face_of[source]) if len(face_of) else source

    def boundary(self, region: int) -> tuple[npt.NDArray[Any], npt.NDArray[Any]]:
        """The vertices and faces of the closed boundary of a region, from 1, turned outward."""
        count = len(self.report["bodies"]["regions"])
        if not 1 <= region <= count:
            raise UsageError(f"region: is {region}, not from 1 to {count}")
        behind, front = (self.faces[self.regions[:, side] == region] for side in (1, 0))
        faces = np.concatenate([behind, front[:, ::-1]])
        rows, numbers = np.unique(faces, return_inverse=True)
        return self.vertices[rows], numbers.reshape(-1, 3).astype(np.int32)

    def __repr__(self) -> str:
        seal = "certified" if self.certified else "not certified"
        regions = len(self.report["bodies"]["regions"])
        return f"<Bodies: {regions} regions, {len(self.vertices)} vertices, {len(self.faces)} faces, {seal}>"


class Points(_WithReport):
    """A point cloud.

    Attributes:
        points: (n, 3) float64, in the unit of the file.
        normals: (n, 3) float64 of any length, or None.
        report: dict.
        warnings: list of lines.
    """

    def __init__(self, outcome: dict[str, Any]) -> None:
        super().__init__(outcome)
        self.points: npt.NDArray[Any] = outcome["points"]
        self.normals: npt.NDArray[Any] | None = outcome["normals"]

    def __repr__(self) -> str:
        return f"<Points: {len(self.points)} points, {'with' if self.normals is not None else 'without'} normals>"


class Check(_WithReport):
    """The defects of a mesh. It is true if the mesh is the boundary of a solid.

    Attributes:
        valid_solid, closed, manifold, oriented, outward: bool.
        defects: dict, how many there are of each kind.
        marks: (m,) uint16, of each face (a triangle or polygon as given) a bit for each kind of defect that it has, in the order of ``defects``.
        volume: float in the unit of the input, cubed, or None where the mesh is not closed.
        area: float in the unit of the input, squared.
        report: dict; the section "check" has more, and the first places of each defect.
        warnings: list of lines.
    """

    def __init__(self, outcome: dict[str, Any], face_of: npt.NDArray[Any] | None = None) -> None:
        super().__init__(outcome)
        found = self.report["check"]
        self.valid_solid: bool = found["valid_solid"]
        self.closed: bool = found["closed"]
        self.manifold: bool = found["manifold"]
        self.oriented: bool = found["oriented"]
        self.outward: bool = found["outward"]
        self.defects: dict[str, int] = {name: found["defects"][name]["count"] for name in outcome["defects"]}
        self.marks: npt.NDArray[Any] = outcome["marks"]
        if face_of is not None:  # of polygons
            self.marks = np.zeros(int(face_of.max(initial=-1)) + 1, np.uint16)
            np.bitwise_or.at(self.marks, face_of, outcome["marks"])
        self.volume: float | None = found["volume"]
        self.area: float = found["area"]

    def __bool__(self) -> bool:
        return self.valid_solid

    def faces_with(self, defect: str) -> npt.NDArray[Any]:
        """The rows of the faces that have this defect."""
        if defect not in self.defects:
            raise UsageError(f"defect: {defect!r} is none of {', '.join(self.defects)}")
        bit = list(self.defects).index(defect)
        return np.flatnonzero(self.marks >> bit & 1)

    def __repr__(self) -> str:
        wrong = ", ".join(f"{name} {count}" for name, count in self.defects.items() if count)
        return f"<Check: {'a valid solid' if self.valid_solid else 'no valid solid'}{': ' * bool(wrong)}{wrong}>"

    def _repr_html_(self) -> str:
        return notebook.table_of([("verdict", "a valid solid" if self.valid_solid else "no valid solid"),
                                  *((name.replace("_", " "), str(count)) for name, count in self.defects.items())])


class Distance(_WithReport):
    """The distance between two meshes.

    Attributes:
        hausdorff: float, from below: the largest distance found, either way; in the unit of the input.
        bound: float that the distance does not exceed, or None unless ``bound=True``.
        mean, rms: pairs of floats, from the first mesh to the second and back.
        diagonal: float, of the bounding box of the first mesh.
        report: dict; the section "distance" has more.
        warnings: list of lines.
    """

    def __init__(self, outcome: dict[str, Any]) -> None:
        super().__init__(outcome)
        found = self.report["distance"]
        self.hausdorff: float = found["hausdorff"]
        self.bound: float | None = found["bound"]
        self.mean: tuple[float, float] = (found["a_to_b"]["mean"], found["b_to_a"]["mean"])
        self.rms: tuple[float, float] = (found["a_to_b"]["rms"], found["b_to_a"]["rms"])
        self.diagonal: float = found["diagonal"]

    def __repr__(self) -> str:
        return f"<Distance: {self.hausdorff:g} of a diagonal of {self.diagonal:g}>"
