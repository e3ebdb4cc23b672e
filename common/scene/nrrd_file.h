// Voxel grids out of NRRD files ("nearly raw raster data"): a header of a few lines, then the values, x fastest.
//
//   NRRD0004
//   type: float
//   dimension: 3
//   sizes: 48 48 96
//   encoding: raw
//   endian: little
//   space directions: (0.05,0,0) (0,0.05,0) (0,0,0.05)     (or "spacings: 0.05 0.05 0.05"; 1 unless said)
//   space origin: (-1,0,-1)                                (where the first value stands; 0 unless said)
//                                                          an empty line ends the header
#pragma once

#include <string>
#include <string_view>

#include "common/progress.h"
#include "common/scene/sparse_grid.h"

namespace airlight {

// Whether these are the bytes of one, by their beginning.
bool is_nrrd(std::string_view bytes);

// Three axes of integers (8 to 64 bits), floats or doubles, stored raw in either byte order or as text ("ascii"), in the file
// itself. Other fields change nothing. Throws InputError: "path:line: ..." for the header, "path: byte N: ..." for a raw value
// that is not finite or negative, "path:line:column: ..." for a text; for no value above 0; for more than most_cells. Throws
// Interrupted. The content hash is left empty.
SparseGrid read_nrrd(const std::string& path, std::string_view bytes, Progress&);

}  // namespace airlight
