#include "sim/policies/balance_policy.h"

#include <optional>

#include "sim/policies/balance_lead.h"
#include "sim/policies/balance_parameters.h"
#include "sim/policies/balance_trips.h"
#include "sim/policies/smooth_setpoint.h"

namespace throng::sim {
using Eigen::Vector2d;

namespace {

/// The stage of a policy's work, and its times.
struct BalanceStage {
  enum class Kind { wait, inform, fly, collect, lead };

  Kind kind = Kind::wait;
  double since_s = 0;
  double decide_s = 0;  ///< when to decide next
  bool calls = false;   ///< for a moment, those who have not noticed the alarm

  void enter(Kind next, double time_s) {
    *this = {next, time_s, time_s + kBalance.decide_every_s, false};
  }
  bool is_trip() const { return kind == Kind::fly || kind == Kind::collect || kind == Kind::lead; }
};
using Kind = BalanceStage::Kind;

class BalancePolicy : public Policy {
 public:
  explicit BalancePolicy(const PolicyContext& context)
      : drone_(context.drone),
        setpoint_(context.start, context.yaw_rad),
        trips_(context),
        lead_(context.drone, trips_.leads().speed_mps) {}

  void see(const WorldView& view) override {
    trips_.update(view);
    lead_.see(view, setpoint_.place());
    if (stage_.is_trip() && !trips_.is_open(trip_.to)) turn_from_closed_door(view);
    switch (stage_.kind) {
      case Kind::wait:
        if (view.time_s >= stage_.decide_s) decide(view);
        break;
      case Kind::inform:
        inform(view);
        break;
      case Kind::fly:
        if (setpoint_.arrived()) {
          stage_.enter(Kind::collect, view.time_s);
        } else if (view.time_s >= stage_.decide_s) {
          // The crowd moves on while it flies: the same people may be best met elsewhere.
          set_out(trips_.best_near(view, setpoint_.place(), trip_.pick), view.time_s);
        }
        break;
      case Kind::collect:
        if (lead_.followers().near > 0 && view.time_s - stage_.since_s >= kBalance.min_collect_s) {
          stage_.enter(Kind::lead, view.time_s);
          lead_.begin(trips_.leads().route(trip_.to), setpoint_);
        } else if (view.time_s - stage_.since_s >= kBalance.max_collect_s) {
          trips_.abandon(setpoint_.place(), view.time_s);
          stage_.enter(Kind::wait, view.time_s);
        }
        break;
      case Kind::lead:
        if (lead_.followers().count == 0) {
          stage_.enter(Kind::wait, view.time_s);
          decide(view);
        } else if (lead_.advance(view.time_s, trips_.leads().route(trip_.to), setpoint_)) {
          stage_.enter(Kind::wait, view.time_s);
        }
        break;
    }
  }

  Setpoint next(const FlightState& state, double dt_s) override {
    return setpoint_.advance(state, dt_s);
  }

  bool beacon() const override {
    return stage_.kind == Kind::collect || stage_.kind == Kind::lead || stage_.calls;
  }

  LeadPlan plan() const override {
    if (stage_.kind == Kind::wait) return {};
    if (stage_.kind == Kind::inform) return {-1, -1, 0, false, trip_.pick};
    const bool leads = stage_.kind == Kind::lead;
    return {trip_.from, trip_.to, leads ? lead_.followers().near : trip_.people, leads,
            leads ? setpoint_.place() : trip_.pick};
  }

 private:
  void decide(const WorldView& view) {
    const auto place = trips_.place_to_inform(view, setpoint_.place());
    if (!place) return set_out(trips_.best(view, setpoint_.place()), view.time_s);
    stage_.enter(Kind::inform, view.time_s);
    trip_.pick = *place;
    setpoint_.go(trip_.pick, kBalance.fly_speed_mps);
  }

  /// Flies to where a trip begins; without a trip, stops and waits.
  void set_out(const std::optional<BalanceTrip>& trip, double time_s) {
    stage_.enter(trip ? Kind::fly : Kind::wait, time_s);
    if (!trip) return setpoint_.stop();
    trip_ = *trip;
    setpoint_.go(trip_.pick, kBalance.fly_speed_mps);
  }

  // Calls for a moment wherever somebody below has not noticed; the news is all they need, and the
  // beacon that goes out at once sends them to the nearest open exit.
  void inform(const WorldView& view) {
    const Vector2d below = view.drones[static_cast<std::size_t>(drone_)].position.head<2>();
    stage_.calls = !stage_.calls && unaware_near(view, below) > 0;
    if (stage_.calls) return;
    if (setpoint_.arrived() || unaware_near(view, trip_.pick) == 0) {
      stage_.enter(Kind::wait, view.time_s);
      decide(view);
    }
  }

  // A disaster has reached the door: with those who follow to the one at which they are out
  // soonest; without any, or without such a door, it gives up.
  void turn_from_closed_door(const WorldView& view) {
    const int exit = trips_.soonest_exit(setpoint_.place());
    if (stage_.kind != Kind::lead || lead_.followers().count == 0 || exit < 0) {
      return set_out(std::nullopt, view.time_s);
    }
    trip_.to = exit;
    lead_.begin(trips_.leads().route(exit), setpoint_);
  }

  int drone_;
  SmoothSetpoint setpoint_;
  BalanceTrips trips_;
  BalanceLead lead_;
  BalanceStage stage_;
  BalanceTrip trip_;
};

}  // namespace

std::unique_ptr<Policy> make_balance_policy(const PolicyContext& context) {
  return std::make_unique<BalancePolicy>(context);
}

}  // namespace throng::sim
