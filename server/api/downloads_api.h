// Downloads of a job: archive, metrics, single files, traces, reports and logs.
#pragma once

#include <filesystem>
#include <string>

#include "jobs/queue/store/store.h"
#include "server/api/service_parts.h"
#include "server/http/http_fwd.h"

namespace throng::server {

/// Images of a dataset that are listed at once.
inline constexpr int kMaxImagesOfPage = 1000;
inline constexpr int kUsualImagesOfPage = 100;

void send_archive(JobQueue& queue, Datasets& datasets, const ServiceFolders& folders,
                  const Caller& caller, const httplib::Request& request,
                  httplib::Response& response);
void send_manifest(JobQueue& queue, Datasets& datasets, const ServiceFolders& folders,
                   const Caller& caller, const httplib::Request& request,
                   httplib::Response& response);
/// Sends a file of the dataset by its path in the manifest.
void send_file(JobQueue& queue, Datasets& datasets, const ServiceFolders& folders,
               const Caller& caller, const httplib::Request& request, httplib::Response& response);
/// Sends a page of the list of images, with the number of images of each camera in each run.
void list_images_of_job(JobQueue& queue, Datasets& datasets, const ServiceFolders& folders,
                        const Caller& caller, const httplib::Request& request,
                        httplib::Response& response);
void send_metrics(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                  const httplib::Request& request, httplib::Response& response);
void send_run_metrics(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                      const httplib::Request& request, httplib::Response& response);
void send_run_metrics_csv(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                          const httplib::Request& request, httplib::Response& response);
/// Sends a run's trace (docs/trace.md), in any state of the job.
void send_run_trace(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                    const httplib::Request& request, httplib::Response& response);

/// The index of the run in the request's path. Throws HttpError 404 if the job has no such run.
int requested_run(const httplib::Request& request, const jobs::JobRow& row);
/// Path of the trace of a run. Throws HttpError 409 if the run was not simulated yet.
std::filesystem::path trace_file(const ServiceFolders& folders, const jobs::JobRow& row, int run);

/// Sends the report of all runs as an HTML page; 202 while it is being created.
void send_report(JobQueue& queue, ReportMaker& reports, const ServiceFolders& folders,
                 const Caller& caller, const httplib::Request& request,
                 httplib::Response& response);

// Logs of the workers and preview images, also while the job is running.
void list_logs(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
               const httplib::Request& request, httplib::Response& response);
void send_log(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
              const httplib::Request& request, httplib::Response& response);
/// The name of the newest preview; "" if there is none.
std::string newest_preview(const std::filesystem::path& job_folder);
void list_previews(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                   const httplib::Request& request, httplib::Response& response);
void send_preview(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                  const httplib::Request& request, httplib::Response& response);

}  // namespace throng::server
