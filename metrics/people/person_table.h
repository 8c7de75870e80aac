// Table of the people of a run, as columns.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "metrics/basis/people.h"
#include "metrics/people/journeys.h"
#include "metrics/people/people_counts.h"

namespace throng::metrics {

/// One list per value with one entry per person; null where there is none.
nlohmann::json person_table(const std::vector<PersonRecord>& people,
                            const std::vector<Journey>& journeys, const PeopleCounts& counts);

}  // namespace throng::metrics
