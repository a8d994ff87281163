"""OUT_DIR: its lock, its journal, and how files get into it."""

import collections
import errno
import fcntl
import filecmp
import json
import os
import shutil
import stat
import time

from .basics import MEASURED, NAME, OUTPUT, SAME_IN_EACH_RUN, USAGE, Stop, text
from .gallery import is_place
from .inputs import STATE
from .pictures import may_be_written

LOCK_SECONDS = 2  # how long the workers of a killed run may take to die


def sync_folder(path):
    descriptor = os.open(path, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
    try:
        os.fsync(descriptor)
    except OSError:
        pass  # some file systems cannot; the rename is whole all the same
    finally:
        os.close(descriptor)


class OutFolder:
    """OUT_DIR, locked as long as this process or one of its workers lives."""

    def __init__(self, path):
        self.path = path
        self.state = os.path.join(path, STATE)
        self.work = os.path.join(self.state, b"work")
        self.journal_path = os.path.join(self.state, b"journal.jsonl")
        os.makedirs(self.state, exist_ok=True)
        self.lock = self.take_lock()
        self.is_new = not os.path.exists(self.journal_path)
        self.clear_work()

    def take_lock(self):
        """The descriptor. Workers inherit it, so a run never meets those of one before."""
        flags = os.O_RDWR | os.O_CREAT | os.O_CLOEXEC
        descriptor = os.open(os.path.join(self.state, b"lock"), flags, 0o666)
        deadline = time.monotonic() + LOCK_SECONDS
        while True:
            try:
                fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
                return descriptor
            except BlockingIOError:
                if time.monotonic() > deadline:
                    raise Stop(OUTPUT, f"{text(self.path)}: another run is at work here") from None
                time.sleep(0.05)

    def clear_work(self):
        """What a killed run has left is there, and nowhere else."""
        shutil.rmtree(self.work, ignore_errors=True)
        os.makedirs(self.work, exist_ok=True)

    def refuse_foreign_files(self, jobs, others):
        """What no run of this script has written is not replaced unasked: outputs, and others with these names."""
        there = [job.output for job in jobs if os.path.lexists(job.target)] if self.is_new else []
        there += [name for name in others if self.is_new and os.path.lexists(os.path.join(self.path, name))]
        if there:
            raise Stop(USAGE, f"{text(self.path)} holds files that would be replaced and are not from "
                              f"{NAME}, {len(there):,} of them, such as {text(there[0])}: "
                              "use another folder, or --restart")

    def holds(self, target):
        """No link leads out of OUT_DIR on the way to the target, to the inputs perhaps."""
        way = os.path.dirname(os.path.relpath(target, self.path))
        return os.path.realpath(os.path.dirname(target)) == \
            os.path.normpath(os.path.join(os.path.realpath(self.path), way))

    def take(self, made, target):
        """Puts a finished file into its place."""
        if not self.holds(target):
            raise OSError(errno.ELOOP, "a link leads out of OUT_DIR")
        os.makedirs(os.path.dirname(target), exist_ok=True)
        os.rename(made, target)
        sync_folder(os.path.dirname(target))

    def take_copy(self, path, target):
        made = os.path.join(self.work, b"copy")
        with open(path, "rb") as source, open(made, "wb") as file:
            shutil.copyfileobj(source, file)
            file.flush()
            os.fsync(file.fileno())
        self.take(made, target)

    @staticmethod
    def holds_same(made, target):
        return os.path.isfile(target) and not os.path.islink(target) and filecmp.cmp(made, target, shallow=False)

    def remove(self, target):
        """What an earlier run made of an input that now fails."""
        if self.holds(target) and (os.path.isfile(target) or os.path.islink(target)):
            os.unlink(target)

    def write(self, name, data):
        """Atomically."""
        temporary = os.path.join(self.work, name)
        with open(temporary, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        self.take(temporary, os.path.join(self.path, name))


def key_of(name):
    """A name in the journal: bytes that are no UTF-8 as lone surrogates, which JSON can hold."""
    return name.decode("utf-8", "surrogateescape")


def bytes_of(key):
    return key.encode("utf-8", "surrogateescape")


class Journal:
    """OUT_DIR/.repair_folder/journal.jsonl: what is finished, one JSON object in each line.

    Keys: `path` and `output`, names relative to IN_DIR and OUT_DIR; `beside`: names of the files that the output
    needs beside it, and their sizes, if there are any; `pictures`: the same of copies of pictures; `size` and
    `mtime_ns` of the input; `needs`: names of other files that it names, from its folder, with [size, mtime_ns] of
    each, null where there is none, or "unknown"; `shown`: its page and picture in the gallery, and their sizes, and
    `facts`, what the gallery says of it; `settings`: version of the program, first digits of its SHA-256, --format,
    --html, options after --; `final`: not to be tried again; `row`: as in the summary. The last line of a path
    counts. A line that is not whole counts for nothing; at the end of the file it is cut off before the next one
    is written.
    """

    def __init__(self, path, settings, anew):
        self.folder = os.path.dirname(os.path.dirname(path))
        self.settings = settings
        self.entries = {}
        self.owners = collections.defaultdict(set)  # of the files beside outputs, and pictures: the inputs
        flags = os.O_RDWR | os.O_CREAT | os.O_APPEND | os.O_CLOEXEC | (os.O_TRUNC if anew else 0)
        self.descriptor = os.open(path, flags, 0o666)
        with open(path, "rb") as file:
            data = file.read()
        end = data.rfind(b"\n") + 1
        os.ftruncate(self.descriptor, end)
        for line in data[:end].splitlines():
            self.read(line)

    def read(self, line):
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
                self.keep(entry)
        except (ValueError, TypeError, KeyError, AttributeError, RecursionError):
            pass

    def keep(self, entry):
        for name in self.files_of(self.entries.get(entry["path"], {})):
            self.owners[name].discard(entry["path"])
        self.entries[entry["path"]] = entry
        for name in self.files_of(entry):
            self.owners[name].add(entry["path"])

    @staticmethod
    def files_of(entry):
        """Names -> sizes of what is in OUT_DIR besides the output."""
        return {**entry.get("beside", {}), **entry.get("pictures", {}), **entry.get("shown", {})}

    def finished_row(self, job):
        """The row of a job that need not be done again, or None. job.look() was called."""
        entry = self.entries.get(key_of(job.name))
        if entry is None or not entry.get("final") or entry.get("settings") != self.settings or \
           entry.get("output") != key_of(job.output) or \
           (entry.get("size"), entry.get("mtime_ns")) != (job.size, job.mtime_ns) or \
           any(job.state_of(name) != state for name, state in entry.get("needs", {}).items()):
            return None
        promised = entry["row"]["bytes_out"]
        is_whole = promised is None or self.is_there(job.target, promised) and all(
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
                 "mtime_ns": job.mtime_ns, "settings": self.settings, "final": final, "row": row}
        if row["output"] and job.beside:
            entry["beside"] = {key_of(name): size for name, size in job.beside.items()}
        if row["output"] and job.pictures:
            entry["pictures"] = {key_of(name): size for name, size in job.pictures.items()}
        if row["output"] and job.shown:
            entry["shown"] = {key_of(name): size for name, size in job.shown.items()}
            entry["facts"] = job.facts
        if job.needs:
            entry["needs"] = job.needs
        data = json.dumps(entry).encode() + b"\n"
        written = os.write(self.descriptor, data)
        while written < len(data):  # the disk is full, and the next call says so
            written += os.write(self.descriptor, data[written:])
        os.fsync(self.descriptor)
        self.keep(entry)
