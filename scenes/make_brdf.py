#!/usr/bin/env python3
"""make_brdf.py: writes gold.binary, rough gold as a tabulated reflectance for gold_bunny.json, in the layout of the MERL database: microfacets
of Trowbridge and Reitz with Smith's shadowing (Walter et al. 2007, Heitz 2014) and Schlick's Fresnel term."""
import array
import math
import os
import struct
import sys

HALVES, DIFFERENCES, PHIS = 40, 24, 32
ROUGHNESS = 0.3
GOLD = (1.0, 0.71, 0.29)  # at normal incidence
SCALE = (1 / 1500, 1.15 / 1500, 1.66 / 1500)


def reflectance(theta_half, theta_difference, phi_difference):
    """Of red, green and blue [1/sr], or None where light or viewer is below the horizon."""
    sh, ch = math.sin(theta_half), math.cos(theta_half)
    sd, cd = math.sin(theta_difference), math.cos(theta_difference)
    # Cosines with the normal: the way to the light about the half vector, turned back by theta_half; the viewer's is its mirror image.
    light = ch * cd - sh * sd * math.cos(phi_difference)
    viewer = ch * cd + sh * sd * math.cos(phi_difference)
    if light <= 0 or viewer <= 0:
        return None
    a2 = ROUGHNESS * ROUGHNESS
    peak = a2 / (math.pi * (ch * ch * (a2 - 1) + 1) ** 2)
    shadowing = 0.5 / (light * math.sqrt(a2 + (1 - a2) * viewer * viewer) + viewer * math.sqrt(a2 + (1 - a2) * light * light))
    fresnel = (1 - cd) ** 5
    return [peak * shadowing * (f + (1 - f) * fresnel) for f in GOLD]


def main():
    planes = [array.array("d") for _ in range(3)]
    for h in range(HALVES):
        for d in range(DIFFERENCES):
            for p in range(PHIS):
                found = reflectance(((h + 0.5) / HALVES) ** 2 * math.pi / 2, (d + 0.5) / DIFFERENCES * math.pi / 2, (p + 0.5) / PHIS * math.pi)
                for c in range(3):
                    planes[c].append(found[c] / SCALE[c] if found else -1)
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "gold.binary"), "wb") as file:
        file.write(struct.pack("<3i", HALVES, DIFFERENCES, PHIS))
        for plane in planes:
            if sys.byteorder == "big":
                plane.byteswap()
            file.write(plane.tobytes())


if __name__ == "__main__":
    main()
