#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes hard inputs of which the meaning is known: what a repair should give is written beside each.

NAME.off is the broken mesh, NAME_true.off the solid that was meant (of sheets there is none), and NAME.json the truth:
family, shape, volume, genus, parts; of sheets their area and the thickness to use; and in `options` what to tell meshrepair.

This file is the command line; the families are in hard_inputs, one file for each.
"""

import os
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.pycache_prefix = os.devnull

from hard_inputs import walls  # noqa: E402
from hard_inputs.assemblies import MAKERS as ASSEMBLIES, assembly_case  # noqa: E402
from hard_inputs.cars import car_case  # noqa: E402
from hard_inputs.command_line import add_seed, make_parser  # noqa: E402
from hard_inputs.hollows import MAKERS as HOLLOWS, hollow_case  # noqa: E402
from hard_inputs.layers import SHAPES as LAYERED, WAYS, layers_case  # noqa: E402
from hard_inputs.openings import FLANGES, HUBS, LIMBS, VESSELS, flange_case, hub_case, limb_case, vessel_case  # noqa: E402
from hard_inputs.patches import SHAPES as PATCHES, patches_case  # noqa: E402
from hard_inputs.scenes import BODIES, PLACES, scene_case  # noqa: E402
from hard_inputs.sheets import GARMENTS, cards_case, garment_case  # noqa: E402
from hard_inputs.soups import SHAPES as SOUPS, soup_case  # noqa: E402
from hard_inputs.trays import tray_case  # noqa: E402

import numpy as np  # noqa: E402

EPILOG = """examples:
  make_hard_inputs.py all /tmp/hard --count 500
  make_hard_inputs.py walls /tmp/walls --shape ball --holes 10 --size 0.5
  make_hard_inputs.py soups /tmp/soups --shape knot --noise 0.01 --count 20
  make_hard_inputs.py garments /tmp/garments --count 4 --seed 7
  make_hard_inputs.py vessels /tmp/vessels

