// Routes of the service itself: health, metrics (metrics.cpp), drain, schemas, and names that jobs
// may use.
#pragma once

#include "server/api/service_parts.h"
#include "server/http/http_fwd.h"

namespace throng::server {

void send_health(httplib::Response& response);
/// Responds with 503 and the reason if jobs cannot be accepted or run.
void send_readiness(JobQueue& queue, const ServiceFolders& folders, Drain& drain, Keys& keys,
                    Sessions& sessions, const httplib::Request& request,
                    httplib::Response& response);
/// Sends metrics in the text format of Prometheus (docs/operations.md).
void send_service_metrics(JobQueue& queue, Uploads& uploads, const ServiceFolders& folders,
                          WebhookSender& hooks, Drain& drain, const jobs::TaskMeters& tasks,
                          const HttpMeters& http, const jobs::Executor& executor,
                          httplib::Response& response);
/// Ends the service once its running tasks have finished.
void begin_drain(Drain& drain, httplib::Response& response);
void send_version(httplib::Response& response);
void send_schema(httplib::Response& response);
void list_schemas(httplib::Response& response);
void send_file_schema(const httplib::Request& request, httplib::Response& response);

// Each list includes the part of the job's schema in which an entry is selected.
void list_airframes(const ConfinedChecks& confined, httplib::Response& response);
void list_formats(const ConfinedChecks& confined, httplib::Response& response);
void list_policies(const ConfinedChecks& confined, httplib::Response& response);
/// Sends the character library.
void list_people(const ConfinedChecks& confined, httplib::Response& response);

}  // namespace throng::server
