#include "server/api/service.h"

#include "base/files/untrusted_folders.h"

namespace throng::server {

namespace {

/// Workers, which may have been taken over by the input that they work on, write in these folders.
std::filesystem::path with_distrusted_folders(const std::filesystem::path& data) {
  for (const char* kind : {"jobs", "calibrations", "studies", "live", "check"}) {
    distrust_folders_in(data / kind);
  }
  return data;
}

}  // namespace

Service::Service(const ServiceOptions& options, jobs::Executor& executor)
    : executor_(executor),
      folders_(with_distrusted_folders(options.data), options.scenarios),
      publish_to_(options.publish_to),
      reserve_(options.database.empty() ? options.data : options.database),
      store_(options.database.empty() ? options.data : options.database, options.clock,
             options.steady),
      confined_(options.confined, options.data, options.max_task_mib),
      state_(store_),
      uploads_(folders_, store_, confined_, options.uploads),
      calibrations_(folders_, store_, state_, confined_),
      studies_(folders_, store_, state_, uploads_, confined_),
      queue_(folders_, store_, state_, uploads_, calibrations_, confined_, publish_to_),
      housekeeping_(folders_, store_, state_, uploads_, reserve_, options.housekeeping),
      reports_(executor),
      live_(options.data, options.live),
      runner_(
          folders_, store_, state_, uploads_, executor,
          [this] { return housekeeping_.look_at_disk(); }, options.max_active_jobs, publish_to_) {}

}  // namespace throng::server
