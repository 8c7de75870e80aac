// Sign-in of browsers, and authentication of requests.
#pragma once

#include <optional>
#include <string>

#include "server/api/service_parts.h"
#include "server/http/http_fwd.h"

namespace throng::server {

/// The caller of a request, from the key in its Authorization header or else its session cookie;
/// std::nullopt if a required key is missing or invalid. A cookie counts only for requests from the
/// service's own pages, because browsers also send it with requests from other ports of this host.
std::optional<Caller> caller_in(const Keys& keys, Sessions& sessions,
                                const httplib::Request& request);

/// The key of a request, valid or not, which caller_in() looks up; "" without one.
std::string key_in(Sessions& sessions, const httplib::Request& request);

/// Whether a request has a key or a session cookie, valid or not.
bool has_credentials(const httplib::Request& request);

/// Responds with 204 to callers with sufficient scope, for proxies that check access before they
/// read a body (docker/nginx.conf).
void confirm_access(httplib::Response& response);

void open_session(Keys& keys, Sessions& sessions, const httplib::Request& request,
                  httplib::Response& response);
void send_session(Keys& keys, Sessions& sessions, const httplib::Request& request,
                  httplib::Response& response);
void close_session(Sessions& sessions, const httplib::Request& request,
                   httplib::Response& response);

}  // namespace throng::server
