// Audit log of changes and refusals: DATA/audit.log, one JSON object per line, readable only by the
// service's user. It never contains keys, queries or bodies.
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>

namespace throng::server {

/// One request.
struct AuditEntry {
  std::string key;  ///< id of the caller's key; "" without a key
  std::string method;
  std::string path;
  int status = 0;
  std::string address;  ///< address of the peer
  std::string
      forwarded_for;  ///< X-Forwarded-For; to be trusted only if all requests come through a proxy
};

/// Safe to use from many threads.
class AuditLog {
 public:
  /// Rotation bounds the size of the log: a file of more than `max_bytes` is renamed to audit.log.1
  /// and replaces the previous one.
  explicit AuditLog(const std::filesystem::path& data, std::int64_t max_bytes = 64 << 20);

  /// Appends an entry. Throws nothing: logs a warning if the entry cannot be written.
  void record(const AuditEntry& entry);

 private:
  void write(const std::string& line);

  std::filesystem::path file_;
  std::int64_t max_bytes_;
  std::mutex mutex_;
};

}  // namespace throng::server
