// Voxel grids. Value k of n covers [k, k+1) * size / n from the corner of the box and is sampled at its centre. A lookup is linear
// between the two nearest centres, an axis at a time: (1 - weight) * value[lower] + weight * value[lower + 1].

// Position in cells: 0 at the first centre, n - 1 at the last. x and size in metres, x from the corner.
FORMULA real grid_coordinate(real x, real size, real n) {
  return x * (n / size) - 0.5;
}

// For extinction: a ring of zero cells lies around the grid, so that it falls to 0 half a cell outside the box. `lower` is in -1..n-1;
// the values at -1 and n are zero. Farther out both values are zero.
FORMULA void grid_lookup_zero(real coordinate, real n, OUT(real) lower, OUT(real) weight) {
  real c = min(max(coordinate, -1.0), n);
  lower = min(floor(c), n - 1.0);
  weight = c - lower;
}

// For optical depth: the outermost values hold outside. `lower` is in 0..max(n-2, 0).
FORMULA void grid_lookup_clamped(real coordinate, real n, OUT(real) lower, OUT(real) weight) {
  real c = min(max(coordinate, 0.0), n - 1.0);
  lower = min(floor(c), max(n - 2.0, 0.0));
  weight = c - lower;
}

// Between nodes, so many an axis, x fastest, at a place told in nodes; `layer`: of boxes of nodes one behind the other. The outermost hold outside.
FORMULA real value_among_nodes(table t, real layer, real nx, real ny, real nz, real x, real y, real z) {
  real i;
  real j;
  real k;
  real u;
  real v;
  real w;
  grid_lookup_clamped(x, nx, i, u);
  grid_lookup_clamped(y, ny, j, v);
  grid_lookup_clamped(z, nz, k, w);
  return weighted_cell(t, i, j, fma(layer, nz, k), nx, ny, u, v, w);
}

// A grid of extinctions in a table: the numbers of cells nx, ny, nz, then (nx+2) (ny+2) (nz+2) values, x fastest: the grid in its ring of
// zeros, halves (common/half.h) or, where `halves` is 0, floats. c in cells as from grid_coordinate(); exactly 0 from half a cell outside the box on.
FORMULA real grid_extinction(table t, int halves, real cx, real cy, real cz) {
  real nx = element(t, 0);
  real ny = element(t, 1);
  real i;
  real j;
  real k;
  real u;
  real v;
  real w;
  grid_lookup_zero(cx, nx, i, u);
  grid_lookup_zero(cy, ny, j, v);
  grid_lookup_zero(cz, element(t, 2), k, w);
  if (halves != 0) return weighted_half_cell(t + 3, i + 1.0, j + 1.0, k + 1.0, nx + 2.0, ny + 2.0, u, v, w);
  return weighted_cell(t + 3, i + 1.0, j + 1.0, k + 1.0, nx + 2.0, ny + 2.0, u, v, w);
}

// Which brick of four lookups a coordinate falls in.
FORMULA real grid_brick(real coordinate, real n) {
  return floor((min(floor(max(coordinate, -1.0)), n - 1.0) + 1.0) * 0.25);
}

// Bricks of 4 x 4 x 4 lookups: the numbers of bricks an axis, then for each the largest value that a lookup in it can meet, x fastest. Where
// it is 0, so is grid_extinction(). nx, ny, nz: cells.
FORMULA real grid_bound(table bricks, real cx, real cy, real cz, real nx, real ny, real nz) {
  real row = fma(grid_brick(cz, nz), element(bricks, 1), grid_brick(cy, ny));
  return fetch(bricks, fma(row, element(bricks, 0), grid_brick(cx, nx)) + 3.0);
}
