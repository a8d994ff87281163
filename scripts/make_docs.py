#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the tables of docs/options.md and docs/report.md, and docs/python-reference.md.

The tables of options are made from what the programs print with --help-all, the tables of keys from the descriptions in
docs/report.schema.json, that of warnings from --version --json. Only the text between the markers
"<!-- made by scripts/make_docs.py: NAME -->" and "<!-- end -->" is replaced. The reference of Python is made from the docstrings of the package.
"""

import argparse
import dataclasses
import json
import os
import pathlib
import re
import subprocess
import sys
import textwrap
from collections.abc import Iterator

sys.dont_write_bytecode = True

from manual import python_reference  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
SCHEMA = DOCS / "report.schema.json"
PROGRAMS = ("meshrepair", "meshconvert", "pointmesh", "bspbuild", "bspsolid", "bspextract", "bspbool", "meshbodies", "meshcheck", "meshdist",
            "meshrepair-blocks plan", "meshrepair-blocks run", "meshrepair-blocks join")
WIDTH = 138  # of a line
UNLISTED = ("", "file")  # definitions whose keys the text of the key that refers to them names
EXAMPLES = """examples:
  scripts/make_docs.py                              # with the programs in build/release/bin
  scripts/make_docs.py --check --programs build/dev/bin"""


@dataclasses.dataclass(frozen=True)
class Option:
    """An option or argument of a program, as its help shows it."""

    group: str
    spec: str  # "-o,--output FILE"
    default: str  # empty: none
    lines: tuple[str, ...]  # of the description, with the indentation of choices

    @property
    def name(self) -> str:
        """Without short forms and type."""
        return self.spec.split()[0].split(",")[-1]


@dataclasses.dataclass
class Help:
    """What a program prints with --help-all."""

    description: str
    usage: str
    options: list[Option]
    examples: list[str]


def escaped(text: str) -> str:
    return text.replace("|", "\\|")


def row(*cells: str) -> list[str]:
    """A row of a table, and more rows where the last cell is too long for the line."""
    *first, last = map(escaped, cells)
    head = "| " + " | ".join(first) + " | "
    pieces = textwrap.wrap(last, max(40, WIDTH - len(head) - 2), break_on_hyphens=False, break_long_words=False) or [""]
    below = "| " + " | ".join("" for _ in first) + " | "
    return [f"{head if i == 0 else below}{piece} |" for i, piece in enumerate(pieces)]


def table(titles: tuple[str, ...], rows: list[tuple[str, ...]]) -> list[str]:
    lines = [*row(*titles), "|" + "---|" * len(titles)]
    for cells in rows:
        lines += row(*cells)
    return lines


# Options, from the programs

def option_of(group: str, lines: list[str]) -> Option:
    """The lines of help of one option: its spec, and its description from column 28 on."""
    match = re.match(r"  (\S+(?: \S+)?)(?:\s{2,}(.*))?$", lines[0])
    if not match:
        sys.exit(f"make_docs.py: cannot read this line of help: {lines[0]}")
    texts = [match[2] or ""] + [line[28:] for line in lines[1:]]
    default = ""
    found = re.search(r" ?\(default: (.*)\)$", texts[-1])
    if found:
        default = found[1]
        texts[-1] = texts[-1][:found.start()]
    return Option(group, match[1], default, tuple(text for text in texts if text.strip()))


def parsed_help(text: str) -> Help:
    head, *blocks = re.split(r"\n\n(?=[A-Z][a-z]+:\n)", text.strip("\n"))
    description, usage = head.split("\nUsage: ")
    result = Help(description, usage.strip(), [], [])
    for block in blocks:
        group, *lines = block.split("\n")
        group = group.rstrip(":")
        if group == "Examples":
            result.examples = [line.strip() for line in lines]
            continue
        entries: list[list[str]] = []
        for line in lines:
            if re.match(r"  \S", line):
                entries.append([line])
            elif line.strip():
                entries[-1].append(line)
        result.options += [option_of(group, entry) for entry in entries]
    return result


def read_helps(folder: pathlib.Path) -> dict[str, Help]:
    helps = {}
    for program in PROGRAMS:
        try:
            name, *verb = program.split()
            text = subprocess.run([folder / name, *verb, "--help-all"], check=True, capture_output=True, text=True).stdout
        except OSError as error:
            sys.exit(f"make_docs.py: {error.filename}: {error.strerror}; where are the programs? (--programs)")
        helps[program] = parsed_help(text)
    return helps


def is_shared(option: Option, helps: dict[str, Help]) -> bool:
    """Several programs have it, and say the same about it."""
    same_name = [other for entry in helps.values() for other in entry.options if other.name == option.name]
    return option.group != "Positionals" and len(same_name) > 1 and all(other == option for other in same_name)


def option_rows(option: Option) -> Iterator[tuple[str, str, str]]:
    texts: list[str] = []
    choices: list[tuple[str, str]] = []
    for line in option.lines:
        choice = re.match(r"  (a number(?=:)|\S+):?\s+(.*)", line)
        if choice and not line.startswith("   "):
            choices.append((choice[1], choice[2]))
        elif choices and line.startswith("   "):
            choices[-1] = (choices[-1][0], choices[-1][1] + " " + line.strip())
        elif choices:
            choices.append(("", line))
        else:
            texts.append(line)
    yield f"`{option.spec}`", f"`{option.default}`" if option.default else "", " ".join(texts)
    for name, meaning in choices:
        yield "", "", f"{name if ' ' in name else f'`{name}`'}: {meaning}" if name else meaning


def option_table(options: list[Option]) -> list[str]:
    return table(("option", "default", "meaning"), [cells for option in options for cells in option_rows(option)])


def program_lines(helps: dict[str, Help]) -> list[str]:
    lines: list[str] = []
    for program, entry in helps.items():
        own = [option for option in entry.options if not is_shared(option, helps)]
        positional = [("`" + option.spec + "`", " ".join(option.lines)) for option in own if option.group == "Positionals"]
        lines += [f"### {program}", "", entry.description, "", f"Usage: `{entry.usage}`", ""]
        lines += table(("argument", "meaning"), positional) + [""]
        rest = [option for option in own if option.group != "Positionals"]
        if rest:
            lines += option_table(rest) + [""]
        # What a verb works with is made by the one before, so these do not run alone.
        lines += ["```text" if " " in program else "```sh", *entry.examples, "```", ""]
    return lines


def shared_lines(helps: dict[str, Help]) -> list[str]:
    groups: dict[str, list[Option]] = {}
    for entry in helps.values():
        for option in entry.options:
            if is_shared(option, helps) and option not in groups.setdefault(option.group, []):
                groups[option.group].append(option)
    lines: list[str] = []
    for group, options in groups.items():
        lines += [f"### {group}", "", *option_table(options), ""]
    return lines


def matrix_lines(helps: dict[str, Help]) -> list[str]:
    """Which program has which of the options that not all have. Verbs have those of other programs."""
    programs = [program for program in PROGRAMS if " " not in program]
    names: dict[str, list[str]] = {}
    for program in programs:
        for option in helps[program].options:
            if option.group != "Positionals":
                names.setdefault(option.name, []).append(program)
    rows = []
    for name, having in names.items():
        if len(having) < len(programs):
            rows.append((f"`{name}`", *("x" if program in having else "" for program in programs)))
    return table(("option", *programs), rows)


# Keys of reports, from the schema

def definition(node: dict, schema: dict) -> tuple[str, dict]:
    """The definition that a property refers to, with its name; itself where it refers to none."""
    name = node.get("$ref", "").removeprefix("#/definitions/")
    return (name, schema["definitions"][name]) if name else ("", node)


def alternatives(node: dict, schema: dict) -> list[tuple[str, dict]]:
    """The objects with keys that a property, or the items of a list, may be."""
    nodes = node.get("anyOf", [node.get("items", node)])
    found = [definition(one, schema) for one in nodes]
    found += [inner for name, one in found if "items" in one for inner in alternatives(one, schema)]
    return [(name, one) for name, one in found if "properties" in one]


def type_of(node: dict, schema: dict) -> str:
    _, node = definition(node, schema)
    if "enum" in node or "const" in node:
        return "number" if isinstance(node.get("const", node.get("enum", [0])[0]), int) else "text"
    if "anyOf" in node:
        return "object"
    kinds = node.get("type", "object")
    kinds = [kinds] if isinstance(kinds, str) else [kind for kind in kinds if kind != "null"]
    return {"integer": "count", "string": "text", "array": "list", "boolean": "true, false"}.get(kinds[0], kinds[0])


def meaning_of(node: dict, schema: dict) -> str:
    text = node.get("description") or definition(node, schema)[1].get("description", "")
    values = definition(node, schema)[1].get("enum", [])
    return text + (" One of " + ", ".join(f"`{value}`" for value in values) + "." if len(values) > 1 else "")


def anchor(heading: str) -> str:
    """What GitHub makes of a heading, for links to it."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def heading_of(path: str, inner: dict) -> str:
    return f"`{path}`" + (f", {inner['title']}" if "title" in inner else "")


