// Pedestrian models: from the preferred velocities of all agents to their velocities.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "crowd/crowd.h"
#include "crowd/spatial/grid.h"

namespace throng::crowd {

/// A pedestrian model: computes new velocities from the state of all agents at the start of a step.
class Model {
 public:
  virtual ~Model() = default;

  /// Writes the new velocity of every agent in the grid to new_velocity[id].
  virtual void step(const Crowd& crowd, const Grid& grid,
                    std::span<Eigen::Vector2f> new_velocity) = 0;
};

/// A parameter or constant of a pedestrian model. A parameter is an attribute of the model's
/// element in a profile, or a <Property> of that element; a constant is an attribute of its element
/// in the scene.
struct ModelParameter {
  std::string_view name;
  float initial;
  float min;
  float max;
  std::string_view help;
  std::string_view property_name = {};  ///< name in a <Property> if it differs from `name`
};

/// A pedestrian model, as find_model() finds it.
struct ModelEntry {
  std::string_view name;  ///< name in projects, jobs and on the command line
  std::string_view tag;   ///< tag of its element in profiles
  std::string_view help;
  std::vector<ModelParameter> parameters;  ///< in the order of Agents::model_parameters
  std::vector<ModelParameter> constants;   ///< in the order of Crowd::model_constants
  std::unique_ptr<Model> (*make)(const Crowd& crowd);
  std::string_view alias = {};  ///< alternative name; may be empty
};

/// Returns all pedestrian models.
const std::vector<ModelEntry>& models();
/// Returns the model with this name or alias. Throws InputError, with a list of names, if there is
/// none.
const ModelEntry& find_model(std::string_view name);

/// The entries of models(), defined in models/*.cpp.
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
