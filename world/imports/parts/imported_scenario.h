// A scenario on its way from somebody else's file to a scenario: what is there, before it has
// people.
#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "world/imports/parts/areas.h"
#include "world/scenario.h"

namespace throng::imports {

/// Something of the file that the scenario does not have, or not as it was.
struct Skipped {
  std::string file;
  int line = 0;         ///< 0: the format has no lines
  std::string element;  ///< "model/link/visual <heightmap>", "way 123"
  std::string reason;

  /// "world.sdf:12: model box <plugin>: plugins are not run"
  std::string text() const;
};

/// Triangles of one color (linear RGB, 0 to 1), in the world (m).
struct Solid {
  Eigen::Vector3d rgb{0.6, 0.6, 0.6};
  std::vector<std::array<Eigen::Vector3d, 3>> triangles;
};

/// Something that is drawn as it is and has an id of its own.
struct Object {
  std::string name;
  std::vector<Solid> solids;
};

/// An exit and entrance: a segment on the ground.
struct Gate {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  double share = 0;  ///< of those who come in, relative to other gates
};

struct ImportedScenario {
  std::string name;
  std::string description;
  world::Rectangle inside;  ///< whom the scenario counts; the ground reaches farther
  std::string ground_material = "concrete";
  std::vector<world::GroundArea> areas;
  std::vector<world::Marking> markings;
  std::vector<world::Building> buildings;  ///< what drones cannot fly through
  std::vector<world::Prop> props;
  std::vector<Object> objects;
  std::vector<Corners> obstacles;  ///< where nobody can walk: buildings and all else; simple
  std::vector<Gate> gates;
  bool gates_asked = false;  ///< by the user, not found in the file
  bool people_come = false;  ///< through the gates, as many as leave
  std::vector<Skipped> skipped;
};

/// How far the drawn ground reaches beyond ImportedScenario::inside (m).
inline constexpr double kGroundBeyondM = 12;

/// The ground that is drawn.
world::Rectangle ground_rectangle(const ImportedScenario& scenario);

}  // namespace throng::imports
