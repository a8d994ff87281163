#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the libraries, their rooms and what links what, as docs/pictures/architecture.svg.

All of it comes from the CMakeLists.txt of the libraries and from their folders.
"""

import argparse
import re
import sys
from html import escape
from pathlib import Path

sys.dont_write_bytecode = True

from check_structure import HEADERS_ALONE, ROOT, Library, closure, read_libraries  # noqa: E402

PICTURE = ROOT / "docs/pictures/architecture.svg"

WIDTH, HEIGHT = 300, 112  # of a box
COLUMN, ROW = 330, 160
MARGIN = 20
LETTERS_ON_A_LINE = 46


def without_detours(links: dict[str, set[str]]) -> dict[str, set[str]]:
    """Only the arrows that no way over others stands for."""
    reached = closure(links)
    return {
        name: {t for t in targets if not any(t in reached[u] for u in targets if u != t)}
        for name, targets in links.items()
    }


def depths(links: dict[str, set[str]]) -> dict[str, int]:
    """The longest way down from each library."""
    found: dict[str, int] = {}

    def depth(name: str) -> int:
        if name not in found:
            found[name] = max((depth(target) + 1 for target in links[name]), default=0)
        return found[name]

    for name in links:
        depth(name)
    return found


def places(links: dict[str, set[str]]) -> dict[str, tuple[float, float]]:
    """The upper left corner of each box: a row for each depth, the lowest at the bottom."""
    rows = depths(links)
    last = max(rows.values())
    corners = {}
    for row in range(last + 1):
        names = sorted(name for name in links if rows[name] == row)
        # Rows of one or two stand over the first two columns; those to the right are free for long arrows.
        first = 0.5 if len(names) == 1 else 0
        for column, name in enumerate(names):
            corners[name] = (MARGIN + (first + column) * COLUMN, MARGIN + (last - row + 1) * ROW)
    return corners


def knows(library: Library) -> str:
    found = re.search(r'KNOWS "([^"]*)"', (library.folder / "CMakeLists.txt").read_text())
    return found.group(1) if found else ""


def folded(words: list[str], separator: str) -> list[str]:
    """Lines of words that fit into a box."""
    lines: list[str] = []
    for word in words:
        if lines and len(lines[-1]) + len(separator) + len(word) <= LETTERS_ON_A_LINE:
            lines[-1] += separator + word
        else:
            lines.append(word)
    return lines


def room_names(library: Library) -> list[str]:
    """Rooms, each with the names of the rooms in it."""
    rooms = sorted({r for r in library.room_of.values() if r and r != HEADERS_ALONE})
    tops = sorted({room.split("/")[0] for room in rooms})
    names = []
    for top in tops:
        inner = [room.split("/", 1)[1] for room in rooms if room.startswith(top + "/")]
        names.append(f"{top} ({', '.join(inner)})" if inner else top)
    return names


def text(x: float, y: float, style: str, words: str) -> str:
    return f'<text x="{x:g}" y="{y:g}" class="{style}">{escape(words)}</text>'


def box(library: Library, corner: tuple[float, float]) -> list[str]:
    x, y = corner
    lines = [f'<rect x="{x:g}" y="{y:g}" width="{WIDTH}" height="{HEIGHT}" rx="6"/>']
    lines.append(text(x + 12, y + 24, "name", library.folder.name))
    at = y + 42
    for line in folded(knows(library).split(), " "):
        lines.append(text(x + 12, at, "knows", line))
        at += 15
    for line in folded(room_names(library), " · "):
        lines.append(text(x + 12, at + 3, "rooms", line))
        at += 14
    return lines


def arrow(start: tuple[float, float], end: tuple[float, float]) -> str:
    (x1, y1), (x2, y2) = start, end
    return f'<line x1="{x1:g}" y1="{y1:g}" x2="{x2:g}" y2="{y2:g}" marker-end="url(#head)"/>'


def shift(position: int, of: int) -> float:
    """Spreads the ends of arrows over a side of a box."""
    return WIDTH * (position + 1) / (of + 1)


def arrows(links: dict[str, set[str]], corners: dict[str, tuple[float, float]]) -> list[str]:
    users: dict[str, list[str]] = {name: [] for name in links}
    for name in sorted(links, key=lambda n: corners.get(n, (0, 0))):
        for target in links[name]:
            users[target].append(name)
    lines = []
    for name, targets in links.items():
        for position, target in enumerate(sorted(targets, key=lambda t: corners[t])):
            x, y = corners[target]
            end = (x + shift(users[target].index(name), len(users[target])), y)
            if name in corners:
                from_x, from_y = corners[name]
                start = (from_x + shift(position, len(targets)), from_y + HEIGHT)
            else:  # the programs, all over the top
                start = (end[0], float(MARGIN + HEIGHT / 2))
            lines.append(arrow(start, end))
    return lines


def draw() -> str:
    libraries = read_libraries()
    links = {name: library.links for name, library in libraries.items()}
    corners = places(links)
    top = {name for name in links if not any(name in targets for targets in links.values())}
    drawn = without_detours(links) | {"programs": top}
    width = max(x for x, _ in corners.values()) + WIDTH + MARGIN
    height = max(y for _, y in corners.values()) + HEIGHT + MARGIN
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:g} {height:g}" width="{width:g}" height="{height:g}">',
        "<title>The libraries of meshrepair, their rooms, and what links what</title>",
        "<style>rect{fill:#f6f8fa;stroke:#57606a}line{stroke:#57606a;stroke-width:1.5}"
        "text{font-family:sans-serif;fill:#1f2328}.name{font-size:17px;font-weight:bold}"
        ".knows{font-size:12px}.rooms{font-size:11px;fill:#57606a}</style>",
        '<rect width="100%" height="100%" style="fill:#ffffff;stroke:none"/>',
        '<defs><marker id="head" viewBox="0 0 8 8" refX="8" refY="4" markerWidth="8" markerHeight="8" orient="auto">'
        '<path d="M0 0L8 4L0 8z" fill="#57606a"/></marker></defs>',
    ]
    lines += arrows(drawn, corners)
    lines.append(f'<rect x="{MARGIN}" y="{MARGIN}" width="{width - 2 * MARGIN:g}" height="{HEIGHT / 2:g}" rx="6"/>')
    lines.append(text(MARGIN + 12, MARGIN + 24, "name", "apps"))
    lines.append(text(MARGIN + 12, MARGIN + 42, "knows", "options, printing and exit codes of the programs, and no geometry"))
    for name in sorted(corners):
        lines += box(libraries[name], corners[name])
    return "\n".join(lines + ["</svg>", ""])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="write nothing; fail if the picture is not up to date")
    options = parser.parse_args()
    picture = draw()
    if options.check:
        if PICTURE.exists() and PICTURE.read_text() == picture:
            return 0
        print(f"{PICTURE.relative_to(ROOT)} is not up to date: run scripts/make_architecture.py", file=sys.stderr)
        return 1
    PICTURE.parent.mkdir(parents=True, exist_ok=True)
    PICTURE.write_text(picture)
    return 0


if __name__ == "__main__":
    sys.exit(main())
