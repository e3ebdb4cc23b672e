#!/usr/bin/env python3
"""Makes the meshes of cathedral.json, lattice_lamp.json and street_night.json: OBJ files in folders beside this script.

    python3 scenes/make_meshes.py [FOLDER]

Nothing but Python is needed. Metres, +Y up. Solids that meet run into each other, so that no light leaks between them and no two faces that
can be seen lie in one plane; triangles that share an edge share its vertices, so that most edges cancel in a silhouette.
"""
import math
import pathlib
import random
import sys


def add(a, b, s=1.0):
    return tuple(p + s * q for p, q in zip(a, b))


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def unit(a):
    length = math.sqrt(sum(p * p for p in a))
    return tuple(p / length for p in a)


class Mesh:
    """A triangle soup; equal vertices become one when it is written."""

    def __init__(self):
        self.triangles = []

    def face(self, *points):  # convex
        self.triangles += [(points[0], points[k], points[k + 1]) for k in range(1, len(points) - 1)]

    def strip(self, a, b, closed=False):  # between two polylines
        n = len(a)
        for i in range(n if closed else n - 1):
            self.face(a[i], a[(i + 1) % n], b[(i + 1) % n], b[i])

    def ring(self, outer, inner):
        """Between two polygons (s, t, place) that are star-shaped about (0, 0), by angle."""
        corners = sorted([(math.atan2(p[1], p[0]), 0, k) for k, p in enumerate(outer)] +
                         [(math.atan2(p[1], p[0]), 1, k) for k, p in enumerate(inner)])
        at = [max(c for c in corners if c[1] == side)[2] for side in (0, 1)]
        for _, side, k in corners:
            both = (outer, inner)
            self.triangles.append((both[side][at[side]][2], both[side][k][2], both[1 - side][at[1 - side]][2]))
            at[side] = k

    def box(self, low, high):
        self.prism([(low[0], low[2]), (high[0], low[2]), (high[0], high[2]), (low[0], high[2])], low[1], high[1])

    def prism(self, polygon, low, high):  # of a convex polygon (x, z)
        a, b = [[(x, y, z) for x, z in polygon] for y in (low, high)]
        self.strip(a, b, closed=True)
        self.face(*a)
        self.face(*b)

    def lathe(self, profile, sides, centre=(0, 0, 0), lobes=lambda angle: 1.0):
        """Turns (radius, y) about the vertical through `centre`; ends are closed."""
        rings = []
        for r, y in profile:
            angles = [2 * math.pi * (k + 0.5) / sides for k in range(sides)]
            rings.append([add(centre, (r * lobes(p) * math.cos(p), y, r * lobes(p) * math.sin(p))) for p in angles])
        for a, b in zip(rings, rings[1:]):
            self.strip(a, b, closed=True)
        self.face(*rings[0])
        self.face(*rings[-1])

    def bar(self, path, normal, width, height, closed=False):
        """Sweeps a rectangle along a path in a plane: `width` along its normal, `height` in the plane."""
        lines, n = [], len(path)
        for i, p in enumerate(path):
            before, after = path[i - 1 if closed else max(i - 1, 0)], path[(i + 1) % n if closed else min(i + 1, n - 1)]
            side = unit(cross(normal, add(after, before, -1)))
            lines.append([add(add(p, normal, w * width / 2), side, h * height / 2) for w, h in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
        for a, b in zip(lines, lines[1:] + lines[:1] if closed else lines[1:]):
            self.strip(a, b, closed=True)
        if not closed:
            self.face(*lines[0])
            self.face(*lines[-1])

    def tube(self, a, b, radius, end, sides=6):
        """A cone stump from a to b."""
        axis = unit(add(b, a, -1))
        u = unit(cross(axis, (0, 0, 1) if abs(axis[2]) < 0.9 else (1, 0, 0)))
        v = cross(axis, u)
        rings = []
        for centre, r in ((a, radius), (b, end)):
            angles = [2 * math.pi * k / sides for k in range(sides)]
            rings.append([add(add(centre, u, r * math.cos(p)), v, r * math.sin(p)) for p in angles])
        self.strip(*rings, closed=True)
        self.face(*rings[0])
        self.face(*rings[1])

    def put(self, other, place=(0, 0, 0), turn=0.0):
        """A copy of a mesh, turned about +Y [degrees] and moved."""
        c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        for t in other.triangles:
            self.triangles.append(tuple(add(place, (c * x + s * z, y, c * z - s * x)) for x, y, z in t))

    def write(self, path):
        path.parent.mkdir(parents=True, exist_ok=True)
        index, vertices, faces = {}, [], []
        for t in self.triangles:
            face = []
            for p in t:
                key = tuple(round(1e4 * x) for x in p)  # 0.1 mm
                if key not in index:
                    index[key] = len(index) + 1
                    vertices.append("v " + " ".join(f"{x / 1e4:.4f}".rstrip("0").rstrip(".") for x in key))
                face.append(index[key])
            if len(set(face)) == 3:
                faces.append("f {} {} {}".format(*face))
        path.write_text("\n".join([f"# Made by {pathlib.Path(__file__).name}"] + vertices + faces) + "\n")
        print(f"{path}: {len(faces)} triangles, {path.stat().st_size / 1000:.0f} kB")


def arch(half, rise, n):
    """The left arc of a pointed arch, from (-half, 0) to (0, rise): (x, y)."""
    radius = (half * half + rise * rise) / (2 * half)
    end = math.asin(min(rise / radius, 1))
    if half < radius and rise > radius:
        end = math.pi - end
    return [(radius - half - radius * math.cos(end * k / n), radius * math.sin(end * k / n)) for k in range(n)] + [(0.0, rise)]


def pointed(half, rise, n):
    left = arch(half, rise, n)
    return left + [(-x, y) for x, y in reversed(left[:-1])]


def opening(half, sill, spring, rise=0.0, n=6):
    """The left side of a window, from its sill up; the right one is its mirror image."""
    return [(-half, sill)] + ([(x, spring + y) for x, y in arch(half, rise, n)] if rise > 0 else [(-half, spring)])


def panel(mesh, place, low, high, top, middle, holes):
    """A wall from s = low to high and y = 0 to top with one window about s = middle. `holes`: its outline in each of two faces, at depths:
    [(depth, outline), (depth, outline)]. `place` maps (s, y, depth) to a point."""
    rims = []
    for depth, outline in holes:
        def at(s, y, depth=depth):
            return place(s, y, depth)
        left, right = [[at(middle + sign * x, y) for x, y in outline] for sign in (1, -1)]
        for side, rim in ((low, left), (high, right)):
            mesh.strip([at(side, y) for _, y in outline], rim)
        bottom, head = outline[0][1], outline[-1][1]
        mesh.face(at(low, 0), at(high, 0), at(high, bottom), right[0], left[0], at(low, bottom))
        over = [left[-1]] if outline[-1][0] == 0 else [left[-1], right[-1]]
        mesh.face(at(low, top), at(low, head), *over, at(high, head), at(high, top))
        rims.append(left + right[::-1][1 if outline[-1][0] == 0 else 0:])
    mesh.strip(*rims, closed=True)


def cathedral(folder):
    """A hall church of three naves, eight bays of 6 m from z = 12 to z = -36; windows to the south (+X), to the north and in the east (-Z)."""
    nave, aisle, bay, spring, rise, wall = 4.2, 2.1, 3.0, 9.0, 5.6, 8.4
    stone, vault, pews, iron = Mesh(), Mesh(), Mesh(), Mesh()
    tiles = Mesh(), Mesh()
    centres = [9 - 6 * k for k in range(8)]
    east, west, top = -36.0, 12.0, 14.9

    def window(place, low, high, half, sill, head, height):
        panel(stone, place, low, high, top, (low + high) / 2,
              [(0.0, opening(half + 0.35, sill - 0.5, head - 0.1, height + 0.5)), (0.6, opening(half, sill, head, height)), ])
        panel(stone, place, low, high, top, (low + high) / 2, [(0.6, opening(half, sill, head, height))] * 2)
        middle, normal = (low + high) / 2, unit(add(place(0, 0, 1), place(0, 0, 0), -1))

        def trace(points, width, closed=False):
            stone.bar([place(middle + x, y, 0.45) for x, y in points], normal, width, width, closed)
        lights = 2 if half < 2 else 4
        pitch = 2 * half / lights
        for k in range(lights):
            centre = -half + (k + 0.5) * pitch
            trace([(centre + x, head + y) for x, y in pointed(pitch / 2, height * 0.9 / lights, 4)], 0.11)
            if k > 0:
                trace([(centre - pitch / 2, sill - 0.1), (centre - pitch / 2, head + 0.05)], 0.14)
        radius, eye = half * 0.36, head + height * 0.57
        trace([(radius * math.cos(math.pi * k / 7), eye + radius * math.sin(math.pi * k / 7)) for k in range(14)], 0.11, True)
        for k in range(1, 4):
            y = sill + (head - sill) * k / 4
            trace([(-half - 0.1, y), (half + 0.1, y)], 0.05)

    def vault_bay(cx, cz, a, b):
        profile = [(-x, rise * y / 1.3) for x, y in reversed(arch(1.0, 1.3, 7))]
        for sx in (-1, 1):
            for sz in (-1, 1):
                diagonal = [(cx + sx * a * u, spring + y, cz + sz * b * u) for u, y in profile]
                vault.strip(diagonal, [(cx + sx * a, p[1], p[2]) for p in diagonal])
                vault.strip(diagonal, [(p[0], p[1], cz + sz * b) for p in diagonal])
        arc = [(-u, y) for u, y in reversed(profile)] + profile[1:]
        for sz in (-1, 1):
            path = [(cx + a * u, spring + y - 0.1, cz + sz * b * u) for u, y in arc]
            stone.bar(path, unit((sz * b, 0, -a)), 0.18, 0.3)
        return arc

    for cz in centres:
        for side in (-1, 1):
            def place(s, y, depth, side=side):
                return side * (wall + depth), y, s
            window(place, cz - bay, cz + bay, 1.35, 2.4, 7.2, 2.9)
            arc = vault_bay(side * (nave + aisle), cz, aisle, bay)
            stone.bar([(side * nave, spring + y - 0.16, cz + bay * u) for u, y in arc], (1, 0, 0), 0.5, 0.5)
        vault_bay(0, cz, nave, bay)

    def lobes(angle):
        return 1 + 0.16 * math.cos(4 * angle)
    for cz in [c - bay for c in centres] + [west]:
        arc = [(x, rise * y / 1.3) for x, y in pointed(1.0, 1.3, 7)]
        for cx, a in ((0, nave), (-nave - aisle, aisle), (nave + aisle, aisle)):
            stone.bar([(cx + a * u, spring + y - 0.16, cz) for u, y in arc], (0, 0, 1), 0.42, 0.46)
        for side in (-1, 1):
            stone.lathe([(0.85, 0), (0.85, 0.3), (0.72, 0.5), (0.52, 0.62), (0.5, 8.3), (0.56, 8.45), (0.8, 9.0), (0.8, 9.25)], 20,
                        (side * nave, 0, cz), lobes)
            stone.lathe([(0.5, 0), (0.5, 0.4), (0.3, 0.6), (0.3, 8.4), (0.5, 9.0), (0.5, 9.2)], 10, (side * (wall - 0.05), 0, cz))

    def place_east(s, y, depth):
        return s, y, east - depth
    window(place_east, -nave, nave, 2.6, 3.4, 7.6, 4.6)
    for side in (-1, 1):
        window(place_east, *sorted((side * nave, side * wall)), 0.9, 2.4, 7.2, 2.4)
    stone.box((-10, -0.1, west), (10, top, west + 0.5))
    stone.box((-10, 14.7, east - 1), (10, 15.2, west + 0.5))  # the roof

    for i in range(12):
        for j in range(34):
            x, z = -8.4 + 1.4 * i, west - 1.4 * j
            tiles[(i + j) % 2].face((x, 0, z), (x + 1.4, 0, z), (x + 1.4, 0, z - 1.4), (x, 0, z - 1.4))
    stone.box((-nave - 0.5, -0.1, east - 0.1), (nave + 0.5, 0.3, -28.8))  # two steps and the altar
    stone.box((-nave + 0.4, -0.2, east - 0.1), (nave - 0.4, 0.6, -29.8))
    stone.box((-1.3, 0.5, -33.2), (1.3, 1.5, -32.2))
    stone.box((-1.5, 1.4, -33.3), (1.5, 1.62, -32.1))
    for row in range(13):
        z = 4.5 - 2.2 * row
        for side in (-1, 1):
            x0, x1 = sorted((side * 1.15, side * 3.25))
            pews.box((x0, 0.4, z - 0.24), (x1, 0.46, z + 0.24))
            pews.box((x0, 0.3, z + 0.22), (x1, 0.95, z + 0.28))
            for x in (x0, x1):
                pews.box((x - 0.04, -0.1, z - 0.3), (x + 0.04, 1.02, z + 0.33))
    for z in (3.0, -9.0, -21.0):  # chandeliers
        circle = [(0.75 * math.cos(math.pi * k / 8), 5.0, z + 0.75 * math.sin(math.pi * k / 8)) for k in range(16)]
        iron.bar(circle, (0, 1, 0), 0.1, 0.04, True)
        for k in range(0, 16, 4):
            iron.tube(circle[k], (0, 6.2, z), 0.015, 0.015, 4)
        iron.tube((0, 6.15, z), (0, 14.8, z), 0.025, 0.025, 4)
    for name, mesh in (("stone", stone), ("vault", vault), ("pews", pews), ("iron", iron), ("tiles_light", tiles[0]), ("tiles_dark", tiles[1])):
        mesh.write(folder / "cathedral" / f"{name}.obj")


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else __file__).resolve()
    folder = folder if len(sys.argv) > 1 else folder.parent
    cathedral(folder)


if __name__ == "__main__":
    main()
