// Jobs over HTTP: submit, list, look at, change, cancel, try again, copy, remove.
#pragma once

#include "server/api/request_context.h"
#include "server/http/http_fwd.h"

namespace throng::server {

/// POST /v1/jobs?priority=&label=&label=, Idempotency-Key; with ?dry_run only checked.
void submit_job(const RequestContext& context, const httplib::Request& request,
                httplib::Response& response);
/// GET /v1/jobs?state=&label=&name=&sort=&limit=&after=
void list_jobs(const RequestContext& context, const httplib::Request& request,
               httplib::Response& response);
void send_job(const RequestContext& context, const httplib::Request& request,
              httplib::Response& response);
/// PATCH with {"priority", "labels", "keep"}
void change_job(const RequestContext& context, const httplib::Request& request,
                httplib::Response& response);
void cancel_job(const RequestContext& context, const httplib::Request& request,
                httplib::Response& response);
void retry_job(const RequestContext& context, const httplib::Request& request,
               httplib::Response& response);
/// A new job like this one, changed by a JSON merge patch (RFC 7396) in the body.
void clone_job(const RequestContext& context, const httplib::Request& request,
               httplib::Response& response);
void remove_job(const RequestContext& context, const httplib::Request& request,
                httplib::Response& response);

}  // namespace throng::server
