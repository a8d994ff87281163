#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Repairs all meshes in a folder and its sub-folders, or in an archive, with meshrepair, several at a time.

What holds at every moment, also when this script, its workers or the machine are killed:

- A mesh in OUT_DIR is complete. A worker, which is a process of its own for each file, writes into a folder of its
  own below OUT_DIR/.repair_folder/work, and what it wrote is renamed to its place only after it has ended well and its report says so.
- OUT_DIR/.repair_folder/journal.jsonl holds a line for each file that is finished, a moment later. The line is
  written, and on the disk, after the output is. What is in no line is done again, which gives the same bytes.
- One run at a time works on an OUT_DIR, or several of different shards: each holds a lock, and so do its
  workers. The lock ends with the last of them, and they are killed when this script dies; then what they left
  is removed.
- After a run that was not interrupted, the inputs that have an output are those with exit code 0 or 1.

This file is the command line; the parts are in folder_repair, the run itself in folder_run.py there. Names
of files are bytes throughout, for not every name is text.
"""

import argparse
import gc
import os
import re
import sys

# Compiled copies of the parts are neither kept nor used. Where the disk is full Python cuts such a copy without
# noticing, and from then on each start fails on it, when there is room again, too. There are none below
# /dev/null, so those that an earlier version has cut are not met either. A start takes 20 milliseconds longer.
sys.dont_write_bytecode = True
sys.pycache_prefix = os.devnull

from folder_repair.archive import open_archive
from folder_repair.basics import EXTENSION_OF_FORMAT, NAME, OUTPUT, USAGE, Stop, say, text
from folder_repair.folder_run import FolderRun
from folder_repair.option_types import seconds, shard, size_in_bytes
from folder_repair.out_folder import OutFolder
from folder_repair.program import Program

# Nearly all that is made stays, for there is something of each file: it is looked through seldom. Saves a tenth of the
# time of a run with nothing to do.
COLLECT_AFTER = (50_000, 20, 100)

# Options of meshrepair that are set here, for each file.
OWN_OPTIONS = ("--report", "--threads", "--time-limit", "--max-memory", "--format", "-q", "--quiet",
               "--root", "--staging", "--html", "--picture", "-v", "--verbose", "-h", "--help", "--version")
MEMORY_SHARE = 0.8  # of what is free

EPILOG = """Options after -- go to meshrepair as they are.

Examples:
  repair_folder.py scans repaired
  repair_folder.py scans.tar.gz repaired
  repair_folder.py --format obj --jobs 4 --timeout 60 --max-memory 2G scans repaired
  repair_folder.py scans repaired -- --inside solidity --strict
  repair_folder.py --shard 3/8 scans repaired
  repair_folder.py --html scans repaired -- --picture-view front --html-triangles 100000

A mesh file is one by its extension: .stl, .obj, .off, .ply, .glb, .gltf or .3mf, in upper or lower case; with .gz or .zst
behind it, it is packed, and so is its output. A .zip counts if just one file in it has such an extension; its
output is a mesh with that extension. With --format no output is packed. Links to files are followed, links to
folders are not.

IN_DIR may be an archive of such a folder: ZIP or tar, which may be packed with gzip, bzip2, xz, or, if the program
zstd is there, Zstandard. Each mesh in it is unpacked when its turn comes, with what it names, and goes again.

OUT_DIR gets the repaired meshes under their names and in their sub-folders, summary.csv, summary.json and
the folder .repair_folder with the journal. The same command again goes on where the last run stopped:
what was repaired, cannot be read or encloses nothing is not done again, unless the file, the options or
the program have changed; what hit a limit, was killed or could not be written is. A file whose worker is
killed by SIGKILL is tried once more in the same run, after all others. OUT_DIR belongs to this script: the
old output of an input that now fails is removed. Outputs of inputs that are gone stay, and are warned of.
What lies in a folder named summary.csv, summary.json or index.html at the top of IN_DIR is left out: exit code 1.

