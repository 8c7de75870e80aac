// People's meshes on the device: the levels of detail of all characters, packed into few
// attributes, which a software driver fetches quickly.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/gl/gl_objects.h"
#include "render/scenery/scenery.h"
#include "skinning/population.h"

namespace throng::render {

/// A vertex on the device. Words contain four bytes, the first one lowest.
struct DeviceVertex {
  std::array<float, 3> position;
  std::uint32_t bones;
  std::uint32_t weights;  ///< of 255, descending; the shader stops at the first zero
  std::uint32_t part;  ///< texture layer, a portrait's second one << 12, tint << 24, umbrella << 31
  std::uint32_t normal;  ///< signed bytes; 127 is 1
  std::array<float, 2> uv;
  std::uint32_t base;    ///< color of the surrounding texture, sRGB
  std::uint32_t shades;  ///< shades of a portrait, linear
};

/// One level of detail of one character.
struct PeopleLevel {
  std::int32_t first_vertex = 0;
  Range opaque;
  Range alpha_tested;
};

/// Selection of the levels to be packed in each form.
struct Packing {
  std::size_t textured_below = 0;  ///< levels below this index have texture coordinates
  std::size_t corners_from = 0;    ///< levels from this index on have a color per vertex
};

/// A level of detail as it is packed.
struct PackedMesh {
  std::vector<DeviceVertex> vertices;
  std::vector<std::uint32_t> indices;  ///< of opaque parts, three to a triangle
  bool has_transparent_parts = false;
};

/// The meshes of all characters on the device.
struct PeopleMeshes {
  Buffer vertices;
  Buffer indices;
  /// [character] the level skinning::kDistantLevel by corners; empty if it is not packed.
  std::vector<PackedMesh> distant;
  /// [character][level]; levels that are not packed are empty. In `by_corners`, opaque vertices
  /// that differ only in texture coordinates are merged.
  std::vector<std::vector<PeopleLevel>> textured;
  std::vector<std::vector<PeopleLevel>> by_corners;
};

PeopleMeshes people_meshes(const skinning::Population& population, const Packing& packing);

}  // namespace throng::render
