// Warnings about falling drones and the people near the ground impact.
#pragma once

#include <cstddef>
#include <functional>

#include "sim/vehicle/people_nearby.h"
#include "sim/vehicle/quadcopter.h"
#include "world/trace.h"

namespace throng::sim {

/// The state of a drone that is relevant to a fall.
struct FallingCraft {
  FlightState state;
  bool can_hold = true;  ///< all rotors work and turn
  double radius_m = 0;
};

/// Time until (s) and horizontal position of (m) the ground impact of a body in free fall without
/// drag.
struct GroundImpact {
  double in_s = 0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
};
GroundImpact ground_impact(const FlightState& state);

/// The warnings of one drone. Logs these events, once, when the drone can no longer stay in the air
/// and is more than a person's height above the ground:
/// - `falling`: value: height, m; extra: number of people within a horizontal distance of one
///   height from the drone (the 1:1 rule of EASA's AMC to Regulation (EU) 2019/947);
/// - `fall_hazard` for each person within 3 m plus the drone's radius of the predicted ground
///   impact: value: distance from the impact, m; extra: time until the impact, s.
class FallWarning {
 public:
  explicit FallWarning(std::size_t drone) : drone_(drone) {}

  void update(double time_s, const FallingCraft& vehicle, const MovingPeople& people,
              const std::function<void(const world::TraceEvent&)>& log);

 private:
  std::size_t drone_;
  bool done_ = false;
};

}  // namespace throng::sim
