// Handlers of routes: functions that take what they need by the types of their parameters.
#pragma once

#include <tuple>

#include "server/api/service_parts.h"
#include "server/description/routes.h"
#include "server/http/http_fwd.h"

namespace throng::server {

/// The parts of the service, the caller, the request and its answer.
struct HandlerArguments {
  std::tuple<JobQueue&, Uploads&, Calibrations&, Studies&, Housekeeping&, Datasets&, ReportMaker&,
             const ConfinedChecks&, const ServiceFolders&, WebhookSender&, LiveFlights&, Drain&,
             const jobs::TaskMeters&, const HttpMeters&, const jobs::Executor&, Keys&, Sessions&,
             const RevokedKeys&, AnswerBudget&, const Caller&, const httplib::Request&,
             httplib::Response&>
      all;
};

/// The handler that calls `function` with those arguments whose types its parameters have.
template <typename... Parameters>
Handler handler(void (*function)(Parameters...)) {
  return [function](const HandlerArguments& arguments) {
    function(std::get<Parameters>(arguments.all)...);
  };
}

}  // namespace throng::server
