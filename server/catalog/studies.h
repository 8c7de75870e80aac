// Studies submitted by users. They are queued like jobs; each run is a task
// (server/jobs/study_work.h).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "jobs/queue/store/store.h"
#include "server/catalog/calibrations.h"
#include "server/catalog/confined_checks.h"
#include "server/catalog/queue_state.h"
#include "server/catalog/service_folders.h"
#include "server/catalog/uploads.h"

namespace throng::server {

/// Safe to use from many threads.
class Studies {
 public:
  /// All arguments must outlive this object.
  Studies(const ServiceFolders& folders, jobs::Store& store, QueueState& state,
          const Uploads& uploads, const ConfinedChecks& confined)
      : folders_(folders), store_(store), state_(state), uploads_(uploads), confined_(confined) {}

  /// Checks a study and returns its plan (jobs/study/service_work.h). Throws InputError.
  nlohmann::json checked(const nlohmann::json& document) const;

  /// Queues a study; durable when this returns. It counts as one of the owner's jobs. Throws
  /// InputError and QuotaError.
  jobs::JobRow submit(const nlohmann::json& document, const Quota& quota);

  /// The plan with which a study was queued.
  nlohmann::json plan_of(const jobs::JobRow& row) const;
  /// The summary of the runs that every policy of a case has so far, with "took_s"; null if there
  /// are none.
  nlohmann::json summarize(const jobs::JobRow& row) const;

 private:
  const ServiceFolders& folders_;
  jobs::Store& store_;
  QueueState& state_;
  const Uploads& uploads_;
  const ConfinedChecks& confined_;
};

}  // namespace throng::server
