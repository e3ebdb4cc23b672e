// What can go wrong, by who can mend it. The library throws these; only the program prints them and exits.
#pragma once

#include <stdexcept>
#include <string>

namespace airlight {

// The input or the request is wrong: a scene file, a flag, a setting. Program exit code 2.
// what() is one line: "file:line:column: what was found, what was expected" as far as each is known.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The machine cannot: no GL context, no such SIMD target, disk full. Program exit code 3.
class MachineError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The caller asked to stop (see Progress::stop_requested). Program exit code 130.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace airlight
