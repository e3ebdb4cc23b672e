#include "common/scene/grid_file.h"

#include <fmt/format.h>
#include <openvdb/Grid.h>
#include <openvdb/io/io.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <istream>
#include <new>
#include <streambuf>

#include "common/error.h"
#include "common/scene/files.h"
#include "common/scene/sha256.h"
#include "common/scene/vdb_layout.h"

namespace airlight {

namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{8} << 30U;
constexpr std::string_view loading = "loading the grid";

// Bytes in memory as a stream for OpenVDB, which ends where the tree does.
class Bytes final : public std::streambuf {
 public:
  Bytes(std::string_view bytes, Progress& progress) : progress_(progress) {
    char* const begin = const_cast<char*>(bytes.data());  // a get area is never written to
    setg(begin, begin, begin + bytes.size());
  }

 private:
  std::streamsize xsgetn(char* to, std::streamsize size) override {
    progress_.check();
    const auto read = gptr() - eback(), all = egptr() - eback();
    if (read >= reported_) {
      progress_.report(loading, 0.5 * static_cast<double>(read) / static_cast<double>(all));
      reported_ = read + all / 64;
    }
    return std::streambuf::xsgetn(to, size);
  }
  pos_type seekoff(off_type by, std::ios_base::seekdir from, std::ios_base::openmode) override {
    const off_type size = egptr() - eback(), base = from == std::ios_base::beg   ? 0
                                                    : from == std::ios_base::cur ? gptr() - eback()
                                                                                 : size;
    if (by < -base || by > size - base) return pos_type(off_type(-1));
    setg(eback(), eback() + base + by, egptr());
    return pos_type(base + by);
  }
  pos_type seekpos(pos_type to, std::ios_base::openmode mode) override { return seekoff(off_type(to), std::ios_base::beg, mode); }

  Progress& progress_;
  std::ptrdiff_t reported_ = 0;
};

// Calls visit(box of cells, value) for every active value: leaves cell by cell, tiles whole.
template <class Grid, class Visit>
void each_value(const Grid& grid, const Progress& progress, Visit&& visit) {
  const auto& tree = grid.tree();
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
    progress.check();
    for (auto value = leaf->cbeginValueOn(); value; ++value) {
      const openvdb::Coord c = value.getCoord();
      visit(openvdb::CoordBBox(c, c), *value);
    }
  }
  auto tile = tree.cbeginValueOn();
  tile.setMaxDepth(decltype(tile)::LEAF_DEPTH - 1);
  for (; tile; ++tile) {
    progress.check();
    openvdb::CoordBBox box;
    tile.getBoundingBox(box);
    visit(box, *tile);
  }
}

// The box of the values other than 0, all of which are checked.
template <class Grid>
openvdb::CoordBBox box_of(const Grid& grid, const std::string& path, const Progress& progress) {
  openvdb::CoordBBox all;
  each_value(grid, progress, [&](const openvdb::CoordBBox& box, auto value) {
    if (!(value >= 0) || !std::isfinite(static_cast<float>(value))) {
      const openvdb::Coord c = box.min();
      throw InputError(fmt::format("{}: the value of cell ({}, {}, {}) is {}, expected a finite number >= 0", path, c.x(), c.y(),
                                   c.z(), value));
    }
    if (static_cast<float>(value) > 0) all.expand(box);
  });
  return all;
}

template <class Grid>
VoxelGrid dense(const Grid& grid, const openvdb::CoordBBox& all, Progress& progress) {
  VoxelGrid voxels;
  const openvdb::Coord low = all.min(), size = all.dim();
  voxels.size = {size.x(), size.y(), size.z()};
  const auto nx = static_cast<std::size_t>(size.x()), ny = static_cast<std::size_t>(size.y()),
             nz = static_cast<std::size_t>(size.z());
  voxels.values.resize(nx * ny * nz);
  progress.report(loading, 0.75);
  each_value(grid, progress, [&](const openvdb::CoordBBox& box, auto value) {
    if (!(static_cast<float>(value) > 0)) return;  // a 0 may stand outside the box
    for (auto z = static_cast<std::size_t>(box.min().z() - low.z()); z <= static_cast<std::size_t>(box.max().z() - low.z());
         ++z) {
      for (auto y = static_cast<std::size_t>(box.min().y() - low.y()); y <= static_cast<std::size_t>(box.max().y() - low.y());
           ++y) {
        const auto x = static_cast<std::size_t>(box.min().x() - low.x());
        std::fill_n(voxels.values.begin() + static_cast<std::ptrdiff_t>(x + nx * (y + ny * z)), box.dim().x(),
                    static_cast<float>(value));
      }
    }
  });
  return voxels;
}

