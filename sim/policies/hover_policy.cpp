#include "sim/policies/hover_policy.h"

namespace throng::sim {

namespace {

class HoverPolicy : public Policy {
 public:
  HoverPolicy(const Eigen::Vector3d& place, double yaw_rad) {
    setpoint_.position = place;
    setpoint_.yaw_rad = yaw_rad;
  }

  Setpoint next(const FlightState&, double) override { return setpoint_; }

 private:
  Setpoint setpoint_;
};

}  // namespace

std::unique_ptr<Policy> make_hover_policy(const PolicyContext& context) {
  return std::make_unique<HoverPolicy>(context.start, context.yaw_rad);
}

}  // namespace throng::sim
