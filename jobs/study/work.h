// Runs a study's simulations, each of which leaves a file, and gathers what they came to.
#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>
#include <vector>

#include "jobs/study/outcome.h"
#include "jobs/study/study.h"
#include "spec/study/study_files.h"

namespace throng::study {

/// [case][policy][run].
using Outcomes = std::vector<std::vector<std::vector<Outcome>>>;

using StudyProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Runs what has no result in `folder` yet (runs/CASE/POLICY/000.json, made under the same
/// fingerprint), at most `threads` at once (0: one per core); kill it at any time and call it
/// again. Results do not depend on `threads`. `progress` is called from one thread at a time.
/// Throws Cancelled when `stop` asks, after the runs at work have ended early.
Outcomes do_runs(const Study& study, const std::filesystem::path& folder, int threads,
                 const StudyProgress& progress = {}, const std::stop_token& stop = {});

/// Does one run likewise; of the study only its cell needs to have been read.
void do_run(const Study& study, const std::filesystem::path& folder, const StudyRun& run,
            const std::stop_token& stop = {});

/// Results that lie in `folder`, under whatever fingerprint, in the order of their numbers. Of a
/// case only those that every policy has.
struct KnownRuns {
  Outcomes outcomes;
  std::vector<std::vector<int>> numbers;  ///< per case
};
KnownRuns known_runs(const Study& study, const std::filesystem::path& folder);

}  // namespace throng::study
