#include "common/scene/vdb_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <set>
#include <tuple>
#include <utility>

#include "common/error.h"

namespace airlight {

namespace {

constexpr std::uint64_t magic = 0x56444220;
constexpr std::uint32_t oldest = 222, newest = 224;
enum : std::uint32_t { zip = 1, active_mask = 2, blosc = 4, all_compressions = 7 };

class Cursor {
 public:
  Cursor(const std::string& path, std::string_view bytes, std::size_t at) : path_(path), bytes_(bytes), at_(at) {}

  [[noreturn]] void fail(std::string_view what) const { throw InputError(fmt::format("{}: byte {}: {}", path_, at_, what)); }

  std::size_t at() const { return at_; }
  std::uint64_t left() const { return bytes_.size() - at_; }
  void need(std::uint64_t size, std::string_view what) const {
    if (size > left()) fail(fmt::format("the file ends within {}, expected {} more bytes", what, size - left()));
  }
  std::string_view skip(std::uint64_t size, std::string_view what) {
    need(size, what);
    const std::string_view taken = bytes_.substr(at_, static_cast<std::size_t>(size));
    at_ += static_cast<std::size_t>(size);
    return taken;
  }
  template <class T>
  T take(std::string_view what) {
    T value;
    std::memcpy(&value, skip(sizeof value, what).data(), sizeof value);
    return value;
  }
  std::string_view text(std::string_view what) {
    const auto size = take<std::uint32_t>(what);
    return skip(size, what);
  }
  void seek(std::int64_t to, std::string_view what) {
    if (to < 0 || static_cast<std::uint64_t>(to) > bytes_.size()) fail(fmt::format("{} at byte {}, beyond the file", what, to));
    at_ = static_cast<std::size_t>(to);
  }

 private:
  const std::string& path_;
  std::string_view bytes_;
  std::size_t at_;
};

// Bits of a node, in the order of its table.
class Mask {
 public:
  Mask(Cursor& in, std::size_t bits) : words_(bits / 64) {
    const std::string_view bytes = in.skip(bits / 8, "a mask");
    std::memcpy(words_.data(), bytes.data(), bytes.size());
  }
  std::uint64_t count() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t w : words_) sum += static_cast<unsigned>(std::popcount(w));
    return sum;
  }
  bool meets(const Mask& other) const {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      if ((words_[i] & other.words_[i]) != 0) return true;
    }
    return false;
  }

 private:
  std::vector<std::uint64_t> words_;
};

// Name, type and value of each; `class` is what is wanted of them.
std::string skip_metadata(Cursor& in) {
  std::string grid_class;
  const auto count = in.take<std::uint32_t>("the number of metadata");
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::string_view name = in.text("the name of metadata"), type = in.text("the type of metadata");
    const std::string_view value = in.text("the value of metadata");
    if (name == "class" && type == "string") grid_class = value;
  }
  return grid_class;
}

// What follows the name of each linear map [byte]: vectors and matrices of doubles.
void skip_transform(Cursor& in) {
  static constexpr std::array<std::pair<std::string_view, unsigned>, 7> maps{{{"AffineMap", 16 * 8},
                                                                              {"UnitaryMap", 16 * 8},
                                                                              {"ScaleMap", 5 * 24},
                                                                              {"UniformScaleMap", 5 * 24},
                                                                              {"TranslationMap", 24},
                                                                              {"ScaleTranslateMap", 6 * 24},
                                                                              {"UniformScaleTranslateMap", 6 * 24}}};
  const std::string_view type = in.text("the name of a transform");
  const auto* const found = std::find_if(maps.begin(), maps.end(), [&](const auto& m) { return m.first == type; });
  if (found == maps.end()) in.fail(fmt::format("a transform of type \"{}\", expected a linear one", printable(type)));
  in.skip(found->second, "a transform");
}

class TreeCheck {
 public:
  TreeCheck(Cursor& in, std::uint32_t compression, std::size_t value_bytes, bool half, const Progress& progress)
      : in_(in),
        compression_(compression),
        value_(value_bytes),
        stored_(!half               ? value_bytes
                : value_bytes == 12 ? 6
                                    : 2),  // three numbers of a vector
        half_(half),
        progress_(progress) {}

  void run() {
    if (in_.take<std::int32_t>("a number of buffers") != 1) in_.fail("expected one buffer a leaf");
    in_.skip(value_, "the background");
    const auto tiles = in_.take<std::uint32_t>("a number of tiles"), children = in_.take<std::uint32_t>("a number of nodes");
    for (std::uint32_t i = 0; i < tiles; ++i) {
      origin();
      in_.skip(value_, "a tile");
      if (in_.take<std::uint8_t>("a tile") > 1) in_.fail("expected 0 or 1");  // a bool of anything else is undefined
    }
    for (std::uint32_t i = 0; i < children; ++i) {
      origin();
      upper();
    }
    for (std::uint64_t i = 0; i < leaves_; ++i) {
      if (i % 4096 == 0) progress_.check();
      const Mask active(in_, leaf_cells);
      values(leaf_cells, active);
    }
  }

 private:
  static constexpr std::size_t upper_cells = 32 * 32 * 32, lower_cells = 16 * 16 * 16, leaf_cells = 8 * 8 * 8;
  static constexpr std::int32_t upper_side = 4096, farthest = 1 << 30;

