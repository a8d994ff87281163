# SPDX-License-Identifier: MIT
"""The pages of the site: those of the tree, in the folders where they are, so that links between them go on working."""

import pathlib
import re
import shutil

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ["README.md", "CHANGELOG.md", "CONTRIBUTING.md", "bench/RESULTS.md", *sorted(
    path.relative_to(ROOT).as_posix() for path in (ROOT / "docs").glob("*.md"))]
LINK = re.compile(r"(\]\()([^)\s#]+)((?:#[^)\s]*)?\))")
NAMED_LINK = re.compile(r"\[[\w/-]+\.md\]\(([\w./-]+\.md)(#[\w-]*)?\)")  # its text is the name of the file
LANGUAGES = {".cpp": "cpp", ".h": "cpp", ".json": "json", ".FCMacro": "python", "": "text"}


def page_of_code(source: pathlib.Path) -> str | None:
    """A page that shows a file; None where it is none of text."""
    language = LANGUAGES.get(source.suffix)
    if language is None:
        return None
    return f"# {source.name}\n\n````{language}\n{source.read_text(encoding='utf-8').rstrip()}\n````\n"


def is_continued(cells: list[str], above: list[str]) -> bool:
    return len(cells) == len(above) and not cells[0] and any(cells)


def joined(above: str, below: str) -> str:
    """A sentence goes on, a new one gets a line of its own."""
    if not above or not below:
        return above + below
    return above + ("<br>" if above[-1] in ".:" or re.match(r"(`[^`]*`|a number):", below) else " ") + below


def with_whole_rows(text: str) -> str:
    """Rows of tables that begin with an empty cell continue the one above: a reader of the text sees that, a table does not."""
    lines: list[str] = []
    above: list[str] | None = None  # cells of the last row, if the last line is one
    for line in text.split("\n"):
        cells = [cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] if re.match(r"\|.*\|$", line) else None
        if cells and above and is_continued(cells, above):
            above = [joined(one, other) for one, other in zip(above, cells)]
            lines[-1] = "| " + " | ".join(above) + " |"
            continue
        lines.append(line)
        above = cells if cells and not re.fullmatch(r"[|\-: ]+", line) else None
    return "\n".join(with_plain_bars(line) if line.startswith("|") else line for line in lines)


def with_plain_bars(row: str) -> str:
    """Forges want a backslash before a bar in the code of a table, and Python's Markdown shows it."""
    return re.sub(r"`[^`]*`", lambda match: match[0].replace("\\|", "|"), row)


def title_of(page: pathlib.Path) -> str:
    return page.read_text(encoding="utf-8").split("\n", 1)[0].removeprefix("# ")


def with_titles(text: str, folder: pathlib.Path) -> str:
    """Links have the titles of pages, where the text has the names of their files."""
    return NAMED_LINK.sub(lambda match: f"[{title_of(folder / match[1])}]({match[1]}{match[2] or ''})", text)


class Collector:
    """Copies pages, and what they link to."""

    def __init__(self, folder: pathlib.Path) -> None:
        self.folder = folder

    def page(self, name: str) -> None:
        text = with_titles((ROOT / name).read_text(encoding="utf-8"), (ROOT / name).parent)
        text = LINK.sub(lambda match: match[1] + self.target(name, match[2]) + match[3], with_whole_rows(text))
        self.put(name, text)

    def target(self, page: str, link: str) -> str:
        """The same target, once it is there; or the page that shows it."""
        source = ((ROOT / page).parent / link).resolve()
        if ":" in link or not source.is_file() or not source.is_relative_to(ROOT):
            return link
        name = source.relative_to(ROOT).as_posix()
        if name in PAGES:
            return link
        text = page_of_code(source)
        if text is not None:
            self.put(name + ".md", text)
            return link + ".md"
        (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, self.folder / name)
        return link

    def put(self, name: str, text: str) -> None:
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def collect(folder: pathlib.Path) -> None:
    collector = Collector(folder)
    for name in PAGES:
        collector.page(name)
    collector.put("manual.css", (pathlib.Path(__file__).parent / "manual.css").read_text(encoding="utf-8"))
