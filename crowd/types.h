// Values that the engine's interface and its parts share.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "crowd/description/options.h"

namespace throng::crowd {

/// Somebody fell.
struct Fall {
  std::uint32_t agent;
  float impulse_ns;     ///< of the blow; 0: it was the crowd
  float crush_n_per_m;  ///< of the crowd, per meter of girth; 0: it was a blow
};

struct LoadOptions {
  std::uint64_t seed = 1;
  std::string model = "orca";  ///< the pedestrian model
  Compat compat = Compat::none;
  std::optional<double> time_step_s = {};  ///< instead of the scene's
  int sub_steps = 0;                       ///< steps in between that nobody sees, per time step
  bool hard_separation = false;            ///< bodies never overlap by more than 1 cm
  double compliance = 1;                   ///< times the probability that somebody follows a guide
  Physical physical = {};
};

/// A goal chosen by an agent: set and goal id of the behavior file; -1 for one made on the fly
/// (identity, offset, ...).
struct GoalId {
  std::int32_t set = -1;
  std::int32_t goal = -1;
};

}  // namespace throng::crowd
