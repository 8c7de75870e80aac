// Warnings about a run before it is simulated as a whole: from its scenario and from
// its first seconds.
#pragma once

#include <cstdint>
#include <vector>

#include "base/error.h"
#include "jobs/pipeline/checks/checked_scenario.h"
#include "world/scenario.h"

namespace throng::jobs {

/// All findings of scenarios::check() about a job's scenario, as warnings at /scenario that say
/// which of them are errors.
std::vector<Problem> scenario_findings(const world::Scenario& scenario);

/// `warnings` of a run followed by scenario_findings() of its scenario.
std::vector<Problem> with_scenario_findings(std::vector<Problem> warnings,
                                            const world::Scenario& scenario);

/// Simulates the first run in a scenario until a person notices the alarm. If nobody does, returns
/// the warnings of such a run (sim/people/people_watch.h). The effort is limited to about a second;
/// crowds of more `people` and later reactions give no warning. Takes the scenario's people.
std::vector<Problem> rehearse(CheckedScenario& checked, std::int64_t people);

}  // namespace throng::jobs
