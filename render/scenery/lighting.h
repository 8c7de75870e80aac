// The Light block of shaders/light.glsl, the preprocessor lines for an environment, and the layout
// of the shadow map.
//
// The shadow map is aligned with the ground: a texel represents the lines toward the sun through
// one square of the plane z = 0 and contains the max height on these lines. A point is in the shade
// if a surface on its line is higher. Shadows on the ground are therefore equally sharp everywhere
// and stable when the camera moves.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "render/frame/view.h"
#include "render/scenery/daylight.h"
#include "world/disasters.h"

namespace throng::render {

/// Steps along each side of shadow_area() to which it is aligned: texels at standard quality.
inline constexpr int kShadowSize = 2048;

/// Fires that can light a scene at once; also in shaders/light.glsl.
inline constexpr std::size_t kMaxFires = 4;

/// A fire, or what an explosion left.
struct Fire {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double reach_m = 0;   ///< radius of the burned ground
  double strength = 0;  ///< 0 to 1: share of its flames that burn
};

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
  std::array<float, 4> eye{};
  std::array<std::array<float, 4>, kMaxFires> fires{};
};

/// The inputs of the Light block that depend on the frame.
struct LightFrame {
  Eigen::AlignedBox2d shadow_area;  ///< result of shadow_area()
  double tallest_m = 0;
  Eigen::Vector3d eye = Eigen::Vector3d::Zero();  ///< the camera's center
  double time_s = 0;
  std::span<const Fire> fires{};  ///< at most kMaxFires
  double exposure_gain = 1;       ///< gain of the camera's metering (render/scenery/metering.h)
};

/// Preprocessor lines "#define WORD" for the shaders of this environment: NO_SUN, SOFT (soft
/// shadows), LAMPS, WET, and FIRES where one of these disasters burns.
std::string light_words(const Environment& environment,
                        std::span<const world::Disaster> disasters = {});

/// The share, 0 to 1, of a disaster's flames that burn at a time of the run: all of a fire's, and
/// of an explosion's fireball ever fewer.
double burning_share(const world::Disaster& disaster, double time_s);

/// The fires that burn or have burned at a time of the run, those that light `eye` most first; at
/// most kMaxFires. None while hazards are not shown (Environment::smoke is 0).
std::vector<Fire> fires_at(const Environment& environment,
                           std::span<const world::Disaster> disasters, double time_s,
                           const Eigen::Vector3d& eye);

/// The negative displacement of a shadow on the ground per meter of height.
Eigen::Vector2d shadow_slope(const Daylight& light);

/// The part of the ground (m) whose lines toward the sun affect the visible part of `ground` and of
/// objects on it up to `tallest_m`. It grows in steps and moves by whole texels.
Eigen::AlignedBox2d shadow_area(const ClipPlanes& planes, const Eigen::AlignedBox2d& ground,
                                double tallest_m, const Eigen::Vector2d& slope);

LightBlock light_block(const Daylight& light, const LightFrame& frame);

}  // namespace throng::render
