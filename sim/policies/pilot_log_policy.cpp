#include "sim/policies/pilot_log_policy.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace throng::sim {

namespace {

class PilotLogPolicy : public Policy {
 public:
  explicit PilotLogPolicy(const PolicyContext& context)
      : samples_(context.mission.guidance.setpoints) {}

  void see(const WorldView& view) override { time_s_ = view.time_s; }

  void fly_on(const PilotSample& setpoint) override { samples_.push_back(setpoint); }

  // Straight from one set-point to the next; before the first and after the last it hovers there.
  Setpoint next(const FlightState&, double dt_s) override {
    time_s_ += dt_s;
    Setpoint setpoint;
    const auto after = std::upper_bound(
        samples_.begin(), samples_.end(), time_s_,
        [](double time_s, const PilotSample& sample) { return time_s < sample.time_s; });
    const PilotSample& from = after == samples_.begin() ? *after : *(after - 1);
    setpoint.position = from.position;
    setpoint.yaw_rad = from.yaw_rad;
    if (after == samples_.begin() || after == samples_.end()) return setpoint;
    const double span_s = after->time_s - from.time_s;
    const double part = (time_s_ - from.time_s) / span_s;
    setpoint.velocity = (after->position - from.position) / span_s;
    setpoint.position += part * (after->position - from.position);
    setpoint.yaw_rad += part * std::remainder(after->yaw_rad - from.yaw_rad, 2 * EIGEN_PI);
    return setpoint;
  }

  bool beacon() const override {
    const auto after = std::upper_bound(
        samples_.begin(), samples_.end(), time_s_ + kSlackS,
        [](double time_s, const PilotSample& sample) { return time_s < sample.time_s; });
    return after == samples_.begin() ? after->beacon : (after - 1)->beacon;
  }

 private:
  static constexpr double kSlackS = 1e-6;

  std::vector<PilotSample> samples_;
  double time_s_ = 0;
};

}  // namespace

std::unique_ptr<Policy> make_pilot_log_policy(const PolicyContext& context) {
  return std::make_unique<PilotLogPolicy>(context);
}

}  // namespace throng::sim
