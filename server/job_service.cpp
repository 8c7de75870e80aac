#include "server/job_service.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "base/hash.h"
#include "calibrate/request.h"
#include "jobs/calibrations.h"
#include "jobs/job_id.h"
#include "jobs/spec.h"
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

constexpr auto kProgressInterval = 1s;
constexpr auto kPauseAfterError = 1s;
// Longer than a worker may take to end (jobs::LocalProcessesOptions::grace_s).
constexpr auto kLongestEnd = 20s;

void replace_all(std::string& text, const std::string& what, const std::string& by) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
}

}  // namespace

JobService::JobService(JobServiceOptions options, jobs::Executor& executor)
    : options_(std::move(options)),
      executor_(executor),
      store_(options_.data),
      scenarios_(options_.data, options_.scenarios, options_.scenario_checker, options_.uploads) {
  tidy_data_folder(options_.data, store_);
  drop_unused_bundles();
  worker_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

JobService::~JobService() = default;

jobs::JobSpec JobService::checked(std::string_view job_json) const {
  const std::string text =
      jobs::with_calibrations(job_json, [this](const std::string& id) { return camera_of(id); });
  return jobs::parse_job(text, "", scenarios());
}

jobs::Added JobService::submit(const Submission& submission) {
  const std::shared_lock lock(uploads_mutex_);
  return add(submission);
}

jobs::Added JobService::add(const Submission& submission) {
  const jobs::JobSpec job = checked(submission.job_json);
  const json sent = {submission.job_json, submission.priority, submission.labels};
  const jobs::Added added = store_.add({.name = job.name,
                                        .spec_json = text_of(to_json(job)),
                                        .priority = submission.priority,
                                        .labels = submission.labels,
                                        .owner = submission.owner,
                                        .key = submission.key,
                                        .hash = sha256_hex(text_of(sent)),
                                        .most_active = submission.most_active});
  if (added.is_over_quota) {
    throw QuotaError(
        fmt::format("{} of your jobs wait or run, which is as many as this key may have",
                    submission.most_active));
  }
  if (!added.is_new) return added;
  spdlog::info("job {} queued", added.row.id);
  note_queued();
  tell();
  return added;
}

void JobService::tell() {
  {
    const std::lock_guard lock(told_mutex_);
    ++told_;
  }
  ++revision_;
  told_changed_.notify_all();
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
  std::unique_lock lock(told_mutex_);
  while (true) {
    // Counted before looking: what happens in between wakes us.
    const std::uint64_t told = told_;
    lock.unlock();
    std::vector<jobs::EventRow> rows = store_.events(job, after, limit);
    lock.lock();
    if (!rows.empty()) return rows;
    if (!told_changed_.wait_until(lock, end, [&] { return told_ != told; })) return rows;
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
                                      const std::vector<Upload>& files) {
  const json request = json::parse(request_json, nullptr, /*allow_exceptions=*/false);
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
  static_cast<void>(calibrate::request_from_json(request, staging.path() / "files"));
  write_file_atomically(staging.path() / "request.json", text_of(request));
  JobRow row;
  {
    // Under the lock, so that it is not begun before its files are in their place.
    const std::lock_guard lock(mutex_);
    row = store_.add({request.value("name", ""), text_of(request), jobs::JobKind::calibration}).row;
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
  return json::parse(read_file(place_of(*row) / calibrate::kCameraName));
}

std::optional<JobRow> JobService::get(const std::string& id) const {
  std::optional<JobRow> row = store_.get(id);
  const std::lock_guard lock(mutex_);
  if (row && active_ && active_->row.id == id && !active_->row.progress_json.empty()) {
    row->progress_json = active_->row.progress_json;
  }
  return row;
}

std::shared_ptr<const std::string> JobService::text_of_job(
    const std::string& id, const std::function<std::string(const JobRow&)>& write) const {
  constexpr std::size_t kMostTexts = 1000;
  // Taken before looking: what changes in between makes the text one of the past.
  const std::uint64_t revision = revision_;
  {
    const std::lock_guard lock(texts_mutex_);
    if (texts_revision_ == revision) {
      if (const auto found = texts_.find(id); found != texts_.end()) return found->second;
    }
  }
  const std::optional<JobRow> row = get(id);
  if (!row || row->kind != jobs::JobKind::dataset) return nullptr;
  auto text = std::make_shared<const std::string>(write(*row));
  const std::lock_guard lock(texts_mutex_);
  if (texts_revision_ != revision || texts_.size() >= kMostTexts) {
    texts_.clear();
    texts_revision_ = revision;
  }
  texts_[id] = text;
  return text;
}

std::vector<JobRow> JobService::list(const jobs::JobFilter& filter) const {
  std::vector<JobRow> rows = store_.list(filter);
  const std::lock_guard lock(mutex_);
  for (JobRow& row : rows) {
    if (active_ && active_->row.id == row.id && !active_->row.progress_json.empty()) {
      row.progress_json = active_->row.progress_json;
    }
  }
  return rows;
}

std::optional<JobRow> JobService::change(const std::string& id, int priority,
                                         const std::vector<std::string>& labels) {
  std::optional<JobRow> row = store_.change(id, priority, labels);
  if (row) tell();
  return row;
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
    if (!store_.apply(*row, JobEvent::cancel)) continue;
    tell();
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
    const std::optional<JobRow> queued = store_.apply(*row, JobEvent::retry);
    if (!queued) continue;
    spdlog::info("job {} queued again", id);
    note_queued();
    tell();
    return queued;
  }
  return std::nullopt;
}

bool JobService::remove(const std::string& id) {
  // The state may change between reading and cancelling; then look again.
  std::optional<JobRow> row = store_.get(id);
  while (row && is_active(row->state) && !store_.apply(*row, JobEvent::cancel))
    row = store_.get(id);
  if (!row) return false;
  tell();
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
  for (const fs::path& folder : {scenarios(), options_.data, options_.scenarios}) {
    replace_all(message, fs::absolute(folder).string() + "/", "");
    replace_all(message, folder.string() + "/", "");
  }
  return message;
}

void JobService::work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    try {
      if (work_on_next(stop)) continue;
      std::unique_lock lock(mutex_);
      changed_.wait(lock, stop, [&] { return queued_; });
      queued_ = false;
    } catch (const std::exception& error) {
      // The store cannot be reached (disk full, say): nothing is lost, try again.
      spdlog::error("queue: {}", error.what());
      std::unique_lock lock(mutex_);
      changed_.wait_for(lock, stop, kPauseAfterError, [] { return false; });
    }
  }
}

