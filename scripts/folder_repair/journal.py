# SPDX-License-Identifier: MIT
"""The journal of a run: what is finished, and need not be done again."""

import collections
import json
import os
import stat
import time

from .basics import ROW, bytes_of, key_of, packed
from .gallery import is_place
from .pictures import may_be_written


def lines_of(path):
    try:
        with open(path, "rb") as file:
            yield from file
    except FileNotFoundError:
        pass


def outputs_in(journals):
    """Names of what these journals say was written, without a look at what else they say."""
    found = set()
    for path in journals:
        for line in lines_of(path):
            entry = Journal.entry_in(line)
            if entry:
                found.add(bytes_of(entry.output))
    return found


KEYS_OF_ALL = {"path", "output", "size", "mtime_ns", "settings", "final", "row", "time_ns"}
BYTES_OUT = ROW.index("bytes_out")
NOTHING = {}  # what most entries have of most kinds; nobody changes it


class Entry:
    """What the journal has of an input. There are as many as there are files, so they are small; `row` is packed()."""
    __slots__ = ("path", "output", "size", "mtime_ns", "settings", "final", "row", "time_ns", "beside", "pictures", "shown",
                 "facts", "needs")

    def __eq__(self, other):
        return isinstance(other, Entry) and all(getattr(self, name) == getattr(other, name) for name in Entry.__slots__)

    @staticmethod
    def of(read):
        """Of the object in a line; any error if it is none."""
        if set(read["row"]) != set(ROW) or not isinstance(read["path"], str) or not isinstance(read["output"], str):
            raise ValueError
        entry = Entry()
        entry.path = read["path"]
        entry.output = entry.path if read["output"] == entry.path else read["output"]
        entry.size, entry.mtime_ns = read.get("size"), read.get("mtime_ns")
        entry.settings, entry.final, entry.time_ns = read.get("settings"), read.get("final"), read.get("time_ns", 0)
        if read["row"]["path"] == entry.path:
            read["row"]["path"] = entry.path
        entry.row = packed(read["row"])
        entry.beside = entry.pictures = entry.shown = entry.facts = entry.needs = NOTHING
        if read.keys() - KEYS_OF_ALL:
            entry.take_others(read, os.path.dirname(entry.output))
        return entry

    def take_others(self, read, folder):
        """What few have."""
        beside, pictures, shown = (read.get(kind, NOTHING).items() for kind in ("beside", "pictures", "shown"))
        self.beside = {name: size for name, size in beside if os.path.dirname(name) == folder} or NOTHING
        self.pictures = {name: size for name, size in pictures if may_be_written(bytes_of(name))} or NOTHING
        self.shown = {name: size for name, size in shown if is_place(bytes_of(name))} or NOTHING
        self.facts = dict(read.get("facts", NOTHING)) or NOTHING
        self.needs = dict(read.get("needs", NOTHING)) or NOTHING

    def files(self):
        """Names -> sizes of what is in OUT_DIR besides the output."""
        if self.beside or self.pictures or self.shown:
            return {**self.beside, **self.pictures, **self.shown}
        return NOTHING


