// One request to the service, and who makes it.
#pragma once

#include "server/job_service.h"
#include "server/keys.h"
#include "server/webhook_sender.h"

namespace throng::server {

struct Call {
  JobService& service;
  WebhookSender& hooks;
  const Caller& caller;
};

}  // namespace throng::server
