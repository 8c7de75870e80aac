// The walls of a scene.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "crowd/crowd.h"
#include "crowd/elements/registry.h"

namespace throng::crowd {

/// The polygons of an <ObstacleSet>: solid when their corners are counter-clockwise, outer walls
/// with people inside when they are clockwise.
struct ObstacleSet {
  struct Polygon {
    std::vector<Eigen::Vector2f> corners;
    Element element;  ///< to complain about
  };
  std::vector<Polygon> polygons;
};

/// The corners that an element's <Vertex> children give, counter-clockwise or clockwise. Throws
/// InputError for fewer than three, for two in one place, and for a polygon without area.
std::vector<Eigen::Vector2f> read_polygon(const Element& element);

struct ObstacleSetContext {
  SharedParts& parts;
};

using ObstacleSetRegistry = Registry<ObstacleSet, ObstacleSetContext>;
/// explicit, nav_mesh.
const ObstacleSetRegistry& obstacle_set_registry();

/// Reads the <ObstacleSet>s of a scene.
class ObstacleSets {
 public:
  /// Adds a set's polygons to the crowd. Throws InputError.
  void load(const Element& element, Crowd& crowd);

  /// Warns of polygons on whose wrong side agents stand: an outer wall with nobody inside is
  /// probably wound the wrong way. To be called once all agents have their places.
  void report(const Crowd& crowd) const;

 private:
  std::vector<Element> elements_;  // by index of the polygon among the crowd's obstacles
};

}  // namespace throng::crowd
