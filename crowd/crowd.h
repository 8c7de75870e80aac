// The parts of a running crowd: all state that plug-ins may read.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "base/compute/instruction_set.h"
#include "crowd/agents.h"
#include "crowd/behavior/goals.h"
#include "crowd/elements/shared_parts.h"
#include "crowd/navigation/elevation.h"
#include "crowd/spatial/obstacles.h"

namespace throng::crowd {

struct Crowd {
  Agents agents;
  Goals goals;
  Obstacles obstacles;
  /// Resources that several elements of the files share, e.g. a mesh; loaders of elements add to
  /// it.
  std::shared_ptr<SharedParts> parts = std::make_shared<SharedParts>();
  std::shared_ptr<const Elevation> elevation;  ///< none: level ground
  std::vector<float> model_constants;          ///< of the scene, in the order of the model's table
  std::vector<std::string_view> model_parameter_names;  ///< of Agents::model_parameters
  Compat compat = Compat::none;
  double compliance = 1;                                    ///< of people with those who lead them
  bool test_visibility = false;                             ///< walls hide neighbors
  InstructionSet instruction_set = best_instruction_set();  ///< for the loops that have a choice
  std::uint64_t seed = 1;                                   ///< of the run
  std::vector<std::vector<std::uint32_t>> social_groups;    ///< the ids of their members
  std::size_t awaited = 0;                                  ///< agents still to arrive
  double dt_s = 0.1;                                        ///< of one (sub-)step
  std::uint64_t step = 0;

  double time_s() const { return static_cast<double>(step) * dt_s; }
};

}  // namespace throng::crowd
