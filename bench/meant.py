#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Does meshrepair give what was meant? Repairs hard inputs of which that is known (make_hard_inputs.py), and prints tables.

  walls     double walls with pinholes: does --seal fill them, and nothing below its size? Also turned at random
  vessels   a bust, a mug, a bottle, a bell: from which --seal on are they filled?
  soups     noisy soups: genus, parts, triangles and time beside those of the clean mesh
  sheets    leaf cards and garments: is the volume of their walls the area times the thickness?
  others    double walls and noisy soups beside CGAL's alpha wrap and OpenVDB, if they are built
  meant     inputs whose right answers a table says (--rows)
  families  all families: exit codes, and volume against the truth, with defaults and with the options that a family needs
"""

import csv
import io
import os
import re
import sys
import zipfile
from pathlib import Path

sys.dont_write_bytecode = True
sys.pycache_prefix = os.devnull

from hard_inputs import walls  # noqa: E402
from hard_inputs.command_line import add_seed, make_parser  # noqa: E402
from hard_inputs.measure import Runner, keep, missing_triangles, percent, print_table  # noqa: E402
from hard_inputs.meshes import Mesh, random_turn, turned  # noqa: E402
from hard_inputs.soups import NOISES, SHAPES as SOUPS  # noqa: E402
from make_hard_inputs import FAMILIES, case_of, names_of  # noqa: E402

import numpy as np  # noqa: E402

EPILOG = """examples:
  meant.py walls soups
  meant.py families --count 500 --failures /tmp/failed
  meant.py families --family trays --count 300
  meant.py --programs build/dev/bin vessels

Exit codes: 0 fine, 1 something is not as meant, 2 wrong usage.
"""

TOO_FAR = 0.005  # volume of a sealed body from that of the full one, as a share
TOO_FAR_SHEET = 0.05
SHARES = (0.001, 0.005, 0.01, 0.05)
TURNS = 20
# How far the volume of a family may be off: what was meant is known only so well.
LIMITS = {"walls": TOO_FAR, "soups": 0.01, "patches": 0.05, "cards": TOO_FAR_SHEET, "garments": TOO_FAR_SHEET,
          "cars": 0.05, "layers": 0.001, "scenes": 0.001, "trays": 0.03, "hollows": 0.01, "rims": 0.03,
          "flanges": 0.03, "limbs": 0.03, "hubs": 0.03, "assemblies": 0.02}
TOO_FAR_BOX = 0.01  # of the bounding box, as a share of its diagonal


def ids_are_right(package, name):
    """The slicer's list of objects is in a package of 3MF, and each object and part in it is one of the model."""
    try:
        with zipfile.ZipFile(io.BytesIO(package)) as archive:
            models = b"".join(archive.read(one) for one in archive.namelist() if one.endswith(".model"))
            config = archive.read(name)
    except (KeyError, zipfile.BadZipFile):
        return False
    known = set(re.findall(rb'<object id="(\d+)"', models))
    named = set(re.findall(rb'<(?:object|part) id="(\d+)"', config))
    return bool(named) and named <= known


