// Warnings about a run's figures before it: by its place, and by its first seconds.
#pragma once

#include <cstdint>
#include <vector>

#include "base/error.h"
#include "spec/job/spec.h"
#include "world/scenario.h"

namespace throng::jobs {

/// Findings of scenarios::check_figures() about a job's scenario, as warnings about the job.
std::vector<Problem> figure_warnings(const world::Scenario& scenario);

/// A run's warnings with those of its scenario behind them.
std::vector<Problem> with_figure_warnings(std::vector<Problem> warnings,
                                          const world::Scenario& scenario);

/// Simulates a run of a job in its scenario until somebody notices the alarm, and returns what a
/// run says that ends without (sim/people/people_watch.h). It takes a second at most: a crowd that
/// is too large for that, or notices later, is taken to notice.
std::vector<Problem> rehearse(const JobSpec& job, const world::Scenario& scenario, int run,
                              std::int64_t people);

}  // namespace throng::jobs
