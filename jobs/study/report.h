// A study's table: what each policy came to in each case, and how it compares with the baseline.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "jobs/study/summary.h"

namespace throng::study {

/// The summary as summary.json holds it.
nlohmann::json summary_json(const Study& study, const Outcomes& outcomes);

/// Writes summary.csv, summary.json, summary.md, values.json (jobs/study/values.h) and report.html,
/// which has the tables and the charts of each case, into the folder. Equal outcomes give equal
/// bytes.
void write_report(const Study& study, const Outcomes& outcomes,
                  const std::filesystem::path& folder);

}  // namespace throng::study
