// Routes of live flights: /v1/live. A flight goes on while somebody reads its stream; the page and
// programs fly it by commands.
#pragma once

#include "server/api/request_context.h"
#include "server/http/http_fwd.h"

namespace throng::server {

// Handlers; they throw HttpError (server/api/requests.h), InputError and EnvironmentError.

/// {"job": {...}}: 201.
void begin_live(const RequestContext& context, const httplib::Request& request,
                httplib::Response& response);
void list_live(const RequestContext& context, const httplib::Request& request,
               httplib::Response& response);
void send_live(const RequestContext& context, const httplib::Request& request,
               httplib::Response& response);
/// Messages (spec/live/messages.h) as they come.
void stream_live(const RequestContext& context, const httplib::Request& request,
                 httplib::Response& response);
void command_live(const RequestContext& context, const httplib::Request& request,
                  httplib::Response& response);
/// The outcome: pilot logs, and the job that repeats the flight.
void stop_live(const RequestContext& context, const httplib::Request& request,
               httplib::Response& response);
void remove_live(const RequestContext& context, const httplib::Request& request,
                 httplib::Response& response);

}  // namespace throng::server
