#include "server/api/requests.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "base/json/json_text.h"
#include "base/text/suggest.h"
#include "base/text/words.h"
#include "jobs/queue/store/job_id.h"
#include "server/access/keys.h"
#include "server/api/list_answer.h"
#include "server/catalog/api_json.h"
#include "server/http/answer_budget.h"
#include "server/http/http.h"
#include "server/jobs/job_queue.h"

namespace throng::server {

using httplib::Request;
using nlohmann::json;

void write_json(httplib::Response& response, int status, const json& value) {
  response.status = status;
  response.set_content(dump_text(value), "application/json");
}

std::int64_t requested_number(const Request& request, const char* name, std::int64_t min_number,
                              std::int64_t max_number, std::int64_t usual) {
  if (!request.has_param(name)) return usual;
  const std::string text = request.get_param_value(name);
  std::int64_t number = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size() || number < min_number ||
      number > max_number) {
    throw HttpError{400,
                    fmt::format("{} is wrong", name),
                    {{"", fmt::format("?{}", name), text,
                      fmt::format("an integer from {} to {}", min_number, max_number)}}};
  }
  return number;
}

bool is_asked(const Request& request, const char* name) {
  if (!request.has_param(name)) return false;
  const std::string value = request.get_param_value(name);
  if (value.empty() || value == "1" || value == "true") return true;
  if (value == "0" || value == "false") return false;
  throw HttpError{400,
                  fmt::format("{} is wrong", name),
                  {{"", fmt::format("?{}", name), value, "true or false"}}};
}

int requested_limit(const Request& request) {
  return static_cast<int>(requested_number(request, "limit", 1, kMaxPageRows, kUsualPageRows));
}

void require_known_parameters(const Request& request, const Route& route) {
  if (request.target.find('?') == std::string::npos) return;  // a form's fields are no query
  std::vector<std::string_view> known;
  known.reserve(route.says.parameters.size());
  for (const Parameter& parameter : route.says.parameters) {
    if (parameter.location == Parameter::Location::query) known.emplace_back(parameter.name);
  }
  for (const auto& [name, value] : request.params) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string where = "?" + name;
    const Problem problem = known.empty() ? Problem{"", where, "a parameter", "none"}
                                          : unknown_name("", where, "parameter", name, known);
    throw HttpError{400, "the query is wrong", {problem}};
  }
}

void require_json(const Request& request) {
  const std::string type = request.get_header_value("Content-Type");
  if (type.substr(0, type.find(';')) != "application/json") {
    throw HttpError{
        415, fmt::format("found a body {}, expected Content-Type: application/json",
                         type.empty() ? "without a Content-Type" : "of Content-Type " + type)};
  }
}

json parse_json_body(const Request& request) {
  json body;
  try {
    body = parse_json(request.body, "", kRequestJsonLimits);
  } catch (const InputError& error) {
    throw HttpError{400, "the body is not the JSON that can be read here", error.problems()};
  }
  if (!body.is_object()) throw HttpError{400, "the body is no JSON object"};
  return body;
}

HttpError wrong_field(std::string_view what, const std::string& pointer, const std::string& found,
                      const std::string& expected) {
  return {400, fmt::format("the {} is wrong", what), {{"", pointer, found, expected}}};
}

json json_fields(const Request& request, std::string_view what,
                 std::initializer_list<std::string_view> known) {
  require_json(request);
  json body = parse_json_body(request);
  for (const auto& [name, value] : body.items()) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw wrong_field(what, "/" + name, fmt::format("unknown field \"{}\"", name),
                        fmt::format("one of: {}", fmt::join(known, ", ")));
    }
  }
  return body;
}

std::string cursor_from_request(const Request& request) {
  std::string after = request.get_param_value("after");
  if (!after.empty() && !jobs::is_job_id(after)) {
    throw HttpError{400, "after is wrong", {{"", "?after", after, "the id of a job"}}};
  }
  return after;
}

bool sees_all(const Caller& caller) { return caller.scope >= Scope::admin; }

bool is_visible(const Caller& caller, const jobs::JobRow& row) {
  return is_visible(viewer_key(caller), row);
}

Viewer viewer_key(const Caller& caller) {
  return sees_all(caller) ? Viewer() : Viewer(caller.key_id);
}

namespace {

std::string_view kind_word(jobs::JobKind kind) {
  return kind == jobs::JobKind::dataset ? "job" : to_string(kind);
}

}  // namespace

jobs::JobRow find_job(JobQueue& queue, const Caller& caller, const Request& request) {
  return find_row(queue, caller, request, jobs::JobKind::dataset);
}

void send_rows(JobQueue& queue, AnswerBudget& answers, httplib::Response& response,
               const char* name, jobs::JobFilter filter,
               const std::function<json(const jobs::JobRow&)>& to_json, const json& more) {
  ListAnswer answer(answers, name);
  filter.max_text_bytes = kMaxPageBytes;
  const std::vector<jobs::JobRow> rows = queue.list(filter);
  std::size_t bytes = 0;
  std::size_t sent = 0;
  for (; sent < rows.size() && !answer.is_full(); ++sent) {
    answer.add(to_json(rows[sent]));
    bytes += text_bytes(rows[sent]);
  }
  const bool has_more =
      sent < rows.size() || static_cast<int>(sent) == filter.limit || bytes >= kMaxPageBytes;
  answer.send(response, has_more ? rows[sent - 1].id : "", more);
}

void require_own(const Caller& caller, const jobs::JobRow& row) {
  if (caller.scope >= Scope::admin || row.owner == caller.key_id) return;
  throw HttpError{
      403, fmt::format("the {} is another's: only its owner and administrators may change it",
                       kind_word(row.kind))};
}

jobs::JobRow find_row(JobQueue& queue, const Caller& caller, const Request& request,
                      jobs::JobKind kind) {
  const std::string id = request.matches[1];
  std::optional<jobs::JobRow> row;
  if (jobs::is_job_id(id)) row = queue.get(id);
  if (!row || row->kind != kind || !is_visible(caller, *row)) {
    throw HttpError{404, fmt::format("there is no {} {}", kind_word(kind), id)};
  }
  return std::move(*row);
}

jobs::JobRow retried(JobQueue& queue, Keys& keys, const Caller& caller, const jobs::JobRow& own) {
  for (const KeyRow& key : keys.list()) {
    if (key.id != own.owner || key.revoked_ms == 0) continue;
    throw HttpError{409,
                    "the key of its owner is revoked, so that it would be cancelled: submit it "
                    "again with another key"};
  }
  // An administrator may retry another's beyond its key's limits.
  const bool is_owner = own.owner == caller.key_id;
  const auto row =
      queue.retry(own.id, is_owner ? jobs::OwnerLimits{caller.max_active, caller.max_bytes}
                                   : jobs::OwnerLimits{});
  if (!row) throw HttpError{404, "it has been removed"};
  return *row;
}

}  // namespace throng::server
