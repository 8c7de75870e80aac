#include "world/fields/disaster_fields.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "world/fields/document_values.h"

namespace throng::world {

using fields::at;
using fields::FieldLocation;
using fields::FieldTable;
using nlohmann::json;

namespace {

constexpr double kMaxReachM = 1000;
constexpr double kMaxTimeS = 1e6;

const FieldTable<Disaster>& listed_fields() {
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
        .with_default(fields::plain_numbers(kMaxReachM))
        .renamed_from("most_m");
    return table;
  }();
  return fields;
}

Disaster begin_disaster() {
  Disaster disaster;
  disaster.max_radius_m = kMaxReachM;
  return disaster;
}

fields::Values disaster_lists() { return object_lists(listed_fields().schema()); }

std::vector<Disaster> read_disasters(const json& list, const FieldLocation& place) {
  std::vector<Disaster> disasters;
  disasters.reserve(list.size());
  for (std::size_t i = 0; i < list.size(); ++i) {
    const FieldLocation item = place.below(i);
    Disaster disaster = begin_disaster();
    listed_fields().read_checked(list[i], disaster, item);
    const bool is_taken =
        std::any_of(disasters.begin(), disasters.end(),
                    [&](const Disaster& other) { return other.agent == disaster.agent; });
    if (is_taken && has_valid(list[i], "agent", item)) {
      item.below("agent").reject(list[i]["agent"].dump(),
                                 "an agent that stands for no other disaster");
    }
    disasters.push_back(disaster);
  }
  return disasters;
}

}  // namespace throng::world
