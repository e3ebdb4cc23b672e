#!/usr/bin/env python3
"""Writes the meshes of cathedral.json, lattice_lamp.json and street_night.json beside this file."""
import math
import pathlib

here = pathlib.Path(__file__).parent


class Mesh:
    def __init__(self):
        self.points, self.faces, self.index = [], [], {}

    def point(self, p):
        p = tuple(round(x, 4) + 0.0 for x in p)
        if p not in self.index:
            self.index[p] = len(self.points) + 1
            self.points.append(p)
        return self.index[p]

    def face(self, *corners):
        ids = [self.point(c) for c in corners]
        for i in range(1, len(ids) - 1):
            if len({ids[0], ids[i], ids[i + 1]}) == 3:
                self.faces.append((ids[0], ids[i], ids[i + 1]))

    def box(self, low, high):
        (a, b, c), (d, e, f) = low, high
        p = [(x, y, z) for x in (a, d) for y in (b, e) for z in (c, f)]
        for i, j, k, m in ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)):
            self.face(p[i], p[j], p[k], p[m])

    def prism(self, x, z, radius, low, high, sides=12, top=None):
        """Upright, of `sides` sides; `top`: its radius up there."""
        def ring(y, r):
            return [(x + r * math.cos(2 * math.pi * i / sides), y, z + r * math.sin(2 * math.pi * i / sides)) for i in range(sides)]
        a, b = ring(low, radius), ring(high, radius if top is None else top)
        for i in range(sides):
            j = (i + 1) % sides
            self.face(a[i], b[i], b[j], a[j])
        self.face(*a)
        self.face(*reversed(b))

    def beam(self, a, b, thick):
        """A square bar from a to b."""
        d = [b[i] - a[i] for i in range(3)]
        length = math.sqrt(sum(x * x for x in d))
        d = [x / length for x in d]
        up = (0, 1, 0) if abs(d[1]) < 0.9 else (1, 0, 0)
        s = [d[1] * up[2] - d[2] * up[1], d[2] * up[0] - d[0] * up[2], d[0] * up[1] - d[1] * up[0]]
        n = math.sqrt(sum(x * x for x in s))
        s = [x / n * thick for x in s]
        t = [d[1] * s[2] - d[2] * s[1], d[2] * s[0] - d[0] * s[2], d[0] * s[1] - d[1] * s[0]]
        ends = [[tuple(e[i] + u * s[i] + v * t[i] for i in range(3)) for u, v in ((-1, -1), (1, -1), (1, 1), (-1, 1))] for e in (a, b)]
        for i in range(4):
            j = (i + 1) % 4
            self.face(ends[0][i], ends[0][j], ends[1][j], ends[1][i])
        self.face(*reversed(ends[0]))
        self.face(*ends[1])

    def write(self, name):
        lines = ["# made by make_meshes.py"]
        lines += ["v %g %g %g" % p for p in self.points] + ["f %d %d %d" % f for f in self.faces]
        (here / name).write_text("\n".join(lines) + "\n")
        print(name, len(self.faces), "triangles")


def pierced_wall(mesh, place, from_u, to_u, low, high, windows, deep):
    """A wall from from_u to to_u and low to high with windows of pointed arches: (middle, half width, sill, spring). place(u, y, d) is where
    its point (u, y) lies, d = 0 on one side and `deep` on the other."""
    heights = {low, high}
    for _, half, sill, spring in windows:
        heights |= {sill, spring} | {spring + half * math.sqrt(3) * math.sin(math.pi / 2 * i / 8) for i in range(1, 9)}
    heights = sorted(heights)

    def half_at(window, y, upper):
        _, half, sill, spring = window
        if y < sill or (y == sill and upper) or y > spring + half * math.sqrt(3) + 1e-9:
            return None
        rise = max(0.0, y - spring)
        return max(0.0, math.sqrt(max(0.0, 4 * half * half - rise * rise)) - half)

    for y0, y1 in zip(heights, heights[1:]):
        edges0, edges1 = [from_u], [from_u]
        for w in sorted(windows):
            a, b = half_at(w, y0, False), half_at(w, y1, True)
            if a is None or b is None or (a == 0 and b == 0):
                continue
            edges0 += [w[0] - a, w[0] + a]
            edges1 += [w[0] - b, w[0] + b]
        edges0.append(to_u)
        edges1.append(to_u)
        for i in range(0, len(edges0), 2):
            for d in (0, deep):
                q = [place(edges0[i], y0, d), place(edges0[i + 1], y0, d), place(edges1[i + 1], y1, d), place(edges1[i], y1, d)]
                mesh.face(*(q if d == 0 else reversed(q)))
        for i in range(1, len(edges0) - 1):
            mesh.face(place(edges0[i], y0, 0), place(edges0[i], y0, deep), place(edges1[i], y1, deep), place(edges1[i], y1, 0))
    for _, half, sill, spring in windows:
        middle = _
        mesh.face(place(middle - half, sill, 0), place(middle + half, sill, 0), place(middle + half, sill, deep), place(middle - half, sill, deep))


