#include "server/api.h"

#include <fmt/core.h>
#include <httplib.h>
#include <spdlog/spdlog.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "server/answers.h"
#include "server/calibration_api.h"
#include "server/downloads_api.h"
#include "server/events_api.h"
#include "server/jobs_api.h"
#include "server/requests.h"
#include "server/service_api.h"

namespace throng::server {

using httplib::Request;
using httplib::Response;

namespace {

void write_problem(Response& response, const HttpError& error) {
  response.status = error.status;
  response.set_content(text_of(problem_document(error.status, error.detail, error.problems)),
                       "application/problem+json");
}

constexpr const char* kCalibrations = "/v1/calibrations";

}  // namespace

std::span<const Route> routes() {
  static constexpr std::array kRoutes = {
      Route{Method::post, "/v1/jobs", &submit_job},
      Route{Method::get, "/v1/jobs", &list_jobs},
      Route{Method::get, "/v1/jobs/{id}", &send_job},
      Route{Method::patch, "/v1/jobs/{id}", &change_job},
      Route{Method::remove, "/v1/jobs/{id}", &remove_job},
      Route{Method::post, "/v1/jobs/{id}/cancel", &cancel_job},
      Route{Method::post, "/v1/jobs/{id}/retry", &retry_job},
      Route{Method::post, "/v1/jobs/{id}/clone", &clone_job},
      Route{Method::get, "/v1/jobs/{id}/events", &send_events},
      Route{Method::get, "/v1/jobs/{id}/logs", &list_logs},
      Route{Method::get, "/v1/jobs/{id}/logs/{name}", &send_log},
      Route{Method::get, "/v1/jobs/{id}/previews", &list_previews},
      Route{Method::get, "/v1/jobs/{id}/previews/{path}", &send_preview},
      Route{Method::get, "/v1/jobs/{id}/archive", &send_archive},
      Route{Method::get, "/v1/jobs/{id}/manifest", &send_manifest},
      Route{Method::get, "/v1/jobs/{id}/files/{path}", &send_file},
      Route{Method::get, "/v1/jobs/{id}/metrics", &send_metrics},
      Route{Method::get, "/v1/jobs/{id}/runs/{n}/metrics", &send_run_metrics},
      Route{Method::get, "/v1/jobs/{id}/runs/{n}/metrics.csv", &send_run_metrics_csv},
      Route{Method::get, "/v1/events", &send_events},
      Route{Method::post, kCalibrations, &submit_calibration},
      Route{Method::get, kCalibrations, &list_calibrations},
      Route{Method::get, "/v1/calibrations/{id}", &send_calibration},
      Route{Method::remove, "/v1/calibrations/{id}", &remove_calibration},
      Route{Method::get, "/v1/calibrations/{id}/{name}", &send_calibration_result},
      Route{Method::get, "/v1/scenarios", &list_scenarios},
      Route{Method::get, "/v1/scenarios/{path}", &send_scenario},
      Route{Method::get, "/v1/airframes", &list_airframes},
      Route{Method::get, "/v1/policies", &list_policies},
      Route{Method::get, "/v1/formats", &list_formats},
      Route{Method::get, "/v1/schema", &send_schema},
      Route{Method::get, "/v1/version", &send_version},
      Route{Method::get, "/openapi.json", &send_openapi},
      Route{Method::get, "/metrics", &send_figures},
      Route{Method::get, "/healthz", &send_health},
      Route{Method::get, "/readyz", &send_readiness},
  };
  return kRoutes;
}

namespace {

// The library answers 404 for a method that a path does not know.
void write_library_error(const Request& request, Response& response, int status,
                         const std::string& detail) {
  if (status == 404) {
    if (const std::string methods = allowed_methods(routes(), request.path); !methods.empty()) {
      response.set_header("Allow", methods);
      return write_problem(response, {405, fmt::format("{} is not possible here", request.method)});
    }
    return write_problem(response, {404, "there is nothing at this path"});
  }
  write_problem(response, {status, detail});
}

// Runs a handler; turns what it throws into an answer.
template <typename Handler>
void guarded(const JobService& service, const Request& request, Response& response,
             const Handler& handler) {
  try {
    handler();
  } catch (const HttpError& error) {
    write_problem(response, error);
  } catch (const InputError& error) {
    std::vector<Problem> problems = error.problems();
    for (Problem& problem : problems) problem.source = service.without_paths(problem.source);
    write_problem(response, {400, "the job cannot be done as it stands", problems});
  } catch (const ConflictError& error) {
    write_problem(response, {409, error.what()});
  } catch (const std::exception& error) {
    spdlog::error("{} {}: {}", request.method, request.path, error.what());
    write_problem(response, {500, service.without_paths(error.what())});
  }
}

// A page of another site that has its name point here (DNS rebinding) still names itself.
bool names_this_machine(const Request& request) {
  std::string host = request.get_header_value("Host");
  const auto colon = host.rfind(':');
  if (colon != std::string::npos && host.find(']', colon) == std::string::npos) host.resize(colon);
  if (host.size() > 2 && host.front() == '[') host = host.substr(1, host.size() - 2);
  return host.empty() || is_loopback(host);
}

// Pictures of boards are uploaded; everything else is small.
constexpr std::size_t kLargestUpload = 256 << 20;
constexpr std::size_t kLargestText = 1 << 20;

HttpOptions with_uploads(HttpOptions options) {
  options.largest_body = kLargestUpload;
  return options;
}

}  // namespace

Api::Api(JobService& service, const HttpOptions& options)
    : server_(with_uploads(options), &write_library_error) {
  const bool loopback = is_loopback(options.host);
  const auto route = [&service, loopback](void (*handler)(JobService&, const Request&, Response&)) {
    return [&service, loopback, handler](const Request& request, Response& response) {
      guarded(service, request, response, [&] {
        if (loopback && !names_this_machine(request)) {
          throw HttpError{421, "this service is for its own machine"};
        }
        if (request.path != kCalibrations && request.body.size() > kLargestText) {
          throw HttpError{413, fmt::format("a body may have {} bytes here", kLargestText)};
        }
        handler(service, request, response);
      });
    };
  };
  httplib::Server& server = server_.routes();
  for (const Route& entry : routes()) {
    const std::string pattern = pattern_of(entry.path);
    switch (entry.method) {
      case Method::get:
        server.Get(pattern, route(entry.handler));
        break;
      case Method::post:
        server.Post(pattern, route(entry.handler));
        break;
      case Method::patch:
        server.Patch(pattern, route(entry.handler));
        break;
      case Method::remove:
        server.Delete(pattern, route(entry.handler));
        break;
    }
  }
}

}  // namespace throng::server
