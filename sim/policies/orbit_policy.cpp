#include "sim/policies/orbit_policy.h"

#include <algorithm>
#include <cmath>

#include "base/geometry/angle.h"
#include "sim/policies/smooth_setpoint.h"

namespace throng::sim {

using Eigen::Vector2d;

namespace {

constexpr double kMaxPullMps2 = kGravity / 3;  // toward the center

class OrbitPolicy : public Policy {
 public:
  explicit OrbitPolicy(const PolicyContext& context)
      : center_(*context.mission.guidance.center),
        radius_m_(*context.mission.guidance.radius_m),
        speed_mps_(std::min(context.mission.speed_mps, std::sqrt(radius_m_ * kMaxPullMps2))),
        camera_yaw_rad_(context.mission.camera.yaw_deg * kDegree),
        approach_(context.start, context.yaw_rad),
        height_m_(context.start.z()) {
    const Vector2d from = context.start.head<2>() - center_;
    angle_rad_ = from.norm() > 0 ? std::atan2(from.y(), from.x()) : 0;
    approach_.go(center_ + radius_m_ * outward(), speed_mps_);
  }

  // To the nearest point of the circle first; round it, counter-clockwise, from then on.
  Setpoint next(const FlightState& state, double dt_s) override {
    if (!approach_.arrived()) {
      approach_.face(angle_rad_ + EIGEN_PI - camera_yaw_rad_);
      return approach_.advance(state, dt_s);
    }
    pace_mps_ = std::min(speed_mps_, pace_mps_ + kSpeedUpMps2 * dt_s);
    angle_rad_ += pace_mps_ / radius_m_ * dt_s;
    Setpoint setpoint;
    setpoint.position << center_ + radius_m_ * outward(), height_m_;
    setpoint.velocity.head<2>() = pace_mps_ * Vector2d(-outward().y(), outward().x());
    setpoint.acceleration.head<2>() = -pace_mps_ * pace_mps_ / radius_m_ * outward();
    setpoint.yaw_rad = angle_rad_ + EIGEN_PI - camera_yaw_rad_;
    return setpoint;
  }

 private:
  static constexpr double kSpeedUpMps2 = 1;

  Vector2d outward() const { return {std::cos(angle_rad_), std::sin(angle_rad_)}; }

  Vector2d center_;
  double radius_m_;
  double speed_mps_;
  double camera_yaw_rad_;
  SmoothSetpoint approach_;
  double height_m_;
  double angle_rad_ = 0;
  double pace_mps_ = 0;  // along the circle
};

}  // namespace

std::unique_ptr<Policy> make_orbit_policy(const PolicyContext& context) {
  return std::make_unique<OrbitPolicy>(context);
}

}  // namespace throng::sim
