# SPDX-License-Identifier: MIT
"""What there is to do: the mesh files of a folder, and the names of their outputs."""

import collections
import errno
import os
import stat
import time
import zipfile

from .basics import (ARCHIVE, BY_ITSELF, EXTENSION_OF_FORMAT, FORMAT_OF_EXTENSION, GUARANTEES, PACKINGS,
                     READS_OTHERS, ROW, TAR_ENDINGS, USAGE, Stop, text, value_of, warnings_of)

STATE = b".repair_folder"  # of a run, in its OUT_DIR; folders of this name are no input
UNKNOWN = "unknown"  # how a file was when it was read; it is like no other
CLOCK_STEP_NS = 20_000_000  # times of files are those of the last tick of the system's clock


def identity(path):
    status = os.stat(path)
    return status.st_dev, status.st_ino


def split_name(name):
    """b"sub/a.OBJ.gz" -> b"sub/a", b".obj", b".gz"."""
    stem, extension = os.path.splitext(name)
    packing = b""
    if extension.lower() in PACKINGS:
        packing = extension
        stem, extension = os.path.splitext(stem)
    return stem, extension.lower(), packing


def meshes_in_archive(path):
    """The extensions of the meshes in a ZIP archive, of each of them; None if it cannot be read. Which of its
    files are meshes is told by their names alone; the program looks at what is in them."""
    try:
        with zipfile.ZipFile(os.fsdecode(path)) as archive:
            names = [os.fsencode(name).replace(b"\\", b"/") for name in archive.namelist()]
    except Exception:  # pylint: disable=broad-exception-caught  # a broken archive may raise anything
        return None
    meshes = [name for name in names if not name.startswith(b"__MACOSX/")
              and not os.path.basename(name).startswith(b".")]
    return [extension for _, extension, packing in map(split_name, meshes)
            if extension in FORMAT_OF_EXTENSION and not packing]


def kind_of_archive(path):
    """As kind_of(); the extension of the mesh in it for "mesh"."""
    found = meshes_in_archive(path)
    if found is None:
        return "is no ZIP archive that can be read"
    if len(found) > 1:
        return f"holds several meshes: {BY_ITSELF}"
    return found[0] if found else None


def kind_of(entry, out_identity):
    """"mesh", "folder", why it is left out, or None for what is not meant. For an archive with a mesh in it the
    extension of that mesh, as bytes."""
    try:
        if entry.is_dir(follow_symlinks=False):
            is_own = entry.name == STATE or identity(entry.path) == out_identity
            return None if is_own else "folder"
        if entry.is_symlink() and entry.is_dir():
            return "is a link to a folder"
    except OSError:
        pass  # a loop of links, or gone: said when it is opened, if the name is that of a mesh
    if entry.name.lower().endswith(TAR_ENDINGS):
        return f"is an archive: {BY_ITSELF}"
    extension = split_name(entry.name)[1]
    is_archive = os.path.splitext(entry.name)[1].lower() == ARCHIVE
    if extension not in FORMAT_OF_EXTENSION and not is_archive:
        return None
    try:
        is_file = stat.S_ISREG(entry.stat().st_mode)
    except OSError:
        return None if is_archive else "mesh"
    if not is_file:
        return "is no regular file"
    return kind_of_archive(entry.path) if is_archive else "mesh"


def find_meshes(folder, out_folder, stopped):
    """The names of mesh files, relative to the folder and sorted: name -> extension of the mesh, which for an
    archive is that of what is in it; and what was left out: name -> why. The name of a folder that cannot be
    read ends with a slash."""
    meshes, left_out, waiting, out_identity = {}, {}, [b""], identity(out_folder)
    while waiting and not stopped():
        current = waiting.pop()
        try:
            with os.scandir(os.path.join(folder, current)) as entries:
                for entry in entries:
                    name, kind = os.path.join(current, entry.name), kind_of(entry, out_identity)
                    if kind == "mesh":
                        meshes[name] = split_name(name)[1]
                    elif isinstance(kind, bytes):
                        meshes[name] = kind
                    elif kind == "folder":
                        waiting.append(name)
                    elif kind:
                        left_out[name] = kind
        except OSError as error:
            left_out[(current or b".") + b"/"] = f"cannot be read: {error.strerror}"
    return dict(sorted(meshes.items())), left_out


def names_listed(path, folder):
    """Names of the files that a list names, one in each line, or each with a zero behind it. They are relative to the
    folder, or absolute and in it. Stop if one leads out of it."""
    try:
        with open(0 if path == b"-" else path, "rb", closefd=path != b"-") as file:
            data = file.read()
    except OSError as error:
        raise Stop(USAGE, f"--list: {text(path)}: {error.strerror}") from None
    names = []
    for line in data.split(b"\0" if b"\0" in data else b"\n"):
        if not line:
            continue
        names.append(os.path.relpath(os.path.normpath(os.path.join(folder, line)), folder))
        if names[-1].split(b"/")[0] == b"..":
            raise Stop(USAGE, f"--list: {text(line)} is not in {text(folder)}")
    return names


def listed_meshes(path, folder, out_folder):
    """As find_meshes(), of the files that a list names."""
    meshes, left_out, out_identity = {}, {}, identity(out_folder)
    for name in names_listed(path, folder):
        kind = kind_of(NamedEntry(os.path.join(folder, name)), out_identity)
        if kind == "mesh":
            meshes[name] = split_name(name)[1]
        elif isinstance(kind, bytes):
            meshes[name] = kind
        else:
            left_out[name] = kind if kind not in (None, "folder") else "has not the name of a mesh"
    return dict(sorted(meshes.items())), left_out


