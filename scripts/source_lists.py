#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes a list of sources for apt into a folder: for each of this machine's sources of Debian's packages the one of its sources, or,
with "deb", the same again, for other architectures.

Usage: source_lists.py FOLDER [deb-src|deb]
"""

import pathlib
import re
import sys

LISTS = pathlib.Path("/etc/apt")
DEBIAN = re.compile(r"^https?://\S*debian", re.IGNORECASE)


def stanzas():
    """The fields of each stanza of the .sources files, those of one-line lists as if they were stanzas."""
    for path in sorted((LISTS / "sources.list.d").glob("*.sources")):
        for text in re.split(r"\n\s*\n", path.read_text()):
            fields = re.findall(r"^([A-Za-z-]+):[ \t]*(.*)$", text, re.MULTILINE)
            if fields:
                yield {key.lower(): value for key, value in fields}
    lists = [LISTS / "sources.list", *sorted((LISTS / "sources.list.d").glob("*.list"))]
    for path in lists:
        if not path.is_file():
            continue
        for line in path.read_text().splitlines():
            match = re.match(r"^deb\s+(?:\[[^\]]*\]\s+)?(\S+)\s+(\S+)\s+(.+)$", line)
            if match:
                yield {"types": "deb", "uris": match[1], "suites": match[2], "components": match[3].split("#")[0].strip()}


def main():
    kind = sys.argv[2] if len(sys.argv) == 3 else "deb-src"
    if len(sys.argv) not in (2, 3) or sys.argv[1].startswith("-") or kind not in ("deb-src", "deb"):
        print(__doc__.strip(), file=sys.stderr)
        return 2
    wanted = [fields for fields in stanzas()
              if "deb" in fields.get("types", "").split() and DEBIAN.match(fields.get("uris", "")) and "components" in fields]
    if not wanted:
        print("source_lists.py: apt has no source of Debian's packages", file=sys.stderr)
        return 1
    text = "".join(
        f"Types: {kind}\nURIs: {fields['uris']}\nSuites: {fields['suites']}\nComponents: {fields['components']}\n"
        f"Signed-By: {fields.get('signed-by', '/usr/share/keyrings/debian-archive-keyring.gpg')}\n\n" for fields in wanted)
    (pathlib.Path(sys.argv[1]) / "debian.sources").write_text(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
