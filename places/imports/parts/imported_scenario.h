// An imported scenario in memory, before people are added (parts/populate.h).
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "places/imports/parts/areas.h"
#include "world/scenario.h"

namespace throng::imports {

/// An element of the file that the scenario lacks or has in a changed form.
struct Skipped {
  std::string file;
  int line = 0;         ///< 0: the format has no lines
  std::string element;  ///< "model/link/visual <heightmap>", "way 123"
  std::string reason;

  /// One line, such as "world.sdf:12: model box <plugin>: plugins are not run".
  std::string text() const;
};

/// Triangles of one color (linear RGB, 0 to 1), in the world's frame (m).
struct Solid {
  Eigen::Vector3d rgb{0.6, 0.6, 0.6};
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;
};

/// An object that is rendered unchanged and has its own id.
struct Object {
  std::string name;
  std::vector<Solid> solids;
};

/// An exit and entrance: a segment on the ground.
struct Gate {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  double share = 0;  ///< relative number of people who enter here
};

/// A drone of the draft job: a robot of a world, or one of its cameras, which hovers.
struct ImportedDrone {
  std::string id;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double yaw_rad = 0;
  std::filesystem::path robot_file;  ///< "": a camera
  nlohmann::ordered_json airframe;   ///< null: the default
  nlohmann::ordered_json camera;     ///< fields of the drone's camera; null: none
};

/// The content of an imported file.
struct ImportedScenario {
  std::string name;
  std::string description;
  world::Rectangle inside;  ///< Scenario::inside; the ground extends farther
  std::string ground_material = "concrete";
  std::vector<world::GroundArea> areas;
  std::vector<world::Marking> markings;
  std::vector<world::Building> buildings;  ///< obstacles for drones
  std::vector<world::Prop> props;
  std::vector<Object> objects;
  std::vector<Corners> obstacles;  ///< all obstacles for people, including buildings; simple
  std::vector<Gate> gates;
  bool gates_asked = false;             ///< the user specified the gates
  bool people_come = false;             ///< people enter through the gates, as many as leave
  std::vector<Eigen::Vector2d> people;  ///< where the file has people; others are drawn
  std::vector<ImportedDrone> drones;
  nlohmann::ordered_json environment;  ///< of the draft job; null: the default
  std::vector<Skipped> skipped;
};

/// Distance (m) by which the rendered ground extends beyond ImportedScenario::inside.
inline constexpr double kGroundBeyondM = 12;

/// The extent of the rendered ground.
world::Rectangle ground_rectangle(const ImportedScenario& scenario);

}  // namespace throng::imports
