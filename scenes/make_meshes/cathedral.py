import math

from mesh import Mesh, add, arch, opening, panel, pointed, unit


def floor(tiles, west):
    """Squares of 1.4 m, in turn in one mesh and in the other; they end within the walls."""
    for i in range(13):
        for j in range(35):
            x, z = -9.1 + 1.4 * i, west - 1.4 * j
            tiles[(i + j) % 2].face((x, 0, z), (x + 1.4, 0, z), (x + 1.4, 0, z - 1.4), (x, 0, z - 1.4))


def benches(pews):
    for row in range(13):
        z = 4.5 - 2.2 * row
        for side in (-1, 1):
            x0, x1 = sorted((side * 1.15, side * 3.25))
            pews.box((x0, 0.4, z - 0.24), (x1, 0.46, z + 0.24))
            pews.box((x0, 0.3, z + 0.22), (x1, 0.95, z + 0.28))
            for x in (x0, x1):
                pews.box((x - 0.04, -0.1, z - 0.3), (x + 0.04, 1.02, z + 0.33))


def chandeliers(iron):
    for z in (3.0, -9.0, -21.0):
        circle = [(0.75 * math.cos(math.pi * k / 8), 5.0, z + 0.75 * math.sin(math.pi * k / 8)) for k in range(16)]
        iron.bar(circle, (0, 1, 0), 0.1, 0.04, True)
        for k in range(0, 16, 4):
            iron.tube(circle[k], (0, 6.2, z), 0.015, 0.015, 4)
        iron.tube((0, 6.15, z), (0, 14.8, z), 0.025, 0.025, 4)


def cathedral():
    """A hall church of three naves, eight bays of 6 m from z = 12 to z = -36; windows in the south (+X), north and east (-Z)."""
    nave, aisle, bay, spring, rise, wall = 4.2, 2.1, 3.0, 9.0, 5.6, 8.4
    stone, vault, pews, iron = Mesh(), Mesh(), Mesh(), Mesh()
    tiles = Mesh(), Mesh()
    centres = [9 - 6 * k for k in range(8)]
    east, west, top = -36.0, 12.0, 14.9

    def window(place, low, high, half, sill, head, height):
        panel(stone, place, low, high, top, (low + high) / 2,
              [(0.0, opening(half + 0.35, sill - 0.5, head - 0.1, height + 0.5)), (0.6, opening(half, sill, head, height))])
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
    pier = [(0.85, 0), (0.85, 0.3), (0.72, 0.5), (0.52, 0.62), (0.5, 8.3), (0.56, 8.45), (0.8, 9.0), (0.8, 9.25)]
    for cz in [c - bay for c in centres] + [west]:
        arc = [(x, rise * y / 1.3) for x, y in pointed(1.0, 1.3, 7)]
        for cx, a in ((0, nave), (-nave - aisle, aisle), (nave + aisle, aisle)):
            stone.bar([(cx + a * u, spring + y - 0.16, cz) for u, y in arc], (0, 0, 1), 0.42, 0.46)
        for side in (-1, 1):
            stone.lathe(pier, 20, (side * nave, 0, cz), lobes)
            stone.lathe([(0.5, 0), (0.5, 0.4), (0.3, 0.6), (0.3, 8.4), (0.5, 9.0), (0.5, 9.2)], 10, (side * (wall - 0.05), 0, cz))

    def place_east(s, y, depth):
        return s, y, east - depth
    window(place_east, -nave, nave, 2.6, 3.4, 7.6, 4.6)
    for side in (-1, 1):
        window(place_east, *sorted((side * nave, side * wall)), 0.9, 2.4, 7.2, 2.4)
    stone.box((-10, -0.1, west), (10, top, west + 0.5))
    for side in (-1, 1):  # where walls meet in a corner
        x0, x1 = sorted((side * (wall - 0.05), side * (wall + 1)))
        stone.box((x0, -0.1, east - 1), (x1, top, east + 0.05))
    stone.box((-10, 14.7, east - 1), (10, 15.2, west + 0.5))  # the roof
    stone.box((-nave - 0.5, -0.1, east - 0.1), (nave + 0.5, 0.3, -28.8))  # two steps and the altar
    stone.box((-nave + 0.4, -0.2, east - 0.1), (nave - 0.4, 0.6, -29.8))
    stone.box((-1.3, 0.5, -33.2), (1.3, 1.5, -32.2))
    stone.box((-1.5, 1.4, -33.3), (1.5, 1.62, -32.1))
    floor(tiles, west)
    benches(pews)
    chandeliers(iron)
    return {"stone": stone, "vault": vault, "pews": pews, "iron": iron, "tiles_light": tiles[0], "tiles_dark": tiles[1]}
