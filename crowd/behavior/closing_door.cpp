#include "crowd/behavior/closing_door.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "crowd/behavior/exit_choice.h"
#include "crowd/behavior/machine.h"
#include "crowd/spatial/door_line.h"

namespace throng::crowd {

namespace {

using Eigen::Vector2f;

struct ClosingDoorSpec {
  std::uint32_t obstacle_class = 0;
  double from_s = 0;
  DoorLine line{Vector2f::Zero(), Vector2f::Zero()};
  float sight_m = 40;
};

class ClosingDoor : public Process {
 public:
  ClosingDoor(const ClosingDoorSpec& spec, std::uint64_t seed) : spec_(spec), seed_(seed) {}

  void before_decisions(Crowd& crowd, Machine& machine) override {
    constexpr double kRounding = 1e-6;
    // In the step during which it closes, too: nobody passes after the time.
    if (crowd.time_s() + crowd.dt_s < spec_.from_s + kRounding) return;
    if (!closed_ && spec_.from_s > 0) stop_everybody(crowd.agents);
    closed_ = true;
    look(crowd, machine);
    note_near(crowd.agents);
  }

  /// Puts those back who were too fast to stop, in every pedestrian model.
  void after_motion(Crowd& crowd, Machine&) override {
    if (!closed_) return;
    Agents& agents = crowd.agents;
    constexpr LineMargins kMargins{.open = 0, .walls = 0.3F};
    for (const auto& [agent, before] : near_) {
      const std::uint32_t walls = agents.obstacle_mask[agent] & ~spec_.obstacle_class;
      if (!crosses(spec_.line, before, agents.position[agent], kMargins, crowd.obstacles, walls)) {
        continue;
      }
      agents.position[agent] = before;
      agents.velocity[agent].setZero();
    }
  }

 private:
  void stop_everybody(Agents& agents) const {
    for (std::size_t i = 0; i < agents.count(); ++i) {
      if (agents.obstacle_mask[i] == 0) continue;  // nothing stops it
      agents.obstacle_mask[i] |= spec_.obstacle_class;
      agents.unseen_mask[i] |= spec_.obstacle_class;
    }
  }

  /// Each person looks now and then, in its own turn.
  void look(Crowd& crowd, Machine& machine) {
    constexpr double kEveryS = 0.5;
    const auto period = static_cast<std::uint64_t>(std::max(1.0, std::round(kEveryS / crowd.dt_s)));
    Agents& agents = crowd.agents;
    for (std::size_t i = (period - crowd.step % period) % period; i < agents.count(); i += period) {
      if (agents.present[i] == 0) continue;
      const bool is_new = (agents.unseen_mask[i] & spec_.obstacle_class) != 0;
      if (is_new && !sees(crowd, i)) continue;
      agents.unseen_mask[i] &= ~spec_.obstacle_class;
      const int goal = agents.goal[i];
      if (goal < 0) continue;
      const int other = other_goal(crowd, machine, i);
      if (is_new || other != goal) machine.change_goal(crowd, i, other);
    }
  }

  bool sees(const Crowd& crowd, std::size_t agent) const {
    const Vector2f& eye = crowd.agents.position[agent];
    const auto is_in_doorway = [&](const Polygon& polygon) {
      return polygon.obstacle_class == spec_.obstacle_class &&
             crowd.obstacles.encloses(polygon, eye);
    };
    const std::vector<Polygon>& polygons = crowd.obstacles.polygons();
    if (std::any_of(polygons.begin(), polygons.end(), is_in_doorway)) return false;
    const std::uint32_t others = crowd.agents.obstacle_mask[agent] & ~spec_.obstacle_class;
    constexpr std::array kShares = {0.5F, 0.2F, 0.8F};  // of the line: a pillar may hide its middle
    return std::any_of(kShares.begin(), kShares.end(), [&](float share) {
      const Vector2f point = spec_.line.from + share * (spec_.line.to - spec_.line.from);
      return (point - eye).squaredNorm() < spec_.sight_m * spec_.sight_m &&
             crowd.obstacles.visible(eye, point, 0, others);
    });
  }

  /// The goal of somebody who knows that the door is closed.
  int other_goal(const Crowd& crowd, const Machine& machine, std::size_t agent) {
    const int goal = crowd.agents.goal[agent];
    auto* choice = dynamic_cast<ExitChoice*>(machine.goal_selector(crowd.agents.state[agent]));
    if (choice == nullptr) {
      const int set = crowd.goals.find_set(crowd.goals[goal].id.set);
      ExitChoiceSpec spec;
      spec.set = set;
      spec.sight_m = spec_.sight_m;
      choice = &choices_.try_emplace(set, spec, seed_).first->second;
    }
    if (!choice->is_buried(crowd, agent, goal)) return goal;
    const int other = choice->choose(crowd, agent, goal);
    return other < 0 ? goal : other;
  }

  /// Notes where those are who may reach the line within a step.
  void note_near(const Agents& agents) {
    constexpr float kReachM = 3;
    near_.clear();
    const Vector2f middle = 0.5F * (spec_.line.from + spec_.line.to);
    const float reach_m = 0.5F * spec_.line.length_m() + kReachM;
    for (std::size_t i = 0; i < agents.count(); ++i) {
      if (agents.present[i] == 0 || agents.obstacle_mask[i] == 0) continue;
      if ((agents.position[i] - middle).squaredNorm() > reach_m * reach_m) continue;
      near_.emplace_back(i, agents.position[i]);
    }
  }

  ClosingDoorSpec spec_;
  std::uint64_t seed_;
  bool closed_ = false;
  std::vector<std::pair<std::size_t, Vector2f>> near_;  // agents and their positions
  std::map<int, ExitChoice> choices_;  // by goal set, for those whose state has another selector
};

}  // namespace

AttributeTable closing_door_attributes() {
  return {
      integer("class", "bits of the classes of the obstacles that close it", 1,
              std::numeric_limits<std::uint32_t>::max()),
      number("time", "from which on nobody passes, in s; 0: all know it from the start", 0, 1e7),
      number("from_x", "an end of the line, in m"),
      number("from_y", "an end of the line, in m"),
      number("to_x", "the other end, in m"),
      number("to_y", "the other end, in m"),
      optional(number("sight", "how far people see that it is closed, in m", 0), "40")};
}

std::unique_ptr<Process> make_closing_door(const Element& element, const BehaviorContext& context) {
  element.require_no_children();
  const Attributes attributes(element, closing_door_attributes());
  ClosingDoorSpec spec;
  spec.obstacle_class = static_cast<std::uint32_t>(attributes.integer("class"));
  spec.from_s = attributes.number("time");
  spec.line.from = {attributes.real("from_x"), attributes.real("from_y")};
  spec.line.to = {attributes.real("to_x"), attributes.real("to_y")};
  spec.sight_m = attributes.real("sight");
  return std::make_unique<ClosingDoor>(spec, context.seed);
}

}  // namespace throng::crowd
