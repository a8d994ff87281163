# SPDX-License-Identifier: MIT
"""Families of hard inputs of which the meaning is known: see make_hard_inputs.py."""

import os
import sys

try:
    import numpy  # noqa: F401
except ImportError:
    sys.exit(f"{os.path.basename(sys.argv[0])}: python3-numpy is missing: scripts/setup.sh installs it")
