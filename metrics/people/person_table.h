// A table of the people of a run, by columns.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "metrics/basis/people.h"
#include "metrics/people/journeys.h"
#include "metrics/people/people_counts.h"

namespace throng::metrics {

/// One list per column with one element per person; null for absent values.
nlohmann::json person_table(const std::vector<PersonRecord>& people,
                            const std::vector<Journey>& journeys, const PeopleCounts& counts);

}  // namespace throng::metrics
