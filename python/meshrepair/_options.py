# SPDX-License-Identifier: MIT
"""Keywords to what the command line says, and outcomes to exceptions."""

from __future__ import annotations

import json
import numbers
import os
from collections.abc import Mapping
from typing import Any

import numpy as np

from .errors import UsageError, error_of


def _text_of(name: str, value: Any) -> bytes:
    if isinstance(value, (list, tuple, set, frozenset)):
        return b",".join(_text_of(name, one) for one in (sorted(value) if isinstance(value, (set, frozenset)) else value))
    if isinstance(value, (str, bytes, os.PathLike)):
        return os.fsencode(value)
    if isinstance(value, numbers.Integral):
        return str(int(value)).encode()
    if isinstance(value, numbers.Real):
        return repr(float(value)).encode()
    raise UsageError(f"{name}: {type(value).__name__} is no type of an option's value")


def keywords_of(options: Mapping[str, Any]) -> list[tuple[str, bool | bytes]]:
    """Options that are not None. ``for_`` is ``--for``."""
    keywords: list[tuple[str, bool | bytes]] = []
    for name, value in options.items():
        if value is None:
            continue
        try:
            word: bool | bytes = bool(value) if isinstance(value, (bool, np.bool_)) else _text_of(name, value)
            keywords.append((name.rstrip("_"), word))
            name.encode()
        except UsageError:
            raise
        except (ValueError, TypeError, OverflowError) as error:  # a number too long to print, a set of many types
            raise UsageError(f"{name!r}: {error}") from None
    return keywords


def path_of(path: Any, name: str) -> bytes:
    """As the system has it."""
    try:
        found = os.fsencode(path)
    except (TypeError, ValueError):
        raise UsageError(f"{name}: {type(path).__name__} is no path") from None
    if not found or b"\0" in found:
        raise UsageError(f"{name}: is empty, or has a zero in it")
    return found


def raise_unless(outcome: dict[str, Any], *fine: int) -> None:
    """The exception of an outcome whose exit code is not one of these."""
    if outcome["code"] in fine:
        return
    report = json.loads(outcome["report"])
    raise error_of(outcome["code"], outcome["error"] or "failed", report)


def is_true(options: Mapping[str, Any], name: str) -> bool:
    return isinstance(options.get(name), (bool, np.bool_)) and bool(options[name])
