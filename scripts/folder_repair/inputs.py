"""What there is to do: the mesh files of a folder, and the names of their outputs."""

import collections
import errno
import os
import stat

from .basics import (EXTENSION_OF_FORMAT, FORMAT_OF_EXTENSION, GUARANTEES, MEASURED, SAME_IN_EACH_RUN,
                     text, value_of)

STATE = b".repair_folder"  # of a run, in its OUT_DIR; folders of this name are no input


def identity(path):
    status = os.stat(path)
    return status.st_dev, status.st_ino


def kind_of(entry, out_identity):
    """"mesh", "folder", why it is left out, or None for what is not meant."""
    try:
        if entry.is_dir(follow_symlinks=False):
            is_own = entry.name == STATE or identity(entry.path) == out_identity
            return None if is_own else "folder"
        if entry.is_symlink() and entry.is_dir():
            return "is a link to a folder"
    except OSError:
        pass  # a loop of links, or gone: said when it is opened, if the name is that of a mesh
    if os.path.splitext(entry.name)[1].lower() not in FORMAT_OF_EXTENSION:
        return None
    try:
        return "mesh" if stat.S_ISREG(entry.stat().st_mode) else "is no regular file"
    except OSError:
        return "mesh"


def find_meshes(folder, out_folder, stopped):
    """The names of mesh files, relative to the folder and sorted, and what was left out: name -> why. The
    name of a folder that cannot be read ends with a slash."""
    meshes, left_out, waiting, out_identity = [], {}, [b""], identity(out_folder)
    while waiting and not stopped():
        current = waiting.pop()
        try:
            with os.scandir(os.path.join(folder, current)) as entries:
                for entry in entries:
                    name, kind = os.path.join(current, entry.name), kind_of(entry, out_identity)
                    if kind == "mesh":
                        meshes.append(name)
                    elif kind == "folder":
                        waiting.append(name)
                    elif kind:
                        left_out[name] = kind
        except OSError as error:
            left_out[(current or b".") + b"/"] = f"cannot be read: {error.strerror}"
    return sorted(meshes), left_out


def folders_of(names):
    found = set()
    for name in names:
        while name := os.path.dirname(name):
            found.add(name)
    return found


def name_outputs(names, output_format):
    """Input -> output. Inputs that would get one name keep their extensions: a.stl.obj, a.off.obj."""
    if not output_format:
        return {name: name for name in names}
    extension, folders, whole = EXTENSION_OF_FORMAT[output_format], folders_of(names), set()
    while True:
        outputs = {name: (name if name in whole else os.path.splitext(name)[0]) + extension
                   for name in names}
        users = collections.Counter(outputs.values())
        clashing = {name for name, output in outputs.items()
                    if name not in whole and (users[output] > 1 or output in folders)}
        if not clashing:  # whole names differ, so this comes to an end
            return outputs
        whole |= clashing


class Job:
    """One file to repair."""

    def __init__(self, name, output, options):
        self.name = name
        self.source = os.path.join(options.in_dir, name)
        self.output = output
        self.target = os.path.join(options.out_dir, output)
        self.format = options.format or FORMAT_OF_EXTENSION[os.path.splitext(name)[1].lower()]
        self.size = self.mtime_ns = None
        self.trials = 0

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

    def row(self, code, error, report=None):
        """For the summary, as if nothing was written; what is not known is None."""
        row = dict.fromkeys(SAME_IN_EACH_RUN + MEASURED)
        row.update({name: value_of(report, "certificate", name) for name in GUARANTEES})
        row.update(path=text(self.name), exit_code=code, error=error, bytes_in=self.size,
                   triangles_in=value_of(report, "clean", "triangles_in"))
        return row
