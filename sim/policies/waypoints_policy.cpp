#include "sim/policies/waypoints_policy.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace throng::sim {

using Eigen::Vector3d;

namespace {

constexpr double kAcceleration = 2;  // m/s², along the path
constexpr double kMaxLeadM = 3;      // how far the set-point may run ahead of the drone
constexpr double kCreepMps = 0.05;   // keeps the set-point moving where the profile is zero
constexpr double kMinLegM = 1e-6;

struct Leg {
  Vector3d from;
  Vector3d direction;
  double length_m;
  double speed_mps;      // on the leg, as far as acceleration allows
  double end_speed_mps;  // when it turns into the next leg
};

std::vector<Leg> legs_through(const PolicyContext& context) {
  std::vector<Leg> legs;
  Vector3d from = context.start;
  for (const Vector3d& to : context.mission.waypoints) {
    const double length_m = (to - from).norm();
    if (length_m < kMinLegM) continue;
    const Vector3d direction = (to - from) / length_m;
    const double climb = std::abs(direction.z());
    const double speed_mps =
        climb > 0 ? std::min(context.mission.speed_mps, context.autopilot.max_speed_mps.y() / climb)
                  : context.mission.speed_mps;
    legs.push_back({from, direction, length_m, speed_mps, 0});
    from = to;
  }
  // From the end backwards: no leg may end faster than what follows can brake from.
  for (std::size_t i = legs.size(); i-- > 1;) {
    const Leg& next = legs[i];
    Leg& leg = legs[i - 1];
    const double straightness = 0.5 * (1 + leg.direction.dot(next.direction));
    const double can_brake_mps =
        std::sqrt(next.end_speed_mps * next.end_speed_mps + 2 * kAcceleration * next.length_m);
    leg.end_speed_mps =
        std::min({leg.speed_mps * straightness, next.speed_mps * straightness, can_brake_mps});
  }
  return legs;
}

class WaypointsPolicy : public Policy {
 public:
  explicit WaypointsPolicy(const PolicyContext& context) : legs_(legs_through(context)) {
    setpoint_.position = context.start;
    setpoint_.yaw_rad = context.yaw_rad;
  }

  Setpoint next(const FlightState& state, double dt_s) override {
    if (leg_ < legs_.size()) advance(state, dt_s);
    return setpoint_;
  }

 private:
  void advance(const FlightState& state, double dt_s) {
    const Leg& leg = legs_[leg_];
    const bool too_far_ahead = (setpoint_.position - state.position).norm() > kMaxLeadM;
    const double can_brake_mps = std::sqrt(leg.end_speed_mps * leg.end_speed_mps +
                                           2 * kAcceleration * (leg.length_m - along_m_));
    const double wanted_mps =
        too_far_ahead ? 0.0 : std::max(kCreepMps, std::min(leg.speed_mps, can_brake_mps));
    const double max_change_mps = kAcceleration * dt_s;
    const double change_mps = std::clamp(wanted_mps - speed_mps_, -max_change_mps, max_change_mps);
    speed_mps_ += change_mps;
    along_m_ += speed_mps_ * dt_s;
    if (along_m_ < leg.length_m) {
      setpoint_.position = leg.from + along_m_ * leg.direction;
      setpoint_.velocity = speed_mps_ * leg.direction;
      setpoint_.acceleration = change_mps / dt_s * leg.direction;
    } else {
      turn(leg);
    }
  }

  // Ends a leg at its waypoint; the last one ends all motion.
  void turn(const Leg& done) {
    setpoint_.position = done.from + done.length_m * done.direction;
    setpoint_.velocity = Vector3d::Zero();
    setpoint_.acceleration = Vector3d::Zero();
    speed_mps_ = std::min(speed_mps_, done.end_speed_mps);
    along_m_ = 0;
    ++leg_;
    if (leg_ < legs_.size()) setpoint_.velocity = speed_mps_ * legs_[leg_].direction;
  }

  std::vector<Leg> legs_;
  std::size_t leg_ = 0;
  double along_m_ = 0;
  double speed_mps_ = 0;
  Setpoint setpoint_;
};

}  // namespace

std::unique_ptr<Policy> make_waypoints_policy(const PolicyContext& context) {
  return std::make_unique<WaypointsPolicy>(context);
}

}  // namespace throng::sim
