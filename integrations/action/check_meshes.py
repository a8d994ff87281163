#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the meshes of a repository with meshcheck: by hand, as a hook of pre-commit, and on GitHub.

Usage: check_meshes.py [--pages FOLDER] [--repair FOLDER] [MESH...]

Without a MESH, all meshes that git tracks in this folder and below. A line for each mesh that does not bound a solid says what is wrong,
and where first. On GitHub, that is an annotation of the file, and the summary of the job gets a table. The programs are those in PATH.

  --pages FOLDER   a page for each such mesh, which shows its defects in a browser
  --repair FOLDER  what meshrepair makes of each

Exit codes: 0 all bound solids, 1 some do not, or cannot be read, 2 wrong usage, no meshcheck, or a folder that cannot be made.

Example: check_meshes.py --pages pages models/*.stl
"""

import argparse
import dataclasses
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import urllib.parse

EXTENSIONS = ("stl", "obj", "off", "ply", "glb", "gltf", "3mf")
HARMLESS = "unused_points"
LFS_POINTER = b"version https://git-lfs.github.com/"
MOST_BYTES_OF_A_NAME = 200
USAGE = 2


@dataclasses.dataclass
class Verdict:
    mesh: str
    triangles: int | None = None
    wrong: str = ""  # empty: it bounds a solid
    repaired: str = ""  # what became of it


def stop(why: str) -> None:
    print(f"check_meshes.py: {why}", file=sys.stderr)
    sys.exit(USAGE)


def place(first: dict) -> str:
    """Where a defect is, if it says so."""
    at = first.get("at")
    return f", first at ({', '.join(f'{x:.6g}' for x in at)})" if at else ""


def defects(check: dict) -> str:
    found = [(key.replace("_", " "), defect) for key, defect in check["defects"].items() if key != HARMLESS and defect["count"] > 0]
    return "; ".join(f"{words}: {defect['count']:,}{place((defect.get('first') or [{}])[0])}" for words, defect in found)


def run(command: list) -> subprocess.CompletedProcess:
    try:
        return subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, check=False, text=True, errors="replace")
    except FileNotFoundError:
        stop(f"{command[0]} is not in PATH: install meshrepair, for example by npm install --global meshrepair")


def flat_name(mesh: str) -> str:
    """The name of a file about this mesh in a folder without folders: no two meshes have the same, and all systems and archives take it."""
    name = urllib.parse.quote(os.fsencode(os.path.normpath(mesh)), safe=" ,+=@()[]!&")
    if name.startswith("."):
        name = "%2E" + name[1:]
    return name if len(name) <= MOST_BYTES_OF_A_NAME else hashlib.sha256(name.encode()).hexdigest()[:16] + name[-MOST_BYTES_OF_A_NAME + 16:]


def is_pointer(mesh: str) -> bool:
    try:
        with open(mesh, "rb") as file:
            return file.read(len(LFS_POINTER)) == LFS_POINTER
    except OSError:
        return False


def checked(mesh: str, pages: pathlib.Path | None) -> Verdict:
    if is_pointer(mesh):
        return Verdict(mesh, wrong="is a pointer of Git LFS, and not the mesh: git lfs pull, or lfs: true of actions/checkout, fetches it")
    with tempfile.TemporaryDirectory() as folder:
        report, page = pathlib.Path(folder) / "report.json", pathlib.Path(folder) / "page.html"
        show = ["--html", str(page)] if pages else []
        done = run(["meshcheck", "--quiet", "--report", str(report), *show, "--", mesh])
        check = json.loads(report.read_text(encoding="utf-8")).get("check") if report.exists() else None
        if done.returncode not in (0, 1) or check is None:
            return Verdict(mesh, wrong=(done.stderr.strip().splitlines() or [f"meshcheck ended with {done.returncode}"])[-1])
        verdict = Verdict(mesh, check["triangles"])
        if done.returncode == 1:
            verdict.wrong = defects(check) or "encloses nothing"
            if pages and page.exists():
                (pages / f"{flat_name(mesh)}.html").write_bytes(page.read_bytes())
    return verdict


def repair(verdict: Verdict, folder: pathlib.Path, meshes: list[str]) -> None:
    out = folder / flat_name(verdict.mesh)
    if out.exists() and any(os.path.exists(mesh) and out.samefile(mesh) for mesh in meshes):
        verdict.repaired = f"{out} is a mesh to check, and is not overwritten"
        return
    done = run(["meshrepair", "--quiet", "--", verdict.mesh, str(out)])
    verdict.repaired = str(out) if done.returncode == 0 else (done.stderr.strip().splitlines() or ["not repaired"])[-1]


def escaped(text: str, more: dict | None = None) -> str:
    """For a workflow command of GitHub; `more` is escaped in its properties alone."""
    for character, code in {"%": "%25", "\r": "%0D", "\n": "%0A", **(more or {})}.items():
        text = text.replace(character, code)
    return text


def annotation(verdict: Verdict) -> str:
    return f"::error file={escaped(verdict.mesh, {':': '%3A', ',': '%2C'})},title=Not a valid solid::{escaped(verdict.wrong)}"


def in_table(text: str) -> str:
    """Text in a cell: no markup, and no end of the cell."""
    for character in "\\`*_[]<>|":
        text = text.replace(character, "\\" + character)
    return " ".join(text.split())


def summary(verdicts: list[Verdict]) -> str:
    bad = [verdict for verdict in verdicts if verdict.wrong]
    lines = [f"### {len(verdicts) - len(bad):,} of {len(verdicts):,} meshes bound solids", ""]
    if bad:
        lines += ["| mesh | triangles | what is wrong | repaired |", "|---|---:|---|---|"]
        lines += [f"| {in_table(one.mesh)} | {'' if one.triangles is None else f'{one.triangles:,}'} | {in_table(one.wrong)} "
                  f"| {in_table(one.repaired)} |" for one in bad]
    return "\n".join(lines) + "\n"


def tracked() -> list[str]:
    patterns = [f":(icase)*.{one}" for one in EXTENSIONS]
    done = subprocess.run(["git", "ls-files", "-z", "--", *patterns], capture_output=True, check=False)
    if done.returncode != 0:
        stop("no MESH is named, and this folder is not in a repository of git")
    return sorted(os.fsdecode(name) for name in done.stdout.split(b"\0") if name and os.path.isfile(name))


def add_summary(path: str, verdicts: list[Verdict]) -> None:
    try:
        with open(path, "a", encoding="utf-8", errors="replace") as out:
            out.write(summary(verdicts))
    except OSError as error:
        print(f"check_meshes.py: {path}: {error.strerror}", file=sys.stderr)


def main() -> int:
    parser = argparse.ArgumentParser(usage=__doc__.strip().splitlines()[2].removeprefix("Usage: "),
                                     description="\n".join(__doc__.strip().splitlines()[4:]),
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pages", type=pathlib.Path, help=argparse.SUPPRESS)
    parser.add_argument("--repair", type=pathlib.Path, help=argparse.SUPPRESS)
    parser.add_argument("mesh", nargs="*", help=argparse.SUPPRESS)
    options = parser.parse_args()
    sys.stdout.reconfigure(errors="backslashreplace")  # not every name is text
    on_github = os.environ.get("GITHUB_ACTIONS") == "true"
    for folder in filter(None, (options.pages, options.repair)):
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            stop(f"{folder}: {error.strerror}")
    verdicts, meshes = [], options.mesh or tracked()
    for mesh in meshes:
        verdict = checked(mesh, options.pages)
        verdicts.append(verdict)
        if not verdict.wrong:
            continue
        if options.repair:
            repair(verdict, options.repair, meshes)
        print(annotation(verdict) if on_github else f"{mesh}: {verdict.wrong}", flush=True)
        if verdict.repaired:
            print(f"{mesh}: repaired: {verdict.repaired}", flush=True)
    bad = sum(bool(verdict.wrong) for verdict in verdicts)
    print(f"{len(verdicts) - bad:,} of {len(verdicts):,} meshes bound solids")
    if os.environ.get("GITHUB_STEP_SUMMARY"):
        add_summary(os.environ["GITHUB_STEP_SUMMARY"], verdicts)
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
