// Conversion of SDF's geometries to bodies of the scenario.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "places/imports/parts/imported_scenario.h"
#include "places/imports/parts/solids.h"
#include "places/imports/sdf/local_files.h"

namespace sdf {
inline namespace v12 {
class Geometry;
class Material;
}  // namespace v12
}  // namespace sdf

namespace throng::imports {

/// A geometry in the world's frame (m).
struct Body {
  /// Outline of an upright prism, a simple polygon, counter-clockwise; nothing for other shapes.
  std::optional<Corners> footprint;
  double from_z = 0;
  double to_z = 0;
  std::vector<Solid> solids;
};

/// Makes the body of a geometry at a pose; `file` is the file that contains the geometry. Planes
/// have a footprint without height and triangles; <empty/> has neither. `scale` stretches the
/// geometry along its own axes, round ones by the larger factor of x and y. Throws InputError for
/// unknown kinds, sizes that are not in (0, 10 km), and meshes that cannot be read.
Body make_body(const sdf::Geometry& geometry, const Eigen::Isometry3d& pose,
               const std::string& file, const LocalFiles& files,
               const Eigen::Vector3d& scale = Eigen::Vector3d::Ones());

/// The color of a material, if it defines one: diffuse, that of Gazebo's script, or ambient.
std::optional<Eigen::Vector3d> material_color(const sdf::Material* material);

/// The ground material whose color is most similar to `rgb`.
std::string ground_material_like(const Eigen::Vector3d& rgb);

}  // namespace throng::imports
