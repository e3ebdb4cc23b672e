// Where the parts of an OpenVDB file are. OpenVDB trusts what it reads: a wrong size makes it write beyond a buffer, a wrong
// count take memory without end. So every size, count and mask is checked here, in memory, before it reads a tree.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/progress.h"

namespace airlight {

// A grid as the file lists it.
struct VdbGrid {
  std::string name;       // as its writer gave it; several grids may have the same
  std::string type;       // "Tree_float_5_4_3"
  bool half = false;      // values are stored in 16 bits
  bool instance = false;  // its tree is that of another grid
  std::size_t begin = 0;  // [byte] where its own part starts in the file
};

struct VdbFile {
  std::uint32_t version = 0, library_major = 0, library_minor = 0;
  std::vector<VdbGrid> grids;
};

// A tree that is safe to read: its transform, topology and buffers follow each other from `begin` to `end`.
struct VdbTree {
  std::string grid_class;  // "fog volume", "level set", ...; empty where the file does not say
  std::uint32_t compression = 0;
  std::size_t begin = 0, end = 0;  // [byte]
};

// Header and list of grids. Throws InputError "path: byte N: what is wrong" for what is no OpenVDB file, for a version
// other than 222..224 (since 2013), for a file without offsets.
VdbFile vdb_layout(const std::string& path, std::string_view bytes);

// The tree of a grid of float, double or vectors of three floats (`value_bytes` 4, 8 or 12) with nodes of 32, 16 and 8 cells a
// side, whose transform is linear. Throws InputError as above, Interrupted.
VdbTree check_vdb_tree(const std::string& path, std::string_view bytes, const VdbGrid&, std::size_t value_bytes, const Progress&);

// Text of a file, fit for a message of one line: control characters become '?', and it ends after 64 bytes.
std::string printable(std::string_view);

}  // namespace airlight
