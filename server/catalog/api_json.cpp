#include "server/catalog/api_json.h"

#include <fmt/chrono.h>
#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/json/json_text.h"
#include "server/http/reason_phrase.h"
#include "spec/job/plan.h"

namespace throng::server {

using nlohmann::json;

json time_json(std::int64_t unix_ms) {
  if (unix_ms == 0) return nullptr;
  constexpr std::int64_t kMsPerS = 1000;
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z",
                     fmt::gmtime(static_cast<std::time_t>(unix_ms / kMsPerS)), unix_ms % kMsPerS);
}

namespace {

json parsed_or(const std::string& text, json otherwise) {
  if (text.empty()) return otherwise;
  try {
    return parse_own_json(text, "a row of the store");
  } catch (const EnvironmentError&) {  // damaged: the rest of the job is still there
    return otherwise;
  }
}

// Stage of a job: that of its least advanced run, but simulating once any run is. Runs that have
// failed hold nothing up.
jobs::Stage current_stage(const jobs::JobProgress& progress) {
  jobs::Stage earliest = jobs::Stage::failed;
  for (const jobs::RunProgress& run : progress.runs) {
    if (run.stage == jobs::Stage::simulating) return run.stage;
    earliest = std::min(earliest, run.stage);
  }
  return earliest;
}

json with_pace(json value, const jobs::RenderRate& pace) {
  value["frames_per_s"] = pace.images_per_s;
  value["remaining_s"] = pace.remaining_s ? json(*pace.remaining_s) : json(nullptr);
  return value;
}

/// Fields of everything that is queued.
json row_json(const jobs::JobRow& row, const Retention& retention) {
  return {{"id", row.id},
          {"name", row.name},
          {"state", to_string(row.state)},
          {"attempt", row.attempt},
          {"priority", row.priority},
          {"labels", row.labels},
          {"owner", row.owner.empty() ? json(nullptr) : json(row.owner)},
          {"created_at", time_json(row.created_ms)},
          {"started_at", time_json(row.started_ms)},
          {"ended_at", time_json(row.ended_ms)},
          {"expires_at", time_json(expiry_ms(row, retention).value_or(0))},
          {"keep", row.keep},
          {"bytes", row.bytes},
          {"waiting_for", row.waiting_for.empty() ? json(nullptr) : json(row.waiting_for)},
          {"progress", parsed_or(row.progress_json, json::object())},
          {"error", parsed_or(row.error_json, nullptr)}};
}

}  // namespace

json progress_json(const jobs::JobProgress& progress) {
  json runs = json::array();
  std::int64_t done = 0;
  std::int64_t total = 0;
  for (const jobs::RunProgress& run : progress.runs) {
    runs.push_back(with_pace({{"run", jobs::run_name(run.run)},
                              {"seed", run.seed},
                              {"stage", to_string(run.stage)},
                              {"simulated_s", run.simulated_s},
                              {"duration_s", run.duration_s},
                              {"frames_done", run.images_done},
                              {"frames_total", run.images_total}},
                             run.pace));
    done += run.images_done;
    total += run.images_total;
  }
  json shards = json::array();
  for (const jobs::ShardProgress& shard : progress.shards) {
    shards.push_back(with_pace({{"shard", to_string(shard.task)},
                                {"frames_done", shard.images_done},
                                {"frames_total", shard.images_total}},
                               shard.pace));
    if (!shard.node.empty()) shards.back()["node"] = shard.node;
  }
  json nodes = json::array();
  for (const jobs::NodeWork& work : progress.nodes) {
    nodes.push_back({{"node", work.node},
                     {"running", work.running},
                     {"done", work.done},
                     {"failed", work.failed},
                     {"busy_s", work.busy_s}});
  }
  json value = with_pace({{"stage", to_string(current_stage(progress))},
                          {"frames_done", done},
                          {"frames_total", total},
                          {"runs", std::move(runs)},
                          {"shards", std::move(shards)},
                          {"nodes", std::move(nodes)}},
                         progress.pace);
  if (progress.delivery) {
    const jobs::DeliveryProgress& delivery = *progress.delivery;
    value["publishing"] = {{"address", delivery.address},
                           {"bytes_done", delivery.bytes_done},
                           {"bytes_total", delivery.bytes_total},
                           {"objects", delivery.objects ? json(*delivery.objects) : json(nullptr)}};
  }
  return value;
}