def arch(half, spring, steps=10):
    """A pointed arch from (-half, spring) over the top to (half, spring)."""
    side = [(half - 2 * half + 2 * half * (1 - math.cos(math.pi / 3 * i / steps)), spring + 2 * half * math.sin(math.pi / 3 * i / steps))
            for i in range(steps + 1)]
    return side + [(-x, y) for x, y in reversed(side[:-1])]


def cathedral():
    stone, floor = Mesh(), Mesh()
    half, length, bays, spring = 4.0, 27.0, 6, 6.5
    bay = length / bays
    middles = [-(i + 0.5) * bay for i in range(bays)]
    for side in (-1, 1):
        pierced_wall(stone, lambda u, y, d, side=side: (side * (half + d), y, u), -length - 0.5, 0.5, 0, spring + 0.3,
                     [(m, 0.85, 1.8, 4.4) for m in middles], 0.45)
    for z in (0.5, -length - 0.5):
        back = z < 0
        pierced_wall(stone, lambda u, y, d, z=z: (u, y, z - d if z < 0 else z + d), -half - 0.45, half + 0.45, 0, spring + 8,
                     [(-1.7, 0.6, 3, 6.2), (0, 0.75, 3, 7), (1.7, 0.6, 3, 6.2)] if back else [], 0.45)
    vault = arch(half + 0.1, spring)
    for (x0, y0), (x1, y1) in zip(vault, vault[1:]):
        for d in (0, 0.3):
            stone.face((x0, y0 + d, 0.5), (x1, y1 + d, 0.5), (x1, y1 + d, -length - 0.5), (x0, y0 + d, -length - 0.5))
    for i in range(bays + 1):
        z = -i * bay
        for side in (-1, 1):
            stone.prism(side * (half - 0.12), z, 0.42, 0, 0.5, 8)
            stone.prism(side * (half - 0.12), z, 0.27, 0.5, spring - 0.4, 12)
            stone.prism(side * (half - 0.12), z, 0.27, spring - 0.4, spring, 12, 0.45)
        rib = arch(half - 0.1, spring)
        for (x0, y0), (x1, y1) in zip(rib, rib[1:]):
            stone.beam((x0, y0, z), (x1, y1, z), 0.13)
    for i in range(9):
        for side in (-1, 1):
            z = -3.5 - 2 * i
            low, high = sorted((side * 0.9, side * 2.9))
            stone.box((low, 0, z - 0.2), (high, 0.45, z + 0.2))
            stone.box((low, 0.45, z + 0.14), (high, 0.95, z + 0.2))
    stone.box((-1.1, 0, -length + 1.6), (1.1, 1, -length + 2.4))
    floor.face((-half - 1, 0, 1), (half + 1, 0, 1), (half + 1, 0, -length - 1), (-half - 1, 0, -length - 1))
    stone.write("cathedral.obj")
    floor.write("cathedral_floor.obj")


def lattice_lamp():
    lamp = Mesh()
    sides, radius, low, high = 8, 0.42, 1.25, 2.35

    def at(k, y, r=radius):
        a = 2 * math.pi * k / sides
        return (r * math.cos(a), y, r * math.sin(a))

    for k in range(sides):
        lamp.beam(at(k, low), at(k, high), 0.022)
        lamp.beam(at(k, low), at(k + 1, low), 0.022)
        lamp.beam(at(k, high), at(k + 1, high), 0.022)
        rungs = 5
        for i in range(rungs):  # crossed laths
            y0, y1 = low + (high - low) * i / rungs, low + (high - low) * (i + 1) / rungs
            lamp.beam(at(k, y0), at(k + 1, y1), 0.012)
            lamp.beam(at(k + 1, y0), at(k, y1), 0.012)
            lamp.beam(at(k + 0.5, (y0 + y1) / 2, radius * math.cos(math.pi / sides)), at(k, (y0 + y1) / 2), 0.009)
    lamp.prism(0, 0, radius * 1.12, high + 0.03, high + 0.35, sides, 0.05)
    lamp.prism(0, 0, radius * 1.05, low - 0.09, low - 0.03, sides)
    lamp.prism(0, 0, 0.05, 0.06, low - 0.09, 10)
    lamp.prism(0, 0, 0.3, 0, 0.06, 12)
    lamp.write("lattice_lamp.obj")


