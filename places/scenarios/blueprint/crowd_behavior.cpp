#include "places/scenarios/blueprint/crowd_behavior.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "base/geometry/angle.h"
#include "crowd/description/builder.h"
#include "places/scenarios/blueprint/blocked.h"
#include "places/scenarios/blueprint/people.h"
#include "world/trace.h"

namespace throng::scenarios {

using crowd::Attribute;
using crowd::BehaviorBuilder;
using crowd::decimals_text;
using crowd::Node;
using crowd::describe::significant_text;
using Eigen::Vector2d;
using world::Exit;
using world::Scenario;
namespace describe = crowd::describe;

namespace {

constexpr int kSpotsSet = 0;
constexpr int kAwaySet = 1;

/// A region just beyond a door, as wide as the door but for its jambs.
Node door_goal(const Exit& exit, std::size_t id) {
  constexpr double kBehindM = 0.3;
  constexpr double kDeepM = 1;
  const double jamb_m = std::min(0.3, 0.2 * exit.length_m());
  Vector2d from = exit.from;
  Vector2d along = (exit.to - exit.from).normalized();
  // The box's second axis, to the left of the first, leads out.
  if (Vector2d(-along.y(), along.x()).dot(exit.outward) < 0) {
    from = exit.to;
    along = -along;
  }
  const Vector2d pivot = from + jamb_m * along + kBehindM * exit.outward;
  const double angle_deg = std::atan2(along.y(), along.x()) / kDegree;
  return Node("Goal", {{"id", id},
                       {"type", "OBB"},
                       {"x", decimals_text(pivot.x(), 3)},
                       {"y", decimals_text(pivot.y(), 3)},
                       {"width", decimals_text(exit.length_m() - 2 * jamb_m, 3)},
                       {"height", decimals_text(kDeepM, 3)},
                       {"angle", decimals_text(angle_deg, 3)},
                       {"weight", significant_text(exit.width_m(), 3)}});
}

/// Straight out of a door, where one has left the scenario.
Vector2d beyond(const Exit& exit, const geometry::Region& inside) {
  constexpr double kStepM = 0.5;
  constexpr double kFartherM = 4;
  Vector2d at = exit.middle();
  while (inside.contains(at)) at += kStepM * exit.outward;
  return at + kFartherM * exit.outward;
}

void add_goals(const Scenario& scenario, const People& people, BehaviorBuilder& behavior) {
  if (!people.spots.empty()) {
    std::vector<Node> spots;
    for (const Vector2d& spot : people.spots) {
      spots.push_back(describe::circle_goal(static_cast<int>(spots.size()), spot, 0.6, 2));
    }
    behavior.comment("Destinations of strollers.").add_goal_set(kSpotsSet, std::move(spots));
  }
  std::vector<Node> away;
  std::vector<Node> leaving;
  std::vector<Node> fleeing;
  const std::vector<BlockedDisc> discs = blocked_discs(people);
  for (std::size_t i = 0; i < scenario.exits.size(); ++i) {
    const Exit& exit = scenario.exits[i];
    away.push_back(describe::circle_goal(static_cast<int>(i), beyond(exit, scenario.inside), 2, 2));
    if (is_destination(exit, scenario.exits)) leaving.push_back(door_goal(exit, i));
    if (can_flee_by(first_to_reach(exit, discs))) fleeing.push_back(door_goal(exit, i));
  }
  behavior.comment("Destinations outside of the scenario.").add_goal_set(kAwaySet, std::move(away));
  // If people only flee, their own goal set is enough.
  if (people.dangers.empty() || anybody_leaves(people)) {
    behavior.comment("Just beyond the doors.").add_goal_set(kLeavingSet, std::move(leaving));
  }
  if (people.dangers.empty()) return;
  behavior.comment("The doors that no disaster closes.")
      .add_goal_set(kFleeingSet, std::move(fleeing));
  std::vector<Node> guides;
  for (std::size_t i = 0; i < std::max<std::size_t>(1, scenario.drones.size()); ++i) {
    const Vector2d far_away(90'000 + 20 * static_cast<double>(i), 90'000);
    guides.push_back(describe::circle_goal(static_cast<int>(i), far_away, 1, 0));
  }
  behavior.comment("Guides, one per drone; far away until something moves them.")
      .add_goal_set(kGuidesSet, std::move(guides));
}

/// Walking around obstacles. The cells are coarser than by default, which serves narrower gaps than
/// blueprints have.
Node walk() { return describe::velocity("auto", {{"cell_size", "0.12"}}); }

/// How those who stay somewhere move: they may be pushed.
Node stay() { return describe::velocity("goal"); }
Node lie() { return describe::velocity("zero"); }

/// People's behavior without a disaster.
class Everyday {
 public:
  Everyday(const Scenario& scenario, const People& people) : scenario_(&scenario) {
    for (const Group& group : people.groups) doing_.insert(group.doing);
    if (!people.lines.empty()) doing_.insert(Doing::wait);
    for (const Source& source : people.sources) {
      if (source.towards) {
        towards_.insert(*source.towards);
      } else {
        doing_.insert(source.doing);
      }
    }
    final_wait_ = people.dangers.empty();
  }

