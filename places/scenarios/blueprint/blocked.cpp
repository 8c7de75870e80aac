#include "places/scenarios/blueprint/blocked.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/geometry/polygon.h"

namespace throng::scenarios {

namespace {

constexpr double kDiscStepM = 2;
constexpr int kMaxDiscSteps = 6;   // of one disaster
constexpr int kMaxLateDiscs = 24;  // of all: classes are bits
constexpr double kLookAheadS = 300;
constexpr std::uint32_t kFirstLateClass = 8;

/// How much the radius grows (m).
double growth_margin(const world::Disaster& seen) {
  return std::clamp(seen.max_radius_m - seen.radius_m, 0.0, seen.growth_mps * kLookAheadS);
}

bool does_grow(const Danger& danger) {
  return danger.blocked_m > 0 && growth_margin(danger.seen) > 0.5 * kDiscStepM;
}

/// As exact as files say it, so that all who read them agree.
double file_time_s(double time_s) { return std::round(100 * time_s) / 100; }

/// When the first disaster starts; nobody flees before.
double first_start_s(const People& people) {
  double first_s = std::numeric_limits<double>::infinity();
  for (const Danger& danger : people.dangers) first_s = std::min(first_s, danger.seen.start_s);
  return first_s;
}

}  // namespace

std::vector<BlockedDisc> blocked_discs(const People& people) {
  const double first_s = first_start_s(people);
  const auto starts_late = [&](const Danger& danger) {
    return danger.blocked_m > 0 && danger.seen.start_s > first_s;
  };
  const auto late =
      static_cast<int>(std::count_if(people.dangers.begin(), people.dangers.end(), starts_late));
  const auto growing =
      static_cast<int>(std::count_if(people.dangers.begin(), people.dangers.end(), does_grow));
  const int max_steps = std::min(kMaxDiscSteps, (kMaxLateDiscs - late) / std::max(1, growing));
  std::vector<BlockedDisc> discs;
  std::uint32_t next_class = kFirstLateClass;
  const auto take_class = [&] {
    const std::uint32_t taken = next_class;
    next_class *= 2;
    return taken;
  };
  for (const Danger& danger : people.dangers) {
    if (danger.blocked_m <= 0) continue;
    const world::Disaster& seen = danger.seen;
    const bool is_apart = starts_late(danger) && late <= kMaxLateDiscs;
    discs.push_back({seen.position, danger.blocked_m, file_time_s(seen.start_s),
                     is_apart ? take_class() : kFirstClass});
    if (!does_grow(danger) || max_steps < 1) continue;
    const double grows_m = growth_margin(seen);
    const int steps = std::clamp(static_cast<int>(std::lround(grows_m / kDiscStepM)), 1, max_steps);
    for (int k = 1; k <= steps; ++k) {
      const double more_m = grows_m * k / steps;
      discs.push_back({seen.position, danger.blocked_m + more_m,
                       file_time_s(seen.start_s + more_m / seen.growth_mps), take_class()});
    }
  }
  return discs;
}

const BlockedDisc* first_to_reach(const world::Exit& exit, const std::vector<BlockedDisc>& discs) {
  const BlockedDisc* first = nullptr;
  for (const BlockedDisc& disc : discs) {
    if (geometry::distance_to_segment(exit.from, exit.to, disc.middle) >= disc.radius_m) continue;
    if (first == nullptr || disc.from_s < first->from_s) first = &disc;
  }
  return first;
}

bool can_flee_by(const BlockedDisc* first) {
  return first == nullptr || first->obstacle_class != kFirstClass;
}

}  // namespace throng::scenarios
