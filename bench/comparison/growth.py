# SPDX-License-Identifier: MIT
"""How fast time and memory grow with the input: the exponent e between two sizes, cost ~ size^e."""

import math

from .basics import seconds

LARGEST_EXPONENT = 1.15  # n log n has 1.09 from 10k to 100k
LEAST_SECONDS = 0.01  # of a stage: what is less says nothing


def exponent(first_size, first_cost, second_size, second_cost):
    """None where there is none to tell."""
    if min(first_size or 0, second_size or 0, first_cost, second_cost) <= 0 or first_size == second_size:
        return None
    return math.log(second_cost / first_cost) / math.log(second_size / first_size)


def shown(value):
    if value is None:
        return "-"
    return f"**{value:.2f}**" if value > LARGEST_EXPONENT else f"{value:.2f}"


def between(costs):
    """The exponents between neighbours of a list of sizes and costs, in a cell of a table."""
    return ", ".join(shown(exponent(*first, *second)) for first, second in zip(costs, costs[1:])) or "-"


def series_of(measured):
    """By kind and program, what was measured at each size, where there was a result."""
    found = {}
    for each in sorted(measured, key=lambda m: m.item.size):
        if not each.failed():
            found.setdefault((each.item.kind, each.program.name), []).append(each)
    return {key: series for key, series in found.items() if len(series) > 1}


def growth_rows(measured):
    """By input triangles and, for cubes, by those of the result, too: how many these are is in the nature of the cubes."""
    rows = []
    for (kind, name), series in series_of(measured).items():
        sizes = [("in", [each.item.triangles for each in series])]
        if kind == "cubes":
            sizes.append(("out", [each.triangles for each in series]))
        for by, counts in sizes:
            time = between([(count, each.least("cpu")) for count, each in zip(counts, series)])
            memory = between([(count, 0 if each.peak_hidden() else each.least("peak")) for count, each in zip(counts, series)])
            rows.append([kind, name, by, " to ".join(f"{count:,}" for count in counts if count), time, memory])
    return rows


def stage_rows(kind, sizes, stages):
    """A row for each stage that takes time: seconds at each size, and the exponents. `stages` has a dictionary for each size."""
    rows = []
    for name in dict.fromkeys(name for each in stages for name in each):
        spent = [each.get(name, 0.0) for each in stages]
        if max(spent) >= LEAST_SECONDS:
            costs = [(size, cost if cost >= LEAST_SECONDS else 0.0) for size, cost in zip(sizes, spent)]
            rows.append([kind, name, " to ".join(map(seconds, spent)), between(costs)])
    return rows
