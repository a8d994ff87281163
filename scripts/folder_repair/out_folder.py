# SPDX-License-Identifier: MIT
"""OUT_DIR: its lock, its journal, and how files get into it."""

import errno
import fcntl
import filecmp
import os
import shutil
import time

from .basics import NAME, OUTPUT, USAGE, Stop, text
from .inputs import STATE
from .journal import outputs_in

JOURNAL = b"journal.jsonl"
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
    """OUT_DIR, locked as long as this process or one of its workers lives.

    A run of all files has it for itself. Runs of shards share it; each has its own journal, summary and room for
    its workers in OUT_DIR/.repair_folder/shards, and a lock on them.
    """

    def __init__(self, path, shard=None):
        self.path = path
        whole = os.path.join(path, STATE)
        self.shards = os.path.join(whole, b"shards")
        self.state = os.path.join(self.shards, shard.folder) if shard else whole
        self.work = os.path.join(self.state, b"work")
        self.journal_path = os.path.join(self.state, JOURNAL)
        self.main_journal = os.path.join(whole, JOURNAL)
        os.makedirs(self.state, exist_ok=True)
        # Workers inherit the descriptors, so a run never meets those of one before.
        self.locks = [self.take_lock(whole, fcntl.LOCK_SH if shard else fcntl.LOCK_EX)]
        if shard:
            self.locks.append(self.take_lock(self.state, fcntl.LOCK_EX))
        self.is_new = not any(map(os.path.exists, (self.journal_path, self.main_journal)))
        self.unsynced = set()  # folders with files whose names are not yet sure to be on the disk
        self.clear_work()

    def drop_shards(self):
        """Once all that their journals hold is in that of the whole."""
        shutil.rmtree(self.shards, ignore_errors=True)

    def journals_of_shards(self):
        try:
            return [os.path.join(self.shards, name, JOURNAL) for name in sorted(os.listdir(self.shards))]
        except FileNotFoundError:
            return []

    def take_lock(self, folder, kind):
        """The descriptor."""
        flags = os.O_RDWR | os.O_CREAT | os.O_CLOEXEC
        descriptor = os.open(os.path.join(folder, b"lock"), flags, 0o666)
        deadline = time.monotonic() + LOCK_SECONDS
        while True:
            try:
                fcntl.flock(descriptor, kind | fcntl.LOCK_NB)
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
        if not self.is_new:
            return
        there = [job.output for job in jobs if os.path.lexists(job.target)]
        if there:
            known = outputs_in(self.journals_of_shards())
            there = [name for name in there if name not in known]
        there += [name for name in others if os.path.lexists(os.path.join(self.path, name)) and not self.journals_of_shards()]
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
        """Puts a finished file into its place. On the disk after sync()."""
        if not self.holds(target):
            raise OSError(errno.ELOOP, "a link leads out of OUT_DIR")
        os.makedirs(os.path.dirname(target), exist_ok=True)
        os.rename(made, target)
        self.unsynced.add(os.path.dirname(target))

    def sync(self):
        while self.unsynced:
            sync_folder(self.unsynced.pop())

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

    def write(self, name, data, folder=None):
        """Atomically; to OUT_DIR, or to another folder in it. `data` comes in pieces."""
        temporary = os.path.join(self.work, name)
        with open(temporary, "wb") as file:
            file.writelines(data)
            file.flush()
            os.fsync(file.fileno())
        self.take(temporary, os.path.join(folder or self.path, name))
        self.sync()
