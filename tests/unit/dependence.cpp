#include "tests/unit/dependence.h"

#include <cstring>
#include <set>
#include <stdexcept>
#include <type_traits>

namespace airlight {

namespace {

// Every bit of a field. Members are bound by place: a struct that gets another one no longer compiles here.
class Exact {
 public:
  std::string bytes;

  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void put(T v) {
    if constexpr (std::is_floating_point_v<T>) v += T(0);  // -0 and 0 are one value
    char raw[sizeof v];
    std::memcpy(raw, &v, sizeof v);
    bytes.append(raw, sizeof v);
  }
  void put(glm::vec2 v) { all(v.x, v.y); }
  void put(glm::vec3 v) { all(v.x, v.y, v.z); }
  void put(const glm::vec4& v) { all(v.x, v.y, v.z, v.w); }
  void put(const Extent& e) {
    const auto& [width, height] = e;
    all(width, height);
  }
  void put(const View& view) {
    const auto& [right, up, forward, tan_half_fov, near_plane, offset, extent] = view;
    all(right, up, forward, tan_half_fov, near_plane, offset, extent);
  }
  void put(const Light& light) {
    const auto& [vector, power, radius, directional] = light;
    all(vector, power, radius, directional);
  }
  void put(const Phase& phase) {
    const auto& [kind, g] = phase;
    all(kind, g);
  }
  void put(const Material& material) {
    const auto& [diffuse, specular, shininess] = material;
    all(diffuse, specular, shininess);
  }
  void put(const GaussianDensity& gaussian) {
    const auto& [center, radius, extinction, reach, albedo, emission] = gaussian;
    all(center, radius, extinction, reach, albedo, emission);
  }
  void put(const RayNoise& noise) {
    const auto& [amplitude, scale, offset] = noise;
    all(amplitude, scale, offset);
  }
  void put(const GridDensity& grid) {
    const auto& [cells, size, albedo, half_unit] = grid;
    all(cells[0], cells[1], cells[2], size, albedo, half_unit);
  }
  void put(const DepthVolume& volume) {
    const auto& [kind, rows, first, scale, nodes, halves] = volume;
    all(kind, rows[0], rows[1], rows[2], first, scale, nodes, halves);
  }
  void put(const DepthLattice& lattice) {
    const auto& [corner, spacing, nodes, first] = lattice;
    all(corner, spacing, nodes.x, nodes.y, nodes.z, first);
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put(values.size());
    for (const T& v : values) put(v);
  }

 private:
  template <class... T>
  void all(const T&... values) {
    (put(values), ...);
  }
};

}  // namespace

std::vector<bool> Contents::run(const Plan& plan, const Uploaded& uploaded, bool still) {
  for (const Plan::Upload& upload : plan.uploads) {
    const std::vector<std::byte>& bytes = uploaded.at(upload.buffer);
    held_[upload.buffer] = number("upload" + std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  }
  std::map<Handle, Number> made;  // by this plan
  const auto content_of = [&](Handle h) {
    if (const auto found = made.find(h); found != made.end()) return found->second;
    const auto found = held_.find(h);
    if (found == held_.end()) throw std::logic_error("a step reads what nobody made");
    return found->second;
  };
  for (const Step& step : plan.steps) {
    Exact exact;
    exact.bytes = name_of(step.what);
    const auto read = [&](Handle h) { exact.put(h ? content_of(h) : 0); };
    std::visit(
        [&](const auto& a) {
          a.fields(a, [&](const Field& field, const auto& value) {
            using Value = std::remove_cvref_t<decltype(value)>;
            if constexpr (std::is_base_of_v<Handle, Value>) {
              if (field.role == Role::input) read(value);
              if (field.role == Role::output) exact.put(static_cast<bool>(value));
            } else if constexpr (std::is_same_v<Value, std::vector<Buffer>>) {
              exact.put(value.size());
              for (const Buffer& b : value) read(b);
            } else {
              exact.put(value);
            }
          });
        },
        step.what);
    for (const Image& image : outputs_of(step.what)) {
      Exact named = exact;
      named.put(image.id), named.put(image.extent), named.put(image.layers);
      made[image] = number(named.bytes);
    }
    for (const Buffer& buffer : buffers_made_by(step.what)) {
      Exact named = exact;
      named.put(buffer.id), named.put(buffer.bytes);
      made[buffer] = number(named.bytes);
    }
  }

  // From the last step to the first: one whose kept results are not those that are held, or that is asked by one that runs.
  const auto is_held = [&](Handle h) {
    const auto found = held_.find(h);
    return found != held_.end() && found->second == made.at(h);
  };
  std::vector<bool> runs(plan.steps.size());
  std::set<Handle> asked;
  for (std::size_t i = plan.steps.size(); i-- > 0;) {
    const Algorithm& what = plan.steps[i].what;
    for (const Image& image : outputs_of(what))
      if ((image.keep || asked.contains(image)) && !((image.keep || still) && is_held(image))) runs[i] = true;
    for (const Buffer& buffer : buffers_made_by(what))
      if (!is_held(buffer)) runs[i] = true;
    if (!runs[i]) continue;
    for (const Handle input : inputs_of(what)) asked.insert(input);
  }
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    if (!runs[i]) continue;
    for (const Image& image : outputs_of(plan.steps[i].what)) {
      held_.erase(image);
      if (image.keep || still) held_[image] = made.at(image);
    }
    for (const Buffer& buffer : buffers_made_by(plan.steps[i].what)) held_[buffer] = made.at(buffer);
  }
  return runs;
}

}  // namespace airlight
