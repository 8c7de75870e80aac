// The goal selector `exit_choice`: the exit through which somebody expects to be out first.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "base/compute/random.h"
#include "crowd/behavior.h"
#include "crowd/behavior/machine.h"

namespace throng::crowd {

namespace {

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
  void observe(const Crowd& crowd, const std::vector<int>& goals) {
    if (step_ == crowd.step && !distances_.empty()) return;
    step_ = crowd.step;
    distances_.resize(goals.size());
    for (std::vector<float>& line : distances_) line.clear();
    const Agents& agents = crowd.agents;
    for (std::size_t i = 0; i < agents.count(); ++i) {
      if (agents.present[i] == 0 || agents.goal[i] < 0) continue;
      const auto found = std::find(goals.begin(), goals.end(), agents.goal[i]);
      if (found == goals.end()) continue;
      distances_[found - goals.begin()].push_back(
          crowd.goals[*found].shape->distance(agents.position[i]));
    }
    for (std::vector<float>& line : distances_) std::sort(line.begin(), line.end());
  }

  /// How many on their way to the goal are nearer to it.
  float ahead(std::size_t goal, float distance) const {
    const std::vector<float>& line = distances_[goal];
    return static_cast<float>(std::lower_bound(line.begin(), line.end(), distance) - line.begin());
  }

 private:
  std::uint64_t step_ = 0;
  std::vector<std::vector<float>> distances_;  // per goal, ascending
};

/// The expected time is that of the way there, or, when it takes longer, that of the queue:
/// those who are nearer have to pass first (in the manner of the best-response exit choice of
/// FDS+Evac, Ehtamo, Heliovaara, Korhonen, Hostikka 2010). Only exits that somebody knows, or sees,
/// count, and none that an obstacle covers.
class ExitChoice : public GoalSelector {
 public:
  ExitChoice(const ExitChoiceSpec& spec, std::uint64_t seed) : spec_(spec), seed_(seed) {}

  Choice select(const Crowd& crowd, std::size_t agent) override {
    const int best = choose(crowd, agent, -1);
    return {best, crowd.agents.position[agent]};
  }

  /// The exit that the agent would now take; -1 when all are full.
  int choose(const Crowd& crowd, std::size_t agent, int current) {
    const std::vector<int>& goals = crowd.goals.set(spec_.set).goals;
    queues_.observe(crowd, goals);
    int best = -1;
    int nearest = -1;
    float best_s = std::numeric_limits<float>::infinity();
    float nearest_m = best_s;
    for (std::size_t i = 0; i < goals.size(); ++i) {
      const Goal& goal = crowd.goals[goals[i]];
      if (!goal.has_room() && goals[i] != current) continue;
      if (is_buried(crowd, agent, goals[i])) continue;
      const float distance = goal.shape->distance(crowd.agents.position[agent]);
      if (distance < nearest_m) {
        nearest_m = distance;
        nearest = goals[i];
      }
      if (!knows(agent, goals[i]) && distance > spec_.sight_m) continue;
      float time_s = expected_s(crowd, agent, i, distance);
      if (goals[i] == current) time_s *= 1 - spec_.patience;
      if (time_s < best_s) {
        best_s = time_s;
        best = goals[i];
      }
    }
    return best >= 0 ? best : nearest;
  }

  const ExitChoiceSpec& spec() const { return spec_; }

 private:
  /// Whether a goal's middle lies in something solid that the agent minds.
  bool is_buried(const Crowd& crowd, std::size_t agent, int goal) {
    const std::uint32_t mask = crowd.agents.obstacle_mask[agent];
    const auto [found, is_new] = buried_.try_emplace({goal, mask}, false);
    if (!is_new || crowd.compat != Compat::none) return found->second;
    const Eigen::Vector2f middle = crowd.goals[goal].shape->center();
    const std::vector<Polygon>& polygons = crowd.obstacles.polygons();
    found->second = std::any_of(polygons.begin(), polygons.end(), [&](const Polygon& polygon) {
      return (polygon.obstacle_class & mask) != 0 && polygon.solid &&
             crowd.obstacles.encloses(polygon, middle);
    });
    return found->second;
  }

  float expected_s(const Crowd& crowd, std::size_t agent, std::size_t index, float distance) const {
    constexpr float kMinSpeed = 0.1F;  // m/s
    const Goal& goal = crowd.goals[crowd.goals.set(spec_.set).goals[index]];
    const float speed = std::max(kMinSpeed, crowd.agents[Property::pref_speed][agent]);
    const float flow = spec_.flow_per_s * std::max(goal.weight, 1e-3F);
    return std::max(distance / speed, queues_.ahead(index, distance) / flow);
  }

  bool knows(std::size_t agent, int goal) const {
    const std::uint64_t key =
        (static_cast<std::uint64_t>(agent) << 24) | static_cast<std::uint64_t>(goal);
    return Random(seed_, Stream::crowd_exits, key).uniform() < spec_.familiarity;
  }

  ExitChoiceSpec spec_;
  std::uint64_t seed_;
  Queues queues_;
  std::map<std::pair<int, std::uint32_t>, bool> buried_;  ///< by goal and obstacle classes
};

/// Has those who head for an exit think again now and then, each in its own turn.
class Reconsider : public Process {
 public:
  explicit Reconsider(ExitChoice& choice) : choice_(choice) {}

  void before_decisions(Crowd& crowd, Machine& machine) override {
    const auto period = static_cast<std::uint64_t>(
        std::max(1.0, std::round(choice_.spec().reconsider_s / crowd.dt_s)));
    const Agents& agents = crowd.agents;
    for (std::size_t i = (period - crowd.step % period) % period; i < agents.count(); i += period) {
      if (agents.present[i] == 0 || machine.goal_selector(agents.state[i]) != &choice_) continue;
      const int goal = choice_.choose(crowd, i, agents.goal[i]);
      if (goal >= 0 && goal != agents.goal[i]) machine.change_goal(crowd, i, goal);
    }
  }

 private:
  ExitChoice& choice_;
};

std::unique_ptr<GoalSelector> make_exit_choice(const Element& element, const Attributes& attributes,
                                               BehaviorContext& context) {
  ExitChoiceSpec spec;
  spec.set = context.goals.require_set(element, attributes, "goal_set");
  spec.familiarity = attributes.real("familiarity");
  spec.sight_m = attributes.real("sight");
  spec.flow_per_s = attributes.real("flow");
  spec.patience = attributes.real("patience");
  spec.reconsider_s = attributes.number("reconsider");
  auto made = std::make_unique<ExitChoice>(spec, context.seed);
  if (spec.reconsider_s > 0) context.processes.push_back(std::make_unique<Reconsider>(*made));
  return made;
}

}  // namespace

std::vector<GoalSelectorRegistry::Entry> evacuation_goal_selectors() {
  return {
      {"exit_choice",
       "the exit of a set with the least expected time, by path and queue",
       {integer("goal_set", "id of a goal set; a goal's weight is its width", 0, kMaxId),
        optional(number("familiarity", "probability of knowing an exit beforehand", 0, 1), "1"),
        optional(number("sight", "exits nearer than this are known to all, in m", 0), "15"),
        optional(number("flow", "people through an exit of weight 1 in a second", 0.01, 100), "2"),
        optional(number("patience", "share of the time that another exit must save", 0, 0.99),
                 "0.15"),
        optional(number("reconsider", "seconds between second thoughts; 0: none", 0, 1e6), "3")},
       make_exit_choice}};
}

}  // namespace throng::crowd
