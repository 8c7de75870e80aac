// Values of each run of a study, from which running means and other statistics can be computed.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "jobs/study/study.h"
#include "jobs/study/work.h"

namespace throng::study {

/// {"baseline": POLICY, "cases": [{"id", "horizons_s": [a, b], "runs": [0, 1, ...],
///   "policies": [{"id", "means_s": [[...], [...]], "t50_s": [...], "t90_s": [...],
///   "t95_s": [...], "not_escaped": [...]}]}]}
/// The lists have one number per run, in the order of "runs". "means_s" has the restricted means up
/// to each horizon. Times are in s from the later of alarm and arrival; null if that share of the
/// people never got out.
nlohmann::json values_json(const Study& study, const KnownRuns& runs);

/// The runs of a complete study.
KnownRuns all_runs(const Outcomes& outcomes);

}  // namespace throng::study
