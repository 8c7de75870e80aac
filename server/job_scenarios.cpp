// The part of JobService that keeps uploads as long as jobs need them.
#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "base/error.h"
#include "base/json_text.h"
#include "jobs/spec/resolved_job.h"
#include "server/answers.h"
#include "server/job_service.h"

namespace throng::server {

using jobs::JobRow;
using nlohmann::json;

namespace {

constexpr std::string_view kOwnBundle = "bundle/";
constexpr int kJobsAtOnce = 500;

/// The upload that a job's scenario may belong to; "" for a calibration.
std::string upload_of_job(const JobRow& row) {
  const json spec = parse_json_or_discard(row.spec_json);
  const auto named = spec.is_object() ? spec.find("scenario") : spec.end();
  if (!spec.is_object() || named == spec.end() || !named->is_string()) return "";
  return upload_of(named->get<std::string>());
}

/// The job with its "bundle/NAME" as the bundle's own name.
std::string naming(const std::string& bundle, std::string_view job_json) {
  json job = parse_json(job_json, "", kJobJsonLimits);
  if (!job.is_object()) throw InputError(Problem{"", "", "no JSON object", "a job"});
  const json scenario = job.value("scenario", json());
  const std::string name = scenario.is_string() ? scenario.get<std::string>() : "";
  if (!name.starts_with(kOwnBundle)) {
    throw InputError(Problem{"", "/scenario", scenario.dump(),
                             "\"bundle/NAME\", a scenario of the bundle that came with the job"});
  }
  job["scenario"] = bundle + "/" + name.substr(kOwnBundle.size());
  return text_of(job);
}

}  // namespace

std::vector<JobRow> JobService::jobs_that_name(const std::string& upload,
                                               std::vector<jobs::JobState> states) const {
  // Without parsing those that cannot: texts hold the id as it is.
  const std::string beginning = fmt::format("\"{}/", upload);
  std::vector<JobRow> found;
  jobs::JobFilter filter;
  filter.states = std::move(states);
  filter.limit = kJobsAtOnce;
  while (true) {
    std::vector<JobRow> rows = store_.list(filter);
    for (const JobRow& row : rows) {
      if (row.spec_json.find(beginning) == std::string::npos) continue;
      if (upload_of_job(row) == upload) found.push_back(row);
    }
    if (static_cast<int>(rows.size()) < kJobsAtOnce) return found;
    filter.after = rows.back().id;
  }
}

/// A bundle that came with a request is there as long as this is; afterwards, if a job names it.
class JobService::PinnedBundle {
 public:
  PinnedBundle(JobService& service, std::string_view bundle, const std::string& owner)
      : service_(service), name_(bundle_name_of(bundle)) {
    // Unpacked and checked before others have to wait.
    std::optional<ScenarioStore::Staged> staged;
    if (!service.scenarios_.find(name_)) staged = service.scenarios_.stage(name_, bundle, owner);
    const std::unique_lock lock(service.uploads_mutex_);
    if (!service.scenarios_.find(name_)) {
      // It was there and has gone, with the last job that named it.
      if (!staged) staged = service.scenarios_.stage(name_, bundle, owner);
      static_cast<void>(service.scenarios_.publish(*staged));
    }
    service.pinned_.insert(name_);
  }
  ~PinnedBundle() {
    const std::unique_lock lock(service_.uploads_mutex_);
    service_.pinned_.erase(service_.pinned_.find(name_));
    if (is_kept_) return;
    try {
      service_.drop_if_unused(name_);
    } catch (const std::exception& error) {
      spdlog::warn("bundle {}: not removed: {}", name_, error.what());  // at the next start
    }
  }
  PinnedBundle(const PinnedBundle&) = delete;
  PinnedBundle& operator=(const PinnedBundle&) = delete;

  const std::string& name() const { return name_; }
  /// A job names it from now on.
  void keep() { is_kept_ = true; }

 private:
  JobService& service_;
  std::string name_;
  bool is_kept_ = false;
};

jobs::Added JobService::submit_with_bundle(const Submission& submission, std::string_view bundle) {
  const std::string job = naming(bundle_name_of(bundle), submission.job_json);
  PinnedBundle pinned(*this, bundle, submission.owner);
  Submission named = submission;
  named.job_json = job;
  jobs::Added added = submit(named);
  // A repeated submission's job may be another's, or be gone.
  if (added.is_new) pinned.keep();
  return added;
}

jobs::ResolvedJob JobService::checked_with_bundle(std::string_view job_json,
                                                  std::string_view bundle) {
  const std::string job = naming(bundle_name_of(bundle), job_json);
  const PinnedBundle pinned(*this, bundle, "");
  return checked(job);
}

void JobService::require_scenario(const jobs::JobSpec& job) const {
  if (job.generate || std::filesystem::exists(scenarios() / (job.scenario + ".json"))) return;
  throw InputError(Problem{"", "/scenario", fmt::format("scenario \"{}\"", job.scenario),
                           "one that has not been removed"});
}

bool JobService::remove_scenarios(const std::string& name) {
  const std::unique_lock lock(uploads_mutex_);
  const auto users = jobs_that_name(name, {jobs::JobState::queued, jobs::JobState::running});
  if (!users.empty()) {
    throw ConflictError(fmt::format("{} jobs that wait or run use it, {} among them", users.size(),
                                    users.front().id));
  }
  return scenarios_.remove(name);
}

void JobService::drop_if_unused(const std::string& bundle) {
  if (pinned_.contains(bundle)) return;
  if (jobs_that_name(bundle, {}).empty()) scenarios_.remove(bundle);
}

void JobService::drop_bundle_of(const JobRow& removed) {
  const std::string name = upload_of_job(removed);
  if (!is_bundle_name(name)) return;
  const std::unique_lock lock(uploads_mutex_);
  drop_if_unused(name);
}

void JobService::drop_unused_bundles() {
  for (const ScenarioUpload& upload : scenarios_.list()) {
    if (is_bundle_name(upload.name)) drop_if_unused(upload.name);
  }
}

}  // namespace throng::server
