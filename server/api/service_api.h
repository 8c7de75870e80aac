// The service itself: health, figures for Prometheus, and what jobs can name.
#pragma once

#include "server/api/request_context.h"
#include "server/http/http_fwd.h"

namespace throng::server {

void send_health(const RequestContext& context, const httplib::Request& request,
                 httplib::Response& response);
/// 503 with the reason when jobs could not be taken in or worked on.
void send_readiness(const RequestContext& context, const httplib::Request& request,
                    httplib::Response& response);
/// Prometheus' text format.
void send_figures(const RequestContext& context, const httplib::Request& request,
                  httplib::Response& response);
void send_version(const RequestContext& context, const httplib::Request& request,
                  httplib::Response& response);
void send_schema(const RequestContext& context, const httplib::Request& request,
                 httplib::Response& response);
void list_schemas(const RequestContext& context, const httplib::Request& request,
                  httplib::Response& response);
void send_file_schema(const RequestContext& context, const httplib::Request& request,
                      httplib::Response& response);
void send_openapi(const RequestContext& context, const httplib::Request& request,
                  httplib::Response& response);

// Each list comes with the part of the job's schema for selecting one.
void list_airframes(const RequestContext& context, const httplib::Request& request,
                    httplib::Response& response);
void list_formats(const RequestContext& context, const httplib::Request& request,
                  httplib::Response& response);
void list_policies(const RequestContext& context, const httplib::Request& request,
                   httplib::Response& response);
/// The character library that frames are rendered with.
void list_people(const RequestContext& context, const httplib::Request& request,
                 httplib::Response& response);

}  // namespace throng::server
