// Lamps of streets, stalls and stages, which are lit after sunset: their positions and light.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "render/gl/gl_objects.h"
#include "world/scenario.h"

namespace throng::render {

/// A lamp.
struct Lamp {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< position of the light, m
  /// Outward normal of the wall of a wall lamp, which shines to this side only; zero: all around.
  Eigen::Vector2d away = Eigen::Vector2d::Zero();
  double strength = 1;  ///< over that of a street lamp
};

/// Lamps on every 12 m of every wall that is at least 4 m long (also in
/// shaders/wall.frag.glsl), 4.2 m above the ground.
std::vector<Lamp> wall_lamps(const world::Scenario& scenario);

/// The lamps on walls, on lamp posts, and in what is used at night: stalls, tents, kiosks, stages.
std::vector<Lamp> all_lamps(const world::Scenario& scenario);

/// Lamp light 1 m above a point of the ground, without lamps that buildings occlude: the sum of the
/// unit directions to the lamps times their strengths, and the sum of their strengths, in the units
/// of render/scenery/daylight.h.
Eigen::Vector4f lamp_light_at(const world::Scenario& scenario, const std::vector<Lamp>& lamps,
                              const Eigen::Vector2d& point);

/// The light of a scenario's lamps as a texture over its ground.
class LampMap {
 public:
  explicit LampMap(const world::Scenario& scenario);

  const Eigen::AlignedBox2d& area() const { return area_; }

  /// Binds the texture for lamp_light() of shaders/light.glsl.
  void bind() const;

 private:
  Eigen::AlignedBox2d area_;
  Texture texture_;
};

}  // namespace throng::render
