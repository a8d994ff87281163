# SPDX-License-Identifier: MIT
"""bench/history.csv: what each commit cost, and whether the latest costs more than those before.

A row is one input and size, at one commit, on one kind of machine. Its CPU time is told beside that of the program
`calibration`, a fixed work that ran between the same rounds: their quotient is the cost that is compared, as it says less
about how busy the machine was than seconds do. Rows are added at the end, and never changed. Where there are two of a commit,
the later counts.
"""

import csv
import dataclasses
import io
import math
import time

from .basics import USAGE, Stop, check_writable, machine, write_whole
from .inputs import short_size
from .judge import YES
from .programs import Ours

LARGEST_GROWTH = 0.10


@dataclasses.dataclass(frozen=True)
class Row:
    commit: str
    date: str
    machine: str
    kind: str
    size: int
    digest: str  # of the input
    cpu_s: float  # the least of the rounds
    peak_mb: float  # 0: not known, and small
    calibration_s: float  # the least of the rounds
    rounds: int
    differ: float  # by how much the slowest round was above the fastest

    def key(self):
        return self.machine, self.kind, self.size, self.digest

    def cost(self):
        return self.cpu_s / self.calibration_s


COLUMNS = [field.name for field in dataclasses.fields(Row)]


def parsed(cells):
    """ValueError where it is no row."""
    if len(cells) != len(COLUMNS):
        raise ValueError(f"{len(cells)} columns, not {len(COLUMNS)}")
    row = Row(*(field.type(cell) for field, cell in zip(dataclasses.fields(Row), cells)))
    if not (0 < row.cpu_s < math.inf and 0 < row.calibration_s < math.inf and 0 <= row.peak_mb < math.inf):
        raise ValueError("a time or a size is below 0, or no number")
    return row


def read_rows(path):
    """None if there is no such file."""
    try:
        with open(path, encoding="utf-8", newline="") as file:
            lines = list(csv.reader(file))
    except FileNotFoundError:
        return None
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise Stop(USAGE, f"{path}: cannot be read: {error}") from None
    if not lines or lines[0] != COLUMNS:
        raise Stop(USAGE, f"{path}: the first line is not {','.join(COLUMNS)}")
    rows = []
    for number, cells in enumerate(lines[1:], 2):
        try:
            rows.append(parsed(cells))
        except ValueError as error:
            raise Stop(USAGE, f"{path}:{number}: {error}") from None
    return rows


def row_of(measured, calibration, commit):
    peak = 0.0 if measured.peak_hidden() else round(measured.least("peak"), 1)
    return Row(commit, time.strftime("%Y-%m-%d", time.gmtime()), machine(), measured.item.kind, measured.item.size,
               measured.item.digest, round(measured.least("cpu"), 6), peak, round(calibration, 6), len(measured.runs),
               round(measured.differ(), 3))


def check_appendable(path):
    check_writable(path)
    read_rows(path)


def append(path, rows):
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    if read_rows(path) is None:
        writer.writerow(COLUMNS)
    else:
        with open(path, encoding="utf-8", newline="") as file:
            text.write(file.read())
    writer.writerows(dataclasses.astuple(row) for row in rows)
    write_whole(path, text.getvalue())


def recordable(all_measured):
    """Those of the first program that were accepted: what went wrong is no measure."""
    return [each for each in all_measured if isinstance(each.program, Ours) and each.verdict() == YES]


# The check

def percent(growth):
    return f"{100 * growth:.0f} %"


def compare_cpu(row, other, what):
    """A line, and whether it is more than the noise; None where it did not grow by much."""
    growth = row.cost() / other.cost() - 1
    if growth <= LARGEST_GROWTH:
        return None
    line = (f"{row.kind} {short_size(row.size)}: CPU {percent(growth)} above {what} {other.commit}: {row.cpu_s:.3f} s at a calibration of "
            f"{row.calibration_s:.3f} s, {other.cpu_s:.3f} s at {other.calibration_s:.3f} s")
    noise = max(row.differ, other.differ)
    if min(row.rounds, other.rounds) < 2:
        return line + "; doubtful, of one round", False
    if growth <= noise:
        return line + f"; doubtful, rounds differ by {percent(noise)}", False
    return line, True


def compare_peak(row, other, what):
    growth = row.peak_mb / other.peak_mb - 1 if other.peak_mb > 0 else 0.0
    if growth <= LARGEST_GROWTH:
        return None
    return (f"{row.kind} {short_size(row.size)}: memory {percent(growth)} above {what} {other.commit}: {row.peak_mb:.0f} MB, "
            f"{other.peak_mb:.0f} MB"), True


def compare_row(row, before):
    """With the last before, and with the best: many small steps are a large one."""
    last = before[-1]
    found = []
    for compare, figure in ((compare_cpu, Row.cost), (compare_peak, lambda r: r.peak_mb or math.inf)):
        best = min(before, key=figure)
        lines = [compare(row, last, "the row before,")]
        if best is not last:
            lines.append(compare(row, best, "the best,"))
        found += [line for line in lines if line]
    return found


def since_commit(rows, since):
    for number, row in enumerate(rows):
        if row.commit.startswith(since):
            return rows[number:]
    raise Stop(USAGE, f"no row of the history is of {since}")


def latest_by_commit(rows):
    """In the order of the rows that count."""
    found = {}
    for row in rows:
        found.pop(row.commit, None)
        found[row.commit] = row
    return list(found.values())


def check(rows, since=None):
    """Lines to print, and whether something grew beyond doubt. The latest commit is that of the last row."""
    rows = since_commit(rows, since) if since else rows
    if not rows:
        return ["no rows"], False
    newest = rows[-1]
    latest = {row.key(): row for row in rows if (row.commit, row.machine) == (newest.commit, newest.machine)}
    lines, compared, sure = [], 0, 0
    for key, row in latest.items():
        before = latest_by_commit(other for other in rows if other.key() == key and other.commit != row.commit)
        if before:
            compared += 1
            found = compare_row(row, before)
            lines += [line for line, _ in found]
            sure += any(certain for _, certain in found)
    lines.append(f"{newest.commit} on {newest.machine}: {compared} of {len(latest)} inputs have rows before, {sure} grew by over "
                 f"{percent(LARGEST_GROWTH)}")
    return lines, sure > 0
