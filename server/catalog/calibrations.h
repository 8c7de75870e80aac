// Calibrations that users have sent: queued like jobs, and cameras for these.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/queue/store/store.h"
#include "server/catalog/confined_checks.h"
#include "server/catalog/queue_state.h"
#include "server/catalog/service_folders.h"

namespace throng::server {

/// A file that came with a calibration's request.
struct Upload {
  std::string name;
  std::string bytes;
};

/// Whose submission it is, and what all of theirs may be.
struct Quota {
  std::string owner = {};      ///< the id of the caller's key
  int max_active = 0;          ///< that may wait or run; 0: any number
  std::int64_t max_bytes = 0;  ///< that all may take already; 0: any
};

/// Safe to use from many threads.
class Calibrations {
 public:
  /// All must outlive it.
  Calibrations(const ServiceFolders& folders, jobs::Store& store, QueueState& state,
               const ConfinedChecks& confined)
      : folders_(folders), store_(store), state_(state), confined_(confined) {}

  /// Queues a calibration (camera/calibration/request.h) of the files that came with it; durable
  /// when it returns. Counts among the owner's jobs. Throws InputError and QuotaError.
  jobs::JobRow submit(std::string_view request_json, const std::vector<Upload>& files,
                      const Quota& quota = {});

  /// The memory that the calibration in a folder needs, in MiB.
  static std::int64_t estimate_memory_mib(const std::filesystem::path& folder);

  /// The camera of one that has succeeded. Throws EnvironmentError saying why there is none.
  nlohmann::json image_camera(const std::string& id) const;

 private:
  const ServiceFolders& folders_;
  jobs::Store& store_;
  QueueState& state_;
  const ConfinedChecks& confined_;
};

}  // namespace throng::server
