// Routes of calibrations: /v1/calibrations. A calibration is queued with its files and worked off
// like a job.
#pragma once

#include "server/api/request_context.h"
#include "server/http/http_fwd.h"

namespace throng::server {

// Handlers; they throw HttpError (server/api/requests.h), InputError and EnvironmentError.

/// A request as multipart/form-data (a part "request" with JSON, and one per file, each with its
/// file name), or as JSON whose "files" hold texts by their names.
void submit_calibration(const RequestContext& context, const httplib::Request& request,
                        httplib::Response& response);
void list_calibrations(const RequestContext& context, const httplib::Request& request,
                       httplib::Response& response);
void send_calibration(const RequestContext& context, const httplib::Request& request,
                      httplib::Response& response);
void remove_calibration(const RequestContext& context, const httplib::Request& request,
                        httplib::Response& response);
/// camera, opencv, ros, residuals or points.
void send_calibration_result(const RequestContext& context, const httplib::Request& request,
                             httplib::Response& response);
/// An image of a board, as it was sent.
void send_calibration_image(const RequestContext& context, const httplib::Request& request,
                            httplib::Response& response);

}  // namespace throng::server
