# SPDX-License-Identifier: MIT
"""``python -m meshrepair``: the program, in place of this process."""

import os
import sys

from meshrepair.program import program_path

os.execv(program_path(), ["meshrepair", *sys.argv[1:]])
