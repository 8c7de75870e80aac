#include "server/live/live_process.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <string>
#include <utility>
#include <vector>

#include "base/resource_exhaustion.h"
#include "jobs/queue/confine/child_process.h"
#include "jobs/queue/workers/worker_interface.h"
#include "server/catalog/api_json.h"
#include "server/live/kept_messages.h"

namespace throng::server {

using live::MessageType;
using nlohmann::json;

namespace {

std::vector<std::string> process_command(const LiveFlightSpec& spec,
                                         const std::filesystem::path& folder) {
  std::vector<std::string> command = spec.command;
  command.push_back(folder.string());
  if (spec.is_recorded) {
    command.insert(command.end(), {"--record", std::to_string(spec.min_free_mib), "--max-bytes",
                                   std::to_string(spec.max_recorded_bytes)});
  }
  return command;
}

jobs::ChildProcess::Variables process_variables(std::int64_t memory_mib) {
  jobs::ChildProcess::Variables variables = {
      {jobs::kSupervisorVariable, std::to_string(::getpid())}};
  if (memory_mib > 0) {
    constexpr std::int64_t kMoreMib = 2048;
    variables.emplace_back(jobs::kDataVariable, std::to_string(2 * memory_mib + kMoreMib));
  }
  return variables;
}

}  // namespace

LiveProcess::LiveProcess(const LiveFlightSpec& spec, OnMessage on_message)
    : spec_(spec), on_message_(std::move(on_message)), folder_(spec.folder / spec.id) {
  write_file_atomically(folder_.path() / "job.json", spec.job_json);
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw_environment_error("cannot create a pipe", errno);
  input_read_ = ends[0];
  input_ = ends[1];
  // A process that does not read must not hold up those who command it.
  ::fcntl(input_, F_SETFL, O_NONBLOCK);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

LiveProcess::~LiveProcess() {
  end();
  if (thread_.joinable()) thread_.join();
  ::close(input_);
  if (input_read_ >= 0) ::close(input_read_);
}

// The process dies with the thread that started it, so this thread lives as long as the process.
void LiveProcess::run(const std::stop_token& stop) {
  const std::filesystem::path log = folder() / "log.txt";
  try {
    jobs::ChildProcess process(process_command(spec_, folder()),
                               process_variables(spec_.memory_mib), log, input_read_);
    ::close(std::exchange(input_read_, -1));
    const bool has_outcome = pass_messages(process.output(), stop);
    if (stop.stop_requested()) return;  // the process ends with its object
    const jobs::ExitStatus status = process.wait();
    if (has_outcome || stop.stop_requested()) return;
    spdlog::error("live flight {}: {}", spec_.id, read_file(log));
    on_message_(failure_message(
        "crash", status.signal != 0 ? fmt::format("the flight was ended by signal {} ({})",
                                                  status.signal, ::strsignal(status.signal))
                                    : fmt::format("the flight ended with code {}", status.code)));
  } catch (const std::exception& error) {
    spdlog::error("live flight {}: {}", spec_.id, error.what());
    on_message_(failure_message("environment", "the flight cannot be carried out"));
  }
}

// Until the process closes its stdout, or a stop is requested. Whether an outcome was among them.
bool LiveProcess::pass_messages(int output, const std::stop_token& stop) {
  constexpr int kFlightPollMs = 100;
  bool has_outcome = false;
  live::MessageReader reader;
  std::array<char, 1 << 16> block{};
  while (true) {
    pollfd readable{output, POLLIN, 0};
    ::poll(&readable, 1, kFlightPollMs);
    if (stop.stop_requested()) return has_outcome;
    const ssize_t count = ::read(output, block.data(), block.size());
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) continue;
    if (count <= 0) return has_outcome;
    reader.add({block.data(), static_cast<std::size_t>(count)});
    while (const auto message = reader.next()) {
      on_message_(*message);
      has_outcome |= message->type == MessageType::result || message->type == MessageType::failure;
    }
  }
}

void LiveProcess::send(const json& line) {
  const std::string text = dump_text(line) + "\n";
  // Shorter than a pipe's atomic writes, or else a part of a line could be left behind.
  if (::write(input_, text.data(), text.size()) < 0 && errno != EAGAIN && errno != EPIPE) {
    spdlog::warn("live flight {}: {}", spec_.id, std::strerror(errno));
  }
}

}  // namespace throng::server
