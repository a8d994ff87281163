# SPDX-License-Identifier: MIT
"""The sums of a table of models as a page with a chart, which needs no other file."""

import html
import itertools
import math

from .sums import METRICS, is_solid, values_of

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 380, 220, 46, 16, 30, 40  # of a panel, and of what is around it
PANELS = [metric for metric in METRICS if metric != "cpu_seconds"]
LEAST = 1e-9  # what is less is drawn at the left end
COLORS = ("#4477aa", "#ee6677", "#228833", "#ccbb44", "#aa3377", "#66ccee", "#bbbbbb")
STYLE = ("body{font:15px sans-serif;margin:2em}table{border-collapse:collapse}td{white-space:nowrap}"
         "td,th{border:1px solid #ccc;padding:3px 8px;text-align:right}td:first-child,th:first-child{text-align:left}"
         "svg{max-width:900px;display:block}")
CAPTION = "The chart: of how many models a tool makes a solid that takes, or is, at most so much. Further up and left is better."


def html_row(cells, kind):
    return "<tr>" + "".join(f"<{kind}>{html.escape(cell)}</{kind}>" for cell in cells) + "</tr>"


def page(sums):
    parts = [f'<!doctype html><html lang="en"><meta charset="utf-8"><title>Repairs compared</title><style>{STYLE}</style>',
             f"<h1>Repairs compared</h1><p>{html.escape(sums.head)}</p>"]
    for title, columns, rows in sums.tables():
        body = [html_row(cells, "td") for cells in rows]
        parts += [f"<p>{html.escape(title)}</p><table>", html_row(columns, "th"), *body, "</table>"]
    return "\n".join([*parts, f"<p>{CAPTION}</p>", chart(sums.by_tool), "</html>", ""])


def chart(by_tool):
    """Four panels, one for each metric, and the names of the tools above them."""
    width, height = 2 * WIDTH, 2 * HEIGHT + TOP
    names = [f'<text x="{LEFT + i * (width - LEFT) // len(by_tool)}" y="16" fill="{color}">{html.escape(tool)}</text>'
             for i, (tool, color) in enumerate(zip(by_tool, itertools.cycle(COLORS)))]
    panels = [panel(by_tool, metric, WIDTH * (i % 2) + LEFT, HEIGHT * (i // 2) + TOP) for i, metric in enumerate(PANELS)]
    return "\n".join([f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="12">',
                      f'<rect width="{width}" height="{height}" fill="white"/>', *names, *panels, "</svg>"])


def panel(by_tool, metric, left, top):
    """Shares of models over a logarithmic axis."""
    right, bottom = left + WIDTH - LEFT - RIGHT, top + HEIGHT - BOTTOM
    found = {tool: values_of(filter(is_solid, rows), metric) for tool, rows in by_tool.items()}
    powers = [math.log10(value) for values in found.values() for value in values if value > LEAST]
    low, high = math.floor(min(powers, default=0)), math.ceil(max(powers, default=1))
    high = max(high, low + 1)

    def x(power):
        return round(left + (right - left) * max(0.0, (power - low) / (high - low)))
    lines = [f'<path d="M{left} {top} V{bottom} H{right}" fill="none" stroke="#444"/>',
             f'<text x="{(left + right) / 2}" y="{bottom + 30}" text-anchor="middle">{METRICS[metric]}</text>',
             f'<text x="{left - 4}" y="{top + 9}" text-anchor="end">100 %</text>',
             f'<text x="{left - 4}" y="{bottom}" text-anchor="end">0 %</text>']
    for power in range(low, high + 1, math.ceil((high - low) / 5)):
        lines.append(f'<text x="{x(power)}" y="{bottom + 15}" text-anchor="middle">{10.0 ** power:g}</text>')
    for (tool, values), color in zip(found.items(), itertools.cycle(COLORS)):
        counts = {x(math.log10(max(value, LEAST))): i + 1 for i, value in enumerate(values)}  # the last of each pixel
        steps = "".join(f" H{at} V{bottom - (bottom - top) * count / len(by_tool[tool]):.1f}" for at, count in counts.items())
        lines.append(f'<path d="M{left} {bottom}{steps} H{right}" fill="none" stroke="{color}" stroke-width="1.5"/>')
    return "\n".join(lines)
