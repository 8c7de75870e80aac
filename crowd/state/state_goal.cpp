#include "crowd/state/state_goal.h"

namespace throng::crowd {

namespace {

/// The goal of somebody of the agent's social group who is in the same state; -1: none.
int fellows_goal(const Crowd& crowd, std::size_t agent) {
  const Agents& agents = crowd.agents;
  if (agents.social_group[agent] < 0) return -1;
  for (const std::uint32_t fellow : crowd.social_groups[agents.social_group[agent]]) {
    const bool there = fellow != agent && agents.present[fellow] != 0 && agents.entry[fellow] > 0 &&
                       agents.state[fellow] == agents.state[agent];
    if (there && agents.goal[fellow] >= 0 && crowd.goals[agents.goal[fellow]].has_room()) {
      return agents.goal[fellow];
    }
  }
  return -1;
}

}  // namespace

GoalSelector::Choice StateGoal::choose(Crowd& crowd, std::size_t agent) {
  if (is_kept_[agent] != 0) return kept_[agent];
  GoalSelector::Choice choice{-1, crowd.agents.position[agent]};
  if (selector_) choice = selector_->select(crowd, agent);
  if (const int shared = choice.goal >= 0 ? fellows_goal(crowd, agent) : -1; shared >= 0) {
    choice.goal = shared;
  }
  if (choice.goal >= 0) ++crowd.goals[choice.goal].assigned;
  if (persistent_) {
    kept_[agent] = choice;
    is_kept_[agent] = 1;
  }
  return choice;
}

void StateGoal::assign(Crowd& crowd, std::size_t agent) {
  const GoalSelector::Choice choice = choose(crowd, agent);
  Agents& agents = crowd.agents;
  agents.goal[agent] = choice.goal;
  agents.own_goal[agent] = choice.point;
  agents.goal_id[agent] = choice.goal >= 0 ? crowd.goals[choice.goal].id : GoalId{};
}

void StateGoal::change(Crowd& crowd, std::size_t agent, int goal) {
  release(crowd, agent);
  ++crowd.goals[goal].assigned;
  if (is_kept_[agent] != 0) {
    --crowd.goals[kept_[agent].goal].assigned;
    kept_[agent].goal = goal;
  }
  crowd.agents.goal[agent] = goal;
  crowd.agents.goal_id[agent] = crowd.goals[goal].id;
}

void StateGoal::release(Crowd& crowd, std::size_t agent) {
  const int goal = crowd.agents.goal[agent];
  if (goal >= 0 && is_kept_[agent] == 0) --crowd.goals[goal].assigned;
}

}  // namespace throng::crowd
