// `throng serve`: runs the service until SIGTERM.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "jobs/queue/executors.h"

namespace throng::server {

/// Options of the service.
struct ServeOptions {
  std::filesystem::path data;       ///< data folder
  std::filesystem::path database;   ///< folder of jobs, keys and webhooks; "": `data`
  std::filesystem::path scenarios;  ///< folder of the scenarios that all jobs may use
  std::string host = "127.0.0.1";   ///< address to listen on
  int port = 8080;                  ///< 0: any free port
  std::filesystem::path port_file;  ///< file that receives the number of the port; "": none
  bool insecure = false;            ///< permits addresses other than loopback without keys
  std::string executor = "local";   ///< name in executor_kinds() (jobs/queue/executors.h)
  jobs::SlurmOptions slurm;         ///< options of the executor "slurm"
  int workers = 0;                  ///< max number of workers; 0: one per core
  int max_active_jobs = 16;         ///< max number of running jobs
  double live_timeout_s = 30;       ///< a live flight without viewers ends after this time
  /// Max duration of an attempt at a task; 0: unlimited. Default: six hours on this machine, and on
  /// a cluster what Slurm's partition allows.
  std::optional<double> max_task_s;
  int worker_memory_mib = 0;            ///< max address space of a worker; 0: by its task's need
  std::int64_t memory_mib = 0;          ///< max memory of all workers; 0: 7/8 of the machine's
  std::int64_t keep_days = 0;           ///< time until an ended job is removed; 0: unlimited
  std::int64_t keep_gib = 0;            ///< max size of all jobs; 0: unlimited
  std::int64_t uploads_gib = 8;         ///< max size of all uploaded scenarios
  std::int64_t min_free_mib = 512;      ///< the queue is paused if the disk has less free space
  std::vector<std::string> publish_to;  ///< prefixes of addresses to which jobs may publish
  bool webhook_private = false;         ///< permits webhooks to addresses that are not public
  bool log_json = false;                ///< writes the log as JSON lines
  std::filesystem::path log_file;       ///< file of the log; "": stderr, in a container stdout
  double drain_timeout_s = 300;         ///< max wait for running tasks when the service drains
};

/// Prints "throng serving on URL" and serves until SIGTERM or SIGINT, then ends the workers and
/// returns 0; unfinished jobs continue at the next start. SIGUSR2 drains (server/jobs/drain.h),
/// SIGHUP and SIGUSR1 reopen the log. Throws InputError for an address other
/// than loopback without a key, and EnvironmentError if the port or the data folder is in use. Call
/// it before any other thread is started, because it blocks signals for all threads.
int serve(const ServeOptions& options);

}  // namespace throng::server
