// The log of changes and refusals: DATA/audit.log, a JSON object per line, which only the
// service's user may read. Keys, queries and bodies are never in it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <string>

namespace throng::server {

struct AuditEntry {
  std::string key;  ///< id; "" for a caller without one
  std::string method;
  std::string path;
  int status = 0;
  std::string address;  ///< of the other end of the connection
  std::string
      forwarded_for;  ///< that a proxy has named; anybody may claim anything where there is none
};

/// Safe to use from many threads.
class AuditLog {
 public:
  /// A file of more than `max_bytes` becomes audit.log.1 and replaces the one before: strangers who
  /// are refused all day fill no disk.
  explicit AuditLog(const std::filesystem::path& data, std::int64_t max_bytes = 64 << 20);

  /// Throws nothing: an entry that cannot be written is a warning in the service's log.
  void record(const AuditEntry& entry);

 private:
  void write(const std::string& line);

  std::filesystem::path file_;
  std::int64_t max_bytes_;
  std::mutex mutex_;
};

}  // namespace throng::server
