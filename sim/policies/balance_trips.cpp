#include "sim/policies/balance_trips.h"

#include <algorithm>
#include <limits>

#include "sim/policies/balance_parameters.h"

namespace throng::sim {

using Eigen::Vector2d;

namespace {

bool is_idle(const PersonSeen& person, const world::Scenario& scenario, const QueueModel& queues) {
  if (person.exit < 0) return true;
  const world::Exit& exit = scenario.exits[static_cast<std::size_t>(person.exit)];
  return person.velocity.norm() < kBalance.stands_mps &&
         (!queues.is_open(person.exit) ||
          (person.position - exit.middle()).norm() > 2 * kBalance.at_door_m);
}

// Excludes people led by another drone than `self`; people whom this drone has left behind wait for
// it. People who have not noticed the alarm can be led if drones can inform them, and people at the
// door count as out.
bool can_be_led(const PersonSeen& person, const world::Scenario& scenario, const QueueModel& queues,
                int self) {
  if (person.guide >= 0) return person.guide == self;
  if (person.exit < 0) return scenario.guides_alert;
  const world::Exit& exit = scenario.exits[static_cast<std::size_t>(person.exit)];
  return !queues.is_open(person.exit) ||
         (person.position - exit.middle()).norm() > kBalance.at_door_m;
}

/// Whether another drone than `self` is busy at a place, or heading there.
bool is_led_by_other(const WorldView& view, int self, const Vector2d& place) {
  for (std::size_t d = 0; d < view.drones.size(); ++d) {
    const LeadPlan& plan = view.drones[d].plan;
    if (static_cast<int>(d) == self || !plan.place) continue;
    if ((*plan.place - place).norm() < kBalance.reach_m) return true;
  }
  return false;
}

bool is_alarmed(const WorldView& view) {
  return std::any_of(view.people.begin(), view.people.end(),
                     [](const PersonSeen& person) { return person.exit >= 0; });
}

bool has_noticed(const PersonSeen& person) { return person.exit >= 0 || person.guide >= 0; }

}  // namespace

LeadOptions::LeadOptions(const PolicyContext& context)
    : exits(exits_to_lead_to(*context.scenario, context.mission.guidance.exits)),
      speed_mps(context.mission.guidance.lead_speed_mps.value_or(kBalance.lead_speed_mps)),
      max_people(context.mission.guidance.batch.value_or(kBalance.max_batch)) {
  routes.reserve(context.scenario->exits.size());
  for (const world::Exit& exit : context.scenario->exits) {
    routes.push_back(route_through(exit, context.scenario->buildings, kBalance.line_up_m));
  }
}

BalanceTrips::BalanceTrips(const PolicyContext& context)
    : scenario_(*context.scenario), drone_(context.drone), leads_(context), queues_(scenario_) {}

std::optional<BalanceTrip> BalanceTrips::best(const WorldView& view, const Vector2d& place) const {
  if (!is_alarmed(view)) return std::nullopt;
  BalanceTrip best;
  for (const PersonSeen& person : view.people) {
    const bool is_abandoned =
        std::any_of(abandoned_.begin(), abandoned_.end(), [&](const Abandoned& one) {
          return view.time_s < one.until_s &&
                 (person.position - one.place).norm() < kBalance.abandoned_m;
        });
    if (can_be_led(person, scenario_, queues_, drone_) && !is_abandoned)
      consider(view, place, person.position, best);
  }
  if (best.saving_s < kBalance.min_saving_s) return std::nullopt;
  return best;
}

std::optional<BalanceTrip> BalanceTrips::best_near(const WorldView& view, const Vector2d& place,
                                                   const Vector2d& near) const {
  BalanceTrip best;
  for (const PersonSeen& person : view.people) {
    if (!can_be_led(person, scenario_, queues_, drone_) ||
        (person.position - near).norm() > kBalance.reach_m)
      continue;
    consider(view, place, person.position, best);
  }
  if (best.saving_s <= 0) return std::nullopt;
  return best;
}

std::optional<Vector2d> BalanceTrips::place_to_inform(const WorldView& view,
                                                      const Vector2d& place) const {
  if (!scenario_.guides_alert || !is_alarmed(view)) return std::nullopt;
  std::optional<Vector2d> best;
  double best_per_s = kBalance.min_told_per_s;
  for (const PersonSeen& person : view.people) {
    if (has_noticed(person) || is_led_by_other(view, drone_, person.position)) continue;
    const double fly_s = (person.position - place).norm() / kBalance.fly_speed_mps;
    const double per_s = unaware_near(view, person.position) / (1 + fly_s);
    if (per_s <= best_per_s) continue;
    best_per_s = per_s;
    best = person.position;
  }
  return best;
}

void BalanceTrips::abandon(const Vector2d& place, double time_s) {
  abandoned_.push_back({place, time_s + kBalance.abandoned_s});
}

int BalanceTrips::soonest_exit(const Vector2d& place) const {
  int best = -1;
  double best_s = std::numeric_limits<double>::infinity();
  for (const int exit : leads_.exits) {
    if (!queues_.is_open(exit)) continue;
    const double out_s = std::max(queues_.wait_s(exit),
                                  (leads_.route(exit).mouth() - place).norm() / leads_.speed_mps);
    if (out_s >= best_s) continue;
    best_s = out_s;
    best = exit;
  }
  return best;
}

void BalanceTrips::consider(const WorldView& view, const Vector2d& place, const Vector2d& pick,
                            BalanceTrip& best) const {
  if (is_led_by_other(view, drone_, pick)) return;
  // People whom a beacon at `pick` would reach: all, those who stand, and the others by exit.
  double people = 0;
  double idle = 0;
  std::vector<double> heading(scenario_.exits.size());
  for (const PersonSeen& person : view.people) {
    if (!can_be_led(person, scenario_, queues_, drone_) ||
        (person.position - pick).norm() > kBalance.reach_m)
      continue;
    people += 1;
    if (is_idle(person, scenario_, queues_)) {
      idle += 1;
    } else {
      heading[static_cast<std::size_t>(queues_.ends_up_at(person))] += 1;
    }
  }
  if (people > leads_.max_people) return;
  const double fly_s = (pick - place).norm() / kBalance.fly_speed_mps + 1;
  for (const int to : leads_.exits) {
    if (!queues_.is_open(to)) continue;
    const double lead_s = (leads_.route(to).mouth() - pick).norm() / leads_.speed_mps;
    const double arrive_s = fly_s + kBalance.min_collect_s + lead_s;
    BalanceTrip trip{pick, -1, to, people, 0};
    double max_heading = 0;
    for (std::size_t exit = 0; exit < heading.size(); ++exit) {
      const int from = static_cast<int>(exit);
      if (heading[exit] == 0) continue;
      if (from == to) {  // they would be slower behind the drone
        trip.saving_s -= heading[exit] * kBalance.min_collect_s;
        continue;
      }
      trip.saving_s += queues_.saving_s(from, to, arrive_s, heading[exit]);
      if (heading[exit] > max_heading) {
        max_heading = heading[exit];
        trip.from = from;
      }
    }
    trip.saving_s += queues_.saving_of_idle_s(kBalance.idle_s, to, arrive_s, idle);
    // If two trips save as much, the shorter one leaves time for more.
    trip.saving_s /= 1 + arrive_s / kBalance.half_worth_s;
    if (trip.saving_s > best.saving_s) best = trip;
  }
}

int unaware_near(const WorldView& view, const Vector2d& place) {
  return static_cast<int>(
      std::count_if(view.people.begin(), view.people.end(), [&](const PersonSeen& person) {
        return !has_noticed(person) && (person.position - place).norm() < kBalance.reach_m;
      }));
}

}  // namespace throng::sim
