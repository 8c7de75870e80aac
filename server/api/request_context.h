// Context of a request: the caller and the parts of the service that handlers use.
#pragma once

#include "jobs/queue/workers/task_meters.h"
#include "server/access/keys.h"
#include "server/access/sessions.h"
#include "server/catalog/calibrations.h"
#include "server/catalog/confined_checks.h"
#include "server/catalog/service_folders.h"
#include "server/catalog/studies.h"
#include "server/catalog/uploads.h"
#include "server/http/answer_budget.h"
#include "server/jobs/datasets.h"
#include "server/jobs/drain.h"
#include "server/jobs/housekeeping.h"
#include "server/jobs/job_queue.h"
#include "server/jobs/report_maker.h"
#include "server/jobs/revoked_keys.h"
#include "server/live/live_flights.h"
#include "server/webhooks/webhook_sender.h"

namespace throng::server {

class HttpMeters;

struct RequestContext {
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
  Drain& drain;
  const jobs::TaskMeters& tasks;
  const HttpMeters& http;
  const jobs::Executor& executor;
  Keys& keys;
  Sessions& sessions;
  const RevokedKeys& revoked;
  AnswerBudget& answers;
  const Caller& caller;
};

}  // namespace throng::server
