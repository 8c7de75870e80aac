#include "places/scenarios/blueprint/people.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "places/scenarios/blueprint/closing_doors.h"
#include "places/scenarios/blueprint/leaving_stands.h"
#include "spec/blueprint/people_fields.h"

namespace throng::scenarios {

namespace {

/// Returns the index of an exit; adds a problem if there is none with this id.
std::optional<std::size_t> find_exit(const std::string& id, const std::vector<world::Exit>& exits,
                                     const fields::FieldLocation& place) {
  if (id.empty()) return std::nullopt;
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < exits.size(); ++i) {
    if (exits[i].id == id) return i;
    ids.push_back(exits[i].id);
  }
  place.reject(fmt::format("\"{}\"", id),
               fmt::format("the id of an exit: {}", fmt::join(ids, ", ")));
  return std::nullopt;
}

/// Finds the exits that a source names.
void find_exits(Source& source, const std::vector<world::Exit>& exits,
                const fields::FieldLocation& place) {
  source.exit = find_exit(source.exit_id, exits, place.below("exit"));
  source.towards = find_exit(source.towards_id, exits, place.below("towards"));
  if (source.towards && !is_destination(exits[*source.towards], exits)) {
    source.towards.reset();
    source.doing = Doing::cross;  // to any other exit
  }
}

}  // namespace

bool anybody_leaves(const People& people) {
  const auto leaves = [](const auto& who) {
    return who.doing == Doing::cross || who.doing == Doing::leave;
  };
  return std::any_of(people.groups.begin(), people.groups.end(), leaves) ||
         std::any_of(people.sources.begin(), people.sources.end(), [&](const Source& source) {
           return source.towards.has_value() || leaves(source);
         });
}

People read_people(const nlohmann::json& blueprint, const world::Scenario& scenario,
                   const fields::FieldLocation& place) {
  People people;
  const fields::FieldLocation people_place = place.below("people");
  people_fields().read_checked(blueprint.at("people"), people, people_place);
  for (std::size_t i = 0; i < people.sources.size(); ++i) {
    find_exits(people.sources[i], scenario.exits, people_place.below("sources").below(i));
  }
  if (blueprint.contains("disasters")) {
    people.dangers = read_dangers(blueprint["disasters"], place.below("disasters"));
  }
  if (people.groups.empty() && people.lines.empty() && people.sources.empty() &&
      !anybody_leaves_stands(scenario)) {
    people_place.reject("nobody", "\"groups\", \"lines\" or \"sources\"");
  }
  return people;
}

}  // namespace throng::scenarios
