// Makes transfers, and keeps the last one: in memory, and on disk where that is wanted and possible.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/plan/surface_transfer.h"
#include "common/progress.h"
#include "common/stats.h"

namespace airlight {

class TransferMaker final : public TransferSource {
 public:
  // `keep`: look for files in the cache folder, and write them there.
  TransferMaker(int threads, bool keep) : threads_(threads), keep_(keep) {}

  // Whom to tell how far it is, until the next call.
  void report_to(Progress& progress) { progress_ = &progress; }

  // Throws Interrupted when asked to stop, MachineError where Embree fails; what concerns files alone is only told in the stats.
  std::shared_ptr<const SurfaceTransfer> transfer(const Scene&, int rays) override;

  // What was made or read since the last call, one entry each.
  std::vector<StepStats> take_stats();

 private:
  SurfaceTransfer made(const Scene&, int rays) const;

  int threads_;
  bool keep_;
  NoProgress nobody_;
  Progress* progress_ = &nobody_;
  std::uint64_t key_ = 0;
  std::shared_ptr<const SurfaceTransfer> last_;
  std::vector<StepStats> stats_;
};

}  // namespace airlight
