// Report of a study: the results of each policy in each case, compared with the baseline.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "jobs/study/summary.h"

namespace throng::study {

/// The content of summary.json.
nlohmann::json summary_json(const Study& study, const Outcomes& outcomes);

/// Writes summary.csv, summary.json, summary.md, values.json (jobs/study/values.h) and report.html
/// (tables and charts of each case) into the folder. Equal outcomes give equal bytes. Throws
/// EnvironmentError.
void write_report(const Study& study, const Outcomes& outcomes,
                  const std::filesystem::path& folder);

}  // namespace throng::study
