#include "world/fields/disaster_fields.h"

#include <nlohmann/json.hpp>
#include <set>

#include "world/fields/document_values.h"

namespace throng::world {

using fields::at;
using fields::FieldLocation;
using fields::FieldTable;
using nlohmann::json;

namespace {

constexpr double kMaxTimeS = 1e6;

}  // namespace

const FieldTable<Disaster>& disaster_fields() {
  static const FieldTable<Disaster> fields = [] {
    FieldTable<Disaster> table;
    table.add_word("kind", "", kDisasterKinds, at(&Disaster::kind), "Kind of hazard.").required();
    table.add("position", "", "m", points(), at(&Disaster::position), "Position of the hazard.")
        .required();
    table.add("start_s", "", "s", fields::numbers(0, kMaxTimeS), at(&Disaster::start_s),
              "Time at which it starts.");
    table.add("radius_m", "", "m", fields::numbers(0.1, kMaxReachM), at(&Disaster::radius_m),
              "Radius at its start.");
    table.add("growth_mps", "", "m/s", fields::numbers(0, 100), at(&Disaster::growth_mps),
              "Growth of the radius.");
    table
        .add("max_radius_m", "", "m", fields::numbers(0.1, kMaxReachM), at(&Disaster::max_radius_m),
             "Radius beyond which it does not grow.")
        .renamed_from("most_m");
    return table;
  }();
  return fields;
}

const FieldTable<Disaster>& listed_disaster_fields() {
  static const FieldTable<Disaster> fields = [] {
    FieldTable<Disaster> table;
    table
        .add("agent", "", "", fields::integers(0, kMaxId), at(&Disaster::agent),
             "Agent of the crowd that stands for it.")
        .required();
    table.add_all(
        "", disaster_fields(), [](auto& disaster) -> auto& { return disaster; });
    return table;
  }();
  return fields;
}

void check_disaster_agents(Scenario& scenario, const json& list, const FieldLocation& place) {
  std::set<int> agents;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const FieldLocation item = place.below(i);
    if (!has_valid(list[i], "agent", item)) continue;
    if (agents.insert(scenario.disasters[i].agent).second) continue;
    item.below("agent").reject(list[i]["agent"].dump(),
                               "an agent that stands for no other disaster");
  }
}

}  // namespace throng::world
