// Services of a flight that is flown from outside. Requests and responses are JSON.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "live/foxglove/server.h"
#include "live/loop/control.h"

namespace throng::live {

/// /throng/pause, resume, step, reset, stop.
std::vector<foxglove::Service> flight_services();

/// Calls the service with this index in flight_services(); the answer may come later. Throws
/// InputError for a wrong request.
void call_service(std::size_t service, const nlohmann::json& request, Control& control,
                  const foxglove::ServiceAnswer& answer);

}  // namespace throng::live
