// The ray of a pixel.

// The sample of pixel column i (from the left) of width lies at x on the image plane one unit in front of the camera.
FORMULA real image_plane_x(real i, real offset, real width, real height, real tan_half_fov) {
  return ((i + 0.5 + offset) * (2.0 / width) - 1.0) * (tan_half_fov * (width / height));
}

// The same for row j, counted from the top.
FORMULA real image_plane_y(real j, real offset, real height, real tan_half_fov) {
  return (1.0 - (j + 0.5 + offset) * (2.0 / height)) * tan_half_fov;
}

// Unit direction x right + y up + forward.
FORMULA void view_ray(real x, real y, real rx, real ry, real rz, real ux, real uy, real uz, real fx, real fy, real fz,
                      OUT(real) dx, OUT(real) dy, OUT(real) dz) {
  real s = 1.0 / sqrt(fma(x, x, fma(y, y, 1.0)));
  dx = fma(x, rx, fma(y, ux, fx)) * s;
  dy = fma(x, ry, fma(y, uy, fy)) * s;
  dz = fma(x, rz, fma(y, uz, fz)) * s;
}

// A point (relative to the ray's origin) seen from the unit ray d: `foot` is where its perpendicular meets the ray, may be negative;
// `squared` the square of its distance from the ray. By the perpendicular vector: |p|^2 - foot^2 would cancel.
FORMULA void perpendicular_squared(real dx, real dy, real dz, real px, real py, real pz, OUT(real) foot, OUT(real) squared) {
  foot = fma(dx, px, fma(dy, py, dz * pz));
  real ex = fma(-foot, dx, px);
  real ey = fma(-foot, dy, py);
  real ez = fma(-foot, dz, pz);
  squared = fma(ex, ex, fma(ey, ey, ez * ez));
}

// The same with the distance itself, `h`, at least `least`.
FORMULA void perpendicular(real dx, real dy, real dz, real px, real py, real pz, real least, OUT(real) foot, OUT(real) h) {
  real squared;
  perpendicular_squared(dx, dy, dz, px, py, pz, foot, squared);
  h = max(sqrt(squared), least);
}
