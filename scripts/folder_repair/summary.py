# SPDX-License-Identifier: MIT
"""What a run tells: its progress, and the summary at the end."""

import collections
import csv
import io
import json
import sys
import time

from .basics import DONE, MEANINGS, MEASURED, ROW, SAME_IN_EACH_RUN, print_to, say, text, unpacked

DRAW_SECONDS = 0.2  # between drawings of the line of progress on a terminal
PIECE = 1 << 16  # of a summary
LINE_SECONDS = 30  # between lines of progress elsewhere


class Progress:
    """A line on standard error: redrawn on a terminal, one now and then elsewhere."""

    def __init__(self, total, done, failed, quiet):
        self.total, self.done, self.failed = total, done, failed
        self.is_terminal = sys.stderr.isatty()
        self.is_silent = quiet
        self.recent = collections.deque([time.monotonic()], maxlen=50)  # when files were finished
        self.drawn = 0.0 if self.is_terminal else time.monotonic()

    def line(self):
        line = f"{self.done:,}/{self.total:,} done, {self.failed:,} failed"
        span = time.monotonic() - self.recent[0]
        if len(self.recent) > 1 and span > 0:
            rate = (len(self.recent) - 1) / span
            left = int((self.total - self.done) / rate)
            line += f", {rate:.3g} files/s, {left // 3600}:{left // 60 % 60:02}:{left % 60:02} left"
        return line

    def draw(self):
        now = time.monotonic()
        if self.is_silent or now < self.drawn + (DRAW_SECONDS if self.is_terminal else LINE_SECONDS):
            return
        self.drawn = now
        if self.is_terminal:
            print_to(sys.stderr, f"\r\x1b[K{self.line()}")
        else:
            say(self.line())

    def clear(self):
        if self.is_terminal and not self.is_silent:
            print_to(sys.stderr, "\r\x1b[K")
            self.drawn = 0.0

    def finished(self, row):
        self.recent.append(time.monotonic())
        self.done += 1
        if row["exit_code"] != DONE:
            self.failed += 1
            self.clear()
            say(f"{row['path']}: {row['error']} (exit code {row['exit_code']})")


class PackedRows:
    """Rows, each unpacked when its turn comes."""

    def __init__(self, rows):
        self.rows = rows

    def __len__(self):
        return len(self.rows)

    def __iter__(self):
        return map(unpacked, self.rows)


def totals_of(rows, not_done):
    codes = collections.Counter()
    sums = dict.fromkeys(("triangles_in", "triangles_out", "bytes_in", "bytes_out"), 0)
    for row in rows:
        codes[row["exit_code"]] += 1
        for key in sums:
            sums[key] += row[key] or 0
    return {"files": len(rows) + not_done, "not_done": not_done,
            "by_exit_code": {str(code): codes[code] for code in sorted(codes)}, **sums}


def as_csv(rows):
    """In pieces, for there may be very many rows."""
    file = io.StringIO(newline="")
    writer = csv.writer(file)
    writer.writerow(ROW)
    for row in rows:
        writer.writerow(row.values())
        if file.tell() > PIECE:
            yield file.getvalue().encode("utf-8", "backslashreplace")
            file.seek(0)
            file.truncate()
    yield file.getvalue().encode("utf-8", "backslashreplace")


def as_json(rows, totals, left_out, settings, elapsed):
    """A line for each file, in pieces. What differs from run to run stands in "measured"."""
    head = {"program": settings[0], "format": settings[2] or None, "options": settings[3:],
            "totals": totals, "measured": {"seconds": round(elapsed, 3)},
            "left_out": [{"path": text(name), "why": why} for name, why in sorted(left_out.items())]}
    files = (json.dumps({**{key: row[key] for key in SAME_IN_EACH_RUN},
                         "measured": {key: row[key] for key in MEASURED}}) for row in rows)
    opened = json.dumps(head, indent=2).removesuffix("\n}")
    yield (opened + ',\n  "files": [\n    ').encode()
    for number, file in enumerate(files):
        yield (",\n    " if number else "").encode() + file.encode()
    yield b"\n  ]\n}\n"


def table(totals, elapsed):
    lines = ["exit code    files  means"]
    for code, number in totals["by_exit_code"].items():
        lines.append(f"{code:>9} {number:>8,}  {MEANINGS.get(int(code), 'failed')}")
    if totals["not_done"]:
        lines.append(f"{'none':>9} {totals['not_done']:>8,}  not done")
    lines.append(f"{'all':>9} {totals['files']:>8,}  {totals['triangles_in']:,} triangles in, "
                 f"{totals['triangles_out']:,} out, in {elapsed:.1f} s")
    return "\n".join(lines) + "\n"
