# SPDX-License-Identifier: MIT
"""What triangles carry besides their corners: a dict of arrays."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np

from . import _core
from .errors import UsageError


class Attributes(dict):  # type: ignore[type-arg]
    """A dict of arrays; see :func:`meshrepair.read` for its keys and their shapes.

    It also keeps what arrays do not say (how materials look, pictures), and uses it where it goes on: as long as the
    dict is as it came, all of it; where arrays were replaced, what belongs to materials whose names are the same. Arrays
    in it are read-only, so that a change is a new array. ``copy.copy()`` and ``copy.deepcopy()`` copy it all; ``dict()`` and
    ``pickle`` take the arrays alone.
    """

    def __init__(self, arrays: dict[str, Any] | None = None, kept: Any = None) -> None:
        super().__init__(arrays or {})
        self._kept = kept
        self._as_it_came: dict[str, Any] | None = dict(self)
        for array in self.values():
            if hasattr(array, "setflags"):
                array.setflags(write=False)

    def is_as_it_came(self) -> bool:
        same = self._as_it_came
        return self._kept is not None and same is not None and len(same) == len(self) and all(same.get(key) is self[key] for key in self)

    def _copied(self, arrays: dict[str, Any]) -> Attributes:
        copied = Attributes(arrays, self._kept)
        if not self.is_as_it_came():
            copied._as_it_came = None
        return copied

    def __copy__(self) -> Attributes:
        return self._copied(dict(self))

    def __deepcopy__(self, memo: dict[int, Any]) -> Attributes:
        return self._copied({key: copy.deepcopy(value, memo) for key, value in self.items()})

    def __reduce__(self) -> tuple[Any, ...]:
        return (Attributes, (dict(self),))


def for_core(attributes: Any) -> tuple[Any, Any]:
    """The two arguments of the extension: what there is, and what more is known of it."""
    if attributes is None or (isinstance(attributes, dict) and not attributes and not isinstance(attributes, Attributes)):
        return None, None
    if isinstance(attributes, Attributes):
        if attributes.is_as_it_came():
            return attributes._kept, None
        return dict(attributes), attributes._kept
    if isinstance(attributes, _core.KeptAttributes) or not isinstance(attributes, dict):
        raise UsageError(f"attributes: {type(attributes).__name__} is no dict of arrays")
    for key, value in dict.items(attributes):
        if isinstance(value, np.ma.MaskedArray) and np.any(value.mask):
            raise UsageError(f"attributes: {key} has masked elements")
    return attributes, None
