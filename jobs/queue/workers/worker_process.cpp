#include "jobs/queue/workers/worker_process.h"

#include <fcntl.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <new>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "base/text/redact.h"
#include "jobs/queue/confine/credentials.h"
#include "jobs/queue/confine/file_fence.h"
#include "jobs/queue/confine/worker_limits.h"
#include "jobs/queue/workers/worker_protocol.h"

namespace throng::jobs {

namespace {

// A worker without a supervisor would be a second writer beside the one that a restart begins, or a
// flight that nobody can end.
void die_with_supervisor() {
  const char* supervisor = std::getenv(kSupervisorVariable);
  if (supervisor == nullptr) return;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  // It may have died before the kernel knew that we care.
  if (std::to_string(::getppid()) != supervisor) std::_Exit(worker_environment_error);
}

// The log is read through the service: times, what was begun, how it ended.
void log_to_stderr() {
  const auto logger = spdlog::stderr_logger_mt("worker");
  logger->set_pattern("%Y-%m-%dT%H:%M:%S.%eZ %l %v", spdlog::pattern_time_type::utc);
  spdlog::set_default_logger(logger);
}

std::string fence_worker(const WorkerRights& rights) {
  FileFence fence = fence_of_folder(rights.folder,
                                    rights.publishes ? Credentials::readable : Credentials::hidden);
  if (const auto cache = shader_cache_folder(); rights.keeps_shaders && !cache.empty()) {
    std::error_code error;
    std::filesystem::create_directories(cache, error);
    fence.writable.push_back(cache);
  }
  return fence_this_process(fence);
}

void confine(const WorkerRights& rights) {
  // One that publishes opens no file of strangers: the dataset's are sent as they are.
  const Network network = rights.publishes ? Network::allowed : Network::refused;
  for (const std::string& unlimited : {limit_this_process(network), fence_worker(rights)}) {
    if (!unlimited.empty()) spdlog::warn("the kernel does not support limits of {}", unlimited);
  }
}

struct Failure {
  WorkerExit code;
  WorkerError error;
};

Failure lack_of_memory() {
  return {worker_out_of_memory,
          {"environment", "out of memory: what this process may use does not suffice", {}}};
}

/// A thread that finds no room for its stack.
bool is_lack_of_memory(const std::system_error& error) {
  const bool is_limited =
      std::getenv(kMemoryVariable) != nullptr || std::getenv(kDataVariable) != nullptr;
  return is_limited && (error.code() == std::errc::resource_unavailable_try_again ||
                        error.code() == std::errc::not_enough_memory);
}

/// The failure that the current exception means.
Failure current_failure() {
  try {
    throw;
  } catch (const InputError& error) {
    return {worker_input_error, {"input", error.what(), error.problems()}};
  } catch (const EnvironmentError& error) {
    return {worker_environment_error, {"environment", error.what(), {}}};
  } catch (const std::system_error& error) {
    if (is_lack_of_memory(error)) return lack_of_memory();
    return {worker_environment_error, {"environment", error.what(), {}}};
  } catch (const std::bad_alloc&) {
    return lack_of_memory();
  } catch (const std::exception& error) {
    return {worker_bug, {"bug", error.what(), {}}};
  }
}

}  // namespace

WorkerProcess::WorkerProcess(const WorkerRights& rights) : folders_(rights.unnamed) {
  die_with_supervisor();
  log_to_stderr();
  if (rights.publishes) take_credentials();
  confine(rights);
  folders_.insert(folders_.begin(), rights.folder);
  output_ = ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
}

WorkerProcess::~WorkerProcess() { ::close(output_); }

void WorkerProcess::send(std::string_view message) {
  const std::lock_guard lock(mutex_);
  while (!message.empty()) {
    const ssize_t count = ::write(output_, message.data(), message.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return;
    message.remove_prefix(static_cast<std::size_t>(count));
  }
}

// A pipe refuses, and needs nothing.
void WorkerProcess::sync() const { ::fdatasync(output_); }

int WorkerProcess::run(const std::function<void()>& work,
                       const std::function<std::string(const WorkerError&)>& format) {
  try {
    work();
    return worker_succeeded;
  } catch (...) {
    auto [code, error] = current_failure();
    error.message = without_folders(error.message, folders_);
    for (Problem& problem : error.problems) {
      problem.source = without_folders(problem.source, folders_);
    }
    send(format(error));
    spdlog::error("{}", error.message);
    return code;
  }
}

}  // namespace throng::jobs
