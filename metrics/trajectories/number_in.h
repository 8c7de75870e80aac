// Numbers in text files.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace throng::metrics {

/// The finite number that a word is, if it is one.
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
