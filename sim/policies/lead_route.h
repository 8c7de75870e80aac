// The path along which a drone leads people through an exit.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "world/scenario.h"

namespace throng::sim {

/// Three points (m): in front of the door, where followers line up; in the door; and beyond it,
/// clear of the walls.
struct LeadRoute {
  std::array<Eigen::Vector2d, 3> points;
  const Eigen::Vector2d& mouth() const { return points[1]; }
};

/// The route through an exit; its first point is `before_m` in front of the door.
LeadRoute route_through(const world::Exit& exit, const std::vector<world::Building>& buildings,
                        double before_m = 3);

/// Indices of the exits to which a drone may lead: those with these ids, or all if `ids` is empty,
/// as far as they are open at the start.
std::vector<int> exits_to_lead_to(const world::Scenario& scenario,
                                  const std::vector<std::string>& ids);

}  // namespace throng::sim
