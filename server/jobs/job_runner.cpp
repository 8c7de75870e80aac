#include "server/jobs/job_runner.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"
#include "base/resource_exhaustion.h"
#include "jobs/bucket/publish.h"
#include "jobs/queue/dataset/folder.h"
#include "jobs/queue/workers/attempts.h"
#include "server/catalog/api_json.h"
#include "server/catalog/calibrations.h"
#include "server/catalog/data_folder.h"
#include "server/jobs/study_work.h"
#include "spec/estimates/task_memory.h"
#include "spec/job/resolved_job.h"

namespace throng::server {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using jobs::JobEvent;
using jobs::JobRow;
using jobs::JobState;
using nlohmann::json;

namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kProgressInterval = 1s;
constexpr auto kPauseAfterError = 1s;
// Files are counted while a job runs, but for at most a twentieth of the time.
constexpr auto kMinBytesInterval = 10s;
constexpr int kMaxPartOfTime = 20;

/// Whether a job may be begun beside those that are active.
bool may_begin(const JobRow& row, const std::vector<JobRow>& active, int max_active) {
  if (static_cast<int>(active.size()) < max_active) return true;
  const bool is_first_of_owner = std::none_of(
      active.begin(), active.end(), [&](const JobRow& other) { return other.owner == row.owner; });
  const bool is_above_all = std::all_of(active.begin(), active.end(), [&](const JobRow& other) {
    return other.priority < row.priority;
  });
  return is_first_of_owner || is_above_all;
}

}  // namespace

JobRunner::JobRunner(const ServiceFolders& folders, jobs::Store& store, QueueState& state,
                     const Uploads& uploads, jobs::Executor& executor, LookAtDisk look_at_disk,
                     int max_active, const PublishTargets& publish_to)
    : folders_(folders),
      store_(store),
      state_(state),
      uploads_(uploads),
      executor_(executor),
      look_at_disk_(std::move(look_at_disk)),
      max_active_(max_active),
      publish_to_(publish_to),
      thread_([this](const std::stop_token& stop) { dispatch(stop); }) {}

void JobRunner::dispatch(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    join_ended();
    try {
      if (!state_.wait_while_paused(stop)) break;
      if (!begin_next()) state_.wait_for_queued(stop);
    } catch (const std::exception& error) {
      // The store cannot be reached (for example disk full): nothing is lost, try again.
      spdlog::error("queue: {}", error.what());
      state_.wait(stop, kPauseAfterError);
    }
  }
  for (Supervisor& supervisor : supervisors_) supervisor.stop.request_stop();
  supervisors_.clear();
}

void JobRunner::join_ended() {
  supervisors_.remove_if([](const Supervisor& supervisor) { return supervisor.has_ended.load(); });
}

std::optional<JobRow> JobRunner::next_job() const {
  const std::vector<JobRow> active = state_.active_jobs();
  const auto active_of = [&](const std::string& owner) {
    return std::count_if(active.begin(), active.end(),
                         [&](const JobRow& row) { return row.owner == owner; });
  };
  std::optional<JobRow> best;
  for (JobRow& row : store_.startable()) {
    if (row.state == JobState::running) {
      const bool is_at_work = std::any_of(active.begin(), active.end(),
                                          [&](const JobRow& other) { return other.id == row.id; });
      if (!is_at_work) return std::move(row);  // it was running when the last server ended
      continue;
    }
    if (!may_begin(row, active, max_active_)) continue;
    const auto rank = [&](const JobRow& of) {
      return std::tuple(-of.priority, active_of(of.owner), of.id);
    };
    if (!best || rank(row) < rank(*best)) best = std::move(row);
  }
  return best;
}

bool JobRunner::begin_next() {
  const std::optional<JobRow> next = next_job();
  if (!next) return false;
  const bool resumed = next->state == JobState::running;
  std::stop_source stop;
  const std::optional<JobRow> row = state_.begin(
      [&] { return state_.apply(*next, resumed ? JobEvent::resume : JobEvent::start); }, stop);
  if (!row) return true;
  spdlog::info("job {} {}", row->id, resumed ? "resumed" : "started");
  Supervisor& supervisor = supervisors_.emplace_back();
  supervisor.stop = stop;
  try {
    supervisor.thread = std::jthread([this, row = *row, &supervisor] {
      work_on(row, supervisor.stop.get_token());
      supervisor.has_ended = true;
    });
  } catch (const std::exception&) {  // the machine has no room for a thread
    supervisors_.pop_back();
    state_.finish(row->id);
    throw;
  }
  return true;
}

