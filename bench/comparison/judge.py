# SPDX-License-Identifier: MIT
"""Whether a result is the boundary of a solid, as a checker says."""

import json

from .measure import captured

YES, NO, NO_RESULT, UNJUDGED = "yes", "no", "no result", "?"
ONE_MESH = ("clean", "holes", "bumpy", "noisy", "cubes", "soup")  # whose input the result can be held against


class Judge:
    """A program like "judge OUT --against IN", which prints JSON; without one, our own meshcheck."""

    def __init__(self, program, meshcheck, timeout):
        self.program, self.meshcheck, self.timeout = program, meshcheck, timeout

    def name(self):
        return self.program or "meshcheck"

    def command(self, item, out):
        if not self.program:
            return [self.meshcheck, out, "--json", "--quiet"]
        return [self.program, out, *(["--against", item.files[0]] if item.kind in ONE_MESH else [])]

    def accepted(self, said):
        if self.program:
            return said.get("is_clean") is True and said.get("outward_oriented") is True
        check = said.get("check")
        return isinstance(check, dict) and check.get("valid_solid") is True

    def verdict(self, item, out):
        done = captured(self.command(item, out), self.timeout)
        try:
            said = json.loads(done[1] if done else "")
        except ValueError:
            return UNJUDGED
        return YES if isinstance(said, dict) and self.accepted(said) else NO
