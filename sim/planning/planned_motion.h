// How a drone means to fly when its policy does not depend on people.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "sim/policies/planned_drone.h"

namespace throng::sim {

/// Whether a policy's path depends on the people that it sees, so that it is not known before.
constexpr bool goes_by_people(const PolicyEntry& policy) {
  return (policy.takes & kFieldPerception) != 0;
}

/// Plays the set-points of a drone's policy as if the drone flew them exactly and its battery
/// lasted. The drone must outlive it, and its policy must not go by people.
class PlannedMotion {
 public:
  explicit PlannedMotion(const PlannedDrone& drone);

  /// Set-point of the drone `dt_s` later, m.
  const Eigen::Vector3d& advance(double dt_s);
  /// Heading of the last set-point.
  double yaw_rad() const { return yaw_rad_; }

 private:
  std::unique_ptr<Policy> policy_;
  FlightState state_;
  double yaw_rad_;
};

}  // namespace throng::sim
