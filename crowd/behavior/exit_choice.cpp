#include "crowd/behavior/exit_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/compute/random.h"
#include "crowd/behavior/machine.h"

namespace throng::crowd {

void Queues::observe(const Crowd& crowd, const std::vector<int>& goals) {
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

float Queues::ahead(std::size_t goal, float distance) const {
  const std::vector<float>& line = distances_[goal];
  return static_cast<float>(std::lower_bound(line.begin(), line.end(), distance) - line.begin());
}

int ExitChoice::choose(const Crowd& crowd, std::size_t agent, int current) {
  const std::vector<int>& goals = crowd.goals.set(spec_.set).goals;
  queues_.observe(crowd, goals);
  int best = -1;
  int nearest = -1;
  float best_s = std::numeric_limits<float>::infinity();
  float nearest_m = best_s;
  int nearest_buried = -1;  // where one waits if all are
  float nearest_buried_m = best_s;
  for (std::size_t i = 0; i < goals.size(); ++i) {
    const Goal& goal = crowd.goals[goals[i]];
    if (!goal.has_room() && goals[i] != current) continue;
    const float distance = goal.shape->distance(crowd.agents.position[agent]);
    if (is_buried(crowd, agent, goals[i])) {
      if (distance < nearest_buried_m) {
        nearest_buried_m = distance;
        nearest_buried = goals[i];
      }
      continue;
    }
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
  if (best >= 0) return best;
  return nearest >= 0 ? nearest : nearest_buried;
}

bool ExitChoice::is_buried(const Crowd& crowd, std::size_t agent, int goal) {
  const std::uint32_t mask = crowd.agents.known_mask(agent);
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

float ExitChoice::expected_s(const Crowd& crowd, std::size_t agent, std::size_t index,
                             float distance) const {
  constexpr float kMinSpeed = 0.1F;  // m/s
  const Goal& goal = crowd.goals[crowd.goals.set(spec_.set).goals[index]];
  const float speed = std::max(kMinSpeed, crowd.agents[Property::pref_speed][agent]);
  const float flow = spec_.flow_per_s * std::max(goal.weight, 1e-3F);
  return std::max(distance / speed, queues_.ahead(index, distance) / flow);
}

bool ExitChoice::knows(std::size_t agent, int goal) const {
  const std::uint64_t key =
      (static_cast<std::uint64_t>(agent) << 24) | static_cast<std::uint64_t>(goal);
  return Random(seed_, Stream::crowd_exits, key).uniform() < spec_.familiarity;
}

namespace {

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
