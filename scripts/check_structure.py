#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks the structure of the code: which library, which room and which module uses which.

A library is a folder libNAME with a CMakeLists.txt; a room is a folder in its src. What lies
directly in src is the library's own room, which may use all others. Fails where

- a library includes one that its CMakeLists.txt does not link, or libraries link in a circle;
- the rooms of a library, or the folders of apps, include each other in a circle;
- a source of apps, capi, python or web/wasm includes what is neither beside it nor in apps, nor in a library;
- modules of python, scripts and web import each other in a circle;
- a room has more than one private header that other rooms include: its door (a room named `common`
  is a box of tools, all of which are for others);
- a folder holds more than 15 sources;
- a file other than the door to oneTBB, libbase/src/parallel.cpp, includes or names what is oneTBB's;
- a test of a source of its name stands in another room;
- a source does not begin with its licence;
- .clang-format or .clang-tidy does not know a library.
"""

import argparse
import os
import re
import subprocess
import sys
from collections import defaultdict
from pathlib import Path

MOST_SOURCES = 15
TOOLS = "common"
ROOT = Path(__file__).resolve().parent.parent
INCLUDE = re.compile(r'^#include ([<"])([^>"]+)[>"]', re.MULTILINE)
APPS = ROOT / "apps"
ABOVE_APPS = ("capi", "python", "web/wasm")
MODULES = ("bench/", "integrations/", "python/", "scripts/", "web/")
JS_IMPORT = re.compile(r"""^(?:import|export)\b[^;"']*["'](\.[^"']+)["']""", re.MULTILINE)
PY_IMPORT = re.compile(r"^(?:from|import) +([\w.]+)(?: +import +\(?([^)\n]*))?", re.MULTILINE)
LICENCE = "SPDX-License-Identifier: MIT"
SOURCES = ("*.h", "*.cpp", "*.c", "*.js", "*.mjs", "*.py", "*.rs", "*.sh")
TBB_DOOR = ROOT / "libbase/src/parallel.cpp"
TBB_NAME = re.compile(r"\b(tbb|oneapi)(/|::)")
LIBRARY_CALL = re.compile(r"meshrepair_library\((.*?)\)\n", re.DOTALL)


class Library:
    """A library: what it links, and its files by room."""

    def __init__(self, folder: Path) -> None:
        self.name = folder.name.removeprefix("lib")
        self.folder = folder
        self.src = folder / "src"
        call = LIBRARY_CALL.search((folder / "CMakeLists.txt").read_text())
        assert call is not None, f"{folder} has no meshrepair_library()"
        link = re.search(r"\bLINK (.*?)(LINK_PRIVATE|$)", call.group(1), re.DOTALL)
        self.links = set(re.findall(r"meshrepair::(\w+)", link.group(1) if link else ""))
        self.sources = sorted(self.src.rglob("*.cpp"))
        self.private = sorted(self.src.rglob("*.h"))
        self.public = sorted((folder / "include").rglob("*.h"))
        self.room_of = {p: self.room_of_path(p) for p in self.sources + self.private}
        self.room_of |= {p: self.room_of_public(p) for p in self.public}

    def room_of_path(self, path: Path) -> str:
        return str(path.parent.relative_to(self.src)).removeprefix(".")

    def room_of_public(self, header: Path) -> str:
        """The room of the source of the same name; headers without one have no room."""
        for source in self.sources:
            if source.stem == header.stem:
                return self.room_of_path(source)
        return HEADERS_ALONE

    def files(self) -> list[Path]:
        return self.sources + self.private + self.public


HEADERS_ALONE = "(headers)"


def read_libraries() -> dict[str, Library]:
    folders = sorted(p.parent for p in ROOT.glob("lib*/CMakeLists.txt"))
    return {library.name: library for library in map(Library, folders)}


def includes_of(path: Path) -> list[tuple[str, str]]:
    return INCLUDE.findall(path.read_text())


def closure(links: dict[str, set[str]]) -> dict[str, set[str]]:
    """What each reaches, over any number of arrows."""
    reached: dict[str, set[str]] = {}
    for start in links:
        seen: set[str] = set()
        waiting = list(links[start])
        while waiting:
            name = waiting.pop()
            if name not in seen:
                seen.add(name)
                waiting.extend(links.get(name, ()))
        reached[start] = seen
    return reached


def circles(links: dict[str, set[str]]) -> list[str]:
    return [name for name, seen in closure(links).items() if name in seen]


def check_libraries(libraries: dict[str, Library], faults: list[str]) -> dict[str, set[str]]:
    """The arrows between libraries, as included."""
    links = {name: library.links for name, library in libraries.items()}
    faults += [f"lib{name} links itself, in a circle" for name in circles(links)]
    reached = closure(links)
    arrows: dict[str, set[str]] = {name: set() for name in libraries}
    for name, library in libraries.items():
        for path in library.files():
            for kind, target in includes_of(path):
                other = target.split("/")[0]
                if kind != "<" or other not in libraries or other == name:
                    continue
                arrows[name].add(other)
                if other not in reached[name]:
                    where = path.relative_to(ROOT)
                    faults.append(f"{where} includes <{target}>, but lib{name} does not link {other}")
    return arrows


