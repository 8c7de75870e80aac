#include "server/catalog/queue_state.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"
#include "base/json/json_text.h"
#include "jobs/queue/workers/injected_faults.h"
#include "server/catalog/api_json.h"

namespace throng::server {

using namespace std::chrono_literals;
using jobs::JobEvent;
using jobs::JobRow;

namespace {

// Longer than a worker may take to end (jobs::LocalProcessesOptions::grace_s).
constexpr auto kMaxEnd = 20s;

}  // namespace

std::optional<JobRow> QueueState::apply(const JobRow& row, JobEvent event,
                                        const std::string& error_json) {
  const std::string place = fmt::format("server/{}/", to_string(event));
  jobs::inject_faults(place + "before", 1);
  std::optional<JobRow> changed = store_.apply(row, event, error_json);
  jobs::inject_faults(place + "after", 1);
  if (!changed) return changed;
  if (!is_active(changed->state)) count_end(*changed);
  notify_event();
  return changed;
}

void QueueState::count_end(const JobRow& ended) {
  const nlohmann::json error = parse_json_or_discard(ended.error_json);
  const std::string cause = error.is_object() ? error.value("kind", "") : "";
  ended_.add(prometheus_labels({{"state", to_string(ended.state)}, {"cause", cause}}));
}

void QueueState::drain() {
  const std::lock_guard lock(mutex_);
  is_draining_ = true;
  ++revision_;
}

bool QueueState::is_draining() const {
  const std::lock_guard lock(mutex_);
  return is_draining_;
}

jobs::Retried QueueState::retry(const JobRow& row, const jobs::OwnerLimits& limits) {
  const std::string place = fmt::format("server/{}/", to_string(JobEvent::retry));
  jobs::inject_faults(place + "before", 1);
  jobs::Retried retried = store_.retry(row, limits);
  jobs::inject_faults(place + "after", 1);
  if (retried.row) notify_event();
  return retried;
}

void QueueState::record_event(const JobRow& row, const std::string& type,
                              const std::string& data_json) {
  try {
    store_.record_event(row, type, data_json);
  } catch (const EnvironmentError& error) {
    spdlog::warn("job {}: {} not recorded: {}", row.id, type, error.what());
  }
  notify_event();
}

void QueueState::notify_event() {
  ++revision_;
  event_counter_.notify();
}

std::optional<JobRow> QueueState::begin(const std::function<std::optional<JobRow>()>& start,
                                        const std::stop_source& stop) {
  // Under the lock, so that a job that is removed has either not been begun or is active.
  const std::lock_guard lock(mutex_);
  if (!paused_.empty() || is_draining_) return std::nullopt;
  std::optional<JobRow> row = start();
  if (row) active_.insert_or_assign(row->id, Active{*row, stop});
  return row;
}

void QueueState::finish(const std::string& id) {
  {
    const std::lock_guard lock(mutex_);
    active_.erase(id);
    queued_ = true;  // there is room for another
  }
  changed_.notify_all();
}

std::vector<JobRow> QueueState::active_jobs() const {
  const std::lock_guard lock(mutex_);
  std::vector<JobRow> rows;
  rows.reserve(active_.size());
  for (const auto& [id, active] : active_) rows.push_back(active.row);
  return rows;
}

int QueueState::priority_of(const std::string& id) const {
  const std::lock_guard lock(mutex_);
  const auto found = active_.find(id);
  return found == active_.end() ? 0 : found->second.row.priority;
}

void QueueState::set_priority(const std::string& id, int priority) {
  const std::lock_guard lock(mutex_);
  const auto found = active_.find(id);
  if (found != active_.end()) found->second.row.priority = priority;
}

void QueueState::set_waiting(const std::string& id, const std::string& reason) {
  const std::lock_guard lock(mutex_);
  const auto found = active_.find(id);
  if (found != active_.end()) found->second.row.waiting_for = reason;
  ++revision_;
}

void QueueState::stop_work_on(const std::string& id) {
  const std::lock_guard lock(mutex_);
  if (const auto found = active_.find(id); found != active_.end()) {
    found->second.stop.request_stop();
  }
}

void QueueState::end_work_on(const std::string& id) {
  stop_work_on(id);
  std::unique_lock lock(mutex_);
  const auto is_at_work = [&] { return active_.contains(id); };
  if (!changed_.wait_for(lock, kMaxEnd, [&] { return !is_at_work(); })) {
    throw EnvironmentError("the job's workers do not end; the job is cancelled, try again later");
  }
}

void QueueState::set_progress(const JobRow& row, std::string progress_json) {
  const std::lock_guard lock(mutex_);
  const auto found = active_.find(row.id);
  if (found != active_.end()) found->second.row.progress_json = std::move(progress_json);
  ++revision_;
}

void QueueState::complete(JobRow& row) const {
  const std::lock_guard lock(mutex_);
  const auto found = active_.find(row.id);
  if (found != active_.end()) {
    const JobRow& newest = found->second.row;
    if (!newest.progress_json.empty()) row.progress_json = newest.progress_json;
    row.waiting_for = newest.waiting_for;
  }
  if (!is_active(row.state)) return;
  if (is_draining_) row.waiting_for = "the service is about to end";
  if (!paused_.empty()) row.waiting_for = paused_;
}

void QueueState::notify_queued() {
  {
    const std::lock_guard lock(mutex_);
    queued_ = true;
  }
  changed_.notify_all();
}

bool QueueState::wait_for_queued(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  const bool queued = changed_.wait(lock, stop, [&] { return queued_; });
  queued_ = false;
  return queued;
}

bool QueueState::wait_while_paused(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  return changed_.wait(lock, stop, [&] { return paused_.empty() && !is_draining_; });
}

void QueueState::wait(const std::stop_token& stop, std::chrono::milliseconds time) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, stop, time, [] { return false; });
}

void QueueState::pause(const std::string& reason) {
  std::vector<JobRow> stopped;
  {
    const std::lock_guard lock(mutex_);
    paused_ = reason;
    queued_ = true;
    // Published output stays; the rest is done again when there is disk space.
    for (auto& [id, active] : active_) {
      if (reason.empty()) continue;
      active.stop.request_stop();
      stopped.push_back(active.row);
    }
  }
  if (reason.empty()) {
    spdlog::info("queue: goes on");
  } else {
    spdlog::warn("queue: paused, {}", reason);
  }
  for (const JobRow& row : stopped) record_event(row, "paused", dump_text({{"reason", reason}}));
  changed_.notify_all();
  notify_event();
}

std::string QueueState::paused() const {
  const std::lock_guard lock(mutex_);
  return paused_;
}

}  // namespace throng::server
