#include "sim/policies/survey_policy.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/policies/smooth_setpoint.h"

namespace throng::sim {

using Eigen::Vector2d;

namespace {

constexpr double kUsualOverlap = 0.3;

// Lanes along the longer side, each seen as wide as the camera sees the ground straight below.
std::vector<Vector2d> lanes_over(const world::Rectangle& area, double lane_m) {
  const Vector2d size = area.max - area.min;
  const int along = size.x() >= size.y() ? 0 : 1;
  const int across = 1 - along;
  const int lanes = std::max(1, static_cast<int>(std::ceil(size[across] / lane_m)));
  std::vector<Vector2d> path;
  for (int i = 0; i < lanes; ++i) {
    Vector2d from;
    from[along] = area.min[along];
    from[across] = area.min[across] + (i + 0.5) * size[across] / lanes;
    Vector2d to = from;
    to[along] = area.max[along];
    if (i % 2 == 1) std::swap(from, to);
    path.push_back(from);
    path.push_back(to);
  }
  return path;
}

class SurveyPolicy : public Policy {
 public:
  explicit SurveyPolicy(const PolicyContext& context)
      : speed_mps_(context.mission.speed_mps), setpoint_(context.start, context.yaw_rad) {
    const GuidanceSpec& guidance = context.mission.guidance;
    const double seen_m =
        2 * context.start.z() * std::tan(0.5 * context.mission.camera.pinhole_hfov_rad());
    path_ = lanes_over(guidance.area.value_or(context.scenario->inside.bounds),
                       seen_m * (1 - guidance.overlap.value_or(kUsualOverlap)));
    setpoint_.go(path_[0], speed_mps_);
  }

  Setpoint next(const FlightState& state, double dt_s) override {
    if (setpoint_.arrived()) {
      point_ = (point_ + 1) % path_.size();
      setpoint_.go(path_[point_], speed_mps_);
    }
    return setpoint_.advance(state, dt_s);
  }

 private:
  double speed_mps_;
  SmoothSetpoint setpoint_;
  std::vector<Vector2d> path_;
  std::size_t point_ = 0;
};

}  // namespace

std::unique_ptr<Policy> make_survey_policy(const PolicyContext& context) {
  return std::make_unique<SurveyPolicy>(context);
}

}  // namespace throng::sim
