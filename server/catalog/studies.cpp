#include "server/catalog/studies.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/files.h"
#include "base/json/json_text.h"
#include "server/catalog/api_json.h"
#include "server/catalog/service_errors.h"
#include "spec/study/study_files.h"
#include "world/scenario.h"

namespace throng::server {

namespace fs = std::filesystem;
using jobs::JobRow;
using nlohmann::json;

namespace {

// Each has a result and a log: more would be too many files of one submission.
constexpr std::int64_t kMaxSimulations = 20'000;

void require_scenarios(const json& plan, const fs::path& scenarios) {
  for (std::size_t i = 0; i < plan.at("cases").size(); ++i) {
    const std::string id = plan.at("cases")[i].at("scenario");
    if (world::has_scenario(scenarios, id)) continue;
    throw InputError(Problem{"", fmt::format("/cases/{}/scenario", i),
                             fmt::format("scenario \"{}\"", id), "one that has not been removed"});
  }
}

}  // namespace

json Studies::checked(const json& document) const {
  json plan = confined_.study(document, folders_.scenarios());
  const auto simulations = plan.at("simulations").get<std::int64_t>();
  if (simulations > kMaxSimulations) {
    throw InputError(
        Problem{"", "/runs", fmt::format("{} simulations in all", simulations),
                fmt::format("at most {}: fewer runs, cases or policies", kMaxSimulations)});
  }
  return plan;
}

JobRow Studies::submit(const json& document, const Quota& quota) {
  const std::string text = dump_text(document);
  const std::uint64_t uploads_before = uploads_.scenarios().publications();
  const json plan = checked(document);
  StagingFolder staging(folders_.studies() / "next");
  write_file_atomically(staging.path() / study::kDocumentName, text);
  write_file_atomically(staging.path() / study::kPlanName, dump_text(plan));
  JobRow row;
  {
    const auto uploads = uploads_.hold();
    require_scenarios(plan, folders_.scenarios());
    const std::string sources =
        uploads_.sources_json(document, jobs::JobKind::study, uploads_before);
    // Under the lock, so that it is not begun before its files are in their place.
    const auto lock = state_.hold();
    const jobs::Added added = store_.add({.name = plan.at("name"),
                                          .spec_json = text,
                                          .kind = jobs::JobKind::study,
                                          .owner = quota.owner,
                                          .limits = {quota.max_active, quota.max_bytes},
                                          .sources_json = sources});
    if (!added.over_quota.empty()) throw QuotaError(added.over_quota);
    row = added.row;
    fs::rename(staging.path(), folders_.ground_truth_folder(row));
  }
  spdlog::info("study {} queued", row.id);
  state_.notify_queued();
  state_.notify_event();
  return row;
}

json Studies::plan_of(const JobRow& row) const {
  return parse_own_json(read_file(folders_.ground_truth_folder(row) / study::kPlanName),
                        study::kPlanName);
}

json Studies::summarize(const JobRow& row) const {
  const fs::path folder = folders_.ground_truth_folder(row);
  const bool is_complete = row.state == jobs::JobState::succeeded;
  const fs::path file = folder / (is_complete ? study::kSummaryName : study::kSummarySoFarName);
  if (!fs::exists(file)) return nullptr;
  return parse_own_json(read_file(file), file.filename().string());
}

}  // namespace throng::server
