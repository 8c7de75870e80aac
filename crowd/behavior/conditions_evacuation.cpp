#include <fmt/core.h>

#include <algorithm>

#include "crowd/state/behavior.h"

namespace throng::crowd {

namespace {

bool near_goal_of_set(const Crowd& crowd, std::size_t agent, int set, float distance) {
  const Eigen::Vector2f& p = crowd.agents.position[agent];
  const std::vector<int>& goals = crowd.goals.set(set).goals;
  return std::any_of(goals.begin(), goals.end(), [&](int goal) {
    return crowd.goals[goal].distance(p, crowd.compat) <= distance;
  });
}

/// Near something that leads out, by an agent who is inclined to follow.
class FollowNear : public Condition {
 public:
  FollowNear(int set, float distance, double probability, const Sampler& unit,
             std::size_t agent_count)
      : set_(set),
        distance_(distance),
        probability_(probability),
        unit_(unit),
        inclined_(agent_count) {}

  void enter(const Crowd& crowd, std::size_t agent) override {
    inclined_[agent] = unit_(agent, crowd.agents.entry[agent]) < probability_ ? 1 : 0;
  }

  bool holds(const Crowd& crowd, std::size_t agent) const override {
    return inclined_[agent] != 0 && near_goal_of_set(crowd, agent, set_, distance_);
  }

 private:
  int set_;
  float distance_;
  double probability_;
  Sampler unit_;
  std::vector<std::uint8_t> inclined_;
};

class Near : public Condition {
 public:
  Near(int set, float distance) : set_(set), distance_(distance) {}
  bool holds(const Crowd& crowd, std::size_t agent) const override {
    return near_goal_of_set(crowd, agent, set_, distance_);
  }

 private:
  int set_;
  float distance_;
};

/// How far an agent's effect reaches, and when.
struct Reach {
  std::size_t avoided = 0;  // agent
  float distance = 0;       // m
  float growth_rate = 0;    // m/s
  float max_distance = 0;   // m
  double start_s = 0;
  double end_s = 0;

  bool reaches(const Crowd& crowd, std::size_t agent) const {
    const Agents& agents = crowd.agents;
    const double since_start = crowd.time_s() - start_s;
    constexpr double kRounding = 1e-6;  // s
    if (crowd.time_s() > end_s + kRounding) return false;
    if (since_start < -kRounding || agent == avoided || agents.present[avoided] == 0) return false;
    const float grown = distance + growth_rate * static_cast<float>(since_start);
    const float reach = agents[Property::radius][avoided] + std::min(grown, max_distance);
    return (agents.position[agent] - agents.position[avoided]).squaredNorm() < reach * reach;
  }
};

/// Within the reach of an agent's effect, which spreads.
class Proximity : public Condition {
 public:
  explicit Proximity(const Reach& reach) : reach_(reach) {}
  bool holds(const Crowd& crowd, std::size_t agent) const override {
    return reach_.reaches(crowd, agent);
  }

 private:
  Reach reach_;
};

/// For how long everybody has been within reach, in all and in whatever state.
struct Exposures {
  std::vector<double> within_s;  // by agent
};

class CountExposure : public Process {
 public:
  CountExposure(const Reach& reach, std::shared_ptr<Exposures> exposures)
      : reach_(reach), exposures_(std::move(exposures)) {}
  void after_motion(Crowd& crowd, Machine&) override {
    const Agents& agents = crowd.agents;
    for (std::size_t i = 0; i < agents.count(); ++i) {
      if (agents.present[i] == 0 || !reach_.reaches(crowd, i)) continue;
      exposures_->within_s[i] += crowd.dt_s;
    }
  }

 private:
  Reach reach_;
  std::shared_ptr<Exposures> exposures_;
};

/// Has been within reach for so long.
class Exposed : public Condition {
 public:
  Exposed(double after_s, std::shared_ptr<const Exposures> exposures)
      : after_s_(after_s), exposures_(std::move(exposures)) {}
  bool holds(const Crowd&, std::size_t agent) const override {
    constexpr double kRounding = 1e-6;  // s
    return exposures_->within_s[agent] > after_s_ - kRounding;
  }

 private:
  double after_s_;
  std::shared_ptr<const Exposures> exposures_;
};

/// The paper's authors' own: one reach for all agents of a transition, which grows whenever an
/// agent looks. In such runs one agent looks at a time, in the order of ids.
class ProximityAsHuang : public Condition {
 public:
  ProximityAsHuang(std::size_t avoided, float distance) : avoided_(avoided), reach_(distance) {}

  bool holds(const Crowd& crowd, std::size_t agent) const override {
    constexpr float kFullReach = 20;        // m
    constexpr float kReachGrowth = 0.2F;    // m per look
    constexpr float kSpreadFrom = 3;        // m
    constexpr float kSpreadGrowth = 4e-4F;  // m per look
    if (reach_ < kFullReach) reach_ += kReachGrowth;
    if (reach_ >= kSpreadFrom) spread_ += kSpreadGrowth;
    const Agents& agents = crowd.agents;
    const float distance = (agents.position[agent] - agents.position[avoided_]).norm();
    return distance < agents[Property::radius][avoided_] + reach_ + spread_;
  }

