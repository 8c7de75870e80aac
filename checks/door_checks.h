// Checks of a run's events at exits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "formats/dataset/run_events.h"

namespace throng::checks {

/// Reports differences between exit_closes events, the states in exits/RUN.csv and the time for
/// which exits are closed by the run's metrics.
void check_closures(const std::filesystem::path& root, const std::string& run,
                    const std::vector<formats::RunEvent>& events, const nlohmann::json& figures,
                    const formats::EventReport& report);

/// Reports the first escape by another exit than that in the run's metrics, or than the one whose
/// line the track crosses in counts/RUN.csv.
void check_escape_exits(const std::filesystem::path& root, const std::string& run,
                        const std::vector<formats::RunEvent>& events, const nlohmann::json& figures,
                        std::int64_t first_track, const formats::EventReport& report);

}  // namespace throng::checks
