"""Scenes of scenes/peers as what POV-Ray and Cycles are told of them, and images."""
import json
import os
import re
import subprocess
import tempfile
from dataclasses import dataclass

import numpy as np
from PIL import Image

REACH = 3.5  # Gaussians are cut this many radii from the centre: 2e-6 of their peak


@dataclass
class Scene:
    name: str
    extinction: float  # 0: Gaussians
    gaussians: list  # (center, radius, extinction)
    lights: list  # (position, intensity)
    wall: float  # z of a black wall, or None
    boxes: list  # (low, high), black, casting

    def bounds(self):
        """Low and high corner of what the Gaussians fill."""
        low = np.min([np.array(c) - REACH * r for c, r, _ in self.gaussians], axis=0)
        high = np.max([np.array(c) + REACH * r for c, r, _ in self.gaussians], axis=0)
        return low.tolist(), high.tolist()


def without_comments(text):
    return re.sub(r'("(?:\\.|[^"\\])*")|//[^\n]*', lambda m: m.group(1) or "", text)


def require(condition, path, what):
    if not condition:
        raise SystemExit(f"{path}: the other renderers are asked only for {what}")


def grey(rgb, path):
    require(len(set(rgb)) == 1, path, "white light")
    return float(rgb[0])


def read(path):
    with open(path) as file:
        data = json.loads(without_comments(file.read()))
    camera, medium = data["camera"], data["medium"]
    require(camera["position"] == [0, 0, 0] and camera["look_at"] == [0, 0, -1] and camera["vertical_fov"] == 45, path,
            "a camera at the origin along -z, 45 degrees")
    require(medium.get("albedo", [1, 1, 1]) == [1, 1, 1] and medium.get("phase", {}).get("type", "isotropic") == "isotropic",
            path, "white isotropic media")
    scene = Scene(os.path.splitext(os.path.basename(path))[0], medium.get("homogeneous", {}).get("extinction", 0),
                  [(g["center"], g["radius"], g["extinction"]) for g in medium.get("gaussians", [])], [], None, [])
    require(bool(scene.extinction) != bool(scene.gaussians), path, "a homogeneous medium or Gaussians")
    for light in data["lights"]:
        require(light["type"] == "point", path, "point lights")
        scene.lights.append((light["position"], grey(light["intensity"], path)))
    for surface in data.get("surfaces", []):
        require(surface["material"] == {"diffuse": [0, 0, 0]}, path, "black surfaces")
        with open(os.path.join(os.path.dirname(path), surface["mesh"])) as file:
            points = np.array([line.split()[1:4] for line in file if line.startswith("v ")], float)
        points += surface.get("translate", [0, 0, 0])
        low, high = points.min(axis=0).tolist(), points.max(axis=0).tolist()
        if low[2] == high[2]:
            require(surface.get("casts_shadow") is False, path, "walls that cast no shadow")
            scene.wall = low[2]
        else:
            require(len(points) == 8 and surface.get("casts_shadow", True), path, "walls and boxes")
            scene.boxes.append((low, high))
    return scene


def read_pfm(path):
    """Rows top to bottom, the green or only channel."""
    with open(path, "rb") as file:
        kind = file.readline().strip()
        width, height = map(int, file.readline().split())
        order = "<" if float(file.readline()) < 0 else ">"
        values = np.frombuffer(file.read(), order + "f4").astype(float)
    channels = {b"Pf": 1, b"PF": 3}[kind]
    return values.reshape(height, width, channels)[::-1, :, 1 % channels]


def read_exr(path):
    """Green, rows top to bottom; by oiiotool as uncompressed TIFF."""
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "image.tif")
        subprocess.run(["oiiotool", path, "--ch", "G", "-d", "float", "--compression", "none", "-o", name], check=True)
        with Image.open(name) as image:
            return np.array(image, float)


def errors(image, truth):
    """Relative RMSE, and the same without the worst 0.5 % of the pixels."""
    squares = np.sort(((image - truth) ** 2).ravel())
    if not np.isfinite(squares).all():
        return float("inf"), float("inf")
    kept = squares[: len(squares) - len(squares) // 200]
    return float(np.sqrt(squares.mean()) / truth.mean()), float(np.sqrt(kept.mean()) / truth.mean())
