// Routes of live flights: /v1/live. A flight continues while a client reads its stream; Studio and
// other programs control it by commands.
#pragma once

#include "server/api/service_parts.h"
#include "server/http/http_fwd.h"

namespace throng::server {

// Handlers; they throw HttpError (server/api/requests.h), InputError and EnvironmentError.

/// Starts a flight of {"job": {...}, "record": false} and responds with 201.
void begin_live(JobQueue& queue, LiveFlights& live, const Caller& caller,
                const httplib::Request& request, httplib::Response& response);
void list_live(LiveFlights& live, const Caller& caller, httplib::Response& response);
void send_live(LiveFlights& live, const Caller& caller, const httplib::Request& request,
               httplib::Response& response);
/// Streams the flight's messages (spec/live/messages.h).
void stream_live(LiveFlights& live, Keys& keys, const Caller& caller,
                 const httplib::Request& request, httplib::Response& response);
void command_live(LiveFlights& live, const Caller& caller, const httplib::Request& request,
                  httplib::Response& response);
/// Ends the flight and sends the outcome: pilot logs, and the job that replays the flight.
void stop_live(LiveFlights& live, const Caller& caller, const httplib::Request& request,
               httplib::Response& response);
/// Sends the recording of a flight that has ended, as MCAP.
void send_live_recording(LiveFlights& live, const Caller& caller, const httplib::Request& request,
                         httplib::Response& response);
void remove_live(LiveFlights& live, const Caller& caller, const httplib::Request& request,
                 httplib::Response& response);

}  // namespace throng::server
