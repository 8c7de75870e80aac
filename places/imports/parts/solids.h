// Triangles of basic shapes, and the ground that they block for people.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "places/imports/parts/areas.h"

namespace throng::imports {

using Triangle = std::array<Eigen::Vector3d, 3>;
using Triangles = std::vector<Triangle>;

/// The triangles (m) of a cone centered at the origin, with its axis along z.
Triangles cone_triangles(double radius, double length);
/// An ellipsoid with these radii, divided at its equator and lengthened along z by `stretch` (a
/// capsule).
Triangles ball_triangles(const Eigen::Vector3d& radii, double stretch = 0);
/// An upright prism with a simple polygon as footprint.
Triangles prism_triangles(const Corners& footprint, double from_z, double to_z);

void move(Triangles& triangles, const Eigen::Isometry3d& pose);

/// Bodies between these heights (m) are obstacles for people.
inline constexpr double kStepM = 0.2;
inline constexpr double kHeadM = 2;
/// Whether a body with this upper or lower end is no obstacle. The limits include a tolerance of a
/// micrometer for rounding.
inline bool is_step(double top_z) { return top_z <= kStepM + 1e-6; }
inline bool is_overhead(double bottom_z) { return bottom_z >= kHeadM - 1e-6; }

/// The ground below the parts of triangles between kStepM and kHeadM, as disjoint rectangles of
/// whole cells of 0.25 m (larger cells for extents above 250 m).
std::vector<Corners> project_shadow(const Triangles& triangles);

}  // namespace throng::imports
