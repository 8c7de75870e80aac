#include "validation/suite.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <mutex>

#include "base/compute/run_items.h"
#include "base/error.h"
#include "crowd/state/model.h"

namespace throng::validation {

namespace {

/// Runs pairs of test and model.
class Suite {
 public:
  Suite(const std::vector<Tested>& models, Results& results, const SuiteProgress& progress)
      : models_(models), results_(results), progress_(progress) {}

  void run(int threads, const std::stop_token& stop) {
    const std::size_t models = results_.models.size();
    const std::size_t total = results_.tests.size() * models;
    run_items(total, threads, stop, [&](std::size_t number) {
      const std::size_t test = number / models;
      const std::size_t model = number % models;
      Verdict verdict = results_.tests[test].run(models_[model], results_.effort);
      const std::lock_guard lock(mutex_);
      results_.verdicts[test][model] = std::move(verdict);
      ++done_;
      if (progress_) progress_(done_, total);
    });
  }

 private:
  const std::vector<Tested>& models_;
  Results& results_;
  const SuiteProgress& progress_;
  std::mutex mutex_;
  std::size_t done_ = 0;
};

std::vector<Test> chosen_tests(const std::vector<std::string>& ids) {
  std::vector<Test> all = all_tests();
  if (ids.empty()) return all;
  std::vector<Test> chosen;
  for (const std::string& id : ids) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Test& test) { return test.id == id; });
    if (found == all.end()) {
      std::vector<std::string> known;
      known.reserve(all.size());
      for (const Test& test : all) known.push_back(test.id);
      throw InputError(
          Problem{"", "--tests", id, fmt::format("one of {}", fmt::join(known, ", "))});
    }
    chosen.push_back(*found);
  }
  return chosen;
}

}  // namespace

std::vector<Tested> chosen_models(const std::vector<std::string>& names,
                                  crowd::ConstantsChoice choice) {
  std::vector<Tested> chosen;
  const auto add = [&](const crowd::ModelEntry& entry) {
    crowd::chosen_constants(entry, choice, 1);  // throws if there are none
    Tested& tested = chosen.emplace_back();
    tested.model = entry.name;
    tested.choice = choice;
  };
  for (const std::string& name : names) add(crowd::find_model(name));
  if (!chosen.empty()) return chosen;
  add(crowd::find_model("ttc"));
  if (choice != crowd::ConstantsChoice::best) return chosen;
  for (const crowd::ModelEntry& entry : crowd::models()) {
    if (entry.name != "ttc" && entry.name != "dummy") add(entry);
  }
  return chosen;
}

std::vector<Test> all_tests() {
  std::vector<Test> all;
  for (auto* part : {flow_tests, rimea_tests, rimea_bottleneck_tests, nist_tests, walking_tests}) {
    std::vector<Test> tests = part();
    std::move(tests.begin(), tests.end(), std::back_inserter(all));
  }
  return all;
}

Results run_suite(const std::vector<Tested>& models, const std::vector<std::string>& tests,
                  Effort effort, int threads, const SuiteProgress& progress,
                  const std::stop_token& stop) {
  Results results{effort, {}, chosen_tests(tests), {}};
  for (const Tested& tested : models) results.models.push_back(title(tested));
  results.verdicts.assign(results.tests.size(), std::vector<Verdict>(results.models.size()));
  Suite(models, results, progress).run(threads, stop);
  return results;
}

std::string markdown(const Results& results) {
  std::string page =
      "# How the pedestrian models do in standard tests\n\n"
      "Printed by `throng validate-crowd`. The model `ttc` is what a job gets that names none "
      "([crowd.md](crowd.md)). **+** passed, **-** failed, **o** reported (the source "
      "sets no criterion, and the test counts for nothing), with what was measured. Tests of RiMEA "
      "and NIST TN 1822 that need stairs, smoke or lifts are left out, since a crowd in a plane "
      "has none, and so is NIST 2.9 (groups), whose result is no figure; criteria are those of "
      "published implementations (JuPedSim, Vadere).\n\n";
  if (results.effort == Effort::reduced) {
    page +=
        "Reduced (`--reduced`): fewer people, densities and runs than the set-ups below say.\n\n";
  }
  page += fmt::format("| test | {} |\n|---|", fmt::join(results.models, " | "));
  for (std::size_t m = 0; m < results.models.size(); ++m) page += "---|";
  page += "\n";
  std::vector<std::size_t> passed(results.models.size(), 0);
  for (std::size_t t = 0; t < results.tests.size(); ++t) {
    page += fmt::format("| {} |", results.tests[t].title);
    for (std::size_t m = 0; m < results.models.size(); ++m) {
      const Verdict& verdict = results.verdicts[t][m];
      const char* sign = !results.tests[t].demanded ? "o" : verdict.passed ? "+" : "-";
      page += fmt::format(" **{}** {} |", sign, verdict.measured);
      passed[m] += results.tests[t].demanded && verdict.passed ? 1 : 0;
    }
    page += "\n";
  }
  page += "| passed |";
  const auto demanded = std::count_if(results.tests.begin(), results.tests.end(),
                                      [](const Test& test) { return test.demanded; });
  for (const std::size_t count : passed) page += fmt::format(" {} of {} |", count, demanded);
  page += "\n\n## The tests\n\n| test | `--tests` | set-up | passed when |\n|---|---|---|---|\n";
  for (const Test& test : results.tests) {
    page +=
        fmt::format("| {} | `{}` | {} | {} |\n", test.title, test.id, test.set_up, test.criterion);
  }
  return page;
}

}  // namespace throng::validation
