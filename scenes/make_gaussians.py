#!/usr/bin/env python3
"""Writes the scenes of many Gaussians beside this file: cumulus.json, papers/pierced_cloud.json, papers/steam.json, papers/two_suns.json."""
import json
import math
import pathlib
import random

here = pathlib.Path(__file__).parent


def gaussian(center, radius, extinction, **more):
    return {"center": [round(x, 3) for x in center], "radius": round(radius, 3), "extinction": round(extinction, 3), **more}


def write(name, comment, scene):
    gaussians = scene["medium"].pop("gaussians")
    text = json.dumps({"airlight": 1, **scene}, indent=2)
    lines = ",\n".join("      " + json.dumps(g) for g in gaussians)
    text = text.replace('"medium": {', '"medium": {\n    "gaussians": [\n' + lines + "\n    ],", 1)
    (here / name).write_text("// " + comment + " Made by make_gaussians.py.\n" + text + "\n")


def cumulus():
    number = random.Random(5).uniform
    cloud = []
    for heap in range(9):  # heaps of puffs: large ones at the bottom, small ones on top
        x, z, wide = number(-3.2, 3.2), number(-2, 1), number(0.7, 1.3)
        for _ in range(26):
            up = number(0, 1) ** 1.5
            angle, off = number(0, 2 * math.pi), wide * (1 - 0.7 * up) * math.sqrt(number(0, 1))
            radius = (0.42 - 0.22 * up) * number(0.8, 1.2)
            center = (x + off * math.cos(angle), 2.6 + 1.5 * wide * up, z + off * math.sin(angle))
            cloud.append(gaussian(center, radius, number(0.9, 1.8) / radius, albedo=[0.99, 0.99, 0.99]))
    write("cumulus.json", "A cloud in the evening sun, and its shadow on the ground.", {
        "camera": {"position": [0, 1.1, 9.5], "look_at": [0, 2.4, 0], "vertical_fov": 46, "resolution": [800, 450]},
        "sky_distance": 80,
        "medium": {"phase": {"type": "isotropic"}, "albedo": [0.9, 0.95, 1], "ambient": [0.07, 0.09, 0.13],
                   "homogeneous": {"extinction": 0.003}, "gaussians": cloud},
        "lights": [{"type": "directional", "direction": [0.8, -0.5, -0.5], "irradiance": [11, 8.6, 6]}],
        "surfaces": [{"mesh": "ground.obj", "scale": 4, "casts_shadow": False,
                      "material": {"diffuse": [0.06, 0.085, 0.035]}}],
        "background": [0.1, 0.17, 0.32]})


def pierced_cloud():
    tube = []
    for ring in range(5):
        for i in range(14):
            if ring == 2 and i < 3:
                continue
            angle = 2 * math.pi * i / 14
            tube.append(gaussian((0.55 * (ring - 2), 1.1 * math.cos(angle), 1.1 * math.sin(angle)), 0.4, 3.5))
    write("papers/pierced_cloud.json", "A tube of cloud with a lamp inside, which shines through a hole (Zhou et al. 2007, figure 7).", {
        "camera": {"position": [0, 0.4, 6], "look_at": [0, 0, 0], "vertical_fov": 50, "resolution": [640, 480]},
        "medium": {"phase": {"type": "isotropic"}, "homogeneous": {"extinction": 0.05}, "gaussians": tube},
        "lights": [{"type": "point", "position": [0, 0, 0], "intensity": [30, 26, 20]}],
        "sky_distance": 60})


def two_suns():
    number = random.Random(12).uniform
    cloud = []
    for heap in range(12):
        angle, off = number(0, 2 * math.pi), math.sqrt(number(0, 1))
        x, y, z, wide = 2.1 * off * math.cos(angle), number(-0.25, 0.65), 1.1 * off * math.sin(angle), number(0.45, 0.8)
        for _ in range(20):
            up, around = number(-0.6, 1), number(0, 2 * math.pi)
            flat, out = wide * math.sqrt(max(0, 1 - up * up)), number(0.6, 1)
            radius = wide * number(0.2, 0.36)
            center = (x + out * flat * math.cos(around), y + 0.9 * out * wide * up, z + out * flat * math.sin(around))
            cloud.append(gaussian(center, radius, number(2.2, 4) / radius, albedo=[0.99, 0.99, 0.99]))
    write("papers/two_suns.json", "A cloud under two suns and the sky, in all orders of scattering (Szirmay-Kalos et al. 2005, figure 5).", {
        "camera": {"position": [0, -0.6, 9], "look_at": [0.1, 0.15, 0], "vertical_fov": 24, "resolution": [640, 360]},
        "medium": {"phase": {"type": "isotropic"}, "gaussians": cloud},
        "lights": [{"type": "directional", "name": "left", "direction": [0.75, -0.6, -0.3], "irradiance": [5.6, 5.2, 4.5]},
                   {"type": "directional", "name": "right", "direction": [-0.75, 0.65, -0.1], "irradiance": [3.4, 1.0, 0.25]},
                   {"type": "environment", "radiance": [0.07, 0.14, 0.28]}],
        "technique": {"name": "illumination-network", "directions": 128}})


def steam():
    number = random.Random(3).uniform
    puffs = []
    for _ in range(3008):
        up = number(0, 1)
        off, angle = (0.25 + 0.9 * up) * math.sqrt(number(0, 1)), number(0, 2 * math.pi)
        puffs.append(gaussian((off * math.cos(angle), 0.1 + 2.1 * up, off * math.sin(angle)), number(0.1, 0.22), number(0.02, 0.12)))
    write("papers/steam.json", "3008 puffs of steam and one lamp, as a row of Zhou et al. 2007, table 1.", {
        "camera": {"position": [0.4, 1.4, 5.2], "look_at": [0, 1, 0], "vertical_fov": 50, "resolution": [800, 600]},
        "medium": {"phase": {"type": "isotropic"}, "gaussians": puffs},
        "lights": [{"type": "point", "position": [1.5, 2.2, 1.2], "intensity": [6, 5.5, 5]}],
        "sky_distance": 60})


cumulus()
pierced_cloud()
steam()
two_suns()