 private:
  std::size_t avoided_;
  mutable float reach_;
  mutable float spread_ = 0;
};

class Never : public Condition {
 public:
  bool holds(const Crowd&, std::size_t) const override { return false; }
};

AttributeTable near_set_attributes(std::string_view set) {
  return {number("distance", "from a goal's region in m", 0),
          integer(set, "id of a goal set", 0, kMaxId)};
}

std::unique_ptr<Condition> make_follow(const Element& element, const Attributes& attributes,
                                       BehaviorContext& context) {
  element.require_no_children();
  const int set = context.goals.require_set(element, attributes, "goalSetToFollow");
  const float distance = attributes.real("distance");
  const double weight = attributes.number("weight");
  const double compliance = context.crowd.compliance;
  const bool weighted = context.crowd.compat != Compat::huang2016;
  if (!weighted && compliance >= 1) return std::make_unique<Near>(set, distance);
  if (weighted && weight > 1) {
    element.warn_attribute("weight", fmt::format("{}; everybody follows", weight),
                           "a probability from 0 to 1");
  }
  const double inclined = compliance * (weighted ? std::min(weight, 1.0) : 1.0);
  return std::make_unique<FollowNear>(set, distance, inclined, context.make_unit_sampler(),
                                      context.agent_count);
}

std::unique_ptr<Condition> make_via(const Element& element, const Attributes& attributes,
                                    BehaviorContext& context) {
  element.require_no_children();
  return std::make_unique<Near>(context.goals.require_set(element, attributes, "goalsVia"),
                                attributes.real("distance"));
}

/// Those of one reach, in whatever state, count together.
std::unique_ptr<Condition> make_exposed(const Reach& reach, double after_s,
                                        BehaviorContext& context) {
  const std::string key =
      fmt::format("{} {} {} {} {} {}", reach.avoided, reach.distance, reach.growth_rate,
                  reach.max_distance, reach.start_s, reach.end_s);
  const auto exposures = context.crowd.parts->get<Exposures>(key, [&] {
    auto made = std::make_shared<Exposures>();
    made->within_s.resize(context.agent_count);
    context.processes.push_back(std::make_unique<CountExposure>(reach, made));
    return made;
  });
  return std::make_unique<Exposed>(after_s, exposures);
}

std::unique_ptr<Condition> make_proximity(const Element& element, const Attributes& attributes,
                                          BehaviorContext& context) {
  element.require_no_children();
  const auto avoided = static_cast<std::size_t>(attributes.integer("agentToAvoid"));
  if (avoided >= context.agent_count) {
    element.fail_attribute("agentToAvoid", fmt::format("{}", avoided),
                           fmt::format("an agent's id, below {}", context.agent_count));
  }
  if (context.crowd.compat == Compat::huang2016) {
    // Copied for another state of a comma list it forgot whom to avoid.
    if (context.is_copy) return std::make_unique<Never>();
    return std::make_unique<ProximityAsHuang>(avoided, attributes.real("distance"));
  }
  Reach reach;
  reach.avoided = avoided;
  reach.distance = attributes.real("distance");
  reach.growth_rate = attributes.real("growth_rate");
  reach.start_s = attributes.number("start");
  reach.end_s =
      attributes.has("end") ? attributes.number("end") : std::numeric_limits<double>::infinity();
  if (attributes.has("max_distance")) {
    reach.max_distance = attributes.real("max_distance");
    if (reach.max_distance < reach.distance) {
      element.fail_attribute("max_distance", fmt::format("{}", reach.max_distance),
                             fmt::format("at least the distance, {}", reach.distance));
    }
  } else {
    reach.max_distance =
        reach.growth_rate > 0 ? std::numeric_limits<float>::infinity() : reach.distance;
  }
  const double after_s = attributes.number("after");
  if (after_s <= 0) return std::make_unique<Proximity>(reach);
  return make_exposed(reach, after_s, context);
}

}  // namespace

std::vector<ConditionRegistry::Entry> evacuation_conditions() {
  AttributeTable follow = near_set_attributes("goalSetToFollow");
  follow.push_back(optional(
      number("weight", "probability that a near agent follows, decided once per entry", 0, 1e6),
      "1"));
  return {
      {"follow", "near a goal that leads out", std::move(follow), make_follow},
      {"via", "near a goal of a set", near_set_attributes("goalsVia"), make_via},
      {"proximity",
       "near an agent to be avoided",
       {number("distance", "from the avoided agent's edge in m", 0),
        integer("agentToAvoid", "id of an agent", 0, kMaxId),
        optional(number("growth_rate", "of the distance in m/s", 0), "0"),
        optional(number("max_distance",
                        "up to which it grows in m; without it: no limit if it grows", 0)),
        optional(number("start", "before this time nobody notices, in s", 0), "0"),
        optional(number("end", "after this time nobody does; without it: always, in s", 0)),
        optional(number("after", "s that one must have been so near, in all", 0), "0")},
       make_proximity},
  };
}

}  // namespace throng::crowd
