# SPDX-License-Identifier: MIT
"""The tables, as Markdown."""

import contextlib
import io

from .basics import seconds, write_whole
from .growth import LARGEST_EXPONENT, growth_rows
from .programs import Ours


def to_file(path, work):
    """What `work` prints, in a file that is there only when all is done."""
    text = io.StringIO()
    with contextlib.redirect_stdout(text):
        work()
    write_whole(path, text.getvalue())


def print_head(columns):
    print("| " + " | ".join(columns) + " |\n|" + "---|" * len(columns), flush=True)


def print_row(cells):
    print("| " + " | ".join(cells) + " |", flush=True)


def print_table(title, columns, rows):
    if rows:
        print(f"\n{title}\n")
        print_head(columns)
        for row in rows:
            print_row(row)


def ratio(number, first):
    return f"{number / first:.2f}" if first > 0 else "-"


def peak(measured):
    return ("at most " if measured.peak_hidden() else "") + f"{measured.least('peak'):.0f}"


def code_of(measured):
    return "timeout" if measured.code() is None else str(measured.code())


def print_results_head(first):
    print_head(["input", "triangles", "program", "exit", "accepted", "result", "CPU, s", f": {first}", "wall, s", f": {first}",
                "peak, MB", f": {first}", "rounds differ"])


def result_row(measured, first):
    cells = [measured.item.name(), f"{measured.item.triangles:,}", measured.program.name, code_of(measured), measured.verdict()]
    if measured.failed():
        return cells + ["-"] * 8
    cells.append("-" if measured.triangles is None else f"{measured.triangles:,}")
    for what in ("cpu", "wall", "peak"):
        cells.append(peak(measured) if what == "peak" else seconds(measured.least(what)))
        incomparable = first.failed() or what == "peak" and (measured.peak_hidden() or first.peak_hidden())
        cells.append("-" if incomparable else ratio(measured.least(what), first.least(what)))
    return cells + [f"{100 * measured.differ():.0f} %" if len(measured.runs) > 1 else "-"]


def print_growth(measured):
    print_table(f"Exponents of growth between sizes, by triangles of the input or of the result; above {LARGEST_EXPONENT} in bold.",
                ["kind", "program", "by", "triangles", "CPU", "peak memory"], growth_rows(measured))


def print_stages(rows):
    print_table("The same by stage, of the first program, by triangles of the input.", ["kind", "stage", "CPU, s", "exponents"], rows)


def print_threads(measured):
    """Wall times beside those of the same program with the first number of threads."""
    rows, first = [], {}
    for each in measured:
        if isinstance(each.program, Ours) and not each.failed():
            base = first.setdefault((each.item, each.program.plain_name), each)
            rows.append([each.item.name(), each.program.plain_name, str(each.program.threads), seconds(each.least("wall")),
                         ratio(base.least("wall"), each.least("wall")), seconds(each.least("cpu"))])
    print_table("Threads: speed-up against the first number of threads.",
                ["input", "program", "threads", "wall, s", "speed-up", "CPU, s"], rows)
