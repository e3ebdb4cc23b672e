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


def lattice_lamp(folder):
    """A pierced lantern on tiles in the corner of two walls, beside a pot and two balls."""
    shell, frame, props, walls = Mesh(), Mesh(), Mesh(), Mesh()
    tiles = Mesh(), Mesh()
    across, rows, low, high = 20, 10, 0.14, 0.74

    def place(s, t):  # on the shell; s counts cells around, t rows
        h = min(max(t / rows, 0), 1)
        radius = 0.115 + 0.15 * math.sin(math.pi * h ** 0.85) ** 0.9
        angle = 2 * math.pi * s / across
        return radius * math.cos(angle), low + (high - low) * h, radius * math.sin(angle)

    for row in range(rows + 1):
        for cell in range(across):
            middle = cell + row % 2 / 2
            corners = [(0.5, 0.0), (0.0, 1.0), (-0.5, 0.0), (0.0, -1.0)]

            def corner(s, t):
                return s, 2 * t, place(middle + s, row + t)
            outer = [corner(s, t) for s, t in corners]
            if row in (0, rows):
                shell.face(*[p[2] for p in outer if row + p[1] / 2 >= 0 and row + p[1] / 2 <= rows])
                continue
            points = 16 if row % 2 == 0 else 12
            hole = []
            for k in range(points):
                angle, size = 2 * math.pi * k / points, 0.3 if k % 2 == 0 else 0.19
                if row % 2 == 1:
                    size = 0.31 if k % 2 == 0 else 0.15
                hole.append(corner(size * math.cos(angle), size * math.sin(angle) * 1.5))
            shell.ring(outer, hole)
    frame.lathe([(0.2, -0.01), (0.2, 0.03), (0.1, 0.06), (0.09, 0.1), (0.125, 0.13), (0.125, 0.15)], 32)
    frame.lathe([(0.125, 0.735), (0.14, 0.745), (0.14, 0.765), (0.1, 0.83), (0.04, 0.87), (0.022, 0.9), (0.035, 0.925), (0.004, 0.98)], 32)
    frame.bar([(0.06 * math.cos(math.pi * k / 10), 1.03 + 0.06 * math.sin(math.pi * k / 10), 0) for k in range(20)], (0, 0, 1), 0.014, 0.014, True)

    props.lathe([(0.1, -0.01), (0.17, 0.1), (0.2, 0.22), (0.17, 0.33), (0.09, 0.42), (0.075, 0.48), (0.1, 0.53)], 32, (-0.78, 0, -0.35))
    for radius, x, z in ((0.12, 0.62, 0.22), (0.075, 0.42, 0.48)):
        ball = [(radius * math.sin(math.pi * k / 12), radius - radius * math.cos(math.pi * k / 12)) for k in range(13)]
        props.lathe([(max(r, 0.001), y) for r, y in ball], 24, (x, 0, z))
    back, left = -1.0, -1.6
    walls.face((left, 0, back), (4, 0, back), (4, 3, back), (left, 3, back))
    walls.face((left, 0, back), (left, 3, back), (left, 3, 4), (left, 0, 4))
    for i in range(16):
        for j in range(14):
            x, z = left + 0.35 * i, back + 0.35 * j
            tiles[(i + j) % 2].face((x, 0, z), (x, 0, z + 0.35), (x + 0.35, 0, z + 0.35), (x + 0.35, 0, z))
    for name, mesh in (("shell", shell), ("frame", frame), ("props", props), ("walls", walls), ("tiles_light", tiles[0]), ("tiles_dark", tiles[1])):
        mesh.write(folder / "lattice_lamp" / f"{name}.obj")


