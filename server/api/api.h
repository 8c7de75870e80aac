// The HTTP API, version 1: routes onto the job service.
// (server/openapi.json describes each for its users).
//
// Whatever goes wrong is answered with a problem document (RFC 9457); "errors" lists each mistake
// in a job with its JSON pointer.
#pragma once

#include <span>

#include "server/access/audit_log.h"
#include "server/access/keys.h"
#include "server/access/sessions.h"
#include "server/api/routes.h"
#include "server/api/service.h"
#include "server/http/http_server.h"
#include "server/webhooks/webhook_sender.h"

namespace throng::server {

/// Every operation there is.
std::span<const Route> routes();

/// Serves the API on a port of its own. Service, keys and webhooks must outlive it.
class Api {
 public:
  /// Binds at once, to the address in `options`. Unless the address is loopback, requests may name
  /// any Host. Throws EnvironmentError.
  Api(Service& service, Keys& keys, WebhookSender& hooks, const HttpOptions& options);

  int port() const { return server_.port(); }
  /// Serves until stop().
  void run() { server_.run(); }
  void stop() { server_.stop(); }

 private:
  Sessions sessions_;
  AuditLog audit_;
  HttpServer server_;
};

}  // namespace throng::server
