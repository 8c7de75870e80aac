// Routes of live flights: /v1/live. A flight goes on while somebody reads its stream; the page and
// programs fly it by commands.
#pragma once

#include "server/call.h"
#include "server/http_fwd.h"

namespace throng::server {

// Handlers; they throw HttpError (server/requests.h), InputError and EnvironmentError.

/// {"job": {...}}: 201.
void begin_live(const Call& call, const httplib::Request& request, httplib::Response& response);
void list_live(const Call& call, const httplib::Request& request, httplib::Response& response);
void send_live(const Call& call, const httplib::Request& request, httplib::Response& response);
/// Messages (live/spec/messages.h) as they come.
void stream_live(const Call& call, const httplib::Request& request, httplib::Response& response);
void command_live(const Call& call, const httplib::Request& request, httplib::Response& response);
/// The outcome: pilot logs, and the job that repeats the flight.
void stop_live(const Call& call, const httplib::Request& request, httplib::Response& response);
void remove_live(const Call& call, const httplib::Request& request, httplib::Response& response);

}  // namespace throng::server
