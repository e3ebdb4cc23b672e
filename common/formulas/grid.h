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
