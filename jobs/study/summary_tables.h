// Tables of a study's report, as cells of text for Markdown and HTML.
#pragma once

#include <string>
#include <vector>

#include "jobs/study/summary.h"

namespace throng::study {

struct Table {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// The table of one case: one row per policy with medians, quartiles and comparisons.
Table case_table(const Study& study, const std::vector<SummaryRow>& rows, std::size_t one_case);

/// T50, T90 and T95 of all cases and policies with the intervals of their means, and whether the
/// number of runs suffices.
Table interval_table(const Study& study, const std::vector<SummaryRow>& rows);

/// The comparison of all other cases with the baseline case.
Table case_difference_table(const Study& study, const std::vector<CaseDifference>& differences);

/// Meaning of the cells of case_table().
std::string case_explanation(const Study& study);
/// Meaning of the cells of interval_table().
std::string interval_explanation();
/// Meaning of the cells of case_difference_table().
std::string case_difference_explanation(const Study& study);

}  // namespace throng::study
