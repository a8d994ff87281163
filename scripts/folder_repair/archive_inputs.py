# SPDX-License-Identifier: MIT
"""The meshes of an archive that is IN_DIR, as if it had been unpacked, and how those that are at work are."""

import errno
import os
import shutil
import time

from .archive import Broken, Lost, Member, safe_name
from .basics import ARCHIVE, FORMAT_OF_EXTENSION, INPUT, LIMIT, OUTPUT
from .inputs import STATE, Job, kind_of_archive, split_name
from .named_files import may_name_others, names_in

MOST_ROOM = 0.5  # of what is free on the disk: a member that takes more is not unpacked
KEPT_BYTES = 1 << 30  # of meshes that wait for what comes behind them in a stream


class NotUnpacked(Exception):
    """A job that cannot be begun: exit code and line."""

    def __init__(self, code, line):
        super().__init__(line)
        self.code = code


def is_mesh(name):
    _, extension, _ = split_name(name)
    return extension in FORMAT_OF_EXTENSION or name.lower().endswith(ARCHIVE)


def is_meant(name):
    """No file that macOS has put beside another, and none of a run of this script."""
    parts = name.split(b"/")
    return STATE not in parts and b"__MACOSX" not in parts and not parts[-1].startswith(b"._")


def write_chunks(chunks, size, path, seconds):
    """Writes a member to a new file, a chunk at each step. NotUnpacked if it cannot be."""
    deadline = time.monotonic() + seconds
    try:
        folder = os.path.dirname(path)
        os.makedirs(folder, exist_ok=True)
        disk = os.statvfs(folder)
        if size > MOST_ROOM * disk.f_bavail * disk.f_frsize:
            raise NotUnpacked(LIMIT, f"has {size:,} bytes unpacked: more than half of the room that is left on the disk")
        with open(path, "xb") as file:
            for data in chunks:
                file.write(data)
                yield
                if seconds and time.monotonic() > deadline:
                    raise NotUnpacked(LIMIT, f"is not unpacked at the time limit of {seconds:g} s")
    except Broken as error:
        raise NotUnpacked(INPUT, f"cannot be unpacked: {error}") from None
    except OSError as error:
        raise NotUnpacked(OUTPUT, f"cannot be unpacked: {error.strerror or error}") from None


