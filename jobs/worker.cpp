#include "jobs/worker.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <new>
#include <system_error>

#include "base/error.h"
#include "jobs/pipeline.h"
#include "jobs/worker_messages.h"
#include "render/allocator.h"
#include "world/scenario.h"

namespace throng::jobs {

namespace {

// A worker without a supervisor would be a second writer beside the one that a restart begins.
void die_with_supervisor() {
  const char* supervisor = std::getenv(kSupervisorVariable);
  if (supervisor == nullptr) return;
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  // It may have died before the kernel knew that we care.
  if (std::to_string(::getppid()) != supervisor) std::_Exit(worker_environment_error);
}

// The way to the supervisor: takes stdout for itself, so that a driver that prints there cannot
// spoil a message.
class Reporter {
 public:
  Reporter() : output_(::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0)) {
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
  }
  ~Reporter() { ::close(output_); }
  Reporter(const Reporter&) = delete;
  Reporter& operator=(const Reporter&) = delete;

  void report(const TaskProgress& progress) {
    constexpr auto kInterval = std::chrono::milliseconds(100);
    const auto now = std::chrono::steady_clock::now();
    if (now - last_ < kInterval && progress.done < progress.total) return;
    last_ = now;
    write(progress_line(progress));
  }

  int fail(WorkerExit code, const char* kind, const std::exception& error,
           std::vector<Problem> problems = {}) {
    write(error_line({kind, error.what(), std::move(problems)}));
    fmt::print(stderr, "{}\n", error.what());
    return code;
  }

 private:
  void write(std::string line) const {
    line += '\n';
    std::string_view rest = line;
    while (!rest.empty()) {
      const ssize_t count = ::write(output_, rest.data(), rest.size());
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) return;
      rest.remove_prefix(static_cast<std::size_t>(count));
    }
  }

  int output_;
  std::chrono::steady_clock::time_point last_;
};

}  // namespace

int run_worker(const std::filesystem::path& job_folder, const std::string& task_name) {
  die_with_supervisor();
  render::tune_allocator();
  Reporter reporter;
  try {
    const JobFolder folder(job_folder);
    const std::filesystem::path scenarios = world::scenarios_folder();
    const JobSpec job = folder.read_job(scenarios);
    do_task(folder, job, scenarios, task_named(job, task_name),
            [&](const TaskProgress& progress) { reporter.report(progress); });
    return worker_succeeded;
  } catch (const InputError& error) {
    return reporter.fail(worker_input_error, "input", error, error.problems());
  } catch (const EnvironmentError& error) {
    return reporter.fail(worker_environment_error, "environment", error);
  } catch (const std::system_error& error) {
    return reporter.fail(worker_environment_error, "environment", error);
  } catch (const std::bad_alloc& error) {
    return reporter.fail(worker_environment_error, "environment", error);
  } catch (const std::exception& error) {
    return reporter.fail(worker_bug, "bug", error);
  }
}

}  // namespace throng::jobs
