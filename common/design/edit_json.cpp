// Edits from JSON and to JSON.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <utility>

#include "common/design/edit_fields.h"
#include "common/design/edit_script.h"
#include "common/scene/json_text.h"
#include "common/scene/reader.h"

namespace airlight {

namespace {

constexpr double most_seed = 4294967295.0;  // 32 bits

glm::dvec2 vec2(const Node& node, const Range& range) {
  const std::vector<Node> both = node.array();
  if (both.size() != 2) node.fail("expected an array of 2 numbers, right and up");
  return {both[0].number(range), both[1].number(range)};
}

DesignPlane plane_of(const Node& node) {
  static constexpr auto known = keys("point", "normal");
  const Object o(node, known);
  DesignPlane plane;
  plane.point = o.require("point").vec3(limits::coordinate);
  const Node normal = o.require("normal");
  plane.normal = normal.vec3(limits::component);
  if (glm::length(plane.normal) < 1e-9) normal.fail("a zero vector, expected a direction");
  return plane;
}

// The names of an edit's keys.
class Names {
 public:
  std::vector<std::string_view> all{"edit"};
  template <class T>
  void value(std::string_view key, T&, const Range&, bool = false) {
    all.push_back(key);
  }
  template <class T>
  void list(std::string_view key, T&, const Range&, bool = false) {
    all.push_back(key);
  }
  template <class T>
  void plane(std::string_view key, T&) {
    all.push_back(key);
  }
  template <class T>
  void text(std::string_view key, T&) {
    all.push_back(key);
  }
  template <class T>
  void light(std::string_view key, T&) {
    all.push_back(key);
  }
  template <class T>
  void settings(std::string_view key, T&) {
    all.push_back(key);
  }
  template <class T>
  void seed(std::string_view key, T&) {
    all.push_back(key);
  }
};

class Reading {
 public:
  explicit Reading(const Object& object) : object_(object) {}

  void value(std::string_view key, double& v, const Range& range, bool required = false) {
    if (const auto node = find(key, required)) v = node->number(range);
  }
  void value(std::string_view key, glm::dvec2& v, const Range& range, bool required = false) {
    if (const auto node = find(key, required)) v = vec2(*node, range);
  }
  void value(std::string_view key, glm::dvec3& v, const Range& range, bool required = false) {
    if (const auto node = find(key, required)) v = node->vec3(range);
  }
  template <class T>
  void value(std::string_view key, std::optional<T>& v, const Range& range) {
    if (!object_.find(key)) return;
    value(key, v.emplace(), range);
  }
  void list(std::string_view key, std::vector<glm::dvec2>& v, const Range& range, bool required = false) {
    if (const auto node = find(key, required)) {
      for (const Node& n : node->array()) v.push_back(vec2(n, range));
    }
  }
  void list(std::string_view key, std::vector<glm::dvec3>& v, const Range& range, bool required = false) {
    if (const auto node = find(key, required)) {
      for (const Node& n : node->array()) v.push_back(n.vec3(range));
    }
  }
  void plane(std::string_view key, std::optional<DesignPlane>& v) {
    if (const auto node = object_.find(key)) v = plane_of(*node);
  }
  void text(std::string_view key, std::string& v) { v = object_.require(key).string(); }
  void light(std::string_view key, std::string& v) {
    const Node node = object_.require(key);
    v = node.value().kind == json::Kind::number ? std::to_string(node.integer(0, 1000000)) : node.string();
  }
  void settings(std::string_view key, std::vector<std::pair<std::string, std::string>>& v) {
    const auto node = object_.find(key);
    if (!node) return;
    if (node->value().kind != json::Kind::object) node->fail("expected an object");
    for (const json::Value& m : node->value().items) {
      const Node setting(m, node->file(), node->path() + "." + m.key);
      const bool number = m.kind == json::Kind::number;
      v.emplace_back(m.key, number ? fmt::format("{}", m.number) : setting.string());
    }
  }
  void seed(std::string_view key, std::int64_t& v) {
    const auto node = object_.find(key);
    if (!node) return;
    const double number = node->number({0, most_seed, ""});
    v = static_cast<std::int64_t>(number);
    if (static_cast<double>(v) != number) node->fail("expected a whole number");
  }

