"""POV-Ray 3.7: single scattering as its scene-wide atmosphere."""
import math
import os
import re
import subprocess

from scene import read_exr

LAMP = 1e-4  # fade_distance: far below any distance, so that the fall-off is 1/r^2


def vector(v):
    return "<%.9g, %.9g, %.9g>" % tuple(v)


def settings(scene):
    """(family, label, cost beside others of the family, what render() is told), cheapest first"""
    sweep = [(2, n, 1) for n in (5, 10, 20, 40, 80, 160)]
    if scene.extinction:  # light rays cost little, so many samples are affordable
        sweep += [(2, 80, s) for s in (4, 10, 20)] + [(3, 1, s) for s in (20, 80, 320, 1280)]
    else:
        sweep += [(3, 1, s) for s in (10, 20, 40)]
    power = 1 if scene.extinction else 2
    return [(f"POV-Ray method {m}", f"{n} x {s}", float(n * s) ** power, (m, n, s)) for m, n, s in sweep]


def text(scene, method, intervals, samples):
    lines = ["#version 3.7;", "global_settings { assumed_gamma 1 adc_bailout 0 max_trace_level 5 }", "background { rgb 0 }",
             "camera { location <0, 0, 0> right <4/3, 0, 0> up <0, 1, 0> direction <0, 0, %.12g> }" % (-0.5 / math.tan(math.pi / 8))]
    for position, intensity in scene.lights:  # colour 2 / (1 + (d / F)^2) is I / d^2
        lines.append("light_source { %s rgb %.12g fade_distance %g fade_power 2 media_attenuation on }"
                     % (vector(position), intensity / (2 * LAMP * LAMP), LAMP))
    black = "pigment { rgb 0 } finish { ambient 0 diffuse 0 }"
    wall = scene.wall if scene.wall is not None else scene.bounds()[0][2]
    lines.append("plane { z, %.9g %s no_shadow }" % (wall, black))
    for low, high in scene.boxes:
        lines.append("box { %s, %s %s }" % (vector(low), vector(high), black))
    scale, density = scene.extinction, ""
    if scene.gaussians:  # a pattern: its values must stay below 1
        scale = 1.001 * sum(c for _, _, c in scene.gaussians)
        density = "density { function { %s } }" % " + ".join(
            "%.12g*exp(-((x-(%.9g))*(x-(%.9g))+(y-(%.9g))*(y-(%.9g))+(z-(%.9g))*(z-(%.9g)))*%.12g)"
            % (c / scale, b[0], b[0], b[1], b[1], b[2], b[2], 1 / r ** 2) for b, r, c in scene.gaussians)
    # The isotropic type lacks the 1 / (4 pi).
    lines.append("media { method %d intervals %d samples %d,%d scattering { 1, rgb %.12g extinction %.12g } %s }"
                 % (method, intervals, samples, samples, scale / (4 * math.pi), 4 * math.pi, density))
    return "\n".join(lines) + "\n"


def render(scene, setting, width, height, folder):
    """(seconds of tracing, CPU seconds of its threads, image)"""
    name, image = os.path.join(folder, "scene.pov"), os.path.join(folder, "povray.exr")
    with open(name, "w") as file:
        file.write(text(scene, *setting))
    if os.path.exists(image):
        os.remove(image)
    done = subprocess.run(["povray", "+I" + name, "+O" + image, "+FE", f"+W{width}", f"+H{height}", "-D", "-A", "+WT2"],
                          capture_output=True, text=True)
    seconds = re.findall(r"Trace Time:.*\(([0-9.]+) seconds\)\s+using \d+ thread\(s\) with ([0-9.]+) CPU-seconds", done.stderr)
    if not seconds or not os.path.exists(image):  # not by the exit status: with functions it may crash after the last line
        raise RuntimeError(done.stderr[-1500:])
    return *map(float, seconds[-1]), read_exr(image)
