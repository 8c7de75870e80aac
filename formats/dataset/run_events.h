// Reader for events/RUN.jsonl, and checks against other files.
#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "formats/dataset/dataset.h"
#include "formats/dataset/run_trajectories.h"

namespace throng::formats {

struct RunEvent {
  double time_s = 0;
  std::string type;
  nlohmann::json record;
};

/// The events of a dataset's run, in the file's order. Throws InputError and
/// nlohmann::json::exception.
std::vector<RunEvent> read_run_events(const std::filesystem::path& root, const std::string& run);

/// Receives a finding and the index of its event, or kNoEvent.
using EventReport = std::function<void(std::size_t event, const std::string& what)>;
inline constexpr std::size_t kNoEvent = static_cast<std::size_t>(-1);

/// Reports events of unknown types, events without members of their type, and repeated starts.
void check_event_records(const std::vector<RunEvent>& events, const EventReport& report);

/// Reports differences between the events and the run's metrics (metrics/RUN.json): notices,
/// escapes, falls, and events of drones. `first_track` is the track id of agent 0.
void check_events_against_figures(const std::vector<RunEvent>& events,
                                  const nlohmann::json& figures, std::int64_t first_track,
                                  const EventReport& report);

/// Reports differences between arrivals and departures and the trajectories.
void check_events_against_trajectories(const std::vector<RunEvent>& events,
                                       const RunTrajectories& trajectories,
                                       const EventReport& report);

/// Track id of a run's agent 0.
std::int64_t first_track(const DatasetInfo& info, const std::string& run);

/// The metrics of a run, metrics/RUN.json; an empty object if the file is missing or no JSON.
nlohmann::json run_figures(const std::filesystem::path& root, const std::string& run);

}  // namespace throng::formats
