// A guide's knowledge of the world at one moment: the truth, or its camera's estimate
// (sim/sensors/perception.h).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace throng::sim {

/// Somebody who is still in the scenario.
struct PersonSeen {
  Eigen::Vector2d position;  ///< m
  Eigen::Vector2d velocity;  ///< m/s
  int exit = -1;             ///< the exit of the scenario that the person heads for; -1: none
  int guide = -1;            ///< the drone of the run that the person follows; -1: none
};

/// Plan that a drone announces to the others.
struct LeadPlan {
  int from = -1;       ///< takes people from the queue of this exit; -1: from none
  int to = -1;         ///< and leads them to this one; -1: leads nobody
  double people = 0;   ///< how many it means to lead, or leads
  bool leads = false;  ///< has them already
  std::optional<Eigen::Vector2d> place = {};  ///< where it is busy or goes to be, m
};

struct DroneSeen {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s
  bool beacon = false;                                 ///< whether people can follow it now
  LeadPlan plan;
};

/// People and drones that a drone sees. Drones know each other's positions and plans by radio.
struct WorldView {
  double time_s = 0;
  std::vector<PersonSeen> people;
  std::vector<double> exit_flow_per_s;  ///< per exit: people who went out, mean over 8 s
  std::vector<DroneSeen> drones;
};

}  // namespace throng::sim
