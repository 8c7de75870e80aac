// The triangles of a scenario's surroundings. Independent of GL.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace throng::render {

/// Min height (m) of walls with stories, windows and lamps.
inline constexpr double kMinStoryM = 2.6;

/// A vertex of the scenery.
struct SceneryVertex {
  std::array<float, 3> position{};  ///< m
  std::array<float, 3> normal{};
  /// Walls: coordinates along the front and up, length and height of the front (m). Roofs:
  /// coordinates along the eaves and up the slope (m). Ground: ground_tone_at(), then in wide areas
  /// 1 m and the distance to their outline (m), else 0, then coordinates along and across a strip
  /// (m). Decals: ground_tone_at(), half of the length, coordinates from the middle along and
  /// across (m).
  std::array<float, 4> local{};
  std::uint32_t id = 0;  ///< value in the id buffer; decals, which leave it alone: a random number
  /// Walls: value of world::Facade or WallLook. Roofs: of world::Covering or RoofLook. Decals:
  /// value of DecalKind + width / length, which is below 1.
  float facade = 0;
  /// Walls and roofs: linear albedo; of a front then a number that distinguishes it, of which the
  /// highest bit says that it has shops.
  std::array<std::uint8_t, 4> paint{};
  /// Light from sky, lamps and bounces on a white surface here (render/light/place_light.h).
  std::array<float, 3> light{};
};

/// A range of indices of triangles that share a shader.
struct Range {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// The triangles of the scenery, by ranges of indices.
struct SceneryMesh {
  std::vector<SceneryVertex> vertices;
  std::vector<std::uint32_t> indices;  ///< counter-clockwise from outside
  Range walls;
  Range roofs;
  Range ground;
  Range decals;        ///< traces of use on the ground, which only color it
  Range surroundings;  ///< the plain beyond the ground's edge, to the horizon
};

}  // namespace throng::render