class ArchiveInputs:
    """What is in the archive: `members`, those with a name that can be unpacked; of one name the last counts."""

    def __init__(self, archive, work, seconds):
        """`work`: a folder for what is looked at. It is removed at the end of a run, and the next one removes it, too.
        `seconds`: what a member may take to be unpacked."""
        self.archive = archive
        self.name_of_archive = os.path.basename(archive.path)
        self.work = work
        self.seconds = seconds
        self.members = {}
        self.meshes, self.left_out = {}, {}
        self.named = {}  # by members of a stream: name -> what they name
        self.kept = KeptMembers(self, os.path.join(work, b"kept")) if archive.is_stream else None

    def read(self, stopped):
        """The meshes, as find_meshes() has them: name -> extension of the mesh; and what was left out."""
        try:
            for written, member in self.archive.members():
                if stopped():
                    break
                self.take(written, member)
        except Broken as error:
            self.left_out[self.name_of_archive] = Lost(f"broken or cut off; what is before that is done: {error}")
        return dict(sorted(self.meshes.items())), self.left_out

    def listed(self, names):
        """The same of these names alone."""
        meshes, left_out = {}, {}
        for name in names:
            if name in self.left_out:
                left_out[name] = self.left_out[name]
            elif name in self.meshes or split_name(name)[1] in FORMAT_OF_EXTENSION:  # it may be missing: a row says so
                meshes[name] = self.meshes.get(name, split_name(name)[1])
            else:
                left_out[name] = "has not the name of a mesh"
        damage = {name: why for name, why in self.left_out.items() if name == self.name_of_archive}
        return dict(sorted(meshes.items())), {**left_out, **damage}

    def take(self, written, member):
        name = safe_name(written)
        if not is_meant(written):
            return
        if name is None:
            if is_mesh(written):
                self.left_out[written] = Lost("its name leads out of the archive")
        elif isinstance(member, Member):
            member.name = name
            self.members[name] = member
            for earlier in (self.meshes, self.left_out, self.named):
                earlier.pop(name, None)
            self.look_into(member)
        elif is_mesh(name):
            self.left_out[name] = member

    def look_into(self, member):
        """What it is, and what it names if there is no way back to it."""
        name = member.name
        if name.lower().endswith(ARCHIVE):
            self.look_at_copy(member, self.note_kind)
        elif split_name(name)[1] in FORMAT_OF_EXTENSION:
            self.meshes[name] = split_name(name)[1]
        if self.archive.is_stream and may_name_others(name):
            self.look_at_copy(member, self.note_names)

    def look_at_copy(self, member, look):
        path = os.path.join(self.work, b"look")
        try:
            for _ in write_chunks(self.archive.chunks(member), member.size, path, self.seconds):
                pass
            look(member.name, path)
        except NotUnpacked as error:
            if is_mesh(member.name):
                self.meshes.pop(member.name, None)
                self.left_out[member.name] = Lost(str(error))
        finally:
            if os.path.lexists(path):
                os.unlink(path)

    def note_kind(self, name, path):
        kind = kind_of_archive(path)
        if isinstance(kind, bytes):
            self.meshes[name] = kind
        elif kind:
            self.left_out[name] = kind

    def note_names(self, name, path):
        found = set()
        for _ in names_in(path, name, found):
            pass
        if found:
            self.named[name] = found

    def find(self, name, other):
        """The member that one of this name calls so, or None."""
        try:
            return self.members.get(os.path.normpath(os.path.join(os.path.dirname(name), other)))
        except ValueError:
            return None

    def members_named(self, name, found):
        both = [self.find(name, other) for word in found for other in {word, word.replace(b"\\", b"/")}]
        return {member.name: member for member in both if member}

    def needed_in_stream(self, job):
        """All that has to be unpacked for a job: what it names, and what that names."""
        waiting, needed = [job.member, *job.more], {}
        while waiting:
            member = waiting.pop()
            if member.name not in needed:
                needed[member.name] = member
                waiting += self.members_named(member.name, self.named.get(member.name, ())).values()
        return needed

    def in_order(self, jobs):
        """As they are best begun."""
        return self.kept.in_order(jobs) if self.kept else jobs

    def unpack(self, job, folder):
        """To this folder, the mesh and what it names; a generator, with some of the work at each step."""
        if self.archive.is_changed():
            raise NotUnpacked(INPUT, "cannot be unpacked: the archive has changed since this run began")
        if self.kept:
            yield from self.kept.unpack(job, folder, self.seconds)
            return
        waiting, job.unpacked = [job.member, *job.more], set()
        while waiting:
            member = waiting.pop()
            if member.name in job.unpacked:
                continue
            job.unpacked.add(member.name)
            path = os.path.join(folder, member.name)
            yield from write_chunks(self.archive.chunks(member), member.size, path, self.seconds)
            if may_name_others(member.name):
                found = set()
                yield from names_in(path, member.name, found)
                waiting += self.members_named(member.name, found).values()


