#include "server/json_log.h"

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>

#include "server/catalog/api_json.h"

namespace throng::server {

void JsonLogFormatter::format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& line) {
  const auto unix_ms =
      std::chrono::duration_cast<std::chrono::milliseconds>(message.time.time_since_epoch());
  const auto level = spdlog::level::to_string_view(message.level);
  const std::string text =
      dump_text({{"time", time_json(unix_ms.count())},
                 {"level", std::string(level.data(), level.size())},
                 {"message", std::string(message.payload.data(), message.payload.size())}}) +
      "\n";
  line.append(text.data(), text.data() + text.size());
}

std::unique_ptr<spdlog::formatter> JsonLogFormatter::clone() const {
  return std::make_unique<JsonLogFormatter>();
}

}  // namespace throng::server
