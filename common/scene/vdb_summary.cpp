#include "common/scene/vdb_summary.h"

#include <algorithm>

#include "common/error.h"
#include "common/scene/files.h"
#include "common/scene/vdb_values.h"

namespace airlight {

namespace {

// "Tree_vec3s_5_4_3" without what all have.
std::string short_type(std::string type) {
  if (type.starts_with("Tree_")) type.erase(0, 5);
  if (type.ends_with("_5_4_3")) type.resize(type.size() - 6);
  return printable(type);
}

}  // namespace

std::vector<VdbSummary> summarise_vdb(const std::string& path, Progress& progress) {
  const std::string bytes = read_file(path, std::uint64_t{8} << 30U);
  const VdbFile file = vdb_layout(path, bytes);
  std::vector<VdbSummary> all;
  for (const VdbGrid& grid : file.grids) {
    VdbSummary s;
    s.name = printable(grid.name), s.type = short_type(grid.type), s.half = grid.half;
    if (!VdbValues::reads(grid.type) && !grid.instance) {
      s.unread = "values of this type are not read";
      all.push_back(std::move(s));
      continue;
    }
    try {
      const VdbValues values(path, bytes, file, grid, progress);
      s.grid_class = printable(values.grid_class()), s.active = values.active(), s.transform = values.transform();
      bool first = true;
      values.each(
          [&](const VdbCells& cells) {
            s.least = first ? cells.least : glm::min(s.least, cells.least);
            s.most = first ? cells.most : glm::max(s.most, cells.most);
            s.lowest = first ? cells.value : std::min(s.lowest, cells.value);
            s.highest = first ? cells.value : std::max(s.highest, cells.value);
            first = false;
          },
          progress);
    } catch (const InputError& e) {
      s.unread = e.what();
    }
    all.push_back(std::move(s));
  }
  return all;
}

}  // namespace airlight
