#include <fmt/core.h>

#include <limits>

#include "crowd/navigation/navigation.h"
#include "crowd/state/behavior.h"

namespace throng::crowd {

namespace {

using Choice = GoalSelector::Choice;

/// The agent stays where it is; also what happens when every goal of a set is full.
Choice stay(const Crowd& crowd, std::size_t agent) { return {-1, crowd.agents.position[agent]}; }

class Identity : public GoalSelector {
 public:
  Choice select(const Crowd& crowd, std::size_t agent) override { return stay(crowd, agent); }
};

class Mirror : public GoalSelector {
 public:
  explicit Mirror(const Eigen::Vector2f& sign) : sign_(sign) {}
  Choice select(const Crowd& crowd, std::size_t agent) override {
    return {-1, crowd.agents.position[agent].cwiseProduct(sign_)};
  }

 private:
  Eigen::Vector2f sign_;
};

class Offset : public GoalSelector {
 public:
  explicit Offset(const Sampler2& offset) : offset_(offset) {}
  Choice select(const Crowd& crowd, std::size_t agent) override {
    const Agents& agents = crowd.agents;
    return {-1, agents.position[agent] + offset_(agent, agents.entry[agent])};
  }

 private:
  Sampler2 offset_;
};

class Explicit : public GoalSelector {
 public:
  explicit Explicit(int goal) : goal_(goal) {}
  Choice select(const Crowd& crowd, std::size_t agent) override {
    return crowd.goals[goal_].has_room() ? Choice{.goal = goal_} : stay(crowd, agent);
  }

 private:
  int goal_;
};

/// One of a set's goals with room, by their weights or all alike.
class Lottery : public GoalSelector {
 public:
  Lottery(int set, bool weighted, const Sampler& unit)
      : set_(set), weighted_(weighted), unit_(unit) {}

  Choice select(const Crowd& crowd, std::size_t agent) override {
    double total = 0;
    for (const int goal : crowd.goals.set(set_).goals) total += share(crowd.goals[goal]);
    double left = unit_(agent, crowd.agents.entry[agent]) * total;
    Choice choice = stay(crowd, agent);
    for (const int goal : crowd.goals.set(set_).goals) {
      const double part = share(crowd.goals[goal]);
      if (part == 0) continue;
      choice.goal = goal;
      if (left < part) break;
      left -= part;
    }
    return choice;
  }

 private:
  double share(const Goal& goal) const {
    if (!goal.has_room()) return 0;
    return weighted_ ? goal.weight : 1;
  }

  int set_;
  bool weighted_;
  Sampler unit_;
};

/// By the distance to the goals' centers, among those with room.
class Ranked : public GoalSelector {
 public:
  enum class Rank { nearest, second_nearest, farthest };
  Ranked(int set, Rank rank) : set_(set), rank_(rank) {}

  Choice select(const Crowd& crowd, std::size_t agent) override {
    const float sign = rank_ == Rank::farthest ? -1.0F : 1.0F;
    Choice first = stay(crowd, agent);
    Choice second = first;
    float first_key = std::numeric_limits<float>::infinity();
    float second_key = first_key;
    for (const int goal : crowd.goals.set(set_).goals) {
      const Goal& candidate = crowd.goals[goal];
      if (!candidate.has_room()) continue;
      const float key =
          sign * (candidate.shape->center() - crowd.agents.position[agent]).squaredNorm();
      if (key < first_key) {
        second = first;
        second_key = first_key;
        first.goal = goal;
        first_key = key;
      } else if (key < second_key) {
        second.goal = goal;
        second_key = key;
      }
    }
    return rank_ == Rank::second_nearest && second.goal >= 0 ? second : first;
  }

 private:
  int set_;
  Rank rank_;
};

/// The second nearest goal as the paper's authors computed it: the nearest of those
/// before the nearest one in the file; if that comes first, itself.
class SecondNearestAsHuang : public GoalSelector {
 public:
  explicit SecondNearestAsHuang(int set) : set_(set) {}

  Choice select(const Crowd& crowd, std::size_t agent) override {
    Choice nearest = stay(crowd, agent);
    Choice before = nearest;
    float nearest_sq = std::numeric_limits<float>::infinity();
    for (const int goal : crowd.goals.set(set_).goals) {
      const Goal& candidate = crowd.goals[goal];
      if (!candidate.has_room()) continue;
      const float distance_sq =
          (candidate.shape->center() - crowd.agents.position[agent]).squaredNorm();
      if (distance_sq >= nearest_sq) continue;
      before.goal = nearest.goal >= 0 ? nearest.goal : goal;
      nearest.goal = goal;
      nearest_sq = distance_sq;
    }
    return before;
  }

