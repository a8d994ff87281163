# SPDX-License-Identifier: MIT
"""What rows of models come to: rates, medians, means and largest values of each tool."""

import statistics

from . import tables
from .model_rows import CRASHED, FULL, INPUT, LATE, NOTHING, RESULT

METRICS = {"seconds": "seconds", "memory_mb": "memory, MB", "triangle_ratio": "triangles out : in",
           "hausdorff": "Hausdorff distance : diagonal", "cpu_seconds": "CPU, s"}
DEFECTS = {"nonmanifold_edges": "no non-manifold edge", "self_intersections": "no intersection",
           "degenerate_triangles": "no degenerate triangle"}
FAILURES = (LATE, FULL, CRASHED, NOTHING)


def short(number):
    return f"{number:,.0f}" if abs(number) >= 100 else f"{number:.3g}"


def has_result(row):
    return row["status"] == RESULT


def is_solid(row):
    return row["solid"] == "yes"


def is_closed(row):
    return row["closed"] == "yes"


def is_without(defect):
    return lambda row: has_result(row) and row[defect] == 0


def values_of(rows, metric):
    return sorted(row[metric] for row in rows if has_result(row) and row[metric] is not None)


def rates_of(tool, rows):
    shares = [sum(map(is_so, rows)) for is_so in (has_result, is_solid, is_closed, *map(is_without, DEFECTS))]
    failures = [sum(row["status"].startswith(failure) for row in rows) for failure in FAILURES]
    return [tool, f"{len(rows):,}", *(f"{count:,} ({100 * count / len(rows):.1f} %)" for count in shares), *map(str, failures)]


def figures_of(tool, rows):
    def cell(metric):
        values = values_of(rows, metric)
        return " / ".join(map(short, (statistics.median(values), statistics.fmean(values), values[-1]))) if values else "-"
    return [tool, f"{sum(map(has_result, rows)):,}", *map(cell, METRICS)]


class Sums:
    """`rows`: dictionaries, numbers as numbers. `head`: what is said above them."""

    def __init__(self, rows, head):
        self.head = head
        self.all = {}
        for row in rows:
            self.all.setdefault(row["tool"], []).append(row)
        self.by_tool = {tool: rows for tool, rows in self.all.items() if tool != INPUT}

    def tables(self):
        """Title, columns and rows of each."""
        judges = sorted({row["judge"] for rows in self.by_tool.values() for row in rows if row["judge"]})
        yield (f"Rates. Counted by {' and '.join(judges) or 'nobody'}, and of the input by meshcheck.",
               ["tool", "models", "result", "solid", "closed", *DEFECTS.values(), *FAILURES],
               [rates_of(*each) for each in self.all.items()])
        columns = ["tool", "results", *METRICS.values()]
        yield "Median / mean / largest over each tool's results.", columns, [figures_of(*each) for each in self.by_tool.items()]
        if len(self.by_tool) > 1:
            common = set.intersection(*({row["model"] for row in rows if has_result(row)} for rows in self.by_tool.values()))
            yield (f"The same over the {len(common):,} models of which all tools have a result.", columns,
                   [figures_of(tool, [row for row in rows if row["model"] in common]) for tool, rows in self.by_tool.items()])

    def print_tables(self):
        print(self.head)
        for table in self.tables():
            tables.print_table(*table)
