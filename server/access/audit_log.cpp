#include "server/access/audit_log.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>

#include "server/catalog/api_json.h"
#include "server/catalog/unix_time.h"

namespace throng::server {

using nlohmann::json;

AuditLog::AuditLog(const std::filesystem::path& data, std::int64_t max_bytes)
    : file_(data / "audit.log"), max_bytes_(max_bytes) {}

void AuditLog::record(const AuditEntry& entry) {
  json line = {{"at", time_json(unix_ms_now())},
               {"key", entry.key.empty() ? json(nullptr) : json(entry.key)},
               {"method", entry.method},
               {"path", entry.path},
               {"status", entry.status},
               {"address", entry.address}};
  if (!entry.forwarded_for.empty()) line["forwarded_for"] = entry.forwarded_for;
  write(dump_text(line) + "\n");
}

void AuditLog::write(const std::string& line) {
  constexpr mode_t kOwnerOnly = 0600;
  const std::lock_guard lock(mutex_);
  const int file =
      ::open(file_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC | O_NOFOLLOW, kOwnerOnly);
  // One call: lines of two processes do not mix.
  const bool is_written =
      file >= 0 && ::write(file, line.data(), line.size()) == static_cast<ssize_t>(line.size());
  if (!is_written) spdlog::warn("{}: not written: {}", file_.string(), std::strerror(errno));
  struct stat status {};
  const bool is_large = file >= 0 && ::fstat(file, &status) == 0 && status.st_size > max_bytes_;
  if (file >= 0) ::close(file);
  if (!is_large) return;
  std::error_code error;
  std::filesystem::rename(file_, file_.string() + ".1", error);
}

}  // namespace throng::server
