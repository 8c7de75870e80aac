// Pedestrian models: from where everybody wants to go to how everybody moves.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "crowd/crowd.h"
#include "crowd/grid.h"

namespace throng::crowd {

/// Computes new velocities from the state of everybody at the beginning of a step.
class Model {
 public:
  virtual ~Model() = default;

  /// Writes the new velocity of every agent in the grid to new_velocity[id].
  virtual void step(const Crowd& crowd, const Grid& grid,
                    std::span<Eigen::Vector2f> new_velocity) = 0;
};

/// A parameter of a model: an attribute of its element in a profile, or a <Property> in there; or
/// an attribute of its element in the scene.
struct ModelParameter {
  std::string_view name;
  float initial;
  float min;
  float max;
  std::string_view help;
};

struct ModelEntry {
  std::string_view name;  ///< in a project or on the command line
  std::string_view tag;   ///< of its element in a profile
  std::string_view help;
  std::vector<ModelParameter> parameters;  ///< in the order of Agents::model_parameters
  std::vector<ModelParameter> constants;   ///< in the order of Crowd::model_constants
  std::unique_ptr<Model> (*make)(const Crowd& crowd);
};

const std::vector<ModelEntry>& models();
/// Throws InputError for an unknown name, listing those that there are.
const ModelEntry& find_model(std::string_view name);

ModelEntry orca_model();

}  // namespace throng::crowd
