#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the manual as a site: README.md, docs/*.md and the references of the C++ and Python interfaces.

The pages are those of the tree. What they link to, such as samples, becomes a page as well. Needs mkdocs, its theme
"material", and doxygen, which scripts/setup.sh installs; uses no network. A warning of either ends it with exit code 1.
"""

import argparse
import pathlib
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True

from manual import cpp_reference, pages  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[1]
NEEDED = ("mkdocs", "doxygen")
EXAMPLES = """examples:
  scripts/make_site.py && python3 -m http.server --directory build/site
  scripts/make_site.py --out /tmp/site"""


def config_of(collected: pathlib.Path, out: pathlib.Path) -> str:
    return f"INHERIT: {ROOT / 'mkdocs.yml'}\ndocs_dir: {collected}\nsite_dir: {out}\n"


def run(*command: object) -> None:
    """Ends this script where the command fails."""
    result = subprocess.run([str(word) for word in command], check=False)
    if result.returncode != 0:
        sys.exit(f"make_site.py: {command[0]} ended with exit code {result.returncode}")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, epilog=EXAMPLES,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "build/site", metavar="FOLDER",
                        help="folder of the site (default: build/site); what is in it goes")
    arguments = parser.parse_args()
    missing = [program for program in NEEDED if shutil.which(program) is None]
    if missing:
        sys.exit(f"make_site.py: {missing[0]} is missing: scripts/setup.sh installs it")
    out = arguments.out.resolve()
    collected = out.with_name(out.name + "-pages")
    shutil.rmtree(collected, ignore_errors=True)
    pages.collect(collected)
    cpp_reference.make(collected / "api/cpp", run)
    config = out.with_name(out.name + ".yml")
    config.write_text(config_of(collected, out), encoding="utf-8")
    run("mkdocs", "--quiet", "build", "--strict", "--clean", "--config-file", config)
    print(f"written: {out}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
