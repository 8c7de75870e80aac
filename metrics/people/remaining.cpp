#include "metrics/people/remaining.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace throng::metrics {

namespace {

constexpr double kWindowS = 60;
constexpr double kMovedM = 6;

bool can_leave(const world::Scenario& scenario, const std::vector<WalkingDistance>& distances,
               const Eigen::Vector2d& place, double time_s) {
  for (std::size_t e = 0; e < scenario.exits.size(); ++e) {
    if (scenario.exits[e].is_open(time_s) && distances[e].from(place)) return true;
  }
  return false;
}

/// The last step of a run and one a minute before.
struct Window {
  std::size_t first;
  std::size_t last;
};

Window observation_window(const world::Trace& trace) {
  const std::size_t last = trace.steps() - 1;
  const auto steps = static_cast<std::size_t>(std::lround(kWindowS / trace.header.dt_s));
  return {last - std::min(last, steps), last};
}

bool is_walking(const world::Trace& trace, const Window& window, const PersonRecord& person) {
  if (window.first == 0 || person.first_step > window.first) return true;
  const Eigen::Vector2f moved = trace.position[trace.at(window.last, person.agent)] -
                                trace.position[trace.at(window.first, person.agent)];
  return moved.norm() >= kMovedM;
}

}  // namespace

Remaining count_remaining(const world::Trace& trace, const world::Scenario& scenario,
                          const std::vector<PersonRecord>& people,
                          const std::vector<WalkingDistance>& distances) {
  Remaining remaining;
  if (trace.steps() == 0) return remaining;
  const Window window = observation_window(trace);
  for (const PersonRecord& person : people) {
    if (!person.was_inside || person.escaped_s || !trace.present(window.last, person.agent))
      continue;
    const std::size_t at = trace.at(window.last, person.agent);
    const Eigen::Vector2d place = trace.position[at].cast<double>();
    if (person.hurt_s || (trace.flags[at] & world::kFallen) != 0) {
      ++remaining.casualty;
    } else if ((trace.flags[at] & world::kFollowing) != 0) {
      ++remaining.guided;
    } else if (trace.exit_intent[at] < 0) {
      ++remaining.waiting;
    } else if (!can_leave(scenario, distances, place, trace.duration_s())) {
      ++remaining.blocked;
    } else if (is_walking(trace, window, person)) {
      ++remaining.walking;
    } else {
      ++remaining.stalled;
    }
  }
  return remaining;
}

nlohmann::json to_json(const Remaining& remaining) {
  return {{"people", remaining.total()},  {"casualty", remaining.casualty},
          {"guided", remaining.guided},   {"waiting", remaining.waiting},
          {"blocked", remaining.blocked}, {"walking", remaining.walking},
          {"stalled", remaining.stalled}};
}

}  // namespace throng::metrics
