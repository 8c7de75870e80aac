#include "server/serve.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/writable.h"
#include "jobs/bucket/access.h"
#include "jobs/queue/confine/credentials.h"
#include "jobs/queue/confine/file_fence.h"
#include "jobs/queue/confine/machine_memory.h"
#include "jobs/queue/confine/worker_limits.h"
#include "jobs/queue/dataset/folder_lock.h"
#include "jobs/queue/executors.h"
#include "server/access/first_key.h"
#include "server/access/keys.h"
#include "server/api/service.h"
#include "server/routes/api.h"
#include "server/service_log.h"
#include "server/webhooks/webhook_sender.h"

namespace throng::server {

namespace fs = std::filesystem;

namespace {

constexpr double kMaxTaskS = 6 * 3600;  // a task is a simulation or a part of its frames

/// The signals that the service waits for. None of them ends it by the kernel's default action.
sigset_t awaited_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGUSR1, SIGUSR2}) sigaddset(&signals, signal);
  return signals;
}

// Calls `action` in a thread of its own for each signal until it returns false. As process 1 of a
// container there is no default action for SIGTERM, so somebody has to wait for it.
class SignalWatch {
 public:
  explicit SignalWatch(std::function<bool(int signal)> action)
      : thread_([action = std::move(action)](const std::stop_token& stop) {
          const sigset_t signals = awaited_signals();
          while (true) {
            const int signal = sigwaitinfo(&signals, nullptr);
            if (signal < 0) continue;
            if (stop.stop_requested() || !action(signal)) return;
          }
        }) {}
  ~SignalWatch() {
    thread_.request_stop();
    pthread_kill(thread_.native_handle(), SIGTERM);  // wakes it; without polling it takes no time
  }
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

 private:
  std::jthread thread_;
};

std::int64_t memory_for_workers_mib(const ServeOptions& options) {
  constexpr std::int64_t kParts = 8;
  return options.memory_mib > 0 ? options.memory_mib
                                : jobs::total_memory_mib() * (kParts - 1) / kParts;
}

std::int64_t max_task_mib(const ServeOptions& options) {
  // Nodes may have more memory than this machine.
  const std::int64_t memory_mib =
      options.executor == "local" ? memory_for_workers_mib(options) : options.memory_mib;
  if (options.worker_memory_mib == 0) return memory_mib;
  if (memory_mib == 0) return options.worker_memory_mib;
  return std::min<std::int64_t>(memory_mib, options.worker_memory_mib);
}

/// A database elsewhere has a lock of its own; two servers in one data folder would still mix.
std::optional<jobs::FolderLock> lock_of_data(const ServeOptions& options) {
  if (options.database.empty()) return std::nullopt;
  make_folders(options.data);
  return std::optional<jobs::FolderLock>(std::in_place, options.data, "lock", "data folder");
}

std::unique_ptr<jobs::Executor> made_executor(const ServeOptions& options,
                                              std::shared_ptr<jobs::TaskMeters> meters) {
  jobs::ExecutorOptions wanted{.name = options.executor,
                               .local = {.workers = options.workers,
                                         .memory_mib = memory_for_workers_mib(options),
                                         .waits_for_memory = true,
                                         .max_task_s = options.max_task_s.value_or(kMaxTaskS),
                                         .worker_memory_mib = options.worker_memory_mib,
                                         .limits_by_need = true,
                                         .meters = std::move(meters)},
                               .slurm = options.slurm};
  wanted.slurm.at_once = options.workers;
  wanted.slurm.max_task_s = options.max_task_s.value_or(0);
  wanted.slurm.worker_memory_mib = options.worker_memory_mib;
  wanted.slurm.limits_by_need = true;
  const jobs::ExecutorKind& kind = jobs::executor_kind(options.executor);
  if (const std::string problem = kind.check(wanted); !problem.empty()) {
    spdlog::warn("executor {}: {}; jobs wait until it answers", kind.name, problem);
  }
  return kind.make(wanted);
}

std::string service_url(const std::string& host, int port) {
  const bool is_ipv6 = host.find(':') != std::string::npos;
  return is_ipv6 ? fmt::format("http://[{}]:{}", host, port)
                 : fmt::format("http://{}:{}", host, port);
}

void check_folders(const ServeOptions& options) {
  for (const auto& [option, folder] :
       {std::pair{"--data", options.data}, std::pair{"--database", options.database}}) {
    if (fs::exists(folder) && !fs::is_directory(folder)) {
      throw InputError(Problem{option, "", folder.string() + ", which is a file", "a folder"});
    }
    if (folder.empty()) continue;
    make_folders(folder);
    require_writable_folder(folder);
  }
  // They belong to another user where a container ran as root once.
  for (const char* name :
       {"calibrations", "check", "jobs", "live", "scenarios", "studies", "uploads"}) {
    if (fs::exists(options.data / name)) require_writable_folder(options.data / name);
  }
  require_writable_file(options.data / "audit.log");
}

