// Downloads of a finished job: its archive, its figures, each of its files.
#pragma once

#include <filesystem>
#include <string>

#include "jobs/queue/store/store.h"
#include "server/api/request_context.h"
#include "server/http/http_fwd.h"

namespace throng::server {

void send_archive(const RequestContext& context, const httplib::Request& request,
                  httplib::Response& response);
void send_manifest(const RequestContext& context, const httplib::Request& request,
                   httplib::Response& response);
/// A file of the dataset, by its path in the manifest.
void send_file(const RequestContext& context, const httplib::Request& request,
               httplib::Response& response);
/// A page of the images, and how many each camera took in each run.
void list_images_of_job(const RequestContext& context, const httplib::Request& request,
                        httplib::Response& response);
void send_metrics(const RequestContext& context, const httplib::Request& request,
                  httplib::Response& response);
void send_run_metrics(const RequestContext& context, const httplib::Request& request,
                      httplib::Response& response);
void send_run_metrics_csv(const RequestContext& context, const httplib::Request& request,
                          httplib::Response& response);
/// A run's trace (docs/trace.md), whatever becomes of the job.
void send_run_trace(const RequestContext& context, const httplib::Request& request,
                    httplib::Response& response);

/// The run of a job that the path names. Throws HttpError 404.
int requested_run(const httplib::Request& request, const jobs::JobRow& row);
/// The trace of a run. Throws HttpError 409 until it was simulated.
std::filesystem::path trace_file(const RequestContext& context, const jobs::JobRow& row, int run);

/// The report of all runs as one HTML page; 202 as long as it is being made.
void send_report(const RequestContext& context, const httplib::Request& request,
                 httplib::Response& response);

/// Logs of the workers, and the images with annotation overlays: also while the job is running.
void list_logs(const RequestContext& context, const httplib::Request& request,
               httplib::Response& response);
void send_log(const RequestContext& context, const httplib::Request& request,
              httplib::Response& response);
/// The name of the preview that was written last; empty while there is none.
std::string newest_preview(const std::filesystem::path& job_folder);
void list_previews(const RequestContext& context, const httplib::Request& request,
                   httplib::Response& response);
void send_preview(const RequestContext& context, const httplib::Request& request,
                  httplib::Response& response);

}  // namespace throng::server
