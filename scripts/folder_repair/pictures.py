# SPDX-License-Identifier: MIT
"""Pictures that lie beside meshes: which of them come along, and where to."""

import os

from .basics import FORMAT_OF_EXTENSION, names_of
from .gallery import FOLDER as GALLERY
from .inputs import split_name
from .own_names import own_name_of

NAME_PICTURES = ("obj", "ply", "ply-ascii", "glb", "gltf")  # formats
HOLD_PICTURES = ("3mf",)  # others have none
NO_PICTURES = {b".mtl", *FORMAT_OF_EXTENSION}  # extensions of what is made here


def is_within(path, folder):
    return path.startswith(os.path.join(folder, b""))


def place_of(path, in_dir):
    """Where the file lies in IN_DIR, as programs write names of files: links to folders are followed. None: it
    lies outside of IN_DIR, perhaps behind a link."""
    root = os.path.realpath(in_dir)
    full = os.path.join(os.path.realpath(os.path.dirname(path)), os.path.basename(path))
    if not is_within(full, root) or not is_within(os.path.realpath(full), root):
        return None
    return os.path.relpath(full, root)


def may_be_written(place):
    """It is a place in OUT_DIR, and that of nothing that is made here."""
    if os.path.normpath(place) != place or place.startswith(b"/") or place.split(b"/")[0] in (b".", b".."):
        return False
    is_own = own_name_of(place) or place.split(b"/")[0] == GALLERY
    return not is_own and split_name(place)[1] not in NO_PICTURES


def pictures_of(job, in_dir, report):
    """Of the mesh that a report is of: place -> path of those that are to lie in OUT_DIR, at their place in IN_DIR;
    and names, sorted, of all files that it names outside of IN_DIR, and of pictures whose place is taken."""
    pictures, outside, displaced = {}, set(names_of(report, "outside")), set()
    for name in names_of(report, "files"):
        path = job.path_of(name)
        if os.path.isfile(path) and place_of(path, in_dir) is None:
            outside.add(name)
    for name in names_of(report, "pictures"):
        path = job.path_of(name)
        place = place_of(path, in_dir)
        if place is None:
            outside.add(name)
        elif job.format in NAME_PICTURES and os.path.isfile(path):
            if may_be_written(place):
                pictures[place] = path
            else:
                displaced.add(name)
    return pictures, sorted(outside), sorted(displaced)
