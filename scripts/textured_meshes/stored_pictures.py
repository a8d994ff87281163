# SPDX-License-Identifier: MIT
"""Pictures in docs/pictures: written, or compared with what is there; and the command line of the scripts that draw them."""

import argparse
import pathlib
import sys
from collections.abc import Callable, Iterable

ROOT = pathlib.Path(__file__).resolve().parents[2]
PICTURES = ROOT / "docs" / "pictures"
MOST_BYTES = 60_000  # of a picture


def store(pictures: Iterable[tuple[str, bytes]], check: bool, script: str) -> int:
    """Names and bytes of each. The exit code: 1 if one is too large, or, with `check`, not up to date."""
    faults = 0
    for name, data in pictures:
        path = PICTURES / name
        if len(data) > MOST_BYTES:
            print(f"{path.relative_to(ROOT)}: {len(data)} bytes, more than {MOST_BYTES}", file=sys.stderr)
            faults += 1
        if check and not (path.exists() and path.read_bytes() == data):
            print(f"{path.relative_to(ROOT)}: is not up to date: run scripts/{script}", file=sys.stderr)
            faults += 1
        elif not check:
            path.write_bytes(data)
            print(f"written: {path.relative_to(ROOT)}")
    return 1 if faults else 0


def main(script: str, description: str, make_meshes: Callable[[pathlib.Path], None],
         pictures: Callable[[pathlib.Path], Iterable[tuple[str, bytes]]]) -> int:
    """make_meshes fills a folder; pictures draws with the programs of a folder: names, and the bytes of each. The exit code."""
    examples = f"""examples:
  scripts/{script}
  scripts/{script} --check --programs build/dev/bin
  scripts/{script} --meshes FOLDER"""
    parser = argparse.ArgumentParser(description=description, epilog=examples, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--programs", type=pathlib.Path, default=ROOT / "build/release/bin", metavar="FOLDER",
                        help="folder of the programs (default: build/release/bin)")
    parser.add_argument("--meshes", type=pathlib.Path, metavar="FOLDER", help="write the meshes there, and draw nothing")
    parser.add_argument("--check", action="store_true", help="write nothing; exit code 1 if a picture is not up to date")
    arguments = parser.parse_args()
    if arguments.meshes:
        arguments.meshes.mkdir(parents=True, exist_ok=True)
        make_meshes(arguments.meshes)
        return 0
    return store(pictures(arguments.programs.resolve()), arguments.check, script)
