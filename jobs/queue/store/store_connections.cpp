#include "jobs/queue/store/store_connections.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "base/files/files.h"
#include "base/files/writable.h"
#include "base/resource_exhaustion.h"
#include "jobs/queue/store/store_rows.h"
#include "jobs/queue/store/store_schema.h"

namespace throng::jobs {

namespace fs = std::filesystem;

namespace {

constexpr int kBusyTimeoutMs = 5000;

fs::path created(const fs::path& folder) {
  make_folders(folder);
  require_writable_folder(folder);
  return folder;
}

/// The file, which only its owner may read: jobs are other people's. SQLite gives its other files
/// the same mode.
fs::path private_file(const fs::path& path) {
  constexpr mode_t kOwnerOnly = 0600;
  require_writable_database(path);
  const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, kOwnerOnly);
  if (descriptor < 0) throw_environment_error("cannot open " + path.string(), errno);
  ::fchmod(descriptor, kOwnerOnly);
  ::close(descriptor);
  return path;
}

void prepare(SQLite::Database& database) {
  database.exec("PRAGMA journal_mode = WAL");
  database.exec("PRAGMA synchronous = FULL");
  prepare_tables(database);
}

/// Device and number of a file; nothing when there is none.
std::optional<std::pair<dev_t, ino_t>> file_identity(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return std::nullopt;
  return std::pair(status.st_dev, status.st_ino);
}

}  // namespace

Store::Connections::Connections(const fs::path& folder, const Clock& wall, Clock steady)
    : lock(created(folder), "lock", "data folder"),
      file(private_file(folder / "jobs.sqlite")),
      writer(file, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, kBusyTimeoutMs),
      reader((prepare(writer), file), SQLite::OPEN_READWRITE, kBusyTimeoutMs),
      commits(writer),
      service_clock(wall(), std::move(steady), clock_mark(writer)) {
  reader.exec("PRAGMA query_only = ON");
  SQLite::Statement newest(writer, "SELECT max(id) FROM job");
  newest.executeStep();
  last_id = newest.getColumn(0).getString();
  identity = file_identity(file);
}

void Store::Connections::require_files() const {
  if (file_identity(file) == identity && lock.is_in_place()) return;
  throw StoreUnavailable(
      "job store: its file or its lock was removed while the service ran; nothing is accepted "
      "until they are put back and the service is started again");
}

void Store::Connections::write(const std::function<void()>& change) {
  require_files();
  try {
    commits.run(change);
  } catch (const SQLite::Exception& error) {
    throw StoreUnavailable(fmt::format("job store: {}", error.what()));
  }
}

}  // namespace throng::jobs