void JobRunner::work_on(const JobRow& row, const std::stop_token& stop) {
  try {
    run(row, stop);
  } catch (const std::exception& error) {
    spdlog::error("job {}: {}", row.id, error.what());
    state_.wait(stop, kPauseAfterError);  // it is still "running", and taken up again
  }
  state_.finish(row.id);
}

void JobRunner::run(const JobRow& row, const std::stop_token& stop) {
  JobEvent event = JobEvent::fail;
  std::string error;
  try {
    uploads_.require_same_sources(row);
    std::vector<jobs::RunFailure> failures;
    if (row.kind == jobs::JobKind::calibration) {
      make_calibration(row, stop);
    } else if (row.kind == jobs::JobKind::study) {
      make_study(row, stop);
    } else {
      failures = make_dataset(row, stop);
    }
    save_progress(row);
    event = failures.empty() ? JobEvent::succeed : JobEvent::succeed_partly;
    for (jobs::RunFailure& failure : failures)
      failure.message = folders_.without_paths(failure.message);
    if (!failures.empty()) error = dump_text(partial_error_json(failures));
  } catch (const Cancelled&) {
    // By cancel() or remove(), which have noted it; or because the service ends or rests, and then
    // the job stays "running" to be resumed.
    spdlog::info("job {} stopped", row.id);
    save_bytes(row);
    return fail_if_too_large(row);
  } catch (const InputError& failure) {
    error = dump_text(error_json("input", folders_.without_paths(failure.what()),
                                 folders_.without_paths(failure.problems())));
  } catch (const std::exception& failure) {
    const bool may_pass = is_resource_exhaustion(failure) ||
                          dynamic_cast<const jobs::StoreUnavailable*>(&failure) != nullptr;
    if (may_pass) throw;  // it is still "running", and taken up again
    if (const std::string reason = look_at_disk_(); !reason.empty()) {
      spdlog::warn("job {} stopped: {}", row.id, failure.what());
      save_bytes(row);
      return fail_if_too_large(row);  // else it is resumed when there is free space
    }
    error = dump_text(error_json("environment", folders_.without_paths(failure.what()), {}));
  }
  store_.set_bytes(row.id, measure_disk_bytes(folders_.ground_truth_folder(row)));
  const std::optional<JobRow> ended = state_.apply(row, event, error);
  {
    const std::lock_guard lock(stops_mutex_);
    stops_by_full_disk_.erase(row.id);
  }
  spdlog::info("job {} {}", row.id, ended ? to_string(ended->state) : "was cancelled meanwhile");
}

// A job that does not fit would fill the disk again and again, and stop the tasks of all others
// each time. It is the one that has written most; once may be the fault of others.
void JobRunner::fail_if_too_large(const JobRow& row) {
  constexpr int kMaxStops = 2;
  constexpr double kGib = 1 << 30;
  const std::string reason = state_.paused();
  if (!reason.starts_with(kDiskIsFull)) return;
  const auto bytes_of = [this](const JobRow& job) {
    const auto stored = store_.get(job.id);
    return stored ? stored->bytes : 0;
  };
  const std::int64_t own = bytes_of(row);
  const std::vector<JobRow> active = state_.active_jobs();
  const bool is_largest = std::none_of(active.begin(), active.end(),
                                       [&](const JobRow& job) { return bytes_of(job) > own; });
  {
    const std::lock_guard lock(stops_mutex_);
    if (!is_largest || ++stops_by_full_disk_[row.id] < kMaxStops) return;
    stops_by_full_disk_.erase(row.id);
  }
  const std::string message = fmt::format(
      "the disk is too small for this job: it has filled it {} times, and has written {:.2f} GiB, "
      "estimated at {:.2f} GiB ({}). Free some space or ask for less, and retry",
      kMaxStops, static_cast<double>(own) / kGib, static_cast<double>(row.planned_bytes) / kGib,
      reason);
  const auto now = store_.get(row.id);
  if (!now || now->state != JobState::running) return;
  // Before the job may be tried again.
  std::error_code ignored;
  fs::remove_all(folders_.ground_truth_folder(row) / "work", ignored);
  save_bytes(row);
  spdlog::warn("job {} failed: {}", row.id, message);
  state_.apply(row, JobEvent::fail, dump_text(error_json("environment", message, {})));
}

jobs::Share JobRunner::share_of(const JobRow& row) const {
  jobs::Share share;
  share.owner = row.owner;
  share.job = row.id;
  share.priority = [this, id = row.id] { return state_.priority_of(id); };
  share.on_wait = [this, id = row.id](const std::string& reason) {
    state_.set_waiting(id, reason);
  };
  return share;
}

