// Ground truth in double precision (technique `reference`; knobs in common/techniques/reference.h).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/image.h"
#include "common/plan/image_names.h"
#include "common/plan/plan.h"
#include "common/progress.h"
#include "common/reference/pixel.h"
#include "common/rows.h"
#include "common/scene/scene.h"
#include "common/stats.h"

namespace airlight {

// A whole image in double, rows from the top.
struct ReferenceFrame {
  Extent extent;
  std::vector<ReferencePixel> pixels;
  std::vector<bool> edges;  // empty unless asked for: Reference::edge() of each pixel
  double error = 0;         // largest ReferencePixel::error

  double edge_share() const;  // 0..1
};

// The same bits for any number of threads. Throws Interrupted when asked to stop.
ReferenceFrame reference_frame(const Scene&, Extent, const ReferenceSettings&, bool with_edges, int threads, Progress&);

// These rows of the images of the request by name, as any technique gives them; "standard_error" (of the airlight, by the spread
// of random paths; 0 without any) and "edge" (1 or 0) too where they are asked for. In `stats` one step, "reference".
std::map<std::string, HostImage> render_reference(const Scene&, const FrameRequest&, Rows, int threads, Stats&, Progress&);

}  // namespace airlight