class NamedEntry:
    """What os.scandir() has of a file, by its name."""

    def __init__(self, path):
        self.path, self.name = path, os.path.basename(path)

    def is_dir(self, follow_symlinks=True):
        return os.path.isdir(self.path) and (follow_symlinks or not os.path.islink(self.path))

    def is_symlink(self):
        return os.path.islink(self.path)

    def stat(self):
        return os.stat(self.path)


def folders_of(names):
    found = set()
    for name in names:
        while name := os.path.dirname(name):
            found.add(name)
    return found


def name_outputs(meshes, output_format):
    """Input -> output, of what find_meshes() has found. The name stays, but for --format and for archives, which
    give way to the mesh in them. Inputs that would get one name keep their extensions: a.stl.obj, a.off.obj."""
    folders = folders_of(meshes)
    trials = {name: 0 for name, mesh in meshes.items() if output_format or name.lower().endswith(ARCHIVE)}
    fixed = len(meshes) + 1  # more than there are trials

    def output_of(name, mesh):
        if name not in trials:
            return name
        extension = EXTENSION_OF_FORMAT[output_format] if output_format else mesh
        return name + trials[name] * extension if trials[name] else split_name(name)[0] + extension

    while True:
        outputs = {name: output_of(name, mesh) for name, mesh in meshes.items()}
        users = collections.defaultdict(list)
        for name, output in outputs.items():
            users[output].append(name)
        clashing = set()
        for output, names in users.items():
            if len(names) > 1 or output in folders:
                least = min(trials.get(name, fixed) for name in names)
                clashing.update(name for name in names if trials.get(name) == least)
        if not clashing:  # names that were lengthened equally often differ, so this comes to an end
            return outputs
        for name in clashing:
            trials[name] += 1


class Job:
    """One file to repair."""

    def __init__(self, name, mesh, output, options):
        """`mesh` is the extension of the mesh that it is or holds."""
        self.name = name
        self.root = options.in_dir  # names lead nowhere else
        self.source = os.path.join(options.in_dir, name)
        self.output = output
        self.target = os.path.join(options.out_dir, output)
        self.format = options.format or FORMAT_OF_EXTENSION[mesh]
        self.packing = split_name(output)[2]  # the program packs what has such a name
        self.size = self.mtime_ns = self.looked_at = None
        self.reads_others = mesh in READS_OTHERS
        self.trials = 0
        self.beside = {}  # what its output needs beside it, relative to OUT_DIR: name -> size
        self.pictures = {}  # that it names, the same
        self.shown = {}  # its page and picture in the gallery, the same
        self.facts = {}  # for the gallery
        self.needs = {}  # other files that it names, from its folder: name -> as state_of() has it, or UNKNOWN

    def look(self):
        """Notes what the file is like now; OSError if it cannot be opened. Never waits."""
        descriptor = os.open(self.source, os.O_RDONLY | os.O_NONBLOCK | os.O_CLOEXEC)
        try:
            status = os.fstat(descriptor)
        finally:
            os.close(descriptor)
        if not stat.S_ISREG(status.st_mode):
            raise OSError(errno.EINVAL, "is no regular file")
        self.size, self.mtime_ns = status.st_size, status.st_mtime_ns
        self.looked_at = time.time_ns()

    def unpack(self, folder):
        """Gets it ready in this folder, if it is not yet; in steps. NotUnpacked if it cannot be."""
        return ()

    def clear(self):
        """Removes what was got ready."""

    def lacks(self, names):
        """Some of these, which the mesh names, are to be had, but were not there when it was read."""
        return False

    def path_of(self, name):
        """Of a file that it names. Reports have U+FFFD for what is no UTF-8: then it is the file that is meant."""
        path = os.path.join(os.path.dirname(self.source), os.fsencode(name))
        if "\ufffd" not in os.path.basename(name):
            return path
        try:
            names = os.listdir(os.path.dirname(path))
        except OSError:
            return path
        meant = [one for one in names if one.decode("utf-8", "replace") == os.path.basename(name)]
        return os.path.join(os.path.dirname(path), meant[0]) if len(meant) == 1 else path

    def state_of(self, name):
        """Size and time of a file that it names, as a list; None if it is not there."""
        try:
            status = os.stat(self.path_of(name))
        except (OSError, ValueError):
            return None
        return [status.st_size, status.st_mtime_ns]

    def note_needs(self, names):
        """What it named when it was read."""
        self.needs = {name: UNKNOWN if self.may_have_changed(name) else self.state_of(name) for name in names}

    def may_have_changed(self, name):
        """Since the look at the mesh."""
        try:
            return os.stat(self.path_of(name)).st_ctime_ns >= self.looked_at - CLOCK_STEP_NS
        except (OSError, ValueError):
            return "\ufffd" in name  # several may be meant

    def missing(self):
        """Names of files that were not there."""
        return sorted(name for name, state in self.needs.items() if state is None)

    def row(self, code, error, report=None):
        """For the summary, as if nothing was written; what is not known is None."""
        row = dict.fromkeys(ROW)
        row.update({name: value_of(report, "certificate", name) for name in GUARANTEES})
        row.update(path=text(self.name), exit_code=code, error=error, bytes_in=self.size,
                   triangles_in=value_of(report, "clean", "triangles_in"), warnings=warnings_of(report))
        return row
