#include "server/job_runner.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "base/error.h"
#include "jobs/queue/folder.h"
#include "jobs/spec/resolved_job.h"
#include "server/answers.h"
#include "server/data_folder.h"

namespace throng::server {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using jobs::JobEvent;
using jobs::JobRow;
using jobs::JobState;

namespace {

constexpr auto kProgressInterval = 1s;
constexpr auto kPauseAfterError = 1s;

}  // namespace

JobRunner::JobRunner(const ServiceFolders& folders, jobs::Store& store, QueueState& state,
                     jobs::Executor& executor, Calibrator calibrator, LookAtDisk look_at_disk)
    : folders_(folders),
      store_(store),
      state_(state),
      executor_(executor),
      calibrator_(std::move(calibrator)),
      look_at_disk_(std::move(look_at_disk)),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

void JobRunner::work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    try {
      if (!state_.wait_while_paused(stop)) return;
      if (!work_on_next(stop)) state_.wait_for_queued(stop);
    } catch (const std::exception& error) {
      // The store cannot be reached (for example disk full): nothing is lost, try again.
      spdlog::error("queue: {}", error.what());
      state_.wait(stop, kPauseAfterError);
    }
  }
}

bool JobRunner::work_on_next(const std::stop_token& stop) {
  const std::optional<JobRow> next = store_.next();
  if (!next) return false;
  const bool resumed = next->state == JobState::running;
  std::stop_source stop_job;
  const std::optional<JobRow> row = state_.begin(
      [&] { return state_.apply(*next, resumed ? JobEvent::resume : JobEvent::start); }, stop_job);
  if (!row) return true;
  spdlog::info("job {} {}", row->id, resumed ? "resumed" : "started");
  const std::stop_callback forward(stop, [&] { stop_job.request_stop(); });
  try {
    run(*row, stop_job.get_token());
  } catch (...) {
    state_.finish();
    throw;
  }
  state_.finish();
  return true;
}

void JobRunner::run(const JobRow& row, const std::stop_token& stop) {
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
    for (jobs::RunFailure& failure : failures)
      failure.message = folders_.without_paths(failure.message);
    if (!failures.empty()) error = text_of(partial_error_json(failures));
  } catch (const Cancelled&) {
    // By cancel() or remove(), which have noted it; or because the service ends or rests, and then
    // the job stays "running" to be resumed.
    spdlog::info("job {} stopped", row.id);
    return;
  } catch (const InputError& failure) {
    error = text_of(error_json("input", folders_.without_paths(failure.what()),
                               folders_.without_paths(failure.problems())));
  } catch (const std::exception& failure) {
    if (const std::string reason = look_at_disk_(); !reason.empty()) {
      spdlog::warn("job {} stopped: {}", row.id, failure.what());
      return;  // still "running": it is resumed when there is free space
    }
    error = text_of(error_json("environment", folders_.without_paths(failure.what()), {}));
  }
  store_.set_bytes(row.id, disk_bytes_of(folders_.folder_of(row)));
  const std::optional<JobRow> ended = state_.apply(row, event, error);
  spdlog::info("job {} {}", row.id, ended ? name_of(ended->state) : "was cancelled meanwhile");
}

std::vector<jobs::RunFailure> JobRunner::make_dataset(const JobRow& row,
                                                      const std::stop_token& stop) {
  const jobs::ResolvedJob job = jobs::read_resolved_job(row.spec_json, "");
  const auto folder = jobs::JobFolder::create(folders_.job_folder(row.id), job);
  auto last_save = std::chrono::steady_clock::time_point();
  std::string stages;
  const auto on_progress = [&](const jobs::JobProgress& progress) {
    state_.set_progress(row, text_of(progress_json(progress)));
    if (const std::string now = text_of(stages_json(progress)); now != stages) {
      stages = now;
      state_.record_event(row, "stage", stages);
    }
    const auto now = std::chrono::steady_clock::now();
    if (now - last_save < kProgressInterval) return;
    last_save = now;
    save_progress(row);
  };
  return jobs::run_job(folder, job, executor_, on_progress, stop);
}

void JobRunner::make_calibration(const JobRow& row, const std::stop_token& stop) {
  const fs::path folder = folders_.calibration_folder(row.id);
  const auto set_progress = [&](double share, const std::string& what) {
    state_.set_progress(row, text_of({{"share", share}, {"stage", what}}));
  };
  calibrator_(folder, set_progress, stop);
  set_progress(1, "finished");
}

// Progress is worth no job: when it cannot be saved now, it will be a second later.
void JobRunner::save_progress(const JobRow& row) {
  try {
    JobRow newest = store_.get(row.id).value_or(row);
    state_.complete(newest);
    store_.save_progress(row, newest.progress_json);
  } catch (const EnvironmentError& error) {
    spdlog::warn("job {}: progress not saved: {}", row.id, error.what());
  }
}

}  // namespace throng::server
