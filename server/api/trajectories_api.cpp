#include "server/api/trajectories_api.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <mutex>
#include <string>
#include <vector>

#include "base/error.h"
#include "server/access/keys.h"
#include "server/api/downloads_api.h"
#include "server/api/requests.h"
#include "server/catalog/service_folders.h"
#include "server/http/http.h"
#include "server/jobs/job_queue.h"
#include "spec/layouts/trajectory_records.h"
#include "spec/live/messages.h"
#include "world/trajectories.h"

namespace throng::server {

namespace fs = std::filesystem;
using httplib::Request;
using httplib::Response;

namespace {

constexpr double kMaxPositions = 2e6;  // 12 MB
constexpr float kSteps = 65'000;       // of a coordinate
constexpr float kMinStepM = 0.001F;

double requested_seconds(const Request& request, const char* name, double least, double usual) {
  if (!request.has_param(name)) return usual;
  const std::string text = request.get_param_value(name);
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size() ||
      !(value >= least && value <= kMaxTimeS)) {
    throw HttpError{400,
                    fmt::format("{} is wrong", name),
                    {{"", fmt::format("?{}", name), text,
                      fmt::format("seconds from {} to {}", least, kMaxTimeS)}}};
  }
  return value;
}

/// The grid of an answer's positions: the corner of the box of all who take part, and the step in
/// which they are counted from it.
struct Grid {
  Eigen::Vector2f origin = Eigen::Vector2f::Zero();
  float step_m = kMinStepM;
};

Grid fit_grid(const world::Trajectories& places) {
  Eigen::Vector2f low = Eigen::Vector2f::Constant(std::numeric_limits<float>::max());
  Eigen::Vector2f high = -low;
  for (std::size_t i = 0; i < places.position.size(); ++i) {
    if ((places.flags[i] & world::kPresent) == 0) continue;
    low = low.cwiseMin(places.position[i]);
    high = high.cwiseMax(places.position[i]);
  }
  if (low.x() > high.x()) return {};
  return {low, std::max(kMinStepM, (high - low).maxCoeff() / kSteps)};
}

std::string encode_trajectories(const world::Trajectories& places) {
  const Grid grid = fit_grid(places);
  std::string bytes;
  live::append_value(
      bytes, layouts::TrajectoriesHead{.times = static_cast<std::uint32_t>(places.time_s.size()),
                                       .agents = static_cast<std::uint32_t>(places.role.size()),
                                       .origin = {grid.origin.x(), grid.origin.y()},
                                       .step_m = grid.step_m});
  for (const double time_s : places.time_s) live::append_value(bytes, time_s);
  for (const world::AgentRole role : places.role) live::append_value(bytes, role);
  for (std::size_t i = 0; i < places.position.size(); ++i) {
    const bool is_there = (places.flags[i] & world::kPresent) != 0;
    const Eigen::Vector2f at = (places.position[i] - grid.origin) / grid.step_m;
    const auto steps = [&](float value) {
      return is_there ? static_cast<std::uint16_t>(std::lround(value)) : layouts::kAbsent;
    };
    live::append_value(bytes, layouts::TrajectoryRecord{.position = {steps(at.x()), steps(at.y())},
                                                        .state = places.state[i],
                                                        .flags = places.flags[i]});
  }
  return bytes;
}

std::vector<double> requested_times(const Request& request, const world::TrajectoryReader& reader) {
  const double from_s = requested_seconds(request, "from_s", 0, 0);
  const double to_s =
      std::min(requested_seconds(request, "to_s", 0, reader.end_s()), reader.end_s());
  const double every_s = requested_seconds(request, "every_s", kMinEveryS, 1);
  const double count =
      std::max(0.0, std::floor((to_s - from_s) / every_s + world::kTimeSlackS) + 1);
  const double people = std::max(1.0, static_cast<double>(reader.agents()));
  if (count * people > kMaxPositions) {
    throw HttpError{400,
                    "these are too many positions at once",
                    {{"", "?every_s", fmt::format("{:.0f} times of {:.0f} people", count, people),
                      fmt::format("at most {:.0f} positions: fewer times, or a part of the run",
                                  kMaxPositions)}}};
  }
  std::vector<double> times(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < times.size(); ++i) {
    times[i] = from_s + static_cast<double>(i) * every_s;
  }
  return times;
}

}  // namespace

void send_trajectories(JobQueue& queue, const ServiceFolders& folders, const Caller& caller,
                       const Request& request, Response& response) {
  // The library may not be called by several threads.
  static std::mutex mutex;
  const jobs::JobRow row = find_job(queue, caller, request);
  const fs::path trace = trace_file(folders, row, requested_run(request, row));
  const std::lock_guard lock(mutex);
  try {
    const world::TrajectoryReader reader(trace);
    response.set_content(encode_trajectories(reader.at(requested_times(request, reader))),
                         "application/octet-stream");
  } catch (const InputError&) {  // of the file that lies here, not of the request
    throw HttpError{500, "the trace of this run is damaged; retry the job to simulate it again"};
  }
}

}  // namespace throng::server
