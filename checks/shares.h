// Test of a share of wrong samples against a limit.
#pragma once

#include <cmath>
#include <cstddef>

namespace throng::checks {

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

/// Counts of samples, and of the wrong ones among them.
struct WrongTally {
  std::size_t looked_at = 0;
  std::size_t wrong = 0;
  void add(bool is_wrong) {
    ++looked_at;
    wrong += is_wrong ? 1 : 0;
  }
  double share() const {
    return looked_at == 0 ? 0 : static_cast<double>(wrong) / static_cast<double>(looked_at);
  }
};

}  // namespace throng::checks
