# SPDX-License-Identifier: MIT
"""The inputs, which the program make_models makes: kinds, sizes, files."""

import dataclasses
import hashlib
import os
import re

from .basics import USAGE, Stop
from .measure import captured

# The program make_models says more of each.
KINDS = ("clean", "holes", "bumpy", "noisy", "cubes", "soup", "union", "cloud")
TRIANGLES_OF_A_CUBE = 12
SMALLEST, LARGEST = 100, 30_000_000
FACTORS = {"": 1, "k": 1000, "m": 1_000_000}


@dataclasses.dataclass(frozen=True)
class Input:
    kind: str
    size: int  # as asked for
    files: tuple[str, ...]
    triangles: int  # points of a cloud
    digest: str  # of the files: rows of history about other inputs are no measure

    def name(self):
        return f"{self.kind} {short_size(self.size)}"


def short_size(size):
    if size % 1_000_000 == 0:
        return f"{size // 1_000_000}M"
    return f"{size // 1000}k" if size % 1000 == 0 else str(size)


def size_of(text):
    """Of "10k" and the like; ValueError where it is none."""
    match = re.fullmatch(r"(\d+(?:\.\d+)?)([kKmM]?)", text.strip())
    size = round(float(match[1]) * FACTORS[match[2].lower()]) if match else 0
    if not SMALLEST <= size <= LARGEST:
        raise ValueError(f"{text} is no size from {SMALLEST} to {LARGEST // 1_000_000}M, as 10k")
    return size


def count_faces(path):
    """What the header of an OFF file promises; None where it is none."""
    with open(path, "rb") as file:
        head = file.read(4096).decode("ascii", "replace")
    words = re.sub(r"#.*", "", head).split()
    if len(words) < 3 or not words[0].endswith("OFF") or not all(re.fullmatch(r"\d+", word) for word in words[1:3]):
        return None
    return int(words[2])


def digest_of(paths):
    """By pieces: what this script takes in memory counts for the programs that it starts."""
    found = hashlib.sha256()
    for path in paths:
        with open(path, "rb") as file:
            while piece := file.read(1 << 20):
                found.update(piece)
    return found.hexdigest()[:12]


def make_input(maker, kind, size, folder, timeout):
    """Writes its files into the folder."""
    count = max(1, size // TRIANGLES_OF_A_CUBE) if kind == "cubes" else size
    done = captured([maker, folder, f"{kind}:{count}"], timeout)
    if done is None:
        raise Stop(USAGE, f"{maker} did not make {kind}:{count} in time")
    code, out, errors = done
    files = tuple(out.split("\n")[:-1])
    if code != 0 or not files or not all(os.path.isfile(file) for file in files):
        reason = (errors.strip().splitlines() or [f"exit code {code}"])[-1]
        raise Stop(USAGE, f"{maker} did not make {kind}:{count}: {reason}")
    triangles = size if kind == "cloud" else sum(count_faces(file) or 0 for file in files)
    return Input(kind, size, files, triangles, digest_of(files))
