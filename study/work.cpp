#include "study/work.h"

#include <fmt/core.h>

#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.h"
#include "base/files.h"
#include "base/json_text.h"
#include "base/run_items.h"
#include "jobs/pipeline/pipeline.h"

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
    run_items(items_.size(), threads, stop, [&](std::size_t number) {
      const Item& item = items_[number];
      Outcome outcome = result_of(item, stop);
      const std::lock_guard lock(mutex_);
      outcomes_[item.one_case][item.policy][static_cast<std::size_t>(item.run)] =
          std::move(outcome);
      ++done_;
      if (progress_) progress_(done_, items_.size());
    });
    return std::move(outcomes_);
  }

 private:
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
    const json value = parse_json_or_discard(read_file(file));
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
    OutcomeObserver observer(one.scenario, one.alarm, one.reference,
                             sim::model_for(one.scenario, spec.crowd));
    sim::simulate(one.scenario, spec, observer, {}, stop);
    return observer.take();
  }

  const Study& study_;
  const fs::path& folder_;
  const StudyProgress& progress_;
  std::vector<Item> items_;
  std::mutex mutex_;
  std::size_t done_ = 0;
  Outcomes outcomes_;
};

}  // namespace

Outcomes do_runs(const Study& study, const fs::path& folder, int threads,
                 const StudyProgress& progress, const std::stop_token& stop) {
  return Work(study, folder, progress).run(threads, stop);
}

}  // namespace throng::study
