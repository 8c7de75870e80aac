// Exception of a handler that becomes a problem document.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"

namespace throng::server {

struct HttpError {
  int status;
  std::string detail;
  std::vector<Problem> problems = {};
};

}  // namespace throng::server
