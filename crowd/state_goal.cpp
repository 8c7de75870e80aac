#include "crowd/state_goal.h"

namespace throng::crowd {

GoalSelector::Choice StateGoal::choose(Crowd& crowd, std::size_t agent) {
  if (is_kept_[agent] != 0) return kept_[agent];
  GoalSelector::Choice choice{-1, crowd.agents.position[agent]};
  if (selector_) choice = selector_->select(crowd, agent);
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

void StateGoal::release(Crowd& crowd, std::size_t agent) {
  const int goal = crowd.agents.goal[agent];
  if (goal >= 0 && is_kept_[agent] == 0) --crowd.goals[goal].assigned;
}

}  // namespace throng::crowd
