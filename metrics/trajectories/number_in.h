// Parsing of numbers in text files.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace throng::metrics {

/// Parses a word that is a finite number as a whole, possibly with a leading '+'; else returns
/// nothing.
inline std::optional<double> number_in(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0;
  const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
  if (result.ec != std::errc() || result.ptr != word.data() + word.size() ||
      !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

}  // namespace throng::metrics
