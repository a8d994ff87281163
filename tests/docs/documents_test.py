#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs every command in README.md and docs/*.md, and compares what is said there with what is so.

Usage: documents_test.py PROGRAMS [CLASS]

PROGRAMS is the folder of the built programs, CLASS one of the classes of tests below.

Example: tests/docs/documents_test.py build/release/bin Commands
"""

import json
import os
import pathlib
import re
import shlex
import shutil
import statistics
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True

import documents
import sample_files
import report_schema  # found where sample_files says
from documents import DOCUMENTS, ROOT, name_of

PROGRAMS = pathlib.Path()  # set by main()
MOST_LINES = 120  # of the README
WIDEST = 140
LANGUAGES = {"sh", "console", "c", "cpp", "cmake", "python", "py", "rust", "text"}  # python is ours, and run; py that of others
SECONDS_OF_A_COMMAND = 60

# What is not run here: it installs packages, builds, or takes minutes. What it starts with, and why.
NOT_RUN = {
    "scripts/demo.sh": "installs packages and builds",
    "scripts/setup.sh": "installs packages",
    "scripts/fuzz.sh": "builds with clang, and runs for minutes",
    "scripts/make_site.py": "needs mkdocs and doxygen; site_test.py runs it",
    "scripts/make_wasm.sh": "builds for browsers",
    "scripts/make_windows.sh": "builds for Windows",
    "scripts/package.sh": "builds packages, and a bare system to try them",
    "bench/compare.py": "takes minutes",
    "bench/make_hard_inputs.py": "needs python3-numpy",
    "bench/meant.py": "takes an hour",
    "bench/repair_table.py": "takes hours, on meshes that are not here",
    "build/release/bin/meshrepair": "is found through PATH elsewhere; the build may lie in another folder",
    "build/release/bin/work_and_span": "is not built with sanitizers",
    "cmake": "builds and installs",
    "ctest": "runs this test",
    "pip": "builds and installs",
    "apt": "installs packages",
    "podman": "need not be there",
    "vcpkg": "need not be there",
    "conan": "need not be there",
    "conda": "need not be there",
    "brew": "need not be there",
    "makepkg": "need not be there",
    "scripts/fill_recipes.py": "changes the recipes; tests/scripts/recipes_test.py runs it",
}


def run(text: str, folder: pathlib.Path, stand_ins: pathlib.Path) -> tuple[int, str]:
    """Exit code of a command, and all that it prints."""
    path = os.pathsep.join([str(stand_ins), str(PROGRAMS), os.environ["PATH"]])
    result = subprocess.run(["bash", "-c", text], cwd=folder, env={**os.environ, "PATH": path}, stdin=subprocess.DEVNULL,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=SECONDS_OF_A_COMMAND)
    return result.returncode, result.stdout.decode("utf-8", "replace")


def without_seconds(line: str) -> str:
    return re.sub(r"in \d+\.\d+ s", "in # s", line.rstrip())


def same_line(said: str, printed: str) -> bool:
    """A line that ends with dots may go on."""
    said, printed = without_seconds(said), without_seconds(printed)
    return said == printed or said.endswith("...") and printed.startswith(said.removesuffix("..."))


def difference(said: tuple[str, ...], printed: list[str]) -> str | None:
    for number in range(max(len(said), len(printed))):
        left = said[number] if number < len(said) else "(nothing)"
        right = printed[number] if number < len(printed) else "(nothing)"
        if not same_line(left, right):
            return f"the document says\n  {left}\nbut it prints\n  {right}"
    return None


class Commands(unittest.TestCase):
    """Each command has the exit code and prints what the document says."""

    def test_every_command_does_what_is_said(self) -> None:
        with tempfile.TemporaryDirectory(prefix="documents_") as name:
            inputs, stand_ins = pathlib.Path(name) / "inputs", pathlib.Path(name) / "stand_ins"
            inputs.mkdir()
            stand_ins.mkdir()
            sample_files.make_folder(inputs, PROGRAMS)
            sample_files.make_stand_ins(stand_ins)
            for document in DOCUMENTS:
                folder = pathlib.Path(name) / document.stem
                shutil.copytree(inputs, folder, symlinks=True)
                for command in documents.commands(document):
                    with self.subTest(document=name_of(document), line=command.line, command=command.text):
                        self.check(command, folder, stand_ins)

    def check(self, command: documents.Command, folder: pathlib.Path, stand_ins: pathlib.Path) -> None:
        if command.text.split()[0] in NOT_RUN:
            return
        code, printed = run(command.text, folder, stand_ins)
        self.assertEqual(code, command.exit_code, printed)
        if command.output is not None:
            found = difference(command.output, printed.splitlines())
            if found:
                self.fail(found)
        for name in re.findall(r"--report (\S+)", command.text):
            self.assertEqual(list(report_schema.complaints((folder / name).read_bytes())), [])

    def test_what_is_not_run_exists(self) -> None:
        presets = json.loads((ROOT / "CMakePresets.json").read_text(encoding="utf-8"))
        names = {preset["name"] for preset in presets["configurePresets"]}
        for document in DOCUMENTS:
            for command in documents.commands(document):
                words = shlex.split(command.text, comments=True)
                if words[0].startswith(("scripts/", "bench/")):
                    self.assertTrue(os.access(ROOT / words[0], os.X_OK), f"{name_of(document)}: {words[0]}")
                if "--preset" in words:
                    self.assertIn(words[words.index("--preset") + 1], names)

    def test_the_list_of_what_is_not_run_is_no_longer_than_needed(self) -> None:
        used = {command.text.split()[0] for document in DOCUMENTS for command in documents.commands(document)}
        self.assertEqual(set(NOT_RUN) - used, set())

    def test_the_caption_of_the_picture_counts_right(self) -> None:
        counts = re.search(r"before: (\d+) boundary edges, (\d+) edges with inconsistent orientation, (\d+) intersecting pairs",
                           DOCUMENTS[0].read_text(encoding="utf-8"))
        self.assertIsNotNone(counts)
        text = subprocess.run([PROGRAMS / "meshcheck", "--json", sample_files.MESHES / "broken_torus_box.stl"],
                              stdout=subprocess.PIPE, check=False).stdout
        defects = json.loads(text)["check"]["defects"]
        self.assertEqual([int(count) for count in counts.groups()],
                         [defects[key]["count"] for key in ("open_edges", "inconsistent_edges", "self_intersections")])


def rows_of(text: str, heading: str) -> list[list[str]]:
    """The cells of the first table below a heading, without its head."""
    lines = text.split(f"## {heading}", 1)[1].split("\n|", 1)[1].split("\n\n", 1)[0].splitlines()
    return [[cell.strip() for cell in line.strip().strip("|").split("|")] for line in lines[2:]]


class Figures(unittest.TestCase):
    """Figures that are too dear to measure again here are those of bench/RESULTS.md, which a script writes."""

    def test_medians_are_those_of_the_results(self) -> None:
        rows = rows_of((ROOT / "bench/RESULTS.md").read_text(encoding="utf-8"), "Exact and floating predicates")
        by_gmp, by_exact, flooding = (statistics.median(values) for values in zip(
            *((float(row[5]), float(row[7]), 100 * float(row[11]) / float(row[4])) for row in rows)))
        said = rows_of((ROOT / "docs/algorithm.md").read_text(encoding="utf-8"), "Comparison with the paper")
        self.assertEqual([row[1] for row in said], [f"{by_gmp:.2f} times", f"{by_exact:.2f} times", f"{flooding:.1f} %"])


class Layout(unittest.TestCase):
    """Documents are short and narrow, and their blocks say what they are."""

    def test_the_readme_is_short(self) -> None:
        self.assertLessEqual(len(DOCUMENTS[0].read_text(encoding="utf-8").splitlines()), MOST_LINES)

    def test_lines_are_narrow(self) -> None:
        for document in [*DOCUMENTS, ROOT / "CONTRIBUTING.md"]:
            for number, line in enumerate(document.read_text(encoding="utf-8").splitlines(), 1):
                self.assertLessEqual(len(line), WIDEST, f"{name_of(document)}:{number}")

    def test_blocks_have_a_language(self) -> None:
        for document in DOCUMENTS:
            for block in documents.blocks(document):
                self.assertIn(block.language, LANGUAGES, f"{name_of(document)}:{block.line}")

    def test_no_block_is_made_by_indentation(self) -> None:
        for document in DOCUMENTS:
            before = ""
            for number, line in documents.text_lines(document):
                self.assertFalse(line.startswith("    ") and not before.strip(), f"{name_of(document)}:{number}")
                before = line


class Links(unittest.TestCase):
    """Files and headings that are linked to are there."""

    def test_links_lead_somewhere(self) -> None:
        for document in [*DOCUMENTS, ROOT / "CONTRIBUTING.md"]:
            for line, target in documents.links(document):
                if re.match(r"[a-z]+:", target):
                    continue
                with self.subTest(document=name_of(document), line=line, target=target):
                    name, _, anchor = target.partition("#")
                    path = (document.parent / name).resolve() if name else document
                    self.assertTrue(path.exists(), "there is no such file")
                    if anchor:
                        self.assertIn(anchor, documents.anchors(path))

    def test_files_that_are_named_are_there(self) -> None:
        listed = subprocess.run(["git", "ls-files"], cwd=ROOT, stdout=subprocess.PIPE, text=True, check=False)
        if listed.returncode != 0:
            self.skipTest("no git repository")
        paths = ["/" + path for path in listed.stdout.splitlines()]
        for document in DOCUMENTS:
            for line, text in documents.text_lines(document):
                for name in re.findall(r"`<?([\w./]+\.(?:h|cpp|py|sh))>?`", text):
                    self.assertTrue(any(path.endswith("/" + name) for path in paths), f"{name_of(document)}:{line}: {name}")

    def test_every_document_is_linked_to_from_the_readme(self) -> None:
        linked = {(ROOT / target.partition("#")[0]).resolve() for _, target in documents.links(DOCUMENTS[0])}
        self.assertEqual([name_of(document) for document in DOCUMENTS[1:] if document not in linked], [])


def code_of(path: pathlib.Path) -> str:
    return "\n".join(line.strip() for line in path.read_text(encoding="utf-8").splitlines())


class Snippets(unittest.TestCase):
    """Code is quoted from files that are compiled."""

    def test_code_is_quoted(self) -> None:
        sources = {"cpp": [*(ROOT / "samples").glob("*.cpp"), ROOT / "tests/package/main.cpp"],
                   "c": [*(ROOT / "samples/c").glob("*.c")],
                   "rust": [*(ROOT / "samples/rust/src").glob("*.rs")],
                   "cmake": [ROOT / "tests/package/CMakeLists.txt"]}
        for document in DOCUMENTS:
            for block in documents.blocks(document):
                texts = [code_of(path) for path in sources.get(block.language, [])]
                for line in block.lines if texts else ():
                    self.assertTrue(any(line.strip() in text for text in texts), f"{name_of(document)}:{block.line}: {line}")
                if block.language in ("c", "cpp", "rust") and not block.lines[0].startswith("#include"):
                    whole = "\n".join(line.strip() for line in block.lines)
                    self.assertTrue(any(whole in text for text in texts), f"{name_of(document)}:{block.line}")

    def test_python_of_others_compiles(self) -> None:
        for document in DOCUMENTS:
            for block in documents.blocks(document):
                if block.language == "py":
                    compile("\n".join(block.lines), f"{name_of(document)}:{block.line}", "exec")

    def test_lines_beside_those_of_others_are_counted_right(self) -> None:
        document = ROOT / "docs/from.md"
        theirs, ours = ([len([line for line in block.lines if starts(line)]) for block in documents.blocks(document)
                         if block.language == language]
                        for language, starts in (("py", str.strip), ("python", lambda line: line.startswith((">>>", "...")))))
        rows = re.findall(r"^\| \[[^|]*\| (\d+) \| (\d+) \|", document.read_text(encoding="utf-8"), re.MULTILINE)
        self.assertEqual([tuple(map(int, row)) for row in rows], list(zip(theirs, ours, strict=True)))

    def test_all_samples_are_compiled(self) -> None:
        build = (ROOT / "samples/CMakeLists.txt").read_text(encoding="utf-8")
        for sample in (ROOT / "samples").glob("*.cpp"):
            self.assertIn(f"meshrepair_sample({sample.stem} ", build)


def objects_of(node: object):
    """All objects in a schema that say which keys they have."""
    if isinstance(node, dict):
        if isinstance(node.get("properties"), dict) and node.get("type") == "object":
            yield node
        for inner in node.values():
            yield from objects_of(inner)
    elif isinstance(node, list):
        for inner in node:
            yield from objects_of(inner)


class Schema(unittest.TestCase):
    """The schema of reports is strict, and describes every key."""

    def setUp(self) -> None:
        self.schema = json.loads(report_schema.SCHEMA.read_text(encoding="utf-8"))
        text = subprocess.run([PROGRAMS / "meshrepair", "-q", sample_files.MESHES / "broken_torus_box.stl", "/dev/null",
                               "--format", "obj", "--report", "-"], stdout=subprocess.PIPE, check=True).stdout
        self.report = json.loads(text)

    def complaints(self) -> list[str]:
        return list(report_schema.complaints(json.dumps(self.report).encode()))

    def test_it_is_a_schema(self) -> None:
        report_schema.jsonschema.Draft7Validator.check_schema(self.schema)

    def test_objects_have_no_other_keys_and_each_key_is_described(self) -> None:
        for node in objects_of(self.schema):
            self.assertIs(node["additionalProperties"], False, node.get("description"))
            for key, value in node["properties"].items():
                self.assertTrue("description" in value, key)

    def test_a_report_fits(self) -> None:
        self.assertEqual(self.complaints(), [])

    def test_an_unknown_key_does_not_fit(self) -> None:
        self.report["holes"]["unheard_of"] = 1
        self.assertIn("unheard_of", " ".join(self.complaints()))

    def test_a_missing_key_does_not_fit(self) -> None:
        del self.report["clean"]["triangles_in"]
        self.assertIn("triangles_in", " ".join(self.complaints()))

    def test_success_without_a_certificate_that_holds_does_not_fit(self) -> None:
        self.report["certificate"]["closed"] = "FAIL"
        self.assertIn("certificate.closed", " ".join(self.complaints()))

    def test_a_section_of_another_program_does_not_fit(self) -> None:
        self.report["program"] = "bspbuild"
        self.report["base"] = {"floor": 0, "parts": 1, "dropped_triangles": 0, "skirt_triangles": 4}
        self.assertIn("base", " ".join(self.complaints()))


class Tables(unittest.TestCase):
    """What scripts make is as they make it."""

    def test_tables_are_as_the_programs_say(self) -> None:
        subprocess.run([sys.executable, ROOT / "scripts/make_docs.py", "--check", "--programs", PROGRAMS], check=True)

    def test_pictures_are_as_the_script_makes_them(self) -> None:
        try:
            import numpy  # noqa: F401
        except ImportError:
            self.skipTest("python3-numpy is not installed")
        subprocess.run([sys.executable, ROOT / "scripts/make_pictures.py", "--check", "--programs", PROGRAMS], check=True)

    def test_pictures_of_pages_are_as_the_scripts_make_them(self) -> None:
        for script in ("make_textured_pictures.py", "make_task_pictures.py"):
            subprocess.run([sys.executable, ROOT / "scripts" / script, "--check", "--programs", PROGRAMS], check=True)


def main() -> None:
    global PROGRAMS
    if len(sys.argv) < 2 or sys.argv[1] in ("-h", "--help"):
        print(__doc__.strip())
        sys.exit(0 if len(sys.argv) == 2 else 2)
    PROGRAMS = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main(verbosity=2)


if __name__ == "__main__":
    main()
