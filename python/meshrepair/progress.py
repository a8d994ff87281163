# SPDX-License-Identifier: MIT
"""What ``progress=`` takes: a callable, or True for a bar."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from .errors import UsageError

Progress = Callable[[str, float], Any]


class _Line:
    """A line on stderr, where tqdm is not there."""

    def __call__(self, stage: str, share: float) -> None:
        sys.stderr.write(f"\r{stage:<12} {100 * share:3.0f}% ")
        sys.stderr.flush()

    def close(self) -> None:
        sys.stderr.write("\r" + " " * 20 + "\r")
        sys.stderr.flush()


class _Bar:
    """One bar of tqdm, which begins anew with each stage."""

    def __init__(self, tqdm: Any) -> None:
        self._bar = tqdm(total=100, unit="%", leave=False, bar_format="{desc:<12}{percentage:3.0f}%|{bar}| {elapsed}")
        self._stage = ""

    def __call__(self, stage: str, share: float) -> None:
        percent = int(100 * share)
        if (stage, percent) == (self._stage, self._bar.n):
            return
        self._stage, self._bar.n = stage, percent
        self._bar.set_description_str(stage)

    def close(self) -> None:
        self._bar.close()


def _drawn() -> Any:
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return _Line()
    return _Bar(tqdm)


@contextmanager
def observer(progress: Progress | bool | None) -> Iterator[Progress | None]:
    """What the extension is to call, if anything."""
    if progress is None or progress is False:
        yield None
    elif progress is True:
        bar = _drawn()
        try:
            yield bar
        finally:
            bar.close()
    elif callable(progress):
        yield progress
    else:
        raise UsageError(f"progress: {type(progress).__name__} can be neither called nor True")
