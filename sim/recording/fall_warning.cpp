#include "sim/recording/fall_warning.h"

#include <cmath>
#include <vector>

namespace throng::sim {

namespace {

constexpr double kHazardM = 3;

}  // namespace

GroundImpact ground_impact(const FlightState& state) {
  const double up_mps = state.velocity.z();
  const double height_m = std::max(0.0, state.position.z());
  const double in_s = (up_mps + std::sqrt(up_mps * up_mps + 2 * kGravity * height_m)) / kGravity;
  return {in_s, state.position.head<2>() + in_s * state.velocity.head<2>()};
}

void FallWarning::update(double time_s, const FallingCraft& vehicle, const PeopleInMotion& people,
                         const std::function<void(const world::TraceEvent&)>& log) {
  if (done_ || vehicle.can_hold) return;
  done_ = true;
  const double height_m = vehicle.state.position.z();
  if (height_m <= kPersonHeightM) return;
  std::vector<NearPerson> near;
  people.collect({vehicle.state.position.head<2>(), height_m}, near);
  world::TraceEvent event;
  event.time_s = time_s;
  event.type = "falling";
  event.drone = static_cast<std::int32_t>(drone_);
  event.value = height_m;
  event.extra = static_cast<double>(near.size());
  log(event);
  const GroundImpact impact = ground_impact(vehicle.state);
  near.clear();
  people.collect({impact.place, vehicle.radius_m + kHazardM}, near);
  event.type = "fall_hazard";
  for (const NearPerson& person : near) {
    event.agent = person.agent;
    event.value = (person.position - impact.place).norm();
    event.extra = impact.in_s;
    log(event);
  }
}

}  // namespace throng::sim