template <class Grid>
GridFile read_tree(const std::string& path, std::string_view bytes, const VdbFile& file, const VdbGrid& entry,
                   Progress& progress) {
  using Value = typename Grid::ValueType;
  const VdbTree tree = check_vdb_tree(path, bytes, entry, sizeof(Value), progress);
  if (!tree.grid_class.empty() && tree.grid_class != "fog volume" && tree.grid_class != "unknown") {
    throw InputError(
        fmt::format("{}: grid \"{}\" is a {}, expected a fog volume", path, printable(entry.name), printable(tree.grid_class)));
  }

  // What OpenVDB does with a grid of a file, without its metadata: they change nothing here, and some of them hold sizes too.
  const auto grid = Grid::create();
  grid->setSaveFloatAsHalf(entry.half);
  Bytes buffer(bytes.substr(tree.begin, tree.end - tree.begin), progress);
  std::istream in(&buffer);
  in.exceptions(std::ios_base::badbit | std::ios_base::failbit | std::ios_base::eofbit);
  openvdb::io::setVersion(in, {file.library_major, file.library_minor}, file.version);
  openvdb::io::setDataCompression(in, tree.compression);
  grid->readTransform(in);
  grid->readTopology(in);
  grid->readBuffers(in);
  if (grid->background() != Value(0)) {
    throw InputError(
        fmt::format("{}: grid \"{}\" is {} outside its cells, expected 0", path, printable(entry.name), grid->background()));
  }

  const openvdb::CoordBBox box = box_of(*grid, path, progress);
  if (box.empty())
    throw InputError(fmt::format("{}: grid \"{}\" has no value above 0, expected at least one", path, printable(entry.name)));
  const auto size = [&](std::size_t axis) {
    return static_cast<double>(box.max()[axis]) - static_cast<double>(box.min()[axis]) + 1;
  };
  if (size(0) * size(1) * size(2) > static_cast<double>(most_cells)) {
    throw InputError(fmt::format("{}: grid \"{}\" has {} x {} x {} cells, expected at most {} in all", path,
                                 printable(entry.name), size(0), size(1), size(2), most_cells));
  }

  // OpenVDB multiplies rows by matrices, and cell i of it has its centre at i.
  const openvdb::Mat4d world = grid->transform().baseMap()->getAffineMap()->getMat4();
  glm::dmat4 transform;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) transform[column][row] = world(column, row);
  }
  if (transform[0][3] != 0 || transform[1][3] != 0 || transform[2][3] != 0 || transform[3][3] != 1) {
    throw InputError(fmt::format("{}: grid \"{}\" has a transform that is not affine", path, printable(entry.name)));
  }
  const glm::dvec3 corner(box.min().x() - 0.5, box.min().y() - 0.5, box.min().z() - 0.5);
  return {std::make_shared<const VoxelGrid>(dense(*grid, box, progress)), glm::translate(transform, corner), {}};
}

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return text;
}

const VdbGrid& named(const VdbFile& file, const std::string& path, const std::string& name) {
  std::string there;
  for (const VdbGrid& grid : file.grids) {
    if (grid.name == name) return grid;
    there += fmt::format("{}\"{}\"", there.empty() ? "" : ", ", printable(grid.name));
    if (there.size() > 1000) {
      there += ", ...";
      break;
    }
  }
  if (there.empty()) there = "at least one grid";
  throw InputError(fmt::format("{}: no grid \"{}\", expected {}{}", path, name, file.grids.size() > 1 ? "one of " : "", there));
}

GridFile read_any(const std::string& path, std::string_view bytes, const std::string& name, Progress& progress) {
  const VdbFile file = vdb_layout(path, bytes);
  const VdbGrid& entry = named(file, path, name);
  if (entry.instance) {
    throw InputError(
        fmt::format("{}: grid \"{}\" shares the values of another grid, which is not supported", path, printable(name)));
  }
  if (entry.type == openvdb::FloatGrid::gridType()) return read_tree<openvdb::FloatGrid>(path, bytes, file, entry, progress);
  if (entry.type == openvdb::DoubleGrid::gridType()) return read_tree<openvdb::DoubleGrid>(path, bytes, file, entry, progress);
  throw InputError(fmt::format("{}: grid \"{}\" is of type {}, expected {} or {}", path, printable(name), printable(entry.type),
                               openvdb::FloatGrid::gridType(), openvdb::DoubleGrid::gridType()));
}

}  // namespace

GridFile read_grid_file(const std::string& path, const std::string& name, Progress& progress) {
  progress.report(loading, 0);
  const std::string bytes = read_file(path, most_bytes);
  progress.check();
  try {
    openvdb::initialize();
    GridFile out = read_any(path, bytes, name, progress);
    Sha256 hash;
    hash.add(bytes);
    out.content_hash = hash.hex();
    progress.report(loading, 1);
    return out;
  } catch (const InputError&) {
    throw;
  } catch (const Interrupted&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw MachineError(path + ": not enough memory for its grid");
  } catch (const std::exception& e) {  // OpenVDB's own, and the stream's end
    throw InputError(fmt::format("{}: grid \"{}\" is damaged: {}", path, printable(name), one_line(e.what())));
  }
}

std::string grid_library() { return fmt::format("OpenVDB {}", openvdb::getLibraryVersionString()); }

}  // namespace airlight
