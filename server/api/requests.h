// Functions that the handlers of all routes share: parameters of requests, permissions, responses.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "server/api/service_parts.h"
#include "server/catalog/viewer.h"
#include "server/description/routes.h"
#include "server/http/http_error.h"
#include "server/http/http_fwd.h"

namespace throng::server {

/// Detail of a 503 while the service drains.
inline constexpr const char* kDraining =
    "the service is about to end, and begins nothing new; it goes on after its next start";

void write_json(httplib::Response& response, int status, const nlohmann::json& value);

/// An integer parameter of the query in [min_number, max_number]; `usual` if it is missing. Throws
/// HttpError 400.
std::int64_t requested_number(const httplib::Request& request, const char* name,
                              std::int64_t min_number, std::int64_t max_number, std::int64_t usual);
/// Whether a flag of the query is set, without a value or as true. Throws HttpError 400.
bool is_asked(const httplib::Request& request, const char* name);
inline constexpr int kMaxPageRows = 500;
inline constexpr int kUsualPageRows = 50;
/// ?limit= of a list. Throws HttpError.
int requested_limit(const httplib::Request& request);
/// ?after= of a list. Throws HttpError.
std::string cursor_from_request(const httplib::Request& request);

/// Throws HttpError 400 for a parameter of the query that the route does not have: a dry run that
/// is misspelled would be none.
void require_known_parameters(const httplib::Request& request, const Route& route);

/// Throws HttpError 415 unless the body has a JSON media type. This also protects from requests by
/// other web pages, because browsers send a preflight request before this type.
void require_json(const httplib::Request& request);

/// The body, which has to be a JSON object. Throws HttpError and InputError.
nlohmann::json parse_json_body(const httplib::Request& request);

/// A HttpError 400 about a wrong field of the body.
HttpError wrong_field(std::string_view what, const std::string& pointer, const std::string& found,
                      const std::string& expected);

/// The body, a JSON object with no other members than `known`. Throws HttpError and InputError.
nlohmann::json json_fields(const httplib::Request& request, std::string_view what,
                           std::initializer_list<std::string_view> known);

/// Whether the caller may see all jobs. Other callers see their own and those labeled "shared".
bool sees_all(const Caller& caller);
bool is_visible(const Caller& caller, const jobs::JobRow& row);
/// The caller as a viewer of jobs, also the value of JobFilter::visible_to.
Viewer viewer_key(const Caller& caller);

/// The job in the request's path. Throws HttpError 404 if there is none that the caller may see.
jobs::JobRow find_job(JobQueue& queue, const Caller& caller, const httplib::Request& request);

/// Sends a page of rows as {"NAME": [...], "next": ...} and the members of `more`. The page ends
/// early when its rows are large. Throws HttpError 503 if there are too many such answers at once.
void send_rows(JobQueue& queue, AnswerBudget& answers, httplib::Response& response,
               const char* name, jobs::JobFilter filter,
               const std::function<nlohmann::json(const jobs::JobRow&)>& to_json,
               const nlohmann::json& more = {});

/// Throws HttpError 403 unless the caller owns the job, calibration or study, or is an
/// administrator.
void require_own(const Caller& caller, const jobs::JobRow& row);

/// Queues the caller's job or study again. Throws HttpError 404 if it has been removed and 409 if
/// its owner's key is revoked, and as JobQueue::retry().
jobs::JobRow retried(JobQueue& queue, Keys& keys, const Caller& caller, const jobs::JobRow& own);

/// The job of this kind in the request's path. Throws as find_job().
jobs::JobRow find_row(JobQueue& queue, const Caller& caller, const httplib::Request& request,
                      jobs::JobKind kind);

}  // namespace throng::server