def target_of(library: Library, path: Path, kind: str, target: str) -> Path | None:
    """The file of the same library that is included, if it is one."""
    if kind == "<":
        header = library.folder / "include" / target
        return header if header.exists() else None
    for folder in (path.parent, library.src):
        if (folder / target).exists():
            return folder / target
    return None


def check_rooms(library: Library, faults: list[str]) -> dict[str, set[str]]:
    """The arrows between the rooms of a library."""
    arrows: dict[str, set[str]] = {room: set() for room in library.room_of.values()}
    doors: dict[str, set[Path]] = defaultdict(set)
    for path in library.files():
        room = library.room_of[path]
        for kind, target in includes_of(path):
            header = target_of(library, path, kind, target)
            if header is None:
                continue
            other = library.room_of[header]
            if other in (room, HEADERS_ALONE) or room == HEADERS_ALONE:
                continue
            arrows[room].add(other)
            if header in library.private and not other.endswith(TOOLS):
                doors[other].add(header)
    faults += [f"lib{library.name}/src/{room}: includes itself, in a circle" for room in circles(arrows)]
    for room, headers in sorted(doors.items()):
        if len(headers) > 1:
            names = ", ".join(sorted(h.name for h in headers))
            faults.append(f"lib{library.name}/src/{room}: other rooms include {len(headers)} private headers: {names}")
    return arrows


def check_sizes(library: Library, faults: list[str]) -> None:
    count: dict[Path, int] = defaultdict(int)
    for source in library.sources:
        count[source.parent] += 1
    for folder, sources in count.items():
        if sources > MOST_SOURCES:
            faults.append(f"{folder.relative_to(ROOT)}: {sources} sources, more than {MOST_SOURCES}")


def check_tests(library: Library, faults: list[str]) -> None:
    """A test of the name of a source, or a header, stands in the same room."""
    tests = ROOT / "tests" / library.folder.name
    rooms = {p.stem: room for p, room in library.room_of.items() if room != HEADERS_ALONE}
    for test in sorted(tests.rglob("*_test.cpp")):
        stem = test.stem.removesuffix("_test")
        room = str(test.parent.relative_to(tests)).removeprefix(".")
        if stem in rooms and rooms[stem] != room:
            faults.append(f"{test.relative_to(ROOT)}: its source is in the room '{rooms[stem]}'")


def check_tbb(faults: list[str]) -> None:
    """Without oneTBB the door alone is to be replaced."""
    folders = [*ROOT.glob("lib*"), *(ROOT / name for name in ("apps", "bench", "samples", "tests"))]
    for path in sorted(p for folder in folders for p in folder.rglob("*") if p.suffix in (".h", ".cpp")):
        found = TBB_NAME.search(path.read_text())
        if found is not None and path != TBB_DOOR:
            faults.append(f"{path.relative_to(ROOT)}: names {found.group()}, which is for {TBB_DOOR.relative_to(ROOT)}")


def check_tools(libraries: dict[str, Library], faults: list[str]) -> None:
    for tool, line in ((".clang-format", "- Regex:"), (".clang-tidy", "HeaderFilterRegex:")):
        known = set(re.findall(r"\w+", next(text for text in Path(tool).read_text().splitlines() if line in text)))
        faults += [f"{tool} does not know lib{name}" for name in sorted(set(libraries) - known)]


def room_in_apps(path: Path) -> str:
    """A source in apps itself is a program, which may use all rooms."""
    return "" if path.parent == APPS else path.parent.name


def check_programs(faults: list[str]) -> tuple[dict[str, list[Path]], dict[str, set[str]]]:
    """The rooms of the programs, and the arrows between them and from what is built on them."""
    rooms: dict[str, list[Path]] = defaultdict(list)
    for path in sorted(p for p in APPS.rglob("*") if p.suffix in (".h", ".cpp")):
        rooms[room_in_apps(path)].append(path)
    arrows: dict[str, set[str]] = {room: set() for room in rooms}
    above = [p for name in ABOVE_APPS for p in sorted((ROOT / name).rglob("*")) if p.suffix in (".h", ".cpp")]
    for path in [p for paths in rooms.values() for p in paths] + above:
        room = str(path.parent.relative_to(ROOT)) if path in above else room_in_apps(path)
        for kind, target in includes_of(path):
            header = APPS / target
            if kind != '"' or (path.parent / target).exists():
                continue
            if not header.exists():
                faults.append(f"{path.relative_to(ROOT)} includes {target}, which is neither beside it nor in apps")
            elif header.parent.name != room:
                arrows.setdefault(room, set()).add(header.parent.name)
    faults += [f"apps/{room}: includes itself, in a circle" for room in circles(arrows)]
    for room, paths in rooms.items():
        sources = sum(p.suffix == ".cpp" for p in paths)
        if sources > MOST_SOURCES:
            faults.append(f"apps/{room}: {sources} sources, more than {MOST_SOURCES}")
    return rooms, arrows


