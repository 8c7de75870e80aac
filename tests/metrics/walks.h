// Traces made by hand for the tests: people whose place is a function of time.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "world/scenario.h"
#include "world/trace.h"

namespace throng::metrics {

/// Position of a person at a time (m).
using Walk = std::function<Eigen::Vector2d(double time_s)>;

inline Walk standing(const Eigen::Vector2d& place) {
  return [place](double) { return place; };
}

/// From `start` with `velocity`, from the time `from_s` on.
inline Walk walking(const Eigen::Vector2d& start, const Eigen::Vector2d& velocity,
                    double from_s = 0) {
  return [=](double time_s) -> Eigen::Vector2d {
    return start + velocity * std::max(0.0, time_s - from_s);
  };
}

struct CrowdOfTest {
  double dt_s = 0.1;
  double duration_s = 60;
  float radius_m = 0.2F;
  float desired_speed_mps = 1.3F;
  std::int8_t intent = 0;
};

/// A trace of people who all intend the first of `exit_ids`.
inline world::Trace make_trace(const std::vector<Walk>& walks, const CrowdOfTest& crowd = {},
                               std::vector<std::string> exit_ids = {"door"}) {
  world::Trace trace;
  trace.header.dt_s = crowd.dt_s;
  trace.header.exit_ids = std::move(exit_ids);
  trace.header.role.assign(walks.size(), world::AgentRole::person);
  trace.header.radius_m.assign(walks.size(), crowd.radius_m);
  trace.header.pref_speed_mps.assign(walks.size(), crowd.desired_speed_mps);
  trace.header.group.assign(walks.size(), -1);
  const auto steps = std::lround(crowd.duration_s / crowd.dt_s);
  for (long step = 0; step <= steps; ++step) {
    const double time_s = static_cast<double>(step) * crowd.dt_s;
    trace.time_s.push_back(time_s);
    for (const Walk& walk : walks) {
      const Eigen::Vector2d velocity = (walk(time_s + 1e-3) - walk(time_s)) / 1e-3;
      trace.position.emplace_back(walk(time_s).cast<float>());
      trace.velocity.emplace_back(velocity.cast<float>());
      trace.yaw_rad.push_back(0);
      trace.desired_speed_mps.push_back(crowd.desired_speed_mps);
      trace.state.push_back(0);
      trace.exit_intent.push_back(crowd.intent);
      trace.flags.push_back(world::kPresent);
    }
  }
  return trace;
}

/// A door on the line x = 0, `width_m` wide about the origin, that leads toward +x.
inline world::Exit door(double width_m) {
  world::Exit exit;
  exit.id = "door";
  exit.from = {0, -0.5 * width_m};
  exit.to = {0, 0.5 * width_m};
  exit.outward = {1, 0};
  return exit;
}

/// The same place, where something happens at a time.
inline void add_alarm(world::Scenario& scenario, double at_s) {
  world::Disaster disaster;
  disaster.start_s = at_s;
  scenario.disasters.push_back(disaster);
}

inline world::Scenario place_with_door(double width_m) {
  world::Scenario scenario;
  scenario.id = "test";
  scenario.inside.bounds = {{-20, -20}, {10, 20}};
  scenario.exits.push_back(door(width_m));
  return scenario;
}

/// The same place, whose door is at its border, x = 10.
inline world::Scenario place_with_door_at_border(double width_m) {
  world::Scenario scenario = place_with_door(width_m);
  scenario.exits[0].from.x() = scenario.exits[0].to.x() = 10;
  return scenario;
}

inline world::Building box(Eigen::Vector2d min, Eigen::Vector2d max) {
  return {"box", {min, {max.x(), min.y()}, max, {min.x(), max.y()}}, 10};
}

}  // namespace throng::metrics
