// events/RUN.jsonl, and what follows from it elsewhere.
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

/// The events of a dataset's run, in the file's order. Throws InputError, and what JSON throws.
std::vector<RunEvent> read_run_events(const std::filesystem::path& root, const std::string& run);

/// Takes what is wrong with an event, by its number, or with none.
using EventReport = std::function<void(std::size_t event, const std::string& what)>;
inline constexpr std::size_t kNoEvent = static_cast<std::size_t>(-1);

/// Reports events that are of no type, lack what their type has, or begin what has begun.
void check_event_records(const std::vector<RunEvent>& events, const EventReport& report);

/// Reports events that the run's figures (metrics/RUN.json) do not have, and the reverse: notices,
/// escapes, falls, and what happens to drones. `first_track` is the track id of agent 0.
void check_events_against_figures(const std::vector<RunEvent>& events,
                                  const nlohmann::json& figures, std::int64_t first_track,
                                  const EventReport& report);

/// Reports arrivals and departures that the trajectories do not show, and the reverse.
void check_events_against_trajectories(const std::vector<RunEvent>& events,
                                       const RunTrajectories& trajectories,
                                       const EventReport& report);

/// Track id of a run's agent 0.
std::int64_t first_track(const DatasetInfo& info, const std::string& run);

/// The figures of a run, metrics/RUN.json; an empty object if that is not there or no JSON.
nlohmann::json run_figures(const std::filesystem::path& root, const std::string& run);

}  // namespace throng::formats
