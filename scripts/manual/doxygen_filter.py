#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints a header as doxygen wants it: plain comments become those that it reads, in the group of the library.

Usage: doxygen_filter.py HEADER

Comments before a declaration, or behind one on its line, become documentation; those in the body of a function do not,
nor those with an empty line below them. The first comment is about the file.
"""

import pathlib
import re
import sys

CODE_OR_SPECIAL = re.compile(r"(`[^`]*`)|([\\@<>&#%])")
COMMENT = re.compile(r"( *)// ?(.*)")
TRAILING = re.compile(r"(.*[^\s:]) +// ?(.*)")
SCOPE = re.compile(r"\b(struct|class|enum|namespace|union)\b")


def escaped(text: str) -> str:
    """Words, not commands; what is between backquotes is code anyway."""
    return CODE_OR_SPECIAL.sub(lambda match: match[1] or "\\" + match[2], text)


class Braces:
    """Whether the code that was read so far ends in the body of a function."""

    def __init__(self) -> None:
        self.stack: list[bool] = []  # of each open brace: it is that of a body, or of a value
        self.statement = ""

    def read(self, line: str) -> None:
        code = re.sub(r'"(\\.|[^"\\])*"|\'(\\.|[^\'\\])+\'', "", line.split("//")[0])
        for letter in "" if code.startswith("#") else code + " ":
            if letter == "{":
                self.stack.append("(" in self.statement or not SCOPE.search(self.statement))
            elif letter == "}" and self.stack:
                self.stack.pop()
            self.statement = "" if letter in ";{}" else self.statement + letter

    @property
    def in_body(self) -> bool:
        return any(self.stack)


def is_about_code(line: str) -> bool:
    return bool(line.strip()) and not line.lstrip().startswith(("}", "#"))


def documented(lines: list[str]) -> list[str]:
    found: list[str] = []
    braces = Braces()
    column = -1  # of the comment behind the declaration above, if there is one
    for number, line in enumerate(lines):
        alone, trailing = COMMENT.fullmatch(line), TRAILING.fullmatch(line)
        below = next((other for other in lines[number:] if not COMMENT.fullmatch(other)), "")
        if alone and len(alone[1]) == column:
            found.append(f"{alone[1]}///< {escaped(alone[2])}")
        elif alone and not braces.in_body and is_about_code(below):
            found.append(f"{alone[1]}/// {escaped(alone[2])}")
        elif trailing and not braces.in_body and is_about_code(trailing[1]):
            column = line.index("//")
            found.append(f"{trailing[1]} ///< {escaped(trailing[2])}")
        else:
            found.append(line)
        if not alone:
            column = column if trailing else -1
            braces.read(line)
    return found


def main() -> None:
    path = pathlib.Path(sys.argv[1])
    lines = path.read_text(encoding="utf-8").splitlines()
    group = [f"/// @addtogroup lib{path.parent.name} meshrepair::{path.parent.name}", "/// @{"]
    end = next(number for number, line in enumerate(lines) if not COMMENT.fullmatch(line))
    about = [f"/// {escaped(COMMENT.fullmatch(line)[2])}" for line in lines[:end]]
    code = []
    for line in documented(lines[end:]):
        code += ["/// @}", line] if line == "}  // namespace meshrepair" else [line]
        if line == "namespace meshrepair {":
            code += [*group, ""]
    print("\n".join(["/// @file", *about, *code]))


if __name__ == "__main__":
    main()