def house(mesh, x, z, wide, deep, tall, roof, along_z):
    mesh.box((x - wide / 2, 0, z - deep / 2), (x + wide / 2, tall, z + deep / 2))
    e = 0.25
    if along_z:  # the ridge
        a, b = (x - wide / 2 - e, x + wide / 2 + e), (z - deep / 2 - e, z + deep / 2 + e)
        ridge = [(x, tall + roof, b[0]), (x, tall + roof, b[1])]
        mesh.face((a[0], tall, b[0]), (a[0], tall, b[1]), ridge[1], ridge[0])
        mesh.face((a[1], tall, b[1]), (a[1], tall, b[0]), ridge[0], ridge[1])
        mesh.face((a[0], tall, b[0]), ridge[0], (a[1], tall, b[0]))
        mesh.face((a[1], tall, b[1]), ridge[1], (a[0], tall, b[1]))
        mesh.face((a[0], tall, b[0]), (a[1], tall, b[0]), (a[1], tall, b[1]), (a[0], tall, b[1]))
    else:
        a, b = (x - wide / 2 - e, x + wide / 2 + e), (z - deep / 2 - e, z + deep / 2 + e)
        ridge = [(a[0], tall + roof, z), (a[1], tall + roof, z)]
        mesh.face((a[0], tall, b[1]), (a[1], tall, b[1]), ridge[1], ridge[0])
        mesh.face((a[1], tall, b[0]), (a[0], tall, b[0]), ridge[0], ridge[1])
        mesh.face((a[0], tall, b[0]), (a[0], tall, b[1]), ridge[0])
        mesh.face((a[1], tall, b[1]), (a[1], tall, b[0]), ridge[1])
        mesh.face((a[0], tall, b[0]), (a[1], tall, b[0]), (a[1], tall, b[1]), (a[0], tall, b[1]))


def street_night():
    houses, things = Mesh(), Mesh()
    z = -1.0
    for i, (wide, tall, roof) in enumerate(((5, 5.2, 2.4), (4, 6.4, 2), (5.5, 4.8, 2.6), (4.5, 6.8, 2.2), (6, 5.4, 2.6), (5, 6, 2))):
        house(houses, -7.3, z - wide / 2, 5, wide - 0.15, tall, roof, i % 2 == 0)
        house(houses, 7.5, z - 1.2 - wide / 2, 5, wide - 0.15, tall * (1.1 if i % 2 else 0.9), roof, i % 2 == 1)
        houses.box((-6.9, tall + 0.6, z - wide * 0.7), (-6.4, tall + roof + 0.7, z - wide * 0.7 + 0.5))
        z -= wide
    for k in range(4):  # lamp posts, their lamps at (side * 3.1, 3.55, z)
        side, at = (-1 if k % 2 == 0 else 1), -3.0 - 6.5 * k
        x = side * 3.9
        things.prism(x, at, 0.09, 0, 0.5, 10)
        things.prism(x, at, 0.05, 0.5, 3.9, 10)
        things.beam((x, 3.86, at), (side * 3.1, 3.86, at), 0.03)
        things.prism(side * 3.1, at, 0.32, 3.66, 3.86, 12, 0.06)
    for side in (-1, 1):  # pavements, trees without leaves, a bench and a cart
        low, high = sorted((side * 3.4, side * 5.0))
        things.box((low, 0, -36), (high, 0.14, 1))
    for x, at in ((3.9, -6.5), (-3.9, -13.5), (3.9, -19.5)):
        things.prism(x, at, 0.13, 0.1, 2.2, 8, 0.09)
        for b in range(9):
            a, up = 2.4 * b, 1.6 + 0.16 * b
            tip = (x + 0.95 * math.cos(a), up + 0.9, at + 0.95 * math.sin(a))
            things.beam((x, up, at), tip, 0.028)
            for turn in (-0.6, 0.7):
                things.beam(tip, (tip[0] + 0.5 * math.cos(a + turn), tip[1] + 0.4, tip[2] + 0.5 * math.sin(a + turn)), 0.014)
    things.box((-2.9, 0.55, -8.9), (-1.5, 0.75, -6.6))
    things.box((-2.9, 0.75, -8.9), (-2.84, 1.15, -6.6))
    things.box((-1.56, 0.75, -8.9), (-1.5, 1.15, -6.6))
    for x in (-2.98, -1.42):
        for at in (-8.3, -7.2):
            spokes = 10
            for i in range(spokes):
                a, b = 2 * math.pi * i / spokes, 2 * math.pi * (i + 1) / spokes
                p = (x, 0.42 + 0.42 * math.sin(a), at + 0.42 * math.cos(a))
                things.beam(p, (x, 0.42 + 0.42 * math.sin(b), at + 0.42 * math.cos(b)), 0.03)
                things.beam((x, 0.42, at), p, 0.015)
    houses.write("street_houses.obj")
    things.write("street_things.obj")


cathedral()
lattice_lamp()
street_night()
