// Reason phrases of HTTP.
#pragma once

namespace throng::server {

/// The reason phrase of a status (RFC 9110): "Not Found".
const char* reason_phrase(int status);

}  // namespace throng::server
