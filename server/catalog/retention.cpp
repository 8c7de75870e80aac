#include "server/catalog/retention.h"

namespace throng::server {

std::optional<std::int64_t> expiry_ms(const jobs::JobRow& row, const Retention& retention) {
  if (retention.max_wait_ms == 0 || row.kept_from_ms == 0 || row.keep) return std::nullopt;
  return row.kept_from_ms + retention.max_wait_ms;
}

std::vector<std::string> expired(const std::vector<jobs::JobRow>& ended, std::int64_t total_bytes,
                                 std::int64_t now_ms, const Retention& retention) {
  std::vector<std::string> ids;
  for (const jobs::JobRow& row : ended) {
    const auto expiry = expiry_ms(row, retention);
    const bool is_too_old = expiry && *expiry <= now_ms;
    const bool is_too_much = retention.max_bytes > 0 && total_bytes > retention.max_bytes;
    if (!is_too_old && !is_too_much) continue;
    ids.push_back(row.id);
    total_bytes -= row.bytes;
  }
  return ids;
}

}  // namespace throng::server