 private:
  std::optional<Node> find(std::string_view key, bool required) const {
    return required ? std::optional<Node>(object_.require(key)) : object_.find(key);
  }
  const Object& object_;
};

std::string text_of(double v) { return fmt::format("{}", v + 0.0); }
std::string text_of(const glm::dvec2& v) { return fmt::format("[{}, {}]", v.x + 0.0, v.y + 0.0); }
std::string text_of(const glm::dvec3& v) { return fmt::format("[{}, {}, {}]", v.x + 0.0, v.y + 0.0, v.z + 0.0); }

// Tells what differs from a standard edit of the same kind.
class Writing {
 public:
  std::string line;
  // Visited twice: the standard edit leaves its values, with which those of the edit are then compared.
  bool learning = true;

  template <class T>
  void value(std::string_view key, T& v, const Range&, bool required = false) {
    add(key, text_of(v), required);
  }
  template <class T>
  void value(std::string_view key, std::optional<T>& v, const Range&) {
    add(key, v ? text_of(*v) : "", false);
  }
  template <class T>
  void list(std::string_view key, std::vector<T>& v, const Range&, bool required = false) {
    std::string all;
    for (const T& p : v) all += (all.empty() ? "" : ", ") + text_of(p);
    add(key, v.empty() && !required ? "" : "[" + all + "]", required);
  }
  void plane(std::string_view key, std::optional<DesignPlane>& v) {
    add(key, v ? fmt::format("{{\"point\": {}, \"normal\": {}}}", text_of(v->point), text_of(v->normal)) : "", false);
  }
  void text(std::string_view key, std::string& v) { add(key, json::written(v), true); }
  void light(std::string_view key, std::string& v) { text(key, v); }
  void settings(std::string_view key, std::vector<std::pair<std::string, std::string>>& v) {
    std::string all;
    for (const auto& [name, setting] : v)
      all += fmt::format("{}{}: {}", all.empty() ? "" : ", ", json::written(name), json::written(setting));
    add(key, v.empty() ? "" : "{" + all + "}", false);
  }
  void seed(std::string_view key, std::int64_t& v) { add(key, std::to_string(v), false); }

 private:
  void add(std::string_view key, std::string value, bool required) {
    if (learning) {
      standard_.push_back(std::move(value));
      return;
    }
    const std::string& usual = standard_[at_++];
    if (value.empty() || (value == usual && !required)) return;
    line += fmt::format(", \"{}\": {}", key, value);
  }
  std::vector<std::string> standard_;
  std::size_t at_ = 0;
};

// The name of each kind of edit, in the order of the variant.
constexpr std::array<std::string_view, std::variant_size_v<Edit>> edit_names{
    "paint", "airbrush", "erase", "emit", "copy", "paste", "move", "light", "fog", "camera", "technique", "undo", "redo"};

template <std::size_t I = 0>
Edit edit_of(std::size_t kind, const Node& node) {
  if constexpr (I < std::variant_size_v<Edit>) {
    if (kind != I) return edit_of<I + 1>(kind, node);
    std::variant_alternative_t<I, Edit> edit;
    Names names;
    edit_fields::visit(names, edit);
    Object object(node, names.all);
    Reading reading(object);
    edit_fields::visit(reading, edit);
    return edit;
  } else {
    node.fail("unknown edit");
  }
}

}  // namespace

Edit parse_edit(const Node& node) {
  if (node.value().kind != json::Kind::object) node.fail("expected an edit, a JSON object with the key \"edit\"");
  for (const json::Value& member : node.value().items) {
    if (member.key != "edit") continue;
    const std::string name = Node(member, node.file(), "edit").choice(edit_names);
    return edit_of(static_cast<std::size_t>(std::find(edit_names.begin(), edit_names.end(), name) - edit_names.begin()), node);
  }
  node.fail("missing key, expected \"edit\"");
}

std::string line_of(const Edit& edit) {
  Writing writing;
  std::visit(
      [&](auto e) {
        decltype(e) standard;
        edit_fields::visit(writing, standard);
        writing.learning = false;
        edit_fields::visit(writing, e);
      },
      edit);
  return fmt::format("{{\"edit\": \"{}\"{}}}\n", edit_names[edit.index()], writing.line);
}

}  // namespace airlight
