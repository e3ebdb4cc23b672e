import random

from mesh import Mesh

BLOCK, STREET, BLOCKS = 44.0, 18.0, 6  # [m]; so many blocks a side
PITCH = BLOCK + STREET
SQUARE = (2, 3)  # the block that is left open


def middle(i):
    return (i - (BLOCKS - 1) / 2) * PITCH


def tower(mesh, x, z, wide, deep, height, steps):
    """Boxes on boxes, each smaller, a little sunk into the one below."""
    low = -1.0
    for k in range(steps):
        top = height * (k + 1) / steps
        mesh.box((x - wide / 2, low, z - deep / 2), (x + wide / 2, top, z + deep / 2))
        low, wide, deep = top - 0.5, wide * 0.74, deep * 0.74
    return low + 0.5


def spire(mesh, x, z, base, height, radius):
    mesh.lathe([(radius, base - 0.5), (radius * 0.8, base + height * 0.2), (radius * 0.2, base + height * 0.55), (0.05, base + height)],
               8, (x, 0, z))


def fog_city():
    """Blocks of towers about an open square, in which an obelisk stands."""
    chance = random.Random(12)
    city, ground = Mesh(), Mesh()
    for i in range(BLOCKS):
        for j in range(BLOCKS):
            x, z = middle(i), middle(j)
            if (i, j) == SQUARE:
                city.box((x - 3, -1, z - 3), (x + 3, 2, z + 3))
                spire(city, x, z, 2, 22, 1.8)
                continue
            parts = chance.choice((1, 2, 2))
            side = BLOCK / parts
            for a in range(parts):
                for b in range(parts):
                    wide, deep = (side - chance.uniform(2, 6) for _ in range(2))
                    away = abs(i - 2.5) + abs(j - 2.5)
                    height = chance.uniform(14, 30) + max(0.0, 62 - 17 * away) * chance.uniform(0.3, 1.0)
                    steps = 1 if height < 24 else chance.choice((2, 3))
                    cx, cz = x + (a - (parts - 1) / 2) * side, z + (b - (parts - 1) / 2) * side
                    top = tower(city, cx, cz, wide, deep, height, steps)
                    if height > 55:
                        spire(city, cx, cz, top, height * 0.35, min(wide, deep) * 0.1)
    edge = 700.0
    ground.face((-edge, 0, -edge), (-edge, 0, edge), (edge, 0, edge), (edge, 0, -edge))
    return {"city": city, "ground": ground}
