#include "common/plan/keys.h"

#include <algorithm>
#include <map>

#include "common/algorithms/each_field.h"
#include "common/plan/hash.h"

namespace airlight {

void StepRuns::make_keys(std::span<const Step> steps, const std::function<std::uint64_t(Handle)>& key_of_upload,
                         std::span<const StepRows> rows) {
  keys_.clear(), written_.clear();
  const auto content_of = [&](Handle h) {
    const auto found = std::find_if(written_.rbegin(), written_.rend(), [&](const auto& w) { return w.first == h; });
    return found != written_.rend() ? found->second : key_of_upload(h);
  };
  for (const Step& step : steps) {
    Hash hash;
    hash.add(name_of(step.what));
    std::visit(
        [&](const auto& a) {
          a.fields(a, [&](const Field& field, const auto& value) {
            hash.add(field.name);
            if constexpr (std::is_base_of_v<Handle, std::remove_cvref_t<decltype(value)>>) {
              hash.add(static_cast<bool>(value));
              if (field.role != Role::input || !value) return;
              hash.add(content_of(value));
            } else if constexpr (std::is_same_v<std::vector<Buffer>, std::remove_cvref_t<decltype(value)>>) {
              hash.add(value.size());
              for (const Buffer& b : value) hash.add(content_of(b));
            } else {
              hash.add(value);
            }
          });
        },
        step.what);
    int height = 0;
    each_made<Image>(step.what, [&](const Image& image) { height = image.extent.height; });
    if (!rows.empty() && height > 0) {
      const std::uint64_t of_rows = key_of(rows[keys_.size()], height);
      if (of_rows != 0) hash.add(of_rows);
    }
    keys_.push_back(hash.value());
    const auto write = [&](const auto& made) { written_.emplace_back(made, output_key(keys_.back(), made)); };
    each_made<Image>(step.what, write);
    each_made<Buffer>(step.what, write);
  }
}

std::uint64_t output_key(std::uint64_t step_key, const Image& output) {
  Hash hash;
  hash.add(step_key);
  hash.add(output.id);
  hash.add(output.extent);
  hash.add(output.layers);
  return hash.value();
}

std::uint64_t output_key(std::uint64_t step_key, const Buffer& output) {
  Hash hash;
  hash.add(step_key);
  hash.add(output.id);
  hash.add(output.bytes);
  return hash.value();
}

void StepRuns::find_stale(std::span<const Step> steps, std::span<const std::uint64_t> keys,
                          const std::function<bool(Handle, std::uint64_t key)>& held) {
  run_.assign(steps.size(), false);
  needed_.clear();
  for (std::size_t i = steps.size(); i-- > 0;) {
    each_made<Image>(steps[i].what, [&](const Image& image) {
      const Handle handle = image;
      const bool wanted = image.keep || std::find(needed_.begin(), needed_.end(), handle) != needed_.end();
      if (wanted && !(image.keep && held(image, output_key(keys[i], image)))) run_[i] = true;
      std::erase(needed_, handle);
    });
    each_made<Buffer>(steps[i].what, [&](const Buffer& buffer) {
      if (!held(buffer, output_key(keys[i], buffer))) run_[i] = true;
    });
    if (run_[i]) each_input(steps[i].what, [&](Handle input) { needed_.push_back(input); });
  }
}

void StepRuns::update(std::span<const Step> steps, const std::function<std::uint64_t(Handle)>& key_of_upload,
                      const std::function<bool(Handle, std::uint64_t key)>& held, std::span<const StepRows> rows) {
  make_keys(steps, key_of_upload, rows);
  find_stale(steps, keys_, held);
}

std::vector<std::uint64_t> step_keys(std::span<const Step> steps, const std::function<std::uint64_t(Handle)>& key_of_upload,
                                     std::span<const StepRows> rows) {
  StepRuns runs;
  runs.make_keys(steps, key_of_upload, rows);
  return runs.keys_;
}

std::vector<bool> steps_to_run(std::span<const Step> steps, std::span<const std::uint64_t> keys,
                               const std::function<bool(Handle, std::uint64_t key)>& held) {
  StepRuns runs;
  runs.find_stale(steps, keys, held);
  return runs.run_;
}

namespace {

std::vector<std::uint64_t> plan_keys(const Plan& plan) {
  std::map<Handle, std::uint64_t> uploaded;
  for (const Plan::Upload& upload : plan.uploads) uploaded[upload.buffer] = upload.key;
  return step_keys(plan.steps, [&](Handle h) { return uploaded.at(h); });
}

// which(image): whether it is to be kept.
template <class Which>
void keep_where(Algorithm& what, Which&& which) {
  std::visit(
      [&](auto& a) {
        a.fields(a, [&](const Field& field, auto& value) {
          if constexpr (std::is_same_v<Image, std::remove_cvref_t<decltype(value)>>) {
            if (field.role == Role::output && value && which(value)) value.keep = true;
          }
        });
      },
      what);
}

}  // namespace

std::vector<bool> steps_to_run(const Plan& plan, const std::function<bool(Handle, std::uint64_t key)>& held) {
  return steps_to_run(plan.steps, plan_keys(plan), held);
}

void keep_images(Plan& plan, const std::function<bool(Handle, std::uint64_t key)>& held, std::size_t most_bytes) {
  std::size_t bytes = 0;
  for (const Step& step : plan.steps) {
    each_made<Image>(step.what, [&](const Image& image) { bytes += image.keep ? 0 : sizeof(float) * image.floats(); });
  }
  if (bytes > most_bytes) return;
  const std::vector<std::uint64_t> keys = plan_keys(plan);
  for (std::size_t i = 0; i < plan.steps.size(); ++i)
    keep_where(plan.steps[i].what, [&](const Image& image) { return held(image, output_key(keys[i], image)); });
  const std::vector<bool> runs = steps_to_run(plan.steps, keys, held);
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    if (runs[i]) keep_where(plan.steps[i].what, [](const Image&) { return true; });
  }
}

}  // namespace airlight
