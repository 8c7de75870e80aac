// The end of what a server works on: followed, and what it means for the exit code.
#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "cli/remote/api_client.h"
#include "cli/shell/progress_bar.h"

namespace throng::cli {

struct Following {
  std::function<void(ProgressBar& bar, const nlohmann::json& value)> show;
  std::function<void()> wait;  ///< for news, a second or so
};

/// Polls the job, calibration or study at a path of the API until it has ended, and returns it. A
/// server that restarts is waited for. Throws Cancelled at Ctrl-C.
nlohmann::json followed(ApiClient& api, const std::string& path, const std::string& name,
                        const Following& following);

/// Throws what it means for the exit code that something did not succeed.
void require_success(const nlohmann::json& ended);

}  // namespace throng::cli