def key_table(node: dict, schema: dict, headings: dict[str, str]) -> list[str]:
    """The keys of an object; with links to the headings of those that are objects themselves."""
    rows = []
    for key, value in node["properties"].items():
        linked = [headings[name] for name, _ in alternatives(value, schema) if name in headings]
        name = f"[`{key}`](#{anchor(linked[0])})" if linked else f"`{key}`"
        rows.append((name, type_of(value, schema), meaning_of(value, schema)))
    return table(("key", "is", "holds"), rows)


def find_headings(path: str, node: dict, schema: dict, headings: dict[str, str]) -> None:
    """A heading for each definition of an object below a property, for the first place where it is."""
    for name, inner in alternatives(node, schema):
        if name in headings or name in UNLISTED:
            continue
        headings[name] = heading_of(path, inner)
        for key, value in inner["properties"].items():
            find_headings(f"{path}.{key}", value, schema, headings)


def key_lines(schema: dict) -> list[str]:
    headings: dict[str, str] = {}
    for key in sorted(schema["properties"], key=lambda name: name == "operands"):  # which repeats others
        find_headings(key, schema["properties"][key], schema, headings)
    lines = [*key_table(schema, schema, headings), ""]
    for name, heading in headings.items():
        node = schema["definitions"][name]
        lines += [f"### {heading}", "", node["description"], "", *key_table(node, schema, headings), ""]
    return lines


