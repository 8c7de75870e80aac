#include "server/job_service.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "base/json_text.h"
#include "base/redact.h"
#include "calibrate/spec/request_files.h"
#include "jobs/queue/job_id.h"
#include "jobs/spec/calibrations.h"
#include "jobs/spec/resolved_job.h"
#include "server/answers.h"
#include "server/data_folder.h"

namespace throng::server {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace std::chrono_literals;
using jobs::JobEvent;
using jobs::JobRow;
using jobs::JobState;

namespace {

// Longer than a worker may take to end (jobs::LocalProcessesOptions::grace_s).
constexpr auto kLongestEnd = 20s;

}  // namespace

JobService::JobService(JobServiceOptions options, jobs::Executor& executor)
    : options_(std::move(options)),
      executor_(executor),
      store_(options_.data, options_.clock),
      confined_(options_.confined, options_.data),
      scenarios_(options_.data, options_.scenarios, confined_, options_.uploads),
      disk_(
          options_.free_bytes ? options_.free_bytes
                              : [data = options_.data] { return free_bytes_of(data); },
          options_.least_free_bytes, [this](const std::string& reason) { pause(reason); }),
      reports_(options_.reporter) {
  tidy_data_folder(options_.data, store_);
  drop_unused_bundles();
  worker_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
  sweeper_ = std::jthread([this](const std::stop_token& stop) { sweep(stop); });
}

JobService::~JobService() = default;

jobs::ResolvedJob JobService::checked(std::string_view job_json) const {
  const std::string text =
      jobs::with_calibrations(job_json, [this](const std::string& id) { return camera_of(id); });
  return confined_.job(text, scenarios());
}

jobs::Added JobService::submit(const Submission& submission) {
  const jobs::ResolvedJob resolved = checked(submission.job_json);
  const jobs::JobSpec& job = resolved.spec();
  const std::shared_lock lock(uploads_mutex_);
  require_scenario(job);
  const json sent = {submission.job_json, submission.priority, submission.labels};
  const jobs::Added added = store_.add({.name = job.name,
                                        .spec_json = text_of(to_json(job)),
                                        .priority = submission.priority,
                                        .labels = submission.labels,
                                        .owner = submission.owner,
                                        .key = submission.key,
                                        .hash = sha256_hex(text_of(sent)),
                                        .most_active = submission.most_active,
                                        .most_bytes = submission.most_bytes});
  if (!added.over_quota.empty()) throw QuotaError(added.over_quota);
  if (!added.is_new) return added;
  spdlog::info("job {} queued", added.row.id);
  note_queued();
  tell();
  return added;
}

void JobService::tell() {
  ++revision_;
  bell_.ring();
}

std::shared_ptr<void> JobService::begin_watch(int most) {
  const auto release = [watchers = watchers_](void*) { --*watchers; };
  std::shared_ptr<void> watch(watchers_.get(), release);
  return ++*watchers_ > most ? nullptr : std::move(watch);
}

std::vector<jobs::EventRow> JobService::events(const std::string& job, std::int64_t after,
                                               int limit,
                                               std::chrono::milliseconds patience) const {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (true) {
    const std::uint64_t rung = bell_.rung();
    std::vector<jobs::EventRow> rows = store_.events(job, after, limit);
    if (!rows.empty() || !bell_.wait(rung, end)) return rows;
  }
}

void JobService::note_queued() {
  {
    const std::lock_guard lock(mutex_);
    queued_ = true;
  }
  changed_.notify_all();
}

JobRow JobService::submit_calibration(std::string_view request_json,
                                      const std::vector<Upload>& files, const Quota& quota) {
  const json request = parse_json(request_json, "", kRequestJsonLimits);
  if (!request.is_object()) {
    throw InputError(Problem{"", "", "no JSON object", "a request: see docs/calibration.md"});
  }
  const fs::path all = options_.data / "calibrations";
  StagingFolder staging(all / "next");
  for (const Upload& file : files) {
    if (fs::path(file.name).filename() != file.name || file.name.empty() || file.name == "." ||
        file.name == "..") {
      throw InputError(Problem{"", "/files", file.name, "plain names of files"});
    }
    write_file_atomically(staging.path() / "files" / file.name, file.bytes);
  }
  confined_.calibration(request, staging.path() / "files");
  write_file_atomically(staging.path() / "request.json", text_of(request));
  JobRow row;
  {
    // Under the lock, so that it is not begun before its files are in their place.
    const std::lock_guard lock(mutex_);
    const jobs::Added added = store_.add({.name = request.value("name", ""),
                                          .spec_json = text_of(request),
                                          .kind = jobs::JobKind::calibration,
                                          .owner = quota.owner,
                                          .most_active = quota.most_active,
                                          .most_bytes = quota.most_bytes});
    if (!added.over_quota.empty()) throw QuotaError(added.over_quota);
    row = added.row;
    fs::rename(staging.path(), place_of(row));
  }
  spdlog::info("calibration {} queued", row.id);
  note_queued();
  tell();
  return row;
}

json JobService::camera_of(const std::string& id) const {
  const std::optional<JobRow> row = jobs::is_job_id(id) ? store_.get(id) : std::nullopt;
  if (!row || row->kind != jobs::JobKind::calibration) {
    throw EnvironmentError("there is no calibration of this id");
  }
  if (row->state != JobState::succeeded) {
    throw EnvironmentError(fmt::format("the calibration is {}", name_of(row->state)));
  }
  return parse_own_json(read_file(place_of(*row) / calibrate::kCameraName), calibrate::kCameraName);
}

void JobService::complete(JobRow& row) const {
  if (active_ && active_->row.id == row.id && !active_->row.progress_json.empty()) {
    row.progress_json = active_->row.progress_json;
  }
  if (is_active(row.state)) row.waiting_for = paused_;
}

std::optional<JobRow> JobService::get(const std::string& id) const {
  std::optional<JobRow> row = store_.get(id);
  const std::lock_guard lock(mutex_);
  if (row) complete(*row);
  return row;
}

std::shared_ptr<const std::string> JobService::text_of_job(
    const std::string& id, const std::function<std::string(const JobRow&)>& write) const {
  // Taken before looking: what changes in between makes the text one of the past.
  const std::uint64_t revision = revision_;
  if (auto text = texts_.find(revision, id)) return text;
  const std::optional<JobRow> row = get(id);
  if (!row || row->kind != jobs::JobKind::dataset) return nullptr;
  auto text = std::make_shared<const std::string>(write(*row));
  texts_.put(revision, id, text);
  return text;
}

std::vector<JobRow> JobService::list(const jobs::JobFilter& filter) const {
  std::vector<JobRow> rows = store_.list(filter);
  const std::lock_guard lock(mutex_);
  for (JobRow& row : rows) complete(row);
  return rows;
}

std::optional<JobRow> JobService::change(const std::string& id, const jobs::JobChange& change) {
  std::optional<JobRow> row = store_.change(id, change);
  if (row) tell();
  return row;
}

std::string JobService::paused() const {
  const std::lock_guard lock(mutex_);
  return paused_;
}

void JobService::end_work_on(const std::string& id) {
  std::unique_lock lock(mutex_);
  const auto is_at_work = [&] { return active_ && active_->row.id == id; };
  if (is_at_work()) active_->stop.request_stop();
  if (!changed_.wait_for(lock, kLongestEnd, [&] { return !is_at_work(); })) {
    throw EnvironmentError("the job's workers do not end; the job is cancelled, try again later");
  }
}

std::optional<JobRow> JobService::cancel(const std::string& id) {
  // The state may change between reading and cancelling; then look again.
  for (std::optional<JobRow> row = store_.get(id); row; row = store_.get(id)) {
    if (!is_active(row->state)) {
      throw ConflictError(
          fmt::format("the job is {}: there is nothing to cancel", name_of(row->state)));
    }
    if (!apply(*row, JobEvent::cancel)) continue;
    end_work_on(id);
    spdlog::info("job {} cancelled", id);
    return get(id);
  }
  return std::nullopt;
}

std::optional<JobRow> JobService::retry(const std::string& id) {
  for (std::optional<JobRow> row = store_.get(id); row; row = store_.get(id)) {
    if (!next_state(row->state, JobEvent::retry)) {
      throw ConflictError(
          fmt::format("the job is {}: only one that failed or was cancelled can be "
                      "tried again",
                      name_of(row->state)));
    }
    const std::optional<JobRow> queued = apply(*row, JobEvent::retry);
    if (!queued) continue;
    ReportMaker::forget(place_of(*row));
    spdlog::info("job {} queued again", id);
    note_queued();
    return queued;
  }
  return std::nullopt;
}

bool JobService::remove(const std::string& id) {
  // The state may change between reading and cancelling; then look again.
  std::optional<JobRow> row = store_.get(id);
  while (row && is_active(row->state) && !apply(*row, JobEvent::cancel)) row = store_.get(id);
  if (!row) return false;
  end_work_on(id);
  if (!store_.remove(id)) return false;
  tell();
  drop_bundle_of(*row);
  // Moved away first, so that a half-removed folder is never taken for a job's.
  const fs::path trash = options_.data / "trash";
  std::error_code error;
  fs::create_directories(trash, error);
  fs::rename(place_of(*row), trash / id, error);
  fs::remove_all(trash / id, error);
  if (error) spdlog::warn("job {}: some files could not be removed: {}", id, error.message());
  spdlog::info("job {} removed", id);
  return true;
}

jobs::JobFolder JobService::folder_of(const std::string& id) const {
  return jobs::JobFolder(options_.data / "jobs" / id);
}

fs::path JobService::calibration_folder(const std::string& id) const {
  return options_.data / "calibrations" / id;
}

fs::path JobService::place_of(const JobRow& row) const {
  return row.kind == jobs::JobKind::calibration ? calibration_folder(row.id)
                                                : folder_of(row.id).path();
}

std::string JobService::without_paths(std::string message) const {
  return without_folders(std::move(message), {scenarios(), options_.data, options_.scenarios});
}

std::vector<Problem> JobService::without_paths(std::vector<Problem> problems) const {
  for (Problem& problem : problems) {
    for (std::string* text : {&problem.source, &problem.where, &problem.found, &problem.expected}) {
      *text = without_paths(std::move(*text));
    }
  }
  return problems;
}

}  // namespace throng::server
