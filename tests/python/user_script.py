# SPDX-License-Identifier: MIT
"""What a user of the package may write: mypy --strict has to find nothing in it. It is run, too."""

from __future__ import annotations

import sys

import numpy as np
import numpy.typing as npt

import meshrepair

CORNERS = [(x, y, z) for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)]
SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]


def repaired(vertices: npt.NDArray[np.float64]) -> meshrepair.Result:
    stages: list[str] = []

    def note(stage: str, share: float) -> None:
        stages.append(f"{stage} {share:.0%}")

    result = meshrepair.repair(vertices, SIDES[:5], progress=note, for_="print", seal=None, threads=1)
    report: dict[str, object] = result.report
    certified: bool = result.certified
    if not certified:
        print(report["error"], result.warnings, stages)
    return result


def volume_of(mesh: meshrepair.Mesh) -> float:
    check = meshrepair.check(mesh)
    open_edges: int = check.defects["open_edges"]
    if check.volume is None:
        raise meshrepair.NoSolidError(f"{open_edges} open edges")
    return check.volume


def main() -> int:
    vertices = np.array(CORNERS)
    solid = repaired(vertices)
    both = meshrepair.boolean([solid, (vertices + 0.5, SIDES)], "union")
    far: float = meshrepair.distance(solid, both).hausdorff
    carried: dict[str, object] = both.attributes
    try:
        points = meshrepair.repair_points(vertices, nan="drop")
    except meshrepair.Error as error:
        print(error.exit_code, error.report is None)
    else:
        print(points)
    print(volume_of(solid), volume_of(both), far, len(carried), both.vertices.dtype, both.source.max())
    return 0


if __name__ == "__main__":
    sys.exit(main())
