# SPDX-License-Identifier: MIT
"""What all parts of repair_folder.py share: exit codes, the columns of the summary, and how it speaks."""

import os
import signal
import sys

NAME = "repair_folder.py"
FORMAT_OF_EXTENSION = {b".stl": "stl", b".obj": "obj", b".off": "off", b".ply": "ply", b".glb": "glb",
                       b".gltf": "gltf", b".3mf": "3mf"}
EXTENSION_OF_FORMAT = {"obj": b".obj", "stl": b".stl", "stl-ascii": b".stl", "off": b".off",
                       "ply": b".ply", "ply-ascii": b".ply", "glb": b".glb", "gltf": b".gltf", "3mf": b".3mf"}
READS_OTHERS = (b".obj", b".gltf", b".glb")  # their libraries and buffers are read, too
PACKINGS = (b".gz", b".zst")  # that may stand behind these
ARCHIVE = b".zip"
TAR_ENDINGS = (b".tar", b".tgz", b".tbz2", b".txz", b".tzst", b".tar.gz", b".tar.bz2", b".tar.xz", b".tar.zst")
BY_ITSELF = "repair it by itself, as IN_DIR"

GUARANTEES = ("closed", "manifold", "oriented", "no_self_intersections", "no_degenerate_triangles")
SAME_IN_EACH_RUN = ("path", "output", "exit_code", *GUARANTEES, "triangles_in", "triangles_out",
                    "bytes_in", "bytes_out", "error", "warnings")
MEASURED = ("seconds", "peak_memory_bytes")
ROW = SAME_IN_EACH_RUN + MEASURED
FIRST_VERDICT = ROW.index(GUARANTEES[0])
LAST_VERDICT = FIRST_VERDICT + len(GUARANTEES)
VERDICTS = {verdict: verdict for verdict in ("PASS", "FAIL")}  # one text for all rows

# The exit codes of meshrepair; those of repair_folder.py are the first three, OUTPUT and 128 + signal.
DONE, NOT_CERTIFIED, USAGE, INPUT, LIMIT, NO_SOLID, OUTPUT, INTERNAL = 0, 1, 2, 3, 4, 5, 6, 70
KILLED = 128 + signal.SIGKILL
WRITTEN = (DONE, NOT_CERTIFIED)
FINAL = (DONE, NOT_CERTIFIED, INPUT, NO_SOLID)
MEANINGS = {DONE: "repaired and certified", NOT_CERTIFIED: "not certified", USAGE: "wrong usage",
            INPUT: "cannot be read", LIMIT: "a limit was hit", NO_SOLID: "encloses nothing",
            OUTPUT: "the output cannot be written", INTERNAL: "a bug", 130: "interrupted",
            KILLED: "killed", 143: "terminated"}


class Stop(Exception):
    """Ends the script with an exit code and one line."""

    def __init__(self, code, message):
        super().__init__(message)
        self.code = code


def text(name):
    """A name as text. What is no UTF-8 becomes \\xNN, and a backslash before an x \\x5c: no two names have one text."""
    return name.replace(b"\\x", b"\\x5cx").decode("utf-8", "backslashreplace")


def key_of(name):
    """A name in the journal: bytes that are no UTF-8 as lone surrogates, which JSON can hold."""
    return name.decode("utf-8", "surrogateescape")


def bytes_of(key):
    return key.encode("utf-8", "surrogateescape")


def packed(row):
    """A row of the summary in a fifth of the memory: there is one for each file. unpacked() gives it back."""
    values = [row[key] for key in ROW]
    if values[1] == values[0]:  # path and output
        values[1] = values[0]
    values[FIRST_VERDICT:LAST_VERDICT] = [VERDICTS.get(value, value) for value in values[FIRST_VERDICT:LAST_VERDICT]]
    return tuple(values)


def unpacked(values):
    return dict(zip(ROW, values))


def one_line(string):
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode() for c in string)


def print_to(stream, string):
    """A run does not end because nobody listens any more."""
    try:
        stream.write(string)
        stream.flush()
    except OSError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def say(line):
    print_to(sys.stderr, f"{NAME}: {one_line(line)}\n")


def value_of(report, *keys):
    """What stands in a report below these keys; None if nothing does, or no plain value."""
    for key in keys:
        report = report.get(key) if isinstance(report, dict) else None
    return report if isinstance(report, (int, float, str)) else None


def is_certified(report):
    """All guarantees hold, of each mesh of a scene where there are several."""
    meshes = report.get("meshes") if isinstance(report, dict) else None
    if isinstance(meshes, list) and meshes:
        return all(value_of(mesh, "certified") is True for mesh in meshes)
    return all(value_of(report, "certificate", name) == "PASS" for name in GUARANTEES)


def warnings_of(report):
    """The codes of its warnings, each once, those that change the object first; None without any."""
    told = report.get("warnings") if isinstance(report, dict) else None
    told = [one for one in told if isinstance(one, dict)] if isinstance(told, list) else []
    codes = dict.fromkeys(str(one.get("code")) for one in sorted(told, key=lambda one: not one.get("changes_object")))
    return " ".join(codes) or None


def names_of(report, kind):
    """Names of other files that the mesh has, as the report has them: "files", "pictures", "outside"."""
    names = report.get("read") if isinstance(report, dict) else None
    names = names.get("names") if isinstance(names, dict) else None
    names = names.get(kind) if isinstance(names, dict) else None
    return [name for name in names if isinstance(name, str)] if isinstance(names, list) else []
