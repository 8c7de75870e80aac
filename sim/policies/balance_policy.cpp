#include "sim/policies/balance_policy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "sim/policies/glide.h"
#include "sim/policies/lead_route.h"
#include "sim/policies/queue_model.h"

namespace throng::sim {
using Eigen::Vector2d;

namespace {

constexpr double kFlySpeedMps = 4;
constexpr double kLeadSpeedMps = 1.6;  // people run at 2 m/s
constexpr double kDecideEveryS = 0.5;
constexpr double kReachM = 6;          // of the beacon
constexpr double kWorthTelling = 0.3;  // min people per second of travel
constexpr double kCollectS = 2;        // at least, with the beacon on
constexpr double kMaxCollectS = 6;
constexpr double kMaxReleaseS = 20;  // beyond the door, for those who are there
constexpr double kForTheLastS = 3;   // for those who are not
constexpr double kBehindM = 9;       // a follower farther away got lost
constexpr int kMaxRescues = 3;
constexpr double kIdleS = 40;         // what standing about costs whom nobody fetches
constexpr double kWorthSeconds = 15;  // people times seconds that a trip must save
constexpr double kStandsMps = 0.3;
constexpr double kAtTheDoorM = 5;
constexpr double kAbandonedM = 3;  // who did not come with the drone is left alone for a while
constexpr double kAbandonedS = 40;
constexpr int kMaxBatch = 50;
constexpr double kLineUpM = 9;      // a batch is long: nearer, its tail would come along the wall
constexpr double kHalfWorthS = 20;  // a trip that takes so long is worth half

class BalancePolicy : public Policy {
 public:
  explicit BalancePolicy(const PolicyContext& context)
      : scenario_(*context.scenario),
        drone_(context.drone),
        lead_mps_(context.mission.guidance.lead_speed_mps.value_or(kLeadSpeedMps)),
        batch_(context.mission.guidance.batch.value_or(kMaxBatch)),
        choice_(exits_to_lead_to(scenario_, context.mission.guidance.exits)),
        glide_(context.start, context.yaw_rad),
        queues_(scenario_) {
    for (const world::Exit& exit : scenario_.exits) {
      routes_.push_back(route_through(exit, scenario_.buildings, kLineUpM));
    }
  }

  void see(const WorldView& view) override {
    queues_.update(view, drone_);
    count_followers(view);
    const bool on_a_trip =
        stage_ == Stage::fly || stage_ == Stage::collect || stage_ == Stage::lead;
    if (on_a_trip && !queues_.is_open(to_)) turn_from_closed_door(view);
    switch (stage_) {
      case Stage::wait:
        if (view.time_s >= decide_s_) decide(view);
        break;
      case Stage::alert:
        alert(view);
        break;
      case Stage::fly:
        if (glide_.arrived()) {
          enter(Stage::collect, view.time_s);
        } else if (view.time_s >= decide_s_) {
          aim_again(view);
        }
        break;
      case Stage::collect:
        collect(view);
        break;
      case Stage::lead:
        lead(view);
        break;
    }
  }

  Setpoint next(const FlightState& state, double dt_s) override {
    return glide_.advance(state, dt_s);
  }

  bool beacon() const override {
    return stage_ == Stage::collect || stage_ == Stage::lead || blink_;
  }

  LeadPlan plan() const override {
    if (stage_ == Stage::wait) return {};
    if (stage_ == Stage::alert) return {-1, -1, 0, false, pick_};
    const bool leads = stage_ == Stage::lead;
    return {from_, to_, leads ? near_ : planned_, leads, leads ? glide_.place() : pick_};
  }

 private:
  enum class Stage { wait, alert, fly, collect, lead };

  // A place to begin a lead at, and what it would bring.
  struct Trip {
    Vector2d pick = Vector2d::Zero();
    int from = -1;
    int to = -1;
    double people = 0;
    double seconds = 0;
  };
  struct Abandoned {
    Vector2d place;
    double until_s;
  };

