# SPDX-License-Identifier: MIT
"""Names in OUT_DIR that are of what is made there for the whole run: no output gets one, nor a folder of outputs."""

from .gallery import INDEX
from .inputs import STATE

SUMMARY_TABLE, SUMMARY = b"summary.csv", b"summary.json"
OWN_NAMES = (STATE, SUMMARY_TABLE, SUMMARY, INDEX)


def own_name_of(place):
    """The one at which a place in OUT_DIR would lie, or None."""
    first = place.split(b"/")[0]
    return first if first in OWN_NAMES else None
