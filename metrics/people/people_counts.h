// Numbers of people by the outcome of a run; each person is counted once.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "metrics/basis/people.h"

namespace throng::metrics {

/// Numbers of people by outcome.
struct PeopleCounts {
  struct ByExit {
    std::string exit_id;
    int people = 0;
  };

  int people = 0;               ///< all people who were present at any time
  std::vector<ByExit> left_by;  ///< per exit of the scenario: people who escaped through it
  int left_by_no_exit = 0;      ///< escaped, but not through an exit
  int inside = 0;               ///< unhurt, at the end
  int casualties = 0;           ///< casualties inside at the end
  int vanished_inside = 0;      ///< became absent for good without having passed an exit
  int turned_back = 0;          ///< came to an exit and had not entered by the end
  int never_inside = 0;         ///< others who were never in the place

  int left() const;  ///< through exits or otherwise
};

/// The outcome of a person: "left", "inside", "casualty", "vanished", "turned_back" or
/// "never_inside".
const char* outcome_name(const PersonRecord& person);

/// Counts the people by outcome. A check() ensures that the counts add up to the number of people.
PeopleCounts count_people(const std::vector<PersonRecord>& people,
                          const std::vector<world::Exit>& exits);

/// A sentence for each count that suggests a mistake: people who left through no exit, vanished, or
/// were never inside. Empty without such people.
std::vector<std::string> count_warnings(const PeopleCounts& counts);

nlohmann::json to_json(const PeopleCounts& counts);
/// The inverse of to_json(). Throws nlohmann::json::exception for other values.
PeopleCounts people_counts_from(const nlohmann::json& value);

}  // namespace throng::metrics
