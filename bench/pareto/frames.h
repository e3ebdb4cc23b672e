// Frames of one scene on every backend, warm and never the same twice.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/airlight.h"
#include "bench/pareto/sweep.h"

namespace airlight {

class Frames {
 public:
  // Starts the backends named; one that cannot start is in not_started() with its reason. The scene must outlive this.
  Frames(const Scene&, const std::vector<std::string>& backends, const std::string& simd, int threads);

  const std::map<std::string, std::string>& devices() const { return devices_; }  // backend, Renderer::describe()
  const std::vector<std::string>& not_started() const { return not_started_; }

  // `beauty` of the scene as it is.
  HostImage exact(const Configuration&, Extent, Progress&);

  // [ms] of Renderer::render() with the copy of `beauty`. Every light and source is scaled by a few millionths, another
  // number each time, so that the frame is computed; tables and geometry that are held stay warm.
  double milliseconds(const Configuration&, Extent, Progress&);

 private:
  const Scene& scene_;
  std::map<std::string, Renderer> renderers_;
  std::map<std::string, std::string> devices_;
  std::vector<std::string> not_started_;
  int count_ = 0;
};

}  // namespace airlight