  void enter(Stage stage, double time_s) {
    stage_ = stage;
    since_s_ = time_s;
    decide_s_ = time_s + kDecideEveryS;
  }

  void count_followers(const WorldView& view) {
    followers_ = 0;
    near_ = 0;
    double nearest_m = std::numeric_limits<double>::infinity();
    for (const PersonSeen& person : view.people) {
      if (person.guide != drone_) continue;
      followers_ += 1;
      const double away_m = (person.position - glide_.place()).norm();
      if (away_m < kBehindM) {
        near_ += 1;
      } else if (away_m < nearest_m) {
        nearest_m = away_m;
        lost_ = person.position;
      }
    }
  }

  bool abandoned(const Vector2d& place, double time_s) const {
    return std::any_of(abandoned_.begin(), abandoned_.end(), [&](const Abandoned& one) {
      return time_s < one.until_s && (place - one.place).norm() < kAbandonedM;
    });
  }

  // Excludes people led by another drone; people whom this drone has left behind wait for it.
  // People who have not noticed the alarm can be led if drones can inform them, and people at the
  // door count as out.
  bool can_be_led(const PersonSeen& person) const {
    if (person.guide >= 0) return person.guide == drone_;
    if (person.exit < 0) return scenario_.guides_alert;
    const world::Exit& exit = scenario_.exits[static_cast<std::size_t>(person.exit)];
    return !queues_.is_open(person.exit) || (person.position - exit.middle()).norm() > kAtTheDoorM;
  }

  bool is_idle(const PersonSeen& person) const {
    if (person.exit < 0) return true;
    const world::Exit& exit = scenario_.exits[static_cast<std::size_t>(person.exit)];
    return person.velocity.norm() < kStandsMps &&
           (!queues_.is_open(person.exit) ||
            (person.position - exit.middle()).norm() > 2 * kAtTheDoorM);
  }

  void decide(const WorldView& view) {
    decide_s_ = view.time_s + kDecideEveryS;
    const bool alarmed = std::any_of(view.people.begin(), view.people.end(),
                                     [](const auto& p) { return p.exit >= 0; });
    if (alarmed && scenario_.guides_alert && go_alerting(view)) return;
    Trip best;
    if (alarmed) {
      for (const PersonSeen& person : view.people) {
        if (!can_be_led(person) || abandoned(person.position, view.time_s)) continue;
        consider(view, person.position, best);
      }
    }
    if (best.seconds < kWorthSeconds) {
      glide_.stop();
      return;
    }
    set_out(best);
    enter(Stage::fly, view.time_s);
  }

  static bool has_noticed(const PersonSeen& person) {
    return person.exit >= 0 || person.guide >= 0;
  }

  int unaware_near(const WorldView& view, const Vector2d& place) const {
    return static_cast<int>(
        std::count_if(view.people.begin(), view.people.end(), [&](const PersonSeen& person) {
          return !has_noticed(person) && (person.position - place).norm() < kReachM;
        }));
  }

  // Flies to where most people can be informed soon; false when nobody is worth the trip.
  bool go_alerting(const WorldView& view) {
    double best = kWorthTelling;
    for (const PersonSeen& person : view.people) {
      if (has_noticed(person) || is_led_by_other(view, person.position)) continue;
      const double fly_s = (person.position - glide_.place()).norm() / kFlySpeedMps;
      const double worth = unaware_near(view, person.position) / (1 + fly_s);
      if (worth <= best) continue;
      best = worth;
      pick_ = person.position;
    }
    if (best == kWorthTelling) return false;
    glide_.go(pick_, kFlySpeedMps);
    if (stage_ != Stage::alert) enter(Stage::alert, view.time_s);
    return true;
  }

