// What the handlers of all routes share: errors that become problem documents, answers, and
// parameters of lists.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "server/job_service.h"

namespace httplib {
struct Request;
struct Response;
}  // namespace httplib

namespace throng::server {

/// What a handler throws to answer with a problem document.
struct HttpError {
  int status;
  std::string detail;
  std::vector<Problem> problems = {};
};

void write_json(httplib::Response& response, int status, const nlohmann::json& value);

/// ?limit= of a list. Throws HttpError.
int limit_of(const httplib::Request& request);
/// ?after= of a list. Throws HttpError.
std::string after_of(const httplib::Request& request);

/// The job or calibration that the path names. Throws HttpError 404.
jobs::JobRow find_row(JobService& service, const httplib::Request& request, jobs::JobKind kind);

}  // namespace throng::server
