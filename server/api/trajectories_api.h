// Positions of all people in a run, for clients that draw them.
#pragma once

#include "server/api/service_parts.h"
#include "server/http/http_fwd.h"

namespace throng::server {

/// Limits of the times that are asked for.
inline constexpr double kMaxTimeS = 1e6;
inline constexpr double kMinEveryS = 0.001;

/// GET /v1/jobs/{id}/runs/{n}/trajectories?from_s=&to_s=&every_s= : sends positions from the run's
/// trace in a compact binary format (docs/api.md), in any state of the job.
void send_trajectories(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                       const httplib::Request& request, httplib::Response& response);

}  // namespace throng::server
