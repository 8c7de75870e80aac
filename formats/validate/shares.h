// Shares of samples that may be wrong.
#pragma once

#include <cmath>
#include <cstddef>

namespace throng::formats {

/// Whether more than a share of what was looked at is wrong, by three standard errors of a share of
/// so many samples. Pixels and points lie in groups that are right or wrong together, of four on
/// the average, so that there are a quarter as many samples; people do not (`group` 1).
inline bool is_above_share(std::size_t wrong, std::size_t looked_at, double max_share,
                           double group = 4) {
  constexpr double kMinGroups = 10;  // fewer may be of one place
  if (static_cast<double>(looked_at) < kMinGroups * group) return false;
  constexpr double kSigmas = 3;
  const auto count = static_cast<double>(looked_at);
  const double deviation = std::sqrt(group * count * max_share * (1 - max_share));
  return static_cast<double>(wrong) > max_share * count + kSigmas * deviation;
}

}  // namespace throng::formats
