// The point where a ray from the camera meets the plane of a triangle.

// Ray from the origin along the unit vector d; triangle a b c relative to the same origin. Gives the distance along the
// ray and the weights of b and c (that of a is what is left of 1). A rasteriser rounds vertices to 1/256 pixel, so a covered
// pixel's ray may pass just outside: weights are held inside the triangle, and the distance at most that of the farthest vertex,
// which bounds it where the triangle is seen edge-on.
FORMULA void ray_triangle(real dx, real dy, real dz, real ax, real ay, real az, real bx, real by, real bz,
                          real cx, real cy, real cz, OUT(real) distance, OUT(real) weight_b, OUT(real) weight_c) {
  real ux = bx - ax; real uy = by - ay; real uz = bz - az;
  real vx = cx - ax; real vy = cy - ay; real vz = cz - az;
  real nx = uy * vz - uz * vy;
  real ny = uz * vx - ux * vz;
  real nz = ux * vy - uy * vx;
  real cosine = abs(nx * dx + ny * dy + nz * dz);
  real plane = abs(nx * ax + ny * ay + nz * az);
  real far2 = max(max(ax * ax + ay * ay + az * az, bx * bx + by * by + bz * bz), cx * cx + cy * cy + cz * cz);
  distance = min(plane / max(cosine, 1e-37), sqrt(far2));
  // Weights from the point itself, by projection on the triangle's plane: (p - a) x v . n / n.n and u x (p - a) . n / n.n.
  real px = dx * distance - ax; real py = dy * distance - ay; real pz = dz * distance - az;
  real n2 = max(nx * nx + ny * ny + nz * nz, 1e-37);
  real wb = ((py * vz - pz * vy) * nx + (pz * vx - px * vz) * ny + (px * vy - py * vx) * nz) / n2;
  real wc = ((uy * pz - uz * py) * nx + (uz * px - ux * pz) * ny + (ux * py - uy * px) * nz) / n2;
  weight_b = min(max(wb, 0.0), 1.0);
  weight_c = min(max(wc, 0.0), 1.0 - weight_b);
}

// Unit normal at a point of the triangle from those of its corners, turned against the ray d. Where they cancel: against the ray.
FORMULA void shading_normal(real dx, real dy, real dz, real ax, real ay, real az, real bx, real by, real bz,
                            real cx, real cy, real cz, real weight_b, real weight_c, OUT(real) nx, OUT(real) ny, OUT(real) nz) {
  real weight_a = 1.0 - weight_b - weight_c;
  real x = fma(ax, weight_a, fma(bx, weight_b, cx * weight_c));
  real y = fma(ay, weight_a, fma(by, weight_b, cy * weight_c));
  real z = fma(az, weight_a, fma(bz, weight_b, cz * weight_c));
  real n2 = fma(x, x, fma(y, y, z * z));
  mask well = n2 > 1e-12;
  real toward = fma(x, dx, fma(y, dy, z * dz));
  real s = select(toward > 0.0, real(-1.0), real(1.0)) / sqrt(max(n2, 1e-12));
  nx = select(well, x * s, -dx);
  ny = select(well, y * s, -dy);
  nz = select(well, z * s, -dz);
}

// Which side of the triangle that is: 1 where shading_normal() leaves the normals as they are, -1 where it turns them.
FORMULA real seen_side(real dx, real dy, real dz, real ax, real ay, real az, real bx, real by, real bz,
                       real cx, real cy, real cz, real weight_b, real weight_c) {
  real weight_a = 1.0 - weight_b - weight_c;
  real x = fma(ax, weight_a, fma(bx, weight_b, cx * weight_c));
  real y = fma(ay, weight_a, fma(by, weight_b, cy * weight_c));
  real z = fma(az, weight_a, fma(bz, weight_b, cz * weight_c));
  return select(fma(x, dx, fma(y, dy, z * dz)) > 0.0, real(-1.0), real(1.0));
}

// Between values at the corners.
FORMULA real between_corners(real a, real b, real c, real weight_b, real weight_c) {
  return fma(c - a, weight_c, fma(b - a, weight_b, a));
}
