#include "common/transfer/transfer_maker.h"

#include <chrono>
#include <utility>

#include "common/error.h"
#include "common/transfer/receivers.h"
#include "common/transfer/transfer_file.h"

namespace airlight {

SurfaceTransfer TransferMaker::made(const Scene& scene, int rays) const {
  const Occluders occluders(scene);
  const SphereOfDirections directions(2 * rays);
  return Receivers(scene, occluders, directions, threads_, *progress_).transfer();
}

std::shared_ptr<const SurfaceTransfer> TransferMaker::transfer(const Scene& scene, int rays) {
  const std::uint64_t key = transfer_key(scene, rays);
  if (last_ && key == key_) return last_;
  const auto start = std::chrono::steady_clock::now();
  std::string note;
  const std::string content = keep_ ? transfer_content(scene, rays) : "", path = keep_ ? transfer_path(content) : "";
  std::optional<SurfaceTransfer> found;
  if (keep_ && path.empty()) note = "not kept: neither XDG_CACHE_HOME nor HOME names a folder";
  if (!path.empty()) found = read_transfer(path, content, scene);
  if (found) {
    note = "read from " + path;
  } else {
    found = made(scene, rays);
    try {
      if (!path.empty()) write_transfer(path, content, *found), note = "kept in " + path;
    } catch (const InputError& e) {
      note = std::string("not kept: ") + e.what();
    } catch (const MachineError& e) {
      note = std::string("not kept: ") + e.what();
    }
  }
  last_ = std::make_shared<const SurfaceTransfer>(std::move(*found));
  key_ = key;
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  StepStats step{"surface_transfer", seconds.count(), last_->vertices(), false};
  step.note = note;
  stats_.push_back(step);
  return last_;
}

std::vector<StepStats> TransferMaker::take_stats() { return std::exchange(stats_, {}); }

}  // namespace airlight
