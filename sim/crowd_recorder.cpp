#include "sim/crowd_recorder.h"

#include <algorithm>

namespace throng::sim {

using world::AgentRole;

namespace {

template <typename T>
std::vector<T> copied(std::span<const T> values) {
  return {values.begin(), values.end()};
}

}  // namespace

CrowdRecorder::CrowdRecorder(const world::Scenario& scenario, const std::vector<AgentRole>& roles,
                             const std::vector<world::GoalRef>& moving_goals)
    : scenario_(scenario),
      roles_(roles),
      moving_goals_(moving_goals),
      intents_(roles.size(), -1),
      escaped_(roles.size(), false) {}

// Who heads for an exit intends it, also on the way on from there to safety. Who follows a drone
// goes where it leads and intends none.
void CrowdRecorder::update_intents(std::span<const crowd::GoalId> goals) {
  for (std::size_t i = 0; i < goals.size(); ++i) {
    const world::GoalRef goal{goals[i].set, goals[i].goal};
    const auto among = [&](const std::vector<world::GoalRef>& list) {
      return std::find(list.begin(), list.end(), goal) != list.end();
    };
    if (among(moving_goals_)) intents_[i] = -1;
    for (std::size_t exit = 0; exit < scenario_.exits.size(); ++exit) {
      if (among(scenario_.exits[exit].goals)) intents_[i] = static_cast<std::int8_t>(exit);
    }
  }
}

void CrowdRecorder::record(const crowd::Simulation& crowd, double time_s,
                           world::TraceWriter& trace) {
  update_intents(crowd.goals());
  trace.add({time_s, copied(crowd.positions()), copied(crowd.velocities()),
             copied(crowd.yaws_rad()), copied(crowd.desired_speeds_mps()), copied(crowd.states()),
             intents_});
  const auto positions = crowd.positions();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (roles_[i] != AgentRole::person || escaped_[i]) continue;
    if (scenario_.inside.contains(positions[i].cast<double>())) continue;
    escaped_[i] = true;
    trace.add_event({time_s, "agent_escaped", static_cast<std::int32_t>(i), -1,
                     static_cast<double>(intents_[i])});
  }
}

}  // namespace throng::sim
