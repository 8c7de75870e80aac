// Audit log of changes and refusals: DATA/audit.log, one JSON object per line, readable only by the
// service's user. It never contains keys, queries or bodies. Refusals are counted, so that nobody
// can push the changes of others out of the log.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <string>

#include "base/compute/steady_time.h"

namespace throng::server {

/// One request.
struct AuditEntry {
  std::string key;  ///< id of the caller's key; "" without a valid key
  std::string method;
  std::string path;
  int status = 0;
  std::string address;  ///< address of the peer
  std::string
      forwarded_for;  ///< X-Forwarded-For; to be trusted only if all requests come through a proxy
};

/// Size of the log.
struct AuditLimits {
  std::int64_t max_bytes = 16 << 20;  ///< of a file; a larger one is renamed to audit.log.1
  int max_files = 10;                 ///< older files are kept as audit.log.1, .2 and so on
  std::size_t max_text_bytes = 256;   ///< of a path or header; longer ones are cut
};

/// Safe to use from many threads.
class AuditLog {
 public:
  explicit AuditLog(const std::filesystem::path& data, AuditLimits limits = {},
                    SteadyNow now = &steady_now);
  /// Writes the count of refusals that were not written yet.
  ~AuditLog();
  AuditLog(const AuditLog&) = delete;
  AuditLog& operator=(const AuditLog&) = delete;

  /// Appends an entry. Throws nothing: logs a warning if the entry cannot be written.
  void record(const AuditEntry& entry);
  /// Counts a refused request. Within a minute, the first refusal of each of a few senders (a key,
  /// or an address without one) is written as an entry; all others are counted, and the numbers are
  /// written with the next entry after the minute.
  void record_refusal(const AuditEntry& entry);

 private:
  struct Refusals {
    SteadyTime since;
    std::int64_t total = 0;                    ///< of those that were not written as entries
    std::map<std::string, std::int64_t> sent;  ///< by sender; a few of them
  };

  std::string line_of(const AuditEntry& entry) const;
  void write_refusals();
  void write(const std::string& line);
  void rotate();

  std::filesystem::path file_;
  AuditLimits limits_;
  SteadyNow now_;
  std::mutex mutex_;
  Refusals refusals_;  ///< guarded by mutex_
};

}  // namespace throng::server
