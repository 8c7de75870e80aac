#include "places/behavior_file.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "places/blocked.h"
#include "places/crowd_files.h"

namespace throng::places {

using Eigen::Vector2d;
using world::Exit;
using world::Scenario;

namespace {

constexpr int kSpotsSet = 0;
constexpr int kAwaySet = 1;

/// A region just beyond a door, as wide as the door but for its jambs.
std::string door_goal(const Exit& exit, std::size_t id) {
  constexpr double kBehindM = 0.3;
  constexpr double kDeepM = 1;
  const double jamb_m = std::min(0.3, 0.2 * exit.width_m());
  Vector2d from = exit.from;
  Vector2d along = (exit.to - exit.from).normalized();
  // The box's second axis, to the left of the first, leads out.
  if (Vector2d(-along.y(), along.x()).dot(exit.outward) < 0) {
    from = exit.to;
    along = -along;
  }
  const Vector2d pivot = from + jamb_m * along + kBehindM * exit.outward;
  return fmt::format(
      "    <Goal id=\"{}\" type=\"OBB\" x=\"{:.3f}\" y=\"{:.3f}\" width=\"{:.3f}\" "
      "height=\"{:.3f}\" angle=\"{:.3f}\" weight=\"{:.3g}\"/>\n",
      id, pivot.x(), pivot.y(), exit.width_m() - 2 * jamb_m, kDeepM,
      std::atan2(along.y(), along.x()) * 180 / std::numbers::pi, exit.width_m());
}

/// Straight out of a door, where one has left the place.
Vector2d beyond(const Exit& exit, const world::Rectangle& inside) {
  constexpr double kStepM = 0.5;
  constexpr double kFartherM = 4;
  Vector2d at = exit.middle();
  while (inside.contains(at)) at += kStepM * exit.outward;
  return at + kFartherM * exit.outward;
}

std::string goals_of(const Scenario& scenario, const People& people) {
  std::string text;
  if (!people.spots.empty()) {
    text += fmt::format("  <!-- Places to stroll to. -->\n  <GoalSet id=\"{}\">\n", kSpotsSet);
    for (std::size_t i = 0; i < people.spots.size(); ++i) {
      text += fmt::format(
          "    <Goal id=\"{}\" type=\"circle\" x=\"{:.2f}\" y=\"{:.2f}\" "
          "radius=\"0.6\"/>\n",
          i, people.spots[i].x(), people.spots[i].y());
    }
    text += "  </GoalSet>\n";
  }
  std::string away;
  std::string leaving;
  std::string fleeing;
  const std::vector<BlockedDisc> discs = blocked_discs(people);
  for (std::size_t i = 0; i < scenario.exits.size(); ++i) {
    const Vector2d place = beyond(scenario.exits[i], scenario.inside);
    away += fmt::format(
        "    <Goal id=\"{}\" type=\"circle\" x=\"{:.2f}\" y=\"{:.2f}\" "
        "radius=\"2\"/>\n",
        i, place.x(), place.y());
    leaving += door_goal(scenario.exits[i], i);
    if (can_flee_by(first_to_reach(scenario.exits[i], discs))) {
      fleeing += door_goal(scenario.exits[i], i);
    }
  }
  const auto add = [&](const char* comment, int id, const std::string& goals) {
    text +=
        fmt::format("  <!-- {} -->\n  <GoalSet id=\"{}\">\n{}  </GoalSet>\n", comment, id, goals);
  };
  add("Where one has left the place.", kAwaySet, away);
  add("Just beyond the doors.", kLeavingSet, leaving);
  if (people.dangers.empty()) return text;
  add("The doors that the disasters leave.", kFleeingSet, fleeing);
  std::string guides;
  for (std::size_t i = 0; i < std::max<std::size_t>(1, scenario.drones.size()); ++i) {
    guides += fmt::format(
        "    <Goal id=\"{}\" type=\"circle\" x=\"{}\" y=\"90000\" "
        "radius=\"1\"/>\n",
        i, 90'000 + 20 * i);
  }
  add("What leads people out, one per drone; far away until something moves it.", kGuidesSet,
      guides);
  return text;
}

std::string state(const std::string& name, const std::string& selector, const std::string& velocity,
                  bool final = false, const std::string& actions = "") {
  // Coarser than its default, which is meant for gaps narrower than those of places.
  const char* cells = velocity == "auto" ? " cell_size=\"0.12\"" : "";
  return fmt::format(
      "  <State name=\"{}\" final=\"{}\">\n    <GoalSelector {}/>\n    <VelComponent "
      "type=\"{}\"{}/>\n{}  </State>\n",
      name, final ? 1 : 0, selector, velocity, cells, actions);
}

std::string transition(const std::string& from, const std::string& to,
                       const std::string& condition) {
  return fmt::format("  <Transition from=\"{}\" to=\"{}\">\n    {}\n  </Transition>\n", from, to,
                     condition);
}

std::string set_selector(const char* type, int set, const char* more = "") {
  return fmt::format("type=\"{}\" goal_set=\"{}\"{}", type, set, more);
}

/// What people do when nothing happens.
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

  /// Those that a disaster can interrupt, separated by commas.
  std::string names() const {
    std::vector<std::string> names;
    for (const Doing doing : doing_) names.push_back(state_of(doing));
    if (doing_.contains(Doing::stroll)) names.emplace_back("Pause");
    for (const std::size_t exit : towards_) names.push_back(state_towards(scenario_->exits[exit]));
    return fmt::format("{}", fmt::join(names, ","));
  }

  std::string states() const {
    std::string text;
    if (doing_.contains(Doing::stroll)) {
      text += state("Stroll", set_selector("random", kSpotsSet), "auto");
      text += state("Pause", "type=\"identity\"", "goal");
    }
    if (doing_.contains(Doing::wait)) {
      text += state("Wait", "type=\"identity\"", "goal", final_wait_);
    }
    if (doing_.contains(Doing::cross)) {
      text += state("Cross", set_selector("weighted", kLeavingSet), "auto");
    }
    if (doing_.contains(Doing::leave)) {
      text += state("Leave", set_selector("exit_choice", kLeavingSet, " sight=\"40\""), "auto");
    }
    for (const std::size_t exit : towards_) {
      text += state(state_towards(scenario_->exits[exit]),
                    fmt::format("type=\"explicit\" goal_set=\"{}\" goal=\"{}\"", kLeavingSet, exit),
                    "auto");
    }
    return text;
  }

  std::string transitions() const {
    std::string text;
    if (doing_.contains(Doing::stroll)) {
      text += transition("Stroll", "Pause",
                         "<Condition type=\"or\">\n      <Condition type=\"goal_reached\" "
                         "distance=\"0.3\"/>\n      <Condition type=\"timer\" dist=\"u\" "
                         "min=\"40\" max=\"70\" per_agent=\"1\"/>\n    </Condition>");
      text += transition("Pause", "Stroll",
                         "<Condition type=\"timer\" dist=\"u\" min=\"4\" max=\"25\" "
                         "per_agent=\"1\"/>");
    }
    const std::string leavers = names_of_leavers();
    if (!leavers.empty()) {
      text += transition(leavers, "Away", "<Condition type=\"goal_reached\" distance=\"0.2\"/>");
    }
    return text;
  }

  bool anybody_leaves() const { return !names_of_leavers().empty(); }

 private:
  std::string names_of_leavers() const {
    std::vector<std::string> names;
    for (const Doing doing : {Doing::cross, Doing::leave}) {
      if (doing_.contains(doing)) names.push_back(state_of(doing));
    }
    for (const std::size_t exit : towards_) names.push_back(state_towards(scenario_->exits[exit]));
    return fmt::format("{}", fmt::join(names, ","));
  }

  const Scenario* scenario_;
  std::set<Doing> doing_;
  std::set<std::size_t> towards_;
  bool final_wait_;
};

constexpr const char* kHurtState = "Casualty";  // one whose people are drawn lying

bool hurts_anybody(const People& people) {
  return std::any_of(people.dangers.begin(), people.dangers.end(),
                     [](const Danger& danger) { return danger.hurts_m > 0; });
}

/// Actions of those who flee, for what disasters take as they grow.
std::string late_obstacles(const People& people) {
  std::string text;
  for (const BlockedDisc& disc : blocked_discs(people)) {
    if (disc.obstacle_class == kFirstClass) continue;
    text += fmt::format("    <Action type=\"add_obstacle_at\" operand=\"{}\" time=\"{:.2f}\"/>\n",
                        disc.obstacle_class, disc.from_s);
  }
  return text;
}

/// How what hurts spreads and when it ceases, as attributes of the condition that somebody is so
/// near: an explosion after an instant, what comes down when it has; fire and gas stay, and an
/// attacker goes on.
std::string spread_of(const Danger& danger, double from_edge_m) {
  constexpr double kInstantS = 0.3;
  const world::Disaster& seen = danger.seen;
  const double grows_m =
      seen.growth_mps > 0 ? std::max(seen.max_radius_m - seen.radius_m, 0.0) : 0.0;
  const double spreads_s = grows_m > 0 ? grows_m / seen.growth_mps : 0.0;
  std::string text;
  switch (seen.kind) {
    case world::DisasterKind::attacker:
      return text;
    case world::DisasterKind::explosion:
      return fmt::format(" end=\"{:.6g}\"", seen.start_s + kInstantS);
    case world::DisasterKind::collapse:
      if (grows_m > 0) text = fmt::format(" growth_rate=\"{:.4g}\"", seen.growth_mps);
      return text + fmt::format(" end=\"{:.6g}\"", seen.start_s + kInstantS + spreads_s);
    case world::DisasterKind::fire:
    case world::DisasterKind::gas:
      break;
  }
  if (grows_m > 0) {
    text = fmt::format(" growth_rate=\"{:.4g}\" max_distance=\"{:.4g}\"", seen.growth_mps,
                       from_edge_m + grows_m);
  }
  if (danger.hurts_after_s > 0) text += fmt::format(" after=\"{:.4g}\"", danger.hurts_after_s);
  return text;
}

/// Who is caught by what happens.
std::string hurting_transitions(const std::string& from, const People& people) {
  constexpr double kAgentRadiusM = 0.3;  // of who stands for it; the condition counts from there
  std::string text;
  for (const Danger& danger : people.dangers) {
    if (danger.hurts_m <= 0) continue;
    const world::Disaster& seen = danger.seen;
    const double from_edge_m = seen.kind == world::DisasterKind::attacker
                                   ? danger.hurts_m
                                   : std::max(danger.hurts_m - kAgentRadiusM, 0.0);
    text += transition(
        from, kHurtState,
        fmt::format("<Condition type=\"proximity\" distance=\"{:.4g}\" "
                    "agentToAvoid=\"{}\" start=\"{:.6g}\"{}/>",
                    from_edge_m, seen.agent, seen.start_s, spread_of(danger, from_edge_m)));
  }
  return text;
}

std::string emergency_states(const People& people) {
  const bool panic = std::any_of(people.dangers.begin(), people.dangers.end(),
                                 [](const Danger& danger) { return danger.panic; });
  const bool attack = std::any_of(
      people.dangers.begin(), people.dangers.end(),
      [](const Danger& danger) { return danger.seen.kind == world::DisasterKind::attacker; });
  const bool rests = std::any_of(
      people.dangers.begin(), people.dangers.end(),
      [](const Danger& danger) { return danger.seen.kind != world::DisasterKind::attacker; });
  const std::string hurry =
      "    <Action type=\"set_property\" property=\"pref_speed\" dist=\"n\" mean=\"2\" "
      "stddev=\"0.25\" exit_reset=\"0\"/>\n    <Action type=\"add_obstacle\" operand=\"2\"/>\n";
  const std::string grows = late_obstacles(people);
  std::string text = state("React", "type=\"identity\"", "goal");
  text +=
      state("Flee", set_selector("exit_choice", kFleeingSet, " familiarity=\"0.7\" sight=\"40\""),
            "auto", false, hurry + grows + (panic ? "    <Action type=\"panic\"/>\n" : ""));
  text += state("Follow", set_selector("nearest", kGuidesSet), "auto", false, grows);
  if (hurts_anybody(people)) text += state(kHurtState, "type=\"identity\"", "zero", true);
  if (attack && !people.spots.empty()) {
    text += state("Attack", set_selector("random", kSpotsSet), "auto");
    text += state("Search", "type=\"identity\"", "goal");
  } else if (attack) {
    text += state("Attack", set_selector("random", kFleeingSet), "auto", true);
  }
  if (rests) text += state("Danger", "type=\"identity\"", "zero", true);
  return text;
}

std::string emergency_transitions(const Everyday& everyday, const People& people) {
  std::string text = hurting_transitions(everyday.names() + ",React,Flee,Follow", people);
  for (const Danger& danger : people.dangers) {
    text += transition(
        everyday.names(), "React",
        fmt::format("<Condition type=\"proximity\" distance=\"{:.4g}\" agentToAvoid=\"{}\" "
                    "growth_rate=\"{:.4g}\" start=\"{:.6g}\"/>",
                    danger.noticed_m, danger.seen.agent, danger.notice_growth_mps,
                    danger.seen.start_s));
  }
  text += everyday.transitions();
  text += transition("React", "Flee",
                     "<Condition type=\"timer\" per_agent=\"1\" together=\"1\" "
                     "dist=\"lognormal\" log_mean=\"0.7\" log_stddev=\"0.5\" at_most=\"6\"/>");
  text += transition("Flee", "Follow",
                     fmt::format("<Condition type=\"follow\" distance=\"5\" goalSetToFollow=\"{}\" "
                                 "weight=\"1\"/>",
                                 kGuidesSet));
  text += transition("Flee", "Away", "<Condition type=\"goal_reached\" distance=\"0.2\"/>");
  text += transition(
      "Follow", "Away",
      fmt::format("<Condition type=\"via\" distance=\"0.3\" goalsVia=\"{}\"/>", kFleeingSet));
  text += transition("Follow", "Flee",
                     fmt::format("<Condition type=\"not\"><Condition type=\"follow\" "
                                 "distance=\"20\" goalSetToFollow=\"{}\" weight=\"1\"/>"
                                 "</Condition>",
                                 kGuidesSet));
  const bool attack = std::any_of(
      people.dangers.begin(), people.dangers.end(),
      [](const Danger& danger) { return danger.seen.kind == world::DisasterKind::attacker; });
  if (attack && !people.spots.empty()) {
    text += transition("Attack", "Search", "<Condition type=\"goal_reached\" distance=\"0.5\"/>");
    text += transition("Search", "Attack",
                       "<Condition type=\"timer\" dist=\"u\" min=\"1\" max=\"3\" "
                       "per_agent=\"1\"/>");
  }
  return text;
}

}  // namespace

std::string state_of(Doing doing) {
  switch (doing) {
    case Doing::wait:
      return "Wait";
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

std::string behavior_text(const Scenario& scenario, const People& people) {
  const Everyday everyday(scenario, people);
  const bool emergency = !people.dangers.empty();
  std::string text = "<?xml version=\"1.0\"?>\n<BFSM>\n" + goals_of(scenario, people);
  text += everyday.states();
  if (emergency) text += emergency_states(people);
  if (emergency || everyday.anybody_leaves()) {
    text += state("Away", set_selector("nearest", kAwaySet), "auto");
    text +=
        "  <State name=\"Out\" final=\"1\">\n    <GoalSelector type=\"identity\"/>\n"
        "    <VelComponent type=\"zero\"/>\n    <Action type=\"leave\"/>\n  </State>\n";
  }
  text += emergency ? emergency_transitions(everyday, people) : everyday.transitions();
  if (emergency || everyday.anybody_leaves()) {
    text += transition("Away", "Out", "<Condition type=\"goal_reached\" distance=\"1\"/>");
  }
  const bool panic = std::any_of(people.dangers.begin(), people.dangers.end(),
                                 [](const Danger& danger) { return danger.panic; });
  if (panic) {
    text += "  <Panic radius=\"3\" rate=\"0.1\" recovery=\"0.02\" speed_factor=\"1.2\"/>\n";
  }
  return text + "</BFSM>\n";
}

}  // namespace throng::places
