// Log lines as JSON: {"time": RFC 3339, "level": "info", "message": "..."}.
#pragma once

#include <spdlog/formatter.h>

#include <memory>

namespace throng::server {

/// Formatter for spdlog.
class JsonLogFormatter final : public spdlog::formatter {
 public:
  void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& line) override;
  std::unique_ptr<spdlog::formatter> clone() const override;
};

}  // namespace throng::server
