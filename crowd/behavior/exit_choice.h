// The choice of an exit by the time until somebody expects to be out.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "crowd/state/behavior.h"

namespace throng::crowd {

struct ExitChoiceSpec {
  int set = 0;
  float familiarity = 1;    ///< probability of knowing an exit beforehand
  float sight_m = 15;       ///< an exit nearer than this is known to anybody
  float flow_per_s = 2;     ///< people through an exit of weight 1 in a second
  float patience = 0.15F;   ///< share of the time that another exit must save
  double reconsider_s = 3;  ///< 0: never
};

/// How many are on their way to each goal, by their distance to it: what a person sees of queues.
class Queues {
 public:
  /// Sorts all agents again, once in a step.
  void observe(const Crowd& crowd, const std::vector<int>& goals);
  /// How many on their way to the goal are nearer to it.
  float ahead(std::size_t goal, float distance) const;

 private:
  std::uint64_t step_ = 0;
  std::vector<std::vector<float>> distances_;  // per goal, ascending
};

/// The goal selector `exit_choice`. The expected time is that of the way there, or, when it takes
/// longer, that of the queue: those who are nearer have to pass first (in the manner of the
/// best-response exit choice of FDS+Evac, Ehtamo, Heliovaara, Korhonen, Hostikka 2010). Only exits
/// that somebody knows, or sees, count, and none that an obstacle covers as far as somebody knows.
class ExitChoice : public GoalSelector {
 public:
  ExitChoice(const ExitChoiceSpec& spec, std::uint64_t seed) : spec_(spec), seed_(seed) {}

  Choice select(const Crowd& crowd, std::size_t agent) override {
    const int best = choose(crowd, agent, -1);
    return {best, crowd.agents.position[agent]};
  }

  /// The exit that the agent would now take, the nearest if all are covered; -1 when all are full.
  int choose(const Crowd& crowd, std::size_t agent, int current);

  /// Whether a goal's middle lies in something solid that the agent knows and minds.
  bool is_buried(const Crowd& crowd, std::size_t agent, int goal);

  const ExitChoiceSpec& spec() const { return spec_; }

 private:
  float expected_s(const Crowd& crowd, std::size_t agent, std::size_t index, float distance) const;
  bool knows(std::size_t agent, int goal) const;

  ExitChoiceSpec spec_;
  std::uint64_t seed_;
  Queues queues_;
  std::map<std::pair<int, std::uint32_t>, bool> buried_;  ///< by goal and obstacle classes
};

}  // namespace throng::crowd
