"""Blender's Cycles: single scattering in a world volume (fog) or in a box around the Gaussians."""
import json
import os
import subprocess

from scene import read_exr

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "cycles_script.py")


def settings(scene):
    """(family, label, cost beside others of the family, what render() is told), cheapest first"""
    spp = (1, 4, 16, 64, 256, 1024)
    if scene.extinction:
        return [("Cycles " + name, f"{n} spp", n, (name.upper().replace(" ", "_"), n, 0))
                for name in ("equiangular", "multiple importance") for n in spp]
    return [(f"Cycles equiangular, step {step}", f"{n} spp", n, ("EQUIANGULAR", n, step))
            for step, first in ((0.4, 1), (0.1, 2), (0.05, 3)) for n in spp[first:]]


def render(scene, setting, width, height, folder):
    """(seconds of the render call, CPU seconds of its threads, image)"""
    job, image = os.path.join(folder, "cycles.json"), os.path.join(folder, "cycles.exr")
    for name in (image, image + ".txt"):
        if os.path.exists(name):
            os.remove(name)
    sampling, samples, step = setting
    with open(job, "w") as file:
        json.dump({"extinction": scene.extinction, "gaussians": scene.gaussians, "lights": scene.lights, "wall": scene.wall,
                   "boxes": scene.boxes, "bounds": scene.bounds() if scene.gaussians else None, "sampling": sampling,
                   "samples": samples, "step": step, "size": [width, height], "image": image}, file)
    done = subprocess.run(["blender", "-b", "--factory-startup", "-t", "2", "-noaudio", "-P", SCRIPT, "--", job],
                          capture_output=True, text=True)
    if not os.path.exists(image + ".txt"):
        raise RuntimeError((done.stdout + done.stderr)[-1500:])
    with open(image + ".txt") as file:
        return *map(float, file.read().split()), read_exr(image)
