#include "server/api/jobs_api.h"

#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/json/json_text.h"
#include "jobs/queue/store/job_id.h"
#include "server/access/keys.h"
#include "server/api/requests.h"
#include "server/api/row_changes.h"
#include "server/catalog/api_json.h"
#include "server/http/answer_budget.h"
#include "server/http/http.h"
#include "server/jobs/housekeeping.h"
#include "server/jobs/job_queue.h"
#include "spec/job/plan.h"
#include "spec/job/resolved_job.h"
#include "spec/job/spec.h"

namespace throng::server {

using httplib::Request;
using httplib::Response;
using nlohmann::json;

namespace {

/// A job that the caller may change: their own, or any for an administrator. Throws HttpError.
jobs::JobRow find_own(JobQueue& queue, const Caller& caller, const Request& request) {
  jobs::JobRow row = find_job(queue, caller, request);
  require_own(caller, row);
  return row;
}

void write_job(Housekeeping& housekeeping, Response& response, int status,
               const jobs::JobRow& row) {
  response.status = status;
  response.set_content(job_text(row, housekeeping.retention()), "application/json");
}

/// The value of every ?name= in the query.
std::vector<std::string> query_values(const Request& request, const char* name) {
  std::vector<std::string> values;
  for (std::size_t i = 0; i < request.get_param_value_count(name); ++i) {
    values.push_back(request.get_param_value(name, i));
  }
  return values;
}

std::string idempotency_key(const Request& request) {
  std::string key = request.get_header_value("Idempotency-Key");
  if (key.size() > kMaxIdempotencyKeyLength) {
    throw HttpError{
        400, fmt::format("an Idempotency-Key has at most {} characters", kMaxIdempotencyKeyLength)};
  }
  return key;
}

/// A multipart/form-data upload: a job, and a bundle with its scenarios.
struct Form {
  std::string job;
  const std::string* bundle = nullptr;
};

std::optional<Form> requested_form(const Request& request) {
  if (!request.is_multipart_form_data()) return std::nullopt;
  Form form;
  for (const auto& [name, part] : request.files) {
    if (name == "job") {
      form.job = part.content;
    } else if (name == "scenario") {
      form.bundle = &part.content;
    } else {
      throw HttpError{400, fmt::format("a part \"{}\"; there are job and scenario", name)};
    }
  }
  if (form.job.empty()) throw HttpError{400, "there is no part \"job\" with the job as JSON"};
  return form;
}

/// With a bundle of its own, unless that is null.
void enqueue(JobQueue& queue, Housekeeping& housekeeping, const Caller& caller,
             Submission submission, Response& response, const std::string* bundle = nullptr) {
  submission.owner = caller.key_id;
  submission.viewer = viewer_key(caller);
  submission.max_active = caller.max_active;
  submission.max_bytes = caller.max_bytes;
  const jobs::Added added =
      bundle == nullptr ? queue.submit(submission) : queue.submit_with_bundle(submission, *bundle);
  if (!added.is_equal) {
    throw HttpError{422, fmt::format("this Idempotency-Key belongs to job {}, and the request "
                                     "with it then was something else",
                                     added.row.id)};
  }
  response.set_header("Location", fmt::format("/v1/jobs/{}", added.row.id));
  if (!added.is_new) response.set_header("Idempotent-Replayed", "true");
  write_job(housekeeping, response, added.is_new ? 201 : 200, added.row);
}

std::vector<jobs::JobState> requested_states(const Request& request) {
  std::vector<jobs::JobState> states;
  for (const std::string& name : query_values(request, "state")) {
    const auto state = jobs::job_state_named(name);
    if (!state) {
      throw HttpError{
          400,
          "state is wrong",
          {{"", "?state", name, "queued, running, succeeded, partial, failed or cancelled"}}};
    }
    states.push_back(*state);
  }
  return states;
}

}  // namespace

void submit_job(JobQueue& queue, Housekeeping& housekeeping, const Caller& caller,
                const Request& request, Response& response) {
  const std::optional<Form> form = requested_form(request);
  if (!form) require_json(request);
  Submission submission{jobs::parse_job_document(form ? form->job : request.body, "")};
  submission.priority =
      static_cast<int>(requested_number(request, "priority", -kMaxPriority, kMaxPriority, 0));
  require_priority(caller, submission.priority, "?priority");
  submission.labels = query_values(request, "label");
  check_labels(submission.labels, "?label");
  if (is_asked(request, "dry_run")) {
    const bool has_bundle = form && form->bundle != nullptr;
    const Viewer viewer = viewer_key(caller);
    json answer = has_bundle
                      ? queue.dry_run_with_bundle(std::move(submission.job), *form->bundle, viewer)
                      : queue.dry_run(std::move(submission.job), viewer);
    answer["valid"] = true;
    return write_json(response, 200, answer);
  }
  submission.key = idempotency_key(request);
  enqueue(queue, housekeeping, caller, std::move(submission), response,
          form ? form->bundle : nullptr);
}

void list_jobs(JobQueue& queue, Housekeeping& housekeeping, AnswerBudget& answers,
               const Caller& caller, const Request& request, Response& response) {
  jobs::JobFilter filter;
  filter.states = requested_states(request);
  filter.label = request.get_param_value("label");
  filter.name_part = request.get_param_value("name");
  const std::string sort = request.has_param("sort") ? request.get_param_value("sort") : "newest";
  if (sort != "newest" && sort != "oldest") {
    throw HttpError{400, "sort is wrong", {{"", "?sort", sort, "newest or oldest"}}};
  }
  filter.oldest_first = sort == "oldest";
  filter.after = cursor_from_request(request);
  filter.limit = requested_limit(request);
  filter.visible_to = viewer_key(caller);
  filter.with_spec = false;  // jobs may be large; GET /v1/jobs/{id} has them
  send_rows(queue, answers, response, "jobs", filter,
            [&](const jobs::JobRow& row) { return job_json(row, housekeeping.retention()); });
}

void send_job(JobQueue& queue, Housekeeping& housekeeping, const Caller& caller,
              const Request& request, Response& response) {
  const std::string id = request.matches[1];
  if (!sees_all(caller)) static_cast<void>(find_job(queue, caller, request));
  const auto text = jobs::is_job_id(id)
                        ? queue.text_of_job(id,
                                            [&](const jobs::JobRow& row) {
                                              return job_text(row, housekeeping.retention());
                                            })
                        : nullptr;
  if (text == nullptr) throw HttpError{404, fmt::format("there is no job {}", id)};
  response.set_content(*text, "application/json");
}

void change_job(JobQueue& queue, Housekeeping& housekeeping, const Caller& caller,
                const Request& request, Response& response) {
  const jobs::JobRow row = find_own(queue, caller, request);
  const jobs::JobChange wanted = read_change(caller, request, row);
  const auto changed = queue.change(row.id, wanted);
  if (!changed) throw HttpError{404, "the job has been removed"};
  write_job(housekeeping, response, 200, *changed);
}

void cancel_job(JobQueue& queue, Housekeeping& housekeeping, const Caller& caller,
                const Request& request, Response& response) {
  const auto row = queue.cancel(find_own(queue, caller, request).id);
  if (!row) throw HttpError{404, "the job has been removed"};
  write_job(housekeeping, response, 200, *row);
}

void retry_job(JobQueue& queue, Housekeeping& housekeeping, Keys& keys, const Caller& caller,
               const Request& request, Response& response) {
  write_job(housekeeping, response, 200,
            retried(queue, keys, caller, find_own(queue, caller, request)));
}

void clone_job(JobQueue& queue, Housekeeping& housekeeping, const Caller& caller,
               const Request& request, Response& response) {
  const jobs::JobRow row = find_job(queue, caller, request);
  json job = parse_own_json(row.spec_json, "the job");
  if (!request.body.empty()) {
    require_json(request);
    job.merge_patch(parse_json_body(request));
  }
  const int priority = std::min(row.priority, caller.max_priority);
  // Sharing is a decision about one job: its copy is seen by its owner until they share it.
  std::vector<std::string> labels = row.labels;
  std::erase(labels, jobs::kSharedLabel);
  enqueue(queue, housekeeping, caller,
          {std::move(job), priority, std::move(labels), idempotency_key(request)}, response);
}

void remove_job(JobQueue& queue, Housekeeping& housekeeping, const Caller& caller,
                const Request& request, Response& response) {
  if (!housekeeping.remove(find_own(queue, caller, request).id))
    throw HttpError{404, "already removed"};
  response.status = 204;
}

}  // namespace throng::server
