// Shapes of props as data: shapes/*/NAME.json, embedded. A file has "parts" and the "paints" that
// they name, chosen once per prop; paints.json has those of all. A part is one surface:
//
//   box [x0, y0, z0, x1, y1, z1]              block [x0, y0, x1, y1, z0, x0, y0, x1, y1, z1]
//   tube [x, y, z, radius, x, y, z, radius]   lathe [[z, radius], ...] upwards around the z axis
//   quad [[x, y, z], ...] of four corners     loft [[x, half_y, z, half_y, z], ...] of sections,
//   foliage {middle, radii, sprite, ...}           below and above, backwards along x
//   shape NAME, with paints of its own        parts [...]      one_of [[...], ...] lists of parts
//
// and how it is placed: "scale", then "tilt_deg" (about y), "turn_deg" (about z) and "at"; "mirror"
// adds the same across "x", "y" or both; "repeat" {count, step, turn_deg} adds copies, each a step
// or a turn about the origin further, or is a list of repeats. "chance" decides for each copy.
// "paint" is a name or a list to choose from for each copy, "shade" and "vary" multiply it, "near"
// marks details. "two_sided" quads are cloths; "sides" are those of round surfaces. "lamps" {at,
// strength, color} and "beams" {at, towards, color} of a file shine after sunset.
#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "render/props/prop_builder.h"

namespace throng::render {

/// A lamp of a shape, in the prop's frame (m), with strength and color relative to a lamp post's.
struct ShapeLamp {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  double strength = 1;
  Eigen::Array3d color = Eigen::Array3d::Ones();
};

/// A beam of a shape that shows in haze after sunset, in the prop's frame, and its color.
struct ShapeBeam {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();     ///< m
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitZ();  ///< around which it sweeps
  Eigen::Array3d color = Eigen::Array3d::Ones();
};

/// Names of all files, sorted: kinds of props, and what several of them use.
std::vector<std::string_view> shape_names();

/// Adds the shape of a file.
void add_shape(std::string_view name, PropBuilder& builder);

/// The lamps and the beams of a file; none if there is no such file.
std::vector<ShapeLamp> shape_lamps(std::string_view name);
std::vector<ShapeBeam> shape_beams(std::string_view name);

}  // namespace throng::render
