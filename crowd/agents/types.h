// Types shared by the public interface of the engine and its parts.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "crowd/description/options.h"

namespace throng::crowd {

/// The fall of an agent.
struct Fall {
  std::uint32_t agent;
  float impulse_ns;     ///< impulse of the impact (N s); 0: the crowd caused the fall
  float crush_n_per_m;  ///< crowd force per meter of body circumference; 0: an impact
};

/// A line that no more people pass than its capacity allows (crowd/motion/metered_doors.h).
struct MeteredDoor {
  Eigen::Vector2f from;  ///< m
  Eigen::Vector2f to;    ///< m
  Eigen::Vector2f outward;
  float per_s = 1;         ///< people
  bool both_ways = false;  ///< whether those who come in need admission, too
};

/// Options of a Simulation.
struct LoadOptions {
  std::uint64_t seed = 1;
  std::string model = "orca";  ///< name or alias of the pedestrian model
  Compat compat = Compat::none;
  std::optional<double> time_step_s = {};  ///< replaces the time step of the scene
  int sub_steps = 0;                       ///< unrecorded steps between two time steps
  BodySeparation separation = BodySeparation::automatic;  ///< Simulation::options() has the result
  ConstantsChoice constants = ConstantsChoice::best;
  double compliance = 1;  ///< multiplies the probability that a person follows a guide
  Physical physical = {};
  std::vector<MeteredDoor> metered_doors = {};
  /// False for a crowd whose people are only counted and found where they start: without the meshes
  /// of their paths, which take most of the time. It faces nowhere; Simulation::prepare_to_step()
  /// completes it.
  bool can_step = true;
};

/// The goal of an agent: ids of goal set and goal in the behavior file; -1 for goals that a
/// selector computes (identity, offset, ...).
struct GoalId {
  std::int32_t set = -1;
  std::int32_t goal = -1;
};

}  // namespace throng::crowd
