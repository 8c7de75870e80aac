// One POST to an address that a user has chosen. Its time, from name resolution to the status line,
// and the bytes read of the response are bounded whatever the other side does.
#pragma once

#include <chrono>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

namespace throng::server {

struct PostOptions {
  std::chrono::milliseconds timeout{10'000};  ///< total time of the request
  /// Whether addresses that are not public may be called (server/webhooks/public_address.h).
  bool allow_private = false;
};

struct PostResult {
  int status = 0;     ///< HTTP status; 0: no response
  std::string error;  ///< why there was no response
};

using PostHeaders = std::vector<std::pair<std::string, std::string>>;

/// Sends a JSON body to an http or https URL without following redirections. The host name is
/// resolved once, and the connection uses the address that was checked. Certificates are verified
/// with those of the system ($SSL_CERT_FILE). Ends soon after a stop request.
PostResult bounded_post(const std::string& url, const PostHeaders& headers, const std::string& body,
                        const PostOptions& options, const std::stop_token& stop);

/// Whether the URL is valid: http or https, a host, a port from 1 to 65535.
bool is_callable_url(const std::string& url);

/// Whether the URL's host is a literal address that is not public. Host names are checked only when
/// they are resolved.
bool names_private_address(const std::string& url);

}  // namespace throng::server
