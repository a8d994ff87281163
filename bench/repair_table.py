#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs meshrepair, and other tools, on the meshes of a folder or an archive, and writes a table of what they make of each.

OUT_DIR gets table.csv, a row for each model and tool, in the order in which they are done; and their sums, with rates, medians,
means and largest values, as table.md, table.html and table.svg. The same command again goes on where the last one ended.
"""

import argparse
import csv
import fcntl
import glob
import io
import os
import sys
import tempfile
import types

# As in scripts/repair_folder.py, where the reason stands.
sys.dont_write_bytecode = True
sys.pycache_prefix = os.devnull
sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "scripts"))

from comparison.basics import DONE, NAME, OUTPUT, ROOT, USAGE, Parser, Stop, exit_code_of, machine, say, write_whole
from comparison.model_rows import COLUMNS, INPUT, NOTHING, TEXTS, Measurer, Tool
from comparison.page import chart, page
from comparison.programs import executable
from comparison.sums import Sums
from comparison.tables import to_file
from folder_repair.archive import open_archive
from folder_repair.archive_inputs import ArchiveInputs, MemberJob, NotUnpacked
from folder_repair.basics import Stop as FolderStop, one_line, text
from folder_repair.inputs import Job, find_meshes
from folder_repair.option_types import seconds, shard, size_in_bytes

EPILOG = """Examples:
  repair_table.py Thingi10K table
  repair_table.py abc.tar.gz table --judge ./judge --timeout 300 --max-memory 8G
  repair_table.py meshes table --tool "admesh=admesh -b {out.stl} {in.stl}" --tool "meshfix=meshfix {in} {out}"
  repair_table.py ShapeNet table --shard 2/8

In the command of a tool {in} is the mesh, {in.stl} the same in this format, which meshconvert makes of others; {out} is an OFF file
that the tool writes, {out.obj} one in another format. meshrepair runs on one thread, unless --tool "meshrepair=..." says how it runs.
A tool that crashes, runs out of time or memory, or writes nothing has a row that says so. "solid" is the verdict of the judge, the
counts behind it are its counts; distances are measured by meshdist, for all tools. What the input is like is in rows of the tool "input".

Shards may be at work on one OUT_DIR at the same time: each has its own CSV file, and the sums are of all that are there.
A tool that is called otherwise, or a model that has changed, needs another name, or another OUT_DIR.

