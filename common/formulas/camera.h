// The ray of a pixel.

// The sample of pixel column i (from the left) of width lies at x on the image plane one unit in front of the camera.
FORMULA real image_plane_x(real i, real offset, real width, real height, real tan_half_fov) {
  return ((i + 0.5 + offset) * (2.0 / width) - 1.0) * (tan_half_fov * (width / height));
}

// The same for row j, counted from the top.
FORMULA real image_plane_y(real j, real offset, real height, real tan_half_fov) {
  return (1.0 - (j + 0.5 + offset) * (2.0 / height)) * tan_half_fov;
}
