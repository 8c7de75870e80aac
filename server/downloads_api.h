// What a finished job has made: its archive, its figures, each of its files.
#pragma once

#include "server/job_service.h"

namespace httplib {
struct Request;
struct Response;
}  // namespace httplib

namespace throng::server {

void send_archive(JobService& service, const httplib::Request& request,
                  httplib::Response& response);
void send_manifest(JobService& service, const httplib::Request& request,
                   httplib::Response& response);
/// A file of the dataset, by its path in the manifest.
void send_file(JobService& service, const httplib::Request& request, httplib::Response& response);
void send_metrics(JobService& service, const httplib::Request& request,
                  httplib::Response& response);
void send_run_metrics(JobService& service, const httplib::Request& request,
                      httplib::Response& response);
void send_run_metrics_csv(JobService& service, const httplib::Request& request,
                          httplib::Response& response);

/// What the workers said, and the pictures with drawn annotations: also while the job is at work.
void list_logs(JobService& service, const httplib::Request& request, httplib::Response& response);
void send_log(JobService& service, const httplib::Request& request, httplib::Response& response);
void list_previews(JobService& service, const httplib::Request& request,
                   httplib::Response& response);
void send_preview(JobService& service, const httplib::Request& request,
                  httplib::Response& response);

}  // namespace throng::server
