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

// A source volume in a table: nodes an axis, the largest value, then a box of values a channel, x fastest. Linear an axis at a time between nodes, of which
// there are at least 2 an axis; the outermost hold outside.
FORMULA real source_in_volume(table t, int channel, real x, real y, real z) {
  return value_among_nodes(t + 4, channel, element(t, 0), element(t, 1), element(t, 2), x, y, z);
}
