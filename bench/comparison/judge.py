# SPDX-License-Identifier: MIT
"""Whether a result is the boundary of a solid, as a checker says."""

import json

from .measure import captured

YES, NO, NO_RESULT, UNJUDGED = "yes", "no", "no result", "?"
ONE_MESH = ("clean", "holes", "bumpy", "noisy", "cubes", "soup")  # whose input the result can be held against


# Columns of a table of models: keys of a judge, and of meshcheck, that are added up.
COUNTS = {"triangles_out": (("n_triangles",), ("triangles",)),
          "open_edges": (("n_boundary_edges",), ("open_edges",)),
          "nonmanifold_edges": (("n_nonmanifold_edges",), ("nonmanifold_edges",)),
          "self_intersections": (("n_self_intersecting_pairs",), ("self_intersections",)),
          "degenerate_triangles": (("n_degenerate_faces", "n_repeated_vertex_faces"), ("degenerate_triangles",)),
          "parts": (("n_components",), ("parts", "cavities"))}


class Judge:
    """A program like "judge OUT --against IN", which prints JSON; without one, our own meshcheck."""

    def __init__(self, program, meshcheck, timeout):
        self.program, self.meshcheck, self.timeout = program, meshcheck, timeout

    def name(self):
        return self.program or "meshcheck"

    def command(self, out, reference):
        if not self.program:
            return [self.meshcheck, out, "--json", "--quiet"]
        return [self.program, out, *(["--against", reference] if reference else [])]

    def said(self, out, reference=None):
        """The object that it prints; None where it prints no JSON."""
        done = captured(self.command(out, reference), self.timeout)
        try:
            said = json.loads(done[1] if done else "")
        except ValueError:
            return None
        return said if isinstance(said, dict) else {}

    def accepted(self, said):
        if self.program:
            return said.get("is_clean") is True and said.get("outward_oriented") is True
        check = said.get("check")
        return isinstance(check, dict) and check.get("valid_solid") is True

    def counts(self, said):
        """By column; None where it does not say."""
        check = said if self.program else said.get("check") or {}
        found = {**check, **{kind: defect.get("count") for kind, defect in check.get("defects", {}).items()}}

        def total(keys):
            values = [found.get(key) for key in keys]
            return None if None in values else sum(values)
        return {column: total(keys[0 if self.program else 1]) for column, keys in COUNTS.items()}

    def verdict(self, item, out):
        said = self.said(out, item.files[0] if item.kind in ONE_MESH else None)
        if said is None:
            return UNJUDGED
        return YES if self.accepted(said) else NO
