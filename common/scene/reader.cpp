#include "common/scene/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/error.h"
#include "common/spelling.h"

namespace airlight {

namespace {

std::string_view article(json::Kind kind) {
  switch (kind) {
    case json::Kind::null:
      return "null";
    case json::Kind::boolean:
      return "true or false";
    case json::Kind::number:
      return "a number";
    case json::Kind::string:
      return "a string";
    case json::Kind::array:
      return "an array";
    case json::Kind::object:
      return "an object";
  }
  return "";
}

std::string expectation(const Range& r) {
  const std::string unit = r.unit.empty() ? "" : fmt::format(" [{}]", r.unit);
  return fmt::format("expected a number {} {} and <= {}{}", r.open ? ">" : ">=", r.least, r.most, unit);
}

// Words of other renderers for what this format calls otherwise.
constexpr std::array<std::array<std::string_view, 2>, 20> synonyms{
    {{"sigma_t", "extinction"}, {"density", "extinction"}, {"fov", "vertical_fov"}, {"yfov", "vertical_fov"},
     {"target", "look_at"},     {"lookat", "look_at"},     {"eye", "position"},     {"origin", "position"},
     {"size", "resolution"},    {"color", "diffuse"},      {"kd", "diffuse"},       {"ks", "specular"},
     {"power", "intensity"},    {"file", "mesh"},          {"matrix", "transform"}, {"translation", "translate"},
     {"rotation", "rotate"},    {"exponent", "shininess"}, {"objects", "surfaces"}, {"media", "medium"}}};

// ", did you mean ..." among the keys, or through a synonym of one of them.
std::string suggested(std::string_view word, std::span<const std::string_view> known) {
  const auto nearest = [&](std::string_view key) { return edit_distance(word, key); };
  for (const auto& [other, key] : synonyms) {
    const bool here = std::find(known.begin(), known.end(), key) != known.end();
    if (here && nearest(other) <= 1 && std::none_of(known.begin(), known.end(), [&](auto k) { return nearest(k) <= 1; })) {
      return ", did you mean \"" + std::string(key) + "\"?";
    }
  }
  return suggestion(word, known);
}

}  // namespace

void Node::fail(std::string_view what) const {
  throw InputError(json::message(*file_, value_->place, path_.empty() ? std::string(what) : fmt::format("{}: {}", path_, what)));
}

void Node::expect(json::Kind kind, std::string_view expected) const {
  if (value_->kind != kind) fail(fmt::format("{}, expected {}", article(value_->kind), expected));
}

double Node::number(const Range& r) const {
  expect(json::Kind::number, expectation(r).substr(9));
  const double v = value_->number;
  const bool inside = std::isfinite(v) && (r.open ? v > r.least : v >= r.least) && v <= r.most;
  if (!inside) fail(fmt::format("{}, {}", value_->text.substr(0, 40), expectation(r)));
  return v;
}

int Node::integer(int least, int most) const {
  const auto expected = fmt::format("a whole number from {} to {}", least, most);
  expect(json::Kind::number, expected);
  const double v = value_->number;
  if (!(v >= least && v <= most && v == std::floor(v)))
    fail(fmt::format("{}, expected {}", value_->text.substr(0, 40), expected));
  return static_cast<int>(v);
}

bool Node::boolean() const {
  expect(json::Kind::boolean, "true or false");
  return value_->boolean;
}

std::string Node::string() const {
  expect(json::Kind::string, "a string");
  if (value_->text.empty()) fail("an empty string, expected some text");
  for (const char c : value_->text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      fail(fmt::format("{}, expected text without control characters", json::quoted(value_->text)));
    }
  }
  return value_->text;
}

std::string Node::choice(std::span<const std::string_view> names) const {
  expect(json::Kind::string, fmt::format("one of: {}", joined(names, ", ")));
  if (std::find(names.begin(), names.end(), value_->text) != names.end()) return value_->text;
  fail(fmt::format("unknown {}{}", json::quoted(value_->text), suggestion(value_->text.substr(0, 60), names)));
}

std::vector<Node> Node::array() const {
  expect(json::Kind::array, "an array");
  std::vector<Node> nodes;
  nodes.reserve(value_->items.size());
  for (std::size_t i = 0; i < value_->items.size(); ++i)
    nodes.emplace_back(value_->items[i], *file_, fmt::format("{}[{}]", path_, i));
  return nodes;
}

glm::dvec3 Node::vec3(const Range& each) const {
  expect(json::Kind::array, "an array of 3 numbers");
  if (value_->items.size() != 3) fail(fmt::format("an array of {}, expected an array of 3 numbers", value_->items.size()));
  const std::vector<Node> nodes = array();
  return {nodes[0].number(each), nodes[1].number(each), nodes[2].number(each)};
}

glm::dmat4 Node::mat4(const Range& each) const {
  expect(json::Kind::array, "an array of 16 numbers, column by column");
  if (value_->items.size() != 16) {
    fail(fmt::format("an array of {}, expected an array of 16 numbers, column by column", value_->items.size()));
  }
  const std::vector<Node> nodes = array();
  glm::dmat4 m;
  for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = nodes[static_cast<std::size_t>(i)].number(each);
  return m;
}

Object::Object(const Node& node, std::span<const std::string_view> keys, std::span<const LaterKey> later) : node_(node) {
  if (node.value().kind != json::Kind::object) node.fail(fmt::format("{}, expected an object", article(node.value().kind)));
  for (const json::Value& member : node.value().items) {
    if (std::find(keys.begin(), keys.end(), member.key) != keys.end()) continue;
    const std::string prefix = node.path().empty() ? "" : node.path() + ".";
    for (const LaterKey& l : later) {
      if (l.key != member.key) continue;
      throw InputError(json::message(node.file(), member.key_place,
                                     fmt::format("{}{}: {} not supported by this version", prefix, l.key, l.what)));
    }
    throw InputError(
        json::message(node.file(), member.key_place,
                      fmt::format("unknown key {}{}{}", json::quoted(member.key), node.path().empty() ? "" : " in " + node.path(),
                                  suggested(std::string_view(member.key).substr(0, 60), keys))));
  }
}

std::optional<Node> Object::find(std::string_view key) const {
  for (const json::Value& member : node_.value().items) {
    if (member.key == key) {
      return Node(member, node_.file(), node_.path().empty() ? std::string(key) : fmt::format("{}.{}", node_.path(), key));
    }
  }
  return std::nullopt;
}

Node Object::require(std::string_view key) const {
  if (auto node = find(key)) return *node;
  node_.fail(fmt::format("missing key, expected \"{}\"", key));
}

}  // namespace airlight
