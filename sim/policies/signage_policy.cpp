#include "sim/policies/signage_policy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sim/policies/lead_route.h"
#include "sim/policies/queue_model.h"
#include "sim/policies/smooth_setpoint.h"

namespace throng::sim {

using Eigen::Vector2d;

namespace {

constexpr double kSignSpeedMps = 4;
constexpr double kChooseEveryS = 3;
constexpr double kBetterS = 4;      // by how much another exit must be quicker
constexpr double kBeforeDoorM = 7;  // on the side of those who wait longest
constexpr double kShowS = 3;        // the sign is on
constexpr double kHideS = 1;        // and off, so that who has come walks on by the exit at hand

class SignagePolicy : public Policy {
 public:
  explicit SignagePolicy(const PolicyContext& context)
      : scenario_(*context.scenario),
        drone_(context.drone),
        choice_(exits_to_lead_to(scenario_, context.mission.guidance.exits)),
        setpoint_(context.start, context.yaw_rad),
        queues_(scenario_) {}

  void see(const WorldView& view) override {
    queues_.update(view, drone_);
    time_s_ = view.time_s;
    const bool alarmed = std::any_of(view.people.begin(), view.people.end(),
                                     [](const PersonSeen& person) { return person.exit >= 0; });
    if (to_ >= 0 && !queues_.is_open(to_)) {
      to_ = -1;
      choose_s_ = view.time_s;
      setpoint_.stop();
    }
    if (alarmed && view.time_s >= choose_s_) choose(view);
  }

  Setpoint next(const FlightState& state, double dt_s) override {
    return setpoint_.advance(state, dt_s);
  }

  bool beacon() const override {
    if (to_ < 0 || !setpoint_.arrived()) return false;
    return std::fmod(time_s_, kShowS + kHideS) < kShowS;
  }

  LeadPlan plan() const override { return {-1, to_, 0, true}; }

 private:
  bool has_a_sign(const WorldView& view, int exit) const {
    for (std::size_t d = 0; d < view.drones.size(); ++d) {
      if (static_cast<int>(d) != drone_ && view.drones[d].plan.to == exit) return true;
    }
    return false;
  }

  void choose(const WorldView& view) {
    choose_s_ = view.time_s + kChooseEveryS;
    int best = -1;
    double best_s = std::numeric_limits<double>::infinity();
    for (const int exit : choice_) {
      if (!queues_.is_open(exit) || has_a_sign(view, exit)) continue;
      const double wait_s = queues_.wait_s(exit) - (exit == to_ ? kBetterS : 0);
      if (wait_s < best_s) {
        best_s = wait_s;
        best = exit;
      }
    }
    if (best < 0) return;
    to_ = best;
    const world::Exit& exit = scenario_.exits[static_cast<std::size_t>(to_)];
    const Vector2d inner = exit.middle() - 2 * exit.outward;
    const Vector2d offset = max_queue() - inner;
    const Vector2d aside =
        offset.norm() > 0 ? Vector2d(offset.normalized()) : Vector2d(-exit.outward);
    setpoint_.go(inner + std::min(kBeforeDoorM, offset.norm()) * aside, kSignSpeedMps);
  }

  Vector2d max_queue() const {
    std::size_t longest = 0;
    for (std::size_t e = 1; e < scenario_.exits.size(); ++e) {
      if (queues_.wait_s(static_cast<int>(e)) > queues_.wait_s(static_cast<int>(longest))) {
        longest = e;
      }
    }
    return scenario_.exits[longest].middle();
  }

  const world::Scenario& scenario_;
  int drone_;
  std::vector<int> choice_;
  SmoothSetpoint setpoint_;
  QueueModel queues_;
  int to_ = -1;
  double time_s_ = 0;
  double choose_s_ = 0;
};

}  // namespace

std::unique_ptr<Policy> make_signage_policy(const PolicyContext& context) {
  return std::make_unique<SignagePolicy>(context);
}

}  // namespace throng::sim
