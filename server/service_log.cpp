#include "server/service_log.h"

#include <fcntl.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

#include "base/resource_exhaustion.h"
#include "server/json_log.h"

namespace throng::server {

namespace {

struct LogFile {
  std::filesystem::path path;
  std::FILE* stream = nullptr;  ///< open until the process ends
};

LogFile& log_file() {
  static LogFile file;
  return file;
}

int open_log(const std::filesystem::path& path) {
  constexpr mode_t kOwnerOnly = 0600;
  return ::open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, kOwnerOnly);
}

std::FILE* opened(const std::filesystem::path& path) {
  const int descriptor = open_log(path);
  if (descriptor < 0) throw_environment_error("--log: cannot write to " + path.string(), errno);
  std::FILE* stream = ::fdopen(descriptor, "a");
  // Lines are written whole: what is in the buffer when the file is opened again is not split.
  constexpr std::size_t kBufferBytes = 1 << 16;
  std::setvbuf(stream, nullptr, _IOFBF, kBufferBytes);
  return stream;
}

/// A sink of spdlog for a stream that is not stdout.
using StreamSink = spdlog::sinks::stdout_sink_base<spdlog::details::console_mutex>;

}  // namespace

void set_up_log(bool as_json, bool to_stdout, const std::filesystem::path& file) {
  std::FILE* stream = to_stdout ? stdout : stderr;
  if (!file.empty()) {
    log_file() = {std::filesystem::absolute(file), opened(file)};
    stream = log_file().stream;
  }
  const auto logger =
      std::make_shared<spdlog::logger>("throng", std::make_shared<StreamSink>(stream));
  if (as_json) {
    logger->set_formatter(std::make_unique<JsonLogFormatter>());
  } else {
    logger->set_pattern("%Y-%m-%dT%H:%M:%S.%eZ %l %v", spdlog::pattern_time_type::utc);
  }
  spdlog::set_default_logger(logger);
}

void reopen_log() {
  const LogFile& file = log_file();
  if (file.stream == nullptr) return;
  const int descriptor = open_log(file.path);
  // One call: a line is written either to the old file or to the new one.
  if (descriptor < 0 || ::dup3(descriptor, ::fileno(file.stream), O_CLOEXEC) < 0) {
    spdlog::warn("{}: not opened again: {}", file.path.string(), std::strerror(errno));
  }
  if (descriptor >= 0) ::close(descriptor);
  spdlog::info("log opened again");
}

}  // namespace throng::server
