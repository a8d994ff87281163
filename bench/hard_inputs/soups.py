# SPDX-License-Identifier: MIT
"""Noisy soups: triangles that share no points, each corner moved by noise. What was meant is the body without it."""

from .bodies import HoledPlate, knot, torus
from .meshes import Case, random_turn, turned, unwelded

SHAPES = ("torus", "knot", "part")
NOISES = (1e-6, 1e-4, 1e-3, 0.01, 0.03)  # in mean edges


def body_of(shape, random):
    if shape == "torus":
        return torus(int(random.integers(40, 120)), int(random.integers(16, 40)))
    if shape == "knot":
        return knot(int(random.integers(120, 300)), int(random.integers(12, 24)))
    if shape == "part":
        return HoledPlate(int(random.integers(1, 4)), int(random.integers(1, 4))).mesh(8 * int(random.integers(2, 6)))
    raise ValueError(f"there is no body {shape}")


def soup_case(number, random, shape=None, noise=None):
    shape = shape or SHAPES[number % 3]
    noise = NOISES[(number // 3) % len(NOISES)] if noise is None else noise
    solid = turned(body_of(shape, random), random_turn(random))
    broken = unwelded(solid)
    broken.points = broken.points + random.uniform(-1, 1, broken.points.shape) * noise * solid.mean_edge()
    return Case(broken, {"family": "soups", "shape": shape, "noise_in_edges": noise, "options": []}, solid)
