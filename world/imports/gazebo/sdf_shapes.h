// SDF's geometries as bodies of the scenario.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "world/imports/gazebo/local_files.h"
#include "world/imports/parts/imported_scenario.h"
#include "world/imports/parts/solids.h"

namespace sdf {
inline namespace v12 {
class Geometry;
class Material;
}  // namespace v12
}  // namespace sdf

namespace throng::imports {

/// A geometry in the world.
struct Body {
  /// Outline of a shape that stands upright and is the same at all its heights; simple,
  /// counter-clockwise.
  std::optional<Corners> footprint;
  double from_z = 0;
  double to_z = 0;
  std::vector<Solid> solids;
};

/// A geometry at a pose; `file` is the one it stands in. Planes have a footprint, no height and no
/// triangles, <empty/> has nothing. Throws InputError for one that there is no body for: unknown
/// kinds, sizes that are no positive numbers below 10 km, meshes that cannot be read.
Body make_body(const sdf::Geometry& geometry, const Eigen::Isometry3d& pose,
               const std::string& file, const LocalFiles& files);

/// The color that a material gives, if it does: diffuse, that of Gazebo's script, or ambient.
std::optional<Eigen::Vector3d> material_color(const sdf::Material* material);

/// The ground's material that looks most like a color.
std::string ground_material_like(const Eigen::Vector3d& rgb);

}  // namespace throng::imports
