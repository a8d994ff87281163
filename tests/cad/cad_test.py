#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""What meshrepair makes is of use in OpenSCAD and FreeCAD.

Usage: cad_test.py PROGRAMS CLASS

PROGRAMS is the folder of the built programs, CLASS is OpenSCAD or FreeCAD. Ends with 77 where that program is not there.
"""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BROKEN = ROOT / "samples" / "meshes" / "broken_torus_box.stl"
PROGRAMS = pathlib.Path()  # set by main()
NEEDS = {"OpenSCAD": "openscad", "FreeCAD": "freecadcmd"}
SKIPPED = 77
SECONDS = 120


class OpenSCAD(unittest.TestCase):
    def bore(self, mesh: pathlib.Path, out: pathlib.Path) -> int:
        script = out.with_suffix(".scad")
        script.write_text(f'difference() {{ import("{mesh}"); translate([0, 0, -2]) cylinder(r=0.3, h=4, $fn=40); }}', encoding="utf-8")
        subprocess.run(["openscad", "-o", out, script], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=SECONDS, check=False)
        return out.stat().st_size if out.exists() else 0

    def test_a_repaired_mesh_can_be_cut_and_the_broken_one_cannot(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            subprocess.run([PROGRAMS / "meshrepair", "-q", BROKEN, folder / "repaired.stl"], check=True)
            self.assertEqual(self.bore(BROKEN, folder / "of_broken.stl"), 0)
            self.assertGreater(self.bore(folder / "repaired.stl", folder / "of_repaired.stl"), 10_000)
            subprocess.run([PROGRAMS / "meshcheck", "-q", folder / "of_repaired.stl"], check=True)


class FreeCAD(unittest.TestCase):
    def test_the_macro_repairs_what_is_selected(self):
        with tempfile.TemporaryDirectory() as home:
            told = subprocess.run(
                ["freecadcmd", pathlib.Path(__file__).with_name("macro_in_freecad.py")], stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=SECONDS, check=False,
                env={**os.environ, "HOME": home, "MESHREPAIR_FOLDER": str(PROGRAMS), "MESHREPAIR_MESH": str(BROKEN),
                     "MESHREPAIR_MACRO": str(ROOT / "integrations" / "freecad" / "meshrepair.FCMacro")}).stdout.decode()
            lines = [line for line in told.replace("\t", "\n").splitlines() if line and "%" not in line]
            self.assertEqual(lines[-1], "fine", told[-2000:])
            self.assertIn("sheet: all triangles lie in one plane", told)
            self.assertIn("sheet: is not closed", lines)


def main() -> int:
    global PROGRAMS
    if len(sys.argv) != 3 or sys.argv[2] not in NEEDS:
        print(__doc__, file=sys.stderr)
        return 2
    PROGRAMS = pathlib.Path(sys.argv[1]).resolve()
    if shutil.which(NEEDS[sys.argv[2]]) is None:
        print(f"skipped: {NEEDS[sys.argv[2]]} is not there")
        return SKIPPED
    tests = unittest.defaultTestLoader.loadTestsFromTestCase(globals()[sys.argv[2]])
    return 0 if unittest.TextTestRunner(verbosity=2).run(tests).wasSuccessful() else 1


if __name__ == "__main__":
    sys.exit(main())
