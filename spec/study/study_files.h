// A study's runs, their order, and the files of its folder: what workers and the service agree on.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace throng::study {

/// The document that was sent to the service, and its plan (jobs/study/service_work.h).
inline constexpr const char* kDocumentName = "study.json";
inline constexpr const char* kPlanName = "plan.json";
/// The program that the results are of.
inline constexpr const char* kGeneratorName = "generator";
/// Results: the last one is there once all others are.
inline constexpr const char* kReportName = "report.html";
inline constexpr const char* kMarkdownName = "summary.md";
inline constexpr const char* kCsvName = "summary.csv";
inline constexpr const char* kSummaryName = "summary.json";
/// The figures of each run, from the first whole pair of runs on; the summary of these.
inline constexpr const char* kValuesName = "values.json";
inline constexpr const char* kSummarySoFarName = "summary_so_far.json";

/// One run of a study: indices of its case and policy, and the number of its pair.
struct StudyRun {
  std::size_t one_case = 0;
  std::size_t policy = 0;
  int run = 0;
};

/// How many runs there are: cases times policies times pairs.
struct StudySize {
  std::size_t cases = 0;
  std::size_t policies = 0;
  int runs = 0;

  std::size_t count() const { return cases * policies * static_cast<std::size_t>(runs); }
  /// Pair by pair, so that an interrupted study has whole ones. `number` is below count().
  StudyRun at(std::size_t number) const;
};

/// The result of a run, relative to the study's folder: runs/CASE/POLICY/000.json
std::filesystem::path result_file(const std::string& case_id, const std::string& policy_id,
                                  int run);

}  // namespace throng::study