/// Makes a first key where other machines can reach the service. Throws InputError when there are
/// none and they are needed.
void require_keys(const ServeOptions& options, Keys& keys) {
  const bool is_reachable = !options.insecure && !is_loopback(options.host);
  fmt::print(stderr, "{}", make_first_key(keys, options.port, is_reachable));
  if (keys.are_needed()) return;
  if (is_reachable) {
    throw InputError(Problem{"--host", "", options.host,
                             "a loopback address such as 127.0.0.1; other addresses need keys "
                             "(throng keys create), or --insecure where the network is a fence"});
  }
  fmt::print(stderr,
             "throng: there are no keys: everybody who reaches {}, also through a proxy on this "
             "machine, may do everything (`throng keys create` ends that)\n",
             options.host);
}

/// Names folders to child processes, which read nothing of the data folder but scenarios and their
/// own folder: keys and secrets lie there.
void set_environment(const fs::path& data, const fs::path& database) {
  ::setenv(jobs::kPrivateFolderVariable, fs::absolute(data).c_str(), 1);
  ::setenv(jobs::kPrivateDatabaseVariable, fs::absolute(database).c_str(), 1);
  ::setenv("THRONG_SCENARIOS", ScenarioStore::folder_in(fs::absolute(data)).c_str(), 1);
}

void announce(const std::string& url, bool in_log) {
  if (in_log) {
    spdlog::info("serving on {}", url);
    spdlog::default_logger()->flush();
  } else {
    fmt::print("throng serving on {}\n", url);
    std::fflush(stdout);
  }
}

}  // namespace

int serve(const ServeOptions& options) {
  // Files of users and their results are for nobody else on the machine, those of workers
  // included.
  constexpr mode_t kNotForOthers = 0077;
  ::umask(kNotForOthers);
  const sigset_t signals = awaited_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGHUP, SIG_DFL);  // nohup has it ignored; blocked, it reopens the log
  check_folders(options);
  const fs::path database = options.database.empty() ? options.data : options.database;
  Keys keys(database);
  require_keys(options, keys);
  PublishTargets publish_to(options.publish_to);
  // Missing credentials shall not be found by the first job.
  if (publish_to.are_there()) static_cast<void>(bucket::read_access());
  jobs::hide_environment();
  jobs::protect_this_process();
  const bool is_container = is_in_container();
  const bool logs_json = options.log_json || (is_container && ::isatty(STDOUT_FILENO) == 0);
  const ServiceLog log(logs_json, is_container, options.log_file);
  std::signal(SIGPIPE, SIG_IGN);
  rlimit files{};  // each connection is one, and each file that is sent
  if (::getrlimit(RLIMIT_NOFILE, &files) == 0) {
    files.rlim_cur = files.rlim_max;
    ::setrlimit(RLIMIT_NOFILE, &files);
  }
  if (::geteuid() == 0) {
    spdlog::warn("the service runs as root, and so do its workers: a user of its own is safer");
  }
  set_environment(options.data, database);
  const std::optional<jobs::FolderLock> lock = lock_of_data(options);
  const auto meters = std::make_shared<jobs::TaskMeters>();
  const std::unique_ptr<jobs::Executor> executor = made_executor(options, meters);
  const auto checks =
      std::make_shared<jobs::ForkServer>(std::vector<std::string>{"/proc/self/exe", "confined"});
  constexpr int kMibShift = 20;
  constexpr int kGibShift = 30;
  constexpr std::int64_t kMsPerDay = 86'400'000;
  Service service(
      {.data = options.data,
       .database = database,
       .scenarios = options.scenarios,
       .confined = jobs::confined_task_by(checks),
       .uploads = {.max_bytes = options.uploads_gib << kGibShift},
       .housekeeping = {.retention = {options.keep_days * kMsPerDay, options.keep_gib << kGibShift},
                        .min_free_bytes = options.min_free_mib << kMibShift},
       .max_active_jobs = options.max_active_jobs,
       .max_task_mib = max_task_mib(options),
       .publish_to = std::move(publish_to),
       .live = {.unseen = std::chrono::milliseconds(std::lround(1000 * options.live_timeout_s)),
                .min_free_mib = options.min_free_mib},
       .drain = {std::chrono::milliseconds(std::lround(1000 * options.drain_timeout_s)),
                 [] { ::kill(::getpid(), SIGTERM); }},
       .tasks = meters},
      *executor);
  WebhookSender hooks(service.queue(), database,
                      {.post = {.allow_private = options.webhook_private}});
  Api api(service, keys, hooks, {options.host, options.port});
  if (!options.port_file.empty()) {
    write_file_atomically(options.port_file, fmt::format("{}\n", api.port()));
  }
  service.reserve().started();
  announce(service_url(options.host, api.port()),
           logs_json && is_container && options.log_file.empty());
  const SignalWatch watch([&](int signal) {
    if (signal == SIGHUP || signal == SIGUSR1) log.reopen();
    if (signal == SIGUSR2) service.drain().begin();
    if (signal != SIGTERM && signal != SIGINT) return true;
    spdlog::info("ending");
    executor->leave_tasks();
    checks->stop();  // requests that wait for one get their answer
    hooks.stop();    // also a ping that a request waits for
    api.stop();
    return false;
  });
  api.run();
  return 0;
}

}  // namespace throng::server
