"""What the scenes are made of: a triangle soup that knows boxes, lathes, bars and walls with windows."""
import math


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
            before, other = (outer, inner)[side][at[side]][2], (inner, outer)[side][at[1 - side]][2]
            here = (outer, inner)[side][k][2]
            self.triangles.append((before, here, other) if side == 0 else (here, before, other))  # turned alike
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
            corners = ((-width, -height), (width, -height), (width, height), (-width, height))
            lines.append([add(add(p, normal, w / 2), side, h / 2) for w, h in corners])
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
        path.write_text("\n".join(["# Made by scenes/make_meshes"] + vertices + faces) + "\n")
        print(f"{path}: {len(faces)} triangles, {path.stat().st_size / 1000:.0f} kB")


def arch(half, rise, n):
    """The left arc of a pointed arch, from (-half, 0) to (0, rise): (x, y)."""
    radius = (half * half + rise * rise) / (2 * half)
    end = math.atan2(rise, radius - half)
    return [(radius - half - radius * math.cos(end * k / n), radius * math.sin(end * k / n)) for k in range(n)] + [(0.0, rise)]


def pointed(half, rise, n):
    left = arch(half, rise, n)
    return left + [(-x, y) for x, y in reversed(left[:-1])]


def opening(half, sill, spring, rise=0.0, n=6):
    """The left side of a window, from its sill up; the right one is its mirror image."""
    return [(-half, sill)] + ([(x, spring + y) for x, y in arch(half, rise, n)] if rise > 0 else [(-half, spring)])


def panel(mesh, place, low, high, top, middle, holes, base=0.0):
    """A wall from s = low to high and y = 0 to top with one window about s = middle. `holes`: for each of its two faces a depth
    and the outline of the window. `place` maps (s, y, depth) to a point. The vertices at its sides, as high as those of the
    outline and at y = base, are to be those of its neighbours: between others a rasteriser leaves cracks."""
    rims = []
    for depth, outline in holes:
        def at(s, y, depth=depth):
            return place(s, y, depth)
        left, right = [[at(middle + sign * x, y) for x, y in outline] for sign in (1, -1)]
        for side, rim in ((low, left), (high, right)):
            mesh.strip([at(side, y) for _, y in outline], rim)
        bottom, head = outline[0][1], outline[-1][1]
        if base > 0:
            mesh.face(at(low, 0), at(high, 0), at(high, base), at(low, base))
        if bottom > base:
            mesh.face(at(low, base), at(high, base), at(high, bottom), right[0], left[0], at(low, bottom))
        over = [left[-1]] if outline[-1][0] == 0 else [left[-1], right[-1]]
        mesh.face(at(low, top), at(low, head), *over, at(high, head), at(high, top))
        rims.append(left + right[::-1][1 if outline[-1][0] == 0 else 0:])
    mesh.strip(*rims, closed=True)