json stages_json(const jobs::JobProgress& progress) {
  json runs = json::object();
  for (const jobs::RunProgress& run : progress.runs) {
    runs[jobs::run_name(run.run)] = to_string(run.stage);
  }
  return {{"stage", to_string(current_stage(progress))}, {"runs", std::move(runs)}};
}

json event_json(const jobs::EventRow& event) {
  return {{"seq", event.seq},
          {"job", event.job},
          {"at", time_json(event.at_ms)},
          {"type", event.type},
          {"data", parse_own_json(event.data_json, "an event")}};
}

json problems_json(const std::vector<Problem>& problems) {
  json list = json::array();
  for (const Problem& problem : problems) {
    list.push_back({{"pointer", problem.where},
                    {"found", problem.found},
                    {"expected", problem.expected},
                    {"message", problem.text()}});
    if (!problem.source.empty()) list.back()["source"] = problem.source;
  }
  return list;
}

json error_json(const std::string& kind, const std::string& message,
                const std::vector<Problem>& problems) {
  return {{"kind", kind}, {"message", message}, {"problems", problems_json(problems)}};
}

json partial_error_json(const std::vector<jobs::RunFailure>& failures) {
  json error = error_json(
      "partial", fmt::format("{} of the runs failed and are not in the dataset", failures.size()),
      {});
  for (const jobs::RunFailure& failure : failures) {
    error["runs"].push_back({{"run", jobs::run_name(failure.run)},
                             {"task", failure.task},
                             {"message", failure.message},
                             {"attempts", failure.attempts}});
  }
  return error;
}

json calibration_json(const jobs::JobRow& row, const Retention& retention) {
  const std::string self = "/v1/calibrations/" + row.id;
  json value = row_json(row, retention);
  value["request"] = parsed_or(row.spec_json, nullptr);
  value["links"] = {{"self", self}};
  if (row.state == jobs::JobState::succeeded) {
    for (const char* result : {"camera", "opencv", "ros", "residuals", "points"}) {
      value["links"][result] = fmt::format("{}/{}", self, result);
    }
  }
  return value;
}

json study_json(const jobs::JobRow& row, const Retention& retention) {
  const std::string self = "/v1/studies/" + row.id;
  json value = row_json(row, retention);
  if (!row.spec_json.empty()) value["study"] = parsed_or(row.spec_json, nullptr);
  value["links"] = {{"self", self}, {"values", self + "/files/values.json"}};
  if (row.state == jobs::JobState::succeeded) {
    value["links"]["report"] = self + "/report";
    value["links"]["summary"] = self + "/files/summary.json";
  }
  return value;
}

json job_json(const jobs::JobRow& row, const Retention& retention) {
  const std::string self = "/v1/jobs/" + row.id;
  json value = row_json(row, retention);
  value["links"] = {{"self", self}};
  if (has_dataset(row.state)) {
    value["links"]["archive"] = self + "/archive";
    value["links"]["metrics"] = self + "/metrics";
  }
  return value;
}

std::string job_text(const jobs::JobRow& row, const Retention& retention) {
  std::string text = dump_text(job_json(row, retention));
  text.pop_back();
  // As it is: a job of many values takes dozens of times its text's size when it is parsed.
  return text + ",\"job\":" + (is_own_json(row.spec_json) ? row.spec_json : "null") + "}";
}

json problem_document(int status, const std::string& detail, const std::vector<Problem>& problems) {
  json document = {{"type", "about:blank"},
                   {"title", reason_phrase(status)},
                   {"status", status},
                   {"detail", detail}};
  if (!problems.empty()) document["errors"] = problems_json(problems);
  return document;
}

std::string dump_text(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace throng::server
