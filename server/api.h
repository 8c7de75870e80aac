// The HTTP API, version 1: routes onto the job service.
//
//   POST   /v1/jobs               queue a job                    201, Location
//   GET    /v1/jobs               newest first; ?limit= ?after=  200
//   GET    /v1/jobs/{id}          state and progress             200
//   DELETE /v1/jobs/{id}          end it, remove its files       204
//   GET    /v1/jobs/{id}/archive  the dataset as a tar file      200, 206, 409 until it is there
//   GET    /v1/jobs/{id}/metrics  figures of all runs            200, 409 until they are there
//   POST   /v1/calibrations       queue a calibration            201, Location
//   GET    /v1/calibrations       newest first; ?limit= ?after=  200
//   GET    /v1/calibrations/{id}  state, and its camera          200
//   DELETE /v1/calibrations/{id}  end it, remove its files       204
//   GET    /v1/calibrations/{id}/camera, opencv, ros, residuals  200, 409 until they are there
//   GET    /v1/schema             the JSON Schema of a job       200
//   GET    /healthz               is the service alive           200
//
// Whatever goes wrong is answered with a problem document (RFC 9457); "errors" lists each mistake
// in a job with its JSON pointer.
#pragma once

#include "server/http_server.h"
#include "server/job_service.h"

namespace throng::server {

/// Serves the API on a port of its own. The service must outlive it.
class Api {
 public:
  /// Binds at once; `options` says where. Unless the address is loopback, requests may name any
  /// Host. Throws EnvironmentError.
  Api(JobService& service, const HttpOptions& options);

  int port() const { return server_.port(); }
  /// Serves until stop().
  void run() { server_.run(); }
  void stop() { server_.stop(); }

 private:
  HttpServer server_;
};

}  // namespace throng::server
