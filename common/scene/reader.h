// Reads JSON values by type and range. Every failure is an InputError with its place and what was expected.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/scene/json.h"

namespace airlight {

// What a number may be. Every scene number has finite ends, so that single precision can hold what is made of it.
struct Range {
  double least, most;
  std::string_view unit;  // "m", "1/m"; empty: a plain number
  bool open = false;      // `least` itself is excluded
};

// A value with the path that leads to it ("medium.gaussians[2].radius").
class Node {
 public:
  Node(const json::Value& value, const std::string& file, std::string path)
      : value_(&value), file_(&file), path_(std::move(path)) {}

  // "file:line:column: path: what", at the value.
  [[noreturn]] void fail(std::string_view what) const;

  double number(const Range&) const;
  int integer(int least, int most) const;
  bool boolean() const;
  std::string string() const;  // not empty, no control characters
  std::string choice(std::span<const std::string_view> names) const;
  std::vector<Node> array() const;
  glm::dvec3 vec3(const Range& each) const;
  glm::dmat4 mat4(const Range& each) const;  // 16 numbers, column-major

  const json::Value& value() const { return *value_; }
  const std::string& file() const { return *file_; }
  const std::string& path() const { return path_; }

 private:
  void expect(json::Kind, std::string_view expected) const;

  const json::Value* value_;
  const std::string* file_;
  std::string path_;
};

// A key of the format that this version refuses, and what it would be: {"grid", "voxel grids"}.
struct LaterKey {
  std::string_view key, what;
};

// The members of an object. Unknown keys and those of later versions are errors at once.
class Object {
 public:
  Object(const Node&, std::span<const std::string_view> keys, std::span<const LaterKey> later = {});

  std::optional<Node> find(std::string_view key) const;
  Node require(std::string_view key) const;

  const Node& node() const { return node_; }

 private:
  Node node_;
};

// The keys of one object as an array: keys("a", "b").
template <class... T>
constexpr auto keys(T... names) {
  return std::array<std::string_view, sizeof...(T)>{std::string_view(names)...};
}

}  // namespace airlight
