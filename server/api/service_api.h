// Routes of the service itself: health, metrics (metrics.cpp), drain, schemas, and names that jobs
// may use.
#pragma once

#include "server/api/request_context.h"
#include "server/http/http_fwd.h"

namespace throng::server {

void send_health(const RequestContext& context, const httplib::Request& request,
                 httplib::Response& response);
/// Responds with 503 and the reason if jobs cannot be accepted or run.
void send_readiness(const RequestContext& context, const httplib::Request& request,
                    httplib::Response& response);
/// Sends metrics in the text format of Prometheus (docs/operations.md).
void send_service_metrics(const RequestContext& context, const httplib::Request& request,
                          httplib::Response& response);
/// Ends the service once its running tasks have finished.
void begin_drain(const RequestContext& context, const httplib::Request& request,
                 httplib::Response& response);
void send_version(const RequestContext& context, const httplib::Request& request,
                  httplib::Response& response);
void send_schema(const RequestContext& context, const httplib::Request& request,
                 httplib::Response& response);
void list_schemas(const RequestContext& context, const httplib::Request& request,
                  httplib::Response& response);
void send_file_schema(const RequestContext& context, const httplib::Request& request,
                      httplib::Response& response);

// Each list includes the part of the job's schema in which an entry is selected.
void list_airframes(const RequestContext& context, const httplib::Request& request,
                    httplib::Response& response);
void list_formats(const RequestContext& context, const httplib::Request& request,
                  httplib::Response& response);
void list_policies(const RequestContext& context, const httplib::Request& request,
                   httplib::Response& response);
/// Sends the character library.
void list_people(const RequestContext& context, const httplib::Request& request,
                 httplib::Response& response);

}  // namespace throng::server