// The operator may have withdrawn what was allowed when the job was submitted. A bucket that cannot
// be used shall not be found after hours of work.
void JobRunner::require_target(const jobs::JobSpec& job, const jobs::JobFolder& folder,
                               const std::stop_token& stop) const {
  const std::string& address = job.outputs.publish;
  publish_to_.require(address);
  if (address.empty() || folder.is_done({jobs::Task::Kind::collect})) return;
  bucket::check_target(bucket::parse_address(address, "", "/outputs/publish"), stop);
}

std::vector<jobs::RunFailure> JobRunner::make_dataset(const JobRow& row,
                                                      const std::stop_token& stop) {
  const jobs::ResolvedJob job = jobs::read_resolved_job(row.spec_json, "");
  const auto folder = jobs::JobFolder::restore(folders_.job_folder(row.id), job);
  require_target(job.spec(), folder, stop);
  Clock::time_point last_save;
  Clock::time_point next_bytes = Clock::now() + kMinBytesInterval;
  std::string stages;
  const auto on_progress = [&](const jobs::JobProgress& progress) {
    state_.set_progress(row, dump_text(progress_json(progress)));
    if (const std::string now = dump_text(stages_json(progress)); now != stages) {
      stages = now;
      state_.record_event(row, "stage", stages);
    }
    const auto now = Clock::now();
    if (now - last_save < kProgressInterval) return;
    last_save = now;
    save_progress(row);
    if (now < next_bytes) return;
    save_bytes(row);
    const auto took = Clock::now() - now;
    next_bytes = now + std::max<Clock::duration>(kMinBytesInterval, kMaxPartOfTime * took);
  };
  jobs::Share share = share_of(row);
  share.memory_mib = [memory = jobs::TaskMemory(job.spec(), row.load)](const jobs::Task& task) {
    return memory.mib_of(task);
  };
  share.speed_file = folders_.speed_file();
  return jobs::run_job(folder, job, executor_, on_progress, stop, share);
}

void JobRunner::make_calibration(const JobRow& row, const std::stop_token& stop) {
  const jobs::JobFolder folder(folders_.calibration_folder(row.id));
  constexpr jobs::Task kTask{jobs::Task::Kind::calibrate};
  const auto set_progress = [&](double share, const std::string& what) {
    state_.set_progress(row, dump_text({{"share", share}, {"stage", what}}));
  };
  if (!folder.is_done(kTask)) {
    const std::array tasks = {kTask};
    const auto on_progress = [&](const jobs::Task&, const jobs::TaskProgress& progress) {
      set_progress(progress.total > 0 ? progress.done / progress.total : 0, progress.what);
    };
    jobs::Share share = share_of(row);
    share.memory_mib = [mib = Calibrations::estimate_memory_mib(folder.path())](const jobs::Task&) {
      return mib;
    };
    const jobs::TaskResult result = executor_.run(folder, tasks, on_progress, stop, share).at(0);
    folder.remove_leftovers();
    if (stop.stop_requested()) throw Cancelled();
    if (result.outcome == jobs::Outcome::input_error && !result.problems.empty()) {
      throw InputError(result.problems);
    }
    if (result.outcome != jobs::Outcome::succeeded) throw EnvironmentError(result.message);
  }
  jobs::end_all_attempts(folder);
  set_progress(1, "finished");
}

void JobRunner::make_study(const JobRow& row, const std::stop_token& stop) {
  Clock::time_point last_save;
  Clock::time_point next_bytes = Clock::now() + kMinBytesInterval;
  const auto on_progress = [&](const json& progress) {
    state_.set_progress(row, dump_text(progress));
    const auto now = Clock::now();
    if (now - last_save < kProgressInterval) return;
    last_save = now;
    save_progress(row);
    if (now < next_bytes) return;
    save_bytes(row);
    const auto took = Clock::now() - now;
    next_bytes = now + std::max<Clock::duration>(kMinBytesInterval, kMaxPartOfTime * took);
  };
  work_on_study(folders_.study_folder(row.id), executor_, share_of(row), on_progress, stop);
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

// The disk space of a job counts for its owner's quota from its first file on, also when it is
// cancelled.
void JobRunner::save_bytes(const JobRow& row) {
  try {
    store_.set_bytes(row.id, measure_disk_bytes(folders_.ground_truth_folder(row)));
  } catch (const std::exception& error) {
    spdlog::warn("job {}: its files were not counted: {}", row.id, error.what());
  }
}

}  // namespace throng::server
