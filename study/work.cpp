#include "study/work.h"

#include <fmt/core.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "base/error.h"
#include "base/files.h"
#include "jobs/pipeline.h"

namespace throng::study {

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

struct Item {
  std::size_t one_case;
  std::size_t policy;
  int run;
};

class Work {
 public:
  Work(const Study& study, const fs::path& folder, const StudyProgress& progress)
      : study_(study), folder_(folder), progress_(progress) {
    // Run by run, so that an interrupted study has whole pairs.
    for (int run = 0; run < study.runs; ++run) {
      for (std::size_t c = 0; c < study.cases.size(); ++c) {
        for (std::size_t p = 0; p < study.policies.size(); ++p) items_.push_back({c, p, run});
      }
    }
    outcomes_.assign(
        study.cases.size(),
        std::vector<std::vector<Outcome>>(
            study.policies.size(), std::vector<Outcome>(static_cast<std::size_t>(study.runs))));
  }

  Outcomes run(int threads, const std::stop_token& stop) {
    std::stop_source failed;
    std::vector<std::jthread> pool;
    pool.reserve(static_cast<std::size_t>(threads));
    for (int t = 0; t < threads; ++t) {
      pool.emplace_back([&] {
        // Runs are the unit of parallel work: within one there is a single thread.
        tbb::task_arena alone(1);
        alone.execute([&] { work(stop, failed); });
      });
    }
    pool.clear();
    if (failure_) std::rethrow_exception(failure_);
    if (stop.stop_requested()) throw Cancelled();
    return std::move(outcomes_);
  }

 private:
  void work(const std::stop_token& stop, std::stop_source& failed) {
    while (!stop.stop_requested() && !failed.stop_requested()) {
      const std::size_t next = next_++;
      if (next >= items_.size()) return;
      const Item& item = items_[next];
      try {
        Outcome outcome = result_of(item, stop);
        const std::lock_guard lock(mutex_);
        outcomes_[item.one_case][item.policy][static_cast<std::size_t>(item.run)] =
            std::move(outcome);
        ++done_;
        if (progress_) progress_(done_, items_.size());
      } catch (const Cancelled&) {
        return;
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!failure_) failure_ = std::current_exception();
        failed.request_stop();
      }
    }
  }

  Outcome result_of(const Item& item, const std::stop_token& stop) const {
    const fs::path file = folder_ / "runs" / study_.cases[item.one_case].id /
                          study_.policies[item.policy].id / fmt::format("{:03d}.json", item.run);
    if (std::optional<Outcome> known = known_result(item, file)) return std::move(*known);
    const Outcome outcome = simulate(item, stop);
    const json value = {{"fingerprint", fingerprint(item)}, {"outcome", to_json(outcome)}};
    write_file_atomically(file, value.dump() + "\n");
    return outcome;
  }

  const std::string& fingerprint(const Item& item) const {
    return study_.fingerprints[item.one_case][item.policy];
  }

  // A result of another version of the study, or one that is damaged, is none.
  std::optional<Outcome> known_result(const Item& item, const fs::path& file) const {
    if (!fs::exists(file)) return {};
    const json value = json::parse(read_file(file), nullptr, false);
    if (!value.is_object() || value.value("fingerprint", "") != fingerprint(item)) return {};
    try {
      return outcome_from(value.at("outcome"));
    } catch (const json::exception&) {
      return {};
    }
  }

  Outcome simulate(const Item& item, const std::stop_token& stop) const {
    const Case& one = study_.cases[item.one_case];
    const sim::RunSpec spec = jobs::run_spec(study_.jobs[item.one_case][item.policy], item.run);
    OutcomeObserver observer(one.scenario, one.duration_s, one.alarm_s, one.bound);
    sim::simulate(one.scenario, spec, observer, {}, stop);
    return observer.take();
  }

  const Study& study_;
  const fs::path& folder_;
  const StudyProgress& progress_;
  std::vector<Item> items_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::size_t done_ = 0;
  Outcomes outcomes_;
  std::exception_ptr failure_;
};

}  // namespace

Outcomes do_runs(const Study& study, const fs::path& folder, int threads,
                 const StudyProgress& progress, const std::stop_token& stop) {
  if (threads <= 0) threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  return Work(study, folder, progress).run(threads, stop);
}

}  // namespace throng::study
