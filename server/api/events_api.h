// Events of jobs and studies, as a stream.
#pragma once

#include "server/api/request_context.h"
#include "server/http/http_fwd.h"

namespace throng::server {

/// GET /v1/jobs/{id}/events and GET /v1/events. With "Accept: text/event-stream" Server-Sent Events
/// that begin after Last-Event-ID (or ?after=): past events come first, in order, then new ones
/// with the job's progress in between; they end when the job has ended. Else at most ?limit= events
/// after ?after= as JSON, for which ?wait_s= waits.
void send_events(const RequestContext& context, const httplib::Request& request,
                 httplib::Response& response);

/// GET /v1/studies/{id}/events, likewise.
void send_study_events(const RequestContext& context, const httplib::Request& request,
                       httplib::Response& response);

}  // namespace throng::server
