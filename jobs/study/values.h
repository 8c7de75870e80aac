// The figures of each run of a study: what running means and other statistics are made of.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "jobs/study/study.h"
#include "jobs/study/work.h"

namespace throng::study {

/// {"baseline": POLICY, "cases": [{"id", "horizons_s": [a, b], "runs": [0, 1, ...],
///   "policies": [{"id", "means_s": [[...], [...]], "t50_s": [...], "t90_s": [...],
///   "t95_s": [...], "not_escaped": [...]}]}]}
/// with one number per run, in the order of "runs": restricted means up to either horizon; times
/// from the later of alarm and arrival (s), null where that share was never out.
nlohmann::json values_json(const Study& study, const KnownRuns& runs);

/// All runs of a study that is complete.
KnownRuns all_runs(const Outcomes& outcomes);

}  // namespace throng::study
