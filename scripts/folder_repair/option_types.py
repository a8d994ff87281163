# SPDX-License-Identifier: MIT
"""What options are read as, by argparse: sizes, seconds, shards."""

import argparse
import re

from .shards import Shard


def size_in_bytes(string):
    """"200M" and the like; K, M, G and T are powers of 1024."""
    match = re.fullmatch(r"(\d+(?:\.\d+)?)([KMGT]?)(?:i?B)?", string.strip(), re.IGNORECASE)
    if not match:
        raise argparse.ArgumentTypeError(f"{string} is not a size like 200M or 2G")
    return int(float(match[1]) * 1024 ** " KMGT".index(match[2].upper() or " "))


def shard(string):
    try:
        return Shard.parse(string)
    except ValueError as error:
        raise argparse.ArgumentTypeError(str(error)) from None


def seconds(string):
    if not re.fullmatch(r"\d+(\.\d*)?|\.\d+", string):
        raise argparse.ArgumentTypeError(f"{string} is not a number of seconds, 0 or more")
    return float(string)
