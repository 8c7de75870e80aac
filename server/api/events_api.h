// Events of jobs and studies, as a stream.
#pragma once

#include "server/api/service_parts.h"
#include "server/http/http_fwd.h"

namespace throng::server {

inline constexpr int kMaxEventsOfPage = 500;
inline constexpr int kMaxEventWaitS = 60;

/// GET /v1/jobs/{id}/events and GET /v1/events. With "Accept: text/event-stream", sends Server-Sent
/// Events after Last-Event-ID (or ?after=): past events in order, then new ones with the job's
/// progress in between, until the job has ended. Otherwise sends at most ?limit= events after
/// ?after= as JSON and waits up to ?wait_s= for the first one.
void send_events(JobQueue& queue, const ServiceFolders& folders, Keys& keys, const Caller& caller,
                 const httplib::Request& request, httplib::Response& response);

/// GET /v1/studies/{id}/events, in the same formats.
void send_study_events(JobQueue& queue, Keys& keys, const Caller& caller,
                       const httplib::Request& request, httplib::Response& response);

}  // namespace throng::server
