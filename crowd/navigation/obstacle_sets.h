// Obstacle sets of a scene.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "crowd/elements/registry.h"
#include "crowd/state/crowd.h"

namespace throng::crowd {

/// The polygons of an <ObstacleSet>: solid if counter-clockwise, outer walls with people inside if
/// clockwise.
struct ObstacleSet {
  struct Polygon {
    std::vector<Eigen::Vector2f> corners;
    Element element;  ///< for messages
  };
  std::vector<Polygon> polygons;
};

/// Reads the corners of a polygon, <Vertex> children of an element. A last corner that repeats the
/// first is dropped with a warning. Throws InputError for fewer than three corners, other equal
/// corners, and a polygon without area.
std::vector<Eigen::Vector2f> read_polygon(const Element& element);

struct ObstacleSetContext {
  SharedParts& parts;
};

using ObstacleSetRegistry = Registry<ObstacleSet, ObstacleSetContext>;
/// Types: explicit, nav_mesh.
const ObstacleSetRegistry& obstacle_set_registry();

/// Reads the <ObstacleSet>s of a scene and checks their orientation.
class ObstacleSets {
 public:
  /// Adds the polygons of a set to the crowd. Throws InputError.
  void load(const Element& element, Crowd& crowd);

  /// Warns of polygons with agents on the wrong side: an outer wall without agents inside probably
  /// has the wrong orientation. Must be called when all agents have positions.
  void report(const Crowd& crowd) const;

 private:
  std::vector<Element> elements_;  // indexed by polygon of Crowd::obstacles
};

}  // namespace throng::crowd
