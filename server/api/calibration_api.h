// Routes of calibrations: /v1/calibrations. A calibration is queued and run like a job.
#pragma once

#include "server/api/service_parts.h"
#include "server/http/http_fwd.h"

namespace throng::server {

// Handlers; they throw HttpError (server/api/requests.h), InputError and EnvironmentError.

/// Accepts multipart/form-data (a part "request" with JSON, and one part per file with its file
/// name), or JSON whose "files" map names to texts.
void submit_calibration(Calibrations& calibrations, Housekeeping& housekeeping,
                        const Caller& caller, const httplib::Request& request,
                        httplib::Response& response);
void list_calibrations(JobQueue& queue, Housekeeping& housekeeping, AnswerBudget& answers,
                       const Caller& caller, const httplib::Request& request,
                       httplib::Response& response);
void send_calibration(JobQueue& queue, Housekeeping& housekeeping, const ServiceFolders& folders,
                      const Caller& caller, const httplib::Request& request,
                      httplib::Response& response);
void remove_calibration(JobQueue& queue, Housekeeping& housekeeping, const Caller& caller,
                        const httplib::Request& request, httplib::Response& response);
/// Sends one of the results camera, opencv, ros, residuals and points.
void send_calibration_result(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                             const httplib::Request& request, httplib::Response& response);
/// Sends an image of a board as it was submitted.
void send_calibration_image(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                            const httplib::Request& request, httplib::Response& response);

}  // namespace throng::server
