#include "server/routes/api.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/resource_exhaustion.h"
#include "jobs/queue/confine/confined_task.h"
#include "server/api/handler.h"
#include "server/api/requests.h"
#include "server/api/session_api.h"
#include "server/api/studio.h"
#include "server/catalog/api_json.h"
#include "server/catalog/service_folders.h"
#include "server/http/file_answer.h"
#include "server/http/http.h"
#include "server/routes/route_table.h"

namespace throng::server {

using httplib::Request;
using httplib::Response;

namespace {

void write_problem(Response& response, const HttpError& error) {
  response.status = error.status;
  if (error.status == 401) response.set_header("WWW-Authenticate", "Bearer");
  const bool may_pass = error.status == 429 || error.status == 503;
  if (may_pass && !response.has_header("Retry-After")) response.set_header("Retry-After", "5");
  response.set_content(dump_text(problem_document(error.status, error.detail, error.problems)),
                       "application/problem+json");
}

constexpr const char* kCalibrations = "/v1/calibrations";
constexpr const char* kStudies = "/v1/studies";
constexpr const char* kScenarios = "/v1/scenarios";
constexpr const char* kJobs = "/v1/jobs";

// The library answers 404 for a method that a path does not know.
void write_library_error(const Request& request, Response& response, const HttpError& error) {
  if (error.status == 404 && error.detail.empty()) {
    std::string methods = allowed_methods(routes(), request.path);
    if (methods.empty()) methods = allowed_methods(studio_routes(), request.path);
    if (!methods.empty()) {
      response.set_header("Allow", methods);
      return write_problem(response, {405, fmt::format("{} is not possible here", request.method)});
    }
    if (is_for_studio(request)) return write_studio(request, response);
    return write_problem(response, {404, "there is nothing at this path"});
  }
  write_problem(response, error);
}

/// The object of the requests to a route, for messages.
std::string_view request_subject(std::string_view path) {
  constexpr std::array kSubjects = {
      std::pair{"/v1/jobs", "the job"},         std::pair{kCalibrations, "the calibration"},
      std::pair{kStudies, "the study"},         std::pair{kScenarios, "the scenarios"},
      std::pair{"/v1/webhooks", "the webhook"}, std::pair{"/v1/keys", "the key"},
      std::pair{"/v1/live", "the flight"}};
  for (const auto& [beginning, subject] : kSubjects) {
    if (path.starts_with(beginning)) return subject;
  }
  return "the request";
}

// Runs the handler of a route; turns what it throws into an answer.
template <typename Handler>
void guarded(const Route& route, const ServiceFolders& folders, const Request& request,
             Response& response, const Handler& handler) {
  try {
    handler();
  } catch (const HttpError& error) {
    write_problem(response, error);
  } catch (const InputError& error) {
    write_problem(response,
                  {400, fmt::format("{} cannot be done as it stands", request_subject(route.path)),
                   folders.without_paths(error.problems())});
  } catch (const QuotaError& error) {
    response.set_header("Retry-After", "60");
    write_problem(response, {429, error.what()});
  } catch (const UploadsFull& error) {
    write_problem(response, {507, error.what()});
  } catch (const NameTaken& error) {
    write_problem(response, {409, error.what()});
  } catch (const ConflictError& error) {
    write_problem(response, {409, error.what()});
  } catch (const EnvironmentError& error) {  // the machine's fault, which may pass
    spdlog::error("{} {}: {}", request.method, request.path, error.what());
    response.set_header("Retry-After", "10");
    write_problem(response, {503, folders.without_paths(error.what())});
  } catch (const std::exception& error) {
    spdlog::error("{} {}: {}", request.method, request.path, error.what());
    const bool may_pass = is_resource_exhaustion(error);
    if (may_pass) response.set_header("Retry-After", "10");
    write_problem(response, {may_pass ? 503 : 500, folders.without_paths(error.what())});
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

constexpr std::size_t kMaxImagesBytes = 256 << 20;
constexpr std::size_t kMaxBundleBytes = 64 << 20;
constexpr std::size_t kMaxTextBytes = 1 << 20;

// A browser sends forms of other sites' pages without asking, with their origin.
void refuse_other_sites(const Request& request) {
  const std::string origin = request.get_header_value("Origin");
  const std::string host = request.get_header_value("Host");
  if (origin.empty() || origin == "http://" + host || origin == "https://" + host) return;
  throw HttpError{403, "pages of other sites may not ask for this"};
}

// Identity of the caller, if it may use the route.
Caller admitted(const Keys& keys, Sessions& sessions, const Request& request, Scope needed) {
  if (needed == Scope::anybody) return {};
  const auto caller = caller_in(keys, sessions, request);
  if (!caller) {
    throw HttpError{401, has_credentials(request)
                             ? keys.refusal_of(key_in(sessions, request))
                             : "this service needs a key: Authorization: Bearer KEY"};
  }
  if (caller->scope < needed) {
    throw HttpError{403, fmt::format("the key's scope is {}, this needs {}",
                                     to_string(caller->scope), to_string(needed))};
  }
  return *caller;
}

const Route* find_route(const Request& request) {
  const auto all = routes();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Route& route) {
    return to_string(route.method) == request.method && fits(route.path, request.path);
  });
  return found == all.end() ? nullptr : &*found;
}

// Access control of a route, independent of the call. Throws HttpError.
Caller checked_caller(const Keys& keys, Sessions& sessions, const Request& request,
                      const Route& route, bool loopback) {
  if (loopback && !names_this_machine(request)) {
    throw HttpError{421, "this service is for its own machine"};
  }
  if (route.method != Method::get) refuse_other_sites(request);
  return admitted(keys, sessions, request, route.scope);
}

std::size_t max_body_bytes(const Route& route, const Request& request) {
  if (route.method != Method::post) return kMaxTextBytes;
  if (request.path == kCalibrations) return kMaxImagesBytes;
  const bool is_bundle =
      request.path == kScenarios || (request.path == kJobs && request.is_multipart_form_data());
  return is_bundle ? kMaxBundleBytes : kMaxTextBytes;
}

// One key leaves half of the connections to others; administrators end what takes too many.
std::shared_ptr<void> held_request(KeyLimit& requests, const Caller& caller) {
  if (caller.scope >= Scope::admin) return nullptr;
  std::shared_ptr<void> held = requests.hold(caller.key_id);
  if (held != nullptr) return held;
  throw HttpError{
      429, fmt::format("this key has {} requests under way, as many as it may", kMaxRequestsOfKey)};
}

// Nothing is read of a body whose sender may not do what they ask for. Throws HttpError.
BodyAdmission body_admission(const Keys& keys, Sessions& sessions, KeyLimit& requests,
                             const Request& request, bool loopback) {
  const Route* route = find_route(request);
  if (route == nullptr) throw HttpError{404, ""};
  const Caller caller = checked_caller(keys, sessions, request, *route, loopback);
  return {max_body_bytes(*route, request), held_request(requests, caller)};
}

AuditEntry audit_entry(const std::string& key, const Request& request, int status) {
  return {key,    request.method,      request.path,
          status, request.remote_addr, request.get_header_value("X-Forwarded-For")};
}

/// A refusal, of the key that was sent if it is one.
void record_refusal(AuditLog& audit, const Keys& keys, Sessions& sessions, const Request& request,
                    int status) {
  std::string key;
  try {
    if (const auto caller = caller_in(keys, sessions, request)) key = caller->key_id;
  } catch (const EnvironmentError& error) {
    spdlog::error("{} {}: {}", request.method, request.path, error.what());
  }
  audit.record_refusal(audit_entry(key, request, status));
}

bool is_audited(const std::string& method, const Route& route) {
  return method != "GET" && method != "HEAD" && route.is_audited;
}

bool is_refusal(int status) { return status == 401 || status == 403 || status == 421; }

HttpOptions with_limits(HttpOptions options, const Keys& keys, Sessions& sessions, AuditLog& audit,
                        KeyLimit& requests) {
  const bool loopback = is_loopback(options.host);
  options.is_urgent = [&keys, &sessions](const Request& request) {
    if (request.path == "/healthz" || request.path == "/readyz") return true;
    const auto caller = caller_in(keys, sessions, request);
    // Without keys everybody is an administrator: then all wait.
    return caller && caller->scope >= Scope::admin && !caller->key_id.empty();
  };
  options.admit_body = [&keys, &sessions, &audit, &requests, loopback](const Request& request) {
    try {
      return body_admission(keys, sessions, requests, request, loopback);
    } catch (const HttpError& error) {
      if (error.status != 404) record_refusal(audit, keys, sessions, request, error.status);
      throw;
    }
  };
  return options;
}

// Answers may hold what strangers have sent: no script in them runs as a part of the
// service's page, nor is it shown within another site's. A report has scripts of its own.
const char* content_policy(const Route& route) {
  return route.has_scripts
             ? "sandbox allow-scripts allow-downloads; default-src 'none'; "
               "script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; "
               "font-src data:; frame-ancestors 'none'"
             : "sandbox; default-src 'none'; style-src 'unsafe-inline'; img-src data:; "
               "frame-ancestors 'none'";
}

/// Keeps an object until the answer, which a content provider may still write, has been sent.
void hold_until_sent(Response& response, std::shared_ptr<void> held) {
  response.content_provider_resource_releaser_ =
      [held = std::move(held), next = response.content_provider_resource_releaser_](bool success) {
        if (next) next(success);
      };
}

bool makes_room(const Route& route) {
  return route.method == Method::remove || std::string_view(route.path).ends_with("/cancel");
}

}  // namespace

Api::Api(Service& service, Keys& keys, WebhookSender& hooks, const HttpOptions& options)
    : queue_(service.queue()),
      audit_(service.folders().data()),
      revoked_(keys, service.queue(), service.live()),
      server_(with_limits(options, keys, sessions_, audit_, requests_),
              [this](const Request& request, Response& response, const HttpError& error) {
                write_library_error(request, response, error);
                const Route* refused = find_route(request);
                http_.note(refused == nullptr ? "" : refused->path, request.method, response.status,
                           0);
              }) {
  const bool loopback = is_loopback(options.host);
  const auto route = [this, &service, &keys, &hooks, loopback](const Route& entry) {
    return [this, &service, &keys, &hooks, loopback, entry](const Request& request,
                                                            Response& response) {
      const SteadyTime begun = steady_now();
      std::string key;
      std::shared_ptr<void> held;
      guarded(entry, service.folders(), request, response, [&] {
        Caller caller = checked_caller(keys, sessions_, request, entry, loopback);
        if (caller.max_bytes > 0) {  // what its live flights have written is not left to its jobs
          caller.max_bytes = std::max<std::int64_t>(
              1, caller.max_bytes - service.live().disk_bytes_of(caller.key_id));
        }
        key = caller.key_id;
        if (entry.scope != Scope::anybody) require_known_parameters(request, entry);
        if (entry.begins_work && service.drain().has_begun()) {
          response.set_header("Retry-After", "60");
          throw HttpError{503, kDraining};
        }
        // Those with a body were counted before it was read.
        const std::string length = request.get_header_value("Content-Length");
        const bool has_body = !length.empty() && length != "0";
        if (!has_body) held = held_request(requests_, caller);
        // A full disk shall not keep anybody from making room.
        const std::shared_ptr<void> room = makes_room(entry) ? service.reserve().free() : nullptr;
        const jobs::TaskSender sender(key);
        entry.handler({{service.queue(),
                        service.uploads(),
                        service.calibrations(),
                        service.studies(),
                        service.housekeeping(),
                        service.datasets(),
                        service.reports(),
                        service.confined(),
                        service.folders(),
                        hooks,
                        service.live(),
                        service.drain(),
                        service.tasks(),
                        http_,
                        service.executor(),
                        keys,
                        sessions_,
                        revoked_,
                        answers_,
                        caller,
                        request,
                        response}});
      });
      http_.note(entry.path, request.method, response.status,
                 std::chrono::duration<double>(steady_now() - begun).count());
      if (held != nullptr) hold_until_sent(response, std::move(held));
      if (is_refusal(response.status)) {
        record_refusal(audit_, keys, sessions_, request, response.status);
      } else if (is_audited(request.method, entry)) {
        audit_.record(audit_entry(key, request, response.status));
      }
      if (!response.has_header("Content-Security-Policy")) {
        response.set_header("Content-Security-Policy", content_policy(entry));
      }
      if (!response.has_header("Cache-Control")) {
        response.set_header("Cache-Control", "private, no-cache");
      }
    };
  };
  httplib::Server& server = server_.routes();
  const auto add = [&](const Route& entry) {
    const std::string pattern = route_pattern(entry.path);
    switch (entry.method) {
      case Method::get:
        server.Get(pattern, route(entry));
        break;
      case Method::post:
        server.Post(pattern, route(entry));
        break;
      case Method::patch:
        server.Patch(pattern, route(entry));
        break;
      case Method::remove:
        server.Delete(pattern, route(entry));
        break;
    }
  };
  for (const Route& entry : routes()) add(entry);
  for (const Route& entry : studio_routes()) add(entry);
}

}  // namespace throng::server
