// Retention of ended jobs by age and size. Pure functions; the service applies them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "jobs/queue/store/store.h"

namespace throng::server {

/// The rules.
struct Retention {
  std::int64_t max_wait_ms = 0;  ///< max age, counted from a job's end; 0: unlimited
  std::int64_t max_bytes = 0;    ///< max size of all jobs together; 0: unlimited
};

/// When the job will be removed for its age, by jobs::ServiceClock (ms); std::nullopt if it will
/// not. It may be removed earlier if all jobs together are too large.
std::optional<std::int64_t> expiry_ms(const jobs::JobRow& row, const Retention& retention);

/// Ids of the jobs to remove at `now_ms` (by jobs::ServiceClock). `ended` are the ended jobs that
/// may be removed, in the order of their ends (Store::ended()), `total_bytes` is the size of all
/// jobs: selects the jobs that are too old, then the oldest ones until the others fit.
std::vector<std::string> expired(const std::vector<jobs::JobRow>& ended, std::int64_t total_bytes,
                                 std::int64_t now_ms, const Retention& retention);

}  // namespace throng::server
