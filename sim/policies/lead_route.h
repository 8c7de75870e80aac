// The path along which a drone leads people out by an exit.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "world/scenario.h"

namespace throng::sim {

/// Before the door, so that those behind line up; in it; and beyond it, clear of the walls. Meters.
struct LeadRoute {
  std::array<Eigen::Vector2d, 3> points;
  const Eigen::Vector2d& mouth() const { return points[1]; }
};

/// Lines up `before_m` in front of the door.
LeadRoute route_through(const world::Exit& exit, const std::vector<world::Building>& buildings,
                        double before_m = 3);

/// The exits that a drone may lead to: those of these ids, or all, as far as they are open at
/// first.
std::vector<int> exits_to_lead_to(const world::Scenario& scenario,
                                  const std::vector<std::string>& ids);

}  // namespace throng::sim