  void origin() {
    std::array<std::int32_t, 3> o{};
    for (std::int32_t& c : o) {
      c = in_.take<std::int32_t>("the origin of a node");
      if (c % upper_side != 0 || c < -farthest || c > farthest) in_.fail(fmt::format("{} is no origin of a node", c));
    }
    if (!origins_.insert(o).second) in_.fail("two nodes at one origin");
  }
  std::uint64_t children(std::size_t cells) {
    const Mask child(in_, cells), active(in_, cells);
    if (child.meets(active)) in_.fail("a cell that is both a node and a value");
    values(cells, active);
    return child.count();
  }
  void upper() {
    for (std::uint64_t n = children(upper_cells); n > 0; --n) {
      progress_.check();
      const std::uint64_t below = children(lower_cells);
      leaves_ += below;
      in_.skip(below * (leaf_cells / 8), "the masks of leaves");
    }
  }

  // The values of one node: a byte that says which are left out, up to two values and a mask for those, then what is stored.
  void values(std::size_t cells, const Mask& active) {
    enum : std::uint8_t { one_inactive = 2, mask_only = 3, mask_and_one = 4, mask_and_two = 5, all = 6 };
    const auto kind = in_.take<std::uint8_t>("a node");
    if (kind > all) in_.fail(fmt::format("{}, expected 0..6", kind));
    if (kind == one_inactive || kind == mask_and_one || kind == mask_and_two) in_.skip(value_, "a node");
    if (kind == mask_and_two) in_.skip(value_, "a node");
    if (kind == mask_only || kind == mask_and_one || kind == mask_and_two) in_.skip(cells / 8, "a mask");
    const bool some = (compression_ & active_mask) != 0 && kind != all;
    stored(some ? active.count() : cells);
  }

  void stored(std::uint64_t count) {
    const std::uint64_t size = count * stored_;
    if (half_ && count == 0) return;  // nothing then, not even a size
    if ((compression_ & (zip | blosc)) == 0) {
      in_.skip(size, "values");
      return;
    }
    const auto packed = in_.take<std::int64_t>("values");
    if (packed <= 0) {  // stored as they are; 0 - packed cannot overflow once it is compared
      if (packed != -static_cast<std::int64_t>(size)) in_.fail(fmt::format("{} bytes of values, expected {}", packed, size));
      in_.skip(size, "values");
      return;
    }
    in_.need(static_cast<std::uint64_t>(packed), "values");
    if ((compression_ & blosc) != 0) {  // blosc believes its own header: sizes at 4 and 12
      if (packed < 16) in_.fail("values of fewer bytes than their header");
      Cursor header = in_;
      header.skip(4, "values");
      const auto plain = header.take<std::uint32_t>("values");
      header.skip(4, "values");
      const auto whole = header.take<std::uint32_t>("values");
      if (plain != size || whole != packed) {
        in_.fail(fmt::format("{} bytes packed in {}, expected {} in {}", plain, whole, size, packed));
      }
    }
    in_.skip(static_cast<std::uint64_t>(packed), "values");
  }

  Cursor& in_;
  std::uint32_t compression_;
  std::size_t value_, stored_;  // [byte] a value in memory, and in the file
  bool half_;
  const Progress& progress_;
  std::uint64_t leaves_ = 0;
  std::set<std::array<std::int32_t, 3>> origins_;
};

}  // namespace

std::string printable(std::string_view text) {
  std::string out(text.substr(0, 64));
  std::replace_if(
      out.begin(), out.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, '?');
  return out;
}

VdbFile vdb_layout(const std::string& path, std::string_view bytes) {
  Cursor in(path, bytes, 0);
  if (bytes.size() < 8 || in.take<std::uint64_t>("the header") != magic) throw InputError(path + ": not an OpenVDB file");
  VdbFile file;
  file.version = in.take<std::uint32_t>("the header");
  if (file.version < oldest || file.version > newest) {
    in.fail(fmt::format("OpenVDB file version {}, expected {}..{}", file.version, oldest, newest));
  }
  file.library_major = in.take<std::uint32_t>("the header");
  file.library_minor = in.take<std::uint32_t>("the header");
  if (in.take<std::uint8_t>("the header") == 0) in.fail("written without the offsets of its grids, expected a file with them");
  in.skip(36, "the header");  // a name of this very file
  skip_metadata(in);

  const auto count = in.take<std::int32_t>("the number of grids");
  for (std::int32_t i = 0; i < count; ++i) {
    VdbGrid grid;
    const std::string_view name = in.text("the name of a grid");
    grid.name = name.substr(0, name.find('\x1e'));  // what follows makes equal names different
    grid.type = in.text("the type of a grid");
    constexpr std::string_view suffix = "_HalfFloat";
    if (grid.type.ends_with(suffix)) {
      grid.half = true;
      grid.type.resize(grid.type.size() - suffix.size());
    }
    grid.instance = !in.text("a grid").empty();
    const auto begin = in.take<std::int64_t>("a grid");
    in.take<std::int64_t>("a grid");
    const auto end = in.take<std::int64_t>("a grid");
    const std::size_t listed = in.at();
    in.seek(begin, "a grid");
    grid.begin = in.at();
    in.seek(end, "the end of a grid");
    if (grid.begin < listed || in.at() < grid.begin) in.fail("grids in no order");  // also what ends this loop
    file.grids.push_back(std::move(grid));
  }
  return file;
}

VdbTree check_vdb_tree(const std::string& path, std::string_view bytes, const VdbGrid& grid, std::size_t value_bytes,
                       const Progress& progress) {
  Cursor in(path, bytes, grid.begin);
  VdbTree tree;
  tree.compression = in.take<std::uint32_t>("a grid");
  if (tree.compression > all_compressions) in.fail(fmt::format("unknown compression {}", tree.compression));
  tree.grid_class = skip_metadata(in);
  tree.begin = in.at();
  skip_transform(in);
  TreeCheck(in, tree.compression, value_bytes, grid.half, progress).run();
  tree.end = in.at();
  return tree;
}

}  // namespace airlight
