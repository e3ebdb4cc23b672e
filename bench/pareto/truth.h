// True images of scenes, kept from run to run.
#pragma once

#include <string>
#include <vector>

#include "common/image.h"
#include "common/progress.h"
#include "common/scene/scene.h"

namespace airlight {

struct Truth {
  HostImage beauty;         // rgb
  std::vector<bool> edges;  // pixels within 1/100 pixel of an edge or a shadow's boundary
};

// From `folder`, under the scene's hash and the extent, or rendered by the reference and put there.
Truth truth_of(const Scene&, Extent, const std::string& folder, int threads, Progress&);

struct RelativeError {
  double everywhere = 0, off_edges = 0;  // sqrt(mean((a - b)^2)) / mean(b) over pixels and channels
};
RelativeError relative_error(const HostImage&, const Truth&);

}  // namespace airlight