  // Calls for a moment wherever somebody below has not noticed; the news is all they need, and the
  // beacon that goes out at once sends them to the nearest open exit.
  void alert(const WorldView& view) {
    const Vector2d below = view.drones[static_cast<std::size_t>(drone_)].position.head<2>();
    blink_ = !blink_ && unaware_near(view, below) > 0;
    if (blink_) return;
    if (glide_.arrived() || unaware_near(view, pick_) == 0) {
      enter(Stage::wait, view.time_s);
      decide(view);
    }
  }

  // The crowd moves on while it flies: the same people may be best met elsewhere.
  void aim_again(const WorldView& view) {
    decide_s_ = view.time_s + kDecideEveryS;
    Trip best;
    for (const PersonSeen& person : view.people) {
      if (!can_be_led(person) || (person.position - pick_).norm() > kReachM) continue;
      consider(view, person.position, best);
    }
    if (best.seconds <= 0) {
      enter(Stage::wait, view.time_s);
      glide_.stop();
      return;
    }
    set_out(best);
  }

  void set_out(const Trip& trip) {
    from_ = trip.from;
    to_ = trip.to;
    planned_ = trip.people;
    pick_ = trip.pick;
    glide_.go(pick_, kFlySpeedMps);
  }

  // People whom a beacon at `pick` would reach: the number per intended exit, and the number
  // standing.
  struct Reached {
    std::vector<double> want;
    double idle = 0;
    double all = 0;
  };
  Reached reached(const WorldView& view, const Vector2d& pick) const {
    Reached result{std::vector<double>(scenario_.exits.size())};
    for (const PersonSeen& person : view.people) {
      if (!can_be_led(person)) continue;
      if ((person.position - pick).norm() > kReachM) continue;
      result.all += 1;
      if (is_idle(person)) {
        result.idle += 1;
      } else {
        result.want[static_cast<std::size_t>(queues_.ends_up_at(person))] += 1;
      }
    }
    return result;
  }

  // Whether another drone is busy at a position, or heading there.
  bool is_led_by_other(const WorldView& view, const Vector2d& place) const {
    for (std::size_t d = 0; d < view.drones.size(); ++d) {
      const LeadPlan& plan = view.drones[d].plan;
      if (static_cast<int>(d) == drone_ || !plan.place) continue;
      if ((*plan.place - place).norm() < kReachM) return true;
    }
    return false;
  }

  void consider(const WorldView& view, const Vector2d& pick, Trip& best) const {
    if (is_led_by_other(view, pick)) return;
    const Reached here = reached(view, pick);
    if (here.all > batch_) return;
    const double fly_s = (pick - glide_.place()).norm() / kFlySpeedMps + 1;
    for (const int to : choice_) {
      if (!queues_.is_open(to)) continue;
      const double lead_s =
          (routes_[static_cast<std::size_t>(to)].mouth() - pick).norm() / lead_mps_;
      const double arrive_s = fly_s + kCollectS + lead_s;
      Trip trip{pick, -1, to, here.all, 0};
      double max_want = 0;
      for (std::size_t e = 0; e < here.want.size(); ++e) {
        const int from = static_cast<int>(e);
        if (here.want[e] == 0) continue;
        if (from == to) {  // they would be slower behind the drone
          trip.seconds -= here.want[e] * kCollectS;
          continue;
        }
        trip.seconds += queues_.saving_s(from, to, arrive_s, here.want[e]);
        if (here.want[e] > max_want) {
          max_want = here.want[e];
          trip.from = from;
        }
      }
      trip.seconds += queues_.saving_of_idle_s(kIdleS, to, arrive_s, here.idle);
      // If two trips save as much, the shorter one leaves time for more.
      trip.seconds /= 1 + arrive_s / kHalfWorthS;
      if (trip.seconds > best.seconds) best = trip;
    }
  }

