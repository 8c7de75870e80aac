// Bodies as triangles, and what of them stands in people's way.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "world/imports/parts/areas.h"

namespace throng::imports {

using Triangle = std::array<Eigen::Vector3d, 3>;
using Triangles = std::vector<Triangle>;

/// About the origin, the axis of a cylinder along z; meters.
Triangles box_triangles(const Eigen::Vector3d& size);
Triangles cylinder_triangles(double radius, double length);
Triangles cone_triangles(double radius, double length);
/// An ellipsoid of these radii, pulled apart along z by `stretch` (a capsule).
Triangles ball_triangles(const Eigen::Vector3d& radii, double stretch = 0);
/// An upright prism over a simple polygon.
Triangles prism_triangles(const Corners& footprint, double from_z, double to_z);

void move(Triangles& triangles, const Eigen::Isometry3d& pose);

/// Bodies between these heights are obstacles for people who walk.
inline constexpr double kStepM = 0.2;
inline constexpr double kHeadM = 2;
/// Whether what ends, or begins, at a height is in nobody's way: at exactly these heights it is
/// not, within a micrometer, which sums of poses and sizes are off.
inline bool is_step(double top_z) { return top_z <= kStepM + 1e-6; }
inline bool is_overhead(double bottom_z) { return bottom_z >= kHeadM - 1e-6; }

/// The ground below what of the triangles is between kStepM and kHeadM, as rectangles of whole
/// cells of 0.25 m that do not overlap; coarser cells for what is larger than 250 m.
std::vector<Corners> project_shadow(const Triangles& triangles);

}  // namespace throng::imports
