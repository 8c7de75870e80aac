// Shares of samples that may be wrong.
#pragma once

#include <cmath>
#include <cstddef>

namespace throng::formats {

/// Whether more than a share of what was looked at is wrong, by three standard errors of a share of
/// so many samples. Pixels and points lie in groups that are right or wrong together, of four on
/// the average, so that there are a quarter as many samples.
inline bool is_above_share(std::size_t wrong, std::size_t looked_at, double max_share) {
  constexpr std::size_t kMinCount = 40;  // fewer may be of one place
  if (looked_at < kMinCount) return false;
  constexpr double kSigmas = 3;
  constexpr double kGroup = 4;
  const auto count = static_cast<double>(looked_at);
  const double deviation = std::sqrt(kGroup * count * max_share * (1 - max_share));
  return static_cast<double>(wrong) > max_share * count + kSigmas * deviation;
}

}  // namespace throng::formats