# Warnings, from a program

def warning_lines(folder: pathlib.Path) -> list[str]:
    facts = json.loads(subprocess.run([folder / "meshrepair", "--version", "--json"], check=True, capture_output=True).stdout)
    rows = [(f"`{kind['code']}`", "x" if kind["changes_object"] else "", kind["meaning"] + ".") for kind in facts["warnings"]]
    return table(("code", "may change the object", "meaning"), rows)


# Documents

def replaced(text: str, name: str, lines: list[str]) -> str:
    start, end = f"<!-- made by scripts/make_docs.py: {name} -->", "<!-- end -->"
    if start not in text:
        sys.exit(f"make_docs.py: the marker {start} is missing")
    before, rest = text.split(start, 1)
    after = rest.split(end, 1)[1]
    body = "\n".join(line.rstrip() for line in lines).strip("\n")
    return f"{before}{start}\n\n{body}\n\n{end}{after}"


def made(programs: pathlib.Path) -> dict[pathlib.Path, str]:
    """The text of each document that has such tables."""
    helps = read_helps(programs)
    schema = json.loads(SCHEMA.read_text(encoding="utf-8"))
    options, report = DOCS / "options.md", DOCS / "report.md"
    text = options.read_text(encoding="utf-8")
    for name, lines in (("programs", program_lines(helps)), ("options", shared_lines(helps)),
                        ("matrix", matrix_lines(helps))):
        text = replaced(text, name, lines)
    told = replaced(report.read_text(encoding="utf-8"), "keys", key_lines(schema))
    return {options: text, report: replaced(told, "warnings", warning_lines(programs)),
            DOCS / "python-reference.md": python_reference.page(table)}


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, epilog=EXAMPLES,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--programs", type=pathlib.Path, default=ROOT / "build/release/bin", metavar="FOLDER",
                        help="folder of the programs (default: build/release/bin)")
    parser.add_argument("--check", action="store_true", help="write nothing; exit code 1 if a table is not up to date")
    arguments = parser.parse_args()
    stale = [(path, text) for path, text in made(arguments.programs.resolve()).items()
             if not path.exists() or text != path.read_text(encoding="utf-8")]
    for path, text in stale:
        name = os.path.relpath(path, ROOT)
        if arguments.check:
            print(f"{name}: is not up to date: run scripts/make_docs.py", file=sys.stderr)
        else:
            path.write_text(text, encoding="utf-8")
            print(f"written: {name}")
    return 1 if stale and arguments.check else 0


if __name__ == "__main__":
    sys.exit(main())
