#include "validation/suite.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <iterator>
#include <mutex>
#include <thread>

#include "base/error.h"
#include "crowd/model.h"

namespace throng::validation {

namespace {

/// Runs pairs of test and model on several threads, each alone on its own.
class Suite {
 public:
  Suite(Results& results, Effort effort, const SuiteProgress& progress)
      : results_(results), effort_(effort), progress_(progress) {}

  void run(int threads, const std::stop_token& stop) {
    std::stop_source failed;
    {
      std::vector<std::jthread> pool;
      pool.reserve(static_cast<std::size_t>(threads));
      for (int t = 0; t < threads; ++t) {
        pool.emplace_back([&] {
          tbb::task_arena alone(1);
          alone.execute([&] { work(stop, failed); });
        });
      }
    }
    if (failure_) std::rethrow_exception(failure_);
    if (stop.stop_requested()) throw Cancelled();
  }

 private:
  void work(const std::stop_token& stop, std::stop_source& failed) {
    const std::size_t total = results_.tests.size() * results_.models.size();
    while (!stop.stop_requested() && !failed.stop_requested()) {
      const std::size_t next = next_++;
      if (next >= total) return;
      const std::size_t test = next / results_.models.size();
      const std::size_t model = next % results_.models.size();
      try {
        Verdict verdict = results_.tests[test].run({results_.models[model]}, effort_);
        const std::lock_guard lock(mutex_);
        results_.verdicts[test][model] = std::move(verdict);
        ++done_;
        if (progress_) progress_(done_, total);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!failure_) failure_ = std::current_exception();
        failed.request_stop();
      }
    }
  }

  Results& results_;
  Effort effort_;
  const SuiteProgress& progress_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::size_t done_ = 0;
  std::exception_ptr failure_;
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

std::vector<std::string> chosen_models(const std::vector<std::string>& names) {
  std::vector<std::string> chosen;
  chosen.reserve(crowd::models().size());
  for (const std::string& name : names) chosen.emplace_back(crowd::find_model(name).name);
  if (!chosen.empty()) return chosen;
  chosen.emplace_back("weidmann");
  for (const crowd::ModelEntry& entry : crowd::models()) {
    if (entry.name != "weidmann" && entry.name != "dummy") chosen.emplace_back(entry.name);
  }
  return chosen;
}

}  // namespace

std::vector<Test> all_tests() {
  std::vector<Test> all;
  for (auto* part : {flow_tests, rimea_tests, rimea_bottleneck_tests, nist_tests}) {
    std::vector<Test> tests = part();
    std::move(tests.begin(), tests.end(), std::back_inserter(all));
  }
  return all;
}

Results run_suite(const std::vector<std::string>& models, const std::vector<std::string>& tests,
                  Effort effort, int threads, const SuiteProgress& progress,
                  const std::stop_token& stop) {
  Results results{effort, chosen_models(models), chosen_tests(tests), {}};
  results.verdicts.assign(results.tests.size(), std::vector<Verdict>(results.models.size()));
  if (threads <= 0) threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  Suite(results, effort, progress).run(threads, stop);
  return results;
}

std::string markdown(const Results& results) {
  std::string page =
      "# How the pedestrian models do in standard tests\n\n"
      "Printed by `throng validate-crowd`. The model `weidmann` is what a job gets that names none "
      "([crowd.md](crowd.md)). **+** passed, **-** failed, with what was measured. Tests of RiMEA "
      "and NIST TN 1822 that need stairs, smoke, lifts or groups are left out, since a crowd in a "
      "plane has none; criteria are those of published implementations (JuPedSim, Vadere).\n\n";
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
      page += fmt::format(" **{}** {} |", verdict.passed ? "+" : "-", verdict.measured);
      passed[m] += verdict.passed ? 1 : 0;
    }
    page += "\n";
  }
  page += "| passed |";
  for (const std::size_t count : passed)
    page += fmt::format(" {} of {} |", count, results.tests.size());
  page += "\n\n## The tests\n\n| test | `--tests` | set-up | passed when |\n|---|---|---|---|\n";
  for (const Test& test : results.tests) {
    page +=
        fmt::format("| {} | `{}` | {} | {} |\n", test.title, test.id, test.set_up, test.criterion);
  }
  return page;
}

}  // namespace throng::validation
