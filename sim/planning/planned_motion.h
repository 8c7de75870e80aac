// The planned motion of a drone whose policy does not depend on people.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "sim/policies/planned_drone.h"

namespace throng::sim {

/// Whether a policy's path depends on people, so that it is unknown before the simulation.
constexpr bool goes_by_people(const PolicyEntry& policy) {
  return (policy.takes & kFieldPerception) != 0;
}

/// Computes the set-points of a drone's policy as if the drone followed them exactly and its
/// battery never ran out. `drone` must outlive this object, and goes_by_people() must be false for
/// its policy.
class PlannedMotion {
 public:
  explicit PlannedMotion(const PlannedDrone& drone);

  /// Advances by `dt_s` and returns the position of the set-point (m).
  const Eigen::Vector3d& advance(double dt_s);
  /// The heading of the last set-point.
  double yaw_rad() const { return yaw_rad_; }

 private:
  std::unique_ptr<Policy> policy_;
  FlightState state_;
  double yaw_rad_;
};

}  // namespace throng::sim
