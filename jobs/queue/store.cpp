#include "jobs/queue/store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <sys/stat.h>

#include <chrono>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <random>
#include <utility>

#include "base/error.h"
#include "jobs/queue/folder_lock.h"
#include "jobs/queue/group_commit.h"
#include "jobs/queue/job_id.h"
#include "jobs/queue/store_rows.h"
#include "jobs/queue/store_schema.h"

namespace throng::jobs {

namespace fs = std::filesystem;

namespace {

constexpr int kBusyTimeoutMs = 5000;

std::int64_t system_clock_ms() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
}

fs::path created(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw EnvironmentError(fmt::format("cannot create {}: {}", folder.string(), error.message()));
  }
  return folder;
}

std::string text(std::string_view view) { return std::string(view); }

}  // namespace

// One connection writes; another reads, so that readers never wait for the disk.
struct Store::Connections {
  explicit Connections(const fs::path& folder)
      : lock(created(folder), "lock", "data folder"),
        file(folder / "jobs.sqlite"),
        writer(folder / "jobs.sqlite", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE,
               kBusyTimeoutMs),
        reader((prepare(writer), folder / "jobs.sqlite"), SQLite::OPEN_READWRITE, kBusyTimeoutMs),
        commits(writer) {
    reader.exec("PRAGMA query_only = ON");
    SQLite::Statement newest(writer, "SELECT max(id) FROM job");
    newest.executeStep();
    last_id = newest.getColumn(0).getString();
    identity = identity_of(file);
  }

  /// Device and number of a file; nothing when there is none.
  static std::optional<std::pair<dev_t, ino_t>> identity_of(const fs::path& file) {
    struct stat status {};
    if (::stat(file.c_str(), &status) != 0) return std::nullopt;
    return std::pair(status.st_dev, status.st_ino);
  }

  /// Changes of a file that somebody has removed are lost when the service ends.
  void require_files() const {
    if (identity_of(file) == identity && lock.is_in_place()) return;
    throw EnvironmentError(
        "job store: its file or its lock was removed while the service ran; nothing is accepted "
        "until they are put back and the service is started again");
  }

  static void prepare(SQLite::Database& database) {
    database.exec("PRAGMA journal_mode = WAL");
    database.exec("PRAGMA synchronous = FULL");
    prepare_tables(database);
  }

  // SQLite's errors are the machine's: disk full, file damaged, locked for too long.
  template <typename Action>
  auto read(const Action& action) {
    const std::lock_guard guard(reader_mutex);
    try {
      return action(reader);
    } catch (const SQLite::Exception& error) {
      throw EnvironmentError(fmt::format("job store: {}", error.what()));
    }
  }

  void write(const std::function<void()>& change) {
    require_files();
    try {
      commits.run(change);
    } catch (const SQLite::Exception& error) {
      throw EnvironmentError(fmt::format("job store: {}", error.what()));
    }
  }

  void write_event(const std::string& job, std::int64_t at_ms, const std::string& type,
                   const std::string& data_json) {
    SQLite::Statement insert(writer,
                             "INSERT INTO event (job, at_ms, type, data) VALUES (?, ?, ?, ?)");
    insert.bind(1, job);
    insert.bind(2, at_ms);
    insert.bind(3, type);
    insert.bind(4, data_json);
    insert.exec();
  }

  /// The row as the changes of this commit have left it.
  std::optional<JobRow> find(const std::string& id) {
    SQLite::Statement query(writer, fmt::format("SELECT {} FROM job WHERE id = ?", kColumns));
    query.bind(1, id);
    return first_of(query);
  }

  /// Moves a job to its next state if it is still as in `row`; returns the new row.
  std::optional<JobRow> move_to(JobState next, const JobRow& row, JobEvent event,
                                const std::string& error_json, std::int64_t now_ms) {
    JobRow changed = row;
    changed.state = next;
    changed.attempt += event == JobEvent::start || event == JobEvent::resume ? 1 : 0;
    if (event == JobEvent::start) changed.started_ms = now_ms;
    changed.ended_ms = is_active(next) ? 0 : now_ms;
    changed.error_json = error_json;
    SQLite::Statement update(writer,
                             "UPDATE job SET state = ?, attempt = ?, error = ?, started_ms = ?, "
                             "ended_ms = ? WHERE id = ? AND state = ? AND attempt = ?");
    update.bind(1, text(name_of(changed.state)));
    update.bind(2, changed.attempt);
    update.bind(3, changed.error_json);
    update.bind(4, changed.started_ms);
    update.bind(5, changed.ended_ms);
    update.bind(6, row.id);
    update.bind(7, text(name_of(row.state)));
    update.bind(8, row.attempt);
    if (update.exec() == 0) return std::nullopt;
    const nlohmann::json data = {{"state", name_of(next)}, {"attempt", changed.attempt}};
    write_event(row.id, now_ms, text(name_of(event)), data.dump());
    return changed;
  }

