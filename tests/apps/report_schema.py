#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Holds reports of the programs against docs/report.schema.json.

Usage: report_schema.py REPORT...

Prints what does not fit; exit code 1 if anything does not.

Example: meshcheck part.stl --report r.json; tests/apps/report_schema.py r.json
"""

import json
import pathlib
import sys
from collections.abc import Iterator

try:
    import jsonschema
except ImportError:
    sys.exit("report_schema.py: python3-jsonschema is missing: scripts/setup.sh build installs it")

SCHEMA = pathlib.Path(__file__).resolve().parents[2] / "docs" / "report.schema.json"


def as_of_a_program(report: dict) -> dict:
    """The report of the tests' own program, "probe", as if it were of one of the project's."""
    if report.get("program") != "probe":
        return report
    return {**{key: value for key, value in report.items() if key != "probe"}, "program": "meshcheck"}


def complaints(text: bytes) -> Iterator[str]:
    """What of a report is not as the schema says, one line for each place."""
    try:
        report = json.loads(text)
    except ValueError as error:
        yield f"no JSON: {error}"
        return
    schema = json.loads(SCHEMA.read_text(encoding="utf-8"))
    for error in jsonschema.Draft7Validator(schema).iter_errors(as_of_a_program(report)):
        deepest = jsonschema.exceptions.best_match([error])
        place = ".".join(map(str, deepest.absolute_path)) or "the whole"
        yield f"{place}: {deepest.message[:300]}"


def main() -> int:
    if len(sys.argv) < 2 or sys.argv[1] in ("-h", "--help"):
        print(__doc__.strip())
        return 0 if len(sys.argv) == 2 else 2
    found = [f"{name}: {line}" for name in sys.argv[1:]
             for line in complaints(pathlib.Path(name).read_bytes())]
    print("\n".join(found) if found else "all fit")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
