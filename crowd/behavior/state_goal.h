// Which goals the agents of a state have.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "crowd/crowd.h"

namespace throng::crowd {

/// Chooses an agent's goal on entry into a state.
class GoalSelector {
 public:
  struct Choice {
    int goal = -1;  ///< index into Crowd::goals; -1: the point
    Eigen::Vector2f point = Eigen::Vector2f::Zero();
  };

  virtual ~GoalSelector() = default;
  /// Called for one agent at a time.
  virtual Choice select(const Crowd& crowd, std::size_t agent) = 0;
};

/// Gives agents goals as they enter a state, and takes them back as they leave it: a goal with a
/// capacity is full while as many agents have it. Several states may share one. An agent that
/// enters a state in which a member of its social group has a goal already goes there too, if there
/// is room.
class StateGoal {
 public:
  /// Without a selector agents stay where they are.
  StateGoal(std::unique_ptr<GoalSelector> selector, std::size_t agent_count)
      : selector_(std::move(selector)), kept_(agent_count), is_kept_(agent_count, 0) {}

  /// From now on agents keep their goal for ever, in this state and in those that share it.
  void make_persistent() { persistent_ = true; }

  void assign(Crowd& crowd, std::size_t agent);
  void release(Crowd& crowd, std::size_t agent);
  /// Gives the agent another goal than it was assigned.
  void change(Crowd& crowd, std::size_t agent, int goal);

  const GoalSelector* selector() const { return selector_.get(); }

 private:
  GoalSelector::Choice choose(Crowd& crowd, std::size_t agent);

  std::unique_ptr<GoalSelector> selector_;
  bool persistent_ = false;
  std::vector<GoalSelector::Choice> kept_;
  std::vector<std::uint8_t> is_kept_;
};

}  // namespace throng::crowd
