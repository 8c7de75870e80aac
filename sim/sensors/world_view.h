// The observation of a policy at one time: the truth, or a camera's estimate
// (sim/sensors/perception.h).
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace throng::sim {

/// A person who is still in the scenario.
struct PersonSeen {
  Eigen::Vector2d position;  ///< m
  Eigen::Vector2d velocity;  ///< m/s
  int exit = -1;             ///< index of the exit for which the person heads; -1: none
  int guide = -1;            ///< index of the drone that the person follows; -1: none
};

/// The plan that a drone announces to the other drones.
struct LeadPlan {
  int from = -1;                              ///< exit from whose queue it takes people; -1: none
  int to = -1;                                ///< exit to which it leads them; -1: leads nobody
  double people = 0;                          ///< number of people whom it leads or will lead
  bool leads = false;                         ///< whether it leads them already
  std::optional<Eigen::Vector2d> place = {};  ///< current or next work position, m
};

/// A drone, as other drones know it by radio.
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
  std::vector<double> exit_flow_per_s;  ///< per exit: outflow, mean over 8 s
  std::vector<DroneSeen> drones;
};

}  // namespace throng::sim
