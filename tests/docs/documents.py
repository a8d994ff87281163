# SPDX-License-Identifier: MIT
"""What stands in the documents: blocks of commands and code, links, headings."""

import dataclasses
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCUMENTS = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]


@dataclasses.dataclass(frozen=True)
class Block:
    """A block of code between two lines of three backquotes."""

    language: str
    line: int  # of the first line after the backquotes, from 1
    lines: tuple[str, ...]


@dataclasses.dataclass(frozen=True)
class Command:
    """A command as a document shows it."""

    line: int
    text: str
    exit_code: int
    output: tuple[str, ...] | None  # what it is said to print; None: nothing is said


def name_of(document: pathlib.Path) -> str:
    return document.relative_to(ROOT).as_posix()


def blocks(document: pathlib.Path) -> list[Block]:
    found: list[Block] = []
    language, start, lines = None, 0, []
    for number, line in enumerate(document.read_text(encoding="utf-8").splitlines(), 1):
        if line.startswith("```"):
            if language is None:
                language, start, lines = line[3:].strip(), number + 1, []
            else:
                found.append(Block(language, start, tuple(lines)))
                language = None
        elif language is not None:
            lines.append(line)
    if language is not None:
        raise ValueError(f"{name_of(document)}:{start}: the block has no end")
    return found


def text_lines(document: pathlib.Path) -> list[tuple[int, str]]:
    """The lines outside of blocks, with their numbers."""
    inside = False
    found = []
    for number, line in enumerate(document.read_text(encoding="utf-8").splitlines(), 1):
        if line.startswith("```"):
            inside = not inside
        elif not inside:
            found.append((number, line))
    return found


def exit_code_of(text: str) -> int:
    """What the comment behind a command says, else 0."""
    match = re.search(r"\s#.*\bexit code (\d+)", text)
    return int(match[1]) if match else 0


def commands(document: pathlib.Path) -> list[Command]:
    """In blocks "sh", a command a line; in blocks "console", "$ command" and below it what it prints."""
    found = []
    for block in blocks(document):
        if block.language == "sh":
            found += [Command(block.line + i, line, exit_code_of(line), None)
                      for i, line in enumerate(block.lines) if line.strip()]
        elif block.language == "console":
            starts = [i for i, line in enumerate(block.lines) if line.startswith("$ ")]
            for start, end in zip(starts, starts[1:] + [len(block.lines)]):
                text = block.lines[start][2:]
                found.append(Command(block.line + start, text, exit_code_of(text), block.lines[start + 1:end]))
    return found


def anchors(document: pathlib.Path) -> set[str]:
    """What GitHub makes of the headings."""
    found: set[str] = set()
    for _, line in text_lines(document):
        match = re.match(r"#+ (.*)", line)
        if match:
            slug = re.sub(r"[^\w\- ]", "", match[1].strip().lower()).replace(" ", "-")
            number = 1
            while slug in found:
                slug = f"{slug.rsplit('-', 1)[0] if number > 1 else slug}-{number}"
                number += 1
            found.add(slug)
    return found


def links(document: pathlib.Path) -> list[tuple[int, str]]:
    """Targets of links and pictures, with their lines."""
    return [(number, target) for number, line in text_lines(document)
            for target in re.findall(r"\]\(([^)\s]+)\)", line)]
