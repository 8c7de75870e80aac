#include "jobs/store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <mutex>
#include <random>

#include "base/error.h"
#include "jobs/job_id.h"

namespace throng::jobs {

namespace fs = std::filesystem;

namespace {

constexpr int kSchemaVersion = 2;
constexpr int kBusyTimeoutMs = 5000;

constexpr const char* kTables = R"(
CREATE TABLE IF NOT EXISTS job (
  id TEXT PRIMARY KEY,
  name TEXT NOT NULL,
  state TEXT NOT NULL CHECK (state IN ('queued', 'running', 'succeeded', 'failed', 'cancelled')),
  attempt INTEGER NOT NULL DEFAULT 0,
  spec TEXT NOT NULL,
  progress TEXT NOT NULL DEFAULT '',
  error TEXT NOT NULL DEFAULT '',
  created_ms INTEGER NOT NULL,
  started_ms INTEGER NOT NULL DEFAULT 0,
  ended_ms INTEGER NOT NULL DEFAULT 0,
  kind TEXT NOT NULL DEFAULT 'dataset'
) WITHOUT ROWID;
CREATE INDEX IF NOT EXISTS job_by_state ON job (state, id);
)";

/// Version 1 knew datasets only.
constexpr const char* kFromVersion1 =
    "ALTER TABLE job ADD COLUMN kind TEXT NOT NULL DEFAULT 'dataset'";

constexpr const char* kColumns =
    "id, name, state, attempt, spec, progress, error, created_ms, started_ms, ended_ms, kind";

std::int64_t system_clock_ms() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::milliseconds>(now).count();
}

// Held while the store is open, so that no second server works in the same folder.
class FolderLock {
 public:
  explicit FolderLock(const fs::path& folder) {
    const fs::path file = folder / "lock";
    constexpr int kMode = 0644;
    descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kMode);
    if (descriptor_ < 0) {
      throw EnvironmentError(
          fmt::format("cannot open {}: {}", file.string(), std::strerror(errno)));
    }
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      ::close(descriptor_);
      throw EnvironmentError(
          fmt::format("another server uses the data folder {}", folder.string()));
    }
  }
  ~FolderLock() { ::close(descriptor_); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;
};

fs::path created(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw EnvironmentError(fmt::format("cannot create {}: {}", folder.string(), error.message()));
  }
  return folder;
}

JobRow row_of(SQLite::Statement& query) {
  JobRow row;
  row.id = query.getColumn(0).getString();
  row.name = query.getColumn(1).getString();
  const auto state = job_state_named(query.getColumn(2).getString());
  check(state.has_value(), "the table holds known states only");
  row.state = *state;
  row.attempt = query.getColumn(3);
  row.spec_json = query.getColumn(4).getString();
  row.progress_json = query.getColumn(5).getString();
  row.error_json = query.getColumn(6).getString();
  row.created_ms = query.getColumn(7);
  row.started_ms = query.getColumn(8);
  row.ended_ms = query.getColumn(9);
  const bool calibration = query.getColumn(10).getString() == name_of(JobKind::calibration);
  row.kind = calibration ? JobKind::calibration : JobKind::dataset;
  return row;
}

std::string text(std::string_view view) { return std::string(view); }

}  // namespace

// One connection writes; another reads, so that readers never wait for the disk.
struct Store::Connections {
  explicit Connections(const fs::path& folder)
      : lock(created(folder)),
        writer(folder / "jobs.sqlite", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE,
               kBusyTimeoutMs),
        reader((prepare(writer), folder / "jobs.sqlite"), SQLite::OPEN_READWRITE, kBusyTimeoutMs) {
    reader.exec("PRAGMA query_only = ON");
    SQLite::Statement newest(writer, "SELECT max(id) FROM job");
    newest.executeStep();
    last_id = newest.getColumn(0).getString();
  }

  static void prepare(SQLite::Database& database) {
    database.exec("PRAGMA journal_mode = WAL");
    database.exec("PRAGMA synchronous = FULL");
    const int version = database.execAndGet("PRAGMA user_version");
    if (version > kSchemaVersion) {
      throw EnvironmentError(fmt::format("the job store has version {}, this program knows {}",
                                         version, kSchemaVersion));
    }
    SQLite::Transaction transaction(database);
    if (version == 1) database.exec(kFromVersion1);
    database.exec(kTables);
    database.exec(fmt::format("PRAGMA user_version = {}", kSchemaVersion));
    transaction.commit();
  }

