#include "sim/policies/zigzag_policy.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/policies/lead_route.h"
#include "sim/policies/smooth_setpoint.h"

namespace throng::sim {

using Eigen::Vector2d;

namespace {

constexpr double kSwingM = 4;  // to either side of the path
constexpr int kSwings = 3;
constexpr double kPatienceS = 20;  // how long it waits for followers to run on
constexpr std::size_t kWorthATripPeople = 4;

class ZigzagPolicy : public Policy {
 public:
  explicit ZigzagPolicy(const PolicyContext& context)
      : scenario_(*context.scenario),
        drone_(context.drone),
        speed_mps_(context.mission.speed_mps),
        choice_(exits_to_lead_to(scenario_, context.mission.guidance.exits)),
        setpoint_(context.start, context.yaw_rad) {}

  void see(const WorldView& view) override {
    followers_ = static_cast<int>(
        std::count_if(view.people.begin(), view.people.end(),
                      [&](const PersonSeen& person) { return person.guide == drone_; }));
    time_s_ = view.time_s;
    if (!path_.empty() && !is_open(to_)) {
      path_.clear();
      setpoint_.stop();
    }
    if (path_.empty()) {
      plan_trip(view);
    } else if (setpoint_.arrived()) {
      next_leg();
    }
  }

  Setpoint next(const FlightState& state, double dt_s) override {
    return setpoint_.advance(state, dt_s);
  }

  // Once on the first point of its sweep until it flies back.
  bool beacon() const override { return !path_.empty() && point_ > 0; }

  LeadPlan plan() const override {
    return {from_, path_.empty() ? -1 : to_, static_cast<double>(followers_), beacon()};
  }

 private:
  bool is_open(int exit) const {
    return scenario_.exits[static_cast<std::size_t>(exit)].is_open(time_s_);
  }

  void next_leg() {
    if (point_ + 1 < path_.size()) {
      setpoint_.go(path_[++point_], speed_mps_);
      arrived_s_ = -1;
      return;
    }
    if (arrived_s_ < 0) arrived_s_ = time_s_;
    if (followers_ == 0 || time_s_ - arrived_s_ > kPatienceS) path_.clear();
  }

  // People before the exit with the most demand, and the direction from there to the next exit in
  // turn.
  void plan_trip(const WorldView& view) {
    std::vector<std::size_t> heading(scenario_.exits.size());
    for (const PersonSeen& person : view.people) {
      if (person.exit >= 0) ++heading[static_cast<std::size_t>(person.exit)];
    }
    const auto busiest = std::max_element(heading.begin(), heading.end());
    if (busiest == heading.end() || *busiest < kWorthATripPeople) return;
    from_ = static_cast<int>(busiest - heading.begin());
    to_ = next_in_turn();
    if (to_ < 0) return;
    Vector2d middle = Vector2d::Zero();
    for (const PersonSeen& person : view.people) {
      if (person.exit == from_) middle += person.position / static_cast<double>(*busiest);
    }
    const LeadRoute route =
        route_through(scenario_.exits[static_cast<std::size_t>(to_)], scenario_.buildings);
    const Vector2d offset = route.points[0] - middle;
    const Vector2d aside = Vector2d(-offset.y(), offset.x()).normalized();
    path_ = {middle};
    for (int i = 1; i <= kSwings; ++i) {
      const double side = i % 2 == 1 ? kSwingM : -kSwingM;
      path_.emplace_back(middle + offset * i / (kSwings + 1.0) + side * aside);
    }
    path_.insert(path_.end(), route.points.begin(), route.points.end());
    point_ = 0;
    arrived_s_ = -1;
    setpoint_.go(path_[0], speed_mps_);
  }

  // The next open exit, other than the one that people run to; -1: there is none.
  int next_in_turn() {
    for (std::size_t i = 0; i < choice_.size(); ++i) {
      const int exit = choice_[turn_++ % choice_.size()];
      if (exit != from_ && is_open(exit)) return exit;
    }
    return -1;
  }

  const world::Scenario& scenario_;
  int drone_;
  double speed_mps_;
  std::vector<int> choice_;
  SmoothSetpoint setpoint_;
  std::vector<Vector2d> path_;  // of the trip; empty between trips
  std::size_t point_ = 0;       // of the path, to which it flies
  std::size_t turn_ = 0;
  int from_ = -1;
  int to_ = -1;
  int followers_ = 0;
  double time_s_ = 0;
  double arrived_s_ = -1;  // at the end of the path; negative: not yet
};

}  // namespace

std::unique_ptr<Policy> make_zigzag_policy(const PolicyContext& context) {
  return std::make_unique<ZigzagPolicy>(context);
}

}  // namespace throng::sim
