// Warns of a drone that falls: who is near the place where it comes down.
#pragma once

#include <cstddef>
#include <functional>

#include "sim/vehicle/people_nearby.h"
#include "sim/vehicle/quadcopter.h"
#include "world/trace.h"

namespace throng::sim {

/// A drone as far as its fall goes.
struct FallingCraft {
  FlightState state;
  bool can_hold = true;  ///< all rotors work and turn
  double radius_m = 0;
};

/// Time (s) and horizontal place (m) at which a body in free fall without drag reaches the ground.
struct GroundImpact {
  double in_s = 0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
};
GroundImpact ground_impact(const FlightState& state);

/// One drone's. Writes, once, when the drone can no longer hold itself in the air and is more than
/// a person's height above the ground:
/// - `falling`: value: height, m; extra: people within a horizontal distance of one height from the
///   drone (the 1:1 rule of EASA's AMC to Regulation (EU) 2019/947);
/// - `fall_hazard` for everybody within 3 m and the drone's radius of the predicted ground impact:
///   value: distance from there, m; extra: time until then, s.
class FallWarning {
 public:
  explicit FallWarning(std::size_t drone) : drone_(drone) {}

  void update(double time_s, const FallingCraft& vehicle, const PeopleInMotion& people,
              const std::function<void(const world::TraceEvent&)>& log);

 private:
  std::size_t drone_;
  bool done_ = false;
};

}  // namespace throng::sim
