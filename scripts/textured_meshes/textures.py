# SPDX-License-Identifier: MIT
"""Pictures made by rules: lists of rows from the top, of (red, green, blue).

Noise is of whole numbers, so that the same comes out everywhere.
"""

import math
import struct
import zlib
from collections.abc import Callable

Colour = tuple[int, int, int]
Picture = list[list[Colour]]


def picture(width: int, height: int, colour: Callable[[float, float], Colour]) -> Picture:
    """Of colour(u, v), both from 0 to 1 and v upwards."""
    return [[colour((x + 0.5) / width, 1 - (y + 0.5) / height) for x in range(width)] for y in range(height)]


def png(pixels: Picture) -> bytes:
    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    data = b"".join(b"\0" + bytes(value for pixel in row for value in pixel) for row in pixels)
    header = struct.pack(">IIBBBBB", len(pixels[0]), len(pixels), 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(data, 9)) + chunk(b"IEND", b"")


def hashed(x: int, y: int, seed: int) -> float:
    """From 0 to 1, without a pattern."""
    value = (x * 374761393 + y * 668265263 + seed * 2147483647) & 0xFFFFFFFF
    for _ in range(2):
        value = ((value ^ (value >> 13)) * 1274126177) & 0xFFFFFFFF
    return (value ^ (value >> 16)) / 0xFFFFFFFF


def noise(x: float, y: float, period: int, seed: int) -> float:
    """Smooth, from 0 to 1, and the same again after `period` to the right."""
    i, j = math.floor(x), math.floor(y)
    s, t = ((3 - 2 * f) * f * f for f in (x - i, y - j))
    a, b = hashed(i % period, j, seed), hashed((i + 1) % period, j, seed)
    c, d = hashed(i % period, j + 1, seed), hashed((i + 1) % period, j + 1, seed)
    return (a + (b - a) * s) * (1 - t) + (c + (d - c) * s) * t


def hills(u: float, v: float, seed: int, cells: int = 4, layers: int = 4) -> float:
    """Noise of several sizes, from 0 to 1; it repeats with u."""
    total = weight = 0.0
    for layer in range(layers):
        size = cells << layer
        total += noise(u * size, v * size, size, seed + layer) / (1 << layer)
        weight += 1 / (1 << layer)
    return total / weight


def steps(value: float, colours: list[tuple[float, Colour]]) -> Colour:
    """The colour of the first limit above the value."""
    return next((colour for limit, colour in colours if value < limit), colours[-1][1])


def globe() -> Picture:
    """Land, sea, ice, and lines of longitude and latitude."""
    def colour(u: float, v: float) -> Colour:
        if min(u * 24 % 1, v * 12 % 1) < 0.05:
            return (40, 66, 98)
        if abs(v - 0.5) > 0.42:
            return (238, 243, 247)
        return steps(hills(u, v * 0.6, 5), [(0.47, (62, 122, 176)), (0.52, (104, 168, 206)), (0.55, (224, 206, 150)),
                                            (0.64, (112, 160, 84)), (1, (150, 126, 92))])
    return picture(512, 256, colour)


def stripes() -> Picture:
    def colour(u: float, v: float) -> Colour:
        return (222, 160, 44) if (u * 8 + v * 4) % 1 < 0.5 else (92, 44, 92)
    return picture(256, 128, colour)


def checks() -> Picture:
    def colour(u: float, v: float) -> Colour:
        return (44, 128, 122) if (int(u * 16) + int(v * 8)) % 2 else (232, 226, 206)
    return picture(256, 128, colour)


def glaze() -> Picture:
    """Bands of a vase: zigzags, dots, and a meander."""
    def colour(u: float, v: float) -> Colour:
        clay, dark, light = (186, 98, 58), (54, 40, 44), (232, 206, 160)
        if min(abs(v - edge) for edge in (0.12, 0.3, 0.7, 0.88)) < 0.012:
            return dark
        if 0.3 < v < 0.7:
            return dark if abs((u * 12) % 1 - 0.5) * 0.6 < (v - 0.3) % 0.2 * 1.5 else light
        if 0.7 < v < 0.88 or 0.12 < v < 0.3:
            return light if ((u * 24) % 1 - 0.5) ** 2 + ((v - 0.03) / 0.09 % 1 - 0.5) ** 2 < 0.09 else clay
        return clay
    return picture(512, 256, colour)


def planks() -> Picture:
    def colour(u: float, v: float) -> Colour:
        plank = int(v * 5)
        if (v * 5) % 1 < 0.05 or (u + 0.37 * plank) % 1 < 0.012:
            return (84, 58, 38)
        grain = noise(u * 3 + 7 * plank, v * 48, 1024, 11)
        return steps(grain, [(0.35, (176, 128, 80)), (0.65, (190, 142, 92)), (1, (204, 156, 104))])
    return picture(256, 256, colour)


def metal() -> Picture:
    def colour(u: float, v: float) -> Colour:
        return (52, 104, 172) if (u * 6 + v * 3) % 1 < 0.35 else (214, 220, 226)
    return picture(256, 256, colour)


def ground() -> Picture:
    """Of a terrain: contour lines between the colours of heights."""
    def colour(u: float, v: float) -> Colour:
        height = hills(u, v, 3, 2, 3)
        if height * 24 % 1 < 0.08:
            return (92, 84, 66)
        return steps(height, [(0.42, (72, 132, 178)), (0.47, (222, 208, 156)), (0.58, (124, 172, 92)),
                              (0.68, (86, 136, 74)), (1, (176, 168, 156))])
    return picture(256, 256, colour)


def strata() -> Picture:
    def colour(u: float, v: float) -> Colour:
        return steps((v + 0.03 * noise(u * 8, 0, 8, 2)) * 5 % 1,
                     [(0.4, (134, 104, 78)), (0.7, (158, 126, 94)), (1, (112, 86, 66))])
    return picture(128, 128, colour)
