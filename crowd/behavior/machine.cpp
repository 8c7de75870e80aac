#include "crowd/behavior/machine.h"

#include <bitset>
#include <cmath>

#include "base/compute/parallel.h"

namespace throng::crowd {

namespace {

constexpr std::size_t kDecisionGrain = 256;  // agents per task

}  // namespace

Machine::Machine(Behavior behavior, std::size_t agent_count)
    : behavior_(std::move(behavior)), due_(agent_count, kNone) {}

void Machine::start(Crowd& crowd) {
  Agents& agents = crowd.agents;
  for (std::size_t i = 0; i < agents.count(); ++i) {
    agents.previous_state[i] = agents.state[i];
    if (agents.present[i] != 0) enter(crowd, i, agents.state[i]);
  }
}

void Machine::prepare_to_step(Crowd& crowd) {
  Agents& agents = crowd.agents;
  for (const auto& process : behavior_.processes) process->before_start(crowd);
  prefer(crowd);
  for (std::size_t i = 0; i < agents.count(); ++i) face_the_way(agents, i);
}

void Machine::arrive(Crowd& crowd, std::size_t agent) {
  Agents& agents = crowd.agents;
  agents.awaited[agent] = 0;
  agents.present[agent] = 1;
  --crowd.awaited;
  enter(crowd, agent, agents.state[agent]);
  prefer(crowd, agent);
  face_the_way(agents, agent);
}

void Machine::face_the_way(Agents& agents, std::size_t agent) {
  if (agents.preferred_speed[agent] > 0) {
    agents.facing[agent].setZero();
  } else if (!agents.facing[agent].isZero()) {
    agents.preferred_direction[agent] = agents.facing[agent];
  }
  agents.orientation[agent] = agents.preferred_direction[agent];
  agents.yaw_rad[agent] = std::atan2(agents.orientation[agent].y(), agents.orientation[agent].x());
}

void Machine::take_transitions(Crowd& crowd) {
  const std::size_t count = crowd.agents.count();
  if (crowd.compat != Compat::none) {
    for (std::size_t i = 0; i < count; ++i) {
      if (crowd.agents.present[i] != 0) follow_chain(crowd, i, due_transition(crowd, i));
    }
    return;
  }
  parallel_ranges(count, kDecisionGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      due_[i] = crowd.agents.present[i] != 0 ? due_transition(crowd, i) : kNone;
    }
  });
  for (std::size_t i = 0; i < count; ++i) {
    if (due_[i] != kNone) follow_chain(crowd, i, due_[i]);
  }
}

int Machine::due_transition(const Crowd& crowd, std::size_t agent) const {
  const std::vector<Transition>& all = behavior_.states[crowd.agents.state[agent]].transitions;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].condition->holds(crowd, agent)) return static_cast<int>(i);
  }
  return kNone;
}

void Machine::follow_chain(Crowd& crowd, std::size_t agent, int transition) {
  Agents& agents = crowd.agents;
  std::bitset<256> visited;
  while (transition != kNone) {
    const std::uint8_t from = agents.state[agent];
    visited.set(from);
    const std::uint8_t to =
        behavior_.states[from].transitions[transition].target->state(crowd, agent);
    if (visited.test(to)) return;
    change_state(crowd, agent, to);
    if (agents.present[agent] == 0) return;
    transition = due_transition(crowd, agent);
  }
}

void Machine::change_state(Crowd& crowd, std::size_t agent, std::uint8_t state) {
  leave(crowd, agent);
  crowd.agents.facing[agent].setZero();
  crowd.agents.previous_state[agent] = crowd.agents.state[agent];
  enter(crowd, agent, state);
}

void Machine::change_goal(Crowd& crowd, std::size_t agent, int goal) {
  MachineState& state = behavior_.states[crowd.agents.state[agent]];
  state.goal->change(crowd, agent, goal);
  if (state.velocity) state.velocity->enter(crowd, agent);
}

bool Machine::fire(std::string_view name) {
  bool any = false;
  for (const auto& signal : behavior_.signals) {
    if (signal->name != name) continue;
    signal->raised = true;
    any = true;
  }
  return any;
}

void Machine::run_processes_before(Crowd& crowd) {
  for (const auto& process : behavior_.processes) process->before_decisions(crowd, *this);
}

void Machine::run_processes_after(Crowd& crowd) {
  for (const auto& process : behavior_.processes) process->after_motion(crowd, *this);
}

void Machine::enter(Crowd& crowd, std::size_t agent, std::uint8_t state) {
  Agents& agents = crowd.agents;
  agents.state[agent] = state;
  agents.entered_s[agent] = crowd.time_s();
  ++agents.entry[agent];
  MachineState& entered = behavior_.states[state];
  for (const auto& action : entered.actions) action->enter(crowd, agent);
  if (agents.present[agent] == 0) {  // an action took it out of the simulation
    agents.velocity[agent].setZero();
    agents.goal[agent] = -1;
    agents.goal_id[agent] = {};
    return;
  }

  entered.goal->assign(crowd, agent);
  if (entered.velocity) entered.velocity->enter(crowd, agent);
  for (const Transition& transition : entered.transitions) {
    transition.condition->enter(crowd, agent);
  }
}

void Machine::leave(Crowd& crowd, std::size_t agent) {
  Agents& agents = crowd.agents;
  // Backwards, so that two changes of one property are undone properly.
  const auto& actions = behavior_.states[agents.state[agent]].actions;
  for (auto action = actions.rbegin(); action != actions.rend(); ++action) {
    (*action)->leave(crowd, agent);
  }
  behavior_.states[agents.state[agent]].goal->release(crowd, agent);
}

void Machine::prefer(Crowd& crowd) const {
  parallel_ranges(crowd.agents.count(), kDecisionGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (crowd.agents.present[i] != 0) prefer(crowd, i);
    }
  });
}

void Machine::prefer(Crowd& crowd, std::size_t agent) const {
  Agents& agents = crowd.agents;
  const MachineState& state = behavior_.states[agents.state[agent]];
  PreferredVelocity preferred{agents.preferred_direction[agent], 0};
  if (state.velocity) state.velocity->prefer(crowd, agent, preferred);
  for (const auto& modifier : state.modifiers) modifier->modify(crowd, agent, preferred);
  for (const auto& modifier : behavior_.modifiers) modifier->modify(crowd, agent, preferred);
  for (const auto& modifier : behavior_.profile_modifiers[agents.profile[agent]]) {
    modifier->modify(crowd, agent, preferred);
  }
  agents.preferred_direction[agent] = preferred.direction;
  agents.preferred_speed[agent] = preferred.speed;
}

}  // namespace throng::crowd
