// Following of jobs, calibrations and studies on a server until they end, and their exit codes.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cli/remote/api_client.h"
#include "cli/shell/progress_bar.h"

namespace throng::cli {

/// Callbacks of followed().
struct Following {
  /// Shows the progress of the polled resource.
  std::function<void(ProgressBar& bar, const nlohmann::json& value)> show;
  std::function<void()> wait;  ///< blocks until the next poll, about a second
};

/// Polls the job, calibration or study at a path of the API until it has ended, and returns it.
/// Waits for a server that restarts. Throws Cancelled after Ctrl-C.
nlohmann::json followed(ApiClient& api, const std::string& path, const std::string& name,
                        const Following& following);

/// Throws the exception that corresponds to the state of an ended resource, unless it succeeded.
void require_success(const nlohmann::json& ended);

}  // namespace throng::cli
