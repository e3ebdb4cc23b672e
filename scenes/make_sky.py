#!/usr/bin/env python3
"""make_sky.py: writes sky.hdr, an evening sky of latitude and longitude for bunny_at_dusk.json: 128 x 64, top row +Y, centre -Z."""
import math
import os

WIDTH, HEIGHT = 128, 64
SUN = (0.55, 0.28, -0.79)  # toward it


def radiance(x, y, z):
    up = max(y, 0.0)
    glow = max(0.0, x * SUN[0] + y * SUN[1] + z * SUN[2])
    haze = math.exp(-6 * up)
    sky = [0.05 + 0.35 * haze, 0.10 + 0.22 * haze, 0.26 + 0.12 * haze]
    warm = 1.2 * glow**8 + 14 * glow**200
    sky = [s + warm * c for s, c in zip(sky, (1.0, 0.55, 0.22))]
    if y < 0:  # the ground, dark
        dark = math.exp(12 * y)
        sky = [s * dark + 0.03 * (1 - dark) for s in sky]
    return sky


def rgbe(color):
    largest = max(color)
    mantissa, exponent = math.frexp(largest)
    scale = mantissa * 256 / largest
    return bytes([int(c * scale) for c in color] + [exponent + 128])


def main():
    length = math.sqrt(sum(c * c for c in SUN))
    assert abs(length - 1) < 0.01
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "sky.hdr"), "wb") as file:
        file.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (HEIGHT, WIDTH))
        for row in range(HEIGHT):
            polar = math.pi * (row + 0.5) / HEIGHT
            for column in range(WIDTH):
                around = 2 * math.pi * ((column + 0.5) / WIDTH - 0.5)
                file.write(rgbe(radiance(math.sin(polar) * math.sin(around), math.cos(polar), -math.sin(polar) * math.cos(around))))


if __name__ == "__main__":
    main()
