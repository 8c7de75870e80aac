// Test of a share of wrong samples against a limit.
#pragma once

#include <cmath>
#include <cstddef>

namespace throng::formats {

/// Whether the share of wrong samples exceeds `max_share` by three standard errors. `group` is the
/// mean number of samples that are right or wrong together, which reduces the number of independent
/// ones: 4 for pixels and points, 1 for people. False for fewer than ten groups.
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
