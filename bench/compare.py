#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Runs our programs beside others on the inputs that make_models makes, and prints what each costs.

Rounds go through all programs in turn, and the least of all rounds counts, so that what else the machine does falls on all
alike. Each result is judged. CPU time is that of all threads, in the program and in the system.

This file is the command line; the parts are in comparison, one for each subject.
"""

import argparse
import os
import re
import sys
import tempfile

# As in scripts/repair_folder.py, where the reason stands: a disk that is full must not leave cut copies of the parts.
sys.dont_write_bytecode = True
sys.pycache_prefix = os.devnull

from comparison import history, tables
from comparison.basics import (DONE, FAILED, NAME, ROOT, USAGE, Parser, Stop, check_writable, commit, exit_code_of, machine,
                               say)
from comparison.growth import stage_rows
from comparison.inputs import KINDS, make_input, size_of
from comparison.judge import YES, Judge
from comparison.programs import Cgal, Ours, Peer, called, check_names, check_ours, executable
from comparison.rounds import Rounds

EPILOG = """Kinds of inputs (make_models --help says more): clean, holes, bumpy, noisy, cubes, soup; union is the union of two meshes,
by bspbool; cloud is a cloud of points. A size is the number of triangles, of points for cloud.

Examples:
  compare.py
  compare.py --ours before=/tmp/old/bin --ours after=build/release/bin --kinds cubes,union --rounds 7
  compare.py --sizes 10k,100k,1M --exponents
  compare.py --threads 1,2 --sizes 300k
  compare.py --peer meshfix=./meshfix.sh --judge ./judge --output table.md
  compare.py --record --history-check

A peer is a script that is called with IN and OUT, or A, B and OUT for union; all are OFF, but that IN is XYZ for cloud. It ends
with 0 when it made OUT, and with 77 when it does not do $COMPARE_KIND, which is the kind of the input:

  #!/bin/sh
  case $COMPARE_KIND in union | cloud) exit 77 ;; esac
  exec some_program "$1" --output "$2"

CGAL is compared for union and cloud where cgal_booleans and cgal_points are in the folder of --cgal (bench/others builds them).

Temporary files go to $TMPDIR or /tmp, and are removed whatever happens.

