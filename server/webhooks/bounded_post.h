// One POST to an address that a user has named. Bounded whatever the other side does: in time from
// the name's resolution to the answer's status line, and in what is read of the answer.
#pragma once

#include <chrono>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

namespace throng::server {

struct PostOptions {
  std::chrono::milliseconds timeout{10'000};  ///< for everything together
  /// Whether addresses that are not public may be called (server/webhooks/public_address.h).
  bool allow_private = false;
};

struct PostResult {
  int status = 0;     ///< of the answer, whose other parts are not read; 0: there was none
  std::string error;  ///< why there was none
};

using PostHeaders = std::vector<std::pair<std::string, std::string>>;

/// Sends a JSON body to an http or https URL; redirections are not followed. The name is resolved
/// once, and the connection made to the very address that was checked. Certificates are checked
/// against those of the system ($SSL_CERT_FILE). Ends soon after a stop is requested.
PostResult bounded_post(const std::string& url, const PostHeaders& headers, const std::string& body,
                        const PostOptions& options, const std::stop_token& stop);

/// Whether the URL can be called at all: http or https, a host, a port from 1 to 65535.
bool is_callable_url(const std::string& url);

/// Whether the URL's host is written as an address, and that is not public. Names are known only
/// once they are resolved.
bool names_private_address(const std::string& url);

}  // namespace throng::server
