#include "server/service_log.h"

#include <fcntl.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <string>

#include "base/resource_exhaustion.h"
#include "server/json_log.h"

namespace throng::server {

namespace {

int open_log(const std::filesystem::path& file) {
  constexpr mode_t kOwnerOnly = 0600;
  return ::open(file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, kOwnerOnly);
}

/// A sink of spdlog for a stream that is not stdout.
using StreamSink = spdlog::sinks::stdout_sink_base<spdlog::details::console_mutex>;

}  // namespace

ServiceLog::ServiceLog(bool as_json, bool to_stdout, const std::filesystem::path& file) {
  if (!file.empty()) {
    file_ = std::filesystem::absolute(file);
    const int descriptor = open_log(file_);
    if (descriptor < 0) throw_environment_error("--log: cannot write to " + file.string(), errno);
    stream_ = ::fdopen(descriptor, "a");
    // The buffer holds whole lines when the file is opened again.
    constexpr std::size_t kBufferBytes = 1 << 16;
    std::setvbuf(stream_, nullptr, _IOFBF, kBufferBytes);
  }
  std::FILE* stream = stream_ != nullptr ? stream_ : to_stdout ? stdout : stderr;
  const auto logger =
      std::make_shared<spdlog::logger>("throng", std::make_shared<StreamSink>(stream));
  if (as_json) {
    logger->set_formatter(std::make_unique<JsonLogFormatter>());
  } else {
    logger->set_pattern("%Y-%m-%dT%H:%M:%S.%eZ %l %v", spdlog::pattern_time_type::utc);
  }
  spdlog::set_default_logger(logger);
}

void ServiceLog::reopen() const {
  if (stream_ == nullptr) return;
  const int descriptor = open_log(file_);
  // One call: a line is written either to the old file or to the new one.
  if (descriptor < 0 || ::dup3(descriptor, ::fileno(stream_), O_CLOEXEC) < 0) {
    spdlog::warn("{}: not opened again: {}", file_.string(), std::strerror(errno));
  }
  if (descriptor >= 0) ::close(descriptor);
  spdlog::info("log opened again");
}

}  // namespace throng::server
