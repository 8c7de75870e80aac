// People's meshes as they lie on the device: every character's levels of detail, packed
// into as few attributes as a software driver fetches quickly.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/gl/gl_objects.h"
#include "render/scenery/scenery.h"
#include "skinning/population.h"

namespace throng::render {

/// A vertex on the device. The words are four bytes each, the first one lowest.
struct DeviceVertex {
  std::array<float, 3> position;
  std::uint32_t bones;
  std::uint32_t weights;  ///< of 255, falling: the shader stops at the first zero
  std::uint32_t part;  ///< texture layer, a portrait's second one << 12, tint << 24, umbrella << 31
  std::uint32_t normal;  ///< signed bytes of 127
  std::array<float, 2> uv;
  std::uint32_t base;    ///< the texture around it, sRGB
  std::uint32_t shades;  ///< of a portrait, linear
};

/// One level of detail of one character.
struct PeopleLevel {
  std::int32_t first_vertex = 0;
  Range opaque;
  Range alpha_tested;
};

/// Packed data of each level, by its number.
struct Packing {
  std::size_t textured_below = 0;  ///< so many levels with their texture coordinates
  std::size_t corners_from = 0;    ///< those from here on colored corner by corner
};

struct PeopleMeshes {
  Buffer vertices;
  Buffer indices;
  /// [character][level]. Of those colored by their corners, opaque vertices that differ in texture
  /// coordinates alone are one. Levels that are not packed are empty.
  std::vector<std::vector<PeopleLevel>> textured;
  std::vector<std::vector<PeopleLevel>> by_corners;
};

PeopleMeshes people_meshes(const skinning::Population& population, const Packing& packing);

}  // namespace throng::render
