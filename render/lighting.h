// Sun and sky as radiances, and where the shadow map lies: the Light block of shaders/light.glsl.
//
// The shadow map is laid out on the ground: every texel is the line towards the sun through one
// square of the plane z = 0, and holds the height of the highest thing on that line. A point is in
// the shade if something on its line is higher. The texels of the ground are the map's own, so
// shadows on it are equally sharp everywhere and do not swim when the camera moves.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "render/renderer.h"
#include "render/view.h"

namespace throng::render {

/// Texels along each side of the shadow map.
inline constexpr int kShadowSize = 2048;

/// The Light uniform block (std140).
struct LightBlock {
  std::array<float, 4> sun_direction{};
  std::array<float, 4> sun{};
  std::array<float, 4> sky{};
  std::array<float, 4> bounce{};
  std::array<float, 4> haze{};
  std::array<float, 4> shadow_area{};
  std::array<float, 4> shadow_slope{};
};

/// Unit vector towards the sun; at least 3 degrees above the horizon, so that shadows end.
Eigen::Vector3d sun_direction(const Lighting& lighting);

/// Displacement of the shadow on the ground per metre of height is minus this.
Eigen::Vector2d shadow_slope(const Lighting& lighting);

/// The part of the ground whose lines to the sun matter for what the camera sees of `place`, up to
/// height `tallest_m`. Grows in steps and moves in whole texels.
Eigen::AlignedBox2d shadow_area(const ClipPlanes& planes, const Eigen::AlignedBox2d& place,
                                double tallest_m, const Eigen::Vector2d& slope);

LightBlock light_block(const Lighting& lighting, const Eigen::AlignedBox2d& area, double tallest_m);

/// The colour of the sky at the horizon as the film shows it, in [0, 1].
Eigen::Vector3f sky_colour(const LightBlock& light);

}  // namespace throng::render
