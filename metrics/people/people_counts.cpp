#include "metrics/people/people_counts.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/text/words.h"

namespace throng::metrics {

using nlohmann::json;

int PeopleCounts::left() const {
  int sum = left_by_no_exit;
  for (const ByExit& exit : left_by) sum += exit.people;
  return sum;
}

const char* outcome_name(const PersonRecord& person) {
  if (!person.was_inside) return person.came_to_exit ? "turned_back" : "never_inside";
  if (person.escaped_s) return "left";
  if (person.hurt_s) return "casualty";
  return person.vanished_s ? "vanished" : "inside";
}

PeopleCounts count_people(const std::vector<PersonRecord>& people,
                          const std::vector<world::Exit>& exits) {
  PeopleCounts counts;
  counts.people = static_cast<int>(people.size());
  for (const world::Exit& exit : exits) counts.left_by.push_back({exit.id, 0});
  for (const PersonRecord& person : people) {
    if (!person.was_inside) {
      ++(person.came_to_exit ? counts.turned_back : counts.never_inside);
    } else if (person.escaped_s) {
      ++(person.left_by ? counts.left_by[*person.left_by].people : counts.left_by_no_exit);
    } else if (person.hurt_s) {
      ++counts.casualties;
    } else {
      ++(person.vanished_s ? counts.vanished_inside : counts.inside);
    }
  }
  check(counts.left() + counts.inside + counts.casualties + counts.vanished_inside +
                counts.turned_back + counts.never_inside ==
            counts.people,
        "everybody is counted once");
  return counts;
}

std::vector<std::string> count_warnings(const PeopleCounts& counts) {
  std::vector<std::string> warnings;
  const auto say = [&](int number, const char* text) {
    if (number > 0)
      warnings.push_back(
          fmt::format("{} of {} {}", number, counted(counts.people, "person", "people"), text));
  };
  say(counts.left_by_no_exit,
      "left the place where there is no exit: they are among the escape times, but no exit counts "
      "them (`throng scenario check` finds gaps in the outline)");
  say(counts.vanished_inside,
      "vanished inside the place, where their recording ends or the crowd removes them: they have "
      "not escaped, and count until then");
  say(counts.never_inside,
      "were never inside the place (`inside` of the scenario): no figure of escape counts them");
  return warnings;
}

json to_json(const PeopleCounts& counts) {
  json by_exit = json::array();
  for (const PeopleCounts::ByExit& exit : counts.left_by) {
    by_exit.push_back({{"id", exit.exit_id}, {"people", exit.people}});
  }
  return {{"people", counts.people},
          {"left_by_exit", std::move(by_exit)},
          {"turned_back", counts.turned_back},
          {"left_by_no_exit", counts.left_by_no_exit},
          {"inside", counts.inside},
          {"casualties", counts.casualties},
          {"vanished_inside", counts.vanished_inside},
          {"never_inside", counts.never_inside}};
}

PeopleCounts people_counts_from(const json& value) {
  PeopleCounts counts;
  for (const json& exit : value.at("left_by_exit")) {
    counts.left_by.push_back({exit.at("id").get<std::string>(), exit.at("people").get<int>()});
  }
  value.at("people").get_to(counts.people);
  value.at("turned_back").get_to(counts.turned_back);
  value.at("left_by_no_exit").get_to(counts.left_by_no_exit);
  value.at("inside").get_to(counts.inside);
  value.at("casualties").get_to(counts.casualties);
  value.at("vanished_inside").get_to(counts.vanished_inside);
  value.at("never_inside").get_to(counts.never_inside);
  return counts;
}

}  // namespace throng::metrics
