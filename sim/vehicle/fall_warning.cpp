#include "sim/vehicle/fall_warning.h"

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

void FallWarning::update(double time_s, const FallingCraft& vehicle, const MovingPeople& people,
                         const std::function<void(const world::TraceEvent&)>& log) {
  if (done_ || vehicle.can_hold) return;
  done_ = true;
  const double height_m = vehicle.state.position.z();
  if (height_m <= kPersonHeightM) return;
  std::vector<NearPerson> near;
  people.collect({vehicle.state.position.head<2>(), height_m}, near);
  const auto drone = static_cast<std::int32_t>(drone_);
  log({time_s, world::Falling{drone, height_m, static_cast<int>(near.size())}});
  const GroundImpact impact = ground_impact(vehicle.state);
  near.clear();
  people.collect({impact.place, vehicle.radius_m + kHazardM}, near);
  for (const NearPerson& person : near) {
    const double distance_m = (person.position - impact.place).norm();
    log({time_s, world::FallHazard{drone, person.agent, distance_m, impact.in_s}});
  }
}

}  // namespace throng::sim
