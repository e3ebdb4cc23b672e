// True images of scenes, kept from run to run, and how far an image is from one.
#pragma once

#include <string>
#include <vector>

#include "bench/pareto/sweep.h"
#include "common/image.h"
#include "common/progress.h"
#include "common/scene/scene.h"

namespace airlight {

struct Truth {
  HostImage beauty;         // rgb
  std::vector<bool> edges;  // pixels within 1/100 pixel of an edge or a shadow's boundary
  bool kept = false;        // it came from the folder

  bool black() const;
};

// The reference's knobs for a scene: what its file asks of the reference, then `set`. Throws InputError for what it does not
// know.
KnobValues truth_knobs(const Scene&, const Settings& set);

// From `folder`, or rendered by the reference and put there. The name is made of all that the image depends on: the scene's
// content, the knobs, the extent. A reference that has changed itself is noticed: a small image is kept too and made again, and
// where it differs the truth is rendered again.
Truth truth_of(const Scene&, Extent, const KnobValues&, const std::string& folder, int threads, Progress&);

struct RelativeError {
  double everywhere = 0, off_edges = 0;  // sqrt(mean((a - b)^2)) / mean(b) over pixels and channels
};
// Infinite where the image has a value that is not finite. The truth must not be black.
RelativeError relative_error(const HostImage&, const Truth&);

}  // namespace airlight
