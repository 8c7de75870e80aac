// Runs the simulations of a study, each of which writes a file, and collects their outcomes.
#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>
#include <vector>

#include "jobs/study/outcome.h"
#include "jobs/study/study.h"
#include "spec/study/study_files.h"

namespace throng::study {

/// Outcomes indexed by [case][policy][run].
using Outcomes = std::vector<std::vector<std::vector<Outcome>>>;

using StudyProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Simulates all runs that have no result in `folder` yet (runs/CASE/POLICY/000.json with the same
/// fingerprint), at most `threads` at once (0: one per core). Safe to repeat after any
/// interruption; results do not depend on `threads`. `progress` is called from one thread at a
/// time. After a request by `stop`, ends the current runs early and throws Cancelled.
Outcomes do_runs(const Study& study, const std::filesystem::path& folder, int threads,
                 const StudyProgress& progress = {}, const std::stop_token& stop = {});

/// Simulates one run in the same way. The study may have been read with `only` this run's cell.
void do_run(const Study& study, const std::filesystem::path& folder, const StudyRun& run,
            const std::stop_token& stop = {});

/// The runs that every policy of a case has, in the order of their numbers.
struct KnownRuns {
  Outcomes outcomes;
  std::vector<std::vector<int>> numbers;  ///< per case
};
/// Reads the results in `folder`, with any fingerprint.
KnownRuns known_runs(const Study& study, const std::filesystem::path& folder);

}  // namespace throng::study