class KeptMembers:
    """How jobs get their members from a stream, in one pass where possible: jobs come in the order in which all that they
    need has gone by, and what has gone by and is needed is kept until then. Meshes are kept up to a limit; those beyond it
    come at another pass."""

    def __init__(self, inputs, folder):
        self.inputs, self.archive, self.folder = inputs, inputs.archive, folder
        self.users = {}  # place -> number of jobs that need it still
        self.needed = {}  # name of a job -> its members
        self.paths = {}  # place -> where it is kept
        self.sizes = {}  # of meshes among them
        self.mesh_bytes = 0
        self.place = 0  # of what comes next, or before
        self.is_reading = False

    def in_order(self, jobs):
        jobs = [job for job in jobs if self.note(job)]
        place = self.archive.place_of
        return sorted(jobs, key=lambda job: (max(map(place, self.needed[job.name].values()), default=0),
                                             place(job.member) if job.member else 0))

    def note(self, job):
        self.needed[job.name] = self.inputs.needed_in_stream(job) if job.member else {}
        for member in self.needed[job.name].values():
            place = self.archive.place_of(member)
            self.users[place] = self.users.get(place, 0) + 1
        return True

    def unpack(self, job, folder, seconds):
        if job.name not in self.needed:  # it was begun before
            self.note(job)
        needed = self.needed.pop(job.name)
        job.unpacked = set(needed)
        places = {self.archive.place_of(member) for member in needed.values()}
        try:
            for place in sorted(places):
                if place not in self.paths:
                    yield from self.go_to(place, seconds)
            for name, member in needed.items():
                path = os.path.join(folder, name)
                os.makedirs(os.path.dirname(path), exist_ok=True)
                os.link(self.paths[self.archive.place_of(member)], path)
        except Broken as error:
            raise NotUnpacked(INPUT, f"cannot be unpacked: {error}") from None
        except OSError as error:
            raise NotUnpacked(OUTPUT, f"cannot be unpacked: {error.strerror or error}") from None
        finally:
            for place in places:
                self.release(place)

    def go_to(self, place, seconds):
        """Keeps what is there, and on the way there what others need."""
        if place < self.place or not self.is_reading:
            self.archive.rewind()
        self.is_reading = False  # should this end early
        while True:
            here = self.archive.next_place()
            if here is None or here > place:
                raise Broken("it is not where it was")
            self.place = here + 1
            info = self.archive.current
            is_needed = here in self.users and here not in self.paths
            if here == place or is_needed and self.has_room(info):
                yield from self.keep(info, here, seconds, is_asked=here == place)
            else:
                yield from self.archive.skip()
            if here == place:
                self.is_reading = True
                return

    @staticmethod
    def size_of_mesh(info):
        return info.size if is_mesh(os.fsencode(info.name)) else 0

    def has_room(self, info):
        return self.mesh_bytes + self.size_of_mesh(info) <= KEPT_BYTES

    def keep(self, info, place, seconds, is_asked):
        path = os.path.join(self.folder, b"%d" % place)
        try:
            yield from write_chunks(self.archive.current_chunks(), info.size, path, seconds)
            self.paths[place] = path
            self.mesh_bytes += self.size_of_mesh(info)
            self.sizes[place] = self.size_of_mesh(info)
        except NotUnpacked:
            if os.path.lexists(path):
                os.unlink(path)
            if is_asked:  # who needs it otherwise asks for it when its turn comes
                raise

    def release(self, place):
        self.users[place] -= 1
        if self.users[place]:
            return
        del self.users[place]
        path = self.paths.pop(place, None)
        if path:
            os.unlink(path)
            self.mesh_bytes -= self.sizes.pop(place)


class MemberJob(Job):
    """A mesh of an archive. It is unpacked when its turn comes, to a folder of its own that stands for IN_DIR."""

    def __init__(self, name, mesh, output, options, inputs):
        super().__init__(name, mesh, output, options)
        self.inputs = inputs
        self.member = inputs.members.get(name)
        self.more = []  # what it names and was not foreseen
        self.unpacked = set()

    def look(self):
        if self.member is None:
            raise FileNotFoundError(errno.ENOENT, os.strerror(errno.ENOENT))
        self.size, self.mtime_ns, self.looked_at = self.member.size, self.member.stamp, 0

    def unpack(self, folder):
        self.root, self.source = folder, os.path.join(folder, self.name)
        yield from self.inputs.unpack(self, folder)

    def clear(self):
        shutil.rmtree(self.root, ignore_errors=True)

    def member_called(self, name):
        """As the report has it."""
        member = self.inputs.find(self.name, os.fsencode(name))
        if member or "\ufffd" not in name:
            return member
        folder = os.path.normpath(os.path.join(os.path.dirname(self.name), os.path.dirname(os.fsencode(name))))
        meant = [one for one in self.inputs.members.values() if os.path.join(b".", os.path.dirname(one.name)) == os.path.join(b".", folder)
                 and os.path.basename(one.name).decode("utf-8", "replace") == os.path.basename(name)]
        return meant[0] if len(meant) == 1 else None

    def state_of(self, name):
        member = self.member_called(name)
        return [member.size, member.stamp] if member else None

    def may_have_changed(self, name):
        return False

    def lacks(self, names):
        """Members that the report names, and that were not unpacked: the mesh was read without them. They will be."""
        lacking = [member for member in map(self.member_called, names) if member and member.name not in self.unpacked]
        self.more += lacking
        return bool(lacking)
