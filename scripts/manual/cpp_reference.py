# SPDX-License-Identifier: MIT
"""The reference of the C++ interface, by doxygen from the public headers."""

import pathlib
import re
import sys
from collections.abc import Callable

ROOT = pathlib.Path(__file__).resolve().parents[2]
HERE = pathlib.Path(__file__).resolve().parent


def libraries() -> list[tuple[str, str]]:
    """Names, and what each is about: the table of docs/library.md."""
    text = (ROOT / "docs/library.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| `meshrepair::(\w+)` \| [^|]* \| ([^|]*) \|$", text, re.MULTILINE)
    folders = {path.parent.name.removeprefix("lib") for path in ROOT.glob("lib*/include")}
    if {name for name, _ in rows} != folders:
        sys.exit("make_site.py: docs/library.md does not list just the libraries that there are")
    return rows


def front_page() -> str:
    lines = ["# C++ reference", "", "All public headers, by library:", ""]
    lines += [f"- @ref lib{name} \"meshrepair::{name}\": {about}" for name, about in libraries()]
    return "\n".join([*lines, "", 'How the libraries are used: <a href="../../docs/library.html">the manual</a>.', ""])


def drop_dead_links(folder: pathlib.Path) -> None:
    """Above a class with nested classes that are all private, doxygen names a section that it then leaves out."""
    link = re.compile(r'<a href="#nested-classes">Classes</a> &#124;\s*')
    for page in folder.glob("*.html"):
        text = page.read_text(encoding="utf-8")
        if link.search(text) and 'name="nested-classes"' not in text:
            page.write_text(link.sub("", text), encoding="utf-8")


def make(folder: pathlib.Path, run: Callable[..., None]) -> None:
    folder.mkdir(parents=True)
    page = folder.with_name("front_page.md")
    page.write_text(front_page(), encoding="utf-8")
    include_roots = sorted(ROOT.glob("lib*/include"))
    roots = " ".join(f'"{path}"' for path in include_roots)
    config = folder.with_name("Doxyfile")
    config.write_text((HERE / "Doxyfile").read_text(encoding="utf-8") + f"""
INPUT = "{page}" {roots}
USE_MDFILE_AS_MAINPAGE = "{page}"
STRIP_FROM_PATH = "{folder.parent}" {roots}
STRIP_FROM_INC_PATH = {roots}
OUTPUT_DIRECTORY = "{folder.parent}"
HTML_OUTPUT = {folder.name}
HTML_FOOTER = "{HERE / 'footer.html'}"
FILTER_PATTERNS = "*.h={sys.executable} {HERE / 'doxygen_filter.py'}"
""", encoding="utf-8")
    run("doxygen", config)
    drop_dead_links(folder)
    page.unlink()
    config.unlink()