Exit codes: 0 fine, 2 wrong usage, 3 the archive cannot be read, 6 OUT_DIR cannot be written or another run is at work on it, 130
interrupted, 143 terminated.
"""


def command_line():
    parser = Parser(prog=NAME, description=__doc__, epilog=EPILOG, allow_abbrev=False, formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("folder", metavar="FOLDER", help="of meshes, or an archive of one, as repair_folder.py takes it")
    add("out_dir", metavar="OUT_DIR", help="for the table; is made")
    add("--tool", action="append", default=[], metavar="NAME=COMMAND", help="another program, with {in} and {out}; several may be given")
    add("--programs", default=os.path.join(ROOT, "build", "release", "bin"), metavar="FOLDER",
        help="of meshrepair, meshcheck, meshconvert and meshdist [build/release/bin]")
    add("--judge", metavar="PROGRAM", help="run as PROGRAM OUT; prints JSON as bench/comparison/judge.py reads it [meshcheck]")
    add("--timeout", type=seconds, default=600.0, metavar="SECONDS", help="of each run of a tool [600]")
    add("--max-memory", type=size_in_bytes, metavar="SIZE", help="of data of each process of a tool, like 8G [no limit]")
    add("--shard", type=shard, metavar="I/N", help="the I-th of N shares of the models")
    add("-q", "--quiet", action="store_true", help="do not tell what is done")
    return parser


def tools_of(options):
    for name in ("meshrepair", "meshcheck", "meshconvert", "meshdist"):
        if not executable(os.path.join(options.programs, name)):
            raise Stop(USAGE, f"{os.path.join(options.programs, name)}: is no program; build it, or give another folder with --programs")
    if options.judge and not executable(options.judge):
        raise Stop(USAGE, f"{options.judge}: is no program")
    if not options.timeout:
        raise Stop(USAGE, "--timeout 0 leaves no time")
    tools = [Tool(line) for line in options.tool]
    names = [tool.name for tool in tools]
    if len(set(names + [INPUT])) <= len(names):
        raise Stop(USAGE, f'each --tool needs a name of its own, and "{INPUT}" is none')
    if "meshrepair" not in names:
        tools.insert(0, Tool(f"meshrepair='{options.programs}/meshrepair' {{in}} {{out}} --quiet --threads 1"))
    return tools


def find_models(options, work, is_wanted):
    """Jobs of repair_folder.py, which know how to get a mesh out of an archive."""
    folder, out_dir = os.path.abspath(os.fsencode(options.folder)), os.path.abspath(os.fsencode(options.out_dir))
    places = types.SimpleNamespace(in_dir=folder, out_dir=out_dir, format=None)
    if os.path.isdir(folder):
        meshes, left_out = find_meshes(folder, out_dir, lambda: False)
        jobs = [Job(name, mesh, name, places) for name, mesh in meshes.items() if is_wanted(name)]
    else:
        inputs = ArchiveInputs(open_archive(folder), os.fsencode(work), options.timeout)
        meshes, left_out = inputs.read(lambda: False)
        jobs = inputs.in_order([MemberJob(name, mesh, name, places, inputs) for name, mesh in meshes.items() if is_wanted(name)])
    for name, why in left_out.items():
        say(f"{text(name)}: left out: {why}")
    return jobs


def rows_in(path):
    if not os.path.isfile(path):
        return
    with open(path, encoding="utf-8", newline="") as file:
        rows = csv.DictReader(file)
        if tuple(rows.fieldnames or COLUMNS) != COLUMNS:
            raise Stop(USAGE, f"{path}: has other columns than this version writes; use another OUT_DIR")
        for row in rows:
            yield {column: value if column in TEXTS else float(value) if value else None for column, value in row.items()}


def all_rows(out_dir):
    """Of all shards; a model and a tool once."""
    found = {}
    for path in [os.path.join(out_dir, "table.csv"), *sorted(glob.glob(os.path.join(glob.escape(out_dir), "table.*-of-*.csv")))]:
        found.update(((row["model"], row["tool"]), row) for row in rows_in(path))
    return found


class TableFile:
    """A CSV file that is the state of the run, too: what it holds is done. It holds whole lines."""

    def __init__(self, path):
        self.file = open(path, "ab+")
        try:
            fcntl.flock(self.file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise Stop(OUTPUT, f"{path}: another run is at work on it") from None
        self.file.seek(0)
        if self.file.truncate(self.file.read().rfind(b"\n") + 1) == 0:
            self.write(dict(zip(COLUMNS, COLUMNS)))

    def write(self, row):
        line = io.StringIO()
        csv.writer(line, lineterminator="\n").writerow("" if row.get(column) is None else one_line(str(row[column])) for column in COLUMNS)
        self.file.write(line.getvalue().encode("utf-8", "backslashreplace"))
        self.file.flush()


class Run:
    def __init__(self, options, work):
        self.options, self.work = options, work
        self.tools = tools_of(options)
        self.measurer = Measurer(options.programs, options.judge and os.path.abspath(options.judge), options.timeout, options.max_memory)
        os.makedirs(options.out_dir, exist_ok=True)
        share = f".{text(options.shard.folder)}" if options.shard else ""
        self.table = TableFile(os.path.join(options.out_dir, f"table{share}.csv"))
        self.done = all_rows(options.out_dir)

    def run(self):
        models = find_models(self.options, self.work, self.is_wanted)
        for number, job in enumerate(models):
            self.run_model(job, one_line(text(job.name)), f"{number + 1:,} of {len(models):,}")
        self.write_sums()
        return DONE

    def is_wanted(self, name):
        share = self.options.shard
        return (not share or share.holds(name)) and self.tools_left(one_line(text(name)))

    def tools_left(self, name):
        return [tool for tool in self.tools if (name, tool.name) not in self.done]

    def run_model(self, job, name, place):
        tools = self.tools_left(name)
        with tempfile.TemporaryDirectory(dir=self.work) as work:
            try:
                job.look()
                for _ in job.unpack(os.fsencode(os.path.join(work, "model"))):
                    pass
            except (OSError, NotUnpacked) as error:
                for tool in tools:
                    self.add(name, {"tool": tool.name, "status": NOTHING, "error": f"the input cannot be had: {error}"}, place)
                return
            source = os.fsdecode(job.source)
            if (name, INPUT) not in self.done:
                self.add(name, self.measurer.input_row(source), place)
            triangles = self.done[name, INPUT].get("triangles_in")
            for tool in tools:
                with tempfile.TemporaryDirectory(dir=work) as room:
                    self.add(name, self.measurer.tool_row(tool, source, triangles, room), place)

    def add(self, name, row, place):
        self.table.write({"model": name, **row})
        self.done[name, row["tool"]] = row
        if not self.options.quiet and row["tool"] != INPUT:
            say(f"{place}: {name}: {row['tool']}: {row['status']}, {row.get('seconds') or 0:.2f} s")

    def write_sums(self):
        """As the files have them."""
        rows = list(all_rows(self.options.out_dir).values())
        limits = f"{self.options.timeout:g} s" + (f", {self.options.max_memory / 2**30:g} GiB of data" if self.options.max_memory else "")
        head = (f"{len({row['model'] for row in rows}):,} models. {machine()}. Limits of each run: {limits}. The least memory is that of "
                "this script, and an upper bound of the tool's.")
        sums, place = Sums(rows, head), os.path.join(self.options.out_dir, "table")
        to_file(place + ".md", sums.print_tables)
        write_whole(place + ".html", page(sums))
        write_whole(place + ".svg", chart(sums.by_tool) + "\n")
        if not self.options.quiet:
            sums.print_tables()


def main():
    options = command_line().parse_args()
    if not os.path.exists(options.folder):
        raise Stop(USAGE, f"{options.folder} is not there")
    try:
        with tempfile.TemporaryDirectory(prefix="repair_table_") as work:
            return Run(options, work).run()
    except FolderStop as stop:
        raise Stop(stop.code, str(stop)) from None
    except OSError as error:
        raise Stop(OUTPUT, f"{error.filename or options.out_dir}: {error.strerror}") from None


if __name__ == "__main__":
    sys.exit(exit_code_of(main, "the same command goes on"))
