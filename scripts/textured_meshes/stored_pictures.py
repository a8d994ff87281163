"""Pictures in docs/pictures: written, or compared with what is there."""

import pathlib
import sys
from collections.abc import Iterable

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