Exit codes: 0 fine, 1 a result of ours was not accepted, or --history-check found growth, 2 wrong usage, 6 a file cannot be
written, 130 interrupted, 143 terminated.
"""


def list_of(parse):
    """A type for argparse: values with commas between them, each once."""
    def parse_list(text):
        try:
            return list(dict.fromkeys(parse(part.strip()) for part in text.split(",")))
        except ValueError as error:
            raise argparse.ArgumentTypeError(str(error)) from None
    return parse_list


def kind_of(text):
    if text not in KINDS:
        raise ValueError(f"{text} is none of {', '.join(KINDS)}")
    return text


def number_of(text):
    if not re.fullmatch(r"0*[1-9]\d{0,2}", text):
        raise ValueError(f"{text} is not a number from 1 to 999")
    return int(text)


def number(text):
    return list_of(number_of)(text)[0]


def seconds(text):
    if not re.fullmatch(r"\d+(\.\d+)?", text) or float(text) <= 0:
        raise argparse.ArgumentTypeError(f"{text} is not a number of seconds above 0")
    return float(text)


def command_line():
    parser = Parser(prog=NAME, description=__doc__.rsplit("\n\n", 1)[0], epilog=EPILOG, allow_abbrev=False,
                    formatter_class=argparse.RawDescriptionHelpFormatter)
    add = parser.add_argument_group("programs").add_argument
    add("--ours", action="append", metavar="[NAME=]FOLDER", help="folder of meshrepair and bspbool; several are compared, for two "
        "commits say; the first is what ratios are to [ours=build/release/bin]")
    add("--peer", action="append", default=[], metavar="NAME=SCRIPT", help="another program, by a wrapper, see below")
    add("--cgal", metavar="FOLDER", help="of cgal_booleans and cgal_points [the first of --ours]")
    add("--judge", metavar="PROGRAM", help="run as PROGRAM OUT --against IN; prints JSON with is_clean and outward_oriented "
        "[meshcheck of the first of --ours]")
    add("--make-models", metavar="PROGRAM", help="makes the inputs [that of the first of --ours]")
    add = parser.add_argument_group("what is run").add_argument
    add("--kinds", type=list_of(kind_of), default=list(KINDS), metavar="LIST", help="of inputs [all]")
    add("--sizes", type=list_of(size_of), default=[10_000, 100_000], metavar="LIST", help="as 30k,1M [10k,100k]")
    add("--rounds", type=number, default=3, metavar="N", help="of which the best counts [%(default)s]")
    add("--threads", type=list_of(number_of), default=[1], metavar="LIST", help="as 1,2: each for ours; tells the speed-up, too [1]")
    add("--timeout", type=seconds, default=600.0, metavar="SECONDS", help="of each run, and of making an input [600]")
    add = parser.add_argument_group("what is told").add_argument
    add("--exponents", action="store_true", help="how CPU time and memory grow from size to size, and CPU time by stage")
    add("--output", metavar="FILE", help="write the tables there at the end, not to standard output")
    add("-q", "--quiet", action="store_true", help="do not tell on standard error which round runs")
    add = parser.add_argument_group("history").add_argument
    add("--record", action="store_true", help="add what the first of --ours costs to the history, with calibration between the rounds")
    add("--history", default=os.path.join(ROOT, "bench", "history.csv"), metavar="FILE", help="[bench/history.csv]")
    add("--commit", metavar="NAME", help="that the programs are built from, for --record [HEAD, and + with changes]")
    add("--history-check", action="store_true", help="say what costs over 10 %% more than in rows before, of the same kind of machine; "
        "without --record nothing is run")
    add("--since", metavar="COMMIT", help="where --history-check begins, after a growth that was meant")
    return parser


def calibration_of(options, ours):
    """The program, where it is needed."""
    if not options.record:
        return None
    path = os.path.join(ours[0].folder, "calibration")
    if not executable(path):
        raise Stop(USAGE, f"{path}: is no program; --record needs it")
    history.check_appendable(options.history)
    return path


class Comparison:
    """All programs, in the order of the table, and who makes inputs and judges results."""

    def __init__(self, options):
        self.options = options
        several = len(options.threads) > 1
        places = [called(text, "ours") for text in options.ours or [os.path.join(ROOT, "build", "release", "bin")]]
        ours = [Ours(name, folder, threads, several) for name, folder in places for threads in options.threads]
        check_ours(ours, options.kinds)
        self.first = ours[0]
        peers = [Peer(*called(text, "")) for text in options.peer]
        self.programs = [*ours, *peers, Cgal(os.path.abspath(options.cgal or self.first.folder))]
        check_names(self.programs)
        self.maker = options.make_models or os.path.join(self.first.folder, "make_models")
        meshcheck = os.path.join(self.first.folder, "meshcheck")
        for path in (self.maker, options.judge or meshcheck):
            if not executable(path):
                raise Stop(USAGE, f"{path}: is no program")
        self.judge = Judge(options.judge and os.path.abspath(options.judge), meshcheck, options.timeout)
        self.calibration = calibration_of(options, ours)
        self.commit = options.commit or commit()
        self.measured, self.rows = [], []

    def run(self):
        """Prints the tables. What was measured until an interruption was printed, but is not recorded."""
        print(f"{machine()}, load {os.getloadavg()[0]:.1f} at the start. Sources: {self.commit}. Least of {self.options.rounds} rounds. "
              f"Judged by {os.path.basename(self.judge.name())}.\n")
        tables.print_results_head(self.first.name)
        stages = []
        for kind in self.options.kinds:
            by_size = [self.run_input(kind, size) for size in self.options.sizes]
            if self.options.exponents:
                stages += stage_rows(kind, *zip(*sorted(by_size, key=lambda pair: pair[0])))
        if self.options.exponents:
            tables.print_growth(self.measured)
            tables.print_stages(stages)
        if len(self.options.threads) > 1:
            tables.print_threads(self.measured)

    def run_input(self, kind, size):
        """The size as the input has it, and the stages of the first program."""
        with tempfile.TemporaryDirectory(prefix="compare_") as work:
            item = make_input(self.maker, kind, size, work, self.options.timeout)
            rounds = Rounds(self.programs, self.judge, work, self.options)
            measured, calibration = rounds.measure(item, self.calibration)
            for each in measured:
                tables.print_row(tables.result_row(each, measured[0]))
            self.measured += measured
            if calibration:
                own = [each for each in measured if each.program is self.first]
                self.rows += [history.row_of(each, calibration, self.commit) for each in history.recordable(own)]
            with_stages = self.options.exponents and not measured[0].failed()
            return item.triangles, rounds.stages(self.first, item) if with_stages else {}

    def all_accepted(self):
        return all(each.verdict() == YES and each.code() == 0 for each in self.measured if isinstance(each.program, Ours))


def compare(options):
    comparison = Comparison(options)
    if options.output:
        check_writable(options.output)
        tables.to_file(options.output, comparison.run)
    else:
        comparison.run()
    if options.record:
        history.append(options.history, comparison.rows)
        say(f"{options.history}: {len(comparison.rows)} rows added")
    return comparison.all_accepted()


def check_history(options):
    rows = history.read_rows(options.history)
    if rows is None:
        raise Stop(USAGE, f"{options.history}: there is no such file")
    lines, grew = history.check(rows, options.since)
    print("\n".join(lines))
    return not grew


def main():
    options = command_line().parse_args()
    fine = True
    if options.record or not options.history_check:
        fine = compare(options)
    if options.history_check:
        fine = check_history(options) and fine
    return DONE if fine else FAILED


if __name__ == "__main__":
    sys.exit(exit_code_of(main, "nothing is left"))
