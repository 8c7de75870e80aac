// Obstacles that come to be in the way while people are on theirs: what a fire or a cloud takes as
// it spreads.
#include <limits>
#include <utility>

#include "crowd/behavior/machine.h"
#include "crowd/state/behavior.h"

namespace throng::crowd {

namespace {

constexpr double kRoundingS = 1e-6;

/// From a time on, who is in the state minds more classes; who enters it later does at once.
class LateObstacles : public Action {
 public:
  LateObstacles(std::uint32_t operand, double from_s, std::size_t agent_count)
      : operand_(operand), from_s_(from_s), is_inside_(agent_count, 0) {}

  void enter(Crowd& crowd, std::size_t agent) override {
    is_inside_[agent] = 1;
    if (crowd.time_s() > from_s_ - kRoundingS) crowd.agents.obstacle_mask[agent] |= operand_;
  }
  void leave(Crowd&, std::size_t agent) override { is_inside_[agent] = 0; }

  /// Once, at the time: those who are in the state look for another way, to where they were going.
  void come(Crowd& crowd, Machine& machine) {
    if (came_ || crowd.time_s() < from_s_ - kRoundingS) return;
    came_ = true;
    for (std::size_t agent = 0; agent < is_inside_.size(); ++agent) {
      if (is_inside_[agent] == 0) continue;
      crowd.agents.obstacle_mask[agent] |= operand_;
      const int goal = crowd.agents.goal[agent];
      if (goal >= 0) machine.change_goal(crowd, agent, goal);
    }
  }

 private:
  std::uint32_t operand_;
  double from_s_;
  std::vector<std::uint8_t> is_inside_;
  bool came_ = false;
};

class ObstaclesCome : public Process {
 public:
  explicit ObstaclesCome(LateObstacles& late) : late_(late) {}
  void before_decisions(Crowd& crowd, Machine& machine) override { late_.come(crowd, machine); }

 private:
  LateObstacles& late_;
};

std::unique_ptr<Action> make_late_obstacles(const Element&, const Attributes& attributes,
                                            BehaviorContext& context) {
  const auto operand = static_cast<std::uint32_t>(attributes.integer("operand"));
  auto made =
      std::make_unique<LateObstacles>(operand, attributes.number("time"), context.agent_count);
  context.processes.push_back(std::make_unique<ObstaclesCome>(*made));
  return made;
}

}  // namespace

std::vector<ActionRegistry::Entry> late_obstacle_actions() {
  return {{"add_obstacle_at",
           "from a time on, agents in the state avoid obstacles of more classes",
           {integer("operand", "bits of obstacle classes", 0,
                    std::numeric_limits<std::uint32_t>::max()),
            number("time", "of the run in s", 0, 1e6)},
           make_late_obstacles}};
}

}  // namespace throng::crowd
