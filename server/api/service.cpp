#include "server/api/service.h"

#include "base/files/files.h"
#include "base/files/untrusted_folders.h"

namespace throng::server {

namespace fs = std::filesystem;

namespace {

/// Makes the folders, which other users of the machine may not enter.
fs::path with_private_folders(const fs::path& data) {
  for (const char* kind : {"jobs", "calibrations", "studies", "live", "check", "scenarios",
                           "uploads", "quarantine", "trash"}) {
    const fs::path folder = data / kind;
    if (std::string_view(kind) == "jobs") make_folders(folder);
    std::error_code ignored;  // of a folder that is not there, or another user's
    if (fs::is_directory(folder, ignored)) fs::permissions(folder, fs::perms::owner_all, ignored);
  }
  // Workers, which may have been taken over by the input that they work on, write in these.
  for (const char* kind : {"jobs", "calibrations", "studies", "live", "check"}) {
    distrust_folders_in(data / kind);
  }
  return data;
}

}  // namespace

Service::Service(const ServiceOptions& options, jobs::Executor& executor)
    : executor_(executor),
      folders_(with_private_folders(options.data), options.scenarios),
      lock_(folders_.data() / "jobs", "service's folder"),
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
          [this] { return housekeeping_.look_at_disk(); }, options.max_active_jobs, publish_to_),
      tasks_(options.tasks),
      drain_(state_, executor, options.drain) {}

}  // namespace throng::server
