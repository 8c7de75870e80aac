#include "sim/planning/planned_motion.h"

namespace throng::sim {

PlannedMotion::PlannedMotion(const PlannedDrone& drone)
    : policy_(drone.policy->make({drone.mission, drone.start, drone.yaw_rad,
                                  drone.airframe.autopilot, drone.scenario, drone.index})),
      yaw_rad_(drone.yaw_rad) {
  state_.position = drone.start;
}

const Eigen::Vector3d& PlannedMotion::advance(double dt_s) {
  const Setpoint wanted = policy_->next(state_, dt_s);
  state_.position = wanted.position;
  state_.velocity = wanted.velocity;
  yaw_rad_ = wanted.yaw_rad;
  return state_.position;
}

}  // namespace throng::sim
