// Random edits of a small scene and of what is asked for, the same ones for the same seed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "common/random.h"
#include "tests/unit/small_work.h"

namespace airlight {

class Edits {
 public:
  Edits(std::uint32_t seed, std::string_view technique) : random_({seed, 1}, 0), technique_(technique) {}

  // Changes one thing, or takes back some changes, or does nothing; returns which.
  std::string_view next(Work&);
  // The last change was not accepted.
  void refused() { history_.pop_back(); }

  double between(double from, double to) { return from + (to - from) * random_.next(); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(random_.next() * static_cast<double>(n)); }
  template <class T>
  T& one_of(std::vector<T>& all) {
    return all[below(all.size())];
  }
  template <class T>
  T one_of(std::initializer_list<T> all) {
    return all.begin()[below(all.size())];
  }
  glm::dvec3 place(double size) { return {between(-size, size), between(-size, size), between(-size, size)}; }
  glm::dvec3 colour() { return {one_of({0.0, 0.5, 1.0}), between(0, 1), between(0, 1)}; }
  bool uneven() const { return technique_ != "shadow-planes"; }
  bool grids() const { return uneven() && technique_ != "gaussian-airlight"; }

 private:
  Random random_;
  std::string technique_;
  std::vector<Work> history_;
};

}  // namespace airlight
