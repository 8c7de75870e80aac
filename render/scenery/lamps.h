// Lamps of streets, stalls and stages, which are lit after sunset: their positions and light.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "world/scenario.h"

namespace throng::render {

/// A lamp.
struct Lamp {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< position of the light, m
  /// Outward normal of the wall of a wall lamp, which shines to this side only; zero: all around.
  Eigen::Vector2d away = Eigen::Vector2d::Zero();
  double strength = 1;                            ///< over that of a street lamp
  Eigen::Array3d color = Eigen::Array3d::Ones();  ///< over that of a street lamp
};

/// Lamps on every 12 m of every wall that is at least 4 m long (also in
/// shaders/wall.frag.glsl), 4.2 m above the ground.
std::vector<Lamp> wall_lamps(const world::Scenario& scenario);

/// The lamps on walls, on lamp posts, and in what is used at night: stalls, tents, kiosks, stages.
std::vector<Lamp> all_lamps(const world::Scenario& scenario);

/// Farther than this a lamp lights nothing (m): 26, and more if it is strong.
double lamp_reach_m(const Lamp& lamp);

/// The light of a lamp on a surface that faces it, in the units of render/scenery/daylight.h, when
/// nothing is between; `up` is the sine of the lamp's elevation seen from there.
double lamp_strength(const Lamp& lamp, double distance_m, double up);

}  // namespace throng::render