 private:
  int set_;
};

/// The other state's selector chooses; the state that this stands in has none of its own.
std::unique_ptr<GoalSelector> make_shared_selector(const Element& element,
                                                   const Attributes& attributes,
                                                   BehaviorContext& context) {
  context.shares_goal_of =
      context.require_state(element, "state_name", attributes.text("state_name"));
  return nullptr;
}

AttributeSpec goal_set_attribute() { return integer("goal_set", "id of a goal set", 0, kMaxId); }

std::unique_ptr<GoalSelector> make_identity(const Element&, const Attributes&, BehaviorContext&) {
  return std::make_unique<Identity>();
}

std::unique_ptr<GoalSelector> make_mirror(const Element&, const Attributes& attributes,
                                          BehaviorContext&) {
  return std::make_unique<Mirror>(Eigen::Vector2f(attributes.boolean("mirror_x") ? -1.0F : 1.0F,
                                                  attributes.boolean("mirror_y") ? -1.0F : 1.0F));
}

std::unique_ptr<GoalSelector> make_offset(const Element&, const Attributes& attributes,
                                          BehaviorContext& context) {
  return std::make_unique<Offset>(context.make_sampler(attributes.distribution_2()));
}

std::unique_ptr<GoalSelector> make_explicit(const Element& element, const Attributes& attributes,
                                            BehaviorContext& context) {
  const int set = context.goals.require_set(element, attributes, "goal_set");
  const int set_id = context.goals.set(set).id;
  const auto goal_id = static_cast<int>(attributes.integer("goal"));
  const int goal = context.goals.find_goal(set_id, goal_id);
  if (goal < 0) {
    element.fail_attribute("goal", fmt::format("{}", goal_id),
                           fmt::format("the id of a goal of set {}", set_id));
  }
  return std::make_unique<Explicit>(goal);
}

template <bool kWeighted>
std::unique_ptr<GoalSelector> make_lottery(const Element& element, const Attributes& attributes,
                                           BehaviorContext& context) {
  const int set = context.goals.require_set(element, attributes, "goal_set");
  return std::make_unique<Lottery>(set, kWeighted, context.make_set_sampler(set));
}

template <Ranked::Rank kRank>
std::unique_ptr<GoalSelector> make_ranked(const Element& element, const Attributes& attributes,
                                          BehaviorContext& context) {
  return std::make_unique<Ranked>(context.goals.require_set(element, attributes, "goal_set"),
                                  kRank);
}

std::unique_ptr<GoalSelector> make_second_nearest(const Element& element,
                                                  const Attributes& attributes,
                                                  BehaviorContext& context) {
  const int set = context.goals.require_set(element, attributes, "goal_set");
  if (context.crowd.compat == Compat::huang2016) {
    return std::make_unique<SecondNearestAsHuang>(set);
  }
  return std::make_unique<Ranked>(set, Ranked::Rank::second_nearest);
}

}  // namespace

std::vector<GoalSelectorRegistry::Entry> plain_goal_selectors() {
  using Rank = Ranked::Rank;
  return {
      {"identity", "the position where the agent is", {}, make_identity},
      {"mirror",
       "the agent's position seen in the axes",
       {optional(boolean("mirror_x", "negate x"), "0"),
        optional(boolean("mirror_y", "negate y"), "0")},
       make_mirror},
      {"offset",
       "somewhere about the agent's position",
       {distribution_2("offset in m")},
       make_offset},
      {"explicit",
       "one goal",
       {goal_set_attribute(), integer("goal", "id within the set", 0, kMaxId)},
       make_explicit},
      {"random", "any goal of a set", {goal_set_attribute()}, make_lottery<false>},
      {"weighted", "any goal of a set, by weight", {goal_set_attribute()}, make_lottery<true>},
      {"nearest", "the nearest of a set", {goal_set_attribute()}, make_ranked<Rank::nearest>},
      {"second_nearest",
       "the second nearest of a set, or its only one",
       {goal_set_attribute()},
       make_second_nearest},
      {"farthest", "the farthest of a set", {goal_set_attribute()}, make_ranked<Rank::farthest>},
      {"shared",
       "that of another state, which everybody then keeps for ever",
       {text("state_name", "the name of the other state")},
       make_shared_selector},
  };
}

const GoalSelectorRegistry& goal_selector_registry() {
  static const GoalSelectorRegistry kRegistry(
      {plain_goal_selectors(), navigation_goal_selectors(), evacuation_goal_selectors()},
      {optional(
          boolean("persistent", "1: who enters again keeps the goal, and occupies it meanwhile"),
          "0")});
  return kRegistry;
}

}  // namespace throng::crowd
