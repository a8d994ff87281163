# SPDX-License-Identifier: MIT
"""Names of other files in a mesh, found without its reader: what has to be unpacked beside it.

They may be too many, never mind: only those count that there are. What is missed is told by the report of meshrepair, once
the mesh was read.
"""

import gzip
import json
import re
import shutil
import struct
import subprocess
import urllib.parse

from .inputs import split_name

LIBRARY = b".mtl"
NAME_OTHERS = (b".obj", b".ply", b".gltf", b".glb", LIBRARY)
BLOCK = 1 << 20
LONGEST_LINE = 1 << 16  # what is longer names nothing
LONGEST_HEADER = 1 << 16  # of PLY
LONGEST_JSON = 1 << 28
MOST_WORDS = 64  # in a line
MOST_NAMES = 10000

LIBRARIES = re.compile(rb"^[ \t]*mtllib[ \t]+([^\r\n]+)", re.MULTILINE | re.IGNORECASE)
PICTURES = re.compile(rb"^[ \t]*(?:map_\w+|bump|disp|decal|refl|norm)[ \t]+([^\r\n]+)", re.MULTILINE | re.IGNORECASE)
TEXTURES = re.compile(rb"^comment[ \t]+texturefile[ \t]+([^\r\n]+)", re.MULTILINE | re.IGNORECASE)


def may_name_others(name):
    return split_name(name)[1] in NAME_OTHERS


def opened(path, packing):
    """A file of what is packed, or None."""
    if packing.lower() == b".gz":
        return gzip.open(path)
    if packing.lower() == b".zst":
        return opened_zstd(path)
    return open(path, "rb")


def opened_zstd(path):
    """By the library of Python 3.14, else by the program zstd; None if neither is there."""
    try:
        from compression import zstd  # pylint: disable=import-outside-toplevel
        return zstd.open(path)
    except ImportError:
        pass
    program = shutil.which("zstd")
    return PipeOfProgram([program, "-q", "-d", "-c", "--memory=2048MB"], path) if program else None


class PipeOfProgram:
    """What a program makes of a file, as a file. That it has failed is said at the end of it."""

    def __init__(self, command, path):
        with open(path, "rb") as file:
            self.process = subprocess.Popen(command, stdin=file, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, start_new_session=True)

    def read(self, size):
        return self.checked(self.process.stdout.read(size))

    def read1(self, size):
        return self.checked(self.process.stdout.read1(size))

    def checked(self, data):
        if not data and self.process.wait() != 0:
            raise EOFError("it is broken or cut off")
        return data

    def close(self):
        self.process.stdout.close()
        self.process.kill()
        self.process.wait()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def words_of(line):
    """A name may hold blanks, and options may stand before it: all that it could be."""
    whole = line.strip()
    starts = [match.start() for match in re.finditer(rb"\S+", whole)][:MOST_WORDS]
    return {whole[start:] for start in starts} | set(whole.split()[:MOST_WORDS])


def lines_with(file, mark, pattern):
    """Yields sets of names, an empty one for each block in which there are none."""
    tail = b""
    while block := file.read(BLOCK):
        block = tail + block
        end = block.rfind(b"\n") + 1
        tail = block[end:][-LONGEST_LINE:]
        yield names_by(block[:end], mark, pattern)
    yield names_by(tail, mark, pattern)


def names_by(text, mark, pattern):
    if mark and mark not in text.lower():
        return set()
    return set().union(*(words_of(match[1]) for match in pattern.finditer(text)))


def uris_in(data):
    """Of the JSON of a glTF."""
    scene = json.loads(data)
    uris = [thing.get("uri") for kind in ("buffers", "images") for thing in scene.get(kind, [])]
    return {urllib.parse.unquote_to_bytes(uri) for uri in uris if isinstance(uri, str) and not uri.startswith("data:")}


def json_of_glb(file):
    head = file.read(20)
    length = struct.unpack("<I", head[12:16])[0]
    return file.read(min(length, LONGEST_JSON))


def found_in(file, extension):
    if extension == b".obj":
        yield from lines_with(file, b"mtllib", LIBRARIES)
    elif extension == LIBRARY:
        yield from lines_with(file, None, PICTURES)
    elif extension == b".ply":
        yield names_by(file.read(LONGEST_HEADER).split(b"end_header")[0], None, TEXTURES)
    elif extension == b".gltf":
        yield uris_in(file.read(LONGEST_JSON))
    elif extension == b".glb":
        yield uris_in(json_of_glb(file))


def names_in(path, name, found):
    """Adds to `found` what the file at this path may name; `name` tells what it is. A generator, for it may take long: it
    does some of the work at each step. What is broken names nothing."""
    _, extension, packing = split_name(name)
    try:
        file = opened(path, packing)
        if file is None:
            return
        with file:
            for names in found_in(file, extension):
                if len(found) < MOST_NAMES:
                    found |= names
                yield
    except Exception:  # pylint: disable=broad-exception-caught  # meshrepair says what is wrong with it
        return
