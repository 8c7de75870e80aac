// How a run ended for each of its people: everybody is counted once.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "metrics/basis/people.h"

namespace throng::metrics {

struct PeopleCounts {
  struct ByExit {
    std::string exit_id;
    int people = 0;
  };

  int people = 0;               ///< everybody who was present at any time
  std::vector<ByExit> left_by;  ///< per exit of the scenario: who escaped through it
  int turned_back = 0;          ///< of these, who had arrived outside of the exits, and not come in
  int left_by_no_exit = 0;      ///< escaped where there is no exit
  int inside = 0;               ///< unhurt, at the end
  int casualties = 0;           ///< hurt, inside at the end
  int vanished_inside = 0;      ///< were no longer present, without having passed an exit
  int never_inside = 0;         ///< were present outside of Scenario::inside only

  int left() const;  ///< by exits or otherwise
};

/// How the run ended for somebody: "left", "inside", "casualty", "vanished" or "never_inside".
const char* outcome_name(const PersonRecord& person);

/// Fails a check unless the sum is the number of all people.
PeopleCounts count_people(const std::vector<PersonRecord>& people,
                          const std::vector<world::Exit>& exits);

/// A sentence for each count that a user hardly wants: people who left by no exit, vanished, or
/// were never inside. Empty where there is nothing to say.
std::vector<std::string> count_warnings(const PeopleCounts& counts);

nlohmann::json to_json(const PeopleCounts& counts);
/// Throws nlohmann::json::exception for anything that to_json() does not write.
PeopleCounts people_counts_from(const nlohmann::json& value);

}  // namespace throng::metrics
