#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Builds the manual as a site, and checks what is in it.

Usage: site_test.py

Skipped where mkdocs or doxygen are missing.
"""

import html.parser
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import urllib.parse

sys.dont_write_bytecode = True

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from manual import python_reference  # noqa: E402

LOADED = {"script": "src", "img": "src", "iframe": "src", "source": "src", "link": "href"}  # by a browser, unasked


class Page(html.parser.HTMLParser):
    """Links and anchors of a page, and its paragraphs."""

    def __init__(self, path: pathlib.Path) -> None:
        super().__init__()
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.anchors = {""}
        self.paragraphs: list[str] = []
        self.in_paragraph = False
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        found = dict(attributes)
        self.anchors |= {found[key] for key in ("id", "name") if found.get(key)}
        if tag == "a" and found.get("href"):
            self.links.append(found["href"])
        if tag in LOADED and found.get(LOADED[tag]):
            self.loaded.append(found[LOADED[tag]])
        if tag == "p":
            self.in_paragraph = True
            self.paragraphs.append("")

    def handle_endtag(self, tag: str) -> None:
        self.in_paragraph = self.in_paragraph and tag != "p"

    def handle_data(self, data: str) -> None:
        if self.in_paragraph:
            self.paragraphs[-1] += data


def is_elsewhere(link: str) -> bool:
    return re.match(r"[a-z]+:|//", link) is not None


class Site(unittest.TestCase):
    """What a reader of the site meets."""

    maxDiff = None

    @classmethod
    def setUpClass(cls) -> None:
        for program in ("mkdocs", "doxygen"):
            if shutil.which(program) is None:
                raise unittest.SkipTest(f"{program} is not installed")
        cls.folder = tempfile.TemporaryDirectory(prefix="site_")
        cls.addClassCleanup(cls.folder.cleanup)
        cls.site = pathlib.Path(cls.folder.name) / "site"
        subprocess.run([sys.executable, ROOT / "scripts/make_site.py", "--out", cls.site], check=True)
        cls.pages = {path: Page(path) for path in sorted(cls.site.rglob("*.html"))}

    def test_each_document_is_in_the_navigation(self) -> None:
        text = (ROOT / "mkdocs.yml").read_text(encoding="utf-8")
        named = set(re.findall(r"docs/[\w-]+\.md", text))
        documents = {path.relative_to(ROOT).as_posix() for path in (ROOT / "docs").glob("*.md")}
        self.assertEqual(named, documents, "mkdocs.yml has to name each document under nav")

    def test_each_document_is_found(self) -> None:
        index = json.loads((self.site / "search/search_index.json").read_text(encoding="utf-8"))
        found = {entry["location"].partition("#")[0] for entry in index["docs"]}
        for path in (ROOT / "docs").glob("*.md"):
            self.assertIn(f"docs/{path.stem}.html", found)

    def test_nothing_is_loaded_from_the_network(self) -> None:
        for path, page in self.pages.items():
            self.assertEqual([link for link in page.loaded if re.match(r"(https?:)?//", link)], [], path)
        for path in self.site.rglob("*.css"):
            self.assertEqual(re.findall(r"(?:@import|url\()\W*(?:https?:)?//[^)]*", path.read_text(encoding="utf-8")), [], path)

    def test_links_lead_somewhere(self) -> None:
        broken = []
        for path, page in self.pages.items():
            for link in {link for link in page.links + page.loaded if not is_elsewhere(link)}:
                name, _, anchor = urllib.parse.unquote(link).partition("#")
                folder = self.site if name.startswith("/") else path.parent  # 404.html is shown in any folder
                target = pathlib.Path(os.path.normpath(folder / name.lstrip("/"))) if name else path
                target = target / "index.html" if target.is_dir() else target
                known = self.pages[target].anchors if target in self.pages else {""}
                if not target.is_relative_to(self.site) or not target.exists() or anchor not in known:
                    broken.append(f"{path.relative_to(self.site)}: {link}")
        self.assertEqual(broken, [])

    def test_lists_and_tables_are_no_text(self) -> None:
        """Markdown that forges understand, and the site does not."""
        for path, page in self.pages.items():
            if "api" not in path.relative_to(self.site).parts:
                found = [text for text in page.paragraphs if re.search(r"^(- |\d+\. |\||```|#+ )", text, re.MULTILINE)]
                self.assertEqual(found, [], path)
                self.assertNotIn("\\|", path.read_text(encoding="utf-8"), path)

    def test_each_header_is_in_the_reference(self) -> None:
        files = (self.site / "api/cpp/files.html").read_text(encoding="utf-8")
        for header in ROOT.glob("lib*/include/*/*.h"):
            self.assertIn(f">{header.name}<", files)

    def test_what_a_header_says_is_in_the_reference(self) -> None:
        text = (self.site / "api/cpp/group__librepair.html").read_text(encoding="utf-8")
        self.assertIn("Soup to boundary of a solid", text)
        options = (self.site / "api/cpp/structmeshrepair_1_1RepairOptions.html").read_text(encoding="utf-8")
        self.assertIn("which solids of the result stay", options)  # a comment behind a member

    def test_each_name_is_in_the_reference_of_python(self) -> None:
        page = self.site / "docs/python-reference.html"
        for name in python_reference.public_names():
            self.assertTrue(name.lower() in self.pages[page].anchors or f"<code>{name}</code>" in page.read_text(encoding="utf-8"), name)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        print(__doc__.strip())
        sys.exit(0 if sys.argv[1] in ("-h", "--help") else 2)
    unittest.main(verbosity=2)
