#include "places/blocked.h"

#include <algorithm>
#include <cmath>

namespace throng::places {

namespace {

constexpr double kDiscStepM = 2;
constexpr int kMostDiscSteps = 6;   // of one disaster
constexpr int kMostLateDiscs = 24;  // of all: classes are bits
constexpr double kLookAheadS = 300;
constexpr std::uint32_t kFirstLateClass = 8;

/// How much the radius grows (m).
double growth_of(const world::Disaster& seen) {
  return std::clamp(seen.most_m - seen.radius_m, 0.0, seen.growth_mps * kLookAheadS);
}

}  // namespace

std::vector<BlockedDisc> blocked_discs(const People& people) {
  std::vector<BlockedDisc> discs;
  int growing = 0;
  for (const Danger& danger : people.dangers) {
    if (danger.blocked_m <= 0) continue;
    discs.push_back({danger.seen.position, danger.blocked_m, danger.seen.start_s, 2});
    if (growth_of(danger.seen) > 0.5 * kDiscStepM) ++growing;
  }
  if (growing == 0 || growing > kMostLateDiscs) return discs;
  const int most = std::min(kMostDiscSteps, kMostLateDiscs / growing);
  std::uint32_t next_class = kFirstLateClass;
  for (const Danger& danger : people.dangers) {
    const double grows_m = growth_of(danger.seen);
    if (danger.blocked_m <= 0 || grows_m <= 0.5 * kDiscStepM) continue;
    const int steps = std::clamp(static_cast<int>(std::lround(grows_m / kDiscStepM)), 1, most);
    for (int k = 1; k <= steps; ++k, next_class *= 2) {
      const double more_m = grows_m * k / steps;
      discs.push_back({danger.seen.position, danger.blocked_m + more_m,
                       danger.seen.start_s + more_m / danger.seen.growth_mps, next_class});
    }
  }
  return discs;
}

}  // namespace throng::places
