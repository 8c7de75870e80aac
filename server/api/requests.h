// Shared by the handlers of all routes: errors that become problem documents, answers, and
// parameters of lists.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "server/api/request_context.h"
#include "server/http/http_error.h"
#include "server/http/http_fwd.h"

namespace throng::server {

void write_json(httplib::Response& response, int status, const nlohmann::json& value);

/// A parameter of the query that is a whole number in [min_number, max_number]; `usual` where it is
/// not given. Throws HttpError 400.
std::int64_t requested_number(const httplib::Request& request, const char* name,
                              std::int64_t min_number, std::int64_t max_number, std::int64_t usual);
/// A flag of the query: given without a value, or true. Throws HttpError 400.
bool is_asked(const httplib::Request& request, const char* name);
/// ?limit= of a list. Throws HttpError.
int requested_limit(const httplib::Request& request);
/// ?after= of a list. Throws HttpError.
std::string cursor_from_request(const httplib::Request& request);

/// Throws HttpError 415 unless the body is sent as JSON. Also keeps web pages of others from
/// submitting: a browser asks before it sends this type.
void require_json(const httplib::Request& request);

/// The body, which has to be a JSON object. Throws HttpError and InputError.
nlohmann::json parse_json_body(const httplib::Request& request);

/// 400: a field of what was sent is wrong.
HttpError wrong_field(std::string_view what, const std::string& pointer, const std::string& found,
                      const std::string& expected);

/// A JSON object with no other fields than these. Throws HttpError and InputError.
nlohmann::json json_fields(const httplib::Request& request, std::string_view what,
                           std::initializer_list<std::string_view> known);

/// Whether the caller may know of all jobs. Others know of their own, and of those with the label
/// "shared".
bool sees_all(const Caller& caller);
bool is_visible(const Caller& caller, const jobs::JobRow& row);
/// For JobFilter::visible_to.
std::optional<std::string> viewer_key(const Caller& caller);

/// The job that the path names. Throws HttpError 404, also for one that the caller does not see.
jobs::JobRow find_job(const RequestContext& context, const httplib::Request& request);

/// Throws HttpError 403 unless the caller owns the job, calibration or study, or is an
/// administrator.
void require_own(const RequestContext& context, const jobs::JobRow& row);

/// Likewise one of this kind.
jobs::JobRow find_row(const RequestContext& context, const httplib::Request& request,
                      jobs::JobKind kind);

}  // namespace throng::server
