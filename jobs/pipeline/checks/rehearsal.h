// Warnings about a run before it is simulated as a whole: from its scenario and from
// its first seconds.
#pragma once

#include <cstdint>
#include <vector>

#include "base/error.h"
#include "spec/job/spec.h"
#include "world/scenario.h"

namespace throng::jobs {

/// All findings of scenarios::check() about a job's scenario, as warnings at /scenario that say
/// which of them are errors.
std::vector<Problem> scenario_findings(const world::Scenario& scenario);

/// `warnings` of a run followed by scenario_findings() of its scenario.
std::vector<Problem> with_scenario_findings(std::vector<Problem> warnings,
                                            const world::Scenario& scenario);

/// Simulates a run of a job in its scenario until a person notices the alarm. If nobody does,
/// returns the warnings of such a run (sim/people/people_watch.h). The effort is limited to about a
/// second; larger crowds and later reactions give no warning.
std::vector<Problem> rehearse(const JobSpec& job, const world::Scenario& scenario, int run,
                              std::int64_t people);

}  // namespace throng::jobs
