// The service itself: health, figures for Prometheus, and what jobs can name.
#pragma once

#include "server/job_service.h"

namespace httplib {
struct Request;
struct Response;
}  // namespace httplib

namespace throng::server {

void send_health(JobService& service, const httplib::Request& request, httplib::Response& response);
/// 503 with the reason when jobs could not be taken in or worked on.
void send_readiness(JobService& service, const httplib::Request& request,
                    httplib::Response& response);
/// Prometheus' text format.
void send_figures(JobService& service, const httplib::Request& request,
                  httplib::Response& response);
void send_version(JobService& service, const httplib::Request& request,
                  httplib::Response& response);
void send_schema(JobService& service, const httplib::Request& request, httplib::Response& response);
void send_openapi(JobService& service, const httplib::Request& request,
                  httplib::Response& response);

void list_scenarios(JobService& service, const httplib::Request& request,
                    httplib::Response& response);
void send_scenario(JobService& service, const httplib::Request& request,
                   httplib::Response& response);
void list_airframes(JobService& service, const httplib::Request& request,
                    httplib::Response& response);
void list_formats(JobService& service, const httplib::Request& request,
                  httplib::Response& response);
void list_policies(JobService& service, const httplib::Request& request,
                   httplib::Response& response);

}  // namespace throng::server
