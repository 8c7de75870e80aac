// Cells of CSV tables.
#pragma once

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <string_view>

namespace throng::crowd {

/// Returns a text as a cell, in quotes if necessary (RFC 4180).
inline std::string csv_text(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) {
    quoted += c;
    if (c == '"') quoted += c;
  }
  return quoted + "\"";
}

/// Formats a number with `decimals` decimals; NaN as "nan" without a sign.
inline std::string csv_number(double value, int decimals) {
  return std::isnan(value) ? std::string("nan") : fmt::format("{:.{}f}", value, decimals);
}

}  // namespace throng::crowd
