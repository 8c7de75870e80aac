// The Light block of shaders/light.glsl, the pieces of shader that an environment needs, and where
// the shadow map lies.
//
// The shadow map is laid out on the ground: every texel is the line toward the sun through one
// square of the plane z = 0, and holds the max height on that line. A point is in the shade if
// something on its line is higher. The texels of the ground are the map's own, so shadows on it are
// equally sharp everywhere and do not swim when the camera moves.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <string>

#include "render/scenery/daylight.h"
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
  std::array<float, 4> zenith{};
  std::array<float, 4> lamps{};
  std::array<float, 4> lamp_area{};
  std::array<float, 4> eye{};
};

/// Light that depends on the frame, in addition to the environment's.
struct LightFrame {
  Eigen::AlignedBox2d shadow_area;  ///< of shadow_area()
  Eigen::AlignedBox2d lamp_area;    ///< of the lamp map
  double tallest_m = 0;
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();  ///< the camera's center
  double time_s = 0;
  double exposure_gain = 1;  ///< of the camera's metering (render/lens/metering.h)
};

/// Lines "#define WORD" that the shaders of this environment start with: NO_SUN, SOFT (shadows
/// without edges), LAMPS, WET.
std::string light_words(const Environment& environment);

/// Displacement of the shadow on the ground per meter of height is minus this.
Eigen::Vector2d shadow_slope(const Daylight& light);

/// The part of the ground whose lines to the sun matter for what the camera sees of `ground`, up to
/// height `tallest_m`. Grows in steps and moves in whole texels.
Eigen::AlignedBox2d shadow_area(const ClipPlanes& planes, const Eigen::AlignedBox2d& ground,
                                double tallest_m, const Eigen::Vector2d& slope);

LightBlock light_block(const Daylight& light, const LightFrame& frame);

}  // namespace throng::render
