#include "server/access/audit_log.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <utility>

#include "server/catalog/api_json.h"
#include "server/catalog/unix_time.h"

namespace throng::server {

using nlohmann::json;

namespace {

constexpr std::chrono::minutes kWindow(1);
constexpr std::size_t kMaxSenders = 16;  // within a window

}  // namespace

AuditLog::AuditLog(const std::filesystem::path& data, AuditLimits limits, SteadyNow now)
    : file_(data / "audit.log"), limits_(limits), now_(std::move(now)) {}

AuditLog::~AuditLog() {
  const std::lock_guard lock(mutex_);
  write_refusals();
}

std::string AuditLog::line_of(const AuditEntry& entry) const {
  const auto cut = [&](const std::string& text) { return text.substr(0, limits_.max_text_bytes); };
  json line = {{"at", time_json(unix_ms_now())},
               {"key", entry.key.empty() ? json(nullptr) : json(entry.key)},
               {"method", entry.method},
               {"path", cut(entry.path)},
               {"status", entry.status},
               {"address", entry.address}};
  if (!entry.forwarded_for.empty()) line["forwarded_for"] = cut(entry.forwarded_for);
  return dump_text(line) + "\n";
}

void AuditLog::record(const AuditEntry& entry) {
  const std::string line = line_of(entry);
  const std::lock_guard lock(mutex_);
  if (now_() - refusals_.since > kWindow) write_refusals();
  write(line);
}

void AuditLog::record_refusal(const AuditEntry& entry) {
  const std::lock_guard lock(mutex_);
  if (refusals_.sent.empty() || now_() - refusals_.since > kWindow) {
    write_refusals();
    refusals_.since = now_();
  }
  const std::string sender = entry.key.empty() ? entry.address : "key " + entry.key;
  const auto found = refusals_.sent.find(sender);
  if (found == refusals_.sent.end() && refusals_.sent.size() < kMaxSenders) {
    refusals_.sent[sender] = 0;
    return write(line_of(entry));
  }
  ++refusals_.total;
  if (found != refusals_.sent.end()) ++found->second;
}

void AuditLog::write_refusals() {
  const Refusals refusals = std::exchange(refusals_, {});
  if (refusals.total == 0) return;
  json senders = json::object();
  for (const auto& [sender, count] : refusals.sent) {
    if (count > 0) senders[sender] = count;
  }
  const auto window_s = std::chrono::duration_cast<std::chrono::seconds>(now_() - refusals.since);
  write(dump_text({{"at", time_json(unix_ms_now())},
                   {"more_refusals", refusals.total},
                   {"of", std::move(senders)},
                   {"within_s", window_s.count()}}) +
        "\n");
}

void AuditLog::write(const std::string& line) {
  constexpr mode_t kOwnerOnly = 0600;
  const int file =
      ::open(file_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC | O_NOFOLLOW, kOwnerOnly);
  // One call: lines of two processes do not mix.
  const bool is_written =
      file >= 0 && ::write(file, line.data(), line.size()) == static_cast<ssize_t>(line.size());
  if (!is_written) spdlog::warn("{}: not written: {}", file_.string(), std::strerror(errno));
  struct stat status {};
  const bool is_large =
      file >= 0 && ::fstat(file, &status) == 0 && status.st_size > limits_.max_bytes;
  if (file >= 0) ::close(file);
  if (is_large) rotate();
}

void AuditLog::rotate() {
  const auto numbered = [this](int number) { return fmt::format("{}.{}", file_.string(), number); };
  std::error_code error;
  for (int number = limits_.max_files - 1; number > 0; --number) {
    std::filesystem::rename(numbered(number), numbered(number + 1), error);
  }
  std::filesystem::rename(file_, numbered(1), error);
}

}  // namespace throng::server