The same options make the same files. Exit codes: 0 fine, 2 wrong usage, 6 a file cannot be written.
"""

# Family: its function of a number and a source of chance, and what its options are called there.
FAMILIES = {"walls": (walls.walls_case, ("shape", "holes", "size")), "soups": (soup_case, ("shape", "noise")),
            "patches": (patches_case, ("shape",)), "cards": (cards_case, ("cards",)),
            "garments": (garment_case, ("shape",)), "cars": (car_case, ("panels",)),
            "layers": (layers_case, ("shape", "way")), "scenes": (scene_case, ("shape", "place")),
            "trays": (tray_case, ("heights",)), "hollows": (hollow_case, ("kind",)),
            "rims": (vessel_case, ("shape",)), "flanges": (flange_case, ("shape",)), "limbs": (limb_case, ("shape",)),
            "hubs": (hub_case, ("shape",)), "assemblies": (assembly_case, ("kind", "noise"))}


def case_of(family, number, seed=0, **options):
    """The same for the same arguments, whatever was made before."""
    chance = np.random.default_rng([seed, number, *family.encode()])
    return FAMILIES[family][0](number, chance, **options)


def names_of(families, count):
    """Families in turn."""
    return [(families[i % len(families)], i // len(families)) for i in range(count)]


def write_cases(folder, names, seed, options):
    folder.mkdir(parents=True, exist_ok=True)
    for family, number in names:
        name = f"{family}_{number:04}"
        case = case_of(family, number, seed, **options)
        case.write(folder, name)
        print(f"{name}: {len(case.broken.triangles)} triangles, {case.truth['shape']}")


def write_vessels(folder):
    folder.mkdir(parents=True, exist_ok=True)
    for name in walls.VESSELS:
        walls.vessel(name).write(folder, name)
        print(name)


def add_family(commands, name, text, count=10):
    command = commands.add_parser(name, help=text, description=text)
    command.add_argument("folder", type=Path, metavar="OUT_DIR", help="folder to write into; made if it is not there")
    if count:
        command.add_argument("--count", type=int, default=count, help="how many (default: %(default)s)")
        add_seed(command, "files")
    return command


def parser():
    main = make_parser("make_hard_inputs.py", __doc__, EPILOG)
    commands = main.add_subparsers(dest="family", required=True, metavar="FAMILY")
    add_family(commands, "all", "all families in turn", 500)
    wall = add_family(commands, "walls", "double walls with pinholes")
    wall.add_argument("--shape", choices=walls.SHAPES, help="the body (default: in turn)")
    wall.add_argument("--holes", type=int, help="how many pinholes (default: 1, 10, 100 in turn)")
    wall.add_argument("--size", type=float, help="their diameter in percent of the bounding box's diagonal (default: in turn)")
    soup = add_family(commands, "soups", "unwelded triangles with noise")
    soup.add_argument("--shape", choices=SOUPS, help="the body (default: in turn)")
    soup.add_argument("--noise", type=float, help="how far corners move, in mean edges (default: in turn)")
    patches = add_family(commands, "patches", "patches with other points on either side of each seam")
    patches.add_argument("--shape", choices=PATCHES, help="the body (default: in turn)")
    cards = add_family(commands, "cards", "trees of leaf cards: quads that cross")
    cards.add_argument("--cards", type=int, help="how many bunches (default: by chance)")
    garments = add_family(commands, "garments", "sheets with open rims, folds, sleeves")
    garments.add_argument("--shape", choices=list(GARMENTS), help="the garment (default: in turn)")
    cars = add_family(commands, "cars", "bodies of panels that overlap")
    cars.add_argument("--panels", type=int, help="a side of each of six faces (default: 1, 2, 3 in turn)")
    layers = add_family(commands, "layers", "two-sided bodies and sheets: each face has a copy that faces the other way")
    layers.add_argument("--shape", choices=LAYERED, help="the body (default: in turn)")
    layers.add_argument("--way", choices=WAYS, help="how the copy differs (default: in turn)")
    scenes = add_family(commands, "scenes", "bodies by the ground, an open sheet")
    scenes.add_argument("--shape", choices=BODIES, help="the body (default: in turn)")
    scenes.add_argument("--place", choices=PLACES, help="where it is (default: in turn)")
    trays = add_family(commands, "trays", "open boxes with dividers")
    trays.add_argument("--heights", choices=("even", "lower"), help="of the dividers (default: in turn)")
    assemblies = add_family(commands, "assemblies", "bodies that are to touch, but for noise")
    assemblies.add_argument("--kind", choices=list(ASSEMBLIES), help="of assembly (default: in turn)")
    assemblies.add_argument("--noise", type=float, help="in corners, as a share of the diagonal (default: by chance)")
    hollows = add_family(commands, "hollows", "hollow bodies: by mistake, or on purpose")
    hollows.add_argument("--kind", choices=list(HOLLOWS), help="of body (default: in turn)")
    rims = add_family(commands, "rims", "walls of vessels without the rim between them")
    rims.add_argument("--shape", choices=VESSELS, help="the vessel (default: in turn)")
    flanges = add_family(commands, "flanges", "cups with a flange around the opening")
    flanges.add_argument("--shape", choices=FLANGES, help="the flange (default: in turn)")
    limbs = add_family(commands, "limbs", "limbs that are cut off")
    limbs.add_argument("--shape", choices=LIMBS, help="the cut (default: in turn)")
    hubs = add_family(commands, "hubs", "two-sided rings around a hub")
    hubs.add_argument("--shape", choices=HUBS, help="how often the hub is there (default: in turn)")
    add_family(commands, "vessels", "a bust, a mug, a bottle and a bell, for --seal", 0)
    return main


def main():
    arguments = vars(parser().parse_args())
    family, folder = arguments.pop("family"), arguments.pop("folder")
    if family == "vessels":
        write_vessels(folder)
        return
    count, seed = arguments.pop("count"), arguments.pop("seed")
    if arguments.get("size"):
        arguments["size"] /= 100
    options = {key: value for key, value in arguments.items() if value is not None}
    families = list(FAMILIES) if family == "all" else [family]
    write_cases(folder, names_of(families, count), seed, options)


if __name__ == "__main__":
    try:
        main()
    except ValueError as error:
        print(f"make_hard_inputs.py: {error}", file=sys.stderr)
        sys.exit(2)
    except OSError as error:
        print(f"make_hard_inputs.py: {error}", file=sys.stderr)
        sys.exit(6)
