# SPDX-License-Identifier: MIT
"""The exceptions of the package: one family, a class for each exit code of the programs."""

from __future__ import annotations

from typing import Any


class Error(Exception):
    """Base of all. ``str(error)`` is one line.

    Attributes:
        exit_code: what the program would have ended with.
        report: the report as far as the work came, or None where it was not begun.
    """

    exit_code = 70

    def __init__(self, message: str, report: dict[str, Any] | None = None) -> None:
        super().__init__(message)
        self.report = report


class NotCertifiedError(Error):
    """``strict=True``, and not every guarantee could be shown."""

    exit_code = 1


class UsageError(Error, ValueError):
    """An argument or option is invalid: nothing was done."""

    exit_code = 2


class InputError(Error):
    """A file or mesh cannot be read."""

    exit_code = 3


class LimitError(Error):
    """A limit on time, memory or size was reached."""

    exit_code = 4


class NoSolidError(Error):
    """The input was read, but encloses nothing."""

    exit_code = 5


class OutputError(Error):
    """The output cannot be written."""

    exit_code = 6


class InternalError(Error):
    """A bug of meshrepair."""

    exit_code = 70


class CancelledError(Error):
    """The work was stopped from outside."""

    exit_code = 130


_CLASSES = {kind.exit_code: kind for kind in (NotCertifiedError, UsageError, InputError, LimitError, NoSolidError,
                                              OutputError, InternalError, CancelledError)}


def error_of(code: int, message: str, report: dict[str, Any] | None = None) -> Error:
    """The exception that stands for an exit code other than 0."""
    return _CLASSES.get(code, InternalError)(message, report)
