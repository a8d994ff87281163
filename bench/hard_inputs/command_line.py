# SPDX-License-Identifier: MIT
"""What the command lines of the programs on hard inputs have in common."""

import argparse


def make_parser(program, text, epilog):
    """Help shows both texts as they are."""
    return argparse.ArgumentParser(prog=program, description=text, epilog=epilog,
                                   formatter_class=argparse.RawDescriptionHelpFormatter)


def add_seed(parser, made):
    parser.add_argument("--seed", type=int, default=0, help=f"other seeds make other {made} (default: %(default)s)")
