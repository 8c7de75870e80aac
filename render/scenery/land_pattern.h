// The pattern of the land beyond a scenario: the same fields, plots and hedges that
// shaders/ground_surroundings.glsl paints, for what stands on them. Independent of GL.
#pragma once

#include <Eigen/Core>

#include "world/scenario.h"

namespace throng::render {

/// The irregular number, 0 to 1, of a cell; hash() of shaders/noise.glsl.
double cell_hash(const Eigen::Vector2i& cell);

/// Smooth noise, 0 to 1, with a feature per unit; noise() of shaders/noise.glsl.
double smooth_noise(const Eigen::Vector2d& at);

/// Coordinates (m) along the fields of a point of the ground, and the reverse.
Eigen::Vector2d land_from_ground(const Eigen::Vector2d& point);
Eigen::Vector2d ground_from_land(const Eigen::Vector2d& at);

/// Direction of the rows of fields on the ground.
inline constexpr double kLandYawRad = -0.347;

/// Depth (m) of each row of fields.
inline constexpr double kFieldM = 130;

/// Width and depth (m) of a house's plot.
inline const Eigen::Vector2d kPlotM(26, 34);

/// A field: where it begins along its row and how long it is, in coordinates of the land.
struct Field {
  Eigen::Vector2i number;  ///< in its row, and of the row
  double begin_m = 0;
  double length_m = kFieldM;
};

/// The field at a place, in coordinates of the land.
Field field_at(const Eigen::Vector2d& at);

/// The share of the fields that are built over in a place like this; also the uniform `built_share`
/// of shaders/ground_surroundings.glsl. Many in a town, which is a place between houses of three
/// stories and more.
double built_share(const world::Scenario& scenario);

/// Whether houses stand on a field.
bool is_built(const Field& field, double share);

/// Whether a house stands on a plot.
bool has_house(const Eigen::Vector2i& plot);

/// Whether bushes and trees grow along the lower border of a row of fields.
bool has_hedge(int row);

}  // namespace throng::render
