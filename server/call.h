// One request to the service: who makes it, and what its handler may use.
#pragma once

#include "server/calibrations.h"
#include "server/confined_checks.h"
#include "server/datasets.h"
#include "server/housekeeping.h"
#include "server/job_queue.h"
#include "server/keys.h"
#include "server/live_flights.h"
#include "server/report_maker.h"
#include "server/service_folders.h"
#include "server/sessions.h"
#include "server/studies.h"
#include "server/uploads.h"
#include "server/webhook_sender.h"

namespace throng::server {

struct Call {
  JobQueue& queue;
  Uploads& uploads;
  Calibrations& calibrations;
  Studies& studies;
  Housekeeping& housekeeping;
  Datasets& datasets;
  ReportMaker& reports;
  const ConfinedChecks& confined;
  const ServiceFolders& folders;
  WebhookSender& hooks;
  LiveFlights& live;
  const jobs::Executor& executor;
  Keys& keys;
  Sessions& sessions;
  const Caller& caller;
};

}  // namespace throng::server
