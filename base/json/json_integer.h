// Integers as JSON Schema has them.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

namespace throng {

/// Whether a value is a number without a fraction, however it is written: 2, 2.0 and 1e3 are
/// (JSON Schema, draft 6 and later). Numbers beyond 2^53 have to be written as integers.
inline bool is_integer(const nlohmann::json& value) {
  if (value.is_number_integer()) return true;
  if (!value.is_number_float()) return false;
  constexpr double kMaxExact = 9007199254740992;
  const double number = value.get<double>();
  return std::abs(number) <= kMaxExact && number == std::trunc(number);
}

}  // namespace throng