  /// Names of states that a disaster can interrupt, separated by commas.
  std::string names() const {
    std::vector<std::string> names;
    for (const Doing doing : doing_) names.push_back(state_name(doing));
    if (doing_.contains(Doing::stroll)) names.emplace_back("Pause");
    for (const std::size_t exit : towards_) names.push_back(state_towards(scenario_->exits[exit]));
    return fmt::format("{}", fmt::join(names, ","));
  }

  void add_states(BehaviorBuilder& behavior) const {
    if (doing_.contains(Doing::stroll)) {
      behavior.add_state("Stroll", {describe::select_goal("random", kSpotsSet), walk()});
      behavior.add_state("Pause", {describe::select_own_place(), stay()});
    }
    for (const Doing doing : {Doing::wait, Doing::watch}) {
      if (!doing_.contains(doing)) continue;
      const std::vector<Node> waiting = {describe::select_own_place(), stay()};
      if (final_wait_) {
        behavior.add_final_state(state_name(doing), waiting);
      } else {
        behavior.add_state(state_name(doing), waiting);
      }
    }
    if (doing_.contains(Doing::cross)) {
      behavior.add_state("Cross", {describe::select_goal("weighted", kLeavingSet), walk()});
    }
    if (doing_.contains(Doing::leave)) {
      behavior.add_state(
          "Leave", {describe::select_goal("exit_choice", kLeavingSet, {{"sight", 40}}), walk()});
    }
    for (const std::size_t exit : towards_) {
      behavior.add_state(state_towards(scenario_->exits[exit]),
                         {describe::select_goal(kLeavingSet, static_cast<int>(exit)), walk()});
    }
  }

  void add_transitions(BehaviorBuilder& behavior) const {
    if (doing_.contains(Doing::stroll)) {
      behavior.add_transition(
          "Stroll", "Pause",
          describe::condition(
              "or", {},
              {describe::goal_reached(0.3), describe::timer(describe::Sampled::uniform(40, 70))}));
      behavior.add_transition("Pause", "Stroll",
                              describe::timer(describe::Sampled::uniform(4, 25)));
    }
    const std::string leavers = names_of_leavers();
    if (!leavers.empty()) behavior.add_transition(leavers, "Away", describe::goal_reached(0.2));
  }

  bool anybody_leaves() const { return !names_of_leavers().empty(); }

 private:
  std::string names_of_leavers() const {
    std::vector<std::string> names;
    for (const Doing doing : {Doing::cross, Doing::leave}) {
      if (doing_.contains(doing)) names.push_back(state_name(doing));
    }
    for (const std::size_t exit : towards_) names.push_back(state_towards(scenario_->exits[exit]));
    return fmt::format("{}", fmt::join(names, ","));
  }

