# SPDX-License-Identifier: MIT
"""Where the program of the package is."""

import os


def program_path() -> str:
    """The program ``meshrepair`` that belongs to this package."""
    return os.path.join(os.path.dirname(os.path.abspath(__file__)), "bin", "meshrepair")
