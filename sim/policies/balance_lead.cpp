#include "sim/policies/balance_lead.h"

#include <limits>

#include "sim/policies/balance_parameters.h"

namespace throng::sim {

void BalanceLead::see(const WorldView& view, const Eigen::Vector2d& place) {
  followers_ = {};
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const PersonSeen& person : view.people) {
    if (person.guide != drone_) continue;
    followers_.count += 1;
    const double away_m = (person.position - place).norm();
    if (away_m < kBalance.behind_m) {
      followers_.near += 1;
    } else if (away_m < nearest_m) {
      nearest_m = away_m;
      followers_.lost = person.position;
    }
  }
}

void BalanceLead::begin(const LeadRoute& route, SmoothSetpoint& setpoint) {
  path_.assign(route.points.begin(), route.points.end());
  rescues_ = 0;
  start_leg(0, setpoint);
}

void BalanceLead::start_leg(std::size_t point, SmoothSetpoint& setpoint) {
  point_ = point;
  arrived_s_ = -1;
  setpoint.go(path_[point_], speed_mps_);
}

bool BalanceLead::advance(double time_s, const LeadRoute& route, SmoothSetpoint& setpoint) {
  const bool is_fetching = rescues_ > 0 && point_ == 0;
  setpoint.go(path_[point_], is_fetching ? kBalance.fly_speed_mps : speed_mps_);
  if (!setpoint.arrived()) return false;
  if (arrived_s_ < 0) arrived_s_ = time_s;
  const double waited_s = time_s - arrived_s_;
  if (point_ + 1 < path_.size()) {
    if (!is_fetching || waited_s >= kBalance.min_collect_s) start_leg(point_ + 1, setpoint);
    return false;
  }
  // Beyond the door: those who are here run on, those who got lost must be fetched.
  if (waited_s < (followers_.near > 0 ? kBalance.max_release_s : kBalance.max_wait_lost_s)) {
    return false;
  }
  if (followers_.near == followers_.count || rescues_ >= kBalance.max_rescues) return true;
  ++rescues_;
  path_ = {followers_.lost};
  path_.insert(path_.end(), route.points.begin(), route.points.end());
  start_leg(0, setpoint);
  return false;
}

}  // namespace throng::sim
