#include "server/serve.h"

#include <fmt/core.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <stop_token>
#include <thread>

#include "base/error.h"
#include "base/files.h"
#include "jobs/queue/local_processes.h"
#include "server/api.h"
#include "server/json_log.h"
#include "server/keys.h"
#include "server/service.h"
#include "server/webhook_sender.h"

namespace throng::server {

namespace {

sigset_t ending_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  return signals;
}

// Calls `action` in a thread of its own when the process is asked to end. As process 1 of a
// container there is no default action for SIGTERM, so somebody has to wait for it.
class SignalWatch {
 public:
  explicit SignalWatch(std::function<void()> action)
      : thread_([action = std::move(action)](const std::stop_token& stop) {
          const sigset_t signals = ending_signals();
          constexpr timespec kPatience{0, 100'000'000};
          while (!stop.stop_requested()) {
            if (sigtimedwait(&signals, nullptr, &kPatience) > 0) return action();
          }
        }) {}

 private:
  std::jthread thread_;
};

// A line per message; as JSON for log collectors. Ids and events are logged, never keys, bodies or
// headers.
void set_up_log(bool as_json) {
  const auto logger = spdlog::stderr_logger_mt("throng");
  if (as_json) {
    logger->set_formatter(std::make_unique<JsonLogFormatter>());
  } else {
    logger->set_pattern("%Y-%m-%dT%H:%M:%S.%eZ %l %v", spdlog::pattern_time_type::utc);
  }
  spdlog::set_default_logger(logger);
}

std::string url_of(const std::string& host, int port) {
  const bool is_ipv6 = host.find(':') != std::string::npos;
  return is_ipv6 ? fmt::format("http://[{}]:{}", host, port)
                 : fmt::format("http://{}:{}", host, port);
}

}  // namespace

int serve(const ServeOptions& options) {
  const Keys keys(options.data);
  if (!options.insecure && !is_loopback(options.host) && !keys.are_needed()) {
    throw InputError(Problem{"--host", "", options.host,
                             "a loopback address such as 127.0.0.1; other addresses need keys "
                             "(throng keys create), or --insecure where the network is a fence"});
  }
  set_up_log(options.log_json);
  std::signal(SIGPIPE, SIG_IGN);
  const sigset_t signals = ending_signals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);

  // Workers look for scenarios there.
  ::setenv("THRONG_SCENARIOS", ScenarioStore::folder_in(options.data).c_str(), 1);
  jobs::LocalProcesses executor({.workers = options.workers,
                                 .max_task_s = options.max_task_s,
                                 .worker_memory_mib = options.worker_memory_mib});
  const auto checks =
      std::make_shared<jobs::ForkServer>(std::vector<std::string>{"/proc/self/exe", "confined"});
  constexpr int kMibShift = 20;
  constexpr int kGibShift = 30;
  constexpr std::int64_t kMsPerDay = 86'400'000;
  Service service(
      {.data = options.data,
       .scenarios = options.scenarios,
       .confined = jobs::confined_task_by(checks),
       .calibrator = calibrator_in_child({"/proc/self/exe", "calibrate", "request"}),
       .reporter = reporter_in_child({"/proc/self/exe", "report"}),
       .uploads = {.max_bytes = options.uploads_gib << kGibShift},
       .housekeeping = {.retention = {options.keep_days * kMsPerDay, options.keep_gib << kGibShift},
                        .min_free_bytes = options.min_free_mib << kMibShift}},
      executor);
  WebhookSender hooks(service.queue(), options.data);
  Api api(service, keys, hooks, {options.host, options.port});
  if (!options.port_file.empty()) {
    write_file_atomically(options.port_file, fmt::format("{}\n", api.port()));
  }
  fmt::print("throng serving on {}\n", url_of(options.host, api.port()));
  std::fflush(stdout);
  const SignalWatch watch([&] {
    spdlog::info("ending");
    checks->stop();  // requests that wait for one get their answer
    api.stop();
  });
  api.run();
  return 0;
}

}  // namespace throng::server
