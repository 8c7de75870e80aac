// Pedestrian models: from the preferred velocities of all agents to their velocities.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "crowd/spatial/grid.h"
#include "crowd/state/crowd.h"

namespace throng::crowd {

/// A pedestrian model: computes new velocities from the state of all agents at the start of a step.
class Model {
 public:
  virtual ~Model() = default;

  /// Writes the new velocity of every agent in the grid to new_velocity[id].
  virtual void step(const Crowd& crowd, const Grid& grid,
                    std::span<Eigen::Vector2f> new_velocity) = 0;

  /// The share of its radius that each body takes after the step, by agent; empty: all of it.
  virtual std::span<const float> breadths() const { return {}; }
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

/// A constant with another value than that of the table.
struct ConstantValue {
  std::string_view name;
  float value;
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
  /// Whether bodies are kept apart unless the user says otherwise (BodySeparation::automatic).
  bool separates = false;
  /// Draws from the posterior of a fit, as a table (CSV) with the names of constants in its first
  /// line; empty if the model was not fitted.
  std::string_view posterior = {};
  /// Values with which exits pass no more people than standards allow; may be empty.
  std::vector<ConstantValue> conservative = {};
};

/// Returns all pedestrian models.
const std::vector<ModelEntry>& models();
/// Returns the model with this name or alias. Throws InputError, with a list of names, if there is
/// none.
const ModelEntry& find_model(std::string_view name);

/// Returns the constants of a model, in the order of ModelEntry::constants; a draw from the
/// posterior depends on the seed. Throws InputError if the model has no such values.
std::vector<float> chosen_constants(const ModelEntry& model, ConstantsChoice choice,
                                    std::uint64_t seed);

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
