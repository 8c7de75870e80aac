// Refusals of valid requests because of the state of the service.
#pragma once

#include <stdexcept>

namespace throng::server {

/// The owner has reached a limit on their jobs. Answered with 429.
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
