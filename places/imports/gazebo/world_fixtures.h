// Robots and cameras of a world, which become drones of the draft job.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "places/imports/parts/imported_scenario.h"

namespace sdf {
inline namespace v12 {
class Model;
class Sensor;
}  // namespace v12
}  // namespace sdf

namespace throng::imports {

/// Whether motors turn rotors of this model or of a model in it.
bool is_robot(const sdf::Model& model);

/// Adds a drone that begins where a robot stands, as high as overview_height_m() once that is known
/// (place_drones()); `pose` is the robot's in the world.
void add_robot(const sdf::Model& model, const Eigen::Isometry3d& pose, ImportedScenario& place);

/// Adds a drone that hovers where a camera of the world is; `link` is its link's pose. Returns why
/// it cannot, or nothing.
std::optional<std::string> add_camera(const sdf::Sensor& sensor, const Eigen::Isometry3d& link,
                                      ImportedScenario& place);

/// Once all buildings are known: raises robots that stand on the ground, and takes cameras out that
/// are nearer to a building than drones may be. Adds to `place.skipped`, with this file.
void place_drones(const std::string& file, ImportedScenario& place);

}  // namespace throng::imports
