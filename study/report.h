// A study's table: what each policy came to in each case, and how it compares with the baseline.
#pragma once

#include <filesystem>

#include "study/summary.h"

namespace throng::study {

/// Writes summary.csv, summary.json, summary.md and report.html, which has the tables and the
/// escape curves of each case as charts, into the folder. Equal outcomes give equal bytes.
void write_report(const Study& study, const Outcomes& outcomes,
                  const std::filesystem::path& folder);

}  // namespace throng::study
