// Goals of the agents in a state.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "crowd/state/crowd.h"

namespace throng::crowd {

/// Chooses the goal of an agent that enters a state.
class GoalSelector {
 public:
  struct Choice {
    int goal = -1;  ///< index into Crowd::goals; -1: `point` is the goal
    Eigen::Vector2f point = Eigen::Vector2f::Zero();
  };

  virtual ~GoalSelector() = default;
  /// Called for one agent at a time.
  virtual Choice select(const Crowd& crowd, std::size_t agent) = 0;
};

/// Assigns goals to agents that enter a state and releases them when they leave it; a goal is full
/// when as many agents have it as its capacity. Several states may share an object. An agent that
/// enters a state in which a member of its social group has a goal gets the same goal, if there is
/// room.
class StateGoal {
 public:
  /// Without a selector, agents stay at their positions.
  StateGoal(std::unique_ptr<GoalSelector> selector, std::size_t agent_count)
      : selector_(std::move(selector)), kept_(agent_count), is_kept_(agent_count, 0) {}

  /// Makes agents keep their goal permanently, in this state and in those that share the object.
  void make_persistent() { persistent_ = true; }

  void assign(Crowd& crowd, std::size_t agent);
  void release(Crowd& crowd, std::size_t agent);
  /// Replaces the assigned goal.
  void change(Crowd& crowd, std::size_t agent, int goal);

  GoalSelector* selector() const { return selector_.get(); }

 private:
  GoalSelector::Choice choose(Crowd& crowd, std::size_t agent);

  std::unique_ptr<GoalSelector> selector_;
  bool persistent_ = false;
  std::vector<GoalSelector::Choice> kept_;
  std::vector<std::uint8_t> is_kept_;
};

}  // namespace throng::crowd