def street_night(folder):
    """A street from z = 8 to z = -52 between two rows of gabled houses, with street lamps, a tree, benches, a car and one who walks."""
    random.seed(5)
    walls = Mesh(), Mesh(), Mesh()
    roofs, panes, ground, road, iron, wood, car, walker = Mesh(), Mesh(), Mesh(), Mesh(), Mesh(), Mesh(), Mesh(), Mesh()
    kerb, front, depth = 3.6, 6.2, 9.0

    def house(side, z, width, floors, wall, lit):
        """Its front at x = side * front from z to z - width; the windows of `lit` (bay, floor) are open to the room behind."""
        bays = max(2, round(width / 2.2))
        pitch, storey = width / bays, 3.0
        eaves = 0.4 + storey * floors

        def place(s, y, d):
            return side * (front + d), y, z - s
        for floor in range(floors):
            for b in range(bays):
                half, sill, head = (0.5, 0.95, 2.4) if floor or b else (0.55, 0.0, 2.3)
                base = 0.3 + storey * floor

                def shifted(s, y, d, base=base):
                    return place(s, base + y, d)
                low, middle = b * pitch, (b + 0.5) * pitch
                outline = opening(half, max(sill, 0.02), head)
                panel(wall, shifted, low, low + pitch, storey, middle, [(0.0, outline), (0.25, outline)])
                if (b, floor) not in lit:
                    pane = [(-half - 0.05, sill - 0.05), (half + 0.05, sill - 0.05), (half + 0.05, head + 0.05), (-half - 0.05, head + 0.05)]
                    panes.face(*[shifted(middle + x, y, 0.2) for x, y in pane])
                if sill > 0:
                    wood.bar([shifted(middle, sill - 0.1, 0.14), shifted(middle, head + 0.1, 0.14)], (1, 0, 0), 0.05, 0.06)
                    wood.bar([shifted(middle - half - 0.1, 1.85, 0.14), shifted(middle + half + 0.1, 1.85, 0.14)], (1, 0, 0), 0.05, 0.06)
                    wood.bar([shifted(middle - half - 0.12, sill - 0.06, -0.03), shifted(middle + half + 0.12, sill - 0.06, -0.03)], (1, 0, 0), 0.16, 0.12)
        back = front + depth
        ridge = eaves + 0.42 * depth
        gable = [(front, -0.2), (front, eaves - 0.04), ((front + back) / 2, ridge - 0.02), (back, eaves - 0.04), (back, -0.2)]
        for s in (z, z - width):
            wall.face(*[(side * x, y, s) for x, y in gable])
        wall.face(*[(side * back, y, s) for y, s in ((-0.2, z), (eaves, z), (eaves, z - width), (-0.2, z - width))])
        wall.face(*[(side * (front + 0.001), y, s) for y, s in ((-0.2, z), (0.31, z), (0.31, z - width), (-0.2, z - width))])
        slope = [(front - 0.45, eaves - 0.42), ((front + back) / 2, ridge), (back + 0.45, eaves - 0.42)]
        roofs.bar([(side * x, y, z - width / 2) for x, y in slope], (0, 0, 1), width + 0.12, 0.22)
        chimney = side * (front + depth * 0.3)
        roofs.box((chimney - 0.35, eaves, z - width * 0.3 - 0.4), (chimney + 0.35, ridge + 0.9, z - width * 0.3 + 0.4))

    for side in (-1, 1):
        z, k = 10.0, 0
        while z > -56:
            width = random.choice((6.6, 8.8, 6.6))
            lit = ()
            if side == 1 and k == 2:
                lit = ((0, 1), (1, 1), (2, 1), (1, 0), (2, 0))
            house(side, z, width, random.choice((2, 3, 2)) if not lit else 2, walls[(2 * k + (side > 0)) % 3], lit)
            z, k = z - width, k + 1
    far = z
    road.face((-kerb, 0, 14), (kerb, 0, 14), (kerb, 0, far), (-kerb, 0, far))
    for side in (-1, 1):
        x0, x1 = sorted((side * kerb, side * (front + depth)))
        ground.face((x0, 0.14, 14), (x1, 0.14, 14), (x1, 0.14, far), (x0, 0.14, far))
        ground.face((side * kerb, -0.1, 14), (side * kerb, 0.14, 14), (side * kerb, 0.14, far), (side * kerb, -0.1, far))

    post = Mesh()
    post.lathe([(0.2, 0.1), (0.2, 0.45), (0.11, 0.6), (0.07, 0.75), (0.055, 3.3), (0.1, 3.36), (0.1, 3.42), (0.05, 3.5), (0.13, 3.56), (0.13, 3.6)], 10)
    post.lathe([(0.34, 4.18), (0.36, 4.22), (0.12, 4.48), (0.05, 4.5), (0.06, 4.58), (0.01, 4.7)], 6)
    for k in range(6):
        p = 2 * math.pi * (k + 0.5) / 6
        post.tube((0.12 * math.cos(p), 3.57, 0.12 * math.sin(p)), (0.32 * math.cos(p), 4.2, 0.32 * math.sin(p)), 0.014, 0.014, 4)
    for x, z in STREET_LAMPS:
        iron.put(post, (x, 0, z))

    bench = Mesh()
    for k in range(4):
        bench.box((-0.8, 0.44, -0.2 + 0.11 * k), (0.8, 0.47, -0.11 + 0.11 * k))
    for k in range(3):
        bench.box((-0.8, 0.58 + 0.13 * k, -0.26 - 0.02 * k), (0.8, 0.68 + 0.13 * k, -0.235 - 0.02 * k))
    for x in (-0.65, 0.65):
        bench.box((x - 0.03, -0.1, -0.2), (x + 0.03, 0.45, 0.2))
        bench.bar([(x, 0.3, -0.2), (x, 0.98, -0.33)], (1, 0, 0), 0.05, 0.04)
    for x, z, turn in ((4.9, -3.4, -90), (-5.3, -13.0, 90)):
        wood.put(bench, (x, 0.14, z), turn)

    def branch(a, way, length, radius, level):
        b = add(a, way, length)
        wood.tube(a, b, radius, radius * 0.7, 7 if level < 2 else 4)
        if level == 5:
            return
        for k in range(3 if level in (1, 3) else 2):
            turn = tuple(random.uniform(-1, 1) for _ in range(3))
            wider = unit(add(add(way, turn, 0.62), (0, 0.16, 0)))
            branch(add(b, way, -0.05 * length), wider, length * random.uniform(0.66, 0.85), radius * 0.66, level + 1)
    branch((-4.7, 0.0, -2.0), (0.03, 1, 0), 1.7, 0.15, 0)

    outline = [(-2.1, 0.35), (-2.15, 0.75), (-1.95, 0.95), (-1.0, 1.0), (-0.45, 1.45), (0.9, 1.48), (1.5, 1.02), (2.1, 0.95), (2.2, 0.6), (2.15, 0.35)]
    body = Mesh()
    for side in (-1, 1):
        flank = [(side * (0.82 if y < 1.1 else 0.62), y, z) for z, y in outline]
        for k in range(len(flank) - 1):
            body.face((side * 0.82, 0.35, 0), flank[k], flank[k + 1])
    sides = [[(side * (0.82 if y < 1.1 else 0.62), y, z) for z, y in outline] for side in (-1, 1)]
    body.strip(*sides, closed=True)
    for x in (-0.72, 0.72):
        for z in (-1.35, 1.35):
            body.tube((x - 0.12, 0.33, z), (x + 0.12, 0.33, z), 0.33, 0.33, 16)
    for x in (-0.58, 0.58):  # a reflector that is open in front
        low, high = (x - 0.13, 0.6, 2.12), (x + 0.13, 0.82, 2.42)
        rim = [[(px, py, z) for px, py in ((low[0], low[1]), (high[0], low[1]), (high[0], high[1]), (low[0], high[1]))] for z in (low[2], high[2])]
        body.strip(*rim, closed=True)
        body.face(*rim[0])
    car.put(body, CAR[0], CAR[1])

    walker.lathe([(0.1, 0.0), (0.12, 0.08), (0.09, 0.5), (0.1, 0.8)], 8, (-0.02, 0, -0.17))
    walker.lathe([(0.1, 0.0), (0.12, 0.08), (0.09, 0.5), (0.1, 0.8)], 8, (0.03, 0, 0.2))
    walker.lathe([(0.34, 0.5), (0.27, 0.9), (0.21, 1.15), (0.24, 1.38), (0.17, 1.48), (0.06, 1.53), (0.06, 1.58)], 12)
    walker.lathe([(0.04, 1.54), (0.1, 1.6), (0.115, 1.7), (0.17, 1.73), (0.17, 1.75), (0.11, 1.76), (0.1, 1.86), (0.02, 1.87)], 12)
    person = Mesh()
    person.put(walker, WALKER, 75)
    for name, mesh in (("walls_0", walls[0]), ("walls_1", walls[1]), ("walls_2", walls[2]), ("roofs", roofs), ("panes", panes), ("pavement", ground),
                       ("road", road), ("iron", iron), ("wood", wood), ("car", car), ("walker", person)):
        mesh.write(folder / "street_night" / f"{name}.obj")


STREET_LAMPS = (4.2, -12.0), (-4.2, -4.5), (4.2, -27.0), (-4.2, -19.5), (-4.2, -36.0)
CAR = (-1.6, 0.0, -13.5), -3.0
WALKER = (-0.4, 0.0, -6.2)


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else __file__).resolve()
    folder = folder if len(sys.argv) > 1 else folder.parent
    cathedral(folder)
    lattice_lamp(folder)
    street_night(folder)


if __name__ == "__main__":
    main()
