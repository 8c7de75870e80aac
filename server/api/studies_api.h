// Routes of studies: /v1/studies. A study is queued and run like a job.
#pragma once

#include "server/api/service_parts.h"
#include "server/http/http_fwd.h"

namespace throng::server {

// Handlers; they throw HttpError (server/api/requests.h), InputError and EnvironmentError.

/// Submits a study's document (docs/study.md) as JSON; ?dry_run only checks it.
void submit_study(Studies& studies, Housekeeping& housekeeping, const Caller& caller,
                  const httplib::Request& request, httplib::Response& response);
void list_studies(JobQueue& queue, Housekeeping& housekeeping, AnswerBudget& answers,
                  const Caller& caller, const httplib::Request& request,
                  httplib::Response& response);
/// Sends a study with its plan and the summary of its runs so far.
void send_study(JobQueue& queue, Studies& studies, Housekeeping& housekeeping, const Caller& caller,
                const httplib::Request& request, httplib::Response& response);
/// PATCH with {"priority", "labels", "keep"}, as for a job.
void change_study(JobQueue& queue, Housekeeping& housekeeping, const Caller& caller,
                  const httplib::Request& request, httplib::Response& response);
void cancel_study(JobQueue& queue, Housekeeping& housekeeping, const Caller& caller,
                  const httplib::Request& request, httplib::Response& response);
void retry_study(JobQueue& queue, Housekeeping& housekeeping, Keys& keys, const Caller& caller,
                 const httplib::Request& request, httplib::Response& response);
void remove_study(JobQueue& queue, Housekeeping& housekeeping, const Caller& caller,
                  const httplib::Request& request, httplib::Response& response);
void send_study_report(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                       const httplib::Request& request, httplib::Response& response);
/// Sends summary.json, summary.csv, summary.md, values.json or runs/CASE/POLICY/000.json.
void send_study_file(JobQueue& queue, Studies& studies, const ServiceFolders& folders,
                     const Caller& caller, const httplib::Request& request,
                     httplib::Response& response);

}  // namespace throng::server
