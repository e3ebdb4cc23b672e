#include "common/scene/json_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace airlight::json {

namespace {

constexpr std::size_t widest = 120;  // characters of a line, where it can be broken

std::string on_one_line(const Value& v) {
  switch (v.kind) {
    case Kind::null:
      return "null";
    case Kind::boolean:
      return v.boolean ? "true" : "false";
    case Kind::number:
      return v.text;
    case Kind::string:
      return written(v.text);
    default:
      break;
  }
  const bool is_object = v.kind == Kind::object;
  const bool spaced = is_object || (!v.items.empty() && v.items.front().kind == Kind::object);
  std::string all;
  for (const Value& item : v.items) {
    if (!all.empty()) all += ", ";
    if (is_object) all += written(item.key) + ": ";
    all += on_one_line(item);
  }
  if (all.empty()) return is_object ? "{}" : "[]";
  const std::string_view space = spaced ? " " : "";
  return fmt::format("{}{}{}{}{}", is_object ? '{' : '[', space, all, space, is_object ? '}' : ']');
}

void write(const Value& v, std::size_t indent, std::size_t used, std::string& out) {
  const std::string line = on_one_line(v);
  const bool breaks = (v.kind == Kind::object || v.kind == Kind::array) && !v.items.empty();
  if (!breaks || (indent > 0 && indent + used + line.size() <= widest)) {
    out += line;
    return;
  }
  const bool is_object = v.kind == Kind::object;
  out += is_object ? "{\n" : "[\n";
  for (const Value& item : v.items) {
    out.append(indent + 2, ' ');
    const std::string key = is_object ? written(item.key) + ": " : "";
    out += key;
    write(item, indent + 2, key.size(), out);
    out += &item == &v.items.back() ? "\n" : ",\n";
  }
  out.append(indent, ' ');
  out += is_object ? '}' : ']';
}

}  // namespace

std::string written(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<std::uint8_t>(c) < 0x20) {
      out += fmt::format("\\u{:04x}", static_cast<std::uint8_t>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string text_of(const Value& v) {
  std::string out;
  write(v, 0, 0, out);
  return out;
}

Value number(double v) {
  Value value;
  value.kind = Kind::number;
  value.number = v + 0.0;  // -0 is 0
  value.text = fmt::format("{}", value.number);
  return value;
}

Value string(std::string text) {
  Value value;
  value.kind = Kind::string;
  value.text = std::move(text);
  return value;
}

Value array() {
  Value value;
  value.kind = Kind::array;
  return value;
}

Value object() {
  Value value;
  value.kind = Kind::object;
  return value;
}

const Value* member(const Value& object, std::string_view key) {
  const auto at = std::find_if(object.items.begin(), object.items.end(), [&](const Value& m) { return m.key == key; });
  return object.kind == Kind::object && at != object.items.end() ? &*at : nullptr;
}

Value* member(Value& object, std::string_view key) { return const_cast<Value*>(member(std::as_const(object), key)); }

void set(Value& object, std::string_view key, Value value) {
  value.key = key;
  if (Value* there = member(object, key)) {
    *there = std::move(value);
  } else {
    object.items.push_back(std::move(value));
  }
}

void remove(Value& object, std::string_view key) {
  std::erase_if(object.items, [&](const Value& m) { return m.key == key; });
}

}  // namespace airlight::json
