// Words for messages: lists of names, and the known name that a misspelt one is nearest to.
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace airlight {

inline std::string joined(std::span<const std::string_view> words, std::string_view between) {
  std::string all;
  for (const std::string_view word : words) {
    if (!all.empty()) all += between;
    all += word;
  }
  return all;
}

// Insertions, deletions and replacements that turn one word into the other (Levenshtein 1966).
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

// ", did you mean "x"?" for the nearest known name, else ", expected one of: ..."; empty when nothing is known.
inline std::string suggestion(std::string_view word, std::span<const std::string_view> known) {
  if (known.empty()) return "";
  const auto nearest = *std::min_element(known.begin(), known.end(), [&](std::string_view a, std::string_view b) {
    return edit_distance(word, a) < edit_distance(word, b);
  });
  if (edit_distance(word, nearest) <= std::max<std::size_t>(2, word.size() / 3)) {
    return ", did you mean \"" + std::string(nearest) + "\"?";
  }
  return ", expected one of: " + joined(known, ", ");
}

}  // namespace airlight
