import math
import random

from mesh import Mesh, add, opening, panel, unit

KERB, FRONT, DEPTH, STOREY = 3.6, 6.2, 9.0, 3.0  # the first three are distances from the middle of the street
BASE, SILL = 0.02, 0.95  # of doors and of windows, above the floor
LAMPS = (4.2, -12.0), (-4.2, -4.5), (4.2, -27.0), (-4.2, -19.5), (-4.2, -36.0)  # (x, z)


def house(wall, roof, glass, wood, side, z, width, floors, lit):
    """Its front at x = side * FRONT from z to z - width; the windows of `lit` (bay, floor) are open to the room behind."""
    bays = round(width / 2.2)
    pitch, eaves = width / bays, 0.4 + STOREY * floors

    def place(s, y, d):
        return side * (FRONT + d), 0.3 + y, z - s
    for bay, floor in ((b, f) for f in range(floors) for b in range(bays)):
        is_door, head = floor == 0 and bay == 0, 2.4
        half, sill = (0.55, BASE) if is_door else (0.5, SILL)

        def at(s, y, d, base=STOREY * floor):
            return place(s, base + y, d)
        middle, outline = (bay + 0.5) * pitch, opening(half, SILL, head)
        if is_door:
            outline = [(-half, sill)] + outline
        panel(wall, at, bay * pitch, (bay + 1) * pitch, STOREY, middle, [(0.0, outline), (0.25, outline)], BASE)
        if (bay, floor) not in lit:
            a, b = half + 0.05, (sill - 0.05, head + 0.05)
            glass.face(*[at(middle + x, y, 0.2) for x, y in ((-a, b[0]), (a, b[0]), (a, b[1]), (-a, b[1]))])
        if not is_door:
            wood.bar([at(middle, sill - 0.1, 0.14), at(middle, head + 0.1, 0.14)], (1, 0, 0), 0.05, 0.06)
            for reach, y, d, size in ((0.1, 1.85, 0.14, (0.05, 0.06)), (0.12, sill - 0.06, -0.03, (0.16, 0.12))):
                wood.bar([at(middle - half - reach, y, d), at(middle + half + reach, y, d)], (1, 0, 0), *size)
    back, ridge = FRONT + DEPTH, eaves + 0.42 * DEPTH
    middle = (FRONT + back) / 2
    gable = [(FRONT, -0.2), (FRONT, eaves - 0.04), (middle, ridge - 0.02), (back, eaves - 0.04), (back, -0.2)]
    for s in (z - 0.01, z - width + 0.01):  # not in the plane of the next house's
        wall.face(*[(side * x, y, s) for x, y in gable])
    for x, top in ((back, eaves), (FRONT + 0.001, 0.31)):
        wall.face(*[(side * x, y, s) for y, s in ((-0.2, z), (top, z), (top, z - width), (-0.2, z - width))])
    slope = [(FRONT - 0.45, eaves - 0.42), (middle, ridge), (back + 0.45, eaves - 0.42)]
    roof.bar([(side * x, y, z - width / 2) for x, y in slope], (0, 0, 1), width + 0.12, 0.22)
    x, s = side * (FRONT + DEPTH * 0.3), z - width * 0.3
    roof.box((x - 0.35, eaves, s - 0.4), (x + 0.35, ridge + 0.9, s + 0.4))


def lamp_post():
    post = Mesh()
    post.lathe([(0.2, 0.1), (0.2, 0.45), (0.11, 0.6), (0.07, 0.75), (0.055, 3.3), (0.1, 3.36), (0.1, 3.42), (0.05, 3.5),
                (0.13, 3.56), (0.13, 3.6)], 10)
    post.lathe([(0.34, 4.18), (0.36, 4.22), (0.12, 4.48), (0.05, 4.5), (0.06, 4.58), (0.01, 4.7)], 6)
    for k in range(6):
        c, s = math.cos(math.pi * (k + 0.5) / 3), math.sin(math.pi * (k + 0.5) / 3)
        post.tube((0.12 * c, 3.57, 0.12 * s), (0.32 * c, 4.2, 0.32 * s), 0.014, 0.014, 4)
    return post


def bench():
    mesh = Mesh()
    for k in range(4):
        mesh.box((-0.8, 0.44, -0.2 + 0.11 * k), (0.8, 0.47, -0.11 + 0.11 * k))
    for k in range(3):
        mesh.box((-0.8, 0.58 + 0.13 * k, -0.26 - 0.02 * k), (0.8, 0.68 + 0.13 * k, -0.235 - 0.02 * k))
    for x in (-0.65, 0.65):
        mesh.box((x - 0.03, -0.1, -0.2), (x + 0.03, 0.45, 0.2))
        mesh.bar([(x, 0.3, -0.2), (x, 0.98, -0.33)], (1, 0, 0), 0.05, 0.04)
    return mesh


