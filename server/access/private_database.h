// A SQLite file that only its owner may read.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/core.h>
#include <sys/stat.h>

#include <filesystem>
#include <mutex>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/files/writable.h"
#include "base/version.h"

namespace throng::server {

/// Safe to use from many threads; actions run one at a time.
class PrivateDatabase {
 public:
  /// Opens or creates the file; `set_up`, called with the database, creates its tables, which have
  /// this version (PRAGMA user_version). `what` names the content in messages. Throws
  /// EnvironmentError for a file that cannot be written or has a newer version, and
  /// SQLite::Exception.
  template <typename SetUp>
  PrivateDatabase(const std::filesystem::path& path, std::string what, int version,
                  const SetUp& set_up)
      : what_(std::move(what)),
        database_(require_writable_database(path), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE,
                  kBusyTimeoutMs) {
    constexpr mode_t kOwnerOnly = 0600;
    ::chmod(path.c_str(), kOwnerOnly);
    const int found = database_.execAndGet("PRAGMA user_version");
    if (found > version) {
      throw EnvironmentError(
          fmt::format("{} in {}: a newer throng wrote this file, which has version {}; this "
                      "program ({}) knows up to {}",
                      what_, path.string(), found, kGenerator, version));
    }
    set_up(database_);
    if (found < version) database_.exec(fmt::format("PRAGMA user_version = {}", version));
  }

  /// Calls `action` with the database and returns its result. Throws EnvironmentError for errors of
  /// SQLite.
  template <typename Action>
  auto with(const Action& action) {
    const std::lock_guard lock(mutex_);
    try {
      return action(database_);
    } catch (const SQLite::Exception& error) {
      throw EnvironmentError(fmt::format("{}: {}", what_, error.what()));
    }
  }

 private:
  static constexpr int kBusyTimeoutMs = 5000;

  std::string what_;
  std::mutex mutex_;
  SQLite::Database database_;
};

}  // namespace throng::server
