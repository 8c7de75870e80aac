#include "sim/policies/follow_density_policy.h"

#include <algorithm>
#include <cmath>

#include "base/geometry/angle.h"
#include "sim/policies/smooth_setpoint.h"

namespace throng::sim {

using Eigen::Vector2d;

namespace {

constexpr double kKernelM = 4;  // standard deviation of what one person adds to the density
constexpr double kLookEveryS = 1;
constexpr double kSteepEnough = 0.2;   // tangent of the least angle below the horizon
constexpr double kStaysFactor = 1.15;  // how much denser another place must be

class FollowDensityPolicy : public Policy {
 public:
  explicit FollowDensityPolicy(const PolicyContext& context)
      : speed_mps_(context.mission.speed_mps), setpoint_(context.start, context.yaw_rad) {
    const double heading_rad = context.yaw_rad + context.mission.camera.yaw_deg * kDegree;
    const double below =
        std::max(kSteepEnough, std::tan(-context.mission.camera.pitch_deg * kDegree));
    ahead_ = context.start.z() / below * Vector2d(std::cos(heading_rad), std::sin(heading_rad));
    target_ = context.start.head<2>() + ahead_;
  }

  void see(const WorldView& view) override {
    if (view.people.empty() || view.time_s < look_s_) return;
    look_s_ = view.time_s + kLookEveryS;
    double best = kStaysFactor * density(view, target_);
    Vector2d densest = target_;
    for (const PersonSeen& person : view.people) {
      const double here = density(view, person.position);
      if (here <= best) continue;
      best = here;
      densest = person.position;
    }
    target_ = mean_near(view, densest);
    setpoint_.go(target_ - ahead_, speed_mps_);
  }

  Setpoint next(const FlightState& state, double dt_s) override {
    return setpoint_.advance(state, dt_s);
  }

 private:
  static double weight(const PersonSeen& person, const Vector2d& place) {
    return std::exp(-0.5 * (person.position - place).squaredNorm() / (kKernelM * kKernelM));
  }

  static double density(const WorldView& view, const Vector2d& place) {
    double sum = 0;
    for (const PersonSeen& person : view.people) sum += weight(person, place);
    return sum;
  }

  // A step of the mean shift, toward the peak.
  static Vector2d mean_near(const WorldView& view, const Vector2d& place) {
    Vector2d sum = Vector2d::Zero();
    for (const PersonSeen& person : view.people) sum += weight(person, place) * person.position;
    const double all = density(view, place);
    return all > 0 ? Vector2d(sum / all) : place;
  }

  double speed_mps_;
  SmoothSetpoint setpoint_;
  Vector2d ahead_;  // from below the drone to where the camera looks
  Vector2d target_;
  double look_s_ = 0;
};

}  // namespace

std::unique_ptr<Policy> make_follow_density_policy(const PolicyContext& context) {
  return std::make_unique<FollowDensityPolicy>(context);
}

}  // namespace throng::sim
