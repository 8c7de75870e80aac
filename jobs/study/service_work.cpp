#include "jobs/study/service_work.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/files.h"
#include "base/json/json_text.h"
#include "jobs/study/report.h"
#include "jobs/study/study.h"
#include "jobs/study/values.h"
#include "jobs/study/work.h"
#include "spec/estimates/task_memory.h"
#include "spec/study/study_files.h"

namespace throng::study {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kTookName = "took_s";

std::int64_t estimate_memory_mib(const Study& study) {
  std::int64_t most = 0;
  for (const auto& policies : study.jobs) {
    for (const jobs::JobSpec& job : policies) {
      // The first run stands for the others: no value that takes memory is sampled.
      jobs::JobSpec one = job;
      one.runs = 1;
      most = std::max(most,
                      jobs::TaskMemory(one, {study.people}).mib_of({jobs::Task::Kind::simulate}));
    }
  }
  return most;
}

double age_s(const fs::path& file) {
  const auto age = fs::file_time_type::clock::now() - fs::last_write_time(file);
  return std::chrono::duration<double>(age).count();
}

// So often that it takes a twentieth of the time at most; at once while there is nothing to show.
bool is_renewal_due(const fs::path& folder) {
  constexpr double kMinIntervalS = 2;
  constexpr double kPart = 20;
  const fs::path file = folder / kSummarySoFarName;
  if (!fs::exists(file)) return true;
  const json summary = parse_json_or_discard(read_file(file));
  if (!summary.is_object() || summary.value("rows", json::array()).empty()) return true;
  const double took_s = summary.value(kTookName, 0.0);
  return age_s(file) > std::max(kMinIntervalS, kPart * took_s);
}

void renew_summary(const Study& study, const fs::path& folder) {
  const auto begun = Clock::now();
  const KnownRuns known = known_runs(study, folder);
  write_file_atomically(folder / kValuesName, values_json(study, known).dump() + "\n");
  json summary = summary_json(study, known.outcomes);
  summary[kTookName] = std::chrono::duration<double>(Clock::now() - begun).count();
  write_file_atomically(folder / kSummarySoFarName, summary.dump() + "\n");
}

}  // namespace

json check_request(const json& request) {
  const Study study =
      read_study(request.at("study"), "", request.at("scenarios").get<std::string>());
  json cases = json::array();
  for (const Case& one : study.cases) {
    cases.push_back({{"id", one.id},
                     {"title", one.title},
                     {"scenario", one.scenario.id},
                     {"duration_s", one.duration_s},
                     {"horizons_s", one.horizons_s}});
  }
  json policies = json::array();
  for (const PolicyRow& policy : study.policies) {
    policies.push_back({{"id", policy.id}, {"title", policy.title}});
  }
  const StudySize size{study.cases.size(), study.policies.size(), study.runs};
  return {{"name", study.name},
          {"seed", study.seed},
          {"runs", study.runs},
          {"baseline", study.policies[study.baseline].id},
          {"cases", std::move(cases)},
          {"policies", std::move(policies)},
          {"simulations", size.count()},
          {"people", study.people},
          {"memory_mib", estimate_memory_mib(study)}};
}

void simulate_in(const fs::path& folder, std::size_t number) {
  const fs::path scenarios = world::scenarios_folder();
  const json document = parse_own_json(read_file(folder / kDocumentName), kDocumentName);
  const json plan = parse_own_json(read_file(folder / kPlanName), kPlanName);
  const StudySize size{plan.at("cases").size(), plan.at("policies").size(), plan.at("runs")};
  if (number >= size.count()) {
    throw InputError(Problem{"", "task", fmt::format("simulation {}", number),
                             fmt::format("one of {}", size.count())});
  }
  const StudyRun run = size.at(number);
  const Study study =
      read_study(document, kDocumentName, scenarios, Cell{run.one_case, run.policy});
  do_run(study, folder, run);
  if (is_renewal_due(folder)) renew_summary(study, folder);
}

void report_in(const fs::path& folder) {
  const Study study = load_study(folder / kDocumentName, world::scenarios_folder());
  write_report(study, do_runs(study, folder, 1), folder);
}

}  // namespace throng::study
