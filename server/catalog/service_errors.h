// Refusals of the service that are nobody's mistake.
#pragma once

#include <stdexcept>

namespace throng::server {

/// Somebody has as many jobs as they may have. Answered with 429.
class QuotaError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The request is invalid in the job's state. Answered with 409.
class ConflictError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace throng::server
