#include "metrics/people/person_table.h"

#include <nlohmann/json.hpp>

namespace throng::metrics {

using nlohmann::json;

namespace {

json nullable(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }

}  // namespace

json person_table(const std::vector<PersonRecord>& people, const std::vector<Journey>& journeys,
                  const PeopleCounts& counts) {
  json table = json::object();
  for (const char* column :
       {"agent", "arrived_s", "start_s", "noticed_s", "escaped_s", "vanished_s", "turned_back_s",
        "hurt_s", "followed_s", "followed_m", "outcome", "exit", "walked_m", "shortest_to_used_m",
        "shortest_to_nearest_m", "speed_ratio", "stops"}) {
    table[column] = json::array();
  }
  auto journey = journeys.begin();
  for (const PersonRecord& person : people) {
    table["agent"].push_back(person.agent);
    table["arrived_s"].push_back(person.arrived_s);
    table["start_s"].push_back(person.start_s);
    table["noticed_s"].push_back(nullable(person.noticed_s));
    table["escaped_s"].push_back(nullable(person.escaped_s));
    table["vanished_s"].push_back(nullable(person.vanished_s));
    table["turned_back_s"].push_back(nullable(person.turned_back_s));
    table["hurt_s"].push_back(nullable(person.hurt_s));
    table["followed_s"].push_back(person.followed_s);
    table["followed_m"].push_back(person.followed_m);
    const bool went = journey != journeys.end() && journey->agent == person.agent;
    table["outcome"].push_back(outcome_name(person));
    table["exit"].push_back(person.left_by ? json(counts.left_by[*person.left_by].exit_id)
                                           : json(nullptr));
    table["walked_m"].push_back(went ? json(journey->walked_m) : json(nullptr));
    table["shortest_to_used_m"].push_back(went ? nullable(journey->to_used_m) : json(nullptr));
    table["shortest_to_nearest_m"].push_back(went ? nullable(journey->to_nearest_m)
                                                  : json(nullptr));
    table["speed_ratio"].push_back(went ? json(journey->speed_ratio) : json(nullptr));
    table["stops"].push_back(went ? json(journey->stops) : json(nullptr));
    if (went) ++journey;
  }
  return table;
}

}  // namespace throng::metrics
