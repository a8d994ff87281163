# SPDX-License-Identifier: MIT
"""What Jupyter shows of a mesh: a view that can be turned, and a table."""

from __future__ import annotations

import base64
import html
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from .results import Mesh

MOST_FACES = 200_000  # in a view: a notebook keeps it as text, some 50 bytes for a face
_VIEWER = Path(__file__).parent / "viewer.html"


def table_of(rows: list[tuple[str, str]]) -> str:
    cells = "".join(f"<tr><th style='text-align:left'>{html.escape(name)}</th>"
                    f"<td style='text-align:left'>{html.escape(value)}</td></tr>" for name, value in rows)
    return f"<table>{cells}</table>"


def _rows_of(mesh: Mesh) -> list[tuple[str, str]]:
    rows = [("vertices", f"{len(mesh.vertices):,}"), ("faces", f"{len(mesh.faces):,}")]
    if mesh.unit:
        rows.append(("unit", mesh.unit))
    found: dict[str, Any] = mesh.report.get("result", {})
    rows += [(name, f"{found[name]:.6g}") for name in ("volume", "area") if isinstance(found.get(name), float)]
    certified: bool | None = getattr(mesh, "certified", None)
    if certified is not None:  # a result
        rows.append(("certified", "yes" if certified else f"no: {mesh.report['error']}"))
        closed = int(np.count_nonzero(getattr(mesh, "source") < 0))
        rows.append(("faces that close gaps", f"{closed:,}"))
    rows += [("warning", line) for line in mesh.warnings]
    return rows


def _text_of(array: npt.NDArray[Any]) -> str:
    return base64.b64encode(np.ascontiguousarray(array).tobytes()).decode()


def view_of(mesh: Mesh) -> str:
    """A page that draws the mesh, in a frame; nothing of the network is needed."""
    used = np.isfinite(mesh.vertices).all(axis=1)
    points = np.where(used[:, None], mesh.vertices, 0).astype(np.float64)
    faces = mesh.faces[used[mesh.faces].all(axis=1)]
    low, high = (points[used].min(axis=0), points[used].max(axis=0)) if used.any() else (np.zeros(3), np.ones(3))
    size = float(np.linalg.norm(high - low)) or 1.0
    unit_points = ((points - (low + high) / 2) / size).astype(np.float32)
    patches = getattr(mesh, "source", None)
    marks = np.zeros(len(mesh.faces), np.uint8) if patches is None else (patches < 0).astype(np.uint8)
    marks = marks[used[mesh.faces].all(axis=1)]
    page = _VIEWER.read_text(encoding="utf-8")
    for name, array in (("POINTS", unit_points), ("FACES", faces.astype(np.uint32)), ("MARKS", marks)):
        page = page.replace(f"@{name}@", _text_of(array))
    return (f'<iframe srcdoc="{html.escape(page)}" width="480" height="360" style="border:0" '
            'title="the mesh: drag to turn, wheel to zoom"></iframe>')


def html_of(mesh: Mesh) -> str:
    if not len(mesh.faces):
        return table_of(_rows_of(mesh))
    if len(mesh.faces) > MOST_FACES:
        return table_of([*_rows_of(mesh), ("view", f"none: more than {MOST_FACES:,} faces")])
    return f"<div style='display:flex;gap:1em;align-items:flex-start'>{view_of(mesh)}{table_of(_rows_of(mesh))}</div>"