class Tables:
    """Prints tables, and counts what is not as meant."""

    def __init__(self, runner, arguments):
        self.runner = runner
        self.count = arguments.count
        self.seed = arguments.seed
        self.folder = arguments.failures
        self.rows = arguments.rows
        self.names = arguments.family
        self.failures = 0

    def fail(self, case, name, why):
        self.failures += 1
        print(f"NOT AS MEANT: {name}: {why}", flush=True)
        keep(case, self.folder, name)

    def walls(self):
        print("## Double walls with pinholes\n")
        rows = []
        for shape in walls.SHAPES:
            for holes in (1, 10, 100):
                rows += [self.wall_row(shape, holes, share) for share in SHARES]
        head = ["body", "pinholes", "diameter", "--seal 1.5 times: volume off", "triangles lost", "3 times: volume off",
                "triangles lost", "0.5 times: as without"]
        print_table(head, [row for row in rows if row])

    def wall_row(self, shape, holes, share):
        try:
            case = case_of("walls", 0, self.seed, shape=shape, holes=holes, size=share, turn=False)
        except ValueError:
            return None
        row = [shape, holes, percent(share)]
        for factor in (1.5, 3):
            row += self.sealed_cells(case, factor, f"{shape}_{holes}_{100 * share:g}_times_{factor:g}")
        plain = self.runner.repair(case.broken)
        below = self.runner.repair(case.broken, ["--seal", repr(0.5 * case.truth["hole_diameter"])])
        if plain.data != below.data:
            self.fail(case, f"{shape}_{holes}_{100 * share:g}_below", below.error() or "something was sealed")
        return row + ["yes" if plain.data == below.data else "NO"]

    def sealed_cells(self, case, factor, name):
        size = factor * case.truth["hole_diameter"]
        if size > case.truth.get("widest_seal", size):
            return ["-", "-"]
        outcome = self.runner.repair(case.broken, ["--seal", repr(size)])
        off = outcome.off_by(case.truth["volume"])
        if off is None:
            self.fail(case, name, f"exit code {outcome.code}: {outcome.error()}")
            return [f"exit code {outcome.code}", "-"]
        outer = Mesh(case.broken.points, case.broken.triangles[:case.truth["wall_triangles"]])
        lost = missing_triangles(outcome.mesh, outer)
        if outcome.code != 0 or abs(off) > TOO_FAR or lost > 0:
            seal = outcome.seal()
            self.fail(case, name, f"exit code {outcome.code}, volume {percent(off)} off, {lost} triangles lost, "
                                  f"{seal.get('openings')} openings, {seal.get('leaks')} leaks, step {seal.get('step')}")
        return [percent(off), lost]

    def turns(self):
        print(f"## The same bodies, in {TURNS} random turns\n")
        chance = np.random.default_rng(self.seed)
        rows = []
        for shape in walls.SHAPES:
            for share in SHARES[:3]:
                case = case_of("walls", 0, self.seed, shape=shape, holes=10, size=share, turn=False)
                turns = [random_turn(chance) for _ in range(TURNS)]
                row = [shape, percent(share)]
                for factor in (0.5, 1.5, 3):
                    row.append(self.turned_cell(case, factor, turns, f"{shape}_{100 * share:g}_turned_{factor:g}"))
                rows.append(row)
        print_table(["body", "diameter of 10 pinholes", "closed at 0.5 times", "1.5 times", "3 times"], rows)

    def turned_cell(self, case, factor, turns, name):
        size = factor * case.truth["hole_diameter"]
        if size > case.truth.get("widest_seal", size):
            return "-"
        meant = 0 if factor < 1 else case.truth["volume"]

        def is_closed(turn):
            outcome = self.runner.repair(turned(case.broken, turn), ["--seal", repr(size)])
            off = outcome.off_by(meant) if meant else None
            return abs(off) < TOO_FAR if off is not None else outcome.seal().get("openings", 0) > 0 or outcome.code != 0
        closed = sum(self.runner.map(is_closed, turns))
        if closed != (len(turns) if meant else 0):
            self.fail(case, name, f"closed in {closed} of {len(turns)} turns")
        return f"{closed} of {len(turns)}"

    def vessels(self):
        print("## Vessels: what share of the hollow is filled, by the size of the ball\n")
        factors = (0.25, 0.5, 0.75, 0.9, 1.0, 1.1, 1.25, 1.5, 2)
        rows = []
        for name in walls.VESSELS:
            case = walls.vessel(name)
            hollow = case.truth["volume"] - case.truth["own_volume"]
            row = [name, percent(case.truth["mouth"] / case.truth["size"])]
            for factor in factors:
                outcome = self.runner.repair(case.broken, ["--seal", repr(factor * case.truth["mouth"])])
                filled = None if outcome.volume() is None else (outcome.volume() - case.truth["own_volume"]) / hollow
                row.append(f"exit code {outcome.code}" if filled is None else f"{100 * filled:.0f} %")
                if outcome.code != 0 or not self.fits(factor * case.truth["mouth"], case, filled):
                    self.fail(case, f"{name}_{factor:g}", outcome.error() or f"{row[-1]} filled")
            rows.append(row)
        print_table(["body", "mouth"] + [f"{f:g} mouths" for f in factors], rows)

    @staticmethod
    def fits(size, case, filled):
        """Nothing may be filled for a ball that comes to all of it, most for one that is far too large to come in."""
        if size < 0.9 * case.truth["passes"]:
            return abs(filled) < 0.01
        return filled > 0.5 or size < 1.5 * case.truth["mouth"]

    def soups(self):
        print("## Noisy soups\n")
        rows = []
        for shape in SOUPS:
            for noise in NOISES:
                case = case_of("soups", 0, self.seed, shape=shape, noise=noise)
                clean = self.runner.repair(case.solid, ["--always"])
                outcome = self.runner.repair(case.broken)
                off = outcome.off_by(case.truth["volume"])
                row = [shape, f"{noise:g}", outcome.code, percent(off)]
                if outcome.mesh is not None:
                    genus = outcome.mesh.genus() if outcome.mesh.is_closed() else None
                    parts = outcome.mesh.parts()
                    row += [f"{genus} / {case.truth['genus']}", f"{parts} / {case.truth['parts']}",
                            f"{len(outcome.mesh.triangles)} / {len(case.solid.triangles)}",
                            f"{outcome.seconds:.2f} / {clean.seconds:.2f}"]
                    if outcome.code or genus != case.truth["genus"] or parts != case.truth["parts"] or abs(off) > 0.01:
                        self.fail(case, f"soup_{shape}_{noise:g}", f"exit code {outcome.code}, genus {genus}, parts {parts}")
                else:
                    self.fail(case, f"soup_{shape}_{noise:g}", f"exit code {outcome.code}: {outcome.error()}")
                rows.append(row)
        print("Of the result / of what was meant; seconds of one thread / of the clean mesh with --always.\n")
        print_table(["body", "noise, in edges", "exit code", "volume off", "genus", "parts", "triangles", "seconds"], rows)

    def others(self):
        print("## Beside tools that wrap or remesh\n")
        cases = [(f"{shape}, {holes} pinholes of 1 %", case_of("walls", 0, self.seed, shape=shape, holes=holes, size=0.01, turn=False))
                 for shape in ("ball", "box") for holes in (1, 10)]
        cases += [(f"soup of a {shape}, noise {noise:g}", case_of("soups", 0, self.seed, shape=shape, noise=noise))
                  for shape in SOUPS for noise in NOISES[-2:]]
        rows = []
        for name, case in cases:
            for tool in TOOLS:
                found = self.runner.beside(case, tool)
                if found:
                    rows.append([name, tool[0], *found])
        print("Distance of the result from the solid that was meant and back, as a share of the diagonal.\n")
        print_table(["mesh", "tool", "valid solid", "volume off", "largest distance", "triangles", "seconds"], rows)

    def sheets(self):
        count = self.count or 200
        print(f"## {count} sheets with --thicken\n")
        self.families_table(names_of(["cards", "garments"], count), with_defaults=False)

    def families(self):
        count = self.count or 60
        print(f"## {count} files of all families\n")
        self.families_table(names_of(self.names or list(FAMILIES), count), with_defaults=True)

    def meant(self):
        """Each row of the table that has a number, an exit code or a warning for its answer."""
        if self.rows is None:
            return  # of all tables, those that need a file are left out
        print(f"## {self.rows.name}\n")
        table = []
        with open(self.rows, encoding="utf-8", newline="") as file:
            for row in csv.DictReader(file):
                found = self.answer(row)
                is_right = None if found is None else self.is_right(row, found)
                if is_right is False:
                    self.failures += 1
                table.append([row["input"], row["what"], row["right"], "-" if found is None else found,
                              {None: "not judged", True: "yes", False: "NO"}[is_right]])
        print_table(["input", "what", "right", "found", "as meant"], table)

    def answer(self, row):
        words = row["command"].split()
        outcome = self.runner.told(words, [self.rows.parent / "inputs" / name for name in row["input"].split()])
        result = outcome.report.get("result") or {}
        if row["what"] == "exit code":
            return outcome.code
        if row["what"].startswith("warning"):
            return "there" if "warning:" in outcome.said else "none"
        if row["what"].startswith("groups "):
            named = {line.split()[1] for line in outcome.data.decode("utf-8", "replace").splitlines() if line.startswith(("g ", "o "))}
            return "there" if set(row["what"].split()[1:]) <= named else f"only {', '.join(sorted(named))}"
        if row["what"].startswith("Metadata/"):
            return row["right"] if ids_are_right(outcome.data, row["what"]) else "not there, or wrong"
        if "not printed" in row["what"]:
            return row["right"] if "W-OBJECTS-LEFT-OUT" in outcome.said else "not named"
        if row["what"] == "voids filled":
            return (outcome.report.get("inside") or {}).get("filled_voids", 0)
        if row["what"] == "genus" and result.get("parts"):
            return result["parts"] - (result["points"] - result["triangles"] // 2) // 2
        return result.get(row["what"], f"exit code {outcome.code}") if row["what"] in ("volume", "area", "parts") else None

    @staticmethod
    def is_right(row, found):
        if row["right"].startswith("there") or isinstance(found, str):
            return row["right"] == found
        wanted, share = number_in(row["right"]), (number_in(row["tolerance"]) or 0) / 100
        return abs(found - wanted) <= share * abs(wanted)

    def families_table(self, names, with_defaults):
        def outcomes(name):
            case = case_of(*name, self.seed)
            plain = self.runner.repair(case.broken) if with_defaults else None
            needs = case.truth["options"]
            return plain, self.runner.repair(case.broken, needs) if needs or not with_defaults else plain
        found = self.runner.map(outcomes, names)
        rows = []
        for family in dict.fromkeys(family for family, _ in names):
            mine = [(name, *pair) for name, pair in zip(names, found) if name[0] == family]
            if with_defaults:
                rows.append([family, "defaults", *self.family_cells([(name, plain) for name, plain, _ in mine], None)])
            rows.append([family, "as needed", *self.family_cells([(name, told) for name, _, told in mine], family)])
        print_table(["family", "options", "files", "exit codes", "volume off: median", "worst", "beyond the limit"], rows)

    @staticmethod
    def is_other(case, outcome):
        """Of assemblies all is known: whether the area, the parts or the genus are others."""
        if case.truth["family"] != "assemblies":
            return False
        mesh, truth = outcome.mesh, case.truth
        return (abs(mesh.area() / truth["area"] - 1) > LIMITS["assemblies"] or mesh.parts() != truth["parts"]
                or mesh.genus() != truth["genus"])

    def family_cells(self, outcomes, family):
        """Failures are told where a family has the options that it needs."""
        codes, offs, beyond = {}, [], 0
        for name, outcome in outcomes:
            case = case_of(*name, self.seed)
            codes[outcome.code] = codes.get(outcome.code, 0) + 1
            wanted = case.truth.get("code", 0)
            off = outcome.off_by(case.truth["volume"])
            if off is not None:
                offs.append(abs(off))
            box = box_off(outcome.mesh, case.solid) if off is not None and "box" in case.truth else 0.0
            is_far = wanted == 0 and (off is None or abs(off) > LIMITS[name[0]] or box > TOO_FAR_BOX
                                      or self.is_other(case, outcome))
            beyond += is_far
            if family and (is_far or outcome.code != wanted):
                self.fail(case, "%s_%04d" % name, f"{case.truth['shape']}: exit code {outcome.code}, volume {percent(off)} "
                                                  f"off, box {percent(box)}{': ' if outcome.error() else ''}{outcome.error()}")
        text = ", ".join(f"{code}: {number}" for code, number in sorted(codes.items()))
        middle = percent(float(np.median(offs))) if offs else "-"
        return [len(outcomes), text, middle, percent(max(offs)) if offs else "-", beyond]


def box_off(mesh, wanted):
    ends = [np.stack([points.min(axis=0), points.max(axis=0)]) for points in (m.corners().reshape(-1, 3) for m in (mesh, wanted))]
    return float(np.abs(ends[0] - ends[1]).max()) / wanted.diagonal()


def number_in(text):
    found = re.search(r"-?[0-9][0-9.]*", text)
    return float(found.group()) if found else None


TABLES = ("walls", "turns", "vessels", "soups", "sheets", "others", "meant", "families")
# A method of wrap_others, and the share of the diagonal that it is given.
TOOLS = (("meshrepair", None, None), ("alpha wrap 1/50", "alpha", 1 / 50), ("alpha wrap 1/200", "alpha", 1 / 200),
         ("OpenVDB 1/200", "openvdb", 1 / 200))


def main():
    parser = make_parser("meant.py", __doc__, EPILOG)
    parser.add_argument("tables", nargs="*", metavar="TABLE", help=f"{', '.join(TABLES)} (default: all)")
    parser.add_argument("--programs", type=Path, default=Path(__file__).resolve().parent.parent / "build/release/bin",
                        help="folder of the programs (default: build/release/bin)")
    parser.add_argument("--rows", type=Path, metavar="FILE", help="the table of meant, its inputs beside it in inputs/")
    parser.add_argument("--count", type=int, help="how many sheets (default: 200), files of all families (default: 60)")
    parser.add_argument("--family", action="append", choices=list(FAMILIES), help="of the table families this one; may be repeated")
    add_seed(parser, "inputs")
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time, where no time is told (default: %(default)s)")
    parser.add_argument("--failures", type=Path, metavar="FOLDER", help="keep what is not as meant, with its truth")
    arguments = parser.parse_args()
    unknown = set(arguments.tables) - set(TABLES)
    if unknown:
        parser.error(f"there is no table {', '.join(sorted(unknown))}")
    if "meant" in arguments.tables and arguments.rows is None:
        parser.error("the table meant needs --rows FILE")
    if not (arguments.programs / "meshrepair").exists():
        parser.error(f"{arguments.programs}: has no meshrepair")
    tables = Tables(Runner(arguments.programs, jobs=arguments.jobs), arguments)
    for name in arguments.tables or TABLES:
        getattr(tables, name)()
    print(f"{tables.failures} not as meant")
    return 1 if tables.failures else 0


if __name__ == "__main__":
    sys.exit(main())
