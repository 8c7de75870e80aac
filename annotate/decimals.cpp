#include "annotate/decimals.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "base/error.h"

namespace throng::annotate {

void append_decimal(std::string& text, double value, int decimals) {
  constexpr std::array<std::int64_t, 10> kPowers = {
      1, 10, 100, 1'000, 10'000, 100'000, 1'000'000, 10'000'000, 100'000'000, 1'000'000'000};
  constexpr double kLargest = 1e9;
  check(std::isfinite(value) && std::abs(value) < kLargest, "every number in a dataset is finite");
  const std::int64_t unit = kPowers.at(static_cast<std::size_t>(decimals));
  std::int64_t scaled = std::llround(value * static_cast<double>(unit));
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
