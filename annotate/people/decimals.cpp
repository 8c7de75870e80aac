#include "annotate/people/decimals.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "base/error.h"

namespace throng::annotate {

namespace {

std::int64_t decimal_unit(int decimals) {
  constexpr std::array<std::int64_t, 10> kPowers = {
      1, 10, 100, 1'000, 10'000, 100'000, 1'000'000, 10'000'000, 100'000'000, 1'000'000'000};
  return kPowers.at(static_cast<std::size_t>(decimals));
}

/// How often the unit of the last decimal is in the number.
std::int64_t scaled_by(double value, std::int64_t unit) {
  constexpr double kMaxValue = 1e9;
  check(std::isfinite(value) && std::abs(value) < kMaxValue, "every number in a dataset is finite");
  return std::llround(value * static_cast<double>(unit));
}

}  // namespace

double rounded(double value, int decimals) {
  const std::int64_t unit = decimal_unit(decimals);
  return static_cast<double>(scaled_by(value, unit)) / static_cast<double>(unit);
}

void append_decimal(std::string& text, double value, int decimals) {
  const std::int64_t unit = decimal_unit(decimals);
  std::int64_t scaled = scaled_by(value, unit);
  if (scaled < 0) {
    text.push_back('-');
    scaled = -scaled;
  }
  std::array<char, 24> digits;
  const auto whole = std::to_chars(digits.begin(), digits.end(), scaled / unit);
  text.append(digits.data(), whole.ptr);
  std::int64_t rest = scaled % unit;
  if (rest == 0) return;
  text.push_back('.');
  for (std::int64_t place = unit / 10; rest > 0; place /= 10) {
    text.push_back(static_cast<char>('0' + rest / place));
    rest %= place;
  }
}

}  // namespace throng::annotate
