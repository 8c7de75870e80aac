#include "world/alarm.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <set>
#include <sstream>

#include "crowd/description/description.h"
#include "world/scenario.h"
#include "world/scenario_crowd.h"
#include "world/trace.h"

namespace throng::world {

namespace {

using crowd::Node;
using Names = std::set<std::string>;

std::string read_text(const Node& element, std::string_view attribute) {
  const std::string* const text = element.find(attribute);
  return text == nullptr ? "" : *text;
}

double read_number(const Node& element, std::string_view attribute) {
  const std::string text = read_text(element, attribute);
  double value = 0;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::vector<std::string> split_words(const std::string& list) {
  std::vector<std::string> words;
  std::istringstream stream(list);
  for (std::string word; std::getline(stream, word, ',');) {
    const std::size_t from = word.find_first_not_of(" \t\r\n");
    if (from == std::string::npos) continue;
    words.push_back(word.substr(from, word.find_last_not_of(" \t\r\n") - from + 1));
  }
  return words;
}

/// The states of a behavior, as far as the alarm needs them.
struct StateGraph {
  struct Edge {
    std::string from;
    std::string to;
  };
  std::vector<Edge> ordinary;
  std::vector<Edge> informing;  ///< transitions by which people get to know of the alarm
  Names informed_by_events;
  std::map<std::string, bool> lying;  ///< what states say of themselves; otherwise their names do

  bool lies_in(const std::string& state) const {
    const auto found = lying.find(state);
    return found != lying.end() ? found->second : implies_lying(state);
  }
  std::optional<double> first_proximity_s;

  Names reached_from(Names states, bool by_telling) const {
    for (bool grows = true; grows;) {
      grows = false;
      const auto follow = [&](const std::vector<Edge>& edges) {
        for (const Edge& edge : edges) {
          if (states.count(edge.from) != 0 && states.insert(edge.to).second) grows = true;
        }
      };
      follow(ordinary);
      if (by_telling) follow(informing);
    }
    return states;
  }
};

// Whether a condition, or any part of it, is about the disaster, panic or a guide. A part that is
// negated (the guide is gone) informs nobody.
bool informs(const Node& element, StateGraph& graph) {
  const std::string type = read_text(element, "type");
  if (element.name == "Condition" && type == "not") return false;
  bool found = false;
  if (element.name == "Condition") {
    if (type == "proximity") {
      const double start_s = read_number(element, "start");
      graph.first_proximity_s = std::min(graph.first_proximity_s.value_or(start_s), start_s);
    }
    found = type == "proximity" || type == "panicked" || type == "follow";
  }
  for (const Node& child : element.children) found = informs(child, graph) || found;
  return found;
}

void gather_targets(const Node& element, Names& targets) {
  for (const Node& child : element.children) {
    if (child.name == "State") targets.insert(read_text(child, "name"));
    gather_targets(child, targets);
  }
}

void read_transition(const Node& element, StateGraph& graph) {
  Names targets;
  for (const std::string& to : split_words(read_text(element, "to"))) targets.insert(to);
  bool informing = false;
  for (const Node& child : element.children) {
    if (child.name == "Condition") informing = informs(child, graph) || informing;
    if (child.name == "Target") gather_targets(child, targets);
  }
  auto& edges = informing ? graph.informing : graph.ordinary;
  for (const std::string& from : split_words(read_text(element, "from"))) {
    for (const std::string& to : targets) edges.push_back({from, to});
  }
}

void read_behavior(const Node& element, StateGraph& graph) {
  for (const Node& child : element.children) {
    if (child.name == "Transition") {
      read_transition(child, graph);
      continue;
    }
    if (const std::string lying = read_text(child, "lying"); !lying.empty()) {
      graph.lying[read_text(child, "name")] = lying != "0" && lying != "false";
    }
    const std::string type = read_text(child, "type");
    if (type == "change_state") graph.informed_by_events.insert(read_text(child, "state"));
    if (child.name == "StateSelector") graph.informed_by_events.insert(read_text(child, "name"));
    read_behavior(child, graph);
  }
}

// Every state that a selector of the scene names.
void gather_initial(const Node& element, bool in_selector, Names& states) {
  for (const Node& child : element.children) {
    const bool selects = in_selector || child.name == "StateSelector";
    if (selects) states.insert(read_text(child, "name"));
    gather_initial(child, selects, states);
  }
}

}  // namespace

Alarm find_alarm(const Scenario& scenario) {
  if (scenario.alarm) return *scenario.alarm;
  Alarm alarm;
  for (const Disaster& disaster : scenario.disasters) {
    alarm.at_s = std::min(alarm.at_s.value_or(disaster.start_s), disaster.start_s);
  }
  if (!scenario.has_crowd()) return alarm;
  const crowd::CrowdDescription crowd = build_crowd(scenario);
  StateGraph graph;
  read_behavior(crowd.behavior.root, graph);
  if (!alarm.at_s && !scenario.disaster_agents.empty()) alarm.at_s = graph.first_proximity_s;
  Names initial;
  gather_initial(crowd.scene.root, false, initial);
  const Names unaware = graph.reached_from(std::move(initial), false);
  Names informed = graph.informed_by_events;
  for (const StateGraph::Edge& edge : graph.informing) informed.insert(edge.to);
  for (const std::string& state : graph.reached_from(std::move(informed), true)) {
    if (unaware.count(state) == 0 && !graph.lies_in(state)) alarm.aware_states.push_back(state);
  }
  return alarm;
}

}  // namespace throng::world
