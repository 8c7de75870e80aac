#include <fmt/core.h>

#include <utility>

#include "crowd/behavior/panic.h"
#include "crowd/state/behavior.h"

namespace throng::crowd {

namespace {

class Always : public Condition {
 public:
  bool holds(const Crowd&, std::size_t) const override { return true; }
  bool is_always() const override { return true; }
};

/// Somebody else of an agent's social group who is in the same state, if there is anybody.
std::optional<std::size_t> fellow_in_state(const Crowd& crowd, std::size_t agent) {
  const Agents& agents = crowd.agents;
  if (agents.social_group[agent] < 0) return std::nullopt;
  for (const std::uint32_t fellow : crowd.social_groups[agents.social_group[agent]]) {
    const bool has_entered = agents.present[fellow] != 0 && agents.entry[fellow] > 0;
    const bool there = has_entered && agents.state[fellow] == agents.state[agent];
    if (fellow != agent && there) return fellow;
  }
  return std::nullopt;
}

/// True some time after the state was entered.
class Timer : public Condition {
 public:
  /// The same for all.
  explicit Timer(double delay_s, std::size_t agent_count)
      : due_s_(agent_count), delay_s_(delay_s) {}
  /// Another one for each agent and entry; `together`: who enters where others of the social group
  /// wait goes on when they do.
  Timer(const Sampler& delay_s, bool together, std::size_t agent_count)
      : due_s_(agent_count), delays_s_(delay_s), together_(together) {}

  void enter(const Crowd& crowd, std::size_t agent) override {
    if (delays_s_) delay_s_ = (*delays_s_)(agent, crowd.agents.entry[agent]);
    due_s_[agent] = crowd.time_s() + delay_s_;
    if (!together_) return;
    if (const auto fellow = fellow_in_state(crowd, agent)) due_s_[agent] = due_s_[*fellow];
  }

  bool holds(const Crowd& crowd, std::size_t agent) const override {
    constexpr double kRounding = 1e-6;  // s
    return crowd.time_s() + kRounding >= due_s_[agent];
  }

 private:
  std::vector<double> due_s_;
  double delay_s_ = 0;
  std::optional<Sampler> delays_s_;
  bool together_ = false;
};

class GoalReached : public Condition {
 public:
  explicit GoalReached(float distance) : distance_(distance) {}

  bool holds(const Crowd& crowd, std::size_t agent) const override {
    const Agents& agents = crowd.agents;
    const Eigen::Vector2f& p = agents.position[agent];
    const int goal = agents.goal[agent];
    const float distance = goal < 0 ? (agents.own_goal[agent] - p).norm()
                                    : crowd.goals[goal].distance(p, crowd.compat);
    return distance <= distance_;
  }

 private:
  float distance_;
};

class Both : public Condition {
 public:
  Both(std::unique_ptr<Condition> a, std::unique_ptr<Condition> b)
      : a_(std::move(a)), b_(std::move(b)) {}
  void enter(const Crowd& crowd, std::size_t agent) override {
    a_->enter(crowd, agent);
    b_->enter(crowd, agent);
  }
  bool holds(const Crowd& crowd, std::size_t agent) const override {
    return a_->holds(crowd, agent) && b_->holds(crowd, agent);
  }
  bool is_always() const override { return a_->is_always() && b_->is_always(); }

 private:
  std::unique_ptr<Condition> a_;
  std::unique_ptr<Condition> b_;
};

class Either : public Condition {
 public:
  Either(std::unique_ptr<Condition> a, std::unique_ptr<Condition> b)
      : a_(std::move(a)), b_(std::move(b)) {}
  void enter(const Crowd& crowd, std::size_t agent) override {
    a_->enter(crowd, agent);
    b_->enter(crowd, agent);
  }
  bool holds(const Crowd& crowd, std::size_t agent) const override {
    return a_->holds(crowd, agent) || b_->holds(crowd, agent);
  }
  bool is_always() const override { return a_->is_always() || b_->is_always(); }

 private:
  std::unique_ptr<Condition> a_;
  std::unique_ptr<Condition> b_;
};

class Not : public Condition {
 public:
  explicit Not(std::unique_ptr<Condition> negated) : negated_(std::move(negated)) {}
  void enter(const Crowd& crowd, std::size_t agent) override { negated_->enter(crowd, agent); }
  bool holds(const Crowd& crowd, std::size_t agent) const override {
    return !negated_->holds(crowd, agent);
  }

 private:
  std::unique_ptr<Condition> negated_;
};

std::vector<std::unique_ptr<Condition>> make_operands(const Element& element, std::size_t count,
                                                      BehaviorContext& context) {
  std::vector<std::unique_ptr<Condition>> operands;
  for (const Element& child : element.children()) {
    if (child.name() != "Condition") child.fail_unknown("<Condition>");
    operands.push_back(condition_registry().make(child, context));
  }
  if (operands.size() != count) {
    element.fail(fmt::format("{} conditions", operands.size()),
                 fmt::format("{} <Condition>", count));
  }
  return operands;
}

template <typename Binary>
std::unique_ptr<Condition> make_binary(const Element& element, const Attributes&,
                                       BehaviorContext& context) {
  auto operands = make_operands(element, 2, context);
  return std::make_unique<Binary>(std::move(operands[0]), std::move(operands[1]));
}

std::unique_ptr<Condition> make_not(const Element& element, const Attributes&,
                                    BehaviorContext& context) {
  return std::make_unique<Not>(std::move(make_operands(element, 1, context)[0]));
}

std::unique_ptr<Condition> make_always(const Element& element, const Attributes&,
                                       BehaviorContext&) {
  element.require_no_children();
  return std::make_unique<Always>();
}

std::unique_ptr<Condition> make_timer(const Element& element, const Attributes& attributes,
                                      BehaviorContext& context) {
  element.require_no_children();
  if (attributes.boolean("per_agent")) {
    return std::make_unique<Timer>(context.make_sampler(attributes.distribution("")),
                                   attributes.boolean("together"), context.agent_count);
  }
  // The same for the copies too.
  const bool is_copy = std::exchange(context.is_copy, false);
  Sampler delay_s = context.make_sampler(attributes.distribution(""));
  context.is_copy = is_copy;
  return std::make_unique<Timer>(delay_s(0, 0), context.agent_count);
}

std::unique_ptr<Condition> make_goal_reached(const Element& element, const Attributes& attributes,
                                             BehaviorContext&) {
  element.require_no_children();
  return std::make_unique<GoalReached>(attributes.real("distance"));
}

}  // namespace

std::vector<ConditionRegistry::Entry> general_conditions() {
  return {
      {"auto", "always true", {}, make_always},
      {"timer",
       "true that many seconds after the state was entered",
       {boolean("per_agent", "1: a new sample per agent and entry; 0: one sample for all"),
        optional(boolean("together",
                         "1: a social group shares the sample of its first member that enters"),
                 "0"),
        distribution("", "delay in s")},
       make_timer},
      {"goal_reached",
       "the agent's center is in its goal, or near it",
       {optional(number("distance", "from the goal's region in m", 0), "0")},
       make_goal_reached},
      {"and", "both of two conditions", {}, make_binary<Both>},
      {"or", "either of two conditions", {}, make_binary<Either>},
      {"not", "a condition is false", {}, make_not},
  };
}

const ConditionRegistry& condition_registry() {
  static const ConditionRegistry kRegistry({general_conditions(), place_conditions(),
                                            aircraft_conditions(), evacuation_conditions(),
                                            panic_conditions()});
  return kRegistry;
}

}  // namespace throng::crowd
