// The <state> of a world that Gazebo saved: where its models were then, and how they were scaled.
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "places/imports/parts/imported_scenario.h"

namespace sdf {
inline namespace v12 {
class Element;
class World;
}  // namespace v12
}  // namespace sdf

namespace throng::imports {

/// The saved state of a model, link or light. Poses are in the world's frame.
struct EntityState {
  std::optional<Eigen::Isometry3d> pose;
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();
  std::map<std::string, EntityState> models;
  std::map<std::string, EntityState> links;

  /// The state of a model or link within this one; nullptr if there is none.
  const EntityState* model(const std::string& name) const;
  const EntityState* link(const std::string& name) const;
};

/// The saved state of a world; empty for a world without one.
struct SavedState {
  EntityState world;  ///< its models
  std::map<std::string, EntityState> lights;
  std::vector<std::string> deleted;   ///< names of models and lights
  std::vector<std::string> inserted;  ///< models and lights that only the state has
  std::vector<std::string> unread;    ///< entities whose poses or scales are no numbers
};

/// Reads the <state> of a world.
SavedState read_saved_state(const sdf::World& world);

}  // namespace throng::imports