def tree(mesh, chance, a, way, length, radius, level=0):
    b = add(a, way, length)
    mesh.tube(a, b, radius, radius * 0.7, 7 if level < 2 else 4)
    if level < 5:
        for _ in range(3 if level in (1, 3) else 2):
            turn = [chance.uniform(-1, 1) for _ in range(3)]
            wider = unit(add(add(way, turn, 0.62), (0, 0.16, 0)))
            tree(mesh, chance, add(b, way, -0.05 * length), wider, length * chance.uniform(0.68, 0.86), radius * 0.66, level + 1)


def car():
    """Its headlamps, at (+-0.58, 0.71, 2.27), stand in boxes that are open in front."""
    mesh = Mesh()
    outline = [(-2.1, 0.35), (-2.15, 0.75), (-1.95, 0.95), (-1.0, 1.0), (-0.45, 1.45), (0.9, 1.48), (1.5, 1.02), (2.1, 0.95),
               (2.2, 0.6), (2.15, 0.35)]  # (z, y)
    flanks = [[(side * (0.82 if y < 1.1 else 0.62), y, z) for z, y in outline] for side in (-1, 1)]
    mesh.strip(*flanks, closed=True)
    for flank in flanks:
        for a, b in zip(flank, flank[1:]):
            mesh.face((flank[0][0], 0.35, 0), a, b)
    for x in (-0.72, 0.72):
        for z in (-1.35, 1.35):
            mesh.tube((x - 0.12, 0.33, z), (x + 0.12, 0.33, z), 0.33, 0.33, 16)
    for x in (-0.58, 0.58):
        rims = [[(x + px, py, z) for px, py in ((-0.13, 0.58), (0.13, 0.58), (0.13, 0.84), (-0.13, 0.84))] for z in (2.1, 2.52)]
        mesh.strip(*rims, closed=True)
        mesh.face(*rims[0])
    return mesh


def walker():
    mesh = Mesh()
    for x, z in ((-0.02, -0.17), (0.03, 0.2)):
        mesh.lathe([(0.1, 0.0), (0.12, 0.08), (0.09, 0.5), (0.1, 0.8)], 8, (x, 0, z))
    mesh.lathe([(0.34, 0.5), (0.27, 0.9), (0.21, 1.15), (0.24, 1.38), (0.17, 1.48), (0.06, 1.53), (0.06, 1.58)], 12)
    mesh.lathe([(0.04, 1.54), (0.1, 1.6), (0.115, 1.7), (0.17, 1.73), (0.17, 1.75), (0.11, 1.76), (0.1, 1.86), (0.02, 1.87)], 12)
    return mesh


def street_night():
    """A street between two rows of gabled houses, from z = 10 into the fog."""
    chance = random.Random(5)
    names = "walls_0 walls_1 walls_2 roofs panes pavement road iron wood car walker"
    all_meshes = {name: Mesh() for name in names.split()}
    roofs, panes, pavement, road, iron, wood, driven, walking = list(all_meshes.values())[3:]
    for side in (-1, 1):
        z, k = 10.0, 0
        while z > -56:
            width, floors = chance.choice((6.6, 8.8, 6.6)), chance.choice((2, 3, 2))
            lit = ((0, 1), (1, 1), (2, 1), (1, 0), (2, 0)) if (side, k) == (1, 2) else ()
            if lit:
                floors = 2
            house(all_meshes[f"walls_{(2 * k + (side > 0)) % 3}"], roofs, panes, wood, side, z, width, floors, lit)
            z, k = z - width, k + 1
        pavement.face(*[(side * x, 0.14, z) for x, z in ((KERB, 14), (FRONT + DEPTH, 14), (FRONT + DEPTH, -60), (KERB, -60))])
        pavement.face(*[(side * KERB, y, z) for y, z in ((-0.1, 14), (0.14, 14), (0.14, -60), (-0.1, -60))])
    road.face((-KERB, 0, 14), (KERB, 0, 14), (KERB, 0, -60), (-KERB, 0, -60))
    for x, z in LAMPS:
        iron.put(lamp_post(), (x, 0, z))
    for x, z, turn in ((4.9, -3.4, -90), (-5.3, -13.0, 90)):
        wood.put(bench(), (x, 0.14, z), turn)
    tree(wood, random.Random(2), (-4.7, 0.0, -2.0), (0.03, 1, 0), 1.7, 0.15)
    driven.put(car(), (-1.6, 0, -13.5), -3)
    walking.put(walker(), (-0.4, 0, -6.2), 75)
    return all_meshes
