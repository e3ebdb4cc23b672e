// JSON with comments as a small tree in which every value knows its place.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace airlight::json {

// Both from 1. A column is a UTF-8 character (a code point), not a byte; a line ends with a line feed, so CRLF counts
// as one end.
struct Place {
  int line = 1, column = 1;
};

enum class Kind { null, boolean, number, string, array, object };

struct Value {
  Kind kind = Kind::null;
  Place place;  // of its first character
  bool boolean = false;
  double number = 0;
  std::string text;          // of a string, unescaped; of a number, as it was written
  std::string key;           // of an object's member
  Place key_place;           // of an object's member
  std::vector<Value> items;  // of an array, or an object's members in the order of the file
};

// Throws InputError "name:line:column: ...": syntax, duplicate keys, byte order mark, wrong encoding, numbers that a
// double cannot hold, nesting deeper than 64. `line`: of the file, where the text begins.
Value parse(std::string_view text, const std::string& name, int line = 1);

// "name:line:column: what"
std::string message(const std::string& name, Place place, std::string_view what);

// In double quotes on one line: control characters and quotes escaped, cut after 60 bytes.
std::string quoted(std::string_view text);

}  // namespace airlight::json
