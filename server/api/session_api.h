// Sign-in of browsers, and the identity of a request's sender.
#pragma once

#include <optional>

#include "server/api/request_context.h"
#include "server/http/http_fwd.h"

namespace throng::server {

/// Sender of a request, by the key in its Authorization header, or else by its session's cookie;
/// nothing when a key is required and missing. A cookie counts only for requests of the service's
/// own pages: it is also sent with those of other ports of this host.
std::optional<Caller> caller_in(const Keys& keys, Sessions& sessions,
                                const httplib::Request& request);

/// Whether a request came with a key or a session, good or not.
bool has_credentials(const httplib::Request& request);

/// 204: for proxies that ask before they read a body (docker/nginx.conf). The route refuses others.
void confirm_access(const RequestContext& context, const httplib::Request& request,
                    httplib::Response& response);

void open_session(const RequestContext& context, const httplib::Request& request,
                  httplib::Response& response);
void send_session(const RequestContext& context, const httplib::Request& request,
                  httplib::Response& response);
void close_session(const RequestContext& context, const httplib::Request& request,
                   httplib::Response& response);

}  // namespace throng::server
