#include "jobs/study/work.h"

#include <fmt/core.h>

#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/compute/run_items.h"
#include "base/error.h"
#include "base/files/files.h"
#include "base/json/json_text.h"
#include "jobs/pipeline/runs/run_input.h"

namespace throng::study {

using nlohmann::json;
namespace fs = std::filesystem;

namespace {

// One that is damaged is none, nor is one under another fingerprint, unless any is good enough
// ("").
std::optional<Outcome> result_in(const fs::path& file, const std::string& fingerprint) {
  if (!fs::exists(file)) return {};
  const json value = parse_json_or_discard(read_file(file));
  if (!value.is_object()) return {};
  if (!fingerprint.empty() && value.value("fingerprint", "") != fingerprint) return {};
  try {
    return outcome_from(value.at("outcome"));
  } catch (const json::exception&) {
    return {};
  }
}

fs::path run_file(const Study& study, const fs::path& folder, const StudyRun& run) {
  return folder / result_file(study.cases[run.one_case].id, study.policies[run.policy].id, run.run);
}

Outcome simulate(const Study& study, const StudyRun& run, const std::stop_token& stop) {
  const Case& one = study.cases[run.one_case];
  const sim::RunSpec spec = jobs::run_spec(study.jobs[run.one_case][run.policy], run.run);
  OutcomeObserver observer(one.scenario, one.alarm, one.reference,
                           sim::model_for(one.scenario, spec.crowd));
  const std::vector<Problem> warnings = sim::simulate(one.scenario, spec, observer, {}, stop);
  Outcome outcome = observer.take();
  for (const Problem& warning : warnings) outcome.warnings.push_back(warning.text());
  return outcome;
}

Outcome run_result(const Study& study, const fs::path& folder, const StudyRun& run,
                   const std::stop_token& stop) {
  const fs::path file = run_file(study, folder, run);
  const std::string& fingerprint = study.fingerprints[run.one_case][run.policy];
  if (std::optional<Outcome> known = result_in(file, fingerprint)) return std::move(*known);
  Outcome outcome = simulate(study, run, stop);
  const json value = {{"fingerprint", fingerprint}, {"outcome", to_json(outcome)}};
  write_file_atomically(file, value.dump() + "\n");
  return outcome;
}

}  // namespace

Outcomes do_runs(const Study& study, const fs::path& folder, int threads,
                 const StudyProgress& progress, const std::stop_token& stop) {
  const StudySize size{study.cases.size(), study.policies.size(), study.runs};
  Outcomes outcomes(size.cases,
                    std::vector<std::vector<Outcome>>(
                        size.policies, std::vector<Outcome>(static_cast<std::size_t>(size.runs))));
  std::mutex mutex;
  std::size_t done = 0;
  run_items(size.count(), threads, stop, [&](std::size_t number) {
    const StudyRun run = size.at(number);
    Outcome outcome = run_result(study, folder, run, stop);
    const std::lock_guard lock(mutex);
    outcomes[run.one_case][run.policy][static_cast<std::size_t>(run.run)] = std::move(outcome);
    ++done;
    if (progress) progress(done, size.count());
  });
  return outcomes;
}

void do_run(const Study& study, const fs::path& folder, const StudyRun& run,
            const std::stop_token& stop) {
  run_items(1, 1, stop, [&](std::size_t) { run_result(study, folder, run, stop); });
}

KnownRuns known_runs(const Study& study, const fs::path& folder) {
  const std::size_t policies = study.policies.size();
  KnownRuns known;
  for (std::size_t c = 0; c < study.cases.size(); ++c) {
    auto& outcomes = known.outcomes.emplace_back(policies);
    auto& numbers = known.numbers.emplace_back();
    for (int run = 0; run < study.runs; ++run) {
      std::vector<Outcome> of_pair;
      for (std::size_t p = 0; p < policies; ++p) {
        std::optional<Outcome> outcome = result_in(run_file(study, folder, {c, p, run}), "");
        if (!outcome) break;
        of_pair.push_back(std::move(*outcome));
      }
      if (of_pair.size() < policies) continue;
      numbers.push_back(run);
      for (std::size_t p = 0; p < policies; ++p) outcomes[p].push_back(std::move(of_pair[p]));
    }
  }
  return known;
}

}  // namespace throng::study