  std::optional<JobRow> find_submission(const std::string& owner, const std::string& key) {
    SQLite::Statement query(
        writer, fmt::format("SELECT {} FROM job WHERE owner = ? AND submission_key = ?", kColumns));
    query.bind(1, owner);
    query.bind(2, key);
    return first_of(query);
  }

  FolderLock lock;
  fs::path file;
  std::optional<std::pair<dev_t, ino_t>> identity;
  std::mutex reader_mutex;
  SQLite::Database writer;  ///< only within write()
  SQLite::Database reader;
  GroupCommit commits;
  std::string last_id;  ///< only within write()
};

Store::Store(const fs::path& folder, Clock clock)
    : clock_(clock ? std::move(clock) : Clock(&system_clock_ms)) {
  try {
    connections_ = std::make_unique<Connections>(folder);
  } catch (const SQLite::Exception& error) {
    throw EnvironmentError(fmt::format("job store in {}: {}", folder.string(), error.what()));
  }
}

Store::~Store() = default;

std::string_view name_of(JobKind kind) {
  return kind == JobKind::calibration ? "calibration" : "dataset";
}

Added Store::add(const NewJob& job) {
  Added added;
  connections_->write([&] {
    if (!job.key.empty()) {
      if (auto earlier = connections_->find_submission(job.owner, job.key)) {
        const std::string hash = hash_of_submission(connections_->writer, earlier->id);
        added = {std::move(*earlier), false, hash == job.hash, {}};
        return;
      }
    }
    added.over_quota = over_quota(connections_->writer, job.owner, job.limits);
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
    insert_job(connections_->writer, row, job);
    connections_->write_event(row.id, row.created_ms, "submitted", "{}");
    connections_->last_id = row.id;
    added = {std::move(row), true, true, {}};
  });
  return added;
}

std::optional<JobRow> Store::get(const std::string& id) const {
  return connections_->read([&](SQLite::Database& database) {
    SQLite::Statement query(database, fmt::format("SELECT {} FROM job WHERE id = ?", kColumns));
    query.bind(1, id);
    return first_of(query);
  });
}

std::vector<JobRow> Store::list(const JobFilter& filter) const {
  std::string where = "kind = :kind";
  if (!filter.after.empty()) where += filter.oldest_first ? " AND id > :after" : " AND id < :after";
  if (!filter.states.empty()) {
    std::vector<std::string> names;
    for (const JobState state : filter.states) names.push_back(fmt::format("'{}'", name_of(state)));
    where += fmt::format(" AND state IN ({})", fmt::join(names, ", "));
  }
  if (!filter.label.empty()) {
    where +=
        " AND EXISTS (SELECT 1 FROM json_each(CASE WHEN json_valid(labels) THEN labels ELSE '[]' "
        "END) WHERE value = :label)";
  }
  if (!filter.name_part.empty()) where += " AND instr(lower(name), lower(:name)) > 0";
  return connections_->read([&](SQLite::Database& database) {
    SQLite::Statement query(
        database, fmt::format("SELECT {} FROM job WHERE {} ORDER BY id {} LIMIT :limit", kColumns,
                              where, filter.oldest_first ? "ASC" : "DESC"));
    query.bind(":kind", text(name_of(filter.kind)));
    if (!filter.after.empty()) query.bind(":after", filter.after);
    if (!filter.label.empty()) query.bind(":label", filter.label);
    if (!filter.name_part.empty()) query.bind(":name", filter.name_part);
    query.bind(":limit", filter.limit);
    return rows_of(query);
  });
}

void Store::check_files() const { connections_->require_files(); }

std::map<JobState, std::int64_t> Store::count() const {
  return connections_->read([&](SQLite::Database& database) {
    std::map<JobState, std::int64_t> counts;
    for (const JobState state : kJobStates) counts[state] = 0;
    SQLite::Statement query(database, "SELECT state, count(*) FROM job GROUP BY state");
    while (query.executeStep()) {
      const auto state = job_state_named(query.getColumn(0).getString());
      counts[state.value_or(JobState::failed)] += query.getColumn(1).getInt64();
    }
    return counts;
  });
}

std::vector<JobRow> Store::startable() const {
  return connections_->read([&](SQLite::Database& database) {
    SQLite::Statement running(
        database, fmt::format("SELECT {} FROM job WHERE state = 'running' ORDER BY id", kColumns));
    std::vector<JobRow> rows = rows_of(running);
    SQLite::Statement queued(
        database,
        fmt::format("SELECT {} FROM job WHERE id IN (SELECT id FROM (SELECT id, row_number() OVER "
                    "(PARTITION BY owner ORDER BY priority DESC, id) AS place FROM job WHERE state "
                    "= 'queued') WHERE place = 1) ORDER BY priority DESC, id",
                    kColumns));
    for (JobRow& row : rows_of(queued)) rows.push_back(std::move(row));
    return rows;
  });
}

