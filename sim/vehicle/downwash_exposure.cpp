#include "sim/vehicle/downwash_exposure.h"

#include <algorithm>

namespace throng::sim {

namespace {

constexpr double kFastAirMps = 5;  // Beaufort 4 begins at 5.5: dust and paper fly
constexpr double kHeadM = 1.6;
constexpr double kSameExposureS = 1;

}  // namespace

double DownwashExposure::reach_m(const Jet& jet, double height_m) {
  const double below_m = height_m - kHeadM;
  if (jet.speed_mps(below_m, 0) < kFastAirMps) return 0;
  double reach = 0;
  constexpr double kStepM = 0.05;
  while (jet.speed_mps(below_m, reach) >= kFastAirMps) reach += kStepM;
  return reach;
}

void DownwashExposure::update(double time_s, double dt_s, std::size_t vehicle, const Jet& jet,
                              const Eigen::Vector3d& position, std::span<const NearPerson> people) {
  for (const NearPerson& person : people) {
    const double aside_m = (person.position - position.head<2>()).norm();
    const double speed_mps = jet.speed_mps(position.z() - kHeadM, aside_m);
    if (speed_mps < kFastAirMps) continue;
    const auto [entry, is_new] =
        exposures_.try_emplace({vehicle, person.agent}, Exposure{time_s, time_s, 0, 0});
    Exposure& exposure = entry->second;
    exposure.last_s = time_s;
    exposure.seconds += dt_s;
    exposure.fastest_mps = std::max(exposure.fastest_mps, speed_mps);
  }
}

void DownwashExposure::flush(double time_s, bool all) {
  for (auto entry = exposures_.begin(); entry != exposures_.end();) {
    const auto& [pair, exposure] = *entry;
    if (!all && time_s - exposure.last_s < kSameExposureS) {
      ++entry;
      continue;
    }
    log_({exposure.from_s, world::Downwash{static_cast<std::int32_t>(pair.first), pair.second,
                                           exposure.seconds, exposure.fastest_mps}});
    entry = exposures_.erase(entry);
  }
}

}  // namespace throng::sim
