// The state of a running crowd, which plug-ins read.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "base/compute/instruction_set.h"
#include "crowd/agents/agents.h"
#include "crowd/elements/shared_parts.h"
#include "crowd/spatial/obstacles.h"
#include "crowd/state/goals.h"

namespace throng::crowd {

class Elevation;

struct Crowd {
  Agents agents;
  Goals goals;
  Obstacles obstacles;
  /// Resources that several elements of the files share, e.g. a mesh; loaders of elements add them.
  std::shared_ptr<SharedParts> parts = std::make_shared<SharedParts>();
  std::shared_ptr<const Elevation> elevation;  ///< null: level ground
  std::vector<float> model_constants;  ///< set in the scene, in the order of ModelEntry::constants
  std::vector<std::string_view> model_parameter_names;  ///< names of Agents::model_parameters
  Compat compat = Compat::none;
  double compliance = 1;         ///< multiplies the probability that a person follows a guide
  bool test_visibility = false;  ///< whether walls hide neighbors
  InstructionSet instruction_set = best_instruction_set();  ///< for loops with vectorized versions
  std::uint64_t seed = 1;                                   ///< seed of the run
  std::vector<std::vector<std::uint32_t>> social_groups;    ///< ids of the members of each group
  std::size_t awaited = 0;                                  ///< number of agents still to arrive
  std::vector<double> planned_arrivals_s;                   ///< when agents are to arrive, of all
  double dt_s = 0.1;                                        ///< duration of one (sub-)step
  std::uint64_t step = 0;

  double time_s() const { return static_cast<double>(step) * dt_s; }
};

}  // namespace throng::crowd
