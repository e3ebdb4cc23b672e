// Where the labels of a figure's points stand, so that all of them can be read.
#pragma once

#include <optional>
#include <vector>

namespace airlight {

struct Box {
  double x = 0, y = 0, width = 0, height = 0;  // upper left corner [pixel]
  bool meets(const Box& o) const { return x < o.x + o.width && o.x < x + width && y < o.y + o.height && o.y < y + height; }
  bool inside(const Box& o) const { return x >= o.x && y >= o.y && x + width <= o.x + o.width && y + height <= o.y + o.height; }
};

struct Label {
  double x = 0, y = 0;           // its point
  double width = 0, height = 0;  // of the text
};

// The boxes of the texts: inside `area`, clear of each other and of `taken`, as near to their points as they can be. Nothing
// where no place is free within reach. Earlier labels choose first.
std::vector<std::optional<Box>> placed(const std::vector<Label>&, std::vector<Box> taken, const Box& area);

}  // namespace airlight