Exit codes: 0 all passed, 1 some file failed or was not certified, 2 wrong usage, 3 the archive cannot be read, 6 OUT_DIR cannot be
written or another run is at work there, 130 interrupted, 143 terminated.
"""


class Parser(argparse.ArgumentParser):
    def error(self, message):
        raise Stop(USAGE, f"{message} (try '{NAME} --help')")


def number_of_jobs(string):
    if not re.fullmatch(r"0*[1-9]\d{0,3}", string):
        raise argparse.ArgumentTypeError(f"{string} is not a number from 1 to 9999")
    return int(string)


def command_line():
    parser = Parser(prog=NAME, allow_abbrev=False, add_help=False, epilog=EPILOG,
                    usage="%(prog)s [OPTIONS] IN_DIR OUT_DIR [-- OPTIONS OF MESHREPAIR]",
                    description=__doc__.split("\n", maxsplit=1)[0],
                    formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument
    add("in_dir", metavar="IN_DIR",
        help="folder of meshes: STL, OBJ, OFF, PLY, glTF or 3MF; or an archive of one: .zip, or .tar, maybe packed")
    add("out_dir", metavar="OUT_DIR", help="folder to write to; is made, and may lie in IN_DIR")
    add("--format", choices=EXTENSION_OF_FORMAT, metavar="NAME",
        help="format of all outputs: obj, stl, stl-ascii, off, ply, ply-ascii, glb, gltf, 3mf; a.stl becomes a.obj, and "
             "where there is an a.off, too, they become a.stl.obj and a.off.obj "
             "(default: by the input's name)")
    add("--html", action="store_true",
        help="also write index.html to OUT_DIR, a gallery of all meshes for browsers, with a picture and a page for each in "
             "OUT_DIR/index.files")
    add("--jobs", type=number_of_jobs, metavar="N", default=len(os.sched_getaffinity(0)),
        help="number of workers, which share the cores (default: the cores, %(default)s here)")
    add("--timeout", type=seconds, metavar="SECONDS", default=600.0,
        help="give up a file after this time; 0 is never (default: 600)")
    add("--grace", type=seconds, metavar="SECONDS", default=5.0,
        help="what a worker has then to end by itself, and again once it is terminated, until it is killed "
             "(default: 5)")
    add("--max-memory", type=size_in_bytes, metavar="SIZE",
        help="give up a file that takes more memory, like 200M or 2G; 0 is no limit "
             "(default: 80 %% of what is free, divided by the workers)")
    add("--list", metavar="FILE", type=os.fsencode,
        help="repair only the files that this one names, one in each line, from IN_DIR on; - is standard input")
    add("--shard", type=shard, metavar="I/N",
        help="repair only the I-th of N shares of the files. Runs of different shards may be at work on one OUT_DIR at the "
             "same time, on several machines, too; then --merge")
    add("--merge", action="store_true",
        help="repair nothing: write the summary, and with --html the gallery, of what runs of shards have done, and end with "
             "the exit code of one run")
    add("--restart", action="store_true", help="do all files anew, and replace what is in OUT_DIR")
    add("--meshrepair", metavar="PATH",
        help="the program (default: build/release/bin/meshrepair of this project, else that in PATH)")
    add("-q", "--quiet", action="store_true", help="print errors only, a line for each file that fails")
    add("-h", "--help", action="help", help="print this text and exit")
    return parser


def parse_arguments(arguments):
    """`passed` is what stands after the first "--"."""
    end = arguments.index("--") if "--" in arguments else len(arguments)
    options = command_line().parse_args(arguments[:end])
    options.passed = arguments[end + 1:]
    if options.merge and (options.shard or options.restart):
        raise Stop(USAGE, f"--merge goes with neither --shard nor --restart (try '{NAME} --help')")
    for folder in (options.in_dir, options.out_dir):
        if not folder:
            raise Stop(USAGE, f"the name of a folder is empty (try '{NAME} --help')")
    for argument in options.passed:
        if argument.split("=")[0] in OWN_OPTIONS:
            raise Stop(USAGE, f"{argument} after --: {NAME} sets this itself (try '{NAME} --help')")
    if options.max_memory is None:
        options.max_memory = int(MEMORY_SHARE * free_memory() / options.jobs)
    return options


def numbers_in(path):
    """Lines of a name and a number: /proc/meminfo, memory.stat and the like."""
    with open(path, encoding="ascii") as file:
        return {name.rstrip(":"): int(number) for name, number, *_ in map(str.split, file)}


def free_memory():
    """In bytes, as the machine and the control group allow; 0 if nothing tells."""
    found, group = [], "/sys/fs/cgroup/memory."
    try:
        found.append(numbers_in("/proc/meminfo")["MemAvailable"] * 1024)
        with open(group + "max", encoding="ascii") as most, open(group + "current", encoding="ascii") as now:
            pages = numbers_in(group + "stat")
            kept = int(now.read()) - pages["active_file"] - pages["inactive_file"]  # others can be dropped
            found.append(int(most.read()) - kept)
    except (OSError, ValueError, KeyError):  # not there, or "max"
        pass
    return max(min(found, default=0), 0)


def check_folders(options):
    """Makes them absolute. Refuses what would let outputs replace inputs."""
    options.in_dir = os.path.abspath(os.fsencode(options.in_dir))
    options.out_dir = os.path.abspath(os.fsencode(options.out_dir))
    if not os.path.exists(options.in_dir):
        raise Stop(USAGE, f"{text(options.in_dir)} is not there")
    options.archive = None if os.path.isdir(options.in_dir) else open_archive(options.in_dir)
    if os.path.lexists(options.out_dir) and not os.path.isdir(options.out_dir):
        raise Stop(USAGE, f"{text(options.out_dir)} is no folder")
    source, target = os.path.realpath(options.in_dir), os.path.realpath(options.out_dir)
    if os.path.commonpath([source, target]) == target:
        raise Stop(USAGE, f"OUT_DIR {text(target)} is IN_DIR or holds it: outputs could replace inputs")


def run():
    options = parse_arguments(sys.argv[1:])
    check_folders(options)
    program = Program(options.meshrepair, options.passed)
    try:
        return FolderRun(options, program, OutFolder(options.out_dir, options.shard)).run()
    except OSError as error:
        name = error.filename2 or error.filename  # of a file that is moved, where to
        name = text(os.fsencode(name)) if name else "OUT_DIR"
        raise Stop(OUTPUT, f"{name}: cannot be written: {error.strerror}") from None


def open_standard_streams():
    """Where one is closed, the next file that is opened would take its number, and get what is said."""
    while (descriptor := os.open(os.devnull, os.O_RDWR)) <= 2:
        os.set_inheritable(descriptor, True)
    os.close(descriptor)
    sys.stdout = sys.stdout or open(1, "w", encoding="utf-8")
    sys.stderr = sys.stderr or open(2, "w", encoding="utf-8")


def main():
    gc.set_threshold(*COLLECT_AFTER)
    open_standard_streams()
    try:
        return run()
    except Stop as stop:
        say(str(stop))
        return stop.code
    except KeyboardInterrupt:  # before anything was begun
        say("interrupted")
        return 130


if __name__ == "__main__":
    sys.exit(main())
