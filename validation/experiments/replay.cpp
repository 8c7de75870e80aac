#include "validation/experiments/replay.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "base/compute/quantile.h"
#include "base/error.h"
#include "base/geometry/polygon.h"
#include "metrics/trajectories/trajectory_file.h"

namespace throng::validation {

namespace fs = std::filesystem;
using Eigen::Vector2d;

namespace {

constexpr double kStepS = 0.1;
constexpr double kMaxDurationS = 7200;
constexpr double kMaxLoopM = 1000;

std::string state_name(std::size_t stream) { return fmt::format("Walk{}", stream); }

Polygon oriented(Polygon corners, bool clockwise) {
  if ((geometry::signed_area(corners) < 0) != clockwise)
    std::reverse(corners.begin(), corners.end());
  return corners;
}

Sampled sampled(const FreeSpeeds& speeds) {
  constexpr double kSameMps = 1e-3;
  const auto [mean_mps, stddev_mps] = speeds;
  if (stddev_mps < kSameMps) return Sampled::constant(mean_mps);
  return Sampled::normal(mean_mps, stddev_mps)
      .limited(std::max(FreeSpeeds::kMinMps, mean_mps - 3 * stddev_mps),
               std::min(FreeSpeeds::kMaxMps, mean_mps + 3 * stddev_mps));
}

Group person(const Walk& walk, double dt_s, const FreeSpeeds& free_speeds) {
  Group group;
  group.places = {walk.places.front()};
  group.aside_m = 0;
  group.speed = sampled(free_speeds);
  group.state = state_name(walk.stream);
  const double arrival_s = dt_s * static_cast<double>(walk.first_step);
  if (arrival_s >= kStepS) {
    crowd::Node arrivals = describe::typed("Arrivals", "table");
    arrivals.add(crowd::Node("At", {{"time", arrival_s}}));
    group.more = {arrivals};
  }
  return group;
}

TestScene describe_recording(const Recording& recording, const Walks& recorded,
                             const FreeSpeeds& free_speeds) {
  TestScene scene;
  scene.dt_s = kStepS;
  scene.walls = {oriented(recording.walkable, true)};
  for (const Polygon& obstacle : recording.obstacles)
    scene.walls.push_back(oriented(obstacle, false));
  for (const Walk& walk : recorded.people) {
    scene.groups.push_back(person(walk, recorded.dt_s, free_speeds));
  }
  std::string states;
  for (std::size_t stream = 0; stream < recording.goals.size(); ++stream) {
    const auto& goal = recording.goals[stream];
    scene.behavior
        .goal_box(static_cast<int>(stream), goal.min().x(), goal.min().y(), goal.max().x(),
                  goal.max().y())
        .walk_to(static_cast<int>(stream), state_name(stream));
    states += (stream > 0 ? "," : "") + state_name(stream);
  }
  scene.behavior.leave_at_goal(states);
  return scene;
}

InputError unusable(const Experiment& experiment, const fs::path& file, std::string found,
                    std::string expected) {
  return InputError({file.string(), fmt::format("experiment {}", experiment.name), std::move(found),
                     std::move(expected)});
}

Walks read_walks(const Experiment& experiment, const fs::path& file,
                 const metrics::TrajectoryFormat& format,
                 const std::vector<Eigen::AlignedBox2d>& goals) {
  Walks walks = recorded_walks(metrics::read_trajectory(file, {}, format), goals);
  if (duration_s(walks) > kMaxDurationS) {
    throw unusable(experiment, file, fmt::format("a recording of {:.0f} s", duration_s(walks)),
                   fmt::format("at most {:.0f} s; is the frame rate right?", kMaxDurationS));
  }
  return walks;
}

/// Goals that nobody walks to are no streams: people may walk through a corridor in one direction
/// only.
void leave_out_unused_goals(Recording& recording, Walks& walks) {
  std::vector<Eigen::AlignedBox2d> used;
  for (std::size_t stream = 0; stream < recording.goals.size(); ++stream) {
    bool walks_there = false;
    for (Walk& walk : walks.people) {
      if (walk.stream != stream) continue;
      walk.stream = used.size();
      walks_there = true;
    }
    if (walks_there) used.push_back(recording.goals[stream]);
  }
  recording.goals = std::move(used);
}

Walks walks_on_ground(Experiment& experiment) {
  Recording& recording = *experiment.recording;
  Walks walks = read_walks(experiment, recording.file, recording.format, recording.goals);
  const Vector2d somewhere = walks.people.front().places.front();
  begin_on_ground(walks, recording);
  if (walks.people.empty()) {
    throw unusable(experiment, recording.file,
                   fmt::format("nobody on the walkable ground, somebody at [{:.2f}, {:.2f}] m",
                               somewhere.x(), somewhere.y()),
                   "people on it; is the unit of lengths right?");
  }
  if (recording.steady && recording.steady->until_s > duration_s(walks)) {
    throw unusable(experiment, recording.file,
                   fmt::format("a recording of {:.1f} s", duration_s(walks)),
                   fmt::format("one with all of its steady state, which lasts until {:g} s",
                               recording.steady->until_s));
  }
  leave_out_unused_goals(recording, walks);
  return walks;
}

/// The part of the straight in which people were filmed, but for a step at each end, where only
/// some of the bodies are seen.
std::pair<double, double> filmed_part(const Walks& walks) {
  constexpr double kEndM = 0.1;
  constexpr double kStray = 0.001;  // positions of a tracker that lost somebody
  std::vector<double> x_m;
  for (const Walk& walk : walks.people) {
    for (const Vector2d& place : walk.places) x_m.push_back(place.x());
  }
  return {quantile(x_m, kStray) + kEndM, quantile(x_m, 1 - kStray) - kEndM};
}

/// The density and speed of people in single file, as those of a loop.
Loop measured_loop(const Experiment& experiment) {
  const SingleFile& single = *experiment.single_file;
  const Walks walks = read_walks(experiment, single.file, single.format, {});
  constexpr double kAsideM = 2;
  const auto [from_x_m, until_x_m] = single.from_x_m < single.until_x_m
                                         ? std::pair(single.from_x_m, single.until_x_m)
                                         : filmed_part(walks);
  const AreaMeans means = means_in_area(
      walks, {Vector2d(from_x_m, -kAsideM), Vector2d(until_x_m, kAsideM)}, {0, duration_s(walks)});
  const double per_m = means.density * 2 * kAsideM;
  Loop loop;
  loop.width_m = single.width_m;
  loop.length_m = static_cast<double>(single.people) / per_m;
  if (!std::isfinite(means.speed_mps) || loop.length_m > kMaxLoopM ||
      loop.length_m < 2 * std::numbers::pi * single.width_m) {
    throw unusable(
        experiment, single.file,
        fmt::format("{:.3g} people per meter from x = {:g} to {:g} m and y = {:g} to {:g} m, where "
                    "{} people would fill {:.3g} m",
                    per_m, from_x_m, until_x_m, -kAsideM, kAsideM, single.people, loop.length_m),
        fmt::format("people in a corridor of {:.3g} to {:g} m",
                    2 * std::numbers::pi * single.width_m, kMaxLoopM));
  }
  loop.recorded = {{per_m / single.width_m, means.speed_mps}};
  return loop;
}

Quantity specific_flow(const DensitySpeed& point) {
  return {fmt::format("flow at {:.1f} /m²", point.density), "1/(m s)",
          point.density * point.speed_mps, point.density};
}

}  // namespace

Walks replayed_walks(const Recording& recording, const Walks& recorded,
                     const FreeSpeeds& free_speeds, const Tested& tested, std::uint64_t seed,
                     const std::stop_token& stop) {
  crowd::Simulation crowd =
      load(describe_recording(recording, recorded, free_speeds), tested, seed);
  const double max_s = 3 * duration_s(recorded);
  Walks walks{kStepS, std::vector<Walk>(recorded.people.size())};
  for (std::size_t i = 0; i < walks.people.size(); ++i) {
    walks.people[i].stream = recorded.people[i].stream;
  }
  for (std::size_t step = 0; crowd.time_s() < max_s && !crowd.all_final(); ++step) {
    if (stop.stop_requested()) throw Cancelled();
    for (std::size_t i = 0; i < walks.people.size(); ++i) {
      if (crowd.present()[i] == 0) continue;
      Walk& walk = walks.people[i];
      if (walk.places.empty()) walk.first_step = step;
      walk.places.push_back(crowd.positions()[i].cast<double>());
    }
    crowd.step();
  }
  return walks;
}

Replay::Replay(Experiment experiment) : experiment_(std::move(experiment)) {
  if (const auto& recording = experiment_.recording) {
    walks_ = walks_on_ground(experiment_);
    steady_ = steady_range(walks_, *recording);
    recorded_ = measure(walks_, *recording, steady_);
    return;
  }
  if (experiment_.single_file) loop_ = measured_loop(experiment_);
  if (experiment_.loop) loop_ = *experiment_.loop;
  for (const DensitySpeed& point : loop_.recorded) {
    recorded_.quantities.push_back(specific_flow(point));
  }
}

Measures Replay::simulate(const Tested& tested, std::uint64_t seed,
                          const std::stop_token& stop) const {
  if (!experiment_.recording) return walk_around(tested, seed);
  return measure(
      replayed_walks(*experiment_.recording, walks_, experiment_.free_speeds, tested, seed, stop),
      *experiment_.recording, steady_);
}

Measures Replay::walk_around(const Tested& tested, std::uint64_t seed) const {
  Ring corridor;
  corridor.radius_m = loop_.length_m / (2 * std::numbers::pi);
  corridor.width_m = loop_.width_m;
  corridor.speed = sampled(experiment_.free_speeds);
  Measures measures;
  for (const DensitySpeed& point : loop_.recorded) {
    measures.quantities.push_back(
        specific_flow(walk_in_ring(tested, point.density, seed, corridor)));
  }
  return measures;
}

}  // namespace throng::validation