  const Scenario* scenario_;
  std::set<Doing> doing_;
  std::set<std::size_t> towards_;
  bool final_wait_;
};

constexpr const char* kHurtState = "Casualty";  // one whose people are rendered lying

bool hurts_anybody(const People& people) {
  return std::any_of(people.dangers.begin(), people.dangers.end(),
                     [](const Danger& danger) { return danger.hurts_m > 0; });
}

/// Actions of those who flee, for what disasters take as they grow.
std::vector<Node> late_obstacles(const People& people) {
  std::vector<Node> actions;
  for (const BlockedDisc& disc : blocked_discs(people)) {
    if (disc.obstacle_class == kFirstClass) continue;
    actions.push_back(describe::action(
        "add_obstacle_at",
        {{"operand", disc.obstacle_class}, {"time", decimals_text(disc.from_s, 2)}}));
  }
  return actions;
}

/// How what hurts spreads and when it ceases, as attributes of the condition that somebody is so
/// near: an explosion after an instant, what comes down when it has; fire and gas stay, and an
/// attacker goes on.
std::vector<Attribute> spread_attributes(const Danger& danger, double from_edge_m) {
  constexpr double kInstantS = 0.3;
  const world::Disaster& seen = danger.seen;
  const double grows_m =
      seen.growth_mps > 0 ? std::max(seen.max_radius_m - seen.radius_m, 0.0) : 0.0;
  const double spreads_s = grows_m > 0 ? grows_m / seen.growth_mps : 0.0;
  std::vector<Attribute> spread;
  switch (seen.kind) {
    case world::DisasterKind::attacker:
      return spread;
    case world::DisasterKind::explosion:
      return {{"end", significant_text(seen.start_s + kInstantS, 6)}};
    case world::DisasterKind::collapse:
      if (grows_m > 0) spread = {{"growth_rate", significant_text(seen.growth_mps, 4)}};
      spread.emplace_back("end", significant_text(seen.start_s + kInstantS + spreads_s, 6));
      return spread;
    case world::DisasterKind::fire:
    case world::DisasterKind::gas:
      break;
  }
  if (grows_m > 0) {
    spread = {{"growth_rate", significant_text(seen.growth_mps, 4)},
              {"max_distance", significant_text(from_edge_m + grows_m, 4)}};
  }
  if (danger.hurts_after_s > 0) {
    spread.emplace_back("after", significant_text(danger.hurts_after_s, 4));
  }
  return spread;
}

/// Transitions of people whom a disaster hurts.
void add_hurting_transitions(const std::string& from, const People& people,
                             BehaviorBuilder& behavior) {
  constexpr double kAgentRadiusM = 0.3;  // of the danger's agent; the condition counts from there
  for (const Danger& danger : people.dangers) {
    if (danger.hurts_m <= 0) continue;
    const world::Disaster& seen = danger.seen;
    const double from_edge_m = seen.kind == world::DisasterKind::attacker
                                   ? danger.hurts_m
                                   : std::max(danger.hurts_m - kAgentRadiusM, 0.0);
    Node near = describe::condition("proximity", {{"distance", significant_text(from_edge_m, 4)},
                                                  {"agentToAvoid", seen.agent},
                                                  {"start", significant_text(seen.start_s, 6)}});
    for (const Attribute& attribute : spread_attributes(danger, from_edge_m)) near.set(attribute);
    behavior.add_transition(from, kHurtState, std::move(near));
  }
}

bool any_attacker(const People& people) {
  return std::any_of(people.dangers.begin(), people.dangers.end(), [](const Danger& danger) {
    return danger.seen.kind == world::DisasterKind::attacker;
  });
}

bool anything_at_rest(const People& people) {
  return std::any_of(people.dangers.begin(), people.dangers.end(), [](const Danger& danger) {
    return danger.seen.kind != world::DisasterKind::attacker;
  });
}

bool any_panic(const People& people) {
  return std::any_of(people.dangers.begin(), people.dangers.end(),
                     [](const Danger& danger) { return danger.panic; });
}

void add_flight(const People& people, BehaviorBuilder& behavior) {
  const std::vector<Node> grows = late_obstacles(people);
  std::vector<Node> flee = {
      describe::select_goal("exit_choice", kFleeingSet, {{"familiarity", 0.7}, {"sight", 40}}),
      walk()};
  if (people.evacuation_speed_mps) {
    std::vector<Attribute> runs = {{"property", "pref_speed"}};
    for (Attribute& attribute : people.evacuation_speed_mps->attributes()) {
      runs.push_back(std::move(attribute));
    }
    runs.emplace_back("exit_reset", false);
    flee.push_back(describe::action("set_property", std::move(runs)));
  }
  flee.push_back(describe::action("add_obstacle", {{"operand", 2}}));
  flee.insert(flee.end(), grows.begin(), grows.end());
  if (any_panic(people)) flee.push_back(describe::action("panic"));
  behavior.add_state("Flee", std::move(flee));
  std::vector<Node> follow = {describe::select_goal("nearest", kGuidesSet), walk()};
  follow.insert(follow.end(), grows.begin(), grows.end());
  behavior.add_state("Follow", std::move(follow));
}

void add_emergency_states(const People& people, BehaviorBuilder& behavior) {
  behavior.add_state("React", {describe::select_own_place(), stay()});
  add_flight(people, behavior);
  if (hurts_anybody(people)) {
    behavior.add_final_state(kHurtState, {describe::select_own_place(), lie()});
  }
  if (any_attacker(people) && !people.spots.empty()) {
    behavior.add_state("Attack", {describe::select_goal("random", kSpotsSet), walk()});
    behavior.add_state("Search", {describe::select_own_place(), stay()});
  } else if (any_attacker(people)) {
    behavior.add_final_state("Attack", {describe::select_goal("random", kFleeingSet), walk()});
  }
  if (anything_at_rest(people)) {
    behavior.add_final_state("Danger", {describe::select_own_place(), lie()});
  }
}

/// That a drone leads somebody who is so near.
Node led(double distance_m) {
  return describe::condition(
      "follow", {{"distance", distance_m}, {"goalSetToFollow", kGuidesSet}, {"weight", 1}});
}

void add_emergency_transitions(const Everyday& everyday, const People& people,
                               BehaviorBuilder& behavior) {
  add_hurting_transitions(everyday.names() + ",React,Flee,Follow", people, behavior);
  for (const Danger& danger : people.dangers) {
    behavior.add_transition(
        everyday.names(), "React",
        describe::condition("proximity",
                            {{"distance", significant_text(danger.noticed_m, 4)},
                             {"agentToAvoid", danger.seen.agent},
                             {"growth_rate", significant_text(danger.notice_growth_mps, 4)},
                             {"start", significant_text(danger.seen.start_s, 6)}}));
  }
  everyday.add_transitions(behavior);
  std::vector<Attribute> delay = {{"per_agent", true}, {"together", true}};
  for (Attribute& attribute : people.pre_movement_s.attributes()) {
    delay.push_back(std::move(attribute));
  }
  behavior.add_transition("React", "Flee", describe::condition("timer", std::move(delay)));
  behavior.add_transition("Flee", "Follow", led(5));
  behavior.add_transition("Flee", "Away", describe::goal_reached(0.2));
  behavior.add_transition(
      "Follow", "Away", describe::condition("via", {{"distance", 0.3}, {"goalsVia", kFleeingSet}}));
  behavior.add_transition("Follow", "Flee", describe::condition("not", {}, {led(20)}));
  if (any_attacker(people) && !people.spots.empty()) {
    behavior.add_transition("Attack", "Search", describe::goal_reached(0.5));
    behavior.add_transition("Search", "Attack", describe::timer(describe::Sampled::uniform(1, 3)));
  }
}

}  // namespace

std::string state_name(Doing doing) {
  switch (doing) {
    case Doing::wait:
      return "Wait";
    case Doing::watch:
      return std::string(world::kWatchState);
    case Doing::cross:
      return "Cross";
    case Doing::leave:
      return "Leave";
    case Doing::stroll:
      break;
  }
  return "Stroll";
}

std::string state_towards(const Exit& exit) { return "To_" + exit.id; }

crowd::BehaviorDescription describe_behavior(const Scenario& scenario, const People& people,
                                             const std::vector<ClosingDoor>& doors) {
  const Everyday everyday(scenario, people);
  const bool emergency = !people.dangers.empty();
  const bool leaving = emergency || everyday.anybody_leaves();
  BehaviorBuilder behavior;
  add_goals(scenario, people, behavior);
  everyday.add_states(behavior);
  if (emergency) add_emergency_states(people, behavior);
  if (leaving) {
    behavior.add_state("Away", {describe::select_goal("nearest", kAwaySet), walk()});
    behavior.add_final_state("Out",
                             {describe::select_own_place(), lie(), describe::action("leave")});
  }
  if (emergency) {
    add_emergency_transitions(everyday, people, behavior);
  } else {
    everyday.add_transitions(behavior);
  }
  if (leaving) behavior.add_transition("Away", "Out", describe::goal_reached(1));
  for (const ClosingDoor& door : doors) behavior.add(closing_element(door));
  if (any_panic(people)) {
    behavior.add(
        Node("Panic", {{"radius", 3}, {"rate", 0.1}, {"recovery", 0.02}, {"speed_factor", 1.2}}));
  }
  return behavior.build();
}

}  // namespace throng::scenarios
