// The runs of a study, their order, and the files in its folder, as workers and the service use
// them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace throng::study {

/// The document that a client sent to the service, and the plan made from it
/// (jobs/study/service_work.h).
inline constexpr const char* kDocumentName = "study.json";
inline constexpr const char* kPlanName = "plan.json";
/// The version of the program that computed the results.
inline constexpr const char* kGeneratorName = "generator";
/// Results; the last file is written after all others.
inline constexpr const char* kReportName = "report.html";
inline constexpr const char* kMarkdownName = "summary.md";
inline constexpr const char* kCsvName = "summary.csv";
inline constexpr const char* kSummaryName = "summary.json";
/// The measures of each run and their summary, written once the first pair of runs is complete.
inline constexpr const char* kValuesName = "values.json";
inline constexpr const char* kSummarySoFarName = "summary_so_far.json";

/// One run of a study: the indices of its case and policy, and the number of its pair (runs with
/// the same number are compared).
struct StudyRun {
  std::size_t one_case = 0;
  std::size_t policy = 0;
  int run = 0;
};

/// The number of runs of a study: cases times policies times pairs.
struct StudySize {
  std::size_t cases = 0;
  std::size_t policies = 0;
  int runs = 0;

  std::size_t count() const { return cases * policies * static_cast<std::size_t>(runs); }
  /// The run with this number, in [0, count()). Runs are ordered by pair, so that an interrupted
  /// study has complete pairs.
  StudyRun at(std::size_t number) const;
};

/// Path of the result of a run, relative to the study's folder: runs/CASE/POLICY/000.json.
std::filesystem::path result_file(const std::string& case_id, const std::string& policy_id,
                                  int run);

}  // namespace throng::study
