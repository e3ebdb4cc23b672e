// Volumes of optical depth toward a light (common/algorithms/depth_volume.h), and how densities are put on the cells of a box.

// Which face of a cube about the origin a place is seen through: 2 axis + (1 where the axis points away); c, how far it is along that axis,
// a and b along the next two (x y z x y).
FORMULA real cube_face(real x, real y, real z, OUT(real) a, OUT(real) b, OUT(real) c) {
  real ax = abs(x);
  real ay = abs(y);
  real az = abs(z);
  mask on_x = ax >= ay && ax >= az;
  mask on_y = !on_x && ay >= az;
  c = select(on_x, ax, select(on_y, ay, az));
  a = select(on_x, y, select(on_y, z, x));
  b = select(on_x, z, select(on_y, x, y));
  real s = select(on_x, x, select(on_y, y, z));
  return select(on_x, real(0.0), select(on_y, real(2.0), real(4.0))) + select(s < 0.0, real(1.0), real(0.0));
}

// Planes of a cube about a light stand closer near it, where most is lit and depths bend within a cell: how far plane k is, in cells, and the other way
// round. Far away they are a cell apart.
FORMULA real cube_plane_distance(real k) {
  return k * k / (k + 8.0);
}
FORMULA real cube_plane_number(real distance) {
  return 0.5 * (distance + sqrt(distance * (distance + 32.0)));
}

// The optical depth at a place in the light's frame: a table of first, scale and nodes an axis (DepthVolume), then the depths, x fastest, plane by
// plane, face by face. Linear an axis at a time between nodes; the outermost hold outside. kind: the order of DepthVolume::Kind. A cube (3) holds depths
// beside the distance in cells: these are nearly the same from the light on. halves: not 0 where the depths are halves (common/half.h).
FORMULA real depth_in_volume(table t, int kind, int halves, real x, real y, real z) {
  real a = x;
  real b = y;
  real c = z;
  real face = 0.0;
  if (kind == 3) face = cube_face(x, y, z, a, b, c);
  if (kind >= 2) {
    real inverse = 1.0 / max(c, 1e-18);
    a = a * inverse;
    b = b * inverse;
  }
  real nx = element(t, 6);
  real ny = element(t, 7);
  real nz = element(t, 8);
  real i;
  real j;
  real k;
  real u;
  real v;
  real w;
  grid_lookup_clamped((a - element(t, 0)) * element(t, 3), nx, i, u);
  grid_lookup_clamped((b - element(t, 1)) * element(t, 4), ny, j, v);
  real plane = (c - element(t, 2)) * element(t, 5);
  if (kind == 3) plane = cube_plane_number(max(plane, 0.0));
  grid_lookup_clamped(plane, nz, k, w);
  real layer = fma(face, nz, k);
  real depth;
  if (halves != 0) depth = weighted_half_cell(t + 9, i, j, layer, nx, ny, u, v, w);
  else depth = weighted_cell(t + 9, i, j, layer, nx, ny, u, v, w);
  if (kind == 3) depth = depth * cube_plane_distance(k + w);
  return depth;
}

// What a cube holds at the light, by the first two planes: as far along the straight line through them.
FORMULA real depth_at_light(real first, real second) {
  real slope = (second - first) / (cube_plane_distance(2.0) - cube_plane_distance(1.0));
  return max(first - slope * cube_plane_distance(1.0), 0.0);
}

// A node's depth given those before and after it along an axis: linear lookups between such values have the mean of what lies there, to fourth order,
// where depths themselves would be off by a twelfth of their second difference.
FORMULA real sharpened_depth(real before, real here, real after) {
  return max(here - ((after - here) - (here - before)) * (1.0 / 12.0), 0.0);
}

// Of an axis of a Gaussian: its mean over a cell of width `cell` whose centre is `offset` away [m], beside its value at the centre, so that nothing of it
// is lost however small it is (0.2 % is won where it is about as small as a cell, by values held at 0). Of one that the cells resolve, an eighth of the second difference is taken off: a mean over a cell takes (k h)^2 / 24 of a
// wave, linear lookups between cells (k h)^2 / 12, and so the optical depth of whole rays is right to fourth order.
FORMULA real injected_gaussian(real inverse_radius, real offset, real cell) {
  real width = cell * inverse_radius;
  real x = offset * inverse_radius;
  real a = erf_(fma(width, -1.5, x));
  real b = erf_(fma(width, -0.5, x));
  real c = erf_(fma(width, 0.5, x));
  real d = erf_(fma(width, 1.5, x));
  real sharpness = min(max(4.0 / (3.0 * width) - 1.0, 0.0), 1.0) * 0.125;
  real here = c - b;
  real bend = (d - c - here) - (here - (b - a));
  return max(fma(-sharpness, bend, here), 0.0) * (0.88622692545275801 / width);
}

// Giroud and Biri, eq. 6: the depth at a cell is this and wx / weights times that of the neighbour toward the light along x. own: extinction times the
// cell's size; others: the depths of the other two neighbours times their weights; weights: the sum of all three, the cosines of the light's way with the
// axes, > 0. scheme: the order of DepthScheme: as printed, with the cell's size put in; consistent, grad T . way = extinction by differences.
FORMULA real depth_beside(int scheme, real own, real others, real weights) {
  if (scheme == 0) return own + others / weights;
  return (own + others) / weights;
}

// Of a cell's size: nearer to the light along an axis than that, a cell gets nothing from its neighbour there, which the light does not shine through.
FORMULA real slab_share() { return 0.5001; }
