// JSON trees as text.
#pragma once

#include <string>
#include <string_view>

#include "common/scene/json.h"

namespace airlight::json {

// A string in double quotes, escaped, whole.
std::string written(std::string_view text);

// A value over as many lines as it needs: what fits stands on one. Numbers keep their text; reading it gives the same tree,
// places aside. Ends without a line end.
std::string text_of(const Value&);

// Values to put into a tree.
Value number(double v);  // the shortest text that gives the same double
Value string(std::string text);
Value array();
Value object();
// Adds or replaces a member of an object.
void set(Value& object, std::string_view key, Value);
void remove(Value& object, std::string_view key);
const Value* member(const Value& object, std::string_view key);  // null where there is none
Value* member(Value& object, std::string_view key);

}  // namespace airlight::json
