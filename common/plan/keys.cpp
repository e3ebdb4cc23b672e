#include "common/plan/keys.h"

#include <map>
#include <set>

#include "common/plan/hash.h"

namespace airlight {

std::vector<std::uint64_t> step_keys(std::span<const Step> steps, const std::function<std::uint64_t(Handle)>& key_of_upload,
                                     std::span<const StepRows> rows) {
  std::map<Handle, std::uint64_t> written;
  std::vector<std::uint64_t> keys;
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
              const auto found = written.find(value);
              hash.add(found != written.end() ? found->second : key_of_upload(value));
            } else if constexpr (std::is_same_v<std::vector<Buffer>, std::remove_cvref_t<decltype(value)>>) {
              hash.add(value.size());
              for (const Buffer& b : value) {
                const auto found = written.find(b);
                hash.add(found != written.end() ? found->second : key_of_upload(b));
              }
            } else {
              hash.add(value);
            }
          });
        },
        step.what);
    const std::vector<Image> made = outputs_of(step.what);
    if (!rows.empty() && !made.empty()) {
      const std::uint64_t of_rows = key_of(rows[keys.size()], made[0].extent.height);
      if (of_rows != 0) hash.add(of_rows);
    }
    keys.push_back(hash.value());
    for (const Image& image : made) written[image] = output_key(keys.back(), image);
    for (const Buffer& buffer : buffers_made_by(step.what)) written[buffer] = output_key(keys.back(), buffer);
  }
  return keys;
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

std::vector<bool> steps_to_run(std::span<const Step> steps, std::span<const std::uint64_t> keys,
                               const std::function<bool(Handle, std::uint64_t key)>& held) {
  std::vector<bool> run(steps.size(), false);
  std::set<Handle> needed;  // by a later step that runs
  for (std::size_t i = steps.size(); i-- > 0;) {
    for (const Image& image : outputs_of(steps[i].what)) {
      const bool wanted = image.keep || needed.contains(image);
      if (wanted && !(image.keep && held(image, output_key(keys[i], image)))) run[i] = true;
      needed.erase(image);
    }
    for (const Buffer& buffer : buffers_made_by(steps[i].what)) {
      if (!held(buffer, output_key(keys[i], buffer))) run[i] = true;
    }
    if (!run[i]) continue;
    for (const Handle input : inputs_of(steps[i].what)) needed.insert(input);
  }
  return run;
}

}  // namespace airlight
