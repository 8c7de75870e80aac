// Exception of a handler that becomes a problem document.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"

namespace throng::server {

/// Thrown by handlers; the API responds with this status (RFC 9457).
struct HttpError {
  int status;
  std::string detail;
  std::vector<Problem> problems = {};
};

}  // namespace throng::server
