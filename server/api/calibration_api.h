// Routes of calibrations: /v1/calibrations. A calibration is queued and run like a job.
#pragma once

#include "server/api/request_context.h"
#include "server/http/http_fwd.h"

namespace throng::server {

// Handlers; they throw HttpError (server/api/requests.h), InputError and EnvironmentError.

/// Accepts multipart/form-data (a part "request" with JSON, and one part per file with its file
/// name), or JSON whose "files" map names to texts.
void submit_calibration(const RequestContext& context, const httplib::Request& request,
                        httplib::Response& response);
void list_calibrations(const RequestContext& context, const httplib::Request& request,
                       httplib::Response& response);
void send_calibration(const RequestContext& context, const httplib::Request& request,
                      httplib::Response& response);
void remove_calibration(const RequestContext& context, const httplib::Request& request,
                        httplib::Response& response);
/// Sends one of the results camera, opencv, ros, residuals and points.
void send_calibration_result(const RequestContext& context, const httplib::Request& request,
                             httplib::Response& response);
/// Sends an image of a board as it was submitted.
void send_calibration_image(const RequestContext& context, const httplib::Request& request,
                            httplib::Response& response);

}  // namespace throng::server
