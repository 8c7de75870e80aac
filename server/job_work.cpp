// The queue at work: the part of the job service that nobody calls.
#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "jobs/queue/faults.h"
#include "jobs/spec/resolved_job.h"
#include "server/answers.h"
#include "server/data_folder.h"
#include "server/job_service.h"

namespace throng::server {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using jobs::JobEvent;
using jobs::JobRow;
using jobs::JobState;

namespace {

constexpr auto kProgressInterval = 1s;
constexpr auto kPauseAfterError = 1s;
constexpr auto kSweepInterval = 60s;
constexpr auto kMostMemoryOfRemoved = std::chrono::hours(24 * 30);

}  // namespace

std::optional<JobRow> JobService::apply(const JobRow& row, JobEvent event,
                                        const std::string& error_json) {
  const std::string place = fmt::format("server/{}/", name_of(event));
  jobs::provoke_faults(place + "before", 1);
  std::optional<JobRow> changed = store_.apply(row, event, error_json);
  jobs::provoke_faults(place + "after", 1);
  if (changed) tell();
  return changed;
}

void JobService::pause(const std::string& reason) {
  std::optional<JobRow> row;
  {
    const std::lock_guard lock(mutex_);
    paused_ = reason;
    if (active_) row = active_->row;
    // What has been published stays; the rest is done again when there is room.
    if (active_ && !reason.empty()) active_->stop.request_stop();
  }
  if (reason.empty()) {
    spdlog::info("queue: goes on");
  } else {
    spdlog::warn("queue: rests, {}", reason);
  }
  if (row && !reason.empty()) note(*row, "paused", text_of({{"reason", reason}}));
  changed_.notify_all();
  tell();
}

void JobService::remove_expired() {
  constexpr int kMostAtOnce = 1000;
  const std::int64_t now_ms = store_.now_ms();
  const Retention& retention = options_.retention;
  if (retention.longest_ms > 0 || retention.most_bytes > 0) {
    for (const std::string& id :
         expired(store_.ended(kMostAtOnce), store_.total_bytes(), now_ms, retention)) {
      spdlog::info("job {}: has been kept for long enough", id);
      remove(id);
    }
  }
  store_.forget_events(
      now_ms - std::chrono::duration_cast<std::chrono::milliseconds>(kMostMemoryOfRemoved).count());
}

void JobService::sweep(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    try {
      remove_expired();
    } catch (const std::exception& error) {
      spdlog::error("removal of old jobs: {}", error.what());
    }
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, stop, kSweepInterval, [] { return false; });
  }
}

void JobService::work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    try {
      {
        std::unique_lock lock(mutex_);
        if (!changed_.wait(lock, stop, [&] { return paused_.empty(); })) return;
      }
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
    if (!paused_.empty()) return true;
    const bool resumed = next->state == JobState::running;
    row = apply(*next, resumed ? JobEvent::resume : JobEvent::start);
    if (!row) return true;
    active_ = Active{*row, stop_job};
    spdlog::info("job {} {}", row->id, resumed ? "resumed" : "started");
  }
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
    std::vector<jobs::RunFailure> failures;
    if (row.kind == jobs::JobKind::calibration) {
      make_calibration(row, stop);
    } else {
      failures = make_dataset(row, stop);
    }
    save_progress(row);
    event = failures.empty() ? JobEvent::succeed : JobEvent::succeed_partly;
    for (jobs::RunFailure& failure : failures) failure.message = without_paths(failure.message);
    if (!failures.empty()) error = text_of(partial_error_json(failures));
  } catch (const Cancelled&) {
    // By cancel() or remove(), which have noted it; or because the service ends or rests, and then
    // the job stays "running" to be resumed.
    spdlog::info("job {} stopped", row.id);
    return;
  } catch (const InputError& failure) {
    error = text_of(
        error_json("input", without_paths(failure.what()), without_paths(failure.problems())));
  } catch (const std::exception& failure) {
    if (const std::string reason = disk_.look(); !reason.empty()) {
      spdlog::warn("job {} stopped: {}", row.id, failure.what());
      return;  // still "running": it is resumed when there is room
    }
    error = text_of(error_json("environment", without_paths(failure.what()), {}));
  }
  store_.set_bytes(row.id, disk_bytes_of(place_of(row)));
  const std::optional<JobRow> ended = apply(row, event, error);
  spdlog::info("job {} {}", row.id, ended ? name_of(ended->state) : "was cancelled meanwhile");
}

std::vector<jobs::RunFailure> JobService::make_dataset(const JobRow& row,
                                                       const std::stop_token& stop) {
  const jobs::ResolvedJob job = jobs::read_resolved_job(row.spec_json, "");
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
  return jobs::run_job(folder, job, executor_, on_progress, stop);
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
