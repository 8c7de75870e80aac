// One request to the service, and who makes it.
#pragma once

#include "server/job_service.h"
#include "server/keys.h"

namespace throng::server {

struct Call {
  JobService& service;
  const Caller& caller;
};

}  // namespace throng::server
