// Multiple scattering along lines of particles (Szirmay-Kalos, Sbert and Umenhoffer 2005), in a form that keeps energy.

// What a link of optical depth `depth`, that of the particles' medium alone, and `all`, that of everything in it, does to a beam: it takes `lost` of it and
// gives `given` times the source of the particles; the particles at its ends take `given` times the beam and `kept` times the source. The mean radiance in
// a link is (1 - m) source + m beam, m its mean transmittance. Where nothing else is in it, lost = given and given + kept = depth: as much is taken as is sent.
FORMULA void link_shares(real depth, real all, OUT(real) lost, OUT(real) given, OUT(real) kept) {
  real ratio = select(all > 0.0, depth / max(all, 1e-30), real(1.0));
  lost = opacity(all);
  given = lost * ratio;
  real self = select(all < 0.25, all * all * fma(all, fma(all, fma(all, fma(all, 1.0 / 720.0, -1.0 / 120.0), 1.0 / 24.0), -1.0 / 6.0), 0.5), max(all - lost, 0.0));
  kept = self * ratio * ratio;
}

// Of so many bricks of cells in a row, the one where a coordinate in cells is; the outermost one outside.
FORMULA real source_brick(real coordinate, real cells, real bricks) {
  return max(min(floor(coordinate / cells), bricks - 1.0), 0.0);
}

// A source volume in a table: nodes an axis of a brick, the largest value, bricks an axis, where values begin; then of each brick, x fastest, its number among
// those that have nodes, -1 without; then their values, a brick after another, each a box of values a channel, x fastest. Linear an axis at a time between
// nodes, of which there are at least 2 an axis; bricks side by side have those between them in common, the outermost hold outside all. 0 in a brick without.
FORMULA real source_in_volume(table t, int channel, real x, real y, real z) {
  int values = integer_element(t, 7);
  real nx = element(t, 0);
  real ny = element(t, 1);
  real nz = element(t, 2);
  if (values < 10) return value_among_nodes(t + values, real(channel), nx, ny, nz, x, y, z);  // one brick
  real i = source_brick(x, nx - 1.0, element(t, 4));
  real j = source_brick(y, ny - 1.0, element(t, 5));
  real k = source_brick(z, nz - 1.0, element(t, 6));
  real number = fetch(t, fma(fma(k, element(t, 5), j), element(t, 4), i) + 8.0);
  real layer = fma(max(number, 0.0), 3.0, real(channel));
  real value = value_among_nodes(t + values, layer, nx, ny, nz, fma(-i, nx - 1.0, x), fma(-j, ny - 1.0, y), fma(-k, nz - 1.0, z));
  return select(number < 0.0, real(0.0), value);
}
