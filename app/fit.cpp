#include <fmt/format.h>

#include <filesystem>
#include <thread>

#include "app/command.h"
#include "common/fit/depth_error.h"
#include "common/fit/fit_gaussians.h"
#include "common/scene/gaussians_file.h"
#include "common/scene/grid_file.h"
#include "cpu/parallel.h"

namespace airlight {

namespace {

constexpr int rays = 2000;  // that optical depths are compared on

}  // namespace

int fit(const FitCommand& c, Terminal& terminal) {
  if (std::filesystem::path(c.output).extension() != ".ply") throw InputError(c.output + ": expected a name that ends with .ply");
  const SparseGrid grid = read_sparse_grid(c.input, c.name, terminal);
  Workers workers(c.threads > 0 ? c.threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency())));
  const EachIndex each = [&](int n, const std::function<void(int)>& body) { workers.each(n, [&](int i, int) { body(i); }); };
  GaussiansFile file;
  const Fit fitted = fit_gaussians(grid, c.input, {.count = c.count, .steps = c.steps}, each, terminal);
  file.gaussians = fitted.gaussians;
  write_gaussians_file(c.output, file,
                       fmt::format("airlight fit: {} Gaussians, relative L2 error of the density {:.3g}", file.gaussians.size(),
                                   fitted.density_error));
  if (c.quiet) return 0;

  fmt::print("{} Gaussians; relative L2 error: density {:.3f} %", file.gaussians.size(), 100 * fitted.density_error);
  if (grid.size(0) * grid.size(1) * grid.size(2) > static_cast<double>(most_cells)) {
    fmt::print(" (optical depth: not told, for a box of more than {} cells)\n", most_cells);
    return 0;
  }
  // Only here the grid becomes dense.
  const GridFile dense = dense_grid(grid, c.input, terminal);
  GridMedium medium;
  medium.voxels = dense.voxels, medium.transform = dense.transform;
  fmt::print(", optical depth {:.3f} % on {} random rays\n", 100 * relative_depth_error(file.gaussians, medium, rays), rays);
  return 0;
}

}  // namespace airlight
