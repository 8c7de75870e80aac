// The validation suite: tests of RiMEA and of NIST TN 1822 and our own of flows, for any model.
#pragma once

#include <functional>
#include <stop_token>
#include <string>
#include <vector>

#include "crowd/validation/scene.h"

namespace throng::validation {

/// How much is computed: `reduced` has fewer people and runs, so that it takes seconds.
enum class Effort { reduced, full };

struct Verdict {
  bool passed = false;
  std::string measured;
};

struct Test {
  std::string id;         ///< "rimea_1", for the command line
  std::string title;      ///< "RiMEA 1"
  std::string set_up;     ///< what is simulated
  std::string criterion;  ///< when it passes
  std::function<Verdict(const Tested&, Effort)> run;
  bool demanded =
      true;  ///< false: the source asks for a report and sets no criterion; ours is shown
};

std::vector<Test> rimea_tests();
std::vector<Test> rimea_bottleneck_tests();
std::vector<Test> nist_tests();
std::vector<Test> flow_tests();
std::vector<Test> walking_tests();

/// All of them, in the order of the report.
std::vector<Test> all_tests();

struct Results {
  Effort effort = Effort::full;
  std::vector<std::string> models;
  std::vector<Test> tests;
  std::vector<std::vector<Verdict>> verdicts;  ///< by test and model
};

/// Called with the number of pairs of test and model done and their total.
using SuiteProgress = std::function<void(std::size_t done, std::size_t total)>;

/// Runs the tests of these ids (none given: all) with these models (none given: all but `dummy`),
/// so many at once. Results do not depend on `threads`. Throws InputError for a model or test that
/// there is not, Cancelled when `stop` asks.
Results run_suite(const std::vector<std::string>& models, const std::vector<std::string>& tests,
                  Effort effort, int threads, const SuiteProgress& progress = {},
                  const std::stop_token& stop = {});

/// The page docs/validation.md.
std::string markdown(const Results& results);

}  // namespace throng::validation
