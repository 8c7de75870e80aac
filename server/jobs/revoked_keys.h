// End of what revoked keys have under way.
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "server/access/keys.h"
#include "server/jobs/job_queue.h"
#include "server/live/live_flights.h"

namespace throng::server {

/// Cancels active jobs, calibrations and studies of revoked keys, and ends their live flights,
/// until destruction: keys are also revoked by `throng keys`, and a request of such a key may just
/// have been admitted. Safe to use from many threads.
class RevokedKeys {
 public:
  /// Number of ended items.
  struct Ended {
    int jobs = 0;
    int live_flights = 0;
  };

  /// The references must outlive this object.
  RevokedKeys(const Keys& keys, JobQueue& queue, LiveFlights& live);

  /// Throws EnvironmentError.
  Ended end_work() const;

 private:
  const Keys& keys_;
  JobQueue& queue_;
  LiveFlights& live_;
  std::mutex mutex_;
  std::condition_variable_any never_;  ///< waits for a stop request
  std::jthread thread_;
};

}  // namespace throng::server