class Journal:
    """OUT_DIR/.repair_folder/journal.jsonl: what is finished, one JSON object in each line.

    Keys: `path` and `output`, names relative to IN_DIR and OUT_DIR; `beside`: names of the files that the output
    needs beside it, and their sizes, if there are any; `pictures`: the same of copies of pictures; `size` and
    `mtime_ns` of the input, or what stands for it of a member of an archive; `needs`: names of other files that it
    names, from its folder, with [size, mtime_ns] of each, null where there is none, or "unknown"; `shown`: its page and
    picture in the gallery, and their sizes, and
    `facts`, what the gallery says of it; `settings`: version of the program, first digits of its SHA-256, --format,
    --html, options after --; `final`: not to be tried again; `row`: as in the summary; `time_ns`: when it was
    written. The latest line of a path counts, the last one of those. A line that is not whole counts for nothing;
    at the end of the file it is cut off before the next one is written.

    Other journals are read as well, but not written: those of shards by a run of all files, and that one's by runs
    of shards.
    """

    def __init__(self, folder, path, settings, anew, others=(), holds=None):
        """`folder`: OUT_DIR. `holds`: whether a name is in the shard of this run."""
        self.folder = folder
        self.settings = settings
        self.holds = holds
        self.entries = {}
        self.waiting = []  # lines that are not written yet
        self.owners = collections.defaultdict(set)  # of the files beside outputs, and pictures: the inputs
        if not anew:
            for other in others:
                self.read_other(other)
        flags = os.O_RDWR | os.O_CREAT | os.O_APPEND | os.O_CLOEXEC | (os.O_TRUNC if anew else 0)
        self.descriptor = os.open(path, flags, 0o666)
        end = 0
        for line in lines_of(path):
            if line.endswith(b"\n"):
                end += len(line)
                self.read(line)
        os.ftruncate(self.descriptor, end)

    def read_other(self, path):
        for line in lines_of(path):
            self.read(line)

    def take_over(self, others):
        """Writes what only other journals hold to this one. On the disk when this returns."""
        for path in others:
            for line in lines_of(path):
                entry = self.entry_in(line)
                if entry and self.entries.get(entry.path) == entry:
                    self.write(line.rstrip(b"\n") + b"\n")
        os.fsync(self.descriptor)

    def read(self, line):
        entry = self.entry_in(line)
        if entry and not (self.holds and not self.holds(bytes_of(entry.path))):
            self.keep(entry)

    @staticmethod
    def entry_in(line):
        """None if it holds none."""
        try:
            return Entry.of(json.loads(line))
        except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
            pass
        return None

    def keep(self, entry):
        earlier = self.entries.get(entry.path)
        if earlier and entry.time_ns < earlier.time_ns:
            return
        if entry.settings == self.settings:
            entry.settings = self.settings  # one for all
        for name in earlier.files() if earlier else ():
            self.owners[name].discard(entry.path)
        self.entries[entry.path] = entry
        for name in entry.files():
            self.owners[name].add(entry.path)

    def finished_row(self, job, also_failed=False):
        """The row of a job that need not be done again, or None. job.look() was called. `also_failed`: one that was
        done counts, even if it should be tried again."""
        entry = self.entries.get(key_of(job.name))
        if entry is None or not (also_failed or entry.final) or entry.settings != self.settings or \
           entry.output != key_of(job.output) or (entry.size, entry.mtime_ns) != (job.size, job.mtime_ns) or \
           any(job.state_of(name) != state for name, state in entry.needs.items()):
            return None
        promised = entry.row[BYTES_OUT]
        is_whole = (promised is None or self.is_there(job.target, promised)) and all(
            self.is_there(os.path.join(self.folder, bytes_of(name)), size)
            for name, size in entry.files().items())
        return entry.row if is_whole else None

    @staticmethod
    def is_there(target, size):
        try:
            status = os.lstat(target)
        except OSError:
            return False
        return stat.S_ISREG(status.st_mode) and status.st_size == size

    def entry_of(self, job):
        """None if there is none."""
        return self.entries.get(key_of(job.name))

    def files_beside(self, job):
        """Names of what lies beside the output of the last run, and of its pictures."""
        entry = self.entry_of(job)
        return {bytes_of(name) for name in entry.files()} if entry else set()

    def others_with(self, name, job, of_pictures=True):
        """The inputs, as keys, whose outputs have this file beside them, or as a picture, but for the job's own."""
        others = self.owners.get(key_of(name), set()) - {key_of(job.name)}
        return {key for key in others if of_pictures or key_of(name) in self.entries[key].beside}

    def outputs(self):
        """Names of what earlier runs have written, as far as the journal knows."""
        return {bytes_of(entry.output) for entry in self.entries.values() if entry.row[BYTES_OUT] is not None}

    def add(self, job, row, final):
        """On the disk after flush(). Returns the row, packed."""
        entry = {"path": key_of(job.name), "output": key_of(job.output), "size": job.size,
                 "mtime_ns": job.mtime_ns, "settings": self.settings, "final": final, "row": row,
                 "time_ns": time.time_ns()}
        if row["output"] and job.beside:
            entry["beside"] = {key_of(name): size for name, size in job.beside.items()}
        if row["output"] and job.pictures:
            entry["pictures"] = {key_of(name): size for name, size in job.pictures.items()}
        if job.shown:
            entry["shown"] = {key_of(name): size for name, size in job.shown.items()}
            entry["facts"] = job.facts
        if job.needs:
            entry["needs"] = job.needs
        self.waiting.append(json.dumps(entry).encode() + b"\n")
        kept = Entry.of(entry)
        self.keep(kept)
        return kept.row

    def flush(self):
        """OSError if it cannot be written."""
        if self.waiting:
            lines, self.waiting = self.waiting, []
            self.write(b"".join(lines))
            os.fsync(self.descriptor)

    def write(self, data):
        written = os.write(self.descriptor, data)
        while written < len(data):  # the disk is full, and the next call says so
            written += os.write(self.descriptor, data[written:])
