// How long jobs are kept once they have ended. Pure: the job service applies it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "jobs/queue/store/store.h"

namespace throng::server {

struct Retention {
  std::int64_t max_wait_ms = 0;  ///< after a job's end; 0: for good
  std::int64_t max_bytes = 0;    ///< that all jobs may take together; 0: any
};

/// When the job will be removed for its age, by the time of jobs::ServiceClock (ms); nothing when
/// it will not. It may go earlier where all jobs together take too much.
std::optional<std::int64_t> expiry_ms(const jobs::JobRow& row, const Retention& retention);

/// Selects the jobs to remove now (by the same time), among ended jobs that need not be kept, in
/// the order in which they ended: jobs that are too old, and then the oldest until the others fit.
std::vector<std::string> expired(const std::vector<jobs::JobRow>& ended, std::int64_t total_bytes,
                                 std::int64_t now_ms, const Retention& retention);

}  // namespace throng::server
