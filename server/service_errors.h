// Refusals of the service that are nobody's mistake.
#pragma once

#include <stdexcept>

namespace throng::server {

/// Somebody has as many jobs as they may have. Answered with 429.
class QuotaError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What is asked for cannot happen in the state that the job is in. Answered with 409.
class ConflictError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace throng::server
