# SPDX-License-Identifier: MIT
"""The reference of the Python package, from its docstrings: docs/python-reference.md. Reads the code, and runs none of it."""

import ast
import dataclasses
import inspect
import pathlib
import re
import textwrap
from collections.abc import Callable

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "python/meshrepair"
SECTIONS = {"Args:": ("argument", "is"), "Attributes:": ("attribute", "is")}
HEAD = """# Python reference

All functions, classes and exceptions of the package `meshrepair`. `scripts/make_docs.py` makes this page from the docstrings.
[python.md](python.md) has examples.
"""
Table = Callable[[tuple[str, ...], list[tuple[str, ...]]], list[str]]


@dataclasses.dataclass(frozen=True)
class Named:
    """A function or a class, and the modules' other classes."""

    name: str
    node: ast.FunctionDef | ast.ClassDef

    @property
    def doc(self) -> str:
        return ast.get_docstring(self.node) or ""

    @property
    def bases(self) -> list[str]:
        return [ast.unparse(base) for base in self.node.bases] if isinstance(self.node, ast.ClassDef) else []


def public_names() -> list[str]:
    tree = ast.parse((PACKAGE / "__init__.py").read_text(encoding="utf-8"))
    listed = next(node.value for node in tree.body
                  if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "__all__")
    return [name for name in ast.literal_eval(listed) if not name.startswith("_")]


def definitions() -> dict[str, Named]:
    """Of all public names."""
    found = {}
    for path in sorted(PACKAGE.glob("*.py")):
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.FunctionDef | ast.ClassDef):
                found[node.name] = Named(node.name, node)
    return {name: found[name] for name in public_names()}


def words(text: str) -> str:
    """Markup of docstrings to that of the page."""
    text = re.sub(r":\w+:`(?:meshrepair\.)?(\w+)`", r"[`\1()`](#\1)", text)
    text = re.sub(r"\bdocs/([\w-]+\.md)", r"[\1](\1)", text)
    return text.replace("``", "`")


def entries(lines: list[str]) -> list[tuple[str, str]]:
    """Names with what is said of them; further lines are indented more."""
    found: list[list[str]] = []
    for line in inspect.cleandoc("\n".join(lines)).split("\n"):
        match = re.match(r"([\w*][\w*, ]*): (.*)", line)
        if match and not line.startswith(" "):
            found.append([match[1], match[2]])
        elif line.strip():
            found[-1][1] += " " + line.strip()
    return [("`" + name.replace(", ", "`, `") + "`", words(text)) for name, text in found]


def listed(lines: list[str]) -> list[str]:
    """A section of sentences, or of exceptions."""
    text = inspect.cleandoc("\n".join(lines))
    if re.match(r"\w+: ", text):
        return [f"- {name}: {meaning}" for name, meaning in entries(lines)]
    return [words(line) for line in text.split("\n")]


def session(lines: list[str]) -> list[str]:
    return ["```python", *lines, "```"]


def blocks(doc: str) -> list[list[str]]:
    """Paragraphs, each a list of lines; a heading and what is indented below it are one."""
    found: list[list[str]] = []
    for line in doc.split("\n"):
        if not line:
            found.append([])
        else:
            if not found:
                found.append([])
            found[-1].append(line)
    return [block for block in found if block]


def block_lines(block: list[str], table: Table) -> list[str]:
    head, rest = block[0], block[1:]
    if head in SECTIONS or head.startswith("Attributes,"):
        titles = SECTIONS.get(head, ("attribute", "is"))
        note = [] if head in SECTIONS else [head, ""]
        return note + table(titles, entries(rest))
    if head in ("Returns:", "Raises:"):
        return [f"**{head.rstrip(':')}**", "", *listed(rest)]
    if head.startswith(">>> "):
        return session(block)
    return [words(line) for line in block]


def doc_lines(doc: str, table: Table) -> list[str]:
    lines: list[str] = []
    for block in blocks(doc):
        lines += [*block_lines(block, table), ""]
    return lines


def signature_of(node: ast.FunctionDef) -> str:
    """Without types: the docstring says what each may be. Long ones take several lines."""
    arguments = ast.parse(ast.unparse(node)).body[0].args
    for one in [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs, arguments.vararg, arguments.kwarg]:
        if one is not None:
            one.annotation = None
    text = ast.unparse(arguments).removeprefix("self, ").removeprefix("self")
    return textwrap.fill(f"{node.name}({text})", 120, subsequent_indent=" " * (len("meshrepair.") + len(node.name) + 1))


def function_lines(one: Named, table: Table) -> list[str]:
    return [f"## {one.name}", "", "```text", f"meshrepair.{signature_of(one.node)}", "```", "", *doc_lines(one.doc, table)]


def methods_of(one: Named) -> list[tuple[str, str]]:
    found = []
    for node in one.node.body:
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("_") and ast.get_docstring(node):
            is_property = any(ast.unparse(decorator) == "property" for decorator in node.decorator_list)
            found.append((f"`{node.name if is_property else signature_of(node)}`",
                          words(" ".join(ast.get_docstring(node).split("\n")))))
    return found


def class_lines(one: Named, names: dict[str, Named], table: Table) -> list[str]:
    above = [f"[`{base}`](#{base.lower()})" for base in one.bases if base in names]
    lines = [f"## {one.name}", "", *([f"Is a {above[0]}.", ""] if above else []), *doc_lines(one.doc, table)]
    methods = methods_of(one)
    return lines + ([*table(("method", "does"), methods), ""] if methods else [])


def error_lines(names: dict[str, Named], table: Table) -> list[str]:
    error = names["Error"]
    rows = []
    for one in names.values():
        if "Error" in one.bases:
            code = next(ast.literal_eval(node.value) for node in one.node.body if isinstance(node, ast.Assign))
            also = [f"a `{base}`" for base in one.bases if base != "Error"]
            rows.append((code, ", ".join([f"`{one.name}`", *also]), words(one.doc)))
    rows.sort()
    return ["## Error", "", *doc_lines(error.doc, table), "All others are `Error`, too:", "",
            *table(("exception", "exit code", "means"), [(name, str(code), doc) for code, name, doc in rows]), ""]


def page(table: Table) -> str:
    """The whole page; `table` makes one of titles and rows."""
    names = definitions()
    lines = []
    for one in names.values():
        if isinstance(one.node, ast.FunctionDef):
            lines += function_lines(one, table)
    for one in names.values():
        if isinstance(one.node, ast.ClassDef) and not one.name.endswith("Error"):
            lines += class_lines(one, names, table)
    lines += error_lines(names, table)
    return HEAD + "\n" + "\n".join(line.rstrip() for line in lines).strip("\n") + "\n"
