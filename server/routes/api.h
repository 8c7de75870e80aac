// The HTTP API, version 1: routes to the parts of the service.
//
// Errors are answered with a problem document (RFC 9457), whose "errors" list each mistake in a job
// with its JSON pointer.
#pragma once

#include <span>

#include "server/access/audit_log.h"
#include "server/access/keys.h"
#include "server/access/sessions.h"
#include "server/api/service.h"
#include "server/description/routes.h"
#include "server/http/answer_budget.h"
#include "server/http/http_meters.h"
#include "server/http/http_server.h"
#include "server/http/key_limit.h"
#include "server/jobs/revoked_keys.h"
#include "server/webhooks/webhook_sender.h"

namespace throng::server {

/// Requests of one key that are worked on at once, streams included; half of the server's threads.
inline constexpr int kMaxRequestsOfKey = 256;

/// Serves the API on a port. Service, keys and webhooks must outlive this object.
class Api {
 public:
  /// Binds the address in `options`. If it is a loopback address, requests must name such a Host.
  /// Throws EnvironmentError.
  Api(Service& service, Keys& keys, WebhookSender& hooks, const HttpOptions& options);

  int port() const { return server_.port(); }
  /// Serves until stop().
  void run() { server_.run(); }
  void stop() {
    server_.stop();
    queue_.end_waits();
  }

 private:
  JobQueue& queue_;
  Sessions sessions_;
  AuditLog audit_;
  AnswerBudget answers_;
  HttpMeters http_;
  RevokedKeys revoked_;
  KeyLimit requests_{kMaxRequestsOfKey};
  HttpServer server_;
};

}  // namespace throng::server