  FolderLock lock;
  std::mutex writer_mutex;
  std::mutex reader_mutex;
  SQLite::Database writer;
  SQLite::Database reader;
  std::string last_id;  ///< guarded by writer_mutex
};

namespace {

// SQLite's errors are the machine's: disk full, file damaged, locked for too long.
template <typename Action>
auto with_database(std::mutex& mutex, const Action& action) {
  const std::lock_guard lock(mutex);
  try {
    return action();
  } catch (const SQLite::Exception& error) {
    throw EnvironmentError(fmt::format("job store: {}", error.what()));
  }
}

}  // namespace

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

JobRow Store::add(const std::string& name, const std::string& spec_json, JobKind kind) {
  return with_database(connections_->writer_mutex, [&] {
    std::random_device random;
    JobRow row;
    row.created_ms = clock_();
    row.id = make_job_id(row.created_ms, connections_->last_id, random());
    row.kind = kind;
    row.name = name;
    row.spec_json = spec_json;
    SQLite::Statement insert(connections_->writer,
                             "INSERT INTO job (id, name, state, spec, created_ms, kind) VALUES (?, "
                             "?, 'queued', ?, ?, ?)");
    insert.bind(1, row.id);
    insert.bind(2, name);
    insert.bind(3, spec_json);
    insert.bind(4, row.created_ms);
    insert.bind(5, text(name_of(kind)));
    insert.exec();
    connections_->last_id = row.id;
    return row;
  });
}

std::optional<JobRow> Store::get(const std::string& id) const {
  return with_database(connections_->reader_mutex, [&]() -> std::optional<JobRow> {
    SQLite::Statement query(connections_->reader,
                            fmt::format("SELECT {} FROM job WHERE id = ?", kColumns));
    query.bind(1, id);
    if (!query.executeStep()) return std::nullopt;
    return row_of(query);
  });
}

std::vector<JobRow> Store::list(int limit, const std::string& after, JobKind kind) const {
  return with_database(connections_->reader_mutex, [&] {
    SQLite::Statement query(
        connections_->reader,
        fmt::format("SELECT {} FROM job WHERE kind = ?3 AND (?1 = '' OR id < ?1) ORDER BY id DESC "
                    "LIMIT ?2",
                    kColumns));
    query.bind(1, after);
    query.bind(2, limit);
    query.bind(3, text(name_of(kind)));
    std::vector<JobRow> rows;
    while (query.executeStep()) rows.push_back(row_of(query));
    return rows;
  });
}

std::optional<JobRow> Store::next() const {
  return with_database(connections_->reader_mutex, [&]() -> std::optional<JobRow> {
    for (const char* state : {"running", "queued"}) {
      SQLite::Statement query(
          connections_->reader,
          fmt::format("SELECT {} FROM job WHERE state = ? ORDER BY id LIMIT 1", kColumns));
      query.bind(1, state);
      if (query.executeStep()) return row_of(query);
    }
    return std::nullopt;
  });
}

std::optional<JobRow> Store::apply(const JobRow& row, JobEvent event,
                                   const std::string& error_json) {
  const std::optional<JobState> next = next_state(row.state, event);
  if (!next) return std::nullopt;
  const bool begins = event == JobEvent::start || event == JobEvent::resume;
  return with_database(connections_->writer_mutex, [&]() -> std::optional<JobRow> {
    JobRow changed = row;
    changed.state = *next;
    changed.attempt += begins ? 1 : 0;
    if (event == JobEvent::start) changed.started_ms = clock_();
    if (!is_active(*next)) changed.ended_ms = clock_();
    changed.error_json = error_json;
    SQLite::Statement update(connections_->writer,
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
    return changed;
  });
}

void Store::save_progress(const JobRow& row, const std::string& progress_json) {
  with_database(connections_->writer_mutex, [&] {
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

bool Store::remove(const std::string& id) {
  return with_database(connections_->writer_mutex, [&] {
    SQLite::Statement statement(connections_->writer, "DELETE FROM job WHERE id = ?");
    statement.bind(1, id);
    return statement.exec() > 0;
  });
}

}  // namespace throng::jobs
