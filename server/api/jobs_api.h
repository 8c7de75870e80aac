// Routes of jobs: submit, list, show, change, cancel, retry, copy, remove.
#pragma once

#include "server/api/service_parts.h"
#include "server/http/http_fwd.h"

namespace throng::server {

inline constexpr std::size_t kMaxIdempotencyKeyLength = 200;

/// POST /v1/jobs?priority=&label=&label=, with the header Idempotency-Key; ?dry_run only checks.
void submit_job(JobQueue& queue, Housekeeping& housekeeping, const Caller& caller,
                const httplib::Request& request, httplib::Response& response);
/// GET /v1/jobs?state=&label=&name=&sort=&limit=&after=
void list_jobs(JobQueue& queue, Housekeeping& housekeeping, AnswerBudget& answers,
               const Caller& caller, const httplib::Request& request, httplib::Response& response);
void send_job(JobQueue& queue, Housekeeping& housekeeping, const Caller& caller,
              const httplib::Request& request, httplib::Response& response);
/// PATCH with {"priority", "labels", "keep"}
void change_job(JobQueue& queue, Housekeeping& housekeeping, const Caller& caller,
                const httplib::Request& request, httplib::Response& response);
void cancel_job(JobQueue& queue, Housekeeping& housekeeping, const Caller& caller,
                const httplib::Request& request, httplib::Response& response);
void retry_job(JobQueue& queue, Housekeeping& housekeeping, Keys& keys, const Caller& caller,
               const httplib::Request& request, httplib::Response& response);
/// Submits a copy of a job, changed by a JSON merge patch (RFC 7396) in the body.
void clone_job(JobQueue& queue, Housekeeping& housekeeping, const Caller& caller,
               const httplib::Request& request, httplib::Response& response);
void remove_job(JobQueue& queue, Housekeeping& housekeeping, const Caller& caller,
                const httplib::Request& request, httplib::Response& response);

}  // namespace throng::server
