// Metrics of the answers to requests, for Prometheus.
#pragma once

#include <string>
#include <string_view>

#include "base/text/prometheus.h"

namespace throng::server {

/// Answers by route, method and status. Safe to use from many threads.
class HttpMeters {
 public:
  /// Notes an answer to a request for the path of a route, or "" for a path without one.
  void note(std::string_view route, const std::string& method, int status, double seconds);
  std::string text() const { return requests_.text() + seconds_.text(); }

 private:
  PrometheusMeter requests_{"throng_http_requests_total",
                            "Requests, by group of routes, method and status."};
  PrometheusMeter seconds_{"throng_http_request_seconds",
                           "Time until the answer begins, by group of routes.",
                           {0.005, 0.02, 0.1, 0.5, 2, 10, 30}};
};

}  // namespace throng::server
