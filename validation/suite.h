// The validation suite: tests of RiMEA, of NIST TN 1822, and of flows, for all pedestrian models.
#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "validation/scene.h"

namespace throng::validation {

/// Amount of computation: `reduced` has fewer people and runs and takes seconds.
enum class Effort { reduced, full };

/// The result of a test.
struct Verdict {
  bool passed = false;
  /// measured values as text
  std::string measured;
};

/// A test of pedestrian models.
struct Test {
  std::string id;         ///< name on the command line, e.g. "rimea_1"
  std::string title;      ///< e.g. "RiMEA 1"
  std::string set_up;     ///< description of the simulation
  std::string criterion;  ///< description of the criterion
  std::function<Verdict(const Tested&, Effort)> run;
  bool demanded =
      true;  ///< false: the source demands a report only, and the criterion shown is throng's
};

std::vector<Test> rimea_tests();
std::vector<Test> rimea_bottleneck_tests();
std::vector<Test> nist_tests();
std::vector<Test> flow_tests();
std::vector<Test> walking_tests();

/// Returns all tests in the order of the report.
std::vector<Test> all_tests();

/// Returns these models (empty: all but `dummy`, the default one first; with other constants than
/// those of the best fit the default one alone). Throws InputError for an unknown model, or one
/// without such constants.
std::vector<Tested> chosen_models(const std::vector<std::string>& names,
                                  crowd::ConstantsChoice choice = crowd::ConstantsChoice::best);

/// Results of run_suite().
struct Results {
  Effort effort = Effort::full;
  std::vector<std::string> models;  ///< titles
  std::vector<Test> tests;
  std::vector<std::vector<Verdict>> verdicts;  ///< indexed by test, then by model
};

/// Called with the number of finished pairs of test and model and their total; one call at a time.
using SuiteProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Runs the tests with these ids (empty: all) for these models on `threads` threads, on which
/// results do not depend. Throws InputError for an unknown test, Cancelled when `stop` is
/// requested.
Results run_suite(const std::vector<Tested>& models, const std::vector<std::string>& tests,
                  Effort effort, int threads, const SuiteProgress& progress = {},
                  const std::stop_token& stop = {});

/// Returns the Markdown text of docs/validation.md.
std::string markdown(const Results& results);

}  // namespace throng::validation
