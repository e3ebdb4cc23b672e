import math

from mesh import Mesh


def lattice_lamp():
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

            def corner(s, t, middle=middle, row=row):
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
    frame.lathe([(0.125, 0.735), (0.14, 0.745), (0.14, 0.765), (0.1, 0.83), (0.04, 0.87), (0.022, 0.9), (0.035, 0.925),
                 (0.004, 0.98)], 32)
    handle = [(0.06 * math.cos(math.pi * k / 10), 1.03 + 0.06 * math.sin(math.pi * k / 10), 0) for k in range(20)]
    frame.bar(handle, (0, 0, 1), 0.014, 0.014, True)

    pot = [(0.1, -0.01), (0.17, 0.1), (0.2, 0.22), (0.17, 0.33), (0.09, 0.42), (0.075, 0.48), (0.1, 0.53)]
    props.lathe(pot, 32, (-0.78, 0, -0.35))
    for radius, x, z in ((0.12, 0.62, 0.22), (0.075, 0.42, 0.48)):
        ball = [(radius * math.sin(math.pi * k / 12), radius - radius * math.cos(math.pi * k / 12)) for k in range(13)]
        props.lathe([(max(r, 0.001), y) for r, y in ball], 24, (x, 0, z))
    back, left = -1.0, -1.6
    walls.face((left, -0.1, back), (4, -0.1, back), (4, 3, back), (left, 3, back))
    walls.face((left, -0.1, back), (left, 3, back), (left, 3, 4), (left, -0.1, 4))
    for i in range(16):
        for j in range(14):
            x, z = left - 0.1 + 0.35 * i, back - 0.1 + 0.35 * j
            tiles[(i + j) % 2].face((x, 0, z), (x, 0, z + 0.35), (x + 0.35, 0, z + 0.35), (x + 0.35, 0, z))
    return {"shell": shell, "frame": frame, "props": props, "walls": walls, "tiles_light": tiles[0], "tiles_dark": tiles[1]}
