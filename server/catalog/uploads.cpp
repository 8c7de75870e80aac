#include "server/catalog/uploads.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/json/json_text.h"
#include "server/catalog/api_json.h"
#include "server/catalog/service_errors.h"

namespace throng::server {

using jobs::JobRow;
using nlohmann::json;

namespace {

constexpr std::string_view kOwnBundle = "bundle/";
constexpr int kJobsAtOnce = 500;
constexpr std::size_t kBytesAtOnce = 4 << 20;

/// The places of scenarios' ids in the value of a job's "scenario", or of a study's case's.
std::vector<json*> ids_in(json& scenario) {
  if (scenario.is_string()) return {&scenario};
  std::vector<json*> ids;
  if (!scenario.is_array()) return ids;
  for (json& one : scenario) {
    if (one.is_string()) ids.push_back(&one);
    if (one.is_object() && one.contains("id") && one["id"].is_string()) ids.push_back(&one["id"]);
  }
  return ids;
}

/// Adds the uploads that the scenarios of a job, or of a study's case, may belong to.
void add_uploads(const json& spec, std::set<std::string>& uploads) {
  if (!spec.is_object() || !spec.contains("scenario")) return;
  json scenario = spec["scenario"];
  for (const json* id : ids_in(scenario)) uploads.insert(upload_name(id->get<std::string>()));
}

/// Uploads that scenarios of a job or study may belong to; none of a calibration's.
std::set<std::string> job_uploads(const json& spec, jobs::JobKind kind) {
  std::set<std::string> uploads;
  if (kind != jobs::JobKind::study) {
    add_uploads(spec, uploads);
  } else if (spec.is_object() && spec.contains("cases")) {
    for (const json& one : spec["cases"]) add_uploads(one, uploads);
  }
  uploads.erase("");
  return uploads;
}

std::set<std::string> job_uploads(const JobRow& row) {
  return job_uploads(parse_json_or_discard(row.spec_json), row.kind);
}

}  // namespace

void name_bundle(std::string_view bundle, json& job) {
  if (!job.is_object()) throw InputError(Problem{"", "", "no JSON object", "a job"});
  json scenario = job.value("scenario", json());
  bool uses_bundle = false;
  for (json* id : ids_in(scenario)) {
    const auto name = id->get<std::string>();
    if (!name.starts_with(kOwnBundle)) continue;
    *id = bundle_name(bundle) + "/" + name.substr(kOwnBundle.size());
    uses_bundle = true;
  }
  if (!uses_bundle) {
    throw InputError(Problem{"", "/scenario", scenario.dump(),
                             "\"bundle/NAME\", a scenario of the bundle that came with the job"});
  }
  job["scenario"] = std::move(scenario);
}

Uploads::Uploads(const ServiceFolders& folders, jobs::Store& jobs, const ConfinedChecks& confined,
                 UploadLimits limits)
    : jobs_(jobs), scenarios_(folders.data(), folders.shipped(), confined, limits) {
  for (const ScenarioUpload& upload : scenarios_.list()) {
    if (is_bundle_name(upload.name)) drop_if_unused(upload.name);
  }
}

std::vector<JobRow> Uploads::jobs_that_name(const std::string& upload,
                                            const std::vector<jobs::JobState>& states) const {
  // Without parsing those that cannot: texts hold the id as it is.
  const std::string beginning = fmt::format("\"{}/", upload);
  std::vector<JobRow> found;
  for (const jobs::JobKind kind : {jobs::JobKind::dataset, jobs::JobKind::study}) {
    jobs::JobFilter filter;
    filter.kind = kind;
    filter.states = states;
    filter.limit = kJobsAtOnce;
    filter.max_text_bytes = kBytesAtOnce;
    while (true) {
      std::vector<JobRow> rows = jobs_.list(filter);
      for (const JobRow& row : rows) {
        if (row.spec_json.find(beginning) == std::string::npos) continue;
        if (job_uploads(row).contains(upload)) found.push_back(row);
      }
      if (rows.empty()) break;
      filter.after = rows.back().id;
    }
  }
  return found;
}

std::string Uploads::sources_json(const json& spec, jobs::JobKind kind,
                                  std::uint64_t publications) const {
  json sources = json::object();
  for (const std::string& name : job_uploads(spec, kind)) {
    if (scenarios_.is_published_after(name, publications)) {
      throw InputError(
          Problem{"", "/scenario",
                  fmt::format("scenarios \"{}\", which were replaced during the check", name),
                  "the same ones; submit it again"});
    }
    const std::string hash = scenarios_.content_hash(name);
    if (!hash.empty()) sources[name] = hash;
  }
  return dump_text(sources);
}

void Uploads::require_same_sources(const JobRow& row) const {
  const json sources = parse_json_or_discard(row.sources_json);
  if (!sources.is_object()) return;  // the row is damaged
  for (const auto& [name, hash] : sources.items()) {
    const std::string now = scenarios_.content_hash(name);
    if (now == hash) continue;
    throw InputError(
        Problem{"", "/scenario",
                fmt::format("scenarios \"{}\", which {} since the job was submitted", name,
                            now.empty() ? "were removed" : "have changed"),
                "those that the job was resolved from; submit the job again to use the new ones"});
  }
}

Uploads::Pinned::Pinned(Uploads& uploads, std::string_view bundle, const std::string& owner)
    : uploads_(uploads), name_(bundle_name(bundle)) {
  ScenarioStore& scenarios = uploads.scenarios_;
  // Unpacked and checked before others have to wait.
  std::optional<ScenarioStore::Staged> staged;
  if (!scenarios.find(name_)) staged = scenarios.stage(name_, bundle, owner);
  const std::unique_lock lock(uploads.mutex_);
  if (!scenarios.find(name_)) {
    // It was there and has gone, with the last job that named it.
    if (!staged) staged = scenarios.stage(name_, bundle, owner);
    static_cast<void>(scenarios.publish(*staged));
  }
  uploads.pinned_.insert(name_);
}

Uploads::Pinned::~Pinned() {
  const std::unique_lock lock(uploads_.mutex_);
  uploads_.pinned_.erase(uploads_.pinned_.find(name_));
  if (is_kept_) return;
  try {
    uploads_.drop_if_unused(name_);
  } catch (const std::exception& error) {
    spdlog::warn("bundle {}: not removed: {}", name_, error.what());  // at the next start
  }
}

void Uploads::require_rate(const std::string& owner) {
  if (rate_.take(owner)) return;
  throw QuotaError(fmt::format(
      "a key may send {} uploads at once, and then one each second: wait a little", kUploadBurst));
}

bool Uploads::remove(const std::string& name) {
  const std::unique_lock lock(mutex_);
  const auto users = jobs_that_name(name, {jobs::JobState::queued, jobs::JobState::running});
  if (!users.empty()) {
    throw ConflictError(fmt::format("{} jobs or studies that wait or run use it, {} among them",
                                    users.size(), users.front().id));
  }
  return scenarios_.remove(name);
}

void Uploads::drop_if_unused(const std::string& bundle) {
  if (pinned_.contains(bundle)) return;
  if (jobs_that_name(bundle, {}).empty()) scenarios_.remove(bundle);
}

void Uploads::drop_bundle_of(const JobRow& removed) {
  for (const std::string& name : job_uploads(removed)) {
    if (!is_bundle_name(name)) continue;
    const std::unique_lock lock(mutex_);
    drop_if_unused(name);
  }
}

}  // namespace throng::server