def module_of(path: Path, name: str, modules: set[Path]) -> Path | None:
    """The file of the project that an import of this name means, if it is one."""
    if path.suffix == ".js":
        found = [(path.parent / name).resolve()]
    else:
        dots = len(name) - len(name.lstrip("."))
        folder = path.parents[max(dots - 1, 0)]
        stem = folder.joinpath(*name.lstrip(".").split(".")) if name.strip(".") else folder
        found = [stem.with_suffix(".py"), stem / "__init__.py"]
    return next((f for f in found if f in modules), None)


def imports_of(path: Path, modules: set[Path]) -> set[Path]:
    names: list[str] = []
    for match in (JS_IMPORT if path.suffix == ".js" else PY_IMPORT).finditer(path.read_text()):
        name = match.group(1)
        parts = [part.split(" as ")[0].strip() for part in (match.group(2) or "").split(",")] if path.suffix == ".py" else []
        names += [name] if name.strip(".") or not parts else []  # what "from . import x" names is x
        names += [f"{name.rstrip('.')}.{part}" if name.strip(".") else name + part for part in parts if part]
    return {m for m in (module_of(path, name, modules) for name in names) if m is not None and m != path}


def check_modules(faults: list[str]) -> dict[str, list[Path]]:
    """The modules of Python and JavaScript, by folder; they import each other in no circle."""
    listed = subprocess.run(["git", "ls-files", "-z", "*.py", "*.js"], stdout=subprocess.PIPE, text=True, check=True).stdout
    modules = {ROOT / name for name in listed.split("\0") if name.startswith(MODULES) and (ROOT / name).exists()}
    links = {str(m): {str(i) for i in imports_of(m, modules)} for m in modules}
    faults += [f"{Path(m).relative_to(ROOT)}: imports itself, in a circle" for m in sorted(circles(links))]
    folders: dict[str, list[Path]] = defaultdict(list)
    for module in sorted(modules):
        folders[str(module.parent.relative_to(ROOT))].append(module)
    return folders


def check_licences(faults: list[str]) -> None:
    listed = subprocess.run(["git", "ls-files", "-z", *SOURCES], stdout=subprocess.PIPE, text=True, check=True).stdout
    for name in filter(None, listed.split("\0")):
        if "/dist/" not in name and Path(name).exists() and LICENCE not in Path(name).read_text()[:100]:
            faults.append(f"{name}: does not begin with '{LICENCE}'")


def lines_of(paths: list[Path]) -> int:
    return sum(path.read_text().count("\n") for path in paths)


def print_rooms(library: Library, arrows: dict[str, set[str]]) -> None:
    print(f"\nlib{library.name}: {lines_of(library.files())} lines")
    by_room: dict[str, list[Path]] = defaultdict(list)
    for path, room in library.room_of.items():
        by_room[room].append(path)
    for room in sorted(by_room):
        sources = sum(p.suffix == ".cpp" for p in by_room[room])
        uses = ", ".join(sorted(other or "(own)" for other in arrows.get(room, ())))
        name = room or "(own)"
        print(f"  {name:<18}{sources:>3} sources {lines_of(by_room[room]):>6} lines" + (f"   -> {uses}" if uses else ""))


def print_programs(rooms: dict[str, list[Path]], arrows: dict[str, set[str]]) -> None:
    print(f"\napps: {lines_of([p for paths in rooms.values() for p in paths])} lines")
    for room in sorted(arrows, key=lambda r: (len(closure(arrows)[r]), r)):
        paths = rooms.get(room, [])
        sources = sum(p.suffix == ".cpp" for p in paths)
        size = f"{sources:>3} sources {lines_of(paths):>6} lines" if paths else " " * 24
        uses = ", ".join(sorted(arrows[room]))
        print(f"  {room or '(programs)':<18}{size}" + (f"   -> {uses}" if uses else ""))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-q", "--quiet", action="store_true", help="print faults only")
    options = parser.parse_args()
    os.chdir(ROOT)
    faults: list[str] = []
    libraries = read_libraries()
    arrows = check_libraries(libraries, faults)
    rooms = {name: check_rooms(library, faults) for name, library in libraries.items()}
    for library in libraries.values():
        check_sizes(library, faults)
        check_tests(library, faults)
    programs, program_arrows = check_programs(faults)
    folders = check_modules(faults)
    check_licences(faults)
    check_tbb(faults)
    check_tools(libraries, faults)
    if not options.quiet:
        for name in sorted(libraries, key=lambda n: (len(closure(arrows)[n]), n)):
            uses = ", ".join(sorted(arrows[name]))
            print(f"lib{name:<9}" + (f" -> {uses}" if uses else ""))
        for name in sorted(libraries, key=lambda n: (len(closure(arrows)[n]), n)):
            print_rooms(libraries[name], rooms[name])
        print_programs(programs, program_arrows)
        print("\nmodules of Python and JavaScript")
        for folder, paths in folders.items():
            print(f"  {folder:<28}{len(paths):>3} files {lines_of(paths):>6} lines")
    for fault in faults:
        print(f"check_structure.py: {fault}", file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
