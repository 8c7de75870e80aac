// Meshes of props.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace throng::render {

/// Reflection of a surface; also in shaders/prop.frag.glsl.
enum class Finish : std::uint8_t {
  matt = 0,
  leaves = 1,     ///< a card of leaves with holes
  glossy = 2,     ///< lacquer and glass, which reflect the sky
  lamp = 3,       ///< emits light after sunset
  water = 4,      ///< mirrors sky and sun in waves
  lit_glass = 5,  ///< glossy, and lit from within after sunset
  screen = 6,     ///< a wall of lights that shows moving images
  bark = 7        ///< furrowed, or with dark bands if bright
};

/// A vertex of a prop.
struct PropVertex {
  std::array<float, 3> position{};  ///< m, world
  std::array<float, 3> normal{};
  /// Leaves: coordinates on the card, 0 to 1; twice the number of the sprite is added to the first.
  std::array<float, 2> card{};
  std::array<std::uint8_t, 4> paint{};  ///< linear albedo, then the Finish
  std::uint32_t id = 0;
  std::array<float, 3> light{};  ///< as SceneryVertex::light
};

/// Triangles, counter-clockwise from outside; cards of leaves are visible from both sides.
struct PropMesh {
  std::vector<PropVertex> vertices;
  std::vector<std::uint32_t> indices;
  /// The first of `indices`, which are only drawn far away: details take their place near by.
  std::size_t only_far = 0;
  /// The number of `indices` that are drawn far away; those after them are details.
  std::size_t far_indices = std::numeric_limits<std::size_t>::max();
};

}  // namespace throng::render
