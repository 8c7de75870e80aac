// Table of the people of a run, as columns.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "metrics/exit_totals.h"
#include "metrics/journeys.h"
#include "metrics/people.h"

namespace throng::metrics {

/// One list per value with one entry per person; null where there is none.
nlohmann::json person_table(const std::vector<PersonRecord>& people,
                            const std::vector<Journey>& journeys,
                            const std::vector<ExitTotals>& exits);

}  // namespace throng::metrics
