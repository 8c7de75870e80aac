// The job store's two connections to its file: one writes and one reads, so that readers never wait
// for a disk sync.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/core.h>
#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "base/error.h"
#include "jobs/queue/dataset/folder_lock.h"
#include "jobs/queue/store/group_commit.h"
#include "jobs/queue/store/service_clock.h"
#include "jobs/queue/store/store.h"

namespace throng::jobs {

struct Store::Connections {
  /// Opens or creates the file. Throws EnvironmentError and SQLite::Exception.
  Connections(const std::filesystem::path& folder, const Clock& wall, Clock steady);

  /// Throws EnvironmentError if the file or its lock was removed or replaced: changes to an
  /// unlinked file would be lost when the service ends.
  void require_files() const;

  /// Runs a query on the reading connection, one thread at a time. Throws EnvironmentError: errors
  /// of SQLite are failures of the machine (disk full, file damaged, locked for too long).
  template <typename Action>
  auto read(const Action& action) {
    const std::lock_guard guard(reader_mutex);
    try {
      return action(reader);
    } catch (const SQLite::Exception& error) {
      throw EnvironmentError(fmt::format("job store: {}", error.what()));
    }
  }

  /// Runs the change in a transaction; it is durable when this returns.
  void write(const std::function<void()>& change);

  FolderLock lock;
  std::filesystem::path file;
  std::optional<std::pair<dev_t, ino_t>> identity;  ///< device and inode of the file
  std::mutex reader_mutex;
  SQLite::Database writer;  ///< used only within write()
  SQLite::Database reader;
  GroupCommit commits;
  std::string last_id;  ///< id of the newest job; used only within write()
  ServiceClock service_clock;
};

}  // namespace throng::jobs
