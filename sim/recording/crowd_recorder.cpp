#include "sim/recording/crowd_recorder.h"

#include <algorithm>

namespace throng::sim {

using world::AgentRole;

CrowdRecorder::CrowdRecorder(const world::Scenario& scenario, const std::vector<AgentRole>& roles,
                             const std::vector<world::GoalRef>& moving_goals, std::uint64_t seed)
    : scenario_(scenario),
      roles_(roles),
      moving_goals_(moving_goals),
      intents_(roles.size(), -1),
      led_(roles.size(), false),
      was_inside_(roles.size(), false),
      escaped_(roles.size(), false),
      down_(roles.size(), false),
      turns_(seed) {}

// A person heading for an exit intends it, also on the path from there to safety. A follower of a
// drone intends no exit; after the release it takes the exit at hand.
void CrowdRecorder::update_intent(std::size_t agent, const crowd::GoalId& goal,
                                  const Eigen::Vector2d& place) {
  const auto among = [&](const std::vector<world::GoalRef>& list) {
    return std::find(list.begin(), list.end(), world::GoalRef{goal.set, goal.goal}) != list.end();
  };
  if (among(moving_goals_)) {
    led_[agent] = true;
    intents_[agent] = -1;
    return;
  }
  if (led_[agent]) intents_[agent] = nearest_exit(place);
  led_[agent] = false;
  for (std::size_t exit = 0; exit < scenario_.exits.size(); ++exit) {
    if (among(scenario_.exits[exit].goals)) intents_[agent] = static_cast<std::int8_t>(exit);
  }
}

std::int8_t CrowdRecorder::nearest_exit(const Eigen::Vector2d& place) const {
  const auto nearer = [&](const world::Exit& a, const world::Exit& b) {
    return (a.middle() - place).squaredNorm() < (b.middle() - place).squaredNorm();
  };
  const auto& exits = scenario_.exits;
  const auto nearest = std::min_element(exits.begin(), exits.end(), nearer);
  return nearest == exits.end() ? std::int8_t{-1}
                                : static_cast<std::int8_t>(nearest - exits.begin());
}

void CrowdRecorder::record(const CrowdSource& crowd, double time_s, RunObserver& observer) {
  const auto positions = crowd.positions();
  const auto present = crowd.present();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    was_inside_[i] = was_inside_[i] ||
                     (present[i] != 0 && scenario_.inside.contains(positions[i].cast<double>()));
    update_intent(i, crowd.goals()[i], positions[i].cast<double>());
  }
  world::CrowdStep step = crowd.now();
  step.time_s = time_s;
  step.exit_intent = intents_;
  for (std::size_t i = 0; i < led_.size(); ++i) {
    if (led_[i]) step.flags[i] |= world::kFollowing;
  }
  if (down_states_.empty()) {
    const world::TraceHeader header = crowd.header(0);
    down_states_ = header.lying_states();
    // Recorded people face where the recording says, Menge's where Menge does.
    turns_people_ = crowd.has_intents() && header.crowd.compat != "menge";
  }
  for (std::size_t i = 0; i < down_.size(); ++i) down_[i] = down_states_[step.state[i]];
  if (turns_people_) turns_.turn(step, roles_);
  observer.step(step);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (roles_[i] != AgentRole::person || escaped_[i] || !was_inside_[i]) continue;
    if (present[i] != 0 && scenario_.inside.contains(positions[i].cast<double>())) continue;
    escaped_[i] = true;
    observer.event({time_s, world::AgentEscaped{static_cast<std::int32_t>(i), intents_[i]}});
  }
}

}  // namespace throng::sim
