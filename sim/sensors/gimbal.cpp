#include "sim/sensors/gimbal.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/compute/random.h"
#include "base/error.h"
#include "base/geometry/angle.h"
#include "sim/recording/gimbal_setpoints.h"

namespace throng::sim {

using Eigen::Vector3d;

namespace {

// Numbers of the sensors' stream that no drone's sensors have.
constexpr std::uint64_t kFirstGimbal = std::uint64_t{1} << 32;
constexpr double kMaxStepS = 1e-3;

Vector3d normal3(Random& random) {
  Vector3d v;
  for (double& value : v) value = random.normal(0, 1);
  return v;
}

ViewAngles view_angles(const Vector3d& v) { return {v[0], v[1], v[2]}; }

ViewAngles mixed(const ViewAngles& a, const ViewAngles& b, double share) {
  return {a.yaw + share * (b.yaw - a.yaw), a.pitch + share * (b.pitch - a.pitch),
          a.roll + share * (b.roll - a.roll)};
}

/// x'' = w² (target - x) - 2 z w x', about three axes.
class SecondOrder {
 public:
  SecondOrder(const camera::GimbalSpec& spec, const Vector3d& start) : spec_(spec), angle_(start) {}

  const Vector3d& advance(const Vector3d& from, const Vector3d& to, double dt_s) {
    const int steps = std::max(1, static_cast<int>(std::ceil(dt_s / kMaxStepS)));
    const double step_s = dt_s / steps;
    const double w = spec_.natural_rad_s;
    for (int i = 1; i <= steps; ++i) {
      const Vector3d target = from + static_cast<double>(i) / steps * (to - from);
      rate_ += step_s * (w * w * (target - angle_) - 2 * spec_.damping * w * rate_);
      angle_ += step_s * rate_;
    }
    return angle_;
  }

 private:
  camera::GimbalSpec spec_;
  Vector3d angle_;
  Vector3d rate_ = Vector3d::Zero();
};

/// Angles of a camera that is fixed to the body, at its yaw and pitch there.
ViewAngles rigid_view(const Eigen::Quaterniond& orientation, const camera::GimbalAngles& angles) {
  const double yaw_rad = angles.yaw_deg * kDegree;
  const double pitch_rad = angles.pitch_deg * kDegree;
  const Vector3d ahead =
      orientation * Vector3d(std::cos(pitch_rad) * std::cos(yaw_rad),
                             std::cos(pitch_rad) * std::sin(yaw_rad), std::sin(pitch_rad));
  const Vector3d right = orientation * Vector3d(std::sin(yaw_rad), -std::cos(yaw_rad), 0);
  ViewAngles view;
  view.yaw = std::atan2(ahead.y(), ahead.x());
  view.pitch = std::asin(std::clamp(ahead.z(), -1.0, 1.0));
  const Vector3d level_right(std::sin(view.yaw), -std::cos(view.yaw), 0);
  view.roll = std::atan2(right.dot(ahead.cross(level_right)), right.dot(level_right));
  return view;
}

}  // namespace

double heading_from_orientation(const Eigen::Quaterniond& orientation) {
  const Vector3d nose = orientation * Vector3d::UnitX();
  return std::atan2(nose.y(), nose.x());
}

ViewAngles ideal_view(const Eigen::Quaterniond& orientation, const camera::CameraSpec& camera) {
  return ideal_view(orientation, camera, {}, 0);
}

ViewAngles ideal_view(const Eigen::Quaterniond& orientation, const camera::CameraSpec& camera,
                      const std::vector<PilotSample>& setpoints, double time_s) {
  const camera::GimbalAngles angles = gimbal_at(setpoints, camera.gimbal_angles(), time_s);
  if (camera.gimbal.is_rigid()) return rigid_view(orientation, angles);
  return {heading_from_orientation(orientation) + angles.yaw_deg * kDegree,
          angles.pitch_deg * kDegree, 0};
}

GimbalLog::GimbalLog(const std::vector<world::DroneSample>& truth, const camera::CameraSpec& camera,
                     std::uint64_t seed, std::uint64_t index,
                     const std::vector<PilotSample>& setpoints) {
  const camera::GimbalSpec& spec = camera.gimbal;
  check(!truth.empty(), "a drone with a camera has flown");
  Random random(seed, Stream::sensors, kFirstGimbal + index);
  Vector3d bias;
  for (double& value : bias) value = random.uniform(-spec.bias_rad, spec.bias_rad);
  Vector3d jitter = normal3(random);
  double heading = heading_from_orientation(truth.front().orientation);
  double last_s = truth.front().time_s;
  camera::GimbalAngles angles = gimbal_at(setpoints, camera.gimbal_angles(), last_s);
  Vector3d target(heading + angles.yaw_deg * kDegree, angles.pitch_deg * kDegree, 0);
  SecondOrder response(spec, target);
  for (const world::DroneSample& sample : truth) {
    const double dt_s = sample.time_s - last_s;
    last_s = sample.time_s;
    // Heading without jumps at half a turn.
    heading += std::remainder(heading_from_orientation(sample.orientation) - heading, 2 * EIGEN_PI);
    angles = gimbal_at(setpoints, camera.gimbal_angles(), sample.time_s);
    const Vector3d next(heading + angles.yaw_deg * kDegree, angles.pitch_deg * kDegree, 0);
    if (spec.model != camera::GimbalModel::second_order) {
      const ViewAngles view = ideal_view(sample.orientation, camera, setpoints, sample.time_s);
      points_.push_back({sample.time_s, view, view});
      continue;
    }
    const Vector3d angle = response.advance(target, next, dt_s);
    target = next;
    // The part that the motors cannot hold decays with their time constant.
    const double kept = std::exp(-dt_s * spec.natural_rad_s);
    jitter = kept * jitter + std::sqrt(1 - kept * kept) * normal3(random);
    const Vector3d held = angle + spec.jitter_rad * jitter;
    points_.push_back({sample.time_s, view_angles(held + bias),
                       view_angles(held + spec.reading_rad * normal3(random))});
  }
}

GimbalLog::Interval GimbalLog::place_of(double time_s) const {
  const auto after =
      std::upper_bound(points_.begin(), points_.end(), time_s,
                       [](double t, const Point& point) { return t < point.time_s; });
  if (after == points_.begin()) return {points_.front(), points_.front(), 0};
  if (after == points_.end()) return {points_.back(), points_.back(), 0};
  const Point& before = *(after - 1);
  return {before, *after, (time_s - before.time_s) / (after->time_s - before.time_s)};
}

ViewAngles GimbalLog::view_at(double time_s) const {
  const Interval place = place_of(time_s);
  return mixed(place.before.view, place.after.view, place.share);
}

ViewAngles GimbalLog::reading_at(double time_s) const { return place_of(time_s).before.reading; }

}  // namespace throng::sim