bool JobService::work_on_next(const std::stop_token& stop) {
  const std::optional<JobRow> next = store_.next();
  if (!next) return false;
  std::stop_source stop_job;
  std::optional<JobRow> row;
  {
    // Under the lock, so that remove() sees a job it has cancelled either not begun or active.
    const std::lock_guard lock(mutex_);
    const bool resumed = next->state == JobState::running;
    row = store_.apply(*next, resumed ? JobEvent::resume : JobEvent::start);
    if (!row) return true;
    active_ = Active{*row, stop_job};
    spdlog::info("job {} {}", row->id, resumed ? "resumed" : "started");
  }
  tell();
  const std::stop_callback forward(stop, [&] { stop_job.request_stop(); });
  const auto finish = [&] {
    const std::lock_guard lock(mutex_);
    active_.reset();
    changed_.notify_all();
  };
  try {
    run(*row, stop_job.get_token());
  } catch (...) {
    finish();
    throw;
  }
  finish();
  return true;
}

void JobService::run(const JobRow& row, const std::stop_token& stop) {
  JobEvent event = JobEvent::fail;
  std::string error;
  try {
    if (row.kind == jobs::JobKind::calibration) {
      make_calibration(row, stop);
    } else {
      make_dataset(row, stop);
    }
    save_progress(row);
    event = JobEvent::succeed;
  } catch (const Cancelled&) {
    // By remove(), which has noted it; or by the end of the service, and then the job stays
    // "running" for the next one to resume.
    spdlog::info("job {} stopped", row.id);
    return;
  } catch (const InputError& failure) {
    std::vector<Problem> problems = failure.problems();
    for (Problem& problem : problems) problem.source = without_paths(problem.source);
    error = text_of(error_json("input", without_paths(failure.what()), problems));
  } catch (const std::exception& failure) {
    error = text_of(error_json("environment", without_paths(failure.what()), {}));
  }
  const std::optional<JobRow> ended = store_.apply(row, event, error);
  tell();
  spdlog::info("job {} {}", row.id, ended ? name_of(ended->state) : "was cancelled meanwhile");
}

void JobService::make_dataset(const JobRow& row, const std::stop_token& stop) {
  const jobs::JobSpec job = jobs::parse_job(row.spec_json, "", scenarios());
  const auto folder = jobs::JobFolder::create(folder_of(row.id).path(), job);
  auto last_save = std::chrono::steady_clock::time_point();
  std::string stages;
  const auto on_progress = [&](const jobs::JobProgress& progress) {
    report(row, text_of(progress_json(progress)));
    if (const std::string now = text_of(stages_json(progress)); now != stages) {
      stages = now;
      note(row, "stage", stages);
    }
    const auto now = std::chrono::steady_clock::now();
    if (now - last_save < kProgressInterval) return;
    last_save = now;
    save_progress(row);
  };
  jobs::run_job(folder, job, executor_, on_progress, stop);
}

void JobService::make_calibration(const JobRow& row, const std::stop_token& stop) {
  const fs::path folder = calibration_folder(row.id);
  const auto say = [&](double share, const std::string& what) {
    report(row, text_of({{"share", share}, {"stage", what}}));
  };
  options_.calibrator(folder, say, stop);
  say(1, "finished");
}

void JobService::note(const JobRow& row, const std::string& type, const std::string& data_json) {
  try {
    store_.note(row, type, data_json);
  } catch (const EnvironmentError& error) {
    spdlog::warn("job {}: {} not recorded: {}", row.id, type, error.what());
  }
  tell();
}

// Progress is worth no job: when it cannot be saved now, it will be a second later.
void JobService::save_progress(const JobRow& row) {
  try {
    store_.save_progress(row, get(row.id).value_or(row).progress_json);
  } catch (const EnvironmentError& error) {
    spdlog::warn("job {}: progress not saved: {}", row.id, error.what());
  }
}

void JobService::report(const JobRow& row, std::string progress_json) {
  const std::lock_guard lock(mutex_);
  if (active_ && active_->row.id == row.id) active_->row.progress_json = std::move(progress_json);
  ++revision_;
}

}  // namespace throng::server
