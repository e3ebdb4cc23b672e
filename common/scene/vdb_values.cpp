#include "common/scene/vdb_values.h"

#include <fmt/format.h>
#include <openvdb/Grid.h>
#include <openvdb/io/io.h>
#include <openvdb/openvdb.h>

#include <istream>
#include <new>
#include <streambuf>
#include <type_traits>

#include "common/error.h"

namespace airlight {

namespace {

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
  pos_type seekoff(off_type by, std::ios_base::seekdir from, std::ios_base::openmode mode) override {
    static_cast<void>(mode);
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

template <class Value>
double number_of(const Value& value) {
  if constexpr (std::is_floating_point_v<Value>) {
    return static_cast<double>(value);
  } else {
    return static_cast<double>(value.length());
  }
}

std::string one_line(std::string text) {
  for (char& c : text) c = static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  return text;
}

}  // namespace

class VdbValues::Tree {
 public:
  virtual ~Tree() = default;
  virtual void each(const std::function<void(const VdbCells&)>& visit, const Progress&) const = 0;
  virtual std::uint64_t active() const = 0;
  virtual double background() const = 0;
};

template <class Grid>
class VdbValues::TreeOf final : public Tree {
 public:
  // What OpenVDB does with a grid of a file, without its metadata: they change nothing here, and some of them hold sizes too.
  TreeOf(const VdbFile& file, const VdbGrid& entry, const VdbTree& tree, std::string_view bytes, Progress& progress)
      : grid_(Grid::create()) {
    grid_->setSaveFloatAsHalf(entry.half);
    Bytes buffer(bytes.substr(tree.begin, tree.end - tree.begin), progress);
    std::istream in(&buffer);
    in.exceptions(std::ios_base::badbit | std::ios_base::failbit | std::ios_base::eofbit);
    openvdb::io::setVersion(in, {file.library_major, file.library_minor}, file.version);
    openvdb::io::setDataCompression(in, tree.compression);
    grid_->readTransform(in);
    grid_->readTopology(in);
    grid_->readBuffers(in);
  }

  void each(const std::function<void(const VdbCells&)>& visit, const Progress& progress) const override {
    const auto& tree = grid_->tree();
    for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
      progress.check();
      for (auto value = leaf->cbeginValueOn(); value; ++value) {
        const openvdb::Coord c = value.getCoord();
        const glm::ivec3 cell(c.x(), c.y(), c.z());
        visit({cell, cell, number_of(*value)});
      }
    }
    auto tile = tree.cbeginValueOn();
    tile.setMaxDepth(decltype(tile)::LEAF_DEPTH - 1);
    for (; tile; ++tile) {
      progress.check();
      openvdb::CoordBBox box;
      tile.getBoundingBox(box);
      visit({{box.min().x(), box.min().y(), box.min().z()}, {box.max().x(), box.max().y(), box.max().z()}, number_of(*tile)});
    }
  }
  std::uint64_t active() const override { return grid_->tree().activeVoxelCount(); }
  double background() const override { return number_of(grid_->background()); }

  // OpenVDB multiplies rows by matrices.
  glm::dmat4 transform() const {
    const openvdb::Mat4d world = grid_->transform().baseMap()->getAffineMap()->getMat4();
    glm::dmat4 m;
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 4; ++row) m[column][row] = world(column, row);
    }
    return m;
  }

 private:
  typename Grid::Ptr grid_;
};

bool VdbValues::reads(const std::string& type) {
  return type == openvdb::FloatGrid::gridType() || type == openvdb::DoubleGrid::gridType() ||
         type == openvdb::Vec3SGrid::gridType();
}

VdbValues::VdbValues(const std::string& path, std::string_view bytes, const VdbFile& file, const VdbGrid& entry,
                     Progress& progress) {
  const auto read = [&]<class Grid>(Grid*) {
    const VdbTree tree = check_vdb_tree(path, bytes, entry, sizeof(typename Grid::ValueType), progress);
    grid_class_ = tree.grid_class;
    auto made = std::make_unique<TreeOf<Grid>>(file, entry, tree, bytes, progress);
    world_ = made->transform();
    tree_ = std::move(made);
  };
  if (entry.instance) {
    throw InputError(
        fmt::format("{}: grid \"{}\" shares the values of another grid, which is not supported", path, printable(entry.name)));
  }
  try {
    openvdb::initialize();
    if (entry.type == openvdb::FloatGrid::gridType()) {
      read(static_cast<openvdb::FloatGrid*>(nullptr));
    } else if (entry.type == openvdb::DoubleGrid::gridType()) {
      read(static_cast<openvdb::DoubleGrid*>(nullptr));
    } else if (entry.type == openvdb::Vec3SGrid::gridType()) {
      read(static_cast<openvdb::Vec3SGrid*>(nullptr));
    } else {
      throw InputError(
          fmt::format("{}: grid \"{}\" is of type {}, which is not read", path, printable(entry.name), printable(entry.type)));
    }
  } catch (const InputError&) {
    throw;
  } catch (const Interrupted&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw MachineError(path + ": not enough memory for its grid");
  } catch (const std::exception& e) {  // OpenVDB's own, and the stream's end
    throw InputError(fmt::format("{}: grid \"{}\" is damaged: {}", path, printable(entry.name), one_line(e.what())));
  }
}

VdbValues::~VdbValues() = default;

void VdbValues::each(const std::function<void(const VdbCells&)>& visit, const Progress& progress) const {
  tree_->each(visit, progress);
}
std::uint64_t VdbValues::active() const { return tree_->active(); }
double VdbValues::background() const { return tree_->background(); }
const std::string& VdbValues::grid_class() const { return grid_class_; }

std::string grid_library() { return fmt::format("OpenVDB {}", openvdb::getLibraryVersionString()); }

}  // namespace airlight
