# SPDX-License-Identifier: MIT
"""A share of the files, for one of several runs that work on one OUT_DIR at the same time."""

import hashlib
import os
import re


class Shard:
    """The I-th of N, from 1 on. Which shard a file is in depends on its name alone, so that files that are added
    move no others. Files with one name but for extensions are in one shard: their outputs may need files of one name
    beside them."""

    def __init__(self, number, count):
        self.number, self.count = number, count

    @staticmethod
    def parse(string):
        """"3/8"; ValueError if it is none."""
        match = re.fullmatch(r"0*(\d{1,6})/0*(\d{1,6})", string)
        if not match or not 1 <= int(match[1]) <= int(match[2]):
            raise ValueError(f"{string} is not a shard: I/N, from 1/N to N/N")
        return Shard(int(match[1]), int(match[2]))

    def holds(self, name):
        folder, base = os.path.split(name)
        stem = os.path.join(folder, base.split(b".")[0] or base)
        digest = hashlib.sha256(stem).digest()
        return int.from_bytes(digest[:8], "big") % self.count == self.number - 1

    @property
    def folder(self):
        """Below that of all shards."""
        return b"%d-of-%d" % (self.number, self.count)

    def __str__(self):
        return f"{self.number}/{self.count}"
