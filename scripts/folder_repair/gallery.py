# SPDX-License-Identifier: MIT
"""The gallery of a run: index.html in OUT_DIR, and for each mesh a picture and a page of its own.

They lie in OUT_DIR/index.files, under the name of the input with .png and .html behind it. index.html holds a line for each
file of the summary, and needs no network; gallery/ beside this file is what it is made of.
"""

import base64
import hashlib
import json
import math
import os
import urllib.parse

from .basics import DONE, MEANINGS, key_of, text, value_of

INDEX = b"index.html"
FOLDER = b"index.files"
MARK = b'<meta name="generator" content="meshrepair gallery">'
SIZE = (160, 120)  # of a picture, of one mesh
GAP = 2  # pixels between before and after
PAGE, PICTURE = b".html", b".png"
LONGEST = 240  # bytes of a name, so that there is room for an ending
COLUMNS = ("path", "url", "output", "output_url", "page", "picture", "exit_code", "triangles_in", "triangles_out",
           "bytes_out", "volume_in", "volume_out", "error", "warnings", "seconds", "peak_memory_bytes")
PARTS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "gallery")


def stem_of(job):
    """The name of its page and picture in FOLDER, but for what stands behind it. A name may be as long as names can be."""
    folder, base = os.path.split(job.name)
    if len(base) > LONGEST:
        base = base[:LONGEST - 20] + b"~" + hashlib.sha256(base).hexdigest()[:19].encode()
    return os.path.join(folder, base)


def place_of(job, ending):
    """Where in OUT_DIR it lies: a name."""
    return os.path.join(FOLDER, stem_of(job) + ending)


def is_place(name):
    """The name is one of those that are made here."""
    return os.path.normpath(name) == name and name.startswith(FOLDER + b"/") and name.endswith((PAGE, PICTURE))


def options_for(passed):
    """Of meshrepair, for all files alike. What the user has passed on stays."""
    given = any(option.split("=")[0] == "--picture-size" for option in passed)
    return [] if given else ["--picture-size", f"{SIZE[0]}x{SIZE[1]}"]


def facts_of(report):
    """What the gallery shows of a report and the summary does not: volumes, None where a mesh encloses none."""
    return {"volume_in": volume_of(report, "input"), "volume_out": volume_of(report, "result")}


def volume_of(report, mesh):
    closed, oriented, volume = (value_of(report, "html", mesh, "check", key) for key in ("closed", "oriented", "volume"))
    return volume if closed and oriented and isinstance(volume, (int, float)) and math.isfinite(volume) else None


def row_of(job, row, entry):
    shown = entry.shown if entry else {}
    facts = {"volume_in": None, "volume_out": None, **(entry.facts if entry else {})}
    url = urllib.parse.quote(stem_of(job))
    output_url = urllib.parse.quote(job.output)
    more = {"url": None if url == row["path"] else url,
            "output_url": None if row["output"] is None or output_url == row["output"] else output_url,
            "page": int(key_of(place_of(job, PAGE)) in shown),
            "picture": int(key_of(place_of(job, PICTURE)) in shown)}
    values = {**row, **facts, **more}
    return [values[name] for name in COLUMNS]


def about(settings, totals):
    files, done = totals["files"], totals["by_exit_code"].get(str(DONE), 0)
    text_of_options = " ".join(settings[3:])
    missing = f", {totals['not_done']:,} not done" if totals["not_done"] else ""
    return (f"{done:,} of {files:,} repaired and certified{missing}. {totals['triangles_in']:,} triangles in, "
            f"{totals['triangles_out']:,} out. {settings[0]}{', ' + text_of_options if text_of_options else ''}.")


def escaped(value):
    """JSON that can stand in a page: nothing in it ends the element."""
    string = json.dumps(value, separators=(",", ":"))
    return string.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def hash_of(string):
    return "'sha256-" + base64.b64encode(hashlib.sha256(string.encode()).digest()).decode() + "'"


def part(name):
    with open(os.path.join(PARTS, name), encoding="utf-8") as file:
        return file.read()


def as_html(rows, settings, totals):
    """The page; `rows` as row_of() makes them."""
    page, style, script = part("gallery.html"), part("gallery.css"), part("gallery.js")
    policy = (f"default-src 'none'; script-src {hash_of(chr(10) + script)}; style-src {hash_of(chr(10) + style)}; "
              "img-src 'self' file:; base-uri 'none'; form-action 'none'")
    facts = {"about": about(settings, totals), "folder": text(FOLDER), "picture": [2 * SIZE[0] + GAP, SIZE[1]],
             "meanings": {str(code): meaning for code, meaning in MEANINGS.items()}, "columns": COLUMNS, "rows": rows}
    parts = {"POLICY": policy, "STYLE": style, "SCRIPT": script, "FACTS": escaped(facts)}
    pieces = page.split("@")
    return "".join(parts.get(piece, piece) for piece in pieces).encode()


def is_gallery(path):
    """A file of that name was made here."""
    try:
        with open(path, "rb") as file:
            return MARK in file.read(4096)
    except OSError:
        return False
