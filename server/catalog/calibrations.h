// Calibrations submitted by users. They are queued like jobs, and jobs may use their cameras.
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
#include "server/catalog/viewer.h"

namespace throng::server {

/// A file that came with a calibration's request.
struct Upload {
  std::string name;
  std::string bytes;
};

/// Owner of a submission and the limits on all of the owner's jobs (jobs::OwnerLimits).
struct Quota {
  std::string owner = {};      ///< id of the caller's key
  int max_active = 0;          ///< max number of queued and running jobs; 0: unlimited
  std::int64_t max_bytes = 0;  ///< max size of all jobs; 0: unlimited
};

/// Safe to use from many threads.
class Calibrations {
 public:
  /// All arguments must outlive this object.
  Calibrations(const ServiceFolders& folders, jobs::Store& store, QueueState& state,
               const ConfinedChecks& confined)
      : folders_(folders), store_(store), state_(state), confined_(confined) {}

  /// Queues a calibration (calibration/request.h) with its files; durable when this returns.
  /// It counts as one of the owner's jobs. Throws InputError and QuotaError.
  jobs::JobRow submit(std::string_view request_json, const std::vector<Upload>& files,
                      const Quota& quota = {});

  /// Estimated memory of the calibration in a folder, in MiB.
  static std::int64_t estimate_memory_mib(const std::filesystem::path& folder);

  /// The camera of a successful calibration that the viewer sees. Throws EnvironmentError that says
  /// why there is none.
  nlohmann::json image_camera(const std::string& id, const Viewer& viewer) const;

 private:
  const ServiceFolders& folders_;
  jobs::Store& store_;
  QueueState& state_;
  const ConfinedChecks& confined_;
};

}  // namespace throng::server