std::optional<JobRow> Store::apply(const JobRow& row, JobEvent event,
                                   const std::string& error_json) {
  const std::optional<JobState> next = next_state(row.state, event);
  if (!next) return std::nullopt;
  std::optional<JobRow> changed;
  connections_->write(
      [&] { changed = connections_->move_to(*next, row, event, error_json, clock_()); });
  return changed;
}

Retried Store::retry(const JobRow& row, const OwnerLimits& limits) {
  const std::optional<JobState> next = next_state(row.state, JobEvent::retry);
  Retried retried;
  if (!next) return retried;
  connections_->write([&] {
    retried.over_quota = over_quota(connections_->writer, row.owner, limits);
    if (!retried.over_quota.empty()) return;
    retried.row = connections_->move_to(*next, row, JobEvent::retry, "", clock_());
  });
  return retried;
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
    changed = connections_->find(id);
    const nlohmann::json data = {
        {"priority", change.priority}, {"labels", list}, {"keep", change.keep}};
    connections_->write_event(id, clock_(), "changed", data.dump());
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

std::vector<JobRow> Store::ended(int limit) const {
  return connections_->read([&](SQLite::Database& database) {
    SQLite::Statement query(database,
                            fmt::format("SELECT {} FROM job WHERE ended_ms > 0 AND keep = 0 "
                                        "ORDER BY ended_ms LIMIT ?",
                                        kColumns));
    query.bind(1, limit);
    return rows_of(query);
  });
}

void Store::correct_ended(std::int64_t now_ms) {
  connections_->write([&] {
    SQLite::Statement update(connections_->writer,
                             "UPDATE job SET ended_ms = ? WHERE ended_ms > ?");
    update.bind(1, now_ms);
    update.bind(2, now_ms);
    update.exec();
  });
}

std::int64_t Store::total_bytes() const {
  return connections_->read([&](SQLite::Database& database) -> std::int64_t {
    SQLite::Statement query(database, "SELECT coalesce(sum(bytes), 0) FROM job");
    query.executeStep();
    return query.getColumn(0);
  });
}

int Store::forget_events(std::int64_t before_ms) {
  int forgotten = 0;
  connections_->write([&] {
    SQLite::Statement remove(connections_->writer,
                             "DELETE FROM event WHERE type = 'removed' AND at_ms < ?");
    remove.bind(1, before_ms);
    forgotten = remove.exec();
  });
  return forgotten;
}

void Store::save_progress(const JobRow& row, const std::string& progress_json) {
  connections_->write([&] {
    SQLite::Statement update(
        connections_->writer,
        "UPDATE job SET progress = ? WHERE id = ? AND state = ? AND attempt = ?");
    update.bind(1, progress_json);
    update.bind(2, row.id);
    update.bind(3, text(name_of(row.state)));
    update.bind(4, row.attempt);
    update.exec();
  });
}

void Store::record_event(const JobRow& row, const std::string& type, const std::string& data_json) {
  connections_->write([&] {
    const auto now = connections_->find(row.id);
    if (!now || now->state != row.state || now->attempt != row.attempt) return;
    connections_->write_event(row.id, clock_(), type, data_json);
  });
}

std::vector<EventRow> Store::events(const std::string& job, std::int64_t after, int limit) const {
  return connections_->read([&](SQLite::Database& database) {
    SQLite::Statement query(
        database, fmt::format("SELECT seq, job, at_ms, type, data FROM event WHERE seq > :after {} "
                              "ORDER BY seq LIMIT :limit",
                              job.empty() ? "" : "AND job = :job"));
    query.bind(":after", after);
    query.bind(":limit", limit);
    if (!job.empty()) query.bind(":job", job);
    std::vector<EventRow> rows;
    while (query.executeStep()) {
      rows.push_back({query.getColumn(0).getInt64(), query.getColumn(1).getString(),
                      query.getColumn(2).getInt64(), query.getColumn(3).getString(),
                      query.getColumn(4).getString()});
    }
    return rows;
  });
}

std::int64_t Store::last_event() const {
  return connections_->read([&](SQLite::Database& database) -> std::int64_t {
    SQLite::Statement query(database, "SELECT coalesce(max(seq), 0) FROM event");
    query.executeStep();
    return query.getColumn(0);
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
    connections_->write_event(id, clock_(), "removed", "{}");
  });
  return was_there;
}

}  // namespace throng::jobs