  void collect(const WorldView& view) {
    const double collected_s = view.time_s - since_s_;
    if (near_ > 0 && collected_s >= kCollectS) {
      enter(Stage::lead, view.time_s);
      set_out_with_followers();
    } else if (collected_s >= kMaxCollectS) {
      abandoned_.push_back({glide_.place(), view.time_s + kAbandonedS});
      enter(Stage::wait, view.time_s);
    }
  }

  // A disaster has reached the door: with those who follow to the one at which they are out
  // soonest; without any, or without such a door, it gives up.
  void turn_from_closed_door(const WorldView& view) {
    int best = -1;
    double best_s = std::numeric_limits<double>::infinity();
    for (const int exit : choice_) {
      if (!queues_.is_open(exit)) continue;
      const Vector2d offset = routes_[static_cast<std::size_t>(exit)].mouth() - glide_.place();
      const double out_s = std::max(queues_.wait_s(exit), offset.norm() / lead_mps_);
      if (out_s >= best_s) continue;
      best_s = out_s;
      best = exit;
    }
    if (stage_ != Stage::lead || followers_ == 0 || best < 0) {
      enter(Stage::wait, view.time_s);
      glide_.stop();
      return;
    }
    to_ = best;
    set_out_with_followers();
  }

  void set_out_with_followers() {
    const LeadRoute& route = routes_[static_cast<std::size_t>(to_)];
    path_.assign(route.points.begin(), route.points.end());
    rescues_ = 0;
    start_leg(0);
  }

  void start_leg(std::size_t point) {
    point_ = point;
    arrived_s_ = -1;
    glide_.go(path_[point_], lead_mps_);
  }

  void lead(const WorldView& view) {
    if (followers_ == 0) {
      enter(Stage::wait, view.time_s);
      decide(view);
      return;
    }
    const bool fetching = rescues_ > 0 && point_ == 0;
    glide_.go(path_[point_], fetching ? kFlySpeedMps : lead_mps_);
    if (!glide_.arrived()) return;
    if (arrived_s_ < 0) arrived_s_ = view.time_s;
    if (point_ + 1 < path_.size()) {
      if (!fetching || view.time_s - arrived_s_ >= kCollectS) start_leg(point_ + 1);
      return;
    }
    // Beyond the door: those who are here run on, those who got lost must be fetched.
    const double waited_s = view.time_s - arrived_s_;
    if (waited_s < (near_ > 0 ? kMaxReleaseS : kForTheLastS)) return;
    if (near_ == followers_ || rescues_ >= kMaxRescues) {
      enter(Stage::wait, view.time_s);
      return;
    }
    ++rescues_;
    const LeadRoute& route = routes_[static_cast<std::size_t>(to_)];
    path_ = {lost_};
    path_.insert(path_.end(), route.points.begin(), route.points.end());
    start_leg(0);
  }

  const world::Scenario& scenario_;
  int drone_;
  double lead_mps_;
  int batch_;
  std::vector<int> choice_;
  Glide glide_;
  QueueModel queues_;
  std::vector<LeadRoute> routes_;
  std::vector<Abandoned> abandoned_;

  Stage stage_ = Stage::wait;
  double since_s_ = 0;   // when the stage began
  double decide_s_ = 0;  // when to decide next
  Vector2d pick_ = Vector2d::Zero();
  bool blink_ = false;  // calls for a moment
  int from_ = -1;
  int to_ = -1;
  double planned_ = 0;
  double followers_ = 0;
  double near_ = 0;                   // followers who are right behind
  Vector2d lost_ = Vector2d::Zero();  // the nearest of the others
  std::vector<Vector2d> path_;        // of a lead
  std::size_t point_ = 0;             // of the path, to which it flies
  double arrived_s_ = -1;             // there; negative: not yet
  int rescues_ = 0;                   // of lost followers, in this lead
};

}  // namespace

std::unique_ptr<Policy> make_balance_policy(const PolicyContext& context) {
  return std::make_unique<BalancePolicy>(context);
}

}  // namespace throng::sim
