// `throng serve`: the service from start to SIGTERM.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "jobs/queue/executors.h"

namespace throng::server {

struct ServeOptions {
  std::filesystem::path data;       ///< folder for everything the service keeps
  std::filesystem::path database;   ///< folder for jobs, keys and webhooks; "": `data`
  std::filesystem::path scenarios;  ///< the scenarios that jobs may name
  std::string host = "127.0.0.1";
  int port = 8080;                  ///< 0: any that is free
  std::filesystem::path port_file;  ///< gets the port's number once it is served; "" for none
  bool insecure = false;  ///< listen on addresses that other machines can reach without a key
  std::string executor = "local";   ///< jobs/queue/executors.h
  jobs::SlurmOptions slurm;         ///< of that executor
  int workers = 0;                  ///< processes at once; 0: one per core
  int max_active_jobs = 16;         ///< worked on at once
  double live_timeout_s = 30;       ///< after which a live flight ends that nobody looks at
  double max_task_s = 0;            ///< a worker that takes longer has hung; 0: any time
  int worker_memory_mib = 0;        ///< address space of each; 0: by what its task needs
  std::int64_t memory_mib = 0;      ///< that all workers may need together; 0: 7/8 of the machine's
  std::int64_t keep_days = 0;       ///< after a job's end; 0: for good
  std::int64_t keep_gib = 0;        ///< that all jobs may take together; 0: any
  std::int64_t uploads_gib = 8;     ///< that all uploaded scenarios may take together
  std::int64_t min_free_mib = 512;  ///< below this the queue is paused
  std::vector<std::string> publish_to;  ///< addresses that jobs may publish to, and below them
  bool webhook_private = false;         ///< webhooks may lead to addresses that are not public
  bool log_json = false;
};

/// Prints "throng serving on URL" to stdout and serves until SIGTERM or SIGINT, then ends the
/// workers and returns 0; the job they were at goes on at the next start. Throws InputError for an
/// address that is not loopback while there is no key, EnvironmentError when the port or the data
/// folder is taken. RequestContext it before any other thread is started: it blocks signals for all
/// threads.
int serve(const ServeOptions& options);

}  // namespace throng::server
