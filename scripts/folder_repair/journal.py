"""The journal of a run: what is finished, and need not be done again."""

import collections
import json
import os
import stat
import time

from .basics import MEASURED, SAME_IN_EACH_RUN, bytes_of, key_of
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
            if entry and isinstance(entry["output"], str):
                found.add(bytes_of(entry["output"]))
    return found


class Journal:
    """OUT_DIR/.repair_folder/journal.jsonl: what is finished, one JSON object in each line.

    Keys: `path` and `output`, names relative to IN_DIR and OUT_DIR; `beside`: names of the files that the output
    needs beside it, and their sizes, if there are any; `pictures`: the same of copies of pictures; `size` and
    `mtime_ns` of the input; `needs`: names of other files that it names, from its folder, with [size, mtime_ns] of
    each, null where there is none, or "unknown"; `shown`: its page and picture in the gallery, and their sizes, and
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
        self.owners = collections.defaultdict(set)  # of the files beside outputs, and pictures: the inputs
        if not anew:
            for other in others:
                self.read_other(other)
        flags = os.O_RDWR | os.O_CREAT | os.O_APPEND | os.O_CLOEXEC | (os.O_TRUNC if anew else 0)
        self.descriptor = os.open(path, flags, 0o666)
        with open(path, "rb") as file:
            data = file.read()
        end = data.rfind(b"\n") + 1
        os.ftruncate(self.descriptor, end)
        for line in data[:end].splitlines():
            self.read(line)

    def read_other(self, path):
        for line in lines_of(path):
            self.read(line)

    def take_over(self, others):
        """Writes what only other journals hold to this one. On the disk when this returns."""
        for path in others:
            for line in lines_of(path):
                entry = self.entry_in(line)
                if entry and self.entries.get(entry["path"]) == entry:
                    self.write(json.dumps(entry).encode() + b"\n")
        os.fsync(self.descriptor)

    def read(self, line):
        entry = self.entry_in(line)
        if entry and not (self.holds and not self.holds(bytes_of(entry["path"]))):
            self.keep(entry)

    @staticmethod
    def entry_in(line):
        """None if it holds none."""
        try:
            entry = json.loads(line)
            if set(entry["row"]) == set(SAME_IN_EACH_RUN + MEASURED):
                folder = os.path.dirname(entry["output"])
                beside = entry.get("beside", {}).items()
                entry["beside"] = {name: size for name, size in beside if os.path.dirname(name) == folder}
                pictures = entry.get("pictures", {}).items()
                entry["pictures"] = {name: size for name, size in pictures if may_be_written(bytes_of(name))}
                shown = entry.get("shown", {}).items()
                entry["shown"] = {name: size for name, size in shown if is_place(bytes_of(name))}
                entry["facts"] = dict(entry.get("facts", {}))
                entry["needs"] = dict(entry.get("needs", {}))
                return entry if isinstance(entry["path"], str) else None
        except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
            pass
        return None

    def keep(self, entry):
        if entry.get("time_ns", 0) < self.entries.get(entry["path"], {}).get("time_ns", 0):
            return
        for name in self.files_of(self.entries.get(entry["path"], {})):
            self.owners[name].discard(entry["path"])
        self.entries[entry["path"]] = entry
        for name in self.files_of(entry):
            self.owners[name].add(entry["path"])

    @staticmethod
    def files_of(entry):
        """Names -> sizes of what is in OUT_DIR besides the output."""
        return {**entry.get("beside", {}), **entry.get("pictures", {}), **entry.get("shown", {})}

    def finished_row(self, job, also_failed=False):
        """The row of a job that need not be done again, or None. job.look() was called. `also_failed`: one that was
        done counts, even if it should be tried again."""
        entry = self.entries.get(key_of(job.name))
        if entry is None or not (also_failed or entry.get("final")) or entry.get("settings") != self.settings or \
           entry.get("output") != key_of(job.output) or \
           (entry.get("size"), entry.get("mtime_ns")) != (job.size, job.mtime_ns) or \
           any(job.state_of(name) != state for name, state in entry.get("needs", {}).items()):
            return None
        promised = entry["row"]["bytes_out"]
        is_whole = (promised is None or self.is_there(job.target, promised)) and all(
            self.is_there(os.path.join(self.folder, bytes_of(name)), size)
            for name, size in self.files_of(entry).items())
        return entry["row"] if is_whole else None

    @staticmethod
    def is_there(target, size):
        try:
            status = os.lstat(target)
        except OSError:
            return False
        return stat.S_ISREG(status.st_mode) and status.st_size == size

    def entry_of(self, job):
        return self.entries.get(key_of(job.name), {})

    def files_beside(self, job):
        """Names of what lies beside the output of the last run, and of its pictures."""
        return {bytes_of(name) for name in self.files_of(self.entries.get(key_of(job.name), {}))}

    def others_with(self, name, job, of_pictures=True):
        """The inputs, as keys, whose outputs have this file beside them, or as a picture, but for the job's own."""
        others = self.owners.get(key_of(name), set()) - {key_of(job.name)}
        return {key for key in others if of_pictures or key_of(name) in self.entries[key].get("beside", {})}

    def outputs(self):
        """Names of what earlier runs have written, as far as the journal knows."""
        return {bytes_of(entry["output"]) for entry in self.entries.values()
                if entry["row"]["bytes_out"] is not None}

    def add(self, job, row, final):
        """On the disk when this returns; OSError if it cannot be."""
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
        self.write(json.dumps(entry).encode() + b"\n")
        os.fsync(self.descriptor)
        self.keep(entry)

    def write(self, data):
        written = os.write(self.descriptor, data)
        while written < len(data):  # the disk is full, and the next call says so
            written += os.write(self.descriptor, data[written:])
