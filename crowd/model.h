// Pedestrian models: from where everybody wants to go to how everybody moves.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "crowd/crowd.h"
#include "crowd/spatial/grid.h"

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
  std::string_view property_name = {};  ///< in a <Property>, where that has another name
};

struct ModelEntry {
  std::string_view name;  ///< in a project or on the command line
  std::string_view tag;   ///< of its element in a profile
  std::string_view help;
  std::vector<ModelParameter> parameters;  ///< in the order of Agents::model_parameters
  std::vector<ModelParameter> constants;   ///< in the order of Crowd::model_constants
  std::unique_ptr<Model> (*make)(const Crowd& crowd);
  std::string_view alias = {};  ///< another name, if it has one
};

const std::vector<ModelEntry>& models();
/// Throws InputError for an unknown name, listing those that there are.
const ModelEntry& find_model(std::string_view name);

ModelEntry orca_model();
ModelEntry weidmann_model();
ModelEntry ttc_model();
ModelEntry pedvo_model();
ModelEntry helbing_model();
ModelEntry johansson_model();
ModelEntry karamouzas_model();
ModelEntry zanlungo_model();
ModelEntry gcf_model();
ModelEntry dummy_model();

}  // namespace throng::crowd
