#include "jobs/queue/store/store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <random>
#include <utility>

#include "base/error.h"
#include "jobs/queue/store/job_id.h"
#include "jobs/queue/store/store_connections.h"
#include "jobs/queue/store/store_rows.h"

namespace throng::jobs {

namespace {

std::int64_t system_clock_ms() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
}

}  // namespace

Store::Store(const std::filesystem::path& folder, Clock clock, Clock steady)
    : clock_(clock ? std::move(clock) : Clock(&system_clock_ms)) {
  try {
    connections_ = std::make_unique<Connections>(folder, clock_, std::move(steady));
  } catch (const SQLite::Exception& error) {
    throw EnvironmentError(fmt::format("job store in {}: {}", folder.string(), error.what()));
  }
}

Store::~Store() = default;

std::string_view to_string(JobKind kind) {
  switch (kind) {
    case JobKind::calibration:
      return "calibration";
    case JobKind::study:
      return "study";
    case JobKind::dataset:
      break;
  }
  return "dataset";
}

Added Store::add(const NewJob& job) {
  Added added;
  connections_->write([&] {
    if (!job.key.empty()) {
      if (auto earlier = find_submission(connections_->writer, job.owner, job.key)) {
        const std::string hash = hash_of_submission(connections_->writer, earlier->id);
        added = {std::move(*earlier), false, hash == job.hash, {}};
        return;
      }
    }
    added.over_quota = over_quota(connections_->writer, job.owner, job.limits, job.planned_bytes);
    if (!added.over_quota.empty()) return;
    std::random_device random;
    JobRow row;
    row.created_ms = clock_();
    row.id = make_job_id(row.created_ms, connections_->last_id, random());
    row.kind = job.kind;
    row.name = job.name;
    row.spec_json = job.spec_json;
    row.priority = job.priority;
    row.labels = job.labels;
    row.owner = job.owner;
    row.load = job.load;
    row.sources_json = job.sources_json;
    row.planned_bytes = job.planned_bytes;
    insert_job(connections_->writer, row, job);
    write_event(connections_->writer, row.id, row.created_ms, "submitted", "{}");
    connections_->last_id = row.id;
    added = {std::move(row), true, true, {}};
  });
  return added;
}

void Store::check_files() const { connections_->require_files(); }

std::int64_t Store::service_ms() const { return connections_->service_clock.now_ms(); }

void Store::save_service_clock() {
  connections_->write([&] { save_mark(connections_->writer, {service_ms(), clock_()}); });
}

std::optional<JobRow> Store::apply(const JobRow& row, JobEvent event,
                                   const std::string& error_json) {
  const std::optional<JobState> next = next_state(row.state, event);
  if (!next) return std::nullopt;
  std::optional<JobRow> changed;
  connections_->write([&] {
    changed =
        move_to(connections_->writer, *next, row, event, error_json, {service_ms(), clock_()});
  });
  return changed;
}

Retried Store::retry(const JobRow& row, const OwnerLimits& limits) {
  const std::optional<JobState> next = next_state(row.state, JobEvent::retry);
  Retried retried;
  if (!next) return retried;
  connections_->write([&] {
    retried.over_quota = over_quota(connections_->writer, row.owner, limits,
                                    std::max<std::int64_t>(0, row.planned_bytes - row.bytes));
    if (!retried.over_quota.empty()) return;
    retried.row =
        move_to(connections_->writer, *next, row, JobEvent::retry, "", {service_ms(), clock_()});
  });
  return retried;
}

std::int64_t Store::bytes_of(const std::string& owner) const {
  return connections_->read(
      [&](SQLite::Database& database) { return owner_usage(database, owner).bytes; });
}

std::optional<JobRow> Store::change(const std::string& id, const JobChange& change) {
  std::optional<JobRow> changed;
  connections_->write([&] {
    const nlohmann::json list = change.labels;
    SQLite::Statement update(connections_->writer,
                             "UPDATE job SET priority = ?, labels = ?, keep = ? WHERE id = ?");
    update.bind(1, change.priority);
    update.bind(2, list.dump());
    update.bind(3, change.keep ? 1 : 0);
    update.bind(4, id);
    if (update.exec() == 0) return;
    changed = find_job(connections_->writer, id);
    const nlohmann::json data = {
        {"priority", change.priority}, {"labels", list}, {"keep", change.keep}};
    write_event(connections_->writer, id, clock_(), "changed", data.dump());
  });
  return changed;
}

void Store::set_bytes(const std::string& id, std::int64_t bytes) {
  connections_->write([&] {
    SQLite::Statement update(connections_->writer, "UPDATE job SET bytes = ? WHERE id = ?");
    update.bind(1, bytes);
    update.bind(2, id);
    update.exec();
  });
}

void Store::save_progress(const JobRow& row, const std::string& progress_json) {
  connections_->write([&] {
    SQLite::Statement update(
        connections_->writer,
        "UPDATE job SET progress = ? WHERE id = ? AND state = ? AND attempt = ?");
    update.bind(1, progress_json);
    update.bind(2, row.id);
    update.bind(3, std::string(to_string(row.state)));
    update.bind(4, row.attempt);
    update.exec();
  });
}

bool Store::remove(const std::string& id) {
  bool was_there = false;
  connections_->write([&] {
    SQLite::Statement job(connections_->writer, "DELETE FROM job WHERE id = ?");
    job.bind(1, id);
    was_there = job.exec() > 0;
    if (!was_there) return;
    SQLite::Statement events(connections_->writer, "DELETE FROM event WHERE job = ?");
    events.bind(1, id);
    events.exec();
    write_event(connections_->writer, id, clock_(), "removed", "{}");
  });
  return was_there;
}

}  // namespace throng::jobs
