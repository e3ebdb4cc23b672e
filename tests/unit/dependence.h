// What has to run, told from contents themselves: every field of a step and every byte of an upload is compared, no key and no
// hash is asked. Keys are held against it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/plan/plan.h"

namespace airlight {

using Uploaded = std::map<Handle, std::vector<std::byte>>;

// What a backend holds that has run one plan after the other.
class Contents {
 public:
  // The steps of this plan that must run after those before it, and no others. `uploaded`: the bytes of each of its uploads.
  // `still`: all images are kept that are made.
  std::vector<bool> run(const Plan&, const Uploaded& uploaded, bool still);

 private:
  using Number = std::size_t;  // one for each content that was ever there
  Number number(const std::string& content) { return numbers_.emplace(content, numbers_.size() + 1).first->second; }

  std::map<std::string, Number> numbers_;
  std::map<Handle, Number> held_;
};

}  // namespace airlight
